"""What measured points are: points, lines, circles, planes and the like, with how they were given and how they are drawn."""

from __future__ import annotations

import math
from abc import abstractmethod
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any, ClassVar, Self

import numpy as np
from numpy.typing import NDArray

from mnclab.geometry.contours import Contour
from mnclab.geometry.curves import turned
from mnclab.geometry.frames import Matrix, angles_of
from mnclab.machining.steps import Sketch
from mnclab.text.alarm import Alarm
from mnclab.text.given import refusing_class

# What a caller gives, checked: numbers in arrays, or an alarm that says what is wrong.

Floats = NDArray[np.float64]
Vector = Floats | Sequence[float]
Points = Floats | Sequence[Vector]
SAME = 1e-9  # mm: nearer points are one
FARTHEST = 1e9  # mm


def numbers(given: object, what: str) -> Floats:
    """An array of finite numbers."""
    try:
        found = np.asarray(given, dtype=np.float64)
    except (TypeError, ValueError, OverflowError):
        found = np.array(np.nan)
    if not (np.abs(found) <= FARTHEST).all():
        raise Alarm(f"{what} must be numbers, none beyond {FARTHEST:g}, got {given!r}")
    return found


def number(given: object, what: str) -> float:
    """One finite number."""
    found = numbers(given, what)
    if found.ndim:
        raise Alarm(f"{what} must be one number, got {given!r}")
    return float(found)


def unit(given: object, what: str) -> Floats:
    """Vectors (…, k) brought to the length 1."""
    found = numbers(given, what)
    length = np.linalg.norm(found, axis=-1, keepdims=True) if found.ndim else np.zeros(1)
    if not (found.size and (length > SAME).all()):
        raise Alarm(f"{what} must have a length, got {given!r}")
    return np.asarray(found / length)


def points_of(given: object, least: int, what: str, wide: int = 2, most: int | None = None) -> Floats:
    """Points (n, wide), at least two of them different: of points in space those in the plane take x and y."""
    found = numbers(given, f"the points of {what}")
    if found.ndim != 2 or found.shape[1] not in (wide, 3):
        raise Alarm(f"the points of {what} must be an array (n, {wide}), got one {found.shape}")
    if len(found) < least or most is not None and len(found) > most:
        raise Alarm(f"{what} needs {least} points{'' if most else ' or more'}, got {len(found)}")
    found = found[:, :wide]
    if not np.ptp(found, axis=0).max() > SAME:
        raise Alarm(f"the points of {what} are all one: {found[0].tolist()}")
    return found


# What measured points are found to be: points, lines, circles, balls, widths, rectangles and planes, as values.
# Lengths in mm, angles in degrees. A result shows its numbers with three decimals, as a control does, and holds them whole.

DEGREES = {"angle", "about_x", "about_y", "a", "b", "c"}  # numbers of these names are angles, all others lengths
SQUARE = 1e-9  # rad: nearer to a right angle a direction does not say to which side it points

Numbers = tuple[float, ...]


@refusing_class
class ProbingResult:
    """What all results share: the names of the numbers that they show."""

    SHOWN: ClassVar[tuple[str, ...]]

    @property
    def numbers(self) -> dict[str, float]:
        """The numbers that are shown, by name: mm, angles in degrees."""
        return {name: getattr(self, name) for name in self.SHOWN}

    @property
    def centre(self) -> Numbers:
        """The middle, x and y, of what lies in space also z."""
        return tuple(getattr(self, axis) for axis in "xyz" if hasattr(self, axis))

    def __repr__(self) -> str:
        said = (f"{name}={value:z.3f}" + ("°" if name in DEGREES else " mm") for name, value in self.numbers.items())
        return f"{type(self).__name__}({', '.join(said)})"


@refusing_class
class Round(ProbingResult):
    """A circle or a ball."""

    radius: float

    @property
    def diameter(self) -> float:
        return 2 * self.radius

    def grown(self, by: float) -> Self:
        """With a radius larger by so much: from ball centres to the wall of a hole by the ball's radius, to that of a stud by
        minus that."""
        return replace(self, radius=self.radius + by)  # type: ignore[type-var]


