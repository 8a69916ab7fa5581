"""What the milling cycles share (MNC, chapter 10), and facing: G320 and G321.

They run at once, in the block that they stand in; coordinates are absolute under G90 and G91 (MNC-MILL-ABS).
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from functools import partial
from types import SimpleNamespace
from typing import ClassVar

from mnclab.controls.mnc.cycles import addresses
from mnclab.controls.word_address.holes import out_of_place
from mnclab.machine.coordinates import MILLS, remark, tool
from mnclab.machine.cycle import Cycle, CycleTable, param, too_many, too_many_passes
from mnclab.machine.machine import Machine
from mnclab.machining.depths import MOST, infeeds
from mnclab.machining.milling.clearing import Clearing, numbered
from mnclab.machining.milling.entries import Entry
from mnclab.machining.milling.faces import Layer, face, lines, rows
from mnclab.machining.milling.pocket_steps import (
    Down,
    LevelFeeds,
    Pocket,
    PocketWork,
    circular,
    mill_pocket,
    quarter_circles,
    rectangular,
    way_down,
)
from mnclab.machining.milling.rest import within
from mnclab.machining.steps import Go, Say, Step

SCOPE: dict[float, str] = {0: "roughing and finishing", 1: "roughing only", 2: "finishing only"}
MODE: dict[float, str] = {1: "climb, counter-clockwise", -1: "conventional, clockwise", 0: "climb"}
CYCLES = CycleTable(runs="definition", addresses=SimpleNamespace(  # of pockets
    surface=addresses.surface, clearance=addresses.clearance,
    scope=partial(addresses.choice, "M", "scope of work", SCOPE, 0, default=0),
    depth=partial(addresses.depth, meaning="depth from the surface to the floor", example=-10),
    infeed=partial(addresses.distance, "P", "infeed of each layer", 4),
    side_allowance=partial(addresses.allowance, "U", "allowance of the walls", 0.5, note="0: the walls are not finished"),
    floor_allowance=partial(addresses.allowance, "W", "allowance of the floor", 0.5, note="0: the floor is not finished"),
    finish_infeed=partial(addresses.allowance, "I", "infeed when finishing the walls", 5, note="0: one infeed"),
    overlap=partial(addresses.overlap, 1.4, 1),
    feed=partial(addresses.feed, "milling feed", example=500),
    plunge_feed=partial(addresses.own_feed, "V", "feed of the plunge", 150),
    milling_mode=partial(addresses.choice, "L", "kind of milling with M3", MODE, 1, default=1),
    finish_feed=partial(addresses.other_feed, "T", "finishing feed", 300),
))  # fmt: skip
ORIGIN = (0.0, 0.0)
STRATEGY: dict[float, str] = {
    0: "meander, stepover outside the surface",
    1: "meander, stepover within the surface",
    2: "one way, back above the surface",
}


class MillingCycle(Cycle):
    """What all of them need of the machine: a tool with a radius, a feed, no radius compensation; who inherits names the
    parameters."""

    does: ClassVar[str] = MILLS
    scope = surface = depth = infeed = clearance = side_allowance = floor_allowance = finish_infeed = overlap = plunge = 0.0
    plunge_feed = milling_mode = 0.0

    feed: float | None
    finish_feed: float | None

    def check(self, m: Machine) -> Iterator[tuple[str, str]]:
        yield from out_of_place(m)
        if m.radius <= 0:
            yield "", f"needs a tool with a radius, got {m.radius:g}"
        if self.feed is None and m.feed is None:
            yield "feed", "is missing, and no feed rate was programmed before"


@CYCLES("G320", "Line-by-line milling", source="MNC 10.1")
class LineMilling(MillingCycle):
    """Mills a surface at one height on a given number of lines along X, to and fro."""

    start_x: float = addresses.coordinate("X", "start corner along X", 0)
    start_y: float = addresses.coordinate("Y", "start corner along Y", 0)
    level: float = addresses.coordinate("Z", "height of the milled surface", -1)
    length_x: float = addresses.side("A", "length along X", 60)
    length_y: float = addresses.side("B", "length along Y", 40)
    passes: float = addresses.count("K", "number of lines", 6, note="0 mills nothing")
    plunge_feed: float = addresses.own_feed("V", "feed down to the height", 150)
    feed: float | None = addresses.feed("milling feed", example=500)
    stepover_feed: float | None = addresses.other_feed("T", "feed to the next line", 250)
    clearance: float = addresses.clearance(meaning="clearance above the milling height")

    def contradictions(self) -> Iterator[tuple[str, str]]:
        if self.passes > MOST:
            yield "passes", f"must be at most {MOST}, got {self.passes:g}"

    def across(self, radius: float) -> tuple[float, ...]:
        """Where the lines lie: the first and the last one flush with the edges (MNC-G320-STEP)."""
        first, last, count = self.start_y + radius, self.start_y + self.length_y - radius, int(self.passes)
        if count == 1 or last <= first:
            return (first,)
        return tuple(first + (last - first) * k / (count - 1) for k in range(count))

    def remarks(self, radius: float) -> Iterator[str]:
        width, count = self.length_y, int(self.passes)
        if not count:
            yield "K (number of lines) is 0: nothing is milled"
        elif count > 1 and width <= 2 * radius:
            yield f"one line is as wide as B{width:g}: K{count} lines are not needed"
        elif count == 1 and width > 2 * radius:
            yield f"one line leaves strips uncut: B{width:g} is wider than the tool, {2 * radius:g} mm"
        elif count > 1 and (step := (width - 2 * radius) / (count - 1)) > 2 * radius:
            yield f"K{count} lines leave strips uncut: they lie {round(step, 3):g} mm apart, the tool is {2 * radius:g} mm wide"

    def about(self, m: Machine) -> tuple[float, float]:
        return ORIGIN

    def moves(self, m: Machine) -> Iterator[Step]:
        """Steps 1 to 7 of the manual; the tool stays at the clearance level."""
        radius, above = m.radius, self.level + self.clearance
        yield from (Say(sentence + remark(m)) for sentence in self.remarks(radius))
        if not self.passes:
            return
        passes = lines(self.across(radius), self.start_x - radius, self.start_x + self.length_x + radius, radius)
        layer = Layer("", self.level, passes, self.feed, self.stepover_feed or self.feed, self.plunge_feed)
        yield Go("to the clearance level", max(m.programmed[2], above))
        yield from face([layer], above)
        yield Go("to the clearance level", above)


@CYCLES("G321", "Face milling", source="MNC 10.2")
class FaceMilling(MillingCycle):
    """Mills a surface in several infeeds, the last of them a finishing cut; each level backwards over the one before."""

    strategy: float = addresses.choice("L", "machining strategy", STRATEGY, 0, default=0)
    start_x: float = addresses.coordinate("X", "start corner along X", 0)
    start_y: float = addresses.coordinate("Y", "start corner along Y", 0)
    level_from: float = addresses.coordinate("Z", "height from which to mill", 0)
    level_to: float = addresses.coordinate("W", "height down to which to mill", -5)
    length_x: float = addresses.side("A", "length along X", 60)
    length_y: float = addresses.side("B", "length along Y", 40)
    clearance: float = addresses.clearance(meaning="clearance above the milling height")
    max_infeed: float = addresses.distance("P", "greatest infeed", 2)
    overlap: float = addresses.overlap(1.999, 1.5)
    feed: float | None = addresses.feed("milling feed", example=500)
    positioning_feed: float = addresses.own_feed("V", "positioning feed", 2000)
    side_clearance: float = addresses.distance("I", "clearance at the side", 3)
    allowance: float = addresses.allowance("U", "finishing allowance", 0.5, note="the last infeed")
    finish_feed: float | None = addresses.other_feed("T", "finishing feed", 800)

    def contradictions(self) -> Iterator[tuple[str, str]]:
        height = self.level_from - self.level_to
        if height < 0:
            yield "level_to", f"must not lie above Z, got W {self.level_to:g} and Z {self.level_from:g}"
        if self.allowance > height:
            yield "allowance", f"must be at most Z - W = {height:g}, got {self.allowance:g}"
        yield from too_many("max_infeed", self.levels)

    def check(self, m: Machine) -> Iterator[tuple[str, str]]:
        yield from super().check(m)
        yield from too_many("overlap", lambda: self.across(m.radius))
        yield from too_many_passes("max_infeed", len(self.levels()), len(self.across(m.radius)))

    def levels(self) -> tuple[float, ...]:
        """Equal infeeds down to the allowance, and then the allowance."""
        roughing = rows(self.level_from, self.level_to + self.allowance, self.max_infeed)[1:]
        return (*roughing, self.level_to) if self.allowance else roughing

    def across(self, radius: float) -> tuple[float, ...]:
        """Where the lines lie: flush with the edges, or in the middle of a narrow surface."""
        first, last = self.start_y + radius, self.start_y + self.length_y - radius
        if last <= first:
            return (self.start_y + self.length_y / 2,)
        return rows(first, last, self.overlap * radius)

    def clearings(self, radius: float) -> tuple[Clearing, Clearing]:
        """The lines of the first level, and those of all others, where a stepover within the surface stays in it."""
        across, outside = self.across(radius), radius + self.side_clearance
        left, right = self.start_x - outside, self.start_x + self.length_x + outside
        if self.strategy != 1:
            found = lines(across, left, right, radius, one_way=self.strategy == 2)
            return found, found
        near, far = self.start_x + radius, self.start_x + self.length_x - radius
        if far < near:  # narrower than the tool: up and down in the middle
            near = far = self.start_x + self.length_x / 2
        return lines(across, left, right, radius, within=(near, far)), lines(across, near, far, radius)

    def residue(self, radius: float) -> float:
        """What of the finished surface lines that end within it leave, mm² (MNC-G321-L1END)."""
        if self.strategy != 1:
            return 0.0
        return within(self.length_x, self.length_y, radius, self.across(radius), outside=len(self.levels()) == 1)

    def layers(self, radius: float) -> Iterator[Layer]:
        """Every second level backwards; the finishing infeed at its own feed."""
        first, other = self.clearings(radius)
        levels, inside = self.levels(), self.strategy == 1
        for k, (name, level) in enumerate(zip(numbered("layer", len(levels)), levels, strict=True)):
            finishing = bool(self.allowance) and k == len(levels) - 1
            feed = (self.finish_feed or self.feed) if finishing else self.feed
            passes = other.reversed() if k % 2 else other if k else first
            link = feed if inside else self.positioning_feed
            down = self.feed if inside and k else self.positioning_feed
            yield Layer("finishing" if finishing else name, level, passes, feed, link, down)

    def about(self, m: Machine) -> tuple[float, float]:
        return ORIGIN

    def moves(self, m: Machine) -> Iterator[Step]:
        if not self.levels():
            yield Say("Z and W are the same height: nothing is milled")
            return
        if (area := self.residue(m.radius) * m.scale**2) > 1e-9:
            where = "the lines end within it, in the corners and between two lines the tool is round"
            yield Say(f"L1 leaves {area:.3f} mm² of the surface uncut: {where}", "L0 and L2 mill all of it")
        above = self.level_from + self.clearance
        end = max(m.programmed[2], above)
        yield Go("to the clearance level", end)
        yield from face(list(self.layers(m.radius)), above, self.clearance)
        yield Go("to the start level", end)


# Pockets (MNC, 10.3 and 10.4): G343 rectangular and G344 circular, about the place where the tool stands.
# The parts are the same for both: roughing in layers, the walls if U is given, the floor if W is given; each cycle says
# only its shape.

STRAIGHT_OR_HELIX: dict[float, str] = {0: "vertical", 1: "helical"}
PLUNGE = STRAIGHT_OR_HELIX | {2: "reciprocating"}
LEAST = "at least the tool radius is taken"
ENTRIES = ("vertical", "helix", "ramp")
POCKET = (
    "surface depth infeed clearance side_allowance floor_allowance finish_infeed overlap plunge feed plunge_feed milling_mode "
    "finish_feed"
)
plunge = partial(addresses.choice, "J", "plunge strategy", example=1, default=0)


def climb(pocket: AnyPocket) -> bool:
    """Whether the tool goes round counter-clockwise."""
    return pocket.milling_mode >= 0


def left_over(pocket: AnyPocket) -> float:
    """Where roughing and the finishing of the walls end."""
    return pocket.surface + pocket.depth + pocket.floor_allowance


def levels(pocket: AnyPocket, infeed: float) -> tuple[float, ...]:
    """Of roughing or of finishing the walls; the last infeed may be smaller."""
    return infeeds(pocket.surface, left_over(pocket), infeed)


def too_deep(pocket: AnyPocket) -> Iterator[tuple[str, str]]:
    """Faults where all of the depth is allowance, and where there are more levels than a pocket can have."""
    if pocket.floor_allowance >= -pocket.depth:
        yield "floor_allowance", f"must be less than the depth {-pocket.depth:g}, got {pocket.floor_allowance:g}"
    yield from too_many("infeed", lambda: levels(pocket, pocket.infeed))
    yield from too_many("finish_infeed", lambda: levels(pocket, pocket.finish_infeed))


def faults(pocket: AnyPocket, m: Machine) -> Iterator[tuple[str, str]]:
    """Where somebody would wait too long, or the tool cannot get down."""
    shape, angle = pocket.shape(m.radius), m.tool.plunge_angle
    yield from too_many("overlap", lambda: shape.clearing(0.0))
    passes = shape.clearing(pocket.side_allowance).passes
    yield from too_many_passes("infeed", len(levels(pocket, pocket.infeed)), len(passes))
    if pocket.plunge and not 0 < angle <= 90:
        needed = f"the plunge angle of tool {m.tool.number}, greater than 0 and at most 90"
        yield "plunge", f"{pocket.plunge:g} needs {needed}, in the tool table"
    room = shape.room(pocket.side_allowance)
    if pocket.plunge == 1 and angle < 90 and room.half_width <= 0:
        yield "plunge", "1 has no room for a helix: the tool fills the pocket"
    if pocket.plunge == 2 and angle < 90 and room.half_length < 2 * m.radius:
        least = f"twice the tool diameter, {4 * m.radius:g}"
        yield "plunge", f"2 has no room for a ramp: {2 * room.half_length:g} is less than {least}"
    deepest = max(min(pocket.infeed, -pocket.depth), pocket.floor_allowance)
    yield from too_many("plunge", lambda: way_in(pocket, m)(0.0, -deepest))


def way_in(pocket: AnyPocket, m: Machine) -> Down:
    """The way from one level to another, as J says."""
    entry = Entry(ENTRIES[int(pocket.plunge)], tool(m).plunge_angle) if pocket.plunge else Entry()
    return partial(way_down, entry, pocket.shape(m.radius).room(pocket.side_allowance), m.radius, climb(pocket))


def work(pocket: AnyPocket) -> PocketWork:
    """What M asks for, as far as there are allowances."""
    roughs, finishes, finish_feed = pocket.scope != 2, pocket.scope != 1, pocket.finish_feed or pocket.feed
    finishing = LevelFeeds(finish_feed, pocket.plunge_feed)
    return PocketWork(
        surface=pocket.surface,
        left_over=left_over(pocket),
        above=pocket.surface + pocket.clearance,
        lift=pocket.clearance,
        allowance=pocket.side_allowance,
        layers=levels(pocket, pocket.infeed) if roughs else (),
        walls=levels(pocket, pocket.finish_infeed) if finishes and pocket.side_allowance else (),
        floor=(pocket.surface + pocket.depth,) if finishes and pocket.floor_allowance else (),
        feeds=(LevelFeeds(pocket.feed, pocket.plunge_feed), finishing, finishing),
        side=1 if climb(pocket) else -1,
    )


def mill(pocket: AnyPocket, m: Machine) -> Iterator[Step]:
    """Down to the clearance level, what M asks for, and up to the level of the start point."""
    shape, todo = pocket.shape(m.radius), work(pocket)
    room, end = shape.room(pocket.side_allowance), max(m.programmed[2], todo.above)
    if todo.is_nothing:
        yield Say("M2 finishes nothing: neither U nor W is given")
        return
    if pocket.plunge == 1 and m.tool.plunge_angle < 90 and room.half_width < m.radius:
        narrow = f"its radius is {room.half_width:g}, that of the tool {m.radius:g}"
        yield Say(f"J1 has a narrow helix: {narrow}{remark(m)}")
    yield Go("to the clearance level", todo.above)
    down, off = way_in(pocket, m), min(pocket.side_allowance + pocket.clearance, shape.room(0.0).half_width)
    yield from mill_pocket(shape, todo, down, down, over_walls=todo.above, off_floor=off)
    yield Go("to the start point", end)


@CYCLES("G343", "Rectangular pocket", source="MNC 10.3", takes=f"scope length_x length_y corner_radius rotation {POCKET}")
class RectangularPocket(MillingCycle):
    """Mills a rectangular pocket about the place of the tool: roughing, walls, floor."""

    length_x: float = addresses.side("A", "pocket length along X", 60)
    length_y: float = addresses.side("B", "pocket length along Y", 40)
    corner_radius: float = param("R", "corner radius", default=0, at_least=0, example=8, note=LEAST)
    rotation: float = addresses.angle("E", "angle of the pocket", 15)
    plunge: float = plunge(choices=PLUNGE, note="1 and 2 need the plunge angle of the tool")

    moves = mill

    def contradictions(self) -> Iterator[tuple[str, str]]:
        yield from too_deep(self)
        half = min(self.length_x, self.length_y) / 2
        if self.corner_radius > half:
            yield "corner_radius", f"must be at most half the shorter side, {half:g}, got {self.corner_radius:g}"

    def check(self, m: Machine) -> Iterator[tuple[str, str]]:
        """Both sides exceed tool and allowances (MNC-G343-AB0); as all pockets."""
        yield from super().check(m)
        least = 2 * (m.radius + self.side_allowance)
        for name, length in (("length_x", self.length_x), ("length_y", self.length_y)):
            if length <= least:
                yield name, f"must be greater than the tool diameter and twice U, {least:g}, got {length:g}"
        yield from faults(self, m)

    def shape(self, radius: float) -> Pocket:
        """Rectangles from the centre outwards, each begun where the longer axis leaves it; that is X where both are the same."""
        return rectangular(
            self.length_x, self.length_y, radius, self.overlap * radius, corner=self.corner_radius, climb=climb(self),
            angle=math.radians(self.rotation),
        )  # fmt: skip


@CYCLES("G344", "Circular pocket", source="MNC 10.4", takes=f"scope diameter {POCKET}")
class CircularPocket(MillingCycle):
    """Mills a circular pocket about the place of the tool: roughing, walls, floor."""

    diameter: float = param("D", "diameter of the finished pocket", above=0, example=50)
    plunge: float = plunge(choices=STRAIGHT_OR_HELIX, note="1 needs the plunge angle of the tool")

    contradictions, moves = too_deep, mill

    def check(self, m: Machine) -> Iterator[tuple[str, str]]:
        yield from super().check(m)
        if self.diameter < (least := 2 * (m.radius + self.side_allowance)):
            yield "diameter", f"must be at least the tool diameter and twice U, {least:g}, got {self.diameter:g}"
        yield from faults(self, m)

    def shape(self, radius: float) -> Pocket:
        """Circles from the centre outwards; none where the tool fills the pocket."""
        shape = circular(self.diameter, radius, self.overlap * radius, climb=climb(self))
        return shape._replace(arcs=quarter_circles)


AnyPocket = RectangularPocket | CircularPocket
