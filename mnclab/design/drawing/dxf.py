"""Sheets as DXF (release 2000): layers, lines, arcs and circles, and true dimensions that know what they measure.

The coordinates are those of the part, 1:1: on a sheet in the scale 1:2 the frame is twice as large, and whoever plots at
1:2 has the sheet. Sheets stand side by side. A dimension is an entity DIMENSION with its picture in a block of its own, as
CAD programs write them; notes, tables and the frame are lines and text.

    HEADER  TABLES  BLOCKS  ENTITIES  OBJECTS      sections; every object has a handle (5) and the handle of its owner (330)
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from itertools import chain
from typing import TYPE_CHECKING, Any

from mnclab.design.drawing.dxf_entities import CODE_PAGE, Ink, Tag, point
from mnclab.design.drawing.ink import ARROW, GAP, OVERSHOOT
from mnclab.design.drawing.lettering import HEIGHT
from mnclab.design.drawing.view import Kind

if TYPE_CHECKING:
    from mnclab.design.drawing.drawing import Drawing

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
        for number, row in enumerate(rows):
            code = 105 if name == "DIMSTYLE" else 5
            yield from [(0, name), (code, ink.reserved(name, number)), (330, TABLE[name]), (100, "AcDbSymbolTableRecord"), *row]
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
