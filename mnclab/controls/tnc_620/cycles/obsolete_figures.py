"""Obsolete slots, and finishing of pockets and studs, which still run (1.2): cycles 210 to 215."""

from __future__ import annotations

import math
from collections.abc import Iterator
from functools import partial
from typing import ClassVar, NamedTuple

import numpy as np

from mnclab.controls.tnc_620.cycles import addresses, planes
from mnclab.controls.tnc_620.cycles.addresses import coordinate, distance, length
from mnclab.controls.tnc_620.cycles.planes import AtSurface, ParameterFault
from mnclab.controls.tnc_620.machining.finishing import finish_rounds
from mnclab.controls.tnc_620.machining.slots import oblique_infeeds
from mnclab.geometry import contours
from mnclab.geometry.contours import Contour
from mnclab.machine.coordinates import MILLS
from mnclab.machine.cycle import CycleTable, too_many
from mnclab.machine.machine import Machine
from mnclab.machining.depths import infeeds
from mnclab.machining.milling.faces import NOTHING
from mnclab.machining.milling.pocket_steps import LevelFeeds, half_circles
from mnclab.machining.steps import Along, Go, Say, Step, moved

# Obsolete slots with a reciprocating plunge, which still run (1.2): 210 straight, 211 circular.
# They are those of earlier manuals (TNC 426/430 8.4, iTNC 530). A slot lies about a centre line from the centre of its first
# arc (the left one, the one at the starting angle) to that of its last. Roughing cuts along that line alone, finishing once
# round the wall. Readings where they are silent: one reciprocating movement is there and back, so each way sinks by half of
# Q202; finishing goes up to the wall and off it on half circles, in 210 from the middle of the line, in 211 from its begin.

CYCLES = CycleTable(addresses=addresses.shared(
    second_clearance=partial(addresses.second_clearance, example=50), plunging_feed=addresses.plunge_feed,
    infeed=partial(addresses.infeed, note="greater than 0"), finishing_infeed=partial(addresses.finishing_infeed, default=0),
    centre_x=partial(coordinate, "Q216", "centre along the first axis", example=50),
    centre_y=partial(coordinate, "Q217", "centre along the second axis", example=50),
    first_side_length=partial(distance, "Q218", "first side length", example=80),
    second_side_length=partial(distance, "Q219", "second side length", example=60),
    allowance=partial(distance, "Q221", "allowance in the first axis", note="for pre-positioning", example=2),
))  # fmt: skip
SLOT = "clearance depth milling_feed infeed machining_operation surface second_clearance centre_x centre_y"
WIDEST = 3  # tool diameters


class CentreLine(NamedTuple):
    """The centre line of a slot; the way from its end to where finishing begins; how far along the wall that leads to it."""

    line: Contour
    back: Contour
    along: float = 0.0


