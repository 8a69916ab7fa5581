"""The base rotation beside work offsets, G92, G53 and G39 (MNC 12, "base rotation": machine = D + Rot_B(q + s)).

Numbers are those of cos and sin of 30 degrees, or of a turn by 90: (x, y) becomes (-y, x).
"""

import math

import numpy as np
import pytest
from tools.running import run

import mnclab
from mnclab import Datum

COS, SIN = math.sqrt(3) / 2, 0.5
ROWS = {1: (100, 50, -20), 2: Datum(200, 80, -30, rotation=90), 3: (10, 20, -5)}


def place(text, **more):
    """Where the tip stands at the end, machine coordinates."""
    found = run(text, datums=ROWS, **more)
    return found.toolpath.end[-1] + found.toolpath.origin, found


def near(*xyz):
    return pytest.approx(xyz, abs=1e-9)


def test_the_place_is_read_anew_and_nothing_moves():
    """(10, 0) is (10 cos 30, -10 sin 30) in axes turned by 30 degrees."""
    found = run("G54 G0 X10 Y0 Z5\nG404 E30\n", datums=ROWS)
    assert len(found.toolpath.motion) == 1
    assert found.at(line=1).position == near(10, 0, 5)
    assert found.at(line=2).position == near(10 * COS, -10 * SIN, 5)


def test_increments_run_along_the_turned_axes():
    end, found = place("G54 G0 X10 Y0 Z5\nG404 E30\nG91 G0 X4 Y2\n")
    assert end == near(110 + 4 * COS - 2 * SIN, 50 + 4 * SIN + 2 * COS, -15)
    assert found.at(line=3).position == near(10 * COS + 4, -10 * SIN + 2, 5)


def test_an_arc_turns_with_the_plane():
    """A quarter about (0, 0) from (5, 0) to (0, 5), turned by 90 degrees: from (0, 5) to (-5, 0)."""
    found = run("G54 G404 E90\nG0 X5 Y0\nG3 X0 Y5 I-5 J0 F100\n", datums=ROWS)
    arc = found.toolpath[-1]
    assert (arc.start[:2], arc.end[:2], arc.centre[:2]) == (near(0, 5), near(-5, 0), near(0, 0))
    assert arc.sweep == pytest.approx(math.pi / 2)


def test_a_row_with_an_angle_sets_it_and_a_row_without_keeps_it():
    """MNC-BASEROT-ROW: row 2 has 90 degrees, row 3 an empty cell."""
    end, _ = place("G54 G404 E30\nG147 Q3\nG0 X10 Y0 Z0\n")
    assert end == near(10 + 10 * COS, 20 + 10 * SIN, -5)
    end, _ = place("G54 G404 E30\nG55\nG0 X10 Y0 Z0\n")
    assert end == near(200, 90, -30)
    end, _ = place("G55\nG56\nG0 X10 Y0 Z0\n")
    assert end == near(10, 30, -5)


def test_a_stored_angle_of_zero_is_an_angle():
    end, _ = place("G54 G404 E0 W3\nG404 E30\nG147 Q3\nG0 X10 Y0 Z0\n")
    assert end == near(20, 20, -5)
    end, found = place("G54 G404 E30 W3\nG404 E0\nG147 Q3\nG0 X10 Y0 Z0\n")
    assert end == near(10 + 10 * COS, 20 + 10 * SIN, -5)
    assert found.tables.datums[3] == Datum(10, 20, -5, rotation=30)


def test_the_shift_of_g92_lies_within_it():
    """At (10, 0) of axes turned by 90 degrees G92 X3 Y4: s = (7, -4), so (0, 0) lies at D + Rot_90(7, -4) = D + (4, 7)."""
    end, found = place("G54 G404 E90\nG0 X10 Y0 Z0\nG92 X3 Y4\nG0 X0 Y0\n")
    assert end == near(104, 57, -20)
    assert found.frames["local"][:3, 3] == near(7, -4, 0)
    end, _ = place("G54 G404 E90\nG0 X10 Y0 Z0\nG92 Y4\nG0 X0 Y0\n")  # the shift of X stays 0
    assert end == near(104, 50, -20)


