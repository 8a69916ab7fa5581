"""Sheets as DXF (release 2000): layers, lines, arcs and circles, and true dimensions that know what they measure.

The coordinates are those of the part, 1:1: on a sheet in the scale 1:2 the frame is twice as large, and whoever plots at
1:2 has the sheet. Sheets stand side by side. A dimension is an entity DIMENSION with its picture in a block of its own, as
CAD programs write them; notes, tables and the frame are lines and text.

    HEADER  TABLES  BLOCKS  ENTITIES  OBJECTS      sections; every object has a handle (5) and the handle of its owner (330)
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator
from itertools import chain
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from mnclab.design.drawing.ink import ARROW, GAP, HEIGHT, OVERSHOOT, Arrow, Label, Mark, value_block
from mnclab.design.drawing.layout import Laid
from mnclab.design.drawing.sheet import Printed
from mnclab.design.drawing.view import Angle, Diameter, Kind, Linear, Point, Radius, number
from mnclab.geometry.contours import Contour
from mnclab.text.file import printable

if TYPE_CHECKING:
    from mnclab.design.drawing.drawing import Drawing, Sheet

APART = 20.0  # mm between sheets
FIRST = 0x100  # handle of the first entity: those below are of tables
LINETYPES = {Kind.HIDDEN: "HIDDEN", Kind.CENTRE: "CENTER", Kind.PHANTOM: "PHANTOM"}
LAYERS = {  # name: colour number of AutoCAD, kind of its lines
    "OUTLINE": (7, Kind.VISIBLE), "HIDDEN": (8, Kind.HIDDEN), "CENTRE": (1, Kind.CENTRE), "THIN": (7, Kind.THIN),
    "PHANTOM": (6, Kind.PHANTOM), "HATCH": (8, Kind.THIN), "DIMENSIONS": (5, Kind.THIN), "TEXT": (7, Kind.THIN),
    "FRAME": (7, Kind.VISIBLE),
}  # fmt: skip
TABLES = ("VPORT", "LTYPE", "LAYER", "STYLE", "VIEW", "UCS", "APPID", "DIMSTYLE", "BLOCK_RECORD")
TABLE = {name: f"{number:X}" for number, name in enumerate(TABLES, 1)}
MODEL, PAPER, ROOT, GROUPS = "20", "21", "22", "23"  # handles of the two spaces and of the dictionaries


def content(drawing: Drawing) -> bytes:
    """The file."""
    return "".join(f"{code:3d}\n{_written(value)}\n" for code, value in tags(drawing)).encode(CODE_PAGE)


def _written(value: Any) -> str:
    return f"{value + 0.0:.12g}" if isinstance(value, float) else str(value)


def tags(drawing: Drawing) -> Iterator[Tag]:
    """The drawing as pairs of a group code and a value."""
    ink, across = Ink(1 / drawing.scale, MODEL, FIRST), 0.0
    for sheet in drawing.sheets:
        ink.sheet(sheet, across)
        across += sheet.size.width + APART
    size = max(sheet.size.height for sheet in drawing.sheets)
    corner = (across - APART) / drawing.scale, size / drawing.scale
    yield 999, "drawing in millimetres of the part"
    yield from [(0, "SECTION"), (2, "HEADER"), (9, "$ACADVER"), (1, "AC1015"), (9, "$DWGCODEPAGE"), (3, "ANSI_1252")]
    yield from [(9, "$INSUNITS"), (70, 4), (9, "$MEASUREMENT"), (70, 1), (9, "$HANDSEED"), (5, f"{ink.handle + 1:X}")]
    yield from [(9, "$EXTMIN"), *point((0.0, 0.0)), (9, "$EXTMAX"), *point(corner), (9, "$LTSCALE"), (40, 1.0), (0, "ENDSEC")]
    yield from [(0, "SECTION"), (2, "TABLES"), *_tables(ink, 1 / drawing.scale), (0, "ENDSEC")]
    yield from [(0, "SECTION"), (2, "BLOCKS"), *_blocks(ink), (0, "ENDSEC")]
    yield from [(0, "SECTION"), (2, "ENTITIES"), *chain.from_iterable(ink.entities), (0, "ENDSEC")]
    yield from [(0, "SECTION"), (2, "OBJECTS")]
    yield from [(0, "DICTIONARY"), (5, ROOT), (330, "0"), (100, "AcDbDictionary"), (281, 1), (3, "ACAD_GROUP"), (350, GROUPS)]
    yield from [(0, "DICTIONARY"), (5, GROUPS), (330, ROOT), (100, "AcDbDictionary"), (281, 1)]
    yield from [(0, "ENDSEC"), (0, "EOF")]


def _tables(ink: Ink, size: float) -> Iterator[Tag]:
    """All tables; lengths of dashes, letters and arrows grow with the `size` of a millimetre of the paper."""
    records: dict[str, list[list[Tag]]] = {name: [] for name in TABLES}
    records["LTYPE"] = [_linetype(name, (), size) for name in ("ByBlock", "ByLayer", "Continuous")]
    records["LTYPE"] += [_linetype(name, kind.dashes, size) for kind, name in LINETYPES.items()]
    layers = {"0": (7, Kind.THIN), **LAYERS}
    records["LAYER"] = [
        [(100, "AcDbLayerTableRecord"), (2, name), (70, 0), (62, colour), (6, LINETYPES.get(kind, "Continuous"))]
        + [(370, round(100 * kind.width))]
        for name, (colour, kind) in layers.items()
    ]
    style = [(2, "Standard"), (70, 0), (40, 0.0), (41, 1.0), (50, 0.0), (71, 0), (42, HEIGHT * size), (3, "arial.ttf"), (4, "")]
    records["STYLE"] = [[(100, "AcDbTextStyleTableRecord"), *style]]
    records["APPID"] = [[(100, "AcDbRegAppTableRecord"), (2, "ACAD"), (70, 0)]]
    lengths = ((41, ARROW), (42, GAP), (43, 7.0), (44, OVERSHOOT), (140, HEIGHT), (147, 1.0))
    records["DIMSTYLE"] = [
        [(100, "AcDbDimStyleTableRecord"), (2, "Standard"), (70, 0), (40, 1.0), *((code, each * size) for code, each in lengths)]
        + [(73, 0), (74, 0), (77, 1), (78, 8), (271, 3), (340, f"{ink.reserved('STYLE', 0)}")]
    ]
    spaces = [("*Model_Space", MODEL), ("*Paper_Space", PAPER)] + [(block.name, block.record) for block in ink.blocks]
    for name in TABLES:
        rows = records[name]
        head = [(0, "TABLE"), (2, name), (5, TABLE[name]), (330, "0"), (100, "AcDbSymbolTable")]
        yield from [*head, (70, len(spaces) if name == "BLOCK_RECORD" else len(rows))]
        if name == "DIMSTYLE":
            yield from [(100, "AcDbDimStyleTable"), (71, 0)]
        for place, row in enumerate(rows):
            code = 105 if name == "DIMSTYLE" else 5
            yield from [(0, name), (code, ink.reserved(name, place)), (330, TABLE[name]), (100, "AcDbSymbolTableRecord"), *row]
        if name == "BLOCK_RECORD":
            for block, handle in spaces:
                yield from [(0, name), (5, handle), (330, TABLE[name]), (100, "AcDbSymbolTableRecord")]
                yield from [(100, "AcDbBlockTableRecord"), (2, block)]
        yield 0, "ENDTAB"


def _linetype(name: str, dashes: tuple[float, ...], size: float) -> list[Tag]:
    lengths = [each * size * (-1 if k % 2 else 1) for k, each in enumerate(dashes)]
    pattern: Iterable[Tag] = chain.from_iterable(((49, each), (74, 0)) for each in lengths)
    head: list[Tag] = [(100, "AcDbLinetypeTableRecord"), (2, name), (70, 0), (3, ""), (72, 65), (73, len(dashes))]
    return [*head, (40, float(sum(dashes)) * size), *pattern]


def _blocks(ink: Ink) -> Iterator[Tag]:
    for name, record in (("*Model_Space", MODEL), ("*Paper_Space", PAPER)):
        yield from _block(ink, name, record, 0, [])
    for block in ink.blocks:
        yield from _block(ink, block.name, block.record, 1, block.entities)


def _block(ink: Ink, name: str, record: str, flags: int, entities: Iterable[Iterable[Tag]]) -> Iterator[Tag]:
    begin, end = ink.ends[record]
    yield from [(0, "BLOCK"), (5, begin), (330, record), (100, "AcDbEntity"), (8, "0"), (100, "AcDbBlockBegin"), (2, name)]
    yield from [(70, flags), *point((0.0, 0.0)), (3, name), (1, "")]
    yield from chain.from_iterable(entities)
    yield from [(0, "ENDBLK"), (5, end), (330, record), (100, "AcDbEntity"), (8, "0"), (100, "AcDbBlockEnd")]


# The ink of sheets as entities of DXF: strokes, arrowheads, letters, and dimensions with the blocks that show them.

Tag = tuple[int, Any]
Entity = list[Tag]
CODE_PAGE = "cp1252"
SIGNS = {"⌀": "%%c", "±": "%%p", "°": "%%d", "\N{MINUS SIGN}": "-", "\N{THIN SPACE}": " "}  # as AutoCAD's text has them
TYPES = {Linear: 0, Diameter: 3, Radius: 4, Angle: 5}
OWN_BLOCK, TEXT_PLACED = 32, 128  # flags of a dimension


class Block(NamedTuple):
    """The picture of a dimension: its name, the handle of its record, what is in it."""

    name: str
    record: str
    entities: list[Entity]


def point(xy: Iterable[float], code: int = 10) -> list[Tag]:
    """A point of the plane."""
    x, y = xy
    return [(code, float(x)), (code + 10, float(y)), (code + 20, 0.0)]


def letters(text: str) -> str:
    """A text in the file's code page, as AutoCAD reads it: `%%c` is ⌀, `\\U+0219` is ș."""
    return "".join(map(_letter, "".join(SIGNS.get(letter, letter) for letter in printable(text))))


