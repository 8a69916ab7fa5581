"""Pictures of several trials side by side: one view of each, all at one scale, each under its name."""

from __future__ import annotations

import math
from collections.abc import Sequence

from matplotlib.axes import Axes
from numpy.typing import NDArray

from mnclab.show.plot.picture import SMALL, VIEWS, Picture, dress

TITLE, LEFT, RIGHT, TALLEST = 0.26, 0.62, 0.12, 9.0  # inches


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
    axes = []
    for k, name in enumerate(names):
        row, column = divmod(k, columns)
        x, y = column * width / columns + LEFT, total - top - (row + 1) * (TITLE + height) - row * gap
        ax = picture.add_axes((x / width, y / total, box / width, height / total))
        dress(ax, VIEWS[view], (box, height), 4)
        ax.set_xlim(low[0], high[0])
        ax.set_ylim(low[1], high[1])
        if column:
            ax.set_ylabel("")
        if k + columns < len(names):
            ax.set_xlabel("")
        ax.set_title(name, fontsize=SMALL + 1, loc="left", pad=4)
        axes.append(ax)
    return picture, axes
