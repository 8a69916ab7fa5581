"""Feeds and speeds in the rows: constant cutting speed, times, feeds per revolution, threads."""

import math

import numpy as np
import pytest
from tools.running import run

from mnclab import Kind, Limits

EASY = Limits(acceleration=1e9, rapid=1e9)


def obeyed(*blocks, start=(50, 0), **setup):
    return run("\n".join(blocks), "jnc-t01", ok=None, start=(start[0], 0, start[1]), **setup)


def turns(path):
    """Turns of each row by its columns: the mean feed takes so long, and this is the way of a turn."""
    return path.lengths / path.per_rev


def test_facing_at_constant_cutting_speed():
    """100 m/min, 0.2 mm/rev from radius 50 to 10: a turn at x takes 2 π x / 100 000 min, 5 turns a millimetre."""
    found = obeyed("G96 S100 M3", "G95 F0.2", "G1 X10")
    row = found.toolpath[-1]
    minutes = math.pi * (50**2 - 10**2) / 100_000 / 0.2
    assert (row.surface, row.per_rev, row.speed_limit, row.spindle_x) == (100, 0.2, 3000, 0)
    assert row.spindle == pytest.approx(1000 * 100 / (2 * math.pi * 10))
    assert 40 / row.feed == pytest.approx(minutes, rel=1e-12)
    assert found.profile(EASY).time == pytest.approx(60 * minutes, rel=1e-6)
    assert found.history.value("speed", 0) == pytest.approx(1000 * 100 / (2 * math.pi * 50))


def test_an_arc_at_constant_cutting_speed():
    """A quarter circle about (30, 0) from radius 50 to 30: the mean radius is 30 + 20 · 2 / π."""
    found = obeyed("G96 S100 M3", "G95 F0.2", "G2 X30 Z20 I-20")
    row = found.toolpath[-1]
    assert found.ok and row.kind == Kind.ARC and abs(row.sweep) == pytest.approx(math.pi / 2)
    turn = 2 * math.pi * (30 + 40 / math.pi) / 100_000
    assert 0.2 / row.feed == pytest.approx(turn, rel=1e-4)


def test_the_speed_limit_is_a_setting():
    row = obeyed("G96 S100 M3", "G0 X0", settings={"max_spindle_speed": 1200}).toolpath[-1]
    assert row.spindle == row.speed_limit == 1200


def test_the_axis_is_at_x0_of_the_program():
    """G92 X10 puts X0 to base X10: there the tool at base X50 is 40 off the axis."""
    path = obeyed("G96 S100 M4", "G92 X10", "X20").toolpath
    assert path[1].kind == Kind.SPINDLE and path[1].spindle == pytest.approx(-1e5 / (2 * math.pi * 40))
    assert path[2].spindle == pytest.approx(-1e5 / (2 * math.pi * 20)) and path[2].spindle_x == 10
    shifted = obeyed("L1 G96 S100 M3", "X20", correctors={1: (0.5, 0, 0)}).toolpath[-1]
    assert shifted.end[0] == 20.5 and shifted.spindle == pytest.approx(1e5 / (2 * math.pi * 20))


def test_from_one_way_of_speed_to_the_other():
    """G97 without S keeps the speed of the moment; G96 without S takes the last cutting speed; before any S it is 0."""
    path = obeyed("M3 S500", "G96", "S100", "G0 X25", "G97", "X50", "G96", "G97 S700").toolpath
    assert path.spindle == pytest.approx(
        [500, 0, 1e5 / (2 * math.pi * 50), *[1e5 / (2 * math.pi * 25)] * 2, 1e5 / (2 * math.pi * 50), 700]
    )
    assert np.isnan(path.surface).tolist() == [True, False, False, False, True, False, True]


CUTS = ["G1 X40", "G95 F0.2 G1 X40", "G2 X30 Z20 I-20", "G12 Z-80 R10", "G32 Z-30 F2", "G73 Z-20 D5", "G74 X30 Z-20 D2"]


@pytest.mark.parametrize("cut", CUTS)
@pytest.mark.parametrize("before", ["", "S500 M3", "G97 S500 M3"])
def test_g96_without_any_cutting_speed_is_named_there(cut, before):
    """The S of G97 is no cutting speed; S may still come in a block of its own, as long as nothing is cut before it."""
    lines = (before or "G90", "G96", "G0 X45", "F50", cut)
    alarm = obeyed(*lines).alarms[-1]
    assert (alarm.severity, alarm.span[:3]) == ("alarm", (2, 1, 3))
    assert alarm.message == "G96 S (cutting speed, m/min) is missing: none was programmed before the first cut"
    for given in (obeyed(*lines[:3], "S100 M3", cut), obeyed("G96 S100", "G97 S500", *lines[1:3], "M3", cut)):
        assert not any("cutting speed, m/min" in a.message for a in given.alarms)


def test_a_stopped_spindle_under_g95():
    lines = ("S500 G95 F0.2", "G1 X40")
    row = (found := obeyed(*lines)).toolpath[-1]
    assert row.feed == 100 and np.isnan(row.per_rev) and row.spindle == 0
    assert [(a.severity, a.span[:2]) for a in found.alarms] == [("warning", (2, 1))]
    assert "the spindle stands, the feed is that of 500 rev/min" in found.alarms[0].message
    assert not obeyed(*lines, settings={"stopped_spindle": "accept"}).alarms
    assert obeyed(*lines, settings={"stopped_spindle": "refuse"}).alarms[0].severity == "alarm"
    assert np.isfinite(found.profile().time)


def test_moves_in_a_given_time():
    """Every move takes 5 s, a cut of a cycle too; G12 takes 5 s for line and arc together."""
    found = obeyed("G93 F5", "G1 X40", "Z-30", "G2 X20 Z-50 R20", "G12 Z-80 R10", "G73 Z-90 D5")
    path = found.toolpath.motion
    cuts = path[path.kind != Kind.RAPID]
    assert np.allclose(cuts.lengths / cuts.feed * 60, cuts.time)
    times = [cuts.time[cuts.line == line].sum() for line in range(2, 7)]
    assert times == pytest.approx([5, 5, 5, 5, 10])
    shares = cuts[cuts.line == 5]
    assert shares.time / shares.lengths == pytest.approx([5 / (20 + 5 * math.pi)] * 2)
    assert found.profile(EASY).time == pytest.approx(30, rel=1e-4)


def test_threads_are_locked_to_the_spindle():
    """1:1 taper: both axes advance F in a turn, the tool F √2; under G96 the pitch stays."""
    found = obeyed("S500 M3 F80", "G32 X40 Z-10 F2", "G1 X50", start=(50, 0))
    thread, cut = found.toolpath[-2:]
    assert thread.synchronous and thread.per_rev == pytest.approx(2 * math.sqrt(2))
    assert thread.feed == pytest.approx(2 * math.sqrt(2) * 500)
    assert cut.feed == 80 and np.isnan(cut.per_rev) and not cut.synchronous
    found = obeyed("G96 S100 M3", "G32 Z-30 F2")
    assert found.ok and "the spindle speed changes where X does" in found.alarms[0].message
    assert found.toolpath[-1].feed == pytest.approx(2 * 1e5 / (2 * math.pi * 50))
    assert turns(found.toolpath)[-1] == pytest.approx(15)


def test_a_new_feed_type_needs_a_new_feed():
    for mode in ("G93", "G95"):
        found = obeyed("S100 M3 F50", "G94", "G1 X40", mode, "X30")
        assert [a.span.line for a in found.alarms] == [5] and "no feed rate" in found.alarms[0].message
