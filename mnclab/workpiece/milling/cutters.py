"""The lower side of a mill, turned about its axis: a flat disc, then a round corner or a cone, up to its radius.

The height of the edge above the tip at a distance rho from the axis is 0 up to `flat`, from there
`corner - sqrt(corner² - (rho - flat)²)` or `slope (rho - flat)`. A ball has `flat` 0, a drill its point's slope.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from mnclab.path.tool import POINTED, Tool
from mnclab.path.toolpath import Array


class Cutter(NamedTuple):
    """Lengths in mm; `slope` is the rise of the cone for each mm outwards."""

    radius: float
    flat: float
    corner: float = 0.0
    slope: float = 0.0


def cutter_of(tool: Tool) -> Cutter:
    """The lower side of a tool as its table gives it; one without radius has none."""
    radius = max(tool.effective_radius, 0.0)
    if tool.kind in POINTED:
        half = math.radians(min(tool.angle or POINTED[tool.kind], 180.0)) / 2
        return Cutter(radius, 0.0, 0.0, max(math.cos(half) / math.sin(half), 0.0))
    corner = min(tool.corner, radius)
    return Cutter(radius, radius - corner, corner)


def edge_height(rho: Array, flat: Array | float, corner: Array | float, slope: Array | float) -> Array:
    """Height of the edge above the tip at distances from the axis; all of them broadcast."""
    out = np.maximum(rho - flat, 0.0)
    return np.asarray(corner - np.sqrt(np.maximum(corner * corner - out * out, 0.0)) + slope * out)
