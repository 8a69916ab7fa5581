"""Inspection of points, planes and figures (TNC 620, chapter 16), and what its cycles share: results, classes, measuring log."""

from __future__ import annotations

import math
from collections.abc import Generator, Iterator, Mapping, Sequence
from dataclasses import replace
from typing import Any, NamedTuple

import numpy as np

from mnclab.controls.tnc_620.contours.line import Named, named_tool
from mnclab.controls.tnc_620.cycles.addresses import coordinate, increment
from mnclab.controls.tnc_620.cycles.planes import SAME, ParameterFault
from mnclab.controls.tnc_620.probing import addresses
from mnclab.controls.tnc_620.probing.addresses import HEIGHTS, INSPECTED, LINE, ROUND
from mnclab.controls.tnc_620.probing.cycle import Moves, ProbingCycle, bolt_circle, box, needed, ring, shows_results
from mnclab.controls.tnc_620.state import time_of_day
from mnclab.machine.coordinates import in_mm
from mnclab.machine.cycle import CycleTable
from mnclab.machine.machine import Machine
from mnclab.machine.measuring import OK, REWORK, SCRAP, SLACK, judged
from mnclab.machine.touching import Contact
from mnclab.machining.probing.fits import angle, plane, reduced
from mnclab.machining.probing.found import Circle, axes_on, sketch, spatial_angles
from mnclab.machining.probing.sequences import Aim, between, in_one_axis, in_plane, numbers, results
from mnclab.machining.steps import Measure, Pause, Say, Step, Write

# The measuring log (TNC 620, 16.1): a text with the nominal values, the limits, the actual values and the deviations.
# Lengths are in the unit of the program. A run has a date and a time where the setting `clock` gives it one.

UNKNOWN = "not known (setting clock)"
SCREEN = "SCREEN:"  # the window of FN 16


class Value(NamedTuple):
    """A measured value: `what` it is in the record, its `name` in the log, mm or degrees as the `unit` says.

    `q` and `difference` are the Q parameters of the value and of its deviation. `lower` and `upper` are the limits as they are
    given, `limit` is how the log names them; where they are `watched`, what is `below` or `above` is "rework" or "scrap".
    """

    what: str
    name: str
    actual: float
    q: str
    nominal: float = math.nan
    difference: str = ""
    lower: float = math.nan
    upper: float = math.nan
    limit: str = ""
    watched: bool = False
    below: str = SCRAP
    above: str = SCRAP
    unit: str = "mm"

    @property
    def deviation(self) -> float:
        """Actual less nominal."""
        return self.actual - self.nominal

    @property
    def verdict(self) -> str:
        """"ok", "rework" or "scrap"; "" where nothing watches it. On its limit it is within."""
        if not self.watched or judged(self.actual, self.lower, self.upper) == OK:
            return OK if self.watched else ""
        return self.below if self.actual < self.lower else self.above


def logged(m: Machine, c: ProbingCycle, values: Sequence[Value], further: Mapping[str, float]) -> Iterator[Step]:
    """Nothing with 0, a file with 1, and with 2 a window, while the program waits for NC start (Q281); or as cycle 441 says."""
    number, mode = c.code.split()[-1], c.measuring_log
    text = "\n".join([*lines(m, number, c.title, values, further), ""])
    if mode == 1:
        yield Write("file", text, f"TCHPR{number}.TXT")
    if shows_results(m, mode == 2):
        yield Write("file", text, SCREEN)
        yield Pause("the measuring log is shown")


def lines(m: Machine, number: str, title: str, values: Sequence[Value], further: Mapping[str, float]) -> Iterator[str]:
    """The lines of a log."""
    now = time_of_day(m)
    yield f"Measuring log for Probing Cycle {number} {title}"
    yield f"Date: {now:%d-%m-%Y}" if now else f"Date: {UNKNOWN}"
    yield f"Time: {now.hour}:{now:%M:%S}" if now else f"Time: {UNKNOWN}"
    yield f"Measuring program: {m.flow.program.title}"
    blocks: dict[str, list[tuple[str, float, str]]] = {
        "Nominal values": [(each.name, each.nominal, each.unit) for each in values],
        "Given limit values": [
            (f"{which} {each.limit}", value, each.unit)
            for each in values for which, value in (("Maximum", each.upper), ("Minimum", each.lower))
        ],
        "Actual values": [(each.name, each.actual, each.unit) for each in values],
        "Deviations": [(each.name, each.deviation, each.unit) for each in values],
    }  # fmt: skip
    for heading, rows in blocks.items():
        if known := [row for row in rows if not math.isnan(row[1])]:
            yield f"{heading}:"
            for name, value, unit in known:
                yield f"{name}: {figure(m, value, unit)}"
    if further:
        said = (f"{name}: {figure(m, value)}" for name, value in further.items())
        yield f"Further measuring results: {', '.join(said)}"
    yield "End of measuring log"


