"""The playing stops where a person says: at blocks, when a question becomes true, at tool changes, alarms and collisions."""

import math
import re
from pathlib import Path

import pytest
from tools.pages import BEGUN

import mnclab
from mnclab import Setup, Tool

SAMPLES = Path(__file__).parents[2] / "data" / "programs"
MILLED = """N10 G17 G90 G54
N20 T1 S1200 M3
N30 G0 X-20
N35 Y-10
N40 G1 Z-2 F150
N50 X30 F300
N60 G3 X40 Y0 R10
N65 G2 X40 Y0 Z-4 I12 J5
N70 G1 Y30
N80 G91 X-10
N90 G90 G0 Z20
N100 T2 S800 M3
N110 G83 X10 Y10 Z-8 R2 K4 F100
N120 G80
"""
TURNED = "G97 S300 M3\nG96 S150\nG0 X12\nZ4\nG95 F0.2\nG1 Z-20\nX30 Z-40\n"
REPEATED = """BEGIN PGM R MM
TOOL CALL 1 Z S2000
L X+0 Y+0 Z+5 R0 FMAX M3
LBL 1
L IX+10 R0 F500
L IY+5
CALL LBL 1 REP2
END PGM R MM
"""
QUESTIONS = {
    MILLED: (
        "z < -1", "z < -3 and x > 20", "x + y > 20", "0 < x < 5", "not tool == 1", "tool == 2 and z < 0", "feed > 200",
        "feed >= 300 or z == -2", "line == 12", "line > 7", "x^2 + y^2 > 900", "abs(y) > 3", "2 * x - y < 7.5 and z <= -2",
        "spindle > 900", "d > 60", "sqrt(x^2 + y^2) > 25", "y > 0.5*x + 3 or sin(x) > 0.7", "-x > -10", "x/2 + 1 >= 3",
        "3 * (x - y) >= z - 1 and not (x < 1 or y < 2)", "x / (x - 5) > 3", "radius > 0", "z > 1000",
    ),
    TURNED: ("x < 11", "spindle > 1500", "spindle >= 1000 and feed > 100", "feed < 250", "d > 40 and z < -30"),
}  # fmt: skip
ASK = """text => {
    const {stops, run} = window.player, question = stops.asked.question(text);
    return stops.asked.moments(question).map(({item, share}) => {
        const row = run.itemRow[item];
        return [run.itemStep[item], row < 0 ? run.path.vertex(run.before[item]) : run.path.point(row, share)];
    });
}"""
STOPPED = "() => !window.player.playing"
HERE = "() => { const p = window.player; return {step: p.step, ...p.now(), done: p.place.done}; }"


@pytest.fixture
def opened(browser, tmp_path):
    """opened(run) opens its page in a browser that is offline, at a hundred times the speed; faults of the page fail the test."""
    faults, pages = [], []

    def opened(run, **size):
        page = browser.new_page(viewport={"width": 1181, "height": 558} | size)
        pages.append(page)
        page.on("console", lambda message: "ReadPixels" in message.text or faults.append(message.text))
        page.on("pageerror", lambda error: faults.append(str(error)))
        page.goto(run.save(tmp_path / "part.html").as_uri())
        page.evaluate(BEGUN)
        page.get_by_role("combobox", name="Speed").select_option("100")
        return page

    yield opened
    for page in pages:
        page.close()
    assert faults == []


def played(page):
    """What is said where the playing stops next."""
    page.get_by_role("button", name="play", exact=True).click()
    page.wait_for_function(STOPPED)
    return page.get_by_role("status").inner_text()


def fill(page, name, text):
    if page.locator("#stopping").is_hidden():
        page.get_by_role("button", name="Breakpoints").click()
    page.get_by_role("textbox", name=name).fill(text)
    page.keyboard.press("Enter")


