"""Straight lines and arcs: L, C, CR, CT, polar LP, CP, CTP, with feed and side of the tool (catalogue: coordinates, R0 RL RR)."""

from __future__ import annotations

import math
from typing import Any

from mnclab.controls.tnc_620.cycles.chain import to_angle, to_rotary
from mnclab.controls.tnc_620.language import secondary_axes
from mnclab.controls.tnc_620.language.checks import counted, one_of, refuse_on_cylinder
from mnclab.controls.tnc_620.language.feeds import FEED_WORDS, feed
from mnclab.controls.tnc_620.language.machine_datum import machine_target
from mnclab.controls.tnc_620.language.pole import angle_here, plane_of, polar_point, pole, within_plane
from mnclab.controls.tnc_620.language.rotary_rules import refuse_rotary
from mnclab.controls.tnc_620.state import Place, memory
from mnclab.geometry.arcs import tangent_arc_of_one
from mnclab.machine.control import Function, FunctionTable, Words
from mnclab.machine.coordinates import AXES as AXES_OF_ROTATION
from mnclab.machine.coordinates import PLANES, Angles, angles, set_angles, turn_axes
from mnclab.machine.machine import Machine
from mnclab.path.corners import Corner
from mnclab.text.program import Word

FUNCTIONS = FunctionTable()
AXES = "XYZ"
SIDES = {"R0": 0, "RL": 1, "RR": -1}
#: FMAX holds for its block alone, and the manual's own program C210 (6.10) has such a move after it.
FEED_NEEDED = "write F or FMAX; with the setting feed_needed = False such a move is at rapid, with a warning"
SIDED = f"R0 RL RR {FEED_WORDS}"
SAME = 1e-9  # rad: an end at the angle of the start is a whole turn
ON_CYLINDERS = ("L", "CR", "CT")  # 9.2; with RND and CHF
TOLERANCE = 0.016  # mm between the radii at start and end of an arc (catalogue: C)


def coordinates(m: Machine, words: Words, axes: str = AXES) -> dict[str, Any]:
    """Targets of the axes that are written, as arguments of a verb (`x=`, …); IX counts from the register.

    X of the contour of a cylinder may be in degrees: it is mm from here on.
    """
    unit = memory(m).developed
    if unit is not None and words.code not in ON_CYLINDERS:
        refuse_on_cylinder(m, words)
    written = {k: words[axis] for k, axis in enumerate(AXES) if axis in axes and axis in words}
    if (active := memory(m).machine_datum) is not None:
        refuse_on_cylinder(m, words)
        return machine_target(m, active, written)
    return {"xyz"[k]: counted(m, word, m.programmed[k], unit if unit and not k else 1.0) for k, word in written.items()}


def side(m: Machine, words: Words, begins: bool) -> None:
    """R0 RL RR: only a straight line or an approach begins or ends the compensation; others may repeat it."""
    word = one_of(m, words, SIDES, "one of R0, RL, RR")
    if word is None:
        return
    wanted = SIDES[word.address]
    if wanted != m.side and not begins:
        what = f"{word} cannot {'begin' if wanted else 'end'} the radius compensation in {words.code}"
        m.alarm(what, word, "write it in a straight line L")
    m.change("side", wanted)


@FUNCTIONS("L", "Straight line", takes=f"X Y Z U V W A B C PR PA {SIDED}", source="4.11, example")
def line(m: Machine, words: Words) -> None:
    """From the present position to the programmed point at feed, or with FMAX at rapid; axes not written keep their value."""
    f = feed(m, words)
    side(m, words, begins=True)
    carried, to = secondary_axes.move(m, words), coordinates(m, words)
    if polar := [words[name] for name in ("PR", "PA") if name in words]:  # a block of the manual is printed so
        if to:
            m.alarm(f"{polar[0].address} and coordinates of axes stand in one block", polar[0], hint="write LP PR… PA…")
        m.warn("L with polar coordinates is read as LP", polar[0])
        to |= polar_point(m, words)
    turns = [words[axis] for axis in AXES_OF_ROTATION if axis in words]
    if turns and (turned := rotary_angles(m, words)) != angles(m):
        refuse_rotary(m, turns[0])
        if memory(m).developed is not None:
            m.alarm(f"{turns[0]}: the contour of a cylinder has X and Y alone, X for the rotary axis", turns[0])
        target = m.to_machine(m.target(to.get("x"), to.get("y"), to.get("z")))
        if math.dist(target, m.tip) <= 1e-9:  # a frame rounds
            turn_axes(m, turned, f)
            return
        set_angles(m, turned)
    if to or carried:
        if f is None and m.feed is None:
            if m.settings["feed_needed"]:
                m.alarm("no feed rate was programmed before this move", hint=FEED_NEEDED)
            m.warn("no feed rate was programmed before this move: it is at rapid")
            f = math.inf
        m.line(**to, f=f)


