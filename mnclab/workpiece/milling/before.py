"""How high the material stands at points just before a move: exact, and only as far as it must be known."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from mnclab.path.toolpath import Array, Index
from mnclab.workpiece.milling.moves import Moves
from mnclab.workpiece.milling.raster import AT_ONCE, near
from mnclab.workpiece.milling.swept import left_by

FIRST = 16  # moves that are looked at together; then twice as many, and so on
TILED, TILES = 200, 64  # points of a tile, about; tiles along the longer side, at most


class Points(NamedTuple):
    """Points (m,) that a body passes: `low` is its lower side there, `before` the number of the move before which the
    material counts, `owner` whose body it is."""

    x: Array
    y: Array
    low: Array
    before: Index
    owner: Index

    def __getitem__(self, which: Index) -> Points:  # type: ignore[override]
        return Points(*(np.asarray(column)[which] for column in tuple(self)))


def depths(moves: Moves, boxes: Array, at: Points, top: Array) -> Array:
    """How deep the bodies are in the material at the points (m,), mm; 0 where they are not.

    `top` (m,) is the blank's. The latest moves are looked at first: a point is done with as soon as one has cleared it.
    """
    height, deep = top.copy(), np.zeros(len(top))
    within = np.flatnonzero(top > at.low)
    for some in _tiles(at.x, at.y, within):
        met = _still_met(moves, boxes, at, height, some)
        deep[met] = height[met] - at.low[met]
    return deep


def _tiles(x: Array, y: Array, which: Index) -> list[Index]:
    """Points that lie close together."""
    if not len(which):
        return []
    corner, many = np.array([x[which].min(), y[which].min()]), min(int((len(which) / TILED) ** 0.5) + 1, TILES)
    side = max(float(np.ptp(x[which])), float(np.ptp(y[which]))) / many + 1e-9
    i, j = ((np.stack([x[which], y[which]], axis=1) - corner) / side).astype(np.int64).T
    key = j * (many + 1) + i
    order = np.argsort(key, kind="stable")
    return np.split(which[order], np.flatnonzero(np.diff(key[order])) + 1)


def _still_met(moves: Moves, boxes: Array, at: Points, height: Array, some: Index) -> Index:
    """Those of some points where material is left; their `height` is lowered to it.

    First come the moves that are deep enough to clear a point, the latest before the others.
    """
    found = near(moves, boxes, at.x[some], at.y[some], float(height[some].max()))
    found = found[found < at.before[some].max()][::-1]
    deep = moves.low[found] <= at.low[some].max()
    for queue in (found[deep], found[~deep]):
        done, many = 0, FIRST
        while done < len(queue) and len(some):
            chunk = queue[done : done + min(many, max(AT_ONCE // len(some), 1))]
            left = left_by(moves[chunk], at.x[some], at.y[some])
            left[chunk[:, None] >= at.before[some]] = np.inf
            height[some] = np.minimum(height[some], left.min(axis=0))
            some = some[height[some] > at.low[some]]
            done, many = done + len(chunk), 2 * many
    return some
