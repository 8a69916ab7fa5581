"""What a tool does at a hole or in a pocket, step by step: plain data, made by strategies, carried out by a machine.

z is a coordinate along the tool axis, x and y count from the axis of the hole or the middle of the pocket; mm, mm/min,
rev/min, s, angles of turns in rad. None keeps a coordinate. A feed of inf is rapid, a feed of None the feed that is
active. ``label`` says what is happening, for listings and pictures.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from mnclab.geometry.contours import Contour

RAPID = math.inf


class Go(NamedTuple):
    """A straight move."""

    label: str
    z: float | None = None
    feed: float | None = RAPID
    x: float | None = None
    y: float | None = None


class Turn(NamedTuple):
    """Round a centre by an angle, counter-clockwise where it is positive, by as many turns as it has; a helix with z."""

    label: str
    angle: float
    z: float | None = None
    feed: float | None = None
    centre: tuple[float, float] = (0.0, 0.0)


class Along(NamedTuple):
    """Along a contour of the plane, level, from its start, where the tool stands."""

    label: str
    contour: Contour
    feed: float | None = None


class Thread(NamedTuple):
    """A straight move by ``pitch`` (mm of its way, positive) for each revolution of the spindle."""

    label: str
    z: float | None
    pitch: float
    x: float | None = None


class Wait(NamedTuple):
    """A dwell; none for zero seconds."""

    label: str
    seconds: float


class Spin(NamedTuple):
    """The spindle turns +1 clockwise (M3), -1 counter-clockwise (M4) or 0 not; without a speed it keeps the one it has."""

    label: str
    turning: int
    speed: float | None = None


class Orient(NamedTuple):
    """The spindle stops at an angle, degrees."""

    label: str
    angle: float


class Coolant(NamedTuple):
    """The coolant is switched."""

    label: str
    on: bool


Step = Go | Turn | Along | Thread | Wait | Spin | Orient | Coolant
