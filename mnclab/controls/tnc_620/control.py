"""The control itself: what it reads, obeys, and needs to be told."""

from __future__ import annotations

from pathlib import Path

from mnclab.controls.tnc_620 import SIGNS, SUFFIXES, later, printing, tables, trial
from mnclab.controls.tnc_620.block_numbers import numbers
from mnclab.controls.tnc_620.contours import area, area_cycles, cylinder, formulas, train, trochoidal_slot
from mnclab.controls.tnc_620.contours import line as contour_line
from mnclab.controls.tnc_620.cycles import (
    defaults,
    drilling,
    engraving,
    faces,
    obsolete_figures,
    obsolete_sub_blocks,
    pockets,
    special,
    studs,
    threads,
    tilting,
    transformations,
)
from mnclab.controls.tnc_620.cycles import patterns as point_patterns
from mnclab.controls.tnc_620.language import (
    approach,
    auxiliary,
    flow,
    free_contours,
    functions,
    m_functions,
    motion,
    pattern_definitions,
    plane,
    program,
    rotary,
    system_data,
    tools,
    values,
)
from mnclab.controls.tnc_620.probing import (
    aimed,
    calibration,
    cycle,
    kinematics,
    line,
    measuring,
    presets,
    rotation,
    saved_kinematics,
    single,
    tool_setter,
)
from mnclab.controls.tnc_620.reading import reader
from mnclab.controls.tnc_620.reading.words import ISO_NAMES
from mnclab.controls.tnc_620.state import Memory
from mnclab.controls.tnc_620.trial import SETUP, trial_program
from mnclab.machine.control import Control, Setting
from mnclab.machine.cycle import CycleTable
from mnclab.path.compensation import Compensation
from mnclab.running.bulk import PlainWords

#: Order inside a block: M functions that act at its start, the statement, calls, M functions that act at its end.
PHASES = ("start", "motion", "call", "end", "last")

SETTINGS = (
    Setting("block_skip", False, "operator mode: blocks with / are passed over", "Klartext, not described"),
    Setting("preset", 0, "row of the preset table that is active at the start", "11.4"),
    Setting("overlap", 1.0, "path overlap factor of pockets (pocketOverlap), which Q112 shows", ""),
    Setting("depth_error", True, "a positive depth of a cycle is an alarm (displayDepthErr, no. 201003)", "4.3"),
    Setting("controlled_spindle", True, "the spindle's angle is controlled, as 202, 204, 207, 209 need it", "4.5, 5.3"),
    Setting("plunge_error", True, "a helix narrower than twice the tool is an alarm (suppressPlungeErr, no. 201006)", "6.2"),
    Setting(
        "gouge", "control", "what happens where a compensated tool does not fit", "",
        {"control": "an alarm where an element and its neighbours have no room, as the control has it; what it does not see"
                    " is marked and warned of", "refuse": "an alarm, before the tool goes there, anywhere",
         "mark": "it cuts anyway: marked rows and warnings"},
    ),
    Setting("feed_needed", True, "a move before any feed rate is an alarm; without, it is at rapid with a warning", "6.10"),
    Setting("m6_stop", False, "M6 stops the program for a change of the tool by hand", "5.11"),
    Setting("spindle_angle", 0, "where M19 and M20 stop the spindle without Cycle 13", "12.4", unit="deg"),
    *(Setting(f"m92_{axis}", 0, f"{axis.upper()} of the position that M92 counts from", "11.9", unit="mm") for axis in "xyz"),
    Setting(
        "pattern_cycles", "refuse", "cycles 220 and 221 with a cycle that the manual does not name for them", "7.1",
        {"refuse": "an alarm", "warn": "a warning, and they run"},
    ),
    Setting(
        "thread_wait", 0.0, "how long the spindle stands at the bottom of a tapped thread (thrdWaitingTime, no. 113601)", "5.2",
        unit="s", at_least=0,
    ),
    *auxiliary.SETTINGS, *tools.SETTINGS, *m_functions.SETTINGS, *m_functions.AWAY_SETTINGS,
    *tilting.SETTINGS, *rotary.SETTINGS, *engraving.SETTINGS,
    *faces.SETTINGS, *tools.AXES_SETTINGS, *system_data.SETTINGS, *printing.SETTINGS,
    *tool_setter.SETTINGS,
    *aimed.SETTINGS,
    *contour_line.SETTINGS, *cylinder.SETTINGS,
    *calibration.SETTINGS,
    *saved_kinematics.SETTINGS, *kinematics.SETTINGS,
    Setting("max_touch_feed", 3000.0, "upper limit of the probing feed (maxTouchFeed, no. 122602)", "13.2", {}, "mm/min", 1),
    Setting("bulk", True, "obey long runs of plain blocks at once", ""),
)  # fmt: skip

