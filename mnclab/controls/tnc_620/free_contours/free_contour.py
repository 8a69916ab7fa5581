"""Contours given by what is known of them: a chain of lines and arcs, solved in numbers.

An element is told by any of its data: where it ends, its direction, length, radius, centre, points on it or beside it,
that it joins the one before tangentially. Each datum is an equation between few unknowns (`.quadratics`):

    joint       p = (x, y)
    line        unit normal n to the left of the travel, and c:  n·p = c;  it goes along (n_y, -n_x)
    arc         centre C and signed radius ρ, positive counter-clockwise:  |p - C|² = ρ²
    tangent     at p with normal n:  p = C - ρ n;  hence n·C - c = ρ for a line, |C - D|² = (ρ - σ)² for another circle

What the data leave open is kept by `.readings`: a line at a distance from a point passes it on either side, a line
meets a circle twice. Readings come in this order: element after element in the order of the chain; where a line meets a
curve, the place farther along the line first; a line at a distance to the right of its point first; of other places the
one with the smaller y, then the larger x, first.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from mnclab.controls.tnc_620.free_contours.quadratics import Array, Form
from mnclab.controls.tnc_620.free_contours.readings import Label, Reading, Readings
from mnclab.geometry.arcs import sweep_of_one
from mnclab.geometry.curves import Curves, Floats, cross, distance, length_of, turned


class Pair(NamedTuple):
    """A point or a vector of the plane whose coordinates may be unknown."""

    x: Form
    y: Form

    def __sub__(self, other: Pair) -> Pair:
        return Pair(self.x - other.x, self.y - other.y)

    def dot(self, other: Pair) -> Form:
        return self.x * other.x + self.y * other.y

    def times(self, factor: Form | float) -> Pair:
        return Pair(self.x * factor, self.y * factor)

    def turned(self, angle: float) -> Pair:
        c, s = float(np.cos(angle)), float(np.sin(angle))
        return Pair(self.x * c - self.y * s, self.x * s + self.y * c)


def known(x: float, y: float) -> Pair:
    """A point or a vector whose coordinates are numbers."""
    return Pair(Form(x), Form(y))


def normal_of(angle: float) -> Pair:
    """The unit normal to the left of a direction, rad."""
    return known(-float(np.sin(angle)), float(np.cos(angle)))


class Element(NamedTuple):
    """A line (`normal`, `offset`) or an arc (`centre`, `radius` signed) between two joints of the chain."""

    start: Pair
    end: Pair
    normal: Pair | None = None
    offset: Form = Form()
    centre: Pair | None = None
    radius: Form = Form()

    @property
    def middle(self) -> Pair:
        """The centre of what is known to be an arc."""
        assert self.centre is not None
        return self.centre


class FreePiece(NamedTuple):
    """A solved element: `centre` is None for a line, `sense` +1 for a counter-clockwise arc, -1 for a clockwise one."""

    start: tuple[float, float]
    end: tuple[float, float]
    centre: tuple[float, float] | None
    sense: int


class FreeContour(Readings):
    """A chain of elements from a known point (mm); `heading` is the direction (rad) in which the path arrives there."""

    def __init__(self, start: tuple[float, float], heading: float | None = None) -> None:
        super().__init__()
        self.elements: list[Element] = []
        self.normals: dict[tuple[int, bool], Pair] = {}  # of arcs at their start (False) or end (True), where asked for
        self.start = known(*start)
        self.arriving = None if heading is None else normal_of(heading)
        self.size = max(1.0, abs(start[0]), abs(start[1]))

    def unknown_pair(self, place: float, dim: int = 1) -> Pair:
        """Two unknowns: a point, or with `dim` 0 a unit vector."""
        pair = Pair(self.unknown(place, dim), self.unknown(place, dim))
        if dim == 0:
            self.equal(pair.dot(pair) - 1.0, None)
        return pair

    def same(self, a: Pair, b: Pair, label: Label) -> None:
        self.equal(a.x - b.x, label)
        self.equal(a.y - b.y, label)

    def line(self, tangent: bool = False, label: Label = None) -> int:
        k, start = len(self.elements), self.end()
        end = self.unknown_pair(2 * k + 2)
        before = self.elements[-1] if self.elements else None
        if tangent and before and before.normal is not None:
            normal, offset = before.normal, before.offset
        else:
            normal, offset = self.unknown_pair(2 * k + 1, 0), self.unknown(2 * k + 1)
            self.equal(normal.dot(start) - offset, label)
            if tangent and before and before.centre is not None:
                self.same(start, before.centre - normal.times(before.radius), label)
                self.equal(normal.dot(before.centre) - offset - before.radius, label)
                self.normals[k - 1, True] = normal
            elif tangent and self.arriving:
                self.same(normal, self.arriving, label)
        self.equal(normal.dot(end) - offset, label)
        self.elements.append(Element(start, end, normal, offset))
        travel = end - start
        self.positive(normal.y * travel.x - normal.x * travel.y, label)
        return k

    def arc(self, tangent: bool = False, label: Label = None) -> int:
        k, start = len(self.elements), self.end()
        end, centre, radius = self.unknown_pair(2 * k + 2), self.unknown_pair(2 * k + 1), self.unknown(2 * k + 1)
        before = self.elements[-1] if self.elements else None
        self.elements.append(Element(start, end, centre=centre, radius=radius))
        for point in (start, end):
            self.through(k, point, label)
        if tangent:
            normal = self.arriving if before is None else before.normal
            if before and before.centre is not None:
                normal = self.normal(k - 1, at_end=True)
                apart, difference = before.centre - centre, before.radius - radius
                self.equal(apart.dot(apart) - difference * difference, label)
            elif before and before.normal:
                self.equal(before.normal.dot(centre) - before.offset - radius, label)
            assert normal is not None
            self.normals[k, False] = normal
            self.same(start, centre - normal.times(radius), label)
        return k

    def end(self, k: int = -1) -> Pair:
        """Where an element, or the chain so far, ends."""
        return self.elements[k].end if self.elements else self.start

    def normal(self, k: int, at_end: bool = False) -> Pair:
        """The unit normal to the left of the travel where an element begins or ends."""
        element = self.elements[k]
        if element.normal is not None:
            return element.normal
        if (k, at_end) not in self.normals:
            normal = self.normals[k, at_end] = self.unknown_pair(2 * k + (1.5 if at_end else 0.5), 0)
            point = element.end if at_end else element.start
            self.same(point, element.middle - normal.times(element.radius), None)
        return self.normals[k, at_end]

    def direction(self, k: int, normal: Pair, label: Label) -> None:
        """The direction of a line, or of the tangent where an arc begins, by its normal."""
        self.same(self.normal(k), normal, label)

    def length(self, k: int, value: float, label: Label) -> None:
        """The length of a line or of the chord of an arc, mm."""
        travel = self.elements[k].end - self.elements[k].start
        self.equal(travel.dot(travel) - value * value, label)
        self.size = max(self.size, value)

    def sense(self, k: int, sign: int, label: Label) -> None:
        """Whether an arc goes counter-clockwise (+1) or clockwise (-1)."""
        self.positive(self.elements[k].radius * sign, label)

    def radius(self, k: int, value: float, sign: int, label: Label) -> None:
        """The radius of an arc, mm; `sign` 0 where its sense is not known."""
        radius = self.elements[k].radius
        if sign:
            self.equal(radius - sign * value, label)
        else:
            self.either([[radius - value], [radius + value]], 2 * k + 1.9, label)
        self.size = max(self.size, value)

    def through(self, k: int, point: Pair, label: Label) -> None:
        """A point of an element, or of the line or circle that carries it."""
        element = self.elements[k]
        if element.normal is not None:
            self.equal(element.normal.dot(point) - element.offset, label)
        else:
            spoke = point - element.middle
            self.equal(spoke.dot(spoke) - element.radius * element.radius, label)

    def beside(self, k: int, point: Pair, distance: float, label: Label) -> None:
        """An element passes a point at a distance, mm, on either side: a line first to the right of it."""
        element = self.elements[k]
        shifts = (distance, -distance) if distance else (0.0,)
        if element.normal is not None:
            forms = [[element.normal.dot(point) - element.offset - shift] for shift in shifts]
        else:
            spoke, reaches = point - element.middle, [element.radius + shift for shift in shifts]
            forms = [[spoke.dot(spoke) - reach * reach] for reach in reaches]
        self.either(forms, 2 * k + 1.8, label)
        self.size = max(self.size, distance)

    def level(self, k: int) -> Form:
        """n·p of the line that carries an element, or of the tangent where an arc begins; n is its `normal`."""
        element = self.elements[k]
        return element.offset if element.normal is not None else self.normal(k).dot(element.start)

    def parallel(self, k: int, normal: Pair, level: Form, distance: float | None, label: Label) -> None:
        """A line runs along another line n·p = level, or against it, at a distance (mm) on either side."""
        element = self.elements[k]
        assert element.normal is not None
        forms = []
        for way in (1.0, -1.0):
            turned = [element.normal.x - normal.x * way, element.normal.y - normal.y * way]
            for shift in [None] if distance is None else sorted({distance, -distance}):
                forms.append(turned if shift is None else [*turned, element.offset * way - level - shift])
        self.either(forms, 2 * k + 1.7, label)
        self.size = max(self.size, distance or 0.0)

    def central_angle(self, k: int, angle: float, sign: int, label: Label) -> None:
        """An arc turns by an angle (rad, positive) in its sense."""
        element = self.elements[k]
        spoke = element.start - element.middle
        self.same(element.end - element.middle, spoke.turned(sign * angle), label)

    def order_of(self, place: float) -> float:
        """A joint comes behind the elements on both its sides."""
        return place + 1.95 if place % 2 == 0 else place

    def rank(self, values: Array, before: Array, window: Sequence[int]) -> list[float]:
        for i in window:
            joint, odd = divmod(self.places[i], 2)
            if odd or not self.dims[i]:
                continue
            k = int(joint)
            point = self.elements[k - 1].end
            for element in self.elements[k : k + 1] + self.elements[k - 1 : k]:
                n = element.normal
                if n is not None and not np.isnan(n.x.at(before)):
                    return [round(n.x.at(values) * point.y.at(values) - n.y.at(values) * point.x.at(values), 6)]
            return _low_first(point, values)
        for i in window:
            element = self.elements[int(self.places[i] // 2)]
            pair = element.centre or (element.normal and Pair(element.normal.y, -element.normal.x))
            if self.places[i] % 2 == 1 and pair and not np.isnan(pair.x.at(values) + pair.y.at(values)):
                return _low_first(pair, values)
        return super().rank(values, before, window)

    def pieces(self, reading: Reading) -> list[FreePiece]:
        """The elements of a reading that has settled everything."""
        v, found = reading.values, []
        for element in self.elements:
            start, end = ((p.x.at(v), p.y.at(v)) for p in (element.start, element.end))
            centre = None if element.centre is None else (element.centre.x.at(v), element.centre.y.at(v))
            found.append(FreePiece(start, end, centre, 0 if centre is None else int(np.sign(element.radius.at(v)))))
        return found


def _low_first(pair: Pair, values: Array) -> list[float]:
    """Smaller y first, then larger x."""
    return [round(pair.y.at(values), 6), -round(pair.x.at(values), 6)]


# Which of several readings of a free contour is meant: closed, inside the blank, not crossing itself.

CLOSED = 1e-3  # mm between the end and the start of a closed contour
STEPS = 48  # chords of an element
ALONG = 1e-6  # mm: a point inside one element as near to another lies on it


def outline(pieces: Sequence[FreePiece]) -> Floats:
    """Points (n, STEPS + 1, 2) along n elements, from start to end."""
    shares = np.linspace(0, 1, STEPS + 1)[:, None]
    found = []
    for piece in pieces:
        start, end = np.array(piece.start), np.array(piece.end)
        if piece.centre is None:
            found.append(start + shares * (end - start))
            continue
        angle = sweep_of_one(piece.start, piece.end, piece.centre, piece.sense) * shares[:, 0]
        found.append(piece.centre + turned(start - piece.centre, angle))
    return np.array(found)


def is_closed(pieces: Sequence[FreePiece], start: tuple[float, float]) -> bool:
    """Whether the last element ends at a point."""
    return bool(np.hypot(*np.subtract(pieces[-1].end, start)) < CLOSED)


def is_within(pieces: Sequence[FreePiece], low: Sequence[float], high: Sequence[float]) -> bool:
    """Whether the elements stay in a rectangle."""
    points = outline(pieces).reshape(-1, 2)
    return bool((points >= np.array(low) - CLOSED).all() and (points <= np.array(high) + CLOSED).all())


def crosses_itself(pieces: Sequence[FreePiece]) -> bool:
    """Whether the path runs through itself or along itself; touching at a point is neither."""
    points = outline(pieces)
    apart = (1e-9 * max(1.0, float(np.ptp(points))) ** 2) ** 2
    low, high = points.min(axis=1) - ALONG, points.max(axis=1) + ALONG
    near = (low[:, None] <= high).all(axis=2) & (low <= high[:, None]).all(axis=2)  # boxes around the elements
    curves = _curves(pieces)
    for k, other in np.argwhere(near & ~np.eye(len(points), dtype=bool)):
        a, b = points[k, :-1, None], points[k, 1:, None]
        c, d = points[other, :-1], points[other, 1:]
        across = cross(b - a, c - a) * cross(b - a, d - a) < -apart  # c and d on two sides of a -> b
        across &= cross(d - c, a - c) * cross(d - c, b - c) < -apart
        if across.any() or (distance(points[k, 1:-1], curves.take(np.full(STEPS - 1, other))) < ALONG).any():
            return True
    return False


def _curves(pieces: Sequence[FreePiece]) -> Curves:
    start, end = (np.array([getattr(piece, name) for piece in pieces]) for name in ("start", "end"))
    centre = np.array([piece.centre or (np.nan, np.nan) for piece in pieces])
    sweep = [sweep_of_one(p.start, p.end, p.centre, p.sense) if p.centre else 0.0 for p in pieces]
    return Curves(start, end, centre, length_of(start - centre), np.array(sweep))
