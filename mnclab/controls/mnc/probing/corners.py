"""Datums at the corner of two sides, outside and inside (MNC 12.9, 12.10).

Points 1 and 2 lie side by side along X and are measured along Y, points 3 and 4 the other way (MNC-G414-YFIRST). The turn of
the part is the angle of the first side to X; it is added to the base rotation that it was measured in.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence

from mnclab.controls.mnc.probing import addresses
from mnclab.controls.mnc.probing.addresses import APPROACH, TOP
from mnclab.controls.mnc.probing.cycle import TURNS, MeasuringCycle, Moves
from mnclab.machine.cycle import CycleTable
from mnclab.machine.machine import Machine
from mnclab.machining.probing.fits import corner, line, reduced
from mnclab.machining.probing.sequences import Aim, Approach, Pair, numbers
from mnclab.machining.probing.sequences import corner as corner_touches
from mnclab.machining.probing.sketches import sketch
from mnclab.machining.steps import Measure
from mnclab.text.alarm import Alarm

CYCLES = CycleTable(addresses=addresses, runs="definition")
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
