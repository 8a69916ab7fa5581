"""Removal over time: volumes of slots over the times of their moves, by tool and line."""

from pathlib import Path

import numpy as np
import pytest

import mnclab
from mnclab import Limits, Setup, Tool
from mnclab.text.alarm import Alarm

TOOLS = {1: Tool(radius=8, name="end mill 16", kind="mill"), 2: Tool(radius=5, name="end mill 10", kind="mill")}
SLOTS = """T1 M6
S1000 M3
G43 G0 X-10 Y12 Z5
G0 Z-4
G1 X70 F300
G0 Z5
T2 M6
G43 G0 X-10 Y32 Z5
G0 Z-2
G1 X70 F600
G0 Z50
"""
WIDE, NARROW = 60 * 16 * 4, 60 * 10 * 2  # mm³
EXACT = 1e-3  # of a volume
FAST = Limits(rapid=1e6, acceleration=1e9)  # a cut takes its length over its feed


@pytest.fixture(scope="module")
def slots():
    return mnclab.run(SLOTS, "g43", Setup(tools=TOOLS, stock=((0, 0, -20), (60, 40, 0))))


def test_volumes_by_line_and_tool(slots):
    removal = slots.removal(FAST)
    assert removal.by("line") == pytest.approx({5: WIDE, 10: NARROW}, rel=EXACT)
    assert removal.by("tool") == pytest.approx({1: WIDE, 2: NARROW}, rel=EXACT)
    assert sum(removal.by("tool").values()) == pytest.approx(removal.volume)
    assert removal.volume == pytest.approx(slots.workpiece().removed)


def test_the_rate_is_the_volume_over_the_time_of_its_move(slots):
    """80 mm at 300 are 16 s, at 600 they are 8 s; of the wide one 60 mm are in the part: 16 · 4 · 300 = 19200 mm³/min there."""
    removal = slots.removal(FAST)
    assert removal.time == pytest.approx(24, rel=1e-3)
    assert removal.mean == pytest.approx((WIDE + NARROW) / 24 * 60, rel=EXACT)
    assert removal.rate.max() == pytest.approx(WIDE / 16 * 60, rel=EXACT)
    assert removal.largest.rate == pytest.approx(16 * 4 * 300, rel=EXACT)
    assert (removal.largest.line, removal.largest.program) == (5, 0)
    assert slots.toolpath.line[removal.largest.row] == 5
    cuts = np.isin(slots.toolpath.line, (5, 10)) & slots.toolpath.is_motion
    assert np.flatnonzero(removal.rate).tolist() == np.flatnonzero(cuts).tolist()


def test_a_slower_machine_takes_away_less_a_minute(slots):
    slow = slots.removal(Limits(rapid=1000, acceleration=10))
    assert slow.volume == slots.removal(FAST).volume and slow.mean < slots.removal(FAST).mean


def test_a_called_program_has_its_own_lines():
    called = mnclab.run(
        "BEGIN PGM A MM\nBLK FORM 0.1 Z X+0 Y+0 Z-20\nBLK FORM 0.2 X+60 Y+40 Z+0\nTOOL CALL 1 Z S1000\n"
        "L X-10 Y+12 Z+5 R0 FMAX M3\nCALL PGM B\nL Z+50 R0 FMAX\nEND PGM A MM\n",
        "tnc-620",
        Setup(tools=TOOLS, files={"B.H": "BEGIN PGM B MM\nL Z-4 R0 FMAX\nL X+70 R0 F300\nEND PGM B MM\n"}),
    )
    assert called.ok, called.alarms
    removal = called.removal(FAST)
    assert removal.by("line") == pytest.approx({(1, 3): WIDE}, rel=EXACT)
    assert "line 1:3" in repr(removal)


def test_the_table_has_a_row_for_each_tool_and_one_for_all(slots):
    rows = slots.removal(FAST).rows()
    assert [row[0] for row in rows] == ["T1 end mill 16", "T2 end mill 10", "all"]
    assert [row[2] for row in rows] == ["16.00 s", "8.00 s", "24.00 s"]
    assert [row[-1] for row in rows] == ["5", "10", "5"]
    assert [len({row[k].split()[1] for row in rows}) for k in (1, 3, 4)] == [1, 1, 1], "a column has one unit"


def test_a_program_that_cuts_nothing():
    removal = mnclab.run("G0 X10 Y10 Z5\n", "g43", Setup(stock=((0, 0, -20), (60, 40, 0)))).removal()
    assert (removal.volume, removal.time, removal.mean, removal.largest) == (0, 0, 0, None)
    assert removal.plot().axes


