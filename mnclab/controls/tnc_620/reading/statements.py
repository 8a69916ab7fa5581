"""Which statements there are, and how the rest of each is read into words.

A statement is known by its keyword (`L`, `TOOL CALL`, `CYCL DEF 200`). What the control knows but nobody has built
is read by its keyword alone: the run refuses it by name where it stands.
"""

from __future__ import annotations

import re
from collections.abc import Callable
from functools import partial
from typing import NamedTuple

from mnclab.controls.tnc_620.reading import definitions, labels
from mnclab.controls.tnc_620.reading.definitions import PatternWords
from mnclab.controls.tnc_620.reading.formulas import FILES, FN, assignment, declared_text, text_assignment, text_formula
from mnclab.controls.tnc_620.reading.sub_blocks import READERS
from mnclab.controls.tnc_620.reading.words import FLAGS, NUMBER, SIGNED, TEXT, Cursor, Fault, Read


class Statement(NamedTuple):
    """A statement that was recognized: its keyword, how to read its rest, and what may follow on further lines."""

    keyword: str
    read: Read
    more: Read | None = None  # reads a further line without a block number; None: only a line ending in ~ goes on
    part: int = -1  # k of a sub-block n.k


plain: Read = Cursor.words
with_radius: Read = partial(Cursor.words, radius=True)  # R0 is a radius
with_axis: Read = partial(Cursor.words, bare="XYZUVW")  # a letter names the tool axis


def ignored(cursor: Cursor) -> None:
    """Statements that are refused by their name are not read further."""
    cursor.at = cursor.stop


def leading(cursor: Cursor, name: str) -> None:
    """A number without an address, then words."""
    begin = cursor.blanks()
    if (value := cursor.value()) is not None:
        cursor.add(name, value, begin)
    cursor.words()


def tool(cursor: Cursor, words: Read) -> None:
    """Perhaps a tool by number, by name in quotes or in a text parameter, then words."""
    begin = cursor.blanks()
    if found := cursor.match(TEXT):
        cursor.add("tool", found.group(1).strip(), begin)
    elif found := cursor.match(_TEXT_PARAMETER):
        cursor.add("text", f"QS{int(found.group(1))}", begin)
    elif (value := cursor.value()) is not None:
        cursor.add("tool", value, begin)
    words(cursor)


def turned_blank(cursor: Cursor) -> None:
    """The axis, DIM_R or DIM_D, and the label of the half section."""
    begin, example = cursor.blanks(), "for example BLK FORM ROTATION Z DIM_R LBL 1"
    if found := cursor.match(_AXIS):
        cursor.add("axis", found.group().upper(), begin)
    begin = cursor.blanks()
    found = cursor.expect(_DIM, "DIM_R (radii) or DIM_D (diameters) is missing", example)
    cursor.add("DIM", found.group(1).upper(), begin)
    cursor.expect(_LBL, "LBL, the label of the contour, is missing", example)
    labels.label(cursor, parameter=True)


def program_name(cursor: Cursor) -> None:
    """BEGIN PGM: name and unit."""
    begin = cursor.blanks()
    *name, unit = cursor.rest().rsplit(None, 1) or [""]
    if unit.upper() not in UNITS:
        cursor.at = cursor.stop
        what = "the unit of the program is missing: MM or INCH must follow its name"
        raise Fault(what, begin, max(1, len(" ".join((*name, unit)))))
    if name:
        cursor.at = begin + len(name[0])
        cursor.add("name", name[0], begin)
    at = cursor.text.rindex(unit, begin, cursor.stop)
    cursor.at = at + len(unit)
    cursor.add("unit", unit.upper(), at)
    cursor.at = cursor.stop


def program_end(cursor: Cursor) -> None:
    """END PGM: name and unit, which say again what BEGIN PGM says; without them the program ends all the same."""
    begin, words = cursor.blanks(), cursor.rest().split()
    if words and words[-1].upper() in UNITS:
        program_name(cursor)
        return
    what = "END PGM has no unit: " if words else "END PGM has neither name nor unit: "
    cursor.builder.alarm(f"{what}the program ends here", begin, max(1, len(cursor.rest())), UNIT_OF_END, "warning")
    cursor.at = cursor.stop
    if words:
        cursor.add("name", words[0], begin)


def file_name(cursor: Cursor) -> None:
    """The name of a file, in quotes or up to the end of the line."""
    begin = cursor.blanks()
    if found := cursor.match(TEXT):
        name = found.group(1).strip()
    else:
        name, cursor.at = cursor.rest().strip(), cursor.stop
    if not name:
        raise Fault("the name of a file is missing", begin, hint='for example SEL PATTERN "HOLES"')
    cursor.add("file", name, begin)


