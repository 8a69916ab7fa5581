"""Strategies on one area, side by side: way, time, what is left, and how hard the tool works.

Lengths in mm, feeds in mm/min, times in s; angles in rad inside and in degrees wherever they are shown.

"fine" cuts only what a coarse tool has left; what that tool cleared counts as cleared, and as air. Walls with a draft are cut by
steps: at the depth d the area is its inset by d · tan(draft), so that nothing is cut out of a slope.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import cache, cached_property, partial
from typing import TYPE_CHECKING, Any, ClassVar, Unpack

import numpy as np

from mnclab.comparison.levels import Level, Look, fed, tooth_rate
from mnclab.comparison.programs import program
from mnclab.comparison.tables import Table, Titles, Tried
from mnclab.geometry.regions import Region
from mnclab.machining.milling.clearing import NOWHERE, Clearing
from mnclab.machining.milling.engagement import Engagement
from mnclab.machining.milling.entries import VERTICAL, Entry, toolpath
from mnclab.machining.milling.rest import left_between, reached, rest_passes
from mnclab.machining.milling.strategies import STRATEGIES, TANGENT, clear
from mnclab.path.limits import Limits
from mnclab.path.machines import limits_of
from mnclab.path.tool import Tool
from mnclab.text.alarm import Alarm
from mnclab.text.given import ColumnsOptions, check_number, choice, faults_as_alarms, fitting, plain, shown
from mnclab.text.opening import progress
from mnclab.text.tables import Pictured

if TYPE_CHECKING:
    from mnclab.show.plot.picture import Picture

Strategies = Iterable[str] | Mapping[str, str | Clearing | Callable[[Region, float, float], Clearing]]

FINE = "fine"  # fine roughing, after a coarse tool
LEVELS, APART = 1000, 1e-6  # how many there are at most, and mm between two of them
MOST = 100_000  # tool radii, about as long as a way may be
PLACES = 10  # to a tool radius, at which the engagement is looked at; twice as many for chips

#: Every column of a comparison: what it is, how it is written, and its value.
COLUMNS: Titles = {
    "strategy": ("strategy", "{}", lambda trial: trial.name),
    "length": ("cutting length, mm", "{:.0f}", lambda trial: trial.length(rapid=False)),
    "rapid": ("rapid length, mm", "{:.0f}", lambda trial: trial.length(rapid=True)),
    "moves": ("moves", "{}", lambda trial: len(trial.path)),
    "lifts": ("lifts", "{}", lambda trial: trial.lifts),
    "time": ("time, s", "{:.1f}", lambda trial: trial.time),
    "covered": ("covered, %", "{:.2f}", lambda trial: 100 * min(level.covered for level in trial.different)),
    "rest": ("rest, mm²", "{:.2f}", lambda trial: max(level.rest.area for level in trial.different)),
    "corners": ("corners, mm²", "{:.2f}", lambda trial: max(level.corners.area for level in trial.different)),
    "mean": ("engagement: mean, °", "{:.0f}", lambda trial: float(np.degrees(trial.throughout.mean()))),
    "p95": ("95 % of the way below, °", "{:.0f}", lambda trial: float(np.degrees(trial.throughout.percentile(0.95)))),
    "most": ("greatest, °", "{:.0f}", lambda trial: float(np.degrees(trial.throughout.most()))),
    "above": ("above the limit, %", "{:.1f}", lambda trial: 100 * trial.throughout.share_above(trial.limit)),
    "chip": ("greatest chip, mm", "{:.3f}", lambda trial: _greatest(trial, "chip") if trial.tooth_rate else None),
    "removal": ("removal: mean, cm³/min", "{:.2f}", lambda trial: trial.throughout.along_the_way(_all(trial, "removal"))),
    "removal_most": ("greatest, cm³/min", "{:.2f}", lambda trial: _greatest(trial, "removal")),
}


@dataclass(frozen=True, eq=False, repr=False)
class Trial(Pictured, Tried, Level):
    """One strategy on one area: the whole path, its first level, and those `below` it, each a `Level`.

    `limit` rad is the engagement above which the share of the way is told.
    """

    titles: ClassVar = COLUMNS
    limit: float
    below: tuple[Level, ...] = ()

    @property
    def levels(self) -> tuple[Level, ...]:
        """All of them from the surface down, the trial itself as the first."""
        return self, *self.below

    @property
    def different(self) -> tuple[Level, ...]:
        """One level of each clearing: all have the same where walls are upright."""
        return tuple({level.clearing: level for level in self.levels[::-1]}.values())

    @property
    def lifts(self) -> int:
        """How often the tool leaves a level, high or a little, and comes down to it again."""
        rises = self.path.end[:, 2] > self.path.start[:, 2]
        return int(rises.sum()) - sum(bool(level.clearing.pieces) for level in self.levels)

    @cached_property
    def throughout(self) -> Engagement:
        """The engagement of all levels one after the other; `move` and `way` begin anew at each."""
        return Engagement(*map(np.concatenate, zip(*(level.engagement for level in self.levels), strict=True)))

    @fitting
    def program(self, control: str, tool: int = 1, spindle: float = 8000.0, decimals: int = 6) -> str:
        """The path as a program of plain blocks for the control "g43", "mnc" or "tnc-620", whose run is this path again:
        `mnclab.run(trial.program("mnc"), "mnc")`. The datum is that of the region, Z0 the surface.

        `tool` is its number; `spindle`, in rev/min, is for a trial that has none; `decimals` are three to nine:
        positions are half a unit of the last one off at most along each axis. An entry helix is chords within 0.001 mm on the
        MNC, whose manual has no helix.
        """
        return program(self.path, control, tool, spindle, decimals)

    @fitting
    def plot(self, kind: str = "paths", **options: Unpack[ColumnsOptions]) -> Picture:
        """The picture of a comparison, of this trial alone."""
        return Comparison((self,)).plot(kind, **options)


@dataclass(frozen=True, eq=False, repr=False)
class Comparison(Table[Trial]):
    """Trials of several strategies on one area; a table when shown."""

    titles: ClassVar = COLUMNS
    trials: tuple[Trial, ...]

    @property
    def notes(self) -> tuple[str, ...]:  # type: ignore[override]
        """What one should know of a clearing, such as that it has no spiral."""
        return tuple(f"{trial.name}: {trial.clearing.note}" for trial in self.trials if trial.clearing.note)

    @fitting
    def plot(self, kind: str = "paths", **options: Unpack[ColumnsOptions]) -> Picture:
        """Side by side "paths", coloured by engagement, "engagement" along the way, or what "passes" leave: that of
        the first level of each (needs matplotlib)."""
        from mnclab.show.plot.pocketing import plot_strategies

        return plot_strategies(self, kind, **options)


@fitting
@faults_as_alarms()
def compare(
    region: Region, tool: Tool | float, strategies: Strategies | None = None, *more: str, overlap: float = 0.5,
    stepover: float | None = None, allowance: float = 0.0, depth: float | Sequence[float] = 1.0, feed: float = 500.0,
    plunge_feed: float = 150.0, rapid: float = 10000.0, entry: Entry = VERTICAL, climb: bool = True,
    limit: float = 90.0, limits: Limits | str | None = None, machine: Limits | str | None = None,
    coarse: Tool | float | None = None, chip: float | None = None, spindle: float | None = None,
    stock: Region | None = None, smallest: float | None = None, draft: float = 0.0,
) -> Comparison:  # fmt: skip
    """Try strategies on an area with one tool (a `Tool`, or its radius) and put what comes of it side by side:
    `compare(region, mnclab.Tool(diameter=8), "rings", "spiral", machine="small-mill")`.

    `strategies` are names, one after the other or a list: "rings", "spiral", "zigzag", "one way", "trochoidal", "adaptive",
    "peeling", "morphed spiral", "rounded rings", "rounded zigzag" (None: all of `mnclab.strategies.STRATEGIES`), or a mapping
    from names to a strategy, a `Clearing`, or a function of region, tool radius and stepover. With a `coarse` tool, which has
    been there before, there is also "fine", what this one has to do after it; the others do everything with the one tool.

    `overlap` is the share of the tool diameter that two passes have in common; `stepover` says it in mm instead. `limit` is
    the engagement in degrees above which the share is counted. With axis `limits` (or those of a `machine` by its name,
    `mnclab.machines()`) the time comes from the feed-rate profile, else it is length over feed. `allowance` in mm, `feed`,
    `plunge_feed` and `rapid` in mm/min, `entry` an `Entry`, `climb` or conventional milling.

    `depth` of the level in mm below the surface, or of several, one below the other: `depth=(2, 4, 5)`. Walls with a `draft`, in
    degrees, slope inwards on the way down: each level has an area and passes of its own. Lengths, moves, lifts (the small ones
    too) and time are those of the whole path; engagement, chips and removal are those of all levels together; what is covered
    and left is that of the level which has most left.

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

    >>> pocket = mnc.area.Region.of(mnc.area.rectangle(40, 20))
    >>> [trial.name for trial in mnc.compare(pocket, mnc.Tool(diameter=8), "rings", "zigzag")]
    ['rings', 'zigzag']
    """
    limits = limits_of(limits, machine)
    if isinstance(strategies, str) or more:
        strategies = (*([strategies] if isinstance(strategies, str) else strategies or ()), *more)
    known = (*STRATEGIES, FINE) if coarse is not None else tuple(STRATEGIES)
    strategies = known if strategies is None else strategies
    named = _check(region, strategies, known)
    _check_numbers(feed, plunge_feed, rapid, allowance, limit, draft)
    if not isinstance(entry, Entry):
        raise Alarm(f"the entry must be an Entry, got {shown(entry)}", hint='mnclab.strategies.Entry("helix", 3)')
    if not isinstance(climb, bool | np.bool_):
        raise Alarm(f"climb must be True or False, got {shown(climb)}")
    feed, plunge_feed, rapid, allowance, limit, draft = plain([feed, plunge_feed, rapid, allowance, limit, draft])
    depths = _depths(depth)
    steps = np.diff([0.0, *depths]).round(9).tolist()
    areas = _areas(region, depths, draft)
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
    _check_stock(region, stock, named, smallest, radius)

    def plan(how: Any, area: Region, low: float) -> tuple[Clearing, Region, Region | None]:
        """A strategy on the area of a level: its passes, what is cleared before them, and what stands."""
        if how == FINE:
            return _fine(area, radius, stepover, _radius(coarse, "the coarse tool"), allowance, climb)
        try:
            if isinstance(how, str):
                least = {"smallest": plain(smallest)} if smallest is not None and how in TANGENT else {}
                found = clear(how, area, radius, stepover, allowance=allowance, climb=climb, stock=stock, **least)
            else:
                found = how if isinstance(how, Clearing) else how(area, radius, stepover)
        except ValueError as fault:
            raise ValueError(f"{fault}, {low:g} mm deep" if draft else str(fault)) from None
        if not isinstance(found, Clearing):
            raise Alarm(f"a strategy makes a Clearing of region, radius and stepover, got {shown(found)}")
        return found, NOWHERE if stock is None else area.difference(stock), stock

    spacing = radius / PLACES / (1 if chip is None else 2)
    look = cache(partial(Look, entry=entry, climb=climb, radius=radius, spacing=spacing))
    heights = [-low for low in depths]
    trials = []
    with progress("comparing", len(named), "strategies") as done:
        for name, how in named.items():
            if draft and isinstance(how, Clearing):
                raise Alarm("a Clearing is that of one area, a draft makes one of each level", hint="a function in its place")
            plans = [plan(how, *each) for each in zip(areas, depths)] if draft else [plan(how, region, 0.0)] * len(areas)
            path = toolpath([each[0] for each in plans], heights, entry=entry, feed=feed, plunge_feed=plunge_feed, climb=climb)
            levels = []
            for area, low, step, (clearing, before, stands) in zip(areas, depths, steps, plans, strict=True):
                seen: Look = look(clearing, stands, step)
                feeds: float | np.ndarray = feed
                if chip is not None and len((found := seen.found)[1]):
                    path, feeds = fed(path, -low, found[1], found[0].thickness, feed, plain(chip) * rate)
                levels.append(Level(area, clearing, seen, low, step, feeds, allowance, before, rate))
            if spindle is not None:
                path = path.replace(spindle=np.full(len(path), float(spindle)))
            first, *below = levels
            told = {"name": name, "path": path, "limits": limits, "rapid_rate": rapid, "limit": np.radians(limit)}
            trials.append(Trial(**vars(first), **told, below=tuple(below)))
            done(len(trials))
    return Comparison(tuple(trials))


def _all(trial: Trial, name: str) -> np.ndarray:
    """Values at the samples of all levels, one after the other."""
    return np.concatenate([getattr(level, name) for level in trial.levels])


def _greatest(trial: Trial, name: str) -> float:
    return float(_all(trial, name).max(initial=0.0))


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


def _check(region: Region, strategies: Strategies, known: Sequence[str]) -> dict[str, Any]:
    """The strategies by their names in the table."""
    if not isinstance(region, Region):
        example = "mnclab.area.Region.of(mnclab.area.rectangle(60, 40))"
        raise Alarm(f"strategies are compared on a Region, got {shown(region)}", hint=example)
    if not isinstance(strategies, Iterable):
        example = f'["rings", "spiral"], or a dict of names; known: {", ".join(known)}'
        raise Alarm(f"strategies must be a list of names, got {shown(strategies)}", hint=example)
    named: dict[str, Any] = {}
    each = strategies.items() if isinstance(strategies, Mapping) else ((None, how) for how in strategies)
    for name, how in each:
        if not isinstance(how, Clearing) and not callable(how):
            if how == FINE and FINE not in known:
                raise Alarm("the strategy fine needs to know which coarse tool was there before", hint="coarse=10.0, its radius")
            how = choice(how, "a strategy", known)
        named[str(how) if name is None else name] = how
    return named


def _check_stock(region: Region, stock: Any, named: dict[str, Any], smallest: Any, radius: float) -> None:
    names = {how for how in named.values() if isinstance(how, str)}
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


def _depths(depth: Any) -> tuple[float, ...]:
    """The depths of the levels; an Alarm unless each lies below the one before."""
    given = plain(depth)
    depths = given if isinstance(given, tuple) else (given,)
    if not 0 < len(depths) <= LEVELS:
        raise Alarm(f"there must be one depth of a level, or up to {LEVELS} of them, got {shown(depth)}", hint="depth=(1, 2, 3)")
    for one, before in zip(depths, (0, *depths)):
        check_number(one, "the depth of a level (mm)", above=before and before + APART)
    return tuple(map(float, depths))


def _areas(region: Region, depths: Sequence[float], draft: float) -> list[Region]:
    """The area at each of the depths, below walls with a draft."""
    areas = [region.inset(depth * math.tan(math.radians(draft))) for depth in depths]
    for area, depth in zip(areas, depths, strict=True):
        if region.loops and not area.loops:
            raise Alarm(f"with a draft of {draft:g} degrees nothing is left of the area at the depth {depth:g} mm")
    return areas


def _check_numbers(feed: float, plunge_feed: float, rapid: float, allowance: float, limit: float, draft: float) -> None:
    check_number(feed, "the feed (mm/min)", above=0)
    check_number(plunge_feed, "the plunge feed (mm/min)", above=0)
    check_number(rapid, "the rapid rate (mm/min)", above=0)
    check_number(allowance, "the allowance (mm)", at_least=0, at_most=1e6)
    check_number(limit, "the limit (of the engagement, degrees)", at_least=0, at_most=360)
    check_number(draft, "the draft of the walls (degrees)", at_least=0, at_most=80)
