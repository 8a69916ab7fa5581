"""What the axes of a machine can do, and how it takes corners and rapids."""

from __future__ import annotations

import math
from dataclasses import dataclass, fields
from typing import Any

import numpy as np

from mnclab.path.columns import Array
from mnclab.text.alarm import Alarm
from mnclab.text.given import check_number, fitting_class, plain, shown
from mnclab.text.tables import written

PerAxis = float | tuple[float, ...]

CORNERS = {
    "tolerance": "a corner is cut by at most corner_tolerance, within the axes' acceleration (and jerk)",
    "deviation": "junction deviation: the speed of a circle that leaves the corner by corner_tolerance, within short rows",
    "grbl": "junction deviation as Grbl 1.1 has it, which on short rows asks the axes for more than they have",
    "jump": "no axis may change its speed at a corner by more than corner_jump",
}
RAPIDS = {
    "axes": "each axis at its own speed and acceleration, until it arrives",
    "proportional": "speeds in the ratio of the distances, each axis with its own acceleration",
    "line": "along the straight line, as a feed move at the greatest speed",
}
LEAST, MOST = 1e-3, 1e9  # of every limit, in its unit: beyond them a time is no number any more
TRAVEL = "travel=((0, 400), (0, 300), (-200, 0)): from and to of X, Y and Z, machine coordinates of the spindle, mm"


@fitting_class
@dataclass(frozen=True)
class Limits:
    """Per axis, or one number for all: `rapid` mm/min, `acceleration` mm/s², `jerk` mm/s³ (None: no limit).

    `rapid` is the greatest speed of an axis, at feed too. `corner_speed` (`CORNERS`) says how fast a corner is
    taken, `corner_tolerance` mm how far it may be cut (0 stops wherever an axis would jump), `corner_jump` mm/min by
    how much the speed of an axis may jump under "jump". `rapid_motion` (`RAPIDS`) is how a rapid goes, None: as
    the control has it. `spindle` is the greatest speed, rev/min; `spindle_acceleration` rev/min in a second, None: at
    once; `tool_change` seconds. `travel` holds how far each axis goes, `((x0, x1), (y0, y1), (z0, z1))` mm, in machine
    coordinates of the spindle reference (a lathe's X as radius; inf: without an end): a run stops where it is left.
    The defaults are those of a small machining centre whose spindle and tool changer take no time.

    An Alarm names a limit that makes no sense: each is from 0.001 to 1e9 in its unit, or 0 where that has a meaning.
    """

    rapid: PerAxis = 10_000.0
    acceleration: PerAxis = 1_000.0
    jerk: PerAxis | None = None
    corner_tolerance: float = 0.0
    travel: tuple[tuple[float, float], ...] | None = None
    corner_speed: str = "tolerance"
    corner_jump: PerAxis = 0.0
    rapid_motion: str | None = None
    spindle: float = math.inf
    spindle_acceleration: float | None = None
    tool_change: float = 0.0

    __repr__ = written

    def __post_init__(self) -> None:
        for name in ("rapid", "acceleration", "jerk", "spindle", "spindle_acceleration"):
            if getattr(self, name) is not None or name not in ("jerk", "spindle_acceleration"):
                self._check(name, LEAST)
        for name in ("corner_tolerance", "corner_jump", "tool_change"):
            self._check(name, 0)
        for name, known in (("corner_speed", (*CORNERS,)), ("rapid_motion", (*RAPIDS, None))):
            value = getattr(self, name)
            if not isinstance(value, str | None) or value not in known:
                names = ", ".join(each for each in known if each)
                raise Alarm(f"limit {name} must be one of {names}, got {shown(value)}")
        if self.travel is not None:
            self._check_travel(self.travel)
        for each in fields(self):
            object.__setattr__(self, each.name, plain(getattr(self, each.name)))

    def _check(self, name: str, least: float) -> None:
        value = getattr(self, name)
        many = name in ("rapid", "acceleration", "jerk", "corner_jump") and isinstance(value, tuple | list)
        if many and len(value) not in (1, 3):
            raise Alarm(f"limit {name} takes one number or three (X Y Z), got {len(value)}")
        for each in value if many else (value,):
            above, endless = 0 if least else None, name == "spindle"
            check_number(each, f"limit {name}", above=above, at_least=least, at_most=MOST, endless=endless)

    def _check_travel(self, travel: Any) -> None:
        if not isinstance(travel, tuple | list) or len(travel) != 3:
            raise Alarm(f"limit travel takes a pair for each of X, Y and Z, got {shown(travel)}", hint=TRAVEL)
        for axis, pair in zip("XYZ", travel):
            if not isinstance(pair, tuple | list) or len(pair) != 2:
                raise Alarm(f"limit travel takes two positions for {axis}, got {shown(pair)}", hint=TRAVEL)
            for each in pair:
                check_number(each, f"limit travel of {axis}", endless=True)
            if not pair[0] < pair[1]:
                raise Alarm(f"limit travel of {axis} must go up, got {pair[0]:g} to {pair[1]:g}", hint=TRAVEL)

    def axes(self, name: str) -> Array:
        """A limit (3,) for X, Y, Z in mm and s; infinite where there is none."""
        value = getattr(self, name)
        per_second = 60.0 if name in ("rapid", "corner_jump") else 1.0
        return np.broadcast_to(np.asarray(math.inf if value is None else value, np.float64), 3) / per_second
