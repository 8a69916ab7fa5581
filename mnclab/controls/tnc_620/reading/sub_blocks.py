"""How sub-blocks n.1, n.2 … of the older cycles are read: letters of axes, factors, and numbers behind a word.

The words in front of the numbers are those of the dialog, in its language (`DWELL`, `TEMP`, `ANGLE`, `UNGHI` …):
they are passed over, and what the number means follows from its place.
"""

from __future__ import annotations

import re
from collections.abc import Callable

from mnclab.controls.tnc_620.reading.words import FLAGS, Cursor, Read, from_inches

_LETTER = re.compile(r"[ \t]*([XYZUVWABC])(?![A-Z\d])", FLAGS)
_CENTRE = re.compile(r"I?CC", FLAGS)
_DIALOG = re.compile(r"(?:(?!Q[LR]?\d)[^\d\s;~+.,=-])*(?:[ \t]+(?:(?!Q[LR]?\d)[^\d\s;~+.,=-])+)*", FLAGS)
_EQUALS = re.compile(r"[ \t]*=", FLAGS)
_TOLERANCE = re.compile(r"T(?![A-Z])", FLAGS)
_MODE = re.compile(r"HSC[ \t]*(?:-[ \t]*)?MODE[ \t]*:?", FLAGS)
_ANGLE = re.compile(r"TA", FLAGS)


def mirrored(cursor: Cursor) -> None:
    """8.1: letters of axes, or none."""
    while not cursor.done:
        begin = cursor.at
        found = cursor.match(_LETTER)
        if found is None:
            raise cursor.unexpected("only letters of axes stand here, for example X Y")
        cursor.add("axes", found.group(1).upper(), begin)


def of_two_units(is_length: Callable[[Cursor], bool]) -> Read:
    """Words of which only some are in the unit of the program."""

    def read(cursor: Cursor) -> None:
        inch = cursor.inch
        try:
            while not cursor.done:
                cursor.inch = inch and is_length(cursor)
                cursor.word()
        finally:
            cursor.inch = inch

    return read


#: 26.1: a factor for each axis, which has no unit, and the coordinates of the centre.
factors = of_two_units(lambda cursor: _CENTRE.match(cursor.text, cursor.at, cursor.stop) is not None)
#: 19.1: angles, the feed of the rotary axes in degrees a minute, and a length.
tilting = of_two_units(lambda cursor: cursor.text[cursor.at] not in "Ff")


def after_dialog(address: str, meaning: str) -> Read:
    """One number behind the words of the dialog and perhaps `=`."""

    def read(cursor: Cursor) -> None:
        begin = cursor.blanks()
        cursor.match(_DIALOG)
        cursor.match(_EQUALS)
        value = cursor.needed(f"a number is missing: the {meaning}", begin, max(1, cursor.at - begin))
        cursor.add(address, value, begin)
        if not cursor.done:
            raise cursor.unexpected()

    return read


def tolerance(cursor: Cursor) -> None:
    """32.1: T; without it (NO ENT) the tolerance is that of the machine."""
    begin = cursor.blanks()
    if cursor.done:
        return
    if cursor.match(_TOLERANCE) is None:
        raise cursor.unexpected("T, the tolerance, stands here")
    value = cursor.needed("T needs a number", begin)
    cursor.add("T", from_inches(value) if cursor.inch else value, begin)


def filters(cursor: Cursor) -> None:
    """32.2: the filter and the tolerance of rotary axes, in either order."""
    while not cursor.done:
        begin = cursor.at
        if cursor.match(_MODE):
            address = "HSC-MODE"
        elif cursor.match(_ANGLE):
            address = "TA"
        else:
            raise cursor.unexpected("HSC-MODE:0 or 1 and TA stand here")
        cursor.add(address, cursor.needed(f"{address} needs a number", begin, cursor.at - begin), begin)


#: By cycle, or by cycle and number of the sub-block.
READERS: dict[str, Read] = {
    "CYCL DEF 8": mirrored,
    "CYCL DEF 9.1": after_dialog("DWELL", "dwell in seconds"),
    "CYCL DEF 13.1": after_dialog("ANGLE", "angle of the spindle"),
    "CYCL DEF 18.1": after_dialog("DEPTH", "depth of the thread"),
    "CYCL DEF 18.2": after_dialog("PITCH", "pitch of the thread"),
    "CYCL DEF 19": tilting,
    "CYCL DEF 26": factors,
    "CYCL DEF 32.1": tolerance,
    "CYCL DEF 32.2": filters,
}
