"""Features of a milled part, as its drawing has them: each with its sizes, and with what it takes away of the blank.

Positions and heights are those of the toolpath, mm. Depths count from the top of the blank, or from the height `top`. All
features take `name` (what drawing and tables call it) and `tolerances`: the name of a measure and ± mm, two deviations or
a class of ISO 286, `{"diameter": "H7", "depth": 0.1}`.
"""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, fields, replace
from typing import Any, ClassVar, NamedTuple, Self

import numpy as np

from mnclab.geometry import shapes
from mnclab.geometry.contours import Contour
from mnclab.geometry.regions import Region
from mnclab.text.alarm import Alarm
from mnclab.text.given import check_number, check_point, faults_as_alarms, plain, shown
from mnclab.text.records import exactly
from mnclab.workpiece.design.measures import Measure, Tolerance, with_tolerances
from mnclab.workpiece.design.removals import Flat, Removal, Slanting
from mnclab.workpiece.design.shapes import Circle, Outline, Rectangle, Shape, shape_of
from mnclab.workpiece.design.threads import core_of

BEYOND = 1.0  # mm, by which what goes through goes beyond the lower side
BESIDE = 1e-3  # mm, beside an edge, where material is looked for


class Site(NamedTuple):
    """Where a feature stands: the blank from above, all about it, and the heights of its sides, mm.

    `flats` are what the other features take away, of which a chamfer is told on which side of its edge the material is.
    """

    outline: Region
    around: Region
    top: float
    bottom: float
    flats: tuple[Flat, ...] = ()


@dataclass(frozen=True, repr=False, kw_only=True)
class Feature(ABC):
    """What all features share; `kind` is its name in files."""

    kind: ClassVar[str]

    top: float | None = None
    name: str = ""
    tolerances: Mapping[str, Tolerance] = field(default_factory=dict, hash=False)

    def __post_init__(self) -> None:
        if self.top is not None:
            check_number(self.top, f"the top of a {self.kind} (mm)")
        if not isinstance(self.name, str):
            raise Alarm(f"the name of a {self.kind} must be a text, got {shown(self.name)}")
        if not isinstance(self.tolerances, Mapping):
            raise Alarm(f"tolerances of a {self.kind} are names and values, got {shown(self.tolerances)}", hint=EXAMPLE)
        given = {name: tuple(each) if isinstance(each, list) else each for name, each in self.tolerances.items()}
        object.__setattr__(self, "tolerances", given)
        for each in fields(self):
            object.__setattr__(self, each.name, plain(getattr(self, each.name)))
        self._check()
        self.measures()

    def __repr__(self) -> str:
        return exactly(self)

    @abstractmethod
    def _check(self) -> None:
        """Raises an Alarm for sizes that cannot be."""

    @abstractmethod
    def _measures(self) -> Iterator[Measure]: ...

    @abstractmethod
    def removals(self, site: Site) -> Iterator[Removal]:
        """What it takes away."""

    @abstractmethod
    def moved(self, dx: float, dy: float, dz: float) -> Self:
        """The same elsewhere; what counts from the top of the blank still does."""

    def measures(self) -> tuple[Measure, ...]:
        """What a drawing says of it and a measuring room measures, with its tolerances."""
        found = list(self._measures())
        if self.top is not None:
            found.append(Measure("top", self.top, "place"))
        return with_tolerances(found, self.tolerances, f"a {self.kind}" if not self.name else self.name)

    def _from(self, site: Site) -> float:
        return site.top if self.top is None else self.top

    def _raised(self, dz: float) -> dict[str, Any]:
        return {} if self.top is None else {"top": self.top + dz}


EXAMPLE = 'tolerances={"depth": 0.1}'


def _positive(feature: Feature, *names: str) -> None:
    for name in names:
        check_number(getattr(feature, name), f"the {name} of a {feature.kind} (mm)", above=0)


def _shaped(feature: Feature, closed: bool | None = True, name: str = "contour") -> None:
    """Puts a shape in the place of whatever was given for it."""
    found = shape_of(getattr(feature, name), f"the {name} of a {feature.kind}", closed)
    object.__setattr__(feature, name, found)


def area_of(shape: Shape, what: str) -> Region:
    """What lies within a closed shape."""
    try:
        with faults_as_alarms():
            return Region.of(shape.contour)
    except Alarm as fault:
        raise Alarm(f"{what}: {fault.message}") from None


