"""Files with tables that a program selects: point tables, datum tables; found as programs are."""

from __future__ import annotations

from mnclab.machine.machine import Machine
from mnclab.running.files import found
from mnclab.text.program import Word


class Fault(Exception):
    """What is wrong in a line of the file."""

    def __init__(self, message: str, line: int) -> None:
        super().__init__(f"line {line}: {message}")


def text_of(m: Machine, word: Word, statement: str, kind: str, suffix: str) -> tuple[str, str]:
    """Name and text of the table that a statement names; an alarm at that word if there is none."""
    name = str(word.value)
    file = name.replace("\\", "/").replace(":", "/").rpartition("/")[2]
    if not file[:1].isalpha():
        m.alarm(f"{statement} {name}: the name of a {kind} must begin with a letter", word)
    if "." not in file:
        name, file = name + suffix, file + suffix
    if not file.upper().endswith(suffix):
        m.alarm(f"{statement} {name}: a {kind} has the type {suffix}", word)
    return name, found(m, name, statement, m.span_of(word), kind).text
