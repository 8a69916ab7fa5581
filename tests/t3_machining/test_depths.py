"""Levels of infeed: two examples worked out for a control, and what rounding must not do."""

from itertools import pairwise

import pytest
from hypothesis import given
from hypothesis import strategies as st

from mnclab.machining.depths import infeeds


@pytest.mark.parametrize(
    ("surface", "bottom", "step", "levels"),
    [
        (30, 10.1, 5, [25, 20, 15, 10.1]),  # Q1=-20 Q5=+30 Q4=+0.1 Q10=+5
        (0, -19.5, 6, [-6, -12, -18, -19.5]),  # Q1=-20 Q5=0 Q4=0.5 Q10=6
        (0, -20, 5, [-5, -10, -15, -20]),
        (0, -3, 5, [-3]),
        (0, -3, None, [-3]),
        (0, -3, 0, [-3]),
        (2, 2, 5, [2]),
        (-10, -4, 4, [-6, -4]),  # upwards
    ],
)
def test_the_last_level_is_the_rest(surface, bottom, step, levels):
    assert infeeds(surface, bottom, step) == pytest.approx(levels, abs=1e-12)


@pytest.mark.parametrize("step", [0.1, 0.3, 0.7, 1.1, 1e-3])
def test_drift_makes_no_level_of_its_own(step):
    for count in (1, 3, 7, 10, 300):
        bottom = -sum([step] * count)  # added up, so that it misses count * step by its rounding
        levels = infeeds(0.0, bottom, step)
        assert len(levels) == count
        assert levels[-1] == bottom


def test_a_negative_step_is_refused():
    with pytest.raises(ValueError, match="negative"):
        infeeds(0, -5, -1)
    with pytest.raises(ValueError, match="negative"):
        infeeds(0, -5, float("nan"))


@given(st.floats(-50, 50), st.floats(-50, 50), st.floats(0.05, 20))
def test_no_step_is_larger_than_asked_for(surface, bottom, step):
    levels = (surface, *infeeds(surface, bottom, step))
    steps = [abs(b - a) for a, b in pairwise(levels)]
    assert max(steps) <= step + 2e-9
    assert sum(steps) == pytest.approx(abs(bottom - surface), abs=1e-6)
    assert levels[-1] == bottom
