"""What a feed depends on: the cutting speed, the way down, the cutting edge along an arc; and rapids axis by axis."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from mnclab.path.limits import PerAxis
from mnclab.path.toolpath import Array, Kind, Mask, Toolpath

# Constant cutting speed: the nearer a tool is to the spindle axis, the faster the spindle turns.
# n = 1000 v / (2 π r) rev/min, with the cutting speed v in m/min and the radius r in mm, but never above a limit.

def spindle_speed(surface: ArrayLike, radius: ArrayLike, limit: ArrayLike) -> Array:
    """The spindle speed at radii (n,) of either sign, mm: rev/min, at most `limit`.

    >>> float(spindle_speed(31.41592653589793, -20, 3000))
    250.0
    """
    with np.errstate(divide="ignore", invalid="ignore"):
        speed = 1000 * np.asarray(surface, np.float64) / (2 * np.pi * np.abs(radius))
        return np.asarray(np.fmin(np.where(np.asarray(surface) == 0, 0.0, speed), limit))


def mean_turn(surface: float, radii: Array, limit: float) -> float:
    """Mean time of one turn, min, along a way that is straight between equally distant places at `radii` (k,). A turn
    takes max(2 π |r| / (1000 v), 1 / limit); its integral over r is known, so the mean of a straight way is exact."""
    slope, least = 2 * math.pi / (1000 * surface), 1 / limit
    kink = least / slope
    size = np.abs(radii)
    integral = np.sign(radii) * np.where(size > kink, least * kink + slope * (size**2 - kink**2) / 2, least * size)
    change, here = np.diff(radii), np.maximum(slope * size[:-1], least)
    flat = np.abs(change) < 1e-9 * (1 + size[:-1])
    means = np.where(flat, here, np.diff(integral) / np.where(flat, 1.0, change))
    return float(means.mean())


# Feeds that depend on where a move leads: slower on the way down, and constant at the cutting edge along arcs.
# A control names the rule in a block and it holds from there on. The rows keep the feed that was programmed until the whole
# path is known; these functions change the feeds of the tool-centre path, which is what the machine drives.

SMALLEST = 1e-9  # mm, radius of the contour at a corner


class FeedRule(NamedTuple):
    """What holds from a `step` on: the share of the feed that a move may have downwards, and whether the feed of
    compensated arcs counts at the cutting edge ("", "inside" or "everywhere")."""

    step: int
    plunging: float = 1.0
    edge: str = ""


def apply(path: Toolpath, rules: list[FeedRule]) -> Toolpath:
    """The path with the feeds of these rules, in the order of their steps; the same path if they change nothing."""
    if not rules or not len(path):
        return path
    which = np.searchsorted([rule.step for rule in rules], path.step, "right")
    cuts = ((path.kind == Kind.LINE) | (path.kind == Kind.ARC)) & ~path.synchronous
    down = np.array([1.0, *(rule.plunging for rule in rules)])[which]
    edge = np.array(["", *(rule.edge for rule in rules)])[which]
    factor = plunging(path, down) * at_edge(path, edge)
    if not (factor[cuts] != 1).any():
        return path
    factor = np.where(cuts, factor, 1.0)
    return path.replace(feed=path.feed * factor, per_rev=path.per_rev * factor)


def plunging(path: Toolpath, share: Array) -> Array:
    """Factor (n,) of the feed that keeps its component downwards, along -Z, at a share (n,) of the programmed feed."""
    drop, length = path.start[:, 2] - path.end[:, 2], path.lengths
    with np.errstate(divide="ignore", invalid="ignore"):
        return np.where(drop > 0, np.minimum(1.0, share * length / drop), 1.0)


def at_edge(path: Toolpath, where: NDArray[np.str_]) -> Array:
    """Factor (n,) that makes the feed of the centre that of the cutting edge on compensated arcs. Inside an arc the
    edge has the longer way and the centre is slowed down; "everywhere" outside it is made faster, too."""
    radius = np.linalg.norm(path.start - path.centre, axis=1)  # of the way of the centre
    inside = path.side * np.sign(path.sweep) > 0
    contour = np.where(inside, radius + path.radius, radius - path.radius)
    acts = (path.side != 0) & (contour > SMALLEST) & ((inside & (where != "")) | (where == "everywhere"))
    with np.errstate(divide="ignore", invalid="ignore"):
        return np.where(acts, radius / contour, 1.0)


# Rapids of axes that do not wait for each other: each runs at its own speed until it arrives, and the path breaks there.
# ::
#     Y  |        ____________ end          X and Y at equal speed: both until Y has arrived, then X alone
#        |      /
#        |____/___________________  X

def broken(path: Toolpath, speed: PerAxis) -> Toolpath:
    """The path with every rapid along several axes divided where one of them arrives; `speed` mm/min, per axis or all.
    Speeds alone count: acceleration is left to the profile. The path itself where nothing is divided."""
    speeds = np.broadcast_to(np.asarray(speed, dtype=np.float64), (3,)) if np.ndim(speed) == 0 else np.array(speed)[:3]
    travel = path.end - path.start
    arrival = np.sort(np.abs(travel) / speeds, axis=1)  # (n, 3): when an axis, the second and the last has arrived
    last = arrival[:, 2] * (1 - 1e-12)
    rapid = path.kind == Kind.RAPID
    first_stop = rapid & (arrival[:, 0] > 0) & (arrival[:, 0] < last)
    second_stop = rapid & (arrival[:, 1] > arrival[:, 0] * (1 + 1e-12)) & (arrival[:, 1] < last)
    if not (first_stop | second_stop).any():
        return path

    def points(rows: Mask, when: Array) -> Array:
        with np.errstate(divide="ignore", invalid="ignore"):
            share = np.minimum(when[rows, None] * speeds / np.abs(travel[rows]), 1.0)
        return path.start[rows] + travel[rows] * np.where(travel[rows] == 0, 0.0, share)

    where = np.concatenate([np.flatnonzero(first_stop), np.flatnonzero(second_stop)])
    places = np.concatenate([points(first_stop, arrival[:, 0]), points(second_stop, arrival[:, 1])])
    columns = {name: np.insert(each, where, each[where], axis=0) for name, each in path.all_but_ends().items()}
    vertices = np.concatenate([path.start[:1], np.insert(path.end, where, places, axis=0)])
    return path.through(vertices, columns)
