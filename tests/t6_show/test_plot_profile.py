"""Pictures of a profile, and the panel of its limits."""

from pathlib import Path

import numpy as np
import pytest

import mnclab
from mnclab import Alarm, Limits
from mnclab.show.plot import colours
from mnclab.show.plot.profile import curve, holds, plot_profile

SAMPLES = Path(__file__).parents[2] / "data" / "programs"

PROGRAM = """G90 G54 T1 S1000 M3
G0 X0 Y0 Z5
G1 Z-2 F600
G1 X40 F3000
Y20
G3 X20 Y40 I-20 J0
G1 X10
X0 Y30
Y0
G4 P0.2
G0 Z5
"""
LIMITS = Limits(acceleration=500, corner_tolerance=0.02)


@pytest.mark.parametrize("over", ["time", "path"])
@pytest.mark.parametrize("jerk", [None, 5000])
def test_the_curves_are_those_of_the_profile(run, over, jerk):
    profile = run.profile(Limits(acceleration=500, corner_tolerance=0.02, jerk=jerk))
    drawn = curve(profile, over)
    inside = slice(1, -1)
    now = profile.at(drawn.t[inside])
    assert np.allclose(now.v, drawn.v[inside], atol=1e-6) and np.allclose(now.s, drawn.s[inside], atol=1e-6)
    picture = profile.plot(over=over, axes=True)
    reached = [line for line in picture.axes[0].lines if line.get_label() == colours.REACHED.name][0]
    assert reached.get_xdata()[-1] == pytest.approx(profile.time if over == "time" else profile.path.length)
    assert max(reached.get_ydata()) == pytest.approx(drawn.v.max() * 60)
    assert len(picture.axes) == (4 if jerk is None else 5)


def test_nothing_covers_anything_else(run):
    picture = run.profile(Limits(acceleration=500, jerk=5000)).plot(axes=True)
    picture.png()
    drawing = picture.canvas.get_renderer()
    legend = picture.legends[0].get_window_extent(drawing)
    boxes = [ax.get_tightbbox(drawing) for ax in picture.axes]
    assert all(legend.y0 >= box.y1 for box in boxes)
    assert all(upper.y0 >= lower.y1 - 8 for upper, lower in zip(boxes, boxes[1:]))  # ticks at the edge touch
    labels = [ax.yaxis.label.get_window_extent(drawing) for ax in picture.axes]
    assert all(upper.y0 > lower.y1 for upper, lower in zip(labels, labels[1:]))
    assert all(0 <= box.x0 and box.x1 <= picture.bbox.x1 and box.y0 >= 0 for box in boxes)


def test_what_holds_the_speed(run):
    profile = run.profile(LIMITS)
    names = np.array(list(colours.HOLDS))[holds(profile)]
    assert set(names) == {"acceleration", "feed", "standing"}
    dt = np.diff(profile.t)
    assert dt[names == "standing"].sum() == pytest.approx(0.2)
    assert (profile.a[names == "acceleration"] != 0).all()
    slow = mnclab.run("G90 G54\nG1 X40 F30000\n", "mnc").profile(Limits(rapid=6000))
    assert "axis speed" in np.array(list(colours.HOLDS))[holds(slow)]


@pytest.mark.parametrize("jerk", [None, 20_000])
@pytest.mark.parametrize("sample", ["mnc/one_part.mnc", "jnc-t01/shaft.jnc", "tnc-620/lid.h", "tnc-620/pockets.h"])
def test_no_acceleration_is_drawn_beyond_its_limit(sample, jerk):
    """Neither of rapids whose axes go by themselves, which may have more together than each, nor along arcs; and without gaps."""
    picture = mnclab.run(SAMPLES / sample).profile(Limits(rapid=8000, acceleration=1500, jerk=jerk)).plot()
    drawn = {line.get_label(): np.array(line.get_ydata()) for line in picture.axes[1].lines}
    assert (np.abs(drawn["_a"]) <= drawn["limit"] + 1e-6).all() and np.isfinite(drawn["limit"]).all()


def test_the_path_is_coloured_by_what_is_reached(run):
    picture = run.profile(LIMITS).plot_reached(view="XY")
    assert "feed" in [text.get_text().split(",")[0] for text in picture.texts]
    # the diagonal of 14 mm between two corners begins and ends slowly: more than one class lies on it
    points = [np.array(line.get_data(), dtype=float) for line in picture.axes[0].lines]
    on = [1 for x, y in points if ((np.abs(y - x - 30) < 1e-6) & (y < 40)).any()]
    assert len(on) > 2


def test_lost_time_stands_beside_the_lines(run):
    profile = run.profile(LIMITS)
    picture = profile.plot_lost()
    ax = picture.axes[0]
    texts = [label.get_text() for label in ax.get_yticklabels()]
    assert texts[4].split() == ["5", "Y20"]
    bars = ax.containers[0], ax.containers[1]
    whole = [a.get_width() + b.get_width() for a, b in zip(*bars)]
    assert sum(whole) == pytest.approx(profile.time)
    assert len(profile.plot_lost(most=3).axes[0].get_yticklabels()) == 3


