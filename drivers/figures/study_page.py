# SPDX-License-Identifier: BSD-3-Clause
"""Parts of a self-contained HTML page: pictures inside, tables, lists; compact pictures."""
import base64
import html
import io

import numpy as np
from PIL import Image

from figures.table import columns_of

PAGE = """<!DOCTYPE html><html lang="en"><meta charset="utf-8"><title>{title}</title>
<style>body{{font:15px/1.45 sans-serif;max-width:76em;margin:2em auto;padding:0 1em}}img{{max-width:100%}}
table{{border-collapse:collapse;font-size:12px;display:block;overflow-x:auto}}
td,th{{padding:2px 7px;text-align:right;border-bottom:1px solid #ddd}}th{{vertical-align:bottom}}
figure{{margin:1.2em 0}}figcaption{{color:#444;font-size:13px}}li{{margin:.25em 0}}
</style><h1>{title}</h1><p>{intro}</p>{body}</html>"""


def save(fig, path, dpi=110):
    """A picture of 256 colours: a third of the size, no difference to the eye."""
    memory = io.BytesIO()
    fig.savefig(memory, dpi=dpi, bbox_inches="tight")
    Image.open(memory).convert("RGB").quantize(256, dither=Image.Dither.NONE).save(path, optimize=True)


def embedded(path, caption):
    data = base64.b64encode(path.read_bytes()).decode()
    caption = html.escape(caption)
    return f'<figure><img alt="{caption}" src="data:image/png;base64,{data}"><figcaption>{caption}</figcaption></figure>'


def shown(value):
    """A number as a reader wants it; nothing for what is not known."""
    if isinstance(value, float):
        return "" if not np.isfinite(value) else f"{value:.0f}" if abs(value) >= 100 else f"{value:.3g}"
    return str(value)


def page_table(rows, names=None):
    """`names`: the columns shown; all if not given."""
    columns = [name for name in names or columns_of(rows) if any(name in row for row in rows)]
    head = "".join(f"<th>{html.escape(c.replace('_', ' '))}</th>" for c in columns)
    body = "".join("<tr>" + "".join(f"<td>{html.escape(shown(row.get(c, '')))}</td>" for c in columns) + "</tr>"
                   for row in rows)
    return f"<table><tr>{head}</tr>{body}</table>"


def bullets(sentences):
    return "<ul>" + "".join(f"<li>{html.escape(line)}</li>" for line in sentences) + "</ul>" if sentences else ""


def text_table(rows, names=None):
    """The same in Markdown."""
    columns = [name for name in names or columns_of(rows) if any(name in row for row in rows)]
    lines = [columns_head(columns), "|---" * len(columns) + "|"]
    lines += ["| " + " | ".join(shown(row.get(c, "")) for c in columns) + " |" for row in rows]
    return "\n".join(lines) + "\n"


def columns_head(columns):
    return "| " + " | ".join(c.replace("_", " ") for c in columns) + " |"


def text_bullets(sentences):
    return "".join(f"- {line}\n" for line in sentences)
