"""Cycles 25 and 276: contour trains, along an open or closed contour in the plane or in space (8.9, 8.10).

`milling.trains` finds the way beside the contour, `milling.train_passes` the passes; `train_plan` joins them with cycle 270.
"""

from __future__ import annotations

from collections.abc import Iterator

from mnclab.controls.tnc_620.contours.leaving import leave
from mnclab.controls.tnc_620.contours.line import contour_line, with_labels
from mnclab.controls.tnc_620.contours.other_tools import Named, in_table, named_tool
from mnclab.controls.tnc_620.contours.train_plan import trains
from mnclab.controls.tnc_620.cycles import addresses
from mnclab.controls.tnc_620.cycles.addresses import FAR, choice, coordinate, count, increment, length
from mnclab.controls.tnc_620.cycles.faults import SAME, Fault, not_zero, with_radius
from mnclab.controls.tnc_620.cycles.planes import in_program_coordinates
from mnclab.controls.tnc_620.machining.train_passes import Feeds, mill
from mnclab.machine.coordinates import MILLS, in_mm
from mnclab.machine.cycle import Cycle, CycleTable, too_many
from mnclab.machine.machine import INF, Machine
from mnclab.machining.depths import infeeds
from mnclab.machining.steps import Say, Step
from mnclab.text.alarm import Alarm

CYCLES = CycleTable()
SENSE: dict[float, str] = {1: "climb", -1: "up-cut", 0: "to and fro, infeeds at both ends"}
CLEAR = 2.0  # mm above the surface, to which the tool goes down at rapid (the manual names no set-up clearance)

milling_depth = increment("Q1", "milling depth from the surface to the floor", example=-20)
side_allowance = increment("Q3", "finishing allowance for side", example=0)
clearance_height = coordinate("Q7", "clearance height", example=50)
infeed = increment("Q10", "infeed per cut", example=5)
plunge_feed = addresses.feed("Q11", "feed rate for plunging", also=addresses.PLANE, at_most=FAR, example=100)
milling_feed = addresses.feed("Q12", "feed rate for roughing", also=addresses.PLANE, at_most=FAR, example=350)
sense = choice("Q15", "climb or up-cut milling", SENSE, example=1)
coarse_tool = count(("Q18", "QS18"), "coarse roughing tool", type="text", default=0)
accepted = length("Q446", "accepted residual material", at_least=0.001, at_most=9.999, default=0.01)
connected = length("Q447", "connection distance", at_most=999.9999, default=10)
extended = length("Q448", "path extension", at_most=99.999, default=2)


class Train(Cycle):
    """What both cycles share; who inherits declares the parameters."""

    does = MILLS
    about = in_program_coordinates
    depth: float
    side_allowance: float
    height: float
    infeed: float
    plunge_feed: float
    feed: float
    sense: float
    coarse_tool: Named
    accepted: float
    connected: float
    extended: float

    def check(self, m: Machine) -> Iterator[Fault]:
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


@CYCLES("CYCL DEF 25", "Contour train", source="8.9")
class ContourTrain(Train):
    """Along an open or closed contour, level by level; under a mirror image climb stays climb."""

    depth: float = milling_depth
    side_allowance: float = side_allowance
    surface: float = coordinate("Q5", "coordinate of the workpiece surface", example=0)
    height: float = clearance_height
    infeed: float = infeed
    plunge_feed: float = plunge_feed
    feed: float = milling_feed
    sense: float = sense
    coarse_tool: Named = coarse_tool
    accepted: float = accepted
    connected: float = connected
    extended: float = extended

    def check(self, m: Machine) -> Iterator[Fault]:
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


@CYCLES("CYCL DEF 276", "Three-dimensional contour train", source="8.10")
class SpaceTrain(Train):
    """Along a contour with heights: at them, or in infeeds down from them; under a mirror image climb stays climb."""

    depth: float = milling_depth
    side_allowance: float = side_allowance
    height: float = clearance_height
    infeed: float = infeed
    plunge_feed: float = plunge_feed
    feed: float = milling_feed
    sense: float = sense
    coarse_tool: Named = coarse_tool
    accepted: float = accepted
    connected: float = connected
    extended: float = extended

    def check(self, m: Machine) -> Iterator[Fault]:
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
