"""Drawings of designs: every measure of every feature once, nothing on something else, the lines where the part has edges."""

from collections import Counter
from pathlib import Path

import ezdxf
import numpy as np
import pytest
import shapely
from design.drawn import covering
from design.random_designs import milled, turned
from shapely import Polygon

from mnclab.design import model as d
from mnclab.design.drawing import drawing, plot, save
from mnclab.text.alarm import Alarm

SAMPLES = sorted((Path(__file__).parents[2] / "data" / "designs").rglob("*.toml"))
BLANK = -1
BOX = ("length", "width", "height")


def expected(design):
    """What a drawing has to say: (feature, back, measure), each once."""
    if isinstance(design, d.TurnedDesign):
        found = Counter((BLANK, False, each.name) for each in design.measures())
    else:
        found = Counter((BLANK, False, name) for name in (BOX if hasattr(design.blank, "low") else ("diameter", "height")))
    for back, features in sides(design):
        found.update((k, back, measure.name) for k, each in enumerate(features) for measure in each.measures())
    return found


def check(drawn, design):
    assert Counter((each.feature, each.back, each.measure) for each in drawn.dimensions) == expected(design)
    boxes = [box for box in drawn.boxes() if box.kind in ("text", "arrow")]
    for a, b in covering(boxes):
        assert a.sheet != b.sheet or (a.of is b.of and not a.kind == b.kind == "text"), (a, b)
    for box in boxes:
        size = drawn.sheets[box.sheet - 1].size
        assert shapely.box(20, 10, size.width - 10, size.height - 10).covers(Polygon(box.corners))
    known = {(k, back): each for back, features in sides(design) for k, each in enumerate(features)}
    for each in drawn.dimensions:
        if each.feature == BLANK or each.text.startswith("ISO 6411"):  # which says a depth by the standard
            continue
        for measure in known[each.feature, each.back].measures():
            upright = measure.kind == "angle" and measure.nominal % 90 == 0  # as the picture shows
            if measure.name == each.measure and measure.kind != "place" and not upright:
                digits = 2 if measure.limits is None else 3
                numbers = (f"{size:.{digits}f}".rstrip("0").rstrip(".") for size in sizes(design, each, measure))
                assert any(number in each.text for number in numbers), each


def sides(design):
    return ((False, design.features), *([] if isinstance(design, d.TurnedDesign) else [(True, design.back)]))


def sizes(design, each, measure):
    """The numbers by which a measure may be written: grooves and pockets have a width twice."""
    feature = dict(sides(design))[each.back][each.feature]
    return [abs(other.nominal) for other in feature.measures() if other.name == measure.name]


@pytest.mark.parametrize("seed", range(4))
def test_every_measure_of_a_milled_part_once(seed):
    design = milled(seed)
    check(drawing(design), design)


@pytest.mark.parametrize("seed", range(8))
def test_every_measure_of_a_turned_part_once(seed):
    design = turned(seed)
    check(drawing(design), design)


@pytest.mark.deep
@pytest.mark.parametrize("first", range(100, 300, 20))
def test_every_measure_of_many_more(first):
    for make, count in ((milled, 12), (turned, 8)):  # two hundred in all
        for seed in range(first, first + count):
            design = make(seed)
            check(drawing(design), design)


@pytest.mark.deep
@pytest.mark.parametrize("path", SAMPLES, ids=lambda path: f"{path.parent.name}/{path.stem}")
def test_samples_are_drawn_and_read_by_another_program(path, tmp_path):
    design = d.Design.load(path)
    drawn = drawing(design)
    check(drawn, design)
    document = ezdxf.readfile(drawn.save(tmp_path / "part.dxf"))
    audit = document.audit()
    assert not audit.errors and not audit.fixes
    assert len(document.modelspace().query("DIMENSION"))


def texts(drawn, feature, measure, back=False):
    return [each.text for each in drawn.dimensions if (each.feature, each.back, each.measure) == (feature, back, measure)]


