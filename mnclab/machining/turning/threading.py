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

from mnclab.machining.steps import Go, Step, Thread


def lead_along(across: float, along: float, pitch: float) -> float:
    """The way of the tool in one turn when the axis with the longer way advances `pitch`.

    >>> lead_along(0, -43, 1.5)
    1.5
    >>> lead_along(3, 4, 2)
    2.5
    """
    return pitch * math.hypot(across, along) / max(abs(across), abs(along))


def thread_passes(
    start: tuple[float, float],
    end: tuple[float, float],
    pitch: float,
    depths: Sequence[float],
    *,
    taper: float = 0.0,
    angle: float = 0.0,
    run_out: float = 0.0,
) -> Iterator[Step]:
    """Passes from `start` (x, z) beside the part to `end`: the crest of the thread there, and where it ends.

    Each pass lies one of the `depths` (mm, radius) below the crest. `taper` is how much deeper (radius) the thread is
    at the start. `angle` (rad) shifts the begin of a pass towards the end by depth * tan(angle), so that one flank
    cuts. Over the last `run_out` mm the tool leaves the thread on a straight line to the x of the start, still locked
    to the spindle. The pitch counts along Z, and every pass begins at the zero mark of the spindle.
    """
    (x1, z1), (x, z) = start, end
    into, onward = math.copysign(1.0, x - x1), math.copysign(1.0, z - z1)
    for number, depth in enumerate(depths, 1):
        label = f"pass {number} of {len(depths)}" if len(depths) > 1 else "thread"
        begin, stop = z1 + onward * depth * math.tan(angle), z - onward * run_out
        across = [x + into * (depth + taper * (z - place) / (z - z1)) for place in (begin, stop)]
        yield Go(label, z=begin)
        yield Go(label, x=across[0])
        yield _thread(label, (across[0], begin), (across[1], stop), pitch)
        if run_out:
            yield _thread(f"{label}, run-out", (across[1], stop), (x1, z), pitch)
        yield Go(label, x=x1)
        yield Go(label, z=z1)


def _thread(label: str, begin: tuple[float, float], end: tuple[float, float], pitch: float) -> Thread:
    dx, dz = end[0] - begin[0], end[1] - begin[1]
    return Thread(label, end[1], pitch * math.hypot(dx, dz) / abs(dz), end[0])
