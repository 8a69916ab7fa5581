"""A contour of a million lines compensated: beside bare offsets in numpy, shapely.buffer and pyclipr, in one run.

    python3 tests -m benchmark -s

The contour is a wavy ring with the tool outside, 0.4 mm from point to point; half its corners are outside ones. "Bare" is
normals and intersections of the offsets and nothing else, no corner told from another, no arc, no check. Prints processor
seconds and ratios; asserts only that the work was done.
"""

import time

import numpy as np
import pytest
import shapely

from mnclab import Kind
from mnclab.path.compensation import Compensation, Report
from mnclab.path.compensation import apply as compensate
from mnclab.path.compensation.elements import Elements
from mnclab.path.compensation.equidistant import Equidistant
from mnclab.path.compensation.fit import check
from mnclab.path.plane import PlaneView
from mnclab.path.toolpath import Toolpath

pytestmark = pytest.mark.benchmark
POINTS, RADIUS, ROUNDS = 1_000_000, 3.0, 7
RULES = Compensation("corner", change=True, look_ahead=True)


def ring(n):
    """Points (n, 2) of a closed wavy ring, clockwise, whose hollows are twice as wide as the tool."""
    waves, size = n // 400, n * 0.4 / (2 * np.pi)
    angle = -2 * np.pi * np.arange(n) / n
    r = size + min(0.15 * size, 0.06 * (size / waves) ** 2) * np.cos(waves * angle)
    return np.stack([r * np.cos(angle), r * np.sin(angle)], axis=1)


def programmed(points):
    """The contour with tangential entry and exit as a path of rows."""
    t = (points[1] - points[0]) / np.linalg.norm(points[1] - points[0])
    middle = (points[0] + points[1]) / 2
    way = np.concatenate([[middle - 20 * t, middle], points[1:], points[:1], [middle, middle + 20 * t]])
    n = len(way) - 1
    columns = {
        "kind": np.full(n, Kind.LINE, np.uint8),
        "side": np.append(np.ones(n - 1, np.int8), np.int8(0)),
        "radius": np.broadcast_to(RADIUS, (n,)),
        "line": np.arange(n),
        "step": np.arange(n),
        "feed": np.full(n, 100.0),
    }
    return way, Toolpath.chain(np.column_stack([way, np.zeros(n + 1)]), columns)


def bare(points):
    """Where the offsets of neighbouring lines meet: P + R (n1 + n2) / (1 + n1 . n2)."""
    d = points[1:] - points[:-1]
    n = np.stack([-d[:, 1], d[:, 0]], axis=1) / np.hypot(d[:, 0], d[:, 1])[:, None]
    one, two = n[:-1], n[1:]
    return points[1:-1] + (one + two) * (RADIUS / (1 + (one * two).sum(axis=1)))[:, None]


def corners_only(path):
    """All corners and the local check, as far as the arrays: no rows."""
    view = PlaneView(path)
    return Equidistant(Elements.of(path, view, np.flatnonzero(view.moves)), RULES)


def corners_and_fit(path):
    """Corners, and the look over the whole contour."""
    view = PlaneView(path)
    found = Equidistant(Elements.of(path, view, np.flatnonzero(view.moves)), RULES)
    assert not check(found, path, view, "refuse", Report()).any()
    return found


def seconds(work):
    before = time.process_time()
    found = work()
    return time.process_time() - before, found


def test_a_million_lines(told):
    points = ring(POINTS)
    way, path = programmed(points)
    polygon = shapely.Polygon(points)
    work = {
        "bare offsets": lambda: bare(way),
        "corners": lambda: corners_only(path),
        "corners, whole contour checked": lambda: corners_and_fit(path),
        "the pass: a path of rows": lambda: compensate(path, RULES),
        "shapely.buffer": lambda: polygon.buffer(RADIUS, quad_segs=16),
    }
    try:
        import pyclipr
    except ImportError:
        pass
    else:

        def clipper():
            offset = pyclipr.ClipperOffset()
            offset.scaleFactor = 1000
            offset.addPath(points, pyclipr.JoinType.Round, pyclipr.EndType.Polygon)
            return offset.execute(RADIUS)

        work["pyclipr"] = clipper
    times = {name: [] for name in work}
    for _ in range(ROUNDS):
        for name, do in work.items():
            times[name].append(seconds(do)[0])
    made = compensate(path, RULES)
    assert len(made) > 1.4 * POINTS and (made.kind == Kind.ARC).sum() > 0.4 * POINTS
    middle = {name: float(np.median(found)) for name, found in times.items()}
    told("compensation, 1M lines, rows and gouges", middle["the pass: a path of rows"], "shapely", middle["shapely.buffer"], 3)
    print(f"\n{POINTS} lines, median of {ROUNDS} rounds")
    print(f"{'':34s}{'cpu s':>8s}{'lines/s':>12s}{'to bare':>9s}{'to the pass':>13s}")
    for name, used in middle.items():
        rate = middle["bare offsets"] / used
        print(
            f"{name:34s}{used:8.3f}{POINTS / used:12.0f}{rate:9.2f}{used / middle['the pass: a path of rows']:12.1f}x"
        )
