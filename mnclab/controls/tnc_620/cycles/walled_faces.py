"""Face milling between side walls: cycle 233 (6.9).

P0 is the corner of the surface from which Q218 and Q219 point into it; lines run along the axis of Q350. The tool centre
stays R + Q368 in front of a wall. Each level ends with a lift by Q200 and the way back to the start outside.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from functools import partial
from typing import ClassVar

import numpy as np

from mnclab.controls.tnc_620.cycles import addresses
from mnclab.controls.tnc_620.cycles.holes import rate
from mnclab.controls.tnc_620.cycles.planes import AtSurface
from mnclab.controls.tnc_620.cycles.pockets import CORNERS, SIGNS
from mnclab.geometry.contours import Contour
from mnclab.machine.cycle import CycleTable, few_passes, too_many
from mnclab.machine.machine import Machine
from mnclab.machine.true_size import MILLS, remark, tool
from mnclab.machining.depths import infeeds
from mnclab.machining.milling.between_walls import Feeds, Heights, Line, Walled, finish_along, over_lines, past_walls
from mnclab.machining.milling.clearing import begin, numbered
from mnclab.machining.milling.face_lines import rows, spiral
from mnclab.machining.milling.finishing import onto
from mnclab.machining.steps import Along, Go, Step
from mnclab.path.tool import Tool
from mnclab.running.performing import perform

CYCLES = CycleTable()
STRATEGIES: dict[float, str] = {
    0: "meander, stepover outside the surface",
    1: "meander, stepover at its edge",
    2: "line by line, ends outside the surface",
    3: "line by line, ends at its edge",
    4: "spiral from the outside inwards",
}
DIRECTIONS: dict[float, str] = {1: "along the reference axis", 2: "along the minor axis"}
WALLS: dict[float, str] = {
    0: "no limit",
    -1: "a wall in the negative reference axis",
    1: "in the positive reference axis",
    -2: "in the negative minor axis",
    2: "in the positive minor axis",
}
POSITION: dict[float, str] = {
    -1: "the tool is at the starting corner",
    0: "at the centre of the surface",
    1: "at the lower left corner",
    2: "at the lower right corner",
    3: "at the upper right corner",
    4: "at the upper left corner",
}


@CYCLES("CYCL DEF 233", "Face milling with side walls", runs="call", source="6.9")
class WalledFaceMilling(AtSurface):
    """Mills a level surface that up to three walls may bound: levels in equal infeeds, a last one finishes, then the walls."""

    does: ClassVar[str] = MILLS

    machining_operation: float = addresses.operation(example=0)
    strategy: float = addresses.choice("Q389", "machining strategy", STRATEGIES, example=2)
    milling_direction: float = addresses.choice("Q350", "milling direction", DIRECTIONS, example=1)
    first_side_length: float = addresses.coordinate(
        "Q218", "first side length", incremental=True, note="the sign points into the surface", example=120
    )
    second_side_length: float = addresses.coordinate(
        "Q219", "second side length", incremental=True, note="the sign points into the surface", example=80
    )
    surface: float = addresses.coordinate("Q227", "coordinate of the surface", example=0)
    end_tool_axis: float = addresses.coordinate("Q386", "coordinate to mill down to", example=-6)
    floor_allowance: float = addresses.floor_allowance(note="the last infeed", example=0.2)
    max_plunging_depth: float = addresses.length("Q202", "greatest infeed", incremental=True, example=3)
    overlap: float = addresses.overlap(at_least=0.1, predef=False, note="stepover at most Q370 times R", example=1)
    milling_feed: float = addresses.milling_feed(example=500)
    finishing_feed: float = addresses.finishing_feed(at_most=addresses.FAR, example=400)
    prepositioning_feed: float = addresses.positioning_feed(example=750)
    side_clearance: float = addresses.length("Q357", "clearance to the side", incremental=True, example=2)
    clearance: float = addresses.clearance(predef=True, example=3)
    second_clearance: float = addresses.second_clearance(predef=True, example=50)
    limit_1: float = addresses.choice("Q347", "first limit", WALLS, example=2)
    limit_2: float = addresses.choice("Q348", "second limit", WALLS, default=0, example=1)
    limit_3: float = addresses.choice("Q349", "third limit", WALLS, default=0, example=0)
    corner_radius: float = addresses.length("Q220", "corner radius between limits", example=8)
    side_allowance: float = addresses.side_allowance(example=0.3)
    finishing_infeed: float = addresses.finishing_infeed(example=4)
    surface_position: float = addresses.choice("Q367", "surface position", POSITION, default=-1, example=-1)

    # --- what is done ------------------------------------------------------------------------------------------------

    @property
    def roughs(self) -> bool:
        """Whether the surface is roughed."""
        return self.machining_operation != 2

    @property
    def finishes_floor(self) -> bool:
        """Whether there is a last infeed to finish."""
        return self.machining_operation != 1 and self.floor_allowance > 0

    @property
    def finishes_side(self) -> bool:
        """Whether there is something to take off a wall."""
        return self.machining_operation != 1 and self.side_allowance > 0 and bool(self.walled.walls)

    @property
    def one_way(self) -> bool:
        """Whether lines run all in one direction."""
        return self.strategy in (2, 3)

    # --- where -------------------------------------------------------------------------------------------------------

    @property
    def walled(self) -> Walled:
        """The surface and its walls."""
        walls = frozenset(int(limit) for limit in (self.limit_1, self.limit_2, self.limit_3) if limit)
        return Walled(abs(self.first_side_length), abs(self.second_side_length), walls, self.corner_radius)

    def centre(self, m: Machine) -> tuple[float, float]:
        """The middle of the surface, in program coordinates."""
        half = np.array([self.first_side_length, self.second_side_length]) / 2
        away = half if self.surface_position < 0 else np.abs(half) * SIGNS[int(self.surface_position)]
        x, y = (np.array(m.programmed[:2]) + away).tolist()
        return x, y

    def lines(self, radius: float) -> tuple[Line, ...]:
        """Of a level, in their order; begun on the open side where the other one has a wall."""
        axis, walls = int(self.milling_direction) - 1, self.walled.walls
        senses = [int(math.copysign(1, size)) for size in (self.first_side_length, self.second_side_length)]
        ahead, across = senses[axis], senses[1 - axis]
        if -ahead * (axis + 1) in walls and ahead * (axis + 1) not in walls:
            ahead = -ahead
        over = self.side_clearance + (radius if self.strategy in (0, 2) else 0.0)
        return self.walled.lines(
            radius, self.overlap * radius, axis=axis, ahead=ahead, across=across, outside=radius + self.side_clearance,
            over=over, first=max(0.0, self.overlap - 1) * radius, allowance=self.side_allowance, one_way=self.one_way,
        )  # fmt: skip

    def spiral(self, radius: float) -> tuple[tuple[float, float], Contour]:
        """Its start outside of P0, and the way, clockwise."""
        x, y = self.walled.length, self.walled.width
        right, above = self.first_side_length < 0, self.second_side_length < 0
        turn = {(0, 0): 0, (0, 1): -1, (1, 1): 2, (1, 0): 1}[right, above]
        factor = min(self.overlap, CORNERS)
        (way,) = spiral(
            *((y, x) if turn % 2 else (x, y)), radius, factor * radius, first=max(0.0, factor - 1) * radius,
            angle=turn * math.pi / 2,
        ).passes  # fmt: skip
        start = np.array([x if right else -x, y if above else -y]) / 2
        axis = int(self.milling_direction) - 1
        start[axis] += math.copysign(radius + self.side_clearance, start[axis])
        return (float(start[0]), float(start[1])), way

    def along(self, radius: float, allowance: float) -> tuple[Contour, ...]:
        """The ways along the walls, longer by Q357 in the milling direction."""
        beyond = [radius, radius]
        beyond[int(self.milling_direction) - 1] += self.side_clearance
        return self.walled.along(radius, outside=(beyond[0], beyond[1]), allowance=allowance)

    # --- heights -----------------------------------------------------------------------------------------------------

    def depths(self) -> dict[str, float]:
        """From the surface to the end."""
        return {"end_tool_axis": self.end_tool_axis - self.surface}

    def levels(self, tool: Tool) -> tuple[float, ...]:
        """Of roughing: equal infeeds."""
        left_over = self.end_tool_axis + self.down * self.floor_allowance
        return rows(self.surface, left_over, min(self.max_plunging_depth, edges(tool)))[1:]

    def last_levels(self, tool: Tool) -> tuple[float, ...]:
        """Of finishing: one, more where the edges are shorter."""
        left_over = self.end_tool_axis + self.down * self.floor_allowance
        if not self.floor_allowance:
            return ()
        return rows(left_over, self.end_tool_axis, min(self.floor_allowance, edges(tool)))[1:]

    def wall_levels(self, tool: Tool) -> tuple[float, ...]:
        """Of the walls."""
        infeed = min(self.finishing_infeed or math.inf, edges(tool))
        return infeeds(self.surface, self.end_tool_axis, infeed if infeed < math.inf else 0.0)

    # --- checks ------------------------------------------------------------------------------------------------------

    def contradictions(self) -> Iterator[tuple[str, str]]:
        """No walls round a spiral; an infeed; not all of the depth is allowance."""
        for name, limit in zip(
            ("limit_1", "limit_2", "limit_3"), (self.limit_1, self.limit_2, self.limit_3), strict=True
        ):
            if limit and self.strategy == 4:
                yield name, f"must be 0 in spiral machining (Q389 = 4), got {limit:g}"
        depth = abs(self.end_tool_axis - self.surface)
        if depth == 0:
            return
        if self.max_plunging_depth == 0:
            yield "max_plunging_depth", "must be greater than 0, got 0"
        if self.floor_allowance >= depth:
            yield "floor_allowance", f"must be less than the depth {depth:g}, got {self.floor_allowance:g}"

    def check(self, m: Machine) -> Iterator[tuple[str, str]]:
        """Downwards, a tool that fits between the walls, feeds for all that is done, a number of lines to wait for."""
        if self.down == 0:
            return
        if self.down < 0 and m.settings["depth_error"]:
            yield (
                "end_tool_axis",
                f"must lie below Q227 = {self.surface:g}, got {self.end_tool_axis:g}: it works upwards",
            )
        if m.radius <= 0:
            yield "", f"needs a tool with a radius, got {m.radius:g}"
            return
        for name in ("first_side_length", "second_side_length"):
            if getattr(self, name) == 0:
                yield name, "must not be 0"
        finishes = self.finishes_side or self.finishes_floor
        used = {"milling_feed": self.roughs, "finishing_feed": finishes, "prepositioning_feed": True}
        for name in (name for name, needed in used.items() if needed and getattr(self, name) == 0):
            yield name, "must be greater than 0 to mill with, got 0"
        yield from self.check_walls(m.radius)
        yield from too_many("max_plunging_depth", partial(self.levels, tool(m)))
        yield from too_many("finishing_infeed", partial(self.wall_levels, tool(m)))
        shorter = min(self.walled.length, self.walled.width)
        yield from too_many(
            "overlap", lambda: rows(0, shorter if self.strategy == 4 else self.width, self.overlap * m.radius)
        )
        lines = 1 + int(self.width / (self.overlap * m.radius))
        yield from few_passes("max_plunging_depth", len(self.levels(tool(m))), lines)

    @property
    def width(self) -> float:
        """Across the milling direction."""
        return self.walled.width if self.milling_direction == 1 else self.walled.length

    def check_walls(self, radius: float) -> Iterator[tuple[str, str]]:
        """The tool and its allowance between opposite walls, their corners."""
        walled, least = self.walled, 2 * (radius + self.side_allowance)
        sizes = (("first_side_length", walled.length), ("second_side_length", walled.width))
        for axis, (name, size) in enumerate(sizes, 1):
            both = {axis, -axis} <= walled.walls
            if both and size < least - 1e-9:
                yield name, f"must be at least the tool diameter and twice Q368 between walls, {least:g}, got {size:g}"
            widest = size / 2 if both else size
            if self.has_corners and self.corner_radius > widest:
                yield (
                    "corner_radius",
                    f"must be at most {widest:g} to fit between the limits, got {self.corner_radius:g}",
                )
                return

    @property
    def has_corners(self) -> bool:
        """Whether two walls meet."""
        return bool(self.walled.walls & {1, -1}) and bool(self.walled.walls & {2, -2})

    # --- steps -------------------------------------------------------------------------------------------------------

    def scrapes(self, m: Machine) -> float:
        """How far a line that still stands reaches above the rapid way back over it, mm; 0 where none does."""
        lines = self.lines(m.radius)[1:] if self.one_way else ()
        if not any(line.begins_outside for line in lines):
            return 0.0
        heights = (abs(top - level) for _, level, top, _ in self.parts(m))
        return max(0.0, max(heights, default=0.0) - self.clearance)

    def start(self, m: Machine) -> tuple[float, float]:
        """Starting point 1."""
        if not (self.roughs or self.finishes_floor):
            x, y = begin(self.along(m.radius, 0.0)[0]).tolist()
            return x, y
        return self.spiral(m.radius)[0] if self.strategy == 4 else self.lines(m.radius)[0].begin

    def parts(self, m: Machine) -> Iterator[tuple[str, float, float, float]]:
        """Every level: its name, where it is, what stands above it, and the feed."""
        top, levels = self.surface, self.levels(tool(m))
        if self.roughs:
            for name, level in zip(numbered("level", len(levels)), levels, strict=True):
                yield name, level, top, self.milling_feed
                top = level
        top = self.end_tool_axis + self.down * self.floor_allowance
        levels = self.last_levels(tool(m))
        if self.finishes_floor:
            for name, level in zip(numbered("floor finishing", len(levels)), levels, strict=True):
                yield name, level, top, self.finishing_feed
                top = level

    def over(self, m: Machine, name: str, at: Heights, feeds: Feeds) -> Iterator[Step]:
        """All of one level."""
        if self.strategy == 4:
            start, way = self.spiral(m.radius)
            if (arc := onto(start, way)) is not None:
                yield Along(f"{name}, approach", arc, feeds.mill)
            yield Along(f"{name}, spiral", way, feeds.mill)
            return
        yield from over_lines(name, self.lines(m.radius), at, feeds, one_way=self.one_way)
        if self.walled.walls & {self.milling_direction, -self.milling_direction}:
            yield from past_walls(name, self.along(m.radius, self.side_allowance), feeds.mill)

    def steps(self, m: Machine) -> Iterator[Step]:
        """Level by level, then the walls."""
        (x, y), lift = self.start(m), self.down * self.clearance
        outside = self.strategy == 4 or not {self.milling_direction, -self.milling_direction} <= self.walled.walls
        position = rate(self.prepositioning_feed)
        for k, (name, level, top, feed) in enumerate(self.parts(m)):
            yield Go(f"{name}, down", level, position if k and outside else feed)
            yield from self.over(m, name, Heights(level, top, lift), Feeds(feed, position))
            yield Go(f"{name}, lift", level + lift)
            yield Go(f"{name}, back to the start", x=x, y=y)
        if self.finishes_side:
            feeds = Feeds(self.finishing_feed, position)
            yield from finish_along(self.along(m.radius, 0.0), self.wall_levels(tool(m)), self.above, feeds)

    def moves(self, m: Machine) -> None:
        """To the start, over all levels, to the second set-up clearance."""
        if not self.executed(m):
            return
        if not (self.roughs or self.finishes_side or self.finishes_floor):
            m.warn(f"{self.code} Q215=2 finishes nothing: neither Q369 nor Q368 with a limit is given")
            return
        if self.has_corners and self.corner_radius < m.radius:
            m.warn(
                f"{self.code} Q220={self.corner_radius:g}: the corners get the radius of the tool, {m.radius:g}{remark(m)}"
            )
        if (scrapes := self.scrapes(m)) > 1e-9:
            m.warn(
                f"{self.code} Q200={self.clearance:g}: the rapid way back to the next line passes {scrapes:.10g} mm below what "
                "that line has still to take away",
                hint="choose Q200 not smaller than the infeed",
            )
        centre, (x, y) = self.centre(m), self.start(m)
        end = self.surface + max(self.second_clearance, self.clearance)
        go = [
            Go("to the second set-up clearance", max(m.programmed[2], end)),
            Go("over the start", x=x, y=y),
            Go("to the set-up clearance", self.above),
        ]
        perform(m, self.code, [*go, *self.steps(m), *self.leave()], centre)


def edges(tool: Tool) -> float:
    """LCUTS; a tool without has edges all along."""
    return tool.cutting_length if tool.cutting_length > 0 else math.inf
