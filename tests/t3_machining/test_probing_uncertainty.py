"""The uncertainty of a fit: closed forms of how noise goes through it."""

import math

import numpy as np
import pytest

from mnclab import Alarm, probing
from mnclab.machining.probing.fits import CIRCLES

NOISE = 0.002
QUADRANTS = np.array([[20, 0], [-20, 0], [0, 20], [0, -20.0]])


def close(value):
    """A thousand repeats give a standard deviation to 1 / √2000 = 2.2 %; four times that is never missed with this seed."""
    return pytest.approx(value, rel=0.09)


@pytest.mark.parametrize("by", CIRCLES)
def test_a_circle_of_four_touches(by):
    """The middle of two touches has noise / √2, the mean of four radii noise / 2: so the diameter has the noise of one."""
    found = probing.uncertainty(lambda p: probing.circle(p, by=by), QUADRANTS, NOISE)
    assert found["x"] == close(NOISE / math.sqrt(2)) and found["y"] == close(NOISE / math.sqrt(2))
    assert found["diameter"] == close(NOISE)


def test_a_line_of_two_points_100_apart():
    """The difference of two heights has √2 of the noise, over 100 mm: an angle; also where 180 meets -180."""
    for far in (100, -100):
        found = probing.uncertainty(probing.line, [[0, 0], [far, 0]], NOISE)
        assert found["angle"] == close(math.degrees(NOISE * math.sqrt(2) / 100))
        assert found["y"] == close(NOISE / math.sqrt(2)) and found["straightness"] == 0


def test_noise_along_one_axis_alone():
    found = probing.uncertainty(probing.plane, [[0, 0, 0], [100, 0, 0], [0, 100, 0]], (0, 0, NOISE))
    assert found["x"] == 0 and found["about_y"] == close(math.degrees(NOISE * math.sqrt(2) / 100))


def test_more_points_are_surer():
    """The radius of n touches: noise / √n."""
    touches = 20 * np.stack([np.cos(np.arange(25) * math.tau / 25), np.sin(np.arange(25) * math.tau / 25)], axis=1)
    assert probing.uncertainty(probing.circle, touches, NOISE)["diameter"] == close(2 * NOISE / 5)


def test_fits_of_several_and_numbers():
    corner = [[10, 0], [50, 0], [0, 10], [0, 50.0]]
    found = probing.uncertainty(lambda p: probing.corner(probing.line(p[:2]), probing.line(p[2:])), corner, NOISE)
    assert found["x"] == close(NOISE * math.hypot(50, 10) / 40)  # y at 0 of a line through 10 and 50: (50 y1 - 10 y2) / 40
    assert probing.uncertainty(lambda p: p.mean(), [1.0, 1, 1, 1], NOISE)["value"] == close(NOISE / 2)
    assert set(probing.uncertainty(lambda p: {"depth": p[0]}, [1.0], NOISE)) == {"depth"}


def test_a_seed_shakes_alike_and_is_shown():
    one, two, other = (probing.uncertainty(probing.circle, QUADRANTS, NOISE, seed=seed, repeats=50) for seed in (1, 1, 2))
    assert one == two != other
    assert repr(one).startswith("Uncertainty(x ±0.0") and one.keys() == probing.circle(QUADRANTS).numbers.keys()
    assert not any(probing.uncertainty(probing.circle, QUADRANTS, 0, repeats=3).values())


@pytest.mark.parametrize(
    ("changed", "said"),
    [({"spread": -1}, "0 or more"), ({"spread": math.nan}, "spread"), ({"spread": (1, 2, 3)}, "must go with points (4, 2)"),
     ({"seed": -1}, "seed"), ({"seed": "x"}, "seed"), ({"repeats": 1}, "repeats"), ({"repeats": 2.5}, "repeats"),
     ({"points": [[1, 2], [1, 2]]}, "needs 3 points"), ({"points": "x"}, "points")],
)  # fmt: skip
def test_what_has_no_uncertainty_is_an_alarm(changed, said):
    with pytest.raises(Alarm) as caught:
        probing.uncertainty(**{"fit": probing.circle, "points": QUADRANTS, "spread": NOISE} | changed)
    assert said in caught.value.message
