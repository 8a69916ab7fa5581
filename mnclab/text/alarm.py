"""A fault in a part program, at its place in the text.

An alarm is worded as *code, address, meaning, what was allowed, what was found*, then a hint when the mistake
is a known one. It prints like a compiler's message: place, sentence, the line, a caret under the word.

A long program makes many alarms of one kind: `Alarms` keeps the first and counts the others, and what is shown to
people is the first of them and how many there are.
"""

from __future__ import annotations

import copy
import math
import re
from array import array
from collections import Counter
from collections.abc import Iterable, Sequence
from functools import lru_cache
from html import escape
from pathlib import Path
from typing import Any, NamedTuple, Protocol

ALARM, WARNING = "alarm", "warning"
WIDTH = 120  # characters of a line that an alarm quotes
LONGEST = 600  # characters of a message or a hint: a word of the program may be as long as it likes
SHOWN = 20  # alarms of a card
PLACES = 5  # of alarms that are counted as one
KEPT, KINDS = 1000, 100  # alarms of a kind; kinds that are told apart

_PARTS = re.compile(r"'[^']*'|\"[^\"]*\"|\S+")
_SAID = re.compile(r"[a-z.,;:()]+")  # what is neither a name nor a number


class Span(NamedTuple):
    """A place in a program; line and column count from 1, as editors do."""

    line: int
    column: int
    length: int = 1
    program: int = 0


class Source(Protocol):
    """What an alarm needs of a program to show its place."""

    @property
    def name(self) -> str:
        """The file, or "program"."""

    def line_text(self, line: int) -> str:
        """The characters of one line, without its end."""


class Named(NamedTuple):
    """The source of an alarm under another name."""

    name: str
    source: Source

    def line_text(self, line: int) -> str:
        return self.source.line_text(line)


