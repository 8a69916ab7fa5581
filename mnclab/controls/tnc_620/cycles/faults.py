"""Faults that many cycles find alike: the name of the parameter, and a sentence."""

from __future__ import annotations

from collections.abc import Iterator

from mnclab.machine.cycle import Cycle
from mnclab.machine.machine import Machine

Fault = tuple[str, str]
SAME = 1e-9  # mm, of lengths that are equal


def not_zero(c: Cycle, *names: str, purpose: str = "") -> Iterator[Fault]:
    """A feed or infeed of 0 would never arrive."""
    for name in names:
        if getattr(c, name) == 0:
            yield name, f"must be greater than 0 {purpose}".rstrip() + ", got 0"


def at_least(c: Cycle, name: str, least: float, what: str, drift: float = SAME) -> Iterator[Fault]:
    """A value below what it may be by more than a `drift`."""
    if (value := getattr(c, name)) < least - drift:
        yield name, f"must be at least {what}, {least:g}, got {value:g}"


def at_most(c: Cycle, name: str, most: float, what: str) -> Iterator[Fault]:
    """A value above what it may be."""
    if (value := getattr(c, name)) > most:
        yield name, f"must be at most {what}, {most:g}, got {value:g}"


def less_than_depth(c: Cycle, name: str, depth: float) -> Iterator[Fault]:
    """Something that should end above the bottom."""
    if (value := getattr(c, name)) >= abs(depth):
        yield name, f"must be less than the depth {abs(depth):g}, got {value:g}"


def with_radius(m: Machine) -> Iterator[Fault]:
    """A tool that can mill."""
    if m.radius <= 0:
        yield "", f"needs a tool with a radius, got {m.radius:g}"


def with_angle(m: Machine, name: str) -> Iterator[Fault]:
    """What a parameter asks for needs the point angle of the tool."""
    if not 0 < m.tool.angle < 180:
        yield name, f"needs the point angle of tool {m.tool.number} (T-ANGLE of the tool table)"


def oriented(m: Machine) -> Iterator[Fault]:
    """A spindle that can stop at an angle."""
    if not m.settings["controlled_spindle"]:
        yield "", "needs a controlled spindle, which this machine does not have (setting controlled_spindle)"
