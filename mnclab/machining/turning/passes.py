"""Passes of turning: the levels of a task, and the ways of the tool from one pass to the next.

Coordinates (z, r), mm, as in `turning_profiles`. Where no wall stands a tool waits in front of the face; in a closed
zone it goes back to where the pass before began and plunges along the wall.
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from typing import NamedTuple

import numpy as np

from mnclab.geometry.contours import Contour
from mnclab.machining.turning.clearance import OUT
from mnclab.machining.turning.profiles import SAME, angles_of, between, entry_way, exit_way, over, reachable
from mnclab.machining.turning.strokes import PLUNGE, ROUGH, Pen, Plan
from mnclab.path.tool import Tool

LIFT, FRONT = 0.5, 2.0  # mm: retract after a stroke, in front of the face
POINT = Tool(kind="turning")
MOST = 10_000  # passes


class Level(NamedTuple):
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
    levels: tuple[Level, ...]
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

    Strokes that begin `slanting` need more room in front of the face for an edge that leans forward. A ValueError says
    what is wrong with the numbers.
    """
    if not depth > 0:
        raise ValueError(f"the depth of a pass must be greater than 0, got {depth:g}")
    if not lift > 0:
        raise ValueError(f"the retract must be greater than 0, got {lift:g}")
    contour = without_drop(reachable(profile, tool))
    r = contour.points[:, 1]
    if falls_again(contour):
        raise ValueError("the profile falls again after it has grown: part it into zones, or use `combined`")
    bottom = float(r.min())
    if not blank > bottom + SAME:
        raise ValueError(f"a blank of radius {blank:g} leaves nothing to cut above the profile where the tool reaches")
    first, last = entry_way(contour, blank), exit_way(contour, blank)
    inside = between(contour, first or 0.0, last)  # what lies above the blank is no affair of the tool
    if inside is None:
        raise ValueError(f"a blank of radius {blank:g} leaves nothing to cut above the profile where the tool reaches")
    contour = inside
    count = math.ceil((blank - bottom) / depth * (1 - 1e-9))
    if count > MOST:
        raise ValueError(f"a depth of {depth:g} gives {count} passes, allowed are {MOST}")
    lean = angles_of(tool)[0]  # an edge that leans forward must not reach the face from where the tool waits
    ahead = float(contour.points[0, 0]) + max(
        front, (blank - bottom if slanting else min(depth, blank - bottom)) / math.tan(lean)
    )
    heights = [blank - k * depth for k in range(1, count)] + [bottom]
    heights += [r for r in also if bottom < r < blank and min(abs(r - h) for h in heights) > SAME]
    levels = []
    for height in sorted(heights, reverse=True):
        first, last = entry_way(contour, height), exit_way(contour, height)
        right = ahead if first is None else float(contour.point_at(first)[0][0])
        levels.append(Level(height, right, float(contour.point_at(last)[0][0]), first, last))
    return Task(contour, blank, tuple(levels), lift, ahead, blank + OUT)


def falls_again(profile: Contour) -> bool:
    """Whether a profile grows and falls behind that: no single zone."""
    steps = np.diff(profile.points[:, 1])
    return bool((steps[np.maximum.accumulate(steps > SAME)] < -SAME).any())


def without_drop(profile: Contour) -> Contour:
    """A profile that ends where it falls straight down at its end: there is nothing to cut."""
    z, r = profile.points.T
    last = int(np.flatnonzero(z <= z[-1] + SAME)[0])
    top = last + int(r[last:].argmax())
    return between(profile, 0.0, float(profile.lengths[:top].sum())) or profile


# ---- from pass to pass ----


def down(pen: Pen, t: Task, index: int) -> None:
    """To where a pass begins: in front of the face at rapid, in a closed zone along its wall."""
    level = t.levels[index]
    if level.first is None:
        pen.rapid(t.front, level.r)
        return
    before = t.levels[index - 1] if index else None
    if before is None or before.first is None:  # from the top of the wall
        top = t.profile.points[0]
        if before is not None:
            pen.rapid(t.front, float(top[1]))
        pen.along(between(t.profile, 0.0, level.first), PLUNGE)
        return
    straight(pen, t, before)
    plunge(pen, t, before, level)


def plunge(pen: Pen, t: Task, before: Level, level: Level) -> None:
    """Along the wall from one pass to the next, at feed."""
    pen.along(between(t.profile, before.first or 0.0, level.first or 0.0), PLUNGE)


def straight(pen: Pen, t: Task, before: Level) -> None:
    """At rapid to where the pass before began: straight if the wall is not in the way, else from above."""
    if abs(pen.z - before.right) > SAME:
        first = entry_way(t.profile, min(pen.r, float(t.profile.points[0, 1])))
        wall = between(t.profile, first or 0.0, before.first or 0.0)
        if wall is not None:
            z, r = wall.points_within(1e-3).T
            if (r > pen.r + (pen.z - z) / (pen.z - before.right) * (before.r - pen.r) + SAME)[z <= pen.z].any():
                pen.rapid(before.right, pen.r)
    pen.rapid(before.right, before.r)


def wall(t: Task, above: float, level: Level, r: float) -> float:
    """The z to go back to at a radius: where the pass before began, if the wall lets the tool pass there."""
    way = entry_way(t.profile, above)
    z, wall = t.profile.points[0] if way is None else t.profile.point_at(way)[0]
    return float(z) if wall <= r + SAME else level.right


def lift_off(pen: Pen, t: Task, level: Level, back_to: float | None = None) -> None:
    """Off the contour by the retract in both axes, and back along Z to where the pass began."""
    off(pen, t, level)
    height = pen.r
    pen.rapid(level.right if back_to is None else back_to, height)


def off(pen: Pen, t: Task, level: Level) -> None:
    """Off the contour by the retract in both axes; where a wall is too near, straight out at feed to the pass before."""
    k = t.levels.index(level)
    away(pen, t, t.levels[k - 1].r if k else t.blank, level.right - pen.z)


def away(pen: Pen, t: Task, height: float, room: float = math.inf) -> None:
    """As `off`, from anywhere on a profile; `room` is how far to the right the stroke has cleared."""
    z = min(pen.z + t.lift, float(t.profile.points[0, 0]))
    if room < t.lift or (pen.z + t.lift > t.profile.points[0, 0] and pen.r < t.profile.points[0, 1] - SAME):
        free = False
    else:
        wall = over(t.profile, pen.z, z)
        spots = np.empty((0, 2)) if wall is None else wall.points_within(1e-3)
        free = bool((spots[:, 1] - pen.r <= spots[:, 0] - pen.z + SAME).all())
    if free:
        pen.rapid(pen.z + t.lift, min(pen.r + t.lift, t.blank))
    else:
        pen.feed(pen.z, min(max(height, pen.r) + t.lift, t.blank), ROUGH)


def out(pen: Pen, t: Task, name: str) -> Plan:
    """Out of the zone: in front of the face, or straight up where walls stand on both sides."""
    if t.levels[-1].first is not None:
        if (
            abs(pen.z - t.profile.points[-1, 0]) < SAME and pen.r < t.blank - SAME
        ):  # no wall: not along what stays there
            away(pen, t, t.blank, t.levels[-1].right - pen.z)
        pen.rapid(pen.z, t.outside)
    elif pen.r < t.blank - SAME and pen.z < t.front - SAME:
        away(pen, t, t.blank)
        pen.rapid(t.front, pen.r)
        pen.rapid(t.front, t.blank)
    else:
        pen.rapid(t.front, t.blank)
    return pen.plan(name)
