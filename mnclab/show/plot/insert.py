"""The insert of a lathe tool in a view of z and r: its tip, its edges at their angles, the holder behind it.

The main edge leans from the axis by the main angle, the other one by the auxiliary angle, as Tool has them; between them
lies the insert, a rhombus (95 and 30 degrees: one of 55). A grooving tool is a blade of its width, its tip on the left.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from matplotlib.patches import Patch, Polygon
from numpy.typing import NDArray

from mnclab.path.tool import Tool
from mnclab.show.plot import colours

USUAL = (95.0, 5.0)  # degrees: an insert of 80 degrees, where the table gives no angles
STEEL, CARBIDE = "#c9ccd1", "#e9c46a"


def insert_outline(tool: Tool, size: float, reach: float = 0.0) -> NDArray[np.float64]:
    """The insert about its tip, (k, 2) as (z, r); `size` is the length of its edges, `reach` the least one of a blade."""
    if tool.width:
        high = max(1.6 * size, min(1.5 * tool.width, 2.4 * size), reach)
        return np.array([(0.0, 0.0), (tool.width, 0.0), (tool.width, high), (0.0, high)])
    auxiliary = tool.auxiliary_angle or min(USUAL[1], (180 - tool.main_angle) / 2)
    main = tool.main_angle or min(USUAL[0], 0.9 * (180 - auxiliary))
    main, auxiliary = math.radians(main), math.radians(auxiliary)
    lead = size * np.array([-math.cos(main), math.sin(main)])
    trail = size * np.array([math.cos(auxiliary), math.sin(auxiliary)])
    return np.array([(0.0, 0.0), trail, lead + trail, lead])


def insert_patches(
    tool: Tool, tip: tuple[float, float], size: float, reach: float = 0.0, order: float = 4.4
) -> list[Patch]:
    """Holder and insert with the tip at a place (z, r); `order` of drawing: strokes have 2.5 to 3."""
    outline = insert_outline(tool, size, reach) + np.array(tip)
    middle = outline.mean(axis=0)
    if tool.width:
        right, left = outline[2], outline[3]
        steps = [left, right, right + (0.7 * size, 0.3 * size), right + (0.7 * size, size), left + (0.0, size)]
        holder = np.array(steps)
    else:
        holder = middle + size * np.array([(-0.25, 0.0), (0.55, 0.0), (0.55, 1.5), (-0.25, 1.5)])
    look: dict[str, Any] = {"linewidth": 0.9, "joinstyle": "round", "zorder": order + 0.1}
    return [
        Polygon(holder, facecolor=STEEL, edgecolor=colours.INK, linewidth=0.8, zorder=order),
        Polygon(outline, facecolor=CARBIDE, edgecolor=colours.INK, **look),
    ]
