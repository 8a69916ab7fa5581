"""What a tool that does not fit cuts away behind the contour, as a function of points: for pictures.

A point is cut away when the tool covers it beside one of the walls and it lies *behind* the contour: its nearest place
on the contour is seen from the side where the tool should not be. Points beyond an open end are not behind anything.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from functools import reduce

import numpy as np

from mnclab.geometry.curves import Curves, distance, foot, share
from mnclab.geometry.offsets import beside
from mnclab.path.columns import Array, Index, Mask
from mnclab.path.compensation.construction import Construction
from mnclab.path.compensation.equidistant import Equidistant

TIE = 1e-9  # mm: walls that are equally near vote together


@dataclass(frozen=True)
class Overcut:
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


def overcuts(made: Construction, steps: Iterable[int]) -> Iterator[Overcut]:
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
        tool = _rows(found, np.concatenate([k, leads]))
        row = int(el.rows[k[0]])
        n_in, n_out = (beside(np.zeros((1, 2)), t[k], el.s[k]) for t in (el.t_in, el.t_out))
        yield Overcut(el.curves(k), n_in, n_out, tool, float(el.R[k[0]]), row, float(made.view.end[row, 2]))


def _rows(found: Equidistant, k: Index) -> Curves:
    """The rows of the tool centre along elements k, and the arcs inserted before them."""
    el, c = found.el, k[found.insert[k]]
    start, end = np.concatenate([found.begin[k], found.end[c - 1]]), np.concatenate([found.end[k], found.begin[c]])
    centre, sweep = np.concatenate([el.centre[k], el.end[c - 1]]), np.concatenate([found.sweep[k], found.turn[c]])
    arc: Mask = np.concatenate([el.arc[k], np.ones(len(c), dtype=bool)])
    return Curves(start, end, centre, np.where(arc, np.hypot(*(start - centre).T), np.nan), sweep)


def _one(curves: Curves, k: int, count: int) -> Curves:
    """One curve as often as there are points."""
    return Curves(*(np.broadcast_to(column[k], (count, *column.shape[1:])) for column in curves))
