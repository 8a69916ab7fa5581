"""The second clamping of a lathe: end for end, chucked again; a turned part on a mill. Volumes by hand, of rings and discs."""

import math

import numpy as np
import pytest
from t3_workpiece.lathe import BAR, SHARP, cutting, turned
from tools.milled import MILL, part
from tools.running import run

import mnclab
from mnclab import Tool
from mnclab.geometry.contours import Contour
from mnclab.workpiece.blank import cylinder
from mnclab.workpiece.turning.collisions import collisions_of
from mnclab.workpiece.turning.revolved import TurnedBlank
from mnclab.workpiece.turning.turned import Turned

DRILL = Tool(number=2, kind="drill", radius=5, angle=180)
BLADE = Tool(number=4, kind="grooving", width=2)
SHOULDER = [(2, 35), (2, 20), (-30, 20), (-30, 35)]  # radius 20 over the last 30 mm of a bar of 30
PI = math.pi


def test_end_for_end_it_lies_between_the_same_ends():
    first = turned(SHARP, *SHOULDER)
    for axis in "xYX":
        over = first.turned_over(axis)
        assert over.at([-59.9, -30.1, -29.9, -0.1]) == pytest.approx([20, 20, 30, 30])
        assert (over.volume, over.removed) == (pytest.approx(first.volume), 0)
        again = over.turned_over(axis)
        assert again.at([-59.9, -30.1, -29.9, -0.1]) == pytest.approx([30, 30, 20, 20])
    assert all(loop.area > 0 for loop in over.section)
    faced = turned(SHARP, (-2, 35), (-2, -0.1), stock=BAR)  # 2 mm off: turned over, the raw face is where the end was
    assert faced.turned_over("x").section[0].bounds.tolist() == [[-58, 0], [0, 30]]
    assert faced.turned_over("x").turned_over("x").section[0].bounds.tolist() == [[-60, 0], [-2, 30]]


def test_the_other_end_is_turned_and_what_was_bored_meets():
    """A hole of 5 from one end, 40 deep, one from the other, 25 deep, meet; the second shoulder is 25 over 20 mm."""
    first = Turned(cutting([SHARP, DRILL], [SHOULDER, [(5, 0), (-40, 0), (5, 0)]]))
    ways = [[(2, 35), (2, 25), (-20, 25), (-20, 35)], [(5, 0), (-25, 0), (5, 0)]]
    second = Turned(cutting([SHARP, DRILL], ways, first.turned_over("x").as_blank()))
    assert second.at([-0.1, -19.9, -20.1, -29.9, -30.1]) == pytest.approx([25, 25, 30, 30, 20])
    assert second.bore_at([-1, -22, -59]) == pytest.approx([5, 5, 5])
    assert second.removed == pytest.approx(PI * (900 - 625) * 20 + PI * 25 * 20, rel=1e-9)
    assert second.volume == pytest.approx(PI * (625 * 20 + 900 * 10 + 400 * 30 - 25 * 60), rel=1e-9)
    assert sum(second.removed_by("tool").values()) == pytest.approx(second.removed)
    contact = mnclab.part.contact(second.part, (60, 0, -45), (-1, 0, 0), 1.0, 60)
    assert contact == pytest.approx(60 - 20 - 1, abs=1e-9)


def test_what_fell_off_is_gone():
    """Parted at Z -20 with a blade of 2 mm: the piece in front is not in the next clamping."""
    first = turned(BLADE, (-22, 35), (-22, -0.1), (-22, 35))
    assert len(first.parted) == 1
    over = first.turned_over("x")
    assert over.section[0].bounds == pytest.approx(np.array([[-38, 0], [0, 30]]))
    assert over.volume == pytest.approx(PI * 900 * 38) and over.notes == ("of the blank: 1 piece fell off",)


