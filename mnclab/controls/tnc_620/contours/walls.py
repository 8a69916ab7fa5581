"""How cycles 27, 28, 29 and 39 go over a cylinder, level by level (9.2 to 9.5); heights are distances from its axis."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import pairwise
from typing import Protocol

import numpy as np

from mnclab.controls.tnc_620.contours.line import Line
from mnclab.controls.tnc_620.contours.surface import Surface
from mnclab.controls.tnc_620.machining.cylinder import (
    Way,
    beside,
    lead,
    linked,
    remachining,
    round_about,
    shrunk,
    slot_round,
    standing,
    way_along,
)
from mnclab.geometry.contours import Contour
from mnclab.machining.milling.clearing import numbered
from mnclab.machining.steps import Step

Ways = Sequence[tuple[str, Way]]
SAME = 1e-6  # mm between the end of a round and its begin


class Depths(Protocol):
    """What the walls ask of a cycle: heights, feeds and the allowance."""

    @property
    def side_allowance(self) -> float: ...
    @property
    def plunge_feed(self) -> float: ...
    @property
    def feed(self) -> float: ...
    @property
    def cylinder_radius(self) -> float: ...
    @property
    def safe(self) -> float: ...
    def levels(self) -> tuple[float, ...]: ...


def over_contour(c: Depths, on: Surface, line: Line, radius: float, height: float) -> Iterator[Step]:
    """27: along the contour, the tool always pointing to the axis; on the contour itself where it has no side."""
    way = way_along(beside(line.contour, line.side * (radius + c.side_allowance), line.steps))
    yield from rounds(c, on, [("contour", way)], height, lifts=True)
    yield on.to("retract", way.last, height)


def along_slot(
    c: Depths, on: Surface, line: Line, shift: float, height: float, straight: bool, tolerance: float
) -> Iterator[Step]:
    """28: with RL forward along the wall on the right and back along the left one, `shift` beside the middle; with RR the other
    way round.

    Where remachining is asked for, more rounds at the floor follow, whose walls take their direction from deeper down.
    """
    distance = -line.side * shift
    ways = slot_round(line.contour, distance, straight, steps=line.steps)
    yield from rounds(c, on, ways, height)
    floor = c.levels()[-1]
    others = remachining(line.contour, distance, c.cylinder_radius, floor, tolerance)
    for name, at in zip(numbered("remachining", len(others)), others, strict=True):
        more = slot_round(shrunk(line.contour, at / c.cylinder_radius), distance, straight, c.cylinder_radius / at)
        yield from through(c, on, more, floor, name)
    yield on.to("retract", ways[-1][1].last, height)


def round_ridge(c: Depths, on: Surface, line: Line, half: float, radius: float, height: float) -> Iterator[Step]:
    """29: round the ridge, `half` as wide as it is, from a place one tool diameter beside it: with RL on the left, with RR on
    the right."""
    distance = line.side * (half + c.side_allowance + radius)
    loop = round_about(line.contour, distance, line.steps)
    gap = line.side * (radius - c.side_allowance)
    yield from with_leads(c, on, loop, way_along(loop, distance), gap, height, straight=False)


def beside_contour(c: Depths, on: Surface, line: Line, radius: float, height: float, straight: bool) -> Iterator[Step]:
    """39: along the wall, from a place one tool diameter beside it."""
    distance = line.side * (radius + c.side_allowance)
    path = beside(line.contour, distance, line.steps)
    yield from with_leads(c, on, path, way_along(path, distance), line.side * (radius - c.side_allowance), height, straight)


def with_leads(
    c: Depths, on: Surface, path: Contour, way: Way, gap: float, height: float, straight: bool
) -> Iterator[Step]:
    """Along a wall path from a place that lies `gap` to the left of its begin (or right), and to that beside its end."""
    there, off = (lead(path, gap, arrives, straight) for arrives in (True, False))
    foot, end = way.feet[0], way.feet[-1]
    ways = linked([("approach", standing(foot, there)), ("wall", way), ("departure", standing(end, off))])
    yield from rounds(c, on, ways, height)
    yield on.to("retract", ways[-1][1].last, height)


def rounds(c: Depths, on: Surface, ways: Ways, height: float, lifts: bool = False) -> Iterator[Step]:
    """On every level through ways that follow each other, the first time from a `height` down.

    A round that ends where it began goes down there, unless it `lifts`; others go back over the surface.
    """
    first, last = ways[0][1], ways[-1][1].last
    gap = np.concatenate([last.feet[0] - first.feet[0], last.shifts[0] - first.shifts[0]])
    stays = not lifts and bool(np.abs(gap).max() < SAME)
    levels = c.levels()
    for k, (name, (above, level)) in enumerate(zip(numbered("level", len(levels)), pairwise((c.safe, *levels)), strict=True)):
        if not (k and stays):
            yield on.to(f"{name}, over the start", first, c.safe if k else height)
            yield on.to(f"{name}, set-up clearance", first, c.safe)
            above = c.safe
        yield on.to(f"{name}, plunge", first, level, c.plunge_feed, above - level)
        yield from through(c, on, ways, level, name)
        if not stays:
            yield on.to(f"{name}, lift", last, c.safe)


def through(c: Depths, on: Surface, ways: Ways, level: float, name: str) -> Iterator[Step]:
    """Through ways at one level."""
    for label, way in ways:
        yield on.along(f"{name}, {label}", way, level, c.feed)