def figure(m: Machine, value: float, unit: str = "mm") -> str:
    """Four decimals, in the unit of the program."""
    return f"{value / m.variable_unit if unit == 'mm' else value:z.4f}"


# What cycles that inspect a workpiece share (TNC 620, 16.1): results, classification, tolerance and tool monitoring, the log.
# Too much material is rework, too little is scrap, and so is a wrong place. A limit that is 0, of sizes both, watches nothing.

HEIGHT = "Measuring height"  # in the log
AXES = ("reference axis", "minor axis", "touch probe axis")


def report(
    c: ProbingCycle, m: Machine, values: Sequence[Value], contacts: Sequence[Contact], sizes: Sequence[Value] = (),
    compensation: tuple[float, float] = (0.0, 0.0),
) -> Moves:  # fmt: skip
    """Results, status, tool table and log, in this order; then an alarm where one is due.

    `sizes` are the values that the monitored tool made, `compensation` is what is added to its DR and DL.
    """
    touches, declared = numbers(contacts), {p.name for p in c.parameters()}
    for each in values:
        lower, upper = (each.lower, each.upper) if each.watched else (math.nan, math.nan)
        yield Measure(each.what, each.actual, each.nominal, lower, upper, each.unit, each.verdict, touches)
    unit = {"mm": m.variable_unit, "deg": 1.0}
    yield from results(**{each.q: each.actual / unit[each.unit] for each in values})
    yield from results(**{each.difference: each.deviation / unit[each.unit] for each in values if each.difference})
    out, broken = [each for each in values if each.verdict not in ("", OK)], ""
    if "program_stop" in declared:  # the others judge nothing
        verdict = next((which for which in (SCRAP, REWORK) if which in {each.verdict for each in out}), OK)
        yield from results(**{q: verdict == which for q, which in (("Q180", OK), ("Q181", REWORK), ("Q182", SCRAP))})
    if c.monitored_tool != 0 and sizes:
        broken = yield from monitored(m, c.monitored_tool, max(abs(each.deviation) for each in sizes), *compensation)
    yield from logged(m, c, values, {HEIGHT: c.level} if "level" in declared else {})
    if broken:
        m.alarm(in_mm(f"{c.code}: {broken}", m.variable_unit))
    if c.program_stop and out:
        said = (f"{each.what} {each.actual:.4f}, allowed from {each.lower:.4f} to {each.upper:.4f}" for each in out)
        length = any(each.unit == "mm" for each in out)
        m.alarm(in_mm(f"{c.code}: tolerance exceeded: {'; '.join(said)}", m.variable_unit, length))


def wear(sizes: Sequence[Value], inside: bool) -> tuple[float, float]:
    """What is added to DR and DL of the tool that made a figure: half of the deviation of a size, of two sides their mean."""
    return (1.0 if inside else -1.0) * sum(each.deviation for each in sizes) / len(sizes) / 2, 0.0


def middle(c: ProbingCycle, x: float, y: float) -> list[Value]:
    """The coordinates of the centre of a figure, Q151 and Q152."""
    given = (x, c.middle_x, c.tolerance_x), (y, c.middle_y, c.tolerance_y)
    return [
        Value("XY"[k], f"Center in {AXES[k]}", actual, f"Q15{k + 1}", nominal, f"Q16{k + 1}", nominal - off, nominal + off,
              f"limit for center in {AXES[k]}", off != 0)
        for k, (actual, nominal, off) in enumerate(given)
    ]  # fmt: skip


