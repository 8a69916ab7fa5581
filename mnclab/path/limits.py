"""What the axes of a machine can do, and how it takes corners and rapids."""

from __future__ import annotations

import math
from dataclasses import dataclass, fields
from typing import Any, NamedTuple

import numpy as np

from mnclab.path.places import spokes
from mnclab.path.toolpath import Array, Kind, Toolpath
from mnclab.text.alarm import Alarm
from mnclab.text.given import check_number, choice, fitting_class, of_python, plain, shown, whole
from mnclab.text.tables import written

PerAxis = float | tuple[float, ...]

CORNERS = {
    "tolerance": "a corner is cut by at most corner_tolerance, within the axes' acceleration (and jerk)",
    "deviation": "junction deviation: the speed of a circle that leaves the corner by corner_tolerance, within short rows",
    "grbl": "junction deviation as Grbl 1.1 has it, which on short rows asks the axes for more than they have",
    "jump": "no axis may change its speed at a corner by more than corner_jump",
}
RAPIDS = {
    "axes": "each axis at its own speed and acceleration, until it arrives",
    "proportional": "speeds in the ratio of the distances, each axis with its own acceleration",
    "line": "along the straight line, as a feed move at the greatest speed",
}
LEAST, MOST = 1e-3, 1e9  # of every limit, in its unit: beyond them a time is no number any more
PER_AXIS = ("rapid", "acceleration", "jerk", "corner_jump")
TRAVEL = "travel=((0, 400), (0, 300), (-200, 0)): from and to of X, Y and Z, machine coordinates of the spindle, mm"


@fitting_class
@dataclass(frozen=True)
class Limits:
    """Per axis, or one number for all: `rapid` mm/min, `acceleration` mm/s², `jerk` mm/s³ (None: no limit).

    `rapid` is the greatest speed of an axis, at feed too. `corner_speed` (`CORNERS`) says how fast a corner is
    taken, `corner_tolerance` mm how far it may be cut (0 stops wherever an axis would jump), `corner_jump` mm/min by
    how much the speed of an axis may jump under "jump". `rapid_motion` (`RAPIDS`) is how a rapid goes, None: as
    the control has it. `spindle` is the greatest speed, rev/min; `spindle_acceleration` rev/min in a second, None: at
    once; `tool_change` seconds. `look_ahead` is how many blocks beyond the one that it runs the control knows, each a row
    of the path: 0 stops after every block, None knows the whole program. `travel` holds how far each axis goes,
    `((x0, x1), (y0, y1), (z0, z1))` mm, in machine coordinates of the spindle reference (a lathe's X as radius; inf:
    without an end): a run stops where it is left.
    The defaults are those of a small machining centre whose spindle and tool changer take no time.

    An Alarm names a limit that makes no sense: each is from 0.001 to 1e9 in its unit, or 0 where that has a meaning.

    >>> mnc.Limits(rapid=(20000, 20000, 10000), acceleration=2000)
    Limits(rapid=(20000, 20000, 10000), acceleration=2000)
    """

    rapid: PerAxis = 10_000.0
    acceleration: PerAxis = 1_000.0
    jerk: PerAxis | None = None
    corner_tolerance: float = 0.0
    travel: tuple[tuple[float, float], ...] | None = None
    corner_speed: str = "tolerance"
    corner_jump: PerAxis = 0.0
    rapid_motion: str | None = None
    spindle: float = math.inf
    spindle_acceleration: float | None = None
    tool_change: float = 0.0
    look_ahead: int | None = None

    __repr__ = written

    def __post_init__(self) -> None:
        for each in fields(self):
            object.__setattr__(self, each.name, of_python(getattr(self, each.name)))
        for name in ("rapid", "acceleration", "jerk", "spindle", "spindle_acceleration"):
            if getattr(self, name) is not None or name not in ("jerk", "spindle_acceleration"):
                self._check(name, LEAST)
        for name in ("corner_tolerance", "corner_jump", "tool_change"):
            self._check(name, 0)
        if self.look_ahead is not None:
            self._check("look_ahead", 0)
            whole(self.look_ahead, "limit look_ahead")
        for name, known in (("corner_speed", (*CORNERS,)), ("rapid_motion", (*RAPIDS, None))):
            value = getattr(self, name)
            if not isinstance(value, str | None) or value not in known:
                names = ", ".join(each for each in known if each)
                raise Alarm(f"limit {name} must be one of {names}, got {shown(value)}")
        if self.travel is not None:
            self._check_travel(self.travel)
        for each in fields(self):
            object.__setattr__(self, each.name, plain(getattr(self, each.name)))

    def _check(self, name: str, least: float) -> None:
        value = getattr(self, name)
        many = name in PER_AXIS and isinstance(value, tuple | list)
        if many and len(value) not in (1, 3):
            raise Alarm(f"limit {name} takes one number or three (X Y Z), got {len(value)}")
        for each in value if many else (value,):
            above, endless = 0 if least else None, name == "spindle"
            check_number(each, f"limit {name}", above=above, at_least=least, at_most=MOST, endless=endless)

    def _check_travel(self, travel: Any) -> None:
        if not isinstance(travel, tuple | list) or len(travel) != 3:
            raise Alarm(f"limit travel takes a pair for each of X, Y and Z, got {shown(travel)}", hint=TRAVEL)
        for axis, pair in zip("XYZ", travel):
            if not isinstance(pair, tuple | list) or len(pair) != 2:
                raise Alarm(f"limit travel takes two positions for {axis}, got {shown(pair)}", hint=TRAVEL)
            for each in pair:
                check_number(each, f"limit travel of {axis}", endless=True)
            if not pair[0] < pair[1]:
                raise Alarm(f"limit travel of {axis} must go up, got {pair[0]:g} to {pair[1]:g}", hint=TRAVEL)

    def axes(self, name: str) -> Array:
        """A limit (3,) for X, Y, Z in mm and s; infinite where there is none."""
        value = getattr(self, choice(name, "the name of a limit of the axes", PER_AXIS))
        per_second = 60.0 if name in ("rapid", "corner_jump") else 1.0
        return np.broadcast_to(np.asarray(math.inf if value is None else value, np.float64), 3) / per_second


