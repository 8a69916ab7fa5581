"""Datum tables, files of type .D (11.3): a row a datum, numbered in the column D, with columns X, Y, Z, A, B, C and DOC.

    NULLTAB.D MM
    D X Y Z A B C DOC
    0 +100.334 +50.002 +0 +0 +0 +0 first clamp
    [END]

In an empty field, or one with a lone minus, no datum is defined: the shift of that axis stays as it is. Fields stand under
the names of their columns, or one after the other where a row has all of them. Without SEL TABLE the datums of the Setup are
the active table, if it has any.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from types import MappingProxyType

from mnclab.controls.tnc_620.reading.words import INCH, LARGEST
from mnclab.controls.tnc_620.state import memory
from mnclab.controls.tnc_620.tables.table_files import Fault, text_of
from mnclab.machine.control import FunctionTable, Words
from mnclab.machine.machine import Machine
from mnclab.text.program import Word

FUNCTIONS = FunctionTable()
SUFFIX = ".D"
EMPTY = "-"
UNITS = {"MM": 1.0, "INCH": INCH}
LINEAR, ROTARY = "XYZ", "ABC"

Rows = Mapping[int, Mapping[str, float]]
DatumTable = tuple[str, Rows]  # its name, and its rows

_NUMBER = re.compile(r"[+-]?(\d+(?:[.,]\d*)?|[.,]\d+)", re.ASCII)
_FIELD = re.compile(r"\S+")


@FUNCTIONS("SEL TABLE,", "Datum table", takes="file", source="11.3")
def select_table(m: Machine, words: Words) -> None:
    """The table that cycle 7 reads with #; it stays active until another one is selected."""
    word = words["file"]
    memory(m).datum_table = str(word.value), MappingProxyType(read_table(m, word))


def row_of(m: Machine, row: int) -> Mapping[str, float]:
    """Shifts by axis (x, y, z, a, b, c) in a row of the active table; a LookupError says what is missing."""
    of_setup = {number: datum._asdict() for number, datum in m.tables.datums.items()}
    name, rows = memory(m).datum_table or ("of the setup", of_setup)
    if rows is of_setup and not rows:
        raise LookupError("needs an active datum table: write SEL TABLE before, or give Setup(datums=…)")
    if row not in rows:
        known = ", ".join(map(str, sorted(rows)[:12]))
        raise LookupError(f"names row {row}, which the datum table {name} does not have (rows: {known})")
    return {axis: value for axis, value in rows[row].items() if axis in "xyzabc"}


def read_table(m: Machine, word: Word) -> Rows:
    """The table that SEL TABLE names; an alarm at that word if there is none, or for a fault in it."""
    name, text = text_of(m, word, "SEL TABLE", "datum table", SUFFIX)
    try:
        return parse(text)
    except Fault as fault:
        m.alarm(f"SEL TABLE {name}, {fault}", word)


def parse(text: str) -> Rows:
    """Rows by their numbers: axis (x, y, z, a, b, c) -> mm or degrees, without the empty fields."""
    lines = text.lstrip("\ufeff").splitlines()
    units = [UNITS[part] for part in (lines[0].upper().split() if lines else []) if part in UNITS]
    if len(units) != 1:
        raise Fault("the first line must say MM or INCH", 1)
    columns = {found.group().upper(): found.start() for found in _FIELD.finditer(lines[1] if len(lines) > 1 else "")}
    for name in columns:
        if name not in ("D", "DOC", *LINEAR, *ROTARY):
            raise Fault(f"the column {name} is not built yet" if name in "UVW" else f"{name} is no column", 2)
    if "D" not in columns:
        raise Fault("the column D is missing", 2)
    rows: dict[int, Mapping[str, float]] = {}
    for number, line in enumerate(lines[2:], start=3):
        if line.strip().upper() == "[END]":
            return rows
        if line.strip():
            row, values = _row(line, columns, number, units[0])
            if row in rows:
                raise Fault(f"row {row} is there twice", number)
            rows[row] = values
    raise Fault("[END] is missing", len(lines) + 1)


def _row(line: str, columns: dict[str, int], number: int, unit: float) -> tuple[int, Mapping[str, float]]:
    """Number and values of a row."""
    fields = _fields(line, columns, number)
    values = {name: _value(name, text, number) for name, text in fields.items() if name != "DOC"}
    row = values.pop("D", -1.0)
    if row != int(row) or not 0 <= row <= 9999:
        raise Fault("the column D must be a whole number from 0 to 9999", number)
    return int(row), {name.lower(): value * (unit if name in LINEAR else 1.0) for name, value in values.items()}


def _fields(line: str, columns: dict[str, int], number: int) -> dict[str, str]:
    """The fields of a row by the names of their columns; DOC takes all that is left."""
    found = list(_FIELD.finditer(line))
    named = [name for name in columns if name != "DOC"]
    last = columns.get("DOC", len(line) + 1)
    if len(found) == len(named) or ("DOC" in columns and len(found) >= len(named) and list(columns)[-1] == "DOC"):
        first = found[: len(named)]
        if all(field.group() == EMPTY or _NUMBER.fullmatch(field.group()) for field in first):
            return {name: field.group() for name, field in zip(named, first, strict=True) if field.group() != EMPTY}
    row: dict[str, str] = {}
    for field in found:
        under = [name for name in named if columns[name] <= field.start()]
        if field.start() >= last:
            break
        if not under or under[-1] in row:
            raise Fault(f"{field.group()} stands under no column of its own", number)
        row[under[-1]] = field.group()
    return {name: field for name, field in row.items() if field != EMPTY}


def _value(name: str, text: str, number: int) -> float:
    if not _NUMBER.fullmatch(text) or abs(value := float(text.replace(",", "."))) >= LARGEST:
        raise Fault(f"{name} must be a number, got {text}", number)
    if abs(value) > 99999.9999:
        raise Fault(f"{name} must be at least -99999.9999 and at most 99999.9999, got {text}", number)
    return value
