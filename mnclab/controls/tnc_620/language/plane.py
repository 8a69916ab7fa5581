"""PLANE RESET, and PLANE SPATIAL as far as it tilts nothing: the plane is that of X and Y again."""

from __future__ import annotations

from collections.abc import Iterator

from mnclab.controls.tnc_620.cycles.tilting import RESULTS, WorkingPlane
from mnclab.controls.tnc_620.language.checks import one_of
from mnclab.machine.control import FunctionTable, Words
from mnclab.machine.machine import Machine
from mnclab.machining.steps import Step, Write
from mnclab.running.performing import perform

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


@FUNCTIONS("PLANE RESET,", "End of a tilted plane", takes=HOW, source=SOURCE)
def plane_reset(m: Machine, words: Words) -> None:
    """Cycle 19 is over; with STAY the rotary axes stay, MOVE and TURN have nothing to do where they stand at 0."""
    untilt(m, words)


@FUNCTIONS("PLANE SPATIAL,", "Tilted plane by spatial angles", takes=f"SPA SPB SPC SEQ TABLE COORD {HOW}", source=SOURCE)
def plane_spatial(m: Machine, words: Words) -> None:
    """With three angles of 0 it tilts nothing, and Q120 to Q122 say so; the others are not built."""
    for address in ANGLES:
        if address not in words:
            m.alarm(f"PLANE SPATIAL needs {address} ({WORDS[address]})")
        if angle := m.value(words[address]):
            what = f"PLANE SPATIAL {address}{angle:+g} tilts the plane, which is not built yet"
            m.alarm(what, words[address], "CYCL DEF 19 tilts it")
    untilt(m, words)
    perform(m, words.code, at_zero())


def at_zero() -> Iterator[Step]:
    for name in RESULTS.values():
        yield Write("variable", 0.0, name)


def untilt(m: Machine, words: Words) -> None:
    how = one_of(m, words, ("STAY", "MOVE", "TURN"), "one of STAY, MOVE, TURN")
    if how is None:
        m.alarm(f"{words.code} needs STAY, MOVE or TURN", hint="with STAY no axis moves")
    if how.value is not None:
        m.alarm(f"{words.code} {how.address} takes no number", how)
    if "MB" in words:
        m.alarm(f"{words.code} MB (retraction before the axes turn) is not built yet", words["MB"])
    if how.address != "STAY" and any(m.rotary):
        m.alarm(f"{words.code} {how.address} is not built yet where rotary axes have turned", how, f"{words.code} STAY is")
    if m.side:
        m.alarm(f"{words.code} cannot change the plane under radius compensation", how, "write R0 before")
    perform(m, words.code, WorkingPlane().moves(m))
