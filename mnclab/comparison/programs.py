"""The path of a clearing as a program of plain blocks: lines, arcs, feeds and rapids, with a tool call and the spindle.

Three controls are written for, by their words alone. Positions and centres are rounded from the origin, so that rounding does
not add up, to three to nine decimals: the controls take any number of them, and arcs with a radius above 1e-9 mm. An end and a
centre are half a unit of the last decimal off along each axis at most, the radii at both ends of an arc agree within three
units: 0.003 mm at the coarsest, where the controls allow 0.01.

What is smaller than the last decimal has no block: a row without a way; and an arc that bends by less is a line. So is one
whose ends are as near as `FULL` (0.001 mm), which all controls take for a whole turn. A helix has no word in the manual of the
MNC: there it is chords that lie inside it, `CHORD` mm away at most.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator
from typing import NamedTuple

from mnclab.geometry.arcs import FULL
from mnclab.path.listing import figure
from mnclab.path.toolpath import Kind, Toolpath
from mnclab.text.given import check_number, choice, whole

CHORD = 0.001
FEEDS = 3  # decimals of a feed, mm/min, and of a speed, rev/min
HEIGHT = 50  # mm above the surface, where the tool comes from and goes to
TNC, MNC = "tnc-620", "mnc"
#: Of every control the lines before the path and those behind it.
FRAMES = {
    "g43": (
        "%\nG21 G17 G90 G94 G40 G49 G80 G54\nT{tool} M6\nS{spindle} M3\nG43 H{tool} G0 Z{height}",
        "G0 Z{height}\nM5\nM30\n%",
    ),
    MNC: ("G17 G90 G40 G54\nT{tool}\nS{spindle} M3\nG0 Z{height}", "G0 Z{height}\nM5"),
    TNC: (
        "BEGIN PGM CLEARING MM\nTOOL CALL {tool} Z S{spindle}\nL Z+{height} R0 FMAX M3",
        "L Z+{height} R0 FMAX M30\nEND PGM CLEARING MM",
    ),
}

Point = tuple[float, ...]


class Block(NamedTuple):
    """One way as it is written: points in mm and rounded, `sweep` in rad, 0 of a line; `feed` is the word, where it changes."""

    start: Point
    end: Point
    centre: Point
    sweep: float
    rapid: bool
    feed: str = ""

    @property
    def targets(self) -> list[tuple[str, float]]:
        """The axes that are written: both of the plane of an arc, and of a line those that move."""
        pairs = zip("XYZ", self.start, self.end, strict=True)
        return [(axis, end) for axis, start, end in pairs if start != end or (self.sweep and axis != "Z")]


def program(path: Toolpath, control: str, tool: int, spindle: float, decimals: int) -> str:
    """The text of a program for the control "g43", "mnc" or "tnc-620" that runs along a path in the plane XY.

    The tool comes from and goes back to `HEIGHT` mm above the datum. `spindle` in rev/min is for a path that has none of its own.
    """
    control = choice(control, "the control", tuple(FRAMES))
    tool, decimals = whole(tool, "the number of the tool"), whole(decimals, "the number of decimals")
    check_number(tool, "the number of the tool", at_least=1, at_most=9999)
    check_number(decimals, "the number of decimals", at_least=3, at_most=9)
    check_number(spindle, "the spindle speed (rev/min)", at_least=0.001, at_most=1e6)
    turning = abs(float(path.spindle[0])) if len(path) else 0.0
    values = {"tool": tool, "spindle": figure(turning or float(spindle), FEEDS), "height": HEIGHT}
    head, foot = (lines.format(**values).split("\n") for lines in FRAMES[control])
    ways = _blocks(path, decimals, 10.0**-decimals, control != MNC)
    written = [*head, *(_klartext if control == TNC else _words)(ways, decimals), *foot]
    if control == TNC:
        written = [f"{number} {line}" for number, line in enumerate(written)]
    return "\n".join(written) + "\n"


def _blocks(path: Toolpath, decimals: int, unit: float, helices: bool) -> Iterator[Block]:
    """The ways of a path, rounded, those without a length left out; helices as chords where there are none."""
    modal = ""
    at: Point = (math.nan, math.nan, HEIGHT)
    if len(path):
        x, y, z = _rounded(path.start[0].tolist(), decimals)
        yield Block(at, (x, y, HEIGHT), (), 0.0, True)
        yield Block((x, y, HEIGHT), at := (x, y, z), (), 0.0, True)
    columns = (path.kind, path.start, path.end, path.centre, path.sweep, path.feed)
    for row, (kind, start, end, centre, sweep, feed) in enumerate(zip(*(column.tolist() for column in columns), strict=True)):
        ends = [end]
        if kind != Kind.ARC or _as_a_line(start[:2], end[:2], centre[:2], abs(sweep), unit):
            sweep = 0.0
        elif start[2] != end[2] and not helices:
            ends, sweep = path[row : row + 1].points(CHORD)[0].tolist()[1:], 0.0
        for end in ends:
            to = _rounded(end, decimals)
            if to != at or sweep:
                middle = _rounded(centre[:2], decimals) if sweep else ()
                word = "" if kind == Kind.RAPID else "F" + figure(feed, FEEDS)
                yield Block(at, to, middle, sweep, kind == Kind.RAPID, word if word != modal else "")
                modal = word or modal
            at = to


def _rounded(point: Iterable[float], decimals: int) -> Point:
    return tuple(round(value, decimals) for value in point)


def _as_a_line(start: Point, end: Point, centre: Point, angle: float, unit: float) -> bool:
    """Whether an arc bends too little for the last decimal, or is so small that its ends would be those of a whole turn."""
    bow = math.dist(start, centre) * (1 - math.cos(min(angle / 2, math.pi)))
    return bow < 2 * unit or (angle < 1.1 * math.pi and math.dist(start, end) < FULL + 2 * unit)


def _words(ways: Iterator[Block], decimals: int) -> Iterator[str]:
    """G0 to G3, with I and J from the start."""
    for way in ways:
        code = "G0" if way.rapid else "G1" if not way.sweep else "G3" if way.sweep > 0 else "G2"
        words = [code, *(axis + figure(value, decimals) for axis, value in way.targets)]
        words += [axis + figure(c - s, decimals) for axis, c, s in zip("IJ", way.centre, way.start, strict=False)]
        yield " ".join([*words, way.feed]).rstrip()


def _klartext(ways: Iterator[Block], decimals: int) -> Iterator[str]:
    """L, and C about a centre CC; a helix is CP by an angle, the next way begins where it should have ended."""
    for way in ways:
        targets = [axis + _signed(value, decimals) for axis, value in way.targets]
        words = ["L", *targets]
        if way.sweep:
            yield " ".join(["CC", *(axis + _signed(value, decimals) for axis, value in zip("XY", way.centre, strict=False))])
            words = ["C", *targets, "DR+" if way.sweep > 0 else "DR-"]
            if way.start[2] != way.end[2]:
                words[:3] = ["CP", "IPA" + _signed(math.degrees(way.sweep), decimals + 3)]
        yield " ".join([*words, "FMAX" if way.rapid else way.feed]).rstrip()


def _signed(value: float, decimals: int) -> str:
    text = figure(value, decimals)
    return text if text.startswith("-") else "+" + text
