"""Tapping (chapter 5.2 to 5.4): cycle 206 with a floating tap holder, 207 and 209 with the spindle locked to the feed."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from typing import Any, Union

from mnclab.controls.tnc_620.cycles import addresses
from mnclab.controls.tnc_620.cycles.addresses import FAST, ratio
from mnclab.controls.tnc_620.cycles.planes import AtSurface, Fault, not_zero, oriented
from mnclab.machine.coordinates import TAPS
from mnclab.machine.cycle import CycleTable, too_many
from mnclab.machine.machine import Machine
from mnclab.machining.depths import infeeds
from mnclab.machining.holes import tap
from mnclab.machining.steps import Go, Spin, Step, Write

CYCLES = CycleTable()
RigidTapping = Union["RigidTappingInOnePass", "ChipBreakingTapping"]
ROUNDED = 0.001  # mm; pitches that differ by no more are the same, for F and S are entered rounded


def pitch_of(m: Machine, name: str, pitch: float) -> Iterator[Fault]:
    """A fault where the tool table has another pitch for the tap."""
    if m.tool.pitch and abs(m.tool.pitch - pitch) > ROUNDED:
        yield name, f"means a pitch of {pitch:g} mm, the tap of tool {m.tool.number} has {m.tool.pitch:g} mm (PITCH)"


def sunk(c: AtSurface, m: Machine) -> Iterable[Step]:
    """`moves` of the three: to the set-up plane, the thread, away; then the spindle turns as before the cycle."""
    if not c.down:
        return [c.left_out]
    again = Spin("spindle on again", m.turning, m.speed)
    return [Go("to the set-up clearance", c.above), *c.steps(m), *c.leave(), again]


def rigid(c: RigidTapping, m: Machine) -> Iterator[Fault]:
    """`check` of 207 and 209; nothing where the depth is 0, for then nothing is done."""
    if not c.thread_depth:
        return
    yield from c.signs(m)
    if c.pitch == 0:
        yield "pitch", "must not be 0"
    if not m.speed:
        yield "", "needs a spindle speed: write S in TOOL CALL"
    yield from oriented(m)
    yield from pitch_of(m, "pitch", abs(c.pitch))


def locked(c: RigidTapping, m: Machine, levels: Sequence[float], **more: Any) -> Iterator[Step]:
    """The spindle turns as M3 for a right-hand thread, as M4 for a left-hand one, and stops."""
    stand, lead = m.settings["thread_wait"], abs(c.pitch)
    return tap(levels, above=c.above, pitch=lead, sense=1 if c.pitch > 0 else -1, end=0, stand=stand, **more)


@CYCLES("CYCL DEF 206", "Tapping with a floating tap holder", source="5.2")
class FloatingTapping(AtSurface):
    """Taps at a feed in one pass with the spindle as it turns, reversed at the bottom and again at the set-up clearance."""

    does, works = TAPS, ("thread_depth",)
    clearance: float = addresses.clearance(example=2, note="about four pitches")
    thread_depth: float = addresses.thread_depth(example=-20)
    tapping_feed: float = addresses.feed("Q206", "feed rate for tapping", also=("FAUTO",), note="S times pitch", example=150)
    dwell_bottom: float = addresses.dwell_bottom(note="0 to 0.5 s, so that the tap does not jam", example=0.25)
    surface: float = addresses.surface(example=0)
    second_clearance: float = addresses.second_clearance(example=50)

    moves = sunk

    def check(self, m: Machine) -> Iterator[Fault]:
        """Nothing where the depth is 0, for then nothing is done."""
        if not self.thread_depth:
            return
        yield from self.signs(m)
        yield from not_zero(self, "tapping_feed")
        if not m.spindle_speed:
            yield "", "needs a turning spindle: write S in TOOL CALL, and M3 or M4 before"
        yield from pitch_of(m, "tapping_feed", self.tapping_feed / m.speed)

    def steps(self, m: Machine) -> Iterator[Step]:
        return tap(
            [self.surface + self.thread_depth], above=self.above, sense=m.turning, end=m.turning, feed=self.tapping_feed,
            dwell=self.dwell_bottom, dwell_first=False, stand=m.settings["thread_wait"],
        )  # fmt: skip


@CYCLES("CYCL DEF 207", "Rigid tapping", source="5.3")
class RigidTappingInOnePass(AtSurface):
    """Taps in one pass with the spindle locked to the feed; afterwards it turns as before the cycle."""

    does, own_spindle, works = TAPS, True, ("thread_depth",)
    clearance: float = addresses.clearance(example=2)
    thread_depth: float = addresses.thread_depth(example=-20)
    pitch: float = addresses.pitch()
    surface: float = addresses.surface(example=0)
    second_clearance: float = addresses.second_clearance(example=50)

    check, moves = rigid, sunk

    def steps(self, m: Machine) -> Iterator[Step]:
        return locked(self, m, [self.surface + self.thread_depth])


@CYCLES("CYCL DEF 209", "Tapping with chip breaking", source="5.4")
class ChipBreakingTapping(AtSurface):
    """Taps in several passes in phase, with the spindle locked to the feed and oriented before the first of them."""

    does, own_spindle, works = TAPS, True, ("thread_depth",)
    clearance: float = addresses.clearance(example=2)
    thread_depth: float = addresses.thread_depth(example=-20)
    pitch: float = addresses.pitch()
    surface: float = addresses.surface(example=0)
    second_clearance: float = addresses.second_clearance(example=50)
    chip_breaking_depth: float = addresses.break_every(note="0: in one pass")
    chip_breaking_retract_factor: float = ratio(
        "Q256", "retraction for chip breaking, in pitches", at_least=0, at_most=FAST, note="0: out of the hole", example=1
    )
    spindle_angle: float = addresses.spindle_angle(meaning="angle of the spindle before tapping", example=50)
    retract_rpm_factor: float = ratio("Q403", "factor of the speed for retracting", at_most=10, example=1.5)

    moves = sunk

    def check(self, m: Machine) -> Iterator[Fault]:
        yield from rigid(self, m)
        if self.thread_depth:
            yield from too_many("chip_breaking_depth", self.passes)

    def passes(self) -> tuple[float, ...]:
        return infeeds(self.surface, self.surface + self.thread_depth, self.chip_breaking_depth or None)

    def steps(self, m: Machine) -> Iterator[Step]:
        yield Write("memory", self.spindle_angle, "orientation")
        back, out = self.chip_breaking_retract_factor * abs(self.pitch), self.retract_rpm_factor * m.speed
        yield from locked(
            self, m, self.passes(), speed=m.speed, out_speed=min(out, m.setup.limits.spindle), back=back, angle=self.spindle_angle
        )
