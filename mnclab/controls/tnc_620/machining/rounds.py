"""Finishing round a figure from a place beside its wall: down, up to the wall on an arc, round, off it, back; on every level.

The tool stays on its level between two rounds, for all of that way is clear. Lengths in mm, feeds in mm/min.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence

from mnclab.geometry.contours import Contour
from mnclab.machining.milling.clearing import begin, end, numbered
from mnclab.machining.milling.finishing import LEAST
from mnclab.machining.milling.pocket_steps import Feeds
from mnclab.machining.steps import Along, Go, Step

Place = tuple[float, float]


def finish_rounds(
    wall: Contour, arcs: Sequence[Contour], start: Place, levels: Sequence[float], feeds: Feeds
) -> Iterator[Step]:
    """Round a closed `wall` on each of the `levels`, from `start` and back to it; `arcs` lead to the wall and off it, if any."""
    x, y = first = begin(arcs[0] if arcs else wall).tolist()
    aside = math.dist(first, start) > LEAST
    for name, level in zip(numbered("finishing", len(levels)), levels, strict=True):
        yield Go(f"{name}, down", level, feeds.plunge)
        if aside:
            yield Go(f"{name}, to the approach", None, feeds.level, x, y)
        names = (f"{name}, to the wall", name, f"{name}, off the wall") if arcs else (name,)
        for label, way in zip(names, (*arcs[:1], wall, *arcs[1:]), strict=True):
            yield Along(label, way, feeds.level)
        if math.dist(end(arcs[-1] if arcs else wall), start) > LEAST:
            yield Go(f"{name}, back to the start", None, feeds.level, *start)
