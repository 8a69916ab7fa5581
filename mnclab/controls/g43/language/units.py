"""Inches and millimetres: G20 and G21, in older programs G70 and G71."""

from __future__ import annotations

from mnclab.controls.g43.remarks import ISO
from mnclab.controls.word_address.motion import first_word, refuse_change
from mnclab.machine.control import FunctionTable, Words
from mnclab.machine.machine import Machine

FUNCTIONS = FunctionTable()
INCH = 25.4
UNITS = {"G20": INCH, "G70": INCH, "G21": 1.0, "G71": 1.0}
LATHE = {"G70": "finishes", "G71": "roughs"}  # on LinuxCNC
NAMES = {code: "Inches" if factor == INCH else "Millimetres" for code, factor in UNITS.items()}


def start(m: Machine) -> None:
    """The unit that is active before the program says one."""
    if m.settings["units"] == "inch":
        m.set_modal("unit", "G20")
        m.variable_unit = INCH


@FUNCTIONS(" ".join(UNITS), NAMES, group="unit", phase="plane", power_on="G21", source=ISO)
def unit(m: Machine, words: Words) -> None:
    """What lengths and feeds of the program count in from this block on; the feed keeps its speed."""
    if words.code in LATHE and m.settings["dialect"] == "linuxcnc":
        hint = f"write G2{int(words.code == 'G71')} for the unit; lathes have the control jnc-t01"
        m.alarm(f"{words.code} is no unit on LinuxCNC but {LATHE[words.code]} a contour on a lathe", first_word(words), hint)
    factor = UNITS[words.code]
    if factor != m.variable_unit:
        refuse_change(m, "unit", first_word(words))
        m.variable_unit = factor
