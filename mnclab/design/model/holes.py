"""Holes: drilled, tapped, countersunk and counterbored, one by one or in patterns; metric threads by their names."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any, Self

from mnclab.design.model.feature import Feature, Site, check_positive
from mnclab.design.model.measures import Measure
from mnclab.design.model.removals import Cone, Flat, Removal
from mnclab.design.model.shapes import LARGEST, check_place
from mnclab.geometry.contours import Contour
from mnclab.geometry.regions import Region
from mnclab.text.alarm import Alarm
from mnclab.text.given import check_number, shown, whole

BEYOND = 1.0  # mm, by which what goes through goes beyond the lower side
MOST = 1000  # holes in a row of a pattern


@dataclass(frozen=True, repr=False)
class Hole(Feature):
    """A hole about (x, y). `depth` is that of the cylinder, to its shoulder; the point comes on top; None: through.

    `point` is the included angle of the bottom, degrees, 180 for a flat one. `counterbore` (diameter, depth);
    `countersink` (diameter, included angle). `thread` is a designation ("M8", "M8x1"), `thread_depth` how far it goes
    (None: as deep as the hole); the hole then is that for the tap: `diameter` may be None, and is the nominal
    diameter less the pitch.

    >>> hole = mnc.design.Hole(20, 20, 10)
    >>> print(f"{mnc.Design(mnc.box(100, 60, 20), [hole]).volume:.1f}")  # less pi x 5 x 5 x 20
    118429.2
    """

    kind = "hole"
    recess = True
    x: float
    y: float
    diameter: float | None
    depth: float | None = None
    point: float = 118.0
    counterbore: tuple[float, float] | None = None
    countersink: tuple[float, float] | None = None
    thread: str = ""
    thread_depth: float | None = None

    @classmethod
    def row(
        cls, x: float, y: float, count: int, spacing: float, diameter: float | None, depth: float | None = None,
        turned: float = 0.0, **more: Any,
    ) -> tuple[Self, ...]:  # fmt: skip
        """So many from (x, y) on, `spacing` mm apart, in the direction `turned`, degrees from X."""
        return cls.grid(x, y, count, 1, spacing, 1.0, diameter, depth, turned, **more)

    @classmethod
    def grid(
        cls, x: float, y: float, columns: int, rows: int, dx: float, dy: float, diameter: float | None,
        depth: float | None = None, turned: float = 0.0, **more: Any,
    ) -> tuple[Self, ...]:  # fmt: skip
        """Rows of holes above each other, the first of them at (x, y), `dx` and `dy` mm apart, all `turned` by degrees."""
        for name, number in (("dx", dx), ("dy", dy), ("turned", turned)):
            check_place(number, f"{name} of a pattern of holes")
        counts = (_count(columns, "the columns"), _count(rows, "the rows"))
        c, s = math.cos(math.radians(turned)), math.sin(math.radians(turned))
        places = [(dx * i, dy * k) for k in range(counts[1]) for i in range(counts[0])]
        return cls._at(x, y, [(c * u - s * v, s * u + c * v) for u, v in places], diameter, depth, more)

    @classmethod
    def circle(
        cls, x: float, y: float, count: int, pitch_diameter: float, diameter: float | None, depth: float | None = None,
        first: float = 0.0, **more: Any,
    ) -> tuple[Self, ...]:  # fmt: skip
        """So many evenly on a circle about (x, y), the first of them at an angle, degrees."""
        check_number(pitch_diameter, "the pitch diameter of a circle of holes (mm)", above=0, at_most=LARGEST)
        check_place(first, "the angle of the first hole (degrees)")
        number = _count(count, "the count")
        angles = [math.radians(first + 360 * k / number) for k in range(number)]
        places = [(pitch_diameter / 2 * math.cos(a), pitch_diameter / 2 * math.sin(a)) for a in angles]
        return cls._at(x, y, places, diameter, depth, more)

    @classmethod
    def _at(
        cls, x: float, y: float, places: list[tuple[float, float]], diameter: float | None, depth: float | None, more: Any
    ) -> tuple[Self, ...]:
        for name, number in (("x", x), ("y", y)):
            check_place(number, f"{name} of a pattern of holes (mm)")
        return tuple(cls(round(x + u, 9), round(y + v, 9), diameter, depth, **more) for u, v in places)

    def _check(self) -> None:
        for name in ("x", "y"):
            check_place(getattr(self, name), f"the {name} of a hole (mm)")
        if not isinstance(self.thread, str):
            raise Alarm(f"the thread of a hole must be a text, got {shown(self.thread)}", hint='thread="M8"')
        if self.diameter is None and self.thread:
            object.__setattr__(self, "diameter", core_of(self.thread))
        check_positive(self, "diameter", *([] if self.depth is None else ["depth"]))
        check_number(self.point, "the point of a hole (degrees)", at_least=1, at_most=180)
        for name, second, most in (("counterbore", "depth (mm)", LARGEST), ("countersink", "angle (degrees)", 179.0)):
            given = getattr(self, name)
            if given is None:
                continue
            if not isinstance(given, tuple | list) or len(given) != 2:
                raise Alarm(f"the {name} of a hole must be its diameter (mm) and {second}, got {shown(given)}")
            check_number(given[0], f"the diameter of a {name} (mm)", above=self.wide, at_most=LARGEST)
            check_number(given[1], f"the {second} of a {name}", above=0, at_most=most)
            object.__setattr__(self, name, tuple(float(each) for each in given))
        if self.counterbore and self.depth is not None and self.counterbore[1] >= self.depth:
            raise Alarm(f"a counterbore must be less deep than its hole, {self.depth:g}, got {self.counterbore[1]:g}")
        if self.thread and core_of(self.thread) <= 0:
            raise Alarm(f"the thread {self.thread} leaves no core")
        if self.thread_depth is not None:
            check_positive(self, "thread_depth")
            if not self.thread:
                raise Alarm("a thread_depth needs a thread", hint='thread="M8"')
            if self.depth is not None and self.thread_depth > self.depth:
                raise Alarm(f"a thread goes at most as deep as its hole, {self.depth:g}, got {self.thread_depth:g}")

    @property
    def wide(self) -> float:
        """The diameter, mm."""
        return float(self.diameter or 0.0)

    @property
    def mouth(self) -> float:
        """The greatest diameter without the thread, mm."""
        return max(self.wide, (self.counterbore or (0.0,))[0], (self.countersink or (0.0,))[0])

    @property
    def outline(self) -> Contour:
        return Contour.circle((self.x, self.y), self.wide / 2)

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
        top, centre, r = self.from_top(site), (float(self.x), float(self.y)), self.wide / 2
        shoulder = site.bottom - BEYOND if self.depth is None else top - self.depth
        yield Flat(Region((Contour.circle(centre, r),)), shoulder)
        if self.tip:
            yield Cone(centre, far=r, deep=shoulder - self.tip, open=shoulder, part="point")
        if self.counterbore:
            around = Region((Contour.circle(centre, self.counterbore[0] / 2),))
            yield Flat(around, top - self.counterbore[1], part="counterbore")
        if self.countersink:
            out = self.countersink[0] / 2
            seat = top - (self.counterbore[1] if self.counterbore else 0.0)
            deep = seat - (out - r) / math.tan(math.radians(self.countersink[1] / 2))
            yield (cone := Cone(centre, near=r, far=out, deep=deep, open=seat, part="countersink"))
            yield cone.clearance


def _count(value: Any, what: str) -> int:
    check_number(value, f"{what} of a pattern of holes", at_least=1, at_most=MOST)
    return whole(value, f"{what} of a pattern of holes")


# Metric threads as a drawing names them: "M8" with its coarse pitch (ISO 261), "M8x1" with its own.

#: Coarse pitches by nominal diameter, mm.
COARSE = {
    1.6: 0.35, 2.0: 0.4, 2.5: 0.45, 3.0: 0.5, 4.0: 0.7, 5.0: 0.8, 6.0: 1.0, 8.0: 1.25, 10.0: 1.5, 12.0: 1.75, 14.0: 2.0,
    16.0: 2.0, 18.0: 2.5, 20.0: 2.5, 22.0: 2.5, 24.0: 3.0, 27.0: 3.0, 30.0: 3.5, 33.0: 3.5, 36.0: 4.0, 39.0: 4.0,
    42.0: 4.5, 45.0: 4.5, 48.0: 5.0, 52.0: 5.0, 56.0: 5.5, 60.0: 5.5, 64.0: 6.0,
}  # fmt: skip
WRITTEN = re.compile(r"[Mm]\s?(\d+(?:\.\d+)?)(?:\s?[xX×]\s?(\d+(?:\.\d+)?))?")


def metric(written: Any) -> tuple[float, float]:
    """Nominal diameter and pitch of a designation, mm."""
    found = WRITTEN.fullmatch(written.strip()) if isinstance(written, str) and len(written) < 40 else None
    if not found:
        raise Alarm(f"a thread is M and its diameter, with x and the pitch if it is fine, got {shown(written)}", hint="M8, M8x1")
    wide = float(found[1])
    if found[2]:
        pitch = float(found[2])
    elif wide in COARSE:
        pitch = COARSE[wide]
    else:
        raise Alarm(f"M{wide:g} has no coarse pitch, name its pitch", hint=f"M{wide:g}x1")
    if not 0 < pitch < wide:
        raise Alarm(f"the pitch of a thread is between 0 and its diameter, {wide:g}, got {pitch:g}")
    return wide, pitch


def core_of(written: Any, pitches: float = 1.0) -> float:
    """The hole that a thread is cut in: the nominal diameter less the pitch, or less so many pitches, mm."""
    wide, pitch = metric(written)
    return wide - pitches * pitch
