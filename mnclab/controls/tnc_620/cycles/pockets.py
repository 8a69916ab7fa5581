"""Rectangular and circular pockets: cycles 251 (6.2) and 252 (6.3), and what slots share with them.

C is the centre of the pocket, R the tool radius, Room where the centre of the tool may go about C.
"""

from __future__ import annotations

import math
from abc import abstractmethod
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import partial

import numpy as np

from mnclab.controls.tnc_620.cycles import addresses
from mnclab.controls.tnc_620.cycles.milling import FigureMilling
from mnclab.geometry.contours import Contour
from mnclab.machine.cycle import CycleTable, few_passes, too_many
from mnclab.machine.machine import Machine
from mnclab.machine.true_size import tool
from mnclab.machining.milling import concentric
from mnclab.machining.milling.clearing import Clearing
from mnclab.machining.milling.entries import Descent, Entry, onto_floor, vertical
from mnclab.machining.milling.finishing import half_circles, quarter_circles
from mnclab.machining.milling.pocket_steps import Down, Feeds, Room, finish_floor, finish_walls, rough, way_down
from mnclab.running.performing import perform

CYCLES = CycleTable()

ENTRIES = ("vertical", "helix", "ramp")
PLUNGE: dict[float, str] = {0: "vertical", 1: "helical", 2: "reciprocating"}
CORNER: dict[float, str] = {
    0: "the tool is at the centre",
    1: "at the lower left corner",
    2: "at the lower right corner",
    3: "at the upper right corner",
    4: "at the upper left corner",
}
SIGNS = ((0, 0), (1, 1), (-1, 1), (-1, -1), (1, -1))  # from the tool to the centre, in half sides
CORNERS = 1.4  # times R, the widest step between two rectangles with sharp corners that leaves nothing between them


@dataclass(frozen=True)
class InsideMilling(FigureMilling):
    """A pocket or a slot: how the tool goes down, and what its feed refers to."""

    plunging_strategy: float = addresses.choice("Q366", "plunging strategy", PLUNGE, predef=True, example=1)
    feed_reference: float = addresses.feed_reference(example=0)

    def roughing_feeds(self, radius: float) -> Feeds:
        """With Q439 = 3 at the cutting edge; the way down always counts at the tool centre."""
        return Feeds(self.milling_feed, self.plunging_feed, radius if self.feed_reference == 3 else 0.0)

    def side_feeds(self, radius: float) -> Feeds:
        """With Q439 at the cutting edge."""
        return Feeds(self.finishing_feed, self.plunging_feed, radius if self.feed_reference else 0.0)

    def floor_feeds(self, radius: float) -> Feeds:
        """With Q439 = 2 and 3 at the cutting edge."""
        return Feeds(self.finishing_feed, self.plunging_feed, radius if self.feed_reference >= 2 else 0.0)

    def check_angle(self, m: Machine) -> Iterator[tuple[str, str]]:
        """All strategies but the vertical one need a plunge angle."""
        if self.plunging_strategy and not 0 < m.tool.plunge_angle <= 90:
            angle = f"the plunge angle (ANGLE) of tool {m.tool.number}, greater than 0 and at most 90"
            yield "plunging_strategy", f"{self.plunging_strategy:g} needs {angle}, in the tool table"

    def slopes(self, m: Machine) -> bool:
        """Whether the tool goes down on a helix or a ramp; at 90 degrees both are straight down."""
        return self.plunging_strategy > 0 and m.tool.plunge_angle < 90


