"""Contour trains: cycles 25, 270 and 276, along an open or closed contour."""

from __future__ import annotations

import math
from collections.abc import Generator, Iterator
from typing import Any, Protocol, TypeAlias

import numpy as np

from mnclab.controls.tnc_620.contours.area import as_they_stand
from mnclab.controls.tnc_620.contours.line import (
    ContourLine,
    Named,
    contour_line,
    in_table,
    leave,
    named_tool,
    with_labels,
)
from mnclab.controls.tnc_620.cycles import addresses
from mnclab.controls.tnc_620.cycles.addresses import FAR, choice, coordinate, count, increment, length
from mnclab.controls.tnc_620.cycles.planes import SAME, ParameterFault, in_program_coordinates, not_zero, with_radius
from mnclab.controls.tnc_620.machining.train_passes import Feeds, leading_off, leading_to, mill
from mnclab.controls.tnc_620.machining.train_passes import Train as Passes
from mnclab.controls.tnc_620.machining.trains import Beside, SpaceWay, beside, cuts_into, rests
from mnclab.controls.tnc_620.state import memory
from mnclab.geometry.contours import Contour
from mnclab.machine.coordinates import MILLS, in_mm
from mnclab.machine.cycle import Cycle, CycleTable, param, too_many
from mnclab.machine.flow import RecordedLead
from mnclab.machine.machine import INF, Machine
from mnclab.machining.depths import infeeds
from mnclab.machining.steps import Say, Step, Write
from mnclab.path.leads import Lead
from mnclab.path.toolpath import PathFault
from mnclab.text.alarm import Alarm, Span

# Cycle 270: how contour trains are approached and left, and on which side the tool runs (8.11).

CYCLES = CycleTable()
APPROACH: dict[float, str] = {1: "tangential, on an arc", 2: "tangential, on a line", 3: "at a right angle"}
SIDES: dict[float, str] = {0: "R0, on the contour", 1: "RL, to the left", 2: "RR, to the right"}


@CYCLES("CYCL DEF 270", "Contour train data", runs="definition", source="8.11")
class TrainData(Cycle):
    """Approach, departure and side for the cycles 25 and 276 that follow; no motion."""

    approach: float = choice("Q390", "type of approach", APPROACH, example=1)
    compensation: float = choice("Q391", "radius compensation", SIDES, example=1)
    radius: float = length("Q392", "radius of the arc", note="where Q390 is 1", example=3)
    angle: float = param("Q393", "centre angle of the arc", "deg", modal=True, at_least=0, at_most=99999.9999, example=45)
    distance: float = length("Q394", "distance of the auxiliary point", note="where Q390 is 2 or 3", example=2)

    def contradictions(self) -> Iterator[ParameterFault]:
        if self.approach == 1 and self.radius == 0:
            yield "radius", "must be greater than 0 for an approach on an arc, got 0"
        if self.approach == 1 and not 0 < self.angle <= 360:
            yield "angle", f"must be greater than 0 and at most 360, got {self.angle:g}"

    def moves(self, m: Machine) -> Iterator[Step]:
        """Keep the data; they are read again when a cycle is called, since Q parameters may have changed."""
        yield Write("memory", self, "train_data")

    @property
    def side(self) -> int:
        """+1 left, -1 right, 0 on the contour."""
        return {0: 0, 1: 1, 2: -1}[int(self.compensation)]

    def lead(self, m: Machine) -> Lead | None:
        """How the tool gets to the contour; without a side it comes from the left (none for a line of no length)."""
        form = {1: "CT", 2: "LT", 3: "LN"}[int(self.approach)]
        if form != "CT" and not self.distance:
            return None
        return Lead(form, m.step, self.side or 1, self.distance, self.radius, math.radians(self.angle))


# The passes of a contour train: the way beside the contour, what leads to it and off it, what a coarser tool has left.
# Cycle 270 says side and approach; without it the contour does, by RL and RR, by APPR and DEP.

SpaceWays: TypeAlias = tuple[SpaceWay, ...]
SAME_PLACE = 1e-6  # mm
LEFT = 5e-4  # mm, the thinnest rest that is told


class Wanted(Protocol):
    """What a cycle of contour trains says; lengths in mm."""

    side_allowance: float
    sense: float
    accepted: float
    connected: float
    extended: float


def trains(
    m: Machine, c: Wanted, line: ContourLine, coarse_radius: float | None, place: Span | None
) -> Generator[Step, Any, tuple[Passes, ...]]:
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


