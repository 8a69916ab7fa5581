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


@pytest.mark.parametrize("feed", ["R F500", "R FMAX", "R F MAX", "R F+500", "R FQ1", "R F500 M3"])
def test_r_without_a_value_before_a_feed_is_no_word(feed: str, inside) -> None:
    """As TNC 145 to 355 write their blocks, R F M of an L that changes the feed alone: the compensation stays as it is."""
    run = inside(f"2 Q1 = 500\n3 L X+5 Y+0 {feed}\n4 L X+9")
    assert ends(run)[-1] == (9, 0, 0) and not [alarm for alarm in run.alarms if alarm.severity == "alarm"]
    assert run.toolpath.motion.feed[0] == (float("inf") if "M" in feed.replace("M3", "") else 500)


# --- a formula on several lines ------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "formula", ["2 * ( 3 ~\n    + 4 ) ~\n - 1", "2 * ( 3~\n+ 4 ) - 1 ;width", "2 * ( 3 + 4 ) ~\n- 1 ;wide~\n and so on"]
)
@pytest.mark.parametrize("name", ["Q7", "QL7", "QR7"])
def test_a_formula_goes_on_behind_its_mark(name: str, formula: str, inside) -> None:
    """As the control breaks a long one: 2 (3 + 4) - 1 = 13; the block behind it counts as ever."""
    run = inside(f"2 {name} = {formula}\n3 L X+{name} FMAX\n4 L Y+2 FMAX")
    assert ends(run) == [(13, 0, 0), (13, 2, 0)] and not run.alarms


@pytest.mark.parametrize(
    ("formula", "place", "message"),
    [
        ("2 * ( 3 ~\n  + $ )", (4, 5), "'$' is no part of an expression"),
        ("2 * ~\n ( 3 + 4 ) 5", (4, 12), "an operator was expected before 5"),
        ("2 + ~\n", (3, 11), "the expression ends where a number or a variable was expected"),
        ("2 + ~\n 1 / 0", (4, 4), "division by zero"),
    ],
)
def test_a_fault_of_a_formula_is_told_where_it_stands(formula: str, place: tuple[int, int], message: str, inside) -> None:
    (alarm,) = inside(f"2 Q15 = {formula}\n3 L Y+2 FMAX").alarms
    assert alarm.message.startswith(message) and alarm.span[:2] == place


# --- what an editor or a mailer wrapped out of a comment -----------------------------------------------------------------


@pytest.mark.parametrize("before", ["2 ; the outer contour, to be", "2 L X+5 FMAX ; the corner, to be", "2 LBL 1 ;a"])
@pytest.mark.parametrize("rest", ["milled in two passes", "gefräst: Ø ist egal", "milled\nin two passes, both\nwith coolant"])
def test_the_rest_of_a_comment_is_passed_over_and_told(before: str, rest: str, inside) -> None:
    run = inside(f"{before}\n{rest}\n3 L Y+7 FMAX")
    assert ends(run)[-1][1] == 7 and len(run.toolpath.motion) == 1 + ("X+5" in before)
    (warning,) = run.alarms
    assert warning.severity == "warning" and warning.message.startswith("this line is read as the rest of the comment above")
    assert warning.span[:2] == (4, 1) and ("(lines 5, 6)" in str(warning)) == ("\n" in rest)


def test_the_rest_of_a_comment_within_a_definition(inside) -> None:
    """Below Q200 and its remark; the parameters behind it still belong to the cycle."""
    words = "Q200=2 ;the clearance that\nthis shop always takes\nQ201=-15\nQ206=250\nQ202=5\nQ210=0\nQ203=0\nQ204=50\nQ211=0"
    run = inside(f"2 CYCL DEF 200 X\n{words}\n3 L X+5 Y+0 FMAX M3\n4 CYCL CALL")
    assert run.ok and [a.span[:2] for a in run.alarms if "rest of the comment" in a.message] == [(5, 1)]
    assert run.toolpath.end[:, 2].min() == pytest.approx(-15, abs=1e-9)


@pytest.mark.parametrize(
    "line",
    ["of two passes X+5", "with FMAX", "stops here", "CYCLO DEF 200", "X +5", "Q1 +5", "R0 to here", "IF Q1 = Q2 GOTO LBL 2",
     "go to LBL two", "see Q5"],
)  # fmt: skip
def test_a_line_that_may_be_a_block_is_no_rest_of_a_comment(line: str, inside) -> None:
    """A word of a block in it, or a statement that it is nearly: it is refused where it stands."""
    run = inside(f"2 ; to be\n{line}\n3 L Y+7 FMAX")
    assert not run.ok and run.alarms[0].span.line == 4


