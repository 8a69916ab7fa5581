"""Bores and threads milled in helices: radii, turns, levels and tangents; numbers of TNC 620, 5.6 and 5.9, and MNC 9.9."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from mnclab.controls.tnc_620.machining.thread_milling import centre_feed, countersink, helices, mill_thread, path_of
from mnclab.machining.depths import TooMany
from mnclab.machining.holes import bore_milling, steepest_pitch, tap, turns
from mnclab.machining.steps import Go, Orient, Spin, Thread, Turn, Wait

positive = st.integers(1, 2000).map(lambda n: n / 100)


@given(depth=positive, radius=positive, pitch=positive, sense=st.sampled_from([1, -1]), by_arc=st.booleans())
def test_a_bore_is_a_helix_and_a_circle(trace, depth, radius, pitch, sense, by_arc):
    found = trace(bore_milling(-depth, above=1, radius=radius, pitch=pitch, sense=sense, feed=300, by_arc=by_arc), 1)
    named = {step.label: (step, point) for step, point in found}
    helix, (x, y, z) = named["helix"]
    assert helix.angle == pytest.approx(sense * math.tau * (1 + depth) / pitch) and z == -depth
    assert math.hypot(x, y) == pytest.approx(radius)
    assert (
        math.atan2(y, x) == pytest.approx(math.remainder(helix.angle, math.tau), abs=1e-6)
        or abs(abs(math.remainder(helix.angle, math.tau)) - math.pi) < 1e-6
    )
    assert named["circle at the bottom"][0].angle == sense * math.tau
    assert found[-1][1] == pytest.approx((0, 0, -depth), abs=1e-6 * radius)
    assert named["to the wall"][1] == pytest.approx((radius, 0, 1), abs=1e-9)


def test_a_bore_as_wide_as_the_tool_is_drilled():
    assert list(bore_milling(-5, above=1, radius=0, pitch=1, sense=1, feed=100)) == [Go("drill", -5, 100)]


def test_turns_are_counted_and_too_many_refused():
    assert turns(82, 1.5) == pytest.approx(54.6667, abs=1e-4)  # MNC 9.9
    for pitch in (1e-9, float("nan"), 0.0):
        with pytest.raises(TooMany):
            turns(82, pitch)


def test_a_plunge_angle_limits_the_turn():
    """One turn unrolled: the angle between 2 pi r and the infeed; 45 degrees make them equal."""
    assert steepest_pitch(3, 45) == pytest.approx(6 * math.pi)
    assert steepest_pitch(3, 0) == steepest_pitch(3, 90) == math.inf


@pytest.mark.parametrize(
    ("step", "upwards", "runs"),
    [  # TNC 620, 5.6: pitch 1.5, thread from 30 down to 10
        (0, True, [(10, 11.5)]),
        (0, False, [(11.5, 10)]),
        (1, True, [(10, 31)]),
        (1, False, [(31, 10)]),
        (4, True, [(10, 11.5), (16, 17.5), (22, 23.5), (28, 29.5)]),
        (4, False, [(29.5, 28), (23.5, 22), (17.5, 16), (11.5, 10)]),
    ],
)
def test_helices_of_a_thread(step, upwards, runs):
    assert helices(20, 1.5, 10, upwards, step) == runs


def test_a_thread_milled_in_one_turn(trace):
    """5.6 with a tool of radius 3 in a thread of 10: r 2, half circles of 1 from the axis, rise 0.375, feed 500 * 4 / 10."""
    path = path_of(10, 3, 1.5)
    assert path == (2, 1, 0)
    steps = mill_thread(path, helices(20, 1.5, 10, True), pitch=1.5, sense=1, feed=centre_feed(500, 10, 3),
                        approach_feed=180, position_feed=750)  # fmt: skip
    found = trace(steps, 32)
    assert [point for _, point in found] == [
        pytest.approx(point, abs=1e-9) for point in [(0, 0, 10), (0, 0, 9.625), (2, 0, 10), (2, 0, 11.5), (0, 0, 11.5)]
    ]
    assert [step.feed for step, _ in found] == [750, 750, 180, 200, 200]


def test_a_thread_milled_downwards_from_above(trace):
    """5.9: 11 turns clockwise from 30.5 to 14, compensation to 30.875."""
    runs = helices(16, 1.5, 14, False, 1)
    assert runs == [(30.5, 14)]
    found = trace(
        mill_thread(path_of(10, 3, 1.5), runs, pitch=1.5, sense=-1, feed=1, approach_feed=1, position_feed=750), 32
    )
    assert found[1][1] == (0, 0, 30.875)
    assert found[3][0].angle == pytest.approx(-11 * math.tau) and found[3][1] == pytest.approx((2, 0, 14))


def test_a_narrow_tool_begins_beside_the_thread(trace):
    """5.6: nominal 30, R 5: r 10, start at 7, half circles of 1.5, rise 0.1125."""
    path = path_of(30, 5, 1.5)
    assert path == (10, 1.5, 7)
    found = trace(mill_thread(path, [(0, 1.5)], pitch=1.5, sense=1, feed=1, approach_feed=1, position_feed=1))
    assert [found[k][1] for k in (0, 1)] == [(0, 0, 0), (7, 0, 0)] and found[2][1][2] == pytest.approx(-0.1125)
    assert found[-1][0].label == "back to the axis" and found[-1][1][:2] == (0, 0)


def tangent(step, before):
    """Which way a turn sets out from a point, and which way it arrives."""
    spoke = np.array(before[:2]) - step.centre
    sense = math.copysign(1, step.angle)
    c, s = math.cos(step.angle), math.sin(step.angle)
    end = np.array([c * spoke[0] - s * spoke[1], s * spoke[0] + c * spoke[1]])
    return [np.array([-v[1], v[0]]) / np.linalg.norm(v) * sense for v in (spoke, end)]


@given(nominal=st.integers(6, 60), external=st.booleans(), sense=st.sampled_from([1, -1]), pitch=positive)
def test_half_circles_join_the_helix_tangentially(trace, nominal, external, sense, pitch):
    path = path_of(nominal, 2.5, pitch, external)
    steps = mill_thread(path, helices(9, pitch, 0, True, 1), pitch=pitch, sense=sense, feed=1, approach_feed=1,
                        position_feed=1, external=external)  # fmt: skip
    found = trace(steps)
    if external:  # the tool comes to the start point, beside the axis by path.start
        found = trace([Go("", x=path.start, y=0.0), *(step for step, _ in found)])
    turning = [
        (step, before) for (_, before), (step, _) in zip(found, found[1:], strict=False) if isinstance(step, Turn)
    ]
    for (one, at), (other, then) in zip(turning, turning[1:], strict=False):
        assert tangent(one, at)[1] == pytest.approx(tangent(other, then)[0], abs=1e-6)
    helix = next(point for step, point in turning if step.label == "helix")
    assert math.hypot(*helix[:2]) == pytest.approx(nominal / 2 + (2.5 if external else -2.5))


@pytest.mark.parametrize("external", [False, True])
def test_a_countersink_is_a_full_circle(trace, external):
    path = path_of(20, 5, 2, external)
    start = [Go("", x=path.start, y=0.0)] if external else []
    found = trace([*start, *countersink(path, 7, sense=1, feed=1, external=external)])
    circle = next(point for step, point in found if step.label == "countersink")
    assert circle == pytest.approx((7, 0, 0), abs=1e-9)
    assert found[-1][1] == pytest.approx((path.start if external else 0, 0, 0), abs=1e-9)


# --- tapping ----------------------------------------------------------------------------------------------------------


def kinds(steps):
    return [(type(step).__name__, *step[1:]) for step in steps]


def test_tapping_reverses_at_both_ends():
    """MNC 9.2: dwell, then reversal; TNC 620, 5.2: reversal, then dwell."""
    first = kinds(tap([-15], above=5, pitch=1.25, sense=1, end=1, dwell=0.5))
    then = kinds(tap([-15], above=5, pitch=1.25, sense=1, end=1, dwell=0.5, dwell_first=False))
    assert first == [
        ("Spin", 1, None), ("Thread", -15, 1.25, None), ("Wait", 0.5),
        ("Spin", -1, None), ("Thread", 5, 1.25, None), ("Spin", 1, None),
    ]  # fmt: skip
    assert then == [first[k] for k in (0, 1, 3, 2, 4, 5)]


def test_tapping_with_chip_breaking():
    """TNC 620, 5.4: depths of 5 in 12, back by 2 pitches of 1.5 at twice the speed; oriented before."""
    steps = list(tap([-5, -10, -12], above=2, pitch=1.5, sense=-1, end=0, speed=300, out_speed=600, back=3, angle=30))
    assert isinstance(steps[0], Orient) and steps[0].angle == 30
    assert [step.z for step in steps if isinstance(step, Thread)] == [-5, -2, -10, -7, -12, 2]
    spins = [(step.turning, step.speed) for step in steps if isinstance(step, Spin)]
    assert spins == [(-1, 300), (1, 600)] * 3 + [(0, 300)]
    assert not any(step.seconds for step in steps if isinstance(step, Wait))


def test_without_a_distance_back_the_tap_leaves_the_hole():
    steps = tap([-5, -10], above=2, pitch=1, sense=1, end=0)
    assert [step.z for step in steps if isinstance(step, Thread)] == [-5, 2, -10, 2]
