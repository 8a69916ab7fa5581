"""Whether the tool keeps clear of the elements close by, however the corners between them were decided.

Rows of the tool centre, also the arcs about corners, are measured against elements: exactly, over their whole length. Two
kinds of pairs are looked at. Behind a *cusp* the contour runs back along itself: there what comes before it is compared
with what comes after it, as far as they lie near each other. And where the whole contour is looked at, those of which a
few elements, shorter in all than a tool's turn about a point, lie in between, if the contour turns by half a turn there;
farther apart ``fit`` has other means.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from mnclab.geometry.boxes import near
from mnclab.geometry.curves import Curves, gap
from mnclab.geometry.offsets import dot
from mnclab.path.compensation.corners import corners, ends, remaining
from mnclab.path.compensation.elements import Array, Elements, Index, Mask
from mnclab.path.compensation.heights import meet
from mnclab.path.compensation.rules import CUSP, Compensation

if TYPE_CHECKING:
    from mnclab.path.compensation.equidistant import Equidistant

FAR = 4  # elements on each side that are looked at
WITHIN = 3.0  # tool radii: the length of what lies in between
HALF_TURN = np.pi - 1e-6


class Pairs(NamedTuple):
    """m pairs: the row of element ``k`` (m,), or, where ``corner`` (m,), the arc about its end, beside ``wall`` (m,)."""

    k: Index
    corner: Mask
    wall: Index


def looked_at(found: Equidistant, contour: Index) -> Pairs:
    """The pairs worth a look."""
    el, n = found.el, len(found.el.rows)
    bent = np.zeros(n)  # how far the contour turns at the end of each element
    bent[:-1] = np.arccos(np.clip(dot(el.t_out[:-1], el.t_in[1:]), -1.0, 1.0))
    back = bent > CUSP
    back[:-1] &= el.wall[:-1] & el.wall[1:]
    both = [_across(el, contour, back)] if back.any() else []
    if found.rules.look_ahead:
        both += _near_each_other(el, contour, bent)
    none = np.zeros(0, dtype=np.int64)
    i, j = (np.concatenate([none, *(pair[which] for pair in both)]) for which in (0, 1))
    same = meet(el, i, j)
    i, j = i[same], j[same]
    row, wall = np.concatenate([i, j]), np.concatenate([j, i])
    about = np.append(found.insert[1:], False)[row] & el.wall[row]
    row, wall = np.concatenate([row, row[about]]), np.concatenate([wall, wall[about]])
    return Pairs(row, np.arange(len(row)) >= 2 * len(i), wall)


def _across(el: Elements, contour: Index, back: Mask) -> tuple[Index, Index]:
    """Walls i < j (m,) of one contour near each other, between which it turns ``back`` (n,)."""
    before: Index = np.cumsum(back, dtype=np.int64) - back  # cusps before each element
    k = np.flatnonzero(el.wall & np.isin(contour, contour[back]))
    bulge = np.zeros(len(k))
    a = np.flatnonzero(el.arc[k])
    bulge[a] = el.r[k[a]] * (1 - np.cos(np.minimum(np.abs(el.sweep[k[a]]) / 2, np.pi)))
    low, high = np.minimum(el.start[k], el.end[k]), np.maximum(el.start[k], el.end[k])
    i, j = [k[:0]], [k[:0]]
    for one, other in near(low - bulge[:, None], high + bulge[:, None], 2 * float(el.R[k].max())):
        one, other = k[one], k[other]
        keep = (contour[one] == contour[other]) & (before[one] != before[other])
        i, j = [*i, one[keep]], [*j, other[keep]]
    return np.concatenate(i), np.concatenate(j)


def _near_each_other(el: Elements, contour: Index, bent: Array) -> list[tuple[Index, Index]]:
    """Walls i < j (m,) of one contour with half a turn between their ends and little else."""
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
        keep = between < WITHIN * el.R[i] if apart > 1 else el.arc[i] | el.arc[j]  # the corner of two lines is exact
        found.append((i[keep], j[keep]))
    return found


def clearance(el: Elements, look: Pairs, radius: Array, rules: Compensation) -> Array:
    """How far the rows stay from the walls, for a radius each (m,); mm beyond the radius, infinite without a row."""
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
    row = Curves(begin, end, centre, r, sweep)
    return np.where(there, gap(row, el.curves(look.wall)) - radius, np.inf)
