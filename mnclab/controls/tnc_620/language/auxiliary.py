"""What stands in a block beside its way: its feed, the M functions of the spindle, and positions that count from the machine."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from mnclab.controls.tnc_620.language.values import above_zero, in_units, one_of
from mnclab.controls.tnc_620.state import Place, memory
from mnclab.machine.axes import reference
from mnclab.machine.control import FunctionTable, Setting, Words
from mnclab.machine.coordinates import tool_axis
from mnclab.machine.machine import INF, Machine
from mnclab.path.feeds import FeedRule
from mnclab.text.program import Word

# Positions that count from the machine (M91, M92), and rotary axes within one turn (M94).

FUNCTIONS = FunctionTable()
MACHINE_TITLES = {"M91": "Machine coordinates", "M92": "Coordinates from a position of the machine tool builder"}


@FUNCTIONS("M91 M92", MACHINE_TITLES, group="machine datum", phase="start", modal=False, source="11.9")
def machine_datum(m: Machine, words: Words) -> None:
    """Positions of the block count from the machine datum or from the position of the settings, without tool length."""
    word, program = words.words[0], m.flow.program
    if program.keywords[program.keyword[m.flow.current]] != "L":
        m.alarm(f"{words.code} stands in a straight line L alone", word)
    if m.side:
        m.alarm(f"{words.code} cannot stand under radius compensation", word, "write R0 in the block before")
    x, y, z = (m.settings[f"m92_{axis}"] if words.code == "M92" else 0.0 for axis in "xyz")
    memory(m).machine_datum = word, (x, y, z)
    m.at_block_end(lambda: setattr(memory(m), "machine_datum", None))


def above_tip(m: Machine) -> Place:
    """From the tip to where X, Y and Z of the machine stand: the length of the tool, less what U, V and W carry."""
    u, v, w = memory(m).secondary
    above = [0.0 - u, 0.0 - v, 0.0 - w]
    above[tool_axis(m)] += m.tool.effective_length
    return above[0], above[1], above[2]


def machine_target(m: Machine, active: tuple[Word, Place], written: dict[int, Word]) -> dict[str, Any]:
    """The point of the program that the words of these axes mean under M91 or M92 (`active`)."""
    (word, datum), kinematics = active, m.tables.kinematics
    here, above = (reference(m), (0.0, 0.0, 0.0)) if kinematics is not None else (m.tip, above_tip(m))
    target = list(here)
    for axis, coordinate in written.items():
        value = m.value(coordinate)
        target[axis] = target[axis] + value if coordinate.incremental else datum[axis] + value - above[axis]
    if kinematics is not None:
        target = kinematics.tips(np.array(target), np.array(m.rotary), m.tool.effective_length).tolist()
    if m.side:
        m.alarm(f"{word} cannot begin radius compensation", word, "write RL or RR in the block after")
    point = m.to_program(target)
    return {"xyz"[axis]: point[axis] for axis in (written if m.shift is not None and kinematics is None else range(3))}


NOISE = 1e-12  # turns, of an angle that is 0


@FUNCTIONS("M94", "Rotary axes within one turn", takes="M94:A M94:B M94:C", phase="start", modal=False, source="11.9")
def within_one_turn(m: Machine, words: Words) -> None:
    """The named rotary axes, or all, show an angle from 0 to less than 360 degrees; nothing moves. One whose limits do not
    allow that angle stays as it is."""
    named = [word for word in words.words if word.address.startswith("M94:")]
    for word in named:
        if word.value is not None:
            m.alarm(f"M94 names an axis without a number, got {word.address[4:]}{m.value(word):g}", word)
    axes, stand = "".join(word.address[4:] for word in named) or "ABC", list(m.rotary)
    limits = {axis.name: axis.limits for axis in m.tables.kinematics.sequence} if m.tables.kinematics is not None else {}
    for k, axis in enumerate("ABC"):
        low, high = limits.get(axis, (-INF, INF))
        shown = stand[k] - math.tau * math.floor(stand[k] / math.tau + NOISE)
        if axis in axes and low <= math.degrees(shown) <= high:
            stand[k] = shown
    m.change("rotary", tuple(stand))


# The feed of a block in all its forms: F, FMAX, FAUTO, FU, FZ, and M103, M109 to M111 (3.1; catalogue: F, TOOL CALL, M103).
# In a program in inches F counts tenths of an inch a minute (setting "inch_feed"), as the posts for these controls write it.
# FU is a feed per revolution and FZ one per tooth, in inches there; both follow the speed of the spindle. Where a cycle is
# defined they become mm/min with the speed and the tool of that moment, as FAUTO does; FMAX stays a word.

SETTINGS = (
    Setting(
        "inch_feed", "tenth", "what F counts in where the program is in inches", "HEIDENHAIN: F in 0.1 inch/min",
        {"tenth": "tenths of an inch a minute: F100 is 254 mm/min", "inch": "inches a minute"},
    ),
)  # fmt: skip
FEED_WORDS = "F FMAX FAUTO FU FZ"
MEANINGS = {"F": "feed rate", "FU": "feed per revolution", "FZ": "feed per tooth"}
EDGES = {"M109": "everywhere", "M110": "inside", "M111": ""}
TITLES = {
    "M109": "Constant feed at the cutting edge on arcs", "M110": "Constant feed at the edge, reduction only",
    "M111": "End of M109 and M110",
}  # fmt: skip


def feed(m: Machine, words: Words) -> float | None:
    """Set the feed of this and the following blocks; inf for FMAX, which counts in its block alone."""
    word = one_of(m, words, FEED_WORDS.split(), "one feed")
    if word is None or m.unheard:  # a contour has no feed of its own (10.1)
        return None
    if word.address == "FMAX":
        return INF
    memory(m).feed_per_tooth = None
    if word.address == "FAUTO":
        set_feed(m, auto_feed(m, word))
        return None
    name = f"{word.address} ({MEANINGS[word.address]})"
    value = above_zero(m, word, name) if word.address != "F" else rate(m, word, name)
    if word.address == "FZ":
        memory(m).feed_per_tooth = value
        value *= teeth(m, word)
    set_feed(m, value, per_rev=word.address != "F")
    return None


def rate(m: Machine, word: Word, name: str) -> float:
    """The number of an F, mm/min."""
    return above_zero(m, word, name) * m.feed_unit


def set_feed(m: Machine, value: float | None, per_rev: bool = False) -> None:
    """The feed from now on, mm/min or mm/rev."""
    m.change("per_rev", per_rev)
    m.change("feed", value)


def teeth(m: Machine, word: Word) -> int:
    if m.tool.teeth <= 0:
        found = word if isinstance(word.value, str) else f"{word.address}{in_units(m, word, m.value(word)):g}"
        m.alarm(f"{found} needs the number of teeth of tool {m.tool.number} (column CUT of the tool table)", word)
    return m.tool.teeth


def with_another_tool(m: Machine) -> None:
    """A feed per tooth goes on with the teeth of the new tool; with none there is no feed until one is written."""
    if (per_tooth := memory(m).feed_per_tooth) is not None:
        set_feed(m, per_tooth * m.tool.teeth if m.tool.teeth > 0 else None, per_rev=True)


def auto_feed(m: Machine, word: Word) -> float:
    value = memory(m).auto_feed
    if value is None:
        m.alarm("FAUTO needs a feed in the TOOL CALL block", word, hint="write TOOL CALL … F500")
    return value


def named(m: Machine, word: Word) -> float | str:
    """A feed written in place of the number of a cycle: mm/min where it is defined (3.1); FMAX stays a word."""
    text = str(word.value)
    if text == "FAUTO":
        return auto_feed(m, word)
    if not text.startswith(("FU", "FZ")):
        return text
    per, value = text[:2], float(text[2:]) * m.variable_unit
    if value <= 0:
        m.alarm(f"{word.address}={per} ({MEANINGS[per]}) must be greater than 0, got {value:g}", word)
    if m.speed <= 0:
        m.alarm(f"{word} needs a spindle speed", word, hint="write S in the TOOL CALL block before the definition")
    return value * m.speed * (teeth(m, word) if per == "FZ" else 1)


def from_here(m: Machine, **changed: Any) -> None:
    """Another rule from this block on, in a new list: a recorded label leaves the old one."""
    last = m.feed_rules[-1] if m.feed_rules else FeedRule(0)
    m.feed_rules = [*m.feed_rules, last._replace(step=m.step, **changed)]


@FUNCTIONS("M103", "Feed factor of plunging moves", takes="M103:F", phase="start", source="3.4")
def plunging(m: Machine, words: Words) -> None:
    """M103 F20: no faster downwards than 20 % of the feed, from this block on; without F the feed is as programmed."""
    share = 100.0
    if (word := words.get("M103:F")) is not None:
        if word.value is None:
            m.alarm("M103 F needs a number", word, hint="for example M103 F20: 20 percent")
        share = above_zero(m, word, "M103 F (percent of the feed downwards)")
    from_here(m, plunging=share / 100)


@FUNCTIONS("M109 M110 M111", TITLES, group="edge feed", phase="start", power_on="M111", source="8.6")
def edge_feed(m: Machine, words: Words) -> None:
    """From this block on the feed of compensated arcs counts at the edge (M110: only where that is slower), or at the centre."""
    from_here(m, edge=EDGES[words.code])


# M functions of spindle, coolant and tool change (catalogue: M3 to M20, M118).

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
