"""Features of a milled part, as its drawing has them: each with its sizes, and with what it takes away of the blank.

Positions and heights are those of the toolpath, mm. Depths count from the top of the blank, or from the height `top`. All
features take `name` (what drawing and tables call it) and `tolerances`: the name of a measure and ± mm, two deviations or
a class of ISO 286, `{"diameter": "H7", "depth": 0.1}`.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from typing import Any, Self

import numpy as np

from mnclab.design.model.feature import BESIDE, EXAMPLE, Feature, Site, area_of, check_positive, take_shape
from mnclab.design.model.holes import Hole
from mnclab.design.model.measures import Measure
from mnclab.design.model.removals import Bevel, Flat, Ramp, Removal
from mnclab.design.model.shapes import LARGEST, Circle, Rectangle, shape_of
from mnclab.geometry import contours
from mnclab.geometry.contours import Contour
from mnclab.geometry.regions import Region
from mnclab.text.alarm import Alarm
from mnclab.text.given import check_number, check_point, faults_as_alarms, shown

__all__ = [
    "EXAMPLE", "FEATURES", "Chamfer", "Face", "Feature", "Groove", "Hole", "Pocket", "Site", "Slope", "Slot", "Stud", "area_of",
]  # fmt: skip

SAME = 1e-6  # mm, of two depths that make no slope
LEAST = 1e-3  # mm, a slope is long and wide


@dataclass(frozen=True, repr=False)
class Face(Feature):
    """The whole top, `depth` below it.

    >>> mnc.Design(mnc.box(100, 60, 20), [mnc.design.Face(2)]).volume
    108000.0
    """

    kind = "face"
    depth: float

    def _check(self) -> None:
        check_positive(self, "depth")

    def _measures(self) -> Iterator[Measure]:
        yield Measure("depth", self.depth, "depth")

    def removals(self, site: Site) -> Iterator[Removal]:
        yield Flat(site.around, self.from_top(site) - self.depth)


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


@dataclass(frozen=True, repr=False)
class Pocket(_Outlined):
    """All within a contour, down to `depth`; `islands` are contours that stay. A `Stud` of the same depth in it is one.

    >>> pocket = mnc.design.Pocket(mnc.design.Rectangle(50, 30, 30, 20), depth=10)
    >>> mnc.Design(mnc.box(100, 60, 20), [pocket]).volume
    114000.0
    """

    kind = "pocket"
    recess = True
    islands: tuple[Any, ...] = ()

    def _check(self) -> None:
        super()._check()
        if not isinstance(self.islands, tuple | list):
            raise Alarm(f"the islands of a pocket are contours, got {shown(self.islands)}")
        found = tuple(shape_of(each, "an island of a pocket") for each in self.islands)
        object.__setattr__(self, "islands", found)

    @cached_property
    def region(self) -> Region:
        """All within the contour but the islands."""
        region = self.area
        for each in self.islands:
            region = region.difference(area_of(each, "an island of a pocket"))
        return region

    def removals(self, site: Site) -> Iterator[Removal]:
        yield Flat(self.region, self.from_top(site) - self.depth)


@dataclass(frozen=True, repr=False)
class Stud(_Outlined):
    """All around a contour, down to `depth`, over the whole blank; studs of one top and depth stand side by side.

    >>> stud = mnc.design.Stud(mnc.design.Rectangle(50, 30, 30, 20), depth=10)
    >>> mnc.Design(mnc.box(100, 60, 20), [stud]).volume  # less (100 x 60 - 30 x 20) x 10
    66000.0
    """

    kind = "stud"

    def removals(self, site: Site) -> Iterator[Removal]:
        yield Flat(site.around.difference(self.area), self.from_top(site) - self.depth)


@dataclass(frozen=True, repr=False)
class Slot(Feature):
    """A straight slot with round ends: `start` and `end` (x, y) are the centres of these, mm.

    >>> slot = mnc.design.Slot((20, 30), (40, 30), 10, depth=5)
    >>> print(f"{mnc.Design(mnc.box(100, 60, 20), [slot]).volume:.1f}")  # less (20 x 10 + pi x 5 x 5) x 5
    118607.3
    """

    kind = "slot"
    recess = True
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

    @property
    def region(self) -> Region:
        return Region.of(self.outline)

    def removals(self, site: Site) -> Iterator[Removal]:
        yield Flat(self.region, self.from_top(site) - self.depth)


@dataclass(frozen=True, repr=False)
class Groove(Feature):
    """What a tool of a `width` leaves along a contour, open or closed, the middle of the groove.

    >>> line = mnc.area.Contour([(20, 20), (60, 20)], closed=False)
    >>> groove = mnc.design.Groove(line, 10, depth=5)
    >>> print(f"{mnc.Design(mnc.box(100, 60, 20), [groove]).volume:.1f}")  # less (40 x 10 + pi x 5 x 5) x 5
    117607.3
    """

    kind = "groove"
    recess = True
    contour: Any
    width: float
    depth: float

    def _check(self) -> None:
        take_shape(self, closed=None)
        check_positive(self, "width", "depth")
        self.region  # noqa: B018  it must exist

    @cached_property
    def region(self) -> Region:
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
        yield Flat(self.region, self.from_top(site) - self.depth)


def along(name: str) -> str:
    """What a measure of the outline that a groove goes along is called: its sizes are not those of the groove."""
    return f"outline {name}" if name in ("length", "width") else name


@dataclass(frozen=True, repr=False)
class Slope(Feature):
    """A rectangle about (x, y), `length` along X, `width` along Y, the whole `turned` by degrees, with a plane floor that
    goes from `start_depth` at its end of least X to `end_depth` at the other, mm.

    >>> ramp = mnc.design.Slope(50, 30, 20, 10, start_depth=2, end_depth=4)
    >>> mnc.Design(mnc.box(100, 60, 20), [ramp]).volume  # less 20 x 10 x 3
    119400.0
    """

    kind = "slope"
    recess = True
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
        yield (ramp := Ramp(start, (c, s), self.width, far=self.length, deep=top - depths[0], open=top - depths[1], part="floor"))
        yield ramp.clearance


@dataclass(frozen=True, repr=False)
class Chamfer(Feature):
    """The edge along a contour broken by `width` in the plane, with a tool of an included `angle`, degrees.

    On which side of the contour the material stands is found in the design, or said: `inside` True or False.

    >>> edge = mnc.design.Chamfer(mnc.design.Rectangle(50, 30, 100, 60), 1)
    >>> print(f"{mnc.Design(mnc.box(100, 60, 20), [edge]).volume:.3f}")  # less 320 x 1 / 2, and 4 corners of 1 / 3 more
    119841.333
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
        yield (bevel := Bevel(area, inside, far=self.width, deep=top - self.height, open=top, part="bevel"))
        yield bevel.clearance

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


FEATURES: dict[str, type[Feature]] = {each.kind: each for each in (Face, Pocket, Stud, Slot, Groove, Hole, Chamfer, Slope)}
