#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""The trends of the 24 columns at 4 mm, Table 4: those that the paper reports hold, but for the exceptions below.

    trends.py TRENDS.csv

An exception is a case in which a trend does not hold at this spacing, with bounds of the amount by which it fails:
a change beyond them, to the better or the worse, is to be noticed. Each bound is the value measured, give or take
the scatter of single runs: 0.01 in height, 0.05 in runout, a particle's row (0.08) in the undisturbed zone."""
import csv
import re
import sys

# Trend -> least number of cases that hold, and the exceptions: case -> (low, high).
EXPECTED = {
    "dense higher than loose": (12, {}),
    "dense shorter runout than loose": (4, {}),
    "dense undisturbed zone larger than loose": (10, {}),
    "SS lowest": (7, {}),
    "SS furthest": (7, {}),
    "TS and ES alike in height: apart by less than half their distance to SS": (
        6, {"loose a = 0.5": (-0.02, 0), "loose a = 2": (-0.05, 0)}),
    "TS and ES alike in runout: apart by less than half their distance to SS": (
        6, {"dense a = 4": (-0.14, 0), "dense a = 2": (-0.14, 0)}),
    # Loose columns lose their edge of undisturbed surface: the zone is a cone from the start.
    "undisturbed zone trapezoidal at a = 0.5": (
        3, {"SS loose a = 0.5": (-0.17, 0), "TS loose a = 0.5": (-0.24, 0), "ES loose a = 0.5": (-0.18, 0)}),
    "undisturbed zone conical at a = 1 and 2": (12, {}),
    # That of loose columns is buried at a = 2 already.
    "undisturbed zone not buried at a = 1 and 2": (
        8, {"SS dense a = 2": (-0.09, 0), "SS loose a = 2": (-0.19, 0), "TS loose a = 2": (-0.23, 0),
            "ES loose a = 2": (-0.28, 0)}),
    "undisturbed zone buried at a = 4": (6, {}),
    "three phases: the fall begins slowly, is fast, and ends slowly": (20, {"SS dense a = 1": (-1, 0)}),
}


def faults(row, least, allowed):
    """What is wrong with a trend, in sentences."""
    found = []
    if int(row["holds"]) < least:
        found.append(f"holds in {row['holds']} cases, expected {least}")
    for case, amount in re.findall(r"([^;]+?) \(([-+0-9.]+)\)(?:; )?", row["exceptions"]):
        low, high = allowed.get(case, (0, 0))
        if not low <= float(amount) <= high:
            found.append(f"{case} fails by {amount}, expected {f'{low} to {high}' if case in allowed else 'to hold'}")
    return found


def main():
    with open(sys.argv[1], encoding="utf-8") as table:
        rows = {row["trend"]: row for row in csv.DictReader(table) if row["columns"] == "table4, 4 mm"}
    wrong = [f"no trend '{name}'" for name in EXPECTED if name not in rows]
    for name, (least, allowed) in EXPECTED.items():
        wrong += [f"{name}: {fault}" for fault in faults(rows[name], least, allowed)] if name in rows else []
    print(*wrong, sep="\n", file=sys.stderr)
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
