"""A program of the NC-31 as a lathe of today would write it: a command in a line, millimetres, decimal points.

`X10500~` is `G0 X105.0`, an increment becomes U or W, an exact stop G9. What ISO has no word for (the zero mark, the
Stop key, repetition) stands in brackets. Cycles keep their code, for ISO knows none of them; their integers become
millimetres, P1, P2, P3 are counted, and marks are told by what they mean.
"""

from __future__ import annotations

from collections.abc import Iterator

from mnclab.controls.nc_31 import functions
from mnclab.controls.nc_31.functions import CONDITIONAL, notes_of
from mnclab.machine.control import Function
from mnclab.machine.cycle import Cycle, CycleTable
from mnclab.text.alarm import several
from mnclab.text.dialect import Notation, NotationRow
from mnclab.text.program import GROUP_MARK, INCREMENTAL, RAPID_MARK, Program, Word

HEAD = "G21 G90 G95 (mm, X on the diameter, feed per revolution)"
SCALES = {"0.0001": functions.CYCLE_FEED, "0.01": functions.Z}
MOTION, INCREMENTS = "XZ", {"X": "U", "Z": "W"}
SPINDLE = (3.0, 4.0, 5.0)


def modern(program: Program, cycles: CycleTable) -> Notation:
    """The program beside itself in modern notation; whatever stands in it, faults too, is shown as far as it was read."""
    rows, told = [NotationRow(0, "", HEAD)], False
    commands = {}
    for block in program:
        commands[block.span.line] = sentence(block.words, cycles, told), {word.span.line for word in block.words}
        told = told or any(word.address == "M" and word.value in SPINDLE for word in block.words)
    last = 0  # line of the last frame of the command being told
    for line in range(1, len(program.line_starts) + 1):
        text = program.line_text(line)
        said, count = "", 0 if line <= last else 1  # remarks stand beside already
        if line in commands:
            said, lines = commands[line]
            last = max(lines, default=line)
            count = last - line + 1
        if text.strip() or said:
            rows.append(NotationRow(line, text.lstrip("\ufeff").rstrip(), said, count))
    return Notation(tuple(rows), program.name, ("NC-31", "modern notation"))


def sentence(words: tuple[Word, ...], cycles: CycleTable, told: bool) -> str:
    """One command as ISO words. `told`: an M has said how the spindle turns, so that S says only how fast."""
    if not words:
        return "(not understood)"
    head, rest = words[0], words[1:]
    code = f"G{_number(head)}" if head.address == "G" else ""
    if code in cycles:
        return " ".join(_cycle(cycles[code], head, rest))
    if code in CONDITIONAL:
        return " ".join(_conditional(head, rest))
    if code == "G25":
        return _repetition(rest)
    if code == "G32":
        said = ["G32", *map(_end, rest)]
        return " ".join([*said, "(start at the zero mark of the spindle)"] if head.flag & INCREMENTAL else said)
    if code:
        return " ".join([code, *map(_plain, rest), "(no function of this control)"])
    if head.address in MOTION:
        rapid = any(word.flag & RAPID_MARK for word in words)
        return " ".join([f"G{0 if rapid else 1}", *map(_end, words)])
    if head.address == "S" and not told:
        return f"{_plain(head)} M3"
    return " ".join(_millimetres("F", _amount(w), functions.FREE_FEED) if w.address == "F" else _plain(w)
                    for w in words)  # fmt: skip


def told(what: Function, word: Word, before: int) -> str:
    """Which frames a G25 repeats, or how often."""
    if what.code != "G25" or word.address != "P" or not isinstance(word.value, float):
        return ""
    first, last = divmod(int(word.value), 1000)
    return several(int(word.value), "time") if before else f"frames {first} to {last}"


def marks(what: Function | type[Cycle], word: Word, head: bool) -> Iterator[tuple[str, str]]:
    """The marks on a word of a function or cycle, and what each does in its command."""
    own = {} if isinstance(what, Function) or not head else {p.mark: p.meaning for p in what.parameters() if p.mark}
    code = what.code if head else ""
    if word.incremental:
        usual = f"{word.address} is an increment from the start of the command"
        if code in CONDITIONAL:
            usual = "separate in single-block mode"
        if code == "G32":
            usual = "start at the zero mark of the spindle"
        yield "@", own.get(INCREMENTAL, usual)
    if word.flag & RAPID_MARK:
        yield "~", own.get(RAPID_MARK, "the move is at rapid")
    if word.flag & GROUP_MARK:
        yield "*", "the next frame belongs to this command"


def _cycle(cycle: type[Cycle], head: Word, rest: tuple[Word, ...]) -> Iterator[str]:
    """A cycle: its code, its words by their declarations, its marks."""
    yield cycle.code
    declared = [parameter for parameter in cycle.parameters() if not parameter.mark]
    numbered = sum(parameter.address == "P" for parameter in declared) > 1
    for position, word in enumerate(rest):
        which = sum(other.address == word.address for other in rest[:position])
        alike = [parameter for parameter in declared if parameter.address == word.address]
        if word.address in MOTION or which >= len(alike):
            yield _end(word)
            continue
        scale = SCALES[alike[which].unit.split()[0]]
        yield _millimetres(f"P{which + 1}=" if numbered and word.address == "P" else word.address, _amount(word), scale)
    yield from (f"({p.meaning})" for p in cycle.parameters() if head.flag & p.mark)


def _conditional(head: Word, rest: tuple[Word, ...]) -> Iterator[str]:
    """A conditional move: G9 for the exact stop, the other conditions in brackets."""
    bits = int(_number(head)) - 60
    if any(word.address in MOTION for word in rest):
        yield "G0" if head.flag & RAPID_MARK else "G1"
    if bits & 1:
        yield "G9"
    yield from map(_end, rest)
    if notes := notes_of(head, bits):
        yield f"({', '.join(notes)})"


def _repetition(rest: tuple[Word, ...]) -> str:
    """Which frames, and how often."""
    given = [int(_amount(word)) for word in rest if word.address == "P"]
    if not given:
        return "(repeat)"
    first, last = divmod(given[0], 1000)
    return f"(repeat N{first} to N{last}{f' {given[1]} times' if len(given) > 1 else ''})"


def _end(word: Word) -> str:
    """A word in millimetres: U and W for increments; F of a thread is its pitch."""
    address = INCREMENTS.get(word.address, word.address) if word.incremental else word.address
    if word.address in MOTION:
        return _millimetres(address, _amount(word), functions.Z)
    return _millimetres("F", _amount(word), functions.CYCLE_FEED) if address == "F" else _plain(word)


def _millimetres(address: str, value: float, scale: float) -> str:
    """A number with its decimal point: `X105.0`, `F0.15`."""
    text = f"{value / scale:.4f}".rstrip("0")
    return f"{address}{text}0" if text.endswith(".") else f"{address}{text}"


def _amount(word: Word) -> float:
    assert isinstance(word.value, float)  # this reader makes nothing else
    return word.value


def _number(word: Word) -> str:
    return f"{_amount(word):.0f}"


def _plain(word: Word) -> str:
    return f"{word.address}{_number(word)}"
