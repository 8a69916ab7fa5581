"""The rows of a machine: what one move or event adds to the path.

The feed of a move is known beforehand, except where it depends on the way: a move in a given time is as fast as it is
long, and at constant cutting speed the spindle follows X, and a feed per revolution follows the spindle. Such a row has
the mean feed of its way, the speed at its end, and in the columns `surface`, `speed_limit` and `spindle_x` what
the speed on the way follows from.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any, NoReturn

import numpy as np
from numpy.typing import NDArray

from mnclab.machine.coordinates import NORMALS, PLANES, normal
from mnclab.path.cutting_speed import mean_turn, spindle_speed
from mnclab.path.kinds import Kind
from mnclab.path.recorder import NAN, State
from mnclab.text.given import LARGEST

if TYPE_CHECKING:
    from mnclab.machine.machine import Machine

Point = tuple[float, float, float]
LEAST_FEED = 1e-18  # mm/min: below, the time of a move is no number any more
PARTS = 64  # of an arc, within each of which the radius is taken as changing evenly


def add_row(
    m: Machine, kind: Kind, tip: Point, centre: Point = (NAN, NAN, NAN), angle: float = 0.0, feed: float = NAN,
    time: float = NAN, joint: Any = None,
) -> None:  # fmt: skip
    """Add a row that ends at a tip. A feed below 0 is the time of the move, in seconds with a minus."""
    recorder, number = m.recorder, -1
    if joint is not None:
        number = len(recorder.joints)
        recorder.joints.append(joint)
    other_feed = m.per_rev and feed != (m.feed or 0.0) * abs(m.spindle_speed)  # a rapid, or a feed in mm/min of a cycle
    if feed < 0:
        time, feed = -feed, -60 * length(m, kind, tip, centre, angle) / feed
    if m.surface is not None and kind <= Kind.PROBE:
        if m.per_rev and not other_feed:
            assert m.feed is not None
            feed = m.feed / mean_turn(m.surface, radii(m, kind, tip, centre, angle), m.speed_limit)
        m.change("speed", speed_at(m, tip))
    x, y, z = tip
    here = -LARGEST < x < LARGEST and -LARGEST < y < LARGEST and -LARGEST < z < LARGEST and -LARGEST < angle < LARGEST
    if not here or LARGEST <= feed < math.inf or feed < LEAST_FEED or time >= LARGEST or kind == Kind.ARC:
        refuse_large(m, tip, centre, angle, feed, time)
    state = row_state(m) if m.row_state is None else m.row_state
    if m.exact_here and not m.exact:
        state = recorder.state(recorder.states[state]._replace(exact=True))
    if other_feed:
        state = recorder.state(recorder.states[state]._replace(per_rev=NAN))
    label = recorder.label(m.label) if m.label else 0
    recorder.add((kind, m.source_line, m.step, label, *tip, *centre, angle, feed, time, number, state))


def refuse_large(
    m: Machine, tip: Point, centre: Point = (NAN, NAN, NAN), angle: float = 0.0, feed: float = NAN, time: float = NAN
) -> None:  # fmt: skip
    """An Alarm where a row would have a number too large for a program to write, or none at all."""
    for name, end, middle in zip("XYZ", tip, centre, strict=True):
        if not -LARGEST < end < LARGEST and not (m.recorded_only and end != end):  # where it begins is not known yet
            _too_large(m, f"{name} of the tool in the machine", end, "mm")
        if not np.isnan(middle) and not -LARGEST < middle < LARGEST:
            _too_large(m, f"{name} of the centre of the arc in the machine", middle, "mm")
    if not -LARGEST < angle < LARGEST:
        _too_large(m, "the angle of the arc", math.degrees(angle), "degrees")
    if LARGEST <= feed < math.inf or feed < LEAST_FEED:
        _too_large(m, "the feed rate", feed, "mm/min")
    if time >= LARGEST:
        _too_large(m, "the time", time, "s")


def _too_large(m: Machine, what: str, found: float, unit: str) -> NoReturn:
    allowed = f"at least {LEAST_FEED:g}" if 0 <= found < LEAST_FEED else f"smaller than {LARGEST:g}"
    m.alarm(f"{what} must be {allowed} {unit}, and would be {found:.7g}")


def row_state(m: Machine) -> int:
    """The state that rows made now share."""
    if m.row_state is None:
        for name, angle in zip("ABC", m.rotary, strict=True):
            if not -LARGEST < angle < LARGEST:
                _too_large(m, f"the angle of {name}", math.degrees(angle), "degrees")
        if not abs(m.spindle_speed) < LARGEST:
            _too_large(m, "the spindle speed", abs(m.spindle_speed), "rev/min")
        axis = NORMALS[m.plane] if m.shift is not None else normal(m.matrix, *PLANES[m.plane][:2])
        per_rev = m.feed if m.per_rev and m.feed is not None else NAN
        cutting = {}
        if m.surface is not None:
            cutting = {"surface": m.surface, "speed_limit": m.speed_limit, "spindle_x": spindle_axis(m)}
        m.row_state = m.recorder.state(
            State(
                program=m.program, axis=axis, rotary=m.rotary, cylinder=m.cylinder, from_angle=m.from_angle,
                per_rev=per_rev, spindle=m.spindle_speed,
                tool=m.tool.number, radius=m.tool.effective_radius, side=m.side * m.orientation,
                corner_rule=m.corner_rule, exact=m.exact, synchronous=m.synchronous, tolerance=m.tolerance, **cutting,
            )
        )  # fmt: skip
    return m.row_state


def spindle_axis(m: Machine) -> float:
    """Where the spindle axis lies, machine coordinates: at X0 of the program."""
    return m.to_machine((0.0, 0.0, 0.0))[0]


def speed_at(m: Machine, tip: Point) -> float:
    """The spindle speed that the constant cutting speed asks for at a tip, rev/min; the present one without it."""
    if m.surface is None:
        return m.speed
    return float(spindle_speed(m.surface, tip[0] - spindle_axis(m), m.speed_limit))


def length(m: Machine, kind: Kind, tip: Point, centre: Point, angle: float) -> float:
    """The length of a row from where the tool stands, mm."""
    if kind != Kind.ARC:
        return math.dist(m.tip, tip)
    spoke, axis = np.subtract(m.tip, centre), np.array(m.recorder.states[row_state(m)].axis)
    along = float(np.subtract(tip, m.tip) @ axis)
    return math.hypot(float(np.linalg.norm(spoke - (spoke @ axis) * axis)) * angle, along)


def radii(m: Machine, kind: Kind, tip: Point, centre: Point, angle: float) -> NDArray[np.float64]:
    """Signed distances (k,) from the spindle axis, at equal steps of the way; between them straight."""
    here = spindle_axis(m)
    if kind != Kind.ARC:
        return np.array([m.tip[0] - here, tip[0] - here])
    turn = np.linspace(0.0, angle, PARTS + 1)
    spoke, axis = np.subtract(m.tip, centre), np.array(m.recorder.states[row_state(m)].axis)
    across = float(np.cross(axis, spoke)[0])
    return np.asarray(centre[0] - here + spoke[0] * np.cos(turn) + across * np.sin(turn))
