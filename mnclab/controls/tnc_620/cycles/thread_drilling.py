"""Threads from solid material (chapter 5.8 and 5.9): cycle 264 drills the hole first, 265 mills on its way down."""

from __future__ import annotations

from collections.abc import Iterator

from mnclab.controls.tnc_620.cycles import addresses
from mnclab.controls.tnc_620.cycles.addresses import choice, increment
from mnclab.controls.tnc_620.cycles.planes import AtSurface
from mnclab.controls.tnc_620.cycles.threads import Way, check, front, hand, inside, remark_on_the_end, thread
from mnclab.machine.cycle import CycleTable, too_many
from mnclab.machine.machine import Machine
from mnclab.machine.true_size import MILLS_THREADS
from mnclab.machining.depths import MOST, infeeds
from mnclab.machining.holes.drilling import drill
from mnclab.machining.steps import Go, Step

CYCLES = CycleTable()

ORDER: dict[float, str] = {0: "before thread milling", 1: "after thread milling"}


@CYCLES("CYCL DEF 264", "Thread drilling and milling", source="5.8")
class ThreadDrillingMilling(AtSurface):
    """Drills a hole in infeeds, countersinks it with the end of the tool, and mills a thread in it in one turn."""

    does = MILLS_THREADS

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

    def depths(self) -> dict[str, float]:
        return {name: getattr(self, name) for name in ("thread_depth", "total_hole_depth", "depth_at_front")}

    @property
    def way(self) -> Way:
        return Way(inside(self.milling_type))

    def check(self, m: Machine) -> Iterator[tuple[str, str]]:
        drills, mills = bool(self.total_hole_depth), bool(self.thread_depth or self.depth_at_front)
        yield from check(self, m, plunging_feed=drills, milling_feed=mills)
        if drills:
            if self.infeed == 0:
                yield "infeed", "must be greater than 0 to drill with, got 0"
            yield from too_many("infeed", self.levels)
            yield from too_many(
                "chip_breaking_depth", lambda: infeeds(0.0, self.total_hole_depth, self.chip_breaking_depth)
            )

    def levels(self) -> tuple[float, ...]:
        return infeeds(self.surface, self.surface + self.total_hole_depth, self.infeed)

    def moves(self, m: Machine) -> Iterator[Step]:
        yield from remark_on_the_end(self, m, "total_hole_depth")
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

    def depths(self) -> dict[str, float]:
        return {"thread_depth": self.thread_depth, "depth_at_front": self.depth_at_front}

    @property
    def way(self) -> Way:
        """One continuous helix, always downwards: the hand of the thread alone says which way round."""
        return Way(-hand(self), 1, either_way=True)

    def check(self, m: Machine) -> Iterator[tuple[str, str]]:
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
