"""The dimensions of the features of one side of a milled part, in the view on that side and in the section."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from mnclab.geometry.contours import Contour
from mnclab.show.drawing.dimensions import Angle, Diameter, Linear, Note, Point, Radius, Value
from mnclab.show.drawing.ledger import Claim, Draft, Ledger
from mnclab.show.drawing.sheet import Table
from mnclab.show.drawing.view import Axis, Cross, Kind, Line, Origin, thread_circle
from mnclab.show.drawing.wording import DIAMETER, at_place, chamfer_text, hole_lines, plain, times, valued, written
from mnclab.workpiece.design.design import Design
from mnclab.workpiece.design.features import Chamfer, Face, Feature, Groove, Hole, Pocket, Slot, Stud
from mnclab.workpiece.design.measures import Measure
from mnclab.workpiece.design.shapes import Circle, Outline, Rectangle, Shape
from mnclab.workpiece.design.threads import core_of

SAME = 1e-6  # mm
MOST_HOLES = 10  # with dimensions of their own; more stand in a table
MOST_PLACES = 9  # coordinates in one direction


@dataclass
class Level:
    """A depth in the section: from a height to a height, at the wall u."""

    start: float
    end: float
    u: float
    measure: Measure
    claims: list[Claim]


@dataclass
class Side:
    """The features of one side, seen from there; `shows` and `side_shows` are those that the sections cut through the middle."""

    design: Design
    back: bool
    draft: Draft
    ledger: Ledger
    shows: frozenset[tuple[bool, int]]
    side_shows: frozenset[tuple[bool, int]]
    tabled: int
    places: dict[str, list[tuple[Measure, Point, Claim]]] = field(default_factory=lambda: {"x": [], "y": []})
    levels: list[Level] = field(default_factory=list)
    side_levels: list[Level] = field(default_factory=list)

    @property
    def features(self) -> tuple[Feature, ...]:
        return self.design.back if self.back else self.design.features

    @property
    def datum(self) -> Point:
        """Where coordinates count from: the zero point if it is on the part, else the lower left corner of the blank."""
        low, high = self.design.bounds[:, :2]
        x, y = (0.0 if a - SAME <= 0 <= b + SAME else a for a, b in zip(low.tolist(), high.tolist(), strict=True))
        return x, y

    def names(self) -> tuple[str, ...]:
        return self.design.drawn_names(self.back)

    def top(self, feature: Feature) -> float:
        return float(self.design.bounds[1, 2]) if feature.top is None else feature.top

    def claims(self, numbers: Sequence[int], *names: str) -> list[Claim]:
        """The measures of these names, or all but places, of equal features."""
        return [
            Claim(self.back, k, place, each.name)
            for k in numbers
            for place, each in enumerate(self.features[k].measures())
            if (each.name in names if names else each.kind != "place")
        ]

    def write(self) -> None:
        """All of it."""
        alike: dict[Any, list[int]] = {}
        for k, each in enumerate(self.features):
            key = type(each), tuple(m for m in each.measures() if m.kind != "place" or m.name == "top")
            alike.setdefault((*key, k) if isinstance(_shape(each), Outline) else key, []).append(k)
        holes = [k for k, each in enumerate(self.features) if isinstance(each, Hole)]
        coordinates = max(len({round(getattr(self.features[k], axis), 6) for k in holes}) for axis in "xy") if holes else 0
        in_table = bool(holes) and (self.tabled > 0 or len(holes) > MOST_HOLES or coordinates > MOST_PLACES)
        for numbers in alike.values():
            first = self.features[numbers[0]]
            for k in numbers:
                self._marks(self.features[k])
            if self.tabled > 1 and not isinstance(first, Face | Chamfer):
                continue
            if not (isinstance(first, Hole) and in_table):
                self._sizes(first, numbers)
                self._tops(numbers)
                for k in numbers:
                    self._place(k)
        if self.tabled > 1:
            self._table([k for k, each in enumerate(self.features) if not isinstance(each, Face | Chamfer)])
        elif in_table:
            self._hole_table(holes)
        self._coordinates()

    # ---- sizes ----

    def _sizes(self, first: Feature, numbers: list[int]) -> None:
        known = {each.name: each for each in reversed(first.measures())}
        shape = _shape(first)
        if isinstance(first, Face):
            self._level(numbers, self.design.outline_of_blank.loops[0])
        elif isinstance(first, Chamfer):
            line = first.contour.contour
            at = line.point_at(line.lengths[0] / 2)[0]
            note = Note(_point(at), (times(len(numbers)) + chamfer_text(first.measures()),))
            self.ledger.say(self.draft, note, self.claims(numbers, "width", "angle"))
        elif isinstance(first, Hole):
            self._hole(first, numbers)
        elif isinstance(first, Slot):
            self._slot(first, known, numbers)
            self._deep(numbers, first.outline)
        elif isinstance(first, Groove):
            self._groove(first, numbers)
        elif shape is not None:
            deep = isinstance(shape, Circle) and not isinstance(first, Stud)
            self._shape(shape, first.measures(), numbers, (written(known["depth"]),) if deep else ())
            if not deep:
                self._deep(numbers, shape.contour)

    def _shape(self, shape: Shape, measures: Sequence[Measure], numbers: list[int], more: tuple[str, ...] = ()) -> None:
        known = {each.name: each for each in reversed(measures)}
        count = len(numbers)
        if isinstance(shape, Circle):
            told = Diameter((shape.x, shape.y), shape.diameter / 2, valued(known["diameter"], DIAMETER, count=count), more)
            self.ledger.say(self.draft, told, self.claims(numbers, "diameter", *(["depth"] if more else [])))
        elif isinstance(shape, Rectangle):
            self._rectangle(shape, known, numbers)
        else:
            self._corners(shape, measures, numbers[0])

    def _rectangle(self, shape: Rectangle, known: dict[str, Measure], numbers: list[int]) -> None:
        at = _frame((shape.x, shape.y), shape.turned)
        a, b, count = shape.length / 2, shape.width / 2, len(numbers)
        straight = abs(shape.turned) < SAME
        for name, start, end, along, side in (
            ("length", (-a, b), (a, b), "x", "above"), ("width", (a, -b), (a, b), "y", "right"),
        ):  # fmt: skip
            said = Linear(at(*start), at(*end), valued(known[name], count=count), along if straight else "ab", side if straight else "")
            self.ledger.say(self.draft, said, self.claims(numbers, name))
        if "corner radius" in known:
            r = shape.corner
            told = Radius(at(a - r, b - r), r, math.radians(shape.turned), math.pi / 2, valued(known["corner radius"], "R", count=4 * count))
            self.ledger.say(self.draft, told, self.claims(numbers, "corner radius"))
        if "angle" in known:
            self._angle((shape.x, shape.y), a, shape.turned, known["angle"], numbers)

    def _angle(self, centre: Point, reach: float, degrees: float, measure: Measure, numbers: list[int]) -> None:
        """From the level line through the centre to the axis."""
        x, y = centre
        level, turned = (x + reach, y), (x + reach * math.cos(math.radians(degrees)), y + reach * math.sin(math.radians(degrees)))
        self.draft.lines.append(Line(Contour([centre, level], closed=False), Kind.THIN))
        legs = (level, turned) if degrees % 360 < 180 else (turned, level)
        size = degrees % 360 if degrees % 360 < 180 else 360 - degrees % 360
        told = Angle(centre, *legs, valued(measure, "", measure.nominal if measure.nominal > 0 else -size, len(numbers)))
        self.ledger.say(self.draft, told, self.claims(numbers, "angle"))

    def _slot(self, slot: Slot, known: dict[str, Measure], numbers: list[int]) -> None:
        (x0, y0), (x1, y1) = slot.start, slot.end
        lean, count = math.degrees(math.atan2(y1 - y0, x1 - x0)), len(numbers)
        at, half, wide = _frame(((x0 + x1) / 2, (y0 + y1) / 2), lean), math.dist(slot.start, slot.end) / 2, slot.width / 2
        along = {0.0: ("x", "y"), 90.0: ("y", "x")}.get(round(lean % 180, 6) % 180, ("ab", "ab"))
        length = Linear(slot.start, slot.end, valued(known["length"], count=count), along[0])
        self.ledger.say(self.draft, length, self.claims(numbers, "length"))
        width = Linear(at(half / 2, -wide), at(half / 2, wide), valued(known["width"], count=count), along[1])
        self.ledger.say(self.draft, width, self.claims(numbers, "width"))
        if "angle" in known and along[0] == "ab":
            self._angle(at(0, 0), half, lean % 180, known["angle"], numbers)
        elif "angle" in known:  # upright, as the drawing shows: it goes with the length
            self.ledger.said[-2][1].extend(self.claims(numbers, "angle"))

    def _groove(self, groove: Groove, numbers: list[int]) -> None:
        measures = groove.measures()
        shape, wide = groove.contour, groove.width / 2
        self._shape(shape, measures[1:], numbers)
        line = shape.contour
        at, ahead = line.point_at(0.0)
        aside = np.array([-ahead[1], ahead[0]]) * wide
        width = Linear(_point(at - aside), _point(at + aside), valued(measures[0], count=len(numbers)), _along(aside))
        self.ledger.say(self.draft, width, [Claim(self.back, k, 0, "width") for k in numbers])
        self._once(measures, numbers)
        self._deep(numbers, line)

    def _once(self, measures: Sequence[Measure], numbers: list[int]) -> None:
        """The width of a groove along a rectangle is another than that of the rectangle."""
        for _, claims in self.ledger.said[:-1]:
            claims[:] = [each for each in claims if not (each.back == self.back and each.feature in numbers and each.place == 0)]

    def _hole(self, hole: Hole, numbers: list[int]) -> None:
        wide = max(hole.wide, (hole.counterbore or (0.0,))[0], (hole.countersink or (0.0,))[0])
        note = Note((hole.x, hole.y), hole_lines(hole, len(numbers)), (core_of(hole.thread, 0.0) if hole.thread else wide) / 2)
        self.ledger.say(self.draft, note, self.claims(numbers))

    # ---- depths ----

    def _deep(self, numbers: list[int], outline: Contour) -> None:
        """The depth in a section, or with a leader where it is not cut."""
        first = self.features[numbers[0]]
        depth = next(each for each in first.measures() if each.name == "depth")
        for shown, axis in ((self.shows, 0), (self.side_shows, 1)):
            cut = next((k for k in numbers if (self.back, k) in shown), None)
            if cut is not None or (isinstance(first, Stud) and axis == 0):
                line = outline if cut is None else _outline(self.features[cut])
                assert line is not None
                self._level(numbers, line, axis)
                return
        at = outline.point_at(0.35 * outline.length)[0]
        note = Note(_point(at), (times(len(numbers)) + written(depth),))
        self.ledger.say(self.draft, note, self.claims(numbers, "depth"))

    def _level(self, numbers: list[int], line: Contour, axis: int = 0) -> None:
        """A depth in the section, at that wall of an outline which is nearer to the edge of the part."""
        first = self.features[numbers[0]]
        depth = next(each for each in first.measures() if each.name == "depth")
        low, high = self._across(self.top(first)), self._across(self.top(first) - depth.nominal)
        level = Level(low, high, self._wall(line, axis), depth, self.claims(numbers, "depth"))
        (self.side_levels if axis else self.levels).append(level)

    def _wall(self, line: Contour, axis: int) -> float:
        if self.back:
            line = line.transformed(self.design.flip[0])
        low, high = line.bounds[:, axis].tolist()
        middle = float(self.design.bounds[:, axis].mean())
        wall = low if abs(low - middle) > abs(high - middle) else high
        return -wall if axis else wall

    def _across(self, z: float) -> float:
        """A height as the section shows it."""
        return self.design.flip[1] - z if self.back else z

    def _tops(self, numbers: list[int]) -> None:
        """From where depths count: the floor of another feature, else a height of its own."""
        first = self.features[numbers[0]]
        if first.top is None:
            return
        measure = next(each for each in first.measures() if each.name == "top")
        line = _outline(first) or self.design.outline_of_blank.loops[0]
        start, end = self._across(float(self.design.bounds[1, 2])), self._across(first.top)
        self.levels.append(Level(start, end, self._wall(line, 0), measure, self.claims(numbers, "top")))

    # ---- places ----

    def _marks(self, feature: Feature) -> None:
        """Centre lines, and the thin lines of a thread."""
        shape = _shape(feature)
        if isinstance(feature, Hole):
            wide = max(feature.wide, (feature.counterbore or (0.0,))[0], (feature.countersink or (0.0,))[0])
            if feature.thread:
                self.draft.lines.append(thread_circle((feature.x, feature.y), core_of(feature.thread, 0.0) / 2))
                wide = max(wide, core_of(feature.thread, 0.0))
            self.draft.axes.append(Cross((feature.x, feature.y), wide / 2))
        elif isinstance(feature, Slot):
            at = _frame(feature.start, math.degrees(math.atan2(feature.end[1] - feature.start[1], feature.end[0] - feature.start[0])))
            half, length = feature.width / 2, math.dist(feature.start, feature.end)
            self.draft.axes.append(Axis(at(-half, 0), at(length + half, 0)))
            self.draft.axes += [Axis(at(u, -half), at(u, half)) for u in (0.0, length / 2, length)]
        elif isinstance(shape, Circle):
            wide = shape.diameter + (feature.width if isinstance(feature, Groove) else 0.0)
            self.draft.axes.append(Cross((shape.x, shape.y), wide / 2))
        elif isinstance(shape, Rectangle) and not isinstance(feature, Chamfer):
            at, a, b = _frame((shape.x, shape.y), shape.turned), shape.length / 2, shape.width / 2
            self.draft.axes += [Axis(at(-a, 0), at(a, 0)), Axis(at(0, -b), at(0, b))]
        if isinstance(feature, Groove):
            self.draft.lines.append(Line(feature.contour.contour, Kind.CENTRE))

    def _place(self, k: int) -> None:
        shape = _shape(self.features[k])
        if isinstance(shape, Outline):
            return
        centre = _centre(self.features[k])
        for place, each in enumerate(self.features[k].measures()):
            if each.name in self.places:
                self.places[each.name].append((each, centre, Claim(self.back, k, place, each.name)))

    def _coordinates(self) -> None:
        """One dimension for each distance from the datum."""
        x, y = self.datum
        self.draft.axes.append(Origin((x, y)))
        for axis, (name, datum) in enumerate((("x", x), ("y", y))):
            same: dict[Any, list[tuple[Measure, Point, Claim]]] = {}
            for each in self.places[name]:
                same.setdefault((round(each[0].nominal, 6), each[0].limits, each[0].fit), []).append(each)
            for found in same.values():
                claims = [claim for *_, claim in found]
                measure = found[0][0]
                if abs(measure.nominal - datum) < SAME:
                    self.ledger.at_zero(self.draft, (x, y), claims)
                    continue
                point = min((place for _, place, _ in found), key=lambda place: place[1 - axis])
                low = self.design.bounds[0, :2].tolist()
                start = (x, low[1]) if axis == 0 else (low[0], y)
                told = Linear(start, point, at_place(measure, datum), name, "below" if axis == 0 else "left")
                self.ledger.say(self.draft, told, claims)

    # ---- tables ----

    def _hole_table(self, holes: list[int]) -> None:
        title = "holes from below" if self.back else "holes"
        x, y = self.datum
        rows = []
        for row, k in enumerate(holes):
            hole = self.features[k]
            assert isinstance(hole, Hole)
            label = f"{'B' if self.back else 'A'}{row + 1}"
            known = {each.name: each for each in hole.measures()}
            text = "  ".join(hole_lines(hole))
            wide = max(hole.wide, (hole.counterbore or (0.0,))[0], (hole.countersink or (0.0,))[0])
            self.draft.dimensions.append(Note((hole.x, hole.y), (label,), wide / 2))
            rows.append((label, _said(known["x"], x), _said(known["y"], y), text))
            for column, names in ((1, ("x",)), (2, ("y",)), (3, ())):
                self.ledger.cell(title, row, column, self.claims([k], *names))
            self._tops([k])
        self.ledger.tables.append(Table(title, ("No.", "X", "Y", "hole"), tuple(rows)))

    def _table(self, numbers: list[int]) -> None:
        """Every feature by its measures: where a view has no room for them."""
        title = "features from below" if self.back else "features"
        rows = []
        x, y = self.datum
        for row, k in enumerate(numbers):
            feature = self.features[k]
            label = f"{'B' if self.back else 'A'}{row + 1}"
            line = _outline(feature)
            at = line.point_at(0.35 * line.length)[0]
            self.draft.dimensions.append(Note(_point(at), (label,)))
            known = {each.name: each for each in feature.measures() if each.kind == "place"}
            told = [f"{each.name} {written(each)}" for each in feature.measures() if each.kind != "place" or each.name == "top"]
            rows.append((label, _said(known["x"], x), _said(known["y"], y), f"{self.names()[k]}: {', '.join(told)}"))
            for column, names in ((1, ("x",)), (2, ("y",))):
                self.ledger.cell(title, row, column, self.claims([k], *names))
            self.ledger.cell(title, row, 3, [*self.claims([k]), *self.claims([k], "top")])
            shape = _shape(feature)
            if isinstance(shape, Outline):
                self._corners(shape, (), k)
        self.ledger.tables.append(Table(title, ("No.", "X", "Y", "feature"), tuple(rows)))

    def _corners(self, shape: Outline, measures: Sequence[Measure], k: int) -> None:
        """Numbered corners, and a table of them; with `measures` its middle and sizes below."""
        title, line = f"contour of {self.names()[k]}", shape.contour
        letter = f"{chr(97 + k % 26)}"
        x, y = self.datum
        rows = []
        radii = line.radii.tolist()
        for n, (px, py) in enumerate(line.points.tolist()):
            label = f"{letter}{n + 1}"
            self.draft.dimensions.append(Note((px, py), (label,)))
            bend = line.bulge[n] if n < len(line.bulge) else 0.0
            arc = f"R{plain(radii[n])} {'ccw' if bend > 0 else 'cw'}" if n < len(radii) and bend else ""
            rows.append((label, plain(px - x), plain(py - y), arc))
        known = {each.name: each for each in measures}
        if known:
            rows.append(("middle", _said(known["x"], x), _said(known["y"], y), ""))
            rows.append(("size", written(known["length"]), written(known["width"]), ""))
            for row, names in ((len(rows) - 2, ("x", "y")), (len(rows) - 1, ("length", "width"))):
                for column, name in enumerate(names, 1):
                    claims = [c for c in self.claims([k], name) if not (isinstance(self.features[k], Groove) and c.place == 0)]
                    self.ledger.cell(title, row, column, claims)
        self.ledger.tables.append(Table(title, ("No.", "X", "Y", "arc to next"), tuple(rows)))


def _said(measure: Measure, datum: float) -> str:
    return written(measure._replace(nominal=measure.nominal - datum))


def _shape(feature: Feature) -> Shape | None:
    return feature.contour if isinstance(feature, Pocket | Stud | Groove | Chamfer) else None


def _outline(feature: Feature) -> Contour | None:
    """What a feature takes up in its view."""
    if isinstance(feature, Hole):
        return Contour.circle((feature.x, feature.y), feature.wide / 2)
    if isinstance(feature, Slot):
        return feature.outline
    shape = _shape(feature)
    return shape.contour if shape is not None else None


def _centre(feature: Feature) -> Point:
    known = {each.name: each.nominal for each in feature.measures()}
    return known.get("x", 0.0), known.get("y", 0.0)


def _frame(centre: Point, degrees: float) -> Callable[[float, float], Point]:
    c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    return lambda u, v: (centre[0] + u * c - v * s, centre[1] + u * s + v * c)


def _point(at: Any) -> Point:
    return float(at[0]), float(at[1])


def _along(way: Any) -> str:
    return "x" if abs(way[1]) < SAME else "y" if abs(way[0]) < SAME else "ab"
