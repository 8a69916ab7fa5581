"""Drilling, centring, reaming, boring and bore milling, called by M99 (MNC, 9.4 to 9.11)."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import ClassVar

import numpy as np

from mnclab.controls.mnc.cycles import addresses
from mnclab.controls.mnc.cycles.prepared import PreparedCycle, called, kept
from mnclab.machine.coordinates import MILLS, SHIFTS, is_round, remark, tool, with_the_spindle
from mnclab.machine.cycle import CycleTable, Given, Values, param, too_many
from mnclab.machine.machine import Machine
from mnclab.machining.depths import infeeds
from mnclab.machining.holes import back_bore, bore, bore_milling, drill, gun_drill, ream, turns
from mnclab.machining.steps import Go, Say, Step, Wait, Write

# Drilling and centring (MNC, 9.4, 9.7, 9.10, 9.11): G300, G303, G305 and G307, called by M99.

CYCLES = CycleTable()

TO: dict[float, str] = {0: "to the depth H", 1: "to the diameter D"}
EVERY = "0: the tool is withdrawn after every infeed"
ENTRY: dict[float, str] = {3: "clockwise (M3)", 4: "counter-clockwise (M4)", 5: "stopped (M5)"}
AS_F = {"default": None, "default_means": "F"}
NO_LIMIT = {"default": None, "default_means": "no limit", "note": "needed where K is greater than 0"}
TURNING = {3: 1, 4: -1, 5: 0}


@CYCLES("G300, G200", "Drilling", runs="call", source="MNC 9.4")
class Drilling(PreparedCycle):
    """Drills with rapid withdrawal to the clearance level after every infeed."""

    clearance: float = addresses.clearance()
    depth: float = addresses.depth()
    infeed: float | None = addresses.distance("P", "depth of each infeed", 5, **addresses.ONE_PASS)
    surface: float = addresses.surface()
    feed: float | None = addresses.feed("plunging feed")
    dwell_top: float = addresses.dwell_top()
    dwell_bottom: float = addresses.dwell_bottom()

    def levels(self) -> tuple[float, ...]:
        return infeeds(self.surface, self.surface + self.depth, self.infeed)

    def contradictions(self) -> Iterator[tuple[str, str]]:
        return too_many("infeed", self.levels)

    def moves(self, m: Machine) -> Iterator[Step]:
        work = drill(
            self.levels(), above=self.level, feed=self.feed, reenter=self.clearance,
            dwell_top=self.dwell_top, dwell_bottom=self.dwell_bottom,
        )  # fmt: skip
        return called(m, self.level, work)


@CYCLES("G303, G203", "Universal drilling", runs="call", source="MNC 9.7")
class UniversalDrilling(PreparedCycle):
    """Drills with infeeds that may shrink; breaks the chip some times before each withdrawal."""

    clearance: float = addresses.clearance()
    depth: float = addresses.depth()
    infeed: float | None = addresses.distance("P", "depth of the first infeed", 6, **addresses.ONE_PASS)
    surface: float = addresses.surface()
    min_infeed: float | None = addresses.distance("M", "least infeed", 2, **NO_LIMIT)
    feed: float | None = addresses.feed("drilling feed")
    retract_feed: float | None = addresses.other_feed("V", "feed out of the hole", 400)
    dwell_top: float = addresses.dwell_top()
    dwell_bottom: float = addresses.dwell_bottom()
    decrement: float = addresses.allowance("K", "amount by which P shrinks after each infeed", 3)
    chip_breaks: float = addresses.count("L", "chip breaks before each withdrawal", 1, default=0, note=EVERY)
    break_retract: float = addresses.length("I", "distance back to break the chip", 0.5, default=0.1, at_least=0.1)

    @classmethod
    def prepare(cls, values: Values, given: Given, m: Machine, kept: Values) -> Values:
        """M99 in this block is a least infeed, which somebody may not have meant."""
        if values.get("min_infeed") == 99:
            m.warn(f"{cls.code} M99 is a least infeed of 99 mm, no cycle call", given["min_infeed"])
        return values

    def levels(self) -> tuple[float, ...]:
        bottom = self.surface + self.depth
        return infeeds(self.surface, bottom, self.infeed, self.decrement, self.min_infeed or 0.0)

    def contradictions(self) -> Iterator[tuple[str, str]]:
        if self.decrement and self.min_infeed is None:
            yield "decrement", f"{self.decrement:g} needs M, the least infeed"
        yield from too_many("infeed", self.levels)

    def moves(self, m: Machine) -> Iterator[Step]:
        out = self.retract_feed or self.feed
        work = drill(
            self.levels(), above=self.level, feed=self.feed, reenter=self.clearance, withdraw=out,
            dwell_top=self.dwell_top, dwell_bottom=self.dwell_bottom,
            breaks=int(self.chip_breaks), back=self.break_retract,
        )  # fmt: skip
        return called(m, self.level, [*work, Go("retract", self.level, out)])


@CYCLES("G305", "Centring", runs="call", source="MNC 9.11")
class Centring(PreparedCycle):
    """Centres to a depth, or to a diameter that the point angle of the tool turns into one."""

    clearance: float = addresses.clearance()
    mode: float = addresses.choice("L", "what the centring goes to", TO, 0, default=0)
    depth: float | None = param(
        "H", "depth from the surface to the tip", default=None, default_means="not used with L1", incremental=True,
        note="less than 0 where L is 0", example=-3,
    )  # fmt: skip
    diameter: float | None = param(
        "D", "diameter of the centring", default=None, default_means="not used with L0",
        note="written with a minus sign: less than 0 where L is 1", example=-8,
    )  # fmt: skip
    surface: float = addresses.surface()
    feed: float | None = addresses.feed("centring feed")
    dwell_bottom: float = addresses.dwell_bottom()

    def contradictions(self) -> Iterator[tuple[str, str]]:
        name, value = ("diameter", self.diameter) if self.mode else ("depth", self.depth)
        if value is None:
            yield name, f"is missing: L is {self.mode:g}"
        elif not value < 0:
            yield name, f"must be less than 0, got {value:g}"

    def check(self, m: Machine) -> Iterator[tuple[str, str]]:
        if self.mode and not 0 < m.tool.angle < 180:
            yield "mode", f"1 needs the point angle of tool {m.tool.number} in the tool table"
        if self.mode and not is_round(m):
            yield "mode", "1 cannot run under unequal scales of the plane: a diameter would be two"

    def moves(self, m: Machine) -> Iterator[Step]:
        """Steps 1 to 4 of the manual; the cone of the point is as deep as half the diameter over its tangent."""
        down, diameter = self.depth or 0.0, self.diameter or 0.0
        if self.mode:
            down = diameter / 2 / math.tan(math.radians(tool(m).angle / 2))
            if -diameter > 2 * m.radius > 0:
                end = f"{2 * m.radius:.10g}: the cone ends at the tool's diameter"
                yield Say(f"D{diameter:.10g} is wider than the tool, {end}")
        work = Go("centre", self.surface + down, self.feed), Wait("dwell at the bottom", self.dwell_bottom)
        yield from called(m, self.level, work)


@CYCLES("G307, G241", "Gun drilling", runs="call", source="MNC 9.10")
class GunDrilling(PreparedCycle):
    """Drills deep in one go with a single-lip drill: slow in and out, fast with coolant while it cuts.

    With K it dwells twice. Step 3 drills "to the depth or to the dwell depth": were that an alternative, K < |H| would leave
    the hole unfinished. So K is a pause on the way, as its own text says of through holes, and step 4 dwells at the bottom;
    T is the time of both, as there is no other.
    """

    clearance: float = addresses.clearance()
    depth: float = addresses.depth()
    surface: float = addresses.surface()
    feed: float | None = addresses.feed("drilling feed")
    retract_feed: float | None = addresses.other_feed("E", "feed out of the hole", 1000)
    dwell_bottom: float = addresses.dwell_bottom()
    positioning_feed: float | None = addresses.own_feed("V", "feed to the deepened start point", 750, **AS_F)
    start_depth: float = addresses.allowance("W", "depth of the start point below the surface", 5)
    spindle_direction: float = addresses.choice("M", "spindle when entering and leaving", ENTRY, 4, default=3)
    entry_speed: float | None = addresses.speed(
        "R", "speed when entering and leaving", 25, default_means="S", at_least=0
    )
    drilling_speed: float | None = addresses.speed(
        "S", "speed when drilling", 500, default_means="the modal S", above=0
    )
    dwell_depth: float = addresses.allowance("K", "depth of a dwell on the way", 10, note="0: none")

    def contradictions(self) -> Iterator[tuple[str, str]]:
        for name in ("dwell_depth", "start_depth"):
            if (value := getattr(self, name)) >= -self.depth:
                yield name, f"must be less than the depth {-self.depth:g}, got {value:g}"

    def check(self, m: Machine) -> Iterator[tuple[str, str]]:
        if not self.speed(m):
            yield "drilling_speed", "is missing, and no spindle speed was programmed before"

    def speed(self, m: Machine) -> float:
        """The speed to drill with: S of the cycle, or that of the program, not what this cycle left behind."""
        drilled, left = kept(m).get("speeds", (0.0, None))
        return self.drilling_speed or (drilled if m.speed == left else m.speed)

    def moves(self, m: Machine) -> Iterator[Step]:
        speed = self.speed(m)
        entry = speed if self.entry_speed is None else self.entry_speed
        work = gun_drill(
            [self.surface + self.depth], above=self.level, start=self.level - self.start_depth, feed=self.feed,
            approach=self.positioning_feed or self.feed, retract=self.retract_feed or self.feed,
            entry=(TURNING[int(self.spindle_direction)], entry), speed=speed, dwell=self.dwell_bottom,
            pause=self.surface - self.dwell_depth if self.dwell_depth else None,
        )  # fmt: skip
        yield from called(m, self.level, work)
        yield Write("modal", "M9", "coolant")
        yield Write("kept", (speed, entry), "speeds")


# Reaming, boring, back boring and bore milling (MNC, 9.5, 9.6, 9.8, 9.9): G301, G302, G304 and G306, called by M99.

DISENGAGE: dict[float, str] = {0: "not at all", 1: "in -X", 2: "in -Y", 3: "in +X", 4: "in +Y"}
SHIFT = {choice: where for choice, where in DISENGAGE.items() if choice}
MODE: dict[float, str] = {1: "climb (counter-clockwise)", -1: "conventional (clockwise)", 0: "as 1"}


def tilted(m: Machine) -> Iterator[tuple[str, str]]:
    """A fault where the hole does not lie along the oriented spindle."""
    if np.abs(m.frames.matrix[:2, 2]).max() > 1e-9:
        yield "disengage", "needs a hole along the spindle: G39 outside of G17 tilts it"


@CYCLES("G301, G201", "Reaming", runs="call", source="MNC 9.5")
class Reaming(PreparedCycle):
    """In and out at feed."""

    clearance: float = addresses.clearance()
    depth: float = addresses.depth()
    surface: float = addresses.surface()
    feed: float | None = addresses.feed("reaming feed")
    retract_feed: float | None = addresses.other_feed("V", "return feed", 400)
    dwell_bottom: float = addresses.dwell_bottom()

    def moves(self, m: Machine) -> Iterator[Step]:
        bottom, out = self.surface + self.depth, self.retract_feed or self.feed
        work = ream(bottom, above=self.level, feed=self.feed, retract=out, dwell=self.dwell_bottom)
        return called(m, self.level, work)


@CYCLES("G302, G202", "Boring with oriented spindle", runs="call", source="MNC 9.6")
class Boring(PreparedCycle):
    """Bores, stops the spindle at an angle, moves 0.2 mm off the wall and withdraws; no frame turns D or changes 0.2 mm."""

    clearance: float = addresses.clearance()
    depth: float = addresses.depth()
    surface: float = addresses.surface()
    feed: float | None = addresses.feed("boring feed")
    retract_feed: float | None = addresses.other_feed("V", "feed out of the hole", 400)
    dwell_bottom: float = addresses.dwell_bottom()
    disengage: float = addresses.choice("D", "direction in which the tool leaves the wall", DISENGAGE, 1, default=0)
    spindle_angle: float = addresses.angle("A", "spindle angle for the withdrawal", 30)

    def check(self, m: Machine) -> Iterator[tuple[str, str]]:
        if self.disengage:
            yield from tilted(m)

    def moves(self, m: Machine) -> Iterator[Step]:
        """Steps 1 to 6 of the manual; the spindle turns again as before, for the next call."""
        work = bore(
            self.surface + self.depth, above=self.level, feed=self.feed, retract=self.retract_feed or self.feed,
            dwell=self.dwell_bottom, angle=self.spindle_angle, direction=int(self.disengage),
        )  # fmt: skip
        return called(m, self.level, with_the_spindle(m, work), shifted=True)


@CYCLES("G304, G204", "Back boring", runs="call", source="MNC 9.8")
class BackBoring(PreparedCycle):
    """Counterbores from below, with a bar that goes through the hole off its axis."""

    does: ClassVar[str] = SHIFTS

    clearance: float = addresses.clearance()
    surface: float = addresses.surface()
    counterbore_depth: float = addresses.distance("H", "depth of the counterbore from the lower surface", 5)
    thickness: float = addresses.distance("B", "material thickness", 20)
    eccentricity: float = addresses.distance("E", "off-centre distance of the tool", 3.5)
    edge_height: float = addresses.distance("L", "height of the edge above the end of the bar", 12)
    positioning_feed: float = addresses.own_feed("V", "feed into and out of the workpiece", 750)
    feed: float | None = addresses.feed("counterboring feed")
    dwell_bottom: float = addresses.dwell_bottom()
    disengage: float = addresses.choice("D", "direction of the shift off the axis", SHIFT, 1)
    spindle_angle: float = addresses.angle("A", "spindle angle for entry and exit", 30)

    def contradictions(self) -> Iterator[tuple[str, str]]:
        depth, thickness = self.counterbore_depth, self.thickness
        if depth >= thickness:
            yield "counterbore_depth", f"must be less than the thickness {thickness:g}, got {depth:g}"

    def check(self, m: Machine) -> Iterator[tuple[str, str]]:
        return tilted(m)

    def moves(self, m: Machine) -> Iterator[Step]:
        """Steps 1 to 6 of the manual; levels are those of the end of the bar."""
        lower = self.surface - self.thickness - self.edge_height
        work = back_bore(
            above=self.level, below=lower - self.clearance, bottom=lower + self.counterbore_depth,
            eccentricity=self.eccentricity, direction=int(self.disengage), angle=self.spindle_angle,
            feed=self.feed, travel=self.positioning_feed, dwell=self.dwell_bottom, turning=m.turning or 1,
        )  # fmt: skip
        return called(m, self.level, with_the_spindle(m, work), shifted=True)


@CYCLES("G306, G208", "Bore milling", runs="call", source="MNC 9.9")
class BoreMilling(PreparedCycle):
    """Mills a hole on a helix from the clearance level, with a full circle at the bottom."""

    does: ClassVar[str] = MILLS

    clearance: float = addresses.clearance()
    depth: float = addresses.depth()
    surface: float = addresses.surface()
    feed: float | None = addresses.feed("feed on the helix")
    pitch: float = addresses.distance("P", "infeed per turn", 3)
    diameter: float = param("D", "hole diameter", above=0, example=12)
    predrilled_diameter: float = param(
        "C", "diameter of the hole drilled before", default=0, at_least=0, example=0,
        note="above 0 the hole may be wider than twice the tool",
    )  # fmt: skip
    milling_mode: float = addresses.choice("L", "kind of milling with M3", MODE, 1, default=1)

    def contradictions(self) -> Iterator[tuple[str, str]]:
        if self.predrilled_diameter >= self.diameter:
            yield "predrilled_diameter", f"must be less than D {self.diameter:g}, got {self.predrilled_diameter:g}"
        yield from too_many("pitch", lambda: turns(self.clearance - self.depth, self.pitch))

    def check(self, m: Machine) -> Iterator[tuple[str, str]]:
        tool = 2 * m.radius
        if self.diameter < tool:
            yield "diameter", f"must be at least the tool diameter {tool:g}, got {self.diameter:g}"
        if not self.predrilled_diameter and self.diameter > 2 * tool:
            most = f"twice the tool diameter {tool:g}, got {self.diameter:g}"
            yield "diameter", f"must be at most {most}: a core would remain"

    def moves(self, m: Machine) -> Iterator[Step]:
        inner = self.diameter - 4 * m.radius
        if m.cycle and 0 < self.predrilled_diameter < inner:
            ring = f"C {self.predrilled_diameter:g} leaves a ring: the tool reaches in to {inner:g}"
            yield Say(ring + remark(m), word=m.cycle.words["predrilled_diameter"])
        work = bore_milling(
            self.surface + self.depth, above=self.level, radius=self.diameter / 2 - m.radius, pitch=self.pitch,
            sense=-1 if self.milling_mode < 0 else 1, feed=self.feed,
        )  # fmt: skip
        yield from called(m, self.level, work)
