"""Files with tables that a program selects: datum tables (11.3), point tables (3.4)."""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Iterator, Mapping
from types import MappingProxyType
from typing import NamedTuple, TypeVar

import numpy as np
from numpy.typing import NDArray

from mnclab.controls.tnc_620.reading.words import INCH
from mnclab.controls.tnc_620.state import memory
from mnclab.machine.control import FunctionTable, Words
from mnclab.machine.machine import Machine
from mnclab.running.interpreter import found
from mnclab.text.given import LARGEST
from mnclab.text.program import Word

# Files with tables that a program selects: point tables, datum tables; found as programs are.
#     NULLTAB.D MM
#     D X Y Z DOC
#     0 +100.334 +50.002 +0 first clamp
#     [END]
# Fields stand under the names of their columns, or one after the other where a row has all of them; a lone minus marks
# an empty one.

UNITS = {"MM": 1.0, "INCH": INCH}
EMPTY = "-"
NUMBER = re.compile(r"[+-]?(\d+(?:[.,]\d*)?|[.,]\d+)", re.ASCII)
FIELD = re.compile(r"\S+")

Table = TypeVar("Table")


class TableFault(Exception):
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
    except TableFault as fault:
        m.alarm(f"{statement} {name}, {fault}", word)


class Lines:
    """The lines of a table, the mm of its unit, and its columns: name -> where it begins in its line."""

    def __init__(self, text: str) -> None:
        self.lines = text.lstrip("\ufeff").splitlines()
        head, names = (*self.lines[:2], "", "")[:2]
        units = [UNITS[part] for part in head.upper().split() if part in UNITS]
        if len(units) != 1:
            raise TableFault("the first line must say MM or INCH", 1)
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
        raise TableFault("[END] is missing", len(self.lines) + 1)

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
                raise TableFault(f"{field.group()} stands under no column of its own", number)
            row[under[-1]] = field.group()
        return row


def value(field: str, name: str, number: int) -> float:
    if not NUMBER.fullmatch(field) or abs(result := float(field.replace(",", "."))) >= LARGEST:
        raise TableFault(f"{name} must be a number, got {field}", number)
    return result


# Datum tables, files of type .D (11.3): a row a datum, numbered in the column D, with columns X, Y, Z, A, B, C and DOC.
# In an empty field no datum is defined: the shift of that axis stays as it is. Without SEL TABLE the datums of the Setup
# are the active table, if it has any.

FUNCTIONS = FunctionTable()
LINEAR, ROTARY = "XYZ", "ABC"

Rows = Mapping[int, Mapping[str, float]]
DatumTable = tuple[str, Rows]  # its name, and its rows


@FUNCTIONS("SEL TABLE,", "Datum table", takes="file", source="11.3")
def select_table(m: Machine, words: Words) -> None:
    """The table that cycle 7 reads with #; it stays active until another one is selected."""
    _, rows = read_table(m, words["file"], "SEL TABLE", "datum table", ".D", parse_datums)
    memory(m).datum_table = str(words["file"].value), MappingProxyType(rows)


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


def parse_datums(text: str) -> Rows:
    """Rows by their numbers: axis (x, y, z, a, b, c) -> mm or degrees, without the empty fields."""
    lines = Lines(text)
    for name in lines.columns:
        if name not in ("D", "DOC", *LINEAR, *ROTARY):
            raise TableFault(f"the column {name} is not built yet" if name in "UVW" else f"{name} is no column", 2)
    if "D" not in lines.columns:
        raise TableFault("the column D is missing", 2)
    unit = dict.fromkeys(LINEAR, lines.unit)
    rows: dict[int, Mapping[str, float]] = {}
    for number, fields in lines.rows("DOC"):
        values = {name: value(field, name, number) for name, field in fields.items()}
        for name, field in fields.items():
            if abs(values[name]) > 99999.9999:
                raise TableFault(f"{name} must be at least -99999.9999 and at most 99999.9999, got {field}", number)
        row = values.pop("D", -1.0)
        if row != int(row) or not 0 <= row <= 9999:
            raise TableFault("the column D must be a whole number from 0 to 9999", number)
        if row in rows:
            raise TableFault(f"row {int(row)} is there twice", number)
        rows[int(row)] = {name.lower(): found * unit.get(name, 1.0) for name, found in values.items()}
    return rows


# Point tables, files of type .PNT (3.4): a row a point, with X, Y and perhaps Z, FADE and CLEARANCE.

HIDDEN = {"Y": True, "YES": True, "1": True, "N": False, "NO": False, "0": False, "": False}


class PointTable(NamedTuple):
    """Points (n, 3), mm; which are hidden (n,); clearance heights (n,), nan where there is none."""

    points: NDArray[np.float64]
    hidden: NDArray[np.bool_]
    clearance: NDArray[np.float64]


def parse_points(text: str) -> PointTable:
    """A table from its text."""
    lines = Lines(text)
    for axis in "XY":
        if axis not in lines.columns:
            raise TableFault(f"the column {axis} is missing", 2)
    table = np.array([point(row, number) for number, row in lines.rows()], dtype=np.float64).reshape(-1, 5)
    return PointTable(table[:, :3] * lines.unit, table[:, 3] != 0, table[:, 4] * lines.unit)


def point(row: dict[str, str], number: int) -> tuple[float, ...]:
    """x, y, z, hidden, clearance of a row."""
    for axis in "XY":
        if axis not in row:
            raise TableFault(f"{axis} is empty", number)
    hidden = row.get("FADE", "").upper()
    if hidden not in HIDDEN:
        raise TableFault(f"FADE must be Y or N, got {hidden}", number)
    x, y, z = (value(row.get(axis, "0"), axis, number) for axis in "XYZ")
    clearance = value(row["CLEARANCE"], "CLEARANCE", number) if "CLEARANCE" in row else math.nan
    return x, y, z, float(HIDDEN[hidden]), clearance
