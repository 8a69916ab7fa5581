"""A half section while features take away of it: what a feature asks of the body that it is cut into."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from mnclab.geometry.contours import Contour
from mnclab.geometry.curves import Floats
from mnclab.geometry.regions import Region
from mnclab.text.alarm import Alarm
from mnclab.workpiece.turning import revolved

BEYOND = 1.0  # mm, by which what is taken away sticks out of the part
SAME = 1e-7  # mm, within which two places are one
BESIDE = 1e-6  # mm, beside an edge, where the wall is measured
NOTHING = 1e-7  # mm², less is none


class TurnedBody(NamedTuple):
    """The material (z, r), mm."""

    section: Region

    @property
    def low(self) -> float:
        return self._bounds[0]

    @property
    def high(self) -> float:
        return self._bounds[1]

    @property
    def radius(self) -> float:
        """The largest one."""
        return self._bounds[2]

    @property
    def _bounds(self) -> tuple[float, float, float]:
        boxes = np.array([loop.bounds for loop in self.section.loops])
        return float(boxes[:, 0, 0].min()), float(boxes[:, 1, 0].max()), float(boxes[:, 1, 1].max())

    def mirrored(self) -> TurnedBody:
        """The same with z reversed: its back end is the front."""
        loops = (Contour(loop.points * (-1, 1), -loop.bulge).reversed() for loop in self.section.loops)
        return TurnedBody(Region(tuple(loops)))

    def ends_at(self, radius: float) -> tuple[float, float]:
        """The lowest and the highest z of the material at a radius; nan where there is none."""
        low, high = revolved.ends_at(self.section.loops, np.array([radius]))
        return float(low[0]), float(high[0])

    def outer(self, z: Floats) -> Floats:
        """The radius of the outside at places; 0 where there is none."""
        return np.array([radii[-1] if len(radii) else 0.0 for radii in revolved.radii_at(self.section.loops, z)])

    def inner(self, z: Floats) -> Floats:
        """The radius of the bore at places; 0 where there is none."""
        return np.array([radii[0] if len(radii) else 0.0 for radii in revolved.radii_at(self.section.loops, z)])

    def check_within(self, front: float, back: float, ends: bool = True) -> None:
        """An Alarm unless the part reaches from one place to the other; without its `ends` it must reach beyond."""
        low, high, room = self.low, self.high, SAME if ends else -SAME
        if front > high + room or back < low - room:
            told = "it must lie within the part" if ends else "it must lie between the ends of the part"
            raise Alarm(f"{told}, Z {high:g} to {low:g}, got {front:g} to {back:g}")

    def walls(self, front: float, back: float, inside: bool) -> tuple[float, float]:
        """The radius of the surface just within two places, from the outside or in the bore."""
        found = (self.inner if inside else self.outer)(np.array([front - BESIDE, back + BESIDE])).tolist()
        if inside and min(found) < SAME:
            raise Alarm(f"there is no bore from Z {front:g} to {back:g}")
        return found[0], found[1]

    def places(self, front: float, back: float) -> Floats:
        """The middles (n,) and lengths (n,) of the stretches between corners from one place to another, (2, n)."""
        corners = np.concatenate([loop.points[:, 0] for loop in self.section.loops])
        inside = corners[(corners > back + SAME) & (corners < front - SAME)]
        cuts = np.unique(np.concatenate([[back, front], inside]).round(9))
        return np.stack([(cuts[1:] + cuts[:-1]) / 2, np.diff(cuts)])

    def without(self, cut: Contour) -> TurnedBody:
        """What is left; an Alarm where nothing is taken away, or more than a feature may."""
        rest = TurnedBody(self.section.difference(Region((cut,))))
        if self.section.area - rest.section.area < NOTHING:
            raise Alarm("it takes nothing away")
        if not rest.section.loops:
            raise Alarm("it takes the whole part away")
        if len(rest.section.parts) > 1:
            raise Alarm(f"it cuts the part in {len(rest.section.parts)} pieces")
        for name, has, had in (("front", rest.high, self.high), ("back", rest.low, self.low)):
            if abs(has - had) > SAME:
                raise Alarm(f"it takes away the {name} end, Z {had:g} becomes {has:g}", hint="give the profile that end")
        return rest
