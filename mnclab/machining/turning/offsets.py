"""The offset of a turned profile away from the part, with sharp outside corners. Coordinates (z, r), mm.

The upper envelope of everything that bounds the offset: the elements moved along their normals, and at every outside
corner both neighbours prolonged until they meet (an arc about the corner where they do not). Whatever a neighbour of a
small element covers is covered in the envelope too, so that loops need no search. ::

        ______ .         the two elements and their offsets,
        ____  \\          prolonged to the corner
            \\  \\
"""

from __future__ import annotations

import math

import numpy as np

from mnclab.geometry.contours import Contour, Floats
from mnclab.geometry.vectors import left
from mnclab.geometry.whole_curves import Curve
from mnclab.machining.turning.profiles import SAME, Stretch, checked, stretches, uppermost


def offset(profile: Contour, distance: float, front: float) -> Contour:
    """The profile moved outwards by a distance, from z `front` to above its end.

    In front of the face it goes on level, and so does the part behind its end.
    """
    contour = checked(profile)
    first, last = contour.points[0], contour.points[-1]
    head, tail = np.array([front + distance, first[1]]), last - (2 * distance + 1, 0.0)
    ways = np.vstack([head, contour.points, tail])
    whole = Contour(ways, [0.0, *contour.bulge[:-1], 0.0, 0.0], closed=False)
    if distance <= SAME:
        body = stretches(Contour(ways[:-1], [0.0, *contour.bulge], closed=False))
        return uppermost(body, (front, float(first[1])), last)
    pieces = [piece for curve in _moved(whole, distance) for piece in curve]
    end = float(last[0])
    right, stop = (front, _over(pieces, front)), (end, _over(pieces, end))
    return uppermost(pieces, right, stop)


def _over(pieces: list[Stretch], z: float) -> float:
    return max(piece.at(z) for piece in pieces if piece.left - SAME <= z <= piece.right + SAME)


def _moved(whole: Contour, distance: float) -> list[list[Stretch]]:
    """The offset of every element, and what joins them at outside corners; to the right of the way is outside."""
    found = []
    begins, ends = whole.tangents()
    for i, (start, end) in enumerate(zip(whole.starts, whole.ends, strict=True)):
        out_start, out_end = start - distance * left(begins[i]), end - distance * left(ends[i])
        radius = float(whole.radii[i]) + (distance if whole.bulge[i] > 0 else -distance)
        if not whole.bulge[i]:
            found.append(_line(out_start, out_end))
        elif radius > SAME:
            found.append(_arc(out_start, out_end, whole.centres[i], math.copysign(radius, whole.bulge[i])))
    for i, turn in enumerate(whole.turns()):
        if i and turn > 1e-9:
            found += _corner(whole, i, distance, begins[i], ends[i - 1])
    return found


def _corner(whole: Contour, i: int, distance: float, begin: Floats, end: Floats) -> list[list[Stretch]]:
    """What joins two offsets at an outside corner."""
    corner = whole.starts[i]
    before, after = corner - distance * left(end), corner - distance * left(begin)
    if not whole.bulge[i - 1] and not whole.bulge[i]:
        meeting = Curve(before, end, np.inf).meeting(Curve(after, begin, np.inf), before)
        return [_line(before, meeting), _line(meeting, after)]
    return [_arc(before, after, corner, distance)]


def _line(start: Floats, end: Floats) -> list[Stretch]:
    right, to_left = (start, end) if start[0] > end[0] else (end, start)
    if right[0] - to_left[0] <= SAME:
        return []
    return [Stretch(float(right[0]), float(to_left[0]), (float(right[1]), float(to_left[1])))]


def _arc(start: Floats, end: Floats, centre: Floats, radius: float) -> list[Stretch]:
    """An arc that runs to smaller z; about a corner beside a shoulder it may begin or end on the side of the circle."""
    if start[0] - end[0] <= SAME:
        return []
    ends = float(start[1]), float(end[1])
    return [Stretch(float(start[0]), float(end[0]), ends, (float(centre[0]), float(centre[1])), radius)]
