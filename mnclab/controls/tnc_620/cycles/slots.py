"""Slots: cycles 253 (straight, 6.4) and 254 (circular, 6.5).

A slot lies about a centre line from the centre of its first arc (the left one, the one at the starting angle) to that of
its last; the tool goes to the first one, and all passes count from there. A slot as wide as the tool is roughed on the
line alone, whatever Q368, down to Q369, and not finished.
"""

from __future__ import annotations

import math
from abc import abstractmethod
from collections.abc import Iterator
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from mnclab.controls.tnc_620.cycles import addresses
from mnclab.controls.tnc_620.cycles.pockets import InsideMilling
from mnclab.geometry import shapes
from mnclab.geometry.contours import Contour
from mnclab.machine.cycle import CycleTable, few_passes, too_many
from mnclab.machine.machine import Machine
from mnclab.machine.true_size import tool
from mnclab.machining.milling import concentric
from mnclab.machining.milling.clearing import Clearing
from mnclab.machining.milling.entries import Descent, swing, vertical
from mnclab.machining.milling.finishing import half_circles
from mnclab.machining.milling.pocket_steps import Down, finish_floor, finish_walls, rough_slot
from mnclab.running.performing import perform

CYCLES = CycleTable()

PLUNGE: dict[float, str] = {0: "vertical", 1: "reciprocating", 2: "reciprocating"}
LENGTHWISE: dict[float, str] = {
    0: "the tool is at the centre of the slot",
    1: "at its left end",
    2: "at the centre of the left arc",
    3: "at the centre of the right arc",
    4: "at its right end",
}
ON_CIRCLE: dict[float, str] = {
    0: "centre and starting angle say where the slot lies",
    1: "the tool is at the centre of the left arc",
    2: "in the middle of the centre line",
    3: "at the centre of the right arc",
}
SAME = 1e-9


class Place(NamedTuple):
    """Where a slot lies: the centre of its first arc, in program coordinates, and its centre line counted from there."""

    start: tuple[float, float]
    line: Contour


