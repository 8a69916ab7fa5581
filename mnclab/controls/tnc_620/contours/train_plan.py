"""The passes of a contour train: the way beside the contour, what leads to it and off it, what a coarser tool has left.

Cycle 270 says side and approach; without it the contour does, by RL and RR, by APPR and DEP.
"""

from __future__ import annotations

from collections.abc import Generator, Iterator
from typing import Any, Protocol

import numpy as np

from mnclab.controls.tnc_620.contours.data import as_they_stand
from mnclab.controls.tnc_620.contours.line import Line
from mnclab.controls.tnc_620.contours.train_data import TrainData
from mnclab.controls.tnc_620.machining.train_passes import Train, leading_off, leading_to
from mnclab.controls.tnc_620.machining.train_rests import rests
from mnclab.controls.tnc_620.machining.trains import Beside, Way, beside, cuts_into
from mnclab.controls.tnc_620.state import memory
from mnclab.geometry.contours import Contour
from mnclab.machine.coordinates import in_mm
from mnclab.machine.flow import RecordedLead
from mnclab.machine.machine import Machine
from mnclab.machining.steps import Say, Step
from mnclab.path.toolpath import PathFault
from mnclab.text.alarm import Alarm, Span

SAME = 1e-6  # mm
LEFT = 5e-4  # mm, the thinnest rest that is told


class Wanted(Protocol):
    """What a cycle of contour trains says; lengths in mm."""

    side_allowance: float
    sense: float
    accepted: float
    connected: float
    extended: float


def trains(
    m: Machine, c: Wanted, line: Line, coarse_radius: float | None, place: Span | None
) -> Generator[Step, Any, tuple[Train, ...]]:
    """The trains along a line in the sense of the cycle; with a coarse tool only where that has left something.

    `place` is where the cycle was called.
    """
    kept = memory(m).train_data
    data = None if kept is None else as_they_stand(m, kept)
    side = line.side if data is None else data.side
    for text in _remarks(c, line, data, side):
        yield Say(text, word=place)
    found = _beside(m, c, line, m.radius, side)
    if found.fault is not None and found.left > LEFT:
        yield _left_standing(found, found.fault, place)
    pieces = found.ways
    if coarse_radius is not None:
        pieces = _after(m, c, line, found.ways, side, coarse_radius)
        if not pieces:
            yield Say(f"finds nothing thicker than Q446 = {c.accepted:g} after the tool of Q18: nothing is machined", word=place)
    planned = [_with_leads(m, line, data, piece, found.ways[0], side) for piece in pieces]
    walls, distance = _walls(m, c, line, side)
    for train in planned:
        _refuse_damage(m, line, train, walls, distance if side else 0.0, place)
    ahead = not c.sense or not side or c.sense * side * m.orientation > 0
    return tuple(train if ahead else train.reversed() for train in planned)


def _remarks(c: Wanted, line: Line, data: TrainData | None, side: int) -> Iterator[str]:
    """What of the program does not count."""
    if data is not None and line.side and line.side != side:
        yield "takes the radius compensation from Q391 of cycle 270: RL or RR of the contour does not count"
    if data is not None and (line.approach or line.departure):
        yield "takes approach and departure from cycle 270: APPR and DEP of the contour do not count"
    if not side and c.side_allowance:
        yield f"runs on the contour without radius compensation: Q3 = {c.side_allowance:g} does not count"
    if not side and c.sense:
        yield "runs on the contour without radius compensation, in its own sense: it is neither climb nor up-cut"


def _beside(m: Machine, c: Wanted, line: Line, radius: float, side: int) -> Beside:
    """The ways of a tool beside the line; an Alarm in the block of the contour where there is none."""
    try:
        return beside(line.contour, radius + c.side_allowance, side, line.heights, line.lines)
    except PathFault as fault:
        message = f"{fault.message}{_with_allowance(c)}"
        raise Alarm(message, _span(m, line, fault), hint=fault.hint) from None


