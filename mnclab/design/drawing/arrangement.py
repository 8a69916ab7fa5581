"""Where views and tables stand on a sheet: in columns and rows by the method of projection, beside the title block."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import product
from typing import NamedTuple

import numpy as np

from mnclab.design.drawing.dimensions import Point
from mnclab.design.drawing.frame import Printed, inside
from mnclab.design.drawing.layout import Laid
from mnclab.design.drawing.sheet import Size
from mnclab.geometry.curves import Floats

LEAST, MOST = 8.0, 22.0  # mm between views with all that is written to them
EDGE = 4.0  # mm between the frame and what stands within
Rectangle = tuple[float, float, float, float]


class Track(NamedTuple):
    """A column or a row: how far its views reach before and behind the points that they have in common, mm."""

    before: float
    behind: float

    @property
    def size(self) -> float:
        return self.before + self.behind


def tracks(laid: Sequence[Laid], axis: int) -> dict[int, Track]:
    """The columns (axis 0) or rows (axis 1), by number; y of rows counts downwards."""
    found = dict[int, Track]()
    for number in sorted({each.view.cell[axis] for each in laid}):
        mine = [each for each in laid if each.view.cell[axis] == number]
        fixed = [each.bounds[:, axis] for each in mine if not each.view.free]
        before = max([-float(bounds[0]) for bounds in fixed], default=0.0)
        behind = max([float(bounds[1]) for bounds in fixed], default=0.0)
        wide = max([float(each.bounds[1, axis] - each.bounds[0, axis]) for each in mine if each.view.free], default=0.0)
        more = max(0.0, wide - before - behind) / 2
        found[number] = Track(before + more, behind + more)
    return found


def arranged(laid: Sequence[Laid], tables: Sequence[Printed], size: Size, block: Rectangle) -> list[Point] | None:
    """Where the points (0, 0) of the views and of the tables lie on the paper, or None where there is no room."""
    x0, y0, x1, y1 = inside(size)
    x0, y0, x1, y1 = x0 + EDGE, y0 + EDGE, x1 - EDGE, y1 - EDGE
    columns, rows = tracks(laid, 0), tracks(laid, 1)
    wide, high = (sum(track.size for track in each.values()) for each in (columns, rows))
    above, near = block[3] + EDGE, (block[0] - EDGE, block[1], block[2], block[3] + EDGE)
    for low, spread, right, up in _attempts(y0, above):
        gaps = []
        for count, room, taken in ((len(columns), x1 - x0, wide), (len(rows), y1 - low, high)):
            free = (room - taken) / (count + 1)
            gaps.append(min(MOST, max(LEAST, free)) if spread else LEAST)
        whole = wide + gaps[0] * (len(columns) - 1), high + gaps[1] * (len(rows) - 1)
        if whole[0] > x1 - x0 or whole[1] > y1 - low:
            continue
        start = x0 + right * (x1 - x0 - whole[0]), y1 - up * (y1 - low - whole[1])
        places = list(_placed(laid, columns, rows, start, gaps))
        boxes = [_moved(each.bounds, place) for each, place in zip(laid, places, strict=True)]
        taken_up = [block, *boxes]
        if any(_meet(box, near) for box in boxes):
            continue
        for table in tables:
            spot = _free((x0, y0, x1, y1), table.box, taken_up)
            if spot is None:
                break
            places.append(spot)
            taken_up.append((*spot, spot[0] + table.box[2], spot[1] + table.box[3]))
        else:
            return places
    return None


def _attempts(low: float, above: float) -> Iterator[tuple[float, bool, float, float]]:
    """From where up there is room, whether gaps grow, and the share of the free room to the left and above."""
    yield from product((above,), (True, False), (0.5, 0.0), (0.5, 0.0))
    yield from product((low,), (True, False), (0.5, 0.0), (0.0, 0.5))


def _placed(
    laid: Sequence[Laid], columns: dict[int, Track], rows: dict[int, Track], start: Point, gaps: Sequence[float]
) -> Iterator[Point]:
    x, y = start
    lefts, tops = dict[int, float](), dict[int, float]()
    for number, track in columns.items():
        lefts[number] = x
        x += track.size + gaps[0]
    for number, track in rows.items():
        tops[number] = y
        y -= track.size + gaps[1]
    for each in laid:
        column, row = each.view.cell
        across, down = columns[column], rows[row]
        if each.view.free:
            middle = each.bounds.mean(axis=0)
            yield lefts[column] + across.size / 2 - float(middle[0]), tops[row] - down.size / 2 - float(middle[1])
        else:
            yield lefts[column] + across.before, tops[row] - down.behind


def _moved(bounds: Floats, place: Point) -> Rectangle:
    (a, b), (c, d) = (bounds + place).tolist()
    return a, b, c, d


def _meet(a: Rectangle, b: Rectangle) -> bool:
    return a[0] < b[2] and b[0] < a[2] and a[1] < b[3] and b[1] < a[3]


def _free(area: Rectangle, box: Rectangle, taken: Sequence[Rectangle]) -> Point | None:
    """A place for the lower left corner of a box, as far up and to the right as there is one."""
    x0, y0, x1, y1 = area
    wide, high = box[2], box[3]
    for y in np.arange(y1 - high, y0 - 1e-9, -4.0).tolist():
        for x in np.arange(x1 - wide, x0 - 1e-9, -4.0).tolist():
            spot = x - EDGE, y - EDGE, x + wide + EDGE, y + high + EDGE
            if not any(_meet(spot, other) for other in taken):
                return x, y
    return None
