"""Cycle 275: a slot about a centre line, roughed on circles (8.12); `tnc_620/machining/slots.py` does the geometry.

A closed slot begins in the material, an open one outside of it, where its APPR block begins. The manual names no clearance
height: it is the second set-up clearance. Where two readings are possible, the floor comes after the walls, with the same
circles, and the walls go down to it.
"""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np

from mnclab.controls.tnc_620.contours.line import ContourLine, contour_line, leave, with_labels
from mnclab.controls.tnc_620.cycles import addresses, milling
from mnclab.controls.tnc_620.cycles.planes import ParameterFault, at_least, at_most, not_zero
from mnclab.controls.tnc_620.cycles.pockets import check_angle, feeds
from mnclab.controls.tnc_620.machining import slots
from mnclab.geometry.contours import Contour
from mnclab.machine.coordinates import in_mm, remark, tool
from mnclab.machine.cycle import CycleTable, too_many_passes
from mnclab.machine.machine import Machine
from mnclab.machining.depths import infeeds
from mnclab.machining.milling.pocket_steps import PocketWork, centre_feeds
from mnclab.machining.milling.trochoids import NOTHING, circle_count, trochoid, walls
from mnclab.machining.steps import Go, Say, Step
from mnclab.path.leads import way
from mnclab.path.toolpath import PathFault
from mnclab.text.alarm import Span

CYCLES = CycleTable(addresses=addresses.shared(**milling.PARAMETERS))
PLUNGE: dict[float, str] = {0: "vertical", 1: "no function: as 0", 2: "reciprocating"}
CORNER = 0.01  # rad, of a turn that is more than rounded coordinates


@CYCLES(
    "CYCL DEF 275", "Trochoidal slot", source="8.12",
    takes="machining_operation slot_width side_allowance advance milling_feed roughing_feed milling_type depth infeed "
          "plunging_feed finishing_infeed finishing_feed clearance surface second_clearance plunging_strategy floor_allowance "
          "feed_reference",
)  # fmt: skip
class TrochoidalSlot(milling.MilledFigure):
    """Mills a slot along a contour: circles level by level, then its walls, then its floor; a mirror image keeps its climb."""

    advance: float = addresses.length("Q436", "infeed per revolution", unit="mm/rev", note="the greatest engagement", example=4)
    roughing_feed: float | None = addresses.feed(
        "Q12", "feed rate for roughing", also=addresses.PLANE, at_most=addresses.FAR, default=None, default_means="not used",
        note="Q207 counts",
    )  # fmt: skip
    infeed: float = addresses.infeed(note="greater than 0", example=10)
    finishing_feed: float = addresses.finishing_feed(example=500)
    second_clearance: float = addresses.second_clearance(example=50)
    plunging_strategy: float = addresses.plunging(PLUNGE, example=0)

    def check(self, m: Machine) -> Iterator[ParameterFault]:
        yield from with_labels(m, single=True)
        yield from super().check(m)

    def fits(self, m: Machine) -> Iterator[ParameterFault]:
        """The tool and its step fit the slot; how the tool gets down."""
        yield from at_least(self, "slot_width", 2 * m.radius, "the tool diameter")
        rough, circles = self.machining_operation != 2, self.machining_operation != 1 and self.floor_allowance > 0
        if not self.is_full(m):
            least = 2 * m.radius + 2 * self.side_allowance
            yield from at_least(self, "slot_width", least, "the tool diameter and twice Q368")
            if rough or circles:
                yield from at_most(self, "slot_width", 4 * m.radius + NOTHING, "twice the tool diameter")
                yield from not_zero(self, "advance", purpose="to advance by")
                yield from at_most(self, "advance", 2 * m.radius, "the tool diameter")
        if self.plunging_strategy == 2:
            yield from check_angle(self, m)

    def is_full(self, m: Machine) -> bool:
        return abs(self.slot_width / 2 - m.radius) <= NOTHING

    def climb(self, m: Machine) -> bool:
        """Whether walls are climbed on the machine: no mirror image changes the sense of milling (8.3)."""
        return (self.milling_type >= 0) == (m.orientation > 0)

    def moves(self, m: Machine) -> Iterator[Step]:
        if self.roughing_feed is not None:
            yield Say("Q12 is not used: Q207 is the feed rate for roughing")
        if self.plunging_strategy == 1 and self.down:
            yield Say("Q366=1 has no function: the tool goes straight down")
        if not self.down:
            yield self.left_out
            return
        here = m.flow.span_of_step(m.step)  # reading the contour goes on to its last block
        found = yield from contour_line(m)
        if found.side and not found.approach:
            yield Say("the contour is the middle of the slot: its RL or RR has no effect", word=here)
        if found.departure:
            name = found.departure.lead.name
            yield Say(f"{name} is no part of the slot, which ends where its contour ends", word=here)
        line = with_approach(m, found)
        if line.closed and abs(float(line.turns()[0])) > CORNER:
            corner = m.flow.span_of_step(int(found.steps[0]))
            m.alarm(f"{self.code}: a slot must not begin in a corner of its contour", corner)
        yield from mill(self, m, line, found.approach is not None, here)


