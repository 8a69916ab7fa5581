"""One view on paper: its lines in a scale, and a place for everything that is written to it.

Dimensions are placed one after the other, the short ones first, each at the best place that is free. Where one finds no
room, those that stand in its way go and look for another place, the less willingly the oftener they had to. In the end
each looks once more. Views and tables are then put on the sheet.
"""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import combinations, product
from typing import NamedTuple

import numpy as np

from mnclab.design.drawing import dimension_places, section
from mnclab.design.drawing.ink import Label, Mark, Stroke, block, hatching, origin, segment_boxes
from mnclab.design.drawing.placing import LEADER, OUTLINE, SOFT, Batch, Ground, Offers, boxes_of, spans
from mnclab.design.drawing.sheet import Printed, Size, inside, scale_text
from mnclab.design.drawing.view import Angle, Axis, Dimension, Kind, Linear, Note, Origin, Point, View
from mnclab.geometry import shapely
from mnclab.geometry.contours import Contour
from mnclab.geometry.curves import Floats

CHORD = 0.1  # mm on paper: as such chords lines stand in the way of texts
WIDE = 0.3  # mm, of lines that others should not run along
BEYOND = 3.0  # mm by which centre lines go beyond what they are the middle of
PLAIN = 9.0  # mm: a shorter centre line has no dots
TITLE = 5.0  # mm, letters of sections
MOVES, ROOM = 4, 3  # how often marks may be placed, for each of them; how much more room one may get
LOOKS = 2  # how often each looks for a better place in the end
LAYERS = {Kind.VISIBLE: "OUTLINE", Kind.HIDDEN: "HIDDEN", Kind.CENTRE: "CENTRE", Kind.THIN: "THIN", Kind.PHANTOM: "PHANTOM"}
Written = Dimension | section.End


class NoRoom(Exception):
    """A dimension for which a view has no place in this scale."""

    def __init__(self, what: Written) -> None:
        super().__init__(what)
        self.what = what

    @property
    def said(self) -> str:
        """What it would say on the drawing."""
        if isinstance(self.what, section.End):
            return self.what.cut.letter
        return self.what.lines[0] if isinstance(self.what, Note) else self.what.value.text


@dataclass(frozen=True, eq=False)
class Laid:
    """A view on paper, in mm from its point (0, 0); `bounds` (2, 2) hold all its ink."""

    view: View
    scale: float
    strokes: tuple[Stroke, ...]
    marks: tuple[Mark, ...]
    hatches: Floats
    title: Label | None
    bounds: Floats

    @property
    def leaders_cross(self) -> bool:
        """Whether the leaders of two marks cross."""
        of = [(k, line[1:]) for k, mark in enumerate(self.marks) for line in mark.lines if line[0] == LEADER]
        lines = shapely.linestrings([line for _, line in of]) if of else ()
        return any(
            of[a][0] != of[b][0] and shapely.crosses(lines[a], lines[b]) for a, b in combinations(range(len(of)), 2)
        )


def lay_out(view: View, scale: float) -> Laid:
    """A view with all its dimensions at a scale; raises NoRoom where one finds no place."""
    strokes = list(_strokes(view, scale))
    ground = _ground(strokes)
    outline = view.bounds * scale
    for cut in view.cuts:
        way = np.array(cut.points) * scale
        ground.add(segment_boxes(np.stack([way[:-1], way[1:]], axis=1), WIDE), np.full(len(way) - 1, SOFT))
    ends = [end for cut in view.cuts for end in section.ends_of(cut, scale, outline)]
    marks = _placed([*ends, *view.dimensions], scale, outline, ground)
    for k, cut in enumerate(view.cuts):
        strokes += section.strokes(cut, scale, marks[2 * k], marks[2 * k + 1])
    rows = [boxes_of(mark)[0] for mark in marks]
    ink = segment_boxes(np.concatenate([_chords(stroke.contour) for stroke in strokes]))
    bounds = _around(np.concatenate([ink, *rows]))
    text = view.title if view.enlarged == 1 else f"{view.title} ({scale_text(scale)})".strip()
    title = None
    if text:
        letters = block(text, TITLE)
        title = Label(letters, (float(outline[:, 0].mean()) - letters.width / 2, float(bounds[1, 1]) + 3.0))
        low, high = _around(np.array([title.box()]))
        bounds = np.array([np.minimum(bounds[0], low), np.maximum(bounds[1], high)])
    texts = np.array([label.box() for mark in marks for label in mark.labels]).reshape(-1, 6)
    lines = hatching(view.hatches, scale, texts)
    return Laid(view, scale, tuple(strokes), tuple(marks), lines, title, bounds)


def _around(boxes: Floats) -> Floats:
    """Lower left and upper right corner of all boxes, `(2, 2)`."""
    left, low, right, high = spans(boxes)
    return np.array([(left.min(), low.min()), (right.max(), high.max())])


