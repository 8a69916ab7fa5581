"""Trials side by side as a table, a row each; and strategies of clearing an area with a mill, which are trials."""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Callable, Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any, ClassVar, Generic, TypeVar

import numpy as np

from mnclab.comparison.chips import fed, tooth_rate
from mnclab.comparison.programs import program
from mnclab.geometry.contours import Contour
from mnclab.geometry.regions import Region
from mnclab.geometry.sweeps import covered, left_over, polygons
from mnclab.machining.milling.clearing import HOPPED, NOWHERE, Clearing, begin, end
from mnclab.machining.milling.engagement import Engagement, engagement
from mnclab.machining.milling.entries import VERTICAL, Entry, descent, toolpath
from mnclab.machining.milling.rest import left_between, reached, rest_passes
from mnclab.machining.milling.strategies import STRATEGIES, TANGENT, clear
from mnclab.path.limits import Limits, limits_of
from mnclab.path.profile import Profile
from mnclab.path.tool import Tool
from mnclab.path.toolpath import Kind, Toolpath
from mnclab.text.alarm import Alarm, hint
from mnclab.text.file import save_as
from mnclab.text.given import check_number, choice, faults_as_alarms, fitting, plain, shown
from mnclab.text.opening import progress
from mnclab.text.tables import Listing, write_csv

if TYPE_CHECKING:
    from mnclab.show.plot.picture import Picture


Titles = dict[str, tuple[str, str, Callable[[Any], Any]]]  # of every column what it is, how it is written, and its value


@dataclass(frozen=True, eq=False, repr=False)
class Tried:
    """What is compared: a path under axis limits, or else with rapids at a rate in mm/min."""

    titles: ClassVar[Titles]
    name: str
    path: Toolpath
    limits: Limits | None
    rapid_rate: float

    @property
    def row(self) -> dict[str, Any]:
        """Every column by its name, but those of which nothing is known."""
        known = ((name, value(self)) for name, (_, _, value) in self.titles.items())
        return {name: value for name, value in known if value is not None}

    def __repr__(self) -> str:
        row, wide = self.row, max(len(title) for title, _, _ in self.titles.values())
        said = ((*self.titles[name][:2], value) for name, value in row.items())
        return "\n".join(f"{title:{wide}}  {form.format(value)}" for title, form, value in said)

    @cached_property
    def time(self) -> float:
        """Seconds: by the feed-rate profile where axis limits are given, else length over feed."""
        if self.limits is not None:
            return Profile(self.path, self.limits).time
        feed = np.where(np.isinf(self.path.feed), self.rapid_rate, self.path.feed)
        return float((self.path.lengths / feed).sum() * 60)

    def length(self, rapid: bool) -> float:
        """Millimetres at rapid, or of everything else."""
        return float(self.path.lengths[(self.path.kind == Kind.RAPID) == rapid].sum())


One = TypeVar("One", bound=Tried)


MORE = ("covered", "removed", "removal")  # columns of which more is better


