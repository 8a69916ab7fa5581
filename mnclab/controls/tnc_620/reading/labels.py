"""How the course of a program is written: labels, calls, jumps, other programs (catalogue: LBL, CALL LBL, FN, CALL PGM)."""

from __future__ import annotations

import re
from functools import partial

from mnclab.controls.tnc_620.reading.formulas import operand
from mnclab.controls.tnc_620.reading.words import FLAGS, TEXT, WHOLE, Cursor, Fault, Read
from mnclab.text import strings

_TEXT_PARAMETER = re.compile(r"[ \t]*QS[ \t]?\d{1,6}(?!\d)", FLAGS)
_REPEAT = re.compile(r"REP[ \t]*+(?:(\d{1,9})(?:[ \t]*/[ \t]*\d{1,9})?|(?=[+]?[ \t]*Q[LR]?\d))", FLAGS)
_EMPTY = re.compile(r"REP[ \t]*$", FLAGS)
_IF = re.compile(r"[ \t]*IF(?![A-Z])", FLAGS)
_DEFINED = re.compile(r"[ \t]*(?:[+][ \t]*)?(Q[LRS]?\d{1,6})[ \t]+IS[ \t]+(UNDEFINED|DEFINED)(?![A-Z])", FLAGS)
_GO_TO_LABEL = re.compile(r"[ \t]*GOTO[ \t]+LBL(?![A-Z])", FLAGS)
_PGM = re.compile(r"[ \t]*PGM(?![A-Z])", FLAGS)

COMPARISONS = {9: "EQU", 10: "NE", 11: "GT", 12: "LT"}


def label(cursor: Cursor, parameter: bool = False) -> str:
    """The number or the name of a label, or where it is called also a QS parameter; how a program lists it."""
    begin = cursor.blanks()
    if found := cursor.match(TEXT):
        cursor.add("label", found.group(1), begin)
        if not found.group(1).strip():
            raise Fault("the name of a label is empty", begin, cursor.at - begin)
        return f'"{found.group(1)}"'
    if found := cursor.match(WHOLE):
        value = float(found.group(1))
        if value > 65535:
            raise Fault(f"a label must be a number from 0 to 65535, got {value:g}", begin, cursor.at - begin)
        cursor.add("label", value, begin)
        return f"{value:g}"
    if parameter and (found := cursor.match(_TEXT_PARAMETER)):
        cursor.add("label", strings.parse_text(found.group().strip(), cursor.builder.span(begin)), begin)
        return ""
    raise Fault("a label must be a whole number or a name in quotes", begin, hint='for example LBL 1 or LBL "HOLES"')


def set_label(cursor: Cursor) -> None:
    """LBL: a jump target; LBL 0 is an end and none."""
    begin, builder = cursor.blanks(), cursor.builder
    name = label(cursor)
    if name in builder.labels:
        raise Fault(f"LBL {name} is set twice", begin, cursor.at - begin, "a label stands for one place in the program")
    if name != "0":
        builder.labels[name] = builder.blocks[-1][0]


def call_label(cursor: Cursor) -> None:
    """CALL LBL: the label, and how often a section is repeated; of n/n the second counts down while it runs; or a Q parameter."""
    label(cursor, parameter=True)
    begin = cursor.blanks()
    if cursor.match(_EMPTY):
        message, hint = "REP without a number repeats nothing: this calls the subprogram", "REP 2 repeats a section twice"
        cursor.builder.alarm(message, begin, 3, hint, "warning")
    elif found := cursor.match(_REPEAT):
        cursor.add("REP", float(found.group(1)) if found.group(1) else cursor.needed("REP needs a number", begin, 3), begin)


def jump(cursor: Cursor, number: int) -> None:
    """FN 9 to FN 12: two operands, a comparison, and the label to go to."""
    word = COMPARISONS[number]
    example = f"FN {number}: IF +Q1 {word} +Q3 GOTO LBL 5"
    hint = f"for example {example}"
    cursor.expect(_IF, f"FN {number} needs IF", hint)
    if number == 9 and (found := cursor.match(_DEFINED)):
        for k, address in enumerate(("parameter", "state"), start=1):
            cursor.builder.word(address, found.group(k).upper(), found.start(k), len(found.group(k)))
    else:
        operand(cursor, "first", example)
        cursor.expect(re.compile(rf"{word}(?![A-Z])", FLAGS), f"FN {number} compares with {word}", hint)
        operand(cursor, "second", example)
    cursor.expect(_GO_TO_LABEL, "GOTO LBL is missing", hint)
    label(cursor, parameter=True)


JUMPS: dict[int, Read] = {number: partial(jump, number=number) for number in COMPARISONS}


def name_of_program(cursor: Cursor, address: str = "name", what: str = "CALL PGM") -> None:
    """The name of another program up to the end of the line, with or without quotes."""
    begin = cursor.blanks()
    name = cursor.rest().rstrip()
    cursor.at = begin + len(name)
    name = name[1:-1].strip() if len(name) > 1 and name[0] == name[-1] == '"' else name
    if not name.strip('"\\/: '):
        raise Fault(f"{what} needs the name of a program", begin, max(1, cursor.at - begin))
    cursor.add(address, name, begin)


def select_program(cursor: Cursor) -> None:
    begin = cursor.blanks()
    if _TEXT_PARAMETER.fullmatch(cursor.rest().rstrip()):
        value = strings.parse_text(cursor.rest(), cursor.builder.span(begin))
        cursor.at = cursor.stop
        cursor.add("name", value, begin)
    else:
        name_of_program(cursor, what="SEL PGM")


def program_of_cycle(cursor: Cursor) -> None:
    cursor.match(_PGM)
    name_of_program(cursor, "PGM", "CYCL DEF 12")
