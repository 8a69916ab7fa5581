"""Pictures of what was touched: a figure as it should be and as it was found, for `Sketch`."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from mnclab.geometry.contours import Contour
from mnclab.geometry.curves import turned
from mnclab.machining.probing.found import Circle, Floats, Rectangle, Width
from mnclab.machining.steps import Sketch

Figure = Circle | Rectangle | Width | Sequence[Any] | Floats
TINY = 1e-6  # mm, that a figure without a size is drawn with


def sketch(nominal: Figure, actual: Figure, height: float, contacts: Sequence[Any] = (), direction: float = 0.0) -> Sketch:
    """Two figures at a height; `direction` (degrees) is that of a width, the contacts belong to the second."""
    return Sketch(outline(nominal, direction), outline(actual, direction), height, tuple(each.number for each in contacts))


def outline(figure: Figure, direction: float = 0.0) -> Contour:
    """The contour of a figure: of a width the way from wall to wall, of points (n, 2 or more) the lines between them."""
    match figure:
        case Circle():
            return Contour.circle(figure.centre, max(figure.radius, TINY))
        case Rectangle():
            half = np.maximum((figure.length, figure.width), TINY) / 2
            corners = half * [(1, 1), (-1, 1), (-1, -1), (1, -1)]
            return Contour(turned(corners, np.radians(figure.angle)) + figure.centre)
        case Width():
            ends = np.array([(-1.0, 0.0), (1.0, 0.0)]) * max(figure.width, TINY) / 2
            return Contour(turned(ends, np.radians(direction)) + figure.centre, closed=False)
        case _:
            return Contour([point[:2] for point in figure], closed=False)