class Alarm(Exception):
    """A fault in the program, where it stands.

    `span` is None for a fault that is not in the text. `source` is the program it stands in; whoever reads or
    runs a program fills it in, so that the alarm can show the line. `count` is how many alarms it stands for, itself
    and others like it, `places` where the first of them stand.

    >>> mnc.run("G1 X5 Q3\\n", "mnc").alarms[0]
    Alarm('program:1:7: alarm: Q3 has no meaning in this block (G1 does not take Q)')
    """

    def __init__(self, message: str, span: Span | None = None, severity: str = ALARM, hint: str = "",
                 source: Source | None = None) -> None:  # fmt: skip
        message, hint = _shortened(message), _shortened(hint)
        super().__init__(message)
        self.message, self.span, self.severity, self.hint, self.source = message, span, severity, hint, source
        self.count = 1
        self.places: tuple[Span, ...] = (span,) if span else ()

    def changed(self, **values: Any) -> Alarm:
        other = copy.copy(self)
        vars(other).update(values)
        return other

    def without_folders(self) -> Alarm:
        """The same alarm for a file that is given away: its program has its name alone, without the folders here."""
        return self.changed(source=self.source and Named(Path(self.source.name).name, self.source))

    def include(self, other: Alarm) -> None:
        """Count another one with this."""
        self.count += other.count
        if len(self.places) < PLACES and other.span and other.span not in self.places:
            self.places += (other.span,)

    @property
    def others(self) -> str:
        """How many more alarms it stands for, and the first lines of those."""
        if self.count == 1:
            return ""
        here = self.span.line if self.span else None
        lines = dict.fromkeys(str(place.line) for place in self.places[1:] if place.line != here)
        more = ", …" if self.count > len(self.places) else ""
        found = f" (line{'s' if len(lines) > 1 else ''} {', '.join(lines)}{more})"
        return f"; {self.count - 1} more like it{found if lines else ' in this line'}"

    @property
    def place(self) -> str:
        """`FILE:LINE:COLUMN`, or the file alone; empty for a fault that stands in no program."""
        if self.source is None and self.span is None:
            return ""
        name = self.source.name if self.source else "program"
        return f"{name}:{self.span.line}:{self.span.column}" if self.span else name

    @property
    def headline(self) -> str:
        """The alarm in one line, as editors read it."""
        hint = f" ({self.hint})" if self.hint else ""
        place = f"{self.place}: " if self.place else ""
        return f"{place}{self.severity}: {self.message}{self.others}{hint}"

    def at(self, place: Span) -> Alarm:
        """The same alarm told at another of its places."""
        return self.changed(span=place, places=(place, *(each for each in self.places if each != place)))

    def lines(self, width: int = WIDTH) -> tuple[str, str]:
        """At most `width` characters of the line, and the carets under the faulty ones; two empty strings if there is none."""
        if self.span is None or self.source is None:
            return "", ""
        text, at = quoted(self.source.line_text(self.span.line), self.span.column - 1, width)
        indent = "".join("\t" if c == "\t" else " " for c in text[:at]).ljust(at)
        return text, indent + "^" * max(1, min(self.span.length, max(1, len(text) - at)))

    def text(self, width: int = WIDTH) -> str:
        """The alarm with at most so many characters of its line, and the caret."""
        text, caret = self.lines(width)
        return f"{self.headline}\n    {text}\n    {caret}" if caret else self.headline

    __str__ = text

    def __repr__(self) -> str:
        return f"Alarm({self.headline!r})"

    def _render_traceback_(self) -> list[str]:
        """What IPython prints instead of a Python traceback: the fault is in the program, not in Python."""
        return str(self).split("\n")

    def html(self, width: int = WIDTH) -> str:
        """The alarm as HTML, with at most so many characters of its line."""
        text, caret = self.lines(width)
        colour = "#b3261e" if self.severity == ALARM else "#8a5a00"
        near = f"color-mix(in srgb,{colour} 70%,currentColor)"  # lighter where the page is dark
        head = f'<span style="color:{colour};color:{near};font-weight:600">{escape(self.severity)}</span> '
        said = self.message + self.others
        body = escape(f"{self.place}: {said}" if self.place else said)
        hint = f"<br><em>{escape(self.hint)}</em>" if self.hint else ""
        whole = "word-break:normal;overflow-wrap:normal;overflow-x:auto"  # no word is broken, and the caret stays below its own
        style = f"margin:.2em 0 .6em 1.5em;font-family:monospace;white-space:pre;{whole}"
        shown = f'<pre style="{style}">{escape(text)}\n{escape(caret)}</pre>' if caret else ""
        return f'<div role="alert" style="{whole}">{head}{body}{hint}{shown}</div>'

    _repr_html_ = html

    def as_dict(self) -> dict[str, Any]:
        """The alarm for programs that read JSON."""
        line, column, length = self.span[:3] if self.span else (None, None, None)
        return {
            "file": self.source.name if self.source else None, "line": line, "column": column, "length": length,
            "severity": self.severity, "message": self.message, "hint": self.hint,
            "count": self.count, "lines": [place.line for place in self.places],
        }  # fmt: skip


class Refused(Alarm, ValueError):
    """What a function of numbers refuses: an Alarm to people, and a ValueError, whose text is the sentence alone, to Python."""

    def __str__(self) -> str:  # type: ignore[override]  # without a width
        return self.message


class Absent(Alarm, IndexError):
    """What was asked for by its place and is not there: an Alarm to people, and an IndexError to Python."""


