"""The holes of a path: where a tool goes straight down along Z at feed and comes out again where it went in.

This is what a hole is, for the table, for pictures and for comparing two programs. A visit is a stretch of rows along Z
alone. It is a hole, whatever the tool (a drill, a tap, an end mill; not a probe), if it begins and ends at least as high as
its first cut begins, or if its tool goes nowhere else after it: a plunge into a pocket ends below. A step of a cycle that is
called drilling is one even if the tool goes on from there, to mill a thread. Where a blank is known, a way that ends above it
or goes beside it cuts nothing and is no hole. On a lathe it lies on the axis. A bore that a
cycle mills on a helix is a hole as well, as wide as what the mill sweeps in its circle at the bottom; one milled in single
blocks is none here: `Run.design` names it, from what is left of the blank.
"""

from __future__ import annotations

import math
import re
from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple, Protocol

import numpy as np
from numpy.typing import NDArray

from mnclab.path.listing import MM, Unit
from mnclab.path.tool import POINTED, Tool
from mnclab.path.toolpath import Array, Index, Kind, Mask, Toolpath
from mnclab.text.given import fitting_class
from mnclab.text.tables import Rows

BORED = re.compile(r" circle at the bottom$")  # labels of cycles that mill a bore
DRILLED = re.compile(r" (peck|drill|ream|bore|centre|countersink|cut the thread)( \d+ of \d+)?$")
SAME = 1e-6  # mm: places nearer than this are one
RINGS = 9  # under a tool, its axis among them, on which a blank is looked for


class HoleMade(NamedTuple):
    """What one tool does at one place: mm; `top` is where the first cut begins, above the material by the set-up clearance,
    `bottom` the lowest place of the tip. `lines` are those of the program, in its order."""

    x: float
    y: float
    top: float
    bottom: float
    diameter: float
    tool: int
    lines: tuple[int, ...]


@fitting_class
class Holes(Rows[HoleMade]):
    """The holes of a path in the order of drilling: a row for each place and tool; a table when shown.

    `first` are the rows of the path that cut each of them first. `reach` is "up to line 12, where the run stopped" if the
    path ends before its program, and tells of tilted tools, whose holes are left out; else it is empty.
    """

    HEAD = ("hole", "x", "y", "from z", "to z", "diameter", "tool", "lines")
    NUMBERS, LENGTHS, NOTHING = range(6), range(1, 6), "no holes"

    def __init__(self, rows: Sequence[HoleMade], unit: Unit = MM, reach: str = "", first: Sequence[int] = ()) -> None:
        super().__init__(rows, unit, reach)
        self.first = tuple(first)

    @property
    def rows(self) -> tuple[HoleMade, ...]:
        """The holes as they are."""
        return self._rows

    def __getitem__(self, which: Any) -> Any:
        found = super().__getitem__(which)
        if isinstance(which, slice):
            found.first = self.first[which]
        return found

    def columns(self) -> dict[str, NDArray[Any]]:
        """The table as arrays, mm, without the lines."""
        return {name: np.array([getattr(row, name) for row in self]) for name in HoleMade._fields[:-1]}

    def texts(self) -> list[tuple[str, ...]]:
        """The rows as they are shown, lengths in the unit of the program."""
        told = []
        for number, row in enumerate(self, 1):
            sizes = (self.unit.figure(size) for size in row[:4])
            wide = self.unit.figure(row.diameter) if row.diameter else ""
            lines = ", ".join(map(str, row.lines[:3])) + (" …" if len(row.lines) > 3 else "")
            told.append((str(number), *sizes, wide, f"T{row.tool}" if row.tool else "", lines))
        return told


class Stock(Protocol):
    """A blank, in the coordinates of a path."""

    def faces(self, x: Array, y: Array) -> tuple[Array, Array]:
        """How low and how high it reaches at points (m,); nan beside it."""


