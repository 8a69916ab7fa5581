"""Which statements there are, and how the rest of each is read into words.

A statement is known by its keyword (``L``, ``TOOL CALL``, ``CYCL DEF 200``). What the control knows but nobody has built
is read by its keyword alone: the run refuses it by name where it stands.
"""

from __future__ import annotations

import re
from collections.abc import Callable
from typing import NamedTuple

from mnclab.controls.tnc_620 import sub_blocks
from mnclab.controls.tnc_620.words import FLAGS, NUMBER, TEXT, Cursor, Fault

Read = Callable[[Cursor], None]


class Statement(NamedTuple):
    """A statement that was recognized: its keyword, how to read its rest, and what may follow on further lines."""

    keyword: str
    read: Read
    more: Read | None = None
    """Reads a further line that has no block number; None when only a line ending in ~ can be continued."""
    part: int = -1
    """k of a sub-block n.k, -1 for everything else."""


def plain(cursor: Cursor) -> None:
    """Words alone."""
    cursor.words()


def ignored(cursor: Cursor) -> None:
    """Statements that are refused by their name are not read further."""
    cursor.at = cursor.stop


def with_radius(cursor: Cursor) -> None:
    """Words where R0 is a radius."""
    cursor.words(radius=True)


def with_axis(cursor: Cursor) -> None:
    """Words with a letter that names the tool axis."""
    cursor.words(bare="XYZUVW")


def leading(name: str) -> Read:
    """A number without an address, then words."""

    def read(cursor: Cursor) -> None:
        begin = cursor.blanks()
        value = cursor.value()
        if value is not None:
            cursor.add(name, value, begin)
        cursor.words()

    return read


def tool_call(cursor: Cursor) -> None:
    """Number or name of the tool, its axis, and words."""
    tool(cursor)
    with_axis(cursor)


def tool(cursor: Cursor) -> None:
    """A tool by number or by name in quotes; nothing if neither is there."""
    begin = cursor.blanks()
    if found := cursor.match(TEXT):
        cursor.add("tool", found.group(1).strip(), begin)
    elif (value := cursor.value()) is not None:
        cursor.add("tool", value, begin)


def tool_def(cursor: Cursor) -> None:
    """The tool, and its length and radius when no tool table is active."""
    tool(cursor)
    cursor.words(radius=True)


def label(cursor: Cursor) -> str:
    """The number or the name of a label; how a program calls it."""
    begin = cursor.blanks()
    if found := cursor.match(TEXT):
        cursor.add("label", found.group(1), begin)
        if not found.group(1).strip():
            raise Fault("the name of a label is empty", begin, cursor.at - begin)
        return f'"{found.group(1)}"'
    if found := cursor.match(_WHOLE):
        value = float(found.group(1))
        if value > 65535:
            raise Fault(f"a label must be a number from 0 to 65535, got {value:g}", begin, cursor.at - begin)
        cursor.add("label", value, begin)
        return f"{value:g}"
    raise Fault("a label must be a whole number or a name in quotes", begin, hint='for example LBL 1 or LBL "HOLES"')


def set_label(cursor: Cursor) -> None:
    """LBL: a jump target; LBL 0 is an end and none."""
    begin = cursor.blanks()
    name = label(cursor)
    builder = cursor.builder
    if name in builder.labels:
        raise Fault(f"LBL {name} is set twice", begin, cursor.at - begin, "a label stands for one place in the program")
    if name != "0":
        builder.labels[name] = builder.blocks[-1][0]
    refuse_rest(cursor)


def call_label(cursor: Cursor) -> None:
    """CALL LBL: the label, and how often a section is repeated; of n/n the second counts down while it runs."""
    label(cursor)
    begin = cursor.blanks()
    if found := cursor.match(_REPEAT):
        cursor.add("REP", float(found.group(1)), begin)
    refuse_rest(cursor)


