"""Heights of the tool: a tool cuts into an element only where it goes as deep.

Two elements *meet* if there is a height, along the normal of the plane, that the tip of the tool has in both. What is
done at other heights is another pass, a way in the air or a step of the part: a pass below another one takes away what
the program tells it to, and a retracted tool crosses above everything. On a ramp the tool works all the way down, so an
element that descends also meets what follows it without a lift or a plunge, however much deeper.
"""

from __future__ import annotations

import numpy as np

from mnclab.path.columns import Array, Index, Mask
from mnclab.path.compensation.elements import Elements

SAME = 1e-6  # mm


def meet(el: Elements, i: Index, j: Index) -> Mask:
    """Whether elements i and j (m,) meet."""
    first, last = np.minimum(i, j), np.maximum(i, j)
    result = _overlap(*_range(el, first), *_range(el, last))
    k = np.flatnonzero(~result & (el.to_height[first] < el.from_height[first] - SAME))
    if len(k):
        result[k] = _way_down(el)[first[k]] == _way_down(el)[last[k]]
    return result


def at_height(el: Elements, height: float, k: Index) -> Mask:
    """Which of the elements k (m,) have a height."""
    return _overlap(np.full(len(k), height), np.full(len(k), height), *_range(el, k))


def retracted(el: Elements, contour: Index) -> Mask:
    """Which elements (n,) run higher than their contour does both before and after them."""
    n, low = len(el.rows), np.minimum(el.from_height, el.to_height)
    result = np.zeros(n, dtype=bool)
    changes = np.flatnonzero(np.diff(low))  # a contour at one height has no such way
    for k in np.unique(contour[changes]):
        a = int(np.searchsorted(contour, k))
        z = low[a : int(np.searchsorted(contour, k, "right"))]
        before, after = np.minimum.accumulate(z), np.minimum.accumulate(z[::-1])[::-1]
        result[a : a + len(z)] = (z > before + SAME) & (z > after + SAME)
    return result


def _range(el: Elements, k: Index) -> tuple[Array, Array]:
    return np.minimum(el.from_height[k], el.to_height[k]), np.maximum(el.from_height[k], el.to_height[k])


def _overlap(low: Array, high: Array, other_low: Array, other_high: Array) -> Mask:
    return np.asarray((low <= other_high + SAME) & (other_low <= high + SAME))


def _way_down(el: Elements) -> Index:
    """Numbers (n,) that are the same along every way that goes on without rising and without a move along the normal."""
    new = el.to_height > el.from_height + SAME
    new[1:] |= np.abs(el.from_height[1:] - el.to_height[:-1]) > SAME
    return np.cumsum(new, dtype=np.int64)
