"""Arcs of a machine and what they must be: a radius that reaches, a centre as far from the end as from the start.

And turns about a centre, which have no such faults.

Points are pairs in mm in the axes of the plane.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import TYPE_CHECKING

from mnclab.geometry.arcs import centre_of_one, sweep_of_one
from mnclab.machine.coordinates import PLANES
from mnclab.machine.state import Place
from mnclab.path.kinds import Kind
from mnclab.path.listing import INCHES, MM, Unit
from mnclab.text.program import Word

if TYPE_CHECKING:
    from mnclab.machine.machine import Machine

Point = tuple[float, float]


def check_start(m: Machine, tolerance: float = 0.01, word: Word | None = None) -> None:
    """An Alarm when the register is not where the tool stands: an arc could not begin there."""
    if (away := math.dist(m.to_machine(m.programmed), m.tip)) > tolerance:
        unit = told_in(m)
        begins = f"the arc begins {away / unit.length:.{unit.decimals}f} {unit.short} away from the tool"
        fault = f"{begins}: a transformation was switched after the last move"
        m.alarm(fault, word, hint="lead the tool to the start of the arc by a straight move first")


def centre_by_radius(
    m: Machine, s: Point, e: Point, radius: float, sense: int, tolerance: float, word: Word | None
) -> Point:
    """The centre of the arc of a signed radius; an Alarm when the radius does not reach, and by how much."""
    if math.dist(s, e) < 1e-3:
        m.alarm("a full circle cannot be given by its radius", word, hint="write the centre with I J K")
    c, shortage = centre_of_one(s, e, radius, sense)
    if shortage > tolerance:
        unit, short = told_in(m).length, told_in(m).short
        half, address = (shortage + abs(radius)) / unit, word.address if word else "R"
        between = f"the distance {2 * half:.7g} {short} between start and end: at least {half:.7g} {short} is needed"
        hint = f"too short by {shortage / unit:.4g} {short}"
        m.alarm(f"{address}{abs(radius) / unit:g} is too small for {between}", word, hint)
    return c


def check_radii(m: Machine, s: Point, e: Point, c: Point, tolerance: float, word: Word | None) -> None:
    """An Alarm when the centre lies on the start, or the end not on the circle about it."""
    at_start, at_end = math.dist(s, c), math.dist(e, c)
    if at_start < 1e-9:
        m.alarm("the centre of the arc lies on its start", word)
    if abs(at_start - at_end) > tolerance:
        unit = told_in(m)
        there, here = (f"{each / unit.length:.{unit.decimals}f}" for each in (at_start, at_end))
        allowed = f"allowed difference {tolerance / unit.length:.4g} {unit.short}"
        m.alarm(f"the end point is not on the circle: radius {there} at the start, {here} at the end, {allowed}", word)


def told_in(m: Machine) -> Unit:
    """In what the lengths of this program are told."""
    return MM if m.variable_unit == 1 else INCHES


def arc(
    m: Machine, point: Place, sense: int, centre: Mapping[int, float] | None, radius: float | None, feed: float,
    word: Word | None, tolerance: float, turns: int = 1,
) -> None:  # fmt: skip
    """An arc of the active plane to a point, by its centre or by a signed radius, in so many turns."""
    check_start(m, tolerance, word)
    first, second, _ = PLANES[m.plane]
    here, given = m.programmed, centre or {}
    s, e = (here[first], here[second]), (point[first], point[second])
    if radius is not None:
        c = centre_by_radius(m, s, e, radius, sense, tolerance, word)
    else:
        c = (given.get(first, s[0]), given.get(second, s[1]))
        check_radii(m, s, e, c, tolerance, word)
    angle = (sweep_of_one(s, e, c, sense) + math.tau * sense * (turns - 1)) * on_machine(m, word)
    middle = list(here)
    middle[first], middle[second] = c
    tip = m.to_machine(point)
    m.add_row(Kind.ARC, tip, m.to_machine(middle), angle, feed)
    m.programmed, m.tip = point, tip


def on_machine(m: Machine, word: Word | None = None) -> int:
    """-1 where the frame turns arcs over, else 1; an alarm when it would turn the circle into an ellipse."""
    if m.shift is None and not m.keeps_circles:
        m.alarm("an arc under unequal scales of its plane would be an ellipse", word)
    return m.orientation


def turn(m: Machine, centre: Point, angle: float, level: float | None = None, f: float | None = None) -> None:
    """Round a point of the plane by an angle (rad, any number of turns), to a level along its normal.

    A whole turn ends where it began.
    """
    first, second, normal = PLANES[m.plane]
    feed, sense = m.feed_of(f), on_machine(m)
    check_start(m)
    point, middle = list(m.programmed), list(m.programmed)
    middle[first], middle[second] = centre
    u, v = point[first] - centre[0], point[second] - centre[1]
    if abs(rest := math.remainder(angle, 2 * math.pi)) > 1e-12:
        c, s = math.cos(rest), math.sin(rest)
        point[first], point[second] = centre[0] + c * u - s * v, centre[1] + s * u + c * v
    if level is not None:
        point[normal] = level
    x, y, z = point
    m.add_row(Kind.ARC, m.to_machine(point), m.to_machine(middle), angle * sense, feed)
    m.programmed, m.tip = (x, y, z), m.to_machine(point)
