"""What a program measures: each touch, each figure that was touched, and the table of a measuring record.

Touches and figures are in machine coordinates while the program runs; `runs` gives them in those of the path.
"""

from __future__ import annotations

import json
import math
from collections.abc import Callable, Collection, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from mnclab.geometry.contours import Contour
from mnclab.path.listing import INCHES, MM, Unit
from mnclab.text.alarm import several
from mnclab.text.file import save_as
from mnclab.text.tables import Listing, Rows, write_csv

if TYPE_CHECKING:
    from mnclab.machine.machine import Machine

Point = tuple[float, float, float]
OK, OUT, REWORK, SCRAP = "ok", "out", "rework", "scrap"
REFUSED = "cannot write measurements as {}; run.report has them as .html or .pdf"
DIGITS = 4
INCH_DIGITS = 5
SLACK = 1e-6  # mm or degrees, by which a value may be beyond its limit: it stands on it (MNC 12)


class Touched(NamedTuple):
    """One touch: from where the centre of the ball went (`start`), where it stood (`centre`) and where the part was
    (`surface`, as it is), mm. `programmed` is the centre in the coordinates of the program as the control took it, `found`
    the touched point, so too. `frame` (4, 4) leads from the program to the machine; `names` are the axes of the program, the
    tool axis last."""

    step: int
    line: int
    program: int
    label: str
    start: Point
    centre: Point
    direction: Point
    ball: float
    surface: Point
    programmed: Point
    found: Point
    frame: Any
    names: str = "XYZ"

    def coordinate(self, name: str) -> float:
        """What it found along X, Y or Z."""
        return self.found[self.names.index(name)]


class Touches(Listing, tuple[Touched, ...]):
    """The touches of a run; they print as a table of what they found, as the control took it, number 1 the first.

    The table counts in the `unit` of the program; the numbers of a touch are mm.
    """

    HEAD = ("number", "line", "what", "X", "Y", "Z", "ball")
    NUMBERS, LENGTHS, NOTHING = (0, 1, 3, 4, 5, 6), range(3, 7), "nothing was touched"
    unit: Unit = MM

    def texts(self) -> list[tuple[str, ...]]:
        """What the table says, row by row."""
        lengths = ((*map(each.coordinate, "XYZ"), each.ball) for each in self)
        numbers = (tuple(_written(value, unit=self.unit) for value in row) for row in lengths)
        return [(str(k), str(each.line), each.label, *row) for k, (each, row) in enumerate(zip(self, numbers), 1)]


class TouchedFigure(NamedTuple):
    """A figure that a cycle touched: as it should be and as it was found, contours in the plane of the `frame` (4, 4) at a
    height, and the numbers of its touches."""

    step: int
    line: int
    program: int
    cycle: str
    nominal: Contour
    actual: Contour
    height: float
    frame: Any
    touches: tuple[int, ...]

    def points(self, contour: Contour, tolerance: float = 1e-3) -> np.ndarray[Any, np.dtype[np.float64]]:
        """Points (n, 3) along one of its contours, machine coordinates."""
        flat = contour.points_within(tolerance)
        space = np.column_stack([flat, np.full(len(flat), self.height), np.ones(len(flat))])
        return np.asarray((space @ np.asarray(self.frame).T)[:, :3])


class Measurement(NamedTuple):
    """One line of the measuring record: mm or degrees as `unit` says; what is not known, or not limited, is nan.

    `verdict`: "ok", "rework", "scrap", "out", or "" where there is no tolerance. `touches` are numbers of `run.touches`.
    """

    line: int
    cycle: str
    what: str
    nominal: float
    actual: float
    lower: float
    upper: float
    unit: str
    verdict: str
    touches: tuple[int, ...] = ()
    step: int = 0
    program: int = 0
    where: str = ""

    @property
    def deviation(self) -> float:
        """Actual less nominal."""
        return self.actual - self.nominal

    @property
    def tolerance(self) -> tuple[float, float]:
        """The limits as deviations from the nominal value."""
        return self.lower - self.nominal, self.upper - self.nominal

    def texts(self, unit: Unit = MM) -> tuple[str, ...]:
        """What the table says, column by column, lengths in a unit."""
        numbers = (self.nominal, self.actual, self.deviation, self.lower, self.upper)
        counts = unit if self.unit == "mm" else MM
        said = (_written(number, sign, counts) for number, sign in zip(numbers, (False, False, True, False, False)))
        own = "" if self.unit == "mm" else f" [{self.unit}]"
        return self.where or str(self.line), self.cycle, self.what + own, *said, self.verdict


