"""The path of a tool as columns; `path[i]` is a row for people."""

from __future__ import annotations

from collections import namedtuple
from collections.abc import Iterable, Iterator, Sequence
from enum import IntEnum
from functools import cached_property
from typing import TYPE_CHECKING, Any, NamedTuple, TypeVar, Unpack, cast, overload

import numpy as np
from numpy.typing import NDArray

from mnclab.text.alarm import Absent, Alarm, several
from mnclab.text.given import PathOptions, fitting_class, shown
from mnclab.text.tables import Columned, Pictured, fixed

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from mnclab.geometry.kinematics import Kinematics
    from mnclab.path.cylinder import Cylinder
    from mnclab.path.listing import Unit


# The kinds of rows in a toolpath, and the rules of radius compensation that made them.

class Kind(IntEnum):
    """What a row of a toolpath is. Motion rows are RAPID, LINE, ARC and PROBE; the others are events.

    >>> path = mnc.run("G0 X5\\nG1 Y10 F100\\n", "mnc").toolpath
    >>> path[path.kind == mnc.Kind.LINE].length
    10.0
    """

    RAPID = 0
    LINE = 1
    ARC = 2
    PROBE = 3
    DWELL = 4
    TOOL = 5
    SPINDLE = 6
    COOLANT = 7
    STOP = 8


KINDS = tuple(kind.name for kind in Kind)  # by their numbers
MOTION_KINDS = (Kind.RAPID, Kind.LINE, Kind.ARC, Kind.PROBE)


class Rule(IntEnum):
    """Which rule of radius compensation made a row of the tool-centre path; column `rule`.

    A row along the contour is called after the way its end was found: where the next offset begins (SIDE), where both
    offsets are prolonged to (OUTSIDE_STRAIGHT) or cut off (INSIDE). OUTSIDE_ARC rows are inserted about a corner.
    """

    NONE = 0
    SIDE = 1
    OUTSIDE_ARC = 2
    OUTSIDE_STRAIGHT = 3
    INSIDE = 4
    ENTRY = 5
    EXIT = 6
    CHANGE = 7


#: What each rule is called in pictures, lists and legends.
RULE_NAMES: dict[Rule, str] = {
    Rule.NONE: "not compensated",
    Rule.SIDE: "along the side",
    Rule.OUTSIDE_ARC: "outside corner, arc",
    Rule.OUTSIDE_STRAIGHT: "outside corner, straight",
    Rule.INSIDE: "inside corner",
    Rule.ENTRY: "entry",
    Rule.EXIT: "exit",
    Rule.CHANGE: "change of side",
}


# The columns of a toolpath, declared once: a line each says type, default, meaning and unit.
# From this table come the arrays of a `Toolpath`, the fields of a `Move`, what a `Recorder` keeps and how, and what an
# export says of each column. A new column is one line here; it has its default in every row until somebody fills it. Passes
# over a path give it as an array. What a machine knows when it adds rows is one more value: in `Machine.state` for a
# column per state, in `machine.rows` for a column per row.

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


# Units of the whole library: **mm, mm/min, rev/min, s; radians inside, degrees in programs and in anything shown.**
# Positions are those of the tool tip along the machine's axes, relative to `Toolpath.origin` (the machine position
# of the first work offset a program selects); a lathe's X is a radius.
# A column that is constant is a stride-0 broadcast and costs nothing. `start` and `end` of a whole path are two views
# of one array of vertices, so that every row begins where the one before ended; a selection of rows has arrays of its own.
# Columns are read-only: what is to be changed is copied first (`Toolpath.replace` takes other columns).

