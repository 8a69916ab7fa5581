"""By what programs for the TNC are known, Klartext and DIN/ISO with its asterisks, and the numbers of their blocks."""

from __future__ import annotations

import re

from mnclab.controls.tnc_620.reading import din_reader
from mnclab.controls.word_address import reader as words
from mnclab.text.dialect import Numbered, Numbers, sign
from mnclab.text.program import Program

_BLOCK = r"^[ \t/]*(?:\d+[ \t]*)?"

SIGNS = (
    sign(r"\b(?:BEGIN|END)[ \t]+PGM\b", 20, "the head of a Klartext program"),
    sign(_BLOCK + r"BLK[ \t]+FORM\b", 15, "a blank"),
    sign(
        _BLOCK + r"(?:TOOL[ \t]+(?:CALL|DEF)|CYCLE?[ \t]+(?:DEF|CALL)|CALL[ \t]+(?:LBL|PGM)|TCH[ \t]+PROBE|FN[ \t]*\d+[ \t]*:)",
        12, "a statement", 2,
    ),
    sign(
        _BLOCK + r"(?:APPR|DEP)[ \t]+(?:P?L[NT]|P?CT|PLCT)\b|" + _BLOCK + r"(?:FPOL|FL|FC|FLT|FCT|FSELECT)\b",
        10, "a contour",
    ),
    sign(_BLOCK + r"(?:L|LN|LP)[ \t]+(?:I?[XYZABCUVW]|P[RA])[ \t]*[-+]?[\d.Q]", 6, "a line", 2),
    sign(_BLOCK + r"(?:CC|CP|CR|CT)[ \t]+I?[XYZP]", 5, "a circle"),
    sign(_BLOCK + r"LBL[ \t]+[\d\"]", 6, "a label"),
    sign(_BLOCK + r"Q[LRS]?\d+[ \t]*=", 3, "a Q parameter", 2),
    sign(r"\bFMAX\b|\bR[0LR][ \t]+F", 5, "rapid traverse or a compensation"),
    sign(r"^[ \t]*Q\d+=[^;\n]*;", 5, "a parameter of a cycle"),
    sign(r"^[ \t]*%[^\n;*]*[ \t]G7[01]\b", 20, "the head of a DIN/ISO program"),
    sign(
        r"^[ \t]*+N\d++[^\n*;A-Z]*+[A-Z]++[-+\d.]++[ \t]*+[A-Z][^\n*;]*+\*[ \t]*+(?:;[^\n]*)?$",
        7, "a block that ends with *", 2,
    ),
    sign(r"^[ \t]*N?9{5,8}[ \t]+%", 12, "the end of a DIN/ISO program"),
    sign(r"(?<![A-Z])G98[ \t]+L\d|(?<![A-Z])G99[ \t]+T\d+[ \t]+L", 8, "a label or a tool of DIN/ISO"),
    sign(r"(?<![A-Z])G2\d\d[ \t]+Q2\d\d[ \t]*=", 10, "a cycle of DIN/ISO"),
    sign(r"\bD0?\d[ \t]+Q\d+[ \t]+P0?1", 8, "a parameter of DIN/ISO"),
)


# The numbers of blocks of the TNC: 0, 1, 2 … of Klartext, N of DIN/ISO. Jumps lead to labels, so nothing names them.

_SUB_BLOCK = re.compile(r"(?im)^(?:[ \t]*+\d++)?[ \t]*+(?:CYCL[ \t]++DEF|TCH[ \t]++PROBE)[ \t]++\d++\.[1-9]")  # counts too
_NUMBER = re.compile(r"[ \t\ufeff]*+(?:/[ \t]*+)?(\d++)(?![.,])")


def numbers(program: Program) -> Numbers:
    """Those of blocks that have one; where none has, each block gets one."""
    if din_reader.begins(program.text):
        return words.numbers(program)
    starts = sorted({*program.start.tolist(), *(found.start() for found in _SUB_BLOCK.finditer(program.text))})
    matches = [_NUMBER.match(program.text, at) for at in starts]
    blocks = [Numbered(match.start(1), len(match[1]), match[1]) for match in matches if match]
    return Numbers(blocks or [Numbered(at, 0, "") for at in starts], first=0, step=1)
