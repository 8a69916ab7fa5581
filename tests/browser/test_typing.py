"""Typing in JupyterLab: Tab, the pointer on a word, the editor, a click on a move."""

import re

import pytest
from playwright.sync_api import TimeoutError

FIRST = "%%mnc --control mnc\nG90 G54 T1 S500 M3\nG0 X0 Y0 Z5\nG1 X40 F100\nG1 Y30\n"
PROGRAM = FIRST.split("\n", 1)[1]
OPEN = "import mnclab as mnc\nbox = mnc.editor('part.mnc')\nbox"
NOTEBOOK = "window.jupyterapp.shell.currentWidget.content"


def colour(page, piece):
    """The colour of a piece of a program in the first editor that has it."""
    found = page.locator(".cm-line span", has_text=re.compile(f"^{re.escape(piece)}$")).first
    found.wait_for(timeout=30_000)
    return found.evaluate("each => getComputedStyle(each).color")


def edit(page, source):
    """A new cell of a source at the end of the notebook, in edit mode, the cursor at its end."""
    page.evaluate("() => window.jupyterapp.commands.execute('notebook:insert-cell-below')")
    page.evaluate(f"s => {{ {NOTEBOOK}.activeCell.model.sharedModel.setSource(s); }}", source)
    page.evaluate("() => window.jupyterapp.commands.execute('notebook:enter-edit-mode')")
    page.wait_for_function(f"() => {NOTEBOOK}.activeCell.editor.editor.hasFocus")
    page.keyboard.press("Control+End")


def offered(page):
    """The words of the completer after Tab, and what is said beside them; JupyterLab gives a kernel one second to answer."""
    for _ in range(8):
        page.keyboard.press("Tab")
        try:
            page.locator(".jp-Completer-item").first.wait_for(timeout=4000)
            break
        except TimeoutError:
            continue
    names = page.locator(".jp-Completer-item .jp-Completer-match").all_inner_texts()
    return dict(zip(names, page.locator(".jp-Completer-item .jp-Completer-typeExtended").all_inner_texts(), strict=True))


@pytest.mark.parametrize("source", ["%%mnc --control mnc\nN40 G8", 'mnc.help("G8'])
def test_tab_offers_the_codes(run_cells, source):
    page = run_cells("import mnclab as mnc")
    edit(page, source)
    found = offered(page)
    assert found["G83"].lower().startswith("deep-hole drilling")
    assert all(word.startswith("G8") for word in found)
    page.keyboard.press("Escape")


def test_what_is_offered_is_written_as_the_manual_has_it_and_no_word_of_the_notebook_is_among_it(run_cells):
    """G88 is no code of the MNC; JupyterLab would offer it, as it stands in the cell, and would write "level r, mm (g83)"."""
    page = run_cells("%load_ext mnclab")
    edit(page, "%%mnc --control mnc\nN10 G88\nN40 G8")
    found = offered(page)
    assert "G88" not in found and found["G83"] == "Deep-hole drilling"
    assert set(page.locator(".jp-Completer-item .jp-Completer-type").all_inner_texts()) == {"◆"}
    page.keyboard.press("Escape")
    edit(page, "%%mnc --control mnc\nN40 G83 X20 ")
    found = offered(page)
    assert found["R"] == "level R, mm (G83)" and found["K"] == "depth of one peck, mm (G83)"
    icons = page.locator(".jp-Completer-item .jp-Completer-type")
    assert set(icons.all_inner_texts()) == {"◇"} and icons.first.get_attribute("aria-label") == "word"
    page.keyboard.press("Escape")


def test_shift_tab_says_what_a_word_means(run_cells):
    page = run_cells("import mnclab as mnc")
    edit(page, "%%mnc --control mnc\nN40 G83 X20 K5")
    page.keyboard.press("Shift+Tab")
    tip = page.locator(".jp-Tooltip")
    tip.wait_for(timeout=30_000)
    assert "depth of one peck" in tip.inner_text()


