"""Moves over the raster of a blank: the height of the material at any points, exact, after all of them or just before one."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Any, NamedTuple

import numpy as np

from mnclab.path.toolpath import Array, Index
from mnclab.workpiece.milling.gaps import Faces, Gaps
from mnclab.workpiece.milling.moves import Moves
from mnclab.workpiece.milling.raster import AT_ONCE, SMALL, TILE, Raster, in_order, lowered, near
from mnclab.workpiece.milling.swept import left_by

MANY = 5_000  # moves, beyond which tiles are small
ACROSS = 8  # tiles along the longer side of a coarse map, at least


@dataclass(frozen=True, eq=False)
class Sweep:
    """`faces` are the upper and lower side of the blank, which are equal where there is none; `top` is its highest place.

    `gaps` are what tools took away that do not stand along Z.
    """

    raster: Raster
    moves: Moves
    faces: Faces
    top: float
    gaps: Gaps | None = field(default=None, kw_only=True)

    @cached_property
    def boxes(self) -> Array:
        return self.moves.boxes

    @property
    def tiles(self) -> Iterator[tuple[slice, slice]]:
        """Rows and columns of tiles to go through in order: the more moves, the smaller."""
        return self.raster.tiles(TILE if len(self.moves) <= MANY else SMALL)

    @cached_property
    def blank(self) -> tuple[Array, Array]:
        """The upper and lower side of the blank (ny, nx) at the middles of the cells."""
        top, floor = self.over(self.faces)
        return top, floor

    def left(self, x: Array, y: Array) -> Array:
        """The heights (m,) at points that lie close together."""
        return self.sides(x, y)[0]

    def sides(self, x: Array, y: Array) -> tuple[Array, Array]:
        """The heights and the lower side (m,) at points that lie close together."""
        return self.between(x, y, *self.faces(x, y))

    def between(self, x: Array, y: Array, top: Array, floor: Array) -> tuple[Array, Array]:
        """The same of a blank between two sides there."""
        found = np.maximum(lowered(self.moves, self.boxes, x, y, top), floor)
        return self.gaps.sides(x, y, found, floor) if self.gaps else (found, floor)

    def within(self, x: Array, y: Array, top: Array, floor: Array) -> Array:
        """The heights alone."""
        return self.between(x, y, top, floor)[0]

    def taken(self, x: Array, y: Array) -> Array:
        """How much of the blank is gone (m,), mm, at points that lie close together."""
        top, floor = self.faces(x, y)
        left = np.maximum(lowered(self.moves, self.boxes, x, y, top), floor)
        return self.gaps.taken(x, y, top, left, floor) if self.gaps else np.asarray(top - left)

    def at(self, x: Array, y: Array) -> Array:
        """The heights (m,) at points anywhere."""
        return self.sides_at(x, y)[0]

    def sides_at(self, x: Array, y: Array) -> tuple[Array, Array]:
        """The heights and the lower side (m,) at points anywhere."""
        (top, floor), found = self.faces(x, y), np.empty((2, len(x)))
        for some in grouped(x, y, self.raster.step * min(TILE, max(self.raster.shape) / ACROSS)):
            found[:, some] = self.between(x[some], y[some], top[some], floor[some])
        return found[0], found[1]

    def over(self, of: Callable[[Array, Array], Any]) -> Any:
        """What some function of points close together gives at the middles of all cells (…, ny, nx)."""
        tiles = [(tile, np.asarray(of(*self.raster.middles(tile)))) for tile in self.raster.tiles()]
        found = np.empty((*tiles[0][1].shape[:-1], *self.raster.shape))
        for tile, values in tiles:
            found[..., *tile] = values.reshape(found[..., *tile].shape)
        return found

    def in_order(self, x: Array, y: Array) -> Iterator[tuple[Index, Array, Array]]:
        """For some moves after the other, at points close together: which (k,), the heights before each and after (k, m)."""
        top, floor = self.faces(x, y)
        for which, before, left in in_order(self.moves, self.boxes, x, y, top):
            before = np.maximum(before, floor)  # what is through already is not cut again
            yield which, before, np.minimum(before, np.maximum(left, floor))

    def about(self, x: Array, y: Array) -> Sweep:
        """With those moves alone that may reach a place between some points."""
        return replace(self, moves=self.moves[near(self.moves, self.boxes, x, y, np.inf)])


@dataclass(frozen=True, eq=False)
class Mapped(Sweep):
    """The same, with heights between those of a map (ny, nx) at the middles of the cells: a cell is their error in the plane."""

    heights: Array

    def sides(self, x: Array, y: Array) -> tuple[Array, Array]:
        (ny, nx), z, raster = self.heights.shape, self.heights, self.raster
        u, v = np.clip((x - raster.x[0]) / raster.step, 0, nx - 1), np.clip((y - raster.y[0]) / raster.step, 0, ny - 1)
        i, j = (np.minimum(np.floor(at).astype(np.int64), max(n - 2, 0)) for at, n in ((u, nx), (v, ny)))
        right, above, u, v = np.minimum(i + 1, nx - 1), np.minimum(j + 1, ny - 1), u - i, v - j
        between = (z[j, i] * (1 - u) + z[j, right] * u) * (1 - v) + (z[above, i] * (1 - u) + z[above, right] * u) * v
        top, floor = self.faces(x, y)
        between = np.clip(between, floor, top)
        return self.gaps.sides(x, y, between, floor) if self.gaps else (between, floor)

    def sides_at(self, x: Array, y: Array) -> tuple[Array, Array]:
        return self.sides(x, y)

    def about(self, x: Array, y: Array) -> Sweep:
        return self


def grouped(x: Array, y: Array, side: float) -> Iterator[Index]:
    """Points that lie in one square of a side, square by square."""
    column, row = np.floor(x / side), np.floor(y / side)
    order = np.lexsort((column, row))
    ends = np.flatnonzero((np.diff(column[order]) != 0) | (np.diff(row[order]) != 0)) + 1
    yield from (some for some in np.split(order, ends) if len(some))


# How high the material stands at points just before a move: exact, and only as far as it must be known.

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
