"""Grooves cut by plunging at places side by side: several grooves, or a wide one.

Coordinates are (across, along) as in `roughing`, mm: the tool plunges across, the places lie along.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from mnclab.machining.depths import infeeds
from mnclab.machining.steps import RAPID, Go


def places(first: float, last: float, step: float | None) -> tuple[float, ...]:
    """Where to plunge: `step` apart from the first on, and at the last; without a step at these two.

    >>> places(20, 35, 6)
    (20.0, 26.0, 32.0, 35.0)
    >>> places(20, 20, 6)
    (20.0,)
    """
    return (float(first), *(infeeds(first, last, step) if last != first else ()))


def grooves(
    across: float, bottom: float, along: Sequence[float], feed: float | None = None, home: bool = True,
    shift: float | None = RAPID,
) -> Iterator[Go]:  # fmt: skip
    """From the level `across` to the bottom at each of the places, moved between at the feed `shift`, and to the first again."""
    for number, place in enumerate(along, 1):
        label = f"groove {number} of {len(along)}" if len(along) > 1 else "groove"
        yield Go(f"to {label}", place, shift)
        yield Go(label, x=bottom, feed=feed)
        yield Go(f"out of {label}", x=across)
    if home:
        yield Go("return", along[0])
