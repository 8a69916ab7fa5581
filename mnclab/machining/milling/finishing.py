"""Finishing along walls: up to the wall on an arc that touches it, once round, and off on another. Lengths in mm.

        p                 the quarter circles have their centre at p + r·n, n being the unit normal away from
────────┬────────►        the wall; the tool comes from p + r·n - r·t and leaves for p + r·n + r·t
      ╱   ╲               (t: the direction of travel at p)
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike

from mnclab.geometry.contours import Contour
from mnclab.geometry.regions import Region
from mnclab.geometry.shapes import QUARTER
from mnclab.geometry.vectors import cross, left
from mnclab.machining.milling.clearing import Clearing, Piece, numbered, room_for

LEAST = 1e-6  # mm, of an arc up to a wall or off it


def tangential(contour: Contour, radius: float, side: int, *, approach: bool = True, departure: bool = True) -> Contour:
    """A closed pass with quarter circles of a radius before and after it, on its left (`side` 1) or right (-1)."""
    if not contour.closed:
        raise ValueError("only a closed contour is finished once round")
    (ahead, *_), (*_, away) = contour.tangents()
    first = contour.points[0]
    points, bulge = np.vstack([contour.points, first]), np.append(contour.bulge, 0.0)
    if radius > 0 and departure:
        points = np.vstack([points, first + radius * (side * left(away) + away)])
        bulge[-1] = side * QUARTER
        bulge = np.append(bulge, 0.0)
    if radius > 0 and approach:
        points = np.vstack([first + radius * (side * left(ahead) - ahead), points])
        bulge = np.append(side * QUARTER, bulge)
    return Contour(points, bulge, closed=False)


def approaching(contour: Contour, radius: float, side: int) -> Contour:
    """The quarter circle by which a tool comes to the wall before a closed pass."""
    way = tangential(contour, radius, side, departure=False)
    return Contour(way.points[:2], way.bulge[:2], closed=False)


def leaving(contour: Contour, radius: float, side: int) -> Contour:
    """The quarter circle by which a tool leaves the wall after a closed pass."""
    (*_, away) = contour.tangents()[1]
    end = contour.points[0]
    return Contour([end, end + radius * (side * left(away) + away)], [side * QUARTER, 0.0], closed=False)


def quarter_circles(contour: Contour, radius: float, side: int) -> tuple[Contour, ...]:
    """The ways up to a wall and off it on quarter circles of a radius; none for a radius of 0."""
    return (approaching(contour, radius, side), leaving(contour, radius, side)) if radius > LEAST else ()


def half_circles(contour: Contour, diameter: float, side: int) -> tuple[Contour, ...]:
    """The ways up to a wall and off it on half circles: both from and to the place that is a `diameter` away from it."""
    if not diameter > LEAST:
        return ()
    (ahead, *_), (*_, away) = contour.tangents()
    wall = contour.points[0]
    before, after = wall + diameter * side * left(ahead), wall + diameter * side * left(away)
    return (
        Contour([before, wall], [float(side), 0.0], closed=False),
        Contour([wall, after], [float(side), 0.0], closed=False),
    )


def onto(place: ArrayLike, contour: Contour) -> Contour | None:
    """The arc from a place to the begin of a pass that touches it there; None where the place lies on the pass.

    The larger part of a circle where the place lies ahead.
    """
    (ahead, *_), _ = contour.tangents()
    chord = contour.points[0] - np.asarray(place, dtype=float)
    if np.hypot(*chord) <= LEAST:
        return None
    turn = math.atan2(float(cross(chord, ahead)), float(chord @ ahead))
    return Contour([place, contour.points[0]], [math.tan(turn / 2), 0.0], closed=False)


def outwards(contour: Contour, diameter: float, side: int) -> Contour:
    """The half circle that touches the end of a pass and leads as far to its left (`side` 1) or right (-1)."""
    (*_, away) = contour.tangents()[1]
    end = contour.points[0 if contour.closed else -1]
    return Contour([end, end + diameter * side * left(away)], [float(side), 0.0], closed=False)


def walls(
    region: Region, radius: float, approach: float, *, allowances: tuple[float, ...] = (0.0,), climb: bool = True
) -> Clearing:
    """Finishing passes along all walls and islands of a region, one round for each of the allowances, in order.

    Every round begins in the middle of the longest element and comes up on a quarter circle of the radius `approach`,
    of a smaller one where the pocket is narrow. The tool lifts between rounds.
    """
    pieces, side = [], 1 if climb else -1
    for k, allowance in enumerate(allowances, 1):
        centres = room_for(region, radius, radius, allowance)
        for part in centres.parts:
            rounds = [_round(part, loop, approach, side) for loop in part.loops]
            name = "side finishing" if len(allowances) == 1 else f"side finishing {k} of {len(allowances)}"
            pieces += [Piece(part, (way,), (), (label,)) for way, label in zip(rounds, numbered(name, len(rounds)))]
    return Clearing(room_for(region, radius, radius, allowances[-1]), tuple(pieces), radius)


def _round(centres: Region, loop: Contour, approach: float, side: int) -> Contour:
    longest = int(loop.lengths.argmax())
    ring = loop.started_at(loop.lengths[:longest].sum() + loop.lengths[longest] / 2)
    ring = ring if side > 0 else ring.reversed()
    radius = approach
    for _ in range(6):
        way = tangential(ring, radius, side)
        arcs = np.vstack([_arc_points(way, 0), _arc_points(way, len(way.starts) - 1)])
        if (centres.contains(arcs) | (centres.distance(arcs) < 1e-6)).all():
            return way
        radius /= 2
    return tangential(ring, 0.0, side)


def _arc_points(way: Contour, element: int) -> np.ndarray:
    """Points of one element of a pass, a tenth of it apart."""
    upto, size = way.lengths[:element].sum(), way.lengths[element]
    return way.point_at(upto + size * np.linspace(0, 1, 11))[0]
