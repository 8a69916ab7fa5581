"""Programs that would never end or fill the memory are stopped at once, and those that only run long are not."""

from __future__ import annotations

import pytest

import mnclab as mnc

pytestmark = pytest.mark.deep

HEAD = "BEGIN PGM A MM\nTOOL CALL 1 Z S1000 F100\nM3\n"
DRILLING = "CYCL DEF 200 D ~\n Q200=+2 ~\n Q201=-15 ~\n Q206=+90 ~\n Q202=+{} ~\n Q210=+0 ~\n Q203=+0 ~\n Q204=+9 ~\n Q211=+0\n"
GRID = "PATTERN DEF PAT1 (X+0 Y+0 DX+1 DY+1 NUMX{} NUMY{} ROT+0 ROTX+0 ROTY+0 Z+0)\n"


def run(body: str, files: dict[str, str] | None = None, **settings: object) -> mnc.Run:
    return mnc.run(f"{HEAD}{body}\nEND PGM A MM\n", "tnc-620", mnc.Setup(files=files or {}, settings=settings))


NEVER = {
    "nothing": "LBL 1\nFN 9: IF +0 EQU +0 GOTO LBL 1",
    "a move": "LBL 1\nL IX+1\nFN 9: IF +0 EQU +0 GOTO LBL 1",
    "a count that nobody asks": "Q1 = 0\nLBL 1\nQ1 = Q1 + 1\nL X+Q1\nFN 9: IF +0 EQU +0 GOTO LBL 1",
    "the same value each time": "LBL 1\nQ1 = 5\nL IX+1\nFN 9: IF +Q1 EQU +5 GOTO LBL 1",
    "a value there and back": "Q1 = 1\nLBL 1\nQ1 = 0 - Q1\nL IY+Q1\nFN 11: IF +Q1 GT -7 GOTO LBL 1",
    "five values in turn": "Q1 = 1\nLBL 1\nQ1 = ( Q1 * 3 ) % 7\nFN 11: IF +Q1 GT -7 GOTO LBL 1",
    "a jump over a jump": "Q1 = 3\nLBL 1\nFN 9: IF +Q1 EQU +0 GOTO LBL 2\nL IX+1\nFN 10: IF +1 NE +0 GOTO LBL 1\nLBL 2",
    "a repeat within": "LBL 1\nLBL 2\nL IX+1\nCALL LBL 2 REP 9\nFN 9: IF +0 EQU +0 GOTO LBL 1",
    "a subprogram within": "LBL 1\nCALL LBL 5\nFN 9: IF +0 EQU +0 GOTO LBL 1\nLBL 5\nL IX+1\nLBL 0",
    "in a subprogram": "CALL LBL 5\nM2\nLBL 5\nLBL 6\nL IX+1\nFN 9: IF +0 EQU +0 GOTO LBL 6\nLBL 0",
    "in a repeat": "LBL 1\nLBL 2\nL IX+1\nFN 9: IF +0 EQU +0 GOTO LBL 2\nCALL LBL 1 REP 3",
    "a label in a text": 'QS1 = "A"\nLBL "A"\nL IX+1\nFN 9: IF +0 EQU +0 GOTO LBL QS1',
    "a name that is not defined": "LBL 1\nL IX+1\nFN 9: IF QL5 IS UNDEFINED GOTO LBL 1",
    "two loops": "LBL 1\nFN 9: IF +0 EQU +0 GOTO LBL 2\nL X+1\nLBL 2\nL IX+1\nFN 10: IF +1 NE +0 GOTO LBL 1",
}


@pytest.mark.parametrize("name", NEVER)
def test_a_loop_without_an_end_is_named_at_once(name: str) -> None:
    found = run(NEVER[name])
    (alarm,) = found.alarms
    assert alarm.message.startswith("the program never gets out of this loop")
    assert "GOTO" in found.program.line_text(alarm.span.line)
    assert len(found.steps.block) < 400


