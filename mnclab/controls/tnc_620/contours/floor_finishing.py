"""Cycle 23: finishing the floors of a contour (8.7); `milling.floor_finishing` does the geometry."""

from __future__ import annotations

from collections.abc import Iterator

from mnclab.controls.tnc_620.contours.area import contour_terraces
from mnclab.controls.tnc_620.contours.data import contour_data, prepared
from mnclab.controls.tnc_620.contours.leaving import leave
from mnclab.controls.tnc_620.cycles import addresses
from mnclab.controls.tnc_620.cycles.addresses import FAR
from mnclab.controls.tnc_620.cycles.faults import SAME, Fault, not_zero, with_radius
from mnclab.controls.tnc_620.cycles.planes import in_program_coordinates, rate
from mnclab.controls.tnc_620.machining.floor_finishing import Descent, finish_floor, floor_passes
from mnclab.machine.coordinates import MILLS, depth_scale, in_mm, plane_scale, remark
from mnclab.machine.cycle import Cycle, CycleTable
from mnclab.machine.machine import INF, Machine
from mnclab.machining.milling.clearing import numbered
from mnclab.machining.steps import Say, Step

CYCLES = CycleTable()
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

    def check(self, m: Machine) -> Iterator[Fault]:
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
                floor_passes(
                    found, m.radius, data.overlap * m.radius, allowance=data.side_allowance, climb=data.climb(m),
                    corner_radius=data.corner,
                )
            )  # fmt: skip
        except ValueError as error:
            m.alarm(in_mm(f"{self.code}: {error}{remark(m)}", m.variable_unit), hint="take a smaller tool")
        arcs = abs(depth_scale(m) - plane_scale(m)) < SAME  # else they would be ellipses
        arc = min(data.floor_allowance + OVER_ALLOWANCE / m.scale, m.radius) if arcs else 0.0
        down = Descent(data.height, data.above, max(arc, 0.0), -data.down, self.plunge_feed)
        for name, floor in zip(numbered("floor", len(floors)), floors, strict=True):
            if not floor.clearing.pieces:
                yield Say(f"does not reach the floor {floor.depth:.10g} mm below the surface: the tool is too wide")
            yield from finish_floor(name, floor.clearing, data.surface + data.down * floor.depth, down, self.feed)
        yield from leave(m, before, data.height, rate(self.retract_feed, self.feed))
