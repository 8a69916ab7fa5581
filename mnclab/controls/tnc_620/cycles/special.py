"""Special cycles (chapter 12): dwell, program call, spindle orientation, tolerance, ascertaining the load, thread cutting.

Engraving and face milling have files of their own.
"""

from __future__ import annotations

from collections.abc import Iterator

from mnclab.controls.tnc_620.cycles import addresses
from mnclab.controls.tnc_620.cycles.addresses import choice, increment, length, seconds
from mnclab.controls.tnc_620.cycles.planes import ParameterFault
from mnclab.controls.tnc_620.language.flow import call_program
from mnclab.machine.coordinates import CALLS, TAPS
from mnclab.machine.cycle import Cycle, CycleTable, param
from mnclab.machine.machine import Machine
from mnclab.machining.steps import Blocks, Say, Spin, Step, Thread, Wait, Write
from mnclab.path.recorder import NAN
from mnclab.running import interpreter
from mnclab.text.alarm import Alarm

CYCLES = CycleTable()
FILTERS: dict[float, str] = {0: "finishing: more exact", 1: "roughing: faster"}
LOADS: dict[float, str] = {0: "forget the values found before", 1: "weigh: the axes move to find the load"}


@CYCLES("CYCL DEF 9", "Dwell time", runs="definition", source="12.2")
class DwellTime(Cycle):
    """The program waits; the spindle turns on."""

    dwell_time: float = seconds("DWELL", "dwell", modal=False, example=2)

    def moves(self, m: Machine) -> Iterator[Step]:
        yield Wait("dwell", self.dwell_time)


@CYCLES("CYCL DEF 13", "Oriented spindle stop", runs="definition", source="12.4")
class SpindleOrientation(Cycle):
    """Stores the angle at which M19 or M20 stops the spindle; cycles 202, 204 and 209 overwrite it."""

    orientation_angle: float = addresses.angle("ANGLE", "angle of the spindle", at_least=0, example=90)

    def moves(self, m: Machine) -> Iterator[Step]:
        yield Write("memory", self.orientation_angle, "orientation")
        yield Write("history", self.orientation_angle, "orientation")


@CYCLES("CYCL DEF 32", "Tolerance", runs="definition", source="12.5")
class Tolerance(Cycle):
    """How far the tool may leave the contour at corners, to go faster: the profile counts with it, the path stays as it is.

    Without T, or with 0, the tolerance is that of the machine. Filter and tolerance of rotary axes are kept in the history.
    """

    tolerance: float | None = length(
        "T", "permissible contour deviation", at_most=10, default=None, default_means="that of the machine",
        note="0: that of the machine",
    )  # fmt: skip
    hsc_mode: float = choice("HSC-MODE", "filter", FILTERS, default=0)
    rotary_axis_tolerance: float = addresses.angle(
        "TA", "permissible deviation of rotary axes", at_least=0, at_most=10, default=0, note="with M128; 0: that of the machine"
    )

    def moves(self, m: Machine) -> Iterator[Step]:
        yield Write("tolerance", self.tolerance or NAN)
        yield Write("history", self.tolerance or 0.0, "tolerance")
        yield Write("history", FILTERS[self.hsc_mode], "filter")
        yield Write("history", self.rotary_axis_tolerance, "tolerance of rotary axes")


@CYCLES("CYCL DEF 239", "Ascertaining the load", runs="definition", source="12.8")
class LoadAscertaining(Cycle):
    """Finds what the load of the table weighs, or forgets it. How the axes move for that only the machine knows: no path."""

    load: float = choice("Q570", "what to do", LOADS)

    def moves(self, m: Machine) -> Iterator[Step]:
        yield Write("history", LOADS[self.load], "load")
        if self.load:
            yield Say("has no path: the axes would move to weigh the load, as the machine tool builder has set")


@CYCLES("CYCL DEF 18", "Thread cutting", source="12.9")
class ThreadCutting(Cycle):
    """Cuts a thread from where the tool stands with the spindle locked to the feed; the tool stays at the bottom.

    The spindle must stand still before: the cycle turns it, clockwise where pitch and depth have opposite signs. A second
    call with the depth reversed runs the thread back.
    """

    own_spindle = True
    does = TAPS
    thread_depth: float = increment(
        "DEPTH", "depth of the thread from where the tool stands", at_least=-99999, at_most=99999, example=-20
    )
    thread_pitch: float = param("PITCH", "pitch of the thread", modal=True, note="positive: a right-hand thread", example=1.5)

    def contradictions(self) -> Iterator[ParameterFault]:
        if self.thread_pitch == 0 or abs(self.thread_pitch) > addresses.FAR:
            most = f"{addresses.FAR:.10g} either way and not 0"
            yield "thread_pitch", f"must be at most {most}, got {self.thread_pitch:g}"

    def check(self, m: Machine) -> Iterator[ParameterFault]:
        if m.turning:
            yield "", "needs a spindle that stands still: it would stop it and cut with no rotation; write M5 before"
        if not m.speed:
            yield "", "needs a spindle speed: write S in TOOL CALL"

    def moves(self, m: Machine) -> Iterator[Step]:
        if self.thread_depth:
            opposite = (self.thread_pitch > 0) != (self.thread_depth > 0)
            yield Spin("spindle on", 1 if opposite else -1)
            yield Thread("cut the thread", m.programmed[2] + self.thread_depth, abs(self.thread_pitch))
            yield Spin("stop the spindle", 0)
            yield Wait("wait for the spindle", m.settings["thread_wait"])


# Another program as a cycle (12.3).


@CYCLES("CYCL DEF 12", "Program call", source="12.3")
class ProgramCall(Cycle):
    """Makes a program the cycle that CYCL CALL and M99 run; Q parameters count for both programs."""

    does = CALLS
    program_name: str = param("PGM", "name of the program", "text", type="text", modal=True)

    def check(self, m: Machine) -> Iterator[tuple[str, str]]:
        try:
            interpreter.called(m, self.program_name, self.code)
        except Alarm as missing:
            yield "program_name", missing.message.removeprefix(f"{self.code} ")

    def moves(self, m: Machine) -> Iterator[Step]:
        yield Blocks(lambda: call_program(m, self.program_name, self.code, None))
