"""Reading programs of ISO mills: tapes between `%`, programs O, comments in brackets, block skip, words and statements.

Lines of nothing but words with numbers are found for the whole text at once; the others are read here, one by one. A program
number and the N of a block become jump targets, the latter only where the program jumps: `O1000`, `O1000 N10`, and where a
number stands again `O1000 N10 (2)`.
"""

from __future__ import annotations

import re
from bisect import bisect_right
from collections import Counter
from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from mnclab.controls.g43.reading import formulas
from mnclab.controls.g43.reading.statements import (
    HEAD,
    HINTS,
    LineFault,
    OWords,
    Statements,
    assignments,
    end_of_operand,
)
from mnclab.controls.word_address.reader import Labels, Marks, clean_blocks, numbered, read_words, skip_blanks
from mnclab.text.alarm import Alarm, Span
from mnclab.text.dialect import Numbered, Numbers, Reference, code_of, one_number, unknown
from mnclab.text.program import MOST_WORDS, Program, ProgramBuilder, readable
from mnclab.text.words import Scan, scan

COMMENT = r"[(;]"
BEFORE = " \t\ufeff\0"  # what may stand before a line: punched tapes begin with NUL
END = "\r\n\0"
END_OF_TEXT = "\x1a"  # of old disks
AXES, GOING = "XYZ", {1.0, 2.0, 3.0, 90.0, 91.0}
POLAR = {"@": "a distance of polar coordinates", "^": "an angle of polar coordinates"}
CALLS = (65.0, 66.0)  # G words with arguments
_SAID = re.compile(r"[^\s\0\x1a%]")
_SKIP = re.compile(r"/[ \t]*([1-9])?(?!\d)")
_LABEL = re.compile(r"N[ \t]*(\d{1,9})(?![\d.])[ \t]*", re.IGNORECASE)
_FRACTION = re.compile(r"N[ \t]*\d{1,9}\.\d{0,9}(?![\d.])[ \t]*", re.IGNORECASE)
_NUMBER = re.compile(r"(?:O|:)[ \t]*(\d{1,8})(?![\d.])", re.IGNORECASE)
_CORNER = re.compile(r",[ \t]*([CR])[ \t]*(?=[-+.\d#\[])", re.IGNORECASE)
_PLAIN = re.compile(r"[-+]?(?:\d+(?:\.\d*)?|\.\d+)")
_BARE = re.compile(rf"[-+ \t]*({'|'.join(sorted(formulas.NAMES, reverse=True))})[ \t]*(?=\[)", re.IGNORECASE)
_APART = re.compile(r"([-+])[ \t]++(?=[\d.])")  # blanks mean nothing to Fanuc and LinuxCNC: Z - 3.0
_OVER = re.compile(r"[ \t]*/[ \t]*(?=\[)")
_CALL = re.compile(r"G[ \t]*0*6[56](?![\d.])", re.IGNORECASE)
_PRINTED = re.compile(r"(?:POPEN|PCLOS|DPRNT|BPRNT)(?![A-Z])", re.IGNORECASE)
_GOOD_WORDS = re.compile(r"[ \t]*+(?:[A-Z][ \t]*+[-+]?[\d.]++[ \t]*+){2,}+", re.IGNORECASE)


@readable
def read(text: str, name: str = "program") -> Program:
    """The program of a text."""
    found = scan(text)
    return _Reader(text, name, found).program()


def other_word(builder: ProgramBuilder, text: str, at: int, stop: int) -> int:
    """A word whose value is a variable or stands in brackets (`X#1`, `X-[#1+2]`), or a corner (`,R5`); its end, or -1."""
    corner = _CORNER.match(text, at, stop)
    if corner:
        address, value = f",{corner.group(1).upper()}", corner.end()
        if number := _PLAIN.match(text, value, stop):
            builder.word(address, float(number.group()), at, number.end() - at)
            return number.end()
    elif text[at].isascii() and text[at].isalpha():
        address, value = text[at].upper(), skip_blanks(text, at + 1, stop)
    elif text[at] in POLAR:
        raise Alarm(f"{text[at]} is {POLAR[text[at]]} on LinuxCNC: not built", builder.span(at), hint="write X and Y")
    else:
        return -1
    if (sign := _APART.match(text, value, stop)) and (number := _PLAIN.match(text, sign.end(), stop)) and address not in "NO":
        builder.word(address, float(sign.group(1) + number.group()), at, number.end() - at)
        return number.end()
    end = end_of_operand(text[value:stop], 0)
    if end < 0 and (bare := _BARE.match(text, value, stop)):  # LinuxCNC: Y SQRT[4]
        end = end_of_operand(text[value:stop], bare.end() - value)
        if bare.group(1).upper() == "ATAN" and (over := _OVER.match(text, value + end, stop)):
            end = end_of_operand(text[value:stop], over.end() - value)
    if end < 0:
        return -1
    if address in "NO":
        raise Alarm(f"the {'N of a block' if address == 'N' else 'O of a program'} is a number, no formula", builder.span(at))
    builder.word(address, formulas.parse(text[value : value + end], builder.span(value)), at, value + end - at)
    return value + end


