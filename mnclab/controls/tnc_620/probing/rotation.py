"""What becomes of a measured misalignment (TNC 620, chapter 14): a basic rotation, or a rotary axis that turns by it.

The basic rotation stands in the column SPC of a preset row, the angle that a rotary axis counts from in A_OFFS, B_OFFS or
C_OFFS (`Datum.rotation`, `.a`, `.b`, `.c`). An angle is positive where the workpiece is turned counter-clockwise; the axis
turns by the same angle, so that the table takes the workpiece back.
"""

from __future__ import annotations

import math
from collections.abc import Generator, Iterator, Sequence
from dataclasses import replace
from functools import partial
from typing import Any

from mnclab.controls.tnc_620.cycles.addresses import choice, coordinate, count, length
from mnclab.controls.tnc_620.cycles.chain import offset, to_angle
from mnclab.controls.tnc_620.cycles.planes import ParameterFault
from mnclab.controls.tnc_620.cycles.tilting import rotary_axes
from mnclab.controls.tnc_620.language.rotary import GROUPS, TITLES
from mnclab.controls.tnc_620.probing import addresses
from mnclab.controls.tnc_620.probing.addresses import CENTRES, HEIGHTS, LINE, ROUND
from mnclab.controls.tnc_620.probing.cycle import Moves, ProbingCycle, circle, measured, needed, ring, store
from mnclab.controls.tnc_620.state import active_preset, memory
from mnclab.machine.coordinates import AXES, angles
from mnclab.machine.cycle import CycleTable
from mnclab.machine.machine import Machine
from mnclab.machine.setup import Datum
from mnclab.machine.touching import Contact
from mnclab.machining.probing import fits
from mnclab.machining.probing.found import Circle, Line, sketch
from mnclab.machining.probing.sequences import Approach, Pair, around, from_centre, in_one_axis, numbers, results
from mnclab.machining.steps import RAPID, Measure, Say, Step, Swivel, Write

STANDS = "a part of the setup does not turn with the table: the blocks that follow meet it as it stood"
C = AXES.index("C")


def tilted(m: Machine) -> Iterator[ParameterFault]:
    """A workpiece that does not lie level (SPA, SPB of the active preset): a basic rotation alone cannot say how it is turned."""
    preset = m.tables.presets.get(active_preset(m), Datum())
    if preset.tilt_x or preset.tilt_y:
        yield "", "cannot set a basic rotation where the active preset is tilted (SPA, SPB): the cycles 1410 and 1411 can"


def reset(m: Machine) -> Iterator[Step]:
    """The active basic rotation is over, where there is one (400, 401, 402)."""
    if m.tables.presets.get(active_preset(m), Datum()).rotation:
        yield from store(m, active_preset(m), rotation=0.0)


def align(m: Machine, axis: int, by: float) -> Iterator[Step]:
    """Turn a rotary axis by an angle, degrees."""
    a, b, c = (angle + by * (k == axis) for k, angle in enumerate(angles(m)))
    if by:
        yield Say(f"turns {AXES[axis]} by {by:.4f} degrees", STANDS if m.tables.kinematics is None else "")
        yield Swivel("align the workpiece", (a, b, c), RAPID)


def zeroed(m: Machine, axis: int) -> dict[str, float]:
    """The column of a preset row with which a rotary axis shows 0 where it stands now, degrees."""
    angle = angles(m)[axis]
    return {"abc"[axis]: offset(m, axis) + to_angle(m, axis, angle)}


def cannot_turn(m: Machine, axis: int, name: str) -> Iterator[ParameterFault]:
    """Why a rotary axis cannot turn; `name` of the parameter that asks for it."""
    there, known = rotary_axes(m).names, m.tables.kinematics
    if AXES[axis] not in there:
        said = "Setup.kinematics" if known else "setting rotary_axes"
        yield name, f"needs the rotary axis {AXES[axis]}: the machine has {' and '.join(there)} ({said})"
    elif known and known.axis(AXES[axis]) in known.head:
        yield name, f"turns the table, and {AXES[axis]} is in the head of the machine"
    for group, code in GROUPS.items() if not known else ():
        if m.modal.get(group) == code:
            yield name, f"turns a rotary axis, which is not built yet under {code} ({TITLES[code].lower()})"
    if any(memory(m).rotary_shift) or memory(m).rotary_mirror:
        yield name, "turns a rotary axis, which must not be shifted or mirrored"


