"""Presets by a touch, in a corner, and in the middle of a figure (TNC 620, chapter 15)."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence

from mnclab.controls.tnc_620.cycles.addresses import choice, coordinate, distance
from mnclab.controls.tnc_620.cycles.planes import ParameterFault, not_zero
from mnclab.controls.tnc_620.probing import addresses, cycle
from mnclab.controls.tnc_620.probing.addresses import CENTRE, CENTRES, HEIGHTS, ROUND, TOP
from mnclab.controls.tnc_620.probing.cycle import Moves, ProbingCycle, measured, needed
from mnclab.machine.coordinates import tool_axis
from mnclab.machine.cycle import CycleTable
from mnclab.machine.machine import Machine
from mnclab.machine.touching import Contact
from mnclab.machining.probing import sequences
from mnclab.machining.probing.fits import centre_of_four, corner, line, reduced, width
from mnclab.machining.probing.found import Line, Point, Width, sketch
from mnclab.machining.probing.sequences import Aim, Approach, Pair, from_above, in_one_axis, numbers, sides
from mnclab.machining.steps import Measure

# Presets in the middle of a slot, ridge, pocket, stud or hole, or between holes (TNC 620, 15.2 to 15.7, 15.10, 15.12).

CYCLES = CycleTable(addresses=addresses, runs="definition")
SLOT = f"centre_x centre_y width axis {HEIGHTS}"
BOX = f"centre_x centre_y length width {HEIGHTS} move_to_clearance {CENTRE}"
CIRCLE = f"centre_x centre_y {ROUND} {CENTRE} points traverse"


def middle(c: ProbingCycle, m: Machine) -> Moves:
    """Both walls are touched; the middle between them is the preset of one axis."""
    a, k, centre, half = c.approach(m), int(c.axis) - 1, (c.centre_x, c.centre_y), c.width / 2
    contacts = yield from sides(a, centre, (half, half), (k, k + 2), c.inside, m.programmed[2])
    balls = needed(width, *(each.point[:2] for each in contacts), 90 * k, m=m, code=c.code)
    found = balls.grown(a.ball if c.inside else -a.ball)
    at = found.centre[k]
    yield from measured(contacts, **{"XY"[k]: (at, centre[k]), "width": (found.width, c.width)})
    yield sketch(Width(*centre, c.width), found, c.level, contacts, 90 * k)
    yield from cycle.lengths(m, Q157=at, Q166=found.width)
    yield from cycle.finish(c, m, a, {k: (at, c.datum)})


@CYCLES("TCH PROBE 408", "Preset at a slot centre", source="15.2", takes=f"{SLOT} move_to_clearance row datum {TOP}")
class PresetInSlot(ProbingCycle):
    """Two touches from within, along an axis; the middle gets the coordinate Q405 of that axis."""

    width: float = distance("Q311", "slot width", example=20)
    transfer: float = addresses.transfer(choices=addresses.TABLES)
    moves = middle


@CYCLES("TCH PROBE 409", "Preset at a ridge centre", source="15.3", takes=f"{SLOT} row datum {TOP}")
class PresetOnRidge(ProbingCycle):
    """Two touches from outside, along an axis, over the clearance height; the middle gets the coordinate Q405."""

    inside, move_to_clearance = False, 1.0
    width: float = distance("Q311", "ridge width", example=20)
    transfer: float = addresses.transfer(choices=addresses.TABLES)
    moves = middle


def box_middle(c: ProbingCycle, m: Machine) -> Moves:
    """All sides are touched; the middle is the preset of both axes."""
    a, centre = c.approach(m), (c.centre_x, c.centre_y)
    found, contacts = yield from cycle.box(c, m, a, centre)
    sizes = {"length": (found.length, c.length), "width": (found.width, c.width)}
    results = {"Q154": found.length, "Q155": found.width}
    yield from preset(c, m, a, found.centre, centre, contacts, sizes, results)


@CYCLES("TCH PROBE 410", "Preset from inside a rectangle", source="15.4", takes=BOX)
class PresetInRectangle(ProbingCycle):
    """Four touches from within a pocket; its middle gets the coordinates Q331 and Q332."""

    length: float = distance("Q323", "length along the reference axis", example=40)
    width: float = distance("Q324", "length along the minor axis", example=20)
    moves = box_middle


@CYCLES("TCH PROBE 411", "Preset from outside a rectangle", source="15.5", takes=BOX)
class PresetOnRectangle(ProbingCycle):
    """Four touches of a stud from outside; its middle gets the coordinates Q331 and Q332."""

    inside = False
    length: float = distance("Q323", "length along the reference axis", example=40)
    width: float = distance("Q324", "length along the minor axis", example=20)
    moves = box_middle


def ring_middle(c: ProbingCycle, m: Machine) -> Moves:
    """It is touched all around; the middle is the preset of both axes."""
    a, centre = c.approach(m), (c.centre_x, c.centre_y)
    found, contacts = yield from cycle.ring(c, m, a, centre)
    size = {"diameter": (found.diameter, c.diameter)}
    yield from preset(c, m, a, found.centre, centre, contacts, size, {"Q153": found.diameter})


@CYCLES("TCH PROBE 412", "Preset from inside a circle", source="15.6", takes=CIRCLE)
class PresetInCircle(ProbingCycle):
    """Three or four touches from within a hole; its middle gets the coordinates Q331 and Q332."""

    moves = ring_middle


@CYCLES("TCH PROBE 413", "Preset from outside a circle", source="15.7", takes=CIRCLE)
class PresetOnCircle(ProbingCycle):
    """Three or four touches of a round stud from outside; its middle gets the coordinates Q331 and Q332."""

    inside = False
    moves = ring_middle


@CYCLES(
    "TCH PROBE 416", "Preset at the centre of a bolt hole circle", source="15.10",
    takes=f"middle_x middle_y diameter first_angle second_angle third_angle level height {CENTRE} clearance",
)  # fmt: skip
class PresetInBoltCircle(ProbingCycle):
    """Four touches of each of three holes from their nominal centres; the middle of their circle gets Q331 and Q332."""

    diameter: float = addresses.diameter(meaning="nominal diameter of the bolt hole circle", example=40)

    def moves(self, m: Machine) -> Moves:
        a = self.approach(m)
        found, contacts = yield from cycle.bolt_circle(self, m, a)
        size = {"diameter": (found.diameter, self.diameter)}
        yield from preset(self, m, a, found.centre, (self.middle_x, self.middle_y), contacts, size, {"Q153": found.diameter})


@CYCLES(
    "TCH PROBE 418", "Preset between four holes", source="15.12",
    takes=f"{CENTRES} third_center_axis_1 third_center_axis_2 fourth_center_axis_1 fourth_center_axis_2 level height {CENTRE}",
)  # fmt: skip
class PresetBetweenHoles(ProbingCycle):
    """Four touches of each of four holes from their nominal centres; where the lines 1-3 and 2-4 cross gets Q331 and Q332."""

    third_center_axis_1: float = coordinate("Q316", "third center, reference axis", example=80)
    third_center_axis_2: float = coordinate("Q317", "third center, minor axis", example=60)
    fourth_center_axis_1: float = coordinate("Q318", "fourth center, reference axis", example=20)
    fourth_center_axis_2: float = coordinate("Q319", "fourth center, minor axis", example=60)

    def moves(self, m: Machine) -> Moves:
        a, names = self.approach(m), ("first", "second", "third", "fourth")
        places = [(getattr(self, f"{name}_center_axis_1"), getattr(self, f"{name}_center_axis_2")) for name in names]
        nominal = needed(centre_of_four, places, m=m, code=self.code)
        centres, contacts = yield from cycle.holes(self, m, a, places)
        found = needed(centre_of_four, centres, m=m, code=self.code)
        yield sketch([*places, places[0]], [*centres, centres[0]], self.level)
        yield from preset(self, m, a, found.centre, nominal.centre, contacts, {}, {})


def preset(
    c: ProbingCycle, m: Machine, a: Approach, found: Pair, nominal: Pair, contacts: Sequence[Contact],
    sizes: dict[str, Pair], results: dict[str, float],
) -> Moves:  # fmt: skip
    """The place that was found, and `sizes` (measured and nominal) by name: the record, Q151, Q152 and further results."""
    yield from measured(contacts, X=(found[0], nominal[0]), Y=(found[1], nominal[1]), **sizes)
    yield from cycle.lengths(m, Q151=found[0], Q152=found[1], **results)
    yield from cycle.finish(c, m, a, {0: (found[0], c.datum_x), 1: (found[1], c.datum_y)})


# Presets by a single touch, or in a corner (TNC 620, 15.8, 15.9, 15.11, 15.13).
# In a corner the first line, of the points 1 and 2, runs along the reference axis and is touched along the minor axis;
# the second
# one, of the points 3 and 4, the other way round. With Q304 = 1 the angle of the first line is added to the basic
# rotation of the
# row.

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

    def check(self, m: Machine) -> Iterator[ParameterFault]:
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

    def check(self, m: Machine) -> Iterator[ParameterFault]:
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
        yield from cycle.lengths(m, Q160=z)
        yield from cycle.save(m, {2: (z, self.datum_z)}, self.row, self.transfer)


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
        yield from cycle.save(m, {k: (found, self.datum_z)}, self.row, self.transfer)


def two_lines(c: ProbingCycle, m: Machine) -> Iterator[ParameterFault]:
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
    yield from cycle.lengths(m, Q151=found.x, Q152=found.y)
    turned = angle if c.basic_rotation else 0.0
    yield from cycle.finish(c, m, a, {0: (found.x, c.datum_x), 1: (found.y, c.datum_y)}, turned)


def crossing(balls: Sequence[Pair], ways: Sequence[Pair], ball: float) -> tuple[Point, list[Line]]:
    """Where the sides cross that were touched each at two points in one direction, and the sides."""
    sides = [line(balls[k : k + 2]).towards(way, ball) for k, way in zip((0, 2), ways)]
    return corner(*sides), sides
