"""Passes of turning: the levels of a task, and the ways of the tool from one pass to the next.

Coordinates (z, r), mm, as in `profiles`. Where no wall stands a tool waits in front of the face; in a closed zone it goes
back to where the pass before began and plunges along the wall.
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from typing import NamedTuple

import numpy as np

from mnclab.geometry.contours import Contour
from mnclab.machining.turning.profiles import SAME, between, entry_way, exit_way, over, reachable
from mnclab.machining.turning.roughing import count_of_levels, levels
from mnclab.machining.turning.strokes import OUT, PLUNGE, ROUGH, Pen, Plan
from mnclab.path.inserts import angles_of
from mnclab.path.tool import Tool

LIFT, FRONT = 0.5, 2.0  # mm: retract after a stroke, in front of the face
POINT = Tool(kind="turning")
MOST = 10_000  # passes


class TurningPass(NamedTuple):
    """One pass: its radius, the z where it begins and ends, and the ways along the profile to both."""

    r: float
    right: float
    left: float
    first: float | None  # None: it begins in front of the face
    last: float


class Task(NamedTuple):
    """What every scheme needs: the profile as the tool reaches it, the blank, the levels and the distances."""

    profile: Contour
    blank: float
    levels: tuple[TurningPass, ...]
    lift: float
    front: float  # z where the tool waits in front of the face
    outside: float

    @property
    def start(self) -> tuple[float, float]:
        """(z, r) before the first stroke: in front of the face, or over the first wall."""
        if self.levels and self.levels[0].first is not None:
            return float(self.profile.points[0, 0]), self.blank
        return self.front, self.blank


def task(
    profile: Contour, blank: float, depth: float, tool: Tool = POINT, lift: float = LIFT, front: float = FRONT,
    also: Iterable[float] = (), slanting: bool = False,
) -> Task:  # fmt: skip
    """Levels one `depth` apart down to the bottom of one zone, and `also` some radii between.

    Strokes that begin `slanting` need more room in front of the face for an edge that leans forward.
    """
    for name, value in (("depth of a pass", depth), ("retract", lift)):
        if not value > 0:
            raise ValueError(f"the {name} must be greater than 0, got {value:g}")
    contour = without_drop(reachable(profile, tool))
    if falls_again(contour):
        raise ValueError("the profile falls again after it has grown: part it into zones, or use `combined`")
    bottom = float(contour.points[:, 1].min())
    below = None  # what lies above the blank is no affair of the tool
    if blank > bottom + SAME:
        below = between(contour, entry_way(contour, blank) or 0.0, exit_way(contour, blank))
    if below is None:
        raise ValueError(f"a blank of radius {blank:g} leaves nothing to cut above the profile where the tool reaches")
    count = count_of_levels(blank, bottom, depth, with_finish=False) + 1
    if count > MOST:
        raise ValueError(f"a depth of {depth:g} gives {count} passes, allowed are {MOST}")
    heights = [*levels(blank, bottom, depth, with_finish=False), bottom]
    heights += [r for r in also if bottom < r < blank and min(abs(r - h) for h in heights) > SAME]
    rise = blank - bottom if slanting else min(depth, blank - bottom)
    lean = angles_of(tool)[0]  # an edge that leans forward must not reach the face from where the tool waits
    ahead = float(below.points[0, 0]) + max(front, rise / math.tan(lean))
    found = []
    for height in sorted(heights, reverse=True):
        first, last = entry_way(below, height), exit_way(below, height)
        right, left = below.point_at([first or 0.0, last])[0][:, 0].tolist()
        found.append(TurningPass(height, ahead if first is None else right, left, first, last))
    return Task(below, blank, tuple(found), lift, ahead, blank + OUT)


def falls_again(profile: Contour) -> bool:
    """Whether a profile grows and falls behind that: no single zone."""
    steps = np.diff(profile.points[:, 1])
    return bool((steps[np.maximum.accumulate(steps > SAME)] < -SAME).any())


def without_drop(profile: Contour) -> Contour:
    """A profile that ends where it falls straight down at its end: there is nothing to cut."""
    z, r = profile.points.T
    top = int(np.where(z <= z[-1] + SAME, r, -np.inf).argmax())
    return between(profile, 0.0, float(profile.lengths[:top].sum())) or profile


class Cutter(Pen):
    """The pen of a task, which knows the ways from pass to pass."""

    def __init__(self, t: Task, shift: float = 0.0) -> None:
        super().__init__(t.start[0] + shift, t.start[1])
        self.t = t

    def down(self, k: int) -> None:
        """To where pass k begins: in front of the face at rapid, in a closed zone along its wall."""
        t, level = self.t, self.t.levels[k]
        if level.first is None:
            self.rapid(t.front, level.r)
        elif k == 0 or t.levels[k - 1].first is None:  # from the top of the wall
            if k:
                self.rapid(t.front, float(t.profile.points[0, 1]))
            self.along(between(t.profile, 0.0, level.first), PLUNGE)
        else:
            self.back_to(t.levels[k - 1])
            self.plunge(t.levels[k - 1], level)

    def plunge(self, before: TurningPass, level: TurningPass) -> None:
        self.along(between(self.t.profile, before.first or 0.0, level.first or 0.0), PLUNGE)

    def back_to(self, level: TurningPass) -> None:
        """At rapid to where a pass began: straight if the wall is not in the way, else from above."""
        profile = self.t.profile
        if abs(self.z - level.right) > SAME:
            first = entry_way(profile, min(self.r, float(profile.points[0, 1])))
            wall = between(profile, first or 0.0, level.first or 0.0)
            if wall is not None:
                z, r = wall.points_within(1e-3).T
                line = self.r + (self.z - z) / (self.z - level.right) * (level.r - self.r)
                if (r > line + SAME)[z <= self.z].any():
                    self.rapid(level.right, self.r)
        self.rapid(level.right, level.r)

    def lift_off(self, k: int, right: float | None = None) -> None:
        """Off the contour by the retract in both axes, and back along Z to where pass k began, or to `right`."""
        self.off(k)
        self.rapid(self.t.levels[k].right if right is None else right, self.r)

    def off(self, k: int) -> None:
        """Off the contour after pass k; where a wall is too near, straight out at feed to the pass before."""
        self.away(self.t.levels[k - 1].r if k else self.t.blank, room=self.t.levels[k].right - self.z)

    def away(self, height: float, profile: Contour | None = None, room: float = math.inf) -> None:
        """As `off`, from anywhere on a profile; `room` is how far to the right the stroke has cleared."""
        t = self.t
        profile = t.profile if profile is None else profile
        right, top = profile.points[0].tolist()
        free = room >= t.lift and (self.z + t.lift <= right or self.r >= top - SAME)
        wall = over(profile, self.z, min(self.z + t.lift, right)) if free else None
        if wall is not None:
            z, r = wall.points_within(1e-3).T
            free = bool((r - self.r <= z - self.z + SAME).all())
        if free:
            self.rapid(self.z + t.lift, min(self.r + t.lift, t.blank))
        else:
            self.feed(self.z, min(max(height, self.r) + t.lift, t.blank), ROUGH)

    def once_along(self, contour: Contour, role: str, outside: float) -> None:
        self.along(contour, role)
        if self.r < self.t.blank - SAME:
            self.away(self.t.blank, contour)
        self.rapid(self.z, outside)

    def out(self, name: str) -> Plan:
        """Out of the zone: in front of the face, or straight up where walls stand on both sides."""
        t, last = self.t, self.t.levels[-1]
        below = self.r < t.blank - SAME
        if last.first is not None:
            if below and abs(self.z - t.profile.points[-1, 0]) < SAME:  # no wall: not along what stays there
                self.away(t.blank, room=last.right - self.z)
            self.rapid(self.z, t.outside)
            return self.plan(name)
        if below and self.z < t.front - SAME:
            self.away(t.blank)
            self.rapid(t.front, self.r)
        self.rapid(t.front, t.blank)
        return self.plan(name)
