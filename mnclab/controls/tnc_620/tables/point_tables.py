"""Point tables, files of type .PNT (3.4): a row a point, with X, Y and perhaps Z, FADE and CLEARANCE."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from mnclab.controls.tnc_620.tables.table_files import Fault, Lines, value

HIDDEN = {"Y": True, "YES": True, "1": True, "N": False, "NO": False, "0": False, "": False}


class PointTable(NamedTuple):
    """Points (n, 3), mm; which are hidden (n,); clearance heights (n,), nan where there is none."""

    points: NDArray[np.float64]
    hidden: NDArray[np.bool_]
    clearance: NDArray[np.float64]


def parse(text: str) -> PointTable:
    """A table from its text."""
    lines = Lines(text)
    for axis in "XY":
        if axis not in lines.columns:
            raise Fault(f"the column {axis} is missing", 2)
    table = np.array([point(row, number) for number, row in lines.rows()], dtype=np.float64).reshape(-1, 5)
    return PointTable(table[:, :3] * lines.unit, table[:, 3] != 0, table[:, 4] * lines.unit)


def point(row: dict[str, str], number: int) -> tuple[float, ...]:
    """x, y, z, hidden, clearance of a row."""
    for axis in "XY":
        if axis not in row:
            raise Fault(f"{axis} is empty", number)
    hidden = row.get("FADE", "").upper()
    if hidden not in HIDDEN:
        raise Fault(f"FADE must be Y or N, got {hidden}", number)
    x, y, z = (value(row.get(axis, "0"), axis, number) for axis in "XYZ")
    clearance = value(row["CLEARANCE"], "CLEARANCE", number) if "CLEARANCE" in row else math.nan
    return x, y, z, float(HIDDEN[hidden]), clearance
