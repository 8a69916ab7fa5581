"""The player cuts: its map is that of the kernel at every place, forwards and backwards, and it is quick."""

import re

import numpy as np
import pytest
from tools.pages import BEGUN

import mnclab
from mnclab import Setup, Tool
from mnclab.workpiece.blank import cylinder

TOOLS = {
    1: Tool(number=1, radius=4, kind="mill"),
    2: Tool(number=2, radius=3, corner=3, kind="mill"),
    3: Tool(number=3, radius=5, corner=1.5, kind="mill"),
    4: Tool(number=4, radius=2.5, angle=118, kind="drill"),
    5: Tool(number=5, radius=6, angle=90, kind="countersink"),
}
BLOCK = ((0, 0, -20), (90, 45, 0))
#: Every lower side along lines, ramps, arcs, helices and an arc that stands upright; at last a rapid in the material.
PROGRAM = """N1 G17 G90 G54 T1 S3000 M3
N2 G0 X-20 Y-20 Z20
N3 G0 X10 Y10
N4 G1 Z-4 F800
N5 X40
N6 X10 Y30 Z-9
N7 G3 X10 Y30 I5 J0
N8 G0 Z5
N9 T2 S3000 M3
N10 G0 X45 Y8
N11 G1 Z-2
N12 X80 Y20 Z-6
N13 G2 X80 Y20 I-6 J3 Z-9
N14 G0 Z5
N15 T3 S3000 M3
N16 G0 X50 Y35
N17 G1 Z-3
N18 X80 Z-7
N19 G18 G2 X60 Z-7 I-10 K0
N20 G17 G0 Z5
N21 T4 S3000 M3
N22 G0 X30 Y20
N23 G1 Z-22
N24 G0 Z5
N25 T5 S3000 M3
N26 G0 X20 Y38
N27 G1 Z-4
N28 X40 Y36 Z-1
N29 G0 Z5
N30 T1 S3000 M3
N31 G0 X88 Y3
N32 G0 Z-6
N33 G0 Y42
N34 G0 Z20
"""
MAP = """([rows, share]) => {
    const carving = window.player.part.carving, {grid} = carving, heights = [], red = [];
    carving.aim(rows, share);
    if (!carving.work(Infinity)) throw Error("not there");
    for (let j = 0; j < grid.ny; j++)
        for (let i = 0; i < grid.nx; i++) {
            const {height, by} = carving.map.at(i, j);
            heights.push(height);
            red.push(by < 0 ? -by - 1 : -1);
        }
    return [heights, red];
}"""
SCOUTED = """() => new Promise(done => {
    const wait = () => window.player.part.carving.scouted ? done(window.player.part.carving.frames.length) : setTimeout(wait, 5);
    wait();
})"""
FRAMES = """speed => new Promise(done => {
    const player = window.player, times = [];
    player.go(player.atTime(player.run.time * 0.3));
    player.find("speed").value = speed;
    player.play(1);
    let before = 0;
    const frame = now => {
        if (before) times.push(now - before);
        before = now;
        if (times.length < 40) return requestAnimationFrame(frame);
        player.stop();
        done(times.sort((a, b) => a - b)[20]);
    };
    requestAnimationFrame(frame);
})"""
#: Milliseconds that the page itself works for a frame while it plays on or back.
OWN = """sign => {
    const player = window.player, times = [];
    player.go(player.atTime(player.run.time * 0.5));
    for (let k = 0; k < 40; k++) {
        const begin = performance.now();
        player.place = player.atTime(player.place.t + sign / 60);
        const now = player.now();
        player.part.carving.aim(now.rowsDone, now.share);
        player.part.carving.work(Infinity);
        times.push(performance.now() - begin);
    }
    return times.sort((a, b) => a - b)[20];
}"""


@pytest.fixture
def opened(browser, tmp_path):
    """opened(run) opens the saved page offline; a word of its console or a question to a network fails the test."""
    faults, contexts = [], []

    def open_page(run, before="", **options):
        context = browser.new_context(**{"viewport": {"width": 1366, "height": 768}, **options})
        contexts.append(context)
        context.set_offline(True)
        context.route(re.compile("^(?!file:)"), lambda route: faults.append(route.request.url) or route.abort())
        page = context.new_page()
        if before:
            page.add_init_script(before)
        page.on("console", lambda message: "ReadPixels" in message.text or faults.append(message.text))
        page.on("pageerror", lambda error: faults.append(str(error)))
        page.goto(run.save(tmp_path / "part.html").as_uri())
        page.evaluate(BEGUN)
        return page

    yield open_page
    for context in contexts:
        context.close()
    assert faults == []


