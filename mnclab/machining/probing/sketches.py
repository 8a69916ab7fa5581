"""Figures of pictures: one as it should be and as it was found, for a `Sketch` (contours of the plane, mm)."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from mnclab.geometry.contours import Contour
from mnclab.machining.probing.found import Circle, Rectangle
from mnclab.machining.steps import Sketch

Pair = tuple[float, float]


def round_sketch(centre: Pair, radius: float, found: Circle, height: float, contacts: Sequence[Any]) -> Sketch:
    """A hole or a round stud; `contacts` are the answers of its touches."""
    return _sketch(Contour.circle(centre, radius), Contour.circle(found.centre, found.radius), height, contacts)


def box_sketch(centre: Pair, sides: Pair, found: Rectangle, height: float, contacts: Sequence[Any]) -> Sketch:
    """A pocket or stud, whose sides lie along the axes."""
    return _sketch(_box(centre, sides), _box((found.x, found.y), (found.length, found.width)), height, contacts)


def line_sketch(nominal: Sequence[Pair], found: Sequence[Pair], height: float, contacts: Sequence[Any]) -> Sketch:
    """A line through points: an edge, or from wall to wall of a slot or ridge."""
    return _sketch(Contour(nominal, closed=False), Contour(found, closed=False), height, contacts)


def _box(centre: Pair, sides: Pair) -> Contour:
    return Contour(np.array(centre) + np.array([(-1, -1), (1, -1), (1, 1), (-1, 1)]) * np.array(sides) / 2)


def _sketch(nominal: Contour, found: Contour, height: float, contacts: Sequence[Any]) -> Sketch:
    return Sketch(nominal, found, height, tuple(contact.number for contact in contacts))
