"""How long forms, the editor and the player take to answer; printed, since no machine is alike."""

import random
from math import cos, sin
from pathlib import Path
from statistics import median

import pytest

import mnclab

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


PROGRAMS = Path(__file__).parent.parent.parent / "data" / "programs"
OPENED = """async () => {  // milliseconds from the start of the page to its first picture
    const frame = () => new Promise(requestAnimationFrame);
    while (!window.player) await frame();
    await frame();
    await frame();
    return performance.now();
}"""
SEEK = """() => {  // milliseconds of a jump to another block, written and drawn: the middle and the longest of 15
    const p = window.player, times = [];
    for (let k = 0; k < 15; k++) {
        const begin = performance.now();
        p.go(p.afterItem(Math.floor((k * 0.61803 % 1) * (p.run.items - 1))));
        p.draw();
        p.find("picture").getContext("2d").getImageData(1, 1, 1, 1);  // waits until all is drawn
        times.push(performance.now() - begin);
    }
    times.sort((a, b) => a - b);
    return [times[7], times[14]];
}"""
PLAYED = """async view => {  // frames a second while it plays for three seconds, so fast that half of the program passes
    const p = window.player, frame = () => new Promise(requestAnimationFrame);
    const button = [...p.find("views").children].find(each => each.dataset.view === view);
    button.click();
    p.go(p.atTime(p.run.time * 0.3));
    const speed = p.find("speed"), option = new Option("test", p.run.time / 6);
    speed.append(option);
    speed.value = option.value;
    await frame();
    p.play(1);
    const begin = performance.now();
    let frames = 0;
    while (performance.now() - begin < 3000) frames += (await frame(), 1);
    p.stop();
    return frames / 3;
}"""


def surface(moves):
    """A program of short cutting moves, as a finished surface has them: rows along X over a wave."""
    rows, along = divmod(moves, 500)[0], range(500)
    places = ((k if row % 2 else 499 - k, row) for row in range(rows) for k in along)
    blocks = (f"G1 X{k / 5:.3f} Y{row / 2:.3f} Z{-5 + 4 * sin(k / 60) * cos(row / 40):.3f}" for k, row in places)
    return "G90 G54 T1 S3000 M3 F1500\nG0 X0 Y0 Z10\n" + "\n".join(blocks) + "\n"


def scattered(moves):
    """A program of cutting moves to places by lot."""
    lot = random.Random(1)
    places = (f"G1 X{lot.uniform(0, 100):.3f} Y{lot.uniform(0, 80):.3f}" for _ in range(moves))
    return "G90 G54 T1 S3000 M3 F1500\nG0 X0 Y0 Z-1\n" + "\n".join(places) + "\n"


@pytest.mark.parametrize("name", ["tnc-620/pockets.h", "mnc/one_part.mnc", "jnc-t01/shaft.jnc", "20,000 by lot", "100,000 rows"])
def test_the_player_keeps_pace(browser, tmp_path, name):
    """Opening, seeking and playing of a page from disk, at 1366 × 768."""
    made = {"20,000 by lot": lambda: scattered(20_000), "100,000 rows": lambda: surface(100_000)}
    run = mnclab.run(made[name](), "mnc") if name in made else mnclab.run(PROGRAMS / name)
    path = run.save(tmp_path / "page.html")
    page = browser.new_page(viewport={"width": 1366, "height": 768})
    page.goto(path.as_uri())
    opened, (middle, longest) = page.evaluate(OPENED), page.evaluate(SEEK)
    views = ("front" if name.endswith("jnc") else "top", "isometric")
    frames = {view: page.evaluate(PLAYED, view) for view in views}
    assert middle > 0 and min(frames.values()) > 0
    told = ", ".join(f"{view} {rate:.0f}" for view, rate in frames.items())
    print(f"{name}: {path.stat().st_size / 1000:.0f} kB, opened in {opened:.0f} ms, a jump {middle:.0f} ms "
          f"({longest:.0f} at most); frames a second {told}")  # fmt: skip
    page.close()
