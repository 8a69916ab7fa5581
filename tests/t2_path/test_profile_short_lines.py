"""Short lines that stand for a curve: the corners keep to what the axes bear on the curve itself.

Authority: the closed form v² = a r of uniform circular motion, and the corner rules of other planners written out here:
Klipper's `0.5 * move_d * tan_theta_d2 * accel` and Grbl 1.1's `junction_acceleration * junction_deviation * s / (1 - s)`.
"""

import math

import numpy as np
import pytest

from mnclab import Kind, Limits, Toolpath
from mnclab.path.profile import Profile


def chain(points, feed=60_000.0):
    points = np.asarray(points, float)
    n = len(points) - 1
    return Toolpath.chain(points, {"kind": np.full(n, Kind.LINE, np.uint8), "feed": np.full(n, feed)})


def ring(radius, lines, plane=(0, 1), rise=0.0):
    angle = np.linspace(0, 2 * math.pi, lines + 1)
    points = np.zeros((lines + 1, 3))
    points[:, plane[0]], points[:, plane[1]] = radius * np.cos(angle), radius * np.sin(angle)
    points[:, 3 - sum(plane)] = rise * angle
    return points


@pytest.mark.parametrize("rule", ["deviation", "tolerance"])
@pytest.mark.parametrize(("radius", "lines"), [(1, 90), (1, 360), (5, 360), (20, 600), (10, 20_000)])
def test_a_circle_in_lines_is_as_fast_as_a_circle(rule, radius, lines):
    """v² = a r, with a from that of one axis to that of two at 45°; (10, 20000) turns by less than counts as a corner."""
    profile = Profile(chain(ring(radius, lines)), Limits(acceleration=200, corner_speed=rule, corner_tolerance=0.02))
    v = profile.plan.v[lines // 4 : 3 * lines // 4]
    assert math.sqrt(200 * radius) * 0.98 < v.min() and v.max() < math.sqrt(math.sqrt(2) * 200 * radius) * 1.002


@pytest.mark.parametrize("rule", ["deviation", "tolerance"])
@pytest.mark.parametrize("plane", [(0, 1), (2, 0), (1, 2)])
@pytest.mark.parametrize("rise", [0.0, 0.7])
def test_each_axis_bears_the_corners_by_itself(rule, plane, rise):
    """A change of speed v Δu happens within the time l / v of the shorter row: v² |Δu_k| / l <= A_k for every axis."""
    points = ring(3, 144, plane, rise)
    most = (900.0, 300.0, 80.0)
    path = chain(points)
    profile = Profile(path, Limits(rapid=1e6, acceleration=most, corner_speed=rule, corner_tolerance=0.02))
    step = np.diff(points, axis=0)
    length = np.linalg.norm(step, axis=1)
    change = np.abs(np.diff(step / length[:, None], axis=0)) / np.minimum(length[1:], length[:-1])[:, None]
    share = (profile.plan.v[1:-1, None] ** 2 * change / most).max(axis=1)
    assert share.max() <= 1 + 1e-9
    assert share.max() > 0.95  # and none is held without need


def test_the_joint_is_no_faster_than_klipper_plans_it():
    rng = np.random.default_rng(3)
    points = np.cumsum(rng.normal(0, 0.2, (400, 3)) + (0.3, 0, 0), axis=0)
    profile = Profile(chain(points), Limits(rapid=1e6, acceleration=3000, corner_speed="deviation", corner_tolerance=0.01))
    step = np.diff(points, axis=0)
    length = np.linalg.norm(step, axis=1)
    rate = step / length[:, None]
    cosine = -(rate[1:] * rate[:-1]).sum(axis=1)
    s = np.sqrt(0.5 * (1 - cosine))
    most = 3000 / np.abs(rate).max(axis=1)  # path acceleration of each row: each axis has 3000
    r = s / (1 - s) * 0.01 * np.minimum(most[1:], most[:-1])
    middle = 0.5 * s / np.sqrt(0.5 * (1 + cosine)) * np.minimum(length[1:], length[:-1])
    axes = np.linalg.norm(np.diff(rate, axis=0), axis=1) / (np.abs(np.diff(rate, axis=0)) / 3000).max(axis=1)
    expected = np.minimum(np.minimum(r, middle * axes), s / (1 - s) * 0.01 * axes)
    assert profile.plan.rows.corner[1:-1] == pytest.approx(expected, rel=1e-9)


def test_grbl_knows_no_length():
    """Grbl 1.1: v² = a ε s / (1 - s), a what the axes bear along the change of direction."""
    most = np.array([900.0, 300.0, 80.0])
    for length in (100.0, 0.01):
        for turn in (0.3, 1.2, 2.5):
            points = [(0, 0, 0), (length, 0, 0), (length * (1 + math.cos(turn)), length * math.sin(turn), 0)]
            change = np.array([1 - math.cos(turn), math.sin(turn)])
            a = (most[:2] / (change / np.linalg.norm(change))).min()
            s = math.cos(turn / 2)
            limits = Limits(rapid=1e7, acceleration=tuple(most), corner_speed="grbl", corner_tolerance=0.02)
            found = Profile(chain(points, 1e6), limits).plan.rows.corner[1]
            assert found == pytest.approx(a * 0.02 * s / (1 - s), rel=1e-9)
