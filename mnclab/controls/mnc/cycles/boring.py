"""Reaming, boring, back boring and bore milling (MNC, 9.5, 9.6, 9.8, 9.9): G301, G302, G304 and G306, called by M99."""

from __future__ import annotations

from collections.abc import Iterator
from typing import ClassVar

import numpy as np

from mnclab.controls.mnc.cycles import addresses
from mnclab.controls.mnc.cycles.prepared import PreparedCycle, called
from mnclab.machine.coordinates import MILLS, SHIFTS, remark, with_the_spindle
from mnclab.machine.cycle import CycleTable, param, too_many
from mnclab.machine.machine import Machine
from mnclab.machining.holes.drilling import back_bore, bore, ream
from mnclab.machining.holes.helical import bore_milling, turns
from mnclab.machining.steps import Say, Step

CYCLES = CycleTable()

DISENGAGE: dict[float, str] = {0: "not at all", 1: "in -X", 2: "in -Y", 3: "in +X", 4: "in +Y"}
SHIFT = {choice: where for choice, where in DISENGAGE.items() if choice}
MODE: dict[float, str] = {1: "climb (counter-clockwise)", -1: "conventional (clockwise)", 0: "as 1"}


def tilted(m: Machine) -> Iterator[tuple[str, str]]:
    """A fault where the hole does not lie along the oriented spindle."""
    if np.abs(m.frames.matrix[:2, 2]).max() > 1e-9:
        yield "disengage", "needs a hole along the spindle: G39 outside of G17 tilts it"


@CYCLES("G301, G201", "Reaming", runs="call", source="MNC 9.5")
class Reaming(PreparedCycle):
    """In and out at feed."""

    clearance: float = addresses.clearance()
    depth: float = addresses.depth()
    surface: float = addresses.surface()
    feed: float | None = addresses.feed("reaming feed")
    retract_feed: float | None = addresses.other_feed("V", "return feed", 400)
    dwell_bottom: float = addresses.dwell_bottom()

    def moves(self, m: Machine) -> Iterator[Step]:
        bottom, out = self.surface + self.depth, self.retract_feed or self.feed
        work = ream(bottom, above=self.level, feed=self.feed, retract=out, dwell=self.dwell_bottom)
        return called(m, self.level, work)


@CYCLES("G302, G202", "Boring with oriented spindle", runs="call", source="MNC 9.6")
class Boring(PreparedCycle):
    """Bores, stops the spindle at an angle, moves 0.2 mm off the wall and withdraws; no frame turns D or changes 0.2 mm."""

    clearance: float = addresses.clearance()
    depth: float = addresses.depth()
    surface: float = addresses.surface()
    feed: float | None = addresses.feed("boring feed")
    retract_feed: float | None = addresses.other_feed("V", "feed out of the hole", 400)
    dwell_bottom: float = addresses.dwell_bottom()
    disengage: float = addresses.choice("D", "direction in which the tool leaves the wall", DISENGAGE, 1, default=0)
    spindle_angle: float = addresses.angle("A", "spindle angle for the withdrawal", 30)

    def check(self, m: Machine) -> Iterator[tuple[str, str]]:
        if self.disengage:
            yield from tilted(m)

    def moves(self, m: Machine) -> Iterator[Step]:
        """Steps 1 to 6 of the manual; the spindle turns again as before, for the next call."""
        work = bore(
            self.surface + self.depth, above=self.level, feed=self.feed, retract=self.retract_feed or self.feed,
            dwell=self.dwell_bottom, angle=self.spindle_angle, direction=int(self.disengage),
        )  # fmt: skip
        return called(m, self.level, with_the_spindle(m, work), shifted=True)


