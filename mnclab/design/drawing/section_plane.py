"""Where a section goes through a part: straight through as many features as possible, in steps where that shows more."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

from mnclab.design.drawing.dimensions import Point
from mnclab.design.drawing.elevation import Step

FAR = 1e6  # mm, beyond every part
BESIDE = 1.0  # mm of material that a step needs beside a feature
MOST_STEPS = 2  # stations away from the straight plane
WORTH = 2.0  # of a feature for which the plane steps aside
SPOILT = 1.0  # what it costs to cut a feature beside its axis
SAME = 1e-6  # mm


class Item(NamedTuple):
    """A feature that a section can show: from `begin` to `end` along the plane, if its depth is from `low` to `high`."""

    key: tuple[bool, int]
    begin: float
    end: float
    low: float
    high: float
    reach: tuple[float, float]
    worth: float

    def shown_at(self, depth: float) -> bool:
        return self.low - SAME <= depth <= self.high + SAME

    def spoilt_at(self, depth: float) -> bool:
        return not self.shown_at(depth) and self.reach[0] < depth < self.reach[1]


class Plane(NamedTuple):
    """A cutting plane in steps, and the features that it shows."""

    steps: tuple[Step, ...]
    shows: frozenset[tuple[bool, int]]

    def way(self, low: float, high: float) -> tuple[Point, ...]:
        """Its corners between two edges of a view."""
        points: list[Point] = []
        for step in self.steps:
            ends = [(max(step.begin, low), step.depth), (min(step.end, high), step.depth)]
            points += ends if not points or abs(points[-1][1] - step.depth) > SAME else ends[1:]
            if len(points) > 2 and abs(points[-2][1] - points[-1][1]) < SAME and abs(points[-3][1] - points[-1][1]) < SAME:
                del points[-2]
        return tuple(points)


def chosen(items: Sequence[Item]) -> Plane | None:
    """The plane that shows the most; None where there is nothing to show."""
    if not items:
        return None

    def score(depth: float) -> float:
        spoilt = sum(SPOILT for each in items if each.spoilt_at(depth))
        return sum(each.worth for each in items if each.shown_at(depth)) - spoilt

    depths = sorted({(each.low + each.high) / 2 for each in items})
    middle = sum(depths) / len(depths)
    base = max(depths, key=lambda depth: (round(score(depth), 6), -abs(depth - middle)))
    stations = [(each.begin, each.end, base, each.key) for each in items if each.shown_at(base)]
    aside = 0
    for each in sorted(items, key=lambda item: (-item.worth, item.begin)):
        if aside == MOST_STEPS or each.worth < WORTH or each.shown_at(base):
            continue
        if all(each.end + BESIDE < begin or end + BESIDE < each.begin for begin, end, _, _ in stations):
            stations.append((each.begin, each.end, (each.low + each.high) / 2, each.key))
            aside += 1
    stations.sort()
    steps, begin, end = list[Step](), -FAR, -FAR
    for k, (_, until, depth, _) in enumerate(stations):
        end = max(end, until)
        last = k == len(stations) - 1
        if not last and abs(stations[k + 1][2] - depth) < SAME:
            continue
        until = FAR if last else (end + stations[k + 1][0]) / 2
        steps.append(Step(begin, until, depth))
        begin = until
    return Plane(tuple(steps), frozenset(key for *_, key in stations))
