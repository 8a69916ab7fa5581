"""Straight lines and arcs, Cartesian and polar, and what is put between them: L, C, CR, CT, CC, LP, CP, CTP, RND, CHF."""

from __future__ import annotations

import math
from contextlib import AbstractContextManager
from typing import Any

from mnclab.controls.tnc_620.language import tools
from mnclab.controls.tnc_620.language.auxiliary import FEED_WORDS, feed, machine_target, rate
from mnclab.controls.tnc_620.language.rotary import turned
from mnclab.controls.tnc_620.language.values import above_zero, counted, in_units, one_of, refuse_on_cylinder
from mnclab.controls.tnc_620.state import Place, memory
from mnclab.geometry.arcs import tangent_arc_of_one
from mnclab.machine.axes import leaning
from mnclab.machine.control import Function, FunctionTable, Words
from mnclab.machine.coordinates import PLANES
from mnclab.machine.machine import Machine
from mnclab.path.corners import Chamfer, Corner, Open, Prolonged, Rounding
from mnclab.text.program import Word

# CC, the circle centre and pole, and points told by their distance and angle from it (catalogue: CC, LP, CP).
# The pole lies in the plane of the axes that CC names: the working plane, or with the tool axis among them another one. Angles
# count from X in XY, from Y in YZ and from Z in ZX, positive towards the other axis of the plane (angle reference axes of the
# HEIDENHAIN pilots; DR+ turns the same way).

FUNCTIONS = FunctionTable()
NEAR = 1e-6  # mm from the pole, where a direction means nothing
AXES = "XYZ"


def axes_of(plane: str) -> tuple[str, str]:
    """The letters of the first and the second axis of a plane."""
    return plane[0], plane[1]


def plane_of(m: Machine, words: Words) -> str:
    """The plane of the axes that a block names: the working plane, unless the tool axis is one of two."""
    named = [axis for axis in AXES if axis in words]
    if set(named) <= set(m.plane):
        return m.plane
    outside = next(words[axis] for axis in named if axis not in m.plane)
    if len(named) != 2:
        what = f"{words.code} {outside}: outside the working plane {m.plane} a circle names the two axes of its plane"
        m.alarm(what, outside, f"for example {words.code} {m.plane[0]}… {outside.address}…")
    return next(plane for plane in ("XY", "YZ", "ZX") if set(plane) == set(named))


def within_plane(m: Machine, words: Words, plane: str) -> AbstractContextManager[None]:
    """Inside, arcs lie in a plane that need not be the working plane."""
    if plane == m.plane:
        return m.within()
    if m.side:
        what = f"{words.code}: an arc in {plane} cannot stand under radius compensation, which lies in {m.plane}"
        m.alarm(what, hint="write R0 in a straight line before it")
    return m.within(plane=plane)


@FUNCTIONS("CC", "Circle centre, pole", takes="X Y Z", source="8.3, example")
def centre(m: Machine, words: Words) -> None:
    """No motion; a coordinate that is not written is that of the last programmed position, which IX and IY count from.

    X and Z, or Y and Z, make a centre in the plane ZX or YZ.
    """
    refuse_on_cylinder(m, words)
    plane = plane_of(m, words)
    here = ((axis, m.programmed[AXES.index(axis)]) for axis in axes_of(plane))
    u, v = (counted(m, words[axis], at) if axis in words else at for axis, at in here)
    m.pole = u, v
    m.log("pole", m.pole)
    if plane != memory(m).pole_plane:
        memory(m).pole_plane = plane
        m.log("pole plane", plane)


def pole(m: Machine, words: Words, meaning: str = "pole") -> tuple[str, tuple[float, float]]:
    """The plane of the pole and the pole in it."""
    refuse_on_cylinder(m, words)
    if m.pole is None:
        m.alarm(f"{words.code} needs a {meaning}: no CC was programmed", hint="write CC X… Y… before it")
    plane = memory(m).pole_plane
    return plane, m.pole


def away(m: Machine, plane: str, about: tuple[float, float]) -> tuple[float, float]:
    """From the pole to the present position."""
    first, second, _ = PLANES[plane]
    return m.programmed[first] - about[0], m.programmed[second] - about[1]


def angle_here(m: Machine, words: Words) -> float:
    """The polar angle of the present position, rad; an Alarm at the pole itself."""
    u, v = away(m, *pole(m, words))
    if math.hypot(u, v) < NEAR:
        what = f"{words.code}: the tool stands at the pole, where it has no polar angle"
        m.alarm(what, words.get("PA"), "write the angle PA, absolute")
    return math.atan2(v, u)


