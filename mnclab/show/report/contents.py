"""What a printed page is made of: sections, and in them words, tables, pictures, alarms and listings.

It is data alone; `show.report.page` writes it as HTML, `show.plot.pages` sets it on A4.
"""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import dataclass, field
from typing import Any, NamedTuple

from mnclab.text.alarm import Alarm

Row = Sequence[str]
GOOD, BAD = "good", "bad"
QUOTED = 84  # characters of a quoted line of a program


class Words(NamedTuple):
    """A paragraph; its `tone` is "good", "bad" or nothing."""

    text: str
    tone: str = ""


class Table(NamedTuple):
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


Piece = Words | Table | Blanks | Image | Alarms | Listing | Compared


class Section(NamedTuple):
    """Pieces under a title; with `breaks` it begins a page of its own."""

    title: str
    pieces: Sequence[Piece]
    breaks: bool = False


@dataclass(frozen=True)
class Document:
    """A title and a line below it, which head every page, and what follows."""

    title: str
    subtitle: str
    sections: Sequence[Section] = field(default_factory=tuple)
