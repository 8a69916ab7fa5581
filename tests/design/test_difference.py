"""What a comparison says of single faults, by closed forms: corners, cusps, rapids, what was forgotten, what is too many."""

import json
import math

import numpy as np
import pytest
from design.cut_from_drawings import Writer, cut
from tools.milled import MILL, part

import mnclab
from mnclab import Alarm, Tool
from mnclab.design.difference.measuring import circle
from mnclab.design.model import Chamfer, Circle, Design, Face, Groove, Hole, Pocket, Rectangle, Slot, Stud
from mnclab.geometry.contours import Contour
from mnclab.workpiece.blank import cylinder

BLOCK = ((0, 0, -20), (60, 40, 0))
ROUND = 12.0 - 5.0  # the path of a mill of 5 mm in a circle of 24
CIRCLE = Pocket.circle(30, 20, 24, 8)


def rings(z=-8.0, x=30.0, last=ROUND):
    """A round pocket of 24 about (x, 20) cut with a mill of 5 mm; the last line is line 12."""
    turns = "\n".join(f"G1 X{x + q}\nG3 X{x + q} Y20 I{-q} J0" for q in (3, 6, last))
    return f"G0 X{x} Y20 Z2\nG1 Z{z}\n{turns}\n"


def row(found, feature, measure):
    (one,) = [each for each in found.features if (each.feature, each.measure) == (feature, measure)]
    return one


def test_a_part_as_drawn_is_exactly_that():
    found = part(rings()).compare(Design(BLOCK, (CIRCLE,)))
    assert found.ok and found.worst_gouge.place is None and found.worst_rest.place is None
    assert (found.gouge_volume, found.rest_volume) == (0.0, 0.0)
    assert (np.nan_to_num(found.map) == 0).all() and found.map.shape == (len(found.y), len(found.x))
    assert row(found, "pocket", "diameter").actual == pytest.approx(24, abs=1e-9)


def test_a_bore_of_24_04_for_24_and_a_depth_of_7_98_for_8():
    found = part(rings(-7.98), Tool(radius=5.02, number=1, kind="mill")).compare(Design(BLOCK, (CIRCLE,)), 0.05)
    assert row(found, "pocket", "diameter").actual == pytest.approx(24.04, abs=1e-6)
    assert row(found, "pocket", "depth").actual == pytest.approx(7.98, abs=1e-9)
    assert row(found, "pocket", "depth").deviation == pytest.approx(-0.02, abs=1e-9)
    assert found.worst_gouge.value == pytest.approx(0.02, abs=1e-7) and found.worst_gouge.line in (11, 12)
    assert found.worst_rest.value == pytest.approx(0.02, abs=1e-9)
    assert found.ok


def test_a_bore_too_wide_leaves_the_top_face_as_drawn():
    found = part(rings(), Tool(radius=5.05, number=1, kind="mill")).compare(Design(BLOCK, (CIRCLE,)))
    assert (row(found, "blank", "form").actual, row(found, "blank", "form").line) == (0.0, 0)
    assert row(found, "pocket", "form").actual == pytest.approx(-0.05, abs=1e-6)


@pytest.mark.filterwarnings("error")
def test_walls_below_every_tool_are_left_over_without_a_warning():
    """A bore of 23 for 24 that ends 0.3 mm above its floor: nothing has cut at the foot of its wall."""
    found = part(rings(-7.7, last=6.5)).compare(Design(BLOCK, (CIRCLE,)))
    assert (found.worst_rest.value, found.worst_gouge.value) == (pytest.approx(0.5, abs=1e-6), 0.0)
    assert found.rest_volume == pytest.approx(math.pi * (144 * 8 - 11.5**2 * 7.7), rel=2e-3)


def test_volumes_of_thin_bands():
    wide = part(rings(), Tool(radius=5.05, number=1, kind="mill")).compare(Design(BLOCK, (CIRCLE,)))
    assert wide.gouge_volume == pytest.approx(math.pi * (12.05**2 - 12**2) * 8, rel=0.02) and wide.rest_volume == 0
    deep = part(rings(-8.1)).compare(Design(BLOCK, (CIRCLE,)))
    assert deep.gouge_volume == pytest.approx(math.pi * 144 * 0.1, rel=2e-3) and deep.rest_volume == 0
    none = part("G0 X30 Y20").compare(Design(BLOCK, (CIRCLE,)))
    assert none.rest_volume == pytest.approx(math.pi * 144 * 8, rel=2e-3) and none.gouge_volume == 0


