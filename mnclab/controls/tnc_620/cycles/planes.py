"""The planes of a cycle in the tool axis, the sign of its depth, and the faults that many cycles find alike."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator
from typing import Any, ClassVar

from mnclab.machine.coordinates import tool
from mnclab.machine.cycle import Cycle
from mnclab.machine.machine import Machine
from mnclab.machining.depths import infeeds
from mnclab.machining.steps import RAPID, Go, Say, Step

# Faults that many cycles find alike: the name of the parameter, and a sentence.

ParameterFault = tuple[str, str]
SAME = 1e-9  # mm, of lengths that are equal


def not_zero(c: Cycle, *names: str, purpose: str = "") -> Iterator[ParameterFault]:
    """A feed or infeed of 0 would never arrive."""
    for name in names:
        if getattr(c, name) == 0:
            yield name, f"must be greater than 0 {purpose}".rstrip() + ", got 0"


def at_least(c: Cycle, name: str, least: float, what: str, drift: float = SAME) -> Iterator[ParameterFault]:
    """A value below what it may be by more than a `drift`."""
    if (value := getattr(c, name)) < least - drift:
        yield name, f"must be at least {what}, {least:g}, got {value:g}"


def at_most(c: Cycle, name: str, most: float, what: str) -> Iterator[ParameterFault]:
    """A value above what it may be."""
    if (value := getattr(c, name)) > most:
        yield name, f"must be at most {what}, {most:g}, got {value:g}"


def less_than_depth(c: Cycle, name: str, depth: float) -> Iterator[ParameterFault]:
    """Something that should end above the bottom."""
    if (value := getattr(c, name)) >= abs(depth):
        yield name, f"must be less than the depth {abs(depth):g}, got {value:g}"


def with_radius(m: Machine) -> Iterator[ParameterFault]:
    """A tool that can mill."""
    if m.radius <= 0:
        yield "", f"needs a tool with a radius, got {m.radius:g}"


def with_angle(m: Machine, name: str) -> Iterator[ParameterFault]:
    """What a parameter asks for needs the point angle of the tool."""
    if not 0 < m.tool.angle < 180:
        yield name, f"needs the point angle of tool {m.tool.number} (T-ANGLE of the tool table)"


def oriented(m: Machine) -> Iterator[ParameterFault]:
    """A spindle that can stop at an angle."""
    if not m.settings["controlled_spindle"]:
        yield "", "needs a controlled spindle, which this machine does not have (setting controlled_spindle)"


# The planes of a cycle in the tool axis, the rule of the sign of its depths (4.3, 5.2, 5.5, 6.2), and the way to a hole (4).
# S is the surface Q203, A = S + Q200 the set-up plane, E the plane at the end: S + Q204 where that is higher than A. A positive
# depth works upwards from A = S - Q200, where the setting "depth_error" allows it; E stays above the surface.

def in_program_coordinates(c: Cycle, m: Machine) -> tuple[float, float]:
    """`about` of the cycles whose steps stand where the program says, not about the tool."""
    return 0.0, 0.0


class AtSurface(Cycle):
    """What cycles at a surface share; who inherits declares the parameters, and says in `steps` what it does."""

    clearance: float
    surface: float
    second_clearance: float
    depth: float
    feed: float
    infeed: float | None = 0.0
    decrement = 0.0
    min_infeed = 0.0
    start_depth = 0.0
    reference = 0.0
    dwell_top = dwell_bottom = break_retract = spindle_angle = disengage = 0.0
    retract_feed: Any = 0.0
    positioning_feed: Any = 0.0

    works: ClassVar[tuple[str, ...]] = ("depth",)
    """Its depths, in the order in which their signs are evaluated."""

    def depths(self) -> dict[str, float]:
        """The depths by name; 0 leaves a step out."""
        return {name: getattr(self, name) for name in self.works}

    @property
    def down(self) -> float:
        """+1 where the cycle works downwards, -1 upwards, 0 where it has nothing to do."""
        first = next(filter(None, self.depths().values()), 0.0)
        return -math.copysign(1.0, first) if first else 0.0

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

    def signs(self, m: Machine) -> Iterator[ParameterFault]:
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

    def fits(self, m: Machine) -> Iterator[ParameterFault]:
        """Faults of the shape that is milled and of the tool."""
        yield from ()

    def steps(self, m: Machine) -> Iterable[Step]:
        """All that it does at a depth other than 0; of a hole from the set-up plane down, and back to it or higher."""
        return ()

    def moves(self, m: Machine) -> Iterable[Step]:
        return self.steps(m) if self.down else [self.left_out]

    # --- holes -------------------------------------------------------------------------------------------------------

    def reach(self, m: Machine) -> float:
        """Where the hole ends, counted from the surface, mm."""
        return self.depth

    def bottom(self, m: Machine) -> float:
        """B, where the tip of the tool ends: with Q395 = 1 its cylindrical part reaches the depth."""
        point = point_length(tool(m).effective_radius, tool(m).angle) if self.reference == 1 else 0.0
        return self.surface + self.reach(m) - self.down * point

    @property
    def begin(self) -> float:
        """Where infeeds count from."""
        return self.surface - self.down * self.start_depth

    def pecks(self, m: Machine) -> tuple[float, ...]:
        """The depths of the infeeds."""
        return infeeds(self.begin, self.bottom(m), self.infeed, self.decrement, self.min_infeed)


def point_length(radius: float, angle: float) -> float:
    """How far a drill of an angle (degrees) reaches beyond its cylindrical part, mm.

    >>> round(point_length(2.4, 120), 4)
    1.3856
    """
    return radius / math.tan(math.radians(angle / 2))


def rate(feed: float | str, otherwise: float = RAPID) -> float:
    """The feed of a move: rapid for the word FMAX, and another feed in the place of 0."""
    return RAPID if isinstance(feed, str) else feed or otherwise