class Table(Listing, Generic[One]):
    """Trials by number or by name."""

    titles: ClassVar[Titles]
    trials: tuple[One, ...]

    @abstractmethod
    def plot(self, **options: Any) -> Picture:
        """The trials side by side."""

    def __len__(self) -> int:
        return len(self.trials)

    def __getitem__(self, key: int | str) -> One:
        if not isinstance(key, str):
            return self.trials[key]
        for trial in self.trials:
            if trial.name == key:
                return trial
        raise KeyError(f"{key!r} was not compared; there are {', '.join(trial.name for trial in self.trials)}")

    @cached_property
    def rows(self) -> tuple[dict[str, Any], ...]:
        return tuple(trial.row for trial in self.trials)

    @property
    def told(self) -> Titles:
        """The columns of which something is known."""
        return {name: told for name, told in self.titles.items() if all(name in row for row in self.rows)}

    def columns(self) -> dict[str, np.ndarray]:
        """The table as arrays, for pandas, polars or matplotlib."""
        return {name: np.array([row[name] for row in self.rows]) for name in self.told}

    def to_pandas(self) -> Any:
        """The table as a data frame of pandas, its titles as columns."""
        return super().to_pandas().rename(columns={name: title for name, (title, _, _) in self.told.items()})

    def best(self, by: str = "time") -> One:
        """The trial with the least value in a column: its name (`columns()` lists them) or its title; the greatest where more
        is better, as of what is covered and removed."""
        names = list(self.told)[1:]
        titled = {title: name for name, (title, _, _) in self.told.items()}
        if titled.get(by, by) not in names:
            near = hint(str(by)[:40], names, 1)
            raise Alarm(f"trials are compared by {', '.join(names)}; got {shown(by)}", hint=near)
        name = titled.get(by, by)
        values = [row[name] for row in self.rows]
        return self.trials[values.index(max(values) if name in MORE else min(values))]

    def save(self, path: str | Path, **options: Any) -> Path:
        """Write the table (.csv) or the picture (.svg, .pdf, .png); `options` are those of `plot`."""
        return save_as(self, path, WRITERS, "cannot write a comparison as {}", **options)

    @property
    def head(self) -> tuple[str, ...]:
        return tuple(title for title, _, _ in self.told.values())

    def texts(self) -> list[tuple[str, ...]]:
        """What the table says, row by row, the numbers as they are shown."""
        return [tuple(form.format(row[name]) for name, (_, form, _) in self.told.items()) for row in self.rows]

    def table(self) -> tuple[tuple[str, ...], list[tuple[str, ...]], Collection[int]]:
        """Titles, rows of texts, and which columns are numbers."""
        return self.head, self.texts(), range(1, len(self.told))


def _write_picture(table: Table[Any], path: Path, **options: Any) -> None:
    from mnclab.show.plot.picture import write

    write(table.plot(**options), path)


WRITERS: dict[str, Callable[..., None]] = {".csv": write_csv, **dict.fromkeys((".svg", ".pdf", ".png"), _write_picture)}


# Strategies on one area, side by side: way, time, what is left, and how hard the tool works.
#
# Lengths in mm, feeds in mm/min, times in s; angles in rad inside and in degrees wherever they are shown.
#
#     reachable = where the tool centre may go, grown by the tool radius
#     rest      = reachable less what the passes cover         corners = the area less its allowance less reachable
#
# Engagement, chips and removal are those of one level of the given depth, for everything that runs at it: passes and links. The
# entries clear what is below them and are not counted. "fine" cuts only what a coarse tool has left; what that tool cleared
# counts as cleared, and as air.
#
#     chip = f_z·sin φ for an engagement φ below 90°, f_z from there on         f_z = feed / (speed · teeth)

Strategies = Iterable[str] | Mapping[str, str | Clearing | Callable[[Region, float, float], Clearing]]

FINE = "fine"  # fine roughing, after a coarse tool
MOST = 100_000  # tool radii, about as long as a way may be
PLACES = 10  # to a tool radius, at which the engagement is looked at; twice as many for chips

