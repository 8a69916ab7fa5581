"""Cycles 27, 28, 29 and 39: contours, slots and ridges on the surface of a cylinder (chapter 9).

All of them read one contour on the developed surface and machine it level by level (`tnc_620/machining/cylinder.py` says
how), each level being a distance of the tip from the axis of the cylinder. Before them and after them the tool is at the
height where it stood, at least at Q16 + Q6.

The axis of the cylinder is that rotary axis of the table which is square to the tool: under a tilted plane the one next to the
part, without the kinematics of a machine the one that carries the other ("rotary_axes"), unless the setting "cylinder_axis"
names one.
It passes through the active datum, as the manual asks. X of the contour is the coordinate of that axis, Y runs along it; a
mirror image of either mirrors the contour, and the shift of the rotary axis moves it.
"""

from __future__ import annotations

import math
from collections.abc import Generator, Iterator, Sequence
from functools import partial
from itertools import pairwise
from typing import Any, NamedTuple

import numpy as np

from mnclab.controls.tnc_620.contours.area import Labels
from mnclab.controls.tnc_620.contours.line import ContourLine, contour_line, with_labels
from mnclab.controls.tnc_620.cycles import addresses
from mnclab.controls.tnc_620.cycles.addresses import FAR, choice, distance, increment, length
from mnclab.controls.tnc_620.cycles.chain import TILT, rotary
from mnclab.controls.tnc_620.cycles.planes import ParameterFault, in_program_coordinates, not_zero, with_radius
from mnclab.controls.tnc_620.machining import cylinder as rolled
from mnclab.controls.tnc_620.state import memory
from mnclab.geometry.contours import Contour
from mnclab.geometry.curves import Floats
from mnclab.geometry.frames import IDENTITY
from mnclab.machine.control import Setting
from mnclab.machine.coordinates import AXES, MILLS, in_mm, remark
from mnclab.machine.cycle import Cycle, CycleTable, param, too_many, too_many_passes
from mnclab.machine.machine import Machine
from mnclab.machining.depths import infeeds
from mnclab.machining.milling.clearing import numbered
from mnclab.machining.steps import RAPID, Go, Rolled, Say, Step, Write
from mnclab.path.cylinder import Cylinder
from mnclab.path.listing import figure
from mnclab.path.toolpath import PathFault
from mnclab.text.alarm import Alarm

SETTINGS = (
    Setting(
        "cylinder_axis", "auto", "which rotary axis turns the cylinder of the cycles 27, 28, 29 and 39", "9.1",
        {"auto": "that of rotary_axes which is square to the tool", **{axis: f"the axis {axis}" for axis in AXES}},
    ),
    Setting(
        "cylinder_approach", "CircleTangential", "how cycles 28 and 39 come to a wall (apprDepCylWall, no. 201004)", "9.3, 9.5",
        {"CircleTangential": "on an arc that touches it", "LineNormal": "on a straight line square to it"},
    ),
    Setting("spindle_error", True, "28, 29 and 39 need a turning spindle (displaySpindleErr, no. 201002)", "9.3 to 9.5"),
)  # fmt: skip
SAME = 1e-9
OFF = 1e-6  # mm, of a datum beside the axis


