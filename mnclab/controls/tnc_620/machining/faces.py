"""Facing: a rectangle some sides of which are walls, where lines lie and end and the way along the walls; a ruled surface.

    open side: lines end as far outside as they may        wall: the tool centre stays c = R + allowance in front of it

Two walls that meet have a round corner; lines end on it. Places count from the middle of the rectangle. Lengths in mm.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from mnclab.geometry.contours import QUARTER, Contour
from mnclab.geometry.curves import Floats, left
from mnclab.machining.milling.clearing import begin, numbered
from mnclab.machining.milling.faces import rows
from mnclab.machining.milling.pocket_steps import onto
from mnclab.machining.steps import RAPID, Along, Go, Step

Place = tuple[float, float]
SIDES = (-2, 1, 2, -1)  # below, right, above, left: -2 is the side where Y is least, 1 that where X is greatest


class FacingLine(NamedTuple):
    """One line, and whether its ends lie outside, in the clear."""

    begin: Place
    end: Place
    begins_outside: bool
    ends_outside: bool


@dataclass(frozen=True)
class Walled:
    """A rectangle, `length` along X and `width` along Y, its walls among `SIDES`, and their corner radius."""

    length: float
    width: float
    walls: frozenset[int] = frozenset()
    corner: float = 0.0

    @property
    def has_corners(self) -> bool:
        """Whether two walls meet."""
        return bool(self.walls & {1, -1}) and bool(self.walls & {2, -2})

    def lines(
        self, radius: float, stepover: float, *, axis: int, ahead: int, across: int, outside: float, over: float,
        first: float, allowance: float = 0.0, one_way: bool = False,
    ) -> tuple[FacingLine, ...]:  # fmt: skip
        """Lines along X (`axis` 0) or Y (1) in the sense `ahead`, one after the other in the sense `across`.

        They begin `outside` the rectangle and end `over` its edge; those that turn round begin `over` it too. The first
        one lies `first` inside the edge, the edge of the tool is at the far edge on the last one; walls come before.
        """
        c, (long, wide) = radius + allowance, self._halves(axis)
        low = -wide + (c if self._wall(1 - axis, -across) else first)
        high = wide - (c if self._wall(1 - axis, across) else radius)
        if high < low:
            low = high = high if self._wall(1 - axis, across) else low
        found = []
        near_wall, far_wall = self._wall(axis, -ahead), self._wall(axis, ahead)
        for k, place in enumerate(rows(low, high, stepover)):
            v = across * place
            turned = k > 0 and not one_way
            near = self._reach(axis, -ahead, v, c) if near_wall else long + (over if turned else outside)
            far = self._reach(axis, ahead, v, c) if far_wall else long + over
            ends = [(-near, not near_wall and (over >= outside or not turned)), (far, not far_wall and over >= outside)]
            (a, a_out), (b, b_out) = ends[::-1] if turned and k % 2 else ends
            one, other = ((v, ahead * a), (v, ahead * b)) if axis else ((ahead * a, v), (ahead * b, v))
            found.append(FacingLine(one, other, a_out, b_out))
        return tuple(found)

    def along(self, radius: float, *, outside: Place, allowance: float = 0.0) -> tuple[Contour, ...]:
        """The ways along walls that meet, counter-clockwise; each begins and ends `outside` (in X, in Y) the open sides."""
        if len(self.walls) == 4:
            raise ValueError("a rectangle between four walls is a pocket")
        c, first = radius + allowance, next((k for k in range(4) if SIDES[k] not in self.walls), 0)
        chains: list[list[int]] = [[]]
        for side in (SIDES[(first + k) % 4] for k in range(1, 4)):
            if side in self.walls:
                chains[-1].append(side)
            elif chains[-1]:
                chains.append([])
        return tuple(self._way(chain, c, outside) for chain in chains if chain)

    def _way(self, chain: list[int], c: float, outside: Place) -> Contour:
        half = np.array([self.length, self.width]) / 2
        q = max(0.0, self.corner - c)
        points: list[np.ndarray] = []
        bulge: list[float] = []
        for k, side in enumerate(chain):
            ahead, level = AHEAD[side], -left(AHEAD[side]) * (half - c)
            span = np.abs(ahead)
            begins = level - ahead * (half + outside if not k else half - c - q)
            ends = level + ahead * (half + outside if k == len(chain) - 1 else half - c - q)
            points += [begins * span + level * (1 - span), ends * span + level * (1 - span)]
            bulge += [0.0, QUARTER if q > 0 and k < len(chain) - 1 else 0.0]
        some = np.append(np.hypot(*np.diff(points, axis=0).T) > 1e-9, True)
        return Contour(np.array(points)[some], np.array(bulge)[some], closed=False)

    def _wall(self, axis: int, sense: int) -> bool:
        return (axis + 1) * sense in self.walls

    def _halves(self, axis: int) -> Place:
        return (self.length / 2, self.width / 2) if axis == 0 else (self.width / 2, self.length / 2)

    def _reach(self, axis: int, sense: int, place: float, c: float) -> float:
        """How far a line at a place goes before a wall, or the round corner that it has with another one."""
        q, (long, wide) = max(0.0, self.corner - c), self._halves(axis)
        into = abs(place) - (wide - c - q)
        if not self._wall(1 - axis, 1 if place > 0 else -1) or into <= 0:
            return long - c
        return long - c - q + math.sqrt(max(q * q - into * into, 0.0))


AHEAD = {side: np.array(way) for side, way in zip(SIDES, ((1, 0), (0, 1), (-1, 0), (0, -1)), strict=True)}


# Facing between walls step by step: over every level, and then along the walls. Lengths in mm, feeds in mm/min.
# Each level ends with a lift and the way back to its start outside.

class FacingLevel(NamedTuple):
    """One level: where it is, what stood above it, and the feed along lines and wherever material may be."""

    name: str
    level: float
    top: float
    feed: float


class Passes(NamedTuple):
    """What is run on a level from its `start`: lines, to and fro or one way, and along `walls` what lines leave; or a spiral.

    `outside`: the start lies in the clear.
    """

    start: Place
    outside: bool
    lines: tuple[FacingLine, ...] = ()
    one_way: bool = False
    walls: tuple[Contour, ...] = ()
    spiral: Contour | None = None

    def scrapes(self, levels: Sequence[FacingLevel], lift: float) -> float:
        """How far a line that still stands reaches above the rapid way back over it, mm; 0 where none does."""
        if not self.one_way or not any(line.begins_outside for line in self.lines[1:]):
            return 0.0
        return max(0.0, max((abs(each.top - each.level) for each in levels), default=0.0) - lift)


def face_levels(passes: Passes, levels: Sequence[FacingLevel], lift: float, position: float) -> Iterator[Step]:
    """Every level; `lift` is the way up after it, `position` the feed through the air at depth."""
    for k, at in enumerate(levels):
        yield Go(f"{at.name}, down", at.level, position if k and passes.outside else at.feed)
        if passes.spiral is None:
            yield from _over_lines(passes, at, lift, position)
        else:
            if (arc := onto(passes.start, passes.spiral)) is not None:
                yield Along(f"{at.name}, approach", arc, at.feed)
            yield Along(f"{at.name}, spiral", passes.spiral, at.feed)
        for label, way in zip(numbered("along the walls", len(passes.walls)), passes.walls, strict=True):
            yield Go(f"{at.name}, link", None, at.feed, *begin(way).tolist())
            yield Along(f"{at.name}, {label}", way, at.feed)
        yield Go(f"{at.name}, lift", at.level + lift)
        yield Go(f"{at.name}, back to the start", x=passes.start[0], y=passes.start[1])


def _over_lines(passes: Passes, at: FacingLevel, lift: float, position: float) -> Iterator[Step]:
    """From the first line over all of them; one way, with a lift and straight back, over all that stands to a wall."""
    before = None
    for label, line in zip(numbered("line", len(passes.lines)), passes.lines, strict=True):
        if before and passes.one_way:
            yield Go(f"{at.name}, lift", (at.level if line.begins_outside else at.top) + lift)
            yield Go(f"{at.name}, back", None, RAPID, *line.begin)
            yield Go(f"{at.name}, down", at.level, position if line.begins_outside else at.feed)
        elif before:
            clear = before.ends_outside and line.begins_outside
            yield Go(f"{at.name}, link", None, position if clear else at.feed, *line.begin)
        yield Along(f"{at.name}, {label}", Contour([line.begin, line.end], closed=False), at.feed)
        before = line


def finish_along(
    ways: Sequence[Contour], levels: Sequence[float], above: float, feed: float, position: float
) -> Iterator[Step]:
    """Each way on every level, from outside to outside; between them the tool goes at the clearance level."""
    for which, way in zip(numbered("side finishing", len(ways)), ways, strict=True):
        for label, level in zip(numbered("infeed", len(levels)), levels, strict=True):
            name = f"{which}, {label}"
            yield Go(f"{name}, to the clearance level", above)
            yield Go(f"{name}, over the start", None, RAPID, *begin(way).tolist())
            yield Go(f"{name}, down", level, position)
            yield Along(name, way, feed)
    if ways:
        yield Go("side finishing, lift", above)


# A ruled surface between two lines: straight passes from the one to the other. Lengths in mm, feeds in mm/min.
#
#     4 ────────► 3        passes i = 0 … n - 1 from  P1 + (P4 - P1)·i/(n - 1)  to  P2 + (P3 - P2)·i/(n - 1)
#     1 ────────► 2

Point = Sequence[float]


def passes(first: Point, second: Point, third: Point, fourth: Point, count: int) -> tuple[Floats, Floats]:
    """Where the passes begin and where they end, `(count, 3)` each."""
    share = np.linspace(0, 1, count)[:, None]
    one, two, three, four = (np.asarray(point, dtype=float) for point in (first, second, third, fourth))
    return one + (four - one) * share, two + (three - two) * share


def mill_ruled(begins: Floats, ends: Floats, lift: float, feed: float, slow: float) -> Iterator[Step]:
    """Along all passes the same way, the first one and the way to it at the feed `slow`; back at rapid, `lift` over the pass."""
    above = None
    for k, label in enumerate(numbered("line", len(begins))):
        x, y, z = begins[k].tolist()
        if above is not None:
            bx, by, bz = begins[k - 1].tolist()
            yield Go(f"{label}, lift", above)
            yield Go(f"{label}, back", bz + lift, RAPID, bx, by)
            yield Go(f"{label}, down", bz, feed)
        yield Go(f"{label}, to its begin", z, feed if k else slow, x, y)
        x, y, z = ends[k].tolist()
        yield Go(label, z, feed if k else slow, x, y)
        above = z + lift
    yield Go("retract", float(max(begins[:, 2].max(), ends[:, 2].max())) + lift)
