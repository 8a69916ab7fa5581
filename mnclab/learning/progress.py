"""What a learner has done: `progress.json` beside the notebooks, what it colours: a map of the course, or a plan of a term."""

from __future__ import annotations

import json
import re
from collections import Counter
from collections.abc import Iterator, Mapping
from contextlib import suppress
from html import escape
from pathlib import Path
from typing import Any, NamedTuple

from mnclab.learning.exercise import LESSONS, Exercise, exercise, exercises, files
from mnclab.learning.grade import Grade
from mnclab.text.alarm import Alarm
from mnclab.text.file import read, replaced
from mnclab.text.given import choice, fitting

FILE = "progress.json"
LARGEST = 10_000_000


class Row(NamedTuple):
    """A double lesson of a plan: its week, the lessons it takes, what is done in class, and the exercises."""

    week: str
    lesson: str
    what: str
    exercises: tuple[str, ...]


class Progress:
    """The best score and the tries of each exercise, kept in a file; a new one where there is none, or none that can be read.

    `done[id]` has `score`, `passed`, `tries` and `faults`, how often each was made. `plan` has the rows of a plan that is named.
    """

    def __init__(self, path: str | Path = FILE, plan: str | None = None) -> None:
        self.path, self.plan = Path(path), () if plan is None else tuple(_rows(plan))
        try:
            found = json.loads(read(self.path, self.path, LARGEST)) if self.path.exists() else {}
        except (Alarm, ValueError, RecursionError):
            found = {}
        self.done: dict[str, dict[str, Any]] = {
            name: each for name, each in (found.items() if isinstance(found, dict) else ()) if _is_record(each)
        }

    def tried(self, name: str) -> Mapping[str, int]:
        """How often each fault was made in an exercise, as `Exercise.check` takes it."""
        return self.done.get(name, {}).get("faults", {})

    def record(self, grade: Grade) -> None:
        """Keep a grade: the best score stays, tries and faults count."""
        before = self.done.get(grade.exercise, {"score": 0.0, "passed": False, "tries": 0, "faults": {}})
        self.done[grade.exercise] = {
            "score": max(before["score"], round(grade.score, 4)),
            "passed": before["passed"] or grade.passed,
            "tries": before["tries"] + 1,
            "faults": dict(Counter(before["faults"]) + Counter(grade.faults)),
        }
        with replaced(self.path) as beside:
            beside.write_text(json.dumps(self.done, indent=1, ensure_ascii=False), encoding="utf-8")

    def __repr__(self) -> str:
        own = {name for row in self.plan for name in row.exercises} or set(files())
        passed = sum(self._passed(name) for name in own)
        return f"<Progress: {passed} of {len(own)} exercises passed, {len(own & set(self.done))} tried{self._next()}>"

    def _passed(self, name: str) -> bool:
        return bool(self.done.get(name, {}).get("passed"))

    def _next(self) -> str:
        """What comes next in the plan: the first exercise that is not passed."""
        left = ((row.week, name) for row in self.plan for name in row.exercises if not self._passed(name))
        week, name = next(left, ("", ""))
        done = "; the plan is done" if self.plan else ""
        return f"; next: week {week}, lesson {exercise(name).lesson}, {name}" if name else done

    def _repr_html_(self) -> str:
        """The map of the course, or the weeks of the plan: lessons, and their exercises as they stand."""
        left = '<td style="text-align:left">'
        heads = ("week", "lesson", "in class", "exercises") if self.plan else ("", "lesson", "exercises")
        rows = f"<tr>{''.join(f'{left}<strong>{head}</strong></td>' for head in heads)}</tr>"
        table = [tuple(map(escape, row[:3])) + (map(exercise, row.exercises),) for row in self.plan] or self._map()
        for *told, some in table:
            rows += f"<tr>{''.join(f'{left}{each}</td>' for each in told)}{left}{''.join(map(self._box, some))}</td></tr>"
        signs = "✓ passed, % the best try so far, ○ not tried; mnc.exercise(&quot;mnc-07&quot;).editor() opens one"
        return f'<div class="mnclab-map"><p>{escape(repr(self)[1:-1])} ({signs})</p><table>{rows}</table></div>'

    def _map(self) -> list[tuple[Any, ...]]:
        """The lessons, as the map of the course has them, those it does not have last: number, title, exercises."""
        way = dict(re.findall(r"\]\((\d\d)_[^)]*\) ([^|]*) \|", _text(LESSONS / "README.md")))
        lessons: dict[str, list[Exercise]] = {lesson: [] for lesson in way}
        for each in exercises():
            lessons.setdefault(each.lesson, []).append(each)
        return [(escape(lesson), escape(way.get(lesson, "")), some) for lesson, some in lessons.items() if some]

    def _box(self, each: Exercise) -> str:
        found = self.done.get(each.id)
        mark, colour = (f"{found['score']:.0%}", "#fdebc8") if found else ("○", "#f1f1ef")
        mark, colour = ("✓", "#d3f0da") if self._passed(each.id) else (mark, colour)
        box = f"display:inline-block;margin:2px;padding:1px 6px;border-radius:4px;background:{colour};color:#222"
        return f'<span style="{box}" title="{escape(each.title)}">{escape(each.id)} {mark}</span>'


def _rows(plan: str) -> Iterator[Row]:
    """The double lessons of a plan, as its table has them; an Alarm names the plans that there are."""
    known = {path.stem: path for path in sorted((LESSONS / "plans").glob("*_*.md"))}
    if not known:
        raise Alarm("the plans are not here: they lie in notebooks/plans")
    week = ""
    for line in filter(re.compile(r"\| (\d+ )?\| ").match, _text(known[choice(plan, "plan", known)]).splitlines()):
        number, lesson, what, given = (each.strip() for each in line.split("|")[1:5])
        week = number or week
        lesson, what = (re.sub(r"\[([^][]*)\]\([^()]*\)|[*`]", r"\1", each) for each in (lesson, what))
        yield Row(week, lesson, what, tuple(name for name in re.findall(r"`([^`]*)`", given) if name in files()))


def _text(path: Path) -> str:
    with suppress(OSError, ValueError):
        return path.read_text("utf-8")
    return ""


def _is_record(found: Any) -> bool:
    kinds = {"score": int | float, "passed": bool, "tries": int, "faults": dict}
    if not (isinstance(found, dict) and all(isinstance(found.get(name), kind) for name, kind in kinds.items())):
        return False
    counts = [found["tries"], *found["faults"].values()]
    return 0 <= found["score"] <= 1 and all(isinstance(each, int) and 0 <= each < LARGEST for each in counts)


@fitting
def progress(path: str | Path = FILE, plan: str | None = None) -> Progress:
    """What was done so far: the map of the course, or with `plan="mnc_mill"` that plan of a term, and what comes next in it.
    Deleting the file begins anew.

    >>> len(mnc.progress("a file that is not there yet.json").done)
    0
    """
    return Progress(path, plan)
