"""How a machine runs what strategies return: contours and descents, arcs as arcs."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from mnclab.geometry.contours import Contour
from mnclab.machine.machine import Machine


def follow(
    m: Machine, contour: Contour, feed: float | None, heights: Sequence[float] | np.ndarray | None = None,
    about: tuple[float, float] = (0.0, 0.0),
) -> None:  # fmt: skip
    """Run along a contour at a feed (None: the modal one) from where it begins: the tool must be there.

    `heights` are the tool-axis coordinates of its n points, or none for a level contour; its own coordinates count from
    `about`. A circle of two halves is one full circle.
    """
    elements, (x0, y0) = contour.walk, about
    if contour.closed and len(elements) == 2 and np.array_equal(np.abs(contour.bulge), [1.0, 1.0]):
        elements = elements[1:]
    for k, ((x, y), sweep, (cx, cy)) in enumerate(elements):
        z = None if heights is None else float(heights[(k + 1) % len(heights)])
        if sweep:
            m.arc(x0 + x, y0 + y, z, sense=1 if sweep > 0 else -1, centre={0: x0 + cx, 1: y0 + cy}, f=feed)
        else:
            m.line(x0 + x, y0 + y, z, f=feed)
