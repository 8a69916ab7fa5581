"""Grading: an answer is run on the machine of its exercise, its part is measured, and what was asked for is looked for.

A whole run is the least: one that stops, a blank that nobody touched and a tool that cannot cut earn nothing, and what
collides earns nothing either. The part is marked as a measuring room marks it: each feature by the share of its measures that are
within their limits. A measure that the blank had already earns nothing by itself, and what is cut away elsewhere costs.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np

from mnclab.learning.answered import run_of
from mnclab.learning.asked import economy, of_asked, unwritten, wishes
from mnclab.learning.exercise import Exercise
from mnclab.learning.findings import PART, STOPPED, ZERO, Finding, hints_of, of_alarms, of_danger, of_part, of_threads
from mnclab.learning.grade import Grade
from mnclab.learning.restarting import before_of, collisions_of, part_of
from mnclab.runs.causes import Cause
from mnclab.runs.run import Run
from mnclab.text.alarm import Alarm
from mnclab.text.file import decode, read
from mnclab.text.given import shown

MOST_BYTES = 1_000_000
TIMED = ("quicker", "restart")  # time is what is asked for, or shows that what was done is done again
ECONOMY_FROM = 3  # the level


def text_of(answer: Any) -> str:
    """The text of an answer: a text, a file, its bytes, or a run; an Alarm for anything else."""
    if isinstance(answer, Run):
        return answer.program.text
    if isinstance(answer, Path):
        answer = read(answer, answer, MOST_BYTES)
    if isinstance(answer, bytes):
        answer = decode(answer)[0]
    if not isinstance(answer, str):
        raise Alarm(f"an answer is a text, a path or a run, got {shown(answer)}")
    return answer.replace("\r\n", "\n").replace("\r", "\n").rstrip("\0\x1a")  # the end of a file, as DOS marks and fills it


def graded(exercise: Exercise, answer: Any, tried: Mapping[str, int]) -> Grade:
    """The grade of an answer."""
    text = text_of(answer)
    try:
        if len(text) > MOST_BYTES:
            raise Alarm(f"the answer has more than {MOST_BYTES // 1_000_000} MB")
        if not text.strip():
            raise Alarm("the answer is empty")
        if exercise.answer == "numbers":
            from mnclab.learning.predicting import predicted

            return predicted(exercise, text, tried)
        if exercise.answer == "strategy":
            from mnclab.learning.pocketing import cleared

            return cleared(exercise, text, tried)
        return of_run(exercise, run_of(exercise, text), tried, text)
    except Alarm as alarm:
        line = alarm.span.line if alarm.span else 0
        said = alarm.message + (f" ({alarm.hint})" if alarm.hint else "")
        return nothing(exercise, [Finding(STOPPED, f"alarm {alarm.message}", line, (said,))], tried)


def nothing(exercise: Exercise, findings: list[Finding], tried: Mapping[str, int], run: Run | None = None) -> Grade:
    """The grade of what earns nothing."""
    hints, faults = hints_of(findings, tried)
    return Grade(exercise.id, 0.0, False, dict.fromkeys(headings(exercise), 0.0), hints, faults, run=run)


TABLES = ("[datums", "[presets", "[correctors", "[tools")  # in the order in which they are looked at


def beside(exercise: Exercise, findings: list[Finding], run: Run, text: str) -> list[Finding]:
    """Findings of a run: where tables are the answer, at the table they come from; their own line is that of the program."""
    if exercise.answer != "setup":
        return findings
    rows = [row.strip() for row in text.split("\n")]
    tables = [(k, row) for head in TABLES for k, row in enumerate(rows, 1) if row.startswith(head)]
    causes = [Cause(k, f"a number below {row}?") for k, row in tables]
    return [each._replace(line=_table(text, each, run), causes=(*_datum_of(each, run, rows), *causes),
                          steps=tuple(step + f" (line {each.line} of the program)" * bool(each.line) for step in each.steps))
            for each in findings]  # fmt: skip


def _datum_of(finding: Finding, run: Run, rows: list[str]) -> Iterator[Cause]:
    """The row of the work offsets that holds where a fault was cut; all of them where nothing was."""
    head = rows.index("[datums]") if "[datums]" in rows else len(rows)
    end = next((k for k in range(head + 1, len(rows)) if rows[k].startswith("[")), len(rows))
    numbered = {name: k for k, row in enumerate(rows[head:end], head + 1) if (name := row.partition("=")[0].strip()).isdigit()}
    cut = (run.toolpath.line == finding.line) & (run.toolpath.program == 0)  # a line of a program that is called is another
    held = run.at(line=finding.line).state.get("datum row") if cut.any() else None
    known = {name: k for name, k in numbered.items() if held is None or int(name) == held}
    if known:
        told = f"{'row' if len(known) == 1 else 'rows'} {' and '.join(known)} of [datums]: are X, Y and Z right?"
        yield Cause(min(known.values()), told, True)


def _table(text: str, finding: Finding, run: Run) -> int:
    """The line at which a table of an answer begins: that of the zero points, or of the tool that was at work; else 0."""
    rows = np.flatnonzero((run.toolpath.line == finding.line) & (run.toolpath.program == 0))
    tool = run.tools_that_cut[1][rows[0]] if len(rows) else ""
    heads = ("[datums]", "[presets]") if finding.kind == ZERO else (f"[tools.{tool}]", f"[correctors.{tool}]")
    return next((k for k, row in enumerate(text.split("\n"), 1) if row.strip().startswith(heads)), 0)


def headings(exercise: Exercise) -> list[str]:
    """The headings that count, in their order."""
    asked, economic = exercise.asked, exercise.level >= ECONOMY_FROM
    wanted = asked.must or asked.must_not or asked.values or asked.cutting or asked.cabinet or (asked.blocks and not economic)
    counted = {
        "part": exercise.design is not None,
        "safety": exercise.answer in ("program", "setup"),
        "asked": bool(wanted) or exercise.answer == "numbers" or bool(asked.strategy),
        "economy": economic and bool(asked.time or asked.length),
    }
    return [name for name, counts in counted.items() if counts]


def of_run(exercise: Exercise, run: Run, tried: Mapping[str, int], text: str = "") -> Grade:
    """The grade of a run, which a `text` asked for."""
    findings = list(of_alarms(run))
    if findings or run.reach or run.halt is not None:
        stopped = findings or [Finding(STOPPED, "stopped", 0, ("the program stops before its end",))]
        stopped += unwritten(exercise, run)
        return nothing(exercise, beside(exercise, stopped, run, text), tried, run)
    if not run.toolpath.is_motion.any():
        told = "the program moves nothing"
        return nothing(exercise, [Finding(STOPPED, told, 0, (told,))], tried, run)
    difference, untouched, threads = None, {}, []
    before = len(before_of(exercise)) if exercise.until is not None else 0
    if exercise.design is not None:
        difference = part_of(exercise, run).compare(exercise.design, exercise.tolerance)
        untouched = blank_as_drawn(exercise)
        threads = list(of_threads(exercise.design, run, exercise.tolerance))
        findings += [*threads, *of_diameters(exercise, run, difference), *of_part(difference, run, untouched, before)]
    danger = list(of_danger(collisions_of(exercise, run), run, before))
    asked = list(of_asked(exercise, run))
    findings += danger + asked
    marks = {"safety": 0.0 if danger else 1.0}
    if difference is not None:
        lost = len({each.kind for each in threads}) / (1 + len(exercise.design.features))
        marks["part"] = max(0.0, part_mark(difference, untouched) - lost)
    wanted = wishes(exercise)
    marks["asked"] = 1 - len({each.kind for each in asked}) / wanted if wanted else 1.0
    marks["economy"], slow = economy(exercise, run)
    marks["economy"] *= marks.get("part", 1.0)  # half a part is made quickly
    whole = difference is None or (not threads and all(row.ok for row in difference.features))
    if whole and not danger:
        findings += slow
    points = {name: float(marks.get(name, 0.0)) for name in headings(exercise)}
    earned = not danger and points.get("part", 1.0) > 0
    remarks = (Cause(each.span.line, each.message, True) for each in run.alarms
               if each.span and not each.span.program and "the manual" not in each.message)  # which has no such word
    hints, faults = hints_of(beside(exercise, findings, run, text), tried, remarks if exercise.answer == "program" else ())
    measures = difference.features if difference is not None else None
    passed = earned and whole and not asked and not (slow and exercise.kind in TIMED)
    marked = min(earned * score(exercise, points), 1.0 if passed else 0.99)  # what lacks something is not 100 %
    return Grade(exercise.id, marked, passed, points, hints, faults, measures, difference, run)


def of_diameters(exercise: Exercise, run: Run, difference: Any) -> Iterator[Finding]:
    """The commonest slip at a lathe whose X is a radius: the numbers of the drawing, which are diameters."""
    known = {each.name for each in run.control.settings}
    if "diameter" not in known or run.setup.settings.get("diameter") or all(row.ok for row in difference.features):
        return
    meant = run.again(run.setup.with_settings(diameter=True))
    if meant.ok and all(row.ok for row in part_of(exercise, meant).compare(exercise.design, exercise.tolerance).features):
        yield Finding(PART, "diameters", 0, ("X is a radius here, and this program writes diameters",))


def score(exercise: Exercise, points: Mapping[str, float]) -> float:
    """The marks by the weights of their headings; safety has none: what is not safe earns nothing."""
    weights = {name: exercise.weights[name] for name in points if name in exercise.weights}
    total = sum(weights.values())
    return sum(weights[name] * points[name] for name in weights) / total if total else float(all(points.values()))


@cache
def blank_as_drawn(exercise: Exercise) -> dict[tuple[str, str, str], bool]:
    """The measures (side, feature, name) of the drawing that are there before the answer cuts, and whether they are as drawn."""
    from mnclab.workpiece.cutting import Cutting
    from mnclab.workpiece.milling.milled import Milled
    from mnclab.workpiece.turning.turned import Turned

    stock = exercise.design.blank if exercise.design.blank is not None else exercise.setup.stock
    lathe = hasattr(exercise.design, "profile")
    before = Cutting.of_nothing(stock, lathe) if exercise.until is None else before_of(exercise)
    part = (Turned if lathe else Milled)(before)
    return {row[:3]: row.ok for row in found_of(part.compare(exercise.design, exercise.tolerance))}


def found_of(difference: Any) -> Iterator[Any]:
    """The measures of which something is known: what was not measured is neither made nor spoilt."""
    return (row for row in difference.features if row.verdict in ("ok", "out", "not cut"))


def part_mark(difference: Any, untouched: Mapping[tuple[str, str, str], bool]) -> float:
    """The mean of the features' marks: the share of the measures to be made that are within their limits, less what the blank
    had and the program spoilt."""
    made: dict[tuple[str, str], list[bool]] = {}
    had: dict[tuple[str, str], list[bool]] = {}
    for row in found_of(difference):
        (had if untouched.get(row[:3], False) else made).setdefault(row[:2], []).append(row.ok)
    spoilt = sum(1 - float(np.mean(each)) for each in had.values())
    if not made:
        return float(not spoilt)
    return float(max(0.0, (sum(map(np.mean, made.values())) - spoilt) / len(made)))
