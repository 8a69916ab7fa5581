"""The sub-blocks n.1, n.2 … of the older cycles, and words of the dialog before a number."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from contextlib import contextmanager, nullcontext
from functools import partial

from mnclab.controls.tnc_620.reading.labels import program_of_cycle
from mnclab.controls.tnc_620.reading.words import FLAGS, WHOLE, Cursor, Fault, Read, from_inches

# Words of the dialog before a number, in the language of the control: `DWELL`, `V.ZEIT`, `CZAS ZWL.`, `T.ESPERA`.

_LETTER = r"(?:(?!Q[LR]?\d)[^\d\s;~+.,=-]|(?<![\s\d])\.)"  # a point behind a blank begins a number
_DIALOG_WORDS = re.compile(rf"{_LETTER}*+(?:[ \t]++{_LETTER}++)*+", FLAGS)
_BEHIND_A_POINT = re.compile(r"(?<=\.)\d+(?![\d.,])")
_EQUALS = re.compile(r"[ \t]*=", FLAGS)


def dialog(cursor: Cursor) -> str:
    """Pass over the words and `=`; the words, in capital letters without blanks. `V.ZEIT.5` may mean two numbers: a Fault."""
    words = cursor.match(_DIALOG_WORDS)
    if digits := _BEHIND_A_POINT.match(cursor.text, cursor.at, cursor.stop):
        what, number = f".{digits.group()} may be 0.{digits.group()} or {digits.group()}", len(digits.group()) + 1
        raise Fault(what, cursor.at - 1, number, "write a blank before the number, and a digit before its point")
    cursor.match(_EQUALS)
    return "".join(words.group().upper().split()) if words else ""


# How sub-blocks n.1, n.2 … of the older cycles are read: letters of axes, factors, and numbers behind a word.
# The words in front of the numbers are those of the dialog, in its language (`DWELL`, `TEMP`, `ANGLE`, `UNGHI` …):
# they are passed over, and what the number means follows from its place.

#: A title: all before the numbers that is no sign of one, no name and no parameter.
_LABELS = re.compile(r'(?:(?!(?<![A-Z])Q[LRS]?\d)[^\d;~"+-]|[+-](?![ \t]*\d))*+', FLAGS)
_SLASH = re.compile(r"[ \t]*/")
_ROW = re.compile(r"#")
_CENTRE = re.compile(r"I?CC", FLAGS)
_ANY_AXIS = re.compile(r"[ \t]*([XYZUVWABC])(?![A-Z\d])", FLAGS)
_TOLERANCE = re.compile(r"T(?![A-Z])", FLAGS)
_STATUS = re.compile(r"Q[LR]?\d{1,4}(?!\d)", FLAGS)
_DISTANCE = re.compile(r"(?!FMAX|FAUTO)[A-Z]{3,}[ \t]*", FLAGS)
_FILTER = re.compile(r"HSC[ \t]*(?:-[ \t]*)?MODE[ \t]*:?|TA", FLAGS)


def contour_labels(cursor: Cursor) -> None:
    """14.1: the numbers of the labels, `1/2/3/4`, after a word in the language of the dialog."""
    cursor.match(_LABELS)
    while not cursor.done:
        cursor.match(_SLASH)
        begin = cursor.blanks()
        found = cursor.expect(WHOLE, "a contour label must be a whole number")
        cursor.add("LBL", float(found.group(1)), begin)


def datum_shift(cursor: Cursor) -> None:
    begin = cursor.blanks()
    if cursor.match(_ROW):
        cursor.add("#", cursor.needed("# needs the number of a row", begin), begin)
    cursor.words()


def mirrored(cursor: Cursor) -> None:
    """8.1: letters of axes, or none."""
    while not cursor.done:
        begin = cursor.at
        found = cursor.expect(_ANY_AXIS, "only letters of axes stand here, for example X Y")
        cursor.add("axes", found.group(1).upper(), begin)


@contextmanager
def without_unit(cursor: Cursor) -> Iterator[None]:
    """Inside, no word is a length."""
    inch, cursor.inch = cursor.inch, False
    try:
        yield
    finally:
        cursor.inch = inch


def factors(cursor: Cursor) -> None:
    """26.1: a factor for each axis, which has no unit, and the coordinates of the centre, which have that of the program."""
    while not cursor.done:
        with nullcontext() if _CENTRE.match(cursor.text, cursor.at, cursor.stop) else without_unit(cursor):
            cursor.word()


def tilting(cursor: Cursor) -> None:
    """19.1: angles, the feed of the rotary axes in degrees a minute, and a length behind a word (`ABST`, `DIST`, …)."""
    while not cursor.done:
        begin = cursor.at
        if found := cursor.match(_DISTANCE):
            name = found.group().rstrip()
            cursor.add("ABST", cursor.needed(f"{name} needs a number", begin, len(name)), begin)
        else:
            with without_unit(cursor):
                cursor.word()


def after_dialog(cursor: Cursor, address: str, meaning: str) -> None:
    """One number behind the words of the dialog and perhaps `=`, at the end of a sub-block."""
    begin = cursor.blanks()
    dialog(cursor)
    value = cursor.needed(f"a number is missing: the {meaning}", begin, max(1, cursor.at - begin))
    cursor.add(address, value, begin)
    if not cursor.done:
        raise cursor.unexpected()


def tolerance(cursor: Cursor) -> None:
    """32.1: T; without it (NO ENT) the tolerance is that of the machine."""
    begin = cursor.blanks()
    if cursor.done:
        return
    cursor.expect(_TOLERANCE, "T, the tolerance, stands here")
    value = cursor.needed("T needs a number", begin)
    cursor.add("T", from_inches(value) if cursor.inch else value, begin)


def filters(cursor: Cursor) -> None:
    """32.2: the filter and the tolerance of rotary axes, in either order."""
    while not cursor.done:
        begin = cursor.at
        found = cursor.expect(_FILTER, "HSC-MODE:0 or 1 and TA stand here")
        address = "TA" if found.group().upper() == "TA" else "HSC-MODE"
        cursor.add(address, cursor.needed(f"{address} needs a number", begin, cursor.at - begin), begin)


def checked(cursor: Cursor) -> None:
    """31.1, 32.1 and 33.1 of tool measurement: what becomes of the values, and perhaps the Q parameter of the status."""
    begin = cursor.blanks()
    dialog(cursor)
    cursor.add("CHECK", cursor.needed("a number is missing: the mode 0, 1 or 2", begin, max(1, cursor.at - begin)), begin)
    begin = cursor.blanks()
    if found := cursor.match(_STATUS):
        cursor.add("status parameter", found.group().upper(), begin)


# The sub-blocks of the cycles 1 to 5 and 17: which value stands where, each behind a word of the dialog.
# The words are those of the control's language (`DEPTH`, `TIEFE` …): what a number means follows from its place. A word that
# is known and belongs to another place is refused, for then one of the two is wrong.

_MILLED = ("SETUP", "DEPTH", "PECKG PECKG:F")
#: By cycle, the addresses of the sub-blocks .1, .2, …; `PECKG:F` is the feed behind the infeed.
PLACES: dict[int, tuple[str, ...]] = {
    1: ("SETUP", "DEPTH", "PECKG", "DWELL", "F"), 2: ("SETUP", "DEPTH", "DWELL", "F"), 3: (*_MILLED, "X", "Y", "F"),
    4: (*_MILLED, "X", "Y", "F DR RADIUS"), 5: (*_MILLED, "RADIUS", "F DR"), 17: ("SETUP", "DEPTH", "PITCH"),
}  # fmt: skip


def values(cursor: Cursor, addresses: str) -> None:
    """The values of one sub-block, in any order where words tell them apart; those behind the first may be missing."""
    left = addresses.split()
    _value(cursor, left)
    while left and not cursor.done:
        _value(cursor, left)
    begin = cursor.blanks()
    if _MEANT.get(again := dialog(cursor), "-") in addresses:
        raise Fault(f"{again} stands twice", begin, len(again))
    cursor.at = begin


#: The readers of all these sub-blocks; axes have letters.
OBSOLETE_READERS: dict[str, Read] = {
    f"CYCL DEF {cycle}.{part}": Cursor.words if addresses in ("X", "Y") else partial(values, addresses=addresses)
    for cycle, places in PLACES.items()
    for part, addresses in enumerate(places, 1)
}


_COMPONENT = re.compile(r"(I[XYZ])(?=[ \t]*[-+\d.,Q])", FLAGS)


# How the sub-blocks of the cycles 0, 1, 3 and 4 are written, and G55, which is cycle 0 (TNC 620, 16.2, 16.3, 17.2, 17.3).
#     TCH PROBE 0.0 REF. PLANE Q5 X-          TCH PROBE 3.1 Q1
#     TCH PROBE 0.1 X+5 Y+0 Z-5               TCH PROBE 3.2 X ANGLE: +15
#     TCH PROBE 1.1 X ANGLE: +30              TCH PROBE 3.3 ABST +10 F100 MB1 REFERENCE SYSTEM: 0
#     TCH PROBE 4.2 IX-0.5 IY-1 IZ-1          TCH PROBE 3.4 ERRORMODE1
# Words such as ANGLE are those of the dialog, in its language: what the number behind them means follows from its place.

_RESULT = re.compile(r"Q[ \t]*(\d{1,4})(?!\d)", FLAGS)


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
    found = cursor.expect(_PROBE_SENSE, "the probing axis and its sense stand here: X+, X-, Y+, Y-, Z+ or Z-")
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
    after_dialog(cursor, "ANGLE", "probing angle")


def way(cursor: Cursor) -> None:
    """3.3, 4.3: how far, how fast, how far back, and the reference system behind words of the dialog."""
    while not cursor.done:
        begin = cursor.at
        if found := cursor.match(_WAY):
            name = found.group(1).upper()
            value = cursor.needed(f"{name} needs a number", begin, len(name))
            cursor.add("ABST" if name == "DIST" else name, value, begin)
        else:
            after_dialog(cursor, "SYSTEM", "reference system, 0 or 1")


_PLACE = re.compile(r"([XYZ])(?=[ \t]*[-+\d.,Q])", FLAGS)

_places = partial(numbers, pattern=_PLACE, fault="only X, Y and Z of the pre-position stand here, absolute")
PROBE_READERS: dict[str, Read] = {
    "TCH PROBE 0.0": plane_and_sense, "TCH PROBE 0.1": _places,
    "TCH PROBE 1.1": axis_and_angle, "TCH PROBE 1.2": _places,
    "TCH PROBE 3.1": result, "TCH PROBE 3.2": axis_and_angle, "TCH PROBE 3.3": way,
    "TCH PROBE 3.4": partial(after_dialog, address="ERRORMODE", meaning="error mode, 0 or 1"),
    "TCH PROBE 4.1": result, "TCH PROBE 4.3": way,
    "TCH PROBE 4.2": partial(numbers, pattern=_COMPONENT, fault="IX, IY and IZ stand here: the direction"),
}  # fmt: skip


#: By cycle, or by cycle and number of the sub-block; the others are known by their number alone.
READERS: dict[str, Read] = {
    **OBSOLETE_READERS,
    **PROBE_READERS,
    "CYCL DEF 7": datum_shift,
    "CYCL DEF 8": mirrored,
    "CYCL DEF 9.1": partial(after_dialog, address="DWELL", meaning="dwell in seconds"),
    "CYCL DEF 10": Cursor.words,
    "CYCL DEF 11": Cursor.words,
    "CYCL DEF 12": program_of_cycle,
    "CYCL DEF 13.1": partial(after_dialog, address="ANGLE", meaning="angle of the spindle"),
    "CYCL DEF 14": contour_labels,
    "CYCL DEF 18.1": partial(after_dialog, address="DEPTH", meaning="depth of the thread"),
    "CYCL DEF 18.2": partial(after_dialog, address="PITCH", meaning="pitch of the thread"),
    "CYCL DEF 19": tilting,
    "CYCL DEF 26": factors,
    "CYCL DEF 32.1": tolerance,
    "CYCL DEF 32.2": filters,
    "TCH PROBE 30.1": partial(after_dialog, address="HEIGHT", meaning="clearance height"),
    **{f"TCH PROBE {n}.1": checked for n in (31, 32, 33)},
    **{f"TCH PROBE {n}.2": partial(after_dialog, address="HEIGHT", meaning="clearance height") for n in (31, 32, 33)},
    **{f"TCH PROBE {n}.3": partial(after_dialog, address="PROBING THE TEETH", meaning="teeth, 0 or 1") for n in (31, 32, 33)},
}

#: By cycle, the addresses of the sub-blocks .1, .2, … as they are written; a datum shift has one for each axis.
LINES: dict[str, tuple[str, ...]] = {
    "CYCL DEF 7": tuple("XYZABC#"), "CYCL DEF 8": ("axes",), "CYCL DEF 10": ("ROT",), "CYCL DEF 11": ("SCL",),
    "CYCL DEF 12": ("PGM",), "CYCL DEF 14": ("LBL",), "CYCL DEF 19": ("A B C F ABST",),
    "CYCL DEF 26": ("X Y Z CCX CCY CCZ",),
    "TCH PROBE 0": ("X Y Z",), "TCH PROBE 1": ("axis ANGLE", "X Y Z"),
    "TCH PROBE 3": ("Q", "axis ANGLE", "ABST F MB SYSTEM", "ERRORMODE"), "TCH PROBE 4": ("Q", "IX IY IZ", "ABST F MB SYSTEM"),
    "TCH PROBE 30": ("HEIGHT",),
    **{f"TCH PROBE {n}": ("CHECK", "HEIGHT", "PROBING THE TEETH") for n in (31, 32, 33)},
}  # fmt: skip
_HEADS = {
    "axes": "", "axis": "", "LBL": "CONTOUR LABEL ", "SCL": "SCL ", "PGM": "PGM ", "SYSTEM": "REFERENCE SYSTEM: ",
    **{address: f"{address}: " for address in ("ANGLE", "CHECK", "HEIGHT", "PROBING THE TEETH")},
}  # fmt: skip
#: Addresses of touch probe cycles whose numbers have no sign.
UNSIGNED = ("Q", "F", "MB", "SYSTEM", "ERRORMODE", "CHECK", "PROBING THE TEETH")


def lines_of(code: str, title: str, words: Mapping[str, str]) -> Iterator[str]:
    """The lines of a definition, of the values that are there as they are written."""
    yield f"{code}.0 {title}"
    lines = [[a for a in ([part] if part in words else part.split()) if a in words] for part in LINES[code]]
    for number, addresses in enumerate(filter(None, lines), 1):
        yield f"{code}.{number} " + " ".join(_HEADS.get(address, address) + words[address] for address in addresses)


CODES = frozenset(f"CYCL DEF {cycle}" for cycle in PLACES)

#: What an address means, and its words in English and German programs; the first one is written.
NAMES: dict[str, tuple[str, ...]] = {
    "SETUP": ("set-up clearance", "SET UP", "ABST"), "DEPTH": ("depth", "DEPTH", "TIEFE"),
    "PECKG": ("infeed", "PECKG", "ZUSTLG"), "DWELL": ("dwell in seconds", "DWELL", "V.ZEIT"),
    "PITCH": ("pitch of the thread", "PITCH", "STEIG"), "RADIUS": ("radius", "RADIUS"), "F": ("feed rate", "F"),
    "DR": ("sense of rotation", "DR"),
}  # fmt: skip
_MEANT = {word.replace(" ", ""): address for address, (_, *words) in NAMES.items() for word in words}

_AUTO = re.compile(r"F[ \t]*AUTO(?![A-Z])", FLAGS)
_SENSE = re.compile(r"[ \t]*([+-])(?![ \t]*[\dQ.,])", FLAGS)


def _value(cursor: Cursor, left: list[str]) -> None:
    """One of the values that are `left`: that of a word that is known, else the next one."""
    begin, kinds = cursor.blanks(), [address.rpartition(":")[2] for address in left]
    if "F" in kinds and cursor.match(_AUTO):
        cursor.add(left.pop(kinds.index("F")), "FAUTO", begin)
        return
    word = dialog(cursor)
    kind = _MEANT.get(word, kinds[0])
    if kind not in kinds or (kind in ("F", "DR") and word not in ("", kind)):
        raise Fault(f"{word} stands where the {NAMES[kinds[0]][0]} belongs", begin, max(1, len(word)))
    address = left.pop(kinds.index(kind))
    if kind == "DR":
        sense = cursor.expect(_SENSE, "DR needs + or -")
        turning = 1.0 if sense.group(1) == "+" else -1.0  # no length, as DR is elsewhere
        cursor.builder.word(address, turning, begin, cursor.at - begin)
        return
    value = cursor.needed(f"a number is missing: the {NAMES[kind][0]}", begin, max(1, cursor.at - begin))
    cursor.add(address, value, begin)


def lines_of_obsolete(cycle: int, title: str, words: Mapping[str, str]) -> Iterator[str]:
    """The lines of a definition, of the values that are there as they are written."""
    yield f"CYCL DEF {cycle}.0 {title}"
    for part, addresses in enumerate(PLACES[cycle], 1):
        there = [(address.rpartition(":")[2], words[address]) for address in addresses.split() if address in words]
        if there:
            yield f"CYCL DEF {cycle}.{part} " + " ".join(NAMES.get(kind, ("", kind))[1] + text for kind, text in there)


_PROBE_SENSE = re.compile(r"([XYZ])[ \t]*([+-])(?![ \t]*[\d.,])", FLAGS)
_AXIS = re.compile(r"([XYZ])(?![A-Z\d+-])", FLAGS)
_WAY = re.compile(r"(ABST|DIST|F|MB)(?=[ \t]*[-+\d.,Q])", FLAGS)
_P01 = re.compile(r"P[ \t]*0?1[ \t]*(\d{1,4})(?!\d)", FLAGS)
_P02 = re.compile(r"P[ \t]*0?2[ \t]*([XYZ])[ \t]*P[ \t]*0?3[ \t]*([01])(?![\d.,])", FLAGS)


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
