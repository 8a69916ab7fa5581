"""What is wrong with an answer, most important first, each with the steps of help that it gets, try by try."""

from __future__ import annotations

import math
import re
from collections.abc import Iterable, Iterator, Mapping
from typing import Any, NamedTuple

import numpy as np

from mnclab.design.difference.threads import EXACT, passes_of
from mnclab.learning.grade import HINTS, Hint
from mnclab.runs.causes import Cause, beside_missing, first_move, moved_last, nearest, of_alarm, of_row, spindle_line
from mnclab.runs.material import cutting_of
from mnclab.runs.run import Run
from mnclab.workpiece.collision import KINDS, Collisions

Place = tuple[float, float, float]

#: What comes first: a program that stops, danger, the part, then what else was asked for.
STOPPED, DANGER, PART, ASKED, SLOW = range(5)
ZERO = "zero point"  # a kind
LESS_HELP = 3  # the try of the same fault from which on the next step is told


class Finding(NamedTuple):
    """One thing that is wrong: its `kind` (the same fault has the same), the line, `steps` of help, where, and other lines that
    it may come from, the likeliest first."""

    rank: int
    kind: str
    line: int
    steps: tuple[str, ...]
    place: Place | None = None
    causes: tuple[Cause, ...] = ()

    def hint(self, tries: int) -> Hint:
        """The step of this try, from 1; the last one is given again."""
        return Hint(self.line, self.steps[min(max(0, tries - LESS_HELP + 1), len(self.steps) - 1)], self.place)


def hints_of(
    findings: Iterable[Finding], tried: Mapping[str, int], remarks: Iterable[Cause] = ()
) -> tuple[tuple[Hint, ...], tuple[str, ...]]:
    """At most three hints of different kinds, and the kinds of all findings in their order; where they leave room, and before
    another hint to the same line, what else their faults may come from."""
    ordered = sorted(findings, key=lambda each: each.rank)
    first = {each.kind: each for each in reversed(ordered)}
    kinds = tuple(dict.fromkeys(each.kind for each in ordered))
    found = [first[kind] for kind in kinds[:HINTS]]
    told = [each.hint(tried.get(each.kind, 0) + 1) for each in found]
    causes = [*remarks, *(cause for each in found for cause in each.causes if cause.line)] if found else []
    hints = [*told, *(Hint(cause.line, cause.text if cause.sure else f"or here: {cause.text}") for cause in causes)]
    off = [min((abs(hint.line - each.line) for each in hints[:k]), default=9) for k, hint in enumerate(hints)]
    ranks = [int(k > 0 and (off[k] == 0 or hint.line == 0)) for k, hint in enumerate(told)]  # a neighbour is seen anyway
    ranks += [4 - off[k] if off[k] < 2 else 2 * (not cause.sure) for k, cause in enumerate(causes, len(told))]
    order = [k for k in sorted(range(len(hints)), key=ranks.__getitem__) if ranks[k] < 4][:HINTS]
    named, chosen = {hints[k].line for k in order}, []
    for k in order:
        own = (c for each in found[k : k + 1] for c in each.causes if c.line)  # none of a cause's
        other = next((c for c in own if all(abs(c.line - line) > 1 for line in named)), None)
        named |= {other.line} if other else set()
        chosen.append(hints[k]._replace(text=f"{hints[k].text} [or in line {other.line}: {other.text}]") if other else hints[k])
    return tuple(chosen), kinds


def of_alarms(run: Run) -> Iterator[Finding]:
    """The alarms of a run, the first with the place where it stopped."""
    place = next((_spot(run.toolpath.end, row) for row in np.flatnonzero(run.toolpath.is_motion)[:-2:-1]), None)
    for alarm in run.alarms:
        if alarm.severity == "alarm":
            said = f"the control stops: {alarm.message}{f' ({alarm.hint})' * bool(alarm.hint)}"
            line = alarm.span.line if alarm.span else 0
            causes = tuple(of_alarm(run, alarm.message, line))
            yield Finding(STOPPED, f"alarm {alarm.message}", line, (said,), place, causes)
            place = None


#: What to look at, by the kind of a collision.
LOOK = {
    "rapid": "Which move brings the tool here, and should it be at feed, or higher?",
    "plunge": "How can this tool get into the material: a ramp, a helix, a drilled hole?",
    "solid": "Which tool must have been here before?", "sideways": "Which tool may be fed sideways?",
    "shank": "How deep may this tool cut at once, and how far is its edge from the wall above?",
    "holder": "How far does the tool stand out of its holder here?",
    "fixture": "Where is the clamp, and how high must the tool pass over it?",
    "spindle": "Which block should start the spindle, and in which direction?",
    "insert": "Which flank of the insert meets the part, or is the pass deeper than its edge is long?",
    "travel": "How far does this axis go?", "chuck": "How far are the jaws from Z0?",
    "axis": "What turns about its own axis cuts at X0 alone.",
}  # fmt: skip


