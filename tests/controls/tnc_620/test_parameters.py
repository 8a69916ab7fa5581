"""FN functions, kinds of parameters, texts, and what the control keeps in parameters."""

from __future__ import annotations

import math
import random

import pytest

import mnclab as mnc


def value(inside, blocks: str, name: str = "Q1"):
    run = inside(blocks)
    assert run.ok, run.alarms
    return run.variables[name]


# --- FN ---------------------------------------------------------------------------------------------------------------


def test_two_hundred_functions_are_those_of_python(inside) -> None:
    """FN 0 to FN 8 and FN 13 with operands made from a seed, as numbers or as parameters with a sign."""
    rng, blocks, expected = random.Random(620), ["2 Q50 = 3.5\n3 QL5 = -2.25\n4 QR7 = 80"], []
    parameters = {"Q50": 3.5, "QL5": -2.25, "QR7": 80.0}
    functions = {
        0: ("{}", lambda a, b: a), 1: ("{} + {}", lambda a, b: a + b), 2: ("{} - {}", lambda a, b: a - b),
        3: ("{} * {}", lambda a, b: a * b), 4: ("{} DIV {}", lambda a, b: a / b), 5: ("SQRT {}", lambda a, b: math.sqrt(a)),
        6: ("SIN {}", lambda a, b: math.sin(math.radians(a))), 7: ("COS {}", lambda a, b: math.cos(math.radians(a))),
        8: ("{} LEN {}", lambda a, b: math.sqrt(a * a + b * b)),
        13: ("{} ANG {}", lambda a, b: math.degrees(math.atan2(a, b)) % 360),
    }  # fmt: skip

    def operand(least: float) -> tuple[str, float]:
        if rng.random() < 0.4:
            name, sign = rng.choice(list(parameters)), rng.choice(["+", "-", ""])
            found = parameters[name] * (-1 if sign == "-" else 1)
            return (sign + name, found) if found >= least else operand(least)
        number = round(rng.uniform(max(least, -99), 99), 3) or 1.0
        return f"{number:+}" if rng.random() < 0.5 else f"{number}".replace(".", ","), number

    for k in range(200):
        number = rng.choice(list(functions))
        form, function = functions[number]
        (one, a), (other, b) = operand(0 if number == 5 else -99), operand(-99)
        blocks.append(f"{k + 5} FN {number}: Q{k + 1000} = {form.format(one, other)}")
        expected.append(function(a, b))
    run = inside("\n".join(blocks))
    assert run.ok, run.alarms
    assert [run.variables[f"Q{k + 1000}"] for k in range(200)] == pytest.approx(expected, rel=1e-13, abs=1e-13)


@pytest.mark.parametrize(
    ("block", "expected"),
    [
        ("FN 6: Q1 = SIN -Q5", -0.5),  # with Q5 = 30
        ("FN 7: Q1 = COS -Q5", math.sqrt(3) / 2),
        ("FN 8: Q1 = +5 LEN +4", math.sqrt(41)),
        ("fn8:q1=+3len4", 5),
        ("FN 13: Q1 = +25 ANG +50", 26.56505117707799),  # arctan 0.5
        ("FN 13: Q1 = +25 ANG -Q5", 180 - 39.80557109226519),  # arctan 25/30 = 39.8056 degrees
        ("FN 13: Q1 = -1 ANG +0", 270),
        ("FN 13: Q1 = 0 ANG +4", 0),
    ],
)
def test_functions_with_two_operands(block: str, expected: float, inside) -> None:
    assert value(inside, f"2 Q5 = 30\n3 {block}") == pytest.approx(expected, rel=1e-14)


def test_a_parameter_loses_its_value(inside) -> None:
    run = inside(
        "2 Q5 = 1\n3 FN 0: Q5 SET UNDEFINED\n4 FN 9: IF Q5 IS UNDEFINED GOTO LBL 1\n5 Q6 = 1\n6 LBL 1\n7 L X+Q5"
    )
    (alarm,) = run.alarms
    assert (alarm.message, alarm.span[:2]) == ("no value was given to Q5", (8, 7))
    assert "Q5" not in run.variables and "Q6" not in run.variables
    assert run.history["Q5"][2:5] == [1.0, None, None]


