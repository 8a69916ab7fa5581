"""Scaling, mirror image and rotation (MNC 2.9), and the datum function G147 (2.10).

A programmed point is scaled about the origin, then mirrored, then turned, whatever the order of programming; then come the
local shift of G92 and the work offset. Switching moves nothing and keeps the programmed coordinates: the next motion
takes the whole programmed point through the new transformation, so that an axis which is not written may still move.
Settings: transformation_order, switch_keeps.
"""

from __future__ import annotations

import math

from mnclab.controls.mnc.state import memory
from mnclab.controls.word_address.motion import AXES, first_word, uncompensated
from mnclab.geometry import frames
from mnclab.machine.control import FunctionTable, Words
from mnclab.machine.coordinates import PLANES
from mnclab.machine.machine import Machine
from mnclab.machine.setup import Datum

FUNCTIONS = FunctionTable()
SCALING = {"G36": "Scaling off", "G37": "Scaling on"}
ROTATION = {"G38": "Rotation off", "G39": "Rotation on"}
MIRROR = {"G50": "Mirror image off", "G51": "Mirror image on"}
NORMAL = {"XY": ("z", 1), "ZX": ("y", 1), "XZ": ("y", -1), "YZ": ("x", 1)}  # and the sense from first to second axis


def axis_values(m: Machine, words: Words) -> dict[int, float]:
    """The axis words of a block by axis number; never incremental."""
    return {k: m.value(words[axis]) for k, axis in enumerate(AXES) if axis in words}


def switch(m: Machine, name: str, frame: frames.Matrix | None, words: Words) -> None:
    """Replace a transformation; the radius must not be compensated meanwhile."""
    uncompensated(m, words)
    if m.settings["transformation_order"] == "nested":
        m.frames.innermost(name)
    m.set_frame(name, frame, keep=m.settings["switch_keeps"])


@FUNCTIONS("G37", SCALING, group="scaling", phase="frames", takes="X Y Z", still=True, source="2.9.1")
def scaling(m: Machine, words: Words) -> None:
    """Factors of the axes about the origin, signs ignored; an axis not written has factor 1 (setting g37_omitted)."""
    factors = m.frames["scaling"].diagonal().tolist() if m.settings["g37_omitted"] == "kept" else [1.0, 1.0, 1.0, 1.0]
    for k, factor in axis_values(m, words).items():
        if factor == 0:
            m.alarm(f"G37 {AXES[k]} (scale factor) must not be 0", words[AXES[k]])
        factors[k] = abs(factor)
    switch(m, "scaling", frames.scale(*factors[:3]), words)


@FUNCTIONS("G51", MIRROR, group="mirror", phase="frames", takes="X Y Z", still=True, source="2.9.2")
def mirror(m: Machine, words: Words) -> None:
    """X Y Z are the lines to mirror about; an axis not written is not mirrored."""
    lines = axis_values(m, words)
    if not lines:
        m.warn("G51 without coordinates mirrors nothing", first_word(words))
    axes = "".join("xyz"[k] for k in lines)
    switch(m, "mirror", frames.mirror(axes, [lines.get(k, 0.0) for k in range(3)]), words)


@FUNCTIONS("G39", ROTATION, group="rotation", phase="frames", takes="X Y Z A", still=True, source="2.9.3")
def rotation(m: Machine, words: Words) -> None:
    """Turn the active plane by A degrees about a pole, the origin where it is not written."""
    if "A" not in words:
        m.alarm("G39 A (angle) is missing", first_word(words))
    normal = PLANES[m.plane][2]
    if AXES[normal] in words:
        m.alarm(f"{AXES[normal]} is no coordinate of the plane {m.plane}", words[AXES[normal]])
    pole = axis_values(m, words)
    axis, sense = NORMAL[m.plane]
    angle = sense * math.radians(m.value(words["A"]))
    switch(m, "rotation", frames.turn(angle, axis, [pole.get(k, 0.0) for k in range(3)]), words)


@FUNCTIONS("G50", MIRROR, group="mirror", phase="frames", power_on="G50", source="2.9")
@FUNCTIONS("G38", ROTATION, group="rotation", phase="frames", power_on="G38", source="2.9")
@FUNCTIONS("G36", SCALING, group="scaling", phase="frames", power_on="G36", source="2.9")
def transformation_off(m: Machine, words: Words) -> None:
    """No motion; the programmed coordinates stay."""
    switch(m, str(m.control.functions[words.code].group), None, words)


@FUNCTIONS("G54 G55 G56 G57 G58 G59", "Work offset", group="datum", phase="frames", source="2.7")
def work_offset(m: Machine, words: Words) -> None:
    """Rows 1 to 6 of the datum table; cancels G92. No motion."""
    select_row(m, int(words.code[1:]) - 53)


@FUNCTIONS("G147, G247", "Activate a datum", group="datum", phase="frames", takes="Q", source="2.10")
def activate_datum(m: Machine, words: Words) -> None:
    """Rows 1 to 6 of the datum table are G54 to G59; cancels G92. No motion."""
    if words.code == "G247":
        m.warn("G247 is another name of G147", first_word(words))
    if "Q" not in words:
        m.alarm(f"{words.code} Q (datum number) is missing", first_word(words))
    row = m.value(words["Q"])
    if row != int(row) or row < 1:
        m.alarm(f"{words.code} Q (datum number) must be a whole number from 1, got {row:g}", words["Q"])
    if row > m.settings["datum_rows"] and int(row) not in m.tables.datums:
        rows = ", ".join(map(str, sorted(m.tables.datums))) or "none beyond the six of G54 to G59"
        m.alarm(f"{words.code} Q{int(row)} has no row in the datum table", words["Q"], hint=f"rows: {rows}")
    select_row(m, int(row))


def select_row(m: Machine, row: int) -> None:
    """Count from a row of the datum table; the local shift of G92 is gone."""
    if "local" in m.frames:
        m.set_frame("local", None)
    m.log("datum row", row)
    datum = m.tables.datums.get(row, Datum())
    if datum.rotation or row in memory(m).angled:  # an empty cell keeps the base rotation (MNC-BASEROT-ROW)
        m.set_frame("base rotation", frames.turn(math.radians(datum.rotation)) if datum.rotation else None)
        memory(m).base_rotation = datum.rotation
    m.select_datum(datum._replace(rotation=0.0))