def size(
    what: str, name: str, q: str, difference: str, actual: float, nominal: float, limits: tuple[float, float], limit: str,
    inside: bool | None,
) -> Value:  # fmt: skip
    """A length, which is watched where one of its limits, the smaller and the larger, is not 0.

    `inside`: of a hollow figure; None: neither too large nor too small can be repaired.
   """
    below, above = {True: (REWORK, SCRAP), False: (SCRAP, REWORK), None: (SCRAP, SCRAP)}[inside]
    return Value(what, name, actual, q, nominal, difference, *limits, limit, limits != (0, 0), below, above)


def monitored(m: Machine, name: Named, deviation: float, radius: float, length: float) -> Generator[Step, Any, str]:
    """Adds `radius` to DR and `length` to DL; returns what an alarm says of a broken tool, which is locked instead.

    `deviation` (mm) is the greatest one of a size, broken is a tool whose RBREAK is smaller. What changed counts from the next
    TOOL CALL on.
    """
    tool = named_tool(m, name)
    assert tool is not None  # `check` has found it
    number = next(number for number, each in m.tables.tools.items() if each is tool)
    if 0 < tool.wear.break_radius < deviation - SLACK:
        yield Write("tools", replace(tool, locked=True), number)
        return f"tool {number:g} is broken: a deviation of {deviation:.4f} is more than its RBREAK {tool.wear.break_radius:g}"
    if radius or length:
        yield Write("tools", replace(tool, dr=tool.dr + radius, dl=tool.dl + length), number)
    return ""


# Inspection of angles, coordinates and planes (TNC 620, 16.4, 16.11, 16.13).

CYCLES = CycleTable(addresses=addresses, runs="definition")
FLAT = 1e-6  # mm²: points that span less lie on a line


@CYCLES("TCH PROBE 420", "Angle measuring", source="16.4", takes=f"{LINE} {HEIGHTS} move_to_clearance measuring_log")
class AngleMeasuring(ProbingCycle):
    """Two touches of a straight edge; along the probe axis the angle is that about the reference or the minor axis."""

    tilted = True
    axis: float = addresses.axis(choices=addresses.AXES, example=2)

    def contradictions(self) -> Iterator[ParameterFault]:
        same_x, same_y = abs(self.x - self.second_x) < SAME, abs(self.y - self.second_y) < SAME
        if same_x and same_y:
            yield "second_x", "and Q266 give the first touch point again: two points make an angle"
        elif self.axis == 3 and not (same_x or same_y):
            yield "axis", "3 measures an angle along an axis: Q265 must be Q263, or Q266 must be Q264"

    def moves(self, m: Machine) -> Moves:
        a, k = self.approach(m), int(self.axis) - 1
        points = [(self.x, self.y, self.level), (self.second_x, self.second_y, self.level)]
        contacts = yield from in_one_axis(a, k, self.direction, points, m.programmed[2])
        first, second = (np.array(contact.point) for contact in contacts)
        if k < 2:
            found, nominal = reduced(angle(first, second)), reduced(angle(points[0][:2], points[1][:2]))
            shift = np.eye(3)[k] * self.direction * a.ball
            yield sketch(points, [first + shift, second + shift], self.level, contacts)
        else:
            dx, dy, dz = second - first
            found, nominal = math.degrees(math.atan(dz / dy if abs(dy) > abs(dx) else -dz / dx)), 0.0
        value = Value("angle", "Angle", found, "Q150", nominal, unit="deg")
        yield from report(self, m, [value], contacts)


