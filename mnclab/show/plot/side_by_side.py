"""Side by side at one scale: strategies with the engagement of the tool and what it leaves, areas and what comes of them."""

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
from matplotlib.patches import Patch, PathPatch
from matplotlib.path import Path
from numpy.typing import NDArray

from mnclab.comparison.strategies import Comparison, Trial
from mnclab.geometry.contours import Contour
from mnclab.geometry.regions import Region
from mnclab.show.plot import colours
from mnclab.show.plot.colours import Mark
from mnclab.show.plot.picture import SMALL, VIEWS, Picture, View, dress, write_legend
from mnclab.show.plot.sizes import sized
from mnclab.text.alarm import Alarm
from mnclab.text.given import shown

# Pictures of several trials: one view of each, all at one scale, each under its name.

TITLE, LEFT, RIGHT, TALLEST = 0.26, 0.62, 0.12, 9.0  # inches


def grid(
    picture: Picture, titles: Sequence[str], views: Sequence[View], columns: int, left: float, top: float, gap: float,
    box: tuple[float, float],
) -> list[Axes]:  # fmt: skip
    """Axes of one size (`box`, inches) under their titles, row by row; labels stand only at the outer ones."""
    (width, total), (wide, tall) = picture.get_size_inches(), box
    for k, (title, view) in enumerate(zip(titles, views)):
        row, column = divmod(k, columns)
        x, y = column * width / columns + left, total - top - (row + 1) * (TITLE + tall) - row * gap
        ax = picture.add_axes((x / width, y / total, wide / width, tall / total))
        dress(ax, view, box)
        ax.set_title(title, fontsize=SMALL + 1, loc="left", pad=4)
        if column:
            ax.set_ylabel("")
        if k + columns < len(titles):
            ax.set_xlabel("")
    return picture.axes


def side_by_side(
    names: Sequence[str], view: str, low: NDArray, high: NDArray, *, what: str, columns: int, width: float, top: float,
    gap: float, bottom: float,
) -> tuple[Picture, list[Axes]]:  # fmt: skip
    """A picture and the axes of each name, from `low` (2,) to `high` (2,) mm of a view; room around them in inches."""
    wide, tall = (float(side) for side in high - low)
    lines = math.ceil(len(names) / columns)
    box = min((width - columns * (LEFT + RIGHT)) / columns, TALLEST / lines * wide / tall)
    height = box * tall / wide
    total = top + lines * (TITLE + height) + (lines - 1) * gap + bottom
    picture = Picture((width, total), alt=f"{what}: " + ", ".join(names))
    axes = grid(picture, names, [VIEWS[view]] * len(names), columns, LEFT, top, gap, (box, height))
    for ax in axes:
        ax.set(xlim=(low[0], high[0]), ylim=(low[1], high[1]))
    return picture, axes


# Strategies side by side: the way of the tool coloured by its engagement, what it leaves hatched, entries marked.

ENTRY = Mark("entry", colours.INK, "v", 5, False, 4.0)
REST, CORNER, BEFORE = "#b3261e", "#8c8c8c", "#dbe4ea"
STEPS = tuple(range(0, 181, 20))  # degrees, limits of the colours
NORM = BoundaryNorm(STEPS, len(STEPS) - 1)
#: From pale to dark and red: the harder the tool works, the darker, in grey print too.
MAP = ListedColormap(colormaps["inferno_r"](np.linspace(0.22, 0.92, len(STEPS) - 1)))
CHORD = 0.02
GAP, SCALE_ROOM, TOP = 0.55, 0.62, 0.36  # inches


@sized()
def plot_strategies(found: Comparison | Trial, width: float = 9.0, columns: int | None = None) -> Picture:
    """One view of each trial, all at one scale, with one scale of colours below; `width` of the picture in inches."""
    trials = found.trials if isinstance(found, Comparison) else (found,)
    if not trials:
        raise ValueError("there is nothing to draw: no strategy was compared")
    bounds = np.array([loop.bounds for loop in trials[0].region.loops])
    low, high = bounds[:, 0].min(axis=0), bounds[:, 1].max(axis=0)
    margin = 0.04 * float((high - low).max())
    low, high = low - margin, high + margin
    wide, tall = high - low
    count = columns or min(len(trials), max(1, min(3, round(2.4 / math.sqrt(wide / tall)) + (len(trials) > 4))))
    picture, axes = side_by_side(
        [trial.name for trial in trials], "XY", low, high, what="strategies", columns=count, width=width, top=TOP, gap=GAP,
        bottom=GAP + SCALE_ROOM,
    )  # fmt: skip
    for ax, trial in zip(axes, trials):
        draw(ax, trial)
    _scale(picture, *picture.get_size_inches().tolist())
    before = [Patch(facecolor=BEFORE, edgecolor="none", label="cleared by the coarse tool")]
    narrow = "too narrow for the tool" if any(trial.corners.loops for trial in trials) else ""
    cleared = before if any(trial.before.loops for trial in trials) else []
    write_legend(picture, [Line2D([], [], **ENTRY.style()), *cleared, *hatched(trials, narrow)])
    return picture


