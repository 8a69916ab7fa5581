"""The paper: sizes and frame by ISO 5457, scales by ISO 5455, what stands in the title block (ISO 7200) and beside it."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from mnclab.design.drawing.ink import ASCENT, HEIGHT, PITCH, SMALL, Label, Stroke, block, width_of
from mnclab.design.drawing.view import Kind
from mnclab.geometry.contours import Contour
from mnclab.geometry.curves import Floats
from mnclab.text.alarm import Alarm
from mnclab.text.file import printable

LEFT, MARGIN = 20.0, 10.0  # mm between the edge of the paper and the frame: on the left, on the other sides
SCALES = (50.0, 20.0, 10.0, 5.0, 2.0, 1.0, 1 / 2, 1 / 5, 1 / 10, 1 / 20, 1 / 50, 1 / 100)


class Size(NamedTuple):
    """A size of paper, mm."""

    name: str
    width: float
    height: float


SIZES = {
    "A4": Size("A4", 210.0, 297.0),
    "A4 landscape": Size("A4", 297.0, 210.0),
    "A3": Size("A3", 420.0, 297.0),
    "A2": Size("A2", 594.0, 420.0),
}


def scale_text(scale: float) -> str:
    """A scale as it is written: 2:1, 1:5."""
    return f"{scale:g}:1" if scale >= 1 else f"1:{1 / scale:g}"


@dataclass(frozen=True)
class Title:
    """What the title block says; an empty text leaves its field out or blank.

    `tolerance` is the general tolerance for dimensions without one.
    """

    title: str
    number: str = ""
    material: str = ""
    tolerance: str = "ISO 2768-m"
    date: str = ""
    drawn: str = ""
    owner: str = ""


@dataclass(frozen=True)
class Table:
    """A table beside the views, of holes for instance: a head and rows of texts, all of one length."""

    title: str
    head: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]

    def __post_init__(self) -> None:
        for row in self.rows:
            if len(row) != len(self.head):
                raise Alarm(f"a row of the table {self.title!r} must have {len(self.head)} texts, got {len(row)}")


# What is printed on every sheet: the frame with its centring marks, the title block, tables.
#
# +-------------------------------------------------------+
# | owner          | title                     | number   |   24 mm, without the left field where it would be empty
# | drawn  | date  |                           |          |
# | material | general tolerances | unit | scale | ⊲◎ | size | sheet |   10 mm, 180 mm wide
# +-------------------------------------------------------+

WIDTH, FOOT, HEAD, BESIDE = 180.0, 10.0, 24.0, 60.0  # mm: of the title block, its lower and upper row, the field on the left
TINY = 1.8  # mm, letters of the names of fields
LETTERS = (5.0, HEIGHT, SMALL, TINY)
LARGE = ("owner", "title", "drawing number")  # fields with the largest letters
NAME = 3.2  # mm above a field's text, for the name of the field
CENTRING = 3.0  # mm by which centring marks reach into the frame: less than anything else keeps away from it
CELL, TALL = 4.0, 2.0  # mm of a table: room beside a text, above and below it


class Printed(NamedTuple):
    """Strokes and texts that stand in a box (x0, y0, x1, y1) of the paper."""

    strokes: list[Stroke]
    labels: list[Label]
    box: tuple[float, float, float, float]


class Field(NamedTuple):
    """A field of the title block: its name, what it says, its corner, width and height (mm)."""

    name: str
    text: str
    x: float
    y: float
    width: float
    height: float


def line(x0: float, y0: float, x1: float, y1: float, kind: Kind = Kind.THIN) -> Stroke:
    """A straight line of the frame."""
    return Stroke(Contour([(x0, y0), (x1, y1)], closed=False), kind, "FRAME")


def rectangle(x0: float, y0: float, x1: float, y1: float, kind: Kind = Kind.FRAME) -> Stroke:
    """A rectangle of the frame."""
    return Stroke(Contour([(x0, y0), (x1, y0), (x1, y1), (x0, y1)]), kind, "FRAME")


def inside(size: Size) -> tuple[float, float, float, float]:
    """The frame (x0, y0, x1, y1) of a sheet."""
    return LEFT, MARGIN, size.width - MARGIN, size.height - MARGIN


def frame(size: Size) -> Printed:
    """The frame, and marks in the middle of its sides."""
    x0, y0, x1, y1 = inside(size)
    x, y = size.width / 2, size.height / 2
    strokes = [rectangle(x0, y0, x1, y1)]
    strokes += [line(x, y1 - CENTRING, x, size.height - 5, Kind.FRAME), line(x, 5, x, y0, Kind.FRAME)]
    strokes += [line(5, y, x0 + CENTRING, y, Kind.FRAME), line(x1 - CENTRING, y, size.width - 5, y, Kind.FRAME)]
    return Printed(strokes, [], (x0, y0, x1, y1))


def title_block(title: Title, size: Size, scale: float, number: int, of: int) -> Printed:
    """The title block in the lower right corner of the frame."""
    _, y, right, _ = inside(size)
    x = right - WIDTH
    strokes = [rectangle(x, y, right, y + FOOT + HEAD)]
    labels = list[Label]()
    for field in _fields(title, size, scale, number, of, x, y):
        kind = Kind.THIN
        strokes.append(rectangle(field.x, field.y, field.x + field.width, field.y + field.height, kind))
        labels += _written(field)
        if field.name == "projection":
            strokes += first_angle(field.x + field.width / 2, field.y + (FOOT - NAME) / 2)
    return Printed(strokes, labels, (x, y, right, y + FOOT + HEAD))


def _fields(title: Title, size: Size, scale: float, number: int, of: int, x: float, y: float) -> Iterator[Field]:
    foot = (
        ("material", title.material, 48.0),
        ("general tolerances", title.tolerance, 40.0),
        ("dimensions in", "mm", 22.0),
        ("scale", scale_text(scale), 20.0),
        ("projection", "", 22.0),
        ("size", size.name.partition(" ")[0], 13.0),
        ("sheet", f"{number}/{of}", 15.0),
    )
    at = x
    for name, text, width in foot:
        yield Field(name, text, at, y, width, FOOT)
        at += width
    y, at, width = y + FOOT, x, WIDTH
    people = [(name, text) for name, text in (("drawn by", title.drawn), ("date", title.date)) if text]
    if people or title.owner:
        low = HEAD / 3 if people and title.owner else (HEAD if people else 0.0)
        for k, (name, text) in enumerate(people):
            yield Field(name, text, at + k * BESIDE / len(people), y, BESIDE / len(people), low)
        if title.owner:
            yield Field("owner", title.owner, at, y + low, BESIDE, HEAD - low)
        at, width = at + BESIDE, width - BESIDE
    apart = 45.0 if title.number else 0.0
    yield Field("title", title.title, at, y, width - apart, HEAD)
    if title.number:
        yield Field("drawing number", title.number, at + width - apart, y, apart, HEAD)


def _written(field: Field) -> Iterator[Label]:
    """The name of a field small in its corner, and its text as large as there is room, in several lines if need be."""
    x, y, name = field.x + 1.2, field.y, block(field.name, TINY)
    yield Label(name, (x, y + field.height - 0.8 - TINY * ASCENT))
    top = field.height - NAME
    lines, height = fitted(field.text, field.width - 2.4, top, LETTERS if field.name in LARGE else LETTERS[1:])
    below = (top - height * (PITCH * len(lines) + 1 - PITCH)) / 2
    for k, text in enumerate(reversed(lines)):
        yield Label(block(text, height), (x, y + below + k * PITCH * height))


def fitted(text: str, width: float, height: float, sizes: tuple[float, ...] = LETTERS) -> tuple[list[str], float]:
    """The lines of a text in a box, and the height of the letters; what does not fit into the smallest ends with "…"."""
    words = printable(text).split()
    if not words:
        return [], TINY
    for letters in sizes:
        lines = _lines(words, width, letters)
        most = max(1, int((height - 1.5 * letters) / (PITCH * letters) + 1 + 1e-9))
        if 1.5 * letters <= height and len(lines) <= most and all(width_of(each, letters) <= width for each in lines):
            return lines, letters
    kept = _lines(words, width, TINY)[: max(1, int(height / (PITCH * TINY)))]
    last = kept[-1]
    while last and width_of(last + "…", TINY) > width:
        last = last[:-1]
    return [*(each for each in kept[:-1] if width_of(each, TINY) <= width), last + "…"], TINY


def _lines(words: list[str], width: float, height: float) -> list[str]:
    lines = [words[0]]
    for word in words[1:]:
        longer = f"{lines[-1]} {word}"
        if width_of(longer, height) <= width:
            lines[-1] = longer
        else:
            lines.append(word)
    return lines


def first_angle(x: float, y: float) -> list[Stroke]:
    """The sign of the first-angle projection (ISO 5456-2): a cone from the side, and beside it from its small end."""
    left, right = x - 4.2, x + 4.2
    small, large, half = 1.0, 2.0, 2.5
    cone = [(left - half, y - small), (left + half, y - large), (left + half, y + large), (left - half, y + small)]
    strokes = [Stroke(Contour(cone), Kind.THIN, "FRAME")]
    strokes += [Stroke(Contour.circle((right, y), radius), Kind.THIN, "FRAME") for radius in (small, large)]
    axis = (2.0, 0.5, 0.4, 0.5)
    for x0, y0, x1, y1 in (
        (left - half - 0.8, y, left + half + 0.8, y),
        (right - large - 0.8, y, right + large + 0.8, y),
        (right, y - large - 0.8, right, y + large + 0.8),
    ):
        strokes.append(Stroke(Contour([(x0, y0), (x1, y1)], closed=False), Kind.CENTRE, "FRAME", axis))
    return strokes


def table(given: Table) -> Printed:
    """A table with its lower left corner at (0, 0): title, head and rows."""
    height = HEIGHT if len(given.rows) <= 12 else SMALL
    rows = [given.head, *given.rows]
    texts = [[block(printable(text), height) for text in row] for row in rows]
    widths = [max(row[k].width for row in texts) + CELL for k in range(len(given.head))]
    step = height + 2 * TALL
    title = block(printable(given.title), height)
    if title.width + CELL > sum(widths):
        widths[-1] += title.width + CELL - sum(widths)
    ends: Floats = np.cumsum([0.0, *widths])
    right, top = float(ends[-1]), step * len(rows)
    strokes = [rectangle(0.0, 0.0, right, top, Kind.VISIBLE)]
    strokes += [line(0.0, step * k, right, step * k) for k in range(1, len(rows))]
    strokes += [line(x, 0.0, x, top) for x in ends[1:-1].tolist()]
    labels = [
        Label(text, (float(ends[k]) + CELL / 2, top - step * (n + 1) + TALL))
        for n, row in enumerate(texts)
        for k, text in enumerate(row)
    ]
    labels.append(Label(title, (CELL / 2, top + TALL)))
    return Printed(strokes, labels, (0.0, 0.0, right, top + step))
