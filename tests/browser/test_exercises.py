"""An exercise in JupyterLab: fail, read the hint, mend, pass, see it on the map, begin anew."""

import json

import mnclab
from mnclab.learning.answers import answers_of
from mnclab.learning.marking import Mark, Marks, class_page

NAME = "mnc-07"
MODEL = answers_of(mnclab.exercise(NAME).file).model
WRONG = MODEL.replace("Z-5", "Z-4", 1)


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
