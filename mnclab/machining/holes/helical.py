"""Milling round the axis of a hole in true helices: bores and threads.

Angle 0 is the first axis of the plane; `sense` is +1 counter-clockwise, -1 clockwise, seen from the tool.
"""

from __future__ import annotations

import math
from collections.abc import Iterator

from mnclab.machining.depths import MOST, TooMany
from mnclab.machining.steps import Go, Step, Turn

WHOLE = 2 * math.pi


def turns(length: float, pitch: float) -> float:
    """Turns of a helix over a length; TooMany beyond a limit that no bore needs."""
    if not length <= MOST * pitch:
        raise TooMany(f"{pitch:g} a turn makes more than {MOST} turns of {length:g}")
    return length / pitch


def steepest_pitch(radius: float, angle: float) -> float:
    """The most infeed per turn of a tool that plunges at most at an angle, degrees; inf for 0, not known, and 90.

    >>> round(steepest_pitch(4.5, 3), 4)
    1.4818
    """
    return WHOLE * radius * math.tan(math.radians(angle)) if 0 < angle < 90 else math.inf


def bore_milling(
    bottom: float, *, above: float, radius: float, pitch: float, sense: int, feed: float | None, by_arc: bool = False
) -> Iterator[Step]:
    """A helix of the tool centre from `above` to `bottom`, one full circle there, back to the axis.

    `radius` is that of the tool centre: 0 drills straight. `by_arc`: to the wall and back on half circles that join it
    tangentially, else straight. The last turn of the helix may be a part of one.
    """
    if radius == 0:
        yield Go("drill", bottom, feed)
        return
    half, angle = sense * math.pi, sense * WHOLE * turns(abs(above - bottom), pitch)
    if by_arc:
        yield Turn("to the wall", half, None, feed, (radius / 2, 0.0))
    else:
        yield Go("to the wall", feed=feed, x=radius, y=0.0)
    yield Turn("helix", angle, bottom, feed)
    yield Turn("circle at the bottom", sense * WHOLE, None, feed)
    if by_arc:
        middle = (radius / 2 * math.cos(angle), radius / 2 * math.sin(angle))
        yield Turn("back to the axis", half, None, feed, middle)
    else:
        yield Go("back to the axis", feed=feed, x=0.0, y=0.0)
