"""A part as a probe meets it: a function from points to signed distance, negative inside the material.

Points `(n, 3)` in mm, distances `(n,)` in mm. Parts combine: `a | b` has the material of both, `a & b` what
they share, `a - b` is a less b. Outside the material a distance is never too large, so that a ball is not
led through material; plane, box, ball, cylinder and their unions are exact there. Of `&` and `-` the faces
are exact; off an edge that they make, the distance is too small, as if the edge were mitred, not rounded.
What is taken away must stick out of the faces that it opens, by more than the ball that will be led there:

    part = box((0, 0, 0), (100, 60, 20)) - cylinder((50, 30, -10), (50, 30, 30), 12)
    contact(part, start=(50, 30, 10), direction=(1, 0, 0), radius=2, reach=20)      # 10.0
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial

import numpy as np
from numpy.typing import ArrayLike, NDArray

from mnclab.text.alarm import Alarm
from mnclab.text.given import check_number, check_point

Floats = NDArray[np.float64]

TOUCHING = 1e-10  # mm, a gap that counts as closed
CREEP = 1e-4  # mm, the step where the gap gets smaller than this
AT_ONCE = 200  # places looked at in one go


@dataclass(frozen=True)
class Part:
    """Material, given by its signed distance; `name` says what it is, `at_once` at how many places a ball is tried in
    one go."""

    distance: Callable[[Floats], Floats]
    name: str = "part"
    at_once: int = AT_ONCE

    def __repr__(self) -> str:
        return f"<Part: {self.name}>"

    def __call__(self, points: ArrayLike) -> Floats:
        """Signed distance of each of the points `(n, 3)` from the surface, `(n,)`."""
        return self.distance(np.asarray(points, dtype=float).reshape(-1, 3))

    def __or__(self, other: Part) -> Part:
        return Part(partial(_combined, np.minimum, self, other, 1.0), f"({self.name} | {other.name})")

    def __and__(self, other: Part) -> Part:
        return Part(partial(_combined, np.maximum, self, other, 1.0), f"({self.name} & {other.name})")

    def __sub__(self, other: Part) -> Part:
        return Part(partial(_combined, np.maximum, self, other, -1.0), f"({self.name} - {other.name})")

    def placed(self, frame: ArrayLike) -> Part:
        """The same part put elsewhere by a 4×4 frame that turns and shifts."""
        matrix = np.asarray(frame, dtype=float)
        turn, shift = matrix[:3, :3], matrix[:3, 3]
        if not np.allclose(turn @ turn.T, np.eye(3), rtol=0, atol=1e-9):
            raise Alarm("a part is placed by turning and shifting alone, not by scaling")
        return Part(partial(_placed, self, turn, shift), f"{self.name} placed elsewhere")


# Distances of points p (n, 3); functions of the file, so that a part can go from one process to another.


def _combined(which: np.ufunc, one: Part, other: Part, sign: float, p: Floats) -> Floats:
    return np.asarray(which(one(p), sign * other(p)))


def _placed(part: Part, turn: Floats, shift: Floats, p: Floats) -> Floats:
    return part((p - shift) @ turn)


def _plane(through: Floats, out: Floats, p: Floats) -> Floats:
    return np.asarray((p - through) @ out)


def _box(middle: Floats, half: Floats, p: Floats) -> Floats:
    return _from_faces(np.abs(p - middle) - half)


def _ball(middle: Floats, radius: float, p: Floats) -> Floats:
    return np.asarray(np.linalg.norm(p - middle, axis=1) - radius)


def _cylinder(along: Floats, middle: Floats, half: float, radius: float, p: Floats) -> Floats:
    height = (p - middle) @ along
    aside = np.linalg.norm(p - middle - height[:, None] * along, axis=1) - radius
    return _from_faces(np.stack([aside, np.abs(height) - half], axis=1))


def plane(point: ArrayLike, normal: ArrayLike) -> Part:
    """Half of space, bounded by the plane through `point`; the normal points away from the material."""
    through, out = _place(point, "a point of a plane"), _unit(_place(normal, "the normal of a plane"), "the normal of a plane")
    return Part(partial(_plane, through, out), "plane")


def box(corner: ArrayLike, opposite: ArrayLike) -> Part:
    """A cuboid along the axes, from one corner to the opposite one."""
    a, b = _place(corner, "the corner of a box"), _place(opposite, "the opposite corner of a box")
    return Part(partial(_box, (a + b) / 2, np.abs(b - a) / 2), "box")


def ball(centre: ArrayLike, radius: float) -> Part:
    """A ball about a point; the radius in mm."""
    middle = _place(centre, "the centre of a ball")
    check_number(radius, "the radius of a ball", above=0)
    return Part(partial(_ball, middle, radius), "ball")


def cylinder(bottom: ArrayLike, top: ArrayLike, radius: float) -> Part:
    """A round bar between the centres of its two faces."""
    a, b = _place(bottom, "the bottom of a cylinder"), _place(top, "the top of a cylinder")
    check_number(radius, "the radius of a cylinder", above=0)
    along, middle, half = _unit(b - a, "the axis of a cylinder"), (a + b) / 2, float(np.linalg.norm(b - a)) / 2
    return Part(partial(_cylinder, along, middle, half, radius), "cylinder")


def contact(part: Part, start: ArrayLike, direction: ArrayLike, radius: float, reach: float) -> float | None:
    """How far a ball travels from `start` along `direction` until it touches: distance(centre) = radius.

    0 if it touches already, None if it does not within `reach`. A gap changes by no more than the way, so
    nothing stands between two places no farther apart than their gaps together: the ball goes ahead by its
    gap, and on as long as this holds. Where the gap is small it creeps, and may miss a graze of less than a
    nanometre. Then it settles between the last free place and the first one that is not.
    """
    origin, ahead = np.asarray(start, dtype=float), _unit(direction, "the direction of a probe")

    def gap(travel: ArrayLike) -> Floats:
        return part(origin + np.atleast_1d(travel)[:, None] * ahead) - radius

    free, room = 0.0, float(gap(0.0)[0])
    while room > TOUCHING:
        if free > reach:
            return None
        step = max(room, CREEP)
        places = free + step * np.arange(1, part.at_once + 1)
        gaps = gap(places)
        sure = np.append(room, gaps[:-1]) + gaps >= step - TOUCHING
        known = len(places) if room <= CREEP or sure.all() else max(int(sure.argmin()), 1)
        hit = np.flatnonzero(gaps[:known] <= TOUCHING)
        if len(hit):
            k = hit[0]
            free = _settled(gap, places[k - 1] if k else free, places[k])
            break
        free, room = float(places[known - 1]), float(gaps[known - 1])
    return free if free <= reach + TOUCHING else None


def _settled(gap: Callable[[ArrayLike], Floats], free: float, blocked: float) -> float:
    """The place between two at which the gap closes: by the secant, exact for a plane, and by halving."""
    at_free, at_blocked = float(gap(free)[0]), float(gap(blocked)[0])
    while blocked - free > TOUCHING and abs(at_blocked) > 1e-13:
        for place in (free + (blocked - free) * at_free / (at_free - at_blocked), (free + blocked) / 2):
            if free < place < blocked:
                here = float(gap(place)[0])
                if here > 1e-13:
                    free, at_free = place, here
                else:
                    blocked, at_blocked = place, here
    return blocked


def _from_faces(beyond: Floats) -> Floats:
    """Distance from how far points lie beyond pairs of faces, `(n, k)`; inside, from the nearest face."""
    outside = np.linalg.norm(np.maximum(beyond, 0.0), axis=1)
    return np.asarray(outside + np.minimum(beyond.max(axis=1), 0.0))


def _place(point: ArrayLike, what: str) -> Floats:
    check_point(point, what)
    return np.asarray(point, dtype=float)


def _unit(vector: ArrayLike, name: str) -> Floats:
    v = np.asarray(vector, dtype=float)
    size = float(np.linalg.norm(v))
    if not size > 0:
        raise Alarm(f"{name} must have a length greater than 0")
    return np.asarray(v / size)
