"""A part as drawn against the part as cut: where it is off, by how much, which row made it, and the verdict."""

from __future__ import annotations

import math
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple, Unpack

from mnclab.design.model.measures import Measure
from mnclab.path.toolpath import Array
from mnclab.text.given import DifferenceOptions, fitting
from mnclab.text.tables import Rows, html_table
from mnclab.workpiece.cutting import Cutting
from mnclab.workpiece.workpiece import ROUNDING

if TYPE_CHECKING:
    import pyvista
    from matplotlib.figure import Figure


Place = tuple[float, float, float]


def made_by(cutting: Cutting, place: Place | None, row: int, off: float) -> dict[str, Any]:
    """What a `Worst` and a `Row` say of a place that is `off`, + left, - gone, and of the row of the path that made it, -1 for
    none."""
    if place is None:
        return {}
    if row < 0:
        return {"place": place, "where": "nothing cut here" if off > 0 else "missing from the start"}
    line, program = int(cutting.path.line[row]), int(cutting.path.program[row])
    return {"place": place, "line": line, "row": row, "program": program, "where": str(cutting.name(line, program))}


class Worst(NamedTuple):
    """The worst place: `value` mm, never negative, normal to the surface of the design; `place` (x, y, z), None where
    nothing is off.

    `line` of `program` and `row` of the path made it, line 0 and row -1 where nothing was cut there; `where` is
    "FILE:LINE", or says that no line did. `feature` is the name of the feature that it is off.
    """

    value: float = 0.0
    place: Place | None = None
    line: int = 0
    row: int = -1
    program: int = 0
    feature: str = ""
    where: str = ""

    def __str__(self) -> str:
        if self.place is None:
            return "none"
        x, y, z = self.place
        return f"{self.value:.4f} mm at X{x:.3f} Y{y:.3f} Z{z:.3f}, {self.feature}: {self.where}"

    def __repr__(self) -> str:
        return str(self)


@dataclass(frozen=True, eq=False, repr=False)
class Difference:
    """What a comparison found. `ok`: every face lies within `tolerance` mm of the design, and every measure within the
    limits of the drawing where it gives them (they count for the faces of their feature, too); never of a part whose
    program stopped before its end.

    `map` (ny, nx) mm over the cells of the workpiece, whose middles are `x` and `y`: + what is left, - what is gone, 0 where
    both are the same, nan where neither has material. Volumes in mm³. `error` mm is how far a value at the place it is
    told for may be off. `features` is the table of measures. `notes` say what was not judged.

    Of a turned part `map` (1, n) has the deviations along the half section of the design, at ways `x` (n,) along its lines; nan
    where nothing is judged. `compared` and `looked` are what pictures need: the target, and all places that were looked at.
    """

    target: str
    tolerance: float
    error: float
    worst_gouge: Worst
    worst_rest: Worst
    gouge_volume: float
    rest_volume: float
    x: Array
    y: Array
    map: Array
    features: Features
    notes: tuple[str, ...] = ()
    workpiece: Any = None
    compared: Any = None
    looked: Any = None

    @property
    def ok(self) -> bool:
        """Whether the part was cut to the end of its program and is as drawn, within the tolerance."""
        return not self.reach and all(row.ok for row in self.features)

    @property
    def reach(self) -> str:
        """How far the program went that cut the part, if it stopped before its end; else empty."""
        return str(self.workpiece.cutting.reach) if self.workpiece is not None else ""

    @property
    def verdict(self) -> str:
        """"as drawn", "not as drawn", or that the part is not finished."""
        if not all(row.ok for row in self.features):
            return "not as drawn"
        return f"not finished, as drawn {self.reach}" if self.reach else "as drawn"

    def as_dict(self) -> dict[str, Any]:
        """For JSON, without the map."""
        found = {name: getattr(self, name) for name in ("target", "ok", "tolerance", "error", "gouge_volume", "rest_volume")}
        worst = {name: getattr(self, name)._asdict() for name in ("worst_gouge", "worst_rest")}
        return found | worst | {"features": [row.as_dict() for row in self.features], "notes": list(self.notes)}

    # --- doors -------------------------------------------------------------------------------------------------------

    @fitting
    def plot(self, **options: Unpack[DifferenceOptions]) -> Figure:
        """The signed map, of a lathe the half section, with sections and table; see `design.difference.plot.plot_difference`."""
        from mnclab.design.difference.plot import plot_difference

        return plot_difference(self, **options)

    def scene(self, **options: Any) -> pyvista.Plotter:
        """The part as a body in the colours of its deviation (needs pyvista); see `design.difference.scene.scene`."""
        from mnclab.design.difference.scene import scene

        return scene(self, **options)

    @fitting
    def save(self, path: str | Path, **options: Unpack[DifferenceOptions]) -> Path:
        """Write one file; the suffix says what: svg, pdf, png (the picture), csv (the table), json, html (a record)."""
        from mnclab.design.difference.export import save

        return save(self, path, **options)

    def _lines(self) -> list[tuple[str, str]]:
        told = f", found within {1000 * self.error:.1g} µm" if self.error > ROUNDING else ""
        return [
            (f"compared with {self.target}", f"{self.verdict}, tolerance {self.tolerance:g} mm{told}"),
            ("worst gouge", str(self.worst_gouge)),
            ("worst rest", str(self.worst_rest)),
            ("gouged away", f"{self.gouge_volume:.3f} mm³"),
            ("left over", f"{self.rest_volume:.3f} mm³"),
            *(("note", note) for note in self.notes),
        ]

    def __repr__(self) -> str:
        (first, verdict), *others = self._lines()
        return "\n".join([f"{first}: {verdict}", *(f"  {name}: {text}" for name, text in others), "", repr(self.features)])

    def html_parts(self) -> tuple[str, str]:
        """What was found, and the table of measures."""
        return html_table(("", ""), self._lines()), self.features._repr_html_()

    def _repr_html_(self) -> str:
        return "".join(self.html_parts())


