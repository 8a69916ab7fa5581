"""Lines of a DIN/ISO program into blocks, what is modal where a block begins, and its words."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, field
from typing import Any, Final, NamedTuple

from mnclab.controls.tnc_620.reading.words import FLAGS, LENGTHS, OWN, TEXT, Cursor, Fault, bounds, from_inches
from mnclab.text.expression import Expression
from mnclab.text.program import INCREMENTAL, ProgramBuilder

# Lines of a DIN/ISO program into blocks: `N10 G00 X+5 *`.
# A block ends with `*` or with its line; `/` before or after the number marks one that may be passed over, `;` begins a
# comment, `*` behind the number a structure block. A definition goes on over lines that begin with a parameter
# (`Q200=2`) and have no number, and any block over lines that end in `~`. In a formula `*` multiplies: it ends a block
# where the line ends behind it, or the next block begins.

_HEAD = re.compile(r"[ \t]*(/?)[ \t]*(N[ \t]*\d+)?[ \t]*(/?)[ \t]*", FLAGS)
_PIECE = re.compile(r'(?:[^"*]++|"[^"]*+(?:"|$)|\*(?![ \t]*+(?:$|/?[ \t]*+N[ \t]*+\d|%)))*+', FLAGS)
_PARAMETER = re.compile(r"Q[LRS]?[ \t]*\d+[ \t]*=", FLAGS)
_DEFINES = re.compile(r"(?:G[ \t]*[1-9]\d{2,3}|CYCL[ \t]+DEF|GLOBAL[ \t]+DEF|TCH[ \t]+PROBE)(?!\d)", FLAGS)
_PATTERN = re.compile(r"PATTERN[ \t]+DEF(?![A-Z])", FLAGS)


@dataclass
class Raw:
    """A block as it stands in the text: where it begins, its mark, and from where to where its words are."""

    start: int
    skip: bool = False
    parts: list[tuple[int, int]] = field(default_factory=list)


def blocks(builder: ProgramBuilder) -> Iterator[Raw]:
    """The blocks of the text of a builder, in order."""
    text, last, joined = builder.text, None, False
    for line in range(len(builder.line_starts)):
        at, stop, comment, tilde = bounds(builder, line)
        if at == stop and comment >= 0 and last is None:
            yield Raw(comment)
        while at < stop:
            head, piece = _HEAD.match(text, at, stop), None
            assert head is not None
            piece = _PIECE.match(text, head.end(), stop)
            assert piece is not None
            words = head.end(), piece.end()
            if last is not None and (joined or (not head.group(2) and _goes_on(text, last, *words))):
                last.parts.append((at, piece.end()) if joined else words)
            else:
                if last is not None:
                    yield last
                start = at + len(head.group()) - len(head.group().lstrip(" \t"))
                last = Raw(start, bool(head.group(1) or head.group(3)), [words])
            at, joined = piece.end() + 1, False
            if piece.end() < stop:  # behind it stands the * that ends the block
                yield last
                last = None
        joined = last is not None and (tilde or (joined and comment >= 0))
    if last is not None:
        yield last


def _goes_on(text: str, last: Raw, at: int, stop: int) -> bool:
    """Whether an unnumbered line belongs to the definition before it."""
    begin, end = last.parts[0]
    if _PATTERN.match(text, begin, end):
        return True
    return _PARAMETER.match(text, at, stop) is not None and _DEFINES.search(text, begin, end) is not None


# What is modal in a DIN/ISO program where a block begins: the path function, G90 or G91, the last sense of rotation.
# The words of a block mean what was written before it *on the way* that leads there, which is not always what stands above:
# a subprogram goes on with what held where it was called, a repeated section with what held at its end. So the ways are
# followed through labels, calls, repeats and jumps until nothing changes any more. Where two of them bring different
# values, the value is `MIXED`, and a block that needs it must say it itself.

PATHS = frozenset((0, 1, 2, 3, 5, 6, 7, 10, 11, 12, 13, 15, 16))
SENSES = {2: -1, 12: -1, 3: 1, 13: 1}
MIXED: Final = 99
ANY = "?"  # a label whose name is in a text parameter
MOST_ROUNDS = 50  # through the program: one for each call inside a call, and one for each jump back

_CODE = re.compile(r"(?<![A-Z])G[ \t]*(\d{1,4})(?!\d)", FLAGS)
_NAME = r'(\d{1,9}|"[^"]*"|QS[ \t]?\d{1,6})'
_LABEL = rf"L[ \t]*{_NAME}"
_SET, _CALL = re.compile(rf"G[ \t]*98[ \t]*{_LABEL}", FLAGS), re.compile(rf"{_LABEL}[ \t]*(,[ \t]*0*[1-9])?", FLAGS)
_JUMP = re.compile(rf"D[ \t]*(?:09|9|10|11|12)\b[^*]*?(?:P[ \t]*03|LBL)[ \t]*{_NAME}", FLAGS)
_END = re.compile(r"(?<![A-Z])M[ \t]*(?:0*2|30)(?!\d)", FLAGS)
_STRANGE = re.compile(r'"[^"]*"|Q[LRS]?\d+[ \t]*=.*', FLAGS)  # names, and the parameters of a definition


class Modes(NamedTuple):
    """Number of the path function (or None), whether G91 holds, the last sense of rotation; `main`: on the way from the
    beginning without a call."""

    path: int | None = None
    incremental: int = 0
    sense: int = 0
    main: bool = True

    def joined(self, other: Modes | None) -> Modes:
        """What is known where two ways meet."""
        if other is None or other == self:
            return self
        path, incremental, sense = (a if a == b else MIXED for a, b in zip(self[:3], other[:3], strict=True))
        return Modes(path, incremental or 0, sense or 0, self.main or other.main)


UNKNOWN = Modes(MIXED, MIXED, MIXED)


class _Turn(NamedTuple):
    """What a block does to the modes or the way."""

    path: int | None
    incremental: int | None
    sense: int | None
    skip: bool
    label: str = ""
    call: str = ""
    repeats: bool = False
    jump: str = ""
    ends: bool = False

    def after(self, modes: Modes) -> Modes:
        """The modes behind the block."""
        given = {name: value for name in ("path", "incremental", "sense") if (value := getattr(self, name)) is not None}
        new = modes._replace(**given)
        return new.joined(modes) if self.skip else new


def modes_before(text: str, raw: Sequence[Raw]) -> list[tuple[Modes, Modes]]:
    """The modes where each block begins, and those that the text above it says; where no way leads to a block, these."""
    turns = {k: turn for k, one in enumerate(raw) if (turn := _turn(text, one))}
    ways = _Ways(turns)
    for _ in range(MOST_ROUNDS):
        if not ways.follow():
            break
    else:
        ways.entry = dict.fromkeys(ways.labels, UNKNOWN)
        ways.exit = dict.fromkeys(ways.labels, UNKNOWN)
        ways.follow()
    found, now, above = [], Modes(), Modes()
    for k in range(len(raw)):
        now = ways.before.get(k) or now
        found.append((now, above))
        if turn := turns.get(k):
            now, above = ways.behind.get(k) or turn.after(now), turn.after(above)
    return found


class _Ways:
    """The modes that each way brings, as far as they are known."""

    def __init__(self, turns: dict[int, _Turn]) -> None:
        self.turns = turns
        self.labels = {turn.label for turn in turns.values()} - {"", "0"}
        self.entry: dict[str, Modes] = {}  # label -> what calls, repeats and jumps bring there
        self.exit: dict[str, Modes] = {}  # label -> what its subprogram leaves
        self.before: dict[int, Modes | None] = {}
        self.behind: dict[int, Modes | None] = {}

    def follow(self) -> bool:
        """Go through the program once; whether something new became known."""
        known = dict(self.entry), dict(self.exit)
        modes: Modes | None = Modes()
        opened: list[str] = []
        for k, turn in self.turns.items():
            if turn.label and turn.label != "0":
                opened.append(turn.label)
                entry = self.entry.get(turn.label)
                modes = modes.joined(entry) if modes else entry
            self.before[k] = modes
            modes = self.through(turn, modes, opened)
            self.behind[k] = modes
        return known != (self.entry, self.exit)

    def through(self, turn: _Turn, modes: Modes | None, opened: list[str]) -> Modes | None:
        """The modes behind a block; None where the way does not go on, or is not known yet."""
        if modes is None:
            if turn.label == "0":
                opened.clear()
            return None
        after = turn.after(modes)
        if turn.call:
            self.bring(self.entry, turn.call, after if turn.repeats else after._replace(main=False))
        if turn.call and not turn.repeats:
            left = self.exit.get(turn.call) if turn.call != ANY else UNKNOWN
            left = left and left._replace(main=modes.main)
            return modes.joined(left) if turn.skip else left
        if turn.jump:
            self.bring(self.entry, turn.jump, after)
        if turn.label == "0":
            for label in opened:
                self.bring(self.exit, label, modes)
            opened.clear()
            return modes if modes.main else None
        return None if turn.ends and not turn.skip else after

    def bring(self, to: dict[str, Modes], label: str, modes: Modes) -> None:
        for one in self.labels if label == ANY else (label,):
            to[one] = modes.joined(to.get(one))


def _turn(text: str, raw: Raw) -> _Turn | None:
    """What a block does to modes and way, found without reading all its words; None if nothing."""
    if not raw.parts:
        return None
    written = text[slice(*raw.parts[0])]
    if written[:1] in "%*":
        return None
    jump = _JUMP.match(written)
    if jump:
        return _Turn(None, None, None, raw.skip, jump=_name(jump[1]))
    call, label = _CALL.match(written), _SET.search(written)
    if call:
        return _Turn(None, None, None, raw.skip, call=_name(call[1]), repeats=call[2] is not None)
    plain = _STRANGE.sub(" ", written)
    codes = [int(code) for code in _CODE.findall(plain)]
    if 79 in codes:
        codes = [code for code in codes if code not in PATHS]  # G79:G01 is no path function
    path = next((code for code in reversed(codes) if code in PATHS), None)
    measure = next((code - 90 for code in reversed(codes) if code in (90, 91)), None)
    ends = _END.search(plain) is not None
    if path is None and measure is None and label is None and not ends:
        return None
    sense = SENSES.get(path) if path is not None else None
    return _Turn(path, measure, sense, raw.skip, _name(label[1]) if label else "", ends=ends)


def _name(label: str) -> str:
    if label.upper().startswith("QS"):
        return ANY
    return label if label.startswith('"') else str(int(label))


# Words of a DIN/ISO block: a letter and its value, `G01`, `X+10`, `H-Q5`, `P01 +2`, `FMAX`.
# G90 and G91 count for the words behind them, also in their own block: `G91 X+5 G90 Y-5`.

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
