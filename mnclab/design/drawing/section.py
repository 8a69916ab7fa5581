"""Where a section goes through a part, and how a view shows it.

It goes straight through as many features as possible, in steps where that shows more.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from itertools import product
from typing import NamedTuple

import numpy as np

from mnclab.design.drawing.ink import Arrow, Label, Mark, Stroke, block
from mnclab.design.drawing.placing import LEADER
from mnclab.design.drawing.projection import Step
from mnclab.design.drawing.view import Cut, Kind, Point
from mnclab.geometry.contours import Contour
from mnclab.geometry.curves import Floats
from mnclab.text.alarm import Alarm

FAR = 1e6  # mm, beyond every part
BESIDE = 1.0  # mm of material that a step needs beside a feature
MOST_STEPS = 2  # stations away from the straight plane
WORTH = 2.0  # of a feature for which the plane steps aside
SPOILT = 1.0  # what it costs to cut a feature beside its axis
SAME = 1e-6  # mm


class Item(NamedTuple):
    """A feature that a section can show: from `begin` to `end` along the plane, if its depth is from `low` to `high`."""

    key: tuple[bool, int]
    begin: float
    end: float
    low: float
    high: float
    reach: tuple[float, float]
    worth: float

    def shown_at(self, depth: float) -> bool:
        return self.low - SAME <= depth <= self.high + SAME

    def spoilt_at(self, depth: float) -> bool:
        return not self.shown_at(depth) and self.reach[0] < depth < self.reach[1]


class Plane(NamedTuple):
    """A cutting plane in steps, and the features that it shows."""

    steps: tuple[Step, ...]
    shows: frozenset[tuple[bool, int]]

    def way(self, low: float, high: float) -> tuple[Point, ...]:
        """Its corners between two edges of a view."""
        points: list[Point] = []
        for step in self.steps:
            ends = [(max(step.begin, low), step.depth), (min(step.end, high), step.depth)]
            points += ends if not points or abs(points[-1][1] - step.depth) > SAME else ends[1:]
            if len(points) > 2 and abs(points[-2][1] - points[-1][1]) < SAME and abs(points[-3][1] - points[-1][1]) < SAME:
                del points[-2]
        return tuple(points)


def chosen(items: Sequence[Item]) -> Plane | None:
    """The plane that shows the most; None where there is nothing to show."""
    if not items:
        return None

    def score(depth: float) -> float:
        spoilt = sum(SPOILT for each in items if each.spoilt_at(depth))
        return sum(each.worth for each in items if each.shown_at(depth)) - spoilt

    depths = sorted({(each.low + each.high) / 2 for each in items})
    middle = sum(depths) / len(depths)
    base = max(depths, key=lambda depth: (round(score(depth), 6), -abs(depth - middle)))
    stations = [(each.begin, each.end, base, each.key) for each in items if each.shown_at(base)]
    aside = 0
    for each in sorted(items, key=lambda item: (-item.worth, item.begin)):
        if aside == MOST_STEPS or each.worth < WORTH or each.shown_at(base):
            continue
        if all(each.end + BESIDE < begin or end + BESIDE < each.begin for begin, end, _, _ in stations):
            stations.append((each.begin, each.end, (each.low + each.high) / 2, each.key))
            aside += 1
    stations.sort()
    steps, begin, end = list[Step](), -FAR, -FAR
    for k, (_, until, depth, _) in enumerate(stations):
        end = max(end, until)
        last = k == len(stations) - 1
        if not last and abs(stations[k + 1][2] - depth) < SAME:
            continue
        until = FAR if last else (end + stations[k + 1][0]) / 2
        steps.append(Step(begin, until, depth))
        begin = until
    return Plane(tuple(steps), frozenset(key for *_, key in stations))


# How a view shows it: a chain line, thick at its ends outside the view, arrows towards it as one
# looks, a letter at each (ISO 128-3).

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


def letter_places(end: End) -> Iterator[Mark]:
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
