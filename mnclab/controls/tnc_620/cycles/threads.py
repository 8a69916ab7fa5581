"""Thread milling (chapter 5.5 to 5.10): cycles 262, 263 and 267; 264 and 265, which begin in solid material.

The geometry is that of `tnc_620.machining.thread_milling`. Readings where the manual is silent: feeds of the thread,
that of the approach among them, are those of the cutting edge; a depth of 0 leaves its step out, and a cycle whose depths
are all 0 is refused where it has several; 262 is not executed, as its manual says.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from functools import partial
from typing import NamedTuple

from mnclab.controls.tnc_620.cycles import addresses
from mnclab.controls.tnc_620.cycles.addresses import choice, increment
from mnclab.controls.tnc_620.cycles.planes import AtSurface, Fault, not_zero, rate, with_radius
from mnclab.controls.tnc_620.machining.thread_milling import (
    Path,
    centre_feed,
    chamfer,
    countersink,
    helices,
    mill_thread,
    path_of,
)
from mnclab.machine.coordinates import MILLS_THREADS
from mnclab.machine.cycle import CycleTable, too_many
from mnclab.machine.machine import Machine
from mnclab.machining.depths import MOST, infeeds
from mnclab.machining.holes import drill
from mnclab.machining.steps import Go, Say, Step

CYCLES = CycleTable()
ORDER: dict[float, str] = {0: "before thread milling", 1: "after thread milling"}
CORE = 5 / 8 * math.sqrt(3)  # pitches by which the core of an ISO metric nut is narrower than its nominal diameter


class Way(NamedTuple):
    """How a thread is milled: `rotation` is +1 where the tool centre goes round counter-clockwise, and its product with the
    hand of the thread the way along the axis (the table of 5.5).

    `a_step` is the number of threads per step of `helices`; `either_way`: the tool may turn left, too.
    """

    rotation: int
    a_step: int = 0
    external: bool = False
    either_way: bool = False


@CYCLES("CYCL DEF 262", "Thread milling", source="5.6")
class InnerThreadMilling(AtSurface):
    """Mills a thread in a hole: one turn, a continuous helix, or several single turns."""

    does = MILLS_THREADS
    works = ("thread_depth",)
    nominal_diameter: float = addresses.nominal_diameter()
    pitch: float = addresses.pitch()
    thread_depth: float = addresses.thread_depth(example=-20)
    threads_per_step: float = addresses.threads_per_step()
    prepositioning_feed: float | str = addresses.positioning_feed()
    milling_type: float = addresses.climb()
    clearance: float = addresses.clearance()
    surface: float = addresses.surface()
    second_clearance: float = addresses.second_clearance(example=50)
    milling_feed: float = addresses.edge_feed()
    approach_feed: float = addresses.approach_feed()

    def check(self, m: Machine) -> Iterator[Fault]:
        if self.thread_depth:
            yield from check(self, m, milling_feed=True)

    def moves(self, m: Machine) -> Iterator[Step]:
        if not self.down:
            yield self.left_out
            return
        yield Go("to the set-up clearance", self.above)
        yield from thread(self, m)
        yield from self.leave()


@CYCLES("CYCL DEF 263", "Thread milling with countersinking", source="5.7")
class ThreadMillingCountersinking(AtSurface):
    """Countersinks a hole with the side of the tool or with its end, and mills a thread in it in one turn."""

    does = MILLS_THREADS
    works = ("thread_depth", "countersinking_depth", "depth_at_front")
    nominal_diameter: float = addresses.nominal_diameter()
    pitch: float = addresses.pitch()
    thread_depth: float = addresses.thread_depth(example=-16)
    countersinking_depth: float = increment("Q356", "countersinking depth", note="of the tool tip; 0: none", example=-20)
    prepositioning_feed: float | str = addresses.positioning_feed()
    milling_type: float = addresses.climb()
    clearance: float = addresses.clearance()
    side_clearance: float = addresses.side_clearance(
        meaning="set-up clearance at the side", note="from the tooth to the wall", example=0.2
    )
    depth_at_front: float = addresses.front_depth()
    offset_at_front: float = addresses.front_offset()
    surface: float = addresses.surface()
    second_clearance: float = addresses.second_clearance(example=50)
    countersinking_feed: float = addresses.countersinking_feed()
    milling_feed: float = addresses.edge_feed()
    approach_feed: float = addresses.approach_feed()

    def check(self, m: Machine) -> Iterator[Fault]:
        sinks = bool(self.countersinking_depth or self.depth_at_front)
        return check(self, m, milling_feed=bool(self.thread_depth), countersinking_feed=sinks)

    def moves(self, m: Machine) -> Iterator[Step]:
        yield from remark_on_the_end(self, m, self.countersinking_depth)
        yield Go("to the set-up clearance", self.above)
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
            yield from chamfer(radius, lead, sense=way(self).rotation, feed=feed, position_feed=position)
        yield from front(self, m, feed)
        yield from thread(self, m)
        yield from self.leave()


@CYCLES("CYCL DEF 267", "Outside thread milling", source="5.10")
class OutsideThreadMilling(AtSurface):
    """Countersinks the end of a stud and mills a thread on it; the tool ends beside the stud, on the first axis."""

    does = MILLS_THREADS
    works = ("thread_depth", "depth_at_front")
    nominal_diameter: float = addresses.nominal_diameter()
    pitch: float = addresses.pitch()
    thread_depth: float = addresses.thread_depth(example=-20)
    threads_per_step: float = addresses.threads_per_step()
    prepositioning_feed: float | str = addresses.positioning_feed()
    milling_type: float = addresses.climb()
    clearance: float = addresses.clearance()
    depth_at_front: float = addresses.front_depth()
    offset_at_front: float = addresses.front_offset(meaning="offset at front from the stud centre")
    surface: float = addresses.surface()
    second_clearance: float = addresses.second_clearance(example=50)
    countersinking_feed: float = addresses.countersinking_feed()
    milling_feed: float = addresses.edge_feed()
    approach_feed: float = addresses.approach_feed()

    def check(self, m: Machine) -> Iterator[Fault]:
        sinks = bool(self.depth_at_front)
        yield from check(self, m, milling_feed=bool(self.thread_depth), countersinking_feed=sinks)
        if sinks and self.offset_at_front == 0:
            yield "offset_at_front", "must be greater than 0 with Q358: the tool would go into the stud"

    def moves(self, m: Machine) -> Iterator[Step]:
        yield Go("to the set-up clearance", self.above)
        yield Go("to the start point beside the stud", x=path(self, m).start, y=0.0)
        yield from front(self, m, self.countersinking_feed)
        yield from thread(self, m)
        yield from self.leave()


@CYCLES("CYCL DEF 264", "Thread drilling and milling", source="5.8")
class ThreadDrillingMilling(AtSurface):
    """Drills a hole in infeeds, countersinks it with the end of the tool, and mills a thread in it in one turn."""

    does = MILLS_THREADS
    works = ("thread_depth", "total_hole_depth", "depth_at_front")
    nominal_diameter: float = addresses.nominal_diameter()
    pitch: float = addresses.pitch()
    thread_depth: float = addresses.thread_depth(example=-16)
    total_hole_depth: float = increment("Q356", "total hole depth", note="0: no drilling", example=-20)
    prepositioning_feed: float | str = addresses.positioning_feed()
    milling_type: float = addresses.climb()
    infeed: float = addresses.infeed(note="the whole depth at once where it is as great", example=5)
    upper_advanced_stop_distance: float = addresses.first_stop(note="above the last depth", example=0.2)
    chip_breaking_depth: float = addresses.break_every(note="0: out of the hole")
    chip_breaking_retract: float = addresses.break_retract(meaning="retraction for chip breaking")
    depth_at_front: float = addresses.front_depth()
    offset_at_front: float = addresses.front_offset()
    clearance: float = addresses.clearance()
    surface: float = addresses.surface()
    second_clearance: float = addresses.second_clearance(example=50)
    plunging_feed: float = addresses.plunge_feed(example=150)
    milling_feed: float = addresses.edge_feed()
    approach_feed: float = addresses.approach_feed()

    def check(self, m: Machine) -> Iterator[Fault]:
        drills, mills = bool(self.total_hole_depth), bool(self.thread_depth or self.depth_at_front)
        yield from check(self, m, plunging_feed=drills, milling_feed=mills)
        if drills:
            breaks = partial(infeeds, 0.0, self.total_hole_depth, self.chip_breaking_depth)
            yield from not_zero(self, "infeed", purpose="to drill with")
            yield from too_many("infeed", self.levels)
            yield from too_many("chip_breaking_depth", breaks)

    def levels(self) -> tuple[float, ...]:
        return infeeds(self.surface, self.surface + self.total_hole_depth, self.infeed)

    def moves(self, m: Machine) -> Iterator[Step]:
        yield from remark_on_the_end(self, m, self.total_hole_depth)
        yield Go("to the set-up clearance", self.above)
        if self.total_hole_depth:
            every = self.chip_breaking_depth
            yield from drill(
                self.levels(), above=self.above, feed=self.plunging_feed, reenter=self.upper_advanced_stop_distance,
                breaks=MOST if every else 0, break_every=every, back=self.chip_breaking_retract, approach=self.plunging_feed,
                start=self.surface,
            )  # fmt: skip
        yield from front(self, m, self.milling_feed)
        yield from thread(self, m)
        yield from self.leave()


@CYCLES("CYCL DEF 265", "Helical thread drilling and milling", source="5.9")
class HelicalThreadMilling(AtSurface):
    """Mills a thread into solid material in one continuous helix downwards; a countersink before it or after it."""

    does = MILLS_THREADS
    works = ("thread_depth", "depth_at_front")
    nominal_diameter: float = addresses.nominal_diameter()
    pitch: float = addresses.pitch()
    thread_depth: float = addresses.thread_depth(example=-16)
    prepositioning_feed: float | str = addresses.positioning_feed()
    depth_at_front: float = addresses.front_depth()
    offset_at_front: float = addresses.front_offset()
    countersink_order: float = choice("Q360", "when the countersink is made", ORDER, example=0)
    clearance: float = addresses.clearance()
    surface: float = addresses.surface()
    second_clearance: float = addresses.second_clearance(example=50)
    countersinking_feed: float = addresses.countersinking_feed()
    milling_feed: float = addresses.edge_feed()

    def check(self, m: Machine) -> Iterator[Fault]:
        return check(self, m, milling_feed=bool(self.thread_depth), countersinking_feed=bool(self.depth_at_front))

    def moves(self, m: Machine) -> Iterator[Step]:
        """Before the thread the tool countersinks on its way down, after it on its way up."""
        feed = self.countersinking_feed
        yield Go("to the set-up clearance", self.above)
        if self.countersink_order == 0:
            yield from front(self, m, feed, feed)
        yield from thread(self, m)
        if self.countersink_order == 1:
            yield from front(self, m, feed)
        yield from self.leave()


Countersunk = ThreadMillingCountersinking | OutsideThreadMilling | ThreadDrillingMilling | HelicalThreadMilling
AnyThread = InnerThreadMilling | Countersunk

# --- what all share --------------------------------------------------------------------------------------------------


def way(c: AnyThread) -> Way:
    """Climb milling runs counter-clockwise inside a thread, clockwise outside.

    265 mills one continuous helix, always downwards: the hand of the thread alone says which way round.
    """
    if isinstance(c, HelicalThreadMilling):
        return Way(-hand(c), 1, either_way=True)
    inside = -1 if c.milling_type < 0 else 1
    if isinstance(c, OutsideThreadMilling):
        return Way(-inside, int(c.threads_per_step), external=True)
    return Way(inside, int(c.threads_per_step) if isinstance(c, InnerThreadMilling) else 0)


def hand(c: AnyThread) -> int:
    """+1 for a right-hand thread, -1 for a left-hand one."""
    return 1 if c.pitch > 0 else -1


def path(c: AnyThread, m: Machine) -> Path:
    """Where the tool centre runs."""
    return path_of(c.nominal_diameter, m.radius, abs(c.pitch), way(c).external)


def passes(c: AnyThread) -> list[tuple[float, float]]:
    """Start and end levels of the helices; a thread upwards is one downwards turned over at its end."""
    bottom, upwards, lead = c.surface + c.thread_depth, hand(c) * way(c).rotation > 0, abs(c.pitch)
    if c.thread_depth < 0:
        return helices(-c.thread_depth, lead, bottom, upwards, way(c).a_step)
    found = helices(c.thread_depth, lead, 0.0, not upwards, way(c).a_step)
    return [(bottom - begin, bottom - end) for begin, end in found]


def check(c: AnyThread, m: Machine, **feeds: bool) -> Iterator[Fault]:
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


def remark_on_the_end(c: AnyThread, m: Machine, end: float) -> Iterator[Say]:
    """The thread ends a third of a pitch above the end of the hole or of the countersink, or there is a warning."""
    if c.thread_depth and end and abs(c.thread_depth) > abs(end) - abs(c.pitch) / 3 + 1e-9:
        least = f"at least a third of the pitch less deep than Q356 = {end:g}"
        word = m.cycle.words.get("thread_depth") if m.cycle else None
        yield Say(f"Q201 (thread depth) should be {least}, got {c.thread_depth:g}", word=word)


def thread(c: AnyThread, m: Machine) -> Iterator[Step]:
    """Every helix with its approach and departure; nothing without a depth."""
    if c.thread_depth:
        slow = getattr(c, "approach_feed", 0.0) or c.milling_feed  # cycle 265 has no Q512
        of_centre = partial(centre_feed, nominal=c.nominal_diameter, tool_radius=m.radius, external=way(c).external)
        yield from mill_thread(
            path(c, m), passes(c), pitch=abs(c.pitch), sense=way(c).rotation, feed=of_centre(c.milling_feed),
            approach_feed=of_centre(slow), position_feed=rate(c.prepositioning_feed), external=way(c).external,
        )  # fmt: skip


def front(c: Countersunk, m: Machine, feed: float, plunge: float | None = None) -> Iterator[Step]:
    """Countersink with the end of the tool: down at `plunge`, Q253 if None, and round; nothing without a depth."""
    if c.depth_at_front:
        down = rate(c.prepositioning_feed) if plunge is None else plunge
        yield Go("to the depth at front", c.surface + c.depth_at_front, down)
        yield from countersink(path(c, m), c.offset_at_front, sense=way(c).rotation, feed=feed, external=way(c).external)
