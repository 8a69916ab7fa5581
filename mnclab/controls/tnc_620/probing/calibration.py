"""Calibration of the touch probe on a sphere, a surface, in a ring and on a stud (TNC 620, 17.4 to 17.9): cycles 460 to 463.

The spindle axis is sent where a cycle says, and what it finds lies off the figure by the offset of the ball. A rough run finds
the centre, a fine one about it the radius; with the spindle turned by 180 degrees four more touches find the offset, where the
spindle can be oriented (setting "controlled_spindle").
"""

from __future__ import annotations

import math
from collections.abc import Generator, Iterator
from dataclasses import replace
from functools import partial
from typing import Any

from mnclab.controls.tnc_620.cycles.addresses import choice, coordinate, count, length
from mnclab.controls.tnc_620.cycles.planes import ParameterFault
from mnclab.controls.tnc_620.probing import addresses
from mnclab.controls.tnc_620.probing.cycle import Moves, ProbingCycle, needed
from mnclab.controls.tnc_620.state import time_of_day
from mnclab.machine.control import Setting
from mnclab.machine.coordinates import in_mm
from mnclab.machine.cycle import CycleTable
from mnclab.machine.flow import FILE
from mnclab.machine.machine import Machine
from mnclab.machine.touching import FEELS, Point, length_touched, offset_written, plane_of, ring, stud, with_radius
from mnclab.machining.probing.fits import circle
from mnclab.machining.probing.sequences import Approach, Pair, around, over_to
from mnclab.machining.steps import Measure, Orient, Say, Step, Touch, Write
from mnclab.workpiece.part import Part, ball

CYCLES = CycleTable(addresses=addresses, runs="definition")
LOG = "TCHPRAUTO.html"  # (17.5)
MOST = 99.9999  # mm, of a radius; that of a ring is printed as 9.9999
SETTINGS = (
    Setting("tool_comp_3d", True, "software option 92, 3D-ToolComp: cycle 460 can calibrate in three dimensions", "17.6"),
)
Finding = Generator[Step, Any, Any]
touches = partial(count, "Q423", "number of touch points", at_least=3, at_most=8)
first = partial(addresses.reference_angle, at_least=0)


