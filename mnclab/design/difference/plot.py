"""A part against what it should be: the signed map from above with its worst places, sections with the deviation magnified,
the half section of a lathe; below it the table of measures. Gouges are dark and crossed, rest is lighter and dotted, in grey
print too.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection, PolyCollection
from matplotlib.colors import LinearSegmentedColormap, Normalize
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from mnclab.design.difference.difference import HEAD, NUMBERS, Difference
from mnclab.design.difference.plot_sections import (
    BAND,
    DASHES,
    FULL,
    Magnified,
    draw_magnified,
    draw_surface,
    draw_target,
    nice,
    sections_of,
    write_factor,
)
from mnclab.geometry.contours import Contour
from mnclab.path.toolpath import Array
from mnclab.show.plot import colours
from mnclab.show.plot.classes import number
from mnclab.show.plot.picture import (
    LINE,
    SCALE,
    SIZE,
    SMALL,
    VIEWS,
    Foot,
    Picture,
    arrange,
    column_widths,
    dress,
    figure_of,
    write_legend,
    write_table,
)  # fmt: skip
from mnclab.show.plot.sections import HALO, mark_section
from mnclab.show.plot.sizes import reframe, sized
from mnclab.text.alarm import Alarm
from mnclab.text.given import check_number, shown

#: Dark blue what is gone, pale what is right, orange what is left; grey print keeps the order.
GONE, RIGHT, LEFT = "#0b2a78", "#f4f1e6", "#d9541e"
SHADES = LinearSegmentedColormap.from_list("difference", [GONE, "#3f68b5", "#a9bfe0", RIGHT, "#f6c3a0", "#ee8a4d", LEFT])
HATCHES = {-1: "xxxx", 1: "...."}
OUTLINE: dict[str, Any] = {"colors": colours.INK, "linewidths": 0.8, "zorder": 2.0}
DOTS = 9.0  # points², of a place of a wall
NAMES = ("gouge", "rest")
WIDE, SAID = 1.5, 0.4  # times its height: a picture whose words stand beside it; their share of its width


@sized()
def plot_difference(
    difference: Difference,
    ax: Axes | None = None,
    *,
    section: str | Sequence[str] = (),
    at: float | Sequence[float] | None = None,
    table: bool = False,
    limit: float | None = None,
    size: tuple[float, float] = SIZE,
) -> Figure:
    """The signed deviation in mm: + what is left over, - what is gone.

    - `ax`: draw into these axes of one's own, without sections, table, legend and scale.
    - `section` of a milled part: planes "XZ" or "YZ", one or several, each at its place `at` (mm; default through the worst
      place): the part and its target, the deviation magnified by a factor that is told.
    - `table`: the measures below the picture; what is out has a number, which stands at its place too.
    - `limit`: the ends of the scale, mm; default the worst deviation, at least twice the tolerance and at most ten times.
    - `size`: the greatest width and height in inches, without the table.
    """
    if not isinstance(table, bool):
        raise Alarm(f"table must be True or False, got {shown(table)}")
    most = limit_of(difference, limit)
    lathe = difference.workpiece.cutting.lathe
    cuts = sections_of(difference, section, at)
    if ax is not None:
        _draw(ax, difference, most)
        return figure_of(ax)
    low, high = difference.compared.bounds_3d if lathe else _bounds(difference)
    views = [VIEWS["ZX" if lathe else "XY"], *(each.section.view for each in cuts)]
    marks = marks_of(difference)
    rows = [(), *lines_of(difference, marks)] if table and len(difference.features) else []
    told = [*_told(difference), *(f"{each.number}  {each.text}" for each in marks)]
    foot = Foot("\n".join([*told, *([""] * len(rows))]))
    beside = 0.0 if rows or size[0] < WIDE * size[1] else SAID * size[0]  # inches for the words
    foot = foot.within(beside or size[0])
    room = (size[0] - beside, size[1]) if beside else (size[0], size[1] + LINE * len(foot.lines))
    handles = _handles(difference, cuts)
    names = [str(each.get_label()) for each in handles]
    picture, axes = arrange(views, low, high, names, None if beside else foot, _words(difference), room, True)
    (left, height), top = picture.get_size_inches().tolist(), axes[0].get_position(original=True).y1
    reframe(picture, 0.0, 0.0, left + beside if beside else max(left, wide_of(rows)), height)  # the views keep their size
    if beside:
        foot.write(picture, left, top * height - LINE * len(foot.lines))
    _draw(axes[0], difference, most)
    for one, each in zip(axes[1:], cuts):
        draw_magnified(one, each, (GONE, LEFT))
        mark_section(axes[0], each.section, low, high)
    _scale(picture, most, difference.tolerance, max(difference.worst_gouge.value, difference.worst_rest.value) > most)
    write_legend(picture, handles, SCALE)
    draw_table(picture, rows)
    return picture


def limit_of(difference: Difference, given: float | None) -> float:
    """The ends of the scale, mm: those given, else the worst deviation, but two tolerances at least and ten at most."""
    if given is not None:
        check_number(given, "the limit of the scale (mm)", above=0)
        return float(given)
    worst, tolerance = max(difference.worst_gouge.value, difference.worst_rest.value), difference.tolerance
    return nice(min(max(worst, 2 * tolerance), FULL * tolerance))


def _bounds(difference: Difference) -> tuple[Array, Array]:
    stock = difference.workpiece.cutting.stock.bounds
    other = difference.compared.bounds
    return np.minimum(stock[0], other[0]), np.maximum(stock[1], other[1])


def _draw(ax: Axes, difference: Difference, most: float) -> None:
    lathe = difference.workpiece.cutting.lathe
    box, free = (ax.get_xlim(), ax.get_ylim()), ax.get_autoscale_on()
    (_draw_half if lathe else _draw_plan)(ax, difference, most)
    if free:
        dress(ax, VIEWS["ZX" if lathe else "XY"])
        ax.autoscale_view()
    else:
        ax.set(xlim=box[0], ylim=box[1])
    draw_marks(ax, marks_of(difference), (2, 0) if lathe else (0, 1), (GONE, LEFT))


def _draw_plan(ax: Axes, difference: Difference, most: float) -> None:
    step = float(difference.workpiece.step)
    box = difference.x[0] - step / 2, difference.x[-1] + step / 2, difference.y[0] - step / 2, difference.y[-1] + step / 2
    norm = Normalize(-most, most)
    look: dict[str, Any] = {"cmap": SHADES, "norm": norm, "interpolation": "nearest", "zorder": 0.8}
    ax.imshow(difference.map, extent=box, origin="lower", aspect="auto", **look)
    beyond = np.nan_to_num(difference.map)
    for sign, hatch in HATCHES.items():
        wide = np.pad((sign * beyond > difference.tolerance).astype(float), 1)
        if wide.any():
            x, y = (np.concatenate([[each[0] - step], each, [each[-1] + step]]) for each in (difference.x, difference.y))
            drawn = ax.contourf(x, y, wide, [0.5, 2.0], colors="none", hatches=[hatch], zorder=1.0)
            drawn.set_edgecolor("#ffffffb0" if sign < 0 else "#6b2a08b0")
            drawn.set_linewidth(0.0)
            ax.contour(x, y, wide, [0.5], colors=GONE if sign < 0 else LEFT, linewidths=0.7, zorder=1.1)
    for loop in outlines(difference):
        ax.add_collection(LineCollection([_closed(loop)], **OUTLINE))
    _draw_walls(ax, difference, norm)


def outlines(difference: Difference) -> list[Contour]:
    """The edges of the target from above: its sections between the levels that most of it stands at."""
    top = difference.looked.grid.top
    levels, count = np.unique(top[np.isfinite(top)].round(6), return_counts=True)
    low = float(difference.compared.bounds[0, 2])
    levels = np.unique(np.append(levels[count > 1e-3 * top.size][-12:], low))
    middles = (levels[1:] + levels[:-1]) / 2
    return [loop for z in middles for loop in difference.compared.cut("XY", float(z))]


def _draw_walls(ax: Axes, difference: Difference, norm: Normalize) -> None:
    """Places of walls that are off as dots, the worst of each above the others: thinner than a cell they have none."""
    seen = difference.looked
    off, place = seen.off[seen.of_walls], seen.walls.place[seen.walls.spot]
    some = np.flatnonzero(np.abs(off) > difference.error)
    some = some[np.argsort(np.abs(off[some]), kind="stable")]
    for sign, marker in ((-1, "v"), (1, "o")):
        mine = some[np.sign(off[some]) == sign]
        ax.scatter(
            place[mine, 0], place[mine, 1], s=DOTS, c=off[mine], cmap=SHADES, norm=norm, marker=marker, linewidths=0.25,
            edgecolors=GONE if sign < 0 else "#6b2a08", zorder=2.4,
        )  # fmt: skip


def _draw_half(ax: Axes, difference: Difference, most: float) -> None:
    target, looked = difference.compared, difference.looked
    factor = factor_of(difference)
    place, normal, off = looked.places.place, looked.places.normal, np.nan_to_num(looked.off)
    much = (np.abs(off) > FULL * difference.tolerance) | np.isnan(looked.moved)
    off = np.where(much, 0.0, off)  # too much to be magnified: areas as they are
    draw_target(ax, target.section, looked.gone, looked.left, (GONE, LEFT))
    drawn = place + factor * off[:, None] * normal
    same = (np.diff(looked.places.line) == 0) & (np.diff(looked.places.element) == 0)
    quads = np.stack([place[:-1], place[1:], drawn[1:], drawn[:-1]], axis=1)
    mean = (off[:-1] + off[1:]) / 2
    some = same & (off[:-1] * off[1:] > 0)
    ax.add_collection(PolyCollection(list(quads[some]), array=mean[some], cmap=SHADES, norm=Normalize(-most, most), zorder=2.0))
    edges = np.stack([drawn[:-1], drawn[1:]], axis=1)
    draw_surface(ax, edges, some, mean, (GONE, LEFT))
    for side in (-1, 1):
        band = place + side * factor * difference.tolerance * normal
        lines = np.stack([band[:-1], band[1:]], axis=1)[same]
        ax.add_collection(LineCollection(list(lines), colors=BAND, linewidths=0.5, linestyles=DASHES, zorder=1.9))
    low, high = target.ends
    reach = 0.04 * (high - low)
    ax.add_line(Line2D([low - reach, high + reach], [0, 0], **{**colours.CENTRE_LINE.style(), "zorder": 2.8, "label": "_centre"}))
    write_factor(ax, "", factor)


def factor_of(difference: Difference) -> float:
    """By how much deviations along a half section are magnified: the worst one to a twelfth of its height."""
    off = np.abs(np.nan_to_num(difference.looked.off))
    worst = float(np.clip(off.max(initial=0.0), difference.tolerance, FULL * difference.tolerance))
    low, high = difference.compared.ends
    radius = max(float(loop.bounds[1, 1]) for loop in difference.compared.section)
    return max(1.0, nice(min(high - low, radius) / 12 / worst) / 2)


def _closed(loop: Contour) -> Array:
    points = loop.points_within(0.02)
    return np.concatenate([points, points[:1]])


def _handles(difference: Difference, cuts: Sequence[Magnified]) -> list[Any]:
    lathe = difference.workpiece.cutting.lathe
    found: list[Any] = [Line2D([], [], color=colours.INK, linewidth=0.9, label=difference.target)]
    found += [Patch(facecolor=GONE, edgecolor="#ffffff", hatch="" if lathe else HATCHES[-1], label="gouge")]
    found += [Patch(facecolor=LEFT, edgecolor="#6b2a08", hatch="" if lathe else HATCHES[1], label="rest")]
    if lathe or cuts:
        found.append(Line2D([], [], color=BAND, linewidth=0.7, linestyle=DASHES, label="tolerance"))
    return found


def _told(difference: Difference) -> list[str]:
    volumes = f"gouged away {difference.gouge_volume:.3f} mm³, left over {difference.rest_volume:.3f} mm³"
    return [f"{difference.verdict} within {number(difference.tolerance)} mm; {volumes}"]


def _words(difference: Difference) -> str:
    gone, left = (getattr(difference, f"worst_{name}") for name in NAMES)
    return f"difference from {difference.target}: {_told(difference)[0]}; worst gouge {gone}; worst rest {left}"


def _scale(picture: Picture, most: float, tolerance: float, more: bool) -> None:
    """The bar of colours above the views, the tolerance marked on it; whether there is `more` than at its ends."""
    width, height = picture.get_size_inches().tolist()
    long, thick = min(3.6, width - 2.0), 0.1
    ax = picture.add_axes((1.15 / width, 1 - (0.07 + thick) / height, long / width, thick / height))
    ax.imshow(np.linspace(-most, most, 256)[None], cmap=SHADES, extent=(-most, most, 0, 1), aspect="auto")
    ax.set_yticks([])
    for place in (-tolerance, tolerance):
        ax.axvline(place, color=colours.INK, linewidth=1.1)
    ax.tick_params(labelsize=SMALL, length=2, pad=1)
    ticks = np.array([-most, -most / 2, 0, most / 2, most])
    names = [("+" if t > 0 else "") + number(t).replace("-", "\N{MINUS SIGN}") for t in ticks.tolist()]
    if more:
        names[0], names[-1] = f"\N{LESS-THAN OR EQUAL TO} {names[0]}", f"\N{GREATER-THAN OR EQUAL TO} {names[-1]}"
    ax.set_xticks(ticks, names)
    ax.set_ylabel("deviation, mm", fontsize=SMALL, rotation=0, ha="right", va="center", labelpad=5)
    ax.spines[:].set_linewidth(0.5)


# The worst places of a difference: numbers in the picture that never cover each other, and what each of them is.

MOST = 9  # numbers
NEAR = 1e-3  # mm: places that are one
OUT, SIDE = (15.0, 24.0, 34.0, 46.0), 13.0  # points: how far a number stands beside its place, and how large it is
TURNS = [(k * math.pi / 4 + math.pi / 4) for k in range(8)]


class Marked(NamedTuple):
    """A number, its place, which sign it has, its row in the table (-1 none), and what is said of it."""

    number: int
    place: tuple[float, float, float]
    sign: int
    row: int
    text: str


def marks_of(difference: Difference) -> list[Marked]:
    """The worst gouge, the worst rest, and the worst places of measures that are out."""
    found: list[Marked] = []
    for name, worst, sign in (("gouge", difference.worst_gouge, -1), ("rest", difference.worst_rest, 1)):
        if worst.place is not None:
            value = f"{'+' if sign > 0 else chr(0x2212)}{worst.value:.3f} mm"
            text = f"worst {name} {value}, {worst.feature}: {worst.where}"
            found.append(Marked(len(found) + 1, worst.place, sign, -1, text))
    for k, row in enumerate(difference.features):
        if row.ok or row.place is None or len(found) == MOST or row.measure == "form":
            continue
        if any(math.dist(each.place, row.place) <= NEAR for each in found):
            continue
        actual = "not cut" if math.isnan(row.actual) else f"{row.actual:.3f} for {row.nominal:.3f}"
        text = f"{row.feature}, {row.measure} {actual}: {row.where}"
        found.append(Marked(len(found) + 1, row.place, 0, k, text))
    return found


def number_of(difference: Difference, row: int, marks: list[Marked]) -> str:
    """The number at the place of a row of the table, "" where it has none."""
    place = difference.features[row].place
    near = [each.number for each in marks if place is not None and math.dist(each.place, place) <= NEAR]
    return str(near[0]) if near and not difference.features[row].ok else ""


def draw_marks(ax: Axes, marks: list[Marked], axes: tuple[int, int], shades: tuple[str, str]) -> None:
    """A ring about each place and its number beside it."""
    figure = ax.get_figure(root=True)
    if figure is None:
        return
    points = figure.dpi / 72
    taken: list[tuple[float, float]] = []
    spots: list[tuple[float, float]] = []
    for each in marks:
        px, py = ax.transData.transform((each.place[axes[0]], each.place[axes[1]])).tolist()
        spots.append((px / points, py / points))
    box = ax.get_window_extent()
    x0, y0, x1, y1 = (float(value) / points for value in box.extents)
    for each, (x, y) in zip(marks, spots):
        shade = {-1: shades[0], 1: shades[1], 0: colours.INK}[each.sign]
        ax.add_line(Line2D([each.place[axes[0]]], [each.place[axes[1]]], color=shade, marker="o", markersize=7, linestyle="none",
                           markerfacecolor="none", markeredgewidth=1.5, zorder=4.0, path_effects=HALO))  # fmt: skip
        choices = [(out * math.cos(turn), out * math.sin(turn)) for out in OUT for turn in TURNS]

        def cost(way: tuple[float, float], x: float = x, y: float = y) -> float:
            a, b = x + way[0], y + way[1]
            beyond = not (x0 + SIDE < a < x1 - SIDE and y0 + SIDE < b < y1 - SIDE)
            near = sum(math.hypot(a - c, b - d) < 1.3 * SIDE for c, d in [*taken, *spots])
            return 100.0 * near + 50.0 * beyond + math.hypot(*way)

        way = min(choices, key=cost)
        taken.append((x + way[0], y + way[1]))
        ax.annotate(
            str(each.number), (each.place[axes[0]], each.place[axes[1]]), way, textcoords="offset points", fontsize=SMALL + 1,
            weight="bold", ha="center", va="center", color=shade, zorder=5, annotation_clip=False,
            bbox={"boxstyle": "circle,pad=0.2", "facecolor": colours.PAPER, "edgecolor": shade, "linewidth": 1.1},
            arrowprops={"arrowstyle": "-", "color": shade, "linewidth": 1.0, "shrinkA": 0, "shrinkB": 4},
        )  # fmt: skip


# The table of measures below the picture of a difference.

MOST_ROWS = 60  # rows that a picture has room for


def lines_of(difference: Difference, marks: list[Marked]) -> list[tuple[str, ...]]:
    """The head and the rows of the table, of a very long one those that are out; what is marked has its number before it."""
    every = len(difference.features) <= MOST_ROWS
    kept = [k for k, row in enumerate(difference.features) if every or not row.ok][:MOST_ROWS]
    texts = [("", *HEAD), *((number_of(difference, k, marks), *difference.features[k].texts()) for k in kept)]
    keep = [k for k in range(len(texts[0])) if any(row[k] for row in texts[1:])]
    return [tuple(row[k].replace("-", "\N{MINUS SIGN}") if row[k][:1] == "-" else row[k] for k in keep) for row in texts]


def wide_of(rows: list[tuple[str, ...]]) -> float:
    """How wide a picture must be for a table, inches."""
    return 0.2 + sum(column_widths(rows[1:])) if rows else 0.0


def draw_table(picture: Picture, rows: list[tuple[str, ...]]) -> None:
    """The rows in the room kept for them at the foot, what is out bold."""
    if not rows:
        return
    head, *others = rows[1:]  # the first keeps room
    numbers = [head.index(HEAD[k]) for k in NUMBERS if HEAD[k] in head]
    verdict = head.index("verdict")
    out = [line for line, row in enumerate(others, 1) if row[verdict] in ("out", "not cut")]
    write_table(picture, [head, *others], 0.1, 0.07, numbers, out)
