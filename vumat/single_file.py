#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Writes the material as one C++17 source file for ABAQUS.

single_file.py ROOT TABLES OUTPUT

ROOT holds vumat/; TABLES is a file with the tables of PROPS and STATEV; OUTPUT is the file to write. Local includes
are put in where they first occur, standard ones collected at the top. The result is plain ASCII.
"""
import pathlib
import re
import sys
import unicodedata

SOURCES = ["vumat/vumat.cpp", "vumat/simsand.cpp", "vumat/rescue.cpp", "vumat/parameters.cpp"]

HEAD = """\
// SPDX-License-Identifier: BSD-3-Clause
// SIMSAND {version}, a critical state model of sand, as an ABAQUS/Explicit VUMAT in one file. Generated: do not edit.
//
//     abaqus job=JOB user=simsand_vumat.cpp double=both
//
// C++17 and its standard library, nothing else. If the compiler's default is older, add -std=c++17 (Windows:
// /std:c++17) to compile_cpp in the environment file. With GCC or Clang add -O3 -march=native there for speed.
//
// Precision: the file is for double=both. For the default, single precision, compile with -DSIMSAND_SINGLE or
// remove the two slashes of the next line that defines it. The wrong one corrupts the memory of the solver.
//
//#define SIMSAND_SINGLE
//
// Material: tension positive, effective stress, any consistent units (p_at fixes the unit of stress); 3 direct and
// 1 or 3 shear components; *USER MATERIAL, CONSTANTS={constants} and *DEPVAR with {states} state variables or more.
//
{tables}
//
// Start: *INITIAL CONDITIONS, TYPE=STRESS, and either STATEV all 0 or those of a former analysis (TYPE=SOLUTION).
//
// Failure of a point is never silent: its stress becomes NaN and STATEV(4) is
//   -1          no solution within the bounded number of iterations and substeps
//   -2          stress, strain or state not finite, or void ratio or hardening variable out of range
//   -3          not 3 direct and 1 or 3 shear components, or fewer than {states} state variables
//   -100 - i    PROPS(i) missing or out of range

#if __cplusplus < 201703L && !(defined(_MSVC_LANG) && _MSVC_LANG >= 201703L)
#error "simsand_vumat.cpp needs C++17: add -std=c++17 (Windows: /std:c++17) to compile_cpp"
#endif

{includes}

#if defined(_WIN32)
#define SIMSAND_EXPORT __declspec(dllexport)
#define SIMSAND_SYMBOL VUMAT
#else
#define SIMSAND_EXPORT __attribute__((visibility("default")))
#define SIMSAND_SYMBOL vumat_
#endif
{portable}"""

# Compilers without GCC's vectors update points one by one.
PORTABLE = """\
#if defined(_MSC_VER) && !defined(__clang__)
#define __attribute__(ignored)
#define SIMSAND_VECTOR_BYTES 0
#endif
"""

EXPORT = 'extern "C" __attribute__((visibility("default"))) void\nvumat_('
EXPORT_HERE = 'extern "C" SIMSAND_EXPORT void\nSIMSAND_SYMBOL('

NAMES = {
    "ν": "nu", "φ": "phi", "λ": "lambda", "ζ": "zeta", "ε": "eps", "θ": "theta", "σ": "sigma", "Δ": "d", "η": "eta",
    "·": " ", "−": "-", "≤": "<=", "≥": ">=", "±": "+-", "→": "->", "√": "sqrt", "∥": "parallel to", "°": " degrees",
}


def ascii_only(text):
    named = "".join(NAMES.get(letter, letter) for letter in text)
    return unicodedata.normalize("NFKD", named).encode("ascii", "replace").decode("ascii")


class Inliner:
    def __init__(self, root):
        self.root = root
        self.seen = set()
        self.standard = set()

    def text_of(self, name):
        """A file with its local includes put in, each where it first occurs."""
        self.seen.add(name)
        lines = []
        for line in (self.root / name).read_text(encoding="utf-8").splitlines():
            local = re.fullmatch(r'\s*#\s*include\s+"([^"]+)"\s*', line)
            standard = re.fullmatch(r"\s*#\s*include\s+<([^>]+)>\s*", line)
            if local:
                if local[1] not in self.seen:
                    lines += ["", *self.text_of(local[1]), f"// ---- {name}, continued"]
            elif standard:
                self.standard.add(standard[1])
            elif not line.startswith(("#pragma once", "// SPDX-License-Identifier")):
                lines.append(line)
        return [f"// ---- {name}", *lines, ""]


def comment(markdown):
    """Table rows as comment lines, columns aligned."""
    tables, out = markdown.strip().split("\n\n"), []
    for table in tables:
        rows = [[cell.strip().strip("`") for cell in line.strip("|").split("|")] for line in table.splitlines()]
        rows = [row for row in rows if not set("".join(row)) <= {"-"}]
        widths = [max(len(row[column]) for row in rows) for column in range(len(rows[0]))]
        out += ["// " + "  ".join(cell.ljust(w) for cell, w in zip(row, widths)).rstrip() for row in rows] + ["//"]
    return "\n".join(out[:-1]), [len(table.splitlines()) - 2 for table in tables]


def main(root, tables_file, output, version):
    inliner = Inliner(pathlib.Path(root))
    lines = []
    for name in SOURCES:
        lines += inliner.text_of(name)
    body = ascii_only(re.sub(r"\n{3,}", "\n\n", "\n".join(lines)))
    if body.count(EXPORT) != 1:
        sys.exit("single_file.py: the exported subroutine was not found once in vumat/vumat.cpp")
    tables, (constants, states) = comment(ascii_only(pathlib.Path(tables_file).read_text(encoding="utf-8")))
    head = HEAD.format(version=version, constants=constants, states=states, tables=tables, portable=PORTABLE,
                       includes="\n".join(f"#include <{name}>" for name in sorted(inliner.standard)))
    pathlib.Path(output).write_text(head + "\n" + body.replace(EXPORT, EXPORT_HERE), encoding="ascii")


if __name__ == "__main__":
    main(*sys.argv[1:])
