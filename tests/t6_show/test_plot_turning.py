"""Figures of a lathe: schemes side by side, blank and part, the insert, threads, the spindle speed."""

import math
import re

import numpy as np
import pytest
from matplotlib.patches import Polygon

from mnclab import Alarm, Limits, Setup, Tool, blank, run
from mnclab.comparison.turning_schemes import compare, toolpath
from mnclab.geometry.contours import Contour
from mnclab.machining.turning import threading as threads
from mnclab.path.inserts import as_drawn, insert
from mnclab.show.looks import CARBIDE, STEEL, player_css
from mnclab.show.plot.classes import classes
from mnclab.show.plot.lathe import INSERT, plot_speed, speed_strokes, speeds
from mnclab.show.plot.path import plot_path
from mnclab.show.plot.strokes import strokes
from mnclab.show.plot.turning_schemes import plot_schemes, plot_threads

SHOULDER = Contour([(0, 20), (-40, 20), (-50, 30)], closed=False)
SQUARE = "S800\nM3\nF20\nX4000 ~ *\nZ200 ~\nX3000 ~\nZ-2000\nX6200\nZ200 ~\n"
STOCK = ((-30, -30, -60), (30, 30, 0))


@pytest.fixture(scope="module")
def found():
    return compare(SHOULDER, 30, depth=4)


def test_schemes_at_one_scale_and_nothing_overlaps(found):
    picture = found.plot(width=9)
    assert [ax.get_title(loc="left").replace("\n", " ") for ax in picture.axes] == [trial.name for trial in found.trials]
    picture.canvas.draw()
    boxes = [ax.get_tightbbox() for ax in picture.axes] + [legend.get_window_extent() for legend in picture.legends]
    for i, a in enumerate(boxes):
        assert a.x0 >= -0.5 and a.x1 <= picture.bbox.x1 + 0.5 and a.y0 >= -0.5 and a.y1 <= picture.bbox.y1 + 0.5
        assert not any(a.overlaps(b) for b in boxes[i + 1 :])
    assert all(ax.get_aspect() == 1 for ax in picture.axes)
    names = [text.get_text() for text in picture.legends[0].get_texts()]
    assert {"rapid", "roughing", "pick-up", "clean-up", "left standing"} == set(names)
    with pytest.raises(ValueError, match="nothing to draw"):
        plot_schemes(type(found)(()))


def test_an_insert_has_the_angles_of_its_tool():
    """Edges from the tip: 95 degrees from the direction of feed, 30 from the axis; a blade is as wide as its tool."""
    _, trail, _, lead = insert(Tool(main_angle=95, auxiliary_angle=30), 2.0).points
    assert math.degrees(math.atan2(lead[1], -lead[0])) == pytest.approx(95)
    assert math.degrees(math.atan2(trail[1], trail[0])) == pytest.approx(30)
    assert np.ptp(insert(Tool(width=3), 2.0).points[:, 0]) == 3


def test_what_the_cuts_leave_of_a_blank():
    """A square shoulder at radius 15, 20 long, out of a half section of 60 × 30, cut by a tool that leans nowhere."""
    done = run(SQUARE, "nc-31", Setup(stock=STOCK, tools={}))
    assert done.ok
    axes = done.plot().axes[0]
    assert {"blank", "part"} <= {str(patch.get_label()) for patch in axes.patches}
    assert axes.get_xlim()[0] < -60 and axes.get_ylim()[1] > 30
    inserts = [p for p in axes.patches if isinstance(p, Polygon) and p.get_zorder() > 4]
    assert len(inserts) == 2 and not [
        p for p in plot_path(done.toolpath, insert=False).axes[0].patches if p.get_zorder() > 4
    ]


