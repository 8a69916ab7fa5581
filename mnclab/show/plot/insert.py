"""The insert of a lathe tool in a view of z and r, with the holder behind it; their shapes are in `path.inserts`.

Both are like glass: what the insert has cut, and the material beside it, is seen through them.
"""

from __future__ import annotations

from typing import Any

from matplotlib.colors import to_rgba
from matplotlib.patches import Patch, Polygon

from mnclab.path.inserts import holder, insert
from mnclab.path.tool import Tool
from mnclab.show.plot import colours

STEEL, CARBIDE = "#c9ccd1", "#e9c46a"  # as in `player/page.css`
GLASS, CLEAR = 0.5, 0.35  # how much of an insert and of a holder is there
INSERT: dict[str, Any] = {"facecolor": to_rgba(CARBIDE, GLASS), "edgecolor": colours.INK}
HOLDER: dict[str, Any] = {"facecolor": to_rgba(STEEL, CLEAR), "edgecolor": "#7c828a"}
FINE = 0.01  # of the size of an insert: how far a chord of its nose may be off


def insert_patches(
    tool: Tool, tip: tuple[float, float], size: float, reach: float = 0.0, order: float = 4.4
) -> list[Patch]:
    """Holder and insert with the tip at a place (z, r); `order` of drawing: strokes have 2.5 to 3."""
    outline = insert(tool, size, reach).points_within(FINE * size)[:-1]
    return [
        Polygon(holder(tool, size, reach) + tip, **HOLDER, linewidth=0.7, zorder=order),
        Polygon(outline + tip, **INSERT, linewidth=0.9, joinstyle="round", zorder=order + 0.1),
    ]


def named_insert() -> Patch:
    """What a legend shows of it."""
    return Patch(**INSERT, linewidth=0.9, label="insert")
