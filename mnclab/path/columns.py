"""The columns of a toolpath, declared once: a line each says type, default, meaning and unit.

From this table come the arrays of a `Toolpath`, the fields of a `Move`, what a `Recorder` keeps and how, and what an
export says of each column. A new column is one line here; it has its default in every row until somebody fills it. Passes
over a path give it as an array. What a machine knows when it adds rows is one more value: in `Machine.state` for a
column per state, in `machine.rows` for a column per row.
"""

from __future__ import annotations

from collections import namedtuple
from typing import Any, NamedTuple, TypeVar, cast

import numpy as np
from numpy.typing import NDArray

from mnclab.path.kinds import Kind

Array = NDArray[np.float64]
Index = NDArray[np.int64]
Mask = NDArray[np.bool_]
T = TypeVar("T", bound=np.generic)


class Column(NamedTuple):
    """One column: what it is where nothing is said, what it means, and in which unit.

    `parts` are the names of the components of a vector (three), empty for a number. `per` says how a recorder keeps it:
    with each "row"; once for each "state", which many rows share; or not at all (""), because it comes later.
    """

    dtype: type[np.generic]
    default: Any
    meaning: str
    unit: str = ""
    parts: str = ""
    per: str = ""

    @property
    def shape(self) -> tuple[int, ...]:
        return (len(self.parts),) if self.parts else ()

    def flat(self, name: str) -> list[str]:
        """The names of its numbers under a name of its own: `end_x`, `end_y`, …"""
        return [f"{name}_{part}" for part in self.parts] if self.parts else [name]

    def of(self, rows: int, value: Any = None) -> NDArray[Any]:
        """The column of so many rows with one value in all of them, the default if none is given; it costs nothing."""
        value = np.asarray(self.default if value is None else value, dtype=self.dtype)
        return np.broadcast_to(value, (rows, *self.shape))


def gathered(column: NDArray[Any], source: Index) -> NDArray[Any]:
    """A column read at rows `source` (m,); a constant one stays so and costs nothing."""
    if len(column) and column.strides[0] == 0:
        return np.broadcast_to(column[0], (len(source), *column.shape[1:]))
    return column.take(source, axis=0, mode="clip")  # faster than column[source]


def column(dtype: type[T], default: Any, meaning: str, unit: str = "", *, parts: str = "", per: str = "") -> NDArray[T]:
    """Declare a column; a toolpath has an array of its name."""
    return cast("NDArray[T]", Column(dtype, default, meaning, unit, parts, per))


class Columns:
    """Every column by its name: the table itself."""

    kind = column(np.uint8, Kind.LINE, "Kind of the row", per="row")
    line = column(np.int32, 0, "source line, from 1", per="row")
    program = column(np.int16, 0, "index into Run.programs", per="state")
    step = column(np.int32, 0, "which execution of a block made the row", per="row")
    label = column(np.int32, 0, "index into labels", per="row")
    start = column(np.float64, 0.0, "tool tip before the row", "mm", parts="xyz")
    end = column(np.float64, 0.0, "tool tip after the row", "mm", parts="xyz", per="row")
    centre = column(np.float64, np.nan, "centre of an arc", "mm", parts="xyz", per="row")
    axis = column(np.float64, (0.0, 0.0, 1.0), "unit normal of the active plane", parts="xyz", per="state")
    sweep = column(np.float64, 0.0, "angle of an arc, right-handed about axis; pitch lies in end", "rad", per="row")
    rotary = column(np.float64, 0.0, "A, B, C at the end of the row", "rad", parts="abc", per="state")
    cylinder = column(np.int16, -1, "index into cylinders: the surface on which the row lies", per="state")
    from_angle = column(np.float64, np.nan, "angle of the axis of the cylinder before the row", "rad", per="state")
    feed = column(np.float64, np.nan, "feed along the path; inf for rapids", "mm/min", per="row")
    per_rev = column(np.float64, np.nan, "feed per revolution of rows at feed", "mm/rev", per="state")
    surface = column(np.float64, np.nan, "constant cutting speed", "m/min", per="state")
    speed_limit = column(np.float64, np.inf, "greatest spindle speed at constant cutting speed", "rev/min", per="state")
    spindle_x = column(np.float64, 0.0, "X of the spindle axis at constant cutting speed", "mm", per="state")
    time = column(np.float64, np.nan, "time given by the program", "s", per="row")
    spindle = column(np.float64, 0.0, "speed at the end of the row, negative for counter-clockwise", "rev/min", per="state")
    tool = column(np.int32, 0, "tool number", per="state")
    radius = column(np.float64, 0.0, "effective tool radius", "mm", per="state")
    side = column(np.int8, 0, "radius compensation: +1 left, -1 right, 0 none", per="state")
    corner_rule = column(np.uint8, 0, "how outside corners are joined", per="state")
    rule = column(np.uint8, 0, "Rule of radius compensation that made the row")
    gouge = column(np.bool_, False, "the tool cuts into the contour on this row (setting gouge = mark)")
    exact = column(np.bool_, False, "stop exactly at the end", per="state")
    synchronous = column(np.bool_, False, "spindle and feed locked", per="state")
    tolerance = column(
        np.float64, np.nan, "how far the program lets corners be cut; nan: as the limits have it", "mm", per="state"
    )
    joint = column(np.int16, -1, "index into joints", per="row")


COLUMNS: dict[str, Column] = {name: each for name, each in vars(Columns).items() if isinstance(each, Column)}


def fields(name: str, columns: dict[str, Column]) -> Any:
    """A named tuple with a field for each column, whose default is that of the column."""
    defaults = (tuple(each.of(1)[0].tolist()) if each.parts else each.default for each in columns.values())
    return namedtuple(name, columns, defaults=defaults)


class Move(fields("Move", COLUMNS)):  # type: ignore[misc]
    """One row of a toolpath: a value for each of `COLUMNS`, a label as its text, a joint as itself."""

    __slots__ = ()

    def __repr__(self) -> str:
        from mnclab.path.listing import row

        return f"<Move line {' '.join(row(self).split())}>"
