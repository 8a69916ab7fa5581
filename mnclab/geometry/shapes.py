"""Contours of simple figures from numbers: rectangle, slot, regular polygon. Lengths in mm, angles in rad.

All are closed and run counter-clockwise. They begin where a tool likes to begin: in the middle of a side.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from mnclab.geometry.contours import Contour, Floats
from mnclab.geometry.vectors import at_angle, left, length_of, turned
from mnclab.text.alarm import Alarm
from mnclab.text.given import check_number, check_point, shown, whole

QUARTER = float(np.tan(np.pi / 8))  # the bulge of a quarter circle
MOST_CORNERS = 1_000_000  # of a polygon


def rectangle(
    length: float, width: float, corner: float = 0.0, *, centre: ArrayLike = (0, 0), angle: float = 0.0, begin: int = 0
) -> Contour:
    """A rectangle with corners of a radius; it begins where the axis `begin` (0 X, 1 Y) leaves it on the positive side.

    Raises ValueError where a side is not greater than 0 or the corners do not fit.
    """
    for name, number in (("length", length), ("width", width), ("corner radius", corner)):
        check_number(number, f"the {name} of a rectangle (mm)")
    _check_place("a rectangle", centre, angle)
    if whole(begin, "the axis at which a rectangle begins") not in (0, 1):
        raise Alarm(f"a rectangle begins at the axis 0 (X) or 1 (Y), got {shown(begin)}")
    a, b = length / 2, width / 2
    if not (a > 0 and b > 0):
        raise Alarm(f"the sides of a rectangle must be greater than 0, got {length:g} and {width:g}")
    if not 0 <= corner <= min(a, b) + 1e-9:
        raise Alarm(f"a corner radius of {corner:g} does not fit into {length:g} by {width:g}")
    corner = min(corner, a, b)
    points = np.roll(np.array([(a, b), (-a, b), (-a, -b), (a, -b)]), -begin, axis=0)
    ahead = np.roll(np.array([(0, 1), (-1, 0), (0, -1), (1, 0)]), -begin, axis=0)
    bulge = np.zeros(5)
    if corner:
        points = np.stack([points - corner * ahead, points + corner * left(ahead)], axis=1).reshape(-1, 2)
        bulge = np.append(0.0, np.tile([QUARTER, 0.0], 4))
    points = np.vstack([[(a, 0.0), (0.0, b)][begin], points])
    some = length_of(np.roll(points, -1, axis=0) - points) > 1e-9  # two roundings may use up a side
    return Contour(placed(points[some], centre, angle), bulge[some])


def slot(line: Contour, width: float) -> Contour:
    """What lies within width / 2 of one straight line or one arc; it begins beyond the end of the line.

    An arc may come in pieces, so that it can go all the way round. Raises ValueError where the line has a corner, or is
    bent too much for the width.
    """
    if not isinstance(line, Contour):
        raise Alarm(f"the centre line of a slot must be a Contour, got {shown(line)}")
    check_number(width, "the width of a slot (mm)")
    if not is_smooth(line):
        raise Alarm("a slot has a centre line of one straight line or one arc")
    half, bulge = width / 2, line.bulge[:-1]
    if not 0 < half < line.radii.min():
        raise Alarm(f"a slot {width:g} wide does not fit its centre line")
    begins, ends = line.tangents()
    aside = half * left(np.vstack([begins, ends[-1:]]))
    beyond, before = line.points[-1] + half * ends[-1], line.points[0] - half * begins[0]
    points = np.vstack([beyond, (line.points + aside)[::-1], before, line.points - aside])
    return Contour(points, np.concatenate([[QUARTER], -bulge[::-1], [QUARTER, QUARTER], bulge, [QUARTER]]))


def is_smooth(line: Contour) -> bool:
    """Whether an open contour is one straight line or one arc, in any number of pieces."""
    begins, ends = line.tangents()
    bends = np.sign(line.bulge[:-1]) / line.radii
    one_way = np.allclose(begins[1:], ends[:-1], atol=1e-6) and np.allclose(bends, bends[0], rtol=1e-6)
    return not line.closed and bool(one_way)


def arc(radius: float, begin: float, sweep: float) -> Contour:
    """An arc about (0, 0) from the angle `begin` (rad) on, at most a full turn; above half a turn in two pieces."""
    check_number(radius, "the radius of an arc (mm)")
    check_number(begin, "the angle at which an arc begins (rad)")
    check_number(sweep, "the angle that an arc goes through (rad)")
    count = 1 if abs(sweep) <= np.pi else 2
    way = begin + sweep * np.arange(count + 1) / count
    bulge = np.append(np.full(count, np.tan(sweep / count / 4)), 0.0)
    return Contour(radius * at_angle(way), bulge, closed=False)


def polygon(corners: int, radius: float, *, centre: ArrayLike = (0, 0), angle: float = 0.0) -> Contour:
    """A regular polygon in a circle of a radius, its first corner at `angle`."""
    check_number(corners, "the number of corners of a polygon", at_most=MOST_CORNERS)
    corners = whole(corners, "the number of corners of a polygon")
    check_number(radius, "the radius of a polygon (mm)")
    _check_place("a polygon", centre, angle)
    if corners < 3 or not radius > 0:
        raise Alarm(f"a polygon has at least 3 corners and a radius above 0, got {corners} and {radius:g}")
    way = angle + 2 * np.pi * np.arange(corners) / corners
    return Contour(placed(radius * at_angle(way), centre, 0.0))


def _check_place(figure: str, centre: ArrayLike, angle: float) -> None:
    check_point(centre, f"the centre of {figure} (mm)", flat=True)
    check_number(angle, f"the angle of {figure} (rad)")


def placed(points: Floats, centre: ArrayLike, angle: float) -> Floats:
    """Points `(n, 2)` turned about the origin, then moved to a centre."""
    return np.asarray((turned(points, angle) if angle else points) + np.asarray(centre, dtype=float))
