"""A turned body as the next blank: its sides from above, what views show of it, where it stands; numbers by hand."""

import math

import numpy as np
import pytest

from mnclab.geometry.contours import Contour
from mnclab.workpiece.blank import blank
from mnclab.workpiece.turning.revolved import TurnedBlank

# a tube from -30 to 0, radius 20, bore 5; a ball end of radius 20 in front of it would be the second one
TUBE = Contour([(-30, 5), (0, 5), (0, 20), (-30, 20)])
BALL = Contour([(-20, 0), (20, 0)], [0, 1])


def test_sides_of_a_tube_and_of_a_ball():
    tube, ball = TurnedBlank((TUBE,)), TurnedBlank((BALL,))
    x, y = np.array([0.0, 3.0, 10.0, 25.0]), np.array([0.0, 4.0, 0.0, 0.0])
    low, high = tube.faces(x, y)
    assert np.isnan(low[[0, 3]]).all() and low[[1, 2]].tolist() == [-30, -30] and high[[1, 2]].tolist() == [0, 0]
    low, high = ball.faces(x, y)
    assert high[:3] == pytest.approx([20, math.sqrt(400 - 25), math.sqrt(300)], abs=1e-12)
    assert low[:3] == pytest.approx(-high[:3]) and np.isnan(high[3])
    assert ball.volume == pytest.approx(4 / 3 * math.pi * 8000, rel=1e-12)
    assert tube.volume == pytest.approx(math.pi * (400 - 25) * 30, rel=1e-12)


def test_a_cone_and_an_arc_that_is_only_a_piece_of_its_circle():
    """A cone of 10 to 20 over 10 mm; a quarter fillet of 4 about (-6, 14): at radius 12 it stands at -6 - √(16 - 4)."""
    cone = TurnedBlank((Contour([(-10, 0), (0, 0), (0, 10), (-10, 20)]),))
    assert cone.faces(np.array([5.0, 15.0]), np.zeros(2))[1] == pytest.approx([0, -5])
    quarter = -math.tan(math.pi / 8)
    points = [(-30, 0), (0, 0), (0, 10), (-6, 10), (-10, 14), (-10, 20), (-30, 20)]
    shaft = TurnedBlank((Contour(points, [0, 0, 0, quarter, 0, 0, 0]),))
    high = shaft.faces(np.array([9.0, 12.0, 16.0, 20.0]), np.zeros(4))[1]
    assert high == pytest.approx([0, -6 - math.sqrt(12), -10, -10], abs=1e-12)


def test_elsewhere_it_is_the_same():
    there = TurnedBlank((TUBE,)).moved((100, 50, -7))
    assert there.axis_x == 100 and there.bounds.tolist() == [[80, 30, -37], [120, 70, -7]]
    assert there.faces(np.array([110.0]), np.array([50.0]))[1] == [-7]
    assert there.volume == pytest.approx(TurnedBlank((TUBE,)).volume) and blank(there) is there


def test_what_views_show():
    """From the side two halves of the tube, 30 by 15 each; from the front circles of 20 and 5; rims at their radii."""
    tube = TurnedBlank((TUBE,)).moved((1, 2, 0))
    side = [Contour(line[:-1]) for line in tube.outline(0, 2)]
    assert sorted(abs(each.area) for each in side) == pytest.approx([450, 450])
    front = tube.outline(0, 1)
    assert [float(np.ptp(ring[:, 0])) / 2 for ring in front] == pytest.approx([20, 5])
    rims = [line for line in tube.edges() if np.ptp(line[:, 2]) == 0 and np.allclose(line[0], line[-1])]
    assert sorted(float(np.hypot(*(rim[0, :2] - (1, 2)))) for rim in rims) == pytest.approx([5, 5, 20, 20])
