"""Where there is room: what lies on the paper already, and what a place for something new would cost.

Some things never meet: texts and arrowheads each other, texts and any line but a hatching. Others may, at a price:
a dimension line through an extension line is worse than a longer way to the text.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from itertools import islice
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from mnclab.design.drawing.ink import AIR, NEAR, TIP, Box, Mark, line_box, segment_boxes
from mnclab.geometry.curves import Floats

OUTLINE, SOFT, TEXT, ARROW, DIMENSION, EXTENSION, LEADER = range(7)  # the parts of a drawing; soft: hidden and centre lines
Whole = NDArray[np.intp]
NEVER = 1e6
PRICES = np.array([
    # OUTLINE SOFT TEXT ARROW DIMENSION EXTENSION LEADER: what lies there
    [0.0, 0.0, NEVER, 0.5, 2.0, 0.6, 1.8],  # an outline
    [0.0, 0.0, 14.0, 0.0, 0.3, 0.0, 0.8],  # a soft line
    [NEVER, 14.0, NEVER, NEVER, NEVER, NEVER, NEVER],  # a text
    [0.5, 0.0, NEVER, NEVER, NEVER, 6.0, NEVER],  # an arrowhead
    [2.0, 0.3, NEVER, NEVER, 15.0, 3.0, 10.0],  # a dimension line
    [0.6, 0.0, NEVER, 6.0, 3.0, 0.2, 4.0],  # an extension line
    [1.8, 0.8, NEVER, NEVER, 10.0, 4.0, 200.0],  # a leader
])  # fmt: skip
BODIES = {DIMENSION: (0.45, 0.5), EXTENSION: (NEAR, 0.0), LEADER: (0.45, 0.5)}  # mm: shorter by less than AIR, half the width
BATCH = 32  # places tried at once


class Batch(NamedTuple):
    """Some marks with their own costs `(n,)`; their boxes `(k, 6)` with part, number of the mark among these, and spans."""

    marks: Sequence[Mark]
    costs: Floats
    boxes: Floats
    parts: Whole
    owners: Whole
    spans: Floats

    @classmethod
    def of(cls, marks: Sequence[Mark]) -> Batch:
        found = [boxes_of(mark) for mark in marks]
        boxes, parts = np.concatenate([b for b, _ in found]), np.concatenate([p for _, p in found])
        owners = np.repeat(np.arange(len(marks)), [len(p) for _, p in found])
        return cls(marks, np.array([mark.cost for mark in marks]), boxes, parts, owners, spans(boxes))


class Offers:
    """The places that a mark may have, in the order of their costs: made when first asked for, and then kept."""

    def __init__(self, marks: Iterator[Mark]) -> None:
        self._rest, self._made = marks, list[Batch]()

    def __iter__(self) -> Iterator[Batch]:
        yield from self._made
        while marks := list(islice(self._rest, BATCH)):
            self._made.append(Batch.of(marks))
            yield self._made[-1]


class Ground:
    """What lies on the paper, as boxes with the part that each is and the number of its mark, -1 for lines of the view."""

    def __init__(self) -> None:
        self.boxes: Floats = np.zeros((0, 6))
        self.parts: Whole = np.zeros(0, dtype=np.intp)
        self.marks: Whole = np.zeros(0, dtype=np.intp)
        self.spans: Floats = np.zeros((4, 0))

    def add(self, boxes: Floats, parts: Whole, mark: int = -1) -> None:
        """Lay boxes `(n, 6)` down."""
        self.boxes, self.parts = np.vstack([self.boxes, boxes]), np.concatenate([self.parts, parts])
        self.marks = np.concatenate([self.marks, np.full(len(parts), mark)])
        self.spans = np.hstack([self.spans, spans(boxes)])

    def put(self, mark: Mark, number: int) -> None:
        """Lay a mark down under a number."""
        self.add(*boxes_of(mark), number)

    def take(self, number: int) -> None:
        """Take a mark away."""
        kept = self.marks != number
        self.boxes, self.parts, self.marks = self.boxes[kept], self.parts[kept], self.marks[kept]
        self.spans = self.spans[:, kept]

    def prices(self, batch: Batch) -> tuple[Floats, NDArray[np.bool_]]:
        """What each of n marks would cost where it is `(n,)`, and which of the others it can not stand with `(n, m + 1)`,
        by their numbers; lines of the view are the last column."""
        left, low, right, high = batch.spans[:, :, None]
        near = (left <= self.spans[2]) & (right >= self.spans[0]) & (low <= self.spans[3]) & (high >= self.spans[1])
        i, k = np.nonzero(near)
        price = PRICES[batch.parts[i], self.parts[k]]
        some = price > 0
        i, k, price = i[some], k[some], price[some]
        meet = overlap(batch.boxes[i], self.boxes[k])
        i, k, price = i[meet], k[meet], price[meet]
        never = price >= NEVER
        costs = batch.costs + np.bincount(batch.owners[i[~never]], price[~never], len(batch.marks))
        barred = np.zeros((len(batch.marks), int(self.marks.max(initial=-1)) + 2), dtype=bool)
        barred[batch.owners[i[never]], self.marks[k[never]]] = True
        return costs, barred

    def best(
        self, offers: Iterable[Batch], standing: Floats | None = None, least: float = NEVER
    ) -> tuple[Mark | None, list[int]]:
        """The cheapest of the marks, which come in the order of their own costs, and the numbers of those that must give
        way: they cost what `standing` says of them; without it none gives way. None where none is cheaper than `least`."""
        best, away = None, list[int]()
        for batch in offers:
            if batch.costs[0] >= least:
                break
            costs, barred = self.prices(batch)
            weights = np.full(barred.shape[1], NEVER)
            if standing is not None:
                weights[:-1] = standing[: len(weights) - 1]
            costs = costs + barred @ weights
            k = int(costs.argmin())
            if costs[k] < least:
                best, least, away = batch.marks[k], float(costs[k]), np.flatnonzero(barred[k]).tolist()
        return best, away


def boxes_of(mark: Mark) -> tuple[Floats, Whole]:
    """The boxes of a mark `(n, 6)` and their parts `(n,)`: texts with their air, lines and arrows a little short."""
    boxes: list[Box] = [label.box(AIR) for label in mark.labels]
    parts = [TEXT] * len(boxes)
    boxes += [arrow.box(TIP) for arrow in mark.arrows]
    parts += [ARROW] * len(mark.arrows)
    boxes += [line_box(a, b, *BODIES[part]) for part, a, b in mark.lines]
    parts += [part for part, _, _ in mark.lines]
    rows = np.array(boxes, dtype=float).reshape(-1, 6)
    if mark.arc is not None:
        points = mark.arc.points_within(0.1)
        chords = segment_boxes(np.stack([points[:-1], points[1:]], axis=1))
        rows, parts = np.vstack([rows, chords]), parts + [DIMENSION] * len(chords)
    return rows, np.array(parts, dtype=np.intp)


def spans(boxes: Floats) -> Floats:
    """Left, lower, right and upper ends of boxes, `(4, n)`."""
    x, y, u, v, c, s = boxes.T
    c, s = np.abs(c), np.abs(s)
    wide, high = u * c + v * s, u * s + v * c
    return np.stack([x - wide, y - high, x + wide, y + high])


def overlap(a: Floats, b: Floats) -> NDArray[np.bool_]:
    """Which of pairs of boxes `(n, 6)` meet: no line along a side of either parts them."""
    dx, dy = b[:, 0] - a[:, 0], b[:, 1] - a[:, 1]
    ca, sa, cb, sb = a[:, 4], a[:, 5], b[:, 4], b[:, 5]
    cos, sin = np.abs(ca * cb + sa * sb), np.abs(ca * sb - sa * cb)
    meet = np.abs(dx * ca + dy * sa) < a[:, 2] + b[:, 2] * cos + b[:, 3] * sin
    meet &= np.abs(dy * ca - dx * sa) < a[:, 3] + b[:, 2] * sin + b[:, 3] * cos
    meet &= np.abs(dx * cb + dy * sb) < b[:, 2] + a[:, 2] * cos + a[:, 3] * sin
    meet &= np.abs(dy * cb - dx * sb) < b[:, 3] + a[:, 2] * sin + a[:, 3] * cos
    return meet
