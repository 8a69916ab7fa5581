"""Cycles prepared by a block of their own and called by M99 (MNC, 9.4 to 9.12): the call, what they share, and tapping.

Every cycle ends where it began, or at the clearance level, Q above the surface, where that is higher.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import Any, ClassVar

from mnclab.controls.mnc.cycles import addresses
from mnclab.controls.word_address.motion import first_word, memory
from mnclab.machine.control import FunctionTable, Words
from mnclab.machine.coordinates import TAPS
from mnclab.machine.cycle import Cycle, CycleTable, param
from mnclab.machine.machine import Machine
from mnclab.machining.holes import back_to_axis, tap
from mnclab.machining.steps import Go, Say, Step, Write
from mnclab.running.cycles import run_cycle

FUNCTIONS = FunctionTable()
CYCLES = CycleTable()
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


@CYCLES("G309", "Tapping with controlled spindle", runs="call", source="MNC 9.12")
class RigidTapping(PreparedCycle):
    """Taps in one pass with the spindle locked to the feed; the spindle stands still afterwards.

    The note of the chapter wants it switched on with M3 or M4 before the next machining. A further call turns it all the
    same, for a cycle that takes its sense from P and reverses it must turn it itself, but a warning cites the note.
    """

    does: ClassVar[str] = TAPS

    clearance: float = addresses.clearance()
    depth: float = addresses.depth(meaning="depth of the thread from the surface")
    pitch: float = param("P", "pitch", "mm/rev", note="positive right-hand, negative left-hand", example=1.25)
    surface: float = addresses.surface()

    def contradictions(self) -> Iterator[tuple[str, str]]:
        if self.pitch == 0:
            yield "pitch", "must not be 0"

    def check(self, m: Machine) -> Iterator[tuple[str, str]]:
        if not m.speed:
            yield "", "needs a spindle speed: write S before"

    def moves(self, m: Machine) -> Iterator[Step]:
        """Steps 1 to 4 of the manual: the sign of the pitch is the hand, whatever way the spindle turned before."""
        stopped = kept(m).get("stopped")
        if stopped == "now" and not m.turning:
            wanted = "the manual wants M3 or M4 before the next machining (9.12, note 3)"
            yield Say("turns the spindle itself: the spindle stands since the thread before", wanted)
            yield Write("kept", "told", "stopped")
        sense = 1 if self.pitch > 0 else -1
        work = tap([self.surface + self.depth], above=self.level, pitch=abs(self.pitch), sense=sense, end=0)
        yield from called(m, self.level, work)
        if not stopped:
            yield Write("kept", "now", "stopped")
