"""Jumps, repeats and subprograms together; programs without an end."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

import mnclab as mnc


@pytest.mark.parametrize(
    ("condition", "jumps"),
    [
        ("FN 9: IF +Q1 EQU +3", True), ("FN 9: IF +Q1 EQU -3", False), ("FN 9: IF 0,5 EQU +.5", True),
        ("FN 10: IF +Q1 NE +3", False), ("FN10:IF -Q1 NE 3", True),
        ("FN 11: IF +Q1 GT +2.999", True), ("FN 11: IF +Q1 GT +3", False),
        ("FN 12: IF +Q1 LT +3.001", True), ("FN 12: IF +Q1 LT +3", False),
        ("FN 9: IF Q1 IS DEFINED", True), ("FN 9: IF +Q2 IS DEFINED", False), ("FN 9: IF QL2 IS UNDEFINED", True),
        ("FN 9: IF Q108 IS DEFINED", True), ("FN 9: IF QS1 IS DEFINED", True),
    ],
)  # fmt: skip
@pytest.mark.parametrize("label", ["5", '"OUT"', "QS1"])
def test_conditions(condition: str, jumps: bool, label: str, inside) -> None:
    run = inside(f'2 Q1 = 3\n3 QS1 = "OUT"\n4 {condition} GOTO LBL {label}\n5 L X+7\n6 LBL 5\n7 LBL "OUT"\n8 L Y+1')
    assert run.ok, run.alarms
    assert run.toolpath[-1].end[:2].tolist() == [0 if jumps else 7, 1]


def test_equal_is_exactly_equal(inside) -> None:
    """Ten tenths are not 1 in binary numbers; a program that waits for that never ends, here as on a control."""
    run = inside(
        "2 Q1 = 0\n3 LBL 1\n4 Q1 = Q1 + 0.1\n5 CALL LBL 1 REP 9\n6 FN 9: IF +Q1 EQU +1 GOTO LBL 2\n7 L X+5\n8 LBL 2"
    )
    assert run.variables["Q1"] != 1 and run.toolpath[-1].end[0] == 5


@given(st.integers(0, 12), st.integers(1, 5))
def test_a_loop_of_jumps_is_a_loop_of_python(last: int, step: int) -> None:
    run = mnc.run(
        f"0 BEGIN PGM A MM\n1 TOOL CALL 1 Z F100\n2 Q1 = 0\n3 LBL 1\n4 FN 11: IF +Q1 GT +{last} GOTO LBL 2\n5 L X+Q1 Y+1\n"
        f"6 Q1 = Q1 + {step}\n7 FN 9: IF +0 EQU +0 GOTO LBL 1\n8 LBL 2\n9 L Z+3\n10 END PGM A MM\n",
        "tnc-620",
    )
    assert run.ok, run.alarms
    assert [move.end[0] for move in run.toolpath.motion if move.line == 6] == list(range(0, last + 1, step))


def test_a_jump_inside_a_repeated_section_stays_in_it(inside) -> None:
    """The second axis grows by 1 in each of 4 rounds, the first only in those where Q1 is greater than 2."""
    run = inside(
        "2 Q1 = 0\n3 LBL 1\n4 Q1 = Q1 + 1\n5 FN 12: IF +Q1 LT +3 GOTO LBL 2\n"
        "6 L IX+1\n7 LBL 2\n8 L IY+1\n9 CALL LBL 1 REP 3\n10 L Z+1"
    )
    assert run.toolpath[-1].end.tolist() == [2, 4, 1]


def test_a_jump_out_of_a_repeated_section_ends_the_repeat(inside) -> None:
    run = inside(
        "2 Q1 = 0\n3 LBL 1\n4 Q1 = Q1 + 1\n5 FN 9: IF +Q1 EQU +3 GOTO LBL 2\n"
        "6 L IX+1\n7 CALL LBL 1 REP 9\n8 L Z+5\n9 LBL 2\n10 L IY+1"
    )
    assert run.toolpath[-1].end.tolist() == [2, 1, 0] and run.variables["Q1"] == 3


def test_a_jump_back_before_a_section_repeats_it_in_full_again(inside) -> None:
    """Two rounds of the outer loop, each with the section three times."""
    run = inside(
        "2 Q1 = 0\n3 LBL 9\n4 Q1 = Q1 + 1\n5 LBL 1\n6 L IX+1\n7 CALL LBL 1 REP 2\n8 FN 12: IF +Q1 LT +2 GOTO LBL 9\n9 L IY+1"
    )
    assert run.toolpath[-1].end[:2].tolist() == [6, 1]


def test_a_jump_in_a_subprogram_stays_in_its_call(inside) -> None:
    """The subprogram jumps to a label above the main program's call; LBL 0 there goes back all the same."""
    run = inside(
        "2 FN 9: IF +0 EQU +0 GOTO LBL 3\n3 LBL 7\n4 L IY+1\n5 LBL 0\n6 LBL 3\n7 CALL LBL 1\n8 L IX+1\n9 CALL LBL 1\n10 M2\n"
        "11 LBL 1\n12 FN 9: IF +0 EQU +0 GOTO LBL 7\n13 L Z+9\n14 LBL 0"
    )
    assert run.ok, run.alarms
    assert run.toolpath[-1].end.tolist() == [1, 2, 0]


