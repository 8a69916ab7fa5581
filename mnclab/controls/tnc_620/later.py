"""What the TNC 620 knows and is not built yet: refused by name where a program uses it.

What gets built leaves these tables (a test says so). The names of the cycles are those of the manual's list
(chapter 20) and, for the obsolete ones, of earlier manuals.
"""

from __future__ import annotations

CYCLES = {
    21: "Pilot drilling", 23: "Floor finishing", 24: "Side finishing", 25: "Contour train", 27: "Cylinder surface",
    28: "Cylinder surface slot", 29: "Cylinder surface ridge", 39: "Cylinder surface contour",
    270: "Contour train data", 275: "Trochoidal slot", 276: "Three-dimensional contour train",
    # technically obsolete, but programs with them still run (1.2)
    1: "Pecking", 2: "Tapping", 3: "Slot milling", 4: "Pocket milling", 5: "Circular pocket", 17: "Rigid tapping",
    210: "Slot with reciprocating plunge", 211: "Circular slot with reciprocating plunge", 212: "Pocket finishing",
    213: "Stud finishing", 214: "Circular pocket finishing", 215: "Circular stud finishing",
    230: "Multipass milling", 231: "Ruled surface",
}  # fmt: skip

PROBING = {
    0: "Reference plane", 1: "Polar preset", 3: "Measuring", 4: "Measuring in three dimensions",
    30: "Calibrating the tool probe", 31: "Tool length", 32: "Tool radius", 33: "Tool length and radius",
    400: "Basic rotation over two points", 401: "Basic rotation over two holes",
    402: "Basic rotation over two studs", 403: "Misalignment by a rotary axis", 404: "Setting a basic rotation",
    405: "Misalignment by the C axis", 408: "Preset at a slot centre", 409: "Preset at a ridge centre",
    410: "Preset from inside a rectangle", 411: "Preset from outside a rectangle",
    412: "Preset from inside a circle", 413: "Preset from outside a circle", 414: "Preset from outside a corner",
    415: "Preset from inside a corner", 416: "Preset at the centre of a bolt hole circle",
    417: "Preset in the probe axis", 418: "Preset between four holes", 420: "Measuring an angle",
    421: "Measuring a hole", 422: "Measuring a circle from outside", 423: "Measuring a rectangle from inside",
    424: "Measuring a rectangle from outside", 425: "Measuring an inside width", 426: "Measuring an outside width",
    427: "Measuring in one axis", 430: "Measuring a bolt hole circle", 431: "Measuring a plane", 441: "Fast probing",
    450: "Saving the kinematics", 451: "Measuring the kinematics", 452: "Preset compensation",
    460: "Calibrating the probe", 461: "Calibrating the probe length", 462: "Calibrating the probe radius inside",
    463: "Calibrating the probe radius outside", 480: "Calibrating the tool probe", 481: "Tool length",
    482: "Tool radius", 483: "Tool length and radius", 484: "Calibrating a wireless tool probe",
    1410: "Probing on an edge", 1411: "Probing two circles", 1420: "Probing in a plane",
}  # fmt: skip

STATEMENTS = {
    "SEL CONTOUR": "contour definition", "DECLARE CONTOUR": "contour designator", "CONTOUR DEF": "simple contour formula",
    "TRANS DATUM": "datum shift", "QC": "contour formula",
    **{f"PLANE {form}": "tilted plane" for form in "SPATIAL PROJECTED EULER VECTOR POINTS RELATIV AXIAL RESET".split()},
    **{f"FUNCTION {form}": "special function" for form in "TCPM PARAXMODE PARAXCOMP RESET MODE DWELL FEED".split()},
    **{f"BLK FORM {form}": "blank" for form in "CYLINDER ROTATION FILE".split()},
}  # fmt: skip

FN = {
    15: "unformatted output", 16: "formatted output", 19: "values to the PLC", 20: "synchronizing with the PLC",
    23: "circle from three points", 24: "circle from four points", 25: "setting the datum", 26: "opening a table",
    27: "writing to a table", 28: "reading from a table", 29: "values to the PLC", 37: "exporting parameters",
    38: "sending to a log",
}  # fmt: skip

M = {
    97: "small contour steps", 98: "open contour corners", 101: "replacement tool", 102: "end of M101",
    107: "no error with replacement tools", 108: "end of M107", 116: "feed of rotary axes in mm/min",
    117: "end of M116", 120: "look-ahead", 126: "shortest way of rotary axes", 127: "end of M126",
    128: "tool centre point management", 129: "end of M128", 130: "positions in the untilted system",
    136: "feed per revolution", 137: "end of M136", 138: "choice of tilting axes", 140: "retraction",
    141: "no probe monitoring", 143: "cancelling a basic rotation", 144: "kinematics in actual positions",
    145: "end of M144", 148: "lift-off at stop", 149: "end of M148", 197: "rounding of corners",
}  # fmt: skip

BUILDER = "a cycle of the machine tool builder, whose manual alone describes it"

#: Forms that do not exist, although their neighbours do.
NOT_THERE = {
    f"DEP {form}": f"it names no point that could be polar; write DEP {form[1:]}" for form in ("PLT", "PLN", "PCT")
}

WORDS = {
    **{axis: f"the axis {axis} is not built yet" for axis in "UVW"},
    **{axis: f"the rotary axis {axis} is built for L alone" for axis in "ABC"},
}  # fmt: skip


WAITING = {
    **{f"CYCL DEF {n}": title for n, title in CYCLES.items()},
    **{f"TCH PROBE {n}": title for n, title in PROBING.items()},
    **STATEMENTS,
    **{f"FN {n}": title for n, title in FN.items()},
    **{f"M{n}": title for n, title in M.items()},
}
#: Codes and addresses that are not built, with the sentence that says so.
REFUSED = {
    **{code: f"{title}, not built yet" for code, title in WAITING.items()},
    **{f"CYCL DEF {n}": BUILDER for n in range(300, 400)},
    **{f"TCH PROBE {n}": BUILDER for n in range(500, 600)},
    **NOT_THERE,
    **WORDS,
}
