"""What features show in a view beside their edges: centre lines, thin lines of threads, patterns of equal holes, tables."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

from mnclab.design.drawing.ledger import DIAMETER, SAME, SIGNS, TIMES, Draft, hole_lines, written
from mnclab.design.drawing.sheet import Table
from mnclab.design.drawing.view import (
    Angle,
    Axis,
    Cross,
    Diameter,
    Kind,
    Linear,
    Note,
    Point,
    Value,
    ViewLine,
    number,
    thread_circle,
    value,
)
from mnclab.design.model.feature import Feature
from mnclab.design.model.features import Chamfer, Groove, Pocket, Slot, along
from mnclab.design.model.holes import Hole, core_of
from mnclab.design.model.measures import Measure
from mnclab.design.model.shapes import Circle, Outline, Rectangle, Shape
from mnclab.geometry.contours import Contour

if TYPE_CHECKING:
    from mnclab.design.drawing.milled_features import Side


def feature_marks(draft: Draft, feature: Feature) -> None:
    """Centre lines, and the thin lines of a thread."""
    shape = feature.shape
    if isinstance(feature, Hole):
        wide = feature.mouth
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
        draft.lines.append(ViewLine(feature.contour.contour, Kind.CENTRE))


def shape_marks(draft: Draft, shape: Shape, wider: float = 0.0) -> None:
    """The centre lines of a circle or a rectangle."""
    if isinstance(shape, Circle):
        draft.axes.append(Cross((shape.x, shape.y), (shape.diameter + wider) / 2))
    elif isinstance(shape, Rectangle):
        at, a, b = frame_at((shape.x, shape.y), shape.turned), shape.length / 2, shape.width / 2
        draft.axes += [Axis(at(-a, 0), at(a, 0)), Axis(at(0, -b), at(0, b))]


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


# Equal holes in patterns, as drawings dimension them: evenly on a circle by its diameter, in equal steps by their number.

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
    for axis, some, other, datum in zip("xy", (pattern.x, pattern.y), (pattern.y, pattern.x), side.datum):
        at = {k: getattr(side.features[k], axis) for k in numbers}
        first = min((some[0], *some), key=lambda each: abs(each - datum) > 2 * SAME)  # a hole at the zero point says where
        rest = [k for k in numbers if _even(some) and abs(at[k] - first) > 2 * SAME]
        for k in sorted({*numbers} - {*rest}):
            side.place(k, axis)
        if not _even(some):
            continue
        count, whole = len(some) - 1, some[-1] - some[0]
        text = f"{count}{TIMES} {number(whole / count)} (={number(whole)})"
        ends = [(each, other[0]) if axis == "x" else (other[0], each) for each in (some[0], some[-1])]
        told = Linear(ends[0], ends[1], Value(text), axis, "below" if axis == "x" else "left")
        side.ledger.say_once(side.draft, told, side.claims(rest, axis))


def _write_ring(side: Side, numbers: Sequence[int], ring: Ring) -> None:
    (cx, cy), radius = ring.centre, ring.radius
    side.draft.lines.append(ViewLine(Contour.circle(ring.centre, radius), Kind.CENTRE))
    told = Diameter(ring.centre, radius, value(2 * radius, DIAMETER))
    side.ledger.say(side.draft, told, side.claims(numbers, "x", "y"))
    for axis, at in (("x", cx), ("y", cy)):
        side.places[axis].append((Measure(axis, at, "place"), ring.centre, None))
    quarters = [(ring.first + k * math.tau / len(numbers)) % (math.pi / 2) for k in range(len(numbers))]
    if min(min(angle, math.pi / 2 - angle) for angle in quarters) * radius < SAME:
        return  # one stands on a centre line, which says how they are turned
    level, hole = (cx + radius, cy), (cx + radius * math.cos(ring.first), cy + radius * math.sin(ring.first))
    side.draft.lines.append(ViewLine(Contour([ring.centre, level], closed=False), Kind.THIN))
    side.draft.dimensions.append(Angle(ring.centre, level, hole, value(math.degrees(ring.first), after="°")))


# Tables beside the views: holes, corners of outlines, and all features where a view has no room for them.

MOST, FEW = 30, 8  # corners of outlines on one side that are all told; of one outline that always are


def hole_table(side: Side, holes: list[int]) -> None:
    """Every hole by its place and sizes, numbered in the view."""
    title = "holes from below" if side.back else "holes"
    x, y = side.datum
    rows = []
    for row, k in enumerate(holes):
        hole = side.features[k]
        assert isinstance(hole, Hole)
        label = f"{'B' if side.back else 'A'}{row + 1}"
        known = {each.name: each for each in hole.measures()}
        text = "  ".join(hole_lines(hole))
        side.draft.dimensions.append(Note((hole.x, hole.y), (label,), hole.mouth / 2))
        rows.append((label, _said(known["x"], x), _said(known["y"], y), text))
        for column, names in ((1, ("x",)), (2, ("y",)), (3, ())):
            side.ledger.cell(title, row, column, side.claims([k], *names))
        side.tops([k])
    side.ledger.tables.append(Table(title, ("No.", "X", "Y", "hole"), tuple(rows)))


def feature_table(side: Side, numbers: list[int]) -> None:
    """Every feature by its measures: where a view has no room for them."""
    title = "features from below" if side.back else "features"
    rows: list[tuple[str, ...]] = []
    for k in numbers:
        feature, name, row = side.features[k], side.names()[k], len(rows)
        rows.append(_table_row(side, row, feature.outline, feature.shape, feature.measures(), name))
        for column, names in ((1, ("x",)), (2, ("y",))):
            side.ledger.cell(title, row, column, side.claims([k], *names))
        side.ledger.cell(title, row, 3, [*side.claims([k]), *side.claims([k], "top")])
        if isinstance(feature.shape, Outline):
            corner_table(side, feature.shape, (), k)
        for n, island in enumerate(feature.islands if isinstance(feature, Pocket) else (), 1):
            if isinstance(island, Outline):
                corner_table(side, island, (), k, f"island {n} of {name}")
            else:
                told = tuple(island.measures()), f"island of {rows[row][0]}"
                rows.append(_table_row(side, len(rows), island.contour, island, *told))
    side.ledger.tables.append(Table(title, ("No.", "X", "Y", "feature"), tuple(rows)))


def _table_row(side: Side, row: int, line: Any, shape: Any, measures: Sequence[Measure], name: str) -> tuple[str, ...]:
    """A row of the table of features, and its number in the view."""
    (x, y), label = side.datum, f"{'B' if side.back else 'A'}{row + 1}"
    assert line is not None  # a table holds what has a place
    at = line.point_at(0.35 * line.length)[0]
    to = Note((shape.x, shape.y), (label,), shape.diameter / 2) if isinstance(shape, Circle) else Note(point_of(at), (label,))
    side.draft.dimensions.append(to)
    known = {each.name: each for each in measures if each.kind == "place"}
    said = [each for each in measures if each.kind != "place" or each.name == "top"]
    told = [written(each) if each.name in SIGNS else f"{each.name} {written(each)}" for each in said]
    return label, _said(known["x"], x), _said(known["y"], y), f"{name}: {', '.join(told)}"


def corner_table(side: Side, shape: Outline, measures: Sequence[Measure], k: int, title: str = "") -> None:
    """Numbered corners, and a table of them; with `measures` its middle and sizes below.

    Where a side has more than `MOST` corners, as with contours made of chords, the table of a long contour has every second,
    third, … of its points, and says so.
    """
    title, line = title or f"contour of {side.names()[k]}", shape.contour
    each = -(-_corners(side) // MOST) if len(line.points) > FEW else 1
    if each > 1:
        title += f": 1 of every {each} of its {len(line.points)} points"
    letter = chr(97 + len(side.ledger.tables) % 26)
    x, y = side.datum
    rows = []
    radii = line.radii.tolist()
    for n, (px, py) in list(enumerate(line.points.tolist()))[::each]:
        label = f"{letter}{n + 1}"
        side.draft.dimensions.append(Note((px, py), (label,)))
        bend = line.bulge[n] if n < len(line.bulge) else 0.0
        arc = f"R{number(radii[n])} {'ccw' if bend > 0 else 'cw'}" if n < len(radii) and bend else ""
        rows.append((label, number(px - x), number(py - y), arc))
    known = {each.name: each for each in measures}
    if known:
        rows.append(("middle", _said(known["x"], x), _said(known["y"], y), ""))
        length, width = (name if name in known else along(name) for name in ("length", "width"))
        rows.append(("size", written(known[length]), written(known[width]), ""))
        for row, names in ((len(rows) - 2, ("x", "y")), (len(rows) - 1, (length, width))):
            for column, name in enumerate(names, 1):
                side.ledger.cell(title, row, column, side.claims([k], name))
    side.ledger.tables.append(Table(title, ("No.", "X", "Y", "arc to next"), tuple(rows)))


def _corners(side: Side) -> int:
    """How many corners the outlines of a side have together."""
    shapes = [each.shape for each in side.features]
    shapes += [island for each in side.features if isinstance(each, Pocket) for island in each.islands]
    return sum(len(each.points) for each in shapes if isinstance(each, Outline))


def _said(measure: Measure, datum: float) -> str:
    return written(measure._replace(nominal=measure.nominal - datum))
