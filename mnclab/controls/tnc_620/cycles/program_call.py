"""Another program as a cycle (12.3)."""

from __future__ import annotations

from collections.abc import Iterator

from mnclab.controls.tnc_620.language.flow import call_program
from mnclab.machine.cycle import Cycle, CycleTable, param
from mnclab.machine.machine import Machine
from mnclab.machining.steps import Blocks, Step
from mnclab.running import interpreter
from mnclab.text.alarm import Alarm

CYCLES = CycleTable()


@CYCLES("CYCL DEF 12", "Program call", source="12.3")
class ProgramCall(Cycle):
    """Makes a program the cycle that CYCL CALL and M99 run; Q parameters count for both programs."""

    program_name: str = param("PGM", "name of the program", "text", type="text", modal=True)

    def check(self, m: Machine) -> Iterator[tuple[str, str]]:
        try:
            interpreter.called(m, self.program_name, self.code)
        except Alarm as missing:
            yield "program_name", missing.message.removeprefix(f"{self.code} ")

    def moves(self, m: Machine) -> Iterator[Step]:
        yield Blocks(lambda: call_program(m, self.program_name, self.code, None))
