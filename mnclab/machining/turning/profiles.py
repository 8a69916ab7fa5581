"""Profiles of turned parts: r(z) as a contour of lines and arcs, where it meets a level, what a tool can reach of it, its zones.

A profile is an open `Contour` with points (z, r), mm, r the radius; it runs from the face towards the chuck, so that z
never grows along it. Shoulders (z constant) are allowed, undercuts behind them are not. ::

      r |                 .--------
        |    ____________/             the profile is read from right to left,
        |   /                          as the tool is fed
        +---------------------- z
       chuck                face

Boring and facing are the same with r or z turned over, or with both exchanged.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence
from typing import NamedTuple

import numpy as np

from mnclab.geometry import curves
from mnclab.geometry.contours import Contour, joined
from mnclab.geometry.curves import Floats
from mnclab.geometry.curves import left as left_of
from mnclab.path.inserts import angles_of
from mnclab.path.tool import Tool

SAME = 1e-9  # mm


class ProfileStretch(NamedTuple):
    """A part of a line or of an arc on which r is a function of z, from `right` down to `left`.

    A line has its r at both ends; an arc its `centre` (z, r) and its `radius`, negative for the lower half circle.
    """

    right: float
    left: float
    ends: tuple[float, float]
    centre: tuple[float, float] = (0.0, 0.0)
    radius: float = 0.0

    def at(self, z: float) -> float:
        """The r over a z."""
        if z in (self.right, self.left):
            return self.ends[0] if z == self.right else self.ends[1]
        if self.radius:
            away = math.sqrt(max(self.radius**2 - (z - self.centre[0]) ** 2, 0.0))
            return self.centre[1] + math.copysign(away, self.radius)
        share = (self.right - z) / (self.right - self.left)
        return self.ends[0] + share * (self.ends[1] - self.ends[0])


def checked(profile: Contour) -> Contour:
    """The profile with its arcs parted at their tops and bottoms; a ValueError where it is none."""
    if profile.closed:
        raise ValueError("a profile is an open contour, from the face to the chuck")
    points: list[Floats] = [profile.points[0]]
    bulges: list[float] = []
    columns = profile.starts, profile.ends, profile.sweeps, profile.centres, profile.radii
    for start, end, sweep, centre, radius in zip(*columns, strict=True):
        tops = (centre + (0, side * radius) for side in (1, -1) if sweep)
        inner = sorted(((_share(start, centre, sweep, top), top) for top in tops), key=lambda each: each[0])
        done = 0.0
        for share, place in (*(each for each in inner if 1e-9 < each[0] < 1 - 1e-9), (1.0, end)):
            if np.hypot(*(place - points[-1])) > SAME:
                bulges.append(math.tan(sweep * (share - done) / 4))
                points.append(place)
                done = share
    if not bulges:
        raise ValueError("a profile needs a length")
    found = Contour(np.array(points), [*bulges, 0.0], closed=False)
    heads, tails = found.tangents()
    if max(heads[:, 0].max(), tails[:, 0].max()) > 1e-7:
        raise ValueError("a profile runs from the face to the chuck: its z must never grow")
    if found.points[:, 1].min() < -SAME:
        raise ValueError("a profile lies on one side of the axis: its radius must not be negative")
    return found


def _share(start: Floats, centre: Floats, sweep: float, place: Floats) -> float:
    """How far along an arc a place on its circle lies, 0 to 1 on the arc."""
    first, then = (math.atan2(*(p - centre)[::-1]) for p in (start, place))
    return ((then - first) * math.copysign(1, sweep)) % (2 * math.pi) / abs(sweep)


# ---- places on a profile ----


def way_at(profile: Contour, element: int, level: float) -> float:
    """The way along a checked profile to where an element meets a level that lies between its ends."""
    start, end = profile.starts[element], profile.ends[element]
    share = (level - start[1]) / (end[1] - start[1])
    sweep = profile.sweeps[element]
    if sweep:
        centre, radius = profile.centres[element], profile.radii[element]
        side = math.copysign(1.0, (start + end)[0] / 2 - centre[0])
        z = centre[0] + side * math.sqrt(max(radius**2 - (level - centre[1]) ** 2, 0.0))
        share = _share(start, centre, sweep, np.array([z, level]))
        share = 0.0 if share > 1.5 else share  # rounding just before the start
    return float(profile.lengths[:element].sum() + min(max(share, 0.0), 1.0) * profile.lengths[element])


def between(profile: Contour, first: float, last: float) -> Contour | None:
    """The part of an open contour from one way along it to another; None if it has no length."""
    piece = profile.between(first, last)
    return piece if piece.length > SAME else None


def exit_way(profile: Contour, level: float) -> float:
    """The way to the last point at or below a level."""
    r = profile.points[:, 1]
    below = np.flatnonzero(r <= level + SAME)
    if not len(below):
        raise ValueError(f"the profile never comes down to {level:g}")
    last = int(below[-1])
    if last == len(r) - 1 or r[last] >= level - SAME:
        return float(profile.lengths[:last].sum())
    return way_at(profile, last, level)


def entry_way(profile: Contour, level: float) -> float | None:
    """The way to the first point at or below a level, None where the profile begins below it."""
    if profile.points[0, 1] <= level + SAME:
        return None
    return profile.length - exit_way(profile.reversed(), level)


# ---- the uppermost of many ----


def stretches(profile: Contour) -> list[ProfileStretch]:
    """The elements of a checked profile that are not shoulders."""
    found = []
    columns = profile.starts, profile.ends, profile.centres, profile.bulge, profile.radii
    for (right, r), (left, end), centre, bulge, radius in zip(*(column.tolist() for column in columns), strict=False):
        if right - left > SAME:
            arc = ((centre[0], centre[1]), math.copysign(radius, bulge)) if bulge else ()
            found.append(ProfileStretch(right, left, (r, end), *arc))
    return found


def uppermost(pieces: Sequence[ProfileStretch], first: Sequence[float], last: Sequence[float]) -> Contour:
    """The upper envelope of stretches from a point (z, r) to another one, with shoulders where it jumps."""
    table = np.array([(piece.right, piece.left, *piece.ends, *piece.centre, piece.radius) for piece in pieces]).T
    places = np.unique([first[0], last[0], *table[:2].flat, *_crossings(table)])[::-1]
    places = places[(last[0] <= places) & (places <= first[0])]
    places = places[np.append(True, -np.diff(places) > 1e-10)]
    points, bulges, owner = [np.array(first, dtype=float)], [], -1
    for right, left, heights in zip(places, places[1:], _heights(table, (places[:-1] + places[1:]) / 2), strict=False):
        top = owner if owner >= 0 and heights[owner] >= heights.max() - SAME else int(heights.argmax())
        if np.isinf(heights[top]):
            raise ValueError(f"nothing bounds the part at z {(right + left) / 2:g}")
        piece = pieces[top]
        begin, end = np.array([right, piece.at(right)]), np.array([left, piece.at(left)])
        if abs(begin[1] - points[-1][1]) > SAME:
            points.append(begin)
            bulges.append(0.0)
        elif top == owner:
            points.pop()
            bulges.pop()
        bulges.append(_arc(piece, points[-1], end))
        points.append(end)
        owner = top
    if abs(points[-1][1] - last[1]) > SAME:
        points.append(np.array(last, dtype=float))
        bulges.append(0.0)
    return Contour(np.array(points), [*bulges, 0.0], closed=False)


def _arc(piece: ProfileStretch, start: Floats, end: Floats) -> float:
    if not piece.radius:
        return 0.0
    half = math.asin(min(1.0, float(np.hypot(*(end - start))) / 2 / abs(piece.radius)))
    return math.copysign(math.tan(half / 2), piece.radius)


def _crossings(table: Floats) -> Floats:
    """The z at which stretches cross, and none else that counts: those nearest to each other where they do not."""
    right, left, r, end, _, _, radius = table
    start, centre, ahead = table[[0, 2]].T, table[4:6].T, np.stack([left - right, end - r], axis=1)
    ahead /= curves.length_of(ahead)[:, None]
    one, other = np.nonzero(np.triu(np.minimum.outer(right, right) > np.maximum.outer(left, left), 1))
    line, ring = np.where(radius[one] != 0, (other, one), (one, other))
    with np.errstate(divide="ignore", invalid="ignore"):
        between = centre[ring] - centre[line]
        apart = curves.length_of(between)[:, None]
        share = (1 + (radius[line] ** 2 - radius[ring] ** 2)[:, None] / apart**2) / 2
        is_line = radius[line, None] == 0  # two circles cross on their radical line
        point = np.where(is_line, start[line], centre[line] + share * between)
        way = np.where(is_line, ahead[line], curves.left(between / apart))
        foot = ((centre[ring] - point) * way).sum(axis=1)
        off = curves.length_of(point + foot[:, None] * way - centre[ring])
        half = np.sqrt(np.maximum(radius[ring] ** 2 - off**2, 0.0))
        along = curves.cross(start[ring] - point, ahead[ring]) / curves.cross(way, ahead[ring])  # of two lines
        z = point[:, 0] + np.where(radius[ring] == 0, along, (foot - half, foot + half)) * way[:, 0]
    return z[(z < np.minimum(right[line], right[ring])) & (z > np.maximum(left[line], left[ring]))]


def _heights(table: Floats, z: Floats) -> Floats:
    """The r of k stretches over m places, `(m, k)`; -inf where one does not reach."""
    right, left, r, end, middle, level, radius = table
    z = z[:, None]
    line = r + (right - z) / (right - left) * (end - r)
    arc = level + np.copysign(np.sqrt(np.maximum(radius**2 - (z - middle) ** 2, 0.0)), radius)
    return np.where((left <= z) & (z <= right), np.where(radius, arc, line), -np.inf)


# ---- what a tool can reach ----


def reachable(profile: Contour, tool: Tool) -> Contour:
    """The lowest way of a tool's tip over a profile: nowhere steeper than the cutting edges, no wall within its width.

    A wall that grows with the feed is cut up to the main angle, one that falls up to the auxiliary angle. Behind a
    corner that is steeper the edge leaves a straight line.
    """
    contour = checked(profile)
    if tool.width:
        contour = _for_width(contour, tool.width)
    main, auxiliary = angles_of(tool)
    first, last = contour.points[0], contour.points[-1]
    pieces = stretches(contour)
    found = list(pieces)
    for angle, side in ((auxiliary, -1.0), (main, 1.0)):
        if angle >= math.pi / 2 - 1e-12:
            continue
        edge = float(last[0] if side < 0 else first[0])
        for z, r in (*contour.points, *_leaning(pieces, side * angle)):
            if abs(z - edge) > SAME:
                fallen = float(r - abs(z - edge) * math.tan(angle))
                rows = (float(z), edge, (float(r), fallen)) if side < 0 else (edge, float(z), (fallen, float(r)))
                found.append(ProfileStretch(*rows))
    if len(found) == len(pieces):
        return contour
    ends = [(z, max(r, *(p.at(z) for p in found if p.left <= z <= p.right))) for z, r in (first, last)]
    return checked(uppermost(found, *ends))


def _leaning(pieces: Iterable[ProfileStretch], angle: float) -> list[tuple[float, float]]:
    """Where convex arcs lean by an angle, + in the direction of feed: there the edge of a tool touches them."""
    sine, cosine = math.sin(angle), math.cos(angle)
    spots = ((p, p.centre[0] + p.radius * sine, p.centre[1] + p.radius * cosine) for p in pieces if p.radius > 0)
    return [(z, r) for piece, z, r in spots if piece.left < z < piece.right]


def _for_width(contour: Contour, width: float) -> Contour:
    """The greatest radius within the width to the right of every z: the way of the left corner of a blade."""
    pieces = stretches(contour)
    moved = stretches(Contour(contour.points - (width, 0), contour.bulge, closed=False))
    level = [ProfileStretch(float(z), float(z) - width, (float(r), float(r))) for z, r in contour.points]
    first, last = contour.points[0], contour.points[-1]
    return checked(uppermost([*pieces, *moved, *level], first, (last[0], highest(contour, last[0], last[0] + width))))


def lowest(profile: Contour, z: float) -> float:
    """The least radius of a checked profile over a z: the foot of the wall where one stands there."""
    return float(profile.point_at(ways_over(profile, z))[0][:, 1].min())


def highest(profile: Contour, left: float, right: float) -> float:
    """The greatest radius of a checked profile strictly between two z; walls that stand on them do not count."""
    piece = over(profile, left, right)
    return lowest(profile, left) if piece is None else float(piece.bounds[1, 1])


def over(profile: Contour, left: float, right: float) -> Contour | None:
    """The part of a checked profile strictly between two z, None if there is none."""
    return between(profile, *sorted((ways_over(profile, right)[1], ways_over(profile, left)[0])))


def ways_over(profile: Contour, z: float) -> tuple[float, float]:
    """The ways along a checked profile to the first and to the last point over a z; its begin for a z in front of it."""
    falling = Contour(profile.points[:, ::-1], -profile.bulge, closed=False)  # (r, z): its levels are z
    rising = Contour(falling.points * (1, -1), profile.bulge, closed=False)
    last = exit_way(rising, -z) if z <= profile.points[0, 0] + SAME else 0.0
    return entry_way(falling, z) or 0.0, last


# The offset of a turned profile away from the part, with sharp outside corners. Coordinates (z, r), mm.
# The upper envelope of everything that bounds the offset: the elements moved along their normals, and at every outside
# corner both neighbours prolonged until they meet (an arc about the corner where they do not). Whatever a neighbour of a
# small element covers is covered in the envelope too, so that loops need no search. ::
#         ______ .         the two elements and their offsets,
#         ____  \          prolonged to the corner
#             \  \

def offset(profile: Contour, distance: float, front: float) -> Contour:
    """The profile moved outwards by a distance, from z `front` to above its end; level before the face and behind the end."""
    contour = checked(profile)
    first, last = contour.points[0], contour.points[-1]
    head, tail = np.array([front + distance, first[1]]), last - (2 * distance + 1, 0.0)
    ways = np.vstack([head, contour.points, tail])
    whole = Contour(ways, [0.0, *contour.bulge[:-1], 0.0, 0.0], closed=False)
    if distance <= SAME:
        body = stretches(Contour(ways[:-1], [0.0, *contour.bulge], closed=False))
        return uppermost(body, (front, float(first[1])), last)
    pieces = [piece for part in _moved(whole, distance) for piece in stretches(part)]
    end = float(last[0])
    right, stop = (front, _over(pieces, front)), (end, _over(pieces, end))
    return uppermost(pieces, right, stop)


def _over(pieces: list[ProfileStretch], z: float) -> float:
    return max(piece.at(z) for piece in pieces if piece.left - SAME <= z <= piece.right + SAME)


def _moved(whole: Contour, distance: float) -> Iterator[Contour]:
    """The offset of every element, and what joins them at outside corners; to the right of the way is outside."""
    begins, ends = whole.tangents()
    starts, stops = whole.starts - distance * left_of(begins), whole.ends - distance * left_of(ends)
    for i, bulge in enumerate(whole.bulge[:-1]):
        if not bulge or whole.radii[i] + math.copysign(distance, bulge) > SAME:  # an arc may shrink to nothing
            yield Contour([starts[i], stops[i]], [bulge, 0.0], closed=False)
    for i, turn in enumerate(whole.turns()):
        if i and turn > 1e-9:
            yield _corner(whole, i, stops[i - 1], starts[i], (ends[i - 1], begins[i], distance))


def _corner(whole: Contour, i: int, start: Floats, end: Floats, offset: tuple[Floats, Floats, float]) -> Contour:
    """What joins two offsets at an outside corner: both prolonged if they are lines, else an arc about it."""
    before, after, distance = offset
    if not whole.bulge[i - 1] and not whole.bulge[i] and (along := 1 + float(before @ after)) > 1e-12:
        return Contour([start, whole.points[i] - distance * left_of(before + after) / along, end], closed=False)
    return Contour([start, end], [math.tan(whole.turns()[i] / 4), 0.0], closed=False)


# Zones of turning: what a profile asks of the tool, and how a combined one is parted (NC-31, 3.20.1 and 3.20.2).
#
#     open       r never grows with the feed: no wall ends a pass               any tool
#     semi-open  r only grows: a shoulder ends every pass                       the main angle must reach the shoulder
#     closed     r falls and grows again, walls on both sides                   both angles are restricted
#     combined   two or three of these
#
# The figures of the source are missing; the test by growth is the reading adopted, as it gives the stated restrictions. Water
# poured over the profile stands in the closed zones; what stays dry grows up to the greatest radius (semi-open) and does
# not grow behind it (open). Profiles are (z, r), mm, from the face to the chuck.

OPEN, SEMI_OPEN, CLOSED, COMBINED = "open", "semi-open", "closed", "combined"
KINDS = (OPEN, SEMI_OPEN, CLOSED, COMBINED)


class Zone(NamedTuple):
    """One section: its kind and its profile; in dry sections lines stand for the closed zones within them.

    `main` and `auxiliary` are the angles in degrees that the tool needs at least: the steepest growth and fall.
    """

    kind: str
    profile: Contour

    @property
    def main(self) -> float:
        return _steepest(self.profile, 1.0)

    @property
    def auxiliary(self) -> float:
        return _steepest(self.profile, -1.0)


def zone_of(profile: Contour, blank: float = math.inf) -> str:
    """The kind of a whole profile under a blank of a radius: one of `KINDS`.

    >>> mnc.schemes.zone_of(mnc.area.Contour([(0, 10), (-30, 10), (-30, 20)], closed=False), 20)
    'semi-open'
    """
    found = zones(profile, blank)
    return COMBINED if len(found) > 1 else found[0].kind


def zones(profile: Contour, blank: float = math.inf) -> tuple[Zone, ...]:
    """The sections of a profile: dry ones from the face to the chuck, then the closed ones, outer before inner.

    Sections that the `blank` radius leaves nothing to cut of are left out. A closed zone with a rib inside is parted at
    the height of the rib. Raises ValueError where the blank lies nowhere above the profile.

    >>> shoulder = mnc.area.Contour([(0, 10), (-30, 10), (-30, 20)], closed=False)
    >>> len(mnc.schemes.zones(shoulder, 20))
    1
    """
    contour = checked(profile)
    rim, pools = _poured(contour)
    r = rim.points[:, 1]
    top = int(np.flatnonzero(r >= r.max() - SAME)[0])
    upto = float(rim.lengths[:top].sum())
    found = [Zone(SEMI_OPEN, joined([between(rim, 0.0, upto)]))] if top else []
    rest = between(rim, upto, rim.length)
    if rest is not None:
        right, left = rest.points[0, 0], rest.points[-1, 0]
        bridged = sum(float(np.ptp(pool.points[:, 0])) for pool in pools if left <= pool.points[0, 0] <= right + SAME)
        if right - left - bridged > SAME:
            found.append(Zone(OPEN, rest))
    found += [Zone(CLOSED, simple) for pool in pools for simple in _simple(pool)]
    kept = tuple(zone for zone in found if zone.profile.points[:, 1].min() < blank - SAME)
    if not kept:
        raise ValueError(f"a blank of radius {blank:g} leaves nothing to cut above the profile")
    return kept


def filled(profile: Contour) -> Contour:
    """The profile with its closed zones filled up to their rims."""
    return _poured(checked(profile))[0]


def _poured(contour: Contour) -> tuple[Contour, list[Contour]]:
    """A checked profile with straight lines over its pools, and the pools."""
    r = contour.points[:, 1]
    water = np.minimum(np.maximum.accumulate(r), np.maximum.accumulate(r[::-1])[::-1])
    wet = np.flatnonzero(r < water - SAME)
    upto = contour.upto
    dry: list[Contour | None] = []
    pools: list[Contour] = []
    at = 0.0
    for run in np.split(wet, np.flatnonzero(np.diff(wet) > 1) + 1) if len(wet) else []:
        first, last, level = int(run[0]) - 1, int(run[-1]) + 1, float(water[run[0]])
        around = between(contour, float(upto[first]), float(upto[last]))
        assert around is not None
        head, tail = entry_way(around, level) or 0.0, exit_way(around, level)
        pool = between(around, head, tail)
        assert pool is not None
        dry.append(between(contour, at, float(upto[first]) + head))
        dry.append(Contour(pool.points[[0, -1]], closed=False))
        pools.append(pool)
        at = float(upto[first]) + tail
    dry.append(between(contour, at, contour.length))
    return joined(dry), pools


def _simple(pool: Contour) -> list[Contour]:
    """A pool as pools that fall once and grow once: what stands above the highest rib, and what lies on its sides."""
    r = pool.points[:, 1]
    ribs = [r[i] for i in range(1, len(r) - 1) if _is_rib(r, i)]
    if not ribs:
        return [pool]
    rib = float(max(ribs))
    head, tail = entry_way(pool, rib), exit_way(pool, rib)
    assert head is not None
    inner = between(pool, head, tail)
    assert inner is not None
    above = joined([between(pool, 0.0, head), between(pool, tail, pool.length)])
    return [above, *(simple for each in _poured(inner)[1] for simple in _simple(each))]


def _is_rib(r: np.ndarray, i: int) -> bool:
    """Whether the profile has grown before a point and falls behind it."""
    before, behind = (part[np.abs(part - r[i]) > SAME] for part in (r[:i], r[i + 1 :]))
    return bool(len(before) and len(behind) and before[-1] < r[i] and behind[0] < r[i])


def _steepest(profile: Contour, side: float) -> float:
    """The steepest angle, degrees, in which a profile grows (side 1) or falls (side -1)."""
    slopes = np.vstack(profile.tangents())
    return float(np.degrees(np.arctan2(side * slopes[:, 1], -slopes[:, 0])).max(initial=0.0)) + 0.0
