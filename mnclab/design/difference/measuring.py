"""What a measuring room reads off a part for every feature of its design.

The sizes of an outline follow from its walls as they were found: each is moved along its normal."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Any, NamedTuple

import numpy as np

from mnclab.design.difference.deviations import Seen
from mnclab.design.difference.drawn_target import DrawnTarget
from mnclab.design.difference.target import BLANK, NONE, Reading
from mnclab.design.difference.threads import EXACT, LONGER, thread_of
from mnclab.design.model.feature import Feature
from mnclab.design.model.features import Chamfer, Groove, Slope, Slot, along
from mnclab.design.model.holes import Hole, metric
from mnclab.design.model.measures import Measure
from mnclab.design.model.removals import Flat, Ramp, Sloped
from mnclab.design.model.shapes import Circle, Rectangle, Shape
from mnclab.geometry.curves import turned
from mnclab.path.toolpath import Array, Index, Kind, Mask
from mnclab.workpiece.milling.raster import NOISE

FORM = "form"
OWN = 0.1  # of how far a void goes: at the edge of two faces one that is less off has no part in it
UNMEASURED = "not measured"
THREADING = ("tap", "thread mill", "thread")  # kinds of tools
TWO_SIDED = ("length", "diameter", "radius")  # kinds whose both ends may be off


def readings(target: DrawnTarget, seen: Seen) -> Iterator[Reading]:
    """Feature by feature, those of the back last; the blank's form first."""
    yield _form(target, seen, "top", "blank", [BLANK])
    design = target.design
    for back, features in ((False, design.features), (True, design.back)):
        for k, feature in enumerate(features):
            yield from _Room(target, seen, feature, k, back).readings()


def _form(target: DrawnTarget, seen: Seen, side: str, name: str, owners: list[int]) -> Reading:
    """How far the faces of a feature are off at the worst, + what is left on them, - what is gone."""
    mine = np.isin(seen.owner, owners)
    for places, way in ((seen.of_walls, seen.moved), (seen.of_slopes, seen.rise)):
        mine[places] &= ~(np.abs(seen.off[places]) < OWN * np.abs(way))
    among = np.flatnonzero(mine)
    worst = among[np.abs(seen.off[among]).argmax()] if len(among) else None
    allowed = max(target.tolerance, *(max(target.owner(each)[2:]) for each in owners))
    value = float(seen.off[worst]) if worst is not None else 0.0
    return Reading(side, name, Measure(FORM, 0.0, "form"), value, allowed, among)


