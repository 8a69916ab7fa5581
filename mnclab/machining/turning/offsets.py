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
from collections.abc import Iterator

import numpy as np

from mnclab.geometry.contours import Contour
from mnclab.geometry.curves import Curve, left
from mnclab.machining.turning.profiles import SAME, Stretch, checked, stretches, uppermost


def offset(profile: Contour, distance: float, front: float) -> Contour:
    """The profile moved outwards by a distance, from z `front` to above its end; level before the face and behind the end."""
    contour = checked(profile)
    first, last = contour.points[0], contour.points[-1]
    head, tail = np.array([front + distance, first[1]]), last - (2 * distance + 1, 0.0)
    ways = np.vstack([head, contour.points, tail])
    whole = Contour(ways, [0.0, *contour.bulge[:-1], 0.0, 0.0], closed=False)
    if distance <= SAME:
        body = stretches(Contour(ways[:-1], [0.0, *contour.bulge], closed=False))
        return uppermost(body, (front, float(first[1])), last)
    pieces = [piece for part in _moved(whole, distance) for piece in stretches(part)]
    end = float(last[0])
    right, stop = (front, _over(pieces, front)), (end, _over(pieces, end))
    return uppermost(pieces, right, stop)


def _over(pieces: list[Stretch], z: float) -> float:
    return max(piece.at(z) for piece in pieces if piece.left - SAME <= z <= piece.right + SAME)


def _moved(whole: Contour, distance: float) -> Iterator[Contour]:
    """The offset of every element, and what joins them at outside corners; to the right of the way is outside."""
    begins, ends = whole.tangents()
    starts, stops = whole.starts - distance * left(begins), whole.ends - distance * left(ends)
    for i, bulge in enumerate(whole.bulge[:-1]):
        if not bulge or whole.radii[i] + math.copysign(distance, bulge) > SAME:  # an arc may shrink to nothing
            yield Contour([starts[i], stops[i]], [bulge, 0.0], closed=False)
    for i, turn in enumerate(whole.turns()):
        if i and turn > 1e-9:
            yield _corner(whole, i, Curve(stops[i - 1], ends[i - 1], np.inf), Curve(starts[i], begins[i], np.inf))


def _corner(whole: Contour, i: int, before: Curve, after: Curve) -> Contour:
    """What joins two offsets at an outside corner: both prolonged if they are lines, else an arc about it."""
    if not whole.bulge[i - 1] and not whole.bulge[i]:
        meeting = before.meeting(after, before.point)
        return Contour([before.point, meeting, after.point], closed=False)
    return Contour([before.point, after.point], [math.tan(whole.turns()[i] / 4), 0.0], closed=False)
