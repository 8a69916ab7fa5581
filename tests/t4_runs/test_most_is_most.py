"""What is called most is the most: random programs, of which every row is looked at here, against those that are judged by
their bounds; and closed forms."""

import math
import random

import numpy as np
import pytest
from tools.together import deep_but_one_in

import mnclab
from mnclab import Limits, Setup, Tool
from mnclab.workpiece.ahead import CHIP, DEPTH, FEW, RATE, WIDTH, Looks

FAST = Limits(acceleration=1e9, rapid=1e6)
BLANK = ((0, 0, -20), (60, 50, 0))


def every_row(run):
    """The values and bounds (4, k) of all rows of the one tool, however many; and the rows (k,)."""
    removal = run.removal()
    (looks,) = removal.looks.values()
    full = Looks(looks.rows, looks.part, looks.speed, removal._highest[looks.rows])
    full.left = 10**9
    full.look(np.arange(len(full.rows)))
    assert full.seen.all()
    return full.values, full.bounds, full.rows


def checked(run, teeth=None):
    """The one tool of a run: nothing passes its bound, and each most is the greatest of all rows or says that it is not."""
    (cut,) = run.cutting_data()
    values, bounds, rows = every_row(run)
    assert (values <= bounds * (1 + 1e-9) + 1e-9).all()
    path = run.toolpath
    along = np.abs(path.end - path.start)[rows, 2]
    sideways = (path.lengths[rows] > 2 * along) | path.lathe
    assert sideways.any()
    assert "rate" in cut.open or cut.rate[1] >= values[RATE].max() * (1 - 1e-9)
    for name, what in (("depth", DEPTH), ("width", WIDTH)):
        found = getattr(cut, name)
        if found is not None:
            most = values[what][sideways].max()
            assert (found[1] == pytest.approx(most)) if name not in cut.open else found[1] <= most * (1 + 1e-9)
    if cut.chip is not None and "chip" not in cut.open:
        feed = path.feed[rows] / np.abs(path.spindle[rows]) / teeth
        assert cut.chip[1] == pytest.approx((values[CHIP] * feed)[sideways].max())
    return cut


MILLS = {
    "end mill": Tool(number=1, radius=4, teeth=2, cutting_length=40),
    "ball": Tool(number=1, radius=4, corner=4, teeth=2, cutting_length=40),
    "round corner": Tool(number=1, radius=4, corner=1, teeth=2, cutting_length=40),
}


def milled(lines, tool, limits=FAST, stock=BLANK):
    text = "G54 G17 G90 T1\nS1000 M3\nG0 X-10 Y-10 Z5\nG1 F300\n" + "\n".join(lines) + "\n"
    run = mnclab.run(text, "mnc", Setup(limits=limits, tools={1: tool}, stock=stock, start=(0, 0, 100)))
    assert run.ok, run.alarms
    return run


def layers(rng):
    """Layers of one contour of lines and arcs, there and back, with a ramp here and a plunge there."""
    contour = [(rng.uniform(0, 60), rng.uniform(0, 50)) for _ in range(rng.randint(4, 8))]
    z, lines = 0.0, []
    for layer in range(rng.randint(2, 3)):
        z -= rng.uniform(0.5, 3)
        first, *others = contour if layer % 2 else contour[::-1]
        lines += ["G0 Z5", f"G0 X{first[0]:.3f} Y{first[1]:.3f}", f"G1 Z{z:.3f} F{rng.choice((100, 200))}"]
        for x, y in others:
            feed, radius = rng.choice((200, 300, 500)), rng.uniform(40, 90)
            bent = rng.random() < 0.3
            lines.append(
                f"{rng.choice(('G2', 'G3')) if bent else 'G1'} X{x:.3f} Y{y:.3f}{f' R{radius:.3f}' * bent} F{feed}"
            )
        if rng.random() < 0.5:
            lines.append(f"G1 X{rng.uniform(0, 60):.3f} Y{rng.uniform(0, 50):.3f} Z{z - rng.uniform(0, 2):.3f}")
    return [*lines, "G0 Z5"]


@pytest.mark.parametrize("kind", deep_but_one_in(3, MILLS))
def test_random_layers(kind):
    checked(milled(layers(random.Random(f"{kind} 0")), MILLS[kind]), 2)