MARKS = Marks(re.compile(COMMENT), other=other_word, hints=HINTS)


class _Reader:
    def __init__(self, text: str, name: str, found: Scan) -> None:
        self.text = text
        self.builder = ProgramBuilder(text, name, "g43", found.starts, COMMENT)
        self.statements, self.o_words = Statements(self.builder), OWords(self.builder)
        self.labels: Labels = []
        self.programs: Labels = []
        self.another = -1  # the % of another program
        first, last = self.tape(found)
        special = found.count > MOST_WORDS
        letter, value = found.letter, found.value
        odd = letter == ord("O")
        for address, is_odd in (("G", lambda v: np.isin(v, CALLS)), ("N", lambda v: (v == 0) | (v % 1 > 0))):
            words = np.flatnonzero(letter == ord(address))
            odd[words] = is_odd(value[words])
        special[found.lines_of(odd)] = True
        special[:first] = special[last:] = True
        self.jumps = self.goes_to(found)
        self.found = found.without(special) if special.any() else found
        self.odd = first + np.flatnonzero(~self.found.clean[first:last])

    def tape(self, found: Scan) -> tuple[int, int]:
        """The lines of the program: from the first % on, if nothing but comments stands above it, to the next one."""
        first, stop, text = 0, len(found.starts), self.text
        at = text.find("%")
        while at >= 0:
            line = int(np.searchsorted(found.starts, at, "right")) - 1
            begin = int(found.starts[line])
            if text[begin:at].strip(BEFORE):  # inside a line
                at = text.find("%", at + 1)
            elif not first and nothing_said(text[:begin]):
                first = line + 1
                self.builder.block(at)
                at = text.find("%", int(found.starts[first]) if first < len(found.starts) else len(text))
            else:
                self.end_tape(at)
                return first, line
        return first, stop

    def end_tape(self, at: int) -> None:
        """What stands after the last % is named."""
        text, end = self.text, at + 1
        while end < len(text) and text[end] not in "\r\n":
            end += 1
        said = text[at + 1 : end].strip(BEFORE + END_OF_TEXT)
        if said and said[0] not in "(;":
            self.another = at
        if begun := _SAID.search(text, end):
            self.builder.alarm("what stands after the last % is not obeyed", begun.start(), severity="warning")

    @staticmethod
    def goes_to(found: Scan) -> bool:
        """Whether a clean line goes to a block: M97, M99 with P, or M98, whose program may name a block to come back to."""
        codes = (found.letter == ord("M")) & np.isin(found.value, (97.0, 98.0, 99.0))
        if not codes.any():
            return False
        return bool(np.isin(found.lines_of(codes), found.lines_of(found.letter == ord("P"))).any())

    def program(self) -> Program:
        builder = self.builder
        bulk = clean_blocks(builder, self.found, self.labels, True)
        for index in self.odd:
            self.read_line(int(index))
        self.statements.close()
        self.o_words.close()
        if self.another >= 0:
            builder.block(self.another)
            hint = "a file holds one of them; those of O numbers may stand one after another"
            builder.alarm("another program begins here", self.another, 1, hint)
        elif max(self.statements.last, self.o_words.last) >= 0:
            builder.block(len(self.text))  # there is a block after every loop
        self.set_labels()
        program = builder.build(bulk)
        if faults := lonely_corners(program):
            program = replace(program, alarms=tuple(sorted((*program.alarms, *faults), key=lambda a: a.span or Span(0, 0))))
        return program

    # --- lines -------------------------------------------------------------------------------------------------------

    def read_line(self, index: int) -> None:
        builder, text = self.builder, self.text
        begin = int(builder.line_starts[index])
        end = int(builder.line_starts[index + 1]) if index + 1 < len(builder.line_starts) else len(text)
        line = text[begin:end].rstrip(END)
        if line.endswith(END_OF_TEXT) and not text[end:].strip(END):
            line = line.rstrip(END_OF_TEXT + END)
        try:
            parts = list(without_comments(line))
        except LineFault as fault:
            self.fault(fault, begin, begin)
            return
        code = "".join(parts)[: len(line)]
        at = len(code) - len(code.lstrip(BEFORE))
        if at == len(code):
            if line.strip(BEFORE):
                builder.block(begin + len(line) - len(line.lstrip(BEFORE)), plain=True)
            return
        self.warn_of_words(line, code, begin)
        try:
            self.read_block(line, code, begin, at)
        except LineFault as fault:
            self.fault(fault, begin)
        except Alarm as alarm:
            builder.note(alarm)

    def fault(self, fault: LineFault, begin: int, block: int = -1) -> None:
        if block >= 0:
            self.builder.block(block)
        self.builder.alarm(fault.message, begin + fault.at, fault.length, fault.hint)

    def warn_of_words(self, line: str, code: str, begin: int) -> None:
        """A semicolon is the end of a block, and on paper the next one may stand behind it."""
        at = len(code.rstrip(" \t"))
        mark = line.find(";", at)
        if mark >= 0 and _GOOD_WORDS.fullmatch(line, mark + 1):
            self.builder.alarm(
                "what stands after ';' is taken for a comment", begin + mark, 1, "write a line for each block", "warning"
            )

    def read_block(self, line: str, code: str, begin: int, at: int) -> None:
        builder, start, skip = self.builder, begin + at, 0
        label = _LABEL.match(code, at)
        if label and code[label.end() : label.end() + 1] == "/":  # N10 /2 G0
            at = label.end()
        if code[at] == "/":
            mark = _SKIP.match(code, at)
            if mark is None:
                builder.block(start)
                raise LineFault("/ is followed by the number of a switch, 1 to 9", at)
            skip = int(mark.group(1) or 1)
            at = skip_blanks(code, mark.end(), len(code))
        label = label or _LABEL.match(code, at)
        if label:
            at = max(at, label.end())
        elif fraction := _FRACTION.match(code, at):
            said = fraction.group().strip()
            builder.alarm(f"{said} is no whole number: no jump finds this block", begin + at, len(said), severity="warning")
            at = fraction.end()
        if self.o_words.read(code, begin, at, start, skip):
            if label:
                self.labels.append((start, int(label.group(1))))
            return
        head = HEAD.match(code, at)
        call = None if head else _CALL.search(code, at)
        keyword = head.group().upper() if head else call.group()[:1].upper() + "6" + call.group()[-1] if call else ""
        builder.block(start, "" if keyword in ("THEN", "ELSE") else keyword, skip)
        if label:
            self.labels.append((start, int(label.group(1))))
        beside = assignments(code, at) if "=" in code and keyword in ("", "#") else []
        if beside and "".join(code[a:b] for a, b in outside(beside, at, len(code))).strip():
            self.read_mixed(line, code, begin, at, beside, bool(label), skip)
            return
        if head:
            self.statements.read(code, begin, at, message_of(line))
            self.jumps |= self.statements.jumps
            return
        if word := _PRINTED.match(code, at):
            builder.alarm(f"{word.group().upper()} prints nothing here", begin + at, len(word.group()), severity="warning")
            return
        number = _NUMBER.match(code, at)
        if number:
            self.begin_program(number, begin)
            at = number.end()
        if call:  # what stands behind it are arguments
            if code[at : call.start()].strip(" \t"):
                raise LineFault("a call stands alone in its block", call.start(), hint="write two blocks")
            at = call.end()
        first = not (label or number or call)
        for a, b in pieces(code, line, at):
            if not read_words(builder, self.text, begin + a, begin + b, MARKS, self.labels, first):
                return
            first = False
        if call:
            self.arguments()
        self.jumps = self.jumps or bool(call) or {"M", "P"} <= set(code.upper())

    def read_mixed(
        self, line: str, code: str, begin: int, at: int, beside: list[tuple[int, int]], label: bool, skip: int
    ) -> None:  # fmt: skip
        """Words and assignments in one line (LinuxCNC): blocks of their own, and the words read what was there before."""
        builder, words = self.builder, outside(beside, at, len(code))
        lead = [span for span in beside if not "".join(code[a:b] for a, b in words if a < span[0]).strip()]
        rest = "".join(code[a:b] for a, b in words)
        written = {code[a : code.find("=", a)].replace(" ", "").lower() for a, _ in lead}
        read = set(re.findall(r"#(?:\d+|<[^<>]*>|[#\[])", rest.replace(" ", "").lower()))
        if read and (written & read or any(name[1:2] in "#[" for name in written | read) and lead):
            raise LineFault("a variable is read and written in one block", lead[0][0], hint="write two blocks")

        def assign(span: tuple[int, int], first: bool) -> None:
            if not first:
                builder.block(begin + span[0], "#", skip)
            self.statements.read(code[: span[1]], begin, span[0], "")
            builder.word("beside", None, begin + span[0], span[1] - span[0])

        for k, span in enumerate(lead):
            assign(span, k == 0)
        fresh = not lead
        for a, b in words:
            for c, d in pieces(code[:b], line, a):
                if not fresh:
                    builder.block(begin + c + len(code[c:d]) - len(code[c:d].lstrip()), "", skip)
                    fresh = True
                if not read_words(builder, self.text, begin + c, begin + d, MARKS, self.labels, not label and not lead):
                    return
        for span in beside[len(lead) :]:
            assign(span, False)

    def arguments(self) -> None:
        """M is an argument like others, G is none."""
        builder = self.builder
        for k in range(int(builder.blocks[-1][4]) - builder.before, len(builder.words)):
            address, value, form, flag, at, length = builder.words[k]
            if address == builder.addresses.get("G"):
                builder.alarm("G is no argument of a macro", at, length)
            elif address == builder.addresses.get("M"):
                address = builder.addresses.setdefault("argument", len(builder.addresses))
                builder.words[k] = (address, value, form, flag, at, length)

    def begin_program(self, number: re.Match[str], begin: int) -> None:
        value = int(number.group(1))
        at, length = begin + number.start(), number.end() - number.start()
        if any(value == known for _, known in self.programs):
            self.builder.alarm(f"O{value} stands twice", at, length, "a number is that of one program")
        self.statements.close()
        self.programs.append((self.builder.blocks[-1][0], value))
        self.builder.word("O", float(value), at, length)

    # --- jump targets ------------------------------------------------------------------------------------------------

    def set_labels(self) -> None:
        labels = self.builder.labels
        for at, number in reversed(self.programs):
            labels[f"O{number}"] = at
        labels["%"] = 0
        if not self.jumps:
            return
        starts, seen = [at for at, _ in self.programs], Counter[str]()
        for at, number in sorted(self.labels):
            place = bisect_right(starts, at) - 1
            name = f"O{self.programs[place][1]} N{int(number)}" if place >= 0 else f"N{int(number)}"
            seen[name] += 1
            labels[name if seen[name] == 1 else f"{name} ({seen[name]})"] = at


