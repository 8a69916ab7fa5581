"""The axes of a machine in a picture and a table, and the time that its rotary axes take."""

import numpy as np
import pytest

import mnclab as mnc

TOOLS = {2: mnc.Tool(radius=4, length=90)}


def made(text, machine="table-ac", **more):
    setup = mnc.Setup(tools=TOOLS, kinematics=machine, **more)
    run = mnc.run(f"BEGIN PGM T MM\nTOOL CALL 2 Z S3000\nL X+20 Y+0 Z+50 R0 FMAX M3\n{text}\nEND PGM T MM\n", "tnc-620", setup)
    assert run.ok, run.alarms
    return run


def test_a_curve_for_each_axis_that_moves():
    """X from 20 to -20 while A goes to 30: both lines are straight over their rows, Y and B stand and have none."""
    picture = made("L X-20 A+30 F500").axes().plot()
    assert [ax.get_ylabel() for ax in picture.axes] == ["X, mm", "Z, mm", "A, °"]
    for ax, last in zip(picture.axes, (-20, 140, 30)):
        x, y = ax.lines[0].get_xydata().T
        swing = x >= x[-1] - 3
        assert np.allclose(y[-1], last) and np.allclose(np.diff(y[swing]), np.diff(y[swing])[0], atol=1e-9)
    assert picture.alt == "axes over row of the path: X from -20 to 20, Z from 0 to 140, A from 0 to 30"


def test_the_picture_of_axes_begins_at_the_first_row_and_counts_angles():
    """Of 0 to 90 degrees both ends are told; whose coordinates they are is said; before the first move the axes stand."""
    picture = made("L C+90 F500").axes().plot()
    first, last = picture.axes[0], picture.axes[-1]
    assert first.get_title(loc="left") == "machine coordinates, X Y Z of the spindle reference"
    assert last.get_xlim()[0] == 0 and last.lines[0].get_xdata()[0] == 0
    assert {0, 30, 60, 90} <= set(last.get_yticks().round(6).tolist())


def test_within_an_arc_the_curve_goes_round():
    """A full circle about X10: X goes from 20 to 0 and back, although its ends are alike."""
    course, at = made("CC X+10 Y+0\nC X+20 Y+0 DR+ F300").axes().course()
    x = course[at > at[-1] - 1, 0]
    assert x.min() == pytest.approx(0, abs=0.01) and x[-1] == pytest.approx(20)
    assert np.all(np.diff(at) > 0)


def test_over_time_the_picture_ends_with_the_profile():
    run = made("L A+30 F180")
    profile = run.profile()
    (*_, last) = run.axes().plot(profile).axes
    assert last.get_xlabel() == "time, s" and last.lines[0].get_xdata()[-1] == pytest.approx(profile.time)


def test_a_profile_of_another_run_is_refused():
    with pytest.raises(mnc.Alarm, match="is that of their run, got <Profile"):
        made("L A+30 F180").axes().plot(made("L X-20 F180\nL X+20").profile())


def test_a_program_without_motion_says_so():
    assert "none moves" in mnc.run("", "mnc").axes().plot().alt


@pytest.mark.parametrize("limits", [mnc.Limits(acceleration=1e9), mnc.Limits(acceleration=1e9, jerk=1e9), "table-ac"], ids=str)
def test_turns_take_the_time_of_their_feed(limits):
    """90 degrees of C at 180 degrees a minute are 30 s, whatever way the tip goes on the part while C turns; beside X the feed is
    that of X: 40 mm at 500 mm/min are 4.8 s, and speeding up and braking what X needs for them."""
    seconds = made("L C+90 F180\nL X-20 C+0 F500", limits=limits).profile().time_by("line")
    assert seconds[4] == pytest.approx(30, abs=0.05) and seconds[5] == pytest.approx(4.8, abs=0.05)


def test_no_stop_between_the_rows_of_a_turn_at_rapid():
    """The tip goes round a quarter circle of 20 mm: without stops it is as fast as on a line of that length."""
    limits = mnc.Limits(rapid=6000, acceleration=1000)
    took = made("L C+90 FMAX", limits=limits).profile().time_by("line")[4]
    way, v, a = 20 * np.pi / 2, 100, 1000
    assert took < (way / v + v / a) * 1.5 and np.isfinite(took)


@pytest.mark.parametrize("machine", ["table-ac", "head-bc", "head-b-table-c"])
def test_profiles_of_machines_that_turn_are_finite(machine):
    tilt = "A" if machine == "table-ac" else "B"
    profile = made(f"L {tilt}+25 C+40 FMAX\nL X-5 Z+12 F300\nL Y+15 {tilt}+10 F800\nL X+0 C+0 {tilt}+0 F900", machine).profile()
    assert np.isfinite(profile.seconds).all() and np.isfinite(profile.v).all() and np.isfinite(profile.a).all()
    assert profile.at(profile.time / 2).position.shape == (3,)
