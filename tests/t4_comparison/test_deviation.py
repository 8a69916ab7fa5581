"""Two paths over one another: distances in closed form, and against every stroke tried."""

import math
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import mnclab
from mnclab import Alarm
from mnclab.comparison.diff import deviation, nearest_of

SAMPLES = Path(__file__).parents[2] / "data" / "programs"
PATH = "G90 G54 G17\nG0 X-20 Y0 Z0\nG41 G1 X-10 Y-20 F300\nX0\nG3 I0 J20\nG40 G1 X10 Y0\n"


def test_the_same_path_has_none():
    run = mnclab.run(PATH, "mnc")
    found = mnclab.diff(run, run)
    assert found.largest == pytest.approx(0, abs=1e-12) and found.sentence == "the paths are the same"
    assert found.first() is None
    assert "farthest apart" not in str(found) + found._repr_html_()


def test_rapids_that_two_machines_lead_are_told_apart():
    """Axes of 1000 mm/min and no inertia to speak of: X40 Y20 goes in a slant to X20 Y20 and on along X, and X20 Y20 is
    20 / √5 mm beside the straight line."""
    limits = mnclab.Limits(rapid=1000, acceleration=1e6)
    setup = mnclab.Setup(limits=limits)
    milled, klartext = "G90 G54\nG0 X40 Y20\nG1 Y50 F100\n", "L X+40 Y+20 R0 FMAX\nL Y+50 F100\n"
    by_axes, in_line = mnclab.run(milled, "mnc", setup), mnclab.run(klartext, "tnc-620", setup)
    found = mnclab.diff(in_line, by_axes)
    assert not found and found.rapids_apart == pytest.approx(20 / math.sqrt(5), abs=0.01)
    assert found.sentence.startswith("the cuts are the same; the axes lead the rapids up to 8.94")
    other = mnclab.diff(in_line, mnclab.run(milled.replace("Y50", "Y60"), "mnc", setup))
    assert other.largest == pytest.approx(10) and other.sentence.endswith(", rapids taken as straight lines")
    assert mnclab.diff(by_axes, by_axes).sentence == "the paths are the same"


def test_places_are_a_step_apart_however_short_the_chords_are():
    """Of 10 circles of 36,000 chords in all, only as many places are looked at as the step asks for."""
    run = mnclab.run("G0 X0 Y0\n" + "G3 I1.7 F100\n" * 10, "mnc")
    found = deviation(run.toolpath, run.toolpath, step=0.5, chord_error=1e-7)
    circle = 2 * math.pi * 1.7
    assert len(found.one.places) == 10 * (math.ceil(circle / 0.5) + 1) and found.largest < 1e-9
    apart = np.linalg.norm(np.diff(found.one.places, axis=0), axis=1)
    assert apart.max() == pytest.approx(2 * 1.7 * math.sin(circle / 22 / 1.7 / 2), abs=1e-5)


def test_programs_without_a_name_are_told_by_their_controls():
    found = mnclab.diff(mnclab.run("G1 X10 F100\n", "mnc"), mnclab.run("L X+10 Y+3 R0 F100\n", "tnc-620"))
    assert found.names == ("the mnc program", "the tnc-620 program") and found.largest == pytest.approx(3, abs=1e-9)


def test_two_rings_about_one_centre_differ_by_their_radii():
    found = mnclab.diff(*(mnclab.run(f"G1 X{r} F100\nG3 I-{r}\n", "mnc") for r in (15, 17)))
    ring = found.other.row == 1
    assert found.other.distance[ring] == pytest.approx(2, abs=0.002)
    assert found.largest == pytest.approx(2, abs=0.002) and found.first(0.01) == 0


def test_the_place_of_a_dent():
    plain, dented = (mnclab.run(f"G1 X50 F100\n{dent}X100\n", "mnc") for dent in ("", "X60 Y3\nX70 Y0\n"))
    found = mnclab.diff(plain, dented)
    here, there, line, path = found.where
    assert found.largest == pytest.approx(3, abs=1e-9)
    assert here == pytest.approx((60, 0, 0)) and there == pytest.approx((60, 3, 0))
    assert (line, path) == (2, 1)
    assert found.sentence == "largest deviation 3 mm at line 2 of the second program"
    assert ">X60 Y3 Z0</td>" in found._repr_html_()


