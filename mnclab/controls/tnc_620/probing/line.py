"""Two places and the angle of the line through them: probing on an edge, 1410, and two circles, 1411 (TNC 620, 14.4, 14.5).

The angle goes to Q964, Q965, Q994 and Q995.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from mnclab.controls.tnc_620.cycles.addresses import angle, choice, count
from mnclab.controls.tnc_620.cycles.planes import ParameterFault
from mnclab.controls.tnc_620.probing import addresses, aimed
from mnclab.controls.tnc_620.probing.addresses import FIRST, SECOND, TAKEN
from mnclab.controls.tnc_620.probing.aimed import Finding, Floats, FoundPlace, Given, Judged
from mnclab.controls.tnc_620.probing.cycle import Moves, ProbingCycle, circle, needed
from mnclab.controls.tnc_620.state import active_preset
from mnclab.geometry import frames
from mnclab.machine.coordinates import angles
from mnclab.machine.cycle import CycleTable
from mnclab.machine.machine import Machine
from mnclab.machine.measuring import REWORK, SCRAP
from mnclab.machine.setup import Datum
from mnclab.machining.probing import fits
from mnclab.machining.probing.found import Circle, Plane, axes_on, sketch
from mnclab.machining.probing.sequences import Approach, around, numbers
from mnclab.machining.steps import Measure, Say, Step
from mnclab.text.alarm import Alarm

CYCLES = CycleTable(addresses=addresses, runs="definition")
GEOMETRY: dict[float, str] = {0: "hole and hole", 1: "stud and stud", 2: "hole and stud", 3: "stud and hole"}
HOLES = {0: (True, True), 1: (False, False), 2: (True, False), 3: (False, True)}
DIAMETERS = ("diameter_1", "diameter_2")


def no_line(c: Any, m: Machine) -> Iterator[ParameterFault]:
    """Two nominal places that coincide in the plane."""
    (x, y, _), (x_2, y_2, _) = (tuple(each.mean for each in axes) for axes in aimed.nominals(c, m))
    if None not in (x, y, x_2, y_2) and (x, y) == (x_2, y_2):
        yield "second_point_ref_axis", "and the minor axis give the first place again: two places make a line"


def line_results(
    c: Any, m: Machine, found: Sequence[FoundPlace], nominal: Floats, judged: Sequence[Judged], diameters: Mapping[int, float]
) -> Iterator[Step]:
    """Results, the status, and what they make of the preset; `diameters` are further results by number."""
    is_ = needed(aimed.angle, *(one.point for one in found), m=m, code=c.code)
    by = fits.reduced(is_ - needed(aimed.angle, *nominal, m=m, code=c.code), 360)
    table = is_ + m.tables.presets.get(active_preset(m), Datum()).rotation + angles(m)[2]
    yield Measure("rotation", by, 0.0, unit="deg", touches=numbers([each for one in found for each in one.contacts]))
    yield from aimed.report(c, m, found, nominal, judged, {964: is_, 965: table, 994: by, 995: by}, diameters)
    turned = frames.turn(math.radians(by))[:3, :3]
    yield from aimed.take_over(c, m, found, nominal, turned, by)


@CYCLES("TCH PROBE 1410", "Probing on edge", source="14.4", takes=f"{FIRST} {SECOND} probing_direction {TAKEN}")
class ProbingOnEdge(ProbingCycle):
    """Two touches along Q372; the line through them is compared with that of the nominal points."""

    tilted, contradictions = True, aimed.contradictions
    probing_direction: float = addresses.probing_direction()

    def check(self, m: Machine) -> Iterator[ParameterFault]:
        yield from super().check(m)
        yield from aimed.faults(self, m)
        yield from no_line(self, m)
        yield from aimed.turn_faults(self, m)

    def moves(self, m: Machine) -> Moves:
        found = yield from aimed.measure(self, m, 2, aimed.touch)
        contacts = [contact for one in found for contact in one.contacts]
        nominal = aimed.means(aimed.nominals(self, m), found)
        if len(contacts) == len(found) and abs(self.probing_direction) < 3:
            yield sketch(nominal, [one.point for one in found], nominal[0, 2], contacts)
        yield from line_results(self, m, found, nominal, aimed.judge_places(self, m, found), {})


@CYCLES(
    "TCH PROBE 1411", "Probing two circles", source="14.5",
    takes=f"{FIRST} diameter_1 {SECOND} diameter_2 geometry_type number_of_probe_points starting_angle angular_length {TAKEN}",
)  # fmt: skip
class ProbingTwoCircles(ProbingCycle):
    """Touches of two holes or studs; the line through their centers is compared with that of the nominal ones."""

    tilted = True
    first_point_ref_axis: Given = addresses.first_point_ref_axis(meaning="first center, reference axis", example=25)
    first_point_minor_axis: Given = addresses.first_point_minor_axis(meaning="first center, minor axis", example=30)
    first_point_tool_axis: Given = addresses.first_point_tool_axis(meaning="first measuring height")
    second_point_ref_axis: Given = addresses.second_point_ref_axis(meaning="second center, reference axis", example=75)
    second_point_minor_axis: Given = addresses.second_point_minor_axis(meaning="second center, minor axis", example=30)
    second_point_tool_axis: Given = addresses.second_point_tool_axis(meaning="second measuring height")
    geometry_type: float = choice("Q1115", "geometry", GEOMETRY, example=0)
    number_of_probe_points: float = count("Q423", "number of touches", at_least=3, at_most=8, example=4)
    angular_length: float = angle("Q1119", "angle over which the touches are spread", at_least=-359.999, example=360)

    def contradictions(self) -> Iterator[ParameterFault]:
        if not self.angular_length:
            yield "angular_length", "must not be 0: the touches would be one"
        yield from aimed.contradictions(self)

    def check(self, m: Machine) -> Iterator[ParameterFault]:
        yield from super().check(m)
        yield from aimed.faults(self, m, *DIAMETERS)
        yield from no_line(self, m)
        yield from aimed.turn_faults(self, m)
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
        return FoundPlace(np.array([found.x, found.y, z]), found.diameter, contacts)

    def moves(self, m: Machine) -> Moves:
        found = yield from aimed.measure(self, m, 1, ProbingTwoCircles.find)
        nominal = aimed.means(aimed.nominals(self, m), found)
        judged, results = aimed.judge_places(self, m, found), dict[int, float]()
        for k, (one, hole) in enumerate(zip(found, HOLES[int(self.geometry_type)], strict=True)):
            size = self.judged_diameter(m, k, one, hole)
            judged.append(size)
            results |= {966 + k: size.actual, 996 + k: size.actual - (size.nominal.mean or 0.0)}
        yield from line_results(self, m, found, nominal, judged, results)

    def judged_diameter(self, m: Machine, k: int, one: FoundPlace, hole: bool) -> Judged:
        """Material that is left is rework, what is missing scrap."""
        known = aimed.nominal(self, m, DIAMETERS[k])
        actual = one.diameter if known.actual is None else known.actual
        below, above = (REWORK, SCRAP) if hole else (SCRAP, REWORK)
        return aimed.judge(f"diameter {k + 1}", actual, known, one.contacts, below, above)


# Probing in a plane, cycle 1420 (TNC 620, 14.3).

SPACE: dict[float, str] = {0: "none", 1: "basic rotation in space"}
OF_THREE: dict[float, str] = {**addresses.TRANSFERS, 3: "point 3", 4: "the mean of the points"}
STEEP = 0.1  # part of a normal across Y, below which a level X does not say where X of the plane is


@CYCLES(
    "TCH PROBE 1420", "Probing in plane", source="14.3",
    takes=f"{FIRST} {SECOND} third_point_ref_axis third_point_minor_axis third_point_tool_axis probing_direction {TAKEN}",
)  # fmt: skip
class ProbingInPlane(ProbingCycle):
    """Three touches along Q372; Q961 to Q963 are the spatial angles of the plane, without a turn in itself."""

    tilted = True
    first_point_tool_axis: Given = addresses.first_point_tool_axis(example=0)
    second_point_tool_axis: Given = addresses.second_point_tool_axis(example=0)
    probing_direction: float = addresses.probing_direction(example=-3)
    align_rotary_axis: float = addresses.align_rotary_axis()
    transfer_position: float = addresses.transfer_position(choices=OF_THREE)
    confirm_rotation: float = addresses.confirm_rotation(choices=SPACE)

    def contradictions(self) -> Iterator[ParameterFault]:
        if self.align_rotary_axis and not self.confirm_rotation:
            yield "align_rotary_axis", "aligns the rotary axes: then Q1121 must be 1, which takes the rotation over"

    def check(self, m: Machine) -> Iterator[ParameterFault]:
        yield from super().check(m)
        yield from aimed.faults(self, m)
        known = aimed.nominals(self, m)
        if all(each.mean is not None for axes in known for each in axes):
            try:
                fits.plane([[each.mean or 0.0 for each in axes] for axes in known])
            except Alarm as alarm:
                yield "third_point_ref_axis", f"makes no plane with the other points: {alarm.message}"

    def moves(self, m: Machine) -> Moves:
        found = yield from aimed.measure(self, m, 2, aimed.touch)
        nominal, points = aimed.means(aimed.nominals(self, m), found), np.array([one.point for one in found])
        is_: Plane = needed(fits.plane, points, m=m, code=self.code)
        should: Plane = needed(fits.plane, nominal, m=m, code=self.code)
        angles = dict(zip((961, 962, 963), is_.spatial, strict=True))
        yield from aimed.report(self, m, found, nominal, aimed.judge_places(self, m, found), angles, {})
        yield from aimed.take_over(self, m, found, nominal, turn_between(should, is_), math.nan)


def turn_between(first: Plane, second: Plane) -> Floats:
    """The rotation (3, 3) that takes a plane to another: that of their axes with a level X, without a turn in themselves."""
    up = np.array(second.up) * math.copysign(1.0, float(np.dot(first.up, second.up)))
    ahead = (1.0, 0.0, 0.0) if math.hypot(first.up[0], first.up[2]) < STEEP else None
    return np.asarray(axes_on(up, ahead) @ axes_on(first.up, ahead).T)
