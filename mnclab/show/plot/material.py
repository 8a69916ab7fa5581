"""The part that a probe meets, as a section behind a picture: pale, so that what is measured stays what one looks at."""

from __future__ import annotations

from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import PathCollection
from matplotlib.transforms import Affine2D

from mnclab.geometry.frames import apply, inverse
from mnclab.path.columns import Array
from mnclab.show.felt import Sections
from mnclab.show.plot.picture import View
from mnclab.show.plot.strategy import outline
from mnclab.workpiece.part import Part
from mnclab.workpiece.part.pictures import UPRIGHT
from mnclab.workpiece.part.prisms import Prisms

CELLS = 160  # along the longer side of a section
FACE: dict[str, Any] = {"facecolor": "#e9e5da", "edgecolor": "#8c8778", "linewidth": 0.7}


def draw_material(ax: Axes, part: Part, view: View, frame: Array, level: float) -> None:
    """What the plane of a view cuts of a part, within the limits of the axes.

    From above upright prisms are exact; what a program has cut is shown from above only. The view lies in coordinates that a
    `frame` (4, 4) leads to those of the part, at a `level` mm along the line of sight.
    """
    if (view.right, view.up) == (0, 1) and _sliced(part, frame):
        if loops := part.section(level + float(frame[2, 3])):
            shape = outline(loops).transformed(Affine2D(inverse(frame)[[0, 1, 3]][:, [0, 1, 3]]))
            look: dict[str, Any] = {"facecolor": "none", "edgecolor": "none", "linewidth": FACE["linewidth"]}
            for name, order in (("facecolor", 0.6), ("edgecolor", 0.7)):
                ax.add_collection(PathCollection([shape], **look | {name: FACE[name]}, zorder=order), autolim=False)
        return
    if isinstance(part.distance, Sections):
        return
    (left, right), (below, above) = ax.get_xlim(), ax.get_ylim()
    step = max(right - left, above - below) / CELLS
    across, up = (np.linspace(a, b, max(2, round((b - a) / step) + 1)) for a, b in ((left, right), (below, above)))
    places = np.full((len(up), len(across), 3), float(level))
    places[..., view.right], places[..., view.up] = across, up[:, None]
    off = part(apply(frame, places).reshape(-1, 3)).reshape(places.shape[:2])
    if not (off < 0).any():
        return
    ax.contourf(across, up, off, [-np.inf, 0.0], colors=[FACE["facecolor"]], zorder=0.6)
    if (off > 0).any():
        ax.contour(across, up, off, [0.0], colors=[FACE["edgecolor"]], linewidths=FACE["linewidth"], zorder=0.7)


def _sliced(part: Part, frame: Array) -> bool:
    """Whether a part knows its level sections, and those of a frame are level."""
    own = part.distance
    known = (isinstance(own, Prisms) and not own.taper and abs(abs(own.placing[2, 2]) - 1) < UPRIGHT) or isinstance(own, Sections)
    return bool(known and np.abs(frame[2] - (0, 0, 1, frame[2, 3])).max() < UPRIGHT)
