"""Moves over the raster of a blank: the height of the material at any points, exact."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from mnclab.path.toolpath import Array, Index
from mnclab.workpiece.milling.moves import Moves
from mnclab.workpiece.milling.raster import SMALL, TILE, Raster, in_order, lowered, near

MANY = 5_000  # moves, beyond which tiles are small

Faces = Callable[[Array, Array], tuple[Array, Array]]  # upper and lower side of the blank at points (m,)


@dataclass(frozen=True, eq=False)
class Sweep:
    """`faces` are the upper and lower side of the blank, which are equal where there is none; `top` is its highest place."""

    raster: Raster
    moves: Moves
    faces: Faces
    top: float

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
        top, floor = np.empty(self.raster.shape), np.empty(self.raster.shape)
        for tile in self.raster.tiles():
            for whole, side in zip((top, floor), self.faces(*self.raster.middles(tile))):
                whole[tile] = side.reshape(whole[tile].shape)
        return top, floor

    def left(self, x: Array, y: Array) -> Array:
        """The heights (m,) at points that lie close together."""
        return self.sides(x, y)[0]

    def sides(self, x: Array, y: Array) -> tuple[Array, Array]:
        """The heights and the lower side (m,) at points that lie close together."""
        top, floor = self.faces(x, y)
        return self.within(x, y, top, floor), floor

    def within(self, x: Array, y: Array, top: Array, floor: Array) -> Array:
        """The heights (m,) at points that lie close together, of a blank between two sides there."""
        return np.maximum(lowered(self.moves, self.boxes, x, y, top), floor)

    def taken(self, x: Array, y: Array) -> Array:
        """How much of the blank is gone (m,), mm, at points that lie close together."""
        top, floor = self.faces(x, y)
        return np.asarray(top - self.within(x, y, top, floor))

    def at(self, x: Array, y: Array) -> Array:
        """The heights (m,) at points anywhere."""
        return self.sides_at(x, y)[0]

    def sides_at(self, x: Array, y: Array) -> tuple[Array, Array]:
        """The heights and the lower side (m,) at points anywhere."""
        (top, floor), found = self.faces(x, y), np.empty(len(x))
        for some in grouped(x, y, self.raster.tile):
            found[some] = self.within(x[some], y[some], top[some], floor[some])
        return found, floor

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
        return np.asarray(np.clip(between, floor, top)), floor

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
