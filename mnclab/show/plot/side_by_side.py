"""Side by side at one scale: trials, areas and what comes of them, runs, and one path over another."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.lines import Line2D
from matplotlib.patches import Patch, PathPatch
from numpy.typing import NDArray

from mnclab.geometry.regions import Region
from mnclab.path.toolpath import Array, Kind, Toolpath
from mnclab.show import looks
from mnclab.show.plot import colours
from mnclab.show.plot.colours import RAPID, LineStyle, Mark
from mnclab.show.plot.path import plot_run
from mnclab.show.plot.picture import SIZE, SMALL, VIEWS, Foot, Picture, View, arrange, dress, write_legend
from mnclab.show.plot.sizes import sized
from mnclab.show.plot.strokes import corners, line_of, outline
from mnclab.text.alarm import Alarm
from mnclab.text.given import check_number, choice, shown, whole

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


# What is hatched in pictures of trials, and areas with their holes.

REST, CORNER = looks.WRONG, looks.GREY


def area(ax: Axes, region: Region, **look: Any) -> None:
    """A region with its holes as one patch."""
    if region.loops:
        ax.add_patch(PathPatch(outline(region.loops), **look))


def hatch(ax: Axes, rest: Region, beyond: Region) -> None:
    """What a trial leaves standing, and what its tool cannot reach."""
    area(ax, beyond, facecolor="none", edgecolor=CORNER, hatch="//////", linewidth=0.4, zorder=1.6)
    area(ax, rest, facecolor="none", edgecolor=REST, hatch="xxxxxx", linewidth=0.6, zorder=3.0)


def hatched(trials: Sequence[Any], beyond: str) -> list[Any]:
    """Legend entries for what is hatched; `beyond` is what the tool cannot reach, or nothing."""
    kinds = [(REST, "xxxx", "left standing")] if any(trial.rest.loops for trial in trials) else []
    kinds += [(CORNER, "////", beyond)] if beyond else []
    return [Patch(facecolor="none", edgecolor=edge, hatch=hatch, label=label) for edge, hatch, label in kinds]


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
        names, "XY", low - margin, high + margin, what="regions", width=width,
        columns=columns or evenly(len(regions), MOST_COLUMNS), top=AREA_TOP, gap=AREA_GAP, bottom=BELOW,
    )  # fmt: skip
    for ax, one in zip(axes, regions.values(), strict=True):
        area(ax, one, facecolor="#cfe0f1", edgecolor="none", zorder=1.0)
        for other in over:
            look = {"edgecolor": colours.PROGRAMMED.colour, "linestyle": (0, (4, 3)), "linewidth": 0.9}
            area(ax, other, facecolor="none", zorder=1.5, **look)
        area(ax, one, facecolor="none", edgecolor=colours.FEED.colour, linewidth=1.6, zorder=2.0)
        ax.tick_params(labelsize=SMALL)
    return picture


def evenly(count: int, most: int) -> int:
    """How many columns, at most so many: as few rows as they allow, filled as evenly as they can be."""
    return math.ceil(count / math.ceil(count / most))


# Several runs in one figure: side by side at one scale, or one path over the other.

LEADS = {"APPR": colours.ENTRY._replace(name="approach", dashes="-", width=2.8)}
LEADS["DEP"] = colours.EXIT._replace(name="departure", dashes="-", width=2.8)
MARGIN = 0.12  # of the greatest side
RUNS_GAP, RUNS_TOP, RUNS_BOTTOM = 0.5, 0.1, 0.46  # inches


@sized(also=plot_run)
def plot_runs(
    runs: Mapping[str, Any], view: str = "XY", *, columns: int | None = None, width: float = 9.0, **options: Any
) -> Picture:
    """Runs by name, as small pictures at one scale: `mnclab.plot_runs({"LT": one, "CT": other})`.

    `view` is that of all, `columns` how many stand in a row, `width` in inches; the `options` are those of `run.plot()`. The
    frame holds the cuts of all of them: rapids from far away are cut off.
    """
    if not isinstance(runs, Mapping) or not runs or not all(isinstance(name, str) for name in runs):
        raise Alarm(f"runs must be a dict of runs by name, got {shown(runs)}", hint='mnclab.plot_runs({"a": run})')
    for name, run in runs.items():
        if not isinstance(getattr(run, "toolpath", None), Toolpath):
            raise Alarm(f"{shown(name)} must be a run, got {shown(run)}")
    view = choice(view, "view", VIEWS)
    check_number(width, "the width of a picture (inches)", above=1, at_most=100)
    count = min(len(runs), 4) if columns is None else whole(columns, "columns")
    check_number(count, "columns", at_least=1, at_most=20)
    axes = list(VIEWS[view][:2])
    corners = []
    for run in runs.values():
        cuts = run.toolpath[np.isin(run.toolpath.kind, (Kind.LINE, Kind.ARC))]
        corners += [*(cuts if len(cuts) else run.toolpath).bounds]
    found = np.array(corners)[:, axes]
    low, high = np.nanmin(found, axis=0), np.nanmax(found, axis=0)
    if not np.isfinite([low, high]).all():
        raise Alarm("none of the runs moves")
    size = max(float((high - low).max()), 1e-3)
    grow = np.maximum(MARGIN * size, (0.5 * size - (high - low)) / 2)
    low, high = low - grow, high + grow
    leads = [look for look in LEADS.values() if any(len(lead(run, look)) for run in runs.values())]
    picture, panels = side_by_side(
        list(runs), view, low, high, what="runs side by side", columns=min(count, len(runs)), width=width,
        top=RUNS_TOP + 0.22 * bool(leads), gap=RUNS_GAP, bottom=RUNS_BOTTOM,
    )  # fmt: skip
    for ax, run in zip(panels, runs.values()):
        right, up = ax.get_xlabel(), ax.get_ylabel()
        plot_run(run, ax, view, **options)
        ax.set(xlabel=right, ylabel=up)
        for look in LEADS.values():
            if len(points := lead(run, look)):
                ax.add_line(Line2D(points[:, axes[0]], points[:, axes[1]], **look.style()))
        ax.set_aspect("equal", adjustable="box")
        ax.set(xlim=(low[0], high[0]), ylim=(low[1], high[1]))
    write_legend(picture, [Line2D([], [], **look.style()) for look in leads])
    rows = math.ceil(len(runs) / min(count, len(runs)))
    picture.alt += f", {rows} in a column" if rows > 1 else ""
    return picture


def lead(run: Any, look: LineStyle) -> Array:
    """The moves (m, 3) of blocks that lead to a contour, or away from it, broken by nan."""
    path = run.toolpath
    found = [np.empty((0, 3))]
    words = {code for code, one in LEADS.items() if one is look}
    for number, program in enumerate(run.programs):
        keywords = [k for k, keyword in enumerate(program.keywords) if keyword.split(" ")[0] in words]
        mine = np.isin(program.keyword[run.steps.block[path.step]], keywords) & (run.steps.program[path.step] == number)
        if mine.any():
            found.append(line_of(path[mine], (Kind.LINE, Kind.ARC, Kind.RAPID)))
    return np.concatenate(found)


# Two paths in one picture, the second over the first, and where they are farthest apart.

FIRST = LineStyle("first", looks.GREY, "-", 3.2, 2.2)
SECOND = LineStyle("second", looks.BLUE, "-", 1.1, 2.8)
APART = Mark("largest deviation", looks.WRONG, "o", 9, False, 4.2)
CUTTING = tuple(kind for kind in Kind if kind != Kind.RAPID)
RAPID_WIDTH = 0.6  # of the width of cuts
SHOWN = 1e-6  # mm: less is called the same


@sized()
def plot_deviation(found: Any, view: str = "auto", size: tuple[float, float] = SIZE) -> Picture:
    """The first path wide and grey, the second thin and blue over it, rapids dashed; a ring and a line where they are farthest
    apart."""
    one, other = found.paths
    lathe = one.lathe or other.lathe
    called = [look._replace(name=name) for look, name in zip((FIRST, SECOND), found.names)]
    lines = [(look, line_of(path, CUTTING)) for look, path in zip(called, found.paths)]
    for look, path, rapids in zip(called, found.paths, found.rapids):
        dashed = look._replace(name="_" + look.name, dashes=RAPID.dashes, width=RAPID_WIDTH * look.width)
        lines += [(dashed, line)] if len(line := line_of(path, (Kind.RAPID,), rapids)) else []
    lines[2:3] = [(look._replace(name=RAPID.name), line) for look, line in lines[2:3]]
    low, high = corners([xyz for _, xyz in lines], lathe) or (np.zeros(3), np.zeros(3))
    view = choice(view, "view", ("auto", *VIEWS))
    views = [VIEWS["ZX"]] if lathe else [VIEWS["XY"]] if high[2] <= low[2] else [VIEWS["XY"], VIEWS["XZ"]]
    views = [each._replace(unit=found.unit) for each in (views if view == "auto" else [VIEWS[view]])]
    where = found.where if found.largest > SHOWN else None
    names = [line.name for line, _ in lines if not line.name.startswith("_")] + ([APART.name] if where else [])
    picture, axes = arrange(views, low, high, names, Foot(found.sentence), f"two paths: {found.sentence}", size)
    artists: list[Line2D] = []
    for ax, each in zip(axes, views):
        drawn = [Line2D(xyz[:, each.right], xyz[:, each.up], **line.style()) for line, xyz in lines]
        if where:
            ends = np.stack(where[:2])[:, [each.right, each.up]]
            drawn.append(Line2D(*ends[:1].T, **APART.style()))
            ax.add_line(Line2D(*ends.T, color=APART.colour, linewidth=1.2, zorder=APART.order))
        for artist in drawn:
            ax.add_line(artist)
        artists = artists or [each for each in drawn if not str(each.get_label()).startswith("_")]
    write_legend(picture, artists)
    return picture
