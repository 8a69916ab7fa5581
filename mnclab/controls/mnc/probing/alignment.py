"""The angle of a straight side: measured, or given as the base rotation (MNC 12.1, 12.2, 12.13)."""

from __future__ import annotations

from collections.abc import Iterator
from typing import ClassVar

from mnclab.controls.mnc.probing import addresses
from mnclab.controls.mnc.probing.addresses import SIDE
from mnclab.controls.mnc.probing.cycle import TURNS, MeasuringCycle, Moves, unplaced
from mnclab.controls.mnc.probing.datum import base_rotation, store_angle, turn_base
from mnclab.controls.mnc.probing.protocol import Check, conclude
from mnclab.machine.coordinates import NOTHING
from mnclab.machine.cycle import CycleTable, Given, Values
from mnclab.machine.machine import Machine
from mnclab.machining.probing.fits import line, reduced
from mnclab.machining.probing.sequences import Aim, Steps, in_plane, numbers, results
from mnclab.machining.probing.sketches import sketch
from mnclab.machining.steps import Measure, Say

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