class ReciprocatingSlot(AtSurface):
    """What both share: all of it counts from the centre Q216, Q217."""

    does = MILLS
    about = planes.in_program_coordinates
    straight: ClassVar[bool] = False
    """Whether roughing ends with the way back to where finishing begins, even if none follows."""
    milling_feed = machining_operation = centre_x = centre_y = slot_width = finishing_infeed = 0.0
    infeed: float = addresses.infeed(note="of one way there and back")
    plunging_feed: float = addresses.plunge_feed(default=0, note="of finishing; 0: as Q207")

    def contradictions(self) -> Iterator[ParameterFault]:
        """An infeed; a depth of 0 is not executed, so nothing of it can be wrong."""
        if self.depth:
            yield from planes.not_zero(self, "infeed")
            yield from too_many("finishing_infeed", self.finishing_levels)

    def check(self, m: Machine) -> Iterator[ParameterFault]:
        """The tool fits into the slot, and is not less than a third as wide."""
        if not self.depth:
            return
        yield from self.signs(m)
        yield from planes.with_radius(m)
        yield from planes.not_zero(self, "milling_feed", purpose="to mill with")
        yield from planes.at_least(self, "slot_width", 2 * m.radius, "the tool diameter")
        if self.slot_width > (most := WIDEST * 2 * m.radius) + planes.SAME:
            yield "slot_width", f"must be at most three times the tool diameter, {most:g}, got {self.slot_width:g}"
        yield from too_many("infeed", lambda: self.pecks(m))
        yield from self.fits(m)

    def finishing_levels(self) -> tuple[float, ...]:
        return infeeds(self.surface, self.surface + self.depth, self.finishing_infeed)

    def mill(self, m: Machine, slot: CentreLine) -> Iterator[Step]:
        """Roughing from the begin of the line, finishing from the end of the way back; all counts from Q216 and Q217."""
        inset = self.slot_width / 2 - m.radius
        finishes = self.machining_operation != 1 and inset > NOTHING
        if self.machining_operation == 2 and not finishes:
            yield Say("Q215=2 finishes nothing: the slot is as wide as the tool")
        else:
            x, y = (slot.back.points[-1] if self.machining_operation == 2 else slot.line.points[0]).tolist()
            yield Go("to the second set-up clearance", max(m.programmed[2], self.end))
            yield Go("over the start", x=self.centre_x + x, y=self.centre_y + y)
            yield Go("to the set-up clearance", self.above)
            yield from moved(self.cut(slot, inset if finishes else 0.0), self.centre_x, self.centre_y)
            yield from self.leave()

    def cut(self, slot: CentreLine, inset: float) -> Iterator[Step]:
        """From the set-up clearance down to the bottom; several infeeds of finishing begin at the set-up clearance again."""
        levels, feed = self.finishing_levels(), self.milling_feed
        if self.machining_operation != 2:
            yield Go("to the surface", self.surface, feed)
            levels_of_roughing = infeeds(self.surface, self.surface + self.depth, self.infeed)
            yield from oblique_infeeds(slot.line, self.surface, levels_of_roughing, feed)
            if inset or self.straight:
                yield Along("back", slot.back, feed)
            if inset and len(levels) > 1:
                yield Go("to the set-up clearance", self.above)
        if inset:
            wall = contours.slot(slot.line.reversed(), 2 * inset).started_at(slot.along)
            start = slot.back.points[-1].tolist()
            feeds = LevelFeeds(feed, self.plunging_feed or feed)
            yield from finish_rounds(wall, half_circles(wall, inset, 1), (start[0], start[1]), levels, feeds)


@CYCLES(
    "CYCL DEF 210", "Slot with reciprocating plunge", source="1.2",
    takes=f"{SLOT} slot_length slot_width rotation_angle finishing_infeed plunging_feed",
)  # fmt: skip
class StraightSlot(ReciprocatingSlot):
    """Mills a straight slot along its middle, to and fro and down on the way, then round its wall."""

    straight = True
    slot_length: float = length("Q218", "slot length", note="over all", example=80)
    rotation_angle: float = addresses.angle("Q224", "angle of rotation", note="about the centre of the slot", example=15)

    def fits(self, m: Machine) -> Iterator[ParameterFault]:
        if self.slot_length <= max(4 * m.radius, self.slot_width) + NOTHING:
            least = max(4 * m.radius, self.slot_width)
            yield "slot_length", f"must be greater than twice the tool diameter and Q219, {least:g}, got {self.slot_length:g}"

    def steps(self, m: Machine) -> Iterator[Step]:
        """From the middle of the slot the half circle leads to the wall on the right of the line."""
        half = max(self.slot_length - self.slot_width, 0.0) / 2
        ahead = contours.placed(np.array([(half, 0.0)]), (0, 0), math.radians(self.rotation_angle))
        line, back = (Contour(np.vstack([one, two]), closed=False) for one, two in ((-ahead, ahead), (ahead, 0 * ahead)))
        return self.mill(m, CentreLine(line, back, (self.slot_width / 2 - m.radius) * math.pi / 2 + half))


