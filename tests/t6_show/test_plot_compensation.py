"""The picture of radius compensation: arrows, names, discs and hatches against numbers worked out by hand."""

import itertools
from pathlib import Path

import numpy as np
import pytest
from matplotlib import path as shape
from matplotlib.collections import EllipseCollection
from matplotlib.quiver import Quiver
from tools.together import deep_but_one_in

import mnclab
from mnclab import Alarm, Setup, Tool
from mnclab.path.toolpath import RULE_NAMES, Rule
from mnclab.show import plot
from mnclab.show.plot import colours

SAMPLES = Path(__file__).parents[2] / "data/programs/mnc"
PLATE, KEYHOLE = SAMPLES / "compensated.mnc", SAMPLES / "keyhole.mnc"
#: A slot 8 mm wide from Y15 up to the edge at Y40, and a second contour that any tool can mill.
SLOT = "G90 G54 T1 F200\nG0 X-20 Y20\nG1 G41 X0 Y20\nY40\nX30\nY15\nX38\nY40\nX80\nY0\nX0\nY20\nG40 X-20\n"
#: In the axes a, b of a plane: left of a step with one inside corner at (30, 20), R 5.
STEP = "G90 G54 T1 {plane} F200\nG0 {a}-20 {b}10\nG1 G41 {a}0 {b}10\n{b}40\n{a}30\n{b}20\n{a}60\nG40 {a}60 {b}60\n"
PLANES = [("G17", "X", "Y", (0, 1)), ("G18", "Z", "X", (2, 0)), ("G19", "Y", "Z", (1, 2))]


def with_radius(text, radius=None, **settings):
    setup = Setup(settings=settings)
    return mnclab.run(text, "mnc", setup if radius is None else setup.with_radius(radius))


def arrows(ax):
    """Feet and vectors of the arrows of an axes, by the rule that they are called after."""
    found = {}
    for one in ax.collections:
        if isinstance(one, Quiver):
            found[one.get_label().removeprefix("_")] = (
                np.column_stack([one.X, one.Y]),
                np.column_stack([one.U, one.V]),
            )
    return found


def hatched(ax):
    """What is hatched in an axes: a function that says whether a point lies in it, and the box of it all."""
    paths = [path for one in ax.collections if one.get_label() == "_gouge" for path in one.get_paths()]
    vertices = np.concatenate([path.vertices for path in paths]) if paths else np.empty((0, 2))
    return lambda *p: any(path.contains_point(p) for path in paths), vertices


def lines(ax):
    return {line.get_label(): line for line in ax.lines}


def legend(picture):
    return [text.get_text() for each in picture.legends for text in each.get_texts()]


@pytest.mark.parametrize("radius", [0.5, 5.0, 12.0])
@pytest.mark.parametrize("rule", ["G160", "G161", "G162"])
def test_offset_vectors_are_as_long_as_the_radius_and_end_on_the_path(rule, radius):
    (ax,) = with_radius(PLATE, radius, outside_corners=rule).plot_compensation().axes
    assert ax.get_aspect() == 1
    for name, (feet, vectors) in arrows(ax).items():
        assert name in RULE_NAMES.values()
        assert np.hypot(*vectors.T) == pytest.approx(radius, abs=1e-9)
        if name != "inside corner":  # they stand at the corners of the drawing
            corners = [(0, 20), (0, 40), (35, 40), (60, 20), (80, 0), (0, 0)]
            assert all(tuple(np.round(foot, 9) + 0.0) in corners for foot in feet)
    feet, vectors = arrows(ax)["inside corner"]  # the two places that the tool touches
    assert (feet + vectors).ravel() == pytest.approx([35 + radius, 20 + radius] * 2)
    assert sorted(map(tuple, feet.round(9).tolist())) == [(35, 20 + radius), (35 + radius, 20)]


def test_rows_are_drawn_by_their_rule_and_the_legend_names_them():
    picture = with_radius(PLATE).plot_compensation()
    shown = lines(picture.axes[0])
    length = {name: np.nansum(np.hypot(*np.diff(shown[name].get_xydata(), axis=0).T)) for name in shown}
    edge = 200 + np.sqrt(800)
    assert length["programmed"] == pytest.approx(edge)
    assert length["outside corner, arc"] == pytest.approx(2 * np.pi * 5 * 450 / 360, rel=1e-3)
    assert length["along the side"] == pytest.approx(edge - 2 * 5)
    assert length["entry"] == length["exit"] == pytest.approx(20 - 5)
    names = {"programmed", "along the side", "outside corner, arc", "inside corner", "entry", "exit", "rapid"}
    assert set(legend(picture)) == names
    written = {text.get_text() for text in picture.axes[0].texts}
    assert written == {"entry", "exit", "inside", "arc"}
    assert lines(picture.axes[0])["programmed"].get_color() == colours.INK


