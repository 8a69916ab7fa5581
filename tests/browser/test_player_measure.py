"""Two clicks in the player measure what arithmetic says: exactly where moves or the blank tell, else within a cell."""

import math
import re

import pytest
from tools.pages import BEGUN

import mnclab
from mnclab import Setup, Tool
from mnclab.workpiece.blank import chuck, cylinder

TOOLS = {
    1: Tool(number=1, radius=4, kind="mill"),
    2: Tool(number=2, radius=6, angle=90, kind="countersink"),
    3: Tool(number=3, radius=3, corner=3, kind="mill"),
}
#: A pocket of 60 by 40, 5 deep, with corners of the tool; a hole of 12, 8 deep, about X90 Y40; a countersink 3 deep; a slot
#: from the left side, 2 deep, of a ball.
ROWS = "\n".join(f"G1 X{x} Y{y}\nY{y + 6}" for y, x in zip(range(25, 55, 6), [75, 25] * 3))
PROGRAM = f"""G17 G90 G54 T1 S3000 M3
G0 X24 Y24 Z5
G1 Z-5 F800
X76
Y56
X24
Y24
{ROWS}
G0 Z5
G0 X90 Y40
G1 Z-8
X92
G3 X92 Y40 I-2 J0
G1 X90
G0 Z5
T2 S3000 M3
G0 X50 Y70
G1 Z-3
G0 Z5
T3 S3000 M3
G0 X-6 Y10
G0 Z-2
G1 X30
G0 Z5
G0 X120 Y100 Z40
"""
BLOCK = ((0, 0, -20), (100, 80, 0))
LATHE = """M3 T1
S800 G97 G95 F0.2
G00 X24 Z0
G01 X-1
G00 X20 Z2
G01 Z-40
X23
G00 X60 Z40
T3
G00 X23 Z-20
G01 X16 F0.05
G00 X23
G00 X60 Z40
T2
F0.1
G00 X13 Z2
G01 Z0
X17
G12 Z-10 R3
G00 X60 Z40
"""
NO_WEBGL = """HTMLCanvasElement.prototype.getContext = (own => function (kind, ...rest) {
    return kind === "webgl2" ? null : own.call(this, kind, ...rest);
})(HTMLCanvasElement.prototype.getContext);"""
CUT = "() => !window.player.part || !window.player.part.carving || window.player.part.carving.there"


@pytest.fixture
def opened(browser, tmp_path):
    """opened(run) opens the saved page at the end of the run, with the measuring on; faults of the page fail the test."""
    faults, contexts = [], []

    def open_page(run, before="", **options):
        assert run.ok, run.alarms
        context = browser.new_context(**{"viewport": {"width": 1366, "height": 768}, **options})
        contexts.append(context)
        page = context.new_page()
        if before:
            page.add_init_script(before)
        page.on("console", lambda message: "ReadPixels" in message.text or faults.append(message.text))
        page.on("pageerror", lambda error: faults.append(str(error)))
        page.goto(run.save(tmp_path / "part.html").as_uri())
        page.evaluate(BEGUN)
        page.keyboard.press("End")
        page.keyboard.press("m")
        page.wait_for_timeout(100)
        page.wait_for_function(CUT)
        return page

    yield open_page
    for context in contexts:
        context.close()
    assert faults == []


def mill(stock=BLOCK, program=PROGRAM):
    return mnclab.run(program, "mnc", Setup(stock=stock, tools=TOOLS))


def lathe():
    setup = Setup(start=(60, 0, 40), stock=cylinder(22, -60, 1), fixtures=(chuck(22, -60),))
    return mnclab.run(LATHE, "jnc-t01", setup)


def on_screen(page, at):
    x, y = page.evaluate("at => window.player.picture.camera.project(at)", list(at))
    box = page.locator("#picture").bounding_box()
    return box["x"] + x, box["y"] + y


def clicked(page, *places):
    """What clicks near places find: the points that are measured then."""
    for at in places:
        page.mouse.click(*on_screen(page, at))
    return page.evaluate("() => window.player.measure.points")