#: Every column of a comparison: what it is, how it is written, and its value.
COLUMNS: Titles = {
    "strategy": ("strategy", "{}", lambda trial: trial.name),
    "length": ("cutting length, mm", "{:.0f}", lambda trial: trial.length(rapid=False)),
    "rapid": ("rapid length, mm", "{:.0f}", lambda trial: trial.length(rapid=True)),
    "moves": ("moves", "{}", lambda trial: len(trial.path)),
    "lifts": ("lifts", "{}", lambda trial: sum(not k for piece in trial.clearing.pieces for k in piece.linked)),
    "time": ("time, s", "{:.1f}", lambda trial: trial.time),
    "covered": ("covered, %", "{:.2f}", lambda trial: 100 * trial.covered),
    "rest": ("rest, mm²", "{:.2f}", lambda trial: trial.rest.area),
    "corners": ("corners, mm²", "{:.2f}", lambda trial: trial.corners.area),
    "mean": ("engagement: mean, °", "{:.0f}", lambda trial: float(np.degrees(trial.engagement.mean()))),
    "p95": ("95 % of the way below, °", "{:.0f}", lambda trial: float(np.degrees(trial.engagement.percentile(0.95)))),
    "most": ("greatest, °", "{:.0f}", lambda trial: float(np.degrees(trial.engagement.most()))),
    "above": ("above the limit, %", "{:.1f}", lambda trial: 100 * trial.engagement.share_above(trial.limit)),
    "chip": ("greatest chip, mm", "{:.3f}", lambda trial: float(trial.chip.max(initial=0.0)) if trial.tooth_rate else None),
    "removal": ("removal: mean, cm³/min", "{:.2f}", lambda trial: trial.engagement.along_the_way(trial.removal)),
    "removal_most": ("greatest, cm³/min", "{:.2f}", lambda trial: float(trial.removal.max(initial=0.0))),
}


@dataclass(frozen=True, eq=False, repr=False)
class Trial(Tried):
    """One strategy on one area: its passes, the whole path, and what comes of it.

    `depth` and `allowance` mm; `feed` (n,) mm/min is that at each of the samples of the `engagement`, `tooth_rate` how many
    teeth cut in a minute, 0 where that is not known; `limit` rad is the engagement above which the share of the way is told.
    """

    titles: ClassVar = COLUMNS
    region: Region
    clearing: Clearing
    engagement: Engagement
    depth: float
    feed: np.ndarray
    limit: float
    allowance: float
    before: Region = NOWHERE  # what a coarse tool has cleared
    tooth_rate: float = 0.0

    @property
    def entries(self) -> np.ndarray:
        """Where the tool goes down into material, `(n, 2)`."""
        spots = []
        for piece in self.clearing.pieces:
            lifted = [k for k, linked in enumerate(piece.linked, 1) if not linked and not piece.begins_cleared(k)]
            spots += [*([] if piece.from_side else [piece.entry]), *(begin(piece.passes[k]) for k in lifted)]
        return np.array(spots).reshape(-1, 2)

    @cached_property
    def _areas(self) -> tuple[Any, Any, Any]:
        whole = polygons(self.region.inset(self.allowance))
        reach = polygons(self.clearing.centres.offset(self.clearing.radius)) if self.clearing.centres.loops else whole
        return whole, reach, covered(self.clearing.passes, self.clearing.radius).union(polygons(self.before))

    @cached_property
    def rest(self) -> Region:
        """What the tool could have reached and has left standing."""
        return left_over(*self._areas[1:], self.clearing.radius * 1e-3)

    @cached_property
    def corners(self) -> Region:
        """What the tool is too large for."""
        return left_over(*self._areas[:2], self.clearing.radius * 1e-3)

    @cached_property
    def covered(self) -> float:
        """The share of the reachable area that is cleared."""
        reach = self._areas[1]
        return float(1 - self.rest.area / reach.area) if reach.area else 1.0

    @property
    def removal(self) -> np.ndarray:
        """What is cut at each sample of the engagement, cm³/min."""
        return self.engagement.width * self.depth * self.feed / 1000

    @property
    def chip(self) -> np.ndarray:
        """The greatest thickness of a chip at each sample of the engagement, mm `(n,)`; nan where teeth or speed is unknown."""
        return self.engagement.thickness * self.feed / (self.tooth_rate or np.nan)

    @fitting
    def program(self, control: str, tool: int = 1, spindle: float = 8000.0, decimals: int = 6) -> str:
        """The path as a program of plain blocks for the control "g43", "mnc" or "tnc-620", whose run is this path again:
        `mnclab.run(trial.program("mnc"), "mnc")`. The datum is that of the region, Z0 the surface.

        `tool` is its number; `spindle`, in rev/min, is for a trial that has none; `decimals` are three to nine:
        positions are half a unit of the last one off at most along each axis. An entry helix is chords within 0.001 mm on the
        MNC, whose manual has no helix.
        """
        return program(self.path, control, tool, spindle, decimals)

    def plot(self, kind: str = "paths", **options: Any) -> Picture:
        """The picture of a comparison, of this trial alone."""
        return Comparison((self,)).plot(kind, **options)


