"""The player of runs that call other programs, turn rotary axes, change parameters, and of tools of every kind."""

import math
import re
from pathlib import Path

import numpy as np
import pytest
from tools.pages import BEGUN

import mnclab
from mnclab import Setup, Tool

MAIN = """0 BEGIN PGM MAIN MM
1 BLK FORM 0.1 Z X-50 Y-40 Z-20
2 BLK FORM 0.2 X+50 Y+40 Z+0
3 TOOL CALL 1 Z S3000 F500
4 L X+0 Y+0 Z+50 R0 FMAX M3
5 Q5 = 20.5
6 L X+20 A+30 C-90 F1000
7 CALL PGM PART.H
8 L C+0
9 CALL PGM PART.H
10 L Z+60 FMAX
11 END PGM MAIN MM
"""
PART = """0 BEGIN PGM PART MM
1 Q5 = Q5 + 1
2 L IY+10
3 END PGM PART MM
"""
MINUS = "\N{MINUS SIGN}"


def run_main(part=PART):
    return mnclab.run(MAIN, "tnc-620", Setup(files={"PART.H": part}))


@pytest.fixture
def opened(browser, tmp_path):
    """opened(run) opens the saved page without a network; a fault of the page fails the test."""
    faults, pages = [], []

    def open_page(run):
        page = browser.new_page(viewport={"width": 1000, "height": 700})
        pages.append(page)
        page.route(re.compile("^(?!file:)"), lambda route: faults.append(route.request.url) or route.abort())
        page.on("pageerror", lambda error: faults.append(str(error)))
        page.goto(run.save(tmp_path / "part.html").as_uri())
        page.evaluate(BEGUN)
        return page

    yield open_page
    for page in pages:
        page.close()
    assert faults == []


def marked(page):
    return page.locator(".line.now code")


def wait_for_text(locator, text):
    """Wait until an element says a text, all of it."""
    locator.filter(has_text=re.compile(rf"^\s*{re.escape(text)}\s*$")).wait_for(timeout=20_000)


def test_the_text_follows_into_called_programs_and_back(opened):
    run = run_main()
    page = opened(run)
    choice = page.get_by_role("combobox", name="program shown")
    assert choice.locator("option").all_inner_texts() == ["program", "PART.H"]
    names = [program.text.splitlines() for program in run.programs]
    for step, program in enumerate(run.steps.program):
        text = names[program][int(run.lines()[step]) - 1]
        page.keyboard.press("ArrowRight")
        wait_for_text(marked(page), text)
        assert choice.input_value() == str(program)
    page.keyboard.press("Home")
    page.get_by_role("option", name="line 1: 0 BEGIN PGM MAIN").wait_for()


def test_another_program_can_be_looked_at_and_gone_to(opened):
    run = run_main()
    page = opened(run)
    page.get_by_role("combobox", name="program shown").select_option("PART.H")
    line = page.get_by_role("option", name="line 3: 2 L IY+10")
    for times in (1, 2):
        line.click()
        step = run.at(line=3, pass_=times, program=1).step
        page.wait_for_function(f"() => window.player.step === {step}")
        wait_for_text(page.locator("#tool-Y"), f"{10 * times}.000")
        page.get_by_role("status").filter(has_text="line 3 of PART.H: 2 L IY+10; tool at").wait_for(state="attached")


def test_an_alarm_in_a_called_program_leads_there(opened):
    page = opened(run_main(PART.replace("IY+10", "IY+10 F-1")))
    page.get_by_role("button", name="alarm in line 3 of PART.H:").click()
    page.wait_for_function("() => window.player.listing.program === 1")
    wait_for_text(page.locator(".line.alarm code"), "2 L IY+10 F-1")


def test_a_changed_parameter_is_marked_with_its_values(opened):
    run = run_main()
    page = opened(run)
    for times, text in ((1, "20.5 → 21.5"), (2, "21.5 → 22.5")):
        page.evaluate("step => window.player.go(window.player.afterStep(step))", run.at(2, times, program=1).step)
        wait_for_text(page.locator("#modal .changed dd"), text)
        wait_for_text(page.locator("#modal .changed dt"), "Q5")