def run_block(stock=BLOCK, program=PROGRAM):
    run = mnclab.run(program, "mnc", Setup(stock=stock, tools=TOOLS))
    assert run.ok, run.alarms
    return run


def kernel(run, **upto):
    """The kernel's part on the cells of the page."""
    wide = run.stock.bounds[1] - run.stock.bounds[0]
    return run.workpiece(step=float(wide[:2].max()) / 300, **upto)


def shown(page, rows, share=0.0):
    heights, red = page.evaluate(MAP, [int(rows), share])
    return np.array(heights), np.array(red)


def assert_within_half_a_cell(found, part):
    """Where a height is not the kernel's, the kernel has it within half a cell."""
    found = found.reshape(part.heights.shape)
    off = np.abs(found - part.heights) > 2e-3
    assert off.mean() < 0.02
    for j, i in np.argwhere(off):
        near = np.linspace(-part.step / 2, part.step / 2, 5)
        x, y = np.meshgrid(part.x[i] + near, part.y[j] + near)
        there = part.at(x, y)
        assert there.min() - 2e-3 <= found[j, i] <= there.max() + 2e-3


@pytest.mark.parametrize(
    "stock",
    [
        BLOCK,
        cylinder(25, -20, 0, at=(45, 22, 0), bore=6),
        cylinder(12, 0, 90, "X", at=(0, 22, -12)),
    ],
    ids=["block", "standing tube", "lying bar"],
)
def test_the_map_is_that_of_the_kernel_within_half_a_cell(opened, stock):
    run = run_block(stock)
    page = opened(run)
    n = len(run.toolpath)
    for rows in (n, n // 3, n // 2, 7):
        assert_within_half_a_cell(shown(page, rows)[0], kernel(run, row=rows - 1))


def test_a_row_cut_in_small_pieces_is_the_row_forwards_and_backwards(opened):
    run = run_block()
    page = opened(run)
    helix = int(np.flatnonzero(run.toolpath.sweep)[1])
    for row in (5, helix):
        whole = shown(page, row + 1)[0]
        page.evaluate(MAP, [row, 0])
        halves = [shown(page, row, share)[0] for share in (0.1, 0.35, 0.5, 0.8, 0.999999)]
        assert all((later <= sooner).all() for sooner, later in zip(halves, halves[1:]))
        assert (np.abs(halves[-1] - whole) > 2e-3).mean() < 1e-2  # but for middles of cells on the rim
        back = shown(page, row, 0.5)[0]
        assert (np.abs(back - halves[2]) > 2e-3).mean() < 1e-2


def test_only_a_rapid_in_the_material_is_red(opened):
    run = run_block()
    page = opened(run)
    red = shown(page, len(run.toolpath))[1]
    lines = {int(run.toolpath.line[row]) for row in red[red >= 0]}
    assert lines == {32, 33}
    assert (shown(page, len(run.toolpath) - 4)[1] < 0).all()


def test_a_collision_is_said_marked_and_leads_to_its_move(opened):
    run = run_block()
    page = opened(run)
    assert page.locator(".line.collision code").all_inner_texts() == []  # further down
    page.get_by_role("button", name="collision in line 32: rapid motion in material").click()
    assert page.locator(".line.now code").all_inner_texts() == ["N32 G0 Z-6"]
    assert page.locator(".line.collision code").all_inner_texts() == ["N32 G0 Z-6", "N33 G0 Y42"]


def test_an_unknown_start_cuts_nothing(opened):
    """The first rapid would come from inside the block."""
    run = run_block(program="N1 G17 G90 G54 T1 S3000 M3\nN2 G0 X40 Y40 Z3\nN3 G1 Z-2 F500\n", stock=((-30, -30, -9), (60, 60, 9)))
    page = opened(run)
    (row,) = np.flatnonzero(run.toolpath.line == 2)
    assert_within_half_a_cell(shown(page, row + 1)[0], kernel(run, row=row))
    assert (shown(page, row, 0.5)[0] == 9).all()


def test_the_part_can_be_hidden(opened):
    page = opened(run_block())
    button, canvas = page.get_by_role("button", name="Part"), page.locator("#part")
    assert button.get_attribute("aria-pressed") == "true" and canvas.is_visible()
    button.click()
    assert button.get_attribute("aria-pressed") == "false" and not canvas.is_visible()
    page.keyboard.press("p")
    assert canvas.is_visible()


def test_a_run_without_a_blank_has_no_part(opened):
    page = opened(mnclab.run("G0 X1\nG1 X5 F100\n", "mnc"))
    assert page.get_by_role("button", name="Part").count() == 0


NO_WEBGL = """HTMLCanvasElement.prototype.getContext = (own => function (kind, ...rest) {
    return kind === "webgl2" ? null : own.call(this, kind, ...rest);
})(HTMLCanvasElement.prototype.getContext);"""
#: What the canvas of the part shows at places: red, green, blue and whether anything.
PIXELS = """places => {
    const {part, picture: {camera, ratio}} = window.player, copy = document.createElement("canvas");
    window.player.draw();  // a picture that turned just now was smaller
    [copy.width, copy.height] = [part.canvas.width, part.canvas.height];
    const pen = copy.getContext("2d", {willReadFrequently: true});
    pen.drawImage(part.canvas, 0, 0);
    return places.map(place => {
        const [x, y] = camera.project(place).map(v => Math.round(v * ratio));
        return [...pen.getImageData(x, y, 1, 1).data];
    });
}"""


@pytest.mark.parametrize("before", ["", NO_WEBGL], ids=["webgl", "without"])
def test_from_above_the_blank_the_cut_the_wound_and_the_hole_are_told_apart(opened, before):
    page = opened(run_block(), before)
    page.get_by_role("button", name="Top").click()
    page.keyboard.press("End")
    page.wait_for_function("rows => window.player.part.carving.live.rows === rows", arg=len(run_block().toolpath))
    note = page.locator("#note").inner_text() if before else ""
    assert note == ("without WebGL: the part is shown from above only" if before else "")
    places = [[3, 3, 0], [25, 10, -4], [88, 25, -6], [30, 20, -20], [-5, 5, 0]]
    blank, cut, wound, hole, beside = page.evaluate(PIXELS, places)
    assert blank[3] == cut[3] == wound[3] == 255 and hole[3] == beside[3] == 0
    assert wound[0] > 120 and max(wound[1:3]) < 60  # red
    assert blank[0] > blank[2] + 20 and cut[2] > cut[0]  # warm and cold


PLAYED_LATE = """async () => {  // pixels of the canvas of the part to one of the picture: while it plays slowly, and stopped
    const {player} = window, {part, picture} = player, frame = () => new Promise(requestAnimationFrame);
    const fine = () => part.canvas.width / picture.canvas.width, found = [];
    part.drawing.slow = player.late = true;
    player.play(1);
    await frame(), await frame(), found.push(fine());
    player.stop();
    await frame(), await frame(), found.push(fine());
    return found;
}"""


def test_what_plays_slowly_is_coarse_until_it_stops(opened):
    page = opened(run_block())
    late, stopped = page.evaluate(PLAYED_LATE)
    assert (late, stopped) == (pytest.approx(0.5, abs=0.01), 1)


LONG = 20_000


@pytest.mark.deep
def test_twenty_thousand_moves_are_cut_ahead_and_reached_at_once(opened, capsys):
    k = np.arange(LONG)
    x, y = np.where(k // 200 % 2, 199 - k % 200, k % 200) * 0.5, k // 200 * 1.0
    z = -4 + 3 * np.sin(x / 9) * np.cos(y / 11)
    lines = [f"N{n + 5} G1 X{a:.3f} Y{b:.3f} Z{c:.3f}" for n, a, b, c in zip(k, x, y, z)]
    head = "N1 G90 G54 T2 S3000 M3 F1500\nN2 G0 X0 Y0 Z20\nN3 Z2\n"
    run = run_block(((0, 0, -20), (100, 100, 0)), head + "\n".join(lines) + "\n")
    assert len(run.player().page.encode()) < 2_000_000
    page = opened(run)
    frames = page.evaluate(SCOUTED)
    own = [page.evaluate(OWN, sign) for sign in (1, -1)]
    rate = 1000 / page.evaluate(FRAMES, "1")
    with capsys.disabled():
        print(f"\n{frames} key frames; {own[0]:.1f} ms a frame on, {own[1]:.1f} ms back; {rate:.0f} frames/s drawn")
    assert frames > 5
    assert max(own) < 60  # the slice of a frame is some ms on a quiet machine
    middle = LONG // 2
    assert_within_half_a_cell(shown(page, middle)[0], kernel(run, row=middle - 1))


def test_it_cuts_while_it_plays_and_goes_back(opened, capsys):
    page = opened(run_block())
    rate = 1000 / page.evaluate(FRAMES, "1")
    with capsys.disabled():
        print(f"\n{rate:.0f} frames/s")
    volume = "() => window.player.part.carving.map.tiles.reduce((sum, {h}) => h.reduce((a, b) => a + b, sum), 0)"
    found = []
    for key, rows in (("End", len(page.evaluate("() => [...window.player.run.path.kind]"))), ("Home", 0)):
        page.keyboard.press(key)
        page.wait_for_function("rows => window.player.part.carving.live.rows === rows", arg=rows)
        found.append(page.evaluate(volume))
    assert found[1] > found[0] + 1000