def cycle_parameters(cursor: Cursor) -> None:
    """Lines `Q200=+2`; a name before the first of them is a comment in the language of the dialog."""
    builder = cursor.builder
    names = list(builder.addresses)
    if not any(names[word[0]].startswith("Q") for word in builder.block_words):
        first = _PARAMETER_HEAD.search(cursor.text, cursor.at, cursor.stop)
        passed_over(cursor, first.start() if first else cursor.stop)
    while not cursor.done:
        begin = cursor.at
        found = cursor.match(_PARAMETER_HEAD)
        if found is None:
            raise without_equals(cursor)
        name = f"Q{(found.group(1) or '').upper()}{found.group(2)}"
        if "=" not in found.group():
            message = f"{name} has no = before its feed: it is read as {name}="
            builder.alarm(message, begin, cursor.at - begin, f"write {name}= before the word", "warning")
        value: object
        if text := cursor.match(TEXT):
            value = text.group(1)
        elif named := cursor.match(_STRING):
            value = text_formula(cursor, named.start(), named.end())
        elif word := cursor.match(_FEED_WORD):
            value = re.sub(r"[ \t]", "", word.group()).upper().replace(",", ".")
            value = f"F{value}" if value in ("AUTO", "MAX") else value
        elif bare := cursor.match(_PER):
            per = bare.group().strip().upper()
            hint = f"{per} is the feed per {PER[per]}: write for example {name}={per}0.1"
            raise Fault(f"{name}={per} needs its value", begin, cursor.at - begin, hint)
        else:
            value = cursor.needed(f"{name} needs a number", begin, found.end() - begin)
        builder.word(name, value, begin, cursor.at - begin)


def without_equals(cursor: Cursor) -> Fault:
    """What is wrong where no parameter of a cycle stands: `Q210 +0` lacks its =."""
    if found := _PARAMETER.match(cursor.text, cursor.at, cursor.stop):
        name = found.group().upper()
        if value := SIGNED.match(cursor.text, found.end(), cursor.stop):
            hint = f"write {name}={value.group().strip()}"
            return Fault(f"{name} has no = before its value", cursor.at, value.end() - cursor.at, hint)
    return cursor.unexpected()


def like_a_block(text: str, begin: int, stop: int) -> bool:
    """Whether a word there looks like one of a block, a parameter or a jump."""
    return bool(_LIKE_A_WORD.search(text, begin, stop) or _LIKE_A_STATEMENT.search(text, begin, stop))


def passed_over(cursor: Cursor, stop: int | None = None, what: str = "the cycle's name") -> None:
    """A name or a remark is free; what looks like a word in it would be lost, which is said."""
    stop = cursor.stop if stop is None else stop
    for found in _LIKE_A_WORD.finditer(cursor.text, cursor.at, stop):
        message = f"{found.group()} is read as part of {what} and not obeyed"
        cursor.builder.alarm(message, found.start(), len(found.group()), severity="warning")
    cursor.at = stop


def waiting(cursor: Cursor) -> None:
    """FUNCTION DWELL: TIME in seconds or REV in turns of the spindle."""
    begin = cursor.blanks()
    found = cursor.expect(_WAIT, "FUNCTION DWELL needs TIME or REV", "for example FUNCTION DWELL TIME10")
    name = found.group().strip().upper()
    cursor.add(name, cursor.needed(f"{name} needs a number", begin, len(name)), begin)


def plane(cursor: Cursor) -> None:
    """PLANE: angles, vectors or points, and how the rotary axes behave."""
    while not cursor.done:
        begin = cursor.at
        if found := cursor.match(_BEHAVIOUR):
            cursor.match(_FAR)
            cursor.add(found.group().upper(), cursor.value(), begin)
        elif found := cursor.match(_CHOICE):
            name, sign = found.group().upper().split()[0].rstrip("+-"), found.group()[-1]
            cursor.add(name, sign if sign in "+-" else None, begin)
        elif found := cursor.match(_MEASURE):
            name = found.group().strip().upper()
            cursor.add(name, cursor.needed(f"{name} needs a number", begin, len(name)), begin)
        else:
            cursor.word()


def led(cursor: Cursor) -> None:
    """FUNCTION TCPM: F TCP or F CONT, AXIS POS or AXIS SPAT, PATHCTRL, REFPNT, each with its word."""
    while not cursor.done:
        begin = cursor.at
        found = cursor.expect(_LED, "F TCP, AXIS POS, PATHCTRL AXIS and REFPNT TIP-TIP stand here, or others of their words")
        name, value = found.group().upper().split()
        cursor.add(f"TCPM:{name}", value, begin)


