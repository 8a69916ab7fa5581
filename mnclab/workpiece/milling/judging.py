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
from mnclab.workpiece.milling.moves import STILL, Cutter, Moves, cutter_of, moves_of
from mnclab.workpiece.milling.sweep import Points, depths
from mnclab.workpiece.milling.swept import left_by

# What of a mill may meet something: its edges, what is above them, the shank, the holder; and points under it along a move.

# A body is a little smaller than it is, by `TOLERANCE` all round, so that a tool that touches a finished wall or floor, a
# program that is written in micrometres and a chord of an arc are no collision.

TOLERANCE = 0.01  # mm
HOLES = ("drill", "mill", "face mill", "")  # what clears a hole as far up as its edges go


class Body(NamedTuple):
    """A part of a tool: its lower side (smaller than it is), `lift` mm above the tip.

    Within `inner` of the axis the edges have been before, when the tool goes straight down.
    """

    name: str
    cutter: Cutter
    lift: float
    inner: float = 0.0


def edges(tool: Tool) -> Body:
    """What cuts, and all that is as wide above it."""
    radius, flat, corner, slope = cutter_of(tool)
    smaller = max(radius - TOLERANCE, radius / 2)
    corner = max(corner - TOLERANCE, 0.0)
    flat = min(flat, smaller) if slope or corner else smaller
    return Body("tool", Cutter(smaller, flat, min(corner, smaller - flat) if not slope else 0.0, slope), TOLERANCE)


def above_edges(tool: Tool) -> list[Body]:
    """The tool above its edges, where their length is given, and the shank behind."""
    radius, found = tool.effective_radius, []
    thin, begin = tool.shank or (radius, 0.0)
    if tool.cutting_length > 0 and (tool.shank is None or begin > tool.cutting_length):
        inner = 0.0 if tool.kind in HOLES else radius
        found.append(_upright("tool above its edges", radius, tool.cutting_length, inner))
    if tool.shank is not None:
        found.append(_upright("shank", thin, begin, radius))
    return found


def holder(tool: Tool) -> list[Body]:
    """The discs that the holder begins with, from the tip up."""
    return [_upright("holder", radius, begin, tool.effective_radius) for radius, begin in tool.holder]


def bodies_of(tool: Tool) -> list[Body]:
    """All of them, from the tip up."""
    return [edges(tool), *above_edges(tool), *holder(tool)]


def _upright(name: str, radius: float, lift: float, inner: float) -> Body:
    smaller = max(radius - TOLERANCE, radius / 2)
    return Body(name, Cutter(smaller, smaller), lift + TOLERANCE, inner)


# Points under a body that goes along a move: where a collision is looked for.
# They lie on lines along the move, the outer ones on the rim of the body, on the rim where it begins and on rings where it
# ends; so that nothing wider than the distance between them is missed, and nothing at all that the rim or the axis goes over.

RIM = 1e-6  # mm, by which the outermost points lie inside the body
LANES = 4  # at least, across a body
RINGS = 12  # at most, of an end
STATIONS = 4000  # at most, along a move


def under(move: Moves, radius: float, bounds: Array, step: float, most: int) -> tuple[Array, Array]:
    """x and y (m,) of points under a body of `radius` along one move, from its start to its end.

    They are `step` mm apart, or so far that there are about `most`; a line is looked at where it is over `bounds` (2, 3).
    """
    radius = max(radius - RIM, 0.0)
    first, last = _over(move, radius, bounds)
    way = float(move.ways[0]) * (last - first)
    apart = max(step, ((way * 2 * radius + 3 * radius * radius) / most) ** 0.5)
    there = _disc(_tips(move, np.array([last])), radius, int(np.clip(np.ceil(radius / apart), 2, RINGS)))
    if way <= STILL:
        return there[:, 0], there[:, 1]
    here = _disc(_tips(move, np.array([first])), radius, 1)
    share = np.linspace(first, last, min(int(way / apart) + 2, STATIONS))
    lanes = np.linspace(-radius, radius, max(2 * int(np.ceil(radius / apart)), LANES) + 1)
    lanes = lanes[np.argsort(np.abs(lanes), kind="stable")]  # of places that are as deep the axis is named
    between = _tips(move, share)[:, None, :2] + lanes[:, None] * _aside(move, share)[:, None]
    found = np.concatenate([here, between.reshape(-1, 2), there])
    return found[:, 0], found[:, 1]


def _tips(move: Moves, share: Array) -> Array:
    """Where the tip of one move is (n, 3), 0 at its start and 1 at its end."""
    return move.tips(np.zeros(len(share), dtype=np.int64), share)


def _aside(move: Moves, share: Array) -> Array:
    """The unit vector across the way (n, 2)."""
    if move.arc[0]:
        out = _tips(move, share)[:, :2] - move.centre[0]
        return np.asarray(out / np.maximum(np.hypot(*out.T), STILL)[:, None])
    dx, dy = (move.end[0] - move.start[0])[:2]
    return np.broadcast_to(np.array([-dy, dx]) / np.hypot(dx, dy), (len(share), 2))


def _over(move: Moves, radius: float, bounds: Array) -> tuple[float, float]:
    """The share of a line on which the body may be over a box; all of an arc."""
    first, last = 0.0, 1.0
    if move.arc[0]:
        return first, last
    for axis in (0, 1):
        start, way = float(move.start[0, axis]), float(move.end[0, axis] - move.start[0, axis])
        if abs(way) > STILL:
            one, other = sorted((bounds[:, axis] + np.array([-radius, radius]) - start) / way)
            first, last = max(first, float(one)), min(last, float(other))
    return (first, last) if first < last else (min(max(first, 0.0), 1.0),) * 2


def _disc(place: Array, radius: float, rings: int) -> Array:
    """The axis, and rings up to the rim (n, 2)."""
    points = [place[:, :2]]
    for k in range(1, rings + 1):
        angle = np.linspace(0, 2 * np.pi, max(16 if k == rings else 0, 6 * k), endpoint=False)
        points.append(place[:, :2] + radius * k / rings * np.stack([np.cos(angle), np.sin(angle)], axis=1))
    return np.concatenate(points)


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


def apart(cutting: Cutting) -> float:
    """How far apart points are, mm, if nobody says."""
    return float(np.ptp(cutting.stock.bounds[:, :2], axis=0).max()) / CELLS


@dataclass(frozen=True, eq=False)
class Judging:
    """Moves of a cutting over its blank, and what their tools meet there."""

    cutting: Cutting
    moves: Moves
    step: float

    @classmethod
    def of(cls, cutting: Cutting, step: float | None) -> Judging:
        return cls(cutting, moves_of(cutting, chord=TOLERANCE / 10), float(step) if step is not None else apart(cutting))

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
        if (gaps := getattr(self.cutting.stock, "gaps", None)) is not None:
            met = np.flatnonzero(deep > 0)
            deep[met] = gaps.sides(at.x[met], at.y[met], at.low[met] + deep[met], at.low[met])[0] - at.low[met]
        ends = np.flatnonzero(np.diff(at.owner, append=-1)) + 1
        for begin, end in zip([0, *ends[:-1]], ends):
            k = begin + int(np.round(deep[begin:end], 6).argmax())
            if deep[k] > 0:
                each = judged[int(at.owner[k])]
                low = max(float(at.low[k]) - TOLERANCE - each.fall, float(floor[k]))  # of the body as large as it is
                place = float(at.x[k]), float(at.y[k]), low
                yield Met(int(self.moves.row[each.move]), each.body, place, float(at.low[k] + deep[k]) - low)
