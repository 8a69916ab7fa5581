"""FN 25: the program sets the datum of an axis (iTNC 530)."""

from __future__ import annotations

from mnclab.controls.tnc_620.state import active_preset, memory
from mnclab.machine.control import FunctionTable, Words
from mnclab.machine.machine import Machine
from mnclab.machine.setup import Datum

FUNCTIONS = FunctionTable()


@FUNCTIONS("FN 25,", "Preset", takes="axis first second", source="Klartext, not described")
def set_datum(m: Machine, words: Words) -> None:
    """PRESET = X/+100/+0: the point that has the coordinate 100 gets 0. The preset becomes row 0, the one set by hand."""
    axis = str(words["axis"].value)
    if axis not in "XYZ":
        m.alarm(f"FN 25: the axis {axis} is not built yet, X, Y and Z are", words["axis"])
    if m.side:
        m.alarm("FN 25 cannot set the datum under radius compensation", words["axis"], "write R0 before")
    if active := [name for name, _ in m.frames if name != "preset" and name in m.frames]:
        m.alarm(f"FN 25 cannot set the datum while a {active[0]} is active", words["axis"])
    by = (m.value(words["first"]) - m.value(words["second"])) * m.variable_unit
    before = m.tables.presets.get(active_preset(m), Datum())
    way = by * m.frames["preset"][:3, "XYZ".index(axis)]
    preset = before._replace(**{name: float(old + along) for name, old, along in zip("xyz", before, way)})
    m.write_table("presets", 0, preset)
    memory(m).preset = 0
    m.select_datum(preset, "preset")
