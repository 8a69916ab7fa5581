"""Cycle 21: holes where cycle 22 will go down, for a tool that does not cut at its centre (8.5)."""

from __future__ import annotations

from collections.abc import Iterator

from mnclab.controls.tnc_620.contours.area import contour_terraces
from mnclab.controls.tnc_620.contours.data import contour_data, prepared, some_infeeds
from mnclab.controls.tnc_620.contours.leaving import leave
from mnclab.controls.tnc_620.contours.other_tools import Named, in_table, named_tool
from mnclab.controls.tnc_620.cycles import addresses
from mnclab.controls.tnc_620.cycles.addresses import FAR, count, increment
from mnclab.controls.tnc_620.cycles.faults import Fault, not_zero, with_radius
from mnclab.controls.tnc_620.cycles.obsolete_holes import advanced_stop
from mnclab.controls.tnc_620.cycles.planes import in_program_coordinates
from mnclab.machine.coordinates import MILLS, depth_scale, in_mm, remark
from mnclab.machine.cycle import Cycle, CycleTable
from mnclab.machine.machine import Machine
from mnclab.machining.depths import infeeds
from mnclab.machining.holes.drilling import drill
from mnclab.machining.milling.infeed_points import pilot_holes
from mnclab.machining.steps import Go, Step

CYCLES = CycleTable()


@CYCLES("CYCL DEF 21", "Pilot drilling", source="8.5")
class PilotDrilling(Cycle):
    """Drills where the rough-out tool goes down, in infeeds, down to the allowance for the floor."""

    does = MILLS
    about = in_program_coordinates
    infeed: float = increment("Q10", "infeed per cut", example=5)
    feed: float = addresses.feed("Q11", "feed rate for plunging", also=addresses.PLANE, at_most=FAR, example=150)
    rough_out_tool: Named = count(
        ("Q13", "QS13"), "rough-out tool", type="text", note="0: the tool in the spindle", example=1
    )

    def check(self, m: Machine) -> Iterator[Fault]:
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
