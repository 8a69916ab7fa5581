"""Reading DIN/ISO programs (`%PART G71 *` … `N99999999 %PART G71 *`): the same statements as conversational ones, in G words.

The blocks that come out have the keywords and addresses of the conversational language, and the places of their words in
the DIN/ISO text. What is modal is worked out while reading, see `din_words`. Statements that have no DIN/ISO form (PATTERN
DEF, SEL TABLE, …) stand in these programs as they do in the others.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from itertools import takewhile

from mnclab.controls.tnc_620.reading import din_statements, din_words, sub_blocks
from mnclab.controls.tnc_620.reading.din_motion import Departure, Motion, approach
from mnclab.controls.tnc_620.reading.din_statements import REFUSED, STATEMENTS, said
from mnclab.controls.tnc_620.reading.din_words import Given, Modes, Raw
from mnclab.controls.tnc_620.reading.labels import name_of_program
from mnclab.controls.tnc_620.reading.statements import cycle_parameters, recognize
from mnclab.controls.tnc_620.reading.words import FLAGS, INCH, Cursor, Fault
from mnclab.text.alarm import Alarm
from mnclab.text.program import Program, ProgramBuilder
from mnclab.text.words import characters, line_starts

_HEAD = re.compile(r"%([^\r\n;*]*?)\b(G[ \t]*7[01])(?!\d)", FLAGS)
_FIRST = re.compile(
    r"(?:[\s\ufeff]++|;[^\r\n]*+)*+(?:/[ \t]*)?(?:%[^\r\n;]*?G[ \t]*7[01](?!\d)|(?:%[^\r\n]*+\s*+)?N[ \t]*\d)", FLAGS
)
_INCH = re.compile(r"(?:[\s\ufeff]++|;[^\r\n]*+)*+(?:N[ \t]*\d+[ \t]*)?%[^\r\n;*]*?\bG[ \t]*70(?!\d)", FLAGS)
_NUMBER = r"[+-]?(?:\d{1,8}(?:\.\d*)?|\.\d+)"
_PLAIN = re.compile(rf"(?:[XYZF][ \t]*+{_NUMBER}[ \t]*+)+", FLAGS)
_PLAIN_WORD = re.compile(rf"([XYZF])[ \t]*+({_NUMBER})", FLAGS)
_CALL = re.compile(r"L[ \t]*(?=[\d\"]|QS)", FLAGS)
#: Statements that these programs write as the others do.
_CONVERSATIONAL = re.compile(
    r"(?:PATTERN[ \t]+DEF|SEL[ \t]+(?:PATTERN|TABLE|PGM|CONTOUR)|CALL[ \t]+(?:PGM|SELECTED)|DECLARE|CYCL[ \t]+(?:DEF|CALL)|"
    r"GLOBAL[ \t]+DEF|TCH[ \t]+PROBE|PLANE|FUNCTION|CONTOUR[ \t]+DEF|TRANS[ \t]+DATUM|BLK[ \t]+FORM)(?![A-Z])|"
    r"Q[LRSC]?[ \t]?\d{1,6}[ \t]*=",
    FLAGS,
)


def begins(text: str) -> bool:
    """Whether the first block of a text is one of a DIN/ISO program."""
    return _FIRST.match(text) is not None


def read(text: str, name: str = "program") -> Program:
    """The blocks of a DIN/ISO program."""
    builder = ProgramBuilder(text, name, "tnc-620", line_starts(characters(text)), ";")
    raw = list(din_words.blocks(builder))
    reader = _Reader(builder, _INCH.match(text) is not None)
    for one, (modes, above) in zip(raw, din_words.modes_before(text, raw), strict=True):
        reader.above = above
        reader.read(one, modes)
    reader.finish()
    program = builder.build()
    object.__setattr__(program, "said", said)
    return program


class _Reader:
    """Makes blocks of the language one after another; remembers what a block means for the next ones."""

    def __init__(self, builder: ProgramBuilder, inch: bool) -> None:
        self.builder, self.text, self.inch = builder, builder.text, inch
        self.begun = self.ended = False
        self.axis = "Z"  # of the tool
        self.above = Modes()  # what the text above the block says, whatever way leads there
        self.called = ""  # the program called last, while it is not known what holds behind it
        self.leaves: Departure | None = None  # G27, which the next block needs

    def read(self, raw: Raw, modes: Modes) -> None:
        """One block; a fault ends the reading of it alone."""
        before = len(self.builder.blocks), self.builder.before
        leaves, self.leaves = self.leaves, None
        at, stop = raw.parts[0] if raw.parts else (raw.start, raw.start)
        try:
            if at >= stop or self.text[at] == "*":
                self.leaves = leaves
                if leaves is None:
                    self.builder.block(raw.start, skip=raw.skip)
            else:
                if self.ended:
                    self.builder.alarm("nothing after the last block is obeyed", at, severity="warning")
                    self.ended = False
                self.block(raw, Cursor(self.builder, at, stop, self.inch), modes, leaves)
        except Fault as fault:
            self.hold(leaves or raw, before)
            self.builder.alarm(fault.message, fault.offset, fault.length, fault.hint)
        except Alarm as alarm:  # from the reader of formulas, which knows its place
            self.hold(leaves or raw, before)
            self.builder.note(alarm)

    def hold(self, raw: Raw | Departure, before: tuple[int, int]) -> None:
        """A block for a fault to stand in, where none was begun."""
        if (len(self.builder.blocks), self.builder.before) == before:
            self.builder.block(raw.start, skip=raw.skip)

    def finish(self) -> None:
        if self.leaves:
            self.builder.block(self.leaves.start, skip=self.leaves.skip)
            fault = self.leaves.fault()
            self.builder.alarm(fault.message, fault.offset, fault.length)

    def block(self, raw: Raw, cursor: Cursor, modes: Modes, leaves: Departure | None) -> None:
        begin = cursor.at
        if leaves is None and self.plain_line(raw, cursor, modes):
            return
        if leaves and self.text[begin] not in "GgXxYyZz":
            raise leaves.fault()
        if self.text[begin] == "%":
            self.percent(raw, cursor)
        elif _CONVERSATIONAL.match(self.text, begin, cursor.stop):
            self.conversational(raw, cursor)
        elif function := cursor.match(din_statements.FUNCTION):
            number = int(function.group(1))
            self.builder.block(raw.start, f"FN {number}", raw.skip)
            din_statements.function(cursor, number, begin)
        elif cursor.match(_CALL):
            self.builder.block(raw.start, "CALL LBL", raw.skip)
            din_statements.call_label(cursor)
        else:
            self.words(raw, modes, leaves)
            return
        if not cursor.done:
            raise cursor.unexpected()

    def plain_line(self, raw: Raw, cursor: Cursor, modes: Modes) -> bool:
        """A straight line of numbers alone under G01 and G90, of which long programs consist: read at once."""
        if self.called or not (modes[:2] == self.above[:2] == (1, 0)) or len(raw.parts) > 1:
            return False
        if not _PLAIN.fullmatch(self.text, cursor.at, cursor.stop):
            return False
        words = list(_PLAIN_WORD.finditer(self.text, cursor.at, cursor.stop))
        if len({word[1].upper() for word in words}) < len(words):
            return False
        self.builder.block(raw.start, "L", raw.skip, True)
        for word in words:
            value = float(word[2]) * (INCH if self.inch else 1.0)
            self.builder.word(word[1].upper(), value, word.start(), word.end() - word.start())
        return True

    def percent(self, raw: Raw, cursor: Cursor) -> None:
        """%NAME G71 begins and ends the program, %NAME calls another one."""
        begin = cursor.at
        found = cursor.match(_HEAD)
        if found is None and not self.begun:
            what = "the unit of the program is missing: G71 (millimetres) or G70 (inches) must follow its name"
            raise Fault(what, begin, max(1, len(cursor.rest().rstrip())))
        if found is None:
            cursor.at = begin + 1
            self.builder.block(raw.start, "CALL PGM", raw.skip)
            name_of_program(cursor, what="%")
            name = self.text[begin + 1 : cursor.at].strip()
            self.called = "" if name.upper().endswith(".H") else name
            return
        self.builder.block(raw.start, "END PGM" if self.begun else "BEGIN PGM", raw.skip)
        self.begun, self.ended = True, self.begun
        if name := found.group(1).strip():
            self.builder.word("name", name, self.text.index(name, begin), len(name))
        unit = "INCH" if found.group(2).endswith("0") else "MM"
        self.builder.word("unit", unit, found.start(2), len(found.group(2)))

    def conversational(self, raw: Raw, cursor: Cursor) -> None:
        """A statement in the words of the dialog, or an assignment."""
        begin = cursor.at
        statement = recognize(cursor)
        self.builder.block(raw.start, statement.keyword if statement else "", raw.skip)
        if statement is None:
            cursor.at = begin
            raise cursor.unexpected()
        statement.read(cursor)
        for at, stop in raw.parts[1:]:
            if not cursor.done:
                raise cursor.unexpected()
            cursor.at, cursor.stop = at, stop
            (statement.more or statement.read)(cursor)

    def words(self, raw: Raw, modes: Modes, leaves: Departure | None) -> None:
        """A block of words: a motion, or the statement of its G function."""
        given: list[Given] = []
        incremental, rest = modes.incremental, list(raw.parts)
        cursor = Cursor(self.builder, *rest[0], self.inch)
        while rest:
            cursor = Cursor(self.builder, *rest.pop(0), self.inch)
            more, incremental = din_words.read_words(cursor, incremental)
            given += more
            if more and more[-1].letter == "G" and din_words.has_tail(more[-1].code):
                break
        heads = [word for word in given if word.letter == "G" and (word.code in STATEMENTS or self.known(word))]
        strange = [word for word in given if word.letter == "G" and word not in heads and word.code not in _MODAL]
        if strange:
            raise self.refused(strange[0])
        if len(heads) > 1:
            what = f"G{heads[0].code:02} and G{heads[1].code:02} stand in one block: write two blocks"
            raise Fault(what, heads[1].at, heads[1].length)
        tool = next((word for word in given if word.letter in ("T", "text")), None)
        if leaves and (heads or tool):
            raise leaves.fault()
        if not heads and tool is None:
            self.warn_of_ways(given, modes)
            Motion(cursor, raw.start, raw.skip, modes, self.axis, leaves).write(given)
        elif not heads:
            self.tool_call(raw, cursor, given)
        else:
            self.statement(raw, cursor, heads[0], given, rest, modes)

    def warn_of_ways(self, given: Sequence[Given], modes: Modes) -> None:
        """Where a mode comes from a call or a repeat, and another one stands above in the text."""
        inherited = list(takewhile(lambda word: word.letter != "G" or word.code not in (90, 91), given))
        word = next((word for word in inherited if word.letter in din_words.MEASURED), None)
        if word and self.called:
            what = f"{word.shown(self.builder)} is read with G9{modes.incremental} as before %{self.called}"
            self.builder.alarm(what, word.at, word.length, "write G90 or G91 in this block", "warning")
        if word or len(inherited) < len(given):
            self.called = ""
        if word and din_words.MIXED != modes.incremental != self.above.incremental:
            self.warn(word, f"G9{modes.incremental}", f"G9{self.above.incremental}")
        word = next((word for word in given if word.letter in din_words.MEASURED), None)
        written = any(one.letter == "G" and one.code in din_words.PATHS for one in given)
        known = None not in (modes.path, self.above.path)
        if word and not written and known and din_words.MIXED != modes.path != self.above.path:
            self.warn(word, f"G{modes.path:02}", f"G{self.above.path:02}")

    def warn(self, word: Given, active: str, above: str) -> None:
        left = f"{active}, which the call or repeat before it leaves, although {above} stands above"
        what = f"{word.shown(self.builder)} is read with {left}"
        self.builder.alarm(what, word.at, word.length, f"write {active} in this block", "warning")

    def known(self, word: Given) -> bool:
        return word.code in _OTHERS or bool(word.code not in _MODAL and din_statements.cycle_of(word.code))

    def refused(self, word: Given) -> Fault:
        if why := REFUSED.get(word.code):
            return Fault(f"G{word.code:02} is refused: {why}", word.at, word.length)
        return Fault(f"G{word.code:02} is no G function of DIN/ISO programs", word.at, word.length)

    def tool_call(self, raw: Raw, cursor: Cursor, given: Sequence[Given]) -> None:
        """T5 G17 S1000."""
        self.builder.block(raw.start, "TOOL CALL", raw.skip)
        if plane := self.plane(cursor, given):
            self.axis = str(plane)
        moving = [word for word in given if word.letter == "G" and word.code not in (90, 91, *din_statements.PLANES, 20)]
        if moving and moving[0].code != 40:
            raise moving[0].fault(self.builder, "stands in a T block", "write two blocks")
        words = [word for word in given if word.letter != "G"]
        din_statements.renamed(cursor, -1, din_statements.CALL, words)

    def plane(self, cursor: Cursor, given: Sequence[Given]) -> str:
        """Add the tool axis that G17 to G19 mean."""
        codes = [word for word in given if word.letter == "G" and word.code in (17, 18, 19, 20)]
        for word in codes:
            din_words.put(cursor, "axis", word, din_statements.axis_of(self.text, word))
        return din_statements.PLANES[codes[-1].code] if codes else ""

    def statement(
        self, raw: Raw, cursor: Cursor, head: Given, given: Sequence[Given], rest: Sequence[tuple[int, int]], modes: Modes
    ) -> None:
        """A G function that is no path function, with its words."""
        code, words = head.code, [word for word in given if word is not head]
        if code == 26:
            self.lead(code, words, head)
            approach(cursor, head, words[0])
            return
        if code == 27:
            self.lead(code, words, head)
            self.leaves = Departure(raw.start, raw.skip, head, words[0])
            return
        if code in STATEMENTS:
            keyword, plain = STATEMENTS[code].keyword, [w for w in words if w.letter != "G" or w.code not in (90, 91)]
            self.builder.block(raw.start, keyword, raw.skip)
            if code == 30:
                self.plane(cursor, plain)
            plain = [w for w in plain if not (w.letter == "G" and w.code in din_statements.PLANES)]
            din_statements.renamed(cursor, code, STATEMENTS[code], plain)
            if code in din_statements.SENSES:
                din_words.put(cursor, "DR", head, din_statements.SENSES[code], inches=False)
            return
        self.with_tail(raw, cursor, head, words, rest, modes)

    def lead(self, code: int, words: Sequence[Given], head: Given) -> None:
        """The words of G26 and G27: R alone."""
        if [word.letter for word in words] != ["R"]:
            strange = next((word for word in words if word.letter != "R"), None)
            if strange:
                raise strange.fault(self.builder, f"does not belong to G{code}", "it takes R")
            raise Fault(f"G{code} needs the radius R of its arc", head.at, head.length)

    def with_tail(
        self, raw: Raw, cursor: Cursor, head: Given, words: Sequence[Given], rest: Sequence[tuple[int, int]], modes: Modes
    ) -> None:
        """A G function that reads what stands behind it in its own way."""
        code = head.code
        before = next((word for word in words if word.letter != "G" or word.code not in (90, 91, 40)), None)
        if before:
            raise before.fault(self.builder, f"does not belong to G{code:02}", "write two blocks")
        if code == 28:
            self.builder.block(raw.start, "CYCL DEF 8", raw.skip)
            sub_blocks.mirrored(cursor)
        elif code == 39:
            self.builder.block(raw.start, "CYCL DEF 12", raw.skip)
            din_statements.program_name(cursor, head)
        elif code == 98:
            self.builder.block(raw.start, "LBL", raw.skip)
            din_statements.set_label(cursor, head)
        elif code == 79:
            self.cycle_call(raw, cursor, modes)
        else:
            keyword = din_statements.cycle_of(code)
            self.builder.block(raw.start, keyword, raw.skip)
            if code == 55 and [modes.incremental + 90, *(word.code for word in words if word.code in (90, 91))][-1] == 91:
                raise head.fault(self.builder, "takes absolute coordinates", "write G90 before it")
            read = sub_blocks.in_words if code == 55 else cycle_parameters
            read(cursor)
            for at, stop in rest:
                if not cursor.done:
                    raise cursor.unexpected()
                cursor.at, cursor.stop = at, stop
                read(cursor)
        if not cursor.done:
            raise cursor.unexpected()

    def cycle_call(self, raw: Raw, cursor: Cursor, modes: Modes) -> None:
        """G79 calls the cycle here, G79 PAT at the points of a pattern, G79:G01 X Y Z at a position."""
        keyword = din_statements.called(cursor)
        words, _ = din_words.read_words(cursor, modes.incremental)
        paths = [word for word in words if word.letter == "G" and word.code in din_words.PATHS]
        if paths and paths[0].code in (0, 1) and keyword == "CYCL CALL":
            keyword = "CYCL CALL POS"
        self.builder.block(raw.start, keyword, raw.skip)
        for word in words:
            if word.letter != "G":
                din_words.put(cursor, word.letter, word)
            elif word.code not in (90, 91) and word is not next(iter(paths), None):
                raise word.fault(self.builder, "does not belong to G79", "write two blocks")
        if paths and paths[0].code == 0:
            din_words.put(cursor, "FMAX", paths[0], None)


_OTHERS = frozenset((26, 27, 28, 39, 55, 79, 98))
_MODAL = din_words.PATHS | {17, 18, 19, 20, 40, 41, 42, 43, 44, 90, 91}