def closer(page, at, times=6):
    """The same view, some steps nearer about a place."""
    for _ in range(times):
        page.keyboard.press("+")
    page.evaluate(
        "at => { const {picture} = player; picture.camera.target = at; picture.stale = true; player.draw(); }", list(at)
    )


def values(page):
    """The cells of the table, row by row, as text."""
    rows = page.evaluate("[...document.querySelectorAll('#values tr')].map(row => [...row.cells].map(cell => cell.textContent))")
    return [[text.replace("\N{MINUS SIGN}", "-") for text in row] for row in rows]


@pytest.mark.parametrize(("view", "before"), [("Top", ""), ("Top", NO_WEBGL), ("3D", "")], ids=["top", "without webgl", "3D"])
def test_the_width_of_the_pocket(opened, view, before):
    page = opened(mill(), before)
    page.get_by_role("button", name=view, exact=True).click()
    left, right = clicked(page, (20.2, 45, 0), (80.2, 31, 0))
    assert left["at"][0] == pytest.approx(20, abs=1e-9) and right["at"][0] == pytest.approx(80, abs=1e-9)
    assert left["at"][2] == right["at"][2] == 0 and not left["off"] and not right["off"]
    assert values(page)[3][1] == "60.000" and "60.000 mm between the edges" in values(page)[3][4]


@pytest.mark.parametrize("view", ["Top", "3D"])
def test_the_hole_has_its_diameter_centre_and_depth(opened, view):
    page = opened(mill())
    page.get_by_role("button", name=view, exact=True).click()
    rim, floor = clicked(page, (90, 46, 0), (87, 42.5, -8))
    assert rim["what"] == "edge" and not rim["off"]
    assert rim["round"]["d"] == pytest.approx(12, abs=1e-9) and rim["round"]["centre"] == pytest.approx([90, 40, 0])
    assert "⌀ 12.000, centre X 90.000 Y 40.000" in values(page)[1][4]
    if view == "Top":  # from the side the rim hides the floor
        assert floor["what"] == "surface" and values(page)[3][3] == "-8.000"


def test_corners_of_the_blank_and_a_round_corner_of_the_pocket(opened):
    page = opened(mill())
    page.get_by_role("button", name="Top", exact=True).click()
    clicked(page, (0.4, 0.3, 0), (99.6, 79.8, 0))
    assert values(page)[3][1:4] == ["100.000", "80.000", "0.000"]
    assert f"distance {math.hypot(100, 80):.3f} mm" in values(page)[3][4]
    corner, *_ = clicked(page, (76 + 2.9, 56 + 2.9, 0))
    assert corner["round"]["d"] == pytest.approx(8) and corner["round"]["centre"] == pytest.approx([76, 56, 0])


def test_a_countersink_has_the_diameter_of_its_rim(opened):
    """90 degrees and 3 deep: 6 at the top."""
    page = opened(mill())
    page.get_by_role("button", name="Top", exact=True).click()
    (rim,) = clicked(page, (50 + 3, 70, 0))
    assert rim["round"]["d"] == pytest.approx(6, abs=1e-6) and rim["at"] == pytest.approx([53, 70, 0], abs=0.05)


def test_the_slot_of_a_ball_is_measured_at_places_between_cells(opened):
    """At y beside its axis the ball of radius 3 leaves -2 + 3 - sqrt(9 - y²); it is 2 sqrt(9 - 1) wide at the top."""
    page = opened(mill())
    page.get_by_role("button", name="Top", exact=True).click()
    closer(page, (8, 10, 0))
    (floor,) = clicked(page, (8, 11.1, -1.8))
    y = floor["at"][1] - 10
    assert 0.9 < y < 1.3 and floor["at"][2] == pytest.approx(1 - math.sqrt(9 - y * y), abs=1e-6)
    page.keyboard.press("Escape")
    lower, upper = clicked(page, (7, 10 - math.sqrt(8), 0), (9, 10 + math.sqrt(8), 0))
    assert upper["at"][1] - lower["at"][1] == pytest.approx(2 * math.sqrt(8), abs=1e-6)
    page.keyboard.press("Escape")
    (corner,) = clicked(page, (0.05, 10 + math.sqrt(8) + 0.05, 0))
    assert corner["what"] == "corner" and corner["at"] == pytest.approx([0, 10 + math.sqrt(8), 0], abs=1e-6)


