"""Pockets and slots: cycles 251 to 254 (6.2 to 6.5)."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator
from functools import partial

import numpy as np

from mnclab.controls.tnc_620.cycles import addresses, milling
from mnclab.controls.tnc_620.cycles.addresses import choice, coordinate, count, length
from mnclab.controls.tnc_620.cycles.milling import Figure, MilledFigure, Place
from mnclab.controls.tnc_620.cycles.planes import SAME, ParameterFault, at_least, at_most
from mnclab.geometry import contours
from mnclab.geometry.contours import Contour
from mnclab.machine.coordinates import tool
from mnclab.machine.cycle import CycleTable, too_many, too_many_passes
from mnclab.machine.machine import Machine
from mnclab.machining.milling.entries import Descent, Entry, onto_floor, swing
from mnclab.machining.milling.faces import NOTHING
from mnclab.machining.milling.pocket_steps import (
    Down,
    LevelFeeds,
    Pocket,
    Room,
    Slot,
    circular,
    mill_pocket,
    mill_slot,
    rectangular,
    straight,
    way_down,
)
from mnclab.machining.steps import Step

# Rectangular and circular pockets: cycles 251 (6.2) and 252 (6.3), and how a tool goes down into a pocket or a slot.
# C is the centre of the pocket, R the tool radius, Room where the centre of the tool may go about C.

CYCLES = CycleTable(addresses=addresses.shared(**milling.PARAMETERS))
WORK = "milling_feed milling_type depth infeed floor_allowance plunging_feed finishing_infeed clearance surface second_clearance"
LAST = "plunging_strategy finishing_feed feed_reference"
ENTRIES = ("vertical", "helix", "ramp")
CORNER = {0: "the tool is at the centre"} | addresses.CORNERS
SIGNS = ((0, 0), (1, 1), (-1, 1), (-1, -1), (1, -1))  # from the tool to the centre, in half sides
CORNERS = 1.4  # times R, the widest step between two rectangles with sharp corners that leaves nothing between them


@CYCLES(
    "CYCL DEF 251", "Rectangular pocket", source="6.2",
    takes=f"machining_operation first_side_length second_side_length corner_radius side_allowance rotation_angle "
          f"pocket_position {WORK} overlap {LAST}",
)  # fmt: skip
class RectangularPocket(MilledFigure):
    """Mills a rectangular pocket: roughing in layers from the centre outwards, then its walls, then its floor."""

    corner_radius: float = length("Q220", "corner radius", note="0: the tool radius", example=8)
    pocket_position: float = choice("Q367", "pocket position", CORNER, example=0)
    plunging_strategy: float = addresses.plunging(addresses.PLUNGE)

    def contradictions(self) -> Iterator[ParameterFault]:
        yield from super().contradictions()
        if self.depth:
            half = min(self.first_side_length, self.second_side_length) / 2
            yield from at_most(self, "corner_radius", half, "half the shorter side")

    def fits(self, m: Machine) -> Iterator[ParameterFault]:
        least = 2 * (m.radius + self.side_allowance)
        for name in ("first_side_length", "second_side_length"):
            yield from at_least(self, name, least, "the tool diameter and twice Q368")
        if 0 < self.corner_radius < m.radius - SAME:
            yield "corner_radius", f"must be 0 or at least the tool radius, {m.radius:g}, got {self.corner_radius:g}"
        yield from check_pocket(self, m, self.pocket(m))

    def pocket(self, m: Machine) -> Pocket:
        """Begun on the reference axis, along which a ramp swings."""
        return rectangular(
            self.first_side_length, self.second_side_length, m.radius, min(self.overlap, CORNERS) * m.radius,
            corner=self.corner_radius, angle=math.radians(self.rotation_angle), climb=self.milling_type >= 0, begin=0,
        )  # fmt: skip

    def steps(self, m: Machine) -> Iterator[Step]:
        """C lies half the sides away from the tool, turned about the tool."""
        sides = self.first_side_length, self.second_side_length
        u, v = (np.array(SIGNS[int(self.pocket_position)]) * sides / 2).tolist()
        x, y = milling.turned(u, v, self.rotation_angle)
        return mill(self, m, self.pocket(m), (m.programmed[0] + x, m.programmed[1] + y))


@CYCLES(
    "CYCL DEF 252", "Circular pocket", source="6.3",
    takes=f"machining_operation circle_diameter side_allowance {WORK} overlap {LAST}",
)  # fmt: skip
class CircularPocket(MilledFigure):
    """Mills a circular pocket about the tool position: roughing in layers outwards, then its wall, then its floor."""

    circle_diameter: float = length("Q223", "circle diameter", example=60)
    overlap: float = addresses.overlap(at_least=0.1)
    plunging_strategy: float = addresses.plunging({0: "vertical", 1: "helical"})

    def fits(self, m: Machine) -> Iterator[ParameterFault]:
        least = 2 * (m.radius + self.side_allowance)
        yield from at_least(self, "circle_diameter", least, "the tool diameter and twice Q368")
        yield from check_pocket(self, m, self.pocket(m))
        if not self.plunging_strategy and m.tool.plunge_angle not in (0, 90):
            angle = f"the plunge angle (ANGLE) of tool {m.tool.number} to be 0 or 90, it is {m.tool.plunge_angle:g}"
            yield "plunging_strategy", f"0 needs {angle}"

    def pocket(self, m: Machine) -> Pocket:
        return circular(self.circle_diameter, m.radius, self.overlap * m.radius, climb=self.milling_type >= 0)

    def steps(self, m: Machine) -> Iterator[Step]:
        """Roughing alone ends at the second set-up clearance before the tool goes to the middle."""
        end = self.end if self.machining_operation == 1 and self.depth < 0 else None
        return mill(self, m, self.pocket(m), m.programmed[:2], end)


# --- what both share ------------------------------------------------------------------------------------------------


def check_pocket(c: MilledFigure, m: Machine, pocket: Pocket) -> Iterator[ParameterFault]:
    """No more passes than somebody would wait for, and the tool gets down."""
    yield from too_many("overlap", lambda: pocket.clearing(0.0))
    levels, room = milling.levels(c, m), pocket.room(c.side_allowance)
    yield from too_many_passes("infeed", len(levels), len(pocket.clearing(c.side_allowance).passes))
    yield from check_angle(c, m)
    if c.machining_operation == 2:
        return
    if c.plunging_strategy == 1 and slopes(c, m) and m.settings["plunge_error"]:
        if room.half_width < m.radius - SAME:
            widest, least = 2 * (room.half_width + m.radius), 4 * m.radius
            yield "plunging_strategy", f"1 has a helix {widest:g} wide: at least twice the tool diameter, {least:g}"
    if c.plunging_strategy == 2 and slopes(c, m) and room.half_length < 2 * m.radius - SAME:
        found = f"{2 * room.half_length:g} is less than twice the tool diameter, {4 * m.radius:g}"
        yield "plunging_strategy", f"2 has no room for a ramp: {found}"
    yield from too_many("plunging_strategy", lambda: way_in(c, m, room)(0.0, levels[0] - c.surface))


def check_angle(c: MilledFigure, m: Machine) -> Iterator[ParameterFault]:
    """All strategies but the vertical one need a plunge angle."""
    if c.plunging_strategy and not 0 < m.tool.plunge_angle <= 90:
        angle = f"the plunge angle (ANGLE) of tool {m.tool.number}, greater than 0 and at most 90"
        yield "plunging_strategy", f"{c.plunging_strategy:g} needs {angle}, in the tool table"


def slopes(c: MilledFigure, m: Machine) -> bool:
    """Whether the tool goes down on a helix or a ramp; at 90 degrees both are straight down."""
    return bool(c.plunging_strategy > 0 and m.tool.plunge_angle < 90)


def way_in(c: MilledFigure, m: Machine, room: Room) -> Down:
    """The way from one level to another; straight down where a helix is as narrow as the tool."""
    sloping = slopes(c, m) and not (c.plunging_strategy == 1 and room.half_width < NOTHING)
    entry = Entry(ENTRIES[int(c.plunging_strategy)], tool(m).plunge_angle) if sloping else Entry()
    return partial(way_down, entry, room, m.radius, c.milling_type >= 0)


def feeds(c: MilledFigure, m: Machine) -> tuple[LevelFeeds, LevelFeeds, LevelFeeds]:
    """Of roughing, the side and the floor: from which Q439 on they count at the cutting edge; ways down never do."""
    first, second, third = (m.radius if c.feed_reference >= least else 0.0 for least in (3, 1, 2))
    plunge, finish = c.plunging_feed, milling.finishing_feed(c)
    return LevelFeeds(c.milling_feed, plunge, first), LevelFeeds(finish, plunge, second), LevelFeeds(finish, plunge, third)


def mill(c: MilledFigure, m: Machine, pocket: Pocket, centre: Place, end: float | None = None) -> Iterator[Step]:
    """Roughing in layers, the walls in infeeds, the floor; then back to where the tool was called."""
    whole, work = pocket.room(0.0), milling.work(c, m, feeds(c, m))

    def to_floor(top: float, bottom: float) -> Descent:
        """On a quarter circle along the reference axis, which touches the floor in the middle; straight without room."""
        if c.floor_allowance > whole.half_length:
            return straight(top, bottom)
        return onto_floor((0.0, 0.0), whole.direction, top, bottom)

    def figures() -> Iterator[Figure]:  # only where the depth is not 0, and all that the tool needs is known
        down = way_in(c, m, pocket.room(c.side_allowance))
        steps = mill_pocket(
            pocket, work, down, to_floor, over_walls=milling.wall_levels(c)[0] + work.lift,
            off_floor=min(c.clearance, whole.half_width), end=end,
        )  # fmt: skip
        yield Figure(centre, centre, steps)

    return milling.mill(c, m, work, figures(), [milling.back(m.programmed[:2])])


# Slots: cycles 253 (straight, 6.4) and 254 (circular, 6.5).
# A slot lies about a centre line from the centre of its first arc (the left one, the one at the starting angle) to that of
# its last; the tool goes to the first one, and all passes count from there. A slot as wide as the tool is roughed on the
# line alone, whatever Q368, down to Q369, and not finished.

PLUNGE: dict[float, str] = {0: "vertical", 1: "reciprocating", 2: "as 1"}
LENGTHWISE: dict[float, str] = {
    0: "the tool is at the centre of the slot", 1: "at its left end", 2: "at the centre of the left arc",
    3: "at the centre of the right arc", 4: "at its right end",
}  # fmt: skip
ON_CIRCLE: dict[float, str] = {
    0: "centre and starting angle say where the slot lies", 1: "the tool is at the centre of the left arc",
    2: "in the middle of the centre line", 3: "at the centre of the right arc",
}  # fmt: skip


@CYCLES(
    "CYCL DEF 253", "Slot milling", source="6.4",
    takes=f"machining_operation slot_length slot_width side_allowance rotation_angle slot_position {WORK} {LAST}",
)  # fmt: skip
class StraightSlot(MilledFigure):
    """Mills a straight slot: roughing in layers, to and fro on a ramp, then its side, then its floor."""

    slot_length: float = length("Q218", "slot length", note="over all", example=80)
    rotation_angle: float = addresses.rotation("Q374")
    slot_position: float = choice("Q367", "slot position", LENGTHWISE, example=0)
    plunging_strategy: float = addresses.plunging(PLUNGE)

    def fits(self, m: Machine) -> Iterator[ParameterFault]:
        yield from at_least(self, "slot_length", self.slot_width, "the width Q219")
        yield from check_slot(self, m, self.line(), self.line_length)

    @property
    def line_length(self) -> float:
        """From arc centre to arc centre."""
        return max(self.slot_length - self.slot_width, 0.0)

    @property
    def ahead(self) -> np.ndarray:
        """From the left to the right."""
        return np.array(milling.turned(1.0, 0.0, self.rotation_angle))

    def line(self) -> Contour:
        return Contour(np.outer([0.0, self.line_length], self.ahead), closed=False)

    def steps(self, m: Machine) -> Iterator[Step]:
        """Turned about the tool, which goes back to the centre if it was there; else it stays above the left arc."""
        half, reach = self.slot_length / 2, self.line_length / 2
        to_centre = (0.0, half, reach, -reach, -half)[int(self.slot_position)]
        x, y = (np.array(m.programmed[:2]) + (to_centre - reach) * self.ahead).tolist()
        return mill_slots(self, m, [((x, y), self.line())], None if self.slot_position else m.programmed[:2])


@CYCLES(
    "CYCL DEF 254", "Circular slot", source="6.5",
    takes=f"machining_operation slot_width side_allowance pitch_circle_diameter slot_position centre_x centre_y "
          f"starting_angle angular_length stepping_angle repetitions {WORK} {LAST}",
)  # fmt: skip
class CircularSlot(MilledFigure):
    """Mills slots on a pitch circle: each roughed in layers, to and fro on a ramp, then its side, then its floor."""

    pitch_circle_diameter: float = length("Q375", "pitch circle diameter", example=80)
    slot_position: float = choice("Q367", "reference of the slot position", ON_CIRCLE, example=0)
    centre_x: float = coordinate("Q216", "centre in the first axis", note="only with Q367 = 0", example=50)
    centre_y: float = coordinate("Q217", "centre in the second axis", note="only with Q367 = 0", example=50)
    starting_angle: float = addresses.angle("Q376", "starting angle", note="polar", example=45)
    angular_length: float = addresses.angle("Q248", "opening angle of the slot", at_least=0, incremental=True, example=90)
    stepping_angle: float = addresses.angle("Q378", "stepping angle", incremental=True, example=180)
    repetitions: float = count("Q377", "number of slots", at_least=1, example=2)
    clearance: float = addresses.clearance()
    second_clearance: float = addresses.second_clearance(example=50)
    plunging_strategy: float = addresses.plunging(PLUNGE)

    def fits(self, m: Machine) -> Iterator[ParameterFault]:
        if self.pitch_circle_diameter <= self.slot_width + NOTHING:
            found = f"{self.slot_width:g}, got {self.pitch_circle_diameter:g}"
            yield "pitch_circle_diameter", f"must be greater than the slot width Q219, {found}"
        _, line = next(self.places(m))
        length = self.pitch_circle_diameter / 2 * math.radians(self.angular_length)
        yield from check_slot(self, m, line, length, int(self.repetitions))

    def centre(self, m: Machine) -> Place:
        """Of the pitch circle: as it is written, or from the tool, which stands on the circle."""
        if not self.slot_position:
            return self.centre_x, self.centre_y
        dx, dy = milling.turned(self.pitch_circle_diameter / 2, 0.0, self.starting_angle)
        return m.programmed[0] - dx, m.programmed[1] - dy

    def places(self, m: Machine) -> Iterator[tuple[Place, Contour]]:
        """Slot after slot, each turned on by the stepping angle; Q376 is where the tool stands on the first one."""
        x, y = self.centre(m)
        before = (0.0, 0.0, self.angular_length / 2, self.angular_length)[int(self.slot_position)]
        for k in range(int(self.repetitions)):
            begin = math.radians(self.starting_angle - before) + k * math.radians(self.stepping_angle)
            arc = contours.arc(self.pitch_circle_diameter / 2, begin, math.radians(self.angular_length))
            dx, dy = arc.points[0].tolist()
            yield (x + dx, y + dy), Contour(arc.points - (dx, dy), arc.bulge, closed=False)

    def steps(self, m: Machine) -> Iterator[Step]:
        """To the centre of the circle at the end if the tool has no place of its own; else it stays above the last slot."""
        return mill_slots(self, m, self.places(m), None if self.slot_position else self.centre(m))


# --- what both share ------------------------------------------------------------------------------------------------


def slot(c: MilledFigure, m: Machine, line: Contour) -> Slot:
    """The shape of one slot."""
    return Slot(line, c.slot_width, m.radius, c.milling_type >= 0)


def check_slot(c: MilledFigure, m: Machine, line: Contour, length: float, count: int = 1) -> Iterator[ParameterFault]:
    """The tool fits, and gets down; no more passes than somebody would wait for."""
    shape = slot(c, m, line)
    if not shape.is_full:
        yield from at_least(c, "slot_width", 2 * m.radius, "the tool diameter")
        yield from at_least(c, "slot_width", 2 * m.radius + 2 * c.side_allowance, "the tool diameter and twice Q368")
    yield from check_angle(c, m)
    levels = milling.levels(c, m)
    if c.plunging_strategy and slopes(c, m) and c.machining_operation != 2:
        if length <= NOTHING:
            yield "plunging_strategy", f"{c.plunging_strategy:g} has no room for a ramp: the slot is round"
        yield from too_many("plunging_strategy", lambda: slot_way_in(c, m, line)(0.0, levels[0] - c.surface))
    yield from too_many("slot_width", lambda: shape.clearing(0.0))
    yield from too_many_passes("infeed", len(levels), count * len(shape.clearing(c.side_allowance).passes))


def slot_way_in(c: MilledFigure, m: Machine, line: Contour) -> Down:
    """To and fro along the line, or straight down at its beginning."""
    angle = tool(m).plunge_angle
    return (lambda top, bottom: swing(line, top, bottom, angle)) if slopes(c, m) else straight


def mill_slots(c: MilledFigure, m: Machine, places: Iterable[tuple[Place, Contour]], last: Place | None) -> Iterator[Step]:
    """Each slot from the second set-up plane: roughing, side, floor."""
    work, why = milling.work(c, m, feeds(c, m)), "neither Q368 nor Q369 is given"
    if not work.is_nothing and abs(c.slot_width / 2 - m.radius) <= NOTHING:
        work, why = work._replace(walls=(), floor=()), "the slot is as wide as the tool"
    slots = (Figure(start, start, mill_slot(slot(c, m, line), work, slot_way_in(c, m, line))) for start, line in places)
    return milling.mill(c, m, work, slots, () if last is None else [*c.leave(), milling.back(last)], why)
