"""The player in depth: walls where the moves leave them, path and tool hidden by metal, turned parts as bodies."""

import re

import numpy as np
import pytest
from tools.pages import BEGUN

import mnclab
from mnclab import Setup, Tool
from mnclab.workpiece.blank import chuck, cylinder

BLOCK = ((0, 0, -20), (90, 45, 0))
MILL = Tool(number=1, radius=4, kind="mill")
HEAD = "N1 G17 G90 G54 T1 S3000 M3 F800\nN2 G0 X-20 Y-20 Z20\n"
#: A round pocket of radius 18 about (45, 22), finished by less than a cell; its depth 6.
ROUND = HEAD + """N3 G0 X45 Y35.9
N4 G1 Z-6
N5 G2 X45 Y35.9 I0 J-13.9
N6 G1 Y36
N7 G2 X45 Y36 I0 J-14
N8 G0 Z20
"""
#: A groove askew over the block, 8 wide and 8 deep.
ASKEW = HEAD + "N3 G0 X-10 Y5 Z5\nN4 G1 Z-8\nN5 X100 Y40\nN6 G0 Z20\n"
#: Places of cells on the wall of a map, as far as `inside` (x, y, x, y).
ON_WALLS = """([x0, y0, x1, y1]) => {
    const {carving} = window.player.part, {grid, map} = carving, found = [];
    for (let j = 0; j < grid.ny; j++)
        for (let i = 0; i < grid.nx; i++) {
            const sides = [[1, 0], [-1, 0], [0, 1], [0, -1]].some(([di, dj]) => map.walled(i, j, di, dj));
            const [dx, dy] = map.moved(i, j), [x, y] = [grid.x(i) + dx, grid.y(j) + dy];
            if (sides && x > x0 && x < x1 && y > y0 && y < y1) found.push([x, y]);
        }
    return found;
}"""
#: Red, green, blue and how opaque the picture of the part is at places in space.
PIXELS = """places => {
    const {part, picture: {camera, ratio}} = window.player, copy = document.createElement("canvas");
    window.player.draw();  // a picture that turned just now was smaller
    [copy.width, copy.height] = [part.canvas.width, part.canvas.height];
    const pen = copy.getContext("2d", {willReadFrequently: true});
    pen.drawImage(part.canvas, 0, 0);
    return places.map(place => {
        const [x, y] = camera.project(place).map(v => Math.floor(v * ratio));
        return [...pen.getImageData(x, y, 1, 1).data];
    });
}"""
CAMERA = "([yaw, pitch]) => window.player.change(camera => { [camera.yaw, camera.pitch] = [yaw, pitch]; camera.update(); })"
#: How far the body of a lathe reaches to both sides of its axis, mm, in the columns of the picture at places z.
REACH = """zs => {
    const {part, picture: {camera, ratio}} = window.player, {canvas} = part;
    part.body.beside.draw = part.body.chuck = () => {};
    window.player.draw();
    const copy = document.createElement("canvas"), axis = camera.project([part.section.axis, 0, 0])[1];
    [copy.width, copy.height] = [canvas.width, canvas.height];
    const pen = copy.getContext("2d", {willReadFrequently: true});
    pen.drawImage(canvas, 0, 0);
    return zs.map(z => {
        const x = Math.floor(camera.project([0, 0, z])[0] * ratio), {data} = pen.getImageData(x, 0, 1, canvas.height), seen = [];
        for (let y = 0; y < canvas.height; y++) if (data[4 * y + 3] > 127) seen.push(y / ratio);
        return seen.length ? [axis - seen[0], seen[seen.length - 1] + 1 / ratio - axis].map(v => v / camera.zoom) : [0, 0];
    });
}"""


@pytest.fixture
def opened(browser, tmp_path):
    """opened(run) opens the saved page, all cut; a word of its console fails the test."""
    faults, contexts = [], []

    def open_page(run):
        assert run.ok, run.alarms
        context = browser.new_context(viewport={"width": 1366, "height": 768})
        contexts.append(context)
        context.set_offline(True)
        context.route(re.compile("^(?!file:)"), lambda route: faults.append(route.request.url) or route.abort())
        page = context.new_page()
        page.on("console", lambda message: "ReadPixels" in message.text or faults.append(message.text))
        page.on("pageerror", lambda error: faults.append(str(error)))
        page.goto(run.save(tmp_path / "part.html").as_uri())
        page.evaluate(BEGUN)
        page.evaluate("() => { const {player} = window; player.go(player.afterItem(player.run.items - 1)); }")
        if not run.toolpath.lathe:
            page.evaluate("n => { const {carving} = player.part; carving.aim(n, 0); carving.work(Infinity); }", len(run.toolpath))
        return page

    yield open_page
    for context in contexts:
        context.close()
    assert faults == []


