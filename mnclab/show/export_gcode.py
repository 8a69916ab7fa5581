"""A run as plain lines and arcs in RS-274, as LinuxCNC reads it: cycles, labels, frames and compensation are worked out.

Positions are those of the tool tip in the first work offset of the program, G54 here. What is compensated stays so: the
file runs under G40, for the tools it was made for. The path is followed exactly (G61), with a stop where the program
asked for one (G61.1). Threads are G33, whose K is the way per turn of the spindle. The X of a lathe is a radius (G8).

A machine whose rotary axes swing the tip goes by its axes: X Y Z are those of its spindle reference less the length of the tool,
from the same offset, so that a machine whose axes turn about the same lines does the same, without leading the tip. The feed is
that of X Y Z, or in degrees where they stand.

What RS-274 has no plain word for is written another way or told in a comment: arcs in tilted planes become chords
within `CHORD` mm, a probing move is a cut that ends where the probe touched.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mnclab.geometry.kinematics import UP
from mnclab.path.toolpath import COLUMNS, Index, Kind, Mask, Toolpath, concatenate
from mnclab.text.columns import parts, spelled

CHORD = 0.001
DECIMALS = 6  # a millionth of a millimetre: LinuxCNC compares the radii of an arc's ends
#: Number of a normal's axis -> plane, first and second axis, their words of the centre.
PLANES = {2: ("G17", 0, 1, "IJ"), 1: ("G18", 2, 0, "KI"), 0: ("G19", 1, 2, "JK")}
COOLANT = ("M7", "M8", "M9")
STANDS = 1e-9  # mm
Array = NDArray[np.float64]
Words = NDArray[np.object_]


def write_gcode(run: Any, path: Path) -> None:
    """Write a run as RS-274."""
    with path.open("w", encoding="ascii", newline="\n") as file:
        file.writelines(text(run))


def lines(run: Any) -> list[str]:
    """The lines of the file."""
    return "".join(text(run)).splitlines()


def text(run: Any) -> Iterator[str]:
    """The file, many lines at a time."""
    yield f"%\n{comment(f'{Path(run.program.name).name} for {run.control.title}, as plain moves')}\n"
    yield from (f"{comment(alarm.without_folders().headline)}\n" for alarm in run.alarms)
    yield f"G21 {'G18 G8' if run.toolpath.lathe else 'G17'} G90 G94 G91.1 G40 G49 G80 G54 G61\n"
    path = run.toolpath
    if path.kinematics is not None and path.rotary.any():
        yield f"{comment(f'X Y Z of the axes, less the length of the tool; {path.kinematics}')}\n"
        path = by_axes(path, run.axes())
    path = plain(path)
    writer = Writer(run, path.labels)
    if path.kinematics is not None and any(path.kinematics.home):
        writer.at[3:] = [number(angle) for angle in np.degrees(path.kinematics.home).tolist()]
        yield "G0" + "".join(f" {name}{angle}" for name, angle in zip("ABC", writer.at[3:]) if angle != "0") + "\n"
    yield from ("".join(writer.rows(path[some])) for some in parts(len(path)))
    yield "M2\n%\n"


def comment(text: str) -> str:
    """A comment: ASCII, and no bracket in it."""
    clean = " ".join(text.translate({ord("("): "[", ord(")"): "]", ord("°"): " degrees"}).split())
    return f"({clean.encode('ascii', 'replace').decode()})"


def plain(path: Toolpath) -> Toolpath:
    """The path with arcs in tilted planes as chords."""
    arcs = np.flatnonzero(path.kind == Kind.ARC)
    pieces, at = [], 0
    for row in arcs[np.abs(path.axis[arcs]).max(axis=1) < 1 - 1e-12].tolist():
        xyz, _ = path[row : row + 1].points(CHORD)
        copies = path[np.full(len(xyz) - 1, row)]
        chords = {name: getattr(copies, name) for name in COLUMNS}
        chords |= {"kind": np.full(len(copies), Kind.LINE, np.uint8), "start": xyz[:-1], "end": xyz[1:]}
        pieces += [path[at:row], copies.replace(**chords)]
        at = row + 1
    return concatenate([*pieces, path[at:]]) if pieces else path


def by_axes(path: Toolpath, axes: Any) -> Toolpath:
    """The rows where the tip would be if no rotary axis had turned, which is where X Y Z stand; `axes` are those of the run.

    Feeds are those of X Y Z, rad/min where they stand.
    """
    kinematics, lengths = path.kinematics, axes.lengths
    assert kinematics is not None
    before = np.concatenate([[kinematics.home], path.rotary[:-1]])
    end = np.asarray(axes)[:, :3] - np.multiply.outer(lengths, UP) - path.origin
    back = kinematics.carried(path.rotary, lengths)[:, :3, :3]
    axis = np.einsum("nji,nj->ni", back, path.axis)
    centre = end + np.einsum("nji,nj->ni", back, path.centre - path.end)
    first = end[:1] + np.einsum("nji,nj->ni", back[:1], path.start[:1] - path.end[:1])  # nothing turns in the first row
    start = np.concatenate([first, end[:-1]])
    turned = (path.rotary != before).any(axis=1)
    still = turned & (np.linalg.norm(end - start, axis=1) < STANDS)
    end[still] = start[still]
    way, angle = np.linalg.norm(end - start, axis=1), np.linalg.norm(path.rotary - before, axis=1)
    with np.errstate(divide="ignore", invalid="ignore"):
        minutes = np.where(np.isfinite(path.time), path.time / 60, path.lengths / path.feed)
        feed = np.where(turned & (path.kind == Kind.LINE), np.where(way > 0, way, angle) / minutes, path.feed)
    return path.replace(start=start, end=end, centre=centre, axis=axis, feed=feed)


class Writer:
    """Turns rows into blocks, by columns; keeps what is modal, so that a word is written only where it changes."""

    def __init__(self, run: Any, labels: Sequence[str]) -> None:
        self.run = run
        self.begun = self.exact = False
        self.motion = self.feed = ""
        self.unknown = ["", "0", ""] if run.toolpath.lathe else [""] * 3  # a lathe has no Y to go to
        self.at = [*self.unknown, "0", "0", "0"]  # X Y Z A B C as written last
        self.plane = "G18" if run.toolpath.lathe else "G17"
        self.spindle = 0.0
        numbers: dict[str, int] = {"": -1}
        self.labels = np.array([numbers.setdefault(label, k) for k, label in enumerate(labels)])
        self.notes = [comment(f"line 0{': ' * bool(label)}{label}").removeprefix("(line 0") for label in labels]
        self.source = 0, -1  # line and label

    def rows(self, path: Toolpath) -> Words:
        """The lines that each row of the next part of the path becomes (n,)."""
        label = self.labels[path.label]
        fresh = np.flatnonzero((path.line != _before(path.line, self.source[0])) | (label != _before(label, self.source[1])))
        said = _empty(len(path))
        said[fresh] = [*map("(line %s%s\n".__mod__, zip(path.line[fresh].tolist(), spelled(self.notes, path.label[fresh])))]
        self.source = int(path.line[-1]), int(label[-1])
        moves, changes = np.flatnonzero(path.is_motion), np.cumsum(path.kind == Kind.TOOL)
        if len(moves):
            said[moves] += self.travel(path[moves], changes[moves])
        if changes[-1] > (changes[moves[-1]] if len(moves) else 0):
            self.change()
        for row in np.flatnonzero(~path.is_motion).tolist():
            said[row] += "".join(line + "\n" for line in self.event(path, row))
        return said

    def change(self) -> None:
        """With another tool the tip has jumped, and no motion is modal."""
        self.at[:3], self.motion = self.unknown, ""

    def travel(self, path: Toolpath, changes: Index) -> Words:
        """The lines of moves (k,); `changes` of tools before each."""
        kind, feed, since, lead = path.kind, path.feed, 0, ""
        if not self.begun and kind[0] != Kind.RAPID:
            start = [number(value) for value in path.start[0].tolist()]
            lead = "G0" + "".join(f" {a}{new}" for a, new, old in zip("XYZ", start, self.unknown) if new != old) + "\n"
            self.at[:3], self.motion, since = start, "G0", int(changes[0])
        self.begun = True
        axes = self.axes(path, changes > _before(changes, since))
        threads = path.synchronous & (path.spindle != 0)
        code = spelled(("G0", "G1", "G1", "G1"), kind)
        more, planes = _empty(len(path)), _empty(len(path))
        code[threads] = "G33"
        for row in np.flatnonzero(threads).tolist():
            more[row] = f" K{number(feed[row] / abs(path.spindle[row]))}"
        for row in np.flatnonzero((kind == Kind.ARC) & ~threads).tolist():
            if found := self.arc(path, row):
                planes[row], code[row], more[row] = found
        # a straight move that moves nothing at the precision of the file is none
        written = np.flatnonzero((axes != "") | (code == "G33") | (code == "G2") | (code == "G3"))
        code, at = code[written], changes[written]
        head = np.where((code != _before(code, self.motion)) | (at > _before(at, since)) | (code == "G33"), code, "")
        turning = (kind == Kind.LINE) & (path.start == path.end).all(axis=1)  # rotary alone
        feed = np.where(turning, np.degrees(feed), feed)[written]
        fed = np.isfinite(feed) & (code != "G0") & (code != "G33")
        texts, fed = numbers(feed[fed], 4), written[fed]
        more[fed] += np.where(texts != _before(texts, self.feed), " F" + texts, "")
        more[written[(kind[written] == Kind.PROBE) & (code != "G33")]] += " " + comment("probing, to the point touched")
        blocks = _empty(len(path))
        blocks[written] = [block.strip() + "\n" for block in head + axes[written] + more[written]]
        stops = np.where(path.exact != _before(path.exact, self.exact), spelled(("G61\n", "G61.1\n"), path.exact.astype(int)), "")
        self.exact = bool(path.exact[-1])
        self.feed = texts[-1] if len(texts) else self.feed
        self.motion = code[-1] if len(code) else self.motion
        if changes[-1] > (at[-1] if len(at) else since):
            self.motion = ""
        said: Words = stops + planes + blocks
        said[0] = lead + said[0]
        return said

    def axes(self, path: Toolpath, jumped: Mask) -> Words:
        """The coordinates that change, of moves (k,); all of them where the tip has `jumped` to where it begins."""
        found = _empty(len(path))
        for k, (letter, column) in enumerate(zip("XYZABC", (*path.end.T, *np.degrees(path.rotary).T))):
            texts = numbers(column)
            before = _before(texts, self.at[k])
            if k < 3:
                before[jumped] = self.unknown[k]
            fresh = texts != before
            found[fresh] += f" {letter}" + texts[fresh]
            self.at[k] = texts[-1]
        return found

    def arc(self, path: Toolpath, row: int) -> tuple[str, str, str] | None:
        """The line of the plane, the code and the words of the centre of an arc; None where it is so short that its ends are
        written alike, and a line says it."""
        axis = path.axis[row].tolist()
        normal = max(range(3), key=lambda k: abs(axis[k]))
        plane, first, second, letters = PLANES[normal]
        start, end, centre = (column[row].tolist() for column in (path.start, path.end, path.centre))
        sweep = float(path.sweep[row])
        closed = all(number(start[k]) == number(end[k]) for k in (first, second))
        turns = abs(sweep) / (2 * math.pi)
        if closed and turns < 0.5:
            return None
        count = round(turns) if closed else math.floor(turns) + 1
        before, self.plane = self.plane, plane
        # I J K from the start as it was written, so that rounding does not add up
        away = (float(number(centre[k])) - float(number(start[k])) for k in (first, second))
        offsets = "".join(f" {letter}{number(value)}" for letter, value in sorted(zip(letters, away)))
        code = "G3" if (sweep > 0) == (axis[normal] > 0) else "G2"
        return f"{plane}\n" * (plane != before), code, offsets + f" P{count}" * (count > 1)

    def event(self, path: Toolpath, row: int) -> Iterator[str]:
        speed, tool = float(path.spindle[row]), int(path.tool[row])
        match path.kind[row]:
            case Kind.DWELL:
                yield f"G4 P{number(path.time[row])}"
            case Kind.TOOL:
                yield f"T{tool} M6"
                yield f"G43 H{tool}" if tool else "G49"
                self.spindle = 0.0  # a tool change stops the spindle
                yield from self.turn(speed)
            case Kind.SPINDLE:
                yield from self.turn(speed)
            case Kind.COOLANT:
                code = self.run.history.value("coolant", int(path.step[row]))
                yield code if code in COOLANT else comment(f"coolant: {code or 'changed'}")
            case Kind.STOP:
                yield "M0"

    def turn(self, speed: float) -> Iterator[str]:
        """The spindle from what it does to what it is to do, rev/min with a sign."""
        if speed != self.spindle:
            self.spindle = speed
            yield f"S{number(abs(speed), 4)} {'M3' if speed > 0 else 'M4'}" if speed else "M5"


def _before(column: NDArray[Any], first: Any) -> NDArray[Any]:
    """The value before each of a column (n,)."""
    return np.concatenate([[first], column])[:-1]


def _empty(count: int) -> Words:
    return np.full(count, "", dtype=object)


def numbers(column: NDArray[np.float64], decimals: int = DECIMALS) -> Words:
    """The numbers (n,) of a column as texts."""
    if (column == column[:1]).all():
        return np.full(len(column), "".join(number(value, decimals) for value in column[:1]), dtype=object)
    return np.array([number(value, decimals) for value in column.tolist()], dtype=object)


def number(value: float, decimals: int = DECIMALS) -> str:
    """A number without an exponent, trailing zeros or a negative zero."""
    text = f"{value:.{decimals}f}".rstrip("0").rstrip(".")
    return "0" if text in ("-0", "") else text