@pytest.mark.parametrize("turned", [0, 30])
def test_a_round_tool_leaves_the_corners_of_a_sharp_pocket(turned):
    """Radius r in a corner of 90 degrees: the middle of its arc is r (1 - 1/√2) from both walls."""
    design = Design(BLOCK, (Pocket.rectangle(30, 20, 24, 16, 5, turned=turned),))
    c, s = math.cos(math.radians(turned)), math.sin(math.radians(turned))
    spots = [(30 + c * x - s * y, 20 + s * x + c * y) for x, y in ((-9, -5), (9, -5), (9, 5), (-9, 5), (-9, -5), (-9, 0), (9, 0))]
    text = f"G0 X{spots[0][0]} Y{spots[0][1]} Z2\nG1 Z-5\n" + "\n".join(f"G1 X{x:.9f} Y{y:.9f}" for x, y in spots)
    found = part(text, Tool(radius=3, number=1, kind="mill")).compare(design)
    assert found.worst_rest.value == pytest.approx(3 * (1 - math.sqrt(0.5)), abs=1e-5)
    assert found.worst_rest.feature == "pocket" and found.worst_rest.line >= 6
    assert found.worst_gouge.value <= 1e-7
    assert row(found, "pocket", "length").deviation == pytest.approx(0, abs=1e-6)
    assert row(found, "pocket", "width").deviation == pytest.approx(0, abs=1e-6)
    assert row(found, "pocket", "depth").deviation == pytest.approx(0, abs=1e-9)


def test_a_cusp_between_two_passes():
    """Passes 11 mm apart with a mill of 10: a rib 1 mm wide stays as high as the pocket is deep, 3 mm, and 0.5 from void."""
    design = Design(BLOCK, (Pocket.rectangle(30, 20, 40, 21, 3, corner=5),))
    found = part("G0 X15 Y14.5 Z2\nG1 Z-3\nG1 X45\nG1 Y25.5\nG1 X15\nG1 Y14.5").compare(design)
    assert found.worst_rest.value == pytest.approx(3, abs=1e-6)  # from the floor; walls are farther
    assert abs(found.worst_rest.place[1] - 20) <= 0.5 + 1e-6 and found.worst_rest.place[2] == 0
    assert found.worst_rest.feature == "pocket" and not found.ok
    assert found.rest_volume == pytest.approx(20 * 1 * 3, rel=0.05)  # between the sides x 20 and 40


def test_a_rapid_into_the_material():
    """Z-6 in rapid beside the pocket: the pin of 10 mm reaches 5 mm from its wall; 6 mm from the top."""
    found = part("G0 X10 Y10\nG0 Z-4\nG0 Z2\n" + rings().replace("Z2\n", "\n", 1)).compare(Design(BLOCK, (CIRCLE,)))
    assert found.worst_gouge.line == 6 and found.worst_gouge.feature == "blank"
    assert found.worst_gouge.value == pytest.approx(4, abs=1e-6)
    assert found.gouge_volume == pytest.approx(math.pi * 25 * 4, rel=0.01)
    assert row(found, "pocket", "form").ok and row(found, "blank", "form").line == 6


def test_a_feature_that_was_forgotten():
    design = Design(BLOCK, (CIRCLE, Hole(8, 8, 6, 10, name="bore")))
    found = part(rings()).compare(design)
    assert row(found, "bore", "diameter").verdict == "not cut" and math.isnan(row(found, "bore", "diameter").actual)
    assert row(found, "bore", "depth").actual == pytest.approx(0, abs=1e-9)
    assert row(found, "pocket", "form").ok
    assert found.worst_rest.feature == "bore" and (found.worst_rest.line, found.worst_rest.row) == (0, -1)
    assert "nothing cut here" in str(found.worst_rest)
    assert found.worst_rest.value == pytest.approx(3, abs=1e-3)  # half as wide as it is
    assert not found.ok


