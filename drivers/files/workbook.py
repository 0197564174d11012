#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Writes one sheet of an Excel workbook as text: workbook.py FILE.xlsx [SHEET]

One line for each row, so that the numbers of lines are those of rows. Texts stand in quotes, numbers do not. Formulas
give the values that Excel stored. What has no plain meaning as a number or text ends the program with one line and no
table: percentages (5 % is stored as 0.05), formulas without a stored value, an ambiguous sheet.
"""
import datetime
import sys
import warnings


def fail(message):
    print(message.replace("\n", " "), file=sys.stderr)
    sys.exit(1)


def text_of(value):
    return '"' + " ".join(str(value).split()).replace('"', '""') + '"'


def cell_text(cell, formula, file):
    value = cell.value
    if value is None:
        if isinstance(formula.value, str) and formula.value.startswith("="):
            fail(f"{file}: cell {cell.coordinate} holds a formula without a stored value: open and save the file in "
                 "the spreadsheet program")
        return ""
    if isinstance(value, bool) or isinstance(value, (datetime.date, datetime.time, datetime.timedelta)):
        return text_of(value)
    if isinstance(value, (int, float)):
        if "%" in (cell.number_format or ""):
            fail(f"{file}: cell {cell.coordinate} is shown as a percentage but stored as {value}: give it the format "
                 "of a plain number")
        return repr(value)
    return text_of(value)


def chosen_sheet(book, name, file):
    if name:
        if name not in book.sheetnames:
            fail(f"{file}: expected a sheet '{name}', found {', '.join(book.sheetnames)}")
        return name
    filled = [sheet.title for sheet in book.worksheets
              if any(value is not None for row in sheet.iter_rows(values_only=True) for value in row)]
    if len(filled) != 1:
        fail(f"{file}: expected one sheet that is not empty, found {len(filled)} ({', '.join(filled)}): choose one, "
             "key 'sheet'")
    return filled[0]


def main():
    file, name = sys.argv[1], sys.argv[2] if len(sys.argv) > 2 else ""
    try:
        import openpyxl
    except ImportError:
        fail(f"{file}: reading .xlsx needs openpyxl (Debian: python3-openpyxl); or save the sheet as CSV")
    try:
        values, formulas = (openpyxl.load_workbook(file, data_only=only) for only in (True, False))
    except Exception as error:  # openpyxl raises many kinds for files that are no workbooks
        fail(f"{file}: expected an Excel workbook (.xlsx): {error}")
    sheet = chosen_sheet(values, name, file)
    sys.stdout.reconfigure(encoding="utf-8")
    lines = [",".join(cell_text(c, f, file) for c, f in zip(row, formula_row))
             for row, formula_row in zip(values[sheet].iter_rows(), formulas[sheet].iter_rows())]
    print("\n".join(lines))


warnings.simplefilter("ignore")
main()
