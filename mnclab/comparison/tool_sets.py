"""Which tools, one after the other, clear an area in the least time. Lengths in mm, times in s.

A set is tools from large to small, the last of which reaches what the smallest of all reaches. What a tool finds is what the one
before it has left, whatever was there before that: a larger tool reaches nothing that a smaller one does not. So each pair of
tools is tried once, by every strategy, and the quickest is taken.

    time of a set = times of its tools + (tools - 1) · change
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import combinations
from typing import TYPE_CHECKING, Any, ClassVar, Unpack

import numpy as np

from mnclab.comparison.strategies import Trial, compare
from mnclab.comparison.tables import Table, Titles, Tried
from mnclab.geometry.regions import Region
from mnclab.machining.milling.entries import VERTICAL, Entry
from mnclab.machining.milling.strategies import STRATEGIES, rest
from mnclab.machining.steps import RAPID, Go, traced
from mnclab.path.limits import Limits
from mnclab.path.machines import limits_of
from mnclab.path.tool import Tool
from mnclab.path.toolpath import Toolpath, concatenate
from mnclab.text.alarm import Alarm
from mnclab.text.given import WidthOptions, check_number, choice, faults_as_alarms, fitting, plain, shown, whole
from mnclab.text.opening import progress

if TYPE_CHECKING:
    from mnclab.show.plot.picture import Picture

SAME = 1e-4  # of an area: what a tool may leave more than the smallest one
MANY = 12  # tools

#: Every column of a table of sets: what it is, how it is written, and its value.
COLUMNS: Titles = {
    "tools": ("tools", "{}", lambda each: each.name),
    "strategies": ("strategies", "{}", lambda each: ", ".join(each.strategies)),
    "changes": ("changes", "{}", lambda each: len(each.tools) - 1),
    "length": ("cutting length, mm", "{:.0f}", lambda each: each.length(rapid=False)),
    "rapid": ("rapid length, mm", "{:.0f}", lambda each: each.length(rapid=True)),
    "time": ("time, s", "{:.1f}", lambda each: each.time),
}


@dataclass(frozen=True, eq=False, repr=False)
class ToolSet(Tried):
    """Tools one after the other on one area: `trials`, a `Trial` each, its strategy the quickest; `change` s between two."""

    titles: ClassVar = COLUMNS
    tools: tuple[Tool | float, ...]
    trials: tuple[Trial, ...]
    change: float

    @property
    def strategies(self) -> tuple[str, ...]:
        """The strategy of each tool."""
        return tuple(trial.name for trial in self.trials)

    @cached_property
    def time(self) -> float:
        """Seconds, the changes of tools among them."""
        return sum(trial.time for trial in self.trials) + self.change * (len(self.tools) - 1)


@dataclass(frozen=True, eq=False, repr=False)
class ToolSets(Table[ToolSet]):
    """Sets of tools on one area, the quickest first; a table when shown."""

    titles: ClassVar = COLUMNS
    trials: tuple[ToolSet, ...]

    @fitting
    def plot(self, **options: Unpack[WidthOptions]) -> Picture:
        """The time of every set over how many tools it has (needs matplotlib)."""
        from mnclab.show.plot.pocketing import plot_tool_sets

        return plot_tool_sets(self, **options)


@fitting
@faults_as_alarms()
def tool_sets(
    region: Region, tools: Iterable[Tool | float], strategies: Iterable[str] | str | None = None, *, change: float = 12.0,
    machine: Limits | str | None = None, limits: Limits | str | None = None, most: int = 3, overlap: float = 0.5,
    allowance: float = 0.0, depth: float | Sequence[float] = 1.0, feed: float = 500.0, plunge_feed: float = 150.0,
    rapid: float = 10000.0, entry: Entry = VERTICAL, climb: bool = True, chip: float | None = None, spindle: float | None = None,
) -> ToolSets:  # fmt: skip
    """Which of some tools, one after the other, clear an area in the least time:
    `tool_sets(region, [mnclab.Tool(diameter=d) for d in (4, 8, 16)], machine="small-mill").best("time")`.

    `tools` are a `Tool` or a radius in mm each, twelve at most; a set has up to `most` of them, from large to small, and reaches
    what the smallest of all reaches. For each tool of a set the quickest of the `strategies` is taken, names of
    `mnclab.strategies.STRATEGIES` (None: "adaptive" and "rings"); it cuts what the tools before it have left. A change of tools
    takes `change` s. All else is as in `mnclab.compare`.

    A change that takes very long leaves one tool, the smallest, which reaches everything:

    >>> pocket = mnc.area.Region.of(mnc.area.rectangle(40, 20, 5))
    >>> mnc.tool_sets(pocket, [4, 8], "rings", change=1000).best("time").tools
    (4,)
    """
    limits = limits_of(limits, machine)
    if not isinstance(region, Region):
        raise Alarm(f"tools clear a Region, got {shown(region)}", hint="mnclab.area.Region.of(mnclab.area.rectangle(60, 40))")
    radii = _radii(tools)
    names = ("adaptive", "rings") if strategies is None else (strategies,) if isinstance(strategies, str) else tuple(strategies)
    for name in names or ("",):
        choice(name, "a strategy", STRATEGIES)
    check_number(change, "the time of a change of tools (s)", at_least=0)
    check_number(overlap, "the overlap (of two passes, a share of the tool diameter)", at_least=0)
    longest = whole(most, "how many tools a set has at most")
    if longest < 1:
        raise Alarm(f"a set has one tool at least, got most={longest}")
    inner = region.inset(plain(allowance)) if allowance else region
    left = {radius: rest(inner, radius) for radius in radii}
    fitting_ = [radius for radius in radii if left[radius].area < inner.area]
    if not fitting_:
        raise Alarm(f"none of the tools fits into the area; the smallest has a radius of {min(radii):g} mm")
    goal = left[min(fitting_)].area + SAME * inner.area
    sets = [
        each for count in range(1, longest + 1) for each in combinations(sorted(fitting_, reverse=True), count)
        if left[each[-1]].area <= goal and all(left[radius].area > goal for radius in each[:-1])
    ]  # fmt: skip
    options: dict[str, Any] = {
        "limits": limits, "allowance": allowance, "depth": depth, "feed": feed, "plunge_feed": plunge_feed, "rapid": rapid,
        "entry": entry, "climb": climb, "chip": chip, "spindle": spindle,
    }  # fmt: skip
    stages = dict.fromkeys(pair for each in sets for pair in zip((None, *each), each))
    tried: dict[tuple[float | None, float], Trial] = {}
    with progress("trying", len(stages), "tools") as done:
        for before, radius in stages:
            stock = None if before is None else left[before]
            step = 2 * radius * (1 - plain(overlap))
            tried[before, radius] = compare(region, radii[radius], names, stepover=step, stock=stock, **options).best("time")
            done(len(tried))
    found = []
    for each in sets:
        trials = tuple(tried[pair] for pair in zip((None, *each), each))
        name = ", ".join(f"⌀{2 * radius:g}" for radius in each)
        own = tuple(radii[radius] for radius in each)
        found.append(ToolSet(name, _path(trials, each), limits, trials[0].rapid_rate, own, trials, float(plain(change))))
    return ToolSets(tuple(sorted(found, key=lambda each: each.time)))


def _path(trials: Sequence[Trial], radii: Sequence[float]) -> Toolpath:
    """The paths of tools 1, 2, … one after the other, with a rapid above the area from the end of each to the next."""
    pieces: list[Toolpath] = []
    for k, (trial, radius) in enumerate(zip(trials, radii, strict=True), 1):
        to = [trial.path]
        if pieces:
            begin, last = trial.path.start[0], pieces[-1].end[-1]
            to.insert(0, traced(iter([Go("to the entry", None, RAPID, *begin[:2].tolist())]), tuple(last.tolist()), radius))
        pieces += [piece.replace(tool=np.full(len(piece), k)) for piece in to]
    labels = list(dict.fromkeys(label for piece in pieces for label in piece.labels))  # what their columns shall index
    numbers = [np.array([labels.index(label) for label in piece.labels], dtype=np.int32) for piece in pieces]
    pieces = [piece.replace(label=own[piece.label]) for piece, own in zip(pieces, numbers, strict=True)]
    return concatenate([*pieces[:-1], pieces[-1].annotated(labels=labels)])


def _radii(tools: Any) -> dict[float, Tool | float]:
    """Tools by their radii."""
    if isinstance(tools, str | Tool) or not isinstance(tools, Iterable):
        raise Alarm(f"the tools must be a list, got {shown(tools)}", hint="[mnclab.Tool(diameter=4), mnclab.Tool(diameter=10)]")
    found: dict[float, Tool | float] = {}
    for tool in tools:
        radius = plain(tool.effective_radius if isinstance(tool, Tool) else tool)
        check_number(radius, "a tool (its radius, mm, or a Tool)", above=0)
        if radius in found:
            raise Alarm(f"two of the tools have a radius of {radius:g} mm: which of them to take is not told")
        found[float(radius)] = tool
    if not 0 < len(found) <= MANY:
        raise Alarm(f"there must be one to {MANY} tools, got {len(found)}")
    return found