OF_TOOL = ("sideways", "shank", "holder", "insert", "axis")  # kinds that another tool would not meet


def of_danger(collisions: Collisions, run: Run, before: int = 0) -> Iterator[Finding]:
    """The collisions, the deepest of a kind in a line; of a still spindle at the block that last spoke of it; then feeds and end.

    What was not judged is no better: a tool that cannot cut, rows without one.
    """
    for each, _ in collisions.by_line:
        line = spindle_line(run, int(run.toolpath.step[each.row - before])) if each.kind == "spindle" else each.line
        steps = (f"{KINDS[each.kind]}", LOOK.get(each.kind, ""), each.message)
        first = "tool" if each.kind in OF_TOOL else None
        causes = tuple(of_row(run, each.row - before, [each.place], first)) if each.row >= before else ()
        yield Finding(DANGER, f"collision {each.kind}", line, tuple(step for step in steps if step), each.place, causes)
    for note in collisions.notes:
        at = re.search(r":(\d+)", note.rpartition("(")[2])  # places stand last, FILE:LINE
        line = first_move(run, run.toolpath.tool == 0) if "without a tool" in note else int(at[1]) if at else 0
        yield Finding(DANGER, f"not judged {note}", line, (note,))
    yield from of_feeds(run)
    yield from at_the_end(run)


MOST_A_TURN = 2.0  # mm of an insert; a mill and a drill bear no more than their radius


def of_feeds(run: Run) -> Iterator[Finding]:
    """The first cut of each tool at a feed a turn at which any edge breaks."""
    path, (tools, numbers) = run.toolpath, run.tools_that_cut
    if run.stock is None:
        return
    inside = cutting_of(run).inside & ((path.end[:, 2] <= path.start[:, 2]) | path.lathe)  # a way up and out may be fast
    rows = np.flatnonzero(inside & ~path.synchronous & (path.spindle > 0))
    a_turn = path.feed[rows] / path.spindle[rows]
    for number in np.unique(numbers[rows]).tolist():
        tool = tools.get(number)
        most = MOST_A_TURN if path.lathe or tool is None else tool.effective_radius
        found = np.flatnonzero((numbers[rows] == number) & (a_turn > most) & (most > 0))
        if len(found):
            told = f"tool {number} breaks at this feed"
            more = f"{told}: {a_turn[found[0]]:.3g} mm a turn; compare F and S with the table"
            yield Finding(DANGER, f"feed of tool {number}", int(path.line[rows[found[0]]]), (told, more))


def at_the_end(run: Run) -> Iterator[Finding]:
    """Radius compensation that is left on."""
    steps = len(run.steps.block)
    if steps and run.history.value("side", steps - 1):
        told = "the program ends with radius compensation on"
        yield Finding(DANGER, "compensation left on", int(run.lines()[-1]), (told, f"{told}: which word ends it, and where?"))


def of_part(difference: Any, run: Run, had: Mapping[Any, bool], before: int) -> Iterator[Finding]:
    """What a comparison found out of its limits, feature by feature in the order of the program; what was not cut, last.

    `had`: the measures (side, feature, name) that the blank has, and whether as drawn: one beside them begins a feature. A zero
    point that is not where the drawing has it is told alone: all else follows from it.
    """
    if off := list(_of_zero(difference)):
        names = [name for name in run.history if name.startswith(("datums ", "presets ", "frame datum"))]
        steps = sorted({step for name in names for step, _ in run.history.changed(name) if step > 0})
        causes = (Cause(int(run.lines()[step]), "the zero point is set in this block", True) for step in steps)
        yield off[0]._replace(causes=tuple(causes))
        return
    named: dict[tuple[str, str], list[Any]] = {}
    begun = set()
    for row in difference.features:
        if row.verdict == "ok" and row.measure != "form" and not had.get((row.side, row.feature, row.measure)):
            begun.add((row.side, row.feature))
        if not row.ok:
            named.setdefault((row.side, row.feature), []).append(row)
    made = [_of_feature(key[1], rows, run, before, key in begun) for key, rows in named.items()]
    yield from sorted(made, key=lambda each: (each.line == 0, each.line))


def _of_zero(difference: Any) -> Iterator[Finding]:
    """Where the blank stands, from the zero of the program, against where the drawing has it."""
    drawn, stands = difference.compared.design.blank, difference.workpiece.cutting.stock.bounds
    if drawn is None:
        return
    off = np.subtract(drawn.bounds, stands)
    moved = np.abs(off[0]) > difference.tolerance
    if not moved.any() or np.abs(off[0] - off[1]).max() > difference.tolerance:  # a blank of another size
        return
    axes, told = np.flatnonzero(moved), "the zero point is not where the drawing has it"
    along = ", ".join("XYZ"[k] for k in axes)
    far = ", ".join(f"{off[0, k]:.3f} mm along {'XYZ'[k]}" for k in axes)
    yield Finding(PART, ZERO, 0, (told, f"{told}: it is off along {along}", f"{told}: it is off by {far}"))


