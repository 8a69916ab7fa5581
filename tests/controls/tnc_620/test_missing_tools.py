"""Tools that the table lacks: stood in for, with a warning, where the setup has no tools of its own; else an alarm."""

from __future__ import annotations

import mnclab as mnc

PROGRAM = "TOOL DEF 22\nTOOL CALL 22 Z S1000\nL X+10 Y+20 Z+5 FMAX M3\nTOOL CALL 22 Z S900\n"


def test_without_tools_of_its_own_a_setup_stands_in_for_them(tnc) -> None:
    run = tnc(PROGRAM, mnc.Setup())
    assert [str(alarm.severity) for alarm in run.alarms] == ["warning"]
    (told,) = run.alarms
    assert told.message == "TOOL DEF 22 has no row in the tool table: it counts as a tool without radius and length"
    assert told.span[:2] == (1, 10)
    assert run.toolpath.motion.end[-1].tolist() == [10, 20, 5] and run.toolpath[-1].radius == 0


def test_a_table_of_the_user_is_the_table(tnc) -> None:
    run = tnc(PROGRAM, mnc.Setup(tools={1: mnc.Tool(radius=5, number=1)}))
    assert [alarm.message for alarm in run.alarms] == ["TOOL DEF 22 has no row in the tool table"]
