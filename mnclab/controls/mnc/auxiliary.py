"""Tool and spindle (MNC 1.2, 5, 7, 9), and what is as on other controls; some M functions only ISO 6983 explains."""

from __future__ import annotations

from mnclab.controls.mnc.state import memory
from mnclab.controls.word_address import motion
from mnclab.controls.word_address.functions import SPINDLE, functions
from mnclab.controls.word_address.motion import first_word, remark
from mnclab.machine.control import Words
from mnclab.machine.machine import Machine

ISO = "ISO 6983"
SUPERVISION = {"G25": "Spindle speed supervision off", "G26": "Spindle speed supervision on"}


def unlisted(m: Machine, words: Words, more: str = "") -> None:
    """Say that the manual knows nothing of this M function."""
    sentence = f"{words.code}: the manual does not list it; it is taken in its ISO meaning{more}"
    remark(m, "unlisted_m", sentence, first_word(words))


def remark_m(m: Machine, words: Words) -> None:
    """The manual lists all G functions."""
    if words.code[0] == "M":
        unlisted(m, words)


FUNCTIONS = functions(
    remark_m, ISO, plane="2.4", dimension="2.3", feed_mode="4.2", blending="3.5", compensation="6", cycle="9"
)


@FUNCTIONS("T", "Tool call", phase="tool", source="5.1")
def tool(m: Machine, words: Words) -> None:
    """The tool from the table is active at once, no axis moves; by the setting tool_change it waits for M6."""
    obey = motion.tool if m.settings["tool_change"] == "T" else motion.choose_tool
    obey(m, words)


FUNCTIONS("D", "Tool corrector", phase="corrector", source="1.2")(motion.corrector)


@FUNCTIONS("M6", "Tool change", phase="change", modal=False, source=ISO)
def tool_change(m: Machine, words: Words) -> None:
    """Nothing: T itself changes the tool (5.1); by the setting tool_change it puts the tool of T into the spindle."""
    if m.settings["tool_change"] == "T":
        unlisted(m, words, "; T itself changes the tool")
    else:
        motion.change_tool(m, words)


@FUNCTIONS("S", "Spindle speed", phase="spindle", source="1.2")
def spindle_speed(m: Machine, words: Words) -> None:
    """The speed of M3 and M4, kept while the spindle stands."""
    before = m.spindle_speed
    motion.spindle_speed(m, words)
    run_up(m, before)


@FUNCTIONS("M3 M4 M5", SPINDLE, group="spindle", phase="auxiliary", power_on="M5", source="9")
def spindle(m: Machine, words: Words) -> None:
    """M3 and M4 before the motion of the block, M5 after it; by the setting spindle_stop before it too."""
    before = m.spindle_speed
    if words.code == "M5" and m.settings["spindle_stop"] == "before":
        m.spindle(turning=0)
    else:
        motion.spindle(m, words)
    run_up(m, before)


@FUNCTIONS("G25 G26", SUPERVISION, group="supervision", phase="plane", power_on="G26", source="7")
def supervision(m: Machine, words: Words) -> None:
    """Whether the control waits until the spindle has its speed; a matter of time (setting spindle_run_up), not of the
    path."""


def run_up(m: Machine, before: float) -> None:
    """Wait once in a block that gives the turning spindle another speed or sense, if that is supervised."""
    if m.spindle_speed not in (0, before) and m.modal["supervision"] == "G26" and memory(m).run_up != m.step:
        memory(m).run_up = m.step
        m.dwell(m.settings["spindle_run_up"])