def test_rotary_axes_arrive_with_the_tip(opened):
    run = run_main()
    page = opened(run)
    step = run.at(line=7).step  # from X0 A0 C0 to X20 A30 C-90: at X5 a quarter of each way
    half = f"""() => {{
        const p = window.player, i = p.run.first[{step}];
        let low = p.run.begin[i], high = p.run.end[i];
        for (let k = 0; k < 60; k++) {{
            const t = (low + high) / 2;
            if (p.run.tool(i, t).point[0] < 5) low = t; else high = t;
        }}
        p.go({{item: i, t: low, done: false}});
        return p.now().angles;
    }}"""
    assert page.evaluate(half) == pytest.approx([7.5, 0, -22.5], abs=1e-3)
    wait_for_text(page.locator("#rotary"), f"A 7.5°  C {MINUS}22.5°")
    page.evaluate(f"() => window.player.go(window.player.afterStep({step}))")
    wait_for_text(page.locator("#rotary"), f"A 30°  C {MINUS}90°")
    wait_for_text(page.locator("#modal .changed dt"), "rotary")
    alone = run.at(line=9).step  # C alone: it turns in time
    turning = f"""() => {{
        const p = window.player, i = p.run.first[{alone}];
        return [0, 0.25, 1].map(s => {{
            const t = p.run.begin[i] + s * (p.run.end[i] - p.run.begin[i]);
            return p.run.angles(p.run.itemRow[i], p.run.tool(i, t).share)[2];
        }});
    }}"""
    assert page.evaluate(turning) == pytest.approx([-90, -67.5, 0], abs=1e-3)


#: Waits until the picture has a tool in it.
DRAWN = """() => new Promise(done => {
    const look = () => window.player.picture.shown?.at?.tool ? done() : requestAnimationFrame(look);
    look();
})"""


def test_a_tool_stands_square_on_a_drum(opened):
    """The run starts at a place that nobody has said, within the drum: no line is drawn from there."""
    run = mnclab.run(Path(__file__).parents[2] / "data" / "programs" / "tnc-620" / "drum_cam.h")
    page = opened(run)
    assert page.evaluate("() => [...window.player.picture.strokes.kind.slice(0, 3)]")[:2] == [0, 0]
    page.evaluate("() => window.player.go(window.player.atTime(0.4 * window.player.run.time))")
    page.evaluate(DRAWN)
    ends = page.evaluate("""() => {
        const {player} = window, {picture} = player, {point: tip, angles} = player.now();
        const up = tip.map((v, k) => v + (k === 2 ? 9 : 0));
        const away = [0, ...tip.slice(1)].map((v, k, all) => tip[k] + 9 * v / Math.hypot(...all));
        return [picture.beside(tip, angles)(up), picture.camera.project(away), picture.shown.at.tool.number, angles[0]];
    }""")  # fmt: skip
    assert ends[0] == pytest.approx(ends[1], abs=0.5) and ends[2:] == [1, pytest.approx(161.2, abs=0.1)]
    assert "rotary" not in page.locator("#modal dt").all_inner_texts()
    page.keyboard.press("End")
    assert "M3 → M5" in page.locator("#modal .changed dd").all_inner_texts()


def test_without_rotary_axes_and_called_programs_nothing_speaks_of_them(opened):
    page = opened(mnclab.run("G90 G54\nG0 X5\n", "mnc"))
    assert page.locator("#angles").is_hidden() and page.locator("#program").is_hidden()


def test_the_blank_is_in_the_picture(opened):
    page = opened(run_main())
    assert page.evaluate("() => window.player.run.stock.length") == 12
    box = page.evaluate("() => window.player.picture.box")
    assert box == [[-50, -40, -20], [50, 40, 50]]  # the rapid to Z60 runs out of it


