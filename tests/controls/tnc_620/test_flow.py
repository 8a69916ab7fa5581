"""Labels, repeats, Q parameters, FN functions and formulas."""

from __future__ import annotations

import pytest

from mnclab.controls.tnc_620.control import CONTROL, later


def test_subprogram_and_repeat(inside) -> None:
    run = inside(
        '2 CALL LBL "S"\n3 LBL 5\n4 L IY+1\n5 CALL LBL 5 REP 2/2\n6 CALL LBL "S"\n7 M30\n8 LBL "S"\n9 L IX+10\n10 LBL 0'
    )
    # S once, three passes of the section, S again
    assert run.toolpath.motion.end[:, :2].tolist() == [[10, 0], [10, 1], [10, 2], [10, 3], [20, 3]]


def test_repeat_inside_a_repeat(inside) -> None:
    """Each of the two outer passes runs the inner section three times: 2 * 3 = 6 steps of 1, and 2 of 10."""
    run = inside("2 LBL 1\n3 L IY+10\n4 LBL 2\n5 L IX+1\n6 CALL LBL 2 REP 2\n7 CALL LBL 1 REP 1")
    assert run.toolpath[-1].end[:2].tolist() == [6, 20] and len(run.toolpath.motion) == 8


def test_the_end_of_a_subprogram_does_nothing_in_a_repeated_section(inside) -> None:
    run = inside("2 LBL 1\n3 L IX+1\n4 LBL 0\n5 CALL LBL 1 REP 2\n6 L Y+1")
    assert run.toolpath[-1].end[:2].tolist() == [3, 1]


def test_repeat_inside_a_subprogram_returns_to_the_caller(inside) -> None:
    run = inside("2 CALL LBL 1\n3 L Y+7\n4 M2\n5 LBL 1\n6 LBL 2\n7 L IX+1\n8 CALL LBL 2 REP 3\n9 LBL 0")
    assert run.toolpath[-1].end[:2].tolist() == [4, 7]


@pytest.mark.parametrize(
    ("block", "value"),
    [
        ("FN 0: Q5 = +60", 60),
        ("FN 0: Q1 =+35", 35),
        ("FN 1: Q1 = -Q2 + -5", -8),
        ("FN 2: Q1 = +10 - +5", 5),
        ("FN 3: Q2 = +3 * +3", 9),
        ("FN 4: Q4 = +8 DIV +Q2", 8 / 3),
        ("FN 5: Q20 = SQRT 4", 2),
        ("fn5:q20=sqrt +Q2", 3**0.5),
        ("Q9 = 2 + Q2 * (1,5 - -0.5) ^ 2", 14),
        ("Q9 = 10 % 4 + SQ 3", 11),
        ("Q9 = SIN 30 + COS(60) + ATAN 1", 46),
        ("Q9 = SGN -4 + FRAC 2.25 + INT 3.9 + NEG 1 + ABS -2", -1 + 0.25 + 3 - 1 + 2),
        ("Q9 = EXP 0 + LN 1 + LOG 100 + ASIN 1 + ACOS 0", 1 + 0 + 2 + 90 + 90),
        ("QL7 = PI * 2", 6.283185307179586),
        ("QR499 = 1", 1),
    ],
)
def test_functions_of_q_parameters(block: str, value: float, inside) -> None:
    """Meanings of the catalogue's entry FN, with Q2 = 3."""
    run = inside(f"2 Q2 = 3\n3 {block}")
    target = block.upper().replace("FN", "").partition("=")[0].split(":")[-1].strip()
    assert run.ok and run.variables[target] == pytest.approx(value, rel=1e-15)


def test_pgm_model(tnc) -> None:
    run = tnc("2 FN 0: Q1 =+35\n3 FN 0: Q2 =+50\n4 FN 0: Q3 =+25\n")
    assert run.variables == {"Q1": 35, "Q2": 50, "Q3": 25}


def test_pgm_beams(tnc) -> None:
    """The lines that the manual prints, with the deviations that cycle 424 would leave."""
    run = tnc(
        "1 Q164 = 1.02\n2 Q165 = 0.97\n3 FN 0: Q1 = +81\n4 FN 0: Q2 = +61\n9 FN 2: Q1 = +Q1 - +Q164\n10 FN 2: Q2 = +Q2 - +Q165\n"
    )
    assert run.variables["Q1"] == pytest.approx(79.98) and run.variables["Q2"] == pytest.approx(60.03)


def test_parameters_in_words_count_as_they_stand(inside) -> None:
    run = inside("2 Q1 = 5\n3 LBL 1\n4 L X+Q1 Y-Q1\n5 Q1 = Q1 + 5\n6 CALL LBL 1 REP 1")
    assert run.toolpath.motion.end[:, :2].tolist() == [[5, -5], [10, -10]]


def test_every_entry_of_the_tables_says_what_it_is() -> None:
    for code, function in CONTROL.functions.items():
        assert code and function.title and function.doc and function.source, code
        assert function.phase in CONTROL.phases
    for cycle in CONTROL.cycles.values():
        assert cycle.title and cycle.source and cycle.__doc__
        for parameter in cycle.parameters():
            assert parameter.meaning and parameter.unit
            assert parameter.default is None or not parameter.refuses(parameter.default)
    assert not (set(CONTROL.refused) - set(later.WORDS)) & (set(CONTROL.functions) | set(CONTROL.cycles))
