"""Thread milling (chapter 5.5 to 5.10): what its cycles share, and 262, 263 and 267. 264 and 265 begin in solid material.

The geometry is that of `machining.holes.thread_milling`. Readings where the manual is silent: feeds of the thread,
that of the approach among them, are those of the cutting edge; a depth of 0 leaves its step out, and a cycle whose depths
are all 0 is refused where it has several; 262 is not executed, as its manual says.
"""

from __future__ import annotations

import math
from abc import abstractmethod
from collections.abc import Iterator
from typing import ClassVar

from mnclab.controls.tnc_620.cycles import addresses, thread_parameters
from mnclab.controls.tnc_620.cycles.planes import AtSurface
from mnclab.machine.cycle import CycleTable, too_many
from mnclab.machine.machine import Machine
from mnclab.machine.true_size import MILLS_THREADS
from mnclab.machining.holes.thread_milling import Path, centre_feed, chamfer, countersink, helices, mill_thread, path_of
from mnclab.machining.steps import RAPID, Go, Step
from mnclab.running.performing import perform

CYCLES = CycleTable()

CORE = 5 / 8 * math.sqrt(3)  # pitches by which the core of an ISO metric nut is narrower than its nominal diameter


class ThreadMilling(AtSurface):
    """What the cycles share; an inner thread, milled by a tool that turns right.

    `rotation` is +1 where the tool goes round counter-clockwise, and its product with the hand of the thread the way
    along the axis (the table of 5.5).
    """

    nominal_diameter: float
    pitch: float
    thread_depth: float
    prepositioning_feed: float | str
    milling_type: float
    milling_feed: float

    does: ClassVar[str] = MILLS_THREADS
    external: ClassVar[bool] = False
    either_way: ClassVar[bool] = False
    """Whether the tool may turn left too."""

    # --- what it is ----------------------------------------------------------------------------------------------------

    @property
    def lead(self) -> float:
        """The pitch without its sign."""
        return abs(self.pitch)

    @property
    def hand(self) -> int:
        """+1 for a right-hand thread, -1 for a left-hand one."""
        return 1 if self.pitch > 0 else -1

    @property
    def rotation(self) -> int:
        """Of the tool centre: climb milling runs counter-clockwise inside a thread, clockwise outside."""
        return (-1 if self.milling_type < 0 else 1) * (-1 if self.external else 1)

    @property
    def positioning(self) -> float:
        """Q253, mm/min."""
        return RAPID if isinstance(self.prepositioning_feed, str) else self.prepositioning_feed

    def path(self, m: Machine) -> Path:
        """Where the tool centre runs."""
        return path_of(self.nominal_diameter, m.radius, self.lead, self.external)

    def a_step(self) -> int:
        """Threads per step of `helices`."""
        return 0

    def passes(self) -> list[tuple[float, float]]:
        """Start and end levels of the helices; a thread upwards is one downwards turned over at its end."""
        bottom, upwards = self.surface + self.thread_depth, self.hand * self.rotation > 0
        if self.thread_depth < 0:
            return helices(-self.thread_depth, self.lead, bottom, upwards, self.a_step())
        found = helices(self.thread_depth, self.lead, 0.0, not upwards, self.a_step())
        return [(bottom - begin, bottom - end) for begin, end in found]

    # --- what it needs -------------------------------------------------------------------------------------------------

    def used_feeds(self) -> Iterator[str]:
        """Names of the feeds that the cycle runs at with these depths."""
        yield "prepositioning_feed"
        if self.thread_depth:
            yield "milling_feed"

    def check(self, m: Machine) -> Iterator[tuple[str, str]]:
        """Spindle, tool, pitch, signs, feeds, and room for the tool."""
        if not any(self.depths().values()):
            every = " and ".join(self._address(name) for name in self.depths())
            yield next(iter(self.depths())), f"leaves nothing to do: {every} are 0"
        if self.either_way and not m.turning:
            yield "", "needs a turning spindle: write M3 or M4 before"
        if not self.either_way and m.turning != 1:
            yield "", "needs a tool that turns right: write M3 before"
        if m.radius <= 0:
            yield "", f"needs a tool with a radius, got {m.radius:g}"
        if self.pitch == 0:
            yield "pitch", "must not be 0"
        if self.nominal_diameter == 0:
            yield "nominal_diameter", "must be greater than 0, got 0"
        yield from self.signs(m)
        for name in self.used_feeds():
            if getattr(self, name) == 0:
                yield name, "must be greater than 0, got 0"
        if self.thread_depth and not self.external and 2 * m.radius >= self.nominal_diameter:
            yield "nominal_diameter", f"must be greater than the tool, {2 * m.radius:g}, got {self.nominal_diameter:g}"
        if self.thread_depth:
            yield from too_many("pitch", self.passes)

    def _address(self, name: str) -> str:
        return next(p.address for p in self.parameters() if p.name == name)

    def remark_on_the_end(self, m: Machine, name: str) -> None:
        """The thread ends a third of a pitch above the end of the hole or of the countersink, or there is a warning."""
        depth = abs(getattr(self, name))
        if self.thread_depth and depth and abs(self.thread_depth) > depth - self.lead / 3 + 1e-9:
            least = f"at least a third of the pitch less deep than {self._address(name)} = {getattr(self, name):g}"
            word = m.cycle.words.get("thread_depth") if m.cycle else None
            m.warn(f"{self.code} Q201 (thread depth) should be {least}, got {self.thread_depth:g}", word)

    # --- what it does --------------------------------------------------------------------------------------------------

    def thread(self, m: Machine) -> Iterator[Step]:
        """Every helix with its approach and departure; nothing without a depth."""
        if self.thread_depth:
            slow = getattr(self, "approach_feed", 0.0) or self.milling_feed  # cycle 265 has no Q512
            feed, approach = (
                centre_feed(edge, self.nominal_diameter, m.radius, self.external) for edge in (self.milling_feed, slow)
            )
            yield from mill_thread(
                self.path(m), self.passes(), pitch=self.lead, sense=self.rotation, feed=feed, approach_feed=approach,
                position_feed=self.positioning, external=self.external,
            )  # fmt: skip

    def front(self, m: Machine, depth: float, offset: float, feed: float, plunge: float) -> Iterator[Step]:
        """Countersink with the end of the tool: down at `plunge`, a circle of radius `offset`; nothing without a depth."""
        if depth:
            yield Go("to the depth at front", self.surface + depth, plunge)
            yield from countersink(self.path(m), offset, sense=self.rotation, feed=feed, external=self.external)

    @abstractmethod
    def steps(self, m: Machine) -> Iterator[Step]:
        """Between the set-up plane and the end plane."""

    def moves(self, m: Machine) -> None:
        """Set-up plane, the steps of the cycle, end plane."""
        steps = [Go("to the set-up clearance", self.above), *self.steps(m), *self.leave()]
        perform(m, self.code, steps)


