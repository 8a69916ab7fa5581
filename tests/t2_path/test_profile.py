"""The trapezoid planner against closed forms, and the properties that every profile must have.

Times are seconds, lengths mm. For one straight move of length L at V with acceleration a from stop to stop:
`L/V + V/a` when the feed is reached (L >= V²/a), else `2 sqrt(L/a)`.
"""

import math
from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import mnclab
from mnclab import Alarm, Kind, Limits, Setup, Toolpath
from mnclab.path.profile import Profile
from mnclab.path.profile.lookahead import reachable, running_sum


def path(*points, kind=Kind.LINE, **columns):
    """A path through points; columns are one value for all rows or one a row."""
    n = len(points) - 1
    whole = {"kind": kind, "feed": 6000.0, **columns}
    arrays = {name: np.broadcast_to(np.asarray(value), (n, *np.shape(value)[1:])) for name, value in whole.items()}
    return Toolpath.chain(np.array(points, dtype=float), arrays)


def trapezoid(length, v, a):
    return length / v + v / a if length >= v * v / a else 2 * math.sqrt(length / a)


# --- single moves ----------------------------------------------------------------------------------------------------


def test_single_moves_keep_to_the_closed_form():
    rng = np.random.default_rng(1)
    n = 5000
    length, feed, a = 10 ** rng.uniform(-3, 3, n), 10 ** rng.uniform(0, 4, n), 10 ** rng.uniform(1, 4, n)
    for k in rng.integers(0, n, 20):  # each by itself
        profile = Profile(path((0, 0, 0), (length[k], 0, 0), feed=feed[k]), Limits(rapid=1e6, acceleration=a[k]))
        assert profile.time == pytest.approx(trapezoid(length[k], feed[k] / 60, a[k]), abs=1e-9)
    xyz = np.stack([np.append(0, np.cumsum(length)), np.zeros(n + 1), np.zeros(n + 1)], axis=1)
    for each in (10.0, 250.0, 8000.0):  # all of them, with exact stops
        row = path(*xyz, feed=feed, exact=np.ones(n, dtype=bool))
        profile = Profile(row, Limits(rapid=1e6, acceleration=each))
        expected = [trapezoid(x, v / 60, each) for x, v in zip(np.diff(xyz[:, 0]), feed, strict=True)]
        assert np.abs(profile.seconds - expected).max() < 1e-9


def test_a_diagonal_is_as_fast_as_its_slowest_axis():
    limits = Limits(rapid=(3000, 6000, 1200), acceleration=(100, 50, 20))
    # 3-4-0 direction: v = min(50 / 0.6, 100 / 0.8) = 83.333, a = min(100 / 0.6, 50 / 0.8) = 62.5
    profile = Profile(path((0, 0, 0), (300, 400, 0), feed=60_000.0), limits)
    assert profile.time == pytest.approx(trapezoid(500, 250 / 3, 62.5), abs=1e-9)


# --- corners ---------------------------------------------------------------------------------------------------------

CORNER = ((0, 0, 0), (100, 0, 0), (100, 100, 0))


@pytest.mark.parametrize(
    ("limits", "speed"),
    [
        # |Δu| = sqrt 2, max |Δu_k| / a_k = 1/1000: v² = 8 · 0.01 / (sqrt 2 / 1000)
        (Limits(corner_tolerance=0.01), math.sqrt(8 * 0.01 * 1000 / math.sqrt(2))),
        # legs at 90°: sin 45° = 0.70711, v² = 1000 · 0.01 · 0.70711 / (1 - 0.70711)
        (
            Limits(corner_tolerance=0.01, corner_speed="deviation"),
            math.sqrt(10 * math.sqrt(0.5) / (1 - math.sqrt(0.5))),
        ),
        (Limits(corner_speed="jump", corner_jump=(300, 600, 0)), 5.0),
        (Limits(), 0.0),
    ],
)
def test_corner_speed(limits, speed):
    profile = Profile(path(*CORNER), limits)
    assert profile.plan.v[1] == pytest.approx(speed, abs=1e-12)
    assert Profile(path(*CORNER, exact=True), limits).plan.v[1] == 0


def test_what_runs_straight_on_is_no_corner():
    one = Profile(path((0, 0, 0), (90, 0, 0)), Limits()).time
    assert Profile(path((0, 0, 0), (30, 0, 0), (60, 0, 0), (90, 0, 0)), Limits()).time == pytest.approx(one, abs=1e-12)


