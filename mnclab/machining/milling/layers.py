"""Passes of a strategy step by step: down, along, up again, level by level. Lengths in mm, feeds in mm/min.

The plain way, for comparing strategies and for a path without a program; a cycle has an order of its own. Labels name every
row: "entry helix", "ring 3 of 7", "link", "lift".
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from mnclab.machining.milling.clearing import Clearing, Piece, begin
from mnclab.machining.milling.entries import VERTICAL, Entry, descent
from mnclab.machining.steps import RAPID, Along, Go, Step
from mnclab.machining.tracing import traced
from mnclab.path.toolpath import Toolpath


def toolpath(
    clearing: Clearing, levels: Sequence[float] = (-1.0,), *, surface: float = 0.0, clearance: float = 2.0,
    entry: Entry = VERTICAL, feed: float = 500.0, plunge_feed: float = 150.0, climb: bool = True,
) -> Toolpath:  # fmt: skip
    """Every pass on every level, from `surface` down by `entry`; lifts go to `clearance` above the surface, rapid."""
    pieces = [piece for piece in clearing.pieces if piece.passes or piece.place is not None]
    if not pieces or not levels:
        raise ValueError("there is nothing to clear")
    above = surface + clearance

    def steps() -> Iterator[Step]:
        for top, level in zip((surface, *levels), levels):
            for piece in pieces:
                yield from _piece(piece, clearing.radius, (above, top, level), entry, (feed, plunge_feed), climb)

    return traced(steps(), (*pieces[0].entry.tolist(), above), clearing.radius)


def _piece(
    piece: Piece, radius: float, heights: tuple[float, float, float], entry: Entry, feeds: tuple[float, float], climb: bool
) -> Iterator[Step]:  # fmt: skip
    above, top, level = heights
    feed, plunge = feeds
    for k in range(max(1, len(piece.passes))):
        if not k or not piece.linked[k - 1]:
            down = descent(piece, entry, radius, top, level, climb, k)
            yield Go("lift", above)
            yield Go("to the entry", None, RAPID, *begin(down.contour).tolist())
            yield Go(down.label, top, plunge)
            yield Along(down.label, down.contour, plunge, down.heights.tolist())
        if piece.passes:
            yield Go("link", level, feed, *begin(piece.passes[k]).tolist())
            yield Along(piece.labels[k], piece.passes[k], feed)
    yield Go("lift", above)