def test_what_an_earlier_clamping_took_too_much_is_missing_from_the_start():
    """A pocket of 8.1 for 8 below, seen once the part is turned over: no line of the second program is guilty."""
    first = part(rings(z=-8.1))
    found = part("G0 X-20", stock=first.turned_over()).compare(Design(BLOCK, (), (CIRCLE,)))
    assert found.worst_gouge.value == pytest.approx(0.1, abs=1e-9) and found.worst_gouge.line == 0
    assert str(found.worst_gouge).endswith("missing from the start")
    assert row(found, "pocket", "depth").where == "missing from the start"


def test_another_blank_than_that_of_the_design_is_said():
    design = Design(((-2, 0, -20), (60, 40, 0)), (CIRCLE,))
    found = part(rings()).compare(design)
    cut_from, drawn = "X0..60 Y0..40 Z-20..0", "X-2..60 Y0..40 Z-20..0"
    assert found.notes == (f"the part was cut from a blank of {cut_from}, the design has one of {drawn}",)
    assert found.worst_gouge.where == "missing from the start"
    assert part(rings()).compare(Design(BLOCK, (CIRCLE,))).notes == ()


def test_a_pocket_too_many():
    found = part(rings()).compare(Design(BLOCK))
    assert found.worst_gouge.value == pytest.approx(8, abs=1e-9) and found.worst_gouge.feature == "blank"
    assert found.worst_gouge.line == 6
    assert found.gouge_volume == pytest.approx(math.pi * 144 * 8, rel=2e-3)


def test_right_through():
    """A hole where none is drawn, through a plate of 20: nothing of it is deeper than its radius in the material."""
    found = part("G0 X30 Y20 Z2\nG1 Z-21").compare(Design(BLOCK))
    assert found.worst_gouge.value == pytest.approx(10, abs=1e-3)  # halfway between both sides
    assert found.gouge_volume == pytest.approx(math.pi * 25 * 20, rel=5e-3)
    plate = Design(BLOCK, (Hole(30, 20, 10),))
    assert part("G0 X30 Y20 Z2\nG1 Z-21").compare(plate).ok
    short = part("G0 X30 Y20 Z2\nG1 Z-19").compare(plate)
    assert short.rest_volume == pytest.approx(math.pi * 25, rel=5e-3) and not short.ok


def test_several_heights_each_with_its_own_fault():
    pockets = Pocket.circle(30, 20, 24, 4, top=-1, name="upper"), Pocket.circle(30, 20, 14, 9, top=-1, name="lower")
    design = Design(BLOCK, (Face(1), *pockets))
    ways = "".join(f"G1 X{x} Y-6\nG1 Y46\nG1 X{x + 8}\nG1 Y-6\n" for x in (0, 16, 32, 48))
    text = "G0 X0 Y-6 Z2\nG1 Z-1\n" + ways + "G0 Z5\n" + rings(-5) + "G0 Z5\nG0 X30 Y20\nG1 Z-10.03\nG1 X32\nG3 X32 Y20 I-2 J0"
    found = part(text).compare(design)
    assert row(found, "face", "depth").deviation == pytest.approx(0, abs=1e-9)
    assert row(found, "upper", "depth").deviation == pytest.approx(0, abs=1e-9)
    assert row(found, "lower", "depth").deviation == pytest.approx(0.03, abs=1e-9)
    assert found.worst_gouge.feature == "lower" and found.worst_gouge.value == pytest.approx(0.03, abs=1e-9)


def test_a_round_blank():
    bar = cylinder(25, -15, 0, at=(30, 20, 0))
    design = Design(bar, (CIRCLE,))
    assert part(rings(), stock=bar).compare(design).ok
    found = part(rings(), stock=cylinder(25.2, -15, 0, at=(30, 20, 0))).compare(design)
    assert found.worst_rest.value == pytest.approx(0.2, abs=1e-6) and found.worst_rest.feature == "blank"
    assert found.worst_rest.line == 0
    assert found.rest_volume == pytest.approx(math.pi * (25.2**2 - 25**2) * 15, rel=0.02)