def test_what_it_cannot_sum_over(slots):
    with pytest.raises(Alarm, match="what a removal sums over"):
        slots.removal().by("colour")


def test_the_picture_has_the_rates(slots):
    removal = slots.removal(FAST)
    feed, rate = removal.plot().axes
    line = rate.lines[0].get_xydata()
    assert line[:, 1].max() == removal.rate.max() and rate.get_ylim()[1] > removal.largest.rate
    assert "line 5: " in rate.texts[0].get_text()
    assert feed.get_xlim() == rate.get_xlim()


def test_a_rapid_in_material_does_not_set_the_scale():
    text = "G17 G90 G54\nT1 M6 S2000 M3\nG0 X-10 Y10 Z-4\nG0 X70\nG0 Y30\nG1 X-10 F300\nG0 Z50\n"
    setup = Setup(tools=TOOLS, stock=((0, 0, -20), (60, 40, 0)), start=(-10, 10, 50))
    removal = mnclab.run(text, "g43", setup).removal(FAST)
    assert removal.rate.max() > 10 * removal.largest.rate and removal.largest.line == 6
    assert removal.mean == pytest.approx(removal.largest.rate * 60 / 80, rel=EXACT)  # of 80 mm 20 are in air
    _, rate = removal.plot().axes
    assert 1.1 < rate.get_ylim()[1] / removal.largest.rate < 1.5  # with room for what is told of the rapids
    assert f"rapids reach {removal.rate.max():.0f} mm³/min" in rate.texts[0].get_text()


# --- sums agree in every view ------------------------------------------------------------------------------------------

CROSSED = (
    "T1 M6\nS1000 M3\nG43 G0 X-10 Y20 Z5\nG0 Z-4\nG1 X70 F300\nG0 Z5\nG0 X30 Y-10\nG0 Z-6\nG1 Y52\nG0 Z5\nG0 X15 Y10\nG1 Z-3\n"
    "G3 I7 F200\nT2 M6\nS1000 M3\nG0 X45 Y30 Z5\nG1 Z-9 F100\nG0 Z50\n"
)


def crossed():
    tools = {1: mnclab.Tool(number=1, radius=5, kind="mill"), 2: mnclab.Tool(number=2, radius=3, kind="drill", angle=118)}
    return mnclab.run(CROSSED, "g43", mnclab.Setup(tools=tools, stock=((0, 0, -20), (60, 40, 0))))


def shaft():
    root = Path(__file__).parents[2] / "data"
    return mnclab.run(root / "programs/jnc-t01/shaft.jnc", setup=root / "setups/jnc-t01/shaft.toml")


@pytest.mark.parametrize("way", ["exact", "erosion", "lathe"])
def test_what_was_removed_up_to_a_line_is_the_sum_over_the_lines_before(way, monkeypatch):
    if way == "erosion":
        monkeypatch.setattr("mnclab.workpiece.milling.milled.EXACT", 3)
    run = shaft() if way == "lathe" else crossed()
    part = run.workpiece()
    assert way != "erosion" or part.many
    for what in ("line", "tool", "row"):
        assert sum(part.removed_by(what).values()) == pytest.approx(part.removed, rel=1e-9)
    upto = part.removed_by_row().cumsum()
    for row in range(0, len(run.toolpath), 3):
        before = run.workpiece(row=row)
        assert before.removed == pytest.approx(upto[row], rel=1e-9, abs=1e-9)
        assert sum(before.removed_by("tool").values()) == pytest.approx(before.removed, rel=1e-9, abs=1e-9)
    lines, total = run.toolpath.line, part.removed_by("line")
    assert len(run.steps.block) <= len(run.program)  # each line runs once
    for line in dict.fromkeys(lines.tolist()):
        told = sum(volume for each, volume in total.items() if each <= line)
        assert run.workpiece(line=line).removed == pytest.approx(told, rel=1e-9, abs=1e-9)


def test_the_first_slot_of_crossed_ones_is_as_large_as_alone():
    """60 x 10 x 4 mm³, whatever comes after it; the second takes 10 x 6 over 40 less what the first took of it, 10 x 10 x 4."""
    run = crossed()
    assert run.workpiece(line=5).removed == pytest.approx(2400, rel=1e-3)
    assert run.workpiece(line=9).removed == pytest.approx(2400 + 2400 - 400, rel=1e-3)
