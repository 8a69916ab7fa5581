"""Centring, drilling, reaming, boring and deep holes (4.2 to 4.10)."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator
from itertools import chain

from mnclab.controls.tnc_620.cycles import addresses, planes
from mnclab.controls.tnc_620.cycles.addresses import (
    choice,
    coordinate,
    count,
    distance,
    increment,
    length,
    percent,
    seconds,
)
from mnclab.controls.tnc_620.cycles.chain import MIRROR
from mnclab.controls.tnc_620.cycles.planes import AtSurface, ParameterFault
from mnclab.machine.coordinates import MILLS, SHIFTS, is_round, tool, with_the_spindle
from mnclab.machine.cycle import CycleTable, too_many
from mnclab.machine.machine import Machine
from mnclab.machining import holes
from mnclab.machining.depths import DRIFT, advanced_stops, infeeds
from mnclab.machining.steps import RAPID, Go, Say, Step, Wait, Write

# Centring, drilling and reaming (4.2 to 4.4, 4.6): cycles 240, 200, 201 and 203.

CYCLES = CycleTable(addresses=addresses.shared(feed=addresses.plunge_feed))
CENTRED: dict[float, str] = {0: "to the depth Q201", 1: "to the diameter Q344"}


class Hole(AtSurface):
    """A cycle that begins in the set-up plane over a hole."""

    def moves(self, m: Machine) -> Iterable[Step]:
        return [Go("to the set-up clearance", self.above), *self.steps(m)] if self.down else [self.left_out]

    def check(self, m: Machine) -> Iterator[ParameterFault]:
        yield from self.signs(m)
        if self.reference == 1:
            yield from planes.with_angle(m, "reference")
        yield from planes.not_zero(self, "feed", purpose="to drill with")
        if self.depth:
            yield from planes.less_than_depth(self, "start_depth", self.depth)
        if self.start_depth:
            yield from planes.not_zero(self, "positioning_feed", purpose="to reach the starting point")
        yield from too_many("infeed", lambda: self.pecks(m))


@CYCLES("CYCL DEF 240", "Centering", source="4.2")
class Centering(Hole):
    """Centres to a depth, or so deep that the point of the tool leaves a cone of a diameter on the surface."""

    clearance: float = addresses.clearance()
    mode: float = choice("Q343", "what the centring goes to", CENTRED, example=0)
    depth: float = addresses.depth(example=-3)
    diameter: float = coordinate("Q344", "diameter of the centring", note="negative is down; counts with Q343=1", example=-9)
    feed: float = addresses.plunge_feed()
    dwell_bottom: float = addresses.dwell_bottom()
    surface: float = addresses.surface()
    second_clearance: float = addresses.second_clearance()

    def depths(self) -> dict[str, float]:
        """What Q343 chooses: the sign of the diameter is a direction, too."""
        return {"diameter": self.diameter} if self.mode else {"depth": self.depth}

    def reach(self, m: Machine) -> float:
        if not self.mode:
            return self.depth
        return math.copysign(planes.point_length(abs(self.diameter) / 2, tool(m).angle), self.diameter)

    def check(self, m: Machine) -> Iterator[ParameterFault]:
        yield from self.signs(m)
        if self.mode:
            yield from planes.with_angle(m, "mode")
            if not is_round(m):
                yield "mode", "1 cannot run under unequal scales of the plane: a diameter would be two"
        yield from planes.not_zero(self, "feed", purpose="to drill with")

    def moves(self, m: Machine) -> Iterator[Step]:
        if self.mode and abs(self.diameter) > 2 * m.radius > 0:
            wider = f"wider than the tool, {2 * m.radius:.10g}: the cone ends at the tool's diameter"
            yield Say(f"Q344={self.diameter:.10g} is {wider}")
        yield from super().moves(m)

    def steps(self, m: Machine) -> Iterator[Step]:
        yield Go("centre", self.bottom(m), self.feed)
        yield Wait("dwell at the bottom", self.dwell_bottom)
        yield from self.leave()


@CYCLES(
    "CYCL DEF 200", "Drilling", source="4.3",
    takes="clearance depth feed infeed dwell_top surface second_clearance dwell_bottom reference",
)  # fmt: skip
class Drilling(Hole):
    """Drills in infeeds with full retraction to the set-up plane, a dwell after each infeed, and a rapid to the end plane."""

    dwell_bottom: float = addresses.dwell_bottom(default=0)  # older programs lack it

    def steps(self, m: Machine) -> Iterator[Step]:
        yield from holes.drill(
            self.pecks(m), above=self.above, feed=self.feed, reenter=self.clearance, dwell_top=self.dwell_top,
            dwell_each=self.dwell_bottom, dwell_bottom=self.dwell_bottom,
        )  # fmt: skip
        yield from self.leave()


@CYCLES("CYCL DEF 201", "Reaming", source="4.4", takes="clearance depth feed dwell_bottom retract_feed surface second_clearance")
class Reaming(Hole):
    """In and out at feed: a reamer does not leave its hole at rapid."""

    retract_feed: float = addresses.retract_feed(also=())

    def steps(self, m: Machine) -> Iterator[Step]:
        out = planes.rate(self.retract_feed, self.feed)
        yield from holes.ream(self.bottom(m), above=self.above, feed=self.feed, retract=out, dwell=self.dwell_bottom)
        yield from self.leave()


@CYCLES(
    "CYCL DEF 203", "Universal drilling", source="4.6",
    takes="clearance depth feed infeed dwell_top surface second_clearance decrement chip_breaks min_infeed dwell_bottom "
          "retract_feed break_retract reference",
)  # fmt: skip
class UniversalDrilling(Hole):
    """Drills with infeeds that may shrink; breaks the chip Q213 times before each full retraction.

    The infeed after the last chip break ends with the retraction, so Q213 + 1 infeeds lie between two of them. Back in the
    hole the rapid ends Q256 above the last depth, or Q200 above it where Q256 is 0.
    """

    chip_breaks: float = count("Q213", "chip breaks before each retraction", example=1)

    def steps(self, m: Machine) -> Iterator[Step]:
        yield from holes.drill(
            self.pecks(m), above=self.above, feed=self.feed, reenter=self.break_retract or self.clearance,
            withdraw=planes.rate(self.retract_feed, self.feed), dwell_top=self.dwell_top, dwell_bottom=self.dwell_bottom,
            breaks=int(self.chip_breaks), back=self.break_retract,
        )  # fmt: skip
        yield from self.leave()


# Boring, back boring and bore milling (4.5, 4.7, 4.9): cycles 202, 204 and 208.
# Both boring cycles stop the spindle at an angle; afterwards it turns as before the call, and the coolant is as it was.

def as_if_not_mirrored(m: Machine, steps: Iterable[Step]) -> Iterator[Step]:
    """Steps off the axis go where they would without a mirror image; shifts and rotations count (4.5, 4.7)."""
    plain = m.frames.copy()
    for name, _ in m.frames:
        if name.startswith(MIRROR):  # before the tilt or behind it
            plain.set(name, None)
    return with_the_spindle(m, steps, plain.matrix)


@CYCLES(
    "CYCL DEF 202", "Boring", source="4.5",
    takes="clearance depth feed dwell_bottom retract_feed surface second_clearance disengage spindle_angle",
)  # fmt: skip
class Boring(Hole):
    """Bores, stops the spindle at an angle, moves 0.2 mm off the wall and withdraws; ends on the axis of the hole."""

    def check(self, m: Machine) -> Iterator[ParameterFault]:
        yield from planes.oriented(m)
        yield from super().check(m)

    def steps(self, m: Machine) -> Iterator[Step]:
        yield Write("memory", self.spindle_angle, "orientation")
        bored = holes.bore(
            self.bottom(m), above=self.above, feed=self.feed, retract=planes.rate(self.retract_feed, self.feed),
            dwell=self.dwell_bottom, angle=self.spindle_angle, direction=int(self.disengage),
        )  # fmt: skip
        yield from as_if_not_mirrored(m, chain(bored, holes.back_to_axis(self.end, m.turning)))


@CYCLES("CYCL DEF 204", "Back boring", source="4.7")
class BackBoring(Hole):
    """Counterbores from below, with a bar that goes through the hole off its axis.

    Levels count for the lower end of the bar; its edge is Q252 above that.
    """

    does = SHIFTS
    clearance: float = addresses.clearance()
    counterbore_depth: float = increment(
        "Q249", "depth of the counterbore", note="from the lower surface; positive is up", example=5
    )
    thickness: float = distance("Q250", "thickness of the workpiece", at_least=0.0001, example=20)
    eccentricity: float = distance("Q251", "off-centre distance of the bar", at_least=0.0001, example=3.5)
    edge_height: float = distance("Q252", "height of the edge above the end of the bar", at_least=0.0001, example=15)
    positioning_feed: float | str = addresses.positioning_feed()
    feed: float = addresses.countersinking_feed(meaning="feed rate for counterboring", example=200)
    dwell_bottom: float = seconds("Q255", "dwell at the bottom of the counterbore", example=0.5)
    surface: float = addresses.surface()
    second_clearance: float = addresses.second_clearance()
    disengage: float = addresses.disengage(shift=True)
    spindle_angle: float = addresses.spindle_angle()

    def depths(self) -> dict[str, float]:
        """The counterbore goes up from below, but the bar comes from above as in every hole."""
        return {"counterbore_depth": -self.counterbore_depth}

    def check(self, m: Machine) -> Iterator[ParameterFault]:
        yield from planes.oriented(m)
        if self.counterbore_depth < 0:
            yield "counterbore_depth", f"must not be negative, got {self.counterbore_depth:g}"
        if self.counterbore_depth >= self.thickness:
            yield "counterbore_depth", f"must be less than Q250 = {self.thickness:g}, got {self.counterbore_depth:g}"
        yield from planes.not_zero(self, "feed", purpose="to bore with")
        yield from planes.not_zero(self, "positioning_feed", purpose="to position with")

    def steps(self, m: Machine) -> Iterator[Step]:
        yield Write("memory", self.spindle_angle, "orientation")
        lower = self.surface - self.thickness - self.edge_height
        bored = holes.back_bore(
            above=self.above, below=lower - self.clearance, bottom=lower + self.counterbore_depth,
            eccentricity=self.eccentricity, direction=int(self.disengage), angle=self.spindle_angle, feed=self.feed,
            travel=planes.rate(self.positioning_feed), dwell=self.dwell_bottom, turning=m.turning or 1,
            coolant=m.modal.get("coolant") == "M9",
        )  # fmt: skip
        yield from as_if_not_mirrored(m, chain(bored, holes.back_to_axis(self.end, m.turning)))


@CYCLES("CYCL DEF 208", "Bore milling", source="4.9")
class BoreMilling(Hole):
    """Mills a hole on a helix from the set-up plane, with a full circle at the bottom; as wide as the tool it drills it.

    The infeed per turn is reduced where the plunge angle of the tool (ANGLE) demands it. A mirrored plane does not change
    climb into up-cut milling.
    """

    does = MILLS
    clearance: float = addresses.clearance()
    depth: float = addresses.depth()
    feed: float = addresses.plunge_feed(also=("FAUTO", "FU", "FZ"))
    pitch: float = distance("Q334", "infeed per turn of the helix", example=1.5)
    surface: float = addresses.surface()
    second_clearance: float = addresses.second_clearance()
    diameter: float = length("Q335", "diameter of the bore", example=14)
    roughing_diameter: float = length(
        "Q342", "diameter roughed before", note="above 0 the bore may be wider than twice the tool", example=0
    )
    climb: float = addresses.milling_type(example=1)

    def check(self, m: Machine) -> Iterator[ParameterFault]:
        yield from super().check(m)
        size = 2 * m.radius
        if self.radius(m) < 0:
            yield "diameter", f"must be at least the tool diameter {size:g}, got {self.diameter:g}"
        if not self.roughing_diameter and self.diameter > 2 * size + DRIFT:
            yield "diameter", f"must be at most twice the tool diameter {size:g} while Q342 is 0, got {self.diameter:g}"
        if self.radius(m):
            yield from planes.not_zero(self, "pitch", purpose="to mill with")
            yield from too_many("pitch", lambda: holes.turns(self.clearance + abs(self.depth), self.pitch_on(m)))

    def radius(self, m: Machine) -> float:
        """Of the path of the tool centre; 0 where the bore is as wide as the tool."""
        radius = self.diameter / 2 - m.radius
        return 0.0 if abs(radius) < DRIFT else radius

    def pitch_on(self, m: Machine) -> float:
        """The infeed per turn that the tool allows."""
        return min(self.pitch, holes.steepest_pitch(self.radius(m), tool(m).plunge_angle))

    def steps(self, m: Machine) -> Iterator[Step]:
        pitch, sense = self.pitch_on(m), -1 if self.climb < 0 else 1
        if pitch < self.pitch and self.radius(m):
            allowed = f"the plunge angle {m.tool.plunge_angle:g} of tool {m.tool.number} allows {pitch:.4g}"
            yield Say(f"Q334 {self.pitch:g} is reduced: {allowed}", word=m.cycle and m.cycle.words.get("pitch"))
        yield from holes.bore_milling(
            self.bottom(m), above=self.above, radius=self.radius(m), pitch=pitch, sense=sense * m.orientation,
            feed=self.feed, by_arc=True,
        )  # fmt: skip
        yield from (step._replace(x=0.0, y=0.0) for step in self.leave())  # turns end near the axis, not on it


# Deep holes (4.8 and 4.10): universal pecking, 205, and single-lip deep-hole drilling, 241.
# Both may begin in a hole that is there already, Q379 deep: a long drill stays in its guide, see `machining.holes.guided`.

ENTRY: dict[float, str] = {3: "clockwise (M3)", 4: "counter-clockwise (M4)", 5: "stopped (M5)"}
TURNING = {3: 1, 4: -1, 5: 0}


def guide(c: AtSurface) -> holes.Guided:
    """Where drilling begins, and where chips are cleared."""
    return holes.guided(c.surface, c.start_depth, c.clearance, c.down)


@CYCLES(
    "CYCL DEF 205", "Universal pecking", source="4.8",
    takes="clearance depth feed infeed surface second_clearance decrement min_infeed first_stop last_stop break_every "
          "break_retract dwell_bottom start_depth positioning_feed retract_feed reference",
)  # fmt: skip
class UniversalPecking(Hole):
    """Drills in infeeds that may shrink, breaks the chip every Q257 within each, and clears the chips after it.

    Back in the hole the rapid stops above the last depth: by Q258 the first time, by Q259 the last, evenly between.
    """

    first_stop: float = addresses.first_stop(example=0.5)
    last_stop: float = distance("Q259", "lower advanced stop distance", example=1)
    break_every: float = addresses.break_every(meaning="infeed between chip breaks", note="0: no chip breaks", example=2)
    #: The cycle of the iTNC 530 had no Q208 at first and retracted at rapid: its programs still do.
    retract_feed: float | str | None = addresses.retract_feed(at_most=addresses.FAR, default=None, default_means="FMAX")

    def check(self, m: Machine) -> Iterator[ParameterFault]:
        yield from super().check(m)
        if self.break_every and self.break_retract:
            yield from planes.not_zero(self, "positioning_feed", purpose="to return after a chip break")
        yield from too_many("break_every", lambda: infeeds(self.begin, self.bottom(m), self.break_every))

    def steps(self, m: Machine) -> Iterator[Step]:
        levels, way = self.pecks(m), guide(self)
        out = RAPID if self.retract_feed is None else planes.rate(self.retract_feed, self.feed)
        yield Go("to the start of the drilling", way.start, planes.rate(self.positioning_feed))
        yield from holes.drill(
            levels, above=way.clear, start=self.begin, feed=self.feed, dwell_bottom=self.dwell_bottom,
            reenter=advanced_stops(self.first_stop, self.last_stop, len(levels) - 1), break_every=self.break_every,
            back=self.break_retract, back_feed=out, approach=planes.rate(self.positioning_feed),
        )  # fmt: skip
        yield from self.leave(out)


@CYCLES(
    "CYCL DEF 241", "Single-lip deep-hole drilling", source="4.10",
    takes="clearance depth feed dwell_bottom surface second_clearance start_depth positioning_feed retract_feed "
          "spindle_direction entry_speed drilling_speed coolant_on coolant_off dwell_depth factor infeed decrement min_infeed",
)  # fmt: skip
class SingleLipDrilling(Hole):
    """Drills deep with a single-lip drill: slow in and out, fast and with coolant while it cuts, no retraction between.

    The spindle is left as it turns on the way out. A dwell on the way lasts as long as the one at the bottom.
    """

    own_spindle = True
    spindle_direction: float = choice("Q426", "spindle when entering and leaving", ENTRY, example=3)
    entry_speed: float = count("Q427", "speed when entering and leaving", unit="rev/min", example=25)
    drilling_speed: float = count("Q428", "speed when drilling", unit="rev/min", example=500)
    coolant_on: float = count("Q429", "M function for coolant on", at_most=999, unit="choice", note="0: none", example=8)
    coolant_off: float = count("Q430", "M function for coolant off", at_most=999, unit="choice", note="0: none", example=9)
    dwell_depth: float = distance("Q435", "depth of a dwell on the way", default=0, note="0: none", example=10)
    factor: float = percent("Q401", "feed rate factor after the dwell", at_least=0, at_most=100, default=100, example=50)
    infeed: float | None = addresses.infeed(default=None, default_means="one pass")
    decrement: float = addresses.decrement(default=0)
    min_infeed: float = addresses.min_infeed(default=0)

    def check(self, m: Machine) -> Iterator[ParameterFault]:
        yield from super().check(m)
        known = [code for code, function in m.control.functions.items() if function.group == "coolant"]
        for name, number in (("coolant_on", self.coolant_on), ("coolant_off", self.coolant_off)):
            if number and f"M{number:g}" not in known:
                yield name, f"must switch the coolant ({', '.join(known)}) or be 0, got {number:g}"
        yield from planes.not_zero(self, "drilling_speed", purpose="to drill with")
        if self.dwell_depth and self.depth:
            yield from planes.less_than_depth(self, "dwell_depth", self.depth)
            start = self.down * (self.surface - guide(self).start)
            if self.dwell_depth <= start:
                yield "dwell_depth", f"must be more than {start:g}, where the drilling begins, got {self.dwell_depth:g}"
            yield from planes.not_zero(self, "factor", purpose="to drill on with")

    def steps(self, m: Machine) -> Iterator[Step]:
        way, out = guide(self), planes.rate(self.retract_feed, self.feed)
        on, off = (f"coolant M{code:g}" if code else "" for code in (self.coolant_on, self.coolant_off))
        yield from holes.gun_drill(
            self.pecks(m), above=way.clear, start=way.start, feed=self.feed, approach=planes.rate(self.positioning_feed),
            retract=out, entry=(TURNING[int(self.spindle_direction)], self.entry_speed), speed=self.drilling_speed,
            dwell=self.dwell_bottom, pause=self.surface - self.down * self.dwell_depth if self.dwell_depth else None,
            feed_after=self.feed * self.factor / 100, coolant=(on, off), cool_until_slow=True,
        )  # fmt: skip
        yield Go("retract", self.above, out)
        yield from self.leave()

    def moves(self, m: Machine) -> Iterator[Step]:
        yield from super().moves(m)
        if self.depth:
            yield Write("modal", f"M{self.spindle_direction:g}", "spindle")
            for code in filter(None, (self.coolant_on, self.coolant_off)):
                yield Write("modal", f"M{code:g}", "coolant")
