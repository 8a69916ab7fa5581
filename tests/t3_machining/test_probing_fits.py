"""Lines, circles and the like through measured points: closed forms, turned and shifted points, and the touches of the
measuring cycles as they were worked out by hand."""

import importlib
import inspect
import math

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from mnclab import Alarm, probing
from mnclab.machining.probing import (
    angle,
    axes_on,
    centre_of_four,
    circle,
    corner,
    line,
    off_the_ball,
    plane,
    rectangle,
    reduced,
    sphere,
    width,
)

PLACE, TURN, SIZE = st.floats(-500, 500), st.floats(-179, 179), st.floats(0.5, 200)


def at(degrees):
    """Unit vectors (…, 2)."""
    return np.stack([np.cos(np.radians(degrees)), np.sin(np.radians(degrees))], axis=-1)


# Lines


def test_a_line_through_two_points():
    """3-4-5: 45 degrees and the quadrants; the middle is the point."""
    found = line([[1, 2], [4, 6]])
    assert (found.x, found.y, found.straightness) == (2.5, 4, 0)
    assert found.angle == pytest.approx(math.degrees(math.atan2(4, 3)))
    assert found.direction == pytest.approx((0.6, 0.8)) and found.normal == pytest.approx((-0.8, 0.6))
    assert found.distance([[1, 2], [0, 0], [-0.8, 0.6], [2.5, 4]]) == pytest.approx([0, -0.4, 0.6, 0])
    assert [line([[0, 0], way]).angle for way in ([1, 0], [0, 1], [-1, 0], [0, -1])] == [0, 90, 180, -90]


@given(x=PLACE, y=PLACE, turn=TURN, offs=st.lists(st.tuples(st.floats(-90, 90), st.floats(-1, 1)), min_size=3, max_size=12))
def test_a_line_near_more_points_is_the_main_axis_of_their_spread(x, y, turn, offs):
    """tan 2α = 2 Sxy / (Sxx - Syy); through the mean; the farthest points left and right of it are the straightness apart."""
    offs = np.array(offs)
    assume(np.ptp(offs[:, 0]) > 5)
    p = (x, y) + offs[:, :1] * at(turn) + offs[:, 1:] * at(turn + 90)
    d = p - p.mean(axis=0)
    sxx, syy, sxy = (d[:, 0] ** 2).sum(), (d[:, 1] ** 2).sum(), (d[:, 0] * d[:, 1]).sum()
    found = line(p)
    assert reduced(found.angle - math.degrees(math.atan2(2 * sxy, sxx - syy) / 2)) == pytest.approx(0, abs=1e-7)
    assert (found.x, found.y) == pytest.approx(tuple(p.mean(axis=0)))
    assert found.straightness == pytest.approx(np.ptp(d @ at(found.angle + 90)), abs=1e-9)


def test_a_line_runs_in_the_order_of_its_points():
    p = np.array([[0, 0.1], [10, -0.1], [20, -0.1], [30, 0.1]])
    assert line(p).angle == pytest.approx(0) and line(p[::-1]).angle == pytest.approx(180)
    assert line(p).straightness == pytest.approx(0.2)


def test_the_angle_of_a_line_without_direction():
    """401 reduces to (-90, 90]; G420 along X gives 0 to 180."""
    assert [reduced(each) for each in (0, 90, -90, 91, -91, 180, 359)] == [0, 90, 90, -89, 89, 0, -1]
    assert reduced(-180, 360) == 180 and reduced(540, 360) == 180 and reduced(190, 360) == -170
    left = angle([-3.7327, 45], [-2.4228, 15])  # G420, left side from top to bottom
    assert reduced(left - 90) + 90 == pytest.approx(92.5, abs=1e-3)


# Circles and balls


@given(x=PLACE, y=PLACE, radius=SIZE, first=TURN, ways=st.lists(st.floats(20, 150), min_size=2, max_size=2),
       by=st.sampled_from(["distance", "power"]))  # fmt: skip