def test_an_event_stops_the_tool_and_takes_its_time():
    kinds = np.array([1, 4, 1], dtype=np.uint8)
    line = path((0, 0, 0), (30, 0, 0), (30, 0, 0), (60, 0, 0), kind=kinds, time=np.array([np.nan, 0.5, np.nan]))
    profile = Profile(line, Limits())
    assert profile.time == pytest.approx(2 * trapezoid(30, 100, 1000) + 0.5, abs=1e-12)
    assert profile.at(profile.starts[1] + 0.25).v == 0


# --- arcs ------------------------------------------------------------------------------------------------------------


def circle(radius, turns=1.0, rise=0.0, feed=60_000.0):
    start, end = np.array([radius, 0, 0]), np.array([radius * math.cos(2 * math.pi * turns), 0, rise])
    end[1] = radius * math.sin(2 * math.pi * turns)
    return path(start, end, kind=Kind.ARC, centre=np.zeros((1, 3)), sweep=2 * math.pi * turns, feed=feed)


@pytest.mark.parametrize(("turns", "rise"), [(1.0, 0.0), (0.3, 0.0), (3.0, 12.0), (0.5, 40.0)])
@pytest.mark.parametrize("jerk", [None, 30_000.0])
def test_no_axis_exceeds_its_limits_on_an_arc(turns, rise, jerk):
    limits = Limits(rapid=(9000, 6000, 2000), acceleration=(900, 500, 200), jerk=jerk)
    profile = Profile(circle(20, turns, rise), limits)
    now = profile.at(np.linspace(0, profile.time, 20_001))
    assert (np.abs(now.velocity).max(axis=0) <= limits.axes("rapid") * (1 + 1e-6)).all()
    assert (np.abs(now.acceleration).max(axis=0) <= limits.axes("acceleration") * (1 + 1e-6)).all()
    assert (now.v**2 <= 900 * 20 * (1 + (rise / (40 * math.pi * turns)) ** 2) * (1 + 1e-6)).all()


def test_a_slow_arc_runs_at_its_feed():
    profile = Profile(circle(20, feed=600.0), Limits())
    assert profile.time == pytest.approx(trapezoid(40 * math.pi, 10, profile.plan.rows.a[0]), rel=1e-9)
    assert profile.plan.rows.a[0] == pytest.approx(math.sqrt(1000**2 - (10**2 / 20) ** 2))


# --- feeds -----------------------------------------------------------------------------------------------------------


def test_an_arc_whose_ends_miss_its_circle_has_no_corners_within():
    turn = {"kind": Kind.ARC, "centre": np.zeros((1, 3)), "sweep": 2 * math.pi, "feed": 500.0}
    profile = Profile(path((0.049208, -0.008866, 0), (0.049294, -0.008373, 0), **turn), Limits())
    assert 2 * math.pi * 0.05 / (500 / 60) < profile.time < 0.1


def test_feed_per_revolution_and_override():
    limits = Limits(spindle=1000)
    line = path((0, 0, 0), (100, 0, 0), feed=400.0, per_rev=0.2, spindle=2000.0)
    assert Profile(line, limits).time == pytest.approx(trapezoid(100, 0.2 * 1000 / 60, 1000))
    assert Profile(line, limits, override=0.5).time == pytest.approx(trapezoid(100, 0.1 * 1000 / 60, 1000))
    with pytest.raises(Alarm, match="override"):
        Profile(line, limits, override=0)


def test_inverse_time():
    assert Profile(path((0, 0, 0), (100, 0, 0), feed=np.nan, time=4.0), Limits()).time == pytest.approx(
        trapezoid(100, 25, 1000)
    )


def test_constant_cutting_speed():
    # facing from x = 50 to x = 10 at 200 m/min and 0.2 mm/rev: the revolutions needed are L / 0.2, and a revolution at
    # radius x takes 2 π x / (200 000 / 60) s, so the time is ∫ 2 π x dx / 0.2 / 3333.33 = π (50² - 10²) / 666.67
    line = path((50, 0, 0), (10, 0, 0), per_rev=0.2, surface=200.0, feed=1.0)
    profile = Profile(line, Limits(acceleration=1e9))
    assert profile.time == pytest.approx(math.pi * (50**2 - 10**2) / (200_000 / 60 * 0.2), rel=1e-3)


def test_a_thread_keeps_its_pitch_under_any_override():
    thread = path((0, 0, 0), (0, 0, -30), feed=1500.0, synchronous=True)
    assert Profile(thread, Limits(), override=0.5).time == pytest.approx(trapezoid(30, 25, 1000))


# --- rapids ----------------------------------------------------------------------------------------------------------

UNEVEN = Limits(rapid=(6000, 3000, 1500), acceleration=(500, 1000, 250))


