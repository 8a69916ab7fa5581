"""The settings of the ISO mill: where the makers of such controls differ, and what the operator chooses. Behind them what the
words of functions mean, and the signs by which its programs are known.

`dialect` chooses for a maker all at once, any other setting for itself. The makers are those of public manuals: Fanuc's
for machining centres, Haas's for mills, the documentation of LinuxCNC.
"""

from __future__ import annotations

from typing import Any

from mnclab.controls.g43.language import o_words, programs
from mnclab.machine.control import Setting, one_of

FANUC, HAAS, LINUXCNC = "Fanuc", "Haas", "LinuxCNC"
ALL = "Fanuc, Haas, LinuxCNC"
DIALECT_NAMES = {"fanuc": FANUC, "haas": HAAS, "linuxcnc": LINUXCNC}
REFERENCES = {2: "second", 3: "third", 4: "fourth"}  # points of G30

#: What a dialect chooses; Fanuc's are the defaults.
DIALECTS: dict[str, dict[str, Any]] = {
    "fanuc": {},
    "haas": {
        "dwell_p": "point", "g51_factor": "as_written", "g10_p0": "refuse", "d_measures": "diameter",
        "g53_motion": "modal", "g53_increment": "absolute", "skip_position": "tip",
    },
    "linuxcnc": {
        "macros": "linuxcnc", "main_m99": "repeat",
        "dwell_p": "seconds", "peck_clearance": 0.254, "below_r": "straight", "arc_by_both": "refuse",
        "length_acts": "at_once", "g52_g92": "one", "g53_motion": "modal", "g53_increment": "refuse",
        "g10_p0": "active", "g10_l20": "position", "g10_increment": "replaces",
        "hole_axis": "normal", "hole_data": "numbers", "compensation_leads": "linuxcnc",
        "return_at_start": "G99", "axis_words": "refuse", "g61": "corners",
        "arc_tolerance": 0.02 * 2**0.5, "arc_tolerance_share": 1e-3, "arc_reach": 0.00127,
    },
}  # fmt: skip

PROGRAM = (
    one_of("dialect", "whose meaning words have where makers differ", "the maker's public manual",
           fanuc="Fanuc's, which is that of most", haas="that of Haas mills", linuxcnc="that of LinuxCNC")._replace(
           chooses=DIALECTS),
    one_of("units", "what lengths count in before G20 or G21", ALL, mm="millimetres", inch="inches"),
    Setting("block_skip", False, "operator mode: blocks with / are passed over", "ISO 6983"),
    one_of("undescribed", "codes of chapters that the one manual of this control does not have", "other chapters",
           accept="their ISO meaning, without a word", warn="their ISO meaning, with a warning", refuse="an alarm"),
)  # fmt: skip