def test_a_program_in_inches_is_measured_in_inches(opened):
    """Two inches of X and one of Y between two ends of moves; the page and the keyboard's voice say the unit."""
    page = opened(mnclab.run("G20 G90 G54 T1 S800 M3\nG0 X0 Y0 Z0.1\nG1 Z-0.1 F10\nX2\nY1\nG0 Z1\n", "iso"))
    page.get_by_role("button", name="Top", exact=True).click()
    clicked(page, (0, 0, -2.54), (50.8, 25.4, -2.54))
    rows = values(page)
    assert rows[0][0] == "in" and rows[3][1:3] == ["2.0000", "1.0000"]
    assert re.match(r"distance \d\.\d{4} in", rows[3][4]) and "mm" not in page.get_by_role("status").inner_text()


def test_a_round_blank_is_measured_within_a_cell(opened):
    page = opened(mill(cylinder(25, -20, 0, at=(45, 22, 0)), "T1 S800 M3\nG0 X45 Y22 Z5\nG1 Z-3 F100\nG0 Z60\n"))
    page.get_by_role("button", name="Top", exact=True).click()
    (rim,) = clicked(page, (45, 47, 0))
    step = 50 / 300
    assert rim["off"] == pytest.approx(step) and rim["round"]["off"] == pytest.approx(step)
    assert rim["round"]["d"] == pytest.approx(50, abs=step)
    assert rim["round"]["centre"][:2] == pytest.approx([45, 22], abs=step)
    assert re.match(r"edge ± 0\.167, ⌀ \d+\.\d{3} ± 0\.167, centre", values(page)[1][4])


def test_points_of_the_path_are_ends_middles_and_centres(opened):
    page = opened(mnclab.run("T1 S800 M3\nG0 X10 Y10\nG1 X40 F300\nG3 X40 Y30 I0 J10\nG1 X10\n", "mnc"))
    end, middle = clicked(page, (40.3, 10, 0), (25.2, 29.8, 0))
    assert (end["what"], middle["what"]) == ("end of a move", "middle of a move")
    assert values(page)[3][1:4] == ["-15.000", "20.000", "0.000"] and "distance 25.000 mm" in values(page)[3][4]
    (centre,) = clicked(page, (40.2, 20.2, 0))
    assert centre["what"] == "centre of an arc" and centre["at"] == pytest.approx([40, 20, 0])
    assert "⌀ 20.000 of the path" in values(page)[1][4]


def test_moves_are_edges_too(opened):
    """Parallel to the first one runs another 20 beside it; the last one rises by 3 in 4: atan(3 / 4). A hidden rapid is none."""
    text = "T1 S800 M3\nG0 X10\nY10\nG1 X70 F300\nY30\nX10\nX50 Y60\nG0 Y10\n"
    page = opened(mnclab.run(text, "mnc"))
    page.get_by_role("button", name="Top", exact=True).click()
    low, high = clicked(page, (25, 10.4, 0), (58, 29.7, 0))
    assert low["what"] == high["what"] == "on a move" and low["at"] == pytest.approx([25, 10, 0], abs=0.2)
    assert low["at"][1] == pytest.approx(10, abs=1e-9) and high["at"][1] == pytest.approx(30, abs=1e-9)
    assert "20.000 mm between the edges" in values(page)[3][4]
    clicked(page, (25, 10.4, 0), (20, 37.5, 0))
    assert f"{math.degrees(math.atan(3 / 4)):.3f}".rstrip("0") + "\N{DEGREE SIGN} between the edges" in values(page)[3][4]
    page.keyboard.press("Escape")
    assert len(clicked(page, (50, 45, 0))) == 1
    page.keyboard.press("Escape")
    page.keyboard.press("r")
    assert clicked(page, (50, 45, 0)) == []