def test_g92_after_a_rotation_too():
    """At D + (0, 10) of B = 90 stands (10, 0); it gets p = (2, 0), q = Rot_30(p): s = (10 - 2 cos 30, -2 sin 30)."""
    _, found = place("G54 G404 E90\nG0 X10 Y0 Z0\nG39 A30\nG92 X2 Y0\nG0 X2 Y0\n")
    assert found.frames["local"][:3, 3] == near(10 - 2 * COS, -2 * SIN, 0)
    assert found.toolpath.end[-1] + found.toolpath.origin == near(100, 60, -20)


def test_g53_leaves_it():
    """Machine coordinates have no datum, and no turn about it; after the block it is back."""
    end, found = place("G54 G404 E30\nG53 G0 X7 Y8 Z9\n")
    assert end == near(7, 8, 9)
    dx, dy = 7 - 100, 8 - 50
    assert found.at(line=2).position == near(dx * COS + dy * SIN, -dx * SIN + dy * COS, 29)


def test_g38_does_not_cancel_it_and_g404_does_not_change_g39():
    """MNC-BASEROT-LAYER: both turn; the outer one about the datum, the inner one about its pole."""
    end, _ = place("G54 G404 E30\nG38\nG0 X10 Y0 Z0\n")
    assert end == near(100 + 10 * COS, 50 + 10 * SIN, -20)
    end, _ = place("G54 G39 A60 X5 Y0\nG404 E30\nG0 X15 Y0 Z0\n")  # (15, 0) about (5, 0) by 60: (10, 5 sqrt 3); then by 30
    x, y = 5 + 5, 10 * COS
    assert end == near(100 + x * COS - y * SIN, 50 + x * SIN + y * COS, -20)


def test_it_stands_under_scaling_and_mirror_image():
    """G404 allows them: (10, 0) becomes (20, 0), then (-20, 0), then turned by 90."""
    end, _ = place("G54 G37 X2 Y2\nG51 X0\nG404 E90\nG0 X10 Y0 Z0\n")
    assert end == near(100, 30, -20)
    assert run("G54 G51 X0 Z0\nG404 E90\n", datums=ROWS).ok


def test_history_stages_and_a_start_in_the_middle_know_it():
    text = "T1 S1000 M3\nG54 G90\nG404 E30\nG0 X10 Y0 Z0\nG1 X20 F100\n"
    found = run(text, datums=ROWS)
    steps = found.history.changed("frame base rotation")
    assert len(steps) == 1
    assert np.array(steps[0][1])[0, :2] == pytest.approx((COS, -SIN))
    assert "base rotation" in str(found.explain(4))
    started = found.start_at(5)
    assert any("base rotation" in str(one) and "30" in str(one) for one in started.missed)
    assert started.toolpath.start[0] == near(10 * COS, 10 * SIN, 0)
    assert started.toolpath.end[-1] == near(20 * COS, 20 * SIN, 0)


def test_a_loop_of_plain_blocks_is_turned_alike():
    """Many plain blocks at once are the same as one by one."""
    plain = "\n".join(f"X{k % 7} Y{k % 11}" for k in range(200))
    text = f"G54 G404 E30\nF500 G1\n{plain}\n"
    together, alone = run(text, datums=ROWS), run(text, datums=ROWS, bulk=False)
    assert together.toolpath.end == pytest.approx(alone.toolpath.end, abs=1e-12)


def test_new_block_numbers_leave_the_words_of_cycles():
    """P, W and L of a measuring cycle name no blocks."""
    text = "N1 T6\nN2 G54 G0 Z50\nN10 G400 X20 Y0 U80 V0 L2 K1 Q0 Z-8 H20 P1 E0 W2\nN3 G404 E30 W10\n"
    numbered = "N10 T6\nN20 G54 G0 Z50\nN30 G400 X20 Y0 U80 V0 L2 K1 Q0 Z-8 H20 P1 E0 W2\nN40 G404 E30 W10\n"
    assert mnclab.renumber(text, "mnc") == numbered
