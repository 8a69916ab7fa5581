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
from mnclab.geometry.boxes import near
from mnclab.geometry.contours import Contour
from mnclab.geometry.curves import Curves, share
from mnclab.geometry.offsets import Element, meetings
from mnclab.geometry.vectors import Floats, cross, dot, length_of, turned, unit_of

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
    radii = np.concatenate([each.radii for each in loops])
    curves = Curves(
        np.concatenate([each.starts for each in loops]), np.concatenate([each.ends for each in loops]),
        np.concatenate([each.centres for each in loops]), np.where(np.isinf(radii), np.nan, radii),
        np.concatenate([each.sweeps for each in loops]),
    )  # fmt: skip
    return Outlines(curves, np.repeat(np.arange(len(loops)), [len(each.points) for each in loops]))


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
    travel = moved.end - moved.start
    lines = Element(moved.start, unit_of(travel), moved.centre, moved.r)
    slack = SAME / np.maximum(lengths(moved), TINY)
    for i, k in near(*boxes(moved), SAME):
        key = i * count + k
        at = np.minimum(np.searchsorted(touching, key), max(len(touching) - 1, 0))
        apart = touching[at] != key if len(touching) else np.ones(len(key), dtype=bool)
        i, k = i[apart], k[apart]
        a, b = moved.take(i), moved.take(k)
        one, two = meetings(lines.only(i), lines.only(k))
        straight = ~(a.arc | b.arc)
        two[straight] = np.nan
        same = _coincide(lines, i, k)
        one[same] = two[same] = np.nan
        met = [(i, k, a, b, p) for p in (one, two)]
        met += [(i[same], k[same], a.take(same), b.take(same), p[same]) for p in (a.start, a.end, b.start, b.end)]
        for here, there, first, second, p in met:
            with np.errstate(invalid="ignore"):
                s, t = share(p, first), share(p, second)
                on = (np.abs(s - 0.5) <= 0.5 + slack[here]) & (np.abs(t - 0.5) <= 0.5 + slack[there])
            which += [here[on], there[on]]
            places += [s[on], t[on]]
            points += [p[on], p[on]]
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


def at(curves: Curves, which: Index, place: Floats) -> Floats:
    """Points `(p, 2)` at shares of curves."""
    start, centre, sweep = curves.start[which], curves.centre[which], curves.sweep[which]
    round_ = centre + turned(start - centre, sweep * place)
    straight = start + place[:, None] * (curves.end[which] - start)
    return np.where(curves.arc[which, None], round_, straight)


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
    ahead = at(pieces, np.arange(count), probe) - pieces.start
    behind = pieces.end - at(pieces, np.arange(count), 1 - probe)
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
    lines = Element(loop.start, unit_of(loop.end - loop.start), loop.centre, loop.r)
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
    whole = np.abs(sweep) > MOST
    start = loop.start[first]
    merged = Curves(start, np.roll(start, -1, axis=0), loop.centre[first], loop.r[first], sweep)
    if whole.any():
        merged = _halved(merged, whole)
    chord = merged.end - merged.start
    some = merged.arc | (length_of(chord) > TINY)
    area = cross(merged.start - merged.start[0], merged.end - merged.start[0]).sum() / 2
    with np.errstate(invalid="ignore"):
        area += np.nansum(merged.r**2 * (merged.sweep - np.sin(merged.sweep))) / 2
    return merged.take(some) if abs(area) >= 10 * SAME * lengths(merged).sum() and some.sum() > 1 else None


def _halved(loop: Curves, whole: Mask) -> Curves:
    """Arcs of nearly a full turn cut in halves."""
    middle = at(loop, np.arange(len(loop.r)), np.full(len(loop.r), 0.5))
    twice = np.repeat(np.arange(len(loop.r)), np.where(whole, 2, 1))
    second = np.flatnonzero(np.diff(twice, prepend=-1) == 0)
    found = loop.take(twice)
    found.start[second] = middle[twice[second]]
    found.end[second - 1] = middle[twice[second]]
    return found._replace(sweep=found.sweep / np.where(whole[twice], 2, 1))