@dataclass(frozen=True, repr=False)
class Face(Feature):
    """The whole top, `depth` below it."""

    kind = "face"
    depth: float

    def _check(self) -> None:
        _positive(self, "depth")

    def _measures(self) -> Iterator[Measure]:
        yield Measure("depth", self.depth, "depth")

    def removals(self, site: Site) -> Iterator[Removal]:
        yield Flat(site.around, self._from(site) - self.depth)

    def moved(self, dx: float, dy: float, dz: float) -> Self:
        return replace(self, **self._raised(dz))


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
        _positive(self, "depth")
        _shaped(self)
        self.area  # noqa: B018  it must exist

    @property
    def area(self) -> Region:
        return area_of(self.contour, f"the contour of a {self.kind}")

    def _measures(self) -> Iterator[Measure]:
        yield from self.contour.measures()
        yield Measure("depth", self.depth, "depth")

    def moved(self, dx: float, dy: float, dz: float) -> Self:
        return replace(self, contour=self.contour.moved(dx, dy), **self._raised(dz))


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
        yield Flat(region, self._from(site) - self.depth)

    def moved(self, dx: float, dy: float, dz: float) -> Self:
        islands = tuple(each.moved(dx, dy) for each in self.islands)
        return replace(super().moved(dx, dy, dz), islands=islands)


@dataclass(frozen=True, repr=False)
class Stud(_Outlined):
    """All around a contour, down to `depth`, over the whole blank; studs of one top and depth stand side by side."""

    kind = "stud"

    def removals(self, site: Site) -> Iterator[Removal]:
        yield Flat(site.around.difference(self.area), self._from(site) - self.depth)


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
        _positive(self, "width", "depth")
        if math.dist(self.start, self.end) <= BESIDE:
            raise Alarm(f"the start and the end of a slot are two places, got {shown(self.start)} twice", hint="Pocket.circle")

    @property
    def outline(self) -> Contour:
        return shapes.slot(Contour([self.start, self.end], closed=False), self.width)

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
        yield Flat(Region.of(self.outline), self._from(site) - self.depth)

    def moved(self, dx: float, dy: float, dz: float) -> Self:
        start, end = ((x + dx, y + dy) for x, y in (self.start, self.end))
        return replace(self, start=start, end=end, **self._raised(dz))


@dataclass(frozen=True, repr=False)
class Groove(Feature):
    """What a tool of a `width` leaves along a contour, open or closed, the middle of the groove."""

    kind = "groove"
    contour: Any
    width: float
    depth: float

    def _check(self) -> None:
        _shaped(self, closed=None)
        _positive(self, "width", "depth")
        self.area  # noqa: B018  it must exist

    @property
    def area(self) -> Region:
        """All within half the width of the contour."""
        line, half = self.contour.contour, self.width / 2
        if not self.contour.closed if isinstance(self.contour, Outline) else False:
            found = Region(())
            for start, end, bulge in zip(line.starts, line.ends, line.bulge):
                with faults_as_alarms():
                    piece = shapes.slot(Contour([start, end], [bulge, 0.0], closed=False), self.width)
                found = found.union(Region.of(piece)) if found.loops else Region.of(piece)
            return found
        whole = area_of(self.contour, "the contour of a groove")
        return whole.offset(half).difference(whole.inset(half))

    def _measures(self) -> Iterator[Measure]:
        yield Measure("width", self.width)
        yield from self.contour.measures()
        yield Measure("depth", self.depth, "depth")

    def removals(self, site: Site) -> Iterator[Removal]:
        yield Flat(self.area, self._from(site) - self.depth)

    def moved(self, dx: float, dy: float, dz: float) -> Self:
        return replace(self, contour=self.contour.moved(dx, dy), **self._raised(dz))


