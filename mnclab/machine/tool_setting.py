"""The tool in the spindle moves to the tool setter until it meets it: a plate is touched, a beam is broken.

What moves is the tool as it is (`Setup.true_tools`, else its row of the table): its lower side turned about the axis, or,
where it has single edges and stands, a blade from the axis to the rim for each of them. Where the control takes its tip to be
comes from the length in the table. Steps of a cycle that sets tools name places of the tip in machine coordinates; they run
upright or level. A plate that is met while the tool is only positioned is an alarm.

The first edge faces a setter that stands on the -X side of the tool where the spindle is at 0 degrees, the k-th of n where it
is at (k - 1) 360 / n. A beam has no thickness; what breaks it is the turning tool.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import replace
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from mnclab.machine.probe import Place, Setter
from mnclab.machine.touching import Contact
from mnclab.machining.steps import RAPID, Go, Step, Touch, Write
from mnclab.path.tool import Tool
from mnclab.workpiece.milling.moves import Cutter, cutter_of, edge_height

if TYPE_CHECKING:
    from mnclab.machine.machine import Machine

SETS = "sets tools"  # what such a cycle does (`Cycle.does`)
PLATE, BEAM = "a plate", "a laser beam"
SAME = 1e-9  # mm
FINE = 9  # digits of a measured size: those behind come from arithmetic alone
Pair = tuple[float, float]


class Edge(NamedTuple):
    """The lower side of an edge, by how much it is longer than the tool, and the way it points; None: all round."""

    lower: Cutter
    longer: float = 0.0
    towards: Pair | None = None


class Held(NamedTuple):
    """The tool at a setter: its edges, how far it runs out while it turns, and where its own axis stands while it does not."""

    edges: list[Edge]
    wobble: float
    aside: Pair


def unfit(m: Machine, setter: str) -> Iterator[tuple[str, str]]:
    """Why a cycle that sets tools cannot run: faults without a parameter; `setter` is the kind that it needs, PLATE or BEAM."""
    own = m.setup.setter
    if own is None or bool(own.axis) != (setter == BEAM):
        yield "", f"needs a tool setter, {setter}: Setup(setter=mnclab.Setter(…))"
    if not m.tool.number:
        yield "", "needs a tool in the spindle"
    elif m.tool.kind == "probe":
        yield "", f"needs a tool in the spindle, T{m.tool.number} is a probe"
    if m.side:
        yield "", "cannot run under radius compensation"


def row_of(m: Machine) -> Tool:
    """What the table says of the tool in the spindle."""
    return m.tables.tools.get(m.tool.number, m.tool)


def written(m: Machine, tool: Tool) -> Iterator[Step]:
    """Write the row of the tool in the spindle; that has the new dimensions at once, with the deltas of its call. Nothing
    moves, the tip is elsewhere."""
    row, now = row_of(m), m.tool
    tool = replace(tool, **{name: round(getattr(tool, name), FINE) for name in ("length", "radius", "dl", "dr")})
    yield Write("tools", tool, now.number)
    dl, dr, corner = (getattr(tool, name) + getattr(now, name) - getattr(row, name) for name in ("dl", "dr", "corner"))
    own = replace(tool, dl=dl, dr=dr, corner=min(max(corner, 0.0), tool.radius or corner))
    if own != now:
        yield Write("tool", own, label="new dimensions")


def true_tool(m: Machine) -> Tool:
    """The tool in the spindle as it is."""
    number = m.tool.number
    tables = (m.setup.true_tools, m.setup.tools or {}, m.tables.tools)
    return next((table[number] for table in tables if number in table), m.tool)


def held(m: Machine, tool: Tool, whole: bool) -> Held:
    """How the spindle shows the tool; `whole`: as if it turned."""
    edges, angle = tool.edges or ((0.0, 0.0),), math.radians(m.spindle_angle or 0.0)
    turning = bool(m.turning) or whole
    found = []
    for k, (longer, wider) in enumerate(edges):
        way = math.pi + angle - math.tau * k / len(edges)
        towards = None if turning or not tool.edges else (math.cos(way), math.sin(way))
        found.append(Edge(cutter_of(replace(tool, dr=tool.dr + wider)), longer, towards))
    (x, y), c, s = tool.runout, math.cos(angle), math.sin(angle)
    return Held(found, math.hypot(x, y), (0.0, 0.0)) if turning else Held(found, 0.0, (x * c - y * s, x * s + y * c))


def way_to(m: Machine, setter: Setter, start: Place, direction: Place) -> float | None:
    """How far (mm) the tip goes in a direction, upright or level, until the tool meets the setter; None: it never does.

    Nothing or less than nothing: it has met it already.
    """
    tool = true_tool(m)
    tip = np.array(start) + (0.0, 0.0, m.tool.effective_length - tool.effective_length)
    shown, place = held(m, tool, bool(setter.axis)), np.array(setter.place)
    across = np.array({"": (1.0, 1.0), "X": (0.0, 1.0), "Y": (1.0, 0.0)}[setter.axis])
    from_it = (tip - place)[:2] + shown.aside
    top = place[2] + setter.slope * float(from_it @ (1.0 - across)) if setter.axis else place[2]
    x, y = (from_it * across).tolist()
    u, v = (np.array(direction[:2]) * across).tolist()
    radius, above = setter.radius + shown.wobble, float(tip[2]) - top
    upright = abs(direction[2]) > 0.5
    if upright and direction[2] > 0:
        return None
    meets = falls(shown.edges, (x, y), radius, above) if upright else strikes(shown.edges, (x, y), (u, v), radius, -above)
    way = min(meets, default=None)
    return None if way is None else float(way)


def falls(edges: list[Edge], at: Pair, radius: float, above: float) -> Iterator[float]:
    """How far each edge goes down on a round plate; its axis stands at `at` from the middle of it, its tip so far above."""
    away = math.hypot(*at)
    for lower, longer, towards in edges:
        rho = max(away - radius, 0.0)  # where it meets the plate, from its own axis
        if towards and rho:
            along = at[0] * towards[0] + at[1] * towards[1]
            within = along * along - away * away + radius * radius
            rho = -along - math.sqrt(within) if within >= 0 and along < 0 else math.inf
        if rho <= lower.radius + SAME:
            yield above - longer + float(edge_height(np.array(rho), lower.flat, lower.corner, lower.slope))


def strikes(edges: list[Edge], at: Pair, way: Pair, radius: float, below: float) -> Iterator[float]:
    """How far each edge goes along a level way until it strikes the side of the plate, whose upper side is so far above its
    tip."""
    for lower, longer, towards in edges:
        if below + longer > SAME:
            wide = widest(lower, below + longer)
            x, y, reach = at[0], at[1], radius + wide
            if towards:
                x, y, reach = x + wide * towards[0], y + wide * towards[1], radius
            yield from crossing(x, y, *way, reach)


def crossing(x: float, y: float, u: float, v: float, radius: float) -> Iterator[float]:
    """Where the way from (x, y) along (u, v) comes within a radius of the origin."""
    square, towards = u * u + v * v, x * u + y * v
    rest = towards * towards - square * (x * x + y * y - radius * radius)
    if square > SAME and towards < 0 <= rest:
        yield (-towards - math.sqrt(rest)) / square


def widest(lower: Cutter, height: float) -> float:
    """The greatest radius of a lower side up to a height above its tip."""
    if lower.slope:
        return min(lower.radius, lower.flat + height / lower.slope)
    if height >= lower.corner:
        return lower.radius
    return lower.flat + math.sqrt(lower.corner**2 - (lower.corner - height) ** 2)


def at_setter(m: Machine, step: Go | Touch) -> Contact | None:
    """A step of a cycle that sets tools: a Touch goes on until the setter is met, a Go must not meet a plate."""
    setter = m.setup.setter
    x, y, z = (here if to is None else float(to) for here, to in zip(m.tip, (step.x, step.y, step.z)))
    reach = math.dist(m.tip, (x, y, z))
    direction = ((x - m.tip[0]) / reach, (y - m.tip[1]) / reach, (z - m.tip[2]) / reach) if reach > SAME else (0.0, 0.0, 1.0)
    way = way_to(m, setter, m.tip, direction) if setter else None
    if isinstance(step, Go):
        if way is not None and way < reach - SAME and setter and not setter.axis:
            go(m, _along(m.tip, direction, max(way, 0.0)), step.feed)
            m.alarm("path obstructed: the tool touches the tool setter while positioning", hint=CLEAR)
        go(m, (x, y, z), step.feed)
        return None
    if way is not None and way <= SAME:
        m.alarm("the tool has reached the tool setter before it is measured", hint=HIGHER)
    hit = way is not None and way <= reach + SAME
    end = _along(m.tip, direction, way) if hit and way is not None else (x, y, z)
    go(m, end, step.feed, probing=True)
    if not hit and step.miss == "alarm":
        m.alarm(f"the tool setter did not trigger within {reach:g} mm", hint=SHORTER)
    return Contact(m.programmed, m.tip, hit, m.tip)


CLEAR = "the axes stop there; a larger clearance height helps, or sizes in the tool table nearer to the tool"
HIGHER = "the measurement begins where the tool is free: is its length in the tool table right?"
SHORTER = "a broken tool, or one that is far from its row of the tool table, does not reach it"


def go(m: Machine, tip: Place, feed: float | None, probing: bool = False) -> None:
    """Move the tip to a place in machine coordinates."""
    if probing and feed is not None and feed != RAPID:
        m.probe_to(tip, feed)
    else:
        m.line(*m.to_program(tip), f=feed)


def _along(start: Place, direction: Place, way: float) -> Place:
    x, y, z = (a + way * d for a, d in zip(start, direction))
    return x, y, z
