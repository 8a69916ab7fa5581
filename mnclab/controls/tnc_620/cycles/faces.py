"""Face milling: cycles 232 (12.7) and, between side walls, 233 (6.9); the obsolete 230 and the ruled surface 231."""

from __future__ import annotations

import math
from collections.abc import Iterator
from functools import partial

import numpy as np

from mnclab.controls.tnc_620.cycles import addresses, planes
from mnclab.controls.tnc_620.cycles.addresses import choice, coordinate, distance, increment, length, number
from mnclab.controls.tnc_620.cycles.milling import edges
from mnclab.controls.tnc_620.cycles.planes import AtSurface, ParameterFault
from mnclab.controls.tnc_620.cycles.pockets import CORNERS, SIGNS
from mnclab.controls.tnc_620.machining.faces import (
    FacingLevel,
    Passes,
    Walled,
    face_levels,
    finish_along,
    mill_ruled,
    passes,
)
from mnclab.geometry.contours import Contour
from mnclab.machine.control import Setting
from mnclab.machine.coordinates import MILLS, remark, tool
from mnclab.machine.cycle import Cycle, CycleTable, too_many, too_many_passes
from mnclab.machine.machine import Machine
from mnclab.machining.depths import DRIFT, infeeds
from mnclab.machining.milling.clearing import Clearing, begin, numbered
from mnclab.machining.milling.faces import Layer, face, lines, rows, spiral_from
from mnclab.machining.steps import Go, Say, Step
from mnclab.path.tool import Tool

CYCLES = CycleTable()
MOST = 20_000  # lines of one cycle, all its levels together
STRATEGIES = addresses.MEANDER | {2: "one way, retraction and back at the positioning feed"}