@pytest.mark.parametrize("view", ["ZX", "3D"])
def test_the_groove_of_a_lathe(opened, view):
    """The blade is 3 wide, its left corner at Z-20; the bar has been turned to 40, the groove to 32: 4 deep."""
    page = opened(lathe())
    page.get_by_role("button", name=view, exact=True).click()
    closer(page, (18, 0, -20), 3)
    (bar, floor) = clicked(page, (20.1, 0, -13.5), (16.1, 0, -18.5))
    assert bar["what"] == floor["what"] == "cylinder"
    assert values(page)[3][1:3] == ["-8.000", "-4.000"] and values(page)[1][1] == "40.000"
    left, right = clicked(page, (18, 0, -20.1), (18, 0, -16.9))
    assert left["what"] == right["what"] == "face" and values(page)[3][3] == "3.000"
    (corner,) = clicked(page, (16.1, 0, -17.1))
    assert corner["what"] == "corner" and corner["at"] == pytest.approx([16, 0, -17], abs=1e-4)
    page.keyboard.press("Escape")
    page.keyboard.press("f")
    over, under = clicked(page, *[(side * 20, 0, -30) for side in (1, -1)])
    assert (over["at"][0], under["at"][0]) == pytest.approx((20, -20))


def test_an_arc_of_a_lathe_has_its_radius(opened):
    """A fillet of 3 about Z-7 X20; the nose of 0.4 stands off its tip, so the part has 3.4 about Z-6.6 X20.4."""
    page = opened(lathe())
    closer(page, (18, 0, -8), 4)
    (arc,) = clicked(page, (20.4 - 3.4 / math.sqrt(2), 0, -6.6 - 3.4 / math.sqrt(2)))
    assert arc["what"] == "arc" and arc["round"]["d"] / 2 == pytest.approx(3.4, abs=arc["round"]["off"])
    assert arc["round"]["centre"] == pytest.approx([20.4, 0, -6.6], abs=2e-3)
    assert "R 3.400" in values(page)[1][4]


def test_where_a_circle_ends_it_is_measured_and_not_the_tool(opened):
    """A bore of 28 by a helix; the tool of 8 touches its wall where the circles begin and end."""
    down = "".join(f"G3 X60 Y50 I-10 J0 Z{-k}\n" for k in range(1, 7))
    head = "G17 G90 G54 T1 S3000 M3\nG0 X60 Y50 Z5\nG1 Z0 F500\n"
    page = opened(mill(program=f"{head}{down}G3 X60 Y50 I-10 J0\nG0 Z30\n"))
    page.get_by_role("button", name="Top", exact=True).click()
    (rim,) = clicked(page, (64, 50, 0))
    assert rim["round"]["d"] == pytest.approx(28) and rim["round"]["centre"] == pytest.approx([50, 50, 0])
    page.keyboard.press("Escape")
    page.get_by_role("button", name="3D", exact=True).click()
    (wall,) = clicked(page, (50, 64, -3))
    assert wall["what"] == "wall" and wall["round"]["d"] == pytest.approx(28)