@CYCLES(
    "TCH PROBE 427", "Coordinate measuring", source="16.11",
    takes="x y level clearance axis direction height measuring_log maximum_limit minimum_limit program_stop monitored_tool "
          "reverse_tool angle_of_incidence",
)  # fmt: skip
class CoordinateMeasuring(ProbingCycle):
    """One touch along an axis. Beyond Q288 there is too much material, beyond Q289 too little, whichever is the larger one."""

    tilted = True
    axis: float = addresses.axis(choices=addresses.AXES)
    maximum_limit: float = coordinate("Q288", "maximum limit", note="0 with Q289 = 0: not monitored", example=0)
    minimum_limit: float = coordinate("Q289", "minimum limit", example=0)

    def moves(self, m: Machine) -> Moves:
        a, k = self.approach(m), int(self.axis) - 1
        contacts = yield from in_one_axis(a, k, self.direction, [(self.x, self.y, self.level)], m.programmed[2])
        found = contacts[0].point[k] + self.direction * a.ball
        ends = self.minimum_limit, self.maximum_limit
        turned = ends[0] > ends[1]
        value = Value(
            "XYZ"[k], f"Coordinate in {AXES[k]}", found, "Q160", lower=min(ends), upper=max(ends), limit="limit",
            watched=ends != (0, 0), below=REWORK if turned else SCRAP, above=SCRAP if turned else REWORK,
        )  # fmt: skip
        sizes = [value._replace(nominal=sum(ends) / 2)] if value.watched else []  # the middle of the limits
        change = sum(self.direction * each.deviation for each in sizes)
        yield from report(self, m, [value], contacts, sizes, (0.0, change) if k == 2 else (change, 0.0))


@CYCLES(
    "TCH PROBE 431", "Plane measuring", source="16.13",
    takes="x y z second_x second_y second_z third_x third_y third_z clearance height measuring_log",
)  # fmt: skip
class PlaneMeasuring(ProbingCycle):
    """Three touches downwards: the angles that tilt the working plane; X goes from the first point to the second one."""

    tilted = True
    second_z: float = coordinate("Q295", "second touch point, touch probe axis", example=0)
    third_z: float = coordinate("Q298", "third touch point, touch probe axis", example=0)

    def contradictions(self) -> Iterator[ParameterFault]:
        ahead, aside = (self.second_x - self.x, self.second_y - self.y), (self.third_x - self.x, self.third_y - self.y)
        if abs(ahead[0] * aside[1] - ahead[1] * aside[0]) < FLAT:
            yield "third_x", "and the other points lie on one line: three points must span a plane"

    def moves(self, m: Machine) -> Moves:
        a = replace(self.approach(m), over=True)
        third = self.third_x, self.third_y, self.third_z
        points = [(self.x, self.y, self.z), (self.second_x, self.second_y, self.second_z), third]
        contacts = yield from in_one_axis(a, 2, -1.0, points, m.programmed[2])
        p = np.array([contact.point for contact in contacts]) - (0.0, 0.0, a.ball)
        found = needed(plane, p, m=m, code=self.code)
        up = np.cross(p[1] - p[0], p[2] - p[0])
        if up[2] < 0:
            yield Say(
                "finds a plane whose tool axis points down: the third point lies to the right of the first two",
                hint="choose the third point in the direction of +Y",
            )  # fmt: skip
        spatial = spatial_angles(axes_on(up, p[1] - p[0]))
        values = [
            Value("projection angle A", "Projection angle of the A axis", found.about_x, "Q158", unit="deg"),
            Value("projection angle B", "Projection angle of the B axis", found.about_y, "Q159", unit="deg"),
            *(
                Value(f"spatial angle {name}", f"Spatial angle {name}", value, f"Q17{k}", unit="deg")
                for k, (name, value) in enumerate(zip("ABC", spatial, strict=True))
            ),
            *(
                Value(f"Z{k + 1}", f"Point {k + 1} in {AXES[2]}", z, f"Q17{3 + k}", points[k][2])
                for k, z in enumerate(p[:, 2].tolist())
            ),
        ]  # fmt: skip
        yield from report(self, m, values, contacts)


# Inspection of holes, studs, pockets, slots, ridges and bolt hole circles (TNC 620, 16.5 to 16.10, 16.12).

LIMITS = "maximum_limit minimum_limit"
CIRCLE = f"middle_x middle_y {ROUND} {LIMITS} {INSPECTED} points traverse reverse_tool angle_of_incidence"
SIDES = "first_maximum first_minimum second_maximum second_minimum"
BOX = f"middle_x middle_y length width {HEIGHTS} move_to_clearance {SIDES} {INSPECTED}"
WIDTH = f"nominal_length {LIMITS} measuring_log program_stop monitored_tool"


def ring_measured(c: ProbingCycle, m: Machine) -> Moves:
    """Touches along the radius: centre and diameter."""
    found, contacts = yield from ring(c, m, c.approach(m), (c.middle_x, c.middle_y))
    yield from circle_told(c, m, found, contacts, "hole" if c.inside else "stud", c.inside)


