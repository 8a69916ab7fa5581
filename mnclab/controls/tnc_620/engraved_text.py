"""The text of cycle 225: which characters it takes, and what stands behind % and the backslash (12.6).

`%ae` is ä, `%time08` the date, `%count2` the counter with two digits; `\\n` begins a new line. Both signs are written
twice where they are meant. The mark CE is engraved as the letters C and E.
"""

from __future__ import annotations

import re
from datetime import datetime

from mnclab.controls.tnc_620.machining.engraving import DOWN, NEW_LINE, TAB

LONGEST = 255
ALLOWED = frozenset("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789 !#$&'()*+,-./:;<=>?@[]_`ß")
NAMED = {
    "%": "%", "ae": "ä", "oe": "ö", "ue": "ü", "AE": "Ä", "OE": "Ö", "UE": "Ü", "ss": "ß", "D": "ø", "at": "@", "CE": "CE",
}  # fmt: skip
FORMATTING = {"n": NEW_LINE, "t": TAB, "v": DOWN, "\\": "\\"}
#: Of %time00 to %time15; as SYSSTR ID321 numbers them.
TIMES = (
    "{t:%d.%m.%Y %H:%M:%S}", "{t.day}.{t:%m.%Y} {t.hour}:{t:%M:%S}", "{t.day}.{t:%m.%Y} {t.hour}:{t:%M}",
    "{t.day}.{t:%m.%y} {t.hour}:{t:%M}", "{t:%Y-%m-%d %H:%M:%S}", "{t:%Y-%m-%d %H:%M}", "{t:%Y-%m-%d} {t.hour}:{t:%M}",
    "{t:%y-%m-%d} {t.hour}:{t:%M}", "{t:%d.%m.%Y}", "{t.day}.{t:%m.%Y}", "{t.day}.{t:%m.%y}", "{t:%Y-%m-%d}",
    "{t:%y-%m-%d}", "{t:%H:%M:%S}", "{t.hour}:{t:%M:%S}", "{t.hour}:{t:%M}",
)  # fmt: skip

_TIME = re.compile(r"time(\d\d)", re.ASCII)
_COUNT = re.compile(r"count([1-9])", re.ASCII)
_NAME = re.compile("|".join(sorted(map(re.escape, NAMED), key=len, reverse=True)))


class Fault(ValueError):
    """What is wrong in a text."""


def tokens(text: str, now: datetime, counter: int) -> list[str]:
    """The characters to engrave, and the signs of formatting; a Fault for what cannot be engraved."""
    if len(text) > LONGEST:
        raise Fault(f"must have at most {LONGEST} characters, got {len(text)}")
    found: list[str] = []
    at = 0
    while at < len(text):
        sign, at = text[at], at + 1
        if sign == "%":
            piece, at = _named(text, at, now, counter)
            found += piece
        elif sign == "\\":
            sign, at = text[at : at + 1], at + 1
            if sign not in FORMATTING:
                raise Fault(f"has an incomplete \\{sign}: \\n, \\t, \\v and \\\\ are allowed")
            found.append(FORMATTING[sign])
        elif sign in ALLOWED:
            found.append(sign)
        else:
            instead = next((f": write %{name}" for name, character in NAMED.items() if character == sign), "")
            raise Fault(f"has the character {sign!r}, which cannot be engraved{instead}")
    return found


def _named(text: str, at: int, now: datetime, counter: int) -> tuple[str, int]:
    if found := _TIME.match(text, at):
        if (number := int(found.group(1))) >= len(TIMES):
            raise Fault(f"has %time{number}: %time00 to %time15 are allowed")
        return TIMES[number].format(t=now), found.end()
    if found := _COUNT.match(text, at):
        digits = int(found.group(1))
        if counter >= 10**digits:
            raise Fault(f"has %count{digits}, and the counter stands at {counter}")
        return f"{counter:0{digits}d}", found.end()
    if found := _NAME.match(text, at):
        return NAMED[found.group()], found.end()
    raise Fault(f"has %{text[at : at + 5]}, which means nothing: write %% for the sign itself")
