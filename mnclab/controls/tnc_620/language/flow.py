"""The course of a program: labels, repeats, jumps, other programs (catalogue: LBL, CALL LBL, FN, CALL PGM)."""

from __future__ import annotations

import operator

from mnclab.controls.tnc_620.language.checks import whole
from mnclab.controls.tnc_620.language.parameters import PREASSIGNED, text
from mnclab.controls.tnc_620.state import count_in, memory
from mnclab.machine.control import FunctionTable, Words
from mnclab.machine.machine import Machine
from mnclab.running import interpreter
from mnclab.text.program import Word

FUNCTIONS = FunctionTable()


def label_name(m: Machine, word: Word) -> str:
    """How the reader lists a label: a number as it is, a name in quotes."""
    return f"{word.value:g}" if isinstance(word.value, float) else f'"{text(m, word)}"'


@FUNCTIONS("LBL", "Label", takes="label", source="11.10, example")
def label(m: Machine, words: Words) -> None:
    """Where CALL LBL goes; LBL 0 ends a subprogram and does nothing outside one."""
    if label_name(m, words["label"]) == "0":
        m.flow.leave()


@FUNCTIONS("CALL LBL,", "Call of a subprogram, repeat of a section", takes="label REP", source="11.10, example")
def call_label(m: Machine, words: Words) -> None:
    """Runs from the label to LBL 0; with REP n the section from the label to here n times more."""
    word = words["label"]
    m.flow.ask(word.value, words["REP"].value if "REP" in words else 0)
    name = label_name(m, word)
    if name == "0":
        m.alarm("CALL LBL 0: LBL 0 is the end of a subprogram and cannot be called", word)
    if "REP" not in words:
        m.flow.call(m, name, m.span_of(word))
        return
    first, here = m.flow.index_of(name, m.span_of(word)), m.flow.current
    if first >= here:
        m.alarm(f"CALL LBL {name} REP: the section must begin before this block", word, "REP repeats what stands above")
    times = whole(m, words["REP"], "CALL LBL REP (repeats)", 0, 999_999_999)
    m.flow.repeat(m, first, here, times, m.span_of(word))


CONDITIONS = {"FN 9": operator.eq, "FN 10": operator.ne, "FN 11": operator.gt, "FN 12": operator.lt}
JUMPS = {
    "FN 9": "Jump if equal", "FN 10": "Jump if not equal", "FN 11": "Jump if greater", "FN 12": "Jump if less",
}  # fmt: skip


@FUNCTIONS(", ".join(JUMPS), JUMPS, takes="first second parameter state label", leads_away=True, source="Klartext, not described")
def jump(m: Machine, words: Words) -> None:
    """Goes on at a label if the condition holds; numbers are equal when they are exactly so."""
    word = words["label"]
    m.flow.ask(word.value)
    if "state" in words:
        name = str(words["parameter"].value)
        m.flow.ask_whether(name)
        holds = (name in m.variables or name in PREASSIGNED) == (words["state"].value == "DEFINED")
    else:
        first, second = words["first"], words["second"]
        one, other = m.value(first), m.value(second)
        m.flow.compare(first.value, second.value, one - other)
        holds = CONDITIONS[words.code](one, other)
    name = label_name(m, word)
    if name == "0":
        m.alarm(f"{words.code} GOTO LBL 0: LBL 0 is the end of a subprogram and no place to go to", word)
    m.flow.index_of(name, m.span_of(word))  # a label that is missing is a fault even when the jump is not made
    if holds:
        m.flow.jump(m, name, m.span_of(word))


def call_program(m: Machine, name: str, what: str, word: Word | None = None) -> None:
    """Run another program here, with its own QL parameters; `what` is the statement that calls it."""
    place = m.span_of(word)
    index = interpreter.called(m, name, what, place)
    kept, length = (memory(m).name, memory(m).unit), m.variable_unit
    memory(m).name = memory(m).unit = None
    with m.variables.own_level():
        m.flow.call_program(m, index, place)
    memory(m).name, memory(m).unit = kept
    if length != m.variable_unit:
        count_in(m, length)


@FUNCTIONS("CALL PGM,", "Program call", takes="name", source="3.4")
def call_named(m: Machine, words: Words) -> None:
    """Runs another program up to its END PGM: of Setup(files=…), or beside the calling file."""
    m.flow.ask(words["name"].value)
    call_program(m, text(m, words["name"]), "CALL PGM", words["name"])


@FUNCTIONS("SEL PGM,", "Choice of a program", takes="name", source="Klartext, not described")
def select(m: Machine, words: Words) -> None:
    """The program that CALL SELECTED PGM runs; its name may stand in a QS parameter."""
    m.flow.ask(words["name"].value)
    memory(m).selected_program = text(m, words["name"])
    m.log("selected program", memory(m).selected_program)


@FUNCTIONS("CALL SELECTED PGM,", "Call of the chosen program", source="Klartext, not described")
def call_selected(m: Machine, words: Words) -> None:
    """Runs the program that SEL PGM has chosen."""
    name = memory(m).selected_program
    if name is None:
        m.alarm("CALL SELECTED PGM: no program was chosen", hint='write SEL PGM "NAME" before it')
    call_program(m, name, "CALL SELECTED PGM")
