"""Grooves of a turned part: round it or in its bore, and in a face."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import Self

import numpy as np

from mnclab.design.model.feature import check_flag, check_positive
from mnclab.design.model.measures import Measure
from mnclab.design.model.turned_body import BEYOND, SAME, TurnedBody
from mnclab.design.model.turned_feature import FromEnd, Place, TurnedFeature, given, outline
from mnclab.geometry.contours import Contour
from mnclab.text.alarm import Alarm
from mnclab.text.given import check_number


@dataclass(frozen=True, repr=False)
class RingGroove(TurnedFeature):
    """A groove round the part, or `inside` a bore, from `z` backwards.

    `diameter` is that of its bottom, or `depth` how deep it is below the surface; `corner` the radius at the bottom.
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

    def moved(self, dz: float) -> Self:
        return replace(self, z=self.z + dz)


@dataclass(frozen=True, repr=False)
class FaceGroove(FromEnd):
    """A groove in a face that is seen from an end, between the diameters `inner` and `outer`.

    `corner` is the radius at its bottom.
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