PLATE = d.Design(
    ((0, 0, -20), (80, 60, 0)),
    (
        d.Pocket.rectangle(30, 25, 40, 26, 6, corner=5, tolerances={"length": 0.1, "depth": (0, 0.1)}),
        d.Hole(30, 25, 10, None, tolerances={"diameter": "H7"}),
        d.Hole(68, 48, 6.6, None, counterbore=(11, 6.4)), d.Hole(68, 14, 6.6, None, counterbore=(11, 6.4)),
        d.Chamfer(d.Rectangle(40, 30, 80, 60), 1),
        d.Hole(10, 50, None, 16, thread="M6", thread_depth=12),
    ),
)  # fmt: skip


def test_texts_are_those_of_practice():
    drawn = drawing(PLATE)
    thin = "\N{THIN SPACE}"
    assert texts(drawn, 0, "length") == [f"40{thin}±0.1"] and texts(drawn, 0, "corner radius") == ["4× R5"]
    assert texts(drawn, 0, "depth") == ["6+0.10"]
    assert texts(drawn, 1, "diameter") == [f"⌀10{thin}H7"]
    assert texts(drawn, 2, "diameter") == texts(drawn, 3, "counterbore depth") == ["2× ⌀6.6\n⌴ ⌀11 ↧6.4"]
    assert texts(drawn, 4, "width") == ["1×45°"]
    assert texts(drawn, 5, "thread") == ["M6 ↧12\n⌀5 ↧16"]
    assert texts(drawn, 2, "x") == texts(drawn, 3, "x") == ["68"]  # one dimension for both
    assert texts(drawn, BLANK, "height") == ["20"]


def view(drawn, name):
    (found,) = [laid.view for sheet in drawn.sheets for laid, _ in sheet.views if laid.view.name == name]
    return found


def uprights(seen):
    """Where upright lines stand in a view."""
    points = [line.contour.points for line in seen.lines]
    return {round(float(each[0, 0]), 9) for each in points if np.ptp(each[:, 0]) < 1e-9}


def test_a_section_is_exact():
    """The cut faces of a plate with a stepped bore through its middle, by arithmetic."""
    design = d.Design(((0, 0, 0), (40, 30, 20)), (d.Pocket.rectangle(20, 15, 24, 10, 6), d.Hole(20, 15, 8, None)))
    front = view(drawing(design), "from the front")
    assert front.title == "A–A"
    assert sum(face.area for face in front.hatches) == pytest.approx(40 * 20 - 24 * 6 - 8 * 14, abs=1e-6)
    assert len(front.hatches) == 2
    assert {0.0, 8.0, 16.0, 24.0, 32.0, 40.0} <= uprights(front)


def test_a_blind_hole_has_its_point():
    design = d.Design(((0, 0, 0), (40, 30, 20)), (d.Hole(20, 15, 10, 12),))
    front = view(drawing(design), "from the front")
    tip = 5 / np.tan(np.radians(59))
    assert sum(face.area for face in front.hatches) == pytest.approx(40 * 20 - 10 * 12 - 5 * tip, abs=1e-5)
    cone = [line.contour.points for line in front.lines if np.ptp(line.contour.points, axis=0).min() > 1]
    assert len(cone) == 2 and min(points[:, 1].min() for points in cone) == pytest.approx(20 - 12 - tip, abs=1e-6)


def test_edges_from_above_are_lines_and_arcs():
    design = d.Design(((0, 0, 0), (40, 30, 20)), (d.Pocket.circle(20, 15, 20, 6), d.Chamfer(d.Circle(20, 15, 20), 1)))
    above = view(drawing(design), "from above")
    radii = sorted({round(float(r), 6) for line in above.lines for r in line.contour.radii if np.isfinite(r)})
    assert radii == [10.0, 11.0]
    assert len(above.lines) == 3


