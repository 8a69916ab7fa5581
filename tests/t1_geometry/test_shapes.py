"""Rectangles, slots and polygons against their closed forms."""

from itertools import product

import numpy as np
import pytest
from tools.together import together

from mnclab import Alarm
from mnclab.geometry.contours import Contour, arc, polygon, rectangle, slot


def test_rectangle():
    """80 by 60 with corners of 10: area 4800 - (4 - π)·100, perimeter 280 - 8·10 + 2π·10."""
    ring = rectangle(80, 60, 10, centre=(5, 7), angle=np.pi / 6)
    assert ring.area == pytest.approx(4800 - (4 - np.pi) * 100)
    assert ring.length == pytest.approx(280 - 80 + 20 * np.pi)
    assert ring.points[0] == pytest.approx((5 + 40 * np.cos(np.pi / 6), 7 + 20))
    assert rectangle(80, 60, begin=1).points[0] == pytest.approx((0, 30))
    assert rectangle(80, 60).area == pytest.approx(4800)


def test_corners_may_use_up_the_sides():
    assert rectangle(20, 20, 10).area == pytest.approx(np.pi * 100)
    assert rectangle(40, 20, 10).length == pytest.approx(40 + 20 * np.pi)


def test_a_slot_may_go_all_the_way_round():
    """Radii 17 and 23 and two half circles of 3 where it begins and ends, about one place."""
    whole = slot(arc(20, 0.7, 2 * np.pi), 6)
    assert whole.length == pytest.approx(2 * np.pi * (17 + 23 + 3))
    away = np.hypot(*whole.points_within(1e-4).T)
    assert (away.min(), away.max()) == pytest.approx((17, 23), abs=1e-3)


@pytest.mark.parametrize("sweep", [0.3, -2.0, np.pi, 4.0, -2 * np.pi])
def test_an_arc_by_its_angles(sweep):
    line = arc(20, 0.7, sweep)
    assert line.sweeps.sum() == pytest.approx(sweep) and line.radii == pytest.approx(20)
    assert line.points[-1] == pytest.approx([20 * np.cos(0.7 + sweep), 20 * np.sin(0.7 + sweep)])


def test_straight_and_bent_slots():
    """Along a line of 30 and 8 wide: 240 + π·16; about an arc of 90° with r = 20: 20·π/2·8 + π·16."""
    straight = slot(Contour([(0, 0), (30, 0)], closed=False), 8)
    assert straight.area == pytest.approx(240 + 16 * np.pi)
    assert straight.points[0] == pytest.approx((34, 0))
    bent = slot(Contour([(20, 0), (0, 20)], [np.tan(np.pi / 8), 0], closed=False), 8)
    assert bent.area == pytest.approx(80 * np.pi + 16 * np.pi)
    assert bent.length == pytest.approx(24 * np.pi / 2 + 16 * np.pi / 2 + 8 * np.pi)
    assert bent.turns() == pytest.approx(np.zeros(6), abs=1e-9)


def test_polygon():
    """A hexagon in a circle r = 10 has sides of 10."""
    assert polygon(6, 10).length == pytest.approx(60)
    assert polygon(4, 10, centre=(3, 4), angle=np.pi / 4).bounds == pytest.approx(
        np.array([[3, 4], [3, 4]]) + np.sqrt(50) * np.array([[-1, -1], [1, 1]])
    )


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: rectangle(0, 5), "sides"),
        (lambda: rectangle(10, 5, 2.6), "corner radius of 2.6"),
        (lambda: slot(Contour([(0, 0), (9, 0), (9, 9)], closed=False), 2), "one straight line or one arc"),
        (lambda: slot(Contour([(5, 0), (0, 5)], [0.4142, 0], closed=False), 20), "does not fit"),
        (lambda: polygon(2, 5), "at least 3"),
    ],
)
def test_what_is_no_figure(make, message):
    with pytest.raises(Alarm, match=message):
        make()


LINE = Contour([(0, 0), (30, 0)], closed=False)
TAKES_NUMBERS = {
    "length": lambda wrong: rectangle(wrong, 5),
    "width": lambda wrong: rectangle(5, wrong),
    "corner radius": lambda wrong: rectangle(5, 5, wrong),
    "centre of a rectangle": lambda wrong: rectangle(5, 5, centre=wrong),
    "angle of a rectangle": lambda wrong: rectangle(5, 5, angle=wrong),
    "rectangle begins": lambda wrong: rectangle(5, 5, begin=wrong),
    "width of a slot": lambda wrong: slot(LINE, wrong),
    "centre line": lambda wrong: slot(wrong, 5),
    "radius of an arc": lambda wrong: arc(wrong, 0, 1),
    "angle at which": lambda wrong: arc(5, wrong, 1),
    "angle that": lambda wrong: arc(5, 0, wrong),
    "number of corners": lambda wrong: polygon(wrong, 5),
    "radius of a polygon": lambda wrong: polygon(5, wrong),
    "centre of a polygon": lambda wrong: polygon(5, 5, centre=wrong),
    "angle of a polygon": lambda wrong: polygon(5, 5, angle=wrong),
}


@together(
    "what wrong", product(TAKES_NUMBERS, [None, np.nan, np.inf, "5", [1], 10**400]),
    lambda what, wrong: what, lambda what, wrong: repr(wrong)[:9],
)  # fmt: skip
def test_what_is_no_number_is_an_alarm(what, wrong):
    with pytest.raises(Alarm, match=what):
        TAKES_NUMBERS[what](wrong)
