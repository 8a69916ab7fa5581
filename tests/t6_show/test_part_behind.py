"""The part that a probe meets, behind the path, in scenes, and its touches with their numbers."""

import itertools

import numpy as np
import pytest
from tools.pages import hidden_scripts, unpack
from tools.toy_probing import toy_run

import mnclab
from mnclab.show.player.payload import payload
from mnclab.show.plot.datums import places_of
from mnclab.show.plot.picture import VIEWS, Picture
from mnclab.show.plot.probed import draw_material
from mnclab.show.probed import felt
from mnclab.workpiece.part import ball, box, hole, plane

PART = box((0, 0, -20), (100, 60, 0)) - hole((50, 30, 0), 24, 10)
TEXT = "M1 X50 Y30 D24 Z-5\nM5 X20 Y10 Z0\nM4 X0 Y30 Z-5"


@pytest.fixture(scope="module")
def probed():
    return toy_run(TEXT, PART)


def area(ax):
    """The filled area of the axes, mm²: outer loops less inner ones, by the shoelace formula."""
    total = 0.0
    for path in ax.collections[0].get_paths():
        for x, y in (loop.T for loop in path.to_polygons()):
            total += (x[:-1] * y[1:] - x[1:] * y[:-1]).sum() / 2
    return abs(total)


@pytest.mark.parametrize(
    "view, level, expected",
    [
        ("XY", -5, 100 * 60 - np.pi * 144),  # the hole is 10 deep
        ("XY", -15, 100 * 60),
        ("XZ", 30, 100 * 20 - 24 * 10),
        ("XZ", 3, 100 * 20),
        ("YZ", 50, 60 * 20 - 24 * 10),
    ],
)
def test_a_section_has_the_area_of_the_material(view, level, expected):
    picture = Picture((6, 4))
    ax = picture.add_axes((0.1, 0.1, 0.8, 0.8))
    ax.set(xlim=(-10, 110), ylim=(-40, 70))
    draw_material(ax, PART, VIEWS[view], np.eye(4), level)
    assert area(ax) == pytest.approx(expected, rel=1e-3 if view == "XY" else 1e-12)  # the hole is a polygon in the picture
    outer = np.vstack([path.vertices for path in ax.collections[1].get_paths()]) if view != "XY" else None
    assert outer is None or outer.max(axis=0) == pytest.approx((100 if view == "XZ" else 60, 0), abs=1e-9)


def test_a_wall_touched_from_one_side_is_cut_behind_it():
    """The wall at X0 is touched along +X: the section square to X lies 1 mm in the material, that square to Y at the touch."""
    found = felt(toy_run("M4 X0 Y30 Z-5", PART))
    assert (found.level(0), found.level(1)) == pytest.approx((1, 30))
    assert felt(toy_run("M1 X50 Y30 D24 Z-5", PART)).level(0) == pytest.approx(50)  # two walls: the middle


def test_a_section_just_below_the_top_is_exact():
    """The plate turned by two degrees, 0.1 mm below its top: the corners of its outline, not those of a grid."""
    ax = Picture((6, 4)).add_axes((0.1, 0.1, 0.8, 0.8))
    draw_material(ax, PART.turned(2), VIEWS["XY"], np.eye(4), -0.1)
    cos, sin = np.cos(np.radians(2)), np.sin(np.radians(2))
    corners = np.array([(0, 0), (100, 0), (100, 60), (0, 60)]) @ np.array([(cos, sin), (-sin, cos)])
    outer = max(ax.collections[0].get_paths()[0].to_polygons(), key=np.ptp)
    assert np.linalg.norm(outer - corners[:, None], axis=2).min(axis=1) == pytest.approx(0, abs=1e-9)


def test_what_the_program_has_cut_is_shown_without_asking_every_place():
    """A slot of 10 by 25 with a round end in a blank of 60 by 40: the wall X25 is touched."""
    text = (
        "BLK FORM 0.1 Z X+0 Y+0 Z-20\nBLK FORM 0.2 X+60 Y+40 Z+0\nTOOL CALL 1 Z S1000\nL X-10 Y+20 Z-6 R0 FMAX M3\nL X+20 F200\n"
        "L Z+50 FMAX\nTOOL CALL 7 Z\nL Z+50 FMAX\nTCH PROBE 419 PRESET\nQ263=25\nQ264=+20\nQ261=-3\nQ320=+0\nQ260=+20\n"
        "Q272=+1\nQ267=+1\nQ305=+0\nQ333=+0\nQ303=+1\n"
    )
    tools = {1: mnclab.Tool(radius=5, kind="mill"), 7: mnclab.Tool(radius=2, kind="probe")}
    setup = mnclab.Setup(tools=tools, presets={1: (100, 50, 0)}, settings={"preset": 1}, part="cut")
    run = mnclab.run(text, "tnc-620", setup)
    assert run.ok, run.alarms
    (ax,) = run.plot_measured().axes
    assert area(ax) == pytest.approx(60 * 40 - 20 * 10 - np.pi * 5**2 / 2, rel=1e-3)