def milled(program, stock=BLOCK):
    return mnclab.run(program, "mnc", Setup(stock=stock, tools={1: MILL}))


def test_a_round_wall_stands_on_its_circle(opened):
    """The cells are 0.3 mm; between two of them the wall is a chord, 0.3² / 8 / 18 mm off the circle."""
    found = np.array(opened(milled(ROUND)).evaluate(ON_WALLS, [20, 0, 70, 45]))
    outside = np.hypot(found[:, 0] - 45, found[:, 1] - 22)
    outside = outside[outside > 14]  # the rest is the boss in the middle
    assert len(outside) > 500
    assert np.abs(outside - 18).max() < 2e-3
    inside = np.hypot(found[:, 0] - 45, found[:, 1] - 22)
    assert np.abs(inside[inside < 14] - 9.9).max() < 2e-3


def test_an_askew_wall_stands_on_its_line(opened):
    found = np.array(opened(milled(ASKEW)).evaluate(ON_WALLS, [1, 1, 89, 44]))
    way = np.array([110, 35]) / np.hypot(110, 35)
    beside = (found - (-10, 5)) @ np.array([-way[1], way[0]])
    assert len(found) > 900
    assert np.abs(np.abs(beside) - 4).max() < 2e-3


def test_the_skin_of_a_tube_stands_on_its_circles(opened):
    page = opened(milled(HEAD, cylinder(20, -20, 0, at=(45, 22, 0), bore=8)))
    found = np.hypot(*(np.array(page.evaluate(ON_WALLS, [0, 0, 90, 45])) - (45, 22)).T)
    assert np.minimum(np.abs(found - 20), np.abs(found - 8)).max() < 2e-3


def test_a_flat_wall_has_one_shade(opened):
    page = opened(milled(ASKEW))
    page.evaluate(CAMERA, [30, 28])
    way = np.array([110, 35]) / np.hypot(110, 35)
    along = np.linspace(25, 85, 200)[:, None]
    wall = np.column_stack([(-10, 5) + along * way + 4 * np.array([-way[1], way[0]]), np.full(200, -2.0)])
    shades = np.array(page.evaluate(PIXELS, wall.tolist()))[:, :3]
    usual = np.median(shades, axis=0)
    assert (np.abs(shades - usual).max(axis=1) <= 2).mean() > 0.97


#: A corner milled off, 7 wide and 6 deep; a slot cut by a rapid from X50 to X30, 8 wide and 5 deep.
RAPID_SLOT = HEAD + "N3 G0 X-10 Y3\nN4 G1 Z-6\nN5 X40\nN6 G0 Z5\nN7 X50 Y25\nN8 G1 Z-5\nN9 G0 X30\nN10 G0 Z60\nN11 X80\n"


def test_a_wall_has_the_colour_of_what_cut_it_and_the_sides_of_the_blank_that_of_the_blank(opened):
    page = opened(milled(RAPID_SLOT))
    page.evaluate("() => window.player.showRapids(false)")
    page.evaluate(CAMERA, [60, 40])  # so that the round end of the slot is not hidden
    round_end = [[30 - 4 * np.sin(a), 25 + 4 * np.cos(a), -0.8] for a in np.linspace(0.4, np.pi / 2, 60)]
    red, green, blue, _ = np.array(page.evaluate(PIXELS, round_end)).T
    page.evaluate(CAMERA, [30, 28])
    side, wall = page.evaluate(PIXELS, [[20, 0, -12], [20, 7, -3]])
    page.evaluate(CAMERA, [30, -50])
    under = page.evaluate(PIXELS, [[20, 3, -20], [40, 25, -20], [70, 25, -20]])
    assert (red > 90).all() and max(green.max(), blue.max()) < 60
    assert side[0] > side[2] + 20 and wall[2] > wall[0]  # warm and cold
    assert np.ptp(under, axis=0).max() <= 2  # blind pockets do not show from below


