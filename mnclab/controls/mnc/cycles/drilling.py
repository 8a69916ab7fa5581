"""Drilling and centring (MNC, 9.4, 9.7, 9.10, 9.11): G300, G303, G305 and G307, called by M99."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from typing import Any

from mnclab.controls.mnc.cycles.prepared import (
    PreparedCycle,
    depth,
    dwell_bottom,
    dwell_top,
    feed,
    retract_feed,
)
from mnclab.machine.cycle import CycleTable, param, too_many
from mnclab.machine.machine import Machine
from mnclab.machine.true_size import is_round, tool
from mnclab.machining.depths import infeeds
from mnclab.machining.holes.drilling import drill, gun_drill
from mnclab.machining.steps import Go, Wait
from mnclab.running.performing import perform
from mnclab.text.program import Word

CYCLES = CycleTable()

TO = {0.0: "to the depth H", 1.0: "to the diameter D"}
ENTRY = {3.0: "clockwise (M3)", 4.0: "counter-clockwise (M4)", 5.0: "stopped (M5)"}
TURNING = {3: 1, 4: -1, 5: 0}


@CYCLES("G300, G200", "Drilling", runs="call", source="MNC 9.4")
class Drilling(PreparedCycle):
    """Drills with rapid withdrawal to the clearance level after every infeed."""

    depth: float = depth("depth from the surface to the bottom")
    infeed: float | None = param(
        "P", "depth of each infeed", default=None, default_means="one pass", above=0, incremental=True, example=5
    )
    feed: float | None = feed("plunging feed")
    dwell_top: float = dwell_top()
    dwell_bottom: float = dwell_bottom()

    def levels(self) -> tuple[float, ...]:
        """Infeeds count from the surface."""
        return infeeds(self.surface, self.surface + self.depth, self.infeed)

    def contradictions(self) -> Iterator[tuple[str, str]]:
        """No more infeeds than a hole can have."""
        yield from too_many("infeed", self.levels)

    def moves(self, m: Machine) -> None:
        """Steps 1 to 7 of the manual."""
        end = self.approach(m)
        steps = drill(
            self.levels(), above=self.level, feed=self.feed, reenter=self.clearance,
            dwell_top=self.dwell_top, dwell_bottom=self.dwell_bottom,
        )  # fmt: skip
        perform(m, self.code, steps)
        self.leave(m, end)


@CYCLES("G303, G203", "Universal drilling", runs="call", source="MNC 9.7")
class UniversalDrilling(PreparedCycle):
    """Drills with infeeds that may shrink; breaks the chip some times before each withdrawal."""

    depth: float = depth("depth from the surface to the bottom")
    infeed: float | None = param(
        "P", "depth of the first infeed", default=None, default_means="one pass", above=0, incremental=True, example=6
    )
    min_infeed: float | None = param(
        "M", "least infeed", default=None, default_means="no limit", above=0, incremental=True, example=2,
        note="needed where K is greater than 0",
    )  # fmt: skip
    feed: float | None = feed("drilling feed")
    retract_feed: float | None = retract_feed("feed out of the hole")
    dwell_top: float = dwell_top()
    dwell_bottom: float = dwell_bottom()
    decrement: float = param(
        "K", "amount by which P shrinks after each infeed", default=0, at_least=0, incremental=True, example=3
    )
    chip_breaks: float = param(
        "L", "chip breaks before each withdrawal", "count", default=0, at_least=0, type="integer", example=1,
        note="0: the tool is withdrawn after every infeed",
    )  # fmt: skip
    break_retract: float = param(
        "I", "distance back to break the chip", default=0.1, at_least=0.1, incremental=True, example=0.5
    )

    @classmethod
    def prepare(
        cls, values: dict[str, Any], given: Mapping[str, Word], m: Machine, kept: dict[str, Any]
    ) -> dict[str, Any]:
        """M99 in this block is a least infeed, which somebody may not have meant."""
        if values.get("min_infeed") == 99:
            m.warn(f"{cls.code} M99 is a least infeed of 99 mm, no cycle call", given["min_infeed"])
        return values

    def levels(self) -> tuple[float, ...]:
        """Infeeds count from the surface."""
        bottom = self.surface + self.depth
        return infeeds(self.surface, bottom, self.infeed, self.decrement, self.min_infeed or 0.0)

    def contradictions(self) -> Iterator[tuple[str, str]]:
        """A decrement has a least infeed; no more infeeds than a hole can have."""
        if self.decrement and self.min_infeed is None:
            yield "decrement", f"{self.decrement:g} needs M, the least infeed"
        yield from too_many("infeed", self.levels)

    def moves(self, m: Machine) -> None:
        """Steps 1 to 6 of the manual."""
        end, out = self.approach(m), self.retract_feed or self.feed
        steps = drill(
            self.levels(), above=self.level, feed=self.feed, reenter=self.clearance, withdraw=out,
            dwell_top=self.dwell_top, dwell_bottom=self.dwell_bottom,
            breaks=int(self.chip_breaks), back=self.break_retract,
        )  # fmt: skip
        perform(m, self.code, [*steps, Go("retract", self.level, out)])
        self.leave(m, end)


@CYCLES("G305", "Centring", runs="call", source="MNC 9.11")
class Centring(PreparedCycle):
    """Centres to a depth, or to a diameter that the point angle of the tool turns into one."""

    mode: float = param("L", "what the centring goes to", "choice", default=0, choices=TO, example=0)
    depth: float | None = param(
        "H", "depth from the surface to the tip", default=None, default_means="not used with L1", incremental=True,
        note="less than 0 where L is 0", example=-3,
    )  # fmt: skip
    diameter: float | None = param(
        "D", "diameter of the centring", default=None, default_means="not used with L0",
        note="written with a minus sign: less than 0 where L is 1", example=-8,
    )  # fmt: skip
    feed: float | None = feed("centring feed")
    dwell_bottom: float = dwell_bottom()

    def contradictions(self) -> Iterator[tuple[str, str]]:
        """What L chooses is given, and negative."""
        name, value = ("diameter", self.diameter) if self.mode else ("depth", self.depth)
        if value is None:
            yield name, f"is missing: L is {self.mode:g}"
        elif not value < 0:
            yield name, f"must be less than 0, got {value:g}"

    def check(self, m: Machine) -> Iterator[tuple[str, str]]:
        """A diameter needs a point angle."""
        if self.mode and not 0 < m.tool.angle < 180:
            yield "mode", f"1 needs the point angle of tool {m.tool.number} in the tool table"
        if self.mode and not is_round(m):
            yield "mode", "1 cannot run under unequal scales of the plane: a diameter would be two"

    def moves(self, m: Machine) -> None:
        """Steps 1 to 4 of the manual; the cone of the point is as deep as half the diameter over its tangent."""
        if self.mode:
            down = (self.diameter or 0.0) / 2 / math.tan(math.radians(tool(m).angle / 2))
        else:
            down = self.depth or 0.0
        if self.mode and abs(self.diameter or 0.0) > 2 * m.radius > 0:
            sentence = f"is wider than the tool, {2 * m.radius:.10g}: the cone ends at the tool's diameter"
            m.warn(f"{self.code} D{self.diameter:.10g} {sentence}")
        end = self.approach(m)
        perform(
            m, self.code, [Go("centre", self.surface + down, self.feed), Wait("dwell at the bottom", self.dwell_bottom)]
        )
        self.leave(m, end)


@CYCLES("G307, G241", "Gun drilling", runs="call", source="MNC 9.10")
class GunDrilling(PreparedCycle):
    """Drills deep in one go with a single-lip drill: slow in and out, fast with coolant while it cuts.

    With K it dwells twice. Step 3 drills "to the depth or to the dwell depth": were that an alternative, K < |H| would leave
    the hole unfinished. So K is a pause on the way, as its own text says of through holes, and step 4 dwells at the bottom;
    T is the time of both, as there is no other.
    """

    depth: float = depth("depth from the surface to the bottom")
    feed: float | None = feed("drilling feed")
    retract_feed: float | None = param(
        "E", "feed out of the hole", "mm/min", default=None, default_means="F", at_least=0, note="0: the same as F",
        example=1000,
    )  # fmt: skip
    dwell_bottom: float = dwell_bottom()
    positioning_feed: float | None = param(
        "V", "feed to the deepened start point", "mm/min", default=None, default_means="F", above=0, example=750
    )
    start_depth: float = param(
        "W", "depth of the start point below the surface", default=0, at_least=0, incremental=True, example=5
    )
    spindle_direction: float = param(
        "M", "spindle when entering and leaving", "choice", default=3, choices=ENTRY, example=4
    )
    entry_speed: float | None = param(
        "R", "speed when entering and leaving", "rev/min", default=None, default_means="S", at_least=0, example=25
    )
    drilling_speed: float | None = param(
        "S", "speed when drilling", "rev/min", default=None, default_means="the modal S", above=0, example=500
    )
    dwell_depth: float = param(
        "K", "depth of a dwell on the way", default=0, at_least=0, incremental=True, note="0: none", example=10
    )

    def contradictions(self) -> Iterator[tuple[str, str]]:
        """The dwell and the start point lie above the bottom."""
        for name in ("dwell_depth", "start_depth"):
            if (value := getattr(self, name)) >= -self.depth:
                yield name, f"must be less than the depth {-self.depth:g}, got {value:g}"

    def check(self, m: Machine) -> Iterator[tuple[str, str]]:
        """There is a speed to drill with."""
        if not self.speed(m):
            yield "drilling_speed", "is missing, and no spindle speed was programmed before"

    def speed(self, m: Machine) -> float:
        """The speed to drill with: S of the cycle, or that of the program, not what this cycle left behind."""
        if self.drilling_speed is not None:
            return self.drilling_speed
        kept = m.cycle.extra if m.cycle else {}
        return kept["speed"] if m.speed == kept.get("left", -1.0) else m.speed

    def moves(self, m: Machine) -> None:
        """Steps 1 to 5 of the manual."""
        speed, end = self.speed(m), self.approach(m)
        entry = speed if self.entry_speed is None else self.entry_speed
        steps = gun_drill(
            [self.surface + self.depth], above=self.level, start=self.level - self.start_depth, feed=self.feed,
            approach=self.positioning_feed or self.feed, retract=self.retract_feed or self.feed,
            entry=(TURNING[int(self.spindle_direction)], entry), speed=speed, dwell=self.dwell_bottom,
            pause=self.surface - self.dwell_depth if self.dwell_depth else None,
        )  # fmt: skip
        perform(m, self.code, steps)
        m.set_modal("coolant", "M9")
        if m.cycle:
            m.cycle.extra.update(speed=speed, left=m.speed)
        self.leave(m, end)
