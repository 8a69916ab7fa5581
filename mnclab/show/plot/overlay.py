"""What is drawn over a path to show the idea behind its words: the centre of an arc, a mirror line, a hole at its diameter.

Each is a value that knows the room it needs, its lines and its texts; `plot_path` asks them in this order.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, Protocol

import numpy as np
from matplotlib.axes import Axes
from matplotlib.lines import Line2D

from mnclab.path.toolpath import Array
from mnclab.show.plot import colours
from mnclab.show.plot.colours import Line, Mark
from mnclab.show.plot.picture import View
from mnclab.show.plot.placing import write_beside

ROOM = 2.5  # what would make the greatest side of a picture longer than so many times is left out
SAMPLES = 16  # points of a stroke that a text keeps off


class Overlay(Protocol):
    """Drawn over the path in every view."""

    def box(self, low: Array, high: Array) -> tuple[Array, Array]:
        """The box (3,) and (3,) mm of the picture with what is drawn in it."""

    def names(self, views: Sequence[View]) -> list[str]:
        """What the legend names."""

    def draw(self, ax: Axes, view: View) -> list[Any]:
        """Add lines; those whose label the legend names are returned."""

    def write(self, ax: Axes, view: View, lines: Sequence[Array]) -> None:
        """Add texts, off the `lines` (m, 3); the limits of the axes are final."""


def across(view: View) -> int:
    """The coordinate along the line of sight."""
    return 3 - view.right - view.up


def grown(low: Array, high: Array, points: Array) -> tuple[Array, Array]:
    """A box with points (m, 3) in it, nan passed over."""
    for point in points:
        low, high = np.fmin(low, point), np.fmax(high, point)
    return low, high


def fits(low: Array, high: Array, points: Array) -> bool:
    """Whether points (m, 3) may be drawn without the picture becoming mostly empty."""
    wide_low, wide_high = grown(low, high, points)
    return bool((wide_high - wide_low).max() <= ROOM * max((high - low).max(), 1e-9))


def line(ax: Axes, view: View, points: Array, look: Line | Mark, **more: Any) -> Line2D:
    """Points (m, 3) as a line of one view."""
    found = Line2D(points[:, view.right], points[:, view.up], **{**look.style(), **more})
    ax.add_line(found)
    return found


def texts(
    ax: Axes, view: View, said: Sequence[str | Sequence[str]], places: Array, wishes: Array, lines: Sequence[Array],
    colour: str = colours.INK, mark: float = 0.0,
) -> int:  # fmt: skip
    """Write beside places (n, 3), best in the directions `wishes` (n, 2), off a mark of a radius in points; how many had no
    room is returned."""
    if not said:
        return 0
    axes = [view.right, view.up]
    choices = [(one,) if isinstance(one, str) else tuple(one) for one in said]
    drawn = [_dense(each[:, axes]) for each in lines if 1 < len(each) < 2000]
    figure = ax.get_figure(root=True)
    pixels = float(np.ptp(ax.transData.transform([(0.0, 0.0), (1.0, 0.0)])[:, 0]))  # of a mm
    radius = mark * (figure.dpi if figure else 72.0) / 72 / pixels
    return write_beside(ax, choices, places[:, axes], [radius] * len(places), wishes, drawn, colour)


def _dense(points: Array) -> Array:
    share = np.linspace(0, 1, SAMPLES, endpoint=False)[:, None, None]
    between = (points[:-1] + (points[1:] - points[:-1]) * share).reshape(-1, 2)
    return between[np.isfinite(between).all(axis=1)]