def test_a_chamfered_plate_has_its_mitres():
    design = d.Design(((0, 0, 0), (40, 30, 20)), (d.Chamfer(d.Rectangle(20, 15, 40, 30), 2),))
    above = view(drawing(design), "from above")
    slanting = [line.contour for line in above.lines if len(line.contour.points) == 2]
    assert len(slanting) == 4 and all(line.length == pytest.approx(2 * 2**0.5) for line in slanting)


def test_what_is_behind_a_wall_is_not_drawn():
    """A stud behind another, as high and narrower: from the front there is one."""
    design = d.Design(((0, 0, 0), (60, 40, 20)), (d.Stud.rectangle(30, 8, 30, 10, 8), d.Stud.rectangle(30, 30, 20, 10, 8)))
    front = view(drawing(design), "from the front")
    assert not front.hatches
    assert uprights(front) == {0.0, 15.0, 45.0, 60.0}


def test_a_back_side_has_its_own_view():
    design = d.Design(((0, 0, 0), (60, 40, 20)), (d.Pocket.circle(15, 20, 12, 5),), (d.Pocket.circle(40, 10, 16, 5),))
    drawn = drawing(design)
    below = view(drawn, "from below")
    (circle,) = [line.contour for line in below.lines if np.isfinite(line.contour.radii).all()]
    assert circle.centres[0].tolist() == pytest.approx([40, 10]) and circle.radii[0] == pytest.approx(8)
    assert texts(drawn, 0, "y", back=True) == ["10"]


def test_many_holes_stand_in_a_table():
    holes = tuple(d.Hole(10 + 10 * k, 10 + 7 * (k % 3), 5 + 0.5 * (k % 2), None) for k in range(12))
    drawn = drawing(d.Design(((0, 0, -10), (140, 40, 0)), holes))
    (table,) = [printed for sheet in drawn.sheets for printed, _ in sheet.tables]
    assert [label.text for label in table.labels[:8]] == ["No.", "X", "Y", "hole", "A1", "10", "10", "⌀5"]
    assert texts(drawn, 1, "x") == ["20"] and texts(drawn, 1, "diameter") == ["⌀5.5"]


def test_a_slot_from_edge_to_edge_has_the_length_of_the_blank():
    slot = d.Pocket.rectangle(35, 25, 70, 10, 6, name="slot")
    design = d.Design(((0, 0, -20), (70, 55, 0)), (slot,))
    drawn = drawing(design)
    check(drawn, design)
    assert [box.text for box in drawn.boxes() if box.kind == "text"].count("70") == 1 and texts(drawn, 0, "length") == ["70"]


def test_islands_stand_in_the_table_of_features_with_their_sizes():
    islands = [d.Circle(32, 35, 18), d.Rectangle(66, 35, 16, 16, corner=2)]
    pocket = d.Pocket.rectangle(50, 35, 76, 50, 5, corner=5, name="pocket", islands=islands)
    drawn = drawing(d.Design(((0, 0, -20), (100, 70, 0)), (pocket,)))
    (table,) = [printed for sheet in drawn.sheets for printed, _ in sheet.tables]
    said = [label.text for label in table.labels]
    assert said[8:12] == ["A2", "32", "35", "island of A1: ⌀18"]
    assert said[12:16] == ["A3", "66", "35", "island of A1: length 16, width 16, corner radius R2"]


def test_an_outline_has_a_table_of_its_corners():
    corner = np.tan(np.pi / 8)
    outline = d.Outline(((10, 10), (50, 10), (60, 20), (60, 40), (10, 40)), (0, corner, 0, 0, 0))
    drawn = drawing(d.Design(((0, 0, -10), (80, 50, 0)), (d.Pocket(outline, 4, name="window"),)))
    (table,) = [printed for sheet in drawn.sheets for printed, _ in sheet.tables]
    said = [label.text for label in table.labels]
    assert said[-1] == "contour of window" and said[8:12] == ["a2", "50", "10", "R10 ccw"]


