"""Whether a probe meets the part on a straight row where it should not: its ball, or the stem above it."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from mnclab.text.given import check_number, check_point
from mnclab.workpiece.part.part import Floats, Part
from mnclab.workpiece.part.shapes import unit

RESTING = 1e-3  # mm: a ball that is no deeper in the material only rests on it
FINE = 0.01  # mm, within which a place is told
AT_FIRST = 6  # times that all is halved before anything is looked at


def blocked(
    part: Part, start: ArrayLike, end: ArrayLike, ball: float, stem: float = 0.0, length: float = 0.0,
    up: ArrayLike = (0.0, 0.0, 1.0),
) -> float | None:  # fmt: skip
    """How far a ball of a radius gets from start to end, (x, y, z) of its centre, before it meets the part; None if it never
    does. So does its `stem`, a cylinder of that radius and `length` from the centre of the ball `up`."""
    for place, name in ((start, "the start of a row"), (end, "the end of a row"), (up, "the direction of a stem")):
        check_point(place, name)
    check_number(ball, "the radius of a ball", above=0)
    check_number(stem, "the radius of a stem", at_least=0)
    check_number(length, "the length of a stem", at_least=0)
    origin, way = np.asarray(start, dtype=float), np.asarray(end, dtype=float) - np.asarray(start, dtype=float)
    reach = float(np.linalg.norm(way))
    ahead, axis = way / reach if reach else np.zeros(3), unit(up, "the direction of a stem") * length
    found = _met(part, origin, ahead, reach, np.zeros(3), ball)
    by_stem = _met(part, origin, ahead, reach if found is None else found, axis, stem) if stem and length else None
    return found if by_stem is None else by_stem


def _met(part: Part, origin: Floats, ahead: Floats, reach: float, axis: Floats, radius: float) -> float | None:
    """How far all that is no farther than a radius from an axis (3,) goes before it meets the part; None within `reach` if it
    never does.

    The row times the axis is an area; of a cell of it nothing touches if the middle is farther off the part than the corners
    are from the middle, else it is looked at in halves, cut across its longer side.
    """
    halves = np.array([max(reach, FINE), float(axis.any())]) / 2  # of the way, mm, and of the axis
    sides, cells, first = np.array([1.0, float(np.linalg.norm(axis))]), halves[None], np.inf
    for _ in range(AT_FIRST):
        cells, halves = _halved(cells, halves, sides)
    while len(cells):
        wide = max(float(np.linalg.norm(halves[0] * ahead + sign * halves[1] * axis)) for sign in (1, -1))
        middles = origin + cells[:, :1] * ahead + cells[:, 1:] * axis
        beside = np.maximum(np.maximum(part.bounds[0] - middles, middles - part.bounds[1]), 0.0)  # the box around the part
        near = (beside**2).sum(axis=1) <= (radius + wide) ** 2
        cells, gaps = cells[near], (part(middles[near]) - radius) / part.steep if near.any() else np.zeros(0)
        met = gaps < -RESTING
        first = min(first, float(cells[met, 0].min(initial=np.inf)))
        if wide < FINE:
            break
        cells, halves = _halved(cells[(gaps <= wide) & (cells[:, 0] - halves[0] < first)], halves, sides)
    return float(np.clip(first, 0.0, reach)) if np.isfinite(first) else None


def _halved(cells: Floats, halves: Floats, sides: Floats) -> tuple[Floats, Floats]:
    """The middles (2 n, 2) and the halves (2,) of the cells (n, 2) after a cut; `sides` are mm for each unit of a half."""
    half = halves * (halves * sides == (halves * sides).max()) / 2
    if half.all():  # as long as wide
        half[1] = 0.0
    return (cells[:, None] + half * [[-1], [1]]).reshape(-1, 2), halves - half