def test_an_error_of_the_program_stops_it(inside) -> None:
    run = inside("2 L X+5\n3 FN 14: ERROR = 1000\n4 L X+9")
    (alarm,) = run.alarms
    assert (alarm.message, alarm.span[:2]) == ("FN 14: the program stops with error 1000", (4, 18))
    assert run.toolpath[-1].end[0] == 5


def test_system_data(inside) -> None:
    """Tool, axis, speed, spindle, coolant and feed; the scale of each axis, 1 where nothing scales."""
    run = inside(
        "2 L X+5 F250 M13\n3 FN 18: SYSREAD Q1 = ID20 NR1\n4 FN 18: SYSREAD Q3 = ID20 NR3\n5 FN 18:SYSREAD Q4 = ID 20 NR 4\n"
        "6 Q9 = 5\n7 FN 18: SYSREAD QL5 = ID20 NRQ9\n8 FN 18: SYSREAD Q8 = ID20 NR8\n9 FN 18: SYSREAD Q9 = ID20 NR9\n"
        "10 FN 18: SYSREAD Q25 = ID210 NR4\n11 FN 18: SYSREAD Q26 = ID210 NR4 IDX3"
    )
    assert run.ok, run.alarms
    found = {name: run.variables[name] for name in ("Q1", "Q3", "Q4", "QL5", "Q8", "Q9", "Q25", "Q26")}
    assert found == {"Q1": 1, "Q3": 2, "Q4": 1000, "QL5": 0, "Q8": 1, "Q9": 250, "Q25": 1, "Q26": 1}


def test_the_input_of_the_probe(inside) -> None:
    run = inside("2 FN 17: SYSWRITE ID 990 NR 6 = +1")
    assert run.ok and run.history["probe input"][2] == 1


# --- kinds of parameters --------------------------------------------------------------------------------------------


def test_the_greatest_numbers(inside) -> None:
    run = inside('2 Q1999 = 1\n3 QL499 = 2\n4 QR499 = 3\n5 QS1999 = "d"\n6 Q0 = 4')
    assert run.variables == {"Q1999": 1, "QL499": 2, "QR499": 3, "QS1999": "d", "Q0": 4}


def test_remanent_parameters_come_from_the_program_before(inside) -> None:
    before = inside('2 QR5 = 7.5\n3 QS1 = "A"\n4 QL5 = 1')
    after = inside("2 Q2 = QR5 * 2\n3 QS3 = QS1 || QS1", mnc.Setup(variables=before.variables))
    assert after.ok and after.variables == {"QR5": 7.5, "QS1": "A", "Q2": 15, "QS3": "AA"}
    refused = inside("2 Q2 = QL5", mnc.Setup(variables=before.variables))
    assert [alarm.message for alarm in refused.alarms] == ["no value was given to QL5"]


@pytest.mark.parametrize("wrong", [{"Q2000": 1}, {"Q1": "A"}, {"QS1": 5}, {"X": 1}])
def test_values_that_no_parameter_can_have(wrong: dict[str, object], inside) -> None:
    (alarm,) = inside("2 L X+1", mnc.Setup(variables=wrong)).alarms
    assert "cannot be" in alarm.message


@pytest.mark.parametrize("wrong", [math.nan, [1]])
def test_what_is_no_value_of_any_parameter_is_refused_by_the_setup(wrong: object) -> None:
    with pytest.raises(mnc.Alarm, match=r"variables\['Q1'\] must be a"):
        mnc.Setup(variables={"Q1": wrong})


def test_a_control_without_variables_takes_none() -> None:
    (alarm,) = mnc.run("G0 X5\n", "mnc", mnc.Setup(variables={"Q1": 5})).alarms
    assert alarm.message == "Setup(variables=…): programs of mnc have no variables"


