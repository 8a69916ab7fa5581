"""Functions of the JNC-T01: feed, spindle and auxiliary ones, moves, dwell, and the frames of G92 and of the correctors."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import Any

from mnclab.controls.word_address import motion
from mnclab.controls.word_address.motion import ARCS, first_word
from mnclab.geometry import frames
from mnclab.machine.control import FunctionTable, Words
from mnclab.machine.machine import Machine
from mnclab.machine.rows import speed_at
from mnclab.machining.turning.threading import lead_along
from mnclab.text.program import Word

# What the JNC-T01 keeps beside the common state of a machine.

@dataclass
class Memory:
    """Of the JNC-T01. A corrector that is chosen becomes active with the next motion."""

    corrector: int = 0
    active_corrector: int = 0
    empty_correctors: set[int] = field(default_factory=set)  # already warned of
    cutting_speed: float = 0.0  # the last S under G96, m/min
    cutting_speed_word: Word | None = None  # the G96 that is active
    feed_ended_by: str = ""  # the code that gave F another unit
    foreign_words: set[str] = field(default_factory=set)  # already warned of


def memory(m: Machine) -> Memory:
    """What the JNC-T01 keeps."""
    kept: Memory = m.memory
    return kept


# Feed, spindle and auxiliary functions: F under G93 to G95, S under G96 and G97, M functions.

FUNCTIONS = FunctionTable()
FEEDS = {"G93": "Feed as time of the move, s"} | motion.FEEDS
SPEEDS = {"G96": "Constant cutting speed", "G97": "Constant spindle speed"}
TURNS = {"M3": "Spindle on, right", "M4": "Spindle on, left", "M5": "Spindle off"}
COOLANT = {"M7": "Coolant on", "M8": "Coolant off (table 3)", "M9": "Coolant off"}
OUTSIDE = {"N": "Foreign block number (setting foreign)", "%": "Foreign program start (setting foreign)"}


@FUNCTIONS("G90 G91", motion.DIMENSIONS, group="dimension", phase="modes", power_on="G90", source="8.14, 8.15")
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


@FUNCTIONS("M0 M1", motion.PAUSES, phase="end", modal=False, source="9.22, 9.23")
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


# Motion: G00 to G03, the one-shot moves G12, G14 and G32, dwell, and the frames of G92 and of the correctors.
# X is a radius, or with the setting `diameter` a diameter that is halved where it is read; the machine knows radii only.

AXES = {"X": 0, "Z": 2}
ONCE: dict[str, Any] = {"group": "08", "modal": False, "owns": True}
CORNERS = {"G12": "Straight line with fillet of 90 degrees", "G14": "Straight line with chamfer of 45 degrees"}
SIZES = {"G12": "fillet radius", "G14": "chamfer size"}
HOME = {"M60": "Home X and Z", "M61": "Home X", "M63": "Home Z"}


def scale(m: Machine, address: str) -> float:
    """mm of radius for 1 in a word X or U, mm for 1 in any other."""
    return 0.5 if address in "XU" and m.settings["diameter"] else 1.0


def coordinate(m: Machine, address: str, value: float) -> float:
    """The coordinate, mm, that a number of X, Z, U or W means: from part zero, or under G91 from where the tool stands."""
    value *= scale(m, address)
    return value if m.modal["dimension"] == "G90" else value + m.programmed[0 if address in "XU" else 2]


def targets(m: Machine, words: Words) -> dict[str, Any]:
    """Where the axes that are written go; a corrector chosen before counts from now on."""
    to = {axis.lower(): coordinate(m, axis, m.value(words[axis])) for axis in AXES if axis in words}
    if to:
        use_corrector(m)
    return to


@FUNCTIONS("G0", "Rapid positioning", group="motion", takes="X Z", power_on="G0", moves=True, source="8.1")
def rapid(m: Machine, words: Words) -> None:
    """Straight to X, Z at rapid."""
    if to := targets(m, words):
        m.rapid(**to)


@FUNCTIONS("G1", "Linear interpolation", group="motion", takes="X Z", moves=True, source="8.2")
def line(m: Machine, words: Words) -> None:
    """Straight to X, Z at feed."""
    if to := targets(m, words):
        m.line(**to, f=cutting_feed(m, first_word(words)), word=first_word(words))


@FUNCTIONS("G2 G3", ARCS, group="motion", takes="X Z R I K", moves=True, source="8.3, 8.4")
def arc(m: Machine, words: Words) -> None:
    """To X, Z about the centre I, K from the start, or with the radius R (negative: more than half a circle).

    The sense is that seen with Z to the right and X up.
    """
    offsets = [words[c] for c in "IK" if c in words]
    if len(words.words) == 1 and words.words[0].address == "G":
        return  # the code alone: it only becomes active
    if "X" not in words and "Z" not in words:
        m.alarm(f"{words.code} needs X or Z", first_word(words))
    if not offsets and "R" not in words:
        m.alarm(f"{words.code} needs R, or I or K", first_word(words), "they count for one block only")
    if offsets and "R" in words:
        twice = f"R and {offsets[0].address} stand in one block: the centre is given twice"
        m.alarm(twice, words["R"], "keep one of them")
    to, sense, tolerance = targets(m, words), 1 if words.code == "G3" else -1, m.settings["arc_tolerance"]
    head = words["R"] if "R" in words else offsets[0]
    feed = cutting_feed(m, first_word(words))
    radius = m.value(head) if "R" in words else None
    if radius == 0:
        m.alarm(f"{words.code} R (radius) must not be 0", head)
    about = {k: m.programmed[k] + (m.value(words[c]) if c in words else 0.0) for c, k in (("I", 0), ("K", 2))}
    m.arc(**to, sense=sense, centre=about if offsets else None, radius=radius, f=feed, word=head, tolerance=tolerance)


@FUNCTIONS("G12 G14", CORNERS, **ONCE, moves=True, takes="X Z R", source="8.6, 8.7")
def corner(m: Machine, words: Words) -> None:
    """Along one axis, and at its end by R into the other: a quarter circle or a chamfer. R has the sign of that way."""
    head = first_word(words)
    named = [words[axis] for axis in AXES if axis in words]
    if len(named) != 1:
        m.alarm(f"{words.code} needs either X or Z, got {'both' if named else 'none'}", named[1] if named else head)
    if "R" not in words:
        m.alarm(f"{words.code} R ({SIZES[words.code]}) is missing", head)
    word, size = named[0], m.value(words["R"])
    along, across = (0, 2) if word.address == "X" else (2, 0)
    start, end = m.programmed, coordinate(m, word.address, m.value(word))
    way = end - start[along]
    if abs(size) > abs(way) * (1 + 1e-12):
        sentence = f"must be at most the way along {word.address}, {abs(way):.10g} mm, got {size:g}"
        m.alarm(f"{words.code} R ({SIZES[words.code]}) {sentence}", words["R"])
    use_corrector(m)
    turn = end - math.copysign(abs(size), way)
    middle, last = {along: turn, across: start[across]}, {along: end, across: start[across] + size}
    centre = {along: turn, across: start[across] + size}
    round_it = words.code == "G12" and size != 0
    lengths = abs(turn - start[along]), abs(size) * (math.pi / 2 if round_it else math.sqrt(2))
    feeds = shared(m, cutting_feed(m, head), lengths)
    if lengths[0]:
        with m.within(label=f"{words.code} line"):
            m.line(x=middle[0], z=middle[2], f=feeds[0], word=head)
    with m.within(label=f"{words.code} {'fillet' if words.code == 'G12' else 'chamfer'}"):
        if round_it:
            sense = (1 if way * size > 0 else -1) * (1 if along == 2 else -1)
            m.arc(x=last[0], z=last[2], sense=sense, centre=centre, f=feeds[1], word=head)
        elif size:
            m.line(x=last[0], z=last[2], f=feeds[1], word=head)


def shared(m: Machine, feed: float | None, lengths: tuple[float, ...]) -> list[float | None]:
    """The feeds of the parts of one programmed move: under G93 its time is shared by their lengths."""
    total = sum(lengths)
    if not m.per_time or m.feed is None or not total:
        return [feed for _ in lengths]
    return [-m.feed * part / total for part in lengths]


@FUNCTIONS("G32", "Thread move", **ONCE, moves=True, takes="X Z F", source="8.8")
def thread(m: Machine, words: Words) -> None:
    """Straight to X, Z with the spindle; the axis with the longer way advances F in a turn. Starts at the zero mark."""
    head = first_word(words)
    if "F" not in words:
        m.alarm("G32 F (thread pitch) is missing", head)
    if "X" not in words and "Z" not in words:
        m.alarm("G32 needs X or Z", head)
    pitch = m.value(words["F"])
    if not pitch > 0:
        m.alarm(f"G32 F (thread pitch) must be greater than 0, got {pitch:g}", words["F"])
    need_cutting_speed(m)
    if not m.spindle_speed:
        m.alarm("G32 needs a turning spindle", head, hint="write S and M3 before the move")
    if m.surface is not None:
        changes = "G32 under constant cutting speed (G96): the spindle speed changes where X does"
        m.warn(changes, head, "write G97 S first")
    start, to = m.programmed, targets(m, words)
    way = [to.get(axis, start[k]) - start[k] for axis, k in (("x", 0), ("z", 2))]
    if any(way):
        lead = lead_along(way[0], way[1], pitch)
        with m.within(label="G32 thread", per_rev=True, synchronous=True, feed=lead):
            m.line(**to, word=head)


@FUNCTIONS("G4", "Dwell", **ONCE, phase="dwell", still=True, takes="F", source="8.5")
def dwell(m: Machine, words: Words) -> None:
    """A pause of F seconds."""
    if "F" not in words:
        m.alarm("G4 F (dwell, s) is missing", first_word(words))
    m.end_block()  # M5, M9: before the pause
    m.dwell(m.value(words["F"]))


@FUNCTIONS("G92", "Zero offset", **ONCE, phase="dwell", still=True, takes="X Z", source="8.16")
def zero_offset(m: Machine, words: Words) -> None:
    """Puts the origin to X, Z of part zero (G90; what is left out is 0), or shifts it by X, Z (G91). Nothing moves."""
    m.end_block()
    given = {k: m.value(words[axis]) * scale(m, axis) if axis in words else 0.0 for axis, k in AXES.items()}
    old = m.frames["offset"][:3, 3] if m.modal["dimension"] == "G91" else (0.0, 0.0, 0.0)
    x, z = (float(old[k]) + given[k] for k in (0, 2))
    m.set_frame("offset", frames.shift(x, 0.0, z) if x or z else None)
    follow_speed(m)


@FUNCTIONS("L", "Corrector", phase="corrector", source="3, table 1")
def corrector(m: Machine, words: Words) -> None:
    """The offsets of corrector L count from the next motion on, in both axes; L0 has none."""
    number, told = int(m.value(words["L"])), memory(m).empty_correctors
    if number and number not in m.tables.correctors and number not in told:
        told.add(number)
        message = f"L{number} (corrector) has no offsets: they count as 0"
        m.warn(message, words["L"], hint="Setup(correctors={…}) gives them")
    memory(m).corrector = number
    m.log("corrector", number)


def use_corrector(m: Machine) -> None:
    """The next motion takes up the offsets of the corrector chosen last."""
    number = memory(m).corrector
    if number != memory(m).active_corrector:
        memory(m).active_corrector = number
        row = m.tables.correctors.get(number)
        shift = frames.shift(row.x, 0.0, row.z) if row and (row.x or row.z) else None
        m.set_frame("corrector", shift, "programmed")


@FUNCTIONS("M60 M61 M63", HOME, modal=False, still=True, source="9.29 to 9.31")
def home(m: Machine, words: Words) -> None:
    """To the machine's zero position at rapid, the axes together; where it lies is a setting."""
    use_corrector(m)
    x, _, z = m.to_program((m.settings["home_x"], 0.0, m.settings["home_z"]))
    with m.within(label=f"{words.code} home"):
        m.rapid(x=None if words.code == "M63" else x, z=None if words.code == "M61" else z)


def plain(m: Machine) -> bool:
    """Whether words of motion mean nothing but motion now: radii, a feed per minute, no corrector to take up."""
    pending = memory(m).corrector != memory(m).active_corrector
    return not (m.settings["diameter"] or m.per_time or pending or m.surface is not None)
