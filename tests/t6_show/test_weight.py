"""How much ink a path gets: bands where passes crowd, hues that differ, slow stretches that are wide, the blank behind all."""

import re
from pathlib import Path

import numpy as np
import pytest
from matplotlib.colors import to_rgb

import mnclab as mnc
from mnclab.show.plot import layers
from mnclab.show.plot.classes import BLOCKS, step_name

PROGRAMS = Path(__file__).parents[2] / "data" / "programs"
#: Passes 1 mm apart with a tool of radius 4, and the same 20 mm apart.
HEAD = "G90 G54 T1 S1000 M3\nG0 X0 Y0 Z5\nG1 Z-2 F100\n"
SETUP = mnc.Setup(tools={1: mnc.Tool(radius=4)}, stock=((-10, -10, -10), (70, 70, 0)))


def passes(apart):
    return HEAD + "".join(f"X{60 * (1 - k % 2)}\nY{apart * (k + 1)}\n" for k in range(int(60 / apart)))


def bands(ax):
    return [line for line in ax.lines if isinstance(line, layers.Band)]


def named(ax, name):
    return next(line for line in ax.lines if line.get_label() == name)


@pytest.mark.parametrize(("apart", "wanted", "found"), [(1, None, 1), (20, None, 0), (20, True, 1), (1, False, 0)])
def test_a_band_is_drawn_where_passes_crowd_or_where_it_is_wanted(apart, wanted, found):
    above, side = mnc.run(passes(apart), "mnc", SETUP).plot(band=wanted).axes
    assert (len(bands(above)), len(bands(side))) == (found, 0)


def test_the_picture_has_room_for_the_band():
    """Passes from X0 Y0 to X60 with a tool of radius R cut from -R to 60 + R."""
    run = mnc.run(passes(1), "mnc", mnc.Setup(tools={1: mnc.Tool(radius=20)}))
    radius, (left, right) = run.toolpath.radius.max(), run.plot(view="XY", band=True).axes[0].get_xlim()
    assert left <= -radius and right >= run.toolpath.end[:, 0].max() + radius


def test_pockets_seen_small_above_their_depths_have_bands():
    """A facing and two pockets share half of the picture with the view from the side: a line of 2 points is a blot there."""
    above, side = mnc.run(PROGRAMS / "mnc" / "milled_plate.mnc").plot().axes
    assert bands(above)
    assert not bands(side)


def test_a_band_is_as_wide_as_the_tool_and_its_line_is_thin():
    figure = mnc.run(passes(1), "mnc", SETUP).plot(view="XY")
    figure.canvas.draw()
    (ax,) = figure.axes
    (one,) = bands(ax)
    pixels = float(np.ptp(ax.transData.transform([(0, 0), (8, 0)])[:, 0]))  # of the diameter
    assert one.get_linewidth() * figure.dpi / 72 == pytest.approx(pixels)
    assert named(ax, "feed").get_linewidth() < 1


def test_a_crowd_of_passes_is_no_solid_bar():
    """Passes 1 mm apart over 60 mm: between two of them the band is seen."""
    figure = mnc.run(passes(1), "mnc", SETUP).plot(view="XY", arrows=False)
    figure.canvas.draw()
    (ax,) = figure.axes
    image = np.asarray(figure.canvas.buffer_rgba())[..., :3].astype(int)
    x, low = ax.transData.transform((30, 10))
    high = ax.transData.transform((30, 50))[1]
    column = image[len(image) - int(high) : len(image) - int(low), int(x)]
    pale = (np.abs(column - np.array(to_rgb(layers.BAND_SHADE)) * 255).max(axis=1) < 30).mean()
    assert pale > 0.4


FEEDS = "G90 G54 T1 S1000 M3\nG0 X0 Y0 Z5\nG1 Z-2 F{}\nX40 F{}\nY40 F{}\n"


def lab(colour):
    """CIE L*a*b* of a colour under D65, from its definition (CIE 15)."""
    rgb = np.array(to_rgb(colour))
    linear = np.where(rgb <= 0.04045, rgb / 12.92, ((rgb + 0.055) / 1.055) ** 2.4)
    xyz = np.array([[0.4124564, 0.3575761, 0.1804375], [0.2126729, 0.7151522, 0.0721750], [0.0193339, 0.1191920, 0.9503041]])
    x, y, z = (np.cbrt(v) if v > 0.008856 else 7.787 * v + 16 / 116 for v in xyz @ linear / (0.95047, 1, 1.08883))
    return np.array([116 * y - 16, 500 * (x - y), 200 * (y - z)])


