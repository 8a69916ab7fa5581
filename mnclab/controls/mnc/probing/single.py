"""Guarded positioning, and single touches along an axis, at an angle or along a vector (MNC 12.20 to 12.23).

They begin where the probe stands; X and Y are those of the spindle axis.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from functools import partial
from types import SimpleNamespace
from typing import Any

from mnclab.controls.mnc.cycles.addresses import choice, kind
from mnclab.controls.mnc.language import absolute
from mnclab.controls.mnc.probing.cycle import MeasuringCycle, Moves
from mnclab.machine.cycle import CycleTable, param
from mnclab.machine.machine import Machine
from mnclab.machine.touching import FEELS
from mnclab.machining.probing.sequences import numbers, results
from mnclab.machining.steps import Go, Measure, Touch

AXES: dict[float, str] = {1: "X", 2: "Y", 3: "Z"}
SENSES: dict[float, str] = {-1: "negative", 0: "no measurement", 1: "positive"}
SYSTEM: dict[float, str] = {0: "active workpiece system", 1: "machine system"}
to = kind(default=None, default_means="the axis does not move", note="a distance under G91")
component = kind("ratio", default=0)
Vector = tuple[float, float, float]
ALIKE = "max_distance retract feed system"
CYCLES = CycleTable(addresses=SimpleNamespace(
    max_distance=partial(param, "P", "greatest distance", incremental=True, note="negative: in the opposite direction",
                         example=20),
    retract=partial(param, "Q", "distance back", above=0, incremental=True, note="not beyond the start", example=2),
    feed=partial(
        param, "F", "measuring feed", "mm/min", default=None, default_means="that of the probe table", above=0, example=150
    ),
    system=partial(choice, "W", "coordinate system of the result", SYSTEM, 0, default=0),
), runs="definition")  # fmt: skip


@CYCLES("G490", "Guarded positioning of the probe", source="MNC 12.20")
class GuardedPositioning(MeasuringCycle):
    """A straight line at the positioning feed of the probe; what is in its way stops axes and program."""

    does, refused = FEELS, ()
    x: float | None = to("X", "coordinate along X", 20)
    y: float | None = to("Y", "coordinate along Y", 10)
    z: float | None = to("Z", "coordinate along Z", 5)

    def contradictions(self) -> Iterator[tuple[str, str]]:
        if self.x is self.y is self.z is None:
            yield "", "needs a place: write X, Y or Z"

    def moves(self, m: Machine) -> Moves:
        base = (0.0, 0.0, 0.0) if absolute(m) else m.programmed
        x, y, z = (None if at is None else at + b for at, b in zip((self.x, self.y, self.z), base, strict=True))
        yield Go("positioning", z, self.approach(m).positioning, x, y)


@CYCLES("G499", "Single measurement along one axis", source="MNC 12.21")
class AlongAxis(MeasuringCycle):
    """One touch along an axis, and back; the result is where the surface is, so that the radius of the ball counts."""

    does = FEELS
    dir_x: float = choice("X", "direction along X", SENSES, 0, default=0)
    dir_y: float = choice("Y", "direction along Y", SENSES, 0, default=0)
    dir_z: float = choice("Z", "direction along Z", SENSES, -1, default=0)

    @property
    def way(self) -> Vector:
        return self.dir_x, self.dir_y, self.dir_z

    def contradictions(self) -> Iterator[tuple[str, str]]:
        names = [name for name in ("dir_x", "dir_y", "dir_z") if getattr(self, name)]
        if not names:
            yield "", "needs a direction: write X, Y or Z as 1 or -1"
        elif len(names) > 1:
            yield names[1], f"must be 0: G499 measures along one axis, and {names[0][-1].upper()} has a direction"

    def moves(self, m: Machine) -> Moves:
        a, begin = self.approach(m), m.programmed
        k = next(k for k in range(3) if self.way[k])
        x, y, z = (here + a.reach * sense for here, sense in zip(begin, self.way, strict=True))
        contacts = []
        for _ in range(int(m.settings["measurements_per_point"])):
            contacts.append((yield Touch("touch", x, y, z, a.feed, a.ball)))
            yield a.go("back", begin[2], *begin[:2])
        found = math.fsum(contact.point[k] for contact in contacts) / len(contacts) + self.way[k] * a.ball
        yield Measure("XYZ"[k], found, touches=numbers(contacts))
        yield from results(Q312=found)


def somewhere(c: Any) -> Iterator[tuple[str, str]]:
    """A touch that goes nowhere."""
    if not c.max_distance:
        yield "max_distance", "must not be 0: it is the greatest distance of the touch"


@CYCLES("G491", "Single measurement at an angle", source="MNC 12.22", takes=f"axis angle {ALIKE}")
class AtAngle(MeasuringCycle):
    """A touch at an angle to an axis: L1 in XY from +X, L2 in YZ from +Y, L3 in ZX from +Z."""

    does = FEELS
    axis: float = choice("L", "axis from which the angle counts", AXES, 3)
    angle: float = param("E", "angle to that axis", "deg", default=0, at_least=-180, at_most=180, example=180)

    contradictions = somewhere

    def moves(self, m: Machine) -> Moves:
        cos, sin = math.cos(math.radians(self.angle)), math.sin(math.radians(self.angle))
        ways = {1: (cos, sin, 0.0), 2: (0.0, cos, sin), 3: (sin, 0.0, cos)}
        flat = self.axis == 2 and m.settings["g491_l2_plane"] == "XY"
        yield from touched_along(self, m, (-sin, cos, 0.0) if flat else ways[int(self.axis)])


@CYCLES("G492", "Single measurement along a vector", source="MNC 12.23", takes=f"vx vy vz {ALIKE}")
class AlongVector(MeasuringCycle):
    """A touch along a vector, whose length does not matter."""

    does = FEELS
    vx: float = component("X", "component along X", 0)
    vy: float = component("Y", "component along Y", 0)
    vz: float = component("Z", "component along Z", -1)

    def contradictions(self) -> Iterator[tuple[str, str]]:
        yield from somewhere(self)
        if not any((self.vx, self.vy, self.vz)):
            yield "", "needs a direction: write X, Y or Z other than 0"

    def moves(self, m: Machine) -> Moves:
        yield from touched_along(self, m, (self.vx, self.vy, self.vz))


def touched_along(c: Any, m: Machine, way: Vector) -> Moves:
    """Towards a direction, then back at rapid; offsets, radius and length correction do not count."""
    begin, length = m.programmed, math.copysign(math.hypot(*way), c.max_distance)
    unit = [each / length for each in way]
    x, y, z = (here + abs(c.max_distance) * u for here, u in zip(begin, unit, strict=True))
    contact = yield Touch("touch", x, y, z, m.tables.probe.feed if c.feed is None else c.feed)
    back = min(c.retract, math.dist(m.programmed, begin))
    x, y, z = (here - back * u for here, u in zip(m.programmed, unit, strict=True))
    yield Go("back", z, x=x, y=y)
    more = m.tool.dl if m.settings["raw_z"] == "tip" else m.tool.effective_length
    place = contact.tip[0], contact.tip[1], contact.tip[2] + more
    found = place if c.system else m.to_program(place)
    for axis, value in zip("XYZ", found, strict=True):
        yield Measure(axis, value, touches=numbers([contact]))
    yield from results(Q314=found[0], Q315=found[1], Q312=found[2])
