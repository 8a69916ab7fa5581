"""Rows, grids, frames and circles of points, in the order in which a tool goes to them.

Lengths in mm, angles in rad, counter-clockwise from the first axis; every function gives the points (n, 2).
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

Points = NDArray[np.float64]
Pair = tuple[float, float]

TURN = 2 * math.pi


def row(start: Pair, spacing: float, count: int, rotation: float = 0.0) -> Points:
    """Points on a straight line from `start`, `spacing` apart in the direction `rotation`."""
    along = np.arange(count)[:, None] * spacing
    return np.array(start) + along * [math.cos(rotation), math.sin(rotation)]


def grid(start: Pair, spacing: Pair, count: tuple[int, int], rotation: float = 0.0, lean: Pair = (0.0, 0.0)) -> Points:
    """Columns along the first axis, rows along the second, row by row, to and fro.

    The whole is turned about `start` by `rotation`; `lean` turns each of its two axes further, and the spacing
    along them stays.
    """
    i, j = (index.ravel() for index in np.meshgrid(np.arange(count[0]), np.arange(count[1])))
    i = np.where(j % 2 == 0, i, count[0] - 1 - i)
    return _placed(i, j, start, spacing, rotation, lean)


def frame(start: Pair, spacing: Pair, count: tuple[int, int], rotation: float = 0.0, lean: Pair = (0.0, 0.0)) -> Points:
    """The outer points of a grid, once around from `start`, the first row first."""
    last, top = count[0] - 1, count[1] - 1
    if last == 0 or top == 0:
        return grid(start, spacing, count, rotation, lean)
    across, up = np.arange(last), np.arange(top)
    i = np.concatenate([across, np.full(top, last), last - across, np.zeros(top, dtype=int)])
    j = np.concatenate([np.zeros(last, dtype=int), up, np.full(last, top), top - up])
    return _placed(i, j, start, spacing, rotation, lean)


def _placed(
    i: NDArray[np.integer], j: NDArray[np.integer], start: Pair, spacing: Pair, rotation: float, lean: Pair
) -> Points:
    """The points of columns `i` and rows `j` of a grid."""
    first, second = rotation + lean[0], rotation + lean[1]
    u = np.array([math.cos(first), math.sin(first)]) * spacing[0]
    v = np.array([-math.sin(second), math.cos(second)]) * spacing[1]
    return np.array(start) + i[:, None] * u + j[:, None] * v


def circle(centre: Pair, radius: float, start: float, step: float, count: int) -> Points:
    """Points on a circle from the angle `start`, each turned by `step` from the one before."""
    angle = start + np.arange(count) * step
    return np.array(centre) + radius * np.column_stack([np.cos(angle), np.sin(angle)])


def step_between(start: float, end: float, count: int, closed: bool = False) -> float:
    """The angle from point to point of `count` from `start` to `end`; on a `closed` circle the last lies one step before it."""
    gaps = count if closed else count - 1
    return (end - start) / gaps if gaps else 0.0
