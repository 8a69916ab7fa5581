"""Reaming, boring, back boring and bore milling (MNC, 9.5, 9.6, 9.8, 9.9): G301, G302, G304 and G306, called by M99."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import chain
from typing import ClassVar

import numpy as np

from mnclab.controls.mnc.cycles.prepared import (
    PreparedCycle,
    depth,
    dwell_bottom,
    feed,
    retract_feed,
    spindle_angle,
)
from mnclab.machine.cycle import CycleTable, param, too_many
from mnclab.machine.machine import Machine
from mnclab.machine.true_size import MILLS, SHIFTS, remark, with_the_spindle
from mnclab.machining.holes.drilling import back_bore, back_to_axis, bore, ream
from mnclab.machining.holes.helical import bore_milling, turns
from mnclab.running.performing import perform

CYCLES = CycleTable()

DISENGAGE = {0.0: "not at all", 1.0: "in -X", 2.0: "in -Y", 3.0: "in +X", 4.0: "in +Y"}
SHIFT = {choice: where for choice, where in DISENGAGE.items() if choice}
MODE = {1.0: "climb (counter-clockwise)", -1.0: "conventional (clockwise)", 0.0: "as 1"}


def tilted(m: Machine) -> Iterator[tuple[str, str]]:
    """A fault where the hole does not lie along the oriented spindle."""
    if np.abs(m.frames.matrix[:2, 2]).max() > 1e-9:
        yield "disengage", "needs a hole along the spindle: G39 outside of G17 tilts it"


@CYCLES("G301, G201", "Reaming", runs="call", source="MNC 9.5")
class Reaming(PreparedCycle):
    """In and out at feed."""

    depth: float = depth("depth from the surface to the bottom")
    feed: float | None = feed("reaming feed")
    retract_feed: float | None = retract_feed("return feed")
    dwell_bottom: float = dwell_bottom()

    def moves(self, m: Machine) -> None:
        """Steps 1 to 4 of the manual."""
        end, out = self.approach(m), self.retract_feed or self.feed
        steps = ream(
            self.surface + self.depth, above=self.level, feed=self.feed, retract=out, dwell=self.dwell_bottom
        )  # fmt: skip
        perform(m, self.code, steps)
        self.leave(m, end)


@CYCLES("G302, G202", "Boring with oriented spindle", runs="call", source="MNC 9.6")
class Boring(PreparedCycle):
    """Bores, stops the spindle at an angle, moves 0.2 mm off the wall and withdraws; no frame turns D or changes 0.2 mm."""

    depth: float = depth("depth from the surface to the bottom")
    feed: float | None = feed("boring feed")
    retract_feed: float | None = retract_feed("feed out of the hole")
    dwell_bottom: float = dwell_bottom()
    disengage: float = param(
        "D", "direction in which the tool leaves the wall", "choice", default=0, choices=DISENGAGE, example=1
    )
    spindle_angle: float = spindle_angle("spindle angle for the withdrawal")

    def check(self, m: Machine) -> Iterator[tuple[str, str]]:
        """A hole along the spindle, where the tool leaves its wall."""
        if self.disengage:
            yield from tilted(m)

    def moves(self, m: Machine) -> None:
        """Steps 1 to 6 of the manual; the spindle turns again as before, for the next call."""
        turning, out = m.turning, self.retract_feed or self.feed
        end = self.approach(m)
        steps = bore(
            self.surface + self.depth, above=self.level, feed=self.feed, retract=out, dwell=self.dwell_bottom,
            angle=self.spindle_angle, direction=int(self.disengage),
        )  # fmt: skip
        perform(m, self.code, chain(with_the_spindle(m, steps), back_to_axis(end, turning, "to the start point")))


@CYCLES("G304, G204", "Back boring", runs="call", source="MNC 9.8")
class BackBoring(PreparedCycle):
    """Counterbores from below, with a bar that goes through the hole off its axis."""

    does: ClassVar[str] = SHIFTS

    counterbore_depth: float = param(
        "H", "depth of the counterbore from the lower surface", above=0, incremental=True, example=5
    )
    thickness: float = param("B", "material thickness", above=0, incremental=True, example=20)
    eccentricity: float = param("E", "off-centre distance of the tool", above=0, incremental=True, example=3.5)
    edge_height: float = param(
        "L", "height of the edge above the end of the bar", above=0, incremental=True, example=12
    )
    positioning_feed: float = param("V", "feed into and out of the workpiece", "mm/min", above=0, example=750)
    feed: float | None = feed("counterboring feed")
    dwell_bottom: float = dwell_bottom()
    disengage: float = param("D", "direction of the shift off the axis", "choice", choices=SHIFT, example=1)
    spindle_angle: float = spindle_angle("spindle angle for entry and exit")

    def contradictions(self) -> Iterator[tuple[str, str]]:
        """The counterbore stays below the upper surface."""
        if self.counterbore_depth >= self.thickness:
            yield (
                "counterbore_depth",
                f"must be less than the thickness {self.thickness:g}, got {self.counterbore_depth:g}",
            )

    def check(self, m: Machine) -> Iterator[tuple[str, str]]:
        """A hole along the spindle."""
        yield from tilted(m)

    def moves(self, m: Machine) -> None:
        """Steps 1 to 6 of the manual; levels are those of the end of the bar."""
        turning = m.turning
        lower = self.surface - self.thickness - self.edge_height
        end = self.approach(m)
        steps = back_bore(
            above=self.level, below=lower - self.clearance, bottom=lower + self.counterbore_depth,
            eccentricity=self.eccentricity, direction=int(self.disengage), angle=self.spindle_angle,
            feed=self.feed, travel=self.positioning_feed, dwell=self.dwell_bottom, turning=turning or 1,
        )  # fmt: skip
        perform(m, self.code, chain(with_the_spindle(m, steps), back_to_axis(end, turning, "to the start point")))


@CYCLES("G306, G208", "Bore milling", runs="call", source="MNC 9.9")
class BoreMilling(PreparedCycle):
    """Mills a hole on a helix from the clearance level, with a full circle at the bottom."""

    does: ClassVar[str] = MILLS

    depth: float = depth("depth from the surface to the bottom")
    feed: float | None = feed("feed on the helix")
    pitch: float = param("P", "infeed per turn", above=0, incremental=True, example=3)
    diameter: float = param("D", "hole diameter", above=0, example=12)
    predrilled_diameter: float = param(
        "C", "diameter of the hole drilled before", default=0, at_least=0, example=0,
        note="above 0 the hole may be wider than twice the tool",
    )  # fmt: skip
    milling_mode: float = param("L", "kind of milling with M3", "choice", default=1, choices=MODE, example=1)

    def contradictions(self) -> Iterator[tuple[str, str]]:
        """The hole drilled before is narrower; no more turns than a hole can have."""
        if self.predrilled_diameter >= self.diameter:
            yield "predrilled_diameter", f"must be less than D {self.diameter:g}, got {self.predrilled_diameter:g}"
        yield from too_many("pitch", lambda: turns(self.clearance - self.depth, self.pitch))

    def check(self, m: Machine) -> Iterator[tuple[str, str]]:
        """The hole is not narrower than the tool, and leaves no core where none was drilled out."""
        tool = 2 * m.radius
        if self.diameter < tool:
            yield "diameter", f"must be at least the tool diameter {tool:g}, got {self.diameter:g}"
        if not self.predrilled_diameter and self.diameter > 2 * tool:
            yield (
                "diameter",
                f"must be at most twice the tool diameter {tool:g}, got {self.diameter:g}: a core would remain",
            )
        inner = self.diameter - 2 * tool
        if m.cycle and 0 < self.predrilled_diameter < inner and m.cycle.extra.setdefault("ring", tool) == tool:
            m.cycle.extra["ring"] = None  # once is enough
            word = m.cycle.words["predrilled_diameter"]
            ring = f"{self.code} C {self.predrilled_diameter:g} leaves a ring: the tool reaches in to {inner:g}"
            m.warn(ring + remark(m), word)

    def moves(self, m: Machine) -> None:
        """Steps 1 to 5 of the manual."""
        end = self.approach(m)
        steps = bore_milling(
            self.surface + self.depth, above=self.level, radius=self.diameter / 2 - m.radius, pitch=self.pitch,
            sense=-1 if self.milling_mode < 0 else 1, feed=self.feed,
        )  # fmt: skip
        perform(m, self.code, steps)
        self.leave(m, end)
