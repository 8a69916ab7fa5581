"""Feed, spindle and auxiliary functions: F under G93 to G95, S under G96 and G97, M functions."""

from __future__ import annotations

from mnclab.controls.jnc_t01.state import memory
from mnclab.controls.word_address import functions, motion
from mnclab.controls.word_address.motion import first_word
from mnclab.machine.control import FunctionTable, Words
from mnclab.machine.machine import Machine
from mnclab.machine.rows import speed_at
from mnclab.text.program import Word

FUNCTIONS = FunctionTable()

FEEDS = {"G93": "Feed as time of the move, s"} | functions.FEEDS
SPEEDS = {"G96": "Constant cutting speed", "G97": "Constant spindle speed"}
TURNS = {"M3": "Spindle on, right", "M4": "Spindle on, left", "M5": "Spindle off"}
COOLANT = {"M7": "Coolant on", "M8": "Coolant off (table 3)", "M9": "Coolant off"}
OUTSIDE = {"N": "Foreign block number (setting foreign)", "%": "Foreign program start (setting foreign)"}


@FUNCTIONS("G90 G91", functions.DIMENSIONS, group="dimension", phase="modes", power_on="G90", source="8.14, 8.15")
def dimension(m: Machine, words: Words) -> None:
    """Coordinates from part zero, or distances from where the tool stands."""


@FUNCTIONS("G93 G94 G95", FEEDS, group="feed mode", phase="modes", power_on="G94", source="8.17 to 8.19")
def feed_mode(m: Machine, words: Words) -> None:
    """What F means: seconds for each move, mm/min, mm/rev. After a change a new F must follow."""
    mode = words.code == "G93", words.code == "G95"
    if mode != (m.per_time, m.per_rev):
        if m.feed is not None:
            memory(m).feed_ended_by = words.code
        m.change("feed", None)
        m.change("per_time", mode[0])
        m.change("per_rev", mode[1])


FUNCTIONS("F", "Feed", phase="feed", source="3, table 1")(motion.feed)


def cutting_feed(m: Machine, word: Word | None) -> float | None:
    """As `standing_feed`; an Alarm if there is no feed, no speed, or if a spindle that stands is to be refused."""
    need_cutting_speed(m)
    if (feed := standing_feed(m)) is not None:
        motion.remark(m, "stopped_spindle", f"G95: the spindle stands, the feed is that of {m.speed:g} rev/min", word)
        return feed
    if m.feed is None and (code := memory(m).feed_ended_by):
        sentence = f"no feed rate was programmed after {code}, which gives F another unit"
        m.alarm(sentence, word, "write F with a new value")
    m.feed_of(None, word)
    return None


def standing_feed(m: Machine) -> float | None:
    """None for the modal feed; under G95 with a spindle that stands, what the programmed speed would make of it."""
    if m.feed is None or not m.per_rev or m.turning or not m.speed:
        return None
    return m.feed * m.speed


@FUNCTIONS("G96 G97", SPEEDS, group="speed mode", phase="modes", takes="S", power_on="G97", source="8.20, 8.21")
def speed_mode(m: Machine, words: Words) -> None:
    """S is the cutting speed, m/min, and the spindle follows X; or it is the spindle speed, rev/min.

    G96 without S takes the last cutting speed, G97 without S keeps the spindle speed of the moment.
    """
    m.change("surface", memory(m).cutting_speed if words.code == "G96" else None)
    if words.code == "G96":
        memory(m).cutting_speed_word = first_word(words)
        m.change("speed_limit", float(m.settings["max_spindle_speed"]))
    if "S" in words:
        speed(m, words)
    else:
        follow_speed(m)


@FUNCTIONS("S", "Spindle speed, or cutting speed", phase="spindle", source="3, table 1")
def speed(m: Machine, words: Words) -> None:
    """rev/min under G97, m/min under G96."""
    value = m.value(words["S"])
    if m.surface is None:
        m.spindle(speed=value)
        return
    if not value > 0:
        m.alarm(f"S (cutting speed, m/min) must be greater than 0, got {value:g}", words["S"])
    memory(m).cutting_speed = value
    m.change("surface", value)
    follow_speed(m)


def need_cutting_speed(m: Machine) -> None:
    """An Alarm at G96 where it has no cutting speed by the time of a cut: S may stand in a block between."""
    if m.surface == 0:
        m.alarm(
            "G96 S (cutting speed, m/min) is missing: none was programmed before the first cut",
            memory(m).cutting_speed_word,
            hint="write G96 S100, for example; S under G97 is a spindle speed and does not count here",
        )


def follow_speed(m: Machine) -> None:
    """Under constant cutting speed the spindle has the speed of where the tool stands."""
    if m.surface is not None:
        m.spindle(speed=speed_at(m, m.tip))


FUNCTIONS(
    "M3 M4 M5", TURNS, group="spindle", phase="auxiliary", power_on="M5", source="5, 9.24 to 9.26"
)(motion.spindle)  # fmt: skip
FUNCTIONS("T", "Tool", phase="tool", source="3, table 1")(motion.tool)


@FUNCTIONS("M7 M8 M9", COOLANT, group="coolant", phase="auxiliary", power_on="M9", source="9.27, 9.28, table 3")
def coolant(m: Machine, words: Words) -> None:
    """M7 before the motion of the block, M9 after it. M8 is M9: table 3 has it, and nothing here switches on by M8."""
    if words.code == "M7":
        m.coolant()
        return
    if words.code == "M8":
        m.warn("M8: the table of this control says coolant off, on ISO controls it means on", first_word(words))
    m.at_block_end(m.coolant)


@FUNCTIONS("M0 M1", functions.PAUSES, phase="end", modal=False, source="9.22, 9.23")
def program_stop(m: Machine, words: Words) -> None:
    """After the block the operator must start the program again; M1 only with the setting optional_stop."""
    m.end_block()
    if words.code == "M0" or m.settings["optional_stop"]:
        m.stop()


@FUNCTIONS("M", "Function of the machine builder", phase="auxiliary", modal=False, source="9, note of table 3")
def machine_function(m: Machine, words: Words) -> None:
    """What the machine builder may have added: it has no effect here."""
    m.warn(f"{words.code} is not in the table of this control: it has no effect", first_word(words))


@FUNCTIONS("N %", OUTSIDE, phase="modes", modal=False, listed=False, source="not in the manual")
def passed_over(m: Machine, words: Words) -> None:
    """Refused, or passed over, by the setting `foreign`."""
    foreign(m, words, "it is passed over")


FOREIGN = "Foreign program end (setting foreign)"


@FUNCTIONS("M2 M30", FOREIGN, phase="end", modal=False, leads_away=True, listed=False, source="not in the manual")
def program_end(m: Machine, words: Words) -> None:
    """Refused, or the end of the program, by the setting `foreign`."""
    foreign(m, words, "the program ends")
    m.end_block()
    m.ended = True


def foreign(m: Machine, words: Words, effect: str) -> None:
    """An Alarm for a word of other controls, or one warning for each."""
    if m.settings["foreign"] == "refuse":
        m.alarm(f"{words.code} is not a word of this control", first_word(words), "setting foreign = accept takes it")
    if words.code not in (told := memory(m).foreign_words):
        told.add(words.code)
        m.warn(f"{words.code} is not a word of this control: {effect}", first_word(words))