def test_a_blank_of_several_loops():
    """An undercut of 2 mm between radius 10 and 12 in a bore of 10 stays open to it; a void all round is a loop of its own."""
    outer, void = Contour([(-60, 0), (0, 0), (0, 30), (-60, 30)]), Contour([(-30, 10), (-30, 20), (-20, 20), (-20, 10)])
    first = Turned(cutting([SHARP], [[(5, 40), (5, 41)]], TurnedBlank((outer, void))))
    hollow = PI * (900 * 60 - (400 - 100) * 10)
    assert first.volume == pytest.approx(hollow)
    second = turned(SHARP, (2, 35), (2, 25), (-25, 25), (-25, 35), stock=first.turned_over("x").as_blank())
    assert len(second.section) == 2 and second.removed == pytest.approx(PI * (900 - 625) * 25)
    assert second.volume == pytest.approx(hollow - PI * (900 - 625) * 25)
    third = turned(SHARP, (2, 35), (2, 15), (-45, 15), (-45, 35), stock=first.turned_over("x").as_blank())  # opens the void
    assert third.removed == pytest.approx(PI * ((900 - 225) * 45 - (400 - 225) * 10))


def test_collisions_with_what_is_left():
    """A rapid along radius 22: clear of the shoulder of radius 20, 3 mm deep in one of 25."""
    first = turned(SHARP, *SHOULDER)
    way = [(5, 22), (-25, 22)]
    clear = Turned(cutting([SHARP], [way], first.as_blank(), rapids=(0,)))
    assert collisions_of(clear.cutting) == ()
    (met,) = collisions_of(Turned(cutting([SHARP], [way], first.turned_over("x").as_blank(), rapids=(0,))).cutting)
    assert met.kind == "rapid" and met.depth == pytest.approx(8, abs=0.02)


def test_a_turned_part_on_a_mill():
    """It stands on its end: a shoulder of 20 over one of 30, a slot 5 deep across the top, a flat on the shoulder."""
    first = turned(SHARP, *SHOULDER).as_blank()
    second = part("G0 X-40 Y0\nG1 Z-5\nX40\nG0 Z50\n", MILL, first)
    assert second.at([0, 0, 25, 25], [0, 10, 0, 6]) == pytest.approx([-5, 0, -30, -30], abs=1e-9)
    assert np.isnan(second.faces(np.array([29.0]), np.array([29.0]))[1]).all()
    half = np.linspace(-5, 5, 100_001)
    assert second.removed == pytest.approx(5 * float(np.trapezoid(2 * np.sqrt(400 - half**2), half)), rel=1e-3)
    assert not second.notes
    over = part("G0 X40 Y0\nG1 Z-5\nX25\nG0 Z50\n", MILL, turned(SHARP, *SHOULDER).turned_over("y").as_blank())
    assert over.notes == () and over.at(25, 0) == -5 and over.at(0, 0) == 0


def test_what_overhangs_on_a_mill_is_said():
    first = turned(BLADE, (-22, 35), (-22, 15), (-22, 35))
    second = part("G0 X40 Y0\nG1 Z-5\nX25\nG0 Z50\n", MILL, first.as_blank())
    assert any("what overhangs in the turned blank is not shown" in note for note in second.notes)


def test_what_was_milled_does_not_turn():
    milled = part("G0 X30 Y20\nG1 Z-5\nG0 Z50\n")
    with pytest.raises(mnclab.Alarm, match="on a lathe a blank and its chuck are boxes or bodies about Z") as told:
        Turned(cutting([SHARP], [SHOULDER], milled.as_blank()))
    assert told.value.hint == "what a mill has cut does not turn true"


def test_a_program_turns_the_other_end():
    """The same program on both ends of a bar from -50 to 10: a shoulder of 20 over 30 mm from each of them."""
    text = "G97 S500 M3\nG94 F20.0\nG90\nG00 X35 Z12\nG00 X20\nG01 Z-20\nG01 X35\nG00 Z50\n"
    setup = {"tools": {1: SHARP}, "start": (100, 0, 100)}
    first = run(text, "jnc-t01", stock=cylinder(30, -50, 10), before="T1\n", **setup).workpiece()
    over = run(text, "jnc-t01", stock=first.turned_over("x"), before="T1\n", **setup).workpiece()
    assert over.cutting.stock.bounds[:, 2].tolist() == [-50, 10]
    assert over.volume == pytest.approx(PI * 400 * 60)
