"""Motion, G53 and G92, feed, dwell, exact stop and outside corners (MNC, chapters 1 to 4, 6 and 8)."""

from __future__ import annotations

import functools

import numpy as np

from mnclab.controls.word_address import motion
from mnclab.controls.word_address.functions import ARCS
from mnclab.controls.word_address.motion import AXES, first_word
from mnclab.controls.word_address.state import memory
from mnclab.geometry import frames
from mnclab.machine.control import Control, FunctionTable, Modal, Words
from mnclab.machine.machine import Machine
from mnclab.path.compensation import ACUTE, ROUND, STRAIGHT
from mnclab.text.alarm import Alarm
from mnclab.text.program import Word, digits

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
    return m.modal["dimension"] == "G90" or memory(m).machine_coordinates


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
