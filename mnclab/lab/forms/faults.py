"""Which field an alarm speaks of: by the word that it points at, else by the address and meaning that it quotes."""

from __future__ import annotations

import re
from collections.abc import Sequence

from mnclab.machine.cycle import Parameter
from mnclab.text.alarm import Alarm

WORD = re.compile(r"[^\s~;]+")


def field_of(alarm: Alarm, parameters: Sequence[Parameter], code: str = "") -> str:
    """The name of the parameter that an alarm is about, empty where it is about none."""
    quoted = [p for p in parameters if f"{p.address} ({p.meaning})" in alarm.message]
    if quoted:
        return min(quoted, key=lambda p: alarm.message.index(f"{p.address} ({p.meaning})")).name
    word = pointed_at(alarm)
    for p in sorted(parameters, key=lambda p: -len(p.address)):
        if any(re.match(rf"{re.escape(each)}(?![A-Za-z])", word) for each in (p.address, *p.aliases)):
            return p.name
    named = [p for p in parameters if re.search(rf"\b{re.escape(code)} {re.escape(p.address)}\b", alarm.message)]
    return named[0].name if named else ""


def pointed_at(alarm: Alarm) -> str:
    """The word of the program that an alarm points at, or into."""
    if alarm.span is None or alarm.source is None or alarm.span.program:
        return ""
    words, at = WORD.finditer(alarm.source.line_text(alarm.span.line)), alarm.span.column - 1
    return next((word[0] for word in words if word.start() <= at < word.end()), "")


def at_field(alarm: Alarm, p: Parameter | None = None) -> str:
    """The sentence of an alarm where its field stands above it: what must be, not whose."""
    head, quoted, rest = alarm.message.partition(f"{p.address} ({p.meaning}) " if p else "\n")
    said = rest if quoted and len(head.split()) <= 3 else alarm.message
    return f"{said} ({alarm.hint})" if alarm.hint else said
