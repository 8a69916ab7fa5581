"""What a measuring room reads off a turned part: every dimension of the profile and of the features, as drawn and as found.

A dimension lies between two points of the drawing. Each point is where two faces meet, or stands on a face across or along
the axis: what was found of these faces, in the middle of them, tells where the point is.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Any, NamedTuple

import numpy as np

from mnclab.design.difference.difference import Row, judged, made_by
from mnclab.design.difference.half_target import SAME, HalfTarget
from mnclab.design.difference.measuring import circle
from mnclab.design.difference.threads import EXACT, passes_of
from mnclab.design.difference.turned_comparing import ALIKE, Compared, Looked, first_made
from mnclab.design.model.measures import Measure
from mnclab.design.model.turned_profile import Dimension
from mnclab.design.model.turned_threads import Thread
from mnclab.path.toolpath import Array, Index
from mnclab.workpiece.turning import revolved

FORM = "form"
UNMEASURED, NOT_CUT, IN_CHUCK = "not measured", "not cut", "in the chuck"
STRAIGHT = 1e-7  # mm, by which a face across or along the axis may lean
PARALLEL = 1e-6  # sine of the angle between two faces, which do not meet
Point = tuple[float, float]
Off = tuple[Array, Array, Index]


class Measured(NamedTuple):
    """`actual` nan where nothing could be read, and `said` why; it was read off places `at` (k, 2), which are `off` (k,)."""

    actual: float = math.nan
    at: Array = np.zeros((0, 2))
    off: Array = np.zeros(0)
    said: str = ""


NOTHING = Measured(said=UNMEASURED)


def rows_of(
    found: Compared, target: HalfTarget, looked: Looked, off: Off, tolerance: float, error: float
) -> Iterator[Row]:
    """Profile and features, each with its form: how far its faces are off at the worst."""
    design = target.design
    if design is None:
        yield _form(found, target, off, 0, tolerance, error)
        return
    room = _Room(found, target, looked)
    groups = [(design.dimensions(), None), *zip(design.dimensions_of_features(), design.features)]
    for owner, (dimensions, feature) in enumerate(groups):
        unmade = ""
        for each in dimensions:
            read = room.thread(feature, each) if isinstance(feature, Thread) else room.read(each)
            unmade = NOT_CUT if read.said == NOT_CUT and isinstance(feature, Thread) else unmade
            yield _row(found, target.names[owner], each.measure, read, _allowed(each, tolerance), error)
        if isinstance(feature, Thread) and (passes := passes_of(found.part.cutting.path, feature)):
            pitch = Measure("pitch", feature.pitch, limits=(-EXACT, EXACT))
            yield _row(found, target.names[owner], pitch, Measured(passes.worst_pitch(feature)), EXACT, 0.0)
        yield _form(found, target, off, owner, tolerance, error, unmade)


def _form(found: Compared, target: HalfTarget, off: Off, owner: int, tolerance: float, error: float, unmade: str = "") -> Row:
    """How far the faces of an owner are off at the worst; `unmade` says why there are none to judge."""
    at, value, owners = off
    mine = np.flatnonzero(owners == owner)
    worst = float(value[mine][np.abs(value[mine]).argmax()]) if len(mine) else 0.0
    read = Measured(math.nan, said=unmade) if unmade and not len(mine) else Measured(worst, at[mine], value[mine])
    return _row(found, target.names[owner], Measure(FORM, 0.0, "form"), read, target.allowed(owner, tolerance), error)


def _row(found: Compared, name: str, measure: Measure, read: Measured, allowed: float, error: float) -> Row:
    made: dict[str, Any] = {}
    worst = np.flatnonzero((np.abs(read.off) > error) & (np.abs(read.off) >= np.abs(read.off).max(initial=0.0) - ALIKE))
    if len(worst):
        k, row = first_made(found, read.at, worst)
        made = made_by(found.part.cutting, found.in_space(read.at[k]), row, 1.0)
    return judged("", name, measure, read.actual, allowed, error, error, read.said, made)


def _allowed(dimension: Dimension, tolerance: float) -> float:
    """How far a measure may be off where the drawing gives no limits: as far as its faces may, each by the tolerance."""
    measure, (z0, r0), (z1, r1) = dimension.measure, dimension.start, dimension.end
    if measure.kind == "angle":
        return math.degrees(math.atan2(2 * tolerance, max(math.hypot(z1 - z0, r1 - r0) / 2, tolerance)))
    if measure.kind == "chamfer":
        return tolerance * (1 + math.hypot(z1 - z0, r1 - r0) / max(abs(r1 - r0), SAME))
    return 2 * tolerance


class _Face(NamedTuple):
    """An element of the target: its ends, what was looked at on it, whether it is bent, and a point and direction of the line
    through what was found in the middle of it, nan where nothing was."""

    start: Array
    end: Array
    bent: bool
    at: Array
    moved: Array
    normal: Array
    middle: Array

    @property
    def ahead(self) -> Array:
        chord = self.end - self.start
        return np.asarray(chord / np.hypot(*chord))

    def supports(self, point: Point) -> bool:
        arm = np.array(point) - self.start
        return not self.bent and abs(self.ahead[0] * arm[1] - self.ahead[1] * arm[0]) <= SAME

    def from_(self, point: Point) -> float:
        """How far a point on its line is from it."""
        along = float((np.array(point) - self.start) @ self.ahead)
        return max(-along, along - float(np.hypot(*(self.end - self.start))), 0.0)

    @property
    def line(self) -> tuple[Array, Array]:
        spots = self.middle
        if not len(spots) or np.isnan(spots).any():
            return np.full(2, np.nan), self.ahead
        centre = spots.mean(axis=0)
        way = np.linalg.svd(spots - centre)[2][0]
        return centre, way if way @ self.ahead > 0 else -way


class _Room:
    """Dimensions being measured."""

    def __init__(self, found: Compared, target: HalfTarget, looked: Looked) -> None:
        self.found, self.target, self.looked = found, target, looked
        places, moved = looked.places, looked.moved
        self.there = places.place + moved[:, None] * places.normal
        toothed = target.toothed(places.place)
        self.faces: list[_Face] = []
        for number, line in enumerate(target.surface.lines):
            for k, (start, end, sweep) in enumerate(zip(line.starts, line.ends, line.sweeps)):
                mine = np.flatnonzero((places.line == number) & (places.element == k))
                share = places.share[mine]
                free = ~toothed[mine]  # beside the teeth of a thread the rest of a wall tells where it is
                inner = free & (np.abs(share - 0.5) <= 0.25 + SAME)
                middle = mine[inner if inner.sum() > 1 or not free.sum() > 1 else free]
                self.faces.append(_Face(
                    start, end, bool(sweep), places.place[mine], moved[mine], places.normal[mine], self.there[middle]
                ))  # fmt: skip

    def read(self, dimension: Dimension) -> Measured:
        """What a dimension is on the part."""
        kind, (a, b) = dimension.measure.kind, (dimension.start, dimension.end)
        if kind == "angle":
            return self._angle(dimension)
        if kind == "radius" and dimension.centre is not None:
            return self._radius(dimension)
        if kind == "diameter":
            middle = (a[0] + b[0]) / 2, (a[1] + b[1]) / 2
            across = self._coordinate(middle if a != b else a, 1)
            return across._replace(actual=2 * across.actual)
        if kind == "place":
            return self._coordinate(a, 0)
        axis = 0 if abs(a[0] - b[0]) > SAME else 1
        one, other = self._coordinate(a, axis), self._coordinate(b, axis)
        both = np.concatenate([one.at, other.at]), np.concatenate([one.off, other.off])
        return Measured(abs(one.actual - other.actual), *both, said=one.said or other.said)

    def thread(self, thread: Thread, dimension: Dimension) -> Measured:
        """Of a thread outside the diameter over its crests; that it is there at all; its length and start by its passes."""
        cutting = self.found.part.cutting
        if not len(cutting):  # a drawing has no teeth
            return NOTHING
        if dimension.measure.kind != "thread":
            if (passes := passes_of(cutting.path, thread)) is None:
                return NOTHING
            start = min(passes.start, thread.start)
            return Measured(start if dimension.measure.kind == "place" else passes.length(thread))
        middle = np.linspace(thread.end, thread.start, 2002)[1:-1]
        radii = revolved.radii_at(self.found.surface.region.loops, middle)
        ours = np.array([(each[0] if thread.inside else each[-1]) if len(each) else np.nan for each in radii])
        if not np.isfinite(ours).any():
            return Measured(said=NOT_CUT)
        deep = np.nanmax(ours) > thread.flanks / 2 if thread.inside else np.nanmin(ours) < thread.flanks / 2
        if not deep:
            return Measured(said=NOT_CUT)
        return NOTHING if thread.inside else Measured(2 * float(np.nanmax(ours)))

    def _coordinate(self, point: Point, axis: int) -> Measured:
        """z (0) or r (1) of a point of the drawing as it was found."""
        other = 1 - axis
        faces = [each for each in self.faces if each.supports(point)]
        across = [each for each in faces if abs(each.end[axis] - each.start[axis]) <= STRAIGHT]
        if across:
            face = min(across, key=lambda each: each.from_(point))
            if self.found.hangs and axis == 0 and abs(point[0] - self.target.ends[0]) <= SAME:
                return Measured(said=IN_CHUCK)
            return self._of_face(face, point, axis)
        slanting = sorted(faces, key=lambda each: each.from_(point))
        for k, one in enumerate(slanting):
            for two in slanting[k + 1 :]:
                if abs(_cross(one.ahead, two.ahead)) > PARALLEL:
                    return self._meeting(one, two, axis)
        along = [each for each in self.faces if each.supports(point) and abs(each.end[other] - each.start[other]) <= STRAIGHT]
        return self._end(point) if axis == 0 and not along else NOTHING

    def _of_face(self, face: _Face, point: Point, axis: int) -> Measured:
        spots = face.middle[:, axis]
        if np.isnan(spots).any() or not len(spots):
            return self._lost(face)
        off = spots - point[axis]
        worst = int(np.abs(off).argmax())
        return Measured(float(spots[worst]), face.middle, off)

    def _lost(self, face: _Face) -> Measured:
        """What is said of a face that was not found: where a thread has its teeth it is not looked for."""
        return NOTHING if self.target.toothed(face.at).any() else Measured(said=NOT_CUT)

    def _meeting(self, one: _Face, two: _Face, axis: int) -> Measured:
        (a, u), (b, v) = one.line, two.line
        if np.isnan(a).any() or np.isnan(b).any():
            return self._lost(one if np.isnan(a).any() else two)
        across = _cross(u, v)
        if abs(across) <= PARALLEL:  # both found on one face: the corner between them was not cut
            return self._lost(two)
        share = _cross(b - a, v) / across
        spots = np.concatenate([one.middle, two.middle])
        off = np.concatenate([_beside(each.middle, each) for each in (one, two)])
        return Measured(float((a + share * u)[axis]), spots, off)

    def _end(self, point: Point) -> Measured:
        """The end of a part that is round there."""
        for way, end, mine in zip((0, 1), self.target.ends, self.found.surface.region.bounds[:, 0]):
            if abs(point[0] - end) <= SAME and not (way == 0 and self.found.hangs):
                return Measured(float(mine), np.array([[mine, 0.0]]), np.array([mine - end]))
        return NOTHING

    def _angle(self, dimension: Dimension) -> Measured:
        a, b = dimension.start, dimension.end
        faces = [each for each in self.faces if each.supports(a) and each.supports(b)]
        if not faces:
            return NOTHING
        face = min(faces, key=lambda each: each.from_(a))
        centre, ahead = face.line
        if np.isnan(centre).any():
            return self._lost(face)
        lean = math.degrees(math.atan2(abs(ahead[1]), abs(ahead[0])))
        drawn = math.degrees(math.atan2(abs(face.ahead[1]), abs(face.ahead[0])))
        whole = 2.0 if abs(dimension.measure.nominal - 2 * drawn) < abs(dimension.measure.nominal - drawn) else 1.0
        return Measured(whole * lean, face.middle, _beside(face.middle, face))

    def _radius(self, dimension: Dimension) -> Measured:
        centre = np.array(dimension.centre)
        for face in self.faces:
            reach, there = (float(np.hypot(*(end - centre))) for end in (face.start, face.end))
            if face.bent and max(abs(reach - dimension.measure.nominal), abs(there - reach)) <= SAME:
                if np.isnan(face.middle).any():
                    return self._lost(face)
                *_, radius = circle(face.middle, centre)
                if math.isnan(radius):
                    return NOTHING
                return Measured(float(radius), face.middle, np.hypot(*(face.middle - centre).T) - reach)
        return NOTHING


def _beside(spots: Array, face: _Face) -> Array:
    """How far places (k, 2) are from the line of a face as drawn."""
    arm, ahead = spots - face.start, face.ahead
    return np.asarray(ahead[0] * arm[:, 1] - ahead[1] * arm[:, 0])


def _cross(a: Array, b: Array) -> float:
    return float(a[0] * b[1] - a[1] * b[0])
