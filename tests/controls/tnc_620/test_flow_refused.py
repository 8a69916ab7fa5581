"""What calls of other programs refuse: the alarm, its line and its column.

Blocks stand behind BEGIN PGM and TOOL CALL 1 (radius 5, feed 100) and so begin in line 3; S is a program that can be called.
"""

from __future__ import annotations

import pytest

import mnclab as mnc

SUB = "0 BEGIN PGM S MM\n1 L X+1\n2 M30\n3 END PGM S MM\n"
NO_PROGRAM = "there is no program of this name (Setup(files=…) has s; a program without a file has no folder)"
CYCLE_12 = "2 CYCL DEF 12.0 PGM CALL\n3 CYCL DEF 12.1 PGM {}\n"

REFUSED = [
    ("2 CALL PGM X5", 3, 12, f"CALL PGM X5: {NO_PROGRAM}"),
    ('2 SEL PGM "X5"\n3 CALL SELECTED PGM', 4, 1, f"CALL SELECTED PGM X5: {NO_PROGRAM}"),
    (CYCLE_12.format("X5") + "4 M3\n5 CYCL CALL", 4, 21,
     "CYCL DEF 12 PGM (name of the program) X5: there is no program of this name"),
]  # fmt: skip


@pytest.mark.parametrize(("blocks", "line", "column", "text"), REFUSED, ids=[item[0][:40] for item in REFUSED])
def test_refused(blocks: str, line: int, column: int, text: str) -> None:
    setup = mnc.Setup(files={"s": SUB})
    run = mnc.run(f"0 BEGIN PGM A MM\n1 TOOL CALL 1 Z S1000 F100\n{blocks}\n", "tnc-620", setup)
    alarms = [a for a in run.alarms if a.severity == "alarm"]
    found = [(a.span.line, a.span.column, a.message + (f" ({a.hint})" if a.hint else "")) for a in alarms]
    assert found == [(line, column, text)]


@pytest.mark.parametrize(
    "call", ["2 CALL PGM S", '2 SEL PGM "S"\n3 CALL SELECTED PGM', CYCLE_12.format("S") + "4 L X+5 M3 M99"]
)
def test_the_end_of_the_run_in_a_called_program(call: str) -> None:
    run = mnc.run(f"0 BEGIN PGM A MM\n1 TOOL CALL 1 Z S1000 F100\n{call}\n", "tnc-620", mnc.Setup(files={"s": SUB}))
    (alarm,) = run.alarms
    assert alarm.headline == (
        "s:3:3: alarm: M30 ends the run and cannot stand in a program that was called (a called program ends with END PGM)"
    )
