"""Milling a stud step by step: down beside the stock, up to the passes on an arc, round, off them, back; level by level.

x and y count from the middle of the stud; `start` is where the tool goes down, in the clear. Lengths in mm, feeds in mm/min.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import NamedTuple

from mnclab.machining.milling.clearing import Clearing, begin, end, numbered
from mnclab.machining.milling.finishing import LEAST, onto, outwards
from mnclab.machining.milling.pocket_steps import Feeds
from mnclab.machining.steps import Along, Go, Step


class Lifting(NamedTuple):
    """The tool goes back to the start at a height, and comes down from there to the clearance level, at rapid."""

    high: float
    above: float


def mill_stud(
    name: str, passes: Clearing, levels: Sequence[float], start: tuple[float, float], feeds: Feeds, *, side: int,
    off: float | None = None, lifting: Lifting | None = None,
) -> Iterator[Step]:  # fmt: skip
    """Every level from the start and back to it; the stud is on the right of the passes for `side` 1.

    The tool leaves the last pass on a half circle that leads it `off` to the side, or to the start. Without `lifting` it
    goes back there on the level.
    """
    x, y = start
    for k, (label, level) in enumerate(zip(numbered(name, len(levels)), levels, strict=True)):
        if k and lifting:
            yield Go(f"{label}, to the clearance level", lifting.above)
        yield Go(f"{label}, down", level, feeds.plunge)
        first = passes.passes[0]
        way = onto(start, first)
        if way is None:
            yield Go(f"{label}, approach", None, feeds.level, *begin(first).tolist())
        else:
            yield Along(f"{label}, approach", way, feeds.level)
        for part, contour in zip(passes.labels, passes.passes, strict=True):
            yield Go(f"{label}, link", None, feeds.level, *begin(contour).tolist())
            yield Along(f"{label}, {part}", contour, feeds.level)
        last = passes.passes[-1]
        away = math.dist(start, end(last)) if off is None else off
        if away > LEAST:
            yield Along(f"{label}, departure", outwards(last, away, side), feeds.level)
        if lifting:
            yield Go(f"{label}, lift", lifting.high)
        yield Go(f"{label}, back to the start", x=x, y=y)
