"""The largest tool radius with which a compensated contour can be run, without a run that fails."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

from mnclab.path.listing import MM, Unit
from mnclab.text.alarm import Alarm

if TYPE_CHECKING:
    from mnclab.runs.run import Run

GROWTH, EXACT = 2.0, 1e-9


@dataclass(frozen=True, repr=False)
class LargestRadius:
    """`radius` mm (inf: any fits); `below`: this radius itself does not fit, every smaller one does. `line` and `other` are
    those of the elements between which a larger one has no room, None without any. `reach` is "up to line 12, where the run
    stopped" if only the contours so far are known, or "up to line 12, where the program takes no tool of radius 8 mm" if a
    cycle there refuses the radius that was tried; else empty."""

    radius: float
    below: bool = False
    line: int | None = None
    other: int | None = None
    reach: str = ""
    unit: Unit = MM  # in which it is told

    def __str__(self) -> str:
        told = f"{'below ' if self.below else ''}{self.unit.figure(self.radius)} {self.unit.short}"
        if math.isinf(self.radius) or self.radius <= EXACT:
            told = "no tool fits" if self.radius <= EXACT else "any radius fits"
        return " ".join(filter(None, [told + self._where, self.reach]))

    def __repr__(self) -> str:
        return str(self)

    def __float__(self) -> float:
        return self.radius

    @property
    def _where(self) -> str:
        lines = sorted({line for line in (self.line, self.other) if line is not None})
        return f" (line{'s' * (len(lines) > 1)} {' and '.join(map(str, lines))})" if lines else ""


def largest_radius(run: Run) -> LargestRadius:
    """Try the contours of a run with tools that grow until one has no room, and ask which would have had it.

    An Alarm where nothing is compensated, or the control does not know.
    """
    if all(setting.name != "gouge" for setting in run.control.settings):
        raise Alarm(f"the largest radius is not known on {run.control.name}: it does not look where a tool has no room")
    if not (run.programmed.side != 0).any():
        said = f" {run.reach}" if run.halt else ", so any radius fits"
        raise Alarm(f"nothing is compensated{said}", hint="G41, G42 or RL, RR ask for compensation")
    low, high = run.programmed.bounds
    most = 4 * float((high - low).max()) + 1.0
    radius = min(1.0, most)
    while True:
        marked = _marked(run, radius)
        found = list(marked.gouges)
        if found:
            break
        if radius > most:
            return LargestRadius(math.inf, reach=_reach(run, marked, radius))
        radius *= GROWTH
    worst = min(found, key=lambda gouge: gouge.largest)
    below = not worst.largest > EXACT or any(
        gouge.largest <= worst.largest + EXACT for gouge in _marked(run, worst.largest).gouges
    )
    return LargestRadius(worst.largest, below, worst.line, worst.other, _reach(run, marked, radius), run.toolpath.unit)


def _reach(run: Run, marked: Run, radius: float) -> str:
    """How far was looked, in words: as far as the run goes, or to where it refuses so large a tool for another reason."""
    own = run if run.halt is None else run.again(run.setup.with_settings(gouge="mark"))
    if own.halt or not marked.halt:
        return marked.reach
    unit, place = run.toolpath.unit, marked.reach.removesuffix(", where the run stopped")
    return f"{place}, where the program takes no tool of radius {unit.figure(radius)} {unit.short}"


def _marked(run: Run, radius: float) -> Run:
    """The run with a tool of this radius, which says where that has no room."""
    return run.again(run.setup.with_radius(radius).with_settings(gouge="mark"))