def _remarks(c: Wanted, line: ContourLine, data: TrainData | None, side: int) -> Iterator[str]:
    """What of the program does not count."""
    if data is not None and line.side and line.side != side:
        yield "takes the radius compensation from Q391 of cycle 270: RL or RR of the contour does not count"
    if data is not None and (line.approach or line.departure):
        yield "takes approach and departure from cycle 270: APPR and DEP of the contour do not count"
    if not side and c.side_allowance:
        yield f"runs on the contour without radius compensation: Q3 = {c.side_allowance:g} does not count"
    if not side and c.sense:
        yield "runs on the contour without radius compensation, in its own sense: it is neither climb nor up-cut"


def _beside(m: Machine, c: Wanted, line: ContourLine, radius: float, side: int) -> Beside:
    """The ways of a tool beside the line; an Alarm in the block of the contour where there is none."""
    try:
        return beside(line.contour, radius + c.side_allowance, side, line.heights, line.lines)
    except PathFault as fault:
        message = f"{fault.message}{_with_allowance(c)}"
        raise Alarm(message, _span(m, line, fault), hint=fault.hint) from None


def _with_allowance(c: Wanted) -> str:
    return f" (the allowance Q3 = {c.side_allowance:g} is counted as part of the radius)" if c.side_allowance else ""


def _span(m: Machine, line: ContourLine, fault: PathFault) -> Any:
    """The block of the element at fault."""
    return m.flow.span_of_step(int(line.steps[min(max(fault.step, 0), len(line.steps) - 1)]))


def _left_standing(found: Beside, fault: PathFault, place: Span | None) -> Say:
    """A warning where the tool does not get everywhere."""
    x, y = found.place
    rest = f"leaves material up to {found.left:.3f} mm thick at X{x:.3f} Y{y:.3f}, where the tool has no room"
    return Say(f"{rest}: {fault.message}", fault.hint, place)


def _after(m: Machine, c: Wanted, line: ContourLine, ways: SpaceWays, side: int, radius: float) -> SpaceWays:
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


def _walls(m: Machine, c: Wanted, line: ContourLine, side: int) -> tuple[tuple[Contour, ...], float]:
    """What the tool centre keeps a distance from: the contour, or what is to stand where the tool goes beyond the contour."""
    if (distance := m.radius + c.side_allowance) >= 0:
        return (line.contour,), distance
    return tuple(way.contour for way in _beside(m, c, line, 0.0, side).ways), m.radius


def _with_leads(m: Machine, line: ContourLine, data: TrainData | None, piece: SpaceWay, whole: SpaceWay, side: int) -> Passes:
    """A way with its approach and departure: those of cycle 270, or of the contour at its own ends."""
    if data is not None:
        lead = data.lead(m)
        if lead is None:
            return Passes(piece, side=side)
        lead = lead._replace(side=side or 1)
        return Passes(piece, leading_to(piece, lead), leading_off(piece, lead), side)
    to = off = None
    if line.approach and np.hypot(*(piece.begin - whole.begin)) <= SAME_PLACE:
        to = _recorded(m, line.approach, piece)
    if line.departure and np.hypot(*(piece.end - whole.end)) <= SAME_PLACE:
        off = _recorded(m, line.departure, piece)
    return Passes(piece, to, off, side)


def _recorded(m: Machine, recorded: RecordedLead, piece: SpaceWay) -> SpaceWay:
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
    m: Machine, line: ContourLine, train: Passes, walls: tuple[Contour, ...], distance: float, place: Span | None
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


# Cycles 25 and 276: contour trains, along an open or closed contour in the plane or in space (8.9, 8.10).
# `tnc_620/machining/trains.py` finds the way beside the contour, and `train_passes.py` the passes.

SENSE: dict[float, str] = {1: "climb", -1: "up-cut", 0: "to and fro, infeeds at both ends"}
SHARED = "height infeed plunge_feed feed sense coarse_tool accepted connected extended"
CLEAR = 2.0  # mm above the surface, to which the tool goes down at rapid (the manual names no set-up clearance)


