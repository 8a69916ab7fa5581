"""Words of the dialog before a number, in the language of the control: `DWELL`, `V.ZEIT`, `CZAS ZWL.`, `T.ESPERA`."""

from __future__ import annotations

import re

from mnclab.controls.tnc_620.reading.words import FLAGS, Cursor, Fault

_LETTER = r"(?:(?!Q[LR]?\d)[^\d\s;~+.,=-]|(?<![\s\d])\.)"  # a point behind a blank begins a number
_DIALOG_WORDS = re.compile(rf"{_LETTER}*+(?:[ \t]++{_LETTER}++)*+", FLAGS)
_BEHIND_A_POINT = re.compile(r"(?<=\.)\d+(?![\d.,])")
_EQUALS = re.compile(r"[ \t]*=", FLAGS)


def dialog(cursor: Cursor) -> str:
    """Pass over the words and `=`; the words, in capital letters without blanks. `V.ZEIT.5` may mean two numbers: a Fault."""
    words = cursor.match(_DIALOG_WORDS)
    if digits := _BEHIND_A_POINT.match(cursor.text, cursor.at, cursor.stop):
        what, number = f".{digits.group()} may be 0.{digits.group()} or {digits.group()}", len(digits.group()) + 1
        raise Fault(what, cursor.at - 1, number, "write a blank before the number, and a digit before its point")
    cursor.match(_EQUALS)
    return "".join(words.group().upper().split()) if words else ""