@CYCLES("TCH PROBE 421", "Hole measuring", source="16.5", takes=CIRCLE)
class HoleMeasuring(ProbingCycle):
    """Touches along the radius, outward: centre and diameter."""

    tilted, entered = True, ("diameter",)
    maximum_limit: float = addresses.maximum("Q275")
    minimum_limit: float = addresses.minimum("Q276")
    moves = ring_measured


@CYCLES("TCH PROBE 422", "Stud measuring", source="16.6", takes=CIRCLE)
class StudMeasuring(ProbingCycle):
    """Touches along the radius, inward: centre and diameter of a round stud."""

    tilted, inside = True, False
    maximum_limit: float = addresses.maximum("Q277")
    minimum_limit: float = addresses.minimum("Q278")
    moves = ring_measured


@CYCLES(
    "TCH PROBE 430", "Bolt hole circle measuring", source="16.12",
    takes=f"middle_x middle_y diameter first_angle second_angle third_angle level height {LIMITS} {INSPECTED}",
)  # fmt: skip
class BoltHoleCircleMeasuring(ProbingCycle):
    """The circle through the centres of three holes, each found by four touches from its nominal centre."""

    tilted = True
    diameter: float = addresses.diameter(meaning="nominal diameter of the bolt hole circle", example=80)
    monitored_tool: float = addresses.monitored_tool(note="only whether it is broken; 0: none")

    def contradictions(self) -> Iterator[ParameterFault]:
        angles = self.first_angle, self.second_angle, self.third_angle
        for k, name in ((1, "second_angle"), (2, "third_angle")):
            if any(abs(math.remainder(angles[k] - other, 360)) < SAME for other in angles[:k]):
                yield name, f"names the same hole again, got {angles[k]:g}: three holes make a circle"
        if self.diameter <= 0:
            yield "diameter", f"must be greater than 0, got {self.diameter:g}"

    def moves(self, m: Machine) -> Moves:
        found, contacts = yield from bolt_circle(self, m, self.approach(m))
        yield from circle_told(self, m, found, contacts, "bolt hole circle", None)


def circle_told(
    c: ProbingCycle, m: Machine, found: Circle, contacts: Sequence[Contact], figure: str, inside: bool | None
) -> Moves:
    """The centre and the diameter that were found."""
    limits = c.minimum_limit, c.maximum_limit
    wide = size("diameter", "Diameter", "Q153", "Q163", found.diameter, c.diameter, limits, f"dimension for {figure}", inside)
    change = (0.0, 0.0) if inside is None else wear([wide], inside)
    yield from report(c, m, [*middle(c, found.x, found.y), wide], contacts, [wide], change)


def box_measured(c: ProbingCycle, m: Machine) -> Moves:
    """What the touches of the four sides find."""
    found, contacts = yield from box(c, m, c.approach(m), (c.middle_x, c.middle_y))
    measured = (
        ("length", found.length, c.length, (c.first_minimum, c.first_maximum)),
        ("width", found.width, c.width, (c.second_minimum, c.second_maximum)),
    )
    sizes = [
        size(what, f"Length in {AXES[k]}", f"Q15{4 + k}", f"Q16{4 + k}", is_, be, limits, f"length in {AXES[k]}", c.inside)
        for k, (what, is_, be, limits) in enumerate(measured)
    ]
    yield from report(c, m, [*middle(c, found.x, found.y), *sizes], contacts, sizes, wear(sizes, c.inside))


@CYCLES("TCH PROBE 423", "Pocket measuring", source="16.7", takes=BOX)
class PocketMeasuring(ProbingCycle):
    """Touches in the middle of the four sides of a rectangular pocket: its centre, its length and its width."""

    tilted, entered = True, ("length", "width")
    length: float = addresses.side("Q282", "length along the reference axis", example=60)
    width: float = addresses.side("Q283", "length along the minor axis", example=40)
    moves = box_measured


@CYCLES("TCH PROBE 424", "Rectangular stud measuring", source="16.8", takes=BOX)
class RectangularStudMeasuring(ProbingCycle):
    """Touches in the middle of the four sides of a rectangular stud: its centre, its length and its width."""

    tilted, inside = True, False
    length: float = addresses.side("Q282", "length along the reference axis", example=60)
    width: float = addresses.side("Q283", "length along the minor axis", example=40)
    moves = box_measured