@pytest.mark.parametrize(("text", "control"), [(MILLED, "mnc"), (TURNED, "jnc-t01"), ("pockets.h", None), ("steps.h", None)])
def test_the_page_finds_the_moments_that_the_run_finds(opened, text, control):
    """Of one axis at a time rapids are straight, so that both speak of the same way; the page counts in thousandths or finer."""
    run = mnclab.run(text if control else SAMPLES / "tnc-620" / text, control)
    page, asked = opened(run), QUESTIONS.get(text, [q for q in QUESTIONS[MILLED] if "abs" not in q])
    for question in asked:
        wanted, found = run.when(question), page.evaluate(ASK, question)
        assert [step for step, _ in found] == [moment.step for moment in wanted], question
        for (_, point), moment in zip(found, wanted, strict=True):
            assert point == pytest.approx(moment.point, abs=5e-6), question


@pytest.mark.parametrize("question", [
    "z <", "z", "1 + 2", "(z < 1", "z < -1 and", "nothing < 3", "z < 1 & x > 2", "and", "not 3", "sin x < 1", "z < 1 2",
    "x == y == (z < 1)",
])  # fmt: skip
def test_what_the_run_refuses_the_page_refuses(opened, question):
    run = mnclab.run(MILLED, "mnc")
    with pytest.raises(mnclab.Alarm):
        run.when(question)
    page = opened(run)
    fill(page, "Stop when", question)
    assert page.locator("#when").get_attribute("aria-invalid") == "true"
    assert re.search("expected|nothing of the name", page.locator("#when-said").inner_text())
    assert "finished" not in played(page) and page.evaluate(HERE)["t"] == page.evaluate("window.player.run.time")


def test_the_playing_stops_before_the_block_whose_number_was_clicked(opened):
    page = opened(mnclab.run(MILLED, "mnc"))
    number = page.locator("#line-6 span")
    number.click()
    assert page.get_by_role("option", name="line 6: N50 X30 F300; stops here").count() == 1
    said = "stopped: line 6, block N50; line 6: N50 X30 F300; tool at X \N{MINUS SIGN}20.000, Y \N{MINUS SIGN}10.000, Z"
    assert played(page).startswith(said)
    assert page.locator("#doing").inner_text() == "stopped: line 6, block N50"
    assert page.locator(".line.now code").all_inner_texts() == ["N50 X30 F300"]
    assert not played(page).startswith("stopped")  # it goes on, to the end
    page.get_by_role("button", name="play backwards").click()
    page.wait_for_function(STOPPED)
    assert page.get_by_role("status").inner_text().startswith("stopped: line 6, block N50")
    number.click()
    page.keyboard.press("Home")
    assert not played(page).startswith("stopped")


def test_a_stop_in_a_loop_stops_each_time(opened):
    page = opened(mnclab.run(REPEATED, "tnc-620"))
    page.locator("#line-6 span").click()
    for times in (1, 2, 3):
        assert played(page).startswith("stopped: line 6")
        assert page.evaluate(HERE)["point"] == pytest.approx([10 * times, 5 * (times - 1), 5])


def test_it_stops_where_a_question_becomes_true(opened):
    run = mnclab.run(MILLED, "mnc")
    page = opened(run)
    fill(page, "Stop when", "Z < -3 and x > 20")
    wanted = run.when("z < -3 and x > 20")
    assert page.locator("#when-said").inner_text() == f"becomes true {'once' if len(wanted) == 1 else f'{len(wanted)} times'}"
    page.keyboard.press("Escape")
    page.get_by_role("slider", name="time").focus()
    for moment in wanted:
        assert played(page).startswith("stopped: Z < -3 and x > 20; ")
        here = page.evaluate(HERE)
        assert here["point"] == pytest.approx(moment.point, abs=1e-3) and here["step"] == moment.step
    page.keyboard.press("Home")
    page.keyboard.press("n")
    assert page.evaluate(HERE)["point"] == pytest.approx(wanted[0].point, abs=1e-3)
    page.keyboard.press("Shift+N")
    assert page.get_by_role("status").inner_text() == "no stop before"