class Surface(NamedTuple):
    """A cylinder in coordinates of the program, and how a contour lies on it.

    `across` (3,) is the direction of the circumference at the tool; `turned` rad is where the rotary axis stands at X0 of the
    contour; `mirrored` is -1 for each of u and y that a mirror image turns over.
    """

    cylinder: Cylinder
    across: Floats
    turned: float
    mirrored: tuple[int, int]

    def line(self, found: ContourLine) -> ContourLine:
        """A contour as it lies on the cylinder."""
        u, y = self.mirrored
        if u == y == 1:
            return found
        return found._replace(contour=found.contour.transformed(np.diag([u, y, 1])), side=found.side * u * y)

    def along(self, label: str, way: rolled.RolledWay, height: float, feed: float) -> Rolled:
        """Through the places of a way, with the tip at a distance from the axis; the tool is at the first one, if no way
        leads there."""
        k = slice(0 if way.ways[0] else 1, None)
        feet = way.feet[k]
        return Rolled(label, self.cylinder, self._tips(feet, way.shifts[k], height), self._angles(feet), way.ways[k], feed)

    def to(self, label: str, way: rolled.RolledWay, height: float, feed: float = RAPID, length: float = 1.0) -> Rolled:
        """Straight to the first place of a way; `length` mm is how far that is, at feed."""
        points = self._tips(way.feet[:1], way.shifts[:1], height)
        return Rolled(label, self.cylinder, points, self._angles(way.feet[:1]), np.array([length]), feed)

    def _angles(self, feet: Floats) -> Floats:
        return feet[:, 0] / self.cylinder.radius + self.turned

    def _tips(self, feet: Floats, shifts: Floats, height: float) -> Floats:
        across, along, out = self.across, np.array(self.cylinder.direction), np.array(self.cylinder.zero)
        return shifts[:, :1] * across + (feet + shifts)[:, 1:] * along + height * out


def surface_faults(m: Machine) -> Iterator[ParameterFault]:
    """Why no cylinder can be machined as the axes and frames stand."""
    linear = m.matrix[:3, :3]
    lengths = np.linalg.norm(linear, axis=0)
    if np.ptp(lengths) > SAME * lengths.max() or abs(linear.T @ linear - np.diag(lengths**2)).max() > SAME:
        yield "", "cannot run under unequal scales: the cylinder would not be round"
        return
    found, might, known = carrier(m), candidates(m), m.tables.kinematics
    if known is not None and m.turned is not None:  # coordinates do not lie on the part as they will while the cylinder turns
        stand = " ".join(f"{axis}{figure(math.degrees(m.rotary[AXES.index(axis)]))}" for axis in known.names)
        yield "", f"needs the plane tilted as the rotary axes stand, {stand}: write PLANE SPATIAL before, or turn them back"
        return
    if found is None and not might:
        yield "", f"needs a rotary table that turns the cylinder: the machine has {known}"
        return
    if found is None:
        what = f"needs a tool square to the rotary axis {' or '.join(might)}"
        yield "", f"{what}: the spindle axis is not perpendicular to the axis of the rotary table"
        return
    along, across, out = _directions(m, found)
    moved = m.matrix[:3, 3] - _preset(m)[:3, 3]
    if abs(out) < 1 - SAME or out < 0:
        yield "", "cannot run under a mirror image of the tool axis"
    elif abs(along) < 1 - SAME:
        yield "", f"cannot run under a rotation of the plane: Y lies along the axis {AXES[found]}"
    elif across < 0 and rotary(m)[1][found] > 0:
        yield "", f"cannot run under a mirror image across the cylinder alone: the axis {AXES[found]} must be mirrored, too"
    elif math.hypot(*np.delete(moved, found)) > OFF:
        way = math.hypot(*np.delete(moved, found))
        yield "", f"needs its datum on the axis of the cylinder, the shifts of the program move it {way:.4g} mm away"


def surface(m: Machine, radius: float) -> Surface:
    """The cylinder of a radius, where `surface_faults` finds nothing."""
    axis = carrier(m)
    assert axis is not None
    back = (m.matrix[:3, :3] / np.linalg.norm(m.matrix[:3, 0])).T
    along = np.eye(3)[axis]
    out = _tool(m)
    shift, sense = rotary(m)
    y = 1 if _directions(m, axis)[0] > 0 else -1
    direction, zero = ((float(a), float(b), float(c)) for a, b, c in (back @ along, back @ out))
    cylinder = Cylinder((0.0, 0.0, 0.0), direction, zero, radius, axis)
    return Surface(cylinder, back @ np.cross(along, out), math.radians(shift[axis]), (int(sense[axis]), y))


def carrier(m: Machine) -> int | None:
    """The number of the rotary axis of the cylinder; None where the tool is not square to it."""
    square = (AXES.index(axis) for axis in candidates(m) if abs(_tool(m)[AXES.index(axis)]) < SAME)
    return next(square, None)


