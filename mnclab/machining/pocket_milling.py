"""Milling a pocket step by step: down, outwards on its passes, off the wall, layer by layer; then its walls and its floor.

x and y count from the middle of the pocket, where the tool begins and where it comes back to; the clearance lies above the
level that is being cut, as everything above it has gone already. Lengths in mm, feeds in mm/min, angles in rad.

    rough     ↓ ○ ◯ ⬭ (quarter circle off the wall) ↑ to the middle         for each layer
    walls     ↓ beside the wall, a quarter circle to it, round, off, ↑       for each infeed
    floor     ↓ ○ ◯ ⬭ along the finished wall                                once

Which of them run, how deep and how fast is the cycle's affair.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from typing import NamedTuple

from mnclab.geometry.contours import Contour
from mnclab.machining.clearing import Clearing, begin, numbered
from mnclab.machining.entries import Descent, Entry, descend, helix, pendulum, vertical
from mnclab.machining.finishing import approaching, leaving
from mnclab.machining.steps import Along, Go, Step

Down = Callable[[float, float], Descent]
LEAST = 1e-6  # mm, of an arc up to a wall or off it


class Room(NamedTuple):
    """Where the tool centre may go: from the middle to the nearer walls, to the farther ones, and the way to these (rad)."""

    half_width: float
    half_length: float
    direction: float = 0.0


class Feeds(NamedTuple):
    """Feeds on a level and down to it; None is the one that is active."""

    level: float | None
    plunge: float | None


def way_down(entry: Entry, room: Room, radius: float, climb: bool, top: float, bottom: float) -> Descent:
    """Down in the middle of a pocket with a tool of a `radius`.

    A helix is as wide as the tool radius, or as the room; a ramp swings along the pocket. Raises ValueError where there
    is no room for it.
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
    clearing: Clearing, levels: Sequence[float], *, surface: float, clearance: float, down: Down, feeds: Feeds,
    departure: float, side: int,
) -> Iterator[Step]:  # fmt: skip
    """Every layer from the `surface` down; `departure` is the radius off the wall, on the left of it for `side` 1."""
    top = surface
    for name, level in zip(numbered("layer", len(levels)), levels, strict=True):
        yield from _clear(name, clearing, down(top, level), feeds, departure, side)
        yield from _back(name, level + clearance)
        top = level


def finish_walls(
    wall: Contour, levels: Sequence[float], *, above: float, clearance: float, feeds: Feeds, approach: float, side: int
) -> Iterator[Step]:
    """Round the wall on every level: up to it and off it on quarter circles of the radius `approach`."""
    arcs = [approaching(wall, approach, side), leaving(wall, approach, side)] if approach > LEAST else []
    x, y = begin(arcs[0] if arcs else wall).tolist()
    yield Go("side finishing, to the clearance level", above)
    for name, level in zip(numbered("side finishing", len(levels)), levels, strict=True):
        yield Go(f"{name}, over the start", x=x, y=y)
        yield Go(f"{name}, down", level, feeds.plunge)
        if arcs:
            yield Along(f"{name}, to the wall", arcs[0], feeds.level)
        yield Along(name, wall, feeds.level)
        if arcs:
            yield Along(f"{name}, off the wall", arcs[1], feeds.level)
        yield from _back(name, level + clearance)


def finish_floor(
    clearing: Clearing, level: float, *, top: float, clearance: float, down: Down, feeds: Feeds, departure: float, side: int
) -> Iterator[Step]:  # fmt: skip
    """From `top`, what roughing has left, to the floor; then outwards, the last round along the finished wall."""
    name = "floor finishing"
    yield Go(f"{name}, to the clearance level", top + clearance)
    yield from _clear(name, clearing, down(top, level), feeds, departure, side)
    yield from _back(name, level + clearance)


# ---- beneath ----


def _clear(
    name: str, clearing: Clearing, down: Descent, feeds: Feeds, departure: float, side: int
) -> Iterator[Step]:  # fmt: skip
    """Down, over all passes and off the last one, at feed throughout."""
    if len(down.heights) > 2:
        yield Go(f"{name}, down to what is cut", float(down.heights[0]), feeds.plunge)
        x, y = begin(down.contour).tolist()
        yield Go(f"{name}, to the {down.label}", None, feeds.level, x, y)
    yield from descend(down._replace(label=f"{name}, {down.label}"), feeds.plunge, feeds.level)
    yield Go(f"{name}, to the centre", None, feeds.level, 0.0, 0.0)
    for label, contour in zip(clearing.labels, clearing.passes, strict=True):
        x, y = begin(contour).tolist()
        yield Go(f"{name}, link", None, feeds.level, x, y)
        yield Along(f"{name}, {label}", contour, feeds.level)
    if clearing.passes and clearing.passes[-1].closed and departure > LEAST:
        yield Along(f"{name}, off the wall", leaving(clearing.passes[-1], departure, side), feeds.level)


def _back(name: str, height: float) -> Iterator[Step]:
    yield Go(f"{name}, lift", height)
    yield Go(f"{name}, to the centre", x=0.0, y=0.0)
