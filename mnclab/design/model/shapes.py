"""The outline of a feature as a drawing gives it: a rectangle or a circle by its sizes, anything else by its points."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, fields, replace
from functools import cached_property
from typing import Any

import numpy as np

from mnclab.design.model.measures import Measure
from mnclab.geometry import contours
from mnclab.geometry.contours import Contour
from mnclab.geometry.curves import left
from mnclab.path.toolpath import Array, Index, Mask
from mnclab.text.alarm import Alarm
from mnclab.text.given import check_number, check_point, faults_as_alarms, of_python, plain, shown
from mnclab.text.tables import exactly

LARGEST = 1e5  # mm, of a size and of a coordinate
ROUND = 1e-9  # mm, within which two halves are one circle


def check_place(value: Any, what: str) -> None:
    """An Alarm unless a coordinate is a number that a drawing can have."""
    check_number(value, what, at_least=-LARGEST, at_most=LARGEST)


@dataclass(frozen=True, repr=False)
class Rectangle:
    """`length` along X and `width` along Y about (x, y), corners of a radius, the whole `turned` by degrees; mm.

    >>> pocket = mnc.design.Pocket(mnc.design.Rectangle(50, 30, 30, 20), depth=10)
    >>> mnc.Design(mnc.box(100, 60, 20), [pocket]).volume
    114000.0
    """

    x: float
    y: float
    length: float
    width: float
    corner: float = 0.0
    turned: float = 0.0

    def __post_init__(self) -> None:
        _plain(self)
        for name in ("x", "y", "turned"):
            check_place(getattr(self, name), f"the {name} of a rectangle ({'degrees' if name == 'turned' else 'mm'})")
        for name in ("length", "width"):
            check_number(getattr(self, name), f"the {name} of a rectangle (mm)", above=0, at_most=LARGEST)
        check_number(self.corner, "the corner of a rectangle (mm)", at_least=0, at_most=LARGEST)
        with faults_as_alarms():
            self.contour  # noqa: B018  it must exist

    __repr__ = exactly

    @cached_property
    def contour(self) -> Contour:
        """Closed, counter-clockwise."""
        turned = np.radians(self.turned)
        return contours.rectangle(self.length, self.width, self.corner, centre=(self.x, self.y), angle=turned)

    def measures(self) -> Iterator[Measure]:
        yield Measure("length", self.length)
        yield Measure("width", self.width)
        if self.corner:
            yield Measure("corner radius", self.corner, "radius")
        if self.turned:
            yield Measure("angle", self.turned, "angle")
        yield Measure("x", self.x, "place")
        yield Measure("y", self.y, "place")

    def moved(self, dx: float, dy: float) -> Rectangle:
        return replace(self, x=self.x + dx, y=self.y + dy)


@dataclass(frozen=True, repr=False)
class Circle:
    """A diameter about (x, y), mm.

    >>> pocket = mnc.design.Pocket(mnc.design.Circle(50, 30, 20), depth=10)
    >>> print(f"{mnc.Design(mnc.box(100, 60, 20), [pocket]).volume:.1f}")  # less pi x 10 x 10 x 10
    116858.4
    """

    x: float
    y: float
    diameter: float

    def __post_init__(self) -> None:
        _plain(self)
        for name in ("x", "y"):
            check_place(getattr(self, name), f"the {name} of a circle (mm)")
        check_number(self.diameter, "the diameter of a circle (mm)", above=0, at_most=LARGEST)

    __repr__ = exactly

    @cached_property
    def contour(self) -> Contour:
        """Closed, counter-clockwise, two halves."""
        return Contour.circle((self.x, self.y), self.diameter / 2)

    def measures(self) -> Iterator[Measure]:
        yield Measure("diameter", self.diameter, "diameter")
        yield Measure("x", self.x, "place")
        yield Measure("y", self.y, "place")

    def moved(self, dx: float, dy: float) -> Circle:
        return replace(self, x=self.x + dx, y=self.y + dy)


@dataclass(frozen=True, repr=False)
class Outline:
    """Points (n, 2), mm, joined by lines and arcs: `bulge` (n,) is the tangent of a quarter of an arc's angle, 0 a line.

    >>> pocket = mnc.design.Pocket(mnc.design.Outline(((10, 10), (40, 10), (10, 30))), depth=10)
    >>> mnc.Design(mnc.box(100, 60, 20), [pocket]).volume  # less 30 x 20 / 2 x 10
    117000.0
    """

    points: tuple[tuple[float, float], ...]
    bulge: tuple[float, ...] = ()
    closed: bool = True

    def __post_init__(self) -> None:
        for name in ("points", "bulge"):
            if not isinstance(of_python(getattr(self, name)), tuple | list):
                raise Alarm(f"the {name} of an outline must be a list, got {shown(getattr(self, name))}")
        _plain(self)
        for k, each in enumerate(self.points):
            check_point(each, f"point {k} of an outline (mm)", flat=True)
            for number in each:
                check_place(number, f"a coordinate of point {k} of an outline (mm)")
        for number in self.bulge:
            check_number(number, "a bulge of an outline", at_least=-LARGEST, at_most=LARGEST)
        if not isinstance(self.closed, bool):
            raise Alarm(f"closed of an outline must be True or False, got {shown(self.closed)}")
        with faults_as_alarms():
            self.contour  # noqa: B018  it must exist

    __repr__ = exactly

    @cached_property
    def contour(self) -> Contour:
        return Contour(self.points, self.bulge or None, self.closed)

    def measures(self) -> Iterator[Measure]:
        """Where it lies: the least and the greatest x and y; a drawing gives every corner and radius of it."""
        (x0, y0), (x1, y1) = self.contour.bounds.tolist()
        yield Measure("length", x1 - x0)
        yield Measure("width", y1 - y0)
        yield Measure("x", (x0 + x1) / 2, "place")
        yield Measure("y", (y0 + y1) / 2, "place")

    def moved(self, dx: float, dy: float) -> Outline:
        return replace(self, points=tuple((x + dx, y + dy) for x, y in self.points))


Shape = Rectangle | Circle | Outline


def _plain(shape: Shape) -> None:
    """Numbers of numpy and fractions as those of Python, lists as tuples."""
    for each in fields(shape):
        object.__setattr__(shape, each.name, plain(getattr(shape, each.name)))


def shape_of(given: Any, what: str, closed: bool | None = True) -> Shape:
    """A shape, a contour or points as a shape; an Alarm where it is none of these, or open where it must be closed."""
    if isinstance(given, Rectangle | Circle | Outline):
        found: Shape = given
    else:
        contour = given
        if not isinstance(given, Contour):
            points = given.tolist() if isinstance(given, np.ndarray) else given
            if not isinstance(points, tuple | list):
                raise Alarm(f"{what} must be a contour or points (x, y), got {shown(given)}")
            try:
                contour = Outline(tuple(points)).contour
            except Alarm as fault:
                raise Alarm(f"{what}: {fault.message}") from None
        found = _circle(contour) or _outline(contour)
    if closed is not None and found.contour.closed != closed:
        raise Alarm(f"{what} must be a {'closed' if closed else 'open'} contour, got {shown(given)}")
    return found


def _circle(contour: Contour) -> Circle | None:
    if not contour.closed or not len(contour.bulge) or not contour.bulge.all():
        return None
    centres, radii = contour.centres, contour.radii
    if np.ptp(centres, axis=0).max() > ROUND or np.ptp(radii) > ROUND or abs(abs(contour.sweeps.sum()) - 2 * np.pi) > ROUND:
        return None
    x, y = centres[0].tolist()
    return Circle(x, y, 2 * float(radii[0]))


def _outline(contour: Contour) -> Outline:
    if contour.closed and contour.area < 0:
        contour = contour.reversed()
    bulge = tuple(contour.bulge.tolist()) if contour.bulge.any() else ()
    return Outline(plain(contour.points.tolist()), bulge, contour.closed)


# Places on contours, and stretches of them: what drawings and comparisons look at.


def spread(loop: Contour, spacing: float, fewest: int, turn: float = np.inf, aside: float = 0.0) -> tuple[Index, Array]:
    """Places on all elements of a contour: the numbers of their elements (m,), and how far along these they are (m,), 0 to 1.

    They are at most `spacing` mm and of an arc `turn` rad apart, an odd number, `fewest` at least; the first and the last are
    `aside` mm from the ends of their element.
    """
    lengths = loop.lengths
    count = np.maximum(np.ceil(lengths / spacing), np.ceil(np.abs(loop.sweeps) / turn)).astype(int)
    count = np.maximum(count, fewest) | 1
    element = np.repeat(np.arange(len(count)), count)
    rank = np.arange(len(element)) - np.repeat(np.cumsum(count) - count, count)
    hair = np.minimum(aside / np.maximum(lengths, ROUND), 0.01)[element]
    return element, hair + (1 - 2 * hair) * rank / (count[element] - 1)


def on_elements(loop: Contour, element: Index, share: Array) -> tuple[Array, Array, Array]:
    """How far along a contour such places are (m,), where (m, 2), and the unit directions to the left there (m, 2)."""
    lengths = loop.lengths
    way = (np.cumsum(lengths) - lengths)[element] + share * lengths[element]
    spots, ahead = loop.point_at(np.minimum(way, np.nextafter(lengths.sum(), 0)))
    return way, spots, left(ahead)


def stretches(loop: Contour, some: Mask) -> Iterator[Contour]:
    """Some elements of a contour (k,), those that follow each other as one; the whole of it where all are."""
    if some.all():
        yield loop
        return
    starts = np.flatnonzero(some & ~np.roll(some, 1))
    first = int(starts[0]) if loop.closed and len(starts) else 0
    for run in np.split(order := np.roll(np.arange(len(some)), -first), np.flatnonzero(np.diff(some[order])) + 1):
        if some[run[0]]:
            yield Contour([*loop.starts[run], loop.ends[run[-1]]], [*loop.bulge[run], 0.0], closed=False)