def test_parameters_local_to_a_contour_subprogram(inside) -> None:
    """A contour reads only the QL parameters that it assigns itself (chapter 8), and leaves the others alone."""
    data = (
        "2 CYCL DEF 14.0 CONTOUR\n3 CYCL DEF 14.1 LABEL1\n4 CYCL DEF 20 CONTOUR DATA\nQ1=-5\nQ2=1\nQ3=0\nQ4=0\nQ5=0\nQ6=2\n"
        "Q7=50\nQ8=0\nQ9=1\n5 CYCL DEF 22 ROUGH-OUT\nQ10=-5\nQ11=100\nQ12=200\nQ18=0\nQ19=0\nQ208=500\n6 QL1 = 30\n"
    )
    contour = "10 LBL 1\n{}12 L X+0 Y+0 RL\n13 L X+QL1\n14 L Y+40\n15 L X+0\n16 L Y+0\n17 LBL 0"
    good = inside(data + "7 CYCL CALL M3\n8 Q30 = QL1\n9 M30\n" + contour.format("11 QL1 = 40\n"))
    assert good.ok, good.alarms
    assert good.variables["Q30"] == good.variables["QL1"] == 30
    assert good.toolpath.end[:, 0].max() == pytest.approx(35, abs=0.1)  # 40 less the radius 5
    bad = inside(data + "7 CYCL CALL M3\n9 M30\n" + contour.format(""))
    assert [(alarm.message, alarm.span.line) for alarm in bad.alarms if alarm.severity == "alarm"] == [
        ("no value was given to QL1", 27)
    ]


# --- texts ------------------------------------------------------------------------------------------------------------


def test_texts_in_programs(inside) -> None:
    run = inside(
        '2 QS1 = "DRILL"\n3 DECLARE STRING QS2 = "8"\n4 Q5 = 2.5\n5 QS3 = QS1 || " " || QS2 || TOCHAR(DAT+Q5 DECIMALS2)\n'
        "6 Q6 = TONUMB ( SRC_QS2 )\n7 Q7 = STRLEN(SRC_QS3)\n8 Q8 = INSTR(SRC_QS3 SEA_QS2 BEG1)\n9 Q9 = STRCOMP(SRC_QS1 SEA_QS2)\n"
        "10 QS4 = SUBSTR(SRC_QS3 BEG6 LEN1)"
    )
    assert run.ok, run.alarms
    assert run.variables == {
        "QS1": "DRILL", "QS2": "8", "Q5": 2.5, "QS3": "DRILL 82.50", "Q6": 8, "Q7": 11, "Q8": 6, "Q9": 1, "QS4": "8",
    }  # fmt: skip
    assert run.history["QS1"][2] == "DRILL"


# --- what the control keeps -----------------------------------------------------------------------------------------


def test_the_tool_in_parameters(tnc) -> None:
    tools = {7: mnc.Tool(number=7, radius=4, length=80, dr=0.1, dl=-0.5)}
    text = "0 BEGIN PGM A MM\n1 Q1 = Q109\n2 TOOL CALL 7 Z S500 DL+0.2 DR-0.3\n3 Q2 = Q108\n4 Q3 = Q109\n5 Q4 = Q114\n"
    run = tnc(text, mnc.Setup(tools=tools))
    assert run.ok, run.alarms
    assert run.variables == pytest.approx({"Q1": -1, "Q2": 4 + 0.1 - 0.3, "Q3": 2, "Q4": 80 - 0.5 + 0.2})


def test_spindle_and_coolant_in_parameters(inside) -> None:
    blocks = "Q1 = Q110; M3; Q2 = Q110; M5; Q3 = Q110; M14; Q4 = Q110; Q5 = Q111; M5 M9; Q6 = Q110; Q7 = Q111"
    run = inside("\n".join(f"{k} {block}" for k, block in enumerate(blocks.split("; "), 2)))
    assert run.ok, run.alarms
    assert [run.variables[f"Q{k}"] for k in range(1, 8)] == [-1, 0, 2, 1, 1, 3, 0]


def test_the_unit_and_the_overlap_in_parameters(tnc) -> None:
    run = tnc("0 BEGIN PGM A INCH\n1 TOOL CALL 1 Z\n2 Q1 = Q113\n3 Q2 = Q108\n4 Q3 = Q112\n", overlap=1.4)
    assert run.ok and run.variables == pytest.approx({"Q1": 1, "Q2": 5 / 25.4, "Q3": 1.4})
    assert tnc("0 BEGIN PGM A MM\n1 Q1 = Q113\n").variables["Q1"] == 0


def test_explained_formulas_show_their_values(inside) -> None:
    run = inside('2 QS1 = "AB"\n3 QS2 = QS1 || "C"\n4 Q1 = STRLEN(SRC_QS2)\n5 FN 9: IF Q1 EQU +3 GOTO LBL 1\n6 LBL 1')
    assert 'QS1 || "C"  formula of QS (Text) = "ABC"' in str(run.explain(4))
    assert "formula of Q (Formula) = 3" in str(run.explain(5))
    assert "the first operand of FN 9 (Jump if equal) = 3" in str(run.explain(6))
