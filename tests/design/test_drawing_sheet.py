"""Sheets, scales, title blocks, tables and files of drawings."""

import re
import subprocess
from shutil import which

import numpy as np
import pytest
from design.drawn import plate, rectangle
from matplotlib.image import imread

from mnclab.design.drawing.drawing import draw
from mnclab.design.drawing.ink import width_of
from mnclab.design.drawing.sheet import SIZES, Table, Title, fitted, scale_text
from mnclab.design.drawing.view import Cross, Cut, Diameter, Linear, Note, Value, View, ViewLine, number, value
from mnclab.geometry.contours import Contour
from mnclab.geometry.regions import Region
from mnclab.text.alarm import Alarm


def block(wide, high, *dimensions, name="front", **more):
    return View(name, (ViewLine(rectangle(0, 0, wide, high)),), (), dimensions, **more)


def texts(drawing, of):
    return [box.text for box in drawing.boxes() if box.of == of]


@pytest.mark.parametrize(
    ("wide", "high", "size", "scale"),
    [
        (50, 200, "A4", 1), (150, 60, "A4 landscape", 1), (20, 8, "A4 landscape", 10), (350, 150, "A4 landscape", 1 / 2),
        (175, 160, "A3", 1), (440, 330, "A3", 1 / 2),
    ],
)  # fmt: skip
def test_the_smallest_sheet_and_the_largest_scale_that_fit(wide, high, size, scale):
    """A3 only where a part is smaller than 90 mm on A4 and not in true size."""
    drawing = draw([block(wide, high, Linear((0, 0), (wide, 0), value(wide)))], "part")
    assert (drawing.sheets[0].size, drawing.scale) == (SIZES[size], scale)


def test_size_and_scale_may_be_given():
    drawing = draw([block(50, 40)], "part", size="a3", scale=0.5)
    assert (drawing.sheets[0].size.name, drawing.scale) == ("A3", 0.5)
    assert repr(drawing) == "<Drawing 'part': 1 sheet A3, 1:2>"
    with pytest.raises(Alarm, match="size must be A4, A4 landscape, A3 or A2, got 'A5'"):
        draw([block(50, 40)], "part", size="A5")
    with pytest.raises(Alarm, match="the scale must be greater than 0"):
        draw([block(50, 40)], "part", scale=0)


def test_what_has_no_room_is_an_alarm():
    with pytest.raises(Alarm, match="the views find no room"):
        draw([block(500, 400)], "part", scale=1)
    many = [Note((0, 0), ("all at one point",)) for _ in range(12)]  # whose arrowheads would lie on each other
    with pytest.raises(Alarm, match="the view 'front' has no room for 'all at one point' at 1:1"):
        draw([block(20, 10, *many)], "part", scale=1, size="A4")


@pytest.mark.parametrize(
    ("given", "message"),
    [
        ([], "a drawing needs at least one view"),
        ([block(5, 5), block(6, 6, name="top")], r"the cell \(0, 0\) of the arrangement holds one view, got front, top"),
        ([block(5, 5, Linear((0, 0), (0, 5), value(5)))], "the dimension 5 .* has no length along x"),
        ([block(5, 5, Linear((0, 0), (5, 5), value(5), "z"))], "along must be x, y or ab, got 'z'"),
        ([block(5, 5, Linear((0, 0), (5, 5), value(5), "x", "left"))], "side along x must be above or below, got 'left'"),
    ],
)
def test_wrong_views_are_alarms(given, message):
    with pytest.raises(Alarm, match=message):
        draw(given, "part")


def test_views_stand_in_the_first_angle():
    """Below the view from the front stands that from above, to its right that from the left, with x and y in common."""
    views = [block(60, 20), block(60, 40, name="above", cell=(0, 1)), block(40, 20, name="left", cell=(1, 0))]
    (sheet,) = draw(views, "part").sheets
    places = {laid.view.name: np.array(place) for laid, place in sheet.views}
    assert places["front"][0] == places["above"][0] and places["above"][1] < places["front"][1] - 40
    assert places["front"][1] == places["left"][1] and places["left"][0] > places["front"][0] + 60


