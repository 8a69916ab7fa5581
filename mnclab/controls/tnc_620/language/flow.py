"""Labels: LBL, CALL LBL, REP (catalogue: LBL, CALL LBL)."""

from __future__ import annotations

from mnclab.machine.control import FunctionTable, Words
from mnclab.machine.machine import Machine
from mnclab.text.program import Word

FUNCTIONS = FunctionTable()


def label_name(m: Machine, word: Word) -> str:
    """How the reader lists a label: a number as it is, a name in quotes."""
    return f'"{word.value}"' if isinstance(word.value, str) else f"{m.value(word):g}"


@FUNCTIONS("LBL", "Label", takes="label", source="11.10")
def label(m: Machine, words: Words) -> None:
    """Where CALL LBL goes; LBL 0 ends a subprogram and does nothing outside one."""
    if label_name(m, words["label"]) == "0":
        m.flow.leave()


@FUNCTIONS("CALL LBL,", "Call of a subprogram, repeat of a section", takes="label REP", source="11.10")
def call_label(m: Machine, words: Words) -> None:
    """Runs from the label to LBL 0; with REP n the section from the label to here n times more."""
    word = words["label"]
    name = label_name(m, word)
    if name == "0":
        m.alarm("CALL LBL 0: LBL 0 is the end of a subprogram and cannot be called", word)
    if "REP" not in words:
        m.flow.call(name, m._span(word))
        return
    first, here = m.flow.index_of(name, m._span(word)), m.flow.current
    if first >= here:
        m.alarm(
            f"CALL LBL {name} REP: the section must begin before this block", word, hint="REP repeats what stands above"
        )
    m.flow.repeat(first, here, int(m.value(words["REP"])), m._span(word))
