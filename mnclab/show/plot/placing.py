"""Where texts stand beside their places so that none covers another, or a mark; a text without a free place is left out."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from mnclab.path.toolpath import Array
from mnclab.show.plot import colours
from mnclab.show.plot.picture import SMALL

DISTANCES = (7.0, 12.0, 18.0, 26.0, 36.0, 50.0, 66.0)  # points from the edge of a mark to that of its text
TURNS = 16
MARK = 4.0  # points from the middle of another mark to its edge
APART = 4.0  # points between two texts
LINE_COST, BEND_COST = 1.0, 5.0  # of a point of a line under a text, of a text on another side than the one wished
FONT = SMALL - 0.5
CARD = {"boxstyle": "round,pad=0.12", "facecolor": "#ffffffd8", "edgecolor": "none"}


def write_beside(
    ax: Axes, texts: Sequence[Sequence[str]], places: Array, radii: Sequence[float], wishes: Array, lines: Sequence[Array],
    colour: str = colours.INK, marks: Array | None = None,
) -> int:  # fmt: skip
    """Write one of the `texts` of each place (n, 2) beside its mark: the first that has room; returns how many have none.

    `radii` are those of the marks in mm, `wishes` (n, 2) the directions in which a text stands best, `lines` what it should
    rather not cover, `marks` (m, 2) what it must not. The limits of the axes must be those of the finished picture.
    """
    figure = ax.get_figure(root=True)
    assert isinstance(figure, Figure)
    pixels = figure.dpi / 72
    spots = ax.transData.transform(places) / pixels
    unit = float(np.hypot(*(ax.transData.transform([[1.0, 0.0]]) - ax.transData.transform([[0.0, 0.0]]))[0])) / pixels
    discs = np.asarray(radii, dtype=float) * unit
    frame = np.asarray(ax.get_window_extent().extents) / pixels + (APART, APART, -APART, -APART)
    drawn = np.vstack([np.empty((0, 2)), *(ax.transData.transform(line) / pixels for line in lines)])
    taken = np.column_stack([spots - discs[:, None], spots + discs[:, None]])  # boxes: left, below, right, above
    if marks is not None and len(marks):
        others = ax.transData.transform(marks) / pixels
        taken = np.vstack([taken, np.column_stack([others - MARK, others + MARK])])
    for other in ax.texts:
        if other.get_text():
            taken = np.vstack([taken, np.ravel(other.get_window_extent().extents) / pixels])
    left_out = 0
    for spot, disc, wish, choices in zip(spots, discs, wishes, texts):
        written = False
        for text in choices:
            label = ax.annotate(
                text, (0, 0), (0, 0), textcoords="offset points", fontsize=FONT, color=colour, va="center", ha="center",
                zorder=6, annotation_clip=False, bbox=CARD,
            )  # fmt: skip
            label.set_parse_math(False)
            box = label.get_window_extent()
            half = np.array([box.width, box.height]) / pixels / 2 + APART / 2
            middle = _free(spot, disc, half, wish, taken, frame, drawn)
            if middle is None:
                label.remove()
                continue
            label.xy = tuple(ax.transData.inverted().transform(spot * pixels))
            label.set_position(tuple(middle - spot))
            taken = np.vstack([taken, [*(middle - half), *(middle + half)]])
            _lead(ax, spot, disc, middle, half, pixels, colour)
            written = True
            break
        left_out += not written
    return left_out


def _free(spot: Array, disc: float, half: Array, wish: Array, taken: Array, frame: Array, drawn: Array) -> Array | None:
    """The middle of the best free box beside a spot, in points; None if there is none."""
    best, least = None, math.inf
    for out in DISTANCES:
        for turn in np.arange(TURNS) * (2 * math.pi / TURNS):
            way = np.array([math.cos(turn), math.sin(turn)])
            reach = min(half[k] / abs(way[k]) if abs(way[k]) > 1e-9 else math.inf for k in (0, 1))  # from middle to edge
            middle = spot + way * (disc + out + reach)
            low, high = middle - half, middle + half
            if (low < frame[:2]).any() or (high > frame[2:]).any():
                continue
            if ((low < taken[:, 2:]) & (high > taken[:, :2])).all(axis=1).any():
                continue
            under = ((drawn > low) & (drawn < high)).all(axis=1).sum()
            cost = out + reach / 4 + LINE_COST * min(under, 30) + BEND_COST * (1 - float(way @ wish))
            if cost < least:
                best, least = middle, cost
    return best


def _lead(ax: Axes, spot: Array, disc: float, middle: Array, half: Array, pixels: float, colour: str) -> None:
    """A thin line from the edge of the mark to the nearest place of the text's box."""
    end = np.clip(spot, middle - half + APART / 2, middle + half - APART / 2)
    size = float(np.hypot(*(end - spot)))
    if size - disc < 3:
        return
    begin = spot + (end - spot) * disc / size
    line = ax.transData.inverted().transform(np.array([begin, end]) * pixels)
    ax.plot(*line.T, color=colour, linewidth=0.6, zorder=5.5, scalex=False, scaley=False)
