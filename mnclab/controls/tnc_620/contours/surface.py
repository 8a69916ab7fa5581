"""The cylinder that the cycles 27, 28, 29 and 39 work on: its rotary axis, and how their contour lies about it (9.1).

Without the kinematics of a machine the axis of the cylinder is that rotary axis which is square to the tool: under a tilted
plane the one that carries the other ("rotary_axes"), else the first of the two, unless the setting "cylinder_axis" names one.
It passes through the active datum, as the manual asks. X of the contour is the coordinate of that axis, Y runs along it; a
mirror image of either mirrors the contour, and the shift of the rotary axis moves it.
"""

from __future__ import annotations

import math
from collections.abc import Generator, Iterator, Sequence
from itertools import pairwise
from typing import Any, NamedTuple, Protocol

import numpy as np

from mnclab.controls.tnc_620.contours.data import Labels
from mnclab.controls.tnc_620.contours.line import Line, contour_line
from mnclab.controls.tnc_620.cycles.chain import TILT, rotary
from mnclab.controls.tnc_620.cycles.planes import Fault
from mnclab.controls.tnc_620.machining.cylinder import (
    Way,
    beside,
    lead,
    linked,
    remachining,
    round_about,
    shrunk,
    slot_round,
    standing,
    way_along,
)
from mnclab.controls.tnc_620.state import memory
from mnclab.geometry.contours import Contour
from mnclab.geometry.curves import Floats
from mnclab.geometry.frames import IDENTITY
from mnclab.machine.control import Setting
from mnclab.machine.coordinates import AXES
from mnclab.machine.machine import Machine
from mnclab.machining.milling.clearing import numbered
from mnclab.machining.steps import RAPID, Rolled, Step, Write
from mnclab.path.cylinder import Cylinder

