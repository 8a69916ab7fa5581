"""Pictures of measuring: what they show is what was measured, the deviation magnified by the factor that is told."""

import itertools

import numpy as np
import pytest
from matplotlib.patches import Circle
from tools.together import deep_but_one_in
from tools.toy_probing import toy_run

import mnclab
from mnclab import Alarm
from mnclab.show.plot.measured import MOST, nice, panels
from mnclab.workpiece.part import box, hole, pocket

BORE = box((0, 0, -20), (100, 60, 0)) - hole((50.1, 29.9, 0), 24.2, 10)
TEXT = "M1 X50 Y30 D24 Z-5\nM4 X0 Y30 Z-5\nM5 X20 Y10 Z0 C3\nM3 X0 Y0 U30 Z-5\nM1 X50 Y30 D24 Z-5 C8 A10\nM2 X50 Y30 U24 V24 Z-5"


@pytest.fixture(scope="module")
def measured():
    run = toy_run(TEXT, BORE.turned(0.4))
    assert run.ok, run.alarms
    return run


def test_a_panel_for_each_cycle_and_a_second_one_for_what_was_touched_from_above(measured):
    found, _ = panels(measured, None, None)
    assert [panel.title.split("\n")[0] for panel in found] == [
        "line 3  M1", "line 4  M4", "line 5  M5", "line 5  M5", "line 6  M3", "line 7  M1", "line 8  M2",
    ]  # fmt: skip
    assert [panel.view.up for panel in found] == [1, 1, 1, 2, 1, 1, 1]
    assert [ball.number for ball in found[0].balls] == [1, 2, 3, 4]  # run.touches[0] and so on


def test_deviations_are_drawn_as_often_as_the_title_says():
    """A hole of 24.2 at (50.1, 29.9) for one of 24 at (50, 30): the walls are 0.1 + 0.1 and 0.1 - 0.1 beyond the nominal ones."""
    run = toy_run("M1 X50 Y30 D24 Z-5", BORE)
    ((panel,), _) = panels(run, None, 20)
    (pair,) = panel.pairs
    assert panel.title.endswith("deviation × 20")
    assert np.hypot(*(pair.nominal - (50, 30)).T) == pytest.approx(12)
    assert np.hypot(*(pair.actual - (50 + 20 * 0.1, 30 - 20 * 0.1)).T) == pytest.approx(12 + 20 * 0.1)
    assert panel.middles[0].actual == pytest.approx((52, 28), abs=1e-6)
    for ball in panel.balls:  # it touches the line where it is drawn, near to a graze: 0.1 of 24 aside
        off = np.hypot(*(ball.centre - (52, 28))) + 2
        assert off == pytest.approx(14, abs=20 * 0.1**2 / 24 + 1e-3)
        assert ball.start != pytest.approx(ball.centre)


def test_a_touch_along_no_axis_tells_how_far_out_it_is():
    """At 45 degrees the hole of 24.2 about (50.1, 30) is 0.1 + 0.1 cos 45 out, but for the square of 0.1 sin 45 over 24.2."""
    part = box((0, 0, -20), (100, 60, 0)) - hole((50.1, 30, 0), 24.2, 10)
    ((panel,), _) = panels(toy_run("M1 X50 Y30 D24 Z-5 A45", part), None, None)
    out, back = "+0.170", "+0.029"
    assert [ball.text for ball in panel.balls] == [out, back, back, out]


def test_a_wall_without_a_figure_has_a_line_at_the_nominal_place_and_one_at_the_measured():
    run = toy_run("M4 X0.05 Y30 Z-5", BORE)
    ((panel,), _) = panels(run, None, 100)
    assert panel.pairs[0].nominal[:, 0] == pytest.approx(0.05) and panel.pairs[0].actual[:, 0] == pytest.approx(0.05 - 5)
    assert panel.balls[0].centre == pytest.approx((0.05 - 5 - 2, 30)) and panel.balls[0].text == "X 0.000"