def refuse_rest(cursor: Cursor) -> None:
    """Nothing may follow."""
    if not cursor.done:
        raise cursor.unexpected()


def program_name(cursor: Cursor) -> None:
    """BEGIN PGM and END PGM: name and unit."""
    begin = cursor.blanks()
    parts = cursor.rest().rsplit(None, 1)
    if not parts or parts[-1].upper() not in ("MM", "INCH"):
        cursor.at = cursor.stop
        raise Fault(
            "the unit of the program is missing: MM or INCH must follow its name", begin, max(1, len(" ".join(parts)))
        )
    unit_at = begin + cursor.rest().rindex(parts[-1])
    if len(parts) == 2:
        cursor.at = begin + len(parts[0])
        cursor.add("name", parts[0], begin)
    cursor.at = unit_at + len(parts[-1])
    cursor.add("unit", parts[-1].upper(), unit_at)
    cursor.at = cursor.stop


def assignment(target: str, begin: int) -> Read:
    """The formula of ``Q1 = …``; its target was read already."""

    def read(cursor: Cursor) -> None:
        formula(cursor, target, begin)

    return read


def formula(cursor: Cursor, target: str, begin: int, shape: re.Pattern[str] | None = None, form: str = "") -> None:
    """A Q parameter takes the value of a formula."""
    number = int(re.sub(r"\D", "", target))
    if number > (1999 if target[1].isdigit() else 499):
        raise Fault(
            f"{target} does not exist: Q0 to Q1999, QL0 to QL499 and QR0 to QR499 are allowed", begin, len(target)
        )
    cursor.builder.word("target", target, begin, len(target))
    start = cursor.blanks()
    if cursor.done:
        raise Fault(f"{target} = needs a value", start)
    if shape and not shape.fullmatch(cursor.rest().strip()):
        raise Fault(f"the function must have the form {form}", start, len(cursor.rest().rstrip()))
    expression = cursor.expression(start, cursor.stop)
    cursor.at = cursor.stop
    cursor.add("value", expression, start)


_OPERAND = rf"[+-]?\s*(?:{NUMBER}|Q[LR]?\d+)"
_SHAPES = {
    0: (rf"{_OPERAND}", "FN 0: Q1 = +2"),
    1: (rf"{_OPERAND}\s*\+\s*{_OPERAND}", "FN 1: Q1 = +2 + +3"),
    2: (rf"{_OPERAND}\s*-\s*{_OPERAND}", "FN 2: Q1 = +2 - +3"),
    3: (rf"{_OPERAND}\s*\*\s*{_OPERAND}", "FN 3: Q1 = +2 * +3"),
    4: (rf"{_OPERAND}\s*(?:DIV|/)\s*{_OPERAND}", "FN 4: Q1 = +2 DIV +3"),
    5: (rf"SQRT\s*{_OPERAND}", "FN 5: Q1 = SQRT +2"),
}
FN_SHAPES = {number: (re.compile(pattern, FLAGS), form) for number, (pattern, form) in _SHAPES.items()}


def fn(number: int) -> Read:
    """FN 0 to FN 5: one operation each; the others are refused by their name."""
    if number not in FN_SHAPES:
        return ignored

    def read(cursor: Cursor) -> None:
        begin = cursor.blanks()
        found = cursor.match(_TARGET)
        if found is None:
            raise Fault(f"FN {number} needs a Q parameter and =", begin, hint=FN_SHAPES[number][1])
        formula(cursor, _name(found), begin, *FN_SHAPES[number])

    return read


# --- cycles -----------------------------------------------------------------------------------------------------------