@refusing_class
class Flat(ProbingResult):
    """A line or a plane."""

    @property
    @abstractmethod
    def normal(self) -> Numbers:
        """The unit vector square to it."""

    def distance(self, points: Vector | Points) -> Floats:
        """How far points (…, 2) or (…, 3) are off it (…), positive on the side of the normal."""
        p = numbers(points, "points")
        if not p.ndim or p.shape[-1] != len(self.centre):
            raise Alarm(f"points must be an array (…, {len(self.centre)}), got one {p.shape}")
        return np.asarray((p - self.centre) @ self.normal)

    def towards(self, direction: Vector, by: float) -> Self:
        """Moved along its normal to the side where a direction points: from ball centres to the material by the ball's radius."""
        way = unit(direction, "a direction")
        side = float(way @ self.normal) if way.shape == (len(self.centre),) else 0.0
        if abs(side) < SQUARE:
            raise Alarm(f"the direction {direction!r} points to no side of the {type(self).__name__.lower()}")
        moved = (c + math.copysign(1.0, side) * by * n for c, n in zip(self.centre, self.normal, strict=True))
        return replace(self, **dict(zip("xyz", moved, strict=False)))  # type: ignore[type-var]


@refusing_class
@dataclass(frozen=True, repr=False)
class Point(ProbingResult):
    """A point of the plane.

    >>> mnc.probing.Point(1, 2).y
    2
    """

    x: float
    y: float
    SHOWN = "x", "y"


@refusing_class
@dataclass(frozen=True, repr=False)
class Line(Flat):
    """A line through the mean of its points, in their order, and its angle to X.

    `straightness` is how far apart the two parallels to it are that hold all points between them.

    >>> print(f"{mnc.probing.line([(0, 0), (10, 10)]).straightness:.3f}")
    0.000
    """

    x: float
    y: float
    angle: float
    straightness: float = 0.0
    SHOWN = "x", "y", "angle", "straightness"

    @property
    def direction(self) -> Numbers:
        """The unit vector along it."""
        return math.cos(math.radians(self.angle)), math.sin(math.radians(self.angle))

    @property
    def normal(self) -> Numbers:
        """The unit vector to its left."""
        x, y = self.direction
        return -y, x

    def foot(self, point: Vector) -> tuple[float, float]:
        """Its place that is nearest to a point."""
        at = numbers(point, "a point")
        if at.shape not in ((2,), (3,)):
            raise Alarm(f"a point must be two numbers (x, y), got {point!r}")
        off, (nx, ny) = float(self.distance(at[:2])), self.normal
        return float(at[0] - off * nx), float(at[1] - off * ny)


@refusing_class
@dataclass(frozen=True, repr=False)
class Circle(Round):
    """A circle; `roundness` is the difference between the farthest and the nearest point from its centre.

    >>> print(f"{mnc.probing.circle([(10, 0), (0, 10), (-10, 0)]).radius:.3f}")
    10.000
    """

    x: float
    y: float
    radius: float
    roundness: float = 0.0
    SHOWN = "x", "y", "diameter", "roundness"


@refusing_class
@dataclass(frozen=True, repr=False)
class Sphere(Round):
    """A ball; `roundness` is the difference between the farthest and the nearest point from its centre.

    >>> found = mnc.probing.sphere([(10, 0, 0), (-10, 0, 0), (0, 10, 0), (0, 0, 10)])
    >>> print(f"{found.roundness:.3f}")
    0.000
    """

    x: float
    y: float
    z: float
    radius: float
    roundness: float = 0.0
    SHOWN = "x", "y", "z", "diameter", "roundness"


@refusing_class
@dataclass(frozen=True, repr=False)
class Width(ProbingResult):
    """The width of a slot or a ridge, and the middle between its two touches.

    >>> mnc.probing.width((0, 5), (30, 5)).x
    15.0
    """

    x: float
    y: float
    width: float
    SHOWN = "x", "y", "width"

    def grown(self, by: float) -> Width:
        """With either wall moved outward by so much: for a slot by the ball's radius, for a ridge by minus that."""
        return replace(self, width=self.width + 2 * by)


@refusing_class
@dataclass(frozen=True, repr=False)
class Rectangle(ProbingResult):
    """A rectangle: its middle, its length along the direction of `angle`, its width across.

    >>> mnc.probing.rectangle([(0, 10), (40, 10), (20, 0), (20, 20)]).x
    20.0
    """

    x: float
    y: float
    length: float
    width: float
    angle: float = 0.0
    SHOWN = "x", "y", "length", "width", "angle"

    def grown(self, by: float) -> Rectangle:
        """With every wall moved outward by so much: for a pocket by the ball's radius, for a stud by minus that."""
        return replace(self, length=self.length + 2 * by, width=self.width + 2 * by)


