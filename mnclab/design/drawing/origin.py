"""The sign of a workpiece's zero point: a circle with two filled quarters, as control panels and set-up sheets have it."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np

from mnclab.design.drawing.dimensions import Point
from mnclab.design.drawing.ink import Stroke
from mnclab.design.drawing.view import Kind
from mnclab.geometry.contours import Contour

RADIUS = 2.0  # mm on paper
LINES = 0.2  # mm from line to line in a filled quarter: less than a thin line is wide


def origin(at: Point) -> Iterator[Stroke]:
    """The strokes of the sign about a point of the paper."""
    yield Stroke(Contour.circle(at, RADIUS), Kind.THIN, "CENTRE")
    for turn in (0.0, math.pi):
        c, s = math.cos(turn), math.sin(turn)
        points = []
        for k, y in enumerate(np.arange(0.0, RADIUS, LINES).tolist()):
            ends = [(0.0, y), (math.sqrt(RADIUS**2 - y * y), y)]
            points += ends if k % 2 else ends[::-1]
        turned = [(at[0] + c * x - s * y, at[1] + s * x + c * y) for x, y in points]
        yield Stroke(Contour(turned, closed=False), Kind.THIN, "CENTRE")
