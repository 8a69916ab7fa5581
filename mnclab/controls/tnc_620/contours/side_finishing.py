"""Cycle 24: finishing the walls of a contour, or of islands alone (8.8); `milling.contour_finishing` does the geometry."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from mnclab.controls.tnc_620.contours.area import contour_terraces
from mnclab.controls.tnc_620.contours.data import ContourData, contour_data, prepared, some_infeeds
from mnclab.controls.tnc_620.contours.leaving import leave
from mnclab.controls.tnc_620.contours.other_tools import Named, in_table, named_tool
from mnclab.controls.tnc_620.cycles import addresses
from mnclab.controls.tnc_620.cycles.addresses import FAR, choice, count, increment
from mnclab.controls.tnc_620.cycles.faults import Fault, not_zero, with_radius
from mnclab.controls.tnc_620.cycles.planes import in_program_coordinates
from mnclab.controls.tnc_620.machining.contour_finishing import Heights, Wall, finish_walls, wall_loops
from mnclab.controls.tnc_620.state import memory
from mnclab.machine.coordinates import MILLS, in_mm, remark
from mnclab.machine.cycle import Cycle, CycleTable, few_passes
from mnclab.machine.machine import Machine
from mnclab.machining.milling.terraces import Terrace, levels
from mnclab.machining.steps import Say, Step

CYCLES = CycleTable()
OVER_ALLOWANCE = 0.5  # mm on the machine, how much wider than the allowance the arcs to the wall are
SHARE = 25  # of the set-up clearance: where the helices of the last infeed begin


@CYCLES("CYCL DEF 24", "Side finishing", source="8.8")
class SideFinishing(Cycle):
    """Takes the allowance off every wall on its own, in infeeds; the last one begins and ends on a helix."""

    does = MILLS
    about = in_program_coordinates
    sense: float = choice("Q9", "direction of machining", {-1: "up-cut milling", 1: "climb milling"}, example=1)
    infeed: float = increment("Q10", "infeed per cut", example=5)
    plunge_feed: float = addresses.feed("Q11", "feed rate for plunging", also=addresses.PLANE, at_most=FAR, example=150)
    feed: float = addresses.feed("Q12", "feed rate for finishing", also=addresses.PLANE, at_most=FAR, example=350)
    side_allowance: float = increment("Q14", "allowance that stays at the side", note="less than Q3 of cycle 20", example=0)
    rough_out_tool: Named = count(
        ("Q438", "QS438"), "rough-out tool", type="text", at_least=-1, at_most=32767.9, default=-1,
        note="-1: that of the last cycle 22, or the tool before; 0: none",
    )  # fmt: skip

    def check(self, m: Machine) -> Iterator[Fault]:
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
            for _, sentence in few_passes("infeed", len(heights.levels), len(walls)):
                m.alarm(in_mm(f"{self.code} Q10={self.infeed:.10g} {sentence}", m.variable_unit, length=True))
            for x, y in (wall.contour.points[0].tolist() for wall in walls if not wall.tangential):
                yield Say(f"has no room for an arc to the wall at X{x:.3f} Y{y:.3f}: the tool comes straight to it")
            yield from finish_walls(walls, heights, self.plunge_feed, self.feed)
        yield from leave(m, before, data.height)


def walls_of(c: SideFinishing, m: Machine, data: ContourData, terrace: Terrace) -> tuple[Wall, ...]:
    """The walls of a terrace; an Alarm where the tool does not fit."""
    taken = data.side_allowance - c.side_allowance
    try:
        return wall_loops(
            terrace.region, m.radius, allowance=c.side_allowance, corner_radius=data.corner,
            climb=c.sense * m.orientation > 0, lead=max(m.radius / 2, taken + OVER_ALLOWANCE / m.scale), least=max(taken, 0.0),
            solid=terrace.solid,
        )  # fmt: skip
    except ValueError as error:
        m.alarm(in_mm(f"{c.code}: {error}{remark(m)}", m.variable_unit), hint="take a smaller tool")


def heights_of(found: Sequence[Terrace], data: ContourData, infeed: float) -> Iterator[Heights]:
    """The levels of each terrace; only the way to the very first wall leads at the clearance height."""
    made = levels(found, data.surface, data.down, infeed)
    before = (data.surface, *(level.height for level in made))
    for k in range(len(found)):
        own = [number for number, level in enumerate(made) if level.terrace == k]
        last = abs(made[own[-1]].height - before[own[-1]])
        rise = -data.down * min(data.clearance / SHARE, last)
        yield Heights([made[number].height for number in own], rise, data.above if k else data.height, data.above)
