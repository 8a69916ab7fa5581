"""Point tables, files of type .PNT (3.4): a row a point, with X, Y and perhaps Z, FADE and CLEARANCE.

    TAB1.PNT MM
    NR X Y Z
    0 +10 +10 +0
    [END]

Fields stand under the names of their columns, or one after the other where a row has all of them.
"""

from __future__ import annotations

import re
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from mnclab.controls.tnc_620.reading.words import INCH, LARGEST
from mnclab.controls.tnc_620.tables.table_files import Fault, text_of
from mnclab.machine.machine import Machine
from mnclab.text.program import Word

SUFFIX = ".PNT"
UNITS = {"MM": 1.0, "INCH": INCH}
HIDDEN = {"Y": True, "YES": True, "1": True, "N": False, "NO": False, "0": False, "": False}

_NUMBER = re.compile(r"[+-]?(\d+(?:[.,]\d*)?|[.,]\d+)", re.ASCII)
_FIELD = re.compile(r"\S+")


class PointTable(NamedTuple):
    """Points (n, 3), mm; which are hidden (n,); clearance heights (n,), nan where there is none."""

    points: NDArray[np.float64]
    hidden: NDArray[np.bool_]
    clearance: NDArray[np.float64]


def read_points(m: Machine, word: Word) -> PointTable:
    """The table that SEL PATTERN names; an alarm at that word if there is none, or for a fault in it."""
    name, text = text_of(m, word, "SEL PATTERN", "point table", SUFFIX)
    try:
        return parse(text)
    except Fault as fault:
        m.alarm(f"SEL PATTERN {name}, {fault}", word)


def parse(text: str) -> PointTable:
    """A table from its text."""
    lines = text.lstrip("\ufeff").splitlines()
    units = [UNITS[part] for part in (lines[0].upper().split() if lines else []) if part in UNITS]
    if len(units) != 1:
        raise Fault("the first line must say MM or INCH", 1)
    columns = {found.group().upper(): found.start() for found in _FIELD.finditer(lines[1] if len(lines) > 1 else "")}
    for axis in "XY":
        if axis not in columns:
            raise Fault(f"the column {axis} is missing", 2)
    rows = []
    for number, line in enumerate(lines[2:], start=3):
        if line.strip().upper() == "[END]":
            break
        if line.strip():
            rows.append(point(filled(fields(line, columns, number)), number))
    else:
        raise Fault("[END] is missing", len(lines) + 1)
    table = np.array(rows, dtype=np.float64).reshape(-1, 5)
    return PointTable(table[:, :3] * units[0], table[:, 3] != 0, table[:, 4] * units[0])


def fields(line: str, columns: dict[str, int], number: int) -> dict[str, str]:
    """The fields of a row by the names of their columns."""
    found = list(_FIELD.finditer(line))
    names = list(columns)
    if len(found) == len(names):
        return {name: field.group() for name, field in zip(names, found, strict=True)}
    row: dict[str, str] = {}
    for field in found:
        under = [name for name, start in columns.items() if start <= field.start()]
        if not under or under[-1] in row:
            raise Fault(f"{field.group()} stands under no column of its own", number)
        row[under[-1]] = field.group()
    return row


def filled(row: dict[str, str]) -> dict[str, str]:
    """The fields that hold something: a lone minus marks an empty one."""
    return {name: field for name, field in row.items() if field != "-"}


def point(row: dict[str, str], number: int) -> tuple[float, ...]:
    """x, y, z, hidden, clearance of a row."""
    for axis in "XY":
        if axis not in row:
            raise Fault(f"{axis} is empty", number)
    hidden = row.get("FADE", "").upper()
    if hidden not in HIDDEN:
        raise Fault(f"FADE must be Y or N, got {hidden}", number)
    x, y, z = (value(row.get(axis, "0"), axis, number) for axis in "XYZ")
    clearance = value(row["CLEARANCE"], "CLEARANCE", number) if "CLEARANCE" in row else float("nan")
    return x, y, z, float(HIDDEN[hidden]), clearance


def value(field: str, name: str, number: int) -> float:
    """A number with a decimal point or comma."""
    found = float(field.replace(",", ".")) if _NUMBER.fullmatch(field) else LARGEST
    if abs(found) >= LARGEST:
        raise Fault(f"{name} must be a number, got {field}", number)
    return found
