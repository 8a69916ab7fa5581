"""What things are called that a program makes: features by cycle and line, threads by designation, contours by their shape."""

from __future__ import annotations

import math
import re
from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from mnclab.design.model.holes import COARSE as COARSE_PITCH
from mnclab.design.model.shapes import Circle, Outline, Rectangle
from mnclab.geometry.contours import Contour
from mnclab.geometry.curves import cross
from mnclab.path.toolpath import Array
from mnclab.workpiece.cutting import Cutting

CYCLE = re.compile(r"(CYCL DEF \d+|[A-Z]{1,3}\d+)\b")


def names(cutting: Cutting, rows: Sequence[int]) -> Iterator[str]:
    """The cycle, if it is one, and the line of each of some rows, numbered where one made several features."""
    path, said = cutting.path, list[str]()
    for row in rows:
        line, program = int(path.line[row]), int(path.program[row])
        place = f"line {line}" if program == 0 else cutting.name(line, program)
        cycle = CYCLE.match(path.labels[path.label[row]])
        said.append(f"{cycle[1]}, {place}" if cycle else place)
    times, count = Counter(said), Counter[str]()
    for name in said:
        count[name] += 1
        yield f"{name} ({count[name]})" if times[name] > 1 else name


def lines(cutting: Cutting, rows: Sequence[int]) -> str:
    """The first lines of some rows, in words."""
    those = np.zeros(len(cutting), dtype=bool)
    those[list(rows)] = True
    return cutting.lines(those)


def designation(diameter: float, pitch: float) -> str:
    """M8 where the pitch is the coarse one, or is not known and there is a coarse one; else M8x1; nothing if no thread is."""
    wide, pitch = number(round(diameter, 6)), round(pitch, 6)
    if not 0 < pitch < wide:
        return f"M{wide:g}" if wide in COARSE_PITCH and not pitch else ""
    return f"M{wide:g}" if COARSE_PITCH.get(wide) == pitch else f"M{wide:g}x{pitch:g}"


# A closed contour: a circle, a straight slot with round ends, a rectangle, else an outline.

SAME = 1e-6  # mm, within which two sizes are one
ALIKE = 1e-6  # rad, of two directions
SHORT = 5e-3  # mm, of an element that rounding has left where arcs touch
FLAT = 1e-7  # mm, by which an arc rises that is a line
DIGITS = 8  # of a size that is said, mm


@dataclass(frozen=True)
class StraightSlot:
    """A straight slot: the centres of its round ends and its width, mm."""

    start: tuple[float, float]
    end: tuple[float, float]
    width: float


@dataclass(frozen=True)
class ArcSlot:
    """A slot along an arc, with round ends: the ends of the arc, its bulge, the width, mm."""

    start: tuple[float, float]
    end: tuple[float, float]
    bulge: float
    width: float


def number(value: float) -> float:
    """A size without the noise of its last digits."""
    return round(float(value), DIGITS) + 0.0


class Stretch(NamedTuple):
    """Elements on one line (`radius` inf, `centre` a point of it) or one circle: the first point, the last, the direction of a
    line or the sense of an arc."""

    start: Array
    end: Array
    centre: Array
    radius: float
    ahead: Array
    sense: float


def merged(loop: Contour) -> Contour:
    """The same, counter-clockwise, with one element where several lie on one line or one circle, and none of no length.

    Where a line and an arc, or two arcs, touch smoothly their common point is worked out.
    """
    loop = loop if loop.area > 0 else loop.reversed()
    found = list[Stretch]()
    for each in _stretches(loop):
        if found and _on_one(found[-1], each):
            found[-1] = found[-1]._replace(end=each.end)
        else:
            found.append(each)
    if len(found) > 1 and _on_one(found[-1], found[0]):
        found[0] = found[0]._replace(start=found.pop().start)
    if len(found) < 2:
        return Contour.circle(found[0].centre, found[0].radius) if found and math.isfinite(found[0].radius) else loop
    corners = [_corner(a, b) for a, b in zip([found[-1], *found[:-1]], found)]
    points, bulge = [], []
    for each, start, end in zip(found, corners, [*corners[1:], corners[0]]):
        points.append(start)
        if math.isinf(each.radius):
            bulge.append(0.0)
            continue
        (x0, y0), (x1, y1) = start - each.centre, end - each.centre
        sweep = each.sense * ((math.atan2(y1, x1) - math.atan2(y0, x0)) * each.sense % (2 * math.pi))
        if abs(sweep) > 1.5 * math.pi:  # in two halves
            c, d = math.cos(sweep / 2), math.sin(sweep / 2)
            points.append(each.centre + [c * x0 - d * y0, d * x0 + c * y0])
            bulge.append(math.tan(sweep / 8))
            sweep /= 2
        bulge.append(math.tan(sweep / 4))
    return Contour(points, bulge)


def _stretches(loop: Contour) -> Iterator[Stretch]:
    """The elements that are longer than what rounding leaves; arcs that hardly bend are lines."""
    ahead, _ = loop.tangents()
    columns = zip(loop.starts, loop.ends, loop.centres, loop.radii.tolist(), ahead, loop.bulge.tolist(), loop.lengths.tolist())
    for start, end, centre, radius, along, bulge, long in columns:
        if long < SHORT:
            continue
        if abs(bulge) * long / 2 < FLAT:
            yield Stretch(start, end, start, math.inf, (end - start) / long, 0.0)
        else:
            yield Stretch(start, end, centre, radius, along, math.copysign(1.0, bulge))