@dataclass(frozen=True, eq=False, repr=False)
class Comparison(Table[Trial]):
    """Trials of several strategies on one area; a table when shown."""

    titles: ClassVar = COLUMNS
    trials: tuple[Trial, ...]

    def plot(self, kind: str = "paths", **options: Any) -> Picture:
        """Side by side "paths", coloured by engagement, "engagement" along the way, or what "passes" leave (needs matplotlib)."""
        from mnclab.show.plot.pocketing import plot_strategies

        return plot_strategies(self, kind, **options)


@fitting
@faults_as_alarms()
def compare(
    region: Region, tool: Tool | float, strategies: Strategies | None = None, *more: str, overlap: float = 0.5,
    stepover: float | None = None, allowance: float = 0.0, depth: float = 1.0, feed: float = 500.0,
    plunge_feed: float = 150.0, rapid: float = 10000.0, entry: Entry = VERTICAL, climb: bool = True,
    limit: float = 90.0, limits: Limits | str | None = None, machine: Limits | str | None = None,
    coarse: Tool | float | None = None, chip: float | None = None, spindle: float | None = None,
    stock: Region | None = None, smallest: float | None = None,
) -> Comparison:  # fmt: skip
    """Try strategies on an area with one tool (a `Tool`, or its radius) and put what comes of it side by side:
    `compare(region, mnclab.Tool(diameter=8), "rings", "spiral", machine="small-mill")`.

    `strategies` are names, one after the other or a list: "rings", "spiral", "zigzag", "one way", "trochoidal", "adaptive",
    "peeling", "rounded rings", "rounded zigzag" (None: all of `mnclab.strategies.STRATEGIES`), or a mapping from names to a
    strategy, a `Clearing`, or a function of region, tool radius and stepover. With a `coarse` tool, which has been there before,
    there is also "fine", what this one has to do after it; the others do everything with the one tool.

    `overlap` is the share of the tool diameter that two passes have in common; `stepover` says it in mm instead. `limit` is
    the engagement in degrees above which the share is counted. With axis `limits` (or those of a `machine` by its name,
    `mnclab.machines()`) the time comes from the feed-rate profile, else it is length over feed. `depth` of the level and
    `allowance` in mm, `feed`, `plunge_feed` and `rapid` in mm/min, `entry` an `Entry`, `climb` or conventional milling.

    With a `chip` in mm none of any cutting row is thicker: `compare(region, mnclab.Tool(radius=4, teeth=3), chip=0.05,
    spindle=8000, feed=2400)`, `spindle` in rev/min. With f_z = feed / (spindle · teeth), mm, the greatest chip thickness at the
    engagement φ is f_z · sin φ, and f_z from 90° on, as in any handbook of milling. So `feed` is that in air and the upper
    bound, a cutting row has chip · spindle · teeth / sin φ. Rows are parted where that changes by more than a tenth ("moves"
    counts the parts), entries keep the `plunge_feed`, the limits of the machine hold. `spindle` without a `chip`: how thick chips
    are at the one `feed`. Each trial has `chip` (mm) and `feed` (mm/min), `(n,)` at the n samples of its `engagement`.

    Where a `stock` is given there is material in it alone, the rest of the area is air: sides are open there, and the tool comes
    in from outside. `mnclab.strategies.rest(region, tool)` is what a tool has left to this one. `smallest` mm is the least radius
    of the path of the strategies that round their corners (None: a tenth of the tool radius).

    The table has `best("time")`, `save("t.csv")` or "t.svg", `to_pandas()`, `plot()`. An Alarm where the tool does not fit.
    """
    limits = limits_of(limits, machine)
    if isinstance(strategies, str) or more:
        strategies = (*([strategies] if isinstance(strategies, str) else strategies or ()), *more)
    known = (*STRATEGIES, FINE) if coarse is not None else tuple(STRATEGIES)
    strategies = known if strategies is None else strategies
    _check(region, strategies, known)
    _check_numbers(depth, feed, plunge_feed, rapid, allowance, limit)
    if not isinstance(entry, Entry):
        raise Alarm(f"the entry must be an Entry, got {shown(entry)}", hint='mnclab.strategies.Entry("helix", 3)')
    if not isinstance(climb, bool | np.bool_):
        raise Alarm(f"climb must be True or False, got {shown(climb)}")
    depth, feed, plunge_feed, rapid, allowance, limit = plain([depth, feed, plunge_feed, rapid, allowance, limit])
    radius = _radius(tool, "the tool")
    rate = 0.0 if chip is None and spindle is None else tooth_rate(tool, radius, chip, spindle, limits)
    if stepover is None:
        check_number(overlap, "the overlap (of two passes, a share of the tool diameter)", at_least=0)
        if not overlap < 1:
            raise Alarm(f"the overlap must be below 1, the whole tool diameter, got {overlap:g}")
        stepover = 2 * radius * (1 - plain(overlap))
    check_number(stepover, "the stepover (mm)", above=0)
    stepover = plain(stepover)
    if region.area / stepover / radius > MOST:
        raise Alarm(f"a stepover of {stepover:g} mm is too small for this area: there is no end to such a way")
    _check_stock(region, stock, strategies, smallest, radius)
    air = NOWHERE if stock is None else region.difference(stock)
    named = strategies if isinstance(strategies, Mapping) else {name: name for name in strategies}
    trials = []
    with progress("comparing", len(named), "strategies") as done:
        for name, how in named.items():
            before, stands = air, stock
            if how == FINE:
                clearing, before, stands = _fine(region, radius, stepover, _radius(coarse, "the coarse tool"), allowance, climb)
            elif isinstance(how, str):
                least = {"smallest": plain(smallest)} if smallest is not None and how in TANGENT else {}
                clearing = clear(how, region, radius, stepover, allowance=allowance, climb=climb, stock=stock, **least)
            else:
                clearing = how if isinstance(how, Clearing) else how(region, radius, stepover)
            path = toolpath(clearing, (-depth,), entry=entry, feed=feed, plunge_feed=plunge_feed, climb=climb)
            moves, counted = level_moves(clearing, entry, depth, climb)
            found = engagement(moves, radius, spacing=radius / PLACES / (1 if chip is None else 2), stock=stands)
            kept = np.array(counted, dtype=bool)
            found = found.chosen(kept[found.move])
            feeds = np.full(len(found.way), feed)
            if chip is not None and len(feeds):
                apart = np.cumsum([contour.length for contour in moves] * ~kept)  # the way of entries before each move
                path, feeds = fed(path, -depth, found.way - apart[found.move], found.thickness, feed, plain(chip) * rate)
            if spindle is not None:
                path = path.replace(spindle=np.full(len(path), float(spindle)))
            way = name, path, limits, rapid
            trials.append(Trial(*way, region, clearing, found, depth, feeds, np.radians(limit), allowance, before, rate))
            done(len(trials))
    return Comparison(tuple(trials))


