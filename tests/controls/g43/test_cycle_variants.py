"""What makers say of fixed cycles beyond their common part, each worked out by hand."""

import math
from functools import partial

import numpy as np
import pytest
from tools import running

import mnclab
from mnclab import Kind, Setup

HEAD = "G21 G17 G90 G54 F120 S800 M3\nG0 X0 Y0 Z20\n"
run = partial(running.run, control="iso", before=HEAD)


def heights(path, kind=Kind.LINE):
    return path.end[path.kind == kind, 2].tolist()


def bottoms(path):
    rows = path.motion
    return rows.end[(rows.kind == Kind.LINE) & (rows.end[:, 2] < rows.start[:, 2])]


def test_peck_tapping_lifts_or_withdraws():
    """From R = 2 by 4: -2, -6, -10; between them 1 up (the setting peck_clearance), or up to R."""
    text = "G84 X5 Z-10 R2 Q4 F800"
    path = run(text).toolpath
    assert heights(path) == [-2, -1, -6, -5, -10, 2]
    assert heights(run(text, peck_tapping="withdraws").toolpath) == [-2, 2, -6, 2, -10, 2]
    assert heights(run(text, peck_clearance=0.5).toolpath) == [-2, -1.5, -6, -5.5, -10, 2]
    cuts = path[path.kind == Kind.LINE]
    assert np.sign(cuts.spindle).tolist() == [1, -1, 1, -1, 1, -1] and (cuts.feed == 800).all() and cuts.synchronous.all()


def test_the_peck_of_drilling_is_none_of_tapping():
    path = run("G83 X5 Z-10 R2 Q4\nG84 X15 F800").toolpath
    assert path.end[(path.kind == Kind.LINE) & (path.line == 4), 2].tolist() == [-10, 2]


def test_a_tap_comes_out_faster():
    """J2: twice the speed, and so twice the feed at the same pitch; the next hole is cut at the old speed."""
    path = run("G84 X5 Z-10 R2 F800 J2\nX15").toolpath
    cuts = path[path.kind == Kind.LINE]
    assert cuts.feed.tolist() == [800, 1600, 800, 1600] and cuts.spindle.tolist() == [800, -1600, 800, -1600]


@pytest.mark.parametrize(
    ("words", "pitch"),
    [("G94 F1000", 1000 / 800), ("G95 F1.25", 1.25), ("G20 G94 F40", 40 * 25.4 / 800), ("G20 G95 F.05", 0.05 * 25.4)],
)
def test_the_pitch_of_a_tap(words, pitch):
    unit = 25.4 if "G20" in words else 1
    path = run(f"{words}\nG84 X1 Z-.4 R.1").toolpath
    cuts = path[path.kind == Kind.LINE]
    assert cuts.feed == pytest.approx([pitch * 800] * 2) and heights(path) == pytest.approx([-0.4 * unit, 0.1 * unit])


@pytest.mark.parametrize("code", ["G73", "G83"])
def test_pecks_dwell_at_the_bottom(code):
    path = run(f"{code} X5 Z-10 R2 Q5 P700\nX9\nG82 X11\n", dialect="haas").toolpath
    waits = path[path.kind == Kind.DWELL]
    assert waits.time.tolist() == [0.7, 0.7] and waits.end[:, 2].tolist() == [-10, -10]  # P of G82 is another


def test_the_wall_is_left_by_i_and_j():
    ends = run("G76 X5 Y1 Z-10 R2 I.3 J-.4").toolpath.motion.end.tolist()
    assert ends[4:7] == [[5.3, 0.6, -10], [5.3, 0.6, 2], [5, 1, 2]]


def test_cycles_drill_along_z_whatever_the_plane():
    for plane in ("G17", "G18", "G19"):
        assert bottoms(run(f"{plane} G81 X5 Y6 Z-10 R2").toolpath).tolist() == [[5, 6, -10]]


@pytest.mark.parametrize(("plane", "axis"), [("G18", "Y"), ("G19", "X")])
def test_linuxcnc_drills_along_the_normal_which_is_refused(plane, axis):
    found = mnclab.run(f"{HEAD}{plane} G81 X5 Y6 Z-10 R2\n", "iso", Setup(settings={"dialect": "linuxcnc"}))
    assert f"G81 drills along {axis}" in found.alarms[-1].message and found.alarms[-1].span.line == 3


@pytest.mark.parametrize("dialect", ["haas", "linuxcnc"])
def test_k_is_no_number_of_holes_elsewhere(dialect):
    """On Haas it is a depth of G73 and G83, LinuxCNC has none."""
    found = mnclab.run(f"{HEAD}G73 X5 Z-10 R2 Q3 K6\n", "iso", Setup(settings={"dialect": dialect}))
    assert not found.ok and "K is not the number of holes" in found.alarms[-1].message


