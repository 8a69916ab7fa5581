"""The control itself: what it reads, obeys, and needs to be told."""

from __future__ import annotations

from pathlib import Path

from mnclab.controls.mnc import SIGNS, SUFFIXES, language, transforms
from mnclab.controls.mnc.cycles import drilling, fixed, milling, prepared
from mnclab.controls.mnc.language import Memory
from mnclab.controls.mnc.probing import calibration, datums, measuring, single, tool_setting
from mnclab.controls.mnc.settings import SETTINGS
from mnclab.controls.word_address.motion import more_helices
from mnclab.controls.word_address.reader import numbers, reader
from mnclab.machine.control import Control, FunctionTable
from mnclab.machine.cycle import Cycle, CycleTable
from mnclab.machine.probe import Setter
from mnclab.machine.tool_setting import SETS
from mnclab.machine.touching import FEELS, PROBES
from mnclab.machine.trial import TrialWords, at_setter, in_block
from mnclab.path.compensation import Compensation
from mnclab.running.bulk import PlainWords

#: Order inside a block (adopted reading MNC-BLOCK-ORDER).
PHASES = (
    *("plane", "feed", "spindle", "tool", "change", "corrector", "auxiliary", "frames", "local", "compensation"),
    *("dwell", "motion", "call", "end"),
)

REFUSED = {f"G{n}": "this control has no such cycle, G83 does its work" for n in (81, 82)}

#: What the words of functions are, where their letters do not say it.
MEANINGS = {
    **{f"G{n} {letter}": f"centre along {axis} from the start" for n in (2, 3) for letter, axis in zip("IJK", "XYZ")},
    **{f"G92 {axis}": f"new value of {axis} where the tool stands" for axis in "XYZ"},
    "R": "radius", "A": "angle in degrees", "Q": "number of a datum", "G4 P": "seconds",
    **{f"{code} {axis}": f"{what} {axis}" for axis in "XYZ" for code, what in (
        ("G37", "scaling factor along"), ("G51", "mirror plane across"), ("G39", "rotation centre's"),
        ("G16", "pole's"),
    )},
    **{f"G{n} K": "radius of the arc" for n in (12, 13)},
    **{f"G{n} R": "polar radius" for n in range(10, 14)}, **{f"G{n} A": "polar angle in degrees" for n in range(10, 14)},
    **{letter: f"increment along {axis}" for letter, axis in zip("UVW", "XYZ")},
}  # fmt: skip


def trial_program(cycle: type[Cycle], words: TrialWords) -> str:
    """A milling or measuring cycle runs where it stands, a prepared one by M99, a fixed one at a position."""
    if cycle.does in (PROBES, FEELS):
        return f"G17 G90 G54\nT6\nG0 X20 Y10 Z20\n{in_block(cycle, words)}\n"
    if cycle.does == SETS:
        return f"G17 G90 G54\nT7\nG0 X20 Y10 Z20\n{in_block(cycle, words)}\n"
    if cycle.runs == "definition":  # milling
        return f"G17 G90 G54\nT1 S1000 M3\nG0 X20 Y10 Z20 F100\n{in_block(cycle, words)}\n"
    call, tool = "G80" if cycle.runs == "position" else "G0 X20 Y10 M99", 1 if cycle.code == "G306" else 2  # which mills
    return f"G17 G90 G54\nT{tool} S1000 M3\nG0 X0 Y0 Z20 F100\n{in_block(cycle, words)}\n{call}\n"


#: What help lists, and hints name, before the others.
FIRST = (
    "G0 G1 G2 G3 G17 G18 G19 G90 G91 G53 G92 F G4 G9 G61 G64 G94 G95 T D M6 S M3 M4 M5 G25 G26 M0 M1 M2 M30 M7 M8 M9"
)
_ALL = transforms.FUNCTIONS | language.AUXILIARY | language.FUNCTIONS | prepared.FUNCTIONS
FUNCTIONS = FunctionTable({code: _ALL[code] for code in (*FIRST.split(), *_ALL)})

CHAPTERS = (fixed, drilling, prepared, milling, datums, measuring, single, calibration, tool_setting)
CYCLES = CycleTable({code: cycle for chapter in CHAPTERS for code, cycle in chapter.CYCLES.items()})

CONTROL = Control(
    name="mnc",
    title="Mechatronics MNC (2015)",
    suffixes=SUFFIXES,
    terms=Path(__file__).with_name("terms.toml"),
    read=reader("mnc"),
    functions=FUNCTIONS,
    cycles=CYCLES,
    phases=PHASES,
    settings=SETTINGS,
    frames=("datum", "base rotation", "local", "rotation", "mirror", "scaling"),
    memory=Memory,
    compensation=Compensation(approach="corner", change=True, look_ahead=True),
    start=language.power_on,
    signs=SIGNS,
    numbers=numbers,
    refused=REFUSED,
    meanings=MEANINGS,
    relative=tuple(f"G{n} {letter}" for n in range(10, 14) for letter in "RA"),
    absolute_with=("G53",),
    together=language.together,
    bulk=PlainWords(
        motions={0.0: ("G0", 0), 1.0: ("G1", 1), 2.0: ("G2", -2), 3.0: ("G3", 2)},
        ready=lambda m: m.modal.get("motion") in ("G0", "G1", "G2", "G3"),
        absolute=language.absolute,
        helices=more_helices,
        straight_arcs=lambda m: m.settings["lint"] == "off",  # else each has a remark
    ),
    trial=trial_program,
    trial_setup=at_setter(Setter(x=20, y=10, z=-40, axis="X"), laser_x=20, laser_y=10, laser_z=-40, laser_axis=1),
)