UNITS = ("MM", "INCH")
UNIT_OF_END = "END PGM says again the name and the unit, for example END PGM PART MM"
PER = {"FU": "revolution", "FZ": "tooth"}
_FORMS = "LT LN CT LCT PLT PLN PCT PLCT".split()
WORDS: dict[str, Read] = {
    "L": plain, "CC": plain, "C": plain, "CT": plain, "LP": plain, "CP": plain, "CTP": plain, "CR": with_radius,
    "RND": with_radius, "CHF": partial(leading, name="length"), "FPOL": plain, "FL": plain, "FLT": plain, "FC": with_radius,
    "FCT": with_radius, "FSELECT": partial(leading, name="number"), "STOP": plain, "CYCL CALL POS": plain, "CYCL CALL PAT": plain,
    "CYCL CALL": plain, "LBL": labels.set_label, "CALL LBL": labels.call_label, "CALL PGM": labels.name_of_program,
    "SEL PGM": labels.select_program, "CALL SELECTED PGM": plain,
    "TOOL CALL": partial(tool, words=with_axis), "TOOL DEF": partial(tool, words=with_radius),
    "DECLARE STRING": declared_text, "SEL PATTERN": file_name, "SEL TABLE": file_name,
    "PATTERN DEF": plain, "DECLARE CONTOUR": plain, "CONTOUR DEF": plain,  # whose lines LINES read
    "SEL CONTOUR": definitions.selected,
    "BEGIN PGM": program_name, "END PGM": program_end, "BLK FORM 0.1": with_axis, "BLK FORM 0.2": plain,
    **{f"PLANE {form}": plane for form in "RESET SPATIAL PROJECTED EULER VECTOR POINTS RELATIV AXIAL".split()},
    "TRANS DATUM AXIS": plain, "TRANS DATUM RESET": plain,
    "FUNCTION RESET TCPM": plain, "FUNCTION TCPM": led, "FUNCTION DWELL": waiting,
    "BLK FORM CYLINDER": with_axis, "BLK FORM ROTATION": turned_blank,
    **{f"{way} {form}": plain for way in ("APPR", "DEP") for form in _FORMS},
}  # fmt: skip

#: Statements of several lines that go on anywhere between two words.
LINES: dict[str, Callable[[], Read]] = {
    "PATTERN DEF": PatternWords, "DECLARE CONTOUR": definitions.DeclaredWords, "CONTOUR DEF": definitions.PartWords,
}  # fmt: skip
#: Statements whose rest is not read: keyword -> whether further lines without a number belong to them.
KEYWORDS_ONLY = {
    "BLK FORM": False, "PLANE": False, "FUNCTION": False, "TRANS DATUM": False, "APPR": False, "DEP": False,
}  # fmt: skip

_ALL = sorted([*WORDS, *KEYWORDS_ONLY], key=len, reverse=True)
_KEYWORD = re.compile(
    f"(?:{'|'.join(re.escape(k) for k in _ALL)})(?![A-Z_])".replace(r"\ ", r"[ \t]+").replace("CYCL", "CYCLE?"), FLAGS
)
_CYCLE = re.compile(
    r"(CYCLE?[ \t]+DEF|TCH[ \t]+PROBE|GLOBAL[ \t]+DEF)[ \t]*(?:(\d{1,5})(?:[ \t]*\.(\d{1,2}))?(?![.\d]))?", FLAGS
)
_FN = re.compile(r"FN[ \t]*(\d{1,3})[ \t]*:?", FLAGS)
_TARGET = re.compile(r"Q([LRSC]?)[ \t]?(\d{1,6})[ \t]*=", FLAGS)
_SIGNED = re.compile(r"Q[LRSC]?[ \t]?([+-][ \t]?\d{1,6})[ \t]*=", FLAGS)
_M = re.compile(r"M[ \t]*\d", FLAGS)
_FEED = rf"[ \t]*(?:(?:F[ \t]*)?(?:AUTO|MAX)|F[UZ][ \t]*{NUMBER}|PREDEF)(?![A-Z])"
_PARAMETER = re.compile(r"Q[LRS]?[ \t]*\d{1,4}(?!\d)", FLAGS)
_PARAMETER_HEAD = re.compile(rf"\bQ([LRS]?)[ \t]*(\d{{1,4}})(?:[ \t]*=[ \t]*|(?={_FEED}))", FLAGS)
_FEED_WORD = re.compile(_FEED, FLAGS)
_PER = re.compile(r"[ \t]*F[UZ](?![A-Z])", FLAGS)
_AXIS = re.compile(r"[A-Z](?![A-Z])", FLAGS)
_DIM = re.compile(r"DIM_([RD])(?![A-Z])", FLAGS)
_LBL = re.compile(r"[ \t]*LBL(?![A-Z])", FLAGS)
_STRING = re.compile(r"[ \t]*QS[ \t]*\d{1,4}", FLAGS)
#: A coordinate, another number with a sign, an M function, a feed, a speed.
_LIKE_A_WORD = re.compile(
    r"(?<![\w.-])(?:I?[XYZUVWABC][+-]?\d|[A-Z]{1,4}[+-]\d|[MFS]\d|FMAX|R[0LR]\b)(?:[\d.,]*\d)?", FLAGS
)
_LIKE_A_STATEMENT = re.compile(r"=|(?<![A-Z])(?:Q[LRS]?\d|(?:GOTO|LBL|CALL|PGM|DEF)(?![A-Z]))", FLAGS)
_WAIT = re.compile(r"(?:TIME|REV)[ \t]*(?![A-PR-Z])", FLAGS)
_BEHAVIOUR = re.compile(r"(?:STAY|MOVE|TURN)(?![A-Z])|MB(?=[ \t]*MAX(?![A-Z])|(?![A-Z]))", FLAGS)
_FAR = re.compile(r"(?<=MB)[ \t]*MAX(?![A-Z])", FLAGS)
_CHOICE = re.compile(r"(?:SEQ|SYM)[ \t]*[+-]|(?:TABLE|COORD)[ \t]+ROT(?![A-Z])", FLAGS)
_MEASURE = re.compile(
    r"(?:ABST|DIST|SP[ABC]|PROPR|PROMIN|ROT|EULPR|EULNU|EULROT|[BN][XYZ]|P[123][XYZ])[ \t]*(?![A-PR-Z])", FLAGS
)
_LED = re.compile(
    r"(?:F[ \t]+(?:TCP|CONT)|AXIS[ \t]+(?:POS|SPAT)|PATHCTRL[ \t]+(?:AXIS|VECTOR)"
    r"|REFPNT[ \t]+(?:TIP|CENTER)-(?:TIP|CENTER))(?![A-Z-])", FLAGS
)  # fmt: skip
_TEXT_PARAMETER = re.compile(r"QS[ \t]?(\d{1,4})(?!\d)", FLAGS)


