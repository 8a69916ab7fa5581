"""How the tool-centre path was found, for people: corners and offset vectors.

An offset vector leads from a foot on the contour to the tool centre; it is R long and square to the contour. Where the
tool rolls about a corner both lead from the corner itself; where it is cut off inside, from the two places that it
touches; at a straight corner from the corner to the offsets that are prolonged.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from mnclab.geometry.offsets import beside
from mnclab.path import corners as joints
from mnclab.path.columns import Array, Index, Mask
from mnclab.path.compensation.elements import Elements
from mnclab.path.compensation.equidistant import Equidistant
from mnclab.path.compensation.rules import Compensation
from mnclab.path.kinds import Rule
from mnclab.path.plane import PlaneView
from mnclab.path.toolpath import Toolpath

APART = 1e-9  # mm


@dataclass(frozen=True)
class Construction:
    """m corners and q offset vectors; points (…, 3) mm, relative to the path's origin.

    `path` is the contour with its roundings and chamfers. `place` (m, 3) are its corners, `rule` (m,) what was
    done there, `line` (m,) the block that leads to it, `along` (m, 3) the unit tangent into the contour. Vectors
    lead from `foot` (q, 3) to `tip` (q, 3) and belong to the corner `of` (q,).
    """

    path: Toolpath
    view: PlaneView
    found: Equidistant | None
    place: Array
    rule: NDArray[np.uint8]
    line: NDArray[np.int32]
    along: Array
    foot: Array
    tip: Array
    of: Index

    @property
    def compensated(self) -> Mask:
        """Which rows of `path` are elements that are compensated, or lead to or from one (n,)."""
        rows = np.zeros(len(self.path), dtype=bool)
        if self.found is not None:
            rows[self.found.el.rows] = self.found.el.on | self.found.el.exit
        return rows


def construct(programmed: Toolpath, rules: Compensation | None, unfinished: bool = False) -> Construction:
    """The construction for a programmed contour; without corners where nothing is compensated. `unfinished`: the
    program broke off, so the end of its last compensated element is unknown."""
    path = joints.apply(programmed, unfinished)
    view = PlaneView(path)
    rows = np.flatnonzero(view.moves)
    if rules is not None and len(rows):
        el = Elements.of(path, view, rows)
        if unfinished and el.on[-1]:
            el = Elements.of(path, view, rows[:-1])
        if el.on.any():
            return _constructed(path, view, Equidistant(el, rules))
    none, index = np.empty((0, 3)), np.empty(0, np.int64)
    return Construction(path, view, None, none, index.astype(np.uint8), index.astype(np.int32), none, none, none, index)


def _constructed(path: Toolpath, view: PlaneView, found: Equidistant) -> Construction:
    el = found.el
    c = np.flatnonzero(el.on)
    rule = _rules(found)[c]
    d = np.minimum(c + 1, len(el.rows) - 1)  # the element after; the same one where the program ends
    P, R, shift = el.end[c], el.R[c], el.R[c] * el.s[c]
    first, second = found.end[c], np.where((d > c)[:, None], found.begin[d], found.end[c])
    straight = rule == Rule.OUTSIDE_STRAIGHT
    first[straight] = beside(P, el.t_out[c], shift)[straight]
    second[straight] = beside(P, el.t_in[d], shift)[straight]
    feet = P.copy(), P.copy()
    k = np.flatnonzero((rule == Rule.INSIDE) & ~found.apart[c])
    feet[0][k], feet[1][k] = _foot(found, c[k], first[k], False), _foot(found, d[k], first[k], True)
    twice = np.hypot(*(first - second + feet[1] - feet[0]).T) > APART * np.maximum(1, R)
    both = np.concatenate([np.arange(len(c)), np.flatnonzero(twice)])
    order = np.argsort(both, kind="stable")
    row, w = el.rows[c], view.end[el.rows[c], 2]

    def in_space(points: Array, of: Index) -> Array:
        return view.to_space(row[of], np.column_stack([points, w[of]]))

    def pairs(one: Array, other: Array) -> Array:
        return in_space(np.concatenate([one, other[twice]])[order], both[order])

    every = np.arange(len(c))
    place, leads = in_space(P, every), (el.entry[c] | el.change[c]) & (d > c)
    along = in_space(P + np.where(leads[:, None], el.t_in[d], -el.t_out[c]), every) - place
    vectors = pairs(*feet), pairs(first, second), both[order]
    return Construction(path, view, found, place, rule, path.line[row], along, *vectors)


def _rules(found: Equidistant) -> NDArray[np.uint8]:
    """What is done at the end of each element (n,): as in the path, with the first and last corners named as such."""
    rule, el = found.rule.copy(), found.el
    rule[:-1][found.insert[1:]] = Rule.OUTSIDE_ARC
    rule[found.apart] = Rule.INSIDE
    free = ~np.isin(rule[:-1], (Rule.OUTSIDE_ARC, Rule.OUTSIDE_STRAIGHT))
    rule[:-1][el.exit[1:] & free] = Rule.EXIT
    rule[:-1][el.change[1:] & free] = Rule.CHANGE
    return rule


def _foot(found: Equidistant, k: Index, centre: Array, at_start: bool) -> Array:
    """Where the tool at `centre` (m, 2) touches elements k (m,); an offset that turned inside out lies opposite."""
    el = found.el
    result = beside(centre, el.t_in[k] if at_start else el.t_out[k], -el.R[k] * el.s[k])
    a = np.flatnonzero(el.arc[k])
    if len(a):
        j = k[a]
        offset = el.r[j] - el.s[j] * np.sign(el.sweep[j]) * el.R[j]
        result[a] = el.centre[j] + (centre[a] - el.centre[j]) * (el.r[j] / offset)[:, None]
    return result
