"""An address and its value, as conversational blocks write them: `X+10`, `IZ-2`, `Q200=2`; and the DIN/ISO names of cycles."""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import replace
from typing import Any

from mnclab.text.alarm import LATIN
from mnclab.text.alarm import hint as near
from mnclab.text.expression import Expression, parse
from mnclab.text.given import LARGEST
from mnclab.text.program import INCREMENTAL, NO_MEANING, ProgramBuilder

# The DIN/ISO names of cycles, which the manual prints in most of their headings; it prints no DIN/ISO program.
# They find a cycle (`mnclab.help("G83" …)`) and explain a G word that strayed into a conversational program. Several are
# other functions on other controls (G28, G54, G73, G80). Cycles 26, 200, 208 and some probing cycles have no such name.

_OWN_NAMES = {
    7: "G54", 8: "G28", 9: "G4", 10: "G73", 11: "G72", 12: "G39", 13: "G36", 14: "G37", 18: "G18", 19: "G80", 32: "G62",
    **{n: f"G1{n}" for n in (20, 21, 22, 23, 24, 25, 27, 28, 29, 39)},
}  # fmt: skip
_CYCLES = (
    201, 202, 203, 204, 205, 206, 207, 209, 220, 221, 225, 232, 233, 239, 240, 241, 247, 251, 252, 253, 254, 256, 257, 258,
    262, 263, 264, 265, 267, 270, 275, 276,
)  # fmt: skip
_PROBING = (
    *range(400, 406), *range(408, 428), 430, 431, 441, *range(450, 453), *range(460, 464), *range(480, 485), 1410, 1411, 1420,
)  # fmt: skip

#: DIN/ISO name -> the cycle in conversational programs.
ISO_NAMES: dict[str, str] = {
    **{name: f"CYCL DEF {number}" for number, name in _OWN_NAMES.items()},
    "G53": "CYCL DEF 7",  # with a datum table
    "G55": "TCH PROBE 0",
    **{f"G{number}": f"CYCL DEF {number}" for number in _CYCLES},
    **{f"G{number}": f"TCH PROBE {number}" for number in _PROBING},
}


# An address and its value, as conversational blocks write them: `X+10`, `IY-Q5`, `FMAX`, `RL`, `DR-`.
# Values are numbers with a decimal point or comma, or a Q parameter with a sign (then the word holds an expression).
# What stands without a number is a word without a value (`FMAX`, `FAUTO`, `RL`, `RR`, `R0`); `R F M` at the end of a block
# and `R` before a feed, as older controls write what stays as it is, are none; a sense of rotation is the word `DR` with the
# text `+` or `-`. Values without an address in the text get one in lower case: `tool`, `label`, `axis`, `name`, `unit`,
# `length`, `number`, `target`, `value`. Lengths of an INCH program become mm here, feeds where they are obeyed
# (`Machine.feed_unit`).

INCH = 25.4  # mm

FLAGS = re.IGNORECASE | re.ASCII
BLANKS = " \t"

NUMBER = r"(?:\d+(?:[.,]\d*)?|[.,]\d+)"
SIGNED = re.compile(rf"[ \t]*(?:([+-])[ \t]*)?({NUMBER})", FLAGS)
PARAMETER = re.compile(r"[ \t]*(?:[+-][ \t]*)?Q[LR]?\d+", FLAGS)
WHOLE = re.compile(r"[ \t]*(\d{1,9})(?![\d.,])", FLAGS)
TEXT = re.compile(r'[ \t]*"([^"]*)"')

FEEDS = ("FMAX", "FAUTO")
_EMPTY = re.compile(r"(?:R[ \t]+)?(?:F[ \t]+)?M[ \t]*$|R[ \t]+(?=F[ \t]*(?:[\d.,Q+]|MAX(?![A-Z])))", FLAGS)
_OPERATION = re.compile(r"[*/^][ \t]*[\dQ(]", FLAGS)
_LETTERS = re.compile("[A-Z]{2,}", FLAGS)
_LOST = re.compile(r"[ \t]*[+-]?(nan|inf)(?![A-Z])", FLAGS)
_FEEDS = re.compile(r"F[ \t]*(MAX|AUTO)(?![A-Z])", FLAGS)
_SIDES = re.compile(r"(?:(RL|RR|RO)(?![A-Z])|(R0)(?![\d.,]))", FLAGS)
_SIGN = re.compile("[+-]")
_SENSE = re.compile(r"DR[ \t]*([+-])(?![ \t]*[\dQ.,])", FLAGS)

_ADDRESSES = (
    "X Y Z U V W A B C R LEN CCA PR PA F FU FZ S M T DL DR L REP ROT SCL CCX CCY CCZ CCPR CCPA ABST AN D CLSD "
    "DIST RI DI P1X P1Y P2X P2Y P3X P3Y PDX PDY RX RY RPR RPA RAN PAR DP RCCX RCCY RCCPR RCCPA"
).split()
_NAMED = re.compile(rf"(I?)(DR2(?=[ \t]*[+-])|{'|'.join(sorted(_ADDRESSES, key=len, reverse=True))})", FLAGS)

