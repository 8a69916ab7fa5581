"""How a view shows where a section is taken: a chain line, thick at its ends outside the view, arrows towards it as one
looks, a letter at each (ISO 128-3)."""

from __future__ import annotations

import math
from collections.abc import Iterator
from itertools import product
from typing import NamedTuple

import numpy as np

from mnclab.design.drawing.ink import Arrow, Label, Mark, Stroke
from mnclab.design.drawing.lettering import block
from mnclab.design.drawing.placing import LEADER
from mnclab.design.drawing.view import Cut, Kind
from mnclab.geometry.contours import Contour
from mnclab.geometry.curves import Floats
from mnclab.text.alarm import Alarm

OUT = (6.0, 8.0, 13.5, 20.5, 27.5, 34.5, 41.5, 48.5, 55.5)  # mm from the view to the end of the line: between the rows
ELSE, DEARER = (9.0, 12.0, 16.0, 18.0, 23.0, 25.0, 30.0, 32.0, 37.0, 45.0, 52.0, 59.0), 4.0  # near a row, where there is no room
THICK, SHAFT, STEP = 5.0, 7.0, 3.0  # mm: a thick end, an arrow, thick arms where the line steps
LETTER = 5.0  # mm


class End(NamedTuple):
    """One end of the line of a cut: its corner, the way out of the view, and the distance to where the view ends (mm)."""

    cut: Cut
    corner: Floats
    out: Floats
    way: float


def ends_of(cut: Cut, scale: float, outline: Floats) -> tuple[End, End]:
    """Both ends on paper; `outline` (2, 2) are the bounds of the view there."""
    points = np.array(cut.points, dtype=float).reshape(-1, 2) * scale
    if len(points) < 2 or (np.hypot(*np.diff(points, axis=0).T) == 0).any() or not any(cut.looks):
        raise Alarm(f"the cut {cut.letter} needs two points or more, apart from each other, and a direction")
    found = []
    for corner, inner in ((points[0], points[1]), (points[-1], points[-2])):
        out = (corner - inner) / np.hypot(*(corner - inner))
        some = np.abs(out) > 1e-9
        ways = (np.where(out > 0, outline[1], outline[0]) - corner)[some] / out[some]
        found.append(End(cut, corner, out, max(0.0, float(ways.min()))))
    return found[0], found[1]


def places(end: End) -> Iterator[Mark]:
    """Marks in the order of their costs: near the view, the letter behind the arrow or beside it."""
    looks = np.array(end.cut.looks, dtype=float) / math.hypot(*end.cut.looks)
    letter = block(end.cut.letter, LETTER)
    half = np.array([letter.width / 2, LETTER / 2])
    ways = sorted((0.35 * out + where + DEARER * (out in ELSE), out, where) for out, where in product(OUT + ELSE, (0, 1, 2)))
    for cost, out, where in ways:
        tip = end.corner + (end.way + out) * end.out
        tail = tip - SHAFT * looks
        if where == 0:
            middle = tail - (1.3 + float(np.abs(looks) @ half)) * looks
        else:
            aside = end.out if where == 1 else -end.out
            middle = tail + SHAFT / 3 * looks + (1.5 + float(np.abs(aside) @ half)) * aside
        a, b, begin, edge = (
            (float(p[0]), float(p[1])) for p in (tip, tail, tip - THICK * end.out, tip - (out - 0.5) * end.out)
        )
        mark = Mark(end, cost, [(LEADER, b, a), (LEADER, a, edge)], [Arrow(a, math.atan2(looks[1], looks[0]))])
        mark.labels = [Label(letter, (float(middle[0]) - letter.width / 2, float(middle[1]) - LETTER / 2))]
        mark.places = (a, begin)
        yield mark


def strokes(cut: Cut, scale: float, first: Mark, last: Mark) -> Iterator[Stroke]:
    """The line itself between the ends that were chosen."""
    way = np.array([first.places[0], *(np.array(cut.points) * scale)[1:-1], last.places[0]])
    yield Stroke(Contour(way, closed=False), Kind.CENTRE, "CENTRE")
    for mark in (first, last):
        yield Stroke(Contour(mark.places, closed=False), Kind.VISIBLE, "OUTLINE")
    for before, corner, after in zip(way, way[1:], way[2:]):
        arms = [corner + STEP * (far - corner) / np.hypot(*(far - corner)) for far in (before, after)]
        yield Stroke(Contour([arms[0], corner, arms[1]], closed=False), Kind.VISIBLE, "OUTLINE")