def test_a_long_line_stands_whole_beside_its_bar():
    words = "G1 X10 F100 // this comment says in many more words than a row of the picture has room for what the line does"
    profile = mnclab.run(f"G90 S500 M3\n{words}\nX20\n{words}\n", "mnc").profile()
    ax = profile.plot_lost().axes[0]
    labels = [label.get_text() for label in ax.get_yticklabels()]
    assert f"2 {words}" in [" ".join(text.split()) for text in labels]
    rows = np.array([max(1.0, 0.65 * len(text.split("\n"))) for text in labels])
    assert (np.diff(ax.get_yticks()) > 0.99 * (rows[1:] + rows[:-1]) / 2).all()


def test_wrong_options_and_empty_programs(run):
    with pytest.raises(Alarm, match="time or path"):
        run.profile().plot(over="lines")
    nothing = mnclab.run("G90\n", "mnc").profile()
    assert nothing.plot().png() and nothing.plot_lost().png()


def test_into_axes_of_ones_own(run):
    from matplotlib.figure import Figure

    figure = Figure()
    ax = figure.add_subplot()
    assert plot_profile(run.profile(LIMITS), ax) is figure
    assert ax.get_xlabel() == "time, s"


def test_the_panel_follows_its_boxes(run):
    panel = mnclab.profile_panel(run.profile(LIMITS))
    before, picture = panel.profile.time, panel.picture.value
    panel.boxes["acceleration"].value = 100.0
    assert panel.profile.time > before and panel.picture.value != picture
    assert panel.profile.limits.acceleration == 100.0
    panel.boxes["jerk"].value = 2000.0
    assert panel.profile.limits.jerk == 2000.0
    panel.boxes["acceleration"].value = 0.0
    assert "must be greater than 0" in panel.alarms.value
    panel.boxes["acceleration"].value = 100.0
    panel.boxes["override"].value = 50.0
    assert panel.profile.override == 0.5
    assert f"{panel.profile.time:.3f}" in panel.alarms.value


@pytest.mark.parametrize("way", [("30", "10"), ("10", "30")])  # towards the spindle axis, and away from it
def test_at_constant_cutting_speed_the_programmed_feed_follows_the_radius(way):
    start, end = way
    program = f"M3\nG96 S120\nG95 F0.2\nG0 X{start} Z0\nG1 X{end}\n"
    path = mnclab.run(program, "jnc-t01").toolpath
    profile = mnclab.Profile(path[path.kind == mnclab.Kind.LINE], Limits(acceleration=2000))
    (wanted,) = [line for line in profile.plot(over="path").axes[0].lines if line.get_label() == colours.WANTED.name]
    place, feed = np.array(wanted.get_xdata()), np.array(wanted.get_ydata())
    middle = (place > 1) & (place < 19)
    radius = np.interp(place[middle], [0, 20], [float(start), float(end)])
    by_hand = 0.2 * 120_000 / (2 * np.pi * radius)
    assert np.allclose(feed[middle], by_hand, rtol=20 / 64 / 10)  # each of the 64 parts has one feed
    names = np.array(list(colours.HOLDS))[holds(profile)]
    assert set(names) == {"feed", "acceleration"}


def test_blanks_before_a_comment_take_no_room():
    run = mnclab.run("G94 F100\nG1 X20        ' a cut\n", "jnc-t01")
    labels = run.profile().plot_lost().axes[0].get_yticklabels()
    assert labels[-1].get_text().endswith("G1 X20 ' a cut")


def test_the_acceleration_stays_within_the_limit_that_is_drawn():
    """Two turns of an arc under a jerk limit are planned in stages, each with an acceleration of its own."""
    limits = mnclab.Limits(acceleration=5000, jerk=50000, corner_tolerance=0.01, rapid=40000)
    run = mnclab.run("G90 G17\nS100 M3\nF20000\nG0 X5 Y0\nG2 I-5\nG2 I-5\n", "g43", mnclab.Setup(limits=limits))
    own, limit, other = run.profile().plot().axes[1].lines[:3]
    most = limit.get_ydata()
    assert np.array_equal(other.get_ydata(), -most, equal_nan=True) and np.isfinite(most).any()
    assert (np.abs(own.get_ydata()) <= most * (1 + 1e-9))[np.isfinite(most)].all()


def test_the_feed_over_the_removal_counts_in_the_unit_of_the_program():
    """100 tenths of an inch a minute are 10 in/min."""
    text = "BEGIN PGM A INCH\nTOOL CALL 1 Z S1000\nL Z+2 R0 FMAX M3\nL X+0 Y+0 FMAX\nL Z-0.1 F100\nL X+1\nEND PGM A INCH\n"
    tools, stock = {1: mnclab.Tool(diameter=6.35)}, ((-10, -10, -10), (40, 40, 0))
    feed, rate = mnclab.run(text, "tnc-620", mnclab.Setup(tools=tools, stock=stock)).removal().plot().axes
    assert feed.get_ylabel() == "feed,\nin/min" and 10 < feed.get_ylim()[1] < 20 and rate.get_ylabel().endswith("in³/min")
    assert rate.texts[0].get_text() == "line 5: at most 0.491 in³/min"  # the plunge, π 0.125² · 10
