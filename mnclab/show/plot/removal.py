"""Removal over time as a picture: the feed, and under it how much material is taken away a minute."""

from __future__ import annotations

from typing import Any

import numpy as np
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from mnclab.show.plot import colours
from mnclab.show.plot.picture import SMALL, Picture, calm
from mnclab.show.plot.profile import plot_profile
from mnclab.show.plot.sizes import sized

SIZE = (7.0, 4.6)  # inches
SHADE = 0.28  # of the area under the rate
FAST = 2.5  # times the largest rate at feed, beyond which what rapids take away is cut off
CARD = {"facecolor": colours.PAPER, "edgecolor": "none", "pad": 1.5, "alpha": 0.85}


@sized()
def plot_removal(removal: Any, *, size: tuple[float, float] = SIZE) -> Figure:
    """Feed (in the unit of the program) and removal rate (mm³/min or in³/min, the mean of each row) over time (s), the
    largest at feed marked with its line.

    `size`: width and height in inches.
    """
    most = removal.largest
    unit, rates = removal.workpiece.cutting.path.unit, removal.rate
    size_of, name, form = (1.0, "mm³", ".0f") if unit.length == 1 else (unit.length**3, "in³", ".3g")
    largest = f"{removal.at_most} {most.rate / size_of:{form}} {name}/min" if most else ""
    said = f"removal: {removal.volume / size_of:{'.1f' if name == 'mm³' else form}} {name} in {removal.profile.time:.4g} s"
    picture = Picture(size, f"{said}, {largest} in line {removal.place(most)}" if most else said)
    width, height = size
    grid = picture.add_gridspec(
        2, 1, left=0.85 / width, right=1 - 0.15 / width, bottom=0.5 / height, top=1 - 0.12 / height, hspace=0.12
    )
    feed = picture.add_subplot(grid[0, 0])
    rate = picture.add_subplot(grid[1, 0], sharex=feed)
    plot_profile(removal.profile, feed, limits=False)
    begin, end = removal.profile.starts[:-1][: len(rates)], removal.profile.starts[1:][: len(rates)]
    t, height_of = np.stack([begin, end], axis=1).ravel(), np.repeat(rates / size_of, 2)
    rate.fill_between(t, height_of, color=colours.REACHED.colour, alpha=SHADE, linewidth=0)
    rate.plot(t, height_of, color=colours.REACHED.colour, linewidth=1.2)
    high = most.rate / size_of if most else 0.0
    top = 1.25 * max(float(rates.max(initial=0.0)) / size_of, high) or 1.0
    rate.set_ylim(0, top)
    if most and top > FAST * high:  # a rapid in material takes away in no time
        rate.set_ylim(0, 1.25 * high)
        rate.text(
            0.995, 0.96, f"cut off: rapids reach {rates.max() / size_of:{form}} {name}/min", transform=rate.transAxes, ha="right",
            va="top", fontsize=SMALL - 1, color=colours.RAPID.colour, bbox=CARD, zorder=5,
        )  # fmt: skip
    if most:
        middle = (begin[most.row] + end[most.row]) / 2
        rate.plot([middle], [high], **colours.SLOW_CORNER.style())
        late = middle > removal.profile.time / 2
        rate.annotate(
            f"line {removal.place(most)}: {largest}", (middle, high), (-6 if late else 6, 5), textcoords="offset points",
            fontsize=SMALL, ha="right" if late else "left", color=colours.INK,
        )  # fmt: skip
    rate.set_ylabel(f"mean of a row, {name}/min", fontsize=SMALL)
    for axes in (feed, rate):
        axes.yaxis.set_major_locator(MaxNLocator(nbins=5, steps=[1, 2, 5, 10]))
        calm(axes)
    feed.set_xlabel("")
    feed.tick_params(labelbottom=False)
    rate.set_xlabel("time, s", fontsize=SMALL + 1)
    picture.align_ylabels([feed, rate])
    return picture
