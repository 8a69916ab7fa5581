"""What colours say in the player: feed, tool and engagement of the cuts with units; words as in the editor."""

import math
import re
from pathlib import Path

import numpy as np
import pytest
from tools.pages import BEGUN

import mnclab
from mnclab import Setup, Tool

SAMPLES = Path(__file__).parents[2] / "data" / "programs"
LEGEND = "#legend"
QUIET = re.compile("ReadPixels|readback")  # of who reads a pixel
ENGAGED = "() => [...window.player.part.carving.engaged]"
SCOUTED = "() => window.player.part.carving.scouted"
#: How many pixels of the picture have the colour that a class has.
SHADED = """name => {
    const {picture} = window.player, {canvas} = picture, pen = document.createElement("canvas").getContext("2d");
    pen.fillStyle = picture.colours[name];
    pen.fillRect(0, 0, 1, 1);
    const [r, g, b] = pen.getImageData(0, 0, 1, 1).data;
    const {data} = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
    let n = 0;
    for (let k = 0; k < data.length; k += 4)
        n += data[k + 3] > 250 && Math.abs(data[k] - r) + Math.abs(data[k + 1] - g) + Math.abs(data[k + 2] - b) < 12;
    return n;
}"""


@pytest.fixture
def opened(browser, tmp_path):
    """opened(run) opens its page at its end, from above; faults of the page fail the test."""
    faults, pages = [], []

    def opened(run):
        page = browser.new_page(viewport={"width": 1181, "height": 558})
        pages.append(page)
        page.on("console", lambda message: QUIET.search(message.text) or faults.append(message.text))
        page.on("pageerror", lambda error: faults.append(str(error)))
        page.goto(run.save(tmp_path / "part.html").as_uri())
        page.evaluate(BEGUN)
        page.keyboard.press("1")
        page.keyboard.press("End")
        return page

    yield opened
    for page in pages:
        page.close()
    assert faults == []


def coloured(page, by):
    """The legend, line by line, once the cuts are coloured by something."""
    page.get_by_role("combobox", name="Colour").select_option(by)
    page.wait_for_function("by => window.player.shades.name === by && !window.player.waiting", arg=by)
    return page.locator(LEGEND).inner_text().splitlines()


FEEDS = "G17 G90 G54 T1 S900 M3\nG0 X0 Y0 Z5\nG1 Z-2 F100\nX60 F300\nY40 F600\nT2 S500 M3\nG1 X0\nG0 Z5\n"


def test_feeds_and_tools_have_their_colours_and_units(opened):
    page = opened(mnclab.run(FEEDS, "mnc", Setup(tools={1: Tool(radius=4, name="mill 8"), 2: Tool(radius=2)})))
    assert page.locator(LEGEND).inner_text().splitlines() == ["cut", "rapid"]
    assert coloured(page, "feed") == ["feed, mm/min", "100", "300", "600", "rapid"]
    assert page.evaluate("window.player.shades.classes.map(([name]) => name)")[:3] == ["c0", "c3", "c5"]
    assert min(page.evaluate(SHADED, name) for name in ("c3", "c5")) > 200 and page.evaluate(SHADED, "cut") == 0
    assert coloured(page, "tool") == ["tool", "T1 mill 8 R4", "T2 R2", "rapid"]
    page.get_by_role("combobox", name="Colour").select_option("kind")
    page.wait_for_function(f"() => ({SHADED})('cut') > 200")


@pytest.mark.parametrize(("text", "control", "said"), [
    ("G20 G17 G90 S100 M3\nG0 X0 Y1\nG1 X2 F10\n", "g43", ["feed, in/min", "10", "rapid"]),
    ("G97 S300 M3\nG0 X12 Z4\nG95 F0.2\nG1 Z-20\n", "jnc-t01", ["feed, mm/rev", "0.2", "rapid"]),
])  # fmt: skip
def test_feeds_count_in_the_unit_of_the_program(opened, text, control, said):
    assert coloured(opened(mnclab.run(text, control)), "feed") == said


