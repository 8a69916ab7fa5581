"""The drawing of a design: its views, all its measures, sheets, and the record of which measure stands where."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any

from mnclab.show.drawing import milled, turned
from mnclab.show.drawing.drawing import Drawing, draw
from mnclab.show.drawing.ledger import Dimensioned, Ledger
from mnclab.show.drawing.sheet import Title
from mnclab.show.plot.picture import Picture
from mnclab.text.alarm import Alarm
from mnclab.text.given import shown
from mnclab.workpiece.design.design import Design
from mnclab.workpiece.design.turned_design import TurnedDesign

TABLES = (0, 1, 2)  # how much goes into tables: what needs it, all holes, all features


@dataclass(frozen=True, eq=False, repr=False)
class DesignDrawing(Drawing):
    """A drawing and what it says: `dimensions`, each measure of each feature once."""

    dimensions: tuple[Dimensioned, ...] = ()


def drawing(design: Any, *, size: str | None = None, scale: float | None = None) -> DesignDrawing:
    """The dimensioned drawing of a design, on "A4", "A4 landscape", "A3" or "A2" and at a scale (0.5 is 1:2), both chosen
    where they are not given.

    Where a view has no room for its dimensions holes, then all features stand in a table; an Alarm where that fails too.
    """
    if not isinstance(design, Design | TurnedDesign):
        raise Alarm(f"a drawing is made of a design, got {shown(design)}", hint="Design(blank, features).plot()")
    title = Title(design.title or "part", design.number, design.material, design.general, design.date, design.author)
    for tabled in TABLES:
        ledger = Ledger()
        turns = isinstance(design, TurnedDesign)
        views = [draft.view() for draft in (turned.drafts(design, ledger) if turns else milled.drafts(design, ledger, tabled))]
        try:
            found = draw(views, title, size=size, scale=scale, tables=ledger.tables)
        except Alarm:
            if turns or tabled == TABLES[-1]:
                raise
            continue
        return DesignDrawing(found.title, found.scale, found.sheets, ledger.record(found))
    raise AssertionError("the last attempt returns or raises")


def plot(design: Any, *, size: str | None = None, scale: float | None = None, sheet: int = 1) -> Picture:
    """The drawing of a design as a figure in true size; `sheet` where there are several."""
    return drawing(design, size=size, scale=scale).figure(sheet)


def save(
    design: Any, path: str | Path, *, size: str | None = None, scale: float | None = None, sheet: int | None = None
) -> Path:
    """Write the drawing of a design: pdf with all its sheets, or one sheet as svg, png or dxf."""
    return drawing(design, size=size, scale=scale).save(path, sheet)
