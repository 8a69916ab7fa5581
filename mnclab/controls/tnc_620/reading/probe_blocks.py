"""How the sub-blocks of the cycles 0, 1, 3 and 4 are written, and G55, which is cycle 0 (TNC 620, 16.2, 16.3, 17.2, 17.3).

    TCH PROBE 0.0 REF. PLANE Q5 X-          TCH PROBE 3.1 Q1
    TCH PROBE 0.1 X+5 Y+0 Z-5               TCH PROBE 3.2 X ANGLE: +15
    TCH PROBE 1.1 X ANGLE: +30              TCH PROBE 3.3 ABST +10 F100 MB1 REFERENCE SYSTEM: 0
    TCH PROBE 4.2 IX-0.5 IY-1 IZ-1          TCH PROBE 3.4 ERRORMODE1

Words such as ANGLE are those of the dialog, in its language: what the number behind them means follows from its place.
"""

from __future__ import annotations

import re
from functools import partial

from mnclab.controls.tnc_620.reading.dialog import dialog
from mnclab.controls.tnc_620.reading.words import FLAGS, Cursor, Fault, Read, from_inches

_RESULT = re.compile(r"Q[ \t]*(\d{1,4})(?!\d)", FLAGS)
_SENSE = re.compile(r"([XYZ])[ \t]*([+-])(?![ \t]*[\d.,])", FLAGS)
_AXIS = re.compile(r"([XYZ])(?![A-Z\d+-])", FLAGS)
_PLACE = re.compile(r"([XYZ])(?=[ \t]*[-+\d.,Q])", FLAGS)
_COMPONENT = re.compile(r"(I[XYZ])(?=[ \t]*[-+\d.,Q])", FLAGS)
_WAY = re.compile(r"(ABST|DIST|F|MB)(?=[ \t]*[-+\d.,Q])", FLAGS)
_P01 = re.compile(r"P[ \t]*0?1[ \t]*(\d{1,4})(?!\d)", FLAGS)
_P02 = re.compile(r"P[ \t]*0?2[ \t]*([XYZ])[ \t]*P[ \t]*0?3[ \t]*([01])(?![\d.,])", FLAGS)


def _name(cursor: Cursor, pattern: re.Pattern[str], address: str, fault: str) -> None:
    """A number of a Q parameter or letters that must stand here."""
    begin = cursor.blanks()
    text = cursor.expect(pattern, fault).group(1).upper()
    cursor.add(address, float(text) if text.isdigit() else text, begin)


result = partial(_name, pattern=_RESULT, address="Q", fault="Q and the number of the result parameter stand here, for example Q5")


def plane_and_sense(cursor: Cursor) -> None:
    """0.0: a name, the result parameter, the probing axis with its sense."""
    dialog(cursor)
    result(cursor)
    begin = cursor.blanks()
    found = cursor.expect(_SENSE, "the probing axis and its sense stand here: X+, X-, Y+, Y-, Z+ or Z-")
    cursor.add("axis", found.group(1).upper() + found.group(2), begin)


def numbers(cursor: Cursor, pattern: re.Pattern[str], fault: str) -> None:
    """Addresses with numbers, in any order."""
    while not cursor.done:
        begin = cursor.at
        address = cursor.expect(pattern, fault).group(1).upper()
        cursor.add(address, cursor.needed(f"{address} needs a number", begin, len(address)), begin)


def axis_and_angle(cursor: Cursor) -> None:
    """1.1, 3.2: the probing axis, and a number behind a word of the dialog."""
    _name(cursor, _AXIS, "axis", "the probing axis stands here: X, Y or Z")
    _last(cursor, "ANGLE", "probing angle")


def way(cursor: Cursor) -> None:
    """3.3, 4.3: how far, how fast, how far back, and the reference system behind words of the dialog."""
    while not cursor.done:
        begin = cursor.at
        if found := cursor.match(_WAY):
            name = found.group(1).upper()
            value = cursor.needed(f"{name} needs a number", begin, len(name))
            if name == "MB" and cursor.inch:
                value = from_inches(value)
            cursor.add("ABST" if name == "DIST" else name, value, begin)
        else:
            _last(cursor, "SYSTEM", "reference system, 0 or 1")


def _last(cursor: Cursor, address: str, meaning: str) -> None:
    """The number at the end of a sub-block, behind words of the dialog."""
    begin = cursor.blanks()
    words = dialog(cursor)
    value = cursor.needed(f"a number is missing: the {meaning}", begin, max(1, len(words)))
    cursor.add(address, value, begin)
    if not cursor.done:
        raise cursor.unexpected()


def in_words(cursor: Cursor) -> None:
    """G55 P01 5 P02 X P03 0 X+5 Y+0 Z-5: P03 is 0 for the negative direction and 1 for the positive one."""
    while not cursor.done:
        begin = cursor.at
        if found := cursor.match(_P01):
            cursor.add("Q", float(found.group(1)), begin)
        elif found := cursor.match(_P02):
            cursor.add("axis", found.group(1).upper() + "-+"[int(found.group(2))], begin)
        elif found := cursor.match(_PLACE):
            address = found.group(1).upper()
            cursor.add(address, cursor.needed(f"{address} needs a number", begin), begin)
        else:
            raise Fault("G55 takes P01, P02 with P03, X, Y and Z", begin, hint="for example G55 P01 5 P02 X P03 0 X+5 Y+0 Z-5")


_places = partial(numbers, pattern=_PLACE, fault="only X, Y and Z of the pre-position stand here, absolute")
READERS: dict[str, Read] = {
    "TCH PROBE 0.0": plane_and_sense, "TCH PROBE 0.1": _places,
    "TCH PROBE 1.1": axis_and_angle, "TCH PROBE 1.2": _places,
    "TCH PROBE 3.1": result, "TCH PROBE 3.2": axis_and_angle, "TCH PROBE 3.3": way,
    "TCH PROBE 3.4": partial(_last, address="ERRORMODE", meaning="error mode, 0 or 1"),
    "TCH PROBE 4.1": result, "TCH PROBE 4.3": way,
    "TCH PROBE 4.2": partial(numbers, pattern=_COMPONENT, fault="IX, IY and IZ stand here: the direction"),
}  # fmt: skip
