"""Strokes of a turning tool in the plane of z and r, and the plan they make. Lengths in mm.

A stroke ends at (z, r); its `role` says which feed it gets, its `number` which working stroke it belongs to.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field
from itertools import pairwise
from typing import Any, NamedTuple

import numpy as np

from mnclab.geometry.contours import Contour
from mnclab.geometry.curves import Floats
from mnclab.geometry.sweeps import CHORD_ERROR, broad, swept, under
from mnclab.machining.steps import RAPID as AT_RAPID
from mnclab.machining.steps import Go, Thread
from mnclab.path.inserts import edges_of
from mnclab.path.tool import Tool

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
        for step in steps:
            z, r = (here if to is None else to for here, to in ((self.z, step.z), (self.r, step.x)))
            self.feed(z, r, RAPID if isinstance(step, Go) and step.feed == AT_RAPID else role)

    def along(self, contour: Contour | None, role: str) -> None:
        """Along a contour, at the feed of the role: straight to its start, if the tip is elsewhere."""
        if contour is not None:
            for place, bulge in zip(contour.points, (0.0, *contour.bulge.tolist()), strict=False):
                self.feed(place[0], place[1], role, bulge)

    def append(self, plan: Plan, outside: float) -> None:
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


# Rapids of turning that keep clear of what still stands, and strokes that stay above the profile.
# A plan is gone through stroke by stroke on the half section of the blank. A rapid that would meet material goes up and
# over instead, or out of the blank, over and down; what of the way out or down is not free is cut at feed. A stroke that
# would cut below the profile is refused. Coordinates (z, r), mm.

OUT = 1.0  # mm outside the blank
LEAST = 1e-6  # mm²; what is narrower than two chord errors does not count
NEAR = 0.1  # mm above what stands, where a rapid down ends

Place = tuple[float, float]


def cleared(plan: Plan, profile: Contour, blank: float, tool: Tool) -> Plan:
    """The plan with safe rapids. A ValueError names the first stroke that would cut below the profile."""
    z = profile.points[[0, -1], 0]
    bottom = min([-1.0, *(stroke.r - 1 for stroke in plan.strokes)])
    highest = max(blank, *(stroke.r for stroke in plan.strokes))
    whole = under(Contour([(z[0], bottom), (z[1], bottom)], closed=False), blank)
    part = whole.difference(under(profile, highest + 1))
    section = _Section(plan.name, edges_of(tool, highest - bottom + 10), whole, part, blank + OUT, plan.start)
    for k, stroke in enumerate(plan.strokes):
        if stroke.role == RAPID:
            section.number = next((s.number for s in plan.strokes[k:] if s.role != RAPID), section.number)
            section.rapid(stroke)
        else:
            section.cut(stroke)
    return Plan(plan.name, plan.start, tuple(section.strokes))


@dataclass
class _Section:
    """The half section as the strokes leave it: what is `left`, what must stay of it (`part`), where the tip is."""

    name: str
    outline: Floats
    left: Any
    part: Any
    outside: float
    here: Place
    number: int = 0
    strokes: list[Stroke] = field(default_factory=list)

    def meets(self, area: Any, start: Place, end: Place, bulge: float = 0.0) -> float:
        """How much of an area, mm², the tool covers on its way."""
        return float(broad(area.intersection(self.swept(start, end, bulge)), 2 * CHORD_ERROR).area)

    def swept(self, start: Place, end: Place, bulge: float) -> Any:
        return swept(self.outline, Contour([start, end], [bulge, 0.0], closed=False))

    def free(self, *places: Place) -> bool:
        return all(self.meets(self.left, a, b) <= LEAST for a, b in zip(places, places[1:], strict=False))

    def cut(self, stroke: Stroke) -> None:
        end = (stroke.z, stroke.r)
        if (gouged := self.meets(self.part, self.here, end, stroke.bulge)) > LEAST:
            raise ValueError(
                f"{self.name}: the {stroke.role} stroke to Z{stroke.z:.6g} R{stroke.r:.6g} would cut {gouged:.3g} mm² below "
                "the profile: part the profile into zones, or take another scheme or tool"
            )
        self.left = self.left.difference(self.swept(self.here, end, stroke.bulge))
        self.strokes.append(stroke)
        self.here = end

    def rapid(self, stroke: Stroke) -> None:
        """A rapid as it is if nothing is in its way, else around what is."""
        (z, r), end = self.here, (stroke.z, stroke.r)
        above = max(self.outside, r)
        if self.free(self.here, end):
            self._go(end)
        elif r < stroke.r and self.free(self.here, (z, stroke.r), end):
            self._go((z, stroke.r), end)
        else:
            if not self.free(self.here, (z, above)):
                self.cut(Stroke(z, above, ROUGH, number=self.number))
            self._go((z, above), (stroke.z, above), (stroke.z, self._lowest(stroke.z, above, stroke.r)))
            if self.here != end:
                self.cut(Stroke(*end, PLUNGE, number=self.number))

    def _go(self, *places: Place) -> None:
        for place in places:
            if place != self.here:
                self.strokes.append(Stroke(*place, RAPID))
                self.here = place

    def _lowest(self, z: float, high: float, low: float) -> float:
        """How far down the way is free, less a little if it is not free to the end."""
        if self.free((z, high), (z, low)):
            return low
        top = high
        while top - low > NEAR / 2:
            middle = (top + low) / 2
            top, low = (middle, low) if self.free((z, high), (z, middle)) else (top, middle)
        return min(top + NEAR, high)
