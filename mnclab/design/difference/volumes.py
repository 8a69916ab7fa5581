"""How much was gouged away and how much is left over, mm³: cells where a face of either stands are seen at many points."""

from __future__ import annotations

import numpy as np

from mnclab.design.difference.columns import Columns, columns
from mnclab.design.difference.deviations import Seen
from mnclab.design.difference.rays import sides
from mnclab.path.toolpath import Array, Mask
from mnclab.workpiece.milling.volumes import ROUGH

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
