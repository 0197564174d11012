# SPDX-License-Identifier: BSD-3-Clause
"""The stored answers of golden.py, and how new ones are compared with them."""
import csv
import pathlib
import platform
import re

import h5py

import cases

FILE = cases.HERE / "answers.csv"
# Relative, for another platform; by the names' first words. Sand amplifies rounding: the material without vector instructions
# and fused multiply-adds, or gravity larger by its last bit, changed the numbers at 0.03 s by up to 4e-8, the sum of stress
# by 5e-7; at the end of the runs height, steps and time by up to 2e-3.
TOLERANCES = {"early_sum": 1e-4, "early": 1e-5, "final": 1e-2, "steps": 1e-2, "end": 1e-2}
# Last rows of paths changed by up to 2e-9, or by 3e-6 Pa where stress is zero: the driver meets its conditions to about that.
PATH_TOLERANCE, ZERO_STRESS, ZERO = 1e-6, 1e-3, 1e-9


def tolerance_of(case, name, stored):
    if case.startswith("path "):
        return PATH_TOLERANCE * abs(stored) + (ZERO_STRESS if name.endswith("_Pa") else ZERO)
    return next(t for start, t in TOLERANCES.items() if name.startswith(start)) * abs(stored)


def signature(program, folder):
    """What the bits depend on besides the source: compiler, processor, C library."""
    cases.call([program, "run", "-q", "-t", 1, cases.HERE / "scenes/axisymmetric.toml", "-o", folder, "--set", "end.time=1e-9"])
    with h5py.File(folder / "result.h5") as file:
        compiler = file.attrs["compiler"]
    information = pathlib.Path("/proc/cpuinfo")
    text = information.read_text() if information.exists() else ""

    def first(key):
        return next(iter(re.findall(rf"^{key}\s*:\s*(.*)$", text, re.M)), "unknown")

    flags = first("flags").split()
    instructions = "avx512" if "avx512f" in flags else "avx2" if "avx2" in flags else "no avx2"
    return (f"{compiler.decode() if isinstance(compiler, bytes) else compiler}; {platform.machine()}, {instructions}, "
            f"family {first('cpu family')} model {first('model')}; {' '.join(platform.libc_ver())}")


def read():
    """The platform of the stored answers, and hashes and numbers by case."""
    if not FILE.exists():
        return "", {}
    head, *lines = FILE.read_text().splitlines()

    def pairs(cell, kind):
        return {name: kind(value) for name, value in (word.split("=") for word in cell.split())}

    return head.removeprefix("# "), {row["case"]: {"hashes": pairs(row["hashes"], str), "numbers": pairs(row["numbers"], float)}
                                     for row in csv.DictReader(lines)}


def write(here, stored):
    with open(FILE, "w", newline="") as file:
        file.write(f"# {here}\n")
        table = csv.writer(file, lineterminator="\n")
        table.writerow(["case", "hashes", "numbers"])
        for case, answer in stored.items():
            table.writerow([case, " ".join(f"{k}={v}" for k, v in answer["hashes"].items()),
                            " ".join(f"{k}={v:.9g}" for k, v in answer["numbers"].items())])


def first_difference(one, other):
    """The first key whose values differ or that only one has, in the order in which a run writes them; None if none."""
    groups = ["particles", "snapshots", "outline", "series", "table", "envelope"]
    keys = sorted(set(one) | set(other), key=lambda name: (groups.index(name.split("/")[0]), name))
    return next((key for key in keys if one.get(key) != other.get(key)), None)


def compare_variants(case, variants):
    """One thread, two threads, interrupted or not: all the same."""
    (what, first), *others = sorted(variants.items())
    for other, answer in others:
        if name := first_difference(first.datasets, answer.datasets):
            names = [n for n in first.datasets if n.startswith(cases.part_of(name)) and n in answer.datasets
                     and first.datasets[n] != answer.datasets[n]]
            yield f"{case}: {other} and {what} differ first in {', '.join(names) or name}"


def compare_bits(case, answer, stored):
    if not (part := first_difference(answer.parts(), stored["hashes"])):
        return
    moved = [f"{name} {value:.9g} -> {answer.numbers[name]:.9g}" for name, value in stored["numbers"].items()
             if f"{answer.numbers[name]:.9g}" != f"{value:.9g}"]
    yield f"{case}: differs from the stored answer first in {part}; {', '.join(moved[:3]) or 'numbers agree to 9 digits'}"


def compare_numbers(case, answer, stored):
    for name, value in stored["numbers"].items():
        tolerance = tolerance_of(case, name, value)
        if not abs(answer.numbers[name] - value) <= tolerance:  # also where it is not a number
            yield f"{case}: {name} is {answer.numbers[name]:.9g}, stored {value:.9g}, tolerance {tolerance:.2g}"


def compare_stored(here, found):
    """Bits on the platform of the stored answers, else numbers. `found`: answers by case."""
    there, stored = read()
    if here != there:
        print(f"another platform: numbers are compared to tolerances, not bits\n  stored: {there}\n  here:   {here}")
    for case, answer in found.items():
        if case in stored:
            yield from (compare_bits if here == there else compare_numbers)(case, answer, stored[case])
        else:
            yield f"{case}: no stored answer; golden.py --update writes it"


def update(here, found, all_cases):
    """Replaces the stored answers of the cases found; all must be of one platform."""
    there, stored = read()
    if here != there:
        stored = {}
    stored |= {case: {"hashes": answer.parts(), "numbers": answer.numbers} for case, answer in found.items()}
    if missing := [case for case in all_cases if case not in stored]:
        raise cases.Failure(f"update all cases: no answer of this platform to {missing[0]}")
    write(here, {case: stored[case] for case in all_cases})
