"""What a value of a cycle measures, found by trying: the cycle runs once more with the value a little greater or smaller.

Places that move with it tell what it is, whatever the control calls it. With v the value and s the speed of a place (how far
it goes when the value grows by 1) the place stood at q - s v when the value was 0, and the dimension reaches from there to q.
Two sides that part from each other are a size, an arc that grows about its centre is a radius, what turns about a point is
an angle; where no place moves but a feed, a time or a speed changes, its moves are meant. A length moves something as far as
it grows itself, a diameter half as far: those places count, and where there are none the slowest (pecks go down by one, two,
three times their depth). Places are mm, in the coordinates of the path.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from functools import cached_property
from typing import NamedTuple

import numpy as np

from mnclab.path.toolpath import Array, Index, Kind, Mask, Toolpath

SAME = 1e-6  # mm
STILL = 0.02  # of the speed of a length: what is slower stands
ALIKE = 2e-4  # parts of a speed, by which speeds differ that are the same
MOST = 12  # directions of lines that are looked along
JUMP = 0.05  # mm: what is farther off is another move
AHEAD = 200  # moves that are looked at for the same one
FAR = 1e3  # mm, between moves of different kinds
AXES = np.eye(3)


class Length(NamedTuple):
    """A dimension between two places (3,), along a way (3,) of length 1 that it has at a value of 0, too."""

    begin: Array
    end: Array
    way: Array


class Radius(NamedTuple):
    """From the centre (3,) of an arc to a place (3,) on it."""

    centre: Array
    end: Array


class Angle(NamedTuple):
    """From the direction of an arm (3,) about a centre (3,), by so many radians, towards the axis after the first of `plane`."""

    centre: Array
    arm: Array
    sweep: float
    plane: tuple[int, int]


class Moves(NamedTuple):
    """The rows of the path that a value acts in."""

    rows: Mask


Measured = Length | Radius | Angle | Moves


class Speeds:
    """Places (n, 3) of a path, the ends of its moves, and how fast they move with a value."""

    def __init__(self, path: Toolpath, other: Toolpath, step: float, value: float, unit: str) -> None:
        self.path, self.other, self.step, self.value = path, other, step, value
        self.counts = float(unit.split()[0]) if unit[:1].isdigit() else 1.0  # mm or radians of a unit
        self.counts *= math.pi / 180 if unit == "deg" else 0.5 if "diameter" in unit else 1.0
        self.place = path.end
        self.speed, self.before = ((getattr(other, each) - getattr(path, each)) / step for each in ("end", "start"))
        self.radius = 0.0 if path.lathe else float(np.nan_to_num(path.radius).max(initial=0.0))

    @cached_property
    def moving(self) -> Mask:
        """Which places move."""
        return np.asarray(np.linalg.norm(self.speed, axis=1) > STILL * self.counts)

    def own(self, rates: Array) -> Mask:
        """Which rates (n,) are those of a length, of a diameter where there are none, else the slowest; nothing that stands."""
        rates = np.abs(rates)
        for wanted in (self.counts, self.counts / 2):
            if (found := np.abs(rates - wanted) < ALIKE * wanted).any():
                return found
        moves = rates > STILL * self.counts
        return moves & (rates < 1.02 * rates[moves].min(initial=np.inf))

    def off(self, way: Array) -> tuple[Index, Array]:
        """The places (m,) that a value moves along a way, and how far at 0 from what stands (n, m), the datum first."""
        rows = np.flatnonzero(self.own(self.speed @ way))
        still = np.append(0.0, self.place[~self.moving] @ way)
        return rows, (self.place[rows] - self.speed[rows] * self.value) @ way - still[:, None]

    def natural(self, rates: Array) -> bool:
        """Whether a length, or a diameter, moves something as fast."""
        return any(bool((np.abs(np.abs(rates) - each) < ALIKE * each).any()) for each in (self.counts, self.counts / 2))


def measured(path: Toolpath, other: Toolpath, step: float, value: float, unit: str) -> Measured | None:
    """What a value measures, when `path` becomes the `other` as it grows by a step; None where nothing can be told."""
    rows, those = pairs(path, other)
    if not len(rows):
        return None
    found = Speeds(path[rows], other[those], step, value, unit)
    way = moved(found, unit) or Moves(found.moving) if found.moving.any() else acts_in(found, unit)
    return Moves(np.isin(np.arange(len(path)), rows[way.rows])) if isinstance(way, Moves) else way


def moved(found: Speeds, unit: str) -> Measured | None:
    """The dimension that the places that move tell."""
    if unit == "deg":
        return angle(found)
    if "mm" in unit and heights(found):
        return level(found, AXES[2]) if found.natural(found.speed[:, 2]) else pitch(found)
    first = pitch(found) if unit == "mm/rev" else None
    return first or size(found) or offset(found) or round_about(found) or pitch(found) or sideways(found)


def pairs(path: Toolpath, other: Toolpath) -> tuple[Index, Index]:
    """The rows (n,) of two paths that are the same moves, of a little other lengths; what one has alone is left out."""
    columns = [np.column_stack([each.kind * FAR, each.start, each.end]) for each in (path, other)]
    if len(path) == len(other):
        rows = np.flatnonzero(np.abs(columns[1] - columns[0]).max(axis=1) < JUMP)
        if 2 * len(rows) > len(path):
            return rows, rows
    found, begin = [], 0
    for row, each in enumerate(columns[0]):
        near = np.abs(columns[1][begin : begin + AHEAD] - each).max(axis=1, initial=0.0) < JUMP
        if near.any():
            found.append((row, begin + int(np.argmax(near))))
            begin = found[-1][1] + 1
    both = np.array(found, dtype=np.int64).reshape(-1, 2)
    return both[:, 0], both[:, 1]


def acts_in(found: Speeds, unit: str) -> Measured | None:
    """The rows whose feed, time or speed changes; where a thread is cut and a length changes it, the pitch."""
    path, other = found.path, found.other
    rows = np.zeros(len(path), dtype=bool)
    for name in ("feed", "time", "spindle", "per_rev", "surface"):
        one, two = (np.nan_to_num(getattr(each, name).astype(float), posinf=1e9) for each in (path, other))
        rows |= ~np.isclose(one, two, rtol=1e-9, atol=1e-12)
    cuts = np.flatnonzero(rows & path.synchronous & (path.kind == Kind.LINE))
    if "mm" in unit and "min" not in unit and len(cuts):
        row = int(cuts[0])
        turn = float(other.per_rev[row] - path.per_rev[row])
        if math.isnan(turn):
            turn = float(other.feed[row] - path.feed[row]) / max(abs(float(path.spindle[row])), SAME)
        way = path.end[row] - path.start[row]
        long = abs(turn / found.step * found.value)
        way = way / float(np.linalg.norm(way))
        return Length(path.start[row], path.start[row] + way * long, way)
    return Moves(rows) if rows.any() else None


def heights(found: Speeds) -> bool:
    """Whether most of the places that move go up and down, or any as far as a length does."""
    up = np.abs(found.speed[found.moving])
    straight = up[:, 2] > 0.9999 * np.linalg.norm(up, axis=1)
    return not found.path.lathe and (bool(straight.sum() * 2 > len(up)) or found.natural(up[straight, 2]))


def level(found: Speeds, way: Array) -> Length:
    """Where places stand along a direction, counted from what stands still, or from the datum where all go along."""
    rows, gap = found.off(way)
    place, rate, value = found.place[rows], found.speed[rows] @ way, found.value
    half = not found.path.lathe and abs(abs(rate[0]) - found.counts / 2) < ALIKE * found.counts  # one side of what has two
    if half and rate.min() < 0 < rate.max():
        sides = [rows[rate > 0][np.argmax(place[rate > 0] @ way)], rows[rate < 0][np.argmin(place[rate < 0] @ way)]]
        middle = found.place[sides].mean(axis=0)
        return Length(middle - way * found.counts * value / 2, middle + way * found.counts * value / 2, way)
    off = np.abs(gap)
    if (abs(way[2]) < SAME or Kind.PROBE in found.path.kind) and off.min() > SAME:  # the path keeps the radius of the tool off
        off = np.abs(off - found.radius)
    best = np.argwhere(np.maximum(off, SAME) <= max(float(off.min()), SAME))
    best = best[best[:, 0] == 0] if not best[0, 0] else best
    often = (np.abs(place[best[:, 1]] @ way - (place @ way)[:, None]) < SAME).sum(axis=0)  # the level of most moves
    which, k = best[int(np.argmax(often))]
    end = place[k] - way * (gap[which, k] if off[which, k] <= SAME else 0.0)
    near = not half and abs(way[2]) < SAME and rate[k] > 0 and abs(gap[0, k]) < abs(value)  # but for a clearance
    surface = value == 0 and abs(way[2]) > SAME and (place @ way).min() < 0 < (place @ way).max()  # what is over it goes along
    if surface or (off[which, k] > SAME and (found.moving.all() or near)):  # a place, counted from the datum
        end = (found.place.min(axis=0) + found.place.max(axis=0)) / 2 if found.moving.all() else end
        return Length(end - way * (end @ way), end + way * (rate[0] * value - end @ way), way)
    return Length(end - way * rate[k] * value * (2 if half else 1), end, way)


def sideways(found: Speeds) -> Length | None:
    """A position along the axis in which most places move as a length does, or in the direction of the first that moves."""
    first = found.speed[found.moving][0]
    ways = [*AXES] if found.path.lathe else [*AXES, first / np.linalg.norm(first)]
    count = [int(found.own(found.speed @ way).sum()) * found.natural(found.speed @ way) for way in ways]
    return level(found, ways[int(np.argmax(count))]) if any(count) else None


def pitch(found: Speeds) -> Length | None:
    """How far a helix rises in one turn."""
    rows = np.flatnonzero(found.path.kind == Kind.ARC)
    rise, other = (
        (2 * math.pi * (each.end[rows] - each.start[rows]) * (np.abs(each.axis[rows]) > 0.5) / np.abs(each.sweep[rows, None]))
        for each in (found.path, found.other)
    )
    rate = (np.linalg.norm(other, axis=1) - np.linalg.norm(rise, axis=1)) / found.step
    if not found.natural(rate):
        return None
    k = int(np.argmax(found.own(rate)))
    way = rise[k] / float(np.linalg.norm(rise[k]))
    return Length(found.path.start[rows[k]], found.path.start[rows[k]] + rise[k], way)


def is_size(long: float, base: float, room: float) -> bool:
    """Whether what is so long was nothing at value 0: but for the room that a tool takes, or at least by far shorter."""
    return abs(base) <= room + 10 * SAME or abs(base) < long / 2


def size(found: Speeds) -> Length | None:
    """The width of all that is cut, in the direction of an axis or of a line, where it grows as the value does."""
    path = found.path
    cuts = np.flatnonzero(np.isin(path.kind, (Kind.LINE, Kind.ARC, Kind.PROBE)))
    if path.lathe or not len(cuts):
        return None
    line = path.end[cuts] - path.start[cuts]
    long = np.hypot(line[:, 0], line[:, 1])
    flat = (long > SAME) & (np.abs(line[:, 2]) < SAME) & (path.kind[cuts] == Kind.LINE)
    turn = np.unique(np.round(np.arctan2(line[flat, 1], line[flat, 0]) % (math.pi / 2), 6)) if flat.any() else np.zeros(0)
    for angle in dict.fromkeys([0.0, *turn[:MOST]]):
        for more in (0.0, math.pi / 2):
            way = np.array([math.cos(angle + more), math.sin(angle + more), 0.0])
            ends = [(found.place[cuts] @ way, found.speed[cuts] @ way), (path.start[cuts] @ way, found.before[cuts] @ way)]
            q, rate = (np.concatenate(each) for each in zip(*ends, strict=True))
            up, down = int(np.argmax(q)), int(np.argmin(q))
            grows = rate[up] - rate[down]
            if abs(grows - found.counts) > ALIKE * found.counts or rate[up] * rate[down] > 0:
                continue
            width = grows * found.value
            if not is_size(q[up] - q[down], q[up] - q[down] - width, 2 * found.radius):
                continue
            off = np.abs(np.abs(found.off(way)[1]) - [[[0.0]], [[found.radius]]])
            if rate[up] * rate[down] == 0 and off.min(initial=FAR) < SAME:
                continue  # the side that moves is a place, counted from another one
            place = np.concatenate([found.place[cuts], path.start[cuts]])
            middle = (place[up] + place[down]) / 2
            return Length(middle - way * width / 2, middle + way * width / 2, way)
    return None


def wall(found: Speeds, place: Array, speed: Array) -> Length:
    """What a path keeps from a wall, drawn at the wall: the tool stands between both. What has two walls moves half as fast."""
    fast = float(np.linalg.norm(speed))
    way = speed / fast
    if abs(fast - found.counts / 2) < ALIKE * found.counts:
        end = place + way * found.radius
        return Length(end - 2 * speed * found.value, end, way)
    edge = -way * math.copysign(found.radius, found.value)
    return Length(place - speed * found.value + edge, place + edge, way)


def offset(found: Speeds) -> Length | None:
    """Where lines of several directions move aside alike: what is left at a wall, or twice the distance from the middle."""
    path = found.path
    way = path.end - path.start
    long = np.hypot(way[:, 0], way[:, 1])
    rows = np.flatnonzero((path.kind == Kind.LINE) & (long > SAME) & (np.abs(way[:, 2]) < SAME))
    if not len(rows) or path.lathe:
        return None
    normal = np.stack([-way[rows, 1], way[rows, 0], 0 * rows], axis=1) / long[rows, None]
    aside, after = (np.einsum("ij,ij->i", normal, each[rows]) for each in (found.before, found.speed))
    if not found.natural(aside):
        return None
    own = found.own(aside) & (np.abs(aside - after) < ALIKE * found.counts)
    if not own.any() or np.ptp(np.abs(normal[own, 0])) < 0.1:
        return None
    outer = path.end[rows[own]]
    centre = (outer.min(axis=0) + outer.max(axis=0)) / 2
    far = np.where(own, long[rows], 0.0)
    k = int(np.argmax(far))
    middle = (path.start[rows[k]] + path.end[rows[k]]) / 2
    speed = normal[k] * aside[k]
    base = middle - speed * found.value
    centre[2] = middle[2]
    grows = float((middle - centre) @ speed) * found.value > 0
    if grows and is_size(abs(float((middle - centre) @ normal[k])), float((base - centre) @ normal[k]), found.radius):
        return Length(centre - speed * found.value, centre + speed * found.value, normal[k])
    return wall(found, middle, speed)


def round_about(found: Speeds) -> Length | Radius | None:
    """The radius of the greatest arc that grows, a diameter where it grows by half; or of places around a common middle."""
    path = found.path
    rows = np.flatnonzero(path.kind == Kind.ARC)
    plane = 1.0 - (np.abs(path.axis[rows]) > 0.5)  # without the rise of a helix
    arms = (path.end[rows] - path.centre[rows]) * plane
    grown = (found.other.end[rows] - found.other.centre[rows]) * plane
    radius = np.linalg.norm(arms, axis=1)
    rate = (np.linalg.norm(grown, axis=1) - radius) / found.step
    if not found.natural(rate):
        return _pitch_circle(found)
    own = np.flatnonzero(found.own(rate))
    k = int(own[np.argmax(radius[own])])
    centre = np.where(plane[k] > 0, path.centre[rows[k]], path.end[rows[k]])
    sweep = float(path.sweep[rows[k]])
    half = -sweep / 2 if abs(sweep) < 4 else math.pi / 4
    way = arms[k] * math.cos(half) + np.cross(path.axis[rows[k]], arms[k]) * math.sin(half)
    inner = own[(rate[own] * rate[k] < 0) & (np.abs(path.centre[rows[own]] - path.centre[rows[k]]).max(axis=1) < SAME)]
    if len(inner):  # a ring
        other = int(inner[np.argmin(radius[inner])])
        width, middle = (rate[k] - rate[other]) * found.value, (radius[k] + radius[other]) / 2
        if width > 0 and is_size(radius[k] - radius[other], radius[k] - radius[other] - width, 2 * found.radius):
            ends = [centre + way / radius[k] * (middle + side * width / 2) for side in (-1, 1)]
            return Length(ends[0], ends[1], way / radius[k])
    return _grown(found, centre, way / radius[k], radius[k], rate[k])


def _grown(found: Speeds, centre: Array, way: Array, radius: float, rate: float) -> Length | Radius:
    """What makes an arc of a radius grow at a rate."""
    if rate * found.value < 0 or not is_size(radius, radius - rate * found.value, found.radius):
        return wall(found, centre + way * radius, way * rate)
    end = way * abs(rate * found.value)
    if abs(rate) < 0.75 * found.counts:
        return Length(centre - end, centre + end, way)
    return Radius(centre, centre + end)


def _pitch_circle(found: Speeds) -> Length | Radius | None:
    """Places that go out from a common middle, all at one speed."""
    place, speed = found.place[found.moving], found.speed[found.moving]
    fast = np.linalg.norm(speed, axis=1)
    ways = speed / fast[:, None]
    if np.ptp(fast) > 1e-3 * fast.max() or np.abs(ways[:, 2]).max() > SAME:
        return None
    middle = _meeting(place, np.stack([-ways[:, 1], ways[:, 0]], axis=1))
    if middle is None:
        return None
    arm = (place - np.append(middle, 0.0)) * (1.0, 1.0, 0.0)
    out = np.linalg.norm(arm, axis=1)
    if out.min() < SAME or np.ptp(out) > 1e-3 * out.max():
        return None
    k = int(np.argmax(arm @ (1.0, 0.3, 0.0)))
    rate = float(fast[k] * np.sign(arm[k] @ ways[k]))
    return _grown(found, np.array([*middle, place[k, 2]]), arm[k] / out[k], float(out[k]), rate)


def _meeting(place: Array, normal: Array, plane: Sequence[int] = (0, 1)) -> Array | None:
    """The point (2,) where lines through places with these normals (n, 2) meet; None where they do not."""
    level = np.einsum("ij,ij->i", normal, place[:, list(plane)])
    found, _, rank, _ = np.linalg.lstsq(normal, level, rcond=1e-6)
    far = 1e-3 * max(float(np.ptp(place)), 1.0)
    return found if rank == 2 and np.abs(normal @ found - level).max() < far else None


def angle(found: Speeds) -> Angle | None:
    """The angle by which places turn about the point that the lines across their ways meet in."""
    still_axis = 2 - int(np.argmin(np.abs(found.speed).sum(axis=0)[::-1].round(6)))  # X and Y where both might be meant
    plane = [[1, 2], [2, 0], [0, 1]][still_axis]
    place, speed = found.place[:, plane], found.speed[:, plane]
    fast = np.linalg.norm(speed, axis=1)
    rows = np.flatnonzero(found.moving & (fast > SAME))
    if not len(rows):
        return None
    ways = speed[rows] / fast[rows, None]
    centre = _meeting(found.place[rows], ways, plane)
    if centre is None and np.abs(ways @ ways[0]).min() > 0.9999:  # one place: about a point that is right for an angle
        across = np.array([-ways[0, 1], ways[0, 0]]) * fast[rows[0]] / found.counts
        centre = min((place[rows[0]] + across, place[rows[0]] - across), key=lambda each: math.dist(each, place.mean(axis=0)))
    if centre is None:
        return None
    arm = place - centre
    out = np.hypot(*arm.T)
    turn = (arm[:, 0] * speed[:, 1] - arm[:, 1] * speed[:, 0]) / np.maximum(out * out, SAME)
    own = np.flatnonzero(found.own(turn) & found.moving)
    if not len(own) or not found.natural(turn):
        return None
    sweep = float(turn[own[0]]) * found.value
    to = np.arctan2(arm[:, 1], arm[:, 0])
    still = np.append(0.0, to[~found.moving & (out > SAME)])  # the first axis before all others
    off = np.abs((to[own] - sweep - still[:, None] + math.pi) % math.tau - math.pi)
    which, k = np.unravel_index(int(np.argmin(np.maximum(off, 1e-4))), off.shape)
    first = still[which] if off[which, k] < 1e-3 or len(still) == 1 else to[own[k]] - sweep
    middle, reach = found.place[own[k]].copy(), np.zeros(3)
    middle[plane], reach[plane] = centre, float(out[own].max()) * np.array([math.cos(first), math.sin(first)])
    return Angle(middle, reach, sweep, (plane[0], plane[1]))