#: Addresses of lengths and of feeds per revolution or tooth: inches in a program that begins with INCH.
LENGTHS = frozenset(
    "X Y Z IX IY IZ U V W R RI DI DIST LEN PR FU FZ DL DR DR2 L CCX CCY CCZ CCPR ABST D P1X P1Y P1Z P2X P2Y P2Z P3X P3Y P3Z PDX "
    "PDY DX DY DP DEPTH PITCH SETUP PECKG RADIUS HEIGHT length MB M140:MB".split()
)

#: Addresses that belong to an M function when they stand directly behind it: `M103 F20` beside a feed F of the block.
_OWN = {
    94: "[ABC]", 101: "BT", 103: "F", 118: "[XYZABC]", 120: "LA", 128: "F[ \t]*MAX|F", 138: "[ABC]",
    140: "MB[ \t]*MAX|MB|F[ \t]*MAX|F", 200: "V", 201: "V", 202: "FNR", 203: "V|TIME", 204: "V|TIME",
}  # fmt: skip
OWN = {code: re.compile(rf"(?:{words})(?![A-PR-Z])", FLAGS) for code, words in _OWN.items()}

LETTER_O = "the letter O stands where the digit 0 was meant"
_G_NAME = re.compile(r"G[ \t]*(\d{1,4})(?!\d)", FLAGS)


def from_inches(value: float | Expression) -> float | Expression:
    return value * INCH if isinstance(value, float) else replace(value, scale=INCH)


class Fault(Exception):
    """What is wrong at a place of the text; the reader makes an alarm of it."""

    def __init__(self, message: str, offset: int, length: int = 1, hint: str = "") -> None:
        super().__init__(message)
        self.message, self.offset, self.length, self.hint = message, offset, length, hint


