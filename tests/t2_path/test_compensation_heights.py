"""Several passes, ways in the air and contours run past their start are no gouges; a tool that enters through a wall is.

Good contours are rings of lines that a tool fits, run in ways in which no material is cut that should stay: by closed form
the hollow of a corner turned by t takes R tan(t / 2) of each side, and walls that are no neighbours stay 2 R apart.
"""

import numpy as np
import pytest
import shapely
from tools.running import run

from mnclab import Kind, Tool
from mnclab.path.toolpath import Toolpath

pytestmark = pytest.mark.deep


def ring(rng):
    """A polygon (n, 2), counter-clockwise, and a radius that fits inside and outside, starting in the middle of a side."""
    while True:
        n = int(rng.integers(4, 10))
        angles = np.sort(rng.uniform(0, 2 * np.pi, n))
        if np.diff(np.append(angles, angles[0] + 2 * np.pi)).max() > 2.4 or np.diff(angles).min() < 0.25:
            continue
        r = rng.uniform(30, 60, n)
        p = np.round(np.stack([r * np.cos(angles), r * np.sin(angles)], axis=1), 3)
        edge = np.roll(p, -1, axis=0) - p
        length, before = np.hypot(*edge.T), np.roll(edge, 1, axis=0)
        turn = np.arctan2(before[:, 0] * edge[:, 1] - before[:, 1] * edge[:, 0], (before * edge).sum(axis=1))
        take = np.tan(np.abs(turn) / 2)
        room = min((length / (take + np.roll(take, -1))).min(), length[0] / 3 / max(take[0], take[1]))
        sides = shapely.linestrings(np.stack([p, p + edge], axis=1))
        far = [shapely.distance(sides[i], sides[j]) for i in range(n) for j in range(i + 2, n) if (j + 1) % n != i]
        radius = 0.9 * min(room, min(far, default=np.inf) / 2)
        if radius > 0.5:
            middle = p[0] + edge[0] * rng.uniform(0.4, 0.6)
            return np.concatenate([middle[None], p[1:], p[:1]]), round(radius, 4), turn


def path_of(points, side, radius):
    """Points (n, 3) at feed with compensation, led in and out on the tangents at the heights of the ends."""
    points = np.asarray(points, dtype=float)
    begin, end = points[1] - points[0], points[-1] - points[-2]
    begin, end = (np.append(d[:2] / np.hypot(*d[:2]), 0) * (radius + 20) for d in (begin, end))
    way = np.concatenate([[points[0] - begin], points, [points[-1] + end]])
    n = len(way) - 1
    columns = {
        "kind": np.full(n, Kind.LINE, np.uint8),
        "side": np.append(np.full(n - 1, side, np.int8), np.int8(0)),
        "radius": np.full(n, radius),
        "corner_rule": np.zeros(n, np.uint8),
    }
    return Toolpath.chain(way, columns)


def at(z, points):
    return np.column_stack([points, np.full(len(points), z)])


def passes(rng):
    """The same ring two to five times, deeper each time, by plunges or on ramps, run past its start or not."""
    p, radius, _ = ring(rng)
    deep, past = rng.uniform(0.5, 3), p[: int(rng.integers(2, len(p)))]
    rounds = int(rng.integers(2, 6))
    if rng.random() < 0.5:
        way = np.concatenate(
            [at(-deep * k, np.concatenate([p, p[:1]])) for k in range(1, rounds)] + [at(-deep * rounds, past)]
        )
    else:
        way = np.concatenate([*[p] * rounds, past])
        way = np.column_stack([way, -deep * np.arange(len(way))])
    return (way, int(rng.choice([1, -1])), radius) if len(way) > 2 else passes(rng)


def turned(way):
    """The turns of a way of points, rad."""
    step = np.diff(way, axis=0)
    angle = np.arctan2(step[:, 1], step[:, 0])
    return (np.diff(angle) + np.pi) % (2 * np.pi) - np.pi


def crossing_in_the_air(rng):
    """Part of a ring, a lift, across over other parts of it to a place farther on, down, and on from there at one depth."""
    while True:
        p, radius, _ = ring(rng)
        here, there = np.sort(rng.choice(np.arange(1, len(p)), 2, replace=False))
        air = np.concatenate(
            [p[here : here + 1], rng.uniform(-60, 60, (int(rng.integers(1, 4)), 2)), p[there : there + 1]]
        )
        way = np.concatenate([p[: here + 1], air[1:-1], p[there:], p[:1]])
        if np.abs(turned(way)).max() < 2.6 and np.hypot(*np.diff(air, axis=0).T).min() > 2 * radius:
            down, z = np.concatenate([p[there:], p[:1]]), -rng.uniform(0.5, 4)
            return (
                np.concatenate([at(z, p[: here + 1]), at(5.0, air), at(z, down)]),
                int(rng.choice([1, -1])),
                radius / 8,
            )


def run_past_a_corner(rng):
    """Outside round a ring from a corner to the same corner, both ends run straight on beyond it by less than the tool."""
    while True:
        p, radius, turn = ring(rng)
        if turn[1] > 0.05:
            break
    p = p[1:]  # from the corner after the first side
    tails = rng.uniform(0.01, 2, 2) * radius
    u, v = p[1] - p[0], p[0] - p[-1]
    u, v = u / np.hypot(*u), v / np.hypot(*v)
    return at(-2.0, np.concatenate([[p[0] - tails[0] * u], p[1:], [p[0] + tails[1] * v]])), -1, radius


FAMILIES = [passes, crossing_in_the_air, run_past_a_corner]


