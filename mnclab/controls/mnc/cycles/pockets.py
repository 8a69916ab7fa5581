"""Pockets (MNC, 10.3 and 10.4): G343 rectangular and G344 circular, about the place where the tool stands.

R_t is the effective tool radius, z0 the level of the tool when the block is reached. The parts are the same for both:
roughing in layers, the walls if U is given, the floor if W is given; each cycle says only which passes clear it.
"""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from collections.abc import Iterator
from dataclasses import dataclass
from functools import partial

from mnclab.controls.mnc.cycles.milling import MillingCycle, clearance, feed, second_feed
from mnclab.machine.cycle import CycleTable, few_passes, param, too_many
from mnclab.machine.machine import Machine
from mnclab.machine.true_size import remark, tool
from mnclab.machining.depths import infeeds
from mnclab.machining.milling import concentric
from mnclab.machining.milling.clearing import Clearing
from mnclab.machining.milling.entries import Entry
from mnclab.machining.milling.finishing import quarter_circles
from mnclab.machining.milling.pocket_steps import Down, Feeds, Room, finish_floor, finish_walls, rough, way_down
from mnclab.machining.steps import Go, Step
from mnclab.running.performing import perform

CYCLES = CycleTable()

SCOPE: dict[float, str] = {0: "roughing and finishing", 1: "roughing only", 2: "finishing only"}
MODE: dict[float, str] = {1: "climb, counter-clockwise", -1: "conventional, clockwise", 0: "climb"}
ENTRIES = ("vertical", "helix", "ramp")
PLUNGE: dict[float, str] = {0: "vertical", 1: "helical", 2: "reciprocating"}


