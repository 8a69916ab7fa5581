"""Studs: cycles 256 (rectangular, 6.6), 257 (circular, 6.7) and 258 (polygon, 6.8).

C is the centre of the stud, R the tool radius, S the start beside the blank: the edge of the tool is 2 mm away from it, so
there must be room for the tool diameter and 2 mm. On S the tool goes down, and to it it comes back from every level. A
finishing feed of 0 is the milling feed: Q385 came later than the cycles.
"""

from __future__ import annotations

import math
from abc import abstractmethod
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from mnclab.controls.tnc_620.cycles import addresses
from mnclab.controls.tnc_620.cycles.holes import rate
from mnclab.controls.tnc_620.cycles.milling import ANY_FEED, FigureMilling
from mnclab.controls.tnc_620.cycles.pockets import CORNER, SIGNS
from mnclab.machine.cycle import CycleTable, few_passes, too_many
from mnclab.machine.machine import Machine
from mnclab.machine.true_size import tool
from mnclab.machining.milling import studs
from mnclab.machining.milling.clearing import Clearing
from mnclab.machining.milling.pocket_steps import Feeds
from mnclab.machining.milling.stud_steps import Lifting, mill_stud
from mnclab.machining.steps import Go
from mnclab.running.performing import perform

CYCLES = CycleTable()

ASIDE = 2.0  # mm, from the blank to the edge of the tool at the start, and off the stud after a pass
APPROACH: dict[float, str] = {
    0: "on the right of the stud",
    1: "at the lower left corner",
    2: "at the lower right corner",
    3: "at the upper right corner",
    4: "at the upper left corner",
}
CIRCLES: dict[float, str] = {0: "the size is that of the inscribed circle", 1: "of the circumscribed circle"}
ROUND = "rounding (+) or bevel (-) of the corners"


