"""Plain contours of lines and arcs, for generate_compensation.py: points in ticks, all arcs exact.

An arc is exact when its start and end are whole ticks and lie at just the same distance from its centre. Here
both are multiples of whole vectors of length 325 (36-323, 80-315, 91-312 ...; there are sixty), so tangents
of arcs have these directions too and a tangential join can be written without rounding.
"""

import math
from typing import NamedTuple

from recording import TICKS

UNIT = 325
VECTORS = [(a, b) for a in range(-UNIT, UNIT + 1) for b in range(-UNIT, UNIT + 1) if a * a + b * b == UNIT * UNIT]


class Element(NamedTuple):
    """A line, or an arc with its centre and turn: +1 counter-clockwise, -1 clockwise.

    An element that only leads to the workpiece or away from it is no wall: the tool may cut through it.
    """

    start: tuple
    end: tuple
    centre: tuple | None = None
    turn: int = 0
    wall: bool = True

    @property
    def radius(self):
        """Radius of an arc in mm."""
        return math.dist(self.start, self.centre) / TICKS

    @property
    def sweep(self):
        """Angle of an arc in rad, positive."""
        start, end = (math.atan2(p[1] - self.centre[1], p[0] - self.centre[0]) for p in (self.start, self.end))
        return self.turn * (end - start) % math.tau

    def tangent(self, share):
        """Unit vector of travel after a share (0 to 1) of the element."""
        if not self.turn:
            return unit(self.end[0] - self.start[0], self.end[1] - self.start[1])
        x, y = unit(self.start[0] - self.centre[0], self.start[1] - self.centre[1])
        angle = self.turn * self.sweep * share
        cos, sin = math.cos(angle), math.sin(angle)
        return -self.turn * (x * sin + y * cos), self.turn * (x * cos - y * sin)

    def point(self, share):
        """Point in mm after a share of the element."""
        if not self.turn:
            return tuple((a + (b - a) * share) / TICKS for a, b in zip(self.start, self.end, strict=True))
        x, y = self.tangent(share)
        outward = self.turn * self.radius
        return self.centre[0] / TICKS + outward * y, self.centre[1] / TICKS - outward * x

    def offset(self, share, radius, side):
        """Where a tool of `radius` stands that touches the element there; side +1 is left, -1 right."""
        (x, y), (tx, ty) = self.point(share), self.tangent(share)
        return x - side * radius * ty, y + side * radius * tx

    def distance(self, point):
        """Distance in mm of a point from the element."""
        ends = min(math.dist(point, self.point(0)), math.dist(point, self.point(1)))
        if not self.turn:
            (x, y), (tx, ty) = self.point(0), self.tangent(0)
            along = (point[0] - x) * tx + (point[1] - y) * ty
            if not 0 <= along * TICKS <= math.dist(self.start, self.end):
                return ends
            return abs((point[1] - y) * tx - (point[0] - x) * ty)
        cx, cy = self.centre[0] / TICKS, self.centre[1] / TICKS
        angle = math.atan2(point[1] - cy, point[0] - cx)
        first = math.atan2(self.start[1] - self.centre[1], self.start[0] - self.centre[0])
        if self.turn * (angle - first) % math.tau > self.sweep:
            return ends
        return abs(math.dist(point, (cx, cy)) - self.radius)


def unit(x, y):
    length = math.hypot(x, y)
    return x / length, y / length


def turned(vector):
    """The vector turned by +90 degrees."""
    return -vector[1], vector[0]


def moved(point, vector, times=1):
    return point[0] + times * vector[0], point[1] + times * vector[1]


def angle_between(a, b):
    """Angle in rad from one vector to another, positive to the left."""
    return math.atan2(a[0] * b[1] - a[1] * b[0], a[0] * b[0] + a[1] * b[1])


def corner(before, after):
    """Turn of the contour between two elements in rad, positive to the left; exactly 0 if tangential."""
    turn = angle_between(before.tangent(1), after.tangent(0))
    return 0.0 if abs(turn) < 1e-9 else turn


def clearance(point, contour):
    return min(element.distance(point) for element in contour if element.wall)


def shares(count=60):
    return [step / count for step in range(count + 1)]


def unreachable(element, contour, radius, side):
    """Whether a tool that touches the element anywhere would always cut into the contour."""
    return all(clearance(element.offset(t, radius, side), contour) < radius - 1e-6 for t in shares())


def apart(before, arc, radius, side):
    """Whether the equidistant of an inside arc never meets that of the line or inside arc before it."""
    tool = arc.radius - radius
    if before.turn:
        return math.dist(before.centre, arc.centre) / TICKS > before.radius - radius + tool
    (x, y), (tx, ty) = before.offset(1, radius, side), before.tangent(1)
    cx, cy = arc.centre[0] / TICKS, arc.centre[1] / TICKS
    return abs((cy - y) * tx - (cx - x) * ty) > tool


def line_to(start, end):
    return Element(start, end)


def arc_toward(rng, start, wanted, least=0.35, most=3.4):
    """A random exact arc from `start` that ends near the point `wanted`."""
    chord = wanted[0] - start[0], wanted[1] - start[1]
    course = math.atan2(chord[1], chord[0])
    while True:
        first, last = rng.sample(VECTORS, 2)
        step = last[0] - first[0], last[1] - first[1]
        error = (math.atan2(step[1], step[0]) - course + math.pi) % math.tau - math.pi
        size = round(math.hypot(*chord) / math.hypot(*step))
        centre = moved(start, first, -size)
        arc = Element(start, moved(centre, last, size), centre, rng.choice([1, -1]))
        if abs(error) < 0.1 and size and least < arc.sweep < most:
            return arc


def direction(element, share):
    """Travel at the start (0) or end (1) of an element as a vector of length 325, or None if it is none."""
    x, y = element.tangent(share)
    vector = round(UNIT * x), round(UNIT * y)
    exact = math.dist(vector, (UNIT * x, UNIT * y)) < 1e-9
    return vector if exact and vector in VECTORS else None


def tangent_line(start, along, length):
    """A line of about `length` mm along a vector of length 325."""
    return Element(start, moved(start, along, round(length * TICKS / UNIT)))


def tangent_arc(rng, start, along, radius, turn, least=0.35, most=2.5):
    """An exact arc of about `radius` mm that leaves along a vector of length 325."""
    size = round(radius * TICKS / UNIT)
    inward = turned(along) if turn > 0 else (along[1], -along[0])
    centre = moved(start, inward, size)
    while True:
        arc = Element(start, moved(centre, rng.choice(VECTORS), size), centre, turn)
        if least < arc.sweep < most:
            return arc
