#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Floating-point operations of the VUMAT per update, counted instruction by instruction.

    build/simsand-chart increments data/scenes/default.toml -o results/chart
    vumat_flops.py results/chart/states.csv

The library is built for 256-bit lanes, which valgrind knows, and called once for the updates of a collapse in blocks of 64; callgrind
counts how often each instruction runs, objdump says what it is. A fused multiply-add counts two, every other arithmetic instruction one
for each lane, quotients and roots too; comparisons, choices and moves count nothing. Needs g++, valgrind, objdump. Other widths do
the same operations on more lanes; lanes that idle in a register count, as in `host_rate`."""
import argparse
import collections
import ctypes
import pathlib
import re
import subprocess
import sys
import tempfile

import numpy as np

FLAGS = ["-O3", "-std=c++20", "-shared", "-fPIC", "-fvisibility=hidden", "-fno-math-errno", "-fno-trapping-math",
         "-ffp-contract=fast", "-march=haswell", "-fno-tree-slp-vectorize", "-fno-gcse", "-Wno-psabi"]
SOURCES = ["vumat/vumat.cpp", "vumat/simsand.cpp", "vumat/rescue.cpp", "vumat/parameters.cpp"]
BLOCK, STATES, DENSITY = 64, 5, 1700.0
LANES = {"pd": {"ymm": 4, "xmm": 2}, "sd": {"ymm": 1, "xmm": 1}}
ARITHMETIC = re.compile(r"^v?(fn?m(?:add|sub)\w*?|add|sub|mul|div|sqrt|max|min)(?:132|213|231)?(pd|sd)$")


def call_all(library, states):
    """The updates of the file, once, in blocks (compression positive in the file)."""
    with open(states, encoding="utf-8") as lines:
        properties = np.array([float(x) for x in lines.readline().split()[2:]])
    rows = np.loadtxt(states, delimiter=",", skiprows=2)
    rows = rows[:len(rows) // BLOCK * BLOCK]
    vumat = ctypes.CDLL(str(library)).vumat_
    pointer, integer = (lambda a: a.ctypes.data_as(ctypes.c_void_p)), (lambda i: ctypes.byref(ctypes.c_int(i)))
    one, none = ctypes.byref(ctypes.c_double(1.0)), None
    for first in range(0, len(rows), BLOCK):
        block = rows[first:first + BLOCK]
        strain, stress = (np.ascontiguousarray(-block[:, k:k + 4].T) for k in (0, 4))
        state = np.zeros((STATES, BLOCK))
        state[:3] = block[:, 8:11].T
        density, zeros = np.full(BLOCK, DENSITY), np.zeros(BLOCK)
        new = [np.zeros_like(a) for a in (stress, state, zeros, zeros)]
        vumat(integer(BLOCK), integer(3), integer(1), integer(STATES), integer(0), integer(len(properties)), integer(0),
              one, one, one, ctypes.c_char_p(b" " * 80), none, none, pointer(properties), pointer(density), pointer(strain),
              none, none, none, none, none, pointer(stress), pointer(state), pointer(zeros), pointer(zeros), none, none,
              none, none, *(pointer(a) for a in new), ctypes.c_size_t(80))
    print(len(rows))


def flops_of(library):
    """Offset of an instruction in the library -> operations."""
    listing = subprocess.run(["objdump", "-d", "--no-show-raw-insn", library], check=True, capture_output=True,
                             text=True).stdout
    flops = {}
    for address, name, operands in re.findall(r"^\s*([0-9a-f]+):\s+(\w+)\s*(.*)$", listing, re.M):
        if found := ARITHMETIC.match(name):
            operation, kind = found.groups()
            lanes = LANES[kind]["ymm" if "ymm" in operands else "xmm"]
            if operation not in ("max", "min"):
                flops[int(address, 16)] = lanes * (2 if operation.startswith("fm") or operation.startswith("fn") else 1)
    return flops


def executed(profile, library):
    """Offset of an instruction in the library -> times it ran."""
    counts, names = collections.Counter(), {}
    inside = skip = False
    address = 0
    for line in open(profile, encoding="utf-8"):
        if found := re.match(r"ob=\((\d+)\)(?: (.*))?", line):
            if found[2]:
                names[found[1]] = found[2]
            inside = names[found[1]].strip() == str(library)
        elif found := re.match(r"cob=\((\d+)\)(?: (.*))?", line):
            if found[2]:
                names[found[1]] = found[2]
        elif line.startswith("calls="):
            skip = True  # the next line is the cost of the callee
        elif re.match(r"(0x|\+|-|\*)", line):
            where, *rest = line.split()
            if where.startswith("0x"):
                address = int(where, 16)
            elif where != "*":
                address += int(where, 0)
            if not skip and inside:
                counts[address] += int(rest[-1])
            skip = False
    return counts


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("states", type=pathlib.Path, help="states.csv of simsand-chart increments")
    parser.add_argument("--call", help=argparse.SUPPRESS)  # this program under callgrind: the library to call
    arguments = parser.parse_args()
    if arguments.call:
        return call_all(arguments.call, arguments.states)
    root = pathlib.Path(__file__).resolve().parents[2]
    with tempfile.TemporaryDirectory() as folder:
        library, profile = pathlib.Path(folder) / "libvumat.so", pathlib.Path(folder) / "profile"
        subprocess.run(["g++", *FLAGS, "-I", root, "-o", library, *SOURCES], check=True, cwd=root)
        run = subprocess.run(["valgrind", "--tool=callgrind", "--dump-instr=yes", f"--callgrind-out-file={profile}",
                              sys.executable, __file__, arguments.states, "--call", library], check=True,
                             capture_output=True, text=True)
        updates = int(run.stdout.split()[-1])
        counts, flops = executed(profile, library), flops_of(library)
        print(f"{updates} updates, {sum(counts.values()) / updates:.0f} instructions and "
              f"{sum(n * flops.get(a, 0) for a, n in counts.items()) / updates:.0f} floating-point operations each")
    return None


if __name__ == "__main__":
    sys.exit(main())
