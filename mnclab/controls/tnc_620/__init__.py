"""The HEIDENHAIN TNC 620 milling control (NC software 81760x-06, 2018), conversational programs.

``reader`` makes blocks of lines, ``statements`` and ``words`` say how each is written, ``language`` obeys statements and M
functions, ``cycles`` holds the fixed cycles by chapter of the manual, ``later`` names what is not built yet.
"""

from __future__ import annotations

import re

from mnclab.controls.tnc_620 import datum_tables, later, reader
from mnclab.controls.tnc_620.cycles import (
    contours,
    datums,
    drilling,
    engraving,
    face_milling,
    special,
    tapping,
    thread_drilling,
    threads,
    tilting,
    transformations,
)
from mnclab.controls.tnc_620.language import approach, auxiliary, calls, flow, motion, parameters, program, tools
from mnclab.controls.tnc_620.probing import presets
from mnclab.machine.bulk import PlainWords
from mnclab.machine.control import Control
from mnclab.machine.settings import Setting
from mnclab.path.compensation import Compensation

#: Order inside a block: M functions that act at its start, the statement, calls, M functions that act at its end.
PHASES = ("start", "motion", "call", "end", "last")

SETTINGS = (
    Setting("block_skip", False, "operator mode: blocks with / are passed over", "klartext"),
    Setting("preset", 0, "row of the preset table that is active at the start", "11.4"),
    Setting("depth_error", True, "a positive depth of a cycle is an alarm (displayDepthErr, no. 201003)", "4.3"),
    Setting(
        "gouge", "refuse", "what happens where a compensated tool does not fit", "",
        {"refuse": "an alarm, before the tool goes there", "mark": "it cuts anyway: marked rows and warnings"},
    ),
    Setting(
        "thread_wait", 0.0, "how long the spindle stands at the bottom of a tapped thread (thrdWaitingTime, no. 113601)", "5.2",
        unit="s", at_least=0,
    ),
    *tilting.SETTINGS, *engraving.SETTINGS,
    Setting("bulk", True, "obey long runs of plain blocks at once", ""),
)  # fmt: skip

FUNCTIONS = (
    motion.FUNCTIONS | approach.FUNCTIONS | flow.FUNCTIONS | parameters.FUNCTIONS | tools.FUNCTIONS | program.FUNCTIONS
    | auxiliary.FUNCTIONS | calls.FUNCTIONS | datum_tables.FUNCTIONS
)  # fmt: skip
CYCLES = drilling.CYCLES | contours.CYCLES | transformations.CYCLES | presets.CYCLES
CYCLES |= datums.CYCLES | tilting.CYCLES | special.CYCLES | engraving.CYCLES | face_milling.CYCLES
CYCLES |= tapping.CYCLES | threads.CYCLES | thread_drilling.CYCLES

#: What the words of statements are.
MEANINGS = {
    "F": "feed rate", "FMAX": "rapid traverse", "FAUTO": "feed rate of TOOL CALL", "S": "spindle speed",
    "R": "radius", "DR": "sense of rotation", "R0": "no radius compensation", "RL": "compensation to the left",
    "RR": "compensation to the right", "LEN": "length", "REP": "repetitions", "label": "label",
    "target": "the parameter that gets the value", "value": "formula", "tool": "tool", "axis": "tool axis",
    "name": "program name", "unit": "unit of lengths", "TOOL CALL DL": "delta length", "TOOL CALL DR": "delta radius",
    "file": "file name", "TOOL CALL DR2": "delta corner radius", "TOOL DEF L": "length",
}  # fmt: skip

_KLARTEXT = re.compile(
    r"^[ \t\ufeff]*\d*[ \t]*(BEGIN[ \t]+PGM|TOOL[ \t]+CALL|CYCL[ \t]+DEF|CALL[ \t]+LBL|L[ \t]+I?[XYZ])", re.I | re.M
)

CONTROL = Control(
    name="tnc-620",
    title="HEIDENHAIN TNC 620 (2018)",
    suffixes=(".h",),
    read=reader.read,
    functions=FUNCTIONS,
    cycles=CYCLES,
    phases=PHASES,
    codes=("M",),
    word_functions=False,
    settings=SETTINGS,
    storage="variables",
    frames=("preset",),
    compensation=Compensation(approach="perpendicular", rapid=True),
    start=program.start,
    looks_like=lambda text: _KLARTEXT.search(text) is not None,
    refused=later.refused(FUNCTIONS, CYCLES),
    meanings=MEANINGS,
    bulk=PlainWords(motions={None: ("L", 1)}, keyword="L", ready=lambda m: m.side == 0),
    named=motion.named,
)
