"""Cycles prepared by a block of their own and called by M99 (MNC, 9.4 to 9.12): the call, and what they share.

z0 is the level where the tool stands at the call, z_s the surface, z_q = z_s + Q the clearance level, z_b the bottom. Every
cycle ends at z_end = max(z0, z_q).
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from mnclab.controls.word_address.motion import first_word
from mnclab.controls.word_address.state import memory
from mnclab.machine.control import FunctionTable, Words
from mnclab.machine.cycle import Cycle, param
from mnclab.machine.machine import Machine
from mnclab.machining.steps import Go
from mnclab.running.performing import perform, run_cycle

FUNCTIONS = FunctionTable()
SPINDLE = {1: "M3", -1: "M4", 0: "M5"}


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
    if memory(m).machine_coordinates:
        m.alarm("M99 and G53 stand in one block: the cycle counts from the workpiece", head, hint="write two blocks")
    run_cycle(m, m.cycle)
    m.set_modal("spindle", SPINDLE[m.turning])


@dataclass(frozen=True)
class PreparedCycle(Cycle):
    """What the cycles for M99 share: the clearance above a surface that is always absolute."""

    clearance: float = param("Q", "clearance above the surface", above=0, incremental=True, example=2)
    surface: float = param("Z", "workpiece surface", note="always absolute", example=0)

    @property
    def level(self) -> float:
        """z_q, the clearance level."""
        return self.surface + self.clearance

    def approach(self, m: Machine) -> float:
        """To the clearance level; z_end, the level to leave to."""
        end = max(m.programmed[2], self.level)
        perform(m, self.code, [Go("to the clearance level", self.level)])
        return end

    def leave(self, m: Machine, end: float) -> None:
        """To the level of the start point."""
        perform(m, self.code, [Go("to the start point", end)])


def depth(meaning: str) -> Any:
    """H: how far the bottom lies from the surface, negative."""
    return param("H", meaning, below=0, incremental=True, example=-15)


def feed(meaning: str) -> Any:
    """F: a feed in mm/min whatever G94 or G95 says; it does not become the modal feed."""
    return param("F", meaning, "mm/min", default=None, default_means="the modal feed", above=0, example=150)


def retract_feed(meaning: str) -> Any:
    """V: the feed out of the hole, where 0 and nothing mean the feed into it."""
    return param(
        "V", meaning, "mm/min", default=None, default_means="F", at_least=0, note="0: the same as F", example=400
    )  # fmt: skip


def dwell_bottom() -> Any:
    """T: seconds at the bottom."""
    return param("T", "dwell at the bottom", "s", default=0, at_least=0, example=0.25)


def dwell_top() -> Any:
    """E: seconds at the clearance level."""
    return param("E", "dwell at the clearance level", "s", default=0, at_least=0, example=0.1)


def spindle_angle(meaning: str) -> Any:
    """A: where the spindle stops, degrees."""
    return param("A", meaning, "deg", default=0, at_least=-360, at_most=360, example=30)
