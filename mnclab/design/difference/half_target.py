"""What a turned part is compared with: a half section, and of a design which feature made a place of it."""

from __future__ import annotations

from collections.abc import Sequence
from functools import cached_property

import numpy as np

from mnclab.design.difference.half_surface import HalfSurface
from mnclab.design.model.turned_design import TurnedDesign
from mnclab.design.model.turned_threads import Thread
from mnclab.geometry.contours import Contour
from mnclab.geometry.regions import Region
from mnclab.path.toolpath import Array, Index, Mask
from mnclab.text.alarm import Alarm

SAME = 1e-6  # mm: a place on what a feature takes away is its
PROFILE = "profile"


class HalfTarget:
    """`section`: closed contours (z, r), mm; `error` mm: how far they may be off. Of a design also its features and `bands`,
    areas in which threads have their teeth: there nothing is judged."""

    def __init__(self, name: str, section: Sequence[Contour], error: float = 0.0, design: TurnedDesign | None = None) -> None:
        if not section:
            raise Alarm(f"{name} has no material to compare with")
        self.name, self.error, self.design = name, error, design
        self.surface = HalfSurface(section)

    @property
    def section(self) -> tuple[Contour, ...]:
        return self.surface.region.loops

    @property
    def ends(self) -> tuple[float, float]:
        """The lowest and the highest z."""
        (low, _), (high, _) = self.surface.region.bounds.tolist()
        return low, high

    @property
    def bounds_3d(self) -> Array:
        """The box (2, 3) of the half section: from the axis out, about x = 0."""
        (low, _), (high, radius) = self.surface.region.bounds.tolist()
        return np.array([(0.0, 0.0, low), (radius, 0.0, high)])

    @cached_property
    def names(self) -> tuple[str, ...]:
        """The profile and the features."""
        return (PROFILE, *self.design.drawn_names()) if self.design else (self.name,)

    @cached_property
    def bands(self) -> list[Region]:
        return [_band(self.design, each) for each in self.design.threads] if self.design else []

    @cached_property
    def core(self) -> HalfSurface:
        """What no tooth of a thread may go below."""
        return HalfSurface(self.surface.region.without(self.bands).loops) if self.bands else self.surface

    def toothed(self, points: Array) -> Mask:
        """Which points (m, 2) lie where a thread has its teeth."""
        found = np.zeros(len(points), dtype=bool)
        for band in self.bands:
            found |= band.contains(points) | (band.distance(points) <= SAME)
        return found

    def owners(self, points: Array) -> Index:
        """Whose face, by the numbers of `names`, is nearest to each of the points (m, 2)."""
        found = np.zeros(len(points), dtype=np.int64)
        if self.design is None or not len(points):
            return found
        feet = self.surface.feet(points)
        for number, cut in enumerate(self._cuts, 1):
            if cut is not None:
                found[cut.distance(feet) <= SAME] = number
        return found

    @cached_property
    def _cuts(self) -> list[Contour | None]:
        """What each feature takes away."""
        if self.design is None:
            return []
        return [each.cut(body) for each, body in zip(self.design.features, self.design.bodies)]

    def allowed(self, owner: int, tolerance: float) -> float:
        """How far faces may be off, mm: the tolerance, or as far as the drawing gives for them."""
        if self.design is None:
            return tolerance
        given = self.design.measures() if owner == 0 else self.design.features[owner - 1].measures()
        wide = [max(map(abs, m.limits)) / (2 if m.kind == "diameter" else 1) for m in given if m.limits and m.kind != "angle"]
        return max([tolerance, *wide])


def _band(design: TurnedDesign, thread: Thread) -> Region:
    """Where a thread has its teeth; half a tooth goes on beyond its ends, where nothing stands in its way."""
    low, high = thread.band
    body, half = design.bodies[-1], thread.pitch / 2
    ends = []
    for place, way in ((thread.start, half), (thread.end, -half)):
        at = np.array([place + way / 2])
        clear = body.outer(at)[0] <= high + SAME if not thread.inside else body.inner(at)[0] >= low - SAME
        ends.append(place + way if clear else place)
    front, back = ends
    return Region((Contour([(back, low), (front, low), (front, high), (back, high)]),))
