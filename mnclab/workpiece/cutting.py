"""What is cut: the rows of a path, the tool of every row as its table stood there, the blank, what holds it.

All of it stands in the coordinates of the path. This is all that the room of the workpiece knows of a run.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Any

import numpy as np

from mnclab.path.inserts import edgeless
from mnclab.path.places import divided
from mnclab.path.tool import LATHE, Tool
from mnclab.path.toolpath import Array, Index, Kind, Mask, Toolpath
from mnclab.workpiece.blank import Blank
from mnclab.workpiece.part import Part

CUTS = (Kind.LINE, Kind.ARC)  # what moves at feed; a probe cuts nothing
OF_BLANK = "of the blank: "
MILLS = ("mill", "face mill", "thread mill", "chamfer")  # no lathe of these turns a tool; drills and the like cut on its axis
SHOWN = 3  # lines that a sentence names
UPRIGHT = 1 - 1e-12  # the cosine between the axes of a tool and of the machine from which on it is not tilted
TURNED = 1e-9  # of unit vectors, by which two directions differ


def _lines(line: int, program: int) -> str:
    return f"line {line}"


@dataclass(frozen=True, eq=False)
class Cutting:
    """Rows of a path (n,) and what they meet.

    `tools[which[row]]` is the tool of a row. From row `arrived` on the tool's height is known at the end of a row, from
    `known` on the start of every row: before, the tool comes from home, and only where it arrives counts. `directions`
    (n, 3, 3) are those of the tool, from its tip to the spindle, at the start of each row, on its way and at its end; None:
    along Z. `fixtures` hold the blank. `name` says in which program a line
    stands ("FILE:LINE"). `origin` (3,) is where the zero of the path stands on the machine. `reach` is "up to line 12, where
    the run stopped" if the path ends before its program, else empty. `across` is what X is in the program of a lathe, a
    "radius" or a "diameter".
    """

    path: Toolpath
    tools: Sequence[Tool]
    which: Index
    stock: Blank | Any
    arrived: int = 0
    known: int = 0
    directions: Array | None = None
    fixtures: Sequence[Blank | Part] = ()
    name: Any = field(default=_lines)
    origin: Sequence[float] = (0.0, 0.0, 0.0)
    reach: str = ""
    across: str = "radius"

    def __len__(self) -> int:
        return len(self.path)

    @classmethod
    def of_nothing(cls, stock: Any, lathe: bool = False) -> Cutting:
        """No rows: the part is its blank."""
        path = Toolpath({"kind": np.zeros(0, dtype=np.uint8)}, lathe=lathe)
        return cls(path, (), np.zeros(0, dtype=np.int64), stock)

    def until(self, row: int) -> Cutting:
        """The same up to a row and with it."""
        return replace(self.rows(slice(row + 1)), reach="")

    def rows(self, some: slice) -> Cutting:
        """The same with some rows that follow each other."""
        arrived, known = (max(each - (some.start or 0), 0) for each in (self.arrived, self.known))
        directions = None if self.directions is None else self.directions[some]
        path, which = self.path[some], self.which[some]
        return replace(self, path=path, which=which, directions=directions, arrived=arrived, known=known)

    def divided(self, counts: Index) -> Cutting:
        """The same with each row in so many (n,) equal parts."""
        path, row = divided(self.path, counts)
        first = np.append(np.cumsum(counts) - counts, len(row))
        arrived, known = (int(first[min(each, len(counts))]) for each in (self.arrived, self.known))
        directions = None if self.directions is None else self.directions[row]
        return replace(self, path=path, which=self.which[row], directions=directions, arrived=arrived, known=known)

    def uncut(self, stock: Blank) -> Cutting:
        """Another blank on the same machine, before the first row."""
        return replace(Cutting.of_nothing(stock, self.lathe), origin=self.origin)

    def tool(self, row: int) -> Tool:
        return self.tools[int(self.which[row])]

    @cached_property
    def cuts(self) -> Mask:
        """Rows that may take material away (n,): moves at feed and rapids, of a tool that is none to measure with.

        A rapid takes nothing away before the height of the tool is known, and nothing does while a cycle holds the spindle.
        """
        path = self.path
        moves = np.isin(path.kind, (*CUTS, Kind.RAPID))
        moves &= ((path.kind != Kind.RAPID) | (np.arange(len(path)) >= self.arrived)) & ~self.held
        bodies = np.array([tool.kind != "probe" and tool_exists(tool) for tool in self.tools], dtype=bool)
        return np.asarray(moves & bodies[self.which] if len(bodies) else moves & False)

    @cached_property
    def tilted(self) -> Mask | None:
        """Rows (n,) of a tool that does not stand along Z from their start to their end; None without any."""
        found = None if self.directions is None else np.asarray((self.directions[..., 2] < UPRIGHT).any(axis=1))
        return found if found is not None and found.any() else None

    @cached_property
    def turning(self) -> Mask:
        """Rows (n,) on which the tool turns on the part while it moves."""
        if self.directions is None:
            return np.zeros(len(self), dtype=bool)
        return np.asarray(self.path.is_motion & (np.abs(np.diff(self.directions, axis=1)) > TURNED).any(axis=(1, 2)))

    @cached_property
    def round_(self) -> Mask:
        """Rows (n,) that may cut while the part turns about the axis of their `sweep`, to which the tool is square."""
        if not self.turning.any():
            return self.turning
        assert self.directions is not None
        along = np.abs(np.einsum("nek,nk->ne", self.directions, self.path.axis)).max(axis=1)
        return np.asarray(self.turning & self.cuts & ~self.from_home & (self.path.sweep != 0) & (along < TURNED))

    def by_direction(self, some: Mask) -> Iterator[tuple[Array, Mask]]:
        """Some rows (n,) by the direction at their end: the frame (3, 3) along it, and which they are."""
        assert self.directions is not None
        ends, rows = self.directions[:, 2], np.flatnonzero(some)
        kinds, which = np.unique(np.round(ends[rows], 12), axis=0, return_inverse=True)
        for k in range(len(kinds)):
            mine = rows[which.reshape(-1) == k]
            yield frames_along(ends[mine[:1]])[0], np.isin(np.arange(len(self)), mine)

    def seen_along(self, turn: Array) -> Cutting:
        """The rows in a frame (3, 3), as those of a tool that is upright there; the blank stays where it is."""
        columns = {name: getattr(self.path, name) for name in self.path.all_but_ends()}
        for name in ("start", "end", "centre", "axis"):
            columns[name] = np.einsum("ij,nj->ni", turn.T, getattr(self.path, name))
        return replace(self, path=self.path.replace(**columns), directions=None)

    @cached_property
    def probed(self) -> Mask:
        """Rows (n,) on which the program itself moves a probe, but for those away from a touch: cycles watch over theirs."""
        path = self.path
        probes = np.array([tool.kind == "probe" for tool in self.tools] or [False])
        touched = np.append(False, path.kind[:-1] == Kind.PROBE)[: len(path)]
        moves = np.isin(path.kind, (*CUTS, Kind.RAPID)) & (np.arange(len(path)) >= self.arrived)
        return np.asarray(moves & probes[self.which] & (path.label == 0) & ~touched)

    @cached_property
    def held(self) -> Mask:
        """Rows (n,) of a mill whose spindle a cycle has stopped: the one edge of a boring tool is led clear of the wall."""
        path = self.path
        stopped = (path.kind == Kind.SPINDLE) & (path.label > 0)  # labels are those of cycles
        return np.asarray((path.spindle == 0) & np.isin(path.step, path.step[stopped]) & (not path.lathe))

    @cached_property
    def from_home(self) -> Mask:
        """Rows (n,) whose start nobody has said: only their end counts."""
        rows = np.arange(len(self.path))
        first = (rows == self.arrived) | (self.path.kind == Kind.RAPID)
        return np.asarray((rows >= self.arrived) & (rows < self.known) & first)

    @cached_property
    def numbers(self) -> Index:
        """The number of the tool of each row (n,): where a program has no tool words, of the one that cuts all the same."""
        return numbers_of(self.path, self.tools, self.which)

    @property
    def bare(self) -> Mask:
        """Rows (n,) that go through the box of the blank at feed and cut nothing: they have no tool, or one without a body."""
        bodies = np.array([tool.kind == "probe" or tool_exists(tool) for tool in self.tools], dtype=bool)
        return np.asarray(self.inside & (~bodies[self.which] if len(bodies) else True))

    @cached_property
    def inside(self) -> Mask:
        """Rows (n,) at feed that go through the box of the blank."""
        path, (low, high) = self.path, self.stock.bounds
        ends = np.stack([path.start, path.end])
        inside = ((ends.min(axis=0) < high) & (ends.max(axis=0) > low)).all(axis=1)
        return np.asarray(inside & np.isin(path.kind, CUTS))

    def of_rows(self, column: Any, rows: Index) -> Any:
        """The values of a column (n,) in some rows, as large as these; of -1, no row, any value."""
        return np.asarray(column)[rows] if len(self) else rows

    def lines(self, rows: Mask) -> str:
        """The first lines of some rows (n,), in words."""
        found = list(dict.fromkeys(zip(self.path.line[rows].tolist(), self.path.program[rows].tolist())))
        return ", ".join(self.name(*each) for each in found[:SHOWN]) + (", …" if len(found) > SHOWN else "")

    def notes(self) -> Iterator[str]:
        """What of the blank and of the path is not in a part, whatever turns or mills it."""
        if self.reach:
            yield f"cut only {self.reach}"
        for note in getattr(self.stock, "notes", ()):
            yield note if note.startswith(OF_BLANK) else OF_BLANK + note
        yield from self.bare_told()

    def bare_told(self) -> Iterator[str]:
        """That rows have no tool to cut or to collide with, if some have none."""
        bare = self.bare
        for k, tool in enumerate(self.tools if bare.any() else ()):
            given = replace(tool, number=0, name="") != Tool()  # a tap that has its pitch alone
            if given and (rows := bare & (self.which == k)).any():
                lacks = "radius" if tool.kind or not self.lathe else "kind, nor a corner, an angle or a width"
                yield f"{_named(tool)} has no {lacks}: it cuts nothing ({self.lines(rows)})"
                bare = bare & ~rows
        if bare.any():
            yield f"rows without a tool cut nothing ({self.lines(bare)})"
        yield from self.edgeless()
        yield from self.foreign()

    def edgeless(self) -> Iterator[str]:
        """What is said of tools that have no edge and go through the box of the blank at feed: they cut nothing there."""
        inside = self.inside & self.cuts
        for k, tool in enumerate(self.tools):
            if (lacks := edgeless(tool, self.lathe)) and (rows := inside & (self.which == k)).any():
                as_line = " but as a line along its way" if lacks == "no width" else ""
                yield f"T{tool.number} ({tool.kind or 'mill'}) has {lacks}: it cuts nothing{as_line} ({self.lines(rows)})"

    def foreign(self) -> Iterator[str]:
        """What is said of tools of the other kind of machine that go through the box of the blank at feed."""
        kinds = MILLS if self.lathe else LATHE
        said = "a mill, which on a lathe stands still" if self.lathe else "a tool of a lathe: it cuts as a mill of its radius"
        for k, tool in enumerate(self.tools):
            foreign = tool.kind in kinds and tool.effective_radius > 0
            if foreign and (rows := self.inside & self.cuts & (self.which == k)).any():
                yield f"{_named(tool)} is {said} ({self.lines(rows)})"

    @property
    def lathe(self) -> bool:
        return self.path.lathe


def numbers_of(path: Toolpath, tools: Sequence[Tool], which: Index) -> Index:
    """The number of the tool of each row (n,), that of `tools[which[row]]` where the path has none."""
    held = np.array([tool.number for tool in tools] or [0], dtype=np.int64)
    return np.where(path.tool == 0, held[which], path.tool).astype(np.int64)


def _named(tool: Tool) -> str:
    return f"T{tool.number}" + (f" ({tool.kind})" if tool.kind else "")


def frames_along(directions: Array) -> Array:
    """Frames (k, 3, 3), their axes as columns, whose Z is a direction (k, 3): turned there from Z the short way."""
    x, y, z = directions.T
    down = z < -UPRIGHT
    share = 1 / np.where(down, 1.0, 1 + z)
    found = np.array([[1 - x * x * share, -x * y * share, x], [-x * y * share, 1 - y * y * share, y], [-x, -y, z]])
    found = np.moveaxis(found, 2, 0)
    found[down] = np.diag([1.0, -1.0, -1.0])
    return found


def tool_exists(tool: Tool) -> bool:
    """Whether a tool has a body: a mill a radius, a lathe tool its kind, or a nose, an angle or a width."""
    edge = tool.corner or tool.main_angle or tool.auxiliary_angle or tool.width
    return bool(tool.effective_radius > 0 or tool.kind in LATHE or edge)
