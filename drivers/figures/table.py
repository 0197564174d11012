# SPDX-License-Identifier: BSD-3-Clause
"""Tables as CSV: comment lines begin with #, empty cells are numbers that are not known."""
import csv

import numpy as np


def read_rows(path, words=()):
    """One dictionary for each row; numbers, but texts in the columns that `words` names."""
    with open(path, encoding="utf-8") as file:
        rows = list(csv.DictReader(line for line in file if not line.startswith("#")))
    return [{name: cell if name in words else number(cell) for name, cell in row.items()} for row in rows]


def number(cell):
    return float(cell) if cell else np.nan


def read_columns(path):
    """Columns of numbers by name."""
    rows = read_rows(path)
    if not rows:
        raise ValueError("no rows below the header")
    return {name: np.array([row[name] for row in rows]) for name in rows[0]}


def columns_of(rows):
    """Names of the columns of rows that need not all have the same."""
    return list(dict.fromkeys(name for row in rows for name in row))


def write_rows(path, rows):
    with open(path, "w", newline="", encoding="utf-8") as file:
        writer = csv.DictWriter(file, columns_of(rows), restval="", lineterminator="\n")
        writer.writeheader()
        writer.writerows({k: f"{v:.5g}" if isinstance(v, float) else v for k, v in row.items()} for row in rows)