@dataclass(frozen=True)
class Pocket(InsideMilling):
    """What both pockets share."""

    # --- what a shape says -------------------------------------------------------------------------------------------

    @abstractmethod
    def centre(self, m: Machine) -> tuple[float, float]:
        """C, in program coordinates."""

    @abstractmethod
    def clearing(self, radius: float, allowance: float) -> Clearing:
        """The passes that clear the pocket but for an allowance at its walls, about (0, 0)."""

    @abstractmethod
    def room(self, radius: float, allowance: float) -> Room:
        """Where the tool centre may go."""

    @abstractmethod
    def ways(self, wall: Contour, size: float, side: int) -> Sequence[Contour]:
        """Up to the wall and off it."""

    def last_lift(self) -> float | None:
        """How high the tool lifts after the last layer, if not by the set-up clearance."""
        return None

    # --- what follows from it ----------------------------------------------------------------------------------------

    def check_figure(self, m: Machine) -> Iterator[tuple[str, str]]:
        """The tool fits, and gets down."""
        yield from self.check_size(m.radius)
        yield from too_many("overlap", lambda: self.clearing(m.radius, 0.0))
        passes = len(self.clearing(m.radius, self.side_allowance).passes)
        yield from few_passes("infeed", len(self.levels(tool(m))), passes)
        yield from self.check_angle(m)
        if not self.roughs:
            return
        room = self.room(m.radius, self.side_allowance)
        if self.plunging_strategy == 1 and self.slopes(m) and m.settings["plunge_error"]:
            if room.half_width < m.radius - 1e-9:
                widest, least = 2 * (room.half_width + m.radius), 4 * m.radius
                yield "plunging_strategy", f"1 has a helix {widest:g} wide: at least twice the tool diameter, {least:g}"
        if self.plunging_strategy == 2 and self.slopes(m) and room.half_length < 2 * m.radius - 1e-9:
            found = f"{2 * room.half_length:g} is less than twice the tool diameter, {4 * m.radius:g}"
            yield "plunging_strategy", f"2 has no room for a ramp: {found}"
        step = self.levels(tool(m))[0] - self.surface
        yield from too_many("plunging_strategy", lambda: self.way_in(m)(0.0, step))

    @abstractmethod
    def check_size(self, radius: float) -> Iterator[tuple[str, str]]:
        """Whether the tool and its allowance fit into the pocket."""

    def way_in(self, m: Machine) -> Down:
        """The way from one level to another; straight down where a helix is as narrow as the tool."""
        room = self.room(m.radius, self.side_allowance)
        sloping = self.slopes(m) and not (self.plunging_strategy == 1 and room.half_width < concentric.NOTHING)
        entry = Entry(ENTRIES[int(self.plunging_strategy)], tool(m).plunge_angle) if sloping else Entry()
        return partial(way_down, entry, room, m.radius, self.climb)

    def moves(self, m: Machine) -> None:
        """Roughing in layers, the walls in infeeds, the floor; then back to where the tool was called."""
        if not self.executed(m) or self.finishes_nothing(m):
            return
        called, centre, radius, side = m.programmed[:2], self.centre(m), m.radius, 1 if self.climb else -1
        room, whole = self.room(radius, self.side_allowance), self.room(radius, 0.0)
        self.to_start(m, centre)
        if self.roughs:
            layers = rough(
                self.clearing(radius, self.side_allowance), self.levels(tool(m)), surface=self.surface,
                clearance=self.lift, down=self.way_in(m), feeds=self.roughing_feeds(radius),
                departure=min(self.clearance, room.half_width), side=side, end=self.last_lift(),
            )  # fmt: skip
            perform(m, self.code, layers, centre)
        clearing, levels = self.clearing(radius, 0.0), self.wall_levels()
        if self.finishes_side and clearing.passes and clearing.passes[-1].closed:
            wall, size = clearing.passes[-1], min(self.side_allowance + self.clearance, whole.half_width)
            around = finish_walls(
                wall, levels, above=levels[0] + self.lift, clearance=self.lift, feeds=self.side_feeds(radius),
                arcs=self.ways(wall, size, side), side=side,
            )  # fmt: skip
            perform(m, self.code, around, centre)
        if self.finishes_floor:
            bottom = finish_floor(
                clearing, self.floor, top=self.left_over, clearance=self.lift, down=partial(self.onto_floor, whole),
                feeds=self.floor_feeds(radius), departure=min(self.clearance, whole.half_width), side=side,
            )  # fmt: skip
            perform(m, self.code, bottom, centre)
        self.to_end(m, called)

    def onto_floor(self, room: Room, top: float, bottom: float) -> Descent:
        """On a quarter circle along the reference axis, which touches the floor in the middle; straight without room."""
        if self.floor_allowance > room.half_length:
            return vertical((0.0, 0.0), top, bottom)
        return onto_floor((0.0, 0.0), room.direction, top, bottom)


