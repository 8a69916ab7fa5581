"""What the cycles at a hole share: where it ends, its faults, the way to it (chapter 4); its planes are in `planes`."""

from __future__ import annotations

import math
from abc import abstractmethod
from collections.abc import Iterable, Iterator

from mnclab.controls.tnc_620.cycles.faults import Fault, less_than_depth, not_zero, with_angle
from mnclab.controls.tnc_620.cycles.planes import AtSurface
from mnclab.machine.cycle import too_many
from mnclab.machine.machine import Machine
from mnclab.machine.true_size import tool
from mnclab.machining.depths import infeeds
from mnclab.machining.steps import RAPID, Go, Step


class Hole(AtSurface):
    """A cycle at a hole; a subclass declares the parameters named here and says in `steps` what happens below A."""

    depth: float
    feed: float
    infeed: float | None = 0.0
    decrement = 0.0
    min_infeed = 0.0
    start_depth = 0.0
    reference = 0.0

    def reach(self, m: Machine) -> float:
        """Where the hole ends, counted from the surface, mm."""
        return self.depth

    @abstractmethod
    def steps(self, m: Machine) -> Iterable[Step]:
        """From the set-up plane down, and back to it or to the second set-up clearance."""

    def bottom(self, m: Machine) -> float:
        """B, where the tip of the tool ends: with Q395 = 1 its cylindrical part reaches the depth."""
        point = point_length(tool(m).effective_radius, tool(m).angle) if self.reference == 1 else 0.0
        return self.surface + self.reach(m) - self.down * point

    def check(self, m: Machine) -> Iterator[Fault]:
        yield from self.signs(m)
        if self.reference == 1:
            yield from with_angle(m, "reference")
        yield from not_zero(self, "feed", purpose="to drill with")
        if self.depth:
            yield from less_than_depth(self, "start_depth", self.depth)
        if self.start_depth:
            yield from not_zero(self, "positioning_feed", purpose="to reach the starting point")
        yield from too_many("infeed", lambda: self.levels(m))

    @property
    def begin(self) -> float:
        """Where infeeds count from."""
        return self.surface - self.down * self.start_depth

    def levels(self, m: Machine) -> tuple[float, ...]:
        """The depths of the infeeds."""
        return infeeds(self.begin, self.bottom(m), self.infeed, self.decrement, self.min_infeed)

    def moves(self, m: Machine) -> Iterable[Step]:
        return [Go("to the set-up clearance", self.above), *self.steps(m)] if self.down else [self.left_out]


def point_length(radius: float, angle: float) -> float:
    """How far a drill of an angle (degrees) reaches beyond its cylindrical part, mm.

    >>> round(point_length(2.4, 120), 4)
    1.3856
    """
    return radius / math.tan(math.radians(angle / 2))


def rate(feed: float | str, otherwise: float = RAPID) -> float:
    """The feed of a move: rapid for the word FMAX, and another feed in the place of 0."""
    return RAPID if isinstance(feed, str) else feed or otherwise