FUNCTIONS = (
    motion.FUNCTIONS | approach.FUNCTIONS | flow.FUNCTIONS | values.FUNCTIONS | tools.FUNCTIONS
    | program.FUNCTIONS | auxiliary.FUNCTIONS | m_functions.FUNCTIONS | plane.FUNCTIONS | rotary.FUNCTIONS
    | pattern_definitions.FUNCTIONS | free_contours.FUNCTIONS | tables.FUNCTIONS | functions.FUNCTIONS
    | printing.FUNCTIONS | formulas.FUNCTIONS
)  # fmt: skip
CHAPTERS = (
    defaults, drilling, threads, point_patterns, pockets, studs, faces,
    area, area_cycles, train, trochoidal_slot, cylinder,
    transformations, tilting, special, engraving,
    presets, calibration, cycle, rotation, measuring, tool_setter, line, single,
    saved_kinematics, kinematics,
    obsolete_sub_blocks, obsolete_figures,
)  # fmt: skip
CYCLES = CycleTable()
for chapter in CHAPTERS:
    CYCLES |= chapter.CYCLES

#: What the words of statements are.
MEANINGS = {
    **auxiliary.MEANINGS, "FMAX": "rapid traverse", "G00": "rapid traverse",
    "FAUTO": "feed rate of TOOL CALL", "M103:F": "share downwards in percent",
    "S": "spindle speed", "R": "radius", "DR": "sense of rotation", "R0": "no radius compensation",
    "RL": "compensation to the left", "RR": "compensation to the right", "LEN": "length", "PR": "polar radius",
    "PA": "polar angle", "CCA": "centre angle", "length": "side length", "REP": "repetitions", "label": "label",
    "target": "the parameter that gets the value", "value": "formula", "tool": "tool", "axis": "tool axis",
    "name": "program name", "unit": "unit of lengths", "TOOL CALL DL": "delta length", "TOOL CALL DR": "delta radius",
    "text": "name of the tool in a text parameter",
    "first": "the first operand", "second": "the second operand", "parameter": "the parameter that is asked about",
    "state": "whether it has a value", "undefined": "it has no value any more", "FN 14 number": "error number",
    "mask": "file with the mask", "output": "file that is written", "item": "what is put out",
    "row": "row of the table", "columns": "columns of the table", "source": "the first parameter that is written",
    "points": "the first parameter of the points", "FN 25 axis": "axis of the datum",
    "FN 25 first": "coordinate that a point has", "FN 25 second": "coordinate that it gets",
    "ID": "group of system data", "NR": "number in its group", "IDX": "index", "FN 17 value": "the value to write",
    "TOOL CALL DR2": "delta corner radius", "TOOL DEF L": "length",
    "BLK FORM CYLINDER L": "length", "BLK FORM CYLINDER D": "diameter", "DIST": "from the datum to the front face",
    "RI": "radius of the bore", "DI": "diameter of the bore", "DIM": "whether X is the radius or the diameter",
    "BLK FORM CYLINDER axis": "axis", "BLK FORM ROTATION axis": "axis", "file": "name of a file",
    **{axis: f"angle of the rotary axis {axis}" for axis in "ABC"},
    **{axis: f"secondary axis along {along}" for axis, along in zip("UVW", "XYZ", strict=True)},
    **{f"M94:{axis}": f"the rotary axis {axis}" for axis in "ABC"},
    **{f"M118:{axis}": f"greatest way of the handwheel along {axis}" for axis in "XYZ"},
    **{f"M118:{axis}": f"greatest turn of the handwheel around {axis}" for axis in "ABC"},
    "TIME": "seconds", "REV": "turns of the spindle", **m_functions.WORDS, **rotary.WORDS, **m_functions.AWAY_WORDS,
    **{f"{code} {word}": plane.WORDS[word] for code, one in plane.FUNCTIONS.items() for word in one.takes if word in plane.WORDS},
    **formulas.MEANINGS,
    "FSELECT number": "number of the solution, as the control shows them", **free_contours.WORDS,
    **{f"PATTERN DEF {address}": meaning for address, meaning in pattern_definitions.MEANINGS.items()},
}  # fmt: skip

CONTROL = Control(
    name="tnc-620", title="HEIDENHAIN TNC 620 (2018)", suffixes=SUFFIXES,
    terms=Path(__file__).with_name("terms.toml"),
    read=reader.read, signs=SIGNS, numbers=numbers,
    functions=FUNCTIONS, cycles=CYCLES, names=ISO_NAMES, refused=later.REFUSED, together=later.strange_parameters(CYCLES),
    phases=PHASES, codes=("M",), word_functions=False, meanings=MEANINGS, told=motion.turning_sense, trial=trial_program,
    trial_files=trial.FILES,
    trial_setup=SETUP,
    settings=SETTINGS, memory=Memory, start=program.start, frames=(tools.SECONDARY, "preset"),
    storage="variables", preassigned={**values.PREASSIGNED, **system_data.TEXTS}, local_variables="QL",
    named=auxiliary.named, predefined=defaults.predefined, calls_again=flow.calls_again, turned=tools.turned,
    compensation=Compensation(approach="perpendicular", rapid=True),
    bulk=PlainWords(
        motions={None: ("L", 1)}, keyword="L", feed=lambda m: m.feed_unit,
        ready=lambda m: not m.modal.get("call") and m.memory.developed is None,
        rapid="FMAX", call="M",
        ends_at=lambda m: "R0" if m.side else "",
    ),
)  # fmt: skip