def test_rapid_of_each_axis_by_itself():
    rapid = path((0, 0, 0), (100, 10, -20), kind=Kind.RAPID, feed=np.inf)
    axes = [trapezoid(100, 100, 500), trapezoid(10, 50, 1000), trapezoid(20, 25, 250)]
    profile = Profile(rapid, UNEVEN, rapid_motion="axes")
    assert profile.time == pytest.approx(max(axes), abs=1e-12)
    now = profile.at(np.array([*axes, 0.1]))
    assert now.position[1, 1] == pytest.approx(10, abs=1e-12)  # Y has arrived, X and Z have not
    assert now.position[2, 2] == pytest.approx(-20, abs=1e-12)
    assert now.position[1, 0] < 100
    # after 0.1 s X and Z still speed up, a t² / 2; Y has run at 50 mm/s since 0.05 s
    assert now.position[3] == pytest.approx([2.5, 1.25 + 0.05 * 50, -1.25], abs=1e-12)


def test_rapid_along_the_line():
    rapid = path((0, 0, 0), (60, 80, 0), kind=Kind.RAPID, feed=np.inf)
    # u = 0.6, 0.8: v = min(100 / 0.6, 50 / 0.8) = 62.5, a = min(500 / 0.6, 1000 / 0.8) = 833.33
    assert Profile(rapid, UNEVEN).time == pytest.approx(trapezoid(100, 62.5, 2500 / 3), abs=1e-12)
    assert Profile(rapid, UNEVEN, rapid_motion="axes").time == pytest.approx(trapezoid(80, 50, 1000), abs=1e-12)


def test_proportional_rapid_is_straight_but_for_acceleration():
    rapid = path((0, 0, 0), (200, 80, 0), kind=Kind.RAPID, feed=np.inf)
    profile = Profile(rapid, UNEVEN, rapid_motion="proportional")
    now = profile.at(np.linspace(0.3, 1.5, 20))  # X takes 2.2 s, 0.2 s of it to reach 100 mm/s
    assert np.allclose(now.velocity[:, 1] / now.velocity[:, 0], 0.4)


# --- every profile ---------------------------------------------------------------------------------------------------

number = st.floats(-50, 50, allow_subnormal=False)
points = st.lists(st.tuples(number, number, number), min_size=2, max_size=12)


@settings(max_examples=60, deadline=None)
@given(
    points,
    st.floats(1, 1e5),
    st.floats(1, 1e4),
    st.sampled_from([0.0, 1e-3, 0.1]),
    st.sampled_from(["tolerance", "deviation"]),
    st.sampled_from([None, 1e3, 1e5]),
    st.sampled_from(["line", "axes", "proportional"]),
)
def test_blocks_sum_up_and_places_meet_the_ends(corners, feed, a, tolerance, corner, jerk, motion):
    kinds = np.array([k % 3 == 0 for k in range(len(corners) - 1)], dtype=np.uint8)  # RAPID is 0, LINE is 1
    limits = Limits(acceleration=a, corner_tolerance=tolerance, corner_speed=corner, jerk=jerk)
    profile = Profile(path(*corners, kind=kinds, feed=feed), limits, rapid_motion=motion)
    scale = max(1.0, profile.time)
    assert abs(profile.seconds.sum() - profile.time) < 1e-9 * scale
    if not len(profile):
        return
    assert abs(profile.t[-1] - profile.time) < 1e-9 * scale
    assert np.abs(profile.at(profile.starts[1:]).position - profile.path.end).max() < 1e-9 * max(
        1.0, feed * scale / 1e5
    )
    dt = np.diff(profile.t)
    place = profile.s[:-1] + dt * (profile.v[:-1] + dt * (profile.a / 2 + dt * profile.j / 6))
    assert np.abs(place - profile.s[1:]).max() < 1e-9
    assert sum(profile.time_by("cause").values()) == pytest.approx(profile.time, abs=1e-9)
    assert sum(profile.time_by("line").values()) == pytest.approx(profile.time, abs=1e-9)


@settings(max_examples=50, deadline=None)
@given(st.lists(st.floats(0, 100), min_size=2, max_size=40), st.floats(0.01, 50))
def test_the_scan_is_the_loop(caps, gain):
    cap, gains = np.array(caps), np.full(len(caps) - 1, gain)
    w = cap.copy()
    for i in range(len(w) - 2, -1, -1):
        w[i] = min(w[i], w[i + 1] + gains[i])
    for i in range(1, len(w)):
        w[i] = min(w[i], w[i - 1] + gains[i - 1])
    assert np.allclose(reachable(cap, gains), w, atol=1e-9)