def lonely_corners(program: Program) -> list[Alarm]:
    """An Alarm at each corner that the next block does not go on from: a corner lies between two elements."""
    faults = []
    for k, name in enumerate(program.addresses):
        for at in np.flatnonzero(program.address == k) if name in (",R", ",C") else ():
            block = after = int(np.searchsorted(program.first, at, "right")) - 1
            while (after := after + 1) < len(program) and program.first[after] == program.first[after + 1]:
                pass  # a comment
            words = program[after].words if after < len(program) else ()
            codes = {word.value for word in words if word.address == "G"}
            goes = any(word.address in AXES for word in words) and codes <= GOING
            if not goes or program.keywords[program.keyword[after]] or program.skip[[block, after]].any():
                hint = "the block after it holds X, Y or Z, with G1, G2 or G3 if with a G word, and is not passed over"
                faults.append(Alarm(f"{name} lies between two lines or arcs", program.word(int(at)).span, hint=hint))
    return faults


def nothing_said(text: str) -> bool:
    """Whether lines hold nothing but comments."""
    lines = (line.strip(BEFORE) for line in text.splitlines())
    return all(not line or line[0] in "(;" for line in lines)


def outside(spans: list[tuple[int, int]], at: int, stop: int) -> list[tuple[int, int]]:
    """The parts of a line between some others."""
    return list(zip([at, *(b for _, b in spans)], [*(a for a, _ in spans), stop], strict=True))


