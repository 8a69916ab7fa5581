"""Areas side by side at one scale, such as the two sides of a set operation and what comes of it."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence

import numpy as np

from mnclab.geometry.regions import Region
from mnclab.show.plot import colours
from mnclab.show.plot.picture import SMALL, Picture
from mnclab.show.plot.sizes import sized
from mnclab.show.plot.strategy import area
from mnclab.show.plot.trials import side_by_side
from mnclab.text.alarm import Alarm
from mnclab.text.given import shown

MOST_COLUMNS = 4
TOP, GAP, BELOW = 0.06, 0.55, 0.45  # inches


@sized()
def plot_regions(
    regions: Mapping[str, Region], over: Sequence[Region] = (), width: float = 9.0, columns: int | None = None
) -> Picture:
    """One view of each named region with its area, all at one scale, each with the outlines of what is `over` it, dashed.

    `width` of the picture in inches.
    """
    if not isinstance(regions, Mapping) or not all(isinstance(one, Region) for one in regions.values()):
        raise Alarm(f"regions must be Regions by their names, got {shown(regions)}", hint='{"A": a, "B": b, "A | B": a.union(b)}')
    corners = [one.bounds for one in (*regions.values(), *over) if one.loops]
    if not regions or not corners:
        raise Alarm("there is nothing to draw: no region encloses anything")
    low, high = np.min([box[0] for box in corners], axis=0), np.max([box[1] for box in corners], axis=0)
    margin = 0.06 * float((high - low).max())
    names = [f"{name}: {one.area:.1f} mm²" for name, one in regions.items()]
    picture, axes = side_by_side(
        names, "XY", low - margin, high + margin, what="regions", columns=columns or _columns(len(regions)), width=width,
        top=TOP, gap=GAP, bottom=BELOW,
    )  # fmt: skip
    for ax, one in zip(axes, regions.values(), strict=True):
        area(ax, one, facecolor="#cfe0f1", edgecolor="none", zorder=1.0)
        for other in over:
            look = {"edgecolor": colours.PROGRAMMED.colour, "linestyle": (0, (4, 3)), "linewidth": 0.9}
            area(ax, other, facecolor="none", zorder=1.5, **look)
        area(ax, one, facecolor="none", edgecolor=colours.FEED.colour, linewidth=1.6, zorder=2.0)
        ax.tick_params(labelsize=SMALL)
    return picture


def _columns(count: int) -> int:
    """As few rows as four columns allow, filled as evenly as they can be."""
    rows = math.ceil(count / MOST_COLUMNS)
    return math.ceil(count / rows)
