"""Face milling between side walls: cycle 233 (6.9).

P0 is the corner of the surface from which Q218 and Q219 point into it; lines run along the axis of Q350. The tool centre
stays R + Q368 in front of a wall. Each level ends with a lift by Q200 and the way back to the start outside.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from functools import partial

import numpy as np

from mnclab.controls.tnc_620.cycles import addresses
from mnclab.controls.tnc_620.cycles.addresses import choice, coordinate, increment, length
from mnclab.controls.tnc_620.cycles.milling import edges
from mnclab.controls.tnc_620.cycles.planes import AtSurface, Fault, less_than_depth, not_zero, rate, with_radius
from mnclab.controls.tnc_620.cycles.pockets import CORNERS, SIGNS
from mnclab.controls.tnc_620.machining.walls import Level, Passes, Walled, face_levels, finish_along
from mnclab.geometry.contours import Contour
from mnclab.machine.coordinates import MILLS, remark, tool
from mnclab.machine.cycle import CycleTable, few_passes, too_many
from mnclab.machine.machine import Machine
from mnclab.machining.depths import infeeds
from mnclab.machining.milling.clearing import begin, numbered
from mnclab.machining.milling.faces import rows, spiral_from
from mnclab.machining.steps import Go, Say, Step
from mnclab.path.tool import Tool

CYCLES = CycleTable()
STRATEGIES = addresses.MEANDER | {
    2: "line by line, ends outside the surface", 3: "line by line, ends at its edge", 4: "spiral from the outside inwards",
}  # fmt: skip
DIRECTIONS: dict[float, str] = {1: "along the reference axis", 2: "along the minor axis"}
WALLS: dict[float, str] = {
    0: "no limit", -1: "a wall in the negative reference axis", 1: "in the positive reference axis",
    -2: "in the negative minor axis", 2: "in the positive minor axis",
}  # fmt: skip
POSITION = {-1: "the tool is at the starting corner", 0: "at the centre of the surface"} | addresses.CORNERS
INTO = "the sign points into the surface"


@CYCLES("CYCL DEF 233", "Face milling with side walls", source="6.9")
class WalledFaceMilling(AtSurface):
    """Mills a level surface that up to three walls may bound: levels in equal infeeds, a last one finishes, then the walls."""

    does = MILLS
    machining_operation: float = addresses.machining_operation()
    strategy: float = choice("Q389", "machining strategy", STRATEGIES, example=2)
    milling_direction: float = choice("Q350", "milling direction", DIRECTIONS, example=1)
    first_side_length: float = increment("Q218", "first side length", note=INTO, example=120)
    second_side_length: float = increment("Q219", "second side length", note=INTO, example=80)
    surface: float = coordinate("Q227", "coordinate of the surface", example=0)
    end_tool_axis: float = coordinate("Q386", "coordinate to mill down to", example=-6)
    floor_allowance: float = addresses.floor_allowance(note="the last infeed", example=0.2)
    max_plunging_depth: float = addresses.greatest_infeed(example=3)
    overlap: float = addresses.overlap(at_least=0.1, predef=False)
    milling_feed: float = addresses.milling_feed()
    finishing_feed: float = addresses.finishing_feed(at_most=addresses.FAR, example=400)
    prepositioning_feed: float = addresses.positioning_feed()
    side_clearance: float = addresses.side_clearance()
    clearance: float = addresses.clearance(predef=True, example=3)
    second_clearance: float = addresses.second_clearance(predef=True, example=50)
    limit_1: float = choice("Q347", "first limit", WALLS, example=2)
    limit_2: float = choice("Q348", "second limit", WALLS, default=0, example=1)
    limit_3: float = choice("Q349", "third limit", WALLS, default=0, example=0)
    corner_radius: float = length("Q220", "corner radius between limits", example=8)
    side_allowance: float = addresses.side_allowance(example=0.3)
    finishing_infeed: float = addresses.finishing_infeed(example=4)
    surface_position: float = choice("Q367", "surface position", POSITION, default=-1, example=-1)

    @property
    def finishes_floor(self) -> bool:
        return self.machining_operation != 1 and self.floor_allowance > 0

    @property
    def finishes_side(self) -> bool:
        return self.machining_operation != 1 and self.side_allowance > 0 and bool(self.walled.walls)

    def depths(self) -> dict[str, float]:
        return {"end_tool_axis": self.end_tool_axis - self.surface}

    @property
    def left_over(self) -> float:
        """Where roughing ends."""
        return self.end_tool_axis + self.down * self.floor_allowance

    def rough_levels(self, tool: Tool) -> tuple[float, ...]:
        return rows(self.surface, self.left_over, min(self.max_plunging_depth, edges(tool)))[1:]

    def wall_levels(self, tool: Tool) -> tuple[float, ...]:
        infeed = min(self.finishing_infeed or math.inf, edges(tool))
        return infeeds(self.surface, self.end_tool_axis, infeed if infeed < math.inf else 0.0)

    def levels(self, tool: Tool) -> list[Level]:
        """Of roughing, then of finishing: one, more where the edges are shorter."""
        parts = []
        if self.machining_operation != 2:
            parts.append(("level", self.surface, self.rough_levels(tool), self.milling_feed))
        if self.finishes_floor:
            last = rows(self.left_over, self.end_tool_axis, min(self.floor_allowance, edges(tool)))[1:]
            parts.append(("floor finishing", self.left_over, last, self.finishing_feed))
        return [
            Level(*each, feed)
            for what, top, heights, feed in parts
            for each in zip(numbered(what, len(heights)), heights, (top, *heights))
        ]

    @property
    def walled(self) -> Walled:
        walls = frozenset(int(limit) for limit in (self.limit_1, self.limit_2, self.limit_3) if limit)
        return Walled(abs(self.first_side_length), abs(self.second_side_length), walls, self.corner_radius)

    def passes(self, radius: float) -> Passes:
        """Of a level: lines, begun on the open side where the other one has a wall, or a spiral."""
        axis, walled = int(self.milling_direction), self.walled
        outside = radius + self.side_clearance
        if self.strategy == 4:
            sides, factor = (self.first_side_length, self.second_side_length), min(self.overlap, CORNERS)
            start, way = spiral_from(sides, radius, factor * radius, max(0.0, factor - 1) * radius, axis - 1, outside)
            return Passes(start, True, spiral=way)
        senses = [int(math.copysign(1, size)) for size in (self.first_side_length, self.second_side_length)]
        ahead, across = senses[axis - 1], senses[2 - axis]
        if -ahead * axis in walled.walls and ahead * axis not in walled.walls:
            ahead = -ahead
        lines = walled.lines(
            radius, self.overlap * radius, axis=axis - 1, ahead=ahead, across=across, outside=outside,
            over=outside if self.strategy in (0, 2) else self.side_clearance, first=max(0.0, self.overlap - 1) * radius,
            allowance=self.side_allowance, one_way=self.strategy in (2, 3),
        )  # fmt: skip
        along = self.along(radius, self.side_allowance) if walled.walls & {axis, -axis} else ()
        clear = not {axis, -axis} <= walled.walls
        return Passes(lines[0].begin, clear, lines, self.strategy in (2, 3), along)

    def along(self, radius: float, allowance: float) -> tuple[Contour, ...]:
        """The ways along the walls, longer by Q357 in the milling direction."""
        longer = radius + self.side_clearance
        outside = (longer, radius) if self.milling_direction == 1 else (radius, longer)
        return self.walled.along(radius, outside=outside, allowance=allowance)

    def contradictions(self) -> Iterator[Fault]:
        for name in ("limit_1", "limit_2", "limit_3"):
            if (limit := getattr(self, name)) and self.strategy == 4:
                yield name, f"must be 0 in spiral machining (Q389 = 4), got {limit:g}"
        if depth := self.end_tool_axis - self.surface:
            yield from not_zero(self, "max_plunging_depth")
            yield from less_than_depth(self, "floor_allowance", depth)

    def check(self, m: Machine) -> Iterator[Fault]:
        if self.down == 0:
            return
        if self.down < 0 and m.settings["depth_error"]:
            found = f"{self.surface:g}, got {self.end_tool_axis:g}: it works upwards"
            yield "end_tool_axis", f"must lie below Q227 = {found}"
        yield from with_radius(m)
        for name in ("first_side_length", "second_side_length"):
            if getattr(self, name) == 0:
                yield name, "must not be 0"
        roughs, finishes = self.machining_operation != 2, self.finishes_side or self.finishes_floor
        used = {"milling_feed": roughs, "finishing_feed": finishes, "prepositioning_feed": True}
        yield from not_zero(self, *(name for name, needed in used.items() if needed), purpose="to mill with")
        yield from self.check_walls(m.radius)
        yield from too_many("max_plunging_depth", partial(self.rough_levels, tool(m)))
        yield from too_many("finishing_infeed", partial(self.wall_levels, tool(m)))
        length, width = self.walled.length, self.walled.width
        across, step = (width, length)[int(self.milling_direction) - 1], self.overlap * m.radius
        yield from too_many("overlap", lambda: rows(0, min(length, width) if self.strategy == 4 else across, step))
        yield from few_passes("max_plunging_depth", len(self.rough_levels(tool(m))), 1 + int(across / step))

    def check_walls(self, radius: float) -> Iterator[Fault]:
        walled, least = self.walled, 2 * (radius + self.side_allowance)
        sizes = (("first_side_length", walled.length), ("second_side_length", walled.width))
        for axis, (name, size) in enumerate(sizes, 1):
            both = {axis, -axis} <= walled.walls
            if both and size < least - 1e-9:
                yield name, f"must be at least the tool diameter and twice Q368 between walls, {least:g}, got {size:g}"
            widest = size / 2 if both else size
            if walled.has_corners and self.corner_radius > widest:
                found = f"{widest:g} to fit between the limits, got {self.corner_radius:g}"
                yield "corner_radius", f"must be at most {found}"
                return

    def about(self, m: Machine) -> tuple[float, float]:
        half = np.array([self.first_side_length, self.second_side_length]) / 2
        away = half if self.surface_position < 0 else np.abs(half) * SIGNS[int(self.surface_position)]
        x, y = (np.array(m.programmed[:2]) + away).tolist()
        return x, y

    def moves(self, m: Machine) -> Iterator[Step]:
        if not self.down:
            yield self.left_out
            return
        passes, levels, lift = self.passes(m.radius), self.levels(tool(m)), self.down * self.clearance
        walls = self.along(m.radius, 0.0) if self.finishes_side else ()
        if not (levels or walls):
            yield Say("Q215=2 finishes nothing: neither Q369 nor Q368 with a limit is given")
            return
        if self.walled.has_corners and self.corner_radius < m.radius:
            yield Say(f"Q220={self.corner_radius:g}: the corners get the radius of the tool, {m.radius:g}{remark(m)}")
        if (scrapes := passes.scrapes(levels, self.clearance)) > 1e-9:
            below = f"{scrapes:.10g} mm below what that line has still to take away"
            sentence = f"Q200={self.clearance:g}: the rapid way back to the next line passes {below}"
            yield Say(sentence, hint="choose Q200 not smaller than the infeed")
        x, y = passes.start if levels else begin(walls[0]).tolist()
        yield Go("to the second set-up clearance", max(m.programmed[2], self.end))
        yield Go("over the start", x=x, y=y)
        yield Go("to the set-up clearance", self.above)
        position = rate(self.prepositioning_feed)
        yield from face_levels(passes, levels, lift, position)
        yield from finish_along(walls, self.wall_levels(tool(m)), self.above, self.finishing_feed, position)
        yield from self.leave()
