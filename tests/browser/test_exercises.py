"""An exercise in JupyterLab: fail, read the hint, mend, pass, see it on the map, begin anew."""

import json

import mnclab
from mnclab.learning.answers import answers_of
from mnclab.learning.marking import Mark, Marks, class_page

NAME = "mnc-07"
MODEL = answers_of(mnclab.exercise(NAME).file).model
WRONG = MODEL.replace("Z-5", "Z-4", 1)


def opened(run_cells, name, folder):
    """A page with the editor of an exercise, as JupyterLab opens on a small screen."""
    for kept in folder.glob(f"{name}.*"):
        kept.unlink()
    page = run_cells("import mnclab as mnc", f"mnc.exercise('{name}').editor()")
    page.set_viewport_size({"width": 1366, "height": 768})
    page.locator(".mnclab-editor .cm-content").wait_for(timeout=60_000)
    return page


def typed(page):
    """The text of the editor."""
    return "\n".join(page.locator(".mnclab-editor .cm-line").all_inner_texts())


def write(page, text):
    """Put a text into the editor in place of the old one."""
    page.locator(".mnclab-editor .cm-content").click()
    page.keyboard.press("Control+a")
    page.keyboard.insert_text(text)
    page.wait_for_timeout(1500)


def test_an_exercise_is_failed_mended_passed_and_begun_anew(run_cells, lab):
    _, folder = lab
    kept = folder / "progress.json"
    kept.unlink(missing_ok=True)
    page = run_cells("import mnclab as mnc", f"mnc.exercise('{NAME}').editor()")
    page.set_viewport_size({"width": 1366, "height": 768})
    page.locator(".mnclab-editor .cm-content").wait_for(timeout=60_000)
    write(page, WRONG)
    page.locator("button.mnclab-grade-box").click()
    told = page.locator(".mnclab-task-box")
    page.locator(".mnclab-task-box", has_text="not yet").wait_for(timeout=60_000)
    assert "its depth is not as drawn" in told.inner_text() and "line 3" in told.inner_text()
    box = page.locator(".mnclab-task-box li").first.bounding_box()
    assert box["y"] + box["height"] < 768 - 24  # above the line of states: the hint is read without scrolling
    write(page, MODEL)
    page.locator("button.mnclab-grade-box").click()
    page.locator(".mnclab-task-box", has_text="passed").wait_for(timeout=60_000)
    assert json.loads(kept.read_text())[NAME]["passed"] is True
    page = run_cells("import mnclab as mnc", "mnc.progress()")
    page.locator(".mnclab-map", has_text=f"{NAME} ✓").wait_for(timeout=60_000)
    kept.unlink()
    page = run_cells("import mnclab as mnc", "mnc.progress()")
    page.locator(".mnclab-map", has_text=f"{NAME} ○").wait_for(timeout=60_000)


def test_what_was_typed_is_taken_back_and_given_back(run_cells, lab):
    page = opened(run_cells, "mnc-02", lab[1])
    template = typed(page)
    page.locator(".mnclab-editor .cm-content").click()
    page.keyboard.press("Control+z")
    assert typed(page) == template != ""  # the text that it begins with stays
    page.keyboard.press("Control+a")
    page.keyboard.press("Delete")
    assert typed(page).strip() == ""
    page.keyboard.press("Control+z")
    assert typed(page) == template
    page.keyboard.press("Control+Shift+z")
    assert typed(page).strip() == ""
    for item in ("Undo", "Redo", "Undo"):
        page.get_by_role("menuitem", name="Edit", exact=True).click()
        page.locator(".lm-Menu-item[data-command*='editmenu']", has_text=item).click()
        page.wait_for_timeout(300)
        assert (typed(page) == template) == (item == "Undo")


def test_an_alarm_is_told_at_its_place_and_below_the_text(run_cells, lab):
    page = opened(run_cells, "mnc-05", lab[1])
    write(page, "G90 S500 M3\nG1 X4,5 F100\nM30")
    fault = page.locator(".mnclab-code .mnclab-alarm")
    fault.wait_for(timeout=30_000)
    assert page.locator(".mnclab-editor .cm-scroller").evaluate("each => each.scrollTop") == 0  # three lines are in sight
    page.locator(".mnclab-help", has_text="line 2: ").wait_for(timeout=10_000)
    fault.hover()
    page.locator(".mnclab-word", has_text="no part of a number").wait_for(timeout=10_000)


def test_editor_grade_and_part_are_in_one_view_beside_the_list_of_files(run_cells, lab):
    """The list of files takes 252 pixels of 1366."""
    page = opened(run_cells, NAME, lab[1])
    page.set_viewport_size({"width": 1366 - 252, "height": 768})
    write(page, WRONG)
    page.locator("button.mnclab-grade-box").click()
    page.locator(".mnclab-part-box img").wait_for(timeout=60_000)
    saved = page.get_by_text(f"{NAME}.mnc: saved")
    saved.wait_for(timeout=10_000)
    assert (lab[1] / f"{NAME}.mnc").read_text() == WRONG
    page.locator(".mnclab-live").first.evaluate("each => each.scrollIntoView({block: 'end'})")
    for part in (".mnclab-editor", ".mnclab-task-box", ".mnclab-part-box img"):
        box = page.locator(part).first.bounding_box()
        assert box["y"] > 30 and box["y"] + box["height"] < 768 - 24, part
    page.get_by_role("tab", name="drawing").click()
    image, sheets = page.locator(".mnclab-drawing-box img").bounding_box(), page.locator(".mnclab-sheets-box").bounding_box()
    assert image["x"] + image["width"] < sheets["x"] + sheets["width"] and image["height"] < 0.7 * 768
    write(page, MODEL)
    page.locator(".mnclab-task-box.mnclab-old").wait_for(timeout=10_000)  # a grade of the text before


def test_questions_stand_beside_their_program_and_nothing_is_said_of_a_control(run_cells, lab):
    page = opened(run_cells, "mnc-13", lab[1])
    assert page.locator(".mnclab-sheets-box .lm-TabBar-tab").all_inner_texts() == ["task"]
    page.set_viewport_size({"width": 1366 - 252, "height": 768})
    page.locator(".mnclab-live").first.evaluate("each => each.scrollIntoView({block: 'end'})")
    last = page.locator(".mnclab-exercise ol li").last.bounding_box()
    assert last["y"] + last["height"] < 768 - 24
    page.locator("button.mnclab-grade-box").click()
    page.locator(".mnclab-task-box", has_text="not answered").wait_for(timeout=60_000)
    assert not page.get_by_text("which control").is_visible()
    assert not page.locator(".mnclab-still").first.is_visible()


def test_a_class_of_thirty_is_seen_at_once(browser, tmp_path):
    names = [each.id for each in mnclab.exercises("tnc-620")][:31]
    marks = (Mark(f"Pupil {k} Longname-Surname", name, 0.93, k % 2 == 0) for k in range(30) for name in names)
    (tmp_path / "class.html").write_text(class_page(Marks(marks), "9 b"), "utf-8")
    page = browser.new_page(viewport={"width": 1366, "height": 768})
    page.goto((tmp_path / "class.html").as_uri())
    wide = page.evaluate("document.querySelector('.across').scrollWidth")
    heights = page.evaluate("[...document.querySelectorAll('.across tr')].map(row => row.offsetHeight)")
    assert wide <= 1366 and max(heights[1:]) < 32 and sum(heights[:20]) < 768  # a line each
    page.close()
