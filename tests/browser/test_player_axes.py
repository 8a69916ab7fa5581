"""The player of machines whose rotary axes turn: where it shows axes, tool and part, against the chain in Python and by hand."""

import numpy as np
import pytest

import mnclab as mnc

TOOL = mnc.Tool(radius=4, length=90, cutting_length=25, holder=((10, 35), (20, 50)))
BLOCK = ((70, -80, -220), (130, -20, -200))
#: The values of the machine after a row, read off the board.
READ = """row => {
    const {player} = window, {run} = player;
    player.go(player.afterItem(run.itemOfRow[row]));
    return [...document.querySelectorAll("[id^=machine-]")].map(cell => [cell.id.slice(-1), cell.textContent.replace("−", "-")]);
}"""
#: The directions of the tool on the part after a row, and where a place of the part is seen, with the part turning and still.
SEEN = """([row, place]) => {
    const {player} = window, {run, picture} = player, found = {};
    player.go(player.afterItem(run.itemOfRow[row]));
    for (const turns of [true, false]) {
        picture.turning.moves = turns && run.chain.table.length > 0;
        player.draw();
        found[turns] = picture.camera.project(place);
        found["target" + turns] = picture.camera.target;
        found.zoom = picture.camera.zoom;
        found.size = picture.camera.size;
        found["ways" + turns] = [picture.camera.right, picture.camera.up];
    }
    return {...found, tool: run.chain.tool(player.now().angles)};
}"""

#: The boxes of all names of axes after a row, seen along a view.
WRITTEN = """([view, row]) => {
    const {player} = window, {picture} = player;
    player.go(player.afterItem(player.run.itemOfRow[row]));
    player.view(view);
    player.draw();
    return [picture.written, picture.camera.size, picture.written.length];
}"""


def made(machine, text=None):
    tilt = "A" if machine == "table-ac" else "B"
    blocks = text or f"L {tilt}+25 C+40 FMAX\nL X-5 Z+12 F300\nL Y+15 {tilt}+10 F800\nTOOL CALL 3 Z S900\nL X+0 C-70 F900"
    tools = {2: TOOL, 3: mnc.Tool(radius=2, length=60)}
    run = mnc.run(f"BEGIN PGM T MM\nTOOL CALL 2 Z S3000\nL X+20 Y-5 Z+50 R0 FMAX M3\n{blocks}\nEND PGM T MM\n", "tnc-620",
                  mnc.Setup(tools=tools, kinematics=machine, stock=BLOCK, presets={0: (100, -50, -200)}))  # fmt: skip
    assert run.ok, run.alarms
    return run


@pytest.mark.parametrize("machine", ["table-ac", "head-bc", "head-b-table-c"])
def test_the_board_shows_where_the_axes_stand(opened, machine):
    run = made(machine)
    page, axes = opened(run), run.axes()
    names = ["X", "Y", "Z", *run.setup.kinematics.names]
    for row in [*np.flatnonzero(run.toolpath.is_motion)[::7].tolist(), len(run.toolpath) - 1]:
        shown = dict(page.evaluate(READ, row))
        assert list(shown) == names
        for name in names:
            assert float(shown[name].rstrip("°")) == pytest.approx(axes[name][row], abs=0.0006), (row, name)


