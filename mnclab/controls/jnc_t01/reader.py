"""Blocks of the JNC-T01: words without blanks inside, each in the format of table 1, comments behind an apostrophe.

Cyrillic letters that look like addresses are read as these, with a warning; lower-case letters are read as capitals.
"""

from __future__ import annotations

import re
from dataclasses import replace

from mnclab.controls.word_address import reader as words
from mnclab.controls.word_address.reader import misformed
from mnclab.text.alarm import WARNING, Alarm, Alarms
from mnclab.text.dialect import sign
from mnclab.text.program import Program, readable

COMMENT = "'"
FORMATS = {**dict.fromkeys("GMTLN", "n"), **dict.fromkeys("DFS", "n.n"), **dict.fromkeys("IKRUWXZ", "±n.n")}
_LOOKS_LATIN = dict(zip("ХхМмТтКкІі", "XxMmTtKkIi", strict=True))
_CODE = re.compile(rf"^[^{COMMENT}\r\n]*", re.MULTILINE)
_LETTERS = re.compile(f"[{''.join(_LOOKS_LATIN)}]")

_words = words.reader("jnc-t01", COMMENT, labels=False, skip=False, headers="%")


@readable
def read(text: str, name: str = "program") -> Program:
    """A program of blocks; faults are collected in its alarms."""
    folded, places = _fold(text)
    program = replace(_words(folded, name), text=text)
    alarms = Alarms([*program.alarms, *misformed(replace(program, text=folded), FORMATS)])
    for at in places:
        message = f"{text[at]!r} is a Cyrillic letter, read as {_LOOKS_LATIN[text[at]].upper()}"
        alarms.append(Alarm(message, program.span(at), WARNING))
    untold = (*program.untold, *alarms.untold)
    return replace(program, alarms=tuple(sorted(alarms, key=lambda alarm: alarm.span or (0, 0, 0))), untold=untold)


def _fold(text: str) -> tuple[str, list[int]]:
    """The text with Latin letters in place of Cyrillic ones outside comments, and where they stood."""
    if text.isascii():
        return text, []
    places = [m.start() for code in _CODE.finditer(text) for m in _LETTERS.finditer(text, *code.span())]
    letters = list(text)
    for at in places:
        letters[at] = _LOOKS_LATIN[text[at]]
    return "".join(letters), places


# Signs of JNC-T01 programs: comments behind an apostrophe, positions without Y, and no numbers of blocks.

SIGNS = (
    sign(r"^[^'\n;(]*'", 8, "a comment behind an apostrophe"),
    sign(
        r"\A(?=[\s\S]*X[ \t]*[-+.\d])(?=[\s\S]*Z[ \t]*[-+.\d])(?=[\s\S]*(?<![A-Z])G[ \t]*\d)(?![\s\S]*Y[ \t]*[-+.\d#\[])",
        2, "positions of X and Z, and no Y",
    ),
    sign(r"(?<![A-Z])G1[24](?![\d.])[^\n]*R", 3, "a fillet or a chamfer"),
    sign(r"(?<![A-Z])G7[78](?![\d.])[^\n]*X", 4, "stock removal"),
    sign(r"(?<![A-Z])G7[345](?![\d.])[^\n]*[XZ]", 1, "a drilling or grooving cycle"),
    sign(r"(?<![A-Z])M6[013](?!\d)", 3, "the way home"),
    sign(r"(?<![A-Z])G32(?![\d.])[^\n]*[XZ]", 1, "a thread"),
    sign(r"^[ \t]*N\d", -3, "numbers of blocks"),
    sign(r"\(|^[^'\n]*;", -3, "comments of others"),
    sign(r"^[ \t]*(?:O\d|%)|#", -2, "heads of programs, variables"),
    sign(
        r"(?<![A-Z])G(?:70|71|72|76|50|28|4[0-39]|5[4-9]|2[01]|8\d)(?![\d.])|(?<![A-Z])T\d{4}(?!\d)|Y[ \t]*[-+.\d]",
        -4, "words that it does not have",
    ),
)