#: kind of tool -> radius of its body at heights above the tip, from the drawings of such tools.
TOOLS = {
    "end mill": (Tool(radius=5, kind="mill"), {0: 5, 8: 5}),
    "ball": (Tool(radius=5, corner=5, kind="mill"), {0: 0, 5: 5, 2.5: 4.3301270}),  # 5² - 2.5² = 4.33²
    "bull": (Tool(radius=5, corner=2, kind="mill"), {0: 3, 2: 5}),
    "drill": (Tool(radius=4, angle=90, kind="drill"), {0: 0, 2: 2, 4: 4}),  # 45° on either side
    "tap": (Tool(radius=3, pitch=1, kind="tap"), {0: 3, 6: 3}),
    "thread mill": (Tool(radius=6, pitch=1.5, kind="thread mill"), {0: 6, 6: 6}),
    "probe": (Tool(radius=2, length=80, kind="probe"), {0: 0, 2: 2, 3: 1.7320508}),  # a ball: 2² - 1² = 1.73²
}


@pytest.mark.parametrize("name", TOOLS)
def test_a_tool_has_the_shape_of_its_kind(opened, name):
    tool, radii = TOOLS[name]
    text = "BEGIN PGM A MM\nTOOL CALL 1 Z S100\nL X+10 Y+0 Z+5 FMAX\nEND PGM A MM\n"
    page = opened(mnclab.run(text, "tnc-620", Setup(tools={1: tool})))
    page.keyboard.press("End")
    bodies = page.evaluate("() => parts(window.player.run.history.get('tool').value(2), 100)")
    rings = [ring for body, _ in bodies for ring in body]
    for height, radius in radii.items():
        below = max((ring for ring in rings if ring[1] <= height + 1e-9), key=lambda ring: ring[1])
        above = min((ring for ring in rings if ring[1] >= height - 1e-9), key=lambda ring: ring[1])
        share = (height - below[1]) / (above[1] - below[1]) if above[1] > below[1] else 0.0
        between = below[0] + share * (above[0] - below[0])
        assert between == pytest.approx(radius, abs=0.05), (name, height)  # arcs are drawn with six corners


def test_a_very_long_run_opens_and_moves(opened):
    blocks = [f"L X+{k % 100} Y+{k // 1000}.{k % 10} F500" for k in range(200_000)]
    text = "\n".join(["BEGIN PGM A MM", "TOOL CALL 1 Z S100", *blocks, "END PGM A MM"]) + "\n"
    run = mnclab.run(text, "tnc-620")
    page = opened(run)
    page.keyboard.press("End")
    page.wait_for_function(f"() => window.player.step === {len(run.steps.block) - 1}")
    wait_for_text(marked(page), "END PGM A MM")
    page.keyboard.press("ArrowLeft")
    wait_for_text(marked(page), blocks[-1])


def test_what_is_written_follows_every_key_of_a_frame(opened):
    """Three keys before the page gets a frame: the text is at the third block, not at the first."""
    page = opened(run_main())
    page.evaluate("window.requestAnimationFrame = () => 1")  # no frame comes
    for _ in range(3):
        page.keyboard.press("ArrowRight")
    assert marked(page).all_inner_texts() == ["2 BLK FORM 0.2 X+50 Y+40 Z+0"]


@pytest.mark.parametrize(("axis", "along"), [("X", 0), ("Y", 1), ("Z", 2)])
def test_a_tool_lies_along_its_axis(opened, axis, along):
    page = opened(mnclab.run(f"BEGIN PGM A MM\nTOOL CALL 1 {axis} S1000\nL X+1 Y+2 Z+3 FMAX M3\nEND PGM A MM\n", "tnc-620"))
    page.keyboard.press("End")
    drawn = page.evaluate("""() => {
      const found = [];
      window.drawTool = (pen, tool, tip, along) => found.push(...ring([2, 5], tip, along, point => point));
      window.player.draw();
      return found;
    }""")
    tip = [1, 2, 3]
    assert {round(point[along] - tip[along], 9) for point in drawn} == {5}
    assert {round(math.dist(point, tip) ** 2, 9) for point in drawn} == {29}


