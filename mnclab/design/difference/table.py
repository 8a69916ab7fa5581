"""The table of a measuring room: each measure of each feature as drawn and as found, its limits and the verdict."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any, NamedTuple

from mnclab.text.tables import html_table

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
    place: tuple[float, float, float] | None = None
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


class Features(Sequence[Row]):
    """The rows of a comparison; it prints as a table."""

    def __init__(self, rows: Sequence[Row]) -> None:
        self._rows = tuple(rows)

    def __len__(self) -> int:
        return len(self._rows)

    def __getitem__(self, which: Any) -> Any:
        return Features(self._rows[which]) if isinstance(which, slice) else self._rows[which]

    def of(self, feature: str, side: str | None = None) -> Features:
        """The rows of one feature."""
        return Features([row for row in self if row.feature == feature and side in (None, row.side)])

    @property
    def outside(self) -> Features:
        """The rows that are not within their limits."""
        return Features([row for row in self if not row.ok])

    def __repr__(self) -> str:
        cells = [HEAD, *(row.texts() for row in self)]
        widths = [max(map(len, column)) for column in zip(*cells, strict=True)]
        cells.insert(1, tuple("-" * width for width in widths))
        aligned = [[str.rjust if k in NUMBERS else str.ljust for k in range(len(HEAD))]] * len(cells)
        lines = ("  ".join(to(text, n) for to, text, n in zip(*each)) for each in zip(aligned, cells, [widths] * len(cells)))
        return "\n".join(line.rstrip() for line in lines)

    def _repr_html_(self) -> str:
        return html_table(HEAD, [row.texts() for row in self], numbers=NUMBERS)


def _written(number: float, sign: bool) -> str:
    if math.isnan(number):
        return "–"
    found = f"{number:+.{DIGITS}f}" if sign else f"{number:.{DIGITS}f}"
    return found.replace("-0.0000", "0.0000").replace("+0.0000", "0.0000")
