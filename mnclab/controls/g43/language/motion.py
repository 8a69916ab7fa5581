"""Motion, dwell, feed and spindle, polar coordinates, rotary axes, and the reference points of the machine."""

from __future__ import annotations

import math

import numpy as np

from mnclab.controls.g43.language import beside
from mnclab.controls.g43.language.offsets import settle_doubt, transformed
from mnclab.controls.g43.language.tools import activate, pending
from mnclab.controls.g43.settings import REFERENCES
from mnclab.controls.g43.state import ISO, Offsets, Polar, memory, seconds_of_p, silent, undescribed, whole
from mnclab.controls.word_address import motion
from mnclab.controls.word_address.motion import ARCS, AXES, CENTRE, SPINDLE, first_word
from mnclab.machine.axes import check_angles, in_machine, reckon, tip_below, travel, turn_axes
from mnclab.machine.axes import reference as spindle_reference
from mnclab.machine.control import Control, FunctionTable, Modal, Words
from mnclab.machine.coordinates import AXES as ROTARY
from mnclab.machine.coordinates import PLANES, Angles, angles, set_angles
from mnclab.machine.cycle import Given, Values
from mnclab.machine.machine import Machine
from mnclab.text.alarm import Alarm
from mnclab.text.program import Word, digits

# Rotary axes A, B and C: positions of their own beside X Y Z, for the kinematics of the machine are not known.

def angles_of(m: Machine, words: Words) -> Angles | None:
    """Where the rotary axes go that are written, degrees; None where none is. Under G91 from where they stand."""
    if words.keys().isdisjoint(ROTARY):
        return None
    found = list(angles(m))
    for k, axis in enumerate(ROTARY):
        if axis in words:
            found[k] = m.value(words[axis]) + (found[k] if m.modal["dimension"] == "G91" else 0.0)
    a, b, c = found
    if m.tables.kinematics is not None and (a, b, c) != angles(m):
        check_angles(m, (a, b, c), words)
    return a, b, c


def go(m: Machine, to: dict[str, float], turned: Angles | None, rapid: bool, word: Word | None = None) -> None:
    """A straight move, at rapid or at the modal feed, with which the rotary axes arrive; they may also turn alone."""
    f = math.inf if rapid else None
    if turned is not None and turned != angles(m):
        if m.tables.kinematics is not None:
            travel(m, turned, m.target(to.get("x"), to.get("y"), to.get("z")) if to else None, f, word)
            if m.reckoned is not None and "tilt" in m.frames:  # the plane stays on the part
                reckon(m, m.rotary)
            return
        if math.dist(m.to_machine(m.target(to.get("x"), to.get("y"), to.get("z"))), m.tip) <= 1e-9:  # a frame rounds
            turn_axes(m, turned, f)
            return
        set_angles(m, turned)
    if to:
        m.line(**to, f=f, word=word)


# Polar coordinates: G15, G16.
# The first axis of the plane is the radius, the second the angle in degrees. Under G90 the radius counts from the origin and
# the angle from the first axis; under G91 the radius counts from where the tool stands, and the angle from the last one.

FUNCTIONS = FunctionTable()
POLAR = {"G16": "Polar coordinates on", "G15": "Polar coordinates off"}


@FUNCTIONS("G15 G16", POLAR, group="polar", phase="transformation", power_on="G15", source=ISO)
def polar(m: Machine, words: Words) -> None:
    """No motion; the pole is the origin, under G91 the present point."""
    motion.uncompensated(m, words)
    if words.code == "G15":
        memory(m).polar = None
        return
    first, second, _ = PLANES[m.plane]
    u, v = m.programmed[first], m.programmed[second]
    pole = (0.0, 0.0) if m.modal["dimension"] == "G90" else (u, v)
    du, dv = u - pole[0], v - pole[1]
    memory(m).polar = Polar(pole, math.hypot(du, dv), math.degrees(math.atan2(dv, du)))


def point(m: Machine, radius: float | None, angle: float | None) -> dict[str, float]:
    """Where a radius (mm) and an angle (degrees) lead; what is not written stays. Coordinates by axis."""
    kept, (first, second, _) = memory(m).polar, PLANES[m.plane]
    assert kept is not None
    pole, r, a = kept
    absolute = m.modal["dimension"] == "G90"
    if radius is not None:
        r, pole = radius, (0.0, 0.0) if absolute else (m.programmed[first], m.programmed[second])
    if angle is not None:
        a = angle if absolute else a + angle
    memory(m).polar = Polar(pole, r, a)
    turned = math.radians(a)
    place = pole[0] + r * math.cos(turned), pole[1] + r * math.sin(turned)
    return {AXES[k].lower(): value for k, value in zip((first, second), place, strict=True)}


