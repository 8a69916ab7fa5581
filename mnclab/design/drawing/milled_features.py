"""The dimensions of the features of one side of a milled part, in the view on that side and in the section."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from mnclab.design.drawing.feature_marks import (
    centre_of,
    corner_table,
    direction_of,
    feature_marks,
    feature_table,
    frame_at,
    hole_table,
    pattern_of,
    point_of,
    shape_marks,
    write_pattern,
)  # fmt: skip
from mnclab.design.drawing.ledger import (
    DIAMETER,
    SAME,
    Claim,
    Draft,
    Ledger,
    at_place,
    chamfer_text,
    claims_of,
    hole_lines,
    times,
    valued,
    written,
)
from mnclab.design.drawing.view import Angle, Diameter, Kind, Linear, Note, Origin, Point, Radius, ViewLine
from mnclab.design.model.design import Design
from mnclab.design.model.feature import Feature
from mnclab.design.model.features import Chamfer, Face, Groove, Pocket, Slope, Slot, Stud, along
from mnclab.design.model.holes import Hole, core_of
from mnclab.design.model.measures import Measure
from mnclab.design.model.shapes import Circle, Outline, Rectangle, Shape
from mnclab.geometry.contours import Contour

MOST_HOLES = 10  # with dimensions of their own; more stand in a table
MOST_PLACES = 9  # coordinates in one direction
MOST_KINDS = 14  # different features with dimensions of their own; more stand in a table


Place = tuple[Measure, Point, Claim | None]  # a coordinate, whose it is, and the measure that it says, if it is one


@dataclass
class DepthLine:
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
    places: dict[str, list[Place]] = field(default_factory=lambda: {"x": [], "y": []})
    levels: list[DepthLine] = field(default_factory=list)
    side_levels: list[DepthLine] = field(default_factory=list)

    @property
    def features(self) -> Sequence[Feature]:
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
        return claims_of(self.features, numbers, names, self.back)

    def write(self) -> None:
        """All of it."""
        alike: dict[Any, list[int]] = {}
        for k, each in enumerate(self.features):
            key = type(each), tuple(m for m in each.measures() if m.kind != "place" or m.name == "top")
            alike.setdefault((*key, k) if isinstance(each.shape, Outline) else key, []).append(k)
        patterns = {tuple(some): found for some in alike.values() if (found := pattern_of([self.features[k] for k in some]))}
        ordered = {k for some in patterns for k in some}
        holes = [k for k, each in enumerate(self.features) if isinstance(each, Hole) and k not in ordered]
        coordinates = max(len({round(getattr(self.features[k], axis), 6) for k in holes}) for axis in "xy") if holes else 0
        if len([k for k, *_ in alike if not issubclass(k, Face | Chamfer)]) > MOST_KINDS:
            self.tabled = 2
        in_table = bool(holes) and (self.tabled > 0 or len(holes) > MOST_HOLES or coordinates > MOST_PLACES)
        for numbers in alike.values():
            first = self.features[numbers[0]]
            for k in numbers:
                feature_marks(self.draft, self.features[k])
            if self.tabled > 1 and not isinstance(first, Face | Chamfer):
                continue
            found = patterns.get(tuple(numbers))
            if found or not (isinstance(first, Hole) and in_table):
                self._sizes(first, numbers)
                self.tops(numbers)
                if found:
                    write_pattern(self, numbers, found)
                for k in () if found else numbers:
                    self.place(k)
        if self.tabled > 1:
            feature_table(self, [k for k, each in enumerate(self.features) if not isinstance(each, Face | Chamfer)])
        elif in_table:
            hole_table(self, holes)
        self.ledger.once(self.draft)
        self._coordinates()

    # ---- sizes ----

    def _sizes(self, first: Feature, numbers: list[int]) -> None:
        known = {each.name: each for each in reversed(first.measures())}
        shape = first.shape
        if isinstance(first, Face):
            self._level(numbers, self.design.outline_of_blank.loops[0])
        elif isinstance(first, Chamfer):
            line = first.contour.contour
            at = line.point_at(0.3 * line.lengths[0])[0]
            note = Note(point_of(at), (times(len(numbers)) + chamfer_text(first.measures()),))
            self.ledger.say(self.draft, note, self.claims(numbers, "width", "angle"))
        elif isinstance(first, Hole):
            self._hole(first, numbers)
        elif isinstance(first, Slot):
            self._slot(first, known, numbers)
            self._deep(numbers, first.outline)
        elif isinstance(first, Groove):
            self._groove(first, numbers)
        elif isinstance(first, Slope):
            self._rectangle(first.contour, known, numbers)
            self._fall(first, known, numbers)
        elif shape is not None:
            # at a leader a depth counts from the upper side; where it begins deeper only a section says from where, and that of a
            # floor where others begin stands there in any case
            plain = isinstance(shape, Circle) and not isinstance(first, Stud) and first.top is None
            deep = plain and all(abs(self.top(first) - known["depth"].nominal - self.top(each)) > SAME for each in self.features)
            self._shape(shape, first.measures(), numbers, (written(known["depth"]),) if deep else ())
            if not deep:
                self._deep(numbers, shape.contour)
            for n, island in enumerate(first.islands if isinstance(first, Pocket) else (), 1):
                self._island(island, numbers, n)

    def _island(self, shape: Shape, numbers: list[int], n: int) -> None:
        """What stays in a pocket is no measure of it, and is dimensioned all the same."""
        if isinstance(shape, Outline):
            corner_table(self, shape, (), numbers[0], f"island {n} of {self.names()[numbers[0]]}")
            return
        said, known = len(self.ledger.said), {each.name: each for each in shape.measures()}
        self._shape(shape, tuple(known.values()), numbers)
        del self.ledger.said[said:]
        shape_marks(self.draft, shape)
        for axis in "xy":
            self.places[axis].append((known[axis], (shape.x, shape.y), None))

    def _shape(self, shape: Shape, measures: Sequence[Measure], numbers: list[int], more: tuple[str, ...] = ()) -> None:
        known = {each.name: each for each in reversed(measures)}
        count = len(numbers)
        if isinstance(shape, Circle):
            told = Diameter((shape.x, shape.y), shape.diameter / 2, valued(known["diameter"], DIAMETER, count=count), more)
            self.ledger.say(self.draft, told, self.claims(numbers, "diameter", *(["depth"] if more else [])))
        elif isinstance(shape, Rectangle):
            self._rectangle(shape, known, numbers)
        else:
            corner_table(self, shape, measures, numbers[0])

    def _rectangle(self, shape: Rectangle, known: dict[str, Measure], numbers: list[int]) -> None:
        at = frame_at((shape.x, shape.y), shape.turned)
        a, b, count = shape.length / 2, shape.width / 2, len(numbers)
        straight = abs(shape.turned) < SAME
        for size, start, end, way, side in (
            ("length", (-a, b), (a, b), "x", "above"), ("width", (a, -b), (a, b), "y", "right"),
        ):  # fmt: skip
            name = size if size in known else along(size)
            said = Linear(at(*start), at(*end), valued(known[name], count=count), *((way, side) if straight else ("ab", "")))
            say = self.ledger.say_once if straight else self.ledger.say  # the blank's own where it goes from edge to edge
            say(self.draft, said, self.claims(numbers, name))
        if "corner radius" in known:
            r = shape.corner
            text = valued(known["corner radius"], "R", count=4 * count)
            told = Radius(at(a - r, b - r), r, math.radians(shape.turned), math.pi / 2, text)
            self.ledger.say(self.draft, told, self.claims(numbers, "corner radius"))
        if "angle" in known:
            self._angle((shape.x, shape.y), a, shape.turned, known["angle"], numbers)

    def _angle(self, centre: Point, reach: float, degrees: float, measure: Measure, numbers: list[int]) -> None:
        """From the level line through the centre to the axis; to the right of it clockwise, as the picture shows."""
        (x, y), turned = centre, degrees if -90 < degrees < 180 else degrees % 180
        way = math.radians(turned)
        level, axis = (x + reach, y), (x + reach * math.cos(way), y + reach * math.sin(way))
        self.draft.lines.append(ViewLine(Contour([centre, level], closed=False), Kind.THIN))
        told = Angle(centre, *((level, axis) if turned > 0 else (axis, level)), valued(measure, "", abs(turned), len(numbers)))
        self.ledger.say(self.draft, told, self.claims(numbers, "angle"))

    def _slot(self, slot: Slot, known: dict[str, Measure], numbers: list[int]) -> None:
        (x0, y0), (x1, y1) = slot.start, slot.end
        lean, count = math.degrees(math.atan2(y1 - y0, x1 - x0)), len(numbers)
        at, half, wide = frame_at(((x0 + x1) / 2, (y0 + y1) / 2), lean), math.dist(slot.start, slot.end) / 2, slot.width / 2
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
        width = Linear(point_of(at - aside), point_of(at + aside), valued(measures[0], count=len(numbers)), direction_of(aside))
        self.ledger.say(self.draft, width, [Claim(self.back, k, 0, "width") for k in numbers])
        self._deep(numbers, line)

    def _hole(self, hole: Hole, numbers: list[int]) -> None:
        wide = core_of(hole.thread, 0.0) if hole.thread else hole.mouth
        note = Note((hole.x, hole.y), hole_lines(hole, len(numbers)), wide / 2)
        self.ledger.say(self.draft, note, self.claims(numbers))

    # ---- depths ----

    def _deep(self, numbers: list[int], outline: Contour) -> None:
        """The depth in a section, or with a leader where it is not cut."""
        first = self.features[numbers[0]]
        depth = next(each for each in first.measures() if each.name == "depth")
        for shown, axis in ((self.shows, 0), (self.side_shows, 1)):
            cut = next((k for k in numbers if (self.back, k) in shown), None)
            if cut is not None or (isinstance(first, Stud) and axis == 0):
                line = outline if cut is None else self.features[cut].outline
                assert line is not None
                self._level(numbers, line, axis)
                return
        at = outline.point_at(0.35 * outline.length)[0]
        note = Note(point_of(at), (times(len(numbers)) + written(depth),))
        self.ledger.say(self.draft, note, self.claims(numbers, "depth"))

    def _fall(self, slope: Slope, known: dict[str, Measure], numbers: list[int]) -> None:
        """The depths at both ends: in the section along it, or with leaders."""
        cut = next((self.features[k] for k in numbers if (self.back, k) in self.shows), None)
        for name, side in (("start depth", -1), ("end depth", 1)):
            depth, claims = known[name], self.claims(numbers, name)
            if isinstance(cut, Slope) and abs(math.remainder(cut.turned, 180)) < SAME:
                x, y = frame_at((cut.x, cut.y), cut.turned)(side * cut.length / 2, 0.0)
                u = float((self.design.flip[0] @ [x, y, 1.0])[0]) if self.back else x
                top = self.top(slope)
                self.levels.append(DepthLine(self._across(top), self._across(top - depth.nominal), u, depth, claims))
            else:
                at = frame_at((slope.x, slope.y), slope.turned)(0.47 * side * slope.length, 0.3 * slope.width)
                self.ledger.say(self.draft, Note(at, (times(len(numbers)) + written(depth),)), claims)

    def _level(self, numbers: list[int], line: Contour, axis: int = 0) -> None:
        """A depth in the section, at that wall of an outline which is nearer to the edge of the part."""
        first = self.features[numbers[0]]
        depth = next(each for each in first.measures() if each.name == "depth")
        low, high = self._across(self.top(first)), self._across(self.top(first) - depth.nominal)
        level = DepthLine(low, high, self._wall(line, axis), depth, self.claims(numbers, "depth"))
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

    def tops(self, numbers: list[int]) -> None:
        """From where depths count: the floor of another feature, else a height of its own."""
        first = self.features[numbers[0]]
        if first.top is None:
            return
        measure = next(each for each in first.measures() if each.name == "top")
        line = first.outline or self.design.outline_of_blank.loops[0]
        start, end = self._across(float(self.design.bounds[1, 2])), self._across(first.top)
        self.levels.append(DepthLine(start, end, self._wall(line, 0), measure, self.claims(numbers, "top")))

    # ---- places ----

    def place(self, k: int, axes: str = "xy") -> None:
        """The coordinates of a feature are dimensioned, but those that follow from a length which begins at an edge."""
        shape = self.features[k].shape
        if isinstance(shape, Outline):
            return
        centre = centre_of(self.features[k])
        for place, each in enumerate(self.features[k].measures()):
            if each.name in self.places and each.name in axes:
                claim, known = Claim(self.back, k, place, each.name), self._from_edge(k, each)
                self.places[each.name] += [] if known else [(each, centre, claim)]
                known.append(claim)

    def _from_edge(self, k: int, place: Measure) -> list[Claim]:
        """The claims of a length of a feature that begins at an edge and has a place in its middle; none without one."""
        axis = "xy".index(place.name)
        edges = self.datum[axis], *self.design.bounds[:, axis].tolist()
        for said, claims in self.ledger.said if not (place.limits or place.fit) else ():
            if isinstance(said, Linear) and said.along == place.name and any(c[:2] == (self.back, k) for c in claims):
                a, b = said.a[axis], said.b[axis]
                if abs((a + b) / 2 - place.nominal) < SAME and min(abs(end - edge) for end in (a, b) for edge in edges) < SAME:
                    return claims
        return []

    def _coordinates(self) -> None:
        """One dimension for each distance from the datum."""
        x, y = self.datum
        self.draft.axes.append(Origin((x, y)))
        for axis, (name, datum) in enumerate((("x", x), ("y", y))):
            same: dict[Any, list[Place]] = {}
            for each in self.places[name]:
                same.setdefault((round(each[0].nominal, 6), each[0].limits, each[0].fit), []).append(each)
            for found in same.values():
                claims = [claim for *_, claim in found if claim]
                measure = found[0][0]
                if abs(measure.nominal - datum) < SAME:
                    self.ledger.at_zero(self.draft, (x, y), claims)
                    continue
                point = min((place for _, place, _ in found), key=lambda place: place[1 - axis])
                low = self.design.bounds[0, :2].tolist()
                start = (x, low[1]) if axis == 0 else (low[0], y)
                told = Linear(start, point, at_place(measure, datum), name, "below" if axis == 0 else "left")
                self.ledger.say(self.draft, told, claims)
