"""Which call of Python a cursor stands in, and in which of its arguments, while the source is being typed.

Source that is half written cannot be parsed; brackets and texts are followed to the cursor, and no further.
"""

from __future__ import annotations

import re
from typing import NamedTuple

_NAME = re.compile(r"\s*+([\w.]*+)")  # of a function, read from its end
_KEYWORD = re.compile(r"[(,]\s*(\w+)\s*$")


class Call(NamedTuple):
    """The function as written (`mnc.run`), the number or the keyword of the argument; the text that the cursor is in and
    where in it (None outside a text), the texts given before, and the source after."""

    function: str
    position: int
    keyword: str
    text: str | None
    at: int
    texts: tuple[str, ...]
    after: str


class _Frame:
    """A bracket that is open."""

    def __init__(self, function: str) -> None:
        self.function, self.position, self.keyword = function, 0, ""
        self.texts: list[str] = []

    def call(self, text: str | None, at: int, after: str) -> Call:
        return Call(self.function, self.position, self.keyword, text, at, tuple(self.texts), after)


def call_at(source: str, at: int) -> Call | None:
    """The innermost call around a cursor; None outside of calls. A cursor beyond the source stands at its end."""
    frames: list[_Frame] = []
    k, at = 0, min(at, len(source))
    while k < at:
        sign = source[k]
        if sign in "\"'":
            quote = sign * 3 if source.startswith(sign * 3, k) else sign
            begin = k + len(quote)
            end = _end(source, begin, quote)
            if end >= at >= begin and frames:
                return frames[-1].call(source[begin:end], at - begin, source[end + len(quote) :])
            if frames:
                frames[-1].texts.append(source[begin:end])
            k = max(end + len(quote), begin)
            continue
        if sign == "#":
            k = source.find("\n", k) if "\n" in source[k:] else at
        elif sign in "([{":
            found = _NAME.match(source[:k][::-1]) if sign == "(" else None
            frames.append(_Frame(found[1][::-1] if found else ""))
        elif sign in ")]}" and frames:
            frames.pop()
        elif sign == "," and frames:
            frames[-1].position, frames[-1].keyword = frames[-1].position + 1, ""
        elif sign == "=" and frames and (named := _KEYWORD.search(source[:k])):
            frames[-1].keyword = named[1]
        k += 1
    return frames[-1].call(None, 0, source[at:]) if frames and frames[-1].function else None


def _end(source: str, begin: int, quote: str) -> int:
    """Where a text ends: at its quote, a short one with its line at the latest."""
    stop = len(source) if len(quote) == 3 else source.find("\n", begin) % (len(source) + 1)
    k = begin
    while k < stop and not source.startswith(quote, k):
        k += 2 if source[k] == "\\" else 1
    return min(k, stop)
