"""Which of many points on a lattice lie in an area: row by row, from where its edge crosses the rows. Lengths in mm."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from mnclab.geometry.contours import Contour
from mnclab.geometry.curves import Floats
from mnclab.geometry.regions import Region

Mask = NDArray[np.bool_]


def filled(region: Region, x: Floats, y: Floats) -> tuple[slice, slice, Mask]:
    """Rows and columns of the box about a region in a lattice x (nx,), y (ny,), ascending, and which points there lie in it.

    A point on the edge may count either way.
    """
    if not region.loops:
        return slice(0, 0), slice(0, 0), np.zeros((0, 0), dtype=bool)
    (x0, y0), (x1, y1) = region.bounds
    rows, columns = (slice(*np.searchsorted(at, ends)) for at, ends in ((y, (y0, y1)), (x, (x0, x1))))
    across, up = x[columns], y[rows]
    turns = np.zeros((len(up), len(across) + 1), dtype=np.int16)
    for loop in region.loops:
        for row, place, sense in _crossings(loop, up):
            np.add.at(turns, (row, np.searchsorted(across, place)), sense)
    return rows, columns, np.cumsum(turns, axis=1, dtype=np.int16)[:, :-1] > 0


def _crossings(loop: Contour, y: Floats) -> list[tuple[NDArray[np.intp], Floats, NDArray[np.int16]]]:
    """Where elements cross rows: the rows, the places along them, +1 where they cross downwards and the area begins."""
    found = []
    for start, end, sweep, centre, radius in zip(loop.starts, loop.ends, loop.sweeps, loop.centres, loop.radii):
        for (xa, ya), (xb, yb) in _rising(start, end, sweep, centre, radius):
            low, high = np.searchsorted(y, (min(ya, yb), max(ya, yb)))
            if low == high:
                continue
            row = np.arange(low, high)
            if sweep:
                half = np.sqrt(np.maximum(radius * radius - (y[row] - centre[1]) ** 2, 0.0))
                right = (yb > ya) == (sweep > 0)  # counter-clockwise an arc rises on the right of its centre
                place = centre[0] + (half if right else -half)
            else:
                place = xa + (y[row] - ya) / (yb - ya) * (xb - xa)
            found.append((row, place, np.full(len(row), 1 if yb < ya else -1, dtype=np.int16)))
    return found


def _rising(start: Floats, end: Floats, sweep: float, centre: Floats, radius: float) -> list[tuple[Floats, Floats]]:
    """An element in pieces that only rise or only fall."""
    if not sweep:
        return [(start, end)]
    first = np.arctan2(*(start - centre)[::-1])
    tops = np.pi * np.arange(-3, 4) + np.pi / 2
    ahead = (tops - first) * np.sign(sweep)
    ahead = np.sort(ahead[(ahead > 0) & (ahead < abs(sweep))])
    places = [centre + (0.0, radius * np.sign(np.sin(first + each * np.sign(sweep)))) for each in ahead]
    corners = [start, *places, end]
    return list(zip(corners, corners[1:]))
