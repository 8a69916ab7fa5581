"""Functions that speak to the PLC and to a log, and FN 25, which sets the datum."""

from __future__ import annotations

import pytest

import mnclab as mnc


@pytest.mark.parametrize(
    "block",
    [
        "FN 19: PLC=+10/+Q3", "FN 20: WAIT FOR M4095==1", "FN 20: WAIT FOR SYNC", "FN 29: PLC=+10/+20/+Q1",
        "FN 37: EXPORT QL10", 'FN 38: SEND /"Q1: %F" / +Q1',
    ],
)  # fmt: skip
def test_nothing_moves_and_a_warning_says_so(block: str, inside) -> None:
    run = inside(f"2 L X+5\n3 {block}\n4 L X+9")
    (warning,) = run.alarms
    assert (warning.severity, warning.span[:2]) == ("warning", (4, 1))
    assert warning.message.startswith(f"{block[:5]} has no effect: ")
    assert run.toolpath.motion.end[:, 0].tolist() == [5, 9]


def test_the_datum_of_an_axis_is_set(inside) -> None:
    """The manual's examples: X+100 becomes 0; the coordinate Z+50 gets -20."""
    setup = mnc.Setup(presets={3: (10, 20, 30)}, settings={"preset": 3})
    run = inside(
        "2 L X+100 Y+7 Z+50\n3 FN 25: PRESET = X/+100/+0\n4 FN 25: PRESET = Z/+50/-20\n5 FN 18: SYSREAD Q1 = ID270 NR1 IDX1\n"
        "6 FN 18: SYSREAD Q2 = ID270 NR1 IDX3\n7 L X+1 Z-19\n8 FN 18: SYSREAD Q3 = ID530 NR1", setup,
    )  # fmt: skip
    assert run.ok, run.alarms
    assert [run.variables[f"Q{k}"] for k in (1, 2, 3)] == [0, -20, 0]
    moved = run.toolpath.motion.end[-1] - run.toolpath.motion.end[-2]
    assert moved.tolist() == [1, 0, 1]
    assert run.tables.presets[0] == mnc.Datum(110, 20, 100) and run.tables.presets[3] == mnc.Datum(10, 20, 30)


def test_the_datum_of_a_program_in_inches(tnc) -> None:
    run = tnc("0 BEGIN PGM A INCH\n1 TOOL CALL 1 Z\n2 FN 25: PRESET = Y/+2/+1.5\n3 END PGM A INCH\n")
    assert run.ok and run.tables.presets[0].y == pytest.approx(12.7)
