"""Which views a picture takes, in which unit its axes count, and what its zero points are called: issues of real programs."""

import numpy as np
import pytest

import mnclab as mnc

HEAD = "BEGIN PGM VIEWS MM\nTOOL CALL 1 {axis} S1000 F200\n"
END = "\nEND PGM VIEWS MM"


def views(run):
    """The axes of each view, right and up, from its labels."""
    return [ax.yaxis.get_label_text()[0] for ax in run.plot().axes]


@pytest.mark.parametrize("axis, plane, names", [
    ("Z", "L X+0 Y+0 Z-2\nL X+20\nCC X+20 Y+10\nC X+20 Y+20 DR+", ["XY", "XZ"]),
    ("Z", "L X+0 Y+0 Z+0\nL Y+5\nCC X+20 Z+0\nC X+40 Z+0 DR-", ["XY", "XZ"]),
    ("Z", "L X+0 Y+0 Z+0\nCC X+20 Z+0\nC X+40 Z+0 DR-", ["XZ"]),
    ("Z", "L X+0 Y+0 Z+0\nL X+5\nCC Y+20 Z+0\nC Y+40 Z+0 DR+", ["XY", "YZ"]),
    ("Z", "L X+0 Y+0 Z+0\nL Z-1\nCC X+20 Z-1\nC X+40 Z-1 DR-\nCC Y+20 Z-1\nC Y+40 Z-1 DR+", ["XY", "XZ", "YZ"]),
    ("X", "L X-2 Y+0 Z+0\nCC Y+0 Z+20\nC Y+0 Z+40 DR+", ["YZ", "XZ"]),
    ("Y", "L X+0 Y-2 Z+0\nCC X+0 Z+20\nC X+0 Z+40 DR+", ["XZ", "XY"]),
])  # fmt: skip
def test_every_plane_that_has_arcs_is_seen_and_the_tool_is_looked_along(axis, plane, names):
    run = mnc.run(HEAD.format(axis=axis) + plane + END, "tnc-620")
    assert not [alarm for alarm in run.alarms if alarm.severity == "alarm"]
    assert views(run) == [name[1] for name in names]


def test_the_axes_of_an_inch_program_count_in_inches_between_round_numbers():
    run = mnc.run("G20 G90 G54\nG0 X0 Y0 Z0.1\nG1 Z-0.1 F10\nX3\nY2\n", "iso")
    picture = run.plot()
    above = picture.axes[0]
    assert above.yaxis.get_label_text() == "Y, in"
    ticks = above.yaxis.get_majorticklocs()
    step = (ticks[1] - ticks[0]) / 25.4
    assert step / 10 ** np.floor(np.log10(step)) == pytest.approx(5) or step in (1, 2)
    written = [above.yaxis.get_major_formatter()(value, None) for value in ticks]
    assert "2" in written and ticks[written.index("2")] == pytest.approx(50.8)
    assert "X 0 to 3, Y 0 to 2, Z -0.1 to 0.1 in" in picture.alt


@pytest.mark.parametrize("colour, name", [("feed", "10 in/min"), ("z", "Z −0.1 in")])
def test_colours_of_an_inch_program_are_named_in_inches(colour, name):
    run = mnc.run("G20 G90 G54\nG0 X0 Y0 Z0.1\nG1 Z-0.1 F10\nX3\nY2\n", "iso")
    assert name in [text.get_text() for text in run.plot(colour=colour).legends[0].get_texts()]


def test_the_shifts_of_g52_and_g92_have_their_own_names():
    run = mnc.run("G54 G90 G0 X10 Y10 Z0\nG52 X20\nG1 X0 F100\nY30\nG92 Y0\nX5\n", "iso")
    above = run.plot().axes[0]
    written = {text.get_text(): text.xy for text in above.texts}  # G92 Y0 at X20 Y30: the zero of Y is there
    assert written["G52"] == pytest.approx((20, 0)) and written["G92"] == pytest.approx((20, 30))
    assert "set" in mnc.controls["g43"].frames