class Measurements(Rows[Measurement]):
    """The measuring record of a run; it prints as a table, in the `unit` of the program. The numbers of its rows are mm.

    `reach` is "up to line 12, where the run stopped" if the run stopped before its end, else empty.
    """

    HEAD = ("line", "cycle", "what", "nominal", "actual", "deviation", "lower", "upper", "verdict")
    NUMBERS = LENGTHS = range(3, 8)  # a measure that is no length says its unit itself
    NOTHING = "nothing was measured"

    def of(self, what: str) -> Measurements:
        """The rows of a cycle ("G421") or of a measure ("diameter")."""
        return self.some(row for row in self if what in (row.cycle, row.what))

    @property
    def outside(self) -> Measurements:
        """The rows beyond their limits."""
        return self.some(row for row in self if row.verdict not in ("", OK))

    @property
    def bold(self) -> list[int]:
        return [k for k, row in enumerate(self) if row.verdict not in ("", OK)]

    def texts(self) -> list[tuple[str, ...]]:
        """What the table says, row by row."""
        return [row.texts(self.unit) for row in self]

    @property
    def verdict(self) -> str:
        """How many of the measures that have limits are within them, and how far the run went if it stopped."""
        judged = sum(bool(row.verdict) for row in self)
        if not judged:
            return f"{several(len(self), 'measure')}, none with limits{self._as_far}"
        return f"within their limits: {judged - len(self.outside)} of {several(judged, 'measure')}{self._as_far}"

    @property
    def _as_far(self) -> str:
        return f", {self.reach}" if self.reach else ""

    def as_dicts(self) -> list[dict[str, Any]]:
        """For JSON and for tables of other libraries: nan as None."""
        rows = [{**row._asdict(), "deviation": row.deviation} for row in self]
        return [{k: None if isinstance(v, float) and math.isnan(v) else v for k, v in row.items()} for row in rows]

    def _in_unit(self, row: dict[str, Any]) -> dict[str, Any]:
        """A row of mm in the unit of the program."""
        if row["unit"] != "mm" or self.unit is MM:
            return row
        lengths = {name: row[name] / self.unit.length for name in self.HEAD[3:8] if row[name] is not None}
        return row | lengths | {"unit": self.unit.short}

    def record(self) -> tuple[Sequence[str], Sequence[Sequence[Any]], Collection[int]]:
        """Columns and rows in the unit of the program, numbers with all their digits."""
        names = ("line", "cycle", "what", "unit", *self.HEAD[3:])
        rows = [[row[name] for name in names] for row in map(self._in_unit, self.as_dicts())]
        return names, rows, (0, *range(4, 9))

    def save(self, path: str | Path, **options: Any) -> Path:
        """Write the table as .csv, in the unit of the program, or as .json, in mm, numbers with all their digits; the file."""
        return save_as(self, path, {".csv": write_csv, ".json": _write_json}, REFUSED, **options)


def _write_json(measured: Measurements, path: Path) -> None:
    path.write_text(json.dumps(measured.as_dicts(), indent=1), "utf-8")


def record(
    m: Machine, steps: int, place_of_line: Callable[[int, int], str], reach: str = ""
) -> tuple[Touches, tuple[TouchedFigure, ...], Measurements]:
    """What was touched and measured in the first steps of a run."""
    unit = MM if m.variable_unit == 1 else INCHES
    touches = Touches(each for each in m.touches if each.step < steps)
    touches.unit = unit
    figures = tuple(each for each in m.figures if each.step < steps)
    rows = [each._replace(where=place_of_line(each.line, each.program)) for each in m.measurements if each.step < steps]
    return touches, figures, Measurements(rows, unit, reach)


def judged(actual: float, lower: float, upper: float) -> str:
    """"ok" or "out", or "" without a limit; a value on its limit is within."""
    if math.isnan(lower) and math.isnan(upper):
        return ""
    return OUT if actual < lower - SLACK or actual > upper + SLACK else OK


def _written(number: float, sign: bool = False, unit: Unit = MM) -> str:
    if math.isnan(number):
        return "–"
    found = f"{number / unit.length:{'+' if sign else ''}.{DIGITS if unit.length == 1 else INCH_DIGITS}f}"
    return found if float(found) else found.lstrip("+-")
