"""Grooves side by side, or one wide groove, cut in straight plunges: the same for a cylinder and for a face. ::

      last                 start
        |  step  |  step   |      top
        v        v         v      ---
        |        |         |
       _|________|_________|_     bottom

Coordinates are (depth, side), mm: radius and Z on a cylinder, Z and radius on a face.
"""

from __future__ import annotations

from collections.abc import Iterator

from mnclab.machining.depths import infeeds
from mnclab.machining.steps import RAPID, Step
from mnclab.machining.turning import go


def places(start: float, last: float, step: float | None) -> tuple[float, ...]:
    """Where the cuts are made: at ``start``, then one ``step`` apart, the last exactly at ``last``; no step: at both.

    >>> places(40, 64, 10)
    (40, 50.0, 60.0, 64.0)
    """
    return (start,) if start == last else (start, *infeeds(start, last, step))


def grooves(
    top: float, bottom: float, start: float, last: float, step: float | None, *, shift: float | None = RAPID, face: bool
) -> Iterator[Step]:
    """Plunge from ``top`` to ``bottom`` at feed and back at rapid at each place; then back to the start at rapid.

    ``shift`` is the feed from one place to the next. ``face``: the grooves are concentric, in a face.
    """
    found = places(start, last, step)
    for number, side in enumerate(found, 1):
        label = f"cut {number} of {len(found)}"
        yield go(label, along=side, feed=shift, facing=face)
        yield go(label, bottom, feed=None, facing=face)
        yield go(label, top, facing=face)
    yield go("back to the start", along=start, facing=face)
