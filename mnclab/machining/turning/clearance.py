"""Rapids of turning that keep clear of what still stands, and strokes that stay above the profile.

A plan is gone through stroke by stroke on the half section of the blank. A rapid that would meet material goes up and
over instead, or out of the blank, over and down; what of the way out or down is not free is cut at feed. A stroke that
would cut below the profile is refused. Coordinates (z, r), mm.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

from mnclab.geometry.contours import Contour
from mnclab.geometry.curves import Floats
from mnclab.geometry.sweeps import CHORD_ERROR, broad, swept, under
from mnclab.machining.turning.strokes import PLUNGE, RAPID, ROUGH, Plan, Stroke
from mnclab.path.inserts import edges_of
from mnclab.path.tool import Tool

OUT = 1.0  # mm outside the blank
LEAST = 1e-6  # mm²; what is narrower than two chord errors does not count
NEAR = 0.1  # mm above what stands, where a rapid down ends

Place = tuple[float, float]


def cleared(plan: Plan, profile: Contour, blank: float, tool: Tool) -> Plan:
    """The plan with safe rapids. A ValueError names the first stroke that would cut below the profile."""
    z = profile.points[[0, -1], 0]
    bottom = min([-1.0, *(stroke.r - 1 for stroke in plan.strokes)])
    highest = max(blank, *(stroke.r for stroke in plan.strokes))
    whole = under(Contour([(z[0], bottom), (z[1], bottom)], closed=False), blank)
    part = whole.difference(under(profile, highest + 1))
    section = _Section(plan.name, edges_of(tool, highest - bottom + 10), whole, part, blank + OUT, plan.start)
    for k, stroke in enumerate(plan.strokes):
        if stroke.role == RAPID:
            section.number = next((s.number for s in plan.strokes[k:] if s.role != RAPID), section.number)
            section.rapid(stroke)
        else:
            section.cut(stroke)
    return Plan(plan.name, plan.start, tuple(section.strokes))


@dataclass
class _Section:
    """The half section as the strokes leave it: what is `left`, what must stay of it (`part`), where the tip is."""

    name: str
    outline: Floats
    left: Any
    part: Any
    outside: float
    here: Place
    number: int = 0
    strokes: list[Stroke] = field(default_factory=list)

    def meets(self, area: Any, start: Place, end: Place, bulge: float = 0.0) -> float:
        """How much of an area, mm², the tool covers on its way."""
        return float(broad(area.intersection(self.swept(start, end, bulge)), 2 * CHORD_ERROR).area)

    def swept(self, start: Place, end: Place, bulge: float) -> Any:
        return swept(self.outline, Contour([start, end], [bulge, 0.0], closed=False))

    def free(self, *places: Place) -> bool:
        return all(self.meets(self.left, a, b) <= LEAST for a, b in zip(places, places[1:], strict=False))

    def cut(self, stroke: Stroke) -> None:
        end = (stroke.z, stroke.r)
        if (gouged := self.meets(self.part, self.here, end, stroke.bulge)) > LEAST:
            raise ValueError(
                f"{self.name}: the {stroke.role} stroke to Z{stroke.z:.6g} R{stroke.r:.6g} would cut {gouged:.3g} mm² below "
                "the profile: part the profile into zones, or take another scheme or tool"
            )
        self.left = self.left.difference(self.swept(self.here, end, stroke.bulge))
        self.strokes.append(stroke)
        self.here = end

    def rapid(self, stroke: Stroke) -> None:
        """A rapid as it is if nothing is in its way, else around what is."""
        (z, r), end = self.here, (stroke.z, stroke.r)
        above = max(self.outside, r)
        if self.free(self.here, end):
            self._go(end)
        elif r < stroke.r and self.free(self.here, (z, stroke.r), end):
            self._go((z, stroke.r), end)
        else:
            if not self.free(self.here, (z, above)):
                self.cut(Stroke(z, above, ROUGH, number=self.number))
            self._go((z, above), (stroke.z, above), (stroke.z, self._lowest(stroke.z, above, stroke.r)))
            if self.here != end:
                self.cut(Stroke(*end, PLUNGE, number=self.number))

    def _go(self, *places: Place) -> None:
        for place in places:
            if place != self.here:
                self.strokes.append(Stroke(*place, RAPID))
                self.here = place

    def _lowest(self, z: float, high: float, low: float) -> float:
        """How far down the way is free, less a little if it is not free to the end."""
        if self.free((z, high), (z, low)):
            return low
        top = high
        while top - low > NEAR / 2:
            middle = (top + low) / 2
            top, low = (middle, low) if self.free((z, high), (z, middle)) else (top, middle)
        return min(top + NEAR, high)
