"""Begin and end of a program, stops (catalogue: BEGIN PGM, END PGM, STOP, M0 to M30)."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from mnclab.controls.tnc_620.cycles.chain import CARRIED, cancel
from mnclab.controls.tnc_620.language import values
from mnclab.controls.tnc_620.language.flow import label_name
from mnclab.controls.tnc_620.language.functions import put_out_tables
from mnclab.controls.tnc_620.language.values import above_zero, counted, first, in_units, not_negative
from mnclab.controls.tnc_620.reading.words import INCH
from mnclab.controls.tnc_620.state import count_in, memory
from mnclab.geometry.contours import Contour
from mnclab.geometry.frames import FrameChain
from mnclab.geometry.regions import Region
from mnclab.machine.control import FunctionTable, Words
from mnclab.machine.machine import Machine
from mnclab.machine.setup import Datum
from mnclab.path.plane import outline
from mnclab.path.toolpath import Toolpath
from mnclab.running.cycles import perform
from mnclab.running.flow import course
from mnclab.text.program import Word
from mnclab.workpiece.blank import Blank as Body
from mnclab.workpiece.blank import Box, cylinder
from mnclab.workpiece.turning.revolved import TurnedBlank

FUNCTIONS = FunctionTable()
STOPS = {"M0": "Program stop", "M1": "Optional stop"}


def start(m: Machine) -> None:
    """The active preset is the datum of the program (setting "preset")."""
    row = m.settings["preset"]
    preset = m.tables.presets.get(row, Datum())
    if m.tables.kinematics is not None:
        m.put(frames=FrameChain((CARRIED, *m.control.frames)))
    m.select_datum(preset, "preset")
    values.start(m)


@FUNCTIONS("BEGIN PGM,", "Program begin", takes="name unit", source="4.11, example")
def begin(m: Machine, words: Words) -> None:
    """Names the program and its unit; lengths of an INCH program become mm where they are read."""
    kept, unit = memory(m), str(words["unit"].value)
    kept.name, kept.unit = str(words["name"].value) if "name" in words else "", unit
    kept.main_unit = kept.main_unit or unit  # the first one is that of the main program
    if (length := INCH if unit == "INCH" else 1.0) != m.variable_unit:
        count_in(m, length)


@FUNCTIONS("END PGM,", "Program end", takes="name unit", leads_away=True, phase="last", source="4.11, example")
def end(m: Machine, words: Words) -> None:
    """The last block of a program; a program that was called goes back to the one that calls."""
    name, unit = words["name"].value if "name" in words else None, words.get("unit")
    kept = memory(m)
    if kept.unit is not None and unit is not None and unit.value != kept.unit:
        m.alarm(f"END PGM says {unit.value}, BEGIN PGM {kept.unit}", unit)
    if kept.name is not None and (name or "" if unit else name or kept.name) != kept.name:
        m.warn(f"END PGM names {name}, BEGIN PGM {kept.name}", words.words[0])
    kept.fast_probing = None  # 17.10
    if m.flow.called:
        m.flow.end_program()
    else:
        finish(m)


def finish(m: Machine) -> None:
    """The end of the run: spindle and coolant off, transformations cancelled (11.1)."""
    if half_given(m):
        m.warn("the blank has no greatest corner: BLK FORM 0.2 is missing")
    m.spindle(turning=0)
    m.set_modal("spindle", "M5")
    if m.modal.get("coolant", "M9") != "M9":
        m.set_modal("coolant", "M9")
        m.coolant()
    perform(m, "END PGM", cancel(m))
    put_out_tables(m)
    m.ended = True


@FUNCTIONS("FUNCTION DWELL,", "Dwell", takes="TIME REV", source="Klartext, not described")
def dwell(m: Machine, words: Words) -> None:
    """Waits for a time, or for turns of the spindle."""
    if "TIME" in words:
        return m.dwell(not_negative(m, words["TIME"], "FUNCTION DWELL TIME (seconds)"))
    turns = not_negative(m, words["REV"], "FUNCTION DWELL REV (turns of the spindle)")
    if not m.spindle_speed:
        m.alarm("FUNCTION DWELL REV needs a turning spindle", words["REV"], m.control.to_turn)
    m.dwell(turns * 60 / abs(m.spindle_speed))


@FUNCTIONS("STOP", "Program stop", phase="end", source="Klartext, not described")
@FUNCTIONS("M0 M1", STOPS, phase="end", modal=False, source="Klartext, not described")
def stop(m: Machine, words: Words) -> None:
    """Wait for the operator, after the motion of the block."""
    m.stop()


@FUNCTIONS("M2 M30", "Program end", group="program end", phase="last", modal=False, leads_away=True, source="4.11, example")
def program_end(m: Machine, words: Words) -> None:
    """The run ends after this block; subprograms may follow it."""
    if m.flow.called:
        what = f"{words.code} ends the run and cannot stand in a program that was called"
        m.alarm(what, words.words[0], "a called program ends with END PGM")
    if course(m).calls:
        hint = "LBL 0 ends a subprogram; M30 stands above the first of them"
        m.warn(f"{words.code} stands in a subprogram: the whole run ends here", words.words[0], hint)
    finish(m)


# The blank (catalogue: BLK FORM): a cuboid, a cylinder, or a body turned about Z whose half section stands in a label.
# For pictures and for what is cut; nothing moves. CYLINDER and ROTATION are those of the public manuals of the TNC 620 and 640:
# R or D, L along the rotary axis, DIST from the datum to the front face (R50 L105 DIST+5 reaches from -100 to +5), RI or DI
# of a bore; the contour of a ROTATION is closed, its X are radii (DIM_R) or diameters (DIM_D).

CLOSED = 1e-3  # mm between the beginning and the end of a contour
AXIS = 1e-9  # mm: what lies nearer lies on the axis

Corner = tuple[float, float, float]


class Blank(NamedTuple):
    """The cuboid of BLK FORM, mm in program coordinates, and its tool axis; the greatest corner comes with 0.2."""

    axis: str
    minimum: Corner
    maximum: Corner | None = None

    def __str__(self) -> str:
        return " to ".join("X{:g} Y{:g} Z{:g}".format(*corner) for corner in self.corners)

    @property
    def corners(self) -> list[Corner]:
        """Those that were given."""
        return [corner for corner in (self.minimum, self.maximum) if corner]


def body(m: Machine) -> Body | None:
    """The blank that the program gave last, in its coordinates; None where there is none yet, or half of one."""
    given = memory(m).stock
    if isinstance(given, Blank):
        return Box(given.minimum, given.maximum) if given.maximum else None
    return given


def give(m: Machine, blank: Blank | Body) -> None:
    memory(m).stock = blank
    m.log("stock", blank)


def half_given(m: Machine) -> Blank | None:
    """The cuboid whose greatest corner is missing."""
    blank = memory(m).stock
    return blank if isinstance(blank, Blank) and blank.maximum is None else None


def rotary_axis(m: Machine, words: Words, example: str) -> str:
    """X, Y or Z, the axis that a blank names."""
    meaning = "tool axis" if words.code == "BLK FORM 0.1" else "axis"
    if "axis" not in words:
        m.alarm(f"{words.code} needs the {meaning}", hint=f"for example {words.code} {example}")
    axis = str(words["axis"].value)
    if axis not in ("X", "Y", "Z"):
        m.alarm(f"{words.code}: the {meaning} must be X, Y or Z, got {axis}", words["axis"])
    if half_given(m):
        twice = " stands twice: BLK FORM 0.2 belongs behind the first"
        other = ": BLK FORM 0.1 stands before it without BLK FORM 0.2"
        m.alarm(words.code + (twice if words.code == "BLK FORM 0.1" else other), words["axis"])
    return axis


@FUNCTIONS("BLK FORM 0.1,", "Blank: least corner", takes="axis X Y Z", source="4.11, example")
def least_corner(m: Machine, words: Words) -> None:
    """Tool axis and the corner with the least coordinates; for pictures only, no motion."""
    axis = rotary_axis(m, words, "Z X+0 Y+0 Z-20")
    give(m, Blank(axis, corner(m, words)))


@FUNCTIONS("BLK FORM 0.2,", "Blank: greatest corner", takes="X Y Z", source="4.11, example")
def greatest_corner(m: Machine, words: Words) -> None:
    """The corner with the greatest coordinates; IX IY IZ count from the least corner."""
    blank = half_given(m)
    if blank is None:
        m.alarm("BLK FORM 0.2 needs BLK FORM 0.1 before it", first(words))
    greatest = corner(m, words, blank.minimum)
    for axis, low, high in zip("XYZ", blank.minimum, greatest, strict=True):
        if not high > low:
            least, found = (in_units(m, words[axis], at) for at in (low, high))
            m.alarm(f"BLK FORM 0.2 {axis} (greatest corner) must be greater than {least:g}, got {found:g}", words[axis])
    give(m, blank._replace(maximum=greatest))


def corner(m: Machine, words: Words, least: Corner | None = None) -> Corner:
    for axis in "XYZ":
        what = f"{words.code} {axis} (coordinate of the corner)"
        if axis not in words:
            m.alarm(f"{what} is missing", first(words))
        if words[axis].incremental and least is None:
            m.alarm(f"{what} must be absolute", words[axis])
    x, y, z = (counted(m, words[axis], at) for axis, at in zip("XYZ", least or (0.0, 0.0, 0.0), strict=True))
    return x, y, z


@FUNCTIONS(
    "BLK FORM CYLINDER,", "Blank: cylinder", takes="axis R D L DIST RI DI", source="Klartext, not described"
)  # fmt: skip
def round_blank(m: Machine, words: Words) -> None:
    """A cylinder about an axis through the datum, its front face DIST before it; with RI or DI a tube."""
    axis = rotary_axis(m, words, "Z R50 L105 DIST+5 RI10")
    if moved := next((word for word in words.words if word.incremental), None):
        m.alarm(f"{words.code} I{moved.address} must be absolute", moved)
    radius = radius_of(m, words, "R", "D", "of the cylinder")
    if radius is None:
        m.alarm(f"{words.code} needs R (radius) or D (diameter)", words["axis"])
    bore = radius_of(m, words, "RI", "DI", "of the bore")
    if bore is not None and bore >= radius:
        word = words.get("RI", words.get("DI"))
        sizes = f"radius {bore / m.variable_unit:g} in {radius / m.variable_unit:g}"
        m.alarm(f"{words.code}: the bore must be smaller than the cylinder, {sizes}", word)
    if "L" not in words:
        m.alarm(f"{words.code} needs L (length)", words["axis"])
    length = above_zero(m, words["L"], f"{words.code} L (length)")
    front = m.value(words["DIST"]) if "DIST" in words else 0.0
    give(m, cylinder(radius, front - length, front, axis, bore=bore or 0.0))


def radius_of(m: Machine, words: Words, radius: str, diameter: str, meaning: str) -> float | None:
    """What is written as a radius or as a diameter, mm; None where neither is."""
    if radius in words and diameter in words:
        m.alarm(f"{words.code} takes {radius} or {diameter}, not both", words[diameter])
    check = not_negative if radius == "RI" else above_zero
    if radius in words:
        return check(m, words[radius], f"{words.code} {radius} (radius {meaning})")
    if diameter in words:
        return check(m, words[diameter], f"{words.code} {diameter} (diameter {meaning})") / 2
    return None


@FUNCTIONS(
    "BLK FORM ROTATION,", "Blank: turned body", takes="axis DIM label", source="Klartext, not described"
)  # fmt: skip
def turned_blank(m: Machine, words: Words) -> None:
    """A body about Z, whose half section is the closed contour of a label in Z and X; X is the radius or the diameter."""
    if (axis := rotary_axis(m, words, "Z DIM_R LBL 1")) != "Z":
        m.alarm(f"BLK FORM ROTATION {axis}: a turned blank is built about Z alone", words["axis"])
    word = words["label"]
    m.flow.ask(word.value)
    name = label_name(m, word)
    with m.within(plane="ZX"):
        recording = m.record(name, m.span_of(word))
    give(m, TurnedBlank((section(m, name, word, recording.path, words["DIM"].value == "D"),)))


def section(m: Machine, name: str, word: Word, path: Toolpath, diameters: bool) -> Contour:
    """The half section (z, r), counter-clockwise, of the contour that a label describes."""
    what = f"BLK FORM ROTATION: the contour of label {name}"
    if len(path) and (np.ptp(path.end[:, 1]) > CLOSED or (abs(path.axis[:, 1]) < 0.5)[path.is_motion].any()):
        m.alarm(f"{what} must lie in Z and X", word)
    if not len(path) or np.abs(path.end[-1] - path.start[0]).max() > CLOSED:
        m.alarm(f"{what} must be closed: its end is where it begins", word)
    found = outline(path)
    if diameters:
        if found.bulge.any():
            m.alarm(f"{what} has arcs, which are not built for diameters (DIM_D)", word, "write it with DIM_R")
        found = Contour(found.points * (1, 0.5))
    if found.bounds[0, 1] < -AXIS:
        m.alarm(f"{what} has a negative X", word)
    if not abs(found.area) > AXIS:
        m.alarm(f"{what} encloses no area", word)
    try:
        Region.of(found)
    except ValueError as error:
        m.alarm(f"{what} is no area: {error}", word)
    return found if found.area > 0 else found.reversed()