@pytest.mark.parametrize("machine", ["table-ac", "head-bc", "head-b-table-c"])
def test_tool_and_part_stand_as_on_the_machine(opened, machine):
    """With the part still the tool leans as the path says; with a table that turns a place of the part is seen where the machine
    has it, by the camera that stands on the machine."""
    run = made(machine)
    page, path, chain = opened(run), run.toolpath, run.setup.kinematics
    place = np.array([12.0, -7.0, -3.0])
    still = page.evaluate(SEEN, [0, place.tolist()])  # all axes at zero: both are one
    right, up = np.array(still["waystrue"])
    for row in np.flatnonzero(path.is_motion)[::9].tolist():
        seen = page.evaluate(SEEN, [row, place.tolist()])
        assert np.allclose(seen["tool"][2], path.directions[row], atol=1e-8)
        back = chain.carried(path.rotary[row], 0.0)  # with no length a head moves nothing
        if chain.head:
            back = mnc.Kinematics(table=chain.table).carried(path.rotary[row], 0.0) if chain.table else np.eye(4)
        there = np.linalg.inv(back) @ np.append(place + path.origin, 1)
        middle = np.linalg.inv(back) @ np.append(seen["targettrue"] + path.origin, 1)
        off = (there - middle)[:3]
        expected = np.array(seen["size"]) / 2 + seen["zoom"] * np.array([off @ right, -off @ up])
        assert np.allclose(seen["true"], expected, atol=1e-6)
        off = place - seen["targetfalse"]
        expected = np.array(seen["size"]) / 2 + seen["zoom"] * np.array([off @ right, -off @ up])
        assert np.allclose(seen["false"], expected, atol=1e-6)


def test_what_is_written_of_axes_stands_apart_in_every_view(opened):
    """A plane leans by 25 degrees about Y: from above and from the front axes of the plane and the zero point fall together. No
    two names overlap, all are in the picture, and an axis that points at whoever looks has none."""
    run = made("table-ac", "PLANE SPATIAL SPA+0 SPB+25 SPC+0 TURN MB50 FMAX\nL X+8 Y-15 Z+5 F500\nL Y+15")
    page, row = opened(run), int(np.flatnonzero(run.toolpath.is_motion)[-1])
    for view in ("top", "front", "right", "isometric"):
        boxes, (w, h), names = page.evaluate(WRITTEN, [view, row])
        assert names == {"top": 7, "front": 7, "right": 6, "isometric": 8}[view], (view, boxes)
        for k, (left, top, right, bottom) in enumerate(boxes):
            assert left >= 0 and top >= 0 and right <= w and bottom <= h, (view, k)
            assert all(right <= a or left >= c or bottom <= b or top >= d for a, b, c, d in boxes[k + 1 :]), (view, k)


def test_a_button_lets_the_part_stand_still(opened):
    page = opened(made("table-ac"))
    button = page.get_by_role("button", name="Table turns")
    page.set_viewport_size({"width": 1024, "height": 768})
    assert len({round(page.get_by_role("button", name=each).bounding_box()["y"]) for each in ("Table turns", "keys")}) == 1
    assert button.get_attribute("aria-pressed") == "true"
    page.keyboard.press("End")
    page.wait_for_function("() => !window.player.waiting")
    turned = page.evaluate("() => window.player.picture.camera.up")
    button.click()
    assert button.get_attribute("aria-pressed") == "false"
    page.wait_for_function("() => !window.player.waiting")
    upright = page.evaluate("() => window.player.picture.camera.up")
    assert not np.allclose(turned, upright) and upright[0] == pytest.approx(-np.sin(np.radians(30)) * np.sin(np.radians(28)))
    page.locator("#picture").press("t")
    assert button.get_attribute("aria-pressed") == "true"


def test_a_part_that_turns_stays_in_the_picture(opened):
    """The corners of the blank, in every pose of the run, from the front, from above and askew."""
    run = made("table-ac", "L A+90 C+45 F5000\nL A-60 C-200 F5000")
    page = opened(run)
    corners = [[x, y, z] for x in (-30, 30) for y in (-30, 30) for z in (-20, 0)]
    for view in ("top", "front", "right", "isometric"):
        page.evaluate("() => { window.player.picture.turning.moves = true; window.player.draw(); }")
        page.evaluate("view => window.player.view(view)", view)
        for row in range(3, len(run.toolpath), 11):
            x, y = np.array([page.evaluate(SEEN, [row, corner])["true"] for corner in corners]).T
            wide, high = page.evaluate("() => window.player.picture.camera.size")
            assert x.min() > 0 and x.max() < wide and y.min() > 0 and y.max() < high, (view, row)


