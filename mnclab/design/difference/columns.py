"""How far the material of a column is off a target: the greatest distance from the target of what is too much in it, or
of what is gone of it.

What is too much reaches farthest where it is highest, and what is gone where it was cut lowest, as nothing overhangs: the
surface of the workpiece there is looked at. Where something went right through, several heights are.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from mnclab.design.difference.target import Grid, Target
from mnclab.path.toolpath import Array, Index, Mask
from mnclab.workpiece.milling.milled import Milled
from mnclab.workpiece.milling.raster import NOISE

LEVELS = (0.5, 0.1, 0.3, 0.7, 0.9)  # of a column that is gone
SWEPT = 100_000  # cells of a map of very many moves, up to which they are swept again, exactly
CHUNK = 20_000  # points whose distances are looked at together


class Columns(NamedTuple):
    """Material at points (m,), mm: lower and upper side of the workpiece and of the target, nan where there is none."""

    x: Array
    y: Array
    floor: Array
    top: Array
    its_floor: Array
    its_top: Array

    def some(self, which: Mask | Index) -> Columns:
        """Those of some points."""
        return Columns(*(column[which] for column in self))

    def differ(self, error: float) -> Mask:
        here, there = np.isfinite(self.top), np.isfinite(self.its_top)
        with np.errstate(invalid="ignore"):
            off = (np.abs(self.top - self.its_top) > error) | (np.abs(self.floor - self.its_floor) > error)
        return np.asarray(np.where(here & there, off, here ^ there))


def columns(workpiece_sides: tuple[Array, Array], its_sides: tuple[Array, Array], x: Array, y: Array) -> Columns:
    """Columns at points; where the workpiece has no material both its sides are equal."""
    floor, top = workpiece_sides
    none = ~(top > floor)
    return Columns(x, y, np.where(none, np.nan, floor), np.where(none, np.nan, top), *its_sides)


def off(target: Target, at: Columns) -> tuple[Array, Array]:
    """How far columns are off (m,), + what is too much, - what is gone, and at which height (m,)."""
    value, height = np.zeros(len(at.x)), np.where(np.isfinite(at.top), at.top, at.its_top)
    here, there = np.isfinite(at.top), np.isfinite(at.its_top)
    with np.errstate(invalid="ignore"):
        apart = here & there & ((at.top < at.its_floor) | (at.floor > at.its_top))
        both, much, gone = here & there & ~apart, here & (~there | apart), there & (~here | apart)
        looked = [(much | here & (at.top > at.its_top), at.top, 1.0), (much | here & (at.floor < at.its_floor), at.floor, 1.0)]
        looked += [(both & (at.top < at.its_top), at.top, -1.0), (both & (at.floor > at.its_floor), at.floor, -1.0)]
    looked += [(gone, at.its_floor + level * (at.its_top - at.its_floor), -1.0) for level in LEVELS]
    index = np.concatenate([np.flatnonzero(which) for which, _, _ in looked])
    z = np.concatenate([z[which] for which, z, _ in looked])
    sign = np.repeat([sign for _, _, sign in looked], [int(which.sum()) for which, _, _ in looked])
    found = sign * np.maximum(sign * distances(target, at.x[index], at.y[index], z), 0.0)
    order = np.argsort(np.abs(found), kind="stable")  # the last one that is written is the greatest
    value[index[order]], height[index[order]] = found[order], z[order]
    return value, height


def distances(target: Target, x: Array, y: Array, z: Array) -> Array:
    """Signed distances of points (m,) from a target."""
    points = np.stack([x, y, z], axis=1)
    return np.concatenate([target.distance(points[k : k + CHUNK]) for k in range(0, max(len(points), 1), CHUNK)])


class Cells(NamedTuple):
    """Cells that differ: row and column (c,), their columns, how far they are off (c,) and at which height. `side` is 1
    where they are off the upper side of the target, -1 the lower, 0 where another face is nearer; `plain`: edges are
    farther away."""

    row: Index
    column: Index
    at: Columns
    value: Array
    z: Array
    side: Index
    plain: Mask


def cells(workpiece: Milled, target: Target, grid: Grid, error: float) -> Cells:
    """All cells of the raster whose columns differ."""
    raster = workpiece.raster
    top, floor = workpiece.heights, workpiece.floor
    none = ~(top > floor)
    top, floor = np.where(none, np.nan, top), np.where(none, np.nan, floor)
    whole = Columns(np.zeros(0), np.zeros(0), floor, top, grid.floor, grid.top)
    row, column = np.nonzero(whole.differ(error))
    sides = (each[row, column] for each in (floor, top, grid.floor, grid.top))
    at = Columns(raster.x[column], raster.y[row], *sides)
    known = workpiece.error if workpiece.many and len(row) > SWEPT else 0.0
    if workpiece.many and not known:
        row, column, at = _exactly(workpiece, row, column, at, error)
    value, z = np.zeros(len(row)), np.zeros(len(row))
    plain = _plain(workpiece, grid, at, row, column) if len(row) else np.zeros(0, dtype=bool)
    rise = at.top - at.its_top
    value[plain] = np.where(rise > 0, rise, -np.minimum(-rise, at.top - at.its_floor))[plain]
    z[plain] = at.top[plain]
    value[~plain], z[~plain] = off(target, at.some(~plain))
    value[np.abs(value) <= known] = 0.0
    with np.errstate(invalid="ignore"):
        above, below = (np.abs(np.abs(way) - np.abs(value)) <= NOISE for way in (rise, at.its_floor - at.floor))
    return Cells(row, column, at, value, z, np.where(above, 1, np.where(below, -1, 0)), plain)


def _exactly(workpiece: Milled, row: Index, column: Index, at: Columns, error: float) -> tuple[Index, Index, Columns]:
    """The heights of a map are never too low, but may be too high: cells that still differ where all moves are swept."""
    top = workpiece.sweep.at(at.x, at.y)
    at = at._replace(top=np.where(top > workpiece.blank_at(at.x, at.y)[1], top, np.nan))
    at = at._replace(floor=np.where(np.isnan(at.top), np.nan, at.floor))
    keep = at.differ(error)
    return row[keep], column[keep], at.some(keep)


def _plain(workpiece: Milled, grid: Grid, at: Columns, row: Index, column: Index) -> Mask:
    """Cells (c,) about which the target is as flat as they are off, and with one side right: their height tells all."""
    shape, step = grid.top.shape, workpiece.raster.step
    edge = np.ones((shape[0] + 2, shape[1] + 2), dtype=bool)
    edge[1:-1, 1:-1] = False
    for side in (grid.top, grid.floor):
        for axis in (0, 1):
            one, other = np.take(side, range(shape[axis] - 1), axis), np.take(side, range(1, shape[axis]), axis)
            steps = (one != other) & ~(np.isnan(one) & np.isnan(other))
            edge[1:-1, 1:-1] |= np.pad(steps, [(0, axis == 0), (0, axis == 1)]) | np.pad(steps, [(axis == 0, 0), (axis == 1, 0)])
    sums = np.pad(edge.cumsum(axis=0, dtype=np.int32).cumsum(axis=1, dtype=np.int32), ((1, 0), (1, 0)))
    with np.errstate(invalid="ignore"):
        wide = np.nan_to_num(np.abs(at.top - at.its_top), nan=1e9)
        reach = np.minimum(np.ceil(wide / step) + 1, max(shape)).astype(np.int64)
        plain = (at.top > at.its_floor) & (at.floor == at.its_floor)
    j0, j1 = np.clip(row + 1 - reach, 0, None), np.clip(row + 2 + reach, None, shape[0] + 2)
    i0, i1 = np.clip(column + 1 - reach, 0, None), np.clip(column + 2 + reach, None, shape[1] + 2)
    return np.asarray(plain & (sums[j1, i1] - sums[j0, i1] - sums[j1, i0] + sums[j0, i0] == 0))
