"""A probe moves until its ball touches the part, and stops there; where it only positions, a contact is an alarm.

What the control knows of its probe stands in the tables: the radius of the ball, the length (to the south pole of the ball),
the offset of the ball from the spindle axis. The part meets the probe as it is: `Setup(true_tools=…)` and the truths of
`Probe`. So a probe that is not calibrated measures wrong, as on a machine.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from mnclab.geometry.curves import turned
from mnclab.machine.coordinates import FRAME, LOG, PLANES, axes_of, tool_axis
from mnclab.machine.cutting import CUT, TILT, directions_of_rows, part_before, start_known
from mnclab.machine.measuring import Touched
from mnclab.machining.probing.sequences import Approach, Steps
from mnclab.machining.steps import Measure, Step, Touch, Write
from mnclab.path.toolpath import Kind, Toolpath, concatenate
from mnclab.text.alarm import Alarm
from mnclab.text.program import Word
from mnclab.workpiece.cutting import UPRIGHT
from mnclab.workpiece.part import Part, box, contact, cylinder, foot, hole
from mnclab.workpiece.part.touching import GRAZE, blocked

if TYPE_CHECKING:
    from mnclab.machine.machine import Machine
    from mnclab.path.tool import Tool


#: What a cycle that probes does (`Cycle.does`): its places are those of the ball, or of the spindle axis.
PROBES, FEELS = "probes", "feels"
DEEP = 1e-6  # mm, by which a ball may stand in the material where its touch begins: it only rests on it
RESTS = 1e-9  # mm, between a ball that rests on the part and the part
ALONG = 0.5  # mm between the places of an arc, or of a stem, that are looked at
PLACES = 17  # on a row that are looked at first
SHARES = np.linspace(0.0, 1.0, PLACES)
SPREADS = 6  # standard deviations of a trigger that are not taken for a collision
FOLLOWED = ("", "probe")  # kinds of tools that may be a touch probe
Point = tuple[float, float, float]
Floats = np.ndarray[Any, np.dtype[np.float64]]


class Contact(NamedTuple):
    """Where the centre of the ball stood at the contact, as the control knows it: in program and in machine coordinates, mm.

    `tip` is the south pole in machine coordinates, `number` that of the touch in `run.touches` (from 0), -1 without a hit.
    """

    point: Point
    machine_point: Point
    hit: bool
    tip: Point = (0.0, 0.0, 0.0)
    number: int = -1


class Felt(NamedTuple):
    """What a cycle that probes feels: the part (None: there is none), and whether its places are those of the ball; or the
    tool setter."""

    part: Part | None
    by_ball: bool
    setter: bool = False


class Ball(NamedTuple):
    """The ball as it is: where its centre stands beside the programmed tip, its radius, and the way up its stem."""

    beside: Floats
    radius: float
    up: Floats


def unfit(m: Machine, *, still: bool = False) -> Iterator[tuple[str, str]]:
    """Why a probing cycle cannot run with what is in the spindle: faults without a parameter; `still`: it must not turn."""
    if not m.tool.number:
        axis = " and its axis" if "TOOL CALL" in m.control.functions else ""
        yield "", f"needs a tool call before it, which names the probe{axis}"
    elif m.tool.kind not in FOLLOWED:
        yield "", f"needs a touch probe in the spindle, T{m.tool.number} is a {m.tool.kind}"
    elif not m.tool.effective_radius > 0:
        yield "", f"needs a touch probe in the spindle, T{m.tool.number} has a ball of radius {m.tool.effective_radius:g}"
    elif still and m.turning:
        yield "", "needs a spindle that stands still: a touch probe is in it"
    elif m.side:
        yield "", "cannot run under radius compensation"


def part_to_touch(m: Machine, word: Word | None = None) -> Part | None:
    """The part of the setup, or what the program has cut up to here: only that needs the path of the tool settled."""
    if m.setup.part != CUT:
        return m.setup.part
    m.settle()
    return part_before(m, word)


def offset(m: Machine, of: tuple[float, float]) -> Floats:
    """An offset (x, y) of the ball from the spindle axis, turned with the spindle, in machine coordinates (3,)."""
    found, turn = np.zeros(3), math.radians((m.spindle_angle or 0.0) - m.tables.probe.angle)
    first, second, _ = next(axes for axes in PLANES.values() if axes[2] == tool_axis(m))
    x, y = of
    found[[first, second]] = x * math.cos(turn) - y * math.sin(turn), x * math.sin(turn) + y * math.cos(turn)
    return found


def ball_from_axis(m: Machine) -> tuple[float, float]:
    """How far the ball stands from the spindle axis by the table, in the plane XY of the program."""
    if m.tables.probe.offset == (0.0, 0.0):
        return 0.0, 0.0
    x, y, _ = (m.matrix[:3, :3].T @ offset(m, m.tables.probe.offset)).tolist()
    return x, y


def true_ball(m: Machine, ball: float) -> Ball:
    """The ball of the tool in the spindle, as it is; `ball` is the radius where nobody says it."""
    true = m.setup.true_tools.get(m.tool.number)
    up = np.array(m.matrix[:3, 2 if FRAME in m.frames else tool_axis(m)])
    up /= np.linalg.norm(up)
    radius = ball if true is None else true.effective_radius
    longer = 0.0 if true is None else true.effective_length - m.tool.effective_length
    where = m.tables.probe.offset if m.setup.probe.true_offset is None else m.setup.probe.true_offset
    return Ball(offset(m, where) + up * (radius - longer), radius, up)


def touch(m: Machine, target: Point, f: float, ball: float, word: Word | None, miss: str) -> Contact:
    """Move the tip (the south pole of the ball) towards a point in program coordinates at feed `f`.

    No contact is an alarm, or with `miss="return"` an answer that is no `hit`. Radius compensation is refused,
    and a ball that stands in the material already.
    """
    if m.side:
        m.alarm("a probe cannot move under radius compensation", word)
    if m.setup.part is None:
        m.alarm("there is no part to touch", word, hint='give one: Setup(part=…); "cut" is what the program has cut')
    part = m.felt.part if m.felt else part_to_touch(m, word)
    assert part is not None
    m.variables.state_read = m.step
    start, goal = np.array(m.tip), np.array(m.to_machine(target))
    reach = float(np.linalg.norm(goal - start))
    if reach == 0:
        m.alarm("a touch needs a direction", word)
    direction, true = (goal - start) / reach, true_ball(m, ball)
    begin = start + true.beside
    room = float(part(begin)[0])
    if room - true.radius < -DEEP - slack(m):
        m.alarm("the stylus is in contact before it touches", word, hint="the touch begins where the ball is free")
    # a ball that only rests on the part goes along it, and on to what stands in its way
    travel = contact(part, begin, direction, min(true.radius, max(room - RESTS, DEEP)), reach)
    if travel is not None and not part.exact and not foot(part, begin + direction * travel)[1]:
        hint = "it may touch a little later; parts of boxes, holes, slots, pockets and bosses with one axis are exact there"
        m.warn("the ball touches off a cut edge of the part, where the distance is only bounded", word, hint=hint)
    if travel is not None:
        travel += trigger(m, direction)
    way = reach if travel is None else travel
    if (stopped := stem_meets(m, part, true, begin, begin + direction * way)) is not None:
        m.probe_to(_point(start + direction * stopped), f)
        m.alarm("the stem of the probe touches the part before the ball does", word)
    end = start + direction * way
    m.probe_to(_point(end), f)
    if travel is None and miss == "alarm":
        m.alarm(f"touch point inaccessible: the probe did not trigger within {reach:g} mm", word)
    centre = _point(end + offset(m, m.tables.probe.offset) + np.array(true.up) * ball)
    number = -1
    if travel is not None:
        number = len(m.touches)
        surface = _point(begin + direction * (travel + true.radius))
        found = m.to_program(_point(np.array(centre) + direction * ball))
        m.touches.append(
            Touched(m.step, m.source_line, m.program, m.label, _point(begin), _point(begin + direction * travel),
                    _point(direction), true.radius, surface, m.to_program(centre), found, m.matrix, axes_of(m))
        )  # fmt: skip
    return Contact(m.to_program(centre), centre, travel is not None, _point(end), number)


def deflected(m: Machine, part: Part | None, ball: float) -> bool:
    """Whether the stylus stands in contact already."""
    true = true_ball(m, ball)
    return part is not None and float(part(np.array(m.tip) + true.beside)[0]) - true.radius < -DEEP - slack(m)


def trigger(m: Machine, direction: Floats) -> float:
    """How far the probe goes on after the contact until it triggers: its deflection, and its randomness."""
    probe = m.setup.probe
    more = float(np.abs(direction) @ np.array(probe.deflection))
    if probe.spread:
        more += float(np.random.default_rng((int(probe.seed), len(m.touches))).normal(0.0, probe.spread))
    return more


def slack(m: Machine) -> float:
    """By how much the ball may stand in the material after a touch, mm."""
    return max(m.setup.probe.deflection) + SPREADS * m.setup.probe.spread


def stem_meets(m: Machine, part: Part, ball: Ball, begin: Floats, end: Floats) -> float | None:
    """How far the probe goes until its stem touches; None where it does not, or where nobody says how thick it is."""
    probe = m.setup.probe
    if not probe.stem or not (end != begin).any():
        return None
    return blocked(part, begin, end, DEEP, max(probe.stem - DEEP - slack(m), DEEP), probe.stem_length, ball.up)


def is_free(part: Part, begin: Floats, end: Floats, radius: float) -> bool:
    """Whether a ball surely touches nothing on a straight way: a few places whose gaps reach over those between them."""
    step = float(np.linalg.norm(end - begin)) / (PLACES - 1)
    gaps = ((part.bound or part)(begin + (end - begin) * SHARES[:, None]) - radius) / part.steep
    return bool((gaps[:-1] + gaps[1:] >= step - DEEP / 2).all() and (gaps > 0).all())


def guarded(m: Machine, part: Part, target: Point, feed: float | None) -> None:
    """Position the probe on a straight line; a contact stops it with an alarm (MNC 12.20, TNC 620 13.1)."""
    start, goal = np.array(m.tip), np.array(m.to_machine(target))
    way = float(np.linalg.norm(goal - start))
    if way > 0:
        ball, direction = true_ball(m, m.tool.effective_radius), (goal - start) / way
        begin, radius = start + ball.beside, max(ball.radius - DEEP - slack(m), DEEP)
        end = begin + direction * way
        far = is_free(part, begin, end, radius)
        free = None if far else contact(part, begin, direction, radius, way, GRAZE)
        stem = stem_meets(m, part, ball, begin, end)
        stopped = min((each for each in (free, stem) if each is not None), default=None)
        if stopped is not None:
            m.line(*m.to_program(_point(start + direction * stopped)), f=feed)
            which = "stylus" if stopped == free else "stem of the probe"
            hint = "the axes stop there; a larger clearance, another height or nominal sizes nearer to the part help"
            if not part.exact and not foot(part, begin + direction * stopped)[1]:
                hint = "its distance is only bounded there: what is taken out of it should stick out by more than the ball"
            m.alarm(f"path obstructed: the {which} touches the part at {place_of(m, m.programmed)} while positioning", hint=hint)
    m.line(*target, f=feed)


def guarded_turn(m: Machine, part: Part, centre: tuple[float, float], angle: float, feed: float | None) -> None:
    """The same on an arc of the plane XY."""
    start = np.array(m.programmed)
    spoke = start[:2] - centre
    count = 2 + math.ceil(abs(angle) * float(np.linalg.norm(spoke)) / ALONG)
    turns = np.linspace(0.0, angle, min(count, 4000))
    places = np.column_stack([turned(np.broadcast_to(spoke, (len(turns), 2)), turns) + centre, np.full(len(turns), start[2])])
    ball = true_ball(m, m.tool.effective_radius)
    centres = np.array([m.to_machine(place) for place in places.tolist()]) + ball.beside
    hit = np.flatnonzero(part(centres) < ball.radius - DEEP - slack(m))
    if len(hit):
        m.alarm(f"path obstructed: the stylus touches the part at {place_of(m, places[hit[0]])} while positioning")
    m.turn(centre, angle, None, feed)


def _point(xyz: Floats) -> Point:
    x, y, z = xyz.tolist()
    return x, y, z


def place_of(m: Machine, point: Sequence[float] | Floats) -> str:
    """In the unit of the program."""
    found = (f"{axis}{round(float(value), 3) / m.variable_unit + 0.0:.4g}" for axis, value in zip("XYZ", point, strict=True))
    return " ".join(found)


# A probe that the program drives into the part outside the cycles: on a machine it triggers, and the axes stop.
# Cycles that probe guard their own moves; here the blocks between them are judged, once the program is over.

CHORD = 1e-3  # mm
MOST = 5000  # rows that are judged


def stop_at_part(m: Machine) -> None:
    """Cut the run at the first block that leads the ball of a probe into the part of the setup: an Alarm.

    Judged is a tool of the kind "probe", from where its place is known, as long as it stands upright.
    """
    part = m.setup.part
    if not isinstance(part, Part) or not m.settled:
        return
    path = concatenate(m.settled)
    probes = [number for number, tool in m.tables.tools.items() if tool.kind == "probe"]
    rows = path.is_motion & (path.kind != Kind.PROBE) & np.isin(path.tool, probes) & (path.label == 0)
    tilts, axes = (m.logs.changed(name, m.step) for name in (TILT, LOG))
    directions = directions_of_rows(path, tilts, axes)
    if directions is not None:
        rows &= (directions[..., 2] > UPRIGHT).all(axis=1)
    rows[: start_known(path, m.setup.start)[1]] = False
    for row in np.flatnonzero(rows)[:MOST].tolist():
        place = _met(m, part, path, row)
        if place is not None:
            m.cut = int(path.step[row])
            m.settled = [path[path.step < m.cut]]
            message = f"path obstructed: the probe touches the part near {place_of(m, m.to_program(place))} while positioning"
            hint = "lead it around the part, or over it: it is in Setup(part=…)"
            raise Alarm(message, m.flow.span_of_step(m.cut), hint=hint)


def _met(m: Machine, part: Part, path: Toolpath, row: int) -> tuple[float, float, float] | None:
    """Where the tip stands when the ball meets the part on a row, machine coordinates; None if it does not."""
    tool = m.tables.tools[int(path.tool[row])]
    true = m.setup.true_tools.get(tool.number, tool)
    up = true.effective_radius + tool.effective_length - true.effective_length
    beside = np.array([*m.setup.probe.where, up])
    radius = max(true.effective_radius - DEEP - slack(m), DEEP)
    if path.kind[row] == Kind.ARC:
        places = path[row : row + 1].points(CHORD)[0]
        hit = np.flatnonzero(part(places + beside) < radius)
        found = places[hit[0]] if len(hit) else None
    else:
        way = path.end[row] - path.start[row]
        length = float(np.linalg.norm(way))
        travel = contact(part, path.start[row] + beside, way, radius, length, GRAZE) if length else None
        found = None if travel is None else path.start[row] + way * (travel / length)
    return None if found is None else (float(found[0]), float(found[1]), float(found[2]))


# A touch probe is calibrated: what touches tell of its length, its radius and its offset, and where that is written.
# While it calibrates, a cycle sends the spindle axis (`Cycle.does = FEELS`): the offset of the table counts for nothing.

Pair = Sequence[float]
WALL, HIGH = 10.0, 40.0  # mm, of a figure where nobody gave a part: its wall, and how far it goes down


def ring(m: Machine, radius: float) -> Part:
    """A ring about the place of the tip."""
    (x, y, z), out = m.tip, radius + WALL
    return box((x - out, y - out, z - HIGH), (x + out, y + out, z + WALL)) - hole((x, y, z + WALL), 2 * radius, HIGH + WALL)


def stud(m: Machine, radius: float, top: float) -> Part:
    """A round stud below the tip, up to a height of the machine."""
    x, y, _ = m.tip
    return cylinder((x, y, top - HIGH), (x, y, top), radius)


def plane_of(m: Machine, tip: Point) -> tuple[float, float]:
    """The coordinates of a place of the machine along the axes that the offset counts along."""
    first, second, _ = next(axes for axes in PLANES.values() if axes[2] == tool_axis(m))
    return tip[first], tip[second]


def offset_written(m: Machine, centre: Pair, turned: Pair, touches: Sequence[int] = ()) -> Iterator[Step]:
    """Write the offset of the ball, from the centres of a figure that the spindle axis found (machine coordinates).

    With the spindle at the angle of the probe table it lay off the figure by the offset, and the other way when the spindle was
    turned by 180 degrees (MNC 12.25, TNC 620 17.4).
    """
    probe = m.tables.probe
    x, y = ((b - a) / 2 for a, b in zip(centre, turned, strict=True))
    yield Measure("offset X", x, probe.offset[0], touches=tuple(touches))
    yield Measure("offset Y", y, probe.offset[1], touches=tuple(touches))
    yield Write("probe", replace(probe, offset=(x, y)))


def length_touched(m: Machine, a: Approach, x: float, y: float, surface: float) -> Steps:
    """A touch downwards on a surface whose height is known, and back; writes the length."""
    z = m.programmed[2]
    contact = yield Touch("touch from above", x, y, z - a.reach, a.feed, a.ball)
    yield a.go("back", z)
    found = m.tool.effective_length + m.to_program(contact.tip)[2] - surface
    yield Measure("length", found, m.tool.effective_length, touches=(contact.number,))
    yield from with_length(m, found)


def with_length(m: Machine, length: float) -> Iterator[Step]:
    """Write the length of the probe in the spindle, without a delta: the tip is elsewhere, nothing moves."""
    yield from _written(m, [replace(tool, length=length, dl=0.0) for tool in _both(m)])


def with_radius(m: Machine, radius: float) -> Iterator[Step]:
    """Write the radius of the probe in the spindle, without a delta."""
    yield from _written(m, [tool.of_radius(radius) for tool in _both(m)])


def _both(m: Machine) -> tuple[Tool, Tool]:
    """The row of the table and the tool in the spindle, which may have other deltas."""
    return m.tables.tools.get(m.tool.number, m.tool), m.tool


def _written(m: Machine, tools: Sequence[Tool]) -> Iterator[Step]:
    yield Write("tools", tools[0], m.tool.number)
    yield Write("tool", tools[1], label="calibrated")