def test_a_head_is_seen_as_far_as_its_axes(opened):
    page = opened(made("head-bc", "L B+25 FMAX\nL X+0 Y+0 Z-3 FMAX\nL Y+10 F300\nL Z+50 FMAX"))
    assert page.get_by_role("button", name="Table turns").count() == 0
    inside = """() => {
        const {picture, run} = window.player, [w, h] = picture.camera.size;
        return picture.turning.heads.every(at => picture.camera.project(at).every((v, k) => v > 0 && v < [w, h][k]));
    }"""
    assert not page.evaluate(inside)
    page.get_by_role("button", name="Head").click()
    assert page.evaluate(inside)
    page.get_by_role("button", name="Fit").click()
    assert not page.evaluate(inside)


def test_the_square_lies_in_the_plane_that_is_tilted(opened):
    """SPB+30 about X20: X of the plane goes along (cos 30, 0, -sin 30) from there; before and after it there is none."""
    shift, how = "CYCL DEF 7.0 DATUM SHIFT\nCYCL DEF 7.1 X+20", "TURN MB50 FMAX"
    run = made("table-ac", f"{shift}\nPLANE SPATIAL SPA+0 SPB+30 SPC+0 {how}\nL X+5 F500\nPLANE RESET {how}")
    page = opened(run)
    planes = page.evaluate("() => Array.from({length: player.run.steps}, (_, k) => player.run.chain.plane.value(k))")
    lines = [run.program[int(block)].span.line for block in run.steps.block]
    shown = dict(zip(lines, planes))
    assert shown[3] is None and shown[8] is None
    c, s = np.cos(np.radians(30)), np.sin(np.radians(30))
    assert np.allclose(shown[7], [[c, 0, s, 20], [0, 1, 0, 0], [-s, 0, c, 0], [0, 0, 0, 1]], atol=1e-9)