class _Room:
    """One feature being measured: `mine` are the numbers of what it takes away."""

    def __init__(self, target: DrawnTarget, seen: Seen, feature: Feature, number: int, back: bool) -> None:
        self.target, self.seen, self.feature, self.back = target, seen, feature, back
        self.name = target.names[back][number]
        self.flip, self.turned = target.design.flip
        taken = target.design.taken
        self.mine = [k for k, each in enumerate(taken) if each.feature == number and each.back == back]
        self.own = bool(self.mine)
        low, high = target.bounds[:, 2].tolist()
        self.top, self.bottom = high if feature.top is None else feature.top, low
        cutting, self.thread = target.cutting, None
        if isinstance(feature, Hole) and feature.thread and not back and len(cutting):
            self.thread = thread_of(cutting, feature, self.top)
        if not self.mine:  # an island: its pocket has its faces
            floor = self.top - feature.depth  # type: ignore[attr-defined]
            floor = self.turned - floor if back else floor
            flats = [(k, each.body) for k, each in enumerate(taken) if each.back == back and isinstance(each.body, Flat)]
            self.mine = [k for k, body in flats if body.floor == floor]

    def readings(self) -> Iterator[Reading]:
        """In the order of the drawing; what was not measured says so."""
        found = list(self._found())
        side = "back" if self.back else "top"
        for measure in self.feature.measures():
            if measure.name == "top":  # only says from where depths count
                continue
            if measure.name == "thread depth" and measure.limits is None and isinstance(self.feature, Hole):
                measure = measure._replace(limits=(-self.target.tolerance, LONGER * metric(self.feature.thread)[1]))
            k = next((k for k, (name, _) in enumerate(found) if name == measure.name), None)
            value = found.pop(k)[1] if k is not None else Measured(math.nan, NONE, self._unread(measure.kind))
            yield Reading(side, self.name, measure, value.actual, self._allowed(measure), value.among, value.said)
        if isinstance(self.feature, Hole) and self.thread:
            nominal, (*_, pitch) = metric(self.feature.thread)[1], self.thread
            said = "" if pitch > 0 else UNMEASURED
            yield Reading(side, self.name, Measure("pitch", nominal, limits=(-EXACT, EXACT)), pitch, EXACT, NONE, said)
        if self.own:
            yield _form(self.target, self.seen, side, self.name, self.mine)

    def _unread(self, kind: str) -> str:
        """What is said of a measure that is not read off the part: a thread without a move that could have cut it is not cut."""
        cutting, hole = self.target.cutting, self.feature
        if kind != "thread" or not isinstance(hole, Hole) or self.back or not len(cutting):  # a drawing has no teeth
            return UNMEASURED
        path, of_threads = cutting.path, np.array([tool.kind in THREADING for tool in cutting.tools] or [False], dtype=bool)
        rises = (path.kind == Kind.ARC) & (path.start[:, 2] != path.end[:, 2])
        near = np.hypot(*(path.end[:, :2] - (hole.x, hole.y)).T) < hole.wide / 2
        return UNMEASURED if (near & (path.synchronous | rises | of_threads[cutting.which])).any() else NOT_CUT

    def _found(self) -> Iterator[tuple[str, Measured]]:
        feature: Any = self.feature
        if isinstance(feature, Hole):
            yield from self._hole(feature)
            return
        if isinstance(feature, Chamfer):
            yield from self._slant("bevel", "width", "angle", 1.0)
            return
        if isinstance(feature, Slope):
            yield from sizes(feature.contour, self._walls("floor"), 0.0)
            yield from self._fall(feature)
            return
        if isinstance(feature, Slot):
            yield from self._slot(feature)
        elif isinstance(feature, Groove):
            faces = self._walls("")
            moved = -np.einsum("ij,ij->i", faces.moved, self._normals(faces))
            good = np.isfinite(moved)
            wide = feature.width + 2 * float(moved[good].mean()) if good.any() else math.nan
            yield "width", Measured(wide, faces.number, "" if good.any() else NOT_CUT)
            wider = (wide - feature.width) / 2 if good.any() else 0.0  # of both walls: it does not move the middle
            normals = self._normals(faces)
            middle = faces._replace(place=faces.place + feature.width / 2 * normals, moved=faces.moved + wider * normals)
            yield from ((along(name), found) for name, found in sizes(feature.contour, middle, feature.width))
        elif hasattr(feature, "contour"):
            faces = self._walls("")
            if not self.own and len(faces.place):
                faces = faces.some(feature.contour.contour.distance(faces.place) <= ON)
            yield from sizes(feature.contour, faces, 0.0)
        yield "depth", self._depth(self._of_part(""), self.top - feature.depth)

    # --- its faces, in the frame in which it is drawn ----------------------------------------------------------------

    def _of_part(self, part: str) -> list[int]:
        if not self.own:
            return self.mine
        return [k for k in self.mine if self.target.design.taken[k].body.part == part]

    def _walls(self, part: str) -> Faces:
        walls, owners = self.seen.walls, self._of_part(part)
        index = np.flatnonzero(np.isin(walls.owner[walls.spot], owners) & walls.mid)
        spot = walls.spot[index]
        place, moved = walls.place[spot], self.seen.moved[index, None] * walls.normal[spot]
        if self.back:
            place, moved = place @ self.flip[:2, :2].T + self.flip[:2, 2], moved @ self.flip[:2, :2].T
        return Faces(place, moved, walls.middle[spot], index)

    def _normals(self, faces: Faces) -> Array:
        normal = self.seen.walls.normal[self.seen.walls.spot[faces.number]]
        return normal @ self.flip[:2, :2].T if self.back else normal

    def _depth(self, owners: list[int], floor: float) -> Measured:
        """Of the place of a floor that is farthest off; where its walls are nearer, what is left or gone is theirs."""
        seen, cells = self.seen, self.seen.cells
        through = floor <= self.bottom + NOISE
        own = seen.cells_above(owners, self.back)
        if through:
            off = own[np.isnan(cells.at.its_top[own])]
            left = (cells.at.floor if self.back else cells.at.top)[off]
            level = self.turned - left if self.back else left
            return Measured(self.top - (floor if not len(off) else float(level.max())), off + seen.of_cells.start)
        off = own[np.isfinite(cells.at.its_top[own])]
        at = cells.at.some(off)
        above = at.its_floor - at.floor if self.back else at.top - at.its_top
        slopes = np.flatnonzero(np.isin(seen.slopes.owner, owners))
        rise = np.concatenate([above, seen.rise[slopes]])
        index = np.concatenate([off + seen.of_cells.start, slopes + seen.of_slopes.start])
        cells_of_it = sum(int(seen.sizes[self.back][k + 1]) for k in owners if k + 1 < len(seen.sizes[self.back]))
        if not len(slopes) and not cells_of_it:
            return Measured(math.nan, NONE, GONE)
        rise = np.nan_to_num(rise, nan=self.bottom - floor)  # gone right through
        nearest = np.abs(np.abs(rise) - np.abs(seen.off[index])) <= max(NOISE, seen.least)
        mine = nearest & np.append(cells.plain[off], np.ones(len(slopes), dtype=bool))
        if not mine.any() and cells_of_it == len(off):
            mine = nearest if nearest.any() else ~nearest
        best = float(rise[mine][np.abs(rise[mine]).argmax()]) if mine.any() else 0.0
        best = best if abs(best) > seen.least else 0.0
        return Measured(self.top - floor - best, index[mine])

    # --- features ----------------------------------------------------------------------------------------------------

    def _slot(self, slot: Slot) -> Iterator[tuple[str, Measured]]:
        """From the circles of its ends and the straight walls between them."""
        long, half = math.dist(slot.start, slot.end), slot.width / 2
        middle = (slot.start[0] + slot.end[0]) / 2, (slot.start[1] + slot.end[1]) / 2
        faces = self._walls("")
        seen = faces.turned(middle, math.degrees(math.atan2(slot.end[1] - slot.start[1], slot.end[0] - slot.start[0])))
        yield "width", dict(between(seen, middle, 0.0, (long / 2 + half, half)))["width"]
        ends = []
        for sign, place in ((-1, slot.start), (1, slot.end)):
            found = dict(of_circle(*place, faces.some((sign * seen.place[:, 0] >= long / 2 + ON) & seen.middle)))
            ends.append((found["x"], found["y"]))
        (x0, y0), (x1, y1) = ([each.actual for each in end] for end in ends)
        among = np.concatenate([end[0].among for end in ends])
        said = ends[0][0].said or ends[1][0].said
        values = {"length": math.hypot(x1 - x0, y1 - y0), "x": (x0 + x1) / 2, "y": (y0 + y1) / 2}
        turned = math.degrees(math.atan2(y1 - y0, x1 - x0)) % 180
        yield from ((name, Measured(value, among, said)) for name, value in (values | {"angle": turned}).items())

    def _hole(self, hole: Hole) -> Iterator[tuple[str, Measured]]:
        found = dict(of_circle(float(hole.x), float(hole.y), self._walls("")))
        yield from found.items()
        if self.thread:
            yield from (("thread", Measured(self.thread[0], NONE)), ("thread depth", Measured(self.thread[1], NONE)))
        if hole.tip:
            yield from self._point(hole, found)
        elif hole.depth is not None:
            yield "depth", self._depth(self._of_part(""), self.top - hole.depth)
        if hole.counterbore:
            around = dict(of_circle(float(hole.x), float(hole.y), self._walls("counterbore")))
            yield "counterbore diameter", around["diameter"]
            yield "counterbore depth", self._depth(self._of_part("counterbore"), self.top - hole.counterbore[1])
        if hole.countersink:
            yield from self._slant("countersink", "countersink diameter", "countersink angle", 2.0)

    def _point(self, hole: Hole, around: dict[str, Measured]) -> Iterator[tuple[str, Measured]]:
        """Depth to the shoulder and point angle, from the cone about the circle found."""
        wide, x, y = (around[name].actual for name in ("diameter", "x", "y"))
        if math.isnan(wide):
            wide, x, y = hole.wide, hole.x, hole.y
        s, z, index, body = self._cone("point", (x, y))
        if body is None or not len(s):
            yield "depth", Measured(math.nan, NONE, GONE)
            return
        start, slope = line(s, z)
        if not slope > 0.05 * hole.tip / (hole.wide / 2):
            yield "depth", Measured(self.top - float(z.min()), index)
            yield "point angle", Measured(math.nan, index, NOT_CUT)
            return
        yield "depth", Measured(self.top - (start + slope * wide / 2), np.concatenate([index, around["diameter"].among]))
        yield "point angle", Measured(2 * math.degrees(math.atan(1 / slope)), index)

    def _slant(self, part: str, size: str, angle: str, sides: float) -> Iterator[tuple[str, Measured]]:
        """How wide a chamfer or a countersink is at its upper edge, and its angle."""
        s, z, index, body = self._cone(part)
        if body is None or not len(s):
            yield from ((name, Measured(math.nan, NONE, GONE)) for name in (size, angle))
            return
        edge = self.turned - body.open if self.back else body.open
        cut = z < edge - ON
        if not cut.any():
            yield from ((name, Measured(math.nan, index, NOT_CUT)) for name in (size, angle))
            return
        start, slope = line(s[cut], z[cut])
        if not slope > 0:  # of one ring alone: as steep as it is drawn
            slope = abs((body.open - body.deep) / (body.far - body.near))
            start = float((z[cut] - slope * s[cut]).mean())
        steep = math.degrees(math.atan(slope))
        yield size, Measured(sides * (edge - start) / slope, index)
        yield angle, Measured(steep if sides == 1 else 2 * (90 - steep), index)

    def _fall(self, slope: Slope) -> Iterator[tuple[str, Measured]]:
        """Depths at both ends, by a straight line through the floor found between them."""
        s, z, index, body = self._cone("floor")
        ends = "start depth", "end depth"
        if not isinstance(body, Ramp) or not len(s):
            yield from ((name, Measured(math.nan, NONE, GONE)) for name in ends)
            return
        deep, rise = line(s, z)
        names = ends if slope.start_depth > slope.end_depth else ends[::-1]
        yield names[0], Measured(self.top - deep, index)
        yield names[1], Measured(self.top - (deep + rise * slope.length), index)

    def _cone(self, part: str, centre: tuple[float, float] | None = None) -> tuple[Array, Array, Index, Sloped | None]:
        """Distances from the base of a slant and the heights found there, seen from the side of the feature."""
        owners, slopes = self._of_part(part), self.seen.slopes
        body = self.target.design.taken[owners[0]].body if owners else None
        index = np.flatnonzero(np.isin(slopes.owner, owners) & slopes.middle)
        still = np.isin(self.seen.owner[self.seen.of_slopes][index], owners)  # where no other face has come nearer
        index = index[still] if still.any() else index
        level = self.turned - slopes.z[index] if self.back else slopes.z[index]
        found = level + self.seen.rise[index]
        out = slopes.out[index]
        if centre is not None:
            place = slopes.place[index]
            place = place @ self.flip[:2, :2].T + self.flip[:2, 2] if self.back else place
            out = np.hypot(*(place - np.array(centre)).T)
        return out, found, index + self.seen.of_slopes.start, body if not isinstance(body, Flat) else None

    def _allowed(self, measure: Measure) -> float:
        """How far a measure may be off where the drawing gives no limits: as far as faces may, each by the tolerance."""
        tolerance = self.target.tolerance
        if measure.kind == "angle":
            legs = [each.nominal for each in self.feature.measures() if each.kind in ("length", "diameter", "chamfer")]
            return math.degrees(math.atan2(2 * tolerance, max(legs) / 2 if legs else 1.0))
        if measure.kind == "chamfer" or measure.name == "countersink diameter":
            given = self.feature.countersink if isinstance(self.feature, Hole) else None
            angle = given[1] if given else getattr(self.feature, "angle", 90.0)
            return tolerance / math.cos(math.radians(angle / 2)) * (2 if given else 1)
        if measure.name == "depth" and isinstance(self.feature, Hole) and self.feature.tip:
            half = math.radians(self.feature.point / 2)
            return tolerance * (1 + math.cos(half)) / math.sin(half)
        return tolerance * (2 if measure.kind in TWO_SIDED else 1)


