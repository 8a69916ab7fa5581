"""A path as text, one row a line, for tests and people; and as a table for notebooks.

Positions of the text have four decimals (a tenth of a micrometre), of the table three; angles are in degrees. A listing
shows what the columns hold, so the X of a lathe is a radius. The path of a program in inches is told in inches, with six
decimals, so that the numbers of the program come back; its columns are in mm all the same.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from mnclab.path.toolpath import Kind
from mnclab.text.alarm import several
from mnclab.text.tables import html_table

if TYPE_CHECKING:
    from mnclab.path.toolpath import Move, Toolpath

HEAD, TAIL = 12, 6


class Unit(NamedTuple):
    """The unit of a listing. Of lengths: its `name` in a sentence and `short` behind a number, its `length` in mm, `decimals` of
    a position. Of feeds: the `rate` behind a number, and how many mm/min one `feed` is."""

    name: str
    short: str
    length: float
    decimals: int
    rate: str
    feed: float

    def for_feed(self, per_rev: Any) -> Unit:
        """In what a feed is told that counts per revolution, or per minute."""
        return self._replace(rate=f"{self.short}/rev", feed=self.length) if per_rev else self

    def figure(self, length: float, fewer: int = 0) -> str:
        """A length in mm as a number of this unit, with so many decimals fewer."""
        return figure(length / self.length, self.decimals - fewer)


MM, INCHES = Unit("mm", "mm", 1.0, 4, "mm/min", 1.0), Unit("inches", "in", 25.4, 6, "in/min", 25.4)
TENTHS = INCHES._replace(rate="0.1 in/min", feed=2.54)  # of controls whose F counts tenths of an inch


def figure(value: float, decimals: int = 4) -> str:
    """A number without trailing zeros and without a negative zero."""
    text = f"{value:.{decimals}f}"
    text = text.rstrip("0").rstrip(".") if "." in text else text
    return "0" if text in ("-0", "") else text


def point(xyz: np.ndarray | tuple[float, ...], unit: Unit = MM, lathe: bool = False) -> str:
    """`X1 Y2 Z3`; on a lathe `X1 (radius) Z3`."""
    if lathe:
        return f"X{unit.figure(xyz[0])} (radius) Z{unit.figure(xyz[2])}"
    return " ".join(f"{axis}{unit.figure(value)}" for axis, value in zip("XYZ", xyz, strict=True))


def words(move: Move, unit: Unit = MM) -> str:
    """The part of a row that says what happens."""
    match move.kind:
        case Kind.RAPID | Kind.LINE | Kind.PROBE:
            axes = zip("ABC", move.rotary, strict=True)
            rotary = "".join(f" {axis}{figure(np.degrees(value))}" for axis, value in axes if value)
            return f"{point(move.end, unit)}{rotary}{'' if move.kind == Kind.RAPID else _feed(move, unit)}"
        case Kind.ARC:
            ends = f"{point(move.end, unit)} centre {point(move.centre, unit)}"
            return f"{ends} sweep {figure(np.degrees(move.sweep))}{_feed(move, unit)}"
        case Kind.DWELL:
            return f"{figure(move.time)} s"
        case Kind.TOOL:
            return f"T{move.tool} radius {unit.figure(move.radius)} tip {point(move.end, unit)}"
    return f"S{figure(move.spindle)}" if move.kind == Kind.SPINDLE else ""


def _feed(move: Move, unit: Unit) -> str:
    if move.kind == Kind.LINE and np.isfinite(move.time) and np.array_equal(move.start, move.end):
        return f" F{figure(np.degrees(move.feed))} degrees/min"
    return f" F{feed}" if (feed := _rate(move, unit)) else ""


def _rate(move: Move, unit: Unit, fewer: int = 0) -> str:
    if np.isfinite(move.per_rev):
        return f"{unit.figure(move.per_rev, fewer)}/rev"
    return figure(move.feed / unit.feed, unit.decimals - fewer) if np.isfinite(move.feed) else ""


def listing(path: Toolpath) -> str:
    """Every row of a path as text: line, kind, where to, and the label."""
    return "\n".join(row(move, path.unit) for move in path)


def row(move: Move, unit: Unit = MM) -> str:
    """One row as text."""
    side = {1: " left", -1: " right"}.get(move.side, "") if move.kind in (Kind.LINE, Kind.ARC) else ""
    label = f"  ; {move.label}" if move.label else ""
    return f"{line(move):>4s} {Kind(move.kind).name.lower():7s} {words(move, unit)}{side}{label}"


def line(move: Move) -> str:
    """The line of a row; of a program that was called, its number before it."""
    return f"{move.program}:{move.line}" if move.program else str(move.line)


def table(path: Toolpath) -> str:
    """Head and tail of a path as an HTML table."""
    n = len(path)
    axes = [0, 2] if path.lathe and not path.end[:, 1].any() else [0, 1, 2]
    rows = [_cells(i, path[i], path.unit, axes) for i in range(n) if n <= HEAD + TAIL or not HEAD <= i < n - TAIL]
    if n > HEAD + TAIL:
        rows.insert(HEAD, (f"… {n - HEAD - TAIL} rows …",))
    x, radii = ("x (radius)", ", x as radius") if path.lathe else ("x", "")
    head = ("row", "line", "kind", *((x, "y", "z")[k] for k in axes), "feed", "spindle", "tool", "label")
    rate = f", feeds in {path.unit.rate}" if path.tenths else ""
    shown = html_table(head, rows, numbers=(0, 1, *range(3, len(head) - 1)))
    return f"{shown}<p>{several(n, 'row')}, positions in {path.unit.name}{radii}{rate}</p>"


def _cells(i: int, move: Move, unit: Unit, axes: list[int]) -> tuple[str, ...]:
    told = move.label if move.kind <= Kind.PROBE else f"{words(move, unit)} {move.label}".strip()
    kind, place = Kind(move.kind).name.lower(), (unit.figure(move.end[k], 1) for k in axes)
    return str(i), line(move), kind, *place, _rate(move, unit, 1), figure(move.spindle, 3), str(move.tool), told