def test_a_tool_change_an_alarm_and_a_collision_stop_it(opened):
    tools = {1: Tool(radius=5), 2: Tool(radius=3)}
    text = "G17 G90 G54 S2500 M3 F300\nT1 G0 X20 Y35 Z5\nG1 Z-4\nX60\nG0 Y12\nG0 Z50\nT2\nG1 Z40\nG3 Z30 I10\n"
    run = mnclab.run(text, "mnc", Setup(tools=tools, stock=((0, 0, -40), (80, 50, 0))))
    (crash,) = run.collisions()
    assert {alarm.severity for alarm in run.alarms} == {"warning"}
    page = opened(run)
    page.get_by_role("button", name="Breakpoints").click()
    for name in ("tool changes", "alarms", "collisions"):
        page.get_by_role("checkbox", name=name).check()
    assert played(page).startswith("stopped: T1") and page.evaluate(HERE)["step"] == 1
    assert played(page).startswith(f"stopped: {crash.message}")
    here = page.evaluate(HERE)
    assert here["row"] == crash.row and math.dist(here["point"], crash.place) < 5 + 0.1  # within the tool
    assert played(page).startswith("stopped: T2")
    assert played(page).startswith(f"stopped: {run.alarms[-1].message}") and page.evaluate(HERE)["step"] == 8


def test_it_plays_up_to_a_line(opened):
    page = opened(mnclab.run(MILLED, "mnc"))
    page.locator("#line-9 code").click(modifiers=["Shift"])
    page.wait_for_function(STOPPED)
    said = "stopped: line 9, block N70; line 9: N70 G1 Y30; tool at X 40.000, Y 0.000"
    assert page.get_by_role("status").inner_text().startswith(said)
    page.locator("#line-5 code").click(modifiers=["Shift"])  # it lies behind: from the start
    page.wait_for_function(STOPPED)
    assert page.evaluate(HERE)["point"] == pytest.approx([-20, -10, 0])
    assert not played(page).startswith("stopped")  # that was for once


def test_values_are_watched(opened):
    page = opened(mnclab.run(SAMPLES / "tnc-620" / "steps.h"))
    fill(page, "Watch", "Q2, z - 1, tool == 2, coolant, nothing")
    page.keyboard.press("Escape")

    def watched():
        names, values = (page.locator(f"#watched {part}").all_inner_texts() for part in ("dt", "dd"))
        return dict(zip(names, values, strict=True))

    assert watched()["nothing"] == "there is nothing of the name 'nothing' in this run"
    run = mnclab.run(SAMPLES / "tnc-620" / "steps.h")
    for step in (5, len(run.steps.block) - 1):
        page.evaluate("step => window.player.go(window.player.afterStep(step))", step)
        moment = run.at(step=step)
        assert float(watched()["Q2"].replace("\N{MINUS SIGN}", "-")) == moment.state["Q2"]
        assert float(watched()["z - 1"].replace("\N{MINUS SIGN}", "-")) == pytest.approx(moment.point[2] - 1)
        assert watched()["coolant"] == moment.state["coolant"] and watched()["tool == 2"] == "false"


@pytest.mark.parametrize(("program", "control", "when", "watched"), [
    (SAMPLES / "tnc-620" / "steps.h", None, "z < -5 and tool == 2", "Q1, z, feed, x - Q1"),
    (SAMPLES / "g43" / "bolt_circle.nc", None, "z < -5 and tool == 2", "#101, z, feed, x - #101"),
    (MILLED, "mnc", "z < -5 and tool == 2", "z, feed"),
    (TURNED, "jnc-t01", "d < 20 and z < -5", "d, feed"),
])  # fmt: skip
def test_the_examples_are_words_of_the_run(opened, program, control, when, watched):
    page = opened(mnclab.run(program, control))
    assert [page.locator(name).get_attribute("placeholder") for name in ("#when", "#watch")] == [when, watched]
    fill(page, "Watch", watched)
    assert not any("there is nothing" in told for told in page.locator("#watched dd").all_inner_texts())


