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
from mnclab.show.plot.picture import (
    LETTER,
    SMALL,
    VIEWS,
    Picture,
    calm,
    dress,
    figure_of,
    legend_height,
    legend_rows,
    write_legend,
)  # fmt: skip
from mnclab.show.plot.side_by_side import area, evenly, hatch, hatched
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
LEFT, BETWEEN, RIGHT, TITLE, LOW, SCALE = 0.62, 0.22, 0.16, 0.26, 0.48, 0.62
TALLEST, LEVEL = 5.0, 1.1  # of one view, and of one engagement
ROOMY = 2.3  # of a view: above it there is room for words beside its name


@sized()
def plot_strategies(
    found: Comparison | Trial, kind: str = "paths", width: float = 9.0, columns: int | None = None
) -> Picture:
    """Each trial under its name, all at one scale; `width` of the picture in inches, `columns` how many stand in a row.

    `kind` is what is drawn: "paths", coloured by engagement, with what they leave; "engagement" over the length of the way,
    with the limit; "passes", the area that is left after some of the passes, at most twelve of one trial, a row of several.
    """
    trials = found.trials if isinstance(found, Comparison) else (found,)
    if not trials:
        raise ValueError("there is nothing to draw: no strategy was compared")
    draw = dict(zip(KINDS, (_paths, _engagement, _passes), strict=True))[choice(kind, "the kind of a figure", KINDS)]
    return draw(trials, width, columns)


def panels(
    names: Sequence[str], what: str, width: float, columns: int | None, ratio: float, legend: Sequence[Any],
    below: float = LOW, tallest: float = TALLEST,
) -> tuple[Picture, list[Axes]]:  # fmt: skip
    """Axes under their names, all of one size, `ratio` high for their width, with numbers at the outer ones only."""
    count = columns or evenly(len(names), 1 + (width > TWO) + (width > THREE))
    rows = math.ceil(len(names) / count)
    wide = max((width - LEFT - RIGHT - BETWEEN * (count - 1)) / count, 0.1)
    tall = min(wide * ratio, tallest)
    wide = tall / ratio if ratio * wide > tallest and tallest == TALLEST else wide
    top = 0.08 + legend_height(len(legend_rows([each.get_label() for each in legend], width)))
    loose = LOW if len(names) % count else BETWEEN  # between rows: numbers and their name below the last of a column
    height = top + rows * (TITLE + tall) + (rows - 1) * loose + below
    picture = Picture((width, height), alt=f"{what}: {', '.join(names)}")
    for k, name in enumerate(names):
        row, column = divmod(k, count)
        x, y = LEFT + column * (wide + BETWEEN), height - top - (row + 1) * (TITLE + tall) - row * loose
        ax = picture.add_axes((x / width, y / height, wide / width, tall / height))
        room = int((wide - 0.35) / LETTER)  # beside the number on the right
        said = name if len(name) <= room else name[: max(room - 1, 1)] + "…"
        ax.set_title(said, fontsize=SMALL + 1, loc="left", pad=4, parse_math=False)
        ax.tick_params(labelsize=SMALL, labelleft=not column, labelbottom=k + count >= len(names))
    write_legend(picture, legend)
    return picture, picture.axes


def _label(axes: Sequence[Axes], right: str, up: str) -> None:
    """Names at the axes that have numbers."""
    for ax in axes:
        ax.set_xlabel(right if ax.xaxis.get_tick_params()["labelbottom"] else "", fontsize=SMALL + 1)
        ax.set_ylabel(up if ax.yaxis.get_tick_params()["labelleft"] else "", fontsize=SMALL + 1)


def _views(
    trials: Sequence[Trial], names: Sequence[str], what: str, width: float, columns: int | None, legend: Sequence[Any],
    below: float = LOW,
) -> tuple[Picture, list[Axes]]:  # fmt: skip
    """Axes around the region that the trials clear."""
    bounds = np.array([loop.bounds for loop in trials[0].region.loops])
    low, high = bounds[:, 0].min(axis=0), bounds[:, 1].max(axis=0)
    margin = 0.04 * float((high - low).max())
    low, high = low - margin, high + margin
    picture, axes = panels(names, what, width, columns, float((high - low)[1] / (high - low)[0]), legend, below)
    size = picture.get_size_inches()
    for ax in axes:
        place = ax.get_position()
        dress(ax, VIEWS["XY"], (place.width * size[0], place.height * size[1]))
        ax.set(xlim=(low[0], high[0]), ylim=(low[1], high[1]))
    _label(axes, *VIEWS["XY"].labels)
    return picture, axes