@dataclass(frozen=True)
class Slot(InsideMilling):
    """What both slots share."""

    slot_width: float = addresses.length("Q219", "slot width", note="equal to the tool: only roughing", example=12)
    plunging_strategy: float = addresses.choice("Q366", "plunging strategy", PLUNGE, predef=True, example=1)

    # --- what a shape says -------------------------------------------------------------------------------------------

    @abstractmethod
    def places(self, m: Machine) -> Iterator[Place]:
        """Each slot that is milled."""

    @property
    @abstractmethod
    def line_length(self) -> float:
        """The length of the centre line."""

    @abstractmethod
    def last(self, m: Machine) -> tuple[float, float] | None:
        """Where the tool goes at the end, in the second set-up plane; None: it stays."""

    # --- what follows from it ----------------------------------------------------------------------------------------

    def is_as_wide_as(self, radius: float) -> bool:
        """Whether the tool just fits."""
        return abs(self.slot_width / 2 - radius) <= concentric.NOTHING

    def check_figure(self, m: Machine) -> Iterator[tuple[str, str]]:
        """The tool fits, and gets down."""
        least = 2 * m.radius
        if self.slot_width < least and not self.is_as_wide_as(m.radius):
            yield "slot_width", f"must be at least the tool diameter, {least:g}, got {self.slot_width:g}"
        least += 2 * self.side_allowance
        if self.slot_width < least - SAME and not self.is_as_wide_as(m.radius):
            yield "slot_width", f"must be at least the tool diameter and twice Q368, {least:g}, got {self.slot_width:g}"
        yield from self.check_angle(m)
        line = next(self.places(m)).line
        if self.plunging_strategy and self.slopes(m) and self.roughs:
            if self.line_length <= concentric.NOTHING:
                yield "plunging_strategy", f"{self.plunging_strategy:g} has no room for a ramp: the slot is round"
            step = self.levels(tool(m))[0] - self.surface
            yield from too_many("plunging_strategy", lambda: self.way_in(m, line)(0.0, step))
        yield from too_many("slot_width", lambda: self.clearing(line, m.radius, 0.0))
        passes = self.slots * len(self.clearing(line, m.radius, self.side_allowance).passes)
        yield from few_passes("infeed", len(self.levels(tool(m))), passes)

    @property
    def slots(self) -> int:
        """How many there are."""
        return 1

    def clearing(self, line: Contour, radius: float, allowance: float) -> Clearing:
        """Along the line and round it; on circles where the slot has no length."""
        width = self.slot_width
        if self.is_as_wide_as(radius):
            width, allowance = 2 * radius, 0.0
        if line.length <= concentric.NOTHING:
            return concentric.circle(width, radius, radius, allowance=allowance, climb=self.climb, angle=math.pi)
        return concentric.slot(line, width, radius, allowance=allowance, climb=self.climb)

    def way_in(self, m: Machine, line: Contour) -> Down:
        """To and fro along the line, or straight down at its beginning."""
        if self.slopes(m):
            return lambda top, bottom: swing(line, top, bottom, tool(m).plunge_angle)
        return straight

    def moves(self, m: Machine) -> None:
        """Each slot from the second set-up plane: roughing, side, floor."""
        if not self.executed(m) or self.finishes_nothing(m):
            return
        fits = self.is_as_wide_as(m.radius)
        if fits and not self.roughs:
            m.warn(f"{self.code} Q215=2 finishes nothing: the slot is as wide as the tool")
            return
        last = self.last(m)
        for place in self.places(m):
            self.to_start(m, place.start)
            if self.roughs:
                self.rough(m, place)
            if not fits:
                self.finish(m, place)
            self.to_end(m)
        if last is not None:
            self.to_end(m, last)

    def rough(self, m: Machine, place: Place) -> None:
        """Layer by layer, out of the slot after each."""
        feeds, side = self.roughing_feeds(m.radius), 1 if self.climb else -1
        layers = rough_slot(
            place.line, lambda line: self.clearing(line, m.radius, self.side_allowance), self.levels(tool(m)),
            surface=self.surface, above=self.above, clearance=self.lift, down=self.way_in(m, place.line), feeds=feeds,
            side=side,
        )  # fmt: skip
        perform(m, self.code, layers, place.start)

    def finish(self, m: Machine, place: Place) -> None:
        """The side from the centre of the first arc on half circles, then the floor."""
        radius, side, levels = m.radius, 1 if self.climb else -1, self.wall_levels()
        if self.finishes_side:
            wall = self.clearing(place.line.reversed(), radius, 0.0).passes[-1]  # begun beyond the first arc
            around = finish_walls(
                wall, levels, above=levels[0] + self.lift, clearance=self.lift, feeds=self.side_feeds(radius),
                arcs=half_circles(wall, self.slot_width / 2 - radius, side), side=side,
            )  # fmt: skip
            perform(m, self.code, around, place.start)
        if self.finishes_floor:
            bottom = finish_floor(
                self.clearing(place.line, radius, 0.0), self.floor, top=self.left_over, clearance=self.lift,
                down=straight, feeds=self.floor_feeds(radius), departure=0.0, side=side,
                end=self.above,
            )  # fmt: skip
            perform(m, self.code, bottom, place.start)


@CYCLES("CYCL DEF 253", "Slot milling", runs="call", source="6.4")
class StraightSlot(Slot):
    """Mills a straight slot: roughing in layers, to and fro on a ramp, then its side, then its floor."""

    slot_length: float = addresses.length("Q218", "slot length", note="over all", example=80)
    rotation_angle: float = addresses.angle("Q374", "angle of rotation", note="about the tool position", example=15)
    slot_position: float = addresses.choice("Q367", "slot position", LENGTHWISE, example=0)

    def check_figure(self, m: Machine) -> Iterator[tuple[str, str]]:
        """As all slots; longer than wide."""
        if self.slot_length < self.slot_width - SAME:
            yield "slot_length", f"must be at least the width Q219, {self.slot_width:g}, got {self.slot_length:g}"
        yield from super().check_figure(m)

    @property
    def line_length(self) -> float:
        """From arc centre to arc centre."""
        return max(self.slot_length - self.slot_width, 0.0)

    def places(self, m: Machine) -> Iterator[Place]:
        """From the left arc to the right one, turned about the tool."""
        half, reach = self.slot_length / 2, self.line_length / 2
        to_centre = (0.0, half, reach, -reach, -half)[int(self.slot_position)]
        angle = math.radians(self.rotation_angle)
        ahead = np.array([math.cos(angle), math.sin(angle)])
        x, y = (np.array(m.programmed[:2]) + (to_centre - reach) * ahead).tolist()
        yield Place((x, y), Contour(np.outer([0.0, self.line_length], ahead), closed=False))

    def last(self, m: Machine) -> tuple[float, float] | None:
        """Back to the centre if the tool was there; else it stays above the left arc."""
        return None if self.slot_position else m.programmed[:2]


