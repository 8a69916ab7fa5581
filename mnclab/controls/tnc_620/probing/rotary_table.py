"""Misalignment taken back by a rotary axis: cycles 403 and 405 (TNC 620, 14.10, 14.12)."""

from __future__ import annotations

import math
from collections.abc import Iterator

from mnclab.controls.tnc_620.cycles.addresses import choice, count
from mnclab.controls.tnc_620.cycles.faults import Fault
from mnclab.controls.tnc_620.probing import addresses
from mnclab.controls.tnc_620.probing.addresses import HEIGHTS, LINE, ROUND
from mnclab.controls.tnc_620.probing.cycle import Moves, ProbingCycle, numbers, results
from mnclab.controls.tnc_620.probing.figures import ring
from mnclab.controls.tnc_620.probing.misalignment import C, align, cannot_turn, zeroed
from mnclab.controls.tnc_620.probing.rotation import apart, edge, row
from mnclab.controls.tnc_620.probing.transfer import store
from mnclab.controls.tnc_620.state import active_preset
from mnclab.machine.cycle import CycleTable
from mnclab.machine.machine import Machine
from mnclab.machine.rotary import AXES
from mnclab.machine.setup import Datum
from mnclab.machining.probing import fits
from mnclab.machining.probing.sequences import in_one_axis
from mnclab.machining.steps import Measure, Write

CYCLES = CycleTable(addresses=addresses, runs="definition")
AXIS: dict[float, str] = {0: "the one that the touches show", 4: "A", 5: "B", 6: "C"}


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

    def contradictions(self) -> Iterator[Fault]:
        if (self.axis == 3) == (self.turns == C):
            yield "compensation_axis", f"{AXES[self.turns]} is not shown by touches along the {addresses.AXES[self.axis]}"
        elif self.axis < 3:
            yield from apart(self.axis, (self.x, self.y), (self.second_x, self.second_y))
        elif self.compensation_axis == 0 and self.x != self.second_x and self.y != self.second_y:
            yield "compensation_axis", "0: the touch points lie apart in both axes: choose 4 (A) or 5 (B)"
        else:
            yield from apart(1 + self.turns, (self.x, self.y), (self.second_x, self.second_y))

    def check(self, m: Machine) -> Iterator[Fault]:
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

    def check(self, m: Machine) -> Iterator[Fault]:
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