def test_the_rules_side_by_side():
    before = with_radius(PLATE)
    picture = plot.compensation(before, rules=["G160", "G161", "G162"])
    assert [ax.get_title(loc="left").split(",")[0] for ax in picture.axes] == ["G160", "G161", "G162"]
    counts = [{name: len(found[0]) for name, found in arrows(ax).items() if "outside" in name} for ax in picture.axes]
    arc, straight = RULE_NAMES[Rule.OUTSIDE_ARC], RULE_NAMES[Rule.OUTSIDE_STRAIGHT]
    assert counts == [{arc: 10}, {straight: 10}, {arc: 2, straight: 8}]  # only the corner of 45 degrees is acute
    assert len({(ax.get_xlim(), ax.get_ylim()) for ax in picture.axes}) == 1
    assert len({round(ax.get_position().y0, 9) for ax in picture.axes}) == 1
    assert before.settings["outside_corners"] == "programmed" and before.setup.settings == {}


def test_a_rule_holds_whatever_the_program_says():
    text = PLATE.read_text("utf-8").replace("G41", "G41 G161")
    as_written, arcs = (with_radius(text, outside_corners=value).toolpath.rule for value in ("programmed", "G160"))
    assert Rule.OUTSIDE_ARC not in as_written and (as_written == Rule.OUTSIDE_STRAIGHT).sum() == 5
    assert Rule.OUTSIDE_STRAIGHT not in arcs and (arcs == Rule.OUTSIDE_ARC).sum() == 5
    assert (with_radius(PLATE, outside_corners="G161").toolpath.rule == Rule.OUTSIDE_STRAIGHT).sum() == 5


def test_several_radii_of_one_contour():
    tools = {1: Tool(radius=4, dr=0.25, length=30)}
    before = mnclab.run(PLATE, setup=Setup(tools=tools))
    picture = plot.compensation(before, radii=[2, 5, 9.5])
    for ax, radius in zip(picture.axes, [2, 5, 9.5]):
        assert f"radius {radius:g} mm" in ax.get_title(loc="left")
        assert all(np.hypot(*vectors.T) == pytest.approx(radius) for _, vectors in arrows(ax).values())
    (alone,) = plot.compensation(before).axes  # radius and delta
    assert all(np.hypot(*vectors.T) == pytest.approx(4.25) for _, vectors in arrows(alone).values())
    assert len(plot.compensation(before, rules=["G160", "G161"], radii=[2, 5]).axes) == 4


def test_hatches_are_where_the_tool_cuts_too_much_and_nowhere_else():
    picture = with_radius(SLOT, 5).plot_compensation()  # the slot is 8 wide, so 2 mm are missing, half on either side
    inside, vertices = hatched(picture.axes[0])
    # the tool centre stays 5 from either wall: at X35 it covers X30 to X40, at X33 X28 to X38, from Y20 to the top
    for y in (20.5, 30, 39.5):
        assert inside(28.2, y) and inside(29.8, y) and inside(38.2, y) and inside(39.8, y)
        assert not inside(27.9, y) and not inside(30.2, y) and not inside(34, y) and not inside(40.1, y)
    assert [vertices.min(axis=0)[0], vertices.max(axis=0)[0]] == pytest.approx([28, 40], abs=0.05)
    assert vertices[:, 1].min() > 15 - 1e-9 and vertices[:, 1].max() < 40 + 0.05
    assert "largest 4 mm" in picture.axes[0].get_title(loc="left") and "gouge" in legend(picture)
    assert "the largest radius is 4 mm" in picture.texts[-1].get_text()


def test_where_no_tool_is_small_enough_none_is_asked_for():
    spike = SLOT.replace("X38", "X30.001")  # half of a thousandth would fit
    (alarm,) = (found for found in with_radius(spike, 5).alarms if found.severity == "alarm")
    assert "no tool fits here" in alarm.message and "take a smaller tool" not in str(alarm)
    picture = with_radius(spike, 5).plot_compensation()
    said = picture.axes[0].get_title(loc="left"), picture.texts[-1].get_text()
    assert "no tool fits" in said[0] and "no tool fits here" in said[1] and "0.0005" not in "".join((str(alarm), *said))


