"""A probe moves until its ball touches the part, and stops there; where it only positions, a contact is an alarm.

What the control knows of its probe stands in the tables: the radius of the ball, the length (to the south pole of the ball),
the offset of the ball from the spindle axis. The part meets the probe as it is: `Setup(true_tools=…)` and the truths of
`Probe`. So a probe that is not calibrated measures wrong, as on a machine.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from mnclab.geometry.vectors import turned
from mnclab.machine.coordinates import PLANES
from mnclab.machine.cut_so_far import CUT, part_before
from mnclab.machine.measuring import Touched
from mnclab.machine.tool_axis import FRAME, axes_of, tool_axis
from mnclab.text.program import Word
from mnclab.workpiece.part import Part, contact, foot
from mnclab.workpiece.part.rows import blocked
from mnclab.workpiece.part.touching import GRAZE

if TYPE_CHECKING:
    from mnclab.machine.machine import Machine

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
