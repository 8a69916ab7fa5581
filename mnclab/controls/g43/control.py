"""The control itself: what it reads, obeys, and needs to be told."""

from __future__ import annotations

from pathlib import Path

from mnclab.controls.g43 import SIGNS, SUFFIXES, cycles
from mnclab.controls.g43.language import (
    corners,
    modes,
    motion,
    o_words,
    offsets,
    probing,
    programs,
    tilting,
    tools,
    variables,
)
from mnclab.controls.g43.reading.reader import numbers, read
from mnclab.controls.g43.refused import (
    COMPENSATED,
    NOT_OF_LINUXCNC,
    REFUSED,
    compensated_on_linuxcnc,
    unknown_to_linuxcnc,
)
from mnclab.controls.g43.settings import MEANINGS, SETTINGS
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
    *("plane", "feed", "spindle", "tool", "change", "auxiliary", "uncompensate", "data", "corrector", "length", "frames"),
    *("local", "transformation", "compensation", "blending", "dwell", "motion", "call", "end"),
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
FIRST = "G0 G1 G2 G3 G17 G18 G19 G90 G91 G54 G55 G56 G57 G58 G59 G53 G52 G92 G28 G68 G51 G10 F S G94 G95 G61 G64"
_PARTS = (modes, motion, probing, offsets, tilting, tools, variables, programs, corners, o_words)
_ALL = {code: function for part in _PARTS for code, function in part.FUNCTIONS.items()}
_ALL |= {code: compensated_on_linuxcnc(_ALL[code]) for code in COMPENSATED}
_ALL |= {code: unknown_to_linuxcnc(_ALL[code]) for code in NOT_OF_LINUXCNC}
FUNCTIONS = FunctionTable({code: _ALL[code] for code in (*FIRST.split(), *_ALL)})

CONTROL = Control(
    name="g43",
    title="ISO mill (control with G43, G44, G49)",
    suffixes=SUFFIXES,
    terms=Path(__file__).with_name("terms.toml"),
    read=read,
    functions=FUNCTIONS,
    cycles=cycles.CYCLES,
    phases=PHASES,
    settings=SETTINGS,
    frames=("length", "external", "datum", "set", "local", "tilt", "mirror", "rotation", "scaling"),
    memory=Memory,
    compensation=Compensation(approach="corner", change=True, look_ahead=True, rapid=True),
    start=start,
    finish=programs.without_end,
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
