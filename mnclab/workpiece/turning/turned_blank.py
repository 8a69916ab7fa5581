"""A body that was turned, or is to be, as the blank of what comes next: any half section about an axis along Z."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from mnclab.geometry.contours import Contour
from mnclab.workpiece.blank import CORNERS, Array
from mnclab.workpiece.turning import revolved
from mnclab.workpiece.workpiece import Solid

CHORD_ERROR = 0.01  # mm, of arcs in a picture
AXIS = 1e-9  # mm: what lies nearer lies on the axis


class TurnedBlank(NamedTuple):
    """`section`: closed contours (z, r), mm, outer ones counter-clockwise, holes clockwise. `axis`: x and y of the axis.

    What asks for its sides from above (a mill) sees no grooves: between the lower and the upper side it counts as full.
    """

    section: tuple[Contour, ...]
    axis: tuple[float, float] = (0.0, 0.0)

    def __repr__(self) -> str:
        (_, _, low), (_, _, high) = self.bounds.tolist()
        widest = max(float(loop.bounds[1, 1]) for loop in self.section)
        return f"<TurnedBlank: diameter {2 * widest:g}, Z {low:g} to {high:g}, {self.volume:.3f} mm³>"

    @property
    def axis_x(self) -> float:
        """Where the axis of the spindle stands in x, mm."""
        return self.axis[0]

    def half_section(self) -> tuple[tuple[Contour, ...], float]:
        """What a lathe asks for: the contours (z, r) and where the axis stands in x, mm."""
        return self.section, self.axis_x

    @property
    def bounds(self) -> Array:
        """The corners with the least and the greatest coordinates (2, 3)."""
        boxes = np.array([loop.bounds for loop in self.section])
        (low, _), (high, wide) = boxes[:, 0].min(axis=0).tolist(), boxes[:, 1].max(axis=0).tolist()
        x, y = self.axis
        return np.array([(x - wide, y - wide, low), (x + wide, y + wide, high)])

    @property
    def volume(self) -> float:
        """mm³, by Pappus."""
        return revolved.volume(self.section)

    def faces(self, x: Array, y: Array) -> tuple[Array, Array]:
        """How low and how high it reaches at points (m,); nan beside it."""
        return revolved.ends_at(self.section, np.hypot(x - self.axis[0], y - self.axis[1]))

    def moved(self, by: ArrayLike) -> TurnedBlank:
        """The same elsewhere."""
        dx, dy, dz = np.asarray(by, dtype=np.float64).tolist()
        section = tuple(Contour(loop.points + (dz, 0.0), loop.bulge) for loop in self.section)
        return TurnedBlank(section, (self.axis[0] + dx, self.axis[1] + dy))

    def outline(self, right: int, up: int) -> list[Array]:
        """What a view along an axis shows, the bore with it: closed lines (k, 2) in the coordinates `right` and `up`."""
        x, y = self.axis
        middle = np.array([x, y, 0.0])[[right, up]]
        if 2 not in (right, up):
            turn = np.linspace(0, 2 * np.pi, CORNERS + 1)
            radii = {float(loop.points[:, 1].max()) for loop in self.section}
            radii |= {float(loop.points[:, 1].min()) for loop in self.section if loop.area > 0}
            ring = np.stack([np.cos(turn), np.sin(turn)], axis=1)
            return [middle + radius * ring for radius in sorted(radii, reverse=True) if radius > AXIS]
        lines = [loop.points_within(CHORD_ERROR) for loop in revolved.both_halves(self.section)]
        return [middle + (line if right == 2 else line[:, ::-1]) for line in lines]

    def edges(self) -> list[Array]:
        """The edges that go round and four lines along the surface, each (k, 3)."""
        turn = np.linspace(0, 2 * np.pi, CORNERS + 1)
        quarters = np.pi / 2 * np.arange(4)
        found = []
        for loop in self.section:
            line = loop.points_within(CHORD_ERROR)
            rims = loop.points[(np.abs(loop.turns()) > 1e-6) & (loop.points[:, 1] > AXIS)]
            found += [self._points(float(rim[1]), turn, float(rim[0])) for rim in rims]
            found += [self._points(line[:, 1], float(quarter), line[:, 0]) for quarter in quarters]
        return found

    def solid(self) -> Solid:
        """Its closed surface; no row cut it."""
        found = revolved.solid(self.section, [np.full(len(loop.points), -1) for loop in self.section], self.axis_x)
        return found._replace(points=found.points + (0.0, self.axis[1], 0.0))

    def _points(self, radius: Array | float, turn: Array | float, z: Array | float) -> Array:
        """Points (k, 3) at radii and angles about the axis and heights."""
        x, y = self.axis[0] + radius * np.cos(turn), self.axis[1] + radius * np.sin(turn)
        return np.stack(np.broadcast_arrays(x, y, z), axis=1)
