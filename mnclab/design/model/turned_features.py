"""The features of a turned part: bores, centre holes and grooves, and all of them by their names in files."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import Self

import numpy as np

from mnclab.design.model.feature import check_flag, check_positive
from mnclab.design.model.measures import Measure
from mnclab.design.model.turned_feature import BEYOND, SAME, FromEnd, Place, TurnedBody, TurnedFeature, given, outline
from mnclab.design.model.turned_threads import Thread, Undercut
from mnclab.geometry.contours import Contour
from mnclab.text.alarm import Alarm
from mnclab.text.given import check_number

__all__ = [
    "CENTRES", "TURNED_FEATURES", "Bore", "CentreHole", "FaceGroove", "RingGroove", "Thread", "TurnedFeature", "Undercut",
]  # fmt: skip

LEAST = 1e-3  # mm: how far a chamfer sticks out of the face that it breaks
#: DIN 332-1, ISO 6411 form A: the diameter of the pilot, that of the countersink of 60°, and how deep the pilot goes, mm.
CENTRES = {
    1.0: (2.12, 1.9), 1.25: (2.65, 2.3), 1.6: (3.35, 2.9), 2.0: (4.25, 3.7), 2.5: (5.3, 4.6), 3.15: (6.7, 5.9),
    4.0: (8.5, 7.4), 5.0: (10.6, 9.2), 6.3: (13.2, 11.5), 8.0: (17.0, 14.8), 10.0: (21.2, 18.4),
}  # fmt: skip


@dataclass(frozen=True, repr=False)
class RingGroove(TurnedFeature):
    """A groove round the part, or `inside` a bore, from `z` backwards.

    `diameter` is that of its bottom, or `depth` how deep it is below the surface; `corner` the radius at the bottom.

    >>> pin = mnc.TurnedDesign([(0, 10), (-30, 10)], [mnc.design.RingGroove(-10, 4, depth=2)])
    >>> print(f"{pin.volume:.1f}")  # pi x (10 x 10 x 30 - (10 x 10 - 8 x 8) x 4)
    8972.4
    """

    kind = "ring groove"
    z: float
    width: float
    depth: float | None = None
    diameter: float | None = None
    inside: bool = False
    corner: float = 0.0

    def _check(self) -> None:
        check_number(self.z, "the z of a ring groove (mm)")
        check_positive(self, "width", *given(self, "depth", "diameter"))
        check_flag(self, "inside")
        check_number(self.corner, "the corner of a ring groove (mm)", at_least=0, at_most=self.width / 2)
        if (self.depth is None) == (self.diameter is None):
            told = "neither" if self.depth is None else "both"
            raise Alarm(f"a ring groove has either a depth or the diameter of its bottom, got {told}")

    def _measures(self) -> Iterator[Measure]:
        yield Measure("width", self.width)
        if self.depth is not None:
            yield Measure("depth", self.depth, "depth")
        if self.diameter is not None:
            yield Measure("diameter", self.diameter, "diameter")
        if self.corner:
            yield Measure("corner radius", self.corner, "radius")
        yield Measure("z", self.z, "place")

    def _bottom(self, walls: tuple[float, float]) -> float:
        """The radius of the bottom between two edges."""
        if self.diameter is not None:
            return self.diameter / 2
        if abs(walls[0] - walls[1]) > SAME:
            told = f"its two edges stand at diameters {2 * walls[0]:g} and {2 * walls[1]:g}"
            raise Alarm(f"{told}: say the diameter of its bottom instead of a depth")
        return walls[0] + float(self.depth or 0.0) * (1 if self.inside else -1)

    def places(self, body: TurnedBody) -> dict[str, Place]:
        z, back, c = self.z, self.z - self.width, self.corner
        walls = body.walls(z, back, self.inside)
        bottom = self._bottom(walls)
        up = bottom + (-c if self.inside else c)
        return {
            "width": ((z, walls[0]), (back, walls[1]), None),
            "depth": ((back, walls[1]), (back, bottom), None),
            "diameter": ((z, bottom), (back, bottom), None),
            "corner radius": ((back, up), (back + c, bottom), (back + c, up)),
            "z": ((z, walls[0]), (z, walls[0]), None),
        }

    def cut(self, body: TurnedBody) -> Contour:
        back = self.z - self.width
        body.check_within(self.z, back, ends=False)
        walls = body.walls(self.z, back, self.inside)
        bottom, out = self._bottom(walls), -1 if self.inside else 1  # where it comes from
        deep = min(out * (wall - bottom) for wall in walls)
        if bottom < SAME or deep < SAME:
            limit = f"greater than the bore, {2 * max(walls):g}" if self.inside else f"less than the part, {2 * min(walls):g}"
            raise Alarm(f"the diameter of its bottom must be {limit}, and greater than 0, got {2 * bottom:g}")
        if self.corner > deep + SAME:
            raise Alarm(f"its corner must be at most its depth, {deep:g}, got {self.corner:g}")
        sky = -BEYOND if self.inside else body.radius + BEYOND
        points = [(self.z, sky), (self.z, bottom), (back, bottom), (back, sky)]
        return outline(points, {1: self.corner, 2: self.corner} if self.corner else {}, "a ring groove")

    def turned_over(self, middle: float) -> Self:
        return replace(self, z=middle - (self.z - self.width))


@dataclass(frozen=True, repr=False)
class FaceGroove(FromEnd):
    """A groove in a face that is seen from an end, between the diameters `inner` and `outer`.

    `corner` is the radius at its bottom.

    >>> pin = mnc.TurnedDesign([(0, 10), (-30, 10)], [mnc.design.FaceGroove(10, 14, 3)])
    >>> print(f"{pin.volume:.1f}")  # pi x (10 x 10 x 30 - (7 x 7 - 5 x 5) x 3)
    9198.6
    """

    kind = "face groove"
    inner: float
    outer: float
    depth: float
    corner: float = 0.0

    def _check(self) -> None:
        check_positive(self, "inner", "outer", "depth")
        check_number(self.outer, "the outer diameter of a face groove (mm)", above=self.inner)
        most = min((self.outer - self.inner) / 4, self.depth)
        check_number(self.corner, "the corner of a face groove (mm)", at_least=0, at_most=most)

    def _measures(self) -> Iterator[Measure]:
        yield Measure("inner diameter", self.inner, "diameter")
        yield Measure("outer diameter", self.outer, "diameter")
        yield Measure("depth", self.depth, "depth")
        if self.corner:
            yield Measure("corner radius", self.corner, "radius")

    def _places(self, body: TurnedBody) -> dict[str, Place]:
        inner, outer, c = self.inner / 2, self.outer / 2, self.corner
        face = body.ends_at(inner)[1]
        bottom = face - self.depth
        return {
            "inner diameter": ((face, inner), (bottom, inner), None),
            "outer diameter": ((face, outer), (bottom, outer), None),
            "depth": ((face, outer), (bottom, outer), None),
            "corner radius": ((bottom + c, outer), (bottom, outer - c), (bottom + c, outer - c)),
        }

    def _from_front(self, body: TurnedBody) -> Contour:
        inner, outer = self.inner / 2, self.outer / 2
        faces = [body.ends_at(r)[1] for r in (inner - SAME, inner, outer, outer + SAME)]
        face = faces[1]
        if not np.ptp(faces) <= SAME:
            raise Alarm(f"it needs a flat face wider than {self.inner:g} to {self.outer:g}, the diameters of its walls")
        bottom = face - self.depth
        if bottom < body.low + SAME:
            raise Alarm(f"its depth must be less than what stands behind its face, {face - body.low:g}, got {self.depth:g}")
        sky = body.high + BEYOND
        points = [(sky, inner), (sky, outer), (bottom, outer), (bottom, inner)]
        return outline(points, {2: self.corner, 3: self.corner} if self.corner else {}, "a face groove")


@dataclass(frozen=True, repr=False)
class Bore(FromEnd):
    """A hole along the axis. `depth` is that of the cylinder from the end, the point comes on top; None: through.

    `point` is the included angle of the bottom, degrees, 180 for a flat one, whose edge may have a radius, `corner`.
    `chamfer`: the width at 45° at its mouth. A stepped bore is several, each deeper and narrower than the one before.

    >>> bush = mnc.TurnedDesign([(0, 10), (-30, 10)], [mnc.design.Bore(10)])
    >>> print(f"{bush.volume:.1f}")  # pi x (10 x 10 - 5 x 5) x 30
    7068.6
    """

    kind = "bore"
    diameter: float
    depth: float | None = None
    point: float = 118.0
    chamfer: float = 0.0
    corner: float = 0.0

    def _check(self) -> None:
        check_positive(self, "diameter", *given(self, "depth"))
        check_number(self.point, "the point of a bore (degrees)", at_least=1, at_most=180)
        check_number(self.chamfer, "the chamfer of a bore (mm)", at_least=0)
        check_number(self.corner, "the corner of a bore (mm)", at_least=0, at_most=self.diameter / 2)
        if self.corner and (self.point < 180 or self.depth is None):
            raise Alarm("the corner of a bore is that of a flat bottom", hint="point=180 and a depth")

    @property
    def tip(self) -> float:
        """How far the point goes beyond the cylinder, mm."""
        if self.depth is None or self.point == 180:
            return 0.0
        return self.diameter / 2 / math.tan(math.radians(self.point / 2))

    def _measures(self) -> Iterator[Measure]:
        yield Measure("diameter", self.diameter, "diameter")
        if self.depth is not None:
            yield Measure("depth", self.depth, "depth")
            if self.point not in (118, 180):
                yield Measure("point angle", self.point, "angle")
        if self.chamfer:
            yield Measure("chamfer", self.chamfer, "chamfer", text=f"{self.chamfer:g}×45°")
        if self.corner:
            yield Measure("corner radius", self.corner, "radius")

    def _places(self, body: TurnedBody) -> dict[str, Place]:
        r, c, high = self.diameter / 2, self.corner, body.high
        mouth, shoulder = body.ends_at(r)[1], body.low if self.depth is None else high - self.depth
        return {
            "diameter": ((mouth, r), (shoulder, r), None),
            "depth": ((high, r), (shoulder, r), None),
            "point angle": ((shoulder, r), (shoulder - self.tip, 0.0), None),
            "chamfer": ((mouth, r + self.chamfer), (mouth - self.chamfer, r), None),
            "corner radius": ((shoulder + c, r), (shoulder, r - c), (shoulder + c, r - c)),
        }

    def _from_front(self, body: TurnedBody) -> Contour:
        r, low, high = self.diameter / 2, body.low, body.high
        deep = high - low if self.depth is None else self.depth + self.tip
        if self.depth is not None and deep > high - low - SAME:
            told = f"the depth, {self.depth:g}, and the point, {self.tip:.6g}, together" if self.tip else "the depth"
            raise Alarm(f"{told} must be less than the length of the part, {high - low:g}, got {deep:.6g}",
                        hint="without a depth it goes through")  # fmt: skip
        mouth = body.ends_at(r)[1]
        if math.isnan(mouth) and r < body.radius:
            raise Alarm("it takes nothing away")
        if not mouth > high - deep:
            raise Alarm(f"its diameter must be less than that of the part there, got {self.diameter:g}")
        start = [(high + BEYOND, -BEYOND), (high + BEYOND, r)]
        if self.chamfer:
            c = self.chamfer
            if not all(abs(body.ends_at(r + c - inside)[1] - mouth) <= SAME for inside in (0.0, SAME)):
                raise Alarm(f"its chamfer {c:g} needs a flat face about its mouth, at least {2 * (r + c):g} wide")
            if c > mouth - high + deep - self.tip - SAME:
                raise Alarm(f"its chamfer must be less than the depth behind its mouth, got {c:g}")
            out = mouth + LEAST
            start = [(high + BEYOND, -BEYOND), (high + BEYOND, r), (out, r), (out, r + c + LEAST), (mouth - c, r)]
        if self.depth is None:
            return outline([*start, (low - BEYOND, r), (low - BEYOND, -BEYOND)], {}, "a bore")
        shoulder = high - self.depth
        foot = shoulder - self.tip * (1 + BEYOND / r)  # the cone goes on below the axis
        points = [*start, (shoulder, r), (foot, -BEYOND)]
        return outline(points, {len(start): self.corner} if self.corner else {}, "a bore")


@dataclass(frozen=True, repr=False)
class CentreHole(FromEnd):
    """A centre hole of form A of ISO 6411: a countersink of 60° and the `pilot` (diameter) behind it.

    The `diameter` of the countersink and the `depth` of the pilot, to its point of 118°, are those of DIN 332-1 unless given.
    """

    kind = "centre hole"
    pilot: float
    diameter: float | None = None
    depth: float | None = None

    def _check(self) -> None:
        check_positive(self, "pilot", *given(self, "diameter", "depth"))
        if (self.diameter is None or self.depth is None) and float(self.pilot) not in CENTRES:
            known = ", ".join(f"{each:g}" for each in CENTRES)
            raise Alarm(f"a centre hole has a pilot of {known} by DIN 332-1, or its diameter and depth given, got {self.pilot:g}")
        wide, deep = self.sizes
        check_number(wide, "the diameter of a centre hole (mm)", above=self.pilot)
        check_number(deep, "the depth of a centre hole (mm)", above=self.sunk)

    @property
    def sizes(self) -> tuple[float, float]:
        """The diameter of the countersink and the depth of the pilot, mm: those given, else those of DIN 332-1."""
        wide, deep = CENTRES.get(float(self.pilot), (0.0, 0.0))
        return wide if self.diameter is None else self.diameter, deep if self.depth is None else self.depth

    @property
    def sunk(self) -> float:
        """How deep the countersink goes, mm."""
        return (self.sizes[0] - self.pilot) / 2 / math.tan(math.pi / 6)

    def _measures(self) -> Iterator[Measure]:
        wide, deep = self.sizes
        yield Measure("diameter", wide, "diameter")
        yield Measure("pilot diameter", self.pilot, "diameter")
        yield Measure("depth", deep, "depth")

    def _places(self, body: TurnedBody) -> dict[str, Place]:
        (wide, deep), r, high = self.sizes, self.pilot / 2, body.high
        return {
            "diameter": ((high, wide / 2), (high, wide / 2), None),
            "pilot diameter": ((high - self.sunk, r), (high - deep, r), None),
            "depth": ((high, r), (high - deep, r), None),
        }

    def _from_front(self, body: TurnedBody) -> Contour:
        (wide, deep), pilot, high = self.sizes, self.pilot / 2, body.high
        wide = wide / 2
        if not all(abs(body.ends_at(r)[1] - high) <= SAME for r in (wide, 0.0)):
            raise Alarm(f"it needs a flat end at least {2 * wide:g} wide")
        shoulder = high - deep
        steep = pilot / math.tan(math.radians(59))
        if shoulder - steep < body.low + SAME:
            raise Alarm(f"its depth must be less than the length of the part, {high - body.low:g}, got {deep:g}")
        flare = wide + LEAST * math.tan(math.pi / 6)
        points = [(high + LEAST, -BEYOND), (high + LEAST, flare), (high - self.sunk, pilot), (shoulder, pilot)]
        return outline([*points, (shoulder - steep * (1 + BEYOND / pilot), -BEYOND)], {}, "a centre hole")


TURNED_FEATURES: dict[str, type[TurnedFeature]] = {
    each.kind: each for each in (Bore, CentreHole, RingGroove, FaceGroove, Undercut, Thread)
}
