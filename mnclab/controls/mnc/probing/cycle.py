"""What all measuring cycles of the MNC share: what refuses them, how the probe approaches (MNC 12: probe table, probe motion).

Coordinates are absolute under G90 and G91; the ball's centre runs on the stated lines, z is the south pole of the ball.
"""

from __future__ import annotations

from collections.abc import Generator, Iterable, Iterator
from typing import Any, ClassVar

from mnclab.machine.cycle import Cycle
from mnclab.machine.machine import Machine
from mnclab.machine.touching import PROBES, unfit
from mnclab.machining.probing.sequences import Approach
from mnclab.machining.steps import Step, Write

Moves = Generator[Step, Any, None]
SCALES = ("scaling", "mirror")


class MeasuringCycle(Cycle):
    """Base of the cycles of chapter 12: who inherits declares the parameters, Q and H among them."""

    does: ClassVar[str] = PROBES
    refused: ClassVar[tuple[str, ...]] = SCALES
    """Frames that must not be active."""

    clearance = 0.0
    level = 0.0
    height = 0.0
    between = 0.0

    def check(self, m: Machine) -> Iterator[tuple[str, str]]:
        yield from unfit(m, still=True)
        if m.plane != "XY":
            yield "", f"needs the plane G17, {m.modal.get('plane', m.plane)} is active"
        for name in self.refused:
            if name in m.frames:
                yield "", f"cannot run while a {name} is active"

    def about(self, m: Machine) -> tuple[float, float]:
        return 0.0, 0.0

    def approach(self, m: Machine, **other: Any) -> Approach:
        """How the probe of the table moves in this cycle; `other` values of it."""
        probe = m.tables.probe
        found = {
            "ball": m.radius, "gap": probe.clearance + self.clearance, "level": self.level, "height": self.height,
            "reach": probe.reach, "feed": probe.feed, "positioning": probe.positioning_feed, "over": self.between == 1,
            "track": probe.track,
        }  # fmt: skip
        return Approach(**{**found, **other})

    def low(self, a: Approach) -> Iterator[tuple[str, str]]:
        """A safe height below the measuring height."""
        if a.height < a.pole:
            yield "height", f"must be at least the measuring height of the south pole, {a.pole:g}, got {a.height:g}"


def results(**values: float) -> Iterable[Step]:
    """Q variables: `results(Q312=x)`."""
    return [Write("variable", float(value), name) for name, value in values.items()]