def test_what_a_cycle_corrects_counts_from_there_on(opened):
    """An axis that is 0.03 and 0.04 mm beside where the control believes it: 451 finds it, and the board follows."""
    true = mnc.Kinematics(table=(mnc.Axis("A", centre=(0, 0.03, 49.96)), mnc.Axis("C")))
    turns = "Q411=-60 Q412=60 Q413=0 Q414=4 Q415=0 Q416=0 Q417=0 Q418=0 Q419=-90 Q420=180 Q421=0 Q422=4"
    words = f"Q406=1 Q407=12.5 Q320=0 Q408=0 Q253=750 Q380=0 {turns} Q423=4 Q431=0 Q432=0"
    setup = mnc.Setup(
        tools={5: mnc.Tool(radius=2, length=120, kind="probe")}, probe=mnc.Probe(clearance=2, reach=10), kinematics="table-ac",
        true_kinematics=true, start=(100, 60, 180), part=mnc.part.ball((100, 60, 40), 12.5), presets={0: (100, 60, 40)},
    )  # fmt: skip
    run = mnc.run(f"TOOL CALL 5 Z\nTCH PROBE 451 X\n{words}\nL Z+150 F500\nL A+40 F500\n", "tnc-620", setup)
    assert run.ok, run.alarms
    page, axes = opened(run), run.axes()
    for row in (len(run.toolpath) // 3, len(run.toolpath) - 1):
        for name, shown in page.evaluate(READ, row):
            assert float(shown.rstrip("°")) == pytest.approx(axes[name][row], abs=0.0006), (row, name)


def test_without_kinematics_the_page_has_no_axes(opened):
    page = opened(made(None, "L X+0 F500"))
    assert page.evaluate("() => typeof Chain") == "undefined"
    assert [name for name, _ in page.evaluate(READ, 2)] == ["X", "Y", "Z"]
    assert page.get_by_role("button", name="Table turns").count() == page.get_by_role("button", name="Head").count() == 0


SLOPE = (
    "CYCL DEF 7.0 DATUM SHIFT\nCYCL DEF 7.1 X+10\nPLANE SPATIAL SPA+0 SPB+25 SPC+0 TURN MB50 FMAX\nL X+8 Y-20 Z+0 F500\n"
    "L Y+20\n"
)


def test_before_the_first_tool_its_length_is_none(opened):
    """At the start, and while a tool is changed, the axes stand where they stood: it is the tip that another tool moves."""
    tools, limits = {2: TOOL, 3: mnc.Tool(radius=2, length=60)}, mnc.Limits(tool_change=5)
    setup = mnc.Setup(tools=tools, kinematics="table-ac", start=(7, -8, 400), limits=limits)
    run = mnc.run("TOOL CALL 2 Z S3000\nL X+20 Y-5 Z+50 R0 FMAX M3\nTOOL CALL 3 Z\nL A+20 FMAX\n", "tnc-620", setup)
    page, axes = opened(run), run.axes()
    first, second = np.flatnonzero(run.toolpath.kind == mnc.Kind.TOOL).tolist()
    going = """row => {
        const {player} = window, {run} = player, item = run.itemOfRow[row];
        player.go({item, t: (run.begin[item] + run.end[item]) / 2, done: false});
        return player.run.end[item] - run.begin[item];
    }"""
    board = "() => ['X', 'Y', 'Z'].map(name => Number(document.getElementById(`machine-${name}`).textContent.replace('−', '-')))"
    assert page.evaluate(board) == [7, -8, 400]
    assert page.evaluate(going, first) == pytest.approx(5)
    assert page.evaluate(board) == [7, -8, 400] == axes[first, :3].tolist()
    page.evaluate(going, second)
    assert page.evaluate(board) == [20, -5, 140] == axes[second - 1, :3].tolist() == axes[second, :3].tolist()


@pytest.mark.parametrize("view", ["isometric", "top", "front", "right"])
def test_no_label_lies_over_another(opened, view):
    run = made("table-ac", SLOPE)
    page = opened(run)
    page.evaluate("""view => {
        window.told = [];
        const write = CanvasRenderingContext2D.prototype.fillText;
        CanvasRenderingContext2D.prototype.fillText = function (text, x, y) {
            const {width} = this.measureText(text);
            if (this.canvas.id === "picture" && this.textAlign === "center") window.told.push([text, x, y, width]);
            write.call(this, text, x, y);
        };
        player.view(view);
    }""", view)  # fmt: skip
    for row in range(2, len(run.toolpath), 9):
        told = page.evaluate("""row => {
            window.told = [];
            player.go(player.afterItem(player.run.itemOfRow[row]));
            player.draw();
            return window.told;
        }""", row)  # fmt: skip
        assert len(told) >= 4
        for k, (text, x, y, wide) in enumerate(told):
            for other, x1, y1, wide1 in told[k + 1 :]:
                assert abs(x - x1) > (wide + wide1) / 2 or abs(y - y1) > 8, (row, text, other)


def test_the_square_is_behind_the_tool_that_stands_on_it(opened):
    """The picture over the part is clear where the tool is, and has the square beside it."""
    run = made("table-ac", SLOPE)
    page = opened(run)
    row = np.flatnonzero(run.toolpath.is_motion)[-1].item()
    page.evaluate("row => player.go(player.afterItem(player.run.itemOfRow[row]))", row)
    on, beside = page.evaluate("""() => {
        player.draw();
        const {picture} = player, {width, height} = picture.canvas, [across, , up] = picture.run.chain.tool(player.now().angles);
        const {data} = picture.canvas.getContext("2d").getImageData(0, 0, width, height);
        return [1, -20].map(aside => [3, 4, 5, 6, 7, 8, 9, 10, 11].map(far => {
            const [x, y] = picture.camera.project(player.now().point.map((v, k) => v + far * up[k] + aside * across[k]));
            return data[4 * (Math.round(y) * width + Math.round(x)) + 3];
        }));
    }""")
    assert np.median(on) == 0 < np.median(beside)


@pytest.mark.parametrize(("width", "height"), [(1366, 768), (1024, 600), (800, 600), (500, 800)])
def test_all_axes_are_in_sight(opened, width, height):
    page = opened(made("table-ac"))
    page.set_viewport_size({"width": width, "height": height})
    row, board = (page.locator(of).bounding_box() for of in ("#machine-C", ".board"))
    assert row["y"] + row["height"] <= board["y"] + board["height"]
