"""Functions FN of the control: system data, circles through points, signals, datums, freely definable tables."""

from __future__ import annotations

import math
import re
from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np

from mnclab.controls.tnc_620.language.system_data import COLUMNS, ROWS, TABLES, Asked, Missing, named, with_column
from mnclab.controls.tnc_620.language.values import give, whole
from mnclab.controls.tnc_620.reading.formulas import GREATEST
from mnclab.controls.tnc_620.state import active_preset, memory
from mnclab.controls.tnc_620.tables import Lines, TableFault, read_table, value
from mnclab.geometry.arcs import circle_through
from mnclab.machine.control import FunctionTable, Words
from mnclab.machine.flow import put_out
from mnclab.machine.machine import Machine
from mnclab.machine.setup import Datum
from mnclab.text.alarm import Alarm
from mnclab.text.program import Word, digits

# FN 18 reads system data, FN 17 writes them.

FUNCTIONS = FunctionTable()


def asked(m: Machine, words: Words) -> Asked:
    return Asked(m.value(words["ID"]), m.value(words["NR"]), m.value(words["IDX"]) if "IDX" in words else math.nan)


@FUNCTIONS("FN 18,", "Reading system data", takes="target ID NR IDX", source="Klartext, not described")
def read_system(m: Machine, words: Words) -> None:
    """Reads one of the system data: ID the group, NR the number in it, IDX the index.

    Program (ID10), machine (20), cycle (30), tools (50, 60, 950),
    compensation (35, 200), transformations (210, 220),
    travel (230), positions (240, 270), M128 and its like (280, 310),
    time (320), datums and presets (500 to 530), run (992).
    """
    m.variables.state_read = m.step
    m.flow.spend_again(3)
    found = asked(m, words)
    row = ROWS.get((found.group, found.number), TABLES.get(found.group) if found.number.is_integer() else None)
    what = f"FN 18: SYSREAD {found}"
    if row is None:
        known = ", ".join(f"NR{number:g}" for group, number in ROWS if group == found.group)
        hint = f"of ID{found.group:g}: {known}" if known else ""
        m.alarm(f"{what} is not built yet", words["ID"], hint)
    if math.isnan(found.index):
        found = replace(found, index=row.default)
    if row.indices != () and math.isnan(found.index):
        m.alarm(f"{what} ({row.title}) needs IDX", words["NR"])
    if row.indices == () and found.index > 0:
        m.warn(f"{what} ({row.title}) has no index: IDX{found.index:g} means nothing", words["IDX"])
    elif row.indices and found.index not in row.indices:
        m.alarm(f"{what} ({row.title}) is not built yet for this index", words.get("IDX", words["NR"]))
    try:
        value = row.read(m, found)
    except Missing as why:
        m.alarm(f"{what} ({row.title}) has no value: {why}", words["ID"])
    if value is None:
        m.alarm(f"{what} ({row.title}) has no value", words["ID"])
    give(m, words["target"], value)


@FUNCTIONS("FN 17,", "Writing system data", takes="ID NR IDX value", source="17.2")
def write_system(m: Machine, words: Words) -> None:
    """ID990 NR6: the input of the probe for cycle 3; the probe here answers at either. ID50: a column of the tool table."""
    to, value = asked(m, words), m.value(words["value"])
    what = f"FN 17: SYSWRITE {to}"
    if (to.group, to.number) == (990, 6) and math.isnan(to.index):
        memory(m).probe_input = value
        m.log("probe input", value)
    elif to.group == 50 and to.number in COLUMNS:
        write_tool(m, to, value, what, words)
    else:
        m.alarm(f"{what} is not built yet", words["ID"], "ID990 NR6 is, and columns of the tool table, ID50")


