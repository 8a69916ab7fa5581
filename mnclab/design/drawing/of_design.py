"""The drawing of a design: its views, all its measures, sheets, and the record of which measure stands where."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from itertools import product
from pathlib import Path
from typing import Any

import numpy as np

from mnclab.design.drawing import milled, turned
from mnclab.design.drawing.drawing import Drawing, draw
from mnclab.design.drawing.ledger import Dimensioned, Draft, Ledger
from mnclab.design.drawing.sheet import Title
from mnclab.design.model.design import Design
from mnclab.design.model.turned_design import TurnedDesign
from mnclab.show.plot.picture import Picture
from mnclab.text.alarm import Alarm
from mnclab.text.given import fitting, shown

TABLES = (0, 1, 2)  # how much goes into tables: what needs it, all holes, all features
MOST = 70  # dimensions of a view; more are not looked for places, but stand in a table
LEGIBLE = 60.0  # mm: a part that is drawn smaller than it is has at least this size on paper, if another way gives it


@dataclass(frozen=True, eq=False, repr=False)
class DesignDrawing(Drawing):
    """A drawing and what it says: `dimensions`, each measure of each feature once."""

    dimensions: tuple[Dimensioned, ...] = ()


def drawing(design: Any, *, size: str | None = None, scale: float | None = None, title: str | None = None) -> DesignDrawing:
    """The dimensioned drawing of a design, on "A4", "A4 landscape", "A3" or "A2" and at a scale (0.5 is 1:2), both chosen
    where they are not given; with a `title` in place of its own.

    Where a view has no room for its dimensions, or only in a small scale, holes, then all features stand in a table, and the
    sheet may be A2; an Alarm where that fails too.
    """
    if not isinstance(design, Design | TurnedDesign):
        raise Alarm(f"a drawing is made of a design, got {shown(design)}", hint="Design(blank, features).plot()")
    design = design if title is None else replace(design, title=title)
    if not design.volume > 0:
        raise Alarm("there is nothing to draw: the features take the whole blank away")
    block = Title(design.title or "part", design.number, design.material, design.general, design.date, design.author)
    best: DesignDrawing | None = None
    refused: Alarm | None = None
    for attempt in _attempts(design):
        ledger = Ledger()
        views = [draft.view() for draft in _drafts(design, ledger, *attempt)]
        if attempt[0] < TABLES[-1] and max(len(view.dimensions) for view in views) > MOST:
            continue
        try:
            found = draw(views, block, size=size, scale=scale, tables=ledger.tables)
        except Alarm as fault:
            refused = fault
            continue
        if best is None or found.scale > best.scale:
            best = DesignDrawing(found.title, found.scale, found.sheets, ledger.record(found))
        part = max(float(np.ptp(view.bounds, axis=0).max()) for view in views)
        if scale is not None or found.scale >= 1 or found.scale * part >= LEGIBLE:
            break
    if best is None and size is None:
        return drawing(design, size="A2", scale=scale)
    if best is None:
        assert refused is not None
        raise refused
    return best


def _attempts(design: Design | TurnedDesign) -> Iterator[tuple[int, bool]]:
    """How much goes into tables, and whether the view from below stands beside that from above, where both find more room."""
    if isinstance(design, TurnedDesign):
        yield TABLES[-1], False
    else:
        yield from product(TABLES, (False, True) if design.back else (False,))


def _drafts(design: Design | TurnedDesign, ledger: Ledger, tabled: int, beside: bool) -> list[Draft]:
    if isinstance(design, TurnedDesign):
        return turned.drafts(design, ledger)
    return milled.drafts(design, ledger, tabled, beside)


@fitting
def plot(
    design: Any, *, size: str | None = None, scale: float | None = None, sheet: int = 1, title: str | None = None
) -> Picture:
    """The drawing of a design as a figure in true size; `sheet` where there are several, `title` in place of its own."""
    return drawing(design, size=size, scale=scale, title=title).figure(sheet)


@fitting
def save(
    design: Any, path: str | Path, *, size: str | None = None, scale: float | None = None, sheet: int | None = None,
    title: str | None = None,
) -> Path:  # fmt: skip
    """Write the drawing of a design: pdf with all its sheets, or one sheet as svg, png or dxf."""
    return drawing(design, size=size, scale=scale, title=title).save(path, sheet)
