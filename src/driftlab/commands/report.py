"""One HTML page with all that was found, to print and to keep: nothing in it is loaded from afar.

The page forbids itself every request and every script. The same input gives the same bytes.
"""

from __future__ import annotations

import base64
import re
from collections.abc import Sequence
from html import escape
from importlib.resources import files

from .findings import Findings, Plot, Table
from .outputs import Origin, numeric_columns
from .plots import svg

POLICY = "default-src 'none'; img-src data:; style-src 'unsafe-inline'"
LONG = 20  # rows of a table that may go on in another column or on another sheet


def page(findings: Findings, origin: Origin, title: str = "") -> str:
    """The page, under a title of one's own if there is one."""
    style = files(__package__).joinpath("report.css").read_text(encoding="utf-8")
    head = title or findings.title
    # The call breaks before an option, and within one only if it is too long.
    options = re.split(r" (?=--)", origin.call)
    known = [
        ("Date", origin.date or "not told"),
        *(pair for name, digest in origin.files for pair in (("Log", name), ("SHA-256", digest))),
        ("Taken for", origin.log),
        ("Versions", origin.versions),
    ]
    lines = [
        "<!DOCTYPE html>",
        '<html lang="en"><head><meta charset="utf-8">',
        f'<meta http-equiv="Content-Security-Policy" content="{POLICY}">',
        '<meta name="viewport" content="width=device-width, initial-scale=1">',
        f"<title>{escape(head)}</title>",
        f"<style>\n{style}</style></head><body>",
        f"<h1>{escape(head)}</h1>",
        *([f"<p class='kind'>{escape(findings.title)}</p>"] if title else []),
        "<dl>",
        *(f"<dt>{key}</dt><dd>{escape(text)}</dd>" for key, text in known if text),
        "</dl>",
        *(f"<p class='warning'><b>Warning:</b> {escape(text)}</p>" for text in findings.warnings),
        *(f"<p>{escape(text)}</p>" for text in findings.sentences),
        *map(_table, findings.tables),
        "<div class='plots'>",
        *map(_figure, findings.plots),
        "</div>",
        "<div class='details'>",
        *map(_table, findings.details),
        "</div>",
        "<h2>The call</h2>",
        f"<pre>{' '.join(f'<span>{escape(part)}</span>' for part in options)}</pre>",
        "</body></html>\n",
    ]
    return "\n".join(lines)


def _table(table: Table) -> str:
    right = numeric_columns(table)
    head = _row("th scope='col'", table.head, right)
    rows = "".join(_row("td", row, right) for row in table.rows)
    note = f"<p class='note'>{escape(table.note)}</p>" if table.note else ""
    kind = " class='long'" if len(table.rows) > LONG else ""
    return (
        f"<section{kind}><h2>{escape(table.title)}</h2><div class='wide'><table>"
        f"<thead>{head}</thead><tbody>{rows}</tbody></table></div>{note}</section>"
    )


def _row(tag: str, cells: Sequence[str], right: Sequence[bool]) -> str:
    kinds = [" class='number'" if aligned else "" for aligned in right]
    row = (f"<{tag}{kind}>{escape(x)}</{tag[:2]}>" for x, kind in zip(cells, kinds, strict=True))
    return f"<tr>{''.join(row)}</tr>"


def _figure(plot: Plot) -> str:
    picture = base64.b64encode(svg(plot).encode()).decode()
    names = ", ".join(curve.name for curve in plot.curves)
    alternative = f"{plot.title}: {plot.up} against {plot.across}. {names}"
    return (
        f"<figure><figcaption>{escape(plot.title)}</figcaption><img alt='{escape(alternative)}' "
        f"src='data:image/svg+xml;base64,{picture}'></figure>"
    )