def holes(
    path: Toolpath, tools: Mapping[int, Tool] | None = None, numbers: Index | None = None, reach: str = "",
    stock: Stock | None = None,
) -> Holes:  # fmt: skip
    """The holes of a path; `tools` by their numbers and the number of each row (n,) give the diameters, `stock` is the blank."""
    numbers, tools = path.tool.astype(np.int64) if numbers is None else numbers, tools or {}
    rows = np.flatnonzero(path.is_motion & ((path.start != path.end).any(axis=1) | (path.kind == Kind.ARC)))
    along = (np.abs(path.start[rows, :2] - path.end[rows, :2]) < SAME).all(axis=1) & (path.kind[rows] != Kind.ARC)
    if path.lathe:
        along &= np.abs(path.end[rows, 0]) < SAME
    change = np.diff(along.astype(np.int8), prepend=0, append=0)
    tool = numbers[rows]
    found: list[tuple[int, HoleMade]] = []
    for begin, end in zip(np.flatnonzero(change == 1).tolist(), np.flatnonzero(change == -1).tolist()):
        changes = np.flatnonzero(np.diff(tool[begin:end])) + 1
        for visit in np.split(np.arange(begin, end), changes):
            last = visit[-1] + 1 == len(rows) or tool[visit[-1] + 1] != tool[visit[-1]]
            if (each := _hole(path, rows[visit], numbers, tools, last)) is not None:
                found.append(each)
    found += [(row, _bore(path, row, numbers)) for row in np.flatnonzero(_bored(path)).tolist()]
    made: dict[tuple[float, float, float, int], HoleMade] = {}
    first: dict[tuple[float, float, float, int], int] = {}
    for row, hole in sorted(found, key=lambda each: each[0]):
        if stock is not None and not _meets(hole, tools.get(hole.tool, Tool()), stock):
            continue
        key = round(hole.x / SAME), round(hole.y / SAME), round(hole.diameter / SAME), hole.tool
        before = made.get(key)
        first.setdefault(key, row)
        made[key] = hole if before is None else before._replace(
            top=max(before.top, hole.top), bottom=min(before.bottom, hole.bottom),
            lines=tuple(dict.fromkeys(before.lines + hole.lines)),
        )  # fmt: skip
    if (np.isin(path.kind, (Kind.LINE, Kind.ARC)) & (path.directions[:, 2] < 1 - SAME)).any():
        reach = "; ".join(["along Z, what tilted tools cut is left out", *([reach] if reach else [])])
    return Holes(list(made.values()), path.unit, reach, list(first.values()))


def _hole(
    path: Toolpath, visit: NDArray[np.int64], numbers: Index, tools: Mapping[int, Tool], last: bool
) -> tuple[int, HoleMade] | None:
    """What a stretch of rows along Z makes, the `last` of its tool, and its first cut; None for a plunge, a retract, a way
    through the air."""
    start, end = path.start[visit, 2], path.end[visit, 2]
    cuts = (path.kind[visit] == Kind.LINE) & (end < start)
    if not cuts.any():
        return None
    first = int(cuts.argmax())
    top, bottom, number = float(start[first]), float(end[cuts].min()), int(numbers[visit[first]])
    stays = end[-1] < top - SAME and not last and not DRILLED.search(path.labels[path.label[visit[first]]])
    if stays or (number in tools and tools[number].kind == "probe"):
        return None
    x, y = path.end[visit[0], :2].tolist()
    diameter = 2 * tools[number].effective_radius if number in tools else 0.0
    lines = tuple(dict.fromkeys(path.line[visit[cuts]].tolist()))
    return int(visit[first]), HoleMade(x + 0.0, y + 0.0, top, bottom, diameter, number, lines)


def _meets(hole: HoleMade, tool: Tool, stock: Stock) -> bool:
    """Whether a tool meets a blank on its way down: at its axis, or on the rings of its point up to the rim."""
    angle = tool.angle or POINTED.get(tool.kind, 0.0)
    rise = 1 / math.tan(math.radians(angle) / 2) if tool.kind in POINTED and 0 < angle < 180 else 0.0
    rho, turn = np.meshgrid(np.linspace(0, hole.diameter / 2 * (1 - SAME), RINGS), np.linspace(0, 2 * np.pi, 8 * RINGS))
    floor, top = stock.faces((hole.x + rho * np.cos(turn)).ravel(), (hole.y + rho * np.sin(turn)).ravel())
    edge = rise * rho.ravel()
    return bool(((top > hole.bottom + edge + SAME) & (floor < hole.top + edge)).any())


def _bored(path: Toolpath) -> Mask:
    """Rows (n,) that go round at the bottom of a bore along Z."""
    labels = [number for number, label in enumerate(path.labels) if BORED.search(label)]
    return (path.kind == Kind.ARC) & np.isin(path.label, labels) & (path.axis[:, 2] > 1 - SAME)


def _bore(path: Toolpath, row: int, numbers: Index) -> HoleMade:
    """The bore to whose bottom a row belongs: as wide as what the tool sweeps."""
    centre, bottom = path.centre[row], float(path.end[row, 2])
    radius = float(np.hypot(*(path.start[row] - centre)[:2]) + path.radius[row])
    begin = row
    while begin and path.step[begin - 1] == path.step[row] and np.isfinite(path.feed[begin - 1]):
        begin -= 1
    top, (x, y) = float(path.start[begin : row + 1, 2].max()), centre[:2].tolist()
    return HoleMade(x + 0.0, y + 0.0, top, bottom, 2 * radius, int(numbers[row]), (int(path.line[row]),))


def places(found: Holes) -> Array:
    """Where holes stand and how wide they are, each place once with its widest tool (n, 3), mm."""
    widest: dict[tuple[int, int], tuple[float, float, float]] = {}
    for row in found:
        key = round(row.x / SAME), round(row.y / SAME)
        before = widest.get(key)
        if before is None or row.diameter > before[2]:
            widest[key] = row.x, row.y, row.diameter
    return np.array(list(widest.values()), dtype=np.float64).reshape(-1, 3)