def test_the_scan_in_blocks_is_the_loop():
    rng = np.random.default_rng(3)
    cap, gains = rng.uniform(0, 1e4, 20_000), rng.uniform(0, 100, 19_999)
    w = cap.tolist()
    for i in range(len(w) - 2, -1, -1):
        w[i] = min(w[i], w[i + 1] + gains[i])
    for i in range(1, len(w)):
        w[i] = min(w[i], w[i - 1] + gains[i - 1])
    assert np.allclose(reachable(cap, gains), w, rtol=1e-12, atol=1e-9)
    assert np.allclose(running_sum(gains)[1:], np.cumsum(gains), rtol=1e-13)


# --- a run -----------------------------------------------------------------------------------------------------------


def test_exact_stop_and_blending_in_a_program():
    program = "G90 G54\nG0 X0 Y0 Z0\n{}\nG1 X30 F6000\nX60\nX90\n"
    stop, blend = (mnclab.run(program.format(code), "mnc").profile().time for code in ("G61", "G64"))
    assert stop == pytest.approx(3 * trapezoid(30, 100, 1000))
    assert blend == pytest.approx(trapezoid(90, 100, 1000))
    nine = mnclab.run("G90 G54\nG1 X30 F6000\nG9 X60\nX90\n", "mnc").profile().time
    assert nine == pytest.approx(trapezoid(60, 100, 1000) + trapezoid(30, 100, 1000))


def test_spindle_and_tool_change_take_time_when_the_limits_say():
    limits = Limits(spindle_acceleration=500, tool_change=4)
    program = "G90 G54\n{}T1\nS1000 M3\nG1 X30 F6000\nM4\n"
    waits, goes_on = (mnclab.run(program.format(code), "mnc").profile(limits) for code in ("", "G25\n"))
    assert waits.time == pytest.approx(4 + 2 + trapezoid(30, 100, 1000) + 4)
    assert goes_on.time == pytest.approx(4 + trapezoid(30, 100, 1000))
    assert waits.time_by("cause")["spindle"] == pytest.approx(6)


def test_times_by_line_tool_and_kind():
    run = mnclab.run("G90 G54\nT1\nG1 X30 F6000\nG4 P0.5\nG0 X0\n", "mnc")
    profile = run.profile()
    move = trapezoid(30, 100, 1000)
    assert profile.time_by("kind") == pytest.approx(
        {"rapid": trapezoid(30, 500 / 3, 1000), "line": move, "dwell": 0.5, "tool": 0.0}
    )
    assert profile.time_by("line")[3] == pytest.approx(move)
    assert profile.time_by("tool") == pytest.approx({1: profile.time})
    assert profile.time_by("cause")["acceleration"] == pytest.approx(move - 0.3 + trapezoid(30, 500 / 3, 1000) - 0.18)
    assert profile.at(profile.starts[2] + 0.01).line == 4
    with pytest.raises(Alarm, match="line, tool, kind or cause"):
        profile.time_by("colour")


def test_an_empty_program_takes_no_time():
    profile = mnclab.run("G90\n", "mnc").profile()
    assert profile.time == 0
    assert profile.at(1.0).v == 0
    assert "0.000 s" in repr(profile)
    assert "0.000 s" in profile._repr_html_()


def test_the_setup_of_a_run_has_the_limits():
    run = mnclab.run("G90 G54\nG1 X30 F6000\n", "mnc", Setup(limits=Limits(acceleration=100)))
    assert run.profile().time == pytest.approx(trapezoid(30, 100, 100))
    assert run.profile(Limits()).time == pytest.approx(trapezoid(30, 100, 1000))


TINY = dict.fromkeys(("acceleration", "jerk", "spindle", "spindle_acceleration"), 1e-300) | {"rapid": (1, 1e-300, 1)}
MAY_BE_NONE = ("corner_tolerance", "corner_jump", "tool_change")


@pytest.mark.parametrize("corner", ["tolerance", "deviation", "grbl", "jump"])
@pytest.mark.parametrize("jerk", [None, 1e-3, 1e9])
@pytest.mark.parametrize("override", [0.001, 100])
def test_limits_at_the_ends_of_their_range_give_a_time(corner, jerk, override):
    """Whatever the limits allow: a time that is a number, and no shorter than at the greatest speed of the axes."""
    bent = mnclab.run("T1 S500 M3\nG90 G54\nG0 X0 Y0 Z5\nG1 X10 F100\nG3 X20 Y10 I0 J10\nG1 X30\n", "mnc").toolpath
    for rapid in (1e-3, 1e9):
        for acceleration in (1e-3, 1e9):
            for tolerance in (0, 1e-300, 1e9):
                limits = Limits(
                    rapid=rapid, acceleration=acceleration, jerk=jerk, corner_speed=corner,
                    corner_tolerance=tolerance, corner_jump=tolerance,
                )  # fmt: skip
                profile = Profile(bent, limits, override=override)
                assert np.isfinite(profile.t).all() and profile.time >= 20 / (rapid / 60)


