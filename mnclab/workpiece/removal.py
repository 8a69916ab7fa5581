"""Removal over time: how much material each row of a path takes away, and how fast."""

from __future__ import annotations

from functools import cached_property
from typing import TYPE_CHECKING, Any, NamedTuple, Unpack

import numpy as np

from mnclab.path.listing import MM, Unit
from mnclab.path.profile import Profile
from mnclab.path.tool import Tool
from mnclab.path.toolpath import Array, Index, Kind
from mnclab.text.given import FigureOptions, choice, fitting_class
from mnclab.text.tables import Listing, Pictured, Rounded, written
from mnclab.workpiece.ahead import FEW, RATE, Looks
from mnclab.workpiece.workpiece import Workpiece

if TYPE_CHECKING:
    from matplotlib.figure import Figure

KEYS = ("line", "tool")
CUTS = (Kind.LINE, Kind.ARC)
CELLS = 4
AT_LEAST = "at least "


class Fastest(NamedTuple):
    """Where most is taken away in its time: `rate` mm³/min, `line` of program number `program`, `row` of the path."""

    rate: float
    line: int
    program: int
    row: int

    def __repr__(self) -> str:
        return written(self)


@fitting_class
class Removal(Pictured, Listing):
    """What a workpiece lost while a profile went on; both belong to the same path of n rows.

    `volumes` (n,) mm³ and `seconds` (n,) are those of each row, `rate` (n,) mm³/min its mean rate, 0 where it cuts
    nothing, and `greatest` (n,) its greatest: that of a place in the material, as `mnclab.workpiece.ahead` finds it.

    A cutter of 10 mm, 5 mm deep over 80 mm:

    >>> slot = "T1 S800 M3\\nG0 X-10 Y10 Z-5\\nG1 X90 F100\\n"
    >>> run = mnc.run(slot, "mnc", tools={1: mnc.Tool(diameter=10)}, stock=(80, 60, 20))
    >>> print(f"{run.removal().volumes.sum():.3f}")
    4000.000
    """

    HEAD = ("tool", "removed", "time in material", "mean rate", "largest rate", "in line")
    NUMBERS = range(1, 6)

    def __init__(self, workpiece: Workpiece, profile: Profile) -> None:
        self.workpiece, self.profile = workpiece, profile
        self.volumes, self.seconds = workpiece.removed_by_row(), profile.seconds[: len(workpiece.cutting)]

    @cached_property
    def rate(self) -> Array:
        found = np.zeros(len(self.volumes))
        cuts = (self.volumes > 0) & (self.seconds > 0)
        return np.divide(60 * self.volumes, self.seconds, out=found, where=cuts)

    @cached_property
    def looks(self) -> dict[int, Looks]:
        """What the rows at feed of each tool, by its number, have before them: half of `FEW` at equal distances of its way, as
        many with the greatest means, and as many more as prove the greatest rate."""
        cutting, length, found = self.workpiece.cutting, self.workpiece.cutting.path.lengths, dict[int, Looks]()
        upright = True if cutting.tilted is None else ~cutting.tilted  # what is ahead of a tilted tool nobody looks at
        cuts = np.flatnonzero((self._means > 0) & self._at_feed & (length > 0) & ~cutting.path.synchronous & upright)
        for tool in np.unique(cutting.numbers[cuts]).tolist():
            rows = cuts[cutting.numbers[cuts] == tool]
            found[tool] = looks = Looks(rows, self.workpiece, self._speed, self._highest[rows])
            way = np.cumsum(length[rows])
            even = np.searchsorted(way, way[-1] * (np.arange(FEW // 2) + 0.5) / (FEW // 2))
            greatest = np.argsort(-self._means[rows], kind="stable")
            looks.look(greatest if len(rows) <= FEW else np.append(greatest[: FEW // 2], even))
            looks.proves(RATE, rows >= 0)
        return found

    def proves(self, rows: Index) -> bool:
        """Whether the greatest of `greatest` of some rows of a tool is the most: nobody looks at a thread, nor at all of very
        many rows."""
        cuts, numbers = rows[(self._means[rows] > 0) & self._at_feed[rows]], self.workpiece.cutting.numbers[rows]
        looks = [self.looks[tool] for tool in np.unique(numbers).tolist() if tool in self.looks]
        known = np.concatenate([each.rows for each in looks]) if looks else rows[:0]
        return bool(np.isin(cuts, known).all()) and all(each.proves(RATE, np.isin(each.rows, rows)) for each in looks)

    @cached_property
    def greatest(self) -> Array:
        """The greatest rate (n,), mm³/min, of rows that are looked at; of others the mean, no more than that of their tool."""
        found = self._means.copy()
        for looks in self.looks.values():
            rates, seen = looks.values[RATE], looks.seen & (looks.values[RATE] > 0)
            if seen.any():
                found[looks.rows] = np.where(seen, rates, np.minimum(found[looks.rows], rates[seen].max()))
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
        return np.minimum(60 * np.sqrt(np.interp(s, self.profile.s, self.profile.v**2)), self._highest[rows])

    @cached_property
    def _highest(self) -> Array:
        """The greatest speed (n,) of each row, mm/min."""
        v, found = self.profile.v, np.zeros(len(self.profile.seconds))
        np.maximum.at(found, self.profile.move, 60 * np.maximum(v[1:], v[:-1]))
        return found

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
        """A row of texts for each tool that took something away, and for all of them: as the heads have it."""
        numbers = list(self.by("tool"))
        cut_by = self.workpiece.cutting.numbers
        groups = [(self._tool(number), cut_by == number) for number in numbers]
        groups += [("all", np.ones(len(cut_by), dtype=bool))] if len(numbers) != 1 else []
        told: list[tuple[str, ...]] = []
        rate = self.largest.rate if self.largest else 0.0  # a column has one unit
        for name, rows in groups:
            taken = float(self.volumes[rows].sum())
            seconds = float(self.seconds[rows & (self.volumes > 0)].sum())
            mean, most = self._mean(rows & self._at_feed), self._fastest(rows & self._at_feed)
            told.append((
                name, self.told(taken, self.volume), f"{seconds:.2f} s", f"{self.told(mean, rate)}/min",
                f"{AT_LEAST * (not self.proves(np.flatnonzero(rows)))}{self.told(most.rate, rate)}/min" if most else "",
                self.place(most) if most else "",
            ))  # fmt: skip
        return told

    texts = rows

    def told(self, value: float, like: float = 0.0) -> str:
        """A volume, mm³, as `volume` says it, in the unit of the program."""
        return volume(value, self.workpiece.cutting.path.unit, like)

    def place(self, fastest: Fastest) -> str:
        """Where the largest rate is: the line, with its program where that was called."""
        return str(fastest.line) if not fastest.program else f"{fastest.program}:{fastest.line}"

    def plot(self, **options: Unpack[FigureOptions]) -> Figure:
        """The feed over time and the removal rate under it; see `show.plot.over_time.plot_removal`."""
        from mnclab.show.plot.over_time import plot_removal

        return plot_removal(self, **options)

    def __repr__(self) -> str:
        most = self.largest
        head = f"{self.told(self.volume)} removed{self._as_far} in {self.time:.2f} s, {self.told(self.mean)}/min"
        return f"<Removal: {head}{f', {self.at_most} {self.told(most.rate)}/min in line {self.place(most)}' if most else ''}>"

    @property
    def above(self) -> str:
        return f"removed{self._as_far}" if self._as_far else ""

    @property
    def at_most(self) -> str:
        """What the largest rate is, in words."""
        return "at most" if self.proves(np.arange(len(self.volumes))) else "the largest rate at least"

    @property
    def _as_far(self) -> str:
        """How far the run went, if it stopped before its end."""
        return f" {self.workpiece.cutting.reach}".rstrip()


def volume(value: float, unit: Unit = MM, like: float = 0.0) -> str:
    """mm³ as people say it: three figures, in cm³ from one on, or where one that is `like` it is; of a program in inches in³."""
    number, name = (value / 1000, "cm³") if max(value, like) >= 1000 else (value, "mm³")
    if unit.length != 1:
        number, name = value / unit.length**3, "in³"
    return f"{number:.0f} {name}" if number >= 1000 else f"{number:.3g} {name}"
