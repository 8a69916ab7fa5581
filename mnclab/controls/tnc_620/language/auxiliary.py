"""M functions of spindle, coolant and tool change (catalogue: M3 to M14)."""

from __future__ import annotations

from mnclab.machine.control import FunctionTable, Words
from mnclab.machine.machine import Machine

FUNCTIONS = FunctionTable()

TURNING = {"M3": "Spindle on clockwise", "M4": "Spindle on counter-clockwise"}
BOTH = {"M13": "Spindle on clockwise, coolant on", "M14": "Spindle on counter-clockwise, coolant on"}


@FUNCTIONS("M3 M4", TURNING, group="spindle", phase="start", source="M3")
def spindle_on(m: Machine, words: Words) -> None:
    """Before the motion of the block, at the speed of TOOL CALL."""
    m.spindle(turning=1 if words.code == "M3" else -1)


@FUNCTIONS("M5", "Spindle stop", group="spindle", phase="end", power_on="M5", source="M5")
def spindle_off(m: Machine, words: Words) -> None:
    """After the motion of the block."""
    m.spindle(turning=0)


@FUNCTIONS("M8", "Coolant on", group="coolant", phase="start", source="M8")
def coolant_on(m: Machine, words: Words) -> None:
    """Before the motion of the block."""
    m.coolant()


@FUNCTIONS("M9", "Coolant off", group="coolant", phase="end", power_on="M9", source="M9")
def coolant_off(m: Machine, words: Words) -> None:
    """After the motion of the block."""
    m.coolant()


@FUNCTIONS("M13 M14", BOTH, group="spindle", phase="start", source="M13")
def spindle_and_coolant(m: Machine, words: Words) -> None:
    """M3 or M4 together with M8."""
    m.spindle(turning=1 if words.code == "M13" else -1)
    m.coolant()
    m.set_modal("coolant", "M8")


@FUNCTIONS("M6", "Tool change", phase="end", modal=False, source="M6")
def tool_change(m: Machine, words: Words) -> None:
    """Nothing here: TOOL CALL changes the tool."""
