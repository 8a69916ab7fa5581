"""Approach and departure: APPR and DEP on lines and arcs, to Cartesian and polar points (catalogue: APPR, DEP).

The forms are L or C, a line or an arc; T or N, tangent or square to the contour; LCT, a line and a tangent arc; P before
them means a polar point. Lengths and radii count along the path of the tool centre: LEN of LN comes on top of the tool's
radius, and an arc may be smaller than the tool. A height in the block is reached with the straight line: on the way to the
auxiliary point, and along a departure.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from mnclab.controls.tnc_620.language import motion
from mnclab.controls.tnc_620.language.auxiliary import feed
from mnclab.controls.tnc_620.language.values import above_zero, refuse_on_cylinder
from mnclab.geometry.curves import left
from mnclab.machine.control import FunctionTable, Words
from mnclab.machine.coordinates import NORMALS, PLANES, normal
from mnclab.machine.machine import INF, Machine
from mnclab.path.leads import Lead, way
from mnclab.path.plane import basis
from mnclab.path.toolpath import Kind

FUNCTIONS = FunctionTable()


def positive(m: Machine, words: Words, address: str, meaning: str, most: float = INF) -> float:
    """A length or an angle of the form, as written."""
    if address not in words:
        m.alarm(f"{words.code} needs {address} ({meaning})")
    return above_zero(m, words[address], f"{words.code} {address} ({meaning})", most)


def form(words: Words) -> str:
    """LT, LN, CT or LCT, whether the point is polar or not."""
    return words.code.split()[1].removeprefix("P")


def shape(m: Machine, words: Words) -> Lead:
    """The form of the block with its lengths, for the side of the tool as it is now."""
    lead = Lead(form(words), m.step, m.side * m.orientation)
    if lead.form in ("LT", "LN"):
        return lead._replace(length=motion.scaled(m, positive(m, words, "LEN", "length of the line")))
    if lead.form == "LCT":
        return lead._replace(radius=motion.scaled(m, positive(m, words, "R", "radius of the arc")))
    angle = math.radians(positive(m, words, "CCA", "centre angle of the arc", 360))
    if "R" not in words:
        m.alarm(f"{words.code} needs R (radius of the arc)")
    radius = m.value(words["R"])
    if radius == 0:
        m.alarm(f"{words.code} R (radius of the arc) must not be 0", words["R"])
    return lead._replace(radius=motion.scaled(m, radius), angle=angle)


@FUNCTIONS("APPR LT,", "Approach on a tangent line", takes=f"X Y Z LEN {motion.SIDED}", source="8.12")
@FUNCTIONS("APPR LN,", "Approach on a line square to the contour", takes=f"X Y Z LEN {motion.SIDED}", source="8.12")
@FUNCTIONS("APPR CT,", "Approach on a tangent arc", takes=f"X Y Z CCA R {motion.SIDED}", source="8.12")
@FUNCTIONS("APPR LCT,", "Approach on a line and a tangent arc", takes=f"X Y Z R {motion.SIDED}", source="8.12")
@FUNCTIONS("APPR PLT,", "Approach on a tangent line, polar", takes=f"PR PA X Y Z LEN {motion.SIDED}", source="8.12")
@FUNCTIONS("APPR PLN,", "Approach on a square line, polar", takes=f"PR PA X Y Z LEN {motion.SIDED}", source="8.12")
@FUNCTIONS("APPR PCT,", "Approach on a tangent arc, polar", takes=f"PR PA X Y Z CCA R {motion.SIDED}", source="8.12")
@FUNCTIONS("APPR PLCT,", "Approach on a line and a tangent arc, polar", takes=f"PR PA X Y Z R {motion.SIDED}", source="8.12")
def approach(m: Machine, words: Words) -> None:
    """To the first contour point, compensated from there on; the line to the auxiliary point keeps the feed before."""
    motion.refuse_rapid(m, words)
    before = lead_feed(m)
    f, to = feed(m, words), point(m, words, "the first contour point")
    begin_side(m, words)
    lead = shape(m, words)
    lead = lead._replace(feed=m.feed_of(f) if lead.form == "LCT" else before)
    m.line(**to, f=f, joint=lead)


def lead_feed(m: Machine) -> float:
    """The feed of the line to the auxiliary point: rapid if the block before was, else the feed as it was."""
    kind: Kind | None
    if last := m.recorder.last():
        kind = last[0]
    else:
        settled = (path.kind[path.is_motion] for path in reversed(m.settled))
        kind = next((kinds[-1] for kinds in settled if len(kinds)), None)
    return INF if kind == Kind.RAPID else m.feed_of(None)


def point(m: Machine, words: Words, meaning: str) -> dict[str, Any]:
    """Where an approach ends, or a departure of the form LCT; the height where it is written."""
    to = motion.coordinates(m, words)
    if words.code.split()[1].startswith("P"):
        plane, _ = motion.pole(m, words)
        if plane != m.plane:
            m.alarm(f"{words.code}: the pole CC lies in {plane}, approaches and departures in {m.plane}")
        if inside := next((words[axis] for axis in m.plane if axis in words), None):
            m.alarm(inside.untaken(words.code), inside)
        to |= motion.polar_point(m, words)
    elif not {*m.plane.lower()} <= to.keys():
        m.alarm(f"{words.code} needs {' and '.join(m.plane)} of {meaning}")
    return to


def begin_side(m: Machine, words: Words) -> None:
    """RL or RR; R0 where the form needs no side. What was compensated before ends where the tool stands."""
    given = [words[name] for name in motion.SIDES if name in words]
    if not given and not m.side:
        m.alarm(f"{words.code} needs RL or RR", hint="the side on which the tool runs beside the contour")
    if form(words) in ("LN", "CT") and given and given[0].address == "R0":
        m.alarm(f"{words.code} needs RL or RR: without a side it has no direction", given[0])
    if m.side and not m.recorded_only:
        m.observe()
    motion.side(m, words, begins=True)


@FUNCTIONS("DEP LT,", "Departure on a tangent line", takes="X Y Z LEN R0 F FAUTO FU FZ", source="8.10")
@FUNCTIONS("DEP LN,", "Departure on a line square to the contour", takes="X Y Z LEN R0 F FAUTO FU FZ", source="8.10")
@FUNCTIONS("DEP CT,", "Departure on a tangent arc", takes="X Y Z CCA R R0 F FAUTO FU FZ", source="8.10")
@FUNCTIONS("DEP LCT,", "Departure on a tangent arc and a line", takes="X Y Z R R0 F FAUTO FU FZ G00", source="8.10")
@FUNCTIONS("DEP PLCT,", "Departure on a tangent arc and a line, polar", takes="PR PA X Y Z R R0 F FAUTO FU FZ", source="8.10")
def departure(m: Machine, words: Words) -> None:
    """From the last contour point; at its end the compensation is off (R0 may say so), and the tool stands at the register.

    G00 of DIN/ISO programs: the line behind the arc is at rapid.
    """
    refuse_on_cylinder(m, words)
    f, lead = feed(m, words), shape(m, words)._replace(departs=True)
    if "G00" in words:
        lead = lead._replace(feed=INF)
    if form(words) in ("LN", "CT") and not m.side:
        m.alarm(f"{words.code} needs radius compensation: without a side it has no direction")
    motion.heading(m, words)
    to = last_point(m, words, lead)
    m.change("side", 0)
    m.line(*to, f=f, joint=lead)


def last_point(m: Machine, words: Words, lead: Lead) -> tuple[float, float, float]:
    """Where a departure ends: written for LCT, else where the form leads the tool that touches the contour."""
    if lead.form == "LCT":
        return motion.end(m, point(m, words, "its end"))
    first, second, across = PLANES[m.plane]
    if inside := next((words[axis] for axis in m.plane if axis in words), None):
        m.alarm(inside.untaken(words.code), inside)
    flat = basis(np.array([NORMALS[m.plane] if m.shift is not None else normal(m.matrix, first, second)]))[0]
    here, along = flat @ np.array(m.tip), flat @ np.array(m.heading())  # in the plane as it lies on the part
    place, t = here[:2] + m.radius * lead.side * left(along[:2]), along[:2]
    here[:2] = way(lead._replace(side=-lead.side), place, place, -t).by
    to = list(m.to_program(here @ flat))
    to[across] = motion.end(m, motion.coordinates(m, words))[across]
    return to[0], to[1], to[2]
