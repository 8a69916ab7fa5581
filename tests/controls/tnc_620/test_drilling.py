"""Cycle 200 as one of all cycles: parameters in Q, FAUTO, limits, calls. Its examples: test_drilling_examples.py."""

from __future__ import annotations

import pytest

import mnclab as mnc

DEFINITION = "CYCL DEF 200 D\nQ200=2\nQ201=-15\nQ206=250\nQ202=5\nQ210=0\nQ203=0\nQ204=20\nQ211=0\n"


def test_rows_carry_the_line_of_the_calling_block(tnc) -> None:
    run = tnc(f"11 {DEFINITION}12 L X+30 Y+20 FMAX M3\n13 CYCL CALL\n14 L X+80 Y+50 FMAX M99\n")
    cut = run.toolpath[run.toolpath.kind == mnc.Kind.LINE]
    assert cut.line.tolist() == [11] * 3 + [12] * 3
    assert cut.end[:, :2].tolist() == [[30, 20]] * 3 + [[80, 50]] * 3


def test_dwell_at_the_top_and_end_at_the_set_up_plane(inside, drilled) -> None:
    """Q210 = 1 s above each further infeed; Q204 not greater than Q200: the tool ends at A = 2."""
    definition = DEFINITION.replace("Q210=0", "Q210=1").replace("Q204=20", "Q204=1").replace("Q202=5", "Q202=8")
    run = inside(f"2 {definition}3 CYCL CALL M3")
    assert drilled(run) == ["Z2 FMAX", "Z-8 F250", "Z2 FMAX", "dwell 1 s", "Z-6 FMAX", "Z-15 F250", "Z2 FMAX"]


@pytest.mark.parametrize("infeed", ["0", "15", "40"])
def test_one_pass(infeed: str, inside, drilled) -> None:
    run = inside(f"2 {DEFINITION.replace('Q202=5', 'Q202=' + infeed)}3 CYCL CALL M3")
    assert drilled(run) == ["Z2 FMAX", "Z-15 F250", "Z20 FMAX"]


def test_depth_zero_is_not_executed(inside, drilled) -> None:
    run = inside(f"2 {DEFINITION.replace('Q201=-15', 'Q201=0')}3 CYCL CALL M3")
    assert run.ok and drilled(run) == []


def test_positive_depth_where_it_is_allowed(inside, drilled) -> None:
    """displayDepthErr off: A = S - Q200 = -2, upwards to 15, back to A, and to the end plane S + Q204 = 20."""
    definition = DEFINITION.replace("Q201=-15", "Q201=15").replace("Q202=5", "Q202=10")
    run = inside(f"2 {definition}3 CYCL CALL M3", depth_error=False)
    assert drilled(run) == ["Z-2 FMAX", "Z10 F250", "Z-2 FMAX", "Z8 FMAX", "Z15 F250", "Z-2 FMAX", "Z20 FMAX"]


def test_definition_alone_moves_nothing(tnc) -> None:
    """The definition of 3.1, with a positive depth and a decimal comma: legal until it is called."""
    text = (
        DEFINITION.replace("Q201=-15", "Q201=3")
        .replace("Q211=0", "Q211=0,25")
        .replace("Q204=20", "Q204=50")
        .replace("250", "150")
    )
    run = tnc(f"7 {text}Q395=0\n")
    assert run.ok and len(run.toolpath) == 0
    expected = {"Q200": 2, "Q201": 3, "Q206": 150, "Q202": 5, "Q210": 0, "Q203": 0, "Q204": 50, "Q211": 0.25, "Q395": 0}
    assert run.variables == expected


@pytest.mark.parametrize(("assignment", "plane"), [("FN 0: Q1 = +9", 2), ("FN 0: Q200 = +9", 9), ("Q200 = 4 + 5", 9)])
def test_parameters_are_read_at_the_call(assignment: str, plane: float, tnc, drilled) -> None:
    """3.1: an indirect parameter is bound at the definition, the parameter itself counts until the call."""
    definition = DEFINITION.replace("Q200=2", "Q200=Q1").replace("Q204=20", "Q204=50")
    run = tnc(f"1 FN 0: Q1 = +2\n2 {definition}3 {assignment}\n4 L X+10 Y+10 R0 FMAX M3 M99\n")
    assert drilled(run)[0] == f"Z{plane} FMAX"