def test_touches_lie_where_the_part_was_touched_in_coordinates_of_the_path(probed):
    found = felt(probed)
    assert found.places[0] == pytest.approx((62, 30, -5)) and found.texts[0] == ("1   X 62.000", "1")
    assert found.places[4] == pytest.approx((20, 10, 0)) and found.texts[4] == ("5   Z 0.000", "5")
    assert found.level(2) == pytest.approx(-5 - 0.1)  # just below the middle one: four at -5, one at 0, one at -5
    assert felt(mnclab.run("G0 X1\n", "mnc")) is None


def test_the_datum_moves_the_part_behind_the_path():
    """The path counts from the preset at (50, 30, 0), the part in the machine: the wall at X0 stands at X-50."""
    text = (
        "1 TOOL CALL 7 Z\n2 L X-60 Y+0 Z+30 R0 FMAX\n3 TCH PROBE 419 PRESET\nQ263=-50\nQ264=+0\nQ261=-5\nQ320=+0\nQ260=+20\n"
        "Q272=+1\nQ267=+1\nQ305=+5\nQ333=+0\nQ303=+1\n"
    )
    tools = {7: mnclab.Tool(radius=2, kind="probe")}
    run = mnclab.run(text, "tnc-620", mnclab.Setup(tools=tools, presets={1: (50, 30, 0)}, settings={"preset": 1}, part=PART))
    assert run.ok, run.alarms
    found = felt(run)
    assert found.places == pytest.approx(np.array([(-50, 0, -5)])) and found.texts == [("1   X \N{MINUS SIGN}50.000", "1")]
    ax = run.plot(view="XY", frame="all").axes[0]
    xy = np.vstack([path.vertices for each in ax.collections for path in each.get_paths()])
    assert xy.min(axis=0) == pytest.approx((-50, -30), abs=0.6) and xy.max(axis=0) == pytest.approx((50, 30), abs=0.6)


def test_numbers_cover_no_other_and_no_mark(probed):
    picture = probed.plot()
    picture.draw_without_rendering()
    for ax in picture.axes:
        boxes = [text.get_window_extent() for text in ax.texts if text.get_text()]
        assert len(boxes) >= 4
        assert not any(a.overlaps(b) for a, b in itertools.combinations(boxes, 2))
        marks = [line for line in ax.lines if line.get_label() in ("start", "end", "touch")]
        spots = np.vstack([ax.transData.transform(line.get_xydata()) for line in marks])
        assert not any(box.x0 < x < box.x1 and box.y0 < y < box.y1 for box in boxes for x, y in spots)
    names = [text.get_text() for text in picture.legends[0].get_texts()]
    assert {"touch", "part"} <= {*names}


def test_the_part_can_be_left_out(probed):
    bare = probed.plot(probed=False)
    assert [len(ax.collections) for ax in bare.axes] == [len(ax.collections) - 2 for ax in probed.plot().axes]
    assert "touch" not in [text.get_text() for text in bare.legends[0].get_texts()]


def test_a_part_without_an_end_is_shown_as_far_as_the_picture_goes():
    run = toy_run("M4 X60 Y30 Z-5", plane((60, 0, 0), (-1, 0, 0)))
    ax = run.plot(frame="all").axes[0]
    (body,) = [each for each in ax.collections if each.get_zorder() == 0.6]
    filled = np.vstack([path.vertices for path in body.get_paths()])
    assert filled[:, 0].min() == pytest.approx(60, abs=1e-6) and filled[:, 0].max() >= ax.get_xlim()[1]


def test_a_scene_holds_the_part_and_its_touches(probed):
    pytest.importorskip("pyvista")
    plotter = probed.scene()
    actors = plotter.actors
    assert {"part to touch", "touches"} <= actors.keys()
    assert np.ravel(actors["part to touch"].bounds) == pytest.approx((0, 100, 0, 60, -20, 0))
    plotter.close()
    bare = probed.scene(probed=False)
    assert "part to touch" not in bare.actors
    bare.close()
    endless = toy_run("M4 X60 Y30 Z-5", plane((60, 0, 0), (-1, 0, 0))).scene()
    assert "part to touch" in endless.actors
    endless.close()


def test_heights_are_those_of_the_part(probed):
    """On the plate 0, in the hole -10, beside the plate nothing; on a half ball of radius 10 its formula."""
    found = felt(probed)
    x, y = np.array([10.0, 50.0, 58.0, 63.0, -1.0]), np.array([10.0, 30.0, 30.0, 30.0, 30.0])
    assert found.heights(x, y, -20, 0, 0.5) == pytest.approx(np.array([0, -10, -10, 0, np.nan]), abs=1e-3, nan_ok=True)
    round_ = felt(toy_run("M5 X0 Y0 Z10", ball((0, 0, 0), 10)))
    assert round_.heights(np.array([0.0, 6.0]), np.array([0.0, 0.0]), -10, 10, 0.5) == pytest.approx([10, 8], abs=1e-3)


