"""K and L of fixed cycles, and what ends one: figures worked out by hand."""

import numpy as np
import pytest

import mnclab
from mnclab import Kind, Setup

HEAD = "G17 G90 G54 F120 S800 M3\nG0 X0 Y0 Z20\n"


def run(text, **settings):
    found = mnclab.run(HEAD + text, "iso", Setup(settings={"undescribed": "accept"} | settings))
    assert found.ok, found.alarms
    return found


def bottoms(found, depth):
    """Where cuts end at a depth, in order."""
    rows = found.toolpath.motion
    return rows.end[(rows.kind == Kind.LINE) & (rows.end[:, 2] == depth), :2].tolist()


@pytest.mark.parametrize("letter", "KL")
@pytest.mark.parametrize("count", [2, 3, 20])
def test_each_hole_stands_a_step_further(letter, count):
    found = run(f"G91 G81 X10 Y5 Z-5 R-18 {letter}{count}\nG90 G80 G0 X0")
    assert bottoms(found, -3) == [[10 * k, 5 * k] for k in range(1, count + 1)]


@pytest.mark.parametrize("count", [3, 20])
@pytest.mark.parametrize("code", ["G81", "G83", "G84", "G89"])
def test_absolute_holes_stand_at_one_place(code, count):
    """Each hole but the first, to which the tool goes, has the same rows at the same place."""
    found = run(f"{code} X10 Y5 Z-5 R2 {'Q2 ' if code == 'G83' else ''}K{count}")
    assert bottoms(found, -5) == [[10, 5]] * count
    path = found.toolpath
    ends = np.flatnonzero((path.kind == Kind.LINE) & (path.end[:, 2] == -5) & (path.start[:, 2] != -5))
    assert len(ends) == count and len(set(np.diff(ends).tolist())) == 1
    rows = np.column_stack([path.kind, path.end, path.feed, path.spindle])
    between = [rows[a + 1 : b + 1] for a, b in zip(ends[:-1], ends[1:], strict=True)]
    assert all(np.array_equal(one, between[0], equal_nan=True) for one in between)


def test_the_count_holds_for_its_block_alone():
    assert bottoms(run("G91 G81 X10 Z-5 R-18 K2\nX7\n"), -3) == [[10, 0], [20, 0], [27, 0]]


def test_no_hole_where_none_is_asked_for():
    found = run("G81 X10 Y5 Z-5 R2 K0\nX20\n")
    assert bottoms(found, -5) == [[20, 0]]
    assert bottoms(run("G81 X1 Z-5 R2\nG82 P500\nX3\n"), -5) == [[1, 0], [3, 0]]


@pytest.mark.parametrize("code", ["G0", "G1", "G2", "G3"])
def test_motion_ends_a_cycle(code):
    found = run(f"G81 X10 Z-5 R2\n{code} X20{' R5' if code in ('G2', 'G3') else ''}\nG1 X30\n")
    assert bottoms(found, -5) == [[10, 0]]
    assert found.toolpath.motion.end[-2:].tolist() == [[20, 0, 20], [30, 0, 20]]


def test_motion_waits_where_the_setting_says_so():
    found = run("G81 X10 Z-5 R2\nG0 X20\nX30\nG80 X40\n", motion_in_cycle="waits")
    assert bottoms(found, -5) == [[10, 0], [20, 0], [30, 0]]
    assert any("kept for later" in alarm.message for alarm in found.alarms)


@pytest.mark.parametrize(("way", "first"), [("up", [0, 0, 2]), ("across", [10, 0, -1])])
def test_the_way_from_below_level_r(way, first):
    found = run("G0 Z-1\nG81 X10 Z-5 R2\n", below_r=way)
    rows = found.toolpath.motion
    assert rows[rows.line == 4][0].end.tolist() == first


def test_inches_of_cycles_are_inches():
    found = run("G20 G81 X1 Y2 Z-.5 R.1 F10\nG91 X.5 K2\n")
    holes = np.array([[1, 2], [1.5, 2], [2, 2]]) * 25.4
    assert np.allclose(bottoms(found, -12.7), holes, rtol=0, atol=1e-12)
    rows = found.toolpath.motion
    assert set(rows.feed[rows.kind == Kind.LINE]) == {254.0}


def test_back_boring_comes_from_below():
    """Off the axis by Q = 2, down to R = -18, up to Z = -5 at feed, back the same way to the initial level."""
    rows = run("G87 X10 Y5 Z-5 R-18 Q2").toolpath.motion
    way = [[10, 5, 20], [8, 5, 20], [8, 5, -18], [10, 5, -18], [10, 5, -5], [8, 5, -5], [8, 5, 20], [10, 5, 20]]
    assert rows.end[1:].tolist() == way and (rows.kind[1:] == Kind.LINE).nonzero()[0].tolist() == [4]


def test_boring_by_hand_stops_the_program_at_the_bottom():
    path = run("G88 X10 Z-5 R2 P500").toolpath
    stop = [move for move in path if move.kind == Kind.STOP]
    assert len(stop) == 1 and stop[0].end.tolist() == [10, 0, -5]
    assert path.motion.end[-1].tolist() == [10, 0, 20]


@pytest.mark.parametrize("text", ["G91 X3 Y1", "G91 X3 K2", "X{0} Y3", "G0 X{0}"])
def test_many_blocks_at_once_are_what_each_is_alone(text):
    body = "G81 X1 Z-5 R2\n" + "".join(text.format(k) + "\n" for k in range(80))
    one, many = run(body, bulk=False), run(body)
    assert list(map(str, one.toolpath)) == list(map(str, many.toolpath))
