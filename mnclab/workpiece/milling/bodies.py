"""What of a mill may meet something: its edges, what is above them, the shank, the holder.

Each is a little smaller than it is, by `TOLERANCE` all round, so that a tool that touches a finished wall or floor, a
program that is written in micrometres and a chord of an arc are no collision.
"""

from __future__ import annotations

from typing import NamedTuple

from mnclab.path.tool import Tool
from mnclab.workpiece.milling.cutters import Cutter, cutter_of

TOLERANCE = 0.01  # mm
HOLES = ("drill", "mill", "face mill", "")  # what clears a hole as far up as its edges go


class Body(NamedTuple):
    """A part of a tool: its lower side (smaller than it is), `lift` mm above the tip.

    Within `inner` of the axis the edges have been before, when the tool goes straight down.
    """

    name: str
    cutter: Cutter
    lift: float
    inner: float = 0.0


def edges(tool: Tool) -> Body:
    """What cuts, and all that is as wide above it."""
    radius, flat, corner, slope = cutter_of(tool)
    smaller = max(radius - TOLERANCE, radius / 2)
    corner = max(corner - TOLERANCE, 0.0)
    flat = min(flat, smaller) if slope or corner else smaller
    return Body("tool", Cutter(smaller, flat, min(corner, smaller - flat) if not slope else 0.0, slope), TOLERANCE)


def above_edges(tool: Tool) -> list[Body]:
    """The tool above its edges, where their length is given, and the shank behind."""
    radius, found = tool.effective_radius, []
    thin, begin = tool.shank or (radius, 0.0)
    if tool.cutting_length > 0 and (tool.shank is None or begin > tool.cutting_length):
        inner = 0.0 if tool.kind in HOLES else radius
        found.append(_disc("tool above its edges", radius, tool.cutting_length, inner))
    if tool.shank is not None:
        found.append(_disc("shank", thin, begin, radius))
    return found


def holder(tool: Tool) -> list[Body]:
    """The discs that the holder begins with, from the tip up."""
    return [_disc("holder", radius, begin, tool.effective_radius) for radius, begin in tool.holder]


def bodies_of(tool: Tool) -> list[Body]:
    """All of them, from the tip up."""
    return [edges(tool), *above_edges(tool), *holder(tool)]


def _disc(name: str, radius: float, lift: float, inner: float) -> Body:
    smaller = max(radius - TOLERANCE, radius / 2)
    return Body(name, Cutter(smaller, smaller), lift + TOLERANCE, inner)
