# SPDX-License-Identifier: BSD-3-Clause
"""Makes a workbook of a table with commas: make_workbook.py TABLE.csv BOOK.xlsx [second | percent | formula]

Cells are numbers where they can be. `second` adds a second sheet with something in it, `percent` gives a cell the
format of a percentage, `formula` adds a formula without a stored value.
"""
import csv
import sys

import openpyxl

table, book_file, *extra = sys.argv[1:]
book = openpyxl.Workbook()
sheet = book.active
sheet.title = "data"
sheet.append(["Drained test", "dense"])
for row in csv.reader(open(table)):
    try:
        sheet.append([float(cell) for cell in row])
    except ValueError:
        sheet.append(row)
if extra == ["second"]:
    book.create_sheet("notes").append(["nothing"])
if extra == ["percent"]:
    sheet["A5"].number_format = "0.00%"
if extra == ["formula"]:
    sheet["A5"] = "=A4+0.4"
book.create_sheet("empty")
book.save(book_file)