@dataclass(frozen=True, repr=False)
class Hole(Feature):
    """A hole about (x, y). `depth` is that of the cylinder, to its shoulder; the point comes on top; None: through.

    `point` is the included angle of the bottom, degrees, 180 for a flat one. `counterbore` (diameter, depth);
    `countersink` (diameter, included angle). `thread` is a designation ("M8", "M8x1"), `thread_depth` how far it goes
    (None: as deep as the hole); the hole then is that for the tap: `diameter` may be None, and is the nominal
    diameter less the pitch.
    """

    kind = "hole"
    x: float
    y: float
    diameter: float | None
    depth: float | None = None
    point: float = 118.0
    counterbore: tuple[float, float] | None = None
    countersink: tuple[float, float] | None = None
    thread: str = ""
    thread_depth: float | None = None

    def _check(self) -> None:
        for name in ("x", "y"):
            check_number(getattr(self, name), f"the {name} of a hole (mm)")
        if self.diameter is None and self.thread:
            object.__setattr__(self, "diameter", core_of(self.thread))
        _positive(self, "diameter", *([] if self.depth is None else ["depth"]))
        check_number(self.point, "the point of a hole (degrees)", above=0, at_most=180)
        for name, second, most in (("counterbore", "depth (mm)", None), ("countersink", "angle (degrees)", 179.0)):
            given = getattr(self, name)
            if given is None:
                continue
            if not isinstance(given, tuple | list) or len(given) != 2:
                raise Alarm(f"the {name} of a hole must be its diameter (mm) and {second}, got {shown(given)}")
            check_number(given[0], f"the diameter of a {name} (mm)", above=self.wide)
            check_number(given[1], f"the {second} of a {name}", above=0, at_most=most)
            object.__setattr__(self, name, tuple(float(each) for each in given))
        if self.counterbore and self.depth is not None and self.counterbore[1] >= self.depth:
            raise Alarm(f"a counterbore must be less deep than its hole, {self.depth:g}, got {self.counterbore[1]:g}")
        if self.thread and core_of(self.thread) <= 0:
            raise Alarm(f"the thread {self.thread} leaves no core")
        if self.thread_depth is not None:
            _positive(self, "thread_depth")
            if not self.thread:
                raise Alarm("a thread_depth needs a thread", hint='thread="M8"')
            if self.depth is not None and self.thread_depth > self.depth:
                raise Alarm(f"a thread goes at most as deep as its hole, {self.depth:g}, got {self.thread_depth:g}")

    @property
    def wide(self) -> float:
        """The diameter, mm."""
        return float(self.diameter or 0.0)

    @property
    def tip(self) -> float:
        """How far the point goes beyond the shoulder, mm."""
        return 0.0 if self.depth is None else self.wide / 2 / math.tan(math.radians(self.point / 2)) * (self.point < 180)

    def _measures(self) -> Iterator[Measure]:
        if self.thread:
            yield Measure("thread", core_of(self.thread, 0.0), "thread", text=self.thread)
            if self.thread_depth is not None:
                yield Measure("thread depth", self.thread_depth, "depth")
        yield Measure("diameter", self.wide, "diameter")
        if self.depth is not None:
            yield Measure("depth", self.depth, "depth")
        if self.counterbore:
            yield Measure("counterbore diameter", self.counterbore[0], "diameter")
            yield Measure("counterbore depth", self.counterbore[1], "depth")
        if self.countersink:
            yield Measure("countersink diameter", self.countersink[0], "diameter")
            yield Measure("countersink angle", self.countersink[1], "angle")
        if self.depth is not None and self.point != 118:
            yield Measure("point angle", self.point, "angle")
        yield Measure("x", self.x, "place")
        yield Measure("y", self.y, "place")

    def removals(self, site: Site) -> Iterator[Removal]:
        top, centre, r = self._from(site), (float(self.x), float(self.y)), self.wide / 2
        shoulder = site.bottom - BEYOND if self.depth is None else top - self.depth
        yield Flat(Region((Contour.circle(centre, r),)), shoulder)
        if self.tip:
            yield Slanting(centre, 0.0, r, shoulder - self.tip, shoulder)
        if self.counterbore:
            yield Flat(Region((Contour.circle(centre, self.counterbore[0] / 2),)), top - self.counterbore[1])
        if self.countersink:
            out = self.countersink[0] / 2
            seat = top - (self.counterbore[1] if self.counterbore else 0.0)
            deep = seat - (out - r) / math.tan(math.radians(self.countersink[1] / 2))
            yield (cone := Slanting(centre, r, out, deep, seat))
            yield cone.sky

    def moved(self, dx: float, dy: float, dz: float) -> Self:
        return replace(self, x=self.x + dx, y=self.y + dy, **self._raised(dz))


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
        _shaped(self)
        _positive(self, "width")
        check_number(self.angle, "the included angle of the tool of a chamfer (degrees)", above=0, at_most=179)
        if self.inside not in (None, True, False):
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
        top, area = self._from(site), area_of(self.contour, "the contour of a chamfer")
        inside = self._side(site, top - self.height / 2) if self.inside is None else self.inside
        base = site.around.difference(area) if inside else area
        yield (slant := Slanting(base, 0.0, self.width, top - self.height, top))
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
        return replace(self, contour=self.contour.moved(dx, dy), **self._raised(dz))


FEATURES: dict[str, type[Feature]] = {each.kind: each for each in (Face, Pocket, Stud, Slot, Groove, Hole, Chamfer)}