# The table of a measuring room: each measure of each feature as drawn and as found, its limits and the verdict.

OK, OUT = "ok", "out"
HEAD = ("side", "feature", "measure", "nominal", "actual", "deviation", "lower", "upper", "verdict", "line")
NUMBERS = range(3, 8)
DIGITS = 4  # of a millimetre and of a degree


class Row(NamedTuple):
    """One measure: mm or degrees. `actual` and `deviation` are nan where nothing could be measured, and `verdict` says why:
    "not cut", "not there" (other features took it away), "not measured"; else it is "ok" or "out".

    `line` of the program and `row` of the path made the worst place of it, `place` (x, y, z); line 0 and row -1 where
    nothing was cut, or nothing is off. `where` is "FILE:LINE".
    """

    side: str
    feature: str
    measure: str
    nominal: float
    actual: float
    deviation: float
    lower: float
    upper: float
    verdict: str
    line: int = 0
    row: int = -1
    place: Place | None = None
    program: int = 0
    where: str = ""

    @property
    def ok(self) -> bool:
        """Whether it is within its limits, as far as it was measured."""
        return self.verdict not in (OUT, "not cut")

    def texts(self) -> tuple[str, ...]:
        """What the table says, column by column."""
        numbers = (self.nominal, self.actual, self.deviation, self.lower, self.upper)
        signed = (False, False, True, True, True)
        return (
            self.side, self.feature, self.measure, *(_written(n, sign) for n, sign in zip(numbers, signed)), self.verdict,
            self.where,
        )  # fmt: skip

    def as_dict(self) -> dict[str, Any]:
        """For JSON: nan as None."""
        found = self._asdict()
        return {name: None if isinstance(value, float) and math.isnan(value) else value for name, value in found.items()}


def judged(
    side: str, feature: str, measure: Measure, actual: float, allowed: float, noise: float, least: float, said: str, made: Any
) -> Row:  # fmt: skip
    """A measure with its verdict: the limits of the drawing, else as far as `allowed`; a deviation within `noise` mm is none,
    and within `least` more it is not out. `said` is why it was not measured, `made` what `made_by` says of its worst place."""
    deviation = actual - measure.nominal
    deviation = 0.0 if abs(deviation) <= noise else deviation
    lower, upper = measure.limits or (-allowed, allowed)
    verdict = said or (OK if lower - least <= deviation <= upper + least else OUT)
    found = measure.nominal + deviation
    return Row(side, feature, measure.name, measure.nominal, found, deviation, lower, upper, verdict, **made)


class Features(Rows[Row]):
    """The rows of a comparison; it prints as a table."""

    HEAD, NUMBERS = HEAD, NUMBERS

    def texts(self) -> list[tuple[str, ...]]:
        """What the table says, row by row."""
        return [row.texts() for row in self]

    def of(self, feature: str, side: str | None = None) -> Features:
        """The rows of one feature."""
        return Features([row for row in self if row.feature == feature and side in (None, row.side)])

    @property
    def outside(self) -> Features:
        """The rows that are not within their limits."""
        return Features([row for row in self if not row.ok])


def _written(number: float, sign: bool) -> str:
    if math.isnan(number):
        return "–"
    found = f"{number:+.{DIGITS}f}" if sign else f"{number:.{DIGITS}f}"
    return found.replace("-0.0000", "0.0000").replace("+0.0000", "0.0000")