@pytest.mark.parametrize("radius", [3.99, 1.0])
def test_nothing_is_hatched_where_the_tool_fits(radius):
    picture = with_radius(SLOT, radius).plot_compensation()
    assert not len(hatched(picture.axes[0])[1]) and "gouge" not in legend(picture)


def test_an_inside_arc_that_is_too_small_is_hatched():
    arc = "G90 G54 T1 F200\nG0 X20 Y0\nG1 G41 X40 Y0\nY22\nG3 X32 Y30 R8\nG1 X0\nG40 Y0\n"
    inside, vertices = hatched(with_radius(arc, 9).plot_compensation().axes[0])
    # the centre turns in the corner of (31, 21): it reaches X40 and Y30, and beyond the arc in between
    assert inside(32 + 8.05 * np.cos(0.2), 22 + 8.05 * np.sin(0.2)) and len(vertices)
    assert not inside(39, 25) and not inside(20, 25) and not inside(38, 29.9)
    assert not len(hatched(with_radius(arc, 7.9).plot_compensation().axes[0])[1])


def test_a_refused_run_is_shown_as_if_it_cut():
    refused = with_radius(KEYHOLE, 5)
    assert not refused.ok and refused.toolpath.line.max() < 9
    (ax,) = refused.plot_compensation().axes
    assert lines(ax)["programmed"].get_xydata()[:, 0].max() == 80 and len(hatched(ax)[1])
    assert not refused.ok and "gouge" not in refused.setup.settings


@pytest.mark.parametrize(("plane", "a", "b", "axes"), PLANES)
def test_planes(plane, a, b, axes):
    found = with_radius(STEP.format(plane=plane, a=a, b=b), 5)
    assert found.ok, found.alarms
    (ax,) = found.plot_compensation().axes
    seen = [number for number in (0, 1, 2) if number in axes]  # G18 is seen with X to the right
    assert (ax.get_xlabel()[0], ax.get_ylabel()[0]) == ("XYZ"[seen[0]], "XYZ"[seen[1]])
    feet, vectors = arrows(ax)["inside corner"]
    centre = np.zeros(3)
    centre[list(axes)] = 30 + 5, 20 + 5
    assert feet + vectors == pytest.approx(np.tile(centre[seen], (2, 1)))
    assert all(np.hypot(*vectors.T) == pytest.approx(5) for _, vectors in arrows(ax).values())


@pytest.mark.parametrize(("plane", "a", "b", "axes"), PLANES)
def test_hatches_in_planes(plane, a, b, axes):
    turned = SLOT.replace("G54", f"G54 {plane}").translate(str.maketrans("XY", a + b))
    inside, _ = hatched(with_radius(turned, 5).plot_compensation().axes[0])
    order = 1 if axes[0] < axes[1] else -1
    assert inside(*(29, 30)[::order]) and inside(*(39, 30)[::order]) and not inside(*(34, 30)[::order])


def test_a_mirrored_program_is_the_mirror_image():
    text = SLOT.replace("G0 X-20", "{}G0 X-20", 1)
    plain, mirrored = (with_radius(text.format(block), 5).plot_compensation().axes[0] for block in ("", "G51 X50\n"))
    for name, (feet, vectors) in arrows(plain).items():
        other = arrows(mirrored)[name]
        assert other[0] == pytest.approx(feet * [-1, 1] + [100, 0]) and other[1] == pytest.approx(vectors * [-1, 1])
    inside = hatched(mirrored)[0]
    assert inside(100 - 29, 30) and inside(100 - 39, 30) and not inside(100 - 34, 30)


def test_discs_have_the_radius_of_the_tool_and_stand_where_asked():
    def discs(choice):
        (ax,) = with_radius(PLATE, 5).plot_compensation(discs=choice).axes
        (found,) = (one for one in ax.collections if isinstance(one, EllipseCollection))
        assert set(found.get_widths().tolist()) == {10}
        return found.get_offsets().round(9).tolist()

    assert discs([9]) == [[40, 40], [40, 25]]  # the arc before line 9 and line 9 itself
    assert [-20, 20] in discs(True) and len(discs(True)) == 14
    assert discs(20.0)[:2] == [[-20, 20], [-5, 25]]  # 15 mm along the entry and 5 more
    (ax,) = with_radius(PLATE, 5).plot_compensation().axes
    assert not any(isinstance(one, EllipseCollection) for one in ax.collections)


def test_a_change_of_side_and_a_contour_without_exit():
    text = "G90 G54 T1 F200\nG0 X-20 Y0\nG1 G41 X0\nY30\nG42 X30 Y60\nY80\nX60\n"
    picture = with_radius(text, 5).plot_compensation()
    assert {"change of side", "entry"} <= set(legend(picture)) and "exit" not in legend(picture)
    assert all(np.hypot(*vectors.T) == pytest.approx(5) for _, vectors in arrows(picture.axes[0]).values())