@CYCLES(
    "CYCL DEF 211", "Circular slot with reciprocating plunge", source="1.2",
    takes=f"{SLOT} pitch_circle_diameter slot_width starting_angle angular_length finishing_infeed plunging_feed",
)  # fmt: skip
class CircularSlot(ReciprocatingSlot):
    """Mills a slot on an arc along its middle, to and fro and down on the way, then round its wall."""

    pitch_circle_diameter: float = length("Q244", "diameter of the pitch circle", example=80)
    starting_angle: float = addresses.angle("Q245", "starting angle", example=45)
    angular_length: float = addresses.angle("Q248", "angular length of the slot", incremental=True, at_least=0, example=90)

    def fits(self, m: Machine) -> Iterator[ParameterFault]:
        if self.pitch_circle_diameter <= self.slot_width + NOTHING:
            found = f"{self.slot_width:g}, got {self.pitch_circle_diameter:g}"
            yield "pitch_circle_diameter", f"must be greater than the slot width Q219, {found}"
        if (way := self.pitch_circle_diameter / 2 * math.radians(self.angular_length)) <= NOTHING:
            yield "angular_length", f"must make a way for the plunge, got {way:g} mm"

    def steps(self, m: Machine) -> Iterator[Step]:
        begin, sweep = math.radians(self.starting_angle), math.radians(self.angular_length)
        line = contours.arc(self.pitch_circle_diameter / 2, begin, sweep)
        return self.mill(m, CentreLine(line, line.reversed()))


# Obsolete finishing of pockets and studs, which still runs (1.2): 212 and 213 rectangular, 214 and 215 circular.
# They are those of earlier manuals (TNC 426/430 8.4, iTNC 530). C is the centre Q216 Q217, R the tool radius, S the start on
# the right of C, where the tool goes down from level to level; it goes once round in climb milling and comes back to S.
#     212    S at Q218/2 - R - Q221, or at C where Q221 is 0 or leaves no way     214    at Q222/2 - R, or at C
#     213    S at Q218/2 + Q221 + 3.5 R                                           215    at Q222/2 + 3.5 R
# Readings where they are silent: the ways up to the wall and off it are half circles that end where the tool is nearest to S;
# in a narrow pocket they are as wide as it.

FINISHED = "clearance depth plunging_feed infeed milling_feed surface second_clearance centre_x centre_y"
ASIDE = 3.5  # times R, from the blank of a stud to S


class Finishing(AtSurface):
    """What the four share; who inherits says where its wall is, and what of the sizes does not fit."""

    does = MILLS
    about = planes.in_program_coordinates
    infeed: float
    plunging_feed = milling_feed = centre_x = centre_y = first_side_length = second_side_length = corner_radius = allowance = 0.0

    def check(self, m: Machine) -> Iterator[ParameterFault]:
        """The sign of the depth, feeds and infeeds; a depth of 0 is not executed, so nothing of it can be wrong."""
        if not self.depth:
            return
        yield from self.signs(m)
        yield from planes.with_radius(m)
        yield from planes.not_zero(self, "plunging_feed", "infeed", "milling_feed", purpose="to mill with")
        yield from too_many("infeed", lambda: self.pecks(m))
        yield from self.fits(m)

    def finish(self, m: Machine, wall: Contour, start: float, aside: float) -> Iterator[Step]:
        """By way of C to S, so far on its right, round on every level, and back over C; half circles are as wide as `aside`."""
        x, y = self.centre_x, self.centre_y
        arcs, feeds = half_circles(wall, aside, 1), LevelFeeds(self.milling_feed, self.plunging_feed)
        yield Go("to the second set-up clearance", max(m.programmed[2], self.end))
        yield Go("over the centre", x=x, y=y)
        yield Go("over the start", x=x + start)
        yield Go("to the set-up clearance", self.above)
        yield from moved(finish_rounds(wall, arcs, (start, 0.0), self.pecks(m), feeds), x, y)
        yield from self.leave()
        yield Go("over the centre", x=x, y=y)


def fitting_corner(c: Finishing) -> Iterator[ParameterFault]:
    yield from planes.at_most(c, "corner_radius", min(c.first_side_length, c.second_side_length) / 2, "half the shorter side")


