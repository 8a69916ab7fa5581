"""The sizes of an outline as its walls were found: each wall is moved along its normal, and sizes follow from that."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from mnclab.design.model.shapes import Circle, Rectangle, Shape
from mnclab.geometry.curves import turned
from mnclab.path.toolpath import Array, Index, Mask

ON = 1e-6  # mm: places of one side
NEAR = 0.02  # of a size: places near its end, where none lies at it
NOT_CUT, GONE = "not cut", "not there"


class Faces(NamedTuple):
    """Places of walls (w, 2) as drawn, how they moved (w, 2), nan where no wall was found, which of them are far from the
    ends of their elements, and their numbers among all places that were looked at."""

    place: Array
    moved: Array
    middle: Mask
    number: Index

    def some(self, which: Mask) -> Faces:
        """Some of them."""
        return Faces(self.place[which], self.moved[which], self.middle[which], self.number[which])

    def turned(self, centre: tuple[float, float], degrees: float) -> Faces:
        """As seen from a centre along a direction."""
        angle = -math.radians(degrees)
        place, moved = self.place - np.array(centre), self.moved
        return self._replace(place=turned(place, angle) if angle else place, moved=turned(moved, angle) if angle else moved)


class Found(NamedTuple):
    """A value and the places that it was read off; nan with what to say instead."""

    actual: float
    among: Index
    said: str = ""


def sizes(shape: Shape, faces: Faces, size: float) -> Iterator[tuple[str, Found]]:
    """The measures of a shape by their names; `size` mm is about how large it is."""
    if isinstance(shape, Circle):
        yield from of_circle(shape.x, shape.y, faces)
        return
    if isinstance(shape, Rectangle):
        centre, degrees = (shape.x, shape.y), shape.turned
        half = shape.length / 2, shape.width / 2
    else:
        (x0, y0), (x1, y1) = shape.contour.bounds.tolist()
        centre, degrees, half = ((x0 + x1) / 2, (y0 + y1) / 2), 0.0, ((x1 - x0) / 2, (y1 - y0) / 2)
    seen = faces.turned(centre, degrees)
    yield from between(seen, centre, degrees, half)
    if isinstance(shape, Rectangle):
        if shape.corner:
            yield "corner radius", _corner(shape, seen)
        if shape.turned:
            yield "angle", turn(seen, half, degrees)


def of_circle(x: float, y: float, faces: Faces) -> Iterator[tuple[str, Found]]:
    """Diameter and centre of the circle through the places found."""
    there = np.isfinite(faces.moved).all(axis=1)
    if there.sum() < 3:
        said = NOT_CUT if len(faces.moved) else GONE
        yield from ((name, Found(math.nan, faces.number, said)) for name in ("diameter", "x", "y"))
        return
    px, py, radius = circle((faces.place + faces.moved)[there], np.array([x, y]))
    yield "diameter", Found(2 * radius, faces.number)
    yield "x", Found(px, faces.number)
    yield "y", Found(py, faces.number)


def between(seen: Faces, centre: tuple[float, float], degrees: float, half: tuple[float, float]) -> Iterator[tuple[str, Found]]:
    """Length, width and middle from the outermost walls, all seen from the middle as drawn."""
    shift, ends = [], []
    for axis, name in ((0, "length"), (1, "width")):
        low, high = (_end(seen, axis, sign, half[axis]) for sign in (-1, 1))
        among = np.concatenate([low.among, high.among])
        yield name, Found(2 * half[axis] + high.actual - low.actual, among, low.said or high.said)
        shift.append((low.actual + high.actual) / 2)
        ends.append((among, low.said or high.said))
    angle = math.radians(degrees)
    middle = np.array(centre) + (turned(np.array(shift), angle) if angle else np.array(shift))
    for axis, name in ((0, "x"), (1, "y")):
        among, said = ends[axis] if degrees % 180 == 0 else ends[1 - axis] if degrees % 90 == 0 else _both(ends)
        yield name, Found(float(middle[axis]), among, said)


def _both(ends: list[tuple[Index, str]]) -> tuple[Index, str]:
    return np.concatenate([ends[0][0], ends[1][0]]), ends[0][1] or ends[1][1]


def _end(seen: Faces, axis: int, sign: int, half: float) -> Found:
    """How far the wall that ends an outline on one side is moved."""
    out = sign * seen.place[:, axis]
    if not len(out) or out.max() < half - NEAR * half - ON:
        return Found(math.nan, seen.number[:0], GONE)
    here = out >= out.max() - ON
    there = here & np.isfinite(seen.moved[:, axis])
    if not there.any():
        return Found(math.nan, seen.number[here], NOT_CUT)
    best = there & seen.middle if (there & seen.middle).any() else there
    return Found(float(np.median(seen.moved[best, axis])), seen.number[here])


def _corner(shape: Rectangle, seen: Faces) -> Found:
    """The radius of the corner that is farthest off."""
    inner = np.array([shape.length / 2, shape.width / 2]) - shape.corner
    at = (np.abs(seen.place) >= inner - ON).all(axis=1) & np.isfinite(seen.moved).all(axis=1) & seen.middle
    best = Found(math.nan, seen.number[:0], GONE)
    for sx, sy in ((1, 1), (-1, 1), (-1, -1), (1, -1)):
        here = at & (seen.place * [sx, sy] > 0).all(axis=1)
        if here.sum() >= 3:
            _, _, radius = circle((seen.place + seen.moved)[here], inner * [sx, sy])
            if best.said or abs(radius - shape.corner) > abs(best.actual - shape.corner):
                best = Found(radius, seen.number[here])
    return best


def turn(seen: Faces, half: tuple[float, float], degrees: float) -> Found:
    """The direction of the straight walls along the longer sides, degrees."""
    axis = 1 if half[0] >= half[1] else 0  # of the normal
    slopes, among = [], []
    for sign in (-1, 1):
        here = (np.abs(sign * seen.place[:, axis] - half[axis]) <= ON) & seen.middle & np.isfinite(seen.moved[:, axis])
        if here.sum() >= 2:
            slopes.append(line(seen.place[here, 1 - axis], seen.moved[here, axis])[1])
            among.append(seen.number[here])
    if not slopes:
        return Found(math.nan, seen.number[:0], GONE)
    return Found(degrees + math.degrees(math.atan(np.mean(slopes))) * (1 if axis else -1), np.concatenate(among))


# Circles and lines through measured points.

ROUNDS = 20


def circle(points: Array, centre: Array) -> tuple[float, float, float]:
    """x, y and radius of the circle with the least squares of distances from points (m, 2); `centre` (2,) is a first guess."""
    x, y = (float(each) for each in centre)
    radius = float(np.hypot(*(points - centre).T).mean())
    for _ in range(ROUNDS):
        dx, dy = (points - [x, y]).T
        out = np.maximum(np.hypot(dx, dy), 1e-12)
        columns = np.stack([dx / out, dy / out, np.ones(len(out))], axis=1)
        by_x, by_y, _ = change = np.linalg.lstsq(columns, out - radius, rcond=None)[0]
        x, y, radius = x + by_x, y + by_y, radius + change[2]
        if np.abs(change).max() < 1e-12:
            break
    return x, y, radius


def line(s: Array, z: Array) -> tuple[float, float]:
    """Height at s = 0 and slope of the line with the least squares of heights z (m,) over places s (m,)."""
    middle = s.mean()
    spread = float(((s - middle) ** 2).sum())
    slope = float(((s - middle) * (z - z.mean())).sum()) / spread if spread > 0 else 0.0
    return float(z.mean() - slope * middle), slope
