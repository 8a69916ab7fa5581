"""Pictures of paths: what is drawn, where, at what scale, and that nothing covers anything else."""

import itertools
import subprocess
import sys
import warnings
from functools import partial
from pathlib import Path

import numpy as np
import pytest
from matplotlib.figure import Figure
from tools import running
from tools.together import deep_but_one_in

import mnclab
from mnclab import Alarm, Kind, Setup, Tool, Toolpath
from mnclab.show.plot.path import plot_path
from mnclab.workpiece.blank import cylinder

SQUARE = "G90 G54\nG0 X0 Y0 Z5\nG1 Z-2 F100\nX40\nY40\nX0\nY0\nG0 Z5\n"
ARC = "G90 G54\nG0 X50 Y0\nG3 X0 Y50 I-50 J0 F100\n"
PLATE = "G90 G54 T1 S1000 M3\nG0 X-20 Y-20 Z20\nG1 Z-6 F100\nG41 X0 Y-12\nY60\nX100\nY0\nX-12\nG40 X-20 Y-20\n"
DRILL = "G90 G54 T2\nG0 X0 Y0 Z5\nG83 X20 Y10 Z-30 R2 K5 F120 P1\nG80\n"
STOPPED = "G90 G54\nG0 X0 Y0 Z5\nG1 X50 F100\nY30\nG2 X0 Y0 R3\nG1 X0\n"
LONG_WAY = "G90 G54\nG0 X100000.5 Y-20000 Z5\nG1 X100003 F100\nX100000\n"
OFFSETS = {"datums": {1: (100, 50, 10), 2: (160, 50, 10), 7: (160, 90, 12)}}
SEVERAL = """G90 G54 F200 S500 M3 T1
G0 X0 Y0 Z5
G1 X20
Y20
G55
G0 X0 Y0
G1 X20
Y10
G147 Q7
G0 X0 Y0
G1 X10
G92 X0 Y0
G16 X15 Y15
G10 R10 A0
G11 A60 F400
G15
T2
G1 X0 Y0 Z1
"""
WAVES = "G90 G54\n" + "".join(f"G1 X{k} Y{k * k % 11} Z{-(k % 9)} F{100 + 10 * (k % 8)}\n" for k in range(1, 60))
FIRST = (Path(__file__).parents[2] / "data/programs/mnc/first_path.mnc").read_text("utf-8")

run = partial(running.run, ok=None)


def turned():
    """A path of a lathe: along Z at radius 15, a quarter circle of 5, up to radius 30."""
    points = np.array([[60, 0, 100], [15, 0, 2], [15, 0, -20], [20, 0, -25], [30, 0, -25]], dtype=float)
    centre = np.full((4, 3), np.nan)
    centre[2] = (20, 0, -20)
    columns = {"kind": np.array([0, 1, 2, 1], np.uint8), "centre": centre, "sweep": np.array([0, 0, np.pi / 2, 0])}
    return Toolpath.chain(points, columns | {"axis": np.tile([0.0, 1.0, 0.0], (4, 1))}, lathe=True)


def lines(ax):
    """The lines of an axes by what a legend calls them."""
    return {line.get_label(): line for line in ax.lines}


def texts(picture):
    """Every text that is seen: of ticks inside the views, at axes, in the legend, at the scale, below, at crosses."""
    yield from picture.texts
    yield from (text for ax in picture.axes for text in ax.texts)
    yield from (text for legend in picture.legends for text in legend.get_texts())
    for axis in (axis for ax in picture.axes for axis in (ax.xaxis, ax.yaxis)):
        low, high = sorted(axis.get_view_interval())
        shown = [tick.label1 for tick in axis.get_major_ticks() if low <= tick.get_loc() <= high]
        yield from (text for text in (axis.label, *shown) if text.get_visible() and text.get_text())


def drawn_length(line):
    """The length of all strokes of a line; nan parts them."""
    return float(np.nansum(np.hypot(*np.diff(line.get_xydata(), axis=0).T)))


def test_cuts_are_solid_rapids_dashed_and_of_the_right_length():
    above, side = run(SQUARE).plot().axes
    assert lines(above)["feed"].get_linestyle() == "-"
    assert lines(above)["rapid"].get_linestyle() == "--"
    assert drawn_length(lines(above)["feed"]) == pytest.approx(4 * 40)  # the plunge is a point from above
    assert drawn_length(lines(side)["feed"]) == pytest.approx(7 + 2 * 40)
    assert extent(lines(side)["rapid"]) == pytest.approx([-2, 5])


def extent(line):
    """From the lowest to the highest point of a line."""
    heights = line.get_ydata()
    return [np.nanmin(heights), np.nanmax(heights)]


