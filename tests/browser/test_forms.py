"""What people see and touch: a picture with a name, number boxes that redraw it."""

PANEL = """
import mnclab as mnc
mnc.panel("G90 G54\\nG0 X0 Y0 Z5\\nG1 X{side} F{feed}\\nY{side}\\n", "mnc", side=40.0, feed=100.0)
"""


def test_a_run_shows_its_picture_without_pyplot(run_cells):
    page = run_cells("import mnclab as mnc\nmnc.run('G0 X1 Y3\\nG1 X4 F100\\n', 'mnc').plot()")
    page.get_by_role("img", name="tool path: 2 moves, X 0 to 4, Y 0 to 3 mm").wait_for(timeout=5000)


def test_a_number_box_redraws_the_picture_and_says_the_alarm(run_cells):
    page = run_cells(PANEL)
    side = page.get_by_role("spinbutton", name="side")
    side.fill("25")
    side.press("Enter")
    page.get_by_role("img", name="X 0 to 25, Y 0 to 25").wait_for(timeout=5000)
    feed = page.get_by_role("spinbutton", name="feed")
    feed.fill("0")
    feed.press("Enter")
    page.get_by_role("alert").filter(has_text="F (feed rate) must be greater than 0").wait_for(timeout=5000)


def test_a_form_has_named_boxes_and_follows_them(run_cells):
    page = run_cells("import mnclab as mnc\nmnc.form('G83', 'mnc')")
    bottom = page.get_by_role("spinbutton", name="Z bottom of the hole [mm]")
    bottom.fill("-33")
    bottom.press("Enter")
    page.get_by_role("img", name="Z -33 to 20 mm").wait_for(timeout=5000)
    page.get_by_role("checkbox", name="write K").uncheck()
    page.get_by_text("G83 X20 Y10 Z-33 R2 P0.5 F120 G80").wait_for(timeout=5000)
