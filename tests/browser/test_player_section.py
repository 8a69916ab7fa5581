"""The player turns: the section on its canvas is that of the kernel at every place, forwards and backwards."""

import numpy as np
import pytest
from tools.pages import BEGUN

import mnclab
from mnclab import Setup, Tool
from mnclab.workpiece.blank import chuck, cylinder

BAR = cylinder(31, -90, 1)
PROGRAM = """M3
T1
S800 G97 G95 F0.25
G00 X32 Z3
G77 X20.3 Z-59.9 U20.3 W-59.9 D3
G00 X21
G77 X14 Z-25 U18 W-21 D3
G00 X40 Z20
T2
G00 X10 Z2
G01 Z0
G14 X13 R-3
G12 Z-26 R5
G01 X20 Z-32
Z-60
X31
G00 X60 Z50
M5
"""
#: Whether material is seen at places (z, r), on the upper half and on the lower one.
SEEN = """([item, share, places]) => {
    const player = window.player, {run, part, picture} = player, {camera, ratio} = picture;
    player.place = share === null ? player.afterItem(item)
        : {item, t: run.begin[item] + share * (run.end[item] - run.begin[item]), done: false};
    player.draw();
    const pen = part.canvas.getContext("2d");
    return [1, -1].map(side => places.map(([z, r]) => {
        const [x, y] = camera.project([side * r, 0, z]);
        return pen.getImageData(Math.round(x * ratio), Math.round(y * ratio), 1, 1).data[3] > 128;
    }));
}"""


@pytest.fixture
def run():
    found = mnclab.run(PROGRAM, "jnc-t01", Setup(stock=BAR, fixtures=(chuck(31, -90),)))
    assert found.ok, found.alarms
    return found


def clear_of_the_contour(run, row, points):
    """Places that lie 0.5 mm or more off the kernel's section after a row, and whether it holds them."""
    section = run.workpiece(row=row).section
    inside = sum(contour.winding(points) for contour in section) != 0
    away = np.min([contour.distance(points) for contour in section], axis=0) > 0.5
    return points[away], inside[away]


def test_the_section_is_that_of_the_kernel_forwards_and_backwards(browser, tmp_path, run):
    page = browser.new_page(viewport={"width": 1366, "height": 768})
    faults = []
    page.on("pageerror", lambda error: faults.append(str(error)))
    page.goto(run.save(tmp_path / "part.html").as_uri())
    page.evaluate(BEGUN)
    dice = np.random.default_rng(4)
    points = dice.uniform((-60, 1), (2, 32), (400, 2))
    rows = [row for row in range(len(run.toolpath)) if run.toolpath.is_motion[row]]
    for row in [*rows[::4], rows[-1], *rows[-2::-5]]:
        item = page.evaluate("row => window.player.run.itemOfRow[row]", row)
        places, inside = clear_of_the_contour(run, row, points)
        for seen in page.evaluate(SEEN, [item, None, places.tolist()]):
            assert seen == inside.tolist()
    page.close()
    assert faults == []


def test_within_a_row_the_tool_has_cut_up_to_where_it_stands(browser, tmp_path, run):
    """The first pass at radius 29 turns from Z3 to Z-59.9 away what lies outside."""
    page = browser.new_page(viewport={"width": 1366, "height": 768})
    page.goto(run.save(tmp_path / "part.html").as_uri())
    page.evaluate(BEGUN)
    path = run.toolpath
    (row, *_) = np.flatnonzero((path.end[:, 2] < -59) & (path.kind == 1))
    item = page.evaluate("row => window.player.run.itemOfRow[row]", int(row))
    places = [[z, 30.2] for z in (-5, -15, -25, -35, -45, -55)]
    for share in (0.5, 0.8, 0.3):
        seen = page.evaluate(SEEN, [item, share, places])
        z = page.evaluate("() => window.player.now().point[2]")
        assert seen == [[place < z for place, _ in places]] * 2
    page.close()