def polar_point(m: Machine, words: Words) -> dict[str, Any]:
    """The point of PR and PA, by axes of its plane (`x=`, …); one that is not written stays as it is.

    IPR and IPA count from the present position.
    """
    plane, (u, v) = pole(m, words)
    if "PR" not in words and "PA" not in words:
        m.alarm(f"{words.code} needs PR (polar radius) or PA (polar angle)")
    radius = math.hypot(*away(m, plane, (u, v)))
    if "PR" in words and (radius := counted(m, words["PR"], radius)) < 0:
        m.alarm(f"{words.code} PR (polar radius) must be at least 0, got {in_units(m, words['PR'], radius):g}", words["PR"])
    if "PA" not in words or words["PA"].incremental:
        turn = m.value(words["PA"]) if "PA" in words else 0.0
        angle = math.degrees(angle_here(m, words)) + turn if radius else 0.0
    else:
        angle = m.value(words["PA"])
    c, s = cosine_and_sine(angle)
    first, second = axes_of(plane.lower())
    return {first: u + radius * c, second: v + radius * s}


def cosine_and_sine(angle: float) -> tuple[float, float]:
    """Of an angle in degrees, exact at whole quarters of a turn."""
    quarters = angle / 90
    if quarters == round(quarters):
        return ((1.0, 0.0), (0.0, 1.0), (-1.0, 0.0), (0.0, -1.0))[round(quarters) % 4]
    return math.cos(math.radians(angle)), math.sin(math.radians(angle))


# Straight lines and arcs: L, C, CR, CT, polar LP, CP, CTP, with feed and side of the tool (catalogue: coordinates, R0 RL RR).

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
    if wanted and (degrees := leaning(m)):
        what = f"{word} needs the tool square to the working plane, and it leans by {degrees:.4g} degrees"
        m.alarm(what, word, "turn the rotary axes to Q120 to Q122 before, or tilt with TURN")
    m.change("side", wanted)


@FUNCTIONS("L", "Straight line", takes=f"X Y Z U V W A B C PR PA {SIDED}", source="4.11, example")
def line(m: Machine, words: Words) -> None:
    """From the present position to the programmed point at feed, or with FMAX at rapid; axes not written keep their value."""
    f = feed(m, words)
    side(m, words, begins=True)
    carried, to = tools.move(m, words), coordinates(m, words)
    if polar := [words[name] for name in ("PR", "PA") if name in words]:  # a block of the manual is printed so
        if to:
            m.alarm(f"{polar[0].address} and coordinates of axes stand in one block", polar[0], hint="write LP PR… PA…")
        m.warn("L with polar coordinates is read as LP", polar[0])
        to |= polar_point(m, words)
    if not turned(m, words, to, f) and (to or carried):
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


# What is put between two path elements: RND, CHF (catalogue: RND, CHF), M97 and M98 at the end of a block.

ELEMENTS = ("L", "LP", "C", "CR", "CT", "CP", "CTP", "FL", "FLT", "FC", "FCT")


@FUNCTIONS("RND", "Corner rounding", takes="R F", collects=True, source="8.13, example")
def rounding(m: Machine, words: Words) -> None:
    """A tangent arc between the element before and the one after; F counts for the rounding alone."""
    join(m, words, Rounding, "R", "rounding radius")


@FUNCTIONS("CHF", "Chamfer", takes="length F", collects=True, source="9.2")
def chamfer(m: Machine, words: Words) -> None:
    """Cuts a corner of two lines off, the length along each of them; F counts for the chamfer alone."""
    join(m, words, Chamfer, "length", "chamfer side length")


def join(m: Machine, words: Words, make: type[Rounding] | type[Chamfer], address: str, meaning: str) -> None:
    shown = f"{words.code} {address}" if address.isupper() else words.code
    if address not in words:
        m.alarm(f"{words.code} needs the {'radius R' if address == 'R' else meaning}")
    size = scaled(m, above_zero(m, words[address], f"{shown} ({meaning})"))
    own_feed = rate(m, words["F"], f"{words.code} F (feed rate)") if "F" in words else math.nan
    if not m.mark_joint(make(size, m.step, own_feed)):
        last = m.recorder.last()
        hint = "M97 or M98 stands there" if last and isinstance(last[1], Prolonged | Open) else ""
        m.alarm(f"{words.code} needs a path element directly before it", words[address], hint)


@FUNCTIONS("M97", "Small contour steps", phase="end", modal=False, collects=True, source="Klartext, not described")
def small_step(m: Machine, words: Words) -> None:
    """At the outside corner that ends the block no arc is put in: the tool goes over the point where the offsets meet."""
    mark(m, words, Prolonged(m.step))


@FUNCTIONS("M98", "Open contour corners", phase="end", modal=False, collects=True, source="Klartext, not described")
def open_corner(m: Machine, words: Words) -> None:
    """The tool goes to the place square to the end of the block; where the contour goes on at an angle that is an alarm."""
    mark(m, words, Open(m.step))


def mark(m: Machine, words: Words, joint: Prolonged | Open) -> None:
    """What the compensation does at the end of the block."""
    word = words.words[0]
    if m.recorded_only:
        m.alarm(f"{words.code} cannot stand in a contour that a cycle reads", word)
    program = m.flow.program
    if program.keywords[program.keyword[m.flow.current]] not in ELEMENTS:
        m.alarm(f"{words.code} stands in the block of a path element", word)
    if m.pending is None:
        heading(m, words)
    if not m.mark_joint(joint):
        m.alarm(f"{words.code} needs a path element that has no joint at its end yet", word)
