"""Which measure of which feature is written where: views as they are drafted, and a record of what they say."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any, NamedTuple

import numpy as np

from mnclab.design.drawing.dimensions import Dimension, Point
from mnclab.design.drawing.drawing import Drawing
from mnclab.design.drawing.frame import Printed
from mnclab.design.drawing.origin import RADIUS
from mnclab.design.drawing.sheet import Table
from mnclab.design.drawing.view import Axis, Cross, Cut, Kind, Line, Origin, View
from mnclab.geometry.contours import Contour
from mnclab.geometry.curves import Floats
from mnclab.geometry.regions import Region

ORIGIN_BOX = RADIUS * np.array([(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)])  # mm about the zero point
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
    lines: list[Line] = field(default_factory=list)
    hatches: tuple[Region, ...] = ()
    dimensions: list[Dimension] = field(default_factory=list)
    axes: list[Axis | Cross | Origin] = field(default_factory=list)
    cuts: list[Cut] = field(default_factory=list)

    def draw(self, contours: Sequence[Contour], kind: Kind = Kind.VISIBLE) -> None:
        self.lines += [Line(contour, kind) for contour in contours]

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


def _title(printed: Printed) -> str:
    return printed.labels[-1].text
