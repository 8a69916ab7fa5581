"""The spot where two programs differ: the first path wide and grey, the second thin and blue over it, and both places."""

from __future__ import annotations

from typing import Any

import numpy as np

from mnclab.path.toolpath import Kind
from mnclab.show import looks
from mnclab.show.plot.colours import RAPID, Mark
from mnclab.show.plot.picture import SIZE, VIEWS, Picture
from mnclab.show.plot.side_by_side import CUTTING, FIRST, FIRST_RAPID, SECOND, laid_over
from mnclab.show.plot.sizes import sized
from mnclab.show.plot.strokes import line_of
from mnclab.text.alarm import Alarm
from mnclab.text.given import choice, whole

HERE = Mark("place on the first", looks.GREY, "s", 9, False, 4.1)
THERE = Mark("place on the second", looks.WRONG, "o", 9, False, 4.2)
AROUND = 12.0  # mm beside the places, at least
ROWS = 400  # of each path about the place


@sized()
def plot_proof(found: Any, number: int | None = None, view: str = "auto", size: tuple[float, float] = SIZE) -> Picture:
    """Both paths about a difference, the first one that is not harmless or the one of a `number` from 0; `view` "XY", "XZ", …"""
    if not found.differences:
        raise Alarm("there is no difference to draw: the motion is the same", hint="run.plot() shows one of the two")
    count = len(found.differences)
    if number is not None and not 0 <= whole(number, "the number of the difference") < count:
        raise Alarm(f"the differences have the numbers 0 to {count - 1}, there is no number {number}")
    one = found.first if number is None else found.differences[number]
    lathe = any(path.lathe for path in found.paths)
    places = [np.array(place) if place else None for place in one.places]
    near, lines = [place for place in places if place is not None] or [np.zeros(3)], []
    for look, rapid, path, row, name in zip((FIRST, SECOND), (FIRST_RAPID, RAPID), found.paths, one.rows, found.names):
        some = path[max(row - ROWS, 0) : max(row, 0) + ROWS]
        lines += [(look._replace(name=name), line_of(some, CUTTING))]
        lines += [(rapid, dashed)] if len(dashed := line_of(some, (Kind.RAPID,))) else []
    low, high = np.min(near, axis=0), np.max(near, axis=0)
    room = max(AROUND, 0.25 * float((high - low).max()))
    low, high = low - room, high + room
    view = choice(view, "view", ("auto", *VIEWS))
    views = [VIEWS["ZX"]] if lathe else [VIEWS["XY"], VIEWS["XZ"]]
    views = [each._replace(unit=found.unit) for each in (views if view == "auto" else [VIEWS[view]])]
    named = (mark._replace(name=f"end of it in {name}") for mark, name in zip((HERE, THERE), found.names))
    marks = [(mark, place) for mark, place in zip(named, places) if place is not None]
    joined = len(marks) == 2 and one.kind in ("geometry", "depth", "side")  # of rapids it would look like one
    gap = [place for _, place in marks] if joined else []
    return laid_over(lines, marks, gap, views, low, high, one.sentence, one.sentence, size)