def cycle_parameters(cursor: Cursor) -> None:
    """Lines ``Q200=+2``; a name before the first of them is a comment in the language of the dialog."""
    builder = cursor.builder
    if not any(name.startswith("Q") for name in _addresses(cursor)):
        first = _PARAMETER_HEAD.search(cursor.text, cursor.at, cursor.stop)
        cursor.at = first.start() if first else cursor.stop
    while not cursor.done:
        begin = cursor.at
        found = cursor.match(_PARAMETER_HEAD)
        if found is None:
            raise cursor.unexpected()
        name = f"Q{(found.group(1) or '').upper()}{found.group(2)}"
        value: object = None
        if text := cursor.match(TEXT):
            value = text.group(1)
        elif word := cursor.match(_FEED_WORD):
            value = re.sub(r"[ \t]", "", word.group()).upper().replace(",", ".")
        else:
            value = cursor.value()
        if value is None:
            raise Fault(f"{name} needs a number", begin, found.end() - begin)
        builder.word(name, value, begin, cursor.at - begin)


def _addresses(cursor: Cursor) -> list[str]:
    """Addresses of the words that the block has so far."""
    names = list(cursor.builder.addresses)
    return [names[word[0]] for word in cursor.builder.words[cursor.builder.blocks[-1][4] :]]


def contour_labels(cursor: Cursor) -> None:
    """14.1: the numbers of the labels, ``1/2/3/4``, after a word in the language of the dialog."""
    cursor.match(_DIALOG)
    while not cursor.done:
        cursor.match(_SLASH)
        begin = cursor.blanks()
        found = cursor.match(_WHOLE)
        if found is None:
            raise Fault("a contour label must be a whole number", begin)
        cursor.add("LBL", float(found.group(1)), begin)


def datum_shift(cursor: Cursor) -> None:
    """7.1 …: axis words, or the row of a datum table."""
    begin = cursor.blanks()
    if cursor.match(_ROW):
        value = cursor.value()
        if value is None:
            raise Fault("# needs the number of a row", begin)
        cursor.add("#", value, begin)
    cursor.words()


#: How sub-blocks n.1, n.2 … are read; the others are known by their number alone.
PARTS: dict[str, Read] = {
    "CYCL DEF 7": datum_shift,
    **sub_blocks.READERS,
    "CYCL DEF 10": plain,
    "CYCL DEF 11": plain,
    "CYCL DEF 14": contour_labels,
}


def definition(keyword: str, part: int) -> Statement:
    """CYCL DEF and TCH PROBE in both formats."""
    if part < 0:
        return Statement(keyword, cycle_parameters, cycle_parameters)
    if part == 0:
        return Statement(keyword, ignored, None, 0)
    read = PARTS.get(f"{keyword}.{part}", PARTS.get(keyword, ignored))
    return Statement(keyword, read, read, part)


# --- recognizing ------------------------------------------------------------------------------------------------------

_FORMS = "LT LN CT LCT PLT PLN PCT PLCT".split()
WORDS: dict[str, Read] = {
    "L": plain, "CC": plain, "C": plain, "CT": plain, "LP": plain, "CP": plain, "CTP": plain, "CR": with_radius,
    "RND": with_radius, "CHF": leading("length"), "FPOL": plain, "FL": plain, "FLT": plain, "FC": with_radius,
    "FCT": with_radius, "FSELECT": leading("number"), "STOP": plain, "CYCL CALL POS": plain, "CYCL CALL PAT": plain,
    "CYCL CALL": plain, "LBL": set_label, "CALL LBL": call_label, "TOOL CALL": tool_call, "TOOL DEF": tool_def,
    "SEL TABLE": sub_blocks.table_name,
    "BEGIN PGM": program_name, "END PGM": program_name, "BLK FORM 0.1": with_axis, "BLK FORM 0.2": plain,
    **{f"{way} {form}": plain for way in ("APPR", "DEP") for form in _FORMS},
}  # fmt: skip

#: Statements whose rest is not read: keyword -> whether further lines without a number belong to them.
KEYWORDS_ONLY = {
    "BLK FORM": False, "CALL PGM": False, "SEL PATTERN": False, "SEL CONTOUR": False, "SEL PGM": False,
    "CALL SELECTED PGM": False, "DECLARE CONTOUR": True, "CONTOUR DEF": True, "PATTERN DEF": True, "PLANE": False,
    "FUNCTION": False, "TRANS DATUM": False, "APPR": False, "DEP": False,
}  # fmt: skip

