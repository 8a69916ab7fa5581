"""Panels: the orders of their numbers, sliders, functions as templates; axes that stay, and the ghost of what was before."""

import re

import ipywidgets
import numpy as np
import pytest

import mnclab
from mnclab import Alarm, Kind
from mnclab.lab.forms.fields import place_of
from mnclab.show.plot import colours
from mnclab.show.plot.layers import gone, held_box

TEMPLATE = "G90 G54 S500 M3\nG0 X0 Y0 Z5\nG1 X{side} F{feed}\nY{side}\nX0\nY0\n"


def square(side):
    return mnclab.run(TEMPLATE.format(side=side, feed=100), "mnc")


def grey(ax):
    """The points of the ghost in an axes."""
    looks = (colours.GHOST.name, colours.GHOST_RAPID.name)
    found = [line.get_xydata() for line in ax.lines if line.get_label() in looks]
    return np.concatenate(found) if found else np.empty((0, 2))


# --- the numbers of a place ------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("given", "value", "limits", "step"),
    [
        (40.0, 40.0, None, None),
        ((40, 10, 60), 40, (10, 60), None),
        ((10, 10, 60), 10, (10, 60), None),
        ((-10, -1, 0.5), -5.5, (-10, -1), 0.5),  # the middle, and a step
        ((0, 10, 3), 6, (0, 10), 3),  # 5 lies between the steps 3 and 6
        ((0, 50), 25, (0, 50), None),  # as ipywidgets.interact has it: the middle of whole numbers is whole
        ((0, 5), 2, (0, 5), None),
        ((0.0, 5.0), 2.5, (0, 5), None),
        ((0.1, 0.5, 0.1), 0.3, (0.1, 0.5), 0.1),  # and not 0.30000000000000004
    ],
)
def test_a_range_and_the_two_orders_of_three_numbers(given, value, limits, step):
    place = place_of("depth", given)
    assert (place.value, place.limits, place.step) == (value, limits, step)
    assert isinstance(place.value, int) == all(isinstance(each, int) for each in (given if isinstance(given, tuple) else [given]))


WRONG = [(5, 3, 1), (1, 2, 3), (0, 10, 0), (0, 10, -1), (0, 10, 11), (2, 1), (1, 1), (), "5", (1, "2", 3)]


@pytest.mark.parametrize("given", WRONG)
def test_an_order_that_means_nothing_is_refused_with_what_to_write(given):
    with pytest.raises(Alarm) as caught:
        mnclab.panel("G0 Z{depth}\n", "mnc", depth=given)
    assert "depth" in caught.value.message


def test_a_slider_and_its_box_follow_each_other():
    live = mnclab.panel(TEMPLATE, "mnc", side=(40.0, 10.0, 60.0), feed=100, sliders=True)
    box, slider = live.fields["side"].parts
    assert isinstance(slider, ipywidgets.FloatSlider) and box.description == "side" and not slider.tabbable
    slider.value = 20.0
    assert box.value == 20 and live.run.toolpath.bounds[1][0] == 20
    box.value = 30.0
    assert slider.value == 30
    run = live.run
    slider.value = 30.000000000000004  # what a slider says of itself when it appears
    assert live.run is run and box.value == 30
    assert live.fields["feed"].parts == (live.boxes["feed"],), "a number without limits has none"


def test_a_step_of_a_slider_is_a_step_of_its_box():
    live = mnclab.panel("G0 Z{depth}\n", "mnc", depth=(-10, -1, 0.5), sliders=True)
    box, slider = live.fields["depth"].parts
    assert (slider.min, slider.max, slider.step, box.step) == (-10, -1, 0.5, 0.5)
    slider.value = -3.4999999
    assert box.value == -3.5


@pytest.mark.parametrize(("given", "said"), [({"sliders": True}, "needs limits"), ({"sliders": 1}, "True or False")])
def test_sliders_are_refused_in_words(given, said):
    with pytest.raises(Alarm, match=said):
        mnclab.panel("G0 X{x}\n", "mnc", x=5, **given)


# --- a function as template ------------------------------------------------------------------------------------------


def test_a_function_makes_the_text():
    live = mnclab.panel(lambda side, feed=100: f"S500 M3\nG1 X{side} F{feed}\n", "mnc", side=12.0)
    assert live.run.toolpath.bounds[1][0] == 12
    live.boxes["side"].value = 7.0
    assert live.run.toolpath.bounds[1][0] == 7