@dataclass(frozen=True)
class Stud(FigureMilling):
    """What all studs share."""

    machining_operation: float = addresses.operation(default=1, example=0)
    floor_allowance: float = addresses.floor_allowance(default=0, example=0.1)
    plunging_feed: float = addresses.plunge_feed(("FMAX", *ANY_FEED), example=150)
    finishing_infeed: float = addresses.finishing_infeed(default=0, example=5)
    finishing_feed: float = addresses.finishing_feed(default=0, example=800)
    overlap: float = addresses.overlap(0.0001, note="stepover at most Q370 times R", example=1)

    # --- what a shape says -------------------------------------------------------------------------------------------

    def centre(self, m: Machine) -> tuple[float, float]:
        """C, in program coordinates; the tool position."""
        return m.programmed[:2]

    @abstractmethod
    def start(self, radius: float, aside: float) -> tuple[float, float]:
        """S, counted from C; `aside` is `ASIDE` in lengths of the program."""

    @abstractmethod
    def clearing(self, radius: float, allowance: float, blank: bool = True) -> Clearing:
        """The passes from the blank to the stud and an allowance, about (0, 0); without a blank the last one alone."""

    def off(self, aside: float) -> float | None:
        """How far the tool leaves the stud to the side after a pass; None: as far as S."""
        return aside

    def lifting(self) -> Lifting | None:
        """How the tool goes back to S: on the level, or at a height."""
        return None

    # --- what follows from it ----------------------------------------------------------------------------------------

    @property
    def finish_feed(self) -> float:
        """As in roughing where none is given."""
        return self.finishing_feed or self.milling_feed

    def roughing_feeds(self, radius: float) -> Feeds:
        """In the plane and down; FMAX is rapid."""
        return Feeds(self.milling_feed, rate(self.plunging_feed))

    def side_feeds(self, radius: float) -> Feeds:
        """Along the stud."""
        return Feeds(self.finish_feed, rate(self.plunging_feed))

    floor_feeds = side_feeds

    def check_figure(self, m: Machine) -> Iterator[tuple[str, str]]:
        """Sizes, and a number of passes that somebody would wait for."""
        sizes = list(self.check_sizes())
        yield from sizes
        if sizes:
            return
        yield from too_many("overlap", lambda: self.clearing(m.radius, self.side_allowance))
        passes = self.clearing(m.radius, self.side_allowance).passes
        yield from few_passes("infeed", len(self.levels(tool(m))), sum(len(contour.starts) for contour in passes) // 4)

    @abstractmethod
    def check_sizes(self) -> Iterator[tuple[str, str]]:
        """Whether the blank holds the stud, and the stud its corners."""

    def parts(self, m: Machine) -> Iterator[tuple[str, tuple[float, ...], Clearing, Feeds]]:
        """What is done: its name, levels, passes and feeds."""
        radius, outermost = m.radius, min(self.side_allowance, 0.0)
        if self.roughs:
            yield "layer", self.levels(tool(m)), self.clearing(radius, self.side_allowance), self.roughing_feeds(radius)
        if self.finishes_side:
            yield "side finishing", self.wall_levels(), self.clearing(radius, 0.0, blank=False), self.side_feeds(radius)
        if self.finishes_floor:
            yield "floor finishing", (self.floor,), self.clearing(radius, outermost), self.floor_feeds(radius)

    def moves(self, m: Machine) -> None:
        """To S, and from there roughing in layers, the side in infeeds, the floor."""
        if not self.executed(m) or self.finishes_nothing(m):
            return
        aside, side = ASIDE / m.scale, 1 if self.climb else -1
        centre, start, off = self.centre(m), self.start(m.radius, aside), self.off(aside)
        self.to_start(m, (centre[0] + start[0], centre[1] + start[1]))
        for name, levels, passes, feeds in self.parts(m):
            perform(m, self.code, [Go(f"{name}, to the clearance level", self.above)])
            steps = mill_stud(name, passes, levels, start, feeds, side=side, off=off, lifting=self.lifting())
            perform(m, self.code, steps, centre)
        self.to_end(m, self.last(centre))

    def last(self, centre: tuple[float, float]) -> tuple[float, float] | None:
        """Where the tool goes at the end; None: it stays above S."""
        return None


@CYCLES("CYCL DEF 256", "Rectangular stud", runs="call", source="6.6")
class RectangularStud(Stud):
    """Mills a rectangular stud free: roughing in layers from the blank inwards, then its side, then the floor about it."""

    first_side_length: float = addresses.length("Q218", "first side length", example=60)
    blank_side_1: float = addresses.length("Q424", "first side of the blank", note="at least Q218", example=74)
    second_side_length: float = addresses.length("Q219", "second side length", example=40)
    blank_side_2: float = addresses.length("Q425", "second side of the blank", note="at least Q219", example=60)
    corner_radius_or_chamfer: float = addresses.coordinate("Q220", ROUND, note="a bevel counts on each side", example=5)
    rotation_angle: float = addresses.angle("Q224", "angle of rotation", note="about the tool position", example=15)
    stud_position: float = addresses.choice("Q367", "stud position", CORNER, example=0)
    overlap: float = addresses.overlap(0.1, note="stepover at most Q370 times R", example=1)
    approach_position: float = addresses.choice("Q437", "approach position", APPROACH, default=0, example=0)

    def check_sizes(self) -> Iterator[tuple[str, str]]:
        """Both sides of the blank, and the corners."""
        sides = (self.first_side_length, self.blank_side_1), (self.second_side_length, self.blank_side_2)
        for name, address, (side, blank) in zip(("blank_side_1", "blank_side_2"), ("Q218", "Q219"), sides, strict=True):
            if blank < side:
                yield name, f"must be at least the side of the stud {address}, {side:g}, got {blank:g}"
        half = min(self.first_side_length, self.second_side_length) / 2
        if abs(self.corner_radius_or_chamfer) > half:
            found = f"{half:g}, got {self.corner_radius_or_chamfer:g}"
            yield "corner_radius_or_chamfer", f"must be at most half the shorter side, {found}"

    @property
    def angle(self) -> float:
        """Q224 in rad."""
        return math.radians(self.rotation_angle)

    def turned(self, u: float, v: float) -> tuple[float, float]:
        """A place by the angle of rotation."""
        c, s = math.cos(self.angle), math.sin(self.angle)
        return c * u - s * v, s * u + c * v

    def centre(self, m: Machine) -> tuple[float, float]:
        """From the tool by half the sides, turned about the tool."""
        u, v = np.array(SIGNS[int(self.stud_position)]) * (self.first_side_length, self.second_side_length) / 2
        x, y = self.turned(float(u), float(v))
        return m.programmed[0] + x, m.programmed[1] + y

    def start(self, radius: float, aside: float) -> tuple[float, float]:
        """On the right of the blank, or beside two of its sides."""
        sides = (self.first_side_length, self.blank_side_1), (self.second_side_length, self.blank_side_2)
        u, v = (max(blank / 2 + aside, side / 2 + self.side_allowance) + radius for side, blank in sides)
        if not self.approach_position:
            return self.turned(u, 0.0)
        x, y = SIGNS[int(self.approach_position)]
        return self.turned(-x * u, -y * v)

    def clearing(self, radius: float, allowance: float, blank: bool = True) -> Clearing:
        """Rings begun on the right, or a spiral from a corner."""
        sides = (self.first_side_length, self.blank_side_1), (self.second_side_length, self.blank_side_2)
        u, v = (max(whole if blank else 0.0, side + 2 * allowance) for side, whole in sides)
        return studs.rectangle(
            self.first_side_length, self.second_side_length, (u, v), radius, self.overlap * radius,
            corner=self.corner_radius_or_chamfer, allowance=allowance, climb=self.climb, angle=self.angle,
            begin=int(self.approach_position) - 1 if self.approach_position else None,
        )  # fmt: skip

    def off(self, aside: float) -> float | None:
        """On the right as far as the start."""
        return aside if self.approach_position else None


@CYCLES("CYCL DEF 257", "Circular stud", runs="call", source="6.7")
class CircularStud(Stud):
    """Mills a circular stud about the tool position free: on a spiral from the blank inwards, then its side and the floor."""

    finished_diameter: float = addresses.length("Q223", "diameter of the finished stud", example=50)
    blank_diameter: float = addresses.length("Q222", "diameter of the blank", note="at least Q223", example=80)
    starting_angle: float = addresses.angle(
        "Q376", "starting angle", at_least=-1, default=-1, note="from the centre of the stud; -1: as the control likes, 0",
        example=0,
    )  # fmt: skip

    def contradictions(self) -> Iterator[tuple[str, str]]:
        """An angle, or -1."""
        yield from super().contradictions()
        if -1 < self.starting_angle < 0:
            yield "starting_angle", f"must be -1 or at least 0, got {self.starting_angle:g}"

    def check_sizes(self) -> Iterator[tuple[str, str]]:
        """The blank."""
        if self.blank_diameter < self.finished_diameter:
            found = f"{self.finished_diameter:g}, got {self.blank_diameter:g}"
            yield "blank_diameter", f"must be at least the diameter of the stud Q223, {found}"

    @property
    def angle(self) -> float:
        """Q376 in rad; where the control may choose, it chooses 0."""
        return math.radians(max(self.starting_angle, 0.0))

    def start(self, radius: float, aside: float) -> tuple[float, float]:
        """On the ray of the starting angle."""
        away = max(self.blank_diameter / 2 + aside, self.finished_diameter / 2 + self.side_allowance) + radius
        return away * math.cos(self.angle), away * math.sin(self.angle)

    def clearing(self, radius: float, allowance: float, blank: bool = True) -> Clearing:
        """A spiral and a circle."""
        stock = max(self.blank_diameter if blank else 0.0, self.finished_diameter + 2 * allowance)
        step = self.overlap * radius
        return studs.circle(
            self.finished_diameter, stock, radius, step, allowance=allowance, climb=self.climb, angle=self.angle
        )

    def last(self, centre: tuple[float, float]) -> tuple[float, float] | None:
        """Back over the stud."""
        return centre


@CYCLES("CYCL DEF 258", "Polygon stud", runs="call", source="6.8")
class PolygonStud(Stud):
    """Mills a regular polygon about the tool position free: on a spiral from the round blank inwards, then side and floor."""

    reference_circle: float = addresses.choice("Q573", "reference circle", CIRCLES, example=0)
    reference_diameter: float = addresses.length("Q571", "diameter of the reference circle", example=50)
    blank_diameter: float = addresses.length("Q222", "diameter of the blank", note="greater than Q571", example=80)
    corners: float = addresses.number("Q572", "number of corners", at_least=3, at_most=30, example=6)
    rotation_angle: float = addresses.angle("Q224", "angle of the first corner", example=15)
    corner_radius_or_chamfer: float = addresses.coordinate("Q220", ROUND, note="a bevel counts on each side", example=2)
    side_allowance: float = addresses.coordinate(
        "Q368", "finishing allowance for side", incremental=True, note="negative: so much smaller", example=0.2
    )
    machining_operation: float = addresses.operation(example=0)
    floor_allowance: float = addresses.floor_allowance(example=0.1)
    finishing_infeed: float = addresses.finishing_infeed(example=5)
    finishing_feed: float = addresses.finishing_feed(example=800)

    @property
    def inscribed(self) -> float:
        """The radius of the inscribed circle."""
        half = math.cos(math.pi / self.corners) if self.reference_circle else 1.0
        return self.reference_diameter / 2 * half

    @property
    def angle(self) -> float:
        """Q224 in rad."""
        return math.radians(self.rotation_angle)

    def check_sizes(self) -> Iterator[tuple[str, str]]:
        """The blank, the corners, and that something stays."""
        if self.blank_diameter <= self.reference_diameter:
            found = f"{self.reference_diameter:g}, got {self.blank_diameter:g}"
            yield "blank_diameter", f"must be greater than the reference circle Q571, {found}"
        corner, bevel = self.corner_radius_or_chamfer, self.inscribed * math.tan(math.pi / self.corners)
        if corner > self.inscribed:
            found = f"{self.inscribed:g}, got {corner:g}"
            yield "corner_radius_or_chamfer", f"must be at most the radius of the inscribed circle, {found}"
        if -corner > bevel:
            yield "corner_radius_or_chamfer", f"must be a bevel of at most half a side, {bevel:g}, got {-corner:g}"
        if self.inscribed + self.side_allowance <= 0:
            found = f"{self.inscribed:g} of the inscribed circle, got {self.side_allowance:g}"
            yield "side_allowance", f"must leave something of the radius {found}"

    def start(self, radius: float, aside: float) -> tuple[float, float]:
        """On the ray of the first corner, outside of the blank and of the corners."""
        apex = self.clearing(radius, max(self.side_allowance, 0.0), blank=False).passes[0].points[0]
        away = max(self.blank_diameter / 2 + radius, float(np.hypot(*apex))) + aside
        return away * math.cos(self.angle), away * math.sin(self.angle)

    def clearing(self, radius: float, allowance: float, blank: bool = True) -> Clearing:
        """A spiral and a polygon."""
        stock = max(self.blank_diameter if blank else 0.0, 2 * (self.inscribed + allowance))
        return studs.polygon(
            int(self.corners), self.inscribed, stock, radius, self.overlap * radius, corner=self.corner_radius_or_chamfer,
            allowance=allowance, climb=self.climb, angle=self.angle,
        )  # fmt: skip

    def lifting(self) -> Lifting | None:
        """In the second set-up plane."""
        return Lifting(self.end, self.above)
