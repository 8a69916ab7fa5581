"""Contours against closed forms: rectangles with rounded corners, lenses, circles."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from mnclab.geometry.contours import Contour

QUARTER = np.tan(np.pi / 8)  # the bulge of a quarter circle counter-clockwise
HALF_LENS = np.arccos(0.6)  # two circles r = 25, 30 mm apart: half of the angle of each arc

ROUNDED = Contour(  # 50 × 30, corners rounded with r = 5
    [(5, 0), (45, 0), (50, 5), (50, 25), (45, 30), (5, 30), (0, 25), (0, 5)],
    [0, QUARTER] * 4,
)
LENS = Contour([(50, 30), (50, 70)], [np.tan(2 * HALF_LENS / 4)] * 2)
SLOT = Contour([(0, 0), (40, 0), (40, 20), (0, 20)], [0, 1, 0, 1])  # two half circles r = 10


@pytest.mark.parametrize(
    ("contour", "area", "length"),
    [
        (Contour([(0, 0), (4, 0), (4, 3)]), 6, 12),
        (Contour.circle((3, -7), 5), 25 * np.pi, 10 * np.pi),
        (Contour.circle((3, -7), 5, start=1.2, clockwise=True), -25 * np.pi, 10 * np.pi),
        (ROUNDED, 1500 - 4 * 25 + 25 * np.pi, 2 * 40 + 2 * 20 + 10 * np.pi),
        (SLOT, 800 + 100 * np.pi, 80 + 20 * np.pi),
        (LENS, 1250 * HALF_LENS - 600, 4 * 25 * HALF_LENS),  # 559.119 and 92.730
    ],
)
def test_area_and_length_are_exact(contour, area, length):
    assert contour.area == pytest.approx(area, rel=1e-13)
    assert contour.length == pytest.approx(length, rel=1e-13)


def test_a_flat_arc_has_the_area_of_its_piece_of_circle():
    for radius in (1e2, 1e3, 1e5, 1e7):
        sweep = 2 * np.arcsin(1 / radius)  # over the chord 2
        flat = Contour([(0, 0), (2, 0)], [np.tan(sweep / 4), 0])
        series = radius**2 / 2 * (sweep**3 / 6 - sweep**5 / 120)  # r²·(s - sin s)/2
        assert flat.area == pytest.approx(series, rel=1e-9)
    near_limit = [Contour([(0, 0), (2, 0)], [b, 0]).area / b for b in (0.999e-3, 1.001e-3)]
    assert near_limit[0] == pytest.approx(near_limit[1], rel=1e-8)


def test_centre_radius_and_sweep():
    arc = Contour([(2, 0), (0, 2)], [np.tan(3 * np.pi / 8), 0], closed=False)  # 270° about (2, 2)
    assert arc.centres[0] == pytest.approx([2, 2], abs=1e-14)
    assert arc.radii[0] == pytest.approx(2)
    assert arc.sweeps[0] == pytest.approx(3 * np.pi / 2)
    line = Contour([(0, 0), (1, 0)], closed=False)
    assert np.isinf(line.radii[0])
    assert np.isnan(line.centres[0]).all()


def test_bounds_include_the_bulging_arcs():
    assert Contour.circle((3, 4), 5, start=0.3).bounds == pytest.approx(np.array([[-2, -1], [8, 9]]))
    assert SLOT.bounds == pytest.approx(np.array([[-10, 0], [50, 20]]))
    assert LENS.bounds == pytest.approx(np.array([[40, 30], [60, 70]]))
    hollow = Contour([(0, 0), (40, 0), (40, 20), (0, 20)], [0, -1, 0, 0])
    assert hollow.bounds == pytest.approx(np.array([[0, 0], [40, 20]]))


def test_point_and_tangent_along_the_way():
    place, tangent = ROUNDED.point_at(40 + 2.5 * np.pi / 2)  # half way round the corner about (45, 5)
    assert place == pytest.approx([45 + 5 * np.sqrt(0.5), 5 - 5 * np.sqrt(0.5)])
    assert tangent == pytest.approx([np.sqrt(0.5), np.sqrt(0.5)])
    places, _ = ROUNDED.point_at([-1, 1, ROUNDED.length + 1])  # round and round
    assert places[1] == pytest.approx(places[2])
    assert places[0] == pytest.approx([5 - 5 * np.sin(0.2), 5 - 5 * np.cos(0.2)])
    stops, _ = Contour([(0, 0), (3, 4)], closed=False).point_at([-2, 2.5, 99])
    assert stops == pytest.approx(np.array([[0, 0], [1.5, 2], [3, 4]]))


def test_polyline_lies_on_the_contour_and_keeps_the_chord_error():
    polyline = ROUNDED.points_within(0.01)
    assert ROUNDED.distance(polyline).max() < 1e-13
    assert ROUNDED.distance((polyline[1:] + polyline[:-1]) / 2).max() <= 0.01
    assert ROUNDED.distance((polyline[1:] + polyline[:-1]) / 2).max() > 0.005  # and wastes no points
    assert polyline[0] == pytest.approx(polyline[-1])
    with pytest.raises(ValueError, match="chord error"):
        ROUNDED.points_within(0)


def test_distance_and_nearest():
    points = [(25, 12), (45, 5), (60, 35), (25, -3), (-5, 0)]
    from_corners = [np.hypot(15, 10) - 5, np.hypot(10, 5) - 5]  # about (45, 25) and (5, 5)
    assert ROUNDED.distance(points) == pytest.approx([12, 5, from_corners[0], 3, from_corners[1]])
    assert SLOT.nearest((10, -8)) == pytest.approx(10)
    assert SLOT.nearest((70, 10)) == pytest.approx(40 + 5 * np.pi)
    assert LENS.distance([(50, 80)]) == pytest.approx([10])  # beyond a corner: the corner


def test_winding_tells_inside_from_outside():
    ring = SLOT.winding([(-9, 10), (-11, 10), (0, 10), (20, 19.9), (20, 20.1), (49.9, 10), (-9, 1)])
    assert ring.tolist() == [1, 0, 1, 1, 0, 1, 0]
    assert SLOT.reversed().winding([(0, 10)]).tolist() == [-1]
    bitten = Contour([(0, 0), (40, 0), (40, 20), (0, 20)], [0, -1, 0, 0])
    assert bitten.winding([(40, 10), (31, 10), (29.9, 10)]).tolist() == [0, 0, 1]


def test_a_closed_contour_begins_anywhere():
    for way in (0, 5, 40, 43, ROUNDED.length - 1, ROUNDED.length + 12):
        moved = ROUNDED.started_at(way)
        assert moved.points[0] == pytest.approx(ROUNDED.point_at(way)[0])
        assert moved.length == pytest.approx(ROUNDED.length, rel=1e-13)
        assert moved.area == pytest.approx(ROUNDED.area, rel=1e-13)
    assert len(ROUNDED.started_at(40).points) == 8  # at a corner nothing is split
    with pytest.raises(ValueError, match="closed"):
        Contour([(0, 0), (1, 0)], closed=False).started_at(0.5)


def test_a_piece_of_a_contour():
    """Half an arc is an arc of half the sweep; round the begin of a closed contour a piece goes on."""
    quarter = Contour.circle((0, 0), 5).between(2.5 * np.pi, 5 * np.pi)
    assert quarter.points == pytest.approx(np.array([(0, 5), (-5, 0)]))
    assert quarter.sweeps == pytest.approx([np.pi / 2]) and not quarter.closed
    square = Contour([(0, 0), (10, 0), (10, 10), (0, 10)])
    assert square.between(35, 45).points == pytest.approx(np.array([(0, 5), (0, 0), (5, 0)]))
    assert square.between(-5, 5).points == pytest.approx(np.array([(0, 5), (0, 0), (5, 0)]))
    assert square.between(5, 99).length == pytest.approx(40)  # once round at most
    assert Contour([(0, 0), (10, 0)], closed=False).between(4, 99).points == pytest.approx(np.array([(4, 0), (10, 0)]))
    assert square.between(3, 3).length == 0


@pytest.mark.parametrize("closed", [True, False])
def test_a_piece_runs_where_the_contour_runs(closed):
    rng = np.random.default_rng(5)
    for _ in range(100):
        count = int(rng.integers(2, 7))
        bulge = rng.uniform(-2, 2, count) * (rng.random(count) < 0.6)
        whole = Contour(rng.normal(size=(count, 2)) * 10, bulge, closed)
        first, last = np.sort(rng.uniform(0, whole.length, 2))
        if closed and rng.random() < 0.5:
            first, last = last, first + whole.length
        ways = rng.uniform(0, last - first, 9)
        piece = whole.between(first, last)
        assert piece.length == pytest.approx(last - first)
        for one, other in zip(piece.point_at(ways), whole.point_at(first + ways), strict=True):
            assert one == pytest.approx(other, abs=1e-6)


def test_turns_are_the_corners():
    triangle = Contour([(0, 0), (4, 0), (4, 3)])
    expected = [np.pi - np.arctan2(3, 4), np.pi / 2, np.pi - np.arctan2(4, 3)]
    assert triangle.turns() == pytest.approx(expected)
    assert ROUNDED.turns() == pytest.approx(np.zeros(8), abs=1e-15)
    assert LENS.turns() == pytest.approx([np.pi - 2 * HALF_LENS] * 2)


def test_a_mirror_turns_arcs_over_and_unequal_scales_are_refused():
    mirrored = ROUNDED.transformed(np.diag([-1.0, 1.0, 1.0]))
    assert mirrored.bulge == pytest.approx(-ROUNDED.bulge)
    assert mirrored.area == pytest.approx(-ROUNDED.area)
    frame = np.diag([2.0, 2.0, 1.0, 1.0])
    frame[:3, 3] = 7, -3, 99
    assert ROUNDED.transformed(frame).area == pytest.approx(4 * ROUNDED.area)
    assert ROUNDED.transformed(frame).points[0] == pytest.approx([17, -3])
    with pytest.raises(ValueError, match="scales"):
        ROUNDED.transformed(np.diag([2.0, 1.0, 1.0]))
    assert Contour([(0, 0), (1, 0), (1, 1)]).transformed(np.diag([2.0, 1.0, 1.0])).area == pytest.approx(1)


def test_what_is_no_contour_is_refused():
    with pytest.raises(ValueError, match="two points"):
        Contour([(0, 0)])
    with pytest.raises(ValueError, match="bulge"):
        Contour([(0, 0), (1, 1)], [0, 0, 0])
    with pytest.raises(ValueError, match="finite"):
        Contour([(0, 0), (1, np.nan)])


@st.composite
def contours(draw):
    """Stars with any bulges: every angle between the rays is less than half a turn."""
    count = draw(st.integers(3, 9))
    radii = np.array(draw(st.lists(st.floats(1, 50), min_size=count, max_size=count)))
    bulge = draw(st.lists(st.floats(-1, 1), min_size=count, max_size=count))
    angle = 2 * np.pi * np.arange(count) / count
    return Contour(np.stack([radii * np.cos(angle), radii * np.sin(angle)], axis=1), bulge)


@given(contours())
def test_reversed_has_the_opposite_area(contour):
    back = contour.reversed()
    assert back.area == pytest.approx(-contour.area, rel=1e-9, abs=1e-9)
    assert back.length == pytest.approx(contour.length)
    assert back.points[0] == pytest.approx(contour.points[0])
    assert back.point_at(0.3 * contour.length)[0] == pytest.approx(contour.point_at(0.7 * contour.length)[0])


@given(contours(), st.floats(-7, 7), st.floats(-100, 100), st.floats(-100, 100))
def test_turning_and_shifting_keep_area_and_length(contour, angle, x, y):
    c, s = np.cos(angle), np.sin(angle)
    moved = contour.transformed([[c, -s, x], [s, c, y], [0, 0, 1]])
    assert moved.area == pytest.approx(contour.area, rel=1e-9, abs=1e-9)
    assert moved.length == pytest.approx(contour.length)


@given(contours())
def test_area_is_that_of_a_fine_polyline(contour):
    error = 1e-3
    fine = Contour(contour.points_within(error)[:-1])
    assert fine.area == pytest.approx(contour.area, abs=error * contour.length + 1e-9)


def test_columns_are_worked_out_once_and_nobody_writes_into_them():
    contour = Contour([(0, 0), (60, 0), (60, 40), (0, 40)], [0, 0.3, 0, -0.2])
    for name in ("starts", "ends", "chords", "sweeps", "radii", "centres", "lengths", "upto", "bounds"):
        column = getattr(contour, name)
        assert getattr(contour, name) is column
        with pytest.raises(ValueError, match="read-only"):
            column[0] = 0
