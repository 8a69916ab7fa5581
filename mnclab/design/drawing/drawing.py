"""A drawing: views with their dimensions on one sheet or several, in true size.

The sheet is the smallest and the scale the largest that hold everything: A4 upright, A4 across, then A3 where the part
would become small on A4; views that do not go together on one sheet stand on several. What finds no room at all is an
Alarm: nothing ever lies on something else.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from io import BytesIO
from pathlib import Path
from typing import Any, NamedTuple

import matplotlib as mpl
import numpy as np
from matplotlib.backends.backend_pdf import PdfPages

from mnclab.design.drawing import dimension_places, dxf, figure
from mnclab.design.drawing import sheet as paper
from mnclab.design.drawing.ink import corners_of
from mnclab.design.drawing.layout import EDGE, LEAST, Laid, NoRoom, arranged, lay_out
from mnclab.design.drawing.sheet import SCALES, SIZES, Printed, Size, Table, Title, scale_text
from mnclab.design.drawing.view import Point, View
from mnclab.geometry.curves import Floats
from mnclab.show.plot.picture import Picture
from mnclab.text.alarm import Alarm
from mnclab.text.file import named, printable, replaced
from mnclab.text.given import check_number, choice

A4, A3 = ("A4", "A4 landscape"), ("A3",)
SEEN = 90.0  # mm: a part that is as large on A4, or true size there, needs no A3
FILES = (".svg", ".pdf", ".png", ".dxf")


class Boxed(NamedTuple):
    """The box of a text, an arrowhead, a table, the title block or the frame: its corners `(4, 2)` in mm from the lower
    left corner of the paper, and the dimension, note or view that it belongs to."""

    sheet: int
    kind: str
    text: str
    of: Any
    corners: Floats


@dataclass(frozen=True, eq=False)
class Sheet:
    """One sheet: its views and tables, each with the place of its point (0, 0) on the paper (mm)."""

    size: Size
    views: tuple[tuple[Laid, Point], ...]
    tables: tuple[tuple[Printed, Point], ...]
    printed: tuple[Printed, ...]

    @property
    def all_printed(self) -> list[tuple[Printed, Point]]:
        """Frame, title block and tables, each with its place."""
        return [*((each, (0.0, 0.0)) for each in self.printed), *self.tables]


@dataclass(frozen=True, eq=False)
class Drawing:
    """The sheets of a drawing at one scale."""

    title: Title
    scale: float
    sheets: tuple[Sheet, ...]

    def __repr__(self) -> str:
        sheets = f"{len(self.sheets)} sheet{'s' * (len(self.sheets) > 1)} {self.sheets[0].size.name}"
        return f"<Drawing {self.title.title!r}: {sheets}, {scale_text(self.scale)}>"

    def boxes(self) -> list[Boxed]:
        """The boxes of all texts and arrowheads, of tables, title blocks and frames."""
        return [box for number, sheet in enumerate(self.sheets, 1) for box in _boxes(sheet, number)]

    def figure(self, sheet: int = 1) -> Picture:
        """One sheet as a figure in true size; sheets count from 1."""
        check_number(sheet, "the sheet", at_least=1, at_most=len(self.sheets))
        return self._figures[int(sheet) - 1]

    @property
    def leaders_cross(self) -> bool:
        """Whether leaders of one view cross."""
        return any(laid.leaders_cross for sheet in self.sheets for laid, _ in sheet.views)

    @cached_property
    def _figures(self) -> list[Picture]:
        return [_figure(sheet, repr(self)[1:-1]) for sheet in self.sheets]

    def save(self, path: str | Path, sheet: int | None = None) -> Path:
        """Write a pdf or a dxf with all sheets, or one sheet as svg, pdf or png; lines and letters in true size.

        Of several sheets an svg and a png want to know which. A dxf has the part 1:1.
        """
        path, suffix = named(path, FILES, "cannot write a drawing as {}")
        if suffix == ".dxf":
            with replaced(path) as beside:
                beside.write_bytes(dxf.content(self))
            return path
        if sheet is None and suffix != ".pdf" and len(self.sheets) > 1:
            raise Alarm(f"a {suffix} file holds one of the {len(self.sheets)} sheets", hint="sheet=1 writes the first")
        pages = self._figures if sheet is None else [self.figure(sheet)]
        data = BytesIO()
        with mpl.rc_context({"svg.hashsalt": "mnclab", "svg.fonttype": "path", "pdf.fonttype": 42}):
            if suffix == ".pdf":
                with PdfPages(data, metadata={"CreationDate": None, "Title": printable(self.title.title)}) as book:
                    for page in pages:
                        book.savefig(page)
            else:
                pages[0].savefig(data, format=suffix[1:], dpi=300, metadata={"Date": None} if suffix == ".svg" else None)
        with replaced(path) as beside:
            beside.write_bytes(data.getvalue())
        return path

    def _repr_mimebundle_(self, include: Any = None, exclude: Any = None) -> dict[str, Any]:
        return self.figure()._repr_mimebundle_(include, exclude)


def draw(
    views: Sequence[View], title: Title | str, *, size: str | None = None, scale: float | None = None,
    tables: Sequence[Table] = (),
) -> Drawing:  # fmt: skip
    """Lay views out; `size` ("A4", "A4 landscape", "A3", "A2") and `scale` (0.5 is 1:2) are chosen where they are not given.

    Raises Alarm where something finds no room.
    """
    title = Title(title) if isinstance(title, str) else title
    if not views:
        raise Alarm("a drawing needs at least one view")
    cells = [view.cell for view in views]
    for cell in cells:
        if cells.count(cell) > 1:
            names = ", ".join(view.name for view in views if view.cell == cell)
            raise Alarm(f"the cell {cell} of the arrangement holds one view, got {names}")
    if size is not None:
        size = choice(size, "size", SIZES)
    if scale is not None:
        check_number(scale, "the scale", above=0)
    return _Attempt(tuple(views), title, tuple(map(paper.table, tables))).drawn(size, scale)


class _Attempt:
    """Looks for sheet and scale; each view is laid out once for each scale."""

    def __init__(self, views: tuple[View, ...], title: Title, tables: tuple[Printed, ...]) -> None:
        self.views, self.title, self.tables = views, title, tables
        self.laid: dict[tuple[int, float], Laid | NoRoom] = {}

    def drawn(self, size: str | None, scale: float | None) -> Drawing:
        part = max(float(np.ptp(view.bounds, axis=0).max()) for view in self.views)
        scales = [scale] if scale else SCALES
        seen = [each for each in scales if scale or each >= 1 or each * part >= SEEN]
        found = None if size else self._one(self._a4(), seen)
        if found and found.leaders_cross:
            larger = self._one(A3, [each for each in scales if each > found.scale])
            found = larger if larger and not larger.leaders_cross else found
        found = found or self._one((size,) if size else A3, scales)
        found = found or self._several((size,) if size else A3, scales)
        if found is None:
            raise self._refused()
        return found

    def _a4(self) -> tuple[str, ...]:
        """A4 upright and across, first as the views are."""
        wide, high = (sum(self._sizes(self.views, axis, 1.0).values()) for axis in (0, 1))
        return A4 if high > wide else A4[::-1]

    def _one(self, sizes: Sequence[str], scales: Sequence[float]) -> Drawing | None:
        """The drawing on one sheet at the largest scale."""
        for each in scales:
            for size in (SIZES[name] for name in sizes):
                if self._might(self.views, size, each):
                    sheet = self._sheet(range(len(self.views)), self.tables, size, each)
                    if sheet:
                        return self._finished([sheet], each)
        return None

    def _several(self, sizes: Sequence[str], scales: Sequence[float]) -> Drawing | None:
        """The drawing on as many sheets as it takes, at the largest scale at which each view goes on one."""
        for each in scales:
            for size in (SIZES[name] for name in sizes):
                if all(self._might([view], size, each) for view in self.views):
                    sheets = self._spread(size, each)
                    if sheets:
                        return self._finished(sheets, each)
        return None

    def _spread(self, size: Size, scale: float) -> list[tuple[Sheet, Size]] | None:
        sheets, first = list[tuple[Sheet, Size]](), 0
        while first < len(self.views):
            for last in range(len(self.views), first, -1):
                tables = self.tables if last == len(self.views) else ()
                sheet = self._sheet(range(first, last), tables, size, scale)
                if sheet is None and tables and last == first + 1:
                    alone = self._sheet(range(first, last), (), size, scale), self._sheet(range(0), tables, size, scale)
                    if alone[0] and alone[1]:
                        return [*sheets, alone[0], alone[1]]
                if sheet:
                    sheets.append(sheet)
                    first = last
                    break
            else:
                return None
        return sheets

    def _might(self, views: Sequence[View], size: Size, scale: float) -> bool:
        """Whether the views with their rows of dimensions would have room: the other texts may take more."""
        x0, y0, x1, y1 = paper.inside(size)
        for axis, room in ((0, x1 - x0), (1, y1 - y0)):
            sizes = self._sizes(views, axis, scale)
            if sum(sizes.values()) + LEAST * (len(sizes) - 1) + 2 * EDGE > room:
                return False
        return True

    def _sizes(self, views: Sequence[View], axis: int, scale: float) -> dict[int, float]:
        """The columns (axis 0) or rows (axis 1) of the views: how large they are at least on paper, mm."""
        sizes = dict[int, float]()
        for view in views:
            length = float(np.ptp(view.bounds[:, axis])) * view.enlarged * scale
            length += dimension_places.room_for(view.dimensions, "yx"[axis])
            sizes[view.cell[axis]] = max(sizes.get(view.cell[axis], 0.0), length)
        return sizes

    def _sheet(
        self, which: range, tables: tuple[Printed, ...], size: Size, scale: float
    ) -> tuple[Sheet, Size] | None:
        laid = list[Laid]()
        for k in which:
            found = self._lay_out(k, scale)
            if isinstance(found, NoRoom):
                return None
            laid.append(found)
        block = paper.title_block(self.title, size, scale, 1, 1).box
        places = arranged(laid, tables, size, block)
        if places is None:
            return None
        views = tuple(zip(laid, places, strict=False))
        return Sheet(size, views, tuple(zip(tables, places[len(laid) :], strict=True)), ()), size

    def _lay_out(self, k: int, scale: float) -> Laid | NoRoom:
        if (k, scale) not in self.laid:
            try:
                self.laid[k, scale] = lay_out(self.views[k], scale * self.views[k].enlarged)
            except NoRoom as no_room:
                self.laid[k, scale] = no_room
        return self.laid[k, scale]

    def _finished(self, sheets: Sequence[tuple[Sheet, Size]], scale: float) -> Drawing:
        whole_sheets = []
        for number, (sheet, size) in enumerate(sheets, 1):
            block = paper.title_block(self.title, size, scale, number, len(sheets))
            whole_sheets.append(Sheet(size, sheet.views, sheet.tables, (paper.frame(size), block)))
        return Drawing(self.title, scale, tuple(whole_sheets))

    def _refused(self) -> Alarm:
        for (k, scale), found in self.laid.items():
            if isinstance(found, NoRoom):
                said = f"the view {self.views[k].name!r} has no room for {found.said!r}"
                return Alarm(f"{said} at {scale_text(scale)}", hint="a table or another view may take some of the dimensions")
        return Alarm("the views find no room on the sheet", hint="size= or scale= may be chosen otherwise, or left to be chosen")


def _boxes(sheet: Sheet, number: int) -> Iterator[Boxed]:
    tables = [("table", "", each) for each, _ in sheet.tables]
    for (printed, place), (kind, text, of) in zip(
        sheet.all_printed, [("frame", "", None), ("title block", "", None), *tables], strict=True
    ):
        x0, y0, x1, y1 = printed.box
        yield Boxed(number, kind, text, of, np.array([(x0, y0), (x1, y0), (x1, y1), (x0, y1)]) + place)
        for label in printed.labels:
            yield Boxed(number, "text", label.text, of or kind, corners_of(np.array([label.box()]))[0] + place)
    for laid, place in sheet.views:
        if laid.title:
            yield Boxed(number, "text", laid.title.text, laid.view, corners_of(np.array([laid.title.box()]))[0] + place)
        for mark in laid.marks:
            for label in mark.labels:
                yield Boxed(number, "text", label.text, mark.of, corners_of(np.array([label.box()]))[0] + place)
            for arrow in mark.arrows:
                yield Boxed(number, "arrow", "", mark.of, corners_of(np.array([arrow.box()]))[0] + place)


def _figure(sheet: Sheet, alt: str) -> Picture:
    picture = Picture((sheet.size.width / figure.INCH, sheet.size.height / figure.INCH), alt)
    ax = picture.add_axes((0, 0, 1, 1))
    ax.set_axis_off()
    ax.set_xlim(0, sheet.size.width)
    ax.set_ylim(0, sheet.size.height)
    for printed, place in sheet.all_printed:
        figure.draw_strokes(ax, printed.strokes, place)
        for label in printed.labels:
            figure.draw_label(ax, label, place)
    for laid, place in sheet.views:
        figure.draw_thin(ax, laid.hatches, "HATCH", place, zorder=1.5)
        figure.draw_strokes(ax, laid.strokes, place)
        figure.draw_clear(ax, [label for mark in laid.marks for label in mark.labels], place)
        for mark in laid.marks:
            segments = np.array([(a, b) for _, a, b in mark.lines]).reshape(-1, 2, 2)
            figure.draw_thin(ax, segments, "DIMENSIONS", place)
            if mark.arc is not None:
                figure.draw_strokes(ax, [figure.thin(mark.arc)], place)
            figure.draw_arrows(ax, mark.arrows, place)
            for label in mark.labels:
                figure.draw_label(ax, label, place)
        if laid.title:
            figure.draw_label(ax, laid.title, place)
    return picture
