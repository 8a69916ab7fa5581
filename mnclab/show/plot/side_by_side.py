"""Side by side at one scale: trials, areas and what comes of them, runs, and one path over another."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.lines import Line2D
from matplotlib.patches import Patch, PathPatch

from mnclab.geometry.regions import Region
from mnclab.path.toolpath import Array, Kind, Mask, Toolpath
from mnclab.show import looks
from mnclab.show.plot import colours
from mnclab.show.plot.colours import RAPID, LineStyle, Mark
from mnclab.show.plot.layers import once
from mnclab.show.plot.path import ROOM, goes_out, plot_run, with_rapids
from mnclab.show.plot.picture import (
    LINE,
    SIZE,
    SMALL,
    VIEWS,
    Foot,
    Picture,
    View,
    arrange,
    broken,
    calm,
    dress,
    legend_height,
    legend_rows,
    write_legend,
)  # fmt: skip
from mnclab.show.plot.sections import outline_of
from mnclab.show.plot.sizes import placed, sized
from mnclab.show.plot.strokes import corners, line_of
from mnclab.text.alarm import Alarm
from mnclab.text.given import choice, fitting, shown, whole

# Pictures of several trials: one view of each, all of one size, each under its name.

LEFT, BETWEEN, RIGHT, TITLE, LOW = 0.62, 0.22, 0.16, 0.26, 0.48  # inches
TITLES = (SMALL + 1, SMALL, SMALL - 1, SMALL - 2)  # points: the largest at which no word is broken
NOTE = 0.5  # inches of what stands beside a name, such as ≤ 180°
TALLEST = 5.0  # of one view
SLIM = 0.4  # of its height: what a view is wide at least
ROOMY = 2.3  # of a view: above it there is room for words beside its name


def panels(
    names: Sequence[str], alt: str, width: float, columns: int, ratio: float, legend: Sequence[Any], *, below: float = LOW,
    tallest: float = TALLEST, left: float = LEFT, notes: bool = False, also: Callable[[Picture], None] | None = None,
) -> tuple[Picture, list[Axes]]:  # fmt: skip
    """Axes under their names, `ratio` high for their width, with numbers at the outer ones only.

    `width` of the picture, `below` and `left` of the views, and the height of one at most in inches; with `notes` there is room
    beside the names; `also` sets up what else has axes.
    """
    rows = math.ceil(len(names) / columns)
    wide = max((width - left - RIGHT - BETWEEN * (columns - 1)) / columns, 0.1)
    tall = min(wide * ratio, tallest)
    wide = tall / ratio if ratio * wide > tallest and tallest == TALLEST else wide
    longest = max((word for name in names for word in name.split(" ")), key=len)
    letters = next((each for each in TITLES if len(broken(longest, wide, each)) == 1), SMALL + 1)
    titles = [broken(name, wide, letters) for name in names]
    for k, lines in enumerate(titles if notes else ()):  # beside the last line, which is left to them where it has no room
        if len(broken(lines[-1], wide - NOTE, letters)) > 1:
            shorter = broken(names[k], wide - NOTE, letters)
            titles[k] = shorter if " ".join(shorter) == names[k] else [*lines, ""]
    over = [TITLE + LINE * (max(map(len, titles[k : k + columns])) - 1) for k in range(0, len(names), columns)]
    top = 0.08 + legend_height(len(legend_rows([each.get_label() for each in legend], width)))
    loose = LOW if len(names) % columns else BETWEEN  # above a row that is not full: numbers below the last of a column
    apart = [BETWEEN] * (rows - 2) + [loose] * (rows > 1)
    height = top + sum(over) + rows * tall + sum(apart) + below
    picture = Picture((width, height), alt)
    for k, lines in enumerate(titles):
        row, column = divmod(k, columns)
        x, y = left + column * (wide + BETWEEN), height - top - sum(over[: row + 1]) - (row + 1) * tall - sum(apart[:row])
        ax = picture.add_axes((x / width, y / height, wide / width, tall / height))
        ax.set_title("\n".join(lines), fontsize=letters, loc="left", pad=4, parse_math=False)
        calm(ax)
        ax.tick_params(labelleft=not column, labelbottom=k + columns >= len(names))
    write_legend(picture, legend)
    axes = list(picture.axes)
    if also is not None:
        also(picture)
    placed(picture)
    return picture, axes


def views(
    names: Sequence[str], what: str, width: float, columns: int, view: View, low: Array, high: Array, legend: Sequence[Any],
    **room: Any,
) -> tuple[Picture, list[Axes]]:  # fmt: skip
    """The same of one view at one scale, from `low` to `high` (2,) mm."""
    alt, (wide, tall) = f"{what}: {', '.join(names)}", high - low
    if wide < SLIM * tall:  # numbers have room below it
        more = np.array([(SLIM * tall - wide) / 2, 0.0])
        low, high, wide = low - more, high + more, SLIM * tall
    picture, axes = panels(names, alt, width, columns, float(tall / wide), legend, **room)
    size = picture.get_size_inches()
    for ax in axes:
        dress(ax, view, tuple(ax.get_position().size * size))
        ax.set(xlim=(low[0], high[0]), ylim=(low[1], high[1]))
    label_outer(axes, view.labels[0], view.fits(ax.get_position().height * size[1]))
    return picture, axes


def label_outer(axes: Sequence[Axes], right: str, up: str) -> None:
    """Names at the axes that have numbers."""
    for ax in axes:
        ax.set_xlabel(right if ax.xaxis.get_tick_params()["labelbottom"] else "", fontsize=SMALL + 1)
        ax.set_ylabel(up if ax.yaxis.get_tick_params()["labelleft"] else "", fontsize=SMALL + 1)


def evenly(count: int, most: float) -> int:
    """How many columns, at most so many: as few rows as they allow, filled as evenly as they can be."""
    return math.ceil(count / math.ceil(count / max(1, int(most))))


# What is hatched in pictures of trials, and areas with their holes.

REST, CORNER = looks.WRONG, looks.GREY


def area(ax: Axes, region: Region, **look: Any) -> None:
    """A region with its holes as one patch."""
    if region.loops:
        ax.add_artist(PathPatch(outline_of(region.loops), **look))  # limits are set: to look for them takes longest


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

WIDE = 2.1  # inches of a view and what stands beside it, at least


@sized()
def plot_regions(
    regions: Mapping[str, Region], over: Sequence[Region] = (), width: float = 9.0, columns: int | None = None
) -> Picture:
    """One view of each named region with its area, all at one scale, each with the outlines of what is `over` it, dashed.

    `width` of the picture in inches.

    >>> mnc.area.plot({"pocket": mnc.area.Region.of(mnc.area.rectangle(40, 20))}).alt
    'regions: pocket: 800.0 mm²'
    """
    if not isinstance(regions, Mapping) or not all(isinstance(one, Region) for one in regions.values()):
        raise Alarm(f"regions must be Regions by their names, got {shown(regions)}", hint='{"A": a, "B": b, "A | B": a.union(b)}')
    corners = [one.bounds for one in (*regions.values(), *over) if one.loops]
    if not regions or not corners:
        raise Alarm("there is nothing to draw: no region encloses anything")
    low, high = np.min([box[0] for box in corners], axis=0), np.max([box[1] for box in corners], axis=0)
    margin = 0.06 * float((high - low).max())
    names, count = [f"{name}: {one.area:.1f} mm²" for name, one in regions.items()], columns or evenly(len(regions), width / WIDE)
    picture, axes = views(names, "regions", width, count, VIEWS["XY"], low - margin, high + margin, [])
    for ax, one in zip(axes, regions.values(), strict=True):
        area(ax, one, facecolor="#cfe0f1", edgecolor="none", zorder=1.0)
        for other in over:
            look = {"edgecolor": colours.PROGRAMMED.colour, "linestyle": (0, (4, 3)), "linewidth": 0.9}
            area(ax, other, facecolor="none", zorder=1.5, **look)
        area(ax, one, facecolor="none", edgecolor=colours.FEED.colour, linewidth=1.6, zorder=2.0)
    return picture


# Several runs in one figure: side by side at one scale, or one path over the other.

LEADS = {"APPR": colours.ENTRY._replace(name="approach", dashes="-", width=2.8)}
LEADS["DEP"] = colours.EXIT._replace(name="departure", dashes="-", width=2.8)
MARGIN = 0.12  # of the greatest side


def by_name(given: tuple[Any, ...], names: Sequence[str], known: Callable[[Any], tuple[str, Any]], hint: str) -> dict[str, Any]:
    """What is put side by side, by its names: those of a dict, `names`, or what `known` says that each is called by itself; an
    Alarm where there is nothing, or not a name for each. Those that are called alike have their number."""
    first = given[0]
    if isinstance(first, Mapping) and len(given) == 1 and not names:
        given, names = tuple(first.values()), list(first)
    elif isinstance(first, list | tuple):
        given = (*first, *given[1:])
    found = [known(each) for each in given]
    if not found:
        raise Alarm("there is nothing to put side by side", hint=hint)
    named = isinstance(names, tuple | list) and all(isinstance(name, str) for name in names)
    if not named or names and len(names) != len(found):
        raise Alarm(f"there must be a name for each of {len(found)}, got {shown(names)}", hint=hint)
    called = list(names) or [name for name, _ in found]
    numbered = (f"{name} ({k})" if called.count(name) > 1 else name for k, name in enumerate(called, 1))
    return dict(zip(numbered, (each for _, each in found)))


def _run(given: Any) -> tuple[str, Any]:
    if not isinstance(getattr(given, "toolpath", None), Toolpath) or not hasattr(given, "program"):
        raise Alarm(f"runs are put side by side, got {shown(given)}", hint=BESIDE)
    return given.program.title, given


BESIDE = 'mnclab.plot_runs(run, other), mnclab.plot_runs({"LT": run, "CT": other})'


@sized(also=plot_run)
@fitting
def plot_runs(
    run: Any, *others: Any, names: Sequence[str] = (), view: str = "XY", columns: int | None = None, width: float = 9.0,
    **options: Any,
) -> Picture:  # fmt: skip
    """Runs as small pictures at one scale: `plot_runs(one, other)`, or by name `plot_runs({"LT": one, "CT": other})`.

    They may be a list, too. `names` are what they are called (default: their programs), `view` is that of all, `columns` how
    many stand in a row, `width` in inches; the `options` are those of `run.plot()`. The frame holds the cuts of all of them:
    rapids from far away are cut off.

    >>> run = mnc.run("S800 M3\\nG1 X60 F3600\\n", "mnc")
    >>> mnc.plot_runs({"one": run, "other": run}).alt
    'runs side by side: one, other'
    """
    runs = by_name((run, *others), names, _run, BESIDE)
    view = choice(view, "view", VIEWS)
    count = evenly(len(runs), width / WIDE) if columns is None else min(columns, len(runs))
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
    moves = [colours.FEED] if options.get("colour", "kind") == "kind" else []
    moves += [RAPID] if any((run.toolpath.kind == Kind.RAPID).any() for run in runs.values()) else []
    legend = [Line2D([], [], **look.style()) for look in (*moves, *leads)]
    picture, drawn = views(list(runs), "runs side by side", width, count, VIEWS[view], low, high, legend)
    for ax, run in zip(drawn, runs.values()):
        right, up = ax.get_xlabel(), ax.get_ylabel()
        plot_run(run, ax, view, **options)
        ax.set(xlabel=right, ylabel=up)
        for look in LEADS.values():
            if len(points := lead(run, look)):
                ax.add_line(Line2D(points[:, axes[0]], points[:, axes[1]], **look.style()))
        ax.set_aspect("equal", adjustable="box")
        ax.set(xlim=(low[0], high[0]), ylim=(low[1], high[1]))
    rows = math.ceil(len(runs) / count)
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
#: Its dashes, which count in widths, are as long as those that lie over it: the gaps stay open.
FIRST_RAPID = RAPID._replace(
    name="_rapid of the first", colour="#e7a39d", width=2 * RAPID.width, order=FIRST.order, dashes=(0, (2.5, 1.5))
)
SHOWN = 1e-6  # mm: less is called the same


@sized()
def plot_deviation(found: Any, view: str = "auto", size: tuple[float, float] = SIZE) -> Picture:
    """The first path wide and grey, the second thin and blue over it, rapids as everywhere; a ring and a line where they are
    farthest apart."""
    one, other = found.paths
    lathe = one.lathe or other.lathe
    called = [look._replace(name=name) for look, name in zip((FIRST, SECOND), found.names)]
    lines = [(look, line_of(path, CUTTING)) for look, path in zip(called, found.paths)]
    for look, path, rapids in zip((FIRST_RAPID, RAPID), found.paths, found.rapids):
        lines += [(look, line)] if len(line := line_of(path, (Kind.RAPID,), rapids)) else []
    where = found.where if found.largest > SHOWN else None
    every = corners([xyz for _, xyz in lines], lathe) or (np.zeros(3), np.zeros(3))
    low, high = corners([*(xyz for _, xyz in lines[:2] if len(xyz)), *([np.stack(where[:2])] if where else [])], lathe) or every
    low, high, beyond = with_rapids(low, high, every, np.stack([low, high]), ROOM)
    view = choice(view, "view", ("auto", *VIEWS))
    views = [VIEWS["ZX"]] if lathe else [VIEWS["XY"]] if high[2] <= low[2] else [VIEWS["XY"], VIEWS["XZ"]]
    views = [each._replace(unit=found.unit) for each in (views if view == "auto" else [VIEWS[view]])]
    unseen = beyond.any() and any(goes_out(path, low, high, views) for path in found.paths)
    said = f"{found.sentence}\nrapids between cuts go farther" if unseen else found.sentence
    marks = [(APART, where[0])] if where else []
    return laid_over(lines, marks, where[:2] if where else (), views, low, high, said, f"two paths: {found.sentence}", size)


def laid_over(
    lines: Sequence[tuple[LineStyle, Array]], marks: Sequence[tuple[Mark, Array]], gap: Sequence[Array], views: Sequence[View],
    low: Array, high: Array, said: str, alt: str, size: tuple[float, float],
) -> Picture:  # fmt: skip
    """Lines (n, 3) over one another in some views, with marks, and a line from end to end of the gap between two of them."""
    styles: list[LineStyle | Mark] = [*(look for look, _ in lines), *(mark for mark, _ in marks)]
    named = [look.name for look in styles if not look.name.startswith("_")]
    picture, axes = arrange(views, low, high, named, Foot(said), alt, size)
    for ax, each in zip(axes, views):
        if gap:
            ends = np.stack(gap)[:, [each.right, each.up]]
            ax.add_line(Line2D(*ends.T, color=APART.colour, linewidth=1.2, zorder=APART.order))
        drawn = [Line2D(*_seen(ax, look, xyz, [each.right, each.up]).T, **look.style()) for look, xyz in lines]
        drawn += [Line2D([place[each.right]], [place[each.up]], **mark.style()) for mark, place in marks]
        for artist in drawn:
            ax.add_line(artist)
    write_legend(picture, [each for each in drawn if not str(each.get_label()).startswith("_")])
    return picture


def _seen(ax: Axes, look: LineStyle, xyz: Array, axes: list[int]) -> Array:
    """A line (n, 3) broken by nan as a view shows it (k, 2): dashes over dashes would close their gaps."""
    if look.name not in (RAPID.name, FIRST_RAPID.name) or not len(xyz):
        return xyz[..., axes]
    gap: Mask = np.asarray(np.isnan(xyz).any(axis=1))
    joined = ~gap & ~np.append(True, gap[:-1])
    return once(ax, np.nan_to_num(xyz), np.where(joined, 0, -1), axes)


# The spot where two programs differ: the paths about it, and both places.

HERE = Mark("place on the first", looks.GREY, "s", 9, False, 4.1)
THERE = Mark("place on the second", looks.WRONG, "o", 9, False, 4.2)
AROUND = 12.0  # mm beside the places, at least
ROWS = 400  # of each path about the place


@sized()
def plot_proof(found: Any, number: int | None = None, view: str = "auto", size: tuple[float, float] = SIZE) -> Picture:
    """Both paths about a difference, the first one that is not harmless or the one of a `number` from 0; `view` "XY", "XZ", …"""
    if not found.differences:
        raise Alarm("there is no difference to draw: the motion is the same", hint="run.plot() shows one of the two")
    count = len(found.differences)
    if number is not None and not 0 <= whole(number, "the number of the difference") < count:
        raise Alarm(f"the differences have the numbers 0 to {count - 1}, there is no number {number}")
    one = found.first if number is None else found.differences[number]
    lathe = any(path.lathe for path in found.paths)
    places = [np.array(place) if place else None for place in one.places]
    near, lines = [place for place in places if place is not None] or [np.zeros(3)], []
    for look, rapid, path, row, name in zip((FIRST, SECOND), (FIRST_RAPID, RAPID), found.paths, one.rows, found.names):
        some = path[max(row - ROWS, 0) : max(row, 0) + ROWS]
        lines += [(look._replace(name=name), line_of(some, CUTTING))]
        lines += [(rapid, dashed)] if len(dashed := line_of(some, (Kind.RAPID,))) else []
    low, high = np.min(near, axis=0), np.max(near, axis=0)
    room = max(AROUND, 0.25 * float((high - low).max()))
    low, high = low - room, high + room
    view = choice(view, "view", ("auto", *VIEWS))
    views = [VIEWS["ZX"]] if lathe else [VIEWS["XY"], VIEWS["XZ"]]
    views = [each._replace(unit=found.unit) for each in (views if view == "auto" else [VIEWS[view]])]
    named = (mark._replace(name=f"end of it in {name}") for mark, name in zip((HERE, THERE), found.names))
    marks = [(mark, place) for mark, place in zip(named, places) if place is not None]
    joined = len(marks) == 2 and one.kind in ("geometry", "depth", "side")  # of rapids it would look like one
    gap = [place for _, place in marks] if joined else []
    return laid_over(lines, marks, gap, views, low, high, one.sentence.replace("`", ""), one.sentence, size)
