"""Cycles 21 to 24: an area drilled, cleared, and finished on floor and walls (8.5 to 8.8)."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from functools import partial
from typing import Any

from mnclab.controls.tnc_620.contours.area import ContourData, contour_data, contour_terraces, prepared, some_infeeds
from mnclab.controls.tnc_620.contours.line import Named, in_table, leave, named_tool
from mnclab.controls.tnc_620.cycles import addresses
from mnclab.controls.tnc_620.cycles.addresses import FAR, choice, count, increment, percent
from mnclab.controls.tnc_620.cycles.obsolete_sub_blocks import advanced_stop
from mnclab.controls.tnc_620.cycles.planes import (
    SAME,
    ParameterFault,
    in_program_coordinates,
    not_zero,
    rate,
    with_radius,
)
from mnclab.controls.tnc_620.machining import finishing, roughing
from mnclab.controls.tnc_620.machining.roughing import Cut, Feeds, Heights
from mnclab.controls.tnc_620.state import memory
from mnclab.geometry.regions import Region
from mnclab.machine.coordinates import MILLS, depth_scale, in_mm, plane_scale, remark, tool
from mnclab.machine.cycle import Cycle, CycleTable, too_many_passes
from mnclab.machine.machine import INF, Machine
from mnclab.machining.depths import infeeds
from mnclab.machining.holes import drill
from mnclab.machining.milling.clearing import numbered
from mnclab.machining.milling.rest import left_between, left_by, rest_passes
from mnclab.machining.milling.rings import rings
from mnclab.machining.milling.terraces import Terrace, levels, pilot_holes
from mnclab.machining.steps import Go, Say, Step, Write

# Cycle 21: holes where cycle 22 will go down, for a tool that does not cut at its centre (8.5).

CYCLES = CycleTable()


@CYCLES("CYCL DEF 21", "Pilot drilling", source="8.5")
class PilotDrilling(Cycle):
    """Drills where the rough-out tool goes down, in infeeds, down to the allowance for the floor."""

    does = MILLS
    about = in_program_coordinates
    infeed: float = increment("Q10", "infeed per cut", example=10)
    feed: float = addresses.feed("Q11", "feed rate for plunging", also=addresses.PLANE, at_most=FAR, example=150)
    rough_out_tool: Named = count(
        ("Q13", "QS13"), "rough-out tool", type="text", note="0: the tool in the spindle", example=1
    )

    def check(self, m: Machine) -> Iterator[ParameterFault]:
        yield from prepared(m)
        yield from some_infeeds(self, m)
        yield from not_zero(self, "feed", purpose="to drill with")
        if self.rough_out_tool:
            yield from in_table(self, m, "rough_out_tool")
        else:
            yield from with_radius(m)

    def moves(self, m: Machine) -> Iterator[Step]:
        """A delta of TOOL CALL does not count for the places (8.5)."""
        data, before = contour_data(m), m.programmed
        tool = named_tool(m, self.rough_out_tool or m.tool.number) or m.tool
        radius, height = tool.effective_radius / m.scale, max(data.height, before[2])
        found = yield from contour_terraces(m, data)
        try:
            holes = pilot_holes(found, radius + data.side_allowance, m.radius + data.side_allowance, data.floor_allowance)
        except ValueError as error:
            m.alarm(in_mm(f"{self.code}: {error}{remark(m)}", m.variable_unit), hint="take a smaller tool")
        for x, y, depth in holes:
            stop = advanced_stop(depth * depth_scale(m)) / depth_scale(m)
            levels = infeeds(data.surface, data.surface + data.down * depth, abs(self.infeed))
            yield Go("to the clearance height", height)
            yield Go("over the infeed point", x=x, y=y)
            yield Go("to the set-up clearance", data.above)
            yield from drill(levels, above=data.above, feed=self.feed, reenter=stop)
            height = data.above
        yield from leave(m, before, data.height)


# Cycle 22: clearing a contour level by level (8.6); `milling.rings` does the geometry.

LEAST_ANGLE = 0.1  # degrees
STRATEGIES: dict[float, str] = {0: "along the contour at depth", 1: "retract between the areas"}


@CYCLES("CYCL DEF 22", "Rough-out", source="8.6")
class RoughOut(Cycle):
    """Clears the contour level by level, each from the inside outward, islands first; a mirror image keeps its climb (8.3)."""

    does = MILLS
    about = in_program_coordinates
    infeed: float = increment("Q10", "infeed per cut", example=10)
    plunge_feed: float = addresses.feed("Q11", "feed rate for plunging", also=addresses.PLANE, at_most=FAR, example=150)
    feed: float = addresses.feed("Q12", "feed rate for roughing", also=addresses.PLANE, at_most=FAR, example=500)
    coarse_tool: Named = count(("Q18", "QS18"), "coarse roughing tool", type="text", default=0, note="0: none")
    swing_feed: float = addresses.feed("Q19", "feed rate for reciprocation", also=addresses.PLANE, at_most=FAR, example=0)
    retract_feed: float | str = addresses.retract_feed(at_most=None, default=INF, default_means="FMAX", note="", example=None)
    factor: float = percent("Q401", "feed rate factor at full engagement", at_most=100, default=100)
    fine_strategy: float = choice("Q404", "fine roughing strategy", STRATEGIES, default=0)

    def check(self, m: Machine) -> Iterator[ParameterFault]:
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
        for _, sentence in too_many_passes("infeed", len(at), max(len(each.clearing.passes) for each in cuts)):
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
        left = left_between(region, radius, coarse, data.side_allowance, corner_radius=data.corner)
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


# Cycle 23: finishing the floors of a contour (8.7); `tnc_620/machining/finishing.py` does the geometry.

OVER_ALLOWANCE = 1.0  # mm on the machine, how far above the allowance the arc to the floor begins with a tool not smaller


@CYCLES("CYCL DEF 23", "Floor finishing", source="8.7")
class FloorFinishing(Cycle):
    """Takes the allowance off every floor of the contour, from the inside outward; that for the side stays."""

    does = MILLS
    about = in_program_coordinates
    plunge_feed: float = addresses.feed("Q11", "feed rate for plunging", also=addresses.PLANE, at_most=FAR, example=150)
    feed: float = addresses.feed("Q12", "feed rate for finishing", also=addresses.PLANE, at_most=FAR, example=350)
    retract_feed: float | str = addresses.retract_feed(
        at_most=None, default=INF, default_means="FMAX", note="0: as Q12", example=None
    )

    def check(self, m: Machine) -> Iterator[ParameterFault]:
        yield from prepared(m)
        yield from not_zero(self, "plunge_feed", "feed", purpose="to mill with")
        if isinstance(self.retract_feed, float) and FAR < self.retract_feed < INF:
            yield "retract_feed", f"must be at most {FAR:.10g} or FMAX, got {self.retract_feed:g}"
        yield from with_radius(m)

    def moves(self, m: Machine) -> Iterator[Step]:
        data, before = contour_data(m), m.programmed
        found = yield from contour_terraces(m, data)
        try:
            floors = list(
                finishing.floor_passes(
                    found, m.radius, data.overlap * m.radius, allowance=data.side_allowance, climb=data.climb(m),
                    corner_radius=data.corner,
                )
            )  # fmt: skip
        except ValueError as error:
            m.alarm(in_mm(f"{self.code}: {error}{remark(m)}", m.variable_unit), hint="take a smaller tool")
        arcs = abs(depth_scale(m) - plane_scale(m)) < SAME  # else they would be ellipses
        arc = min(data.floor_allowance + OVER_ALLOWANCE / m.scale, m.radius) if arcs else 0.0
        down = finishing.Descent(data.height, data.above, max(arc, 0.0), -data.down, self.plunge_feed)
        for name, floor in zip(numbered("floor", len(floors)), floors, strict=True):
            if not floor.clearing.pieces:
                yield Say(f"does not reach the floor {floor.depth:.10g} mm below the surface: the tool is too wide")
            yield from finishing.finish_floor(name, floor.clearing, data.surface + data.down * floor.depth, down, self.feed)
        yield from leave(m, before, data.height, rate(self.retract_feed, self.feed))


# Cycle 24: finishing the walls of a contour, or of islands alone (8.8); `tnc_620/machining/finishing.py` does the geometry.

OVER_WALL = 0.5  # mm on the machine, how much wider than the allowance the arcs to the wall are
SHARE = 25  # of the set-up clearance: where the helices of the last infeed begin


@CYCLES("CYCL DEF 24", "Side finishing", source="8.8")
class SideFinishing(Cycle):
    """Takes the allowance off every wall on its own, in infeeds; the last one begins and ends on a helix."""

    does = MILLS
    about = in_program_coordinates
    sense: float = choice("Q9", "direction of machining", {-1: "up-cut milling", 1: "climb milling"}, example=1)
    infeed: float = increment("Q10", "infeed per cut", example=10)
    plunge_feed: float = addresses.feed("Q11", "feed rate for plunging", also=addresses.PLANE, at_most=FAR, example=150)
    feed: float = addresses.feed("Q12", "feed rate for finishing", also=addresses.PLANE, at_most=FAR, example=350)
    side_allowance: float = increment("Q14", "allowance that stays at the side", note="less than Q3 of cycle 20", example=0)
    rough_out_tool: Named = count(
        ("Q438", "QS438"), "rough-out tool", type="text", at_least=-1, at_most=32767.9, default=-1,
        note="-1: that of the last cycle 22, or the tool before; 0: none",
    )  # fmt: skip

    def check(self, m: Machine) -> Iterator[ParameterFault]:
        yield from prepared(m)
        yield from some_infeeds(self, m)
        yield from not_zero(self, "plunge_feed", "feed", purpose="to mill with")
        yield from with_radius(m)
        if self.rough_out_tool not in (-1, 0):
            yield from in_table(self, m, "rough_out_tool")
        here, rough = self.side_allowance + m.radius, contour_data(m).side_allowance + self.rough_radius(m)
        if here >= rough:
            sums = f"Q14 + R = {here:g} must be less than Q3 + R = {rough:g} of the rough-out tool"
            yield "", f"cannot finish the side, the tool radius is too large: {sums}"

    def rough_radius(self, m: Machine) -> float:
        """The radius of the rough-out tool in lengths of the program, 0 without one."""
        if self.rough_out_tool == 0:
            return 0.0
        kept = memory(m).rough_out_tool or memory(m).tool_before
        tool = kept if self.rough_out_tool == -1 else named_tool(m, self.rough_out_tool)
        return tool.effective_radius / m.scale if tool else 0.0

    def moves(self, m: Machine) -> Iterator[Step]:
        data, before = contour_data(m), m.programmed
        found = yield from contour_terraces(m, data, islands_alone=True)
        if self.side_allowance >= data.side_allowance:
            compared = f"Q14={self.side_allowance:.10g} is not less than Q3={data.side_allowance:.10g}"
            yield Say(f"{compared}: what the rough-out tool reached is not finished")
        for terrace, heights in zip(found, heights_of(found, data, abs(self.infeed)), strict=True):
            walls = walls_of(self, m, data, terrace)
            for _, sentence in too_many_passes("infeed", len(heights.levels), len(walls)):
                m.alarm(in_mm(f"{self.code} Q10={self.infeed:.10g} {sentence}", m.variable_unit, length=True))
            for x, y in (wall.contour.points[0].tolist() for wall in walls if not wall.tangential):
                yield Say(f"has no room for an arc to the wall at X{x:.3f} Y{y:.3f}: the tool comes straight to it")
            yield from finishing.finish_walls(walls, heights, self.plunge_feed, self.feed)
        yield from leave(m, before, data.height)


def walls_of(c: SideFinishing, m: Machine, data: ContourData, terrace: Terrace) -> tuple[finishing.Wall, ...]:
    """The walls of a terrace; an Alarm where the tool does not fit."""
    taken = data.side_allowance - c.side_allowance
    try:
        return finishing.wall_loops(
            terrace.region, m.radius, allowance=c.side_allowance, corner_radius=data.corner,
            climb=c.sense * m.orientation > 0, lead=max(m.radius / 2, taken + OVER_WALL / m.scale), least=max(taken, 0.0),
            solid=terrace.solid,
        )  # fmt: skip
    except ValueError as error:
        m.alarm(in_mm(f"{c.code}: {error}{remark(m)}", m.variable_unit), hint="take a smaller tool")


def heights_of(found: Sequence[Terrace], data: ContourData, infeed: float) -> Iterator[finishing.Heights]:
    """The levels of each terrace; only the way to the very first wall leads at the clearance height."""
    made = levels(found, data.surface, data.down, infeed)
    before = (data.surface, *(level.height for level in made))
    for k in range(len(found)):
        own = [number for number, level in enumerate(made) if level.terrace == k]
        last = abs(made[own[-1]].height - before[own[-1]])
        rise = -data.down * min(data.clearance / SHARE, last)
        yield finishing.Heights([made[number].height for number in own], rise, data.above if k else data.height, data.above)
