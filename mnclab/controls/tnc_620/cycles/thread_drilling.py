"""Threads from solid material (chapter 5.8 and 5.9): cycle 264 drills the hole first, 265 mills on its way down."""

from __future__ import annotations

from collections.abc import Iterator
from typing import ClassVar

from mnclab.controls.tnc_620.cycles import addresses, thread_parameters
from mnclab.controls.tnc_620.cycles.threads import ThreadMilling
from mnclab.machine.cycle import CycleTable, too_many
from mnclab.machine.machine import Machine
from mnclab.machining.depths import MOST, infeeds
from mnclab.machining.holes.drilling import drill
from mnclab.machining.steps import Step

CYCLES = CycleTable()

ORDER: dict[float, str] = {0: "before thread milling", 1: "after thread milling"}


@CYCLES("CYCL DEF 264", "Thread drilling and milling", runs="call", source="5.8")
class ThreadDrillingMilling(ThreadMilling):
    """Drills a hole in infeeds, countersinks it with the end of the tool, and mills a thread in it in one turn."""

    nominal_diameter: float = thread_parameters.nominal_diameter()
    pitch: float = thread_parameters.pitch()
    thread_depth: float = thread_parameters.thread_depth(example=-16)
    total_hole_depth: float = addresses.coordinate(
        "Q356", "total hole depth", incremental=True, note="0: no drilling", example=-20
    )
    prepositioning_feed: float | str = thread_parameters.prepositioning_feed()
    milling_type: float = addresses.climb(example=1)
    infeed: float = addresses.infeed(note="the whole depth at once where it is as great", example=5)
    upper_advanced_stop_distance: float = addresses.length(
        "Q258", "upper advanced stop distance", incremental=True, note="above the last depth", example=0.2
    )
    chip_breaking_depth: float = addresses.length(
        "Q257", "infeed depth for chip breaking", incremental=True, note="0: out of the hole", example=5
    )
    chip_breaking_retract: float = addresses.length(
        "Q256", "retraction for chip breaking", incremental=True, at_most=99999.999, example=0.2
    )
    depth_at_front: float = thread_parameters.front_depth()
    offset_at_front: float = thread_parameters.front_offset()
    clearance: float = addresses.clearance(example=2)
    surface: float = addresses.surface(example=0)
    second_clearance: float = addresses.second_clearance(example=50)
    plunging_feed: float = addresses.plunge_feed(example=150)
    milling_feed: float = thread_parameters.milling_feed()
    approach_feed: float = thread_parameters.approach_feed()

    def depths(self) -> dict[str, float]:
        """Thread, hole, front."""
        return {name: getattr(self, name) for name in ("thread_depth", "total_hole_depth", "depth_at_front")}

    def used_feeds(self) -> Iterator[str]:
        """The feed of drilling; that of milling also countersinks."""
        yield "prepositioning_feed"
        if self.total_hole_depth:
            yield "plunging_feed"
        if self.thread_depth or self.depth_at_front:
            yield "milling_feed"

    def check(self, m: Machine) -> Iterator[tuple[str, str]]:
        """As all thread milling; and an infeed to drill with."""
        yield from super().check(m)
        if self.total_hole_depth:
            if self.infeed == 0:
                yield "infeed", "must be greater than 0 to drill with, got 0"
            yield from too_many("infeed", self.levels)
            yield from too_many(
                "chip_breaking_depth", lambda: infeeds(0.0, self.total_hole_depth, self.chip_breaking_depth)
            )

    def levels(self) -> tuple[float, ...]:
        """The plunging depths."""
        return infeeds(self.surface, self.surface + self.total_hole_depth, self.infeed)

    def steps(self, m: Machine) -> Iterator[Step]:
        """Hole, countersink at front at the milling feed, thread."""
        self.remark_on_the_end(m, "total_hole_depth")
        if self.total_hole_depth:
            every = self.chip_breaking_depth
            yield from drill(
                self.levels(), above=self.above, feed=self.plunging_feed, reenter=self.upper_advanced_stop_distance,
                breaks=MOST if every else 0, break_every=every, back=self.chip_breaking_retract, approach=self.plunging_feed,
                start=self.surface,
            )  # fmt: skip
        yield from self.front(m, self.depth_at_front, self.offset_at_front, self.milling_feed, self.positioning)
        yield from self.thread(m)


@CYCLES("CYCL DEF 265", "Helical thread drilling and milling", runs="call", source="5.9")
class HelicalThreadMilling(ThreadMilling):
    """Mills a thread into solid material in one continuous helix downwards; a countersink before it or after it."""

    nominal_diameter: float = thread_parameters.nominal_diameter()
    pitch: float = thread_parameters.pitch()
    thread_depth: float = thread_parameters.thread_depth(example=-16)
    prepositioning_feed: float | str = thread_parameters.prepositioning_feed()
    depth_at_front: float = thread_parameters.front_depth()
    offset_at_front: float = thread_parameters.front_offset()
    countersink_order: float = addresses.choice("Q360", "when the countersink is made", ORDER, example=0)
    clearance: float = addresses.clearance(example=2)
    surface: float = addresses.surface(example=0)
    second_clearance: float = addresses.second_clearance(example=50)
    countersinking_feed: float = thread_parameters.countersinking_feed()
    milling_feed: float = thread_parameters.milling_feed()

    either_way: ClassVar[bool] = True

    def depths(self) -> dict[str, float]:
        """Thread, front."""
        return {"thread_depth": self.thread_depth, "depth_at_front": self.depth_at_front}

    @property
    def rotation(self) -> int:
        """Always downwards: the hand of the thread alone says which way round."""
        return -self.hand

    def a_step(self) -> int:
        """One continuous helix."""
        return 1

    def used_feeds(self) -> Iterator[str]:
        """The feed of countersinking too."""
        yield from super().used_feeds()
        if self.depth_at_front:
            yield "countersinking_feed"

    def steps(self, m: Machine) -> Iterator[Step]:
        """Before the thread the tool countersinks on its way down, after it on its way up."""
        feed = self.countersinking_feed
        if self.countersink_order == 0:
            yield from self.front(m, self.depth_at_front, self.offset_at_front, feed, feed)
        yield from self.thread(m)
        if self.countersink_order == 1:
            yield from self.front(m, self.depth_at_front, self.offset_at_front, feed, self.positioning)