def test_a_class_of_moves_is_one_line_however_many_there_are():
    zigzag = "".join(f"G{k % 2} X{k % 7} Y{k}\n" for k in range(3000))
    few, many = (plot_path(run("G90 F100\n" + text).toolpath) for text in (zigzag[:40], zigzag))
    assert len(many.axes[0].lines) == len(few.axes[0].lines)


def test_an_arc_is_drawn_as_an_arc():
    line = lines(run(ARC).plot().axes[0])["feed"]
    assert drawn_length(line) == pytest.approx(np.pi / 2 * 50, rel=1e-4)
    assert np.hypot(*line.get_xydata().T) == pytest.approx(50, abs=1e-9)


def test_what_runs_along_the_line_of_sight_is_a_cross():
    above, side = run(DRILL).plot(holes=False).axes
    assert lines(above)["plunge"].get_xydata().tolist() == [[20, 10]]
    assert "plunge" not in lines(side)


def test_a_tool_change_is_no_move():
    path = run("G90 G54 T1\nG0 X10\nT2\nG0 X20\n", tools={1: Tool(length=50), 2: Tool(length=80)}).toolpath
    rapid = lines(plot_path(path, view="XZ").axes[0])["rapid"]
    assert drawn_length(rapid) == pytest.approx(20)  # not the 30 mm between the tips


def test_the_equidistant_runs_beside_the_programmed_contour():
    shown = lines(run(PLATE).plot().axes[0])
    programmed, centre = shown["programmed"].get_xydata(), shown["feed"].get_xydata()
    assert programmed[:, 1].max() == 60 and np.nanmax(centre[:, 1]) == pytest.approx(65)  # tool 1 has radius 5
    assert "programmed" not in lines(run(SQUARE).plot().axes[0])


@pytest.mark.parametrize(
    ("text", "labels"),
    [(ARC, [("X, mm", "Y, mm")]), (SQUARE, [("", "Y, mm"), ("X, mm", "Z, mm")])],
    ids=["flat", "with Z"],
)
def test_a_mill_is_seen_from_above_and_if_needed_from_the_side(text, labels):
    axes = run(text).plot().axes
    assert [(ax.get_xlabel(), ax.get_ylabel()) for ax in axes] == labels


def test_a_lathe_shows_z_to_the_right_and_the_diameter_up():
    (ax,) = turned().plot().axes
    assert (ax.get_xlabel(), ax.get_ylabel()) == ("Z, mm", "X (diameter), mm")
    assert ax.yaxis.get_major_formatter()(15.0) == "30"
    z, x = lines(ax)["feed"].get_xydata().T
    assert (z.min(), x.max()) == (-25, 30)
    (centre_line,) = [line for line in ax.lines if line.get_label().startswith("_")]
    assert set(centre_line.get_ydata()) == {0} and centre_line.get_linestyle() != "-"


@pytest.mark.parametrize("text", [SQUARE, ARC, PLATE, DRILL, STOPPED, LONG_WAY], ids=lambda text: text[8:20])
def test_both_axes_of_a_view_have_one_scale(text):
    picture = run(text).plot()
    picture.png()
    for ax in picture.axes:
        origin, right, up = ax.transData.transform([(0, 0), (1, 0), (0, 1)])
        assert (right - origin)[0] == pytest.approx((up - origin)[1], rel=1e-6)
        ends = np.concatenate([line.get_xydata() for line in ax.lines if line.get_label() == "feed"])
        inside = ax.bbox.contains(*ax.transData.transform(ends[np.isfinite(ends).all(axis=1)]).T.min(axis=1))
        assert inside, "a cut lies outside of the picture"


PICTURES = {
    "square": SQUARE, "arc": ARC, "plate": PLATE, "drill": DRILL, "stopped": STOPPED, "far": LONG_WAY, "first": FIRST,
    "offsets": SEVERAL, "waves": WAVES,
}  # fmt: skip


COLOURED = deep_but_one_in(3, itertools.product([*PICTURES, "lathe"], ["kind", "feed", "tool", "line", "z"]))


@pytest.mark.parametrize("name, colour", COLOURED)
def test_no_text_covers_another(name, colour):
    path = turned() if name == "lathe" else run(PICTURES[name], **OFFSETS if name == "offsets" else {})
    picture = path.plot(colour=colour)
    picture.png()
    boxes = [(text.get_text(), text.get_window_extent()) for text in texts(picture)]
    edge = picture.bbox
    for text, box in boxes:
        assert edge.x0 <= box.x0 and box.x1 <= edge.x1 and edge.y0 <= box.y0 and box.y1 <= edge.y1, text
    for (one, a), (other, b) in itertools.combinations(boxes, 2):
        assert not a.overlaps(b), f"{one!r} and {other!r}"
    for ax in picture.axes:
        inside = [text.get_window_extent() for text in ax.texts]
        assert all(ax.bbox.x0 <= box.x0 and box.x1 <= ax.bbox.x1 for box in inside)
        assert all(ax.bbox.y0 <= box.y0 and box.y1 <= ax.bbox.y1 for box in inside)
        names = {text.get_text() for other in picture.axes for text in other.texts}
        assert not any(ax.bbox.overlaps(box) for text, box in boxes if text not in names), "text beside lies in a view"
        for mark in (line for line in ax.lines if line.get_label() in ("start", "end", "_datum", "_pole")):
            for x, y in ax.transData.transform(mark.get_xydata()):
                assert not any(box.contains(x, y) for box in inside), mark.get_label()