def _with_allowance(c: Wanted) -> str:
    return f" (the allowance Q3 = {c.side_allowance:g} is counted as part of the radius)" if c.side_allowance else ""


def _span(m: Machine, line: Line, fault: PathFault) -> Any:
    """The block of the element at fault."""
    return m.flow.span_of_step(int(line.steps[min(max(fault.step, 0), len(line.steps) - 1)]))


def _left_standing(found: Beside, fault: PathFault, place: Span | None) -> Say:
    """A warning where the tool does not get everywhere."""
    x, y = found.place
    rest = f"leaves material up to {found.left:.3f} mm thick at X{x:.3f} Y{y:.3f}, where the tool has no room"
    return Say(f"{rest}: {fault.message}", fault.hint, place)


def _after(m: Machine, c: Wanted, line: Line, ways: tuple[Way, ...], side: int, radius: float) -> tuple[Way, ...]:
    """The stretches of ways where a coarse tool of a radius has left something; everything where it had no way at all."""
    try:
        coarse = beside(line.contour, radius + c.side_allowance, side, line.heights).ways
    except PathFault:
        return ways
    before = [way.contour for way in coarse]
    return tuple(
        piece
        for way in ways
        for piece in rests(way, m.radius, side, before, radius, c.accepted, c.connected, c.extended)
    )


def _walls(m: Machine, c: Wanted, line: Line, side: int) -> tuple[tuple[Contour, ...], float]:
    """What the tool centre keeps a distance from: the contour, or what is to stand where the tool goes beyond the contour."""
    if (distance := m.radius + c.side_allowance) >= 0:
        return (line.contour,), distance
    return tuple(way.contour for way in _beside(m, c, line, 0.0, side).ways), m.radius


def _with_leads(m: Machine, line: Line, data: TrainData | None, piece: Way, whole: Way, side: int) -> Train:
    """A way with its approach and departure: those of cycle 270, or of the contour at its own ends."""
    if data is not None:
        lead = data.lead(m)
        if lead is None:
            return Train(piece, side=side)
        lead = lead._replace(side=side or 1)
        return Train(piece, leading_to(piece, lead), leading_off(piece, lead), side)
    to = off = None
    if line.approach and np.hypot(*(piece.begin - whole.begin)) <= SAME:
        to = _recorded(m, line.approach, piece)
    if line.departure and np.hypot(*(piece.end - whole.end)) <= SAME:
        off = _recorded(m, line.departure, piece)
    return Train(piece, to, off, side)


def _recorded(m: Machine, recorded: RecordedLead, piece: Way) -> Way:
    """The way of an APPR or DEP block."""
    lead, place = recorded.lead, recorded.place
    span = m.flow.span_of_step(lead.step)
    if lead.form == "LCT" and place is None:
        raise Alarm(f"{lead.name} needs a starting point: a block before it in the contour", span)
    try:
        if lead.departs:
            return leading_off(piece, lead, place)
        return leading_to(piece, lead, place)
    except PathFault as fault:
        raise Alarm(fault.message, span, hint=fault.hint) from None


def _refuse_damage(
    m: Machine, line: Line, train: Train, walls: tuple[Contour, ...], distance: float, place: Span | None
) -> None:  # fmt: skip
    """An Alarm where the ways to the contour or off it, or what is put on at its ends, lead the tool into walls."""
    for way, recorded, name in (
        (train.to, line.approach, "the approach"), (train.off, line.departure, "the departure"),
        (train.along, None, "the extended path"),
    ):  # fmt: skip
        spots = (cuts_into(wall, way, distance) for wall in walls if way is not None and distance)
        if (spot := next(filter(None, spots), None)) is not None:
            span = place if recorded is None else m.flow.span_of_step(recorded.lead.step)
            message = f"{name} leads the tool into the contour at X{spot[0]:.3f} Y{spot[1]:.3f}"
            hint = "take another approach, a smaller radius or a shorter distance"
            raise Alarm(in_mm(message, m.variable_unit), span, hint=hint)
