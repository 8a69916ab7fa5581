"""Parallel lines across an area: where each of them lies inside. Lengths in mm."""

from __future__ import annotations

import numpy as np

from mnclab.geometry.contours import Contour, Floats
from mnclab.geometry.regions import Region

SAME = 1e-9


def scan(region: Region, heights: Floats) -> list[Floats]:
    """For each height y the stretches `(k, 2)` of x where the line at y lies in the region, from left to right."""
    found = []
    for y in np.asarray(heights, dtype=float):
        cuts = np.unique(np.concatenate([np.zeros(0), *(_crossings(loop, float(y)) for loop in region.loops)]))
        middles = (cuts[1:] + cuts[:-1]) / 2
        inside = region.contains(np.stack([middles, np.full(len(middles), y)], axis=1)) & (np.diff(cuts) > SAME)
        edge = np.diff(np.concatenate([[False], inside, [False]]).astype(int))
        found.append(np.stack([cuts[np.flatnonzero(edge == 1)], cuts[np.flatnonzero(edge == -1)]], axis=1))
    return found


def _crossings(loop: Contour, y: float) -> Floats:
    """Where the elements of a loop meet the line at y; a place too many does no harm."""
    low, high = np.minimum(loop.starts[:, 1], loop.ends[:, 1]), np.maximum(loop.starts[:, 1], loop.ends[:, 1])
    rise = loop.ends[:, 1] - loop.starts[:, 1]
    flat = (loop.sweeps == 0) & (low <= y) & (y <= high)
    steep = flat & (np.abs(rise) > SAME)
    share = (y - loop.starts[steep, 1]) / rise[steep]
    straight = loop.starts[steep, 0] + share * (loop.ends - loop.starts)[steep, 0]
    level = flat & ~steep
    bent = loop.sweeps != 0
    half2 = loop.radii[bent] ** 2 - (y - loop.centres[bent, 1]) ** 2
    half = np.sqrt(np.maximum(half2, 0.0))[half2 >= 0]
    middle = loop.centres[bent, 0][half2 >= 0]
    return np.concatenate([straight, loop.starts[level, 0], loop.ends[level, 0], middle - half, middle + half])
