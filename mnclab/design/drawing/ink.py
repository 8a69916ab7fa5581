"""What is on the paper: strokes, arrowheads, letters, hatching and the sign of the zero point, in mm of the paper.

A box is a row (x, y, half length, half width, cos, sin): a rectangle about its middle, turned; a stroke is a box without
width. So texts, arrowheads and lines are tested against each other by one rule.
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from functools import cache
from typing import Any, NamedTuple

import numpy as np
from matplotlib.font_manager import FontProperties
from matplotlib.textpath import text_to_path

from mnclab.design.drawing.view import Kind, Point, Value
from mnclab.geometry import shapely
from mnclab.geometry.contours import Contour
from mnclab.geometry.curves import Floats
from mnclab.geometry.regions import Region

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

    block: InkBlock
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


# Texts of a drawing: how wide they are, and how a value with its tolerance is set.
# The letters are DejaVu Sans, which matplotlib brings along, 3.5 mm high (the height of capitals, ISO 3098), tolerances one
# above the other and small texts 2.5 mm. Signs that this face lacks are drawn with strokes. All in mm; a text begins at
# (0, 0) on its baseline.

HEIGHT, SMALL = 3.5, 2.5
FACE = "DejaVu Sans"
CAPITAL = 1493 / 2048  # height of a capital of the face, in its size
DESCENT, ASCENT = 0.24, 1.08  # of the height: how far letters go below the baseline; brackets and signs above it
PITCH = 1.6  # of the height: from line to line
STACKED = 3.3  # mm, from the lower deviation to the upper one

SIGNS: dict[str, tuple[Contour, ...]] = {  # strokes in a square of 1, as high as a capital
    "\N{COUNTERBORE}": (Contour([(0.08, 0.85), (0.08, 0.05), (1.02, 0.05), (1.02, 0.85)], closed=False),),
    "\N{COUNTERSINK}": (Contour([(0.05, 0.9), (0.55, 0.05), (1.05, 0.9)], closed=False),),
    "\N{DOWNWARDS ARROW FROM BAR}": (
        Contour([(0.1, 1.0), (0.9, 1.0)], closed=False),
        Contour([(0.5, 1.0), (0.5, 0.02)], closed=False),
        Contour([(0.2, 0.4), (0.5, 0.02), (0.8, 0.4)], closed=False),
    ),
}
SIGN_WIDTH = 1.2  # with the room to the next letter
_RUNS = re.compile(f"([{''.join(SIGNS)}])")


class LetterRun(NamedTuple):
    """A run of letters or one drawn sign, at (x, y) from the start of its text."""

    text: str
    x: float
    y: float
    height: float

    @property
    def strokes(self) -> tuple[Contour, ...]:
        """The strokes of a sign that is drawn, in squares of the height; of letters there are none."""
        return SIGNS.get(self.text, ())


class InkBlock(NamedTuple):
    """One line of text as it is set: its pieces, and the box around them (`low` is below the baseline)."""

    pieces: tuple[LetterRun, ...]
    width: float
    low: float
    high: float

    @property
    def text(self) -> str:
        return "".join(piece.text for piece in self.pieces)


@cache
def width_of(text: str, height: float = HEIGHT) -> float:
    """How wide a run of letters is, mm."""
    size = FontProperties(family=FACE, size=100)
    return float(text_to_path.get_text_width_height_descent(text, size, ismath=False)[0]) * height / CAPITAL / 100


@cache
def block(text: str, height: float = HEIGHT) -> InkBlock:
    """A plain text as it is set."""
    pieces, x = [], 0.0
    for run in filter(None, _RUNS.split(text)):
        pieces.append(LetterRun(run, x, 0.0, height))
        x += SIGN_WIDTH * height if run in SIGNS else width_of(run, height)
    return InkBlock(tuple(pieces), x, -DESCENT * height, ASCENT * height)


@cache
def value_block(value: Value, height: float = HEIGHT) -> InkBlock:
    """A dimension's value: its text, its tolerance behind it, its deviations one above the other."""
    opening, closing = ("(", ")") if value.reference else ("", "")
    behind = f"\N{THIN SPACE}{value.tolerance}" if value.tolerance else ""
    if value.limits is None:
        return block(f"{opening}{value.text}{behind}{closing}", height)
    small = height * SMALL / HEIGHT
    first = block(f"{opening}{value.text}{behind}", height)
    middle, x = 0.5 * height, first.width + 0.35 * height
    centre = STACKED / HEIGHT * height / 2
    above = LetterRun(value.limits[0], x, middle + centre - small / 2, small)
    below = LetterRun(value.limits[1], x, middle - centre - small / 2, small)
    x += max(width_of(each, small) for each in value.limits)
    pieces = [*first.pieces, above, below]
    if closing:
        pieces.append(LetterRun(closing, x, 0.0, height))
        x += width_of(closing, height)
    low = min(first.low, below.y - DESCENT * small)
    return InkBlock(tuple(pieces), x, low, max(first.high, above.y + small))


CHORD = 0.02  # mm on paper
WIDE, CLOSE = 3.0, 1.2  # mm between the lines of a large face, of a small one
HATCH_AIR = 0.8  # mm around a text


def hatching(faces: Sequence[Region], scale: float, boxes: Floats) -> Floats:
    """Straight lines `(n, 2, 2)` on paper; they keep away from the boxes `(k, 6)` of texts."""
    rings = [loop.points_within(CHORD / scale) * scale for face in faces for loop in face.loops]
    if not rings:
        return np.zeros((0, 2, 2))
    area = shapely.Polygon()
    for ring in rings:  # a point within an odd number of loops is cut
        area = shapely.symmetric_difference(area, shapely.make_valid(shapely.Polygon(ring)))
    size = math.sqrt(abs(area.area))
    step = min(WIDE, max(CLOSE, size / 8))
    if len(boxes):
        texts = shapely.union_all([shapely.Polygon(corners) for corners in corners_of(boxes)])
        area = shapely.difference(area, shapely.buffer(texts, HATCH_AIR, join_style="mitre"))
    if area.is_empty:
        return np.zeros((0, 2, 2))
    x0, y0, x1, y1 = area.bounds
    # a line x - y = c for every multiple of the step: those of all views of a part fit each other
    pitch = step * math.sqrt(2)
    offsets = np.arange(math.ceil((x0 - y1) / pitch), math.floor((x1 - y0) / pitch) + 1) * pitch
    ends = np.stack([np.stack([offsets + y, np.full_like(offsets, y)], axis=-1) for y in (y0, y1)], axis=1)
    lines = shapely.intersection(shapely.linestrings(ends), area)
    parts = shapely.get_parts(shapely.get_parts(lines))
    parts = parts[shapely.get_type_id(parts) == 1]
    found = shapely.get_coordinates(parts).reshape(-1, 2, 2)
    return np.asarray(found[np.hypot(*(found[:, 1] - found[:, 0]).T) > 0.2])


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
