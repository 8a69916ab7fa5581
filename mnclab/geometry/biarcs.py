"""A smooth line through places, of arcs: biarcs, each of two arcs that meet with one direction. Lengths in mm.

With the chord c and the directions t, u at its ends both arcs reach as far, d, along the lines that touch them:

    d²·2·(1 - t·u) + 2·d·c·(t + u) - c² = 0          they meet in the middle of what lies d beyond both ends
"""

from __future__ import annotations

import math

import numpy as np

from mnclab.geometry.contours import Contour
from mnclab.geometry.curves import Floats, distance, length_of


def smoothed(points: Floats, spacing: float, error: float) -> Contour:
    """Arcs along places (n, 2), whose noise is evened out over `spacing`, that keep within `error` of what is left."""
    upto = np.append(0.0, np.cumsum(length_of(np.diff(points, axis=0))))
    count = max(2, math.ceil(upto[-1] / spacing))
    way = np.linspace(0, upto[-1], count + 1)
    at = evened(np.stack([np.interp(way, upto, points[:, k]) for k in (0, 1)], axis=1), 1.0)
    t = np.gradient(at, axis=0, edge_order=2 if count > 2 else 1)
    t /= np.maximum(length_of(t), 1e-12)[:, None]
    knots = np.unique(np.append(np.arange(0, count, 8), count))
    while True:
        a, b = knots[:-1], knots[1:]
        middle, bulges = _biarcs(at[a], at[b], t[a], t[b])
        places = np.vstack([np.stack([at[a], middle], axis=1).reshape(-1, 2), at[b[-1:]]])
        ways = Contour(places, np.append(bulges, 0.0), closed=False)
        inner = np.setdiff1d(np.arange(count + 1), knots)
        biarc = np.searchsorted(knots, inner) - 1
        off = np.minimum(*(distance(at[inner], ways.curves.take(2 * biarc + k)) for k in (0, 1)))
        bad = np.unique(biarc[off > error])
        if not len(bad):
            return ways
        knots = np.union1d(knots, (knots[bad] + knots[bad + 1]) // 2)


def _biarcs(a: Floats, b: Floats, t: Floats, u: Floats) -> tuple[Floats, Floats]:
    """Where the two arcs from places a to b meet, directions t and u, and their bulges (n, 2)."""
    c, both = b - a, t + u
    along, square = (c * both).sum(axis=1), (c * c).sum(axis=1)
    bent = 2 * (1 - (t * u).sum(axis=1))
    root = np.sqrt(along**2 + bent * square)
    d = square / np.maximum(along + root, 1e-300)
    middle = (a + d[:, None] * t + b - d[:, None] * u) / 2
    bulges = []
    for first, last, way, sign in ((a, middle, t, 1.0), (middle, b, u, -1.0)):
        chord = last - first
        angle = np.arctan2(way[:, 0] * chord[:, 1] - way[:, 1] * chord[:, 0], (way * chord).sum(axis=1))  # half the sweep
        bulges.append(np.tan(sign * angle / 2))
    return middle, np.stack(bulges, axis=1)


def evened(values: Floats, sigma: float) -> Floats:
    """Values (n, …) evened out over `sigma` places; both ends stay."""
    wide = math.ceil(3 * sigma)
    if len(values) <= wide:
        return values
    weight = np.exp(-0.5 * (np.arange(-wide, wide + 1) / sigma) ** 2)
    ends = 2 * values[:1] - values[wide:0:-1], 2 * values[-1:] - values[-2 : -wide - 2 : -1]
    windows = np.lib.stride_tricks.sliding_window_view(np.concatenate([ends[0], values, ends[1]]), 2 * wide + 1, axis=0)
    return np.asarray(windows @ (weight / weight.sum()))
