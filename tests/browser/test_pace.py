"""How long a form and the editor take from the last key to the new picture; printed, since no machine is alike."""

from statistics import median

import pytest

WATCH = """selector => {
    const whole = () => { const image = document.querySelector(selector + ' img'); return image?.src || ''; };
    window.paced = new Promise(done => {
        const before = whole();
        const wait = () => requestAnimationFrame(() => whole() && whole() !== before ? done(performance.now()) : wait());
        wait();
    });
    document.addEventListener('keydown', () => { window.pressed = performance.now(); }, true);
}"""
CUT = "G1 X{} Y{} F300\n"
TIMES = 7


def pace(page, selector, keys):
    """Milliseconds from a key to another picture, of several keys one after another."""
    taken = []
    for key in keys:
        page.evaluate(WATCH, selector)
        page.keyboard.press(key)
        taken.append(page.evaluate("async () => (await window.paced) - window.pressed"))
        page.wait_for_timeout(400)
    return taken


@pytest.mark.parametrize(("code", "control", "field"), [
    ("CYCL DEF 251", "tnc-620", "Q218 first side length [mm]"),
    ("G303", "mnc", "L"), ("G83", "mnc", "X"),
])  # fmt: skip
def test_a_form_follows_its_fields(run_cells, code, control, field):
    page = run_cells(f"import mnclab as mnc\nmnc.form({code!r}, {control!r})")
    box = page.get_by_role("spinbutton", name=field).first
    box.focus()
    taken = pace(page, ".mnclab-drawn", ["ArrowUp"] * TIMES)
    assert len(taken) == TIMES
    print(f"form of {code}: {median(taken):.0f} ms from a key to the picture, {max(taken):.0f} at most")


def test_the_editor_follows_its_text(run_cells, lab):
    blocks = "".join(CUT.format(k % 40, k % 23) for k in range(498))
    (lab[1] / "long.mnc").write_text("G90 G54 T1 S500 M3\nG0 X0 Y0 Z5\n" + blocks)
    page = run_cells("import mnclab as mnc\nmnc.editor('long.mnc')")
    page.get_by_role("textbox", name="part program").click()
    page.keyboard.press("Control+End")
    page.keyboard.type("G1 X5")
    page.wait_for_timeout(2000)
    taken = pace(page, ".mnclab-picture", ["1", "2", "3", "Backspace", "Backspace", "Backspace", "7"])
    assert len(taken) == TIMES
    print(f"editor of 500 blocks: {median(taken):.0f} ms from a key to the picture, {max(taken):.0f} at most")
