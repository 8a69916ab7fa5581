"""Rotary axes: their angles are told in the rows of a path; where the tool tip stands on the workpiece is not changed.

Without the kinematics of a machine the axes A, B and C are positions of their own. A move of theirs alone is a row without
length that takes the time of the axis with the longest way; beside a move of the linear axes they arrive with the tip.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from mnclab.path.kinds import Kind

if TYPE_CHECKING:
    from mnclab.machine.machine import Machine

AXES = "ABC"
Angles = tuple[float, float, float]


def angles(m: Machine) -> Angles:
    """Where A, B and C stand, degrees."""
    a, b, c = map(math.degrees, m.rotary)
    return a, b, c


def set_angles(m: Machine, to: Angles) -> None:
    """The next row arrives at these angles, degrees."""
    m.change("rotary", tuple(map(math.radians, to)))


def turn_axes(m: Machine, to: Angles, f: float | None) -> None:
    """Turn to angles (degrees) while the tip stands; `f` is in degrees a minute, infinite at rapid, None the modal feed.

    The time of a rapid turn is not known: no limits of rotary axes are.
    """
    way = max(abs(new - old) for new, old in zip(to, angles(m), strict=True))
    set_angles(m, to)
    rate = m.feed_of(f)
    kind = Kind.LINE if math.isfinite(rate) else Kind.RAPID
    m.add_row(kind, m.tip, feed=math.radians(rate), time=60 * way / rate if kind == Kind.LINE else math.nan)
