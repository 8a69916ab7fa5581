"""The way of a tool from one place to another that never leaves an area: straight, and round what stands in between.

            ┌───┐
    a ──────┤   ├────── b         a stretch of the straight way that leaves the area is replaced by the way
            └─►─┘                 along its boundary, on the shorter side

Arcs stay arcs. Lengths in mm.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from mnclab.geometry.contours import Contour, joined
from mnclab.geometry.curves import Floats
from mnclab.geometry.regions import Region, meeting

TOUCH = 1e-6  # mm, within which a place lies on a boundary


def route(area: Region, start: ArrayLike, end: ArrayLike) -> Contour | None:
    """An open contour from start to end, both `(2,)`, in a connected area; None where they are one, or not both in it."""
    a, b = np.asarray(start, dtype=float), np.asarray(end, dtype=float)
    if np.hypot(*(b - a)) <= TOUCH:
        return None
    if area.holds(a, b):
        return Contour([a, b], closed=False)
    met = [_meetings(loop, a, b) for loop in area.loops]
    shares = np.unique(np.concatenate([[0.0, 1.0], *met]))
    pieces: list[Contour] = []
    here = 0.0
    while here < 1:
        beyond = float(shares[shares > here][0])
        if _within(area, a + (here + beyond) / 2 * (b - a)):
            pieces.append(Contour([a + here * (b - a), a + beyond * (b - a)], closed=False))
            here = beyond
            continue
        loops = [k for k, each in enumerate(met) if (each == here).any() and each.max() > here]
        if not loops:
            return None
        k = max(loops, key=lambda k: float(met[k].max()))
        there = float(met[k].max())
        pieces.append(_along(area.loops[k], a + here * (b - a), a + there * (b - a)))
        here = there
    return joined(pieces)


def _meetings(loop: Contour, a: Floats, b: Floats) -> Floats:
    """Fractions of the way from a to b at which it meets a loop; its ends, where they lie on it."""
    found = np.append(meeting(loop, a, b - a), [0.0, 1.0])
    found = found[(found >= 0) & (found <= 1)]
    return np.unique(found[loop.distance(a + found[:, None] * (b - a)) <= TOUCH])


def _within(area: Region, spot: Floats) -> bool:
    return bool(area.contains([spot])[0] or area.distance([spot])[0] <= TOUCH)


def _along(loop: Contour, start: Floats, end: Floats) -> Contour:
    """The shorter way along a loop between two places on it."""
    there, back = loop.nearest(start), loop.nearest(end)
    forward = (back - there) % loop.length
    if 2 * forward <= loop.length:
        return loop.between(there, there + forward)
    return loop.between(back, back + loop.length - forward).reversed()
