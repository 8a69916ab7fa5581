"""Engraving a text, cycle 225 (12.6): which characters it takes, and what stands behind % and the backslash.

`%ae` is ä, `%time08` the date, `%count2` the counter with two digits; `\\n` begins a new line. Both signs are written
twice where they are meant. The mark CE is engraved as the letters C and E.
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterator
from datetime import datetime

from mnclab.controls.tnc_620.cycles import addresses
from mnclab.controls.tnc_620.cycles.addresses import choice, ratio
from mnclab.controls.tnc_620.cycles.planes import SAME, AtSurface, ParameterFault, not_zero
from mnclab.controls.tnc_620.machining import engraving as letters
from mnclab.controls.tnc_620.state import time_of_day
from mnclab.machine.control import Setting
from mnclab.machine.coordinates import MILLS
from mnclab.machine.cycle import CycleTable, param
from mnclab.machine.machine import Machine
from mnclab.machining.steps import Go, Step
from mnclab.text.strings import TextFormula

LONGEST = 255
ALLOWED = frozenset("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789 !#$&'()*+,-./:;<=>?@[]_`ß")
NAMED = {
    "%": "%", "ae": "ä", "oe": "ö", "ue": "ü", "AE": "Ä", "OE": "Ö", "UE": "Ü", "ss": "ß", "D": "ø", "at": "@", "CE": "CE",
}  # fmt: skip
FORMATTING = {"n": letters.NEW_LINE, "t": letters.TAB, "v": letters.DOWN, "\\": "\\"}
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


class TextFault(ValueError):
    """What is wrong in a text."""


def tokens(text: str, now: datetime, counter: int) -> list[str]:
    """The characters to engrave, and the signs of formatting; a TextFault for what cannot be engraved."""
    if len(text) > LONGEST:
        raise TextFault(f"must have at most {LONGEST} characters, got {len(text)}")
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
                raise TextFault(f"has an incomplete \\{sign}: \\n, \\t, \\v and \\\\ are allowed")
            found.append(FORMATTING[sign])
        elif sign in ALLOWED:
            found.append(sign)
        else:
            instead = next((f": write %{name}" for name, character in NAMED.items() if character == sign), "")
            raise TextFault(f"has the character {sign!r}, which cannot be engraved{instead}")
    return found


def _named(text: str, at: int, now: datetime, counter: int) -> tuple[str, int]:
    if found := _TIME.match(text, at):
        if (number := int(found.group(1))) >= len(TIMES):
            raise TextFault(f"has %time{number}: %time00 to %time15 are allowed")
        return TIMES[number].format(t=now), found.end()
    if found := _COUNT.match(text, at):
        digits = int(found.group(1))
        if counter >= 10**digits:
            raise TextFault(f"has %count{digits}, and the counter stands at {counter}")
        return f"{counter:0{digits}d}", found.end()
    if found := _NAME.match(text, at):
        return NAMED[found.group()], found.end()
    raise TextFault(f"has %{text[at : at + 5]}, which means nothing: write %% for the sign itself")


# Engraving, cycle 225 (12.6): a text on a straight line or round a circle.

CYCLES = CycleTable()
SETTINGS = (
    Setting(
        "clock", 0.0, "the time, from 1970 in UTC; 0: for %time that of the computer, for FN 16, FN 18 and SYSSTR none", "12.6",
        unit="s", at_least=0,
    ),
    Setting("counter", 0, "what %count engraves", "12.6", at_least=0),
)

FONTS: dict[float, str] = {0: "DejaVuSans"}
LAYOUTS: dict[float, str] = {0: "on a straight line", 1: "on an arc, legible", 2: "on an arc, all the way round"}
REFERENCES: dict[float, str] = {
    0: "centre of the circle, or bottom left", 1: "bottom left", 2: "bottom centre", 3: "bottom right", 4: "top right",
    5: "top centre", 6: "top left",
}  # fmt: skip


@CYCLES("CYCL DEF 225", "Engraving", source="12.6")
class Engraving(AtSurface):
    """Engraves a text, stroke by stroke; the tool stands at its reference point at the call.

    The letters are single strokes with the widths of DejaVu Sans. Behind % stand umlauts, time and counter; \\n is a new line.
    """

    does = MILLS
    text: str | TextFormula = param(("Q500", "QS500"), "text", "text", modal=True, type="text")
    character_height: float = addresses.length("Q513", "character height", note="0: as the length Q574 asks", example=10)
    spacing_factor: float = ratio(
        "Q514", "spacing factor", at_least=0, at_most=9.9999, note="0: as the letters have it", example=0
    )
    font: float = choice("Q515", "font", FONTS, default=0, note="its widths; the strokes are our own")
    text_layout: float = choice("Q516", "text layout", LAYOUTS, example=0)
    angle: float = addresses.rotation("Q374", note="on an arc that of the reference point", example=0)
    arc_radius: float = addresses.length("Q517", "radius of the arc", example=50)
    feed: float = addresses.milling_feed(example=750)
    depth: float = addresses.depth(example=-0.5)
    plunge_feed: float = addresses.plunge_feed()
    clearance: float = addresses.clearance(predef=True)
    surface: float = addresses.surface()
    second_clearance: float = addresses.second_clearance(predef=True, example=50)
    text_position: float = choice("Q367", "text position", REFERENCES, default=0, example=1)
    maximum_text_length: float = addresses.length("Q574", "greatest text length", default=0, note="0: no limit")

    def contradictions(self) -> Iterator[ParameterFault]:
        if self.text_layout and not self.arc_radius:
            yield "arc_radius", "must be greater than 0 for a text on an arc, got 0"
        if not self.character_height and not self.maximum_text_length:
            yield "character_height", "and Q574 are both 0: one of them says how large the text is"

    def check(self, m: Machine) -> Iterator[ParameterFault]:
        if not isinstance(self.text, str | TextFormula):
            yield "text", "must be a text in quotes or a QS parameter"
            return
        yield from not_zero(self, "feed", "plunge_feed")
        try:
            found = self.tokens(m)
            height = self.height(found)
            self.glyphs(found, height)
        except ValueError as error:
            yield "text", str(error)
            return
        long, most = letters.length(letters.cells(found, self.spacing_factor)) * height, self.maximum_text_length
        if most and long > most + SAME:
            yield "maximum_text_length", f"is {most:g}, the text is {long:.3f} long"

    def tokens(self, m: Machine) -> list[str]:
        now = time_of_day(m) or datetime.now()
        text = self.text if isinstance(self.text, str) else self.text.evaluate(m.variables)
        return tokens(text, now, int(m.settings["counter"]))

    def height(self, found: list[str]) -> float:
        """The height of a capital; ValueError for a text without width that should have a length."""
        if self.character_height:
            return self.character_height
        if not (long := letters.length(letters.cells(found, self.spacing_factor))):
            raise ValueError("has no character whose height Q574 could give")
        return self.maximum_text_length / long

    def glyphs(self, found: list[str], height: float) -> list[letters.Glyph]:
        row, angle, reference = letters.cells(found, self.spacing_factor), math.radians(self.angle), int(self.text_position)
        if self.text_layout == 0:
            return letters.on_line(row, height, reference, angle)
        sense = 1 if self.text_layout == 1 and self.angle % 360 > 180 else -1
        return letters.on_arc(row, height, reference, angle, self.arc_radius, sense)

    def steps(self, m: Machine) -> Iterator[Step]:
        found = self.tokens(m)
        height = self.height(found)
        if m.programmed[2] < self.above and self.down > 0:
            yield Go("to the clearance level", self.above)
        yield from letters.engrave(
            self.glyphs(found, height), height, above=self.above, floor=self.surface + self.depth,
            plunge=self.plunge_feed, feed=self.feed,
        )  # fmt: skip
        yield from self.leave()
