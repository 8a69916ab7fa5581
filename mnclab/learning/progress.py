"""What a learner has done: `progress.json` beside the notebooks, and a map of the course that it colours."""

from __future__ import annotations

import json
from collections import Counter
from collections.abc import Mapping
from contextlib import suppress
from functools import cache
from html import escape
from pathlib import Path
from typing import Any

from mnclab.learning.exercise import LESSONS, exercises, files
from mnclab.learning.grade import Grade
from mnclab.text.alarm import Alarm
from mnclab.text.file import read, replaced
from mnclab.text.given import fitting

FILE = "progress.json"
LARGEST = 10_000_000


class Progress:
    """The best score and the tries of each exercise, kept in a file; a new one where there is none, or none that can be read.

    `done[id]` has `score`, `passed`, `tries` and `faults`, how often each was made.
    """

    def __init__(self, path: str | Path = FILE) -> None:
        self.path = Path(path)
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
        passed = sum(each["passed"] for each in self.done.values())
        return f"<Progress: {passed} of {len(files())} exercises passed, {len(self.done)} tried>"

    def _repr_html_(self) -> str:
        """The map of the course: lessons, and their exercises as they stand."""
        lessons: dict[str, list[str]] = {}
        for each in exercises():
            found = self.done.get(each.id)
            state = "passed" if found and found["passed"] else "tried" if found else "open"
            mark = {"passed": "✓", "tried": f"{found['score']:.0%}" if found else "", "open": "○"}[state]
            colour = {"passed": "#d3f0da", "tried": "#fdebc8", "open": "#f1f1ef"}[state]
            box = f"display:inline-block;margin:2px;padding:1px 6px;border-radius:4px;background:{colour};color:#222"
            what = f'<span style="{box}" title="{escape(each.title)}">{escape(each.id)} {mark}</span>'
            lessons.setdefault(each.lesson, []).append(what)
        left, rows = '<td style="text-align:left">', ""
        for lesson, some in sorted(lessons.items()):
            rows += f"<tr>{left}{escape(lesson)}</td>{left}{escape(_title(lesson))}</td>{left}{''.join(some)}</td></tr>"
        signs = "✓ passed, % the best try so far, ○ not tried; mnc.exercise(&quot;mnc-07&quot;).editor() opens one"
        return f'<div class="mnclab-map"><p>{escape(repr(self)[1:-1])} ({signs})</p><table>{rows}</table></div>'


@cache
def _title(lesson: str) -> str:
    """The first heading of a lesson, where the notebooks are there."""
    for path in LESSONS.glob(f"{lesson}_*.ipynb"):
        with suppress(OSError, ValueError, LookupError, TypeError):
            first = "".join(json.loads(path.read_text("utf-8"))["cells"][0]["source"])
            return first.partition("\n")[0].lstrip("# ")
    return ""


def _is_record(found: Any) -> bool:
    kinds = {"score": int | float, "passed": bool, "tries": int, "faults": dict}
    if not (isinstance(found, dict) and all(isinstance(found.get(name), kind) for name, kind in kinds.items())):
        return False
    counts = [found["tries"], *found["faults"].values()]
    return 0 <= found["score"] <= 1 and all(isinstance(each, int) and 0 <= each < LARGEST for each in counts)


@fitting
def progress(path: str | Path = FILE) -> Progress:
    """What was done so far: the map of the course. Deleting the file begins anew."""
    return Progress(path)
