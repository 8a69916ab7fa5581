"""How sub-blocks n.1, n.2 … of the older cycles are read: letters of axes, factors, and numbers behind a word.

The words in front of the numbers are those of the dialog, in its language (`DWELL`, `TEMP`, `ANGLE`, `UNGHI` …):
they are passed over, and what the number means follows from its place.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from functools import partial

from mnclab.controls.tnc_620.reading import obsolete_blocks, probe_blocks
from mnclab.controls.tnc_620.reading.dialog import dialog
from mnclab.controls.tnc_620.reading.labels import program_of_cycle
from mnclab.controls.tnc_620.reading.words import FLAGS, WHOLE, Cursor, Read, from_inches

#: A title: all before the numbers that is no sign of one, no name and no parameter.
_LABELS = re.compile(r'(?:(?!(?<![A-Z])Q[LRS]?\d)[^\d;~"+-]|[+-](?![ \t]*\d))*+', FLAGS)
_SLASH = re.compile(r"[ \t]*/")
_ROW = re.compile(r"#")
_LETTER = re.compile(r"[ \t]*([XYZUVWABC])(?![A-Z\d])", FLAGS)
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
        found = cursor.expect(_LETTER, "only letters of axes stand here, for example X Y")
        cursor.add("axes", found.group(1).upper(), begin)


def of_two_units(cursor: Cursor, lengths: re.Pattern[str]) -> None:
    """Words of which only those that begin so are in the unit of the program."""
    inch = cursor.inch
    try:
        while not cursor.done:
            cursor.inch = inch and lengths.match(cursor.text, cursor.at, cursor.stop) is not None
            cursor.word()
    finally:
        cursor.inch = inch


#: 26.1: a factor for each axis, which has no unit, and the coordinates of the centre.
factors = partial(of_two_units, lengths=re.compile(r"I?CC", FLAGS))


def tilting(cursor: Cursor) -> None:
    """19.1: angles, the feed of the rotary axes in degrees a minute, and a length behind a word (`ABST`, `DIST`, …)."""
    while not cursor.done:
        begin = cursor.at
        if found := cursor.match(_DISTANCE):
            name = found.group().rstrip()
            cursor.add("ABST", cursor.needed(f"{name} needs a number", begin, len(name)), begin)
        else:
            inch, cursor.inch = cursor.inch, False
            try:
                cursor.word()
            finally:
                cursor.inch = inch


def after_dialog(cursor: Cursor, address: str, meaning: str) -> None:
    """One number behind the words of the dialog and perhaps `=`."""
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


#: By cycle, or by cycle and number of the sub-block; the others are known by their number alone.
READERS: dict[str, Read] = {
    **obsolete_blocks.READERS,
    **probe_blocks.READERS,
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


def written(code: str, title: str, words: Mapping[str, str]) -> Iterator[str]:
    """The lines of a definition, of the values that are there as they are written."""
    yield f"{code}.0 {title}"
    lines = [[a for a in ([part] if part in words else part.split()) if a in words] for part in LINES[code]]
    for number, addresses in enumerate(filter(None, lines), 1):
        yield f"{code}.{number} " + " ".join(_HEADS.get(address, address) + words[address] for address in addresses)
