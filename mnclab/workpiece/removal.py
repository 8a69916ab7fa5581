"""Removal over time: how much material each row of a path takes away, and how fast."""

from __future__ import annotations

from functools import cached_property
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from mnclab.path.columns import Array, Index
from mnclab.path.kinds import Kind
from mnclab.path.profile import Profile
from mnclab.path.tool import Tool
from mnclab.text.given import choice
from mnclab.text.records import written
from mnclab.text.rounded import Rounded
from mnclab.text.tables import html_table
from mnclab.workpiece.ahead import greatest
from mnclab.workpiece.workpiece import Workpiece

if TYPE_CHECKING:
    from matplotlib.figure import Figure

KEYS = ("line", "tool")
CUTS = (Kind.LINE, Kind.ARC)
FEW = 30  # rows of a tool
CELLS = 4
HEAD = ("tool", "removed", "time in material", "mean rate", "largest rate", "in line")


class Fastest(NamedTuple):
    """Where most is taken away in its time: `rate` mm³/min, `line` of program number `program`, `row` of the path."""

    rate: float
    line: int
    program: int
    row: int

    def __repr__(self) -> str:
        return written(self)


class Met(NamedTuple):
    """Rows (k,) where Q is the greatest: `rate` mm³/min, and what is before the tool there, as `Ahead` has it."""

    row: Index
    rate: Array
    area: Array
    depth: Array
    width: Array
    angle: Array

    def among(self, rows: Index) -> Met:
        """Those of some rows where a depth of cut is known."""
        return Met._make(each[np.isin(self.row, rows) & (self.depth > 0)] for each in self)


