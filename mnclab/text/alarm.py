"""A fault in a part program, at its place in the text.

An alarm is worded as *code, address, meaning, what was allowed, what was found*, then a hint when the mistake
is a known one. It prints like a compiler's message: place, sentence, the line, a caret under the word.
"""

from __future__ import annotations

from html import escape
from typing import Any, NamedTuple, Protocol

ALARM, WARNING = "alarm", "warning"


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
        ...

    def line_text(self, line: int) -> str:
        """The characters of one line, without its end."""
        ...


class Alarm(Exception):
    """A fault in the program, where it stands.

    ``span`` is None for a fault that is not in the text. ``source`` is the program it stands in; whoever reads or
    runs a program fills it in, so that the alarm can show the line.
    """

    def __init__(
        self,
        message: str,
        span: Span | None = None,
        severity: str = ALARM,
        hint: str = "",
        source: Source | None = None,
    ) -> None:
        super().__init__(message)
        self.message, self.span, self.severity, self.hint, self.source = message, span, severity, hint, source

    @property
    def place(self) -> str:
        """``FILE:LINE:COLUMN``, or the file alone; empty for a fault that stands in no program."""
        if self.source is None and self.span is None:
            return ""
        name = self.source.name if self.source else "program"
        return f"{name}:{self.span.line}:{self.span.column}" if self.span else name

    @property
    def headline(self) -> str:
        """The alarm in one line, as editors read it."""
        hint = f" ({self.hint})" if self.hint else ""
        place = f"{self.place}: " if self.place else ""
        return f"{place}{self.severity}: {self.message}{hint}"

    def lines(self) -> tuple[str, str]:
        """The line of the program and the carets under the faulty characters; two empty strings if there is none."""
        if self.span is None or self.source is None:
            return "", ""
        text = self.source.line_text(self.span.line)
        before = text[: self.span.column - 1]
        indent = "".join("\t" if c == "\t" else " " for c in before).ljust(self.span.column - 1)
        return text, indent + "^" * max(1, min(self.span.length, max(1, len(text) - self.span.column + 1)))

    def __str__(self) -> str:
        text, caret = self.lines()
        if not caret:
            return self.headline
        return f"{self.headline}\n    {text}\n    {caret}"

    def __repr__(self) -> str:
        return f"Alarm({self.headline!r})"

    def _render_traceback_(self) -> list[str]:
        """What IPython prints instead of a Python traceback: the fault is in the program, not in Python."""
        return str(self).split("\n")

    def _repr_html_(self) -> str:
        text, caret = self.lines()
        colour = "#b3261e" if self.severity == ALARM else "#8a5a00"
        head = f'<span style="color:{colour};font-weight:600">{escape(self.severity)}</span> '
        body = escape(f"{self.place}: {self.message}" if self.place else self.message)
        hint = f"<br><em>{escape(self.hint)}</em>" if self.hint else ""
        shown = (
            f'<pre style="margin:.2em 0 .6em 1.5em;font-family:monospace">{escape(text)}\n{escape(caret)}</pre>'
            if caret
            else ""
        )
        return f'<div role="alert">{head}{body}{hint}{shown}</div>'

    def as_dict(self) -> dict[str, Any]:
        """The alarm for programs that read JSON."""
        span = self.span
        return {
            "file": self.source.name if self.source else None,
            "line": span.line if span else None,
            "column": span.column if span else None,
            "length": span.length if span else None,
            "severity": self.severity,
            "message": self.message,
            "hint": self.hint,
        }


def by_place(alarms: list[Alarm]) -> tuple[Alarm, ...]:
    """Alarms in the order of programs and lines, each once; those without a place come last."""
    far = Span(2**31, 0, 0, 2**15)
    once = {(alarm.message, alarm.severity, alarm.span): alarm for alarm in reversed(alarms)}.values()
    return tuple(sorted(reversed(once), key=lambda alarm: ((alarm.span or far).program, *(alarm.span or far)[:2])))
