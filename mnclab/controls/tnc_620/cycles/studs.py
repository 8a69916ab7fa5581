"""Studs: cycles 256 (rectangular, 6.6), 257 (circular, 6.7) and 258 (polygon, 6.8).

C is the centre of the stud, R the tool radius, S the start beside the blank: the edge of the tool is 2 mm away from it, so
there must be room for the tool diameter and 2 mm. On S the tool goes down, and to it it comes back from every level.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator
from functools import partial
from typing import TypeAlias

import numpy as np

from mnclab.controls.tnc_620.cycles import addresses, milling
from mnclab.controls.tnc_620.cycles.addresses import choice, length, number
from mnclab.controls.tnc_620.cycles.milling import Figure, MilledFigure, Place
from mnclab.controls.tnc_620.cycles.planes import ParameterFault, at_least, at_most, rate
from mnclab.controls.tnc_620.cycles.pockets import CORNER, SIGNS
from mnclab.controls.tnc_620.machining import studs
from mnclab.controls.tnc_620.machining.studs import Stud, mill_stud
from mnclab.machine.cycle import CycleTable, too_many, too_many_passes
from mnclab.machine.machine import Machine
from mnclab.machining.milling.clearing import Clearing
from mnclab.machining.milling.pocket_steps import LevelFeeds
from mnclab.machining.steps import Step

ASIDE = 2.0  # mm, from the blank to the edge of the tool at the start, and off the stud after a pass
APPROACH = {0: "on the right of the stud"} | addresses.CORNERS
CIRCLES: dict[float, str] = {0: "the size is that of the inscribed circle", 1: "of the circumscribed circle"}
CYCLES = CycleTable(addresses=addresses.shared(**milling.PARAMETERS | {
    "machining_operation": partial(addresses.machining_operation, default=1),
    "plunging_feed": partial(addresses.plunge_feed, also=("FMAX", *addresses.PLANE)),
    "overlap": partial(addresses.overlap, at_least=0.0001),
    "floor_allowance": partial(addresses.floor_allowance, default=0),
    "finishing_infeed": partial(addresses.finishing_infeed, default=0),
    "finishing_feed": partial(addresses.finishing_feed, default=0, example=800),
}))  # fmt: skip


@CYCLES(
    "CYCL DEF 256", "Rectangular stud", source="6.6",
    takes="first_side_length blank_side_1 second_side_length blank_side_2 corner_radius_or_chamfer side_allowance "
          "rotation_angle stud_position milling_feed milling_type depth infeed plunging_feed clearance surface second_clearance "
          "overlap approach_position machining_operation floor_allowance finishing_infeed finishing_feed",
)  # fmt: skip
class RectangularStud(MilledFigure):
    """Mills a rectangular stud free: roughing in layers from the blank inwards, then its side, then the floor about it."""

    stands = True
    first_side_length: float = length("Q218", "first side length", example=60)
    blank_side_1: float = length("Q424", "first side of the blank", note="at least Q218", example=74)
    second_side_length: float = length("Q219", "second side length", example=40)
    blank_side_2: float = length("Q425", "second side of the blank", note="at least Q219", example=60)
    corner_radius_or_chamfer: float = addresses.corner(example=5)
    stud_position: float = choice("Q367", "stud position", CORNER, example=0)
    overlap: float = addresses.overlap(at_least=0.1)
    approach_position: float = choice("Q437", "approach position", APPROACH, default=0, example=0)

    def fits(self, m: Machine) -> Iterator[ParameterFault]:
        yield from at_least(self, "blank_side_1", self.first_side_length, "the side of the stud Q218", 0.0)
        yield from at_least(self, "blank_side_2", self.second_side_length, "the side of the stud Q219", 0.0)
        half = min(self.first_side_length, self.second_side_length) / 2
        if abs(self.corner_radius_or_chamfer) > half:
            found = f"{half:g}, got {self.corner_radius_or_chamfer:g}"
            yield "corner_radius_or_chamfer", f"must be at most half the shorter side, {found}"
        yield from check_passes(self, m)

    @property
    def sides(self) -> tuple[Place, Place]:
        """Of the stud and of the blank, the first and the second one."""
        return (self.first_side_length, self.blank_side_1), (self.second_side_length, self.blank_side_2)

    def clearing(self, radius: float, allowance: float, blank: bool) -> Clearing:
        """Rings begun on the right, or a spiral from a corner."""
        u, v = (max(whole if blank else 0.0, side + 2 * allowance) for side, whole in self.sides)
        return studs.rectangle(
            self.first_side_length, self.second_side_length, (u, v), radius, self.overlap * radius,
            corner=self.corner_radius_or_chamfer, allowance=allowance, climb=self.milling_type >= 0,
            angle=math.radians(self.rotation_angle),
            begin=int(self.approach_position) - 1 if self.approach_position else None,
        )  # fmt: skip

    def stud(self, m: Machine) -> Stud:
        """S on the right of the blank, or beside two of its sides; on the right the tool leaves the stud as far as S."""
        aside = ASIDE / m.scale
        u, v = (max(blank / 2 + aside, side / 2 + self.side_allowance) + m.radius for side, blank in self.sides)
        if not self.approach_position:
            return Stud(partial(self.clearing, m.radius), milling.turned(u, 0.0, self.rotation_angle))
        x, y = SIGNS[int(self.approach_position)]
        return Stud(partial(self.clearing, m.radius), milling.turned(-x * u, -y * v, self.rotation_angle), aside)

    def steps(self, m: Machine) -> Iterator[Step]:
        """C lies half the sides away from the tool, turned about the tool."""
        u, v = SIGNS[int(self.stud_position)]
        x, y = milling.turned(u * self.first_side_length / 2, v * self.second_side_length / 2, self.rotation_angle)
        return mill(self, m, (m.programmed[0] + x, m.programmed[1] + y))


@CYCLES(
    "CYCL DEF 257", "Circular stud", source="6.7",
    takes="finished_diameter blank_diameter side_allowance milling_feed milling_type depth infeed plunging_feed clearance "
          "surface second_clearance overlap starting_angle machining_operation floor_allowance finishing_infeed finishing_feed",
)  # fmt: skip
class CircularStud(MilledFigure):
    """Mills a circular stud about the tool position free: on a spiral from the blank inwards, then its side and the floor."""

    stands = True
    finished_diameter: float = length("Q223", "diameter of the finished stud", example=50)
    blank_diameter: float = length("Q222", "diameter of the blank", note="at least Q223", example=80)
    starting_angle: float = addresses.angle(
        "Q376", "starting angle", at_least=-1, default=-1, note="from the centre of the stud; -1: as the control likes, 0",
        example=0,
    )  # fmt: skip

    def contradictions(self) -> Iterator[ParameterFault]:
        yield from super().contradictions()
        if -1 < self.starting_angle < 0:
            yield "starting_angle", f"must be -1 or at least 0, got {self.starting_angle:g}"

    def fits(self, m: Machine) -> Iterator[ParameterFault]:
        yield from at_least(self, "blank_diameter", self.finished_diameter, "the diameter of the stud Q223", 0.0)
        yield from check_passes(self, m)

    @property
    def angle(self) -> float:
        """Q376, degrees; where the control may choose, it chooses 0."""
        return max(self.starting_angle, 0.0)

    def clearing(self, radius: float, allowance: float, blank: bool) -> Clearing:
        stock = max(self.blank_diameter if blank else 0.0, self.finished_diameter + 2 * allowance)
        return studs.circle(
            self.finished_diameter, stock, radius, self.overlap * radius, allowance=allowance,
            climb=self.milling_type >= 0, angle=math.radians(self.angle),
        )  # fmt: skip

    def stud(self, m: Machine) -> Stud:
        """S on the ray of the starting angle."""
        aside = ASIDE / m.scale
        away = max(self.blank_diameter / 2 + aside, self.finished_diameter / 2 + self.side_allowance) + m.radius
        return Stud(partial(self.clearing, m.radius), milling.turned(away, 0.0, self.angle), aside)

    def steps(self, m: Machine) -> Iterator[Step]:
        return mill(self, m, m.programmed[:2], [milling.back(m.programmed[:2])])


@CYCLES(
    "CYCL DEF 258", "Polygon stud", source="6.8",
    takes="reference_circle reference_diameter blank_diameter corners rotation_angle corner_radius_or_chamfer side_allowance "
          "milling_feed milling_type depth infeed plunging_feed clearance surface second_clearance overlap machining_operation "
          "floor_allowance finishing_infeed finishing_feed",
)  # fmt: skip
class PolygonStud(MilledFigure):
    """Mills a regular polygon about the tool position free: on a spiral from the round blank inwards, then side and floor."""

    stands = True
    reference_circle: float = choice("Q573", "reference circle", CIRCLES, example=0)
    reference_diameter: float = length("Q571", "diameter of the reference circle", example=50)
    blank_diameter: float = length("Q222", "diameter of the blank", note="greater than Q571", example=80)
    corners: float = number("Q572", "number of corners", at_least=3, at_most=30, example=6)
    rotation_angle: float = addresses.angle("Q224", "angle of the first corner", example=15)
    corner_radius_or_chamfer: float = addresses.corner(example=2)
    side_allowance: float = addresses.side_allowance(at_least=-addresses.FAR, note="negative: so much smaller")
    machining_operation: float = addresses.machining_operation()
    floor_allowance: float = addresses.floor_allowance()
    finishing_infeed: float = addresses.finishing_infeed()
    finishing_feed: float = addresses.finishing_feed(example=800)

    def fits(self, m: Machine) -> Iterator[ParameterFault]:
        if self.blank_diameter <= self.reference_diameter:
            found = f"{self.reference_diameter:g}, got {self.blank_diameter:g}"
            yield "blank_diameter", f"must be greater than the reference circle Q571, {found}"
        corner, bevel = self.corner_radius_or_chamfer, self.inscribed * math.tan(math.pi / self.corners)
        yield from at_most(self, "corner_radius_or_chamfer", self.inscribed, "the radius of the inscribed circle")
        if -corner > bevel:
            yield "corner_radius_or_chamfer", f"must be a bevel of at most half a side, {bevel:g}, got {-corner:g}"
        if not self.inscribed and self.machining_operation != 1:
            yield "reference_diameter", "must be greater than 0, got 0: finishing would leave no stud"
        if self.inscribed + self.side_allowance <= 0:
            found = f"{self.inscribed:g} of the inscribed circle, got {self.side_allowance:g}"
            yield "side_allowance", f"must leave something of the radius {found}"
        yield from check_passes(self, m)

    @property
    def inscribed(self) -> float:
        """The radius of the inscribed circle."""
        half = math.cos(math.pi / self.corners) if self.reference_circle else 1.0
        return self.reference_diameter / 2 * half

    def clearing(self, radius: float, allowance: float, blank: bool) -> Clearing:
        stock = max(self.blank_diameter if blank else 0.0, 2 * (self.inscribed + allowance))
        return studs.polygon(
            int(self.corners), self.inscribed, stock, radius, self.overlap * radius, corner=self.corner_radius_or_chamfer,
            allowance=allowance, climb=self.milling_type >= 0, angle=math.radians(self.rotation_angle),
        )  # fmt: skip

    def stud(self, m: Machine) -> Stud:
        """S on the ray of the first corner, outside of the blank and of the corners; back to it in the second set-up plane."""
        aside = ASIDE / m.scale
        apex = self.clearing(m.radius, max(self.side_allowance, 0.0), False).passes[0].points[0]
        away = max(self.blank_diameter / 2 + m.radius, float(np.hypot(*apex))) + aside
        start = milling.turned(away, 0.0, self.rotation_angle)
        return Stud(partial(self.clearing, m.radius), start, aside, self.end)

    def steps(self, m: Machine) -> Iterator[Step]:
        return mill(self, m, m.programmed[:2])


AnyStud: TypeAlias = RectangularStud | CircularStud | PolygonStud


# --- what they share ------------------------------------------------------------------------------------------------


def check_passes(c: AnyStud, m: Machine) -> Iterator[ParameterFault]:
    """A number of passes that somebody would wait for."""
    made: list[Clearing] = []
    yield from too_many("overlap", lambda: made.append(c.clearing(m.radius, c.side_allowance, True)))
    passes = made[0].passes
    yield from too_many_passes("infeed", len(milling.levels(c, m)), sum(len(contour.starts) for contour in passes) // 4)


def mill(c: AnyStud, m: Machine, centre: Place, last: Iterable[Step] = ()) -> Iterator[Step]:
    """To S, and from there roughing in layers, the side in infeeds, the floor; at the end the tool stays above S."""
    plunge = rate(c.plunging_feed)
    finishing = LevelFeeds(milling.finishing_feed(c), plunge)
    work = milling.work(c, m, (LevelFeeds(c.milling_feed, plunge), finishing, finishing))

    def figures() -> Iterator[Figure]:  # a stud has none where its depth is 0, and its sizes anything
        stud = c.stud(m)
        yield Figure((centre[0] + stud.start[0], centre[1] + stud.start[1]), centre, mill_stud(stud, work))

    return milling.mill(c, m, work, figures(), last)
