"""Facing a rectangle some sides of which are walls: where lines lie and end, and the way along the walls.

    open side: lines end as far outside as they may        wall: the tool centre stays c = R + allowance in front of it

Two walls that meet have a round corner; lines end on it. Places count from the middle of the rectangle. Lengths in mm.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from mnclab.geometry.contours import QUARTER, Contour
from mnclab.geometry.curves import left
from mnclab.machining.milling.face_lines import rows

Place = tuple[float, float]
SIDES = (-2, 1, 2, -1)  # below, right, above, left: -2 is the side where Y is least, 1 that where X is greatest


class Line(NamedTuple):
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
    ) -> tuple[Line, ...]:  # fmt: skip
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
            found.append(Line(one, other, a_out, b_out))
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