MOTION = (
    Setting("arc_tolerance", 0.01, "difference of the radii at start and end of an arc", "", {}, "mm", 0),
    Setting("arc_tolerance_share", 0.0, "the part of the radius by which they may differ, up to 100 times arc_tolerance, which"
            " counts 2.54 times under G20 then (LinuxCNC: 0.001)", "", {}, "", 0, 1),
    Setting("arc_reach", 0.01, "by how much R may be less than half the way to the end (LinuxCNC: 0.00127)", "", {}, "mm", 0),
    one_of("skip_position", "what #5061 to #5063 tell after G31", FANUC,
           with_length="the place with the length offset of G43, as #5041 to #5043", tip="the coordinates as programmed (Haas)"),
    one_of("axis_words", "X Y Z where no motion is active: at the start and after G80", "Fanuc, Haas",
           move="G0 at the start, after G80 the motion before the cycle", refuse="an alarm (LinuxCNC)"),
    one_of("g61", "where G61 stops", "Fanuc, Haas",
           blocks="at the end of every motion", corners="not where the next motion goes straight on (LinuxCNC)"),
    one_of("arc_by_both", "R and I J K in one block", FANUC,
           radius="R counts, with a warning", centre="I J K count, with a warning", refuse="an alarm (LinuxCNC)"),
    one_of("helix", "a word of the third axis in an arc block", ALL,
           accept="a helix, without a word", warn="a helix, with a warning", refuse="an alarm"),
    one_of("compensation_leads", "how radius compensation begins and ends", FANUC,
           corners="in straight lines, with corners at the contour like any other",
           linuxcnc="also with an arc; the way after G40 leads straight from the end of the last element (LinuxCNC)"),
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

COORDINATES = (
    one_of("start_datum", "what coordinates count from before a work offset is selected", ALL,
           G54="G54", none="machine zero"),
    one_of("g92_lasts", "the shift of G92 where a work offset is selected", ALL,
           stays="stays: it shifts all of them", ends="is over"),
    one_of("arc_centres", "I J K of arcs before G90.1 or G91.1", ALL,
           start="from the start of the arc", origin="from the origin (routers)"),
    one_of("length_acts", "when the offsets of G43, G44 and G49 count; the block itself moves nothing", "7.1",
           axis="along an axis with its next word", at_once="at once: the coordinates are read anew (LinuxCNC)"),
    one_of("g52_g92", "the shifts of G52 and G92", FANUC,
           apart="two: G52 counts inside G92, which ends that of its axes", one="one register for both (LinuxCNC)"),
    one_of("g53_motion", "G53 while G1 is active", FANUC,
           rapid="at rapid", modal="at feed (Haas, LinuxCNC)"),
    one_of("g53_increment", "G53 under G91", FANUC,
           ignored="counts for nothing, with a warning", absolute="its coordinates are absolute (Haas)",
           refuse="an alarm (LinuxCNC)"),
    one_of("g68_increment", "R of G68 under G91", FANUC,
           adds="adds to the angle that is active", replaces="is the angle"),
    one_of("g51_factor", "factors of G51 without a decimal point", FANUC,
           thousandths="thousandths: P500 is a half", as_written="as they are written (Haas)"),
    one_of("g10_p0", "what G10 L2 P0 writes", FANUC,
           external="an offset before all work offsets", active="the active work offset (LinuxCNC)",
           refuse="an alarm (Haas)"),
    one_of("g10_l20", "G10 L20", "Fanuc, Haas",
           further="the offsets of G54.1", position="the offset by which the present point has these coordinates (LinuxCNC)"),
    one_of("g10_increment", "G10 under G91", "Fanuc, Haas",
           adds="adds to the table", replaces="replaces, as under G90 (LinuxCNC)"),
    one_of("d_measures", "R of G10 L12 and L13", FANUC, radius="a radius", diameter="a diameter (Haas)"),
    *(Setting(f"{name}_reference_{axis}", 0.0, f"{axis.upper()} of reference point {number}, machine coordinates", ALL, {}, "mm")
      for number, name in REFERENCES.items() for axis in "xyz"),
)  # fmt: skip

HOLES = (
    one_of("return_at_start", "where a cycle leaves the tool before G98 or G99 is written", "Fanuc, Haas",
           G98="at the initial level", G99="at level R (LinuxCNC)"),
    one_of("motion_in_cycle", "what G0, G1, G2 and G3 do while a cycle is active", ALL,
           ends="they end the cycle", waits="they wait until its end, and each position is a hole"),
    one_of("below_r", "which way a cycle begins from below level R", "on the safe side",
           up="first up to level R, then over the hole", across="first over the hole, then up to level R (Fanuc)",
           straight="to level R first if the initial level is below it, else straight to R over the hole (LinuxCNC)"),
    one_of("hole_axis", "along which axis a cycle works under G18 and G19", FANUC,
           z="along Z, whatever the plane", normal="along the normal of the plane (LinuxCNC): refused, it is not built"),
    one_of("hole_data", "Z and R of former blocks where G90 and G91 change within a cycle",
           places="stay where they are", numbers="their numbers count anew, as coordinates or increments (LinuxCNC)"),
    one_of("peck_tapping", "what G74 and G84 do between two pecks of Q", FANUC,
           lifts="they go back by peck_clearance", withdraws="they go back to level R"),
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

SETTINGS = PROGRAM + MACROS + MOTION + COORDINATES + TECHNOLOGY + HOLES


# What the words of functions are.

_CENTRES = {f"G{n} {letter}": f"centre along {axis}, from the start or, after G90.1, the origin"
            for n in (2, 3) for letter, axis in zip("IJK", "XYZ")}  # fmt: skip

TILTS = ("G68.2", "G68.4", "G268", "G68.3")

MEANINGS = {
    **_CENTRES,
    **{f"G51 {letter}": f"factor along {axis}" for letter, axis in zip("IJK", "XYZ")},
    **{f"G51 {axis}": f"{axis} of the fixed point" for axis in "XYZ"},
    **{f"G68 {axis}": f"{axis} of the centre" for axis in "XYZ"},
    **{f"G51.1 {axis}": f"line to mirror about, across {axis}" for axis in "XYZ"},
    **{f"G50.1 {axis}": f"ends the mirror image across {axis}" for axis in "XYZ"},
    **{f"G52 {axis}": f"origin's {axis} from the work offset" for axis in "XYZ"},
    **{f"G92 {axis}": f"new value of {axis} where the tool stands" for axis in "XYZ"},
    **{f"G92.1 {axis}": f"ends the shift along {axis}" for axis in "XYZ"},
    **{f"G10 {axis}": f"{axis} of the row" for axis in "XYZ"},
    **{f"G43.1 {axis}": f"offset along {axis}" for axis in "XYZ"},
    **{f"{code} {axis}": f"{axis} of the origin of the plane" for code in TILTS for axis in "XYZ"},
    **{f"{code} {letter}": f"{which} angle, degrees, or component of a direction" for code in TILTS[:2]
       for letter, which in zip("IJK", ("first", "second", "third"))},
    **{f"G268 {letter}": f"turn about {axis}, degrees" for letter, axis in zip("IJK", "XYZ")},
    **{f"{code} P": "how the plane is said, 0 to 4" for code in TILTS[:2]},
    **{f"{code} Q": "order of the rotations, or number of the block" for code in TILTS[:3]},
    **{f"{code} R": "angle within the plane, degrees" for code in ("G68.2", "G68.4", "G68.3")},
    "G53.1 P": "which of two ways: 1 the tilting axis above 0, 2 below",
    **{axis: f"angle of the rotary axis {axis}, degrees" for axis in "ABC"},
    "R": "radius", "G4 P": "the time, counted as the setting dwell_p says", "G4 X": "seconds",
    "G2 P": "number of turns", "G3 P": "number of turns", "G68 R": "angle, degrees", "G51 P": "factor of all axes",
    "G10 L": "which table", "G10 P": "row of the table", "G10 R": "of L2 the angle of the system, degrees, else the value",
    "G54.1 P": "number of the work offset", "G154 P": "number of the work offset", "G30 P": "number of the reference point",
    "G64 P": "how far a corner may be cut", "G64 Q": "how far short moves may be joined",
    "G41.1 D": "diameter of the tool", "G42.1 D": "diameter of the tool", "M19 R": "angle, degrees", "M19 P": "angle, degrees",
    "M19 Q": "how long the machine waits for it, s", "P": "choice of the function", "Q": "choice of the function",
    "E": "number of the signal", "L": "what to wait for", "G187 E": "how exact corners are",
    **programs.MACRO_MEANINGS, **programs.MEANINGS, **o_words.MEANINGS,
    **{f"{code} R": "choice of the function" for code in ("G5", "G5.1", "G8", "G103", "G187")},
}  # fmt: skip
