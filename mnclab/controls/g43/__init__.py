"""A milling control of ISO words with G43, G44 and G49; of its manual there is one chapter.

So it is the ISO mill that its users take it for: `language.tools` holds what that chapter says, the other files of
`language` the functions of its example and what ISO controls mean by the others, `cycles` their drilling cycles.
"""

from __future__ import annotations

from mnclab.controls.g43 import cycles
from mnclab.controls.g43.language import corners, modes, motion, o_words, offsets, programs, tools, variables
from mnclab.controls.g43.reading.reader import numbers, read
from mnclab.controls.g43.settings import MEANINGS, REFUSED, SETTINGS, SIGNS
from mnclab.controls.g43.state import Memory
from mnclab.controls.word_address.motion import more_helices
from mnclab.machine.control import Control, FunctionTable
from mnclab.machine.cycle import Cycle
from mnclab.machine.machine import Machine
from mnclab.machine.trial import TrialWords, in_block
from mnclab.path.compensation import Compensation
from mnclab.running.bulk import PlainWords

#: Order inside a block.
PHASES = (
    *("plane", "feed", "spindle", "tool", "change", "data", "corrector", "length", "auxiliary", "frames", "local"),
    *("transformation", "compensation", "dwell", "motion", "call", "end"),
)


def start(m: Machine) -> None:
    """G54 and a unit are active at the start; the tip hangs below the spindle by the length of the tool."""
    offsets.start(m)
    tools.place(m, "tip")
    modes.start_units(m)
    modes.start(m)
    variables.start(m)


def trial_program(cycle: type[Cycle], words: TrialWords) -> str:
    """A cycle in one block, and its end."""
    return f"T2 M6\nG43 G0 X0 Y0 Z20 S1000 M3\n{in_block(cycle, words)}\nG80\n"


#: What help lists, and hints name, before the others.
FIRST = (
    "G0 G1 G2 G3 G17 G18 G19 G90 G91 G54 G55 G56 G57 G58 G59 G53 G52 G92 G28 G68 G51 G10 F S G94 G95 G61 G64 G40 G41 "
    "G42 G80 G98 G99 M0 M1 M2 M30 M7 M8 M9 G93 G61.1 G9 G90.1 G91.1 G97 G40.1 G5 G5.1 G8 G103 G187 G4 M3 M4 M5 G59.1 "
    "G59.2 G59.3 G54.1 G154 G110 G111 G112 G113 G114 G115 G116 G117 G118 G119 G120 G121 G122 G123 G124 G125 G126 G127 "
    "G128 G129 G92.1 G92.2 G92.3 G69 G50 G51.1 G50.1 G15 G16 G30 G29 G27 G28.1 G30.1 G20 G70 G21 G71 G43 G44 G49 "
    "G43.1 D H T M6 G41.1 G42.1 M13 M14 M19 M60 M29 M48 M49 M50 M51 M52 M53 M M62 M63 M64 M65 M66 M67 M68 M190"
)
_PARTS = (modes, motion, offsets, tools, variables, programs, corners, o_words)
_ALL = {code: function for part in _PARTS for code, function in part.FUNCTIONS.items()}
FUNCTIONS = FunctionTable({code: _ALL[code] for code in (*FIRST.split(), *_ALL)})

CONTROL = Control(
    name="g43",
    title="ISO mill (control with G43, G44, G49)",
    suffixes=(".g43", ".iso"),
    read=read,
    functions=FUNCTIONS,
    cycles=cycles.CYCLES,
    phases=PHASES,
    settings=SETTINGS,
    frames=("length", "external", "datum", "set", "local", "mirror", "rotation", "scaling"),
    memory=Memory,
    compensation=Compensation(approach="corner", change=True, look_ahead=True, rapid=True),
    start=start,
    signs=SIGNS,
    numbers=numbers,
    refused=REFUSED,
    meanings=MEANINGS,
    together=motion.together,
    computed=programs.computed,
    preassigned=variables.PREASSIGNED,
    calls_again=programs.calls_again,
    bulk=PlainWords(
        motions={0.0: ("G0", 0), 1.0: ("G1", 1), 2.0: ("G2", -2), 3.0: ("G3", 2)},
        ready=lambda m: motion.is_plain(m) and not m.modal.get("call"),
        helices=more_helices,
        zero_along=True,
        unit=lambda m: m.variable_unit,
    ),
    trial=trial_program,
)