def _radius(tool: Any, name: str) -> float:
    radius = plain(tool.effective_radius if isinstance(tool, Tool) else tool)
    check_number(radius, f"{name} (its radius, mm, or a Tool)", above=0)
    return float(radius)


def _fine(
    region: Region, radius: float, stepover: float, coarse: float, allowance: float, climb: bool
) -> tuple[Clearing, Region, Region]:
    """Fine roughing after a coarse tool: its passes, what is cleared before them, and what stands."""
    clearing = rest_passes(region, radius, stepover, coarse, allowance=allowance, climb=climb)
    if not clearing.pieces:
        raise Alarm(f"a coarse tool of radius {coarse:g} leaves nothing to one of {radius:g}", hint="take a larger coarse tool")
    return clearing, reached(region, coarse, allowance), left_between(region, radius, coarse, allowance)


def _check(region: Region, strategies: Strategies, known: Sequence[str]) -> None:
    if not isinstance(region, Region):
        example = "mnclab.area.Region.of(mnclab.area.rectangle(60, 40))"
        raise Alarm(f"strategies are compared on a Region, got {shown(region)}", hint=example)
    named = strategies.values() if isinstance(strategies, Mapping) else strategies
    if not isinstance(named, Iterable):
        example = f'["rings", "spiral"], or a dict of names; known: {", ".join(known)}'
        raise Alarm(f"strategies must be a list of names, got {shown(strategies)}", hint=example)
    for how in named:
        if not isinstance(how, Clearing) and not callable(how):
            if how == FINE and FINE not in known:
                raise Alarm("the strategy fine needs to know which coarse tool was there before", hint="coarse=10.0, its radius")
            choice(how, "a strategy", known)