@pytest.mark.parametrize("feeds", [(400, 600), (100, 400, 600), (100, 200, 300, 400, 500, 600)])
def test_feeds_differ_in_hue_and_the_slower_is_wider(feeds):
    text = "G90 G54 T1 S1000 M3\nG0 X0 Y0 Z5\n" + "".join(f"G1 X{k + 1} Y{(k % 2) * 9} F{feed}\n" for k, feed in enumerate(feeds))
    (ax,) = mnc.run(text, "mnc").plot(colour="feed", view="XY").axes
    lines = [named(ax, f"{feed} mm/min") for feed in feeds]
    shades = [lab(line.get_color()) for line in lines]
    assert min(np.linalg.norm(a - b) for k, a in enumerate(shades) for b in shades[k + 1 :]) > 20
    assert (np.diff([line.get_linewidth() for line in lines]) < 0).all()


@pytest.mark.parametrize(
    ("label", "name"),
    [
        ("", BLOCKS),
        ("outside corner", BLOCKS),
        ("G303 layer 2 of 3, ring 1 of 2", "roughing"),
        ("CYCL DEF 251 layer 1 of 3, entry helix", "entry"),
        ("CYCL DEF 251 side finishing", "side finishing"),
        ("G83 peck 3 of 5", "peck"),
        ("G77 pass 4 of 4, contour", "finishing"),
        ("CYCL DEF 222 finishing, line 2 of 4", "finishing"),
    ],
)
def test_a_step_has_the_name_of_its_work(label, name):
    assert step_name(label) == name


def test_colour_by_step_names_what_a_cycle_does():
    pocket = mnc.run(Path(__file__).parents[2] / "data/programs/tnc-620/pocket.h")
    figure = pocket.plot(colour="step", view="XY")
    words = {text.get_text() for legend in figure.legends for text in legend.get_texts()}
    assert {"roughing", "side finishing", "floor finishing", "entry"} <= words
    looks = [(line.get_linestyle(), line._dash_pattern) for line in figure.axes[0].lines if line.get_label() in words - {"rapid"}]
    assert len(set(map(str, looks))) >= 4  # told apart in grey


def test_slow_corners_are_wide_and_say_their_feed():
    """Under 500 mm/s² and 0.02 mm a right angle is taken with v² = 8 ε a / √2: 451 mm/min, and 2.5 mm before it is full."""
    text = "G64 G90 G54 T1 S1000 M3\nG1 X40 F3000\nY40\n"
    figure = mnc.run(text, "mnc").profile(mnc.Limits(acceleration=500, corner_tolerance=0.02)).plot_reached(view="XY")
    (ax,) = figure.axes
    feed = 60 * np.sqrt(8 * 0.02 * 500 / np.sqrt(2))
    assert any(re.fullmatch(f"{feed:.0f}", each.get_text()) for each in ax.texts)
    assert named(ax, "corner").get_xydata() == pytest.approx(np.array([[40, 0]]))
    wide = [line.get_linewidth() for line in ax.lines if line.get_label().endswith("mm/min")]
    assert wide[0] > 2 * wide[-1]


def test_the_rapid_of_two_axes_is_bent_where_one_arrives():
    """N240 of the lesson: 98 mm of X and 34 of Y; Y stands still first, from there on the picture goes along X alone."""
    text = "G90 G54 S1000 M3\nG0 X78 Y14\nX-20 Y-20\n"
    above = mnc.run(text, "mnc", mnc.Setup(start=(78, 14, 0))).plot(view="XY").axes[0]
    xy = named(above, "rapid").get_xydata()
    v, a = 10_000 / 60, 1000  # mm/s, mm/s² of the usual limits
    arrives = 78 - (v * (34 / v + v / a) - v**2 / 2 / a)
    assert xy[np.isclose(xy[:, 1], -20), 0].max() == pytest.approx(arrives, abs=0.1)
    straight = mnc.run(text, "mnc", mnc.Setup(start=(78, 14, 0), limits=mnc.Limits(rapid_motion="line"))).plot(view="XY")
    assert len(named(straight.axes[0], "rapid").get_xydata()) == 2


@pytest.mark.parametrize("door", ["plot", "plot_compensation"])
def test_the_blank_lies_behind_the_contour(door):
    text = "G90 G54 T1 S1000 M3\nG0 X-20 Y20\nG41 G1 X0 Y0 F100\nX40\nY40\nX0\nY0\nG40 X-20 Y-20\n"
    run = mnc.run(text, "mnc", SETUP)
    for figure, there in ((getattr(run, door)(view="XY"), True), (getattr(run, door)(view="XY", stock=False), False)):
        patches = [each for each in figure.axes[0].patches if each.get_label() == "_blank"]
        assert bool(patches) is there
        if there:
            assert patches[0].get_xy().min(axis=0).tolist() == [-10, -10] and patches[0].get_xy().max(axis=0).tolist() == [70, 70]
            assert patches[0].get_zorder() < min(line.get_zorder() for line in figure.axes[0].lines)