def test_a_rapid_behind_metal_is_not_drawn(opened):
    """From the front the groove along X hides what runs in it, but not what runs above the block."""
    page = opened(milled(HEAD + "N3 G0 X-10 Y22 Z5\nN4 G1 Z-8\nN5 X100\nN6 G0 X-10\nN7 G0 Z10\nN8 X100\nN9 Y80\n"))
    page.evaluate(CAMERA, [0, 0])
    places = [[x, 22, z] for z in (-8, 10) for x in np.linspace(10, 80, 300)]
    seen = np.array(page.evaluate(PIXELS, places))
    page.get_by_role("button", name="Rapids").click()
    without = np.array(page.evaluate(PIXELS, places))
    differ = (seen != without).any(axis=1)
    assert not differ[:300].any()
    assert 0.4 < differ[300:].mean() < 0.8  # dashes of five pixels and three between them


def test_the_tool_in_a_pocket_is_hidden_by_its_wall(opened):
    page = opened(milled(HEAD + "N3 G0 X45 Y22 Z5\nN4 G1 Z-8\n"))
    page.evaluate(CAMERA, [0, 0])
    below, above = np.array(page.evaluate(PIXELS, [[46, 22, -5], [46, 22, 5]]))
    block = np.array(page.evaluate(PIXELS, [[20, 0, -5]]))[0]
    assert (below == block).all()  # the front of the block
    assert above[3] > 100 and (above[:3] != block[:3]).any()


BAR = cylinder(24, -60, 1)
SHAFT = """M3 T1
S800 G97 G95 F0.2
G00 X26 Z0
G01 X-1
G00 X20 Z2
G01 Z-30
X22 Z-34
X26
G00 X15 Z2
G01 Z0
X18 Z-3
Z-20
X26
G00 X60 Z40
"""


def test_a_turned_part_reaches_as_far_as_its_section(opened):
    """Seen from behind, where nothing is cut out, the body is as wide as the part has its radius, within a pixel."""
    run = mnclab.run(SHAFT, "jnc-t01", Setup(start=(60, 0, 40), stock=BAR, fixtures=(chuck(24, -60, grip=12, jaws=12, body=15),)))
    page = opened(run)
    page.evaluate(CAMERA, [180, 0])
    zs = np.array([-55, -40, -33, -31.5, -26, -22, -12, -5, -2, -1])
    found = np.array(page.evaluate(REACH, zs.tolist()))
    pixel = 1 / page.evaluate("window.player.picture.camera.zoom")
    assert np.abs(found - run.workpiece().at(zs)[:, None]).max() < 1.6 * pixel


def test_the_quarter_before_the_tool_is_open(opened):
    """There the section is seen, hatched in the colours of the drawing; the lower side is the skin."""
    run = mnclab.run(SHAFT, "jnc-t01", Setup(start=(60, 0, 40), stock=BAR))
    page = opened(run)
    page.evaluate(CAMERA, [0, 1])
    section = np.array(page.evaluate(PIXELS, [[r, 0, z] for r in (4, 8, 12) for z in np.linspace(-50, -30, 60)]))
    assert len(np.unique(section[:, :3], axis=0)) > 5  # metal, lines, and the pixels between them
    skin = np.array(page.evaluate(PIXELS, [[-14, 19.5, z] for z in np.linspace(-50, -40, 30)]))
    assert len(np.unique(skin[:, :3], axis=0)) <= 2
    assert (section[:, 3] == 255).all() and (skin[:, 3] == 255).all()


#: How many values of the canvas of the part differ after some places, drawn one after the other, from the same drawn as a whole.
PIECEMEAL = """([yaw, pitch]) => {
    const {part, picture} = player, pen = document.createElement("canvas").getContext("2d", {willReadFrequently: true});
    const shown = () => {
        [pen.canvas.width, pen.canvas.height] = [part.canvas.width, part.canvas.height];
        player.draw();
        pen.drawImage(part.canvas, 0, 0);
        return pen.getImageData(0, 0, pen.canvas.width, pen.canvas.height).data;
    };
    Object.assign(picture.camera, {yaw, pitch}).update();
    picture.stale = true;
    shown();
    return [0.3, 0.31, 0.5, 0.52, 0.2].map(share => {
        player.place = player.atTime(share * player.run.time);
        const pieces = shown();
        picture.stale = true;
        return shown().reduce((count, value, k) => count + (Math.abs(value - pieces[k]) > 8), 0) / pieces.length;
    });
}"""


@pytest.mark.parametrize("turned", [[0, 90], [30, 28]])
def test_what_is_drawn_in_pieces_is_the_whole(opened, turned):
    page = opened(milled(ASKEW))
    assert max(page.evaluate(PIECEMEAL, turned)) < 1e-3