def test_the_insert_stands_at_the_tip_and_what_it_cut_is_seen_through_it(browser, tmp_path, run):
    """The colours of the page have an alpha below 1, and the shapes are those of the figures: their tips are at (0, 0)."""
    page = browser.new_page(viewport={"width": 1366, "height": 768})
    page.goto(run.save(tmp_path / "part.html").as_uri())
    page.evaluate(BEGUN)
    drawn = page.evaluate("""() => {
        const found = [];
        window.drawInsert = (pen, tool, tip, project, colours) => found.push([tool, tip, colours.insert, colours.holder]);
        player.go(player.afterItem(player.run.itemOfRow[player.run.path.n - 2]));
        player.draw();
        return found.at(-1);
    }""")
    (tool, tip, *glass), row = drawn, len(run.toolpath) - 2
    assert tip == pytest.approx(run.toolpath.end[row])
    assert all(len(colour) == 9 and int(colour[7:], 16) < 200 for colour in glass)
    corners = np.array(tool["insert"])
    assert corners.min(axis=0) == pytest.approx((0, 0), abs=0.02)  # T2: the nose touches the z and the r of its tip
    page.close()


def test_without_a_blank_a_thread_is_cut_by_a_pointed_insert(browser, tmp_path):
    """The tool table knows no shape: 60 degrees between the flanks, the tip in their middle."""
    setup = Setup(tools={9: Tool(number=9)}, start=(30, 0, 20))
    bare = mnclab.run("M3\nT9\nG97 S300\nG00 X12 Z4\nG32 Z-20 F2\n", "jnc-t01", setup)
    page = browser.new_page()
    page.goto(bare.save(tmp_path / "bare.html").as_uri())
    page.evaluate(BEGUN)
    tools = page.evaluate("player.run.inserts.tools")
    corners = np.unique(tools[-1]["insert"], axis=0)
    (tip,) = corners[corners[:, 1] < 1e-6]
    left, right = corners[[corners[:, 0].argmin(), corners[:, 0].argmax()]] - tip
    assert tip == pytest.approx((0, 0)) and left[0] == pytest.approx(-right[0])
    assert np.degrees(np.arctan2(right[0], right[1])) == pytest.approx(30, abs=0.1)
    page.close()


def test_without_a_blank_the_insert_is_a_body_as_well(browser, tmp_path):
    """Seen along the axis an insert is as thick to both sides as 0.16 of its size, as where there is a blank."""
    bare = mnclab.run("M3\nT1\nG00 X12 Z4\nX30\n", "jnc-t01")
    page = browser.new_page()
    page.goto(bare.save(tmp_path / "bare.html").as_uri())
    page.evaluate(BEGUN)
    page.get_by_role("button", name="End", exact=True).click()
    page.keyboard.press("End")
    shown = page.evaluate("""shares => {
        const {picture, run} = window.player, pen = picture.canvas.getContext("2d");
        const {insert} = run.inserts.tools[run.inserts.which.value(run.path.n - 1)];
        const spans = [0, 1].map(k => insert.map(each => each[k])).map(all => [Math.min(...all), Math.max(...all)]);
        const size = Math.max(...spans.map(([low, high]) => high - low)), [x, y, z] = run.path.vertex(run.path.n);
        window.player.draw();
        return shares.map(share => {
            const at = picture.camera.project([x + spans[1][0] + 0.2 * size, y + share * size, z]);
            return pen.getImageData(...at.map(v => Math.round(v * picture.ratio)), 1, 1).data[3] > 0;
        });
    }""", [-0.35, -0.14, -0.05, 0.05, 0.14, 0.35])  # fmt: skip
    assert shown == [False, True, True, True, True, False]
    page.close()


@pytest.mark.parametrize(("program", "control", "said"), [
    ("N1 S800\nN2 F20\nN3 X4000~\nN4 G77*~\nN5 X2440*\nN6 Z-2990*\nN7 F3000*\nN8 P400\n", "nc-31", "roughing insert 80° (no T)"),
    ("G95 F0.2\nM3 S500\nG0 X20 Z2\nG1 Z-9\n", "jnc-t01", "default insert (no T)"),
    ("G95 F0.2\nM3 S500 T2\nG0 X20 Z2\nG1 Z-9\n", "jnc-t01", "T2 finishing insert 35°"),
])  # fmt: skip
def test_without_a_tool_word_the_insert_that_is_drawn_is_named(browser, tmp_path, program, control, said):
    page = browser.new_page()
    page.goto(mnclab.run(program, control).save(tmp_path / "part.html").as_uri())
    page.evaluate(BEGUN)
    page.keyboard.press("End")
    assert page.locator("#tool").inner_text() == said
    page.close()
