"""M140, away along the tool axis at the start of its block, and PLANE where it tilts nothing (HEIDENHAIN, Klartext manuals)."""

from __future__ import annotations

import pytest

import mnclab as mnc
from mnclab import Kind

TOOLS = {1: mnc.Tool(radius=5, length=80)}
TRAVEL = ((-500, 500), (-400, 400), (-600, 350))


def ends(run: mnc.Run) -> list[tuple]:
    """Kind, end and feed of each motion."""
    assert run.ok, run.alarms
    rows = run.toolpath.motion
    return [(move.kind.name, *(round(float(v), 9) for v in move.end), move.feed) for move in rows]


def test_the_example_of_the_manual(inside) -> None:
    """250 L X+0 Y+38.5 F125 M140 MB 50 F750: first 50 mm up at 750, then to the point at 125, whose feed stays."""
    run = inside("2 L Y+30 Z-10 FMAX\n3 L X+0 Y+38.5 F125 M140 MB 50 F750\n4 L X+9", stopped_spindle="accept")
    assert ends(run)[1:] == [("LINE", 0, 30, 40, 750), ("LINE", 0, 38.5, 40, 125), ("LINE", 9, 38.5, 40, 125)]


@pytest.mark.parametrize("spelt", ["M140 MB50", "M140 MB 50", "M140 MB+50", "M140 MB Q1", "m140 mb50 fmax", "L M140 MB50 F MAX"])
def test_without_a_feed_it_is_rapid(spelt: str, inside) -> None:
    run = inside(f"2 Q1 = 50\n3 L Z-10 F100\n4 {spelt}\n", stopped_spindle="accept")
    assert ends(run)[-1] == ("RAPID", 0, 0, 40, float("inf")) and not run.alarms


def test_inches(tnc) -> None:
    """MB2 and F10 of a program in inches are 50.8 mm and 25.4 mm/min."""
    run = tnc("0 BEGIN PGM A INCH\n1 TOOL CALL 1 Z S1 F4\n2 M140 MB2 F10\n3 END PGM A INCH\n", stopped_spindle="accept")
    assert ends(run) == [("LINE", 0, 0, 50.8, pytest.approx(25.4))]


def test_mb_max_goes_to_the_end_of_the_travel(inside) -> None:
    """The spindle at Z350 of the machine, with a tool of 80 mm and a preset at Z30: its tip at 350 - 80 - 30 = 240."""
    setup = mnc.Setup(tools=TOOLS, presets={0: (0, 0, 30)}, start=(0, 0, 300), limits=mnc.Limits(travel=TRAVEL))
    run = inside("2 L X+5 Z+7 FMAX\n3 L M140 MB MAX", setup)
    assert ends(run)[-1] == ("RAPID", 5, 0, 240, float("inf")) and not run.alarms


@pytest.mark.parametrize(("settings", "to", "told"), [({}, 420, 1), ({"retract_to": 200}, 120, 0)])
def test_without_limits_a_setting_says_where_that_is_and_it_is_told_once(inside, settings, to, told) -> None:
    setup = mnc.Setup(tools=TOOLS, start=(0, 0, 100), settings=settings)
    run = inside("2 L M140 MB MAX\n3 L Z+7 FMAX\n4 M140 MBMAX\n5 M140 MB MAX", setup)
    assert [end[3] for end in ends(run)] == [to, 7, to] and len(run.alarms) == told
    assert not told or (run.alarms[0].message, run.alarms[0].span[:2]) == ("M140 MB MAX leads to Z500 of the machine", (3, 10))


def test_under_radius_compensation_and_a_rotation_only_the_height_changes(inside) -> None:
    """The tool runs 5 mm beside the line and goes up there; a rotation of the plane does not touch the tool axis."""
    run = inside("2 CYCL DEF 10.0 R\n3 CYCL DEF 10.1 ROT+90\n4 L X+10 RL F100 M3\n5 L X+30 M140 MB20 F50\n6 L X+40")
    path = ends(run)
    assert path[1] == ("LINE", -5, 10, 20, 50) and path[2][:4] == ("LINE", -5, 30, 20) and {end[3] for end in path[1:]} == {20}


def test_along_another_tool_axis(tnc) -> None:
    """TOOL CALL 1 Y: 50 along Y, and to Y500 of the machine, the spindle 80 above the tip."""
    setup = mnc.Setup(tools=TOOLS, start=(0, 80, 0))
    run = tnc("1 TOOL CALL 1 Y S1 F9\n2 L X+5 Y-3 Z+7 FMAX\n3 M140 MB50\n4 M140 MB MAX\n", setup)
    assert [end[1:4] for end in ends(run)] == [(5, -3, 7), (5, 47, 7), (5, 420, 7)]


def test_in_a_recorded_pass_and_a_loop(inside) -> None:
    """A section that is repeated twice retracts three times."""
    run = inside("2 LBL 1\n3 L IZ-1 F9 M3\n4 M140 MB 3 FMAX\n5 CALL LBL 1 REP2")
    assert [end[3] for end in ends(run)] == [-1, 2, 1, 4, 3, 6]
    assert [move.kind for move in run.toolpath.motion] == [Kind.LINE, Kind.RAPID] * 3


@pytest.mark.parametrize("how", ["STAY", "MOVE ABST50 F1000", "TURN FMAX", "MOVE DIST+20 FMAX"])
def test_plane_reset_where_nothing_is_tilted(how: str, inside) -> None:
    run = inside(f"2 L X+5 FMAX\n3 PLANE RESET {how}\n4 L X+9 FMAX")
    assert ends(run) == [("RAPID", 5, 0, 0, float("inf")), ("RAPID", 9, 0, 0, float("inf"))] and not run.alarms


def test_plane_reset_ends_cycle_19(inside) -> None:
    """Under A+90 the Y of the program is the Z of the machine; behind PLANE RESET it is Y again, and nothing moved."""
    run = inside("2 CYCL DEF 19.0 X\n3 CYCL DEF 19.1 A+90\n4 L Y+10 FMAX\n5 PLANE RESET STAY\n6 L Y+3 FMAX")
    assert [end[1:4] for end in ends(run)] == [(0, 0, 10), (0, 3, 10)]


@pytest.mark.parametrize("how", ["STAY SEQ+ TABLE ROT", "TURN FMAX SEQ -", "MOVE ABST50 F500 COORD ROT"])
def test_a_plane_of_no_angles_tilts_nothing(how: str, inside) -> None:
    """It ends a tilt, and writes 0 into Q120 to Q122, to which the program then turns its axes."""
    tilt = "2 CYCL DEF 19.0 X\n3 CYCL DEF 19.1 A+90\n4 L Y+10 FMAX"
    turn = "6 L A+Q120 C+Q122 FMAX M126\n7 L Y+3 FMAX"
    run = inside(f"{tilt}\n5 PLANE SPATIAL SPA0 SPB+0 SPCQ1 {how}\n{turn}", mnc.Setup(variables={"Q1": 0}))
    assert [end[1:4] for end in ends(run)] == [(0, 0, 10), (0, 3, 10)]
    assert [run.variables[name] for name in ("Q120", "Q121", "Q122")] == [0, 0, 0]
