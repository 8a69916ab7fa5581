"""What passes leave of an area that should be cut: areas, mm². Lengths in mm.

line ends within a surface       a disc of radius R leaves ╭ and ╮ in the corners and, where two lines are not joined
                                 at their ends, a cusp ◠ between them
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from itertools import pairwise

from mnclab.geometry.contours import Contour
from mnclab.geometry.regions import Region
from mnclab.machining.milling.clearing import Clearing, begin, end


def beside_disc(a: float, b: float, radius: float) -> float:
    """The area of a rectangle, `a` by `b` (at most the radius), that a disc about one of its corners does not cover.

    >>> round(beside_disc(10, 10, 10), 6) == round(100 - 25 * math.pi, 6)
    True
    """

    def under(x: float) -> float:  # the disc from 0 to x
        return (
            x * math.sqrt(max(radius * radius - x * x, 0.0)) + radius * radius * math.asin(min(x / radius, 1.0))
        ) / 2

    covered = min(a, math.sqrt(max(radius * radius - b * b, 0.0)))  # as far as the disc is higher than b
    return b * (a - covered) - (under(a) - under(covered))


def within(length: float, width: float, radius: float, places: Sequence[float], outside: bool = False) -> float:
    """The area of a `length` by `width` that a zigzag leaves whose ends lie a radius within the surface.

    Lines run along the length at `places` from one edge of the width, joined in turn at the far and the near end; those of
    a surface shorter than the tool are a point. Of a surface from 2 R to 3 R long the area is a hair too large: there one end
    of the lines reaches what stands at the other. `outside`: the first line begins outside.
    """
    a, b = min(radius, length / 2), min(radius, width / 2)
    covered = places[0] + radius if outside else -math.inf  # at the near end the first line comes over all below this

    def left(deep: float, below: float = 0.0) -> float:  # beside the disc at an end of a line, to this distance from it
        return beside_disc(deep, a, radius) - beside_disc(min(max(below, 0.0), deep), a, radius)

    near = left(b, covered - places[-1]) + (0.0 if outside else left(b))
    far = 2 * left(b)
    for k, (one, other) in enumerate(pairwise(places if length > 2 * radius else ())):
        half, middle = (other - one) / 2, (one + other) / 2
        if k % 2:  # joined at the near end
            far += 2 * left(half)
        else:
            near += left(half, covered - one) + left(min(half, max(0.0, other - max(covered, middle))))
    return near + far


def left_by(clearing: Clearing, material: Region | None = None) -> float:
    """The area that the passes of a clearing leave of all that the tool could reach, or of some material in its reach.

    Slivers of a thousandth of R do not count.
    """
    from mnclab.geometry.sweeps import covered, left_over, polygons

    radius, ways = clearing.radius, list(clearing.passes)
    for piece in clearing.pieces:
        for joined, (a, b) in zip(piece.linked, pairwise(piece.passes), strict=True):
            if joined:
                ways.append(Contour([end(a), begin(b)], closed=False))
    reach = polygons(clearing.centres.offset(radius) if material is None else material)
    return left_over(reach, covered(ways, radius), radius * 1e-3).area