@FUNCTIONS("LP", "Straight line, polar", takes=f"PR PA {SIDED}", source="10.1, example")
def polar_line(m: Machine, words: Words) -> None:
    """To a point given by its distance and angle from the pole CC."""
    f = feed(m, words)
    side(m, words, begins=True)
    m.line(**polar_point(m, words), f=f)


def rotary_angles(m: Machine, words: Words) -> Angles:
    """Where the rotary axes go, degrees, behind their shift and mirror image; IA counts from where it stands."""
    found = list(angles(m))
    for k, axis in enumerate(AXES_OF_ROTATION):
        if axis in words:
            found[k] = to_rotary(m, k, counted(m, words[axis], to_angle(m, k, found[k])))
    return found[0], found[1], found[2]


def sense(m: Machine, words: Words) -> int:
    """DR+ counter-clockwise (1), DR- clockwise (-1)."""
    if "DR" not in words:
        m.alarm(f"{words.code} needs the sense of rotation", hint="write DR+ (counter-clockwise) or DR- (clockwise)")
    word = words["DR"]
    if word.value not in ("+", "-"):
        m.alarm(f"{words.code} DR (sense of rotation) must be DR+ or DR-, got {word}", word)
    return 1 if word.value == "+" else -1


def turning_sense(what: Function, word: Word, _: int) -> str:
    sense = {"+": "counter-clockwise", "-": "clockwise"}.get(str(word.value))
    return f"sense of rotation ({sense})" if sense and word.address == "DR" else ""


@FUNCTIONS("C", "Circular path around CC", takes=f"X Y Z DR {SIDED}", source="8.3, example")
def circle(m: Machine, words: Words) -> None:
    """An arc around the centre CC, in its plane; an end equal to the start is a full circle."""
    f = feed(m, words)
    side(m, words, begins=False)
    (plane, about), turning = pole(m, words, "circle centre"), sense(m, words)
    refuse_rapid(m, words)
    if outside := next((words[axis] for axis in AXES if axis in words and axis not in plane), None):
        m.alarm(f"C {outside}: the circle centre CC lies in {plane}", outside, f"write CC {outside.address}… before it")
    centre = dict(zip(PLANES[plane], about, strict=False))
    with within_plane(m, words, plane):
        m.arc(**coordinates(m, words, plane), sense=turning, centre=centre, f=f, tolerance=TOLERANCE)


@FUNCTIONS("CP", "Circular path, polar; helix", takes=f"PA X Y Z DR {SIDED}", source="10.1, example")
def polar_circle(m: Machine, words: Words) -> None:
    """Around the pole CC on the present radius: to the angle PA, or by the angle IPA of any number of turns.

    The axis across the plane of the pole (Z, where that is XY) makes a helix.
    """
    f = feed(m, words)
    side(m, words, begins=False)
    turning, (plane, about) = sense(m, words), pole(m, words)
    refuse_rapid(m, words)
    if inside := next((words[axis] for axis in AXES if axis in words and axis in plane), None):
        across = AXES[PLANES[plane][2]]
        m.alarm(f"CP {inside}: the pole lies in {plane}, a helix has its end in {across}", inside)
    if "PA" not in words:
        m.alarm("CP needs PA (polar angle of the end) or IPA (angle travelled)")
    word, here = words["PA"], angle_here(m, words)
    value, level = m.value(word), next(iter(coordinates(m, words).values()), None)
    if not word.incremental:
        away = turning * (math.radians(value) - here) % math.tau
        travel = turning * (away if SAME < away < math.tau - SAME else math.tau)
    elif value == 0:
        m.alarm("CP IPA (angle travelled) must not be 0", word)
    elif (value > 0) != (turning > 0):
        m.alarm(f"CP IPA{value:+g} and DR{'+' if turning > 0 else '-'} turn in opposite senses", word)
    else:
        travel = math.radians(value)
    with within_plane(m, words, plane):
        m.turn(about, travel, level, f)


