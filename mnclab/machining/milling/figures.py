"""Pockets and slots of simple shape: a shape is what differs between them, and what is done to it is the same for all.

    roughing in layers  ─►  the wall in infeeds  ─►  the floor at once        each where it has levels

Places count from the middle of a pocket and from the begin of the centre line of a slot. Lengths in mm, angles in rad.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from functools import partial
from typing import NamedTuple

from mnclab.geometry.contours import Contour
from mnclab.machining.milling import faces
from mnclab.machining.milling.clearing import Clearing
from mnclab.machining.milling.entries import vertical
from mnclab.machining.milling.pocket_steps import (
    Down,
    Room,
    Work,
    finish_floor,
    finish_walls,
    half_circles,
    quarter_circles,
    rough,
    rough_slot,
)
from mnclab.machining.steps import Step

straight = partial(vertical, (0.0, 0.0))


class Pocket(NamedTuple):
    """The shape of a pocket for one tool: the passes that clear it and the room of the tool centre, but for an allowance
    at its walls, and the arcs up to a wall and off it.
    """

    clearing: Callable[[float], Clearing]
    room: Callable[[float], Room]
    arcs: Callable[[Contour, float, int], Sequence[Contour]]


def rectangular(
    length: float, width: float, radius: float, stepover: float, *, corner: float = 0.0, angle: float = 0.0,
    climb: bool = True, begin: int | None = None,
) -> Pocket:  # fmt: skip
    """Rectangles, begun where the axis `begin` (0 the length, 1 the width, None the longer one) leaves them; so do ramps."""
    clearing = partial(
        faces.rectangle, length, width, radius, stepover, corner=corner, angle=angle, climb=climb, begin=begin
    )

    def room(allowance: float) -> Room:
        half = [side / 2 - radius - allowance for side in (length, width)]
        axis = int(half[0] < half[1]) if begin is None else begin
        return Room(min(half), half[axis], angle + (math.pi / 2 if axis else 0.0))

    return Pocket(clearing, room, quarter_circles)


def circular(diameter: float, radius: float, stepover: float, *, climb: bool = True) -> Pocket:
    """Circles; none where the tool fills the pocket."""

    def room(allowance: float) -> Room:
        reach = diameter / 2 - radius - allowance
        return Room(reach, reach)

    return Pocket(partial(faces.circle, diameter, radius, stepover, climb=climb), room, half_circles)


def mill_pocket(
    pocket: Pocket, work: Work, down: Down, to_floor: Down, *, over_walls: float, off_floor: float, end: float | None = None
) -> Iterator[Step]:  # fmt: skip
    """From the middle and back to it; `down` leads from layer to layer, `to_floor` onto the floor.

    The tool lifts to the height `end` after the last layer, if that is given, and comes to the walls at the height
    `over_walls`; it leaves the floor on a quarter circle of the radius `off_floor`.
    """
    room, whole, clear = pocket.room(work.allowance), pocket.clearing(0.0), abs(work.lift)
    if work.layers:
        yield from rough(
            pocket.clearing(work.allowance), work.layers, surface=work.surface, clearance=work.lift, down=down,
            feeds=work.feeds[0], departure=min(clear, room.half_width), side=work.side, end=end,
        )  # fmt: skip
    if work.walls and whole.passes and whole.passes[-1].closed:  # there is a way round
        away = min(work.allowance + clear, pocket.room(0.0).half_width)
        yield from finish_walls(whole.passes[-1], pocket.arcs(whole.passes[-1], away, work.side), work, over_walls)
    yield from finish_floor(whole, work, to_floor, off_floor)


class Slot(NamedTuple):
    """A slot about a centre line of one straight line or arc, or of no length, for a tool of a `radius`."""

    line: Contour
    width: float
    radius: float
    climb: bool = True

    @property
    def is_full(self) -> bool:
        return abs(self.width / 2 - self.radius) <= faces.NOTHING

    def clearing(self, allowance: float, backwards: bool = False) -> Clearing:
        """Along the line and round it, or on circles; along the line alone where the tool just fits, whatever the allowance."""
        line = self.line.reversed() if backwards else self.line
        width, allowance = (2 * self.radius, 0.0) if self.is_full else (self.width, allowance)
        if line.length <= faces.NOTHING:
            return faces.circle(
                width, self.radius, self.radius, allowance=allowance, climb=self.climb, angle=math.pi
            )
        return faces.slot(line, width, self.radius, allowance=allowance, climb=self.climb)


def mill_slot(slot: Slot, work: Work, down: Down) -> Iterator[Step]:
    """From the begin of its line and back to it."""
    if work.layers:
        yield from rough_slot(slot.line, lambda back: slot.clearing(work.allowance, back), work, down)
    if work.walls:
        wall = slot.clearing(0.0, backwards=True).passes[-1]  # begun beyond the first arc
        arcs = half_circles(wall, slot.width / 2 - slot.radius, work.side)
        yield from finish_walls(wall, arcs, work, work.walls[0] + work.lift)
    yield from finish_floor(slot.clearing(0.0), work, straight, 0.0, work.above)