class Alarms(list[Alarm]):
    """Alarms as they come. A warning that was given before counts with the first; of alarms that differ in names and
    numbers alone the first thousand are kept, and the last of these counts the others.

    `total` is how many came, `untold` where those of severity "alarm" stand that were not kept: line * 2**32 + column.
    """

    def __init__(self, alarms: Iterable[Alarm] = ()) -> None:
        super().__init__()
        self.total, self.untold = 0, array("q")
        self._first: dict[tuple[int, str, str], Alarm] = {}  # warnings, by program and text
        self._kinds: dict[str, list[Any]] = {}  # kind -> how many are kept, the last of them
        self.extend(alarms)

    def append(self, alarm: Alarm) -> None:
        """Keep an alarm, or count it with one that is kept."""
        self.total += 1
        key = alarm.span.program if alarm.span else 0, alarm.message, alarm.hint
        if alarm.severity == WARNING and key in self._first:
            self._first[key].include(alarm)
            return
        kind = alarm.severity + " ".join(filter(_SAID.fullmatch, _PARTS.findall(alarm.message)))
        if kind not in self._kinds and len(self._kinds) >= KINDS:
            kind = alarm.severity
        kept = self._kinds.setdefault(kind, [0, alarm])
        if kept[0] >= KEPT:
            kept[1].include(alarm)
            if alarm.severity == ALARM and alarm.span:
                self.untold.append(alarm.span.line << 32 | alarm.span.column)
            return
        kept[:] = kept[0] + 1, alarm
        if alarm.severity == WARNING:
            self._first[key] = alarm
        super().append(alarm)

    def extend(self, alarms: Iterable[Alarm]) -> None:
        for alarm in alarms:
            self.append(alarm)

    def copy(self) -> Alarms:
        """The same alarms, apart from those to come."""
        own, twin = {id(alarm): alarm.changed() for alarm in self}, Alarms()
        list.extend(twin, own.values())
        twin.total, twin.untold = self.total, self.untold[:]
        twin._first = {key: own[id(alarm)] for key, alarm in self._first.items()}
        twin._kinds = {kind: [count, own[id(alarm)]] for kind, (count, alarm) in self._kinds.items()}
        return twin

    def warned(self, message: str, program: int = 0) -> Alarm | None:
        """The warning of these words that was given before."""
        return self._first.get((program, message, ""))


def first_of(alarms: Sequence[Alarm]) -> tuple[list[Alarm], str]:
    """Those that a card shows, alarms before warnings but in their order, and a sentence about the others."""
    if len(alarms) <= SHOWN:
        return list(alarms), ""
    chosen = sorted(sorted(range(len(alarms)), key=lambda k: alarms[k].severity == WARNING)[:SHOWN])
    shown = [alarms[k] for k in chosen]
    every = amounts(alarms)
    rest = [several(n, f"more {name}") for name, n in (every - amounts(shown)).items()]
    return shown, f"… and {' and '.join(rest)}, {every.total()} in all"


def amounts(alarms: Iterable[Alarm]) -> Counter[str]:
    """How many there are of each severity, alarms first."""
    found = Counter({ALARM: 0, WARNING: 0})
    for alarm in alarms:
        found[alarm.severity] += alarm.count
    return found


def several(count: int, name: str) -> str:
    """A number of things: 1 block, 2 blocks."""
    return f"{count} {name}{'s' if count != 1 else ''}"


def card_html(alarms: Sequence[Alarm], width: int = WIDTH) -> str:
    """The first alarms as HTML, with so many characters of their lines, and how many more there are."""
    shown, more = first_of(alarms)
    return "".join(alarm.html(width) for alarm in shown) + (f"<p>{more}</p>" if more else "")


