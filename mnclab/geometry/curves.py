"""Lines and circles of the plane: vectors, where curves meet, and how far points and other curves are from them."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

# Vectors of the plane in arrays (…, 2).

Floats = NDArray[np.float64]


def left(vectors: Floats) -> Floats:
    """Vectors `(…, 2)` turned a quarter to the left."""
    return np.stack([-vectors[..., 1], vectors[..., 0]], axis=-1)


def cross(a: Floats, b: Floats) -> Floats:
    """The third component of a × b, for vectors `(…, 2)`."""
    return a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0]


def dot(a: Floats, b: Floats) -> Floats:
    """The scalar product of vectors `(…, 2)`."""
    return np.asarray(a[..., 0] * b[..., 0] + a[..., 1] * b[..., 1])


def length_of(vectors: Floats) -> Floats:
    """The lengths of vectors `(…, 2)`."""
    return np.hypot(vectors[..., 0], vectors[..., 1])


def unit_of(vectors: Floats) -> Floats:
    """Vectors `(…, 2)` brought to the length 1; those without length stay so."""
    return np.asarray(vectors / np.maximum(length_of(vectors), 1e-300)[..., None])


def turned(vectors: Floats, angle: ArrayLike) -> Floats:
    """Vectors `(…, 2)` turned counter-clockwise by an angle (rad), or each by its own."""
    c, s = np.cos(angle), np.sin(angle)
    x, y = vectors[..., 0], vectors[..., 1]
    across = c * x - s * y
    found = np.empty((*np.shape(across), 2))  # filled in half the time that stacking takes
    found[..., 0], found[..., 1] = across, s * x + c * y
    return found


def at_angle(angle: ArrayLike) -> Floats:
    """Unit vectors `(…, 2)` in the direction of angles (rad)."""
    return np.stack([np.cos(angle), np.sin(angle)], axis=-1)


def counted(counts: NDArray[Any]) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
    """Things that come so many times (n,), one after the other: which of them each is, and its rank among its like (m,)."""
    of = np.repeat(np.arange(len(counts)), counts)
    return of, np.arange(len(of)) - np.repeat(np.cumsum(counts) - counts, counts)


# Where whole lines and circles meet: the corners of equidistants and the centres of roundings.
# An element is given by a point `q` (n, 2) on it, its unit tangent `t` (n, 2) there, and for a circle its centre
# `c` (n, 2) and radius `r` (n,); `r` is nan for a line. Lengths in mm.

class Element(NamedTuple):
    """Lines and circles, n of them."""

    q: Floats
    t: Floats
    c: Floats
    r: Floats

    def only(self, mask: NDArray[np.bool_]) -> Element:
        """Those where `mask` (n,) holds."""
        return Element(self.q[mask], self.t[mask], self.c[mask], self.r[mask])


def beside(p: Floats, t: Floats, shift: Floats) -> Floats:
    """Points p (n, 2), or one (1, 2), moved by `shift` (n,) along the left normals of vectors t (n, 2)."""
    moved = np.empty(t.shape)
    np.subtract(p[:, 0], shift * t[:, 1], out=moved[:, 0])
    np.add(p[:, 1], shift * t[:, 0], out=moved[:, 1])
    return moved


def meet(first: Element, second: Element, near: Floats, touching: bool = False) -> Floats:
    """The common point (n, 2) of two elements that lies nearer to `near` (n, 2); nan where there is none.

    `touching`: of curves that just miss each other the place between them, where they would touch.
    """
    p, q = meetings(first, second, touching)
    closer = length_of(p - near) <= length_of(q - near)
    return np.where(closer[:, None], p, q)


def meetings(first: Element, second: Element, touching: bool = False) -> tuple[Floats, Floats]:
    """Both common points (n, 2) of two elements, twice the same for two lines; nan where there is none."""
    found = np.full((2, *first.q.shape), np.nan)
    circle1, circle2 = ~np.isnan(first.r), ~np.isnan(second.r)
    with np.errstate(divide="ignore", invalid="ignore"):
        for mask, solve in (
            (~circle1 & ~circle2, _lines),
            (~circle1 & circle2, lambda a, b: _line_circle(a, b, touching)),
            (circle1 & ~circle2, lambda a, b: _line_circle(b, a, touching)),
            (circle1 & circle2, lambda a, b: _circles(a, b, touching)),
        ):
            if mask.any():
                found[:, mask] = solve(first.only(mask), second.only(mask))
    return found[0], found[1]


def _lines(a: Element, b: Element) -> tuple[Floats, Floats]:
    point = a.q + (cross(b.q - a.q, b.t) / cross(a.t, b.t))[:, None] * a.t
    return point, point


def _line_circle(line: Element, circle: Element, touching: bool) -> tuple[Floats, Floats]:
    # with h = t x (C - q) and l0 = (C - q) . t the points lie at q + (l0 ± sqrt(r² - h²)) t
    away = circle.c - line.q
    h, l0 = cross(line.t, away), dot(away, line.t)
    reach = _half_chord((circle.r - h) * (circle.r + h), touching)
    foot = line.q + l0[:, None] * line.t
    return foot - reach * line.t, foot + reach * line.t


def _circles(a: Element, b: Element, touching: bool) -> tuple[Floats, Floats]:
    d = b.c - a.c
    distance = length_of(d)
    along = (distance + (a.r - b.r) * (a.r + b.r) / distance) / 2
    unit = d / distance[:, None]
    foot = a.c + along[:, None] * unit
    reach = _half_chord((a.r - along) * (a.r + along), touching)
    return foot - reach * left(unit), foot + reach * left(unit)


def _half_chord(square: Floats, touching: bool) -> Floats:
    return np.asarray(np.sqrt(np.maximum(square, 0.0) if touching else square)[:, None])


# Lines and arcs as plain curves, and how far points and other curves are from them.

SLACK = 1e-9  # of a curve: beyond its ends a point is still on it


class Curves(NamedTuple):
    """n lines and arcs: `start`, `end`, `centre` (n, 2) mm, radius `r` (n,), nan for lines, `sweep` (n,) rad."""

    start: Floats
    end: Floats
    centre: Floats
    r: Floats
    sweep: Floats

    @property
    def arc(self) -> NDArray[np.bool_]:
        return ~np.isnan(self.r)

    def take(self, k: NDArray[np.int64] | NDArray[np.bool_]) -> Curves:
        return Curves(*(column[k] for column in self))


def share(p: Floats, curve: Curves) -> Floats:
    """Where the point of a curve nearest to p (n, 2) lies, 0 at its start and 1 at its end; beyond is not on it.

    For an arc it is where the ray from its centre through p meets its circle. A curve without length has no such point:
    nan or infinite, by which p is on none of it; its ends count alone.
    """
    travel = curve.end - curve.start
    with np.errstate(divide="ignore", invalid="ignore"):
        found = dot(p - curve.start, travel) / dot(travel, travel)
    k = np.flatnonzero(curve.arc)
    if len(k):
        a, b = curve.start[k] - curve.centre[k], p[k] - curve.centre[k]
        sense, sweep = np.sign(curve.sweep[k]), np.abs(curve.sweep[k])
        angle = np.arctan2(cross(a, b), dot(a, b)) * sense
        half = sweep / 2  # seen from the middle of the arc, what lies before the start is negative
        angle = (angle - half + np.pi) % (2 * np.pi) - np.pi + half
        angle = np.where(sweep >= 2 * np.pi, np.minimum(np.maximum(angle, 0), sweep), angle)
        with np.errstate(divide="ignore", invalid="ignore"):
            found[k] = angle / sweep
    return np.asarray(found)


def foot(p: Floats, curve: Curves) -> Floats:
    """The point (n, 2) of the whole line or circle nearest to p (n, 2); for the centre of an arc nan."""
    travel = curve.end - curve.start
    with np.errstate(divide="ignore", invalid="ignore"):
        found = curve.start + (dot(p - curve.start, travel) / dot(travel, travel))[:, None] * travel
        k = np.flatnonzero(curve.arc)
        if len(k):
            spoke = p[k] - curve.centre[k]
            found[k] = curve.centre[k] + spoke * (curve.r[k] / length_of(spoke))[:, None]
    return found


def nearest(p: Floats, curve: Curves) -> Floats:
    """The point (n, 2) of each curve nearest to p (n, 2)."""
    ends = np.where((length_of(p - curve.start) <= length_of(p - curve.end))[:, None], curve.start, curve.end)
    beside, where = foot(p, curve), share(p, curve)
    on = (where >= 0) & (where <= 1) & (length_of(p - beside) <= length_of(p - ends))  # not where beside is nan
    return np.asarray(np.where(on[:, None], beside, ends))


def distance(p: Floats, curve: Curves) -> Floats:
    """Distance (n,) of points p (n, 2) from curves, each from its own."""
    at_ends = np.minimum(length_of(p - curve.start), length_of(p - curve.end))
    where = share(p, curve)
    beside = length_of(p - foot(p, curve))
    on = (where >= 0) & (where <= 1) & np.isfinite(beside)
    return np.asarray(np.where(on, np.minimum(beside, at_ends), at_ends))


def gap(a: Curves, b: Curves) -> Floats:
    """The least distance (n,) between curves a and b, each from its own; 0 where they cross."""
    ends = distance(a.start, b), distance(a.end, b), distance(b.start, a), distance(b.end, a)
    least = np.minimum.reduce(ends)
    for p in crossings(a, b):
        least[np.isfinite(p[:, 0])] = 0.0
    for one, other in ((a, b), (b, a)):
        k = np.flatnonzero(one.arc)
        if len(k):  # square to both: through the centre of the arc
            arc, curve = one.take(k), other.take(k)
            near = foot(arc.centre, curve)
            for q in (near, np.where(curve.arc[:, None], 2 * curve.centre - near, near)):
                p = foot(q, arc)
                there = on(q, curve) & on(p, arc)
                least[k] = np.where(there, np.minimum(least[k], length_of(q - p)), least[k])
    return least


def part(curve: Curves, begin: Floats, end: Floats) -> Curves:
    """What lies between two shares (n,) of curves, 0 at their start and 1 at their end."""
    return Curves(at(curve, begin), at(curve, end), curve.centre, curve.r, curve.sweep * (end - begin))


def at(curve: Curves, where: Floats | float) -> Floats:
    """The points (n, 2) at shares (n,) of curves, 0 at their start and 1 at their end."""
    here = np.broadcast_to(where, len(curve.r))
    on_arc = curve.centre + turned(curve.start - curve.centre, curve.sweep * here)
    return np.where(curve.arc[:, None], on_arc, curve.start + here[:, None] * (curve.end - curve.start))


def crossings(a: Curves, b: Curves) -> tuple[Floats, Floats]:
    """The common points (n, 2) of curves a and b, at most two of each pair; nan where there is none."""
    found = meetings(whole(a), whole(b))
    for p in found:
        p[~(on(p, a) & on(p, b))] = np.nan
    return found


def at_levels(curve: Curves, level: Floats, axis: int = 1) -> tuple[NDArray[np.int64], Floats]:
    """Where curves cross levels (k,) of a coordinate: the number (m,) of the level, and the other coordinate (m,) there.

    Half open: a level at the upper end of a curve counts, one at its lower end does not. So a closed outline meets every level
    an even number of times, also at its corners. `axis` is that of the levels, 0 or 1.
    """
    across, n = 1 - axis, len(curve.r)
    # an arc is parted at its highest and its lowest place, which lie half a turn from each other: three pieces at most
    spoke, sense = curve.start - curve.centre, np.sign(curve.sweep) * (1 if axis else -1)
    first, whole = np.arctan2(spoke[:, axis], spoke[:, across]), np.abs(curve.sweep)
    top = np.where(curve.arc, np.mod((np.pi / 2 - first) * sense, np.pi), 0.0)
    cut = np.stack([np.zeros(n), np.minimum(top, whole), np.minimum(top + np.pi, whole), whole])
    height = curve.centre[:, axis] + curve.r * np.sin(first + sense * cut)
    height = np.where(cut < whole, height, curve.end[:, axis])  # where pieces meet, and at the ends, to the last bit
    height = np.where(cut > 0, height, curve.start[:, axis])
    height[-1] = curve.end[:, axis]  # a line is its last piece alone
    side = np.sign(np.cos(first + sense * (cut[1:] + cut[:-1]) / 2)).ravel()
    low, high = np.minimum(height[1:], height[:-1]).ravel(), np.maximum(height[1:], height[:-1]).ravel()
    # of the levels in rising order each piece meets those from one number to another
    order = np.argsort(level, kind="stable")
    begin, end = (np.searchsorted(level[order], ends, "right") for ends in (low, high))
    piece, rank = counted(end - begin)
    number, of = order[begin[piece] + rank], piece % n
    off = level[number] - curve.centre[of, axis]
    on_arc = curve.centre[of, across] + side[piece] * np.sqrt(np.maximum(curve.r[of] ** 2 - off**2, 0.0))
    travel = (curve.end - curve.start)[of]
    share = (level[number] - curve.start[of, axis]) / np.where(travel[:, axis] != 0, travel[:, axis], 1.0)
    return number, np.where(curve.arc[of], on_arc, curve.start[of, across] + share * travel[:, across])


def crossed(curve: Curves, level: Floats, axis: int = 1) -> list[Floats]:
    """The same level by level, each in rising order."""
    number, place = at_levels(curve, level, axis)
    order = np.lexsort((place, number))
    return np.split(place[order], np.searchsorted(number[order], np.arange(1, len(level))))[: len(level)]


def whole(curve: Curves, aside: Floats | float = 0.0) -> Element:
    """The whole lines and circles of curves, or those at a distance (n,) to their left: of an arc with a radius below 0."""
    travel = curve.end - curve.start
    with np.errstate(divide="ignore", invalid="ignore"):
        t = travel / length_of(travel)[:, None]
    if np.ndim(aside) == 0 and not aside:
        return Element(curve.start, t, curve.centre, curve.r)
    return Element(beside(curve.start, t, np.asarray(aside)), t, curve.centre, curve.r - np.sign(curve.sweep) * aside)


class Roundings(NamedTuple):
    """n arcs that touch two curves each: their centres, where they begin and end (n, 2), and their sweeps (n,)."""

    centre: Floats
    first: Floats
    last: Floats
    sweep: Floats


def rounded(before: Curves, after: Curves, radius: Floats, near: Floats) -> Roundings:
    """The arcs between curves that meet in corners, of radii (n,) + to the left; of two the one about a place nearer to `near`.

    The curves count as a whole: whether an arc fits between their ends, and touches both, is not asked.
    """
    centre = meet(whole(before, radius), whole(after, radius), near, touching=True)
    first, last = foot(centre, before), foot(centre, after)
    return Roundings(centre, first, last, np.arctan2(cross(first - centre, last - centre), dot(first - centre, last - centre)))


def on(p: Floats, curve: Curves, slack: float = SLACK) -> NDArray[np.bool_]:
    """Whether points p (n, 2) of the whole lines and circles lie on the curves themselves."""
    where = share(p, curve)
    return np.asarray((where >= -slack) & (where <= 1 + slack) & np.isfinite(p[:, 0]))
