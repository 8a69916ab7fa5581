"""What stands before a tool at places of its way, and the places where most does.

The cross-section A lies across the way, and the tool takes away Q = A v there, v the speed that it really has. Of the
stretch of a row that may meet the blank places at equal distances are looked at; then, `ROUNDS` times, places three times as
close about the one of the row where Q is the greatest. So Q is a value that occurs: it is no mean, and air is not in it.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from mnclab.path.toolpath import Array, Index

PLACES = 400  # of the rows of a tool, about
ROUNDS, CLOSE = 5, 0.05  # mm between places that are close enough
ABOUT = np.array([-2.0, -1.0, 0.0, 1.0, 2.0]) / 3


class Ahead(NamedTuple):
    """At places of rows (k,): the cross-section `area` mm², on a lathe all around the axis; the `depth` ap and the `width`
    ae of cut, mm; the engaged `angle`, rad. 0 where there is none, or none is known."""

    area: Array
    depth: Array
    width: Array
    angle: Array

    @classmethod
    def none(cls, k: int) -> Ahead:
        return cls(*np.zeros((4, k)))


def greatest(
    rows: Index, way: Array, reach: Array, ahead: Callable[[Index, Array], Ahead], speed: Callable[[Index, Array], Array]
) -> tuple[Array, Ahead]:
    """Q of rows (k,) where it is the greatest, mm³/min, and what is ahead there.

    `way` mm (k,) are their lengths, `reach` (2, k) the shares of them between which they may meet material.
    """
    low, span = reach[0], reach[1] - reach[0]
    count = np.ceil(PLACES * span * way / max(float((span * way).sum()), 1e-9)).clip(1, PLACES).astype(np.int64)
    best, found, gap = np.full(len(rows), -1.0), np.zeros((len(Ahead._fields), len(rows))), span / count
    of = np.repeat(np.arange(len(rows)), count)
    share = low[of] + (np.arange(len(of)) - np.repeat(np.cumsum(count) - count, count) + 0.5) * gap[of]
    at = share[np.cumsum(count) - count]
    for _ in range(ROUNDS):
        met = ahead(rows[of], share)
        rate = met.area * speed(rows[of], share)
        order = np.lexsort((rate, of))
        first = order[np.append(of[order][1:] != of[order][:-1], True)]  # the greatest of each row
        first = first[rate[first] > best[of[first]]]
        best[of[first]], at[of[first]], found[:, of[first]] = rate[first], share[first], np.stack(met)[:, first]
        wide = np.flatnonzero((gap * way > CLOSE) & (best > 0))
        if not len(wide):
            break
        of = np.repeat(wide, len(ABOUT))
        share = (at[wide, None] + gap[wide, None] * ABOUT).ravel().clip(low[of], low[of] + span[of])
        gap = gap / 3
    return best, Ahead(*found)
