"""The player shows the part that a probe meets, and its touches as they come."""

import math

import pytest
from tools.pages import BEGUN
from tools.toy_probing import toy_run

import mnclab
from mnclab.workpiece.part import box, hole

PART = box((0, 0, -20), (100, 60, 0)) - hole((50, 30, 0), 24, 10)
#: Texts that are written at a place of the run: those of the touches behind it.
WRITTEN = """rows => {
    const texts = [], pen = document.createElement("canvas").getContext("2d"), own = pen.fillText.bind(pen);
    pen.fillText = (text, ...rest) => { texts.push(text); own(text, ...rest); };
    const {touches, camera, colours} = window.player.picture;
    touches.draw(pen, camera, colours, rows);
    return texts;
}"""
HEIGHT = """([x, y]) => {
    const {carving} = window.player.part, {grid} = carving;
    return carving.map.at(grid.last(0, x), grid.last(1, y)).height;
}"""


@pytest.fixture
def page(browser, tmp_path):
    faults, run = [], toy_run("M1 X50 Y30 D24 Z-5\nM4 X0 Y30 Z-5", PART)
    page = browser.new_page(viewport={"width": 1366, "height": 768})
    page.on("console", lambda message: "ReadPixels" in message.text or faults.append(message.text))
    page.on("pageerror", lambda error: faults.append(str(error)))
    page.goto(run.save(tmp_path / "part.html").as_uri())
    page.evaluate(BEGUN)
    yield page, run
    page.close()
    assert faults == []


def test_touches_appear_one_after_the_other(page):
    page, run = page
    rows = [touch["row"] for touch in page.evaluate("() => window.player.picture.touches.all")]
    assert page.evaluate(WRITTEN, rows[0]) == []
    assert page.evaluate(WRITTEN, rows[0] + 1) == ["1   X 62.000"]
    assert len(page.evaluate(WRITTEN, len(run.toolpath))) == len(run.touches) == 5


def test_what_a_probe_does_at_feed_is_no_cut(browser, tmp_path):
    """G400 of the MNC goes from touch to touch at the fast feed of the probe table; the mill that follows cuts."""
    tools = {1: mnclab.Tool(5, 100, kind="mill"), 20: mnclab.Tool(3, 150, kind="probe")}
    probe = mnclab.Probe(clearance=2, reach=10, rapid=3000)
    setup = mnclab.Setup(tools=tools, probe=probe, part=box((0, 0, -20), (80, 60, 0)), start=(-20, -20, 50))
    run = mnclab.run("G54 G17 G90\nT20\nG0 Z50\nG400 X20 Y0 U60 V0 L2 K1 Z-5 H20\nT1 S900 M3\nG1 Y50 F500\n", "mnc", setup)
    assert run.ok and (run.toolpath.kind[run.toolpath.tool == 20] == mnclab.Kind.LINE).any()
    page = browser.new_page()
    page.goto(run.save(tmp_path / "touch.html").as_uri())
    page.evaluate(BEGUN)
    drawn = page.evaluate("() => [...player.picture.strokes.row].filter((_, k) => player.picture.strokes.kind[k] === CUTS)")
    assert drawn and (run.toolpath.tool[drawn] == 1).all()
    assert page.locator("#legend").inner_text().split() == ["cut", "rapid", "probing"]
    page.close()


def test_the_part_is_the_map(page):
    page, _ = page
    found = [page.evaluate(HEIGHT, place) for place in ([10, 10], [50, 30], [90, 50])]
    assert found == pytest.approx([0, -10, 0], abs=1e-3)


def test_the_wall_of_a_bore_is_round(page):
    """Between cells of half a millimetre it stands where the part has it."""
    page, _ = page
    found = page.evaluate("""() => {
        const {map, grid} = window.player.part.carving, found = [];
        for (let j = 0; j < grid.ny; j++)
            for (let i = 0; i < grid.nx; i++) {
                const [x, y] = [grid.x(i), grid.y(j)], share = map.walled(i, j, 1, 0);
                if (share && Math.hypot(x - 50, y - 30) < 14) found.push(Math.hypot(x + share * grid.step - 50, y - 30));
            }
        return found;
    }""")
    assert len(found) > 60 and found == pytest.approx([12] * len(found), abs=0.01)


def test_metal_hides_a_touch(page):
    page, _ = page
    page.keyboard.press("End")
    seen = page.evaluate("""() => ["top", "front"].map(name => {
        const {player} = window;
        player.view(name);
        player.draw();
        return player.picture.touches.all.filter(({from}) => player.part.sees(from)).map(({text}) => text[0]).join("");
    })""")
    assert seen == ["12345", "5"]


def test_letters_of_the_axes_cover_no_number(browser, tmp_path):
    """The wall X0 is touched at Z-5: at 1.5 pixels a mm the number beside the touch would lie on the letter X, 43 pixels from
    zero."""
    page = browser.new_page(viewport={"width": 1000, "height": 700})
    page.goto(toy_run("M4 X0 Y30 Z-5", PART).save(tmp_path / "part.html").as_uri())
    page.evaluate(BEGUN)
    texts = page.evaluate("""() => {
        const found = [], write = CanvasRenderingContext2D.prototype.fillText, {player} = window;
        player.go(player.afterItem(player.run.items - 1));
        player.view("front");
        player.change(camera => camera.zoom = 1.5);
        CanvasRenderingContext2D.prototype.fillText = function (text, x, y) {
            const wide = this.measureText(text).width, left = x - (this.textAlign === "center" ? wide / 2 : 0);
            found.push([text, left, y - 5, left + wide, y + 5]);
        };
        player.draw();
        CanvasRenderingContext2D.prototype.fillText = write;
        return found;
    }""")
    (letter,) = [each for each in texts if each[0] == "X"]
    (number,) = [each for each in texts if each[0].startswith("1   X")]
    apart = letter[3] <= number[1] or number[3] <= letter[1] or letter[4] <= number[2] or number[4] <= letter[2]
    assert apart, (letter, number)
    page.close()


@pytest.mark.parametrize("turned", [[0, 28], [0, 60], [90, 28], [30, 28], [45, 0], [12, 20]])
def test_letters_of_the_axes_stand_apart(page, turned):
    """Also where one axis covers another: from the front and from above, Y and Z go the same way up."""
    page, _ = page
    letters = page.evaluate("""([yaw, pitch]) => {
        const {player} = window, {picture} = player, pen = picture.canvas.getContext("2d");
        player.change(camera => { Object.assign(camera, {yaw, pitch}); camera.update(); });
        return picture.triad(pen).map(([left, top, right, bottom]) => [(left + right) / 2, (top + bottom) / 2]);
    }""", turned)  # fmt: skip
    assert len(letters) >= 2
    apart = [math.dist(a, b) for k, a in enumerate(letters) for b in letters[k + 1 :]]
    assert min(apart) > 10