@CYCLES("G304, G204", "Back boring", runs="call", source="MNC 9.8")
class BackBoring(PreparedCycle):
    """Counterbores from below, with a bar that goes through the hole off its axis."""

    does: ClassVar[str] = SHIFTS

    clearance: float = addresses.clearance()
    surface: float = addresses.surface()
    counterbore_depth: float = addresses.distance("H", "depth of the counterbore from the lower surface", 5)
    thickness: float = addresses.distance("B", "material thickness", 20)
    eccentricity: float = addresses.distance("E", "off-centre distance of the tool", 3.5)
    edge_height: float = addresses.distance("L", "height of the edge above the end of the bar", 12)
    positioning_feed: float = addresses.own_feed("V", "feed into and out of the workpiece", 750)
    feed: float | None = addresses.feed("counterboring feed")
    dwell_bottom: float = addresses.dwell_bottom()
    disengage: float = addresses.choice("D", "direction of the shift off the axis", SHIFT, 1)
    spindle_angle: float = addresses.angle("A", "spindle angle for entry and exit", 30)

    def contradictions(self) -> Iterator[tuple[str, str]]:
        depth, thickness = self.counterbore_depth, self.thickness
        if depth >= thickness:
            yield "counterbore_depth", f"must be less than the thickness {thickness:g}, got {depth:g}"

    def check(self, m: Machine) -> Iterator[tuple[str, str]]:
        return tilted(m)

    def moves(self, m: Machine) -> Iterator[Step]:
        """Steps 1 to 6 of the manual; levels are those of the end of the bar."""
        lower = self.surface - self.thickness - self.edge_height
        work = back_bore(
            above=self.level, below=lower - self.clearance, bottom=lower + self.counterbore_depth,
            eccentricity=self.eccentricity, direction=int(self.disengage), angle=self.spindle_angle,
            feed=self.feed, travel=self.positioning_feed, dwell=self.dwell_bottom, turning=m.turning or 1,
        )  # fmt: skip
        return called(m, self.level, with_the_spindle(m, work), shifted=True)


@CYCLES("G306, G208", "Bore milling", runs="call", source="MNC 9.9")
class BoreMilling(PreparedCycle):
    """Mills a hole on a helix from the clearance level, with a full circle at the bottom."""

    does: ClassVar[str] = MILLS

    clearance: float = addresses.clearance()
    depth: float = addresses.depth()
    surface: float = addresses.surface()
    feed: float | None = addresses.feed("feed on the helix")
    pitch: float = addresses.distance("P", "infeed per turn", 3)
    diameter: float = param("D", "hole diameter", above=0, example=12)
    predrilled_diameter: float = param(
        "C", "diameter of the hole drilled before", default=0, at_least=0, example=0,
        note="above 0 the hole may be wider than twice the tool",
    )  # fmt: skip
    milling_mode: float = addresses.choice("L", "kind of milling with M3", MODE, 1, default=1)

    def contradictions(self) -> Iterator[tuple[str, str]]:
        if self.predrilled_diameter >= self.diameter:
            yield "predrilled_diameter", f"must be less than D {self.diameter:g}, got {self.predrilled_diameter:g}"
        yield from too_many("pitch", lambda: turns(self.clearance - self.depth, self.pitch))

    def check(self, m: Machine) -> Iterator[tuple[str, str]]:
        tool = 2 * m.radius
        if self.diameter < tool:
            yield "diameter", f"must be at least the tool diameter {tool:g}, got {self.diameter:g}"
        if not self.predrilled_diameter and self.diameter > 2 * tool:
            most = f"twice the tool diameter {tool:g}, got {self.diameter:g}"
            yield "diameter", f"must be at most {most}: a core would remain"

    def moves(self, m: Machine) -> Iterator[Step]:
        inner = self.diameter - 4 * m.radius
        if m.cycle and 0 < self.predrilled_diameter < inner:
            ring = f"C {self.predrilled_diameter:g} leaves a ring: the tool reaches in to {inner:g}"
            yield Say(ring + remark(m), word=m.cycle.words["predrilled_diameter"])
        work = bore_milling(
            self.surface + self.depth, above=self.level, radius=self.diameter / 2 - m.radius, pitch=self.pitch,
            sense=-1 if self.milling_mode < 0 else 1, feed=self.feed,
        )  # fmt: skip
        yield from called(m, self.level, work)
