"""Obsolete cycles with sub-blocks, which still run (1.2): holes 1, 2, 17, and milling 3, 4, 5.

The tool stands at the set-up clearance when they are called, and ends there. Z is where it stands, S = Z - SETUP the surface,
S + DEPTH the bottom. The sign of DEPTH is the direction (for a positive one see the setting "depth_error"); set-up clearance
and infeed are lengths, which older programs write with the sign of the depth: -2, -20, -5.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator
from functools import partial
from types import SimpleNamespace

from mnclab.controls.tnc_620.cycles import addresses
from mnclab.controls.tnc_620.cycles.addresses import choice, coordinate, increment, length
from mnclab.controls.tnc_620.cycles.planes import SAME, ParameterFault, at_least, not_zero, oriented, with_radius
from mnclab.controls.tnc_620.cycles.pockets import CORNERS
from mnclab.controls.tnc_620.cycles.threads import pitch_of
from mnclab.controls.tnc_620.machining.finishing import finish_rounds
from mnclab.controls.tnc_620.machining.slots import straight_infeeds
from mnclab.geometry import contours
from mnclab.geometry.contours import Contour
from mnclab.machine.coordinates import MILLS, TAPS, depth_scale
from mnclab.machine.cycle import Cycle, CycleTable, param, too_many, too_many_passes
from mnclab.machine.machine import Machine
from mnclab.machining.depths import infeeds
from mnclab.machining.holes import drill, tap
from mnclab.machining.milling import faces
from mnclab.machining.milling.clearing import Clearing
from mnclab.machining.milling.pocket_steps import LevelFeeds, half_circles, quarter_circles, rough, straight
from mnclab.machining.milling.spirals import round_pocket
from mnclab.machining.steps import Go, Say, Step, Write

SHARED = SimpleNamespace(
    clearance=partial(
        increment, "SETUP", "set-up clearance", note="from the tool to the surface; its sign is that of the depth, or +",
        example=2,
    ),
    depth=partial(increment, "DEPTH", "depth", note=addresses.DOWN, example=-20),
    infeed=partial(increment, "PECKG", "infeed depth", note="its sign is that of the depth, or +", example=5),
    dwell=partial(addresses.seconds, "DWELL", "dwell at the bottom", example=0.25),
    plunge_feed=partial(addresses.feed, "PECKG:F", "feed rate for plunging", also=("FAUTO",), example=150),
    feed=partial(addresses.feed, "F", "feed rate for milling", also=("FAUTO",), example=500),
)  # fmt: skip
CYCLES = CycleTable(addresses=SHARED)


class AtClearance(Cycle):
    """What they share; who inherits declares the parameters."""

    clearance: float
    depth: float
    infeed: float | None = None
    dwell = feed = plunge_feed = 0.0

    @property
    def down(self) -> float:
        """+1 where the cycle works downwards, -1 upwards, 0 where it has nothing to do."""
        return -math.copysign(1.0, self.depth) if self.depth else 0.0

    @property
    def left_out(self) -> Say:
        return Say("DEPTH makes a depth of 0: the cycle is not executed")

    def surface(self, m: Machine) -> float:
        """S, before the cycle has moved."""
        return m.programmed[2] - self.down * abs(self.clearance)

    def levels(self, m: Machine) -> tuple[float, ...]:
        """Of the infeeds, before the cycle has moved."""
        surface = self.surface(m)
        return infeeds(surface, surface + self.depth, None if self.infeed is None else abs(self.infeed))

    def contradictions(self) -> Iterator[ParameterFault]:
        """Lengths have the sign of the depth, or none; an infeed is one."""
        if not self.depth:
            return
        for name in ("clearance", "infeed"):
            value = getattr(self, name) or 0.0
            if value < 0 < self.depth:
                yield name, f"must have the sign of the depth or be positive, got {value:g}"
        yield from not_zero(self, "infeed")

    def check(self, m: Machine) -> Iterator[ParameterFault]:
        """The direction, and a number of infeeds that somebody would wait for; nothing where nothing is done."""
        if not self.depth:
            return
        if self.depth > 0 and m.settings["depth_error"]:
            yield "depth", f"must be negative, got {self.depth:g}: a positive depth works upwards"
        yield from too_many("infeed", lambda: self.levels(m))
        yield from self.fits(m)

    def fits(self, m: Machine) -> Iterator[ParameterFault]:
        """Faults of the feed, the tool and the shape."""
        yield from ()

    def steps(self, m: Machine) -> Iterable[Step]:
        """All that it does at a depth other than 0."""
        return ()

    def moves(self, m: Machine) -> Iterable[Step]:
        return self.steps(m) if self.down else [self.left_out]


# Obsolete cycles of holes, which still run (1.2): pecking 1, tapping with a floating holder 2 and rigidly 17.
# They are those of earlier manuals (TNC 407 8.2, TNC 426/430 8.3). Readings where these are silent: under a scale the advanced
# stop distance of pecking is that of the true depth; rigid tapping is one pass.


def advanced_stop(depth: float) -> float:
    """How far above the last depth a peck is entered again, mm: 0.6 to a depth of 30 mm, then a fiftieth of it, at most 7.

    >>> [round(advanced_stop(depth), 3) for depth in (20, 30, 40, 400)]
    [0.6, 0.6, 0.8, 7.0]
    """
    return 0.6 if depth <= 30 else min(depth / 50, 7.0)


@CYCLES("CYCL DEF 1", "Pecking", source="1.2", takes="clearance depth infeed dwell feed")
class Pecking(AtClearance):
    """Drills in infeeds with full retraction to where the tool stood, and waits at the bottom.

    Written as 1.1 SET UP, 1.2 DEPTH, 1.3 PECKG, 1.4 DWELL, 1.5 F.
    """

    feed: float = addresses.feed("F", "feed rate for drilling", also=("FAUTO",), example=150)

    def fits(self, m: Machine) -> Iterator[ParameterFault]:
        return not_zero(self, "feed", purpose="to drill with")

    def steps(self, m: Machine) -> Iterator[Step]:
        above, scale = m.programmed[2], depth_scale(m)
        stop = advanced_stop(abs(self.depth) * scale) / scale
        yield from drill(self.levels(m), above=above, feed=self.feed, reenter=stop, dwell_bottom=self.dwell)
        yield Go("retract", above)


@CYCLES("CYCL DEF 2", "Tapping with a floating holder", source="1.2", takes="clearance depth dwell feed")
class FloatingTapping(AtClearance):
    """Taps at a feed in one pass with the spindle as it turns, reversed at the bottom and where the tool stood.

    Written as 2.1 SET UP, 2.2 DEPTH, 2.3 DWELL, 2.4 F.
    """

    does = TAPS
    clearance: float = SHARED.clearance(note="about four pitches")
    dwell: float = addresses.seconds("DWELL", "dwell at the bottom", note="0 to 0.5 s", example=0.25)
    feed: float = addresses.feed("F", "feed rate for tapping", also=("FAUTO",), note="S times pitch", example=150)

    def fits(self, m: Machine) -> Iterator[ParameterFault]:
        yield from not_zero(self, "feed")
        if not m.spindle_speed:
            yield "", "needs a turning spindle: write S in TOOL CALL, and M3 or M4 before"
        yield from pitch_of(m, "feed", self.feed / m.speed)

    def steps(self, m: Machine) -> Iterator[Step]:
        yield from tap(
            self.levels(m), above=m.programmed[2], sense=m.turning, end=m.turning, feed=self.feed, dwell=self.dwell,
            dwell_first=False, stand=m.settings["thread_wait"],
        )  # fmt: skip


@CYCLES("CYCL DEF 17", "Rigid tapping", source="1.2", takes="clearance depth pitch")
class RigidTapping(AtClearance):
    """Taps with the spindle locked to the feed; it stops at the end, and M3 or M4 starts it again.

    Written as 17.1 SET UP, 17.2 DEPTH, 17.3 PITCH.
    """

    does, own_spindle = TAPS, True
    pitch: float = param(
        "PITCH", "thread pitch", at_least=-99.9999, at_most=99.9999, modal=True, note="+ right-hand, - left-hand", example=1.5
    )

    def fits(self, m: Machine) -> Iterator[ParameterFault]:
        if self.pitch == 0:
            yield "pitch", "must not be 0"
        if not m.speed:
            yield "", "needs a spindle speed: write S in TOOL CALL"
        yield from oriented(m)
        yield from pitch_of(m, "pitch", abs(self.pitch))

    def steps(self, m: Machine) -> Iterator[Step]:
        yield from tap(
            self.levels(m), above=m.programmed[2], pitch=abs(self.pitch), sense=1 if self.pitch > 0 else -1, end=0,
            stand=m.settings["thread_wait"],
        )  # fmt: skip
        yield Write("modal", "M5", "spindle")


# Obsolete cycles with sub-blocks that mill, which still run (1.2): slot 3, pocket 4 and circular pocket 5.
# They are those of earlier manuals (TNC 407 8.2, TNC 426/430 8.4). The ends of a slot are round. Readings where they are
# silent: a layer of a pocket ends with a lift by the set-up clearance and the way back to the middle; a slot is left on an
# arc like the one to its wall, which is a quarter circle, or a half one in a slot too short for that.

SENSE: dict[float, str] = {1: "+: counter-clockwise, climb milling with M3", -1: "-: clockwise"}


class MilledAtClearance(AtClearance):
    """What the three share."""

    does = MILLS
    depth: float = SHARED.depth(example=-12)

    def fits(self, m: Machine) -> Iterator[ParameterFault]:
        yield from with_radius(m)
        yield from not_zero(self, "feed", "plunge_feed", purpose="to mill with")


@CYCLES("CYCL DEF 3", "Slot milling", source="1.2", takes="clearance depth infeed plunge_feed x y feed")
class SlotMilling(MilledAtClearance):
    """Mills a slot along X or Y: along its middle with an infeed at each end, then once round its wall in climb milling.

    The tool stands a tool radius within the end of the slot. A slot as wide as the tool has no wall to finish.

    Written as 3.1 SET UP, 3.2 DEPTH, 3.3 PECKG and F, 3.4 X, 3.5 Y, 3.6 F.
    """

    x: float = coordinate("X", "side along X", note="the longer side is the length, its sign the first direction", example=50)
    y: float = coordinate("Y", "side along Y", note="the shorter side is the width", example=12)

    @property
    def sides(self) -> tuple[str, float, str, float]:
        """Length, with its direction, and width, each after its name."""
        return ("x", self.x, "y", self.y) if abs(self.x) > abs(self.y) else ("y", self.y, "x", self.x)

    def contradictions(self) -> Iterator[ParameterFault]:
        yield from super().contradictions()
        _, long, name, width = self.sides
        if abs(long) <= width + SAME:
            yield name, f"must be less than the other side, {abs(long):g}, got {width:g}"

    def fits(self, m: Machine) -> Iterator[ParameterFault]:
        yield from super().fits(m)
        _, _, name, width = self.sides
        yield from at_least(self, name, 2 * m.radius, "the tool diameter")
        if width > 4 * m.radius + SAME:
            yield name, f"must be at most twice the tool diameter, {4 * m.radius:g}, got {width:g}"

    def line(self, m: Machine) -> Contour:
        """Between the centres of the round ends, from where the tool stands."""
        name, long, _, width = self.sides
        sign, inset = math.copysign(1.0, long), width / 2 - m.radius
        near, far = sign * inset, sign * (abs(long) - width + inset)
        return Contour([(near, 0.0), (far, 0.0)] if name == "x" else [(0.0, near), (0.0, far)], closed=False)

    def steps(self, m: Machine) -> Iterator[Step]:
        above, levels, line, feeds = m.programmed[2], self.levels(m), self.line(m), LevelFeeds(self.feed, self.plunge_feed)
        inset = self.sides[3] / 2 - m.radius
        x, y = line.points[0].tolist()
        yield Go("to the centre of the first end", x=x, y=y)
        yield from straight_infeeds(line, levels, feeds)
        if inset > faces.NOTHING:
            line = line.reversed() if len(levels) % 2 else line
            yield from finish_rounds(*_wall(line, inset), tuple(line.points[0].tolist()), levels[-1:], feeds)
        yield Go("retract", above)
        yield Go("back to the start", x=0.0, y=0.0)


def _wall(line: Contour, inset: float) -> tuple[Contour, tuple[Contour, ...]]:
    """The way round the wall, counter-clockwise, and the arcs to it and off it from and to the line."""
    wall = contours.slot(line.reversed(), 2 * inset)
    if line.length < inset:
        return wall, half_circles(wall, inset, 1)
    side = wall.started_at(inset * (math.pi / 2 + 1))  # a quarter of the round end, and as far along the straight side
    return side, quarter_circles(side, inset, 1)


@CYCLES(
    "CYCL DEF 4", "Pocket milling", source="1.2", takes="clearance depth infeed plunge_feed x y feed sense corner_radius"
)
class PocketMilling(MilledAtClearance):
    """Roughs a rectangular pocket about the tool in layers, outwards on rectangles, from the middle and back to it.

    Each layer begins in the positive direction of the longer side, of two equal ones in that of Y.

    Written as 4.1 SET UP, 4.2 DEPTH, 4.3 PECKG and F, 4.4 X, 4.5 Y, 4.6 F, DR and RADIUS.
    """

    x: float = length("X", "side along X", example=80)
    y: float = length("Y", "side along Y", note="greater than twice RADIUS and the stepover", example=40)
    sense: float = choice("DR", "sense of the path", SENSE, example=1)
    corner_radius: float = length("RADIUS", "corner radius", default=0, note="0: the tool radius", example=8)

    def fits(self, m: Machine) -> Iterator[ParameterFault]:
        yield from super().fits(m)
        for name in ("x", "y"):
            yield from at_least(self, name, 2 * max(m.radius, self.corner_radius), "twice the radius of tool and corner")
        if 0 < self.corner_radius < m.radius - SAME:
            yield "corner_radius", f"must be 0 or at least the tool radius, {m.radius:g}, got {self.corner_radius:g}"
        if self.y <= (least := 2 * self.corner_radius + m.settings["overlap"] * m.radius):
            yield "y", f"must be greater than twice RADIUS and the stepover, {least:g}, got {self.y:g}"
        yield from passes_to_wait_for(self, m)

    def clearing(self, m: Machine) -> Clearing:
        return faces.rectangle(
            self.x, self.y, m.radius, min(m.settings["overlap"], CORNERS) * m.radius, corner=self.corner_radius,
            climb=self.sense > 0, begin=int(self.x <= self.y),
        )  # fmt: skip

    def steps(self, m: Machine) -> Iterator[Step]:
        return layers(self, m)


@CYCLES("CYCL DEF 5", "Circular pocket", source="1.2", takes="clearance depth infeed plunge_feed radius feed sense")
class CircularPocket(MilledAtClearance):
    """Roughs a circular pocket about the tool in layers, each on a spiral from the middle to the wall.

    Written as 5.1 SET UP, 5.2 DEPTH, 5.3 PECKG and F, 5.4 RADIUS, 5.5 F and DR.
    """

    radius: float = length("RADIUS", "radius of the pocket", example=30)
    sense: float = choice("DR", "sense of the path", SENSE, example=1)

    def fits(self, m: Machine) -> Iterator[ParameterFault]:
        yield from super().fits(m)
        yield from at_least(self, "radius", m.radius, "the tool radius")
        yield from passes_to_wait_for(self, m)

    def clearing(self, m: Machine) -> Clearing:
        return round_pocket(2 * self.radius, m.radius, m.settings["overlap"] * m.radius, climb=self.sense > 0)

    def steps(self, m: Machine) -> Iterator[Step]:
        return layers(self, m)


def passes_to_wait_for(c: PocketMilling | CircularPocket, m: Machine) -> Iterator[ParameterFault]:
    yield from too_many("feed", lambda: c.clearing(m))
    yield from too_many_passes("infeed", len(c.levels(m)), sum(len(way.starts) for way in c.clearing(m).passes))


def layers(c: PocketMilling | CircularPocket, m: Machine) -> Iterator[Step]:
    """Layer by layer from the middle, and up to where the tool stood."""
    return rough(
        c.clearing(m), c.levels(m), surface=c.surface(m), clearance=c.down * abs(c.clearance), down=straight,
        feeds=LevelFeeds(c.feed, c.plunge_feed), departure=0.0, side=1 if c.sense > 0 else -1, end=m.programmed[2],
    )  # fmt: skip
