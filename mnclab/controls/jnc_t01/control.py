"""The control itself: what it reads, obeys, and needs to be told."""

from __future__ import annotations

from pathlib import Path

from mnclab.controls.jnc_t01 import SIGNS, SUFFIXES, cycles, functions
from mnclab.controls.jnc_t01.functions import Memory
from mnclab.controls.jnc_t01.reader import read
from mnclab.machine.control import Control, Modal, Setting, one_of
from mnclab.machine.cycle import Cycle
from mnclab.machine.machine import Machine
from mnclab.machine.setup import LATHES
from mnclab.machine.trial import TrialWords, in_block
from mnclab.running.bulk import PlainWords
from mnclab.text.alarm import Alarm
from mnclab.text.program import Word, digits

#: Order inside a block; the manual gives none.
PHASES = ("modes", "feed", "spindle", "tool", "corrector", "auxiliary", "dwell", "motion", "end")

SETTINGS = (
    Setting("diameter", False, "X and U are diameters; I, R and D stay on the radius", "not stated, adopted: radius"),
    Setting("max_spindle_speed", 3000.0, "greatest spindle speed under G96", "8.20: a system parameter", {}, "rev/min", 1),
    one_of("stopped_spindle", "a feed move under G95 while the spindle stands", "example 2 does so",
           warn="the speed S counts, with a warning", accept="the same without a word", refuse="an alarm"),
    Setting("retract", 0.5, "G77, G78: how far a pass leaves the contour in each axis", "not stated, adopted", {}, "mm", 0),
    one_of("wall", "G77, G78: from point 4 to point 5", "8.12, 8.13",
           rapid="at rapid, as the text says", feed="at feed: the wall is cut"),
    Setting("home_x", 0.0, "M60, M61: machine position of the tool, on the radius", "9.29, 9.30", {}, "mm"),
    Setting("home_z", 0.0, "M60, M63: machine position of the tool", "9.29, 9.31", {}, "mm"),
    Setting("optional_stop", False, "M01 stops", "9.23"),
    Setting("arc_tolerance", 0.01, "difference of the radii at start and end of an arc", "", {}, "mm", 0),
    one_of("foreign", "words of other controls: N, %, M02, M30", "not in table 1 or 3", refuse="an alarm",
           accept="N and % are passed over, M02 and M30 end the program, with a warning"),
    Setting("bulk", True, "obey long runs of plain blocks at once"),
)  # fmt: skip

_NO_ADDRESS = "it is not in table 1 of the manual"
REFUSED = {letter: _NO_ADDRESS for letter in "ABCEHJOPQVY"} | {
    "G72": "the manual writes it only to show its notation; deep holes are drilled by G73",
    **{letter: "it belongs to G77 and G78" for letter in "UW"},
}

MEANINGS = {
    "I": "centre along X from the start", "K": "centre along Z from the start", "R": "radius",
    "G12 R": "fillet radius, signed", "G14 R": "chamfer size, signed", "G4 F": "seconds", "G32 F": "pitch, mm",
    "G92 X": "origin along X", "G92 Z": "origin along Z", "G96 S": "cutting speed, m/min", "G97 S": "spindle speed",
}  # fmt: skip

ONCE = {"G4", "G12", "G14", "G32", "G92", *cycles.CYCLES}


def start(m: Machine) -> None:
    """Arcs lie in the plane of Z and X, seen with Z to the right and X up."""
    m.change("plane", "ZX")


def together(control: Control, modal: Modal, keyword: str, words: list[Word]) -> None:
    """One function that acts once in a block."""
    codes = [(f"G{digits(w.value)}", w) for w in words if w.address == "G" and isinstance(w.value, float)]
    if len(once := [pair for pair in codes if pair[0] in ONCE]) > 1:
        (first, _), (second, word) = once[:2]
        message = f"{second} and {first} are of one group: only one of it may stand in a block"
        raise Alarm(message, word.span, hint="write two blocks")


#: Of `LATHES`, for a trial: drill and blades; all other cycles turn.
TRIAL_TOOLS = {"G73": 6, "G74": 7, "G75": 3}


def trial_program(cycle: type[Cycle], words: TrialWords) -> str:
    """A cycle in one block, before the face of the part, with a tool that suits it."""
    x, z = 0 if cycle.code == "G73" else 40, -5 if cycle.code == "G75" else 5  # grooves round the bar, not before it
    return f"G90 G94 F100\nT{TRIAL_TOOLS.get(cycle.code, 1)} S800 M3\nG0 X{x}\nZ{z}\n{in_block(cycle, words)}\n"


FUNCTIONS = functions.FUNCTIONS

CONTROL = Control(
    name="jnc-t01",
    title="JNC-T01 (lathe)",
    suffixes=SUFFIXES,
    terms=Path(__file__).with_name("terms.toml"),
    axes="XZ",
    read=read,
    functions=FUNCTIONS,
    cycles=cycles.CYCLES,
    phases=PHASES,
    settings=SETTINGS,
    frames=("offset", "corrector"),
    memory=Memory,
    start=start,
    signs=SIGNS,
    refused=REFUSED,
    meanings=MEANINGS,
    relative=("G92 X", "G92 Z"),
    together=together,
    lathe=True,
    magazine=LATHES,
    bulk=PlainWords(
        motions={0.0: ("G0", 0), 1.0: ("G1", 1), 2.0: ("G2", -2), 3.0: ("G3", 2)},
        ready=functions.plain,
        letters="GXZIKRF",
        whole_circles=False,
    ),
    trial=trial_program,
)
