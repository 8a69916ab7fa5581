"""Datums that are probed: the base rotation of a side, slots, ridges, pockets, bores and bosses, corners (MNC 12.1 to 12.13)."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import ClassVar

from mnclab.controls.mnc.probing import addresses
from mnclab.controls.mnc.probing.addresses import APPROACH, SIDE, TOP
from mnclab.controls.mnc.probing.cycle import (
    TURNS,
    Check,
    MeasuringCycle,
    Moves,
    base_rotation,
    box,
    conclude,
    middle,
    ring,
    store_angle,
    turn_base,
    unplaced,
)
from mnclab.machine.coordinates import NOTHING
from mnclab.machine.cycle import CycleTable, Given, Values
from mnclab.machine.machine import Machine
from mnclab.machining.probing.fits import corner, line, reduced
from mnclab.machining.probing.found import sketch
from mnclab.machining.probing.sequences import Aim, Approach, Pair, Steps, from_above, in_plane, numbers, results
from mnclab.machining.probing.sequences import corner as corner_touches
from mnclab.machining.steps import Measure, Say
from mnclab.text.alarm import Alarm

# The angle of a straight side: measured, or given as the base rotation (MNC 12.1, 12.2, 12.13).

CYCLES = CycleTable(addresses=addresses, runs="definition")
ASKEW = 45.0  # degrees: a side that lies farther off its line was probably measured against the wrong one


def along_the_axis(c: MeasuringCycle) -> Iterator[tuple[str, str]]:
    """Two points that are one along the side."""
    for axis, name, first, second in ((1, "y2", c.y, c.y2), (2, "x2", c.x, c.x2)):
        if c.axis == axis and first == second:
            yield name, f"must differ from {name[0].upper()}, got {second:g}: both points are one along the side"


def touched(c: MeasuringCycle, m: Machine) -> Steps:
    """The angle of a side, that of a line without a direction (MNC-G400-UNDIRECTED, MNC-G420-RANGE), and the contacts."""
    a, way = c.approach(m), (c.direction, 0.0) if c.axis == 1 else (0.0, c.direction)
    points = (c.x, c.y), (c.x2, c.y2)
    contacts = yield from in_plane(a, [Aim(x, y, way) for x, y in points], m.programmed[2])
    side = line([contact.point[:2] for contact in contacts]).towards(way, a.ball)
    yield sketch(points, [side.foot(contact.point) for contact in contacts], a.level, contacts)
    return side.angle % 180 if c.axis == 1 else reduced(side.angle), contacts


@CYCLES("G400", "Align the plane to a straight side", source="MNC 12.1", takes=f"{SIDE} reference_angle row")
class Alignment(MeasuringCycle):
    """Two touches of a side, without the base rotation; its angle to a reference line becomes the base rotation.

    The datum point stays.
    """

    refused, contradictions = TURNS, along_the_axis
    x: float = addresses.x(meaning="X of the first measuring point", example=20)
    y: float = addresses.y(meaning="Y of the first measuring point", example=0)
    axis: float = addresses.axis(example=2)
    between: float = addresses.between(("P", "R"))
    reference_angle: float = addresses.angle("E", "angle of the reference line to X", 0)
    row: float = addresses.row(note="gets the angle; 0: it is not saved")

    @classmethod
    def prepare(cls, values: Values, given: Given, m: Machine, kept: Values) -> Values:
        if "between" in given and given["between"].address == "R":  # MNC-G400-PR
            m.warn("G400 R means P: the format has P, the list of the manual R", given["between"])
        return values

    def moves(self, m: Machine) -> Moves:
        if base_rotation(m):
            yield from turn_base(0.0)
        angle, contacts = yield from touched(self, m)
        turned = reduced(angle - self.reference_angle)
        yield Measure("angle", angle, self.reference_angle, unit="deg", touches=numbers(contacts))
        yield Measure("base rotation", turned, unit="deg")
        if abs(turned) > ASKEW:
            yield Say(f"turns the plane by {turned:.4g} degrees", "E90 is the reference line of a side along Y")
        yield from turn_base(turned)
        yield from store_angle(m, self.row, turned)


@CYCLES("G420", "Measure an angle in the XY plane", source="MNC 12.13", takes=f"{SIDE} protocol")
class Angle(MeasuringCycle):
    """Two touches of a straight side give its angle to X; a base rotation stays, and the angle counts from its X."""

    contradictions = along_the_axis
    x: float = addresses.x(meaning="X of the first measuring point", example=20)
    y: float = addresses.y(meaning="Y of the first measuring point", example=0)
    axis: float = addresses.axis(example=2)
    protocol: float = addresses.protocol("M")

    def moves(self, m: Machine) -> Moves:
        angle, contacts = yield from touched(self, m)
        yield from results(Q319=angle)
        yield from conclude(self, m, contacts, Check(Measure("angle", angle, unit="deg")))


@CYCLES("G404", "Set the base rotation", source="MNC 12.2", takes="angle row")
class BaseRotation(MeasuringCycle):
    """The given angle replaces the base rotation; nothing moves, and no probe is needed. E0 cancels it."""

    does: ClassVar[str] = NOTHING

    angle: float = addresses.turn("E", "angle of the base rotation", 30)
    row: float = addresses.row(note="gets the angle; 0: it is not saved")

    def check(self, m: Machine) -> Iterator[tuple[str, str]]:
        yield from unplaced(m)

    def moves(self, m: Machine) -> Moves:
        yield from turn_base(self.angle)
        yield from store_angle(m, self.row, self.angle)


# Datums from a slot, a ridge, a pocket, an island, a bore, a boss, or a single touch (MNC 12.3 to 12.8, 12.11, 12.12).

CENTRE = f"{APPROACH} between row x_new y_new {TOP}"


def middle_datum(c: MeasuringCycle, m: Machine) -> Moves:
    """The middle of a slot or a ridge."""
    a, k, centre = c.approach(m), int(c.axis) - 1, (c.x, c.y)
    found, width, contacts = yield from middle(a, centre, c.width, k, c.inside, m.programmed[2])
    yield Measure("width", width, c.width, touches=numbers(contacts))
    yield Measure(f"centre {'XY'[k]}", found, centre[k], touches=numbers(contacts))
    yield from c.finish(m, a, {k: (found, c.new_coordinate)})


@CYCLES(
    "G408", "Datum at the centre of a slot", source="MNC 12.3",
    takes=f"x y width axis {APPROACH} between row new_coordinate {TOP}",
)  # fmt: skip
class DatumInSlot(MeasuringCycle):
    """Two touches from within along an axis; the middle gets the coordinate U of that axis."""

    refused, entered = TURNS, ("width",)
    width: float = addresses.width(meaning="width of the slot, rather too small")
    moves = middle_datum


@CYCLES(
    "G409", "Datum at the centre of a ridge", source="MNC 12.4", takes=f"x y width axis {APPROACH} row new_coordinate {TOP}"
)  # fmt: skip
class DatumOnRidge(MeasuringCycle):
    """Two touches from outside along an axis, over the safe height (MNC-G409-NOP); the middle gets the coordinate U."""

    refused, inside, between = TURNS, False, 1.0
    width: float = addresses.width(meaning="width of the ridge, rather too large")
    moves = middle_datum


def box_datum(c: MeasuringCycle, m: Machine) -> Moves:
    """The centre of a rectangle."""
    a = c.approach(m)
    lengths = c.length_x, c.length_y
    found, contacts = yield from box(a, (c.x, c.y), lengths, c.inside, m.programmed[2])
    yield Measure("length X", found.length, c.length_x, touches=numbers(contacts[:2]))
    yield Measure("length Y", found.width, c.length_y, touches=numbers(contacts[2:]))
    yield from centre_datum(c, m, a, found.centre, numbers(contacts))


@CYCLES("G410", "Datum at the centre of a pocket", source="MNC 12.5", takes=f"x y length_x length_y {CENTRE}")
class DatumInPocket(MeasuringCycle):
    """Four touches of a rectangular pocket along the axes, whose lengths are given rather too small; its centre gets U and V."""

    refused, entered = TURNS, ("length_x", "length_y")
    moves = box_datum


@CYCLES("G411", "Datum at the centre of an island", source="MNC 12.6", takes=f"x y length_x length_y {CENTRE}")
class DatumOnIsland(MeasuringCycle):
    """Four touches of a rectangular island along the axes, whose lengths are given rather too large; its centre gets U and V."""

    refused, inside = TURNS, False
    moves = box_datum


def ring_datum(c: MeasuringCycle, m: Machine) -> Moves:
    """The centre of a circle."""
    a = c.approach(m)
    found, contacts = yield from ring(a, (c.x, c.y), c.diameter, c.inside, m.programmed[2])
    yield Measure("diameter", found.diameter, c.diameter, touches=numbers(contacts))
    yield from centre_datum(c, m, a, found.centre, numbers(contacts))


@CYCLES("G412", "Datum at the centre of a bore", source="MNC 12.7", takes=f"x y diameter {CENTRE}")
class DatumInBore(MeasuringCycle):
    """Four touches of a bore or circular pocket along the axes, given rather too small; its centre gets U and V."""

    refused, entered = TURNS, ("diameter",)
    moves = ring_datum


@CYCLES("G413", "Datum at the centre of a boss", source="MNC 12.8", takes=f"x y diameter {CENTRE}")
class DatumOnBoss(MeasuringCycle):
    """Four touches of a circular island along the axes, given rather too large; its centre gets U and V."""

    refused, inside = TURNS, False
    moves = ring_datum


@CYCLES("G417", "Datum along Z", source="MNC 12.11", takes="x y nominal_z clearance height row z_new apply")
class DatumAlongZ(MeasuringCycle):
    """One touch downwards, past the nominal point until the surface; it gets the coordinate R."""

    refused = TURNS
    x: float = addresses.x(meaning="X of the measuring point")
    y: float = addresses.y(meaning="Y of the measuring point")
    nominal_z: float = addresses.coordinate("Z", "nominal Z of the measuring point", 0)
    z_new: float = addresses.z_new(meaning="Z of the measured point in the new system")

    def low(self, a: Approach) -> Iterator[tuple[str, str]]:
        return self.below(a, self.nominal_z + a.gap)

    def moves(self, m: Machine) -> Moves:
        a = self.approach(m)
        contact = yield from from_above(a, self.x, self.y, self.nominal_z, m.programmed[2])
        z = contact.point[2] - a.ball
        yield Measure("Z", z, self.nominal_z, touches=(contact.number,))
        yield from self.finish(m, a, {2: (z, self.z_new)})


@CYCLES("G419", "Datum along X or Y", source="MNC 12.12", takes=f"x y axis direction {APPROACH} row new_coordinate apply")
class DatumAlongAxis(MeasuringCycle):
    """One touch of a side; the touched surface gets the coordinate U of the axis."""

    refused = TURNS
    x: float = addresses.x(meaning="X of the measuring point", example=0)
    y: float = addresses.y(meaning="Y of the measuring point")
    new_coordinate: float = addresses.new_coordinate(meaning="coordinate of the point in the new system")

    def moves(self, m: Machine) -> Moves:
        a, k, sense = self.approach(m), int(self.axis) - 1, self.direction
        way = (sense, 0.0) if k == 0 else (0.0, sense)
        (contact,) = yield from in_plane(a, [Aim(self.x, self.y, way)], m.programmed[2])
        found = contact.point[k] + sense * a.ball
        yield Measure("XY"[k], found, (self.x, self.y)[k], touches=(contact.number,))
        yield from self.finish(m, a, {k: (found, self.new_coordinate)})


def centre_datum(c: MeasuringCycle, m: Machine, a: Approach, found: Sequence[float], touches: Sequence[int]) -> Moves:
    """Both coordinates of a centre; two touches each."""
    yield Measure("centre X", found[0], c.x, touches=tuple(touches[:2]))
    yield Measure("centre Y", found[1], c.y, touches=tuple(touches[2:]))
    yield from c.finish(m, a, {0: (found[0], c.x_new), 1: (found[1], c.y_new)})


# Datums at the corner of two sides, outside and inside (MNC 12.9, 12.10).
# Points 1 and 2 lie side by side along X and are measured along Y, points 3 and 4 the other way (MNC-G414-YFIRST). The turn of
# the part is the angle of the first side to X; it is added to the base rotation that it was measured in.

CORNER = f"{APPROACH} between rotate row x_new y_new {TOP}"
CORNERS: dict[float, str] = {1: "lower left", 2: "lower right", 3: "upper right", 4: "upper left"}
INTO: dict[float, Pair] = {1: (1, 1), 2: (-1, 1), 3: (-1, -1), 4: (1, -1)}  # from the corner into the pocket


@CYCLES(
    "G414", "Datum at an outside corner", source="MNC 12.9", takes=f"x y distance_12 x3 y3 distance_34 {CORNER}"
)  # fmt: skip
class DatumAtOutsideCorner(MeasuringCycle):
    """Two touches of each side; points 1 and 3 say which corner is meant. It gets the coordinates U and V."""

    refused = TURNS
    x: float = addresses.x(meaning="X of the first point", example=20)
    y: float = addresses.y(meaning="Y of the first point", example=0)
    distance_12: float = addresses.spacing("A", "distance from point 1 to 2 along X", 60)
    x3: float = addresses.coordinate("C", "X of the third point", 0)
    y3: float = addresses.coordinate("D", "Y of the third point", 15)
    distance_34: float = addresses.spacing("B", "distance from point 3 to 4 along Y", 30)

    @property
    def senses(self) -> Pair:
        """Into the material: along X for points 3 and 4, along Y for points 1 and 2."""
        return math.copysign(1.0, self.x - self.x3), math.copysign(1.0, self.y3 - self.y)

    def points(self, m: Machine) -> tuple[Pair, Pair, Pair, Pair]:
        sx, sy = self.senses if m.settings["corner_spacing"] == "away" else (1.0, 1.0)
        second, fourth = self.x + sx * self.distance_12, self.y3 + sy * self.distance_34
        return (self.x, self.y), (second, self.y), (self.x3, self.y3), (self.x3, fourth)

    def contradictions(self) -> Iterator[tuple[str, str]]:
        yield from super().contradictions()
        if self.x == self.x3:
            yield "x3", f"must differ from X, got {self.x3:g}: it says on which side the corner lies"
        if self.y == self.y3:
            yield "y3", f"must differ from Y, got {self.y3:g}: it says on which side the corner lies"

    def check(self, m: Machine) -> Iterator[tuple[str, str]]:
        yield from super().check(m)
        (sx, sy), ((_, y), (x2, _), (x3, _), (_, y4)) = self.senses, self.points(m)
        if sx < 0 and x2 >= x3:
            yield "distance_12", f"puts point 2 at X{x2:g}, at or beyond the other side, X{x3:g}"
        if sy < 0 and y4 >= y:
            yield "distance_34", f"puts point 4 at Y{y4:g}, at or beyond the other side, Y{y:g}"

    def moves(self, m: Machine) -> Moves:
        (sx, sy), points, a = self.senses, self.points(m), self.approach(m)
        first, second = [Aim(*point, (0.0, sy)) for point in points[:2]], [Aim(*point, (sx, 0.0)) for point in points[2:]]
        nominal = points[1], (self.x3, self.y), points[3]
        yield from corner_datum(self, m, a, first, second, nominal)


@CYCLES(
    "G415", "Datum at an inside corner", source="MNC 12.10", takes=f"x y distance_12 distance_14 corner {CORNER}"
)  # fmt: skip
class DatumAtInsideCorner(MeasuringCycle):
    """Two touches of each side, the first and the third from one place (MNC-G415-B). The corner gets U and V."""

    refused = TURNS
    x: float = addresses.x(meaning="X of the first point", example=10)
    y: float = addresses.y(meaning="Y of the first point", example=0)
    distance_12: float = addresses.spacing("A", "distance from point 1 to 2 along X", 60)
    distance_14: float = addresses.spacing("B", "distance from point 1 to 4 along Y", 40)
    corner: float = addresses.choice("C", "number of the corner", CORNERS, 1)

    def check(self, m: Machine) -> Iterator[tuple[str, str]]:
        yield from super().check(m)
        if self.distance_14 <= (away := self.approach(m).away):
            yield "distance_14", f"must be greater than the way from point 1 to its start, {away:g}, got {self.distance_14:g}"

    def moves(self, m: Machine) -> Moves:
        a, (ux, uy) = self.approach(m), INTO[self.corner]
        begin = self.y + uy * a.away
        down, aside = (0.0, -uy), (-ux, 0.0)
        first = [Aim(self.x, begin, down, 0.0), Aim(self.x + ux * self.distance_12, begin, down, 0.0)]
        second = [Aim(self.x, begin, aside, 0.0), Aim(self.x, self.y + uy * self.distance_14, aside, 0.0)]
        yield from corner_datum(self, m, a, first, second)


def corner_datum(
    cycle: DatumAtOutsideCorner | DatumAtInsideCorner, m: Machine, a: Approach, first: Sequence[Aim], second: Sequence[Aim],
    nominal: Sequence[Pair] = (),
) -> Moves:  # fmt: skip
    """Where the lines through both pairs of contacts cross, each moved along its normal to the material.

    `nominal` are points 2 and 4, and between them the corner, where the cycle knows them.
    """
    contacts = yield from corner_touches(a, first, second, m.programmed[2])
    pairs = (contacts[:2], first[0].direction), (contacts[2:], second[0].direction)
    lines = [line([each.point[:2] for each in pair]).towards(way, a.ball) for pair, way in pairs]
    try:
        found = corner(*lines)
    except Alarm as alarm:
        m.alarm(f"{cycle.code}: {alarm.message}")
    angle, touches = reduced(lines[0].angle), numbers(contacts)
    ends = [side.foot(pair[1].point) for side, (pair, _) in zip(lines, pairs, strict=True)]
    actual = ends[0], (found.x, found.y), ends[1]
    yield sketch(nominal or actual, actual, a.level, contacts)
    for name, value, k in (("X", found.x, 0), ("Y", found.y, 1)):
        yield Measure(f"corner {name}", value, nominal[1][k] if nominal else math.nan, touches=touches)
    yield Measure("angle", angle, 0.0, unit="deg", touches=touches[:2])
    gets = {0: (found.x, cycle.x_new), 1: (found.y, cycle.y_new)}
    yield from cycle.finish(m, a, gets, angle if cycle.rotate else None)