# The sizes of an outline as its walls were found.

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


class Measured(NamedTuple):
    """A value and the places that it was read off; nan with what to say instead."""

    actual: float
    among: Index
    said: str = ""


def sizes(shape: Shape, faces: Faces, size: float) -> Iterator[tuple[str, Measured]]:
    """The measures of a shape by their names; `size` mm is about how large it is."""
    if isinstance(shape, Circle):
        away = np.hypot(*(faces.place - np.array([shape.x, shape.y])).T)
        own = np.abs(away - shape.diameter / 2) < NEAR * shape.diameter  # without islands
        yield from of_circle(shape.x, shape.y, faces.some(own))
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


def of_circle(x: float, y: float, faces: Faces) -> Iterator[tuple[str, Measured]]:
    """Diameter and centre of the circle through the places found."""
    there = np.isfinite(faces.moved).all(axis=1)
    if there.sum() < 3:
        said = NOT_CUT if len(faces.moved) else GONE
        yield from ((name, Measured(math.nan, faces.number, said)) for name in ("diameter", "x", "y"))
        return
    px, py, radius = circle((faces.place + faces.moved)[there], np.array([x, y]))
    for name, value in (("diameter", 2 * radius), ("x", px), ("y", py)):
        yield name, Measured(value, faces.number, GONE if math.isnan(value) else "")