def candidates(m: Machine) -> str:
    """The rotary axes that may turn the cylinder, those next to the part first: what a head turns is the tool."""
    wanted, known = m.settings["cylinder_axis"], m.tables.kinematics
    there = m.settings["rotary_axes"] if known is None else "".join(axis.name for axis in reversed(known.table))
    if wanted == "auto":
        return there[:1] if TILT in m.frames else there
    return wanted if known is None or wanted in there else ""


def _tool(m: Machine) -> Floats:
    """The direction (3,) of the tool from its tip to the spindle, in machine axes."""
    out = m.matrix[:3, 2]
    return np.asarray(out / np.linalg.norm(out))


def _preset(m: Machine) -> Floats:
    """The frame of the active datum, before the transformations of the program."""
    found = IDENTITY
    for name in m.frames.slots:
        found = found @ m.frames[name]
    return found


def _directions(m: Machine, axis: int) -> tuple[float, float, float]:
    """What mirrors and rotations make of the rotary axis, of the circumference and of the tool axis: 1 as they are, -1 turned
    over, between them turned."""
    plain = _preset(m)[:3, :3] @ m.frames[TILT][:3, :3]
    plain = plain / np.linalg.norm(plain[:, 0])
    changed = m.matrix[:3, :3] / np.linalg.norm(m.matrix[:3, 0]) @ plain.T
    along, out = np.eye(3)[axis], plain[:, 2]
    across = np.cross(along, out)
    return float(along @ changed @ along), float(across @ changed @ across), float(out @ changed @ out)


def developed_line(m: Machine, degrees: bool, on: Surface) -> Generator[Step, Any, ContourLine]:
    """The contour of cycle 14 on the developed surface, mm; its X is in `degrees` or in lengths of the program.

    Degrees become mm where the coordinate is read, so that roundings, chamfers, radii and tangents count in mm.
    """
    labels = memory(m).contour
    assert isinstance(labels, Labels)
    yield Write("memory", math.radians(on.cylinder.radius) / labels.unit if degrees else 1.0, "developed")
    found = yield from contour_line(m)
    yield Write("memory", None, "developed")
    return on.line(found)


# How cycles 27, 28, 29 and 39 go over a cylinder, level by level (9.2 to 9.5); heights are distances from its axis.

Ways = Sequence[tuple[str, rolled.RolledWay]]
SAME_ROUND = 1e-6  # mm between the end of a round and its begin


def over_contour(c: OnCylinder, on: Surface, line: ContourLine, radius: float, height: float) -> Iterator[Step]:
    """27: along the contour, the tool always pointing to the axis; on the contour itself where it has no side."""
    way = rolled.way_along(rolled.beside(line.contour, line.side * (radius + c.side_allowance), line.steps))
    yield from rounds(c, on, [("contour", way)], height, lifts=True)
    yield on.to("retract", way.last, height)


def along_slot(
    c: OnCylinder, on: Surface, line: ContourLine, shift: float, height: float, straight: bool, tolerance: float
) -> Iterator[Step]:
    """28: with RL forward along the wall on the right and back along the left one, `shift` beside the middle; with RR the other
    way round.

    Where remachining is asked for, more rounds at the floor follow, whose walls take their direction from deeper down.
    """
    distance = -line.side * shift
    ways = rolled.slot_round(line.contour, distance, straight, steps=line.steps)
    yield from rounds(c, on, ways, height)
    floor = c.levels()[-1]
    others = rolled.remachining(line.contour, distance, c.cylinder_radius, floor, tolerance)
    for name, at in zip(numbered("remachining", len(others)), others, strict=True):
        more = rolled.slot_round(rolled.shrunk(line.contour, at / c.cylinder_radius), distance, straight, c.cylinder_radius / at)
        yield from through(c, on, more, floor, name)
    yield on.to("retract", ways[-1][1].last, height)


def round_ridge(c: OnCylinder, on: Surface, line: ContourLine, half: float, radius: float, height: float) -> Iterator[Step]:
    """29: round the ridge, `half` as wide as it is, from a place one tool diameter beside it: with RL on the left, with RR on
    the right."""
    distance = line.side * (half + c.side_allowance + radius)
    loop = rolled.round_about(line.contour, distance, line.steps)
    gap = line.side * (radius - c.side_allowance)
    yield from with_leads(c, on, loop, rolled.way_along(loop, distance), gap, height, straight=False)


