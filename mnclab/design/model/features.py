"""Features of a milled part, as its drawing has them: each with its sizes, and with what it takes away of the blank.

Positions and heights are those of the toolpath, mm. Depths count from the top of the blank, or from the height `top`. All
features take `name` (what drawing and tables call it) and `tolerances`: the name of a measure and ± mm, two deviations or
a class of ISO 286, `{"diameter": "H7", "depth": 0.1}`.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any, Self

from mnclab.design.model.chamfers import Chamfer
from mnclab.design.model.feature import BESIDE, EXAMPLE, Feature, Site, area_of, check_positive, take_shape
from mnclab.design.model.holes import Hole
from mnclab.design.model.measures import Measure
from mnclab.design.model.removals import Flat, Removal
from mnclab.design.model.shapes import Circle, Rectangle, shape_of
from mnclab.design.model.slopes import Slope
from mnclab.geometry import contours
from mnclab.geometry.contours import Contour
from mnclab.geometry.regions import Region
from mnclab.text.alarm import Alarm
from mnclab.text.given import check_point, faults_as_alarms, shown

__all__ = [
    "EXAMPLE", "FEATURES", "Chamfer", "Face", "Feature", "Groove", "Hole", "Pocket", "Site", "Slope", "Slot", "Stud", "area_of",
]  # fmt: skip


@dataclass(frozen=True, repr=False)
class Face(Feature):
    """The whole top, `depth` below it."""

    kind = "face"
    depth: float

    def _check(self) -> None:
        check_positive(self, "depth")

    def _measures(self) -> Iterator[Measure]:
        yield Measure("depth", self.depth, "depth")

    def removals(self, site: Site) -> Iterator[Removal]:
        yield Flat(site.around, self.from_top(site) - self.depth)

    def moved(self, dx: float, dy: float, dz: float) -> Self:
        return replace(self, **self.raised(dz))


@dataclass(frozen=True, repr=False)
class _Outlined(Feature):
    """Something within, or around, a closed contour: a shape, a `Contour` or points (x, y)."""

    contour: Any
    depth: float

    @classmethod
    def rectangle(
        cls, x: float, y: float, length: float, width: float, depth: float, corner: float = 0.0, turned: float = 0.0,
        **more: Any,
    ) -> Self:  # fmt: skip
        """About (x, y), `length` along X, `width` along Y, mm; `corner` a radius, `turned` degrees."""
        return cls(Rectangle(x, y, length, width, corner, turned), depth, **more)

    @classmethod
    def circle(cls, x: float, y: float, diameter: float, depth: float, **more: Any) -> Self:
        """About (x, y), mm."""
        return cls(Circle(x, y, diameter), depth, **more)

    def _check(self) -> None:
        check_positive(self, "depth")
        take_shape(self)
        self.area  # noqa: B018  it must exist

    @cached_property
    def area(self) -> Region:
        return area_of(self.contour, f"the contour of a {self.kind}")

    def _measures(self) -> Iterator[Measure]:
        yield from self.contour.measures()
        yield Measure("depth", self.depth, "depth")

    def moved(self, dx: float, dy: float, dz: float) -> Self:
        return replace(self, contour=self.contour.moved(dx, dy), **self.raised(dz))


@dataclass(frozen=True, repr=False)
class Pocket(_Outlined):
    """All within a contour, down to `depth`; `islands` are contours that stay. A `Stud` of the same depth in it is one."""

    kind = "pocket"
    islands: tuple[Any, ...] = ()

    def _check(self) -> None:
        super()._check()
        if not isinstance(self.islands, tuple | list):
            raise Alarm(f"the islands of a pocket are contours, got {shown(self.islands)}")
        found = tuple(shape_of(each, "an island of a pocket") for each in self.islands)
        object.__setattr__(self, "islands", found)

    def removals(self, site: Site) -> Iterator[Removal]:
        region = self.area
        for each in self.islands:
            region = region.difference(area_of(each, "an island of a pocket"))
        yield Flat(region, self.from_top(site) - self.depth)

    def moved(self, dx: float, dy: float, dz: float) -> Self:
        islands = tuple(each.moved(dx, dy) for each in self.islands)
        return replace(super().moved(dx, dy, dz), islands=islands)


@dataclass(frozen=True, repr=False)
class Stud(_Outlined):
    """All around a contour, down to `depth`, over the whole blank; studs of one top and depth stand side by side."""

    kind = "stud"

    def removals(self, site: Site) -> Iterator[Removal]:
        yield Flat(site.around.difference(self.area), self.from_top(site) - self.depth)


@dataclass(frozen=True, repr=False)
class Slot(Feature):
    """A straight slot with round ends: `start` and `end` (x, y) are the centres of these, mm."""

    kind = "slot"
    start: tuple[float, float]
    end: tuple[float, float]
    width: float
    depth: float

    def _check(self) -> None:
        for name in ("start", "end"):
            check_point(getattr(self, name), f"the {name} of a slot (mm)", flat=True)
            object.__setattr__(self, name, tuple(float(each) for each in getattr(self, name)))
        check_positive(self, "width", "depth")
        if math.dist(self.start, self.end) <= BESIDE:
            raise Alarm(f"the start and the end of a slot are two places, got {shown(self.start)} twice", hint="Pocket.circle")

    @property
    def outline(self) -> Contour:
        return contours.slot(Contour([self.start, self.end], closed=False), self.width)

    def _measures(self) -> Iterator[Measure]:
        (x0, y0), (x1, y1) = self.start, self.end
        yield Measure("length", math.dist(self.start, self.end))
        yield Measure("width", self.width)
        if (turned := math.degrees(math.atan2(y1 - y0, x1 - x0)) % 180) > 1e-9:
            yield Measure("angle", turned, "angle")
        yield Measure("x", (x0 + x1) / 2, "place")
        yield Measure("y", (y0 + y1) / 2, "place")
        yield Measure("depth", self.depth, "depth")

    def removals(self, site: Site) -> Iterator[Removal]:
        yield Flat(Region.of(self.outline), self.from_top(site) - self.depth)

    def moved(self, dx: float, dy: float, dz: float) -> Self:
        start, end = ((x + dx, y + dy) for x, y in (self.start, self.end))
        return replace(self, start=start, end=end, **self.raised(dz))


@dataclass(frozen=True, repr=False)
class Groove(Feature):
    """What a tool of a `width` leaves along a contour, open or closed, the middle of the groove."""

    kind = "groove"
    contour: Any
    width: float
    depth: float

    def _check(self) -> None:
        take_shape(self, closed=None)
        check_positive(self, "width", "depth")
        self.area  # noqa: B018  it must exist

    @cached_property
    def area(self) -> Region:
        """All within half the width of the contour."""
        line, half = self.contour.contour, self.width / 2
        if not line.closed:
            pieces = []
            for start, end, bulge in zip(line.starts, line.ends, line.bulge):
                with faults_as_alarms():
                    pieces.append(contours.slot(Contour([start, end], [bulge, 0.0], closed=False), self.width))
            return Region.union_of(*pieces)
        whole = area_of(self.contour, "the contour of a groove")
        return whole.offset(half).difference(whole.inset(half))

    def _measures(self) -> Iterator[Measure]:
        yield Measure("width", self.width)
        yield from (each._replace(name=along(each.name)) for each in self.contour.measures())
        yield Measure("depth", self.depth, "depth")

    def removals(self, site: Site) -> Iterator[Removal]:
        yield Flat(self.area, self.from_top(site) - self.depth)

    def moved(self, dx: float, dy: float, dz: float) -> Self:
        return replace(self, contour=self.contour.moved(dx, dy), **self.raised(dz))


def along(name: str) -> str:
    """What a measure of the outline that a groove goes along is called: its sizes are not those of the groove."""
    return f"outline {name}" if name in ("length", "width") else name


FEATURES: dict[str, type[Feature]] = {each.kind: each for each in (Face, Pocket, Stud, Slot, Groove, Hole, Chamfer, Slope)}