def between(
    seen: Faces, centre: tuple[float, float], degrees: float, half: tuple[float, float]
) -> Iterator[tuple[str, Measured]]:
    """Length, width and middle from the outermost walls, all seen from the middle as drawn."""
    shift, ends = [], []
    for axis, name in ((0, "length"), (1, "width")):
        low, high = (_end(seen, axis, sign, half[axis]) for sign in (-1, 1))
        among = np.concatenate([low.among, high.among])
        yield name, Measured(2 * half[axis] + high.actual - low.actual, among, low.said or high.said)
        shift.append((low.actual + high.actual) / 2)
        ends.append((among, low.said or high.said))
    angle = math.radians(degrees)
    middle = np.array(centre) + (turned(np.array(shift), angle) if angle else np.array(shift))
    for axis, name in ((0, "x"), (1, "y")):
        among, said = ends[axis] if degrees % 180 == 0 else ends[1 - axis] if degrees % 90 == 0 else _both(ends)
        yield name, Measured(float(middle[axis]), among, said)


def _both(ends: list[tuple[Index, str]]) -> tuple[Index, str]:
    return np.concatenate([ends[0][0], ends[1][0]]), ends[0][1] or ends[1][1]


def _end(seen: Faces, axis: int, sign: int, half: float) -> Measured:
    """How far the wall that ends an outline on one side is moved."""
    out = sign * seen.place[:, axis]
    if not len(out) or out.max() < half - NEAR * half - ON:
        return Measured(math.nan, seen.number[:0], GONE)
    here = out >= out.max() - ON
    there = here & np.isfinite(seen.moved[:, axis])
    if not there.any():
        return Measured(math.nan, seen.number[here], NOT_CUT)
    best = there & seen.middle if (there & seen.middle).any() else there
    return Measured(float(np.median(seen.moved[best, axis])), seen.number[here])


