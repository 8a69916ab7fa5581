"""The worst places of a difference: numbers in the picture that never cover each other, and what each of them is."""

from __future__ import annotations

import math
from typing import NamedTuple

from matplotlib.axes import Axes
from matplotlib.lines import Line2D

from mnclab.design.difference.difference import Difference
from mnclab.show.plot import colours
from mnclab.show.plot.picture import SMALL
from mnclab.show.plot.sections import HALO

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