def test_a_shaft():
    design = d.TurnedDesign(
        [(0, 12), (-25, 12), (-25, 17.5), (-60, 17.5), (-60, 22), (-75, 22)], chamfers={0: 1.5}, tolerances={"diameter 2": "h6"},
        features=(d.Thread("M24x1.5", 0, -20), d.RingGroove(-20, 5, diameter=20), d.CentreHole(2.5)),
    )  # fmt: skip
    drawn = drawing(design)
    assert texts(drawn, BLANK, "diameter 2") == ["⌀35\N{THIN SPACE}h6"]
    assert texts(drawn, BLANK, "diameter 1") == texts(drawn, 0, "thread") == ["M24×1.5"]
    assert texts(drawn, BLANK, "chamfer 1") == ["1.5×45°"] and texts(drawn, 1, "width") == ["5×⌀20"]
    assert texts(drawn, 2, "pilot diameter") == ["ISO 6411–A2.5/5.3"]
    side = view(drawn, "from the side")
    assert not side.hatches  # what is solid is not cut


def test_a_bush_is_cut_above_its_axis():
    design = d.TurnedDesign([(0, 20), (-30, 20)], (d.Bore(24, None), d.RingGroove(-10, 4, diameter=30, inside=True)))
    side = view(drawing(design), "from the side")
    assert sum(face.area for face in side.hatches) == pytest.approx(30 * 8 - 4 * 3, abs=1e-9)
    assert side.bounds.tolist() == [[-30, -20], [0, 20]]


@pytest.mark.parametrize(("size", "name"), [("A4", "A4"), ("A3", "A3")])
def test_sizes_and_files(size, name, tmp_path):
    drawn = drawing(PLATE, size=size)
    assert {sheet.size.name for sheet in drawn.sheets} == {name}
    path = save(PLATE, tmp_path / "plate.svg", size=size)
    text = path.read_text(encoding="utf-8")
    assert " C " in text or "\nC " in text  # arcs are curves
    width, height = plot(PLATE, size=size).get_size_inches() * 25.4
    assert (width, height) == pytest.approx((drawn.sheets[0].size.width, drawn.sheets[0].size.height))


def test_a_dxf_measures_what_the_design_says(tmp_path):
    document = ezdxf.readfile(save(PLATE, tmp_path / "plate.dxf"))
    found = [round(float(each.get_measurement()), 6) for each in document.modelspace().query("DIMENSION")]
    assert {80.0, 60.0, 20.0, 40.0, 26.0, 6.0, 5.0, 30.0, 68.0} <= set(found)


def test_the_door_of_a_design(tmp_path):
    assert PLATE.save(tmp_path / "plate.pdf").stat().st_size > 5000
    with pytest.raises(Alarm, match="a drawing is made of a design"):
        drawing("plate.toml")
    with pytest.raises(Alarm, match="there is nothing to draw"):
        drawing(d.Design(((0, 0, -20), (80, 60, 0)), d.Pocket.rectangle(40, 30, 80, 60, 20)))


def plain(drawn):
    return [each.text for each in drawn.dimensions if each.measure in ("x", "y")]


def test_holes_on_a_circle_have_its_diameter():
    holes = d.Hole.circle(0, 0, 6, 60, 6.6, None)
    drawn = drawing(d.Design(((-50, -50, -10), (50, 50, 0)), holes))
    check(drawn, d.Design(((-50, -50, -10), (50, 50, 0)), holes))
    assert plain(drawn) == ["⌀60"] * 12
    square = d.Hole.circle(0, 0, 4, 60, 6.6, None, first=45)  # the corners of a square have coordinates
    assert "⌀60" not in plain(drawing(d.Design(((-50, -50, -10), (50, 50, 0)), square)))


def test_holes_on_a_circle_that_is_turned_have_an_angle():
    design = d.Design(((-50, -50, -10), (50, 50, 0)), d.Hole.circle(5, 0, 3, 60, 6.6, None, first=20))
    drawn = drawing(design)
    check(drawn, design)
    assert {"20°", "5", "⌀60"} <= {box.text for box in drawn.boxes()}


