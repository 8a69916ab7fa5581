"""Turning down to a shoulder with a bevel, and grooves: levels, where a pass meets the contour, chip breaks, all as steps.

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
from collections.abc import Iterable, Iterator, Sequence
from typing import NamedTuple

from mnclab.machining.depths import infeeds
from mnclab.machining.steps import RAPID, Go, Step, Thread

GRAIN = 1e-9  # relative: a stock of 0.3 holds three depths of 0.1
LOOP = 0.5  # mm in both axes at the end of a roughing pass, as the textbook has it (NC-31, 3.20.2)


class Shoulder(NamedTuple):
    """The contour to be cut: at level `finish` up to `corner`, then straight to `far` at level `rim`."""

    finish: float
    corner: float
    rim: float
    far: float

    def stop(self, level: float) -> float:
        """How far along a pass at this level may go: to the bevel, and beyond the rim to `far`."""
        if self.rim == self.finish or (share := (level - self.finish) / (self.rim - self.finish)) >= 1:
            return self.far
        return self.corner + max(share, 0.0) * (self.far - self.corner)


class Pass(NamedTuple):
    """One cut: the level across, and where along it ends."""

    level: float
    stop: float


def count_of_levels(start: float, finish: float, depth: float, with_finish: bool = True) -> int:
    """How many full depths lie between two levels; one that lands on `finish` counts only `with_finish`."""
    share = abs(start - finish) / depth
    whole = math.floor(share * (1 + GRAIN))
    return whole - (not with_finish and whole > 0 and math.isclose(whole, share, rel_tol=GRAIN))


def levels(start: float, finish: float, depth: float, with_finish: bool = True) -> tuple[float, ...]:
    """Levels one `depth` apart from `start` towards `finish`, as many as `count_of_levels` says."""
    step = math.copysign(depth, finish - start)
    found = [start + step * i for i in range(1, count_of_levels(start, finish, depth, with_finish) + 1)]
    if found and (found[-1] - finish) * step > 0:  # rounding must not cut deeper than the finish
        found[-1] = finish
    return tuple(found)


def roughing(start: float, shoulder: Shoulder, depth: float, with_finish: bool = True) -> tuple[Pass, ...]:
    """The roughing passes from level `start` down, each to where it meets the contour; steps on the bevel are left."""
    return tuple(Pass(x, shoulder.stop(x)) for x in levels(start, shoulder.finish, depth, with_finish))


def count_of_breaks(begin: float, end: float, length: float) -> int:
    """How often a cut is interrupted; no `length` (0) never."""
    return max(math.ceil(abs(end - begin) / length * (1 - GRAIN)) - 1, 0) if length > 0 else 0


def chip_breaks(begin: float, end: float, length: float) -> tuple[float, ...]:
    """Where a cut is interrupted to break the chip: at multiples of `length` from its begin, not at its end."""
    step = math.copysign(length, end - begin)
    return tuple(begin + step * i for i in range(1, count_of_breaks(begin, end, length) + 1))


# --- as steps of a tool: x across, z along; `exchanged` makes them the other way round ------------------------------


def loops(
    start: tuple[float, float], passes: Sequence[Pass], *, retract: float = LOOP, feed: float | None = None,
    infeed: float | None = RAPID, chip: float = 0.0, chip_retract: float = 0.0, total: int = 0,
) -> Iterator[Go]:  # fmt: skip
    """Roughing passes from `start` (across, along), each a loop: in, cut, off by `retract` both ways, back.

    After every `chip` mm (0: never) the tool goes back by `chip_retract` at rapid and cuts on. No retract goes beyond the
    start, where a tailstock may be. `total` is how many passes the labels tell of.
    """
    x1, z1 = start
    for number, (level, stop) in enumerate(passes, 1):
        label = f"pass {number} of {total or len(passes)}"
        yield Go(f"{label}, infeed", x=level, feed=infeed)
        for place in chip_breaks(z1, stop, chip):
            yield Go(label, place, feed)
            yield Go(f"{label}, chip break", towards(place, z1, chip_retract))
        yield Go(label, stop, feed)
        yield Go(f"{label}, retract", towards(stop, z1, retract), x=towards(level, x1, retract))
        yield Go(f"{label}, return", z1)


def around(
    start: tuple[float, float], shoulder: Shoulder, *, label: str, feed: float | None = None,
    infeed: float | None = RAPID, wall: float | None = None,
) -> Iterator[Go]:  # fmt: skip
    """From `start` in, to the corner, up the bevel, at the feed `wall` from the rim to the start level, and back at rapid."""
    x1, z1 = start
    yield Go(f"{label}, infeed", x=shoulder.finish, feed=infeed)
    yield Go(label, shoulder.corner, feed)
    yield Go(label, shoulder.far, feed, x=shoulder.rim)
    yield Go(f"{label}, wall", feed=wall, x=x1)
    yield Go(f"{label}, return", z1)


def remove_stock(
    start: tuple[float, float], shoulder: Shoulder, depth: float | None, *, retract: float, feed: float | None = None,
    wall: float | None = RAPID,
) -> Iterator[Go]:  # fmt: skip
    """From a start (across, along) passes one `depth` apart; the last one, or the only one without a depth, along the contour.

    It also cuts what the others have left on the bevel; `wall` is its feed from the rim to the start level.
    """
    passes = roughing(start[0], shoulder, depth, with_finish=False) if depth else ()
    count = len(passes) + 1
    yield from loops(start, passes, retract=retract, feed=feed, total=count)
    label = f"pass {count} of {count}, contour" if passes else "contour"
    yield from around(start, shoulder, label=label, feed=feed, wall=wall)


def towards(place: float, goal: float, distance: float) -> float:
    """A place moved by a distance towards a goal, but not beyond it."""
    return goal if abs(goal - place) <= distance else place + math.copysign(distance, goal - place)


# --- along X instead of Z --------------------------------------------------------------------------------------------


class Crosswise:
    """A cycle written down as (across, along): for cuts along Z this is (X, Z), in a `transverse` cycle (Z, X)."""

    transverse = False

    def about(self, m: object) -> tuple[float, float]:
        """Steps are in coordinates of the program."""
        return 0.0, 0.0

    def across_along(self, x: float, z: float) -> tuple[float, float]:
        return (z, x) if self.transverse else (x, z)

    def in_axes(self, steps: Iterable[Step]) -> Iterable[Step]:
        """Steps of x across and z along with their true axes."""
        return exchanged(steps) if self.transverse else steps


def exchanged(steps: Iterable[Step]) -> Iterator[Step]:
    """The same steps for a cut along X, or a hole along it: across and along change places."""
    return (s._replace(x=s.z, z=s.x) if isinstance(s, Go | Thread) else s for s in steps)


# --- grooves: plunges at places side by side, several grooves or a wide one -------------------------------------------
# Coordinates are (across, along) as above, mm: the tool plunges across, the places lie along.

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
