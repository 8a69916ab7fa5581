"""Judging a move: where a body of its tool is in the material that stands there before the move, and how deep."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

import numpy as np

from mnclab.path.tool import Tool
from mnclab.path.toolpath import Array, Index, Kind, Mask
from mnclab.workpiece.cutting import Cutting
from mnclab.workpiece.milling.bodies import TOLERANCE, Body, under
from mnclab.workpiece.milling.moves import STILL, Moves, moves_of
from mnclab.workpiece.milling.sweep import Points, depths
from mnclab.workpiece.milling.swept import left_by

CELLS = 400  # along the longer side: so far apart are the points, by default
MOST, FEWEST, BUDGET = 1000, 40, 1_000_000  # points of a move, and of all moves of a kind
AT_ONCE = 400_000  # points
MANY = 20_000  # moves of a kind


class Judged(NamedTuple):
    """A body of a tool on a move; `before` is the number of the move before which the material counts."""

    move: int
    body: Body
    before: int
    fall: float = 0.0  # mm, of the move: not blamed


class Met(NamedTuple):
    """The deepest place where a body of a tool met something on a move of a row."""

    row: int
    body: Body
    place: tuple[float, float, float]
    depth: float


@dataclass(frozen=True, eq=False)
class Judging:
    """Moves of a cutting over its blank, and what their tools meet there."""

    cutting: Cutting
    moves: Moves
    step: float

    @classmethod
    def of(cls, cutting: Cutting, step: float | None) -> Judging:
        bounds = cutting.stock.bounds
        apart = float(step) if step is not None else float((bounds[1] - bounds[0])[:2].max()) / CELLS
        return cls(cutting, moves_of(cutting, chord=TOLERANCE / 10), apart)

    @cached_property
    def boxes(self) -> Array:
        return self.moves.boxes

    @cached_property
    def bounds(self) -> Array:
        return np.asarray(self.cutting.stock.bounds)

    @cached_property
    def which(self) -> Index:
        """The tool of each move (k,)."""
        return np.asarray(self.cutting.which[self.moves.row])

    @cached_property
    def rapid(self) -> Mask:
        return np.asarray(self.cutting.path.kind[self.moves.row] == Kind.RAPID)

    @cached_property
    def standing(self) -> Mask:
        """Moves that do not go on in the plane."""
        way = self.moves.end[:, :2] - self.moves.start[:, :2]
        return np.asarray(~self.moves.arc & (np.hypot(way[:, 0], way[:, 1]) <= STILL))

    @cached_property
    def rising(self) -> Mask:
        """Moves straight up: what a tool meets there, it met where it came from."""
        return np.asarray(self.standing & (self.moves.end[:, 2] > self.moves.start[:, 2]))

    @cached_property
    def stay(self) -> Index:
        """Of a standing move the first of those with the same tool that stand there without a break: a hole."""
        place, here = self.moves.start[:, :2], self.standing
        same = np.zeros(len(self.moves), dtype=bool)
        same[1:] = here[1:] & here[:-1] & (self.which[1:] == self.which[:-1])
        same[1:] &= (np.abs(place[1:] - place[:-1]) <= STILL).all(axis=1)
        return np.asarray(np.maximum.accumulate(np.where(same, 0, np.arange(len(same)))))

    def low_over(self, wide: Array | float, lift: Array | float = 0.0) -> Mask:
        """Moves that come over the blank, with `wide` mm more than the tool, and lower than its top by the tolerance."""
        low, high = self.bounds
        box, wide = self.boxes, np.asarray(wide)
        near = (box[:, 0] - wide < high[0]) & (box[:, 1] - wide < high[1])
        near &= (box[:, 2] + wide > low[0]) & (box[:, 3] + wide > low[1])
        return np.asarray(near & (self.moves.low + lift < high[2] - TOLERANCE))

    def of_tools(self, value: Callable[[Tool], float]) -> Array:
        """A number of the tool of each move (k,)."""
        return np.array([value(tool) for tool in self.cutting.tools], dtype=np.float64)[self.which]

    def met(self, judged: Sequence[Judged], most: int = MOST) -> Iterator[Met]:
        """Which of some bodies are in the material, and where deepest; of more than `MANY` every second, third, …"""
        judged = judged[:: len(judged) // MANY + 1]
        most = int(np.clip(BUDGET // max(len(judged), 1), min(FEWEST, most), most))
        batch: list[Points] = []
        total = first = 0
        for number, each in enumerate(judged):
            batch.append(self.points(each, most, number))
            total += len(batch[-1].x)
            if total > AT_ONCE or number == len(judged) - 1:
                yield from self._deepest(judged, batch, first)
                batch, total, first = [], 0, number + 1

    def points(self, each: Judged, most: int, owner: int) -> Points:
        """The points that a body passes over the blank, and how low."""
        move = self.moves[each.move : each.move + 1].with_cutter(np.array(each.body.cutter), each.body.lift + each.fall)
        x, y = under(move, each.body.cutter.radius, self.bounds, self.step, most)
        low = left_by(move, x, y)[0]
        if each.body.inner and self.standing[each.move]:
            axis = move.start[0]
            low[np.hypot(x - axis[0], y - axis[1]) <= each.body.inner] = np.inf
        count = np.ones(len(x), dtype=np.int64)
        return Points(x, y, low, each.before * count, owner * count)

    def _deepest(self, judged: Sequence[Judged], batch: list[Points], first: int) -> Iterator[Met]:
        at = Points(*map(np.concatenate, zip(*batch)))
        floor, top = self.cutting.stock.faces(at.x, at.y)
        at = at._replace(low=np.fmax(at.low, floor))
        deep = depths(self.moves, self.boxes, at, np.where(np.isnan(top), -np.inf, top))
        ends = np.flatnonzero(np.diff(at.owner, append=-1)) + 1
        for begin, end in zip([0, *ends[:-1]], ends):
            k = begin + int(np.round(deep[begin:end], 6).argmax())
            if deep[k] > 0:
                each = judged[int(at.owner[k])]
                low = max(float(at.low[k]) - TOLERANCE - each.fall, float(floor[k]))  # of the body as large as it is
                place = float(at.x[k]), float(at.y[k]), low
                yield Met(int(self.moves.row[each.move]), each.body, place, float(at.low[k] + deep[k]) - low)
