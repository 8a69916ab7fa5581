"""What is on the paper: strokes, arrowheads and lines of text, in mm of the paper, and their boxes.

A box is a row (x, y, half length, half width, cos, sin): a rectangle about its middle, turned; a stroke is a box without
width. So texts, arrowheads and lines are tested against each other by one rule.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import Any, NamedTuple

import numpy as np

from mnclab.design.drawing.dimensions import Point
from mnclab.design.drawing.lettering import Block
from mnclab.design.drawing.view import Kind
from mnclab.geometry.contours import Contour
from mnclab.geometry.curves import Floats

ARROW = 3.0  # mm, with an angle of 15°
ARROW_HALF = ARROW * math.tan(math.radians(7.5))
GAP, OVERSHOOT = 1.0, 2.0  # of extension lines: from the edge, beyond the dimension line
ABOVE = 1.0  # mm from a dimension line to the baseline of its text
AIR = 0.5  # mm around a text, kept free of all else
NEAR, TIP = 0.2, 0.05  # mm by which lines, and arrowheads, may touch others at their ends

Box = tuple[float, float, float, float, float, float]


class Stroke(NamedTuple):
    """A line on the paper; `dashes` (mm) where they are not those of its kind."""

    contour: Contour
    kind: Kind
    layer: str
    dashes: tuple[float, ...] | None = None


class Arrow(NamedTuple):
    """An arrowhead: where it ends and whereto it points (rad)."""

    tip: Point
    angle: float

    @property
    def corners(self) -> Floats:
        """Tip and the two ends of its back, `(3, 2)`."""
        c, s = math.cos(self.angle), math.sin(self.angle)
        x, y = self.tip[0] - ARROW * c, self.tip[1] - ARROW * s
        return np.array([self.tip, (x - ARROW_HALF * s, y + ARROW_HALF * c), (x + ARROW_HALF * s, y - ARROW_HALF * c)])

    def box(self, less: float = 0.0) -> Box:
        c, s = math.cos(self.angle), math.sin(self.angle)
        middle = ARROW / 2
        return self.tip[0] - middle * c, self.tip[1] - middle * s, middle - less, ARROW_HALF, c, s


class Label(NamedTuple):
    """A line of text where it begins on its baseline, and its direction (rad)."""

    block: Block
    at: Point
    angle: float = 0.0

    def box(self, air: float = 0.0) -> Box:
        c, s = math.cos(self.angle), math.sin(self.angle)
        u, v = self.block.width / 2, (self.block.low + self.block.high) / 2
        x, y = self.at[0] + u * c - v * s, self.at[1] + u * s + v * c
        return x, y, u + air, (self.block.high - self.block.low) / 2 + air, c, s

    @property
    def text(self) -> str:
        return self.block.text


@dataclass
class Mark:
    """A dimension, a note or a cut with all its ink; `lines` are (part, from, to), see `placing` for the parts.

    `arc` is the dimension line of an angle; `places` are the points that a DXF dimension is defined by.
    """

    of: Any
    cost: float = 0.0
    lines: list[tuple[int, Point, Point]] = field(default_factory=list)
    arrows: list[Arrow] = field(default_factory=list)
    labels: list[Label] = field(default_factory=list)
    arc: Contour | None = None
    places: tuple[Point, ...] = ()


def line_box(a: Point, b: Point, less: float = 0.0, half: float = 0.0) -> Box:
    """A straight line as a box, shortened at both ends and widened to both sides."""
    dx, dy = b[0] - a[0], b[1] - a[1]
    length = math.hypot(dx, dy)
    c, s = (dx / length, dy / length) if length > 0 else (1.0, 0.0)
    return (a[0] + b[0]) / 2, (a[1] + b[1]) / 2, max(length / 2 - less, 0.0), half, c, s


def segment_boxes(segments: Floats, width: float = 0.0) -> Floats:
    """Straight lines `(n, 2, 2)` of a width as boxes `(n, 6)`."""
    way = segments[:, 1] - segments[:, 0]
    length = np.hypot(way[:, 0], way[:, 1])
    unit = way / np.maximum(length, 1e-12)[:, None]
    return np.column_stack([segments.mean(axis=1), length / 2, np.full(len(way), width / 2), unit])


def corners_of(boxes: Floats) -> Floats:
    """The corners `(n, 4, 2)` of boxes `(n, 6)`."""
    x, y, u, v, c, s = np.asarray(boxes, dtype=float).reshape(-1, 6).T
    along, across = np.stack([u * c, u * s], axis=1), np.stack([-v * s, v * c], axis=1)
    middle = np.stack([x, y], axis=1)
    signs = ((-1, -1), (1, -1), (1, 1), (-1, 1))
    return np.stack([middle + a * along + b * across for a, b in signs], axis=1)
