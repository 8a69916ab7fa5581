"""Pockets (MNC, 10.3 and 10.4): G343 rectangular and G344 circular, about the place where the tool stands.

The parts are the same for both: roughing in layers, the walls if U is given, the floor if W is given; each cycle says
only its shape.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from functools import partial

from mnclab.controls.mnc.cycles import addresses
from mnclab.controls.mnc.cycles.milling import MillingCycle
from mnclab.machine.coordinates import remark, tool
from mnclab.machine.cycle import CycleTable, few_passes, param, too_many
from mnclab.machine.machine import Machine
from mnclab.machining.depths import infeeds
from mnclab.machining.milling.entries import Entry
from mnclab.machining.milling.figures import Pocket, circular, mill_pocket, rectangular
from mnclab.machining.milling.finishing import quarter_circles
from mnclab.machining.milling.pocket_steps import Down, Feeds, Work, way_down
from mnclab.machining.steps import Go, Say, Step

CYCLES = CycleTable()

SCOPE: dict[float, str] = {0: "roughing and finishing", 1: "roughing only", 2: "finishing only"}
MODE: dict[float, str] = {1: "climb, counter-clockwise", -1: "conventional, clockwise", 0: "climb"}
STRAIGHT_OR_HELIX: dict[float, str] = {0: "vertical", 1: "helical"}
PLUNGE = STRAIGHT_OR_HELIX | {2: "reciprocating"}
LEAST = "at least the tool radius is taken"
ENTRIES = ("vertical", "helix", "ramp")

scope = partial(addresses.choice, "M", "scope of work", SCOPE, 0, default=0)
depth = partial(addresses.depth, meaning="depth from the surface to the floor", example=-10)
infeed = partial(addresses.distance, "P", "infeed of each layer", 4)
side_allowance = partial(addresses.allowance, "U", "allowance of the walls", 0.5, note="0: the walls are not finished")
floor_allowance = partial(addresses.allowance, "W", "allowance of the floor", 0.5, note="0: the floor is not finished")
finish_infeed = partial(addresses.allowance, "I", "infeed when finishing the walls", 5, note="0: one infeed")
overlap = partial(addresses.overlap, 1.4, 1)
plunge = partial(addresses.choice, "J", "plunge strategy", example=1, default=0)
feed = partial(addresses.feed, "milling feed", example=500)
plunge_feed = partial(addresses.own_feed, "V", "feed of the plunge", 150)
milling_mode = partial(addresses.choice, "L", "kind of milling with M3", MODE, 1, default=1)
finish_feed = partial(addresses.other_feed, "T", "finishing feed", 300)


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
    yield from few_passes("infeed", len(levels(pocket, pocket.infeed)), len(passes))
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


def work(pocket: AnyPocket) -> Work:
    """What M asks for, as far as there are allowances."""
    roughs, finishes, finish_feed = pocket.scope != 2, pocket.scope != 1, pocket.finish_feed or pocket.feed
    finishing = Feeds(finish_feed, pocket.plunge_feed)
    return Work(
        surface=pocket.surface,
        left_over=left_over(pocket),
        above=pocket.surface + pocket.clearance,
        lift=pocket.clearance,
        allowance=pocket.side_allowance,
        layers=levels(pocket, pocket.infeed) if roughs else (),
        walls=levels(pocket, pocket.finish_infeed) if finishes and pocket.side_allowance else (),
        floor=(pocket.surface + pocket.depth,) if finishes and pocket.floor_allowance else (),
        feeds=(Feeds(pocket.feed, pocket.plunge_feed), finishing, finishing),
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


@CYCLES("G343", "Rectangular pocket", runs="definition", source="MNC 10.3")
class RectangularPocket(MillingCycle):
    """Mills a rectangular pocket about the place of the tool: roughing, walls, floor."""

    scope: float = scope()
    length_x: float = addresses.side("A", "pocket length along X", 60)
    length_y: float = addresses.side("B", "pocket length along Y", 40)
    corner_radius: float = param("R", "corner radius", default=0, at_least=0, example=8, note=LEAST)
    rotation: float = addresses.angle("E", "angle of the pocket", 15)
    surface: float = addresses.surface()
    depth: float = depth()
    infeed: float = infeed()
    clearance: float = addresses.clearance()
    side_allowance: float = side_allowance()
    floor_allowance: float = floor_allowance()
    finish_infeed: float = finish_infeed()
    overlap: float = overlap()
    plunge: float = plunge(choices=PLUNGE, note="1 and 2 need the plunge angle of the tool")
    feed: float | None = feed()
    plunge_feed: float = plunge_feed()
    milling_mode: float = milling_mode()
    finish_feed: float | None = finish_feed()

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


@CYCLES("G344", "Circular pocket", runs="definition", source="MNC 10.4")
class CircularPocket(MillingCycle):
    """Mills a circular pocket about the place of the tool: roughing, walls, floor."""

    scope: float = scope()
    diameter: float = param("D", "diameter of the finished pocket", above=0, example=50)
    surface: float = addresses.surface()
    depth: float = depth()
    infeed: float = infeed()
    clearance: float = addresses.clearance()
    side_allowance: float = side_allowance()
    floor_allowance: float = floor_allowance()
    finish_infeed: float = finish_infeed()
    overlap: float = overlap()
    plunge: float = plunge(choices=STRAIGHT_OR_HELIX, note="1 needs the plunge angle of the tool")
    feed: float | None = feed()
    plunge_feed: float = plunge_feed()
    milling_mode: float = milling_mode()
    finish_feed: float | None = finish_feed()

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
