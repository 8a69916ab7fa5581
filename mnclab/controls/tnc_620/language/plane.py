"""PLANE in all its forms: the working plane tilted about the active datum, and how the rotary axes follow.

A form says where the axes of the tilted system lie; the rest is common to all and to cycle 19. With STAY no axis moves, and the
program turns the rotary axes behind it to Q120 to Q122, "always to these" (manual, cycle 19): X Y Z of the plane count at once as
if they stood there, wherever they stand. A cut before they do is warned of, cycles and RL, RR are refused until then. Without the
kinematics of a machine TURN leaves the tip where it is on the workpiece, as rotary axes of L do.
"""

from __future__ import annotations

import math
from collections.abc import Iterable

import numpy as np

from mnclab.controls.tnc_620.cycles import chain, tilting, transformations
from mnclab.controls.tnc_620.cycles.chain import TILT
from mnclab.controls.tnc_620.cycles.tilting import Choice
from mnclab.controls.tnc_620.language.auxiliary import auto_feed
from mnclab.controls.tnc_620.language.m_functions import retract
from mnclab.controls.tnc_620.language.rotary import refuse_rotary
from mnclab.controls.tnc_620.language.tools import refuse_other
from mnclab.controls.tnc_620.language.values import above_zero, counted, not_negative, one_of
from mnclab.controls.tnc_620.state import Place, memory
from mnclab.geometry import frames
from mnclab.geometry.frames import Matrix
from mnclab.machine.axes import turning_feed
from mnclab.machine.control import FunctionTable, Words
from mnclab.machine.coordinates import AXES, STILL
from mnclab.machine.machine import INF, Machine
from mnclab.running.cycles import perform
from mnclab.text.program import Word

FUNCTIONS = FunctionTable()
MEANT = {"B": "base vector", "N": "normal"}
VECTORS = {f"{which}{axis}": f"{axis} of the {meant}" for which, meant in MEANT.items() for axis in "XYZ"}
POINTS = {f"P{n}{axis}": f"{axis} of point {n}" for n in (1, 2, 3) for axis in "XYZ"}
WORDS = {
    "STAY": "the rotary axes stay", "MOVE": "they move, and the tip stays where it is", "TURN": "they move alone",
    "ABST": "how far below the tip the point is that stands still", "DIST": "the same", "MB": "retraction",
    "SPA": "tilt about X", "SPB": "tilt about Y", "SPC": "tilt about Z", "SEQ": "which of two solutions",
    "SYM": "which side of the axis", "TABLE": "a free rotary axis turns the table",
    "COORD": "a free rotary axis turns the coordinates alone",
    "PROPR": "angle of the trace in ZX", "PROMIN": "angle of the trace in YZ", "ROT": "rotation in the plane",
    "EULPR": "precession, about Z", "EULNU": "nutation, about X turned by it", "EULROT": "rotation in the plane",
    **VECTORS, **POINTS,
}  # fmt: skip
ANGLES = ("SPA", "SPB", "SPC")
TRACES, STEEPEST = ("PROPR", "PROMIN"), 89.9999  # degrees, of a trace
HOW = "STAY MOVE TURN MB ABST DIST F FMAX FAUTO"
WHICH = f"SEQ SYM TABLE COORD {HOW}"
SOURCE = "Klartext, not described"
ORIGIN = (0.0, 0.0)  # steps count in coordinates of the program


# --- the forms: where the axes of the tilted system lie ---------------------------------------------------------------

@FUNCTIONS("PLANE SPATIAL,", "Tilted plane by spatial angles", takes=f"SPA SPB SPC {WHICH}", source=SOURCE)
def plane_spatial(m: Machine, words: Words) -> None:
    """Tilts the plane about the active datum by turns about the fixed axes X, then Y, then Z, as cycle 19 does, and writes
    where the rotary axes must stand into Q120 to Q122; three angles of 0 end the tilt, and mean the rotary axes at 0."""
    angles = numbers(m, words, ANGLES)
    if any(angles) or not tilting.level(m):
        tilt(m, words, frames.spatial(*map(math.radians, angles)), angles)
    else:
        choice(m, words)
        untilt(m, words)
        perform(m, words.code, tilting.results(m, tilting.at_zero(m)), ORIGIN)


@FUNCTIONS("PLANE PROJECTED,", "Tilted plane by its traces", takes=f"PROPR PROMIN ROT {WHICH}", source=SOURCE)
def plane_projected(m: Machine, words: Words) -> None:
    """PROPR is the angle of the trace in ZX, right-handed about Y, PROMIN that in YZ, right-handed about X; with ROT 0 X of
    the plane lies along the trace in ZX."""
    tilt(m, words, frames.projected(*map(math.radians, numbers(m, words, ("PROPR", "PROMIN", "ROT")))))


@FUNCTIONS("PLANE EULER,", "Tilted plane by Euler angles", takes=f"EULPR EULNU EULROT {WHICH}", source=SOURCE)
def plane_euler(m: Machine, words: Words) -> None:
    """Turns by EULPR about Z, by EULNU about X as it lies then, by EULROT about Z of the plane."""
    tilt(m, words, frames.euler(*map(math.radians, numbers(m, words, ("EULPR", "EULNU", "EULROT")))))


