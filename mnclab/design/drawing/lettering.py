"""Texts of a drawing: how wide they are, and how a value with its tolerance is set.

The letters are DejaVu Sans, which matplotlib brings along, 3.5 mm high (the height of capitals, ISO 3098), tolerances one
above the other and small texts 2.5 mm. Signs that this face lacks are drawn with strokes. All in mm; a text begins at
(0, 0) on its baseline.
"""

from __future__ import annotations

import re
from functools import cache
from typing import NamedTuple

from matplotlib.font_manager import FontProperties
from matplotlib.textpath import text_to_path

from mnclab.design.drawing.dimensions import Value
from mnclab.geometry.contours import Contour

HEIGHT, SMALL = 3.5, 2.5
FACE = "DejaVu Sans"
CAPITAL = 1493 / 2048  # height of a capital of the face, in its size
DESCENT, ASCENT = 0.24, 1.08  # of the height: how far letters go below the baseline; brackets and signs above it
PITCH = 1.6  # of the height: from line to line
STACKED = 3.3  # mm, from the lower deviation to the upper one

SIGNS: dict[str, tuple[Contour, ...]] = {  # strokes in a square of 1, as high as a capital
    "\N{COUNTERBORE}": (Contour([(0.08, 0.85), (0.08, 0.05), (1.02, 0.05), (1.02, 0.85)], closed=False),),
    "\N{COUNTERSINK}": (Contour([(0.05, 0.9), (0.55, 0.05), (1.05, 0.9)], closed=False),),
    "\N{DOWNWARDS ARROW FROM BAR}": (
        Contour([(0.1, 1.0), (0.9, 1.0)], closed=False),
        Contour([(0.5, 1.0), (0.5, 0.02)], closed=False),
        Contour([(0.2, 0.4), (0.5, 0.02), (0.8, 0.4)], closed=False),
    ),
}
SIGN_WIDTH = 1.2  # with the room to the next letter
_RUNS = re.compile(f"([{''.join(SIGNS)}])")


class Piece(NamedTuple):
    """A run of letters or one drawn sign, at (x, y) from the start of its text."""

    text: str
    x: float
    y: float
    height: float

    @property
    def strokes(self) -> tuple[Contour, ...]:
        """The strokes of a sign that is drawn, in squares of the height; of letters there are none."""
        return SIGNS.get(self.text, ())


class Block(NamedTuple):
    """One line of text as it is set: its pieces, and the box around them (`low` is below the baseline)."""

    pieces: tuple[Piece, ...]
    width: float
    low: float
    high: float

    @property
    def text(self) -> str:
        return "".join(piece.text for piece in self.pieces)


@cache
def width_of(text: str, height: float = HEIGHT) -> float:
    """How wide a run of letters is, mm."""
    size = FontProperties(family=FACE, size=100)
    return float(text_to_path.get_text_width_height_descent(text, size, ismath=False)[0]) * height / CAPITAL / 100


@cache
def block(text: str, height: float = HEIGHT) -> Block:
    """A plain text as it is set."""
    pieces, x = [], 0.0
    for run in filter(None, _RUNS.split(text)):
        pieces.append(Piece(run, x, 0.0, height))
        x += SIGN_WIDTH * height if run in SIGNS else width_of(run, height)
    return Block(tuple(pieces), x, -DESCENT * height, ASCENT * height)


@cache
def value_block(value: Value, height: float = HEIGHT) -> Block:
    """A dimension's value: its text, its tolerance behind it, its deviations one above the other."""
    opening, closing = ("(", ")") if value.reference else ("", "")
    behind = f"\N{THIN SPACE}{value.tolerance}" if value.tolerance else ""
    if value.limits is None:
        return block(f"{opening}{value.text}{behind}{closing}", height)
    small = height * SMALL / HEIGHT
    first = block(f"{opening}{value.text}{behind}", height)
    middle, x = 0.5 * height, first.width + 0.35 * height
    centre = STACKED / HEIGHT * height / 2
    above = Piece(value.limits[0], x, middle + centre - small / 2, small)
    below = Piece(value.limits[1], x, middle - centre - small / 2, small)
    x += max(width_of(each, small) for each in value.limits)
    pieces = [*first.pieces, above, below]
    if closing:
        pieces.append(Piece(closing, x, 0.0, height))
        x += width_of(closing, height)
    low = min(first.low, below.y - DESCENT * small)
    return Block(tuple(pieces), x, low, max(first.high, above.y + small))
