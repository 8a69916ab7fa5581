"""Insets by taking away bands along the elements: slower than cutting, for loops that touch in too many places to be cut.

The inset by d loses bands of width d along the inner side of every element, and a fan of radius d at each corner that
points inwards. They are made of lines and arcs as well, so that an inset is one more difference. Lengths in mm.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from mnclab.geometry import shapely
from mnclab.geometry.contours import Contour
from mnclab.geometry.tracing import GRID, SAME, SMOOTH, Drawing
from mnclab.geometry.vectors import left


def inset_by_bands(loops: Sequence[Contour], distance: float) -> tuple[Contour, ...]:
    """The loops of a region inset by a distance, or grown by a negative one."""
    faces = loops if distance > 0 else [loop.reversed() for loop in loops]
    bands = [band for face in faces for band in bands_beside(face, abs(distance))]
    drawing = Drawing([*loops, *bands])
    strips = [shapely.Polygon(ring) for ring in drawing.rings[len(loops) :]]
    strip = shapely.union_all(strips, grid_size=GRID)
    change = shapely.difference if distance > 0 else shapely.union
    return drawing.traced(change(drawing.area(loops, 0), strip, grid_size=GRID))


def bands_beside(loop: Contour, width: float) -> Iterator[Contour]:
    """Bands along the left side of each element, and fans where the loop turns to the right."""
    begin, end = loop.tangents()
    first, last = loop.starts + width * left(begin), loop.ends + width * left(end)
    turns, bulge = loop.turns(), loop.bulge
    smooth = np.abs(turns) <= SMOOTH
    first[smooth] = np.roll(last, 1, axis=0)[smooth]  # no gap as wide as a rounding error
    to_centre = np.where(bulge > 0, loop.radii, np.inf)
    for i, (start, stop, centre) in enumerate(zip(loop.starts, loop.ends, loop.centres, strict=True)):
        if to_centre[i] <= width + SAME:
            yield Contour([start, stop, centre], [bulge[i], 0.0, 0.0])
        else:
            yield Contour([start, stop, last[i], first[i]], [bulge[i], 0.0, -bulge[i], 0.0])
        if turns[i] < -SMOOTH:
            yield Contour([start, last[i - 1], first[i]], [0.0, np.tan(turns[i] / 4), 0.0])
