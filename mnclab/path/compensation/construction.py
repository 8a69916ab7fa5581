"""How the tool-centre path was found, for people: corners and offset vectors.

An offset vector leads from a foot on the contour to the tool centre; it is R long and square to the contour. Where the
tool rolls about a corner both lead from the corner itself; where it is cut off inside, from the two places that it
touches; at a straight corner from the corner to the offsets that are prolonged.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from functools import reduce

import numpy as np
from numpy.typing import NDArray

from mnclab.geometry.curves import Curves, beside, distance, foot, share
from mnclab.path import corners as joints
from mnclab.path.compensation.elements import Compensation, Elements
from mnclab.path.compensation.equidistant import Equidistant
from mnclab.path.plane import PlaneView
from mnclab.path.toolpath import Array, Index, Mask, Rule, Toolpath

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


# What a tool that does not fit cuts away behind the contour, as a function of points: for pictures.
# A point is cut away when the tool covers it beside one of the walls and it lies *behind* the contour: its nearest place
# on the contour is seen from the side where the tool should not be. Points beyond an open end are not behind anything.

TIE = 1e-9  # mm: walls that are equally near vote together


@dataclass(frozen=True)
class GougedWall:
    """One contour that the tool cuts into, in the coordinates of its plane.

    `walls` (w): lines and arcs of the contour, `n_in`, `n_out` (w, 2) their unit normals to the tool; `tool`
    are the rows of the tool centre beside them, `radius` (mm) its radius; `row` is a row of the path in this plane,
    `height` the third coordinate.
    """

    walls: Curves
    n_in: Array
    n_out: Array
    tool: Curves
    radius: float
    row: int
    height: float

    @property
    def box(self) -> tuple[Array, Array]:
        """The corners (2,) of a box around all that the tool covers."""
        reach = np.where(self.tool.arc, 2 * np.nan_to_num(self.tool.r), 0.0)[:, None] + self.radius
        low, high = np.minimum(self.tool.start, self.tool.end), np.maximum(self.tool.start, self.tool.end)
        return (low - reach).min(axis=0), (high + reach).max(axis=0)

    def depth(self, p: Array) -> Array:
        """How far inside of what is cut away points p (m, 2) lie, mm; negative outside of it."""
        swept = reduce(np.minimum, (distance(p, _one(self.tool, k, len(p))) for k in range(len(self.tool.r))))
        return np.minimum(self.radius - swept, self.behind(p))

    def behind(self, p: Array) -> Array:
        """How far behind the contour points p (m, 2) lie, mm; negative in front of it and beyond its open ends."""
        least, vote, seen = np.full(len(p), np.inf), np.zeros(len(p)), np.zeros(len(p))
        for k in range(len(self.walls.r)):
            wall = _one(self.walls, k, len(p))
            where, at = share(p, wall), foot(p, wall)
            inner = (where > 0) & (where < 1) & np.isfinite(at).all(axis=1)
            to_start, to_end = np.hypot(*(p - wall.start).T), np.hypot(*(p - wall.end).T)
            first = to_start <= to_end
            away = np.where(inner, np.hypot(*(p - at).T), np.minimum(to_start, to_end))
            corner = np.where(first[:, None], wall.start, wall.end)
            normal = np.where(first[:, None], self.n_in[k], self.n_out[k])
            if wall.arc[0]:  # beside an arc the normal is the spoke
                spoke = (wall.centre - at) / wall.r[0]
                toward = np.sign((wall.centre[0] - wall.start[0]) @ self.n_in[k])
                normal = np.where(inner[:, None], toward * spoke, normal)
            facing = ((p - np.where(inner[:, None], at, corner)) * normal).sum(axis=1)
            nearer, tied = away < least - TIE, np.abs(away - least) <= TIE
            vote = np.where(nearer, facing, vote + np.where(tied, facing, 0.0))
            weight = np.where(inner, 2, 1)  # one end alone is an open end
            seen = np.where(nearer, weight, seen + np.where(tied, weight, 0))
            least = np.minimum(least, away)
        return np.where((vote < 0) & (seen > 1), least, -least)


def gouged_walls(made: Construction, steps: Iterable[int]) -> Iterator[GougedWall]:
    """The contours that are cut into in some of the `steps` (of the places that do not fit)."""
    found = made.found
    if found is None:
        return
    el = found.el
    bad = np.isin(made.path.step[el.rows], list(steps)) & (el.on | el.exit)
    contour = np.cumsum(el.lead | el.exit, dtype=np.int64) - el.exit  # an exit belongs to what it leaves
    for which in np.unique(contour[bad]):
        k = np.flatnonzero((contour == which) & el.wall)
        if not len(k):
            continue
        leads = np.flatnonzero((contour == which) & bad & ~el.wall)
        beside_it = np.concatenate([k, leads])
        rows, arcs = found.rows(beside_it), found.arcs(beside_it[found.insert[beside_it]])
        tool = Curves(*map(np.concatenate, zip(rows, arcs, strict=True)))
        row = int(el.rows[k[0]])
        n_in, n_out = (beside(np.zeros((1, 2)), t[k], el.s[k]) for t in (el.t_in, el.t_out))
        yield GougedWall(el.curves(k), n_in, n_out, tool, float(el.R[k[0]]), row, float(made.view.end[row, 2]))


def _one(curves: Curves, k: int, count: int) -> Curves:
    """One curve as often as there are points."""
    return Curves(*(np.broadcast_to(column[k], (count, *column.shape[1:])) for column in curves))
