"""Reading frames: one word a frame, one frame a line; frames tied by `*` become one block.

A frame is `N<number> <address><integer> <marks>`. Marks stand after the integer in any order, blanks before each;
the mark of an increment may also stand before it (`Z@-1000`). Their glyphs on the panel are keys; here they are

====  ==============================================================
`*` this frame and the next are one command
`~` at rapid
`@` increment (on some G frames a switch; the source lost its glyph)
====  ==============================================================

Frames without N count on from the one before, the first is 0; where a number so counted meets another, the later frame
has it. `;` to the end of a line is a comment: an extension of this library, the control has none. Cyrillic letters
that look like addresses are read as these, with a warning.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from string import ascii_lowercase

from mnclab.text.alarm import Alarm
from mnclab.text.dialect import Numbered, Numbers, Reference, unknown
from mnclab.text.program import AT_MARK, GROUP_MARK, INCREMENTAL, RAPID_MARK, Program, ProgramBuilder, readable
from mnclab.text.words import characters, line_starts

COMMENT = ";"
MARKS = {"*": GROUP_MARK, "~": RAPID_MARK, "@": INCREMENTAL | AT_MARK}
MARKED = "GXZ"  # addresses that ~ and @ may stand on
ADDRESSES = "GXZFSPMT"
DIGITS = 9
REPEATED = 1100  # G25 names frames up to 999, and a group that one of them belongs to goes on a little
BLANKS = " \t\ufeff"

_LOOKS_LATIN = dict(zip("ХМРТСЗхмртсз", "XMPTCZ" * 2, strict=True))
_FOLD = str.maketrans(_LOOKS_LATIN | {c: c.upper() for c in ascii_lowercase})
_WORD = re.compile(r"([A-Z])[ \t]*(?:(@)[ \t]*)?([+-]?[0-9]+)")
_CHAMFER = re.compile(r"[+-][ \t]*45(?![0-9])")


@readable
def read(text: str, name: str = "program") -> Program:
    """A program of frames; faults are collected in its alarms."""
    builder = ProgramBuilder(text, name, "nc-31", line_starts(characters(text)), COMMENT)
    frames = _Frames(builder)
    starts = builder.line_starts.tolist()
    for begin, end in zip(starts, [*starts[1:], len(text)], strict=True):
        frames.read_line(begin, end)
    frames.close()
    return builder.build()


class _Frames:
    """The frames of a program as they come: their numbers, the group that is open, the faults."""

    def __init__(self, builder: ProgramBuilder) -> None:
        self.builder, self.text, self.alarm = builder, builder.text.translate(_FOLD), builder.alarm
        self.group = -1  # offset of the block that the frame belongs to
        self.group_mark = -1  # where the mark stands that keeps it open, -1 when it is closed
        self.last = -1  # number of the frame before
        self.last_written = -1
        self.blocks: dict[int, int] = {}  # number of a frame -> offset of its block
        self.shadowed: set[int] = set()  # blocks with a frame whose number another one has

    def read_line(self, begin: int, end: int) -> None:
        stop = begin + len(self.text[begin:end].partition(COMMENT)[0].rstrip(BLANKS + "\r\n"))
        at = self.skip(begin, stop)
        if at >= stop:
            return
        for i in range(at, stop):
            if (original := self.builder.text[i]) in _LOOKS_LATIN:
                self.alarm(f"{original!r} is a Cyrillic letter, read as {self.text[i]}", i, severity="warning")
        inside = self.group_mark >= 0
        if not inside:
            self.builder.block(at)
            self.group = at
        self.group_mark = self.read_frame(at, stop, inside)

    def close(self) -> None:
        """The end of the program: no group may be open; numbers become labels."""
        if self.group_mark >= 0:
            self.alarm("the program ends inside a group: its last frame has no mark *", self.group_mark)
        for number, block in self.blocks.items():
            if block not in self.shadowed:
                self.builder.labels[str(number)] = block

    def skip(self, at: int, stop: int) -> int:
        while at < stop and self.text[at] in BLANKS:
            at += 1
        return at

    def read_frame(self, at: int, stop: int, inside: bool) -> int:
        """Number, word and marks; where the mark * stands, or -1. After a fault any * of the line will do."""
        any_mark = self.text.find("*", at, stop)
        at = self.read_number(at, stop)
        match = _WORD.match(self.text, at, stop) if at >= 0 else None
        if match is None:
            if at >= 0:
                self.refuse(at, stop)
            return any_mark
        address, digits = match[1], match[3]
        length = match.end() - at
        if match.end() < stop and self.text[match.end()] in ".,":
            self.refuse_point(address, at, match.end(), stop)
        elif len(digits.lstrip("+-")) > DIGITS:
            self.alarm(f"{address} has more than {DIGITS} digits", at, length)
        elif address not in ADDRESSES:
            what = "N stands twice in this line" if address == "N" else f"{address} is no address of this control"
            hint = "a line holds one frame" if address == "N" else f"its addresses: N {' '.join(ADDRESSES)}"
            self.alarm(what, at, length, hint)
        elif inside and address == "G":
            message = f"{match[0]} stands inside a group: G is the first frame of its group"
            self.alarm(message, at, length, "the mark * of the frame before ties it to this one")
        else:
            return self.read_marks(match, stop, any_mark)
        return any_mark

    def read_number(self, at: int, stop: int) -> int:
        """The number of the frame; where its word begins, -1 after a fault."""
        begin, number = at, self.last + 1
        if self.text[at] == "N":
            at = self.skip(at + 1, stop)
            digits = at
            while at < stop and self.text[at] in "0123456789":
                at += 1
            if not 0 < at - digits <= DIGITS or self.text[at : at + 1] in tuple(".,"):
                self.alarm(f"N needs a whole number of at most {DIGITS} digits", begin, at - begin)
                self.last = number
                return -1
            number, length = int(self.text[digits:at]), at - begin
            if number == self.last_written:
                self.alarm(f"N{number} numbers two frames", begin, length)
            elif number < self.last_written:
                hint = "frames are carried out in the order of their numbers"
                self.alarm(f"N{number} stands after N{self.last_written}: numbers must rise", begin, length, hint)
            self.last_written = max(number, self.last_written)
            at = self.skip(at, stop)
            if at >= stop:
                self.alarm(f"frame N{number} has no word", begin, length)
                at = -1
        self.last = number
        if number <= REPEATED:
            if number in self.blocks:
                self.shadowed.add(self.blocks.pop(number))
            self.blocks[number] = self.group
        return at

    def read_marks(self, match: re.Match[str], stop: int, any_mark: int) -> int:
        """The marks behind the integer, and the word with them; where the mark * stands, or -1."""
        address, at = match[1], match.end()
        flag = MARKS["@"] if match[2] else 0
        places = {"@": match.start(2)} if match[2] else {}
        while (at := self.skip(at, stop)) < stop:
            mark = self.text[at]
            if mark not in MARKS:
                self.refuse_after(match, at, stop)
                return any_mark
            if flag & MARKS[mark]:
                self.alarm(f"the mark {mark} is written twice on {match[0]}", at)
                return any_mark
            flag |= MARKS[mark]
            places[mark] = at
            at += 1
        for mark in "~@":
            if mark in places and address not in MARKED:
                where = f"it belongs to {', '.join(MARKED)}"
                self.alarm(f"the mark {mark} has no meaning on {address}", places[mark], 1, where)
                return any_mark
        self.builder.word(address, float(match[3]), match.start(), match.end() - match.start(), flag)
        return places.get("*", -1)

    def refuse(self, at: int, stop: int) -> None:
        """The fault where a word should begin."""
        c, following = self.text[at], self.text[at + 1 : stop].lstrip(" \t")[:1]
        if c in MARKS:
            self.alarm(f"the mark {c} stands before its word", at, hint="write it after the number")
        elif "A" <= c <= "Z" and re.match(r"[ \t]*O[O0-9]*(?![A-Z])", self.text[at + 1 : stop]):
            self.alarm(f"{c} needs a whole number", at, hint="the letter O stands where the digit 0 was meant")
        elif "A" <= c <= "Z":
            self.alarm(f"{c} needs a whole number" + (f", found {following!r}" if following else ""), at)
        elif c in "0123456789":
            self.alarm(f"{c!r} needs an address letter before it", at)
        elif "\u0400" <= c <= "\u04ff":
            self.alarm(f"{self.builder.text[at]!r} is a Cyrillic letter and no address", at)
        else:
            self.alarm(f"{c!r} has no meaning here", at)

    def refuse_point(self, address: str, begin: int, at: int, stop: int) -> None:
        """A decimal point or comma; what the number would be in discretes."""
        digits = re.compile(r"[+-]?[0-9]{1,9}[.,]?[0-9]{0,9}").search(self.text, begin + 1, stop)
        hint = "numbers are whole, in discretes"
        if digits and address in "XZ":
            whole = float(digits[0].replace(",", ".")) * 100
            hint = f"{address} counts 0.01 mm: write {address}{whole:.0f} for {digits[0].replace(',', '.')}"
        self.alarm(f"{address} has a decimal {'point' if self.text[at] == '.' else 'comma'}", at, hint=hint)

    def refuse_after(self, match: re.Match[str], at: int, stop: int) -> None:
        """The fault behind a word: a second word, a mark of another control, a stray character."""
        c = self.text[at]
        second = _WORD.match(self.text, at, stop)
        if _CHAMFER.match(self.text, at, stop):
            self.alarm(f"the mark {c}45 (chamfer of 45 degrees) is not described in the source", at, 3)
        elif second and second[1] == "N":
            self.alarm(f"{second[0]} begins a second frame in this line", at, len(second[0]), "a line holds one frame")
        elif second:
            hint = "write it into the next line; the mark * ties frames of one command"
            self.alarm(f"{second[0]} is a second word: a frame holds one", at, len(second[0]), hint)
        elif c in "0123456789":
            self.alarm(f"{c!r} needs an address letter before it", at, hint="a blank inside a number splits it")
        else:
            self.refuse(at, stop)


# The numbers of NC-31 frames: those without one count on from the frame before, and P of G25 names the first and last of
# a range.

_NUMBER = re.compile(r"[ \t\ufeff]*+(?:N[ \t]*+(\d++)[ \t]*+)?(?=[^;\s])", re.IGNORECASE)
_RANGE = re.compile(r"[PР][ \t]*+(\d++)", re.IGNORECASE)
FIRST, STEP, LAST = 1, 1, 999


def numbers(program: Program) -> Numbers:
    """The numbers of the frames that have one, how many follow each without, and the ranges of G25."""
    blocks: list[Numbered] = []
    places: dict[int, tuple[int, int]] = {}  # number -> the numbered frame that it counts from, and how far
    before, number, counted = 0, -1, 0
    for begin in program.line_starts.tolist():
        frame = _NUMBER.match(program.text, begin)
        if frame is None:
            continue
        if frame[1]:
            blocks.append(Numbered(frame.start(1), len(frame[1]), frame[1]))
            number, counted = int(frame[1]), 0
        else:
            number, counted = number + 1, counted + 1
            if blocks:
                blocks[-1] = blocks[-1]._replace(counted=counted)
            else:
                before += 1
        places[number] = (len(blocks) - 1, counted if blocks else number)
    return Numbers(blocks, list(_ranges(program, places)), FIRST, STEP, before)


def _ranges(program: Program, places: dict[int, tuple[int, int]]) -> Iterator[Reference]:
    for block in program:
        words = block.words
        if not (words and words[0].address == "G" and words[0].value == 25.0):
            continue
        given = next((word for word in words if word.address == "P"), None)
        if given is None:
            continue
        at = int(program.line_starts[given.span.line - 1]) + given.span.column - 1
        match = _RANGE.match(program.text, at)
        if match is None:
            continue
        first, last = divmod(int(match[1]), 1000)
        for named in (first, last):
            if named not in places:
                raise unknown("G25 P", named).changed(span=given.span, source=program)
        yield Reference(match.start(1), len(match[1]), (places[first], places[last]), written)


def written(values: Sequence[int]) -> str:
    """First and last frame in one number; an Alarm where it has no room for them."""
    first, last = values
    if max(values) > LAST:
        raise Alarm(f"G25 P would name frame {max(values)}, and names frames up to {LAST}", hint="choose a smaller step")
    return str(1000 * first + last)