def draw(ax: Axes, trial: Trial) -> None:
    """One trial in its axes, its greatest engagement above them."""
    most = math.degrees(trial.engagement.most())
    ax.set_title(f"greatest {most:.0f}°", fontsize=SMALL, loc="right", pad=4, color=colours.INK)
    area(ax, trial.region, facecolor="#f4f1e8", edgecolor="none", zorder=1.0)
    area(ax, trial.before, facecolor=BEFORE, edgecolor="none", zorder=1.1)
    area(ax, trial.region, facecolor="none", edgecolor=colours.INK, linewidth=1.0, zorder=1.2)
    hatch(ax, trial.rest, trial.corners)
    found = trial.engagement
    half = found.step[:, None] / 2 * np.stack([np.cos(found.heading), np.sin(found.heading)], axis=1)
    strokes = np.stack([found.points - 1.05 * half, found.points + 1.05 * half], axis=1)
    lines = LineCollection(list(strokes), cmap=MAP, norm=NORM, linewidth=1.5, capstyle="butt", zorder=2.4)
    lines.set_array(np.degrees(found.angle))
    ax.add_collection(lines)
    ax.add_line(Line2D(*trial.entries.T, **ENTRY.style()))


def area(ax: Axes, region: Region, **look: Any) -> None:
    """A region with its holes as one patch."""
    if region.loops:
        ax.add_patch(PathPatch(outline(region.loops), **look))


def outline(loops: Sequence[Contour]) -> Path:
    """Closed contours as one path, in which inner ones are holes."""
    rings = [loop.points_within(CHORD) for loop in loops]
    codes = [np.r_[Path.MOVETO, np.full(len(ring) - 2, Path.LINETO), Path.CLOSEPOLY] for ring in rings]
    return Path(np.vstack(rings), np.concatenate(codes).astype(np.uint8))


def hatch(ax: Axes, rest: Region, beyond: Region) -> None:
    """What a trial leaves standing, and what its tool cannot reach."""
    area(ax, beyond, facecolor="none", edgecolor=CORNER, hatch="//////", linewidth=0.4, zorder=1.6)
    area(ax, rest, facecolor="none", edgecolor=REST, hatch="xxxxxx", linewidth=0.6, zorder=3.0)


def hatched(trials: Sequence[Any], beyond: str) -> list[Any]:
    """Legend entries for what is hatched; `beyond` is what the tool cannot reach, or nothing."""
    looks = [(REST, "xxxx", "left standing")] if any(trial.rest.loops for trial in trials) else []
    looks += [(CORNER, "////", beyond)] if beyond else []
    return [Patch(facecolor="none", edgecolor=edge, hatch=hatch, label=label) for edge, hatch, label in looks]


def _scale(picture: Picture, width: float, total: float) -> None:
    long = min(4.2, width - 1.2)
    ax = picture.add_axes(((width - long) / 2 / width, 0.36 / total, long / width, 0.11 / total))
    bar = picture.colorbar(ScalarMappable(NORM, MAP), cax=ax, orientation="horizontal", ticks=STEPS)
    bar.ax.tick_params(labelsize=SMALL, length=2)
    bar.set_label("engagement, degrees", fontsize=SMALL, labelpad=1)
    bar.outline.set_visible(False)


# Areas side by side at one scale, such as the two sides of a set operation and what comes of it.

MOST_COLUMNS = 4
AREA_TOP, AREA_GAP, BELOW = 0.06, 0.55, 0.45  # inches


@sized()
def plot_regions(
    regions: Mapping[str, Region], over: Sequence[Region] = (), width: float = 9.0, columns: int | None = None
) -> Picture:
    """One view of each named region with its area, all at one scale, each with the outlines of what is `over` it, dashed.

    `width` of the picture in inches.
    """
    if not isinstance(regions, Mapping) or not all(isinstance(one, Region) for one in regions.values()):
        raise Alarm(f"regions must be Regions by their names, got {shown(regions)}", hint='{"A": a, "B": b, "A | B": a.union(b)}')
    corners = [one.bounds for one in (*regions.values(), *over) if one.loops]
    if not regions or not corners:
        raise Alarm("there is nothing to draw: no region encloses anything")
    low, high = np.min([box[0] for box in corners], axis=0), np.max([box[1] for box in corners], axis=0)
    margin = 0.06 * float((high - low).max())
    names = [f"{name}: {one.area:.1f} mm²" for name, one in regions.items()]
    picture, axes = side_by_side(
        names, "XY", low - margin, high + margin, what="regions", columns=columns or _columns(len(regions)), width=width,
        top=AREA_TOP, gap=AREA_GAP, bottom=BELOW,
    )  # fmt: skip
    for ax, one in zip(axes, regions.values(), strict=True):
        area(ax, one, facecolor="#cfe0f1", edgecolor="none", zorder=1.0)
        for other in over:
            look = {"edgecolor": colours.PROGRAMMED.colour, "linestyle": (0, (4, 3)), "linewidth": 0.9}
            area(ax, other, facecolor="none", zorder=1.5, **look)
        area(ax, one, facecolor="none", edgecolor=colours.FEED.colour, linewidth=1.6, zorder=2.0)
        ax.tick_params(labelsize=SMALL)
    return picture


def _columns(count: int) -> int:
    """As few rows as four columns allow, filled as evenly as they can be."""
    rows = math.ceil(count / MOST_COLUMNS)
    return math.ceil(count / rows)
