"""What a mill leaves of a blank: a map of heights, exact at the middles of its cells, and at any point that is asked for."""

from __future__ import annotations

from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike, NDArray

from mnclab.geometry.contours import Contour
from mnclab.path.columns import Array
from mnclab.text.given import check_number
from mnclab.workpiece.blank import floor_of, top_of
from mnclab.workpiece.cutting import Cutting
from mnclab.workpiece.milling.moves import CHORD, Moves, moves_of
from mnclab.workpiece.milling.raster import Raster, in_order, lowered
from mnclab.workpiece.milling.touched import Touched
from mnclab.workpiece.part import Part
from mnclab.workpiece.workpiece import Solid, Workpiece

CELLS = 400  # along the longer side, by default
EXACT = 20_000  # moves that are swept exactly


class Milled(Workpiece):
    """`x` (nx,), `y` (ny,): middles of the cells; `heights` (ny, nx) mm: the top of the material there.

    `floor` (ny, nx) is the lower side of the blank, which the heights do not pass: where nothing is left, both are equal.
    """

    def __init__(self, cutting: Cutting, step: float | None = None) -> None:
        self.cutting = cutting
        bounds = cutting.stock.bounds
        if step is not None:
            check_number(step, "the step of a workpiece (mm)", above=0)
        self.step = float(step) if step is not None else float((bounds[1] - bounds[0])[:2].max()) / CELLS
        self.raster = Raster.over(bounds, self.step)
        self.moves: Moves = moves_of(cutting)
        self.method, self.error = "exact sweep", CHORD
        self.notes: tuple[str, ...] = ()

    @property
    def x(self) -> Array:
        return self.raster.x

    @property
    def y(self) -> Array:
        return self.raster.y

    @cached_property
    def heights(self) -> Array:
        found = np.empty(self.raster.shape)
        boxes = self.moves.boxes
        for tile in self.raster.tiles():
            x, y = self.raster.middles(tile)
            top, floor = self.blank_at(x, y)
            left = np.maximum(lowered(self.moves, boxes, x, y, top), floor)
            found[tile] = left.reshape(found[tile].shape)
        return found

    @cached_property
    def floor(self) -> Array:
        y, x = np.meshgrid(self.y, self.x, indexing="ij")
        return self.blank_at(x.ravel(), y.ravel())[1].reshape(self.raster.shape)

    def blank_at(self, x: Array, y: Array) -> tuple[Array, Array]:
        """Upper and lower side of the blank at points (m,); beside it both are its lowest place."""
        low = float(self.cutting.stock.bounds[0, 2])
        top, floor = top_of(self.cutting.stock, x, y), floor_of(self.cutting.stock, x, y)
        return np.nan_to_num(top, nan=low), np.nan_to_num(floor, nan=low)

    def at(self, x: ArrayLike, y: ArrayLike) -> Array | float:
        """The height of the material at a place or at places, mm: exact, whatever the step."""
        px, py = np.broadcast_arrays(np.asarray(x, dtype=np.float64), np.asarray(y, dtype=np.float64))
        top, floor = self.blank_at(px.ravel(), py.ravel())
        left = np.maximum(lowered(self.moves, self.moves.boxes, px.ravel(), py.ravel(), top), floor)
        return left.reshape(px.shape) if px.ndim else float(left[0])

    @cached_property
    def cut_by(self) -> NDArray[np.int64]:
        """The row of the path that cut a cell last (ny, nx), -1 where none did."""
        found = np.full(self.raster.shape, -1, dtype=np.int64)
        boxes = self.moves.boxes
        for tile in self.raster.tiles():
            x, y = self.raster.middles(tile)
            top, floor = self.blank_at(x, y)
            last = np.full(len(x), -1)
            for which, before, left in in_order(self.moves, boxes, x, y, top):
                cut = left < np.maximum(before, floor)  # what is through already is not cut again
                any_ = cut.any(axis=0)
                last[any_] = self.moves.row[which[len(which) - 1 - cut[::-1].argmax(axis=0)]][any_]
            found[tile] = last.reshape(found[tile].shape)
        return found

    @property
    def volume(self) -> float:
        return float((self.heights - self.floor).sum()) * self.step**2

    @property
    def removed(self) -> float:
        return float(self.removed_by_row().sum())

    def removed_by_row(self) -> Array:
        found = np.zeros(len(self.cutting))
        boxes = self.moves.boxes
        for tile in self.raster.tiles():
            x, y = self.raster.middles(tile)
            top, floor = self.blank_at(x, y)
            for which, before, left in in_order(self.moves, boxes, x, y, top):
                taken = np.maximum(np.maximum(before, floor) - np.maximum(left, floor), 0.0).sum(axis=1)
                np.add.at(found, self.moves.row[which], taken * self.step**2)
        return found

    def cut(self, plane: str, at: float = 0.0) -> list[Contour]:
        raise NotImplementedError

    @property
    def part(self) -> Part:
        return Touched(self.cutting.stock, self.moves).part

    def solid(self) -> Solid:
        """The top with its walls at their true places, the sides and the lower side of the blank."""
        from mnclab.workpiece.milling.solid import solid_of

        return solid_of(self)
