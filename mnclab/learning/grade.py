"""A grade: the mark by headings, whether it is passed, and what to do next."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, NamedTuple

from mnclab.runs.run import Run
from mnclab.text.alarm import Alarm

HINTS = 3  # at most


class Hint(NamedTuple):
    """The next smaller step: `line` of the answer (0: no line of it), a sentence, and the `place` (x, y, z) mm on the drawing."""

    line: int
    text: str
    place: tuple[float, float, float] | None = None

    def __str__(self) -> str:
        return f"line {self.line}: {self.text}" if self.line else self.text


@dataclass(frozen=True, eq=False)
class Grade:
    """What an answer is worth.

    `score` is 0 to 1; `points` by heading, each 0 to 1 ("part", "safety", "asked", "economy" as far as they count).
    `passed`: the whole part is within its tolerances, nothing collides, and all that was asked for is there. `hints` are at
    most three, the most important first; `faults` are the kinds of what was found, as `tried` of `check` counts them.
    `measures` is the table of the measuring room, `run` the run, None where there was none.
    """

    exercise: str
    score: float
    passed: bool
    points: Mapping[str, float]
    hints: tuple[Hint, ...] = ()
    faults: tuple[str, ...] = ()
    measures: Any = None
    difference: Any = None
    run: Run | None = None

    @property
    def verdict(self) -> str:
        """In a word: "passed" or "not yet"."""
        return "passed" if self.passed else "not yet"

    def as_dict(self) -> dict[str, Any]:
        """For JSON: exercise, score, passed, points, hints and faults."""
        hints = [hint._asdict() for hint in self.hints]
        named = {"exercise": self.exercise, "score": self.score, "passed": self.passed}
        return named | {"points": dict(self.points), "hints": hints, "faults": list(self.faults)}

    def rows(self) -> list[tuple[str, str]]:
        """The headings and their marks."""
        return [(name, f"{value:.0%}") for name, value in self.points.items()]

    def plot(self, **options: Any) -> Any:
        """Where part and drawing differ, see `Difference.plot`; the path where there is no part to compare."""
        what = self.difference if self.difference is not None else self.run
        if what is None:
            raise Alarm("nothing was run that could be drawn")
        return what.plot(**options)

    def __repr__(self) -> str:
        head = f"{self.exercise}: {self.verdict}, {self.score:.0%}"
        return "\n".join([head, *(f"  {name} {mark}" for name, mark in self.rows()), *(f"  → {hint}" for hint in self.hints)])

    def _repr_html_(self) -> str:
        from mnclab.learning.card import grade_card

        return grade_card(self)

