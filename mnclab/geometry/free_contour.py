"""Contours given by what is known of them: a chain of lines and arcs, solved in numbers.

An element is told by any of its data: where it ends, its direction, length, radius, centre, points on it or beside it,
that it joins the one before tangentially. Each datum is an equation between few unknowns (:mod:`.quadratics`):

    joint       p = (x, y)
    line        unit normal n to the left of the travel, and c:  n·p = c;  it goes along (n_y, -n_x)
    arc         centre C and signed radius ρ, positive counter-clockwise:  |p - C|² = ρ²
    tangent     at p with normal n:  p = C - ρ n;  hence n·C - c = ρ for a line, |C - D|² = (ρ - σ)² for another circle

Whatever a few neighbouring unknowns settle among themselves is solved as soon as it is told, so a contour has at any time
a list of *readings*, which agree with everything known so far. Data with two meanings (a line at a distance from a point
passes it on either side) double the readings; what contradicts the rest takes readings away.

Readings come in this order: element after element in the order of the chain; where a line meets a curve, the place
farther along the line first; a line at a distance to the right of its point first; of other places the one with the
smaller y, then the larger x, first.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from mnclab.geometry.quadratics import NEAR, SAME, Form, System

Array = NDArray[np.float64]
Label = Any
MOST_READINGS = 256
WIDEST = 8  # unknowns in a row that are tried together before all of them are
SHORTEST = 1e-6  # mm: a line has a length, an arc a radius


class Pair(NamedTuple):
    """A point or a vector of the plane whose coordinates may be unknown."""

    x: Form
    y: Form

    def __sub__(self, other: Pair) -> Pair:
        return Pair(self.x - other.x, self.y - other.y)

    def plus(self, other: Pair) -> Pair:
        """The sum."""
        return Pair(self.x + other.x, self.y + other.y)

    def dot(self, other: Pair) -> Form:
        """The scalar product."""
        return self.x * other.x + self.y * other.y

    def times(self, factor: Form | float) -> Pair:
        """Stretched."""
        return Pair(self.x * factor, self.y * factor)

    def turned(self, angle: float) -> Pair:
        """Turned counter-clockwise by an angle, rad."""
        c, s = float(np.cos(angle)), float(np.sin(angle))
        return Pair(self.x * c - self.y * s, self.x * s + self.y * c)


def known(x: float, y: float) -> Pair:
    """A point or a vector whose coordinates are numbers."""
    return Pair(Form(x), Form(y))


def normal_of(angle: float) -> Pair:
    """The unit normal to the left of a direction, rad."""
    return known(-float(np.sin(angle)), float(np.cos(angle)))


class Element(NamedTuple):
    """A line (``normal``, ``offset``) or an arc (``centre``, ``radius`` signed) between two joints of the chain."""

    start: Pair
    end: Pair
    normal: Pair | None = None
    offset: Form = Form()
    centre: Pair | None = None
    radius: Form = Form()


class Piece(NamedTuple):
    """A solved element: ``centre`` is None for a line, ``sense`` +1 for a counter-clockwise arc, -1 for a clockwise one."""

    start: tuple[float, float]
    end: tuple[float, float]
    centre: tuple[float, float] | None
    sense: int


class Reading(NamedTuple):
    """The unknowns (nan where not settled), and which of several solutions was taken at which unknown."""

    values: Array
    choices: tuple[tuple[float, int], ...]


class Contradiction(Exception):
    """Data that no contour fulfils; ``label`` is that of the datum, ``gap`` by how much it is missed (mm, or nan)."""

    def __init__(self, label: Label, gap: float) -> None:
        super().__init__(f"{label} contradicts what is known")
        self.label, self.gap = label, gap


class TooManyReadings(Exception):
    """More readings than can be followed."""


class FreeContour:
    """A chain of elements from a known point (mm); ``heading`` is the direction (rad) in which the path arrives there."""

    def __init__(self, start: tuple[float, float], heading: float | None = None) -> None:
        self.dims: list[int] = []
        self.places: list[float] = []  # of each unknown along the chain: 2k + 1 an element, 2k its first joint
        self.equations: list[tuple[Form, frozenset[int], Label]] = []
        self.limits: list[tuple[Form, frozenset[int], Label]] = []
        self.elements: list[Element] = []
        self.normals: dict[tuple[int, bool], Pair] = {}  # of arcs at their start (False) or end (True), where asked for
        self.start = known(*start)
        self.arriving = None if heading is None else normal_of(heading)
        self.readings = [Reading(np.empty(0), ())]
        self.size = max(1.0, abs(start[0]), abs(start[1]))
        self.conflict: tuple[Label, float] | None = None

    # --- telling what is known ------------------------------------------------------------------------------------------

    def unknown(self, place: float, dim: int = 1) -> Form:
        """A new unknown, a length or (``dim`` 0) a component of a unit vector."""
        self.dims.append(dim)
        self.places.append(place)
        self.readings = [Reading(np.append(r.values, np.nan), r.choices) for r in self.readings]
        return Form(0.0, {len(self.dims) - 1: 1.0})

    def unknown_pair(self, place: float, dim: int = 1) -> Pair:
        """Two unknowns: a point, or with ``dim`` 0 a unit vector."""
        pair = Pair(self.unknown(place, dim), self.unknown(place, dim))
        if dim == 0:
            self.equal(pair.dot(pair) - 1.0, None)
        return pair

    def equal(self, form: Form, label: Label) -> None:
        """An equation form = 0."""
        self.equations.append((form, frozenset(form.variables), label))
        if form.power(self.dims) == 1:
            self.size = max(self.size, abs(form.const))

    def same(self, a: Pair, b: Pair, label: Label) -> None:
        """Two points or vectors are equal."""
        self.equal(a.x - b.x, label)
        self.equal(a.y - b.y, label)

    def positive(self, form: Form, label: Label) -> None:
        """A condition form > 0."""
        self.limits.append((form, frozenset(form.variables), label))

    def either(self, alternatives: Sequence[Iterable[Form]], place: float, label: Label) -> None:
        """One of several lists of equations holds; the readings are followed for each."""
        flag = self.unknown(place)
        (variable,) = flag.linear
        count = len(alternatives)
        readings = []
        for reading in self.readings:
            for k in range(count):
                values = reading.values.copy()
                values[variable] = k
                readings.append(Reading(values, (*reading.choices, (place, k)) if count > 1 else reading.choices))
        self.readings = readings
        for k, forms in enumerate(alternatives):
            for form in forms:  # counts only in the readings that have taken it
                self.equations.append((form, frozenset(form.variables) | {-1 - variable, -1_000_000 - k}, label))
                if form.power(self.dims) == 1:
                    self.size = max(self.size, abs(form.const))

    def line(self, tangent: bool = False, label: Label = None) -> int:
        """A straight line; its number."""
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
        """A circular arc; its number."""
        k, start = len(self.elements), self.end()
        end, centre, radius = self.unknown_pair(2 * k + 2), self.unknown_pair(2 * k + 1), self.unknown(2 * k + 1)
        before = self.elements[-1] if self.elements else None
        self.elements.append(Element(start, end, centre=centre, radius=radius))
        for point in (start, end):
            self.on_circle(k, point, label)
        if tangent:
            normal = self.arriving if before is None else before.normal
            if before and before.centre is not None:
                normal = self.normal(k - 1, at_end=True)
                apart = before.centre - centre
                difference = before.radius - radius
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
            assert element.centre is not None
            normal = self.normals[k, at_end] = self.unknown_pair(2 * k + (1.5 if at_end else 0.5), 0)
            point = element.end if at_end else element.start
            self.same(point, element.centre - normal.times(element.radius), None)
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
        """The radius of an arc, mm; ``sign`` 0 where its sense is not known."""
        radius = self.elements[k].radius
        if sign:
            self.equal(radius - sign * value, label)
        else:
            self.either([[radius - value], [radius + value]], 2 * k + 1.9, label)
        self.size = max(self.size, value)

    def on_circle(self, k: int, point: Pair, label: Label) -> None:
        """A point of the circle of an arc."""
        centre, radius = self.elements[k].centre, self.elements[k].radius
        assert centre is not None
        spoke = point - centre
        self.equal(spoke.dot(spoke) - radius * radius, label)

    def through(self, k: int, point: Pair, label: Label) -> None:
        """A point of an element, or of the line or circle that carries it."""
        element = self.elements[k]
        if element.normal is None:
            self.on_circle(k, point, label)
        else:
            self.equal(element.normal.dot(point) - element.offset, label)

    def beside(self, k: int, point: Pair, distance: float, label: Label) -> None:
        """An element passes a point at a distance, mm, on either side: a line first to the right of it."""
        element = self.elements[k]
        shifts = (distance, -distance) if distance else (0.0,)
        if element.normal is not None:
            forms = [[element.normal.dot(point) - element.offset - shift] for shift in shifts]
        else:
            assert element.centre is not None
            spoke = point - element.centre
            forms = []
            for shift in shifts:
                reach = element.radius + shift
                forms.append([spoke.dot(spoke) - reach * reach])
        self.either(forms, 2 * k + 1.8, label)
        self.size = max(self.size, distance)

    def parallel(self, k: int, other: int, distance: float | None, label: Label) -> None:
        """A line runs along another element, or the tangent where that begins, or against it, at a distance (mm)."""
        element, normal = self.elements[k], self.normal(other)
        assert element.normal is not None
        level = normal.dot(self.elements[other].start)
        if self.elements[other].normal is not None:
            level = self.elements[other].offset
        forms = []
        for way in (1.0, -1.0):
            turned = [element.normal.x - normal.x * way, element.normal.y - normal.y * way]
            for shift in {None} if distance is None else {distance, -distance}:
                forms.append(turned if shift is None else [*turned, element.offset * way - level - shift])
        self.either(forms, 2 * k + 1.7, label)

    def central_angle(self, k: int, angle: float, sign: int, label: Label) -> None:
        """An arc turns by an angle (rad, positive) in its sense."""
        element = self.elements[k]
        assert element.centre is not None
        a, b = element.start - element.centre, element.end - element.centre
        self.same(b, a.turned(sign * angle), label)

    # --- solving --------------------------------------------------------------------------------------------------------

    def follow(self, thoroughly: bool = False) -> None:
        """Settle in every reading what can be settled; raises Contradiction when none is left.

        ``thoroughly``: unknowns that hang together in large numbers are solved too.
        """
        self.conflict = None
        waiting, done = self.readings[::-1], []
        while waiting:
            reading = waiting.pop()
            following = self._further(reading, thoroughly)
            if following is None:
                done.append(reading)
            else:
                waiting += following[::-1]
            if len(waiting) + len(done) > MOST_READINGS:
                raise TooManyReadings
        done.sort(key=lambda reading: sorted(reading.choices))
        self.readings = []
        for reading in done:
            if not any(_alike(reading.values, other.values, SAME * self.size) for other in self.readings):
                self.readings.append(reading)
        if not self.readings:
            raise Contradiction(*(self.conflict or (None, np.nan)))

    def open_unknowns(self, reading: Reading) -> list[int]:
        """The unknowns that a reading has not settled, along the chain."""
        return sorted(np.flatnonzero(np.isnan(reading.values)).tolist(), key=lambda i: (self.places[i], i))

    def _holding(self, values: Array) -> list[tuple[int, Form, frozenset[int]]]:
        """Equations that hold in a reading: number, form, and those of its unknowns that are not settled."""
        found = []
        for number, (form, variables, _) in enumerate(self.equations):
            if any(i < 0 for i in variables):
                flag = next(-1 - i for i in variables if -1_000_000 < i < 0)
                if values[flag] != next(-1_000_000 - i for i in variables if i <= -1_000_000):
                    continue
            found.append((number, form, frozenset(i for i in variables if i >= 0 and np.isnan(values[i]))))
        return found

    def _further(self, reading: Reading, thoroughly: bool) -> list[Reading] | None:
        """The readings that a reading becomes by settling some unknowns more; None when nothing more can be settled."""
        values = reading.values
        holding = self._holding(values)
        if not self._consistent(values, holding):
            return []
        unknowns = self.open_unknowns(reading)
        widths = [*range(1, min(WIDEST, len(unknowns)) + 1)]
        if thoroughly:
            widths = [*range(1, len(unknowns) + 1)]
        carriers = [i for i in unknowns if self.places[i] % 2 == 1]
        for width in widths:
            for row in (unknowns, carriers) if len(carriers) < len(unknowns) else (unknowns,):
                for first in range(len(row) - width + 1):
                    window = row[first : first + width]
                    inside = frozenset(window)
                    mine = [item for item in holding if item[2] and item[2] <= inside]
                    if len(mine) < width or {i for item in mine for i in item[2]} != inside:
                        continue
                    system = System([form for _, form, _ in mine], window, values, self.dims, self.size)
                    found = system.solve(thoroughly)
                    if found is None:
                        continue
                    if not found:
                        self._blame(max(number for number, _, _ in mine), np.nan)
                    return self._fork(reading, window, found)
        return None

    def _fork(self, reading: Reading, window: Sequence[int], found: Sequence[Array]) -> list[Reading]:
        """A reading for each solution of a window, in the order that the module states."""
        readings = []
        for solution in found:
            values = reading.values.copy()
            values[list(window)] = solution
            readings.append(values)
        if len(readings) == 1:
            return [Reading(readings[0], reading.choices)]
        place = self.places[window[0]]
        if place % 2 == 0:  # a joint comes behind the elements on both its sides
            place += 1.95
        readings.sort(key=lambda values: self._rank(values, window))
        return [Reading(values, (*reading.choices, (place, k))) for k, values in enumerate(readings)]

    def _rank(self, values: Array, window: Sequence[int]) -> list[float]:
        """What solutions of a window are sorted by."""
        for i in window:
            joint = self.places[i] / 2
            if joint == int(joint) and self.dims[i]:
                point = self.elements[int(joint) - 1].end
                for element in self.elements[int(joint) : int(joint) + 1] + self.elements[int(joint) - 1 : int(joint)]:
                    if element.normal is not None and not np.isnan(element.normal.x.at(values)):
                        n = element.normal
                        return [
                            round(n.x.at(values) * point.y.at(values) - n.y.at(values) * point.x.at(values), 6)
                        ]
                return [round(point.y.at(values), 6), -round(point.x.at(values), 6)]
        for i in window:
            centre = self.elements[int(self.places[i] // 2)].centre if self.places[i] % 2 == 1 else None
            if centre is not None and not any(np.isnan(values[k]) for k in centre.x.variables | centre.y.variables):
                return [round(centre.y.at(values), 6), -round(centre.x.at(values), 6)]
        return [round(float(values[i]), 6) for i in window]

    def _consistent(self, values: Array, holding: Sequence[tuple[int, Form, frozenset[int]]]) -> bool:
        """Whether a reading fulfils every condition on what it has settled."""
        for number, form, rest in holding:
            if not rest and (gap := form.gap(values, self.dims)) > NEAR:
                self._blame(number, gap)
                return False
        for form, variables, label in self.limits:
            if not any(np.isnan(values[i]) for i in variables) and form.at(values) < SHORTEST:
                self.conflict = self.conflict or (label, np.nan)
                return False
        return True

    def _blame(self, number: int, gap: float) -> None:
        """Remember what took a reading away: the datum that is missed least."""
        if self.conflict is None or np.isnan(self.conflict[1]) or gap < self.conflict[1]:
            self.conflict = (self.equations[number][2], gap)

    def missing(self, reading: Reading) -> int:
        """How many data a reading lacks: unknowns less independent equations among them."""
        unknowns = self.open_unknowns(reading)
        values = reading.values.copy()
        values[unknowns] = np.random.default_rng(1).normal(0, self.size, len(unknowns))
        forms = [form for _, form, rest in self._holding(reading.values) if rest]
        system = System(forms, unknowns, values, self.dims, self.size)
        x = values[unknowns] / system.unit
        slopes = 2 * system.a @ x + system.b
        return len(unknowns) - int(np.linalg.matrix_rank(slopes, 1e-9)) if len(forms) else len(unknowns)

    def pieces(self, reading: Reading) -> list[Piece]:
        """The elements of a reading that has settled everything."""
        v, found = reading.values, []
        for element in self.elements:
            start, end = ((p.x.at(v), p.y.at(v)) for p in (element.start, element.end))
            centre = None if element.centre is None else (element.centre.x.at(v), element.centre.y.at(v))
            found.append(Piece(start, end, centre, 0 if centre is None else int(np.sign(element.radius.at(v)))))
        return found


def _alike(a: Array, b: Array, tolerance: float) -> bool:
    """Whether two readings have settled the same unknowns with the same values."""
    nothing = np.isnan(a)
    return bool((nothing == np.isnan(b)).all() and (np.abs(a - b)[~nothing] <= tolerance).all())
