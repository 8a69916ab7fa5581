"""Rows of a probe past the part: where its ball or its stem meets it, by plain arithmetic."""

import time
from math import nan, sqrt

import numpy as np
import pytest

from mnclab.text.alarm import Alarm
from mnclab.workpiece.part import ball, boss, box, contact, hole

BLOCK = box((0, 0, -20), (100, 60, 0)) - hole((50, 30, 0), 24, 10) | boss((20, 30, 0), 8, diameter=12)
SHELF = box((0, 0, 0), (100, 60, 10)) | box((20, 0, 30), (100, 60, 40))  # a board over another
ROUGHLY = 0.03  # mm


@pytest.mark.parametrize(
    ("start", "end", "travel"),
    [
        ((-10, 10, 5), (110, 10, 5), None),  # over the face
        ((-10, 10, 1.9), (110, 10, 1.9), 10 - sqrt(2**2 - 1.9**2)),  # too low: the upper edge of the side
        ((-10, 30, 5), (110, 30, 5), 10 + 20 - 6 - 2),  # the boss
        ((-10, 10, -5), (110, 10, -5), 8),  # the side
        ((50, 30, -5), (60, 30, -5), None),  # to the wall of the hole, and rests there
        ((50, 30, -5), (61, 30, -5), 10),
        ((60, 30, -5), (50, 30, -5), None),  # from where it rests
        ((-2, 10, -5), (-2, 50, -5), None),  # along the side, resting on it
        ((50, 30, 20), (50, 30, 20), None),
        ((50, 30, -9), (50, 30, -9), 0.0),  # stands in the floor
    ],
)
def test_the_ball(start, end, travel):
    found = BLOCK.blocked(start, end, 2)
    assert found == (None if travel is None else pytest.approx(travel, abs=ROUGHLY))


@pytest.mark.parametrize(
    ("start", "end", "stem", "length", "travel"),
    [
        ((-10, 30, 20), (110, 30, 20), 1.0, 5, None),  # between the boards
        ((-10, 30, 20), (110, 30, 20), 1.0, 9.5, 30 - sqrt(1 - 0.5**2)),  # its end, a ball of the same radius, at the edge
        ((-10, 30, 20), (110, 30, 20), 1.0, 40, 30 - 1.0),  # the upper board
        ((-10, 30, 13), (15, 30, 13), 1.0, 60, None),  # stops before it
        ((-10, 30, 13), (25, 30, 13), 3.0, 60, 30 - 3.0),
        ((50, 30, 15), (50, 30, 35), 1.0, 10, 4.0),  # upwards, the end of the stem first
        ((10, 30, 20), (10, 30, 12), 1.0, 60, None),  # straight down beside it
    ],
)
def test_the_stem(start, end, stem, length, travel):
    found = SHELF.blocked(start, end, 1.5, stem, length)
    assert found == (None if travel is None else pytest.approx(travel, abs=ROUGHLY))


def test_the_first_of_both_counts():
    """The ball is at the wall of the lower step when the stem has not met the upper one, and the other way round."""
    low = box((0, 0, 0), (50, 50, 10)) | box((30, 0, 20), (50, 50, 40))
    assert low.blocked((-10, 25, 5), (50, 25, 5), 2, 1, 50) == pytest.approx(8, abs=ROUGHLY)
    high = box((0, 0, 20), (50, 50, 40)) | box((30, 0, 0), (50, 50, 10))
    assert high.blocked((-10, 25, 5), (50, 25, 5), 2, 1, 50) == pytest.approx(9, abs=ROUGHLY)


@pytest.mark.parametrize("seed", range(10))
def test_stems_on_random_rows(seed):
    """Where no contact is told, no place along the row is in the part: looked at every 0.2 mm of the row and of the stem."""
    rng = np.random.default_rng(seed)
    part = SHELF - ball(rng.uniform((0, 0, 0), (100, 60, 40)), 15)
    for _ in range(10):
        start, end = rng.uniform((-30, -30, 12), (130, 90, 60), (2, 3))
        stem, length = rng.uniform(0.5, 3), rng.uniform(5, 60)
        found = part.blocked(start, end, 3, stem, length)
        way = np.arange(0, 1, 0.2 / np.linalg.norm(end - start))[:, None] * (end - start)
        free = way if found is None else way[np.linalg.norm(way, axis=1) < found - ROUGHLY]
        axis = (start + free)[:, None] + np.arange(0, length, 0.2)[:, None] * (0, 0, 1)
        assert (part(axis.reshape(-1, 3)) > stem - ROUGHLY).all() and (part(start + free) > 3 - ROUGHLY).all()
        if found:
            here = start + found * (end - start) / np.linalg.norm(end - start)
            on_stem = here + np.linspace(0, length, 2000)[:, None] * (0, 0, 1)
            assert min(part(on_stem).min() - stem, part(here)[0] - 3) < ROUGHLY


def test_a_stem_may_lean():
    """Along X, a stem that lies back: it meets nothing where an upright one would."""
    assert SHELF.blocked((-10, 30, 20), (15, 30, 20), 1.5, 1.0, 60) is None
    assert SHELF.blocked((-10, 30, 20), (15, 30, 20), 1.5, 1.0, 60, up=(1, 0, 1)) is not None
    assert SHELF.blocked((-10, 30, 20), (15, 30, 20), 1.5, 1.0, 60, up=(-1, 0, 1)) is None


def test_a_touch_and_the_way_back():
    """After a touch the ball rests on the part: the way back is free, a way on is not."""
    travel = contact(BLOCK, (50, 30, -5), (0.6, 0.8, 0), 1.5, 30)
    there = np.array([50, 30, -5]) + travel * np.array([0.6, 0.8, 0])
    assert travel == pytest.approx(10.5, abs=1e-9)
    assert BLOCK.blocked(there, (50, 30, -5), 1.5, 1, 40) is None
    assert BLOCK.blocked(there, there + (0.06, 0.08, 0), 1.5, 1, 40) is not None


@pytest.mark.parametrize(
    ("given", "said"),
    [
        (((0, 0), (1, 1, 1), 2), "start of a row"),
        (((0, 0, 0), (1, nan, 1), 2), "end of a row"),
        (((0, 0, 0), (1, 1, 1), 0), "radius of a ball must be greater than 0"),
        (((0, 0, 0), (1, 1, 1), 1, -1), "radius of a stem"),
        (((0, 0, 0), (1, 1, 1), 1, 1, -1), "length of a stem"),
    ],
)
def test_nonsense_is_an_alarm(given, said):
    with pytest.raises(Alarm, match=said):
        BLOCK.blocked(*given)


def test_a_stem_of_any_length_is_looked_at_at_once():
    """It meets what hangs a kilometre above the row; a row of parts a thousandth as long costs the same."""
    far = box((50, 0, 999_000), (60, 60, 999_010))
    started = time.process_time()
    assert (BLOCK | far).blocked((-10, 10, 5), (110, 10, 5), 2, 1.0, 1e6) == pytest.approx(60 - 1, abs=ROUGHLY)
    assert BLOCK.blocked((-10, 10, 5), (110, 10, 5), 2, 1.0, 1e6) is None
    assert time.process_time() - started < 2
