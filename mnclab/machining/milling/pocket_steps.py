"""Milling a pocket step by step: ways in, feeds at the cutting edge, the floor and the walls."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from functools import partial
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from mnclab.geometry.contours import QUARTER, Contour
from mnclab.geometry.curves import Floats, cross, left
from mnclab.machining.milling import faces
from mnclab.machining.milling.clearing import Clearing, begin, end, numbered
from mnclab.machining.milling.entries import Descent, Entry, descend, helix, pendulum, vertical
from mnclab.machining.steps import Along, Go, Step

# Feeds that count at the cutting edge, for a path of the tool centre. Lengths in mm, feeds in mm/min.
#     inside an arc of the wall     F · r / (r + R)        outside of one     F · r / (r - R)
# r is the radius of the path, R that of the tool, and r ± R the radius of the wall. On a straight line both are the same.

SAME = 1e-9


def centre_feeds(contour: Contour, feed: float, radius: float, wall: int) -> Floats:
    """Feeds of the tool centre on the m elements `(m,)`, the wall being on the right of the way (1) or on its left (-1).

    Raises ValueError where the wall turns about a point: no centre is fast enough there.
    """
    path, inside = contour.radii, np.sign(contour.sweeps) * wall
    edge = path + inside * radius
    if (edge <= SAME).any():
        raise ValueError(f"the wall has no radius where a tool of radius {radius:g} goes round it at {path.min():g}")
    with np.errstate(invalid="ignore"):
        return np.where(inside == 0, feed, feed * path / edge)


def along(label: str, contour: Contour, feed: float | None, radius: float = 0.0, wall: int = 1) -> Iterator[Along]:
    """Along a contour; with the `radius` of the tool its feed counts at the edge, and each piece has its own."""
    if not radius or feed is None or not contour.bulge.any():
        yield Along(label, contour, feed)
        return
    feeds = centre_feeds(contour, feed, radius, wall)
    if np.ptp(feeds) <= SAME * feed:
        yield Along(label, contour, float(feeds[0]))
        return
    points = np.vstack([contour.points, contour.points[:1]]) if contour.closed else contour.points
    begins = np.flatnonzero(np.append(True, np.abs(np.diff(feeds)) > SAME * feed))
    for first, after in zip(begins.tolist(), [*begins[1:].tolist(), len(feeds)], strict=True):
        piece = Contour(points[first : after + 1], np.append(contour.bulge[first:after], 0.0), closed=False)
        yield Along(label, piece, float(feeds[first]))


# Finishing along walls: up to the wall on an arc that touches it, once round, and off on another. Lengths in mm.
#         p                 the quarter circles have their centre at p + r·n, n being the unit normal away from
# ────────┬────────►        the wall; the tool comes from p + r·n - r·t and leaves for p + r·n + r·t
#       ╱   ╲               (t: the direction of travel at p)

LEAST = 1e-6  # mm, of an arc up to a wall or off it


def approaching(contour: Contour, radius: float, side: int) -> Contour:
    """The quarter circle by which a tool comes to a closed pass; it lies on its left (`side` 1) or right (-1)."""
    ahead, wall = contour.tangents()[0][0], contour.points[0]
    return Contour([wall + radius * (side * left(ahead) - ahead), wall], [side * QUARTER, 0.0], closed=False)


def leaving(contour: Contour, radius: float, side: int) -> Contour:
    """The quarter circle by which a tool leaves the wall after a closed pass."""
    away, here = contour.tangents()[1][-1], end(contour)
    return Contour([here, here + radius * (side * left(away) + away)], [side * QUARTER, 0.0], closed=False)


def quarter_circles(contour: Contour, radius: float, side: int) -> tuple[Contour, ...]:
    """The ways up to a wall and off it on quarter circles of a radius; none for a radius of 0."""
    return (approaching(contour, radius, side), leaving(contour, radius, side)) if radius > LEAST else ()


def half_circles(contour: Contour, diameter: float, side: int) -> tuple[Contour, ...]:
    """The ways up to a wall and off it on half circles: both from and to the place that is a `diameter` away from it."""
    if not diameter > LEAST:
        return ()
    ahead, wall = contour.tangents()[0][0], contour.points[0]
    to = Contour([wall + diameter * side * left(ahead), wall], [float(side), 0.0], closed=False)
    return to, outwards(contour, diameter, side)


def onto(place: ArrayLike, contour: Contour) -> Contour | None:
    """The arc, however long, from a place to the begin of a pass that touches it there; None for a place on the pass."""
    ahead = contour.tangents()[0][0]
    chord = contour.points[0] - np.asarray(place, dtype=float)
    if np.hypot(*chord) <= LEAST:
        return None
    turn = math.atan2(float(cross(chord, ahead)), float(chord @ ahead))
    return Contour([place, contour.points[0]], [math.tan(turn / 2), 0.0], closed=False)


def outwards(contour: Contour, diameter: float, side: int) -> Contour:
    """The half circle that touches the end of a pass and leads as far to its left (`side` 1) or right (-1)."""
    away, here = contour.tangents()[1][-1], end(contour)
    return Contour([here, here + diameter * side * left(away)], [float(side), 0.0], closed=False)


# Milling a pocket step by step: down, outwards on its passes, off the wall, layer by layer; then its walls and its floor.
# x and y count from the middle of the pocket, where the tool begins and where it comes back to; the clearance lies above the
# level that is being cut, as everything above it has gone already. Lengths in mm, feeds in mm/min, angles in rad.
#     rough     ↓ ○ ◯ ⬭ (quarter circle off the wall) ↑ to the middle         for each layer
#     walls     ↓ beside the wall, a quarter circle to it, round, off, ↑       for each infeed
#     floor     ↓ ○ ◯ ⬭ along the finished wall                                once

Down = Callable[[float, float], Descent]


class Room(NamedTuple):
    """Where the tool centre may go: from the middle to the nearer walls, to the farther ones, and the way to these (rad)."""

    half_width: float
    half_length: float
    direction: float = 0.0


class LevelFeeds(NamedTuple):
    """Feeds on a level and down to it; None is the one that is active. With `edge`, the tool radius, closed ones count there."""

    level: float | None
    plunge: float | None
    edge: float = 0.0


class PocketWork(NamedTuple):
    """What is done to a figure: levels and feeds of each part, none where it is left out; `side` 1 is climb milling.

    Roughing leaves the `allowance` at the side and ends, as the walls do, at `left_over`. The tool clears what it has cut
    by `lift` (negative where it works upwards), and the figure at the height `above`.
    """

    surface: float
    left_over: float
    above: float
    lift: float
    allowance: float
    layers: tuple[float, ...]
    walls: tuple[float, ...]
    floor: tuple[float, ...]
    feeds: tuple[LevelFeeds, LevelFeeds, LevelFeeds]
    side: int

    @property
    def is_nothing(self) -> bool:
        return not (self.layers or self.walls or self.floor)


def way_down(entry: Entry, room: Room, radius: float, climb: bool, top: float, bottom: float) -> Descent:
    """Down in the middle of a pocket with a tool of a `radius`.

    A helix is as wide as the tool radius, or as the room; a ramp swings along the pocket, or does not fit: ValueError.
    """
    middle = (0.0, 0.0)
    if entry.kind == "vertical" or entry.angle == 90:
        return vertical(middle, top, bottom)
    if entry.kind == "helix":
        wish = min(radius if entry.size is None else entry.size, room.half_width)
        return helix(middle, wish, top, bottom, entry.angle, start=room.direction, clockwise=not climb)
    least = 4 * radius if entry.size is None else entry.size
    return pendulum(middle, room.direction, top, bottom, entry.angle, least=least, room=2 * room.half_length)


def rough(
    clearing: Clearing, levels: Sequence[float], *, surface: float, clearance: float, down: Down, feeds: LevelFeeds,
    departure: float, side: int, end: float | None = None,
) -> Iterator[Step]:  # fmt: skip
    """Every layer, off the wall on a radius `departure` (`side` 1: to its left), and up, at last to the height `end` if given."""
    top = surface
    for name, level in zip(numbered("layer", len(levels)), levels, strict=True):
        yield from clear(name, clearing, down(top, level), feeds, departure, side)
        yield from _back(name, level + clearance if end is None or level != levels[-1] else end)
        top = level


def rough_slot(line: Contour, passes: Callable[[bool], Clearing], work: PocketWork, down: Down) -> Iterator[Step]:
    """Every layer of a slot about its centre line, which begins at (0, 0); after each the tool leaves the slot.

    `passes` clear it from the line outwards, which is followed from the end where the way down has led: backwards or not.
    """
    top = work.surface
    for name, level in zip(numbered("layer", len(work.layers)), work.layers, strict=True):
        way = down(top, level)
        here = way.contour.points[-1]
        back = math.dist(here, line.points[-1]) < math.dist(here, line.points[0])
        yield Go(f"{name}, to the clearance level", top + work.lift)
        yield from clear(name, passes(back), way, work.feeds[0], 0.0, work.side, middle=False)
        yield from _back(name, work.above)
        top = level


def finish_walls(wall: Contour, arcs: Sequence[Contour], work: PocketWork, above: float) -> Iterator[Step]:
    """Round the wall on every level: up to it and off it on two arcs, if there are any; at first to the height `above`."""
    (_, feeds, _), side = work.feeds, work.side
    x, y = begin(arcs[0] if arcs else wall).tolist()
    yield Go("side finishing, to the clearance level", above)
    for name, level in zip(numbered("side finishing", len(work.walls)), work.walls, strict=True):
        yield Go(f"{name}, over the start", x=x, y=y)
        yield Go(f"{name}, down", level, feeds.plunge)
        names = (f"{name}, to the wall", name, f"{name}, off the wall") if arcs else (name,)
        for label, way in zip(names, (*arcs[:1], wall, *arcs[1:]), strict=True):
            yield from along(label, way, feeds.level, feeds.edge, side)
        yield from _back(name, level + work.lift)


def finish_floor(
    clearing: Clearing, work: PocketWork, down: Down, departure: float, end: float | None = None
) -> Iterator[Step]:
    """From what roughing has left to the floor, outwards, along the finished wall, and up, to the height `end` if given."""
    name = "floor finishing"
    for level in work.floor:
        yield Go(f"{name}, to the clearance level", work.left_over + work.lift)
        yield from clear(name, clearing, down(work.left_over, level), work.feeds[2], departure, work.side)
        yield from _back(name, level + work.lift if end is None else end)


def clear(
    name: str, clearing: Clearing, down: Descent, feeds: LevelFeeds, departure: float, side: int, *, middle: bool = True
) -> Iterator[Step]:
    """Down, over all passes and off the last one, at feed throughout; by way of the `middle` if so wished."""
    if len(down.heights) > 2:
        yield Go(f"{name}, down to what is cut", float(down.heights[0]), feeds.plunge)
        x, y = begin(down.contour).tolist()
        yield Go(f"{name}, to the {down.label}", None, feeds.level, x, y)
    yield from descend(down._replace(label=f"{name}, {down.label}"), feeds.plunge, feeds.level)
    if middle:
        yield Go(f"{name}, to the centre", None, feeds.level, 0.0, 0.0)
    for label, contour in zip(clearing.labels, clearing.passes, strict=True):
        x, y = begin(contour).tolist()
        yield Go(f"{name}, link", None, feeds.level, x, y)
        yield from along(f"{name}, {label}", contour, feeds.level, feeds.edge if contour.closed else 0.0, side)
    if clearing.passes and clearing.passes[-1].closed and departure > LEAST:
        off = leaving(clearing.passes[-1], departure, side)
        yield from along(f"{name}, off the wall", off, feeds.level, feeds.edge, side)


def _back(name: str, height: float) -> Iterator[Step]:
    yield Go(f"{name}, lift", height)
    yield Go(f"{name}, to the centre", x=0.0, y=0.0)


# Pockets and slots of simple shape: a shape is what differs between them, and what is done to it is the same for all.
#
#     roughing in layers  ─►  the wall in infeeds  ─►  the floor at once        each where it has levels
#
# Places count from the middle of a pocket and from the begin of the centre line of a slot. Lengths in mm, angles in rad.

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
    pocket: Pocket, work: PocketWork, down: Down, to_floor: Down, *, over_walls: float, off_floor: float, end: float | None = None
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


def mill_slot(slot: Slot, work: PocketWork, down: Down) -> Iterator[Step]:
    """From the begin of its line and back to it."""
    if work.layers:
        yield from rough_slot(slot.line, lambda back: slot.clearing(work.allowance, back), work, down)
    if work.walls:
        wall = slot.clearing(0.0, backwards=True).passes[-1]  # begun beyond the first arc
        arcs = half_circles(wall, slot.width / 2 - slot.radius, work.side)
        yield from finish_walls(wall, arcs, work, work.walls[0] + work.lift)
    yield from finish_floor(slot.clearing(0.0), work, straight, 0.0, work.above)