def _on_one(one: Stretch, other: Stretch) -> bool:
    if math.isinf(one.radius) != math.isinf(other.radius):
        return False
    if math.isinf(one.radius):
        return abs(float(cross(one.ahead, other.ahead))) < ALIKE and float(one.ahead @ other.ahead) > 0
    same = abs(one.radius - other.radius) < SAME and math.dist(one.centre, other.centre) < SAME
    return same and one.sense == other.sense


def _corner(one: Stretch, other: Stretch) -> Array:
    """Where two stretches meet: where they touch, if they do."""
    if math.isinf(one.radius) and math.isinf(other.radius):
        turn = float(cross(one.ahead, other.ahead))
        if abs(turn) > 1e-3:
            return np.asarray(one.end + one.ahead * float(cross(other.start - one.end, other.ahead)) / turn)
    elif math.isinf(one.radius) or math.isinf(other.radius):
        line, arc = (one, other) if math.isinf(one.radius) else (other, one)
        foot = line.centre + line.ahead * float((arc.centre - line.centre) @ line.ahead)
        if abs(math.dist(foot, arc.centre) - arc.radius) < SAME:
            return np.asarray(foot)
    else:
        apart = math.dist(one.centre, other.centre)
        if apart > SAME and min(abs(apart - one.radius - other.radius), abs(apart - abs(one.radius - other.radius))) < SAME:
            within = apart < max(one.radius, other.radius)  # one of the circles lies in the other
            way = (other.centre - one.centre) / apart * (-1 if within and one.radius < other.radius else 1)
            return np.asarray(one.centre + way * one.radius)
    return np.asarray((one.end + other.start) / 2)


Figure = Circle | StraightSlot | ArcSlot | Rectangle | Outline


def named(loop: Contour) -> Figure:
    """What a loop is, walked either way."""
    loop = merged(loop)
    return _circle(loop) or _straight_slot(loop) or _arc_slot(loop) or _rectangle(loop) or outline_of(loop)


def _circle(loop: Contour) -> Circle | None:
    if not loop.bulge.all() or np.ptp(loop.radii) > SAME or np.ptp(loop.centres, axis=0).max() > SAME:
        return None
    if abs(loop.sweeps.sum() - 2 * np.pi) > SAME:
        return None
    x, y = loop.centres.mean(axis=0)
    return Circle(number(x), number(y), number(2 * loop.radii.mean()))


def _straight_slot(loop: Contour) -> StraightSlot | None:
    bent = loop.bulge != 0
    if len(loop.points) != 4 or bent.sum() != 2 or bent[0] == bent[1] or bent[0] != bent[2]:
        return None
    radii = loop.radii[bent]
    if abs(radii[0] - radii[1]) > SAME or np.abs(loop.sweeps[bent] - np.pi).max() > ALIKE:
        return None
    (x0, y0), (x1, y1) = sorted(loop.centres[bent].round(DIGITS).tolist())
    return StraightSlot((x0 + 0.0, y0 + 0.0), (x1 + 0.0, y1 + 0.0), number(2 * radii.mean()))


def _arc_slot(loop: Contour) -> ArcSlot | None:
    """Two arcs about one centre, joined by two half circles."""
    if len(loop.points) != 4 or not loop.bulge.all():
        return None
    hollow = np.flatnonzero(loop.bulge < 0)
    if len(hollow) != 1:
        return None
    inner = int(hollow[0])
    out, ends = (inner + 2) % 4, [(inner + 1) % 4, (inner + 3) % 4]
    radii, centres = loop.radii, loop.centres
    width = float(radii[out] - radii[inner])
    bent = max(np.abs(loop.sweeps[ends] - np.pi).max(), np.abs(2 * radii[ends] - width).max())
    if bent > 10 * SAME or math.dist(centres[inner], centres[out]) > 10 * SAME:
        return None
    (x0, y0), (x1, y1) = centres[ends].tolist()
    return ArcSlot((number(x0), number(y0)), (number(x1), number(y1)), number(loop.bulge[out]), number(width))


def _rectangle(loop: Contour) -> Rectangle | None:
    """Four sides at right angles, with corners of one radius."""
    bent, corner = loop.bulge != 0, 0.0
    if len(loop.points) == 8 and bent.sum() == 4 and bent[0] == bent[2]:
        radii = loop.radii[bent]
        if np.ptp(radii) > SAME or np.abs(loop.sweeps[bent] - np.pi / 2).max() > ALIKE:
            return None
        corner = float(radii.mean())
    elif len(loop.points) != 4 or bent.any():
        return None
    begins, _ = loop.tangents()
    sides, ahead = loop.starts[~bent], begins[~bent]
    after = np.roll(ahead, -1, axis=0)
    if np.abs((ahead * after).sum(axis=1)).max() > ALIKE or cross(ahead, after).min() < 0:
        return None
    along = ahead[int(np.abs(ahead[:, 0]).argmax())]  # the side nearest to X
    along = along if along[0] > 0 else -along
    up = np.array([-along[1], along[0]])
    across = np.abs((ahead * along).sum(axis=1)) > 0.5  # the sides that run along
    right, high = np.sort(sides[~across] @ along), np.sort(sides[across] @ up)
    x, y = along * right.mean() + up * high.mean()
    turned = math.degrees(math.atan2(along[1], along[0]))
    sizes = float(right[1] - right[0]), float(high[1] - high[0])
    return Rectangle(number(x), number(y), number(sizes[0]), number(sizes[1]), number(corner), round(turned, 8) + 0.0)


def outline_of(loop: Contour) -> Outline:
    """A loop by its points."""
    loop = merged(loop)
    bulge = tuple(round(each, 12) + 0.0 for each in loop.bulge.tolist()) if loop.bulge.any() else ()
    return Outline(tuple((number(x), number(y)) for x, y in loop.points.tolist()), bulge)
