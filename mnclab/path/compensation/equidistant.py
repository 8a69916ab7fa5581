"""The equidistant: where the offset of each element begins and ends, for all elements at once."""

from __future__ import annotations

from copy import copy
from dataclasses import replace
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from mnclab.geometry.curves import Curves, beside, cross, dot, foot, gap, left, length_of, meet, meetings, part, share
from mnclab.path.compensation.elements import ACUTE_TURN, CLEAR, CUSP, ROUND, STRAIGHT, TANGENT, Compensation, Elements
from mnclab.path.toolpath import Array, Index, Mask, Rule

# Cusps: joints with an arc where the contour turns back, so that its direction alone does not say on which side the tool is.
# Between two bumps, or a bump and a wall, the tangents are opposite and yet the tool can only go to where the offsets meet;
# round a spike it rolls about the corner. Both ways are laid out along the two elements, and the one that keeps clear of
# both elements is taken. Where neither does, or both, what counts is on which side of the first element the second one
# runs, as far away from the joint as the tool is wide. Beside the line that leads to a contour or away from it nothing is
# cut: there only the arc of the contour counts, and a tool that would roll through it goes straight.

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


# Corners of the equidistant: where an offset ends and the next one begins, all of them at once.

class Corners(NamedTuple):
    """m corners: the offset before ends at `E` (m, 2), the one after begins at `S` (m, 2); where `insert` (m,) an
    arc about the corner with sweep `turn` (m,) rad leads over. `rule` (m,) is what the element before is called;
    `apart` (m,): an inside corner whose offsets do not meet."""

    E: Array
    S: Array
    insert: Mask
    turn: Array
    rule: NDArray[np.uint8]
    apart: Mask


