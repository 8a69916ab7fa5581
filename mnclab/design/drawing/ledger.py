"""Which measure of which feature is written where, and in what words: views as they are drafted, a record of what they say."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Sequence
from dataclasses import dataclass, field
from typing import Any, NamedTuple

import numpy as np

from mnclab.design.drawing.drawing import Drawing
from mnclab.design.drawing.ink import RADIUS
from mnclab.design.drawing.sheet import Printed, Table
from mnclab.design.drawing.view import (
    Axis,
    Cross,
    Cut,
    Dimension,
    Kind,
    Linear,
    Origin,
    Point,
    Tolerance,
    Value,
    View,
    ViewLine,
    value,
)
from mnclab.design.model.feature import Named
from mnclab.design.model.holes import Hole
from mnclab.design.model.measures import Measure
from mnclab.geometry.contours import Contour
from mnclab.geometry.curves import Floats
from mnclab.geometry.regions import Region

ORIGIN_BOX = RADIUS * np.array([(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)])  # mm about the zero point
SAME = 1e-6  # mm
BLANK = -1  # the number of the blank among the features


class Claim(NamedTuple):
    """A measure of a feature: one of the `back` or not, its number (`BLANK`), its place among the measures, its name."""

    back: bool
    feature: int
    place: int
    measure: str


class Dimensioned(NamedTuple):
    """Where a measure stands: the number of the feature (-1 the blank), whether one of the `back`, the name of the measure,
    the text, the sheet, and the corners `(4, 2)` of the text in mm from the lower left corner of the paper."""

    feature: int
    back: bool
    measure: str
    text: str
    sheet: int
    corners: Floats


@dataclass
class Draft:
    """A view while it is drawn."""

    name: str
    cell: tuple[int, int]
    title: str = ""
    free: bool = False
    lines: list[ViewLine] = field(default_factory=list)
    hatches: tuple[Region, ...] = ()
    dimensions: list[Dimension] = field(default_factory=list)
    axes: list[Axis | Cross | Origin] = field(default_factory=list)
    cuts: list[Cut] = field(default_factory=list)

    def draw(self, contours: Sequence[Contour], kind: Kind = Kind.VISIBLE) -> None:
        self.lines += [ViewLine(contour, kind) for contour in contours]

    def view(self) -> View:
        return View(
            self.name, tuple(self.lines), self.hatches, tuple(self.dimensions), tuple(self.axes), tuple(self.cuts), self.title,
            self.cell, self.free,
        )  # fmt: skip


@dataclass
class Ledger:
    """Dimensions and cells of tables with the measures that they say."""

    said: list[tuple[Any, list[Claim]]] = field(default_factory=list)
    tables: list[Table] = field(default_factory=list)
    cells: list[tuple[str, int, int, list[Claim]]] = field(default_factory=list)
    zeros: list[tuple[str, Point, list[Claim]]] = field(default_factory=list)

    def say(self, draft: Draft, dimension: Dimension, claims: Sequence[Claim]) -> None:
        draft.dimensions.append(dimension)
        self.said.append((dimension, list(claims)))

    def say_once(self, draft: Draft, dimension: Linear, claims: Sequence[Claim]) -> None:
        """The same, but where the view has a dimension of this value between such ends that one says these measures too."""
        for said, known in self.said:
            if said in draft.dimensions and _alike(said, dimension):
                known += claims
                return
        self.say(draft, dimension, claims)

    def once(self, draft: Draft) -> None:
        """A length that says no measure, such as that of an island, goes where another one says the same."""
        mine = {id(said) for said, _ in self.said}
        say = [each for each in draft.dimensions if id(each) in mine]
        alike = {id(b) for b in draft.dimensions if isinstance(b, Linear) and any(_alike(a, b) for a in say)}
        draft.dimensions = [each for each in draft.dimensions if id(each) in mine or id(each) not in alike]

    def cell(self, table: str, row: int, column: int, claims: Sequence[Claim]) -> None:
        """A cell of a table by its title; rows count from 0 below the head."""
        self.cells.append((table, row, column, list(claims)))

    def at_zero(self, draft: Draft, point: Point, claims: Sequence[Claim]) -> None:
        """Coordinates of 0: a feature on an axis through the zero point, which that axis says."""
        self.zeros.append((draft.name, point, list(claims)))

    def record(self, drawing: Drawing) -> tuple[Dimensioned, ...]:
        """Where everything came to stand."""
        texts: dict[int, list[Any]] = {}
        for box in drawing.boxes():
            if box.kind == "text" and box.of is not None:
                texts.setdefault(id(box.of), []).append(box)
        printed = {_title(each): each for sheet in drawing.sheets for each, _ in sheet.tables}
        width = {table.title: len(table.head) for table in self.tables}
        found = []
        for dimension, claims in self.said:
            mine = texts[id(dimension)]
            text = "\n".join(box.text for box in mine)
            found += [Dimensioned(c.feature, c.back, c.measure, text, mine[0].sheet, mine[0].corners) for c in claims]
        for title, row, column, claims in self.cells:
            box = texts[id(printed[title])][(row + 1) * width[title] + column]
            found += [Dimensioned(c.feature, c.back, c.measure, box.text, box.sheet, box.corners) for c in claims]
        views = {laid.view.name: (n, laid, at) for n, sheet in enumerate(drawing.sheets, 1) for laid, at in sheet.views}
        for name, point, claims in self.zeros:
            number, laid, at = views[name]
            corners = ORIGIN_BOX + np.array(point) * laid.scale + at
            found += [Dimensioned(c.feature, c.back, c.measure, "0", number, corners) for c in claims]
        return tuple(found)


def _alike(one: Any, other: Linear) -> bool:
    """Whether two dimensions along x or y have one value between ends that lie at the same places along it."""
    if not isinstance(one, Linear) or other.along == "ab" or (one.value, one.along) != (other.value, other.along):
        return False
    k = "xy".index(other.along)
    first, second = (sorted((each.a[k], each.b[k])) for each in (one, other))
    return all(abs(a - b) < SAME for a, b in zip(first, second, strict=True))


def claims_of(features: Sequence[Named], numbers: Iterable[int], names: Collection[str], back: bool = False) -> list[Claim]:
    """The measures of these names, or all but places, of some of the features of a side."""
    return [
        Claim(back, k, place, each.name)
        for k in numbers
        for place, each in enumerate(features[k].measures())
        if (each.name in names if names else each.kind != "place")
    ]


def _title(printed: Printed) -> str:
    return printed.labels[-1].text


# How the measures of features are written on a drawing: signs, tolerances, the lines of a hole.

GENERAL = 2  # decimals of what the general tolerances hold, which are coarser
DIAMETER, DEPTH, BORED, SUNK, TIMES = "⌀", "↧", "⌴", "⌵", "×"
SIGNS = {"diameter": DIAMETER, "radius": "R", "depth": DEPTH}


def tolerance_of(measure: Measure) -> Tolerance:
    """The tolerance as a drawing writes it: a class, ± or two deviations."""
    if measure.fit:
        return measure.fit
    if measure.limits is None:
        return None
    lower, upper = measure.limits
    return upper if abs(upper + lower) < 1e-12 else (lower, upper)


def valued(measure: Measure, before: str = "", nominal: float | None = None, count: int = 1) -> Value:
    """A measure as the value of a dimension; `count` of them are equal, `nominal` where it counts from elsewhere."""
    size = measure.nominal if nominal is None else nominal
    after, tolerance = "°" if measure.kind == "angle" else "", tolerance_of(measure)
    return value(size if tolerance else round(size, GENERAL), times(count) + before, tolerance, after=after)


def times(count: int) -> str:
    """What stands before the dimension of several equal features."""
    return f"{count}{TIMES} " if count > 1 else ""


def written(measure: Measure, before: str | None = None) -> str:
    """A measure in the line of a note: deviations one behind the other."""
    sign = SIGNS.get(measure.kind, "") if before is None else before
    if measure.text:
        return sign + measure.text.replace("x", TIMES)
    said = valued(measure, sign)
    if said.limits:
        upper, lower = said.limits
        return f"{said.text} {upper}/{lower}"
    space = "\N{THIN SPACE}" if said.tolerance else ""
    return f"{said.text}{space}{said.tolerance}"


def hole_lines(hole: Hole, count: int = 1) -> tuple[str, ...]:
    """What is written at a hole: "4× M8 ↧12" and "⌀6.8 ↧16", counterbore and countersink on lines of their own."""
    known = {each.name: each for each in hole.measures()}
    lines = []
    bore = written(known["diameter"])
    if "depth" in known:
        bore += " " + written(known["depth"])
    if "thread" in known:
        deep = [written(known["thread depth"])] if "thread depth" in known else []
        lines.append(" ".join([written(known["thread"], ""), *deep]))
    lines.append(bore)
    if "counterbore diameter" in known:
        lines.append(f"{BORED} {written(known['counterbore diameter'])} {written(known['counterbore depth'])}")
    if "countersink diameter" in known:
        lines.append(f"{SUNK} {written(known['countersink diameter'])}{TIMES}{written(known['countersink angle'])}")
    if "point angle" in known:
        lines.append(f"point {written(known['point angle'])}")
    return (times(count) + lines[0], *lines[1:])


def chamfer_text(measures: Sequence[Measure]) -> str:
    """"1×45°"; the angle is that of the face against the plane."""
    known = {each.name: each for each in measures}
    angle = written(known["angle"]) if "angle" in known else "45°"
    return f"{written(known['width'])}{TIMES}{angle}"


def at_place(measure: Measure, datum: float) -> Value:
    """A coordinate as the distance from a datum."""
    return valued(measure, "", abs(measure.nominal - datum))
