"""Several runs in one figure: side by side at one scale, or one path over the other."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

import numpy as np
from matplotlib.lines import Line2D

from mnclab.path.toolpath import Array, Kind, Toolpath
from mnclab.show.plot import colours
from mnclab.show.plot.colours import RAPID, Line, Mark
from mnclab.show.plot.path import plot_run
from mnclab.show.plot.picture import SIZE, VIEWS, Foot, Picture, arrange, write_legend
from mnclab.show.plot.side_by_side import side_by_side
from mnclab.show.plot.sizes import sized
from mnclab.show.plot.strokes import corners, line_of
from mnclab.text.alarm import Alarm
from mnclab.text.given import check_number, choice, shown, whole

LEADS = {"APPR": colours.ENTRY._replace(name="approach", dashes="-", width=2.8)}
LEADS["DEP"] = colours.EXIT._replace(name="departure", dashes="-", width=2.8)
MARGIN = 0.12  # of the greatest side
GAP, TOP, BOTTOM = 0.5, 0.1, 0.46  # inches


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
    looks = [look for look in LEADS.values() if any(len(lead(run, look)) for run in runs.values())]
    picture, panels = side_by_side(
        list(runs), view, low, high, what="runs side by side", columns=min(count, len(runs)), width=width,
        top=TOP + 0.22 * bool(looks), gap=GAP, bottom=BOTTOM,
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
    write_legend(picture, [Line2D([], [], **look.style()) for look in looks])
    rows = math.ceil(len(runs) / min(count, len(runs)))
    picture.alt += f", {rows} in a column" if rows > 1 else ""
    return picture


def lead(run: Any, look: Line) -> Array:
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

FIRST = Line("first", "#8c8c8c", "-", 3.2, 2.2)
SECOND = Line("second", "#1259a8", "-", 1.1, 2.8)
APART = Mark("largest deviation", "#b3261e", "o", 9, False, 4.2)
CUTTING = tuple(kind for kind in Kind if kind != Kind.RAPID)
RAPID_WIDTH = 0.6  # of the width of cuts
SHOWN = 1e-6  # mm: less is called the same


@sized()
def plot_deviation(found: Any, view: str = "auto", size: tuple[float, float] = SIZE) -> Picture:
    """The first path wide and grey, the second thin and blue over it, rapids dashed; a ring and a line where they are farthest
    apart."""
    one, other = found.paths
    lathe = one.lathe or other.lathe
    looks = [look._replace(name=name) for look, name in zip((FIRST, SECOND), found.names)]
    lines = [(look, line_of(path, CUTTING)) for look, path in zip(looks, found.paths)]
    for look, path, rapids in zip(looks, found.paths, found.rapids):
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