@pytest.mark.parametrize(
    ("body", "name", "value"),
    [
        ("Q1 = 0\nLBL 1\nQ1 = Q1 + 1\nFN 12: IF +Q1 LT +5000 GOTO LBL 1", "Q1", 5000),
        ("Q1 = 1\nLBL 1\nQ1 = ( Q1 * 3 ) % 1013\nFN 10: IF +Q1 NE +1 GOTO LBL 1", "Q1", 1),
        ("Q1 = 0\nQ2 = 0\nLBL 1\nQ1 = Q1 + 1\nQ2 = INT ( Q1 / 900 )\nFN 9: IF +Q2 EQU +0 GOTO LBL 1", "Q1", 900),
        ("Q1 = 0\nLBL 1\nQ1 = Q1 + 1\nFN 9: IF +Q1 EQU +99 GOTO LBL 2\nFN 9: IF +0 EQU +0 GOTO LBL 1\nLBL 2", "Q1", 99),
        ("Q1 = 0\nLBL 1\nCALL LBL 5\nFN 9: IF +Q2 EQU +0 GOTO LBL 1\nM2\nLBL 5\nQ1 = Q1 + 1\nQ2 = INT ( Q1 / 50 )\nLBL 0",
         "Q1", 50),
        ("Q1 = 0\nLBL 1\nLBL 2\nQ1 = Q1 + 1\nCALL LBL 2 REP 9\nFN 12: IF +Q1 LT +100 GOTO LBL 1", "Q1", 100),
        ("Q1 = 0\nLBL 1\nTOOL CALL 1 Z DR+Q1\nQ1 = Q1 + 0.25\nFN 12: IF +Q108 LT +9 GOTO LBL 1", "Q1", 4.25),
        ("Q1 = 0\nLBL 1\nTOOL CALL 1 Z DR+Q1\nQ1 = Q1 + 0.25\nQ2 = Q108\nFN 12: IF +Q2 LT +9 GOTO LBL 1", "Q1", 4.25),
        ("Q1 = 0\nQ3 = 1\nLBL 1\nCYCL DEF 11.0 SCALING\nCYCL DEF 11.1 SCL Q3\nQ1 = Q1 + 1\nQ3 = 1 + Q1 / 10\n"
         "FN 18: SYSREAD Q2 = ID210 NR4 IDX1\nFN 12: IF +Q2 LT +1.5 GOTO LBL 1", "Q1", 6),
        ("Q1 = 0\nLBL 1\nFN 9: IF QL5 IS DEFINED GOTO LBL 2\nQ1 = Q1 + 1\nQL5 = 1\nFN 9: IF +0 EQU +0 GOTO LBL 1\nLBL 2",
         "Q1", 1),
        ('QS1 = "A"\nQ1 = 0\nLBL "A"\nQ1 = Q1 + 1\nQS1 = TOCHAR ( DAT+Q1 DECIMALS0 )\nFN 9: IF +0 EQU +0 GOTO LBL QS1\n'
         'LBL "1"\nFN 9: IF +0 EQU +0 GOTO LBL "A"\nLBL "2"', "Q1", 2),
    ],
)  # fmt: skip
def test_a_loop_that_ends_is_not_called_endless(body: str, name: str, value: float) -> None:
    """Counting, returning to a value, waiting for a value worked out from another one, or for the state of the machine."""
    found = run(body)
    assert found.ok, found.alarms
    assert found.variables[name] == value


RUNS_AWAY = {
    "counts up from what it must fall below": "Q1 = 0\nLBL 1\nQ1 = Q1 + 1\nL X+Q1\nFN 11: IF +Q1 GT +0 GOTO LBL 1",
    "counts down from what it must exceed": "Q1 = 0\nLBL 1\nQ1 = Q1 - 0.1\nFN 12: IF +Q1 LT +5 GOTO LBL 1",
    "steps over the value that it waits for": "Q1 = 0\nLBL 1\nQ1 = Q1 + 0.3\nFN 10: IF +Q1 NE +10 GOTO LBL 1",
    "two conditions": "Q1 = 1\nLBL 1\nQ1 = Q1 + 1\nFN 9: IF +Q1 EQU +0 GOTO LBL 2\nFN 11: IF +Q1 GT +0 GOTO LBL 1\nLBL 2",
}


@pytest.mark.parametrize("name", RUNS_AWAY)
def test_a_count_that_runs_the_wrong_way_is_named(name: str) -> None:
    found = run(RUNS_AWAY[name])
    (alarm,) = found.alarms
    assert alarm.message.startswith("the program does not get out of this loop: in 10")
    assert "LBL 1" in found.program.line_text(alarm.span.line) and len(found.steps.block) < 60_000


@pytest.mark.parametrize(
    "body",
    [
        "Q1 = 0\nLBL 1\nQ1 = Q1 + 1\nFN 12: IF +Q1 LT +30000 GOTO LBL 1",
        "Q1 = 0\nLBL 1\nQ1 = Q1 + 1\nFN 9: IF +Q1 EQU +30000 GOTO LBL 2\nFN 11: IF +Q1 GT +0 GOTO LBL 1\nLBL 2",
        "Q1 = 0\nLBL 1\nQ1 = Q1 + 1\nQ2 = SIN ( Q1 / 200 )\nFN 11: IF +Q2 GT +0 GOTO LBL 1",
        "Q1 = 0\nLBL 1\nQ1 = Q1 + 1\nQ2 = INT ( Q1 / 30000 )\nFN 9: IF +Q2 EQU +0 GOTO LBL 1",
    ],
)
def test_a_long_count_is_believed(body: str) -> None:
    found = run(body)
    assert found.ok and found.variables["Q1"] >= 30000


DEAR = {
    "a pattern": GRID.format(300, 300),
    "a long formula": "Q2 = " + " + ".join(["SIN 3"] * 2000),
    "a cycle that is never called": DRILLING.format(5),
}


