"""Corners of the equidistant: where an offset ends and the next one begins, all of them at once."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from mnclab.geometry.offsets import beside, meet
from mnclab.geometry.vectors import cross, dot
from mnclab.path.columns import Array, Index, Mask
from mnclab.path.compensation.cusps import in_a_cusp, inside_cusps, rolls_through
from mnclab.path.compensation.elements import Elements
from mnclab.path.compensation.rules import ACUTE_TURN, CUSP, ROUND, STRAIGHT, TANGENT, Compensation
from mnclab.path.kinds import Rule


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
    across, along = cross(t1, t2), dot(t1, t2)
    small = np.abs(across) < np.sin(TANGENT)
    reversal = small & (along < 0)  # straight back: an outside corner of half a turn
    bent = on & ~(small & (along > 0))
    out = reversal | (s * across < 0)
    cusp = bent & (along < np.cos(CUSP)) & (el.arc[b] | el.arc[a]) & el.wall[b] & el.wall[a]
    if cusp.any():
        k = np.flatnonzero(cusp)
        out[k] = ~inside_cusps(el, c[k], R[k], s[k])
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
        E[k[square & lead[k]]] = S[k[square & lead[k]]]
        E[stays] = S[stays] = P[stays]
        S[to_first] = beside(P[to_first], t1[to_first], shift[to_first])

    corner = el.corner[a]
    straight = outside & ~reversal & (s * across < 0) & (corner != ROUND)
    straight &= (corner == STRAIGHT) | (along >= np.cos(ACUTE_TURN))
    inside = bent & ~out & ~change & ~lead & ~leave
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
