"""Engraving, cycle 225 (12.6): a text on a straight line or round a circle."""

from __future__ import annotations

import math
from collections.abc import Iterator
from datetime import datetime

from mnclab.controls.tnc_620 import engraved_text
from mnclab.controls.tnc_620.clock import time_of_day
from mnclab.controls.tnc_620.cycles import addresses
from mnclab.controls.tnc_620.cycles.addresses import choice, ratio
from mnclab.controls.tnc_620.cycles.planes import SAME, AtSurface, Fault, not_zero
from mnclab.controls.tnc_620.machining.engraving import Glyph, cells, engrave, length, on_arc, on_line
from mnclab.machine.control import Setting
from mnclab.machine.coordinates import MILLS
from mnclab.machine.cycle import CycleTable, param
from mnclab.machine.machine import Machine
from mnclab.machining.steps import Go, Step
from mnclab.text.strings import TextFormula

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

    def contradictions(self) -> Iterator[Fault]:
        if self.text_layout and not self.arc_radius:
            yield "arc_radius", "must be greater than 0 for a text on an arc, got 0"
        if not self.character_height and not self.maximum_text_length:
            yield "character_height", "and Q574 are both 0: one of them says how large the text is"

    def check(self, m: Machine) -> Iterator[Fault]:
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
        long, most = length(cells(found, self.spacing_factor)) * height, self.maximum_text_length
        if most and long > most + SAME:
            yield "maximum_text_length", f"is {most:g}, the text is {long:.3f} long"

    def tokens(self, m: Machine) -> list[str]:
        now = time_of_day(m) or datetime.now()
        text = self.text if isinstance(self.text, str) else self.text.evaluate(m.variables)
        return engraved_text.tokens(text, now, int(m.settings["counter"]))

    def height(self, found: list[str]) -> float:
        """The height of a capital; ValueError for a text without width that should have a length."""
        if self.character_height:
            return self.character_height
        if not (long := length(cells(found, self.spacing_factor))):
            raise ValueError("has no character whose height Q574 could give")
        return self.maximum_text_length / long

    def glyphs(self, found: list[str], height: float) -> list[Glyph]:
        row, angle, reference = cells(found, self.spacing_factor), math.radians(self.angle), int(self.text_position)
        if self.text_layout == 0:
            return on_line(row, height, reference, angle)
        sense = 1 if self.text_layout == 1 and self.angle % 360 > 180 else -1
        return on_arc(row, height, reference, angle, self.arc_radius, sense)

    def moves(self, m: Machine) -> Iterator[Step]:
        if not self.down:
            yield self.left_out
            return
        found = self.tokens(m)
        height = self.height(found)
        if m.programmed[2] < self.above and self.down > 0:
            yield Go("to the clearance level", self.above)
        yield from engrave(
            self.glyphs(found, height), height, above=self.above, floor=self.surface + self.depth,
            plunge=self.plunge_feed, feed=self.feed,
        )  # fmt: skip
        yield from self.leave()