def polar_targets(m: Machine, words: Words) -> dict[str, float]:
    """Where the axes that are written go."""
    first, second, normal = (AXES[k] for k in PLANES[m.plane])
    to = point(
        m, m.length(words[first]) if first in words else None, m.value(words[second]) if second in words else None
    ) if first in words or second in words else {}  # fmt: skip
    if normal in words:
        value, axis = m.length(words[normal]), AXES.index(normal)
        to[normal.lower()] = value if m.modal["dimension"] == "G90" else m.programmed[axis] + value
    return to


def holes(m: Machine, values: Values, given: Given, kept: Values) -> None:
    """The places of a cycle and of its repeats: X and Y of its values, and more of them in `kept`, if there are."""
    if m.plane != "XY":
        m.alarm(f"a cycle under polar coordinates needs the plane XY, got {m.plane}", hint="write G17 before G16")
    if given.keys().isdisjoint(("x", "y")):
        return
    radius = values["x"] if "x" in given else None
    angle = values["y"] / m.variable_unit if "y" in given else None  # which is no length
    count = int(values.get("repeats", 1))
    places = [tuple(point(m, radius, angle).values()) for _ in range(min(max(count, 1), 9999))]
    values["x"], values["y"] = places[0]
    kept["points"] = np.array(places) if count > 1 else None


# Motion, dwell, feed and spindle; planes, dimensions and the like are those of all controls of G words.

LENGTHS = ("G43", "G44", "G49")
AXIS_WORDS = "X Y Z A B C"
MOST_TURNS = 10_000


def together(control: Control, modal: Modal, keyword: str, words: list[Word]) -> None:
    """The length compensation needs a straight motion; R beside a line is no corner; a unit has no contour."""
    if modal.dialect == "linuxcnc" and not keyword:
        beside.check(modal, words)
    codes = {f"G{digits(word.value)}": word for word in words if word.address == "G" and type(word.value) is float}
    axes = [word for word in words if word.address in AXES]
    if axes and (spline := {"G5", "G5.1"} & codes.keys()):
        sentence = f"{min(spline)} stands in a block without motion, {axes[0].rounded} does not belong to it"
        hint = "write two blocks; the splines of LinuxCNC are not built: write lines or arcs"
        raise Alarm(sentence, axes[0].span, hint=hint)
    contour = next((word for word in words if word.address in ("P", "Q")), None)
    if contour and len(codes) == 1 and (lathe := {"G70", "G71"} & codes.keys()):
        hint = "a program of a lathe; write G20 or G21 for the unit, and the motion itself"
        raise Alarm(f"{min(lathe)} {contour.rounded} is a contour cycle of a lathe", codes[min(lathe)].span, hint=hint)
    circle = next((word for word in words if word.address in ("I", "J", "L")), None)
    if circle and len(codes) == 1 and (holes := {"G70", "G71"} & codes.keys()):
        hint = "not built; write a cycle and the places of its holes"
        raise Alarm(f"{min(holes)} {circle.rounded} drills holes on a circle (Haas)", codes[min(holes)].span, hint=hint)
    if (skip := codes.get("G31")) and modal.dialect == "haas" and not any(word.address == "F" for word in words):
        raise Alarm("G31 F (feed rate) is missing", skip.span, hint="on a Haas it stands in the block of G31")
    if skip and modal.active:
        raise Alarm(f"G31 cannot stand while {modal.active.code} is active", skip.span, hint="write G80 first")
    arcs = [code for code in ARCS if code in codes] or [code for code in ARCS if modal.motion == code and axes]
    for code in LENGTHS:
        if code in codes and arcs and not {"G0", "G1"} & codes.keys():
            message = f"{code} needs a straight motion, got {arcs[0]} in its block"
            raise Alarm(message, codes[code].span, hint="write two blocks")
    radius, straight = next((word for word in words if word.address == "R"), None), {"G0", "G1"} & codes.keys()
    if radius and axes and not keyword and (straight or not codes and modal.motion in ("G0", "G1") and not modal.active):
        hint = f"a rounding of the corner is ,{radius}, a chamfer ,C"
        raise Alarm(f"{radius} has no meaning in a straight line", radius.span, hint=hint)