def _of_feature(feature: str, rows: list[Any], run: Run, before: int, begun: bool) -> Finding:
    row = _most_telling(rows)
    there, line = row.place or next((each.place for each in rows if each.place), None), row.line if row.program == 0 else 0
    flat = any("depth" in each.measure and each.actual <= 0 for each in rows)
    partly = begun and flat and not run.toolpath.lathe  # its outline is there, and a place beside it was forgotten
    begun = (begun and not flat) or feature == "profile" or not all(_untouched(each) for each in rows)
    spoilt = feature == "profile" or any(each.measure == "form" and each.deviation < 0 for each in rows)
    lacks = (each.measure for each in rows if each.verdict == "not cut" and "depth" not in each.measure and not spoilt)
    without = next(lacks, "")
    if (not begun and any(each.measure != "form" for each in rows)) or without:
        what = f"something is left{_at(there)}" if partly else "nothing is cut there"
        told = f"{feature}{f', {without}' if begun else ''}: {what}"
        line, near = nearest(run, there, over=True)
        causes = tuple(of_row(run, near, [there])) if near >= 0 else tuple(beside_missing(run, there))
        steps = (told, f"{told}: which block should cut it, and how deep?")
        return Finding(PART, f"{feature} not cut", line, steps, there, causes)
    line, near = _said_by(row, line, run, before), row.row - before
    if not line:
        line, near = nearest(run, there)
    causes = tuple(of_row(run, near, [there, *(each.place for each in rows)], _axis(row, run))) if near >= 0 else ()
    axis = _axis(row, run)
    surface = None if axis is None or there is None else (axis, there[axis] - row.deviation)
    if not line:  # what was made before the answer began is none of its blocks
        causes = () if 0 <= row.row < before else tuple(beside_missing(run, there, surface=surface))
    elif row.deviation > 0:  # something is left: another block may have been to take it
        causes = (*causes[:1], *[*beside_missing(run, there, line, *(cause.line for cause in causes[:1]))][::-1], *causes[1:])
    why = _why(row, run, before, line)
    if row.feature == "blank" or row.measure == "form":
        gone = row.deviation < 0
        what = "too much is cut" if gone else "something is left"
        told = f"{feature}: {what}"
        more = f"{told}: {abs(row.deviation):.3f} mm{_at(there)}"
        return Finding(PART, f"{feature} {what}", line, (told, more, f"{more}; {why}"), there, causes)
    if _drilled(row, run, before) and any(each.measure == "depth" and each.verdict == "not cut" for each in rows):
        told = f"{feature}: it is not as deep as drawn"
        steps = (told, f"{told}: how far below its full diameter is the point?")
        return Finding(PART, f"{feature} depth", line, steps, there, causes)
    its, unit = f"{feature}: its {row.measure} is", "degrees" if "angle" in row.measure else "mm"
    which = f" ({row.nominal:g} {unit} on the drawing)" if row.measure[-1:].isdigit() else ""  # its number is not on it
    told = f"{its} not as drawn{which}"
    sized = told if abs(row.deviation) > FAR else f"{its} {abs(row.deviation):.3f} {unit} too {_way(row)}{which}"
    return Finding(PART, f"{feature} {row.measure}", line, (told, sized, f"{sized}; {why}"), there, causes)


def _untouched(row: Any) -> bool:
    """Whether a measure is that of a feature which nobody has begun."""
    left = row.measure == "form" and row.deviation > 0
    return row.verdict == "not cut" or left or ("depth" in row.measure and not row.actual > 0)


TURNED, MILLED = {"diameter": 0, "length": 2, "z": 2}, {"depth": 2, "x": 0, "y": 1}  # measures along one axis


def _said_by(row: Any, line: int, run: Run, before: int) -> int:
    """The line that said what a measure is: where the cut that made it moves across it, the block before it that did not.

    0 for what was made before the first row of the answer.
    """
    k = row.row - before
    if not line or k < 0:
        return line if row.row < 0 else 0
    if _drilled(row, run, before):
        return line
    return moved_last(run, k, _axis(row, run)) or line


def _axis(row: Any, run: Run) -> int | None:
    """The axis along which a measure lies, None for one of no axis."""
    return (MILLED if np.ptp(run.toolpath.end[:, 1]) else TURNED).get(row.measure.split(" ")[0])


def _drilled(row: Any, run: Run, before: int) -> bool:
    """Whether a drill made it on a lathe, where every measure but its depth is that of the tool."""
    return run.toolpath.lathe and getattr(_tool_of(row, run, before), "kind", "") == "drill"


