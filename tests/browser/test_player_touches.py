"""The player shows the part that a probe meets, and its touches as they come."""

import pytest
from toy_probing import toy_run

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
    page.wait_for_function("window.player")
    yield page, run
    page.close()
    assert faults == []


def test_touches_appear_one_after_the_other(page):
    page, run = page
    rows = [touch["row"] for touch in page.evaluate("() => window.player.picture.touches.all")]
    assert page.evaluate(WRITTEN, rows[0]) == []
    assert page.evaluate(WRITTEN, rows[0] + 1) == ["1   X 62.000"]
    assert len(page.evaluate(WRITTEN, len(run.toolpath))) == len(run.touches) == 5


def test_the_part_is_the_map(page):
    page, _ = page
    found = [page.evaluate(HEIGHT, place) for place in ([10, 10], [50, 30], [90, 50])]
    assert found == pytest.approx([0, -10, 0], abs=1e-3)
