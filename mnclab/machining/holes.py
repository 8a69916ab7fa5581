"""Holes drilled, bored on a helix, and tapped: steps of the cycles at a hole."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import NamedTuple

from mnclab.machining.depths import MOST, TooMany, infeeds
from mnclab.machining.steps import RAPID, Coolant, Go, Orient, Pause, Spin, Step, Thread, Turn, Wait

# Drilling, reaming and boring as steps at a hole; who calls them brings the tool to `above` before, and away after.
# Levels are coordinates along the tool axis, mm; `above` is the level over the hole from which a tool drills and to which
# it is withdrawn, so that a hole may also be drilled upwards.

#: Where a tool is shifted to before it leaves a bore: unit steps along the two axes of the plane.
DIRECTIONS = {1: (-1.0, 0.0), 2: (0.0, -1.0), 3: (1.0, 0.0), 4: (0.0, 1.0)}
DISENGAGED = 0.2  # mm, the shift after boring


class Guided(NamedTuple):
    """Levels at which a long drill begins to drill and clears its chips without leaving its guide."""

    start: float
    clear: float


def guided(surface: float, deepened: float, clearance: float, up: float = 1.0) -> Guided:
    """The levels for a hole that is there already down to `deepened` below the surface; 0: both over the surface.

    Drilling begins 0.2 of that depth above its end, chips are cleared 0.8 of it above, but never more than `clearance`
    (TNC 620, positioning behaviour with Q379). `up` is -1 where the hole is drilled upwards.

    >>> guided(0, 10, 20)
    Guided(start=-8.0, clear=-2.0)
    >>> guided(0, 0, 2)
    Guided(start=2.0, clear=2.0)
    """
    if not deepened:
        return Guided(surface + up * clearance, surface + up * clearance)
    start, clear = (surface - up * (deepened - min(part * deepened, clearance)) for part in (0.2, 0.8))
    return Guided(start, clear)


def drill(
    levels: Sequence[float], *, above: float, feed: float | None, reenter: float | Sequence[float],
    withdraw: float | None = RAPID, dwell_top: float = 0.0, dwell_each: float = 0.0, dwell_bottom: float = 0.0,
    breaks: int = 0, break_every: float = 0.0, back: float = 0.0, back_feed: float | None = None,
    approach: float | None = None, start: float | None = None,
) -> Iterator[Step]:  # fmt: skip
    """Drill to each of the `levels`; between two, break the chip or withdraw to `above` at the feed `withdraw`.

    A withdrawal waits `dwell_top` seconds and returns at rapid to `reenter` mm over the last depth: one distance, or
    one for each return (advanced stop distances). `breaks` chips are broken, by `back` mm at the feed `back_feed` (None:
    as a withdrawal), before each withdrawal; 0: every level is followed by one. `break_every` breaks a chip after that
    much within a level, with a return to the depth at the feed `approach`; the first level counts from `start`, which
    is `above` if nothing else is said. `dwell_each` acts at every level but the last, `dwell_bottom` there.
    """
    up, returns = math.copysign(1.0, above - levels[-1]), 0
    back_feed, start = withdraw if back_feed is None else back_feed, above if start is None else start
    for number, level in enumerate(levels, 1):
        peck = f"peck {number} of {len(levels)}" if len(levels) > 1 else "drill"
        first = levels[number - 2] if number > 1 else start
        for depth in infeeds(first, level, break_every)[:-1] if break_every else ():
            yield Go(peck, depth, feed)
            yield Go("break the chip", depth + up * back, back_feed)
            yield Go("break the chip", depth, approach)
        yield Go(peck, level, feed)
        if number == len(levels):
            break
        yield Wait("dwell", dwell_each)
        if number % (breaks + 1):
            yield Go("break the chip", level + up * back, back_feed)
            continue
        yield Go("clear the chips", above, withdraw)
        yield Wait("dwell at the top", dwell_top)
        stop = level + up * (reenter if isinstance(reenter, float | int) else reenter[returns])
        yield Go("return", min(stop, above) if up > 0 else max(stop, above))
        returns += 1
    yield Wait("dwell at the bottom", dwell_bottom)


def ream(
    bottom: float, *, above: float, feed: float | None, retract: float | None, dwell: float = 0.0, name: str = "ream"
) -> Iterator[Step]:
    """In at one feed, out at another."""
    yield Go(name, bottom, feed)
    yield Wait("dwell at the bottom", dwell)
    yield Go("retract", above, retract)


def bore(
    bottom: float, *, above: float, feed: float | None, retract: float | None, dwell: float = 0.0, angle: float = 0.0,
    direction: int = 0,
) -> Iterator[Step]:  # fmt: skip
    """Bore, stop the spindle at an angle, leave the wall in one of `DIRECTIONS` (0: none), retract; the tool ends shifted."""
    yield Go("bore", bottom, feed)
    yield Wait("dwell at the bottom", dwell)
    yield Orient(f"orient the spindle to {angle:g} degrees", angle)
    if direction:
        x, y = DIRECTIONS[direction]
        yield Go("leave the wall", x=DISENGAGED * x, y=DISENGAGED * y)
    yield Go("retract", above, retract)


def bore_and_stop(
    bottom: float, *, above: float, turning: int, dwell: float = 0.0, shift: tuple[float, float] | None = None,
    feed: float | None = None, by_hand: bool = False,
) -> Iterator[Step]:  # fmt: skip
    """Bore, stop the spindle, retract, spindle on; with a `shift` it stops oriented and the tool leaves the wall.

    `by_hand`: the program stops before it retracts.
    """
    yield Go("bore", bottom, feed)
    yield Wait("dwell at the bottom", dwell)
    if shift:
        yield Orient("orient the spindle to 0 degrees", 0.0)
        yield Go("leave the wall", x=shift[0], y=shift[1])
    else:
        yield Spin("stop the spindle", 0)
    if by_hand:
        yield Pause("out by hand")
    yield Go("retract", above)
    if shift:
        yield Go("back to the axis", x=0.0, y=0.0)
    yield Spin("spindle on", turning)


def back_bore(
    *, above: float, below: float, bottom: float, eccentricity: float, direction: int, angle: float,
    feed: float | None, travel: float | None, dwell: float, turning: int, coolant: bool = False, leave: bool = True,
) -> Iterator[Step]:  # fmt: skip
    """Counterbore from below: shifted through the hole, back to its axis, up to the `bottom` of the counterbore.

    Levels are those of the tip: `below` with the edge free under the workpiece. `travel` is the feed through the hole;
    `coolant` goes on and off with the spindle. With `leave` the tool goes down out of the counterbore before it is shifted.
    It ends at `above`, still shifted, the spindle stopped.
    """
    x, y = (eccentricity * step for step in DIRECTIONS[direction])
    oriented = Orient(f"orient the spindle to {angle:g} degrees", angle)
    yield oriented
    yield Go("shift off the axis", x=x, y=y)
    yield Go("through the hole", below, travel)
    yield Go("back to the axis", x=0.0, y=0.0)
    yield Spin("spindle on", turning)
    if coolant:
        yield Coolant("coolant on", True)
    yield Go("counterbore", bottom, feed)
    yield Wait("dwell at the bottom", dwell)
    if leave:
        yield Go("leave the counterbore", below, travel)
    yield oriented
    if coolant:
        yield Coolant("coolant off", False)
    yield Go("shift off the axis", x=x, y=y)
    yield Go("retract", above, travel)


def back_to_axis(level: float, turning: int, name: str = "retract") -> Iterator[Step]:
    """Out of a bore with a shifted tool: first up to a level, then to the axis, then the spindle as it turned before."""
    yield Go(name, level)
    yield Go("back to the axis", x=0.0, y=0.0)
    yield Spin("spindle as before", turning)


def gun_drill(
    levels: Sequence[float], *, above: float, start: float, feed: float | None, approach: float | None,
    retract: float | None, entry: tuple[int, float | None], speed: float | None, dwell: float = 0.0,
    pause: float | None = None, feed_after: float | None = None,
    coolant: tuple[str, str] = ("coolant on", "coolant off"), cool_until_slow: bool = False,
) -> Iterator[Step]:  # fmt: skip
    """Single-lip drilling: in and out with the spindle as `entry` (turning, speed), drilling at `speed` with coolant.

    Drilling begins at `start`, reached at the feed `approach`; at each of the `levels`, and at the level `pause`,
    the tool dwells. From `pause` on it drills at `feed_after`, if that is given. `coolant`: what its two switchings are
    called, "" for none; it is off before the spindle takes the speed of the exit, or after it (`cool_until_slow`).
    """
    on, off = [Coolant(coolant[0], True)][: bool(coolant[0])], [Coolant(coolant[1], False)][: bool(coolant[1])]
    yield Spin("spindle for the entry", *entry)
    yield Go("to the start of the drilling", start, approach)
    yield Spin("spindle for the drilling", 1, speed)
    yield from on
    last = start
    for number, level in enumerate(levels, 1):
        name = f"peck {number} of {len(levels)}" if len(levels) > 1 else "drill"
        paused = pause is not None and pause != last and (last - pause) * (pause - level) >= 0
        if paused and pause != level:
            yield Go(name, pause, feed)
            yield Wait("dwell on the way", dwell)
            feed = feed if feed_after is None else feed_after
        yield Go(name, level, feed)
        yield Wait("dwell at the bottom" if number == len(levels) else "dwell", dwell)
        if paused and feed_after is not None:
            feed = feed_after
        last = level
    slow = Spin("spindle for the exit", *entry)
    leaving: list[Step] = [slow, *off] if cool_until_slow else [*off, slow]
    yield from leaving
    yield Go("retract", above, retract)


# Milling round the axis of a hole in true helices: bores and threads.
# Angle 0 is the first axis of the plane; `sense` is +1 counter-clockwise, -1 clockwise, seen from the tool.

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


# Tapping as steps at a hole: spindle and feed locked, or a floating holder; a reversal at each end of the thread.
# `sense` is +1 where the spindle cuts clockwise (M3, a right-hand thread), -1 counter-clockwise.

def tap(
    levels: Sequence[float], *, above: float, sense: int, end: int, pitch: float = 0.0, feed: float | None = None,
    speed: float | None = None, out_speed: float | None = None, dwell: float = 0.0, dwell_first: bool = True,
    stand: float = 0.0, back: float = 0.0, angle: float | None = None,
) -> Iterator[Step]:  # fmt: skip
    """Cut to each of the `levels` and back: between two by `back` mm, or with 0 out of the hole to `above`.

    Without a `pitch` the holder floats and the axis runs at `feed`. `end` is what the spindle does afterwards:
    `sense` again, or 0. At the last level the spindle stands still for `stand` seconds, and `dwell` acts before the
    reversal or after it. `out_speed` is the spindle speed on the way out, `angle` where it is oriented before.
    """

    def travel(label: str, level: float) -> Step:
        return Thread(label, level, pitch) if pitch else Go(label, level, feed)

    if angle is not None:
        yield Orient(f"orient the spindle to {angle:g} degrees", angle)
    up = 1.0 if above > levels[-1] else -1.0
    for number, level in enumerate(levels, 1):
        last = number == len(levels)
        cut = "cut the thread" if len(levels) == 1 else f"cut the thread {number} of {len(levels)}"
        yield Spin("spindle on", sense, speed)
        yield travel(cut, level)
        if last and dwell_first:
            yield Wait("dwell at the bottom", dwell)
        if last and stand:
            yield Spin("stop the spindle", 0)
            yield Wait("wait for the spindle", stand)
        yield Spin("reverse the spindle", -sense, speed if out_speed is None else out_speed)
        if last and not dwell_first:
            yield Wait("dwell at the bottom", dwell)
        out = last or not back or back >= abs(above - level)
        yield travel("retract" if out else "break the chip", above if out else level + up * back)
    yield Spin("reverse the spindle" if end else "stop the spindle", end, speed)