def beside_contour(c: OnCylinder, on: Surface, line: ContourLine, radius: float, height: float, straight: bool) -> Iterator[Step]:
    """39: along the wall, from a place one tool diameter beside it."""
    distance = line.side * (radius + c.side_allowance)
    path = rolled.beside(line.contour, distance, line.steps)
    gap = line.side * (radius - c.side_allowance)
    yield from with_leads(c, on, path, rolled.way_along(path, distance), gap, height, straight)


def with_leads(
    c: OnCylinder, on: Surface, path: Contour, way: rolled.RolledWay, gap: float, height: float, straight: bool
) -> Iterator[Step]:
    """Along a wall path from a place that lies `gap` to the left of its begin (or right), and to that beside its end."""
    there, off = (rolled.lead(path, gap, arrives, straight) for arrives in (True, False))
    foot, end = way.feet[0], way.feet[-1]
    ways = rolled.linked([("approach", rolled.standing(foot, there)), ("wall", way), ("departure", rolled.standing(end, off))])
    yield from rounds(c, on, ways, height)
    yield on.to("retract", ways[-1][1].last, height)


def rounds(c: OnCylinder, on: Surface, ways: Ways, height: float, lifts: bool = False) -> Iterator[Step]:
    """On every level through ways that follow each other, the first time from a `height` down.

    A round that ends where it began goes down there, unless it `lifts`; others go back over the surface.
    """
    first, last = ways[0][1], ways[-1][1].last
    gap = np.concatenate([last.feet[0] - first.feet[0], last.shifts[0] - first.shifts[0]])
    stays = not lifts and bool(np.abs(gap).max() < SAME_ROUND)
    levels = c.levels()
    for k, (name, (above, level)) in enumerate(zip(numbered("level", len(levels)), pairwise((c.safe, *levels)), strict=True)):
        if not (k and stays):
            yield on.to(f"{name}, over the start", first, c.safe if k else height)
            yield on.to(f"{name}, set-up clearance", first, c.safe)
            above = c.safe
        yield on.to(f"{name}, plunge", first, level, c.plunge_feed, above - level)
        yield from through(c, on, ways, level, name)
        if not stays:
            yield on.to(f"{name}, lift", last, c.safe)


def through(c: OnCylinder, on: Surface, ways: Ways, level: float, name: str) -> Iterator[Step]:
    """Through ways at one level."""
    for label, way in ways:
        yield on.along(f"{name}, {label}", way, level, c.feed)


# The cycles.

CYCLES = CycleTable()
SHARED = "depth side_allowance clearance infeed plunge_feed feed cylinder_radius dimension_type"
allowance = partial(increment, "Q3", "finishing allowance for side", example=0)
width = partial(param, "Q20", unit="mm", modal=True, above=0, example=12)
MOVES_A_LEVEL = 4  # of a level at least: in, along the contour, out, and back
IN: dict[float, str] = {0: "in degrees", 1: "in mm, or in inches"}


class OnCylinder(Cycle):
    """What the four share; who inherits says in `machine` what it does with a contour."""

    does = MILLS
    about = in_program_coordinates
    depth: float = increment("Q1", "milling depth from the surface to the floor", example=-8)
    side_allowance: float = allowance(note="on the side of the radius compensation")
    clearance: float = distance("Q6", "set-up clearance", note="of the tool tip over the cylinder", example=8)
    infeed: float = increment("Q10", "infeed per cut", example=4)
    plunge_feed: float = addresses.feed("Q11", "feed rate for plunging", also=addresses.PLANE, at_most=FAR, example=100)
    feed: float = addresses.feed("Q12", "feed rate for roughing", also=addresses.PLANE, at_most=FAR, example=350)
    cylinder_radius: float = length("Q16", "radius of the cylinder", example=25)
    dimension_type: float = choice("Q17", "type of dimension of the rotary axis", IN, example=0)
    sided = True

    def check(self, m: Machine) -> Iterator[ParameterFault]:
        yield from with_labels(m, single=True)
        yield from with_radius(m)
        yield from not_zero(self, "infeed", "plunge_feed", "feed", "cylinder_radius")
        if self.depth > 0:
            yield "depth", f"must be negative, got {self.depth:g}: the tool comes from outside, from inside is not built yet"
        if -self.depth >= self.cylinder_radius > 0:
            yield "depth", f"must be less deep than the radius Q16 = {self.cylinder_radius:g}, got {self.depth:g}"
        yield from [*too_many("infeed", self.levels)] or too_many_passes("infeed", len(self.levels()), MOVES_A_LEVEL)
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

    def machine(self, m: Machine, on: Surface, line: ContourLine, height: float) -> Iterator[Step]:
        """The steps over the cylinder, which end at the `height` that they begin at; a PathFault where the tool does not fit.

        Of itself nothing.
        """
        return iter(())


