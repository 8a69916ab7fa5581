"""What cycles 1 to 5 and 17 share: the tool stands at the set-up clearance when they are called, and ends there.

Z is where the tool stands, S = Z - SETUP the surface, S + DEPTH the bottom. The sign of DEPTH is the direction (for a
positive one see the setting "depth_error"); set-up clearance and infeed are lengths, which older programs write with the
sign of the depth: -2, -20, -5.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from functools import partial

from mnclab.controls.tnc_620.cycles import addresses
from mnclab.controls.tnc_620.cycles.planes import Fault, not_zero
from mnclab.machine.cycle import Cycle, too_many
from mnclab.machine.machine import Machine
from mnclab.machining.depths import infeeds
from mnclab.machining.steps import Say

clearance = partial(
    addresses.increment, "SETUP", "set-up clearance", note="from the tool to the surface; its sign is that of the depth, or +",
    example=2,
)  # fmt: skip
depth = partial(addresses.increment, "DEPTH", "depth", note=addresses.DOWN, example=-20)
infeed = partial(addresses.increment, "PECKG", "infeed depth", note="its sign is that of the depth, or +", example=5)
feed = partial(addresses.feed, also=("FAUTO",))
plunge_feed = partial(feed, "PECKG:F", "feed rate for plunging", example=150)


class AtClearance(Cycle):
    """What they share; who inherits declares the parameters."""

    clearance: float
    depth: float
    infeed: float | None = None

    @property
    def down(self) -> float:
        """+1 where the cycle works downwards, -1 upwards, 0 where it has nothing to do."""
        return -math.copysign(1.0, self.depth) if self.depth else 0.0

    @property
    def left_out(self) -> Say:
        return Say("DEPTH makes a depth of 0: the cycle is not executed")

    def surface(self, m: Machine) -> float:
        """S, before the cycle has moved."""
        return m.programmed[2] - self.down * abs(self.clearance)

    def levels(self, m: Machine) -> tuple[float, ...]:
        """Of the infeeds, before the cycle has moved."""
        surface = self.surface(m)
        return infeeds(surface, surface + self.depth, None if self.infeed is None else abs(self.infeed))

    def contradictions(self) -> Iterator[Fault]:
        """Lengths have the sign of the depth, or none; an infeed is one."""
        if not self.depth:
            return
        for name in ("clearance", "infeed"):
            value = getattr(self, name) or 0.0
            if value < 0 < self.depth:
                yield name, f"must have the sign of the depth or be positive, got {value:g}"
        yield from not_zero(self, "infeed")

    def check(self, m: Machine) -> Iterator[Fault]:
        """The direction, and a number of infeeds that somebody would wait for; nothing where nothing is done."""
        if not self.depth:
            return
        if self.depth > 0 and m.settings["depth_error"]:
            yield "depth", f"must be negative, got {self.depth:g}: a positive depth works upwards"
        yield from too_many("infeed", lambda: self.levels(m))
        yield from self.fits(m)

    def fits(self, m: Machine) -> Iterator[Fault]:
        """Faults of the feed, the tool and the shape."""
        yield from ()