@CYCLES(
    "CYCL DEF 212", "Pocket finishing", source="1.2",
    takes=f"{FINISHED} first_side_length second_side_length corner_radius allowance",
)  # fmt: skip
class PocketFinishing(Finishing):
    """Finishes the wall of a rectangular pocket on each infeed."""

    corner_radius: float = length("Q220", "corner radius", note="0: the tool radius", example=8)

    def fits(self, m: Machine) -> Iterator[ParameterFault]:
        for name in ("first_side_length", "second_side_length"):
            yield from planes.at_least(self, name, 3 * m.radius, "three times the tool radius")
        if 0 < self.corner_radius < m.radius - planes.SAME:
            yield "corner_radius", f"must be 0 or at least the tool radius, {m.radius:g}, got {self.corner_radius:g}"
        yield from fitting_corner(self)

    def steps(self, m: Machine) -> Iterator[Step]:
        r, corner = m.radius, max(self.corner_radius, m.radius) - m.radius
        wall = contours.rectangle(self.first_side_length - 2 * r, self.second_side_length - 2 * r, corner)
        wide = self.first_side_length / 2 - r
        start = max(0.0, wide - self.allowance) if self.allowance else 0.0
        return self.finish(m, wall, start, min(wide - start, self.second_side_length - 2 * r))


@CYCLES(
    "CYCL DEF 213", "Stud finishing", source="1.2",
    takes=f"{FINISHED} first_side_length second_side_length corner_radius allowance",
)  # fmt: skip
class StudFinishing(Finishing):
    """Finishes the side of a rectangular stud on each infeed."""

    corner_radius: float = length("Q220", "corner radius", example=5)

    def fits(self, m: Machine) -> Iterator[ParameterFault]:
        yield from planes.not_zero(self, "first_side_length", "second_side_length")
        yield from fitting_corner(self)

    def steps(self, m: Machine) -> Iterator[Step]:
        r = m.radius
        wall = contours.rectangle(self.first_side_length + 2 * r, self.second_side_length + 2 * r, self.corner_radius + r)
        start = self.first_side_length / 2 + self.allowance + ASIDE * r
        return self.finish(m, wall.reversed(), start, start - self.first_side_length / 2 - r)


@CYCLES("CYCL DEF 214", "Circular pocket finishing", source="1.2", takes=f"{FINISHED} blank_diameter finished_diameter")
class CircularPocketFinishing(Finishing):
    """Finishes the wall of a circular pocket on each infeed."""

    blank_diameter: float = length("Q222", "diameter of the rough pocket", note="less than Q223; 0: down at C", example=76)
    finished_diameter: float = length("Q223", "diameter of the finished pocket", example=80)

    def fits(self, m: Machine) -> Iterator[ParameterFault]:
        yield from planes.at_least(self, "finished_diameter", 3 * m.radius, "three times the tool radius")
        if self.blank_diameter >= self.finished_diameter:
            found = f"{self.finished_diameter:g}, got {self.blank_diameter:g}"
            yield "blank_diameter", f"must be less than the diameter of the finished pocket Q223, {found}"

    def steps(self, m: Machine) -> Iterator[Step]:
        reach, start = self.finished_diameter / 2 - m.radius, max(0.0, self.blank_diameter / 2 - m.radius)
        return self.finish(m, Contour.circle((0, 0), reach), start, reach - start)


@CYCLES("CYCL DEF 215", "Circular stud finishing", source="1.2", takes=f"{FINISHED} blank_diameter finished_diameter")
class CircularStudFinishing(Finishing):
    """Finishes the side of a circular stud on each infeed."""

    blank_diameter: float = length("Q222", "diameter of the blank", note="greater than Q223", example=84)
    finished_diameter: float = length("Q223", "diameter of the finished stud", example=80)

    def fits(self, m: Machine) -> Iterator[ParameterFault]:
        yield from planes.not_zero(self, "finished_diameter")
        if self.blank_diameter <= self.finished_diameter:
            found = f"{self.finished_diameter:g}, got {self.blank_diameter:g}"
            yield "blank_diameter", f"must be greater than the diameter of the finished stud Q223, {found}"

    def steps(self, m: Machine) -> Iterator[Step]:
        reach, start = self.finished_diameter / 2 + m.radius, self.blank_diameter / 2 + ASIDE * m.radius
        return self.finish(m, Contour.circle((0, 0), reach, clockwise=True), start, start - reach)