def test_the_place_of_an_alarm_is_marked_and_named():
    picture = run(STOPPED).plot()
    assert lines(picture.axes[0])["alarm"].get_xydata().tolist() == [[50, 30]]
    assert "end" not in lines(picture.axes[0])
    assert " ".join(text.get_text() for text in reversed(picture.texts)).startswith("line 5: R3 is too small")
    assert "stopped in line 5" in picture.alt


def test_a_gouge_that_the_control_does_not_see_is_marked():
    """The way down at X20 comes back through the first wall, Y0, which the centre of its tool of radius 2 crosses at X22."""
    text = (
        "BEGIN PGM T MM\nTOOL CALL 1 Z S1000\nL Z-5 R0 FMAX M3\nL X-20 Y-5 R0 FMAX\nL X+0 Y+0 RL F300\nL X+40\nL Y+20\n"
        "L X+20\nL Y-20\nL X+20 Y-40 R0\nEND PGM T MM\n"
    )
    found = mnclab.run(text, "tnc-620", Setup(tools={1: mnclab.Tool(radius=2, number=1)}))
    assert found.ok and lines(found.plot().axes[0])["gouge"].get_xydata() == pytest.approx(np.array([[22, 0]]))


@pytest.mark.parametrize(
    ("stop", "marked"),
    [
        ("L X+20 Y-40 R0\nFOO\n", [[22, 0]]),
        ("L Y-30\nCR X+23 Y-30 R+1.5 DR+\nL Y-20\nL X+20 Y-40 R0\n", [[22, 0], [23, -20]]),  # a slot 3 wide, an arc of 1.5
        ("L X+21\nL Y-10\nL X+100 R0\n", [[22, 0]]),  # an element of 1 between two outside corners
    ],
)
def test_gouges_of_a_stopped_run_are_marked_as_it_warns_of_them(stop, marked):
    text = (
        "BEGIN PGM T MM\nTOOL CALL 1 Z S1000\nL Z-5 R0 FMAX M3\nL X-20 Y-5 R0 FMAX\nL X+0 Y+0 RL F300\nL X+40\nL Y+20\n"
        f"L X+20\nL Y-20\n{stop}END PGM T MM\n"
    )
    found = mnclab.run(text, "tnc-620", Setup(tools={1: mnclab.Tool(radius=2, number=1)}))
    told = [alarm for alarm in found.alarms if "tool of radius 2" in alarm.message and alarm.severity == "warning"]
    assert not found.ok and len(told) == len(marked)
    assert lines(found.plot().axes[0])["gouge"].get_xydata() == pytest.approx(np.array(marked))


def test_rapids_on_one_line_are_drawn_once_so_that_their_dashes_stay_apart():
    back = "G90 G54\nG0 X0 Y0 Z5\nX40\nX10\nX60\nX0\nY30\nX30 Y0\nX0 Y30\nX30\nX45\n"
    ax = mnclab.run(back, "mnc", Setup(start=(0, 0, 5))).plot(view="XY").axes[0]
    rapid = next(line for line in ax.lines if line.get_label() == "rapid").get_xydata()
    seen = np.concatenate([rapid[:-1], rapid[1:]], axis=1)
    seen = seen[~np.isnan(seen).any(axis=1)]
    lengths = np.hypot(*(seen[:, 2:] - seen[:, :2]).T)
    assert lengths.sum() == pytest.approx(60 + 30 + 30 * 2**0.5 + 45), "along X, up, slanting, and along X again"
    assert lengths.max() == pytest.approx(60)


def test_many_plunges_have_small_crosses_so_that_letters_are_read():
    cuts = [f"G0 X{9 * k} Y0\nG1 Z-1\nG1 Y{k + 2}\nG0 Z2\n" for k in range(40)]
    texts = ("G90 G54 T1 S900 M3 F100\n" + "".join(cuts[:count]) for count in (5, 40))
    sizes = [lines(mnclab.run(text, "mnc").plot(view="XY").axes[0])["plunge"].get_markersize() for text in texts]
    assert sizes[1] < 0.6 * sizes[0]


