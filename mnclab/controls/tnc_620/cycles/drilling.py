"""Centring, drilling and reaming (4.2 to 4.4, 4.6): cycles 240, 200, 201 and 203."""

from __future__ import annotations

import math
from collections.abc import Iterator

from mnclab.controls.tnc_620.cycles import addresses
from mnclab.controls.tnc_620.cycles.addresses import choice, coordinate, count
from mnclab.controls.tnc_620.cycles.faults import Fault, not_zero, with_angle
from mnclab.controls.tnc_620.cycles.planes import AtSurface, point_length, rate
from mnclab.machine.coordinates import is_round, tool
from mnclab.machine.cycle import CycleTable
from mnclab.machine.machine import Machine
from mnclab.machining.holes.drilling import drill, ream
from mnclab.machining.steps import Go, Say, Step, Wait

CYCLES = CycleTable()
CENTRED: dict[float, str] = {0: "to the depth Q201", 1: "to the diameter Q344"}


@CYCLES("CYCL DEF 240", "Centering", source="4.2")
class Centering(AtSurface):
    """Centres to a depth, or so deep that the point of the tool leaves a cone of a diameter on the surface."""

    clearance: float = addresses.clearance()
    mode: float = choice("Q343", "what the centring goes to", CENTRED, example=0)
    depth: float = addresses.depth(example=-3)
    diameter: float = coordinate("Q344", "diameter of the centring", note="negative is down; counts with Q343=1", example=-9)
    feed: float = addresses.plunge_feed()
    dwell_bottom: float = addresses.dwell_bottom()
    surface: float = addresses.surface()
    second_clearance: float = addresses.second_clearance()

    def depths(self) -> dict[str, float]:
        """What Q343 chooses: the sign of the diameter is a direction, too."""
        return {"diameter": self.diameter} if self.mode else {"depth": self.depth}

    def reach(self, m: Machine) -> float:
        if not self.mode:
            return self.depth
        return math.copysign(point_length(abs(self.diameter) / 2, tool(m).angle), self.diameter)

    def check(self, m: Machine) -> Iterator[Fault]:
        yield from self.signs(m)
        if self.mode:
            yield from with_angle(m, "mode")
            if not is_round(m):
                yield "mode", "1 cannot run under unequal scales of the plane: a diameter would be two"
        yield from not_zero(self, "feed", purpose="to drill with")

    def moves(self, m: Machine) -> Iterator[Step]:
        if self.mode and abs(self.diameter) > 2 * m.radius > 0:
            wider = f"wider than the tool, {2 * m.radius:.10g}: the cone ends at the tool's diameter"
            yield Say(f"Q344={self.diameter:.10g} is {wider}")
        yield from super().moves(m)

    def steps(self, m: Machine) -> Iterator[Step]:
        yield Go("centre", self.bottom(m), self.feed)
        yield Wait("dwell at the bottom", self.dwell_bottom)
        yield from self.leave()


@CYCLES("CYCL DEF 200", "Drilling", source="4.3")
class Drilling(AtSurface):
    """Drills in infeeds with full retraction to the set-up plane, a dwell after each infeed, and a rapid to the end plane."""

    clearance: float = addresses.clearance()
    depth: float = addresses.depth()
    feed: float = addresses.plunge_feed()
    infeed: float = addresses.infeed()
    dwell_top: float = addresses.dwell_top()
    surface: float = addresses.surface()
    second_clearance: float = addresses.second_clearance()
    dwell_bottom: float = addresses.dwell_bottom(default=0)  # older programs lack it
    reference: float = addresses.reference()

    def steps(self, m: Machine) -> Iterator[Step]:
        yield from drill(
            self.pecks(m), above=self.above, feed=self.feed, reenter=self.clearance, dwell_top=self.dwell_top,
            dwell_each=self.dwell_bottom, dwell_bottom=self.dwell_bottom,
        )  # fmt: skip
        yield from self.leave()


@CYCLES("CYCL DEF 201", "Reaming", source="4.4")
class Reaming(AtSurface):
    """In and out at feed: a reamer does not leave its hole at rapid."""

    clearance: float = addresses.clearance()
    depth: float = addresses.depth()
    feed: float = addresses.plunge_feed()
    dwell_bottom: float = addresses.dwell_bottom()
    retract_feed: float = addresses.retract_feed(also=())
    surface: float = addresses.surface()
    second_clearance: float = addresses.second_clearance()

    def steps(self, m: Machine) -> Iterator[Step]:
        out = rate(self.retract_feed, self.feed)
        yield from ream(self.bottom(m), above=self.above, feed=self.feed, retract=out, dwell=self.dwell_bottom)
        yield from self.leave()


@CYCLES("CYCL DEF 203", "Universal drilling", source="4.6")
class UniversalDrilling(AtSurface):
    """Drills with infeeds that may shrink; breaks the chip Q213 times before each full retraction.

    The infeed after the last chip break ends with the retraction, so Q213 + 1 infeeds lie between two of them. Back in the
    hole the rapid ends Q256 above the last depth, or Q200 above it where Q256 is 0.
    """

    clearance: float = addresses.clearance()
    depth: float = addresses.depth()
    feed: float = addresses.plunge_feed()
    infeed: float = addresses.infeed()
    dwell_top: float = addresses.dwell_top()
    surface: float = addresses.surface()
    second_clearance: float = addresses.second_clearance()
    decrement: float = addresses.decrement()
    chip_breaks: float = count("Q213", "chip breaks before each retraction", example=1)
    min_infeed: float = addresses.min_infeed()
    dwell_bottom: float = addresses.dwell_bottom()
    retract_feed: float | str = addresses.retract_feed()
    break_retract: float = addresses.break_retract()
    reference: float = addresses.reference()

    def steps(self, m: Machine) -> Iterator[Step]:
        yield from drill(
            self.pecks(m), above=self.above, feed=self.feed, reenter=self.break_retract or self.clearance,
            withdraw=rate(self.retract_feed, self.feed), dwell_top=self.dwell_top, dwell_bottom=self.dwell_bottom,
            breaks=int(self.chip_breaks), back=self.break_retract,
        )  # fmt: skip
        yield from self.leave()