def test_views_that_do_not_go_together_stand_on_several_sheets(tmp_path):
    views = [block(250, 170, name=str(k), cell=(k, 0)) for k in range(3)]
    drawing = draw(views, "part", size="A3", scale=1)
    assert [len(sheet.views) for sheet in drawing.sheets] == [1, 1, 1]
    assert [text for text in texts(drawing, "title block") if "/" in text] == ["1/3", "2/3", "3/3"]
    with pytest.raises(Alarm, match="a .svg file holds one of the 3 sheets"):
        drawing.save(tmp_path / "part.svg")
    assert drawing.save(tmp_path / "part.svg", sheet=3).exists()
    assert drawing.save(tmp_path / "part.pdf").read_bytes().count(b"/Type /Page ") == 3
    with pytest.raises(Alarm, match="the sheet must be at most 3, got 4"):
        drawing.figure(4)


def test_the_title_block_says_what_was_given_alone():
    full = Title("Bracket", "MNC-7", "S235", date="2026-01-31", drawn="I. Popa", owner="Lyceum")
    said = texts(draw([block(50, 40)], full), "title block")
    assert {"Bracket", "MNC-7", "S235", "2026-01-31", "I. Popa", "Lyceum", "ISO 2768-m", "mm", "A4", "1/1"} <= set(said)
    bare = texts(draw([block(50, 40)], "Bracket"), "title block")
    assert not {"drawn by", "date", "owner", "drawing number"} & set(bare)


def test_long_texts_are_broken_made_smaller_and_in_the_end_cut():
    lines, height = fitted("a long title of many words that needs more than one line", 60, 20)
    assert len(lines) > 1 and all(width_of(line, height) <= 60 for line in lines)
    (line,), height = fitted("W" * 200, 40, 6)
    assert line.endswith("…") and height == 1.8 and width_of(line, 1.8) <= 40


def test_a_table_stands_beside_the_views():
    table = Table("holes", ("No.", "X", "Y"), tuple((f"A{k}", "10", "20") for k in range(12)))
    drawing = draw([block(100, 60)], "part", tables=[table])
    boxes = {box.text: box.corners for box in drawing.boxes() if box.kind in ("text", "table")}
    low, high = boxes[""].min(axis=0), boxes[""].max(axis=0)
    for text in ("holes", "No.", "A0", "A11"):
        assert (low <= boxes[text].min(axis=0)).all() and (boxes[text].max(axis=0) <= high).all()
    with pytest.raises(Alarm, match="a row of the table 'holes' must have 2 texts, got 1"):
        Table("holes", ("No.", "X"), (("A1",),))


def test_files_have_the_true_size(tmp_path):
    drawing = draw([block(100, 60, Linear((0, 0), (100, 0), value(100)))], "part", size="A4 landscape", scale=1)
    svg = drawing.save(tmp_path / "part.svg").read_text("utf-8")
    width, height = map(float, re.search(r'width="([\d.]+)pt" height="([\d.]+)pt"', svg).groups())
    assert (width, height) == pytest.approx((297 * 72 / 25.4, 210 * 72 / 25.4))
    picture = imread(drawing.save(tmp_path / "part.png"))
    assert picture.shape[:2] == (round(210 / 25.4 * 300), round(297 / 25.4 * 300)) or picture.shape[1] == int(297 / 25.4 * 300)
    assert drawing.save(tmp_path / "again.svg").read_text("utf-8") == svg
    with pytest.raises(Alarm, match="cannot write a drawing as .jpg"):
        drawing.save(tmp_path / "part.jpg")


def test_circles_in_a_file_are_curves(tmp_path):
    view = View("round", (ViewLine(Contour.circle((0, 0), 20)),), axes=(Cross((0, 0), 20),))
    svg = draw([view], "part").save(tmp_path / "part.svg").read_text("utf-8")
    outline = re.search(r'<g id="OUTLINE">\s*<path d="([^"]*)"', svg)[1]
    assert outline.count("C") == 8 and outline.count("L") <= 1  # the one that closes it


@pytest.mark.skipif(which("pdftotext") is None, reason="needs pdftotext")
def test_a_pdf_has_its_text_and_its_letters(tmp_path):
    view = block(100, 60, Linear((0, 0), (100, 0), value(100, tolerance="h6")))
    path = draw([view], "Halter ȘȚ").save(tmp_path / "part.pdf")
    text = subprocess.check_output(["pdftotext", path, "-"], text=True)
    assert "Halter ȘȚ" in text and "100" in text and "h6" in text


