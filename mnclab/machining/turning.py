"""Roughing by parallel passes down to a shoulder with a bevel: levels, where a pass meets the contour, chip breaks.

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
from collections.abc import Iterable, Iterator
from typing import NamedTuple

from mnclab.machining.steps import RAPID, Go

GRAIN = 1e-9  # relative: a stock of 0.3 holds three depths of 0.1


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


def remove_stock(
    start: tuple[float, float], shoulder: Shoulder, depth: float | None, *, retract: float, feed: float | None = None,
    wall: float | None = RAPID,
) -> Iterator[Go]:  # fmt: skip
    """From a start (across, along) remove the stock in passes one ``depth`` apart, the last one along the contour.

    Each pass goes in at rapid, cuts to the contour, leaves it by ``retract`` both ways (never beyond the start) and returns.
    The last one also cuts what the others have left on the bevel; ``wall`` is its feed from the rim to the start level.
    Without a depth there is this one alone. Steps have x across and z along.
    """
    x1, z1 = start
    passes = roughing(x1, shoulder, depth, with_finish=False) if depth else ()
    for number, (level, stop) in enumerate(passes, 1):
        label = f"pass {number} of {len(passes) + 1}"
        yield Go(f"{label}, infeed", x=level)
        yield Go(label, stop, feed)
        yield Go(f"{label}, retract", towards(stop, z1, retract), x=towards(level, x1, retract))
        yield Go(f"{label}, return", z1)
    label = f"pass {len(passes) + 1} of {len(passes) + 1}, contour" if passes else "contour"
    yield Go(f"{label}, infeed", x=shoulder.finish)
    yield Go(label, shoulder.corner, feed)
    yield Go(label, shoulder.far, feed, x=shoulder.rim)
    yield Go(f"{label}, wall", feed=wall, x=x1)
    yield Go(f"{label}, return", z1)


def towards(place: float, goal: float, distance: float) -> float:
    """A place moved by a distance towards a goal, but not beyond it."""
    return goal if abs(goal - place) <= distance else place + math.copysign(distance, goal - place)


def facing(steps: Iterable[Go]) -> Iterator[Go]:
    """The same steps for a cut along X: across and along change places."""
    return (step._replace(x=step.z, z=step.x) for step in steps)
