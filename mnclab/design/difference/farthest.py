"""The true maximum of a distance along a surface and within an area, not only at the places that were looked at."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from mnclab.design.difference.half_surface import HalfSurface, Places
from mnclab.geometry.regions import Region
from mnclab.path.toolpath import Array, Index

GOLDEN = (np.sqrt(5) - 1) / 2
ROUNDS = 60  # a bracket shrinks to 3e-13 of itself
MOST = 200  # brackets that are narrowed down
GRID = 40  # places across an area
LEAST = 1e-6  # mm: less is no gain

Distance = Callable[[Array], Array]


def narrowed(surface: HalfSurface, at: Places, value: Array, group: Index, distance: Distance) -> tuple[Array, Array]:
    """Places (k, 2) on a surface where a distance is greatest between those that were looked at, and how far (k,).

    It changes by no more than the way: only where it is greater than the greatest of a group (m,) less a step can a greater
    one lie.
    """
    if not len(value):
        return np.zeros((0, 2)), np.zeros(0)
    same = (np.diff(at.element) == 0) & (np.diff(at.line) == 0)
    before, after = np.append(False, same), np.append(same, False)
    peak = (~before | (value >= np.roll(value, 1))) & (~after | (value >= np.roll(value, -1)))
    gap = np.where(after, np.roll(at.way, -1) - at.way, np.where(before, at.way - np.roll(at.way, 1), 0.0))
    most = np.zeros(int(group.max()) + 1)
    np.maximum.at(most, group, value)
    some = np.flatnonzero(peak & (value > 0) & (value >= most[group] - gap))
    some = some[np.argsort(-value[some], kind="stable")][:MOST]
    low = np.where(before[some], at.share[some - 1], at.share[some])
    high = np.where(after[some], at.share[(some + 1) % len(value)], at.share[some])

    def look(share: Array) -> tuple[Array, Array]:
        spots = np.empty((len(some), 2))
        for line in np.unique(at.line[some]):
            mine = at.line[some] == line
            spots[mine] = surface.at(int(line), at.element[some[mine]], share[mine]).place
        return spots, distance(spots)

    one, other = high - GOLDEN * (high - low), low + GOLDEN * (high - low)
    at_one, at_other = look(one)[1], look(other)[1]
    for _ in range(ROUNDS):
        right = at_one < at_other
        low, high = np.where(right, one, low), np.where(right, high, other)
        fresh = np.where(right, low + GOLDEN * (high - low), high - GOLDEN * (high - low))
        found = look(fresh)[1]
        one, other = np.where(right, other, fresh), np.where(right, fresh, one)
        at_one, at_other = np.where(right, at_other, found), np.where(right, found, at_one)
    return look((low + high) / 2)


def deepest(region: Region, distance: Distance, least: float) -> tuple[Array, float] | None:
    """The place within an area where a distance is greatest, if that is more than `least`; None if it is not."""
    best: tuple[Array, float] | None = None
    for part in region.parts:
        low, high = part.bounds
        x, y = (a + (np.arange(GRID) + 0.5) / GRID * (b - a) for a, b in zip(low, high))
        spots = np.stack(np.meshgrid(x, y), axis=-1).reshape(-1, 2)
        spots = spots[part.contains(spots)]
        if not len(spots):
            continue
        value = distance(spots)
        k = int(value.argmax())
        place, found, step = spots[k], float(value[k]), float((high - low).max()) / GRID
        ring = np.array([(np.cos(a), np.sin(a)) for a in np.arange(16) * np.pi / 8])
        while step > LEAST**2 and found + 2 * step > (best[1] if best else least):
            around = place + step * ring
            around = around[part.contains(around)]
            there = distance(around) if len(around) else np.full(1, -np.inf)
            if there.max() > found + 1e-13:
                place, found = around[there.argmax()], float(there.max())
            else:
                step /= 2
        if found > (best[1] if best else least) + LEAST:
            best = place, found
    return best
