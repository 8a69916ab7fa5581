"""Begin and end of a program, stops (catalogue: BEGIN PGM, END PGM, STOP, M0 to M30)."""

from __future__ import annotations

from mnclab.controls.tnc_620.cycles.chain import cancel
from mnclab.controls.tnc_620.language import parameters
from mnclab.controls.tnc_620.language.blank import half_given
from mnclab.controls.tnc_620.language.checks import not_negative
from mnclab.controls.tnc_620.reading.words import INCH
from mnclab.controls.tnc_620.state import count_in, memory
from mnclab.controls.tnc_620.tables.free_tables import put_out_tables
from mnclab.machine.control import FunctionTable, Words
from mnclab.machine.machine import Machine
from mnclab.machine.setup import Datum
from mnclab.running.cycles import perform
from mnclab.running.flow import course

FUNCTIONS = FunctionTable()
STOPS = {"M0": "Program stop", "M1": "Optional stop"}

def start(m: Machine) -> None:
    """The active preset is the datum of the program (setting "preset")."""
    row = m.settings["preset"]
    preset = m.tables.presets.get(row, Datum())
    m.select_datum(preset, "preset")
    parameters.start(m)


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
        m.dwell(not_negative(m, words["TIME"], "FUNCTION DWELL TIME (seconds)"))
        return
    turns = not_negative(m, words["REV"], "FUNCTION DWELL REV (turns of the spindle)")
    if not m.spindle_speed:
        m.alarm("FUNCTION DWELL REV needs a turning spindle", words["REV"], m.control.to_turn)
    m.dwell(turns * 60 / abs(m.spindle_speed))


@FUNCTIONS("FUNCTION RESET TCPM,", "End of TCPM", source="Klartext, not described")
def reset_tcpm(m: Machine, words: Words) -> None:
    """TCPM is refused where it begins: there is nothing to end."""


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