def test_bar_chuck_and_finished_profile_stand_beside_the_path():
    """Jaws of 15 mm over the last 10 mm of a bar of radius 30, and a body of radius 30 + 1.5 * 15 behind it."""
    chuck = blank.chuck(30, -60, grip=10, jaws=15, body=20)
    done = run(SQUARE, "nc-31", Setup(stock=blank.cylinder(30, -60, 0), fixtures=(chuck,)))
    picture = done.plot()
    assert {"blank", "chuck", "part"} <= {text.get_text() for text in picture.legends[0].get_texts()}
    ax = picture.axes[0]
    shown = {str(each.get_label()): each.get_path().vertices for each in ax.patches}
    assert np.ptp(shown["chuck"], axis=0) == pytest.approx((30, 22.5)) and shown["chuck"][:, 1].min() == 30
    assert shown["chuck"][:, 0].min() == -80 >= ax.get_xlim()[0]  # the whole of it is in sight
    assert {(0.0, 15.0), (-20.0, 30.0)} <= {(float(z), float(r)) for z, r in shown["part"].round(6)}


def test_a_thread_without_a_tool_is_cut_by_the_point_of_its_profile():
    """Flanks of 60 degrees, as long as the lead of 3 mm; a tool with a shape of its own keeps it."""
    point = as_drawn(Tool(), lead=3)
    (tip, right, *_, left) = insert(point, 1.0).points
    for side in (right, left):
        assert abs(math.degrees(math.atan2(side[1] - tip[1], side[0] - tip[0])) - 90) == pytest.approx(30)
    assert point.cutting_length == 3 and as_drawn(Tool(angle=55), lead=3).main_angle == pytest.approx(62.5)
    for own in (Tool(), Tool(width=3), Tool(main_angle=93), Tool(kind="drill", radius=4)):
        assert as_drawn(own, lead=0.0 if own == Tool() else 3) is own
    path = toolpath(threads.thread(2, -20, 10, (0.5, 0.9)), {"thread": 1.75})
    _, drawn = [p.get_xy() for p in path.plot().axes[0].patches if isinstance(p, Polygon) and p.get_zorder() > 4]
    assert drawn[drawn[:, 1].argmin()] == pytest.approx(path.end[-1, [2, 0]])  # its point is the tip, in its middle
    assert drawn[:, 0].min() + drawn[:, 0].max() == pytest.approx(2 * path.end[-1, 2])


def test_what_an_insert_has_cut_is_seen_through_it():
    assert INSERT["facecolor"][3] < 0.6
    for name, shade in (("insert", CARBIDE), ("holder", STEEL)):  # one colour in plots and player, light and dark
        assert [each[:7] for each in re.findall(rf"--{name}: (#\w+)", player_css())] == [shade, shade]


def test_tables_of_a_lathe_say_that_x_is_a_radius():
    turned, milled = run("G00 X20 Z5\nX10\n", "jnc-t01"), run("G0 X20\nX10\n", "mnc")
    assert "X (diameter) 0 to" in turned.plot().alt and "diameter" not in milled.plot().alt
    assert ">y<" in milled.toolpath._repr_html_() and ">y<" not in turned.toolpath._repr_html_(), "a lathe has no Y"
    assert "x (radius)" in turned.toolpath._repr_html_() and "radius" not in milled.toolpath._repr_html_()
    assert "moves, X as radius" in str(turned.explain(line=1)) and "as radius" not in str(milled.explain(line=1))


def test_an_insert_never_turns_inside_out():
    """The edge on the left stays on the left of the other one, whatever the table leaves out."""
    for tool in (
        Tool(),
        Tool(main_angle=178),
        Tool(auxiliary_angle=120),
        Tool(main_angle=45),
        Tool(auxiliary_angle=90),
    ):
        _, (right, up), _, (left, high) = insert(tool, 1.0).points
        assert right * high - up * left > 0 and high > 0 and up > 0


def test_a_blade_reaches_out_of_the_blank():
    """Its holder stays 1 mm outside: 30 + 1 - 25 long."""
    groove = Contour([(0, 30), (0, 25), (-10, 25), (-10, 30)], closed=False)
    picture = compare(groove, 30, Tool(width=4), ["descent"], depth=4).plot()
    tools = [p.get_xy() for p in picture.axes[0].patches if isinstance(p, Polygon) and p.get_zorder() == 2.1]
    assert [np.ptp(each[:, 1]) for each in tools] == [pytest.approx(6)]


