"""Pictures of a part: heights as colours, sections, edges, the way from home; half sections of a lathe."""

import itertools

import numpy as np
import pytest
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection
from matplotlib.figure import Figure
from tools.together import deep_but_one_in

import mnclab
from mnclab import Alarm, Setup, Tool
from mnclab.show.plot.part import _coloured, relief
from mnclab.workpiece.blank import cylinder, depth_below
from mnclab.workpiece.collision import Collision

TEXT = (
    "G17 G90 G54\nT1 M6 S2000 M3\nG0 X15 Y20 Z5\nG1 Z-6 F300\nG3 I8 J0\nG0 Z5\n"  # an annulus about 23 20
    "T2 M6\nG0 X50 Y10\nG1 Z-30 F300\nG0 Z20\n"
)
TOOLS = {1: Tool(radius=4, kind="mill"), 2: Tool(radius=3, kind="drill", angle=118)}
STOCK = ((0, 0, -20), (60, 40, 0))
TURN = "M3\nT1\nS800 G97 G95 F0.25\nG00 X15 Z2\nG01 Z-20\nX25\nG00 X40 Z20\nM5\n"


@pytest.fixture(scope="module")
def run():
    return mnclab.run(TEXT, "g43", Setup(tools=TOOLS, stock=STOCK, start=(0, 0, 50)))


@pytest.fixture(scope="module")
def turned():
    return mnclab.run(TURN, "jnc-t01", Setup(stock=cylinder(20, -50, 0), start=(60, 0, 50)))


def texts(figure):
    return {text.get_text() for text in figure.findobj(lambda each: hasattr(each, "get_text"))}


def test_pixels_have_the_heights_of_the_part(run):
    seen = relief(run.workpiece())
    x, y = np.meshgrid(seen.x, seen.y)
    out = np.hypot(x - 23, y - 20)
    floor, top = (out > 4.01) & (out < 11.99), (out < 3.99) | ((out > 12.01) & (np.hypot(x - 50, y - 10) > 3.01))
    assert np.abs(seen.z[floor] + 6).max() < 1e-9 and np.abs(seen.z[top]).max() < 1e-9
    hole = np.hypot(x - 50, y - 10)
    assert not seen.solid[hole < 2.99].any() and seen.solid[hole > 3.01].all()
    assert seen.light[floor].min() < 0.85 < seen.light[floor].max() <= 1.1  # a shadow beside the wall


def test_walls_are_lines_at_their_true_places(run):
    lines, high = relief(run.workpiece()).lattice.crests()
    ends = lines.reshape(-1, 2)
    off = np.stack([np.abs(np.hypot(*(ends - (23, 20)).T) - radius) for radius in (4, 12)])
    off = np.minimum(off.min(axis=0), np.abs(np.hypot(*(ends - (50, 10)).T) - 3))
    assert off.max() < 1e-4
    length = np.hypot(*(lines[:, 1] - lines[:, 0]).T).sum()
    assert length == pytest.approx(2 * np.pi * (4 + 12 + 3), rel=1e-3)
    assert set(np.round(high, 6).tolist()) == {6.0, 20.0}


def test_a_scale_says_how_deep_colours_are(run):
    figure = run.workpiece().plot()
    assert isinstance(figure, Figure) and {"depth, mm", "blank", "X, mm", "Y, mm"} <= texts(figure)
    assert any("mm³ removed" in each for each in texts(figure))
    assert next(ax for ax in figure.axes if ax.get_ylabel() == "depth, mm").get_xlim() == (0, 6), "it ends at the deepest floor"
    names = texts(run.workpiece().plot(colour="tool"))
    assert {"tool 1"} <= names and "depth, mm" not in names
    assert "line 5" in texts(run.workpiece().plot(colour="line"))


def test_the_depth_of_a_drum_is_that_below_its_round_surface():
    """A groove of 8 mm along the top of a drum of 20 mm radius, its floor at Z14: 6 deep in the middle, at its walls 20 - 14.56;
    what nothing cut is not deep, though it falls away by 20 mm."""
    text = "G17 G90 G54\nT1 M6 S2000 M3\nG0 X-10 Y0 Z30\nG1 Z14 F300\nG1 X70\nG0 Z50\n"
    stock = cylinder(20, 0, 60, axis="X")
    part = mnclab.run(text, "g43", Setup(tools=TOOLS, stock=stock, start=(0, 0, 50))).workpiece()
    _, _, (title, low, high, _) = _coloured(part, relief(part), "depth")
    assert (title, low) == ("depth, mm", 0.0) and high == pytest.approx(6, abs=1e-3)
    places = [(30, 0, 14), (30, 3.99, 14), (30, 19, np.sqrt(39) - 1e-3), (30, 0, 20)]
    assert depth_below(stock, np.array(places)) == pytest.approx([6, 20 - np.hypot(3.99, 14), 0, 0])
    assert _coloured(uncut := mnclab.run("G54\n", "g43", Setup(stock=stock)).workpiece(), relief(uncut), "depth")[2] is None


