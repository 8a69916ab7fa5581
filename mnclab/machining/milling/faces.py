"""Faces milled on parallel lines or on concentric ways, level by level."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from mnclab.geometry import contours
from mnclab.geometry.contours import Contour, placed
from mnclab.geometry.regions import Region
from mnclab.machining.depths import MOST, TooMany
from mnclab.machining.milling.clearing import Clearing, begin, joined, numbered
from mnclab.machining.steps import Along, Go, Step

# Pockets of simple shape, cleared on passes of the same shape. Lengths in mm, angles in rad.
#     t = way from the first to the last pass, k = greatest stepover:  n = ceil(t / k) steps of t / n each
# All steps are equal and none is above k. A pocket is cleared from its centre outwards; in climb milling, the spindle
# turning clockwise, its wall is followed counter-clockwise. What stands in the middle is cut free by `studs`.

DRIFT = 1e-9  # a number of steps this little above a whole one is that whole one
MOST_WAYS = 2_000  # steps from the middle to the wall, beyond any tool and pocket
NOTHING = 1e-6  # mm; a shorter way needs no step


def steps(way: float, stepover: float, most: int = MOST_WAYS) -> int:
    """How many equal steps of at most `stepover` a way needs; TooMany where nobody would wait for them."""
    if not stepover > 0:
        raise ValueError(f"the stepover must be greater than 0, got {stepover:g}")
    if way > most * stepover:
        raise TooMany(f"{stepover:g} divides {way:g} into more than {most} steps")
    return math.ceil(way / stepover - DRIFT) if way > NOTHING else 0


def rectangle(
    length: float, width: float, radius: float, stepover: float, allowance: float = 0.0, *, corner: float = 0.0,
    climb: bool = True, centre: ArrayLike = (0, 0), angle: float = 0.0, begin: int | None = None,
) -> Clearing:  # fmt: skip
    """A rectangular pocket on rectangles; the first one is a line there and back if the sides differ.

    Each begins where the longer axis, or the one that `begin` names (0 the length, 1 the width), leaves it. `corner`
    is the radius at the corners of the pocket, at least that of the tool. `angle` turns the pocket about its centre.
    """
    a, b = length / 2 - radius - allowance, width / 2 - radius - allowance
    _must_fit(min(a, b), radius, allowance, f"a pocket of {length:g} by {width:g}")
    inner = max(corner, radius) - radius - allowance
    if inner > min(a, b) + DRIFT:
        raise ValueError(f"a corner radius of {corner:g} does not fit into {length:g} by {width:g}")
    axis, n, least = (int(a < b) if begin is None else begin), steps(min(a, b), stepover), min(a, b)
    passes = []
    if abs(a - b) > DRIFT:
        far = np.array([(a - least, 0.0), (0.0, b - least)][int(a < b)])
        passes.append(Contour(contours.placed(np.array([far, -far, far]), centre, angle), closed=False))
    for i in range(1, n + 1):
        back = least * (n - i) / n
        sides, round_off = (2 * (a - back), 2 * (b - back)), max(0.0, inner - back)
        ring = contours.rectangle(*sides, round_off, centre=centre, angle=angle, begin=axis)
        passes.append(ring if climb else ring.reversed())
    return _from_the_centre(passes, "ring", radius, centre)


def circle(
    diameter: float, radius: float, stepover: float, allowance: float = 0.0, *, climb: bool = True,
    centre: ArrayLike = (0, 0), angle: float = 0.0,
) -> Clearing:  # fmt: skip
    """A circular pocket on full circles, each begun at `angle`; no pass where the tool fills the pocket."""
    reach = diameter / 2 - radius - allowance
    _must_fit(reach, radius, allowance, f"a pocket of diameter {diameter:g}")
    n = steps(reach, stepover)
    circles = [Contour.circle(centre, reach * i / n, angle, clockwise=not climb) for i in range(1, n + 1)]
    return _from_the_centre(circles, "circle", radius, centre)


def slot(
    line: Contour, width: float, radius: float, stepover: float | None = None, *, allowance: float = 0.0,
    climb: bool = True,
) -> Clearing:  # fmt: skip
    """Along the straight or bent line of a slot, then round it ever wider; just along the line where the tool fills the slot."""
    exact = abs(width - 2 * radius) <= DRIFT
    reach = 0.0 if exact else width / 2 - radius - allowance
    _must_fit(reach, radius, allowance, f"a slot {width:g} wide")
    if not contours.is_smooth(line):
        raise ValueError("a slot has a centre line of one straight line or one arc")
    n = steps(reach, stepover or radius)
    rounds = [contours.slot(line, 2 * reach * i / n) for i in range(1, n + 1)]
    passes = [line, *(ring if climb else ring.reversed() for ring in rounds)]
    return joined(passes, ("centre line", *numbered("ring", n)), radius, Region(tuple(rounds[-1:])))


def _must_fit(room: float, radius: float, allowance: float, what: str) -> None:
    if not radius > 0:
        raise ValueError(f"the tool radius must be greater than 0, got {radius:g}")
    if room < -DRIFT:
        rest = f" and an allowance of {allowance:g}" if allowance else ""
        raise ValueError(f"a tool of radius {radius:g}{rest} does not fit into {what}")


def _from_the_centre(passes: list[Contour], name: str, radius: float, centre: ArrayLike) -> Clearing:
    outer = Region(tuple(ring if ring.area > 0 else ring.reversed() for ring in passes[-1:] if ring.closed))
    return joined(passes, numbered(name, len(passes)), radius, outer, np.asarray(centre, dtype=float))


# Facing a surface on parallel lines or on a rectangular spiral. Lengths in mm.
# Where the lines lie and how far they reach is given in numbers, because every cycle has its own rule for that; what they
# share is the order:
#     zigzag      ─────►      one way  ─────►     within  ────►       (the step to the next line is a link,
#                 ◄─────               ─────►              ◄───        or a lift in one way)
#                 ─────►               ─────►              ────►

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


# Milling a surface step by step: over lines or any other passes, layer by layer. Lengths in mm, feeds in mm/min.
# Where a pass does not lead on to the next one the tool lifts, goes over its start and comes down again.

class Layer(NamedTuple):
    """One layer: its name and level, its passes, the feeds along them, between them and down to the level."""

    name: str
    level: float
    passes: Clearing
    feed: float | None
    link: float | None
    down: float | None


def face(layers: Sequence[Layer], above: float, lift: float = 0.0) -> Iterator[Step]:
    """To the start of the first layer and over all of them; `above` is the clearance level at the start, `lift` the way up
    between two passes of which one does not lead on to the other. Each layer begins where the one before it ends.
    """
    x, y = begin(layers[0].passes.passes[0]).tolist()
    yield Go("to the start", x=x, y=y)
    yield Go("to the clearance level", above)
    for layer in layers:
        name = f"{layer.name}, " if layer.name else ""
        yield Go(f"{name}down", layer.level, layer.down)
        linked = [linked for piece in layer.passes.pieces for linked in (False, *piece.linked)]
        columns = layer.passes.labels, layer.passes.passes, linked
        for k, (label, contour, goes_on) in enumerate(zip(*columns, strict=True)):
            x, y = begin(contour).tolist()
            if k and not goes_on:
                yield Go(f"{name}lift", layer.level + lift, layer.link)
                yield Go(f"{name}over the next {label.split()[0]}", None, layer.link, x, y)
                yield Go(f"{name}down", layer.level, layer.link)
            elif k:
                yield Go(f"{name}link", None, layer.link, x, y)
            yield Along(name + label, contour, layer.feed)
