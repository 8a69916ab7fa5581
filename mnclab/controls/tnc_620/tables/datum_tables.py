"""Datum tables, files of type .D (11.3): a row a datum, numbered in the column D, with columns X, Y, Z, A, B, C and DOC.

In an empty field no datum is defined: the shift of that axis stays as it is. Without SEL TABLE the datums of the Setup
are the active table, if it has any.
"""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType

from mnclab.controls.tnc_620.state import memory
from mnclab.controls.tnc_620.tables.table_files import Fault, Lines, read_table, value
from mnclab.machine.control import FunctionTable, Words
from mnclab.machine.machine import Machine

FUNCTIONS = FunctionTable()
LINEAR, ROTARY = "XYZ", "ABC"

Rows = Mapping[int, Mapping[str, float]]
DatumTable = tuple[str, Rows]  # its name, and its rows


@FUNCTIONS("SEL TABLE,", "Datum table", takes="file", source="11.3")
def select_table(m: Machine, words: Words) -> None:
    """The table that cycle 7 reads with #; it stays active until another one is selected."""
    _, rows = read_table(m, words["file"], "SEL TABLE", "datum table", ".D", parse)
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


def parse(text: str) -> Rows:
    """Rows by their numbers: axis (x, y, z, a, b, c) -> mm or degrees, without the empty fields."""
    lines = Lines(text)
    for name in lines.columns:
        if name not in ("D", "DOC", *LINEAR, *ROTARY):
            raise Fault(f"the column {name} is not built yet" if name in "UVW" else f"{name} is no column", 2)
    if "D" not in lines.columns:
        raise Fault("the column D is missing", 2)
    unit = dict.fromkeys(LINEAR, lines.unit)
    rows: dict[int, Mapping[str, float]] = {}
    for number, fields in lines.rows("DOC"):
        values = {name: value(field, name, number) for name, field in fields.items()}
        for name, field in fields.items():
            if abs(values[name]) > 99999.9999:
                raise Fault(f"{name} must be at least -99999.9999 and at most 99999.9999, got {field}", number)
        row = values.pop("D", -1.0)
        if row != int(row) or not 0 <= row <= 9999:
            raise Fault("the column D must be a whole number from 0 to 9999", number)
        if row in rows:
            raise Fault(f"row {int(row)} is there twice", number)
        rows[int(row)] = {name.lower(): found * unit.get(name, 1.0) for name, found in values.items()}
    return rows