@pytest.mark.parametrize("code", ["G87", "G88"])
def test_what_linuxcnc_has_not_is_refused(code):
    words = "Z-5 R-18 Q1" if code == "G87" else "Z-5 R2"
    found = mnclab.run(f"{HEAD}{code} X5 {words}\n", "iso", Setup(settings={"dialect": "linuxcnc"}))
    assert [alarm.message for alarm in found.alarms] == [f"{code} is not built as LinuxCNC has it"]


# --- frames -----------------------------------------------------------------------------------------------------------


def test_rotation_moves_the_holes():
    """(10, 0) and (20, 5) turned by 30 degrees about (10, 10); then a step of 10 along the turned X."""
    found = bottoms(run("G68 X10 Y10 R30\nG81 X10 Y0 Z-5 R2\nX20 Y5\nG91 X10").toolpath)
    c, s = math.cos(math.pi / 6), math.sin(math.pi / 6)
    places = [(10 + u * c - v * s, 10 + u * s + v * c, -5) for u, v in ((0, -10), (10, -5), (20, -5))]
    assert found == pytest.approx(np.array(places))


def test_mirror_and_scale_move_the_holes():
    assert bottoms(run("G51.1 X0\nG81 X10 Y5 Z-5 R2\nG91 X3 K2").toolpath)[:, 0].tolist() == [-10, -13, -16]
    path = run("G51 X0 Y0 Z0 I2000 J3000 K1000\nG81 X10 Y5 Z-5 R2").toolpath
    assert bottoms(path).tolist() == [[20, 15, -5]]


def test_another_datum_within_a_cycle():
    """Its R and bottom are those of the new datum, 3 lower; the initial level stays where the tool was."""
    path = run("G10 L2 P2 X100 Z-3\nG81 X10 Z-5 R2\nG55 X20").toolpath
    assert bottoms(path).tolist() == [[10, 0, -5], [120, 0, -8]] and path.end[-1].tolist() == [120, 0, 20]


def test_what_stands_between_the_holes():
    """S, F, M8, M1 and a dwell act in their order; a block with G98 or G99 alone drills nothing."""
    path = run("G81 X10 Z-5 R2\nX20 S900\nX30 F90\nX40 M8\nM1\nG4 P500\nG99\nX50\n").toolpath
    assert bottoms(path)[:, 0].tolist() == [10, 20, 30, 40, 50]
    cuts = path[path.kind == Kind.LINE]
    assert cuts.feed.tolist() == [120, 120, 90, 90, 90] and cuts.spindle.tolist() == [800, 900, 900, 900, 900]
    assert path.end[-1].tolist() == [50, 0, 2] and (path.kind == Kind.STOP).sum() == (path.kind == Kind.DWELL).sum() == 1


# --- beside cycles ----------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("motion", ["G0", "G1"])
def test_g28_beside_a_motion_code_goes_home(motion):
    path = run(f"G10 L2 P1 X7 Y8\nG0 X5 Y5 Z20\n{motion} G91 G28 Z0\n").toolpath
    assert path.end[-1].tolist() == [5 + 7, 5 + 8, 0] and path.kind[-1] == Kind.RAPID


def test_a_zero_along_the_axis_of_an_arc_changes_nothing():
    arc = run("G2 X10 Y10 I10 J0 K0.000").toolpath
    assert arc.end[-1].tolist() == [10, 10, 20] and arc.sweep[-1] == pytest.approx(-math.pi / 2)


def test_many_such_arcs_are_made_at_once():
    """A helix of 80 arcs of 0.1 rad each: as one by one, and as without the zeros."""
    arc = "G3 X{:.6f} Y{:.6f} I{:.6f} J{:.6f}"
    turn = [(10 * math.cos(k / 10), 10 * math.sin(k / 10)) for k in range(81)]
    rows = [arc.format(*turn[k + 1], -turn[k][0], -turn[k][1]) for k in range(80)]
    with_zero = "G0 X10\n" + "".join(f"{row} K0.000\n" for row in rows)
    bulk, alone, without = run(with_zero), run(with_zero, bulk=False), run(with_zero.replace(" K0.000", ""))
    assert list(map(str, bulk.toolpath)) == list(map(str, alone.toolpath)) == list(map(str, without.toolpath))
    assert bulk.toolpath.sweep[-80:] == pytest.approx([0.1] * 80, abs=1e-6)
    found = run(with_zero.replace("K0.000", "K1.000"), ok=False)
    assert "K stands along the axis of the arc" in found.alarms[-1].message
