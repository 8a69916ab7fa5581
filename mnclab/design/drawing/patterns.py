"""Equal holes in patterns, as drawings dimension them: evenly on a circle by its diameter, in equal steps by their number."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

from mnclab.design.drawing.dimensions import Angle, Diameter, Linear, Point, Value, number, value
from mnclab.design.drawing.view import Kind, Line
from mnclab.design.drawing.wording import DIAMETER, TIMES
from mnclab.design.model.features import Feature, Hole
from mnclab.design.model.measures import Measure
from mnclab.geometry.contours import Contour

if TYPE_CHECKING:
    from mnclab.design.drawing.milled_features import Side

SAME = 1e-6  # mm
LEAST = 3  # holes on a circle, or one after the other


class Ring(NamedTuple):
    """Holes evenly on a circle; `first` is the least angle of one, rad."""

    centre: Point
    radius: float
    first: float


class Lattice(NamedTuple):
    """Holes at all crossings of columns and rows, three or more of which are equally far apart: their coordinates (mm)."""

    x: tuple[float, ...]
    y: tuple[float, ...]


def pattern_of(features: Sequence[Feature]) -> Ring | Lattice | None:
    """How equal features lie, where they are holes whose places have no tolerances of their own."""
    holes = [each for each in features if isinstance(each, Hole) and not {"x", "y"} & set(each.tolerances)]
    if len(holes) < LEAST or len(holes) < len(features):
        return None
    places = [(each.x, each.y) for each in holes]
    return _lattice(places) or _ring(places)


def _ring(places: Sequence[Point]) -> Ring | None:
    count = len(places)
    cx, cy = (sum(each) / count for each in zip(*places))
    radii = [math.hypot(x - cx, y - cy) for x, y in places]
    step = math.tau / count
    angles = sorted(math.atan2(y - cy, x - cx) % math.tau for x, y in places)
    even = all(abs(angle - angles[0] - k * step) * radii[0] < SAME for k, angle in enumerate(angles))
    if max(radii) - min(radii) > SAME or not even or radii[0] < SAME:
        return None
    first = angles[0] if angles[0] + SAME < step else 0.0
    if count == 4 and abs(first - step / 2) * radii[0] < SAME:  # the corners of a square are dimensioned as such
        return None
    return Ring((cx, cy), radii[0], first)


def _lattice(places: Sequence[Point]) -> Lattice | None:
    x, y = (tuple(sorted({round(each, 6) for each in some})) for some in zip(*places))
    if len(x) * len(y) != len(places) or len({(round(u, 6), round(v, 6)) for u, v in places}) != len(places):
        return None
    return Lattice(x, y) if any(len(each) >= LEAST and _even(each) for each in (x, y)) else None


def _even(some: Sequence[float]) -> bool:
    step = (some[-1] - some[0]) / (len(some) - 1) if len(some) > 1 else 0.0
    return len(some) >= LEAST and all(abs(each - some[0] - k * step) < 2 * SAME for k, each in enumerate(some))


def write_pattern(side: Side, numbers: Sequence[int], pattern: Ring | Lattice) -> None:
    """The places of holes in a pattern: the pattern, and where it stands."""
    if isinstance(pattern, Ring):
        _write_ring(side, numbers, pattern)
        return
    holes = [(k, side.features[k]) for k in numbers]
    for axis, some, other in (("x", pattern.x, pattern.y), ("y", pattern.y, pattern.x)):
        if not _even(some):
            for k in numbers:
                side.place(k, axis)
            continue
        rest = []
        for k, hole in holes:
            if abs(getattr(hole, axis) - some[0]) < 2 * SAME:
                side.place(k, axis)
            else:
                rest.append(k)
        count, whole = len(some) - 1, some[-1] - some[0]
        text = f"{count}{TIMES} {number(whole / count)} (={number(whole)})"
        ends = [(each, other[0]) if axis == "x" else (other[0], each) for each in (some[0], some[-1])]
        told = Linear(ends[0], ends[1], Value(text), axis, "below" if axis == "x" else "left")
        same = next((claims for said, claims in side.ledger.said if said in side.draft.dimensions and _alike(said, told)), None)
        if same is None:
            side.ledger.say(side.draft, told, side.claims(rest, axis))
        else:
            same += side.claims(rest, axis)


def _alike(said: Any, told: Linear) -> bool:
    """Whether a dimension says the same steps of other holes."""
    if not isinstance(said, Linear) or (said.value, said.along) != (told.value, told.along):
        return False
    k = "xy".index(told.along)
    return abs(said.a[k] - told.a[k]) < SAME and abs(said.b[k] - told.b[k]) < SAME


def _write_ring(side: Side, numbers: Sequence[int], ring: Ring) -> None:
    (cx, cy), radius = ring.centre, ring.radius
    side.draft.lines.append(Line(Contour.circle(ring.centre, radius), Kind.CENTRE))
    told = Diameter(ring.centre, radius, value(2 * radius, DIAMETER))
    side.ledger.say(side.draft, told, side.claims(numbers, "x", "y"))
    for axis, at in (("x", cx), ("y", cy)):
        side.places[axis].append((Measure(axis, at, "place"), ring.centre, None))
    quarters = [(ring.first + k * math.tau / len(numbers)) % (math.pi / 2) for k in range(len(numbers))]
    if min(min(angle, math.pi / 2 - angle) for angle in quarters) * radius < SAME:
        return  # one stands on a centre line, which says how they are turned
    level, hole = (cx + radius, cy), (cx + radius * math.cos(ring.first), cy + radius * math.sin(ring.first))
    side.draft.lines.append(Line(Contour([ring.centre, level], closed=False), Kind.THIN))
    side.draft.dimensions.append(Angle(ring.centre, level, hole, value(math.degrees(ring.first), after="°")))
