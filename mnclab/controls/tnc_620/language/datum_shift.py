"""TRANS DATUM: the datum shift of cycle 7 as one statement."""

from __future__ import annotations

from mnclab.controls.tnc_620.cycles import chain
from mnclab.controls.tnc_620.cycles.transformations import AXES, DatumShift
from mnclab.controls.tnc_620.language.checks import counted
from mnclab.machine.control import FunctionTable, Words
from mnclab.machine.machine import Machine
from mnclab.running.cycles import perform

FUNCTIONS = FunctionTable()
SOURCE = "Klartext, not described"


@FUNCTIONS("TRANS DATUM AXIS,", "Datum shift", takes="X Y Z A B C", source=SOURCE)
def shift(m: Machine, words: Words) -> None:
    """Moves the datum as cycle 7 does: IX counts from the shift before, an axis that is not named keeps its own."""
    before = dict(zip(AXES, (*chain.shift_of(m), *chain.rotary(m)[0]), strict=True))
    given = {axis: counted(m, words[axis.upper()], before[axis]) for axis in AXES if axis.upper() in words}
    if not given:
        m.alarm("TRANS DATUM AXIS needs an axis", hint="for example TRANS DATUM AXIS X+60")
    perform(m, words.code, DatumShift(**given).moves(m))


@FUNCTIONS("TRANS DATUM RESET,", "End of a datum shift", source=SOURCE)
def reset(m: Machine, words: Words) -> None:
    """The shift is over, whoever defined it."""
    perform(m, words.code, DatumShift(**dict.fromkeys(AXES, 0.0)).moves(m))
