"""A plan as pieces of constant jerk (or constant acceleration), in the order of time."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from mnclab.path.columns import Array, Index
from mnclab.path.profile.lookahead import running_sum
from mnclab.path.profile.timing import Plan
from mnclab.text.tables import shapes


class Pieces(NamedTuple):
    """`t`, `s`, `v` (m + 1,) at the nodes; `a` at the start of each piece, `j` and `row` of the plan (m,)."""

    t: Array
    s: Array
    v: Array
    a: Array
    j: Array
    row: Index

    def __repr__(self) -> str:
        return shapes(self)


def pieces(plan: Plan) -> Pieces:
    """All pieces that take time."""
    left_out = plan.rapids.rows if plan.rapids is not None else np.empty(0, dtype=np.int64)
    tables = [_trapezoids(plan) if plan.groups is None else plan.groups.items(plan.seconds, left_out)]
    if plan.rapids is not None:
        tables.append(_rapids(plan))
    row, order, dt, ds, v, a, j = (np.concatenate(column) for column in zip(*tables))
    if len(tables) > 1 or plan.groups is not None:
        sorted_ = np.lexsort((order, row))
        row, dt, ds, v, a, j = (column[sorted_] for column in (row, dt, ds, v, a, j))
    if plan.row is not None:
        row = plan.row[row]
    join = np.zeros(len(row), dtype=bool)  # pieces that only go on at the speed of the one before
    join[1:] = (row[1:] == row[:-1]) & (a[1:] == 0) & (a[:-1] == 0) & (j[1:] == 0) & (j[:-1] == 0)
    join[1:] &= np.abs(v[1:] - v[:-1]) <= 1e-12 * v[1:]
    if join.any():
        first = np.flatnonzero(~join)
        dt, ds = np.add.reduceat(dt, first), np.add.reduceat(ds, first)
        row, v, a, j = row[first], v[first], a[first], j[first]
    return Pieces(running_sum(dt), running_sum(ds), np.append(v, 0.0), a, j, row)


Table = tuple[NDArray[Any], ...]  # row, order within it, seconds, length, speed and acceleration at the start, jerk


def _trapezoids(plan: Plan) -> Table:
    """Up, along and down in every row, and the events."""
    n = len(plan.seconds)
    v0, v1, top = plan.v[:-1], plan.v[1:], plan.top
    moving = plan.rows.length > 0
    if plan.rapids is not None:
        moving[plan.rapids.rows] = False
    ds = np.empty((n, 3))
    ds[:, 0] = (top - v0) * (top + v0) / (2 * plan.rows.a)
    ds[:, 2] = (top - v1) * (top + v1) / (2 * plan.rows.a)
    ds[:, 1] = np.maximum(plan.rows.length - ds[:, 0] - ds[:, 2], 0.0)
    ds[~moving] = 0.0
    with np.errstate(divide="ignore", invalid="ignore"):
        dt = np.stack([2 * ds[:, 0] / (v0 + top), ds[:, 1] / top, 2 * ds[:, 2] / (v1 + top)], axis=1)
    a = np.stack([plan.rows.a, np.zeros(n), -plan.rows.a], axis=1)
    v = np.stack([v0, top, top], axis=1)
    dt[ds <= 0] = 0.0
    if plan.ramps is not None:
        one = plan.ramps
        length, total = plan.rows.length[one], v0[one] + v1[one]
        dt[one], ds[one] = 0.0, 0.0
        dt[one, 0], ds[one, 0] = 2 * length / total, length
        a[one, 0] = (v1[one] - v0[one]) * total / (2 * length)
    events = plan.rows.length == 0
    if events.any():
        dt[events, 1], v[events], a[events] = plan.seconds[events], 0.0, 0.0
    kept = dt > 0
    row, order = np.nonzero(kept)
    return row, order, dt[kept], ds[kept], v[kept], a[kept], np.zeros(len(row))


def _rapids(plan: Plan) -> Table:
    """Rapids whose axes go by themselves, seen along the straight line from start to end."""
    rapids = plan.rapids
    assert rapids is not None
    breaks = rapids.breaks()
    dt = np.diff(breaks, axis=1)
    which, order = np.nonzero(dt > 0)
    direction = rapids.travel / rapids.length[:, None]
    begin, end = breaks[which, order], breaks[which, order + 1]
    middle = rapids.state(which, (begin + end) / 2)  # within the phases, whatever the rounding of their ends
    a, j = (np.einsum("ij,ij->i", column, direction[which]) for column in middle[2:])
    places = (rapids.state(which, t)[0] - rapids.start[which] for t in (begin, end))
    at = [np.einsum("ij,ij->i", place, direction[which]) for place in places]
    half = (end - begin) / 2
    a -= j * half
    v = (at[1] - at[0]) / (2 * half) - a * half - j * (2 * half) ** 2 / 6
    return rapids.rows[which], order, 2 * half, at[1] - at[0], v, a, j