@CYCLES(
    "TCH PROBE 460", "Calibration on a sphere", source="17.6",
    takes="radius clearance move_to_clearance points reference_angle calibrate_length preset_for_length number_of_points_3d",
)  # fmt: skip
class OnSphere(ProbingCycle):
    """Radius and offset at the equator, which three touches of a meridian find; the length on the pole, deviations all over."""

    does = FEELS
    radius: float = length("Q407", "exact radius of the calibration sphere", at_least=0.0001, at_most=MOST, example=12.5)
    points: float = touches(example=4)
    reference_angle: float = first()
    calibrate_length: float = choice("Q433", "calibrating the length too", addresses.SWITCH, example=0)
    preset_for_length: float = coordinate("Q434", "height of the center of the sphere", example=-2.5)
    number_of_points_3d: float = count("Q455", "touch points from pole to equator", at_most=30, default=0, example=0)

    def check(self, m: Machine) -> Iterator[ParameterFault]:
        yield from super().check(m)
        if self.number_of_points_3d and not m.settings["tool_comp_3d"]:
            yield "number_of_points_3d", "needs the software option 3D-ToolComp, which is switched off (setting tool_comp_3d)"

    def moves(self, m: Machine) -> Moves:
        yield from logged(self, m, self.calibrate(m))

    def figure(self, m: Machine) -> Part:
        x, y, z = m.tip
        return ball((x, y, z - self.approach(m).gap - self.radius), self.radius)

    def calibrate(self, m: Machine) -> Moves:
        a, before, about = here(self, m), m.tool, m.programmed[:2]
        equator = yield from self.equator(m, a)
        x, y = yield from radius_and_offset(self, m, replace(a, level=equator), about, inside=False)
        if self.calibrate_length:
            yield from length_touched(m, a, x, y, self.preset_for_length + self.radius)
        if self.number_of_points_3d:
            longer = m.tool.effective_length - before.effective_length
            yield from self.all_over(m, (x, y, equator - a.ball + m.radius - longer))

    def equator(self, m: Machine, a: Approach) -> Finding:
        """Three touches above one another on the side of the reference angle; the height of the ball's center at the equator."""
        (x, y, z), way = m.programmed, math.radians(self.reference_angle)
        cos, sin, out = math.cos(way), math.sin(way), self.radius + a.away
        estimated, points = z - a.gap - self.radius, []
        yield a.go("beside the sphere", x=x + out * cos, y=y + out * sin)
        for share in (-0.25, 0.0, 0.25):
            pole, inward = estimated + share * self.radius - a.ball, out - a.reach
            yield a.go("to the starting point", pole)
            contact = yield Touch("search the equator", x + inward * cos, y + inward * sin, pole, a.feed, a.ball)
            tip = m.to_program(contact.tip)
            points.append(((tip[0] - x) * cos + (tip[1] - y) * sin, tip[2] + a.ball))
            yield a.go("back", pole, x + out * cos, y + out * sin)
        yield a.go("to the clearance height", a.height)
        return needed(circle, points, m=m, code=self.code).y

    def all_over(self, m: Machine, centre: Point) -> Moves:
        """Touches from the pole to the equator; how far each is off the sphere is written to a table, which nothing reads."""
        a, lines, (x, y, z) = here(self, m), ["azimuth polar_angle deviation"], centre
        for k in range(int(self.points)):
            azimuth = self.reference_angle + k * 360 / self.points
            for step in range(1, int(self.number_of_points_3d) + 1):
                polar = 90 * step / self.number_of_points_3d
                turn, tilt = math.radians(azimuth), math.radians(polar)
                way = math.sin(tilt) * math.cos(turn), math.sin(tilt) * math.sin(turn), math.cos(tilt)
                out, end = self.radius + a.away, self.radius + a.away - a.reach
                pole = z - a.ball
                yield from over_to(a, x + out * way[0], y + out * way[1], m.programmed[2], pole + out * way[2])
                contact = yield Touch("touch", x + end * way[0], y + end * way[1], pole + end * way[2], a.feed, a.ball)
                off = math.dist(m.to_program(contact.tip), (x, y, pole)) - self.radius - a.ball
                lines.append(f"{azimuth % 360:.4f} {polar:.4f} {off:z.6f}")
                yield a.go("back", pole + out * way[2], x + out * way[0], y + out * way[1])
        yield a.go("to the clearance height", a.height)
        name = f"TNC:\\system\\CAL_TS{m.tool.number}_0.3DTC"
        yield Write("file", "\n".join([*lines, ""]), name)
        yield Say(f"writes {name}: its deviations are not taken into account when probing")


@CYCLES("TCH PROBE 461", "Calibration of the length", source="17.7")
class OfLength(ProbingCycle):
    """One touch downwards from where the probe stands, on a surface whose height is known."""

    does = FEELS
    preset_for_length: float = coordinate("Q434", "height of the touched surface", example=5)

    def moves(self, m: Machine) -> Moves:
        yield from logged(self, m, length_touched(m, here(self, m), *m.programmed[:2], self.preset_for_length))


@CYCLES("TCH PROBE 462", "Calibration in a ring", source="17.8", takes="radius clearance points reference_angle")
class InRing(ProbingCycle):
    """Radius and offset; the probe stands in the ring at the measuring height, and stays there."""

    does = FEELS
    radius: float = length("Q407", "radius of the ring", at_most=MOST, example=25)
    points: float = touches(example=8)
    reference_angle: float = first(meaning="angle of the first touch point")

    def check(self, m: Machine) -> Iterator[ParameterFault]:
        yield from super().check(m)
        if self.radius <= m.radius:
            yield "radius", f"must be greater than the radius of the ball, {m.radius:g}, got {self.radius:g}"

    def figure(self, m: Machine) -> Part:
        return ring(m, self.radius)

    def moves(self, m: Machine) -> Moves:
        a = here(self, m, stands=m.programmed[2])
        yield from logged(self, m, radius_and_offset(self, m, a, m.programmed[:2], inside=True))


