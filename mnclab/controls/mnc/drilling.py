"""Drilling cycles (MNC, chapter 9): G83 at each following position, G300 prepared and called by M99."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

from mnclab.controls.word_address.motion import first_word
from mnclab.machine.control import FunctionTable, Words
from mnclab.machine.cycle import Cycle, CycleTable, param
from mnclab.machine.interpreter import run_cycle
from mnclab.machine.machine import Machine
from mnclab.machining.depths import infeeds
from mnclab.text.program import Word

FUNCTIONS = FunctionTable()
CYCLES = CycleTable()

RETURN = {"G98": "Return to the initial level", "G99": "Return to level R"}


@FUNCTIONS("G80", "Fixed cycle off", group="cycle", phase="plane", power_on="G80", ends_cycle=True, source="9")
def cycle_off(m: Machine, words: Words) -> None:
    """Ends G83 and forgets a prepared cycle."""
    m.position_cycle = m.cycle = None


@FUNCTIONS("G98 G99", RETURN, group="return", phase="plane", power_on="G98", source="9")
def return_level(m: Machine, words: Words) -> None:
    """Where G83 leaves the tool; the prepared cycles always end at their start point."""


@FUNCTIONS("M99", "Cycle call", phase="call", modal=False, source="9.4")
def call_cycle(m: Machine, words: Words) -> None:
    """Runs the cycle prepared last at the end point of the block."""
    head = first_word(words)
    if m.cycle is None:
        m.alarm("M99 has no prepared cycle to run", head, hint="prepare one before, for example G300")
    if m.cycle.head and head and m.cycle.head.span.line == head.span.line:
        m.alarm(f"M99 stands in the block that prepares {m.cycle.code}", head, hint="write it at the first hole")
    if m.side:
        m.alarm("a cycle cannot run under radius compensation", head, hint="write G40 first")
    if "machine coordinates" in m.memory:
        m.alarm("M99 and G53 stand in one block: the cycle counts from the workpiece", head, hint="write two blocks")
    run_cycle(m, m.cycle)


def initial_level(m: Machine, kept: dict[str, Any]) -> float:
    """Z of the program where the tool stood when the cycle was first called."""
    x, y, _ = m.tip
    return m.to_program((x, y, kept["initial"]))[2]


@CYCLES("G83", "Deep-hole drilling", runs="position", source="MNC 9.1", triggers="X Y U V Z W R")
class DeepHoleDrilling(Cycle):
    """Drills at each position with rapid withdrawal to level R after every peck, until G80."""

    x: float | None = param("X", "hole position along X", default=None, default_means="the present point")
    u: float | None = param("U", "increment to the hole along X", default=None, incremental=True)
    y: float | None = param("Y", "hole position along Y", default=None, default_means="the present point")
    v: float | None = param("V", "increment to the hole along Y", default=None, incremental=True)
    z: float = param("Z", "bottom of the hole", instead="w", modal=True, note="under G91 from level R, signed")
    w: float | None = param("W", "depth below level R", default=None, above=0, incremental=True, modal=True)
    r: float = param("R", "level R", modal=True, note="under G91 from the initial level, signed")
    k: float | None = param("K", "depth of one peck", default=None, default_means="one pass", above=0, incremental=True)
    p: float = param("P", "dwell at the bottom", "s", default=0, at_least=0)
    f: float | None = param(
        "F", "feed rate", "mm/min", default=None, default_means="the modal feed", above=0, modal=True
    )

    @classmethod
    def prepare(
        cls, values: dict[str, Any], given: Mapping[str, Word], m: Machine, kept: dict[str, Any]
    ) -> dict[str, Any]:
        """Levels are worked out when they are programmed: z becomes the bottom, r the level, x and y the hole."""
        for one, other in (("x", "u"), ("y", "v"), ("z", "w")):
            if one in given and other in given:
                m.alarm(f"G83 {given[one].address} and {given[other].address} stand in one block", given[other])
        absolute = m.modal["dimension"] == "G90"
        kept.setdefault("initial", m.tip[2])  # of the machine: a new datum does not move it
        initial = initial_level(m, kept)
        for axis, (one, other) in enumerate((("x", "u"), ("y", "v"))):
            if other in given:
                values[one] = m.programmed[axis] + values[other]
            elif one in given and not absolute:
                values[one] += m.programmed[axis]
        depth = None if values.get("z") is None or values.get("r") is None else kept.get("depth")
        if "r" in given and not absolute:
            values["r"] += initial
        if "w" in given:
            kept["depth"] = depth = values["w"]
        elif "z" in given:
            kept["depth"] = depth = None if absolute else -values["z"]
        if depth is not None and values.get("r") is not None:
            values["z"] = values["r"] - depth
        if values.get("w") is not None and not values["w"] > 0:
            return values  # refused by its limit
        values["w"] = None if values.get("z") is not None else values.get("w")
        if "f" in given and values["f"] > 0:
            m.change("feed", values["f"])  # stays the modal feed afterwards (9.1)
        if "k" not in given and kept.get("pecked"):
            m.warn(
                "G83 K (depth of one peck) is not modal: this hole is drilled in one pass",
                None,
                "write K for each hole",
            )
        kept["pecked"] = kept.get("pecked", False) or "k" in given
        return values

    def check(self, m: Machine) -> Iterator[tuple[str, str]]:
        """The bottom lies below level R; no radius compensation, no machine coordinates."""
        if not self.z < self.r:
            yield "z", f"must lie below level R, got bottom {self.z:g} and R {self.r:g}"
        if m.side:
            yield "", "cannot run under radius compensation"
        if "machine coordinates" in m.memory:
            yield "", "and G53 stand in one block: the cycle counts from the workpiece"

    def moves(self, m: Machine) -> None:
        """Position, level R, pecks, dwell, and up."""
        m.rapid(x=self.x, y=self.y)
        m.rapid(z=self.r)
        clearance = m.settings["peck_clearance"]
        levels = infeeds(self.r, self.z, self.k)
        for number, level in enumerate(levels, 1):
            m.label = f"G83 peck {number} of {len(levels)}"
            m.line(z=level)
            if number < len(levels):
                m.rapid(z=self.r)
                m.rapid(z=min(level + clearance, self.r))
        m.dwell(self.p)
        m.label = "G83 retract"
        m.rapid(z=self.r)
        if m.modal["return"] == "G98":
            m.rapid(z=initial_level(m, m.position_cycle.extra) if m.position_cycle else None)


@CYCLES("G300, G200", "Drilling", runs="call", source="MNC 9.4")
class Drilling(Cycle):
    """Prepared by its block, run by M99 at the end point of a block: pecks with withdrawal to the clearance level."""

    clearance: float = param("Q", "clearance above the surface", above=0, incremental=True)
    depth: float = param("H", "depth from the surface to the bottom", below=0, incremental=True)
    infeed: float | None = param(
        "P", "depth of each infeed", default=None, default_means="one pass", above=0, incremental=True
    )
    surface: float = param("Z", "workpiece surface", note="always absolute")
    feed: float | None = param("F", "plunging feed", "mm/min", default=None, default_means="the modal feed", above=0)
    dwell_top: float = param("E", "dwell at the clearance level", "s", default=0, at_least=0)
    dwell_bottom: float = param("T", "dwell at the bottom", "s", default=0, at_least=0)

    def moves(self, m: Machine) -> None:
        """Steps 1 to 7 of the manual."""
        start, level = m.programmed[2], self.surface + self.clearance
        m.rapid(z=level)
        levels = infeeds(self.surface, self.surface + self.depth, self.infeed)
        for number, z in enumerate(levels, 1):
            m.label = f"G300 infeed {number} of {len(levels)}"
            m.line(z=z, f=self.feed)
            if number < len(levels):
                m.rapid(z=level)
                m.dwell(self.dwell_top)
                m.rapid(z=min(z + self.clearance, level))
        m.dwell(self.dwell_bottom)
        m.label = "G300 retract"
        m.rapid(z=max(start, level))
