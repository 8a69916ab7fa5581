"""Milling a stud step by step: down beside the stock, up to the passes on an arc, round, off them, back; level by level.

x and y count from the middle of the stud. Lengths in mm, feeds in mm/min.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from typing import NamedTuple

from mnclab.machining.milling.clearing import Clearing, begin, end, numbered
from mnclab.machining.milling.finishing import LEAST, onto, outwards
from mnclab.machining.milling.pocket_steps import Feeds, Work
from mnclab.machining.steps import Along, Go, Step


class Stud(NamedTuple):
    """The shape of a stud for one tool, which goes down at `start`, in the clear, and comes back there from every level.

    `clearing` gives the passes for an allowance, from the blank inwards or along the stud alone. The tool leaves the last
    one on a half circle that leads it `off` to the side, or to the start; then it goes back on the level, or at the height
    `high`, from which it comes down to the clearance level at rapid.
    """

    clearing: Callable[[float, bool], Clearing]
    start: tuple[float, float]
    off: float | None = None
    high: float | None = None


def mill_stud(stud: Stud, work: Work) -> Iterator[Step]:
    """Roughing in layers, the side in infeeds, the floor at once, each where it has levels."""
    roughing, finishing, last = work.feeds
    for name, levels, allowance, blank, feeds in (
        ("layer", work.layers, work.allowance, True, roughing),
        ("side finishing", work.walls, 0.0, False, finishing),
        ("floor finishing", work.floor, min(work.allowance, 0.0), True, last),
    ):
        if not levels:
            continue
        passes = stud.clearing(allowance, blank)
        yield Go(f"{name}, to the clearance level", work.above)
        for k, (label, level) in enumerate(zip(numbered(name, len(levels)), levels, strict=True)):
            if k and stud.high is not None:
                yield Go(f"{label}, to the clearance level", work.above)
            yield Go(f"{label}, down", level, feeds.plunge)
            yield from _round(label, stud, passes, feeds, work.side)
            if stud.high is not None:
                yield Go(f"{label}, lift", stud.high)
            yield Go(f"{label}, back to the start", x=stud.start[0], y=stud.start[1])


def _round(name: str, stud: Stud, passes: Clearing, feeds: Feeds, side: int) -> Iterator[Step]:
    """Up to the passes, along them and off the last one; the stud is on their right for `side` 1."""
    first, last = passes.passes[0], passes.passes[-1]
    if (way := onto(stud.start, first)) is not None:
        yield Along(f"{name}, approach", way, feeds.level)
    for label, contour in zip(passes.labels, passes.passes, strict=True):
        yield Go(f"{name}, link", None, feeds.level, *begin(contour).tolist())
        yield Along(f"{name}, {label}", contour, feeds.level)
    away = math.dist(stud.start, end(last)) if stud.off is None else stud.off
    if away > LEAST:
        yield Along(f"{name}, departure", outwards(last, away, side), feeds.level)
