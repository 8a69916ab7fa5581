"""What people see and touch: a picture with a name, number boxes that redraw it, all in one view on a small laptop."""

import json
import subprocess
import sys

import pytest

PANEL = """
import mnclab as mnc
mnc.panel("G90 G54\\nG0 X0 Y0 Z5\\nG1 X{side} F{feed}\\nY{side}\\n", "mnc", side=(40.0, 10.0, 60.0), feed=100.0, sliders=True)
"""
LAPTOP = {"width": 1366, "height": 768}
BESIDE = 330  # pixels that the file browser of JupyterLab takes beside a notebook
CELL = 62  # and a cell of two lines above its output, with the margin at the top

#: Where things are in a form, in pixels from its upper left corner, and what has no room.
PLACES = """() => {
    const form = document.querySelector('.mnclab-form'), corner = form.getBoundingClientRect();
    const box = e => { const b = e.getBoundingClientRect();
                       return [b.left - corner.left, b.top - corner.top, b.right - corner.left, b.bottom - corner.top]; };
    const heads = [...form.querySelectorAll('.mnclab-fields .mnclab-fold')], rows = [...form.querySelectorAll('.mnclab-row')];
    const clipped = [...form.querySelectorAll('.mnclab-row label')].filter(e => e.scrollWidth > e.clientWidth + 1);
    for (const select of form.querySelectorAll('.mnclab-row select')) {
        const free = select.cloneNode(true);
        free.style.cssText = 'position: absolute; width: max-content';
        select.parentElement.append(free);
        if (select.clientWidth && free.clientWidth > select.clientWidth + 1) clipped.push(select);
        free.remove();
    }
    return {first: box(rows[0]), last: box(heads.at(-1) || rows.at(-1)), picture: box(form.querySelector('.mnclab-drawn img')),
            wide: form.clientWidth, clipped: clipped.map(e => e.textContent)};
}"""


def test_a_run_shows_its_picture_without_pyplot(run_cells):
    page = run_cells("import mnclab as mnc\nmnc.run('G0 X1 Y3\\nG1 X4 F100\\n', 'mnc').plot()")
    page.get_by_role("img", name="tool path: 2 moves, X 0 to 4, Y 0 to 3 mm").wait_for(timeout=5000)


def test_a_number_box_redraws_the_picture_and_says_the_alarm_at_its_field(run_cells):
    page = run_cells(PANEL)
    side = page.get_by_role("spinbutton", name="side")
    side.fill("25")
    side.press("Enter")
    page.get_by_role("img", name="X 0 to 25, Y 0 to 25").wait_for(timeout=5000)
    feed = page.get_by_role("spinbutton", name="feed")
    feed.fill("0")
    feed.press("Enter")
    row = page.locator(".mnclab-row").filter(has=feed)
    row.get_by_role("alert").filter(has_text="F (feed rate) must be greater than 0").wait_for(timeout=5000)
    page.get_by_role("img", name="last good picture; tool path").wait_for(timeout=5000)
    assert page.locator(".mnclab-past > div").evaluate("e => getComputedStyle(e).filter") == "grayscale(1)"
    assert feed.evaluate("e => e === document.activeElement"), "the cursor stays where one types"
    assert page.locator(".mnclab-row").filter(has=side).get_by_role("alert").count() == 0


def test_a_slider_makes_no_change_by_itself_and_moves_its_box(run_cells):
    page = run_cells(PANEL, "live = _\nlive.boxes['side'].value, len(live.fields['side'].parts)")
    page.get_by_text("(40.0, 2)").wait_for(timeout=5000)
    handle = page.get_by_role("slider", name="side").bounding_box()
    page.mouse.move(handle["x"] + 5, handle["y"] + 5)
    page.mouse.down()
    page.mouse.move(handle["x"] + 40, handle["y"] + 5)
    page.mouse.up()
    page.wait_for_function("() => Number(document.querySelector('.mnclab-row input').value) > 41", timeout=5000)


def test_a_form_has_named_boxes_and_follows_them(run_cells):
    page = run_cells("import mnclab as mnc\nmnc.form('G83', 'mnc')")
    depths = page.get_by_role("button", name="Depths and heights")
    if not page.get_by_label("Z bottom of the hole [mm]").is_visible():
        depths.press("Enter")
    bottom = page.get_by_role("spinbutton", name="Z bottom of the hole [mm]")
    bottom.fill("-33")
    bottom.press("Enter")
    page.get_by_role("img", name="Z -33 to").wait_for(timeout=5000)
    page.get_by_role("checkbox", name="write K").uncheck()
    page.get_by_role("button", name="Program").click()
    page.get_by_text("G83 X20 Y10 Z-33 R2 P0.5 F120 G80").wait_for(timeout=5000)
    page.get_by_role("checkbox", name="write K").check()
    page.locator(".mnclab-steps").get_by_text("peck 2").first.wait_for(timeout=5000)


def test_a_group_folds_by_the_keyboard_and_says_its_state(run_cells):
    page = run_cells("import mnclab as mnc\nmnc.form('CYCL DEF 251', 'tnc-620')")
    head = page.get_by_role("button", name="open: Shape and place (6)")
    side = page.get_by_role("spinbutton", name="Q218 first side length [mm]")
    side.focus()
    page.keyboard.press("Tab")
    assert page.get_by_role("spinbutton", name="Q219").evaluate("e => e === document.activeElement"), "down the fields"
    head.press("Enter")
    page.get_by_role("button", name="folded: Shape and place (6)").wait_for(timeout=5000)
    assert not side.is_visible()


FORMS = [("CYCL DEF 251", "tnc-620"), ("G303", "mnc"), ("G77", "jnc-t01"), ("TCH PROBE 481", "tnc-620")]


