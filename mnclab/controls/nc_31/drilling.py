"""Deep-hole drilling G73 along Z and G72 along X (source, 3.20.7)."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import chain

from mnclab.controls.nc_31 import discretes
from mnclab.controls.nc_31.targets import FROM_START, FromStart, apart, feed_word, here, in_mm
from mnclab.machine.cycle import CycleTable, param, too_many
from mnclab.machine.machine import Machine
from mnclab.machining.depths import infeeds
from mnclab.machining.holes.drilling import drill
from mnclab.machining.steps import Go, Step
from mnclab.machining.turning.shoulders import facing
from mnclab.running.performing import perform

CYCLES = CycleTable()

AFTER = "left out: it stays on the axis of the hole"


def faults(m: Machine, feed: float | None, peck: float, depth: float) -> Iterator[tuple[str, str]]:
    """A peck that is not deeper than the hole, not too many of them, and a feed."""
    if peck > depth * (1 + 1e-9):
        yield "peck", f"must be at most {depth:.10g}, the depth of the hole, got {peck:.10g}"
    yield from too_many("peck", lambda: infeeds(0, depth, peck))
    if feed is None and m.feed is None:
        yield "", "needs a feed: F here, or before it"


def deep_hole(start: float, bottom: float, peck: float, clearance: float) -> Iterator[Step]:
    """Drill in pecks, each from `clearance` before the last depth, each followed by a retract to the start."""
    levels = infeeds(start, bottom, peck)
    return chain(drill(levels, above=start, feed=None, reenter=clearance), [Go("retract", start)])


@CYCLES("G73", "Deep-hole drilling", runs="definition", source="NC-31 3.20.7")
class DeepDrilling(FromStart):
    """Pecks of P along Z to the bottom, the last one the rest; after each a retract to the start point at rapid.

    The drill returns at rapid to where it was interrupted but for a gap, machine parameter 8. Then, where X is given, it
    goes there at rapid.
    """

    x: float | None = param("X", "X of the drill afterwards", "0.01 mm on diameter", default=None, default_means=AFTER,
                            note=FROM_START, example=6000)  # fmt: skip
    z: float = param("Z", "bottom of the hole", "0.01 mm", note=FROM_START, example=-3000)
    feed: float | None = feed_word("feed of the cycle")
    peck: float = param(
        "P", "depth drilled per pass", "0.01 mm", above=0, incremental=True, type="integer", example=1000
    )

    def check(self, m: Machine) -> Iterator[tuple[str, str]]:
        """A hole, and pecks that it holds."""
        yield from apart(None, self.z, m)
        yield from faults(m, self.feed, self.peck, abs(self.z - here(m)[1]))

    def moves(self, m: Machine) -> None:
        """The hole, then aside."""
        z1 = m.programmed[2]
        gap = m.settings["parameter_8"] / discretes.TRAVEL
        with m.within(feed=m.feed if self.feed is None else in_mm(self.feed)):
            perform(m, "G73", deep_hole(z1, self.z / discretes.Z, self.peck / discretes.Z, gap), (0.0, 0.0))
        if self.x is not None:
            perform(m, "G73", [Go("aside", x=self.x / discretes.X)], (0.0, 0.0))


@CYCLES("G72", "Deep-hole drilling along X", runs="definition", source="NC-31 3.20.7")
class RadialDrilling(FromStart):
    """G73 with the axes exchanged: pecks of P along X; then, where Z is given, to Z at rapid.

    P counts on the diameter (setting `p1_on_radius`), machine parameter 8 in true travel of the tool.
    """

    x: float = param("X", "bottom of the hole", "0.01 mm on diameter", note=FROM_START, example=2000)
    z: float | None = param("Z", "Z of the drill afterwards", "0.01 mm", default=None, default_means=AFTER,
                            note=FROM_START, example=1000)  # fmt: skip
    feed: float | None = feed_word("feed of the cycle")
    peck: float = param(
        "P", "depth drilled per pass", "0.01 mm on diameter", above=0, incremental=True, type="integer", example=600,
    )  # fmt: skip

    def depth(self, m: Machine) -> float:
        """P in discretes on the diameter."""
        return self.peck * (2 if m.settings["p1_on_radius"] else 1)

    def check(self, m: Machine) -> Iterator[tuple[str, str]]:
        """A hole, and pecks that it holds."""
        yield from apart(self.x, None, m)
        yield from faults(m, self.feed, self.depth(m), abs(self.x - here(m)[0]))

    def moves(self, m: Machine) -> None:
        """The hole, then aside."""
        x1 = m.programmed[0]
        gap = m.settings["parameter_8"] / discretes.TRAVEL
        hole = deep_hole(x1, self.x / discretes.X, self.depth(m) / discretes.X, gap)
        with m.within(feed=m.feed if self.feed is None else in_mm(self.feed)):
            perform(m, "G72", facing(hole), (0.0, 0.0))
        if self.z is not None:
            perform(m, "G72", [Go("aside", z=self.z / discretes.Z)], (0.0, 0.0))
