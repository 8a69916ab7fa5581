"""One view on paper: its lines in a scale, and a place for everything that is written to it.

Dimensions are placed one after the other, the short ones first, each at the best place that is free. Where one finds no
room, all begin again with that one first and with more room; afterwards each that crosses others looks once more.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from mnclab.geometry.contours import Contour
from mnclab.geometry.vectors import Floats
from mnclab.show.drawing import angles, leaders, linear
from mnclab.show.drawing.dimensions import Angle, Dimension, Linear, Note, Point
from mnclab.show.drawing.hatching import hatching
from mnclab.show.drawing.ink import Arrow, Label, Mark, Stroke, segment_boxes
from mnclab.show.drawing.lettering import block
from mnclab.show.drawing.placing import DIMENSION, EXTENSION, LEADER, NEVER, OUTLINE, SOFT, Ground, boxes_of, spans
from mnclab.show.drawing.sheet import scale_text
from mnclab.show.drawing.view import Axis, Cut, Kind, View

CHORD = 0.1  # mm on paper: as such chords lines stand in the way of texts
BEYOND = 3.0  # mm by which centre lines go beyond what they are the middle of
PLAIN = 9.0  # mm: a shorter centre line has no dots
CUT_OUT, CUT_END, CUT_ARROW = 6.0, 6.0, 8.0  # mm: the line of a cut beyond the view, its thick ends, its arrows
TITLE = 5.0  # mm, letters of sections
TRIES = 6
LAYERS = {Kind.VISIBLE: "OUTLINE", Kind.HIDDEN: "HIDDEN", Kind.CENTRE: "CENTRE", Kind.THIN: "THIN", Kind.PHANTOM: "PHANTOM"}


class NoRoom(Exception):
    """A dimension for which a view has no place in this scale."""

    def __init__(self, what: Dimension) -> None:
        super().__init__(what)
        self.what = what


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


def lay_out(view: View, scale: float) -> Laid:
    """A view with all its dimensions at a scale; raises NoRoom where one finds no place."""
    strokes = list(_strokes(view, scale))
    ground = _ground(strokes)
    outline = view.bounds * scale
    cuts = []
    for cut in view.cuts:
        ends, mark = _cut(cut, scale, outline)
        strokes += ends
        ground.put(mark)
        cuts.append(mark)
    marks = [*cuts, *_placed(view.dimensions, scale, outline, ground)]
    rows = [boxes_of(mark)[0] for mark in marks]
    ink = segment_boxes(np.concatenate([_chords(stroke.contour) for stroke in strokes]))
    low, high = spans(np.concatenate([ink, *rows]))
    bounds = np.array([low.min(axis=0), high.max(axis=0)])
    text = view.title if view.enlarged == 1 else f"{view.title} ({scale_text(scale)})".strip()
    title = None
    if text:
        letters = block(text, TITLE)
        title = Label(letters, (float(outline[:, 0].mean()) - letters.width / 2, float(bounds[1, 1]) + 3.0))
        low, high = spans(np.array([title.box()]))
        bounds = np.array([np.minimum(bounds[0], low[0]), np.maximum(bounds[1], high[0])])
    texts = np.array([label.box() for mark in marks for label in mark.labels]).reshape(-1, 6)
    lines = hatching(view.hatches, scale, texts)
    return Laid(view, scale, tuple(strokes), tuple(marks), lines, title, bounds)


def _strokes(view: View, scale: float) -> Iterator[Stroke]:
    for line in view.lines:
        contour = Contour(line.contour.points * scale, line.contour.bulge, line.contour.closed)
        yield Stroke(contour, line.kind, LAYERS[line.kind])
    for axis in view.axes:
        if isinstance(axis, Axis):
            yield centre_line(axis.a, axis.b, scale)
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
        ground.add(segment_boxes(chords), np.full(len(chords), part))
    return ground


def _cut(cut: Cut, scale: float, outline: Floats) -> tuple[list[Stroke], Mark]:
    """The line of a section: thick at its ends outside the view, arrows towards it as one looks, letters."""
    points = np.array(cut.points) * scale
    looks = np.array(cut.looks, dtype=float) / np.hypot(*cut.looks)
    strokes, mark = list[Stroke](), Mark(cut)
    ends = []
    for corner, inner in ((points[0], points[1]), (points[-1], points[-2])):
        out = (corner - inner) / np.hypot(*(corner - inner))
        with np.errstate(divide="ignore"):
            ways = (np.where(out > 0, outline[1], outline[0]) - corner) / out
        end = corner + (max(0.0, float(ways[np.abs(out) > 1e-9].min())) + CUT_OUT) * out
        ends.append(end)
        strokes.append(Stroke(Contour([end, end - CUT_END * out], closed=False), Kind.VISIBLE, "OUTLINE"))
        tail = end - CUT_ARROW * looks
        letter = block(cut.letter, TITLE)
        middle = tail - (1.5 + abs(looks[0]) * letter.width / 2 + abs(looks[1]) * TITLE / 2) * looks
        tip = float(end[0]), float(end[1])
        mark.lines += [(LEADER, tip, (float(tail[0]), float(tail[1]))), (LEADER, tip, tuple((end - CUT_END * out).tolist()))]
        mark.arrows.append(Arrow(tip, math.atan2(looks[1], looks[0])))
        mark.labels.append(Label(letter, (float(middle[0]) - letter.width / 2, float(middle[1]) - TITLE / 2)))
    way = np.array([ends[0], *points[1:-1], ends[1]])
    strokes.append(Stroke(Contour(way, closed=False), Kind.CENTRE, "CENTRE"))
    for corner, before, after in zip(way[1:-1], way[:-2], way[2:], strict=True):  # where it steps it is thick again
        arms = [corner + 3.0 * (far - corner) / np.hypot(*(far - corner)) for far in (before, after)]
        strokes.append(Stroke(Contour([arms[0], corner, arms[1]], closed=False), Kind.VISIBLE, "OUTLINE"))
    return strokes, mark


def _placed(dimensions: Sequence[Dimension], scale: float, outline: Floats, empty: Ground) -> list[Mark]:
    """A mark for each dimension, in some order."""
    order = sorted(range(len(dimensions)), key=lambda k: (*_rank(dimensions[k], scale), k))
    for room in range(TRIES):
        ground, marks = empty.copy(), dict[int, Mark]()
        for k in order:
            found = ground.best(_offers(dimensions[k], scale, outline, room))
            if found is None:
                order.remove(k)
                order.insert(0, k)
                break
            ground.put(found)
            marks[k] = found
        else:
            return _improved(marks, order, scale, outline, empty, room)
    raise NoRoom(dimensions[order[0]])


def _improved(
    marks: dict[int, Mark], order: Sequence[int], scale: float, outline: Floats, empty: Ground, room: int
) -> list[Mark]:
    """Each mark that crosses others is taken up and placed again, now that all the others stand."""
    for k in order:
        others = empty.copy()
        for i, mark in marks.items():
            if i != k:
                others.put(mark)
        if others.prices([marks[k]])[0] > marks[k].cost + 2.0:
            marks[k] = others.best(_offers(marks[k].of, scale, outline, room)) or marks[k]
    return [marks[k] for k in order]


def _rank(dimension: Dimension, scale: float) -> tuple[int, float]:
    if isinstance(dimension, Linear):
        return 0, linear.length_of(dimension, scale)
    return (1, 0.0) if isinstance(dimension, Angle) else (2 + isinstance(dimension, Note), 0.0)


def _offers(dimension: Dimension, scale: float, outline: Floats, room: int) -> Iterator[Mark]:
    if isinstance(dimension, Linear):
        return linear.places(dimension, scale, outline, 4 * room)
    if isinstance(dimension, Angle):
        return angles.places(dimension, scale, room)
    return leaders.places(dimension, scale, room)
