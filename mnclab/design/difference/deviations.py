"""All that was looked at, and how far it is off: places of upright faces, of slanting ones and of floors, and cells."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from mnclab.design.difference.columns import Cells, Columns, cells, columns, distances, off
from mnclab.design.difference.rays import FIRST, sides, ways
from mnclab.design.difference.target import Grid, Slopes, Target, Walls
from mnclab.path.toolpath import Array, Index, Mask
from mnclab.workpiece.milling.milled import Milled
from mnclab.workpiece.milling.raster import NOISE
from mnclab.workpiece.milling.volumes import ROUGH

SPACINGS = 80  # places along the longer side of a target
TOUCHING = 1e-7  # mm, by which a place may lie beyond a face that it is on
BETWEEN = (np.arange(8) + 0.5) / 8  # of a ray, where it must not have crossed the target
MOST, AT_EDGES = 4_000, 500  # rays in the middle and at edges of walls; of more of them every second one is followed, or third


@dataclass(frozen=True, eq=False)
class Seen:
    """`error` mm: what may be hidden, `least`: less than that is nothing.

    `moved` (k,) is how far each place of a wall is off along its normal, + towards the void, nan where no wall was found,
    `rise` (m,) how much higher than it should be the workpiece is at places of slopes and floors, `off` (k + m + c,) how far
    all places and the cells are off, `place` (…, 3) where, `void` (…, 3) beside it, outside the material.
    """

    workpiece: Milled
    target: Target
    error: float
    least: float
    grid: Grid
    walls: Walls
    slopes: Slopes
    cells: Cells
    moved: Array
    rise: Array
    off: Array
    place: Array
    void: Array
    known: Index | None = None

    @property
    def of_walls(self) -> slice:
        return slice(0, len(self.walls.z))

    @property
    def of_slopes(self) -> slice:
        return slice(len(self.walls.z), len(self.walls.z) + len(self.slopes.z))

    @property
    def of_cells(self) -> slice:
        return slice(self.of_slopes.stop, self.of_slopes.stop + len(self.cells.value))

    @cached_property
    def owner(self) -> Index:
        """Whose face each place is off (k + m + c,): the nearest; but where a floor is off by as much all over, all of it
        is the floor's."""
        if self.known is not None:
            return self.known
        cells, off_ = self.cells, np.abs(self.off)
        above, below = (each[cells.row, cells.column].astype(np.int64) for each in (self.grid.owner, self.grid.under))
        floors = np.where(cells.side >= 0, above, below)
        own = np.concatenate([self.walls.owner[self.walls.spot], self.slopes.owner, floors])
        with np.errstate(invalid="ignore"):
            by = np.concatenate([np.abs(self.moved), np.abs(self.rise), np.abs(cells.at.top - cells.at.its_top)])
        by[self.of_cells] = np.where(cells.side != 0, off_[self.of_cells], by[self.of_cells])
        deepest = np.zeros(int(max(own.max(initial=0), 0)) + 2)
        np.maximum.at(deepest, floors[cells.plain], off_[self.of_cells][cells.plain])
        with np.errstate(invalid="ignore"):
            whole = np.zeros(len(own), dtype=bool)
            whole[self.of_cells] = by[self.of_cells] <= deepest[floors] + NOISE
            away = np.flatnonzero((off_ > 0) & ~(np.abs(by - off_) <= NOISE) & ~whole)
        own[away] = self.target.owners(self.place[away], off_[away])
        return own

    def cells_above(self, owners: list[int], back: bool) -> Index:
        """Which of the cells have the upper side of one of some owners, or the lower."""
        order, sorted_ = self._by_owner[back]
        ends = zip(np.searchsorted(sorted_, owners), np.searchsorted(sorted_, owners, side="right"))
        return np.sort(np.concatenate([order[:0], *(order[a:b] for a, b in ends)]))

    @cached_property
    def _by_owner(self) -> list[tuple[Index, Index]]:
        found = []
        for whose in (self.grid.owner, self.grid.under):
            mine = whose[self.cells.row, self.cells.column].astype(np.int64)
            order = np.argsort(mine, kind="stable").astype(np.int64)
            found.append((order, mine[order]))
        return found

    @cached_property
    def sizes(self) -> tuple[Index, Index]:
        """How many cells are the upper side of each owner, and how many the lower; the first is that of none."""
        most = int(max(self.walls.owner.max(), self.grid.owner.max(), self.grid.under.max(), self.slopes.owner.max(initial=0)))
        above, below = (np.bincount(each.ravel() + 1, minlength=most + 2) for each in (self.grid.owner, self.grid.under))
        return above, below

    def with_places(self, place: Array, off_: Array, owner: Index) -> Seen:
        """The same with more places (n, 3) that were looked at, off by `off_` (n,); they count for no size."""
        there = [np.concatenate(pair) for pair in ((self.off, off_), (self.place, place), (self.void, place + [0, 0, FIRST]))]
        return replace(self, off=there[0], place=there[1], void=there[2], known=np.concatenate([self.owner, owner]))