def test_x_of_a_lathe_is_called_a_radius(opened):
    page = opened(mnclab.run(TURNED, "jnc-t01", Setup(settings={"diameter": True})))
    fill(page, "Watch", "X, d")
    fill(page, "Stop when", "x < 11")
    assert page.locator("#when-said").inner_text().startswith("x (radius) < 11 becomes true")
    page.locator("#line-7 code").click()
    assert page.locator("#watched dt").all_inner_texts() == ["X (radius)", "d"]
    assert page.locator("#watched dd").all_inner_texts() == ["15", "30"]


@pytest.mark.parametrize("width", [1366, 1920])
def test_a_stop_moves_no_button(opened, width):
    page = opened(mnclab.run(MILLED, "mnc"), width=width, height=768)
    places = "() => [...document.querySelectorAll('header button')].map(each => each.getBoundingClientRect().x)"
    before = page.evaluate(places)
    page.locator("#line-6 span").click()
    assert page.get_by_role("button", name="Breakpoints (1)").count() == 1 and page.evaluate(places) == before


def test_a_rapid_has_no_number_of_a_feed(opened):
    page = opened(mnclab.run("N1 G17 G90 G54 T1 S3000 M3\nN2 G0 X10\nN3 G1 X20 F300\n", "mnc"))
    fill(page, "Watch", "feed, feed / 2")
    said = []
    for line in (2, 3):
        page.locator(f"#line-{line} code").click()
        said.append(page.locator("#watched dd").all_inner_texts())
    assert said == [["rapid", "rapid"], ["300", "150"]]


def test_the_open_panel_hides_no_word_and_escape_closes_it(opened):
    page = opened(mnclab.run(MILLED, "mnc"))
    page.get_by_role("button", name="Breakpoints").click()
    page.keyboard.press("Shift+Tab")  # out of the field
    page.keyboard.press("n")
    assert page.locator("#doing").inner_text() == "no stop from here on"
    panel, said = (page.locator(name).bounding_box() for name in ("#stopping", "#doing"))
    assert said["x"] + said["width"] < panel["x"]
    assert len({page.get_by_label(each).bounding_box()["y"] for each in ("tool changes", "alarms", "collisions")}) == 1
    page.get_by_label("Stop when").fill("z < -1")
    page.keyboard.press("Escape")
    assert page.locator("#stopping").is_hidden() and page.evaluate("document.activeElement.id") == "picture"
    assert page.evaluate("window.player.stops.moments.length") > 0  # what was typed counts


def test_stops_are_listed_and_taken_away(opened):
    page = opened(mnclab.run(MILLED, "mnc"), width=700, height=640)
    page.get_by_role("option", name="line 4:").click()
    page.keyboard.press("b")
    page.get_by_role("button", name="Breakpoints (1)").click()
    page.get_by_role("button", name="line 4, block N35: Y-10", exact=True).click()
    assert page.evaluate(HERE)["step"] == 3
    page.get_by_role("button", name="no stop at line 4, block N35").click()
    assert page.locator("#breaks li").count() == 0 and page.locator(".line.stops").count() == 0
    assert page.get_by_role("button", name="Breakpoints", exact=True).count() == 1


@pytest.mark.parametrize(("text", "control", "heads"), [
    ("0 BEGIN PGM A MM\n1 L X+1 FMAX\n2 END PGM A MM\n", "tnc-620", True), ("G90\nG0 X1\n", "mnc", False),
])  # fmt: skip
def test_numbers_of_lines_and_of_blocks_are_told_apart(opened, text, control, heads):
    page = opened(mnclab.run(text, control))
    assert page.locator("#heads").is_visible() == heads
    assert page.locator("#line-2 span").get_attribute("title").startswith("line 2, block 1: " if heads else "line 2: ")
