"""What a DIN/ISO program says beside motion: G functions that are statements, D00 to D38, and how alarms are worded."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping, Sequence
from functools import partial
from typing import NamedTuple

from mnclab.controls.tnc_620.reading import labels
from mnclab.controls.tnc_620.reading.din_motion import AXES, PLANES
from mnclab.controls.tnc_620.reading.din_words import Given, put, unmixed
from mnclab.controls.tnc_620.reading.formulas import FILES, FN, OPERAND, add_target, system_data
from mnclab.controls.tnc_620.reading.sub_blocks import PLACES
from mnclab.controls.tnc_620.reading.words import FLAGS, ISO_NAMES, Cursor, Fault
from mnclab.text.alarm import ALARM, Alarm
from mnclab.text.expression import Expression, Token
from mnclab.text.program import Block, Program

# The functions D00 to D38 of DIN/ISO programs, which are FN 0 to FN 38: `D01 Q1 P01 +Q2 P02 +5`.
# The parameters P01, P02 … stand for the operands in their order. Text of the conversational form (`D18 SYSREAD Q1 = …`)
# is read as such.

FUNCTION = re.compile(r"D[ \t]*(\d{1,3})(?![\d.,])[ \t]*:?", FLAGS)
_OPERAND_MARKS = {number: re.compile(rf"[ \t]*P[ \t]*(?:0{number}|{number}(?![\d.,]))", FLAGS) for number in (1, 2, 3)}
_Q = re.compile(r"Q([LR]?)[ \t]?(\d{1,6})(?!\d)", FLAGS)
_EQUALS = re.compile(r"[ \t]*=", FLAGS)
_ANY_P, _POINTS = re.compile(r"[ \t]*P[ \t]*\d\d?(?![\d.,])", FLAGS), re.compile(r"[ \t]*Q[ \t]?(\d{1,6})(?!\d)", FLAGS)
_CONVERSATIONAL = re.compile(r"SYSREAD|SYSWRITE|ERROR|PRESET|(?:F-)?PRINT|IF(?![A-Z])", FLAGS)

OPERATORS = {1: "+", 2: "-", 3: "*", 4: "DIV"}
NAMES = {5: "SQRT", 6: "SIN", 7: "COS"}
TWO = {8: ("first", "second"), 13: ("first", "second")}


def function(cursor: Cursor, number: int, begin: int) -> None:
    """The words of a function; its number was read already, at `begin`."""
    if number in FILES and number != 15:
        cursor.match(_OPERAND_MARKS[1])  # before the words of the dialog
    if _CONVERSATIONAL.match(cursor.text, cursor.at, cursor.stop):
        _as_conversational(cursor, number)
    elif number in (*range(9), 13):
        _calculation(cursor, number)
    elif number in labels.JUMPS:
        _jump(cursor, number)
    elif number == 14:
        _operand(cursor, number, 1, "number")
    elif number in (17, 18):
        _system(cursor, number)
    elif number == 15 and not cursor.done:
        while cursor.match(_ANY_P):
            _item(cursor, number, "item")
    elif number in (23, 24):
        _target(cursor, number)
        begin = _parameter(cursor, number, 1)
        found = cursor.expect(_POINTS, "P01 needs the Q parameter with the first point", f"for example {example(number)}")
        cursor.add("points", f"Q{int(found.group(1))}", begin)
    elif number in FN or number in FILES:
        _as_conversational(cursor, number)
    else:
        cursor.at = cursor.stop  # to the PLC, or refused by its name


def _as_conversational(cursor: Cursor, number: int) -> None:
    """A function in the words of the dialog; its faults are told under the name that stands here."""
    read = FN.get(number) or FILES.get(number) or labels.JUMPS.get(number)
    if read is None:
        raise cursor.unexpected()
    told(cursor, read, f"FN {number}", f"D{number:02}")


def told(cursor: Cursor, read: Callable[[Cursor], object], name: str, by: str) -> None:
    """What reads words of the dialog; its faults have another name for what these programs write otherwise."""
    try:
        read(cursor)
    except Fault as fault:
        message, hint = (part.replace(name, by) for part in (fault.message, fault.hint))
        raise Fault(message, fault.offset, fault.length, hint) from None


def _parameter(cursor: Cursor, number: int, which: int) -> int:
    """Pass over P01, P02 or P03; the place where it stands."""
    begin = cursor.blanks()
    if cursor.match(_OPERAND_MARKS[which]) is None:
        raise Fault(f"D{number:02} needs P{which:02}", min(begin, cursor.stop - 1), hint=f"for example {example(number)}")
    return begin


def _value(cursor: Cursor, number: int) -> Expression:
    begin = min(cursor.blanks(), cursor.stop - 1)
    found = cursor.match(OPERAND)
    if found is None:
        raise Fault("a number or a Q parameter was expected", begin, hint=f"for example {example(number)}")
    return cursor.expression(found.start(), found.end())


def _item(cursor: Cursor, number: int, address: str) -> None:
    begin = cursor.blanks()
    cursor.add(address, _value(cursor, number), begin)


def _operand(cursor: Cursor, number: int, which: int, address: str) -> None:
    begin = _parameter(cursor, number, which)
    cursor.add(address, _value(cursor, number), begin)


def _calculation(cursor: Cursor, number: int) -> None:
    """D00 to D08 and D13: a parameter takes a value."""
    _target(cursor, number)
    if number in TWO:
        for which, address in enumerate(TWO[number], start=1):
            _operand(cursor, number, which, address)
        return
    at = _parameter(cursor, number, 1)
    value, span = _value(cursor, number), cursor.builder.span(at)
    if number in OPERATORS:
        _parameter(cursor, number, 2)
        second, token = _value(cursor, number), Token("mark", OPERATORS[number], span)
        tokens, written = (*value.tokens, *second.tokens), f"{value.text} {token.text} {second.text}"
        value = Expression(tokens, written, steps=(*value.steps, *second.steps, token))
    elif number in NAMES:
        token = Token("name", NAMES[number], span)
        value = Expression(value.tokens, f"{token.text} {value.text}", steps=(*value.steps, token))
    cursor.add("value", value, at)


def _target(cursor: Cursor, number: int) -> None:
    """The parameter that gets the value."""
    begin = cursor.blanks()
    found = cursor.match(_Q)
    if found is None:
        where = min(begin, cursor.stop - 1)
        raise Fault(f"D{number:02} needs a Q parameter", where, hint=f"for example {example(number)}")
    add_target(cursor, f"Q{found.group(1).upper()}{int(found.group(2))}", begin)


def _jump(cursor: Cursor, number: int) -> None:
    """D09 to D12: two operands and the label to go to."""
    _operand(cursor, number, 1, "first")
    _operand(cursor, number, 2, "second")
    _parameter(cursor, number, 3)
    labels.label(cursor, parameter=True)


def _system(cursor: Cursor, number: int) -> None:
    """D17 and D18 without the words of the dialog."""
    if number == 17:
        system_data(cursor, example(number))
        if cursor.match(_EQUALS) is None:
            raise Fault("= and a value are missing", min(cursor.blanks(), cursor.stop - 1), hint=f"for example {example(17)}")
        _item(cursor, number, "value")
        return
    _target(cursor, number)
    cursor.match(_EQUALS)
    system_data(cursor, example(number))


def example(number: int) -> str:
    """How a function is written."""
    if number in labels.JUMPS:
        return f"D{number:02} P01 +Q1 P02 +Q3 P03 5"
    special = {
        0: "D00 Q1 P01 +60", 14: "D14 P01 1000", 15: "D15 P01 +Q1 P02 +Q2", 17: "D17 ID 990 NR 6 = +1",
        18: "D18 Q25 ID210 NR4 IDX3", 23: "D23 Q20 P01 Q30", 24: "D24 Q20 P01 Q30",
    }  # fmt: skip
    two = number in OPERATORS or number in TWO
    return special.get(number) or f"D{number:02} Q1 P01 +2{' P02 +3' * two}"


# What the G functions are that are no path functions: statements and older cycles under other names, words renamed.
# `G54 X+25` is CYCL DEF 7 with X, `G25 R5` is RND with R, `G201 Q200=2` is CYCL DEF 201; the addresses are those that the
# language knows. Cycles that a machine tool builder or an obsolete control has are named, so that their refusal names them.

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


def program_name(cursor: Cursor, head: Given) -> None:
    """G39 P01 NAME: the program that becomes a cycle."""
    cursor.match(_NAME_OF_PROGRAM)
    labels.name_of_program(cursor, "PGM", "G39")


def set_label(cursor: Cursor, head: Given) -> None:
    """G98 L1: a jump target."""
    if cursor.match(_L) is None:
        raise Fault("G98 needs L and the label", head.at, head.length, "for example G98 L1")
    told(cursor, labels.set_label, "LBL ", "G98 L")


def call_label(cursor: Cursor) -> None:
    """L1 or L1,3: the label, and how often the section is repeated; `,0` is a call once."""
    begin = cursor.blanks()
    if found := cursor.match(_CALLED):
        if float(found.group(1)) > 65535:
            got = found.group(1)
            raise Fault(f"a label must be a number from 0 to 65535, got {got}", begin, len(got))
        cursor.builder.word("label", float(found.group(1)), begin, len(found.group(1)))
    else:
        told(cursor, partial(labels.label, parameter=True), "LBL ", "G98 L")
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


# How alarms about a DIN/ISO program are worded: with the G functions that stand there, and the block as it was read.
# The language knows the conversational names alone. An alarm that says `CP needs a pole` is told as `G13 needs a pole`, and
# its hint tells what the block is read as.

_CYCLES = {code: name for name, code in ISO_NAMES.items()} | {
    statement.keyword: f"G{code:02}" for code, statement in STATEMENTS.items() if code not in (53, 76, 78)
}
#: Statements that have one name only.
_NAMES = {
    "CTP": "G16", "CT": "G06", "CHF": "G24", "RND": "G25", "APPR LCT": "G26", "DEP LCT": "G27", "BLK FORM 0.1": "G30",
    "BLK FORM 0.2": "G31", "STOP": "G38", "TOOL CALL": "T", "CYCL CALL PAT": "G79 PAT", "CYCL CALL POS": "G79:G01",
    "CYCL CALL": "G79", "LBL": "G98 L", "CALL LBL": "L", "CALL PGM": "%", "BEGIN PGM": "%", "END PGM": "%",
}  # fmt: skip
_BY_SENSE = {"C": ("G02", "G03"), "CR": ("G02", "G03"), "CP": ("G12", "G13")}
_BY_FEED = {"L": ("G00", "G01"), "LP": ("G10", "G11")}
#: Addresses of the language by keyword, and the letters that stand for them.
_LETTERS = {keyword: {"IPA": "G91 H", "IPR": "G91 R", "PA": "H", "PR": "R"} for keyword in ("LP", "CP", "CTP")}
for _statement in STATEMENTS.values():
    for _letter, _address in _statement.words.items():
        if _address != _letter and _address not in "XY" and not _address.islower():
            _LETTERS.setdefault(_statement.keyword, {}).setdefault(_address, _letter)
#: What alarms say of other blocks.
_ELSEWHERE = {keyword: name for keyword, name in _NAMES.items() if " " in keyword} | {
    "R0": "G40", "RL": "G41", "RR": "G42", "CC X… Y…": "I… J…", "no CC": "no I J", "FMAX is": "G00 is",
}  # fmt: skip
_FN, _CYCLE = re.compile(r"FN (\d+)"), re.compile(r"CYCL DEF (\d+)(?:\.\d)?")


def said(alarm: Alarm, program: Program) -> Alarm:
    """The alarm in the words of the program that it is about."""
    block = _block(alarm, program)
    if block is None or not block.keyword or block.keyword == "Q":
        return alarm
    message, name = alarm.message, name_of(block)
    if name:
        message = _renamed(message, block.keyword, name)
        for address, letter in _LETTERS.get(block.keyword, {}).items():
            message = _renamed(message, address, letter)
    message, hint = (_CYCLE.sub(_cycle, part) for part in (message, alarm.hint))
    for keyword, other in _ELSEWHERE.items():
        message, hint = (_renamed(part, keyword, other) for part in (message, hint))
    if alarm.severity == ALARM and not re.fullmatch(r"G\d{3,}", name):  # whose words have the same letters
        read = f"the block is read as {' '.join([block.keyword, *map(str, block.words)])}"
        hint = f"{hint}; {read}" if hint else read
    return alarm.changed(message=message, hint=hint, args=(message,))


def name_of(block: Block) -> str:
    """The G function of a block that was read as a statement of the language; empty if it stands there as it is."""
    keyword, words = block.keyword, {word.address: word.value for word in block.words}
    if keyword in _BY_SENSE:
        return _BY_SENSE[keyword][words.get("DR") == "+"]
    if keyword in _BY_FEED:
        return _BY_FEED[keyword]["FMAX" not in words]
    if keyword == "TOOL DEF":
        return "G99" if {"L", "R"} & words.keys() else "G51"
    if keyword == "CYCL DEF 7" and "#" in words:
        return "G53"
    if found := _FN.fullmatch(keyword):
        return f"D{int(found[1]):02}"
    found = _CYCLE.fullmatch(keyword)
    return _cycle(found) if found else _CYCLES.get(keyword) or _NAMES.get(keyword, "")


def _cycle(found: re.Match[str]) -> str:
    """The G function of a cycle."""
    return _CYCLES.get(f"CYCL DEF {found[1]}", f"G{int(found[1]):02}")


def _renamed(message: str, name: str, by: str) -> str:
    """The message with another word for a keyword or an address, which a number may follow."""
    blank = " ?" if by == "%" else ""
    return re.sub(rf"(?<![\w.]){re.escape(name)}(?![A-Za-z_.]){blank}", lambda _: by, message)


def _block(alarm: Alarm, program: Program) -> Block | None:
    """The block that an alarm stands in."""
    if alarm.span is None or not len(program):
        return None
    offset = int(program.line_starts[alarm.span.line - 1]) + alarm.span.column - 1
    return program[max(int(program.start.searchsorted(offset, "right")) - 1, 0)]