def test_a_control_with_its_own_approach():
    text = """0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000
2 L X-20 Y-20 Z+5 R0 FMAX M3
3 L X+0 Y+0 RL F200
4 L Y+40
5 RND R8
6 L X+50
7 L X-20 Y-20 R0
8 END PGM A MM
"""
    found = mnclab.run(text, "tnc-620")
    assert found.ok, found.alarms
    (ax,) = found.plot_compensation().axes
    assert all(np.hypot(*vectors.T) == pytest.approx(5) for _, vectors in arrows(ax).values())
    xy = lines(ax)["programmed"].get_xydata()
    assert np.hypot(*(xy[(xy[:, 0] < 7.9) & (xy[:, 1] > 32.1)] - [8, 32]).T) == pytest.approx(8)  # the rounding
    with pytest.raises(Alarm, match="no setting 'outside_corners'"):
        plot.compensation(found, rules=["G160"])


def test_what_makes_no_sense_is_refused():
    found = with_radius(PLATE)
    lists = [{name: value} for name in ("rules", "radii") for value in ([], (), 5, "5", ["5"], [[1]], [10**400])]
    for options in ({"rules": ["G163"]}, {"radii": [float("nan")]}, {"radii": [-1]}, {"rules": [5]}, *lists):
        with pytest.raises(Alarm):
            plot.compensation(found, **options)
    for options in ({"view": "UV"}, {"discs": -1.0}, {"ax": found.plot().axes[0], "radii": [1, 2]}):
        with pytest.raises(Alarm, match="view|discs|axes"):
            plot.compensation(found, **options)


def test_a_program_without_compensation_and_an_empty_one():
    for text in (
        "G90 G54\nG0 X0 Y0\nG1 X20 F100\n",
        "G90\n",
        "G90 T1 G1 F100\nG41 X10\n",
        "G41 G1 F5 X1\nG2 X9\nG9999\n",
    ):
        picture = with_radius(text).plot_compensation()
        assert not hatched(picture.axes[0])[1].size and picture.alt.startswith("radius compensation")
    assert "no radius compensation" in with_radius("G90\n").plot_compensation().texts[-1].get_text()


OPTIONS = [{}, {"rules": ["G160", "G161", "G162"]}, {"radii": [1, 6, 11]}, {"discs": True}]
SHOWN = deep_but_one_in(3, itertools.product([PLATE, KEYHOLE, SAMPLES / "window.mnc"], OPTIONS))


@pytest.mark.parametrize("program, options", SHOWN)
def test_no_text_covers_another(program, options):
    picture = with_radius(program).plot_compensation(**options)
    picture.draw_without_rendering()
    shown = [text for ax in picture.axes for text in [*ax.texts, ax.xaxis.label, ax._left_title]]
    shown += [*picture.texts, *picture.legends[0].get_texts()]
    boxes = [text.get_window_extent() for text in shown if text.get_text()]
    assert not any(one.overlaps(other) for one, other in itertools.combinations(boxes, 2))
    assert all(box.x0 >= 0 and box.y0 >= 0 and box.x1 <= picture.bbox.x1 and box.y1 <= picture.bbox.y1 for box in boxes)
    assert all(ax.get_aspect() == 1 for ax in picture.axes)
    for ax in picture.axes:  # what is drawn of the tool centre is in sight
        xy = np.concatenate([line.get_xydata() for name, line in lines(ax).items() if name in ("programmed", "entry")])
        assert np.nanmin(xy[:, 0]) > ax.get_xlim()[0] and np.nanmax(xy[:, 1]) < ax.get_ylim()[1]


def test_the_panel_follows_radius_and_rule():
    live = mnclab.compensation_panel(mnclab.run(KEYHOLE))
    assert live.boxes["radius"].value == 3 and "alert" not in live.alarms.value and "gouge" not in live.picture.value
    live.boxes["radius"].value = 4.26  # the mouth is 8.5 wide
    assert "largest radius for the whole contour is 4.25 mm" in live.alarms.value and "gouges" in live.picture.value
    assert "largest radius" in live.fields["radius"].fault.value and "last good" not in live.picture.value
    live.boxes["radius"].value = 4.24
    assert "alert" not in live.alarms.value
    live.boxes["corners"].value = "G161"
    assert "outside corner, straight" in live.picture.value and live.run.settings["outside_corners"] == "G161"


