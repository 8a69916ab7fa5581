"""Closed loops of lines and arcs cut where they cross, and pieces of them joined to loops again, exactly.

Set operations and insets are the same work: elements are cut at all crossings, each piece stays or falls away as a whole,
and each that stays leads on to the one that begins where it ends. Nothing is rounded to polylines. Lengths in mm, angles
in rad.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from mnclab.geometry import shapely
from mnclab.geometry.chords import near
from mnclab.geometry.contours import Contour, turning
from mnclab.geometry.curves import (
    Curves,
    Element,
    Floats,
    at,
    cross,
    dot,
    left,
    length_of,
    meetings,
    share,
    unit_of,
    whole,
)

Index = NDArray[np.intp]
Mask = NDArray[np.bool_]
PARALLEL = 1e-8  # rad
SAME = 1e-7  # mm, below which curves lie on each other
TINY = 1e-8  # mm, a piece shorter than this is none
CLOSE = 1e-6  # mm, between the end of a piece and the start of the next
EXACT = 1e-9  # mm, by which places may be rounded
PROBE = 1e-3  # mm, along a piece: where it is seen which way it leads
MOST = 6.0  # rad, an arc that sweeps more is cut in two


class Outlines(NamedTuple):
    """Closed loops as one list of elements: `curves`, n in all, and for each the loop `(n,)` that it belongs to, in order."""

    curves: Curves
    loop: Index

    @property
    def before(self) -> Index:
        """The element before each, `(n,)`."""
        index = np.arange(len(self.loop)) - 1
        first = np.flatnonzero(np.diff(self.loop, prepend=-1))
        index[first] = np.append(first[1:], len(self.loop)) - 1
        return index

    @property
    def contours(self) -> list[Contour]:
        """The loops one by one."""
        first = np.flatnonzero(np.diff(self.loop, prepend=-1))[1:]
        points, bulge = np.split(self.curves.start, first), np.split(np.tan(self.curves.sweep / 4), first)
        return [Contour(*loop) for loop in zip(points, bulge, strict=True)] if len(self.loop) else []


def outlines_of(loops: Sequence[Contour]) -> Outlines:
    """Closed contours as one list of elements."""
    none, sizes = np.zeros((0, 2)), np.array([len(each.points) for each in loops], dtype=np.intp)
    start, end = np.vstack([none, *(each.points for each in loops)]), np.vstack([none, *(each.ends for each in loops)])
    bulge = np.concatenate([none[:, 0], *(each.bulge for each in loops)])
    b = np.where(bulge == 0, np.nan, bulge)  # as `Contour` has radii and centres, of a line nan
    centre = (start + end) / 2 + left(end - start) * ((1 - b * b) / (4 * b))[:, None]
    r = length_of(end - start) * (1 + b * b) / (4 * np.abs(b))
    curves = Curves(start, end, centre, r, 4 * np.arctan(bulge))
    return Outlines(curves, np.repeat(np.arange(len(loops)), sizes))


def lengths(curves: Curves) -> Floats:
    """Lengths of curves, `(n,)`."""
    return np.asarray(np.where(curves.arc, np.abs(curves.sweep) * curves.r, length_of(curves.end - curves.start)))


def boxes(curves: Curves) -> tuple[Floats, Floats]:
    """Lower left and upper right corners `(n, 2)` of boxes about curves, about arcs a little wide."""
    low, high = np.minimum(curves.start, curves.end), np.maximum(curves.start, curves.end)
    wide = np.abs(curves.sweep) > np.pi
    with np.errstate(invalid="ignore"):
        rise = np.where(curves.arc, curves.r * (1 - np.cos(np.minimum(np.abs(curves.sweep), np.pi) / 2)), 0.0)[:, None]
        around = (curves.centre - curves.r[:, None], curves.centre + curves.r[:, None])
    return np.where(wide[:, None], around[0], low - rise), np.where(wide[:, None], around[1], high + rise)


def pieces_of(moved: Curves, joints: Index) -> tuple[Index, Floats, Floats, Floats, Floats]:
    """Curves cut where they cross: which curve, its shares at both ends, and these ends `(p, 2)`."""
    count = len(moved.r)
    touching = np.sort(joints.min(axis=1) * count + joints.max(axis=1))
    which, places, points = [np.arange(count)] * 2, [np.zeros(count), np.ones(count)], [moved.start, moved.end]
    lines = whole(moved)
    slack = SAME / np.maximum(lengths(moved), TINY)
    # of pairs whose boxes meet, but for those that touch smoothly: where the whole lines and circles cross
    for i, k in near(*boxes(moved), SAME):
        key = i * count + k
        at = np.minimum(np.searchsorted(touching, key), max(len(touching) - 1, 0))
        apart = touching[at] != key if len(touching) else np.ones(len(key), dtype=bool)
        i, k = i[apart], k[apart]
        a, b = moved.take(i), moved.take(k)
        one, two = meetings(lines.only(i), lines.only(k))
        straight = ~(a.arc | b.arc)
        two[straight] = np.nan
        # what lies on one line or circle crosses nowhere: it is cut at the ends of either
        same = _coincide(lines, i, k)
        one[same] = two[same] = np.nan
        met = [(i, k, a, b, p) for p in (one, two)]
        met += [(i[same], k[same], a.take(same), b.take(same), p[same]) for p in (a.start, a.end, b.start, b.end)]
        # a place counts where it lies on both pieces, or a hair beyond their ends
        for here, there, first, second, p in met:
            with np.errstate(invalid="ignore"):
                s, t = share(p, first), share(p, second)
                on = (np.abs(s - 0.5) <= 0.5 + slack[here]) & (np.abs(t - 0.5) <= 0.5 + slack[there])
            which += [here[on], there[on]]
            places += [s[on], t[on]]
            points += [p[on], p[on]]
    # curve by curve in the order of their places: what lies between two neighbours is a piece, unless it is too short
    curve, place, point = np.concatenate(which), np.clip(np.concatenate(places), 0.0, 1.0), np.concatenate(points)
    order = np.lexsort((place, curve))
    curve, place, point = curve[order], place[order], point[order]
    long = (curve[1:] == curve[:-1]) & (np.diff(place) * lengths(moved)[curve[1:]] > TINY)
    k = np.flatnonzero(long)
    return curve[k], place[k], place[k + 1], point[k], point[k + 1]


def _coincide(lines: Element, i: Index, k: Index) -> Mask:
    """Which pairs are the same whole line or circle."""
    round_ = ~np.isnan(lines.r)
    with np.errstate(invalid="ignore"):
        line = ~(round_[i] | round_[k]) & (np.abs(cross(lines.t[i], lines.t[k])) < PARALLEL)
        line &= np.abs(cross(lines.q[k] - lines.q[i], lines.t[i])) < SAME
        circle = (length_of(lines.c[k] - lines.c[i]) < SAME) & (np.abs(lines.r[k] - lines.r[i]) < SAME)
    return np.asarray(line | circle)


def followers(pieces: Curves) -> Index | None:
    """The piece that follows each, -1 for those that lead nowhere; None if those are more than rounding errors.

    Where several begin the leftmost is taken: what touches in a point falls apart there.
    """
    count = len(pieces.r)
    after = np.full(count, -1)
    if not count:
        return after
    i, k = shapely.STRtree(shapely.points(pieces.start)).query(
        shapely.points(pieces.end), predicate="dwithin", distance=CLOSE
    )
    other = i != k  # what is shorter than `CLOSE` begins where it ends
    i, k = i[other], k[other]
    gap = length_of(pieces.end[i] - pieces.start[k])
    probe = np.minimum(0.5, PROBE / np.maximum(lengths(pieces), TINY))
    ahead = at(pieces, probe) - pieces.start
    behind = pieces.end - at(pieces, 1 - probe)
    turn = np.arctan2(cross(behind[i], ahead[k]), dot(behind[i], ahead[k]))
    order = np.lexsort((-turn, gap > EXACT))
    follow, before = [-1] * count, [-1] * count
    for one, two in zip(i[order].tolist(), k[order].tolist(), strict=True):
        if follow[one] < 0 and before[two] < 0:
            follow[one], before[two] = two, one
    _part_at_pinches(follow, before, list(zip(i[gap < SAME].tolist(), k[gap < SAME].tolist(), strict=True)))
    after[:] = follow
    while True:  # what begins or ends nowhere falls away, piece by piece
        led = np.zeros(count, dtype=bool)
        led[after[after >= 0]] = True
        loose = (after >= 0) & ~led
        loose |= (after >= 0) & (after[after] < 0)
        if not loose.any():
            break
        after[loose] = -1
    return after if lengths(pieces)[after < 0].sum() <= CLOSE else None


def _part_at_pinches(follow: list[int], before: list[int], pairs: Sequence[tuple[int, int]]) -> None:
    """A loop that comes twice through one point becomes two, as where an island touches the wall.

    `pairs` are all pieces of which the second begins where the first ends.
    """
    possible = set(pairs)
    for one, two in pairs:
        other, rival = before[two], follow[one]
        if rival in (-1, two) or other < 0 or (other, rival) not in possible:
            continue
        here = rival
        while here not in (one, other, -1):
            here = follow[here]
        if here == other:
            follow[one], before[two], follow[other], before[rival] = two, one, rival, other


def loops_of(pieces: Curves, after: Index) -> Outlines:
    """Pieces in order, those on one curve joined; loops that enclose nothing fall away."""
    follow, seen = after.tolist(), (after < 0).tolist()
    kept: list[Curves] = []
    for first in range(len(follow)):
        if seen[first]:
            continue
        chain, here = [], first
        while not seen[here]:
            seen[here] = True
            chain.append(here)
            here = follow[here]
        loop = _joined(pieces.take(np.array(chain)))
        if loop is not None:
            kept.append(loop)
    if not kept:
        return Outlines(pieces.take(np.zeros(0, dtype=int)), np.zeros(0, dtype=int))
    curves = Curves(*(np.concatenate(column) for column in zip(*kept, strict=True)))
    return Outlines(curves, np.repeat(np.arange(len(kept)), [len(each.r) for each in kept]))


def _joined(loop: Curves) -> Curves | None:
    """The pieces of a loop with those on one curve joined; None if it encloses nothing."""
    lines = whole(loop)
    index = np.arange(len(loop.r))
    same = _coincide(lines, index - 1, index) & (np.sign(loop.sweep) == np.sign(np.roll(loop.sweep, 1)))
    same &= loop.arc | (dot(lines.t, np.roll(lines.t, 1, axis=0)) > 0)
    if same.all():
        if not loop.arc[0] or abs(loop.sweep.sum()) < MOST:
            return None
        arm, sense = loop.start[0] - loop.centre[0], np.sign(loop.sweep[0])
        start = np.stack([loop.start[0], loop.centre[0] - arm])
        return Curves(start, start[::-1], loop.centre[[0, 0]], loop.r[[0, 0]], np.full(2, sense * np.pi))
    shift = int(np.flatnonzero(~same)[0])
    loop, same = loop.take(np.roll(index, -shift)), np.roll(same, -shift)
    first = np.flatnonzero(~same)
    sweep = np.add.reduceat(loop.sweep, first)
    round_ = np.abs(sweep) > MOST
    start = loop.start[first]
    merged = Curves(start, np.roll(start, -1, axis=0), loop.centre[first], loop.r[first], sweep)
    if round_.any():
        merged = _halved(merged, round_)
    chord = merged.end - merged.start
    some = merged.arc | (length_of(chord) > TINY)
    area = cross(merged.start - merged.start[0], merged.end - merged.start[0]).sum() / 2
    with np.errstate(invalid="ignore"):
        area += np.nansum(merged.r**2 * (merged.sweep - np.sin(merged.sweep))) / 2
    return merged.take(some) if abs(area) >= 10 * SAME * lengths(merged).sum() and some.sum() > 1 else None


def _halved(loop: Curves, round_: Mask) -> Curves:
    """Arcs of nearly a full turn cut in halves."""
    middle = at(loop, 0.5)
    twice = np.repeat(np.arange(len(loop.r)), np.where(round_, 2, 1))
    second = np.flatnonzero(np.diff(twice, prepend=-1) == 0)
    found = loop.take(twice)
    found.start[second] = middle[twice[second]]
    found.end[second - 1] = middle[twice[second]]
    return found._replace(sweep=found.sweep / np.where(round_[twice], 2, 1))


# Insets of closed loops, exactly: every element is moved inwards, what of it comes too near to another one falls away.
#     elements moved by d, and a fan of radius d at each corner that points inwards, but those that wholly fall away
#     cut where they cross ──► pieces; a piece stays if it is not nearer than d to any element
# Lines, circles and centres are handed on from inset to inset: the inset by d of an inset by d is the one by 2 d.
# Lengths in mm, angles in rad.

ASIDE = 0.4142  # of a piece, where it is looked at: its middle may touch by symmetry what the rest is too near to
SMOOTH = 1e-8  # rad, below which a corner is none
MOST_PAIRS = 20_000_000  # spots times elements that are looked at together: some gigabytes where all are near each other


def inset(outlines: Outlines, d: float) -> Outlines | None:
    """The loops at a distance d > 0 to the left of closed loops; None where too much lies on or beside each other."""
    moved, joints = _moved(outlines, d)
    moved, joints = _only(~_swallowed(outlines.curves, moved, d), moved, joints)
    which, begin, end, start, stop = pieces_of(moved, joints)
    kept = _keeps(outlines.curves, at(moved.take(which), begin + ASIDE * (end - begin)), d)
    pieces = Curves(
        start[kept], stop[kept], moved.centre[which[kept]], moved.r[which[kept]],
        moved.sweep[which[kept]] * (end - begin)[kept],
    )  # fmt: skip
    pieces = pieces.take(~_doubled(pieces))
    order = followers(pieces)
    return None if order is None else loops_of(pieces, order)


def _tangents(curves: Curves) -> tuple[Floats, Floats]:
    """Unit tangents at the starts and the ends of curves, each `(n, 2)`."""
    chord = unit_of(curves.end - curves.start)
    with np.errstate(invalid="ignore"):
        sense = (np.sign(curves.sweep) / curves.r)[:, None]
        first, last = (left(p - curves.centre) * sense for p in (curves.start, curves.end))
    arc = curves.arc[:, None]
    return np.where(arc, first, chord), np.where(arc, last, chord)


def _moved(outlines: Outlines, d: float) -> tuple[Curves, Index]:
    """The elements moved to the left by d and the fans; and pairs `(k, 2)` of those that touch smoothly, which do not cross."""
    curves, before = outlines.curves, outlines.before
    first, last = _tangents(curves)
    bend = np.where(curves.arc, np.sign(curves.sweep) / np.where(curves.arc, curves.r, 1.0), 0.0)
    turns = turning(last[before], first, bend[before] + bend)
    start, end = curves.start + d * left(first), curves.end + d * left(last)
    smooth = np.abs(turns) <= SMOOTH
    start[smooth] = end[before[smooth]]  # no gap as wide as a rounding error
    r = curves.r - np.sign(curves.sweep) * d
    fan = np.flatnonzero(turns < -SMOOTH)
    moved = Curves(
        np.concatenate([start, end[before[fan]]]), np.concatenate([end, start[fan]]),
        np.concatenate([curves.centre, curves.start[fan]]), np.concatenate([r, np.full(len(fan), d)]),
        np.concatenate([curves.sweep, turns[fan]]),
    )  # fmt: skip
    there = ~(moved.r <= TINY) & (length_of(moved.end - moved.start) > TINY)
    fans, k = len(curves.r) + np.arange(len(fan)), np.flatnonzero(smooth)
    joints = np.concatenate([np.stack([before[k], k]), np.stack([before[fan], fans]), np.stack([fan, fans])], axis=1).T
    return _only(there, moved, joints)


def _only(some: Mask, moved: Curves, joints: Index) -> tuple[Curves, Index]:
    """Some of the moved elements, and the joints between them."""
    number = np.cumsum(some) - 1
    return moved.take(some), number[joints[some[joints].all(axis=1)]]


def _swallowed(source: Curves, moved: Curves, d: float) -> Mask:
    """Which moved elements are sure to lie nearer than d to the element nearest to their middle.

    What is nearer than d to a straight line or to a point is convex, so the corners of what an element lies in answer for it:
    its ends, and for an arc where their tangents meet. Where all elements have passed each other, as at the centre of a circle
    of many short lines, they would all cross each other.
    """
    if not len(moved.r):
        return np.zeros(0, dtype=bool)
    tip = np.where(source.arc[:, None], source.start, source.end)  # of an arc its start stands for it
    tree = shapely.STRtree(shapely.linestrings(np.stack([source.start, tip], axis=1)))
    nearest = tree.nearest(shapely.points(at(moved, 0.5)))
    start, chord = source.start[nearest], (tip - source.start)[nearest]
    size = dot(chord, chord)
    flat = np.abs(moved.sweep) < np.pi / 2
    first = moved.start - moved.centre
    meeting = moved.start + np.tan(moved.sweep / 2)[:, None] * left(first)
    found = flat | ~moved.arc
    for p in (moved.start, moved.end, np.where(moved.arc[:, None], meeting, moved.start)):
        reach = np.clip(dot(p - start, chord) / np.where(size > 0, size, 1.0), 0.0, 1.0)
        found &= length_of(p - start - reach[:, None] * chord) < d - EXACT
    return found


def _keeps(source: Curves, spots: Floats, d: float) -> Mask:
    """Which spots are at least d from all elements; many at a time, but not more than memory has room for."""
    if len(spots) > 1 and len(spots) * len(source.r) > MOST_PAIRS:
        half = len(spots) // 2
        return np.concatenate([_keeps(source, spots[:half], d), _keeps(source, spots[half:], d)])
    # pairs of a spot and an element whose box is no farther than d
    low, high = boxes(source)
    tree = shapely.STRtree(shapely.box(*low.T, *high.T))
    spot, element = tree.query(shapely.box(*(spots - d).T, *(spots + d).T))
    p, start, chord = spots[spot], source.start[element], (source.end - source.start)[element]
    # their distance: for lines by the foot on the chord, for arcs from the circle within their sector, else from the ends
    size = dot(chord, chord)
    reach = np.clip(dot(p - start, chord) / np.where(size > 0, size, 1.0), 0.0, 1.0)
    off = length_of(p - start - reach[:, None] * chord)
    k = np.flatnonzero(source.arc[element])
    centre, r, sweep = source.centre[element[k]], source.r[element[k]], source.sweep[element[k]]
    arm, first, last = p[k] - centre, start[k] - centre, source.end[element[k]] - centre
    sense = np.sign(sweep)
    after, ahead = cross(first, arm) * sense >= 0, cross(arm, last) * sense >= 0
    within = np.where(np.abs(sweep) > np.pi, after | ahead, after & ahead)
    ends = np.minimum(length_of(arm - first), length_of(arm - last))
    off[k] = np.where(within, np.abs(length_of(arm) - r), ends) + 4e-16 * r
    kept = np.ones(len(spots), dtype=bool)
    kept[spot[off < d - EXACT]] = False
    return kept


def _doubled(pieces: Curves) -> Mask:
    """Which pieces lie on another one that leads the other way: nothing is between them."""
    found = np.zeros(len(pieces.r), dtype=bool)
    if not len(found):
        return found
    middles = shapely.points(at(pieces, 0.5))
    i, k = shapely.STRtree(middles).query(middles, predicate="dwithin", distance=SAME)
    back = (length_of(pieces.start[i] - pieces.end[k]) < CLOSE) & (length_of(pieces.end[i] - pieces.start[k]) < CLOSE)
    found[i[back & (i != k)]] = True
    return found
