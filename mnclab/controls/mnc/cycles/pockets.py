"""Pockets (MNC, 10.3 and 10.4): G343 rectangular and G344 circular, about the place where the tool stands.

R_t is the effective tool radius, z0 the level of the tool when the block is reached. The parts are the same for both:
roughing in layers, the walls if U is given, the floor if W is given; each cycle says only its `Shape`.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from functools import partial
from typing import NamedTuple

from mnclab.controls.mnc.cycles import addresses
from mnclab.controls.mnc.cycles.milling import MillingCycle
from mnclab.machine.cycle import CycleTable, few_passes, param, too_many
from mnclab.machine.machine import Machine
from mnclab.machine.true_size import remark, tool
from mnclab.machining.depths import infeeds
from mnclab.machining.milling import concentric
from mnclab.machining.milling.clearing import Clearing
from mnclab.machining.milling.entries import Entry
from mnclab.machining.milling.finishing import quarter_circles
from mnclab.machining.milling.pocket_steps import Down, Feeds, Room, finish_floor, finish_walls, rough, way_down
from mnclab.machining.steps import Go, Say, Step

CYCLES = CycleTable()

SCOPE: dict[float, str] = {0: "roughing and finishing", 1: "roughing only", 2: "finishing only"}
MODE: dict[float, str] = {1: "climb, counter-clockwise", -1: "conventional, clockwise", 0: "climb"}
STRAIGHT_OR_HELIX: dict[float, str] = {0: "vertical", 1: "helical"}
PLUNGE = STRAIGHT_OR_HELIX | {2: "reciprocating"}
ENTRIES = ("vertical", "helix", "ramp")

# --- addresses of both ---------------------------------------------------------------------------------------------------

scope = partial(addresses.choice, "M", "scope of work", SCOPE, 0, default=0)
depth = partial(addresses.depth, "depth from the surface to the floor", -10)
infeed = partial(addresses.distance, "P", "infeed of each layer", 4)
side_allowance = partial(addresses.allowance, "U", "allowance of the walls", 0.5, "0: the walls are not finished")
floor_allowance = partial(addresses.allowance, "W", "allowance of the floor", 0.5, "0: the floor is not finished")
finish_infeed = partial(addresses.allowance, "I", "infeed when finishing the walls", 5, "0: one infeed")
overlap = partial(addresses.overlap, 1.4, 1)
plunge = partial(addresses.choice, "J", "plunge strategy", example=1, default=0)
feed = partial(addresses.feed, "milling feed", 500)
plunge_feed = partial(addresses.own_feed, "V", "feed of the plunge", 150)
milling_mode = partial(addresses.choice, "L", "kind of milling with M3", MODE, 1, default=1)
finish_feed = partial(addresses.other_feed, "T", "finishing feed", 300)

# --- cycles --------------------------------------------------------------------------------------------------------------


class Shape(NamedTuple):
    """A pocket for one tool, about (0, 0): the `passes` that clear it but for an `allowance` at its walls, and the `room`
    for the tool centre there."""

    passes: Callable[..., Clearing]
    room: Callable[[float], Room]


@CYCLES("G343", "Rectangular pocket", runs="definition", source="MNC 10.3")
class RectangularPocket(MillingCycle):
    """Mills a rectangular pocket about the place of the tool: roughing, walls, floor."""

    scope: float = scope()
    length_x: float = addresses.side("A", "pocket length along X", 60)
    length_y: float = addresses.side("B", "pocket length along Y", 40)
    corner_radius: float = param(
        "R", "corner radius", default=0, at_least=0, example=8, note="at least the tool radius is taken"
    )
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

    def contradictions(self) -> Iterator[tuple[str, str]]:
        """As all pockets; and the corners fit."""
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

    def shape(self, radius: float) -> Shape:
        """Rectangles from the centre outwards, each begun where the longer axis leaves it; that is X where both are the same."""
        a, b, turned = self.length_x / 2 - radius, self.length_y / 2 - radius, math.radians(self.rotation)
        passes = partial(
            concentric.rectangle, self.length_x, self.length_y, radius, self.overlap * radius,
            corner=self.corner_radius, climb=climb(self), angle=turned,
        )  # fmt: skip
        along = turned + (math.pi / 2 if a < b else 0.0)
        return Shape(passes, lambda allowance: Room(min(a, b) - allowance, max(a, b) - allowance, along))

    def moves(self, m: Machine) -> Iterator[Step]:
        """Steps 1 to 8 of the manual."""
        return mill(self, m)


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

    def contradictions(self) -> Iterator[tuple[str, str]]:
        """As all pockets."""
        yield from too_deep(self)

    def check(self, m: Machine) -> Iterator[tuple[str, str]]:
        """The tool and its allowance fit; as all pockets."""
        yield from super().check(m)
        if self.diameter < (least := 2 * (m.radius + self.side_allowance)):
            yield "diameter", f"must be at least the tool diameter and twice U, {least:g}, got {self.diameter:g}"
        yield from faults(self, m)

    def shape(self, radius: float) -> Shape:
        """Circles from the centre outwards; none where the tool fills the pocket."""
        reach = self.diameter / 2 - radius
        passes = partial(concentric.circle, self.diameter, radius, self.overlap * radius, climb=climb(self))
        return Shape(passes, lambda allowance: Room(reach - allowance, reach - allowance))

    def moves(self, m: Machine) -> Iterator[Step]:
        """Steps 1 to 8 of the manual."""
        return mill(self, m)


Pocket = RectangularPocket | CircularPocket


def climb(pocket: Pocket) -> bool:
    """Whether the tool goes round counter-clockwise."""
    return pocket.milling_mode >= 0


def left_over(pocket: Pocket) -> float:
    """Where roughing and the finishing of the walls end."""
    return pocket.surface + pocket.depth + pocket.floor_allowance


def levels(pocket: Pocket, infeed: float) -> tuple[float, ...]:
    """Of roughing or of finishing the walls; the last infeed may be smaller."""
    return infeeds(pocket.surface, left_over(pocket), infeed)


def too_deep(pocket: Pocket) -> Iterator[tuple[str, str]]:
    """Faults where all of the depth is allowance, and where there are more levels than a pocket can have."""
    if pocket.floor_allowance >= -pocket.depth:
        yield "floor_allowance", f"must be less than the depth {-pocket.depth:g}, got {pocket.floor_allowance:g}"
    yield from too_many("infeed", lambda: levels(pocket, pocket.infeed))
    yield from too_many("finish_infeed", lambda: levels(pocket, pocket.finish_infeed))


def faults(pocket: Pocket, m: Machine) -> Iterator[tuple[str, str]]:
    """Where somebody would wait too long, or the tool cannot get down."""
    shape, angle = pocket.shape(m.radius), m.tool.plunge_angle
    yield from too_many("overlap", lambda: shape.passes(allowance=0.0))
    passes = shape.passes(allowance=pocket.side_allowance).passes
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


def way_in(pocket: Pocket, m: Machine) -> Down:
    """The way from one level to another, as J says."""
    entry = Entry(ENTRIES[int(pocket.plunge)], tool(m).plunge_angle) if pocket.plunge else Entry()
    return partial(way_down, entry, pocket.shape(m.radius).room(pocket.side_allowance), m.radius, climb(pocket))


def mill(pocket: Pocket, m: Machine) -> Iterator[Step]:
    """Down to the clearance level, what M asks for, and up to the level of the start point."""
    shape, above, side = pocket.shape(m.radius), pocket.surface + pocket.clearance, 1 if climb(pocket) else -1
    room, end = shape.room(pocket.side_allowance), max(m.programmed[2], above)
    if pocket.scope == 2 and not (pocket.side_allowance or pocket.floor_allowance):
        yield Say("M2 finishes nothing: neither U nor W is given")
        return
    if pocket.plunge == 1 and m.tool.plunge_angle < 90 and room.half_width < m.radius:
        narrow = f"its radius is {room.half_width:g}, that of the tool {m.radius:g}"
        yield Say(f"J1 has a narrow helix: {narrow}{remark(m)}")
    yield Go("to the clearance level", above)
    if pocket.scope != 2:
        yield from rough(
            shape.passes(allowance=pocket.side_allowance), levels(pocket, pocket.infeed), surface=pocket.surface,
            clearance=pocket.clearance, down=way_in(pocket, m), feeds=Feeds(pocket.feed, pocket.plunge_feed),
            departure=min(pocket.clearance, room.half_width), side=side,
        )  # fmt: skip
    if pocket.scope != 1:
        yield from finish(pocket, m, above, side)
    yield Go("to the start point", end)


def finish(pocket: Pocket, m: Machine, above: float, side: int) -> Iterator[Step]:
    """The walls, and then the floor, each if it has an allowance."""
    shape, feeds = pocket.shape(m.radius), Feeds(pocket.finish_feed or pocket.feed, pocket.plunge_feed)
    whole, clearance = shape.passes(allowance=0.0), pocket.clearance
    arc = min(pocket.side_allowance + clearance, shape.room(0.0).half_width)
    if pocket.side_allowance and whole.passes and whole.passes[-1].closed:  # there is a way round
        yield from finish_walls(
            whole.passes[-1], levels(pocket, pocket.finish_infeed), above=above, clearance=clearance, feeds=feeds,
            arcs=quarter_circles(whole.passes[-1], arc, side), side=side,
        )  # fmt: skip
    if pocket.floor_allowance:
        yield from finish_floor(
            whole, pocket.surface + pocket.depth, top=left_over(pocket), clearance=clearance, down=way_in(pocket, m),
            feeds=feeds, departure=arc, side=side,
        )  # fmt: skip