def test_a_circle_through_three_points_is_the_circumscribed_one(x, y, radius, first, ways, by):
    """Its radius is a b c / 4 area; and it is where the points were taken from."""
    p = (x, y) + radius * at(np.array([first, first + ways[0], first + ways[0] + ways[1]]))
    (a, b, c), area = np.linalg.norm(p - np.roll(p, 1, axis=0), axis=1), abs(np.linalg.det(np.column_stack([p, np.ones(3)]))) / 2
    assume(area > 1e-3 * radius**2)
    found = circle(p, by=by)
    assert found.radius == pytest.approx(a * b * c / (4 * area), rel=1e-8)
    assert found.centre == pytest.approx((x, y), abs=1e-7) and found.roundness == pytest.approx(0, abs=1e-7)


def test_three_circles_of_an_oval():
    """(±3, 0), (0, ±4): about the middle by symmetry. Least squares of distances: the mean, 3.5; of powers: √12.5; the middles of
    opposite points with the mean distance: 3.5."""
    p = [[3, 0], [-3, 0], [0, 4], [0, -4]]
    assert circle(p).radius == pytest.approx(3.5) and circle(p).roundness == pytest.approx(1)
    assert circle(p, by="power").radius == pytest.approx(math.sqrt(12.5))
    assert circle(p, by="opposite").diameter == pytest.approx(7)
    assert all(circle(p, by=by).centre == pytest.approx((0, 0), abs=1e-9) for by in ("distance", "power", "opposite"))


def test_a_circle_by_opposite_points():
    """The middles of (10, 0), (-8, 0) and (0, 7), (0, -5): (1, 1); distances √82, √82, √37, √37."""
    found = circle([[10, 0], [-8, 0], [0, 7], [0, -5]], by="opposite")
    assert found.centre == (1, 1) and found.radius == pytest.approx((math.sqrt(82) + math.sqrt(37)) / 2)
    assert found.roundness == pytest.approx(math.sqrt(82) - math.sqrt(37))


@given(x=PLACE, y=PLACE, radius=SIZE, first=TURN, offs=st.lists(st.floats(-0.05, 0.05), min_size=4, max_size=12))
def test_a_circle_near_more_points_has_the_least_squares(x, y, radius, first, offs):
    """Where the sum of squares is least its slopes are 0: the mean distance is the radius, and off-distances times directions
    sum up to nothing."""
    offs = np.array(offs) * radius
    p = (x, y) + (radius + offs)[:, None] * at(first + np.arange(len(offs)) * 360 / len(offs))
    found = circle(p)
    ways = p - found.centre
    away = np.hypot(*ways.T)
    assert found.radius == pytest.approx(away.mean(), rel=1e-12)
    assert ((away - found.radius) / away) @ ways == pytest.approx([0, 0], abs=1e-9 * radius)
    assert found.roundness == pytest.approx(np.ptp(away), abs=1e-12 * (radius + 500))


@given(x=PLACE, y=PLACE, turn=TURN, scale=st.floats(0.01, 100), seed=st.integers(0, 99),
       by=st.sampled_from(["distance", "power"]))  # fmt: skip
def test_a_circle_follows_its_points(x, y, turn, scale, seed, by):
    """Turned, scaled and shifted points have the circle turned, scaled and shifted."""
    p = at(np.arange(6) * 60.0) * (10 + np.random.default_rng(seed).normal(size=(6, 1)) * 0.1)
    moved = np.array([[math.cos(math.radians(turn)), -math.sin(math.radians(turn))],
                      [math.sin(math.radians(turn)), math.cos(math.radians(turn))]]) * scale  # fmt: skip
    one, two = circle(p, by=by), circle(p @ moved.T + (x, y), by=by)
    assert two.centre == pytest.approx(tuple(moved @ one.centre + (x, y)), abs=1e-9 * (scale + 1) + 1e-9)
    assert two.radius == pytest.approx(scale * one.radius) and two.roundness == pytest.approx(scale * one.roundness, abs=1e-9)