def test_many_feeds_are_ranges(opened):
    text = "G17 G90 G54 T1 S900 M3\n" + "".join(f"G1 X{k % 2 * 9} Y{k} F{100 + 10 * k}\n" for k in range(1, 25))
    page = opened(mnclab.run(text, "mnc"))
    assert coloured(page, "feed")[1:7] == [f"{110 + 40 * k} to {140 + 40 * k}" for k in range(6)]


def test_the_engagement_is_that_of_the_width_of_cut(opened):
    """A full slot is cut with half of the rim, 180 degrees; a straight cut a_e wide with arccos(1 - a_e / R); air with none."""
    radius, widths = 8.0, (3.0, 8.0, 12.0)
    text = "G17 G90 G54 T1 S900 M3 F300\nG0 X-20 Y-50 Z5\nG0 Z-4\n"
    y = 0.0
    for width in widths:  # from the lower edge of the blank upwards, along X there and back at a rapid
        y += width
        text += f"G1 Y{y - radius:g}\nG1 X120\nG0 Z5\nX-20\nZ-4\n"
    text += "G1 Y70\nX120\nG1 Y140\nX-20\n"  # a slot, then air
    run = mnclab.run(text, "mnc", Setup(tools={1: Tool(radius=radius)}, stock=((0, 0, -20), (100, 100, 0))))
    page = opened(run)
    page.wait_for_function(SCOUTED)
    engaged, path = np.array(page.evaluate(ENGAGED)), run.toolpath
    along = [k for k in np.flatnonzero(path.kind == mnclab.Kind.LINE) if abs(path.end[k, 0] - path.start[k, 0]) > 100]
    wanted = [math.degrees(math.acos(1 - width / radius)) for width in widths] + [180.0, 0.0]
    assert np.abs(engaged[along] - wanted).max() <= 6.0  # two of the sixty parts in which the rim is looked at
    assert coloured(page, "engagement") == [
        "engagement at most, degrees", "to 60", "to 90", "to 120", "to 180", "none", "rapid",
    ]  # fmt: skip


def test_without_a_blank_no_engagement_is_offered(opened):
    page = opened(mnclab.run(FEEDS, "mnc"))
    assert page.locator("#colour option").all_inner_texts() == ["kind", "feed", "tool"]
    for name in ("feed", "tool", "kind"):
        page.keyboard.press("c")
        assert page.locator("#colour").input_value() == name


KLARTEXT = "0 BEGIN PGM A MM\n1 ; remark\n2 TOOL CALL 2 Z S900\n3 Q5 = 7\n4 L X+Q5 Y-3.5 R0 F500 M3\n5 END PGM A MM\n"
DIN = "%A G71 *\nN10 T1 G17 S1000 *\nN20 G00 X+0 Y+5 Z+5 M3 *\nN99999999 %A G71 *\n"


@pytest.mark.parametrize(("text", "control", "pieces"), [
    (KLARTEXT, "tnc-620", {"TOOL CALL": "keyword", "; remark": "comment", "Q5": "variableName", "-3.5": "number"}),
    (DIN, "tnc-620", {"G00": "keyword", "N20": "labelName", "X": "propertyName", "+5": "number", "%A": "meta"}),
    ("G90 G0 X1 // far\nG1 X4 F100\n", "mnc", {"G90": "keyword", "// far": "comment", "F": "typeName", "100": "number"}),
    ("G00 X42 ' remark\n", "jnc-t01", {"G00": "keyword", "' remark": "comment"}),
])  # fmt: skip
def test_the_words_have_the_colours_of_the_editor(opened, text, control, pieces):
    page = opened(mnclab.run(text, control))
    found = dict(page.evaluate("[...document.querySelectorAll('.line i')].map(each => [each.textContent, each.className])"))
    assert {piece: found.get(piece) for piece in pieces} == pieces
    assert page.locator(".line code").all_inner_texts()[: text.count("\n")] == text.splitlines()  # and nothing else is changed
