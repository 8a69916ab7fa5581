"""Cycles prepared by a block of their own and called by M99 (MNC, 9.4 to 9.12): the call, and what they share.

z0 is the level where the tool stands at the call, z_s the surface, z_q = z_s + Q the clearance level, z_b the bottom. Every
cycle ends at z_end = max(z0, z_q).
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import Any

from mnclab.controls.word_address.motion import first_word
from mnclab.controls.word_address.state import memory
from mnclab.machine.control import FunctionTable, Words
from mnclab.machine.cycle import Cycle
from mnclab.machine.machine import Machine
from mnclab.machining.holes.drilling import back_to_axis
from mnclab.machining.steps import Go, Step
from mnclab.running.performing import run_cycle

FUNCTIONS = FunctionTable()
SPINDLE = {1: "M3", -1: "M4", 0: "M5"}
START = "to the start point"


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


class PreparedCycle(Cycle):
    """A cycle for M99, which declares the parameters named here; its surface is always absolute."""

    clearance: float
    surface: float

    @property
    def level(self) -> float:
        """z_q, the clearance level."""
        return self.surface + self.clearance


def called(m: Machine, level: float, work: Iterable[Step], *, shifted: bool = False) -> Iterator[Step]:
    """To the clearance level, the work, and to the level of the start point; `shifted`: the work ends off the axis."""
    end, turning = max(m.programmed[2], level), m.turning
    yield Go("to the clearance level", level)
    yield from work
    yield from back_to_axis(end, turning, START) if shifted else (Go(START, end),)


def kept(m: Machine) -> dict[str, Any]:
    """What earlier calls of the prepared cycle have left for the next one."""
    return m.cycle.extra if m.cycle else {}