def test_a_short_arc_settles():
    """A tenth of a degree of a circle with the radius 1000, and one degree of another with noise of a micrometre."""
    assert circle(1000 * at(np.linspace(0, 10, 9))).radius == pytest.approx(1000, rel=1e-6)
    noisy = 1000 * at(np.linspace(0, 10, 50)) + np.random.default_rng(1).normal(size=(50, 2)) * 1e-6
    assert circle(noisy).centre == pytest.approx((0, 0), abs=0.01)


@given(x=PLACE, y=PLACE, z=PLACE, radius=SIZE, seed=st.integers(0, 99), count=st.integers(4, 20))
def test_a_ball_through_points_of_it(x, y, z, radius, seed, count):
    ways = np.random.default_rng(seed).normal(size=(count, 3))
    ways /= np.linalg.norm(ways, axis=1)[:, None]
    assume(abs(np.linalg.det(ways[1:4] - ways[0])) > 0.1)
    found = sphere(radius * ways + (x, y, z))
    assert found.centre == pytest.approx((x, y, z), abs=1e-7) and found.radius == pytest.approx(radius, rel=1e-7, abs=1e-7)


def test_a_ball_near_points():
    """(±3, 0, 0), (0, ±4, 0), (0, 0, ±5): by symmetry the middle and the mean distance."""
    found = sphere(np.vstack([np.diag([3, 4, 5]), -np.diag([3, 4, 5])]))
    assert found.centre == pytest.approx((0, 0, 0), abs=1e-9) and found.diameter == pytest.approx(8)
    assert found.roundness == pytest.approx(2)


# Widths, rectangles, corners


def test_the_width_of_a_slot():
    assert width([43.005, 20], [57.035, 20], 0).grown(3).numbers == pytest.approx({"x": 50.02, "y": 20, "width": 20.03})  # G408
    assert width([60.65, 50], [39.59, 50]).grown(2).numbers == pytest.approx({"x": 50.12, "y": 50, "width": 25.06})  # 408
    assert width([0, 0], [3, 4]).width == 5 and width([0, 0], [3, 4], 90).width == pytest.approx(4)
    assert width([0, 0], [3, 4], 30).width == pytest.approx(3 * math.cos(math.pi / 6) + 2)


@given(x=PLACE, y=PLACE, long=SIZE, wide=SIZE, turn=TURN, ball=st.floats(0.1, 0.2),
       offs=st.lists(st.floats(-9, 9), min_size=4, max_size=4))  # fmt: skip
def test_a_rectangle_by_four_touches(x, y, long, wide, turn, ball, offs):
    """The ball's centres lie its radius inside the walls, anywhere along them."""
    along, across = at(turn), at(turn + 90)
    p = [(x, y) + s * (size / 2 - ball) * way + off * side for s, size, way, side, off in
         zip((1, -1, 1, -1), (long, long, wide, wide), (along, along, across, across), (across, across, along, along), offs,
             strict=True)]  # fmt: skip
    found = rectangle(p, turn).grown(ball)
    assert (found.x, found.y, found.length, found.width) == pytest.approx((x, y, long, wide), abs=1e-9)


def test_a_rectangle_of_cycle_410_and_411():
    """Touches in the order X, X, Y, Y."""
    pocket = rectangle([[78.14, 50], [22.1, 50], [50, 57.92], [50, 41.9]]).grown(2)
    stud = rectangle([[82.14, 50], [18.1, 50], [50, 61.92], [50, 37.9]]).grown(-2)
    for each in (pocket, stud):
        assert each.numbers == pytest.approx({"x": 50.12, "y": 49.91, "length": 60.04, "width": 20.02, "angle": 0})


