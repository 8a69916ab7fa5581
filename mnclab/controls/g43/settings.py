"""The settings of the ISO mill: where the makers of such controls differ, and what the operator chooses.

`dialect` chooses for a maker all at once, any other setting for itself. The makers are those of public manuals: Fanuc's
for machining centres, Haas's for mills, the documentation of LinuxCNC.
"""

from __future__ import annotations

from typing import Any

from mnclab.machine.settings import Setting, one_of

FANUC, HAAS, LINUXCNC = "Fanuc", "Haas", "LinuxCNC"
ALL = "Fanuc, Haas, LinuxCNC"

#: What a dialect chooses; Fanuc's are the defaults.
DIALECTS: dict[str, dict[str, Any]] = {
    "fanuc": {},
    "haas": {"dwell_p": "point"},
    "linuxcnc": {
        "macros": "linuxcnc", "main_m99": "repeat", "below_r": "straight", "dwell_p": "seconds", "peck_clearance": 0.254,
        "arc_by_both": "refuse",
    },
}  # fmt: skip

PROGRAM = (
    one_of("dialect", "whose meaning words have where makers differ", "the maker's public manual",
           fanuc="Fanuc's, which is that of most", haas="that of Haas mills", linuxcnc="that of LinuxCNC")._replace(
           chooses=DIALECTS),
    Setting("block_skip", False, "operator mode: blocks with / are passed over", "ISO 6983"),
    one_of("undescribed", "codes of chapters that the one manual of this control does not have", "other chapters",
           accept="their ISO meaning, without a word", warn="their ISO meaning, with a warning", refuse="an alarm"),
)  # fmt: skip

MOTION = (
    Setting("arc_tolerance", 0.01, "difference of the radii at start and end of an arc", "", {}, "mm", 0),
    one_of("arc_by_both", "R and I J K in one block", FANUC,
           radius="R counts, with a warning", centre="I J K count, with a warning", refuse="an alarm (LinuxCNC)"),
    one_of("helix", "a word of the third axis in an arc block", ALL,
           accept="a helix, without a word", warn="a helix, with a warning", refuse="an alarm"),
    one_of("gouge", "what happens where a compensated tool does not fit",
           refuse="an alarm, before the tool goes there", mark="it cuts anyway: marked rows and warnings"),
)  # fmt: skip

TECHNOLOGY = (
    one_of("dwell_p", "what P counts in where it is a dwell: in G4 and in cycles", FANUC,
           milliseconds="milliseconds", point="seconds with a decimal point, else milliseconds (Haas)",
           seconds="seconds (LinuxCNC)"),
    Setting("peck_clearance", 1.0, "where G83 returns to above the last depth, and how far G73 lifts; 0.254 on LinuxCNC",
            "", {}, "mm", 0),
    Setting("bulk", True, "obey long runs of plain blocks at once"),
)  # fmt: skip

HOLES = (
    one_of("motion_in_cycle", "what G0, G1, G2 and G3 do while a cycle is active", ALL,
           ends="they end the cycle", waits="they wait until its end, and each position is a hole"),
    one_of("below_r", "which way a cycle begins from below level R", "on the safe side",
           up="first up to level R, then over the hole", across="first over the hole, then up to level R (Fanuc)",
           straight="to level R first if the initial level is below it, else straight to R over the hole (LinuxCNC)"),
)  # fmt: skip

MACROS = (
    one_of("macros", "variables without a value, AND, OR, FIX, FUP, MOD and the ranges of angles", FANUC,
           fanuc="without a value an address is left out, AND works on bits, FIX cuts off, angles are 0 to 360",
           linuxcnc="0, AND is true or false, FIX rounds down, angles are -180 to 180, EQ forgives 0.0001"),
    one_of("main_m99", "M99 in the main program", "the simulation runs a program once",
           end="the program ends here, with a warning", repeat="it begins again, for ever (Fanuc, LinuxCNC)"),
    Setting("skip_switches", 123456789, "the switches that are on where block_skip is: their digits; / is /1", FANUC,
            {}, "", 1, 987654321),
)  # fmt: skip

SETTINGS = PROGRAM + MACROS + MOTION + TECHNOLOGY + HOLES
