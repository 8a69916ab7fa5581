"""Presets by a single touch, or in a corner (TNC 620, 15.8, 15.9, 15.11, 15.13).

In a corner the first line, of the points 1 and 2, runs along the reference axis and is touched along the minor axis; the second
one, of the points 3 and 4, the other way round. With Q304 = 1 the angle of the first line is added to the basic rotation of the
row.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence

from mnclab.controls.tnc_620.cycles.addresses import choice
from mnclab.controls.tnc_620.cycles.faults import Fault, not_zero
from mnclab.controls.tnc_620.probing import addresses
from mnclab.controls.tnc_620.probing.addresses import CENTRE, HEIGHTS
from mnclab.controls.tnc_620.probing.cycle import Moves, ProbingCycle, lengths, measured, needed
from mnclab.controls.tnc_620.probing.transfer import finish, save
from mnclab.machine.coordinates import tool_axis
from mnclab.machine.cycle import CycleTable
from mnclab.machine.machine import Machine
from mnclab.machining.probing import sequences
from mnclab.machining.probing.fits import corner, line, reduced
from mnclab.machining.probing.found import Line, Point
from mnclab.machining.probing.sequences import Aim, Approach, Pair, from_above, in_one_axis, numbers
from mnclab.machining.probing.sketches import sketch
from mnclab.machining.steps import Measure

CYCLES = CycleTable(addresses=addresses, runs="definition")
IN_CORNER = f"{HEIGHTS} move_to_clearance basic_rotation {CENTRE}"
CORNERS: dict[float, str] = {1: "lower left", 2: "lower right", 3: "upper right", 4: "upper left"}
INTO = {1: (1.0, 1.0), 2: (-1.0, 1.0), 3: (-1.0, -1.0), 4: (1.0, -1.0)}  # from a corner into the pocket


@CYCLES(
    "TCH PROBE 414", "Preset from outside a corner", source="15.8",
    takes=f"x y spacing_axis_1 third_x third_y spacing_axis_2 {IN_CORNER}",
)  # fmt: skip
class PresetOnCorner(ProbingCycle):
    """Two touches of either side from outside; the corner gets the coordinates Q331 and Q332.

    Where the points 1 and 3 lie to each other says which corner it is.
    """

    x: float = addresses.x(example=40)
    third_x: float = addresses.third_x(example=20)
    third_y: float = addresses.third_y(example=25)

    def check(self, m: Machine) -> Iterator[Fault]:
        yield from super().check(m)
        yield from two_lines(self, m)
        for name, other in (("third_x", self.x), ("third_y", self.y)):
            if getattr(self, name) == other:
                yield name, f"must not be that of the first point, {other:g}: which corner it is would not be known"

    def moves(self, m: Machine) -> Moves:
        upwards, rightwards = math.copysign(1.0, self.third_y - self.y), math.copysign(1.0, self.x - self.third_x)
        first = [(self.x, self.y), (self.x + self.spacing_axis_1, self.y)]
        second = [(self.third_x, self.third_y), (self.third_x, self.third_y + self.spacing_axis_2)]
        return both_sides(self, m, self.approach(m), (first, (0.0, upwards)), (second, (rightwards, 0.0)))


@CYCLES(
    "TCH PROBE 415", "Preset from inside a corner", source="15.9", takes=f"x y spacing_axis_1 spacing_axis_2 corner {IN_CORNER}"
)
class PresetInCorner(ProbingCycle):
    """Two touches of either side from within a pocket; the corner gets the coordinates Q331 and Q332.

    Q263 and Q264 are about where the corner is: the first touch of either side is as far from the other one as its ball needs.
    """

    corner: float = choice("Q308", "corner", CORNERS, example=1)

    def check(self, m: Machine) -> Iterator[Fault]:
        yield from super().check(m)
        yield from two_lines(self, m)

    def moves(self, m: Machine) -> Moves:
        a, (u, v) = self.approach(m), INTO[int(self.corner)]
        first = [(self.x + u * way, self.y) for way in (a.away, a.away + self.spacing_axis_1)]
        second = [(self.x, self.y + v * way) for way in (a.away, a.away + self.spacing_axis_2)]
        return both_sides(self, m, a, (first, (0.0, -v)), (second, (-u, 0.0)))


@CYCLES("TCH PROBE 417", "Preset in the touch probe axis", source="15.11", takes="x y z clearance height row datum_z transfer")
class PresetInProbeAxis(ProbingCycle):
    """One touch downwards; the touched point gets the coordinate Q333."""

    def moves(self, m: Machine) -> Moves:
        a = self.approach(m)
        contact = yield from from_above(a, self.x, self.y, self.z, m.programmed[2])
        z = contact.point[2] - a.ball
        yield from measured([contact], Z=(z, self.z))
        yield from lengths(m, Q160=z)
        yield from save(m, {2: (z, self.datum_z)}, self.row, self.transfer)


@CYCLES("TCH PROBE 419", "Preset in one axis", source="15.13", takes=f"x y {HEIGHTS} axis direction row datum_z transfer")
class PresetInOneAxis(ProbingCycle):
    """One touch along an axis; the touched point gets the coordinate Q333."""

    axis: float = addresses.axis(choices=addresses.AXES)
    datum_z: float = addresses.datum_z(meaning="new coordinate of the touched point")

    def moves(self, m: Machine) -> Moves:
        a, k, nominal = self.approach(m), int(self.axis) - 1, (self.x, self.y, self.level)
        contacts = yield from in_one_axis(a, k, self.direction, [nominal], m.programmed[2])
        found = contacts[0].point[k] + self.direction * a.ball
        yield from measured(contacts, **{"XYZ"[k]: (found, nominal[k])})
        yield from save(m, {k: (found, self.datum_z)}, self.row, self.transfer)


def two_lines(c: ProbingCycle, m: Machine) -> Iterator[Fault]:
    """What either line and its angle need."""
    yield from not_zero(c, "spacing_axis_1", "spacing_axis_2", purpose="for a line through both points")
    if c.basic_rotation and c.row and c.transfer == 0:
        yield "basic_rotation", "needs the preset table (Q303=1): a row of the datum table holds no basic rotation"
    if c.basic_rotation and tool_axis(m) != 2:
        yield "basic_rotation", "with another tool axis than Z: not built yet"


def both_sides(c: ProbingCycle, m: Machine, a: Approach, *lines: tuple[Sequence[Pair], Pair]) -> Moves:
    """Touch both lines, their points each in one direction; where they cross is the preset of both axes."""
    first, second = ([Aim(*point, way) for point in points] for points, way in lines)
    contacts = yield from sequences.corner(a, first, second, m.programmed[2])
    balls, ways = [each.point[:2] for each in contacts], [way for _, way in lines]
    found, sides = needed(crossing, balls, ways, a.ball, m=m, code=c.code)
    nominal, angle = (lines[1][0][0][0], lines[0][0][0][1]), reduced(sides[0].angle)
    yield from measured(contacts, X=(found.x, nominal[0]), Y=(found.y, nominal[1]))
    yield Measure("angle", angle, 0.0, unit="deg", touches=numbers(contacts))
    far = [max(range(2), key=lambda k: math.dist(points[k], nominal)) for points, _ in lines]
    ends = [side.foot(balls[2 * k + far[k]]) for k, side in enumerate(sides)]
    ideal = [points[k] for (points, _), k in zip(lines, far)]
    yield sketch([ideal[0], nominal, ideal[1]], [ends[0], found.centre, ends[1]], c.level, contacts)
    yield from lengths(m, Q151=found.x, Q152=found.y)
    turned = angle if c.basic_rotation else 0.0
    yield from finish(c, m, a, {0: (found.x, c.datum_x), 1: (found.y, c.datum_y)}, turned)


def crossing(balls: Sequence[Pair], ways: Sequence[Pair], ball: float) -> tuple[Point, list[Line]]:
    """Where the sides cross that were touched each at two points in one direction, and the sides."""
    sides = [line(balls[k : k + 2]).towards(way, ball) for k, way in zip((0, 2), ways)]
    return corner(*sides), sides