CORNERS = {  # ball centres of two touches a side, the sides they were probed to, ball radius -> corner, angle of the first line
    "414": ([[37, 3.27529], [87, 4.58459], [96.7241, 25], [95.54574, 70]], [0, 1], [-1, 0], 2, (95.2, 6.8), 1.5),
    "415": ([[41, 9.41329], [91, 10.72258], [38.6038, 11], [37.42543, 56]], [0, -1], [-1, 0], 2, (36.7, 7.3), 1.5),
    "G414": ([[20, -1.382], [80, 1.2376], [-2.4228, 15], [-3.7327, 45]], [0, 1], [1, 0], 3, (1.2, 0.8), 2.5),
    "G414 upper right":
        ([[30, 63.3069], [80, 62.4341], [104.5508, 20], [104.9872, 45]], [0, -1], [-1, 0], 3, (102.2319, 59.0456), -1),
    "G415": ([[10, 2.9498], [70, 4.5209], [3.3622, 5], [2.4457, 40]], [0, -1], [-1, 0], 3, (0.5, -0.3), 1.5),
    "G415 upper right": ([[90, 59.0632], [30, 57.492], [96.0328, 57], [96.9493, 22]], [0, 1], [1, 0], 3, (98.8951, 62.2971), 1.5),
}  # fmt: skip


@pytest.mark.parametrize("cycle", CORNERS)
def test_a_corner_of_four_touches(cycle):
    """The lines of the balls, moved to the material; the touches were given with four or five decimals."""
    balls, first, second, ball, there, turn = CORNERS[cycle]
    sides = line(balls[:2]).towards(first, ball), line(balls[2:]).towards(second, ball)
    assert corner(*sides).centre == pytest.approx(there, abs=3e-4)
    assert reduced(sides[0].angle) == pytest.approx(turn, abs=2e-4)


@given(x=PLACE, y=PLACE, one=TURN, cross=st.floats(5, 175), ball=st.floats(0, 5))
def test_a_corner_turned_anywhere(x, y, one, cross, ball):
    """Two sides that part at (x, y) at an angle, touched from inside at 10 and 50 along them."""
    a, b = at(one), at(one + cross)
    left, right = at(one + 90), at(one + cross - 90)
    first = line([(x, y) + s * a + ball * left for s in (10, 50)]).towards(-left, ball)
    second = line([(x, y) + s * b + ball * right for s in (10, 50)]).towards(-right, ball)
    assert corner(first, second).centre == pytest.approx((x, y), abs=1e-9)


def test_the_middle_of_four_holes():
    """418; and the diagonals of a square."""
    holes = [[20.05, 25.02], [150.04, 24.97], [149.98, 85.06], [21.97, 80.03]]
    assert centre_of_four(holes).centre == pytest.approx((82.64466, 53.94468), abs=1e-5)
    assert centre_of_four([[0, 0], [2, 0], [2, 2], [0, 2]]).centre == pytest.approx((1, 1))


CIRCLES = {  # ball centres, by, grown by -> x, y, diameter
    "412": ([[85.60493, 50], [67.75211, 80.74756], [32.28782, 80.6784], [14.55507, 50]], "power", 2, (50.08, 49.93, 75.05)),
    "412 three": ([[85.60493, 50], [32.28782, 80.6784], [32.22727, 19.21672]], "power", 2, (50.08, 49.93, 75.05)),
    "413": ([[89.55994, 50], [69.72962, 84.1727], [30.31032, 84.10353], [10.60006, 50]], "power", -2, (50.08, 49.93, 74.96)),
    "421": ([[85.54999, 50], [67.75883, 80.7592], [32.25616, 80.73323], [14.51001, 50]], "power", 2, (50.03, 49.98, 75.04)),
    "430": ([[90.04998, 50.00493], [50.02, 90], [9.99001, 49.99795]], "power", 0, (50.02, 49.97, 80.06)),
    "G412": ([[22.04, -5], [-2, -5], [10, 7.05], [10, -16.99]], "opposite", 3, (10.02, -4.97, 30.04)),
    "G412 small": ([[11.0296, -5], [9.0104, -5], [10, -3.9602], [10, -5.9798]], "opposite", 3, (10.02, -4.97, 8.02)),
    "G413": ([[43.04, 20], [-2.98, 20], [20, 42.97], [20, -3.05]], "opposite", -3, (20.03, 19.96, 40.02)),
}


