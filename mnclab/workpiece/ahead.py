"""What stands before a tool at places of its way, the places where most does, and that it is the most.

The cross-section A lies across the way, and the tool takes away Q = A v there, v the speed that it really has. Of the
stretch of a row that may meet the blank places at equal distances are looked at; then, `ROUNDS` times, places three times as
close about those of the row where Q and the depth are the greatest. So they are values that occur: no means, without air.

Not every row is looked at. Each has a bound, `at_most`, that nothing found on it can pass; rows are looked at in the falling
order of their bounds, and when the greatest value found is no less than the next bound, no row that is left can hold a
greater one: it is the most (branch and bound). Where `LOOKS` places do not suffice for that, it is said to be no more than
"at least".
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from mnclab.geometry.curves import counted
from mnclab.path.toolpath import Array, Index, Mask

if TYPE_CHECKING:
    from mnclab.workpiece.workpiece import Workpiece

PLACES, FEW, APART = 400, 60, 0.25  # of so many rows, about; no less than so many mm apart
ROUNDS, CLOSE = 5, 0.05  # mm between places that are close enough
ABOUT = np.array([-2.0, -1.0, 0.0, 1.0, 2.0]) / 3
LOOKS, PAIRS = 8_000, 16_000_000  # places of a tool, and places times rows of the path: a few seconds
ROUNDING, LESS = 1 + 1e-9, 1 - 1e-3  # what counts as no less, and as a place of its own
RATE, DEPTH, WIDTH, CHIP = range(4)


class Ahead(NamedTuple):
    """At places of rows (k,): the cross-section `area` mm², on a lathe all around the axis; the `depth` ap and the `width`
    ae of cut, mm; the mean thickness of the `chip`, in feeds a tooth. 0 where there is none, or none is known."""

    area: Array
    depth: Array
    width: Array
    chip: Array

    @classmethod
    def none(cls, k: int) -> Ahead:
        return cls(*np.zeros((4, k)))


class Looks:
    """Rows (k,) of a tool, looked at as far as it takes; `speed` mm/min at shares (m,) of rows, `fastest` (k,) the greatest.

    `values` (4, k) are the greatest rate mm³/min, depth and width mm of each, and its chip where its rate is the greatest;
    nan where nobody has looked. `bounds` (4, k) are no less.
    """

    def __init__(self, rows: Index, part: Workpiece, speed: Callable[[Index, Array], Array], fastest: Array) -> None:
        self.rows, self.part, self.speed = rows, part, speed
        path, at_most = part.cutting.path, part.at_most(rows)
        self.bounds = np.stack([at_most.area * fastest, *at_most[1:]])
        self.values = np.full(self.bounds.shape, np.nan)
        self.low, high = part.reach(rows)
        self.span, self.way = high - self.low, path.lengths[rows]
        self.left = min(LOOKS, PAIRS // len(path))
        self.gap = max(float((self.span * self.way).sum()) * min(1.0, FEW / len(rows)) / PLACES, APART)

    @property
    def seen(self) -> Mask:
        """The rows (k,) that are looked at."""
        return ~np.isnan(self.values[RATE])

    def look(self, order: Index) -> None:
        """At some of the rows (m,), those first that come first, as long as places are left."""
        order = np.array(list(dict.fromkeys(order[~self.seen[order]].tolist())), dtype=np.int64)
        count = np.ceil(self.span[order] * self.way[order] / self.gap).clip(1, PLACES).astype(np.int64)
        many = int(np.searchsorted(np.cumsum(count) - count, self.left))
        if many:
            self.values[:, order[:many]] = self._greatest(order[:many], count[:many])

    def proves(self, what: int, among: Mask, scale: Array | float = 1.0) -> bool:
        """Whether the greatest value of some rows, times a scale (k,), is the most: rows are looked at until it is, or until
        no places are left."""
        bound = np.where(among, self.bounds[what] * scale, 0.0)
        while True:
            best = np.where(among & self.seen, self.values[what] * scale, 0.0).max(initial=0.0)
            open_ = np.flatnonzero(~self.seen & (bound > best * ROUNDING))
            if not len(open_) or self.left <= 0:
                return not len(open_)
            self.look(open_[np.argsort(-bound[open_], kind="stable")][:FEW])

    def _greatest(self, which: Index, count: Index) -> Array:
        """The values (4, m) of some rows, of which so many places (m,) are looked at first."""
        rows, way, low, span = self.rows[which], self.way[which], self.low[which], self.span[which]
        best, at, gap = np.full((3, len(rows)), -1.0), np.zeros((2, len(rows))), span / count
        deep, chip = np.zeros((2, len(rows)))  # where the rate is the greatest
        of, rank = counted(count)
        share = low[of] + (rank + 0.5) * gap[of]
        for _ in range(ROUNDS):
            met = self.part.ahead(rows[of], share)
            self.left -= len(of)
            for what, value in enumerate((met.area * self.speed(rows[of], share), met.depth, met.width)):
                order = np.lexsort((value, of))
                first = order[np.append(of[order][1:] != of[order][:-1], True)]  # the greatest of each row
                first = first[value[first] > best[what, of[first]]]
                best[what, of[first]] = value[first]
                if what == RATE:
                    deep[of[first]], chip[of[first]] = met.depth[first], met.chip[first]
                if what != WIDTH:
                    at[what, of[first]] = share[first]
            wide = (gap * way > CLOSE) & (best[RATE] > 0)
            what_, again = np.nonzero(np.stack([wide, wide & (best[DEPTH] * LESS > deep)]))
            if not len(again):
                break
            of = np.repeat(again, len(ABOUT))
            share = (at[what_, again][:, None] + gap[again, None] * ABOUT).ravel().clip(low[of], low[of] + span[of])
            gap = gap / 3
        return np.stack([*best, chip])
