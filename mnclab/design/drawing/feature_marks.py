"""What a feature takes up in its view, and the lines that belong to it: centre lines, thin lines of threads."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

from mnclab.design.drawing.dimensions import Point
from mnclab.design.drawing.ledger import Draft
from mnclab.design.drawing.view import Axis, Cross, Kind, Line, thread_circle
from mnclab.design.model.features import Chamfer, Feature, Groove, Hole, Pocket, Slope, Slot, Stud
from mnclab.design.model.shapes import Circle, Rectangle, Shape
from mnclab.design.model.threads import core_of
from mnclab.geometry.contours import Contour

SAME = 1e-6  # mm


def feature_marks(draft: Draft, feature: Feature) -> None:
    """Centre lines, and the thin lines of a thread."""
    shape = shape_in(feature)
    if isinstance(feature, Hole):
        wide = mouth_of(feature)
        if feature.thread:
            draft.lines.append(thread_circle((feature.x, feature.y), core_of(feature.thread, 0.0) / 2))
            wide = max(wide, core_of(feature.thread, 0.0))
        draft.axes.append(Cross((feature.x, feature.y), wide / 2))
    elif isinstance(feature, Slot):
        (x0, y0), (x1, y1) = feature.start, feature.end
        at = frame_at(feature.start, math.degrees(math.atan2(y1 - y0, x1 - x0)))
        half, length = feature.width / 2, math.dist(feature.start, feature.end)
        draft.axes.append(Axis(at(-half, 0), at(length + half, 0)))
        draft.axes += [Axis(at(u, -half), at(u, half)) for u in (0.0, length / 2, length)]
    elif shape is not None and not isinstance(feature, Chamfer):
        shape_marks(draft, shape, feature.width if isinstance(feature, Groove) else 0.0)
    if isinstance(feature, Groove):
        draft.lines.append(Line(feature.contour.contour, Kind.CENTRE))


def shape_marks(draft: Draft, shape: Shape, wider: float = 0.0) -> None:
    """The centre lines of a circle or a rectangle."""
    if isinstance(shape, Circle):
        draft.axes.append(Cross((shape.x, shape.y), (shape.diameter + wider) / 2))
    elif isinstance(shape, Rectangle):
        at, a, b = frame_at((shape.x, shape.y), shape.turned), shape.length / 2, shape.width / 2
        draft.axes += [Axis(at(-a, 0), at(a, 0)), Axis(at(0, -b), at(0, b))]


def mouth_of(hole: Hole) -> float:
    """The greatest diameter of a hole without its thread, mm."""
    return max(hole.wide, (hole.counterbore or (0.0,))[0], (hole.countersink or (0.0,))[0])


def shape_in(feature: Feature) -> Shape | None:
    """The outline that a feature was given, if it has one."""
    return feature.contour if isinstance(feature, Pocket | Stud | Groove | Chamfer | Slope) else None


def outline_of(feature: Feature) -> Contour | None:
    """What a feature takes up in its view."""
    if isinstance(feature, Hole):
        return Contour.circle((feature.x, feature.y), feature.wide / 2)
    if isinstance(feature, Slot):
        return feature.outline
    shape = shape_in(feature)
    return shape.contour if shape is not None else None


def centre_of(feature: Feature) -> Point:
    """Where a feature stands; 0 for what has no place."""
    known = {each.name: each.nominal for each in feature.measures()}
    return known.get("x", 0.0), known.get("y", 0.0)


def frame_at(centre: Point, degrees: float) -> Callable[[float, float], Point]:
    """Places (u, v) about a centre, u turned by degrees."""
    c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    return lambda u, v: (centre[0] + u * c - v * s, centre[1] + u * s + v * c)


def point_of(at: Any) -> Point:
    """A place as two plain numbers."""
    return float(at[0]), float(at[1])


def direction_of(way: Any) -> str:
    """The direction of a dimension along a way."""
    return "x" if abs(way[1]) < SAME else "y" if abs(way[0]) < SAME else "ab"
