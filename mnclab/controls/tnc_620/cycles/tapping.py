"""Tapping (chapter 5.2 to 5.4): cycle 206 with a floating tap holder, 207 and 209 with the spindle locked to the feed."""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Iterable, Iterator, Sequence
from typing import Any

from mnclab.controls.tnc_620.cycles import addresses
from mnclab.controls.tnc_620.cycles.addresses import FAST, ratio
from mnclab.controls.tnc_620.cycles.faults import Fault, not_zero, oriented
from mnclab.controls.tnc_620.cycles.planes import AtSurface
from mnclab.machine.cycle import CycleTable, too_many
from mnclab.machine.machine import Machine
from mnclab.machine.true_size import TAPS
from mnclab.machining.depths import infeeds
from mnclab.machining.holes.tapping import tap
from mnclab.machining.steps import Go, Spin, Step, Write

CYCLES = CycleTable()
ROUNDED = 0.001  # mm; pitches that differ by no more are the same, for F and S are entered rounded


def pitch_of(m: Machine, name: str, pitch: float) -> Iterator[Fault]:
    """A fault where the tool table has another pitch for the tap."""
    if m.tool.pitch and abs(m.tool.pitch - pitch) > ROUNDED:
        yield name, f"means a pitch of {pitch:g} mm, the tap of tool {m.tool.number} has {m.tool.pitch:g} mm (PITCH)"


class Tapping(AtSurface):
    """What the three cycles share."""

    does = TAPS
    works = ("thread_depth",)

    thread_depth: float

    @property
    def bottom(self) -> float:
        return self.surface + self.thread_depth

    def check(self, m: Machine) -> Iterator[Fault]:
        """The sign of the depth, and what the thread needs; nothing where the depth is 0, for then nothing is done."""
        if self.thread_depth:
            yield from self.signs(m)
            yield from self.needs(m)

    @abstractmethod
    def needs(self, m: Machine) -> Iterator[Fault]:
        """What one of the cycles needs to run."""

    @abstractmethod
    def steps(self, m: Machine) -> Iterator[Step]:
        """From the set-up plane into the thread and back to it."""

    def moves(self, m: Machine) -> Iterable[Step]:
        if not self.down:
            return [self.left_out]
        again = Spin("spindle on again", m.turning, m.speed)
        return [Go("to the set-up clearance", self.above), *self.steps(m), *self.leave(), again]


@CYCLES("CYCL DEF 206", "Tapping with a floating tap holder", source="5.2")
class FloatingTapping(Tapping):
    """Taps at a feed in one pass with the spindle as it turns, reversed at the bottom and again at the set-up clearance."""

    clearance: float = addresses.clearance(example=2, note="about four pitches")
    thread_depth: float = addresses.thread_depth(example=-20)
    tapping_feed: float = addresses.feed("Q206", "feed rate for tapping", also=("FAUTO",), note="S times pitch", example=150)
    dwell_bottom: float = addresses.dwell_bottom(note="0 to 0.5 s, so that the tap does not jam", example=0.25)
    surface: float = addresses.surface(example=0)
    second_clearance: float = addresses.second_clearance(example=50)

    def needs(self, m: Machine) -> Iterator[Fault]:
        yield from not_zero(self, "tapping_feed")
        if not m.spindle_speed:
            yield "", "needs a turning spindle: write S in TOOL CALL, and M3 or M4 before"
        yield from pitch_of(m, "tapping_feed", self.tapping_feed / m.speed)

    def steps(self, m: Machine) -> Iterator[Step]:
        return tap(
            [self.bottom], above=self.above, sense=m.turning, end=m.turning, feed=self.tapping_feed, dwell=self.dwell_bottom,
            dwell_first=False, stand=m.settings["thread_wait"],
        )  # fmt: skip


class RigidTapping(Tapping):
    """What 207 and 209 share: the sign of the pitch is the hand, whatever way the spindle turned before."""

    own_spindle = True
    pitch: float

    def needs(self, m: Machine) -> Iterator[Fault]:
        if self.pitch == 0:
            yield "pitch", "must not be 0"
        if not m.speed:
            yield "", "needs a spindle speed: write S in TOOL CALL"
        yield from oriented(m)
        yield from pitch_of(m, "pitch", abs(self.pitch))

    def locked(self, m: Machine, levels: Sequence[float], **more: Any) -> Iterator[Step]:
        """The spindle turns as M3 for a right-hand thread, as M4 for a left-hand one, and stops."""
        stand, lead = m.settings["thread_wait"], abs(self.pitch)
        return tap(levels, above=self.above, pitch=lead, sense=1 if self.pitch > 0 else -1, end=0, stand=stand, **more)


@CYCLES("CYCL DEF 207", "Rigid tapping", source="5.3")
class RigidTappingInOnePass(RigidTapping):
    """Taps in one pass with the spindle locked to the feed; afterwards it turns as before the cycle."""

    clearance: float = addresses.clearance(example=2)
    thread_depth: float = addresses.thread_depth(example=-20)
    pitch: float = addresses.pitch()
    surface: float = addresses.surface(example=0)
    second_clearance: float = addresses.second_clearance(example=50)

    def steps(self, m: Machine) -> Iterator[Step]:
        return self.locked(m, [self.bottom])


@CYCLES("CYCL DEF 209", "Tapping with chip breaking", source="5.4")
class ChipBreakingTapping(RigidTapping):
    """Taps in several passes in phase, with the spindle locked to the feed and oriented before the first of them."""

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

    def needs(self, m: Machine) -> Iterator[Fault]:
        yield from super().needs(m)
        yield from too_many("chip_breaking_depth", self.levels)

    def levels(self) -> tuple[float, ...]:
        return infeeds(self.surface, self.bottom, self.chip_breaking_depth or None)

    def steps(self, m: Machine) -> Iterator[Step]:
        yield Write("memory", self.spindle_angle, "orientation")
        back, out = self.chip_breaking_retract_factor * abs(self.pitch), self.retract_rpm_factor * m.speed
        yield from self.locked(
            m, self.levels(), speed=m.speed, out_speed=min(out, m.setup.limits.spindle), back=back, angle=self.spindle_angle
        )