def test_both_sides():
    """Turned over about X, the second program sees y and z from the other end: the pocket below stands at 40 - 20."""
    design = Design(BLOCK, (CIRCLE,), back=(Pocket.circle(15, 14, 20, 3, name="below"),))
    first = part(rings())
    half = first.compare(design)
    assert half.worst_rest.feature == "below" and half.worst_rest.value == pytest.approx(3, abs=1e-9)
    assert half.worst_rest.place[2] == -20 and row(half, "below", "depth").actual == pytest.approx(0, abs=1e-9)
    second = part("G0 X15 Y14 Z2\nG1 Z-3\nG1 X20\nG3 X20 Y14 I-5 J0", stock=first.turned_over("x").as_blank())
    found = second.compare(design.turned_over())
    assert found.ok and found.worst_rest.value <= 1e-8 and found.worst_gouge.value <= 1e-8
    assert row(found, "pocket", "diameter").actual == pytest.approx(24, abs=1e-6)
    assert row(found, "pocket", "y").actual == pytest.approx(20, abs=1e-6)
    assert row(found, "pocket", "depth").actual == pytest.approx(8, abs=1e-6)


def test_grooves_studs_and_countersinks():
    tools = {4: Tool(radius=8, number=4, kind="countersink", angle=90)}
    groove = Groove(Contour([(10, 10), (40, 10), (40, 30)], closed=False), 6.0, 2.0)
    sunk = Hole(80, 20, 7.0, 12.0, countersink=(11.0, 90.0), name="sunk")
    design = Design(((0, 0, -20), (110, 74, 0)), (groove, sunk))
    tools[2] = Tool(radius=3.5, number=2, kind="drill", angle=118)

    def cuts(lower=0.0, sink=0.0):
        writer = Writer()
        writer.feature("groove", 1)
        writer.over(10, 10)
        writer.down(-2 - lower)
        writer.to(40, 10)
        writer.to(40, 30)
        writer.up()
        writer.feature("sunk", 2)
        writer.hole(sunk, 0.0)
        writer.feature("sink", 4)
        writer.over(80, 20)
        writer.down(-5.5 - sink)
        writer.up()
        return cut(writer, tools, step=0.3)

    found = cuts().compare(design)
    assert found.ok and found.worst_gouge.value <= 1e-8 and found.worst_rest.value <= 1e-8
    for name, value in (("countersink diameter", 11), ("countersink angle", 90), ("diameter", 7), ("depth", 12)):
        assert row(found, "sunk", name).actual == pytest.approx(value, abs=1e-6)
    assert found.features.of("groove")[0].measure == "width"
    assert found.features.of("groove")[0].actual == pytest.approx(6, abs=1e-9)
    off = cuts(0.1, 0.1).compare(design)
    assert row(off, "sunk", "countersink diameter").actual == pytest.approx(11.2, abs=1e-6)
    assert row(off, "groove", "depth").actual == pytest.approx(2.1, abs=1e-9)


def test_the_width_of_a_groove_is_not_that_of_its_outline():
    """Along a rectangle of 30 by 20 a mill of 10 makes walls at 40 by 30 and 20 by 10; a tolerance meets the groove alone."""
    groove = Groove(Rectangle(30, 20, 30, 20), 10, 2, tolerances={"width": 0.01})
    design = Design(BLOCK, (groove,))
    assert {each.name: each.nominal for each in groove.measures()} == {
        "width": 10, "outline length": 30, "outline width": 20, "x": 30, "y": 20, "depth": 2,
    }  # fmt: skip
    assert [each.name for each in groove.measures() if each.limits] == ["width"]
    text = "G0 X15 Y10 Z2\nG1 Z-2\nG1 X45\nG1 Y30\nG1 X15\nG1 Y10"
    found = part(text).compare(design)
    for name, value in (("width", 10), ("outline length", 30), ("outline width", 20)):
        assert row(found, "groove", name).actual == pytest.approx(value, abs=1e-6)
    wide = part(text, Tool(radius=5.02, number=1, kind="mill")).compare(design)
    assert row(wide, "groove", "width").actual == pytest.approx(10.04, abs=1e-6)
    assert [each.measure for each in wide.features.of("groove").outside] == ["width"]


