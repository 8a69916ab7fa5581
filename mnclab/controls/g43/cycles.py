"""Drilling and boring cycles: G73, G74, G76, G81 to G86, G89, until G80.

Of this chapter the source has only the title. The cycles are those that ISO controls have under these codes: over the
hole, at rapid to level R, the work down to Z, and back to the initial level (G98) or to level R (G99). Under G91, R counts
from the initial level and Z from level R. Z, R, F, and Q and P where they mean the same, hold from one cycle to the next
until G80, and so does the initial level.
"""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial

from mnclab.controls.g43.language.lengths import activate
from mnclab.controls.g43.remarks import ISO, undescribed
from mnclab.controls.g43.state import memory
from mnclab.controls.word_address import holes
from mnclab.machine.control import Words
from mnclab.machine.cycle import Cycle, CycleTable, Given, Values, param
from mnclab.machine.machine import Machine
from mnclab.machining.holes.drilling import bore_and_stop, drill, ream
from mnclab.machining.holes.tapping import tap
from mnclab.machining.steps import Step

CYCLES = CycleTable()

POSITION = "X Y Z R"

dwell = partial(param, "P", "dwell at the bottom, milliseconds", "ms", default=0, at_least=0, modal=True, example=500)
peck = partial(param, "Q", "depth of one peck", above=0, incremental=True, modal=True, example=5)


class HoleCycle(holes.AtHole, Cycle):
    """A cycle at a hole whose data hold from one cycle to the next."""

    shares = True
    dwell: float = 0.0

    @classmethod
    def prepare(cls, values: Values, given: Given, m: Machine, kept: Values) -> Values:
        """Increments become coordinates where they are programmed; offsets of the length compensation count from here on."""
        undescribed(m, Words((), cls.code))
        if not memory(m).machine_coordinates:
            activate(m, "XYZ")
        kept.setdefault("initial", m.to_machine(m.programmed)[2])
        if m.modal["dimension"] == "G91":
            for k, name in enumerate("xy"):
                if name in given:
                    values[name] += m.programmed[k]
            if "r_level" in given:
                values["r_level"] += holes.initial_level(m, kept)
            if "bottom" in given:
                kept["depth"] = values["bottom"]
            if values.get("r_level") is not None and "depth" in kept:
                values["bottom"] = values["r_level"] + kept["depth"]
        elif "bottom" in given:
            kept.pop("depth", None)
        holes.take_feed(m, values, given)
        return values

    @property
    def seconds(self) -> float:
        return self.dwell / 1000


@CYCLES("G81", "Drilling", runs="position", source=ISO, triggers=POSITION)
class Drilling(HoleCycle):
    """Drills in one pass."""

    x: float | None = holes.position("X", 20)
    y: float | None = holes.position("Y", 10)
    bottom: float = holes.bottom()
    r_level: float = holes.r_level()
    feed: float | None = holes.feed()

    def work(self, m: Machine) -> Iterator[Step]:
        return drill(self.levels(), above=self.r_level, feed=None, reenter=0)


@CYCLES("G82", "Counterboring", runs="position", source=ISO, triggers=POSITION)
class Counterboring(HoleCycle):
    """Drills in one pass and waits at the bottom."""

    x: float | None = holes.position("X", 20)
    y: float | None = holes.position("Y", 10)
    bottom: float = holes.bottom()
    r_level: float = holes.r_level()
    dwell: float = dwell()
    feed: float | None = holes.feed()

    def work(self, m: Machine) -> Iterator[Step]:
        return drill(self.levels(), above=self.r_level, feed=None, reenter=0, dwell_bottom=self.seconds)


@CYCLES("G83", "Deep-hole drilling", runs="position", source=ISO, triggers=POSITION)
class DeepHoleDrilling(HoleCycle):
    """Drills in pecks with withdrawal to level R."""

    x: float | None = holes.position("X", 20)
    y: float | None = holes.position("Y", 10)
    bottom: float = holes.bottom()
    r_level: float = holes.r_level()
    peck: float = peck()
    feed: float | None = holes.feed()

    def work(self, m: Machine) -> Iterator[Step]:
        return drill(self.levels(), above=self.r_level, feed=None, reenter=m.settings["peck_clearance"])


