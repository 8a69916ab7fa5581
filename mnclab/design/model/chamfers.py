"""Edges broken by a chamfer."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import Any, Self

import numpy as np

from mnclab.design.model.feature import BESIDE, Feature, Site, area_of, check_positive, take_shape
from mnclab.design.model.measures import Measure
from mnclab.design.model.removals import Removal, Slanting
from mnclab.text.alarm import Alarm
from mnclab.text.given import check_number, shown


@dataclass(frozen=True, repr=False)
class Chamfer(Feature):
    """The edge along a contour broken by `width` in the plane, with a tool of an included `angle`, degrees.

    On which side of the contour the material stands is found in the design, or said: `inside` True or False.
    """

    kind = "chamfer"
    contour: Any
    width: float
    angle: float = 90.0
    inside: bool | None = None

    def _check(self) -> None:
        take_shape(self)
        check_positive(self, "width")
        check_number(self.angle, "the included angle of the tool of a chamfer (degrees)", at_least=1, at_most=179)
        if self.inside is not None and not isinstance(self.inside, bool):
            raise Alarm(f"inside of a chamfer must be True, False or None, got {shown(self.inside)}")

    @property
    def height(self) -> float:
        """How far the edge goes down, mm."""
        return self.width / math.tan(math.radians(self.angle / 2))

    def _measures(self) -> Iterator[Measure]:
        yield Measure("width", self.width, "chamfer")
        if self.angle != 90:
            yield Measure("angle", 90 - self.angle / 2, "angle")

    def removals(self, site: Site) -> Iterator[Removal]:
        top, area = self.from_top(site), area_of(self.contour, "the contour of a chamfer")
        inside = self._side(site, top - self.height / 2) if self.inside is None else self.inside
        yield (slant := Slanting(area, 0.0, self.width, top - self.height, top, inside))
        yield slant.sky

    def _side(self, site: Site, z: float) -> bool:
        line = self.contour.contour
        spots, ahead = line.point_at(np.cumsum(line.lengths) - line.lengths / 2)
        aside = np.stack([-ahead[:, 1], ahead[:, 0]], axis=1) * (BESIDE if line.area > 0 else -BESIDE)
        stands = [site.outline.contains(spots + side * aside) for side in (1, -1)]
        for flat in site.flats:
            if flat.reaches(z):
                stands = [on & ~flat.region.contains(spots + side * aside) for on, side in zip(stands, (1, -1))]
        inside, outside = (int(on.sum()) for on in stands)
        if inside == outside:
            known = "on both sides of it" if inside else "neither inside nor outside of it"
            raise Alarm(f"a chamfer stands on an edge: material is {known}", hint="give the contour of the edge, or inside=True")
        return inside > outside

    def moved(self, dx: float, dy: float, dz: float) -> Self:
        return replace(self, contour=self.contour.moved(dx, dy), **self.raised(dz))