def test_a_stud_and_a_chamfer_about_it():
    design = Design(BLOCK, (Stud.circle(30, 20, 20, 5), Chamfer(Pocket.circle(30, 20, 20, 1).contour, 1.0)))
    tools = {1: Tool(radius=5, number=1, kind="mill"), 3: Tool(radius=6, number=3, kind="chamfer", angle=90)}

    def cuts(more=0.0):
        writer = Writer()
        writer.feature("stud", 1)
        writer.around(30, 20, 10 - more + 2, 40, -5)  # the writer thinks of a mill of 3 mm
        writer.feature("bevel", 3)
        writer.bevel(30, 20, 10, 1.0, 0.0)
        return cut(writer, tools, stock=BLOCK)

    found = cuts().compare(design)
    assert found.ok and found.worst_gouge.value <= 1e-8 and found.worst_rest.value <= 1e-8
    assert row(found, "stud", "diameter").actual == pytest.approx(20, abs=1e-6)
    assert row(found, "chamfer", "width").actual == pytest.approx(1, abs=1e-6)
    thin = cuts(0.1).compare(design)
    assert row(thin, "stud", "diameter").actual == pytest.approx(19.8, abs=1e-6)
    assert thin.worst_gouge.value == pytest.approx(0.1, abs=1e-6) and thin.worst_gouge.feature == "stud"


def test_limits_of_the_drawing_count():
    wide = part(rings(), Tool(radius=5.03, number=1, kind="mill"))
    exact = Design(BLOCK, (Pocket.circle(30, 20, 24, 8, tolerances={"diameter": "H7"}),))
    assert not wide.compare(exact).ok  # 24.06, at most 24.021
    diameter = row(wide.compare(exact), "pocket", "diameter")
    assert (diameter.lower, diameter.upper, diameter.verdict) == (0, 0.021, "out")
    loose = Design(BLOCK, (Pocket.circle(30, 20, 24, 8, tolerances={"diameter": 0.1}),))
    assert wide.compare(loose, 0.02).ok and not wide.compare(Design(BLOCK, (CIRCLE,)), 0.02).ok


def test_threads_are_not_measured():
    design = Design(BLOCK, (Hole(30, 20, None, 10, thread="M8"),))
    found = part("G0 X30 Y20 Z2\nG1 Z-10", MILL).compare(design)
    assert row(found, "hole", "thread").verdict == "not cut"  # no tap, nothing that climbs round
    assert any("thread" in note for note in found.notes)


def test_what_it_prints():
    found = part(rings(-8.1)).compare(Design(BLOCK, (CIRCLE, Slot((10, 32), (20, 32), 4, 1)), title="plate"))
    text = repr(found.features)
    assert len({len(line) for line in text.splitlines()[:2]}) <= 2 and "8.1000" in text and "+0.1000" in text
    assert "plate" in repr(found) and "<table>" in found._repr_html_()
    kept = json.loads(json.dumps(found.as_dict(), allow_nan=False))
    assert kept["ok"] is False and kept["worst_gouge"]["feature"] == "pocket"
    assert [each["feature"] for each in kept["features"]][0] == "blank"


def test_the_design_of_a_file(tmp_path):
    path = tmp_path / "plate.toml"
    Design(BLOCK, (CIRCLE,)).save(path)
    assert part(rings()).compare(path).ok and part(rings()).compare(str(path)).ok


@pytest.mark.parametrize(
    ("given", "said"),
    [(None, "compared with"), (3, "compared with"), ("no-such.toml", "no-such"), (BLOCK, "compared with")],
)
def test_a_wrong_target_is_an_alarm(given, said):
    with pytest.raises(Alarm, match=said):
        part("G0 X30 Y20").compare(given)


@pytest.mark.parametrize("tolerance", [0, -1, math.nan, "fine", None])
def test_a_wrong_tolerance_is_an_alarm(tolerance):
    with pytest.raises(Alarm, match="tolerance"):
        part("G0 X30 Y20").compare(Design(BLOCK), tolerance)