@pytest.mark.parametrize("family", FAMILIES, ids=lambda f: f.__name__)
def test_good_contours_are_accepted(closed, family):
    rng = np.random.default_rng(20261122)
    paths = [path_of(*family(rng)) for _ in range(200)]
    path, gouge = closed.compensated(closed.joined(paths))
    assert gouge is None
    assert (path.side != 0).any()


@pytest.mark.parametrize("seed", range(3))
def test_true_gouges_are_refused(closed, seed):
    """Rings with a tool too wide for them, on the second level of three; and begun in a corner of a pocket."""
    rng = np.random.default_rng(seed)
    for _ in range(30):
        p, radius, turn = ring(rng)
        wide = shapely.maximum_inscribed_circle(shapely.Polygon(p)).length * 1.01  # its radius and a little
        levels = np.concatenate([at(z, np.concatenate([p, p[:1]])) for z in (-1.0, -2.0, -3.0)])
        assert closed.compensated(path_of(levels, 1, radius))[1] is None
        assert closed.compensated(path_of(levels, 1, wide))[1] is not None
        if turn[1] > 0.05:
            assert closed.compensated(path_of(at(-2.0, np.concatenate([p[1:], p[:2]])), 1, radius))[1] is not None


# --- programs of the shape of a part that is milled from the outside in, level by level -------------------------------


def boss(levels, rings, tool, start=10.0):
    """Circles about the origin, from outside in at each level; between them a loop out and a loop in, all compensated."""
    raw, step, loop = 12.0, 0.8, 1.05 * tool
    yield f"G90 G17 G54\nG0 Z{start}\nG0 X{-loop} Y{-raw - 3 * loop}\nG42 G1 X{-loop} Y{-raw - loop} F300"
    yield f"G2 X0 Y{-raw} I{loop} J0"
    for level in range(levels):
        yield f"G1 Z{-0.7 * level}"
        r = raw
        for k in range(rings):
            if k:
                yield f"G2 Y{-r - 2 * loop} J{-loop}"
                r -= step
                yield f"G2 Y{-r} J{(2 * loop + step) / 2}"
            yield f"G3 Y{-r} J{r}"
        back = raw + 2 * loop
        yield f"G2 Y{-back} J{-(back - r) / 2}\nG2 Y{-raw} J{loop}"
    yield "G0 Z20\nG40 G1 X60 Y-60\n"


CALLS = {"mnc": "T1\n", "g43": "T1 M6\nD1\n"}


def fitted(control, text, radius):
    found = run(text, control, ok=None, before=CALLS[control], tools={1: Tool(radius=radius)})
    return found.ok, [alarm for alarm in found.alarms if alarm.severity == "alarm"]


@pytest.mark.parametrize("control", CALLS)
@pytest.mark.parametrize("radius", [1.0, 1.55, 2.5])
def test_a_part_in_rings_and_levels_is_accepted(control, radius):
    ok, alarms = fitted(control, "\n".join(boss(4, 5, radius)), radius)
    assert ok, alarms


SQUARE = "G90 G17 G54\nG0 X-20 Y-20 Z5\nG1 Z-2 F100\nG41 X0 Y{0}\nY40\nX40\nY0\nX{1}\nG40 X-30 Y-10\n"


@pytest.mark.parametrize("control", CALLS)
@pytest.mark.parametrize("before, past", [(0, -1), (-1, 0), (-0.5, -0.5), (-1, -1.9), (-6, -6), (-1.9, 0)])
def test_a_square_run_past_its_start(control, before, past):
    ok, alarms = fitted(control, SQUARE.format(before, past), 2)
    assert ok, alarms


@pytest.mark.parametrize("control", CALLS)
def test_a_tool_that_arrives_in_a_wall_at_depth_is_refused(control):
    """Inside of the square from its corner: where the tool arrives the last side is 0 mm away. In the air it may."""
    pocket = "G90 G17 G54\nG0 X20 Y-20 Z5\nG1 Z{0} F100\nG42 X0 Y0\nY40\nX40\nY0\nX0\nG40 X-30 Y-10\n"
    ok, alarms = fitted(control, pocket.format(-2), 2)
    assert not ok and "arrives at the contour" in alarms[0].message
    ok, alarms = fitted(control, pocket.format(5).replace("Y40\n", "Y40\nZ-2\n"), 2)
    assert ok, alarms


@pytest.mark.parametrize("control", CALLS)
@pytest.mark.parametrize("heights, fits", [((-2, -2), False), ((-2, 5), True)])
def test_a_narrow_place_counts_only_where_heights_meet(control, heights, fits):
    """Along a wall and back 3 mm beside it with a tool 4 mm wide: at its depth, and retracted."""
    text = "G90 G17 G54\nG0 X-20 Y0 Z5\nG1 Z{0} F100\nG42 X0 Y0\nX40\nX60 Y20\nX80\nZ{1}\nY-30\nX40 Y-3\nX0\nG40 X-40\n"
    assert fitted(control, text.format(*heights), 2)[0] is fits


@pytest.mark.parametrize("control", CALLS)
def test_a_ramp_into_a_narrow_slot_is_refused(control):
    """Down the one side and farther down the other, 3 mm apart: on a ramp the tool works all the way."""
    text = "G90 G17 G54\nG0 X-20 Y0 Z5\nG1 Z0 F100\nG41 X0 Y0\nX40 Z-1\nX50 Y1.5 Z-2\nX40 Y3 Z-3\nX0 Z-4\nG40 X-20\n"
    ok, alarms = fitted(control, text, 2)
    assert not ok, alarms
