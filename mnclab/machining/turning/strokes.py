"""Strokes of a turning tool in the plane of z and r, and the plan they make. Lengths in mm.

A stroke ends at (z, r); its `role` says which feed it gets, its `number` which working stroke it belongs to.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field
from itertools import pairwise
from typing import NamedTuple

import numpy as np

from mnclab.geometry.contours import Contour
from mnclab.machining.steps import RAPID as AT_RAPID
from mnclab.machining.steps import Go, Thread

#: What a stroke may be for.
ROLES = RAPID, ROUGH, PICK_UP, CLEANUP, PLUNGE, FINISH, THREAD = (
    "rapid", "rough", "pick-up", "clean-up", "plunge", "finish", "thread",
)  # fmt: skip
SAME = 1e-9


class Stroke(NamedTuple):
    """One motion of the tip to (z, r), straight or an arc with a bulge; `tool` is the first or second of a scheme."""

    z: float
    r: float
    role: str
    bulge: float = 0.0
    number: int = 0
    tool: int = 1


@dataclass(frozen=True)
class Plan:
    """All strokes of a scheme, from `start` (z, r) on."""

    name: str
    start: tuple[float, float]
    strokes: tuple[Stroke, ...]

    @property
    def passes(self) -> int:
        return len({stroke.number for stroke in self.strokes if stroke.role != RAPID})

    @property
    def ways(self) -> list[tuple[Stroke, Contour]]:
        """Every stroke with its way, a contour of (z, r)."""
        places = [self.start, *((stroke.z, stroke.r) for stroke in self.strokes)]
        ways = zip(self.strokes, pairwise(places), strict=True)
        return [(stroke, Contour(way, [stroke.bulge, 0.0], closed=False)) for stroke, way in ways]

    def length(self, *roles: str) -> float:
        """Length of the strokes of some roles, or of all but rapids."""
        return sum(way.length for stroke, way in self.ways if stroke.role in (roles or ROLES[1:]))

    def __repr__(self) -> str:
        lines = [f"start R{self.start[1]:g} Z{self.start[0]:g}"]
        lines += [f"{'rapid' if s.role == RAPID else 'feed'} R{s.r:.6g} Z{s.z:.6g}  {s.role}" for s in self.strokes]
        return "\n".join(lines)


@dataclass
class Pen:
    """Where the tip is, and the strokes so far; a straight cut that goes on is made longer."""

    z: float
    r: float
    number: int = 0
    tool: int = 1
    strokes: list[Stroke] = field(default_factory=list)
    start: tuple[float, float] = (0.0, 0.0)

    def __post_init__(self) -> None:
        self.start = (float(self.z), float(self.r))

    def rapid(self, z: float, r: float) -> None:
        self.feed(z, r, RAPID)

    def feed(self, z: float, r: float, role: str, bulge: float = 0.0) -> None:
        z, r = float(z), float(r)
        way = np.array([z - self.z, r - self.r])
        if np.hypot(*way) <= SAME:
            return
        number = 0 if role == RAPID else self.number
        last = self.strokes[-1] if self.strokes and role != RAPID else None
        if last and (last.role, last.number, last.tool, last.bulge, bulge) == (role, number, self.tool, 0, 0):
            before = np.array(last[:2]) - (self.strokes[-2][:2] if len(self.strokes) > 1 else self.start)
            if abs(before[0] * way[1] - before[1] * way[0]) <= 1e-9 * np.hypot(*before) and before @ way > 0:
                self.strokes.pop()
        self.strokes.append(Stroke(z, r, role, bulge, number, self.tool))
        self.z, self.r = z, r

    def follow(self, steps: Iterable[Go | Thread], role: str) -> None:
        """Steps of z along and x across, those at feed in a role."""
        for step in steps:
            z, r = (here if to is None else to for here, to in ((self.z, step.z), (self.r, step.x)))
            self.feed(z, r, RAPID if isinstance(step, Go) and step.feed == AT_RAPID else role)

    def along(self, contour: Contour | None, role: str) -> None:
        """Along a contour, at the feed of the role: straight to its start, if the tip is elsewhere."""
        if contour is not None:
            for place, bulge in zip(contour.points, (0.0, *contour.bulge.tolist()), strict=False):
                self.feed(place[0], place[1], role, bulge)

    def append(self, plan: Plan, outside: float) -> None:
        """Another plan, reached outside the blank."""
        if np.hypot(plan.start[0] - self.z, plan.start[1] - self.r) > SAME:
            self.rapid(self.z, outside)
            self.rapid(plan.start[0], outside)
            self.rapid(*plan.start)
        base = self.number
        for stroke in plan.strokes:
            self.number = base + stroke.number
            self.feed(stroke.z, stroke.r, stroke.role, stroke.bulge)

    def plan(self, name: str) -> Plan:
        return Plan(name, self.start, tuple(self.strokes))