@FUNCTIONS("CR", "Circular path with radius", takes=f"X Y Z R DR {SIDED}", source="9.2")
def circle_by_radius(m: Machine, words: Words) -> None:
    """An arc of a radius, in the plane of its axes: up to half a turn, with a negative radius more."""
    f = feed(m, words)
    side(m, words, begins=False)
    turning, plane, to = sense(m, words), plane_of(m, words), coordinates(m, words)
    refuse_rapid(m, words)
    if "R" not in words:
        m.alarm("CR needs the radius R")
    radius = m.value(words["R"])
    if radius == 0:
        m.alarm("CR R (radius) must not be 0", words["R"])
    if all(abs(one - other) < 1e-3 for one, other in zip(end(m, to), m.programmed, strict=True)):
        m.alarm("CR needs an end other than its start", words["R"], hint="a full circle is written with CC and C")
    with within_plane(m, words, plane):
        m.arc(**to, sense=turning, radius=radius, f=f, word=words["R"])


@FUNCTIONS("CT", "Circular path with tangential connection", takes=f"X Y Z {SIDED}", source="8.13, example")
def tangential_circle(m: Machine, words: Words) -> None:
    """An arc that goes on where the element before it points, in the plane of its axes; straight ahead it is a line."""
    f = feed(m, words)
    side(m, words, begins=False)
    refuse_rapid(m, words)
    plane, to = plane_of(m, words), coordinates(m, words)
    if not to:
        m.alarm(f"CT needs {m.plane[0]} or {m.plane[1]} of its end")
    with within_plane(m, words, plane):
        tangent_arc(m, words, to, f)


@FUNCTIONS("CTP", "Tangential arc, polar", takes=f"PR PA {SIDED}", source="Klartext, not described")
def polar_tangent_arc(m: Machine, words: Words) -> None:
    """An arc that goes on where the element before it points, to a polar point."""
    f = feed(m, words)
    side(m, words, begins=False)
    refuse_rapid(m, words)
    plane, _ = pole(m, words)
    with within_plane(m, words, plane):
        tangent_arc(m, words, polar_point(m, words), f)


def end(m: Machine, to: dict[str, float]) -> Place:
    """The whole point of a target."""
    return m.target(to.get("x"), to.get("y"), to.get("z"))


def tangent_arc(m: Machine, words: Words, to: dict[str, float], f: float | None) -> None:
    """From where the tool stands, tangent to the element before, to a point of the plane."""
    first, second, _ = PLANES[m.plane]
    travel, stop = heading(m, words), end(m, to)
    one, other = ((point[first], point[second]) for point in (m.programmed, stop))
    if math.dist(one, other) < 1e-3:
        m.alarm(f"{words.code} needs an end other than its start")
    found = tangent_arc_of_one(one, other, travel)
    if found is None:
        m.alarm(f"{words.code}: the end lies straight behind the element before, no tangential arc leads there")
    (u, v), turning = found
    if turning == 0:
        m.line(*stop, f=f)
    else:
        m.arc(*stop, sense=turning, centre={first: u, second: v}, f=f, tolerance=TOLERANCE)


def heading(m: Machine, words: Words) -> tuple[float, float]:
    """The unit tangent at the end of the path element directly before, in program coordinates of the plane."""
    first, second, normal = PLANES[m.plane]
    before, travel = m.recorder.last(), m.heading()
    if before is None or travel is None:
        m.alarm(f"{words.code} needs a path element directly before it", hint="whose end gives the direction")
    if isinstance(before[1], Corner):
        word = "RND" if before[1].label == "rounding" else "CHF"
        m.alarm(f"{words.code} cannot follow {word}: its direction is that of the element before")
    here, on = m.to_program(m.tip), m.to_program(a + b for a, b in zip(m.tip, travel, strict=True))
    way = [b - a for a, b in zip(here, on, strict=True)]
    if abs(way[normal]) > 1e-9:
        plane = "the working plane" if m.plane == "XY" else f"the plane {m.plane}"
        m.alarm(f"{words.code} needs a path element in {plane} directly before it")
    u, v = way[first], way[second]
    length = math.hypot(u, v)
    return u / length, v / length


def scaled(m: Machine, length: float) -> float:
    """A length of the program in the plane, mm on the machine."""
    return length * math.hypot(*m.frames.matrix[:3, PLANES[m.plane][0]].tolist())


def refuse_rapid(m: Machine, words: Words) -> None:
    if "FMAX" in words:
        m.alarm(f"{words.code} runs at feed: FMAX is for straight lines", words["FMAX"])
