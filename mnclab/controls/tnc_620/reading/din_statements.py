"""What the G functions are that are no path functions: statements and older cycles under other names, words renamed.

`G54 X+25` is CYCL DEF 7 with X, `G25 R5` is RND with R, `G201 Q200=2` is CYCL DEF 201; the addresses are those that the
language knows. Cycles that a machine tool builder or an obsolete control has are named, so that their refusal names them.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping, Sequence
from functools import partial
from typing import NamedTuple

from mnclab.controls.tnc_620.reading import labels
from mnclab.controls.tnc_620.reading.din_motion import AXES, PLANES
from mnclab.controls.tnc_620.reading.din_words import Given, put, unmixed
from mnclab.controls.tnc_620.reading.iso_names import ISO_NAMES
from mnclab.controls.tnc_620.reading.obsolete_blocks import PLACES
from mnclab.controls.tnc_620.reading.sub_blocks import mirrored
from mnclab.controls.tnc_620.reading.words import FLAGS, Cursor, Fault


class Renamed(NamedTuple):
    """A statement of the language, and the addresses of its words by their letters in DIN/ISO."""

    keyword: str
    words: Mapping[str, str]


def _obsolete(cycle: int) -> Renamed:
    """An obsolete cycle: P01, P02 … are the values of its dialog in their order; the sense of milling is in the G function."""
    addresses = [address for place in PLACES[cycle] for address in place.split() if address != "DR"]
    return Renamed(f"CYCL DEF {cycle}", {f"P{k:02}": address for k, address in enumerate(addresses, 1)})


_SHIFT = {letter: letter for letter in "XYZUVWABC"}
#: Statements whose words only have other letters, by the number of the G function.
STATEMENTS: dict[int, Renamed] = {
    4: Renamed("CYCL DEF 9", {"F": "DWELL"}),
    24: Renamed("CHF", {"R": "length", "F": "F"}),
    25: Renamed("RND", {"R": "R", "F": "F"}),
    29: Renamed("CC", {}),
    30: Renamed("BLK FORM 0.1", {"X": "X", "Y": "Y", "Z": "Z"}),
    31: Renamed("BLK FORM 0.2", {"X": "X", "Y": "Y", "Z": "Z"}),
    36: Renamed("CYCL DEF 13", {"S": "ANGLE"}),
    37: Renamed("CYCL DEF 14", {f"P{k:02}": "LBL" for k in range(1, 13)}),
    38: Renamed("STOP", {}),
    51: Renamed("TOOL DEF", {"T": "tool", "text": "text"}),
    53: Renamed("CYCL DEF 7", {"P01": "#"}),
    54: Renamed("CYCL DEF 7", _SHIFT),
    62: Renamed("CYCL DEF 32", {"T": "T", "P01": "HSC-MODE", "P02": "TA"}),
    72: Renamed("CYCL DEF 11", {"F": "SCL"}),
    73: Renamed("CYCL DEF 10", {"H": "ROT"}),
    80: Renamed("CYCL DEF 19", {"A": "A", "B": "B", "C": "C", "F": "F"}),
    **{code: _obsolete(cycle) for code, cycle in {83: 1, 84: 2, 85: 17, 74: 3, 75: 4, 76: 4, 77: 5, 78: 5}.items()},
    86: Renamed("CYCL DEF 18", {"P01": "DEPTH", "P02": "PITCH"}),
    99: Renamed("TOOL DEF", {"T": "tool", "text": "text", "L": "L", "R": "R"}),
}
CALL = Renamed("TOOL CALL", {"T": "tool", "text": "text", **{name: name for name in ("S", "F", "DL", "DR", "DR2")}})
#: Words whose unit is another than their address says: a feed in degrees, a tolerance in the unit of the program.
UNITS = {(80, "F"): False, (62, "T"): True}
#: Pockets, and whether they are milled clockwise (-1) or counter-clockwise.
SENSES = {75: -1.0, 76: 1.0, 77: -1.0, 78: 1.0}
REFUSED = {
    43: "compensation of single axes, not built yet", 44: "compensation of single axes, not built yet",
    50: "a protection of the program, which these manuals do not describe",
    56: "pilot drilling of the older contour cycles, not built", 57: "rough-out of the older contour cycles, not built",
    58: "finishing of the older contour cycles, not built", 59: "finishing of the older contour cycles, not built",
    60: "running 3-D data of older controls, not built",
    70: "the unit, which stands in the first block: %NAME G70", 71: "the unit, which stands in the first block: %NAME G71",
}  # fmt: skip
_L = re.compile(r"[ \t]*L", FLAGS)
_CALLED = re.compile(r"(\d{1,9})(?![\d.])", FLAGS)
_REPEATS = re.compile(r"[ \t]*,[ \t]*(\d{1,9})(?![\d.])", FLAGS)
_AT_PATTERN = re.compile(r"[ \t]*PAT", FLAGS)
_NAME_OF_PROGRAM = re.compile(r"[ \t]*(?:P[ \t]*0?1(?!\d)|PGM(?![A-Z]))?[ \t]*:?[ \t]*%?", FLAGS)


def axis_of(builder_text: str, code: Given) -> str:
    """The tool axis of a plane; G20 has an axis that is not built."""
    if code.code == 20:
        raise Fault("G20: the fourth axis as tool axis is not built", code.at, code.length)
    return PLANES[code.code]


def renamed(cursor: Cursor, code: int, statement: Renamed, words: Sequence[Given]) -> None:
    """The words of a statement under the addresses of the language; M functions stay as they are."""
    for word in words:
        if word.letter == "G" and word.code in PLANES and "axis" not in statement.words:
            continue
        letter, _, axis = word.letter.partition(":")
        address = statement.words.get(letter if axis in AXES else word.letter)
        if address and axis:  # P05 X+80: a side along an axis
            address = axis if address in AXES else None
        if address is None and word.letter[0] != "M":
            taken = [letter for letter in statement.words if letter.isupper()]
            takes = f"it takes {' '.join(taken)}" if taken else "it stands alone"
            head = f"G{code:02}" if code >= 0 else "T"
            raise word.fault(cursor.builder, f"does not belong to {head}", takes)
        if word.letter == "R":
            word = word._replace(incremental=0)
        unmixed(cursor.builder, [word])
        put(cursor, address or word.letter, word, inches=UNITS.get((code, word.letter)))


def mirror(cursor: Cursor) -> None:
    """G28 X Y: letters of axes, none ends the mirror image."""
    mirrored(cursor)


def program_name(cursor: Cursor, head: Given) -> None:
    """G39 P01 NAME: the program that becomes a cycle."""
    cursor.match(_NAME_OF_PROGRAM)
    labels.name_of_program(cursor, "PGM", "G39")


def set_label(cursor: Cursor, head: Given) -> None:
    """G98 L1: a jump target."""
    if cursor.match(_L) is None:
        raise Fault("G98 needs L and the label", head.at, head.length, "for example G98 L1")
    named(cursor, labels.set_label)


def named(cursor: Cursor, read: Callable[[Cursor], object]) -> None:
    """What reads a label; its faults are told in the words of these programs."""
    try:
        read(cursor)
    except Fault as fault:
        message, hint = (part.replace("LBL ", "G98 L") for part in (fault.message, fault.hint))
        raise Fault(message, fault.offset, fault.length, hint) from None


def call_label(cursor: Cursor) -> None:
    """L1 or L1,3: the label, and how often the section is repeated; `,0` is a call once."""
    begin = cursor.blanks()
    if found := cursor.match(_CALLED):
        if float(found.group(1)) > 65535:
            got = found.group(1)
            raise Fault(f"a label must be a number from 0 to 65535, got {got}", begin, len(got))
        cursor.builder.word("label", float(found.group(1)), begin, len(found.group(1)))
    else:
        named(cursor, partial(labels.label, parameter=True))
    if (found := cursor.match(_REPEATS)) and int(found.group(1)):
        cursor.builder.word("REP", float(found.group(1)), found.start(1), len(found.group(1)))


def called(cursor: Cursor) -> str:
    """The keyword of G79: CYCL CALL, or CYCL CALL PAT."""
    return "CYCL CALL PAT" if cursor.match(_AT_PATTERN) else "CYCL CALL"


def cycle_of(code: int) -> str:
    """The keyword of a cycle by its G function; empty if there is none."""
    if named := ISO_NAMES.get(f"G{code}"):
        return named
    if 200 <= code < 400:
        return f"CYCL DEF {code}"
    return f"TCH PROBE {code}" if 400 <= code < 600 or 1400 <= code < 1500 else ""
