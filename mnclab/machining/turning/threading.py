"""Threads cut with a single-point tool in passes, on the outside or in a bore, straight or tapered. ::

                        z1
          x1  <----------*   start
               run-out / |
                 _____/  |      crest
        end ...         ...     depth of the pass

X is a radius, mm. Whether the thread is outside or inside, and which way it runs, follows from the start.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from itertools import pairwise

from mnclab.machining.steps import Go, Thread

Place = tuple[float, float]  # (x, z)


def lead_along(across: float, along: float, pitch: float) -> float:
    """The way of the tool in one turn when the axis with the longer way advances `pitch`.

    >>> lead_along(0, -43, 1.5)
    1.5
    >>> lead_along(3, 4, 2)
    2.5
    """
    return pitch * math.hypot(across, along) / max(abs(across), abs(along))


def thread_pass(label: str, way: Sequence[Place], outside: float, pitch: float) -> Iterator[Go | Thread]:
    """In, along the way locked to the spindle, out to x `outside`; a third place is a run-out, the pitch counts along Z."""
    yield Go(label, z=way[0][1])
    yield Go(label, x=way[0][0])
    for name, ((x1, z1), (x, z)) in zip((label, f"{label}, run-out"), pairwise(way), strict=False):
        yield Thread(name, z, pitch * math.hypot(x - x1, z - z1) / abs(z - z1), x)
    yield Go(label, x=outside)


def thread_passes(
    start: Place, end: Place, pitch: float, depths: Sequence[float], *, taper: float = 0.0, angle: float = 0.0,
    run_out: float = 0.0,
) -> Iterator[Go | Thread]:  # fmt: skip
    """Passes from `start` (x, z) beside the part to `end`: the crest of the thread there, and where it ends.

    Each lies one of the `depths` (mm, radius) below the crest. `taper`: how much deeper (radius) the thread is at the start.
    `angle` (rad) shifts the begin of a pass towards the end by depth * tan(angle), so that one flank cuts. Over the last
    `run_out` mm the tool leaves the thread straight to the x of the start, still locked to the spindle.
    """
    (x1, z1), (x, z) = start, end
    into, onward = math.copysign(1.0, x - x1), math.copysign(1.0, z - z1)
    for number, depth in enumerate(depths, 1):
        label = f"pass {number} of {len(depths)}" if len(depths) > 1 else "thread"
        places = z1 + onward * depth * math.tan(angle), z - onward * run_out
        way = [(x + into * (depth + taper * (z - place) / (z - z1)), place) for place in places]
        yield from thread_pass(label, [*way, (x1, z)] if run_out else way, x1, pitch)
        yield Go(label, z=z1)