def _letter(letter: str) -> str:
    if letter < " ":
        return " "
    known = letter.encode(CODE_PAGE, "ignore")
    return letter if known else f"\\U+{ord(letter):04X}" if ord(letter) <= 0xFFFF else "?"


class Ink:
    """Collects entities and blocks, with handles; `size` is what a millimetre of the paper is in the file."""

    def __init__(self, size: float, model: str, first: int) -> None:
        self.size, self.model, self.handle = size, model, first
        self.entities: list[Entity] = []
        self.blocks: list[Block] = []
        self.ends: dict[str, tuple[str, str]] = {}  # handles of the begin and the end of blocks, by their records
        self.rows: dict[tuple[str, int], str] = {}  # handles of the rows of tables
        for record in ("20", "21"):
            self.ends[record] = self._next(), self._next()

    def _next(self) -> str:
        self.handle += 1
        return f"{self.handle:X}"

    def reserved(self, table: str, row: int) -> str:
        """The handle of a row of a table, below those of entities."""
        return self.rows.setdefault((table, row), f"{0x30 + len(self.rows):X}")

    def sheet(self, sheet: Sheet, across: float) -> None:
        """All of a sheet, moved to the right by so many mm of paper."""
        for printed, place in [*((each, (0.0, 0.0)) for each in sheet.printed), *sheet.tables]:
            self._printed(printed, (place[0] + across, place[1]))
        for laid, place in sheet.views:
            self._view(laid, (place[0] + across, place[1]))

    def _printed(self, printed: Printed, at: Point) -> None:
        for stroke in printed.strokes:
            self.entities.append(self._contour(stroke.contour, stroke.layer, at, self.model))
        for label in printed.labels:
            self.entities += self._label(label, at, self.model, "TEXT")

    def _view(self, laid: Laid, at: Point) -> None:
        for stroke in laid.strokes:
            self.entities.append(self._contour(stroke.contour, stroke.layer, at, self.model))
        for a, b in laid.hatches.tolist():
            self.entities.append(self._line(a, b, "HATCH", at, self.model))
        if laid.title:
            self.entities += self._label(laid.title, at, self.model, "TEXT")
        for mark in laid.marks:
            if type(mark.of) in TYPES:
                record = self._next()
                self.ends[record] = self._next(), self._next()
                block = Block(f"*D{len(self.blocks) + 1}", record, self._mark(mark, at, record))
                self.blocks.append(block)
                self.entities.append(self._dimension(mark, block, at, laid))
            else:
                self.entities += self._mark(mark, at, self.model)

    def _head(self, kind: str, layer: str, owner: str, subclass: str) -> Entity:
        return [(0, kind), (5, self._next()), (330, owner), (100, "AcDbEntity"), (8, layer), (100, subclass)]

    def _at(self, xy: Iterable[float], at: Point) -> Point:
        x, y = xy
        return (float(x) + at[0]) * self.size, (float(y) + at[1]) * self.size

    def _line(self, a: Iterable[float], b: Iterable[float], layer: str, at: Point, owner: str) -> Entity:
        return [*self._head("LINE", layer, owner, "AcDbLine"), *point(self._at(a, at)), *point(self._at(b, at), 11)]

    def _contour(self, contour: Contour, layer: str, at: Point, owner: str) -> Entity:
        """A line, an arc, a circle, or a polyline with bulges."""
        points, bulge = contour.points, contour.bulge
        centres, radii = contour.centres, contour.radii
        if contour.closed and len(points) == 2 and np.abs(bulge).min() == np.abs(bulge).max() == 1:
            head = self._head("CIRCLE", layer, owner, "AcDbCircle")
            return [*head, *point(self._at(centres[0], at)), (40, float(radii[0]) * self.size)]
        if len(contour.starts) == 1 and bulge[0] == 0:
            return self._line(points[0], points[1], layer, at, owner)
        if len(contour.starts) == 1:
            ends = points if bulge[0] > 0 else points[::-1]
            angles = np.degrees(np.arctan2(*(ends - centres[0]).T[::-1])) % 360
            head = [*self._head("ARC", layer, owner, "AcDbCircle"), *point(self._at(centres[0], at))]
            return [*head, (40, float(radii[0]) * self.size), (100, "AcDbArc"), (50, float(angles[0])), (51, float(angles[1]))]
        rows = self._head("LWPOLYLINE", layer, owner, "AcDbPolyline")
        rows += [(90, len(points)), (70, int(contour.closed)), (43, 0.0)]
        for place, bent in zip(points.tolist(), bulge.tolist(), strict=True):
            x, y = self._at(place, at)
            rows += [(10, x), (20, y), (42, bent)]
        return rows

    def _label(self, label: Label, at: Point, owner: str, layer: str = "DIMENSIONS") -> list[Entity]:
        found = list[Entity]()
        c, s = math.cos(label.angle), math.sin(label.angle)
        for piece in label.block.pieces:
            place = label.at[0] + piece.x * c - piece.y * s, label.at[1] + piece.x * s + piece.y * c
            for stroke in piece.strokes:
                turned = stroke.points @ np.array([[c, s], [-s, c]]) * piece.height + place
                found.append(self._contour(Contour(turned, stroke.bulge, stroke.closed), layer, at, owner))
            if not piece.strokes:
                row = [*self._head("TEXT", layer, owner, "AcDbText"), *point(self._at(place, at))]
                row += [(40, piece.height * self.size), (1, letters(piece.text)), (50, math.degrees(label.angle))]
                found.append([*row, (7, "Standard"), (100, "AcDbText")])
        return found

    def _arrow(self, arrow: Arrow, at: Point, owner: str) -> Entity:
        tip, left, right = (self._at(corner, at) for corner in arrow.corners.tolist())
        row = self._head("SOLID", "DIMENSIONS", owner, "AcDbTrace")
        return [*row, *point(left), *point(right, 11), *point(tip, 12), *point(tip, 13)]

    def _mark(self, mark: Mark, at: Point, owner: str) -> list[Entity]:
        found = [self._line(a, b, "DIMENSIONS", at, owner) for _, a, b in mark.lines]
        found += [self._arrow(arrow, at, owner) for arrow in mark.arrows]
        if mark.arc is not None:
            found.append(self._contour(mark.arc, "DIMENSIONS", at, owner))
        for label in mark.labels:
            found += self._label(label, at, owner)
        return found

    def _dimension(self, mark: Mark, block: Block, at: Point, laid: Laid) -> Entity:
        """The entity that knows what is measured: points on the part, where its line lies, and its text."""
        of, kind = mark.of, TYPES[type(mark.of)]
        places = [self._at(place, at) for place in mark.places]
        if isinstance(of, Linear):
            angle = math.degrees(mark.labels[0].angle)
            (ax, ay), (bx, by) = places[:2]
            c, s = math.cos(mark.labels[0].angle), math.sin(mark.labels[0].angle)
            size, where = abs((bx - ax) * c + (by - ay) * s), places[2]
            own = [(100, "AcDbAlignedDimension"), *point(places[0], 13), *point(places[1], 14), (50, angle)]
            own.append((100, "AcDbRotatedDimension"))
        elif isinstance(of, Angle):
            vertex, a, b, where = places
            size = (math.atan2(b[1] - vertex[1], b[0] - vertex[0]) - math.atan2(a[1] - vertex[1], a[0] - vertex[0])) % math.tau
            own = [(100, "AcDb3PointAngularDimension"), *point(a, 13), *point(b, 14), *point(vertex, 15)]
        else:
            centre = self._at((of.centre[0] * laid.scale, of.centre[1] * laid.scale), at)
            tip = places[0]
            opposite = 2 * centre[0] - tip[0], 2 * centre[1] - tip[1]
            round_view = isinstance(of, Diameter)
            where, subclass = (opposite, "AcDbDiametricDimension") if round_view else (centre, "AcDbRadialDimension")
            size = math.dist(where, tip)
            own = [(100, subclass), *point(tip, 15), (40, 0.0)]
        x, y, *_ = mark.labels[0].box()
        larger = laid.scale * self.size  # than the part: 1, but in a detail
        measured = math.degrees(size) if isinstance(of, Angle) else size / larger
        row = self._head("DIMENSION", "DIMENSIONS", self.model, "AcDbDimension")
        row += [(2, block.name), *point(where), *point(self._at((x, y), at), 11), (70, kind + OWN_BLOCK + TEXT_PLACED), (71, 5)]
        detail = [(1001, "ACAD"), (1000, "DSTYLE"), (1002, "{"), (1070, 144), (1040, 1 / larger), (1002, "}")]
        row += [(42, size if isinstance(of, Angle) else measured), (1, _said(of, measured)), (3, "Standard"), *own]
        return row + (detail if abs(larger - 1) > 1e-9 else [])


def _said(of: Linear | Diameter | Radius | Angle, measured: float) -> str:
    """The text of a dimension; where it has the number that was measured that stands as `<>`, and so follows the part."""
    value, found = of.value, letters(number(measured))
    text = letters(value_block(value._replace(limits=None)).text)
    before, _, behind = text.partition(found)
    if found in text and not before[-1:].isdigit() and not (behind[:1].isdigit() or behind[:1] == "."):
        text = f"{before}<>{behind}"
    if value.limits:
        text += f"{{\\H0.7x;\\S{'^ '.join(map(letters, value.limits))};}}"
    more = of.more if isinstance(of, Diameter | Radius) else ()
    return "\\P".join([text, *map(letters, more)])
