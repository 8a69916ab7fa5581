"""Begin and end of a program, the blank, stops (catalogue: BEGIN PGM, END PGM, BLK FORM, STOP, M0 to M30)."""

from __future__ import annotations

from typing import NamedTuple

from mnclab.controls.tnc_620.cycles.chain import cancel
from mnclab.controls.tnc_620.language import parameters
from mnclab.controls.tnc_620.language.checks import counted, first
from mnclab.controls.tnc_620.reading.words import INCH
from mnclab.controls.tnc_620.state import memory
from mnclab.machine.control import FunctionTable, Words
from mnclab.machine.machine import Machine
from mnclab.machine.setup import Datum
from mnclab.running.performing import perform

FUNCTIONS = FunctionTable()
STOPS = {"M0": "Program stop", "M1": "Optional stop"}

Corner = tuple[float, float, float]


class Blank(NamedTuple):
    """The cuboid of BLK FORM, mm in program coordinates, and its tool axis; the greatest corner comes with 0.2."""

    axis: str
    minimum: Corner
    maximum: Corner | None = None

    def __str__(self) -> str:
        corners = (corner for corner in (self.minimum, self.maximum) if corner)
        return " to ".join("X{:g} Y{:g} Z{:g}".format(*corner) for corner in corners)


def start(m: Machine) -> None:
    """The active preset is the datum of the program (setting "preset")."""
    row = m.settings["preset"]
    preset = m.tables.presets.get(row, Datum())
    if any((preset.a, preset.b, preset.c, preset.rotation)):
        m.alarm(f"preset {row} carries a rotation, which is not built yet")
    m.select_datum(preset, "preset")
    parameters.start(m)


@FUNCTIONS("BEGIN PGM,", "Program begin", takes="name unit", source="4.11, example")
def begin(m: Machine, words: Words) -> None:
    """Names the program and its unit; lengths and feeds of an INCH program become mm where they are read."""
    kept, unit = memory(m), str(words["unit"].value)
    kept.name, kept.unit = str(words["name"].value) if "name" in words else "", unit
    kept.main_unit = kept.main_unit or unit  # the first one is that of the main program
    m.variable_unit = INCH if unit == "INCH" else 1.0


@FUNCTIONS("END PGM,", "Program end", takes="name unit", phase="last", source="4.11, example")
def end(m: Machine, words: Words) -> None:
    """The last block of a program; a program that was called goes back to the one that calls."""
    name, unit = words["name"].value if "name" in words else "", words["unit"]
    kept = memory(m)
    if kept.unit is not None and unit.value != kept.unit:
        m.alarm(f"END PGM says {unit.value}, BEGIN PGM {kept.unit}", unit)
    if kept.name is not None and name != kept.name:
        m.warn(f"END PGM names {name}, BEGIN PGM {kept.name}", words.words[0])
    if m.flow.called:
        m.flow.end_program()
    else:
        finish(m)


def finish(m: Machine) -> None:
    """The end of the run: spindle and coolant off, transformations cancelled (11.1)."""
    if (blank := memory(m).stock) is not None and blank.maximum is None:
        m.warn("the blank has no greatest corner: BLK FORM 0.2 is missing")
    m.spindle(turning=0)
    if m.modal.get("coolant", "M9") != "M9":
        m.set_modal("coolant", "M9")
        m.coolant()
    perform(m, "END PGM", cancel(m))
    m.ended = True


@FUNCTIONS("FUNCTION RESET TCPM,", "End of TCPM", source="Klartext, not described")
def reset_tcpm(m: Machine, words: Words) -> None:
    """TCPM is refused where it begins: there is nothing to end."""


@FUNCTIONS("BLK FORM 0.1,", "Blank: least corner", takes="axis X Y Z", source="4.11, example")
def least_corner(m: Machine, words: Words) -> None:
    """Tool axis and the corner with the least coordinates; for pictures only, no motion."""
    if "axis" not in words:
        m.alarm("BLK FORM 0.1 needs the tool axis", hint="for example BLK FORM 0.1 Z X+0 Y+0 Z-20")
    if (blank := memory(m).stock) is not None and blank.maximum is None:
        m.alarm("BLK FORM 0.1 stands twice: BLK FORM 0.2 belongs behind the first", words["axis"])
    axis = str(words["axis"].value)
    if axis not in ("X", "Y", "Z"):
        m.alarm(f"BLK FORM 0.1: the tool axis must be X, Y or Z, got {axis}", words["axis"])
    memory(m).stock = Blank(axis, corner(m, words))
    m.log("stock", memory(m).stock)


@FUNCTIONS("BLK FORM 0.2,", "Blank: greatest corner", takes="X Y Z", source="4.11, example")
def greatest_corner(m: Machine, words: Words) -> None:
    """The corner with the greatest coordinates; IX IY IZ count from the least corner."""
    blank = memory(m).stock
    if blank is None or blank.maximum is not None:
        m.alarm("BLK FORM 0.2 needs BLK FORM 0.1 before it", first(words))
    greatest = corner(m, words, blank.minimum)
    for axis, low, high in zip("XYZ", blank.minimum, greatest, strict=True):
        if not high > low:
            m.alarm(f"BLK FORM 0.2 {axis} (greatest corner) must be greater than {low:g}, got {high:g}", words[axis])
    memory(m).stock = blank._replace(maximum=greatest)
    m.log("stock", memory(m).stock)


def corner(m: Machine, words: Words, least: Corner | None = None) -> Corner:
    for axis in "XYZ":
        what = f"{words.code} {axis} (coordinate of the corner)"
        if axis not in words:
            m.alarm(f"{what} is missing", first(words))
        if words[axis].incremental and least is None:
            m.alarm(f"{what} must be absolute", words[axis])
    x, y, z = (counted(m, words[axis], at) for axis, at in zip("XYZ", least or (0.0, 0.0, 0.0), strict=True))
    return x, y, z


@FUNCTIONS("STOP", "Program stop", phase="end", source="Klartext, not described")
@FUNCTIONS("M0 M1", STOPS, phase="end", modal=False, source="Klartext, not described")
def stop(m: Machine, words: Words) -> None:
    """Wait for the operator, after the motion of the block."""
    m.stop()


@FUNCTIONS("M2 M30", "Program end", group="program end", phase="last", modal=False, source="4.11, example")
def program_end(m: Machine, words: Words) -> None:
    """The run ends after this block; subprograms may follow it."""
    if m.flow.called:
        what = f"{words.code} ends the run and cannot stand in a program that was called"
        m.alarm(what, words.words[0], "a called program ends with END PGM")
    finish(m)
