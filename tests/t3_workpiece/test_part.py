"""Touching parts: closed forms for planes, bars and bores, and a touch worked out for a probing cycle."""

import pickle

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from mnclab.text.alarm import Alarm
from mnclab.workpiece.part import ball, box, cone, contact, cylinder, plane

BLOCK = box((0, 0, 0), (100, 60, 20))
BORED = BLOCK - cylinder((50, 30, -10), (50, 30, 30), 12)


def test_a_wall_six_hundredths_off():
    """Nominal wall at X 25, true wall at 25.06, ball R = 2 from (21, 25, 25): it travels 25.06 - 2 - 21."""
    wall = plane((25.06, 0, 0), (-1, 0, 0))
    assert contact(wall, (21, 25, 25), (1, 0, 0), radius=2, reach=10) == pytest.approx(2.06, abs=1e-12)


def test_distances():
    assert BLOCK([(-3, 30, 10), (-3, -4, 10), (103, 64, 32), (50, 30, 19)]) == pytest.approx([3, 5, 13, -1])
    bar = cylinder((0, 0, 0), (0, 0, 10), 5)
    assert bar([(9, 0, 5), (0, 0, 14), (8, 0, 14), (0, 0, 4), (0, 4, 5)]) == pytest.approx([4, 4, 5, -4, -1])
    lying = cylinder((0, 0, 0), (10, 0, 0), 5)
    assert lying([(5, 3, 12), (-4, 8, 0)]) == pytest.approx([np.hypot(3, 12) - 5, 5])
    assert ball((1, 1, 1), 2)([(1, 5, 4)]) == pytest.approx([3])
    assert plane((0, 0, 5), (0, 0, 9))([(7, 8, 9)]) == pytest.approx([4])


def test_combinations():
    either = ball((0, 0, 0), 2) | ball((10, 0, 0), 3)
    assert either([(3, 0, 0), (6, 0, 0)]) == pytest.approx([1, 1])
    slab = plane((0, 0, 10), (0, 0, 1)) & plane((0, 0, 0), (0, 0, -1))
    assert slab([(3, 3, 12), (3, 3, -4), (3, 3, 4)]) == pytest.approx([2, 4, -4])
    assert BORED([(50, 30, 10), (50, 35, 10), (30, 30, 24)]) == pytest.approx([12, 7, 4])


@pytest.mark.parametrize(
    ("part", "start", "direction", "radius", "travel"),
    [
        (BLOCK, (-10, 30, 10), (1, 0, 0), 2, 8),
        (BLOCK, (50, 30, 40), (0, 0, -1), 3, 17),
        (BORED, (50, 30, 10), (1, 0, 0), 2, 10),
        (BORED, (50, 30, 18.5), (0, -1, 0), 2, 10),  # near the rim, still inside
        (BORED, (53, 30, 10), (0, 1, 0), 2, np.sqrt(10**2 - 3**2)),
        (BLOCK, (-10, -1, 10), (1, 0, 0), 2, 10 - np.sqrt(3)),  # past an edge
        (BLOCK, (-10, -1, 21), (1, 0, 0), 3, 10 - np.sqrt(7)),  # past a corner
        (cylinder((0, 0, 0), (0, 0, 50), 12), (-30, 9, 20), (1, 0, 0), 2, 30 - np.sqrt(14**2 - 9**2)),
        (ball((0, 0, 0), 10), (-30, 4, 3), (1, 0, 0), 3, 30 - 12),  # 13² = 12² + 5²
    ],
)
def test_a_ball_travels_until_it_touches(part, start, direction, radius, travel):
    assert contact(part, start, direction, radius, reach=50) == pytest.approx(travel, abs=1e-10)


def test_no_contact():
    assert contact(BLOCK, (-10, 30, 10), (-1, 0, 0), 2, reach=1000) is None
    assert contact(BLOCK, (-10, 30, 10), (1, 0, 0), 2, reach=7.999) is None
    assert contact(BLOCK, (-10, 30, 10), (1, 0, 0), 2, reach=8) == pytest.approx(8)
    assert contact(BLOCK, (-10, 30, 22.00005), (1, 0, 0), 2, reach=150) is None  # just above the face
    assert contact(BLOCK, (-10, 30, 21.99995), (1, 0, 0), 2, reach=150) is not None


def test_in_contact_already():
    assert contact(BLOCK, (-2, 30, 10), (1, 0, 0), 2, reach=5) == 0.0
    assert contact(BLOCK, (-2, 30, 10), (-1, 0, 0), 2, reach=5) == 0.0
    assert contact(BLOCK, (50, 30, 10), (1, 0, 0), 2, reach=5) == 0.0


