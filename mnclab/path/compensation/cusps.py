"""Cusps: joints with an arc where the contour turns back, so that its direction alone does not say on which side the tool is.

Between two bumps, or a bump and a wall, the tangents are opposite and yet the tool can only go to where the offsets meet;
round a spike it rolls about the corner. Both ways are laid out along the two elements, and the one that keeps clear of
both elements is taken. Where neither does, or both, what counts is on which side of the first element the second one
runs, as far away from the joint as the tool is wide. Beside the line that leads to a contour or away from it nothing is
cut: there only the arc of the contour counts, and a tool that would roll through it goes straight.
"""

from __future__ import annotations

import numpy as np

from mnclab.geometry.curves import Curves, foot, gap, part, share
from mnclab.geometry.offsets import beside, meetings
from mnclab.geometry.vectors import cross, dot
from mnclab.path.columns import Array, Index, Mask
from mnclab.path.compensation.elements import Elements
from mnclab.path.compensation.rules import CLEAR, TANGENT


def inside_cusps(el: Elements, c: Index, R: Array, s: Array) -> Mask:
    """Whether the cusps c (m,) between elements c and c + 1 are inside corners, for a radius and a side each."""
    inside = _on_the_side_of_the_tool(el, c, R, s)
    for this, other, is_inside in ((_goes_in, _rolls, True), (_rolls, _goes_in, False)):
        k = np.flatnonzero(inside == is_inside)
        k = k[~this(el, c[k], R[k], s[k])]
        inside[k[other(el, c[k], R[k], s[k])]] ^= True
    return inside


def _rolls(el: Elements, c: Index, R: Array, s: Array) -> Mask:
    """Whether a tool that rolls about corners c (m,) keeps clear of both elements."""
    d = c + 1
    first, second, before, after = el.moved(c, R, s), el.moved(d, R, s), el.curves(c), el.curves(d)
    about = _about(el, c, R, s)
    clear = (gap(first, after) > R - CLEAR) & (gap(second, before) > R - CLEAR)
    return np.asarray(clear & (gap(about, before) > R - CLEAR) & (gap(about, after) > R - CLEAR))


def rolls_through(el: Elements, c: Index, R: Array, s: Array, entry: Mask) -> Mask:
    """Whether a tool that rolls about corners c (m,) between a lead and an arc of the contour cuts into that arc.
    `entry` (m,): the lead comes before the corner, else after it."""
    return np.asarray(gap(_about(el, c, R, s), el.curves(np.where(entry, c + 1, c))) <= R - CLEAR)


def _about(el: Elements, c: Index, R: Array, s: Array) -> Curves:
    """The arcs about corners c (m,) by which a tool rolls over them."""
    t1, t2, P = el.t_out[c], el.t_in[c + 1], el.end[c]
    turn = np.arctan2(cross(t1, t2), dot(t1, t2))
    half = np.abs(cross(t1, t2)) < np.sin(TANGENT)  # straight back: half a turn about the corner
    turn = np.where(half, -s * np.pi, np.where(s * turn > 0, turn - s * 2 * np.pi, turn))
    return Curves(beside(P, t1, R * s), beside(P, t2, R * s), P, R, turn)


def _goes_in(el: Elements, c: Index, R: Array, s: Array) -> Mask:
    """Whether a tool that goes to where the offsets at corners c (m,) meet keeps clear of both elements."""
    d, P = c + 1, el.end[c]
    first, second, before, after = el.moved(c, R, s), el.moved(d, R, s), el.curves(c), el.curves(d)
    corner = in_a_cusp(el, c, R, s)
    met = np.isfinite(corner[:, 0])
    corner = np.where(met[:, None], corner, P)
    first = first._replace(end=corner, sweep=el.sweep[c] * share(corner, before))
    second = second._replace(start=corner, sweep=el.sweep[d] * (1 - share(corner, after)))
    return np.asarray(met & (gap(first, after) > R - CLEAR) & (gap(second, before) > R - CLEAR))


def in_a_cusp(el: Elements, c: Index, R: Array, s: Array) -> Array:
    """Where the offsets before and after cusps c meet beside both elements (m, 2); nan where they do not."""
    d, P = c + 1, el.end[c]
    found, least = np.full(P.shape, np.nan), np.full(len(c), np.inf)
    for p in meetings(el.offset(c, True, R, s), el.offset(d, False, R, s)):
        with np.errstate(invalid="ignore"):
            before, after = share(p, el.curves(c)), share(p, el.curves(d))
            away = np.hypot(*(p - P).T)
            better = (before >= 0) & (before <= 1) & (after >= 0) & (after <= 1) & (away < least)
        found[better], least[better] = p[better], away[better]
    return found


def _on_the_side_of_the_tool(el: Elements, c: Index, R: Array, s: Array) -> Mask:
    """Whether the element after runs on the side of the tool of the one before, as far away as the tool is wide."""
    before, after = el.curves(c), el.curves(c + 1)
    share_of_it = np.minimum(R, np.minimum(el.length(c), el.length(c + 1))) / el.length(c + 1)
    p = part(after, np.zeros(len(c)), share_of_it).end
    at = foot(p, before)
    radial = (before.centre - at) / before.r[:, None]  # to the left of an arc that turns left
    to_the_left = np.where(el.arc[c, None], np.sign(before.sweep)[:, None] * radial, 0.0)
    straight = np.stack([-el.t_out[c, 1], el.t_out[c, 0]], axis=1)
    return np.asarray(s * dot(p - at, np.where(el.arc[c, None], to_the_left, straight)) > 0)