@pytest.mark.deep
@pytest.mark.parametrize("kind", MILLS)
@pytest.mark.parametrize("seed", range(1, 20))
def test_more_random_layers(kind, seed):
    rng = random.Random(f"{kind} {seed}")
    checked(milled(layers(rng), MILLS[kind], FAST if seed % 2 else Limits()), 2)


def turned(rng):
    """Passes of a bar at several depths: along, across, up a taper and round an arc."""
    lines, x = ["M3 T1", f"G97 S{rng.choice((500, 900))}", "G95 F0.2"], 24.0
    for _ in range(rng.randint(3, 6)):
        x -= rng.uniform(0.3, 1.5)
        z = -rng.uniform(8, 40)
        lines += ["G00 Z2", f"G00 X{x:.3f}", f"G01 Z{z:.3f} F{rng.choice((0.1, 0.2))}"]
        lines += [f"G01 X{x + rng.uniform(1, 5):.3f} Z{z - rng.uniform(2, 9):.3f}"] * (rng.random() < 0.7) + ["G00 X30"]
    return "\n".join([*lines, "G00 Z5"]) + "\n"


def on_lathe(text, stock=None, **more):
    setup = Setup(start=(40, 0, 20), stock=stock or mnclab.blank.cylinder(24, -60, 0), limits=FAST, **more)
    run = mnclab.run(text, "jnc-t01", setup)
    assert run.ok, run.alarms
    return run


@pytest.mark.parametrize("seed", range(4))
def test_random_passes_of_a_lathe(seed):
    checked(on_lathe(turned(random.Random(seed))))


def test_a_deep_row_among_many_shallow_ones():
    """Of 220 rows of a slot 8 wide and 2 deep at 500 three go down to 4 for 0.3 mm: no choice of 60 rows need find them."""
    lines = ["G0 X-10 Y25", "G0 Z-2", "G1 F500"]
    for k in range(220):
        x = 70 * (k + 1) / 220
        down = f"G1 X{x + 0.1:.3f} Z-4", f"G1 X{x + 0.2:.3f}", f"G1 X{x + 0.3:.3f} Z-2"
        lines += [f"G1 X{x:.3f}", *(down if k == 101 else ())]
    cut = checked(milled(lines, MILLS["end mill"]), 2)
    assert cut.depth[1] == pytest.approx(4) and cut.open == ()


def test_a_slot_in_short_rows():
    """8 wide, 2 deep at 500: 8 cm³/min and the whole width; few rows prove it, for none can have more."""
    run = milled(["G0 X-10 Y25", "G0 Z-2", "G1 F500", *(f"G1 X{0.25 * k:.2f}" for k in range(280))], MILLS["end mill"])
    (cut,) = run.cutting_data()
    assert cut.rate[1] == pytest.approx(8000, rel=1e-3) and cut.width[1] == pytest.approx(8, rel=1e-3)
    (looks,) = run.again(run.setup).removal().looks.values()  # of a run of which nothing else was asked
    assert looks.seen.sum() <= 2 * FEW < len(looks.rows)


def slot(tool, depth, step=None):
    """One slot in X at 300 mm/min; or the pass a step beside it, after it."""
    lines = ["G0 X-10 Y10", f"G0 Z-{depth}", "G1 X70"]
    if step is not None:
        lines += ["G0 Z5", f"G0 X-10 Y{10 + step}", f"G0 Z-{depth}", "G1 X70"]
    (cut,) = milled(lines, tool).cutting_data()
    return cut


@pytest.mark.parametrize("depth", [0.1, 1, 2.5, 4, 6])
def test_the_width_of_a_ball_is_that_of_its_cap(depth):
    """2 √(ap (D - ap)), the effective diameter, and D above the middle."""
    cut, wide = slot(MILLS["ball"], depth), 8 if depth > 4 else 2 * math.sqrt(depth * (8 - depth))
    assert cut.depth == pytest.approx([depth] * 2, abs=1e-6) and cut.width == pytest.approx([wide] * 2, rel=0.02)


