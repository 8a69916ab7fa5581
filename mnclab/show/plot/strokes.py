"""A path as strokes: points, what each stroke to a point belongs to, and classes of strokes as lines broken by nan.

One line a class, broken where the class changes, costs about what one line of as many points costs; a colour per
stroke would cost forty times that.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from mnclab.path.limits import Limits
from mnclab.path.profile.ramps import courses
from mnclab.path.toolpath import Kind, Toolpath

FINENESS = 10_000  # chord errors in the length of a path's box: about ten in a pixel
BENT, SHORT = 1 / 2000, 1 / 200  # of the box: rapids that leave their line by less, or are shorter, are drawn straight

Array = NDArray[np.float64]


class Strokes(NamedTuple):
    """Points (m, 3), mm; `row` (m,) of the path that the stroke *to* each point belongs to, -1 if no stroke ends."""

    xyz: Array
    row: NDArray[np.int64]


def strokes(path: Toolpath, rapids: Limits | None = None) -> Strokes:
    """All motion of a path, arcs cut finely enough for a picture; a tool change parts the strokes.

    Under the limits of `rapids` axes that do not wait for each other leave the straight line (see `path.profile.ramps`).
    """
    motion = path.is_motion
    whole = bool(motion.all())
    if not motion.any():
        return Strokes(np.empty((0, 3)), np.empty(0, dtype=np.int64))
    rows = np.arange(len(path)) if whole else np.flatnonzero(motion)
    size = _size(path, rows)
    xyz, row = path.points(size / FINENESS)
    row = row.copy()
    row[0] = -1
    start, end = (path.start, path.end) if whole else (path.start[rows], path.end[rows])
    apart = np.zeros(len(rows) - 1, dtype=bool)
    for k in range(3):
        apart |= start[1:, k] != end[:-1, k]
    jumps = rows[1:][apart]
    if len(jumps):  # between them stands a tool change, or what was left out: the move begins elsewhere
        at = np.searchsorted(row, jumps)
        xyz, row = np.insert(xyz, at, path.start[jumps], axis=0), np.insert(row, at, -1)
    if rapids is not None:
        which, places = courses(path, rapids, BENT * size, SHORT * size)
        if len(which):
            stroke = np.zeros(len(path), dtype=np.int64)
            stroke[row[row >= 0]] = np.flatnonzero(row >= 0)
            xyz, row = np.insert(xyz, stroke[which], places, axis=0), np.insert(row, stroke[which], which)
    return Strokes(xyz, row)


def parted(xyz: Array, group: NDArray[np.integer], count: int) -> list[Array]:
    """The strokes of each class 0 … `count` - 1 as one line broken by nan (k, 3), without a stroke an empty one.

    `group` (m,) is the class of the stroke to each point, -1 for none; a stroke begins at the point before.
    """
    order = np.argsort(group.astype(np.int16), kind="stable")
    bounds = np.searchsorted(group[order], np.arange(count + 1))
    return [_line(xyz, order[a:b]) for a, b in zip(bounds[:-1], bounds[1:])]


def line_of(path: Toolpath, kinds: tuple[Kind, ...] = tuple(Kind), rapids: Limits | None = None) -> Array:
    """The moves of some kinds as one line (k, 3), broken by nan where others come between."""
    drawn = strokes(path, rapids)
    wanted = (drawn.row >= 0) & np.isin(path.kind[drawn.row], kinds)
    return parted(drawn.xyz, np.where(wanted, 0, -1), 1)[0]


def _line(xyz: Array, ends: NDArray[np.intp]) -> Array:
    if not len(ends):
        return np.empty((0, 3))
    if ends[-1] - ends[0] + 1 == len(ends):  # without a break: no copy
        return xyz[ends[0] - 1 : ends[-1] + 1]
    breaks = np.flatnonzero(np.diff(ends, prepend=-1) != 1)  # where a stroke does not go on from the last
    before = np.stack([np.full(len(breaks), -1), ends[breaks] - 1], axis=1)  # nan, and where the stroke begins
    order = np.insert(ends, np.repeat(breaks, 2), before.ravel())
    broken = xyz[order]
    broken[order < 0] = np.nan
    return broken[1:]


def _size(path: Toolpath, rows: NDArray[np.intp]) -> float:
    """The greatest side of a box around the cuts of some rows, or all of them where none cuts, mm, not less than 1 µm."""
    cuts = rows[path.kind[rows] != Kind.RAPID]  # rapids that come from far away are cut off in pictures
    rows = cuts if len(cuts) else rows
    low, high = extremes(path.end[rows])
    begin = path.start[rows[0]]
    size = float((np.maximum(high, begin) - np.minimum(low, begin)).max())
    arc = path.kind == Kind.ARC
    radius = np.linalg.norm(path.start[arc] - path.centre[arc], axis=1)
    size += float((np.minimum(2.0, np.abs(path.sweep[arc])) * radius).max(initial=0.0))
    return max(size, 1e-3)


def extremes(xyz: Array) -> tuple[Array, Array]:
    """Least and greatest coordinates (3,) of points (m, 3), passing over nan; column by column, which is quicker."""
    low = np.array([np.fmin.reduce(column) for column in xyz.T])
    return low, np.array([np.fmax.reduce(column) for column in xyz.T])


def corners(clouds: Sequence[Array], centre_line: bool) -> tuple[Array, Array] | None:
    """Least and greatest coordinates (3,) of some points, on request with X 0 among them; None if there are none."""
    found = [extremes(points) for points in clouds if len(points)]
    if not found:
        return None
    low, high = np.min([each[0] for each in found], axis=0), np.max([each[1] for each in found], axis=0)
    if centre_line:
        low[0], high[0] = min(low[0], 0.0), max(high[0], 0.0)
    return low, high