def corners(el: Elements, c: Index, rules: Compensation, radius: Array | None = None) -> Corners:
    """The corners c (m,) between elements c and c + 1, for the radii of the elements or others (m,)."""
    d = c + 1
    run = len(c) > 1 and bool((np.diff(c) == 1).all())  # corners that follow each other are not gathered but cut out
    b, a = (slice(c[0], c[-1] + 1), slice(d[0], d[-1] + 1)) if run else (c, d)  # before, after
    on = el.on[b]
    s = np.where(on, el.s[b], el.s[a])
    R = np.where(on, el.R[b], el.R[a]) if radius is None else radius
    P, t1, t2 = el.end[b], el.t_out[b], el.t_in[a]
    shift = R * s
    E, S = beside(P, t1, shift), beside(P, t2, shift)  # A1 and A2
    # which corners bend, and to which side: in a cusp what the elements do beside it decides
    across, along = cross(t1, t2), dot(t1, t2)
    small = np.abs(across) < np.sin(TANGENT)
    reversal = small & (along < 0)  # straight back: an outside corner of half a turn
    bent = on & ~(small & (along > 0))
    out = reversal | (s * across < 0)
    cusp = bent & (along < np.cos(CUSP)) & (el.arc[b] | el.arc[a]) & el.wall[b] & el.wall[a]
    if cusp.any():
        k = np.flatnonzero(cusp)
        out[k] = ~inside_cusps(el, c[k], R[k], s[k])
    # outside corners that are built: at an entry, an exit and a change of side as the rules have it
    lead, leave, change = el.entry[b] | el.change[b], el.exit[a], el.change[a]
    rule = np.where(on, Rule.SIDE, Rule.NONE).astype(np.uint8)
    outside = bent & out & ~change
    if rules.approach == "perpendicular":
        outside &= ~lead & ~leave
    elif rules.straight_exit:
        outside &= ~leave
    k = np.flatnonzero(outside & (lead ^ leave) & (along < np.cos(CUSP)) & np.where(lead, el.arc[a], el.arc[b]))
    if len(k):
        outside[k] = ~rolls_through(el, c[k], R[k], s[k], lead[k])
    k = np.flatnonzero(~on | change | lead | leave)
    if len(k):  # a change of side begins at A1; inside, an entry leads straight to A2 and an exit starts at A1
        square = ~outside[k] & on[k] & ~change[k]
        stays, to_first = k[~on[k]], k[on[k] & change[k] | square & leave[k]]
        onto_next = square & lead[k] & ~(rules.straight_exit & leave[k])
        E[k[onto_next]] = S[k[onto_next]]
        E[stays] = S[stays] = P[stays]
        S[to_first] = beside(P[to_first], t1[to_first], shift[to_first])

    # straight ones, and inside corners: where the offsets meet
    corner = el.corner[a]
    straight = outside & ~reversal & (s * across < 0) & (corner != ROUND)
    straight &= (corner == STRAIGHT) | (along >= np.cos(ACUTE_TURN))
    met_by_entry = rules.straight_exit & el.entry[b] & ~el.arc[b]  # the line of the entry ends on the next offset
    inside = bent & ~out & ~change & (~lead | met_by_entry) & ~leave
    apart = np.zeros(len(c), dtype=bool)
    k = np.flatnonzero(el.entry[b] & el.arc[b] & bent & ~out & ~leave)
    if len(k):  # the arc of an entry is shortened
        found = meet(el.entry_arc(c[k], R[k], s[k]), el.offset(d[k], False, R[k], s[k]), P[k])
        met = np.isfinite(found[:, 0])
        E[k[met]] = S[k[met]] = found[met]
        apart[k[~met]] = True
    for which, code in ((straight, Rule.OUTSIDE_STRAIGHT), (inside, Rule.INSIDE)):
        k = np.flatnonzero(which)
        if len(k):
            found = _meet(el, c[k], d[k], P[k], R[k], s[k], t1[k] + t2[k], along[k])
            sharp = np.flatnonzero(cusp[k] & ~straight[k])
            if len(sharp):
                found[sharp] = in_a_cusp(el, c[k][sharp], R[k][sharp], s[k][sharp])
            met = np.isfinite(found[:, 0])
            E[k[met]] = S[k[met]] = found[met]
            rule[k[met]] = code
            apart[k[~met]] = code == Rule.INSIDE
            straight[k[~met]] = False
    rule[el.entry[b]], rule[el.change[b]] = Rule.ENTRY, Rule.CHANGE
    # arcs about all others, and about inside corners whose offsets do not meet
    turn = np.zeros(len(c))
    k = np.flatnonzero(outside | apart)
    turn[k] = np.where(reversal[k], -s[k] * np.pi, np.arctan2(across[k], along[k]))
    k = np.flatnonzero(outside & (s * turn > 0))  # a cusp whose walls part only beside it
    turn[k] -= s[k] * 2 * np.pi
    return Corners(E, S, (outside & ~straight) | apart, turn, rule, apart)


def _meet(el: Elements, c: Index, d: Index, P: Array, R: Array, s: Array, both: Array, along: Array) -> Array:
    """Where the offsets before and after corners P meet: between lines P + R (n1 + n2) / (1 + n1 . n2). `both` (m, 2)
    is the sum of the tangents t1 and t2, `along` (m,) their product."""
    with np.errstate(divide="ignore", invalid="ignore"):
        found = beside(P, both, R * s / (1 + along))
    k = np.flatnonzero(el.arc[c] | el.arc[d])
    if len(k):
        first, second = el.offset(c[k], True, R[k], s[k]), el.offset(d[k], False, R[k], s[k])
        found[k] = meet(first, second, P[k])
    return found


def ends(el: Elements, k: Index, radius: Array, rules: Compensation) -> tuple[Array, Array, Mask]:
    """Where the offsets of elements k (m,) begin and end (m, 2) for a radius each, and which corners stay apart (m,)."""
    n, shift = len(el.rows), radius * el.s[k]
    begin, end = beside(el.start[k], el.t_in[k], shift), beside(el.end[k], el.t_out[k], shift)
    apart = np.zeros(len(k), dtype=bool)
    for corner, at_end in ((k - 1, False), (k, True)):
        there = np.flatnonzero((corner >= 0) & (corner < n - 1))
        found = corners(el, corner[there], rules, radius[there])
        if at_end:
            end[there] = found.E
        else:
            begin[there] = found.S
        apart[there] |= found.apart
    return begin, end, apart


