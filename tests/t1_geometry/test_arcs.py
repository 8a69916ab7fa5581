"""Arcs: centre and sweep against the circle they come from."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from mnclab.geometry.arcs import centre_from_radius, sweep
from mnclab.geometry.curves import Element, meet

angle = st.floats(-3.1, 3.1)
radius = st.floats(0.1, 500)
place = st.tuples(st.floats(-100, 100), st.floats(-100, 100))


def on_circle(centre, r, a):
    return np.array(centre) + r * np.array([np.cos(a), np.sin(a)])


@given(place, radius, angle, st.floats(0.05, 3.09), st.sampled_from([1, -1]), st.booleans())
def test_centre_and_sweep_come_back(centre, r, begin, turn, sense, long):
    """An arc below half a turn has a positive radius, one above a negative radius."""
    total = sense * (2 * np.pi - turn if long else turn)
    start, end = on_circle(centre, r, begin), on_circle(centre, r, begin + total)
    found, shortage = centre_from_radius(start, end, -r if long else r, sense)
    assert shortage < 0
    assert np.allclose(found, centre, atol=1e-7 * r + 1e-8)
    assert np.isclose(sweep(start, end, centre, sense), total, atol=1e-9)


def test_many_arcs_at_once():
    start, end = np.array([[50.0, 85], [90, 45]]), np.array([[90.0, 45], [110, 65]])
    found, _ = centre_from_radius(start, end, [-40, 20], [1, -1])  # MNC 3.4, two arcs by radius
    assert np.allclose(found, [[50, 45], [110, 45]])
    assert np.allclose(np.degrees(sweep(start, end, found, [1, -1])), [270, -90])


def test_shortage_of_a_radius():
    _, shortage = centre_from_radius([0, 0], [10, 0], 4, 1)
    assert shortage == 1


def test_start_on_end_is_a_full_turn():
    assert np.isclose(sweep([1, 0], [1, 0.0005], [0, 0], -1), -2 * np.pi)


def line(q, t):
    return Element(np.array([q], float), np.array([t], float), np.full((1, 2), np.nan), np.array([np.nan]))


def circle(c, r):
    return Element(np.array([c], float), np.array([[1.0, 0.0]]), np.array([c], float), np.array([float(r)]))


@given(place, angle, radius, radius, st.floats(0.05, 0.95))
def test_circles_meet_on_both(c1, a, r1, r2, share):
    """The gap of the centres lies between |r1 - r2| and r1 + r2."""
    c2 = on_circle(c1, abs(r1 - r2) + share * 2 * min(r1, r2), a)
    p = meet(circle(c1, r1), circle(c2, r2), np.array([c1], float))[0]
    assert np.isclose(np.hypot(*(p - c1)), r1) and np.isclose(np.hypot(*(p - c2)), r2)


def test_lines_and_circles():
    assert np.allclose(meet(line((0, 1), (1, 0)), line((5, 0), (0, 1)), np.zeros((1, 2))), [[5, 1]])
    near = np.array([[10.0, 0]])
    assert np.allclose(meet(line((0, 3), (1, 0)), circle((0, 0), 5), near), [[4, 3]])
    assert np.isnan(meet(line((0, 6), (1, 0)), circle((0, 0), 5), near)).all()