def test_a_groove_cut_too_wide_keeps_its_middle():
    around = "G0 X20 Y10 Z2\nG1 Z-2\nG1 X50\nG1 Y30\nG1 X20\nG1 Y10\nG0 Z2\n"
    groove = Groove([(20, 10), (50, 10), (50, 30), (20, 30)], 6.0, 2.0)
    found = part(around, Tool(radius=3.1, number=1, kind="mill")).compare(Design(BLOCK, (groove,)), 0.05)
    for measure, actual in (("width", 6.2), ("outline length", 30.0), ("outline width", 20.0)):
        assert row(found, "groove", measure).actual == pytest.approx(actual, abs=1e-6)


def test_a_wall_that_goes_straight_on_has_no_radius():
    """A crown of 500 mm over 20 mm is one still, to the micrometre; a line is none, however it lies."""
    turns = np.linspace(-0.02, 0.02, 9)
    crown = np.array([3.0, 4.0]) + 500 * np.stack([np.cos(turns), np.sin(turns)], axis=1)
    assert circle(crown, np.array([400.0, 0.0])) == pytest.approx((3, 4, 500), abs=1e-3)
    for degrees in (0, 30, 90):
        way = np.array([math.cos(math.radians(degrees)), math.sin(math.radians(degrees))])
        straight = np.array([6.0, 1.0]) + np.linspace(-5, 5, 9)[:, None] * way
        assert all(math.isnan(each) for each in circle(straight, np.array([3.0, 3.0])))


@pytest.mark.parametrize("off", [0.0, 0.02])
def test_an_island_is_no_part_of_the_circle_of_its_pocket(off):
    """A mill of 10 mm once round at a radius of 7 leaves a ring, 24 outside and 4 inside."""
    ring = Pocket(Circle(30, 20, 24), 8, name="ring", islands=[Circle(30, 20, 4)])
    around = f"G0 X{37 + off} Y20 Z2\nG1 Z-8\nG3 X{37 + off} Y20 I-7 J0\n"
    found = part(around).compare(Design(BLOCK, (ring,)))
    assert found.ok
    for measure, actual in (("diameter", 24.0), ("x", 30 + off), ("y", 20.0)):
        assert row(found, "ring", measure).actual == pytest.approx(actual, abs=1e-9)


TAPPED = (
    "T1 M6\nS1000 M3\nG43 H1 G0 X20 Y20 Z5\nG1 Z-22.04 F100\nG0 Z5\n"
    "T2 M6\nS500 M3\nG43 H2 G0 X20 Y20 Z5\nG84 Z{deep} R2 F{feed}\nG80\nG0 Z50\n"
)


@pytest.mark.parametrize(
    ("deep", "feed", "pitch", "ok"),
    [(-15, 625, 1.25, True), (-16, 625, 1.25, True), (-12, 625, 1.25, False), (-15, 500, 1.0, False)],
)
def test_a_tapped_hole_is_measured_as_hole_and_as_thread(deep, feed, pitch, ok):
    """M8 in a hole of 6.8, its point of 118 degrees: 6.8 / 2 / tan 59° = 2.04 deep. The pitch is the feed over the speed."""
    stock = (0, 0, -30), (40, 40, 0)
    tools = {1: Tool(radius=3.4, kind="drill", angle=118), 2: Tool(radius=4, kind="tap")}
    done = mnclab.run(TAPPED.format(deep=deep, feed=feed), "g43", mnclab.Setup(stock=stock, tools=tools))
    found = done.workpiece().compare(Design(stock, (Hole(20, 20, 6.8, 20, thread="M8", thread_depth=15),)))
    actual = {name: row(found, "hole", name).actual for name in ("diameter", "thread", "thread depth", "pitch")}
    assert actual == pytest.approx({"diameter": 6.8, "thread": 8.0, "thread depth": -deep, "pitch": pitch}, abs=1e-3)
    assert row(found, "hole", "depth").ok and found.ok == ok
    assert found.worst_gouge.value < 0.01 and not any("not measured" in note for note in found.notes)
