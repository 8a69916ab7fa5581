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

from mnclab.design.drawing.dimensions import Dimension, Point
from mnclab.geometry.contours import Contour
from mnclab.geometry.curves import Floats
from mnclab.geometry.regions import Region
from mnclab.text.alarm import Alarm


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


class Line(NamedTuple):
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
    lines: tuple[Line, ...]
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


def thread_circle(centre: Point, radius: float) -> Line:
    """The thin three quarters of a circle by which ISO 6410-1 shows a thread from its end.

    `radius` is the greater one of a thread in a hole, the smaller one of a thread on a shaft.
    """
    quarter = [math.radians(angle) for angle in (100, 190, 280, 370)]
    points = [(centre[0] + radius * math.cos(a), centre[1] + radius * math.sin(a)) for a in quarter]
    return Line(Contour(points, [math.tan(math.pi / 8)] * 4, closed=False), Kind.THIN)
