"""Obsolete cycles of holes, which still run (1.2): pecking 1, tapping with a floating holder 2 and rigidly 17.

They are those of earlier manuals (TNC 407 8.2, TNC 426/430 8.3). Readings where these are silent: under a scale the advanced
stop distance of pecking is that of the true depth; rigid tapping is one pass.
"""

from __future__ import annotations

from collections.abc import Iterator

from mnclab.controls.tnc_620.cycles import addresses, at_clearance
from mnclab.controls.tnc_620.cycles.at_clearance import AtClearance
from mnclab.controls.tnc_620.cycles.faults import Fault, not_zero, oriented
from mnclab.controls.tnc_620.cycles.tapping import pitch_of
from mnclab.machine.coordinates import TAPS, depth_scale
from mnclab.machine.cycle import CycleTable, param
from mnclab.machine.machine import Machine
from mnclab.machining.holes.drilling import drill
from mnclab.machining.holes.tapping import tap
from mnclab.machining.steps import Go, Step, Write

CYCLES = CycleTable()


def advanced_stop(depth: float) -> float:
    """How far above the last depth a peck is entered again, mm: 0.6 to a depth of 30 mm, then a fiftieth of it, at most 7.

    >>> [round(advanced_stop(depth), 3) for depth in (20, 30, 40, 400)]
    [0.6, 0.6, 0.8, 7.0]
    """
    return 0.6 if depth <= 30 else min(depth / 50, 7.0)


@CYCLES("CYCL DEF 1", "Pecking", source="1.2")
class Pecking(AtClearance):
    """Drills in infeeds with full retraction to where the tool stood, and waits at the bottom.

    Written as 1.1 SET UP, 1.2 DEPTH, 1.3 PECKG, 1.4 DWELL, 1.5 F.
    """

    clearance: float = at_clearance.clearance()
    depth: float = at_clearance.depth()
    infeed: float = at_clearance.infeed()
    dwell: float = addresses.seconds("DWELL", "dwell at the bottom", example=0.25)
    feed: float = at_clearance.feed("F", "feed rate for drilling", example=150)

    def fits(self, m: Machine) -> Iterator[Fault]:
        return not_zero(self, "feed", purpose="to drill with")

    def moves(self, m: Machine) -> Iterator[Step]:
        if not self.down:
            yield self.left_out
            return
        above, scale = m.programmed[2], depth_scale(m)
        stop = advanced_stop(abs(self.depth) * scale) / scale
        yield from drill(self.levels(m), above=above, feed=self.feed, reenter=stop, dwell_bottom=self.dwell)
        yield Go("retract", above)


@CYCLES("CYCL DEF 2", "Tapping with a floating holder", source="1.2")
class FloatingTapping(AtClearance):
    """Taps at a feed in one pass with the spindle as it turns, reversed at the bottom and where the tool stood.

    Written as 2.1 SET UP, 2.2 DEPTH, 2.3 DWELL, 2.4 F.
    """

    does = TAPS
    clearance: float = at_clearance.clearance(note="about four pitches")
    depth: float = at_clearance.depth()
    dwell: float = addresses.seconds("DWELL", "dwell at the bottom", note="0 to 0.5 s", example=0.25)
    feed: float = at_clearance.feed("F", "feed rate for tapping", note="S times pitch", example=150)

    def fits(self, m: Machine) -> Iterator[Fault]:
        yield from not_zero(self, "feed")
        if not m.spindle_speed:
            yield "", "needs a turning spindle: write S in TOOL CALL, and M3 or M4 before"
        yield from pitch_of(m, "feed", self.feed / m.speed)

    def moves(self, m: Machine) -> Iterator[Step]:
        if not self.down:
            yield self.left_out
            return
        yield from tap(
            self.levels(m), above=m.programmed[2], sense=m.turning, end=m.turning, feed=self.feed, dwell=self.dwell,
            dwell_first=False, stand=m.settings["thread_wait"],
        )  # fmt: skip


@CYCLES("CYCL DEF 17", "Rigid tapping", source="1.2")
class RigidTapping(AtClearance):
    """Taps with the spindle locked to the feed; it stops at the end, and M3 or M4 starts it again.

    Written as 17.1 SET UP, 17.2 DEPTH, 17.3 PITCH.
    """

    does, own_spindle = TAPS, True
    clearance: float = at_clearance.clearance()
    depth: float = at_clearance.depth()
    pitch: float = param(
        "PITCH", "thread pitch", at_least=-99.9999, at_most=99.9999, modal=True, note="+ right-hand, - left-hand", example=1.5
    )

    def fits(self, m: Machine) -> Iterator[Fault]:
        if self.pitch == 0:
            yield "pitch", "must not be 0"
        if not m.speed:
            yield "", "needs a spindle speed: write S in TOOL CALL"
        yield from oriented(m)
        yield from pitch_of(m, "pitch", abs(self.pitch))

    def moves(self, m: Machine) -> Iterator[Step]:
        if not self.down:
            yield self.left_out
            return
        yield from tap(
            self.levels(m), above=m.programmed[2], pitch=abs(self.pitch), sense=1 if self.pitch > 0 else -1, end=0,
            stand=m.settings["thread_wait"],
        )  # fmt: skip
        yield Write("modal", "M5", "spindle")
