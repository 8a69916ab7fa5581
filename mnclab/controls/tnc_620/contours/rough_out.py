"""Cycle 22: clearing a contour level by level (8.6); `milling.rings` does the geometry."""

from __future__ import annotations

import math
from collections.abc import Iterator
from functools import partial
from typing import Any

from mnclab.controls.tnc_620.contours.area import contour_terraces
from mnclab.controls.tnc_620.contours.data import ContourData, contour_data, prepared, some_infeeds
from mnclab.controls.tnc_620.contours.leaving import leave
from mnclab.controls.tnc_620.contours.other_tools import Named, in_table, named_tool
from mnclab.controls.tnc_620.cycles import addresses
from mnclab.controls.tnc_620.cycles.addresses import FAR, choice, count, increment, percent
from mnclab.controls.tnc_620.cycles.faults import SAME, Fault, not_zero, with_radius
from mnclab.controls.tnc_620.cycles.planes import in_program_coordinates, rate
from mnclab.controls.tnc_620.machining import roughing
from mnclab.controls.tnc_620.machining.roughing import Cut, Feeds, Heights
from mnclab.geometry.regions import Region
from mnclab.machine.coordinates import MILLS, in_mm, remark, tool
from mnclab.machine.cycle import Cycle, CycleTable, few_passes
from mnclab.machine.machine import INF, Machine
from mnclab.machining.milling.residue import left_by
from mnclab.machining.milling.rest import rest, rest_passes
from mnclab.machining.milling.rings import rings
from mnclab.machining.milling.terraces import levels
from mnclab.machining.steps import Say, Step, Write

CYCLES = CycleTable()
LEAST_ANGLE = 0.1  # degrees
STRATEGIES: dict[float, str] = {0: "along the contour at depth", 1: "retract between the areas"}


@CYCLES("CYCL DEF 22", "Rough-out", source="8.6")
class RoughOut(Cycle):
    """Clears the contour level by level, each from the inside outward, islands first; a mirror image keeps its climb (8.3)."""

    does = MILLS
    about = in_program_coordinates
    infeed: float = increment("Q10", "infeed per cut", example=5)
    plunge_feed: float = addresses.feed("Q11", "feed rate for plunging", also=addresses.PLANE, at_most=FAR, example=150)
    feed: float = addresses.feed("Q12", "feed rate for roughing", also=addresses.PLANE, at_most=FAR, example=500)
    coarse_tool: Named = count(("Q18", "QS18"), "coarse roughing tool", type="text", default=0, note="0: none")
    swing_feed: float = addresses.feed("Q19", "feed rate for reciprocation", also=addresses.PLANE, at_most=FAR, example=0)
    retract_feed: float | str = addresses.retract_feed(at_most=None, default=INF, default_means="FMAX", note="", example=None)
    factor: float = percent("Q401", "feed rate factor at full engagement", at_most=100, default=100)
    fine_strategy: float = choice("Q404", "fine roughing strategy", STRATEGIES, default=0)

    def check(self, m: Machine) -> Iterator[Fault]:
        yield from prepared(m)
        yield from with_radius(m)
        yield from some_infeeds(self, m)
        yield from not_zero(self, "feed", *(() if self.swing_feed else ("plunge_feed",)), purpose="to mill with")
        if isinstance(self.retract_feed, float) and FAR < self.retract_feed < INF:
            yield "retract_feed", f"must be at most {FAR:.10g} or FMAX, got {self.retract_feed:g}"
        if self.coarse_tool:
            yield from in_table(self, m, "coarse_tool")
        if self.swing_feed and not LEAST_ANGLE <= m.tool.plunge_angle <= 90:
            angle = f"the plunge angle (ANGLE) of tool {m.tool.number} in its table, {LEAST_ANGLE:g} to 90 degrees"
            yield "swing_feed", f"needs {angle}, got {m.tool.plunge_angle:g}"

    def moves(self, m: Machine) -> Iterator[Step]:
        data, before, plunge = contour_data(m), m.programmed, self.swing_feed or self.plunge_feed
        yield Write("memory", m.tool, "rough_out_tool")
        found = yield from contour_terraces(m, data)
        cuts = [cut(self, m, data, terrace.region) for terrace in found]
        if data.overlap > 1:
            for each in cuts:
                yield from residue(m, data, each)
        if not any(each.clearing.pieces for each in cuts):
            yield Say("has nothing to cut: the coarse tool of Q18 has reached all that this one reaches")
            return
        heights = Heights(data.height, data.surface, data.above, data.down)
        feeds = Feeds(plunge, self.feed, self.feed * self.factor / 100)
        at = levels(found, data.surface, data.down, abs(self.infeed), data.floor_allowance)
        for _, sentence in few_passes("infeed", len(at), max(len(each.clearing.passes) for each in cuts)):
            m.alarm(in_mm(f"{self.code} Q10={self.infeed:.10g} {sentence}", m.variable_unit, length=True))
        try:
            yield from roughing.rough_out(cuts, at, heights, feeds, self.way_down(m, data))
        except ValueError as error:
            hint = f"LCUTS of tool {m.tool.number} in the tool table"
            m.alarm(in_mm(f"{self.code}: {error}{remark(m)}", m.variable_unit), hint=hint)
        yield from leave(m, before, data.height, rate(self.retract_feed, self.feed))

    def way_down(self, m: Machine, data: ContourData) -> roughing.WayDown:
        """Straight without Q19, or where ANGLE is 90; else on a helix, and to and fro where that has no room (8.6)."""
        mill = tool(m)
        if not self.swing_feed or mill.plunge_angle == 90:
            return roughing.straight_down
        stroke = mill.cutting_length / math.tan(math.radians(mill.plunge_angle))
        return partial(
            roughing.sloping_down, radius=m.radius, angle=mill.plunge_angle, stroke=stroke, climb=data.climb(m),
            helical=not self.coarse_tool,
        )  # fmt: skip

    def coarse_radius(self, m: Machine) -> float:
        """That of the coarse tool in lengths of the program, without its wear (8.6); 0 without one."""
        coarse = named_tool(m, self.coarse_tool) if self.coarse_tool else None
        return coarse.radius / m.scale if coarse else 0.0


def cut(c: RoughOut, m: Machine, data: ContourData, region: Region) -> Cut:
    """The passes that clear an area up to the allowance for side, or what a coarse tool left of it; an Alarm without room."""
    radius, stepover, coarse = m.radius, data.overlap * m.radius, c.coarse_radius(m)
    walls: dict[str, Any] = {"allowance": data.side_allowance, "climb": data.climb(m), "corner_radius": data.corner}
    try:
        if not coarse:
            return Cut(rings(region, radius, stepover, **walls, roomiest_first=True))
        along = c.fine_strategy == 0 and radius >= coarse / 2 - SAME
        left = rest(region, radius, coarse, data.side_allowance, corner_radius=data.corner)
        return Cut(rest_passes(region, radius, stepover, coarse, **walls, connect=along), left)
    except ValueError as error:
        hint = "take a smaller tool" if "fit" in str(error) else ""
        m.alarm(in_mm(f"{c.code}: {error}{remark(m)}", m.variable_unit), hint=hint)


def residue(m: Machine, data: ContourData, cut: Cut) -> Iterator[Say]:
    """A warning where passes more than a radius apart do not meet in sharp corners."""
    area = left_by(cut.clearing, cut.material) * m.scale**2
    if area >= 0.001:
        sentence = f"leaves {area:.3f} mm² of each level uncut, where the passes turn sharply"
        yield Say(f"Q2={data.overlap:.10g} {sentence}", "Q2=1 leaves nothing")
