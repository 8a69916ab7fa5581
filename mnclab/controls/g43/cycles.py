"""Drilling and boring cycles: G73, G74, G76, G81 to G86, G89, until G80.

Of this chapter the source has only the title. The cycles are those that ISO controls have under these codes: over the
hole, at rapid to level R, the work down to Z, and back to the initial level (G98) or to level R (G99). Under G91, R counts
from the initial level and Z from level R. Z, R, F, and Q and P where they mean the same, hold from one cycle to the next
until G80, and so does the initial level. The steps are those of the cycles of other controls.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from typing import Any

from mnclab.controls.g43.language import ISO, undescribed
from mnclab.controls.g43.lengths import activate
from mnclab.controls.g43.state import memory
from mnclab.controls.word_address.holes import (
    approach,
    initial_level,
    leave,
    no_pitch,
    out_of_place,
    spindle_stands,
    upside_down,
)
from mnclab.machine.control import FunctionTable, Words
from mnclab.machine.cycle import Cycle, CycleTable, param, too_many
from mnclab.machine.machine import Machine
from mnclab.machining.depths import infeeds
from mnclab.machining.holes.drilling import bore_and_stop, drill, ream
from mnclab.machining.holes.tapping import tap
from mnclab.machining.steps import Step
from mnclab.running.performing import perform
from mnclab.text.program import Word

FUNCTIONS = FunctionTable()
CYCLES = CycleTable()

RETURN = {"G98": "Return to the initial level", "G99": "Return to level R"}
POSITION = "X Y Z R"


@FUNCTIONS("G80", "Drilling cycle off", group="cycle", phase="plane", power_on="G80", ends_cycle=True, source=ISO)
def cycle_off(m: Machine, words: Words) -> None:
    """Ends the cycle."""
    m.position_cycle = None


@FUNCTIONS("G98 G99", RETURN, group="return", phase="plane", power_on="G98", source=ISO)
def return_level(m: Machine, words: Words) -> None:
    """Where a drilling cycle leaves the tool."""


@dataclass(frozen=True)
class HoleCycle(Cycle, ABC):
    """What all cycles share: the hole, its levels and the feed."""

    shares = True

    x: float | None = param(
        "X", "hole position along X", default=None, default_means="the present point",
        note="under G91 from the present point", example=20,
    )  # fmt: skip
    y: float | None = param(
        "Y", "hole position along Y", default=None, default_means="the present point",
        note="under G91 from the present point", example=10,
    )  # fmt: skip
    bottom: float = param("Z", "bottom of the hole", modal=True, note="under G91 from level R", example=-20)
    r_level: float = param("R", "level R", modal=True, note="under G91 from the initial level", example=2)
    feed: float | None = param(
        "F", "feed rate", "mm/min", default=None, default_means="the modal feed", above=0, modal=True, example=120
    )

    @classmethod
    def prepare(
        cls, values: dict[str, Any], given: Mapping[str, Word], m: Machine, kept: dict[str, Any]
    ) -> dict[str, Any]:
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
                values["r_level"] += initial_level(m, kept)
            if "bottom" in given:
                kept["depth"] = values["bottom"]
            if values.get("r_level") is not None and "depth" in kept:
                values["bottom"] = values["r_level"] + kept["depth"]
        elif "bottom" in given:
            kept.pop("depth", None)
        if "feed" in given and values["feed"] > 0:
            m.change("feed", values["feed"])
        return values

    def contradictions(self) -> Iterator[tuple[str, str]]:
        """The bottom lies below level R."""
        yield from upside_down(self.bottom, self.r_level)

    def check(self, m: Machine) -> Iterator[tuple[str, str]]:
        """No radius compensation, no machine coordinates."""
        yield from out_of_place(m)

    def moves(self, m: Machine) -> None:
        """Over the hole, level R, the work, and up."""
        approach(m, self.code, self.x, self.y, self.r_level)
        perform(m, self.code, self.work(m))
        leave(m, self.code, self.r_level)

    @abstractmethod
    def work(self, m: Machine) -> Iterable[Step]:
        """The steps from level R and back to it."""


@CYCLES("G81", "Drilling", runs="position", source=ISO, triggers=POSITION)
class Drilling(HoleCycle):
    """Drills in one pass."""

    def work(self, m: Machine) -> Iterable[Step]:
        return drill([self.bottom], above=self.r_level, feed=None, reenter=0)


@dataclass(frozen=True)
class Dwelling(HoleCycle):
    """A cycle that waits at the bottom."""

    dwell: float = param("P", "dwell at the bottom, milliseconds", "ms", default=0, at_least=0, modal=True, example=500)

    @property
    def seconds(self) -> float:
        """The dwell, s."""
        return self.dwell / 1000


@CYCLES("G82", "Counterboring", runs="position", source=ISO, triggers=POSITION)
class Counterboring(Dwelling):
    """Drills in one pass and waits at the bottom."""

    def work(self, m: Machine) -> Iterable[Step]:
        return drill([self.bottom], above=self.r_level, feed=None, reenter=0, dwell_bottom=self.seconds)


@dataclass(frozen=True)
class Pecking(HoleCycle):
    """A cycle that drills in pecks."""

    peck: float = param("Q", "depth of one peck", above=0, incremental=True, modal=True, example=5)

    def contradictions(self) -> Iterator[tuple[str, str]]:
        """As all cycles; and no more pecks than a hole can have."""
        yield from super().contradictions()
        yield from too_many("peck", self.levels)

    def levels(self) -> tuple[float, ...]:
        """Pecks count from level R."""
        return infeeds(self.r_level, self.bottom, self.peck)


@CYCLES("G83", "Deep-hole drilling", runs="position", source=ISO, triggers=POSITION)
class DeepHoleDrilling(Pecking):
    """Drills in pecks with withdrawal to level R."""

    def work(self, m: Machine) -> Iterable[Step]:
        return drill(self.levels(), above=self.r_level, feed=None, reenter=m.settings["peck_clearance"])


@CYCLES("G73", "Drilling with chip breaking", runs="position", source=ISO, triggers=POSITION)
class ChipBreaking(Pecking):
    """Drills in pecks and lifts a little between them."""

    def work(self, m: Machine) -> Iterable[Step]:
        levels, back = self.levels(), m.settings["peck_clearance"]
        return drill(levels, above=self.r_level, feed=None, reenter=0, breaks=len(levels), back=back)


@dataclass(frozen=True)
class Tapping(Dwelling):
    """A cycle that taps; the pitch is the feed per revolution, or F over S."""

    def check(self, m: Machine) -> Iterator[tuple[str, str]]:
        """As all cycles; and the spindle turns."""
        yield from super().check(m)
        yield from no_pitch(m)

    def thread(self, m: Machine, sense: int) -> Iterable[Step]:
        """Cut with the spindle turning one way, back with the other."""
        pitch = m.feed_of(None) / abs(m.speed)
        return tap([self.bottom], above=self.r_level, pitch=pitch, sense=sense, end=sense, dwell=self.seconds)


@CYCLES("G84", "Tapping, right-hand", runs="position", source=ISO, triggers=POSITION)
class RightTapping(Tapping):
    """Taps a right-hand thread."""

    def work(self, m: Machine) -> Iterable[Step]:
        return self.thread(m, 1)


@CYCLES("G74", "Tapping, left-hand", runs="position", source=ISO, triggers=POSITION)
class LeftTapping(Tapping):
    """Taps a left-hand thread."""

    def work(self, m: Machine) -> Iterable[Step]:
        return self.thread(m, -1)


@CYCLES("G85", "Boring, feed out", runs="position", source=ISO, triggers=POSITION)
class Reaming(HoleCycle):
    """In and out at feed."""

    def work(self, m: Machine) -> Iterable[Step]:
        return ream(self.bottom, above=self.r_level, feed=None, retract=None)


@CYCLES("G89", "Boring, dwell, feed out", runs="position", source=ISO, triggers=POSITION)
class DwellReaming(Dwelling):
    """In at feed, a dwell, out at feed."""

    def work(self, m: Machine) -> Iterable[Step]:
        return ream(self.bottom, above=self.r_level, feed=None, retract=None, dwell=self.seconds)


@dataclass(frozen=True)
class Boring(Dwelling):
    """A cycle that stops the spindle at the bottom."""

    def check(self, m: Machine) -> Iterator[tuple[str, str]]:
        """As all cycles; and the spindle turns."""
        yield from super().check(m)
        yield from spindle_stands(m)


@CYCLES("G86", "Boring, spindle stop, rapid out", runs="position", source=ISO, triggers=POSITION)
class StoppedBoring(Boring):
    """In at feed, spindle stop, out at rapid."""

    def work(self, m: Machine) -> Iterable[Step]:
        return bore_and_stop(self.bottom, above=self.r_level, dwell=self.seconds, turning=m.turning)


@CYCLES("G76", "Fine boring", runs="position", source=ISO, triggers=POSITION)
class FineBoring(Boring):
    """In at feed, oriented spindle stop, away from the wall by Q along -X, out at rapid, back to the axis."""

    shift: float = param("Q", "shift off the wall", above=0, incremental=True, modal=True, example=0.2)

    def work(self, m: Machine) -> Iterable[Step]:
        return bore_and_stop(self.bottom, above=self.r_level, dwell=self.seconds, turning=m.turning, shift=self.shift)