def test_the_scale_ends_in_a_number():
    text = "G17 G90 G54\nT1 M6 S2000 M3\nG0 X30 Y20 Z5\nG1 Z-7.35 F300\nG0 Z20\n"
    figure = mnclab.run(text, "g43", Setup(tools=TOOLS, stock=STOCK)).workpiece().plot()
    scale = next(ax for ax in figure.axes if ax.get_ylabel() == "depth, mm")
    figure.canvas.draw()
    told = [(each.get_text(), each.get_window_extent()) for each in scale.get_xticklabels()]
    assert (told[0][0], told[-1][0]) == ("0", "7.35") and scale.get_xlim() == (0, 7.35)
    assert all(left.x1 < right.x0 for (_, left), (_, right) in zip(told, told[1:]))


@pytest.mark.parametrize("deep", [13.972, 12.6, 9.105, 0.012])
@pytest.mark.parametrize("size", [(8, 6), (5, 4), (3.4, 3)])
def test_numbers_of_the_scale_have_air_between_them(deep, size):
    own = mnclab.run(f"T1 M6 S9 M3\nG0 X9 Y9 Z5\nG1 Z-{deep} F300\n", "g43", Setup(tools=TOOLS, stock=STOCK))
    picture = own.workpiece().plot(size=size)
    picture.draw_without_rendering()
    boxes = [each.get_window_extent() for each in picture.axes[-1].get_xticklabels()]
    assert len(boxes) > 2 and all(one.x1 + 3 < other.x0 for one, other in itertools.pairwise(boxes))


def test_a_part_with_nothing_but_through_holes_has_no_scale():
    text = "G17 G90 G54\nT2 M6 S2000 M3\nG0 X50 Y10 Z5\nG1 Z-30 F300\nG0 Z20\n"
    figure = mnclab.run(text, "g43", Setup(tools=TOOLS, stock=STOCK)).workpiece().plot()
    assert len(figure.axes) == 1 and "depth, mm" not in texts(figure)


def test_sections_stand_below_with_their_letters(run):
    part = run.workpiece()
    figure = part.plot(section=["XZ", "XZ"], at=[20, 10])
    assert len(figure.axes) == 4  # from above, two sections, the scale
    assert {"A\N{EN DASH}A   Y = 20 mm", "B\N{EN DASH}B   Y = 10 mm", "A", "B"} <= texts(figure)
    (hatched,) = [patch for patch in figure.axes[1].patches if patch.get_hatch()]
    assert hatched.get_path().vertices[:, 1].min() == -20
    (shape, *_) = figure.axes[2].patches
    x = shape.get_path().vertices[:, 0]
    assert {47.0, 53.0} <= set(np.round(x, 3).tolist())  # the hole of the drill goes through
    middle = part.plot(section="YZ")
    assert "A\N{EN DASH}A   X = 30 mm" in texts(middle)


@pytest.mark.parametrize(
    ("options", "sentence"),
    [
        ({"colour": "red"}, "colour must be depth, tool or line"),
        ({"section": "XA"}, "section must be XY, XZ or YZ"),
        ({"section": 3}, "section must be a plane or several"),
        ({"section": ["XZ", "YZ"], "at": [1.0]}, "each section needs a place, got 1 for 2"),
        ({"section": "XZ", "at": "here"}, "where a section is"),
        ({"collisions": [3]}, "collisions must be those of a run"),
    ],
)
def test_a_wrong_option_is_an_alarm(run, options, sentence):
    with pytest.raises(Alarm, match=sentence):
        run.workpiece().plot(**options)


def test_collisions_are_marked(run):
    found = Collision("rapid", "rapid motion in material", 3, 0, 2, (30.0, 20.0, -1.0), 1.0)
    figure = run.workpiece().plot(collisions=[found])
    (mark,) = [line for line in figure.axes[0].lines if line.get_label() == "collision"]
    assert mark.get_xydata().tolist() == [[30, 20]]


def test_axes_of_ones_own(run, turned):
    for part in (run.workpiece(step=1.0), turned.workpiece()):
        ax = Figure().add_subplot()
        assert part.plot(ax=ax) is ax.figure and len(ax.figure.axes) == 1


def test_the_part_lies_under_the_path(run):
    above, side = run.plot(part=True).axes
    assert len(above.images) == 1 and any(isinstance(each, LineCollection) for each in above.collections)
    assert "_part" in {str(patch.get_label()) for patch in side.patches}