# Misalignment over two points, holes or studs, or of one hole: cycles 400 to 405 (TNC 620, 14.7 to 14.12).

CYCLES = CycleTable(addresses=addresses, runs="definition")
OVER_TWO = "preset_rotation_angle row compensation set_to_zero"
AXIS: dict[float, str] = {0: "the one that the touches show", 4: "A", 5: "B", 6: "C"}
Pairs = tuple[Pair, Pair]
Touched = Generator[Step, Any, tuple[Line, list[Contact]]]
row = partial(addresses.row, at_most=99999)


@CYCLES(
    "TCH PROBE 400", "Basic rotation", source="14.7",
    takes=f"{LINE} {HEIGHTS} move_to_clearance preset_rotation_angle row",
)  # fmt: skip
class BasicRotation(ProbingCycle):
    """Two touches of an edge, which becomes the direction Q307; an active basic rotation is over before."""

    axis: float = addresses.axis(example=2)
    row: float = row(note="0: the active row")

    def contradictions(self) -> Iterator[ParameterFault]:
        yield from apart(self.axis, (self.x, self.y), (self.second_x, self.second_y))

    def check(self, m: Machine) -> Iterator[ParameterFault]:
        yield from super().check(m)
        yield from tilted(m)

    def moves(self, m: Machine) -> Moves:
        yield from reset(m)
        points = (self.x, self.y), (self.second_x, self.second_y)
        line, contacts = yield from edge(m, self.approach(m), self.code, points, self.axis, self.direction)
        turned = fits.reduced(line.angle - self.preset_rotation_angle)
        yield Measure("rotation", turned, 0.0, unit="deg", touches=numbers(contacts))
        yield from store(m, self.row or active_preset(m), rotation=turned)


def centres(c: ProbingCycle) -> Pairs:
    """The nominal ones."""
    return (c.first_center_axis_1, c.first_center_axis_2), (c.second_center_axis_1, c.second_center_axis_2)


def faults(c: ProbingCycle, m: Machine) -> Iterator[ParameterFault]:
    """Of the cycles over two holes or studs."""
    yield from ProbingCycle.check(c, m)
    yield from tilted(m)
    if centres(c)[0] == centres(c)[1]:
        yield "second_center_axis_1", "and Q271 are those of the first center: two places make a line"
    if c.compensation == 1:
        yield from cannot_turn(m, C, "compensation")


def compensate(c: ProbingCycle, m: Machine, touched: Sequence[Sequence[Contact]]) -> Iterator[Step]:
    """The line through both centres becomes the direction Q307: by a basic rotation, or by the rotary table."""
    places = [circle(c, m, contacts).centre for contacts in touched]
    for k, (contacts, place, nominal) in enumerate(zip(touched, places, centres(c), strict=True), 1):
        yield from measured(contacts, **{f"center {k} {axis}": (place[n], nominal[n]) for n, axis in enumerate("XY")})
    turned = fits.reduced(needed(fits.line, places, m=m, code=c.code).angle - c.preset_rotation_angle, 360)
    yield Measure("rotation", turned, 0.0, unit="deg", touches=numbers([*touched[0], *touched[1]]))
    if c.compensation == 0:
        yield from store(m, c.row, rotation=turned)
        return
    yield from align(m, C, turned)
    if c.set_to_zero:
        yield from store(m, c.row, **zeroed(m, C))


@CYCLES("TCH PROBE 401", "Basic rotation over two holes", source="14.8", takes=f"{CENTRES} level height {OVER_TWO}")
class OverTwoHoles(ProbingCycle):
    """Four touches of each hole from its programmed center, so that DIST must reach the wall."""

    check = faults
    row: float = row()

    def moves(self, m: Machine) -> Moves:
        yield from reset(m)
        a, touched = self.approach(m), []
        for centre in centres(self):
            touched.append((yield from from_centre(a, centre, m.programmed[2])))
        yield from compensate(self, m, touched)


