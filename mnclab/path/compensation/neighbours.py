"""Whether the tool keeps clear of the elements close by, however the corners between them were decided.

Rows of the tool centre, also the arcs about corners, are measured against elements: exactly, over their whole length. Two
kinds of pairs are looked at. Behind a *cusp* the contour runs back along itself: there what comes before it is compared
with what comes after it, as far as they lie near each other. And where the whole contour is looked at, the ends of elements
that a few others at most lie between, if the contour turns by half a turn there: what is nearer along the contour than a
tool's turn about a point. Farther apart `fit` has other means.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from mnclab.geometry.chords import near
from mnclab.geometry.curves import Curves, distance, dot, gap, part
from mnclab.geometry.cutting import boxes
from mnclab.path.compensation.elements import CUSP, Compensation, Elements, meet
from mnclab.path.compensation.equidistant import Equidistant, corners, ends, remaining
from mnclab.path.toolpath import Array, Index, Mask, Rule

FAR = 4  # elements on each side that are looked at
WITHIN = 3.0  # tool radii along the contour
BATCH = 1 << 16  # pairs measured at once
HALF_TURN = np.pi - 1e-6


class Pairs(NamedTuple):
    """m pairs: the row of element `k` (m,), or, where `corner` (m,), the arc about its end, beside `wall` (m,);
    of both only what is nearer than `reach` (m,) mm to where they follow each other."""

    k: Index
    corner: Mask
    wall: Index
    reach: Array

    def take(self, which: Index) -> Pairs:
        return Pairs._make(column[which] for column in self)


def looked_at(found: Equidistant, contour: Index) -> Pairs:
    """The pairs worth a look."""
    el, n = found.el, len(found.el.rows)
    bent = np.zeros(n)  # how far the contour turns at the end of each element
    bent[:-1] = np.arccos(np.clip(dot(el.t_out[:-1], el.t_in[1:]), -1.0, 1.0))
    back = bent > CUSP
    back[:-1] &= el.wall[:-1] & el.wall[1:]
    none = np.zeros(0, dtype=np.int64)
    both = [(none, none, np.zeros(0)), *([_across(el, contour, back)] if back.any() else [])]
    if found.rules.look_ahead:
        both += _near_each_other(el, contour, bent)
    i, j, reach = (np.concatenate(column) for column in zip(*both))
    same = meet(el, i, j)
    i, j, reach = i[same], j[same], np.tile(reach[same], 2)
    row, wall = np.concatenate([i, j]), np.concatenate([j, i])
    about = np.append(found.insert[1:], False)[row]
    corner = np.repeat([False, True], [len(row), int(about.sum())])
    row, wall, reach = (np.concatenate([column, column[about]]) for column in (row, wall, reach))
    return Pairs(row, corner, wall, reach)


def _across(el: Elements, contour: Index, back: Mask) -> tuple[Index, Index, Array]:
    """Walls i < j (m,) of one contour near each other, between which it turns `back` (n,)."""
    before: Index = np.cumsum(back, dtype=np.int64) - back  # cusps before each element
    k = np.flatnonzero(el.wall & np.isin(contour, contour[back]))
    pairs = [np.stack([k[one], k[other]]) for one, other in near(*el.boxes(k, contour), 2 * float(el.R[k].max()))]
    i, j = np.concatenate([np.empty((2, 0), np.int64), *pairs], axis=1)
    keep = before[i] != before[j]
    return i[keep], j[keep], np.full(int(keep.sum()), np.inf)


def _near_each_other(el: Elements, contour: Index, bent: Array) -> list[tuple[Index, Index, Array]]:
    """Walls i < j (m,) of one contour with half a turn between their ends and little else, and how far to look."""
    n, found = len(el.rows), []
    own = np.where(el.arc, np.abs(el.sweep), 0.0)
    turned = np.concatenate([[0.0], np.cumsum(own + bent)])  # up to the start of each element
    if turned[-1] < HALF_TURN:
        return []
    for apart in range(1, min(FAR, n - 1) + 1):
        i = np.flatnonzero(turned[apart + 1 :] - turned[: n - apart] - bent[apart:] >= HALF_TURN)
        j = i + apart
        i, j = (k[el.wall[i] & el.wall[j] & (contour[i] == contour[j])] for k in (i, j))
        between = np.zeros(len(i))
        for step in range(1, apart):
            between += el.length(i + step)
        reach = (WITHIN * el.R[i] - between) / 2
        keep = reach > 0 if apart > 1 else el.arc[i] | el.arc[j]  # the corner of two lines is exact
        found.append((i[keep], j[keep], reach[keep]))
    return found


def clearance(el: Elements, look: Pairs, radius: Array, rules: Compensation) -> Array:
    """How far the rows stay from the walls, for a radius each (m,); mm beyond the radius, infinite without a row."""
    if len(look.k) > BATCH:
        pieces = [np.arange(k, min(k + BATCH, len(look.k))) for k in range(0, len(look.k), BATCH)]
        return np.concatenate([clearance(el, look.take(k), radius[k], rules) for k in pieces])
    (row, there), wall = rows(el, look, radius, rules), el.curves(look.wall)
    near_by = np.flatnonzero(np.isfinite(look.reach))
    if len(near_by):  # a row keeps the share of what its element keeps
        after = look.k >= look.wall
        keeps = [np.minimum(1.0, look.reach / el.length(k)) for k in (look.k, look.wall)]
        keeps[0][look.corner] = 1.0
        row = part(row, np.where(after, 0.0, 1 - keeps[0]), np.where(after, keeps[0], 1.0))
        wall = part(wall, np.where(after, 1 - keeps[1], 0.0), np.where(after, 1.0, keeps[1]))
    return np.where(there, gap(row, wall) - radius, np.inf)


def rows(el: Elements, look: Pairs, radius: Array, rules: Compensation) -> tuple[Curves, Mask]:
    """The rows of the tool centre, for a radius each (m,), and which of them are there."""
    n, c = len(look.k), np.flatnonzero(look.corner)
    begin, end = np.empty((n, 2)), np.empty((n, 2))
    centre, sweep, r = el.centre[look.k], np.zeros(n), np.full(n, np.nan)
    e = np.flatnonzero(~look.corner)
    k = look.k[e]
    there = np.ones(n, dtype=bool)
    begin[e], end[e], apart = ends(el, k, radius[e], rules)
    left_over, sweep[e] = remaining(el, k, begin[e], end[e], radius[e])
    there[e] = ~apart & (left_over > 0)
    arc = el.arc[k]
    r[e[arc]] = np.abs(el.r[k[arc]] - el.s[k[arc]] * np.sign(el.sweep[k[arc]]) * radius[e[arc]])
    if len(c):
        at = corners(el, look.k[c], rules, radius[c])
        begin[c], end[c], centre[c], sweep[c], r[c] = at.E, at.S, el.end[look.k[c]], at.turn, radius[c]
        there[c] = at.insert & ~at.apart
    return Curves(begin, end, centre, r, sweep), there


# Tips: where a straight outside corner reaches farther out than the tool's radius, it may meet another wall.
# All other walls must stay clear of the tip, and their vertices of the rows that lead there and on.

LEAST = 1e-6  # mm: tips that reach out less are as good as round


def near_tips(found: Equidistant, contour: Index) -> tuple[Index, Index]:
    """Corners c (m,) and walls w (m,) of the same contour that may meet at the tip of the corner."""
    el = found.el
    c = np.flatnonzero((found.rule[:-1] == Rule.OUTSIDE_STRAIGHT) & el.wall[:-1] & el.wall[1:])
    c = c[np.hypot(*(found.end[c] - el.end[c]).T) > el.R[c] + LEAST]
    w = np.flatnonzero(el.wall)
    if not len(c):
        return c, c
    low, high = boxes(el.curves(w))
    tip, reach = found.end[c], np.hypot(*(found.end[c] - el.end[c]).T)[:, None]
    both = np.concatenate([tip - reach, low]), np.concatenate([tip + reach, high])
    pairs = [np.empty((2, 0), np.int64), *(np.stack(pair) for pair in near(*both, 0.0))]
    a, b = np.concatenate(pairs, axis=1)
    mixed = (a < len(c)) & (b >= len(c))
    corner, wall = c[a[mixed]], w[b[mixed] - len(c)]
    other = (contour[corner] == contour[wall]) & (wall != corner) & (wall != corner + 1)
    return corner[other], wall[other]


def tip_clearance(el: Elements, c: Index, w: Index, radius: Array, rules: Compensation) -> Array:
    """How far walls w (m,) stay from the tool at the tips of corners c (m,), for a radius each; mm beyond the radius.
    Infinite where the corner has no tip for that radius."""
    at = corners(el, c, rules, radius)
    least = distance(at.E, el.curves(w))  # and no vertex of a wall comes near the rows that lead to the tip and on
    for k in (c, c + 1):
        begin, end, _ = ends(el, k, radius, rules)
        r = np.where(el.arc[k], np.abs(el.r[k] - el.s[k] * np.sign(el.sweep[k]) * radius), np.nan)
        _, sweep = remaining(el, k, begin, end, radius)
        row = Curves(begin, end, el.centre[k], r, sweep)
        for vertex in (el.start[w], el.end[w]):
            least = np.minimum(least, distance(vertex, row))
    return np.where(at.rule == Rule.OUTSIDE_STRAIGHT, least - radius, np.inf)