def recognize(cursor: Cursor) -> Statement | None:
    """The statement that begins here, or None; the cursor then stands behind its keyword."""
    if found := cursor.match(_CYCLE):
        return _cycle(cursor, found)
    if found := cursor.match(_KEYWORD):
        keyword = " ".join(found.group().upper().split()).replace("CYCLE", "CYCL")
        if keyword in KEYWORDS_ONLY:
            return _known_by_name(cursor, keyword, found.start())
        if keyword in LINES:
            elements = LINES[keyword]()
            return Statement(keyword, elements, elements)
        return Statement(keyword, WORDS[keyword])
    if found := cursor.match(_FN):
        number = int(found.group(1))
        return Statement(f"FN {number}", FN.get(number) or labels.JUMPS.get(number) or FILES.get(number) or ignored)
    begin = cursor.at
    if found := cursor.match(_TARGET):
        kind = found.group(1).upper()
        if kind == "C":
            return Statement("QC", definitions.FormulaWords(int(found.group(2)), begin, found.end() - begin))
        name = f"Q{kind}{int(found.group(2))}"
        return Statement("QS", text_assignment(name, begin)) if kind == "S" else Statement("Q", assignment(name, begin))
    if found := cursor.match(_SIGNED):
        what = "the number of a parameter, or of a contour, has no sign"
        raise Fault(what, found.start(1), len(found.group(1)), "for example QC10 =")
    if _M.match(cursor.text, cursor.at, cursor.stop):
        return Statement("", plain)
    return None


def _known_by_name(cursor: Cursor, keyword: str, begin: int) -> Statement:
    """A statement whose rest is not read; its form is part of the name."""
    form = cursor.rest().split()[:1]
    if keyword in ("APPR", "DEP"):
        known = _FORMS if keyword == "APPR" else [form for form in _FORMS if form not in ("PLT", "PLN", "PCT")]
        raise Fault(f"{keyword} must be followed by one of {', '.join(known)}", begin, cursor.at - begin)
    if form and keyword in ("BLK FORM", "PLANE", "FUNCTION"):
        keyword = f"{keyword} {form[0].upper()}"
    return Statement(keyword, ignored, ignored if KEYWORDS_ONLY.get(keyword) else None)


def _cycle(cursor: Cursor, found: re.Match[str]) -> Statement:
    """A definition in either format: parameters below it, or sub-blocks n.0, n.1, …"""
    word = " ".join(found.group(1).upper().split()).replace("CYCLE", "CYCL")
    if found.group(2) is None:
        raise Fault(f"{word} needs the number of a cycle", cursor.at)
    keyword = f"{word} {int(found.group(2))}"
    if found.group(3) is None:
        return Statement(keyword, cycle_parameters, cycle_parameters)
    part = int(found.group(3))
    if part == 0:
        return Statement(keyword, READERS.get(f"{keyword}.0", passed_over), None, 0)
    read = READERS.get(f"{keyword}.{part}", READERS.get(keyword, ignored))
    return Statement(keyword, read, read, part)
