"""Inspection of angles, coordinates and planes (TNC 620, 16.4, 16.11, 16.13)."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from mnclab.controls.tnc_620.cycles.addresses import coordinate
from mnclab.controls.tnc_620.cycles.faults import SAME, Fault
from mnclab.controls.tnc_620.probing import addresses
from mnclab.controls.tnc_620.probing.addresses import HEIGHTS, LINE
from mnclab.controls.tnc_620.probing.cycle import Moves, ProbingCycle, needed
from mnclab.controls.tnc_620.probing.inspection import AXES, report
from mnclab.controls.tnc_620.probing.log import Value
from mnclab.machine.cycle import CycleTable
from mnclab.machine.machine import Machine
from mnclab.machine.measuring import REWORK, SCRAP
from mnclab.machining.probing.fits import angle, plane, reduced
from mnclab.machining.probing.found import axes_on, spatial_angles
from mnclab.machining.probing.sequences import in_one_axis
from mnclab.machining.probing.sketches import sketch
from mnclab.machining.steps import Say

CYCLES = CycleTable(addresses=addresses, runs="definition")
FLAT = 1e-6  # mm²: points that span less lie on a line


@CYCLES("TCH PROBE 420", "Angle measuring", source="16.4", takes=f"{LINE} {HEIGHTS} move_to_clearance measuring_log")
class AngleMeasuring(ProbingCycle):
    """Two touches of a straight edge; along the probe axis the angle is that about the reference or the minor axis."""

    tilted = True
    axis: float = addresses.axis(choices=addresses.AXES, example=2)

    def contradictions(self) -> Iterator[Fault]:
        same_x, same_y = abs(self.x - self.second_x) < SAME, abs(self.y - self.second_y) < SAME
        if same_x and same_y:
            yield "second_x", "and Q266 give the first touch point again: two points make an angle"
        elif self.axis == 3 and not (same_x or same_y):
            yield "axis", "3 measures an angle along an axis: Q265 must be Q263, or Q266 must be Q264"

    def moves(self, m: Machine) -> Moves:
        a, k = self.approach(m), int(self.axis) - 1
        points = [(self.x, self.y, self.level), (self.second_x, self.second_y, self.level)]
        contacts = yield from in_one_axis(a, k, self.direction, points, m.programmed[2])
        first, second = (np.array(contact.point) for contact in contacts)
        if k < 2:
            found, nominal = reduced(angle(first, second)), reduced(angle(points[0][:2], points[1][:2]))
            shift = np.eye(3)[k] * self.direction * a.ball
            yield sketch(points, [first + shift, second + shift], self.level, contacts)
        else:
            dx, dy, dz = second - first
            found, nominal = math.degrees(math.atan(dz / dy if abs(dy) > abs(dx) else -dz / dx)), 0.0
        value = Value("angle", "Angle", found, "Q150", nominal, unit="deg")
        yield from report(self, m, [value], contacts)


@CYCLES(
    "TCH PROBE 427", "Coordinate measuring", source="16.11",
    takes="x y level clearance axis direction height measuring_log maximum_limit minimum_limit program_stop monitored_tool "
          "reverse_tool angle_of_incidence",
)  # fmt: skip
class CoordinateMeasuring(ProbingCycle):
    """One touch along an axis. Beyond Q288 there is too much material, beyond Q289 too little, whichever is the larger one."""

    tilted = True
    axis: float = addresses.axis(choices=addresses.AXES)
    maximum_limit: float = coordinate("Q288", "maximum limit", note="0 with Q289 = 0: not monitored", example=0)
    minimum_limit: float = coordinate("Q289", "minimum limit", example=0)

    def moves(self, m: Machine) -> Moves:
        a, k = self.approach(m), int(self.axis) - 1
        contacts = yield from in_one_axis(a, k, self.direction, [(self.x, self.y, self.level)], m.programmed[2])
        found = contacts[0].point[k] + self.direction * a.ball
        ends = self.minimum_limit, self.maximum_limit
        turned = ends[0] > ends[1]
        value = Value(
            "XYZ"[k], f"Coordinate in {AXES[k]}", found, "Q160", lower=min(ends), upper=max(ends), limit="limit",
            watched=ends != (0, 0), below=REWORK if turned else SCRAP, above=SCRAP if turned else REWORK,
        )  # fmt: skip
        sizes = [value._replace(nominal=sum(ends) / 2)] if value.watched else []  # the middle of the limits
        change = sum(self.direction * each.deviation for each in sizes)
        yield from report(self, m, [value], contacts, sizes, (0.0, change) if k == 2 else (change, 0.0))


@CYCLES(
    "TCH PROBE 431", "Plane measuring", source="16.13",
    takes="x y z second_x second_y second_z third_x third_y third_z clearance height measuring_log",
)  # fmt: skip
class PlaneMeasuring(ProbingCycle):
    """Three touches downwards: the angles that tilt the working plane; X goes from the first point to the second one."""

    tilted = True
    second_z: float = coordinate("Q295", "second touch point, touch probe axis", example=0)
    third_z: float = coordinate("Q298", "third touch point, touch probe axis", example=0)

    def contradictions(self) -> Iterator[Fault]:
        ahead, aside = (self.second_x - self.x, self.second_y - self.y), (self.third_x - self.x, self.third_y - self.y)
        if abs(ahead[0] * aside[1] - ahead[1] * aside[0]) < FLAT:
            yield "third_x", "and the other points lie on one line: three points must span a plane"

    def moves(self, m: Machine) -> Moves:
        a = replace(self.approach(m), over=True)
        third = self.third_x, self.third_y, self.third_z
        points = [(self.x, self.y, self.z), (self.second_x, self.second_y, self.second_z), third]
        contacts = yield from in_one_axis(a, 2, -1.0, points, m.programmed[2])
        p = np.array([contact.point for contact in contacts]) - (0.0, 0.0, a.ball)
        found = needed(plane, p, m=m, code=self.code)
        up = np.cross(p[1] - p[0], p[2] - p[0])
        if up[2] < 0:
            yield Say(
                "finds a plane whose tool axis points down: the third point lies to the right of the first two",
                hint="choose the third point in the direction of +Y",
            )  # fmt: skip
        spatial = spatial_angles(axes_on(up, p[1] - p[0]))
        values = [
            Value("projection angle A", "Projection angle of the A axis", found.about_x, "Q158", unit="deg"),
            Value("projection angle B", "Projection angle of the B axis", found.about_y, "Q159", unit="deg"),
            *(
                Value(f"spatial angle {name}", f"Spatial angle {name}", value, f"Q17{k}", unit="deg")
                for k, (name, value) in enumerate(zip("ABC", spatial, strict=True))
            ),
            *(
                Value(f"Z{k + 1}", f"Point {k + 1} in {AXES[2]}", z, f"Q17{3 + k}", points[k][2])
                for k, z in enumerate(p[:, 2].tolist())
            ),
        ]  # fmt: skip
        yield from report(self, m, values, contacts)