def test_a_part_is_placed_by_a_frame():
    """The block turned by 30° about Z: along X its side x = 0 is met where the ball is 2 off that plane."""
    c, s = np.cos(np.pi / 6), np.sin(np.pi / 6)
    frame = np.array([[c, -s, 0, 5], [s, c, 0, 7], [0, 0, 1, 0], [0, 0, 0, 1]])
    turned = BLOCK.placed(frame)
    corner = np.array([5, 7, 0])
    for y in (20, 40):
        start = np.array([-60.0, y, 10])
        normal = np.array([-c, -s, 0])
        gap = (start - corner) @ normal - 2
        assert contact(turned, start, (1, 0, 0), 2, reach=100) == pytest.approx(gap / c, abs=1e-10)
    with pytest.raises(Alarm, match="scaling"):
        BLOCK.placed(np.diag([2.0, 2.0, 2.0, 1.0]))


def test_a_direction_needs_a_length():
    with pytest.raises(Alarm, match="direction"):
        contact(BLOCK, (-10, 30, 10), (0, 0, 0), 2, reach=10)
    with pytest.raises(Alarm, match="normal"):
        plane((0, 0, 0), (0, 0, 0))
    with pytest.raises(Alarm, match="axis"):
        cylinder((0, 0, 0), (0, 0, 0), 3)


@example(normal=(-1.0, 0.0, 1.0), direction=(0.0, 0.0, 1.0), gap=2.5, radius=0.0)  # looks ahead as far as the reach
@given(
    st.tuples(*[st.floats(-1, 1)] * 3).filter(lambda n: np.linalg.norm(n) > 0.1),
    st.tuples(*[st.floats(-1, 1)] * 3).filter(lambda d: np.linalg.norm(d) > 0.1),
    st.floats(0.001, 50),
    st.floats(0, 5),
)
def test_planes_are_met_exactly(normal, direction, gap, radius):
    """From a gap g before a plane with normal n the ball travels g / (-n·d), if it comes nearer at all."""
    n, d = np.array(normal) / np.linalg.norm(normal), np.array(direction) / np.linalg.norm(direction)
    start = np.array([3.0, -2.0, 7.0])
    wall = plane(start - (gap + radius) * n, n)
    travel = contact(wall, start, direction, radius, reach=500)
    nearer = -(n @ d)
    if nearer * 500 < gap - 1e-6:
        assert travel is None
    elif nearer * 500 > gap + 1e-6:
        assert travel == pytest.approx(gap / nearer, rel=1e-11, abs=1e-10)


@pytest.mark.parametrize(
    ("given", "said"),
    [
        (((0, 0), (1, 0, 0), 2, 10), "where a ball starts must be three numbers"),
        (((0, 0, np.nan), (1, 0, 0), 2, 10), "where a ball starts must be a finite number"),
        (((0, 0, 0), "x", 2, 10), "direction of a probe"),
        (((0, 0, 0), (1, 0, 0), -2, 10), "radius of a ball must be at least 0"),
        (((0, 0, 0), (1, 0, 0), 2, np.inf), "how far a ball travels"),
    ],
)
def test_nonsense_is_an_alarm(given, said):
    with pytest.raises(Alarm, match=said):
        contact(BLOCK, *given)


def test_a_part_of_thousands_of_solids_nests_no_deeper_than_one_of_two():
    """A row of balls of radius 3 along X, less one of 2 at its end: 1 mm under the top of the last there is nothing."""
    row = ball((0, 0, 0), 3)
    for x in range(1, 1500):
        row = row | ball((x, 0, 0), 3)
    assert row((700, 0, 5)) == pytest.approx(2, abs=1e-9)
    less = pickle.loads(pickle.dumps(row - ball((1499, 0, 3), 2)))
    assert less((1499, 0, 2)) == pytest.approx(1, abs=1e-9) and less((0, 0, 5)) == pytest.approx(2, abs=1e-9)


def test_what_stands_far_off_is_left_out_and_changes_nothing():
    """A box with 30 cones out of it and 30 balls on it, against minima and maxima of all of them; inside only the sign."""
    random = np.random.default_rng(3)
    parts = [box((0, 0, -20), (100, 60, 0))]
    for k in range(60):
        x, y = random.uniform((0, 0), (100, 60))
        parts.append(ball((x, y, 0), 3) if k % 2 else cone((x, y, -10), (x, y, 5), 2, 6))
    whole, points = parts[0], random.uniform((-20, -20, -30), (120, 80, 20), (4000, 3))
    wanted = whole(points)
    for k, other in enumerate(parts[1:]):
        whole = whole | other if k % 2 else whole - other
        wanted = np.minimum(wanted, other(points)) if k % 2 else np.maximum(wanted, -other(points))
    found = whole(points)
    assert np.array_equal(found > 0, wanted > 0)
    assert found[wanted > 0] == pytest.approx(wanted[wanted > 0], abs=1e-12)
    assert (found[wanted < 0] >= wanted[wanted < 0] - 1e-12).all()
