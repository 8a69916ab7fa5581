"""Cycles 27, 28, 29 and 39: contours, slots and ridges on the surface of a cylinder (chapter 9); `milling.cylinder` says how.

All of them read one contour on the developed surface and machine it level by level, each level being a distance of the tip
from the axis of the cylinder. Before them and after them the tool is at the height where it stood, at least at Q16 + Q6.
"""

from __future__ import annotations

import math
from collections.abc import Generator, Iterator
from functools import partial
from typing import Any

from mnclab.controls.tnc_620.contours.line import Line, with_labels
from mnclab.controls.tnc_620.contours.surface import (
    Surface,
    along_slot,
    beside_contour,
    developed_line,
    over_contour,
    round_ridge,
    surface,
    surface_faults,
)
from mnclab.controls.tnc_620.cycles import addresses
from mnclab.controls.tnc_620.cycles.addresses import FAR, choice, distance, increment, length
from mnclab.controls.tnc_620.cycles.planes import Fault, in_program_coordinates, not_zero, with_radius
from mnclab.machine.control import Setting
from mnclab.machine.coordinates import MILLS, in_mm, remark
from mnclab.machine.cycle import Cycle, CycleTable, few_passes, param, too_many
from mnclab.machine.machine import Machine
from mnclab.machining.depths import infeeds
from mnclab.machining.steps import Go, Say, Step
from mnclab.path.toolpath import PathFault
from mnclab.text.alarm import Alarm

CYCLES = CycleTable()
SETTINGS = (
    Setting(
        "cylinder_approach", "CircleTangential", "how cycles 28 and 39 come to a wall (apprDepCylWall, no. 201004)", "9.3, 9.5",
        {"CircleTangential": "on an arc that touches it", "LineNormal": "on a straight line square to it"},
    ),
    Setting("spindle_error", True, "28, 29 and 39 need a turning spindle (displaySpindleErr, no. 201002)", "9.3 to 9.5"),
)  # fmt: skip
SHARED = "depth side_allowance clearance infeed plunge_feed feed cylinder_radius dimension_type"
allowance = partial(increment, "Q3", "finishing allowance for side", example=0)
width = partial(param, "Q20", unit="mm", modal=True, above=0, example=12)
WAYS = 4  # of a level at least: in, along the contour, out, and back
IN: dict[float, str] = {0: "in degrees", 1: "in mm, or in inches"}


class OnCylinder(Cycle):
    """What the four share; who inherits says in `machine` what it does with a contour."""

    does = MILLS
    about = in_program_coordinates
    depth: float = increment("Q1", "milling depth from the surface to the floor", example=-8)
    side_allowance: float = allowance(note="on the side of the radius compensation")
    clearance: float = distance("Q6", "set-up clearance", note="of the tool tip over the cylinder", example=8)
    infeed: float = increment("Q10", "infeed per cut", example=3)
    plunge_feed: float = addresses.feed("Q11", "feed rate for plunging", also=addresses.PLANE, at_most=FAR, example=100)
    feed: float = addresses.feed("Q12", "feed rate for roughing", also=addresses.PLANE, at_most=FAR, example=350)
    cylinder_radius: float = length("Q16", "radius of the cylinder", example=25)
    dimension_type: float = choice("Q17", "type of dimension of the rotary axis", IN, example=0)
    sided = True

    def check(self, m: Machine) -> Iterator[Fault]:
        yield from with_labels(m, single=True)
        yield from with_radius(m)
        yield from not_zero(self, "infeed", "plunge_feed", "feed", "cylinder_radius")
        if self.depth > 0:
            yield "depth", f"must be negative, got {self.depth:g}: the tool comes from outside, from inside is not built yet"
        if -self.depth >= self.cylinder_radius > 0:
            yield "depth", f"must be less deep than the radius Q16 = {self.cylinder_radius:g}, got {self.depth:g}"
        yield from [*too_many("infeed", self.levels)] or few_passes("infeed", len(self.levels()), WAYS)
        if self.sided and m.settings["spindle_error"] and not m.turning:
            yield "", "needs a turning spindle (setting spindle_error)"
        yield from surface_faults(m)

    def levels(self) -> tuple[float, ...]:
        """Distances of the tip from the axis."""
        return infeeds(self.cylinder_radius, self.cylinder_radius + self.depth, abs(self.infeed))

    @property
    def safe(self) -> float:
        """The set-up clearance as a distance from the axis."""
        return self.cylinder_radius + self.clearance

    def moves(self, m: Machine) -> Generator[Step, Any, None]:
        """Read the contour, machine it, and go back to the height from before."""
        if not self.depth:
            yield Say("Q1 makes a depth of 0: the cycle is not executed")
            return
        height = max(m.programmed[2], self.safe)
        if self.clearance <= m.radius:
            yield Say(f"Q6={self.clearance:g} (set-up clearance) should be greater than the tool radius {m.radius:g}{remark(m)}")
        on, call = surface(m, self.cylinder_radius), m.flow.span_of_step(m.step)
        line = yield from developed_line(m, degrees=self.dimension_type == 0, on=on)
        if self.sided and not line.side:
            m.alarm(f"{self.code}: the contour has no RL or RR, which says on which side the tool is", call)
        try:
            steps = list(self.machine(m, on, line, height))
        except PathFault as fault:
            message = in_mm(f"{self.code}: {fault.message}{remark(m)}", m.variable_unit)
            raise Alarm(message, m.flow.span_of_step(fault.step), hint=fault.hint) from None
        if height > m.programmed[2]:
            yield Go("retract", height)
        yield from steps

    def machine(self, m: Machine, on: Surface, line: Line, height: float) -> Iterator[Step]:
        """The steps over the cylinder, which end at the `height` that they begin at; a PathFault where the tool does not fit.

        Of itself nothing.
        """
        return iter(())


