"""Inspection of holes, round studs and bolt hole circles (TNC 620, 16.5, 16.6, 16.12)."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from mnclab.controls.tnc_620.contours.other_tools import Named
from mnclab.controls.tnc_620.cycles.addresses import angle
from mnclab.controls.tnc_620.cycles.faults import SAME, Fault
from mnclab.controls.tnc_620.probing import addresses, inspection
from mnclab.controls.tnc_620.probing.cycle import Moves, ProbingCycle, needed, numbers, too_fine
from mnclab.controls.tnc_620.probing.inspection import middle, report, size, wear
from mnclab.machine.cycle import CycleTable
from mnclab.machine.machine import Machine
from mnclab.machine.touching import Contact
from mnclab.machining.probing.fits import circle
from mnclab.machining.probing.found import Circle
from mnclab.machining.probing.sequences import around, from_centre
from mnclab.machining.probing.sketches import sketch

CYCLES = CycleTable()


@dataclass(frozen=True)
class Round:
    """The parameters of 421 and 422, which differ in the addresses of their limits."""

    centre_x: float = inspection.centre_x()
    centre_y: float = inspection.centre_y()
    diameter: float = addresses.diameter()
    starting_angle: float = addresses.starting_angle()
    stepping_angle: float = addresses.stepping_angle()
    level: float = addresses.level()
    clearance: float = addresses.clearance()
    height: float = addresses.height()
    move_to_clearance: float = addresses.move_to_clearance()
    maximum_limit: float = inspection.maximum("Q275")
    minimum_limit: float = inspection.minimum("Q276")
    tolerance_x: float = inspection.tolerance_x()
    tolerance_y: float = inspection.tolerance_y()
    measuring_log: float = inspection.log()
    program_stop: float = inspection.stop()
    monitored_tool: Named = inspection.tool()
    points: float = addresses.points()
    traverse: float = addresses.traverse()
    reverse_tool: float | None = inspection.reverse_tool()
    angle_of_incidence: float | None = inspection.incidence()


@CYCLES("TCH PROBE 421", "Hole measuring", runs="definition", source="16.5")
class HoleMeasuring(Round, ProbingCycle):
    """Touches along the radius, outward: centre and diameter."""

    tilted = True

    def check(self, m: Machine) -> Iterator[Fault]:
        yield from super().check(m)
        yield from too_fine(self.stepping_angle)
        if self.diameter <= 2 * m.radius:
            yield "diameter", f"must be greater than the ball, {2 * m.radius:g}, got {self.diameter:g}"

    def moves(self, m: Machine) -> Moves:
        return touched_round(self, m, True)


@CYCLES("TCH PROBE 422", "Stud measuring", runs="definition", source="16.6")
class StudMeasuring(Round, ProbingCycle):
    """Touches along the radius, inward: centre and diameter of a round stud."""

    tilted = True
    maximum_limit: float = inspection.maximum("Q277")
    minimum_limit: float = inspection.minimum("Q278")

    def check(self, m: Machine) -> Iterator[Fault]:
        yield from super().check(m)
        yield from too_fine(self.stepping_angle)

    def moves(self, m: Machine) -> Moves:
        return touched_round(self, m, False)


def touched_round(c: HoleMeasuring | StudMeasuring, m: Machine, inside: bool) -> Moves:
    """The touches of a hole or a stud, and what they find."""
    a, centre = c.approach(m), (c.centre_x, c.centre_y)
    contacts = yield from around(
        a, centre, c.diameter / 2, c.starting_angle, c.stepping_angle, int(c.points), inside, m.programmed[2], c.traverse == 1
    )
    balls = needed(circle, [contact.point for contact in contacts], "power", m=m, code=c.code)
    yield from told(c, m, balls.grown(a.ball if inside else -a.ball), contacts, "hole" if inside else "stud", inside)


def told(
    c: HoleMeasuring | StudMeasuring | BoltHoleCircleMeasuring, m: Machine, found: Circle, contacts: Sequence[Contact],
    figure: str, inside: bool | None,
) -> Moves:  # fmt: skip
    """The centre and the diameter that were found."""
    yield sketch(Circle(c.centre_x, c.centre_y, c.diameter / 2), found, c.level, numbers(contacts))
    limits = c.minimum_limit, c.maximum_limit
    wide = size("diameter", "Diameter", "Q153", "Q163", found.diameter, c.diameter, limits, f"dimension for {figure}", inside)
    centre = middle(0, found.x, c.centre_x, c.tolerance_x), middle(1, found.y, c.centre_y, c.tolerance_y)
    yield from report(c, m, [*centre, wide], contacts, [wide], (0.0, 0.0) if inside is None else wear([wide], inside))


@CYCLES("TCH PROBE 430", "Bolt hole circle measuring", runs="definition", source="16.12")
class BoltHoleCircleMeasuring(ProbingCycle):
    """The circle through the centres of three holes, each found by four touches from its nominal centre."""

    tilted = True
    centre_x: float = inspection.centre_x()
    centre_y: float = inspection.centre_y()
    diameter: float = addresses.diameter(meaning="nominal diameter of the bolt hole circle", example=80)
    first_angle: float = angle("Q291", "angle of the first hole", example=0)
    second_angle: float = angle("Q292", "angle of the second hole", example=90)
    third_angle: float = angle("Q293", "angle of the third hole", example=180)
    level: float = addresses.level()
    height: float = addresses.height()
    maximum_limit: float = inspection.maximum("Q288")
    minimum_limit: float = inspection.minimum("Q289")
    tolerance_x: float = inspection.tolerance_x()
    tolerance_y: float = inspection.tolerance_y()
    measuring_log: float = inspection.log()
    program_stop: float = inspection.stop()
    monitored_tool: Named = inspection.tool(note="only whether it is broken; 0: none")

    @property
    def angles(self) -> tuple[float, float, float]:
        """Of the three holes, degrees."""
        return self.first_angle, self.second_angle, self.third_angle

    def contradictions(self) -> Iterator[Fault]:
        for k, name in ((1, "second_angle"), (2, "third_angle")):
            if any(abs(math.remainder(self.angles[k] - other, 360)) < SAME for other in self.angles[:k]):
                yield name, f"names the same hole again, got {self.angles[k]:g}: three holes make a circle"
        if self.diameter <= 0:
            yield "diameter", f"must be greater than 0, got {self.diameter:g}"

    def moves(self, m: Machine) -> Moves:
        a, now, centres = self.approach(m), m.programmed[2], []
        contacts: list[Contact] = []
        for turn in map(math.radians, self.angles):
            hole = self.centre_x + self.diameter / 2 * math.cos(turn), self.centre_y + self.diameter / 2 * math.sin(turn)
            touched = yield from from_centre(a, hole, now)
            contacts, now = [*contacts, *touched], a.height
            centres.append(needed(circle, [contact.point for contact in touched], "power", m=m, code=self.code).centre)
        yield from told(self, m, needed(circle, centres, m=m, code=self.code), contacts, "bolt hole circle", None)
