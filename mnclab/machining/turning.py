"""Turning down to a shoulder with a bevel: levels, where a pass meets the contour, chip breaks, and all as steps.

Coordinates are (across, along), mm. A longitudinal cut has the radius across and Z along; a facing cut has them the
other way round. Nothing here knows which side is outside or which way Z points: signs follow from the numbers. ::

        far                     corner            start
         |                        |                 |
    rim -+                        |                 +- start, across
          \\                       |   pass 1  <-----|
            \\                     |   pass 2  <-----|
              \\-------------------+-----------------+- finish
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import NamedTuple

from mnclab.machining.steps import RAPID, Go, Step

GRAIN = 1e-9  # relative: a stock of 0.3 holds three depths of 0.1
LOOP = 0.5  # mm in both axes at the end of a roughing pass, as the textbook has it (NC-31, 3.20.2)


class Shoulder(NamedTuple):
    """The contour to be cut: at level ``finish`` up to ``corner``, then straight to ``far`` at level ``rim``."""

    finish: float
    corner: float
    rim: float
    far: float

    def stop(self, level: float) -> float:
        """How far along a pass at this level may go: to the bevel, and beyond the rim to ``far``."""
        share = 0.0 if self.rim == self.finish else (level - self.finish) / (self.rim - self.finish)
        if self.rim == self.finish or share >= 1:
            return self.far
        return self.corner + max(share, 0.0) * (self.far - self.corner)


class Pass(NamedTuple):
    """One cut: the level across, and where along it ends."""

    level: float
    stop: float


def count_of_levels(start: float, finish: float, depth: float, with_finish: bool = True) -> int:
    """How many full depths lie between two levels; one that lands on ``finish`` counts only ``with_finish``."""
    share = abs(start - finish) / depth
    whole = math.floor(share * (1 + GRAIN))
    return whole - (not with_finish and whole > 0 and math.isclose(whole, share, rel_tol=GRAIN))


def levels(start: float, finish: float, depth: float, with_finish: bool = True) -> tuple[float, ...]:
    """Levels one ``depth`` apart from ``start`` towards ``finish``, as many as :func:`count_of_levels` says."""
    step = math.copysign(depth, finish - start)
    found = [start + step * i for i in range(1, count_of_levels(start, finish, depth, with_finish) + 1)]
    if found and (found[-1] - finish) * step > 0:  # rounding must not cut deeper than the finish
        found[-1] = finish
    return tuple(found)


def roughing(start: float, shoulder: Shoulder, depth: float, with_finish: bool = True) -> tuple[Pass, ...]:
    """The roughing passes from level ``start`` down to a shoulder, each to where it meets the contour.

    What is left after the last (less than one depth, and the steps on the bevel) is for a clean-up along the contour.
    """
    return tuple(Pass(x, shoulder.stop(x)) for x in levels(start, shoulder.finish, depth, with_finish))


def count_of_breaks(begin: float, end: float, length: float) -> int:
    """How often a cut is interrupted; no ``length`` (0) never."""
    return max(math.ceil(abs(end - begin) / length * (1 - GRAIN)) - 1, 0) if length > 0 else 0


def chip_breaks(begin: float, end: float, length: float) -> tuple[float, ...]:
    """Where a cut is interrupted to break the chip: at multiples of ``length`` from its begin, not at its end."""
    step = math.copysign(length, end - begin)
    return tuple(begin + step * i for i in range(1, count_of_breaks(begin, end, length) + 1))


# --- as steps of a tool ----------------------------------------------------------------------------------------------


def go(
    label: str,
    across: float | None = None,
    along: float | None = None,
    feed: float | None = RAPID,
    facing: bool = False,
) -> Go:
    """A move in (across, along): radius and Z, or for a facing cut Z and radius."""
    x, z = (along, across) if facing else (across, along)
    return Go(label, z=z, feed=feed, x=x)


def around(
    start: tuple[float, float],
    shoulder: Shoulder,
    *,
    label: str,
    infeed: float | None = RAPID,
    out: float | None = None,
    facing: bool = False,
) -> Iterator[Step]:
    """From ``start`` (across, along) once along the contour and back: in, to the corner, up the bevel, out, return.

    ``infeed`` and ``out`` are the feeds of the first and of the last way across; the return is at rapid.
    """
    across, along = start
    yield go(label, shoulder.finish, feed=infeed, facing=facing)
    yield go(label, along=shoulder.corner, feed=None, facing=facing)
    yield go(label, shoulder.rim, shoulder.far, None, facing)
    yield go(label, across, feed=out, facing=facing)
    yield go(label, along=along, facing=facing)


def loops(
    start: tuple[float, float],
    passes: Sequence[Pass],
    *,
    infeed: float | None = RAPID,
    chip: float = 0.0,
    chip_retract: float = 0.0,
    retract: float = LOOP,
    facing: bool = False,
) -> Iterator[Step]:
    """Roughing passes from ``start`` (across, along), each a loop: in, cut, off by ``retract`` in both axes, back.

    After every ``chip`` mm (0: never) the tool goes back by ``chip_retract`` at rapid and cuts on. No retract goes beyond
    the start, where a tailstock or the far wall of a bore may be.
    """
    across, along = start
    for number, cut in enumerate(passes, 1):
        label = f"pass {number} of {len(passes)}"
        yield go(label, cut.level, feed=infeed, facing=facing)
        for place in chip_breaks(along, cut.stop, chip):
            yield go(label, along=place, feed=None, facing=facing)
            yield go(label, along=toward(place, along, chip_retract), facing=facing)
        yield go(label, along=cut.stop, feed=None, facing=facing)
        yield go(label, toward(cut.level, across, retract), toward(cut.stop, along, retract), facing=facing)
        yield go(label, along=along, facing=facing)


def toward(here: float, there: float, length: float) -> float:
    """``length`` from one coordinate towards another, at most up to it.

    >>> toward(3, 5, 0.5), toward(3, 2.8, 0.5)
    (3.5, 2.8)
    """
    return there if abs(there - here) <= length else here + math.copysign(length, there - here)
