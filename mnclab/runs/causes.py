"""Where what is wrong may come from: blocks beside the one at which it shows, the likeliest first, as (line, what it does)."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator, Sequence
from typing import Any, NamedTuple, TypeAlias

import numpy as np

from mnclab.path.toolpath import Kind
from mnclab.runs.run import Run

Place: TypeAlias = tuple[float, float, float]

WORDS = re.compile(r"(?<![A-Z])(I?)([XY])\s*([-+]?\d*\.?\d+)")
CENTRE, LABEL = re.compile(r"\bCC\b"), re.compile(r"^(?:N?\d+ +)?(?:LBL |G98 L)((?!0\b)\w+)")
ARC = re.compile("between start and end|not on the circle|angle of the arc")
VARIABLE = re.compile(r"(?:Q[LRS]?|#)\d+")
FRAME = ("rotation angle", "mirror", "scaling", "tools ", "frame tilt")  # of the state: what turns or moves a path
NEAR = re.compile(r"near \(([-\d.]+), ([-\d.]+)\)")
OTHER = re.compile(r"\bline (\d+)")
MISSING = re.compile(r"no feed|needs a feed|no value was given")
END, START = re.compile(r"M0?2\b|M30\b|LBL 0|G98 L0"), re.compile(r"LBL|G98 L|END PGM")


class Cause(NamedTuple):
    """A block that a fault may come from: its line, and what it does; `sure` where it is told before another fault of a line that
    was named."""

    line: int
    text: str
    sure: bool = False


class Corner(NamedTuple):
    """The end of a piece of a contour, or a pole, as it is written: behind which label of all, its line, where."""

    label: int
    line: int
    point: tuple[float, float]


def of_row(run: Run, row: int, places: Sequence[Place | None], first: int | str | None = None) -> Iterator[Cause]:
    """Of a row of the path: its own block; the pieces of its contour about some places; what brought the tool where it begins,
    the axis `first` before the others, one along which it stands still before one along which it goes; its cycle, its tool."""
    path, step, of = run.toolpath, int(run.toolpath.step[row]), int(run.toolpath.line[row])
    if path.program[row]:
        return
    yield Cause(of, "the tool passes there in this block")
    if path.label[row] and first != 2:  # a depth is none of its contour
        yield from of_contour(run, places)
    before = [*_brought(run, row, first)]
    for line, name in [*_values(run, [of, *(line for line, _ in before)], step)][::-1]:  # typed before what is worked out
        yield Cause(line, f"line {of} works with the {name} of this block", True)
    for name in run.history:
        if name.startswith(FRAME) and (line := line_of(run, name, step)) > 1:
            yield Cause(line, f"line {of} works with what this block sets", True)
    names = ("cycle", "Q1", "tool") if path.label[row] else ("tool",)  # Q1: the depth of contour cycles
    names = ("pattern", *names) if re.search(r"\bPAT\b", dict(code_of(run)).get(of, "")) else names
    said = [(line_of(run, name, step), name) for name in names]
    told = [Cause(line, f"line {of} works with the {name} of this block", name == first) for line, name in said if line]
    if path.label[row] and first not in (0, 1) or first == "tool":
        yield from told
    yield from (Cause(line, f"line {of} begins at the {axis} of this block") for line, axis in before)
    yield from told


def _brought(run: Run, row: int, first: int | str | None) -> Iterator[tuple[int, str]]:
    """What brought the tool where a row begins, the axis `first` before the others: line and axis."""
    path = run.toolpath
    moved = np.abs(path.end - path.start)
    for axis in sorted((0, 2) if path.lathe else (0, 1, 2), key=lambda axis: (axis != first, moved[row, axis])):
        before = np.flatnonzero(path.is_motion[:row] & (moved[:row, axis] > 1e-9) & (path.line[:row] != path.line[row]))
        if len(before) and path.program[before[-1]] == 0:
            yield int(path.line[before[-1]]), "XYZ"[axis]


def _values(run: Run, lines: list[int], step: int) -> Iterator[tuple[int, str]]:
    """Where the variables of some blocks got their values, those first that stand in them: line and name."""
    code, known = dict(code_of(run)), set[str]()
    for at in lines:
        for name in VARIABLE.findall(code.get(at, "")):
            if name not in known and (said := line_of(run, name, step)):
                known.add(name)
                lines.append(said)
                yield said, name


def of_alarm(run: Run, said: str, line: int) -> Iterator[Cause]:
    """Of an alarm in a line: where an arc begins, what a spindle that stands still lacks, where a tool or a label is missing."""
    code = code_of(run)
    if ARC.search(said):
        ahead = [(k, text) for k, text in code if k < line and not CENTRE.search(text)]
        last = {axis: max((k for k, text in ahead if re.search(rf"(?<![A-Z]){axis}\s*[-+=.\d]", text)), default=0)
                for axis in ("XZ" if run.toolpath.lathe else "XY")}  # fmt: skip
        yield from (Cause(last[axis], f"the arc of line {line} begins at the {axis} of this block", True)
                    for axis in sorted(last, key=last.__getitem__, reverse=True))  # fmt: skip
    if near := NEAR.search(said):
        yield from of_contour(run, [(float(near[1]), float(near[2]), 0.0)])
    yield from (Cause(int(other), f"line {line} does not go with this one", True) for other in OTHER.findall(said))
    if MISSING.search(said):
        yield Cause(code[0][0], f"no block from this one up to line {line} says it", True)
    yield from _of_labels(code)
    if "spindle" in said:
        end = len(run.steps.block) - 1
        name, lacks = ("turning", "speed S") if run.history.value("turning", end) else ("speed", "direction, as M3")
        found = line_of(run, name, end) or spindle_line(run)  # the block that has the other of the two
        yield Cause(found, f"neither this block nor another gives the spindle a {lacks}", True)
    if "tool" in said and not run.toolpath.tool.any():  # not every control has a word for it
        yield Cause(first_move(run) or code[0][0], "no tool is called before this block", True)


def code_of(run: Run) -> list[tuple[int, str]]:
    """The blocks of the program: the line of each, and its text without comments in capitals."""
    program = run.program
    return [(int(program.line_of(k)), " ".join(program.code_of(k)).upper()) for k in range(len(program))]


def _of_labels(code: list[tuple[int, str]]) -> Iterator[Cause]:
    """Where a label, or the end of what stands before one, is missing behind the end of the program."""
    behind = within = ended = False
    for k, text in code:
        label = LABEL.search(text) is not None
        if label and within:
            yield Cause(k, "what stands before this label has no end", True)
        elif ended and not label and not START.search(text):
            yield Cause(k, "no label stands before this block, so that no program comes to it", True)
        ended = END.search(text) is not None
        behind, within = behind or ended, not ended and (within or label and behind)


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


def corners(run: Run) -> tuple[list[Corner], list[Corner]]:
    """Where the pieces of contours behind labels end that no tool follows itself, as cycles read them; and their poles."""
    here, label = (0.0, 0.0), 0
    found: tuple[list[Corner], list[Corner]] = [], []
    for line, text in code_of(run):
        label += bool(LABEL.search(text))
        if label and (words := WORDS.findall(text)) and line not in run.toolpath.line:
            said = {axis: float(number) + (here["XY".index(axis)] if more else 0.0) for more, axis, number in words}
            point = said.get("X", here[0]), said.get("Y", here[1])
            centre = CENTRE.search(text) is not None
            here = here if centre else point
            found[centre].append(Corner(label, line, point))
    return found


def of_contour(run: Run, places: Sequence[Place | None]) -> Iterator[Cause]:
    """The pieces of a contour that are nearest to some places, then the nearest poles, then where those pieces begin."""
    ends, poles = corners(run)
    pairs, there = [pair for pair in zip(ends, ends[1:]) if pair[0].label == pair[1].label], [each for each in places if each]
    near = [min(pairs, key=lambda pair: _detour(place, *pair)) for place in there if pairs]
    yield from (Cause(b.line, "this piece of the contour passes there", True) for _, b in near)
    yield from (Cause(min(poles, key=lambda each: math.dist(each.point, place[:2])).line, "this pole is the nearest", True)
                for place in there if poles)  # fmt: skip
    yield from (Cause(a.line, f"line {b.line} goes on from here", True) for a, b in near)


def _detour(place: Place, a: Corner, b: Corner) -> float:
    """How much longer the way from corner to corner is by a place."""
    return math.dist(a.point, place[:2]) + math.dist(place[:2], b.point) - math.dist(a.point, b.point)


AROUND = 1.0  # mm, beyond the largest tool: a row that is farther away has nothing to do with a place


def beside_missing(run: Run, place: Place | None, *but: int, surface: tuple[int, float] | None = None) -> Iterator[Cause]:
    """Blocks beside which the one may stand that is missing: where the tool comes nearest at rapid and leaves again at rapid, of
    all at the height of the finished `surface` (axis, value) first; the block at feed that passes nearest, however far away."""
    path = run.toolpath
    moves = np.flatnonzero(path.is_motion & (path.program == 0))
    rapid, went = path.kind[moves] == Kind.RAPID, (path.end - path.start)[moves]
    across = path.lathe | (went[:, :2] != 0).any(axis=1)
    leaves = np.append((rapid & (across | (went[:, 2] > 0)))[1:], False)
    rows = moves[rapid & across & leaves & ~np.isin(path.line[moves], but)]
    if place is not None and len(rows):
        far = np.linalg.norm(path.end[rows] - place, axis=1)
        at = np.abs(path.end[rows, surface[0]] - surface[1]) < 1e-6 if surface else far < 0
        row = rows[np.where(at, far, far + far.max()).argmin()]
        yield Cause(int(path.line[row]), "the tool comes here, and leaves without a cut")
    yield Cause(nearest(run, place, False, but, math.inf)[0], "of the other blocks that cut this one comes nearest")


def nearest(
    run: Run, place: Place | None, over: bool = False, but: tuple[int, ...] = (), within: float = 0.0
) -> tuple[int, int]:
    """The line of the row at feed that passes nearest to a place, `over` it at any height, and rapid if none at feed is nearly
    as near, and this row; 0 and -1 where none has to do with it; the last of some as near; an arc is its chord.
    Rows of the lines `but` are left out."""
    path = run.toolpath
    across = path.lathe | (path.start != path.end)[:, :2].any(axis=1)  # a retract is no way to a place
    cuts = (path.kind != Kind.RAPID) | (across & over)
    rows = np.flatnonzero(path.is_motion & (path.program == 0) & ~np.isin(path.line, but) & cuts)
    if place is None or not len(rows):
        return 0, -1
    seen = np.array([1.0, 1.0, 0.0 if over and not path.lathe else 1.0])
    there, start, along = place * seen, path.start[rows] * seen, (path.end[rows] - path.start[rows]) * seen
    share = np.clip(((there - start) * along).sum(axis=1) / np.maximum((along**2).sum(axis=1), 1e-12), 0.0, 1.0)
    far = np.linalg.norm(start + share[:, None] * along - there, axis=1) + AROUND * (path.kind[rows] == Kind.RAPID)
    k = int(np.flatnonzero(far <= far.min() + 1e-6)[-1])
    reach = max(within, AROUND + max((tool.radius for tool in run.tools_that_cut[0].values()), default=0.0))
    return (int(path.line[rows[k]]), int(rows[k])) if far[k] <= reach else (0, -1)


def moved_last(run: Run, row: int, axis: int | None) -> int:
    """The line of the last move along an axis (None: any) up to the cut that a row leaves behind; 0 for none.

    A rapid makes nothing, it leaves what the cut before it made.
    """
    path = run.toolpath
    ahead = np.flatnonzero(path.is_motion[: row + 1] & (path.program[: row + 1] == 0))
    cuts = ahead[path.kind[ahead] != Kind.RAPID]
    along = ahead[ahead <= cuts[-1]] if len(cuts) else cuts
    if axis is not None:
        along = along[np.abs(path.end - path.start)[along, axis] > 1e-9]
    return int(path.line[along[-1]]) if len(along) else 0