def test_colours_by_spindle_speed():
    """G96 S100 while facing from diameter 100 to 0: from 318 rev/min to the limit of 3000; under G97 one speed each."""
    done = run("G96 S100 M3\nG0 X50\nG94 F100 G1 X0\n", "jnc-t01")
    scale = done.plot(colour="speed").axes
    texts = [text.get_text() for ax in scale for text in ax.texts] + [ax.get_title() for ax in scale]
    found = classes(done.toolpath, speed_strokes(done.toolpath, strokes(done.toolpath)), "speed").scale
    assert found.title == "spindle, rev/min" and found.limits[0] <= 318.3 < found.limits[1]
    assert found.limits[-2] <= 3000 <= found.limits[-1] and texts
    two = run("G97 S300 M3\nG0 X50\nG94 F100 G1 X20\nS700 X10\n", "jnc-t01").plot(colour="speed")
    assert {"300 rev/min", "700 rev/min"} <= {text.get_text() for text in two.legends[0].get_texts()}


def test_a_run_has_a_door_to_its_spindle_speeds():
    """1000 * 100 / (2 pi 50) at the first cut; the limits of the machine hold."""
    done = run("G96 S100 M3\nG0 X50\nG94 F100 G1 X0\n", "jnc-t01", Setup(limits=Limits(spindle=1500)))
    line = done.plot_speed().axes[0].lines[0].get_ydata()
    assert line[-24] == pytest.approx(100_000 / (2 * math.pi * 50)) and line.max() == 1500


def test_threads_are_drawn_with_their_lead():
    path = toolpath(threads.thread(2, -20, 10, (0.5, 0.9)), {"thread": 1.75})
    names = [text.get_text() for text in path.plot().legends[0].get_texts()]
    assert "thread, lead 1.75 mm" in names and "feed" not in names
    picture = plot_threads({m: threads.shifts((0.5, 0.9), m) for m in threads.METHODS}, (0.5, 0.9))
    assert [ax.get_title(loc="left") for ax in picture.axes] == list(threads.METHODS)


def test_spindle_speed_over_the_path():
    """Facing from radius 30 to 5 at 180 m/min: n = 1000 v / (π d), but at most 2000; along a cylinder it stays."""
    path = toolpath(compare(SHOULDER, 30, Tool(), ["loop"], depth=10)["loop"].plan, {"rough": 0.2}, 3000, surface=180)
    way, speed, diameter = speeds(path, 2000)
    assert way[-1] == pytest.approx(path.length) and (np.diff(way) >= 0).all()
    assert speed == pytest.approx(np.minimum(2000, 1000 * 180 / (math.pi * diameter)))
    picture = plot_speed(path, 1200)
    assert [ax.get_ylabel() for ax in picture.axes] == ["spindle,\nrev/min", "X (diameter),\nmm"]


def test_a_tool_that_cannot_be_is_named():
    with pytest.raises(Alarm, match="main and auxiliary angle"):
        Tool(main_angle=120, auxiliary_angle=90)


@pytest.mark.parametrize(("control", "text"), [("nc-31", "S800\nM3\n"), ("jnc-t01", "T1\nM3 S500\n"), ("jnc-t01", "M3\n")])
@pytest.mark.parametrize("stock", [None, blank.cylinder(10, -20, 0)])
def test_a_program_that_moves_nothing_has_a_picture(control, text, stock):
    found = run(text, control, Setup(stock=stock))
    assert found.ok and found.rows_from_home == 0 and "no moves" in found.plot().alt


def test_each_pass_of_a_thread_has_its_own_colour():
    depths = threads.even_chips(1.84, 5)
    for ax in plot_threads({m: threads.shifts(depths, m) for m in threads.METHODS}, depths).axes:
        shades = {tuple(each.get_facecolor()[0]) for each in ax.collections if each.get_zorder() == 2}
        assert len(shades) == len(depths)
