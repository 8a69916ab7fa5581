"""A difference of two programs, and those in a row as one."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np

from mnclab.comparison.motion import Motion
from mnclab.path.toolpath import Array, Index

RATE = 0.005  # of a feed, a speed or a dwell: as much goes by rounding in inches


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
    most, moves = np.maximum.reduceat(off, first), np.diff(np.append(first, len(i)))
    return [
        Found(kind, rows_of(one, int(i[k]), other, int(j[k])), float(much), unit, said(k), many)
        for k, much, many in zip(first.tolist(), most.tolist(), moves.tolist())
    ]