def _corner(shape: Rectangle, seen: Faces) -> Measured:
    """The radius of the corner that is farthest off."""
    inner = np.array([shape.length / 2, shape.width / 2]) - shape.corner
    at = (np.abs(seen.place) >= inner - ON).all(axis=1) & np.isfinite(seen.moved).all(axis=1) & seen.middle
    best = Measured(math.nan, seen.number[:0], GONE)
    for sx, sy in ((1, 1), (-1, 1), (-1, -1), (1, -1)):
        here = at & (seen.place * [sx, sy] > 0).all(axis=1)
        if here.sum() >= 3:
            _, _, radius = circle((seen.place + seen.moved)[here], inner * [sx, sy])
            if not math.isnan(radius) and (best.said or abs(radius - shape.corner) > abs(best.actual - shape.corner)):
                best = Measured(radius, seen.number[here])
    return best


def turn(seen: Faces, half: tuple[float, float], degrees: float) -> Measured:
    """The direction of the straight walls along the longer sides, degrees."""
    axis = 1 if half[0] >= half[1] else 0  # of the normal
    slopes, among = [], []
    for sign in (-1, 1):
        here = (np.abs(sign * seen.place[:, axis] - half[axis]) <= ON) & seen.middle & np.isfinite(seen.moved[:, axis])
        if here.sum() >= 2:
            slopes.append(line(seen.place[here, 1 - axis], seen.moved[here, axis])[1])
            among.append(seen.number[here])
    if not slopes:
        return Measured(math.nan, seen.number[:0], GONE)
    return Measured(degrees + math.degrees(math.atan(np.mean(slopes))) * (1 if axis else -1), np.concatenate(among))


# Circles and lines through measured points.

ROUNDS = 20
FLAT = 1000.0  # times the size of what was measured: a circle of more is a wall that goes straight on


def circle(points: Array, centre: Array) -> tuple[float, float, float]:
    """x, y and radius of the circle with the least squares of distances from points (m, 2), nan where they are on no circle
    that they would tell from a line; `centre` (2,) is a first guess.
    """
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
    flat = not 0 < radius <= FLAT * float(np.ptp(points, axis=0).max())
    return (math.nan, math.nan, math.nan) if flat else (x, y, radius)


def line(s: Array, z: Array) -> tuple[float, float]:
    """Height at s = 0 and slope of the line with the least squares of heights z (m,) over places s (m,)."""
    middle = s.mean()
    spread = float(((s - middle) ** 2).sum())
    slope = float(((s - middle) * (z - z.mean())).sum()) / spread if spread > 0 else 0.0
    return float(z.mean() - slope * middle), slope