@CYCLES(
    "TCH PROBE 402", "Basic rotation over two studs", source="14.9",
    takes="first_center_axis_1 first_center_axis_2 diameter_stud_1 level second_center_axis_1 second_center_axis_2 "
          f"diameter_stud_2 measuring_height_stud_2 clearance height move_to_clearance {OVER_TWO}",
)  # fmt: skip
class OverTwoStuds(ProbingCycle):
    """Four touches round each stud, counter-clockwise."""

    check = faults
    row: float = row()
    diameter_stud_1: float = length("Q313", "diameter of the first stud", note="rather too large", example=20)
    level: float = addresses.level(meaning="measuring height at the first stud")
    diameter_stud_2: float = length("Q314", "diameter of the second stud", note="rather too large", example=20)
    measuring_height_stud_2: float = coordinate("Q315", "measuring height at the second stud", example=-5)

    def moves(self, m: Machine) -> Moves:
        yield from reset(m)
        a, touched = self.approach(m), []
        sizes = (self.diameter_stud_1, self.level), (self.diameter_stud_2, self.measuring_height_stud_2)
        for centre, (diameter, level) in zip(centres(self), sizes, strict=True):
            a = replace(a, level=level)
            touched.append((yield from around(a, centre, diameter / 2, 0, 90, 4, False, m.programmed[2], arc=False)))
            found = circle(self, m, touched[-1]).grown(-a.ball)
            yield sketch(Circle(*centre, diameter / 2), found, level, touched[-1])
        yield from compensate(self, m, touched)


@CYCLES("TCH PROBE 404", "Set basic rotation", source="14.11", takes="preset_rotation_angle row")
class SetBasicRotation(ProbingCycle):
    """Nothing moves: the basic rotation of a preset row becomes Q307."""

    preset_rotation_angle: float = addresses.preset_rotation_angle(meaning="basic rotation")
    row: float = row(at_least=-1, note="-1: the active row; 0: row 0, active then", example=-1)

    def check(self, m: Machine) -> Iterator[ParameterFault]:
        yield from self.transformed(m)

    def moves(self, m: Machine) -> Iterator[Step]:
        yield from store(m, active_preset(m) if self.row == -1 else self.row, rotation=self.preset_rotation_angle)


def apart(axis: float, first: Pair, second: Pair) -> Iterator[ParameterFault]:
    """Two touches along an axis of the plane (1, 2) that would meet one place."""
    if first[across := 2 - int(axis)] == second[across]:
        yield ("second_y" if across else "second_x"), "is that of the first touch point: two places make a line"


def edge(m: Machine, a: Approach, code: str, points: Pairs, axis: float, sense: float) -> Touched:
    """Two touches of an edge along an axis of the plane (1, 2); returns the line of the ball's centres, and the contacts."""
    contacts = yield from in_one_axis(a, int(axis) - 1, sense, [(*point, a.level) for point in points], m.programmed[2])
    line = needed(fits.line, [c.point for c in contacts], m=m, code=code)
    direction = (sense, 0.0) if axis == 1 else (0.0, sense)
    touched = fits.off_the_ball([c.point[:2] for c in contacts], direction, a.ball).tolist()
    yield sketch(points, touched, a.level, contacts)
    return line, contacts