def test_the_player_has_the_map_and_the_touches(probed):
    header, columns = unpack(payload(probed, probed.profile(), probed=felt(probed)))
    part, touches = header["part"], header["felt"]["touches"]
    top = np.array(columns[part["top"]]).reshape(part["shape"]) / part["parts"]
    assert (top == 0).sum() * part["step"] ** 2 == pytest.approx(100 * 60 - np.pi * 144, rel=0.02)
    assert touches[0]["at"] == [62, 30, -5] and touches[0]["text"] == "1   X 62.000"
    rows = [touch["row"] for touch in touches]
    assert rows == np.flatnonzero(probed.toolpath.kind == mnclab.Kind.PROBE).tolist()  # every touch of these hit
    (scripts,) = hidden_scripts(probed.player().page)
    assert b"class Touches" in scripts and b"class Carving" in scripts
    bare = mnclab.run("G0 X1\n", "mnc")
    assert unpack(payload(bare, bare.profile()))[0]["felt"] == {"corners": [], "touches": [], "beam": []}


@pytest.mark.parametrize(("axis", "named"), [("", "tool setter"), ("X", "beam of the tool setter")])
def test_a_tool_setter_is_no_part_and_its_beam_is_a_line(axis, named):
    """The beam lies along X through its place, 0.5 mm beside where the control takes it to be, and rises by 0.01 a mm."""
    setter = mnclab.Setter(x=40, y=25, z=-10, axis=axis, slope=0.01 if axis else 0, off=(0, 0.5, 0))
    tools = {1: mnclab.Tool(radius=6, length=80)}
    text = {"": "TOOL CALL 1 Z\nTCH PROBE 480 Q260=+50\n", "X": "G17 G90 T1 S3000 M3\nG0 Z50\nG471 H80\n"}[axis]
    beamed = {"laser_x": 40, "laser_y": 25, "laser_z": -10, "laser_axis": 1} if axis else {}
    setup = mnclab.Setup(tools=tools, setter=setter, settings=beamed, start=(40, 25, 150))
    run = mnclab.run(text, "mnc" if axis else "tnc-620", setup)
    assert run.ok and (run.toolpath.kind == mnclab.Kind.PROBE).any(), run.alarms
    found, names = felt(run), [each.get_text() for each in run.plot().legends[0].get_texts()]
    assert named in names and "part" not in names
    if axis:
        assert found.part is None and found.beam == pytest.approx(np.array([(0, 25.5, -10.4), (80, 25.5, -9.6)]))
        lines = [line for ax in run.plot().axes for line in ax.lines if line.get_label() == named]
        assert [np.ptp(line.get_xdata()) for line in lines][0] == pytest.approx(80)
        assert unpack(payload(run, run.profile(), None, (), found))[0]["felt"]["beam"][1] == pytest.approx([80, 25.5, -9.6])
    else:
        assert found.beam is None and found.name == named


def test_touches_of_a_program_in_inches_count_in_inches():
    """A wall at X25.4 mm is 1 inch away."""
    text = "BEGIN PGM A INCH\nTOOL CALL 7 Z\nL X-1 Y+0 Z+3 R0 FMAX\nTCH PROBE 427 MEASURE COORDINATE\n"
    text += "Q263=1 Q264=0 Q261=0 Q320=0 Q272=1 Q267=1 Q260=3 Q281=0 Q288=0 Q289=0 Q309=0 Q330=0\nEND PGM A INCH\n"
    tools = {7: mnclab.Tool(radius=2, kind="probe")}
    run = mnclab.run(text, "tnc-620", mnclab.Setup(tools=tools, part=box((25.4, -50, -20), (60, 50, 20))))
    assert run.ok, run.alarms
    assert felt(run).texts[0][0] == "1   X 1.0000"


def test_a_datum_that_a_cycle_shifts_says_from_which_line_on_it_counts():
    """G419 in line 3 finds the wall 1 mm beside the datum and makes it zero: the second G54 counts from there."""
    part, probe = box((1, 0, -20), (60, 50, 0)), {20: mnclab.Tool(2, kind="probe")}
    text = "G54 G17 G90 T20\nG0 Z20\nG419 X0 Y30 L1 K1 Z-5 H20 S1\nG0 X10\n"
    run = mnclab.run(text, "mnc", mnclab.Setup(tools=probe, part=part, start=(-20, 0, 50)))
    assert run.ok, run.alarms
    assert {"G54", "G54, line 3"} == {place.name for place in places_of(run)}
