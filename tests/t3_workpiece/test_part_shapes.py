"""Parts of holes, pockets, slots and bosses: where a ball stops is worked out by Pythagoras."""

import inspect
from math import cos, hypot, inf, nan, pi, radians, sin, sqrt

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import mnclab
from mnclab.text.alarm import Alarm
from mnclab.workpiece.part import ball, boss, box, cone, contact, cylinder, foot, hole, plane, pocket, slot

EXACT = 1e-9
BLOCK = box((0, 0, -20), (100, 60, 0))
HOLED = BLOCK - hole((50, 30, 0), 24, 10)
POCKET = BLOCK - pocket((50, 30, 0), 40, 30, 8, corner=6)
SHARP = BLOCK - pocket((50, 30, 0), 40, 30, 8)
SLOT = BLOCK - slot((30, 30, 0), (70, 30, 0), 14, 9)
BOSS = BLOCK | boss((20, 30, 0), 8, diameter=12)
STUD = BLOCK | boss((50, 30, 0), 8, length=30, width=20, corner=5, turned=90)
ROUNDED = box((0, 0, -20), (100, 60, 0), corner=10)
DOWN, RIGHT = (0, 0, -1), (1, 0, 0)
DIAGONAL = (1, 1, 0)
WALL = 40 / 2 - 3, 30 / 2 - 3  # how far the middle of a ball of 3 mm is from that of the pocket, at its walls


@pytest.mark.parametrize(
    ("part", "start", "direction", "radius", "travel"),
    [
        (HOLED, (50, 30, -5), RIGHT, 2, 12 - 2),
        (HOLED, (50, 33, -5), RIGHT, 2, sqrt(10**2 - 3**2)),
        (HOLED, (50, 30, 20), DOWN, 2, 20 + 10 - 2),  # the floor
        (HOLED, (50 + 11, 30, 20), DOWN, 2, 20 - sqrt(2**2 - 1**2)),  # the rim, 1 mm beside the middle of the ball
        (HOLED, (50, 30, 40), DOWN, 15, 40 - sqrt(15**2 - 12**2)),  # a ball too large for the hole rests on the rim
        (HOLED, (50, 30 - 12 - 1, 20), DOWN, 4, 20 - 4),  # on the face beside the rim
        (BLOCK, (101, 30, 20), DOWN, 3, 20 - sqrt(3**2 - 1)),  # an edge
        (BLOCK, (101, 62, 20), DOWN, 3, 20 - sqrt(3**2 - 1 - 2**2)),  # a corner
        (BLOCK, (-10, -1, -5), RIGHT, 3, 10 - sqrt(3**2 - 1)),  # an upright edge
        (POCKET, (50, 30, -4), RIGHT, 3, WALL[0]),
        (POCKET, (50, 30, 5), DOWN, 3, 5 + 8 - 3),
        (POCKET, (50 + WALL[0] - 3, 30 + WALL[1] - 3, -4), DIAGONAL, 3, 3.0),  # the corner: 6 - 3 from the middle of its arc
        (SHARP, (50 + WALL[0] - 3, 30 + WALL[1] - 3, -4), DIAGONAL, 3, 3 * sqrt(2)),  # both walls at once
        (POCKET, (50, 30, 40), DOWN, 25, 40 - sqrt(25**2 - 15**2)),  # on both long rims
        (SLOT, (50, 30, -5), RIGHT, 2, 20 + 7 - 2),
        (SLOT, (50, 30, -5), (0, -1, 0), 2, 7 - 2),
        (SLOT, (70, 33, -5), RIGHT, 2, sqrt(5**2 - 3**2)),  # its round end
        (BOSS, (0, 30, 4), RIGHT, 2, 20 - 6 - 2),
        (BOSS, (0, 30 + 5, 4), RIGHT, 2, 20 - sqrt(8**2 - 5**2)),
        (BOSS, (20, 30, 30), DOWN, 2, 30 - 8 - 2),
        (BOSS, (20 + 7, 30, 30), DOWN, 2, 30 - 8 - sqrt(2**2 - 1)),  # its rim
        (BOSS, (20 + 6 + 2.1, 30, 30), DOWN, 2, 30 - 2),  # beside it
        (STUD, (20, 30, 4), RIGHT, 2, 50 - 20 - 10 - 2),  # turned by 90: the width lies along X
        (STUD, (50, 0, 4), (0, 1, 0), 2, 30 - 15 - 2),
        (ROUNDED, (-10, -10, -5), DIAGONAL, 2, 20 * sqrt(2) - 10 - 2),  # the middle of its edge is at (10, 10)
        (cone((0, 0, 0), (0, 0, 10), 10), (-30, 0, 5), RIGHT, 2, 30 - 5 - 2 * sqrt(2)),  # 45 degrees
        (cone((0, 0, 0), (0, 0, 10), 10), (0, 0, 30), DOWN, 2, 30 - 10 - 2),  # its tip
        (cone((0, 0, 0), (0, 0, 10), 10, 5), (5.5, 0, 30), DOWN, 2, 30 - 10 - sqrt(2**2 - 0.5**2)),  # its upper rim
    ],
)
def test_where_a_ball_stops(part, start, direction, radius, travel):
    assert part.exact
    assert contact(part, start, direction, radius, reach=60) == pytest.approx(travel, abs=EXACT)