def test_a_first_approach_comes_from_home(run):
    """Beside a blank, from an unknown start: no rapid from the zero point, no mark on it; from a known start both."""
    home = mnclab.run(TEXT, "g43", Setup(tools=TOOLS, stock=STOCK))
    assert home.rows_from_home == 3 and run.rows_from_home == 0
    above, side = home.plot().axes
    assert "from home" in texts(home.plot()) and "start" not in texts(home.plot())
    (mark,) = [line for line in above.lines if line.get_label() == "from home"]
    (leaders,) = (each for each in above.collections if each.get_label() == "_leader")  # it goes down there too
    assert any(np.allclose(each, [(15, 20), mark.get_xydata()[0]]) for each in leaders.get_segments())
    assert _first(above, "rapid") == [15, 20]
    assert [sum(not each.get_text() for each in ax.texts) for ax in (above, side)] == [0, 1]  # the arrow from above
    assert _first(run.plot().axes[0], "rapid") == [0, 0] and "start" in texts(run.plot())
    without = mnclab.run(TEXT, "g43", Setup(tools=TOOLS))
    assert "start" in texts(without.plot()) and without.rows_from_home == 0


def _first(ax: Axes, name: str) -> list[float]:
    (line,) = [each for each in ax.lines if each.get_label() == name]
    return [float(each) for each in line.get_xydata()[0]]


def test_a_half_section_has_diameters_chuck_and_insert(turned):
    figure = turned.workpiece().plot()
    assert {"⌀30", "⌀40", "chuck", "insert", "blank"} <= texts(figure)
    (ax,) = figure.axes
    assert [ax.yaxis.get_major_formatter()(value, None) for value in (15, -20)] == ["30", "40"]
    (hatched,) = [patch for patch in ax.patches if patch.get_hatch()]
    assert hatched.get_path().vertices[:, 1].min() == 0  # hatched above the centre line alone
    assert "line 5" in texts(turned.workpiece().plot(colour="line"))
    with pytest.raises(Alarm, match="section through the axis"):
        turned.workpiece().plot(section="XZ")


def test_a_chuck_of_the_setup_is_drawn_where_it_stands(turned):
    done = mnclab.run(
        TURN, "jnc-t01", Setup(stock=cylinder(20, -50, 0), start=(60, 0, 50), fixtures=(cylinder(45, -60, -35, bore=20),))
    )
    (ax,) = done.workpiece().plot().axes
    chucks = [p.get_xy() for p in ax.patches if str(p.get_label()) == "chuck"]
    assert len(chucks) == 2 and chucks[0].max(axis=0).tolist() == [-35, 45]


SIZES = [(7, 6), (4.6, 6), (9, 3)]
STOCKS = [STOCK, ((0, 0, -20), (20, 300, 0)), ((0, 0, -200), (60, 40, 0))]


@pytest.mark.parametrize("size, stock", deep_but_one_in(4, itertools.product(SIZES, STOCKS)))
def test_the_titles_of_many_sections_have_room(run, size, stock):
    part = run.workpiece(stock=stock)
    figure = part.plot(section=["XZ", "YZ", "XY"], size=size)
    assert figure.get_figwidth() <= size[0] + 1e-9 and figure.get_figheight() <= size[1] + 1e-9
    plan, *cuts, _ = figure.axes
    scales = {round(np.ptp(ax.get_xlim()) / ax.get_window_extent().width, 9) for ax in (plan, *cuts)}
    assert len(scales) == 1  # all of one scale
    boxes = [ax.get_window_extent() for ax in (plan, *cuts)]
    assert not any(a.overlaps(b) for k, a in enumerate(boxes) for b in boxes[:k])
    for ax in cuts:
        title, below = ax.texts[0].get_window_extent(), ax.patches[0].get_window_extent()
        assert title.width <= ax.get_window_extent().width and title.y0 >= below.y1


def test_what_is_only_cut_right_through_has_no_scale_of_depths():
    through = mnclab.run("G17 G90 G54\nT2 M6 S2000 M3\nG0 X30 Y20 Z5\nG1 Z-30 F300\nG0 Z20\n", "g43",
                         Setup(tools=TOOLS, stock=STOCK, start=(0, 0, 50)))  # fmt: skip
    figure = through.workpiece().plot()
    assert len(figure.axes) == 1 and "depth, mm" not in texts(figure)


def test_fixtures_are_drawn_beside_the_part(run):
    held = run.again(Setup(tools=TOOLS, stock=STOCK, start=(0, 0, 50), fixtures=(((-50, 5, -20), (0, 35, 3)),)))
    figure = held.workpiece().plot(section=["XZ", "YZ"])
    assert "fixture" in texts(figure) and "fixture" not in texts(run.workpiece().plot())
    plan, along, across = (ax.patches for ax in figure.axes[:3])
    assert plan[0].get_xy().min(axis=0).tolist() == [-50, 5]
    assert figure.axes[0].get_xlim()[0] == pytest.approx(-12 - 0.06 * 72)  # a fifth of the blank's side of it is shown
    assert along[-1].get_xy().max(axis=0).tolist() == [0, 3]
    assert len(across) == 2  # the plane in the middle of the blank does not meet it
