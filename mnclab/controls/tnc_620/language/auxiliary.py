"""M functions of spindle, coolant and tool change (catalogue: M3 to M20, M118)."""

from __future__ import annotations

from mnclab.controls.tnc_620.state import memory
from mnclab.machine.control import FunctionTable, Words
from mnclab.machine.machine import Machine

FUNCTIONS = FunctionTable()
TURNING = {"M3": "Spindle on clockwise", "M4": "Spindle on counter-clockwise"}
COOLANT = {"M7": "Second coolant on", "M8": "Coolant on"}
BOTH = {"M13": "Spindle on clockwise, coolant on", "M14": "Spindle on counter-clockwise, coolant on"}


@FUNCTIONS("M3 M4 M13 M14", TURNING | BOTH, group="spindle", phase="start", source="4.11, example")
def spindle_on(m: Machine, words: Words) -> None:
    """Before the motion of the block, at the speed of TOOL CALL; M13 and M14 together with M8."""
    m.spindle(turning=1 if words.code in ("M3", "M13") else -1)
    if words.code in BOTH:
        m.coolant()
        m.set_modal("coolant", "M8")


@FUNCTIONS("M5", "Spindle stop", group="spindle", phase="end", power_on="M5", source="12.9")
def spindle_off(m: Machine, words: Words) -> None:
    """After the motion of the block."""
    m.spindle(turning=0)


@FUNCTIONS("M9", "Coolant off", group="coolant", phase="end", power_on="M9", source="4.4")
@FUNCTIONS("M7 M8", COOLANT, group="coolant", phase="start", source="4.5")
def coolant(m: Machine, words: Words) -> None:
    """On before the motion of the block, off after it; what M7 switches is up to the machine."""
    m.coolant()


@FUNCTIONS("M6", "Tool change", phase="end", modal=False, source="5.11, example")
def tool_change(m: Machine, words: Words) -> None:
    """After the motion of the block the spindle stops, and with the setting "m6_stop" the program; TOOL CALL names the tool."""
    m.spindle(turning=0)
    m.set_modal("spindle", "M5")
    if m.settings["m6_stop"]:
        m.stop()


@FUNCTIONS("M19 M20", "Oriented spindle stop", group="spindle", phase="start", modal=False, source="12.4")
def orient(m: Machine, words: Words) -> None:
    """Before the motion of the block the spindle turns to the angle of Cycle 13, without it to that of the machine."""
    angle = memory(m).orientation
    m.orient(m.settings["spindle_angle"] if angle is None else angle)
    m.set_modal("spindle", "M5")


@FUNCTIONS("M118", "Handwheel superimposition", takes="M118:X M118:Y M118:Z M118:A M118:B M118:C", source="1.2")
def handwheel(m: Machine, words: Words) -> None:
    """Nothing moves: there is no handwheel whose steps could be added."""
    m.warn("M118 changes nothing here: there is no handwheel", words.words[0])
