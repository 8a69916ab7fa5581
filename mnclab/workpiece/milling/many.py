"""A part that very many moves left, by erosion: its map, what was taken away, and which row took what.

Rows are told apart chunk by chunk: the moves go in `CHUNKS` lots, one after the other, and what a lot took away is shared
out over its moves by their way times the depth of their tip. The heights of the map come from all moves at once.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from mnclab.path.toolpath import Array, Index
from mnclab.workpiece.milling.erosion import eroded
from mnclab.workpiece.milling.sweep import Sweep
from mnclab.workpiece.milling.tips import engaged
from mnclab.workpiece.milling.volumes import ROUGH, blank_ends, within

CHUNKS = 32
STRIP = 32  # rows of cells whose blank is looked at together


@dataclass(frozen=True, eq=False)
class ManyMoves:
    """What the moves of a sweep leave over its raster (ny, nx)."""

    sweep: Sweep

    @cached_property
    def heights(self) -> Array:
        """The material at the middles of the cells; beside the blank its lowest place."""
        top, floor = self.sweep.blank
        return np.maximum(eroded(self.sweep.raster, self.sweep.moves, top).heights, floor)

    def _strips(self) -> Iterator[tuple[slice, slice]]:
        ny, nx = self.sweep.raster.shape
        return ((slice(j, min(j + STRIP, ny)), slice(0, nx)) for j in range(0, ny, STRIP))

    @cached_property
    def _blank(self) -> tuple[Array, Array, Array]:
        """Upper side, lower side and share of each cell (ny, nx) that the blank fills; at its ends both sides as within it."""
        top, floor = (side.copy() for side in self.sweep.blank)
        share, partly = (top > floor).astype(np.float64), blank_ends(self.sweep)
        for strip in self._strips():
            x, y = self.sweep.raster.middles(strip)
            ends = partly[strip].ravel()
            if ends.any():
                sides = self.sweep.faces(*within(x[ends], y[ends], self.sweep.raster.step, ROUGH))
                upper, lower = (side.reshape(int(ends.sum()), -1) for side in sides)
                share[strip][partly[strip]] = (upper > lower).mean(axis=1)
                top[strip][partly[strip]], floor[strip][partly[strip]] = upper.max(axis=1), lower.min(axis=1)
        return top, floor, share

    @cached_property
    def removed(self) -> float:
        """mm³; a cell counts as its middle."""
        top, floor, _ = self._blank
        return self._volume(top, np.maximum(eroded(self.sweep.raster, self.sweep.moves, top).heights, floor))

    def _volume(self, before: Array, after: Array) -> float:
        _, floor, share = self._blank
        return float(((np.maximum(before, floor) - np.maximum(after, floor)) * share).sum()) * self.sweep.raster.step**2

    @cached_property
    def in_order(self) -> tuple[NDArray[np.int64], Array]:
        """The move that cut each cell last (ny, nx), -1 where none did, and what each move took away (k,), mm³."""
        sweep, (heights, floor, _) = self.sweep, self._blank
        last, taken = np.full(sweep.raster.shape, -1, dtype=np.int64), np.zeros(len(sweep.moves))
        for lot in self._lots():
            moves = sweep.moves[lot]
            found = eroded(sweep.raster, moves, heights)
            left = np.maximum(found.heights, floor)
            cut = left < heights
            last[cut] = lot[found.move[cut]]
            volume = self._volume(heights, left)
            if volume > 0:
                margin = int(moves.radius.max() / sweep.raster.step) + 1
                shares = engaged(sweep.raster, moves, heights, margin)
                taken[lot] = volume * (shares / shares.sum() if shares.any() else 1 / len(lot))
            heights = left
        last[np.equal(*self.sweep.blank)] = -1
        total = taken.sum()
        return last, taken * (self.removed / total if total else 1.0)

    def _lots(self) -> Iterator[Index]:
        """The moves, some at a time: they end where the cutter changes, if it does not change more often than they do."""
        moves = self.sweep.moves
        shape = np.stack([moves.radius, moves.flat, moves.corner, moves.slope], axis=1)
        changes = np.flatnonzero((shape[1:] != shape[:-1]).any(axis=1)) + 1
        ends = np.arange(1, CHUNKS) * len(moves) // CHUNKS
        if len(changes) <= CHUNKS:
            ends = np.union1d(ends, changes)
        yield from (lot for lot in np.split(np.arange(len(moves)), ends) if len(lot))
