"""Letters of single strokes for an engraving tool: lines and arcs, drawn for this library.

A glyph is written as strokes between `/`. A stroke is its points `x,y`; a number with a sign between two of them is the
sweep of an arc in degrees, counter-clockwise where it is positive; `dot x,y` is a small circle. The unit is 1/21 of the
height of a capital: x counts from the middle of the letter, the baseline is 0, small letters are 14 high.

The widths are the advance widths of DejaVu Sans (a measure of that face; its outlines are not used here).
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from functools import cache
from typing import NamedTuple

import numpy as np

from mnclab.geometry.contours import Contour
from mnclab.machining.milling.clearing import begin
from mnclab.machining.steps import Along, Go, Step

CAPITAL = 21.0  # height of a capital in the unit of the glyphs
DOT = 0.8  # radius of a dot
EM_CAPITAL = 1493  # height of a capital of DejaVu Sans in its units
LINE = 2384 / EM_CAPITAL  # from one line to the next, in heights of a capital

_WIDTHS = (
    (563, "'"), (569, "ijl"), (604, "IJ"), (651, " ,."), (690, "/:;\\"), (721, "f"), (739, "-"), (799, "()[]"), (803, "t"),
    (821, "!"), (842, "r"), (1024, "*_`"), (1067, "s"), (1075, "z"), (1087, "?"), (1126, "c"), (1141, "L"), (1178, "F"),
    (1186, "k"), (1212, "vxy"), (1235, "P"), (1251, "TY"), (1253, "oöø"), (1255, "aä"), (1260, "e"), (1290, "ß"), (1294, "E"),
    (1298, "hnuü"), (1300, "Sbdgpq"), (1303, "0123456789$"), (1343, "K"), (1401, "AVÄ"), (1403, "XZ"), (1405, "B"),
    (1423, "R"), (1430, "C"), (1499, "UÜ"), (1532, "N"), (1540, "H"), (1577, "D"), (1587, "G"), (1597, "&"), (1612, "OQÖ"),
    (1675, "w"), (1716, "#+<=>"), (1767, "M"), (1946, "%"), (1995, "m"), (2025, "W"), (2048, "@"),
)  # fmt: skip
_UNITS = {c: units for units, characters in _WIDTHS for c in characters}

_BOWL = "5,8.5 +180 -6,8.5 -6,5.5 +180 5,5.5"  # of a, d, g, q, beside a stem at x = 5
_BACK = "-5,5.5 +180 6,5.5 6,8.5 +180 -5,8.5"  # of b and p
GLYPHS = {
    " ": "", "A": "0,21 -8,0 / 0,21 8,0 / -5,7 5,7",
    "B": "-6.5,0 -6.5,21 1.5,21 -180 1.5,11 -6.5,11 / 1.5,11 -180 1.5,0 -6.5,0",
    "C": "6.995,17.25 +150 -7,13.5 -7,7.5 +150 6.995,3.75",
    "D": "-7,0 -7,21 -0.5,21 -90 7.5,13 7.5,8 -90 -0.5,0 -7,0", "E": "6,21 -6,21 -6,0 6,0 / -6,11 4,11",
    "F": "6,21 -5.5,21 -5.5,0 / -5.5,11 4,11", "G": "6.995,17.25 +150 -7,13.5 -7,7.5 +180 8,7.5 8,10.5 2,10.5",
    "H": "-7,0 -7,21 / 7,0 7,21 / -7,11 7,11", "I": "0,21 0,0", "J": "2,21 2,-2 -90 -2,-6",
    "K": "-6,21 -6,0 / 7,21 -6,8 / -1.5,12.5 7.5,0", "L": "-5.5,21 -5.5,0 6,0", "M": "-9,0 -9,21 0,5 9,21 9,0",
    "N": "-7,0 -7,21 7,0 7,21", "O": "8,13 +180 -8,13 -8,8 +180 8,8 8,13", "P": "-6,0 -6,21 1,21 -180 1,10 -6,10",
    "Q": "8,13 +180 -8,13 -8,8 +180 8,8 8,13 / 2,5 8,-2", "R": "-6.5,0 -6.5,21 1,21 -180 1,10 -6.5,10 / 0.5,10 7.5,0",
    "S": "6,21 -1,21 +180 -1,10.5 1,10.5 -180 1,0 -6,0", "T": "-7,21 7,21 / 0,21 0,0",
    "U": "-7,21 -7,7 +180 7,7 7,21", "V": "-8,21 0,0 8,21", "W": "-12,21 -6,0 0,21 6,0 12,21",
    "X": "-7,21 7,0 / 7,21 -7,0", "Y": "-7.5,21 0,11 7.5,21 / 0,11 0,0", "Z": "-7,21 7,21 -7,0 7,0",
    "a": f"5,14 5,0 / {_BOWL}", "b": f"-5,21 -5,0 / {_BACK}", "c": "5.263,11.25 +150 -5,8.5 -5,5.5 +150 5.263,2.75",
    "d": f"5,21 5,0 / {_BOWL}", "e": "-5.5,7 5.5,7 5.5,8.5 +180 -5.5,8.5 -5.5,5.5 +150 4.763,2.75",
    "f": "4,21 +90 0,17 0,0 / -3.5,14 3.5,14", "g": f"5,14 5,-1 -90 0,-6 -4.5,-6 / {_BOWL}",
    "h": "-5.5,21 -5.5,0 / -5.5,8.5 -180 5.5,8.5 5.5,0", "i": "0,14 0,0 / dot 0,19",
    "j": "1,14 1,-2.5 -90 -2.5,-6 / dot 1,19", "k": "-5,21 -5,0 / 5,14 -5,4 / -1.5,7.5 5.5,0", "l": "0,21 0,0",
    "m": "-10,14 -10,0 / -10,9 -180 0,9 0,0 / 0,9 -180 10,9 10,0",
    "n": "-5.5,14 -5.5,0 / -5.5,8.5 -180 5.5,8.5 5.5,0", "o": "6,8 +180 -6,8 -6,6 +180 6,6 6,8",
    "p": f"-5,14 -5,-6 / {_BACK}", "q": f"5,14 5,-6 / {_BOWL}", "r": "-3,14 -3,0 / -3,9 -90 2,14 4,14",
    "s": "4.5,14 -1.5,14 +180 -1.5,7 1.5,7 -180 1.5,0 -4.5,0", "t": "-0.5,20 -0.5,4 +90 3.5,0 / -4,14 4,14",
    "u": "-5.5,14 -5.5,5.5 +180 5.5,5.5 / 5.5,14 5.5,0", "v": "-6,14 0,0 6,14",
    "w": "-9.5,14 -4.75,0 0,14 4.75,0 9.5,14", "x": "-5.5,14 5.5,0 / 5.5,14 -5.5,0",
    "y": "-6,14 0,0 / 6,14 -2.571,-6", "z": "-5.5,14 5.5,14 -5.5,0 5.5,0", "0": "6,15 +180 -6,15 -6,6 +180 6,6 6,15",
    "1": "-4,17 0,21 0,0", "2": "-6,15 -225 4.243,10.757 -6.5,0 6.5,0", "3": "-4.33,18.5 -240 0,11 -240 -4.763,2.75",
    "4": "3.5,0 3.5,21 -7,6 7,6", "5": "5.5,21 -5.5,21 -5.5,13 0,13 -180 0,0 -6,0",
    "6": "3,21 +61.93 -6,6 +180 6,6 +180 -6,6", "7": "-6.5,21 6.5,21 -2,0",
    "8": "0,11.5 +180 0,21 +180 0,11.5 -180 0,0 -180 0,11.5", "9": "-3,0 +61.93 6,15 +180 -6,15 +180 6,15",
    "!": "0,21 0,6 / dot 0,1", "#": "-2,21 -5,0 / 5,21 2,0 / -9,14 9,14 / -9,7 9,7",
    "$": "6,18 -1,18 +180 -1,10.5 1,10.5 -180 1,3 -6,3 / 0,21 0,0",
    "%": "-3.5,17.5 +180 -10.5,17.5 +180 -3.5,17.5 / 10.5,3.5 +180 3.5,3.5 +180 10.5,3.5 / 8,21 -8,0",
    "&": "9,0 -4,15 -225 2.5,16.5 -6,6.5 +180 7,6.5 7.5,9", "'": "0,21 0,15", "(": "2.5,23 +80 2.5,-3",
    ")": "-2.5,23 -80 -2.5,-3", "*": "0,21 0,10 / -4.763,18.25 4.763,12.75 / -4.763,12.75 4.763,18.25",
    "+": "0,16 0,2 / -7,9 7,9", ",": "0,1.5 -2,-4", "-": "-3.5,9 3.5,9", ".": "dot 0,1", "/": "4,21 -4,-2",
    ":": "dot 0,13 / dot 0,1", ";": "dot 0,13 / 0,1.5 -2,-4", "<": "8,16 -8,9 8,2", "=": "-8,12 8,12 / -8,6 8,6",
    ">": "-8,16 8,9 -8,2", "?": "-5,16 -225 3.536,12.464 +45 1.192,6.808 1.192,5.5 / dot 1.192,1",
    "@": "5,9 +180 -5,9 +180 5,9 / 5,14 5,6.5 +180 11,6.5 11,9 +180 -11,9 +120 5.5,-0.526",
    "[": "2.5,23 -2.5,23 -2.5,-3 2.5,-3", "\\": "-4,21 4,-2", "]": "-2.5,23 2.5,23 2.5,-3 -2.5,-3", "_": "-7,-3 7,-3",
    "`": "-2,21 2,17", "ß": "-6,0 -6,15.5 -180 5,15.5 -90 0.5,11 -180 0.5,0 -2.5,0",
    "ø": "6,8 +180 -6,8 -6,6 +180 6,6 6,8 / -6,-1 6,15",
}  # fmt: skip
GLYPHS |= {umlaut: f"{GLYPHS[letter]} / dot -3,18.5 / dot 3,18.5" for umlaut, letter in zip("äöü", "aou", strict=True)}
GLYPHS |= {umlaut: f"{GLYPHS[letter]} / dot -4,24.5 / dot 4,24.5" for umlaut, letter in zip("ÄÖÜ", "AOU", strict=True)}


def width(character: str) -> float:
    """The width of a character of height 1: how far it is to the next one."""
    return _UNITS[character] / EM_CAPITAL


@cache
def strokes(character: str) -> tuple[Contour, ...]:
    """The strokes of a character of height 1: x from its middle, y from the baseline."""
    return tuple(_stroke(text.split()) for text in GLYPHS[character].split(" / ") if text.strip())


def _stroke(tokens: list[str]) -> Contour:
    if tokens[0] == "dot":
        x, y = _point(tokens[1])
        east, west = (x + DOT / CAPITAL, y), (x - DOT / CAPITAL, y)
        return Contour([east, west, east], [1.0, 1.0, 0.0], closed=False)
    points, bulge = [], []
    for token in tokens:
        if "," in token:
            points.append(_point(token))
            bulge.append(0.0)
        else:
            bulge[-1] = math.tan(math.radians(float(token)) / 4)
    return Contour(np.array(points), bulge, closed=False)


def _point(text: str) -> tuple[float, float]:
    x, y = map(float, text.split(","))
    return x / CAPITAL, y / CAPITAL


# Texts as strokes of an engraving tool: characters beside each other on a line or round a circle. Lengths in mm, angles in rad.
# Everything counts from the point of the text at which the tool stands: the reference.
#     6 ──── 5 ──── 4        on a line the box of the text: its first line, from the baseline to the height of a capital;
#     │ T  e  x  t │         on an arc the same points along the circle, and 0 its centre.
#     1 ──── 2 ──── 3

NEW_LINE, TAB, DOWN = "\n", "\t", "\v"
TAB_WIDTH = 8  # spaces
SHARE = {0: 0.0, 1: 0.0, 6: 0.0, 2: 0.5, 5: 0.5, 3: 1.0, 4: 1.0}  # of the length, where the reference is
TOP = (4, 5, 6)


class Cell(NamedTuple):
    """A character: where it begins on its line, how wide it is (both for a height of 1), and the number of its line."""

    character: str
    pen: float
    width: float
    line: int


class Glyph(NamedTuple):
    """A character in its place: the middle of its baseline, (2,), and the angle of the baseline, rad."""

    cell: Cell
    x: float
    y: float
    angle: float


def cells(characters: Sequence[str], spacing: float = 0.0) -> list[Cell]:
    """Where characters of height 1 stand; `spacing` widens every step, 0 is the natural one."""
    found, pen, line = [], 0.0, 0
    for character in characters:
        if character == NEW_LINE:
            pen, line = 0.0, line + 1
        elif character == DOWN:
            line += 1
        elif character == TAB:
            pen += TAB_WIDTH * width(" ")
        else:
            found.append(Cell(character, pen, width(character), line))
            pen += width(character) * (1 + spacing)
    return found


def length(row: Sequence[Cell]) -> float:
    """How long the longest line is, for a height of 1; the last character has no space behind it."""
    return max((cell.pen + cell.width for cell in row), default=0.0)


def on_line(row: Sequence[Cell], height: float, reference: int, angle: float) -> list[Glyph]:
    """Characters on straight lines at an angle."""
    rx, ry = SHARE[reference] * length(row) * height, height if reference in TOP else 0.0
    c, s = math.cos(angle), math.sin(angle)
    found = []
    for cell in row:
        x, y = (cell.pen + cell.width / 2) * height - rx, -cell.line * LINE * height - ry
        found.append(Glyph(cell, c * x - s * y, s * x + c * y, angle))
    return found


def on_arc(row: Sequence[Cell], height: float, reference: int, angle: float, radius: float, sense: int) -> list[Glyph]:
    """Characters round a circle: `sense` -1 clockwise with their tops outwards, 1 counter-clockwise with their tops inwards.

    `angle` is where the reference lies, seen from the centre. Raises ValueError where a line has no radius left.
    """
    first = angle - sense * SHARE[reference] * length(row) * height / radius
    away = 0.0 if reference == 0 else radius - sense * height if reference in TOP else radius
    cx, cy = -away * math.cos(angle), -away * math.sin(angle)
    found = []
    for cell in row:
        r = radius + sense * cell.line * LINE * height
        if r <= 0:
            raise ValueError(f"line {cell.line + 1} of the text has no radius left")
        phi = first + sense * (cell.pen + cell.width / 2) * height / r
        found.append(Glyph(cell, cx + r * math.cos(phi), cy + r * math.sin(phi), phi + sense * math.pi / 2))
    return found


def drawn(glyph: Glyph, height: float) -> list[Contour]:
    """The strokes of a character in its place."""
    c, s = math.cos(glyph.angle), math.sin(glyph.angle)
    turn = height * np.array([(c, s), (-s, c)])
    return [
        Contour(stroke.points @ turn + (glyph.x, glyph.y), stroke.bulge, closed=False)
        for stroke in strokes(glyph.cell.character)
    ]


def engrave(
    glyphs: Sequence[Glyph], height: float, *, above: float, floor: float, plunge: float | None, feed: float | None
) -> Iterator[Step]:
    """Stroke by stroke: over its start at rapid, down to the floor, along it, and up to the clearance level again."""
    for glyph in glyphs:
        name = repr(glyph.cell.character)
        for contour in drawn(glyph, height):
            x, y = begin(contour).tolist()
            yield Go(f"over {name}", x=x, y=y)
            yield Go("to the clearance level", above)
            yield Go("plunge", floor, plunge)
            yield Along(f"engrave {name}", contour, feed)
            yield Go("lift", above)
