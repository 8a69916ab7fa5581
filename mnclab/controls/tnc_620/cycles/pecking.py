"""Deep holes (4.8 and 4.10): universal pecking, 205, and single-lip deep-hole drilling, 241.

Both may begin in a hole that is there already, Q379 deep: a long drill stays in its guide, see `machining.holes.guided`.
"""

from __future__ import annotations

from collections.abc import Iterator

from mnclab.controls.tnc_620.cycles import addresses
from mnclab.controls.tnc_620.cycles.addresses import choice, count, distance, percent
from mnclab.controls.tnc_620.cycles.faults import Fault, less_than_depth, not_zero
from mnclab.controls.tnc_620.cycles.planes import AtSurface, rate
from mnclab.machine.cycle import CycleTable, too_many
from mnclab.machine.machine import Machine
from mnclab.machining.depths import advanced_stops, infeeds
from mnclab.machining.holes.drilling import Guided, drill, guided, gun_drill
from mnclab.machining.steps import RAPID, Go, Step, Write

CYCLES = CycleTable()
ENTRY: dict[float, str] = {3: "clockwise (M3)", 4: "counter-clockwise (M4)", 5: "stopped (M5)"}
TURNING = {3: 1, 4: -1, 5: 0}


def guide(c: AtSurface) -> Guided:
    """Where drilling begins, and where chips are cleared."""
    return guided(c.surface, c.start_depth, c.clearance, c.down)


@CYCLES("CYCL DEF 205", "Universal pecking", source="4.8")
class UniversalPecking(AtSurface):
    """Drills in infeeds that may shrink, breaks the chip every Q257 within each, and clears the chips after it.

    Back in the hole the rapid stops above the last depth: by Q258 the first time, by Q259 the last, evenly between.
    """

    clearance: float = addresses.clearance()
    depth: float = addresses.depth()
    feed: float = addresses.plunge_feed()
    infeed: float = addresses.infeed()
    surface: float = addresses.surface()
    second_clearance: float = addresses.second_clearance()
    decrement: float = addresses.decrement()
    min_infeed: float = addresses.min_infeed()
    first_stop: float = addresses.first_stop(example=0.5)
    last_stop: float = distance("Q259", "lower advanced stop distance", example=1)
    break_every: float = addresses.break_every(meaning="infeed between chip breaks", note="0: no chip breaks", example=2)
    break_retract: float = addresses.break_retract()
    dwell_bottom: float = addresses.dwell_bottom()
    start_depth: float = addresses.start_depth()
    positioning_feed: float | str = addresses.positioning_feed()
    #: The cycle of the iTNC 530 had no Q208 at first and retracted at rapid: its programs still do.
    retract_feed: float | str | None = addresses.retract_feed(at_most=addresses.FAR, default=None, default_means="FMAX")
    reference: float = addresses.reference()

    def check(self, m: Machine) -> Iterator[Fault]:
        yield from super().check(m)
        if self.break_every and self.break_retract:
            yield from not_zero(self, "positioning_feed", purpose="to return after a chip break")
        yield from too_many("break_every", lambda: infeeds(self.begin, self.bottom(m), self.break_every))

    def steps(self, m: Machine) -> Iterator[Step]:
        levels, way = self.pecks(m), guide(self)
        out = RAPID if self.retract_feed is None else rate(self.retract_feed, self.feed)
        yield Go("to the start of the drilling", way.start, rate(self.positioning_feed))
        yield from drill(
            levels, above=way.clear, start=self.begin, feed=self.feed, dwell_bottom=self.dwell_bottom,
            reenter=advanced_stops(self.first_stop, self.last_stop, len(levels) - 1), break_every=self.break_every,
            back=self.break_retract, back_feed=out, approach=rate(self.positioning_feed),
        )  # fmt: skip
        yield from self.leave(out)


@CYCLES("CYCL DEF 241", "Single-lip deep-hole drilling", source="4.10")
class SingleLipDrilling(AtSurface):
    """Drills deep with a single-lip drill: slow in and out, fast and with coolant while it cuts, no retraction between.

    The spindle is left as it turns on the way out. A dwell on the way lasts as long as the one at the bottom.
    """

    own_spindle = True
    clearance: float = addresses.clearance()
    depth: float = addresses.depth()
    feed: float = addresses.plunge_feed()
    dwell_bottom: float = addresses.dwell_bottom()
    surface: float = addresses.surface()
    second_clearance: float = addresses.second_clearance()
    start_depth: float = addresses.start_depth()
    positioning_feed: float | str = addresses.positioning_feed()
    retract_feed: float | str = addresses.retract_feed()
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

    def check(self, m: Machine) -> Iterator[Fault]:
        yield from super().check(m)
        known = [code for code, function in m.control.functions.items() if function.group == "coolant"]
        for name, number in (("coolant_on", self.coolant_on), ("coolant_off", self.coolant_off)):
            if number and f"M{number:g}" not in known:
                yield name, f"must switch the coolant ({', '.join(known)}) or be 0, got {number:g}"
        yield from not_zero(self, "drilling_speed", purpose="to drill with")
        if self.dwell_depth and self.depth:
            yield from less_than_depth(self, "dwell_depth", self.depth)
            start = self.down * (self.surface - guide(self).start)
            if self.dwell_depth <= start:
                yield "dwell_depth", f"must be more than {start:g}, where the drilling begins, got {self.dwell_depth:g}"
            yield from not_zero(self, "factor", purpose="to drill on with")

    def steps(self, m: Machine) -> Iterator[Step]:
        way, out = guide(self), rate(self.retract_feed, self.feed)
        on, off = (f"coolant M{code:g}" if code else "" for code in (self.coolant_on, self.coolant_off))
        yield from gun_drill(
            self.pecks(m), above=way.clear, start=way.start, feed=self.feed, approach=rate(self.positioning_feed),
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
