"""What the cycles for pockets, slots and studs share (chapter 6): depths, heights, what is done, and the feeds for it.

    roughing: infeeds of Q202, at most LCUTS, down to Q369 above the floor; the last one is the rest
    side finishing: infeeds of Q338, or one, down to the same level;  floor finishing: one infeed at Q203 + Q201

A cycle says where its figure lies and which passes make it; `to_start` and `to_end` go to it and away from it.
"""

from __future__ import annotations

import math
from abc import abstractmethod
from collections.abc import Iterator
from dataclasses import dataclass
from typing import ClassVar

from mnclab.controls.tnc_620.cycles import addresses
from mnclab.controls.tnc_620.cycles.planes import AtSurface
from mnclab.machine.cycle import too_many
from mnclab.machine.machine import Machine
from mnclab.machine.true_size import MILLS, tool
from mnclab.machining.depths import infeeds
from mnclab.machining.milling.pocket_steps import Feeds
from mnclab.machining.steps import Go
from mnclab.path.tool import Tool
from mnclab.running.performing import perform

ANY_FEED = ("FAUTO", "FU", "FZ")
ORIGIN = (0.0, 0.0)


@dataclass(frozen=True)
class FigureMilling(AtSurface):
    """A figure that is roughed in layers, then finished at its side and on its floor where allowances were left."""

    does: ClassVar[str] = MILLS

    machining_operation: float = addresses.operation(example=0)
    side_allowance: float = addresses.side_allowance(example=0.2)
    milling_feed: float = addresses.milling_feed(example=500)
    milling_type: float = addresses.climb(predef=True, example=1)
    depth: float = addresses.depth(example=-20)
    infeed: float = addresses.infeed(note="greater than 0; at most the length of the edges, LCUTS", example=5)
    floor_allowance: float = addresses.floor_allowance(example=0.1)
    plunging_feed: float = addresses.plunge_feed(ANY_FEED, example=150)
    finishing_infeed: float = addresses.finishing_infeed(example=5)
    clearance: float = addresses.clearance(predef=True, example=2)
    surface: float = addresses.surface(example=0)
    second_clearance: float = addresses.second_clearance(predef=True, example=50)
    finishing_feed: float = addresses.finishing_feed(example=500)

    # --- what is done ------------------------------------------------------------------------------------------------

    @property
    def roughs(self) -> bool:
        """Whether the figure is roughed."""
        return self.machining_operation != 2

    @property
    def finishes_side(self) -> bool:
        """Whether there is something to take off the side."""
        return self.machining_operation != 1 and self.side_allowance > 0

    @property
    def finishes_floor(self) -> bool:
        """Whether there is something to take off the floor."""
        return self.machining_operation != 1 and self.floor_allowance > 0

    def finishes_nothing(self, m: Machine) -> bool:
        """Whether only finishing is asked for, and nothing was left for it; says so."""
        nothing = not (self.roughs or self.finishes_side or self.finishes_floor)
        if nothing:
            m.warn(f"{self.code} Q215=2 finishes nothing: neither Q368 nor Q369 is given")
        return nothing

    @property
    def climb(self) -> bool:
        """Q351 = 0 is climb milling too."""
        return self.milling_type >= 0

    # --- heights -----------------------------------------------------------------------------------------------------

    def depths(self) -> dict[str, float]:
        """Q201 alone."""
        return {"depth": self.depth}

    @property
    def lift(self) -> float:
        """The set-up clearance as an increment against the direction of work."""
        return self.down * self.clearance

    @property
    def floor(self) -> float:
        """The bottom of the figure."""
        return self.surface + self.depth

    @property
    def left_over(self) -> float:
        """Where roughing and side finishing end."""
        return self.floor + self.down * self.floor_allowance

    def levels(self, tool: Tool) -> tuple[float, ...]:
        """Of roughing."""
        edges = tool.cutting_length if tool.cutting_length > 0 else math.inf
        return infeeds(self.surface, self.left_over, min(self.infeed, edges))

    def wall_levels(self) -> tuple[float, ...]:
        """Of side finishing."""
        return infeeds(self.surface, self.left_over, self.finishing_infeed)

    # --- feeds -------------------------------------------------------------------------------------------------------

    @property
    def finish_feed(self) -> float:
        """Along walls and floor."""
        return self.finishing_feed

    def roughing_feeds(self, radius: float) -> Feeds:
        """In the plane and down."""
        return Feeds(self.milling_feed, self.plunging_feed)

    def side_feeds(self, radius: float) -> Feeds:
        """Along the side."""
        return Feeds(self.finish_feed, self.plunging_feed)

    def floor_feeds(self, radius: float) -> Feeds:
        """On the floor."""
        return Feeds(self.finish_feed, self.plunging_feed)

    # --- checks ------------------------------------------------------------------------------------------------------

    def contradictions(self) -> Iterator[tuple[str, str]]:
        """An infeed; not all of the depth is allowance. A depth of 0 is not executed, so nothing of it can be wrong."""
        if self.depth == 0:
            return
        if self.infeed == 0:
            yield "infeed", "must be greater than 0, got 0"
        if self.floor_allowance >= abs(self.depth):
            yield "floor_allowance", f"must be less than the depth {abs(self.depth):g}, got {self.floor_allowance:g}"
        yield from too_many("finishing_infeed", self.wall_levels)

    def check(self, m: Machine) -> Iterator[tuple[str, str]]:
        """The sign of the depth, a tool with a radius, feeds for all that is done; what else `check_figure` finds."""
        if self.depth == 0:
            return
        yield from self.signs(m)
        if m.radius <= 0:
            yield "", f"needs a tool with a radius, got {m.radius:g}"
        finishes = self.finishes_side or self.finishes_floor
        feeds = self.milling_feed, self.plunging_feed, self.finish_feed
        used = {"milling_feed": self.roughs, "plunging_feed": True, "finishing_feed": finishes}
        for (name, needed), feed in zip(used.items(), feeds, strict=True):
            if needed and feed == 0:
                yield name, "must be greater than 0 to mill with, got 0"
        yield from too_many("infeed", lambda: self.levels(tool(m)))
        yield from self.check_figure(m)

    @abstractmethod
    def check_figure(self, m: Machine) -> Iterator[tuple[str, str]]:
        """Whether the tool and its allowance fit, and what else a figure needs."""

    # --- the ways to it and away from it -----------------------------------------------------------------------------

    def to_start(self, m: Machine, place: tuple[float, float]) -> None:
        """At rapid: up to the second set-up plane from below it, over the place, down to the set-up plane."""
        steps = [
            Go("to the second set-up clearance", max(m.programmed[2], self.end)),
            Go("over the start", x=place[0], y=place[1]),
            Go("to the set-up clearance", self.above),
        ]
        perform(m, self.code, steps, ORIGIN)

    def to_end(self, m: Machine, place: tuple[float, float] | None = None) -> None:
        """At rapid to the plane at the end, and there to the place, if any."""
        back = [] if place is None else [Go("back", x=place[0], y=place[1])]
        perform(m, self.code, [*self.leave(), *back], ORIGIN)
