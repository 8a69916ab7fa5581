"""Calls of a defined cycle: CYCL CALL and M99 (3.1; catalogue: cycle call, CYCL CALL, M99)."""

from __future__ import annotations

from mnclab.controls.tnc_620.language.motion import feed
from mnclab.machine.control import FunctionTable, Words
from mnclab.machine.interpreter import run_cycle
from mnclab.machine.machine import Machine
from mnclab.text.program import Word

FUNCTIONS = FunctionTable()


@FUNCTIONS("CYCL CALL,", "Cycle call", group="call", modal=False, phase="call", takes="F FMAX FAUTO", source="3.1")
def cycle_call(m: Machine, words: Words) -> None:
    """Runs the cycle defined last where the tool stands; F sets the feed of the following blocks, not that of the cycle."""
    feed(m, words)
    call(m, "CYCL CALL", None)


@FUNCTIONS("M99", "Cycle call in its block", group="call", modal=False, phase="call", source="3.1")
def call_here(m: Machine, words: Words) -> None:
    """Runs the cycle defined last at the end of the block."""
    call(m, "M99", words.words[0])


def call(m: Machine, code: str, word: Word | None) -> None:
    """Run the defined cycle; warn about what the manual requires before a call."""
    if m.cycle is None:
        m.alarm(f"{code} has no cycle to call", word, hint="define one before, for example CYCL DEF 200")
    if m.side:
        m.alarm(
            f"{code}: a cycle is called at a position without radius compensation",
            word,
            hint="write R0 in the block before",
        )
    if m.tool.number == 0:
        m.warn(f"{code}: no tool was called", word)
    if not m.turning and not m.cycle.cycle.own_spindle:
        m.warn(f"{code}: the spindle does not turn", word, hint="write M3 or M4 before the call")
    run_cycle(m, m.cycle)