@CYCLES("CYCL DEF 254", "Circular slot", runs="call", source="6.5")
class CircularSlot(Slot):
    """Mills slots on a pitch circle: each roughed in layers, to and fro on a ramp, then its side, then its floor."""

    clearance: float = addresses.clearance(example=2)
    second_clearance: float = addresses.second_clearance(example=50)
    pitch_circle_diameter: float = addresses.length("Q375", "pitch circle diameter", example=80)
    slot_position: float = addresses.choice("Q367", "reference of the slot position", ON_CIRCLE, example=0)
    centre_x: float = addresses.coordinate("Q216", "centre in the first axis", note="only with Q367 = 0", example=50)
    centre_y: float = addresses.coordinate("Q217", "centre in the second axis", note="only with Q367 = 0", example=50)
    starting_angle: float = addresses.angle("Q376", "starting angle", note="polar", example=45)
    angular_length: float = addresses.angle(
        "Q248", "opening angle of the slot", at_least=0, incremental=True, example=90
    )
    stepping_angle: float = addresses.angle("Q378", "stepping angle", incremental=True, example=180)
    repetitions: float = addresses.count("Q377", "number of slots", 99999, at_least=1, example=2)

    def check_figure(self, m: Machine) -> Iterator[tuple[str, str]]:
        """As all slots; the centre of the pitch circle lies outside of them."""
        if self.pitch_circle_diameter <= self.slot_width + concentric.NOTHING:
            found = f"{self.slot_width:g}, got {self.pitch_circle_diameter:g}"
            yield "pitch_circle_diameter", f"must be greater than the slot width Q219, {found}"
        yield from super().check_figure(m)

    @property
    def slots(self) -> int:
        """Q377."""
        return int(self.repetitions)

    @property
    def line_length(self) -> float:
        """Along the pitch circle."""
        return self.pitch_circle_diameter / 2 * math.radians(self.angular_length)

    @property
    def first_angle(self) -> float:
        """Where the centre line of the first slot begins, rad: Q376 is where the tool stands on it."""
        before = (0.0, 0.0, self.angular_length / 2, self.angular_length)[int(self.slot_position)]
        return math.radians(self.starting_angle - before)

    def centre(self, m: Machine) -> tuple[float, float]:
        """Of the pitch circle: as it is written, or from the tool, which stands on the circle."""
        if not self.slot_position:
            return self.centre_x, self.centre_y
        radius, angle = self.pitch_circle_diameter / 2, math.radians(self.starting_angle)
        return m.programmed[0] - radius * math.cos(angle), m.programmed[1] - radius * math.sin(angle)

    def places(self, m: Machine) -> Iterator[Place]:
        """Slot after slot, each turned on by the stepping angle."""
        x, y = self.centre(m)
        for k in range(self.slots):
            begin = self.first_angle + k * math.radians(self.stepping_angle)
            arc = shapes.arc(self.pitch_circle_diameter / 2, begin, math.radians(self.angular_length))
            dx, dy = arc.points[0].tolist()
            yield Place((x + dx, y + dy), Contour(arc.points - (dx, dy), arc.bulge, closed=False))

    def last(self, m: Machine) -> tuple[float, float] | None:
        """To the centre of the pitch circle if the tool has no place of its own; else it stays above the last slot."""
        return None if self.slot_position else self.centre(m)


def straight(top: float, bottom: float) -> Descent:
    """Straight down at the beginning of the centre line."""
    return vertical((0.0, 0.0), top, bottom)
