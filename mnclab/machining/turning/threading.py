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

import numpy as np

from mnclab.machining.steps import Go, Thread
from mnclab.machining.turning.strokes import THREAD, Pen, Plan

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


# Threads cut in passes: how the tool is shifted along Z as it goes deeper (NC-31, 3.20.12 and its table of passes).
#
#     radial      straight in: both edges cut             pitches up to 2 mm, and finishing
#     flank       along one flank: one edge cuts          roughing above 2 mm
#     alternate   to one flank and to the other in turn   coarse threads: both edges wear alike
#
# `depths` are total depths on the radius, mm; a shift counts along Z in the direction of feed.
#
#     flank      s = c·d, or with the last pass at the nominal Z  s = c·(d - d_last), against the feed
#     alternate  s = ±c·(d_last - d)                              c = 0.5 for 60°, 0.42 for 55°

METHODS = ("radial", "flank", "alternate")
FACTORS = {60.0: 0.5, 55.0: 0.42}
RADIAL_UP_TO = 2.0  # mm of pitch
#: Passes for external metric threads with radial infeed by pitch, mm: general figures, as the table is empty in the source.
USUAL_PASSES = {
    0.75: 4, 1.0: 5, 1.25: 6, 1.5: 6, 1.75: 8, 2.0: 8, 2.5: 10, 3.0: 12, 3.5: 12, 4.0: 14, 4.5: 14, 5.0: 14, 5.5: 16, 6.0: 16,
}  # fmt: skip


def factor(profile: float = 60.0) -> float:
    """The shift along Z for 1 mm of depth; the source prints it for profiles of 60 and 55 degrees.

    It calls the angle half the profile angle less 5 degrees; the printed factors give 26.57 and 22.78 degrees.

    >>> mnc.schemes.threads.factor(60)
    0.5
    """
    if profile not in FACTORS:
        raise ValueError(f"the factor is known for profiles of 60 and 55 degrees, got {profile:g}")
    return FACTORS[profile]


def shifts(
    depths: Sequence[float], method: str = "radial", profile: float = 60.0, nominal_last: bool = False
) -> tuple[float, ...]:
    """The shift along Z of every pass, mm, in the direction of feed.

    Of the one-sided infeed it counts from the first contact, or with `nominal_last` from the place of the last pass; then
    it is negative, against the feed. The alternate infeed always ends in the middle.

    >>> shifts((0.4, 0.8, 1.2), "flank")
    (0.2, 0.4, 0.6)
    """
    _check(depths)
    if method not in METHODS:
        raise ValueError(f"the infeed must be one of {', '.join(METHODS)}, got {method!r}")
    if method == "radial":
        return (0.0,) * len(depths)
    c, last = factor(profile), depths[-1]
    if method == "alternate":
        return tuple(round((-1) ** k * c * (last - d), 12) + 0.0 for k, d in enumerate(depths))
    return tuple(round(c * (d - last if nominal_last else d), 12) + 0.0 for d in depths)


def added(positions: Sequence[float]) -> tuple[float, ...]:
    """The shift before each pass: the steps between the positions, the first one from 0.

    >>> mnc.schemes.threads.added((0.25, 0.75, 1.5))
    (0.25, 0.5, 0.75)
    """
    return tuple(round(b - a, 12) for a, b in zip((0.0, *positions), positions, strict=False))


def even_chips(total: float, passes: int) -> tuple[float, ...]:
    """Depths of passes that all cut the same area of a triangular thread: total · √(k / n).

    >>> mnc.schemes.threads.even_chips(1.0, 4)[:1]  # the first of four passes goes half as deep as all
    (0.5,)
    """
    if passes < 1 or not total > 0:
        raise ValueError(f"a thread needs a depth and at least one pass, got {total:g} and {passes}")
    return tuple(total * math.sqrt(k / passes) for k in range(1, passes + 1))


def methods_for(pitch: float) -> tuple[str, ...]:
    """Which infeeds the source recommends for roughing a pitch; finishing passes are always radial."""
    if not pitch > 0:
        raise ValueError(f"the pitch must be greater than 0, got {pitch:g}")
    return ("radial",) if pitch <= RADIAL_UP_TO else ("flank", "alternate")


def passes_for(pitch: float) -> int:
    """The usual number of passes for a metric thread of a pitch, mm: a general figure, for the table of the manual is empty.

    A pitch that is not listed is a ValueError.

    >>> mnc.schemes.threads.passes_for(1.5)
    6
    """
    if pitch not in USUAL_PASSES:
        raise ValueError(f"the table lists pitches {', '.join(f'{p:g}' for p in USUAL_PASSES)} mm, got {pitch:g}")
    return USUAL_PASSES[pitch]


def thread(
    start: float, end: float, radius: float, depths: Sequence[float], method: str = "radial", profile: float = 60.0,
    *, taper: float = 0.0, out: float = 1.0,
) -> Plan:  # fmt: skip
    """Passes of an external thread from z `start` to `end`; `radius` is that of its crests at the end, mm.

    `taper` is how much the radius grows from start to end; `out` is how far outside the tool goes back. All passes have one
    length: the last is not shifted, so that the thread ends in its nominal place.
    """
    if end == start:
        raise ValueError("a thread needs a length")
    forward = math.copysign(1.0, end - start)
    outside = radius + max(0.0, -taper) + out
    pen = Pen(start, outside)
    for depth, shift in zip(depths, shifts(depths, method, profile, nominal_last=True), strict=True):
        pen.number += 1
        places = start + forward * shift, end + forward * shift
        way = [(radius - depth - taper * (end - place) / (end - start), place) for place in places]
        pen.follow(thread_pass("pass", way, outside, 1.0), THREAD)
        pen.rapid(places[0], outside)
    return pen.plan(f"thread, {method}")


def edge_shares(
    depths: Sequence[float], positions: Sequence[float], profile: float = 60.0
) -> tuple[tuple[float, float], ...]:
    """Areas, mm², that each pass cuts on the two sides of its tip: behind it and ahead of it along the feed.

    `positions` are those of `shifts`. From a fine grid over the gap: within a thousandth of the whole.
    """
    _check(depths)
    slope = math.tan(math.radians(profile) / 2)
    reach = depths[-1] * slope + max(map(abs, positions))
    x = np.linspace(-reach, reach, 8001)
    gone, found = np.zeros_like(x), []
    for depth, place in zip(depths, positions, strict=True):
        gap = np.maximum(depth - np.abs(x - place) / slope, 0.0)
        cut = np.maximum(gap - gone, 0.0) * (x[1] - x[0])
        found.append((float(cut[x < place].sum()), float(cut[x >= place].sum())))
        gone = np.maximum(gone, gap)
    return tuple(found)


def _check(depths: Sequence[float]) -> None:
    if not len(depths) or not depths[0] > 0 or any(b < a for a, b in zip(depths, depths[1:], strict=False)):
        got = ", ".join(f"{d:g}" for d in depths)
        raise ValueError(f"the depths of the passes must be positive and grow, got {got}")