def without_comments(line: str) -> Iterator[str]:
    """The parts of a line, with blanks in the place of comments: `( … )`, and from `;` on."""
    at = 0
    while at < len(line):
        marks = [k for k in (line.find("(", at), line.find(";", at)) if k >= 0]
        if not marks:
            yield line[at:]
            return
        mark = min(marks)
        yield line[at:mark]
        if line[mark] == ";":
            yield " " * (len(line) - mark)
            return
        close, again = line.find(")", mark), line.find("(", mark + 1)
        if close < 0:
            raise LineFault("a comment is not closed: ')' is missing", mark)
        if mark < again < close:
            raise LineFault("a comment cannot stand inside another", again, hint="write other brackets in a comment: [ ] or < >")
        yield " " * (close + 1 - mark)
        at = close + 1


def pieces(code: str, line: str, at: int) -> Iterator[tuple[int, int]]:
    """Where the parts of a line between comments begin and end."""
    stop = len(code.rstrip(" \t"))
    while at < stop:
        while at < stop and line[at] == "(":
            at = line.find(")", at) + 1
        mark = line.find("(", at, stop)
        end = mark if mark >= 0 else stop
        if end > at:
            yield at, end
        at = end


def message_of(line: str) -> str:
    """The first comment of a line."""
    begin = line.find("(")
    return line[begin + 1 : line.find(")", begin)].strip() if begin >= 0 else ""