def targets(m: Machine, words: Words) -> dict[str, float]:
    """Where the axes that are written go; their offsets count from now on."""
    kept = memory(m)
    if kept.plane_points is not None:
        way, points = kept.plane_points
        said = ", ".join(f"Q{k}" for k in sorted(points) if k >= 0)
        m.alarm(f"G68.2 P{way} describes no plane yet: only {said} came before this motion", first_word(words))
    if kept.polar is not None and not kept.machine_coordinates:
        to = polar_targets(m, words)
    else:
        to = motion.coordinates(m, words, m.modal["dimension"] == "G90" or kept.machine_coordinates)
    if to and not kept.machine_coordinates:
        activate(m, to)
        if kept.doubt is not None:
            settle_doubt(m, words, to)
    return to


def is_plain(m: Machine) -> bool:
    """Whether plain words mean plain motion."""
    kept = memory(m)
    special = kept.polar is not None or kept.doubt is not None or kept.absolute_centres or kept.outlived or m.per_time
    return not (special or pending(m)) and silent(m, "G2", "G3")


@FUNCTIONS("G0", "Rapid positioning", group="motion", takes=AXIS_WORDS, power_on="G0", moves=True, source="7.1, example")
def rapid(m: Machine, words: Words) -> None:
    """All axes at their greatest speed."""
    go(m, targets(m, words), angles_of(m, words), rapid=True)


@FUNCTIONS("G1", "Linear interpolation", group="motion", takes=AXIS_WORDS, moves=True, source="7.1, example")
def line(m: Machine, words: Words) -> None:
    """A straight line at feed F; in machine coordinates (G53) at rapid, unless the setting g53_motion says otherwise."""
    at_rapid = memory(m).machine_coordinates and m.settings["g53_motion"] == "rapid"
    go(m, targets(m, words), angles_of(m, words), at_rapid, first_word(words))


@FUNCTIONS("G2 G3", ARCS, group="motion", takes="X Y Z I J K R P", moves=True, source=ISO)
def arc(m: Machine, words: Words) -> None:
    """An arc by R (negative: above 180 degrees) or by I J K from the start (after G90.1 from the origin); P counts turns.

    A 0 along the axis of the arc, which some post-processors write, changes nothing.
    """
    undescribed(m, words)
    along = CENTRE[PLANES[m.plane][2]]
    if along in words and m.value(words[along]) == 0:
        words = Words(tuple(word for word in words.words if word.address != along), words.code)
    kept = memory(m)
    if kept.machine_coordinates:
        m.alarm(f"{words.code} and G53 stand in one block: an arc counts from the workpiece", first_word(words))
    to = targets(m, words)
    centre = next((words[c] for c in CENTRE if c in words), None)
    if kept.polar is not None and centre is not None:
        m.alarm(f"{centre} stands under polar coordinates: an arc needs R there", centre)
    turns = whole(m, words, "P", 1, MOST_TURNS) if "P" in words else 1
    sense = -1 if words.code == "G2" else 1
    motion.arc_to(m, words, to, sense, absolute_centre=kept.absolute_centres, turns=turns)


@FUNCTIONS("G4", "Dwell", phase="dwell", takes="P X", still=True, modal=False, source=ISO)
def dwell(m: Machine, words: Words) -> None:
    """A pause of X seconds, or of P as the setting dwell_p has it."""
    undescribed(m, words)
    if len(words.words) != 2:
        m.alarm("G4 needs P or X, the time", first_word(words))
    word = words.words[1]
    value = m.value(word)
    if not 0 <= value <= 1e6:
        m.alarm(f"G4 {word.address} (dwell) must be at least 0 and at most 1e+06, got {value:g}", word)
    m.dwell(value if word.address == "X" else value * seconds_of_p(m, word))


@FUNCTIONS("F", "Feed", phase="feed", source="7.1, example")
def feed(m: Machine, words: Words) -> None:
    """F: the feed along the path; under G93 how many times a minute the move of this block could be made."""
    if not m.per_time:
        motion.feed(m, words)
        return
    value = m.value(words["F"])
    if value <= 0:
        m.alarm(f"F (moves a minute) must be greater than 0, got {value:g}", words["F"])
    memory(m).moves_a_minute = value
    m.change("feed", 60 / value)
    m.at_block_end(lambda: m.change("feed", None))


FUNCTIONS("S", "Spindle speed", phase="spindle", source=ISO)(motion.spindle_speed)
FUNCTIONS("M3 M4 M5", SPINDLE, group="spindle", phase="auxiliary", power_on="M5", source=ISO)(motion.spindle)


# Reference points of the machine: G27 to G30, and G28.1 and G30.1, which set them.
# The first is machine zero, the others are settings; all are places of the spindle. Rotary axes have theirs at 0 degrees, or
# where they stood at G28.1, G30.1. The manual describes none of them: as at the controls that do, G28 alone moves all axes, the
# rotary ones too, and with axes those that are written.