_ALL = sorted([*WORDS, *KEYWORDS_ONLY], key=len, reverse=True)
_KEYWORD = re.compile(f"(?:{'|'.join(re.escape(k) for k in _ALL)})(?![A-Z_])".replace(r"\ ", r"[ \t]+"), FLAGS)
_CYCLE = re.compile(
    r"(CYCL[ \t]+DEF|TCH[ \t]+PROBE|GLOBAL[ \t]+DEF)[ \t]*(?:(\d{1,5})(?:\.(\d{1,2}))?(?![.\d]))?", FLAGS
)
_FN = re.compile(r"FN[ \t]*(\d{1,3})[ \t]*:?", FLAGS)
_TARGET = re.compile(r"Q([LRSC]?)[ \t]?(\d{1,6})[ \t]*=", FLAGS)
_M = re.compile(r"M[ \t]*\d", FLAGS)
_WHOLE = re.compile(r"[ \t]*(\d{1,9})(?![\d.,])", FLAGS)
_REPEAT = re.compile(r"REP[ \t]*(\d{1,9})(?:[ \t]*/[ \t]*\d{1,9})?", FLAGS)
_PARAMETER_HEAD = re.compile(r"[ \t]*\bQ([LRS]?)[ \t]*(\d{1,4})[ \t]*=[ \t]*", FLAGS)
_FEED_WORD = re.compile(rf"[ \t]*(?:F[ \t]*(?:AUTO|MAX)|F[UZ][ \t]*{NUMBER}|PREDEF)(?![A-Z])", FLAGS)
_DIALOG = re.compile(r"[^\d;~]*")
_SLASH = re.compile(r"[ \t]*/")
_ROW = re.compile(r"#")


def _name(found: re.Match[str]) -> str:
    return f"Q{found.group(1).upper()}{int(found.group(2))}"


def recognize(cursor: Cursor) -> Statement | None:
    """The statement that begins here, or None; the cursor then stands behind its keyword."""
    if found := cursor.match(_CYCLE):
        return _cycle(cursor, found)
    if found := cursor.match(_KEYWORD):
        keyword = " ".join(found.group().upper().split())
        if keyword in KEYWORDS_ONLY:
            return _known_by_name(cursor, keyword, found.start())
        return Statement(keyword, WORDS[keyword])
    if found := cursor.match(_FN):
        number = int(found.group(1))
        return Statement(f"FN {number}", fn(number))
    begin = cursor.at
    if found := cursor.match(_TARGET):
        kind = found.group(1).upper()
        if kind in ("S", "C"):
            return Statement(f"Q{kind}", ignored)
        return Statement("Q", assignment(_name(found), begin))
    if _M.match(cursor.text, cursor.at, cursor.stop):
        return Statement("", plain)
    return None


def _known_by_name(cursor: Cursor, keyword: str, begin: int) -> Statement:
    """A statement whose rest is not read; its form is part of the name."""
    form = cursor.rest().split()[:1]
    if keyword in ("APPR", "DEP"):
        raise Fault(f"{keyword} must be followed by one of {', '.join(_FORMS)}", begin, cursor.at - begin)
    if form and keyword in ("BLK FORM", "PLANE", "FUNCTION"):
        keyword = f"{keyword} {form[0].upper()}"
    return Statement(keyword, ignored, ignored if KEYWORDS_ONLY.get(keyword) else None)


def _cycle(cursor: Cursor, found: re.Match[str]) -> Statement:
    word = " ".join(found.group(1).upper().split())
    if found.group(2) is None:
        raise Fault(f"{word} needs the number of a cycle", cursor.at)
    part = -1 if found.group(3) is None else int(found.group(3))
    return definition(f"{word} {int(found.group(2))}", part)
