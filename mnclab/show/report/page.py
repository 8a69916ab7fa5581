"""A document as one HTML page that stands alone: its style sheet and its pictures are in it, and it prints on A4."""

from __future__ import annotations

from functools import singledispatch
from html import escape
from pathlib import Path

from mnclab.show.report.contents import QUOTED, Alarms, Blanks, Compared, Document, Image, Listing, Piece, Table, Words
from mnclab.text.alarm import card_html
from mnclab.text.opening import opened
from mnclab.text.tables import html_table

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
        opened = '<section class="breaks">' if section.breaks else "<section>"
        parts.append(f"{opened}{head}{''.join(pieces)}</section>")
    return page(document.title, "\n".join(parts))


def page(title: str, body: str) -> str:
    """A page with the style sheet of reports; it asks for nothing from elsewhere."""
    policy = f'<meta http-equiv="Content-Security-Policy" content="{POLICY}">'
    name = title.replace("\\", "\\\\").replace('"', '\\"').replace("\n", " ").replace("<", "\\3c ")
    header = f'@page {{ @top-left {{ content: "{name[:80]}" }} }}'
    head = f'<meta charset="utf-8">{policy}<title>{escape(title)}</title><style>{style()}{header}</style>'
    return f'<!DOCTYPE html>\n<html lang="en"><head>{head}</head><body>\n{body}\n</body></html>\n'


@singledispatch
def written(piece: Piece) -> str:
    """A piece as HTML."""
    raise TypeError(piece)


@written.register
def _(piece: Words) -> str:
    tone = f' class="{piece.tone}"' if piece.tone else ""
    return f"<p{tone}>{escape(piece.text)}</p>"


@written.register
def _(piece: Table) -> str:
    return html_table(piece.head, piece.rows, numbers=piece.numbers, bold=piece.bold)


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
