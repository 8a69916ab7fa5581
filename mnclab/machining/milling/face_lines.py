"""Facing a surface on parallel lines or on a rectangular spiral. Lengths in mm.

Where the lines lie and how far they reach is given in numbers, because every cycle has its own rule for that; what they
share is the order:

    zigzag      ─────►      one way  ─────►     within  ────►       (the step to the next line is a link,
                ◄─────               ─────►              ◄───        or a lift in one way)
                ─────►               ─────►              ────►
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike

from mnclab.geometry.contours import Contour, placed
from mnclab.machining.depths import MOST
from mnclab.machining.milling.clearing import Clearing, joined, numbered
from mnclab.machining.milling.concentric import steps


def rows(first: float, last: float, stepover: float) -> tuple[float, ...]:
    """Where lines lie from the first to the last, equal steps of at most `stepover`; one line if both are the same.

    >>> rows(10, 40, 15)
    (10.0, 25.0, 40.0)
    """
    n = steps(abs(last - first), stepover, MOST)
    return tuple(float(first + (last - first) * i / n) for i in range(n + 1)) if n else (float(first),)


def lines(
    across: Sequence[float], start: float, stop: float, radius: float, *, one_way: bool = False,
    within: tuple[float, float] | None = None, leave: bool = False, axis: int = 0, centre: ArrayLike = (0, 0), angle: float = 0.0,
) -> Clearing:  # fmt: skip
    """Lines at the places `across`, along X (`axis` 0) or Y (1), the first one from `start` to `stop`.

    Zigzag turns every second line round and links them; one way lifts between lines that run alike. `within` gives the
    coordinates near `start` and near `stop` at which lines end where a zigzag turns: only the first start stays
    outside, and with `leave` the last end. Everything is turned by `angle` rad about the zero point and then moved to `centre`.
    """
    if not len(across):
        raise ValueError("facing needs at least one line")
    near, far = within or (start, stop)
    passes = []
    for k, place in enumerate(across):
        a, b = (far, near) if k % 2 and not one_way else (near if k else start, far)
        if leave and k == len(across) - 1:
            b = start if k % 2 and not one_way else stop
        points = np.array([(a, place), (b, place)])
        passes.append(Contour(placed(points[:, ::-1] if axis else points, centre, angle), closed=False))
    return joined(passes, numbered("line", len(passes)), radius, linked=not one_way)


def spiral(
    length: float, width: float, radius: float, stepover: float, *, first: float = 0.0, climb: bool = True,
    centre: ArrayLike = (0, 0), angle: float = 0.0,
) -> Clearing:  # fmt: skip
    """A rectangular spiral from outside in, clockwise in climb milling: the tool never leaves the material.

    The passes are rectangles inset from the edge by `first` and then by equal steps of at most `stepover`, until what is
    left is as narrow as the tool; each of the sides that close a round leads on to the next one.
    """
    a, b = length / 2, width / 2
    deepest = max(min(a, b) - radius, first)
    insets = rows(first, deepest, stepover)
    points = [(-(a - first), -(b - first))]
    for k, inset in enumerate(insets):
        x, y = a - inset, b - inset
        following = insets[min(k + 1, len(insets) - 1)]
        points += [(-x, y), (x, y), (x, -y), (-(a - following), -y)]
    corners = np.array(points) * ((1, 1) if climb else (1, -1))
    some = np.append(True, np.hypot(*np.diff(corners, axis=0).T) > 1e-9)
    way = Contour(placed(corners[some], centre, angle), closed=False)
    return joined([way], ("spiral",), radius)


def spiral_from(
    sides: tuple[float, float], radius: float, stepover: float, first: float, axis: int, outside: float
) -> tuple[tuple[float, float], Contour]:
    """A clockwise spiral from the corner whose `sides` point inwards, and its start `outside` along X (`axis` 0) or Y (1)."""
    right, above = sides[0] < 0, sides[1] < 0
    turn = {(0, 0): 0, (0, 1): -1, (1, 1): 2, (1, 0): 1}[right, above]
    x, y = abs(sides[0]), abs(sides[1])
    size = (y, x) if turn % 2 else (x, y)
    (way,) = spiral(*size, radius, stepover, first=first, angle=turn * np.pi / 2).passes
    start = np.array([x if right else -x, y if above else -y]) / 2
    start[axis] += np.copysign(outside, start[axis])
    return (float(start[0]), float(start[1])), way