def test_holes_in_equal_steps_have_their_number():
    design = d.Design(((0, 0, -10), (160, 100, 0)), d.Hole.grid(15, 15, 8, 5, 18, 17, 6, None))
    drawn = drawing(design)
    check(drawn, design)
    said = Counter(plain(drawn))
    assert said == {"15": 5 + 8, "7× 18 (=126)": 7 * 5, "4× 17 (=68)": 4 * 8}


def test_rows_of_equal_steps_share_them():
    rows = *d.Hole.row(30, 25, 4, 20, 5, None), *d.Hole.row(30, 55, 4, 20, 8, None)
    drawn = drawing(d.Design(((0, 0, -12), (120, 80, 0)), rows))
    assert [box.text for box in drawn.boxes()].count("3× 20 (=60)") == 1
    check(drawn, d.Design(((0, 0, -12), (120, 80, 0)), rows))


def test_very_many_kinds_of_features_stand_in_a_table():
    places = [(i, k) for i in range(4) for k in range(4)]
    pockets = tuple(d.Pocket.circle(8 + 11 * i, 8 + 11 * k, 7 + 0.2 * i + 0.1 * k, 2 + 0.3 * k) for i, k in places)
    drawn = drawing(d.Design(((0, 0, -20), (50, 50, 0)), pockets))
    assert texts(drawn, 0, "diameter") == ["pocket 1: ⌀7, ↧2"]


def test_depths_in_a_flight_are_said_once():
    steps = d.Pocket.rectangle(40, 30, 60, 40, 10, corner=6), d.Pocket.rectangle(40, 30, 40, 24, 8, corner=5, top=-10)
    design = d.Design(((0, 0, -40), (80, 60, 0)), (*steps, d.Pocket.circle(40, 30, 16, 6, top=-18)))
    drawn = drawing(design)
    check(drawn, design)
    assert texts(drawn, 2, "top") == texts(drawn, 1, "depth") == ["8"]
    assert "18" not in {box.text for box in drawn.boxes()}  # the floor of the second is the top of the third


def test_rounded_corners_of_a_chamfer_have_no_edges_at_other_heights():
    inner = d.Rectangle(40, 30, 40, 24, 6)
    edges = (d.Chamfer(inner, 1), d.Chamfer(d.Circle(10, 10, 8), 0.5))
    parts = (d.Pocket(inner, 6), d.Hole(10, 10, 8, None), *edges)
    section = drawing(d.Design(((0, 0, -15), (80, 60, 0)), parts)).sheets[0].views[0][0]
    level = [line.contour.points for line in section.view.lines if np.ptp(line.contour.points[:, 1]) < 1e-9]
    assert all(np.ptp(points[:, 0]) < 0.01 for points in level if abs(points[0, 1] + 0.5) < 1e-3)


def test_a_thread_from_end_to_end_has_the_length_of_the_part():
    nut = d.TurnedDesign([(0, 18), (-25, 18)], (d.Bore(17.5, None), d.Thread("M20", 0, -25, inside=True)))
    drawn = drawing(nut)
    check(drawn, nut)
    assert [box.text for box in drawn.boxes()].count("25") == 1


def test_a_contour_of_very_many_points_has_some_of_them_in_its_table():
    angle = np.radians(np.arange(0, 360, 3))
    oval = d.Pocket(np.stack([50 + 30 * np.cos(angle), 30 + 18 * np.sin(angle)], axis=1), 5)
    drawn = drawing(d.Design(((0, 0, -20), (100, 60, 0)), (oval,)))
    said = [box.text for box in drawn.boxes() if box.kind == "text"]
    assert sum(text.startswith("a") and text[1:].isdigit() for text in said) == 2 * 30  # in the view and in the table
    assert any("1 of every 4 of its 120 points" in text for text in said)
    check(drawn, d.Design(((0, 0, -20), (100, 60, 0)), (oval,)))