@CYCLES(
    "TCH PROBE 403", "Basic rotation compensation via rotary axis", source="14.10",
    takes=f"{LINE} {HEIGHTS} move_to_clearance compensation_axis set_to_zero row transfer reference_angle",
)  # fmt: skip
class RotaryAxis(ProbingCycle):
    """Two touches; a rotary axis turns by the angle of the line through them, which opens from the first to the second.

    Touches along the probe axis show A (places apart in Y) or B (apart in X). Where the axis is named, it turns by less than a
    quarter.
    """

    axis: float = addresses.axis(choices=addresses.AXES, example=2)
    compensation_axis: float = choice("Q312", "rotary axis", AXIS, example=6)
    row: float = row(note="where Q312 is 0, else the active row")
    transfer: float = addresses.transfer(choices=addresses.TABLES)
    reference_angle: float = addresses.reference_angle(meaning="angle of the line that is 0", note="of C")

    @property
    def turns(self) -> int:
        """The rotary axis: 0, 1 or 2."""
        if self.compensation_axis:
            return int(self.compensation_axis) - 4
        return C if self.axis < 3 else int(self.y == self.second_y)

    def contradictions(self) -> Iterator[ParameterFault]:
        if (self.axis == 3) == (self.turns == C):
            yield "compensation_axis", f"{AXES[self.turns]} is not shown by touches along the {addresses.AXES[self.axis]}"
        elif self.axis < 3:
            yield from apart(self.axis, (self.x, self.y), (self.second_x, self.second_y))
        elif self.compensation_axis == 0 and self.x != self.second_x and self.y != self.second_y:
            yield "compensation_axis", "0: the touch points lie apart in both axes: choose 4 (A) or 5 (B)"
        else:
            yield from apart(1 + self.turns, (self.x, self.y), (self.second_x, self.second_y))

    def check(self, m: Machine) -> Iterator[ParameterFault]:
        yield from super().check(m)
        yield from cannot_turn(m, self.turns, "compensation_axis")

    def moves(self, m: Machine) -> Moves:
        a, points = self.approach(m), ((self.x, self.y), (self.second_x, self.second_y))
        if self.axis < 3:
            line, contacts = yield from edge(m, a, self.code, points, self.axis, self.direction)
            turned = line.angle
        else:
            touched = [(*point, self.level) for point in points]
            contacts = yield from in_one_axis(a, 2, self.direction, touched, m.programmed[2])
            (x, y, z), (x_2, y_2, z_2) = (c.point for c in contacts)
            rise, far = (z_2 - z, y_2 - y) if self.turns == 0 else (z - z_2, x_2 - x)
            turned = math.degrees(math.atan2(rise, far))
        nominal = self.reference_angle if self.compensation_axis in (0, 6) else 0.0
        turned = fits.reduced(turned - nominal, 180 if self.compensation_axis else 360)
        yield Measure("rotation", turned, 0.0, unit="deg", touches=numbers(contacts))
        yield from align(m, self.turns, turned)
        if self.set_to_zero:
            zero = zeroed(m, self.turns)
            if self.transfer == 0:
                yield Write("datums", m.tables.datums.get(int(self.row), Datum())._replace(**zero), int(self.row))
            else:
                yield from store(m, active_preset(m) if self.compensation_axis else self.row, **zero)


@CYCLES(
    "TCH PROBE 405", "Compensating workpiece misalignment by rotating the C axis", source="14.12",
    takes=f"centre_x centre_y {ROUND} set_to_zero",
)  # fmt: skip
class HoleBesideTheAxis(ProbingCycle):
    """Four touches of a hole; C turns its center onto the positive Y axis (Q322 = 0), or to its nominal direction.

    The datum must lie in the center of the table. The angle goes to Q150.
    """

    centre_x: float = addresses.centre_x(example=0)
    centre_y: float = addresses.centre_y(note="0: onto the positive Y axis", example=50)
    diameter: float = addresses.diameter(note="rather too small")
    stepping_angle: float = addresses.stepping_angle(note="at least 5 degrees")
    set_to_zero: float = count("Q337", "row of the datum table", note="0: the preset, and C shows 0", example=0)

    def check(self, m: Machine) -> Iterator[ParameterFault]:
        yield from super().check(m)
        yield from cannot_turn(m, C, "")

    def moves(self, m: Machine) -> Moves:
        a = self.approach(m)
        hole, contacts = yield from ring(self, m, a, (self.centre_x, self.centre_y), leave=False)
        yield a.go("to the measured center", x=hole.x, y=hole.y)
        yield a.go("to the clearance height", a.height)
        nominal = math.degrees(math.atan2(self.centre_y, self.centre_x)) if self.centre_y else 90.0
        turned = fits.reduced(math.degrees(math.atan2(hole.y, hole.x)) - nominal, 360)
        yield Measure("rotation", turned, 0.0, unit="deg", touches=numbers(contacts))
        yield from results(Q150=turned)
        yield from align(m, C, turned)
        if number := int(self.set_to_zero):
            before = m.tables.datums.get(number, Datum())
            yield Write("datums", before._replace(c=before.c + turned), number)
        else:
            yield from store(m, active_preset(m), **zeroed(m, C))