def quoted(text: str, at: int = 0, width: int = WIDTH) -> tuple[str, int]:
    """A line as people are shown it, at most `width` characters around one, and where that stands in it."""
    if len(text) <= width:
        return text, at
    begin = max(0, min(at, len(text)) - width // 3)
    before, after = "… " if begin else "", " …" if begin + width < len(text) else ""
    return f"{before}{text[begin : begin + width]}{after}", at - begin + len(before)


def _shortened(text: str) -> str:
    """A sentence without the middle of what makes it too long."""
    return text if len(text) <= LONGEST else f"{text[: LONGEST * 2 // 3]} … {text[-LONGEST // 3 :]}"


def by_place(alarms: list[Alarm]) -> tuple[Alarm, ...]:
    """Alarms in the order of programs and lines, each once; those without a place come last."""
    far = Span(2**31, 0, 0, 2**15)
    once = {(alarm.message, alarm.severity, alarm.span): alarm for alarm in reversed(alarms)}.values()
    return tuple(sorted(reversed(once), key=lambda alarm: ((alarm.span or far).program, *(alarm.span or far)[:2])))


# The known words nearest to one that is not known, for hints: what the programmer probably meant.
# Nearness is counted in slips of the hand: a character left out, added or exchanged is one slip, two neighbours in the
# wrong order are a smaller one, and characters that look alike in print half of one. (A count of common characters, as of
# difflib, calls G4 and G1 near G144.)

#: Cyrillic letters that look like Latin ones.
LATIN = dict(zip("АВСЕНКМОРТХУІавсенкмортхуі", "ABCEHKMOPTXYIabcehkmoptxyi", strict=True))
#: Letters that are taken for digits.
DIGITS = dict(zip("OoОоlI|ІіЗзб", "000011111336", strict=True))
SWAPPED, ALIKE = 0.75, 0.5  # slips
LONGEST_WORD = 40  # characters: a longer word is no slip of a known one, and would take long to compare


def nearest(word: str, known: Iterable[str], most: int = 3, slips: float | None = None) -> list[str]:
    """At most `most` known words within some slips of a word: one, and one more for every five characters beyond four.

    The nearest come first; of equally near ones those that share the longest beginning. Nothing is near a word of more
    than `LONGEST_WORD` characters.
    """
    return list(_nearest(word, tuple(known), most, slips)) if len(word) <= LONGEST_WORD else []


@lru_cache(4096)  # a wrong word often stands in many lines
def _nearest(word: str, known: tuple[str, ...], most: int, slips: float | None) -> tuple[str, ...]:
    allowed = slips if slips is not None else 1 + max(len(word) - 1, 0) // 5
    found = []
    for place, candidate in enumerate(known):
        if abs(len(word) - len(candidate)) > allowed:  # as many characters are too many or missing
            continue
        distance = slips_between(word, candidate, allowed)
        if distance <= allowed:
            shared = next((k for k, (a, b) in enumerate(zip(word, candidate, strict=False)) if a != b), len(word))
            found.append((distance, -shared, place, candidate))
    return tuple(candidate for *_, candidate in sorted(found)[:most])


def hint(word: str, known: Iterable[str], most: int = 3, slips: float | None = None) -> str:
    """The nearest known words as the hint of an alarm; empty if there are none."""
    near = nearest(word, known, most, slips)
    return f"near: {', '.join(near)}" if near else ""


def slips_between(one: str, other: str, most: float = math.inf) -> float:
    """How many slips make one word of the other, whatever the case of their letters.

    The least cost of making the first i characters of one the first j of the other, row by row (Damerau, Levenshtein).
    More than `most` are not counted to the end.
    """
    rows = [[float(j) for j in range(len(other) + 1)]]
    for i, a in enumerate(one, 1):
        row = [float(i)]
        for j, b in enumerate(other, 1):
            cost = min(rows[-1][j] + 1, row[-1] + 1, rows[-1][j - 1] + _exchanged(a, b))
            if i > 1 and j > 1 and a != b and _exchanged(a, other[j - 2]) == _exchanged(one[i - 2], b) == 0:
                cost = min(cost, rows[-2][j - 2] + SWAPPED)
            row.append(cost)
        if min(row) > most and min(rows[-1]) > most:  # later rows build on these two
            return math.inf
        rows.append(row)
    return rows[-1][-1]


def _exchanged(a: str, b: str) -> float:
    """The slips of writing one character for another."""
    if a.upper() == b.upper():
        return 0.0
    return ALIKE if LATIN.get(a, a) == LATIN.get(b, b) or DIGITS.get(a, a) == DIGITS.get(b, b) else 1.0
