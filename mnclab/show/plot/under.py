"""The part under a path: pale, so that the path stays what one looks at."""

from __future__ import annotations

from typing import TYPE_CHECKING, cast

import numpy as np
from matplotlib.axes import Axes
from matplotlib.patches import Polygon

from mnclab.show.plot.picture import View
from mnclab.show.plot.relief import relief
from mnclab.workpiece.workpiece import Workpiece

if TYPE_CHECKING:
    from mnclab.workpiece.milling.milled import Milled
    from mnclab.workpiece.turning.turned import Turned

FACE, EDGE = "#d9d5c8", "#7d7664"
PALE = 0.62  # of white in what lies under a path


def draw_under(ax: Axes, view: View, workpiece: Workpiece) -> None:
    """The part in one view: from above in light and shadow, from the side its outline, of a lathe its half section."""
    if view.diameter:
        from mnclab.show.plot.turned import draw_half

        draw_half(ax, cast("Turned", workpiece))
        return
    part = cast("Milled", workpiece)
    if 2 in (view.right, view.up):
        _silhouette(ax, part, view)
        return
    from mnclab.show.plot.part import DEPTHS, draw_relief

    seen = relief(part)
    depth = float(part.cutting.stock.bounds[1, 2]) - seen.z
    shades = DEPTHS(0.75 * depth / max(float(depth[seen.solid].max(initial=0.0)), 1e-9))[..., :3] * seen.light[..., None]
    image = np.clip(PALE + (1 - PALE) * shades, 0.0, 1.0)
    draw_relief(ax, seen, np.concatenate([image, seen.solid[..., None]], axis=2), order=0.6)


def _silhouette(ax: Axes, part: Milled, view: View) -> None:
    """How high the part reaches behind each place that goes to the right, over the lower side of the blank."""
    along = 1 - view.right  # the axis of the map that one looks along: rows are Y, columns X
    places = (part.x, part.y)[view.right]
    axis = 0 if along == 1 else 1
    heights, floor = part.heights.max(axis=axis), part.floor.min(axis=axis)
    ends = part.cutting.stock.bounds[:, view.right]
    places = np.clip(np.repeat(places, 2) + np.tile([-0.5, 0.5], len(places)) * part.step, *ends)
    outline = np.concatenate([
        np.stack([places, np.repeat(heights, 2)], axis=1), np.stack([places, np.repeat(floor, 2)], axis=1)[::-1],
    ])  # fmt: skip
    ax.add_patch(Polygon(outline, facecolor=FACE, edgecolor=EDGE, linewidth=0.9, zorder=0.8, label="_part"))