# The numbers of blocks of ISO mills, and what names them: GOTO of the same program, P of M99 in the one that called.

_GOTO = re.compile(r"(?<![A-Z])GOTO[ \t]*+(?:(\d++)(?![.\d])|(?=(\S)))", re.IGNORECASE)
_M99 = re.compile(r"(?<![A-Z])M[ \t]*+0*+99(?![\d.])", re.IGNORECASE)
_P = re.compile(r"(?<![A-Z])P[ \t]*+(?:(\d++)(?![\d.])|(?=(\S)))", re.IGNORECASE)
_PROGRAM = re.compile(r"[ \t\ufeff]*+(?:O|:)[ \t]*+\d", re.IGNORECASE)


def numbers(program: Program) -> Numbers:
    """The numbers, and every word that jumps to one; an Alarm where a jump computes its target or has none."""
    blocks = numbered(program)
    return Numbers(blocks, list(_references(program, blocks)))


def _references(program: Program, blocks: list[Numbered]) -> Iterator[Reference]:
    code, starts = code_of(program.text), program.line_starts.tolist()
    begun = [at for at in starts if _PROGRAM.match(code, at)]  # the programs of O numbers
    places: dict[tuple[int, int], list[int]] = {}  # program, number -> the blocks that have it
    for index, block in enumerate(blocks):
        places.setdefault((bisect_right(begun, block.offset), int(block.old)), []).append(index)
    for jump in _GOTO.finditer(code):
        own = bisect_right(begun, jump.start())
        found = places.get((own, _target(program, jump, "GOTO")), [])
        below = [k for k in found if blocks[k].offset > jump.start()]
        yield _reference(program, jump, "GOTO", (below or found)[:1])
    for begin, end in zip(starts, [*starts[1:], len(code)], strict=True):
        back = _P.search(code, begin, end) if _M99.search(code, begin, end) else None
        if back is None:
            continue
        number, own = _target(program, back, "M99 P"), bisect_right(begun, begin)
        callers = [own] if own <= 1 else [k for k in range(len(begun) + 1) if k != own]
        yield _reference(program, back, "M99 P", [index for k in callers for index in places.get((k, number), [])])


def _target(program: Program, jump: re.Match[str], what: str) -> int:
    if jump[1] is None:
        span = program.span(jump.start(), len(jump[0].rstrip()))
        raise Alarm(f"{what} computes the block that it goes to, so its number cannot follow", span, source=program)
    return int(jump[1])


def _reference(program: Program, jump: re.Match[str], what: str, found: list[int]) -> Reference:
    """A reference to the only block that is meant."""
    span = program.span(jump.start(1), len(jump[1]))
    if not found:
        raise unknown(what, jump[1]).changed(span=span, source=program)
    if len(found) > 1:
        raise Alarm(f"{what} {jump[1]} may name {len(found)} blocks: give them different numbers first", span, source=program)
    return Reference(jump.start(1), len(jump[1]), ((found[0], 0),), one_number)
