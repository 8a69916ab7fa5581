"""Where dimensions may stand: linear ones in rows beside the view, angles in arcs about their vertex, leaders to notes."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator
from itertools import accumulate, product
from typing import NamedTuple

import numpy as np

from mnclab.design.drawing.ink import (
    ABOVE,
    ARROW,
    ASCENT,
    GAP,
    HEIGHT,
    OVERSHOOT,
    PITCH,
    Arrow,
    InkBlock,
    Label,
    Mark,
    block,
    value_block,
)
from mnclab.design.drawing.placing import DIMENSION, EXTENSION, LEADER
from mnclab.design.drawing.view import Angle, Diameter, Dimension, Linear, Note, Point, Radius
from mnclab.geometry.contours import Contour
from mnclab.geometry.curves import Floats
from mnclab.text.alarm import Alarm
from mnclab.text.given import choice

# Linear dimensions: the sides of the view, rows away from it, and places of the text along the line.
# In the frame of a dimension u runs along it as its text is read, v to the left of that:
#
#         12,5 <- text above the line              v
#     |<------------->|   dimension line           |
#     |               |   extension lines          o--- u
#     a               b

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


def outside(mark: Mark, other: Mark, outline: Floats) -> bool:
    """Whether a dimension stands farther out than a longer one along the same axis that reaches over it; `outline` as below."""
    short, long = mark.of, other.of
    if not isinstance(short, Linear) or not isinstance(long, Linear) or short.along != long.along or short.along == "ab":
        return False
    k = "xy".index(short.along)
    (a, b), (c, d) = (sorted((each.a[k], each.b[k])) for each in (short, long))
    mine, its = (each.places[2][1 - k] - float(outline[:, 1 - k].mean()) for each in (mark, other))
    return c <= a and b <= d and b - a < d - c and mine * its > 0 and abs(mine) > abs(its)


def linear_places(dimension: Linear, scale: float, outline: Floats, room: int) -> Iterator[Mark]:
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
            yield _linear_mark(dimension, frame, text, sign, v, start, inside, cost + extra)


def _between(frame: Frame, share: float) -> float:
    return frame.left[1] + share * (frame.right[1] - frame.left[1])


def _sign(dimension: Linear, frame: Frame) -> int:
    """The side that is asked for: 1 to the left of u, -1 to the right, 0 where either will do."""
    if not dimension.side:
        return 0
    way = dimension.b[0] - dimension.a[0], dimension.b[1] - dimension.a[1]
    turned = dimension.along == "ab" and way[0] * frame.along[0] + way[1] * frame.along[1] < 0
    return SIDES[dimension.side] * (-1 if turned else 1)


def _texts(frame: Frame, text: InkBlock) -> Iterator[tuple[float, float, bool]]:
    """Costs, where the text begins (u), and whether the arrowheads stand inside."""
    left, right = frame.left[0], frame.right[0]
    length = right - left
    inside, slack = length >= NARROW, length - text.width - 2.0
    if slack >= 0:
        for slide in SLIDES if slack > 1 else SLIDES[:1]:
            yield 0.8 * abs(slide), (left + right - text.width) / 2 + slide * slack / 2, inside
    yield 1.5, right + OVERSHOOT, inside
    yield 1.7, left - OVERSHOOT - text.width, inside


def _linear_mark(
    dimension: Linear, frame: Frame, text: InkBlock, sign: int, v: float, start: float, inside: bool, cost: float
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


# Angles: arcs about the vertex, the text upright beside their middle.

RADII = (12.0, 16.0, 20.0, 25.0, 30.0, 36.0, 43.0, 50.0, 60.0, 70.0)
LONGER_RADII = (85.0, 100.0, 120.0)
TAIL = 8.0  # mm of arc behind an arrowhead that stands outside


def angle_places(angle: Angle, scale: float, room: int) -> Iterator[Mark]:
    """Marks in the order of their costs; with `room` the arcs may be larger."""
    x, y = angle.vertex[0] * scale, angle.vertex[1] * scale
    legs = [(p[0] * scale - x, p[1] * scale - y) for p in (angle.a, angle.b)]
    lengths = [math.hypot(*leg) for leg in legs]
    start, end = (math.atan2(leg[1], leg[0]) for leg in legs)
    sweep = (end - start) % math.tau
    if min(lengths) < 1e-9 or sweep < 1e-6:
        raise Alarm(f"the angle {angle.value.text} at {angle.vertex} has no opening from {angle.a} to {angle.b}")
    text, near = value_block(angle.value), angle.near * scale
    offers = []
    for radius in RADII + LONGER_RADII[: 2 * room]:
        beyond = sum(max(0.0, radius - length, near - radius) for length in lengths)
        inside = radius * sweep > 2 * ARROW + 3
        for share, out in ((0.5, 1), (0.3, 1), (0.7, 1), (0.5, -1), (-0.3, 1), (1.3, 1)):
            if inside or not 0 < share < 1:
                cost = 0.1 * radius + 0.1 * beyond + 3 * abs(share - 0.5) + (0.8 if out < 0 else 0.0)
                offers.append((cost, radius, share, out, inside))
            else:
                offers.append((0.1 * radius + 0.1 * beyond + 1.0, radius, share, out, inside))
    for cost, radius, share, out, inside in sorted(offers):
        tail = 0.0 if inside else TAIL / radius
        far = share * sweep if 0 < share < 1 else (-TAIL / radius if share < 0 else sweep + TAIL / radius)
        mark = Mark(angle, cost)
        at = start + far
        reach = radius + out * (ABOVE + abs(text.width / 2 * math.cos(at)) + abs(text.high / 2 * math.sin(at)) + 0.6)
        middle = x + reach * math.cos(at), y + reach * math.sin(at)
        mark.labels = [Label(text, (middle[0] - text.width / 2, middle[1] - (text.low + text.high) / 2))]
        mark.arc = _arc((x, y), radius, min(start - tail, at), max(start + sweep + tail, at))
        for place, sense in ((start, -1.0), (start + sweep, 1.0)):
            tip = x + radius * math.cos(place), y + radius * math.sin(place)
            # the back of the arrowhead lies on the arc: it leans by half of the angle that it takes up there
            lean = sense * (math.pi / 2 - ARROW / radius / 2) if inside else -sense * (math.pi / 2 - ARROW / radius / 2)
            mark.arrows.append(Arrow(tip, place + lean))
        for (dx, dy), length in zip(legs, lengths, strict=True):
            reaches = []
            if radius > length + GAP:
                reaches = [length + GAP, radius + OVERSHOOT]
            elif radius < near - GAP:
                reaches = [near - GAP, max(0.0, radius - OVERSHOOT)]
            if reaches:
                first, last = ((x + r * dx / length, y + r * dy / length) for r in reaches)
                mark.lines.append((EXTENSION, first, last))
        mark.places = ((x, y), *((x + dx, y + dy) for dx, dy in legs), (x + radius * math.cos(at), y + radius * math.sin(at)))
        yield mark


def _arc(centre: Point, radius: float, first: float, last: float) -> Contour:
    """An arc counter-clockwise, in two elements so that none is a full turn."""
    angles = [first, (first + last) / 2, last]
    bulge = math.tan((last - first) / 8)
    points = [(centre[0] + radius * math.cos(a), centre[1] + radius * math.sin(a)) for a in angles]
    return Contour(points, [bulge, bulge, 0.0], closed=False)


# Leaders: to a note, to the diameter of a circle, to the radius of an arc.
#
#         text of the first line
#        /----------------------   reference line, the other lines below
#       /
#     |<  arrow

Called = Diameter | Radius | Note
LENGTHS = (7.0, 10.0, 14.0, 19.0, 25.0, 32.0, 40.0, 50.0, 62.0)
LONGER_LEADERS = (75.0, 90.0, 110.0, 130.0)  # where there was no room nearer
ACROSS = 26.0  # mm on paper: a larger circle may have its dimension line across
STEPS = 24  # directions of a full turn


class Tip(NamedTuple):
    """Where an arrow may end, in which direction its leader goes away (rad), what that costs, how long it may be."""

    at: Point
    angle: float
    cost: float


def texts_of(called: Called) -> list[InkBlock]:
    """The lines of text."""
    if isinstance(called, Note):
        return [block(line) for line in called.lines]
    return [value_block(called.value), *(block(line) for line in called.more)]


def leader_places(called: Called, scale: float, room: int) -> Iterator[Mark]:
    """Marks in the order of their costs; with `room` the leaders may be longer."""
    texts = texts_of(called)
    lengths = LENGTHS + LONGER_LEADERS[: 2 * room]
    offers = [
        (tip.cost + 0.16 * length, tip, length, right)
        for tip, length in product(_tips(called, scale), lengths)
        for right in ((True, False) if abs(math.cos(tip.angle)) < 0.2 else (math.cos(tip.angle) > 0,))
    ]
    across = list(_across(called, scale, texts)) if isinstance(called, Diameter) else []
    yield from sorted(across, key=lambda mark: mark.cost)
    for cost, tip, length, right in sorted(offers, key=lambda offer: offer[0]):
        yield _leader_mark(called, texts, tip, length, right, cost)


def _tips(called: Called, scale: float) -> Iterator[Tip]:
    centre = called.at if isinstance(called, Note) else called.centre
    x, y, radius = centre[0] * scale, centre[1] * scale, called.radius * scale
    if isinstance(called, Radius):
        for share in (0.5, 0.3, 0.7, 0.15, 0.85):
            angle = called.start + share * called.sweep
            at = x + radius * math.cos(angle), y + radius * math.sin(angle)
            cost = 2.0 * abs(share - 0.5)
            yield Tip(at, angle, cost + _slope(angle))
            yield Tip(at, angle + math.pi, cost + _slope(angle) + 0.3)
        return
    for k in range(STEPS):
        angle = (k + 0.5) * math.tau / STEPS if radius == 0 else k * math.tau / STEPS
        yield Tip((x + radius * math.cos(angle), y + radius * math.sin(angle)), angle, _slope(angle))


def _slope(angle: float) -> float:
    """Leaders are neither level nor upright, least of all along an axis: 45° to 60° is best."""
    steep = math.degrees(math.asin(min(1.0, abs(math.sin(angle)))))
    return 0.06 * abs(steep - 52.0)


def _leader_mark(called: Called, texts: list[InkBlock], tip: Tip, length: float, right: bool, cost: float) -> Mark:
    knee = tip.at[0] + length * math.cos(tip.angle), tip.at[1] + length * math.sin(tip.angle)
    width = max(text.width for text in texts) + 1.0
    end = knee[0] + (width if right else -width), knee[1]
    start = min(knee[0], end[0]) + 0.5
    mark = Mark(called, cost, [(LEADER, tip.at, knee), (LEADER, knee, end)])
    mark.arrows = [Arrow(tip.at, tip.angle + math.pi)]
    lift = ABOVE - min(0.0, texts[0].low + 0.9)
    mark.labels = [Label(texts[0], (start, knee[1] + lift))]
    y = knee[1] - 1.2 - ASCENT * HEIGHT
    for text in texts[1:]:
        mark.labels.append(Label(text, (start, y)))
        y -= PITCH * HEIGHT
    mark.places = (tip.at, knee)
    return mark


def _across(called: Diameter, scale: float, texts: list[InkBlock]) -> Iterator[Mark]:
    """The dimension line through the centre of a large circle, its text along it."""
    radius, text = called.radius * scale, texts[0]
    if 2 * radius < max(ACROSS, text.width + 2 * ARROW + 4) or len(texts) > 1:
        return
    x, y = called.centre[0] * scale, called.centre[1] * scale
    for degrees, share in product((45, -45, 30, -30, 60, -60, 15, -15, 75, -75), (0.5, -0.5, 0.3, -0.3, 0.75, -0.75)):
        angle = math.radians(degrees)
        c, s = math.cos(angle), math.sin(angle)
        first, last = (x - radius * c, y - radius * s), (x + radius * c, y + radius * s)
        u = share * (radius - ARROW) - text.width / 2
        if u < -radius + ARROW or u + text.width > radius - ARROW:
            continue
        mark = Mark(called, 1.0 + 0.06 * abs(abs(degrees) - 45) + abs(share), [(DIMENSION, first, last)])
        mark.arrows = [Arrow(first, angle + math.pi), Arrow(last, angle)]
        lift = ABOVE - min(0.0, text.low + 0.9)
        mark.labels = [Label(text, (x + u * c - lift * s, y + u * s + lift * c), angle)]
        mark.places = (first, last)
        yield mark
