"""Inspection of rectangles, slots and ridges (TNC 620, 16.7 to 16.10)."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

from mnclab.controls.tnc_620.contours.other_tools import Named
from mnclab.controls.tnc_620.cycles.addresses import coordinate, increment
from mnclab.controls.tnc_620.cycles.faults import SAME, Fault
from mnclab.controls.tnc_620.probing import addresses, inspection
from mnclab.controls.tnc_620.probing.cycle import Moves, ProbingCycle, needed, numbers
from mnclab.controls.tnc_620.probing.inspection import AXES, middle, report, size, wear
from mnclab.controls.tnc_620.probing.log import Value
from mnclab.machine.cycle import CycleTable
from mnclab.machine.machine import Machine
from mnclab.machine.touching import Contact
from mnclab.machining.probing.fits import rectangle
from mnclab.machining.probing.found import Rectangle
from mnclab.machining.probing.sequences import ROUND, Aim, between, in_plane, sides
from mnclab.machining.probing.sketches import sketch

CYCLES = CycleTable()


@dataclass(frozen=True)
class Rectangular:
    """The parameters of 423 and 424."""

    centre_x: float = inspection.centre_x()
    centre_y: float = inspection.centre_y()
    length: float = inspection.side("Q282", "length along the reference axis", example=60)
    width: float = inspection.side("Q283", "length along the minor axis", example=40)
    level: float = addresses.level()
    clearance: float = addresses.clearance()
    height: float = addresses.height()
    move_to_clearance: float = addresses.move_to_clearance()
    first_maximum: float = inspection.maximum("Q284", meaning="maximum limit of the first side")
    first_minimum: float = inspection.minimum("Q285", meaning="minimum limit of the first side")
    second_maximum: float = inspection.maximum("Q286", meaning="maximum limit of the second side")
    second_minimum: float = inspection.minimum("Q287", meaning="minimum limit of the second side")
    tolerance_x: float = inspection.tolerance_x()
    tolerance_y: float = inspection.tolerance_y()
    measuring_log: float = inspection.log()
    program_stop: float = inspection.stop()
    monitored_tool: Named = inspection.tool()


@CYCLES("TCH PROBE 423", "Pocket measuring", runs="definition", source="16.7")
class PocketMeasuring(Rectangular, ProbingCycle):
    """Touches in the middle of the four sides of a rectangular pocket: its centre, its length and its width."""

    tilted = True

    def check(self, m: Machine) -> Iterator[Fault]:
        yield from super().check(m)
        for name in ("length", "width"):
            if getattr(self, name) <= 2 * m.radius:
                yield name, f"must be greater than the ball, {2 * m.radius:g}, got {getattr(self, name):g}"

    def moves(self, m: Machine) -> Moves:
        return touched_sides(self, m, True)


@CYCLES("TCH PROBE 424", "Rectangular stud measuring", runs="definition", source="16.8")
class RectangularStudMeasuring(Rectangular, ProbingCycle):
    """Touches in the middle of the four sides of a rectangular stud: its centre, its length and its width."""

    tilted = True

    def moves(self, m: Machine) -> Moves:
        return touched_sides(self, m, False)


def touched_sides(c: PocketMeasuring | RectangularStudMeasuring, m: Machine, inside: bool) -> Moves:
    """The touches of a pocket or a stud, and what they find."""
    a, centre, lengths = c.approach(m), (c.centre_x, c.centre_y), (c.length, c.width)
    contacts = yield from sides(a, centre, (lengths[0] / 2, lengths[1] / 2), ROUND, inside, m.programmed[2])
    right, back, left, front = (contact.point for contact in contacts)
    found = needed(rectangle, [right, left, back, front], m=m, code=c.code).grown(a.ball if inside else -a.ball)
    yield sketch(Rectangle(*centre, *lengths), found, c.level, numbers(contacts))
    limits = (c.first_minimum, c.first_maximum), (c.second_minimum, c.second_maximum)
    measured = ("length", found.length), ("width", found.width)
    sizes = [
        size(what, f"Length in {axis}", f"Q15{4 + k}", f"Q16{4 + k}", actual, lengths[k], limits[k], f"length in {axis}", inside)
        for k, (axis, (what, actual)) in enumerate(zip(AXES, measured))
    ]
    middles = middle(0, found.x, c.centre_x, c.tolerance_x), middle(1, found.y, c.centre_y, c.tolerance_y)
    yield from report(c, m, [*middles, *sizes], contacts, sizes, wear(sizes, inside))


@CYCLES("TCH PROBE 425", "Slot width measuring", runs="definition", source="16.9")
class SlotMeasuring(ProbingCycle):
    """From a starting point in the slot to the wall ahead, then, perhaps from another line, to the wall behind."""

    tilted = True
    x: float = coordinate("Q328", "starting point, reference axis", example=50)
    y: float = coordinate("Q329", "starting point, minor axis", example=30)
    offset: float = increment("Q310", "offset of the second measurement", note="along the other axis", example=0)
    axis: float = addresses.axis()
    level: float = addresses.level()
    height: float = addresses.height()
    nominal_length: float = inspection.side("Q311", "nominal length", example=10)
    maximum_limit: float = inspection.maximum("Q288")
    minimum_limit: float = inspection.minimum("Q289")
    measuring_log: float = inspection.log()
    program_stop: float = inspection.stop()
    monitored_tool: Named = inspection.tool()
    clearance: float = addresses.clearance()
    move_to_clearance: float = addresses.move_to_clearance()

    def moves(self, m: Machine) -> Moves:
        a, k = self.approach(m), int(self.axis) - 1
        ahead = (1.0, 0.0) if k == 0 else (0.0, 1.0)
        (far,) = yield from in_plane(a, [Aim(self.x, self.y, ahead, 0.0)], m.programmed[2], leave=False)
        start = [self.x, self.y]
        start[1 - k] += self.offset
        if self.offset:
            yield from between(a, start[0], start[1], ())
        start[k] = min(start[k], far.point[k] + a.ball - self.nominal_length + a.away)
        aim = Aim(start[0], start[1], (-ahead[0], -ahead[1]), 0.0)
        (near,) = yield from in_plane(a, [aim], a.height)  # as if it stood up there: it stays at the measuring height
        yield from told(self, m, far, near, [far, near], True)


@CYCLES("TCH PROBE 426", "Ridge width measuring", runs="definition", source="16.10")
class RidgeMeasuring(ProbingCycle):
    """From outside: the wall at the larger coordinate in the negative direction, then the other one in the positive."""

    tilted = True
    x: float = addresses.first_x()
    y: float = addresses.first_y()
    second_x: float = addresses.second_x()
    second_y: float = addresses.second_y()
    axis: float = addresses.axis()
    level: float = addresses.level()
    clearance: float = addresses.clearance()
    height: float = addresses.height()
    nominal_length: float = inspection.side("Q311", "nominal length", example=60)
    maximum_limit: float = inspection.maximum("Q288")
    minimum_limit: float = inspection.minimum("Q289")
    measuring_log: float = inspection.log()
    program_stop: float = inspection.stop()
    monitored_tool: Named = inspection.tool()

    @property
    def along(self) -> int:
        """The measuring axis, 0 or 1."""
        return int(self.axis) - 1

    @property
    def points(self) -> list[tuple[float, float]]:
        """The nominal points, the one at the larger coordinate of the measuring axis first."""
        return sorted([(self.x, self.y), (self.second_x, self.second_y)], key=lambda point: -point[self.along])

    def contradictions(self) -> Iterator[Fault]:
        far, near = self.points
        if far[self.along] - near[self.along] < SAME:
            yield ("second_x", "second_y")[self.along], "is that of the first touch point: a ridge lies between two"

    def moves(self, m: Machine) -> Moves:
        a, (far, near) = replace(self.approach(m), over=True), self.points
        x, y = (1.0, 0.0) if self.along == 0 else (0.0, 1.0)
        contacts = yield from in_plane(a, [Aim(*far, (-x, -y)), Aim(*near, (x, y))], m.programmed[2])
        yield from told(self, m, contacts[0], contacts[1], contacts, False)


def told(
    c: SlotMeasuring | RidgeMeasuring, m: Machine, far: Contact, near: Contact, contacts: Sequence[Contact], inside: bool
) -> Moves:
    """From the touch of the wall that is farther along the axis, and the other one: width and centre line."""
    k, ball = int(c.axis) - 1, m.radius if inside else -m.radius
    walls, other, half = (near.point[k] - ball, far.point[k] + ball), near.point[1 - k], c.nominal_length / 2
    line = sum(walls) / 2
    nominal, found = ([(x, other) if k == 0 else (other, x) for x in pair] for pair in ((line - half, line + half), walls))
    yield sketch(nominal, found, c.level, numbers(contacts))
    limits, width = (c.minimum_limit, c.maximum_limit), walls[1] - walls[0]
    wide = size("width", "Measured length", "Q156", "Q166", width, c.nominal_length, limits, "length", inside)
    yield from report(
        c, m, [wide, Value("XY"[k], f"Centerline in {AXES[k]}", line, "Q157")], contacts, [wide], wear([wide], inside)
    )