@CYCLES("G73", "Drilling with chip breaking", runs="position", source=ISO, triggers=POSITION)
class ChipBreaking(HoleCycle):
    """Drills in pecks and lifts a little between them."""

    x: float | None = holes.position("X", 20)
    y: float | None = holes.position("Y", 10)
    bottom: float = holes.bottom()
    r_level: float = holes.r_level()
    peck: float = peck()
    feed: float | None = holes.feed()

    def work(self, m: Machine) -> Iterator[Step]:
        levels, back = self.levels(), m.settings["peck_clearance"]
        return drill(levels, above=self.r_level, feed=None, reenter=0, breaks=len(levels), back=back)


@CYCLES("G84", "Tapping, right-hand", runs="position", source=ISO, triggers=POSITION)
class RightTapping(HoleCycle):
    """Taps a right-hand thread; the pitch is the feed per revolution, or F over S."""

    x: float | None = holes.position("X", 20)
    y: float | None = holes.position("Y", 10)
    bottom: float = holes.bottom()
    r_level: float = holes.r_level()
    dwell: float = dwell()
    feed: float | None = holes.feed()
    needs = (holes.no_pitch,)

    def work(self, m: Machine) -> Iterator[Step]:
        return thread(m, self, sense=1)


@CYCLES("G74", "Tapping, left-hand", runs="position", source=ISO, triggers=POSITION)
class LeftTapping(HoleCycle):
    """Taps a left-hand thread; the pitch is the feed per revolution, or F over S."""

    x: float | None = holes.position("X", 20)
    y: float | None = holes.position("Y", 10)
    bottom: float = holes.bottom()
    r_level: float = holes.r_level()
    dwell: float = dwell()
    feed: float | None = holes.feed()
    needs = (holes.no_pitch,)

    def work(self, m: Machine) -> Iterator[Step]:
        return thread(m, self, sense=-1)


def thread(m: Machine, cycle: HoleCycle, sense: int) -> Iterator[Step]:
    """Cut with the spindle turning one way, back with the other."""
    pitch = m.feed_of(None) / abs(m.speed)
    return tap([cycle.bottom], above=cycle.r_level, pitch=pitch, sense=sense, end=sense, dwell=cycle.seconds)


@CYCLES("G85", "Boring, feed out", runs="position", source=ISO, triggers=POSITION)
class Reaming(HoleCycle):
    """In and out at feed."""

    x: float | None = holes.position("X", 20)
    y: float | None = holes.position("Y", 10)
    bottom: float = holes.bottom()
    r_level: float = holes.r_level()
    feed: float | None = holes.feed()

    def work(self, m: Machine) -> Iterator[Step]:
        return ream(self.bottom, above=self.r_level, feed=None, retract=None)


@CYCLES("G89", "Boring, dwell, feed out", runs="position", source=ISO, triggers=POSITION)
class DwellReaming(HoleCycle):
    """In at feed, a dwell, out at feed."""

    x: float | None = holes.position("X", 20)
    y: float | None = holes.position("Y", 10)
    bottom: float = holes.bottom()
    r_level: float = holes.r_level()
    dwell: float = dwell()
    feed: float | None = holes.feed()

    def work(self, m: Machine) -> Iterator[Step]:
        return ream(self.bottom, above=self.r_level, feed=None, retract=None, dwell=self.seconds)


@CYCLES("G86", "Boring, spindle stop, rapid out", runs="position", source=ISO, triggers=POSITION)
class StoppedBoring(HoleCycle):
    """In at feed, spindle stop, out at rapid."""

    x: float | None = holes.position("X", 20)
    y: float | None = holes.position("Y", 10)
    bottom: float = holes.bottom()
    r_level: float = holes.r_level()
    dwell: float = dwell()
    feed: float | None = holes.feed()
    needs = (holes.spindle_stands,)

    def work(self, m: Machine) -> Iterator[Step]:
        return bore_and_stop(self.bottom, above=self.r_level, dwell=self.seconds, turning=m.turning)


@CYCLES("G76", "Fine boring", runs="position", source=ISO, triggers=POSITION)
class FineBoring(HoleCycle):
    """In at feed, oriented spindle stop, away from the wall by Q along -X, out at rapid, back to the axis."""

    x: float | None = holes.position("X", 20)
    y: float | None = holes.position("Y", 10)
    bottom: float = holes.bottom()
    r_level: float = holes.r_level()
    shift: float = param("Q", "shift off the wall", above=0, incremental=True, modal=True, example=0.2)
    dwell: float = dwell()
    feed: float | None = holes.feed()
    needs = (holes.spindle_stands,)

    def work(self, m: Machine) -> Iterator[Step]:
        shift, turning = self.shift, m.turning
        return bore_and_stop(self.bottom, above=self.r_level, dwell=self.seconds, turning=turning, shift=shift)