def test_arcs_against_chords():
    arc = mnclab.run("G1 X20 F100\nG3 X-20 I-20\n", "mnc")
    text = "G1 X20 F100\n" + "".join(
        f"X{20 * math.cos(math.pi * k / 8):.6f} Y{20 * math.sin(math.pi * k / 8):.6f}\n" for k in range(1, 9)
    )
    found = mnclab.diff(arc, mnclab.run(text, "mnc"))
    assert found.largest == pytest.approx(20 * (1 - math.cos(math.pi / 16)), abs=2e-3)  # the sagitta


def test_without_motion():
    still, moving = mnclab.run("G90\n", "mnc"), mnclab.run("G0 X5\n", "mnc")
    assert mnclab.diff(still, still).largest == 0
    assert math.isnan(mnclab.diff(still, moving).largest) and mnclab.diff(still, moving).where is None
    assert mnclab.diff(still, moving).plot().png()[:4] == b"\x89PNG"


def test_the_picture_marks_the_largest():
    plain, dented = (mnclab.run(f"G1 X50 F100\n{dent}X100\n", "mnc") for dent in ("", "X60 Y3\nX70 Y0\n"))
    picture = mnclab.diff(plain, dented).plot()
    assert picture.alt == "two paths: largest deviation 3 mm at line 2 of the second program"
    ring = next(line for line in picture.axes[0].lines if line.get_label() == "largest deviation")
    assert ring.get_xydata()[0] == pytest.approx((60, 0))
    with pytest.raises(Alarm, match="view must be"):
        mnclab.diff(plain, dented).plot("front")


POINTS = st.lists(st.tuples(*[st.integers(-50, 50)] * 3), min_size=2, max_size=300)


@given(POINTS, st.lists(st.tuples(*[st.integers(-60, 60)] * 3), min_size=1, max_size=20))
def testnearest_of_is_thenearest_of_of_all_strokes(corners, places):
    line, here = np.array(corners, dtype=float), np.array(places, dtype=float)
    found = np.linalg.norm(nearest_of(here, line[:-1], line[1:]) - here, axis=1)
    along = line[1:] - line[:-1]
    square = np.maximum((along**2).sum(axis=1), 1e-300)
    share = np.clip((((here[:, None] - line[:-1]) * along).sum(axis=2)) / square, 0, 1)
    feet = line[:-1] + share[:, :, None] * along
    assert found == pytest.approx(np.linalg.norm(feet - here[:, None], axis=2).min(axis=1), abs=1e-6)


def test_one_part_for_two_controls_is_one_path():
    """The programs of a lesson: a pocket of short strokes, and long rapids that the starts of strokes do not tell of."""
    runs = [mnclab.run(SAMPLES / name) for name in ("mnc/one_part.mnc", "tnc-620/one_part.h")]
    assert mnclab.diff(*runs).largest < 1e-9


def test_a_step_must_be_positive():
    path = mnclab.run("G0 X5\n", "mnc").toolpath
    with pytest.raises(Alarm, match=r"step \(mm\) must be greater than 0, got -1"):
        deviation(path, path, step=-1)
    for wrong in (0, -5, math.nan, math.inf, 10**400, "5", 1e-308, [1], True):
        with pytest.raises(Alarm, match="step"):
            mnclab.diff(path, path, wrong)


def test_two_limits_differ_in_time_alone():
    slow, fast = (mnclab.Setup(limits=mnclab.Limits(acceleration=a)) for a in (100, 400))
    found = mnclab.diff(*(mnclab.run("G1 X10 F6000\n", "mnc", setup) for setup in (slow, fast)))
    assert found.largest < 1e-12
    # 10 mm from rest to rest never reach 100 mm/s: 2 sqrt(10 / a)
    assert found.times == pytest.approx((2 * math.sqrt(10 / 100), 2 * math.sqrt(10 / 400)))
    assert "<td>time</td><td>0.632 s</td><td>0.316 s</td>" in found._repr_html_().replace(' style="text-align:left"', "")


def test_its_truth_is_that_the_two_differ():
    """As that of collisions: what stands after `if not diff(…)` is not reached where runs differ, or one stopped."""
    one, other = (mnclab.run(f"G0 X0 Y0 Z2\nG1 Z-3 F100\nG0 Z2\nX{x}\nG1 Z-3\nG0 Z2\n", "mnc") for x in (10, 12))
    stopped = mnclab.run("G1 X5\n", "mnc")
    for what, count in (("path", None), ("holes", 2)):
        assert mnclab.diff(one, other, what=what) and not mnclab.diff(one, one, what=what)
        assert mnclab.diff(stopped, stopped, what=what)
        assert count is None or len(mnclab.diff(one, other, what=what)) == count
