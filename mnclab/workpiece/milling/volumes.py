"""What was taken away, in mm³: cells where a wall stands weigh by the share of them that is covered.

A wall is where the rim of a tool has been, or the rim of the blank; a groove that a point or a ball scratches, no wider
than a few cells, counts as one. A cell that one of them may cross is seen at the points of a lattice within it, whose
places along x are evenly spaced, and along y too; so, with fewer points, is a cell that bends or is bent beside its
neighbours; every other cell is seen at its middle. The heights are exact at all of these points.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from mnclab.path.toolpath import Array, Index, Mask
from mnclab.workpiece.milling.moves import Moves, edge_height
from mnclab.workpiece.milling.raster import NOISE, chunks, near
from mnclab.workpiece.milling.sweep import Sweep
from mnclab.workpiece.milling.swept import left_by

FINE, ROUGH = (89, 55), (21, 13)  # points of a lattice and its turn: neighbours in Fibonacci's series
LATTICES = (FINE, (55, 34), (34, 21), ROUGH, (13, 8), (8, 5), (5, 3), (1, 1))
EFFORT = 100_000_000  # points times moves, by which the lattice is chosen
MANY = 5_000  # moves, beyond which what each of them took is told from the middles of the cells alone
HALF = 0.75  # of a cell, a little more than its corners are away from its middle
STEEP = 3.0  # times what the slope of a move explains: a wall
LOW = 0.002  # of how deep its foot lies in the blank: a lower wall is not looked at
THIN = 1.5  # cells from its axis to its edges: a groove so thin may lie between the middles
BENT = 1e-3  # of what was taken away about a cell, by which its middle may be off


def removed(sweep: Sweep, heights: Array) -> float:
    """What all moves took away together, mm³; `heights` (ny, nx) are what they leave at the middles."""
    rims, raster, (top, _) = Rims(sweep), sweep.raster, sweep.blank
    walls, bends, pairs = np.zeros(raster.shape, dtype=bool), np.zeros(raster.shape, dtype=bool), np.zeros(2, dtype=np.int64)
    taken, ends = sweep.over(sweep.taken) if sweep.gaps else top - heights, blank_ends(sweep)
    bent = _bent(taken)
    for tile in raster.tiles():
        x, y = raster.middles(tile)
        crossed, moves = rims.standing(x, y, top[tile].ravel(), _highest(heights, tile))
        walls[tile] = crossed.reshape(walls[tile].shape) | ends[tile]
        bends[tile] = bent[tile] & ~walls[tile]
        pairs += int(walls[tile].sum()) * moves, int(bends[tile].sum()) * moves
    total = float(taken[~walls & ~bends].sum()) * raster.step**2
    for cells, lattice in ((walls, _lattice(int(pairs[0]), FINE)), (bends, _lattice(int(pairs[1]), ROUGH))):
        for tile in raster.tiles():
            some = cells[tile].ravel()
            x, y = raster.middles(tile)
            x, y = within(x[some], y[some], raster.step, lattice)
            if len(x):
                total += float(sweep.taken(x, y).sum()) * raster.step**2 / lattice[0]
    return total


def _bent(taken: Array) -> Mask:
    """Cells (ny, nx) whose middle tells too little of how much was taken away (ny, nx) mm about it."""
    wide = np.pad(taken, 1, mode="edge")
    beside = np.stack([wide[:-2, 1:-1], wide[2:, 1:-1], wide[1:-1, :-2], wide[1:-1, 2:]])
    off = np.abs(beside.sum(axis=0) - 4 * taken) / 24  # of an even bend: what the middle misses of the mean
    return np.asarray(off > np.maximum(BENT * np.maximum(beside.max(axis=0), taken), NOISE))


def removed_by_row(sweep: Sweep, rows: int) -> Array:
    """What each of so many rows took away (rows,), mm³, on a coarser lattice."""
    if sweep.gaps:
        return _in_turn(sweep, rows)
    rims, raster, found = Rims(sweep), sweep.raster, np.zeros(rows)
    for tile in sweep.tiles:
        x, y = raster.middles(tile)
        crossed, moves = rims.passing(x, y) if len(sweep.moves) <= MANY else (np.zeros(len(x), dtype=bool), 0)
        lattice = _lattice(int(crossed.sum()) * moves * (raster.shape[0] * raster.shape[1] // len(x)), ROUGH)
        spots = within(x[crossed], y[crossed], raster.step, lattice)
        for points, count in (((x[~crossed], y[~crossed]), 1), (spots, lattice[0])):
            if len(points[0]):
                for which, before, after in sweep.in_order(*points):
                    taken = before - after
                    volumes = np.where(taken > NOISE, taken, 0.0).sum(axis=1) * raster.step**2 / count
                    np.add.at(found, sweep.moves.row[which], volumes)
    return found


def _in_turn(sweep: Sweep, rows: int) -> Array:
    """The same of moves of several directions, at the middles of cells and at a lattice where these tell too little; of fewer
    columns where many moves come near."""
    assert sweep.gaps is not None
    raster, found = sweep.raster, np.zeros(rows)
    bent = _bent(sweep.over(sweep.taken)) | blank_ends(sweep)
    for tile in raster.tiles():
        (x, y), some = raster.middles(tile), bent[tile].ravel()
        spots = within(x[some], y[some], raster.step, ROUGH)
        for points, count in (((x[~some], y[~some]), 1), (spots, ROUGH[0])):
            if len(points[0]):
                found += sweep.gaps.shares(sweep.moves, sweep.faces, *points, rows) * raster.step**2 / count
    return found


def _lattice(pairs: int, finest: tuple[int, int]) -> tuple[int, int]:
    """The finest lattice that so many cells times moves allow."""
    return next((each for each in LATTICES if each <= finest and each[0] * pairs <= EFFORT), LATTICES[-1])


def blank_ends(sweep: Sweep) -> Mask:
    """Cells (ny, nx) that may lie partly beside the blank: the middle of one of the eight beside them lies on the other side.

    Those at the rim of the map are seen at their outer sides too: the last of a row or a column may stand over.
    """
    raster, inside = sweep.raster, np.greater(*sweep.blank)
    wide, half = np.pad(inside, 1, mode="edge"), raster.step * (0.5 - 1e-9)
    for end, way in ((0, -half), (-1, half)):
        wide[end, 1:-1] = np.greater(*sweep.faces(raster.x, np.full(len(raster.x), raster.y[end] + way)))
        wide[1:-1, end] = np.greater(*sweep.faces(np.full(len(raster.y), raster.x[end] + way), raster.y))
    (ny, nx), found = inside.shape, np.zeros_like(inside)
    for j in range(3):
        for i in range(3):
            found |= wide[j : j + ny, i : i + nx] != inside
    return found


@dataclass(frozen=True, eq=False)
class Rims:
    """Where the rims of the tools cross cells."""

    sweep: Sweep

    def standing(self, x: Array, y: Array, top: Array, material: Array) -> tuple[Mask, int]:
        """Cells (m,) where a rim has been lower than the material about them; how many moves come near."""
        found = np.zeros(len(x), dtype=bool)
        moves = near(self.wide, self.boxes, x, y, float((top if self.within_cells.any() else material).max()))
        for which in chunks(moves, len(x)):
            crosses, height = self._crossing(which, x, y)
            stood = np.where(self.within_cells[which, None], top, material)  # the middles do not tell
            found |= (crosses & _stands(stood, height, top)).any(axis=0)
        return found, len(moves)

    def passing(self, x: Array, y: Array) -> tuple[Mask, int]:
        """Cells (m,) where a rim has been lower than the material at its time; how many moves come near."""
        found, top = np.zeros(len(x), dtype=bool), self.sweep.faces(x, y)[0]
        moves, heights = near(self.wide, self.boxes, x, y, float(top.max())), top
        for which in chunks(moves, len(x)):
            crosses, height = self._crossing(which, x, y)
            left = left_by(self.sweep.moves[which], x, y)
            upto = np.minimum.accumulate(np.concatenate([heights[None], left]), axis=0)
            found |= (crosses & _stands(upto[:-1], height, top)).any(axis=0)
            heights = upto[-1]
        return found, len(moves)

    def _crossing(self, which: Index, x: Array, y: Array) -> tuple[Mask, Array]:
        """Whether the rim of each move may cross each cell (k, m), and how high it is there."""
        height, inner = left_by(self.wide[which], x, y), left_by(self.narrow[which], x, y)
        inner[self.within_cells[which]] = np.inf
        return np.isfinite(height) & (inner > height + self.slack[which, None]), height

    @property
    def half(self) -> float:
        return HALF * self.sweep.raster.step

    @cached_property
    def reach(self) -> Array:
        """How far from the axis each tool may cut in the blank (k,): a point or a ball not as far as its rim."""
        moves = self.sweep.moves
        deep = np.maximum(self.sweep.top - moves.low, 0.0)
        bent = np.sqrt(np.maximum(moves.corner**2 - np.maximum(moves.corner - deep, 0.0) ** 2, 0.0))
        out = np.where(moves.slope > 0, deep / np.where(moves.slope > 0, moves.slope, 1.0), bent)
        return np.asarray(np.minimum(moves.flat + out, moves.radius))

    @cached_property
    def thin(self) -> Mask:
        """Grooves (k,) so thin that their edges are no rims, and may lie between the middles of cells."""
        return np.asarray((self.reach < self.sweep.moves.radius) & (self.reach <= THIN * self.sweep.raster.step))

    @cached_property
    def within_cells(self) -> Mask:
        """Tools and grooves (k,) that are no wider than a cell, or a few: all of a wall may lie within one."""
        return np.asarray(self.thin | (self.sweep.moves.radius <= self.half))

    @cached_property
    def wide(self) -> Moves:
        """Discs that are a little larger than the rims, or than what a thin groove reaches."""
        return self._discs(np.where(self.thin, self.reach, self.sweep.moves.radius) + self.half)

    @cached_property
    def boxes(self) -> Array:
        return self.wide.boxes

    @cached_property
    def narrow(self) -> Moves:
        return self._discs(np.maximum(self.sweep.moves.radius - self.half, 0.0))

    def _discs(self, radius: Array) -> Moves:
        """The moves of flat discs that stand as high as the rims of the tools, in thin grooves as their tips."""
        moves, none = self.sweep.moves, np.zeros_like(radius)
        rim = np.where(self.thin, 0.0, edge_height(*moves.shape))
        return moves.with_cutter(np.stack([radius, radius, none, none], axis=1), rim)

    @cached_property
    def slack(self) -> Array:
        """By how much both discs may differ in height because the moves go up or down (k,)."""
        moves = self.sweep.moves
        length, rise = moves.ways, np.abs(moves.end[:, 2] - moves.start[:, 2])
        slope = np.divide(rise, length, out=np.zeros_like(length), where=length > NOISE)
        return np.asarray(NOISE + STEEP * self.half * slope)


def within(x: Array, y: Array, step: float, lattice: tuple[int, int]) -> tuple[Array, Array]:
    """The points (m n,) of a lattice of n in each of m cells about their middles."""
    count, turn = lattice
    along = np.arange(count)
    px, py = (step * ((place + 0.5) / count - 0.5) for place in (along, (along * turn) % count))
    return (x[:, None] + px).ravel(), (y[:, None] + py).ravel()


def _stands(material: Array, foot: Array, top: Array) -> Mask:
    """Whether material stands high enough over the foot of a wall."""
    with np.errstate(invalid="ignore"):  # no foot: infinitely high
        return np.asarray(material - foot > np.maximum(LOW * (top - foot), NOISE))


def _highest(heights: Array, tile: tuple[slice, slice]) -> Array:
    """The highest material in each cell of a tile and beside it (m,)."""
    rows, columns = (
        np.clip(np.arange(*each.indices(n)) + [[-1], [0], [1]], 0, n - 1) for each, n in zip(tile, heights.shape)
    )
    return np.asarray(heights[rows].max(axis=0)[:, columns].max(axis=1).ravel())
