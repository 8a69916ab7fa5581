"""A view of a part: its lines by kind, what is cut, and what is written to it. All in mm of the part, x right, y up.

Kinds of lines by ISO 128-2:
    VISIBLE   0.5 mm continuous                 edges and outlines
    HIDDEN    0.25 mm dashed                    edges behind
    CENTRE    0.25 mm long-dashed dotted        axes, planes of symmetry, pitch circles
    THIN      0.25 mm continuous                minor lines of threads, imaginary edges, bend lines
    PHANTOM   0.25 mm long-dashed double-dotted what lies beside or in front of the part, the blank
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from enum import Enum
from functools import cached_property
from typing import NamedTuple

import numpy as np

from mnclab.geometry.contours import Contour
from mnclab.geometry.curves import Floats
from mnclab.geometry.regions import Region
from mnclab.text.alarm import Alarm
from mnclab.text.given import check_number


class Kind(Enum):
    """A kind of line: its width (mm) and its dashes and gaps (mm)."""

    VISIBLE = 0.5, ()
    HIDDEN = 0.25, (3.0, 1.5)
    CENTRE = 0.25, (8.0, 1.2, 1.0, 1.2)
    THIN = 0.25, ()
    PHANTOM = 0.25, (8.0, 1.2, 1.0, 1.2, 1.0, 1.2)
    FRAME = 0.7, ()

    @property
    def width(self) -> float:
        return self.value[0]

    @property
    def dashes(self) -> tuple[float, ...]:
        return self.value[1]


class ViewLine(NamedTuple):
    """A contour, open or closed, drawn as one kind of line; its arcs stay arcs."""

    contour: Contour
    kind: Kind = Kind.VISIBLE


class Axis(NamedTuple):
    """A centre line from a to b, which on paper goes 3 mm beyond both: of a body of revolution, of a symmetry."""

    a: Point
    b: Point


class Cross(NamedTuple):
    """The two centre lines of a circle, turned by an angle (rad); on paper they go 3 mm beyond it."""

    centre: Point
    radius: float
    turned: float = 0.0


class Origin(NamedTuple):
    """The zero point of the workpiece: a circle with two filled quarters, of one size on every paper."""

    at: Point


class Cut(NamedTuple):
    """Where a section is taken: the way of the plane through the view (two points, or more where it steps), the letter
    and the direction in which one looks; on paper its ends stand outside the view with arrows and letters.
    """

    points: tuple[Point, ...]
    letter: str
    looks: Point


@dataclass(frozen=True, eq=False)
class View:
    """One view or section.

    `hatches` are the cut faces. `title` stands above ("A–A"). `cell` is (column, row) in the arrangement, rows counted
    downwards: views of one column have x in common, views of one row y, as the method of projection wants it. In the
    first-angle projection the view from the front is (0, 0), that from above (0, 1), that from the left (1, 0).
    A `free` view (a section beside, a detail) is only put into its cell. `enlarged` is the scale of a detail against that of
    the drawing.
    """

    name: str
    lines: tuple[ViewLine, ...]
    hatches: tuple[Region, ...] = ()
    dimensions: tuple[Dimension, ...] = ()
    axes: tuple[Axis | Cross | Origin, ...] = ()
    cuts: tuple[Cut, ...] = ()
    title: str = ""
    cell: tuple[int, int] = (0, 0)
    free: bool = False
    enlarged: float = 1.0

    def __post_init__(self) -> None:
        if not self.lines:
            raise Alarm(f"the view {self.name!r} has no lines")

    @cached_property
    def bounds(self) -> Floats:
        """Lower left and upper right corner of the lines, `(2, 2)` mm."""
        corners = np.concatenate([line.contour.bounds for line in self.lines])
        return np.array([corners.min(axis=0), corners.max(axis=0)])


def thread_circle(centre: Point, radius: float) -> ViewLine:
    """The thin three quarters of a circle by which ISO 6410-1 shows a thread from its end.

    `radius` is the greater one of a thread in a hole, the smaller one of a thread on a shaft.
    """
    quarter = [math.radians(angle) for angle in (100, 190, 280, 370)]
    points = [(centre[0] + radius * math.cos(a), centre[1] + radius * math.sin(a)) for a in quarter]
    return ViewLine(Contour(points, [math.tan(math.pi / 8)] * 4, closed=False), Kind.THIN)


# What is written to a view: dimensions and notes with the points to which they belong, angles in rad.
# Where a dimension stands on the paper is nobody's choice here: the layout finds a place.

Point = tuple[float, float]
Tolerance = float | tuple[float, float] | str | None  # ±, (lower, upper) or a class of ISO 286

MINUS = "\N{MINUS SIGN}"
DIGITS = 3  # decimals of a millimetre


class Value(NamedTuple):
    """The text of a dimension: "40", "⌀12", "4× R5"; `tolerance` is written behind it ("±0.1", "H7"), `limits` are the
    upper and the lower deviation, one above the other. A `reference` stands in brackets.
    """

    text: str
    tolerance: str = ""
    limits: tuple[str, str] | None = None
    reference: bool = False


def number(size: float, digits: int = DIGITS) -> str:
    """A number as drawings have it: no zeros at the end, a true minus sign."""
    text = f"{size + 0.0:.{digits}f}"
    text = text.rstrip("0").rstrip(".") if "." in text else text
    return text.replace("-", MINUS) if float(text) else "0"


def value(
    nominal: float, before: str = "", tolerance: Tolerance = None, reference: bool = False, after: str = ""
) -> Value:
    """A number (mm, or degrees with `after="°"`) with its sign before it and its tolerance.

    `tolerance` is a number (±), the pair (lower, upper) of deviations, or a class such as "H7".
    """
    check_number(nominal, "the value of a dimension")
    text = f"{before}{number(nominal)}{after}"
    if tolerance is None or isinstance(tolerance, str):
        return Value(text, tolerance or "", None, reference)
    if isinstance(tolerance, tuple):
        lower, upper = (_deviation(each, after) for each in tolerance)
        return Value(text, "", (upper, lower), reference)
    return Value(text, f"±{number(tolerance)}{after}", None, reference)


def _deviation(size: float, unit: str) -> str:
    text = number(size)
    return text if text == "0" else f"{'+' if size > 0 else ''}{text}{unit}"


@dataclass(frozen=True)
class Linear:
    """The distance of two points: along x or y, or along the line through both (`along="ab"`).

    `side` is where it should stand: "above" or "below" (along x), "left" or "right" (along y; of the way from a to b for
    "ab"); without one the nearer side is taken. Dimensions on one side get rows, 10 mm from the view and 7 mm from each
    other, the shorter nearer; those that fit into one row stand in it as a chain. A diameter across a profile is a Linear
    with the sign ⌀ in its value. `inside` says that edges run from a and from b to where the other one lies, as those of a
    step of a shaft do: then the dimension line may stand between them.
    """

    a: Point
    b: Point
    value: Value
    along: str = "x"
    side: str = ""
    inside: bool = False


@dataclass(frozen=True)
class Diameter:
    """The diameter of a circle in its round view: a leader that points to the centre, or a line across a large circle.

    `more` are further lines of text below ("↧10", "⌴ ⌀11 ↧6.4").
    """

    centre: Point
    radius: float
    value: Value
    more: tuple[str, ...] = ()


@dataclass(frozen=True)
class Radius:
    """The radius of an arc, from the angle `start` over `sweep` (rad, signed): an arrow at the arc, along its radius."""

    centre: Point
    radius: float
    start: float
    sweep: float
    value: Value
    more: tuple[str, ...] = ()


@dataclass(frozen=True)
class Angle:
    """The angle at `vertex` from the leg through `a` counter-clockwise to the leg through `b`.

    `a` and `b` are the far ends of the edges, which begin `near` mm from the vertex: beyond them the legs are continued by
    thin lines.
    """

    vertex: Point
    a: Point
    b: Point
    value: Value
    near: float = 0.0


@dataclass(frozen=True)
class Note:
    """Text with a leader to a point: "1×45°", "M8 ↧12"; each text of `lines` is a line.

    With a `radius` (mm) the arrow ends anywhere on that circle about the point, and points to its centre.
    """

    at: Point
    lines: tuple[str, ...]
    radius: float = 0.0


Dimension = Linear | Diameter | Radius | Angle | Note
