"""What the cycles at a hole share: their planes, the faults of their depth, the way in and the way out (chapter 4).

Planes in the tool axis: S the surface Q203, A = S + Q200 the set-up plane, B the bottom, E the plane at the end of the
cycle, S + Q204 where that is higher than A. With a positive depth a cycle works upwards from A = S - Q200, where the
setting "depth_error" allows it; E stays above the surface.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator

from mnclab.machine.cycle import Cycle
from mnclab.machine.machine import Machine
from mnclab.machine.performing import perform
from mnclab.machining.steps import RAPID, Go, Step


class Hole(Cycle):
    """A cycle at a hole; a subclass declares the parameters named here and says in ``steps`` what happens below A."""

    clearance: float
    depth: float
    feed: float
    surface: float
    second_clearance: float
    reference = 0.0

    def down(self, m: Machine) -> float:
        """How far the hole goes below the surface, mm; negative where it goes up."""
        return -self.depth

    def steps(self, m: Machine) -> Iterable[Step]:
        """From the set-up plane down, and back to it or to the second set-up clearance."""
        raise NotImplementedError

    # --- planes -------------------------------------------------------------------------------------------------------

    def up(self, m: Machine) -> float:
        """+1 where the tool leaves the hole upwards, -1 where it was drilled from below."""
        return math.copysign(1.0, self.down(m))

    def above(self, m: Machine) -> float:
        """A, the set-up plane."""
        return self.surface + self.up(m) * self.clearance

    def bottom(self, m: Machine) -> float:
        """B, where the tip of the tool ends: with Q395 = 1 its cylindrical part reaches the depth."""
        point = point_length(m.radius, m.tool.angle) if self.reference == 1 else 0.0
        return self.surface - self.down(m) - self.up(m) * point

    @property
    def end(self) -> float:
        """E, the plane at the end of the cycle."""
        return self.surface + max(self.second_clearance, self.clearance)

    # --- faults -------------------------------------------------------------------------------------------------------

    def check(self, m: Machine) -> Iterator[tuple[str, str]]:
        """The sign of the depth, the point angle for Q395 = 1, a feed."""
        yield from depth_sign(m, "depth", self.depth)
        if self.reference == 1:
            yield from point_angle(m, "reference")
        yield from moving("feed", self.feed, "to drill with")

    # --- motion -------------------------------------------------------------------------------------------------------

    def moves(self, m: Machine) -> None:
        """To the set-up plane and then what the cycle does; nothing for a depth of 0."""
        if self.down(m) == 0:
            return
        steps = [
            Go("to the set-up clearance", self.above(m)),
            *self.steps(m),
        ]  # with spindle and coolant as at the call
        perform(m, self.code, steps)

    def leave(self, m: Machine, feed: float = RAPID) -> Iterator[Go]:
        """To the end plane; a tool that drilled upwards first goes to the set-up plane under the hole."""
        if self.up(m) < 0:
            yield Go("retract", self.above(m), feed)
        yield Go("retract", self.end, feed)


def point_length(radius: float, angle: float) -> float:
    """How far a drill of an angle (degrees) reaches beyond its cylindrical part, mm.

    >>> round(point_length(2.4, 120), 4)
    1.3856
    """
    return radius / math.tan(math.radians(angle / 2))


def depth_sign(m: Machine, name: str, depth: float) -> Iterator[tuple[str, str]]:
    """A positive depth is a fault where the machine says so (displayDepthErr)."""
    if depth > 0 and m.settings["depth_error"]:
        yield name, f"must be negative, got {depth:g}: a positive depth works upwards"


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
