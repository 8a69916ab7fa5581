"""The cylinder that the cycles 27, 28, 29 and 39 work on: its rotary axis, and how their contour lies about it (9.1).

Without the kinematics of a machine the axis of the cylinder is that rotary axis which is square to the tool: under a tilted
plane the one that carries the other ("rotary_axes"), else the first of the two, unless the setting "cylinder_axis" names one.
It passes through the active datum, as the manual asks. X of the contour is the coordinate of that axis, Y runs along it; a
mirror image of either mirrors the contour, and the shift of the rotary axis moves it.
"""

from __future__ import annotations

import math
from collections.abc import Generator, Iterator
from typing import Any, NamedTuple

import numpy as np

from mnclab.controls.tnc_620.contours.labels import Labels
from mnclab.controls.tnc_620.contours.line import Line, contour_line
from mnclab.controls.tnc_620.cycles.chain import TILT, rotary
from mnclab.controls.tnc_620.cycles.faults import Fault
from mnclab.controls.tnc_620.machining.cylinder import Way
from mnclab.controls.tnc_620.state import memory
from mnclab.geometry.curves import Floats
from mnclab.geometry.frames import IDENTITY
from mnclab.machine.control import Setting
from mnclab.machine.coordinates import AXES
from mnclab.machine.machine import Machine
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