@refusing_class
@dataclass(frozen=True, repr=False)
class Plane(Flat):
    """A plane through the mean of its points, and its unit normal that points to +Z.

    `flatness` is how far apart the two parallels to it are that hold all points between them.

    >>> mnc.probing.plane([(0, 0, 5), (10, 0, 5), (0, 10, 5)]).z
    5.0
    """

    x: float
    y: float
    z: float
    up: tuple[float, float, float]
    flatness: float = 0.0
    SHOWN = "x", "y", "z", "about_x", "about_y", "flatness"

    @property
    def normal(self) -> Numbers:
        """The unit vector upward."""
        return self.up

    @property
    def about_x(self) -> float:
        """The projection angle of the A axis: seen along X; positive where the plane rises with Y (TNC 620 § 16.13, Q158)."""
        return math.degrees(math.atan2(-self.up[1], self.up[2]))

    @property
    def about_y(self) -> float:
        """The projection angle of the B axis: seen along Y; negative where the plane rises with X (TNC 620 § 16.13, Q159)."""
        return math.degrees(math.atan2(self.up[0], self.up[2]))

    @property
    def spatial(self) -> tuple[float, float, float]:
        """The spatial angles A, B, C that lay the plane level, without a turn in itself: C is 0 (TNC 620 § 14.3)."""
        return spatial_angles(axes_on(self.up))


def axes_on(normal: Vector, along: Vector | None = None) -> Matrix:
    """The axes (3, 3) of a system on a plane, as columns: Z is the normal (3,), X is nearest to `along` (3,).

    Without `along` X has no part in Y, so that the spatial angle C is 0.

    Cycle 431 has X along its points 1 and 2, and the normal (M2 - M1) x (M3 - M1), which points down where the third point lies
    to the right.

    >>> mnc.probing.axes_on((0, 0, 2))[:, 2].tolist()
    [0.0, 0.0, 1.0]
    """
    up = unit(normal, "the normal")
    level = up.shape == (3,) and math.hypot(up[0], up[2]) > SQUARE
    ahead = unit(along, "X") if along is not None else np.array([up[2], 0.0, -up[0]] if level else [1.0, 0.0, 0.0])
    if up.shape != (3,) or ahead.shape != (3,) or np.linalg.norm(np.cross(up, ahead)) < SQUARE:
        raise Alarm(f"the normal and X must be three numbers each, and not along each other, got {normal!r} and {along!r}")
    across = unit(np.cross(up, ahead), "Y")
    return np.column_stack([np.cross(across, up), across, up])


def spatial_angles(axes: Matrix) -> tuple[float, float, float]:
    """The spatial angles A, B, C in degrees of a system whose axes are the columns (3, 3).

    They are turns about the fixed axes X, then Y, then Z, as cycle 19 takes them (TNC 620 § 11.9, 16.13).

    >>> mnc.probing.spatial_angles(np.array([[0.0, -1, 0], [1, 0, 0], [0, 0, 1]]))[2]
    90.0
    """
    given = numbers(axes, "the axes of a system")
    if given.shape != (3, 3):
        raise Alarm(f"the axes of a system must be an array (3, 3), got one {given.shape}")
    a, b, c = (math.degrees(angle) for angle in angles_of(given))
    return a, b, c


# Pictures of what was touched: a figure as it should be and as it was found, for `Sketch`.

Figure = Circle | Rectangle | Width | Sequence[Any] | Floats
TINY = 1e-6  # mm, that a figure without a size is drawn with


def sketch(nominal: Figure, actual: Figure, height: float, contacts: Sequence[Any] = (), direction: float = 0.0) -> Sketch:
    """Two figures at a height; `direction` (degrees) is that of a width, the contacts belong to the second."""
    return Sketch(outline(nominal, direction), outline(actual, direction), height, tuple(each.number for each in contacts))


def outline(figure: Figure, direction: float = 0.0) -> Contour:
    """The contour of a figure: of a width the way from wall to wall, of points (n, 2 or more) the lines between them."""
    match figure:
        case Circle():
            return Contour.circle(figure.centre, max(figure.radius, TINY))
        case Rectangle():
            half = np.maximum((figure.length, figure.width), TINY) / 2
            corners = half * [(1, 1), (-1, 1), (-1, -1), (1, -1)]
            return Contour(turned(corners, np.radians(figure.angle)) + figure.centre)
        case Width():
            ends = np.array([(-1.0, 0.0), (1.0, 0.0)]) * max(figure.width, TINY) / 2
            return Contour(turned(ends, np.radians(direction)) + figure.centre, closed=False)
        case _:
            return Contour([point[:2] for point in figure], closed=False)