def remaining(el: Elements, k: Index | slice, begin: Array, end: Array, radius: Array) -> tuple[Array, Array]:
    """What is left of elements k (m,) between their trimmed ends: mm or rad in the sense of travel (m,), and sweeps.

    Negative, or nan where an end is unknown: the tool would run backwards. The ends of an arc whose offset has turned
    inside out lie opposite.
    """
    left_over = dot(end - begin, el.t_out[k])
    sweep = el.sweep[k].copy()
    a = np.flatnonzero(el.arc[k])
    if len(a):
        j = np.arange(len(el.rows))[k][a]
        sense, centre = np.sign(el.sweep[j]), el.centre[j]
        small = el.r[j] - el.s[j] * sense * radius[a]
        flip = np.where(small < 0, -1.0, 1.0)[:, None]
        trimmed = _angle(el.start[j] - centre, flip * (begin[a] - centre))
        trimmed -= _angle(el.end[j] - centre, flip * (end[a] - centre))
        sweep[a] = el.sweep[j] - trimmed
        left_over[a] = np.where(small > 1e-9, sweep[a] * sense, -np.inf)
    return left_over, sweep


def _angle(a: Array, b: Array) -> Array:
    return np.arctan2(cross(a, b), dot(a, b))


# Where the offsets of a contour begin and end, for all of its elements at once.

PIECE = 1 << 14  # corners worked on at once


class Equidistant:
    """Elements with the ends of their offsets: `begin`, `end` (n, 2), `sweep` (n,), `rule` (n,); where
    `insert` (n,) an arc about the corner leads to the element, with sweep `turn` (n,)."""

    def __init__(self, el: Elements, rules: Compensation) -> None:
        self.el, self.rules = el, rules
        n = len(el.rows)
        self.begin, self.end = np.empty((n, 2)), np.empty((n, 2))
        self.begin[0], self.end[-1] = el.start[0], el.end[-1]
        self.rule = np.where(el.on, np.uint8(Rule.SIDE), np.uint8(Rule.NONE))
        self.insert, self.apart = np.zeros(n, dtype=bool), np.zeros(n, dtype=bool)  # apart: closed by force
        self.turn, self.left_over, self.sweep = np.zeros(n), np.empty(n), np.empty(n)
        for first in range(0, n - 1, PIECE):  # a piece at a time stays in the cache
            last = min(first + PIECE, n - 1)
            found = corners(el, np.arange(first, last), rules)
            here, after = slice(first, last), slice(first + 1, last + 1)
            self.end[here], self.begin[after], self.rule[here] = found.E, found.S, found.rule
            self.insert[after], self.turn[after], self.apart[after] = found.insert, found.turn, found.apart
            self._remain(here)
        self.rule[el.exit & ~el.on] = Rule.EXIT
        if el.on[-1]:  # a contour that ends without an exit: the tool stands square to its end
            self.end[-1] = el.end[-1] + el.R[-1] * el.s[-1] * left(el.t_out[-1])
            lead = Rule.ENTRY if el.entry[-1] else Rule.CHANGE if el.change[-1] else Rule.SIDE
            self.rule[-1] = lead
        self._remain(slice(n - 1, n))
        free = np.flatnonzero(~el.wall)
        self.sweep[free] = el.sweep[free]

    def rows(self, k: Index) -> Curves:
        """The rows of the tool centre beside elements k (m,)."""
        el = self.el
        r = np.abs(el.r[k] - el.s[k] * np.sign(el.sweep[k]) * el.R[k])
        return Curves(self.begin[k], self.end[k], el.centre[k], np.where(el.arc[k], r, np.nan), self.sweep[k])

    def arcs(self, k: Index) -> Curves:
        """The arcs about corners that lead to elements k (m,)."""
        start, corner = self.end[k - 1], self.el.end[k - 1]
        return Curves(start, self.begin[k], corner, length_of(start - corner), self.turn[k])

    def looking_ahead(self) -> Equidistant:
        """The same for rules that look at the whole contour: what they find to be a gouge is more, the path is the same."""
        twin = copy(self)
        twin.rules = replace(self.rules, look_ahead=True)
        return twin

    def _remain(self, k: slice) -> None:
        found = remaining(self.el, k, self.begin[k], self.end[k], self.el.R[k])
        self.left_over[k], self.sweep[k] = found
