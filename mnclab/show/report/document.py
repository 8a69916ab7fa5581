"""A document: sections, and in them words, tables, pictures, alarms and listings; and how it is written as HTML.

It is data alone; `html` makes one page of it that stands alone: its style sheet and its pictures are in it, and it prints on
A4. `show.plot.pages` sets it on A4.
"""

from __future__ import annotations

import re
from collections.abc import Collection, Sequence
from dataclasses import dataclass, field
from functools import singledispatch
from html import escape
from pathlib import Path
from typing import Any, NamedTuple

from mnclab.text.alarm import Alarm, card_html
from mnclab.text.opening import opened
from mnclab.text.tables import html_table

Row = Sequence[str]
GOOD, BAD, DOUBTFUL = "good", "bad", "doubtful"
QUOTED = 84  # characters of a quoted line of a program


class Words(NamedTuple):
    """A paragraph; its `tone` is "good", "bad", "doubtful" or nothing."""

    text: str
    tone: str = ""


class TextTable(NamedTuple):
    """Rows of texts under heads (or none); the columns `numbers` stand to the right, some rows are `bold`."""

    head: Row
    rows: Sequence[Row]
    numbers: Collection[int] = ()
    bold: Collection[int] = ()


class Blanks(NamedTuple):
    """Names with a line behind each, which a person fills in; of some the answer is known."""

    rows: Sequence[tuple[str, str]]


class Image(NamedTuple):
    """A picture with what is said below it."""

    picture: Any
    caption: str


class Alarms(NamedTuple):
    """Alarms with the line they stand in; the first of very many."""

    alarms: Sequence[Alarm]


class Listing(NamedTuple):
    """Number and text of each line of a program, and the severity of what stands in it: "alarm", "warning" or nothing."""

    lines: Sequence[tuple[int, str, str]]


class Compared(NamedTuple):
    """How a part differs from its design: the map and the table of measures."""

    difference: Any


Piece = Words | TextTable | Blanks | Image | Alarms | Listing | Compared


class Section(NamedTuple):
    """Pieces under a title."""

    title: str
    pieces: Sequence[Piece]


@dataclass(frozen=True)
class Document:
    """A title and a line below it, which head every page, and what follows."""

    title: str
    subtitle: str
    sections: Sequence[Section] = field(default_factory=tuple)


# The document as one HTML page.

POLICY = "default-src 'none'; style-src 'unsafe-inline'; img-src data:; base-uri 'none'; form-action 'none'"


def style() -> str:
    """The one style sheet of all pages."""
    return Path(__file__).with_name("report.css").read_text("utf-8")


def html(document: Document) -> str:
    """The document as one page; its pictures are numbered."""
    parts, figures = [f"<h1>{escape(document.title)}</h1><p>{escape(document.subtitle)}</p>"], 0
    for section in document.sections:
        head = f"<h2>{escape(section.title)}</h2>" if section.title else ""
        pieces = []
        for piece in section.pieces:
            if isinstance(piece, Image):
                figures += 1
                caption = f"<figcaption>Figure {figures}: {escape(piece.caption)}</figcaption>"
                pieces.append(f"<figure>{piece.picture.html(2.0)}{caption}</figure>")
            else:
                pieces.append(written(piece))
        parts.append(f"<section>{head}{''.join(pieces)}</section>")
    return page(document.title, "\n".join(parts))


def page(title: str, body: str) -> str:
    """A page with the style sheet of reports; it asks for nothing from elsewhere."""
    policy = f'<meta http-equiv="Content-Security-Policy" content="{POLICY}">'
    name = title.replace("\\", "\\\\").replace('"', '\\"').replace("\n", " ").replace("<", "\\3c ")
    header = f'@page {{ @top-left {{ content: "{name[:80]}" }} }}'
    head = f'<meta charset="utf-8">{policy}<title>{escape(title)}</title><style>{style()}{header}</style>'
    return f'<!DOCTYPE html>\n<html lang="en"><head>{head}</head><body>\n{body}\n</body></html>\n'


def signed(cell: str) -> str:
    """A text with the true minus sign before its numbers."""
    return re.sub(r"(^|\s)([A-Z]?)-(?=\d)", "\\1\\2\N{MINUS SIGN}", cell)


@singledispatch
def written(piece: Piece) -> str:
    """A piece as HTML."""
    raise TypeError(piece)


@written.register
def _(piece: Words) -> str:
    tone = f' class="{piece.tone}"' if piece.tone else ""
    return f"<p{tone}>{escape(piece.text)}</p>"


@written.register
def _(piece: TextTable) -> str:
    rows = [[signed(cell) for cell in row] for row in piece.rows]
    return html_table(piece.head, rows, numbers=piece.numbers, bold=piece.bold)


@written.register
def _(piece: Blanks) -> str:
    return f'<div class="blanks">{html_table((), piece.rows)}</div>'


@written.register
def _(piece: Alarms) -> str:
    return card_html(piece.alarms, QUOTED)


@written.register
def _(piece: Compared) -> str:
    found: str = opened("mnclab.design.difference.export", "record")(piece.difference)
    return found


@written.register
def _(piece: Listing) -> str:
    wide = len(str(len(piece.lines)))
    rows = []
    for number, text, mark in piece.lines:
        line = f'<span class="number">{number:{wide}d}</span>  {escape(text)}'
        rows.append(f'<span class="{mark}">{line}</span>' if mark else line)
    return f'<pre class="listing">{chr(10).join(rows)}</pre>'
