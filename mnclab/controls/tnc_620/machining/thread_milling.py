"""Thread milling round the axis of a hole or a stud, in helices joined tangentially by half circles.

Rotation of the tool centre, seen from the tool: `sense` +1 counter-clockwise, -1 clockwise; `hand` is +1 for a
right-hand thread, -1 for a left-hand one. Their product is the way along the axis: +1 upwards, -1 downwards. Every helix
begins at angle 0, the first axis of the plane.

Geometry and readings: TNC 620, cycles 262 to 267 (5.5 to 5.10). The approach rises by the pitch times its radius over
twice the radius of the helix, at which it joins the helix tangentially in space too.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import NamedTuple

from mnclab.machining.depths import DRIFT, MOST, TooMany
from mnclab.machining.steps import Go, Step, Turn

WHOLE = 2 * math.pi


class Path(NamedTuple):
    """Where the tool centre runs: radius of the helix, radius of the half circles, distance of their start (mm)."""

    radius: float
    approach: float
    start: float


def path_of(nominal: float, tool_radius: float, pitch: float, external: bool = False) -> Path:
    """The path inside a nut or outside a stud; pitch positive.

    >>> path_of(30, 5, 1.5)
    Path(radius=10.0, approach=1.5, start=7.0)
    """
    if external:
        radius = nominal / 2 + tool_radius
        return Path(radius, pitch, radius + 2 * pitch)
    radius = nominal / 2 - tool_radius
    approach = min(radius / 2, pitch)
    return Path(radius, approach, radius - 2 * approach)


def helices(depth: float, pitch: float, bottom: float, upwards: bool, a_step: int = 0) -> list[tuple[float, float]]:
    """Start and end levels of the helices that make a thread of a `depth` over `bottom`.

    `a_step` 0: one turn at the bottom; 1: one helix over the depth; more: single turns, so many pitches apart.

    >>> helices(20, 1.5, 10, True, 4)
    [(10.0, 11.5), (16.0, 17.5), (22.0, 23.5), (28.0, 29.5)]
    """
    if a_step and depth > MOST * max(a_step, 1) * pitch:
        raise TooMany(f"{pitch:g} divides {depth:g} into more than {MOST} turns")
    count = max(1, math.ceil((depth - DRIFT) / (max(a_step, 1) * pitch))) if a_step else 1
    lowest = [bottom + k * a_step * pitch for k in range(count)] if a_step > 1 else [bottom]
    length = pitch * (count if a_step == 1 else 1)
    found = [(float(low), low + length) for low in lowest]
    return found if upwards else [(high, low) for low, high in reversed(found)]


def centre_feed(feed: float, nominal: float, tool_radius: float, external: bool = False) -> float:
    """The feed of the tool centre for one of the cutting edge, mm/min."""
    return feed * (nominal + (2 if external else -2) * tool_radius) / nominal


def mill_thread(
    path: Path, runs: list[tuple[float, float]], *, pitch: float, sense: int, feed: float, approach_feed: float,
    position_feed: float, external: bool = False,
) -> Iterator[Step]:  # fmt: skip
    """Each of the `helices` with an approach and a departure of its own; at the end back to the axis, or to the start outside."""
    side = -sense if external else sense  # the half circles join the helix tangentially
    rise = pitch * path.approach / (2 * path.radius)
    middle, beside = ((path.start + path.radius) / 2, 0.0), path.start > DRIFT and not external
    for number, (begin, end) in enumerate(runs, 1):
        way, which = 1 if end > begin else -1, "" if len(runs) == 1 else f" {number} of {len(runs)}"
        yield Go("to the start level" + which, begin, position_feed)
        if number == 1 and beside:
            yield Go("beside the thread", feed=position_feed, x=path.start, y=0.0)
        yield Go("back by the rise of the approach" + which, begin - way * rise, position_feed)
        yield Turn("approach" + which, side * math.pi, begin, approach_feed, middle)
        yield Turn("helix" + which, sense * WHOLE * round(abs(end - begin) / pitch), end, feed)
        yield Turn("departure" + which, side * math.pi, None, feed, middle)
    if beside:
        yield Go("back to the axis", feed=position_feed, x=0.0, y=0.0)


def countersink(path: Path, offset: float, *, sense: int, feed: float, external: bool = False) -> Iterator[Step]:
    """A full circle of radius `offset` from the axis (outside: from the start point) and back; nothing without an offset."""
    if not offset:
        return
    start = path.start if external else 0.0
    # outside, and coming from outside the circle, the half circles turn the other way
    half, middle = (-1 if offset < start else 1) * sense * math.pi, ((start + offset) / 2, 0.0)
    apart = abs(offset - start) > DRIFT
    if apart:
        yield Turn("to the countersink", half, None, feed, middle)
    yield Turn("countersink", sense * WHOLE, None, feed)
    if apart:
        yield Turn("back from the countersink", half, None, feed, middle)


def chamfer(radius: float, pitch: float, *, sense: int, feed: float, position_feed: float) -> Iterator[Step]:
    """A full circle of the tool centre from the axis and back, approached as a thread is; none where it fills the hole."""
    if radius <= DRIFT:
        return
    start = radius - 2 * min(radius / 2, pitch)
    middle = ((start + radius) / 2, 0.0)
    if start > DRIFT:
        yield Go("beside the core", feed=position_feed, x=start, y=0.0)
    yield Turn("to the core", sense * math.pi, None, feed, middle)
    yield Turn("countersink at the side", sense * WHOLE, None, feed)
    yield Turn("away from the core", sense * math.pi, None, feed, middle)
    if start > DRIFT:
        yield Go("back to the axis", feed=position_feed, x=0.0, y=0.0)
