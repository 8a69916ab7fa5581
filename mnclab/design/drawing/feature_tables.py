"""Tables beside the views: holes, corners of outlines, and all features where a view has no room for them."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from mnclab.design.drawing.dimensions import Note, number
from mnclab.design.drawing.feature_marks import mouth_of, outline_of, point_of, shape_in
from mnclab.design.drawing.sheet import Table
from mnclab.design.drawing.wording import SIGNS, hole_lines, written
from mnclab.design.model.features import Hole, Pocket, along
from mnclab.design.model.measures import Measure
from mnclab.design.model.shapes import Circle, Outline

if TYPE_CHECKING:
    from mnclab.design.drawing.milled_features import Side

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
        side.draft.dimensions.append(Note((hole.x, hole.y), (label,), mouth_of(hole) / 2))
        rows.append((label, _said(known["x"], x), _said(known["y"], y), text))
        for column, names in ((1, ("x",)), (2, ("y",)), (3, ())):
            side.ledger.cell(title, row, column, side.claims([k], *names))
        side.tops([k])
    side.ledger.tables.append(Table(title, ("No.", "X", "Y", "hole"), tuple(rows)))


def feature_table(side: Side, numbers: list[int]) -> None:
    """Every feature by its measures: where a view has no room for them."""
    title = "features from below" if side.back else "features"
    rows = []
    x, y = side.datum
    for row, k in enumerate(numbers):
        feature = side.features[k]
        label = f"{'B' if side.back else 'A'}{row + 1}"
        line = outline_of(feature)
        assert line is not None  # a table holds what has a place
        at = line.point_at(0.35 * line.length)[0]
        shape = shape_in(feature)
        to = Note((shape.x, shape.y), (label,), shape.diameter / 2) if isinstance(shape, Circle) else Note(point_of(at), (label,))
        side.draft.dimensions.append(to)
        known = {each.name: each for each in feature.measures() if each.kind == "place"}
        said = [each for each in feature.measures() if each.kind != "place" or each.name == "top"]
        told = [written(each) if each.name in SIGNS else f"{each.name} {written(each)}" for each in said]
        rows.append((label, _said(known["x"], x), _said(known["y"], y), f"{side.names()[k]}: {', '.join(told)}"))
        for column, names in ((1, ("x",)), (2, ("y",))):
            side.ledger.cell(title, row, column, side.claims([k], *names))
        side.ledger.cell(title, row, 3, [*side.claims([k]), *side.claims([k], "top")])
        if isinstance(shape, Outline):
            corner_table(side, shape, (), k)
    side.ledger.tables.append(Table(title, ("No.", "X", "Y", "feature"), tuple(rows)))


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
    shapes = [shape_in(each) for each in side.features]
    shapes += [island for each in side.features if isinstance(each, Pocket) for island in each.islands]
    return sum(len(each.points) for each in shapes if isinstance(each, Outline))


def _said(measure: Measure, datum: float) -> str:
    return written(measure._replace(nominal=measure.nominal - datum))
