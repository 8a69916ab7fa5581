"""Blocks of the JNC-T01: words without blanks inside, each in the format of table 1, comments behind an apostrophe.

Cyrillic letters that look like addresses are read as these, with a warning; lower-case letters are read as capitals.
"""

from __future__ import annotations

import re
from dataclasses import replace

from mnclab.controls.word_address import reader as words
from mnclab.controls.word_address.reader import misformed
from mnclab.text.alarm import WARNING, Alarm, Alarms
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