@FUNCTIONS("PLANE VECTOR,", "Tilted plane by two vectors", takes=f"{' '.join(VECTORS)} {WHICH}", source=SOURCE)
def plane_vector(m: Machine, words: Words) -> None:
    """Z lies along the normal, X along what of the base vector lies in the plane; their lengths do not matter."""
    base, normal = (needed(m, words, [f"{which}{axis}" for axis in "XYZ"]) for which in "BN")
    for vector, which in ((base, "B"), (normal, "N")):
        if not any(vector):
            m.alarm(f"PLANE VECTOR: the {MEANT[which]} has no length", words[f"{which}X"])
    if not frames.spans(base, normal):
        m.alarm("PLANE VECTOR: the base vector lies along the normal, X of the plane has no direction", words["BX"])
    tilt(m, words, frames.along_and_normal(base, normal))


@FUNCTIONS("PLANE POINTS,", "Tilted plane by three points", takes=f"{' '.join(POINTS)} {WHICH}", source=SOURCE)
def plane_points(m: Machine, words: Words) -> None:
    """X lies from point 1 to point 2, point 3 on the side of Y; the datum stays where it is."""
    one, two, three = (np.array(needed(m, words, [f"P{n}{axis}" for axis in "XYZ"])) for n in (1, 2, 3))
    if not frames.spans(two - one, three - one):
        m.alarm("PLANE POINTS: the three points lie on a line, and make no plane", words["P1X"])
    tilt(m, words, frames.along_and_normal(two - one, np.cross(two - one, three - one)))


@FUNCTIONS("PLANE RELATIV,", "Tilted plane turned further", takes=f"SPA SPB SPC {WHICH}", source=SOURCE)
def plane_relative(m: Machine, words: Words) -> None:
    """Turns the active plane about one of its own axes, and about the datum that it has: a shift defined in the plane moves the
    tilted system (11.9), so it acts in the new one as it does where SPATIAL or cycle 19 are defined anew; a warning says so."""
    word = one_of(m, words, ANGLES, "one angle")
    if word is None:
        m.alarm("PLANE RELATIV needs SPA, SPB or SPC")
    turn = frames.turn(math.radians(angle(m, words, word.address)), "xyz"[ANGLES.index(word.address)])
    tilt(m, words, m.frames[TILT] @ turn)


@FUNCTIONS("PLANE AXIAL,", "Tilted plane by positions of the rotary axes", takes=f"A B C {WHICH}", source=SOURCE)
def plane_axial(m: Machine, words: Words) -> None:
    """The plane is that of the tool where the rotary axes stand at these positions: IA counts from where A stands, an axis
    left out is where the tilt before has it, else at 0."""
    refuse_other(m, words.code)
    there, named = tilting.rotary_axes(m).names, [words[axis] for axis in AXES if axis in words]
    if not named:
        m.alarm(f"PLANE AXIAL needs a position of {' or '.join(there)}")
    for word in named:
        if word.address not in there:
            m.alarm(f"PLANE AXIAL {word.address}: the rotary axes are {' and '.join(there)}", word)
    for address in ("SEQ", "SYM", "TABLE", "COORD"):
        if address in words:
            m.alarm(f"PLANE AXIAL {address} ({WORDS[address]}) has no meaning: the positions are given", words[address])
    how = behaviour(m, words)
    before = memory(m).tilt_axes or (0.0, 0.0, 0.0)
    degrees = [math.degrees(angle) for angle in before]
    for word in named:
        k = AXES.index(word.address)
        here = chain.to_angle(m, k, math.degrees(m.rotary[k]))
        degrees[k] = chain.to_rotary(m, k, counted(m, word, here))
    a, b, c = degrees
    to = perform(m, words.code, tilting.begin_by_axes(m, tilting.with_axes(m, before, (a, b, c))), ORIGIN)
    turn(m, words, how, to)


@FUNCTIONS("PLANE RESET,", "End of a tilted plane", takes=HOW, source=SOURCE)
def plane_reset(m: Machine, words: Words) -> None:
    """Cycle 19 and PLANE are over; with MOVE and TURN the rotary axes turn to 0, with STAY they stay. Without the kinematics of
    a machine one that does not lean the tool stays."""
    untilt(m, words)


# --- what is common to all --------------------------------------------------------------------------------------------

def needed(m: Machine, words: Words, addresses: Iterable[str]) -> list[float]:
    """The numbers of words that must all be there."""
    for address in addresses:
        if address not in words:
            m.alarm(f"{words.code} needs {address} ({WORDS[address]})")
    return [m.value(words[address]) for address in addresses]


def numbers(m: Machine, words: Words, addresses: tuple[str, str, str]) -> Place:
    """Three angles that must all be there, degrees."""
    needed(m, words, addresses)
    one, other, last = (angle(m, words, address) for address in addresses)
    return one, other, last


