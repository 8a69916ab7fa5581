"""The picture of compared strategies: what is drawn, at one scale, and nothing over anything else."""

import numpy as np
import pytest
from matplotlib.collections import LineCollection

from mnclab.comparison.strategies import compare
from mnclab.geometry.contours import Contour, rectangle
from mnclab.geometry.regions import Region
from mnclab.show.plot.pocketing import plot_strategies

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
