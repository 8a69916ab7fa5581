"""Which middles of a raster's cells lie in a region: row by row, from where the boundary crosses the row. Exact."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from mnclab.geometry.contours import Contour, Floats
from mnclab.geometry.regions import Region

Box = tuple[slice, slice]


def filled(region: Region, x: Floats, y: Floats) -> tuple[Box, np.ndarray]:
    """The rows and columns of the box about a region, and which cells of it lie within: ascending places x (nx,), y (ny,).

    A place on the boundary may count either way.
    """
    if not region.loops:
        return (slice(0, 0), slice(0, 0)), np.zeros((0, 0), dtype=bool)
    corners = np.array([loop.bounds for loop in region.loops])
    (x0, y0), (x1, y1) = corners[:, 0].min(axis=0), corners[:, 1].max(axis=0)
    i, j = np.searchsorted(x, [x0, x1]), np.searchsorted(y, [y0, y1])
    box = slice(int(j[0]), int(j[1])), slice(int(i[0]), int(i[1]))
    across, along = x[box[1]], y[box[0]]
    rounds = np.zeros((len(along), len(across) + 1), dtype=np.int16)
    for loop in region.loops:
        for start, end, at in _pieces(loop):
            first, last = np.searchsorted(along, sorted((start, end)))
            rows = np.arange(first, last)
            rounds[rows, np.searchsorted(across, at(along[first:last]))] += 1 if end < start else -1
    return box, np.cumsum(rounds, axis=1, dtype=np.int16)[:, :-1] > 0


def _pieces(loop: Contour) -> Iterator[tuple[float, float, object]]:
    """Pieces of a loop that rise or fall all along: y at their ends, and x at any y between."""
    elements = zip(loop.starts, loop.ends, loop.sweeps.tolist(), loop.centres, loop.radii.tolist(), strict=True)
    for (x0, y0), (x1, y1), sweep, (cx, cy), radius in elements:
        if sweep == 0:
            if y0 != y1:
                yield y0, y1, lambda y, x0=x0, y0=y0, slope=(x1 - x0) / (y1 - y0): x0 + (y - y0) * slope
            continue
        begin = np.arctan2(y0 - cy, x0 - cx)
        low, high = sorted((begin, begin + sweep))
        turns = np.pi / 2 + np.pi * np.arange(np.ceil((low - np.pi / 2) / np.pi), np.floor((high - np.pi / 2) / np.pi) + 1)
        angles = np.concatenate([[low], turns[(turns > low) & (turns < high)], [high]])
        ends = np.concatenate([[y0 if sweep > 0 else y1], cy + radius * np.sin(angles[1:-1]), [y1 if sweep > 0 else y0]])
        for k in range(len(angles) - 1):
            side = radius * np.sign(np.cos((angles[k] + angles[k + 1]) / 2))
            a, b = ends[k : k + 2] if sweep > 0 else ends[k : k + 2][::-1]
            yield a, b, lambda y, cx=cx, cy=cy, r=radius, side=side: cx + side * np.sqrt(np.maximum(1 - ((y - cy) / r) ** 2, 0.0))
