"""Slots: cycles 253 (straight, 6.4) and 254 (circular, 6.5).

A slot lies about a centre line from the centre of its first arc (the left one, the one at the starting angle) to that of
its last; the tool goes to the first one, and all passes count from there. A slot as wide as the tool is roughed on the
line alone, whatever Q368, down to Q369, and not finished.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator
from typing import TypeAlias

import numpy as np

from mnclab.controls.tnc_620.cycles import addresses, milling
from mnclab.controls.tnc_620.cycles.addresses import choice, coordinate, count, length
from mnclab.controls.tnc_620.cycles.faults import Fault, at_least
from mnclab.controls.tnc_620.cycles.milling import Figure, Place
from mnclab.controls.tnc_620.cycles.planes import AtSurface, in_program_coordinates
from mnclab.controls.tnc_620.cycles.pockets import check_angle, feeds, slopes
from mnclab.geometry import contours
from mnclab.geometry.contours import Contour
from mnclab.machine.coordinates import MILLS, tool
from mnclab.machine.cycle import CycleTable, few_passes, too_many
from mnclab.machine.machine import Machine
from mnclab.machining.milling.concentric import NOTHING
from mnclab.machining.milling.entries import swing
from mnclab.machining.milling.figures import Slot, mill_slot, straight
from mnclab.machining.milling.pocket_steps import Down
from mnclab.machining.steps import Step

CYCLES = CycleTable()
PLUNGE: dict[float, str] = {0: "vertical", 1: "reciprocating", 2: "as 1"}
LENGTHWISE: dict[float, str] = {
    0: "the tool is at the centre of the slot", 1: "at its left end", 2: "at the centre of the left arc",
    3: "at the centre of the right arc", 4: "at its right end",
}  # fmt: skip
ON_CIRCLE: dict[float, str] = {
    0: "centre and starting angle say where the slot lies", 1: "the tool is at the centre of the left arc",
    2: "in the middle of the centre line", 3: "at the centre of the right arc",
}  # fmt: skip


@CYCLES("CYCL DEF 253", "Slot milling", source="6.4")
class StraightSlot(AtSurface):
    """Mills a straight slot: roughing in layers, to and fro on a ramp, then its side, then its floor."""

    does = MILLS
    about = in_program_coordinates
    check = milling.check
    contradictions = milling.contradictions
    machining_operation: float = addresses.operation()
    slot_length: float = length("Q218", "slot length", note="over all", example=80)
    slot_width: float = addresses.slot_width()
    side_allowance: float = addresses.side_allowance()
    rotation_angle: float = addresses.rotation("Q374")
    slot_position: float = choice("Q367", "slot position", LENGTHWISE, example=0)
    milling_feed: float = addresses.milling_feed()
    milling_type: float = addresses.climb(predef=True)
    depth: float = addresses.depth()
    infeed: float = addresses.layer()
    floor_allowance: float = addresses.floor_allowance()
    plunging_feed: float = addresses.plunge_feed(also=addresses.PLANE)
    finishing_infeed: float = addresses.finishing_infeed()
    clearance: float = addresses.clearance(predef=True)
    surface: float = addresses.surface()
    second_clearance: float = addresses.second_clearance(predef=True, example=50)
    plunging_strategy: float = addresses.plunging(PLUNGE)
    finishing_feed: float | None = addresses.finishing_feed(default=None, default_means="as Q207", example=500)
    feed_reference: float = addresses.feed_reference()

    def fits(self, m: Machine) -> Iterator[Fault]:
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

    def moves(self, m: Machine) -> Iterator[Step]:
        """Turned about the tool, which goes back to the centre if it was there; else it stays above the left arc."""
        half, reach = self.slot_length / 2, self.line_length / 2
        to_centre = (0.0, half, reach, -reach, -half)[int(self.slot_position)]
        x, y = (np.array(m.programmed[:2]) + (to_centre - reach) * self.ahead).tolist()
        return mill(self, m, [((x, y), self.line())], None if self.slot_position else m.programmed[:2])


@CYCLES("CYCL DEF 254", "Circular slot", source="6.5")
class CircularSlot(AtSurface):
    """Mills slots on a pitch circle: each roughed in layers, to and fro on a ramp, then its side, then its floor."""

    does = MILLS
    about = in_program_coordinates
    check = milling.check
    contradictions = milling.contradictions
    machining_operation: float = addresses.operation()
    slot_width: float = addresses.slot_width()
    side_allowance: float = addresses.side_allowance()
    pitch_circle_diameter: float = length("Q375", "pitch circle diameter", example=80)
    slot_position: float = choice("Q367", "reference of the slot position", ON_CIRCLE, example=0)
    centre_x: float = coordinate("Q216", "centre in the first axis", note="only with Q367 = 0", example=50)
    centre_y: float = coordinate("Q217", "centre in the second axis", note="only with Q367 = 0", example=50)
    starting_angle: float = addresses.angle("Q376", "starting angle", note="polar", example=45)
    angular_length: float = addresses.angle("Q248", "opening angle of the slot", at_least=0, incremental=True, example=90)
    stepping_angle: float = addresses.angle("Q378", "stepping angle", incremental=True, example=180)
    repetitions: float = count("Q377", "number of slots", at_least=1, example=2)
    milling_feed: float = addresses.milling_feed()
    milling_type: float = addresses.climb(predef=True)
    depth: float = addresses.depth()
    infeed: float = addresses.layer()
    floor_allowance: float = addresses.floor_allowance()
    plunging_feed: float = addresses.plunge_feed(also=addresses.PLANE)
    finishing_infeed: float = addresses.finishing_infeed()
    clearance: float = addresses.clearance()
    surface: float = addresses.surface()
    second_clearance: float = addresses.second_clearance(example=50)
    plunging_strategy: float = addresses.plunging(PLUNGE)
    finishing_feed: float | None = addresses.finishing_feed(default=None, default_means="as Q207", example=500)
    feed_reference: float = addresses.feed_reference()

    def fits(self, m: Machine) -> Iterator[Fault]:
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

    def moves(self, m: Machine) -> Iterator[Step]:
        """To the centre of the circle at the end if the tool has no place of its own; else it stays above the last slot."""
        return mill(self, m, self.places(m), None if self.slot_position else self.centre(m))


AnySlot: TypeAlias = StraightSlot | CircularSlot

# --- what both share ------------------------------------------------------------------------------------------------


def slot(c: AnySlot, m: Machine, line: Contour) -> Slot:
    """The shape of one slot."""
    return Slot(line, c.slot_width, m.radius, c.milling_type >= 0)


def check_slot(c: AnySlot, m: Machine, line: Contour, length: float, count: int = 1) -> Iterator[Fault]:
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
        yield from too_many("plunging_strategy", lambda: way_in(c, m, line)(0.0, levels[0] - c.surface))
    yield from too_many("slot_width", lambda: shape.clearing(0.0))
    yield from few_passes("infeed", len(levels), count * len(shape.clearing(c.side_allowance).passes))


def way_in(c: AnySlot, m: Machine, line: Contour) -> Down:
    """To and fro along the line, or straight down at its beginning."""
    angle = tool(m).plunge_angle
    return (lambda top, bottom: swing(line, top, bottom, angle)) if slopes(c, m) else straight


def mill(c: AnySlot, m: Machine, places: Iterable[tuple[Place, Contour]], last: Place | None) -> Iterator[Step]:
    """Each slot from the second set-up plane: roughing, side, floor."""
    work, why = milling.work(c, m, feeds(c, m)), "neither Q368 nor Q369 is given"
    if not work.is_nothing and abs(c.slot_width / 2 - m.radius) <= NOTHING:
        work, why = work._replace(walls=(), floor=()), "the slot is as wide as the tool"
    slots = (Figure(start, start, mill_slot(slot(c, m, line), work, way_in(c, m, line))) for start, line in places)
    return milling.mill(c, m, work, slots, () if last is None else [*c.leave(), milling.back(last)], why)
