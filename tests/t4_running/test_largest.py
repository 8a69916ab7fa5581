"""What is worked out is bounded as what is written: below 1e9, a number, and refused at the block where it is not.

The numbers come from the bound that the readers have for written numbers, and from sums of the programs.
"""

import numpy as np
import pytest

import mnclab

BEGIN = "TOOL CALL 1 Z S1000 F100\nL X+0 Y+0 Z+10 R0 FMAX M3\n"
LARGE = BEGIN + "Q1 = +5\nLBL 1\nQ1 = Q1 * 2\nCALL LBL 1 REP 200\n"  # Q1 is 5 * 2^201
ISO = "G21 G90 G94 F100 S100 M3\n#1=99999\n" + "#1=#1*#1\n" * 5  # #1 is 99999^32


@pytest.mark.parametrize("times", [60, 1100])
def test_increments_that_double_end_below_the_bound(times):
    """X after n of them is 10 (2^n - 1): the 26th ends at 671088630, the 27th would end beyond 1e9."""
    text = BEGIN + f"Q1 = +5\nLBL 1\nQ1 = Q1 * 2\nL IX+Q1\nCALL LBL 1 REP {times}\n"
    run = mnclab.run(text, "tnc-620")
    assert not run.ok
    assert run.toolpath.end[-1, 0] == 10 * (2**26 - 1)
    assert run.alarms[0].span.line == 6 and f"{10.0 * (2**27 - 1):.7g}" in run.alarms[0].message
    assert np.isfinite(run.profile().time)


@pytest.mark.parametrize("blocks", [3, 400])
@pytest.mark.parametrize("control", ["mnc", "g43"])
def test_increments_that_are_written_stop_in_both_tiers(control, blocks):
    """Ten of 99,999,999 mm end at 999,999,990; the other tier obeys the blocks one by one."""
    text = "G91 F100 S100 M3\n" + "G1 X99999999\n" * (blocks + 10)
    run = mnclab.run(text, control)
    assert run.toolpath.end[-1, 0] == 999_999_990
    assert [alarm.span.line for alarm in run.alarms] == [12]


def test_holes_step_by_step_stop_at_the_bound():
    run = mnclab.run("G17 G90 F100 S100 M3\nG81 G98 X0 Y0 Z-5 R2\nG91\n" + "X30000000\n" * 100, "g43")
    assert not run.ok
    assert run.toolpath.end[-1, 0] == 33 * 30_000_000
    assert run.alarms[0].span.line == 3 + 34


@pytest.mark.parametrize(
    "blocks",
    [
        "L X+Q1\n", "L IX+Q1 R0 FMAX\n", "CC X+0 Y+0\nLP PR+Q1 PA+30\n", "CC X+Q1 Y+0\nC X+10 Y+0 DR+\n", "L C+Q1 FMAX\n",
        "CR X+10 Y+0 R+Q1 DR+\n", "CC X+10 Y+0\nCP IPA+Q1 IZ+5 DR+\n", "TRANS DATUM AXIS X+Q1\nL X+1\n", "L X+1 FQ1\n",
        "L X+10 FZ Q1\n", "TOOL CALL 1 Z SQ1\n", "TOOL CALL 1 Z DL+Q1\n", "TOOL DEF 5 L+Q1 R+1\n", "L X+Q1 M91\n",
        "L M140 MB Q1\n",
        "CYCL DEF 7.0 DATUM SHIFT\nCYCL DEF 7.1 X+Q1\n", "FPOL X+0 Y+0\nFL X+10 Y+Q1\n", "APPR LT X+20 Y+20 LENQ1 RL\nL X+50\n",
        "Q2 = 1 / Q1 / Q1\nL X+1 FQ2\n",
    ],
)  # fmt: skip
def test_no_word_escapes_by_a_parameter(blocks):
    refused(LARGE + blocks, "tnc-620", LARGE.count("\n"))


@pytest.mark.parametrize(
    "blocks",
    [
        "G1 X#1\n", "G2 X10 I#1\n", "G2 X10 R#1\n", "G16\nG1 X#1 Y30\n", "A#1\n", "G81 X1 Z-#1 R2\n", "G43 H1 Z#1\n", "S#1\n",
        "G10 L1 P1 R#1\n", "G52 X#1\n", "G10 L2 P1 X#1\nG54\nG1 X1\n", "G53 G0 X#1\n", "G93 F#1 G1 X10\n", "G1 X1 F#1\n",
        "#2=[1/#1]\nG1 X10 F#2\n", "G1 X10 F." + "0" * 318 + "1\n", "G20\nG1 X900000000\n", "G92 X#1\n",
    ],
)  # fmt: skip
def test_no_word_escapes_by_a_variable(blocks):
    refused(ISO + blocks, "g43", ISO.count("\n"))


@pytest.mark.parametrize("control", ["mnc", "tnc-620"])
def test_scales_that_pile_up(control):
    """A factor of a scale that is set anew is not the last one times itself; what it makes of a coordinate is bounded."""
    texts = {
        "mnc": "G90 F100 S100 M3\nG51 P90000\nG1 X90000\n",
        "tnc-620": BEGIN + "CYCL DEF 11.0 SCALING\nCYCL DEF 11.1 SCL 99\nL X+90000000\n",
    }
    run = mnclab.run(texts[control], control)
    assert not run.ok and (np.abs(run.toolpath.end) < 1e9).all()


@pytest.mark.parametrize(
    "given",
    [
        {"start": (80, 0, 1e308)}, {"datums": {1: (1e300, 0, 0)}}, {"presets": {1: (0, -1e10, 0)}},
        {"correctors": {1: (0, 0, 1e200)}},
        {"stock": ((0, 0, 0), (1e12, 1, 1))}, {"fixtures": (((0, 0, 0), (1e300, 1, 1)),)},
    ],
)  # fmt: skip
def test_a_setup_is_bounded_where_it_is_made(given):
    with pytest.raises(mnclab.Alarm):
        mnclab.Setup(**given)


def refused(text, control, begin):
    """It stops with an alarm that shows a block after those of the beginning, and all that is there is a number."""
    run = mnclab.run(text, control)
    assert not run.ok
    assert run.alarms[0].span.line > begin
    assert len(run.toolpath) == 0 or (np.abs(run.toolpath.end) < 1e9).all()
    assert np.isfinite(run.profile().time)
