"""Ways between two places that leave and arrive in given directions: of arcs of one radius and a line. Lengths in mm.

      ___                The shortest of all that nowhere bend more sharply than a circle of radius r are of these (L. E. Dubins,
     /   \\               On curves of minimal length with a constraint on average curvature, and with prescribed initial and
    |     \\___           terminal positions and tangents, Amer. J. Math. 79, 1957): arc, line, arc, the arcs to the same side
                         or to both, or three arcs in turn. The formulas are those of A. M. Shkel and V. Lumelsky,
                         Classification of the Dubins set, Robotics and Autonomous Systems 34, 2001, in units of r.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from mnclab.geometry.contours import Contour
from mnclab.geometry.curves import Curves, Floats, at_angle, cross, crossings, length_of
from mnclab.geometry.cutting import outlines_of
from mnclab.geometry.regions import Region

SENSES = np.array([(1, 0, 1), (1, 0, -1), (1, -1, 1), (-1, 0, -1), (-1, 0, 1), (-1, 1, -1)])  # of the three elements; 0: a line
TURN = 5e-7  # rad, by which a way may turn from element to element
SHORTEST = 1e-6  # mm, of an element
NEAR = 1e-4  # mm from its ends a way may touch the boundary
EXACT = 1e-10  # mm, by which a place may lie outside
SPOTS = 16  # on each way
AT_ONCE, MOST = 16, 128  # ways that are looked at


def shortest(start: Floats, ahead: Floats, end: Floats, onward: Floats, radius: Floats) -> Floats:
    """What n ways have of each of `SENSES`: the sweeps of arcs (rad) and lengths of lines in radii, `(n, 6, 3)`, nan for none.

    `start` and `end` (n, 2); directions `ahead` and `onward` (n,) in rad, with which they leave and arrive; `radius` (n,).
    """
    way = end - start
    toward, far = np.arctan2(way[:, 1], way[:, 0]), length_of(way) / radius
    return np.concatenate([_beginning_left(far, s * (ahead - toward), s * (onward - toward)) for s in (1, -1)], axis=1)


def _beginning_left(d: Floats, a: Floats, b: Floats) -> Floats:
    """The ways that begin to the left, over a distance d, at angles a and b from it: of three kinds, `(n, 3, 3)`."""
    dy, dx, same = np.cos(b) - np.cos(a), d + np.sin(a) - np.sin(b), 2 * np.cos(a - b)
    aim = np.arctan2(dy, dx)
    across = np.arctan2(-np.cos(a) - np.cos(b), d + np.sin(a) + np.sin(b))
    with np.errstate(invalid="ignore"):
        line = np.sqrt(d * d - 2 + same + 2 * d * (np.sin(a) + np.sin(b)))
        bend = 2 * np.pi - np.arccos((6 - d * d + same + 2 * d * (np.sin(b) - np.sin(a))) / 8)
    lean = across - np.arctan2(-2.0, line)
    found = np.stack([
        np.stack([_turn(aim - a), np.hypot(dx, dy), _turn(b - aim)], axis=1),
        np.stack([_turn(lean - a), line, _turn(lean - b)], axis=1),
        np.stack([_turn(aim - a + bend / 2), bend, _turn(b - aim + bend / 2)], axis=1),
    ], axis=1)  # fmt: skip
    return np.where(np.isfinite(found).all(axis=2)[..., None], found, np.nan)


def _turn(angle: Floats) -> Floats:
    """Angles brought to one turn from 0 on."""
    angle = np.mod(angle, 2 * np.pi)
    return np.where(angle > 2 * np.pi - 1e-9, 0.0, angle)


def way_of(start: Floats, ahead: float, end: Floats, senses: Floats, spans: Floats, radius: float) -> Contour:
    """The contour of one such way, without elements of no length."""
    points, bulge, here = [start], [], start
    for sense, span in zip(senses, spans, strict=True):
        if span * radius > SHORTEST:
            chord = 2 * radius * np.sin(span / 2) if sense else span * radius
            here = here + chord * at_angle(ahead + sense * span / 2)
            ahead += sense * span
            points.append(here)
            bulge.append(np.tan(sense * span / 4))
    return Contour([*points[:-1], end], [*bulge, 0.0], closed=False)


def _spots(start: Floats, ahead: Floats, senses: Floats, spans: Floats, radius: Floats) -> Floats:
    """Places at equal distances on m such ways, `(m · SPOTS, 2)`."""

    def chord(span: Floats, ahead: Floats, sense: Floats) -> Floats:
        half = sense * span / 2
        return (span * np.sinc(half / np.pi))[..., None] * at_angle(ahead + half)

    none = np.zeros((len(start), 1))
    upto, headings = np.hstack([none, spans.cumsum(axis=1)]), ahead[:, None] + np.hstack([none, (senses * spans).cumsum(axis=1)])
    begins = np.concatenate([np.zeros((len(start), 1, 2)), chord(spans, headings[:, :3], senses).cumsum(axis=1)], axis=1)
    way = np.linspace(0, 1, SPOTS) * upto[:, 3:]
    k, element = np.arange(len(start))[:, None], (way[..., None] > upto[:, None, 1:3]).sum(axis=2)
    places = begins[k, element] + chord(way - upto[k, element], headings[k, element], senses[k, element])
    return (start[:, None] + radius[:, None, None] * places).reshape(-1, 2)


def stays_within(region: Region, way: Contour) -> bool:
    """Whether a way stays in a region, at whose boundary it may begin and end but which it does not meet elsewhere."""
    mine, edges = way.curves, outlines_of(region.loops).curves
    i, k = (index.ravel() for index in np.indices((len(mine.r), len(edges.r))))
    met = np.concatenate(crossings(mine.take(i), Curves(*(column[k] for column in edges))))
    met = met[np.isfinite(met[:, 0])]
    ends = way.points[[0, -1]]
    if (length_of(met[:, None] - ends).min(axis=1, initial=np.inf) > NEAR).any():
        return False
    spots = way.point_at(np.concatenate([[NEAR, way.length - NEAR], np.linspace(NEAR, way.length - NEAR, SPOTS)]))[0]
    outside = spots[~region.contains(spots)]
    return not len(outside) or bool((region.distance(outside) <= EXACT).all())


class Place(NamedTuple):
    """Where a way may begin or end: a point `(2,)`, the direction `(2,)`, and the length that it costs."""

    point: Floats
    ahead: Floats
    cost: float


def tangent_way(
    region: Region, leave: Sequence[Place], arrive: Sequence[Place], radii: Sequence[float], reach: float,
    cleared: Sequence[Contour] | None = None,
) -> tuple[int, int, Contour] | None:  # fmt: skip
    """A tangent way from one of some places to one of others, and their numbers; None where none fits.

    It stays in the region and, if passes that have `cleared` are given, within `reach` of them. A short way with little bending
    and a large radius comes first; none is longer than four times the straight one and `reach` together.
    """
    grid = np.indices((len(leave), len(arrive), len(radii))).reshape(3, -1)
    start, ahead, extra = (np.array(column, dtype=float)[grid[0]] for column in zip(*leave, strict=True))
    end, onward, more = (np.array(column, dtype=float)[grid[1]] for column in zip(*arrive, strict=True))
    size = np.array(radii)[grid[2]]
    headings = np.arctan2(ahead[:, 1], ahead[:, 0]), np.arctan2(onward[:, 1], onward[:, 0])
    spans = shortest(start, headings[0], end, headings[1], size)
    lengths = spans.sum(axis=2) * size[:, None]
    most = 4 * (length_of(end - start) + reach)
    rank, kind = np.nonzero(lengths <= most[:, None])
    bends = np.where(SENSES, spans, 0.0).sum(axis=2)
    price = (extra + more)[rank] + lengths[rank, kind] + reach * bends[rank, kind] - 2 * size[rank]
    order = np.argsort(price, kind="stable")[:MOST]
    around, most_off = [contour.bounds for contour in cleared or ()], reach + NEAR
    for first in range(0, len(order), AT_ONCE):
        some = order[first : first + AT_ONCE]
        n, j = rank[some], kind[some]
        spots = _spots(start[n], headings[0][n], SENSES[j], spans[n, j], size[n])
        good = region.contains(spots)
        outside = np.flatnonzero(~good)
        good[outside] = region.distance(spots[outside]) < NEAR
        good = np.repeat(good.reshape(-1, SPOTS).all(axis=1), SPOTS)
        if cleared is not None:
            far = np.flatnonzero(good)
            for contour, (low, high) in zip(cleared[::-1], around[::-1], strict=True):
                near = np.flatnonzero(((spots[far] >= low - most_off) & (spots[far] <= high + most_off)).all(axis=1))
                far = np.delete(far, near[contour.distance(spots[far[near]]) <= most_off]) if len(near) else far
            good[far] = False
        for k in np.flatnonzero(good.reshape(-1, SPOTS).all(axis=1)).tolist():
            m = int(n[k])
            way = way_of(start[m], float(headings[0][m]), end[m], SENSES[j[k]], spans[m, j[k]], float(size[m]))
            begins, ends = way.tangents()
            off = max(abs(cross(ahead[m], begins[0])), abs(cross(ends[-1], onward[m])))
            if off <= TURN and is_smooth(way, float(size[m])) and stays_within(region, way):
                return int(grid[0, m]), int(grid[1, m]), way
    return None


def is_smooth(way: Contour, radius: float) -> bool:
    """Whether a way has no corner and no arc below a radius."""
    return bool(np.abs(way.turns()).max() <= TURN and way.radii.min() >= radius - EXACT)