@CYCLES(
    "TCH PROBE 463", "Calibration on a stud", source="17.9", takes="radius clearance move_to_clearance points reference_angle"
)  # fmt: skip
class OnStud(ProbingCycle):
    """Radius and offset; the probe stands over the stud, which is touched one ball radius below its top."""

    does = FEELS
    radius: float = length("Q407", "radius of the stud", at_most=MOST, example=10)
    points: float = touches(example=8)
    reference_angle: float = first(meaning="angle of the first touch point")

    def figure(self, m: Machine) -> Part:
        return stud(m, self.radius, m.tip[2] - self.approach(m).gap)

    def moves(self, m: Machine) -> Moves:
        a = here(self, m)
        a = replace(a, level=a.height - a.gap - a.ball)
        yield from logged(self, m, radius_and_offset(self, m, a, m.programmed[:2], inside=False))


Round = OnSphere | InRing | OnStud


def here(c: ProbingCycle, m: Machine, **other: Any) -> Approach:
    """The clearance height is that where the probe stands."""
    return c.approach(m, height=m.programmed[2], track=False, **other)


def oriented(m: Machine, turn: float = 0.0) -> Iterator[Step]:
    """The probe stands as the column CAL_ANG says, or turned from there."""
    if m.settings["controlled_spindle"]:
        yield Orient("turn the probe", (m.tables.probe.angle + turn) % 360)


def circle_found(c: Round, m: Machine, a: Approach, middle: Pair, inside: bool, count: int) -> Finding:
    """Touches around a middle, and to the centre of the circle that the spindle axis found; returns circle and touches."""
    step, now = 360 / count, m.programmed[2]
    contacts = yield from around(a, middle, c.radius, c.reference_angle, step, count, inside, now, arc=False)
    found = needed(circle, [m.to_program(each.tip)[:2] for each in contacts], "power", m=m, code=c.code)
    yield a.go("to the centre", x=found.x, y=found.y)
    return found, tuple(each.number for each in contacts)


def radius_and_offset(c: Round, m: Machine, a: Approach, about: Pair, inside: bool) -> Finding:
    """Rough, fine, and turned by 180 degrees; writes radius and offset, and returns the centre of the spindle axis."""
    rough, _ = yield from circle_found(c, m, a, about, inside, int(c.points))
    fine, touches = yield from circle_found(c, m, a, rough.centre, inside, int(c.points))
    radius = c.radius - fine.radius if inside else fine.radius - c.radius
    if radius <= 0:
        said = f"{c.code} finds a ball of radius {radius:.4f}: the radius Q407 {c.radius:g} is not that of the figure"
        m.alarm(in_mm(said, m.variable_unit))
    yield Measure("radius", radius, m.tool.effective_radius, touches=touches)
    if m.settings["controlled_spindle"]:
        yield from oriented(m, 180.0)
        turned, touches = yield from circle_found(c, m, a, fine.centre, inside, 4)
        yield a.go("to the centre", x=fine.x, y=fine.y)
        yield from oriented(m)
        centre, other = (plane_of(m, m.to_machine((each.x, each.y, a.height))) for each in (fine, turned))
        yield from offset_written(m, centre, other, touches)
    yield from with_radius(m, radius)
    return fine.centre


def logged(c: ProbingCycle, m: Machine, steps: Moves) -> Moves:
    """A calibration, and its log: what stood in the tables and stands there now. A program has one log of all of them."""
    tool, probe, now = m.tool, m.tables.probe, time_of_day(m)
    yield from oriented(m)
    yield from steps
    rows = {
        "L": (tool.effective_length, m.tool.effective_length), "R": (tool.effective_radius, m.tool.effective_radius),
        "CAL_OF1": (probe.offset[0], m.tables.probe.offset[0]), "CAL_OF2": (probe.offset[1], m.tables.probe.offset[1]),
    }  # fmt: skip
    lines = [f"<h2>{c.code}</h2>", f"<p>{now:%d-%m-%Y %H:%M:%S}</p>" if now else "", f"<p>Tool {m.tool.number}</p>", "<table>"]
    lines += ["<tr><th></th><th>old</th><th>new</th></tr>"]
    lines += [f"<tr><th>{name}</th><td>{a:z.4f}</td><td>{b:z.4f}</td></tr>" for name, (a, b) in rows.items()]
    head = "" if FILE + LOG in m.logs.by_name else f"<!DOCTYPE html>\n<title>{LOG}</title>\n"
    yield Write("appended", head + "\n".join([line for line in lines if line] + ["</table>", ""]), LOG)
