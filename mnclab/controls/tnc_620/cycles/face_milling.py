"""Face milling, cycle 232 (12.7): a rectangle on parallel lines, in equal infeeds and a finishing one."""

from __future__ import annotations

import math
from collections.abc import Iterator

from mnclab.controls.tnc_620.cycles import addresses
from mnclab.controls.tnc_620.cycles.addresses import choice, coordinate, distance, increment
from mnclab.controls.tnc_620.cycles.planes import Fault, in_program_coordinates, not_zero, with_radius
from mnclab.machine.coordinates import MILLS
from mnclab.machine.cycle import Cycle, CycleTable, too_many
from mnclab.machine.machine import Machine
from mnclab.machining.depths import DRIFT
from mnclab.machining.milling.clearing import Clearing, numbered
from mnclab.machining.milling.faces import Layer, face, lines, rows
from mnclab.machining.steps import Go, Say, Step

CYCLES = CycleTable()
MOST = 20_000  # lines of one cycle, all its levels together
STRATEGIES = addresses.MEANDER | {2: "one way, retraction and back at the positioning feed"}


@CYCLES("CYCL DEF 232", "Face milling", source="12.7")
class FaceMilling(Cycle):
    """Mills a level surface in several infeeds, each level backwards over the one before; the last one finishes."""

    does = MILLS
    about = in_program_coordinates
    strategy: float = choice("Q389", "machining strategy", STRATEGIES, example=2)
    start_1st_axis: float = coordinate("Q225", "starting point, first axis", example=10)
    start_2nd_axis: float = coordinate("Q226", "starting point, second axis", example=12)
    start_3rd_axis: float = coordinate("Q227", "coordinate of the surface", example=2.5)
    end_3rd_axis: float = coordinate("Q386", "coordinate to mill down to", example=-3)
    first_side_length: float = increment(
        "Q218", "first side length", note="the sign is the direction of the first line", example=150
    )
    second_side_length: float = increment(
        "Q219", "second side length", note="the sign is the direction of the first stepover", example=75
    )
    maximum_plunging_depth: float = addresses.greatest_infeed(example=2)
    floor_allowance: float = distance("Q369", "finishing allowance for the floor", note="the last infeed", example=0.5)
    maximum_overlap: float = addresses.overlap(
        meaning="greatest path overlap factor", at_least=0.1, predef=False, note="times the tool radius is the stepover"
    )
    feed: float = addresses.milling_feed()
    finishing_feed: float = addresses.finishing_feed(at_most=addresses.FAR, example=800)
    prepositioning_feed: float = addresses.positioning_feed(example=2000)
    clearance: float = addresses.clearance()
    side_clearance: float = addresses.side_clearance()
    second_clearance: float = addresses.second_clearance(predef=True, example=50)

    def contradictions(self) -> Iterator[Fault]:
        if self.end_3rd_axis > self.start_3rd_axis:
            yield "end_3rd_axis", f"must not lie above Q227 = {self.start_3rd_axis:g}, got {self.end_3rd_axis:g}"

    def check(self, m: Machine) -> Iterator[Fault]:
        if self.height == 0:
            return
        if self.roughing > DRIFT:
            yield from not_zero(self, "maximum_plunging_depth")
        yield from with_radius(m)
        if self.flat(m) <= 0:
            yield "", f"needs a tool that is flat below, got R {m.radius * m.scale:g} and R2 {m.tool.corner:g}"
        yield from not_zero(self, "feed", "finishing_feed", "prepositioning_feed")
        yield from too_many("maximum_plunging_depth", self.levels)
        yield from too_many("maximum_overlap", lambda: self.across(self.flat(m)))
        if len(self.levels()) * len(self.across(self.flat(m))) > MOST:
            yield "maximum_overlap", f"makes more than {MOST} lines"

    @property
    def height(self) -> float:
        """A: what is taken off."""
        return self.start_3rd_axis - self.end_3rd_axis

    @property
    def roughing(self) -> float:
        """A_r: what is taken off before the finishing infeed."""
        return self.height - self.floor_allowance

    @staticmethod
    def flat(m: Machine) -> float:
        """R_e: the radius of what is flat below the tool."""
        return m.radius - m.tool.corner / m.scale

    def levels(self) -> tuple[float, ...]:
        """Equal infeeds down to the allowance, and then the allowance."""
        last = (self.end_3rd_axis,) if self.floor_allowance else ()
        if self.roughing <= DRIFT:
            return last
        rough_end = self.end_3rd_axis + self.floor_allowance
        return rows(self.start_3rd_axis, rough_end, self.maximum_plunging_depth)[1:] + last

    def across(self, flat: float) -> tuple[float, ...]:
        """Where the lines lie: the first on the edge or, with an overlap over 1, inside; the edge of the last on the far edge."""
        first, last = max(0.0, self.maximum_overlap - 1) * flat, abs(self.second_side_length) - flat
        places = rows(first, last, self.maximum_overlap * flat) if last > first else (first,)
        return tuple(self.start_2nd_axis + math.copysign(place, self.second_side_length) for place in places)

    def lines(self, m: Machine) -> Clearing:
        ahead, near = math.copysign(1.0, self.first_side_length), self.start_1st_axis
        far, outside = near + self.first_side_length, ahead * (m.radius + self.side_clearance)
        edges = (near, far) if self.strategy == 1 else None
        return lines(
            self.across(self.flat(m)), near - outside, far + outside, m.radius, one_way=self.strategy == 2, within=edges,
            leave=True,
        )  # fmt: skip

    def layers(self, m: Machine) -> Iterator[Layer]:
        """Every second level backwards; the finishing infeed at its own feed."""
        passes, levels = self.lines(m), self.levels()
        for k, (name, level) in enumerate(zip(numbered("level", len(levels)), levels)):
            finishing = bool(self.floor_allowance) and k == len(levels) - 1
            feed = self.finishing_feed if finishing else self.feed
            link = feed if self.strategy == 1 else self.prepositioning_feed
            way = passes.reversed() if k % 2 else passes
            yield Layer("finishing" if finishing else name, level, way, feed, link, self.prepositioning_feed)

    def moves(self, m: Machine) -> Iterator[Step]:
        if self.height == 0:
            yield Say("Q386 makes a depth of 0: the cycle is not executed")
            return
        high = self.start_3rd_axis + max(self.second_clearance, self.clearance)
        if m.programmed[2] <= high:
            yield Go("to the second set-up clearance", high)
        yield from face(list(self.layers(m)), self.start_3rd_axis + self.clearance, self.clearance)
        yield Go("retract", high)
