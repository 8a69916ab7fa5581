"""Planes through measured points: closed forms, and the angles of cycles 431 and 1420 as they were worked out by hand."""

import math

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from mnclab.geometry.frames import spatial
from mnclab.machining.probing import axes_on, plane, spatial_angles

TURN = st.floats(-179, 179)


@given(n=st.tuples(st.floats(-1, 1), st.floats(-1, 1), st.floats(0.1, 1)), seed=st.integers(0, 99))
def test_a_plane_through_three_points_has_their_cross_product(n, seed):
    p = np.random.default_rng(seed).uniform(-50, 50, size=(3, 3))
    cross = np.cross(p[1] - p[0], p[2] - p[0])
    assume(np.linalg.norm(cross) > 100 and abs(cross[2]) > 1)
    found = plane(p)
    assert found.up == pytest.approx(tuple(cross / np.linalg.norm(cross) * np.sign(cross[2])), abs=1e-9)
    assert found.distance(p) == pytest.approx([0, 0, 0], abs=1e-9) and found.flatness == 0
    a, b = -found.up[0] / found.up[2], -found.up[1] / found.up[2]  # z = a x + b y + c
    assert (found.about_x, found.about_y) == pytest.approx((math.degrees(math.atan(b)), -math.degrees(math.atan(a))))


def test_a_plane_near_four_points():
    """A twisted square, up and down by 0.3: level by symmetry, 0.6 is its flatness. A plane of balls moves down to the part."""
    found = plane([[0, 0, 5.3], [10, 0, 4.7], [10, 10, 5.3], [0, 10, 4.7]])
    assert found.up == pytest.approx((0, 0, 1), abs=1e-12) and found.flatness == pytest.approx(0.6)
    assert found.towards([0.1, 0, -1], 2).centre == pytest.approx((5, 5, 3))


MEASURED = {  # cycle 431: three points touched -> Q158, Q159, Q170, Q171, Q172
    "manual": ([[20, 20, -10], [50, 80, 0], [90, 35, 12]], (0.6111, -17.3279, 164.8214, -8.4787, 63.4349)),
    "slope": ([[10, 10, 1.1], [90, 10, 2.7], [50, 50, 1.5]], (-0.5729, -1.1458, -0.5728, -1.1458, 0)),
    "tilted":
        ([[20.664, 9.301, -3.30042], [80.561, 10.87, -0.16023], [49.387, 49.915, 1.75114]], (5.0831, -2.8679, 5, -3, 1.5005)),
}  # fmt: skip


@pytest.mark.parametrize("case", MEASURED)
def test_the_angles_of_cycle_431(case):
    """X along points 1 and 2, the normal their cross product with the third."""
    p, (about_x, about_y, *spatial_ones) = np.array(MEASURED[case][0]), MEASURED[case][1]
    found = plane(p)
    assert (found.about_x, found.about_y) == pytest.approx((about_x, about_y), abs=6e-5)
    ahead = p[1] - p[0]
    turned = spatial_angles(axes_on(np.cross(ahead, p[2] - p[0]), ahead))
    assert turned == pytest.approx(spatial_ones, abs=1.1e-4)


def test_the_angles_of_cycle_1420():
    """Ball centres over a plane with SPA 0.8, SPB -0.5."""
    found = plane([[10, 10, 2.32718], [90, 10, 3.0254], [10, 50, 2.88573]])
    assert found.spatial == pytest.approx((0.8, -0.5, 0), abs=1e-4)
    assert found.up == pytest.approx((-0.00873, -0.01396, 0.99986), abs=1e-5)


@given(a=st.floats(-80, 80), b=st.floats(-80, 80), c=TURN)
def test_spatial_angles_lay_a_plane_level(a, b, c):
    """The plane of a system turned by A, B, C: with X of the system A, B, C again; without, C is 0 and Z the same."""
    axes = spatial(*np.radians([a, b, c]))[:3, :3]
    p = (axes @ np.array([[0, 0, 7], [50, 0, 7], [0, 50, 7], [-20, -30, 7.0]]).T).T
    assert spatial_angles(axes_on(axes[:, 2], axes[:, 0] + 3 * axes[:, 2])) == pytest.approx((a, b, c), abs=1e-7)
    found = plane(p)
    assert found.spatial[2] == pytest.approx(0, abs=1e-9)
    assert spatial(*np.radians(found.spatial))[:3, 2] == pytest.approx(axes[:, 2], abs=1e-9)