@dataclass(frozen=True)
class Pocket(MillingCycle, ABC):
    """What both pockets share: levels, allowances, feeds and how the tool goes down."""

    scope: float = param("M", "scope of work", "choice", default=0, choices=SCOPE, example=0)
    surface: float = param("Z", "workpiece surface", note="always absolute", example=0)
    depth: float = param("H", "depth from the surface to the floor", below=0, incremental=True, example=-10)
    infeed: float = param("P", "infeed of each layer", above=0, incremental=True, example=4)
    clearance: float = clearance("clearance above the surface")
    side_allowance: float = param(
        "U", "allowance of the walls", default=0, at_least=0, incremental=True, example=0.5,
        note="0: the walls are not finished",
    )  # fmt: skip
    floor_allowance: float = param(
        "W", "allowance of the floor", default=0, at_least=0, incremental=True, example=0.5,
        note="0: the floor is not finished",
    )  # fmt: skip
    finish_infeed: float = param(
        "I", "infeed when finishing the walls", default=0, at_least=0, incremental=True, example=5, note="0: one infeed"
    )  # fmt: skip
    overlap: float = param(
        "K", "path overlap factor", "ratio", at_least=0.1, at_most=1.4, example=1, note="stepover at most K times R"
    )  # fmt: skip
    plunge: float = param(
        "J", "plunge strategy", "choice", default=0, choices=PLUNGE, example=1,
        note="1 and 2 need the plunge angle of the tool",
    )  # fmt: skip
    feed: float | None = feed()
    plunge_feed: float = param("V", "feed of the plunge", "mm/min", above=0, example=150)
    milling_mode: float = param("L", "kind of milling with M3", "choice", default=1, choices=MODE, example=1)
    finish_feed: float | None = second_feed("finishing feed", 300)

    # --- what a shape says -------------------------------------------------------------------------------------------

    @abstractmethod
    def clearing(self, radius: float, allowance: float) -> Clearing:
        """The passes that clear the pocket but for an allowance at its walls, about (0, 0)."""

    @abstractmethod
    def room(self, radius: float, allowance: float) -> Room:
        """Where the tool centre may go."""

    # --- what follows from it ----------------------------------------------------------------------------------------

    @property
    def climb(self) -> bool:
        """L 0 is climb too (MNC-POCKET-L)."""
        return self.milling_mode >= 0

    @property
    def left_over(self) -> float:
        """Where roughing and the finishing of the walls end."""
        return self.surface + self.depth + self.floor_allowance

    def levels(self) -> tuple[float, ...]:
        """Of roughing: infeeds of P, the last one smaller."""
        return infeeds(self.surface, self.left_over, self.infeed)

    def wall_levels(self) -> tuple[float, ...]:
        """Of finishing the walls."""
        return infeeds(self.surface, self.left_over, self.finish_infeed)

    def contradictions(self) -> Iterator[tuple[str, str]]:
        """Not all of the depth is allowance; no more levels than a pocket can have."""
        if self.floor_allowance >= -self.depth:
            yield "floor_allowance", f"must be less than the depth {-self.depth:g}, got {self.floor_allowance:g}"
        yield from too_many("infeed", self.levels)
        yield from too_many("finish_infeed", self.wall_levels)

    def check(self, m: Machine) -> Iterator[tuple[str, str]]:
        """As all milling cycles; the tool fits, and gets down."""
        yield from super().check(m)
        yield from self.check_size(m.radius)
        yield from too_many("overlap", lambda: self.clearing(m.radius, 0.0))
        yield from few_passes("infeed", len(self.levels()), len(self.clearing(m.radius, self.side_allowance).passes))
        if self.plunge and not 0 < m.tool.plunge_angle <= 90:
            angle = f"the plunge angle of tool {m.tool.number}, greater than 0 and at most 90"
            yield "plunge", f"{self.plunge:g} needs {angle}, in the tool table"
        room = self.room(m.radius, self.side_allowance)
        if self.plunge == 1 and m.tool.plunge_angle < 90 and room.half_width <= 0:
            yield "plunge", "1 has no room for a helix: the tool fills the pocket"
        if self.plunge == 2 and m.tool.plunge_angle < 90 and room.half_length < 2 * m.radius:
            least = f"twice the tool diameter, {4 * m.radius:g}"
            yield "plunge", f"2 has no room for a ramp: {2 * room.half_length:g} is less than {least}"
        deepest = max(min(self.infeed, -self.depth), self.floor_allowance)
        yield from too_many("plunge", lambda: self.down(m)(0.0, -deepest))

    @abstractmethod
    def check_size(self, radius: float) -> Iterator[tuple[str, str]]:
        """Whether the tool and its allowance fit into the pocket."""

    def down(self, m: Machine) -> Down:
        """The way from one level to another, as J says."""
        entry = Entry(ENTRIES[int(self.plunge)], tool(m).plunge_angle) if self.plunge else Entry()
        return partial(way_down, entry, self.room(m.radius, self.side_allowance), m.radius, self.climb)

    def moves(self, m: Machine) -> None:
        """Steps 1 to 8 of the manual."""
        above = self.surface + self.clearance
        end, radius = max(m.programmed[2], above), m.radius
        room = self.room(radius, self.side_allowance)
        if self.scope == 2 and not (self.side_allowance or self.floor_allowance):
            m.warn(f"{self.code} M2 finishes nothing: neither U nor W is given")
            return
        if self.plunge == 1 and m.tool.plunge_angle < 90 and room.half_width < radius:
            narrow = (
                f"{self.code} J1 has a narrow helix: its radius is {room.half_width:g}, that of the tool {radius:g}"
            )
            m.warn(narrow + remark(m))
        perform(m, self.code, [Go("to the clearance level", above)])
        side, deep = 1 if self.climb else -1, min(self.clearance, room.half_width)
        if self.scope != 2:
            steps = rough(
                self.clearing(radius, self.side_allowance), self.levels(), surface=self.surface,
                clearance=self.clearance, down=self.down(m), feeds=Feeds(self.feed, self.plunge_feed), departure=deep,
                side=side,
            )  # fmt: skip
            perform(m, self.code, steps)
        if self.scope != 1:
            for part in self.finishing(m, above, side):
                perform(m, self.code, part)
        perform(m, self.code, [Go("to the start point", end)])

    def finishing(self, m: Machine, above: float, side: int) -> Iterator[Iterator[Step]]:
        """The walls, and then the floor, each if it has an allowance."""
        radius = m.radius
        clearing, feeds = self.clearing(radius, 0.0), Feeds(self.finish_feed or self.feed, self.plunge_feed)
        arc = min(self.side_allowance + self.clearance, self.room(radius, 0.0).half_width)
        if self.side_allowance and clearing.passes and clearing.passes[-1].closed:  # there is a way round
            yield finish_walls(
                clearing.passes[-1], self.wall_levels(), above=above, clearance=self.clearance, feeds=feeds,
                arcs=quarter_circles(clearing.passes[-1], arc, side), side=side,
            )  # fmt: skip
        if self.floor_allowance:
            yield finish_floor(
                clearing, self.surface + self.depth, top=self.left_over, clearance=self.clearance, down=self.down(m),
                feeds=feeds, departure=arc, side=side,
            )  # fmt: skip