@pytest.mark.parametrize(("code", "control"), FORMS)
def test_first_field_last_head_and_picture_stand_on_one_screen(run_cells, code, control):
    page = run_cells(f"import mnclab as mnc\nmnc.form('{code}', '{control}')")
    page.set_viewport_size({"width": LAPTOP["width"] - BESIDE, "height": LAPTOP["height"]})
    page.wait_for_timeout(300)
    places = page.evaluate(PLACES)
    room = LAPTOP["height"] - 30 - page.locator(".jp-WindowedPanel-outer").first.bounding_box()["y"] - CELL
    for name in ("first", "last", "picture"):
        left, top, right, bottom = places[name]
        assert left >= 0 and top >= 0 and right <= places["wide"] + 1 and bottom <= room, (name, places)
    assert places["picture"][0] >= places["first"][2], ("the picture stands beside the fields", places)
    assert places["clipped"] == []


def test_the_field_with_the_cursor_lights_its_dimension_up(run_cells):
    """Over the picture, as large as it, and for another value when that is typed."""
    page = run_cells("import mnclab as mnc\nmnc.form('CYCL DEF 251', 'tnc-620')")
    assert page.locator(".mnclab-dimension").count() == 0
    side = page.get_by_role("spinbutton", name="Q219 second side length [mm]")
    side.focus()
    page.get_by_role("img", name="Q219 60 mm").wait_for(timeout=10_000)
    side.fill("50")
    side.press("Tab")
    page.get_by_role("img", name="Q220 8 mm").wait_for(timeout=10_000)
    side.focus()
    page.get_by_role("img", name="Q219 50 mm").wait_for(timeout=10_000)
    drawn, picture = (page.locator(each).bounding_box() for each in (".mnclab-dimension", ".mnclab-drawn img"))
    assert all(abs(drawn[each] - picture[each]) < 1.5 for each in ("x", "y", "width", "height"))


#: Cells of the steps that stand, or whose text stands, out of what shows them once their box is scrolled to them.
CUT = """() => {
    const form = document.querySelector('.mnclab-form'), cut = [];
    for (const cell of form.querySelectorAll('.mnclab-steps :is(td, th)')) {
        cell.scrollIntoView({block: 'center'});
        const range = document.createRange();
        range.selectNodeContents(cell);
        const text = range.getBoundingClientRect();
        for (let shell = cell.parentElement; shell && shell !== form.parentElement; shell = shell.parentElement) {
            const box = shell.getBoundingClientRect();
            const off = text.width && (text.left < box.left - 1 || text.right > box.right + 1 || text.top < box.top - 1
                                       || text.bottom > box.bottom + 1);
            if (off && shell.tagName !== 'TR') { cut.push(cell.textContent); break; }
        }
    }
    return [cut, form.querySelectorAll('.mnclab-steps tr').length];
}"""


@pytest.mark.parametrize(("code", "control"), [*FORMS, ("G75", "nc-31"), ("CYCL DEF 24", "tnc-620"), ("CYCL DEF 275", "tnc-620")])
def test_no_step_is_cut_in_a_row_or_a_column(run_cells, code, control):
    page = run_cells(f"import mnclab as mnc\nmnc.form('{code}', '{control}')")
    page.set_viewport_size({"width": LAPTOP["width"] - BESIDE, "height": LAPTOP["height"]})
    page.wait_for_timeout(300)
    cut, rows = page.evaluate(CUT)
    assert cut == [] and rows > 3


def test_an_alarm_breaks_no_word(run_cells):
    """On a narrow page: every word of it stands in one line, the line of the program and its caret in one piece."""
    program = "G90 G54 S500 M3\\n" + "N20 G1 X40.125 Y30.125 Z-12.125 F100 (a long line for a narrow page) " * 2 + "W5,5\\n"
    page = run_cells(f"import mnclab as mnc\nmnc.run('{program}', 'mnc').alarms[0]")
    page.set_viewport_size({"width": 480, "height": 700})
    page.wait_for_timeout(300)
    broken = page.evaluate("""() => {
        const alarm = document.querySelector('.jp-OutputArea [role=alert]'), found = [];
        const walk = document.createTreeWalker(alarm, NodeFilter.SHOW_TEXT);
        for (let node; node = walk.nextNode();)
            for (const word of node.data.matchAll(/\\S+/g)) {
                const range = document.createRange();
                range.setStart(node, word.index);
                range.setEnd(node, word.index + word[0].length);
                if (range.getClientRects().length > 1 && !/[-/]/.test(word[0])) found.push(word[0]);
            }
        return found;
    }""")
    assert broken == []


def test_what_a_changed_form_leaves_behind_is_its_last_picture(run_cells, browser, tmp_path):
    """The notebook is exported as it is saved, without the state of widgets: the page has the picture of the last value."""
    page = run_cells(PANEL)
    side = page.get_by_role("spinbutton", name="side")
    side.fill("25")
    side.press("Enter")
    page.get_by_role("img", name="X 0 to 25, Y 0 to 25").wait_for(timeout=5000)
    page.wait_for_timeout(300)
    assert page.locator(".mnclab-still").count() == 1 and not page.locator(".mnclab-still").is_visible()
    model = page.evaluate("() => window.jupyterapp.shell.currentWidget.context.model.toJSON()")
    notebook = tmp_path / "saved.ipynb"
    notebook.write_text(json.dumps(model), "utf-8")
    subprocess.run([sys.executable, "-m", "nbconvert", "--to", "html", str(notebook)], check=True, capture_output=True)
    exported = browser.new_page()
    exported.goto(notebook.with_suffix(".html").as_uri())
    exported.get_by_role("img", name="X 0 to 25, Y 0 to 25").wait_for(timeout=5000)
    assert exported.get_by_role("cell", name="25").is_visible()
    exported.close()
