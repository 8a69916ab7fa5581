"""What the cycles at a hole share: where it ends, its faults, the way to it (chapter 4); its planes are in `planes`."""

from __future__ import annotations

import math
from abc import abstractmethod
from collections.abc import Iterable, Iterator

from mnclab.controls.tnc_620.cycles.planes import AtSurface
from mnclab.machine.machine import Machine
from mnclab.machine.true_size import tool
from mnclab.machining.steps import RAPID, Go, Step


class Hole(AtSurface):
    """A cycle at a hole; a subclass declares the parameters named here and says in `steps` what happens below A."""

    depth: float
    feed: float
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

    def check(self, m: Machine) -> Iterator[tuple[str, str]]:
        yield from self.signs(m)
        if self.reference == 1:
            yield from point_angle(m, "reference")
        yield from moving("feed", self.feed, "to drill with")

    def moves(self, m: Machine) -> Iterable[Step]:
        return [Go("to the set-up clearance", self.above), *self.steps(m)] if self.down else [self.left_out]


def point_length(radius: float, angle: float) -> float:
    """How far a drill of an angle (degrees) reaches beyond its cylindrical part, mm.

    >>> round(point_length(2.4, 120), 4)
    1.3856
    """
    return radius / math.tan(math.radians(angle / 2))


def point_angle(m: Machine, name: str) -> Iterator[tuple[str, str]]:
    """What a parameter asks for needs the point angle of the tool."""
    if not 0 < m.tool.angle < 180:
        yield name, f"needs the point angle of tool {m.tool.number} (T-ANGLE of the tool table)"


def oriented(m: Machine) -> Iterator[tuple[str, str]]:
    """A spindle that can stop at an angle."""
    if not m.settings["controlled_spindle"]:
        yield "", "needs a controlled spindle, which this machine does not have (setting controlled_spindle)"


def moving(name: str, feed: float | str, purpose: str) -> Iterator[tuple[str, str]]:
    """A feed of 0 would never arrive."""
    if feed == 0:
        yield name, f"must be greater than 0 {purpose}, got 0"


def rate(feed: float | str, otherwise: float = RAPID) -> float:
    """The feed of a move: rapid for the word FMAX, and another feed in the place of 0."""
    return RAPID if isinstance(feed, str) else feed or otherwise
