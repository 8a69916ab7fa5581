"""How wide texts are in print, and how they are folded and cut to a width. Widths in points."""

from __future__ import annotations

from collections.abc import Iterator
from functools import cache

from matplotlib.font_manager import FontProperties, findfont, get_font
from matplotlib.ft2font import FT2Font, LoadFlags

SANS, MONO = "DejaVu Sans", "DejaVu Sans Mono"
EM = 1000  # points at which glyphs are measured


@cache
def _font(family: str, bold: bool) -> FT2Font:
    font: FT2Font = get_font(findfont(FontProperties(family=family, weight="bold" if bold else "normal")))
    return font


@cache
def _advance(letter: str, family: str, bold: bool) -> float:
    """How far one letter goes on, in ems."""
    font = _font(family, bold)
    font.set_size(EM, 72)
    return float(font.load_char(ord(letter), flags=LoadFlags.NO_HINTING).linearHoriAdvance) / 65536 / EM


def width(text: str, size: float, bold: bool = False, family: str = SANS) -> float:
    """How wide a line is."""
    return size * sum(_advance(letter, family, bold) for letter in text)


def fitted(text: str, room: float, size: float, bold: bool = False, family: str = SANS) -> str:
    """A text, cut off with an ellipsis where it is too wide."""
    if width(text, size, bold, family) <= room:
        return text
    kept, used = [], width("…", size, bold, family)
    for letter in text:
        used += width(letter, size, bold, family)
        if used > room:
            break
        kept.append(letter)
    return "".join(kept).rstrip() + "…"


def folded(text: str, room: float, size: float, bold: bool = False) -> list[str]:
    """A text as lines of at most `room`, folded between words, and within a word that is wider than a line."""
    return [line for part in text.split("\n") for line in (*_folded(part, room, size, bold),)] or [""]


def _folded(text: str, room: float, size: float, bold: bool) -> Iterator[str]:
    line, used, space = "", 0.0, width(" ", size, bold)
    for word in text.split(" "):
        more = width(word, size, bold)
        if line and used + space + more > room:
            yield line
            line, used = "", 0.0
        while more > room and len(word) > 1:
            count = len(fitted(word, room, size, bold)) - 1 or 1
            yield (line + " " if line else "") + word[:count]
            line, used, word = "", 0.0, word[count:]
            more = width(word, size, bold)
        line, used = (f"{line} {word}", used + space + more) if line else (word, more)
    yield line
