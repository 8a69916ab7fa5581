"""Sheets as DXF (release 2000): layers, lines, arcs and circles, and true dimensions that know what they measure.

The coordinates are those of the part, 1:1: on a sheet in the scale 1:2 the frame is twice as large, and whoever plots at
1:2 has the sheet. Sheets stand side by side. A dimension is an entity DIMENSION with its picture in a block of its own, as
CAD programs write them; notes, tables and the frame are lines and text. The file itself is written by ezdxf.
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from io import StringIO
from typing import TYPE_CHECKING, Any

import numpy as np

from mnclab.design.drawing.ink import ARROW, GAP, HEIGHT, OVERSHOOT, Label, Mark, Stroke, value_block
from mnclab.design.drawing.layout import Laid
from mnclab.design.drawing.view import Angle, Diameter, Kind, Linear, Point, Radius, number
from mnclab.geometry.contours import Contour
from mnclab.text.file import printable
from mnclab.text.opening import require

if TYPE_CHECKING:
    from mnclab.design.drawing.drawing import Drawing, Sheet

APART = 20.0  # mm between sheets
MILLIMETRES = 4  # $INSUNITS
CODE_PAGE = "cp1252"
LINETYPES = {Kind.HIDDEN: "HIDDEN", Kind.CENTRE: "CENTER", Kind.PHANTOM: "PHANTOM"}
LAYERS = {  # name: colour number of AutoCAD, kind of its lines
    "OUTLINE": (7, Kind.VISIBLE), "HIDDEN": (8, Kind.HIDDEN), "CENTRE": (1, Kind.CENTRE), "THIN": (7, Kind.THIN),
    "PHANTOM": (6, Kind.PHANTOM), "HATCH": (8, Kind.THIN), "DIMENSIONS": (5, Kind.THIN), "TEXT": (7, Kind.THIN),
    "FRAME": (7, Kind.VISIBLE),
}  # fmt: skip
#: Of the style of dimensions: lengths that grow with a millimetre of the paper; text along its line, above it; decimals.
LENGTHS = {"dimasz": ARROW, "dimexo": GAP, "dimdli": 7.0, "dimexe": OVERSHOOT, "dimtxt": HEIGHT, "dimgap": 1.0}
STYLE = {"dimtih": 0, "dimtoh": 0, "dimtad": 1, "dimzin": 8, "dimdec": 3, "dimtxsty": "Standard"}
SIGNS = {"⌀": "%%c", "±": "%%p", "°": "%%d", "\N{MINUS SIGN}": "-", "\N{THIN SPACE}": " "}  # as AutoCAD's text has them
TYPES = {Linear: 0, Diameter: 3, Radius: 4, Angle: 5}
OWN_BLOCK, TEXT_PLACED = 32, 128  # flags of a dimension
MIDDLE = 5  # where the place of a dimension's text lies in it


def content(drawing: Drawing) -> bytes:
    """The file; an Alarm without ezdxf."""
    require("ezdxf", "DXF drawings", "dxf")
    import ezdxf

    size, across = 1 / drawing.scale, 0.0
    document: Any = ezdxf.new("R2000", units=MILLIMETRES)
    _declare(document, size)
    for sheet in drawing.sheets:
        _Sheet(document, size, across).draw(sheet)
        across += sheet.size.width + APART
    high = max(sheet.size.height for sheet in drawing.sheets)
    corners = (0.0, 0.0, 0.0), ((across - APART) * size, high * size, 0.0)
    document.modelspace().reset_extents(*corners)
    document.header["$EXTMIN"], document.header["$EXTMAX"] = corners  # ezdxf takes a corner at 0 for none
    text, fixed = StringIO(), ezdxf.options.write_fixed_meta_data_for_testing
    ezdxf.options.write_fixed_meta_data_for_testing = True  # no dates and random names: one drawing is always one file
    try:
        document.write(text)
    finally:
        ezdxf.options.write_fixed_meta_data_for_testing = fixed
    return text.getvalue().encode(CODE_PAGE)


def _declare(document: Any, size: float) -> None:
    """Lines, layers, letters and dimensions; dashes, letters and arrows grow with the `size` of a millimetre of the paper."""
    for kind, name in LINETYPES.items():
        dashes = [each * size * (-1 if k % 2 else 1) for k, each in enumerate(kind.dashes)]
        document.linetypes.add(name, [sum(kind.dashes) * size, *dashes])
    for name, (colour, kind) in LAYERS.items():
        linetype = LINETYPES.get(kind, "Continuous")
        document.layers.add(name, color=colour, linetype=linetype, lineweight=round(100 * kind.width))
    document.layers.get("0").dxf.lineweight = round(100 * Kind.THIN.width)
    document.styles.get("Standard").dxf.update({"font": "arial.ttf", "last_height": HEIGHT * size})
    lengths = {name: each * size for name, each in LENGTHS.items()}
    document.dimstyles.get("Standard").dxf.update(lengths | STYLE)


class _Sheet:
    """Draws a sheet into a document, moved to the right by so many mm of paper; `size` is what a millimetre of it is there."""

    def __init__(self, document: Any, size: float, across: float) -> None:
        self.document, self.size, self.across = document, size, across
        self.model = document.modelspace()

    def draw(self, sheet: Sheet) -> None:
        for printed, place in sheet.all_printed:
            self._strokes(printed.strokes, place)
            for label in printed.labels:
                self._label(self.model, label, place, "TEXT")
        for laid, place in sheet.views:
            self._view(laid, place)

    def _view(self, laid: Laid, at: Point) -> None:
        self._strokes(laid.strokes, at)
        for a, b in laid.hatches.tolist():
            self.model.add_line(self._at(a, at), self._at(b, at), {"layer": "HATCH"})
        if laid.title:
            self._label(self.model, laid.title, at, "TEXT")
        for mark in laid.marks:
            if type(mark.of) in TYPES:
                block = self.document.blocks.new_anonymous_block("D")
                self._mark(block, mark, at)
                self._dimension(mark, block.name, at, laid)
            else:
                self._mark(self.model, mark, at)

    def _at(self, xy: Iterable[float], at: Point) -> Point:
        x, y = xy
        return (float(x) + at[0] + self.across) * self.size, (float(y) + at[1]) * self.size

    def _strokes(self, strokes: Iterable[Stroke], at: Point) -> None:
        for stroke in strokes:
            self._contour(self.model, stroke.contour, stroke.layer, at)

    def _contour(self, space: Any, contour: Contour, layer: str, at: Point) -> None:
        """A line, an arc, a circle, or a polyline with bulges."""
        points, bulge = contour.points, contour.bulge
        places, single = [self._at(place, at) for place in points], len(contour.starts) == 1
        if single and bulge[0] == 0:
            space.add_line(*places, {"layer": layer})
            return
        whole_turn = contour.closed and len(points) == 2 and np.abs(bulge).min() == np.abs(bulge).max() == 1
        if not single and not whole_turn:
            rows = [(*place, bent) for place, bent in zip(places, bulge.tolist(), strict=True)]
            space.add_lwpolyline(rows, format="xyb", close=contour.closed, dxfattribs={"layer": layer, "const_width": 0.0})
            return
        centre, radius = self._at(contour.centres[0], at), float(contour.radii[0]) * self.size
        if whole_turn:
            space.add_circle(centre, radius, {"layer": layer})
            return
        ends = points if bulge[0] > 0 else points[::-1]
        start, end = (np.degrees(np.arctan2(*(ends - contour.centres[0]).T[::-1])) % 360).tolist()
        space.add_arc(centre, radius, start, end, dxfattribs={"layer": layer})

    def _label(self, space: Any, label: Label, at: Point, layer: str = "DIMENSIONS") -> None:
        c, s = math.cos(label.angle), math.sin(label.angle)
        for piece in label.block.pieces:
            place = label.at[0] + piece.x * c - piece.y * s, label.at[1] + piece.x * s + piece.y * c
            for stroke in piece.strokes:
                turned = stroke.points @ np.array([[c, s], [-s, c]]) * piece.height + place
                self._contour(space, Contour(turned, stroke.bulge, stroke.closed), layer, at)
            if not piece.strokes:
                look = {"layer": layer, "style": "Standard", "insert": self._at(place, at)}
                height = piece.height * self.size
                space.add_text(letters(piece.text), height=height, rotation=math.degrees(label.angle), dxfattribs=look)

    def _mark(self, space: Any, mark: Mark, at: Point) -> None:
        for _, a, b in mark.lines:
            space.add_line(self._at(a, at), self._at(b, at), {"layer": "DIMENSIONS"})
        for arrow in mark.arrows:
            tip, left, right = (self._at(corner, at) for corner in arrow.corners.tolist())
            space.add_solid([left, right, tip, tip], {"layer": "DIMENSIONS"})
        if mark.arc is not None:
            self._contour(space, mark.arc, "DIMENSIONS", at)
        for label in mark.labels:
            self._label(space, label, at)

    def _dimension(self, mark: Mark, block: str, at: Point, laid: Laid) -> None:
        """The entity that knows what is measured: points on the part, where its line lies, and its text."""
        of, places = mark.of, [self._at(place, at) for place in mark.places]
        larger = laid.scale * self.size  # than the part: 1, but in a detail
        own: dict[str, Any]
        if isinstance(of, Linear):
            angle, (a, b, where) = mark.labels[0].angle, places
            measured = abs((b[0] - a[0]) * math.cos(angle) + (b[1] - a[1]) * math.sin(angle)) / larger
            own = {"defpoint2": a, "defpoint3": b, "angle": math.degrees(angle)}
        elif isinstance(of, Angle):
            vertex, a, b, where = places
            first, last = (math.atan2(each[1] - vertex[1], each[0] - vertex[0]) for each in (a, b))
            measured = math.degrees((last - first) % math.tau)
            own = {"defpoint2": a, "defpoint3": b, "defpoint4": vertex}
        else:
            tip, where = places[0], self._at((of.centre[0] * laid.scale, of.centre[1] * laid.scale), at)
            if isinstance(of, Diameter):
                where = 2 * where[0] - tip[0], 2 * where[1] - tip[1]
            measured = math.dist(where, tip) / larger
            own = {"defpoint4": tip, "leader_length": 0.0}
        dimension = self.model.new_entity("DIMENSION", {
            "layer": "DIMENSIONS", "geometry": block, "dimstyle": "Standard", "attachment_point": MIDDLE,
            "dimtype": TYPES[type(of)] + OWN_BLOCK + TEXT_PLACED, "defpoint": where,
            "text_midpoint": self._at(mark.labels[0].box()[:2], at), "text": _text_of(of, measured),
            "actual_measurement": math.radians(measured) if isinstance(of, Angle) else measured, **own,
        })  # fmt: skip
        if abs(larger - 1) > 1e-9:
            dimension.set_acad_dstyle({"dimlfac": 1 / larger})


def letters(text: str) -> str:
    """A text in the file's code page, as AutoCAD reads it: `%%c` is ⌀, `\\U+0219` is ș."""
    return "".join(map(_letter, "".join(SIGNS.get(letter, letter) for letter in printable(text))))


def _letter(letter: str) -> str:
    if letter < " ":
        return " "
    known = letter.encode(CODE_PAGE, "ignore")
    return letter if known else f"\\U+{ord(letter):04X}" if ord(letter) <= 0xFFFF else "?"


def _text_of(of: Linear | Diameter | Radius | Angle, measured: float) -> str:
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