def test_from_the_shell(tmp_path, capsys):
    from mnclab import __main__ as shell

    out = tmp_path / "out.svg"
    assert shell.main(["plot", str(PLATE), "-o", str(out), "--compensation"]) == 0
    assert "outside corner, arc" in out.read_text("utf-8")
    assert shell.main(["plot", str(PLATE), "-o", str(out), "--rules", "G160,G161", "--radii", "2,4"]) == 0
    assert out.read_text("utf-8").count("radius 2 mm") == 2
    for wrong in (["--rules", "G163"], ["--radii", "two"]):
        with pytest.raises(SystemExit, match="2"):
            shell.main(["plot", str(PLATE), "-o", str(out), *wrong])
    with pytest.raises(SystemExit, match="2"):
        shell.main(["plot", str(PLATE), "-o", str(tmp_path / "out.csv"), "--compensation"])


FAR = "G90 G54 T1 F200\nG0 X-20 Y20\nG1 G41 X0 Y20\nY40\nX30\nG0 X{0} Y{0}\nG0 X30 Y0\nG1 X0\nY20\nG40 X-20\n"


@pytest.mark.parametrize("far", [400, 5000])
def test_compensated_rapids_decide_no_scale(far):
    """The cuts are 55 mm wide, from X-20 to about X35: however far a rapid goes, the view is little wider."""
    (near,), (ax,) = (with_radius(FAR.format(each)).plot_compensation().axes for each in (200, far))
    assert np.ptp(ax.get_xlim()) < 2 * 55 and ax.get_xlim()[0] < -20
    assert ax.get_xlim() == pytest.approx(near.get_xlim(), rel=0.02)


#: Where the centre of a tool of radius 5 turns outside a rectangular corner, inside one, and where it comes to the contour.
ARC, ENTERED = 5 / np.sqrt(2), (-5, 20)
TURNS = {
    "G160": ("arc", [(-ARC, 40 + ARC), (35 + ARC, 40 + ARC), (-ARC, -ARC)]),
    "G161": ("straight", [(-5, 45), (40, 45), (-5, -5)]),
}


@pytest.mark.parametrize("size", ["column", "slide", "a4", None])
def test_names_stand_off_lines_and_are_led_to_the_tool_centre_at_their_corners(size):
    picture = with_radius(PLATE).plot_compensation(rules=[*TURNS], size=size)
    picture.draw_without_rendering()
    for ax, (name, corners) in zip(picture.axes, TURNS.values()):
        shown = [(text.get_text(), tuple(np.round(text.xy, 6) + 0.0)) for text in ax.texts]
        assert sorted(said for said, _ in shown) == sorted(["entry", "exit", "inside"] + [name] * 5)
        known = [("entry", ENTERED), ("exit", ENTERED), ("inside", (40, 25)), *((name, each) for each in corners)]
        assert {(said, tuple(np.round(at, 6))) for said, at in known} <= set(shown)
        drawn = [line for line in ax.lines if len(line.get_xydata()) > 1]
        for text in ax.texts:
            leads = [line for line in drawn if line.get_label() == "_leader" and np.allclose(line.get_xydata()[0], text.xy)]
            assert leads, text.get_text()
            box = text.get_window_extent().padded(picture.dpi / 72)  # a point around the letters
            others = [line for line in drawn if line not in leads]
            assert not box.count_contains(ax.transData.transform(np.concatenate([line.get_xydata() for line in others])))
            for xy in (line.get_xydata() for line in others if line.get_linestyle() != "None"):
                pieces = [piece[~np.isnan(piece[:, 0])] for piece in np.split(xy, np.flatnonzero(np.isnan(xy[:, 0])))]
                paths = [shape.Path(ax.transData.transform(piece)) for piece in pieces if len(piece) > 1]
                assert not any(path.intersects_bbox(box, filled=False) for path in paths), text.get_text()


def test_three_rules_in_a_column_stand_below_one_another():
    """In a row a picture was 20 mm wide: names stood 15 mm off their corners, and the legend had no room for entry and exit."""
    picture = with_radius(PLATE).plot_compensation(rules=("G160", "G161", "G162"), size="column")
    picture.draw_without_rendering()
    named = {text.get_text() for legend in picture.legends for text in legend.get_texts()}
    assert {"entry", "exit", "rapid"} <= named and len({ax.get_position().x0 for ax in picture.axes}) == 1
    for ax in picture.axes:
        for text in ax.texts:
            box, corner = text.get_window_extent(), ax.transData.transform(text.xy)
            assert np.hypot(*(corner - np.clip(corner, box.min, box.max))) / picture.dpi * 25.4 < 6
