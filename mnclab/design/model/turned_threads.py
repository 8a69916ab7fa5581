"""Threads of a turned part and their undercuts. Metric ISO threads (ISO 68-1): diameters by nominal one and pitch.

A thread is drawn and weighed without its teeth: outside as the cylinder of its nominal diameter, inside as its core. What a
program cuts are teeth in between, so a comparison judges a thread by its `band`.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import Self

import numpy as np

from mnclab.design.model.feature import check_flag, check_positive
from mnclab.design.model.holes import metric
from mnclab.design.model.measures import Measure
from mnclab.design.model.turned_feature import (
    BESIDE,
    BEYOND,
    ENDS,
    SAME,
    Place,
    Point,
    TurnedBody,
    TurnedFeature,
    given,
    outline,
)
from mnclab.geometry.contours import Contour
from mnclab.text.alarm import Alarm
from mnclab.text.given import check_number, choice

SHARP = math.sqrt(3) / 2  # of the pitch: the depth of a thread with sharp teeth
INNER, PITCH, OUTER = 5 / 4 * SHARP, 3 / 4 * SHARP, 17 / 12 * SHARP  # by which core, flanks and core of a bolt are narrower
RUN = 2.0  # pitches that a thread may run out of its cylinder at either end: into a chamfer, into an undercut
#: DIN 76-1, by pitch, mm: how much narrower than the thread an outside undercut is (form A), the width of its bottom and
#: the radius of its corners. Inside (form C) it is wider than the thread by 0.5 (below a pitch of 1 by 0.3), 4 pitches wide.
UNDERCUTS = {
    0.5: (0.8, 1.1, 0.2), 0.6: (1.0, 1.2, 0.4), 0.7: (1.1, 1.5, 0.4), 0.75: (1.2, 1.6, 0.4), 0.8: (1.3, 1.7, 0.4),
    1.0: (1.6, 2.1, 0.6), 1.25: (2.0, 2.7, 0.6), 1.5: (2.3, 3.2, 0.8), 1.75: (2.6, 3.9, 1.0), 2.0: (3.0, 4.5, 1.0),
    2.5: (3.6, 5.6, 1.2), 3.0: (4.4, 6.7, 1.6), 3.5: (5.0, 7.7, 1.6), 4.0: (5.7, 9.0, 2.0), 4.5: (6.4, 10.5, 2.0),
    5.0: (7.0, 11.5, 2.5), 5.5: (7.7, 12.5, 3.2), 6.0: (8.3, 14.0, 3.2),
}  # fmt: skip


@dataclass(frozen=True, repr=False)
class Thread(TurnedFeature):
    """A metric thread ("M30x1.5", "M30" with its coarse pitch) from z `start` back to `end`, `inside` a bore or outside.

    Outside the profile has its cylinder, of the nominal diameter (or less, down to that of the flanks). Inside it opens its
    bore to the core, D₁ = d - 1.0825 P, where that is narrower.

    >>> mnc.design.Thread("M20x1.5", 0, -20)
    Thread(thread='M20x1.5', start=0, end=-20)
    """

    kind = "thread"
    thread: str
    start: float
    end: float
    inside: bool = False

    def _check(self) -> None:
        metric(self.thread)
        check_number(self.start, "the start of a thread (mm)")
        check_number(self.end, "the end of a thread (mm)")
        check_flag(self, "inside")
        if not self.end < self.start:
            raise Alarm(f"a thread goes from its start backwards, its end is less than {self.start:g}, got {self.end:g}")

    @property
    def major(self) -> float:
        """The nominal diameter, mm."""
        return metric(self.thread)[0]

    @property
    def pitch(self) -> float:
        """mm."""
        return metric(self.thread)[1]

    @property
    def minor(self) -> float:
        """The diameter of the core, mm: D₁ = d - 1.0825 P inside, d₃ = d - 1.2269 P outside."""
        return self.major - self.pitch * (INNER if self.inside else OUTER)

    @property
    def flanks(self) -> float:
        """The pitch diameter d₂ = d - 0.6495 P, mm."""
        return self.major - self.pitch * PITCH

    @property
    def band(self) -> tuple[float, float]:
        """The radii between which the surface of the cut thread may lie, mm."""
        return self.minor / 2, self.major / 2

    def _measures(self) -> Iterator[Measure]:
        yield Measure("thread", self.major, "thread", text=f"M{self.major:g}×{self.pitch:g}")
        yield Measure("length", self.start - self.end)
        yield Measure("z", self.start, "place")

    def places(self, body: TurnedBody) -> dict[str, Place]:
        r = self.band[0 if self.inside else 1]
        along = ((self.start, r), (self.end, r), None)
        return {"thread": along, "length": along, "z": ((self.start, r), (self.start, r), None)}

    def cut(self, body: TurnedBody) -> Contour | None:
        body.check_within(self.start, self.end)
        middles, lengths = body.places(self.start, self.end)
        radii = (body.inner if self.inside else body.outer)(middles)
        if self.inside:
            if radii.min() < SAME:
                raise Alarm(f"there is no bore from Z {self.start:g} to {self.end:g}", hint="a Bore before it")
            radii = np.maximum(radii, self.minor / 2)
        least, most = (self.minor / 2, self.flanks / 2) if self.inside else (self.flanks / 2, self.major / 2)
        hit = (radii >= least - SAME) & (radii <= most + SAME)
        across = f"diameters {2 * least:.6g} to {2 * most:.6g}"
        if not hit.any() or (not self.inside and (radii > most + SAME).any()):
            found = 2 * float(radii[~hit].max() if not self.inside else radii[~hit].min())
            raise Alarm(f"{'its bore' if self.inside else 'its cylinder'} must have {across}, got {found:.6g}")
        first, last = np.flatnonzero(hit)[[0, -1]]
        over = max(float(lengths[:first].sum()), float(lengths[last + 1 :].sum()))
        if over > RUN * self.pitch + SAME:
            told = f"it goes beyond its {'bore' if self.inside else 'cylinder'} ({across})"
            raise Alarm(f"{told} by at most {RUN:g} pitches, {RUN * self.pitch:g}, got {over:.6g}")
        if not self.inside or (body.inner(middles) >= self.minor / 2 - SAME).all():
            return None
        front = self.start + (BEYOND if self.start > body.high - SAME else 0.0)
        back = self.end - (BEYOND if self.end < body.low + SAME else 0.0)
        r = self.minor / 2
        return outline([(front, -BEYOND), (front, r), (back, r), (back, -BEYOND)], {}, "a thread")

    def turned_over(self, middle: float) -> Self:
        return replace(self, start=middle - self.end, end=middle - self.start)


@dataclass(frozen=True, repr=False)
class Undercut(TurnedFeature):
    """The undercut at the end of a thread: from a shoulder at `z` towards the thread, up a slope of 30° to the surface.

    `diameter`, `width` of the bottom, to where the slope begins, and `corner` radii are those of DIN 76-1 for the pitch unless
    given (outside form A, inside form C). `thread_at`: the thread lies to the "front" or the "back" of it.
    """

    kind = "undercut"
    thread: str
    z: float
    inside: bool = False
    diameter: float | None = None
    width: float | None = None
    corner: float | None = None
    angle: float = 30.0
    thread_at: str = "front"

    def _check(self) -> None:
        _, pitch = metric(self.thread)
        check_number(self.z, "the z of an undercut (mm)")
        check_flag(self, "inside")
        check_positive(self, *given(self, "diameter", "width"))
        check_number(self.angle, "the angle of an undercut (degrees)", at_least=1, at_most=90)
        choice(self.thread_at, "the thread_at of an undercut", ENDS)
        if None in (self.diameter, self.width, self.corner) and pitch not in UNDERCUTS:
            known = ", ".join(f"{each:g}" for each in UNDERCUTS)
            raise Alarm(f"DIN 76-1 has undercuts for the pitches {known}, got {pitch:g}",
                        hint="give the diameter, the width and the corner of the undercut")  # fmt: skip
        if self.corner is not None:
            check_number(self.corner, "the corner of an undercut (mm)", at_least=0)

    @property
    def sizes(self) -> tuple[float, float, float]:
        """Diameter, width of the bottom and radius of its corners, mm: those given, else those of DIN 76-1."""
        wide, pitch = metric(self.thread)
        less, width, corner = UNDERCUTS.get(pitch, (0.0, 0.0, 0.0))
        usual = (wide + (0.5 if pitch >= 1 else 0.3), 4 * pitch, corner) if self.inside else (wide - less, width, corner)
        own = (self.diameter, self.width, self.corner)
        diameter, width, corner = (float(u if o is None else o) for o, u in zip(own, usual))
        return diameter, width, corner

    def _measures(self) -> Iterator[Measure]:
        diameter, width, corner = self.sizes
        yield Measure("diameter", diameter, "diameter")
        yield Measure("width", width)
        if corner:
            yield Measure("corner radius", corner, "radius")
        yield Measure("angle", self.angle, "angle")
        yield Measure("z", self.z, "place")

    def _slope(self, body: TurnedBody) -> tuple[Point, Point]:
        """Where the slope begins at the bottom and ends at the surface."""
        (diameter, width, _), ahead = self.sizes, self._ahead
        bottom, foot = diameter / 2, self.z + ahead * width
        body.check_within(max(self.z, foot), min(self.z, foot))
        wall = self._surface(body, foot + ahead * BESIDE)
        lean = abs(wall - bottom) / math.tan(math.radians(self.angle)) if self.angle < 90 else 0.0
        return (foot, bottom), (foot + ahead * lean, wall)

    @property
    def _ahead(self) -> float:
        return 1.0 if self.thread_at == "front" else -1.0

    def _surface(self, body: TurnedBody, z: float) -> float:
        return float((body.inner if self.inside else body.outer)(np.array([z]))[0])

    def places(self, body: TurnedBody) -> dict[str, Place]:
        (foot, bottom), top = self._slope(body)
        c, up = self.sizes[2] * self._ahead, bottom + self.sizes[2] * (-1 if self.inside else 1)
        return {
            "diameter": ((self.z, bottom), (foot, bottom), None),
            "width": ((self.z, bottom), (foot, bottom), None),
            "corner radius": ((self.z, up), (self.z + c, bottom), (self.z + c, up)),
            "angle": ((foot, bottom), top, None),
            "z": ((self.z, bottom), (self.z, bottom), None),
        }

    def cut(self, body: TurnedBody) -> Contour:
        ((foot, bottom), (end, wall)), ahead, corner = self._slope(body), self._ahead, self.sizes[2]
        out = -1.0 if self.inside else 1.0
        if not wall * out > bottom * out + SAME:
            limit = "greater" if self.inside else "less"
            raise Alarm(f"its diameter must be {limit} than that of the surface there, {2 * wall:g}, got {2 * bottom:g}")
        behind = self._surface(body, self.z - ahead * BESIDE)
        if not behind * out > bottom * out + SAME or behind < SAME:
            raise Alarm(f"there is no shoulder at Z {self.z:g}: the surface behind it has {2 * behind:g}")
        if corner > abs(wall - bottom) + SAME:
            raise Alarm(f"its corner must be at most its depth, {abs(wall - bottom):g}, got {corner:g}")
        body.check_within(max(self.z, end), min(self.z, end))
        sky = -BEYOND if self.inside else body.radius + BEYOND
        lean = (end - foot) / abs(wall - bottom)
        rise = min(abs(sky - wall), 1e-3)  # it goes out of the surface by so much, then straight up
        points = [(self.z, sky), (self.z, bottom), (foot, bottom), (end + lean * rise, wall + out * rise)]
        points.append((end + lean * rise, sky))
        return outline(points, {1: corner, 2: corner} if corner else {}, "an undercut")

    def turned_over(self, middle: float) -> Self:
        return replace(self, z=middle - self.z, thread_at=ENDS[self.thread_at == "front"])
