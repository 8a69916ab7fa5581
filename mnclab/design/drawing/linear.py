"""Where a linear dimension may stand: the sides of the view, rows away from it, and places of its text along the line.

In the frame of a dimension u runs along it as its text is read, v to the left of that:

        12,5 <- text above the line              v
    |<------------->|   dimension line           |
    |               |   extension lines          o--- u
    a               b
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator
from itertools import accumulate
from typing import NamedTuple

import numpy as np

from mnclab.design.drawing.dimensions import Dimension, Linear, Point
from mnclab.design.drawing.ink import ABOVE, ARROW, GAP, OVERSHOOT, Arrow, Label, Mark
from mnclab.design.drawing.lettering import Block, value_block
from mnclab.design.drawing.placing import DIMENSION, EXTENSION
from mnclab.geometry.curves import Floats
from mnclab.text.alarm import Alarm
from mnclab.text.given import choice

FIRST, ROW = 10.0, 7.0  # mm from the view to the first row, from row to row
ROWS = 14
NARROW = 2 * ARROW + 3.0  # a shorter dimension has its arrowheads outside
STUB = ARROW + 3.0  # the line behind an arrowhead that stands outside
SLIDES = (0.0, 0.5, -0.5, 0.25, -0.25, 0.75, -0.75, 1.0, -1.0)  # of the room to slide, from the middle
INSIDE, SHARES = 4.0, (0.5, 0.35, 0.65, 0.2, 0.8)  # the cost of a line between the points, and where it may be
SIDES = {"above": 1, "left": 1, "below": -1, "right": -1}
ALONG = {"x": ("above", "below"), "y": ("left", "right"), "ab": ("left", "right")}


class Frame(NamedTuple):
    """Axes u and v of a dimension, and its ends in them, u from left to right."""

    angle: float
    along: Point
    across: Point
    left: Point
    right: Point

    def place(self, u: float, v: float) -> Point:
        (c, s), (d, t) = self.along, self.across
        return u * c + v * d, u * s + v * t


def frame_of(dimension: Linear, scale: float) -> Frame:
    """The frame of a dimension on paper; an Alarm where it has no length or no such direction."""
    along = choice(dimension.along, "along", ALONG)
    if dimension.side:
        choice(dimension.side, f"side along {along}", ALONG[along])
    (ax, ay), (bx, by) = dimension.a, dimension.b
    angle = {"x": 0.0, "y": math.pi / 2, "ab": math.atan2(by - ay, bx - ax)}[along]
    if not -math.pi / 2 + 1e-9 < angle <= math.pi / 2 + 1e-9:
        angle -= math.copysign(math.pi, angle)
    c, s = {"x": (1.0, 0.0), "y": (0.0, 1.0), "ab": (math.cos(angle), math.sin(angle))}[along]
    ends = sorted((scale * (x * c + y * s), scale * (y * c - x * s)) for x, y in (dimension.a, dimension.b))
    if ends[1][0] - ends[0][0] < 1e-6 * scale:
        raise Alarm(f"the dimension {dimension.value.text} from {dimension.a} to {dimension.b} has no length along {along}")
    return Frame(angle, (c, s), (-s, c), *ends)


def length_of(dimension: Linear, scale: float) -> float:
    """How long a dimension is on paper, mm."""
    frame = frame_of(dimension, scale)
    return frame.right[0] - frame.left[0]


def room_for(dimensions: Iterable[Dimension], along: str) -> float:
    """The room (mm on paper) that dimensions along x or y take at least, above and below the view or beside it: as many
    rows as there are dimensions over one place."""
    k = "xy".index(along)
    ends = []
    for each in dimensions:
        if isinstance(each, Linear) and each.along == along and not each.inside:
            first, last = sorted((each.a[k], each.b[k]))
            ends += [(first, 1), (last, -1)]
    rows = max(accumulate(step for _, step in sorted(ends)), default=0)
    return min(rows, 2) * FIRST + max(rows - 2, 0) * ROW


def places(dimension: Linear, scale: float, outline: Floats, room: int) -> Iterator[Mark]:
    """Marks in the order of their costs; `outline` (2, 2) are the bounds of the view on paper, `room` more rows than usual."""
    frame, text = frame_of(dimension, scale), value_block(dimension.value)
    corners = np.array([(x, y) for x in outline[:, 0] for y in outline[:, 1]])
    reach = corners @ np.array(frame.across)
    if dimension.along == "ab":
        reach = np.array([frame.left[1], frame.right[1]])
    middle = (frame.left[1] + frame.right[1]) / 2
    beside = []
    for sign, edge in ((1, float(reach.max())), (-1, float(reach.min()))):
        asked = _sign(dimension, frame)
        cost = 0.12 * abs(edge - middle) + (15.0 if asked and asked != sign else 0.0)
        beside.append((sign, edge, cost))
    offers = [
        (cost + 2.5 * row, sign, edge + sign * (FIRST + ROW * row))
        for sign, edge, cost in beside
        for row in range(ROWS + room)
    ]
    if dimension.inside:
        offers += [(INSIDE + abs(share - 0.5), 0, _between(frame, share)) for share in SHARES]
    for cost, sign, v in sorted(offers, key=lambda offer: offer[0]):
        for extra, start, inside in _texts(frame, text):
            yield _mark(dimension, frame, text, sign, v, start, inside, cost + extra)


def _between(frame: Frame, share: float) -> float:
    return frame.left[1] + share * (frame.right[1] - frame.left[1])


def _sign(dimension: Linear, frame: Frame) -> int:
    """The side that is asked for: 1 to the left of u, -1 to the right, 0 where either will do."""
    if not dimension.side:
        return 0
    way = dimension.b[0] - dimension.a[0], dimension.b[1] - dimension.a[1]
    turned = dimension.along == "ab" and way[0] * frame.along[0] + way[1] * frame.along[1] < 0
    return SIDES[dimension.side] * (-1 if turned else 1)


def _texts(frame: Frame, text: Block) -> Iterator[tuple[float, float, bool]]:
    """Costs, where the text begins (u), and whether the arrowheads stand inside."""
    left, right = frame.left[0], frame.right[0]
    length = right - left
    inside, slack = length >= NARROW, length - text.width - 2.0
    if slack >= 0:
        for slide in SLIDES if slack > 1 else SLIDES[:1]:
            yield 0.8 * abs(slide), (left + right - text.width) / 2 + slide * slack / 2, inside
    yield 1.5, right + OVERSHOOT, inside
    yield 1.7, left - OVERSHOOT - text.width, inside


def _mark(
    dimension: Linear, frame: Frame, text: Block, sign: int, v: float, start: float, inside: bool, cost: float
) -> Mark:
    left, right = frame.left[0], frame.right[0]
    begin, end = (left, right) if inside else (left - STUB, right + STUB)
    begin, end = min(begin, start if start < left else begin), max(end, start + text.width if start >= right else end)
    mark = Mark(dimension, cost, [(DIMENSION, frame.place(begin, v), frame.place(end, v))])
    turn = 0.0 if inside else math.pi
    mark.arrows = [
        Arrow(frame.place(left, v), frame.angle + math.pi + turn),
        Arrow(frame.place(right, v), frame.angle + turn),
    ]
    for u, edge in (frame.left, frame.right) if sign else ():
        away = sign if sign * (v - edge) > GAP else -sign  # where the line passes between the points it looks back
        if abs(v - edge) > GAP:
            mark.lines.append((EXTENSION, frame.place(u, edge + away * GAP), frame.place(u, v + away * OVERSHOOT)))
    mark.labels = [Label(text, frame.place(start, v + ABOVE - min(0.0, text.low + 0.9)), frame.angle)]
    mark.places = (frame.place(*frame.left), frame.place(*frame.right), frame.place(right, v))
    return mark
