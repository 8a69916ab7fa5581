"""Freely definable tables, files of type .TAB: FN 26 opens one, FN 28 reads of a row and FN 27 writes to it.

    BEGIN TAB1.TAB MM
    NR  X        Y        DOC
    0   +10.5    +20      left
    [END]

A column goes from its name to the next one; NR numbers the rows. A table that was written to stands in `Run.files` when the
program has ended.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass

from mnclab.controls.tnc_620.language.checks import whole
from mnclab.controls.tnc_620.language.parameters import give
from mnclab.controls.tnc_620.language.system_access import following
from mnclab.controls.tnc_620.state import memory
from mnclab.controls.tnc_620.tables.table_files import Fault, Lines, read_table, value
from mnclab.machine.control import FunctionTable, Words
from mnclab.machine.flow import put_out
from mnclab.machine.machine import Machine
from mnclab.text.program import Word, digits

FUNCTIONS = FunctionTable()
MOST = 999_999_999  # number of a row
NUMBERS = "NR"  # the column of them
_NAMES = re.compile(r"[^,\s]+")

Fields = Mapping[tuple[int, str], str]  # by row and column


@dataclass(frozen=True)
class FreeTable:
    """A table: its name, its lines, which of them each row is, and where each column begins and ends (-1: with the line)."""

    name: str
    lines: tuple[str, ...]
    rows: Mapping[int, int]
    columns: Mapping[str, tuple[int, int]]

    def field(self, row: int, column: str) -> str:
        begin, end = self.columns[column]
        line = self.lines[self.rows[row]]
        return line[begin : len(line) if end < 0 else end].strip()

    def room(self, column: str) -> int:
        """The characters of a column, with a blank between it and the next."""
        begin, end = self.columns[column]
        return MOST if end < 0 else end - begin - 1

    def with_fields(self, fields: Fields) -> str:
        """The whole table with other values in some fields."""
        lines = list(self.lines)
        for (row, column), text in fields.items():
            (begin, end), number = self.columns[column], self.rows[row]
            line = lines[number]
            rest = "" if end < 0 else line[end:]
            lines[number] = f"{line[:begin]:{begin}}{text:{max(end - begin, 0)}}{rest}".rstrip()
        return "\n".join(lines) + "\n"


def parse(text: str) -> FreeTable:
    table = Lines(text)
    if table.unit != 1:
        raise Fault("a table in inches is not built yet", 1)
    names = sorted(table.columns, key=lambda name: table.columns[name])
    ends = [*(table.columns[name] for name in names[1:]), -1]
    columns = {name: (table.columns[name], end) for name, end in zip(names, ends, strict=True)}
    if NUMBERS not in columns:
        raise Fault(f"the column {NUMBERS} is missing", 2)
    found = FreeTable("", tuple(table.lines), {}, columns)
    rows: dict[int, int] = {}
    for k, line in enumerate(table.lines[2:], start=2):
        if line.strip().upper() == "[END]":
            return FreeTable("", found.lines, rows, columns)
        if any(len(line[begin - 1 : begin + 1].strip()) == 2 for begin in table.columns.values() if begin):
            raise Fault("a field stands under two columns", k + 1)
        if line.strip():
            here = FreeTable("", found.lines, {0: k}, columns)
            number = value(here.field(0, NUMBERS) or "-", NUMBERS, k + 1)
            if number != int(number) or not 0 <= number <= MOST or number in rows:
                raise Fault(f"{NUMBERS} must be a whole number that no other row has", k + 1)
            rows[int(number)] = k
    raise Fault("[END] is missing", len(table.lines) + 1)


@FUNCTIONS("FN 26,", "Opening a table", takes="file", source="Klartext, not described")
def open_table(m: Machine, words: Words) -> None:
    """FN 27 and FN 28 concern this table, until another one is opened."""
    kept, key = memory(m), str(words["file"].value).lower()
    if m.variable_unit != 1:
        m.alarm("FN 26: tables in a program in inches are not built yet", words["file"])
    if key not in kept.free_tables:
        name, table = read_table(m, words["file"], "FN 26", "table", ".TAB", parse)
        kept.free_tables = {**kept.free_tables, key: FreeTable(name, table.lines, table.rows, table.columns)}
    kept.free_table = key


def asked(m: Machine, words: Words) -> tuple[FreeTable, int, list[str]]:
    """The open table, and the row and the columns that a function names."""
    kept = memory(m)
    if kept.free_table is None:
        m.alarm(f"{words.code} needs an open table", words["row"], "FN 26: TABOPEN TAB1.TAB before it")
    table = kept.free_tables[kept.free_table]
    row = whole(m, words["row"], f"{words.code} row", 0, MOST)
    if row not in table.rows:
        known = ", ".join(map(str, list(table.rows)[:12]))
        m.alarm(f"{words.code}: the table {table.name} has no row {row} (rows: {known})", words["row"])
    columns = [name.upper() for name in _NAMES.findall(str(words["columns"].value))]
    for name in columns:
        if name not in table.columns:
            m.alarm(f"{words.code}: the table {table.name} has no column {name}", words["columns"])
    return table, row, columns


@FUNCTIONS("FN 28,", "Reading from a table", takes="target row columns", source="Klartext, not described")
def read_fields(m: Machine, words: Words) -> None:
    """The fields of a row come into the target and the parameters after it: numbers into Q, QL and QR, texts into QS."""
    table, row, columns = asked(m, words)
    key = memory(m).free_table or ""
    for name, column in zip(following(m, words["target"], len(columns)), columns, strict=True):
        text = memory(m).table_fields.get(key, {}).get((row, column), table.field(row, column))
        found: float | str = text
        if not name.startswith("QS"):
            try:
                found = value(text or "nothing", column, table.rows[row] + 1)
            except Fault as fault:
                m.alarm(f"FN 28: {table.name}, {fault}", words["columns"])
        give(m, words["target"]._replace(value=name), found)


@FUNCTIONS("FN 27,", "Writing to a table", takes="row columns source", source="Klartext, not described")
def write_fields(m: Machine, words: Words) -> None:
    """The fields of a row are those of a parameter and the ones after it."""
    table, row, columns = asked(m, words)
    key = memory(m).free_table or ""
    fields = {**memory(m).table_fields.get(key, {})}
    for name, column in zip(following(m, words["source"], len(columns)), columns, strict=True):
        fields[row, column] = written(m, name, words["source"], table.room(column))
    memory(m).table_fields = {**memory(m).table_fields, key: fields}
    m.flow.spend(len(fields) // 10)


def written(m: Machine, name: str, word: Word, room: int) -> str:
    found = m.variables.get(name)
    if found is None:
        m.alarm(f"FN 27: no value was given to {name}", word)
    text = found if isinstance(found, str) else digits(float(found))
    if len(text) > room:
        m.alarm(f"FN 27: {name} is {text}, and its column has room for {room} characters", word)
    return text


def put_out_tables(m: Machine) -> None:
    """The end of a program: the tables that were written to."""
    for key, fields in memory(m).table_fields.items():
        table = memory(m).free_tables[key]
        put_out(m, table.name, table.with_fields(fields), anew=True)