SETTINGS = (
    Setting(
        "cylinder_axis", "auto", "which rotary axis turns the cylinder of the cycles 27, 28, 29 and 39", "9.1",
        {"auto": "that of rotary_axes which is square to the tool", **{axis: f"the axis {axis}" for axis in AXES}},
    ),
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

    def line(self, found: Line) -> Line:
        """A contour as it lies on the cylinder."""
        u, y = self.mirrored
        if u == y == 1:
            return found
        return found._replace(contour=found.contour.transformed(np.diag([u, y, 1])), side=found.side * u * y)

    def along(self, label: str, way: Way, height: float, feed: float) -> Rolled:
        """Through the places of a way, with the tip at a distance from the axis; the tool is at the first one, if no way
        leads there."""
        k = slice(0 if way.ways[0] else 1, None)
        feet = way.feet[k]
        return Rolled(label, self.cylinder, self._tips(feet, way.shifts[k], height), self._angles(feet), way.ways[k], feed)

    def to(self, label: str, way: Way, height: float, feed: float = RAPID, length: float = 1.0) -> Rolled:
        """Straight to the first place of a way; `length` mm is how far that is, at feed."""
        points = self._tips(way.feet[:1], way.shifts[:1], height)
        return Rolled(label, self.cylinder, points, self._angles(way.feet[:1]), np.array([length]), feed)

    def _angles(self, feet: Floats) -> Floats:
        return feet[:, 0] / self.cylinder.radius + self.turned

    def _tips(self, feet: Floats, shifts: Floats, height: float) -> Floats:
        across, along, out = self.across, np.array(self.cylinder.direction), np.array(self.cylinder.zero)
        return shifts[:, :1] * across + (feet + shifts)[:, 1:] * along + height * out


def surface_faults(m: Machine) -> Iterator[Fault]:
    """Why no cylinder can be machined as the axes and frames stand."""
    linear = m.matrix[:3, :3]
    lengths = np.linalg.norm(linear, axis=0)
    if np.ptp(lengths) > SAME * lengths.max() or abs(linear.T @ linear - np.diag(lengths**2)).max() > SAME:
        yield "", "cannot run under unequal scales: the cylinder would not be round"
        return
    found = carrier(m)
    if found is None:
        axis = m.settings["cylinder_axis"]
        pair = m.settings["rotary_axes"]
        what = f"the axis {axis}" if axis != "auto" else f"one of the rotary axes {pair[0]} and {pair[1]}"
        if axis == "auto" and TILT in m.frames:
            what = f"the rotary axis {pair[0]}, which carries {pair[1]}"
        yield "", f"needs a tool square to {what}: the spindle axis is not perpendicular to the axis of the rotary table"
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
    wanted, pair = m.settings["cylinder_axis"], m.settings["rotary_axes"]
    choice = wanted if wanted != "auto" else pair[0] if TILT in m.frames else pair
    square = (AXES.index(axis) for axis in choice if abs(_tool(m)[AXES.index(axis)]) < SAME)
    return next(square, None)


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


def developed_line(m: Machine, degrees: bool, on: Surface) -> Generator[Step, Any, Line]:
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

Ways = Sequence[tuple[str, Way]]
SAME_ROUND = 1e-6  # mm between the end of a round and its begin


class Depths(Protocol):
    """What the walls ask of a cycle: heights, feeds and the allowance."""

    @property
    def side_allowance(self) -> float: ...
    @property
    def plunge_feed(self) -> float: ...
    @property
    def feed(self) -> float: ...
    @property
    def cylinder_radius(self) -> float: ...
    @property
    def safe(self) -> float: ...
    def levels(self) -> tuple[float, ...]: ...


def over_contour(c: Depths, on: Surface, line: Line, radius: float, height: float) -> Iterator[Step]:
    """27: along the contour, the tool always pointing to the axis; on the contour itself where it has no side."""
    way = way_along(beside(line.contour, line.side * (radius + c.side_allowance), line.steps))
    yield from rounds(c, on, [("contour", way)], height, lifts=True)
    yield on.to("retract", way.last, height)


def along_slot(
    c: Depths, on: Surface, line: Line, shift: float, height: float, straight: bool, tolerance: float
) -> Iterator[Step]:
    """28: with RL forward along the wall on the right and back along the left one, `shift` beside the middle; with RR the other
    way round.

    Where remachining is asked for, more rounds at the floor follow, whose walls take their direction from deeper down.
    """
    distance = -line.side * shift
    ways = slot_round(line.contour, distance, straight, steps=line.steps)
    yield from rounds(c, on, ways, height)
    floor = c.levels()[-1]
    others = remachining(line.contour, distance, c.cylinder_radius, floor, tolerance)
    for name, at in zip(numbered("remachining", len(others)), others, strict=True):
        more = slot_round(shrunk(line.contour, at / c.cylinder_radius), distance, straight, c.cylinder_radius / at)
        yield from through(c, on, more, floor, name)
    yield on.to("retract", ways[-1][1].last, height)


def round_ridge(c: Depths, on: Surface, line: Line, half: float, radius: float, height: float) -> Iterator[Step]:
    """29: round the ridge, `half` as wide as it is, from a place one tool diameter beside it: with RL on the left, with RR on
    the right."""
    distance = line.side * (half + c.side_allowance + radius)
    loop = round_about(line.contour, distance, line.steps)
    gap = line.side * (radius - c.side_allowance)
    yield from with_leads(c, on, loop, way_along(loop, distance), gap, height, straight=False)


def beside_contour(c: Depths, on: Surface, line: Line, radius: float, height: float, straight: bool) -> Iterator[Step]:
    """39: along the wall, from a place one tool diameter beside it."""
    distance = line.side * (radius + c.side_allowance)
    path = beside(line.contour, distance, line.steps)
    yield from with_leads(c, on, path, way_along(path, distance), line.side * (radius - c.side_allowance), height, straight)


def with_leads(
    c: Depths, on: Surface, path: Contour, way: Way, gap: float, height: float, straight: bool
) -> Iterator[Step]:
    """Along a wall path from a place that lies `gap` to the left of its begin (or right), and to that beside its end."""
    there, off = (lead(path, gap, arrives, straight) for arrives in (True, False))
    foot, end = way.feet[0], way.feet[-1]
    ways = linked([("approach", standing(foot, there)), ("wall", way), ("departure", standing(end, off))])
    yield from rounds(c, on, ways, height)
    yield on.to("retract", ways[-1][1].last, height)


def rounds(c: Depths, on: Surface, ways: Ways, height: float, lifts: bool = False) -> Iterator[Step]:
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


def through(c: Depths, on: Surface, ways: Ways, level: float, name: str) -> Iterator[Step]:
    """Through ways at one level."""
    for label, way in ways:
        yield on.along(f"{name}, {label}", way, level, c.feed)
