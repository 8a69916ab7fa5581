"""Rigid tapping (MNC, 9.12): G309, called by M99. G84 is a fixed cycle."""

from __future__ import annotations

from collections.abc import Iterator
from typing import ClassVar

from mnclab.controls.mnc.cycles import addresses
from mnclab.controls.mnc.cycles.prepared import PreparedCycle, called, kept
from mnclab.machine.cycle import CycleTable, param
from mnclab.machine.machine import Machine
from mnclab.machine.true_size import TAPS
from mnclab.machining.holes.tapping import tap
from mnclab.machining.steps import Say, Step, Write

CYCLES = CycleTable()


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
            yield Say(
                "turns the spindle itself: the spindle stands since the thread before",
                hint="the manual wants M3 or M4 before the next machining (9.12, note 3)",
            )
            yield Write("kept", "told", "stopped")
        sense = 1 if self.pitch > 0 else -1
        work = tap([self.surface + self.depth], above=self.level, pitch=abs(self.pitch), sense=sense, end=0)
        yield from called(m, self.level, work)
        if not stopped:
            yield Write("kept", "now", "stopped")