def _check_stock(region: Region, stock: Any, strategies: Strategies, smallest: Any, radius: float) -> None:
    ways = list(strategies.values() if isinstance(strategies, Mapping) else strategies)
    names = {how for how in ways if isinstance(how, str)}
    if stock is not None:
        if not isinstance(stock, Region):
            example = "mnclab.strategies.rest(region, tool): what another tool has left"
            raise Alarm(f"the stock must be a Region, got {shown(stock)}", hint=example)
        if not region.intersection(stock).loops:
            raise Alarm("nothing of the stock lies in the area: there is nothing to clear")
        if FINE in names:
            raise Alarm("what stands before fine is what its coarse tool left", hint="a stock or a coarse tool, not both")
    if smallest is not None:
        check_number(smallest, "the smallest radius of the path (mm)", above=0, at_most=radius)
        if not names & set(TANGENT):
            raise Alarm(f"a smallest radius is one of {', '.join(TANGENT)}: none of them is compared")


def _check_numbers(
    depth: float, feed: float, plunge_feed: float, rapid: float, allowance: float, limit: float
) -> None:  # fmt: skip
    check_number(depth, "the depth of a level (mm)", above=0)
    check_number(feed, "the feed (mm/min)", above=0)
    check_number(plunge_feed, "the plunge feed (mm/min)", above=0)
    check_number(rapid, "the rapid rate (mm/min)", above=0)
    check_number(allowance, "the allowance (mm)", at_least=0, at_most=1e6)
    check_number(limit, "the limit (of the engagement, degrees)", at_least=0, at_most=360)


def level_moves(clearing: Clearing, entry: Entry, depth: float, climb: bool) -> tuple[list[Contour], list[bool]]:
    """Everything that a clearing runs at its level, in order, and which of it is counted: all but the entries."""
    moves: list[Contour] = []
    counted: list[bool] = []
    for piece in clearing.pieces:
        for k in range(max(1, len(piece.passes))):
            if not (k and piece.linked[k - 1]) and (piece.passes or piece.place is not None):
                down = descent(piece, entry, clearing.radius, 0.0, -depth, climb, k)
                moves.append(down.contour if down.clears else Contour(down.contour.points[[0, 0]], closed=False))
                counted.append(False)
            if not piece.passes:
                continue
            before, contour = end(moves[-1]), piece.passes[k]
            hopped = k and piece.linked[k - 1] == HOPPED
            linked = not hopped and np.hypot(*(begin(contour) - before)) > 1e-9
            moves += [*([Contour([before, begin(contour)], closed=False)] if linked else []), contour]
            counted += [*([True] if linked else []), not piece.labels[k].startswith("entry")]
    return moves, counted