@pytest.mark.parametrize(
    ("template", "numbers", "said"),
    [
        (lambda side: "", {}, "{side} has no number"),
        (lambda side: "", {"side": 1, "sid": 2}, "{sid} has no place"),
        (5, {}, "or of a function"),
    ],
)
def test_a_function_and_its_numbers_must_match(template, numbers, said):
    with pytest.raises(Alarm) as caught:
        mnclab.panel(template, "mnc", **numbers)
    assert said in caught.value.message


@pytest.mark.parametrize(("template", "said"), [(lambda x: 1 / 0, "ZeroDivisionError"), (lambda x: 5, "must return the text")])
def test_faults_of_a_function_are_alarms_of_the_panel(template, said):
    assert said in mnclab.panel(template, "mnc", x=1).alarms.value


# --- axes that stay, and the ghost -----------------------------------------------------------------------------------


def test_a_picture_keeps_the_axes_of_the_one_before_while_it_fits():
    small, wider = square(40), square(42)
    first = small.plot(size=(5, 4))
    second = wider.plot(size=(5, 4), under=small.toolpath, limits=first.box)
    for one, two in zip(first.axes, second.axes):
        assert one.get_xlim() == two.get_xlim() and one.get_ylim() == two.get_ylim()
        assert one.get_position().bounds == two.get_position().bounds
    assert grey(second.axes[0])[:, 0].max() == 40, "the ghost is where the side was"
    large = square(80).plot(size=(5, 4), under=wider.toolpath, limits=second.box)
    assert large.axes[0].get_xlim()[1] > 80
    back = small.plot(size=(5, 4), limits=large.box)
    assert back.axes[0].get_xlim() == large.axes[0].get_xlim(), "what has grown stays"
    assert wider.plot().alt == second.alt, "what is told is the path, not the axes"


def test_a_slip_of_the_finger_does_not_make_the_picture_small_for_ever():
    low, high = held_box(np.zeros(3), np.full(3, 40.0), (np.zeros(3), np.full(3, 4000.0)))
    assert high.tolist() == [40, 40, 40] and low.tolist() == [0, 0, 0]


def test_a_ghost_has_only_what_is_no_longer_there():
    """Of a square whose feed alone is changed nothing is gone; of one with another side three of its four sides."""
    one, other = square(40), square(42)
    assert len(gone(one.toolpath, mnclab.run(TEMPLATE.format(side=40, feed=50), "mnc").toolpath)) == 0
    left = gone(one.toolpath, other.toolpath)
    assert len(left) == 4 and (left.kind == Kind.LINE).all()
    assert len(grey(one.plot(under=one.toolpath).axes[0])) == 0


@pytest.mark.parametrize("side", [0.01, 5000.0])
def test_a_ghost_is_of_any_size(side):
    former = square(side)
    drawn = square(side * 1.05).plot(under=former.toolpath, limits=former.plot().box)
    assert grey(drawn.axes[0])[:, 0].max() == pytest.approx(side)


def test_a_panel_shows_where_the_path_went_before():
    """The limits of the picture before, and its path: they are what the next drawing is given."""
    live = mnclab.panel(TEMPLATE, "mnc", side=40.0, feed=100)
    box, path = live.box, live.former
    assert path is live.run.toolpath
    live.boxes["side"].value = 42.0
    assert np.array_equal(live.box, box) and live.former is live.run.toolpath and live.former is not path
    live.boxes["feed"].value = 0
    assert live.former.bounds[1][0] == 42, "what was refused leaves no ghost"


def test_a_compensation_keeps_its_axes_and_shows_the_path_of_the_former_radius():
    text = "G90 G54 S500 M3 T2 D2\nG0 X-20 Y-20 Z5\nG1 G41 X0 Y0 F100\nY40\nX40\nY0\nX0\nG40 X-20 Y-20\n"
    run = mnclab.run(text, "mnc")
    live = mnclab.compensation_panel(run)
    live.boxes["radius"].value = 3.0
    kept = live.box
    live.boxes["radius"].value = 3.5
    assert np.array_equal(live.box, kept) and "radius 3.5 mm" in live.picture.value
    former = run.again(run.setup.with_radius(3.0)).toolpath
    drawn = live.run.plot_compensation(under=former, limits=kept)
    points = grey(drawn.axes[0])
    assert len(points) and np.nanmin(points[:, 0]) == pytest.approx(-20)  # where the approach began
    assert 43 == pytest.approx(np.nanmax(points[:, 0])), "the side at X40 and the radius of 3"