def test_the_factor_is_round_and_shows_the_worst_as_a_tenth(measured):
    for panel in panels(measured, None, None)[0]:
        worst = max((np.hypot(*(pair.actual - pair.nominal).T).max() for pair in panel.pairs), default=0)
        lines = [pair.nominal for pair in panel.pairs] or [np.array([ball.centre for ball in panel.balls])]
        assert worst <= 0.1 * max(np.ptp(np.vstack(lines), axis=0).max(), 8 * 2) * (1 + 1e-9)
    assert [nice(value) for value in (0.3, 1, 4.99, 5, 19, 21, 500)] == [1, 1, 2, 5, 10, 20, 500]


def probing(text, part=BORE):
    """The ball stands at X-5 Y30, and in front of the wall at X0 5 mm below the top."""
    setup = mnclab.Setup(part=part, tools={7: mnclab.Tool(radius=2, kind="probe")})
    down = "N30 G0 Z-5\n" if part is BORE else ""
    return mnclab.run("N10 T7\nN20 G0 X-5 Y30 Z20\n" + down + text, "mnc", setup)


def test_a_slanting_touch_says_what_the_record_says_and_draws_no_wall():
    """G491 gives the centre of the ball: at 30 degrees from X-5 to X-2 it goes up by 3 tan 30 degrees."""
    ((panel,), _) = panels(probing("N40 G491 L1 E30 P20 Q2\n"), None, None)
    assert panel.title.startswith("line 4  G491\n") and not panel.pairs
    assert panel.balls[0].text == f"X \N{MINUS SIGN}2.000  Y {30 + 3 * np.tan(np.radians(30)):.3f}"


def test_the_legend_has_a_nominal_line_only_where_one_is_drawn():
    names = [text.get_text() for text in probing("N40 G499 X1\n").plot_measured().legends[0].get_texts()]
    assert "measured" in names and "nominal" not in names


def test_what_has_no_nominal_place_is_not_magnified():
    """G415 knows no nominal corner; touches along an axis are off the turned line by radius * (1 / cos 0.4 degrees - 1)."""
    part = (box((-60, -60, -30), (160, 120, 0)) - box((0, 0, -12), (300, 300, 20))).turned(0.4)
    run = probing("N40 G415 X8 Y6 A40 B20 C1 Z-5 H20\n", part)
    assert run.ok, run.alarms
    ((panel,), _) = panels(run, None, None)
    assert panel.factor == 1 and "deviation" not in panel.title and len(panel.balls) == 4


def test_a_refused_cycle_stands_over_what_it_touched():
    """Of a slot only one side is there: the ball finds the first wall and nothing at the other."""
    run = probing("N40 G425 X50 Y30 L1 D20 Z-5 H20\n", box((60, -60, -30), (160, 120, 0)))
    ((panel,), _) = panels(run, None, None)
    assert panel.title == "line 3  G425\nfrom above" and len(panel.balls) == 1


def test_places_are_those_of_the_program_whatever_the_datum_is():
    """The datum lies at (50, 30): the bore is measured about the origin, and the panel shows it there."""
    run = mnclab.run(
        "1 TOOL CALL 7 Z\n2 L Z+30 R0 FMAX\n3 TCH PROBE 419 PRESET\nQ263=-50\nQ264=+0\nQ261=-5\nQ320=+0\nQ260=+20\nQ272=+1\n"
        "Q267=+1\nQ305=+0\nQ333=+0\nQ303=+1\n",
        "tnc-620",
        mnclab.Setup(
            tools={7: mnclab.Tool(radius=2, kind="probe")}, presets={1: (50, 30, 0)}, settings={"preset": 1}, part=BORE
        ),
    )
    assert run.ok, run.alarms
    ((panel,), _) = panels(run, None, None)
    assert panel.balls[0].text == "X \N{MINUS SIGN}50.000" and panel.balls[0].centre == pytest.approx((-52, 0))


def boxes_of(picture):
    """The boxes of all texts of a picture, pixels."""
    picture.draw_without_rendering()
    texts = [text for ax in picture.axes for text in (*ax.texts, ax._left_title)] + list(picture.texts)
    for ax in picture.axes:
        for axis, (low, high) in ((ax.xaxis, ax.get_xlim()), (ax.yaxis, ax.get_ylim())):
            texts += [tick.label1 for tick in axis.get_major_ticks() if low <= tick.get_loc() <= high] + [axis.label]
    return [(text.get_text(), text.get_window_extent()) for text in texts if text.get_text().strip() and text.get_visible()]


