"""Pictures of several trials side by side: one view of each, all at one scale, each under its name."""

from __future__ import annotations

import math
from collections.abc import Sequence

from matplotlib.axes import Axes
from numpy.typing import NDArray

from mnclab.show.plot.picture import SMALL, VIEWS, Picture, View, dress

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
