"""What the colours of a path show, the arrowheads, and the crosses at zero points and poles."""

from functools import partial
from pathlib import Path

import numpy as np
import pytest
from matplotlib.collections import PathCollection
from matplotlib.colors import to_rgb
from tools import running

import mnclab
from mnclab import Alarm, Kind, Toolpath
from mnclab.show.plot import classes, placing
from mnclab.show.plot.path import plot_path

FIRST = (Path(__file__).parents[2] / "data/programs/mnc/first_path.mnc").read_text("utf-8")
SQUARE = "G90 G54\nG0 X0 Y0 Z5\nG1 Z-2 F100\nX40\nY40\nX0\nY0\nG0 Z5\n"
FIXED = ("rapid", "probing", "programmed", "start", "end", "plunge", "tool change", "_datum", "_pole", "_holes", "_hole centres")

run = partial(running.run, ok=None)


def divided(ax):
    """The lines of the classes that a colour divides, by name."""
    return {line.get_label(): line for line in ax.lines if line.get_label() not in FIXED}


def drawn_length(line):
    return float(np.nansum(np.hypot(*np.diff(line.get_xydata(), axis=0).T)))


def waves(n, **columns):
    """A path of n straight cuts over a wavy surface."""
    k = np.arange(n + 1)
    xyz = np.stack([k % 100 * 0.5, k // 100 * 0.5, 4 * np.sin(k / 9)], axis=1)
    return Toolpath.chain(xyz, {"kind": np.full(n, Kind.LINE, np.uint8), **columns})


@pytest.mark.parametrize(
    ("colour", "names"),
    [
        ("kind", ["feed"]),
        ("feed", ["120 mm/min", "150 mm/min", "300 mm/min"]),
        ("tool", ["tool 1", "tool 2"]),
        ("z", ["Z −12 mm", "Z −10 mm", "Z −6 mm", "Z −2 mm"]),
    ],
)
def test_few_values_are_a_class_each_and_named(colour, names):
    picture = run(FIRST).plot(colour=colour)
    assert list(divided(picture.axes[1])) == names
    legend = [text.get_text() for each in picture.legends for text in each.get_texts()]
    assert [name for name in legend if name not in (*FIXED, "hole \N{DIAMETER SIGN}8")] == names
    assert divided(picture.axes[0]).keys() == divided(picture.axes[1]).keys()


@pytest.mark.parametrize("colour", ["feed", "tool"])
def test_a_class_holds_the_moves_of_its_value(colour):
    path = run(FIRST).toolpath
    shown = divided(plot_path(path, colour=colour, view="XY").axes[0])
    cuts = path[(path.kind == Kind.LINE) | (path.kind == Kind.ARC)]
    for name, line in shown.items():
        value = float(next(word for word in name.split() if word.isdigit()))
        rows = cuts[getattr(cuts, colour) == value]
        level = rows[(rows.kind == Kind.ARC) | (rows.start[:, :2] != rows.end[:, :2]).any(axis=1)]
        assert drawn_length(line) == pytest.approx(level.length, rel=1e-3)


def test_a_pass_is_what_lies_between_two_rapids():
    run_of = "S500 M3\nG0 X0 Y0 Z-1\nG1 X10 F100\nX15\nG0 X0\nG0 Z-2\nG1 X20\nG0 X0\nG0 Z-3\nG1 X30\nG4 P1\nX40\n"
    shown = divided(run(run_of).plot(colour="pass", view="XZ").axes[0])
    lengths = {name: drawn_length(line) for name, line in shown.items() if name != "dwell"}
    assert lengths == pytest.approx({"pass 1": 15, "pass 2": 20, "pass 3": 40})


@pytest.mark.parametrize("colour", ["feed", "line", "z"])
def test_many_values_are_bins_between_the_limits_of_a_scale(colour):
    feed, line = 500 + np.arange(3000) % 97 * 10.0, np.arange(3000, dtype=np.int32)
    path = waves(3000, feed=feed, line=line)
    picture = plot_path(path, colour=colour, view="XZ")
    lower = np.minimum(path.start[:, 2], path.end[:, 2])
    values = {"feed": feed, "line": line, "z": lower}[colour]
    shown, total = divided(picture.axes[0]), 0
    assert 6 < len(shown) <= classes.BINS
    for name, drawn in shown.items():
        a, b = (float(word.replace("\N{MINUS SIGN}", "-")) for word in name.split() if word[-1].isdigit())
        expected = int(((values >= a) & (values < b)).sum())
        strokes = np.isfinite(np.diff(drawn.get_xydata(), axis=0)).all(axis=1).sum()
        assert strokes == expected, name
        total += strokes
    assert total == 3000
    title, *ticks = [text.get_text() for text in picture.texts]
    assert title == {"feed": "feed, mm/min", "line": "line", "z": "Z, mm"}[colour]
    assert len(ticks) > 2
    steps = [patch for patch in picture.artists if hasattr(patch, "get_width")]
    assert len(shown) <= len(steps) <= classes.BINS


def test_a_scale_of_single_numbers_has_each_below_its_step():
    picture = plot_path(waves(12, tool=np.arange(1, 13, dtype=np.int32)), colour="tool", view="XZ")
    assert list(divided(picture.axes[0])) == [f"tool {k}" for k in range(1, 13)]
    assert [text.get_text() for text in picture.texts] == ["tool", *map(str, range(1, 13))]
    steps = [patch for patch in picture.artists if hasattr(patch, "get_width")]
    for text, step in zip(picture.texts[1:], steps):
        assert text.get_position()[0] == pytest.approx(step.get_x() + step.get_width() / 2)


def test_the_order_of_values_is_the_order_of_lightness():
    for count in (2, 6, classes.BINS):
        grey = [np.dot(to_rgb(shade), (0.2126, 0.7152, 0.0722)) for shade in classes.ramp(count)]
        assert (np.diff(grey) > 0.005).all()
        linear = [np.dot(_linear(to_rgb(shade)), (0.2126, 0.7152, 0.0722)) for shade in classes.ramp(count)]
        assert 1.05 / (max(linear) + 0.05) > 3, "too little contrast on white"


def _linear(rgb):
    c = np.array(rgb)
    return np.where(c <= 0.04045, c / 12.92, ((c + 0.055) / 1.055) ** 2.4)


@pytest.mark.parametrize("colour", classes.COLOURS)
def test_rapids_stay_dashed_and_lines_are_few(colour):
    picture = run(FIRST).plot(colour=colour)
    (rapid,) = [line for line in picture.axes[0].lines if line.get_label() == "rapid"]
    assert rapid.get_linestyle() == "--"
    n = 5000
    values = np.random.default_rng(1).integers(1, 30000, n)
    wild = waves(n, feed=values * 1.0, line=values.astype(np.int32), tool=(values % 300).astype(np.int32))
    assert len(plot_path(wild, colour=colour, view="XY").axes[0].lines) <= classes.BINS + 3


def test_a_move_without_a_feed_is_drawn_and_says_so():
    feed = np.array([100.0, np.nan, 200.0])
    shown = divided(plot_path(waves(3, feed=feed), colour="feed", view="XY").axes[0])
    assert list(shown) == ["100 mm/min", "200 mm/min", "no feed"]
    assert drawn_length(shown["no feed"]) == pytest.approx(0.5)
    many = np.where(np.arange(400) % 5, np.arange(400.0), np.nan)
    assert drawn_length(divided(plot_path(waves(400, feed=many), colour="feed", view="XZ").axes[0])["no feed"]) > 0


def test_an_unknown_colour_is_refused_with_those_known():
    with pytest.raises(Alarm, match="colour must be kind, feed, speed, tool, step, pass, line or z"):
        run(SQUARE).plot(colour="weight")


def test_a_figure_is_the_same_each_time():
    one, other = (run(FIRST).plot(colour="line").png() for _ in range(2))
    assert one == other


# --- arrowheads ------------------------------------------------------------------------------------------------------


def heads(ax):
    return [artist for artist in ax.collections if isinstance(artist, PathCollection)]


def test_arrowheads_are_one_artist_and_point_the_way_of_the_move():
    (artist,) = heads(run(SQUARE).plot().axes[0])
    assert artist.get_offsets().tolist() == [[20, 0], [40, 20], [20, 40], [0, 20]]
    tips = [np.degrees(np.arctan2(*path.vertices[0][::-1])) % 360 for path in artist.get_paths()]
    assert tips == pytest.approx([0, 90, 180, 270], abs=1e-6)


def test_arrowheads_lie_on_arcs_too():
    (artist,) = heads(run("G90 G54\nG0 X50 Y0\nG3 X0 Y50 I-50 J0 F100\n").plot(view="XY").axes[0])
    at = artist.get_offsets()[-1]
    assert np.hypot(*at) == pytest.approx(50, rel=1e-3) and at == pytest.approx([35.36, 35.36], abs=0.5)


def test_no_arrowheads_where_they_say_nothing():
    assert not heads(run(SQUARE).plot(arrows=False).axes[0])
    assert not heads(plot_path(waves(placing.MANY_MOVES + 1)).axes[0])
    assert not heads(plot_path(waves(40), view="XY").axes[0])  # forty short moves
    star = "".join(f"G1 X{50 * np.cos(k * 2.4):.3f} Y{50 * np.sin(k * 2.4):.3f} F100\n" for k in range(200))
    (artist,) = heads(run("G90 G54\n" + star).plot(view="XY").axes[0])
    assert len(artist.get_offsets()) <= placing.MOST_HEADS


# --- crosses ---------------------------------------------------------------------------------------------------------

TWO = "G90 G54\nG0 X0 Y0 Z5\nG1 X30 F100\nG55\nG1 X0 Y0\nY20\n"
DATUMS = {1: (100, 50, 10), 2: (140, 60, 10)}


def crosses(ax):
    return {
        text.get_text(): tuple(np.round(text.xy, 6).tolist())
        for text in ax.texts
        if tuple(text.xy) in {tuple(at) for line in ax.lines for at in line.get_xydata().tolist()}
    }


def test_zero_points_are_crosses_with_their_code():
    above, side = run(TWO, datums=DATUMS).plot().axes
    assert crosses(above) == {"G54": (0, 0), "G55": (40, 10)}
    assert crosses(side) == {"G54": (0, 0), "G55": (40, 0)}


def test_a_name_is_nearer_to_its_own_cross_than_to_another():
    """Zero points 10 mm apart in a path of 90: their names are wider than that."""
    text = (
        "TOOL CALL 1 Z S2000\nL X+0 Y+0 Z+10 R0 FMAX M3\nCYCL DEF 7.0 DATUM SHIFT\nCYCL DEF 7.1 X+10\nL Z-9 F300\n"
        "L X+45 Y+30\nL Z+9\nL X+5\nL X-35 Y-40\n"
    )
    picture = mnclab.run(text, "tnc-620", presets={0: (0, 0, 0)}, tools={1: mnclab.Tool(radius=4)}).plot()
    picture.draw_without_rendering()
    for ax in picture.axes:
        names = [each for each in ax.texts if each.get_text() in ("preset", "datum shift")]
        assert len(names) == 2
        places = ax.transData.transform([each.xy for each in names])
        for name, own, other in zip(names, places, places[::-1]):
            box = name.get_window_extent().padded(-4)  # of the frame around letters
            away = [np.linalg.norm(at - np.clip(at, *box.get_points())) for at in (own, other)]
            assert away[0] < away[1], name.get_text()


def test_zero_points_at_one_place_share_a_cross():
    assert crosses(run(TWO).plot().axes[0]) == {"G54, G55": (0, 0)}


def test_a_local_shift_lies_inside_the_work_offset_that_ends_it():
    shifted = "G90 G54\nG0 X20 Y10\nG92 X0 Y0\nG1 X5 F100\nG55\nG1 X30 Y0\n"
    assert crosses(run(shifted, datums=DATUMS).plot().axes[0]) == {"G54": (0, 0), "G92": (20, 10), "G55": (40, 10)}


def test_a_row_of_the_datum_table_is_named():
    text = "G90 G147 Q7\nG1 X20 Y10 F100\n"
    assert crosses(run(text, datums={7: (5, 5, 0)}).plot().axes[0]) == {"G147 Q7": (0, 0)}


def test_a_pole_is_a_cross_in_the_view_of_its_plane():
    text = "G90 G54\nG0 X0 Y0 Z5\nG16 X20 Y10\nG11 R10 A0 Z-2 F100\nA90\nG15\nG1 X0\n"
    result = run(text)
    above, side = result.plot().axes
    assert crosses(above)["pole"] == (20, 10)
    assert "pole" not in crosses(side)
    assert result.history.changed("pole") == [(2, (20.0, 10.0)), (5, None)]
    turned = run(text.replace("G16", "G39 A90\nG16"))
    assert crosses(turned.plot().axes[0])["pole"] == (-10, 20)


@pytest.mark.parametrize(
    ("settings", "program", "view", "place"),
    [
        ({}, "G18\nG16 X20 Z10\nG10 R5 A0\n", "XZ", (20, 10)),
        ({"g18_axes": "XZ"}, "G18\nG16 X20 Z10\nG10 R5 A0\n", "XZ", (20, 10)),
        ({}, "G39 A90\nG51 X0\nG16 X3 Y1\nG10 R5 A0\n", "XY", (-1, -3)),  # -3 1 -> -1 -3
        ({}, "G51 X0\nG39 A90\nG16 X3 Y1\nG10 R5 A0\n", "XY", (-1, -3)),
        ({"transformation_order": "nested"}, "G51 X0\nG39 A90\nG16 X3 Y1\nG10 R5 A0\n", "XY", (1, 3)),  # -1 3 -> 1 3
    ],
)
def test_a_pole_lies_where_the_settings_put_it(settings, program, view, place):
    result = mnclab.run(program, "mnc", mnclab.Setup(settings=settings))
    (ax,) = result.plot(view=view).axes
    assert crosses(ax)["pole"] == pytest.approx(place)


def test_a_circle_centre_of_a_conversational_program_is_a_pole():
    text = (
        "0 BEGIN PGM A MM\n1 TOOL CALL 1 Z S1000 F100\n2 L X+20 Y+0\n3 CC X+0 Y+0\n4 C X+0 Y+20 DR+\n5 END PGM A MM\n"
    )
    shown = crosses(mnclab.run(text, "tnc-620").plot(view="XY").axes[0])
    assert shown.pop("radius 20") == (10, 0)  # beside the middle of the way from the start X20 to the pole
    assert set(shown.values()) == {(0, 0)} and "preset" in shown


def test_what_is_far_away_or_unwanted_has_no_cross():
    far = run("G90 G54\nG0 X500 Y500\nG1 X520 F100\nY520\nX500 Y500\n")
    assert crosses(far.plot(frame="cuts").axes[0]) == {}
    assert np.ptp(far.plot(frame="cuts").axes[0].get_xlim()) < 60
    assert crosses(run(TWO).plot(marks=False).axes[0]) == {}


def test_the_deepest_cut_lies_on_top_from_above():
    text = "G90 G54\nG0 X0 Y0 Z5\nG1 Z-3 F100\nX20\nZ-1\nX0\n"
    shown = divided(run(text).plot(colour="z").axes[0])
    assert max(shown, key=lambda name: shown[name].get_zorder()) == "Z −3 mm"
