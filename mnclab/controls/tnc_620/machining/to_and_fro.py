"""Slots cut along their centre line, to and fro: with straight infeeds at the ends, or sinking on the way. Lengths in mm.

    straight    ↓───►        oblique   ╲ there            both end with the whole line cut on the last level
                ◄───↓                  ╱ and back
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from mnclab.geometry.contours import Contour
from mnclab.machining.milling.clearing import numbered
from mnclab.machining.milling.pocket_steps import Feeds
from mnclab.machining.steps import Along, Go, Step


def straight_infeeds(line: Contour, levels: Sequence[float], feeds: Feeds) -> Iterator[Step]:
    """Down where the tool stands, at the begin of the line, along it, down at its end, and back along it: as many as levels."""
    for k, (name, level) in enumerate(zip(numbered("infeed", len(levels)), levels, strict=True)):
        yield Go(f"{name}, down", level, feeds.plunge)
        yield Along(f"{name}, along the slot", line.reversed() if k % 2 else line, feeds.level)


def oblique_infeeds(line: Contour, surface: float, levels: Sequence[float], feed: float) -> Iterator[Step]:
    """From the begin of the line at the `surface`, there and back to each of the levels, evenly down; at last level, there."""
    top, back = surface, line.reversed()
    for name, level in zip(numbered("infeed", len(levels)), levels, strict=True):
        middle = (top + level) / 2
        yield Along(f"{name}, there", line, feed, _evenly(line, top, middle))
        yield Along(f"{name}, back", back, feed, _evenly(back, middle, level))
        top = level
    yield Along("along the floor", line, feed)


def _evenly(line: Contour, top: float, bottom: float) -> list[float]:
    """The heights of the points of an open contour whose pieces are alike."""
    last = len(line.points) - 1
    return [top + (bottom - top) * k / last for k in range(last + 1)]