class Removal:
    """What a workpiece lost while a profile went on; both belong to the same path of n rows.

    `volumes` (n,) mm³ and `seconds` (n,) are those of each row, `rate` (n,) mm³/min its mean rate, 0 where it cuts
    nothing, and `greatest` (n,) its greatest: that of a place in the material, as `mnclab.workpiece.ahead` finds it.
    """

    def __init__(self, workpiece: Workpiece, profile: Profile) -> None:
        self.workpiece, self.profile = workpiece, profile
        self.volumes, self.seconds = workpiece.removed_by_row(), profile.seconds[: len(workpiece.cutting)]

    @cached_property
    def rate(self) -> Array:
        found = np.zeros(len(self.volumes))
        cuts = (self.volumes > 0) & (self.seconds > 0)
        return np.divide(60 * self.volumes, self.seconds, out=found, where=cuts)

    @cached_property
    def met(self) -> Met:
        """Rows at feed: of each tool at most `FEW` at equal distances of its way, and as many with the greatest means."""
        cutting, part, length = self.workpiece.cutting, self.workpiece, self.workpiece.cutting.path.lengths
        rate, found = self._means, np.zeros((len(Met._fields), 0))
        cuts = np.flatnonzero((rate > 0) & self._at_feed & (length > 0) & ~cutting.path.synchronous)
        for tool in np.unique(cutting.which[cuts]):
            rows = cuts[cutting.which[cuts] == tool]
            if len(rows) > 2 * FEW:
                way = np.cumsum(length[rows])
                even = np.searchsorted(way, way[-1] * (np.arange(FEW) + 0.5) / FEW)
                rows = rows[np.union1d(even, np.argsort(rate[rows])[-FEW:])]
            most, before = greatest(rows, length[rows], part.reach(rows), part.ahead, self._speed)
            found = np.append(found, np.stack([rows, most, *before])[:, most > 0], axis=1)
        return Met(found[0].astype(np.int64), *found[1:])

    @cached_property
    def greatest(self) -> Array:
        """The greatest rate (n,), mm³/min, of the rows of `met`; of others the mean, no more than the greatest of their tool."""
        met, which, found = self.met, self.workpiece.cutting.which, self._means.copy()
        for tool in np.unique(which[met.row]):
            others = self._at_feed & (which == tool)
            found[others] = np.minimum(found[others], met.rate[which[met.row] == tool].max())
        found[met.row] = met.rate
        return found

    @cached_property
    def _means(self) -> Array:
        """The mean rate (n,) of each row, of a mill with what is about it within `CELLS` cells of its raster: of less it is
        counted too roughly."""
        path, wide = self.workpiece.cutting.path, CELLS * getattr(self.workpiece, "step", 0.0)
        s, feeds = np.append(0.0, np.cumsum(path.lengths)), self._at_feed
        taken, middle = np.append(0.0, np.cumsum(self.volumes * feeds)), (s[1:] + s[:-1]) / 2
        half = np.maximum(path.lengths, wide) / 2
        volume, seconds = (
            np.interp(middle + half, at, sums) - np.interp(middle - half, at, sums)
            for at, sums in ((s, taken), (self.profile.s, self.profile.t))
        )
        short = feeds & (self.volumes > 0) & (path.lengths < wide) & (seconds > 0)
        return np.where(short, 60 * volume / np.where(short, seconds, 1.0), self.rate)

    def _speed(self, rows: Index, share: Array) -> Array:
        """mm/min at shares (k,) of rows: with a constant acceleration v² grows with the way."""
        length = self.workpiece.cutting.path.lengths
        s = (np.cumsum(length) - length)[rows] + share * length[rows]
        return np.asarray(60 * np.sqrt(np.interp(s, self.profile.s, self.profile.v**2)))

    @property
    def volume(self) -> float:
        """All that was taken away, mm³."""
        return float(self.volumes.sum())

    @property
    def time(self) -> float:
        """Seconds of the rows that take something away."""
        return float(self.seconds[self.volumes > 0].sum())

    @property
    def mean(self) -> float:
        """mm³/min while something is taken away at feed: what a rapid tears away is no rate."""
        return self._mean(self._at_feed)

    def _mean(self, rows: Any) -> float:
        seconds = float(self.seconds[rows & (self.volumes > 0)].sum())
        return 60 * float(self.volumes[rows].sum()) / seconds if seconds else 0.0

    @cached_property
    def _at_feed(self) -> Any:
        return np.isin(self.workpiece.cutting.path.kind, CUTS)

    @property
    def largest(self) -> Fastest | None:
        """The row at feed with the largest rate; None if none cuts."""
        return self._fastest(self._at_feed)

    def by(self, what: str = "line") -> dict[Any, float]:
        """mm³ by "tool", or by "line": of a program that was called a pair (program, line), as `Profile.time_by` has it."""
        choice(what, "what a removal sums over", KEYS)
        cutting = self.workpiece.cutting
        own, line = cutting.path.program.tolist(), cutting.path.line.tolist()
        keys = cutting.numbers.tolist() if what == "tool" else [at if not of else (of, at) for of, at in zip(own, line)]
        found = Rounded()
        for row in np.flatnonzero(self.volumes):
            found[keys[row]] = found.get(keys[row], 0.0) + float(self.volumes[row])
        return found

    def _fastest(self, rows: Any) -> Fastest | None:
        rates = np.where(rows, self.greatest, 0.0)
        if not rates.any():
            return None
        row, path = int(rates.argmax()), self.workpiece.cutting.path
        return Fastest(float(rates[row]), int(path.line[row]), int(path.program[row]), row)

    def _tool(self, number: int) -> str:
        cutting = self.workpiece.cutting
        found: Tool | None = next((tool for tool in cutting.tools if tool.number == number), None)
        return f"T{number} {found.name if found else ''}".rstrip()

    def rows(self) -> list[tuple[str, ...]]:
        """A row of texts for each tool that took something away, and for all of them: as `HEAD` has it."""
        numbers = list(self.by("tool"))
        cut_by = self.workpiece.cutting.numbers
        groups = [(self._tool(number), cut_by == number) for number in numbers]
        groups += [("all", np.ones(len(cut_by), dtype=bool))] if len(numbers) != 1 else []
        told: list[tuple[str, ...]] = []
        for name, rows in groups:
            taken = float(self.volumes[rows].sum())
            seconds = float(self.seconds[rows & (self.volumes > 0)].sum())
            most = self._fastest(rows & self._at_feed)
            told.append((
                name, volume(taken), f"{seconds:.2f} s", f"{volume(self._mean(rows & self._at_feed))}/min",
                f"{volume(most.rate)}/min" if most else "", self.place(most) if most else "",
            ))  # fmt: skip
        return told

    def place(self, fastest: Fastest) -> str:
        """Where the largest rate is: the line, with its program where that was called."""
        return str(fastest.line) if not fastest.program else f"{fastest.program}:{fastest.line}"

    def plot(self, **options: Any) -> Figure:
        """The feed over time and the removal rate under it; see `show.plot.over_time.plot_removal`."""
        from mnclab.show.plot.over_time import plot_removal

        return plot_removal(self, **options)

    def __repr__(self) -> str:
        most = self.largest
        head = f"{volume(self.volume)} removed{self._as_far} in {self.time:.2f} s, {volume(self.mean)}/min"
        return f"<Removal: {head}{f', at most {volume(most.rate)}/min in line {self.place(most)}' if most else ''}>"

    def _repr_html_(self) -> str:
        told = f"<p>removed{self._as_far}</p>" if self._as_far else ""
        return html_table(HEAD, self.rows(), numbers=range(1, 6)) + told

    @property
    def _as_far(self) -> str:
        """How far the run went, if it stopped before its end."""
        return f" {self.workpiece.cutting.reach}".rstrip()


def volume(value: float) -> str:
    """mm³ as people say it: three figures, in cm³ from one on."""
    number, unit = (value / 1000, "cm³") if value >= 1000 else (value, "mm³")
    return f"{number:.0f} {unit}" if number >= 1000 else f"{number:.3g} {unit}"
