"""The numbers of blocks of the TNC: 0, 1, 2 … of Klartext, N of DIN/ISO. Jumps lead to labels, so nothing names them."""

from __future__ import annotations

import re

from mnclab.controls.tnc_620.reading import din_reader
from mnclab.controls.word_address import reader as words
from mnclab.text.dialect import Numbered, Numbers
from mnclab.text.program import Program

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