@pytest.mark.parametrize("name", DEAR)
def test_a_dear_block_counts_as_many(name: str) -> None:
    found = run(f"LBL 1\n{DEAR[name]}\nCALL LBL 1 REP 65534")
    (alarm,) = found.alarms
    assert alarm.message.startswith("jumps, repeats and calls ran as much work as 200000 blocks without an end; in CALL LBL 1")
    assert len(found.steps.block) < 150_000


@pytest.mark.parametrize(
    "line", [DRILLING.format(5), "Q2 = " + " + ".join(["SIN 3"] * 20) + "\n", "FN 18: SYSREAD Q3 = ID270 NR1 IDX1\n"]
)
def test_what_the_text_says_once_is_no_loop(line: str) -> None:
    """However dear its blocks are: 800 of them are no more than they are long."""
    assert run(line * 800, most_blocks=1000).ok


def test_a_long_repeat_runs() -> None:
    found = run("Q1 = 0\nLBL 1\nQ1 = Q1 + 1\nL IX+1\nCALL LBL 1 REP 65534")
    assert found.ok and found.variables["Q1"] == 65535 and found.toolpath.end[-1, 0] == 65535


@pytest.mark.parametrize(
    ("body", "block", "loop"),
    [
        (DRILLING.format(0.01) + GRID.format(300, 300) + "CYCL CALL PAT FMAX", "CYCL CALL PAT", ""),
        (DRILLING.format(5) + GRID.format(10, 10) + "LBL 1\nCYCL CALL PAT FMAX\nCALL LBL 1 REP 65534", "REP", "REP 65534"),
        (DRILLING.format(0.01) + "LBL 1\nL IX+1 FMAX M99\nCALL LBL 1 REP 65534", "REP", "REP 65534"),
        ("LBL 1\n" + "L X+1\nL X+2\n" * 50 + "CALL LBL 1 REP 65534", "REP", "REP 65534"),
        (DRILLING.format(0.01) + "LBL 1\nCYCL CALL POS X+0 Y+0 Z+0\nLBL 2\nL IX+1 M99\nCALL LBL 2 REP 9\nCALL LBL 1 REP 9999",
         "", "CALL LBL 1 REP 9999 in line"),
    ],
)  # fmt: skip
def test_rows_without_bound_are_refused_before_they_are_made(body: str, block: str, loop: str) -> None:
    found = run(body)
    (alarm,) = found.alarms
    assert "more than the setting most_rows (500000)" in alarm.message and loop in alarm.message
    assert block in found.program.line_text(alarm.span.line)
    assert len(found.toolpath) < 500_000


def test_the_bound_is_exact_and_counts_the_blocks_of_the_text() -> None:
    """1000 rows and 20 for each of the blocks; they are counted over patterns, single rows and rows in bulk alike."""
    text = "LBL 1\nQ1 = {}\nL X+Q1\nL X+0\nCALL LBL 1 REP {}"
    blocks = len(run(text.format(3, 1)).program)
    allowed = 1000 + 20 * blocks
    before = len(run(text.format(3, 1)).toolpath) - 4  # of the tool and the spindle; each pass makes two
    passes = (allowed - before) // 2
    found = run(text.format(3, passes - 1), most_rows=1000)
    assert found.ok and len(found.toolpath) == before + 2 * passes
    found = run(text.format(3, passes + 1), most_rows=1000)
    assert not found.ok and "most_rows (1000) and 20 for each block" in found.alarms[0].message
    assert "CALL LBL 1 REP" in found.alarms[0].message


def test_every_control_has_the_bound() -> None:
    for control in mnc.controls.values():
        assert [s.default for s in control.settings if s.name == "most_rows"] == [500_000]
        assert [s.default for s in control.settings if s.name == "most_blocks"] == [200_000]
    assert "most_rows" in str(mnc.help("settings", "nc-31"))
    with pytest.raises(mnc.Alarm, match="most_rows .* must be a number from 1000 to 1000000000, got 5"):
        mnc.run("G0 X1\n", "mnc", mnc.Setup(settings={"most_rows": 5}))


CONTOUR = (
    "CYCL DEF 14.0 CONTOUR\nCYCL DEF 14.1 CONTOUR LABEL 1\n"
    "CYCL DEF 20 D ~\nQ1=-5 ~\nQ2=1 ~\nQ3=0 ~\nQ4=0 ~\nQ5=0 ~\nQ6=2 ~\nQ7=20 ~\nQ8=0 ~\nQ9=1\n"
    "CYCL DEF 22 R ~\nQ10=5 ~\nQ11=50 ~\nQ12=100 ~\nQ18=0 ~\nQ19=0 ~\nQ208=999 ~\nQ401=100 ~\nQ404=0\nCYCL CALL\nM2\n"
    "LBL 1\nL X+0 Y+0 RL\nLBL 2\nL X+30\nL X+0\nCALL LBL 2 REP 900\nLBL 0"
)


def test_a_recorded_contour_counts_too() -> None:
    found = run(CONTOUR, most_rows=1000)
    assert "most_rows" in found.alarms[0].message and "REP 900" in found.alarms[0].message
