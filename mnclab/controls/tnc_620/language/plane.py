"""PLANE SPATIAL, the working plane tilted by spatial angles, and PLANE RESET: what cycle 19 does, and how the rotary axes follow.

Without the kinematics of a machine TURN leaves the tip where it is on the workpiece, as rotary axes of L do.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping

from mnclab.controls.tnc_620.cycles import chain, transformations
from mnclab.controls.tnc_620.cycles.chain import TILT
from mnclab.controls.tnc_620.language.auxiliary import auto_feed
from mnclab.controls.tnc_620.language.m_functions import refuse_rotary, retract
from mnclab.controls.tnc_620.language.tools import refuse_other
from mnclab.controls.tnc_620.language.values import above_zero, counted, not_negative, one_of
from mnclab.geometry import frames
from mnclab.machine.axes import turning_feed
from mnclab.machine.control import FunctionTable, Words
from mnclab.machine.coordinates import STILL
from mnclab.machine.machine import INF, Machine
from mnclab.machining.steps import Step, Write
from mnclab.running.cycles import perform
from mnclab.text.program import Word

FUNCTIONS = FunctionTable()
WORDS = {
    "STAY": "the rotary axes stay", "MOVE": "they move, and the tip stays where it is", "TURN": "they move alone",
    "ABST": "how far below the tip the point is that stands still", "DIST": "the same", "MB": "retraction",
    "SPA": "tilt about X", "SPB": "tilt about Y", "SPC": "tilt about Z", "SEQ": "which of two solutions",
    "TABLE": "a free rotary axis turns the table", "COORD": "a free rotary axis turns the coordinates alone",
}  # fmt: skip
ANGLES = ("SPA", "SPB", "SPC")
HOW = "STAY MOVE TURN MB ABST DIST F FMAX FAUTO"
SOURCE = "Klartext, not described"
ORIGIN = (0.0, 0.0)  # steps count in coordinates of the program


@FUNCTIONS("PLANE RESET,", "End of a tilted plane", takes=HOW, source=SOURCE)
def plane_reset(m: Machine, words: Words) -> None:
    """Cycle 19 and PLANE SPATIAL are over; with MOVE and TURN the tool turns to Z, with STAY the rotary axes stay."""
    how = behaviour(m, words)
    perform(m, words.code, transformations.WorkingPlane().moves(m), ORIGIN)
    turn(m, words, how)


@FUNCTIONS("PLANE SPATIAL,", "Tilted plane by spatial angles", takes=f"SPA SPB SPC SEQ TABLE COORD {HOW}", source=SOURCE)
def plane_spatial(m: Machine, words: Words) -> None:
    """Tilts the plane about the active datum by turns about the fixed axes X, then Y, then Z, as cycle 19 does, and writes
    where the rotary axes must stand into Q120 to Q122; three angles of 0 end the tilt."""
    for address in ANGLES:
        if address not in words:
            m.alarm(f"PLANE SPATIAL needs {address} ({WORDS[address]})")
    degrees = {axis: m.value(words[address]) for axis, address in zip("abc", ANGLES, strict=True)}
    for address in ANGLES:
        if abs(angle := m.value(words[address])) > 360:
            m.alarm(f"PLANE SPATIAL {address} ({WORDS[address]}) must be from -360 to 360, got {angle:g}", words[address])
    tilts = any(degrees.values())
    if tilts:
        refuse_other(m, words.code)
        for address in ("SEQ", "TABLE", "COORD"):
            if address in words:
                m.alarm(f"PLANE SPATIAL {address} ({WORDS[address]}) is not built yet where it tilts", words[address])
    how = behaviour(m, words)
    perform(m, words.code, tilt(m, degrees) if tilts else untilt(m), ORIGIN)
    turn(m, words, how)


def tilt(m: Machine, degrees: Mapping[str, float]) -> Iterator[Step]:
    """The tilted system, and where the rotary axes must stand for it."""
    yield Write("memory", degrees, "tilt_angles")
    yield Write("frame", frames.spatial(*map(math.radians, degrees.values())), TILT)
    yield from transformations.results(transformations.axis_positions(m))


def untilt(m: Machine) -> Iterator[Step]:
    yield from transformations.WorkingPlane().moves(m)
    yield from transformations.results(dict.fromkeys("ABC", 0.0))


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
        if TILT in m.frames and far.value is None:
            m.alarm(f"{words.code} MB MAX in a tilted plane is not built yet", far, "with a distance, MB50, it is")
        if TILT in m.frames:
            m.line(z=m.programmed[2] + not_negative(m, far, f"{words.code} MB (distance of the retraction)"), f=INF)
        else:
            retract(m, words.code, far, INF)
    return how


def turn(m: Machine, words: Words, how: Word) -> None:
    """With TURN the rotary axes move alone; with MOVE the point ABST below the tip stands still, without ABST the tip."""
    if how.address == "STAY":
        return
    below = next((words[address] for address in ("ABST", "DIST") if address in words), None)
    distance = not_negative(m, below, f"{words.code} {below.address} ({WORDS['ABST']})") if below is not None else 0.0
    if below is not None and how.address == "TURN" and distance:
        m.alarm(f"{words.code} {below.address} ({WORDS['ABST']}) is for MOVE: with TURN the axes move alone", below)
    to = transformations.axis_positions(m)
    if all(abs(angle - m.rotary[k]) < STILL for k, angle in enumerate(to.values())):
        return
    refuse_rotary(m, how)
    word = one_of(m, words, ("F", "FMAX", "FAUTO"), "one feed")
    if word is None:
        rate = turning_feed(m)
    elif word.address == "FMAX":
        rate = INF
    else:
        rate = auto_feed(m, word) / m.feed_unit if word.address == "FAUTO" else above_zero(m, word, f"{words.code} F (feed rate)")
    perform(m, words.code, transformations.position(m, to, rate, distance), ORIGIN)


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