@pytest.mark.deep
def test_among_many_moves_a_place_is_found_while_the_pointer_moves(opened):
    x = [(k % 200 if k // 200 % 2 == 0 else 199 - k % 200) / 2 for k in range(6000)]
    lines = "\n".join(f"X{a} Y{k // 200} Z{-4 + 3 * math.sin(k / 90):.3f}" for k, a in enumerate(x))
    head = "G17 G90 G54 T1 S3000 M3\nG0 X0 Y0 Z20\nG1 Z-3 F800\n"
    page = opened(mill(((0, 0, -20), (100, 40, 0)), f"{head}{lines}\nG0 Z30\n"))
    page.get_by_role("button", name="Top", exact=True).click()
    times = page.evaluate("""() => [0.35, 0.4, 0.45, 0.5, 0.55, 0.6, 0.65].map(share => {
        const begin = performance.now(), [w, h] = player.picture.camera.size;
        player.measure.place(w * share, h * 0.5);
        return performance.now() - begin;
    })""")
    assert sorted(times)[3] < 400  # some ten ms on a quiet machine


def test_keys_measure_too(opened):
    page = opened(mill())
    page.keyboard.press("1")  # from above; the pointer begins in the middle of the picture
    for key, times in (("ArrowDown", 4), ("Shift+ArrowDown", 3), ("Enter", 1), ("ArrowRight", 3), ("Enter", 1)):
        for _ in range(times):
            page.keyboard.press(key)
    first, second = page.evaluate("() => window.player.measure.points")
    assert second["at"][0] - first["at"][0] == pytest.approx(30 / page.evaluate("() => player.picture.camera.zoom"), abs=1e-6)
    assert page.get_by_role("status").inner_text().startswith(second["what"])


def test_escape_clears_and_then_ends_and_a_third_click_begins_anew(opened):
    page = opened(mill())
    page.get_by_role("button", name="Top", exact=True).click()
    button, board = page.get_by_role("button", name="Measure"), page.get_by_role("group", name="measured")
    assert len(clicked(page, (5, 5, 0), (9, 70, 0))) == 2
    assert len(clicked(page, (5, 70, 0))) == 1
    page.keyboard.press("Escape")
    assert clicked(page, (-15, 40, 0)) == [] and page.locator("#doing").inner_text() == "nothing to measure there"
    assert page.evaluate("() => window.player.measure.points.length") == 0 and board.is_visible()
    page.keyboard.press("Escape")
    assert button.get_attribute("aria-pressed") == "false" and not board.is_visible() and page.locator("#modal").is_visible()
    step = page.evaluate("() => window.player.step")
    page.mouse.click(*on_screen(page, (76, 40, -5)))  # leads to the move again
    assert page.evaluate("() => window.player.step") != step


def test_a_touch_measures(opened):
    page = opened(mill(), viewport={"width": 390, "height": 780}, has_touch=True)
    page.get_by_role("button", name="Top", exact=True).click()
    page.touchscreen.tap(*on_screen(page, (21.5, 40, 0)))
    (edge,) = page.evaluate("() => window.player.measure.points")
    assert edge["what"] == "edge" and edge["at"] == pytest.approx([20, 40, 0], abs=1)
    table, picture = (page.locator(name).bounding_box() for name in ("#measured", "#picture"))
    assert table["y"] >= picture["y"] + picture["height"] and table["x"] + table["width"] <= 390


def test_values_are_copied_from_a_frame_of_a_notebook(browser, tmp_path):
    """Which is sandboxed, and may not ask for the clipboard."""
    (tmp_path / "notebook.html").write_text(mill().player()._repr_html_(), "utf-8")
    page = browser.new_page(viewport={"width": 1000, "height": 700})
    page.goto((tmp_path / "notebook.html").as_uri())
    page.set_content(f'{(tmp_path / "notebook.html").read_text("utf-8")}<textarea id="paste"></textarea>')
    frame = page.frame_locator("iframe")
    frame.get_by_role("button", name="Measure").click()
    frame.get_by_role("button", name="Top", exact=True).click()
    frame.locator("#picture").click()
    frame.get_by_role("button", name="Copy").click()
    assert frame.get_by_role("status").inner_text() == "copied"
    page.locator("#paste").click()
    page.keyboard.press("Control+v")
    head, first = page.locator("#paste").input_value().strip().splitlines()[:2]
    assert head.split("\t")[:4] == ["mm", "X", "Y", "Z"] and re.match(r"1\t[\d.]+\t[\d.]+\t", first)
    page.close()


@pytest.mark.parametrize(("width", "height"), [(1366, 768), (1920, 1080), (700, 560)])
def test_the_values_stand_beside_the_picture_and_cover_nothing(opened, width, height):
    page = opened(mill(), viewport={"width": width, "height": height})
    page.get_by_role("button", name="Top", exact=True).click()
    clicked(page, (90, 46, 0), (79, 59, 0))
    boxes = [page.locator(name).bounding_box() for name in ("#measured", "#picture", ".transport", ".curve")]
    board = boxes[0]
    for other in boxes[1:]:
        assert any(
            one[at] >= two[at] + two[size] - 0.5
            for one, two in ((board, other), (other, board)) for at, size in (("x", "width"), ("y", "height"))
        )  # fmt: skip
    wide, room = page.evaluate("() => ['scrollWidth', 'clientWidth'].map(name => player.find('measured')[name])")
    assert wide <= room