@pytest.mark.parametrize("cycle", CIRCLES)
def test_circles_of_the_cycles(cycle):
    """Touches as worked out for the cycles, those of MNC with two to four decimals."""
    balls, by, ball, (x, y, diameter) = CIRCLES[cycle]
    found = circle(balls, by=by).grown(ball)
    assert (found.x, found.y, found.diameter) == pytest.approx((x, y, diameter), abs=1e-4 if cycle.startswith("G") else 2e-5)


def test_a_ring_probed_with_the_spindle_turned():
    """G461: middles at 0 and 180 degrees give the offsets (0.12, -0.08), the ring 50 the ball 2.985."""
    sets = ([[321.9301, 199.2], [277.9299, 199.2], [299.93, 222.025], [299.93, 177.995]],
            [[322.1844, 200.01], [278.1556, 200.01], [300.17, 221.865], [300.17, 177.835]])  # fmt: skip
    one, two = (circle(each, by="opposite") for each in sets)
    assert (np.array(two.centre) - one.centre) / 2 == pytest.approx([0.12, -0.08], abs=1e-4)
    assert 25 - (one.radius + two.radius) / 2 == pytest.approx(2.985, abs=1e-4)


def test_the_equator_of_the_calibrating_ball():
    """460: three touches on a meridian; the middle of the circle through them is the equator at Z-2.5."""
    assert circle([[14.37663, -5.325], [14.65167, -2.2], [14.24403, 0.925]]).y == pytest.approx(-2.5, abs=1e-4)


# Off the ball


def test_touched_points_of_the_ball():
    """Along +X and -Z by 2; a plane inclined by 60 degrees is missed by 2 (1 / cos 60 - 1) = 2."""
    assert off_the_ball([[1, 2, 3], [4, 5, 6]], [[1, 0, 0], [0, 0, -9]], 2) == pytest.approx(np.array([[3, 2, 3], [4, 5, 4]]))
    assert off_the_ball([1, 2], [0, -1], 0.5) == pytest.approx([1, 1.5])
    slope = line([[0, 0], [1, math.sqrt(3)]])
    ball = slope.towards(slope.normal, 2)  # its centres, at the left
    assert slope.distance(off_the_ball(ball.centre, [0, -1], 2)) == pytest.approx(1)  # 2 off along Y, which is 1 square to it


# What is no measurement


