"""The picture of compared strategies: what is drawn, at one scale, and nothing over anything else."""

import itertools

import numpy as np
import pytest
from matplotlib.collections import LineCollection
from tools.together import deep_but_one_in

import mnclab
from mnclab.comparison.strategies import compare
from mnclab.geometry.contours import Contour, rectangle
from mnclab.geometry.regions import Region
from mnclab.show.plot.pocketing import envelope, plot_strategies, plot_times

AREA = Region.of(rectangle(60, 40), holes=[Contour.circle((0, 0), 8)])


@pytest.fixture(scope="module")
def found():
    return compare(AREA, 4.0, ("rings", "zigzag", "spiral", "one way"))


def test_views_and_one_scale(found):
    picture = found.plot()
    *views, scale = picture.axes
    assert [ax.get_title(loc="left") for ax in views] == ["rings", "zigzag", "spiral", "one way"]
    assert scale.get_xlabel() == "engagement, degrees"
    for ax, trial in zip(views, found.trials, strict=True):
        assert ax.get_aspect() == 1.0
        (lines,) = [c for c in ax.collections if isinstance(c, LineCollection)]
        assert np.degrees(trial.engagement.angle) == pytest.approx(np.asarray(lines.get_array()))
        low, high = ax.get_xlim()
        assert low < -30 and high > 30


def test_nothing_overlaps(found):
    picture = found.plot(width=8)
    picture.canvas.draw()
    boxes = [ax.get_tightbbox() for ax in picture.axes]
    boxes += [legend.get_window_extent() for legend in picture.legends]
    for i, a in enumerate(boxes):
        assert a.x0 >= -0.5 and a.x1 <= picture.bbox.x1 + 0.5 and a.y0 >= -0.5 and a.y1 <= picture.bbox.y1 + 0.5
        for b in boxes[i + 1 :]:
            assert not a.overlaps(b)


def test_the_greatest_engagement_and_what_was_cleared_before():
    trials = compare(AREA, 4.0, ("rings", "fine"), coarse=9.0)
    picture = trials.plot()
    for ax, trial in zip(picture.axes, trials.trials, strict=False):
        assert ax.get_title(loc="right") == f"greatest {trial.row['most']:.0f}°"
    (legend,) = picture.legends
    assert [text.get_text() for text in legend.get_texts()][:2] == ["entry", "cleared by the coarse tool"]
    test_nothing_overlaps(trials)


def test_a_single_trial_and_none(found):
    assert len(plot_strategies(found[0]).axes) == 2
    with pytest.raises(ValueError, match="nothing to draw"):
        plot_strategies(type(found)(()))


def test_all_strategies_stay_as_large_in_a_column_as_two_of_them():
    """A view is as wide whatever their number: the figure grows downwards. Two stand in a row of a column, three at most."""
    few, many = compare(AREA, 4.0, ("rings", "zigzag")), compare(AREA, 4.0, {f"way {k}": "rings" for k in range(10)})
    wide = [found.plot(size="column").axes[0].get_position().width for found in (few, many)]
    assert wide[0] == pytest.approx(wide[1])
    for size, most in ((None, 3), ("a4", 3), ("column", 2)):
        places = {round(ax.get_position().x0, 6) for ax in many.plot(size=size).axes[:-1]}
        assert len(places) <= most


SIZED = deep_but_one_in(4, itertools.product([None, "column", "a4", "slide"], ["paths", "engagement", "passes"]))


@pytest.mark.parametrize("size, kind", SIZED)
def test_every_kind_and_size_keeps_its_words_apart(found, kind, size):
    picture = found.plot(kind, size=size)
    picture.canvas.draw()
    words = [text for ax in picture.axes for text in (*ax.texts, ax.title, ax._left_title, ax._right_title)]
    words += [axis.label for ax in picture.axes for axis in (ax.xaxis, ax.yaxis)]
    boxes = [text.get_window_extent() for text in words if text.get_text() and text.get_visible()]
    boxes += [legend.get_window_extent() for legend in picture.legends]
    for i, a in enumerate(boxes):
        assert a.x0 >= -0.5 and a.x1 <= picture.bbox.x1 + 0.5 and a.y0 >= -0.5 and a.y1 <= picture.bbox.y1 + 0.5
        assert not any(a.overlaps(b) for b in boxes[i + 1 :])


def test_engagement_over_the_way_and_its_limit(found):
    axes = found.plot("engagement").axes
    for ax, trial in zip(axes, found.trials, strict=True):
        curve, limit = ax.lines
        assert curve.get_ydata().max() == pytest.approx(np.degrees(trial.engagement.most()))
        assert set(limit.get_ydata()) == {90.0}
        assert ax.get_xlim() == axes[0].get_xlim() and ax.get_ylim() == axes[0].get_ylim()


def test_an_envelope_keeps_what_is_least_and_greatest_in_each_column():
    x, y = np.arange(12345.0), np.random.default_rng(1).normal(size=12345)
    along, kept = envelope(x, y, most=100)
    assert len(along) == len(kept) == 100
    assert kept.min() == y.min() and kept.max() == y.max()
    first = [k for k in range(12345) if k >= 12344 / 50]
    assert kept[:2].tolist() == [y[: first[0]].min(), y[: first[0]].max()]
    assert envelope(x[:100], y[:100], most=100)[1] is not None and (envelope(x[:100], y[:100])[1] == y[:100]).all()


def test_what_passes_leave_gets_less_up_to_the_corners(found):
    picture = found["one way"].plot("passes", width=9)
    left = [float(ax.get_title(loc="right").split()[0]) for ax in picture.axes]
    assert len(left) == 12 and left == sorted(left, reverse=True)
    assert left[-1] == round((4 - np.pi) * 4**2), "what a disc leaves of four square corners"
    one = compare(Region.of(Contour.circle((0, 0), 10)), 6.0, "rings", overlap=0.2)[0]  # a ring of radius 4 clears it all
    first = one.plot("passes").axes[0]
    assert first.get_title(loc="left") == "pass 1"


def test_times_by_tool_stepover_and_strategy():
    many = {(d, s): compare(AREA, d / 2, ("rings", "zigzag"), stepover=s) for d in (6, 8) for s in (2.0, 3.0)}
    picture = mnclab.strategies.plot_times(many)
    assert [ax.get_title(loc="left") for ax in picture.axes] == ["⌀ 6 mm", "⌀ 8 mm"]
    for ax, d in zip(picture.axes, (6, 8), strict=True):
        assert ax.get_xlabel() == "stepover, mm"
        for line, name in zip(ax.lines, ("rings", "zigzag"), strict=True):
            assert line.get_ydata().tolist() == [many[d, s][name].time for s in (2.0, 3.0)]
    assert picture.axes[0].get_ylabel() == "time, s"


@pytest.mark.parametrize("wrong", [None, {}, {"a": 1}, {(6, 2.0): 3}, {(6,): None}])
def test_times_of_something_else(wrong):
    with pytest.raises(mnclab.Alarm, match="comparison"):
        plot_times(wrong)


def test_a_kind_of_figure_that_there_is_not(found):
    with pytest.raises(mnclab.Alarm, match="kind of a figure must be paths, engagement or passes"):
        found.plot("engagements")