@pytest.mark.parametrize("inside", ["cell", "file"])
def test_the_pointer_on_a_word_says_what_it_means(run_cells, lab, browser, inside):
    if inside == "cell":
        page = run_cells("%load_ext mnclab", FIRST)
    else:
        address, folder = lab
        (folder / "hover.mnc").write_text(PROGRAM)
        page = browser.new_page(viewport={"width": 1000, "height": 700})
        page.goto(f"{address}/doc/tree/hover.mnc?reset")
    colour(page, "G54")
    page.locator(".cm-line span", has_text="G54").first.hover()
    tip = page.locator(".mnclab-word")
    tip.wait_for(timeout=20_000)
    assert tip.inner_text() == "G54 Work offset"
    if inside == "file":
        page.close()


@pytest.fixture
def opened(lab, run_cells):
    """A page with the editor on a program of five lines, and its file."""
    _, folder = lab
    file = folder / "part.mnc"
    file.write_text(PROGRAM)
    page = run_cells(OPEN)
    page.locator(".mnclab-code .cm-line").first.wait_for(timeout=30_000)
    return page, file


def caret(page):
    """The line with the cursor, and what is selected of it."""
    return page.evaluate("""() => {
        const view = document.querySelector('.mnclab-code .cm-content').cmTile?.view
            || document.querySelector('.mnclab-code .cm-content').cmView.view;
        const {from, to} = view.state.selection.main;
        return [view.state.doc.lineAt(from).number, view.state.sliceDoc(from, to)];
    }""")


def test_the_editor_has_numbers_colours_and_a_name(opened):
    page, _ = opened
    assert page.locator(".mnclab-code .cm-lineNumbers .cm-gutterElement:visible").all_inner_texts()[:3] == ["1", "2", "3"]
    assert len({colour(page, piece) for piece in ("G90", "X", "40")}) == 3
    page.get_by_role("textbox", name="part program").wait_for(timeout=5000)


def test_a_fault_is_underlined_where_it_stands_and_leaves_when_it_is_mended(opened):
    page, _ = opened
    page.get_by_role("textbox", name="part program").click()
    page.keyboard.press("Control+End")
    page.keyboard.type("G1 X4,5 F100")
    fault = page.locator(".mnclab-code .mnclab-alarm").filter(has_text=",")  # not one of half a word
    fault.wait_for(timeout=30_000)
    assert "," in fault.inner_text() and "X" not in fault.inner_text()[1:]
    place = fault.evaluate("each => [...document.querySelectorAll('.mnclab-code .cm-line')].indexOf(each.closest('.cm-line'))")
    assert place == 4
    page.get_by_text("part.mnc:5:6: ").or_(page.get_by_text("part.mnc:5:")).first.wait_for(timeout=10_000)
    for _ in range(len(",5 F100")):
        page.keyboard.press("Backspace")
    fault.wait_for(state="detached", timeout=30_000)


def test_the_word_at_the_cursor_is_explained_and_tab_leaves(opened):
    page, _ = opened
    page.get_by_role("textbox", name="part program").click()
    page.keyboard.press("Control+Home")
    page.keyboard.press("ArrowRight")
    page.get_by_text("G90 Absolute dimensions").wait_for(timeout=20_000)
    page.keyboard.press("Tab")
    assert page.evaluate("() => document.activeElement.textContent") == "Save"


def test_hover_help_goes_with_its_editor(opened):
    page, _ = opened
    word = page.locator(".mnclab-code .cm-line").filter(has_text="G1").first.bounding_box()
    page.mouse.move(word["x"] + 8, word["y"] + 8)
    page.locator(".mnclab-word").wait_for(timeout=5000)
    page.evaluate("() => document.querySelector('.mnclab-editor').closest('.mnclab-live').remove()")
    page.wait_for_function("() => !document.querySelector('.mnclab-word')", timeout=5000)