@pytest.mark.parametrize("width, line", deep_but_one_in(3, itertools.product([3.5, 7.5, 12], [None, 3, 5, 7])))
def test_no_text_covers_another(measured, line, width):
    picture = measured.plot_measured(line=line, width=width)
    boxes = boxes_of(picture)
    assert len(boxes) > 10
    for (one, a), (other, b) in itertools.combinations(boxes, 2):
        assert not a.shrunk(0.98, 0.9).overlaps(b.shrunk(0.98, 0.9)), f"{one!r} and {other!r}"
    discs = [patch.get_window_extent() for ax in picture.axes for patch in ax.patches if isinstance(patch, Circle)]
    numbers = [box for ax in picture.axes for text in ax.texts if text.get_text() for box in [text.get_window_extent()]]
    assert discs and not any(disc.overlaps(box) for disc in discs for box in numbers)


def test_numbers_that_have_no_room_are_counted_below():
    """64 touches round a bore of a picture of three inches."""
    picture = toy_run("M1 X50 Y30 D24 Z-5 C64", BORE).plot_measured(width=3)
    (said,) = [text.get_text() for text in picture.texts if "no room" in text.get_text()]
    written = [text.get_text() for text in picture.axes[0].texts if text.get_text()]
    assert said == f"no room for the numbers of {64 - len(written)} touched points" and len(written) > 8


def test_many_cycles_have_some_panels_and_say_how_many_more_there_are():
    run = toy_run("M4 X0 Y30 Z-5\n" * (MOST + 3), BORE)
    picture = run.plot_measured()
    assert len(picture.axes) == MOST and [t.get_text() for t in picture.texts][-1].startswith("3 more cycles: line= chooses")
    assert len(run.plot_measured(line=MOST + 5).axes) == 1


def test_the_record_stands_below_what_is_out_in_red(measured):
    picture = measured.plot_measured(line=3)
    told = {text.get_text(): text for text in picture.texts}
    assert {"diameter", "24.2000", "+0.2000", "out"} <= told.keys() and told["out"].get_color() == "#b3261e"


@pytest.mark.parametrize(
    "options, said",
    [
        ({"line": 99}, "nothing was measured in line 99"),
        ({"line": "x"}, "line must be a number, got 'x'"),
        ({"factor": 0}, "the factor of deviations must be greater than 0, got 0"),
        ({"part": 3}, "part must be True or False, got 3"),
        ({"width": 1}, "the width of a picture (inches) must be at least 3, got 1"),
    ],
)
def test_what_makes_no_sense_is_refused(measured, options, said):
    with pytest.raises(Alarm) as alarm:
        measured.plot_measured(**options)
    assert alarm.value.message == said


def test_without_a_touch_there_is_no_picture():
    with pytest.raises(Alarm, match="nothing was measured"):
        mnclab.run("G0 X1\n", "mnc").plot_measured()
    tool, plate = mnclab.Tool(radius=5, length=80), mnclab.Setter(z=-50)
    setup = mnclab.Setup(tools={1: tool}, setter=plate, settings={"tt_calibrated": True})
    found = mnclab.run("TOOL CALL 1 Z\nTCH PROBE 481 Q340=2 Q260=+0 Q341=0\n", "tnc-620", setup)
    with pytest.raises(Alarm, match="run.measurements has the tools"):
        found.plot_measured()


def test_a_pocket_and_its_part_in_true_size():
    part = box((0, 0, -20), (100, 60, 0)) - pocket((50.1, 29.9, 0), 40.3, 23.9, 10, corner=5)
    picture = toy_run("M2 X50 Y30 U40 V24 Z-5", part).plot_measured()
    (ax,) = picture.axes
    drawn = [path for each in ax.collections for path in each.get_paths() if path.get_extents().width > 99]
    outer, inner = (np.abs((x[:-1] * y[1:] - x[1:] * y[:-1]).sum() / 2) for x, y in (p.T for p in drawn[0].to_polygons()))
    assert (outer, inner) == pytest.approx((100 * 60, 40.3 * 23.9 - (4 - np.pi) * 5**2), abs=1)  # its corners are chords
    assert picture.png()[:4] == b"\x89PNG"
    bare = toy_run("M2 X50 Y30 U40 V24 Z-5", part).plot_measured(part=False)
    assert len(bare.axes[0].collections) < len(ax.collections)
