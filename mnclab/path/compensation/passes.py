"""What a contour says about walls that it does not leave standing: contours run past their start, several passes at one level.

A contour that is run past its start crosses its own beginning. Where it does so at an outside corner both tails lie in the
air beside the part: a tool that cuts across a tail cuts nothing. And a wall through which the contour itself is led later
stands no more, whatever the size of the tool: the next pass of a roughing, say, that leaves the last one by a loop and
comes back through it.
"""

from __future__ import annotations

import numpy as np

from mnclab.geometry.boxes import near
from mnclab.geometry.curves import Curves, crossings, share
from mnclab.geometry.offsets import cross
from mnclab.path.compensation.elements import Array, Elements, Index, Mask
from mnclab.path.compensation.heights import meet

ENDS = 1e-6  # mm: a crossing so near to an end of an element is its joint
ALONG = 1e-6  # rad: elements that meet at a smaller angle touch


def run_past(el: Elements, i: Index, j: Index) -> Mask:
    """Whether elements i and j (m,) cross, or touch with an end, as at an outside corner from the later to the earlier."""
    first, last = np.minimum(i, j), np.maximum(i, j)
    one, two = el.curves(first), el.curves(last)
    result = np.zeros(len(first), dtype=bool)
    for p in crossings(one, two):
        turn = cross(_tangent(two, p), _tangent(one, p))
        with np.errstate(invalid="ignore"):
            result |= np.isfinite(p[:, 0]) & (el.s[first] * turn < -ALONG)
    return result


def led_through(el: Elements, contour: Index, i: Index, j: Index) -> Mask:
    """Whether the contour goes through wall i (m,) after it, up to wall j (m,) > i, where heights meet."""
    if not len(i):
        return np.zeros(0, dtype=bool)
    k = np.flatnonzero(el.wall & np.isin(contour, contour[i]))
    bulge = np.where(el.arc[k], 2 * np.nan_to_num(el.r[k]), 0.0)[:, None]
    low, high = np.minimum(el.start[k], el.end[k]) - bulge, np.maximum(el.start[k], el.end[k]) + bulge
    asked = np.zeros(len(el.rows), dtype=bool)
    asked[i] = True
    earliest = np.full(len(el.rows), len(el.rows))
    for one, two in near(low, high, 0.0):
        a, b = k[one], k[two]
        keep = asked[a] & (contour[a] == contour[b])
        a, b = a[keep], b[keep]
        through = _crosses(el, a, b) & meet(el, a, b)
        np.minimum.at(earliest, a[through], b[through])
    return np.asarray(earliest[i] <= j)


def _crosses(el: Elements, a: Index, b: Index) -> Mask:
    """Whether elements a and b (m,) cross between their ends."""
    one, two = el.curves(a), el.curves(b)
    result = np.zeros(len(a), dtype=bool)
    for p in crossings(one, two):
        inside = np.isfinite(p[:, 0])
        for curve, k in ((one, a), (two, b)):
            at, length = share(p, curve), el.length(k)
            with np.errstate(invalid="ignore"):
                inside &= (at * length > ENDS) & ((1 - at) * length > ENDS)
        with np.errstate(invalid="ignore"):
            result |= inside & (np.abs(cross(_tangent(one, p), _tangent(two, p))) > ALONG)
    return result


def _tangent(curve: Curves, p: Array) -> Array:
    """Unit tangents (n, 2) of curves at points p (n, 2) on them."""
    travel, spoke = curve.end - curve.start, p - curve.centre
    along = np.where(curve.arc[:, None], np.sign(curve.sweep)[:, None] * np.stack([-spoke[:, 1], spoke[:, 0]], 1), travel)
    with np.errstate(invalid="ignore", divide="ignore"):
        return np.asarray(along / np.hypot(along[:, 0], along[:, 1])[:, None])
