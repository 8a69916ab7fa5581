"""What a round tool takes away along its path: discs swept in the plane (shapely), level by level."""

from __future__ import annotations

import math
from types import SimpleNamespace

import numpy as np
import pytest
from shapely import LineString, Point, union_all

from mnclab import Kind

MICRON = 1e-3


def line_of(row):
    """The tool centre in the plane: arcs in steps of which the sagitta is less than half a micrometre."""
    if row.kind != Kind.ARC:
        return LineString([row.start[:2], row.end[:2]])
    arm = row.start[:2] - row.centre[:2]
    count = max(8, math.ceil(abs(row.sweep) / (2 * math.acos(1 - 4e-4 / max(math.hypot(*arm), 1e-3)))))
    turn = row.sweep * np.arange(count + 1) / count
    c, s = np.cos(turn), np.sin(turn)
    return LineString(row.centre[:2] + np.stack([c * arm[0] - s * arm[1], s * arm[0] + c * arm[1]], axis=1))


def disc(line, radius):
    """What a tool takes along a line; a hair less than a true disc."""
    return line.buffer(radius, quad_segs=48)


def by_level(rows, radius):
    """What is taken at each level by moves that stay in it or come down to it; rows are pairs of a row and its label."""
    found = {}
    for row, _ in rows:
        if row.kind != Kind.RAPID:
            way = line_of(row) if row.start[2] == row.end[2] else Point(row.end[:2])
            found.setdefault(round(row.end[2], 6), []).append(disc(way, radius))
    return {level: union_all(areas) for level, areas in found.items()}


def no_rapid_cuts(rows, radius):
    """Below the surface a rapid stays in what has been taken at its level or deeper, and never goes down into more."""
    taken, news = {}, {}
    for row, label in rows:
        if row.kind != Kind.RAPID:
            if row.start[2] == row.end[2]:
                news.setdefault(row.end[2], []).append(disc(line_of(row), radius))
            continue
        taken |= {level: union_all([*areas, taken.get(level, Point())]) for level, areas in news.items()}
        news, low = {}, min(row.start[2], row.end[2])
        if low < 0:
            free = union_all([area for level, area in taken.items() if level <= low + 1e-9])
            assert disc(line_of(row), radius - MICRON).difference(free).area < 1e-6, label


@pytest.fixture(scope="session")
def sweeps() -> SimpleNamespace:
    """The functions above."""
    return SimpleNamespace(line_of=line_of, disc=disc, by_level=by_level, no_rapid_cuts=no_rapid_cuts)