@CYCLES("CYCL DEF 262", "Thread milling", runs="call", source="5.6")
class InnerThreadMilling(ThreadMilling):
    """Mills a thread in a hole: one turn, a continuous helix, or several single turns."""

    nominal_diameter: float = thread_parameters.nominal_diameter()
    pitch: float = thread_parameters.pitch()
    thread_depth: float = thread_parameters.thread_depth(example=-20)
    threads_per_step: float = thread_parameters.threads_per_step()
    prepositioning_feed: float | str = thread_parameters.prepositioning_feed()
    milling_type: float = addresses.climb(example=1)
    clearance: float = addresses.clearance(example=2)
    surface: float = addresses.surface(example=0)
    second_clearance: float = addresses.second_clearance(example=50)
    milling_feed: float = thread_parameters.milling_feed()
    approach_feed: float = thread_parameters.approach_feed()

    def depths(self) -> dict[str, float]:
        """One."""
        return {"thread_depth": self.thread_depth}

    def a_step(self) -> int:
        """Q355."""
        return int(self.threads_per_step)

    def check(self, m: Machine) -> Iterator[tuple[str, str]]:
        """Nothing where the depth is 0, for then nothing is done."""
        if self.thread_depth:
            yield from super().check(m)

    def steps(self, m: Machine) -> Iterator[Step]:
        """The thread alone."""
        return self.thread(m)

    def moves(self, m: Machine) -> None:
        """Not executed with a depth of 0."""
        if self.executed(m):
            super().moves(m)