@pytest.mark.parametrize("kind", [Fraction, np.float32, np.int64])
def test_limits_take_every_kind_of_number(kind):
    one, five = kind(1), kind(5)
    limits = Limits(rapid=(five, five, one), acceleration=five, jerk=five, corner_tolerance=one, tool_change=one)
    same = Limits(rapid=(5, 5, 1), acceleration=5, jerk=5, corner_tolerance=1, tool_change=1)
    bent = path((0, 0, 0), (30, 0, 0), (30, 30, 0))
    assert limits == same and Profile(bent, limits).time == Profile(bent, same).time


@pytest.mark.parametrize("override", [0, -1, 1e-300, 0.0009, 101, 1e300, np.nan, "1", 10**400])
def test_an_override_is_a_sensible_share(override):
    with pytest.raises(Alarm, match=r"the feed override \(1 for 100 %\) must be"):
        Profile(path((0, 0, 0), (1, 0, 0)), Limits()).again(override=override)


@pytest.mark.parametrize(
    ("wrong", "says"),
    [
        ({"acceleration": 0}, "limit acceleration must be greater than 0, got 0"),
        ({"rapid": (1, 2)}, "limit rapid takes one number or three"),
        ({"jerk": -1}, "limit jerk must be greater than 0"),
        ({"corner_speed": "sharp"}, "limit corner_speed must be one of tolerance, deviation, grbl, jump, got 'sharp'"),
        ({"rapid_motion": "fast"}, "limit rapid_motion must be one of axes, proportional, line"),
        ({"corner_tolerance": "a"}, "limit corner_tolerance must be a number, got 'a'"),
        ({"tool_change": -1}, "limit tool_change must be at least 0"),
        *(({name: value}, f"limit {name} must be at least 0.001, got 1e-300") for name, value in TINY.items()),
        *(({name: 1e200}, f"limit {name} must be at most 1e[+]09, got 1e[+]200") for name in (*TINY, *MAY_BE_NONE)),
        ({"corner_speed": np.array([1])}, "limit corner_speed must be one of"),
        ({"rapid_motion": np.array([1])}, "limit rapid_motion must be one of"),
        ({"corner_jump": 10**400}, "limit corner_jump must be a finite number"),
    ],
)
def test_limits_that_make_no_sense(wrong, says):
    with pytest.raises(Alarm, match=says):
        Limits(**wrong)


def test_many_short_lines_of_a_curve_run_as_fast_as_the_curve():
    # a circle of 20 mm in 600 lines, a = 1000, jerk 1e5: v² = a r gives 141.4 mm/s for both models, v³ = j r² gives 342
    angle = np.linspace(0, 2 * math.pi, 601)
    points = np.stack([20 * np.cos(angle), 20 * np.sin(angle), 0 * angle], axis=1)
    for jerk in (None, 1e5):
        profile = Profile(path(*points, feed=1e5), Limits(rapid=1e6, jerk=jerk, corner_tolerance=0.005))
        slowest, fastest = profile.plan.v[150:450].min(), profile.plan.v[150:450].max()
        assert math.sqrt(1000 * 20) * 0.99 < slowest and fastest < math.sqrt(math.sqrt(2) * 1000 * 20) * 1.01
    sharp = Profile(path(*points[::25], feed=1e5), Limits(rapid=1e6, jerk=1e5, corner_tolerance=0.005))
    assert sharp.plan.v[6:18].max() < 20  # 24 lines are no curve at this tolerance


@pytest.mark.parametrize("jerk", [None, 2e4])
def test_a_corner_in_the_middle_of_short_rows_slows_only_what_it_must(jerk):
    points = [(0.2 * k, 0, 0) for k in range(200)] + [(40, 0.2 * k, 0) for k in range(200)]
    limits = Limits(corner_tolerance=0.01, jerk=jerk)
    fine, coarse = Profile(path(*points), limits), Profile(path((0, 0, 0), (40, 0, 0), (40, 39.8, 0)), limits)
    assert fine.time == pytest.approx(coarse.time, rel=0.25)
    assert fine.time >= coarse.time * (1 - 1e-9) or jerk is None
