"""Parts as they came out: what a ball finds of a taper, a bow, roughness and a burr, by plain arithmetic."""

import pickle
from math import cos, nan, radians, sqrt, tan

import numpy as np
import pytest

from mnclab.text.alarm import Alarm
from mnclab.workpiece.part import ball, box, contact, hole, plane

BLOCK = box((0, 0, -20), (100, 60, 0)) - hole((50, 30, 0), 24, 10)
LEFT, RIGHT, DOWN = (-1, 0, 0), (1, 0, 0), (0, 0, -1)


@pytest.mark.parametrize("degrees", [0.5, 2.0, -1.0])
@pytest.mark.parametrize("z", [-3.0, -7.0])
def test_taper(degrees, z):
    """A wall at x = 0 that leans by the angle a stands out by -z·tan a at the height z; the ball touches it r / cos a before.
    The bore is as much narrower: its wall is a cone."""
    part = BLOCK.with_errors(taper=degrees)
    out, r = -z * tan(radians(degrees)), 2.0
    touch = r / cos(radians(degrees))
    assert contact(part, (-20, 30, z), RIGHT, r, 50) == pytest.approx(20 - out - touch, abs=1e-9)
    assert contact(part, (50, 30, z), LEFT, r, 50) == pytest.approx(12 - out - touch, abs=1e-9)
    assert contact(part, (20, 30, 20), DOWN, r, 50) == pytest.approx(18, abs=1e-9)  # faces stay
    assert contact(part, (50, 30, 20), DOWN, r, 50) == pytest.approx(28, abs=1e-9)
    assert part.exact and part.bounds[0, 0] <= -20 * abs(tan(radians(degrees)))


@pytest.mark.parametrize(("bowed", "axis", "out"), [("xy", 0, 1), ("yx", 1, 0), ("xz", 0, 2)])
def test_bow(bowed, axis, out):
    """The middle of the length stands out by the bow, the ends do not, between it is a parabola: 1 - (2·t/l)²."""
    bow, part = 0.04, BLOCK.with_errors(bow=0.04, bowed=bowed)
    low, high = BLOCK.bounds
    for share in (-0.9, -0.5, 0.5, 0.9):
        start, ahead = (low + high) / 2, np.zeros(3)
        start[axis] += share * (high - low)[axis] / 2
        start[out], ahead[out] = high[out] + 10, -1
        found = contact(part, start, ahead, 2, 50)
        assert found == pytest.approx(10 - 2 - bow * (1 - share**2), abs=1e-9)
    assert (part.bounds[1] - high)[out] == pytest.approx(bow)


def test_roughness():
    """No place is off by more than the roughness, most are off; the same seed gives the same surface, another one another."""
    rough = BLOCK.with_errors(roughness=0.01, seed=4)
    starts = [(x, 10, 20) for x in np.linspace(5, 95, 40)]
    off = np.array([18 - contact(rough, start, DOWN, 2, 50) for start in starts])
    assert np.abs(off).max() <= 0.01 + 1e-9 and off.std() > 0.001
    again = BLOCK.with_errors(roughness=0.01, seed=4)
    assert [contact(again, start, DOWN, 2, 50) for start in starts[:5]] == (18 - off[:5]).tolist()
    other = BLOCK.with_errors(roughness=0.01, seed=5)
    assert abs(contact(other, starts[0], DOWN, 2, 50) - (18 - off[0])) > 1e-5
    assert (ball((0, 0, 0), 5) - plane((0, 0, 0), (0, 0, 1))).with_errors(roughness=0.01).exact is False


def test_burr():
    """A ridge 0.2 high and 0.5 wide along the edges of the top, of the bore too; the face within stays."""
    part = BLOCK.with_errors(burr=(0.2, 0.5))
    assert contact(part, (0.25, 10, 20), DOWN, 2, 50) == pytest.approx(18 - 0.2, abs=1e-9)
    assert contact(part, (50 + 12.25, 30, 20), DOWN, 2, 50) == pytest.approx(18 - 0.2, abs=1e-9)
    assert contact(part, (20, 10, 20), DOWN, 2, 50) == pytest.approx(18, abs=1e-9)
    assert contact(part, (1.0, 10, 20), DOWN, 2, 50) == pytest.approx(20 - 0.2 - sqrt(2**2 - 0.5**2), abs=1e-9)  # its edge
    assert contact(part, (-20, 10, 0.1), RIGHT, 2, 50) == pytest.approx(18, abs=1e-9)
    assert part.exact and part.bounds[1, 2] == pytest.approx(0.2)


def test_errors_go_with_the_part():
    """Errors first, then turned by 90 degrees about the origin: what was the side x = 0 is the side y = 0."""
    part = BLOCK.with_errors(taper=1, bow=0.02, roughness=0.003, burr=(0.1, 0.4), seed=2)
    there = part.turned(90)
    start = (-20, 25, -6)
    turned = (-25, -20, -6)
    assert contact(there, turned, (0, 1, 0), 2, 50) == pytest.approx(contact(part, start, RIGHT, 2, 50), abs=1e-9)
    again = pickle.loads(pickle.dumps(part))
    assert contact(again, start, RIGHT, 2, 50) == contact(part, start, RIGHT, 2, 50)


@pytest.mark.parametrize("seed", range(5))
def test_a_distance_never_changes_faster_than_it_says(seed):
    rng = np.random.default_rng(seed)
    part = BLOCK.with_errors(taper=rng.uniform(-3, 3), bow=0.3, roughness=0.05, grain=4, seed=seed, burr=(0.3, 1))
    points = rng.uniform((-15, -15, -30), (115, 75, 25), (500, 3))
    others = points + rng.normal(size=(500, 3)) * rng.choice([0.01, 1, 10], (500, 1))
    assert (np.abs(part(others) - part(points)) <= part.steep * np.linalg.norm(others - points, axis=1) + 1e-9).all()
    assert 1 < part.steep < 1.2


@pytest.mark.parametrize(
    ("part", "errors", "said"),
    [
        (BLOCK, {"taper": 50}, "taper of a part .degrees. must be at most 45"),
        (BLOCK, {"taper": nan}, "finite number"),
        (BLOCK, {"bow": 50, "bowed": "zx"}, "too steep"),
        (BLOCK, {"bow": 1, "bowed": "xx"}, "how a part is bowed must be xy"),
        (BLOCK, {"roughness": -1}, "roughness of a part .mm. must be at least 0"),
        (BLOCK, {"roughness": 1, "grain": 0}, "length of the waves"),
        (BLOCK, {"roughness": 1, "grain": 1}, "an error of 1 mm is too steep"),
        (BLOCK, {"roughness": 0.1, "seed": -1}, "seed of a rough part must be at least 0"),
        (BLOCK, {"roughness": 0.1, "seed": 1.5}, "must be a whole number"),
        (BLOCK, {"burr": (0, 1)}, "height of a burr"),
        (BLOCK, {"burr": (1, -1)}, "width of a burr"),
        (BLOCK, {"burr": 5}, "a burr"),
        (ball((0, 0, 0), 5), {"taper": 1}, "a taper is for parts of upright prisms"),
        (ball((0, 0, 0), 5), {"burr": (1, 1)}, "a burr is for parts of upright prisms"),
        (hole((0, 0, 0), 5, 5), {"taper": 1}, "with a top"),
        (plane((0, 0, 0), (0, 0, 1)), {"bow": 1}, "without ends"),
    ],
)
def test_nonsense_is_an_alarm(part, errors, said):
    with pytest.raises(Alarm, match=said):
        part.with_errors(**errors)
