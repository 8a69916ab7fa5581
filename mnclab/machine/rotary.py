"""Rotary axes: their angles are told in the rows of a path; where the tool tip stands on the workpiece is not changed.

Without the kinematics of a machine the axes A, B and C are positions of their own. A move of theirs alone is a row without
length that takes the time of the axis with the longest way; beside a move of the linear axes they arrive with the tip.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from mnclab.path.cylinder import NONE, Cylinder
from mnclab.path.kinds import Kind
from mnclab.path.recorder import NAN

if TYPE_CHECKING:
    from mnclab.machine.machine import Machine

AXES = "ABC"
Angles = tuple[float, float, float]
STILL = 1e-9  # mm or rad: what moves less does not


def angles(m: Machine) -> Angles:
    """Where A, B and C stand, degrees."""
    a, b, c = map(math.degrees, m.rotary)
    return a, b, c


def set_angles(m: Machine, to: Angles) -> None:
    """The next row arrives at these angles, degrees."""
    m.change("rotary", tuple(map(math.radians, to)))


def turning_feed(m: Machine) -> float:
    """The modal feed for axes that turn alone: the number of the program as degrees a minute, a reading in inches too."""
    return m.feed_of(None) / (m.variable_unit if m.per_rev else m.feed_unit)


def turn_axes(m: Machine, to: Angles, f: float | None) -> None:
    """Turn to angles (degrees) while the tip stands; `f` is in degrees a minute, infinite at rapid, None the modal feed.

    The time of a rapid turn is not known: no limits of rotary axes are.
    """
    way = max(abs(new - old) for new, old in zip(to, angles(m), strict=True))
    set_angles(m, to)
    rate = turning_feed(m) if f is None else f
    kind = Kind.LINE if math.isfinite(rate) else Kind.RAPID
    m.add_row(kind, m.tip, feed=math.radians(rate), time=60 * way / rate if kind == Kind.LINE else math.nan)


def roll(m: Machine, cylinder: Cylinder, points: NDArray[np.float64], angles: NDArray[np.float64],
         ways: NDArray[np.float64], f: float | None) -> None:  # fmt: skip
    """Go through tips (n, 3) of the program with the axis of a cylinder of the program at angles (n,), rad.

    A row takes the time of its way (n,) mm along the developed surface at `f` mm/min; where the tip stands its feed is that of
    the axis, rad/min. Places where nothing moves are passed over.
    """
    rate, before = m.feed_of(f), list(m.rotary)
    kind, axis = (Kind.LINE if math.isfinite(rate) else Kind.RAPID), cylinder.rotary
    index = m.recorder.cylinder(cylinder.behind(m.matrix))
    size = math.hypot(*m.matrix[:3, 0].tolist())
    for point, angle, way in zip(points.tolist(), angles.tolist(), ways.tolist(), strict=True):
        tip, turn = m.to_machine(point), abs(angle - m.rotary[axis])
        if (length := math.dist(tip, m.tip)) < STILL:
            if turn < STILL:
                continue
            tip = m.tip
        m.put(cylinder=index, from_angle=m.rotary[axis])
        to = list(m.rotary)
        to[axis] = angle
        m.put(rotary=tuple(to))
        if kind == Kind.RAPID:
            m.add_row(kind, tip, feed=rate)
        else:
            seconds = 60 * way * size / rate
            m.add_row(kind, tip, feed=60 * (turn if tip is m.tip else length) / seconds, time=seconds)
        m.programmed, m.tip = (point[0], point[1], point[2]), tip
    m.put(cylinder=NONE, from_angle=NAN)
    if m.rotary != tuple(before):
        m.log("rotary", m.rotary)
