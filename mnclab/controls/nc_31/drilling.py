"""Deep-hole drilling G73 along Z and G72 along X (source, 3.20.7)."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from mnclab.controls.nc_31 import discretes
from mnclab.controls.nc_31.targets import FROM_START, FromStart, apart, aside, feed_word, here, size, start
from mnclab.machine.cycle import CycleTable, param, too_many
from mnclab.machine.machine import Machine
from mnclab.machining.depths import infeeds
from mnclab.machining.holes.drilling import drill
from mnclab.machining.steps import Go, Step

CYCLES = CycleTable()

AFTER = "left out: it stays on the axis of the hole"


def faults(cycle: FromStart, m: Machine, peck: float, depth: float) -> Iterator[tuple[str, str]]:
    """A peck that is not deeper than the hole, not too many of them, and a feed."""
    if peck > depth * (1 + 1e-9):
        yield "peck", f"must be at most {depth:.10g}, the depth of the hole, got {peck:.10g}"
    yield from too_many("peck", lambda: infeeds(0, depth, peck))
    yield from cycle.needs_feed(m)


def deep_hole(m: Machine, begin: float, bottom: float, peck: float, after: float | None) -> Iterator[Step]:
    """Drill along in pecks, each from a gap before the last depth, each followed by a retract to the start; then aside."""
    gap = m.settings["parameter_8"] / discretes.TRAVEL
    yield from drill(infeeds(begin, bottom, peck), above=begin, feed=None, reenter=gap)
    yield Go("retract", begin)
    if after is not None:
        yield Go("aside", x=after)


@CYCLES("G73", "Deep-hole drilling", runs="definition", source="NC-31 3.20.7")
class DeepDrilling(FromStart):
    """Pecks of P along Z to the bottom, the last one the rest; after each a retract to the start point at rapid.

    The drill returns at rapid to where it was interrupted but for a gap, machine parameter 8. Then, where X is given, it
    goes there at rapid.
    """

    x: float | None = aside("X", "X of the drill afterwards", AFTER, 6000)
    z: float = param("Z", "bottom of the hole", "0.01 mm", note=FROM_START, example=-3000)
    feed: float | None = feed_word("feed of the cycle")
    peck: float = size("depth drilled per pass", above=0, example=1000)

    def check(self, m: Machine) -> Iterator[tuple[str, str]]:
        yield from apart(None, self.z, m)
        yield from faults(self, m, self.peck, abs(self.z - here(m)[1]))

    def moves(self, m: Machine) -> Iterable[Step]:
        after = None if self.x is None else self.x / discretes.X
        return deep_hole(m, start(m)[1], self.z / discretes.Z, self.peck / discretes.Z, after)


@CYCLES("G72", "Deep-hole drilling along X", runs="definition", source="NC-31 3.20.7")
class RadialDrilling(FromStart):
    """G73 with the axes exchanged: pecks of P along X; then, where Z is given, to Z at rapid.

    P counts on the diameter (setting `p1_on_radius`), machine parameter 8 in true travel of the tool.
    """

    x: float = param("X", "bottom of the hole", "0.01 mm on diameter", note=FROM_START, example=2000)
    z: float | None = aside("Z", "Z of the drill afterwards", AFTER, 1000)
    feed: float | None = feed_word("feed of the cycle")
    peck: float = size("depth drilled per pass", "0.01 mm on diameter", above=0, example=600)

    transverse = True

    def depth(self, m: Machine) -> float:
        """P in discretes on the diameter."""
        return self.peck * (2 if m.settings["p1_on_radius"] else 1)

    def check(self, m: Machine) -> Iterator[tuple[str, str]]:
        yield from apart(self.x, None, m)
        yield from faults(self, m, self.depth(m), abs(self.x - here(m)[0]))

    def moves(self, m: Machine) -> Iterable[Step]:
        after = None if self.z is None else self.z / discretes.Z
        return self.in_axes(deep_hole(m, start(m)[0], self.x / discretes.X, self.depth(m) / discretes.X, after))
