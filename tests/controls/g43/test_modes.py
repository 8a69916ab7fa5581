"""Modes and M functions of the ISO mill: feeds, exact stops, arc centres, turns, rotary axes, functions of makers."""

import math
from functools import partial

import numpy as np
import pytest
from tools import running

import mnclab
from mnclab import Kind, Setup

run = partial(running.run, control="g43", stopped_spindle="accept")
lines = running.lines


def test_inverse_time():
    """F2: half a minute for each of these moves, however long; an arc too."""
    path = run(lines("G93|G1 X30 F2|X40 F2|G3 X60 R10 F4|G94 G1 X90 F600")).toolpath
    assert path.time[:3].tolist() == [30, 30, 15]
    assert path.feed.tolist() == pytest.approx([60, 20, math.pi * 10 * 4, 600])


def test_feed_per_revolution():
    path = run(lines("S500 M3|G95 G1 X10 F0.2")).toolpath
    assert path.motion.feed.tolist() == [100]


@pytest.mark.parametrize(("text", "exact"), [
    ("G61|X1|X2", [True, True]), ("G61.1|X1|G64 X2", [True, False]), ("G9 X1|X2", [True, False]), ("G64|X1|X2", [False, False]),
])  # fmt: skip
def test_exact_stops(text, exact):
    assert run(lines(text)).toolpath.exact.tolist() == exact


def test_how_far_a_corner_may_be_cut():
    found = run(lines("G20|G64 P0.001 Q0.001|X1"))
    assert found.toolpath.tolerance[-1] == pytest.approx(0.0254)
    assert [alarm.message for alarm in found.alarms] == ["G64 Q allows that short moves are joined: they are left as they are"]


def test_centres_from_the_origin():
    ends = "G1 X10 Y5 F100|{}|G1 X0"
    one, other = (run(lines(ends.format(arc))).toolpath for arc in ("G2 X20 Y5 I5 J0", "G90.1 G2 X20 Y5 I15 J5"))
    assert np.array_equal(one.end, other.end) and np.allclose(one.centre, other.centre, equal_nan=True)


@pytest.mark.parametrize(("text", "turns"), [
    ("G3 I5 P3", 3), ("G2 I5 P2", -2), ("G3 I5", 1), ("G3 X10 Y0 I5 P2", 1.5), ("G3 Z9 I5 P4", 4),
])  # fmt: skip
def test_turns(text, turns):
    assert run(f"F100\n{text}\n").toolpath.sweep.tolist() == pytest.approx([turns * math.tau])


# --- rotary axes ------------------------------------------------------------------------------------------------------


def test_rotary_axes_turn_alone_and_beside():
    path = run(lines("G0 A90|G1 X10 A0 F100|G91 B15 C-5|B15")).toolpath
    assert np.degrees(path.rotary).round(9).tolist() == [[90, 0, 0], [0, 0, 0], [0, 15, -5], [0, 30, -5]]
    assert path.kind.tolist() == [Kind.RAPID, Kind.LINE, Kind.LINE, Kind.LINE]
    assert path.end[:, 0].tolist() == [0, 10, 10, 10]


# --- M functions ------------------------------------------------------------------------------------------------------


def test_spindle_and_coolant_together():
    path = run("S800 M13\nX1\nM14\n").toolpath
    assert path.spindle.tolist() == [800, 800, 800, -800, -800]
    assert (path.kind == Kind.COOLANT).sum() == 2


@pytest.mark.parametrize(("text", "angle"), [("M19", 0), ("M19 R90", 90), ("M19 P45.5", 45.5)])
def test_oriented_stop(text, angle):
    found = run(f"S100 M3\n{text}\n")
    assert list(found.history["spindle angle"])[-1] == angle and found.toolpath.spindle[-1] == 0


def test_functions_of_makers_move_nothing_and_say_so():
    found = run(lines("M88|X1|M21|M48|M29 S100|M52 P1|M66 P0 L3 Q5"))
    assert len(found.toolpath) == 1 and [alarm.message.partition(":")[0] for alarm in found.alarms] == [
        f"{code} is a function of the machine's maker" for code in ("M88", "M21", "M66")
    ]


def test_lines_that_begin_most_programs_say_nothing():
    first = "G21 G90 G94 G17|G40 G49 G80 G50 G69 G50.1 G15|G40.1 G97 G64|G5.1 Q1|G5 P10000|G8 P1|G103 P1|G103|G187 P3 E0.1|X1"
    found = run(lines(first))
    assert not found.alarms and found.toolpath.end.tolist() == [[1, 0, 0]]


# --- dialects ---------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(("dialect", "text", "seconds"), [
    ("fanuc", "G4 P500", 0.5), ("linuxcnc", "G4 P2.5", 2.5), ("haas", "G4 P500", 0.5), ("haas", "G4 P2.", 2),
    ("fanuc", "G4 X3", 3),
    ("linuxcnc", "F100 G82 Z-5 R2 X1 P1.5", 1.5), ("fanuc", "F100 G82 Z-5 R2 X1 P1500", 1.5),
])  # fmt: skip
def test_dwells(dialect, text, seconds):
    path = run(f"{text}\n", dialect=dialect).toolpath
    assert path.time[path.kind == Kind.DWELL].tolist() == [seconds]


def test_a_single_setting_counts_more_than_the_dialect():
    path = run("G4 P2\n", dialect="linuxcnc", dwell_p="milliseconds").toolpath
    assert path.time.tolist() == [0.002]


def test_an_unknown_dialect_is_named():
    with pytest.raises(mnclab.Alarm, match="setting dialect .* must be one of fanuc, haas, linuxcnc, got 'funac'"):
        mnclab.run("X1\n", "g43", Setup(settings={"dialect": "funac"}))


def test_help_says_what_a_dialect_chooses():
    page = str(mnclab.help("settings", "g43"))
    assert "dwell_p=seconds" in page and "that of Haas mills" in page


def test_what_stands_in_no_chapter_is_marked_in_help():
    functions = mnclab.controls["g43"].functions
    assert functions["G68"].source == "ISO meaning" and functions["G43"].source == "7.1"


def test_a_machine_may_begin_in_inches():
    found = run("X1\nG21 X1\n", units="inch")
    assert found.toolpath.end[:, 0].tolist() == [25.4, 1] and found.history["unit"][0] == "G20"


def test_a_dwell_in_milliseconds_with_a_point():
    """Fanuc: X "decimal point permitted", P "decimal point not permitted"; G4 P1.5 of other controls means seconds."""
    for dialect, text, seconds, said in (
        ("fanuc", "P1.5", 0.0015, ["P1.5 counts milliseconds, decimal point or not: 0.0015 s"]),
        ("fanuc", "P2", 0.002, ["P2 counts milliseconds: 0.002 s"]), ("fanuc", "P10", 0.01, []),
        ("linuxcnc", "P2", 2, []), ("fanuc", "P1500", 1.5, []), ("fanuc", "X1.5", 1.5, []),
        ("haas", "P1.5", 1.5, []), ("linuxcnc", "P1.5", 1.5, []),
    ):  # fmt: skip
        run = mnclab.run(f"G21\nG4 {text}\nM30\n", "g43", mnclab.Setup(settings={"dialect": dialect}))
        assert run.ok and [alarm.message for alarm in run.alarms] == said
        assert run.toolpath.time[run.toolpath.kind == mnclab.Kind.DWELL].tolist() == [pytest.approx(seconds)]