def test_a_profile_keeps_its_axes_and_shows_the_former_one():
    live = mnclab.profile_panel(square(40).profile())
    profile, kept = live.profile, live.box
    live.boxes["acceleration"].value = live.boxes["acceleration"].value / 2
    assert live.former is live.profile and live.profile is not profile
    for now, before in zip(live.box, kept):
        assert now[0][0] <= before[0][0] and now[0][1] >= before[0][1] and now[1][1] >= before[1][1]
    drawn = live.profile.plot(under=profile)
    assert grey(drawn.axes[0])[:, 0].max() == pytest.approx(profile.time)
    live.boxes["acceleration"].value = -1
    assert "last good picture" in live.picture.value and live.fields["acceleration"].fault.value


def test_a_profile_begins_as_it_was_planned_though_its_axes_differ():
    """The box of X, Y and Z has the least of 400, 900 and 300; none counts for all before it is changed."""
    profile = square(40).again(mnclab.Setup(limits=mnclab.Limits(acceleration=(400, 900, 300)))).profile()
    live = mnclab.profile_panel(profile)
    assert live.boxes["acceleration"].value == 300 and live.profile.time == profile.time
    live.boxes["acceleration"].value = 200
    assert live.profile.time > profile.time and live.profile.limits.acceleration == 200


def test_a_pocket_follows_its_strategy_and_its_tool():
    live = mnclab.pocket_panel(diameter=8, share=0.4)
    live.boxes["strategy"].value = "zigzag"
    assert "zigzag" in live.alarms.value and live.trial.name == "zigzag"
    live.boxes["diameter"].value = 10.0
    assert live.trial.clearing.radius == 5 and np.degrees(live.trial.limit) == pytest.approx(90)
    wrong = (("share", -1.0, "greater than 0"), ("diameter", 90.0, "does not fit"), ("limit", 999.0, "at most 360"))
    for name, value, says in wrong:
        before = live.boxes[name].value
        live.boxes[name].value = value
        assert says in live.fields[name].fault.value and "last good picture" in live.picture.value
        live.boxes[name].value = before
        assert not live.fields[name].fault.value and "last good picture" not in live.picture.value


@pytest.mark.parametrize(
    ("made", "says"),
    [
        (lambda: mnclab.profile_panel(square(40).profile(), foo=1), "no option foo"),
        (lambda: mnclab.compensation_panel(square(40), radius=5), "no option radius"),
        (lambda: mnclab.panel("G0 X{x}\n", "foo", x=5), "no control 'foo'"),
        (lambda: mnclab.pocket_panel(3), "on a Region"),
        (lambda: mnclab.pocket_panel(strategy="ring"), "strategy must be"),
        (lambda: mnclab.pocket_panel(foo=1), "no option 'foo'"),
        (lambda: mnclab.pocket_panel(stepover=2), "boxes in place of stepover"),
    ],
)
def test_what_no_box_can_mend_is_refused_at_once(made, says):
    with pytest.raises(mnclab.Alarm, match=says):
        made()


# --- what is left where no widget is ---------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "made",
    [
        lambda: mnclab.form("G83", "mnc"),
        lambda: mnclab.panel(TEMPLATE, "mnc", side=40.0, feed=100),
        lambda: mnclab.compensation_panel(square(40)),
        lambda: mnclab.profile_panel(square(40).profile()),
        lambda: mnclab.pocket_panel(),
        lambda: mnclab.editor("data/programs/mnc/square.mnc"),
    ],
)
def test_everything_live_has_a_still_picture_and_its_values(made):
    live = made()
    bundle = live._repr_mimebundle_()
    assert bundle["application/vnd.jupyter.widget-view+json"]["model_id"] == live.model_id
    assert bundle["image/png"].startswith("iVBORw0KGgo"), "PNG in base64"
    assert bundle["image/png"] in bundle["text/html"] and re.search(r'<img alt="[^"]{10}', bundle["text/html"])
    for name, box in live.boxes.items():
        assert f">{box.description or name}</td>" in bundle["text/html"]
    assert "VBox" not in bundle["text/plain"]


def test_the_still_values_are_the_last_ones_in_words():
    live = mnclab.form("CYCL DEF 251", "tnc-620")
    live.boxes["depth"].value = -12.5
    live.ticks["finishing_feed"].value = False
    still = live.still()["text/plain"]
    for name, value in (("Q201 depth [mm]", "-12.5"), ("Q215 machining operation", "0 roughing and finishing")):
        assert f"{name}: {value}" in still
    assert "Q385 finishing feed rate [mm/min]: left out" in still
    live.boxes["infeed"].value = -5
    assert "last good picture" in live.still()["text/html"] and 'role="alert"' in live.still()["text/html"]