def test_rows_of_dimensions_are_ten_and_then_seven_apart():
    """ISO 129: a chain in one row, parallel dimensions outside of it; the text above its line."""
    chain = [Linear((a, 0), (b, 0), value(b - a), side="below") for a, b in ((0, 30), (30, 60), (60, 100))]
    whole = Linear((0, 0), (100, 0), value(100), side="below")
    ((laid, _),) = draw([block(100, 60, *chain, whole)], "part", scale=1).sheets[0].views
    rows = {mark.of.value.text: mark.lines[0][1][1] for mark in laid.marks}
    assert rows == pytest.approx({"30": -10, "40": -10, "100": -17})
    for mark in laid.marks:
        assert mark.labels[0].at[1] == pytest.approx(mark.lines[0][1][1] + 1)
        (_, near, far), *_ = mark.lines[1:]
        assert near[1] == pytest.approx(-1) and far[1] == pytest.approx(mark.lines[0][1][1] - 2)


def test_hatching_keeps_away_from_texts():
    note = Note((50, 30), ("⌀12 H7",))
    view = View("section", (ViewLine(rectangle(0, 0, 100, 60)),), (Region.of(rectangle(0, 0, 100, 60)),), (note,))
    ((laid, _),) = draw([view], "part", scale=1).sheets[0].views
    x, y, u, v, *_ = laid.marks[0].labels[0].box()
    along = np.linspace(0, 1, 200)[:, None, None]
    points = (laid.hatches[:, 0] + along * (laid.hatches[:, 1] - laid.hatches[:, 0])).reshape(-1, 2)
    assert len(laid.hatches) > 20 and (np.abs(laid.hatches[:, 1] - laid.hatches[:, 0])[:, 0] > 0).all()
    assert not ((np.abs(points[:, 0] - x) < u + 0.7) & (np.abs(points[:, 1] - y) < v + 0.7)).any()
    slope = (laid.hatches[:, 1] - laid.hatches[:, 0])[:, 1] / (laid.hatches[:, 1] - laid.hatches[:, 0])[:, 0]
    assert slope == pytest.approx(np.ones(len(slope)))


def test_a_cut_has_letters_at_both_ends_outside_the_view():
    view = block(100, 60, cuts=(Cut(((0, 30), (100, 30)), "A", (0, 1)),))
    drawing = draw([view], "part", scale=1)
    letters = [box for box in drawing.boxes() if box.text == "A"]
    ((_, place),) = drawing.sheets[0].views
    left, right = sorted(box.corners.mean(axis=0)[0] - place[0] for box in letters)
    assert left < 0 and right > 100
    assert sum(box.kind == "arrow" for box in drawing.boxes()) == 2


def test_a_large_circle_has_its_dimension_line_across():
    view = View("round", (ViewLine(Contour.circle((0, 0), 40)),), (), (Diameter((0, 0), 40, value(80, "⌀")),))
    ((laid, _),) = draw([view], "part", scale=1).sheets[0].views
    first, last = (np.array(arrow.tip) for arrow in laid.marks[0].arrows)
    assert first == pytest.approx(-last) and np.hypot(*first) == pytest.approx(40)


@pytest.mark.parametrize(
    ("given", "text"),
    [((12.0,), "12"), ((-0.0,), "0"), ((1.2346,), "1.235"), ((-2.5,), "−2.5"), ((100,), "100"), ((1e-9,), "0"), ((40, 0), "40")],
)
def test_numbers(given, text):
    assert number(*given) == text


def test_values():
    assert value(12, "⌀", 0.1) == Value("⌀12", "±0.1")
    assert value(12, tolerance=(0, 0.021)) == Value("12", "", ("+0.021", "0"))
    assert value(30, after="°", tolerance=(-0.5, 0.5)).limits == ("+0.5°", "−0.5°")
    assert value(20, reference=True, tolerance="H7") == Value("20", "H7", None, True)
    with pytest.raises(Alarm, match="the value of a dimension must be a number"):
        value("12")


def test_scales_as_written():
    assert [scale_text(scale) for scale in (10, 2, 1, 1 / 2, 1 / 20)] == ["10:1", "2:1", "1:1", "1:2", "1:20"]


def test_a_drawing_shows_itself():
    bundle = draw(plate(1), "part", scale=1)._repr_mimebundle_()
    assert bundle["text/plain"] == "<Picture: Drawing 'part': 1 sheet A4, 1:1>" and len(bundle["image/png"]) > 1000