@CYCLES(
    "TCH PROBE 425", "Slot width measuring", source="16.9",
    takes=f"x y offset axis level height {WIDTH} clearance move_to_clearance",
)  # fmt: skip
class SlotMeasuring(ProbingCycle):
    """From a starting point in the slot to the wall ahead, then, perhaps from another line, to the wall behind."""

    tilted = True
    x: float = coordinate("Q328", "starting point, reference axis", example=50)
    y: float = coordinate("Q329", "starting point, minor axis", example=30)
    offset: float = increment("Q310", "offset of the second measurement", note="along the other axis", example=0)

    def moves(self, m: Machine) -> Moves:
        a, k = self.approach(m), int(self.axis) - 1
        ahead = (1.0, 0.0) if k == 0 else (0.0, 1.0)
        first = a.as_far_as(self.nominal_length / 2)
        (far,) = yield from in_plane(first, [Aim(self.x, self.y, ahead, 0.0)], m.programmed[2], leave=False)
        start = [self.x, self.y]
        start[1 - k] += self.offset
        if self.offset:
            yield from between(a, start[0], start[1], ())
        start[k] = min(start[k], far.point[k] + a.ball - self.nominal_length + a.away)
        aim = Aim(start[0], start[1], (-ahead[0], -ahead[1]), 0.0)
        (near,) = yield from in_plane(a, [aim], a.height)  # as if it stood up there: it stays at the measuring height
        yield from width_told(self, m, far, near, [far, near])


@CYCLES(
    "TCH PROBE 426", "Ridge width measuring", source="16.10", takes=f"x y second_x second_y axis {HEIGHTS} {WIDTH}"
)  # fmt: skip
class RidgeMeasuring(ProbingCycle):
    """From outside: the wall at the larger coordinate in the negative direction, then the other one in the positive."""

    tilted, inside = True, False
    nominal_length: float = addresses.nominal_length(example=60)

    @property
    def along(self) -> int:
        """The measuring axis, 0 or 1."""
        return int(self.axis) - 1

    @property
    def points_by_place(self) -> list[tuple[float, float]]:
        """The nominal points, the one at the larger coordinate of the measuring axis first."""
        return sorted([(self.x, self.y), (self.second_x, self.second_y)], key=lambda point: -point[self.along])

    def contradictions(self) -> Iterator[ParameterFault]:
        far, near = self.points_by_place
        if far[self.along] - near[self.along] < SAME:
            yield ("second_x", "second_y")[self.along], "is that of the first touch point: a ridge lies between two"

    def moves(self, m: Machine) -> Moves:
        a, (far, near) = replace(self.approach(m), over=True), self.points_by_place
        x, y = (1.0, 0.0) if self.along == 0 else (0.0, 1.0)
        if (more := far[self.along] - near[self.along] - self.nominal_length) > SAME:  # the points are not on the ridge
            a = a.as_far_as(a.away + more)
        contacts = yield from in_plane(a, [Aim(*far, (-x, -y)), Aim(*near, (x, y))], m.programmed[2])
        yield from width_told(self, m, contacts[0], contacts[1], contacts)


def width_told(c: ProbingCycle, m: Machine, far: Contact, near: Contact, contacts: Sequence[Contact]) -> Moves:
    """From the touch of the wall that is farther along the axis, and the other one: width and centre line."""
    k, ball = int(c.axis) - 1, m.radius if c.inside else -m.radius
    walls, other, half = (near.point[k] - ball, far.point[k] + ball), near.point[1 - k], c.nominal_length / 2
    line = sum(walls) / 2
    nominal, found = ([(x, other) if k == 0 else (other, x) for x in pair] for pair in ((line - half, line + half), walls))
    yield sketch(nominal, found, c.level, contacts)
    limits, width = (c.minimum_limit, c.maximum_limit), walls[1] - walls[0]
    wide = size("width", "Measured length", "Q156", "Q166", width, c.nominal_length, limits, "length", c.inside)
    centre = Value("XY"[k], f"Centerline in {AXES[k]}", line, "Q157")
    yield from report(c, m, [wide, centre], contacts, [wide], wear([wide], c.inside))
