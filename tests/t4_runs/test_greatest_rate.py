"""The greatest removal rate is that in the material, whatever air is in the row: closed forms."""

import math

import pytest
from tools.together import deep_but_one_in

import mnclab
from mnclab import Limits, Setup, Tool

FAST = Limits(acceleration=1e9, rapid=1e6)


def most(text, control="mnc", kc=None, **setup):
    run = mnclab.run(text, control, Setup(limits=FAST, **setup))
    assert run.ok, run.alarms
    (cut,) = run.cutting_data(kc=kc)
    assert run.removal().largest.rate == pytest.approx(cut.rate[1])
    return cut


MILL = Tool(number=1, radius=5, teeth=2, cutting_length=40)


def milled(*lines, stock=((0, -20, -10), (100, 20, 0)), kc=None, tool=MILL):
    text = "G54 G17 G90 T1\nS1000 M3\nG0 X-10 Y0 Z5\n" + "\n".join(lines) + "\n"
    return most(text, kc=kc, stock=stock, tools={1: tool}, start=(0, 0, 100))


def test_a_slot_with_air_at_both_ends():
    """10 mm wide, 4 deep, 200 mm/min: 8 cm³/min in the 100 mm of the part, of a row of 120; Pc = Q kc / 60e6 kW."""
    cut = milled("G0 Z-4", "G1 X110 F200", kc=1800)
    assert cut.rate[1] == pytest.approx(8000, rel=0.01) and cut.power == pytest.approx(8000 * 1800 / 60e6, rel=0.01)


@pytest.mark.parametrize("length", [8, 12, 30, 60, 90])
def test_a_part_that_is_much_shorter_than_the_row(length):
    part = ((0, -20, -10), (length, 20, 0))
    assert milled("G0 Z-4", "G1 X110 F200", stock=part).rate[1] == pytest.approx(8000, rel=1e-3)


def test_a_wall():
    """1 mm thick: as the rim comes through, its chord 1 mm behind is in it, 2 √(25 - 16) = 6 wide; Q = 6 · 4 · 200."""
    assert milled("G0 Z-4", "G1 X110 F200", stock=((50, -20, -10), (51, 20, 0))).rate[1] == pytest.approx(4800, rel=0.03)


def test_a_block_that_is_left_in_a_long_slot():
    """20 of 1,200 mm, where the rows before have left a web: 10 · 4 · 2000, whatever air is before and behind it."""
    before = ["G0 Z-4", "G1 X515 F200", "G0 Z5", "G0 X1210", "G0 Z-4", "G1 X545", "G0 Z5", "G0 X-10", "G0 Z-4"]
    cut = milled(*before, "G1 X1210 F2000", stock=((0, -20, -10), (1200, 20, 0)))
    assert cut.rate[1] == pytest.approx(80000, rel=1e-3) and cut.width[1] == pytest.approx(10, abs=0.01)


@pytest.mark.parametrize("depth", [0.1, 0.5, 2, 5, 8])
def test_a_ball(depth):
    """The segment of a circle of 5 mm, and above the middle a slot."""
    low = min(depth, 5)
    area = 25 * math.acos(1 - low / 5) - (5 - low) * math.sqrt(10 * low - low * low) + 10 * (depth - low)
    ball = Tool(number=1, radius=5, corner=5, teeth=2, cutting_length=40)
    assert milled(f"G0 Z-{depth}", "G1 X110 F200", tool=ball).rate[1] == pytest.approx(200 * area, rel=0.01)


def test_a_round_corner():
    """3 mm deep with corners of 1 mm: 30 mm² but for what both leave of their squares."""
    tool = Tool(number=1, radius=5, corner=1, teeth=2, cutting_length=40)
    area = 30 - 2 * (1 - math.pi / 4)
    assert milled("G0 Z-3", "G1 X110 F200", tool=tool).rate[1] == pytest.approx(200 * area, rel=1e-3)


def test_a_ramp():
    """Down by 1 in 10, 6 deep at its end: 10 · 6 before it and the disc below it, v = (cos, sin) · 200."""
    share = 1 / math.hypot(10, 1)
    wanted = 200 * share * (10 * 10 * 6 + math.pi * 25)
    assert milled("G0 X20 Z0", "G1 X80 Z-6 F200").rate[1] == pytest.approx(wanted, rel=1e-3)


def test_down_a_helix():
    """1 mm a turn about a circle of 5 mm, that a mill of 10 mm clears to its middle: π 10² for each mm of Z; a turn is a row
    that comes round to where it has cut."""
    rows = [f"G2 X45 Y0 I5 J0 Z-{k}" for k in (1, 2, 3)]
    wanted = 200 * math.pi * 100 / math.hypot(1, 10 * math.pi)
    assert milled("G0 X45 Y0 Z0", "G1 F200", *rows).rate[1] == pytest.approx(wanted, rel=1e-3)


def test_facing_with_an_overlap():
    """D 50: first the 45 mm of Y-30 … 15, then 15 mm more; 1 mm deep at 600."""
    tool = Tool(number=1, radius=25, teeth=5, cutting_length=40)
    first, then = ["G0 X-40 Y-10", "G0 Z-1", "G1 X140 F600"], ["G0 Z5", "G0 X-40 Y20", "G0 Z-1", "G1 X140"]
    cut = milled(*first, *then, tool=tool, stock=((0, -30, -10), (100, 30, 0)))
    assert cut.rate[1] == pytest.approx(600 * 45, rel=0.01) and cut.width == pytest.approx([15, 45], abs=0.5)