def test_rapids_from_far_away_do_not_make_the_part_a_dot():
    near = run(LONG_WAY).plot().axes[0]
    assert np.ptp(near.get_xlim()) < 10
    far = run(LONG_WAY).plot(frame="all").axes[0]
    assert far.get_xlim()[0] < 0 < 100_003 < far.get_xlim()[1]


EMPTY = {
    "nothing": "G90\n",
    "one rapid": "G0 X10\n",
    "events alone": "T2\nS100 M3\nM0\n",
    "a dwell": "G4 P2\n",
    "no way": "G1 X0 F100\n",
    "an alarm at once": "G1 X1\n",
    "a micrometre": "G1 X0.001 F10\nY0.001\n",
    "far": "G1 X99999999 F10\n",
}


@pytest.mark.parametrize("text", EMPTY.values(), ids=EMPTY)
def test_little_or_nothing_is_a_picture_too(text):
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        result = run(text)
        for picture in (result.plot(), result.toolpath.plot(), result.toolpath[:0].plot(), result.plot(view="ZX")):
            assert picture.png().startswith(b"\x89PNG")


def outlines(picture):
    return [line.get_xydata() for ax in picture.axes for line in ax.lines if line.get_label() == "blank"]


def test_the_blank_is_outlined_in_every_view_and_can_be_left_out():
    part = run(SQUARE, stock=((-5, -5, -12), (45, 60, 0)))
    above, side = outlines(part.plot())
    assert np.allclose([above.min(axis=0), above.max(axis=0)], [(-5, -5), (45, 60)])
    assert np.allclose([side.min(axis=0), side.max(axis=0)], [(-5, -12), (45, 0)])
    picture = part.plot()
    assert all(ax.get_ylim()[0] < low for ax, low in zip(picture.axes, (-5, -12), strict=True))
    assert "blank" in [text.get_text() for legend in picture.legends for text in legend.get_texts()]
    assert outlines(part.plot(stock=False)) == [] and outlines(run(SQUARE).plot()) == []


def test_a_round_blank_is_a_circle_from_above_and_half_a_rectangle_on_a_lathe():
    (above, _) = outlines(run(SQUARE, stock=cylinder(30, -12, 0, at=(20, 20, 0))).plot())
    assert np.allclose(np.hypot(*(above - 20).T), 30)
    setup = Setup(stock=cylinder(25, -60, 2))
    picture = mnclab.run("S800\nM3\nF20\nX4000\nZ-2000\n", "nc-31", setup).plot()
    (half,) = [patch.get_xy() for patch in picture.axes[0].patches if patch.get_label() == "blank"]
    assert np.allclose([half.min(axis=0), half.max(axis=0)], [(-60, 0), (2, 25)])
    assert picture.axes[0].get_ylim()[1] > 25


def test_slices_and_selections_are_drawn_where_they_are():
    path = run(SQUARE).toolpath
    cuts = path[(path.kind == Kind.LINE) & (path.start[:, 0] == path.end[:, 0])]  # up, and down on the other side
    assert drawn_length(lines(cuts.plot(view="XY").axes[0])["feed"]) == pytest.approx(2 * 40)


def test_a_view_goes_into_axes_of_ones_own():
    figure = Figure()
    left, right = figure.subplots(1, 2)
    assert run(SQUARE).plot(ax=left) is figure
    run(SQUARE).plot(ax=right, view="XZ")
    assert (left.get_ylabel(), right.get_ylabel()) == ("Y, mm", "Z, mm")
    assert len(figure.axes) == 2 and left.get_aspect() == 1


@pytest.mark.parametrize("options", [{"view": "front"}, {"frame": "some"}])
def test_unknown_options_are_refused_with_those_known(options):
    with pytest.raises(Alarm, match="must be auto"):
        run(SQUARE).plot(**options)


def test_jupyter_gets_a_picture_with_a_name():
    shown = run(SQUARE).plot()._repr_mimebundle_()
    assert 'alt="tool path: 7 moves, X 0 to 40, Y 0 to 40, Z -2 to 5 mm"' in shown["text/html"]
    assert shown["image/png"].startswith("iVBOR")


def test_pyplot_is_never_imported():
    script = (
        "import sys, mnclab; mnclab.run('G0 X1\\n', 'mnc').plot().png(); assert 'matplotlib.pyplot' not in sys.modules"
    )
    subprocess.run([sys.executable, "-c", script], check=True)


def test_a_pole_named_twice_is_drawn_once():
    from mnclab.show.plot.datums import places_of

    text = "1 TOOL CALL 1 Z S1000\n2 L X+10 Y+0 Z+0 R0 F100\n3 CC X+0 Y+0\n4 C X+10 DR+\n5 CC X+0 Y+0\n6 C X+10 DR-\n"
    run = mnclab.run(text, "tnc-620")
    assert run.ok and [place.name for place in places_of(run)].count("pole") == 1
