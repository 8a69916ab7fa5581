"""How a machine runs what strategies return: contours and descents, arcs as arcs."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from mnclab.geometry.contours import Contour
from mnclab.machine.machine import Machine


def follow(
    m: Machine, contour: Contour, feed: float | None, heights: Sequence[float] | np.ndarray | None = None
) -> None:
    """Run along a contour at a feed (None: the modal one) from where it begins: the tool must be there.

    `heights` are the tool-axis coordinates of its n points, or none for a level contour. A circle of two halves is one
    full circle.
    """
    ends, sweeps, centres = contour.ends.tolist(), contour.sweeps.tolist(), contour.centres.tolist()
    if contour.closed and len(ends) == 2 and np.array_equal(np.abs(contour.bulge), [1.0, 1.0]):
        ends, sweeps, centres = ends[1:], sweeps[1:], centres[1:]
    for k, ((x, y), sweep, (cx, cy)) in enumerate(zip(ends, sweeps, centres, strict=True)):
        z = None if heights is None else float(heights[(k + 1) % len(heights)])
        if sweep:
            m.arc(x, y, z, sense=1 if sweep > 0 else -1, centre={0: cx, 1: cy}, f=feed)
        else:
            m.line(x, y, z, f=feed)
