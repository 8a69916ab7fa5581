"""What the manual says of the drilling cycles beyond their examples: levels, what is modal, which cycle ends which.

Chapter 9 and 9.1: Z (W), R and F are modal, K and P are not; the initial level does not change while the cycle is
active; the cycles are of one group (table 1.2), so one ends the other.
"""

import pytest

import mnclab
from mnclab import Kind, Setup

HEAD = "G54 G90 G0 X0 Y0 Z50 F120\n"


def holes(program, **setup):
    """Level R, the depths reached at feed and the level at the end, for every line that drills."""
    run = mnclab.run(HEAD + program, "mnc", Setup(**setup))
    assert run.ok, run.alarms
    path, found = run.toolpath, {}
    for line in sorted(set(path.line[path.kind == Kind.LINE].tolist())):
        rows = path[path.line == line]
        feeds = [k for k in range(len(rows)) if rows.kind[k] == Kind.LINE]
        depths = tuple(rows.end[k][2] for k in feeds)
        found[line - 1] = (rows.start[feeds[0]][2], depths, rows.end[-1][2])
    return found


@pytest.mark.parametrize("second", ["X40", "G83 X40", "G83 X40 Z-25", "G83 X40 R3", "G83 X40 Z-25 R3 F120"])
def test_modal_words_hold_whether_the_code_is_written_again_or_not(second):
    assert holes(f"G99 G83 X20 Z-25 R3\nG98 {second}\n") == {1: (3, (-25,), 3), 2: (3, (-25,), 50)}


def test_the_initial_level_does_not_change_under_g99():
    """9: "the initial level does not change even when the cycle runs under G99": the last hole ends at 50."""
    found = holes("G99 G83 X20 Z-25 R3\nG83 X30 Z-25 R3\nX40\nG98 X50\n")
    assert [end for _, _, end in found.values()] == [3, 3, 3, 50]


def test_the_initial_level_is_that_of_the_first_call_after_g80():
    assert holes("G83 X20 Z-25 R3\nG80 G0 Z30\nG83 X40 Z-25 R3\n") == {1: (3, (-25,), 50), 3: (3, (-25,), 30)}


def test_levels_stay_as_they_were_programmed():
    """A new R keeps the bottom of an absolute Z, and the depth of W or of an incremental Z (z_R - 10, z_R + Z)."""
    program = """\
G83 X1 Z-25 R3
X2 R10
G91 X1 R-45
W10
G90 R8
Z-3
G91 Z-4
R-40
"""
    assert holes(program) == {
        1: (3, (-25,), 50),
        2: (10, (-25,), 50),  # Z absolute: the bottom stays
        3: (5, (-25,), 50),  # z_R = 50 - 45
        4: (5, (-5,), 50),  # W counts from R
        5: (8, (-2,), 50),  # and keeps the depth 10
        6: (8, (-3,), 50),
        7: (8, (4,), 50),  # incremental Z: 8 - 4
        8: (10, (6,), 50),  # 50 - 40, and the depth 4 stays
    }


def test_pecks_count_from_r_and_need_not_divide_the_depth():
    """Depth 3 - (-25) = 28, pecks of 10: -7, -17, -25; K of at least the depth is one pass."""
    assert holes("G83 X1 Z-25 R3 K10\nX2 K28\nX3 K100\n") == {
        1: (3, (-7, -17, -25), 50),
        2: (3, (-25,), 50),
        3: (3, (-25,), 50),
    }


def test_the_feed_of_g83_stays_and_that_of_g300_does_not():
    run = mnclab.run(HEAD + "G83 X1 Z-5 R1 F80\nG80 G1 X2\nG300 Q1 H-5 Z0 F60\nX3\nM99\nX4\n", "mnc")
    assert run.ok
    lines = run.toolpath[run.toolpath.kind == Kind.LINE]
    assert list(zip(lines.line, lines.feed)) == [(2, 80), (3, 80), (5, 80), (6, 60), (7, 80)]


def test_a_cycle_of_the_group_ends_the_other():
    """Preparing G300 ends G83: X5 only moves. G83 forgets what was prepared: M99 has nothing to run."""
    assert list(holes("G83 X1 Z-5 R2\nG300 Q1 H-2 Z0\nX5\nX6 M99\n")) == [1, 4]
    run = mnclab.run(HEAD + "G300 Q1 H-2 Z0\nG83 X1 Z-5 R2\nX6 M99\n", "mnc")
    assert run.alarms[0].message.startswith("M99 has no prepared cycle")


def test_a_fault_of_a_later_hole_stands_at_that_hole():
    for fault, column in (("X40 R-30", 1), ("X40 K0", 5), ("X40 Z9", 5)):
        run = mnclab.run(HEAD + f"G83 X20 Z-25 R3\nX30\n{fault}\n", "mnc")
        assert [alarm.span[:2] for alarm in run.alarms] == [(4, column)]


def test_the_old_names_of_table_1_2():
    """G200 is G300, with a notice; the others are named as not built, not as unknown."""
    programs = [HEAD + f"{code} Q2 H-15 P5 Z20\nX1 M99\n" for code in ("G200", "G300")]
    old, new = (mnclab.run(program, "mnc") for program in programs)
    assert old.ok and [a.message for a in old.alarms] == ["G200 is another name of G300 (Drilling)"]
    assert str(old.toolpath) == str(new.toolpath)
    for number in (201, 202, 203, 204, 208, 241):
        assert mnclab.run(f"G{number}\n", "mnc").alarms[0].message.startswith(f"G{number} is refused: it is part of")


def test_the_block_that_prepares_a_cycle_does_not_call_it():
    run = mnclab.run(HEAD + "G300 Q2 H-15 Z20 M99\n", "mnc")
    assert [alarm.span[:2] for alarm in run.alarms] == [(2, 18)]
    assert run.alarms[0].message == "M99 stands in the block that prepares G300"


def test_a_start_below_the_clearance_level_is_left_upwards():
    """G300 ends at max(z0, Z + Q): 12 from z0 = 5, 50 from z0 = 50."""
    assert holes("G300 Q2 H-15 Z10\nX1 M99\nG0 Z5\nX2 M99\n") == {2: (12, (-5,), 50), 4: (12, (-5,), 12)}
