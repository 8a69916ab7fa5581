"""Fixed cycles (MNC, 9.1 to 9.3): G83, G84 and G85 run at each following position, until G80.

The hole lies along Z whatever the plane. z_init is the level where the tool stood at the first call, z_R level R, z_b the
bottom.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any, ClassVar

from mnclab.controls.word_address.holes import approach, initial_level, leave, no_pitch, out_of_place, upside_down
from mnclab.machine.control import FunctionTable, Words
from mnclab.machine.cycle import Cycle, CycleTable, param, too_many
from mnclab.machine.machine import Machine
from mnclab.machine.true_size import TAPS, depth_scale
from mnclab.machining.depths import infeeds
from mnclab.machining.holes.drilling import drill, ream
from mnclab.machining.holes.tapping import tap
from mnclab.running.performing import perform
from mnclab.text.program import Word

FUNCTIONS = FunctionTable()
CYCLES = CycleTable()

RETURN = {"G98": "Return to the initial level", "G99": "Return to level R"}
POSITION = "X Y U V Z W R"


@FUNCTIONS("G80", "Fixed cycle off", group="cycle", phase="plane", power_on="G80", ends_cycle=True, source="9")
def cycle_off(m: Machine, words: Words) -> None:
    """Ends G83, G84 and G85, and forgets a prepared cycle."""
    m.position_cycle = m.cycle = None


@FUNCTIONS("G98 G99", RETURN, group="return", phase="plane", power_on="G98", source="9")
def return_level(m: Machine, words: Words) -> None:
    """Where a fixed cycle leaves the tool; the prepared cycles always end at their start point."""


@dataclass(frozen=True)
class FixedCycle(Cycle):
    """What G83, G84 and G85 share: hole position and levels, of which Z (or W), R and F are modal."""

    x: float | None = param(
        "X", "hole position along X", default=None, default_means="the present point",
        note="under G91 from the present point", example=20,
    )  # fmt: skip
    x_increment: float | None = param(
        "U", "increment to the hole along X", default=None, instead="x", incremental=True, example=15
    )
    y: float | None = param(
        "Y", "hole position along Y", default=None, default_means="the present point",
        note="under G91 from the present point", example=10,
    )  # fmt: skip
    y_increment: float | None = param(
        "V", "increment to the hole along Y", default=None, instead="y", incremental=True, example=10
    )
    bottom: float = param(
        "Z", "bottom of the hole", instead="depth_from_r", modal=True, note="under G91 from level R, signed", example=-20
    )  # fmt: skip
    depth_from_r: float | None = param(
        "W", "depth below level R", default=None, instead="bottom", above=0, incremental=True, modal=True, example=22
    )
    r_level: float = param("R", "level R", modal=True, note="under G91 from the initial level, signed", example=2)
    dwell: float = param("P", "dwell at the bottom", "s", default=0, at_least=0, example=0.5)
    feed: float | None = param(
        "F", "feed rate", "mm/min", default=None, default_means="the modal feed", above=0, modal=True, example=120
    )

    @classmethod
    def prepare(
        cls, values: dict[str, Any], given: Mapping[str, Word], m: Machine, kept: dict[str, Any]
    ) -> dict[str, Any]:
        """Levels are worked out when they are programmed: bottom and r_level become coordinates, x and y the hole."""
        for one, other in (("x", "x_increment"), ("y", "y_increment"), ("bottom", "depth_from_r")):
            if one in given and other in given:
                both = f"{given[one].address} and {given[other].address}"
                m.alarm(f"{cls.code} {both} stand in one block", given[other])
        absolute = m.modal["dimension"] == "G90"
        kept.setdefault("initial", m.tip[2])  # of the machine: a new datum does not move it
        initial = initial_level(m, kept)
        for axis, (one, other) in enumerate((("x", "x_increment"), ("y", "y_increment"))):
            if other in given:
                values[one] = m.programmed[axis] + values[other]
            elif one in given and not absolute:
                values[one] += m.programmed[axis]
        known = values.get("bottom") is not None and values.get("r_level") is not None
        depth = kept.get("depth") if known else None
        if "r_level" in given and not absolute:
            values["r_level"] += initial
        if "depth_from_r" in given:
            kept["depth"] = depth = values["depth_from_r"]
        elif "bottom" in given:
            kept["depth"] = depth = None if absolute else -values["bottom"]
        if depth is not None and values.get("r_level") is not None:
            values["bottom"] = values["r_level"] - depth
        if values.get("depth_from_r") is not None and not values["depth_from_r"] > 0:
            return values  # refused by its limit
        if values.get("bottom") is not None:
            values["depth_from_r"] = None
        if "feed" in given and values["feed"] > 0:
            m.change("feed", values["feed"])  # stays the modal feed afterwards
        return values

    def contradictions(self) -> Iterator[tuple[str, str]]:
        """The bottom lies below level R."""
        yield from upside_down(self.bottom, self.r_level)

    def check(self, m: Machine) -> Iterator[tuple[str, str]]:
        """No radius compensation, no machine coordinates."""
        yield from out_of_place(m)


@CYCLES("G83", "Deep-hole drilling", runs="position", source="MNC 9.1", triggers=POSITION)
class DeepHoleDrilling(FixedCycle):
    """Drills at each position with rapid withdrawal to level R after every peck, until G80."""

    peck_depth: float | None = param(
        "K", "depth of one peck", default=None, default_means="one pass", above=0, incremental=True, example=5
    )

    @classmethod
    def prepare(
        cls, values: dict[str, Any], given: Mapping[str, Word], m: Machine, kept: dict[str, Any]
    ) -> dict[str, Any]:
        """The first hole without K after one with K is remarked on: K is not modal."""
        if "peck_depth" not in given and kept.get("pecked"):
            fault = "G83 K (depth of one peck) is not modal: this hole is drilled in one pass"
            m.warn(fault, None, "write K for each hole")
        kept["pecked"] = "peck_depth" in given
        return super().prepare(values, given, m, kept)

    def contradictions(self) -> Iterator[tuple[str, str]]:
        """As all fixed cycles; and no more pecks than a hole can have."""
        yield from super().contradictions()
        yield from too_many("peck_depth", self.levels)

    def levels(self) -> tuple[float, ...]:
        """Pecks count from level R."""
        return infeeds(self.r_level, self.bottom, self.peck_depth)

    def moves(self, m: Machine) -> None:
        """Position, level R, pecks, dwell, and up."""
        approach(m, self.code, self.x, self.y, self.r_level)
        clearance = m.settings["peck_clearance"] / depth_scale(m)  # of the control, no length of the program
        steps = drill(self.levels(), above=self.r_level, feed=None, reenter=clearance, dwell_bottom=self.dwell)
        perform(m, self.code, steps)
        leave(m, self.code, self.r_level)


@CYCLES("G84", "Tapping", runs="position", source="MNC 9.2", triggers=POSITION)
class Tapping(FixedCycle):
    """Taps at each position with the spindle as it turns, reversed at the bottom and again at level R, until G80."""

    does: ClassVar[str] = TAPS

    def check(self, m: Machine) -> Iterator[tuple[str, str]]:
        """As all fixed cycles; and the spindle turns."""
        yield from super().check(m)
        yield from no_pitch(m)

    def moves(self, m: Machine) -> None:
        """The cycle runs at a feed per revolution; F in mm/min is divided by the speed."""
        approach(m, self.code, self.x, self.y, self.r_level)
        pitch = m.feed_of(None) / abs(m.speed)
        steps = tap(
            [self.bottom], above=self.r_level, pitch=pitch, sense=m.turning, end=m.turning, dwell=self.dwell
        )  # fmt: skip
        perform(m, self.code, steps)
        leave(m, self.code, self.r_level)


@CYCLES("G85", "Boring and reaming", runs="position", source="MNC 9.3", triggers=POSITION)
class Reaming(FixedCycle):
    """Reams or bores at each position, in and out at feed, until G80."""

    def moves(self, m: Machine) -> None:
        """Position, level R, in at feed, dwell, out at feed."""
        approach(m, self.code, self.x, self.y, self.r_level)
        perform(m, self.code, ream(self.bottom, above=self.r_level, feed=None, retract=None, dwell=self.dwell))
        leave(m, self.code, self.r_level)
