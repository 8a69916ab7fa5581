"""Facing between walls step by step: over every level, and then along the walls. Lengths in mm, feeds in mm/min.

Each level ends with a lift and the way back to its start outside.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import NamedTuple

from mnclab.controls.tnc_620.machining.between_walls import Line, Place
from mnclab.geometry.contours import Contour
from mnclab.machining.milling.clearing import begin, numbered
from mnclab.machining.milling.finishing import onto
from mnclab.machining.steps import RAPID, Along, Go, Step


class Level(NamedTuple):
    """One level: where it is, what stood above it, and the feed along lines and wherever material may be."""

    name: str
    level: float
    top: float
    feed: float


class Passes(NamedTuple):
    """What is run on a level from its `start`: lines, to and fro or one way, and along `walls` what lines leave; or a spiral.

    `outside`: the start lies in the clear.
    """

    start: Place
    outside: bool
    lines: tuple[Line, ...] = ()
    one_way: bool = False
    walls: tuple[Contour, ...] = ()
    spiral: Contour | None = None

    def scrapes(self, levels: Sequence[Level], lift: float) -> float:
        """How far a line that still stands reaches above the rapid way back over it, mm; 0 where none does."""
        if not self.one_way or not any(line.begins_outside for line in self.lines[1:]):
            return 0.0
        return max(0.0, max((abs(each.top - each.level) for each in levels), default=0.0) - lift)


def face_levels(passes: Passes, levels: Sequence[Level], lift: float, position: float) -> Iterator[Step]:
    """Every level; `lift` is the way up after it, `position` the feed through the air at depth."""
    for k, at in enumerate(levels):
        yield Go(f"{at.name}, down", at.level, position if k and passes.outside else at.feed)
        if passes.spiral is None:
            yield from _over_lines(passes, at, lift, position)
        else:
            if (arc := onto(passes.start, passes.spiral)) is not None:
                yield Along(f"{at.name}, approach", arc, at.feed)
            yield Along(f"{at.name}, spiral", passes.spiral, at.feed)
        for label, way in zip(numbered("along the walls", len(passes.walls)), passes.walls, strict=True):
            yield Go(f"{at.name}, link", None, at.feed, *begin(way).tolist())
            yield Along(f"{at.name}, {label}", way, at.feed)
        yield Go(f"{at.name}, lift", at.level + lift)
        yield Go(f"{at.name}, back to the start", x=passes.start[0], y=passes.start[1])


def _over_lines(passes: Passes, at: Level, lift: float, position: float) -> Iterator[Step]:
    """From the first line over all of them; one way, with a lift and straight back, over all that stands to a wall."""
    before = None
    for label, line in zip(numbered("line", len(passes.lines)), passes.lines, strict=True):
        if before and passes.one_way:
            yield Go(f"{at.name}, lift", (at.level if line.begins_outside else at.top) + lift)
            yield Go(f"{at.name}, back", None, RAPID, *line.begin)
            yield Go(f"{at.name}, down", at.level, position if line.begins_outside else at.feed)
        elif before:
            clear = before.ends_outside and line.begins_outside
            yield Go(f"{at.name}, link", None, position if clear else at.feed, *line.begin)
        yield Along(f"{at.name}, {label}", Contour([line.begin, line.end], closed=False), at.feed)
        before = line


def finish_along(
    ways: Sequence[Contour], levels: Sequence[float], above: float, feed: float, position: float
) -> Iterator[Step]:
    """Each way on every level, from outside to outside; between them the tool goes at the clearance level."""
    for which, way in zip(numbered("side finishing", len(ways)), ways, strict=True):
        for label, level in zip(numbered("infeed", len(levels)), levels, strict=True):
            name = f"{which}, {label}"
            yield Go(f"{name}, to the clearance level", above)
            yield Go(f"{name}, over the start", None, RAPID, *begin(way).tolist())
            yield Go(f"{name}, down", level, position)
            yield Along(name, way, feed)
    if ways:
        yield Go("side finishing, lift", above)
