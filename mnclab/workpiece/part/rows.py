"""Whether a probe meets the part on a straight row where it should not: its ball, or the stem above it."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from mnclab.text.given import check_number, check_point
from mnclab.workpiece.part.part import Floats, Part
from mnclab.workpiece.part.shapes import unit
from mnclab.workpiece.part.touching import contact

RESTING = 1e-4  # mm: a ball that is no deeper in the material only rests on it
FINE = 0.01  # mm, within which the place of a stem is told
CORNERS = np.array([(-1, -1), (-1, 1), (1, -1), (1, 1)]) / 2  # of a quarter of a cell


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
    found = contact(part, origin, way if reach else (0, 0, 1), max(ball - RESTING, 0.0), reach)
    if stem and length:
        far = reach if found is None else found
        ahead = way / reach if reach else np.zeros(3)
        by_stem = _met(part, origin, ahead, far, unit(up, "the direction of a stem") * length, stem)
        found = found if by_stem is None else by_stem
    return found


def _met(part: Part, origin: Floats, ahead: Floats, reach: float, axis: Floats, radius: float) -> float | None:
    """How far a stem goes before it meets the part, within `FINE`; None within `reach` if it does not.

    The row times the stem is an area; of a cell of it nothing touches if the middle is farther off the part than the corners
    are from the middle, else it is looked at in quarters.
    """
    halves = np.array([max(reach, FINE), 1.0]) / 2  # of the way, mm, and of the stem
    cells, first = halves[None], np.inf
    while len(cells):
        gaps = (part(origin + cells[:, :1] * ahead + cells[:, 1:] * axis) - radius) / part.steep
        met = gaps < -RESTING
        first = min(first, float(cells[met, 0].min(initial=np.inf)))
        wide = max(float(np.linalg.norm(halves[0] * ahead + sign * halves[1] * axis)) for sign in (1, -1))
        if wide < FINE:
            break
        cells = cells[(gaps <= wide) & (cells[:, 0] - halves[0] < first)]
        cells = (cells[:, None] + CORNERS * halves).reshape(-1, 2)
        halves = halves / 2
    return float(np.clip(first, 0.0, reach)) if np.isfinite(first) else None