@CYCLES("CYCL DEF 27", "Cylinder surface", source="9.2", takes=SHARED)
class CylinderSurface(OnCylinder):
    """A contour rolled onto a cylinder; the tool always points to its axis, the rotary axis makes the whole way round."""

    sided = False

    def machine(self, m: Machine, on: Surface, line: ContourLine, height: float) -> Iterator[Step]:
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

    def check(self, m: Machine) -> Iterator[ParameterFault]:
        yield from super().check(m)
        if 0 < self.tolerance < 0.0001:
            yield "tolerance", f"must be 0 or at least 0.0001, got {self.tolerance:g}"
        if (free := self.slot_width - 2 * self.side_allowance) < 2 * m.radius - 1e-9:
            yield "slot_width", f"less Q3 on both walls is {free:g}, too narrow for the tool diameter {2 * m.radius:g}"

    def machine(self, m: Machine, on: Surface, line: ContourLine, height: float) -> Iterator[Step]:
        width = self.slot_width - 2 * self.side_allowance
        straight = m.settings["cylinder_approach"] == "LineNormal"
        return along_slot(self, on, line, width / 2 - m.radius, height, straight, self.tolerance)


@CYCLES("CYCL DEF 29", "Cylinder surface ridge", source="9.4", takes=f"{SHARED} ridge_width")
class CylinderRidge(OnCylinder):
    """A ridge about its midpoint path, with half circles at its ends: a groove as wide as the tool round it."""

    side_allowance: float = allowance(note="on the wall of the ridge")
    ridge_width: float = width(meaning="ridge width")

    def check(self, m: Machine) -> Iterator[ParameterFault]:
        yield from super().check(m)
        yield from room_for_approach(self, m)

    def machine(self, m: Machine, on: Surface, line: ContourLine, height: float) -> Iterator[Step]:
        half = self.ridge_width / 2
        du, dy = line.contour.ends[-1] - line.contour.points[0]
        if math.hypot(math.remainder(du, math.tau * self.cylinder_radius), dy) < half:
            what = "the midpoint path closes: a ridge has two ends, whose half circles would cut it"
            raise PathFault(what, int(line.steps[-1]), "let it end at least half the ridge width before its begin")
        return round_ridge(self, on, line, half, m.radius, height)


@CYCLES("CYCL DEF 39", "Cylinder surface contour", source="9.5", takes=SHARED)
class CylinderContour(OnCylinder):
    """A contour whose wall is parallel to the radial direction at the contour: the linear axes make the offset."""

    def check(self, m: Machine) -> Iterator[ParameterFault]:
        yield from super().check(m)
        yield from room_for_approach(self, m)

    def machine(self, m: Machine, on: Surface, line: ContourLine, height: float) -> Iterator[Step]:
        return beside_contour(self, on, line, m.radius, height, m.settings["cylinder_approach"] == "LineNormal")


def room_for_approach(c: OnCylinder, m: Machine) -> Iterator[ParameterFault]:
    """The tool starts two radii beside the wall, and the allowance leaves some of the way."""
    if c.side_allowance >= m.radius - 1e-9:
        yield "side_allowance", f"must be less than the tool radius {m.radius:g}, got {c.side_allowance:g}: no room to approach"
