"""What very many moves leave: the map of their tips, eroded by the lower side of the cutter, then swept where it counts."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from mnclab.path.toolpath import Array, Index, Mask
from mnclab.workpiece.milling.moves import STILL, Cutter, Moves, edge_height
from mnclab.workpiece.milling.raster import Raster
from mnclab.workpiece.milling.sweep import Sweep
from mnclab.workpiece.milling.swept import left_by
from mnclab.workpiece.milling.volumes import ROUGH, blank_ends, within

# Where the tips of a cutter went: for every cell the lowest place that one of them had over it, and whose move it was.
# A move is cut into pieces no longer than half a cell; the middle of each stands for it.

PIECES = 2.0  # of a move for each cell that it goes on
AT_ONCE = 1 << 17  # pieces that are laid down together


@dataclass(frozen=True)
class Tips:
    """`low` (ny + 2 margin, nx + 2 margin) mm, infinite where no tip came; `move` the same cells, -1 there."""

    margin: int
    low: NDArray[np.float32]
    move: NDArray[np.int32]


def tips_of(raster: Raster, moves: Moves, which: Index, margin: int) -> Tips:
    """The tips of some moves over a raster and `margin` cells around it; the first of equally low ones counts."""
    shape = raster.shape[0] + 2 * margin, raster.shape[1] + 2 * margin
    low, move = np.full(shape, np.inf, dtype=np.float32), np.full(shape, -1, dtype=np.int32)
    flat_low, flat_move = low.reshape(-1), move.reshape(-1)
    origin = np.array(raster.low) - margin * raster.step
    for chunk, own, x, y, z in _pieces(moves, which, raster.step):
        i, j = np.floor((x - origin[0]) / raster.step), np.floor((y - origin[1]) / raster.step)
        inside = (i >= 0) & (i < shape[1]) & (j >= 0) & (j < shape[0])
        cell = (j * shape[1] + i)[inside].astype(np.int64)
        z, own = z[inside].astype(np.float32), own[inside]
        lower = z < flat_low[cell]
        cell, z, own = cell[lower], z[lower], own[lower]
        np.minimum.at(flat_low, cell, z)
        lowest = z == flat_low[cell]
        flat_move[cell[lowest][::-1]] = chunk[own[lowest][::-1]]
    return Tips(margin, low, move)


def engaged(raster: Raster, moves: Moves, material: Array, margin: int) -> Array:
    """The way of each move (k,) times the depth of its tip in `material` (ny, nx), mm²; up to `margin` cells beside it too."""
    found, step = np.zeros(len(moves)), raster.step
    for chunk, own, x, y, z in _pieces(moves, np.arange(len(moves)), step):
        i, j = np.floor((x - raster.low[0]) / step), np.floor((y - raster.low[1]) / step)
        on_i, on_j = (np.clip(at, 0, n - 1).astype(np.int64) for at, n in ((i, raster.shape[1]), (j, raster.shape[0])))
        near = np.maximum(np.abs(i - on_i), np.abs(j - on_j)) <= margin
        depth = np.where(near, np.maximum(material[on_j, on_i] - z, 0.0), 0.0)
        length = np.hypot(moves[chunk].ways, moves.end[chunk, 2] - moves.start[chunk, 2])
        found[chunk] = np.bincount(own, depth, len(chunk)) * length / np.bincount(own, minlength=len(chunk))
    return found


def _pieces(moves: Moves, which: Index, step: float) -> Iterator[tuple[Index, Index, Array, Array, Array]]:
    """Some moves, which of them each piece belongs to (k,), x, y and z of its middle (k,)."""
    for many in range(0, len(which), AT_ONCE):
        part = which[many : many + AT_ONCE]
        count = _count(moves, part, step)
        ends = np.cumsum(count)
        first = 0
        while first < len(part):
            done = ends[first - 1] if first else 0
            last = max(int(np.searchsorted(ends, done + AT_ONCE, "right")), first + 1)
            chunk, counts = part[first:last], count[first:last]
            own = np.repeat(np.arange(last - first), counts)
            share = (np.arange(len(own)) - np.repeat(ends[first:last] - counts - done, counts) + 0.5) / counts[own]
            yield chunk, own, *_places(moves[chunk], own, share)
            first = last


def _count(moves: Moves, which: Index, step: float) -> Index:
    """Into how many pieces each move is cut (k,); one that stands in the plane is one."""
    flat, rise = moves[which].ways, moves.end[which, 2] - moves.start[which, 2]
    return np.maximum(np.ceil(np.where(flat > STILL, np.hypot(flat, rise), 0.0) / step * PIECES), 1).astype(np.int64)


def _places(moves: Moves, own: Index, share: Array) -> tuple[Array, Array, Array]:
    """x, y and z (k,) of tips at shares of their moves; what only goes up or down stands at its lower end."""
    x, y, z = moves.tips(own, share).T
    still = ~moves.arc & (moves.ways <= STILL)
    if still.any():
        z[still[own]] = moves.low[own[still[own]]]
    return x, y, z


# For every cell of a map: which tip of a cutter, of all those around it, leaves the least height there.
# Height and place of a tip stand in one whole number, the place below the height, so that a minimum finds both. One search
# goes over the footprint as if the cutter were thinner by `SNAP` cells, which is how far a tip may be from the middle of
# its cell: there it cuts for certain. Another goes over the rim, where it may.

SNAP = math.sqrt(0.5)  # cells from a tip to the middle of its cell, at most
RUN = 4  # cells: longer level runs of a footprint are taken at once
BITS = 31  # of a code

Codes = NDArray[np.int32]
Cells = list[tuple[int, int, float]]


@dataclass(frozen=True)
class Footprint:
    """Cells about the tip of a cutter, all four quarters alike, up to `reach` cells away.

    `level[b]` cells to either side in row b all stand at height 0 (-1: none). `sure` and `rim` are row, column and height
    (mm) of the other cells: where the cutter cuts for certain, and where it may, `least` mm above its tip or more.
    """

    reach: int
    level: list[int]
    sure: Cells
    rim: Cells
    least: float

    @classmethod
    def of(cls, cutter: Cutter, step: float) -> Footprint:
        """That of a cutter on cells of `step` mm."""
        snap, shape = SNAP * step, [np.array(value) for value in cutter[1:]]
        reach = int((cutter.radius + snap) / step) + 1
        b, a = np.mgrid[: reach + 1, : reach + 1]
        rho = np.hypot(a, b) * step
        sure = rho + snap <= cutter.radius
        rim = ~sure & (rho - snap < cutter.radius)
        height = edge_height(np.minimum(rho + snap, cutter.radius), *shape)
        level = [int(row.sum()) - 1 for row in sure & (height <= 0)]
        level = [run if 2 * run + 1 >= RUN else -1 for run in level]
        single = sure & (a > np.array(level)[:, None])
        beyond = height + (rho + snap - cutter.radius)  # of tips at one height the nearest is asked
        least = edge_height(np.array(max(cutter.radius - 2 * snap, 0.0)), *shape)
        return cls(reach, level, _listed(single, height), _listed(rim, beyond), float(least))

    @property
    def highest(self) -> float:
        """The greatest height of a cell, mm."""
        return max((height for _, _, height in self.sure + self.rim), default=0.0)


def _listed(chosen: Mask, height: Array) -> Cells:
    return [(int(b), int(a), float(height[b, a])) for b, a in np.argwhere(chosen)]


@dataclass(frozen=True)
class Search:
    """The cells of a window as codes: how many `unit` mm above the lowest of them, and in `bits` below it their place.

    From `none` on no tip was found.
    """

    codes: Codes
    footprint: Footprint
    unit: float
    bits: int
    none: int

    @classmethod
    def over(cls, low: NDArray[np.float32], here: Mask, footprint: Footprint) -> Search:
        """Of the tips `low` where `here`: around the cells that are asked for `footprint.reach` more."""
        bits = max((low.size - 1).bit_length(), 1)
        least, span = float(low[here].min()), float(low[here].max() - low[here].min())
        unit = (span + 2 * footprint.highest) / ((1 << (BITS - bits)) - 4)
        none = math.ceil((span + footprint.highest) / unit) + 1
        codes = np.full(low.shape, none, dtype=np.int32)
        codes[here] = (low[here] - least) / unit
        codes <<= bits
        codes |= np.arange(low.size, dtype=np.int32).reshape(low.shape)
        return cls(codes, footprint, unit, bits, none << bits)

    @property
    def _inner(self) -> tuple[int, int]:
        around = 2 * self.footprint.reach
        return self.codes.shape[0] - around, self.codes.shape[1] - around

    def _places(self, best: Codes) -> tuple[Mask, NDArray[np.int32]]:
        found = best.reshape(-1)
        return found < self.none, found & ((1 << self.bits) - 1)

    def sure(self) -> tuple[Mask, NDArray[np.int32]]:
        """Whether a tip cuts each of the m inner cells for certain, and the place in the window of the one that leaves least."""
        best = np.full(self._inner, self.none, dtype=np.int32)
        self._level(best)
        self._single(self.footprint.sure, best)
        return self._places(best)

    def rim(self) -> tuple[Mask, NDArray[np.int32]]:
        """The same of tips that may cut."""
        best = np.full(self._inner, self.none, dtype=np.int32)
        self._single(self.footprint.rim, best)
        return self._places(best)

    def _level(self, best: Codes) -> None:
        """Runs at height 0: two overlapping ones, whose length is a power of two, cover each."""
        (ny, nx), reach = best.shape, self.footprint.reach
        runs, length = self.codes, 1
        for b in range(len(self.footprint.level) - 1, -1, -1):  # the longest is in the middle
            run = self.footprint.level[b]
            if run < 0:
                continue
            while 2 * length <= 2 * run + 1:
                runs, length = np.minimum(runs[:, :-length], runs[:, length:]), 2 * length
            for row in {reach - b, reach + b}:
                for column in (reach - run, reach + run + 1 - length):
                    np.minimum(best, runs[row : row + ny, column : column + nx], out=best)

    def _single(self, cells: Cells, best: Codes) -> None:
        """Cells of a quarter one by one, row after row; their mirror images stand at the same height."""
        (ny, nx), reach = best.shape, self.footprint.reach
        row, both, near = -1, self.codes, np.empty_like(best)
        for b, a, height in cells:
            if b != row:
                row, both = b, np.minimum(self.codes[reach - b : reach - b + ny], self.codes[reach + b : reach + b + ny])
            np.minimum(both[:, reach - a : reach - a + nx], both[:, reach + a : reach + a + nx], out=near)
            near += int(height / self.unit) << self.bits
            np.minimum(best, near, out=best)


# The tips of each cutter are laid down cell by cell (`tips`); for each cell of the part the erosion finds the tip that cuts
# deepest there (`search`), at a cost that does not depend on the number of moves. What its move leaves at the middle of the
# cell is computed exactly; then what the moves of the four cells beside it leave there.
# A height is never lower than what the moves leave. Where the best move was not among those looked at it is higher, by no
# more than if each cutter were thinner by `ERROR` cells: material may stand so far before a wall or on a rib. That is rare:
# of a surface that a ball of 3 mm finishes on cells of 0.2 mm, two cells in three are exact and the mean is 0.01 mm too high.

ERROR = 2 * SNAP + 0.5 / PIECES  # cells: a tip in its cell, the found one in its cell, the place between two tips
ROWS, COLUMNS = 32, 512  # cells of a tile
BESIDE = ((0, 1), (0, -1), (1, 0), (-1, 0))  # rows and columns to the cells whose moves are tried too
BEFORE_AND_AFTER = (0, -1, 1)  # moves that are tried at the rim


class Eroded(NamedTuple):
    """`heights` (ny, nx) mm; `move` (ny, nx): which one left a cell so, -1 where none cut."""

    heights: Array
    move: NDArray[np.int32]


def eroded(raster: Raster, moves: Moves, top: Array) -> Eroded:
    """What moves leave of material that reaches up to `top` (ny, nx), at the middles of the cells of a raster."""
    found = Eroded(np.array(top, dtype=np.float64), np.full(raster.shape, -1, dtype=np.int32))
    for cutter, which in moves.by_cutter(reaching(raster, moves, float(top.max()))):
        footprint = Footprint.of(cutter, raster.step)
        tips = tips_of(raster, moves, which, footprint.reach)
        for j in range(0, raster.shape[0], ROWS):
            for i in range(0, raster.shape[1], COLUMNS):
                tile = slice(j, min(j + ROWS, raster.shape[0])), slice(i, min(i + COLUMNS, raster.shape[1]))
                _erode(raster, moves, footprint, tips, tile, found)
    return found


def reaching(raster: Raster, moves: Moves, below: float) -> Index:
    """The moves that may reach the raster below a height."""
    (x0, y0), (ny, nx) = raster.low, raster.shape
    x1, y1, found = x0 + nx * raster.step, y0 + ny * raster.step, []
    for first in range(0, len(moves), AT_ONCE):
        some = moves[first : first + AT_ONCE]
        boxes = some.boxes
        near = (boxes[:, 0] <= x1) & (boxes[:, 1] <= y1) & (boxes[:, 2] >= x0) & (boxes[:, 3] >= y0)
        found.append(first + np.flatnonzero(near & (some.low < below)))
    return np.concatenate([np.zeros(0, dtype=np.int64), *found])


def _erode(
    raster: Raster, moves: Moves, footprint: Footprint, tips: Tips, tile: tuple[slice, slice], found: Eroded
) -> None:
    """Lowers the cells of a tile; one without tips costs nothing."""
    rows, columns = (slice(each.start, each.stop + 2 * footprint.reach) for each in tile)
    low, heights = tips.low[rows, columns], found.heights[tile]
    here = low < heights.max()
    if not here.any():
        return
    search, owner, tip = Search.over(low, here, footprint), tips.move[rows, columns].reshape(-1), low.reshape(-1)
    cells = _Cells(moves, *raster.middles(tile), heights.flatten(), found.move[tile].flatten())
    cuts, place = search.sure()
    sure = np.flatnonzero(cuts)
    cells.lower(sure, owner[place[sure]])
    may, place = search.rim()
    rim = np.flatnonzero(may & (tip[place] + footprint.least < cells.heights))
    for other in BEFORE_AND_AFTER:
        cells.lower(rim, np.clip(owner[place[rim]] + other, 0, len(moves) - 1))
    cells.lower_beside(heights.shape)
    found.heights[tile], found.move[tile] = cells.heights.reshape(heights.shape), cells.move.reshape(heights.shape)


class _Cells(NamedTuple):
    """The cells (m,) of a tile, and which move left them so."""

    moves: Moves
    x: Array
    y: Array
    heights: Array
    move: NDArray[np.int32]

    def lower(self, cells: Index, tried: NDArray[np.int32]) -> None:
        """Some cells (k,), each to what a move that is tried there leaves."""
        left = left_by(self.moves[tried.astype(np.int64)], self.x[cells, None], self.y[cells, None])[:, 0]
        cut = left < self.heights[cells]
        self.heights[cells[cut]], self.move[cells[cut]] = left[cut], tried[cut]

    def lower_beside(self, shape: tuple[int, ...]) -> None:
        """Each cell to what the moves of the cells beside it leave."""
        index = np.arange(len(self.move)).reshape(shape)
        for rows, columns in BESIDE:
            other = np.roll(index, (-rows, -columns), axis=(0, 1)).reshape(-1)
            differs = np.flatnonzero((self.move[other] >= 0) & (self.move[other] != self.move))
            self.lower(differs, self.move[other[differs]])


# A part that very many moves left, by erosion: its map, what was taken away, and which row took what.
# Rows are told apart chunk by chunk: the moves go in `CHUNKS` lots, one after the other, and what a lot took away is shared
# out over its moves by their way times the depth of their tip. The heights of the map come from all moves at once.

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
        shape = np.stack(moves.shape, axis=1)
        changes = np.flatnonzero((shape[1:] != shape[:-1]).any(axis=1)) + 1
        ends = np.arange(1, CHUNKS) * len(moves) // CHUNKS
        if len(changes) <= CHUNKS:
            ends = np.union1d(ends, changes)
        yield from (lot for lot in np.split(np.arange(len(moves)), ends) if len(lot))
