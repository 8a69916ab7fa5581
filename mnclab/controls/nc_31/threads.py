"""Threads: the cycle of passes G31, one threading move G32, tapping G33 (source, 3.20.12 to 3.20.14).

F is the pitch, 0.0001 mm; left out, it is the feed that is active. A start at the zero mark of the spindle has no column
in a path: the label says it.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator

from mnclab.controls.nc_31 import functions
from mnclab.controls.nc_31.cycles import FROM_START, FromStart, apart, aside, feed_word, here, own_mark, size, start
from mnclab.controls.nc_31.functions import refuse_rapid, targets
from mnclab.machine.control import FunctionTable, Words
from mnclab.machine.cycle import CycleTable, param, too_many
from mnclab.machine.machine import Machine
from mnclab.machining.depths import infeeds
from mnclab.machining.holes import tap
from mnclab.machining.steps import Go, Step, Thread
from mnclab.machining.turning.threading import lead_along, thread_passes
from mnclab.text.program import INCREMENTAL, RAPID_MARK

CYCLES = CycleTable()
FUNCTIONS = FunctionTable()

SAME = "the modal feed"
ONE_PASS = {"default": None, "default_means": "a single pass at X", "above": 0}


def pitch_of(m: Machine, feed: float | None) -> float:
    """The pitch, mm: F, or the modal feed (there is one, as `needs_pitch` has seen)."""
    return float(m.feed or 0.0) if feed is None else feed / functions.CYCLE_FEED


def needs_pitch(m: Machine, feed: float | None) -> Iterator[tuple[str, str]]:
    """Neither F nor a modal feed; a spindle that stands."""
    if feed is None and m.feed is None:
        yield "", "needs a pitch: F here, or a feed before it"
    if not m.spindle_speed:
        yield "", "needs a turning spindle: write S before it"


@CYCLES("G31", "Thread cutting in passes", runs="definition", source="NC-31 3.20.12")
class ThreadCutting(FromStart):
    """Passes of P2 down to the depth P1 below the diameter X, the last one the rest; without P one pass at X itself.

    A start outside X cuts an external thread, one inside X an internal one. Each pass starts at the zero mark of the
    spindle: in at Z1, along Z locked to the spindle, out, back. With the taper P3 the thread is that much deeper at the
    start, and X counts at its end. Machine parameter 6 is the infeed angle (passes begin shifted towards the end),
    parameter 7 the run-out at the end in tenths of the pitch.
    """

    x: float = param("X", "crest diameter, or root with no P", "0.01 mm on diameter", note=FROM_START, example=3600)
    z: float = param("Z", "end of the thread", "0.01 mm", note=FROM_START, example=-3000)
    feed: float | None = feed_word("pitch", "0.0001 mm", SAME, 15_000)
    thread_depth: float | None = size("depth of the thread", "0.01 mm on radius", **ONE_PASS, example=92)
    depth_per_pass: float | None = size("depth of cut per pass", "0.01 mm on radius", **ONE_PASS, example=25)
    taper: float = size("taper", "0.01 mm on diameter", default=0, at_least=0, example=0)

    def depths(self) -> tuple[float, ...]:
        """The depth of each pass below X, mm on the radius."""
        if self.thread_depth is None or self.depth_per_pass is None:
            return (0.0,)
        return infeeds(0, self.thread_depth / functions.Z, self.depth_per_pass / functions.Z)

    def contradictions(self) -> Iterator[tuple[str, str]]:
        """The depth of the thread alone: the source allows leaving out all of P, or P3."""
        if self.thread_depth is not None and self.depth_per_pass is None:
            yield "depth_per_pass", "is missing: P1 stands alone (leave out both, or neither)"

    def check(self, m: Machine) -> Iterator[tuple[str, str]]:
        yield from apart(self.x, self.z, m)
        yield from needs_pitch(m, self.feed)
        yield from too_many("depth_per_pass", self.depths)
        angle, length = m.settings["parameter_6"], abs(self.z - here(m)[1]) / functions.Z
        if not abs(angle) < 90:
            yield "", f"needs machine parameter 6 (infeed angle) to be less than 90 degrees, it is {angle:.10g}"
        shift = self.depths()[-1] * math.tan(math.radians(angle))
        if shift + self.run_out(m) >= length:
            ends = f"the infeed angle takes {max(shift, 0):.3f} mm and the run-out {self.run_out(m):.3f} mm"
            yield "", f"has no thread left: of {length:.10g} mm {ends} (machine parameters 6 and 7)"

    def run_out(self, m: Machine) -> float:
        """Machine parameter 7: tenths of the pitch, as mm."""
        return float(m.settings["parameter_7"]) * 0.1 * pitch_of(m, self.feed)

    def moves(self, m: Machine) -> Iterable[Step]:
        end, taper = (self.x / functions.X, self.z / functions.Z), self.taper / functions.X
        angle, pitch = math.radians(m.settings["parameter_6"]), pitch_of(m, self.feed)
        return thread_passes(start(m), end, pitch, self.depths(), taper=taper, angle=angle, run_out=self.run_out(m))


@CYCLES("G33", "Tapping (tap or die)", runs="definition", source="NC-31 3.20.14")
class Tapping(FromStart):
    """Along Z locked to the spindle, the spindle reversed, back the same way, the spindle as before; then to X at rapid.

    The source gives the frames alone, its figure is lost: reversal and return are a reading, for a tap has no other way
    out of a thread.
    """

    x: float | None = aside("X", "X of the tool afterwards", "unchanged", 6000)
    z: float = param("Z", "end of the thread", "0.01 mm", note=FROM_START, example=-2000)
    feed: float | None = feed_word("pitch", "0.0001 mm", SAME, 17_500)
    zero_mark: float = own_mark("start at the zero mark of the spindle", example=1)

    def check(self, m: Machine) -> Iterator[tuple[str, str]]:
        yield from apart(None, self.z, m)
        yield from needs_pitch(m, self.feed)

    def moves(self, m: Machine) -> Iterable[Step]:
        sense, pitch = m.turning, pitch_of(m, self.feed)
        steps: list[Step] = [*tap([self.z / functions.Z], above=m.programmed[2], sense=sense, end=sense, pitch=pitch)]
        if self.zero_mark:
            cut = next(k for k, step in enumerate(steps) if isinstance(step, Thread))
            steps[cut] = steps[cut]._replace(label=f"{steps[cut].label}, synchronised start")
        if self.x is not None:
            steps.append(Go("aside", x=self.x / functions.X))
        return steps


@FUNCTIONS("G32", "Single threading move", takes="X Z F", modal=False, source="3.20.13")
def thread_move(m: Machine, words: Words) -> None:
    """One straight move locked to the spindle; F is the pitch (0.0001 mm), left out it is the modal feed.

    The pitch counts along the axis of the longer travel (X on the radius). With @ on G32 the move starts at the zero
    mark of the spindle, without it at once. Approach and return are frames of their own.
    """
    head = words.words[0]
    if head.flag & RAPID_MARK:
        m.alarm("the mark ~ has no meaning on G32", head)
    refuse_rapid(m, [*words.words[1:]], "G32")
    ends = targets(m, words)
    if not ends:
        m.alarm("G32 needs X or Z", head, "tie their frames to it with the mark *")
    feed = m.value(words["F"]) if "F" in words else None
    if feed is not None and not 1 <= feed <= 999_999:
        m.alarm(f"G32 F (pitch, 0.0001 mm) must be from 1 to 999999, got {feed:.10g}", words["F"])
    for _, sentence in needs_pitch(m, feed):
        m.alarm(f"G32 {sentence}", head)
    dx, dz = (ends.get(name, m.programmed[k]) - m.programmed[k] for name, k in (("x", 0), ("z", 2)))
    if not (dx or dz):
        m.alarm("G32 has no way to go: its end is where the tool stands", head)
    label = "G32 synchronised start" if head.flag & INCREMENTAL else "G32"
    with m.within(label=label, per_rev=True, synchronous=True, feed=lead_along(dx, dz, pitch_of(m, feed))):
        m.line(**ends, word=head)
