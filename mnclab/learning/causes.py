"""Where what is wrong may come from: blocks beside the one at which it shows, the likeliest first, as (line, what it does)."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator, Sequence
from typing import Any, NamedTuple, TypeAlias

import numpy as np

from mnclab.runs.run import Run

Place: TypeAlias = tuple[float, float, float]
Point: TypeAlias = tuple[float, float]

WORDS = re.compile(r"(?<![A-Z])(I?)([XY])\s*([-+]?\d*\.?\d+)")
POLAR = re.compile(r"\bI?P([RA])\s*([-+]?\d*\.?\d+)")
CENTRE, LABEL = re.compile(r"\bCC\b"), re.compile(r"^(?:N?\d+ +)?(?:LBL |G98 L)((?!0\b)\w+)")
ARC = re.compile("between start and end|not on the circle|angle of the arc")
NEAR = re.compile(r"near \(([-\d.]+), ([-\d.]+)\)")
END, START = re.compile(r"M0?2\b|M30\b|LBL 0|G98 L0"), re.compile(r"LBL|G98 L|END PGM")


class Cause(NamedTuple):
    """A block that a fault may come from: its line, and what it does; `sure` where it is told before another fault of a line that
    was named."""

    line: int
    text: str
    sure: bool = False


def of_row(run: Run, row: int, places: Sequence[Place | None], first: int | str | None = None) -> Iterator[Cause]:
    """Of a row of the path: its own block; the pieces of its contour about some places; what brought the tool where it begins,
    the axis `first` before the others, one along which it stands still before one along which it goes; its cycle, its tool."""
    path, step, of = run.toolpath, int(run.toolpath.step[row]), int(run.toolpath.line[row])
    if path.program[row]:
        return
    yield Cause(of, "here the tool passes", True)
    if path.label[row]:
        yield from of_contour(run, places)
    names = ("cycle", "tool") if path.label[row] else ("tool",)
    told = [Cause(line_of(run, name, step), f"line {of} works with the {name} of this block", name == first) for name in names]
    if path.label[row] and first not in (0, 1) or first == "tool":
        yield from told
    moved = np.abs(path.end - path.start)
    for axis in sorted((0, 2) if path.lathe else (0, 1, 2), key=lambda axis: (axis != first, moved[row, axis])):
        before = np.flatnonzero(path.is_motion[:row] & (moved[:row, axis] > 1e-9) & (path.line[:row] != of))
        if len(before) and path.program[before[-1]] == 0:
            yield Cause(int(path.line[before[-1]]), f"line {of} begins at the {'XYZ'[axis]} of this block")
    yield from told


def of_alarm(run: Run, said: str, line: int) -> Iterator[Cause]:
    """Of an alarm in a line: where an arc begins, what a spindle that stands still lacks, where a tool or a label is missing."""
    program = run.program
    code = [(int(program.line_of(k)), " ".join(program.code_of(k)).upper()) for k in range(len(program))]
    if ARC.search(said):
        words = ((axis, re.compile(rf"(?<![A-Z]){axis}\s*[-+=.\d]")) for axis in ("XZ" if run.toolpath.lathe else "XY"))
        last = {axis: max((k for k, text in code if k < line and word.search(text) and not CENTRE.search(text)), default=0)
                for axis, word in words}  # fmt: skip
        for axis in sorted(last, key=lambda axis: -last[axis]):
            yield Cause(last[axis], f"the arc of line {line} begins at the {axis} of this block", True)
    if near := NEAR.search(said):
        yield from of_contour(run, [(float(near[1]), float(near[2]), 0.0)])
    yield from _of_labels(code, said)
    if "spindle" in said:
        lacks = "speed S" if run.history.value("turning", len(run.steps.block) - 1) else "direction, as M3"
        yield Cause(spindle_line(run), f"no block up to this one gives the spindle a {lacks}", True)
    if not run.toolpath.tool.any():
        yield Cause(first_move(run) or code[0][0], "no tool is called before this block", True)


def _of_labels(code: Sequence[tuple[int, str]], said: str) -> Iterator[Cause]:
    """Of labels that are not there, do not end or are run into; the blocks of the label that is told of."""
    open_, ended, name = "", False, re.search(r"label (\w+)", said)
    for k, text in code:
        if label := LABEL.search(text):
            if open_:
                yield Cause(k, f"label {open_} has not ended before this label begins", True)
            elif not ended:
                yield Cause(k, "the program runs into this label: it has no end before it", True)
            open_ = label[1]
        elif ended and not open_ and not START.search(text):
            yield Cause(k, "no label stands before this block, so that no program comes to it", True)
            open_ = "?"
        if name and open_ == name[1] and (label or END.search(text)):
            yield Cause(k, f"here label {open_} {'begins' if label else 'ends'}", True)
        if END.search(text):
            open_, ended = "", True


def first_move(run: Run, rows: Any = True) -> int:
    """The line of the first motion of the program, among some rows; 0 for none."""
    some = np.flatnonzero(run.toolpath.is_motion & (run.toolpath.program == 0) & rows)
    return int(run.toolpath.line[some[0]]) if len(some) else 0


def line_of(run: Run, name: str, step: int) -> int:
    """The line of the main program that last said something of a name, up to a step; 0 for none."""
    at = [k for k, _ in run.history.changed(name) if k <= step]
    return int(run.lines()[at[-1]]) if at and run.steps.program[at[-1]] == 0 else 0


def spindle_line(run: Run, step: int | None = None) -> int:
    """The line of the last block (up to a step) that changed tool, speed or direction of the spindle, or of the first motion."""
    last = len(run.steps.block) - 1 if step is None else step
    return max((line_of(run, name, last) for name in ("turning", "speed", "tool")), default=0) or first_move(run)


class Piece(NamedTuple):
    """A piece of a contour as it is written: its line, from where to where, the pole about which it turns and the line of it."""

    line: int
    start: Point
    end: Point
    pole: Point | None
    turns: int

    def away(self, place: Place) -> float:
        """How far a place is from it, from a circle as a whole."""
        if self.pole is not None:
            return abs(math.dist(place[:2], self.pole) - math.dist(self.end, self.pole))
        a, along = np.array(self.start), np.subtract(self.end, self.start)
        there = np.array(place[:2]) - a
        share = np.clip(there @ along / max(along @ along, 1e-12), 0.0, 1.0)
        return float(np.hypot(*(there - share * along)))


def pieces(run: Run) -> list[list[Piece]]:
    """The contours that stand behind labels and that no tool follows itself, for cycles read them."""
    found: list[list[Piece]] = []
    here, pole, begun, turns = [0.0, 0.0], [0.0, 0.0], False, 0
    for k in range(len(run.program)):
        line, text = int(run.program.line_of(k)), " ".join(run.program.code_of(k)).upper()
        if LABEL.search(text):
            found.append([])
            begun = False
        if not found or line in run.toolpath.line:
            continue
        words, polar = WORDS.findall(text), dict(POLAR.findall(text))
        at = pole if CENTRE.search(text) else here
        turns = line if at is pole else turns
        start = (here[0], here[1])
        for more, axis, number in words:
            at["XY".index(axis)] = float(number) + (at["XY".index(axis)] if more else 0.0)
        if "R" in polar and "A" in polar:
            angle = math.radians(float(polar["A"]))
            here = [pole[0] + float(polar["R"]) * math.cos(angle), pole[1] + float(polar["R"]) * math.sin(angle)]
        if (words or polar) and at is here or polar:
            end = here[0], here[1]
            about = (pole[0], pole[1]) if re.search(r"\bCP?\b", text) else None
            found[-1].append(Piece(line, start if begun else end, end, about, turns))
            begun = True
    return [each for each in found if each]


def of_contour(run: Run, places: Sequence[Place | None]) -> Iterator[Cause]:
    """The pieces of a contour that are nearest to some places, and the pieces beside them."""
    contours, beside = pieces(run), []
    for place in places:
        if place is None or not contours:
            continue
        contour = min(contours, key=lambda each: min(piece.away(place) for piece in each))
        k = min(range(len(contour)), key=lambda k: contour[k].away(place))
        piece = contour[k]
        yield Cause(piece.line, "this piece of the contour passes there", True)
        if piece.pole is not None:
            yield Cause(piece.turns, f"line {piece.line} turns about this pole", True)
        beside += [Cause(each.line, f"line {piece.line} goes on from here", True) for each in contour[:k][-1:]]
        beside += [Cause(each.line, "this piece of the contour comes next", True) for each in contour[k + 1 : k + 2]]
    yield from beside
