"""What is modal in a DIN/ISO program where a block begins: the path function, G90 or G91, the last sense of rotation.

The words of a block mean what was written before it *on the way* that leads there, which is not always what stands above:
a subprogram goes on with what held where it was called, a repeated section with what held at its end. So the ways are
followed through labels, calls, repeats and jumps until nothing changes any more. Where two of them bring different
values, the value is `MIXED`, and a block that needs it must say it itself.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from typing import Final, NamedTuple

from mnclab.controls.tnc_620.reading.din_blocks import Raw
from mnclab.controls.tnc_620.reading.words import FLAGS

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
