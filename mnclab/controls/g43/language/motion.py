"""Motion, dwell, feed and spindle; planes, dimensions and the like are those of all controls of G words."""

from __future__ import annotations

from mnclab.controls.g43.language import polar, rotary
from mnclab.controls.g43.language.lengths import activate, pending
from mnclab.controls.g43.language.numbers import seconds_of_p, whole
from mnclab.controls.g43.language.transformations import settle_doubt
from mnclab.controls.g43.remarks import ISO, silent, undescribed
from mnclab.controls.g43.state import memory
from mnclab.controls.word_address import motion
from mnclab.controls.word_address.functions import ARCS, SPINDLE
from mnclab.controls.word_address.motion import AXES, CENTRE, first_word
from mnclab.machine.control import Control, FunctionTable, Modal, Words
from mnclab.machine.coordinates import PLANES
from mnclab.machine.machine import Machine
from mnclab.text.alarm import Alarm
from mnclab.text.program import Word, digits

FUNCTIONS = FunctionTable()
LENGTHS = ("G43", "G44", "G49")
AXIS_WORDS = "X Y Z A B C"
MOST_TURNS = 10_000


def together(control: Control, modal: Modal, keyword: str, words: list[Word]) -> None:
    """The length compensation needs a straight motion; R beside a line is no corner; a unit has no contour."""
    codes = {f"G{digits(word.value)}": word for word in words if word.address == "G" and type(word.value) is float}
    axes = [word for word in words if word.address in AXES]
    if axes and (spline := {"G5", "G5.1"} & codes.keys()):
        sentence = f"{min(spline)} stands in a block without motion, {axes[0].rounded} does not belong to it"
        hint = "write two blocks; the splines of LinuxCNC are not built: write lines or arcs"
        raise Alarm(sentence, axes[0].span, hint=hint)
    contour = next((word for word in words if word.address in ("P", "Q")), None)
    if contour and len(codes) == 1 and (lathe := {"G70", "G71"} & codes.keys()):
        hint = "a program of a lathe; write G20 or G21 for the unit, and the motion itself"
        raise Alarm(f"{min(lathe)} {contour.rounded} is a contour cycle of a lathe", codes[min(lathe)].span, hint=hint)
    arcs = [code for code in ARCS if code in codes] or [code for code in ARCS if modal.motion == code and axes]
    for code in LENGTHS:
        if code in codes and arcs and not {"G0", "G1"} & codes.keys():
            message = f"{code} needs a straight motion, got {arcs[0]} in its block"
            raise Alarm(message, codes[code].span, hint="write two blocks")
    radius, straight = next((word for word in words if word.address == "R"), None), {"G0", "G1"} & codes.keys()
    if radius and axes and not keyword and (straight or not codes and modal.motion in ("G0", "G1") and not modal.active):
        hint = f"a rounding of the corner is ,{radius}, a chamfer ,C"
        raise Alarm(f"{radius} has no meaning in a straight line", radius.span, hint=hint)


def targets(m: Machine, words: Words) -> dict[str, float]:
    """Where the axes that are written go; their offsets count from now on."""
    kept = memory(m)
    if kept.polar is not None and not kept.machine_coordinates:
        to = polar.targets(m, words)
    else:
        to = motion.coordinates(m, words, m.modal["dimension"] == "G90" or kept.machine_coordinates)
    if to and not kept.machine_coordinates:
        activate(m, "".join(to).upper())
        if kept.doubt is not None:
            settle_doubt(m, words, to)
    return to


def is_plain(m: Machine) -> bool:
    """Whether plain words mean plain motion."""
    kept = memory(m)
    special = kept.polar is not None or kept.doubt is not None or kept.absolute_centres or kept.outlived or m.per_time
    return not (special or pending(m)) and silent(m, "G2", "G3")


@FUNCTIONS("G0", "Rapid positioning", group="motion", takes=AXIS_WORDS, power_on="G0", moves=True, source="7.1, example")
def rapid(m: Machine, words: Words) -> None:
    """All axes at their greatest speed."""
    rotary.go(m, targets(m, words), rotary.angles_of(m, words), rapid=True)


@FUNCTIONS("G1", "Linear interpolation", group="motion", takes=AXIS_WORDS, moves=True, source="7.1, example")
def line(m: Machine, words: Words) -> None:
    """A straight line at feed F; in machine coordinates (G53) at rapid, unless the setting g53_motion says otherwise."""
    at_rapid = memory(m).machine_coordinates and m.settings["g53_motion"] == "rapid"
    rotary.go(m, targets(m, words), rotary.angles_of(m, words), at_rapid, first_word(words))


@FUNCTIONS("G2 G3", ARCS, group="motion", takes="X Y Z I J K R P", moves=True, source=ISO)
def arc(m: Machine, words: Words) -> None:
    """An arc by R (negative: above 180 degrees) or by I J K from the start (after G90.1 from the origin); P counts turns.

    A 0 along the axis of the arc, which some post-processors write, changes nothing.
    """
    undescribed(m, words)
    along = CENTRE[PLANES[m.plane][2]]
    if along in words and m.value(words[along]) == 0:
        words = Words(tuple(word for word in words.words if word.address != along), words.code)
    kept = memory(m)
    if kept.machine_coordinates:
        m.alarm(f"{words.code} and G53 stand in one block: an arc counts from the workpiece", first_word(words))
    to = targets(m, words)
    centre = next((words[c] for c in CENTRE if c in words), None)
    if kept.polar is not None and centre is not None:
        m.alarm(f"{centre} stands under polar coordinates: an arc needs R there", centre)
    turns = whole(m, words, "P", 1, MOST_TURNS) if "P" in words else 1
    sense = -1 if words.code == "G2" else 1
    motion.arc_to(m, words, to, sense, absolute_centre=kept.absolute_centres, turns=turns)


@FUNCTIONS("G4", "Dwell", phase="dwell", takes="P X", still=True, modal=False, source=ISO)
def dwell(m: Machine, words: Words) -> None:
    """A pause of X seconds, or of P as the setting dwell_p has it."""
    undescribed(m, words)
    if len(words.words) != 2:
        m.alarm("G4 needs P or X, the time", first_word(words))
    word = words.words[1]
    value = m.value(word)
    if not 0 <= value <= 1e6:
        m.alarm(f"G4 {word.address} (dwell) must be at least 0 and at most 1e+06, got {value:g}", word)
    m.dwell(value if word.address == "X" else value * seconds_of_p(m, word))


@FUNCTIONS("F", "Feed", phase="feed", source="7.1, example")
def feed(m: Machine, words: Words) -> None:
    """F: the feed along the path; under G93 how many times a minute the move of this block could be made."""
    if not m.per_time:
        motion.feed(m, words)
        return
    value = m.value(words["F"])
    if value <= 0:
        m.alarm(f"F (moves a minute) must be greater than 0, got {value:g}", words["F"])
    m.change("feed", 60 / value)
    m.at_block_end(lambda: m.change("feed", None))


FUNCTIONS("S", "Spindle speed", phase="spindle", source=ISO)(motion.spindle_speed)
FUNCTIONS("M3 M4 M5", SPINDLE, group="spindle", phase="auxiliary", power_on="M5", source=ISO)(motion.spindle)
