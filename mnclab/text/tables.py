"""Tables for people, as HTML and as text: rows of texts under their heads, a line end in a cell begins a new line in it.

Words stand to the left and numbers to the right, also where a notebook would set all to the right. Numbers of a column that
have different decimals stand under each other by their points.
"""

from __future__ import annotations

import csv
import io
import re
from collections.abc import Collection, Iterable, Sequence
from html import escape
from itertools import zip_longest
from typing import Any

NUMBER = re.compile(r"[-+\N{MINUS SIGN}]?\d+(\.\d*)?")


def tail(text: str | None) -> str | None:
    """What a number has from its point on; None of what is no number."""
    found = NUMBER.fullmatch(text or "")
    return None if found is None else found[1] or ""


def html_table(
    head: Sequence[str],
    rows: Iterable[Sequence[str | None]],
    *,
    numbers: Collection[int] = (),
    code: Collection[int] = (),
    bold: Collection[int] = (),
) -> str:
    """A table of HTML; `numbers` are the columns that stand to the right, `code` those of program text, `bold` some rows.

    A cell of None belongs to the one above it, and the last cell of a short row to all columns that follow.
    """
    rows = list(rows)
    columns = len(head) or max(map(len, rows), default=0)
    tall = [1] * columns  # rows of the next cell of each column, counted from below
    longest = {k: max((len(tail(row[k]) or "") for row in rows if k < len(row)), default=0) for k in numbers}
    lines = []
    for number, row in reversed([*enumerate(rows)]):
        cells, weight = [], "; font-weight:bold" * (number in bold)
        for k, text in enumerate(row):
            if text is None:
                tall[k] += 1
                continue
            style = f"text-align:{'right' if k in numbers else 'left'}{'; vertical-align:top' * (tall[k] > 1)}{weight}"
            spans = f' rowspan="{tall[k]}"' if tall[k] > 1 else ""
            spans += f' colspan="{columns - k}"' if k + 1 == len(row) < columns else ""
            said = escape(text).replace("\n", "<br>")
            if k in longest and (end := tail(text)) is not None and len(end) < longest[k]:
                room = longest[k] - len(end) - (0.5 if not end else 0)  # a point is half as wide as a digit
                said = f'<span style="padding-right:{room:g}ch">{said}</span>'
            cells.append(f'<td style="{style}"{spans}>{f"<code>{said}</code>" if k in code and said else said}</td>')
            tall[k] = 1
        lines.append(f"<tr>{''.join(cells)}</tr>")
    sides = ("right" if k in numbers else "left" for k in range(columns))
    heads = (
        f'<th style="text-align:{side}; white-space:normal">{escape(name).replace(chr(10), "<br>")}</th>'
        for side, name in zip(sides, head)
    )
    top = f"<tr>{''.join(heads)}</tr>" if head else ""
    return f"<table>{top}{''.join(reversed(lines))}</table>"


def csv_text(head: Sequence[Any], *rows: Sequence[Any]) -> str:
    """A table as comma-separated values, a line each."""
    out = io.StringIO()
    csv.writer(out, lineterminator="\n").writerows([head, *rows])
    return out.getvalue()


def text_table(head: Sequence[str], rows: Iterable[Sequence[str]], numbers: Collection[int] = ()) -> str:
    """A table of text, with a rule below its heads; the columns `numbers` stand to the right."""
    rows = list(rows)
    longest = {k: max((len(tail(row[k]) or "") for row in rows), default=0) for k in numbers}
    lines = [*zip_longest(*(name.split("\n") for name in head), fillvalue="")]
    below = len(lines)
    for row in rows:
        cells = [
            text + " " * (longest[k] - len(end)) if k in longest and (end := tail(text)) is not None else text
            for k, text in enumerate(row)
        ]
        lines += zip_longest(*(cell.split("\n") for cell in cells), fillvalue="")
    widths = [max(map(len, column)) for column in zip(*lines, strict=True)]
    lines.insert(below, tuple("-" * width for width in widths))
    sides = [str.rjust if k in longest else str.ljust for k in range(len(widths))]
    return "\n".join("  ".join(side(text, width) for side, text, width in zip(sides, line, widths)).rstrip() for line in lines)