@pytest.mark.parametrize("depth", [0.2, 1, 3])
def test_the_width_of_a_round_corner(depth):
    """D - 2 r + 2 √(ap (2 r - ap)) up to the corner, then D; the chip has no one thickness, and the table says why."""
    cut, wide = slot(MILLS["round corner"], depth), 8 if depth >= 1 else 6 + 2 * math.sqrt(depth * (2 - depth))
    assert cut.depth == pytest.approx([depth] * 2, abs=1e-6) and cut.width == pytest.approx([wide] * 2, rel=0.01)
    assert cut.chip is None


@pytest.mark.parametrize("step", [0.5, 1.5, 3])
def test_the_width_beside_a_pass_is_the_step(step):
    cut = slot(MILLS["ball"], 2, step)
    assert cut.width[0] == pytest.approx(step, abs=0.1) and cut.depth == pytest.approx([2, 2], abs=1e-6)


@pytest.mark.parametrize("y", [-4, -2, 0, 1.234, 2, 3.5])
def test_a_side_cut_is_exact(y):
    """The blank ends at Y0: ae = R + y, engaged over acos(1 - ae / R), where the chip is fz ae / R over the angle thick."""
    way = f"G54 G17 G90 T1 S1000 M3\nG0 X-20 Y{y} Z5\nG0 Z-4\nG1 X80 F300\nG0 Z20\n"
    run = mnclab.run(way, "mnc", Setup(tools={1: Tool(diameter=10, number=1, teeth=2)}, stock=BLANK))
    (cut,), width = run.cutting_data(), 5 + y
    assert cut.depth[1] == pytest.approx(4, abs=1e-9) and cut.width[1] == pytest.approx(width, abs=1e-4)
    assert cut.rate[1] == pytest.approx(4 * width * 300, rel=1e-4)
    assert cut.chip[1] == pytest.approx(0.15 * width / 5 / math.acos(1 - width / 5), rel=1e-4)


def test_why_there_is_no_chip_of_a_ball():
    run = milled(["G0 X-10 Y10", "G0 Z-2", "G1 X70"], MILLS["ball"])
    assert "hm of T1 is empty" in repr(run.cutting_data()) and "hm" not in run.cutting_data().table()[0]


def test_a_taper_into_a_step():
    """An edge of 90° from R24 down to R20 at Z-20 and straight out: across the way ap grows to 4 cos of the taper, and a chip
    is a turn long: it is that of 0.2 mm before."""
    tool = Tool(number=1, kind="turning", main_angle=90, auxiliary_angle=30)
    text = "M3 T1\nS500 G97\nG95 F0.2\nG00 X24 Z0\nG01 X20 Z-20\nG00 X40\n"
    cut, way = checked(on_lathe(text, tools={1: tool})), math.hypot(20, 4)
    assert cut.depth[1] == pytest.approx(4 * 20 / way * (1 - 0.2 / way), rel=1e-3)


def test_very_many_moves_are_looked_at_too(monkeypatch):
    """A slot 8 wide, 1 deep and then 2, at 500: the plunge between them takes away most, π 4² · 500."""
    monkeypatch.setattr("mnclab.workpiece.milling.milled.EXACT", 500)
    rows = [f"G1 X{0.05 * k:.4f} Z-{1 if k < 500 else 2}" for k in range(700)]
    run = milled(["G0 X-10 Y25", "G0 Z-1", "G1 X0 F500", *rows, "G1 X55"], MILLS["end mill"])
    assert run.workpiece().many
    (cut,) = run.cutting_data()
    assert "rate" not in cut.open and cut.rate[1] == pytest.approx(16 * math.pi * 500, rel=0.03)
    assert cut.width[1] == pytest.approx(8, rel=1e-3) and cut.depth[1] == pytest.approx(2)
    monkeypatch.setattr("mnclab.runs.material.MOVES", 500)
    assert "Of more than 500 moves" in repr(run.cutting_data())


def test_where_looking_ends_it_says_at_least(monkeypatch):
    monkeypatch.setattr("mnclab.workpiece.ahead.LOOKS", 30)
    run = milled(layers(random.Random(1)), MILLS["end mill"])
    data = run.cutting_data()
    assert "rate" in data[0].open and "at least" in data.rows()[0][-1] + repr(data) and "At least" in data._repr_html_()
    assert "at least" in repr(run.removal()) and "at least" in run.removal().rows()[0][4]