@dataclass(frozen=True)
class Rectangle(MillingCycle):
    """The size of a rectangular pocket."""

    length_x: float = param("A", "pocket length along X", at_least=0, incremental=True, example=60)
    length_y: float = param("B", "pocket length along Y", at_least=0, incremental=True, example=40)
    corner_radius: float = param(
        "R", "corner radius", default=0, at_least=0, example=8, note="at least the tool radius is taken"
    )  # fmt: skip
    rotation: float = param("E", "angle of the pocket", "deg", default=0, at_least=-360, at_most=360, example=15)


@CYCLES("G343", "Rectangular pocket", runs="definition", source="MNC 10.3")
class RectangularPocket(Pocket, Rectangle):
    """Mills a rectangular pocket about the place of the tool: roughing, walls, floor."""

    def contradictions(self) -> Iterator[tuple[str, str]]:
        """As all pockets; and the corners fit."""
        yield from super().contradictions()
        if 2 * self.corner_radius > min(self.length_x, self.length_y):
            half = min(self.length_x, self.length_y) / 2
            yield "corner_radius", f"must be at most half the shorter side, {half:g}, got {self.corner_radius:g}"

    def check_size(self, radius: float) -> Iterator[tuple[str, str]]:
        """Both sides exceed tool and allowances (MNC-G343-AB0)."""
        least = 2 * (radius + self.side_allowance)
        for name, length in (("length_x", self.length_x), ("length_y", self.length_y)):
            if length <= least:
                yield name, f"must be greater than the tool diameter and twice U, {least:g}, got {length:g}"

    def clearing(self, radius: float, allowance: float) -> Clearing:
        """Rectangles from the centre outwards, each begun where the longer axis leaves it."""
        return concentric.rectangle(
            self.length_x, self.length_y, radius, self.overlap * radius, corner=self.corner_radius, allowance=allowance,
            climb=self.climb, angle=math.radians(self.rotation),
        )  # fmt: skip

    def room(self, radius: float, allowance: float) -> Room:
        """The last rectangle; its longer axis is X where both are the same."""
        a, b = self.length_x / 2 - radius - allowance, self.length_y / 2 - radius - allowance
        return Room(min(a, b), max(a, b), math.radians(self.rotation) + (math.pi / 2 if a < b else 0.0))


@CYCLES("G344", "Circular pocket", runs="definition", source="MNC 10.4")
class CircularPocket(Pocket):
    """Mills a circular pocket about the place of the tool: roughing, walls, floor."""

    diameter: float = param("D", "diameter of the finished pocket", above=0, example=50)
    plunge: float = param(
        "J", "plunge strategy", "choice", default=0, choices={0: "vertical", 1: "helical"}, example=1,
        note="1 needs the plunge angle of the tool",
    )  # fmt: skip

    def check_size(self, radius: float) -> Iterator[tuple[str, str]]:
        """The tool and its allowance fit."""
        if self.diameter < (least := 2 * (radius + self.side_allowance)):
            yield "diameter", f"must be at least the tool diameter and twice U, {least:g}, got {self.diameter:g}"

    def clearing(self, radius: float, allowance: float) -> Clearing:
        """Circles from the centre outwards; none where the tool fills the pocket."""
        return concentric.circle(self.diameter, radius, self.overlap * radius, allowance=allowance, climb=self.climb)

    def room(self, radius: float, allowance: float) -> Room:
        """The same in all directions."""
        reach = self.diameter / 2 - radius - allowance
        return Room(reach, reach)
