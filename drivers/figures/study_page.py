# SPDX-License-Identifier: BSD-3-Clause
"""Parts of a self-contained HTML page: pictures inside, tables."""
import base64
import csv
import html

PAGE = """<!DOCTYPE html><html lang="en"><meta charset="utf-8"><title>{title}</title>
<style>body{{font:15px/1.45 sans-serif;max-width:70em;margin:2em auto;padding:0 1em}}img{{max-width:100%}}
table{{border-collapse:collapse;font-size:12px}}td,th{{padding:2px 7px;text-align:right;border-bottom:1px solid #ddd}}
</style><h1>{title}</h1><p>{intro}</p>{body}</html>"""


def embedded(path, caption):
    data = base64.b64encode(path.read_bytes()).decode()
    caption = html.escape(caption)
    return f'<h3>{caption}</h3><img alt="{caption}" src="data:image/png;base64,{data}">'


def columns_of(rows):
    return list(dict.fromkeys(name for row in rows for name in row))


def page_table(rows):
    def cell(value):
        return f"<td>{format(value, '.3g') if isinstance(value, float) else html.escape(str(value))}</td>"

    columns = columns_of(rows)
    head = "".join(f"<th>{html.escape(c.replace('_', ' '))}</th>" for c in columns)
    body = "".join("<tr>" + "".join(cell(row.get(c, "")) for c in columns) + "</tr>" for row in rows)
    return f"<table><tr>{head}</tr>{body}</table>"


def write_table(path, rows):
    with open(path, "w", newline="", encoding="utf-8") as file:
        writer = csv.DictWriter(file, columns_of(rows), restval="")
        writer.writeheader()
        writer.writerows({k: f"{v:.5g}" if isinstance(v, float) else v for k, v in row.items()} for row in rows)
