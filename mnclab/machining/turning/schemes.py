"""Roughing schemes of turning (NC-31, 3.20.2): strokes of a tool tip from a blank of one radius down to a profile.

Every scheme takes a profile (z, r) as `profiles` has it, with the finishing allowance already on it, the
radius of the blank and the depth of a pass on the radius, mm; it works on what the tool's angles let it reach, and on
one zone at a time (`combined` parts the rest). Feeds belong to the `role` of a stroke and are given later.

    loop         pass, lift, back           pick-up      loop, and along the contour up to the level before
    zigzag       pass there, pass back      semi-finish  loop, then once along the whole contour
    descent      radial strokes             equidistant  along offsets       contour  along shifted copies

    levels: blank - depth, blank - 2 depth, …, the bottom (catalogue: turning-technology)

The lathe cycles G77 and G78 are the semi-finish on one shoulder: `roughing` has its steps for every side and direction.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import replace
from functools import partial
from typing import Any

import numpy as np

from mnclab.geometry.contours import Contour
from mnclab.machining.turning.passes import FRONT, LIFT, MOST, POINT, Cutter, Task, falls_again, task, without_drop
from mnclab.machining.turning.profiles import (
    CLOSED,
    OPEN,
    SAME,
    between,
    entry_way,
    exit_way,
    filled,
    lowest,
    offset,
    reachable,
    zones,
)
from mnclab.machining.turning.roughing import grooves
from mnclab.machining.turning.strokes import CLEANUP, OUT, PICK_UP, PLUNGE, ROUGH, Pen, Plan, cleared
from mnclab.path.tool import Tool


def loop(profile: Contour, blank: float, depth: float, tool: Tool = POINT, **distances: Any) -> Plan:
    """Every pass by itself: along Z to the contour, off it, back at rapid; in a closed zone it plunges along the contour.

    >>> shoulder = mnc.area.Contour([(0, 10), (-30, 10), (-30, 20)], closed=False)
    >>> mnc.schemes.loop(shoulder, blank=20, depth=5).passes  # 10 mm by 5 mm
    2
    """
    return cleared(_loop(task(profile, blank, depth, tool, **distances)), profile, blank, tool)


def _loop(t: Task) -> Plan:
    pen = _passes(t, len(t.levels))
    if t.levels[-1].first is not None:
        pen.off(len(t.levels) - 1)
    return pen.out("loop")


def _passes(t: Task, count: int, pick_up: bool = False) -> Cutter:
    """The first passes of a task, each followed by the way back; after the last one of a closed zone it stands still."""
    pen = Cutter(t)
    above = t.blank
    for k, level in enumerate(t.levels[:count]):
        pen.number += 1
        pen.down(k)
        pen.feed(level.left, level.r, ROUGH)
        right = level.right
        if pick_up:
            pen.along(between(t.profile, level.last, exit_way(t.profile, above)), PICK_UP)
            if level.first is not None:  # to where the pass before began, if the wall lets the tool pass there
                way = entry_way(t.profile, above) or 0.0
                z, wall = t.profile.point_at(way)[0].tolist()
                right = z if wall <= min(pen.r + t.lift, t.blank) + SAME else right
        if k + 1 < len(t.levels) or level.first is None:
            pen.lift_off(k, right)
        above = level.r
    return pen


def pick_up(profile: Contour, blank: float, depth: float, tool: Tool = POINT, **distances: Any) -> Plan:
    """As the loop, but each pass goes on along the contour up to the level of the pass before: no ridges are left.

    >>> shoulder = mnc.area.Contour([(0, 10), (-30, 10), (-30, 20)], closed=False)
    >>> mnc.schemes.pick_up(shoulder, blank=20, depth=5).passes  # 10 mm by 5 mm
    2
    """
    t = task(profile, blank, depth, tool, **distances)
    return cleared(_passes(t, len(t.levels), pick_up=True).out("pick-up"), profile, blank, tool)


def semi_finish(
    profile: Contour, blank: float, depth: float, tool: Tool = POINT, after: str = "last", **distances: Any
) -> Plan:
    """Passes as in the loop; after the last one, or in place of it after the penultimate, once along the whole contour.

    >>> shoulder = mnc.area.Contour([(0, 10), (-30, 10), (-30, 20)], closed=False)
    >>> mnc.schemes.semi_finish(shoulder, blank=20, depth=5).passes  # two of 5 mm and one along the contour
    3
    """
    if after not in ("last", "penultimate"):
        raise ValueError(f'the clean-up follows the "last" or the "penultimate" pass, got {after!r}')
    return cleared(_semi_finish(task(profile, blank, depth, tool, **distances), after), profile, blank, tool)


def _semi_finish(t: Task, after: str = "last") -> Plan:
    count = len(t.levels) - (after == "penultimate")
    pen = _passes(t, count)
    bottom, begin = t.levels[-1], 0.0
    if bottom.first is None or count < len(t.levels):
        pen.number += 1
    if bottom.first is None:  # from the face along everything
        pen.rapid(t.front, t.profile.points[0, 1])
    elif count < len(t.levels):
        pen.down(count)
        begin = bottom.first
    else:
        begin = bottom.last
    pen.along(between(t.profile, begin, t.profile.length), CLEANUP)
    return pen.out("semi-finish")


def zigzag(profile: Contour, blank: float, depth: float, tool: Tool = POINT, **distances: Any) -> Plan:
    """Passes there and back without an idle stroke, to the next level along the contour; the tool must cut both ways.

    >>> shoulder = mnc.area.Contour([(0, 10), (-30, 10), (-30, 20)], closed=False)
    >>> mnc.schemes.zigzag(shoulder, blank=20, depth=5).passes  # 10 mm by 5 mm
    2
    """
    t = task(profile, blank, depth, tool, **distances)
    pen = Cutter(t)
    for k, level in enumerate(t.levels):
        pen.number += 1
        above = t.levels[k - 1]
        if k % 2:  # from the left
            wall = between(t.profile, level.last, above.last)
            pen.along(wall and wall.reversed(), ROUGH)
        elif k == 0:
            pen.down(0)
        elif level.first is None:
            pen.feed(t.front, level.r, ROUGH)
        else:
            pen.plunge(above, level)
        pen.feed(level.left, level.r, ROUGH)
        if k % 2:
            pen.feed(level.right, level.r, ROUGH)
    last = len(t.levels) - 1
    if last % 2 == 0:
        leave = pen.lift_off if t.levels[last].first is None else pen.off
        leave(last)
    return cleared(pen.out("zigzag"), profile, blank, tool)


def descent(
    profile: Contour, blank: float, step: float, tool: Tool = POINT, lift: float = LIFT, front: float = FRONT
) -> Plan:
    """Radial strokes to the contour, one `step` apart; `tool.width` is the width of its edge, its left corner the tip.

    A tool with a width stands clear of the first wall and ends at the last one.

    >>> shoulder = mnc.area.Contour([(0, 10), (-30, 10), (-30, 20)], closed=False)
    >>> mnc.schemes.descent(shoulder, blank=20, step=5).passes  # 30 mm by 5 mm
    6
    """
    if not step > 0 or (tool.width and step > tool.width + SAME):
        most = f" and at most the tool width {tool.width:g}" if tool.width else ""
        raise ValueError(f"the step must be greater than 0{most}, got {step:g}")
    t = task(profile, blank, blank, tool, lift, front)
    right, left = (float(z) for z in t.profile.points[[0, -1], 0])
    first = right - (tool.width or step)
    count = math.floor((first - left) / step + 1e-9)
    if count > MOST:
        raise ValueError(f"a step of {step:g} gives {count} strokes, allowed are {MOST}")
    places = [first - k * step for k in range(count + 1)]
    if tool.width and (not places or places[-1] > left + SAME) and right - left >= tool.width - SAME:
        places.append(left)
    cuts = [(z, r) for z in places if (r := lowest(t.profile, z)) < blank - SAME]
    if not cuts:
        raise ValueError("no stroke fits between the walls")
    pen = Pen(cuts[0][0], t.outside)
    for z, r in cuts:
        pen.number += 1
        pen.follow(grooves(t.outside, r, [z]), PLUNGE)
    return cleared(pen.plan("descent"), profile, blank, tool)


def equidistant(profile: Contour, blank: float, depth: float, tool: Tool = POINT, **distances: Any) -> Plan:
    """Strokes along offsets of the contour with sharp corners, one `depth` apart along its normal, within the blank.

    >>> shoulder = mnc.area.Contour([(0, 10), (-30, 10), (-30, 20)], closed=False)
    >>> mnc.schemes.equidistant(shoulder, blank=20, depth=5).passes  # 10 mm by 5 mm
    2
    """
    t = task(profile, blank, depth, tool, **distances, slanting=True)
    strokes: list[tuple[bool, Contour]] = []
    for k in range(MOST):
        found = list(_within(offset(t.profile, k * depth, t.front), blank, t.front))
        if not found:
            break
        strokes = [*found, *strokes]
    else:
        raise ValueError(f"a depth of {depth:g} gives more than {MOST} strokes")
    pen = Cutter(t)
    for free, stroke in strokes:
        begin = stroke.points[0]
        pen.rapid(t.front if free else float(begin[0]), t.outside if pen.number else t.blank)
        pen.rapid(*begin)
        pen.number += 1
        pen.once_along(stroke, ROUGH, t.outside)
        if free:
            pen.rapid(t.front, t.outside)
    return cleared(pen.plan("equidistant"), profile, blank, tool)


def contour(
    profile: Contour, blank: float, depth: float, tool: Tool = POINT, shift: tuple[float, float] | None = None,
    passes: int | None = None, lift: float = LIFT, front: float = FRONT,
) -> Plan:  # fmt: skip
    """The contour again and again, shifted less each time: by `shift` (r, z) at first, by nothing at last.

    Without `shift` and `passes` the copies lie one `depth` apart on the radius.

    >>> shoulder = mnc.area.Contour([(0, 10), (-30, 10), (-30, 20)], closed=False)
    >>> mnc.schemes.contour(shoulder, blank=20, depth=5).passes  # 10 mm by 5 mm
    2
    """
    t = task(profile, blank, depth, tool, lift, front, slanting=True)
    count = len(t.levels) if passes is None else passes
    if count < 1:
        raise ValueError(f"at least one pass is needed, got {count}")
    dr, dz = ((count - 1) * depth, 0.0) if shift is None else shift
    if dr < 0 or dz < 0:
        raise ValueError(f"the shift must lead away from the contour, got {dr:g}, {dz:g}")
    z0, r0 = t.start[0], float(t.profile.points[0, 1])
    pen = Cutter(t, shift=dz)
    for k in range(count - 1, -1, -1):
        pen.number += 1
        share = k / (count - 1) if count > 1 else 0.0
        zs, rs = z0 + dz * share, t.blank + dr * share
        pen.rapid(zs, rs)
        pen.rapid(zs, r0 + dr * share)
        copy = Contour(t.profile.points + (dz * share, dr * share), t.profile.bulge, closed=False)
        pen.once_along(copy, ROUGH, rs)
        pen.rapid(zs, rs)
    return cleared(pen.plan("contour"), profile, blank, tool)


def combined(profile: Contour, blank: float, depth: float, tool: Tool = POINT, **distances: Any) -> Plan:
    """A profile of several zones: open ones by the loop, semi-open ones by the loop and a clean-up.

    With a closed zone the dry sections together by the loop, every closed one by passes, then one clean-up along all.

    >>> shoulder = mnc.area.Contour([(0, 10), (-30, 10), (-30, 20)], closed=False)
    >>> mnc.schemes.combined(shoulder, blank=20, depth=5).passes  # two of 5 mm and one along the contour
    3
    """
    reached = without_drop(reachable(profile, tool))
    found = zones(reached, blank)
    wet, dry = [z.profile for z in found if z.kind == CLOSED], [z for z in found if z.kind != CLOSED]
    edges = replace(tool, width=0.0)  # what is reached already minds the width
    both = bool(wet and dry)
    if both:  # passes at the rims too, so that every closed zone is free from above
        above = filled(reached)
        sections = [zone.profile for zone in dry] if falls_again(above) else [above]
        rims = [float(pool.points[0, 1]) for pool in wet]
        tasks = [task(section, blank, depth, edges, also=rims, **distances) for section in sections]
        plans = [_loop(each) for each in tasks]
    else:
        tasks = [task(zone.profile, blank, depth, edges, **distances) for zone in dry]
        plans = [_loop(t) if zone.kind == OPEN else _semi_finish(t) for t, zone in zip(tasks, dry, strict=True)]
    for pool in wet:
        tasks.append(task(pool, min(blank, float(pool.points[0, 1])), depth, edges, **distances))
        plans.append(_loop(tasks[-1]) if both else _semi_finish(tasks[-1]))
    t = tasks[0]._replace(blank=blank)
    pen = Cutter(t)
    for plan in plans:
        pen.append(plan, blank + OUT)
    if both:
        pen.number += 1
        pen.rapid(pen.z, t.outside)
        pen.rapid(t.front, t.outside)
        pen.rapid(t.front, float(reached.points[0, 1]))
        pen.once_along(reached, CLEANUP, t.outside)
    return cleared(pen.plan("combined"), profile, blank, tool)


#: The schemes by name; `descent` takes its step where the others take the depth.
SCHEMES: dict[str, Callable[..., Plan]] = {
    "loop": loop, "zigzag": zigzag, "descent": descent, "pick-up": pick_up, "semi-finish": semi_finish,
    "semi-finish after penultimate": partial(semi_finish, after="penultimate"),
    "equidistant": equidistant, "contour": contour, "combined": combined,
}  # fmt: skip


def _within(stroke: Contour, blank: float, front: float) -> Iterator[tuple[bool, Contour]]:
    """The parts of a stroke below the radius of the blank, and whether they begin in front of the face."""
    below = between(stroke, 0.0, stroke.length)
    while below is not None and (below.points[:, 1] < blank - SAME).any():
        first = entry_way(below, blank)
        rest = between(below, first or 0.0, below.length)
        assert rest is not None
        over = np.flatnonzero(rest.points[:, 1] > blank + SAME)
        if not len(over):
            yield first is None, rest
            return
        wall = Contour(rest.points[: over[0] + 1], rest.bulge[: over[0] + 1], closed=False)
        part = between(rest, 0.0, exit_way(wall, blank))
        if part is not None and (part.points[:, 1] < blank - SAME).any():
            yield first is None, part
        below = between(rest, wall.length, rest.length)
