"""Files with tables that a program selects: point tables, datum tables; found as programs are.

    NULLTAB.D MM
    D X Y Z DOC
    0 +100.334 +50.002 +0 first clamp
    [END]

Fields stand under the names of their columns, or one after the other where a row has all of them; a lone minus marks
an empty one.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from typing import TypeVar

from mnclab.controls.tnc_620.reading.words import INCH
from mnclab.machine.machine import Machine
from mnclab.running.interpreter import found
from mnclab.text.given import LARGEST
from mnclab.text.program import Word

UNITS = {"MM": 1.0, "INCH": INCH}
EMPTY = "-"
NUMBER = re.compile(r"[+-]?(\d+(?:[.,]\d*)?|[.,]\d+)", re.ASCII)
FIELD = re.compile(r"\S+")

Table = TypeVar("Table")


class Fault(Exception):
    """What is wrong in a line of the file."""

    def __init__(self, message: str, line: int) -> None:
        super().__init__(f"line {line}: {message}")


def read_table(
    m: Machine, word: Word, statement: str, kind: str, suffix: str, parse: Callable[[str], Table]
) -> tuple[str, Table]:
    """Name and content of the table that a statement names; an alarm at that word if there is none, or for a fault in it."""
    name = str(word.value)
    file = name.replace("\\", "/").replace(":", "/").rpartition("/")[2]
    if not file[:1].isalpha():
        m.alarm(f"{statement} {name}: the name of a {kind} must begin with a letter", word)
    if "." not in file:
        name, file = name + suffix, file + suffix
    if not file.upper().endswith(suffix):
        m.alarm(f"{statement} {name}: a {kind} has the type {suffix}", word)
    text = found(m, name, statement, m.span_of(word), kind).text
    try:
        return name, parse(text)
    except Fault as fault:
        m.alarm(f"{statement} {name}, {fault}", word)


class Lines:
    """The lines of a table, the mm of its unit, and its columns: name -> where it begins in its line."""

    def __init__(self, text: str) -> None:
        self.lines = text.lstrip("\ufeff").splitlines()
        head, names = (*self.lines[:2], "", "")[:2]
        units = [UNITS[part] for part in head.upper().split() if part in UNITS]
        if len(units) != 1:
            raise Fault("the first line must say MM or INCH", 1)
        self.unit, self.columns = units[0], {name.group().upper(): name.start() for name in FIELD.finditer(names)}

    def rows(self, comment: str = "") -> Iterator[tuple[int, dict[str, str]]]:
        """The rows up to [END] with the numbers of their lines: fields by column, without the empty ones.

        `comment` is the column that takes all that is left, which is passed over; before it stand numbers.
        """
        for number, line in enumerate(self.lines[2:], start=3):
            if line.strip().upper() == "[END]":
                return
            if line.strip():
                fields = self.fields(line, number, comment)
                yield number, {name: field for name, field in fields.items() if field != EMPTY}
        raise Fault("[END] is missing", len(self.lines) + 1)

    def fields(self, line: str, number: int, comment: str) -> dict[str, str]:
        named, found = {name: at for name, at in self.columns.items() if name != comment}, FIELD.findall(line)
        if len(found) == len(named) or (len(found) > len(named) and list(self.columns)[-1] == comment):
            row = dict(zip(named, found))
            if not comment or all(field == EMPTY or NUMBER.fullmatch(field) for field in row.values()):
                return row
        row = {}
        for field in FIELD.finditer(line):
            if field.start() >= self.columns.get(comment, len(line)):
                break
            under = [name for name, start in named.items() if start <= field.start()]
            if not under or under[-1] in row:
                raise Fault(f"{field.group()} stands under no column of its own", number)
            row[under[-1]] = field.group()
        return row


def value(field: str, name: str, number: int) -> float:
    if not NUMBER.fullmatch(field) or abs(result := float(field.replace(",", "."))) >= LARGEST:
        raise Fault(f"{name} must be a number, got {field}", number)
    return result