@CYCLES("CYCL DEF 251", "Rectangular pocket", runs="call", source="6.2")
class RectangularPocket(Pocket):
    """Mills a rectangular pocket: roughing in layers from the centre outwards, then its walls, then its floor."""

    first_side_length: float = addresses.length("Q218", "first side length", incremental=True, example=80)
    second_side_length: float = addresses.length("Q219", "second side length", incremental=True, example=60)
    corner_radius: float = addresses.length("Q220", "corner radius", note="0: the tool radius", example=8)
    rotation_angle: float = addresses.angle("Q224", "angle of rotation", note="about the tool position", example=15)
    pocket_position: float = addresses.choice("Q367", "pocket position", CORNER, example=0)
    overlap: float = addresses.overlap(0.0001, note="stepover at most Q370 times R", example=1)

    def contradictions(self) -> Iterator[tuple[str, str]]:
        """As all pockets; and the corners fit."""
        yield from super().contradictions()
        half = min(self.first_side_length, self.second_side_length) / 2
        if self.depth and self.corner_radius > half:
            yield "corner_radius", f"must be at most half the shorter side, {half:g}, got {self.corner_radius:g}"

    def check_size(self, radius: float) -> Iterator[tuple[str, str]]:
        """Both sides hold tool and allowances, the corners the tool."""
        least = 2 * (radius + self.side_allowance)
        for name in ("first_side_length", "second_side_length"):
            if (length := getattr(self, name)) < least - 1e-9:
                yield name, f"must be at least the tool diameter and twice Q368, {least:g}, got {length:g}"
        if 0 < self.corner_radius < radius - 1e-9:
            yield "corner_radius", f"must be 0 or at least the tool radius, {radius:g}, got {self.corner_radius:g}"

    @property
    def angle(self) -> float:
        """Q224 in rad."""
        return math.radians(self.rotation_angle)

    def centre(self, m: Machine) -> tuple[float, float]:
        """From the tool by half the sides, turned about the tool."""
        u, v = np.array(SIGNS[int(self.pocket_position)]) * (self.first_side_length, self.second_side_length) / 2
        c, s = math.cos(self.angle), math.sin(self.angle)
        return m.programmed[0] + c * u - s * v, m.programmed[1] + s * u + c * v

    def clearing(self, radius: float, allowance: float) -> Clearing:
        """Rectangles from the centre outwards, each begun on the reference axis."""
        step = min(self.overlap, CORNERS) * radius
        return concentric.rectangle(
            self.first_side_length, self.second_side_length, radius, step, corner=self.corner_radius,
            allowance=allowance, climb=self.climb, angle=self.angle, begin=0,
        )  # fmt: skip

    def room(self, radius: float, allowance: float) -> Room:
        """A ramp swings along the reference axis."""
        a = self.first_side_length / 2 - radius - allowance
        b = self.second_side_length / 2 - radius - allowance
        return Room(min(a, b), a, self.angle)

    def ways(self, wall: Contour, size: float, side: int) -> Sequence[Contour]:
        """Quarter circles."""
        return quarter_circles(wall, size, side)


@CYCLES("CYCL DEF 252", "Circular pocket", runs="call", source="6.3")
class CircularPocket(Pocket):
    """Mills a circular pocket about the tool position: roughing in layers outwards, then its wall, then its floor."""

    circle_diameter: float = addresses.length("Q223", "circle diameter", example=60)
    overlap: float = addresses.overlap(0.1, note="stepover at most Q370 times R", example=1)
    plunging_strategy: float = addresses.choice(
        "Q366", "plunging strategy", {0: "vertical", 1: "helical"}, predef=True, example=1
    )

    def check_size(self, radius: float) -> Iterator[tuple[str, str]]:
        """The tool and its allowance fit."""
        if self.circle_diameter < (least := 2 * (radius + self.side_allowance)) - 1e-9:
            found = f"{least:g}, got {self.circle_diameter:g}"
            yield "circle_diameter", f"must be at least the tool diameter and twice Q368, {found}"

    def check_angle(self, m: Machine) -> Iterator[tuple[str, str]]:
        """Straight down goes a tool whose plunge angle allows it."""
        yield from super().check_angle(m)
        if not self.plunging_strategy and m.tool.plunge_angle not in (0, 90):
            angle = f"the plunge angle (ANGLE) of tool {m.tool.number} to be 0 or 90, it is {m.tool.plunge_angle:g}"
            yield "plunging_strategy", f"0 needs {angle}"

    def centre(self, m: Machine) -> tuple[float, float]:
        """The tool position."""
        return m.programmed[:2]

    def clearing(self, radius: float, allowance: float) -> Clearing:
        """Circles from the centre outwards; none where the tool fills the pocket."""
        step = self.overlap * radius
        return concentric.circle(self.circle_diameter, radius, step, allowance=allowance, climb=self.climb)

    def room(self, radius: float, allowance: float) -> Room:
        """The same in all directions."""
        reach = self.circle_diameter / 2 - radius - allowance
        return Room(reach, reach)

    def ways(self, wall: Contour, size: float, side: int) -> Sequence[Contour]:
        """Half circles: the edge begins Q368 + Q200 away from the wall, and ends there."""
        return half_circles(wall, size, side)

    def last_lift(self) -> float | None:
        """Roughing alone ends at the second set-up clearance before the tool goes to the middle."""
        return self.end if self.machining_operation == 1 and self.depth < 0 else None
