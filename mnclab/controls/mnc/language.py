"""The words of the MNC without cycles: motion, G53 and G92, feed, dwell, exact stop, corners, tool and spindle."""

from __future__ import annotations

import functools
from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np

from mnclab.controls.word_address import motion
from mnclab.controls.word_address.motion import ARCS, AXES, SPINDLE, first_word, functions, remark
from mnclab.controls.word_address.motion import memory as motion_memory
from mnclab.geometry import frames
from mnclab.machine.control import Control, FunctionTable, Modal, Words
from mnclab.machine.machine import Machine
from mnclab.path.compensation import ACUTE, ROUND, STRAIGHT
from mnclab.text.alarm import Alarm
from mnclab.text.program import Word, digits

# What the MNC keeps beside the common state of a machine.

class PolarPosition(NamedTuple):
    """The last polar position: radius, mm, and angle, degrees, about the pole; and the point that it is."""

    radius: float
    angle: float
    place: tuple[float, float, float]


@dataclass
class Memory(motion.Memory):
    """Of the MNC."""

    polar: PolarPosition | None = None  # while a pole is active
    run_up: int = -1  # the step that last waited for the spindle
    base_rotation: float = 0.0  # degrees, counter-clockwise
    laser: dict[str, float] = field(default_factory=dict)  # what calibrations found of the tool setter
    angled: frozenset[int] = frozenset()  # rows of the datum table that hold an angle


memory = Memory.of


# Tool and spindle (MNC 1.2, 5, 7, 9), and what is as on other controls; some M functions only ISO 6983 explains.

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


AUXILIARY = functions(
    remark_m, ISO, plane="2.4", dimension="2.3", feed_mode="4.2", blending="3.5", compensation="6", cycle="9"
)


@AUXILIARY("T", "Tool call", phase="tool", source="5.1")
def tool(m: Machine, words: Words) -> None:
    """The tool from the table is active at once, no axis moves; by the setting tool_change it waits for M6."""
    obey = motion.tool if m.settings["tool_change"] == "T" else motion.choose_tool
    obey(m, words)


AUXILIARY("D", "Tool corrector", phase="corrector", source="1.2")(motion.corrector)


@AUXILIARY("M6", "Tool change", phase="change", modal=False, source=ISO)
def tool_change(m: Machine, words: Words) -> None:
    """Nothing: T itself changes the tool (5.1); by the setting tool_change it puts the tool of T into the spindle."""
    if m.settings["tool_change"] == "T":
        unlisted(m, words, "; T itself changes the tool")
    else:
        motion.change_tool(m, words)


@AUXILIARY("S", "Spindle speed", phase="spindle", source="1.2")
def spindle_speed(m: Machine, words: Words) -> None:
    """The speed of M3 and M4, kept while the spindle stands."""
    before = m.spindle_speed
    motion.spindle_speed(m, words)
    run_up(m, before)


@AUXILIARY("M3 M4 M5", SPINDLE, group="spindle", phase="auxiliary", power_on="M5", source="9")
def spindle(m: Machine, words: Words) -> None:
    """M3 and M4 before the motion of the block, M5 after it; by the setting spindle_stop before it too."""
    before = m.spindle_speed
    if words.code == "M5" and m.settings["spindle_stop"] == "before":
        m.spindle(turning=0)
    else:
        motion.spindle(m, words)
    run_up(m, before)


@AUXILIARY("G25 G26", SUPERVISION, group="supervision", phase="plane", power_on="G26", source="7")
def supervision(m: Machine, words: Words) -> None:
    """Whether the control waits until the spindle has its speed; a matter of time (setting spindle_run_up), not of the
    path."""


def run_up(m: Machine, before: float) -> None:
    """Wait once in a block that gives the turning spindle another speed or sense, if that is supervised."""
    if m.spindle_speed not in (0, before) and m.modal["supervision"] == "G26" and memory(m).run_up != m.step:
        memory(m).run_up = m.step
        m.dwell(m.settings["spindle_run_up"])


# Motion, G53 and G92, feed, dwell, exact stop and outside corners (MNC, chapters 1 to 4, 6 and 8).

FUNCTIONS = FunctionTable()
OFFSETS = ("datum", "base rotation", "local")  # frames that belong to the datum: G53 leaves them
CORNERS = {"G160": ROUND, "G161": STRAIGHT, "G162": ACUTE}
SHAPES = {"G160": "arc", "G161": "straight", "G162": "arc at acute corners only"}
CORNER_TITLES = {code: f"Outside corners: {shape}" for code, shape in SHAPES.items()}


def together(control: Control, modal: Modal, keyword: str, words: list[Word]) -> None:
    """Alarms for G functions that may not stand in one block (1.6, 2.6, 2.8.5, MNC-MILL-CALL, MNC-PROBE-GROUP)."""
    codes = {f"G{digits(word.value)}": word for word in words if word.address == "G" and type(word.value) is float}
    if modal.polar and len(codes) > 1:
        message = "more than one G function stands in a block while polar coordinates are active"
        raise Alarm(message, [*codes.values()][1].span, hint="write two blocks, or G15 first")
    own = next((code for code in codes if code in control.cycles and control.cycles[code].runs == "definition"), "")
    for code, word in codes.items():
        if own and code in control.functions and control.functions[code].moves:
            message = f"{own} runs in a block of its own, {word} does not belong to it"
            raise Alarm(message, word.span, hint="write two blocks")
        if "G53" in codes and code in control.functions and control.functions[code].still:
            message = f"{code} stands in a block without motion, G53 in one with motion"
            raise Alarm(message, word.span, hint="write two blocks")


