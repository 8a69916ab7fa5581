"""Rapids decide no scale: the frame is that of cuts, blank and marks, and of rapids as much as has room beside them."""

import numpy as np
import pytest

import mnclab as mnc

FAR = "T1 S1000 M3\nG0 X0 Y0 Z100\nG0 Z5\nG1 Z-2 F100\nX60\nY30\nG0 Z{}\n"


def frame(ax):
    return np.array([ax.get_xlim(), ax.get_ylim()])


@pytest.mark.parametrize("high", [50, 100, 10_000])
def test_however_far_a_rapid_goes_the_picture_is_the_same(high):
    near, far = (mnc.run(FAR.format(z), "mnc").plot() for z in (40, high))
    for one, other in zip(near.axes, far.axes):
        assert frame(one) == pytest.approx(frame(other))
    assert not far.texts, "that a mill goes up tells nothing"
    side = frame(far.axes[1])
    assert side[1, 1] < -2 + 0.5 * 60 and side[1, 0] < -2  # the cuts are 60 long: no more than half of it is air above them


@pytest.mark.parametrize(("x", "said"), [(65, False), (500, True)])
def test_only_a_way_out_of_the_picture_between_two_cuts_is_told(x, said):
    text = f"T1 S1000 M3\nG0 X-300 Y0 Z5\nX0\nG1 Z-2 F100\nX60\nG0 Z5\nX{x}\nX60\nG1 Z-2\nX0\nG0 Z5\nX-300\n"
    picture = mnc.run(text, "mnc").plot()
    assert ["rapids between cuts" in text.get_text() for text in picture.texts] == [True] * said


def test_near_rapids_are_shown_whole_and_all_of_them_when_asked():
    run = mnc.run(FAR.format(8).replace("Z100", "Z8"), "mnc")
    assert not run.plot().texts and frame(run.plot().axes[1])[1, 1] >= 8
    assert frame(mnc.run(FAR.format(100), "mnc").plot(frame="all").axes[1])[1, 1] >= 100


def test_what_lies_beyond_the_border_is_not_in_the_legend():
    names = [text.get_text() for text in mnc.run(FAR.format(100), "mnc").plot(view="XZ").legends[0].get_texts()]
    assert "start" in names and "end" not in names  # it begins at zero and ends at Z100
    assert "alarm" in [text.get_text() for text in mnc.run(FAR.format(100) + "G2 X1 R1\n", "mnc").plot().legends[0].get_texts()]


def test_what_lies_in_the_margin_is_marked():
    """The frame goes by the cuts, X60 Y30 at most; the tool is changed beyond them, where there is still room."""
    change = "T1 S1000 M3\nG0 Z5\nG1 Z-2 F100\nX60\nY30\nG0 Z5\nX63 Y33\nT2\nX-200\n"
    (ax,) = mnc.run(change, "mnc").plot(view="XY").axes
    (marked,) = [line for line in ax.lines if line.get_label() == "tool change"]
    assert [63, 33] in marked.get_xydata().tolist() and frame(ax)[0, 1] > 63


def test_two_paths_are_framed_alike():
    one, other = (mnc.run(FAR.format(z).replace("X60", x), "mnc") for z, x in ((900, "X60"), (900, "X60.5")))
    side = mnc.diff(one, other).plot().axes[1]
    assert frame(side)[1, 1] < 100
    rapids = [line for line in side.lines if "rapid" in line.get_label()]
    assert len(rapids) == 2 and all(line.get_linestyle() == "--" for line in rapids)
    for size in (None, "column"):
        side = mnc.diff(one, other).plot(size=size).axes[1]
        dashes = [np.array(line._dash_pattern[1]) for line in side.lines if "rapid" in line.get_label()]
        assert dashes[0] == pytest.approx(dashes[1]), "those of the second leave the gaps of the first open"


def test_a_retraction_at_feed_does_not_set_the_scale_of_the_feed():
    """It cuts at 100 and goes up at 5000: the curve ends a little above 100."""
    text = "G90 G54 T1 S1000 M3\nG0 X0 Y0 Z5\nG1 Z-2 F100\nX60\nZ30 F5000\nG0 X0\n"
    ax = mnc.run(text, "mnc").profile().plot().axes[0]
    assert 100 < ax.get_ylim()[1] < 150 and "reach" in ax.texts[0].get_text()
