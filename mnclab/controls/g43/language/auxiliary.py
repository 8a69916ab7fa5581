"""M functions: the oriented stop, spindle and coolant together, overrides, and those that only the maker of a machine knows."""

from __future__ import annotations

from mnclab.controls.g43.remarks import ISO
from mnclab.controls.word_address.motion import first_word
from mnclab.machine.control import FunctionTable, Words
from mnclab.machine.machine import Machine

FUNCTIONS = FunctionTable()
BOTH = {"M13": "Spindle on clockwise, coolant on", "M14": "Spindle on counter-clockwise, coolant on"}
OVERRIDES = {
    "M29": "Rigid tapping, as G84 always is here",
    "M48": "Overrides on", "M49": "Overrides off", "M50": "Feed override", "M51": "Spindle override",
    "M52": "Adaptive feed", "M53": "Feed stop",
}  # fmt: skip
SIGNALS = "M62 M63 M64 M65 M66 M67 M68 M190"


@FUNCTIONS("M13 M14", BOTH, group="spindle", phase="auxiliary", source=ISO)
def spindle_and_coolant(m: Machine, words: Words) -> None:
    """Before the motion of the block."""
    m.spindle(turning=1 if words.code == "M13" else -1)
    m.coolant()


@FUNCTIONS("M19", "Oriented spindle stop", group="spindle", phase="auxiliary", takes="R P Q", source=ISO)
def orient(m: Machine, words: Words) -> None:
    """At an angle of R or P degrees, 0 without; Q is how long the machine waits for it. On LinuxCNC R alone is the angle and P
    the direction: 0 the shorter way, 1 clockwise, 2 counter-clockwise."""
    if m.settings["dialect"] == "linuxcnc":
        angle, way, wait = (m.value(words[letter]) if letter in words else None for letter in "RPQ")
        if angle is not None and not 0 <= angle <= 360:
            m.alarm(f"M19 R (the angle of the spindle) must be 0 to 360, got {angle:g}", words["R"])
        if way is not None and way not in (0, 1, 2):
            m.alarm(f"M19 P (which way the spindle turns) must be 0, 1 or 2, got {way:g}", words["P"])
        if wait is not None and wait <= 0:
            m.alarm(f"M19 Q (how long the machine waits, s) must be greater than 0, got {wait:g}", words["Q"])
        m.orient(angle or 0.0)
        return
    if "R" in words and "P" in words:
        m.alarm("M19 has R and P in one block", words["P"], hint="keep one of them: the angle")
    word = words.get("R") or words.get("P")
    m.orient(m.value(word) if word else 0.0)


@FUNCTIONS("M60", "Pallet change and stop", phase="end", modal=False, source=ISO)
def pallet(m: Machine, words: Words) -> None:
    """Waits for the operator, after the motion of the block."""
    m.stop()


@FUNCTIONS(" ".join(OVERRIDES), OVERRIDES, phase="auxiliary", takes="P", modal=False, source="Fanuc, Haas, LinuxCNC")
def overrides(m: Machine, words: Words) -> None:
    """The path is the same: what the operator may turn at, and how a tap is held."""


@FUNCTIONS(SIGNALS, "Signals of the machine", phase="auxiliary", takes="P E L Q", modal=False, source="LinuxCNC")
@FUNCTIONS("M", "Function of the maker", phase="auxiliary", modal=False, source="the maker of the machine")
def makers(m: Machine, words: Words) -> None:
    """What it does, the maker of the machine says; here it moves nothing."""
    m.warn(f"{words.code} is a function of the machine's maker: here it moves nothing", first_word(words))


