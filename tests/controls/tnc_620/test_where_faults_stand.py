"""Where the faults of a called cycle stand: those of the machine at the call, those of the values at the definition."""

from __future__ import annotations

import pytest

import mnclab as mnc
from mnclab.machine import trial

CYCLES = mnc.controls["tnc-620"].cycles
CALLS = {
    "CYCL CALL": ("CYCL CALL\n", 1), "M99": ("L X+20 Y+10 R0 FMAX M99\n", 1),
    "POS": ("CYCL CALL POS X+1 Y+2 Z+0 FMAX\n", 1), "PAT": ("PATTERN DEF POS1 (X+1 Y+2 Z+0)\nCYCL CALL PAT FMAX\n", 2),
    "label": ("CALL LBL 1\nM2\nLBL 1\nCYCL CALL\nLBL 0\n", 4),
}  # fmt: skip


def program(code: str, spindle: str, call: str, speed: int = 500) -> tuple[str, int]:
    """The trial program of a cycle under another spindle and another call; the line of the call."""
    if code == "CYCL DEF 18":
        text = (
            "BEGIN PGM A MM\nTOOL CALL 2 Z S1000\nL X+0 Y+0 Z+50 R0 FMAX M3\nCYCL DEF 18.0 T\nCYCL DEF 18.1 DEPTH -20\n"
        )
        text += "CYCL DEF 18.2 PITCH +1\nL X+20 Y+10 R0 FMAX M99\nEND PGM A MM\n"
    else:
        cycle = CYCLES[code]
        text = trial.program(mnc.controls["tnc-620"], cycle, {p.name: trial.first_value(p) for p in cycle.parameters()}) or ""
    before, after = text.replace("R0 FMAX M3", f"R0 FMAX {spindle}").replace("S1000", f"S{speed}").split("L X+20 Y+10")
    lines, more = CALLS[call]
    return before + lines + after.partition("\n")[2], before.count("\n") + more


@pytest.mark.parametrize("call", CALLS)
@pytest.mark.parametrize(
    ("code", "spindle", "sentence"),
    [
        ("CYCL DEF 206", "", "needs a turning spindle: write S in TOOL CALL, and M3 or M4 before"),
        ("CYCL DEF 262", "", "needs a tool that turns right: write M3 before"),
        ("CYCL DEF 265", "", "needs a turning spindle: write M3 or M4 before"),
        ("CYCL DEF 263", "M4", "needs a tool that turns right: write M3 before"),
        ("CYCL DEF 18", "M3", "needs a spindle that stands still: it would stop it and cut with no rotation; write M5 before"),
    ],
)  # fmt: skip
def test_the_spindle_is_missed_where_the_cycle_is_called(code: str, spindle: str, sentence: str, call: str) -> None:
    text, line = program(code, spindle, call)
    run = mnc.run(text, "tnc-620")
    assert [(a.message, a.span.line) for a in run.alarms if a.severity == "alarm"] == [(f"{code} {sentence}", line)]


@pytest.mark.parametrize("code", ["CYCL DEF 207", "CYCL DEF 18"])
def test_a_speed_is_missed_at_the_call(code: str) -> None:
    text, line = program(code, "M5", "CYCL CALL", speed=0)
    alarm = next(a for a in mnc.run(text, "tnc-620").alarms if a.severity == "alarm")
    assert (alarm.message, alarm.span.line) == (f"{code} needs a spindle speed: write S in TOOL CALL", line)


@pytest.mark.parametrize("call", CALLS)
def test_a_value_of_the_definition_is_blamed_there(call: str) -> None:
    text, _ = program("CYCL DEF 206", "M3", call)
    lines = text.splitlines()
    depth = next(k for k, line in enumerate(lines) if "Q201=" in line)
    lines[depth] = "  Q201=+20 ~"
    alarm = next(a for a in mnc.run("\n".join(lines) + "\n", "tnc-620").alarms if a.severity == "alarm")
    assert "must be negative" in alarm.message and alarm.span.line == depth + 1


# --- a line that belongs to the definition above it -------------------------------------------------------------------

HEAD = "0 BEGIN PGM A MM\n1 TOOL CALL 1 Z S1000\n"
D20 = "2 CYCL DEF 20 C\nQ2=1\nQ3=0\nQ4=0\nQ5=0\nQ6=2\nQ7=30\nQ8=0\nQ9=1\n"
D200 = "2 CYCL DEF 200 D\nQ200=2\nQ201=-15\nQ206=250\nQ202=0\nQ210=0\nQ203=0\nQ204=20\nQ211=0\n"


def said(text: str) -> list[tuple[str, int, int, str]]:
    return [(a.severity, *a.span[:2], f"{a.message} ({a.hint})") for a in mnc.run(HEAD + text, "tnc-620").alarms]


NUMBER_IT = "a line Q… without a block number belongs to the definition above it: number it to assign a variable"
READ_SO = (
    "Q1 is read as a parameter of the CYCL DEF {} above it (an assignment has a block number, for example 5 Q1 = -9)"
)


def test_an_assignment_without_a_number_is_a_parameter_and_a_warning_says_so() -> None:
    run = mnc.run(f"{HEAD}{D20}Q1 = -9\n", "tnc-620")
    assert run.ok and run.variables["Q1"] == -9
    assert said(f"{D20}Q1 = -9\n") == [("warning", 12, 1, READ_SO.format(20))]


@pytest.mark.parametrize("line", ["3 Q1 = -9", "3 Q1=-9"])
def test_an_assignment_with_a_number_is_none(line: str) -> None:
    run = mnc.run(f"{HEAD}{D200}{line}\n", "tnc-620")
    assert not run.alarms and run.variables["Q1"] == -9


def test_parameters_written_with_blanks_are_no_assignments() -> None:
    assert not said(D200.replace("=", " = ")) and not said(D200.replace("Q200=", "Q200 ="))


def test_a_parameter_that_the_cycle_has_not() -> None:
    refused = ("alarm", 12, 1, f"Q1=-9 has no meaning in this block (CYCL DEF 200 does not take Q1) ({NUMBER_IT})")
    assert said(f"{D200}Q1=-9\n") == [refused]
    assert said(f"{D200}Q1 = -9\n") == [("warning", 12, 1, READ_SO.format(200)), refused]


# --- each once --------------------------------------------------------------------------------------------------------


def test_an_alarm_stands_once() -> None:
    """However often a block is obeyed, and however many passes find a fault."""
    loop = "2 LBL 1\n3 CYCL CALL\n4 LBL 0\n"
    for text in (
        f"{D200}3 L Z+9 R0 FMAX\n{loop}CALL LBL 1 REP 5\n",
        "2 CYCL DEF 25 A\nQ1=-5\nQ77=3\nQ77=3\n",
        "2 CYCL DEF 25 A\n",
    ):
        found = said(text)
        assert found and len(found) == len(set(found))
