"""The insert of a lathe tool in a view of z and r, with the holder behind it; their shapes are in `path.inserts`."""

from __future__ import annotations

from typing import Any

from matplotlib.patches import Patch, Polygon

from mnclab.path.inserts import holder, insert
from mnclab.path.tool import Tool
from mnclab.show.plot import colours

STEEL, CARBIDE = "#c9ccd1", "#e9c46a"
FINE = 0.01  # of the size of an insert: how far a chord of its nose may be off


def insert_patches(
    tool: Tool, tip: tuple[float, float], size: float, reach: float = 0.0, order: float = 4.4
) -> list[Patch]:
    """Holder and insert with the tip at a place (z, r); `order` of drawing: strokes have 2.5 to 3."""
    outline = insert(tool, size, reach).points_within(FINE * size)[:-1]
    look: dict[str, Any] = {"linewidth": 0.9, "joinstyle": "round", "zorder": order + 0.1}
    behind = holder(tool, size, reach)
    return [
        Polygon(behind + tip, facecolor=STEEL, edgecolor=colours.INK, linewidth=0.8, zorder=order),
        Polygon(outline + tip, facecolor=CARBIDE, edgecolor=colours.INK, **look),
    ]