def _paths(trials: Sequence[Trial], width: float, columns: int | None) -> Picture:
    before = [Patch(facecolor=BEFORE, edgecolor="none", label="cleared by the coarse tool")]
    narrow = "too narrow for the tool" if any(trial.corners.loops for trial in trials) else ""
    cleared = before if any(trial.before.loops for trial in trials) else []
    legend = [Line2D([], [], **ENTRY.style()), *cleared, *hatched(trials, narrow)]
    names = [trial.name for trial in trials]
    picture, axes = _views(trials, names, "strategies", width, columns, legend, LOW + SCALE)
    for ax, trial in zip(axes, trials, strict=True):
        draw(ax, trial)
    _scale(picture, *picture.get_size_inches().tolist())
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
    ax.add_collection(lines)
    look = ENTRY.style()
    ax.add_line(Line2D(*trial.entries.T, **look | {"markersize": min(5.0, 2.2 * wide)}))


def _beside(ax: Axes, said: str, short: str) -> None:
    """Words to the right of a name, or where they have no room their number."""
    wide = ax.get_position().width * figure_of(ax).get_figwidth()
    ax.set_title(said if wide > ROOMY else short, fontsize=SMALL, loc="right", pad=4, color=colours.INK)


def _scale(picture: Picture, width: float, total: float) -> None:
    long = min(4.2, width - 1.2)
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
    picture, axes = panels(names, "engagement along the way", width, count, 0.5, legend, tallest=LEVEL)
    end = max(float(trial.engagement.way.max(initial=0.0)) for trial in trials) or 1.0
    for ax, trial in zip(axes, trials, strict=True):
        most = math.degrees(trial.engagement.most())
        _beside(ax, f"greatest {most:.0f}°", f"≤ {most:.0f}°")
        calm(ax)
        ax.plot(*envelope(trial.engagement.way, np.degrees(trial.engagement.angle)), **curve)
        ax.axhline(math.degrees(trial.limit), **edge)
        ax.set(xlim=(0, end), ylim=(0, 185), yticks=(0, 60, 120, 180))
    _label(axes, "way, mm", "degrees")
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


def _passes(trials: Sequence[Trial], width: float, columns: int | None) -> Picture:
    count = columns or 1 + (width > TWO) + (width > THREE)
    if len(trials) > 1:  # a row each
        count = min(count, *(len(trial.clearing.passes) for trial in trials))
    chosen = [_steps(len(trial.clearing.passes), AT_MOST if len(trials) == 1 else count) for trial in trials]
    names = [f"pass {k}" for each in chosen for k in each]
    legend = [Patch(facecolor=looks.RAW, edgecolor=colours.INK, label="left, mm²"),
              Line2D([], [], color=colours.FEED.colour, linewidth=1.0, label="passes since the picture before")]  # fmt: skip
    picture, axes = _views(trials, names, "what passes leave", width, count, legend)
    for ax, trial in zip(axes[::count], trials if len(trials) > 1 else ()):
        ax.set_ylabel(trial.name, fontsize=SMALL, parse_math=False)
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


def _steps(count: int, most: int) -> list[int]:
    """Numbers of passes, at most so many and evenly chosen, the last among them."""
    return np.unique(np.linspace(0, count, min(count, most) + 1).round().astype(int))[1:].tolist()


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
    picture, axes = panels(names, "times", width, columns, 0.8, legend)
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
    _label(axes, "stepover, mm", "time, s")
    return picture


@sized()
@fitting
def plot_tool_sets(found: ToolSets, width: float = 5.0) -> Picture:
    """The time of every set over how many tools it has; the quickest of each number are joined and named. `width` in inches."""
    picture, (ax,) = panels(["sets of tools"], "times", width, 1, 0.7, [])
    calm(ax)
    counts, times = (np.array(column) for column in zip(*((len(each.tools), each.time) for each in found.trials), strict=True))
    least = {count: found.trials[int(np.flatnonzero(counts == count)[0])] for count in sorted(set(counts.tolist()))}
    ax.plot(counts, times, "o", color=colours.INK, markersize=3.5, alpha=0.5)
    ax.plot(list(least), [each.time for each in least.values()], "o-", color=colours.FEED.colour, markersize=5.0, linewidth=1.1)
    for count, each in least.items():
        ax.annotate(each.name, (count, each.time), (0, -10), textcoords="offset points", fontsize=SMALL, ha="center", va="top")
    ax.set(xlim=(0.5, max(counts) + 0.5), ylim=(0, 1.08 * times.max()), xticks=sorted(least))
    _label([ax], "how many tools (⌀, mm)", "time, s")
    return picture
