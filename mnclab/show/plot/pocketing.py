"""Strategies side by side: ways coloured by engagement, engagement along the way, what each pass leaves, times.

Lengths in mm, times in s, angles in degrees; sizes in inches.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from matplotlib import colormaps
from matplotlib.axes import Axes
from matplotlib.cm import ScalarMappable
from matplotlib.collections import LineCollection
from matplotlib.colors import BoundaryNorm, ListedColormap
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from mnclab.comparison.strategies import Comparison, Trial
from mnclab.comparison.tool_sets import ToolSets
from mnclab.geometry import shapely
from mnclab.geometry.sweeps import covered, left_over, polygons
from mnclab.path.toolpath import Array
from mnclab.show import looks
from mnclab.show.plot import colours
from mnclab.show.plot.colours import Mark
from mnclab.show.plot.picture import SMALL, VIEWS, Picture, calm, figure_of
from mnclab.show.plot.side_by_side import LOW, ROOMY, area, evenly, hatch, hatched, label_outer, panels, views
from mnclab.show.plot.sizes import sized
from mnclab.text.alarm import Alarm
from mnclab.text.given import check_number, choice, fitting, shown

ENTRY = Mark("entry", colours.INK, "v", 5, False, 4.0)
BEFORE = "#dbe4ea"
STEPS = tuple(range(0, 181, 20))  # degrees, limits of the colours
NORM = BoundaryNorm(STEPS, len(STEPS) - 1)
#: From pale to dark and red: the harder the tool works, the darker, in grey print too.
MAP = ListedColormap(colormaps["inferno_r"](np.linspace(0.22, 0.92, len(STEPS) - 1)))
KINDS = ("paths", "engagement", "passes")
TWO, THREE = 3.2, 8.0  # inches from which on two and three stand in a row
SCALE, LEVEL = 0.62, 1.1  # of the colours and their numbers; of one engagement


@sized()
def plot_strategies(found: Comparison | Trial, kind: str = "paths", width: float = 9.0, columns: int | None = None) -> Picture:
    """Each trial under its name, all at one scale; `width` of the picture in inches, `columns` how many stand in a row.

    `kind` is what is drawn: "paths", coloured by engagement, with what they leave; "engagement" over the length of the way,
    with the limit; "passes", the area that is left after some of the passes, at most twelve of one trial, a row of several.
    """
    trials = found.trials if isinstance(found, Comparison) else (found,)
    if not trials:
        raise ValueError("there is nothing to draw: no strategy was compared")
    draw = dict(zip(KINDS, (_paths, _engagement, _passes), strict=True))[choice(kind, "the kind of a figure", KINDS)]
    return draw(trials, width, columns)


def _views(
    trials: Sequence[Trial], names: Sequence[str], what: str, width: float, columns: int, legend: Sequence[Any],
    **room: Any,
) -> tuple[Picture, list[Axes]]:  # fmt: skip
    """Axes around the region that the trials clear."""
    low, high = trials[0].region.bounds
    margin = 0.04 * float((high - low).max())
    return views(names, what, width, columns, VIEWS["XY"], low - margin, high + margin, legend, notes=True, **room)


def _columns(width: float) -> int:
    """How many views of an area stand in a row."""
    return 1 + (width > TWO) + (width > THREE)


def _paths(trials: Sequence[Trial], width: float, columns: int | None) -> Picture:
    before = [Patch(facecolor=BEFORE, edgecolor="none", label="cleared by the coarse tool")]
    narrow = "too narrow for the tool" if any(trial.corners.loops for trial in trials) else ""
    cleared = before if any(trial.before.loops for trial in trials) else []
    legend = [Line2D([], [], **ENTRY.style()), *cleared, *hatched(trials, narrow)]
    names = [trial.name for trial in trials]
    columns = columns or evenly(len(names), _columns(width))
    picture, axes = _views(trials, names, "strategies", width, columns, legend, below=LOW + SCALE, also=_scale)
    for ax, trial in zip(axes, trials, strict=True):
        draw(ax, trial)
    return picture


def draw(ax: Axes, trial: Trial) -> None:
    """One trial in its axes, its greatest engagement above them."""
    most = math.degrees(trial.engagement.most())
    _beside(ax, f"greatest {most:.0f}°", f"≤ {most:.0f}°")
    area(ax, trial.region, facecolor=looks.RAW, edgecolor="none", zorder=1.0)
    area(ax, trial.before, facecolor=BEFORE, edgecolor="none", zorder=1.1)
    area(ax, trial.region, facecolor="none", edgecolor=colours.INK, linewidth=1.0, zorder=1.2)
    hatch(ax, trial.rest, trial.corners)
    found = trial.engagement
    half = found.step[:, None] / 2 * np.stack([np.cos(found.heading), np.sin(found.heading)], axis=1)
    strokes = np.stack([found.points - 1.05 * half, found.points + 1.05 * half], axis=1)
    wide = ax.get_position().width * figure_of(ax).get_figwidth()
    lines = LineCollection(list(strokes), cmap=MAP, norm=NORM, linewidth=min(1.5, 0.65 * wide), capstyle="butt", zorder=2.4)
    lines.set_array(np.degrees(found.angle))
    ax.add_collection(lines, autolim=False)
    look = ENTRY.style()
    ax.add_line(Line2D(*trial.entries.T, **look | {"markersize": min(5.0, 2.2 * wide)}))


def _beside(ax: Axes, said: str, short: str) -> None:
    """Words to the right of a name, or where they have no room their number."""
    wide = ax.get_position().width * figure_of(ax).get_figwidth()
    ax.set_title(said if wide > ROOMY else short, fontsize=SMALL, loc="right", pad=4, color=colours.INK)


def _scale(picture: Picture) -> None:
    width, total = picture.get_size_inches().tolist()
    long = min(4.2, max(width - 1.2, 0.3 * width))
    ax = picture.add_axes(((width - long) / 2 / width, 0.36 / total, long / width, 0.11 / total))
    bar = picture.colorbar(ScalarMappable(NORM, MAP), cax=ax, orientation="horizontal", ticks=STEPS)
    bar.ax.tick_params(labelsize=SMALL, length=2)
    bar.set_label("engagement, degrees", fontsize=SMALL, labelpad=1)
    bar.outline.set_visible(False)


# Engagement along the way, with the limit.

LONG = 1000  # samples, from which on a curve is drawn by its least and greatest value in half as many columns


def _engagement(trials: Sequence[Trial], width: float, columns: int | None) -> Picture:
    limits = {round(math.degrees(trial.limit), 3): None for trial in trials}
    curve: dict[str, Any] = {"color": colours.FEED.colour, "linewidth": 0.7}
    edge: dict[str, Any] = {"color": looks.WRONG, "linewidth": 1.0, "linestyle": (0, (5, 3))}
    said = f"limit {next(iter(limits)):g}°" if len(limits) == 1 else "limit"
    legend = [Line2D([], [], label="engagement", **curve), Line2D([], [], label=said, **edge)]
    count = columns or evenly(len(trials), 1 + (width > THREE))
    names = [trial.name for trial in trials]
    alt = f"engagement along the way: {', '.join(names)}"
    picture, axes = panels(names, alt, width, count, 0.5, legend, tallest=LEVEL, notes=True)
    end = max(float(trial.engagement.way.max(initial=0.0)) for trial in trials) or 1.0
    for ax, trial in zip(axes, trials, strict=True):
        most = math.degrees(trial.engagement.most())
        _beside(ax, f"greatest {most:.0f}°", f"≤ {most:.0f}°")
        calm(ax)
        ax.plot(*envelope(trial.engagement.way, np.degrees(trial.engagement.angle)), **curve)
        ax.axhline(math.degrees(trial.limit), **edge)
        ax.set(xlim=(0, end), ylim=(0, 185), yticks=(0, 60, 120, 180))
    label_outer(axes, "way, mm", "degrees")
    return picture


def envelope(x: Array, y: Array, most: int = LONG) -> tuple[Array, Array]:
    """A curve of at most `most` points, x rising: of a longer one the least and the greatest y of each of most / 2 columns."""
    if len(x) <= most:
        return x, y
    first = np.unique(np.searchsorted(x, np.linspace(x[0], x[-1], most // 2 + 1)[:-1]))
    least, greatest = (pick.reduceat(y, first) for pick in (np.minimum, np.maximum))
    return np.repeat(x[first], 2), np.stack([least, greatest], axis=1).ravel()


# What is left after each of some passes.

AT_MOST = 12
MANY, PAIR = 4, 3.0  # of more trials there are two views each, which have so many inches


def _passes(trials: Sequence[Trial], width: float, columns: int | None) -> Picture:
    many, most = len(trials) > MANY, AT_MOST
    count = columns or (2 * max(1, int(width / PAIR)) if many else _columns(width))
    if len(trials) > 1:  # each within a row
        most = min(2 if many else count, count, *(len(trial.clearing.passes) for trial in trials))
        count -= count % most
    counts = [len(trial.clearing.passes) for trial in trials]  # shown: at most so many, evenly chosen, the last among them
    chosen = [np.unique(np.linspace(0, n, min(n, most) + 1).round().astype(int))[1:].tolist() for n in counts]
    names = [f"pass {k}" for each in chosen for k in each]
    for k, trial in enumerate(trials if len(trials) > 1 else ()):
        names[k * most] = f"{trial.name}: {names[k * most].replace(' ', chr(160))}"  # in one line with its number
    legend = [Patch(facecolor=looks.RAW, edgecolor=colours.INK, label="left, mm²"),
              Line2D([], [], color=colours.FEED.colour, linewidth=1.0, label="passes since the picture before")]  # fmt: skip
    picture, axes = _views(trials, names, "what passes leave", width, count, legend)
    places = iter(axes)
    for trial, each in zip(trials, chosen, strict=True):
        whole = shapely.difference(polygons(trial.region.inset(trial.allowance)), polygons(trial.before))
        passes, done = trial.clearing.passes, 0
        for upto in each:
            ax, new = next(places), passes[done:upto]
            whole, done = shapely.difference(whole, covered(new, trial.clearing.radius)), upto
            left = left_over(whole, shapely.Polygon(), trial.clearing.radius * 1e-3)
            area(ax, left, facecolor=looks.RAW, edgecolor=colours.INK, linewidth=0.5, zorder=1.0)
            area(ax, trial.region, facecolor="none", edgecolor=colours.INK, linewidth=1.0, zorder=1.2)
            for contour in new:
                ax.plot(*contour.points_within(0.01).T, color=colours.FEED.colour, linewidth=0.9, zorder=2.0)
            _beside(ax, f"{left.area:.0f} mm²", f"{left.area:.0f}")
    return picture


# Times of several comparisons: over the stepover, a view a tool, a line a strategy.

SIGNS = "osD^vP*X<>"


@sized()
@fitting
def plot_times(found: Mapping[Any, Comparison], width: float = 9.0, columns: int | None = None) -> Picture:
    """The time of each strategy over the stepover, a view for each tool, all at one scale: the table of many comparisons.

    `plot_times({(6, 2.0): mnclab.compare(area, 3.0, stepover=2.0), (6, 3.0): …, (8, 2.0): …})`: the keys are the tool (a
    diameter in mm, or a name) and the stepover in mm; times in s; `width` in inches. An Alarm for other keys and for what is
    no comparison.
    """
    if not isinstance(found, Mapping) or not found:
        raise Alarm(f"times are those of comparisons, got {shown(found)}", hint="{(6, 2.0): mnclab.compare(…)}: tool, stepover")
    for key, one in found.items():
        if not (isinstance(key, tuple) and len(key) == 2 and isinstance(one, Comparison)):
            raise Alarm(f"times need (tool, stepover): comparison, got {shown(key)}: {shown(one)}", hint="{(6, 2.0): compare(…)}")
        check_number(key[1], "a stepover (mm)", above=0)
    tools = list(dict.fromkeys(tool for tool, _ in found))
    strategies = list(dict.fromkeys(trial.name for one in found.values() for trial in one.trials))
    shades = colormaps["tab10"](np.arange(len(strategies)) % 10)
    looked: dict[str, dict[str, Any]] = {
        name: {"color": tuple(shade), "marker": SIGNS[k % len(SIGNS)], "markersize": 4.0, "linewidth": 1.1}
        for k, (name, shade) in enumerate(zip(strategies, shades, strict=True))
    }
    names = [tool if isinstance(tool, str) else f"⌀ {tool:g} mm" for tool in tools]
    legend = [Line2D([], [], label=name, **look) for name, look in looked.items()]
    columns = columns or evenly(len(names), _columns(width))
    picture, axes = panels(names, f"times: {', '.join(names)}", width, columns, 0.8, legend)
    times = {(tool, step): {trial.name: trial.time for trial in one.trials} for (tool, step), one in found.items()}
    for ax, tool in zip(axes, tools, strict=True):
        calm(ax)
        steps = sorted(step for one, step in found if one == tool)
        for name, look in looked.items():
            own = [step for step in steps if name in times[tool, step]]
            ax.plot(own, [times[tool, step][name] for step in own], **look)
    reach = max(max(row.values(), default=0.0) for row in times.values())
    far = max(step for _, step in found)
    for ax in axes:
        ax.set(xlim=(0, 1.08 * far), ylim=(0, 1.08 * reach or 1.0))
    label_outer(axes, "stepover, mm", "time, s")
    return picture


@sized()
@fitting
def plot_tool_sets(found: ToolSets, width: float = 5.0) -> Picture:
    """The time of every set over how many tools it has; the quickest of each number are joined and named. `width` in inches."""
    picture, (ax,) = panels(["sets of tools"], "times of sets of tools", width, 1, 0.7, [])
    calm(ax)
    counts, times = (np.array(column) for column in zip(*((len(each.tools), each.time) for each in found.trials), strict=True))
    least = {count: found.trials[int(np.flatnonzero(counts == count)[0])] for count in sorted(set(counts.tolist()))}
    ax.plot(counts, times, "o", color=colours.INK, markersize=3.5, alpha=0.5)
    ax.plot(list(least), [each.time for each in least.values()], "o-", color=colours.FEED.colour, markersize=5.0, linewidth=1.1)
    for count, each in least.items():
        ax.annotate(each.name, (count, each.time), (0, -10), textcoords="offset points", fontsize=SMALL, ha="center", va="top")
    ax.set(xlim=(0.5, max(counts) + 0.5), ylim=(0, 1.08 * times.max()), xticks=sorted(least))
    label_outer([ax], "how many tools (⌀, mm)", "time, s")
    return picture
