"""Words of a DIN/ISO block: a letter and its value, `G01`, `X+10`, `H-Q5`, `P01 +2`, `FMAX`.

G90 and G91 count for the words behind them, also in their own block: `G91 X+5 G90 Y-5`.
"""

from __future__ import annotations

import re
from collections.abc import Iterable
from typing import Any, NamedTuple

from mnclab.controls.tnc_620.reading.din_modes import MIXED
from mnclab.controls.tnc_620.reading.words import FLAGS, LENGTHS, OWN, TEXT, Cursor, Fault, from_inches
from mnclab.text.expression import Expression
from mnclab.text.program import INCREMENTAL, ProgramBuilder

#: Letters of positions: they count from the last position under G91.
MEASURED = frozenset("XYZUVWABCIJKRH")

_G = re.compile(r"G[ \t]*(\d{1,4})(?![\d.,])[ \t]*:?", FLAGS)
_FEED = re.compile(r"F[ \t]*(MAX|AUTO)", FLAGS)
_P = re.compile(r"P[ \t]*(\d\d(?=[ \t]*[-+\dQXYZ])|\d(?=[ \t]+[-+\dQXYZ]|[-+Q]))", FLAGS)
_SIDE = re.compile(r"[ \t]*([XYZ])(?=[ \t]*[-+\dQ.])", FLAGS)
_LETTERS = re.compile(r"DR2(?=[ \t]*[+-])|DL|DR|FU|FZ|[A-Z]", FLAGS)
_TEXT_PARAMETER = re.compile(r"[ \t]*QS[ \t]?(\d{1,4})(?!\d)", FLAGS)
_KNOWN = MEASURED | set("FSTLM") | {"DL", "DR", "DR2", "FU", "FZ"}

#: G functions whose words are read in their own way, up to the end of the block.
TAILS = frozenset((28, 39, 55, 79, 98))


def has_tail(code: int) -> bool:
    """Whether what stands behind a G function is read in a way of its own."""
    return code in TAILS or code >= 100


class Given(NamedTuple):
    """A word of the text: its letter (or `P01`, `FMAX`, `M103:F`), its value, where it stands."""

    letter: str
    value: Any
    at: int
    length: int
    incremental: int = 0

    @property
    def code(self) -> int:
        """The number of a G function."""
        return int(self.value)

    def fault(self, builder: ProgramBuilder, what: str, hint: str = "") -> Fault:
        """A fault at this word, which is named as it stands in the text."""
        return Fault(f"{self.shown(builder)} {what}", self.at, self.length, hint)

    def shown(self, builder: ProgramBuilder) -> str:
        """The word as it stands in the text."""
        return " ".join(builder.text[self.at : self.at + self.length].split())


def read_words(cursor: Cursor, incremental: int) -> tuple[list[Given], int]:
    """The words from here on, and what G90 or G91 says behind them; a G function with a tail is the last one."""
    given: list[Given] = []
    while not cursor.done:
        begin = cursor.at
        if found := cursor.match(_G):
            code = int(found.group(1))
            given.append(Given("G", float(code), begin, len(found.group().rstrip(" \t:"))))
            if code in (90, 91):
                incremental = code - 90
            if has_tail(code):
                break
        else:
            letter, value = _word(cursor, begin)
            given.append(Given(letter, value, begin, cursor.at - begin, incremental if letter in MEASURED else 0))
            if letter == "M" and isinstance(value, float) and value in OWN:
                given += _own_words(cursor, int(value))
    return given, incremental


def _word(cursor: Cursor, begin: int) -> tuple[str, Any]:
    if found := cursor.match(_FEED):
        return f"F{found.group(1).upper()}", None
    if found := cursor.match(_P):
        letter = f"P{int(found.group(1)):02}"
        if side := cursor.match(_SIDE):
            letter += f":{side.group(1).upper()}"
        return letter, cursor.needed(f"{letter} needs a number", begin, cursor.at - begin)
    found = cursor.match(_LETTERS)
    letter = found.group().upper() if found else ""
    if found and letter in _KNOWN:
        if letter == "T" and (text := cursor.match(TEXT)):
            return "T", text.group(1).strip()
        if letter == "T" and (named := cursor.match(_TEXT_PARAMETER)):
            return "text", f"QS{int(named.group(1))}"
        if (value := cursor.value()) is not None:
            return letter, value
    cursor.at = begin
    raise _strange(cursor, letter)


#: What the G functions with a fraction of other controls are here.
_PARTED = re.compile(r"[Gg]0*+(\d++\.\d)(?!\d)")
PARTED = {
    "43.4": "write M128", "43.5": "write M128", "68.2": "write G80, the working plane", "5.1": "leave it out",
    **dict.fromkeys(("38.2", "38.3", "38.4", "38.5"), "write G55, the probing of a point"),
}  # fmt: skip


def _strange(cursor: Cursor, letter: str) -> Fault:
    """The fault at what is no word of these programs."""
    if cursor.text[cursor.at] == "*":
        return Fault("* ends a block: no words may stand behind it", cursor.at, hint="the next block begins with N")
    if letter in _KNOWN:
        return Fault(f"{letter} needs a number", cursor.at, len(letter))
    if not letter:
        return cursor.unexpected()
    hints = {"O": "the letter O stands where the digit 0 was meant", "N": "a block number stands at its beginning"}
    if letter == "G" and (parted := _PARTED.match(cursor.text, cursor.at)):
        told = f"{parted[0].upper()} is no G function of DIN/ISO programs: their numbers are whole"
        return Fault(told, cursor.at, len(parted[0]), PARTED.get(parted[1], ""))
    if letter == "G":
        return Fault("G needs the number of a function, for example G01", cursor.at)
    return Fault(f"{letter} is no word of a DIN/ISO block", cursor.at, len(letter), hints.get(letter, ""))


def _own_words(cursor: Cursor, code: int) -> list[Given]:
    """Words directly behind an M function that belong to it."""
    given = []
    while not cursor.done:
        begin = cursor.at
        found = cursor.match(OWN[code])
        if found is None:
            break
        letter = f"M{code}:{''.join(found.group().upper().split())}"
        value = cursor.value()
        given.append(Given(letter, value, begin, cursor.at - begin))
    return given


def put(cursor: Cursor, address: str, word: Given, value: Any = ..., inches: bool | None = None) -> None:
    """Add a word to the block begun last under the address that the language knows; `inches`: whether it is a length."""
    value = word.value if value is ... else value
    if cursor.inch and isinstance(value, float | Expression) and (address in LENGTHS if inches is None else inches):
        value = from_inches(value)
    cursor.builder.word(address, value, word.at, word.length, INCREMENTAL if word.incremental == 1 else 0)


def unmixed(builder: ProgramBuilder, words: Iterable[Given]) -> None:
    """A fault at the first word that could be absolute or incremental."""
    for word in words:
        if word.incremental == MIXED:
            why = "could be absolute or incremental: the ways that lead to this block bring G90 and G91"
            raise word.fault(builder, why, "write G90 or G91 in this block")
