"""Symbols on one spot stand apart, rapids beside cuts have pixels of their own: places and colours, counted in pixels."""

from itertools import combinations
from pathlib import Path

import numpy as np
import pytest
from matplotlib.colors import to_rgb

import mnclab as mnc
from mnclab.show.plot import colours
from mnclab.show.plot.colours import QUARTERS

#: Lesson 0: it begins, changes the tool, goes down and ends over the datum.
SQUARE = "G90 G54 T1 S1000 M3\nG0 X0 Y0 Z5\nG1 Z-2 F100\nX40\nY40\nX0\nY0\nG0 Z5\n"
MARKS = {"start", "end", "tool change", "plunge", "datum", "stop", "dwell", "from home", "alarm"}
BLANK = mnc.Setup(stock=((-10, -10, -10), (50, 50, 0)))


def symbols(ax):
    """The places of all symbols of a view in pixels, by name."""
    found = {}
    for line in ax.lines:
        if (name := line.get_label().lstrip("_")) in MARKS and len(line.get_xdata()):
            found[name] = ax.transData.transform(line.get_xydata())
    return found


def pixels(figure):
    figure.canvas.draw()
    return np.asarray(figure.canvas.buffer_rgba())[..., :3].astype(int)


@pytest.mark.parametrize("scale", [0.00025, 1, 125])
@pytest.mark.parametrize("view", ["auto", "XY", "XZ", "YZ"])
def test_no_two_symbols_of_lesson_0_coincide(view, scale):
    text = "\n".join(_scaled(line, scale) for line in SQUARE.splitlines())
    for ax in mnc.run(text, "mnc").plot(view=view).axes:
        found = symbols(ax)
        assert {"start", "end", "tool change", "datum"} <= found.keys()
        for one, other in combinations(np.concatenate(list(found.values())), 2):
            assert np.hypot(*(one - other)) > 6


def _scaled(line, scale):
    words = (word if word[0] not in "XYZ" else f"{word[0]}{float(word[1:]) * scale:.5f}" for word in line.split())
    return " ".join(words)


def test_the_datum_keeps_its_place_and_the_others_have_leaders_to_it():
    above, _ = mnc.run(SQUARE, "mnc").plot().axes
    assert above.transData.inverted().transform(symbols(above)["datum"]) == pytest.approx(np.zeros((1, 2)), abs=1e-9)
    (leaders,) = (each for each in above.collections if each.get_label() == "_leader")
    ends = np.array([segment for segment in leaders.get_segments()])
    assert len(ends) == 4 and ends[:, 0] == pytest.approx(np.zeros((4, 2)), abs=1e-9)
    others = np.concatenate([places for name, places in symbols(above).items() if name != "datum"])
    assert np.sort(above.transData.transform(ends[:, 1]), axis=0) == pytest.approx(np.sort(others, axis=0))


@pytest.mark.parametrize("size", ["column", "slide", "a4"])
def test_symbols_that_moved_are_near_their_place_and_their_leaders_lie_over_the_path(size):
    """The lid begins and ends over X58 Y40, where it changes tools: both stand aside by 5 mm on an A4 page at most."""
    picture = mnc.run(Path(__file__).parents[2] / "data/programs/tnc-620/lid.h").plot(size=size)
    above = picture.axes[0]
    (leaders,) = (each for each in above.collections if each.get_label() == "_leader")
    moves = [each for each in (*above.lines, *above.collections) if each.get_label() in ("rapid", "feed", "_arrows")]
    assert len(moves) > 2 and leaders.get_zorder() > max(each.get_zorder() for each in moves)
    away = above.transData.transform([(58, 40)]) - np.concatenate([symbols(above)[name] for name in ("from home", "end")])
    assert np.hypot(*away.T).max() / picture.dpi * 25.4 < {"column": 4, "a4": 5, "slide": 9}[size]


def test_symbols_stay_inside_and_alone_ones_where_they_are():
    picture = mnc.run("G90 G54 T1 S1000 M3\nG0 X10 Y10 Z5\nG1 X40 F100\nY40\n", "mnc").plot(view="XY")
    (ax,) = picture.axes
    assert ax.transData.inverted().transform(symbols(ax)["end"]) == pytest.approx(np.array([[40, 40]]))
    low, high = ax.bbox.min, ax.bbox.max
    assert all(((places > low) & (places < high)).all() for places in symbols(ax).values())


def test_the_sign_of_a_datum_is_a_circle_of_which_two_opposite_quarters_are_filled():
    figure = mnc.run("G90 G54 S1000 M3\nG1 X40 F100\n", "mnc", mnc.Setup(start=(-30, 10, 0))).plot(view="XY")
    (ax,) = figure.axes
    (datum,) = (line for line in ax.lines if line.get_label() == "_datum")
    assert datum.get_marker() is QUARTERS
    image, (x, y) = pixels(figure), ax.transData.transform((0, 0))
    at = [image[int(len(image) - (y + up)), int(x + right)].sum() for right, up in ((3, 3), (-3, 3), (-3, -3), (3, -3))]
    assert at[0] < 200 and at[2] < 200 and at[1] > 600 and at[3] > 600


@pytest.mark.parametrize("setup", [mnc.Setup(), BLANK])
def test_every_rapid_of_lesson_0_has_pixels_of_its_own(setup):
    """Two rapids up along X0 (Z0 to Z5, Z-2 to Z5), one cut down: three lines that share no pixel column at Z2.5."""
    run = mnc.run(SQUARE, "mnc", setup)
    side = run.plot().axes[1]
    rapid = next(line for line in side.lines if line.get_label() == "rapid")
    xy = side.transData.transform(rapid.get_xydata())
    middle = side.transData.transform((0, 2.5))
    pairs = [(a, b) for a, b in zip(xy[:-1], xy[1:]) if np.isfinite([a, b]).all()]
    crossing = [float(a[0]) for a, b in pairs if min(a[1], b[1]) < middle[1] < max(a[1], b[1])]
    ups = [move for move in run.toolpath if move.kind == mnc.Kind.RAPID and min(move.start[2], move.end[2]) < 2.5]
    assert len(crossing) == len(ups) - (setup is BLANK)  # the way from home is not shown
    for one, other in combinations([*crossing, float(middle[0])], 2):
        assert abs(one - other) > 2


def test_both_ways_over_a_cut_are_red_somewhere():
    """There at feed, back at rapid: the picture has the red of rapids though both lie on one line."""
    figure = mnc.run("G90 G54 T1 S1000 M3\nG0 X0 Y0\nG1 X40 F100\nG0 X0\n", "mnc").plot(view="XY", marks=False, arrows=False)
    red = np.array(to_rgb(colours.RAPID.colour)) * 255
    (ax,) = figure.axes
    image = pixels(figure)
    row = int(len(image) - ax.transData.transform((20, 0))[1])
    near = image[row - 6 : row + 7, int(ax.bbox.x0) + 30 : int(ax.bbox.x1) - 30]
    assert (np.abs(near - red).max(axis=2) < 40).any(axis=0).sum() > 60


def test_a_feed_move_upwards_is_no_plunge():
    text = "G90 G54 T1 S1000 M3\nG0 X0 Y0 Z5\n{}G1 X10 Y10 F100\nZ{}\nX20\n"  # a plunge where nothing follows is a hole
    down, up = (mnc.run(text.format("", z), "mnc").plot(view="XY").axes[0] for z in (-2, 9))
    assert "plunge" in symbols(down) and "plunge" not in symbols(up)
