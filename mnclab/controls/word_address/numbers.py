"""The numbers of blocks of ISO words: N at the beginning of a line, before or behind the mark of block skip."""

from __future__ import annotations

import re

from mnclab.text.dialect import Numbered, Numbers
from mnclab.text.program import Program

_NUMBER = re.compile(
    r"[ \t\ufeff]*+(?:\([^()\r\n]*+\)[ \t]*+)*+(?:/[ \t]*+[1-9]?[ \t]*+)?N[ \t]*+\+?(\d++)(?!\.)", re.IGNORECASE
)
_LAST_OF_DIN = re.compile(r"[ \t]*%")  # N99999999 %NAME, the end of a DIN/ISO program


def numbered(program: Program) -> list[Numbered]:
    """The numbers of all lines, in their order."""
    matches = (_NUMBER.match(program.text, int(begin)) for begin in program.line_starts)
    found = [match for match in matches if match and not _LAST_OF_DIN.match(program.text, match.end())]
    return [Numbered(match.start(1), match.end(1) - match.start(1), match[1]) for match in found]


def numbers(program: Program) -> Numbers:
    """The numbers of a program in which no word names a block."""
    return Numbers(numbered(program))
