"""A probe moves until its ball touches the part, and stops there; where it only positions, a contact is an alarm.

What the control knows of its probe stands in the tables: the radius of the ball, the length (to the south pole of the ball),
the offset of the ball from the spindle axis. The part meets the probe as it is: `Setup(true_tools=…)` and the truths of
`Probe`. So a probe that is not calibrated measures wrong, as on a machine. So does one on rotary axes whose centres are not
where the control has them: `Setup(true_kinematics=…)`.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from mnclab.geometry.curves import turned
from mnclab.geometry.kinematics import moved
from mnclab.machine.axes import direction as direction_of_tool
from mnclab.machine.axes import orientation, truth
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
from mnclab.workpiece.part.touching import GRAZE, blocked, released

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
    """The ball as it is: where its centre stands beside the tip, its radius, the way up its stem, and what leads from the tip as
    the control has it to where that truly is (4, 4), None where both are one."""

    beside: Floats
    radius: float
    up: Floats
    moved: Floats | None = None

    def at(self, tip: Any) -> Floats:
        """Where its centre truly is on the part while the control has the tip at a place (…, 3)."""
        there = np.asarray(tip)
        return (there if self.moved is None else moved(self.moved, there)) + self.beside

    def way(self, direction: Floats) -> Floats:
        """How it truly goes on the part while the control has the tip go in a direction (3,)."""
        return direction if self.moved is None else self.moved[:3, :3] @ direction


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
    """An offset (x, y) of the ball from the spindle axis, turned with spindle and rotary axes, on the part (3,)."""
    found, turn = np.zeros(3), math.radians((m.spindle_angle or 0.0) - m.tables.probe.angle)
    first, second, _ = next(axes for axes in PLANES.values() if axes[2] == tool_axis(m))
    x, y = of
    found[[first, second]] = x * math.cos(turn) - y * math.sin(turn), x * math.sin(turn) + y * math.cos(turn)
    return orientation(m) @ found


def ball_from_axis(m: Machine) -> tuple[float, float]:
    """How far the ball stands from the spindle axis by the table, in the plane XY of the program."""
    if m.tables.probe.offset == (0.0, 0.0):
        return 0.0, 0.0
    x, y, _ = (m.matrix[:3, :3].T @ offset(m, m.tables.probe.offset)).tolist()
    return x, y


def up_the_tool(m: Machine) -> Floats:
    """The direction (3,) on the part from the tip up the tool, as the control has it."""
    if m.tables.kinematics is not None:
        return direction_of_tool(m)
    up = np.array(m.matrix[:3, 2 if FRAME in m.frames else tool_axis(m)])
    return np.asarray(up / np.linalg.norm(up))


def true_ball(m: Machine, ball: float) -> Ball:
    """The ball of the tool in the spindle, as it is; `ball` is the radius where nobody says it."""
    true = m.setup.true_tools.get(m.tool.number)
    radius = ball if true is None else true.effective_radius
    longer = 0.0 if true is None else true.effective_length - m.tool.effective_length
    where = m.tables.probe.offset if m.setup.probe.true_offset is None else m.setup.probe.true_offset
    if (there := truth(m)) is None:
        up = up_the_tool(m)
        return Ball(offset(m, where) + up * (radius - longer), radius, up)
    up = there.orientation[:, 2]
    beside = there.orientation @ orientation(m).T @ offset(m, where)
    return Ball(beside + up * (radius - longer), radius, up, there.moved)


class Way(NamedTuple):
    """A straight way of the tip, as the control has it: from where, which way, how far at most, and the ball that goes it."""

    start: Floats
    direction: Floats
    reach: float
    ball: Ball

    @property
    def begin(self) -> Floats:
        """Where the centre of the ball truly begins."""
        return self.ball.at(self.start)

    @property
    def ahead(self) -> Floats:
        """Which way it truly goes."""
        return self.ball.way(self.direction)


def way_to(m: Machine, target: Point, ball: float, word: Word | None) -> Way:
    """The way to a point in program coordinates."""
    start, goal = np.array(m.tip), np.array(m.to_machine(target))
    reach = float(np.linalg.norm(goal - start))
    if reach == 0:
        m.alarm("a touch needs a direction", word)
    return Way(start, (goal - start) / reach, reach, true_ball(m, ball))


def part_that_is_touched(m: Machine, word: Word | None) -> Part:
    """The part; an Alarm where there is none."""
    if m.setup.part is None:
        m.alarm("there is no part to touch", word, hint='give one: Setup(part=…); "cut" is what the program has cut')
    part = m.felt.part if m.felt else part_to_touch(m, word)
    assert part is not None
    m.variables.state_read = m.step
    if m.turning:
        m.warn("the spindle turns with a touch probe in it", hint="M5 before a touch probe moves")
    return part


def touch(m: Machine, target: Point, f: float, ball: float, word: Word | None, miss: str) -> Contact:
    """Move the tip (the south pole of the ball) towards a point in program coordinates at feed `f`.

    No contact is an alarm, or with `miss="return"` an answer that is no `hit`. Radius compensation is refused,
    and a ball that stands in the material already.
    """
    if m.side:
        m.alarm("a probe cannot move under radius compensation", word)
    part, way = part_that_is_touched(m, word), way_to(m, target, ball, word)
    begin, ahead, reach, true = way.begin, way.ahead, way.reach, way.ball
    room = float(part(begin)[0])
    if room - true.radius < -DEEP - slack(m):
        m.alarm("the stylus is in contact before it touches", word, hint="the touch begins where the ball is free")
    # a ball that only rests on the part goes along it, and on to what stands in its way
    travel = contact(part, begin, ahead, min(true.radius, max(room - RESTS, DEEP)), reach)
    if travel is not None and not part.exact and not foot(part, begin + ahead * travel)[1]:
        hint = "it may touch a little later; parts of boxes, holes, slots, pockets and bosses with one axis are exact there"
        m.warn("the ball touches off a cut edge of the part, where the distance is only bounded", word, hint=hint)
    if travel is not None:
        travel += trigger(m, orientation(m).T @ way.direction)
    end = go_along(m, part, way, travel, f, word)
    if travel is None and miss == "alarm":
        m.alarm(f"touch point inaccessible: the probe did not trigger within {reach:g} mm", word)
    centre = _point(end + offset(m, m.tables.probe.offset) + up_the_tool(m) * ball)
    number = -1 if travel is None else noted(m, way, travel, 1, centre, ball)
    return Contact(m.to_program(centre), centre, travel is not None, _point(end), number)


def release(m: Machine, target: Point, f: float, ball: float, word: Word | None) -> bool:
    """Move a probe that touches towards a point in program coordinates until its ball is free; whether it came to that."""
    part, way = part_that_is_touched(m, word), way_to(m, target, ball, word)
    travel = released(part, way.begin, way.ahead, way.ball.radius, way.reach)
    end = go_along(m, part, way, travel, f, word)
    if travel is not None:
        centre = _point(end + offset(m, m.tables.probe.offset) + up_the_tool(m) * ball)
        noted(m, way, travel, -1, centre, ball)
    return travel is not None


def go_along(m: Machine, part: Part, way: Way, travel: float | None, f: float, word: Word | None) -> Floats:
    """A probing move of so much of a way, or of all of it; where it ends, machine coordinates (3,). The stem must not touch."""
    far = way.reach if travel is None else travel
    if (stopped := stem_meets(m, part, way.ball, way.begin, way.begin + way.ahead * far)) is not None:
        m.probe_to(_point(way.start + way.direction * stopped), f)
        m.alarm("the stem of the probe touches the part before the ball does", word)
    end = way.start + way.direction * far
    m.probe_to(_point(end), f)
    return end


def noted(m: Machine, way: Way, travel: float, sense: int, centre: Point, ball: float) -> int:
    """Keep a touch for `run.touches`: the part lies ahead of the ball, with the sense -1 behind it. Its number."""
    touched = way.begin + way.ahead * travel
    surface = _point(touched + sense * way.ahead * way.ball.radius)
    found = m.to_program(_point(np.array(centre) + sense * way.direction * ball))
    m.touches.append(
        Touched(m.step, m.source_line, m.program, m.label, _point(way.begin), _point(touched),
                _point(sense * way.ahead), way.ball.radius, surface, m.to_program(centre), found, m.matrix, axes_of(m))
    )  # fmt: skip
    return len(m.touches) - 1


def rests(m: Machine, ball: float, word: Word | None) -> bool:
    """Whether the ball touches the part where it stands."""
    true = true_ball(m, ball)
    return float(part_that_is_touched(m, word)(true.at(m.tip))[0]) - true.radius <= RESTS


def deflected(m: Machine, part: Part | None, ball: float) -> bool:
    """Whether the stylus stands in contact already."""
    true = true_ball(m, ball)
    return part is not None and float(part(true.at(m.tip))[0]) - true.radius < -DEEP - slack(m)


def trigger(m: Machine, direction: Floats) -> float:
    """How far the probe goes on after the contact until it triggers, in a direction as the tool has it: its deflection, and its
    randomness."""
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
        begin, ahead, radius = ball.at(start), ball.way(direction), max(ball.radius - DEEP - slack(m), DEEP)
        end = begin + ahead * way
        far = is_free(part, begin, end, radius)
        free = None if far else contact(part, begin, ahead, radius, way, GRAZE)
        stem = stem_meets(m, part, ball, begin, end)
        stopped = min((each for each in (free, stem) if each is not None), default=None)
        if stopped is not None:
            m.line(*m.to_program(_point(start + direction * stopped)), f=feed)
            which = "stylus" if stopped == free else "stem of the probe"
            hint = "the axes stop there; a larger clearance, another height or nominal sizes nearer to the part help"
            if not part.exact and not foot(part, begin + ahead * stopped)[1]:
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
    centres = ball.at(moved(m.matrix, places))
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
    directions = directions_of_rows(path.annotated(kinematics=m.setup.kinematics), tilts, axes)
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
