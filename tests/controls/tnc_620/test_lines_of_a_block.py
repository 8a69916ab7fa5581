"""A block of several lines is named by each of them: for a moment, an explanation, a question, an alarm and the player."""

import numpy as np
import pytest

import mnclab as mnc

CONTROL = "tnc-620"
PROGRAM = """BEGIN PGM A MM
TOOL CALL 2 Z S1000
L X+1 Y+2 Z+30 R0 FMAX M3
CYCL DEF 200 DRILLING ~
  Q200=2 ~
  Q201=-15 ~
  Q206=250 ~
  Q202=5 ~
  Q210=0 ~
  Q203=0 ~
  Q204=20 ~
  Q211=0
CYCL CALL

L X+50 FMAX
END PGM A MM
"""
FIRST, LAST = 4, 12


@pytest.mark.parametrize("line", range(FIRST, LAST + 1))
def test_every_line_of_a_block_means_the_block(run, line):
    assert run.at(line=line) == run.at(line=FIRST) and run.at(line=line).line == FIRST
    assert str(run.explain(line=line)) == str(run.explain(line=FIRST))
    assert [m.step for m in run.when(f"line == {line}")] == [run.at(line=FIRST).step]
    assert [m.step for m in run.when(f"{line} = line")] == [run.at(line=FIRST).step]


@pytest.mark.parametrize("line", [0, 14, 17, 99])
def test_lines_of_no_block_are_not_executed(run, line):
    with pytest.raises((ValueError, mnc.Alarm), match=f"line {line} holds no block"):
        run.at(line=line)


def test_lines_in_order(run):
    """Less and greater go by blocks: what is before a line of a block is before the block."""
    before = run.when("line < 9")
    assert [m.line for m in before] == [1] and run.when("line > 9")[0].line == 13


def test_first_and_last_lines():
    program = mnc.read(PROGRAM, "tnc-620")
    first, last = program.lines()
    assert np.array_equal(first, [1, 2, 3, 4, 13, 15, 16]) and np.array_equal(last, [1, 2, 3, 12, 13, 15, 16])


def test_an_alarm_within_a_block_is_told_with_it():
    run = mnc.run(PROGRAM.replace("Q202=5", "Q202=-5"), "tnc-620")
    assert not run.ok and run.alarms[-1].span.line == 8
    assert run.alarms[-1].message in str(run.explain(line=FIRST)) and run.alarms[-1].message in str(run.explain(line=10))


def test_a_block_that_is_repeated():
    repeated = PROGRAM.replace("CYCL DEF", "LBL 1\nCYCL DEF", 1).replace("CYCL CALL\n", "CYCL CALL\nCALL LBL 1 REP 2\n")
    run = mnc.run(repeated, "tnc-620")
    assert [run.at(line=9, pass_=k).step for k in (1, 2, 3)] == [run.at(line=5, pass_=k).step for k in (1, 2, 3)]
    assert len(run.when("line = 9")) == 3