TITLES = {"G28": "Return to the reference point", "G30": "Return to the second, third or fourth reference point"}
SETTING = {"G28.1": "Set the first reference point", "G30.1": "Set the second reference point"}
NEAR = 1e-3  # mm from a reference point


def tip_at(m: Machine, number: int) -> Offsets:
    """Where the tip is while the spindle stands at a reference point, machine coordinates."""
    x, y, z = memory(m).references.get(number, (0.0, 0.0, 0.0))
    if number > 1 and number not in memory(m).references:
        x, y, z = (float(m.settings[f"{REFERENCES[number]}_reference_{axis}"]) for axis in "xyz")
    return tip_below(m, (x, y, z))


@FUNCTIONS("G28", TITLES, takes="X Y Z A B C", still=True, owns=True, modal=False, source=ISO)
@FUNCTIONS("G30", TITLES, takes="X Y Z A B C P", still=True, owns=True, modal=False, source=ISO)
def reference(m: Machine, words: Words) -> None:
    """The axes written go to their points at rapid, then to the reference point (G30: of number P); without axes all go."""
    undescribed(m, words)
    motion.uncompensated(m, words)
    if m.reckoned is None:
        m.alarm(f"{words.code} cannot stand while the tip is led (G43.4)", first_word(words), hint="write G49 first")
    number = 1 if words.code == "G28" else whole(m, words, "P", 2, 4) if "P" in words else 2
    to, turned = targets(m, words), angles_of(m, words)
    refuse_crooked(m, words, to)
    if to or turned is not None:
        go(m, to, turned, rapid=True)
    memory(m).intermediate = dict(to)
    home = m.to_program(tip_at(m, number))
    every, stand = not to and turned is None, memory(m).angles.get(number, (0.0, 0.0, 0.0))
    a, b, c = (there if every or axis in words else here for axis, there, here in zip(ROTARY, stand, angles(m), strict=True))
    go(m, {axis: home[k] for k, axis in enumerate(AXES.lower()) if axis in to or every}, (a, b, c), rapid=True)


def refuse_crooked(m: Machine, words: Words, to: dict[str, float]) -> None:
    """An Alarm where an axis of the program is none of the machine's: it could not go to its reference point alone."""
    if m.shift is not None or not to or len(to) == 3:
        return
    matrix = in_machine(m)
    for axis in to:
        k = "xyz".index(axis)
        row, column = matrix[k, :3].tolist(), matrix[:3, k].tolist()
        if any(max(abs(row[j]), abs(column[j])) > 1e-12 for j in range(3) if j != k):
            by = transformed(m) or "a turned work offset"
            m.alarm(f"{words.code} {axis.upper()} cannot stand while {by} is active: the axis is turned", words[axis.upper()])


@FUNCTIONS("G29", "Return from the reference point", takes="X Y Z", still=True, modal=False, source=ISO)
def back(m: Machine, words: Words) -> None:
    """The axes written go at rapid to the point that the last G28 or G30 went over, then to their own."""
    motion.uncompensated(m, words)
    over = memory(m).intermediate
    written = [axis for axis in AXES.lower() if axis.upper() in words]
    for axis in written:
        if axis not in over:
            m.alarm(f"G29 {axis.upper()}: no G28 or G30 has moved this axis before", words[axis.upper()])
    if not written:
        m.alarm("G29 needs X, Y or Z", first_word(words))
    m.rapid(**{axis: over[axis] for axis in written})
    m.rapid(**targets(m, words))


@FUNCTIONS("G27", "Reference point check", takes="X Y Z", still=True, modal=False, source=ISO)
def check(m: Machine, words: Words) -> None:
    """The axes written go to their points at rapid; an alarm if that is not the reference point."""
    motion.uncompensated(m, words)
    to = targets(m, words)
    if not to:
        m.alarm("G27 needs X, Y or Z", first_word(words))
    m.rapid(**to)
    home = tip_at(m, 1)
    for axis in to:
        k = "xyz".index(axis)
        if abs(off := m.tip[k] - home[k]) > NEAR:
            m.alarm(f"G27: {axis.upper()} is not at its reference point, but {off:.4g} mm away", words[axis.upper()])


@FUNCTIONS("G28.1 G30.1", SETTING, phase="local", still=True, modal=False, source="LinuxCNC")
def set_reference(m: Machine, words: Words) -> None:
    """The present place of the spindle and of the rotary axes becomes the reference point. No motion."""
    number = 1 if words.code == "G28.1" else 2
    memory(m).references[number], memory(m).angles[number] = spindle_reference(m), angles(m)