def test_a_parameter_out_of_its_range_at_the_call(inside) -> None:
    run = inside(f"2 {DEFINITION}3 Q210 = -1\n4 CYCL CALL M3")
    (alarm,) = [a for a in run.alarms if a.severity == "alarm"]
    assert (
        alarm.message == "CYCL DEF 200 Q210 (dwell at the set-up clearance) must be at least 0 and at most 3600, got -1"
    )
    assert alarm.span[:2] == (8, 1)  # the word of the definition


def test_a_default_left_by_another_definition_does_not_count(tnc, drilled) -> None:
    """Q395 = 1 of an earlier definition is gone when the next one leaves Q395 out."""
    setup = mnc.Setup(tools={2: mnc.Tool(radius=2.4, angle=120)})
    run = tnc(f"1 TOOL CALL 2 Z S1000\n2 {DEFINITION}Q395=1\n3 {DEFINITION}4 CYCL CALL M3\n", setup)
    assert drilled(run)[-2] == "Z-15 F250" and run.variables["Q395"] == 0


def test_fauto_is_bound_at_the_definition(tnc, drilled) -> None:
    definition = DEFINITION.replace("Q206=250", "Q206=FAUTO")
    run = tnc(f"1 TOOL CALL 1 Z S1000 F333\n2 {definition}3 TOOL CALL Z F444\n4 CYCL CALL M3\n")
    assert drilled(run)[1] == "Z-5 F333" and run.variables["Q206"] == 333


def test_in_inches(tnc, drilled) -> None:
    """Q parameters stay inches; the moves are mm: A = 2 in = 50.8, one pass to -1 in, feed 10 x 0.1 in/min = 25.4."""
    definition = DEFINITION.replace("Q201=-15", "Q201=-1").replace("Q206=250", "Q206=10").replace("Q204=20", "Q204=3")
    run = tnc(f"0 BEGIN PGM I INCH\n1 TOOL CALL 1 Z S1000 F20\n2 {definition}3 CYCL CALL M3\n")
    assert drilled(run) == ["Z50.8 FMAX", "Z-25.4 F25.4", "Z76.2 FMAX"] and run.variables["Q200"] == 2


def test_in_shifted_coordinates(inside, drilled) -> None:
    run = inside(f"2 CYCL DEF 7.0 S\n3 CYCL DEF 7.1 Z+100\n4 {DEFINITION.replace('Q202=5', 'Q202=0')}5 CYCL CALL M3")
    assert drilled(run) == ["Z102 FMAX", "Z85 F250", "Z120 FMAX"]


def test_the_feed_of_a_call_is_not_that_of_the_cycle(inside, drilled) -> None:
    run = inside(f"2 {DEFINITION.replace('Q202=5', 'Q202=0')}3 CYCL CALL F77 M3\n4 L Z+30\n5 CYCL CALL FMAX")
    assert drilled(run) == ["Z2 FMAX", "Z-15 F250", "Z20 FMAX", "Z30 F77", "Z2 FMAX", "Z-15 F250", "Z20 FMAX"]


def test_a_transformation_between_definition_and_call_keeps_the_cycle(inside, drilled) -> None:
    """DEF-active cycles do not replace the cycle that a call runs."""
    run = inside(f"2 {DEFINITION.replace('Q202=5', 'Q202=0')}3 CYCL DEF 7.0 S\n4 CYCL DEF 7.1 Z+1\n5 CYCL CALL M3")
    assert drilled(run) == ["Z3 FMAX", "Z-14 F250", "Z21 FMAX"]


def test_what_a_call_should_have_before_it(tnc) -> None:
    run = tnc(f"1 {DEFINITION}2 CYCL CALL\n")
    assert run.ok and [a.message for a in run.alarms] == [
        "CYCL CALL: no tool was called",
        "CYCL CALL: the spindle does not turn",
    ]
