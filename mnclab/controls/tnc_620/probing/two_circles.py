"""Probing two circles, cycle 1411 (TNC 620, 14.5)."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from mnclab.controls.tnc_620.cycles.addresses import angle, choice, length
from mnclab.controls.tnc_620.cycles.faults import Fault
from mnclab.controls.tnc_620.probing import addresses, aimed, taken_over
from mnclab.controls.tnc_620.probing.aimed import Finding, Floats, Found, Given, Judged
from mnclab.controls.tnc_620.probing.cycle import Moves, ProbingCycle
from mnclab.controls.tnc_620.probing.figures import circle
from mnclab.controls.tnc_620.probing.line import line_results, no_line
from mnclab.machine.cycle import CycleTable, param
from mnclab.machine.machine import Machine
from mnclab.machine.measuring import REWORK, SCRAP
from mnclab.machining.probing.found import Circle
from mnclab.machining.probing.sequences import Approach, around
from mnclab.machining.probing.sketches import sketch
from mnclab.machining.steps import Say

CYCLES = CycleTable()
GEOMETRY: dict[float, str] = {0: "hole and hole", 1: "stud and stud", 2: "hole and stud", 3: "stud and hole"}
HOLES = {0: (True, True), 1: (False, False), 2: (True, False), 3: (False, True)}
DIAMETERS = ("diameter_1", "diameter_2")


@CYCLES("TCH PROBE 1411", "Probing two circles", runs="definition", source="14.5")
class ProbingTwoCircles(ProbingCycle):
    """Touches of two holes or studs; the line through their centers is compared with that of the nominal ones."""

    tilted = True
    first_point_ref_axis: Given = aimed.place(("Q1100", "QS1100"), "first center, reference axis", example=25)
    first_point_minor_axis: Given = aimed.place(("Q1101", "QS1101"), "first center, minor axis", example=30)
    first_point_tool_axis: Given = aimed.place(("Q1102", "QS1102"), "first measuring height", example=-5)
    diameter_1: Given = length(("Q1116", "QS1116"), "first diameter", at_most=9999.9999, note=aimed.TEXT, example=20)
    second_point_ref_axis: Given = aimed.place(("Q1103", "QS1103"), "second center, reference axis", example=75)
    second_point_minor_axis: Given = aimed.place(("Q1104", "QS1104"), "second center, minor axis", example=30)
    second_point_tool_axis: Given = aimed.place(("Q1105", "QS1105"), "second measuring height", example=-5)
    diameter_2: Given = length(("Q1117", "QS1117"), "second diameter", at_most=9999.9999, note=aimed.TEXT, example=20)
    geometry_type: float = choice("Q1115", "geometry", GEOMETRY, example=0)
    number_of_probe_points: float = param(
        "Q423", "number of touches", "count", type="integer", modal=True, at_least=3, at_most=8, example=4
    )
    starting_angle: float = addresses.starting_angle()
    angular_length: float = angle("Q1119", "angle over which the touches are spread", at_least=-359.999, example=360)
    clearance: float = addresses.clearance()
    height: float = addresses.height()
    clearance_height_mode: float = aimed.clearance_mode()
    error_reaction: float = aimed.reaction()
    align_rotary_axis: float = aimed.aligning()
    transfer_position: float = aimed.transferred()
    confirm_rotation: float = aimed.rotation()

    def contradictions(self) -> Iterator[Fault]:
        if not self.angular_length:
            yield "angular_length", "must not be 0: the touches would be one"
        yield from taken_over.contradictions(self)

    def check(self, m: Machine) -> Iterator[Fault]:
        yield from super().check(m)
        yield from aimed.faults(self, m, *DIAMETERS)
        yield from no_line(self, m)
        yield from taken_over.faults(self, m)
        for name, hole, axes in zip(DIAMETERS, HOLES[int(self.geometry_type)], aimed.nominals(self, m), strict=True):
            known = aimed.nominal(self, m, name)
            if known.value is None or known.value < 0:
                yield name, "must be a diameter of 0 or more, to know where the touches begin"
            elif hole and known.value < 2 * m.radius:
                yield name, f"must be at least the diameter of the ball, {2 * m.radius:g}, got {known.value:g}"
            if (known.actual is None) != (axes[0].actual is None):
                yield name, "and its center must both have an actual value (@), or none"

    def find(self, m: Machine, a: Approach, k: int, where: Floats, rise: float) -> Finding:
        """Circle number k."""
        x, y, z = where.tolist()
        a, hole = replace(a, level=z), HOLES[int(self.geometry_type)][k]
        radius, now = (aimed.nominal(self, m, DIAMETERS[k]).value or 0.0) / 2, rise
        if hole:
            if radius < a.away:
                yield Say(f"begins in the center of hole {k + 1}: a clearance of {radius - a.ball:g} is possible, not {a.gap:g}")
            yield from aimed.arrive(a, k, x, y, a.pole, rise)
            now = math.inf
        count, over = int(self.number_of_probe_points), self.angular_length
        step = over / (count if abs(over) == 360 else count - 1)
        contacts = yield from around(a, (x, y), radius, self.starting_angle, step, count, hole, now, arc=False, leave=False)
        found = circle(self, m, contacts).grown(a.ball if hole else -a.ball)
        yield sketch(Circle(x, y, radius), found, z, contacts)
        return Found(np.array([found.x, found.y, z]), found.diameter, contacts)

    def moves(self, m: Machine) -> Moves:
        found = yield from aimed.measure(self, m, 1, ProbingTwoCircles.find)
        nominal = aimed.means(aimed.nominals(self, m), found)
        judged, results = aimed.judge_places(self, m, found), dict[int, float]()
        for k, (one, hole) in enumerate(zip(found, HOLES[int(self.geometry_type)], strict=True)):
            size = self.judged_diameter(m, k, one, hole)
            judged.append(size)
            results |= {966 + k: size.actual, 996 + k: size.actual - (size.nominal.mean or 0.0)}
        yield from line_results(self, m, found, nominal, judged, results)

    def judged_diameter(self, m: Machine, k: int, one: Found, hole: bool) -> Judged:
        """Material that is left is rework, what is missing scrap."""
        known = aimed.nominal(self, m, DIAMETERS[k])
        actual = one.diameter if known.actual is None else known.actual
        below, above = (REWORK, SCRAP) if hole else (SCRAP, REWORK)
        return aimed.judge(f"diameter {k + 1}", actual, known, one.contacts, below, above)
