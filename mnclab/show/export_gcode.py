"""A run as plain lines and arcs in RS-274, as LinuxCNC reads it: cycles, labels, frames and compensation are worked out.

Positions are those of the tool tip in the first work offset of the program, G54 here. What is compensated stays so: the
file runs under G40, for the tools it was made for. The path is followed exactly (G61), with a stop where the program
asked for one (G61.1). Threads are G33, whose K is the way per turn of the spindle. The X of a lathe is a radius (G8).

What RS-274 has no plain word for is written another way or told in a comment: arcs in tilted planes become chords
within `CHORD` mm, a probing move is a cut that ends where the probe touched.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np

from mnclab.path.toolpath import COLUMNS, MOTION_KINDS, Kind, Toolpath, concatenate

CHORD = 0.001
DECIMALS = 6  # a millionth of a millimetre: LinuxCNC compares the radii of an arc's ends
#: The columns of a path that blocks are made of.
WORDS = "kind line label start end centre axis sweep rotary feed time spindle tool exact synchronous step".split()
#: Number of a normal's axis -> plane, first and second axis, their words of the centre.
PLANES = {2: ("G17", 0, 1, "IJ"), 1: ("G18", 2, 0, "KI"), 0: ("G19", 1, 2, "JK")}
COOLANT = ("M7", "M8", "M9")


def write_gcode(run: Any, path: Path) -> None:
    """Write a run as RS-274."""
    with path.open("w", encoding="ascii", newline="\n") as file:
        file.writelines(line + "\n" for line in lines(run))


def lines(run: Any) -> Iterator[str]:
    """The lines of the file."""
    writer = Writer(run)
    yield "%"
    yield comment(f"{Path(run.program.name).name} for {run.control.title}, as plain moves")
    for alarm in run.alarms:
        yield comment(alarm.without_folders().headline)
    yield f"G21 {'G18 G8' if run.toolpath.lathe else 'G17'} G90 G94 G91.1 G40 G49 G80 G54 G61"
    yield from writer.rows(plain(run.toolpath))
    yield "M2"
    yield "%"


def comment(text: str) -> str:
    """A comment: ASCII, and no bracket in it."""
    clean = " ".join(text.translate({ord("("): "[", ord(")"): "]"}).split())
    return f"({clean.encode('ascii', 'replace').decode()})"


def plain(path: Toolpath) -> Toolpath:
    """The path with arcs in tilted planes as chords."""
    tilted = (path.kind == Kind.ARC) & (np.abs(path.axis).max(axis=1) < 1 - 1e-12)
    pieces, at = [], 0
    for row in np.flatnonzero(tilted).tolist():
        xyz, _ = path[row : row + 1].points(CHORD)
        copies = path[np.full(len(xyz) - 1, row)]
        chords = {name: getattr(copies, name) for name in COLUMNS}
        chords |= {"kind": np.full(len(copies), Kind.LINE, np.uint8), "start": xyz[:-1], "end": xyz[1:]}
        pieces += [path[at:row], copies.replace(**chords)]
        at = row + 1
    return concatenate([*pieces, path[at:]]) if pieces else path


class Writer:
    """Turns rows into blocks; keeps what is modal, so that a word is written only where it changes."""

    def __init__(self, run: Any) -> None:
        self.run = run
        self.motion = self.feed = ""
        self.unknown = ["", "0", ""] if run.toolpath.lathe else [""] * 3  # a lathe has no Y to go to
        self.at = list(self.unknown)  # the coordinates as written last
        self.rotary = ["0"] * 3
        self.plane = "G18" if run.toolpath.lathe else "G17"
        self.exact = False
        self.spindle = 0.0
        self.label = (0, "")

    def rows(self, path: Toolpath) -> Iterator[str]:
        columns = {name: getattr(path, name) for name in WORDS} | {"rotary": np.degrees(path.rotary)}
        first = True
        for row in zip(*(column.tolist() for column in columns.values())):
            values = dict(zip(columns, row))
            kind, label = values["kind"], path.labels[values["label"]]
            if (values["line"], label) != self.label:
                self.label = values["line"], label
                yield comment(f"line {values['line']}{': ' + label if label else ''}")
            if kind in MOTION_KINDS:
                if first and kind != Kind.RAPID:
                    yield self.move("G0", values["start"], [0.0, 0.0, 0.0])
                first = False
                yield from self.travel(values)
            else:
                yield from self.event(values)

    def travel(self, row: dict[str, Any]) -> Iterator[str]:
        kind, end = row["kind"], row["end"]
        feed = math.degrees(row["feed"]) if row["start"] == end and kind == Kind.LINE else row["feed"]  # rotary alone
        if row["exact"] != self.exact:
            self.exact = row["exact"]
            yield "G61.1" if self.exact else "G61"
        if row["synchronous"] and row["spindle"]:
            self.motion = ""
            yield f"G33{self.axes(end, row['rotary'])} K{number(row['feed'] / abs(row['spindle']))}"
        elif kind == Kind.ARC and (words := self.arc(row)):
            yield from words
        elif block := self.move("G0" if kind == Kind.RAPID else "G1", end, row["rotary"], feed):
            yield block + (" " + comment("probing, to the point touched") if kind == Kind.PROBE else "")

    def move(self, code: str, end: list[float], rotary: list[float], feed: float = math.inf) -> str:
        """A straight block; empty if it would move nothing at the precision of the file."""
        axes = self.axes(end, rotary)
        if not axes:
            return ""
        return (self.head(code) + axes + ("" if code == "G0" else self.feed_word(feed))).strip()

    def head(self, code: str) -> str:
        """The code of a motion where it changes."""
        before, self.motion = self.motion, code
        return "" if code == before else code

    def axes(self, end: list[float], rotary: list[float]) -> str:
        words = []
        for letters, kept, values in (("XYZ", self.at, end), ("ABC", self.rotary, rotary)):
            for k, value in enumerate(values):
                text = number(value)
                if text != kept[k]:
                    kept[k] = text
                    words.append(f" {letters[k]}{text}")
        return "".join(words)

    def feed_word(self, feed: float) -> str:
        text = number(feed, 4)
        if text == self.feed or not math.isfinite(feed):
            return ""
        self.feed = text
        return f" F{text}"

    def arc(self, row: dict[str, Any]) -> list[str]:
        """The blocks of an arc; none where it is so short that its ends are written alike, and a line says it."""
        normal = max(range(3), key=lambda k: abs(row["axis"][k]))
        plane, first, second, letters = PLANES[normal]
        start, end, centre, sweep = row["start"], row["end"], row["centre"], row["sweep"]
        closed = all(number(start[k]) == number(end[k]) for k in (first, second))
        turns = abs(sweep) / (2 * math.pi)
        if closed and turns < 0.5:
            return []
        count = round(turns) if closed else math.floor(turns) + 1
        blocks, self.plane = ([plane] if plane != self.plane else []), plane
        head = self.head("G3" if (sweep > 0) == (row["axis"][normal] > 0) else "G2")
        # I J K from the start as it was written, so that rounding does not add up
        away = (float(number(centre[k])) - float(number(start[k])) for k in (first, second))
        offsets = "".join(f" {letter}{number(value)}" for letter, value in sorted(zip(letters, away)))
        times = f" P{count}" if count > 1 else ""
        axes = self.axes(end, row["rotary"])
        return [*blocks, (head + axes + offsets + times + self.feed_word(row["feed"])).strip()]

    def event(self, row: dict[str, Any]) -> Iterator[str]:
        match row["kind"]:
            case Kind.DWELL:
                yield f"G4 P{number(row['time'])}"
            case Kind.TOOL:
                yield f"T{row['tool']} M6"
                yield f"G43 H{row['tool']}" if row["tool"] else "G49"
                self.at = list(self.unknown)  # the tip has jumped
                self.motion, self.spindle = "", 0.0  # a tool change stops the spindle
                yield from self.turn(row["spindle"])
            case Kind.SPINDLE:
                yield from self.turn(row["spindle"])
            case Kind.COOLANT:
                code = self.run.history.value("coolant", row["step"])
                yield code if code in COOLANT else comment(f"coolant: {code or 'changed'}")
            case Kind.STOP:
                yield "M0"

    def turn(self, speed: float) -> Iterator[str]:
        """The spindle from what it does to what it is to do, rev/min with a sign."""
        if speed != self.spindle:
            self.spindle = speed
            yield f"S{number(abs(speed), 4)} {'M3' if speed > 0 else 'M4'}" if speed else "M5"


def number(value: float, decimals: int = DECIMALS) -> str:
    """A number without an exponent, trailing zeros or a negative zero."""
    text = f"{value:.{decimals}f}".rstrip("0").rstrip(".")
    return "0" if text in ("-0", "") else text
