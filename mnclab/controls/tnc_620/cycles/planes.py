"""The planes of a cycle in the tool axis, and the rule of the sign of its depths (4.3, 5.2, 5.5, 6.2).

S is the surface Q203, A = S + Q200 the set-up plane, E the plane at the end: S + Q204 where that is higher than A. A positive
depth works upwards from A = S - Q200, where the setting "depth_error" allows it; E stays above the surface.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import ClassVar

from mnclab.controls.tnc_620.cycles.faults import Fault
from mnclab.machine.cycle import Cycle
from mnclab.machine.machine import Machine
from mnclab.machining.steps import RAPID, Go, Say


def in_program_coordinates(c: Cycle, m: Machine) -> tuple[float, float]:
    """`about` of the cycles whose steps stand where the program says, not about the tool."""
    return 0.0, 0.0


class AtSurface(Cycle):
    """What cycles at a surface share; who inherits declares the parameters."""

    clearance: float
    surface: float
    second_clearance: float
    depth: float

    works: ClassVar[tuple[str, ...]] = ("depth",)
    """Its depths, in the order in which their signs are evaluated."""

    def depths(self) -> dict[str, float]:
        """The depths by name; 0 leaves a step out."""
        return {name: getattr(self, name) for name in self.works}

    @property
    def down(self) -> float:
        """+1 where the cycle works downwards, -1 upwards, 0 where it has nothing to do."""
        for depth in self.depths().values():
            if depth:
                return -1.0 if depth > 0 else 1.0
        return 0.0

    @property
    def left_out(self) -> Say:
        """All that a cycle does with a depth of 0: the manual leaves it out, which a warning says."""
        depth = next(p.address for p in self.parameters() if p.name in self.depths())
        return Say(f"{depth} makes a depth of 0: the cycle is not executed")

    @property
    def above(self) -> float:
        """A, the set-up plane."""
        return self.surface + (-self.clearance if self.down < 0 else self.clearance)

    @property
    def end(self) -> float:
        """E, the plane at the end of the cycle: nothing stands in the way there."""
        return self.surface + max(self.second_clearance, self.clearance)

    def signs(self, m: Machine) -> Iterator[Fault]:
        """The first depth that is not 0 sets the direction (displayDepthErr: downwards); the others follow it."""
        worked = {name: depth for name, depth in self.depths().items() if depth}
        for number, (name, depth) in enumerate(worked.items()):
            if number == 0 and depth > 0 and m.settings["depth_error"]:
                yield name, f"must be negative, got {depth:g}: a positive depth works upwards"
            if depth * self.down > 0:
                yield name, f"must have the sign of the other depths, got {depth:g}"

    def leave(self, feed: float = RAPID) -> Iterator[Go]:
        """To E; a tool that worked upwards first goes to A under the workpiece."""
        if self.down < 0:
            yield Go("retract", self.above, feed)
        yield Go("retract", self.end, feed)
