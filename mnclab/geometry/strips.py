"""Strips: what lies within a distance of a line of lines and arcs, open or closed. Lengths in mm.

      .----------.       every element has a band on either side of it, every corner a fan on its outer side, and
     (  --------  )      the ends of an open line are round: what a disc sweeps along the line, with exact arcs
      `----------´
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from mnclab.geometry.contours import Contour
from mnclab.geometry.regions import Region
from mnclab.geometry.tracing import SAME, SMOOTH
from mnclab.geometry.vectors import left


def strip(line: Contour, reach: float) -> Region:
    """What lies within `reach` of a line, which may cross itself; a ValueError where `reach` is not greater than 0."""
    if not reach > 0:
        raise ValueError(f"a strip reaches more than 0 to either side of its line, got {reach:g}")
    return Region.union_of(*_pieces(line, reach))


def _pieces(line: Contour, reach: float) -> Iterator[Contour]:
    begins, ends = line.tangents()
    first, last = left(begins), left(ends)
    columns = zip(line.starts, line.ends, line.bulge, line.radii, line.centres, first, last, strict=False)
    for start, stop, bulge, radius, centre, a, b in columns:
        for side in (reach, -reach):
            if bulge * side > 0 and radius <= reach + SAME:
                yield Contour([start, stop, centre], [bulge, 0.0, 0.0])  # nothing is nearer beyond the centre
            else:
                yield Contour([start, stop, stop + side * b, start + side * a], [bulge, 0.0, -bulge, 0.0])
    turns = line.turns()
    for k in np.flatnonzero(np.abs(turns) > SMOOTH).tolist():
        outside = -reach * np.sign(turns[k])
        here = line.points[k]
        yield Contour([here, here + outside * last[k - 1], here + outside * first[k]], [0.0, np.tan(turns[k] / 4), 0.0])
    for place in () if line.closed else line.points[[0, -1]]:
        yield Contour.circle(place, reach)