def write_tool(m: Machine, to: Asked, value: float, what: str, words: Words) -> None:
    """A tool that is in the spindle counts with what was written from its next TOOL CALL on."""
    try:
        if not to.index.is_integer():
            raise Missing("needs IDX, the number of the tool")
        column, row = COLUMNS[int(to.number)], named(m, to)
        m.write_table("tools", int(to.index), with_column(m, row, int(to.number), value))
        if not column.place and value:
            m.warn(f"{what} ({column.title}): it can be read again, and nothing here acts on it", words["NR"])
    except StopIteration:
        m.alarm(f"{what} (TYPE): a tool here has no kind of the number {value:g}", words["value"])
    except (Missing, Alarm) as why:
        m.alarm(f"{what}: {why.message if isinstance(why, Alarm) else why}", words["ID"])


# FN 23 and FN 24: centre and radius of the circle through points that stand in Q parameters (iTNC 530, 9.5).

POINTS = {"FN 23": 3, "FN 24": 4}
TITLES = {"FN 23": "Circle through three points", "FN 24": "Circle through four points"}
APART = 1e-3  # mm; four points that are not nearer to one circle are measured ones


def following(m: Machine, word: Word, count: int) -> list[str]:
    """A parameter and those after it."""
    name = str(word.value)
    kind = name.rstrip("0123456789")
    first = int(name[len(kind) :])
    if first + count - 1 > GREATEST[kind[1:]]:
        m.alarm(f"{count} parameters from {name} on do not exist: the last is {kind}{GREATEST[kind[1:]]}", word)
    return [f"{kind}{first + k}" for k in range(count)]


@FUNCTIONS(", ".join(TITLES), TITLES, takes="target points", source="Klartext, not described")
def circle_data(m: Machine, words: Words) -> None:
    """The points stand in six or eight parameters, x and y in turn; centre and radius come into the target and the two after it.

    Four points that lie on no common circle are evened out by least squares, with a warning: how the control does it nobody says.
    """
    count, source = POINTS[words.code], words["points"]
    found = []
    for name in following(m, source, 2 * count):
        if not isinstance(value := m.variables.get(name), float):
            m.alarm(f"{words.code}: no value was given to {name}", source, f"{count} points stand in {2 * count} parameters")
        found.append(value)
    points = np.array(found).reshape(count, 2)
    try:
        x, y, radius = circle_through(points)
    except ValueError:
        m.alarm(f"{words.code}: the points lie on a line, no circle goes through them", source)
    off = float(np.abs(np.hypot(*(points - (x, y)).T) - radius).max())
    if off * m.variable_unit > APART:
        m.warn(f"{words.code}: the points lie up to {off:.3g} beside one circle, which is that of least squares", source)
    for name, value in zip(following(m, words["target"], 3), (x, y, radius), strict=True):
        give(m, words["target"]._replace(value=name), value)


# What goes out of the control, to its PLC or to a log: here nobody listens, and the program goes on.

PLC_TITLES = {
    "FN 19": "Values to the PLC", "FN 20": "Waiting for the PLC", "FN 29": "Values to the PLC", "FN 37": "Exporting parameters",
    "FN 38": "Sending to a log",
}  # fmt: skip
HAPPENS = {
    "FN 19": "there is no PLC that could take the values", "FN 20": "there is no PLC, and the program goes on at once",
    "FN 29": "there is no PLC that could take the values", "FN 37": "the parameters of a cycle are not exported",
    "FN 38": "there is nobody to send to",
}  # fmt: skip


@FUNCTIONS(", ".join(PLC_TITLES), PLC_TITLES, source="Klartext, not described")
def outwards(m: Machine, words: Words) -> None:
    """Nothing moves and nothing waits; a warning says so."""
    m.warn(f"{words.code} has no effect: {HAPPENS[words.code]}")


# FN 25: the program sets the datum of an axis (iTNC 530).