def with_approach(m: Machine, found: ContourLine) -> Contour:
    """The centre line of a slot: its contour, and the way to it where the tool enters from outside."""
    line, approach = found.contour, found.approach
    if approach is None:
        return line
    start = np.array((m.programmed if approach.place is None else approach.place)[:2])
    try:
        by, centre, sweep = way(approach.lead, start, line.points[0], line.tangents()[0][0])
    except PathFault as fault:
        m.alarm(fault.message, m.flow.span_of_step(fault.step), fault.hint)
    begin = start if math.dist(by, line.points[0]) <= NOTHING else by
    lead, bulge = [begin], [math.tan(sweep / 4)]
    if centre is not None and abs(sweep) > math.pi:
        arm = complex(*(by - centre)) * np.exp(0.5j * sweep)
        lead, bulge = [by, centre + (arm.real, arm.imag)], [math.tan(sweep / 8)] * 2
    points = np.vstack([*lead, line.points, *(line.points[:1] if line.closed else ())])
    return Contour(points, np.concatenate([bulge, line.bulge, [0.0] * line.closed]), closed=False)


def mill(c: TrochoidalSlot, m: Machine, line: Contour, opens: bool, here: Span | None) -> Iterator[Step]:
    """Roughing, walls and floor from the second set-up clearance; what cannot be is told before anything moves."""
    climb, angle = c.climb(m), tool(m).plunge_angle if c.plunging_strategy == 2 else 90.0
    work = work_of(c, m)
    if work.is_nothing:
        why = "the slot is as wide as the tool" if c.is_full(m) else "neither Q368 nor Q369 is given"
        yield Say(f"Q215=2 finishes nothing: {why}", word=here)
        return
    width = 2 * m.radius if c.is_full(m) else c.slot_width
    down = slots.way_down(line, m.radius, angle)
    around = walls(line, width, m.radius, climb=climb, begins_outside=opens) if work.walls else ()
    rough = trochoid(line, width - 2 * work.allowance, m.radius, c.advance, climb=climb) if work.layers else None
    floor = trochoid(line, width, m.radius, c.advance, climb=climb) if work.floor else None
    for clearing, levels in ((rough, work.layers), (floor, work.floor)):
        if clearing is not None and len(clearing.passes) > 1:
            for _, sentence in too_many_passes("", len(levels), circle_count(line, width, c.advance)):
                m.alarm(f"{c.code} Q436 (infeed per revolution) {sentence}", here)
    edges = ((rough, work.feeds[0]), (floor, work.feeds[2]))
    ways = [way for clearing, feed in edges if clearing and feed.edge for way in clearing.passes]
    for way_along in (*ways, *(wall.contour for wall in around if work.feeds[1].edge)):
        try:
            centre_feeds(way_along, 1.0, m.radius, work.side)
        except ValueError as error:
            message = f"{c.code} Q439={c.feed_reference:g} cannot be obeyed: {error}{remark(m)}"
            m.alarm(in_mm(message, m.variable_unit), here, hint="Q439=0 counts at the tool centre")
    (x, y), before = line.points[0].tolist(), m.programmed
    up = (c.end,) if c.down > 0 else (c.above, c.end)
    yield Go("to the second set-up clearance", max(m.programmed[2], c.end))
    yield Go("over the start", x=x, y=y)
    if rough:
        yield from slots.rough(rough, work, down, up)
    yield from slots.finish_walls(around, work, up)
    if floor:
        yield from slots.finish_floor(floor, work, down, up)
    yield from leave(m, before, c.end)


def work_of(c: TrochoidalSlot, m: Machine) -> PocketWork:
    """What is done: a slot as wide as the tool is only roughed, on its line; the walls go down to the floor."""
    work = milling.work(c, m, feeds(c, m))
    work = work._replace(
        side=1 if c.climb(m) else -1, layers=infeeds(c.surface, milling.left_over(c), c.infeed) if work.layers else (),
        walls=infeeds(c.surface, c.surface + c.depth, c.finishing_infeed) if work.walls else (),
    )  # fmt: skip
    if not c.is_full(m):
        return work
    return work._replace(allowance=0.0, walls=(), floor=(), feeds=(work.feeds[0]._replace(edge=0.0), *work.feeds[1:]))