class Cursor:
    """A place in one line of a program, and the builder that takes the words found there."""

    def __init__(self, builder: ProgramBuilder, at: int, stop: int, inch: bool) -> None:
        self.builder, self.text, self.at, self.stop, self.inch = builder, builder.text, at, stop, inch
        self.further: list[tuple[int, int]] = []  # begin and end of the lines on which a formula goes on
        self.blanks()

    def blanks(self) -> int:
        """Pass over blanks; the place after them."""
        while self.at < self.stop and self.text[self.at] in BLANKS:
            self.at += 1
        return self.at

    @property
    def done(self) -> bool:
        return self.blanks() >= self.stop

    def rest(self) -> str:
        return self.text[self.at : self.stop]

    def match(self, pattern: re.Pattern[str]) -> re.Match[str] | None:
        """Take what the pattern matches here."""
        found = pattern.match(self.text, self.at, self.stop)
        if found:
            self.at = found.end()
        return found

    def expect(self, pattern: re.Pattern[str], fault: str, hint: str = "") -> re.Match[str]:
        """Take what must stand here; `fault` says so."""
        begin = self.blanks()
        found = self.match(pattern)
        if found is None:
            raise Fault(fault, begin, hint=hint)
        return found

    def add(self, address: str, value: Any, offset: int, flag: int = 0) -> None:
        """A word from `offset` to here; `value` as in `text.program.Word`."""
        if self.inch and address in LENGTHS and isinstance(value, float | Expression):
            value = from_inches(value)
        self.builder.word(address, value, offset, self.at - offset, flag)
        if self.builder.blocks and self.builder.full == self.builder.blocks[-1][0]:
            self.at = self.stop

    def has(self, address: str) -> bool:
        """Whether the block has a word of this address so far."""
        names = self.builder.addresses
        return address in names and any(word[0] == names[address] for word in self.builder.block_words)

    def number(self) -> float | None:
        """A number with its sign; None if there is none here."""
        begin = self.at
        found = self.match(SIGNED)
        if found is None:
            return None
        after = self.text[self.at : min(self.at + 1, self.stop)]
        if after and after in ".,+-":
            raise self.unexpected("a number has only one decimal point" if after in ".," else "")
        value = float(found.group(2).replace(",", "."))
        if value >= LARGEST:
            raise Fault(f"a number must be smaller than {LARGEST:g}", begin, self.at - begin)
        return -value if found.group(1) == "-" else value

    def value(self) -> float | Expression | None:
        """A number or a Q parameter; None if there is neither here."""
        found = self.match(PARAMETER)
        if found is None:
            return self.number()
        return self.expression(found.start(), found.end())

    def expression(self, begin: int, end: int) -> Expression:
        formula = self.text[begin:end].lstrip()
        further = [(self.text[at:stop], self.builder.span(at)) for at, stop in self.further]
        return parse(formula, self.builder.span(end - len(formula)), further)

    def needed(self, fault: str, begin: int, length: int = 1) -> float | Expression:
        """A number or a Q parameter that must be here; `fault` says so at the place `begin`."""
        value = self.value()
        if value is None:
            raise Fault(fault, begin, length)
        return value

    def words(self, bare: str = "", radius: bool = False) -> None:
        """Words up to the end of the line.

        `bare`: letters that may stand without a value and name an axis; `radius`: R0 is a radius here.
        """
        while not self.done:
            self.word(bare, radius)

    def word(self, bare: str = "", radius: bool = False) -> None:
        begin = self.at
        if self.match(_EMPTY):
            return
        radius = radius and not self.has("R")  # behind the radius R0 is what it is elsewhere
        if found := self.match(_FEEDS):
            self.add("F" + found.group(1).upper(), None, begin)
        elif not (radius and self.text[begin + 1 : begin + 2] in "0Oo") and (found := self.match(_SIDES)):
            self.add(found.group().upper().replace("O", "0"), None, begin)
        elif found := self.match(_SENSE):
            self.add("DR", found.group(1), begin)
        elif found := self.match(_NAMED):
            address = found.group(2).upper()
            if address == "CLSD" and (sign := self.match(_SIGN)):
                self.add(address, sign.group(), begin)
            elif (value := self.value()) is not None:
                self.add(address, value, begin, INCREMENTAL if found.group(1) else 0)
                if address == "M" and value in OWN:
                    self.own_words(int(value))
            elif address in bare and not found.group(1):
                self.add("axis", address, begin)
            else:
                self.at = begin
                raise self.unexpected()
        else:
            raise self.unexpected()

    def own_words(self, code: int) -> None:
        """Words directly behind an M function that belong to it: `M103:F` with or without a number."""
        while not self.done:
            begin = self.at
            found = self.match(OWN[code])
            if found is None:
                return
            self.add(f"M{code}:{''.join(found.group().upper().split())}", self.value(), begin)

    def unexpected(self, message: str = "") -> Fault:
        """The fault at a character that is no part of a good word, with the repair where the mistake is known."""
        self.blanks()
        c = self.text[self.at] if self.at < self.stop else ""
        if message or not c:
            return Fault(message or "the block ends too early", self.at)
        if c in LATIN:
            return Fault(f"{c!r} is a Cyrillic letter", self.at, hint=f"write the Latin letter {LATIN[c]}")
        if found := _NAMED.match(self.text, self.at, self.stop):
            return self.without_number(found)
        if c in "+-" or c.isdigit():
            hint = "the axis letter is missing" if c in "+-" else "a blank inside a number splits it"
            return Fault(f"{c!r} needs an address before it", self.at, hint=hint)
        if c in "Gg":
            found = _G_NAME.match(self.text, self.at, self.stop)
            named = ISO_NAMES.get(f"G{int(found[1])}") if found else None
            other = f"; {found[0].upper()} is {named}" if found and named else "; write L, C, CR or CYCL DEF"
            return Fault("G has no meaning here", self.at, hint=f"G words belong to DIN/ISO programs{other}")
        hint = LETTER_O if c in "Oo" and self.text[self.at - 1].isdigit() else "a comment begins with ;" if c == "(" else ""
        if _OPERATION.match(self.text, self.at, self.stop):
            hint = "a formula stands in a block of its own, for example Q10 = Q1 / 2"
        return Fault(f"{c!r} has no meaning here", self.at, hint=hint)

    def without_number(self, found: re.Match[str]) -> Fault:
        """The fault of an address whose value is missing or odd, or of a whole word where none is taken."""
        name, after = found.group().upper(), self.text[found.end() : self.stop].lstrip()[:1]
        for pattern in (PARAMETER, SIGNED):
            if value := pattern.match(self.text, found.end(), self.stop):
                word = f"{name}{value.group().strip()}"
                return Fault(f"{word} {NO_MEANING}", self.at, value.end() - found.start())
        hint = ""
        if after in ("O", "o"):
            hint = LETTER_O
        elif after == "=":
            hint = "no = between an address and its number"
        elif lost := _LOST.match(self.text, found.end(), self.stop):
            hint = f"what wrote the program could not compute this number and wrote {lost.group(1)}"
        elif letters := _LETTERS.match(self.text, self.at, self.stop):
            hint = near(letters.group(), FEEDS, 1)
        what = f", found {after!r}" if after else ""
        return Fault(f"{name} needs a number{what}", self.at, found.end() - found.start(), hint)


Read = Callable[[Cursor], None]


# Where the words of a line stand: between its beginning and its comment, without the mark that joins it to the next.

_BEFORE_COMMENT = re.compile(r'(?:[^;"]++|"[^"]*+(?:"|$))*+')


def bounds(builder: ProgramBuilder, line: int) -> tuple[int, int, int, bool]:
    """Begin and end of the words, the place of the comment or -1, and whether the line ends in ~."""
    starts, text = builder.line_starts, builder.text
    begin = int(starts[line])
    end = int(starts[line + 1]) if line + 1 < len(starts) else len(text)
    content = text[begin:end].rstrip()
    if begin == 0 and content.startswith("\ufeff"):
        begin, content = 1, content[1:]
    tilde = content.endswith("~")
    content = content.removesuffix("~")
    comment = -1
    if ";" in content and (words := _BEFORE_COMMENT.match(content)) and words.end() < len(content):
        comment, content = begin + words.end(), words.group()
    return begin, begin + len(content.rstrip(" \t")), comment, tilde
