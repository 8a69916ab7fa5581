"""Values that no shop would write: the same alarms from a table of steps as from a program, and nothing else.

What is right comes from the declarations (which axes there are), from the limits that alarms name, and from geometry: a train
along a straight line is as long as the line, whatever its length.
"""

import pytest

import mnclab
from mnclab import Alarm
from mnclab.machine import trial

TRAIN = """\
TOOL CALL 1 Z S1000 F100
L X+0 Y+0 Z+10 R0 FMAX M3
CYCL DEF 14.0 CONTOUR
CYCL DEF 14.1 CONTOUR LABEL1
CYCL DEF 25 CONTOUR TRAIN Q1=-20 Q3={allowance} Q5=0 Q7=50 Q10=5 Q11=100 Q12=200 Q15=1
CYCL CALL
L Z+100 FMAX M30
LBL 1
L X+10 Y+10 RL
L X+{end}
{more}LBL 0
"""


@pytest.mark.parametrize(
    ("text", "control"), [("M3 S500\n", "jnc-t01"), ("G4 F1\n", "jnc-t01"), ("S800\nM3\n", "nc-31"), ("T1\n", "nc-31")]
)
@pytest.mark.parametrize("stock", [None, mnclab.cylinder(diameter=50, length=60)])
def test_a_lathe_that_goes_nowhere_has_a_page(text, control, stock, tmp_path):
    run = mnclab.run(text, control, stock=stock)
    assert "<html" in run.save(tmp_path / "a.html").read_text("utf-8")


@pytest.mark.parametrize("axis", ["abc", ""])
@pytest.mark.parametrize(
    ("code", "known"), [("TCH PROBE 0", "X+, X-, Y+, Y-, Z+, Z-"), ("TCH PROBE 1", "X, Y, Z"), ("TCH PROBE 3", "X, Y, Z")]
)
def test_axes_that_are_none_are_refused(code, known, axis):
    with pytest.raises(Alarm) as found:
        mnclab.steps(code, "tnc-620", axis=axis)
    assert f"must be one of {known}, got {axis!r}" in str(found.value)


def test_a_ring_of_a_bore_is_said_beside_its_steps():
    """D40 with a cutter of 10 reaches in to 40 - 2 x 10 = 20: a hole of 8 leaves a ring."""
    assert len(mnclab.steps("G306", "mnc", C=8, D=40))


def test_numbers_near_nothing_are_refused_or_obeyed():
    with pytest.raises(Alarm, match="into more than 10000 turns"):
        mnclab.steps("CYCL DEF 262", "tnc-620", Q239=1e-320)
    assert "inf" not in repr(mnclab.steps("G304", "mnc", E=1e-320))
    assert "nan" not in repr(mnclab.steps("G304", "mnc", E=1e-320))


@pytest.mark.parametrize(
    ("code", "control", "values"),
    [("CYCL DEF 254", "tnc-620", {"Q377": 1000}), ("CYCL DEF 220", "tnc-620", {"Q241": 65535}), ("G84", "g43", {"K": 9999})],
)
def test_a_table_that_nobody_would_read_is_refused(code, control, values):
    with pytest.raises(Alarm, match="more than 5000"):
        mnclab.steps(code, control, **values)


@pytest.mark.parametrize("end", [100, 1_000_000, 100_000_000])
def test_a_train_along_a_straight_line_is_as_long_as_the_line(end):
    run = mnclab.run(TRAIN.format(allowance=0, end=end, more=""), "tnc-620")
    assert run.ok
    cuts = run.toolpath[run.toolpath.feed == 200]
    assert max(cuts.lengths) == pytest.approx(end - 10)


def test_an_allowance_beyond_any_part_is_too_wide_for_its_contour():
    run = mnclab.run(TRAIN.format(allowance=99999, end=50, more="L Y+50\n"), "tnc-620")
    assert "too short for the tool radius" in run.alarms[0].message


def test_a_blank_too_thin_for_cells_is_refused():
    """Four cells across 0.0001 mm are 4,000,000 along 100 mm; 25,000 are allowed."""
    text = "TOOL CALL 1 Z S1000 F100\nL X-20 Y+0 R0 FMAX M3\nL Z-5\nL X+50\n"
    with pytest.raises(Alarm, match="at most 25,000 cells in a row, and would have 4e"):
        mnclab.run(text, "tnc-620", stock=((0, 0, -10), (100, 0.0001, 0))).workpiece()


def test_a_hole_in_a_loop_counts_as_more_than_a_block():
    hole = "CYCL DEF 200 Q200=2 Q201=-5 Q206=100 Q202=5 Q210=0 Q203=0 Q204=50 Q211=0\n"
    text = f"TOOL CALL 1 Z S1000 F100\nL Z+10 R0 FMAX M3\n{hole}LBL 1\nL IX+1 FMAX M99\nCALL LBL 1 REP 65000\n"
    run = mnclab.run(text, "tnc-620")
    assert "as much work as 200000 blocks" in run.alarms[0].message


@pytest.mark.parametrize("code", ["CYCL DEF 27", "CYCL DEF 28", "CYCL DEF 29", "CYCL DEF 39"])
def test_an_infeed_on_a_cylinder_makes_no_more_levels_than_anybody_waits_for(code):
    of = mnclab.controls["tnc-620"]
    cycle = of.cycles[code]
    given = {p.name: trial.first_value(p) for p in cycle.parameters() if p.required or trial.written_first(p)}
    run = mnclab.run(f"{trial.program(of, cycle, given | {'infeed': 0.001})}\n", "tnc-620", setup=of.trial_setup)
    assert "levels of 4 passes, more than 5000 together" in run.alarms[0].message