def test_an_infinite_depth_goes_through():
    through = BLOCK - hole((50, 30, 0), 24, inf)
    assert contact(through, (50, 30, 20), DOWN, 2, 100) is None
    assert contact(through, (50, 30, -19), RIGHT, 2, 100) == pytest.approx(10, abs=EXACT)


def test_islands_and_open_pockets():
    """A pocket that breaks out of the side, and a boss on its floor."""
    part = BLOCK - pocket((100, 30, 0), 40, 30, 8) | boss((90, 30, -8), 5, diameter=10)
    assert contact(part, (120, 20, -4), (-1, 0, 0), 2, 60) == pytest.approx(120 - 80 - 2, abs=EXACT)
    assert contact(part, (120, 30, -5), (-1, 0, 0), 2, 60) == pytest.approx(120 - 95 - 2, abs=EXACT)
    assert contact(part, (103, 14, -4), (0, -1, 0), 2, 60) is None  # beside the block
    assert contact(part, (101, 30, -4), (0, -1, 0), 2, 60) == pytest.approx(15 - sqrt(3), abs=EXACT)  # the edge at (100, 15)


def random_frame(numbers):
    """A frame from seven numbers: a quaternion and a shift."""
    w, x, y, z = np.array(numbers[:4]) / np.linalg.norm(numbers[:4])
    frame = np.eye(4)
    frame[:3, :3] = [
        [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
        [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
        [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
    ]
    frame[:3, 3] = numbers[4:]
    return frame


FRAMES = st.tuples(*[st.floats(-1, 1)] * 4, *[st.floats(-200, 200)] * 3).filter(lambda n: np.linalg.norm(n[:4]) > 0.1)


@settings(max_examples=40, deadline=None)
@given(FRAMES, st.floats(0, 2 * pi), st.floats(-4, 4), st.floats(0.5, 4))
def test_a_bore_is_the_same_wherever_it_is_put(numbers, angle, aside, radius):
    """From a place `aside` of the axis the ball goes sqrt((R - r)² - aside²) to the wall, in any frame."""
    frame = random_frame(numbers)
    part = HOLED.placed(frame)
    ahead, left = np.array([cos(angle), sin(angle), 0]), np.array([-sin(angle), cos(angle), 0])
    start = np.array([50, 30, -5]) + aside * left
    travel = sqrt((12 - radius) ** 2 - aside**2)
    found = contact(part, frame[:3, :3] @ start + frame[:3, 3], frame[:3, :3] @ ahead, radius, 60)
    assert part.exact and found == pytest.approx(travel, abs=EXACT)


@settings(max_examples=25, deadline=None)
@given(st.floats(-180, 180), st.floats(-50, 50), st.floats(-50, 50), st.floats(-30, 30))
def test_turned_and_shifted_together(angle, x, y, z):
    """Parts turned and shifted alike stay one exact part; a wall of the block is met along its own normal."""
    moved = [each.turned(angle, about=(10, 5)).shifted(x, y, z) for each in (BLOCK, hole((50, 30, 0), 24, 10))]
    part = moved[0] - moved[1]
    assert part.exact
    c, s = cos(radians(angle)), sin(radians(angle))

    def there(px, py):
        return 10 + c * (px - 10) - s * (py - 5) + x, 5 + s * (px - 10) + c * (py - 5) + y

    assert contact(part, (*there(-10, 30), z - 5), (c, s, 0), 2, 60) == pytest.approx(8, abs=EXACT)
    assert contact(part, (*there(50, 30), z - 5), (-s, c, 0), 2, 60) == pytest.approx(10, abs=EXACT)
    assert contact(part, (*there(50 + 11, 30), z + 9), DOWN, 2, 60) == pytest.approx(9 - sqrt(3), abs=EXACT)


def inside(solids, points):
    """Which points lie in the material: plain comparisons, solid by solid."""
    found = np.zeros(len(points), dtype=bool)
    for kind, x, y, angle, a, b, low, high in solids:
        c, s = cos(radians(angle)), sin(radians(angle))
        u = c * (points[:, 0] - x) + s * (points[:, 1] - y)
        v = -s * (points[:, 0] - x) + c * (points[:, 1] - y)
        flat = np.hypot(u, v) < a / 2 if kind == "hole" else (np.abs(u) < a / 2) & (np.abs(v) < b / 2)
        there = flat & (points[:, 2] > low) & (points[:, 2] < high)
        found = found & ~there if kind in ("hole", "pocket") else found | there
    return found


def random_part(seed):
    """A block with turned pockets, holes and bosses that may meet, and the same as a list for `inside`."""
    rng = np.random.default_rng(seed)
    part, solids = BLOCK, [("boss", 50, 30, 0, 100, 60, -20, 0)]
    for kind in rng.choice(["hole", "pocket", "boss"], rng.integers(2, 6)):
        x, y, angle = rng.uniform(0, 100), rng.uniform(0, 60), rng.uniform(-90, 90)
        a, b, deep = rng.uniform(5, 40), rng.uniform(5, 40), float(rng.integers(1, 15))
        if kind == "hole":
            part, low, high = part - hole((x, y, 0), a, deep), -deep, inf
        elif kind == "pocket":
            part, low, high = part - pocket((x, y, 0), a, b, deep, turned=angle), -deep, inf
        else:
            part, low, high = part | boss((x, y, 0), deep, length=a, width=b, turned=angle), 0, deep
        solids.append((kind, x, y, angle, a, b, low, high))
    return part, solids


@pytest.mark.parametrize("seed", range(20))
def test_distances_of_random_parts_are_exact(seed):
    """The sign is that of plain comparisons, and a distance changes by no more than the way: so it is never too large. The
    surface is where it says, that far in the direction in which it falls: so it is not too small either."""
    part, solids = random_part(seed)
    rng = np.random.default_rng(seed + 1000)
    points = rng.uniform((-15, -15, -30), (115, 75, 25), (300, 3))
    found = part(points)
    assert part.exact and ((found < 0) == inside(solids, points)).all()
    others = points + rng.normal(size=(300, 3)) * rng.choice([0.01, 1, 10], (300, 1))
    assert (np.abs(part(others) - found) <= np.linalg.norm(others - points, axis=1) + 1e-9).all()
    missed = [k for k in range(60) if abs(found[k]) > 0.01 and not foot(part, points[k])[1]]
    assert len(missed) <= 1  # as far from one face as from another there is no direction
    free = points[found > 0.5]
    low, high = part.bounds
    assert (free[(part(free) == 0)].size == 0) and (low <= (0, 0, -20)).all() and (high >= (100, 60, 0)).all()


@pytest.mark.parametrize("seed", range(10))
def test_balls_on_random_parts_touch_and_no_more(seed):
    """Where a ball stops it is its radius off the part, and nowhere before nearer: looked at every 0.05 mm."""
    part, _ = random_part(seed)
    rng = np.random.default_rng(seed)
    for _ in range(10):
        start, ahead = rng.uniform((-30, -30, 30), (130, 90, 60)), np.array([*rng.uniform(-1, 1, 2), -1.0])
        ahead, radius = ahead / np.linalg.norm(ahead), rng.uniform(0.3, 4)
        travel = contact(part, start, ahead, radius, 120)
        way = np.arange(0, 120 if travel is None else travel - 1e-9, 0.05)
        assert (part(start + way[:, None] * ahead) > radius - 1e-9).all()
        if travel is not None:
            assert part(start + travel * ahead)[0] == pytest.approx(radius, abs=1e-9)


def test_a_cut_edge_is_told():
    """A ball less a box is exact on its faces; off the edge between them the surface is farther off than the distance says."""
    part = ball((0, 0, 0), 20) - box((0, -30, -30), (30, 30, 30))
    assert not part.exact and (BLOCK | ball((0, 0, 0), 30)).exact
    assert not (BLOCK - cylinder((0, 30, -10), (100, 30, -10), 3)).exact  # its axis lies across
    on_face = contact(part, (10, 0, 0), (-1, 0, 0), 2, 20)
    assert on_face == pytest.approx(8, abs=EXACT)
    place, sure = foot(part, (2, 0, 0))
    assert sure and place == pytest.approx((0, 0, 0), abs=1e-6)
    place, sure = foot(part, (1.5, 20.5, 0))  # beside the edge at (0, 20, 0)
    assert not sure
    assert foot(HOLED, (50 + 11, 30, 1))[1] and foot(HOLED, (50 + 11, 30, 1))[0] == pytest.approx((62, 30, 0), abs=1e-6)


WRONG = [
    (lambda: hole((50, 30, 0), -24, 10), "diameter of a hole must be greater than 0, got -24"),
    (lambda: hole((50, 30), 24, 10), "centre of a hole must be three numbers"),
    (lambda: hole((50, 30, 0), 24, 0), "depth of a hole must be greater than 0"),
    (lambda: hole((50, nan, 0), 24, 1), "finite number, got nan"),
    (lambda: hole((50, 30, 0), 1e9, 1), "at most 1e[+]06"),
    (lambda: hole((1e9, 30, 0), 1, 1), "largest coordinate .* at most"),
    (lambda: slot((0, 0, 0), (0, 0, 0), 8, 5), "a slot must have a length greater than 0"),
    (lambda: slot((0, 0, 0), (10, 0, 1), 8, 5), "both ends of a slot lie in one face, got Z 0 and Z 1"),
    (lambda: slot((0, 0, 0), (10, 0, 0), 0, 5), "width of a slot must be greater than 0"),
    (lambda: pocket((0, 0, 0), 40, 0, 5), "width of a pocket must be greater than 0"),
    (lambda: pocket((0, 0, 0), 40, 20, 5, corner=11), "corner radius of 11 does not fit into 40 by 20"),
    (lambda: pocket((0, 0, 0), 40, 20, 5, corner=-1), "corner radius of a pocket must be at least 0"),
    (lambda: pocket((0, 0, 0), 40, 20, 5, turned=inf), "angle of a pocket"),
    (lambda: boss((0, 0, 0), 5), "a diameter, or a length and a width"),
    (lambda: boss((0, 0, 0), 5, diameter=3, length=3, width=3), "a diameter, or a length and a width"),
    (lambda: boss((0, 0, 0), 5, length=3), "a diameter, or a length and a width"),
    (lambda: boss((0, 0, 0), 5, diameter=3, corner=1), "neither corners nor an angle"),
    (lambda: boss((0, 0, 0), -5, diameter=3), "height of a boss"),
    (lambda: box((0, 0, 0), (10, 10, 0)), "height of a box must be greater than 0"),
    (lambda: box((0, 0, 0), (10, 10, 10), corner=6), "corner radius of 6 does not fit"),
    (lambda: box((0, 0, "a"), (10, 10, 10)), "must be a number, got 'a'"),
    (lambda: cone((0, 0, 0), (0, 0, 0), 5), "axis of a cone"),
    (lambda: cone((0, 0, 0), (0, 0, 9), 5, -1), "upper radius of a cone"),
    (lambda: BLOCK - 5, "combined with another part, got 5"),
    (lambda: BLOCK.placed(np.eye(3)), "4×4 frame"),
    (lambda: BLOCK.placed("x"), "4×4 frame"),
    (lambda: BLOCK.turned(nan), "angle by which a part is turned"),
    (lambda: BLOCK.turned(5, about=(1, 2, 3)), "two numbers"),
    (lambda: BLOCK.shifted(x="far"), "must be a number"),
    (lambda: foot(BLOCK, (1, 2)), "three numbers"),
]


@pytest.mark.parametrize(("make", "said"), WRONG)
def test_nonsense_is_an_alarm(make, said):
    with pytest.raises(Alarm, match=said):
        make()


def test_bounds():
    """Corners of a turned box by plain trigonometry; what has no end is infinite."""
    c = cos(radians(30))
    low, high = BLOCK.turned(30).bounds
    assert low == pytest.approx((-60 * 0.5, 0, -20)) and high == pytest.approx((100 * c, 100 * 0.5 + 60 * c, 0))
    assert (plane((0, 0, 0), (0, 0, 1)).bounds == [[-inf] * 3, [inf] * 3]).all()
    assert (hole((5, 5, 0), 4, 3).bounds == [[3, 3, -3], [7, 7, inf]]).all()
    assert (BOSS.bounds == [[0, 0, -20], [100, 60, 8]]).all() and (HOLED.bounds == BLOCK.bounds).all()
    assert (BLOCK & box((50, -9, -9), (200, 9, 9))).bounds.tolist() == [[50, 0, -9], [100, 9, 0]]
    lying = cylinder((0, 0, 0), (10, 0, 0), 5)
    assert (lying.bounds[0] <= (1e-9, -5, -5)).all() and (lying.bounds[1] >= (10 - 1e-9, 5, 5)).all()
    slanting = cone((0, 0, 0), (3, 0, 4), 5)
    assert slanting.bounds == pytest.approx(np.array([[-5 * 0.8, -5, -5 * 0.6], [5 * 0.8, 5, 4]]))


def test_on_the_shelf():
    """The README of the shelf names every shape, and the shapes are those of the module."""
    assert inspect.unwrap(mnclab.part.hole) is hole and "pocket" in repr(mnclab.part)
    assert hypot(*mnclab.part.foot(BLOCK, (-3, 30, -5))[0][:2]) == pytest.approx(30, abs=1e-6)
