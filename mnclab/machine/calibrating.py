"""A touch probe is calibrated: what touches tell of its length, its radius and its offset, and where that is written.

While it calibrates, a cycle sends the spindle axis (`Cycle.does = FEELS`): the offset of the table counts for nothing.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

from mnclab.machine.coordinates import PLANES
from mnclab.machine.tool_axis import tool_axis
from mnclab.machine.touching import Point
from mnclab.machining.probing.sequences import Approach, Steps
from mnclab.machining.steps import Measure, Step, Touch, Write
from mnclab.workpiece.part import Part, box, cylinder, hole

if TYPE_CHECKING:
    from mnclab.machine.machine import Machine
    from mnclab.path.tool import Tool

Pair = Sequence[float]
WALL, DEEP = 10.0, 40.0  # mm, of a figure where nobody gave a part: its wall, and how far it goes down


def ring(m: Machine, radius: float) -> Part:
    """A ring about the place of the tip."""
    (x, y, z), out = m.tip, radius + WALL
    return box((x - out, y - out, z - DEEP), (x + out, y + out, z + WALL)) - hole((x, y, z + WALL), 2 * radius, DEEP + WALL)


def stud(m: Machine, radius: float, top: float) -> Part:
    """A round stud below the tip, up to a height of the machine."""
    x, y, _ = m.tip
    return cylinder((x, y, top - DEEP), (x, y, top), radius)


def plane_of(m: Machine, tip: Point) -> tuple[float, float]:
    """The coordinates of a place of the machine along the axes that the offset counts along."""
    first, second, _ = next(axes for axes in PLANES.values() if axes[2] == tool_axis(m))
    return tip[first], tip[second]


def offset_written(m: Machine, centre: Pair, turned: Pair, touches: Sequence[int] = ()) -> Iterator[Step]:
    """Write the offset of the ball, from the centres of a figure that the spindle axis found (machine coordinates).

    With the spindle at the angle of the probe table it lay off the figure by the offset, and the other way when the spindle was
    turned by 180 degrees (MNC 12.25, TNC 620 17.4).
    """
    probe = m.tables.probe
    x, y = ((b - a) / 2 for a, b in zip(centre, turned, strict=True))
    yield Measure("offset X", x, probe.offset[0], touches=tuple(touches))
    yield Measure("offset Y", y, probe.offset[1], touches=tuple(touches))
    yield Write("probe", replace(probe, offset=(x, y)))


def length_touched(m: Machine, a: Approach, x: float, y: float, surface: float) -> Steps:
    """A touch downwards on a surface whose height is known, and back; writes the length."""
    z = m.programmed[2]
    contact = yield Touch("touch from above", x, y, z - a.reach, a.feed, a.ball)
    yield a.go("back", z)
    found = m.tool.effective_length + m.to_program(contact.tip)[2] - surface
    yield Measure("length", found, m.tool.effective_length, touches=(contact.number,))
    yield from with_length(m, found)


def with_length(m: Machine, length: float) -> Iterator[Step]:
    """Write the length of the probe in the spindle, without a delta: the tip is elsewhere, nothing moves."""
    yield from _written(m, [replace(tool, length=length, dl=0.0) for tool in _both(m)])


def with_radius(m: Machine, radius: float) -> Iterator[Step]:
    """Write the radius of the probe in the spindle, without a delta."""
    yield from _written(m, [tool.of_radius(radius) for tool in _both(m)])


def _both(m: Machine) -> tuple[Tool, Tool]:
    """The row of the table and the tool in the spindle, which may have other deltas."""
    return m.tables.tools.get(m.tool.number, m.tool), m.tool


def _written(m: Machine, tools: Sequence[Tool]) -> Iterator[Step]:
    yield Write("tools", tools[0], m.tool.number)
    yield Write("tool", tools[1], label="calibrated")