@CYCLES("CYCL DEF 232", "Face milling", source="12.7")
class FaceMilling(Cycle):
    """Mills a level surface in several infeeds, each level backwards over the one before; the last one finishes."""

    does = MILLS
    about = planes.in_program_coordinates
    strategy: float = choice("Q389", "machining strategy", STRATEGIES, example=2)
    start_1st_axis: float = coordinate("Q225", "starting point, first axis", example=10)
    start_2nd_axis: float = coordinate("Q226", "starting point, second axis", example=12)
    start_3rd_axis: float = coordinate("Q227", "coordinate of the surface", example=2.5)
    end_3rd_axis: float = coordinate("Q386", "coordinate to mill down to", example=-3)
    first_side_length: float = increment(
        "Q218", "first side length", note="the sign is the direction of the first line", example=150
    )
    second_side_length: float = increment(
        "Q219", "second side length", note="the sign is the direction of the first stepover", example=75
    )
    maximum_plunging_depth: float = addresses.greatest_infeed(example=2)
    floor_allowance: float = distance("Q369", "finishing allowance for the floor", note="the last infeed", example=0.5)
    maximum_overlap: float = addresses.overlap(
        meaning="greatest path overlap factor", at_least=0.1, predef=False, note="times the tool radius is the stepover"
    )
    feed: float = addresses.milling_feed()
    finishing_feed: float = addresses.finishing_feed(at_most=addresses.FAR, example=800)
    prepositioning_feed: float = addresses.positioning_feed(example=2000)
    clearance: float = addresses.clearance()
    side_clearance: float = addresses.side_clearance()
    second_clearance: float = addresses.second_clearance(predef=True, example=50)

    def contradictions(self) -> Iterator[ParameterFault]:
        if self.end_3rd_axis > self.start_3rd_axis:
            yield "end_3rd_axis", f"must not lie above Q227 = {self.start_3rd_axis:g}, got {self.end_3rd_axis:g}"

    def check(self, m: Machine) -> Iterator[ParameterFault]:
        if self.height == 0:
            return
        if self.roughing > DRIFT:
            yield from planes.not_zero(self, "maximum_plunging_depth")
        yield from planes.with_radius(m)
        if self.flat(m) <= 0:
            yield "", f"needs a tool that is flat below, got R {m.radius * m.scale:g} and R2 {m.tool.corner:g}"
        yield from planes.not_zero(self, "feed", "finishing_feed", "prepositioning_feed")
        yield from too_many("maximum_plunging_depth", self.levels)
        yield from too_many("maximum_overlap", lambda: self.across(self.flat(m)))
        if len(self.levels()) * len(self.across(self.flat(m))) > MOST:
            yield "maximum_overlap", f"makes more than {MOST} lines"

    @property
    def height(self) -> float:
        """A: what is taken off."""
        return self.start_3rd_axis - self.end_3rd_axis

    @property
    def roughing(self) -> float:
        """A_r: what is taken off before the finishing infeed."""
        return self.height - self.floor_allowance

    @staticmethod
    def flat(m: Machine) -> float:
        """R_e: the radius of what is flat below the tool."""
        return m.radius - m.tool.corner / m.scale

    def levels(self) -> tuple[float, ...]:
        """Equal infeeds down to the allowance, and then the allowance."""
        last = (self.end_3rd_axis,) if self.floor_allowance else ()
        if self.roughing <= DRIFT:
            return last
        rough_end = self.end_3rd_axis + self.floor_allowance
        return rows(self.start_3rd_axis, rough_end, self.maximum_plunging_depth)[1:] + last

    def across(self, flat: float) -> tuple[float, ...]:
        """Where the lines lie: the first on the edge or, with an overlap over 1, inside; the edge of the last on the far edge."""
        first, last = max(0.0, self.maximum_overlap - 1) * flat, abs(self.second_side_length) - flat
        places = rows(first, last, self.maximum_overlap * flat) if last > first else (first,)
        return tuple(self.start_2nd_axis + math.copysign(place, self.second_side_length) for place in places)

    def lines(self, m: Machine) -> Clearing:
        ahead, near = math.copysign(1.0, self.first_side_length), self.start_1st_axis
        far, outside = near + self.first_side_length, ahead * (m.radius + self.side_clearance)
        edges = (near, far) if self.strategy == 1 else None
        return lines(
            self.across(self.flat(m)), near - outside, far + outside, m.radius, one_way=self.strategy == 2, within=edges,
            leave=True,
        )  # fmt: skip

    def layers(self, m: Machine) -> Iterator[Layer]:
        """Every second level backwards; the finishing infeed at its own feed."""
        passes, levels = self.lines(m), self.levels()
        for k, (name, level) in enumerate(zip(numbered("level", len(levels)), levels)):
            finishing = bool(self.floor_allowance) and k == len(levels) - 1
            feed = self.finishing_feed if finishing else self.feed
            link = feed if self.strategy == 1 else self.prepositioning_feed
            way = passes.reversed() if k % 2 else passes
            yield Layer("finishing" if finishing else name, level, way, feed, link, self.prepositioning_feed)

    def moves(self, m: Machine) -> Iterator[Step]:
        if self.height == 0:
            yield Say("Q386 makes a depth of 0: the cycle is not executed")
            return
        high = self.start_3rd_axis + max(self.second_clearance, self.clearance)
        if m.programmed[2] <= high:
            yield Go("to the second set-up clearance", high)
        yield from face(list(self.layers(m)), self.start_3rd_axis + self.clearance, self.clearance)
        yield Go("retract", high)


# Face milling between side walls: cycle 233 (6.9).
#
# P0 is the corner of the surface from which Q218 and Q219 point into it; lines run along the axis of Q350. The tool centre
# stays R + Q368 in front of a wall. Each level ends with a lift by Q200 and the way back to the start outside.

