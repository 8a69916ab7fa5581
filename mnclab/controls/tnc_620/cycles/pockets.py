"""Rectangular and circular pockets: cycles 251 (6.2) and 252 (6.3), and how a tool goes down into a pocket or a slot.

C is the centre of the pocket, R the tool radius, Room where the centre of the tool may go about C.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from functools import partial
from typing import TYPE_CHECKING, TypeAlias

import numpy as np

from mnclab.controls.tnc_620.cycles import addresses, milling
from mnclab.controls.tnc_620.cycles.addresses import choice, distance, length
from mnclab.controls.tnc_620.cycles.faults import SAME, Fault, at_least, at_most
from mnclab.controls.tnc_620.cycles.milling import Figure, Place
from mnclab.controls.tnc_620.cycles.planes import AtSurface, in_program_coordinates
from mnclab.machine.coordinates import MILLS, tool
from mnclab.machine.cycle import CycleTable, few_passes, too_many
from mnclab.machine.machine import Machine
from mnclab.machining.milling import figures
from mnclab.machining.milling.concentric import NOTHING
from mnclab.machining.milling.entries import Descent, Entry, onto_floor
from mnclab.machining.milling.figures import Pocket, mill_pocket, straight
from mnclab.machining.milling.pocket_steps import Down, Feeds, Room, way_down
from mnclab.machining.steps import Step

if TYPE_CHECKING:
    from mnclab.controls.tnc_620.contours.trochoidal_slot import TrochoidalSlot
    from mnclab.controls.tnc_620.cycles.slots import AnySlot

CYCLES = CycleTable()
ENTRIES = ("vertical", "helix", "ramp")
CORNER = {0: "the tool is at the centre"} | addresses.CORNERS
SIGNS = ((0, 0), (1, 1), (-1, 1), (-1, -1), (1, -1))  # from the tool to the centre, in half sides
CORNERS = 1.4  # times R, the widest step between two rectangles with sharp corners that leaves nothing between them


@CYCLES("CYCL DEF 251", "Rectangular pocket", source="6.2")
class RectangularPocket(AtSurface):
    """Mills a rectangular pocket: roughing in layers from the centre outwards, then its walls, then its floor."""

    does = MILLS
    about = in_program_coordinates
    check = milling.check
    machining_operation: float = addresses.operation()
    first_side_length: float = distance("Q218", "first side length", example=80)
    second_side_length: float = distance("Q219", "second side length", example=60)
    corner_radius: float = length("Q220", "corner radius", note="0: the tool radius", example=8)
    side_allowance: float = addresses.side_allowance()
    rotation_angle: float = addresses.rotation("Q224")
    pocket_position: float = choice("Q367", "pocket position", CORNER, example=0)
    milling_feed: float = addresses.milling_feed()
    milling_type: float = addresses.climb(predef=True)
    depth: float = addresses.depth()
    infeed: float = addresses.layer()
    floor_allowance: float = addresses.floor_allowance()
    plunging_feed: float = addresses.plunge_feed(also=addresses.PLANE)
    finishing_infeed: float = addresses.finishing_infeed()
    clearance: float = addresses.clearance(predef=True)
    surface: float = addresses.surface()
    second_clearance: float = addresses.second_clearance(predef=True, example=50)
    overlap: float = addresses.overlap(at_least=0.0001)
    plunging_strategy: float = addresses.plunging(addresses.PLUNGE)
    finishing_feed: float | None = addresses.finishing_feed(default=None, default_means="as Q207", example=500)
    feed_reference: float = addresses.feed_reference()

    def contradictions(self) -> Iterator[Fault]:
        yield from milling.contradictions(self)
        if self.depth:
            half = min(self.first_side_length, self.second_side_length) / 2
            yield from at_most(self, "corner_radius", half, "half the shorter side")

    def fits(self, m: Machine) -> Iterator[Fault]:
        least = 2 * (m.radius + self.side_allowance)
        for name in ("first_side_length", "second_side_length"):
            yield from at_least(self, name, least, "the tool diameter and twice Q368")
        if 0 < self.corner_radius < m.radius - SAME:
            yield "corner_radius", f"must be 0 or at least the tool radius, {m.radius:g}, got {self.corner_radius:g}"
        yield from check_pocket(self, m, self.pocket(m))

    def pocket(self, m: Machine) -> Pocket:
        """Begun on the reference axis, along which a ramp swings."""
        return figures.rectangular(
            self.first_side_length, self.second_side_length, m.radius, min(self.overlap, CORNERS) * m.radius,
            corner=self.corner_radius, angle=math.radians(self.rotation_angle), climb=self.milling_type >= 0, begin=0,
        )  # fmt: skip

    def moves(self, m: Machine) -> Iterator[Step]:
        """C lies half the sides away from the tool, turned about the tool."""
        sides = self.first_side_length, self.second_side_length
        u, v = (np.array(SIGNS[int(self.pocket_position)]) * sides / 2).tolist()
        c, s = math.cos(math.radians(self.rotation_angle)), math.sin(math.radians(self.rotation_angle))
        return mill(self, m, self.pocket(m), (m.programmed[0] + c * u - s * v, m.programmed[1] + s * u + c * v))


@CYCLES("CYCL DEF 252", "Circular pocket", source="6.3")
class CircularPocket(AtSurface):
    """Mills a circular pocket about the tool position: roughing in layers outwards, then its wall, then its floor."""

    does = MILLS
    about = in_program_coordinates
    check = milling.check
    contradictions = milling.contradictions
    machining_operation: float = addresses.operation()
    circle_diameter: float = length("Q223", "circle diameter", example=60)
    side_allowance: float = addresses.side_allowance()
    milling_feed: float = addresses.milling_feed()
    milling_type: float = addresses.climb(predef=True)
    depth: float = addresses.depth()
    infeed: float = addresses.layer()
    floor_allowance: float = addresses.floor_allowance()
    plunging_feed: float = addresses.plunge_feed(also=addresses.PLANE)
    finishing_infeed: float = addresses.finishing_infeed()
    clearance: float = addresses.clearance(predef=True)
    surface: float = addresses.surface()
    second_clearance: float = addresses.second_clearance(predef=True, example=50)
    overlap: float = addresses.overlap(at_least=0.1)
    plunging_strategy: float = addresses.plunging({0: "vertical", 1: "helical"})
    finishing_feed: float | None = addresses.finishing_feed(default=None, default_means="as Q207", example=500)
    feed_reference: float = addresses.feed_reference()

    def fits(self, m: Machine) -> Iterator[Fault]:
        least = 2 * (m.radius + self.side_allowance)
        yield from at_least(self, "circle_diameter", least, "the tool diameter and twice Q368")
        yield from check_pocket(self, m, self.pocket(m))
        if not self.plunging_strategy and m.tool.plunge_angle not in (0, 90):
            angle = f"the plunge angle (ANGLE) of tool {m.tool.number} to be 0 or 90, it is {m.tool.plunge_angle:g}"
            yield "plunging_strategy", f"0 needs {angle}"

    def pocket(self, m: Machine) -> Pocket:
        return figures.circular(self.circle_diameter, m.radius, self.overlap * m.radius, climb=self.milling_type >= 0)

    def moves(self, m: Machine) -> Iterator[Step]:
        """Roughing alone ends at the second set-up clearance before the tool goes to the middle."""
        end = self.end if self.machining_operation == 1 and self.depth < 0 else None
        return mill(self, m, self.pocket(m), m.programmed[:2], end)


AnyPocket: TypeAlias = RectangularPocket | CircularPocket

# --- what both share ------------------------------------------------------------------------------------------------


def check_pocket(c: AnyPocket, m: Machine, pocket: Pocket) -> Iterator[Fault]:
    """No more passes than somebody would wait for, and the tool gets down."""
    yield from too_many("overlap", lambda: pocket.clearing(0.0))
    levels, room = milling.levels(c, m), pocket.room(c.side_allowance)
    yield from few_passes("infeed", len(levels), len(pocket.clearing(c.side_allowance).passes))
    yield from check_angle(c, m)
    if c.machining_operation == 2:
        return
    if c.plunging_strategy == 1 and slopes(c, m) and m.settings["plunge_error"]:
        if room.half_width < m.radius - SAME:
            widest, least = 2 * (room.half_width + m.radius), 4 * m.radius
            yield "plunging_strategy", f"1 has a helix {widest:g} wide: at least twice the tool diameter, {least:g}"
    if c.plunging_strategy == 2 and slopes(c, m) and room.half_length < 2 * m.radius - SAME:
        found = f"{2 * room.half_length:g} is less than twice the tool diameter, {4 * m.radius:g}"
        yield "plunging_strategy", f"2 has no room for a ramp: {found}"
    yield from too_many("plunging_strategy", lambda: way_in(c, m, room)(0.0, levels[0] - c.surface))


def check_angle(c: AnyPocket | AnySlot | TrochoidalSlot, m: Machine) -> Iterator[Fault]:
    """All strategies but the vertical one need a plunge angle."""
    if c.plunging_strategy and not 0 < m.tool.plunge_angle <= 90:
        angle = f"the plunge angle (ANGLE) of tool {m.tool.number}, greater than 0 and at most 90"
        yield "plunging_strategy", f"{c.plunging_strategy:g} needs {angle}, in the tool table"


def slopes(c: AnyPocket | AnySlot, m: Machine) -> bool:
    """Whether the tool goes down on a helix or a ramp; at 90 degrees both are straight down."""
    return bool(c.plunging_strategy > 0 and m.tool.plunge_angle < 90)


def way_in(c: AnyPocket, m: Machine, room: Room) -> Down:
    """The way from one level to another; straight down where a helix is as narrow as the tool."""
    sloping = slopes(c, m) and not (c.plunging_strategy == 1 and room.half_width < NOTHING)
    entry = Entry(ENTRIES[int(c.plunging_strategy)], tool(m).plunge_angle) if sloping else Entry()
    return partial(way_down, entry, room, m.radius, c.milling_type >= 0)


def feeds(c: AnyPocket | AnySlot | TrochoidalSlot, m: Machine) -> tuple[Feeds, Feeds, Feeds]:
    """Of roughing, the side and the floor: from which Q439 on they count at the cutting edge; ways down never do."""
    first, second, third = (m.radius if c.feed_reference >= least else 0.0 for least in (3, 1, 2))
    plunge, finish = c.plunging_feed, milling.finishing_feed(c)
    return Feeds(c.milling_feed, plunge, first), Feeds(finish, plunge, second), Feeds(finish, plunge, third)


def mill(c: AnyPocket, m: Machine, pocket: Pocket, centre: Place, end: float | None = None) -> Iterator[Step]:
    """Roughing in layers, the walls in infeeds, the floor; then back to where the tool was called."""
    whole, work = pocket.room(0.0), milling.work(c, m, feeds(c, m))

    def to_floor(top: float, bottom: float) -> Descent:
        """On a quarter circle along the reference axis, which touches the floor in the middle; straight without room."""
        if c.floor_allowance > whole.half_length:
            return straight(top, bottom)
        return onto_floor((0.0, 0.0), whole.direction, top, bottom)

    def figures() -> Iterator[Figure]:  # only where the depth is not 0, and all that the tool needs is known
        down = way_in(c, m, pocket.room(c.side_allowance))
        steps = mill_pocket(
            pocket, work, down, to_floor, over_walls=milling.wall_levels(c)[0] + work.lift,
            off_floor=min(c.clearance, whole.half_width), end=end,
        )  # fmt: skip
        yield Figure(centre, centre, steps)

    return milling.mill(c, m, work, figures(), [milling.back(m.programmed[:2])])