def _tool_of(row: Any, run: Run, before: int) -> Any:
    (tools, numbers), k = run.tools_that_cut, row.row - before
    return tools.get(int(numbers[k])) if 0 <= k < len(numbers) else None


ORDER = dict(depth=0, x=1, y=2, length=3, width=4, diameter=5)  # measures that say more than "form" does


FAR = 1e3  # mm: a radius that is further off is read off a straight line


def _most_telling(rows: list[Any]) -> Any:
    """The row to begin with: one whose line is known, a measure rather than the form, if it is not far less off than that."""
    form = max((abs(row.deviation) for row in rows if row.measure == "form"), default=0.0)
    return min(rows, key=lambda row: (row.line == 0, math.isnan(row.deviation), abs(row.deviation) < form / 10,
                                      row.measure == "form", ORDER.get(row.measure, len(ORDER))))  # fmt: skip


def _way(row: Any) -> str:
    more = row.deviation > 0
    if row.measure in ("x", "y", "z"):
        return f"far to {'+' if more else '-'}{row.measure.upper()}"
    if "depth" in row.measure:
        return "deep" if more else "shallow"
    return "large" if more else "small"




def _at(place: Place | None) -> str:
    return f" near X{place[0]:.1f} Y{place[1]:.1f}" if place else ""


CALLS = re.compile(r"CYCL CALL|M[89]9\b", re.IGNORECASE)
BLOCKS = "the words of this block, and where the one before it ends,"


def _why(row: Any, run: Run, before: int, line: int) -> str:
    """What a deviation of a certain size usually comes from, else what to compare."""
    tool, off = _tool_of(row, run, before), abs(row.deviation)
    if tool is not None and tool.radius > 0 and tool.kind != "drill" and row.measure not in ("x", "y", "depth"):
        for times, said in ((1, "the radius"), (2, "the diameter"), (4, "twice the diameter")):
            if math.isclose(off, times * tool.radius, abs_tol=0.01):
                return f"that is {said} of the tool: on which side of the contour does it run?"
    if tool is not None and tool.kind == "drill" and tool.angle and row.measure == "depth":
        if math.isclose(off, tool.radius / math.tan(math.radians(tool.angle) / 2), abs_tol=0.01):
            return "that is the height of the point: how far down does the full diameter go?"
    block = run.program.text.splitlines()[line - 1] if line else ""
    return f"compare {'the cycle and the contour that it mills' if CALLS.search(block) else BLOCKS} with the drawing"


def of_threads(design: Any, run: Run, tolerance: float) -> Iterator[Finding]:
    """The passes of a turned part's threads that have another pitch than drawn, or miss the groove of the deepest one; its
    depth."""
    path, start = run.toolpath, run.toolpath.start
    for name, thread in zip(design.drawn_names(), design.features) if hasattr(design, "profile") else ():
        if thread.kind != "thread" or (found := passes_of(path, thread)) is None:
            continue  # said by its measures
        own = tuple(Cause(int(path.line[row]), f"{name}: this pass is the {said}", True)
                    for row, said in ((found.deepest, "deepest"), (found.rows[-1], "last")))  # fmt: skip
        for row, pitch in zip(found.rows, found.pitch):
            if abs(pitch - thread.pitch) > EXACT:
                told = f"{name}: its pitch is not as drawn"
                yield Finding(PART, f"{name} pitch", int(path.line[row]), (told, f"{told}: {pitch:g} mm"), _spot(start, row))
        begins = tuple(Cause(_line_of_z(path, row), f"{name}: the {said} pass begins at the Z of this block", True)
                       for row, said in ((found.deepest, "deepest"), (found.rows[-1], "last")))  # fmt: skip
        for row in found.rows[found.beside > 0]:
            told, line = f"{name}: a pass does not run in the groove of the others", _line_of_z(path, row)
            steps = (told, f"{told}: where along Z does it begin?")
            yield Finding(PART, f"{name} begins", line, steps, _spot(start, row), begins)
        if abs(shallow := found.shallow(thread)) > tolerance:
            told, row = f"{name}: its depth is not as drawn", found.deepest
            sized = f"{name}: its depth is {abs(shallow):.3f} mm too {'shallow' if shallow > 0 else 'deep'}"
            yield Finding(PART, f"{name} depth", int(path.line[row]), (told, sized), _spot(start, row), own)


def _line_of_z(path: Any, row: int) -> int:
    """The line of the move along Z that brought the tool where a row begins."""
    moved = np.flatnonzero(path.start[:row, 2] != path.end[:row, 2])
    return int(path.line[moved[-1] if len(moved) else row])


def _spot(ends: Any, row: int) -> Place:
    x, y, z = ends[row].tolist()
    return x, y, z