BAD = [
    (line, [[[1, 1]]], "needs 2 points or more, got 1"),
    (line, [[[1, 1], [1, 1], [1, 1]]], "are all one"),
    (line, [[[0, 0], [1, 0], [1, 1], [0, 1]]], "along no line"),
    (line, [[1, 2, 3]], "an array"),
    (line, [[[1, 2], [3]]], "must be numbers"),
    (line, [[["a", 2], [3, 4]]], "must be numbers"),
    (circle, [[[0, 0], [1, 1]]], "needs 3 points or more"),
    (circle, [[[0, 0], [1, 1], [3, 3]]], "lie on one line"),
    (circle, [[[0, 0], [1, 1], [0, 0], [1, 1]]], "lie on one line"),
    (circle, [[[0, 0], [1, math.nan], [3, 3]]], "must be numbers"),
    (circle, [[[0, 0], [1, 1], [0, 3]], "square"], "not by 'square'"),
    (circle, [[[0, 0], [1, 1], [0, 3]], "opposite"], "needs 4 points, got 3"),
    (sphere, [[[0, 0, 1], [1, 1, 1], [0, 3, 1], [5, 0, 1]]], "lie on one plane"),
    (sphere, [[[0, 0], [1, 1], [0, 3], [5, 0]]], "an array (n, 3)"),
    (plane, [[[0, 0, 0], [1, 1, 1], [3, 3, 3]]], "lie on one line"),
    (plane, [[[0, 0, 0], [1, 0, 0], [0, 1, 0], [1, 1, 0], [0, 0, 1], [1, 0, 1], [0, 1, 1], [1, 1, 1]]], "along no plane"),
    (width, [[1, 1], [1, 1]], "are all one"),
    (width, [[1, 1], [2, 1], math.inf], "a direction"),
    (rectangle, [[[0, 0], [1, 0], [1, 1]]], "needs 4 points, got 3"),
    (rectangle, [[[0, 0], [1, 0], [1, 1], [0, 1], [5, 5]]], "needs 4 points, got 5"),
    (centre_of_four, [[[0, 0], [0, 1], [1, 0], [1, 1]]], "do not cross"),
    (corner, [line([[0, 0], [1, 1]]), line([[5, 0], [6, 1]])], "do not cross"),
    (reduced, [math.nan], "an angle"),
    (angle, [[1, 1], [1]], "must be numbers"),
    (off_the_ball, [[0, 0], [0, 0], 1], "a probing direction"),
    (off_the_ball, [[0, 0], [0, 1], -1], "ball radius"),
    (off_the_ball, [[0, 0], [0, 1, 0], 1], "must go together"),
    (axes_on, [[0, 0, 0]], "the normal"),
    (axes_on, [[0, 0, 1], [0, 0, 1]], "not along each other"),
    (axes_on, [[0, 1]], "three numbers"),
    (line([[0, 0], [1, 0]]).towards, [[1, 0], 1], "points to no side"),
    (line([[0, 0], [1, 0]]).distance, [[1, 0, 5]], "an array"),
]


@pytest.mark.parametrize(("function", "given", "said"), BAD)
def test_what_cannot_be_measured_is_an_alarm(function, given, said):
    with pytest.raises(Alarm) as caught:
        function(*given)
    assert said in caught.value.message


SOME = [[0.0, 0, 0], [1, 0, 0], [0, 1e-300, 0], [1e9, 1, 1], [-1e9, 0, 1]]
ANY = st.one_of(
    st.lists(st.lists(st.floats() | st.integers(), min_size=2, max_size=3), max_size=6),
    st.lists(st.sampled_from(SOME), max_size=8), st.none(), st.text(max_size=3),
)  # fmt: skip


@given(points=ANY, function=st.sampled_from([line, circle, sphere, plane, rectangle, centre_of_four]))
def test_any_points_give_numbers_or_an_alarm(points, function):
    try:
        assert all(math.isfinite(value) for value in function(points).numbers.values())
    except Alarm as alarm:
        assert alarm.message


# How it is told


def test_results_show_three_decimals_and_units():
    assert repr(circle([[5, 0], [-5, 0], [0, 5]])) == "Circle(x=0.000 mm, y=0.000 mm, diameter=10.000 mm, roundness=0.000 mm)"
    assert repr(probing.line([[0, 0], [1, 1]])) == "Line(x=0.500 mm, y=0.500 mm, angle=45.000°, straightness=0.000 mm)"


def test_the_shelf_holds_what_the_package_gives():
    package = importlib.import_module("mnclab.machining.probing")
    assert all(inspect.unwrap(getattr(probing, name)) is getattr(package, name) for name in probing.__all__)


def test_points_in_space_are_seen_from_above():
    assert circle([[5, 0, 1], [-5, 0, 2], [0, 5, -3]]).diameter == pytest.approx(10)
    assert width([0, 0, 1], [4, 0, 9]).width == 4


@pytest.mark.parametrize("given", [1, [(0, 0), (1, 0)], None])
def test_a_corner_is_that_of_two_lines(given):
    with pytest.raises(Alarm, match="a corner is that of two lines, got"):
        corner(given, line([(0, 1), (0, 2)]))