# How far the axes go: the first row of a path on which the spindle reference leaves the travel of the machine.
# The reference is the tool tip and the tool above it. It stands still where a row of kind TOOL moves the tip, so that the
# distance between both is the sum of those jumps. An arc is judged by its extent, not by its ends alone: along one axis it is
# the cosine of the angle, of amplitude r about the phase p, and the share of its pitch, d over the sweep S,
#     x(a) = r cos(a - p) + d a / S,    turning where sin(a - p) = d / (r S)
# and of several turns the first and the last such place are the farthest.

NOISE = 1e-6  # mm


class Beyond(NamedTuple):
    """A row that leaves the travel: which axis (0 to 2), and the position it would reach, mm."""

    row: int
    axis: int
    position: float


class Stopped(NamedTuple):
    """Where a machine stopped before it left its travel: `place` (3,) of the tip that it was led to, `depth` mm beyond."""

    place: tuple[float, float, float]
    depth: float
    alarm: Alarm


def stopped_at(path: Toolpath, found: Beyond, travel: Array, alarm: Alarm) -> Stopped:
    """The farthest place of a row that leaves the travel, in the coordinates of the path."""
    short, over = travel[found.axis, 0] - found.position, found.position - travel[found.axis, 1]
    low, high = extents(path[found.row : found.row + 1])
    place = path.end[found.row].copy()
    place[found.axis] = (low if short > over else high)[0, found.axis]
    x, y, z = place.tolist()
    return Stopped((x, y, z), float(max(short, over)), alarm)


def first_beyond(path: Toolpath, start: Array, travel: Array) -> Beyond | None:
    """The first row that leads out of `travel` (3, 2), mm; None if none does. `start` (3,) is the spindle reference
    before the path, machine coordinates; a machine that stands outside may return."""
    if not len(path):
        return None
    jump = np.where((path.kind == Kind.TOOL)[:, None], path.start - path.end, 0.0)
    offset = start - path.start[0] + np.cumsum(jump, axis=0)
    low, high = (each + offset for each in extents(path))
    short, over = travel[:, 0] - low, high - travel[:, 1]
    out = (np.maximum(short, over) > NOISE) & path.is_motion[:, None]
    if not out.any():
        return None
    row = int(out.any(axis=1).argmax())
    axis = int(np.argmax(np.where(out[row], np.maximum(short[row], over[row]), -np.inf)))
    return Beyond(row, axis, float((low if short[row, axis] > NOISE else high)[row, axis]))


def extents(path: Toolpath) -> tuple[Array, Array]:
    """The least and the greatest coordinates (n, 3) that each row reaches after its start."""
    low, high = path.end.copy(), path.end.copy()
    arcs = np.flatnonzero((path.kind == Kind.ARC) & (path.sweep != 0))
    if not len(arcs):
        return low, high
    axis, size = path.axis[arcs], np.abs(path.sweep[arcs])[:, None]
    spoke, across = spokes(path, arcs)
    across, middle = across * np.sign(path.sweep[arcs])[:, None], path.start[arcs] - spoke
    rise = np.einsum("ij,ij->i", path.end[arcs] - path.start[arcs], axis)[:, None] * axis
    amplitude, phase = np.hypot(spoke, across), np.arctan2(across, spoke)
    with np.errstate(divide="ignore", invalid="ignore"):
        tilt = np.arcsin(rise / (amplitude * size))  # nan where the pitch never turns back
    for turning in (phase + tilt, phase + np.pi - tilt):
        first = np.mod(turning, 2 * np.pi)
        for angle in (first, first + 2 * np.pi * np.floor((size - first) / (2 * np.pi))):
            place = middle + amplitude * np.cos(angle - phase) + rise * angle / size
            reached = (angle > 0) & (angle < size)  # false for nan
            low[arcs] = np.where(reached, np.minimum(low[arcs], place), low[arcs])
            high[arcs] = np.where(reached, np.maximum(high[arcs], place), high[arcs])
    return low, high