def test_a_step_in_the_way():
    """A slot 2 deep before, then 4 deep across its end: 2 below the slot, the whole 4 beyond it."""
    assert milled("G0 Z-2", "G1 X50 F200", "G0 Z5", "G0 X-10", "G0 Z-4", "G1 X110").rate[1] == pytest.approx(
        8000, rel=0.01
    )


def test_half_the_width():
    """Along the edge of the blank, 5 of the 10 mm."""
    assert milled("G0 Y20 Z-4", "G1 X110 F200").rate[1] == pytest.approx(4000, rel=0.01)


@pytest.mark.parametrize("step", [5, 1, 0.2, *deep_but_one_in(2, [0.1, 0.05])])
def test_short_rows_in_a_slot(step):
    """10 · 4 · 200 however short its rows are: pieces of way shorter than a few cells are counted too roughly to be a rate."""
    rows = [f"X{x / 1000:.3f}" for x in range(20000, 40001, round(step * 1000))]
    assert milled("G0 Z-4", "G1 F200 X19", *rows).rate[1] == pytest.approx(8000, rel=0.03)


@pytest.mark.parametrize("count", deep_but_one_in(2, [600, 3200]))
def test_a_row_with_air_after_many_rows(count):
    """So many rows 1 mm deep beside it leave the slot 10 · 4 · 200, in the 100 mm of a row of 120."""
    rows = [f"X{5 + x / 50:.2f}" for x in range(count)]
    before = ["G0 Y-14 Z-1", "G1 X4 F200", *rows, "G0 Z5", "G0 X-10 Y5", "G0 Z-4"]
    assert milled(*before, "G1 X110").rate[1] == pytest.approx(8000, rel=0.03)


def test_a_drill_from_the_air():
    """π 10² / 4 at 100 mm/min: 7.854 cm³/min below the point, whatever way is above the hole."""
    text = "G54 G17 G90 T2\nS1000 M3\nG0 X50 Y0 Z20\nG1 Z-30 F100\nG0 Z20\n"
    drill = {2: Tool(number=2, kind="drill", radius=5, angle=118, teeth=2, cutting_length=60)}
    cut = most(text, stock=((0, -20, -40), (100, 20, 0)), tools=drill, start=(0, 0, 100))
    assert cut.rate[1] == pytest.approx(25 * math.pi * 100, rel=0.01)


def test_a_turning_pass_with_air_before_the_bar():
    """From R24 to R20 at 0.2 mm a turn, 1000 rev/min: π (24² - 20²) · 200 mm³/min in the 30 mm of a row of 60."""
    text = "M3 T1\nG97 S1000\nG95 F0.2\nG00 X20 Z30\nG01 Z-30\nG00 X40\n"
    setup = {"stock": mnclab.blank.cylinder(24, -60, 0), "start": (40, 0, 60)}
    assert most(text, "jnc-t01", **setup).rate[1] == pytest.approx(math.pi * (24**2 - 20**2) * 200, rel=0.01)


def test_a_feed_is_judged_by_the_axis_that_moves():
    """2500 rev/min at 3 mm: 7500 mm/min along Z, which goes 8000 on the old lathe; X goes 5000."""
    text = "M3\nG97 S2500 T1\nG00 X10 Z50\nG32 {}\nG00 X15\nM5\n"
    setup = Setup(limits="old-lathe")
    for way, beyond in (("Z-20 F3", ()), ("Z-20 F3.3", ("vf above 8000",)), ("X30 F3", ("vf above 5000",))):
        found = mnclab.run(text.format(way), "jnc-t01", setup).cutting_data()
        assert [cut.beyond for cut in found] == [beyond], way
        assert ("X 5000, Z 8000 mm/min" in repr(found)) == (not beyond)
    both = mnclab.run("M3\nG97 S2500 T1\nG00 X0 Z50\nG32 X-100 Z-50 F6\n", "jnc-t01", setup).cutting_data()
    assert both[0].beyond == ("vf above 5000", "vf above 8000")  # 15,000 along the way, 10,607 along each


def test_a_plunge_of_a_mill_counts():
    """π 10² / 4 · 300 going down beats the slot's 10 · 4 · 200; Pc = Q kc / 60e6. Speeds and widths stay those of the slot."""
    cut = milled("G0 X30", "G1 Z-4 F300", "X60 F200", kc=1800)
    assert cut.rate[1] == pytest.approx(25 * math.pi * 300, rel=0.01) and cut.feed == (200, 200)
    assert cut.power == pytest.approx(cut.rate[1] * 1800 / 60e6)


def test_the_feed_of_a_plunge_is_judged():
    """300 mm/min down where Z goes 250, and a slot at 200."""
    text = "G54 G17 G90 T1\nS1000 M3\nG0 X30 Y0 Z5\nG1 Z-4 F300\nX60 F200\n"
    tools = {1: Tool(number=1, radius=5, teeth=2, cutting_length=40, centre_cutting=True)}
    limits = Limits(rapid=(1e4, 1e4, 250))
    run = mnclab.run(text, "mnc", Setup(tools=tools, stock=((0, -20, -10), (100, 20, 0)), limits=limits, start=(0, 0, 100)))
    assert run.cutting_data()[0].beyond == ("vf above 250",)
