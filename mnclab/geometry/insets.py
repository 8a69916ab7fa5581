"""Insets of closed loops, exactly: every element is moved inwards, what of it comes too near to another one falls away.

    elements moved by d, and a fan of radius d at each corner that points inwards, but those that wholly fall away
    cut where they cross ──► pieces; a piece stays if it is not nearer than d to any element

Lines, circles and centres are handed on from inset to inset: the inset by d of an inset by d is the one by 2 d.
Lengths in mm, angles in rad.
"""

from __future__ import annotations

import numpy as np

from mnclab.geometry import shapely
from mnclab.geometry.contours import turning
from mnclab.geometry.curves import Curves
from mnclab.geometry.cutting import (
    CLOSE,
    EXACT,
    SAME,
    TINY,
    Index,
    Mask,
    Outlines,
    at,
    boxes,
    followers,
    loops_of,
    pieces_of,
)  # fmt: skip
from mnclab.geometry.vectors import Floats, cross, dot, left, length_of, unit_of

ASIDE = 0.4142  # of a piece, where it is looked at: its middle may touch by symmetry what the rest is too near to
SMOOTH = 1e-8  # rad, below which a corner is none
MOST_PAIRS = 20_000_000  # spots times elements that are looked at together: some gigabytes where all are near each other


def inset(outlines: Outlines, d: float) -> Outlines | None:
    """The loops at a distance d > 0 to the left of closed loops; None where too much lies on or beside each other."""
    moved, joints = _moved(outlines, d)
    moved, joints = _only(~_swallowed(outlines.curves, moved, d), moved, joints)
    which, begin, end, start, stop = pieces_of(moved, joints)
    kept = _keeps(outlines.curves, at(moved, which, begin + ASIDE * (end - begin)), d)
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
    nearest = tree.nearest(shapely.points(at(moved, np.arange(len(moved.r)), np.full(len(moved.r), 0.5))))
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
    low, high = boxes(source)
    tree = shapely.STRtree(shapely.box(*low.T, *high.T))
    spot, element = tree.query(shapely.box(*(spots - d).T, *(spots + d).T))
    p, start, chord = spots[spot], source.start[element], (source.end - source.start)[element]
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
    middles = shapely.points(at(pieces, np.arange(len(found)), np.full(len(found), 0.5)))
    i, k = shapely.STRtree(middles).query(middles, predicate="dwithin", distance=SAME)
    back = (length_of(pieces.start[i] - pieces.end[k]) < CLOSE) & (length_of(pieces.end[i] - pieces.start[k]) < CLOSE)
    found[i[back & (i != k)]] = True
    return found
