"""Drilling and boring cycles: G73, G74, G76, G81 to G89, until G80.

Of this chapter the source has only the title. The cycles are those that ISO controls have under these codes: over the
hole, at rapid to level R, the work down to Z, and back to the initial level (G98) or to level R (G99). Under G91, R counts
from the initial level and Z from level R. Z, R, F, and Q and P where they mean the same, hold from one cycle to the next
until G80, and so does the initial level. K or L is the number of holes, each by X and Y of the block further under G91;
without holes (K0), or in a block without X, Y, Z and R, the data are kept for later blocks.
"""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial

import numpy as np

from mnclab.controls.g43.language import polar
from mnclab.controls.g43.language.lengths import activate
from mnclab.controls.g43.language.numbers import seconds_of_p
from mnclab.controls.g43.remarks import ISO, undescribed
from mnclab.controls.g43.state import memory
from mnclab.controls.word_address import holes
from mnclab.machine.control import Words
from mnclab.machine.cycle import Cycle, CycleTable, Given, Values, param
from mnclab.machine.machine import Machine
from mnclab.machining.holes.drilling import back_bore, back_to_axis, bore_and_stop, drill, ream
from mnclab.machining.holes.tapping import tap
from mnclab.machining.steps import RAPID, Each, Go, Step, moved

CYCLES = CycleTable()
MOST_HOLES = 9999  # of one block

POSITION = "X Y Z R"

dwell = partial(param, "P", "dwell at the bottom, milliseconds", "ms", default=0, at_least=0, modal=True, example=500)
repeats = partial(
    param, ("K", "L"), "number of holes", "", default=1, type="integer", at_least=0, at_most=MOST_HOLES, example=1
)
peck = partial(param, "Q", "depth of one peck", above=0, incremental=True, modal=True, example=5)


def initial_level_alone(m: Machine) -> Iterator[tuple[str, str]]:
    """A fault where a cycle that cannot stay at level R is to do so."""
    if m.modal["return"] == "G99":
        yield "", "always comes back to the initial level: write G98"


class HoleCycle(holes.AtHole, Cycle):
    """A cycle at a hole whose data hold from one cycle to the next."""

    shares = True
    dwell: float = 0.0
    repeats: float = 1

    @classmethod
    def prepare(cls, values: Values, given: Given, m: Machine, kept: Values) -> Values:
        """Increments become coordinates where they are programmed; offsets of the length compensation count from here on."""
        undescribed(m, Words((), cls.code))
        if not memory(m).machine_coordinates:
            activate(m, "XYZ")
        kept.setdefault("initial", m.to_machine(m.programmed)[2])
        kept["step"] = (0.0, 0.0)
        kept["points"] = None
        if given.keys().isdisjoint(("x", "y", "bottom", "r_level")):
            values["repeats"] = 0
        if "dwell" in given:
            values["dwell"] *= 1000 * seconds_of_p(m, given["dwell"])
        if memory(m).polar is not None:
            polar.holes(m, values, given, kept)
        if m.modal["dimension"] == "G91":
            if memory(m).polar is None:
                kept["step"] = values.get("x", 0.0), values.get("y", 0.0)
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

    def about(self, m: Machine) -> tuple[float, float]:
        return super().about(m) if self.repeats == 1 else (0.0, 0.0)

    def moves(self, m: Machine) -> Iterator[Step]:
        if self.repeats == 1:
            return self.hole(m)
        assert m.position_cycle is not None
        first, step = np.array(super().about(m)), np.array(m.position_cycle.extra["step"])
        points = m.position_cycle.extra["points"]
        if points is None:
            points = first + np.arange(self.repeats)[:, None] * step
        return iter([Each(points, lambda x, y: moved(self.hole(m), x, y))])

    def hole(self, m: Machine) -> Iterator[Step]:
        """The way over a hole, the work, and the way up."""
        return super().moves(m)

    def approach(self, m: Machine) -> Iterator[Step]:
        assert m.position_cycle is not None
        way, level = m.settings["below_r"], m.programmed[2]
        straight = way == "straight"
        if straight and holes.initial_level(m, m.position_cycle.extra) < self.r_level:
            yield Go("to level R", self.r_level)
            yield self.across()
        elif level < self.r_level and way != "up":
            yield self.across()._replace(z=self.r_level if straight else None)
            yield Go("to level R", self.r_level)
        else:
            yield from super().approach(m)

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
    repeats: float = repeats()

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
    repeats: float = repeats()

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
    repeats: float = repeats()

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
    repeats: float = repeats()

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
    repeats: float = repeats()
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
    repeats: float = repeats()
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
    repeats: float = repeats()

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
    repeats: float = repeats()

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
    repeats: float = repeats()
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
    repeats: float = repeats()
    needs = (holes.spindle_stands,)

    def work(self, m: Machine) -> Iterator[Step]:
        shift, turning = self.shift, m.turning
        return bore_and_stop(self.bottom, above=self.r_level, dwell=self.seconds, turning=turning, shift=shift)


@CYCLES("G87", "Back boring", runs="position", source=f"{ISO}; FANUC", triggers=POSITION)
class BackBoring(HoleCycle):
    """Off the axis by Q along -X with the spindle oriented, at rapid through the hole to level R, on the axis again up to Z.

    R lies below Z. The tool always comes back to the initial level, the way it came.
    """

    x: float | None = holes.position("X", 20)
    y: float | None = holes.position("Y", 10)
    bottom: float = param("Z", "depth of the counterbore from below", modal=True, example=-10)
    r_level: float = param("R", "level R, below the workpiece", modal=True, example=-25)
    shift: float = param("Q", "shift off the axis", above=0, incremental=True, modal=True, example=0.2)
    dwell: float = dwell()
    feed: float | None = holes.feed()
    repeats: float = repeats()
    needs = (holes.spindle_stands, initial_level_alone)

    def contradictions(self) -> Iterator[tuple[str, str]]:
        if not self.bottom > self.r_level:
            yield "bottom", f"must lie above level R, got Z {self.bottom:g} and R {self.r_level:g}"

    def hole(self, m: Machine) -> Iterator[Step]:
        yield Go("to the hole", x=0.0, y=0.0)
        yield from self.work(m)

    def work(self, m: Machine) -> Iterator[Step]:
        above, turning = m.programmed[2], m.turning
        yield from back_bore(
            above=above, below=self.r_level, bottom=self.bottom, eccentricity=self.shift, direction=1, angle=0.0,
            feed=None, travel=RAPID, dwell=self.seconds, turning=turning, leave=False,
        )  # fmt: skip
        yield from back_to_axis(above, turning)


@CYCLES("G88", "Boring, spindle stop, out by hand", runs="position", source=f"{ISO}; FANUC", triggers=POSITION)
class HandBoring(HoleCycle):
    """In at feed, spindle stop, program stop: the operator draws the tool out, and the program goes on above the hole."""

    x: float | None = holes.position("X", 20)
    y: float | None = holes.position("Y", 10)
    bottom: float = holes.bottom()
    r_level: float = holes.r_level()
    dwell: float = dwell()
    feed: float | None = holes.feed()
    repeats: float = repeats()
    needs = (holes.spindle_stands,)

    def work(self, m: Machine) -> Iterator[Step]:
        return bore_and_stop(self.bottom, above=self.r_level, dwell=self.seconds, turning=m.turning, by_hand=True)