def test_control_s_saves_the_file(opened):
    page, file = opened
    page.get_by_role("textbox", name="part program").click()
    page.keyboard.press("Control+End")
    page.keyboard.type("Y0")
    page.get_by_text("part.mnc: changed").wait_for(timeout=20_000)
    page.keyboard.press("Control+s")
    page.get_by_text("part.mnc: saved").wait_for(timeout=20_000)
    assert file.read_text() == PROGRAM + "Y0"


def test_control_z_takes_back_what_was_typed_and_no_more(opened):
    page, _ = opened
    page.get_by_role("textbox", name="part program").click()
    page.keyboard.press("Control+End")
    page.keyboard.type("Y0")
    page.keyboard.press("Control+z")
    page.keyboard.press("Control+z")
    assert page.locator(".mnclab-code .cm-line").all_inner_texts() == [*PROGRAM.splitlines(), "\n"]
    page.keyboard.press("Control+y")
    page.locator(".mnclab-code .cm-line", has_text="Y0").last.wait_for(timeout=5000)


def test_what_python_writes_stands_in_the_editor(opened):
    page, _ = opened
    edit(page, "box.text.value = 'G90 S500 M3\\nG1 X7 F100\\n'")
    page.keyboard.press("Shift+Enter")
    page.locator(".mnclab-code .cm-line", has_text="G1 X7 F100").wait_for(timeout=20_000)
    assert page.locator(".mnclab-code .cm-line").all_inner_texts()[0] == "G90 S500 M3"


def middle(page, line):
    """The middle of the stroke of a line, in pixels of the page."""
    return page.evaluate(
        """line => {
        const path = document.querySelector(`.mnclab-moves g[data-line="${line}"] path`);
        const at = path.getPointAtLength(path.getTotalLength() / 2).matrixTransform(path.getScreenCTM());
        return [at.x, at.y];
    }""",
        line,
    )


def test_a_click_on_a_move_goes_to_its_line_and_marks_it(opened):
    page, _ = opened
    page.locator(".mnclab-moves").wait_for(state="attached", timeout=30_000)
    page.mouse.click(*middle(page, 4))
    page.wait_for_function("() => document.querySelector('.mnclab-moves g.here')?.dataset.line === '4'", timeout=10_000)
    assert caret(page) == [4, "G1 Y30"]
    page.keyboard.press("ArrowUp")  # to the beginning of what is selected
    page.keyboard.press("ArrowUp")
    page.wait_for_function("() => document.querySelector('.mnclab-moves g.here')?.dataset.line === '3'", timeout=10_000)


def test_a_move_of_a_plot_names_its_line_while_it_is_clicked(run_cells):
    page = run_cells("%load_ext mnclab", FIRST)
    said = page.locator(".mnclab-moves text", has_text="line 4: G1 Y30")
    assert not said.is_visible()
    page.locator(".mnclab-moves").scroll_into_view_if_needed()
    page.mouse.click(*middle(page, 4))
    said.wait_for(state="visible", timeout=5000)
    page.mouse.move(5, 5)
    assert said.is_visible()  # it stays until something else is clicked


def test_an_early_fault_draws_nothing(run_cells):
    page = run_cells("%load_ext mnclab", "%%mnc --control mnc\nG90\nG1 X4,5 F100\n")
    page.get_by_text("is no part of a number").first.wait_for(timeout=20_000)
    assert page.locator(".jp-OutputArea-output img").count() == 0


def test_without_the_extension_the_box_stays(lab, run_cells):
    """As in other front ends: a text box with a name, and strokes over the picture."""
    _, folder = lab
    (folder / "part.mnc").write_text(PROGRAM)
    page = run_cells("import mnclab as mnc\nbox = mnc.editor('part.mnc')\nbox.remove_class('mnclab-live')\nbox")
    area = page.get_by_label("part program")
    area.wait_for(timeout=30_000)
    assert area.input_value() == PROGRAM
    assert page.locator(".mnclab-moves").count() == 1