@fitting_class
class Toolpath(Pictured, Columned, Columns):
    """Moves and events in columns of n rows; the names and meanings are in `COLUMNS`.

    `labels`, `joints` and `cylinders` are what columns index; `origin` (3,) is the machine position, mm,
    that all positions are relative to; `lathe` says that pictures and listings show X (a radius) and Z, `inches` that
    listings and tables are in inches, `tenths` that their feeds are in tenths of an inch a minute. The columns are always
    in mm. `kinematics` is what turns the tool and the part by the angles of `rotary`, None where nobody says.

    >>> mnc.run("G0 X5\\nG1 Y10 F100\\n", "mnc").toolpath[0]
    <Move line 1 rapid X5 Y0 Z0>
    """

    def __init__(
        self, columns: dict[str, NDArray[Any]], labels: Sequence[str] = ("",), joints: Sequence[Any] = (),
        origin: Iterable[float] = (0.0, 0.0, 0.0), lathe: bool = False, inches: bool = False,
        cylinders: Sequence[Cylinder] = (), tenths: bool = False, kinematics: Kinematics | None = None,
    ) -> None:  # fmt: skip
        self._n = len(columns["kind"])
        for name, each in COLUMNS.items():
            column = columns.get(name)
            if column is None:
                column = each.of(self._n)
            elif column.dtype != each.dtype and self._n and column.strides[0] == 0:  # keep a constant column constant
                column = each.of(self._n, column[0])
            setattr(self, name, fixed(np.asarray(column, dtype=each.dtype)))
        self.labels, self.joints, self.cylinders = tuple(labels), tuple(joints), tuple(cylinders)
        self.origin = fixed(np.asarray(tuple(origin), dtype=np.float64))
        self.lathe, self.inches, self.tenths, self.kinematics = lathe, inches, tenths, kinematics

    @classmethod
    def chain(cls, vertices: Array, columns: dict[str, NDArray[Any]], **more: Any) -> Toolpath:
        """A continuous path through `vertices` (n + 1, 3); the other columns (n, ...)."""
        return cls({**columns, "start": vertices[:-1], "end": vertices[1:]}, **more)

    def through(self, vertices: Array, columns: dict[str, NDArray[Any]], *labels: str) -> Toolpath:
        """What this path becomes: a chain with its joints, origin and labels, and more `labels`."""
        more = {"joints": self.joints, **self.notes()}
        return Toolpath.chain(vertices, columns, labels=tuple(dict.fromkeys((*self.labels, *labels))), **more)

    def notes(self) -> dict[str, Any]:
        """What is known of the path as a whole."""
        return {name: getattr(self, name) for name in ("origin", "lathe", "inches", "cylinders", "tenths", "kinematics")}

    @property
    def unit(self) -> Unit:
        """In what it is told."""
        from mnclab.path.listing import INCHES, MM, TENTHS

        return TENTHS if self.tenths else INCHES if self.inches else MM

    def all_but_ends(self) -> dict[str, NDArray[Any]]:
        """The columns by their names, without those that `chain` makes."""
        return {name: getattr(self, name) for name in COLUMNS if name not in ("start", "end")}

    def __len__(self) -> int:
        return self._n

    @overload
    def __getitem__(self, index: int) -> Move: ...
    @overload
    def __getitem__(self, index: slice | NDArray[Any] | Sequence[int]) -> Toolpath: ...
    def __getitem__(self, index: Any) -> Any:
        if isinstance(index, tuple):  # of which numpy takes each number for one of an axis
            index = list(index)
        elif isinstance(index, np.ndarray) and not index.ndim:
            index = index[()]
        if isinstance(index, int | np.integer):
            if not -self._n <= index < self._n:
                raise Absent(f"the toolpath has {several(self._n, 'row')}, 0 is the first: there is no row {shown(index)}")
            i = range(self._n)[int(index)]
            row = {name: getattr(self, name)[i] for name in COLUMNS}
            plain = {name: value.item() if value.ndim == 0 else value for name, value in row.items()}
            plain["kind"], plain["label"] = Kind(plain["kind"]), self.labels[plain["label"]]
            plain["joint"] = self.joints[plain["joint"]] if plain["joint"] >= 0 else None
            return Move(**plain)
        if not isinstance(index, slice) and np.asarray(index).dtype.kind not in "iub" and len(np.atleast_1d(index)):
            raise Alarm(f"a row of a toolpath is named by a whole number, some by a slice, numbers or a mask, got {shown(index)}")
        if isinstance(index, slice):
            return self.replace(**{name: getattr(self, name)[index] for name in COLUMNS})
        rows = np.arange(self._n)[index]
        return self.replace(**{name: gathered(getattr(self, name), rows) for name in COLUMNS})

    def __iter__(self) -> Iterator[Move]:
        return (self[i] for i in range(self._n))

    def replace(self, **columns: NDArray[Any]) -> Toolpath:
        """The same path with other columns; if `kind` is given, all of them must be."""
        whole = {name: columns.get(name, getattr(self, name)) for name in COLUMNS}
        return Toolpath(whole, self.labels, self.joints, **self.notes())

    def annotated(self, **more: Any) -> Toolpath:
        """The same columns with other `labels`, `joints`, `origin`, `lathe`, `inches`, `cylinders`, `tenths`, `kinematics`."""
        kept = {"labels": self.labels, "joints": self.joints, **self.notes()}
        return Toolpath({name: getattr(self, name) for name in COLUMNS}, **{**kept, **more})

    def __reduce__(self) -> tuple[Any, ...]:
        """Copies and pickles: a constant column stays one row."""
        columns = {name: getattr(self, name) for name in COLUMNS}
        kept = {name: each[:1] if self._n and each.strides[0] == 0 else each for name, each in columns.items()}
        return _unpacked, (self._n, kept, self.labels, self.joints, *self.notes().values())

    @property
    def is_motion(self) -> Mask:
        return np.asarray(self.kind <= max(MOTION_KINDS))

    @property
    def motion(self) -> Toolpath:
        return self[self.is_motion]

    @cached_property
    def directions(self) -> Array:
        """The direction of the tool on the part at the end of each row (n, 3), from the tip to the spindle: along Z of a machine
        without kinematics."""
        if self.kinematics is None or not self.rotary.any():
            return fixed(np.broadcast_to(np.array([0.0, 0.0, 1.0]), (self._n, 3)))
        return fixed(self.kinematics.orientation(self.rotary)[:, :, 2])

    @cached_property
    def lengths(self) -> Array:
        """Length of each row along the path, mm (n,); zero for events."""
        from mnclab.path.places import spokes

        travel = self.end - self.start
        straight = np.linalg.norm(travel, axis=1)
        arc = self.kind == Kind.ARC
        if arc.any():
            along = np.einsum("ij,ij->i", travel[arc], self.axis[arc])
            spoke = spokes(self, np.flatnonzero(arc))[0]
            straight[arc] = np.hypot(np.linalg.norm(spoke, axis=1) * self.sweep[arc], along)
        return fixed(np.where(self.is_motion, straight, 0.0))

    @property
    def length(self) -> float:
        return float(self.lengths.sum())

    @property
    def bounds(self) -> Array:
        """Smallest and greatest coordinates (2, 3) of the motion, arcs included; nan without motion."""
        from mnclab.path.limits import extents

        motion = self.motion
        if not len(motion):
            return np.full((2, 3), np.nan)
        low, high = extents(motion)
        return np.stack([np.minimum(motion.start, low).min(axis=0), np.maximum(motion.start, high).max(axis=0)])

    def points(self, chord_error: float = 0.01) -> tuple[Array, Index]:
        """Points (m, 3) along the motion within `chord_error` mm of every arc, and the row (m,) of each."""
        from mnclab.path.places import points

        return points(self, chord_error)

    def unrolled(self) -> Toolpath:
        """The rows on a cylinder on its developed surface: X along it, Y along the axis, Z above it; see `path.cylinder`."""
        from mnclab.path.cylinder import unrolled

        return unrolled(self)

    def on_workpiece(self) -> Toolpath:
        """The same rows as they lie on a workpiece that a cylinder cycle turns; see `path.cylinder`."""
        from mnclab.path.cylinder import on_workpiece

        return on_workpiece(self)

    def labelled(self, piece: str) -> Toolpath:
        """The rows whose label has `piece` in it, such as "helix" or "layer 1 of 3, ring"; it may be none."""
        found = [number for number, label in enumerate(self.labels) if piece in label]
        return self[np.isin(self.label, found)]

    def columns(self) -> dict[str, NDArray[Any]]:
        """A dict of one-dimensional arrays for pandas, polars or pyarrow; vectors become `end_x`, `end_y`, …"""
        flat: dict[str, NDArray[Any]] = {}
        for name, each in COLUMNS.items():
            column = getattr(self, name)
            flat |= {one: column[:, k] if each.parts else column for k, one in enumerate(each.flat(name))}
        return flat

    @property
    def names(self) -> dict[str, Sequence[str]]:
        """What the numbers of `kind` and `label` stand for."""
        return {"kind": KINDS, "label": self.labels}

    def __str__(self) -> str:
        from mnclab.path.listing import listing

        return listing(self)

    def __repr__(self) -> str:
        motion = int(self.is_motion.sum())
        return f"<Toolpath: {several(self._n, 'row')}, {several(motion, 'move')}, {self.length:.3f} mm>"

    def _repr_html_(self) -> str:
        from mnclab.path.listing import table

        return table(self)

    def plot(self, **options: Unpack[PathOptions]) -> Figure:
        """Views of the path, coloured by `colour` "kind", "feed", "tool", "line" or "z"; see `show.plot.path.plot_path`."""
        from mnclab.show.plot.path import plot_path

        return plot_path(self, **options)


def _unpacked(n: int, columns: dict[str, NDArray[Any]], *more: Any) -> Toolpath:
    """A path of n rows again, from columns that may have one row for all."""
    return Toolpath({name: np.broadcast_to(each, (n, *each.shape[1:])) for name, each in columns.items()}, *more)


def concatenate(pieces: Sequence[Toolpath]) -> Toolpath:
    """One path from pieces that follow each other; labels, joints and origin are those of the last."""
    last = pieces[-1]
    if len(pieces) == 1:
        return last
    joined = {name: np.concatenate([getattr(piece, name) for piece in pieces]) for name in COLUMNS}
    if len(joined["kind"]):
        vertices = np.concatenate([joined["start"][:1], joined["end"]])
        joined |= {"start": vertices[:-1], "end": vertices[1:]}
    return Toolpath(joined, last.labels, last.joints, **last.notes())


# A fault found in a pass: it knows the step of its row, and the machine knows which block that was.

class PathFault(Exception):
    """What does not fit, at the `step` of the row concerned."""

    def __init__(self, message: str, step: int, hint: str = "") -> None:
        super().__init__(message)
        self.message, self.step, self.hint = message, step, hint