def power_on(m: Machine) -> None:
    """The functions that settings put in the place of those of the table at power-on."""
    for name, code in m.settings.items():
        if name.startswith("power_on_"):
            function = m.control.functions[code]
            m.set_modal(str(function.group), code)
            function.obey(m, Words((), code))
    corners = m.modal["corners"]
    m.control.functions[corners].obey(m, Words((), corners))  # the setting outside_corners may say otherwise


def absolute(m: Machine) -> bool:
    """Whether coordinates are absolute: G90, and always in a block with G53 (MNC-G53-G91)."""
    return m.modal["dimension"] == "G90" or motion_memory(m).machine_coordinates


@FUNCTIONS("G0", "Rapid positioning", group="motion", takes="X Y Z", power_on="G0", moves=True, source="3.1")
def rapid(m: Machine, words: Words) -> None:
    """All axes at their greatest speed; F is kept."""
    if to := motion.coordinates(m, words, absolute(m)):
        m.rapid(**to)


@FUNCTIONS("G1", "Linear interpolation", group="motion", takes="X Y Z", moves=True, source="3.2")
def line(m: Machine, words: Words) -> None:
    """A straight line at feed F."""
    if to := motion.coordinates(m, words, absolute(m)):
        m.line(**to, word=first_word(words))


@FUNCTIONS("G2 G3", ARCS, group="motion", takes="X Y Z I J K R", moves=True, source="3.4")
def arc(m: Machine, words: Words) -> None:
    """An arc by R (negative: above 180 degrees) or I J K from the start; without either a straight line."""
    motion.arc(m, words, -1 if words.code == "G2" else 1, absolute(m), line_without_centre=True)


@FUNCTIONS("G53", "Machine coordinates", group="datum", phase="frames", power_on="G53", modal=False, source="2.6")
def machine_coordinates(m: Machine, words: Words) -> None:
    """In this block only, work offset and G92 count as zero; active at power-on until a work offset is selected."""
    transformed = m.settings["g53_transformed"]
    if m.side and not (transformed and m.settings["g53_tool_length"]):
        fault = "G53 without the corrections cannot stand under radius compensation"
        m.alarm(fault, first_word(words), hint="write G40 first")
    motion.leave_frames(m, [name for name, _ in m.frames if name in OFFSETS or not transformed])
    if not m.settings["g53_tool_length"]:  # Z is the spindle reference, above the tip by the length
        m.set_frame("local", frames.shift(z=-m.tool.effective_length))


@FUNCTIONS("G92", "Set position", phase="local", takes="X Y Z U V W", still=True, modal=False, source="2.5")
def set_position(m: Machine, words: Words) -> None:
    """The present point gets the coordinates X Y Z; U V W move the origin by that much. No motion."""
    motion.uncompensated(m, words)
    point, local = list(m.programmed), m.frames["local"][:3, 3]
    transformations = [frame for name, frame in m.frames if name not in OFFSETS]
    inner = functools.reduce(np.matmul, transformations, frames.IDENTITY)
    if not np.array_equal(inner, frames.IDENTITY):
        m.warn("G92 under scaling, mirror image or rotation: its values are programmed coordinates", first_word(words))
    for k, (axis, increment) in enumerate(zip(AXES, "UVW", strict=True)):
        if axis in words and increment in words:
            m.alarm(f"{axis} and {increment} stand in one G92 block", words[increment], hint="keep one of them")
        if axis in words:
            point[k] = m.value(words[axis])
        elif increment in words:
            point[k] += m.value(words[increment]) * (1 if m.settings["g92_increment"] == "add" else -1)
    # shift = tip - datum, turned back by the base rotation, - q(p), for the axes written (2.5, MNC-G92-XFORM, "base rotation")
    outer = m.frames["datum"] @ m.frames["base rotation"]
    shift = frames.apply(frames.inverse(outer), m.tip) - frames.apply(inner, point)
    written = [axis in words or increment in words for axis, increment in zip(AXES, "UVW", strict=True)]
    m.set_frame("local", frames.shift(*np.where(written, shift, local)), keep="programmed")
    m.set_register(point)  # exactly as written


FUNCTIONS("F", "Feed", phase="feed", source="4.1")(motion.feed)


@FUNCTIONS("G4", "Dwell", group="dwell", phase="dwell", takes="P", still=True, modal=False, source="8")
def dwell(m: Machine, words: Words) -> None:
    """A pause of P seconds, in steps of 0.01 s."""
    if "P" not in words:
        m.alarm("G4 P (dwell) is missing", first_word(words))
    seconds = m.value(words["P"])
    if not 0.01 <= seconds <= 99999.999:
        m.alarm(f"G4 P (dwell) must be at least 0.01 and at most 99999.999 s, got {seconds:g}", words["P"])
    m.dwell(round(seconds, 2))


@FUNCTIONS("G9", "Exact stop in this block", group="dwell", phase="plane", modal=False, source="3.5.3")
def exact_stop_here(m: Machine, words: Words) -> None:
    """The motion of this block ends with exact positioning."""
    m.exact_here = True


@FUNCTIONS("G160 G161 G162", CORNER_TITLES, group="corners", phase="plane", power_on="G160", source="6.4")
def outside_corners(m: Machine, words: Words) -> None:
    """Round outside corners the tool centre runs on an arc of its radius, or to where both offsets meet.

    The corner before the block follows its rule, so that one in the block of G40 holds for the exit.
    """
    forced = str(m.settings["outside_corners"])
    m.change("corner_rule", CORNERS.get(forced, CORNERS[words.code]))
