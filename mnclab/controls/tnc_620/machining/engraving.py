"""Texts as strokes of an engraving tool: characters beside each other on a line or round a circle. Lengths in mm, angles in rad.

Everything counts from the point of the text at which the tool stands: the reference.

    6 ──── 5 ──── 4        on a line the box of the text: its first line, from the baseline to the height of a capital;
    │ T  e  x  t │         on an arc the same points along the circle, and 0 its centre.
    1 ──── 2 ──── 3
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import NamedTuple

import numpy as np

from mnclab.controls.tnc_620.machining.letters import LINE, strokes, width
from mnclab.geometry.contours import Contour
from mnclab.machining.milling.clearing import begin
from mnclab.machining.steps import Along, Go, Step

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