@CYCLES("CYCL DEF 27", "Cylinder surface", source="9.2", takes=SHARED)
class CylinderSurface(OnCylinder):
    """A contour rolled onto a cylinder; the tool always points to its axis, the rotary axis makes the whole way round."""

    sided = False

    def machine(self, m: Machine, on: Surface, line: Line, height: float) -> Iterator[Step]:
        if self.side_allowance and not line.side:
            what = f"Q3={self.side_allowance:g} (finishing allowance for side) needs RL or RR in the contour"
            raise PathFault(what, int(line.steps[0]), "with R0 the tool is on the contour")
        return over_contour(self, on, line, m.radius, height)


@CYCLES("CYCL DEF 28", "Cylinder surface slot", source="9.3", takes=f"{SHARED} slot_width tolerance")
class CylinderSlot(OnCylinder):
    """A slot about its midpoint path; the rotary axis stays over the midpoint and the linear axes make the offset, so that the
    walls are parallel and equally far apart at every depth."""

    side_allowance: float = allowance(note="on each wall")
    slot_width: float = width(meaning="slot width")
    tolerance: float = length("Q21", "tolerance", at_most=9.9999, default=0, note="0: no remachining", example=0.02)

    def check(self, m: Machine) -> Iterator[Fault]:
        yield from super().check(m)
        if 0 < self.tolerance < 0.0001:
            yield "tolerance", f"must be 0 or at least 0.0001, got {self.tolerance:g}"
        if (free := self.slot_width - 2 * self.side_allowance) < 2 * m.radius - 1e-9:
            yield "slot_width", f"less Q3 on both walls is {free:g}, too narrow for the tool diameter {2 * m.radius:g}"

    def machine(self, m: Machine, on: Surface, line: Line, height: float) -> Iterator[Step]:
        width = self.slot_width - 2 * self.side_allowance
        straight = m.settings["cylinder_approach"] == "LineNormal"
        return along_slot(self, on, line, width / 2 - m.radius, height, straight, self.tolerance)


@CYCLES("CYCL DEF 29", "Cylinder surface ridge", source="9.4", takes=f"{SHARED} ridge_width")
class CylinderRidge(OnCylinder):
    """A ridge about its midpoint path, with half circles at its ends: a groove as wide as the tool round it."""

    side_allowance: float = allowance(note="on the wall of the ridge")
    ridge_width: float = width(meaning="ridge width")

    def check(self, m: Machine) -> Iterator[Fault]:
        yield from super().check(m)
        yield from room_for_approach(self, m)

    def machine(self, m: Machine, on: Surface, line: Line, height: float) -> Iterator[Step]:
        half = self.ridge_width / 2
        du, dy = line.contour.ends[-1] - line.contour.points[0]
        if math.hypot(math.remainder(du, math.tau * self.cylinder_radius), dy) < half:
            what = "the midpoint path closes: a ridge has two ends, whose half circles would cut it"
            raise PathFault(what, int(line.steps[-1]), "let it end at least half the ridge width before its begin")
        return round_ridge(self, on, line, half, m.radius, height)


@CYCLES("CYCL DEF 39", "Cylinder surface contour", source="9.5", takes=SHARED)
class CylinderContour(OnCylinder):
    """A contour whose wall is parallel to the radial direction at the contour: the linear axes make the offset."""

    def check(self, m: Machine) -> Iterator[Fault]:
        yield from super().check(m)
        yield from room_for_approach(self, m)

    def machine(self, m: Machine, on: Surface, line: Line, height: float) -> Iterator[Step]:
        return beside_contour(self, on, line, m.radius, height, m.settings["cylinder_approach"] == "LineNormal")


def room_for_approach(c: OnCylinder, m: Machine) -> Iterator[Fault]:
    """The tool starts two radii beside the wall, and the allowance leaves some of the way."""
    if c.side_allowance >= m.radius - 1e-9:
        yield "side_allowance", f"must be less than the tool radius {m.radius:g}, got {c.side_allowance:g}: no room to approach"