def angle(m: Machine, words: Words, address: str) -> float:
    """An angle within its limits, degrees."""
    most, value = (STEEPEST if address in TRACES else 360), m.value(words[address])
    if abs(value) > most:
        what = f"{words.code} {address} ({WORDS[address]}) must be from {-most:.8g} to {most:.8g}, got {value:g}"
        m.alarm(what, words[address])
    return value


def tilt(m: Machine, words: Words, matrix: Matrix, angles: Place | None = None) -> None:
    """Tilt by a matrix, and turn the rotary axes as the block says; `angles` are the spatial ones, degrees, if it names them."""
    refuse_other(m, words.code)
    which, how = choice(m, words), behaviour(m, words)
    if angles is None:
        a, b, c = map(math.degrees, frames.angles_of(matrix))
        angles = a, b, c
    turn(m, words, how, perform(m, words.code, tilting.begin(m, words.code, matrix, angles, which), ORIGIN))


def untilt(m: Machine, words: Words) -> None:
    how = behaviour(m, words)
    perform(m, words.code, tilting.over(m), ORIGIN)
    to = tilting.axis_positions(m, words.code) if m.tables.kinematics is None else tilting.at_zero(m)
    turn(m, words, how, to)


def choice(m: Machine, words: Words) -> Choice:
    """SEQ or SYM, TABLE ROT or COORD ROT."""
    free = one_of(m, words, ("TABLE", "COORD"), "one of TABLE ROT, COORD ROT")
    return Choice(one_of(m, words, ("SEQ", "SYM"), "one of SEQ, SYM"), "" if free is None else free.address)


def behaviour(m: Machine, words: Words) -> Word:
    """STAY, MOVE or TURN; with MB the tool retracts, before anything turns."""
    how = one_of(m, words, ("STAY", "MOVE", "TURN"), "one of STAY, MOVE, TURN")
    if how is None:
        m.alarm(f"{words.code} needs STAY, MOVE or TURN", hint="with STAY no axis moves")
    if how.value is not None:
        m.alarm(f"{words.code} {how.address} takes no number", how)
    if m.side:
        m.alarm(f"{words.code} cannot change the plane under radius compensation", how, "write R0 before")
    if (far := words.get("MB")) is not None:
        if how.address == "STAY":
            m.alarm(f"{words.code} MB (retraction before the axes turn) needs MOVE or TURN: with STAY no axis moves", far)
        if TILT not in m.frames or m.tables.kinematics is not None:
            retract(m, words.code, far, INF)
        elif far.value is None:
            m.alarm(f"{words.code} MB MAX in a tilted plane is not built yet", far, "with a distance, MB50, it is")
        else:
            m.line(z=m.programmed[2] + not_negative(m, far, f"{words.code} MB (distance of the retraction)"), f=INF)
    return how


def turn(m: Machine, words: Words, how: Word, to: Place) -> None:
    """With TURN the rotary axes move alone to A, B, C, rad; with MOVE the point ABST below the tip stands still, without ABST
    the tip."""
    if how.address == "STAY":
        return
    below = one_of(m, words, ("ABST", "DIST"), "one distance")
    distance = not_negative(m, below, f"{words.code} {below.address} ({WORDS['ABST']})") if below is not None else 0.0
    if below is not None and how.address == "TURN" and distance:
        m.alarm(f"{words.code} {below.address} ({WORDS['ABST']}) is for MOVE: with TURN the axes move alone", below)
    if all(abs(angle - m.rotary[k]) < STILL for k, angle in enumerate(to)):
        return
    refuse_rotary(m, how)
    word = one_of(m, words, ("F", "FMAX", "FAUTO"), "one feed")
    if word is None:
        rate = turning_feed(m)
    elif word.address == "FMAX":
        rate = INF
    else:
        rate = auto_feed(m, word) / m.feed_unit if word.address == "FAUTO" else above_zero(m, word, f"{words.code} F (feed rate)")
    perform(m, words.code, tilting.position(m, to, rate, distance if how.address == "MOVE" else None), ORIGIN)


# TRANS DATUM: the datum shift of cycle 7 as one statement.

@FUNCTIONS("TRANS DATUM AXIS,", "Datum shift", takes="X Y Z A B C", source=SOURCE)
def shift(m: Machine, words: Words) -> None:
    """Moves the datum as cycle 7 does: IX counts from the shift before, an axis that is not named keeps its own."""
    before = dict(zip(transformations.AXES, (*chain.shift_of(m), *chain.rotary(m)[0]), strict=True))
    given = {axis: counted(m, words[axis.upper()], before[axis]) for axis in transformations.AXES if axis.upper() in words}
    if not given:
        m.alarm("TRANS DATUM AXIS needs an axis", hint="for example TRANS DATUM AXIS X+60")
    perform(m, words.code, transformations.DatumShift(**given).moves(m))


@FUNCTIONS("TRANS DATUM RESET,", "End of a datum shift", source=SOURCE)
def reset(m: Machine, words: Words) -> None:
    """The shift is over, whoever defined it."""
    perform(m, words.code, transformations.DatumShift(**dict.fromkeys(transformations.AXES, 0.0)).moves(m))