@CYCLES("CYCL DEF 263", "Thread milling with countersinking", runs="call", source="5.7")
class ThreadMillingCountersinking(ThreadMilling):
    """Countersinks a hole with the side of the tool or with its end, and mills a thread in it in one turn."""

    nominal_diameter: float = thread_parameters.nominal_diameter()
    pitch: float = thread_parameters.pitch()
    thread_depth: float = thread_parameters.thread_depth(example=-16)
    countersinking_depth: float = addresses.coordinate(
        "Q356", "countersinking depth", incremental=True, note="of the tool tip; 0: none", example=-20
    )
    prepositioning_feed: float | str = thread_parameters.prepositioning_feed()
    milling_type: float = addresses.climb(example=1)
    clearance: float = addresses.clearance(example=2)
    side_clearance: float = addresses.length(
        "Q357", "set-up clearance at the side", incremental=True, note="from the tooth to the wall", example=0.2
    )
    depth_at_front: float = thread_parameters.front_depth()
    offset_at_front: float = thread_parameters.front_offset()
    surface: float = addresses.surface(example=0)
    second_clearance: float = addresses.second_clearance(example=50)
    countersinking_feed: float = thread_parameters.countersinking_feed()
    milling_feed: float = thread_parameters.milling_feed()
    approach_feed: float = thread_parameters.approach_feed()

    def depths(self) -> dict[str, float]:
        """Thread, countersink, front."""
        names = ("thread_depth", "countersinking_depth", "depth_at_front")
        return {name: getattr(self, name) for name in names}

    def used_feeds(self) -> Iterator[str]:
        """The feed of countersinking too."""
        yield from super().used_feeds()
        if self.countersinking_depth or self.depth_at_front:
            yield "countersinking_feed"

    def steps(self, m: Machine) -> Iterator[Step]:
        """Countersink, countersink at front, thread."""
        self.remark_on_the_end(m, "countersinking_depth")
        feed = self.countersinking_feed
        if self.countersinking_depth:
            level = self.surface + self.countersinking_depth
            if self.side_clearance:
                yield Go("to the countersinking depth", level, self.positioning)
            else:
                yield Go("above the countersinking depth", level + self.down * self.clearance, self.positioning)
                yield Go("to the countersinking depth", level, feed)
            radius = (self.nominal_diameter - CORE * self.lead) / 2 - m.radius - self.side_clearance
            yield from chamfer(
                radius, self.lead, sense=self.rotation, feed=feed, position_feed=self.positioning
            )  # fmt: skip
        yield from self.front(m, self.depth_at_front, self.offset_at_front, feed, self.positioning)
        yield from self.thread(m)


@CYCLES("CYCL DEF 267", "Outside thread milling", runs="call", source="5.10")
class OutsideThreadMilling(ThreadMilling):
    """Countersinks the end of a stud and mills a thread on it; the tool ends beside the stud, on the first axis."""

    nominal_diameter: float = thread_parameters.nominal_diameter()
    pitch: float = thread_parameters.pitch()
    thread_depth: float = thread_parameters.thread_depth(example=-20)
    threads_per_step: float = thread_parameters.threads_per_step()
    prepositioning_feed: float | str = thread_parameters.prepositioning_feed()
    milling_type: float = addresses.climb(example=1)
    clearance: float = addresses.clearance(example=2)
    depth_at_front: float = thread_parameters.front_depth()
    offset_at_front: float = thread_parameters.front_offset("offset at front from the stud centre")
    surface: float = addresses.surface(example=0)
    second_clearance: float = addresses.second_clearance(example=50)
    countersinking_feed: float = thread_parameters.countersinking_feed()
    milling_feed: float = thread_parameters.milling_feed()
    approach_feed: float = thread_parameters.approach_feed()

    external: ClassVar[bool] = True

    def depths(self) -> dict[str, float]:
        """Thread, front."""
        return {"thread_depth": self.thread_depth, "depth_at_front": self.depth_at_front}

    def a_step(self) -> int:
        """Q355."""
        return int(self.threads_per_step)

    def used_feeds(self) -> Iterator[str]:
        """The feed of countersinking too."""
        yield from super().used_feeds()
        if self.depth_at_front:
            yield "countersinking_feed"

    def check(self, m: Machine) -> Iterator[tuple[str, str]]:
        """The tool does not plunge into the stud."""
        yield from super().check(m)
        if self.depth_at_front and self.offset_at_front == 0:
            yield "offset_at_front", "must be greater than 0 with Q358: the tool would go into the stud"

    def steps(self, m: Machine) -> Iterator[Step]:
        """Beside the stud at rapid; countersink at front, thread."""
        yield Go("to the start point beside the stud", x=self.path(m).start, y=0.0)
        yield from self.front(m, self.depth_at_front, self.offset_at_front, self.countersinking_feed, self.positioning)
        yield from self.thread(m)
