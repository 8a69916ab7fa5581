"""Lines of programs from workshops and schools: block numbers with N, brackets, long comments, repeats by a parameter."""

from __future__ import annotations

import pytest

import mnclab as mnc


def ends(run: mnc.Run) -> list[tuple[float, ...]]:
    assert run.ok, run.alarms
    return [tuple(end) for end in run.toolpath.motion.end.round(9).tolist()]


def test_block_numbers_may_begin_with_n(tnc) -> None:
    text = "N0 BEGIN PGM A INCH\nN1 TOOL CALL 1 Z S100\nN2 L X1 FMAX\n/N3 L X+9 FMAX\nN4 L Y+2 FMAX ;N5\nN5 END PGM A INCH\n"
    run = tnc(text, block_skip=True)
    assert ends(run) == [(25.4, 0, 0), (25.4, 50.8, 0)] and not run.alarms
    assert [block.number for block in run.program] == ["N0", "N1", "N2", "N3", "N4", "N5"]


def test_a_line_in_brackets_is_a_comment_and_is_told_once(tnc) -> None:
    text = '( sheet of the machine\n(  X+5 "A\n($Message("B") )\n0 BEGIN PGM A MM\n1 L X+5 FMAX\n2 ( more )\n3 END PGM A MM\n'
    run = tnc(text)
    (warning,) = run.alarms
    assert ends(run) == [(5, 0, 0)] and warning.severity == "warning" and warning.span[:2] == (1, 1)
    assert warning.message == "lines that begin with a bracket are read as comments"


def test_a_bracket_begins_no_comment_elsewhere(inside) -> None:
    (alarm,) = inside("2 L X+5 (up)").alarms
    assert (alarm.severity, alarm.span[:2]) == ("alarm", (3, 9))
    run = inside("2 Q1 = ( 2 + 3 ) * 2\n3 L X+Q1 FMAX")
    assert ends(run) == [(10, 0, 0)]


@pytest.mark.parametrize("before", [";free~", "2 Q1 = 5 ; half of the width~", "2 L X+5 FMAX ;to the corner ~", "2 LBL 1 ;a~"])
def test_a_long_comment_goes_on_behind_its_mark(before: str, inside) -> None:
    """As the control writes it: the line is full, ~, and the rest of the remark stands in the next line."""
    run = inside(f"{before}\n minus cutter width~\n and so on)\n3 L Y+7 FMAX")
    assert ends(run)[-1][1] == 7 and not run.alarms


def test_what_looks_like_a_word_in_it_is_named(inside) -> None:
    run = inside("2 L X+5 FMAX ;to the corner ~\n Y+9 M8\n3 L Z+7 FMAX")
    assert ends(run) == [(5, 0, 0), (5, 0, 7)]
    told = [(a.severity, a.span[:2], a.message) for a in run.alarms]
    assert told == [
        ("warning", (4, 2), "Y+9 is read as part of the comment above and not obeyed"),
        ("warning", (4, 6), "M8 is read as part of the comment above and not obeyed"),
    ]


def test_parameters_go_on_behind_a_comment_as_ever(inside) -> None:
    """After ~ behind a remark the next parameter of a cycle stands, and behind one without a remark the next words."""
    shift, line = "2 CYCL DEF 7.0 X\n3 CYCL DEF 7.1 X+5", "4 L X+1~\n Y+2 ~\n FMAX"
    run = inside(f"{shift}\n{line}\n5 CYCL DEF 247 X ;a ~\n;b\nQ339=0 ;NUMBER\n6 L X+9 FMAX")
    assert ends(run) == [(6, 2, 0), (9, 2, 0)] and not run.alarms


@pytest.mark.parametrize("times", ["REP2", "REP 2/2", "REPQ1", "REP Q1", "REP+Q1"])
def test_a_section_is_repeated_as_often_as_a_parameter_says(times: str, inside) -> None:
    run = inside(f"2 Q1 = 2\n3 LBL 1\n4 L IX+3 FMAX\n5 CALL LBL 1 {times}")
    assert [end[0] for end in ends(run)] == [3, 6, 9]


@pytest.mark.parametrize(("words", "seconds"), [("TIME10", 10), ("TIME .5", 0.5), ("TIMEQ1", 4), ("REV5", 0.3), ("REV Q1", 0.24)])
def test_function_dwell(words: str, seconds: float, inside) -> None:
    """Turns at 1000 rev/min last 60 / 1000 s each."""
    run = inside(f"2 Q1 = 4\n3 M3\n4 FUNCTION DWELL {words}")
    assert run.ok and run.toolpath.time[run.toolpath.kind == mnc.Kind.DWELL] == pytest.approx([seconds])


@pytest.mark.parametrize("end", ["R F M", "F M", "M", "r f m", "R  F M ;"])
def test_empty_words_of_older_controls_change_nothing(end: str, inside) -> None:
    """Compensation and feed hold on: 5 mm beside the second line, at 77."""
    run = inside(f"2 L X+0 Y-20 R0 F MAX M3\n3 L X+10 Y+0 RL F77 M\n4 L X+50 {end}\n5 L Y-20 R0 F M")
    assert ends(run)[1:3] == [(10, 5, 0), (50, 5, 0)] and not run.alarms
    assert run.toolpath.motion.feed.tolist()[1:] == [77] * 3 and run.toolpath.motion.side.tolist() == [0, 1, 1, 0]


def test_an_empty_rep_calls_the_subprogram(inside) -> None:
    run = inside("2 CALL LBL 1 REP\n3 L Y+1 FMAX\n4 M30\n5 LBL 1\n6 L IX+3 FMAX\n7 LBL 0")
    (warning,) = run.alarms
    assert ends(run) == [(3, 0, 0), (3, 1, 0)] and (warning.severity, warning.span[:2]) == ("warning", (3, 14))


def test_trans_datum_shifts_as_cycle_7_does(inside) -> None:
    """X 10, then 10 + 5; Y stays at 20; the reset takes both away, and the shift of cycle 7."""
    shifts = ["TRANS DATUM AXIS X+10 Y+20", "TRANS DATUM AXIS IX+5", "TRANS DATUM RESET"]
    run = inside("\n".join(f"{number} {each}\n{number} L X+1 Y+1 FMAX" for number, each in enumerate(shifts, 2)))
    assert ends(run) == [(11, 21, 0), (16, 21, 0), (1, 1, 0)]
    assert ends(inside("2 CYCL DEF 7.0 X\n3 CYCL DEF 7.1 Z+9\n4 TRANS DATUM RESET\n5 L Z+1 FMAX")) == [(0, 0, 1)]
