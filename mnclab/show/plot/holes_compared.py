"""The holes of two programs from above: what both have, and what only one of them has."""

from __future__ import annotations

from typing import Any

import numpy as np
from matplotlib.collections import EllipseCollection
from matplotlib.lines import Line2D

from mnclab.show.plot import colours
from mnclab.show.plot.picture import SIZE, VIEWS, Foot, Picture, arrange, write_legend
from mnclab.show.plot.sizes import sized

LOOKS: tuple[tuple[str, str, Any, float], ...] = (
    ("in both", "#8c8c8c", "-", 1.6), ("only in {}", colours.ALARM.colour, "-", 2.2), ("only in {}", "#1259a8", "--", 2.2),
)  # fmt: skip
POINT = 0.01  # of the picture: how wide a hole is whose diameter nobody knows


@sized()
def plot_holes(found: Any, size: tuple[float, float] = SIZE) -> Picture:
    """Circles at their diameters with a cross; grey those of both, red and blue dashed those of one."""
    every = [found.both, *found.only]
    rows = np.concatenate(every)
    low, high = np.zeros(3), np.zeros(3)
    if len(rows):
        half = rows[:, 2:] / 2
        low[:2], high[:2] = (rows[:, :2] - half).min(axis=0), (rows[:, :2] + half).max(axis=0)
    least = POINT * max(float((high - low).max()), 1e-3)
    labels = [label.format(name) for (label, *_), name in zip(LOOKS, ("", *found.names))]
    shown = [label for label, holes in zip(labels, every) if len(holes)]
    picture, (ax,) = arrange([VIEWS["XY"]], low, high, shown, Foot(found.sentence), f"holes: {found.sentence}", size)
    handles = []
    for (_, shade, dash, wide), label, holes in zip(LOOKS, labels, every):
        if not len(holes):
            continue
        across = np.where(holes[:, 2] > 0, holes[:, 2], least)
        rings = EllipseCollection(
            across, across, np.zeros(len(across)), units="xy", offsets=holes[:, :2], offset_transform=ax.transData,
            facecolors="none", edgecolors=shade, linewidths=wide, linestyles=dash,
        )  # fmt: skip
        ax.add_collection(rings)
        ax.plot(holes[:, 0], holes[:, 1], "+", color=shade, markersize=5)
        handles.append(Line2D([], [], color=shade, linestyle=dash, linewidth=wide, label=label))
    write_legend(picture, handles)
    return picture