def test_the_rulers_of_an_inch_program_count_in_inches(opened):
    page = opened(mnclab.run("G20 G90 G54\nG0 X0 Y0 Z0.1\nG1 Z-0.1 F10\nX3\nY2\n", "iso"))
    for view, wanted in (("Top", {"X in", "Y in", "1.0", "2.0"}), ("3D", {"0.5 in"})):
        page.get_by_role("button", name=view, exact=True).click()
        said = page.evaluate("""() => {
          const said = [], write = CanvasRenderingContext2D.prototype.fillText;
          CanvasRenderingContext2D.prototype.fillText = text => said.push(text);
          window.player.picture.stale = true;
          window.player.draw();
          CanvasRenderingContext2D.prototype.fillText = write;
          return said;
        }""")
        assert wanted <= set(said), said


WINDOW = Path(__file__).parents[2] / "data" / "programs" / "tnc-620" / "drum_window.h"


def test_a_drum_is_a_plain_body_in_its_circles(opened):
    """Radius 30 about X: seen from above its colour reaches to Y 30, and beyond it is paper."""
    page = opened(mnclab.run(WINDOW))
    page.get_by_role("button", name="Top").click()
    x = page.evaluate("() => window.player.run.stock.flat()[0][0]")
    pixels = page.evaluate("""places => {
        const {picture} = window.player, pen = picture.canvas.getContext("2d");
        window.player.draw();
        const pixel = place => picture.camera.project(place).map(v => Math.round(v * picture.ratio));
        return places.map(place => [...pen.getImageData(...pixel(place), 1, 1).data]);
    }""", [[x + 2, y, 0] for y in (-28.5, 4.3, 28.5, 31.5, -31.5)])  # fmt: skip
    assert [alpha > 0 for *_, alpha in pixels] == [True, True, True, False, False]
    assert page.locator("#note").inner_text() == "the blank, not cut"


#: Whether the picture is the same after many small steps up to a place and drawn anew there.
STEPWISE = """share => {
    const {player} = window, {picture} = player, look = () => {
        const {data} = picture.canvas.getContext("2d").getImageData(0, 0, picture.canvas.width, picture.canvas.height);
        return data.slice();
    };
    for (let k = 0; k <= 300; k++) {
        player.place = player.atTime(player.run.time * share * k / 300);
        player.draw();
    }
    const stepwise = look();
    picture.stale = true;
    player.draw();
    return look().reduce((count, value, k) => count + (value !== stepwise[k]), 0);
}"""


@pytest.mark.parametrize("share", [0.35, 1])
def test_what_was_played_looks_as_what_is_opened_there(opened, share):
    wave = "".join(f"X{k / 10:g} Y{10 * math.sin(k / 20):.3f}\n" + ("G0 Z1\nG1 Z0\n" if k % 50 == 0 else "") for k in range(900))
    page = opened(mnclab.run(f"G90 G54 T1 S1000 M3\nG1 F1000\n{wave}", "mnc"))
    assert page.evaluate(STEPWISE, share) == 0


def test_on_a_drum_the_feed_is_that_along_the_workpiece_and_rapids_that_turn_are_arcs(opened):
    """F250 where the drum stands; where X stands and the drum of radius 30 turns, the tip at 30 - 3 has 27 / 30 of it, at 24 / 30
    on the second level. While a rapid turns the drum its distance from the axis changes evenly, as Z does."""
    run = mnclab.run(WINDOW)
    page = opened(run)
    path = run.toolpath
    still = np.ptp([path.start, path.end], axis=0).max(axis=1) < 1e-9
    lines = np.flatnonzero((path.kind == mnclab.Kind.LINE) & still & (path.lengths == 0))
    speed = """row => { const {run} = window.player, item = run.itemOfRow[row];
        return 60 * run.tool(item, (run.begin[item] + run.end[item]) / 2).speed; }"""
    found = sorted({round(page.evaluate(speed, int(row)), 1) for row in lines})
    assert found == pytest.approx([200, 225], rel=2e-3)
    turned = """() => { const {path} = window.player.run;
        return [...path.bends].map(([row, bends]) => [path.vertex(row), ...bends, path.vertex(row + 1)]); }"""
    rapids = page.evaluate(turned)
    assert rapids
    for places in rapids:
        away = [math.hypot(y, z) for _, y, z in places]
        assert np.diff(away) == pytest.approx(np.full(len(away) - 1, (away[-1] - away[0]) / (len(away) - 1)), abs=2e-3)
        assert min(away) >= 30