WALLED_STRATEGIES = addresses.MEANDER | {
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
    strategy: float = choice("Q389", "machining strategy", WALLED_STRATEGIES, example=2)
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

    def levels(self, tool: Tool) -> list[FacingLevel]:
        """Of roughing, then of finishing: one, more where the edges are shorter."""
        parts = []
        if self.machining_operation != 2:
            parts.append(("level", self.surface, self.rough_levels(tool), self.milling_feed))
        if self.finishes_floor:
            last = rows(self.left_over, self.end_tool_axis, min(self.floor_allowance, edges(tool)))[1:]
            parts.append(("floor finishing", self.left_over, last, self.finishing_feed))
        return [
            FacingLevel(*each, feed)
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

    def contradictions(self) -> Iterator[ParameterFault]:
        for name in ("limit_1", "limit_2", "limit_3"):
            if (limit := getattr(self, name)) and self.strategy == 4:
                yield name, f"must be 0 in spiral machining (Q389 = 4), got {limit:g}"
        if depth := self.end_tool_axis - self.surface:
            yield from planes.not_zero(self, "max_plunging_depth")
            yield from planes.less_than_depth(self, "floor_allowance", depth)

    def check(self, m: Machine) -> Iterator[ParameterFault]:
        if self.down == 0:
            return
        if self.down < 0 and m.settings["depth_error"]:
            found = f"{self.surface:g}, got {self.end_tool_axis:g}: it works upwards"
            yield "end_tool_axis", f"must lie below Q227 = {found}"
        yield from planes.with_radius(m)
        for name in ("first_side_length", "second_side_length"):
            if getattr(self, name) == 0:
                yield name, "must not be 0"
        roughs, finishes = self.machining_operation != 2, self.finishes_side or self.finishes_floor
        used = {"milling_feed": roughs, "finishing_feed": finishes, "prepositioning_feed": True}
        yield from planes.not_zero(self, *(name for name, needed in used.items() if needed), purpose="to mill with")
        yield from self.check_walls(m.radius)
        yield from too_many("max_plunging_depth", partial(self.rough_levels, tool(m)))
        yield from too_many("finishing_infeed", partial(self.wall_levels, tool(m)))
        length, width = self.walled.length, self.walled.width
        across, step = (width, length)[int(self.milling_direction) - 1], self.overlap * m.radius
        yield from too_many("overlap", lambda: rows(0, min(length, width) if self.strategy == 4 else across, step))
        yield from too_many_passes("max_plunging_depth", len(self.rough_levels(tool(m))), 1 + int(across / step))

    def check_walls(self, radius: float) -> Iterator[ParameterFault]:
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

    def steps(self, m: Machine) -> Iterator[Step]:
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
        position = planes.rate(self.prepositioning_feed)
        yield from face_levels(passes, levels, lift, position)
        yield from finish_along(walls, self.wall_levels(tool(m)), self.above, self.finishing_feed, position)
        yield from self.leave()


# Obsolete faces, which still run (1.2): multipass milling 230 of a level surface, and the ruled surface 231.
#
# They are those of earlier manuals (TNC 426/430 8.8, iTNC 530). R is the tool radius. Readings where they are silent: the lines
# of 230 lie evenly from R inside the near edge to R inside the far one, or as the setting "multipass" says; the first step of
# 231, at half the feed, is the way to point 1 and the first line; the way back of 231 runs a tool diameter over its line.

SETTINGS = (
    Setting(
        "multipass", "within", "how far apart the lines of cycle 230 lie, of which the first is R inside the edge", "",
        {"within": "(Q219 - 2 R) / (Q240 - 1): the last one is R inside the far edge", "width": "Q219 / Q240: the whole width"},
    ),
)  # fmt: skip


@CYCLES("CYCL DEF 230", "Multipass milling", source="1.2")
class MultipassMilling(Cycle):
    """Mills a level surface once, on parallel lines to and fro."""

    does = MILLS
    about = planes.in_program_coordinates
    start_1st_axis: float = coordinate("Q225", "starting point, first axis", example=10)
    start_2nd_axis: float = coordinate("Q226", "starting point, second axis", example=12)
    start_3rd_axis: float = coordinate("Q227", "coordinate of the milled surface", example=2.5)
    first_side_length: float = increment("Q218", "first side length", at_least=0, example=150)
    second_side_length: float = increment("Q219", "second side length", at_least=0, example=75)
    cuts: float = number("Q240", "number of cuts", note="over the width", example=10)
    plunging_feed: float = addresses.plunge_feed()
    milling_feed: float = addresses.milling_feed()
    stepover_feed: float = addresses.feed("Q209", "feed rate for the stepover", also=addresses.PLANE, example=200)
    clearance: float = addresses.clearance()

    def check(self, m: Machine) -> Iterator[ParameterFault]:
        yield from planes.with_radius(m)
        yield from planes.not_zero(self, "plunging_feed", "milling_feed", "stepover_feed", purpose="to mill with")
        yield from too_many_passes("cuts", 1, int(self.cuts))
        if self.cuts > 1:
            yield from planes.at_least(self, "second_side_length", 2 * m.radius, "the tool diameter")

    def stepover(self, m: Machine) -> float:
        if m.settings["multipass"] == "width":
            return self.second_side_length / self.cuts
        return (self.second_side_length - 2 * m.radius) / (self.cuts - 1) if self.cuts > 1 else 0.0

    def moves(self, m: Machine) -> Iterator[Step]:
        step, first, above = self.stepover(m), self.start_2nd_axis + m.radius, self.start_3rd_axis + self.clearance
        if step > 2 * m.radius:
            yield Say(f"Q240={self.cuts:g} leaves strips between the lines, which are {step:g} mm apart")
        near, far = self.start_1st_axis - m.radius, self.start_1st_axis + self.first_side_length + m.radius
        way = lines([first + k * step for k in range(int(self.cuts))], near, far, m.radius)
        yield from face([Layer("", self.start_3rd_axis, way, self.milling_feed, self.stepover_feed, self.plunging_feed)], above)
        yield Go("retract", above)


@CYCLES("CYCL DEF 231", "Ruled surface", source="1.2")
class RuledSurface(Cycle):
    """Mills the surface between the lines 1-2 and 4-3 with the tip of the tool on straight lines, all the same way."""

    does = MILLS
    about = planes.in_program_coordinates
    x_1: float = coordinate("Q225", "starting point, first axis", example=0)
    y_1: float = coordinate("Q226", "starting point, second axis", example=5)
    z_1: float = coordinate("Q227", "starting point, tool axis", example=-2)
    x_2: float = coordinate("Q228", "second point, first axis", example=100)
    y_2: float = coordinate("Q229", "second point, second axis", example=15)
    z_2: float = coordinate("Q230", "second point, tool axis", example=5)
    x_3: float = coordinate("Q231", "third point, first axis", example=95)
    y_3: float = coordinate("Q232", "third point, second axis", example=65)
    z_3: float = coordinate("Q233", "third point, tool axis", example=-1)
    x_4: float = coordinate("Q234", "fourth point, first axis", example=5)
    y_4: float = coordinate("Q235", "fourth point, second axis", example=70)
    z_4: float = coordinate("Q236", "fourth point, tool axis", example=3)
    cuts: float = number("Q240", "number of cuts", note="from 1-2 to 4-3", example=20)
    milling_feed: float = addresses.milling_feed()

    def check(self, m: Machine) -> Iterator[ParameterFault]:
        yield from planes.with_radius(m)
        yield from planes.not_zero(self, "milling_feed", purpose="to mill with")
        yield from too_many_passes("cuts", 1, int(self.cuts))

    def moves(self, m: Machine) -> Iterator[Step]:
        first, second = (self.x_1, self.y_1, self.z_1), (self.x_2, self.y_2, self.z_2)
        third, fourth = (self.x_3, self.y_3, self.z_3), (self.x_4, self.y_4, self.z_4)
        begins, ends = passes(first, second, third, fourth, int(self.cuts))
        return mill_ruled(begins, ends, 2 * m.radius, self.milling_feed, self.milling_feed / 2)
