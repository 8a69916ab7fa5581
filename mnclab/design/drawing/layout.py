"""One view on paper: its lines in a scale, and a place for everything that is written to it.

Dimensions are placed one after the other, the short ones first, each at the best place that is free. Where one finds no
room, those that stand in its way go and look for another place, the less willingly the oftener they had to. In the end
each looks once more.
"""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from mnclab.design.drawing import angles, cuts, leaders, linear
from mnclab.design.drawing.dimensions import Angle, Dimension, Linear, Note, Point
from mnclab.design.drawing.hatching import hatching
from mnclab.design.drawing.ink import Label, Mark, Stroke, segment_boxes
from mnclab.design.drawing.lettering import block
from mnclab.design.drawing.origin import origin
from mnclab.design.drawing.placing import OUTLINE, SOFT, Batch, Ground, Offers, boxes_of, spans
from mnclab.design.drawing.sheet import scale_text
from mnclab.design.drawing.view import Axis, Kind, Origin, View
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
Written = Dimension | cuts.End


class NoRoom(Exception):
    """A dimension for which a view has no place in this scale."""

    def __init__(self, what: Written) -> None:
        super().__init__(what)
        self.what = what

    @property
    def said(self) -> str:
        """What it would say on the drawing."""
        if isinstance(self.what, cuts.End):
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


def lay_out(view: View, scale: float) -> Laid:
    """A view with all its dimensions at a scale; raises NoRoom where one finds no place."""
    strokes = list(_strokes(view, scale))
    ground = _ground(strokes)
    outline = view.bounds * scale
    for cut in view.cuts:
        way = np.array(cut.points) * scale
        ground.add(segment_boxes(np.stack([way[:-1], way[1:]], axis=1), WIDE), np.full(len(way) - 1, SOFT))
    ends = [end for cut in view.cuts for end in cuts.ends_of(cut, scale, outline)]
    marks = _placed([*ends, *view.dimensions], scale, outline, ground)
    for k, cut in enumerate(view.cuts):
        strokes += cuts.strokes(cut, scale, marks[2 * k], marks[2 * k + 1])
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
    return [marks[k] for k in range(len(things))]


def _rank(dimension: Written, scale: float) -> tuple[int, float]:
    if isinstance(dimension, Linear):
        return 0, linear.length_of(dimension, scale)
    if isinstance(dimension, cuts.End):
        return 1, 0.0
    return (2, 0.0) if isinstance(dimension, Angle) else (3 + isinstance(dimension, Note), 0.0)


def _offers(thing: Written, scale: float, outline: Floats, room: int) -> Offers:
    if isinstance(thing, cuts.End):
        return Offers(cuts.places(thing))
    if isinstance(thing, Linear):
        return Offers(linear.places(thing, scale, outline, 4 * room))
    if isinstance(thing, Angle):
        return Offers(angles.places(thing, scale, room))
    return Offers(leaders.places(thing, scale, room))