def seen(workpiece: Milled, target: Target) -> Seen:
    """Everything that a workpiece can be looked at for beside a target."""
    error = max(workpiece.error, target.error, NOISE)
    least = max(NOISE if workpiece.many else workpiece.error, target.error, NOISE)
    spacing = float((target.bounds[1] - target.bounds[0])[:2].max()) / SPACINGS
    walls, slopes, grid = target.walls(spacing), target.slopes(spacing, workpiece.step), target.grid(workpiece.raster)
    found = cells(workpiece, target, grid, least)
    moved, of_walls, at_walls, void_walls = _walls(workpiece, target, walls, max(FIRST, least))
    rise, of_slopes, at_slopes = _slopes(workpiece, target, slopes)
    at_cells = np.stack([found.at.x, found.at.y, found.z], axis=1)
    place = np.concatenate([at_walls, at_slopes, at_cells])
    void = np.concatenate([void_walls, at_slopes + [0, 0, FIRST], at_cells + [0, 0, FIRST]])
    off_ = np.concatenate([of_walls, of_slopes, found.value])
    off_[np.abs(off_) <= least] = 0.0
    return Seen(workpiece, target, error, least, grid, walls, slopes, found, moved, rise, off_, place, void)


def _walls(workpiece: Milled, target: Target, walls: Walls, aside: float) -> tuple[Array, Array, Array, Array]:
    """How far the walls moved (k,), how far they are off (k,), where (k, 3), and the void beside it (k, 3)."""
    behind, before = walls.place - aside * walls.normal, walls.place + aside * walls.normal
    floor, top = (each.reshape(2, -1)[:, walls.spot] for each in sides(workpiece, *np.concatenate([behind, before]).T))
    there = (floor <= walls.z) & (walls.z <= top) & (top > floor)
    gouged, left = ~there[0], there[1]
    moved, found = np.zeros(len(walls.z)), np.zeros(len(walls.z))
    normal = walls.normal[walls.spot]
    place = np.concatenate([walls.place[walls.spot], walls.z[:, None]], axis=1)
    void = place + FIRST * np.pad(normal, ((0, 0), (0, 1)))
    reach = float(np.linalg.norm(target.bounds[1] - target.bounds[0]))
    for some, sign in ((gouged, -1.0), (left & ~gouged, 1.0)):
        index = np.flatnonzero(some)
        moved[index] = np.nan
        mid, edge = index[walls.mid[index]], index[~walls.mid[index]]
        index = np.concatenate([mid[:: len(mid) // MOST + 1], edge[:: len(edge) // AT_EDGES + 1]])
        if not len(index):
            continue
        origin, direction = place[index, :2], sign * normal[index]
        way, before_ = ways(workpiece, origin, direction, place[index, 2], np.full(len(index), sign > 0), reach)
        ends = np.isfinite(way)
        at = np.where(ends, way, 0.0)[:, None]
        there_ = np.concatenate([origin + at * direction, place[index, 2:]], axis=1)
        value = sign * distances(target, *there_.T)
        good = ends & (value > -TOUCHING)
        aside_ = np.flatnonzero(good & (np.abs(way - value) > TOUCHING))  # another face is nearer: it may have been crossed
        if len(aside_):
            between = origin[aside_, None] + (at[aside_] * BETWEEN)[..., None] * direction[aside_, None]
            heights = np.broadcast_to(place[index[aside_], 2:], between.shape[:2])
            within = sign * distances(target, between[..., 0].ravel(), between[..., 1].ravel(), heights.ravel())
            good[aside_] = (within.reshape(len(aside_), -1) > -TOUCHING).all(axis=1)
        moved[index[good]], found[index[good]] = sign * way[good], sign * np.maximum(value[good], 0.0)
        place[index[good]] = there_[good]
        step = np.pad(normal[index[good]], ((0, 0), (0, 1)))
        void[index[good]] = there_[good] + 2 * FIRST * step
        lost = index[~good]
        if len(lost):
            found[lost], place[lost] = _farthest(target, place[lost], sign * normal[lost], sign, reach)
            void[lost] = place[lost]
    return moved, found, place, void


def _farthest(target: Target, place: Array, direction: Array, sign: float, reach: float) -> tuple[Array, Array]:
    """Where rays that meet no end are farthest off the target, before they come to its other face: how far (k,), (k, 3)."""
    steps = np.append(0.0, FIRST * 2.0 ** np.arange(int(np.log2(reach / FIRST)) + 1))
    spots = place[:, None] + steps[:, None] * np.pad(direction, ((0, 0), (0, 1)))[:, None]
    value = sign * distances(target, *spots.reshape(-1, 3).T).reshape(len(place), -1)
    crossed = np.zeros(value.shape, dtype=bool)  # between two places that are not farther apart than from it lies none of it
    crossed[:, 1:] = value[:, 1:] + value[:, :-1] < np.diff(steps) - TOUCHING
    best = np.where(np.logical_or.accumulate(crossed, axis=1), -1.0, value).argmax(axis=1)
    every = np.arange(len(place))
    return sign * np.maximum(value[every, best], 0.0), spots[every, best]


def _slopes(workpiece: Milled, target: Target, slopes: Slopes) -> tuple[Array, Array, Array]:
    """How much too high the workpiece is at places of slopes (m,), how far it is off (m,), and where (m, 3)."""
    x, y = slopes.place.T
    at = columns(sides(workpiece, x, y), target.faces(x, y), x, y)
    ours = np.where(slopes.up, at.top, at.floor)
    none = np.isnan(ours)
    ours[none] = np.where(slopes.up, workpiece.blank_at(x, y)[1], at.its_top)[none]
    rise = np.where(slopes.up, 1.0, -1.0) * (ours - slopes.z)
    value, height = np.zeros(len(x)), ours.copy()
    differ = at.differ(NOISE)
    value[differ], height[differ] = off(target, at.some(differ))
    return rise, value, np.stack([x, y, height], axis=1)


# How much was gouged away and how much is left over, mm³: cells where a face of either stands are seen at many points.

LATTICES = ((89, 55), (55, 34), ROUGH, (13, 8), (8, 5))  # points in a cell, and their turn
POINTS = 300_000  # at most, as far as the lattices go
SHIFTS = np.array([0.7548776662466927, 0.5698402909980532])  # of a cell: those of many cells lie evenly
CHUNK = 100_000
ALIKE = 1e-6  # of what is off: neighbours that differ by less tell the same
MARKS = 3  # places of a cell's width along a wall


def volumes(seen: Seen) -> tuple[float, float]:
    """What is gone and what is left over; exactly 0 of a part that is nowhere off."""
    if not seen.off.any():
        return 0.0, 0.0
    workpiece, cells, shape = seen.workpiece, seen.cells, seen.grid.top.shape
    gone, left = np.zeros(shape), np.zeros(shape)
    counts = seen.off[seen.of_cells] != 0
    gone[cells.row, cells.column], left[cells.row, cells.column] = counts * thickness(cells.at, seen.least)
    close = _uneven(gone) | _uneven(left) | _crossed(seen)
    for edge in (0, -1):
        close[edge] |= (gone[edge] > 0) | (left[edge] > 0)
        close[:, edge] |= (gone[:, edge] > 0) | (left[:, edge] > 0)
    row, column = np.nonzero(close)
    area = workpiece.step**2
    found = np.array([float(gone[~close].sum()), float(left[~close].sum())]) * area
    lattice = next((each for each in LATTICES if len(row) * each[0] <= POINTS), LATTICES[-1])
    many = CHUNK // lattice[0]
    shifts = np.arange(len(row))[:, None] * SHIFTS % 1.0
    for k in range(0, len(row), many):
        x, y = workpiece.raster.x[column[k : k + many]], workpiece.raster.y[row[k : k + many]]
        x, y = _within(x, y, shifts[k : k + many], workpiece.step, lattice)
        at = columns(sides(workpiece, x, y), seen.target.faces(x, y), x, y)
        found += np.array([float(each.sum()) for each in thickness(at, seen.least)]) * area / lattice[0]
    return float(found[0]), float(found[1])


def thickness(at: Columns, error: float) -> tuple[Array, Array]:
    """How much of columns (m,) is gone and how much is left over, mm."""
    floor, top, its_floor, its_top = (np.nan_to_num(each, nan=0.0) for each in (at.floor, at.top, at.its_floor, at.its_top))
    both = np.maximum(np.minimum(top, its_top) - np.maximum(floor, its_floor), 0.0)
    both[np.isnan(at.top) | np.isnan(at.its_top)] = 0.0
    gone, left = its_top - its_floor - both, top - floor - both
    return np.where(gone > error, gone, 0.0), np.where(left > error, left, 0.0)


def _within(x: Array, y: Array, shifts: Array, step: float, lattice: tuple[int, int]) -> tuple[Array, Array]:
    """The points (m n,) of a lattice in each of m cells about their middles, in each of them shifted by a share of the cell
    (m, 2): many cells along one wall see it at many places, however few points each has."""
    count, turn = lattice
    along = np.arange(count)
    shares = (along + 0.5) / count, (along * turn % count + 0.5) / count
    px, py = (step * ((share + shift[:, None]) % 1.0 - 0.5) for share, shift in zip(shares, shifts.T))
    return (x[:, None] + px).ravel(), (y[:, None] + py).ravel()


def _uneven(thick: Array) -> Mask:
    """Cells (ny, nx) beside which less or more is off."""
    ny, nx = thick.shape
    if not thick.any():
        return np.zeros(thick.shape, dtype=bool)
    wide: Array = np.pad(thick, 1, mode="edge")
    most, least = (_of_three(_of_three(wide, which, 0), which, 1) for which in (np.maximum, np.minimum))
    return np.asarray(most - least > ALIKE * most)


def _of_three(cells: Array, which: np.ufunc, axis: int) -> Array:
    """The greatest, or the least, of each cell and both beside it along an axis, but for the first and the last."""
    one, two, three = (np.take(cells, range(k, cells.shape[axis] - 2 + k), axis) for k in range(3))
    return np.asarray(which(which(one, two), three))


def _beside(found: Mask) -> Mask:
    """Cells (ny, nx) and those about them."""
    wide = np.pad(found, 1)
    rows = wide[:-2] | wide[1:-1] | wide[2:]
    return np.asarray(rows[:, :-2] | rows[:, 1:-1] | rows[:, 2:])


def _crossed(seen: Seen) -> Mask:
    """Cells (ny, nx) about walls that are off, which may stand between the middles of cells."""
    walls, raster, (ny, nx) = seen.walls, seen.workpiece.raster, seen.grid.top.shape
    found = np.zeros((ny, nx), dtype=bool)
    index = np.flatnonzero((seen.off[seen.of_walls] != 0) & np.isfinite(seen.moved))
    if not len(index):
        return found
    place, moved = walls.place[walls.spot[index]], seen.moved[index, None] * walls.normal[walls.spot[index]]
    longest = float(np.abs(moved).max())
    along = walls.normal[walls.spot[index]] @ np.array([[0.0, 1.0], [-1.0, 0.0]])
    gap = float((seen.target.bounds[1] - seen.target.bounds[0])[:2].max()) / 80
    side = np.arange(-gap, gap + raster.step, raster.step / MARKS)
    deep = np.linspace(0.0, 1.0, min(int(longest / raster.step * MARKS) + 2, 50))
    for share in deep:
        spots = (place + share * moved)[:, None] + side[:, None] * along[:, None]
        column, row = np.floor((spots.reshape(-1, 2) - np.array(raster.low)) / raster.step).astype(int).T
        inside = (row >= 0) & (row < ny) & (column >= 0) & (column < nx)
        found[row[inside], column[inside]] = True
    return _beside(found)
