"""Tips: where a straight outside corner reaches farther out than the tool's radius, it may meet another wall.

All other walls must stay clear of the tip, and their vertices of the rows that lead there and on.
"""

from __future__ import annotations

import numpy as np

from mnclab.geometry.boxes import near
from mnclab.geometry.curves import Curves, distance
from mnclab.path.columns import Array, Index
from mnclab.path.compensation.elements import Elements
from mnclab.path.compensation.equidistant import Equidistant
from mnclab.path.compensation.joining import corners, ends, remaining
from mnclab.path.compensation.rules import Compensation
from mnclab.path.kinds import Rule

LEAST = 1e-6  # mm: tips that reach out less are as good as round


def near_tips(found: Equidistant, contour: Index) -> tuple[Index, Index]:
    """Corners c (m,) and walls w (m,) of the same contour that may meet at the tip of the corner."""
    el = found.el
    c = np.flatnonzero((found.rule[:-1] == Rule.OUTSIDE_STRAIGHT) & el.wall[:-1] & el.wall[1:])
    c = c[np.hypot(*(found.end[c] - el.end[c]).T) > el.R[c] + LEAST]
    w = np.flatnonzero(el.wall)
    if not len(c):
        return c, c
    low, high = np.minimum(el.start[w], el.end[w]), np.maximum(el.start[w], el.end[w])
    bulge = np.where(el.arc[w], 2 * np.nan_to_num(el.r[w]), 0.0)[:, None]
    tip, reach = found.end[c], np.hypot(*(found.end[c] - el.end[c]).T)[:, None]
    boxes = np.concatenate([tip - reach, low - bulge]), np.concatenate([tip + reach, high + bulge])
    pairs = [np.empty((2, 0), np.int64), *(np.stack(pair) for pair in near(*boxes, 0.0))]
    a, b = np.concatenate(pairs, axis=1)
    mixed = (a < len(c)) & (b >= len(c))
    corner, wall = c[a[mixed]], w[b[mixed] - len(c)]
    other = (contour[corner] == contour[wall]) & (wall != corner) & (wall != corner + 1)
    return corner[other], wall[other]


def clearance(el: Elements, c: Index, w: Index, radius: Array, rules: Compensation) -> Array:
    """How far walls w (m,) stay from the tool at the tips of corners c (m,), for a radius each; mm beyond the radius.
    Infinite where the corner has no tip for that radius."""
    at = corners(el, c, rules, radius)
    least = distance(at.E, el.curves(w))  # and no vertex of a wall comes near the rows that lead to the tip and on
    for k in (c, c + 1):
        begin, end, _ = ends(el, k, radius, rules)
        r = np.where(el.arc[k], np.abs(el.r[k] - el.s[k] * np.sign(el.sweep[k]) * radius), np.nan)
        _, sweep = remaining(el, k, begin, end, radius)
        row = Curves(begin, end, el.centre[k], r, sweep)
        for vertex in (el.start[w], el.end[w]):
            least = np.minimum(least, distance(vertex, row))
    return np.where(at.rule == Rule.OUTSIDE_STRAIGHT, least - radius, np.inf)