def _strokes(view: View, scale: float) -> Iterator[Stroke]:
    for line in view.lines:
        contour = Contour(line.contour.points * scale, line.contour.bulge, line.contour.closed)
        yield Stroke(contour, line.kind, LAYERS[line.kind])
    for axis in view.axes:
        if isinstance(axis, Axis):
            yield centre_line(axis.a, axis.b, scale)
            continue
        if isinstance(axis, Origin):
            yield from origin((axis.at[0] * scale, axis.at[1] * scale))
            continue
        x, y = axis.centre
        for angle in (axis.turned, axis.turned + math.pi / 2):
            dx, dy = axis.radius * math.cos(angle), axis.radius * math.sin(angle)
            yield centre_line((x - dx, y - dy), (x + dx, y + dy), scale)


def centre_line(a: Point, b: Point, scale: float) -> Stroke:
    """A centre line on paper: longer at both ends, and beginning and ending with a long dash."""
    start, end = np.array(a) * scale, np.array(b) * scale
    length = float(np.hypot(*(end - start)))
    unit = (end - start) / length if length else np.array([1.0, 0.0])
    contour = Contour([start - BEYOND * unit, end + BEYOND * unit], closed=False)
    length += 2 * BEYOND
    if length < PLAIN:
        return Stroke(contour, Kind.CENTRE, "CENTRE", ())
    long, gap, dot, _ = Kind.CENTRE.dashes
    count = max(1, round((length - long) / (long + 2 * gap + dot)))
    ratio = length / (count * (long + 2 * gap + dot) + long)
    return Stroke(contour, Kind.CENTRE, "CENTRE", (long * ratio, gap * ratio, dot * ratio, gap * ratio))


def _chords(contour: Contour) -> Floats:
    points = contour.points_within(CHORD)
    return np.stack([points[:-1], points[1:]], axis=1)


def _ground(strokes: Sequence[Stroke]) -> Ground:
    ground = Ground()
    for stroke in strokes:
        chords = _chords(stroke.contour)
        part = OUTLINE if stroke.kind is Kind.VISIBLE else SOFT
        ground.add(segment_boxes(chords, WIDE), np.full(len(chords), part))
    return ground


def _placed(things: Sequence[Written], scale: float, outline: Floats, ground: Ground) -> list[Mark]:
    """A mark for each of them, in their order; they are laid on the ground."""
    marks, standing, room = dict[int, Mark](), np.full(len(things), 4.0), [0] * len(things)
    order = sorted(range(len(things)), key=lambda k: (*_rank(things[k], scale), k))
    offers = [_offers(thing, scale, outline, 0) for thing in things]
    waiting = deque(order)
    for _ in range(MOVES * len(things) + MOVES):
        if not waiting:
            break
        k = waiting.popleft()
        found, away = ground.best(offers[k])
        if found is None:
            found, away = ground.best(offers[k], standing)
            standing[k] += 5.0
            if room[k] < ROOM:
                room[k] += 1
                offers[k] = _offers(things[k], scale, outline, room[k])
            elif found is None:
                raise NoRoom(things[k])
            if found is None:
                waiting.appendleft(k)
                continue
            for other in away:
                ground.take(other)
                del marks[other]
                waiting.append(other)
        ground.put(found, k)
        marks[k] = found
    if waiting:
        raise NoRoom(things[waiting[0]])
    for k in order * LOOKS:  # now that all stand
        ground.take(k)
        price = float(ground.prices(Batch.of([marks[k]]))[0][0])
        marks[k] = ground.best(offers[k], least=price)[0] or marks[k]
        ground.put(marks[k], k)
    for k, other in product(order, order):  # shorter dimensions stand nearer to the part
        if dimension_places.outside(marks[k], marks[other], outline):
            before, tried = {each: marks[each] for each in (k, other)}, dict[int, Mark]()
            for each in before:
                ground.take(each)
            for each in before:
                if found := ground.best(offers[each])[0]:
                    tried[each] = found
                    ground.put(found, each)
            if len(tried) < 2 or dimension_places.outside(tried[k], tried[other], outline):
                for each in before:
                    ground.take(each)
                tried = before
                for each, mark in before.items():
                    ground.put(mark, each)
            marks |= tried
    return [marks[k] for k in range(len(things))]


def _rank(dimension: Written, scale: float) -> tuple[int, float]:
    if isinstance(dimension, Linear):
        return 0, dimension_places.length_of(dimension, scale)
    if isinstance(dimension, section.End):
        return 1, 0.0
    return (2, 0.0) if isinstance(dimension, Angle) else (3 + isinstance(dimension, Note), 0.0)


def _offers(thing: Written, scale: float, outline: Floats, room: int) -> Offers:
    if isinstance(thing, section.End):
        return Offers(section.letter_places(thing))
    if isinstance(thing, Linear):
        return Offers(dimension_places.linear_places(thing, scale, outline, 4 * room))
    if isinstance(thing, Angle):
        return Offers(dimension_places.angle_places(thing, scale, room))
    return Offers(dimension_places.leader_places(thing, scale, room))


# Where views and tables stand on a sheet: in columns and rows by the method of projection, beside the title block.

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
        places = list(_stood(laid, columns, rows, start, gaps))
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


def _stood(
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
