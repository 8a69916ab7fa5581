"""One warning for one cause, however many blocks have it: the first place, and how many more."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING

from mnclab.text.alarm import PLACES, WARNING, Alarm, Span

if TYPE_CHECKING:
    from mnclab.runs.run import Run


def word_span(run: Run, step: int, *words: str) -> Span | None:
    """The first of some words ("G41"), or of an address ("F"), in the block of a step; None, where it has none of them."""
    which, block = int(run.steps.program[step]), int(run.steps.block[step])
    found = (word.span for word in run.programs[which][block].words if str(word) in words or word.address in words)
    return next((span._replace(program=which) for span in found), None)


def span_of(run: Run, step: int, *words: str) -> Span:
    """The first of some words in the block of a step, or else the block."""
    which, block = int(run.steps.program[step]), int(run.steps.block[step])
    return word_span(run, step, *words) or run.programs[which].span_of_block(block)._replace(program=which)


def warn_once(run: Run, steps: Iterable[int], message: str, hint: str, *words: str) -> Alarm:
    """The warning at the first of some steps; further blocks, however often they are executed, are counted with it."""
    first = {(int(run.steps.program[step]), int(run.steps.block[step])): step for step in reversed([*steps])}
    places = [span_of(run, step, *words) for step in sorted(first.values())[:PLACES]]
    return Alarm(message, places[0], WARNING, hint).changed(count=len(first), places=tuple(places))