def test_labels_in_text_parameters(inside) -> None:
    run = inside(
        '2 QS1 = "S"\n3 CALL LBL QS1\n4 QS1 = "T"\n5 CALL LBL QS1\n6 M2\n'
        '7 LBL "S"\n8 L X+1\n9 LBL 0\n10 LBL "T"\n11 L Y+2\n12 LBL 0'
    )
    assert run.ok and run.toolpath[-1].end[:2].tolist() == [1, 2]


ENDLESS = {
    "jump": ("2 LBL 1\n3 FN 9: IF +0 EQU +0 GOTO LBL 1", 4),
    "two jumps": (
        "2 LBL 1\n3 FN 9: IF +0 EQU +0 GOTO LBL 2\n4 L X+1\n5 LBL 2\n6 L IX+1\n7 FN 10: IF +1 NE +0 GOTO LBL 1",
        None,
    ),
    "repeats": ("2 LBL 1\n3 LBL 2\n4 L IX+1\n5 CALL LBL 2 REP 9999\n6 CALL LBL 1 REP 9999", None),
    "in a subprogram": ("2 CALL LBL 1\n3 LBL 1\n4 LBL 2\n5 FN 9: IF +0 EQU +0 GOTO LBL 2\n6 LBL 0", None),
}


@pytest.mark.parametrize("name", ENDLESS)
def test_a_program_without_an_end_is_stopped(name: str, inside) -> None:
    blocks, line = ENDLESS[name]
    run = inside(blocks, most_blocks=2000)
    (alarm,) = run.alarms
    if name == "repeats":
        loop = "5 CALL LBL 2 REP 9999 in line 6, pass 1 of 9999"
        assert alarm.message == f"jumps, repeats and calls ran 2000 blocks without an end; in {loop}"
        assert "most_blocks" in alarm.hint and len(run.steps.block) < 2000 + len(run.program)
        assert run.alarms != inside(blocks, most_blocks=4000).alarms
    else:
        assert alarm.message.startswith("the program never gets out of this loop")
    assert line is None or abs(alarm.span.line - line) <= 1


def test_nested_as_deep_as_allowed(inside) -> None:
    """A chain of 20 subprograms runs; one more does not."""

    def chain(count: int) -> str:
        subprograms = "\n".join(f"9 LBL {k}\n9 L IX+1\n9 CALL LBL {k + 1}\n9 LBL 0" for k in range(1, count))
        return f"2 CALL LBL 1\n3 M2\n{subprograms}\n9 LBL {count}\n9 L IX+1\n9 LBL 0"

    assert inside(chain(20)).toolpath[-1].end[0] == 20
    (alarm,) = inside(chain(21)).alarms
    assert alarm.message == "calls are nested deeper than 20"


def test_both_tiers_agree_on_a_program_that_jumps_about(tnc) -> None:
    """Long runs of plain lines, met again by repeats, jumps and a subprogram."""
    plain = "\n".join(f"{k} L IX+1 Y+{k % 7} F{100 + k % 3}".replace("IX+1", f"X+{k}") for k in range(10, 90))
    text = (
        f"0 BEGIN PGM A MM\n1 TOOL CALL 1 Z F100\n2 Q1 = 0\n3 LBL 1\n{plain}\n4 L IZ-1\n{plain}\n5 CALL LBL 1 REP 2\n"
        f"6 Q1 = Q1 + 1\n7 CALL LBL 2\n8 FN 12: IF +Q1 LT +2 GOTO LBL 1\n{plain}\n9 M2\n"
        f"10 LBL 2\n{plain}\n11 LBL 0\n12 END PGM A MM\n"
    )
    one, other = tnc(text), tnc(text, bulk=False)
    assert one.ok, one.alarms
    assert str(one.toolpath) == str(other.toolpath)
    assert one.steps.block.tolist() == other.steps.block.tolist()
    assert one.history.at(len(one.steps.block) - 1) == other.history.at(len(one.steps.block) - 1)
