"""A difference of two programs, and those in a row as one."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np

from mnclab.comparison.motion import NO_WAY, Motion
from mnclab.path.toolpath import Array, Index, Toolpath

RATE = 0.005  # of a feed, a speed or a dwell: as much goes by rounding in inches
CENTRE = 20  # as far apart may be the centres of arcs, in tolerances of their ends
NONE = "none before this block"


class Found(NamedTuple):
    """One difference: its `kind`, `rows` of both paths (-1: there is none), by how much, what each has, for how many moves."""

    kind: str
    rows: tuple[int, int]
    amount: float
    unit: str
    values: tuple[str, str]
    moves: int = 1


def row_of(motion: Motion, rank: int) -> int:
    """The row of a cut by its rank; -1 where there is none."""
    return int(motion.row[motion.cuts[rank]]) if 0 <= rank < len(motion.cuts) else -1


def rows_of(one: Motion, i: int, other: Motion, j: int) -> tuple[int, int]:
    """The rows of two cuts by their ranks."""
    return row_of(one, i), row_of(other, j)


def grouped(
    kind: str, one: Motion, i: Index, other: Motion, j: Index, said: Callable[[int], tuple[str, str]], off: Any = None,
    unit: str = "mm", values: tuple[Array, ...] = (),
) -> list[Found]:  # fmt: skip
    """Differences of a kind at cuts by their ranks (k,): those that follow each other, with the same `values`, are one."""
    if not len(i):
        return []
    off = np.zeros(len(i)) if off is None else off
    new = (np.diff(i) != 1) | (np.diff(j) != 1)
    for each in values:
        new |= (each[1:] != each[:-1]) & ~(np.isnan(each[1:]) & np.isnan(each[:-1]))
    first = np.flatnonzero(np.append(True, new))
    moves = np.diff(np.append(first, len(i)))
    return [
        Found(kind, rows_of(one, int(i[k]), other, int(j[k])), float(much), unit, said(k), many)
        for k, much, many in zip(first.tolist(), off[first].tolist(), moves.tolist())
    ]


def from_where(one: Motion, other: Motion, rows: tuple[int, int], tolerance: float) -> tuple[int, int]:
    """The rows from which on two moves are not the same that are made of several blocks, which may be alike at first."""
    looks = [motion.last[np.searchsorted(motion.row, row, "right") - 1] - row + 1 for motion, row in zip((one, other), rows)]
    return first_apart((one.path, other.path), rows, tolerance, int(max(looks)))


def first_apart(
    paths: tuple[Toolpath, Toolpath], rows: tuple[int, int], tolerance: float, look: int, sides: bool = False
) -> tuple[int, int]:
    """The first two of so many rows of two paths that are not the same, with their `sides` if asked, else the first of all."""
    found = []
    for path, row in zip(paths, rows):
        some = path[row : row + look]
        found.append(row + np.flatnonzero(some.is_motion & (some.lengths > NO_WAY)))
    many = min(map(len, found))
    a, b = (each[:many] for each in found)
    one, other = paths
    odd = np.linalg.norm(one.end[a] - other.end[b], axis=1) > tolerance
    odd |= (one.kind[a] != other.kind[b]) | (np.sign(one.sweep[a]) != np.sign(other.sweep[b]))
    odd |= sides & (one.side[a] != other.side[b])
    odd |= np.linalg.norm(np.nan_to_num(one.centre[a] - other.centre[b]), axis=1) > CENTRE * tolerance
    return (int(a[odd.argmax()]), int(b[odd.argmax()])) if odd.any() else rows