class Train(Cycle):
    """What both cycles share."""

    does = MILLS
    about = in_program_coordinates
    depth: float = increment("Q1", "milling depth from the surface to the floor", example=-20)
    side_allowance: float = increment("Q3", "finishing allowance for side", example=0)
    height: float = coordinate("Q7", "clearance height", example=50)
    infeed: float = increment("Q10", "infeed per cut", example=10)
    plunge_feed: float = addresses.feed("Q11", "feed rate for plunging", also=addresses.PLANE, at_most=FAR, example=100)
    feed: float = addresses.feed("Q12", "feed rate for roughing", also=addresses.PLANE, at_most=FAR, example=350)
    sense: float = choice("Q15", "climb or up-cut milling", SENSE, example=1)
    coarse_tool: Named = count(("Q18", "QS18"), "coarse roughing tool", type="text", default=0)
    accepted: float = length("Q446", "accepted residual material", at_least=0.001, at_most=9.999, default=0.01)
    connected: float = length("Q447", "connection distance", at_most=999.9999, default=10)
    extended: float = length("Q448", "path extension", at_most=99.999, default=2)

    def check(self, m: Machine) -> Iterator[ParameterFault]:
        yield from with_labels(m)
        yield from with_radius(m)
        yield from not_zero(self, "plunge_feed", "feed")
        if self.depth and not self.infeed:
            yield "infeed", "must not be 0"
        yield from too_many("infeed", lambda: self.levels(0.0))
        if self.coarse_tool:
            yield from in_table(self, m, "coarse_tool")
            if (radius := self.coarse_radius(m)) is not None and radius <= m.radius:
                yield "coarse_tool", f"must be larger than the tool, whose radius is {m.radius:g}, got {radius:g}"

    def coarse_radius(self, m: Machine) -> float | None:
        """The radius of the coarse tool in lengths of the program; None without one."""
        tool = named_tool(m, self.coarse_tool) if self.coarse_tool else None
        return None if tool is None else tool.effective_radius / m.scale

    def levels(self, surface: float) -> tuple[float, ...]:
        """The levels from the surface to the floor."""
        return infeeds(surface, surface + self.depth, abs(self.infeed))

    def feeds(self, m: Machine, surface: float) -> Feeds:
        """The feeds, with M109 or M110 at the cutting edge, and how far down the tool goes at rapid above what it cuts."""
        edge = m.feed_rules[-1].edge if m.feed_rules else ""
        return Feeds(self.plunge_feed, self.feed, self.height, surface + CLEAR if self.depth < 0 else INF, edge, m.radius)


@CYCLES("CYCL DEF 25", "Contour train", source="8.9", takes=f"depth side_allowance surface {SHARED}")
class ContourTrain(Train):
    """Along an open or closed contour, level by level; under a mirror image climb stays climb."""

    surface: float = coordinate("Q5", "coordinate of the workpiece surface", example=0)

    def check(self, m: Machine) -> Iterator[ParameterFault]:
        yield from super().check(m)
        if self.height < max(self.surface, self.surface + self.depth):
            yield "height", f"must not lie below the surface or the floor, got {self.height:g}"

    def moves(self, m: Machine) -> Iterator[Step]:
        if not self.depth:
            yield Say("Q1 makes a depth of 0: the cycle is not executed")
            return
        before, place = m.programmed, m.flow.span_of_step(m.step)
        line = yield from contour_line(m)
        found = yield from trains(m, self, line, self.coarse_radius(m), place)
        yield from mill(found, self.levels(self.surface), self.feeds(m, self.surface), not self.sense)
        yield from leave(m, before, self.height)


@CYCLES(
    "CYCL DEF 276", "Three-dimensional contour train", source="8.10", takes=f"depth side_allowance {SHARED}"
)
class SpaceTrain(Train):
    """Along a contour with heights: at them, or in infeeds down from them; under a mirror image climb stays climb."""

    def check(self, m: Machine) -> Iterator[ParameterFault]:
        yield from super().check(m)
        yield from with_labels(m, single=True)
        if m.programmed[2] < self.height - SAME:
            yield "height", f"lies above the tool, which stands at Z{m.programmed[2]:.10g}, got {self.height:g}"

    def moves(self, m: Machine) -> Iterator[Step]:
        before, place = m.programmed, m.flow.span_of_step(m.step)
        line = yield from contour_line(m, in_space=True)
        top = float(line.heights.max())
        if top + max(self.depth, 0) > self.height:
            highest = m.flow.span_of_step(int(line.steps[max(int(line.heights.argmax()) - 1, 0)]))
            message = f"the contour reaches up to Z{top:.10g} here, above the clearance height {self.height:.10g}"
            raise Alarm(in_mm(f"{self.code}: {message}", m.variable_unit), highest)
        found = yield from trains(m, self, line, self.coarse_radius(m), place)
        yield from mill(found, self.levels(0.0) if self.depth else (0.0,), self.feeds(m, top), not self.sense)
        yield from leave(m, before, self.height)
