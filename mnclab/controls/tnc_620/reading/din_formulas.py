"""The functions D00 to D38 of DIN/ISO programs, which are FN 0 to FN 38: `D01 Q1 P01 +Q2 P02 +5`.

The parameters P01, P02 … stand for the operands in their order. Text of the conversational form (`D18 SYSREAD Q1 = …`)
is read as such.
"""

from __future__ import annotations

import re

from mnclab.controls.tnc_620.reading import labels
from mnclab.controls.tnc_620.reading.file_functions import FILES
from mnclab.controls.tnc_620.reading.formulas import (
    FN,
    OPERAND,
    add_target,
    system_data,
)
from mnclab.controls.tnc_620.reading.words import FLAGS, Cursor, Fault
from mnclab.text.alarm import Span
from mnclab.text.expression import Expression, Token

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
    try:
        read(cursor)
    except Fault as fault:
        message, hint = (part.replace(f"FN {number}", f"D{number:02}") for part in (fault.message, fault.hint))
        raise Fault(message, fault.offset, fault.length, hint) from None


def _parameter(cursor: Cursor, number: int, which: int) -> int:
    """Pass over P01, P02 or P03; the place where it stands."""
    begin = cursor.blanks()
    if cursor.match(_OPERAND_MARKS[which]) is None:
        raise Fault(f"D{number:02} needs P{which:02}", min(begin, cursor.stop - 1), hint=f"for example {example(number)}")
    return begin


def _expression(cursor: Cursor, number: int, which: int) -> tuple[Expression, int]:
    begin = _parameter(cursor, number, which)
    return _value(cursor, number), begin


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
    value, begin = _expression(cursor, number, which)
    cursor.add(address, value, begin)


def _calculation(cursor: Cursor, number: int) -> None:
    """D00 to D08 and D13: a parameter takes a value."""
    _target(cursor, number)
    if number in TWO:
        for which, address in enumerate(TWO[number], start=1):
            _operand(cursor, number, which, address)
        return
    first, at = _expression(cursor, number, 1)
    if number in OPERATORS:
        second, _ = _expression(cursor, number, 2)
        value = _joined(first, OPERATORS[number], second, cursor.builder.span(at))
    elif number in NAMES:
        token = Token("name", NAMES[number], cursor.builder.span(at))
        value = Expression(first.tokens, f"{token.text} {first.text}", steps=(*first.steps, token))
    else:
        value = first
    cursor.add("value", value, at)


def _joined(first: Expression, operator: str, second: Expression, span: Span) -> Expression:
    """Two operands and what joins them, each at its own place."""
    tokens = (*first.tokens, *second.tokens)
    steps = (*first.steps, *second.steps, Token("mark", operator, span))
    return Expression(tokens, f"{first.text} {operator} {second.text}", steps=steps)


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
