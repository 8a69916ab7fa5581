"""Feeds that count at the cutting edge, for a path of the tool centre. Lengths in mm, feeds in mm/min.

    inside an arc of the wall     F · r / (r + R)        outside of one     F · r / (r - R)

r is the radius of the path, R that of the tool, and r ± R the radius of the wall. On a straight line both are the same.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from mnclab.geometry.contours import Contour
from mnclab.geometry.curves import Floats
from mnclab.machining.steps import Along

SAME = 1e-9


def centre_feeds(contour: Contour, feed: float, radius: float, wall: int) -> Floats:
    """Feeds of the tool centre on the m elements `(m,)`, the wall being on the right of the way (1) or on its left (-1).

    Raises ValueError where the wall turns about a point: no centre is fast enough there.
    """
    path, inside = contour.radii, np.sign(contour.sweeps) * wall
    edge = path + inside * radius
    if (edge <= SAME).any():
        raise ValueError(f"the wall has no radius where a tool of radius {radius:g} goes round it at {path.min():g}")
    with np.errstate(invalid="ignore"):
        return np.where(inside == 0, feed, feed * path / edge)


def along(label: str, contour: Contour, feed: float | None, radius: float = 0.0, wall: int = 1) -> Iterator[Along]:
    """Along a contour; with the `radius` of the tool its feed counts at the edge, and each piece has its own."""
    if not radius or feed is None or not contour.bulge.any():
        yield Along(label, contour, feed)
        return
    feeds = centre_feeds(contour, feed, radius, wall)
    if np.ptp(feeds) <= SAME * feed:
        yield Along(label, contour, float(feeds[0]))
        return
    points = np.vstack([contour.points, contour.points[:1]]) if contour.closed else contour.points
    begins = np.flatnonzero(np.append(True, np.abs(np.diff(feeds)) > SAME * feed))
    for begin, end in zip(begins.tolist(), [*begins[1:].tolist(), len(feeds)], strict=True):
        piece = Contour(points[begin : end + 1], np.append(contour.bulge[begin:end], 0.0), closed=False)
        yield Along(label, piece, float(feeds[begin]))
