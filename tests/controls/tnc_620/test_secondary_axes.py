"""U, V and W in straight lines: the tool stands at the sum of X and U, Y and V, Z and W (PARAXCOMP of the public manuals)."""

from __future__ import annotations

import pytest

import mnclab as mnc


def ends(run: mnc.Run) -> list[tuple[float, ...]]:
    assert run.ok, run.alarms
    return [tuple(round(v, 9) + 0.0 for v in end) for end in run.toolpath.motion.end.tolist()]


def test_the_tool_stands_at_the_sum(inside) -> None:
    """X stays what it is: the block after it counts from its own coordinate."""
    run = inside("2 L X+10 Y+3 R0 FMAX M3\n3 L U+10 FMAX\n4 L X+20 IU-4 F200\n5 L IW+5 V-3\n6 L IX+1\n7 L U+0 V+0 W+0")
    assert ends(run) == [(10, 3, 0), (20, 3, 0), (26, 3, 0), (26, 0, 5), (27, 0, 5), (21, 3, 0)]
    assert run.history.value("position", 7) == (21, 3, 0)


def test_arcs_and_cycles_stand_where_the_axes_carry_them(inside) -> None:
    run = inside("2 L X+10 Y+0 V+5 R0 FMAX M3\n3 CC X+0 Y+0\n4 C X-10 DR+")
    arc = run.toolpath.motion[-1]
    assert run.ok and tuple(arc.centre) == (0, 5, 0) and arc.end == pytest.approx([-10, 5, 0])


def test_they_are_axes_of_the_machine(inside) -> None:
    """A rotation turns X and Y of the program and no U; a datum shift and a preset leave it."""
    run = inside(
        "2 CYCL DEF 10.0 ROT\n3 CYCL DEF 10.1 ROT+90\n4 L X+10 Y+0 R0 FMAX M3\n5 L U+4\n6 CYCL DEF 7.0 D\n7 CYCL DEF 7.1 X+1\n"
        "8 L X+10\n9 CYCL DEF 247 Q339=+2\n10 L X+0 Y+0 Z+0",
        mnc.Setup(presets={2: (100, 50, 0)}),
    )
    assert ends(run) == [(0, 10, 0), (4, 10, 0), (4, 11, 0), (104, 50, 0)]


def test_machine_coordinates_are_those_of_x_alone(inside) -> None:
    """M91 X30 with U at 4: the tool stands at 34, its tip 50 below the spindle."""
    run = inside("2 L U+4 R0 FMAX M3\n3 L X+30 Z+0 M91 FMAX", mnc.Setup(tools={1: mnc.Tool(length=50)}))
    assert ends(run)[-1] == (34, 0, -50)


def test_inches_and_a_feed_along_the_sum(tnc) -> None:
    run = tnc("BEGIN PGM A INCH\nTOOL CALL 1 Z S100 F10\nL U+1 R0 FMAX M3\nL X+1 IU+1\nEND PGM A INCH\n")
    assert ends(run) == [(25.4, 0, 0), (76.2, 0, 0)] and run.toolpath.motion.feed[-1] == pytest.approx(25.4)


def test_a_machine_without_them(inside) -> None:
    (alarm,) = inside("2 L X+5 U+5 FMAX", secondary_axes="refuse").alarms
    assert alarm.message == "U5: the machine has no secondary axis U (setting secondary_axes)" and alarm.span.column == 9


def test_their_travel_is_not_known(inside) -> None:
    limits = mnc.Limits(travel=((-100, 100), (-100, 100), (-100, 100)))
    (warning,) = inside("2 L X+5 U+5 FMAX", mnc.Setup(limits=limits)).alarms
    assert "the travel of U is not known" in warning.message and warning.severity == "warning"


def test_the_end_of_the_travel_is_that_of_z_alone(inside) -> None:
    """M140 MB MAX leads Z to 200; W stands at 7, the tool is 50 long."""
    setup = mnc.Setup(tools={1: mnc.Tool(length=50)}, settings={"retract_to": 200})
    run = inside("2 L W+7 R0 FMAX M3\n3 L M140 MB MAX", setup)
    assert ends(run)[-1] == (0, 0, 157)
