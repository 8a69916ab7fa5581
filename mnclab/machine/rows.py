"""The rows of a machine: what one move or event adds to the path.

The feed of a move is known beforehand, except where it depends on the way: a move in a given time is as fast as it is
long, and at constant cutting speed the spindle follows X, and a feed per revolution follows the spindle. Such a row has
the mean feed of its way, the speed at its end, and in the columns `surface`, `speed_limit` and `spindle_x` what
the speed on the way follows from.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import replace
from typing import TYPE_CHECKING, Any, NoReturn

import numpy as np
from numpy.typing import NDArray

from mnclab.geometry.arcs import centre_of_one, sweep_of_one
from mnclab.machine import axes
from mnclab.machine.coordinates import NORMALS, PLANES, in_mm, normal
from mnclab.machine.state import Place
from mnclab.path import compensation, corners, feeds, leads
from mnclab.path.feeds import mean_turn, spindle_speed
from mnclab.path.limits import first_beyond, stopped_at
from mnclab.path.listing import INCHES, MM, Unit
from mnclab.path.recorder import NAN, State, join
from mnclab.path.toolpath import Kind, PathFault, Toolpath, concatenate
from mnclab.text.alarm import WARNING, Alarm
from mnclab.text.given import LARGEST
from mnclab.text.program import Word

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
    if m.recorded_only and math.isnan(angle):
        m.alarm("the arc has no start: nothing before it in the contour names both coordinates", None, "begin with a line")
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


# Arcs of a machine and what they must be: a radius that reaches, a centre as far from the end as from the start.
# And turns about a centre, which have no such faults.
# Points are pairs in mm in the axes of the plane.

Pair = tuple[float, float]


def check_start(m: Machine, tolerance: float = 0.01, word: Word | None = None) -> None:
    """An Alarm when the register is not where the tool stands: an arc could not begin there."""
    if (away := math.dist(m.to_machine(m.programmed), m.tip)) > tolerance:
        unit = told_in(m)
        begins = f"the arc begins {away / unit.length:.{unit.decimals}f} {unit.short} away from the tool"
        fault = f"{begins}: a transformation was switched after the last move"
        m.alarm(fault, word, hint="lead the tool to the start of the arc by a straight move first")


def centre_by_radius(
    m: Machine, s: Pair, e: Pair, radius: float, sense: int, tolerance: float, word: Word | None
) -> Pair:
    """The centre of the arc of a signed radius; an Alarm when the radius does not reach, and by how much."""
    if math.dist(s, e) < 1e-3:
        m.alarm("a full circle cannot be given by its radius", word, hint="write the centre with I J K")
    c, shortage = centre_of_one(s, e, radius, sense)
    if shortage > tolerance:
        unit, short = told_in(m).length, told_in(m).short
        half, address = (shortage + abs(radius)) / unit, word.address if word else "R"
        between = f"the distance {2 * half:.7g} {short} between start and end: at least {half:.7g} {short} is needed"
        hint = f"too short by {shortage / unit:.4g} {short}"
        m.alarm(f"{address}{abs(radius) / unit:g} is too small for {between}", word, hint)
    return c


def check_radii(m: Machine, s: Pair, e: Pair, c: Pair, tolerance: float, word: Word | None) -> None:
    """An Alarm when the centre lies on the start, or the end not on the circle about it."""
    at_start, at_end = math.dist(s, c), math.dist(e, c)
    if at_start < 1e-9:
        m.alarm("the centre of the arc lies on its start", word)
    if abs(at_start - at_end) > tolerance:
        unit = told_in(m)
        there, here = (f"{each / unit.length:.{unit.decimals}f}" for each in (at_start, at_end))
        allowed = f"allowed difference {tolerance / unit.length:.4g} {unit.short}"
        m.alarm(f"the end point is not on the circle: radius {there} at the start, {here} at the end, {allowed}", word)


def told_in(m: Machine) -> Unit:
    """In what the lengths of this program are told."""
    return MM if m.variable_unit == 1 else INCHES


def arc(
    m: Machine, point: Place, sense: int, centre: Mapping[int, float] | None, radius: float | None, feed: float,
    word: Word | None, tolerance: float, turns: int = 1,
) -> None:  # fmt: skip
    """An arc of the active plane to a point, by its centre or by a signed radius, in so many turns."""
    check_start(m, tolerance, word)
    first, second, _ = PLANES[m.plane]
    here, given = m.programmed, centre or {}
    s, e = (here[first], here[second]), (point[first], point[second])
    if radius is not None:
        c = centre_by_radius(m, s, e, radius, sense, tolerance, word)
    else:
        c = (given.get(first, s[0]), given.get(second, s[1]))
        check_radii(m, s, e, c, tolerance, word)
    angle = (sweep_of_one(s, e, c, sense) + math.tau * sense * (turns - 1)) * on_machine(m, word)
    middle = list(here)
    middle[first], middle[second] = c
    tip = m.to_machine(point)
    m.add_row(Kind.ARC, tip, m.to_machine(middle), angle, feed)
    m.programmed, m.tip = point, tip


def on_machine(m: Machine, word: Word | None = None) -> int:
    """-1 where the frame turns arcs over, else 1; an alarm when it would turn the circle into an ellipse."""
    if m.shift is None and not m.keeps_circles:
        m.alarm("an arc under unequal scales of its plane would be an ellipse", word)
    return m.orientation


def turn(m: Machine, centre: Pair, angle: float, level: float | None = None, f: float | None = None) -> None:
    """Round a point of the plane by an angle (rad, any number of turns), to a level along its normal.

    A whole turn ends where it began.
    """
    first, second, normal = PLANES[m.plane]
    feed, sense = m.feed_of(f), on_machine(m)
    check_start(m)
    point, middle = list(m.programmed), list(m.programmed)
    middle[first], middle[second] = centre
    u, v = point[first] - centre[0], point[second] - centre[1]
    if abs(rest := math.remainder(angle, 2 * math.pi)) > 1e-12:
        c, s = math.cos(rest), math.sin(rest)
        point[first], point[second] = centre[0] + c * u - s * v, centre[1] + s * u + c * v
    if level is not None:
        point[normal] = level
    x, y, z = point
    m.add_row(Kind.ARC, m.to_machine(point), m.to_machine(middle), angle * sense, feed)
    m.programmed, m.tip = (x, y, z), m.to_machine(point)


# Settling: the passes run on the rows that a machine has made, so that the true place of the tool is known.
# Settled once at the end of a run, and before anything that observes the tool: a departure, a touch, an actual position.

def settle(m: Machine, unfinished: bool = False) -> None:
    """Corners, compensation, leads; `unfinished` says that an alarm broke the program off.

    A fault is an Alarm at the block of its row, and the machine notes the step from which nothing counts.
    """
    piece = m.recorder.take()
    if not len(piece):
        return
    m.programmed_pieces.append(piece)
    recorder = m.recorder
    for label in (*(joint.label for joint in recorder.joints), *([compensation.CORNER] if piece.side.any() else ())):
        recorder.label(label)
    piece = piece.annotated(labels=tuple(recorder.labels), joints=tuple(recorder.joints))
    start = end_of_settled(m)
    if start is not None and start != tuple(piece.start[0].tolist()):
        piece = piece.replace(start=np.concatenate([[start], piece.start[1:]]))
    report = compensation.Report()
    try:
        passed = _passes(m, piece, unfinished, report)
    except PathFault as fault:
        m.cut = fault.step
        m.settled.append(_before(m, piece[piece.step < fault.step]))
        for gouge in report.gouges:  # that the control does not see
            if gouge.step < fault.step:
                message = in_mm(gouge.message, m.variable_unit)
                m.alarms.append(Alarm(message, m.flow.span_of_step(gouge.step), WARNING, gouge.hint))
        raise Alarm(in_mm(fault.message, m.variable_unit), m.flow.span_of_step(fault.step), hint=fault.hint) from None
    finally:
        m.gouges += report.gouges
    for message, step, hint in report.remarks():
        m.alarms.append(Alarm(in_mm(message, m.variable_unit), m.flow.span_of_step(step), WARNING, hint))
    m.altered |= passed is not piece
    m.settled.append(passed)


def stop_at_travel(m: Machine) -> None:
    """Cut the run at the first block that leads out of the travel of the machine, as its limit switch would: an Alarm."""
    if m.setup.limits.travel is None or not m.settled:
        return
    path, travel = concatenate(m.settled), np.array(m.setup.limits.travel, dtype=np.float64)
    if m.setup.kinematics is None:
        found = first_beyond(path, np.array(m.setup.start), travel)
    else:
        path = path.annotated(kinematics=m.setup.kinematics)
        tools, corrected = (m.logs.changed(name, m.step) for name in ("tool", axes.CHAIN))
        lengths = axes.lengths_of_rows(path.step, tools, m.tables.tools[0].effective_length)
        found = axes.first_beyond(path, lengths, travel, corrected)
    if found is None:
        return
    m.cut = int(path.step[found.row])
    m.settled = [path[path.step < m.cut]]
    axis, (low, high) = "XYZ"[found.axis], travel[found.axis].tolist()
    mm = " mm" if m.variable_unit != 1 else ""
    place = f"{axis}{found.position:.3f} in machine coordinates, and goes from {low:g} to {high:g}{mm}"
    hint = "Limits(travel=…) says how far the axes go, and counts the spindle reference, not the tip of the tool"
    message = f"{axis} leaves the travel of the machine: the spindle would be at {place}"
    alarm = Alarm(message, m.flow.span_of_step(m.cut), hint=hint)
    m.stopped = stopped_at(path, found, travel, alarm)
    raise alarm


def _passes(m: Machine, piece: Toolpath, unfinished: bool, report: compensation.Report | None = None) -> Toolpath:
    turned, gouge = corners.apply(piece, unfinished), str(m.settings.get("gouge", "refuse"))
    rules = m.control.compensation
    if rules is not None:
        rules = replace(rules.chosen(m.settings), look_ahead=rules.look_ahead or m.look_ahead)
    path = compensation.apply(turned, rules, unfinished, gouge, report)
    path = leads.apply(path, turned, unfinished)
    path = feeds.apply(path, m.feed_rules)
    return feeds.broken(path, m.setup.limits.rapid) if m.settings.get("rapid_path") == "broken" else path


def _before(m: Machine, piece: Toolpath) -> Toolpath:
    """The tool-centre path up to a fault; its last element ends nobody knows where and is left out."""
    try:
        return _passes(m, piece, True)
    except PathFault:
        return piece[:0]


def end_of_settled(m: Machine) -> tuple[float, float, float] | None:
    """Where the tool-centre path ends so far, machine coordinates; None before its first row."""
    for path in reversed(m.settled):
        if len(path):
            x, y, z = path.end[-1].tolist()
            return x, y, z
    return None


def paths(m: Machine) -> tuple[Toolpath, Toolpath]:
    """The programmed contour and the tool-centre path of a whole run, relative to the origin; one path if no pass acted."""
    programmed = join(m.programmed_pieces, m.recorder)
    if m.cut is not None:
        programmed = programmed[programmed.step < m.cut]
    if m.cut is None and not m.altered:
        return (_shown(m, programmed),) * 2
    return _shown(m, programmed), _shown(m, concatenate(m.settled))


def _shown(m: Machine, path: Toolpath) -> Toolpath:
    """A path relative to the origin, with the labels and joints known at the end."""
    origin = np.array(m.origin or (0.0, 0.0, 0.0))
    if origin.any() and len(path):
        vertices = np.concatenate([path.start[:1], path.end]) - origin
        centre = path.centre if path.centre.strides[0] == 0 else path.centre - origin
        path = path.replace(start=vertices[:-1], end=vertices[1:], centre=centre)
        if not np.isnan(path.surface).all():
            path = path.replace(spindle_x=path.spindle_x - origin[0])
    notes = {"labels": tuple(m.recorder.labels), "joints": tuple(m.recorder.joints), "origin": tuple(origin)}
    notes["cylinders"] = tuple(one.moved(-origin) for one in m.recorder.cylinders)
    unit = {"inches": m.variable_unit != 1, "tenths": m.feed_unit != m.variable_unit}
    return path.annotated(**notes, **unit, lathe=m.control.lathe, kinematics=m.setup.kinematics)


def shifted(m: Machine) -> Iterator[compensation.Gouge]:
    """The places where the tool did not fit, relative to the origin of the paths."""
    for gouge in m.gouges:
        yield gouge._replace(place=tuple(np.subtract(gouge.place, m.origin or (0.0, 0.0, 0.0)).tolist()))
