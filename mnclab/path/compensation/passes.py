"""What a contour says about walls that it does not leave standing: contours run past their start, several passes at one level.

A contour that is run past its start crosses its own beginning. Where it does so at an outside corner both tails lie in the
air beside the part: a tool that cuts across a tail cuts nothing. And a wall through which the contour itself leads does
not stand, whatever the size of the tool: the next pass of a roughing, say, leaves the last one by a loop and comes back
through it.
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
            joint = (last == first + 1) & (np.hypot(*(p - el.end[first]).T) < ENDS)
            result |= np.isfinite(p[:, 0]) & ~joint & (el.s[first] * turn < -ALONG)
    return result


def led_through(el: Elements, contour: Index, i: Index, j: Index) -> Mask:
    """Whether between walls i and j (m,) of a contour it goes through one of the two itself, where heights meet."""
    if not len(i):
        return np.zeros(0, dtype=bool)
    first, last, n = np.minimum(i, j), np.maximum(i, j), len(el.rows)
    k = np.flatnonzero(el.wall & np.isin(contour, contour[i]))
    asked = np.zeros(n, dtype=bool)
    asked[i] = asked[j] = True
    after, before = np.full(n, n), np.full(n, -1)  # the next and the last one that goes through each wall
    for one, two in near(*el.boxes(k, contour), 0.0):
        a, b = k[one], k[two]
        some = asked[a] | asked[b]
        a, b = a[some], b[some]
        through = _crosses(el, a, b) & meet(el, a, b)
        np.minimum.at(after, a[through], b[through])
        np.maximum.at(before, b[through], a[through])
    return np.asarray((after[first] <= last) | (before[last] >= first))


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
    along = np.where(
        curve.arc[:, None], np.sign(curve.sweep)[:, None] * np.stack([-spoke[:, 1], spoke[:, 0]], 1), travel
    )
    with np.errstate(invalid="ignore", divide="ignore"):
        return np.asarray(along / np.hypot(along[:, 0], along[:, 1])[:, None])
