"""Floors that fall: a rectangle whose floor is a plane, deeper at one end than at the other."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Self

from mnclab.design.model.feature import Feature, Site
from mnclab.design.model.measures import Measure
from mnclab.design.model.removals import Removal, Wedge
from mnclab.design.model.shapes import LARGEST, Rectangle
from mnclab.text.alarm import Alarm
from mnclab.text.given import check_number

SAME = 1e-6  # mm, of two depths that make no slope
LEAST = 1e-3  # mm, long and wide


@dataclass(frozen=True, repr=False)
class Slope(Feature):
    """A rectangle about (x, y), `length` along X, `width` along Y, the whole `turned` by degrees, with a plane floor that
    goes from `start_depth` at its end of least X to `end_depth` at the other, mm.
    """

    kind = "slope"
    x: float
    y: float
    length: float
    width: float
    start_depth: float
    end_depth: float
    turned: float = 0.0

    def _check(self) -> None:
        for name in ("length", "width"):
            check_number(getattr(self, name), f"the {name} of a slope (mm)", at_least=LEAST, at_most=LARGEST)
        self.contour  # noqa: B018  it must exist
        for name in ("start_depth", "end_depth"):
            check_number(getattr(self, name), f"the {name} of a slope (mm)", at_least=0, at_most=LARGEST)
        if abs(self.start_depth - self.end_depth) <= SAME:
            raise Alarm(f"the depths of a slope must differ, got {self.start_depth:g} at both ends", hint="Pocket.rectangle")

    @cached_property
    def contour(self) -> Rectangle:
        """Its outline."""
        return Rectangle(self.x, self.y, self.length, self.width, 0.0, self.turned)

    def _measures(self) -> Iterator[Measure]:
        yield from self.contour.measures()
        yield Measure("start depth", self.start_depth, "depth")
        yield Measure("end depth", self.end_depth, "depth")

    def removals(self, site: Site) -> Iterator[Removal]:
        top, turned = self.from_top(site), math.radians(self.turned)
        falls = self.end_depth > self.start_depth
        sense = -1.0 if falls else 1.0  # from the deep end to the other
        c, s = sense * math.cos(turned), sense * math.sin(turned)
        start = self.x - c * self.length / 2, self.y - s * self.length / 2
        depths = max(self.start_depth, self.end_depth), min(self.start_depth, self.end_depth)
        yield (wedge := Wedge(start, (c, s), self.length, self.width, top - depths[0], top - depths[1]))
        yield wedge.sky

    def moved(self, dx: float, dy: float, dz: float) -> Self:
        return replace(self, x=self.x + dx, y=self.y + dy, **self.raised(dz))