@FUNCTIONS("FN 25,", "Preset", takes="axis first second", source="Klartext, not described")
def set_datum(m: Machine, words: Words) -> None:
    """PRESET = X/+100/+0: the point that has the coordinate 100 gets 0. The preset becomes row 0, the one set by hand."""
    axis = str(words["axis"].value)
    if axis not in "XYZ":
        m.alarm(f"FN 25: the axis {axis} is not built yet, X, Y and Z are", words["axis"])
    if m.side:
        m.alarm("FN 25 cannot set the datum under radius compensation", words["axis"], "write R0 before")
    if active := [name for name, _ in m.frames if name != "preset" and name in m.frames]:
        m.alarm(f"FN 25 cannot set the datum while a {active[0]} is active", words["axis"])
    by = (m.value(words["first"]) - m.value(words["second"])) * m.variable_unit
    before = m.tables.presets.get(active_preset(m), Datum())
    way = by * m.frames["preset"][:3, "XYZ".index(axis)]
    preset = before._replace(**{name: float(old + along) for name, old, along in zip("xyz", before, way)})
    m.write_table("presets", 0, preset)
    memory(m).preset = 0
    m.select_datum(preset, "preset")


# Freely definable tables, files of type .TAB: FN 26 opens one, FN 28 reads of a row and FN 27 writes to it.
#
#     BEGIN TAB1.TAB MM
#     NR  X        Y        DOC
#     0   +10.5    +20      left
#     [END]
#
# A column goes from its name to the next one; NR numbers the rows. A table that was written to stands in `Run.files` when the
# program has ended.

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
        raise TableFault("a table in inches is not built yet", 1)
    names = sorted(table.columns, key=lambda name: table.columns[name])
    ends = [*(table.columns[name] for name in names[1:]), -1]
    columns = {name: (table.columns[name], end) for name, end in zip(names, ends, strict=True)}
    if NUMBERS not in columns:
        raise TableFault(f"the column {NUMBERS} is missing", 2)
    found = FreeTable("", tuple(table.lines), {}, columns)
    rows: dict[int, int] = {}
    for k, line in enumerate(table.lines[2:], start=2):
        if line.strip().upper() == "[END]":
            return FreeTable("", found.lines, rows, columns)
        if any(len(line[begin - 1 : begin + 1].strip()) == 2 for begin in table.columns.values() if begin):
            raise TableFault("a field stands under two columns", k + 1)
        if line.strip():
            here = FreeTable("", found.lines, {0: k}, columns)
            number = value(here.field(0, NUMBERS) or "-", NUMBERS, k + 1)
            if number != int(number) or not 0 <= number <= MOST or number in rows:
                raise TableFault(f"{NUMBERS} must be a whole number that no other row has", k + 1)
            rows[int(number)] = k
    raise TableFault("[END] is missing", len(table.lines) + 1)


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


def named_fields(m: Machine, words: Words) -> tuple[FreeTable, int, list[str]]:
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
    table, row, columns = named_fields(m, words)
    key = memory(m).free_table or ""
    for name, column in zip(following(m, words["target"], len(columns)), columns, strict=True):
        text = memory(m).table_fields.get(key, {}).get((row, column), table.field(row, column))
        found: float | str = text
        if not name.startswith("QS"):
            try:
                found = value(text or "nothing", column, table.rows[row] + 1)
            except TableFault as fault:
                m.alarm(f"FN 28: {table.name}, {fault}", words["columns"])
        give(m, words["target"]._replace(value=name), found)


@FUNCTIONS("FN 27,", "Writing to a table", takes="row columns source", source="Klartext, not described")
def write_fields(m: Machine, words: Words) -> None:
    """The fields of a row are those of a parameter and the ones after it."""
    table, row, columns = named_fields(m, words)
    key = memory(m).free_table or ""
    fields = {**memory(m).table_fields.get(key, {})}
    for name, column in zip(following(m, words["source"], len(columns)), columns, strict=True):
        fields[row, column] = text_of_field(m, name, words["source"], table.room(column))
    memory(m).table_fields = {**memory(m).table_fields, key: fields}
    m.flow.spend(len(fields) // 10)


def text_of_field(m: Machine, name: str, word: Word, room: int) -> str:
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