def test_a_numbered_line_is_no_rest_of_a_comment(inside) -> None:
    (alarm,) = inside("2 ; to be\n3 milled in two\n4 L Y+7 FMAX").alarms
    assert (alarm.severity, alarm.span[:2]) == ("alarm", (4, 3)) and "rest of the comment" not in alarm.hint


# --- spellings that stand for what the control writes otherwise ------------------------------------------------------------


def test_cycle_is_read_as_cycl(inside) -> None:
    """Definitions in both formats and a call; each is told once."""
    text = "2 CYCL DEF 7.0 X\n3 CYCL DEF 7.1 X+5\n4 CYCL DEF 200 X\n"
    text += "Q200=2\nQ201=-15\nQ206=250\nQ202=5\nQ210=0\nQ203=0\nQ204=50\nQ211=0\n"
    text += "5 L X+0 Y+3 FMAX M3\n6 CYCL CALL\n7 CYCL CALL POS X+2 Y+3 Z+0 FMAX"
    expected, run = inside(text), inside(text.replace("CYCL ", "cycle "))
    assert ends(run) == ends(expected)
    (warning,) = [a for a in run.alarms if "CYCL" in a.message]
    assert warning.severity == "warning" and warning.span[:2] == (3, 3) and warning.hint == "write CYCL"
    assert "lines 4, 5, 15, 16" in str(warning)


@pytest.mark.parametrize("words", ["R+8 DR- R0", "R+8 R0 DR-", "DR- R+8 R0", "R+8 DR- R0 F200", "DR-~\n R+8~\n R0"])
def test_r0_behind_the_radius_of_an_arc_is_no_compensation(words: str, inside) -> None:
    """A half turn of 8 about (8, 0), clockwise: its top is (8, 8)."""
    run = inside(f"2 L X+0 Y+0 F100 M3\n3 CR X+16 Y+0 {words}")
    assert ends(run)[-1] == (16, 0, 0) and not run.alarms
    arc = run.toolpath.motion[-1]
    assert arc.kind == mnc.Kind.ARC and arc.centre == pytest.approx((8, 0, 0), abs=1e-9)


def test_r0_in_front_of_the_radius_stays_a_radius(inside) -> None:
    (alarm,) = inside("2 L X+0 Y+0 F100 M3\n3 CR X+16 Y+0 R0 R+8 DR-").alarms
    assert alarm.message == "R is written twice in this block"


def test_a_feed_word_of_a_cycle_without_equals(inside) -> None:
    """Q206 FAUTO is the 80 of TOOL CALL, FU0.1 is 100 at S1000, and FMAX has no such place."""
    head = "2 TOOL CALL 1 Z S1000 F80\n3 CYCL DEF 200 X\nQ200=2\nQ201=-15\n"
    rest = "\nQ202=5\nQ210=0\nQ203=0\nQ204=50\nQ211=0\n4 L X+5 FMAX M3\n5 CYCL CALL"
    for word, feed in (("FAUTO", 80), ("F AUTO", 80), ("AUTO", 80), ("FU0.1", 100), ("FU 0,1", 100)):
        run = inside(f"{head}Q206 {word}{rest}")
        assert run.ok and min(run.toolpath.motion.feed) == pytest.approx(feed), word
        (warning,) = [a for a in run.alarms if "Q206" in a.message]
        assert warning.severity == "warning" and warning.span[:2] == (7, 1) and warning.hint == "write Q206= before the word"
    alarm = inside(f"{head}Q206 FMAX{rest}").alarms[-1]
    assert alarm.severity == "alarm" and alarm.message.endswith("must be a number, FAUTO, FU, got FMAX")


@pytest.mark.parametrize(("end", "told"), [("END PGM", "neither name"), ("END PGM A", "no unit"), ("end pgm a b", "no unit")])
def test_the_end_of_a_program_needs_no_unit(end: str, told: str, tnc) -> None:
    run = tnc(f"0 BEGIN PGM A MM\n1 L X+5 FMAX\n2 {end}\n")
    assert ends(run) == [(5, 0, 0)]
    warning = run.alarms[0]
    assert warning.severity == "warning" and told in warning.message and warning.span.line == 3


def test_the_end_of_a_program_may_name_another(tnc) -> None:
    run = tnc("0 BEGIN PGM A MM\n1 L X+5 FMAX\n2 END PGM B\n")
    assert run.ok and "END PGM names B, BEGIN PGM A" in [a.message for a in run.alarms]


def test_a_feed_of_a_tool_definition_is_told(inside) -> None:
    """The feed of the program stays the one of L: 100."""
    run = inside("2 L F100\n3 TOOL DEF 1 L+10 R+3 F700\n4 L X+5 M3")
    assert run.ok and run.toolpath.motion.feed[-1] == 100
    (warning,) = [a for a in run.alarms if "TOOL DEF takes no feed" in a.message]
    assert warning.severity == "warning" and warning.span[:2] == (4, 23)
