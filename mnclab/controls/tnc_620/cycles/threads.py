"""Threads (chapter 5): tapping with 206, 207 and 209, milling with 262, 263 and 267, and in solid material with 264 and 265.

The geometry of milled threads is that of `tnc_620.machining.thread_milling`. Readings where the manual is silent: feeds of
the thread, that of the approach among them, are those of the cutting edge; a depth of 0 leaves its step out, and a cycle whose
depths are all 0 is refused where it has several; 262 is not executed, as its manual says.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence
from functools import partial
from typing import Any, NamedTuple

from mnclab.controls.tnc_620.cycles import addresses
from mnclab.controls.tnc_620.cycles.addresses import FAST, choice, increment, ratio
from mnclab.controls.tnc_620.cycles.planes import AtSurface, ParameterFault, not_zero, oriented, rate, with_radius
from mnclab.controls.tnc_620.machining import thread_milling
from mnclab.machine.coordinates import MILLS_THREADS, TAPS
from mnclab.machine.cycle import CycleTable, too_many
from mnclab.machine.machine import Machine
from mnclab.machining.depths import MOST, infeeds
from mnclab.machining.holes import drill, tap
from mnclab.machining.steps import Go, Say, Spin, Step, Write

CYCLES = CycleTable(addresses=addresses.shared(
    milling_feed=addresses.edge_feed, prepositioning_feed=addresses.positioning_feed,
    second_clearance=partial(addresses.second_clearance, example=50), thread_depth=partial(addresses.thread_depth, example=-20),
))  # fmt: skip


# Tapping: cycle 206 with a floating tap holder, 207 and 209 with the spindle locked to the feed.

RIGID = "clearance thread_depth pitch surface second_clearance"
ROUNDED = 0.001  # mm; pitches that differ by no more are the same, for F and S are entered rounded


def pitch_of(m: Machine, name: str, pitch: float) -> Iterator[ParameterFault]:
    """A fault where the tool table has another pitch for the tap."""
    if m.tool.pitch and abs(m.tool.pitch - pitch) > ROUNDED:
        yield name, f"means a pitch of {pitch:g} mm, the tap of tool {m.tool.number} has {m.tool.pitch:g} mm (PITCH)"


class Tapping(AtSurface):
    """What the three share: to the set-up plane, the thread, away; then the spindle turns as before the cycle."""

    does, works = TAPS, ("thread_depth",)
    thread_depth = pitch = 0.0

    def moves(self, m: Machine) -> Iterable[Step]:
        if not self.down:
            return [self.left_out]
        again = Spin("spindle on again", m.turning, m.speed)
        return [Go("to the set-up clearance", self.above), *self.steps(m), *self.leave(), again]


def rigid(c: Tapping, m: Machine) -> Iterator[ParameterFault]:
    """`check` of 207 and 209; nothing where the depth is 0, for then nothing is done."""
    if not c.thread_depth:
        return
    yield from c.signs(m)
    if c.pitch == 0:
        yield "pitch", "must not be 0"
    if not m.speed:
        yield "", "needs a spindle speed: write S in TOOL CALL"
    yield from oriented(m)
    yield from pitch_of(m, "pitch", abs(c.pitch))


def locked(c: Tapping, m: Machine, levels: Sequence[float], **more: Any) -> Iterator[Step]:
    """The spindle turns as M3 for a right-hand thread, as M4 for a left-hand one, and stops."""
    stand, lead = m.settings["thread_wait"], abs(c.pitch)
    return tap(levels, above=c.above, pitch=lead, sense=1 if c.pitch > 0 else -1, end=0, stand=stand, **more)


@CYCLES("CYCL DEF 206", "Tapping with a floating tap holder", source="5.2")
class FloatingTapping(Tapping):
    """Taps at a feed in one pass with the spindle as it turns, reversed at the bottom and again at the set-up clearance."""

    clearance: float = addresses.clearance(example=2, note="about four pitches")
    thread_depth: float = addresses.thread_depth(example=-20)
    tapping_feed: float = addresses.feed("Q206", "feed rate for tapping", also=("FAUTO",), note="S times pitch", example=150)
    dwell_bottom: float = addresses.dwell_bottom(note="0 to 0.5 s, so that the tap does not jam", example=0.25)
    surface: float = addresses.surface(example=0)
    second_clearance: float = addresses.second_clearance(example=50)

    def check(self, m: Machine) -> Iterator[ParameterFault]:
        """Nothing where the depth is 0, for then nothing is done."""
        if not self.thread_depth:
            return
        yield from self.signs(m)
        yield from not_zero(self, "tapping_feed")
        if not m.spindle_speed:
            yield "", "needs a turning spindle: write S in TOOL CALL, and M3 or M4 before"
        yield from pitch_of(m, "tapping_feed", self.tapping_feed / m.speed)

    def steps(self, m: Machine) -> Iterator[Step]:
        return tap(
            [self.surface + self.thread_depth], above=self.above, sense=m.turning, end=m.turning, feed=self.tapping_feed,
            dwell=self.dwell_bottom, dwell_first=False, stand=m.settings["thread_wait"],
        )  # fmt: skip


@CYCLES("CYCL DEF 207", "Rigid tapping", source="5.3", takes=RIGID)
class RigidTappingInOnePass(Tapping):
    """Taps in one pass with the spindle locked to the feed; afterwards it turns as before the cycle."""

    own_spindle = True
    check = rigid

    def steps(self, m: Machine) -> Iterator[Step]:
        return locked(self, m, [self.surface + self.thread_depth])


@CYCLES(
    "CYCL DEF 209", "Tapping with chip breaking", source="5.4",
    takes=f"{RIGID} chip_breaking_depth chip_breaking_retract_factor spindle_angle retract_rpm_factor",
)  # fmt: skip
class ChipBreakingTapping(Tapping):
    """Taps in several passes in phase, with the spindle locked to the feed and oriented before the first of them."""

    own_spindle = True
    chip_breaking_depth: float = addresses.break_every(note="0: in one pass")
    chip_breaking_retract_factor: float = ratio(
        "Q256", "retraction for chip breaking, in pitches", at_least=0, at_most=FAST, note="0: out of the hole", example=1
    )
    spindle_angle: float = addresses.spindle_angle(meaning="angle of the spindle before tapping", example=50)
    retract_rpm_factor: float = ratio("Q403", "factor of the speed for retracting", at_most=10, example=1.5)

    def check(self, m: Machine) -> Iterator[ParameterFault]:
        yield from rigid(self, m)
        if self.thread_depth:
            yield from too_many("chip_breaking_depth", self.passes)

    def passes(self) -> tuple[float, ...]:
        return infeeds(self.surface, self.surface + self.thread_depth, self.chip_breaking_depth or None)

    def steps(self, m: Machine) -> Iterator[Step]:
        yield Write("memory", self.spindle_angle, "orientation")
        back, out = self.chip_breaking_retract_factor * abs(self.pitch), self.retract_rpm_factor * m.speed
        yield from locked(
            self, m, self.passes(), speed=m.speed, out_speed=min(out, m.setup.limits.spindle), back=back, angle=self.spindle_angle
        )


# Thread milling: cycles 262 to 267.

ORDER: dict[float, str] = {0: "before thread milling", 1: "after thread milling"}
CORE = 5 / 8 * math.sqrt(3)  # pitches by which the core of an ISO metric nut is narrower than its nominal diameter


class ThreadSense(NamedTuple):
    """How a thread is milled: `rotation` is +1 where the tool centre goes round counter-clockwise, and its product with the
    hand of the thread the way along the axis (the table of 5.5).

    `a_step` is the number of threads per step of `helices`; `either_way`: the tool may turn left, too.
    """

    rotation: int
    a_step: int = 0
    external: bool = False
    either_way: bool = False


class ThreadMilling(AtSurface):
    """What they share; who inherits names the parameters."""

    does = MILLS_THREADS
    nominal_diameter = pitch = thread_depth = threads_per_step = milling_type = milling_feed = approach_feed = 0.0
    depth_at_front = offset_at_front = countersinking_feed = countersinking_depth = total_hole_depth = 0.0
    prepositioning_feed: Any = 0.0

    def moves(self, m: Machine) -> Iterator[Step]:
        """To the set-up clearance, what it does from there, and away."""
        if not self.down:  # of 262 alone, the others are refused
            yield self.left_out
            return
        yield from remark_on_the_end(self, m, self.countersinking_depth or self.total_hole_depth)
        yield Go("to the set-up clearance", self.above)
        yield from self.steps(m)
        yield from self.leave()


@CYCLES(
    "CYCL DEF 262", "Thread milling", source="5.6",
    takes="nominal_diameter pitch thread_depth threads_per_step prepositioning_feed milling_type clearance surface "
          "second_clearance milling_feed approach_feed",
)  # fmt: skip
class InnerThreadMilling(ThreadMilling):
    """Mills a thread in a hole: one turn, a continuous helix, or several single turns."""

    works = ("thread_depth",)

    def check(self, m: Machine) -> Iterator[ParameterFault]:
        if self.thread_depth:
            yield from check(self, m, milling_feed=True)

    def steps(self, m: Machine) -> Iterator[Step]:
        yield from thread(self, m)


@CYCLES(
    "CYCL DEF 263", "Thread milling with countersinking", source="5.7",
    takes="nominal_diameter pitch thread_depth countersinking_depth prepositioning_feed milling_type clearance side_clearance "
          "depth_at_front offset_at_front surface second_clearance countersinking_feed milling_feed approach_feed",
)  # fmt: skip
class ThreadMillingCountersinking(ThreadMilling):
    """Countersinks a hole with the side of the tool or with its end, and mills a thread in it in one turn."""

    works = ("thread_depth", "countersinking_depth", "depth_at_front")
    thread_depth: float = addresses.thread_depth(example=-16)
    countersinking_depth: float = increment("Q356", "countersinking depth", note="of the tool tip; 0: none", example=-20)
    side_clearance: float = addresses.side_clearance(
        meaning="set-up clearance at the side", note="from the tooth to the wall", example=0.2
    )

    def check(self, m: Machine) -> Iterator[ParameterFault]:
        sinks = bool(self.countersinking_depth or self.depth_at_front)
        return check(self, m, milling_feed=bool(self.thread_depth), countersinking_feed=sinks)

    def steps(self, m: Machine) -> Iterator[Step]:
        feed, position = self.countersinking_feed, rate(self.prepositioning_feed)
        if self.countersinking_depth:
            level = self.surface + self.countersinking_depth
            if self.side_clearance:
                yield Go("to the countersinking depth", level, position)
            else:
                yield Go("above the countersinking depth", level + self.down * self.clearance, position)
                yield Go("to the countersinking depth", level, feed)
            lead = abs(self.pitch)
            radius = (self.nominal_diameter - CORE * lead) / 2 - m.radius - self.side_clearance
            yield from thread_milling.chamfer(radius, lead, sense=way(self).rotation, feed=feed, position_feed=position)
        yield from front(self, m, feed)
        yield from thread(self, m)


@CYCLES(
    "CYCL DEF 267", "Outside thread milling", source="5.10",
    takes="nominal_diameter pitch thread_depth threads_per_step prepositioning_feed milling_type clearance depth_at_front "
          "offset_at_front surface second_clearance countersinking_feed milling_feed approach_feed",
)  # fmt: skip
class OutsideThreadMilling(ThreadMilling):
    """Countersinks the end of a stud and mills a thread on it; the tool ends beside the stud, on the first axis."""

    works = ("thread_depth", "depth_at_front")
    offset_at_front: float = addresses.offset_at_front(meaning="offset at front from the stud centre")

    def check(self, m: Machine) -> Iterator[ParameterFault]:
        sinks = bool(self.depth_at_front)
        yield from check(self, m, milling_feed=bool(self.thread_depth), countersinking_feed=sinks)
        if sinks and self.offset_at_front == 0:
            yield "offset_at_front", "must be greater than 0 with Q358: the tool would go into the stud"

    def steps(self, m: Machine) -> Iterator[Step]:
        yield Go("to the start point beside the stud", x=path(self, m).start, y=0.0)
        yield from front(self, m, self.countersinking_feed)
        yield from thread(self, m)


@CYCLES(
    "CYCL DEF 264", "Thread drilling and milling", source="5.8",
    takes="nominal_diameter pitch thread_depth total_hole_depth prepositioning_feed milling_type infeed "
          "upper_advanced_stop_distance chip_breaking_depth chip_breaking_retract depth_at_front offset_at_front clearance "
          "surface second_clearance plunging_feed milling_feed approach_feed",
)  # fmt: skip
class ThreadDrillingMilling(ThreadMilling):
    """Drills a hole in infeeds, countersinks it with the end of the tool, and mills a thread in it in one turn."""

    works = ("thread_depth", "total_hole_depth", "depth_at_front")
    thread_depth: float = addresses.thread_depth(example=-16)
    total_hole_depth: float = increment("Q356", "total hole depth", note="0: no drilling", example=-20)
    infeed: float = addresses.infeed(note="the whole depth at once where it is as great", example=5)
    upper_advanced_stop_distance: float = addresses.first_stop(note="above the last depth", example=0.2)
    chip_breaking_depth: float = addresses.break_every(note="0: out of the hole")
    chip_breaking_retract: float = addresses.break_retract(meaning="retraction for chip breaking")
    plunging_feed: float = addresses.plunge_feed(example=150)

    def check(self, m: Machine) -> Iterator[ParameterFault]:
        drills, mills = bool(self.total_hole_depth), bool(self.thread_depth or self.depth_at_front)
        yield from check(self, m, plunging_feed=drills, milling_feed=mills)
        if drills:
            breaks = partial(infeeds, 0.0, self.total_hole_depth, self.chip_breaking_depth)
            yield from not_zero(self, "infeed", purpose="to drill with")
            yield from too_many("infeed", self.levels)
            yield from too_many("chip_breaking_depth", breaks)

    def levels(self) -> tuple[float, ...]:
        return infeeds(self.surface, self.surface + self.total_hole_depth, self.infeed)

    def steps(self, m: Machine) -> Iterator[Step]:
        if self.total_hole_depth:
            every = self.chip_breaking_depth
            yield from drill(
                self.levels(), above=self.above, feed=self.plunging_feed, reenter=self.upper_advanced_stop_distance,
                breaks=MOST if every else 0, break_every=every, back=self.chip_breaking_retract, approach=self.plunging_feed,
                start=self.surface,
            )  # fmt: skip
        yield from front(self, m, self.milling_feed)
        yield from thread(self, m)


@CYCLES(
    "CYCL DEF 265", "Helical thread drilling and milling", source="5.9",
    takes="nominal_diameter pitch thread_depth prepositioning_feed depth_at_front offset_at_front countersink_order clearance "
          "surface second_clearance countersinking_feed milling_feed",
)  # fmt: skip
class HelicalThreadMilling(ThreadMilling):
    """Mills a thread into solid material in one continuous helix downwards; a countersink before it or after it."""

    works = ("thread_depth", "depth_at_front")
    thread_depth: float = addresses.thread_depth(example=-16)
    countersink_order: float = choice("Q360", "when the countersink is made", ORDER, example=0)

    def check(self, m: Machine) -> Iterator[ParameterFault]:
        return check(self, m, milling_feed=bool(self.thread_depth), countersinking_feed=bool(self.depth_at_front))

    def steps(self, m: Machine) -> Iterator[Step]:
        """Before the thread the tool countersinks on its way down, after it on its way up."""
        feed = self.countersinking_feed
        if self.countersink_order == 0:
            yield from front(self, m, feed, feed)
        yield from thread(self, m)
        if self.countersink_order == 1:
            yield from front(self, m, feed)


# --- what all share --------------------------------------------------------------------------------------------------


def way(c: ThreadMilling) -> ThreadSense:
    """Climb milling runs counter-clockwise inside a thread, clockwise outside.

    265 mills one continuous helix, always downwards: the hand of the thread alone says which way round.
    """
    if isinstance(c, HelicalThreadMilling):
        return ThreadSense(-hand(c), 1, either_way=True)
    inside = -1 if c.milling_type < 0 else 1
    if isinstance(c, OutsideThreadMilling):
        return ThreadSense(-inside, int(c.threads_per_step), external=True)
    return ThreadSense(inside, int(c.threads_per_step) if isinstance(c, InnerThreadMilling) else 0)


def hand(c: ThreadMilling) -> int:
    """+1 for a right-hand thread, -1 for a left-hand one."""
    return 1 if c.pitch > 0 else -1


def path(c: ThreadMilling, m: Machine) -> thread_milling.Path:
    """Where the tool centre runs."""
    return thread_milling.path_of(c.nominal_diameter, m.radius, abs(c.pitch), way(c).external)


def passes(c: ThreadMilling) -> list[tuple[float, float]]:
    """Start and end levels of the helices; a thread upwards is one downwards turned over at its end."""
    bottom, upwards, lead = c.surface + c.thread_depth, hand(c) * way(c).rotation > 0, abs(c.pitch)
    if c.thread_depth < 0:
        return thread_milling.helices(-c.thread_depth, lead, bottom, upwards, way(c).a_step)
    found = thread_milling.helices(c.thread_depth, lead, 0.0, not upwards, way(c).a_step)
    return [(bottom - begin, bottom - end) for begin, end in found]


def check(c: ThreadMilling, m: Machine, **feeds: bool) -> Iterator[ParameterFault]:
    """Spindle, tool, pitch, signs, room for the tool, and the `feeds` that the cycle runs at where something is not 0."""
    if not any(c.depths().values()):
        every = " and ".join(p.address for p in c.parameters() if p.name in c.works)
        yield c.works[0], f"leaves nothing to do: {every} are 0"
    if way(c).either_way and not m.turning:
        yield "", "needs a turning spindle: write M3 or M4 before"
    if not way(c).either_way and m.turning != 1:
        yield "", "needs a tool that turns right: write M3 before"
    yield from with_radius(m)
    if c.pitch == 0:
        yield "pitch", "must not be 0"
    yield from not_zero(c, "nominal_diameter")
    yield from c.signs(m)
    yield from not_zero(c, "prepositioning_feed", *(name for name, used in feeds.items() if used))
    if c.thread_depth and not way(c).external and 2 * m.radius >= c.nominal_diameter:
        yield "nominal_diameter", f"must be greater than the tool, {2 * m.radius:g}, got {c.nominal_diameter:g}"
    if c.thread_depth:
        yield from too_many("pitch", lambda: passes(c))


def remark_on_the_end(c: ThreadMilling, m: Machine, end: float) -> Iterator[Say]:
    """The thread ends a third of a pitch above the end of the hole or of the countersink, or there is a warning."""
    if c.thread_depth and end and abs(c.thread_depth) > abs(end) - abs(c.pitch) / 3 + 1e-9:
        least = f"at least a third of the pitch less deep than Q356 = {end:g}"
        word = m.cycle.words.get("thread_depth") if m.cycle else None
        yield Say(f"Q201 (thread depth) should be {least}, got {c.thread_depth:g}", word=word)


def thread(c: ThreadMilling, m: Machine) -> Iterator[Step]:
    """Every helix with its approach and departure; nothing without a depth."""
    if c.thread_depth:
        slow = c.approach_feed or c.milling_feed  # cycle 265 has no Q512
        of_centre = partial(
            thread_milling.centre_feed, nominal=c.nominal_diameter, tool_radius=m.radius, external=way(c).external
        )
        yield from thread_milling.mill_thread(
            path(c, m), passes(c), pitch=abs(c.pitch), sense=way(c).rotation, feed=of_centre(c.milling_feed),
            approach_feed=of_centre(slow), position_feed=rate(c.prepositioning_feed), external=way(c).external,
        )  # fmt: skip


def front(c: ThreadMilling, m: Machine, feed: float, plunge: float | None = None) -> Iterator[Step]:
    """Countersink with the end of the tool: down at `plunge`, Q253 if None, and round; nothing without a depth."""
    if c.depth_at_front:
        down = rate(c.prepositioning_feed) if plunge is None else plunge
        yield Go("to the depth at front", c.surface + c.depth_at_front, down)
        yield from thread_milling.countersink(
            path(c, m), c.offset_at_front, sense=way(c).rotation, feed=feed, external=way(c).external
        )
