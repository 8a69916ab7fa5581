"""Finishing along walls: up to the wall on an arc that touches it, once round, and off on another. Lengths in mm.

        p                 the quarter circles have their centre at p + r·n, n being the unit normal away from
────────┬────────►        the wall; the tool comes from p + r·n - r·t and leaves for p + r·n + r·t
      ╱   ╲               (t: the direction of travel at p)
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike

from mnclab.geometry.contours import QUARTER, Contour
from mnclab.geometry.curves import cross, left
from mnclab.machining.milling.clearing import end

LEAST = 1e-6  # mm, of an arc up to a wall or off it


def approaching(contour: Contour, radius: float, side: int) -> Contour:
    """The quarter circle by which a tool comes to a closed pass; it lies on its left (`side` 1) or right (-1)."""
    ahead, wall = contour.tangents()[0][0], contour.points[0]
    return Contour([wall + radius * (side * left(ahead) - ahead), wall], [side * QUARTER, 0.0], closed=False)


def leaving(contour: Contour, radius: float, side: int) -> Contour:
    """The quarter circle by which a tool leaves the wall after a closed pass."""
    away, here = contour.tangents()[1][-1], end(contour)
    return Contour([here, here + radius * (side * left(away) + away)], [side * QUARTER, 0.0], closed=False)


def quarter_circles(contour: Contour, radius: float, side: int) -> tuple[Contour, ...]:
    """The ways up to a wall and off it on quarter circles of a radius; none for a radius of 0."""
    return (approaching(contour, radius, side), leaving(contour, radius, side)) if radius > LEAST else ()


def half_circles(contour: Contour, diameter: float, side: int) -> tuple[Contour, ...]:
    """The ways up to a wall and off it on half circles: both from and to the place that is a `diameter` away from it."""
    if not diameter > LEAST:
        return ()
    ahead, wall = contour.tangents()[0][0], contour.points[0]
    to = Contour([wall + diameter * side * left(ahead), wall], [float(side), 0.0], closed=False)
    return to, outwards(contour, diameter, side)


def onto(place: ArrayLike, contour: Contour) -> Contour | None:
    """The arc, however long, from a place to the begin of a pass that touches it there; None for a place on the pass."""
    ahead = contour.tangents()[0][0]
    chord = contour.points[0] - np.asarray(place, dtype=float)
    if np.hypot(*chord) <= LEAST:
        return None
    turn = math.atan2(float(cross(chord, ahead)), float(chord @ ahead))
    return Contour([place, contour.points[0]], [math.tan(turn / 2), 0.0], closed=False)


def outwards(contour: Contour, diameter: float, side: int) -> Contour:
    """The half circle that touches the end of a pass and leads as far to its left (`side` 1) or right (-1)."""
    away, here = contour.tangents()[1][-1], end(contour)
    return Contour([here, here + diameter * side * left(away)], [float(side), 0.0], closed=False)
