"""What the functions of the ISO mill share: what they keep, what they say of words without a chapter, numbers of words."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import NamedTuple

from mnclab.controls.word_address import motion
from mnclab.controls.word_address.motion import first_word
from mnclab.machine.control import Words
from mnclab.machine.machine import Machine
from mnclab.text.program import Word

# What the ISO mill keeps beside the common state of a machine.

Offsets = tuple[float, float, float]
NONE: Offsets = (0.0, 0.0, 0.0)


class Polar(NamedTuple):
    """Polar coordinates of G16: about which point of the plane, mm, and the last radius, mm, and angle, degrees."""

    centre: tuple[float, float]
    radius: float
    angle: float


class Doubt(NamedTuple):
    """Coordinates that a change of frame has turned over: of which axes, by which code, where the tip stood then."""

    axes: str
    code: str
    tip: tuple[float, float, float]


@dataclass
class Memory(motion.Memory):
    """Of this control. An offset that is wanted counts from the next motion along its axis on."""

    sign: int = 0  # of G43, G44, G49
    corrector: int = 0  # of D, or of M6
    length_corrector: int | None = None  # of H; None: the length is that of D
    outlived: bool = False  # H, by the tool for which it was written
    without_radius: bool = False  # D names a row that the tool table does not have
    wanted_offsets: Offsets = NONE
    active_offsets: Offsets = NONE
    empty_correctors: set[str] = field(default_factory=set)  # already warned of
    undescribed: set[str] = field(default_factory=set)  # codes already warned of
    sections: dict[int, list[tuple[int, str]]] = field(default_factory=dict)  # the programs of each file that runs
    return_to: Word | None = None  # the block after a subprogram, where M99 names one
    macro: object = None  # that G66 calls
    returned: float | None = None  # by the last subprogram of O words
    coolants: set[str] = field(default_factory=set)  # M7 and M8 that are on
    overrides: dict[str, bool] = field(default_factory=lambda: {"M50": True, "M51": True, "M52": False, "M53": True})
    moves_a_minute: float = 0.0  # the last F, where G93 is active
    known: set[tuple[int, str]] = field(default_factory=set)  # subprograms of O words that were called or passed: file, label

    row: int = 1  # of the table of datums: G54
    set_aside: Offsets | None = None  # the shift that G92.2 has put aside
    angle: float = 0.0  # of G68, degrees
    mirrored: dict[int, float] = field(default_factory=dict)  # axis -> the line of G51.1, mm
    polar: Polar | None = None
    plane_points: tuple[int, dict[int, list[float]]] | None = None  # of a G68.2 in several blocks: its P, and what they said
    doubt: Doubt | None = None
    absolute_centres: bool = False  # of arcs: G90.1
    references: dict[int, Offsets] = field(default_factory=dict)  # G28.1, G30.1, machine coordinates of the spindle, mm
    angles: dict[int, Offsets] = field(default_factory=dict)  # of the rotary axes there, degrees
    intermediate: dict[str, float] = field(default_factory=dict)  # of the last G28 or G30
    released: Offsets | None = None  # where a probe has come free of the part, machine coordinates


memory = Memory.of


# What stands in no chapter of the manual that there is: it is taken in its ISO meaning.
# The table of functions says so of each; by the setting `undescribed` a run says it too, once for each code.

ISO = "ISO meaning"


def undescribed(m: Machine, words: Words) -> None:
    """Say once for each code that its chapter is not there, if the setting wants it."""
    if not silent(m, words.code):
        memory(m).undescribed.add(words.code)
        sentence = f"{words.code}: not described in the manual; it is taken in its ISO meaning"
        motion.remark(m, "undescribed", sentence, first_word(words))


def remark(m: Machine, words: Words) -> None:
    """What stands in the example, or changes nothing, needs no remark; nor do M functions."""
    if words.code[0] == "G" and words.code not in ("G17", "G40", "G90"):
        undescribed(m, words)


def silent(m: Machine, *codes: str) -> bool:
    """Whether there is nothing to say of these codes, or no more."""
    return m.settings["undescribed"] == "accept" or memory(m).undescribed.issuperset(codes)


# Numbers of words: whole ones, and what depends on a decimal point.

def whole(m: Machine, words: Words, address: str, least: int, most: int) -> int:
    """A word of a block that is a whole number."""
    name = address if words.code == address else f"{words.code} {address}"
    if address not in words:
        m.alarm(f"{name} is missing", first_word(words))
    number = m.value(words[address])
    if number != int(number) or not least <= number <= most:
        m.alarm(f"{name} must be a whole number from {least} to {most}, got {number:g}", words[address])
    return int(number)


def written(m: Machine, word: Word) -> str:
    """A word of the running program as it stands there, without its address."""
    line, column, length, _ = word.span
    return m.flow.program.line_text(line)[column - 1 : column - 1 + length][len(word.address) :].strip()


def has_point(m: Machine, word: Word) -> bool:
    """Whether a word of the running program is written with a decimal point."""
    return "." in written(m, word)


BRIEF = 10  # ms: nobody waits for less, so seconds were meant


def seconds_of_p(m: Machine, word: Word) -> float:
    """What 1 of a P that is a dwell stands for, s."""
    counted = m.settings["dwell_p"]
    if counted == "point":
        counted = "seconds" if has_point(m, word) else "milliseconds"
    elif counted == "milliseconds" and has_point(m, word):  # Fanuc permits it in X alone
        hint = "write whole milliseconds, or X for seconds; setting dwell_p"
        m.warn(f"{word.rounded} counts milliseconds, decimal point or not: {m.value(word) / 1000:g} s", word, hint)
    elif counted == "milliseconds" and 0 < m.value(word) < BRIEF:
        hint = f"seconds are X{m.value(word):g}, or P with the setting dialect 'linuxcnc'"
        m.warn(f"{word.rounded} counts milliseconds: {m.value(word) / 1000:g} s", word, hint)
    return 1.0 if counted == "seconds" else 0.001
