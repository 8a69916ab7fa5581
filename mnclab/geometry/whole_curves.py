"""Whole lines and circles, which elements of a contour lie on: where they meet. Lengths in mm."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from mnclab.geometry.vectors import Floats, cross, left, length_of


class Curve(NamedTuple):
    """A whole line (radius inf, through `point` along the unit `direction`), or a circle about `point`."""

    point: Floats
    direction: Floats
    radius: float

    def moved_left(self, distance: float, sweep: float) -> Curve:
        """The curve at a distance to the left of an element on it that turns by `sweep`."""
        if np.isinf(self.radius):
            return Curve(self.point + distance * left(self.direction), self.direction, np.inf)
        return Curve(self.point, self.direction, self.radius - np.sign(sweep) * distance)

    def foot(self, point: Floats) -> Floats:
        """The point of the curve nearest to a point."""
        arm = point - self.point
        if np.isinf(self.radius):
            return self.point + (arm @ self.direction) * self.direction
        return self.point + arm * (self.radius / max(float(length_of(arm)), 1e-300))

    def meeting(self, other: Curve, near: Floats) -> Floats:
        """Where two curves cross, of two crossings the one nearer to `near`; where they touch, if they touch.

        Two circles cross on their radical line, so that only line with line and line with circle remain.
        """
        line, ring = (self, other) if np.isinf(self.radius) else (other, self)
        if np.isinf(ring.radius):
            sine = cross(line.direction, ring.direction)
            if abs(sine) < 1e-9:
                return line.foot(near)
            return line.point + cross(ring.point - line.point, ring.direction) / sine * line.direction
        if np.isfinite(line.radius):
            between = ring.point - line.point
            apart = float(length_of(between))
            if apart < 1e-9:
                return ring.foot(near)
            u = between / apart
            along = (apart**2 + line.radius**2 - ring.radius**2) / (2 * apart)
            line = Curve(line.point + along * u, left(u), np.inf)
        middle = line.foot(ring.point)
        high = float(length_of(middle - ring.point))
        half = np.sqrt(max(ring.radius**2 - high**2, 0.0)) * line.direction
        return min((middle - half, middle + half), key=lambda p: float(length_of(p - near)))
