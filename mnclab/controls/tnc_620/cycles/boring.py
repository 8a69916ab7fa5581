"""Boring, back boring and bore milling (4.5, 4.7, 4.9): cycles 202, 204 and 208.

Both boring cycles stop the spindle at an angle; afterwards it turns as before the call, and the coolant is as it was.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from itertools import chain

from mnclab.controls.tnc_620.cycles import addresses
from mnclab.controls.tnc_620.cycles.addresses import distance, increment, length, seconds
from mnclab.controls.tnc_620.cycles.chain import MIRROR
from mnclab.controls.tnc_620.cycles.faults import Fault, not_zero, oriented
from mnclab.controls.tnc_620.cycles.planes import AtSurface, rate
from mnclab.machine.coordinates import MILLS, SHIFTS, tool, with_the_spindle
from mnclab.machine.cycle import CycleTable, too_many
from mnclab.machine.machine import Machine
from mnclab.machining.depths import DRIFT
from mnclab.machining.holes.drilling import back_bore, back_to_axis, bore
from mnclab.machining.holes.helical import bore_milling, steepest_pitch, turns
from mnclab.machining.steps import Say, Step, Write

CYCLES = CycleTable()


def as_if_not_mirrored(m: Machine, steps: Iterable[Step]) -> Iterator[Step]:
    """Steps off the axis go where they would without a mirror image; shifts and rotations count (4.5, 4.7)."""
    plain = m.frames.copy()
    for name, _ in m.frames:
        if name.startswith(MIRROR):  # before the tilt or behind it
            plain.set(name, None)
    return with_the_spindle(m, steps, plain.matrix)


@CYCLES("CYCL DEF 202", "Boring", source="4.5")
class Boring(AtSurface):
    """Bores, stops the spindle at an angle, moves 0.2 mm off the wall and withdraws; ends on the axis of the hole."""

    clearance: float = addresses.clearance()
    depth: float = addresses.depth()
    feed: float = addresses.plunge_feed()
    dwell_bottom: float = addresses.dwell_bottom()
    retract_feed: float | str = addresses.retract_feed()
    surface: float = addresses.surface()
    second_clearance: float = addresses.second_clearance()
    disengage: float = addresses.disengage()
    spindle_angle: float = addresses.spindle_angle()

    def check(self, m: Machine) -> Iterator[Fault]:
        yield from oriented(m)
        yield from super().check(m)

    def steps(self, m: Machine) -> Iterator[Step]:
        yield Write("memory", self.spindle_angle, "orientation")
        bored = bore(
            self.bottom(m), above=self.above, feed=self.feed, retract=rate(self.retract_feed, self.feed),
            dwell=self.dwell_bottom, angle=self.spindle_angle, direction=int(self.disengage),
        )  # fmt: skip
        yield from as_if_not_mirrored(m, chain(bored, back_to_axis(self.end, m.turning)))


@CYCLES("CYCL DEF 204", "Back boring", source="4.7")
class BackBoring(AtSurface):
    """Counterbores from below, with a bar that goes through the hole off its axis.

    Levels count for the lower end of the bar; its edge is Q252 above that.
    """

    does = SHIFTS
    clearance: float = addresses.clearance()
    counterbore_depth: float = increment(
        "Q249", "depth of the counterbore", note="from the lower surface; positive is up", example=5
    )
    thickness: float = distance("Q250", "thickness of the workpiece", at_least=0.0001, example=20)
    eccentricity: float = distance("Q251", "off-centre distance of the bar", at_least=0.0001, example=3.5)
    edge_height: float = distance("Q252", "height of the edge above the end of the bar", at_least=0.0001, example=15)
    positioning_feed: float | str = addresses.positioning_feed()
    feed: float = addresses.countersinking_feed(meaning="feed rate for counterboring", example=200)
    dwell_bottom: float = seconds("Q255", "dwell at the bottom of the counterbore", example=0.5)
    surface: float = addresses.surface()
    second_clearance: float = addresses.second_clearance()
    disengage: float = addresses.disengage(shift=True)
    spindle_angle: float = addresses.spindle_angle()

    def depths(self) -> dict[str, float]:
        """The counterbore goes up from below, but the bar comes from above as in every hole."""
        return {"counterbore_depth": -self.counterbore_depth}

    def check(self, m: Machine) -> Iterator[Fault]:
        yield from oriented(m)
        if self.counterbore_depth < 0:
            yield "counterbore_depth", f"must not be negative, got {self.counterbore_depth:g}"
        if self.counterbore_depth >= self.thickness:
            yield "counterbore_depth", f"must be less than Q250 = {self.thickness:g}, got {self.counterbore_depth:g}"
        yield from not_zero(self, "feed", purpose="to bore with")
        yield from not_zero(self, "positioning_feed", purpose="to position with")

    def steps(self, m: Machine) -> Iterator[Step]:
        yield Write("memory", self.spindle_angle, "orientation")
        lower = self.surface - self.thickness - self.edge_height
        bored = back_bore(
            above=self.above, below=lower - self.clearance, bottom=lower + self.counterbore_depth,
            eccentricity=self.eccentricity, direction=int(self.disengage), angle=self.spindle_angle, feed=self.feed,
            travel=rate(self.positioning_feed), dwell=self.dwell_bottom, turning=m.turning or 1,
            coolant=m.modal.get("coolant") == "M9",
        )  # fmt: skip
        yield from as_if_not_mirrored(m, chain(bored, back_to_axis(self.end, m.turning)))


@CYCLES("CYCL DEF 208", "Bore milling", source="4.9")
class BoreMilling(AtSurface):
    """Mills a hole on a helix from the set-up plane, with a full circle at the bottom; as wide as the tool it drills it.

    The infeed per turn is reduced where the plunge angle of the tool (ANGLE) demands it. A mirrored plane does not change
    climb into up-cut milling.
    """

    does = MILLS
    clearance: float = addresses.clearance()
    depth: float = addresses.depth()
    feed: float = addresses.plunge_feed(also=("FAUTO", "FU", "FZ"))
    pitch: float = distance("Q334", "infeed per turn of the helix", example=1.5)
    surface: float = addresses.surface()
    second_clearance: float = addresses.second_clearance()
    diameter: float = length("Q335", "diameter of the bore", example=14)
    roughing_diameter: float = length(
        "Q342", "diameter roughed before", note="above 0 the bore may be wider than twice the tool", example=0
    )
    climb: float = addresses.climb(example=1)

    def check(self, m: Machine) -> Iterator[Fault]:
        yield from super().check(m)
        size = 2 * m.radius
        if self.radius(m) < 0:
            yield "diameter", f"must be at least the tool diameter {size:g}, got {self.diameter:g}"
        if not self.roughing_diameter and self.diameter > 2 * size + DRIFT:
            yield "diameter", f"must be at most twice the tool diameter {size:g} while Q342 is 0, got {self.diameter:g}"
        if self.radius(m):
            yield from not_zero(self, "pitch", purpose="to mill with")
            yield from too_many("pitch", lambda: turns(self.clearance + abs(self.depth), self.pitch_on(m)))

    def radius(self, m: Machine) -> float:
        """Of the path of the tool centre; 0 where the bore is as wide as the tool."""
        radius = self.diameter / 2 - m.radius
        return 0.0 if abs(radius) < DRIFT else radius

    def pitch_on(self, m: Machine) -> float:
        """The infeed per turn that the tool allows."""
        return min(self.pitch, steepest_pitch(self.radius(m), tool(m).plunge_angle))

    def steps(self, m: Machine) -> Iterator[Step]:
        pitch, sense = self.pitch_on(m), -1 if self.climb < 0 else 1
        if pitch < self.pitch and self.radius(m):
            allowed = f"the plunge angle {m.tool.plunge_angle:g} of tool {m.tool.number} allows {pitch:.4g}"
            yield Say(f"Q334 {self.pitch:g} is reduced: {allowed}", word=m.cycle and m.cycle.words.get("pitch"))
        yield from bore_milling(
            self.bottom(m), above=self.above, radius=self.radius(m), pitch=pitch, sense=sense * m.orientation,
            feed=self.feed, by_arc=True,
        )  # fmt: skip
        yield from (step._replace(x=0.0, y=0.0) for step in self.leave())  # turns end near the axis, not on it
