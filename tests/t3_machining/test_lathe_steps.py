"""Grooves, threads and passes of a lathe as steps: places and leads by hand, from the tables of NC-31 and JNC-T01."""

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from mnclab.machining.steps import RAPID, Go, Thread, Wait
from mnclab.machining.turning.roughing import Shoulder, around, exchanged, grooves, loops, places, roughing, towards
from mnclab.machining.turning.threading import lead_along, thread_passes


def ways(steps):
    """x, z and feed of moves; what a move keeps is None."""
    return [(step.x, step.z, getattr(step, "feed", None)) for step in steps]


def test_places():
    assert places(20, 32, 3.5) == (20, 23.5, 27, 30.5, 32)  # NC-31 G75, wide groove
    assert places(20, 35, 6) == (20, 26, 32, 35) and places(50, 35, 6) == (50, 44, 38, 35)  # JNC-T01, example 17
    assert places(5, 5, 2) == (5,) and places(0, 9, None) == (0, 9)


@given(st.integers(-999, 999), st.integers(-999, 999), st.integers(1, 400))
def test_places_cover_the_way(start, last, step):
    found = places(start, last, step)
    assert found[0] == start and found[-1] == last and len(found) == -(-abs(last - start) // step) + 1
    assert all(0 < abs(b - a) <= step for a, b in zip(found, found[1:]))


def test_grooves_in_a_face():
    """Depth is Z there, the side step X; it may be made at feed."""
    steps = list(exchanged(grooves(2, -5, places(20, 25, 5), shift=None)))
    assert ways(steps) == [
        (20, None, None), (None, -5, None), (None, 2, RAPID), (25, None, None), (None, -5, None), (None, 2, RAPID),
        (20, None, RAPID),
    ]  # fmt: skip
    assert steps[3].label == "to groove 2 of 2"


def test_a_lead_is_that_of_the_longer_travel():
    assert lead_along(0, -7, 2) == 2 and lead_along(8, 0, 1.5) == 1.5
    assert lead_along(5, 5, 2) == pytest.approx(2 * math.sqrt(2))


def test_an_internal_taper_thread_with_run_out():
    """In a bore from (10, 2) to (12, -18), 1 deep; the taper widens the begin by 0.5; 2 mm of run-out."""
    steps = list(thread_passes((10, 2), (12, -18), 2, (0.4, 1.0), taper=0.5, run_out=2))
    threads = [step for step in steps if isinstance(step, Thread)]
    assert [step.x for step in steps if isinstance(step, Go) and step.x] == [12.9, 10, 13.5, 10]
    assert [(step.x, step.z) for step in threads] == [(12.45, -16), (10, -18), (13.05, -16), (10, -18)]
    slope = math.hypot(0.45, 18) / 18
    assert [step.pitch for step in threads[::2]] == pytest.approx([2 * slope, 2 * slope])
    assert threads[1].pitch == pytest.approx(2 * math.hypot(2.45, 2) / 2)
    assert [step.label for step in threads[:2]] == ["pass 1 of 2", "pass 1 of 2, run-out"]


def test_around_a_shoulder():
    """NC-31 G70 and its mirror: in, along, bevel, out, back."""
    shoulder = Shoulder(finish=20, corner=-45, rim=25, far=-50)
    for turned in (False, True):
        steps = list(around((30, 2), shoulder, label="contour", wall=RAPID))
        steps = list(exchanged(steps)) if turned else steps
        across, along = ("z", "x") if turned else ("x", "z")
        assert getattr(steps[0], across) == 20 and getattr(steps[1], along) == -45
        assert (getattr(steps[2], across), getattr(steps[2], along)) == (25, -50)
        assert getattr(steps[3], across) == 30 and getattr(steps[4], along) == 2
        assert [step.feed for step in steps] == [RAPID, None, None, RAPID, RAPID]


def test_loops_stay_on_this_side_of_the_start():
    """A retract of 0.5 from 0.2 below the start ends at the start."""
    passes = roughing(10, Shoulder(9.6, -5, 10, -5), 0.2)
    steps = list(loops((10, 0), passes))
    assert [step.x for step in steps if step.x is not None] == [9.8, 10, 9.6, 10]
    assert towards(0, -3, 0.5) == -0.5 and towards(1, 1, 0.5) == 1


def test_a_hole_along_x():
    steps = list(exchanged([Go("drill", 5, None), Thread("cut", -3, 1.25), Wait("dwell", 2)]))
    assert [(step.x, step.z) for step in steps[:2]] == [(5, None), (-3, None)] and steps[1].pitch == 1.25
    assert steps[2] == Wait("dwell", 2)
