"""The base rotation: measured along a straight side, or given (MNC 12.1, 12.2)."""

from __future__ import annotations

from collections.abc import Iterator
from typing import ClassVar

from mnclab.controls.mnc.probing import addresses
from mnclab.controls.mnc.probing.addresses import APPROACH
from mnclab.controls.mnc.probing.cycle import TURNS, MeasuringCycle, Moves, numbers, on_line, unplaced
from mnclab.controls.mnc.probing.datum import base_rotation, store_angle, turn_base
from mnclab.machine.cycle import CycleTable, Given, Values
from mnclab.machine.machine import Machine
from mnclab.machine.true_size import NOTHING
from mnclab.machining.probing.fits import line, reduced
from mnclab.machining.probing.sequences import Aim, in_plane
from mnclab.machining.probing.sketches import sketch
from mnclab.machining.steps import Measure, Say

CYCLES = CycleTable(addresses=addresses)
ASKEW = 45.0  # degrees: a side that lies farther off its line was probably measured against the wrong one


@CYCLES(
    "G400", "Align the plane to a straight side", runs="definition", source="MNC 12.1",
    takes=f"x y x2 y2 axis direction {APPROACH} between reference_angle row",
)  # fmt: skip
class Alignment(MeasuringCycle):
    """Two touches of a side, without the base rotation; its angle to a reference line becomes the base rotation.

    The angle is that of a line without a direction (MNC-G400-UNDIRECTED); the datum point stays.
    """

    refused = TURNS
    x: float = addresses.x(meaning="X of the first point", example=20)
    y: float = addresses.y(meaning="Y of the first point", example=0)
    x2: float = addresses.coordinate("U", "X of the second point", 80)
    y2: float = addresses.coordinate("V", "Y of the second point", 0)
    axis: float = addresses.axis(example=2)
    between: float = addresses.between(("P", "R"))
    reference_angle: float = addresses.angle("E", "angle of the reference line to X", 0)
    row: float = addresses.row(note="gets the angle; 0: it is not saved")

    @classmethod
    def prepare(cls, values: Values, given: Given, m: Machine, kept: Values) -> Values:
        if "between" in given and given["between"].address == "R":  # MNC-G400-PR
            m.warn("G400 R means P: the format has P, the list of the manual R", given["between"])
        return values

    def contradictions(self) -> Iterator[tuple[str, str]]:
        if self.axis == 1 and self.y2 == self.y:
            yield "y2", f"must differ from Y, got {self.y2:g}: both points are one along the side"
        if self.axis == 2 and self.x2 == self.x:
            yield "x2", f"must differ from X, got {self.x2:g}: both points are one along the side"

    def moves(self, m: Machine) -> Moves:
        if base_rotation(m):
            yield from turn_base(0.0)
        a, way = self.approach(m), (self.direction, 0.0) if self.axis == 1 else (0.0, self.direction)
        points = (self.x, self.y), (self.x2, self.y2)
        contacts = yield from in_plane(a, [Aim(x, y, way) for x, y in points], m.programmed[2])
        side = line([contact.point[:2] for contact in contacts]).towards(way, a.ball)
        angle = side.angle % 180 if self.axis == 1 else reduced(side.angle)
        turned = reduced(angle - self.reference_angle)
        yield sketch(points, on_line(side, contacts), a.level, numbers(contacts))
        yield Measure("angle", angle, self.reference_angle, unit="deg", touches=numbers(contacts))
        yield Measure("base rotation", turned, unit="deg")
        if abs(turned) > ASKEW:
            yield Say(f"turns the plane by {turned:.4g} degrees", "E90 is the reference line of a side along Y")
        yield from turn_base(turned)
        yield from store_angle(m, self.row, turned)


@CYCLES("G404", "Set the base rotation", runs="definition", source="MNC 12.2")
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
