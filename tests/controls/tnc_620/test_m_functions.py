"""M functions of the machine: where they act in their block, and what they move (catalogue: M0 to M130)."""

from __future__ import annotations

import math
import re

import numpy as np
import pytest

import mnclab as mnc
from mnclab import Kind
from mnclab.controls.tnc_620.control import CONTROL

LONG = mnc.Setup(
    tools={1: mnc.Tool(radius=5, length=80), 2: mnc.Tool(radius=3, length=100)},
    presets={0: (10, 20, 30)},
    start=(0, 0, 500),
)
#: M functions named in the manual, with the block begin or end at which the catalogue says they act.
MANUAL = {
    "start": (3, 4, 7, 8, 13, 14, 19, 20, 91, 92, 94, 103, 110, 118, 120, 128, 130),
    "end": (0, 1, 2, 5, 6, 9, 30),
}


def machine(run: mnc.Run) -> list[list[float]]:
    """Ends of the motion, machine coordinates of the tip."""
    assert run.ok, run.alarms
    return [[round(float(v), 6) for v in move.end + run.toolpath.origin] for move in run.toolpath.motion]


@pytest.mark.parametrize("number", sorted({*MANUAL["start"], *MANUAL["end"]}))
def test_every_m_function_of_the_manual_acts_or_is_refused(number: int) -> None:
    code = f"M{number}"
    if code in CONTROL.functions:
        at_start = CONTROL.functions[code].phase in ("start", "motion")
        assert at_start == (number in MANUAL["start"])
    else:
        run = mnc.run(f"1 L X+1 F100 {code}\n", "tnc-620")
        assert [a.message for a in run.alarms] == [f"{code} is refused: {CONTROL.refused[code]}"]


@pytest.mark.deep
def test_every_number_is_obeyed_or_named() -> None:
    """M0 to M250: obeyed, refused by name, or a function of the machine tool builder."""
    for number in range(251):
        run = mnc.run(f"1 TOOL CALL 1 Z S100 F100\n2 L X+1 M{number}\n", "tnc-620")
        if f"M{number}" not in CONTROL.functions:
            (alarm,) = run.alarms
            assert re.match(rf"M{number} is (refused: \w|no function of the control, but of the machine)", alarm.message)
            assert alarm.severity == ("alarm" if f"M{number}" in CONTROL.refused else "warning")
            assert alarm.span[:2] == (2, 9)


def test_m6_and_the_end_of_the_program_stop_spindle_and_coolant(inside) -> None:
    run = inside("2 L X+1 M13\n3 L X+2 M6\n4 L X+3 M3 M7\n5 M30", m6_stop=True)
    kinds = "".join(move.kind.name[0] for move in run.toolpath)
    # tool; spindle, coolant, line; line, spindle, stop; spindle, coolant, line; spindle, coolant
    assert kinds == "T" + "SCL" + "LSS" + "SCL" + "SC" and run.toolpath[6].kind == Kind.STOP
    assert run.history["coolant"][-1] == "M9" and run.toolpath[-1].spindle == 0


def test_the_spindle_stops_at_an_angle(inside) -> None:
    run = inside("2 L X+1 M3\n3 L X+2 M19", spindle_angle=33)
    assert run.ok and run.history["spindle angle"][-1] == 33 and run.toolpath.motion[-1].spindle == 0


def test_machine_coordinates_know_no_preset_and_no_tool_length(tnc) -> None:
    """M91: the spindle reference goes to Z400, the tip of a tool of length 80 to 320; X is not written and stays."""
    run = tnc(
        "1 TOOL CALL 1 Z S1 F100\n2 L X+5 Y+6 Z+7 FMAX\n3 L Y+0 Z+400 FMAX M91\n4 L X-1 Y+1 F50\n5 L IX+2 IZ-3 M91",
        LONG,
    )
    assert machine(run) == [[15, 26, 37], [15, 0, 320], [9, 21, 320], [11, 21, 317]]


def test_a_rotation_does_not_act_on_machine_coordinates(tnc) -> None:
    """M91 X alone moves along the X axis of the machine, though the program is turned by 90 degrees."""
    turned = "2 CYCL DEF 10.0 R\n3 CYCL DEF 10.1 ROT+90\n"
    run = tnc(f"1 TOOL CALL 1 Z S1 F100\n{turned}4 L X+5 Y+6 Z+7\n5 L X+100 M91\n6 L X+0 Y+0", LONG)
    assert machine(run) == [[4, 25, 37], [100, 25, 37], [10, 20, 37]]


def test_m92_counts_from_a_position_of_the_machine(tnc) -> None:
    setup = LONG.with_settings(m92_x=-300, m92_z=600)
    run = tnc("1 TOOL CALL 2 Z S1 F100\n2 L X+0 Y+0 Z+0 FMAX\n3 L X+1 Y+2 Z-50 FMAX M92", setup)
    assert machine(run)[-1] == [-299, 2, 450]


@pytest.mark.parametrize("word", ["", " C", " A C"])
def test_rotary_axes_within_one_turn(inside, word: str) -> None:
    run = inside(f"2 L X+1 M94{word}\n3 L X+2")
    assert run.ok and run.toolpath.motion.rotary.tolist() == [[0, 0, 0]] * 2 and not math.isnan(run.profile().time)


def test_a_rotary_axis_counts_on_from_less_than_a_turn(inside) -> None:
    """C stands at 370 degrees; after M94 at 10, so that C+15 is 5 degrees away."""
    run = inside("2 L C+370 A+400 FMAX\n3 L X+1 M94 C\n4 L C+15 FMAX")
    degrees = [[round(math.degrees(a)) for a in move.rotary] for move in run.toolpath.motion]
    assert run.ok and degrees == [[400, 0, 370], [400, 0, 10], [400, 0, 15]]


@pytest.mark.parametrize(("program", "shown"), [
    ("L A-90 FMAX\nL X+0 FMAX M94", -90),  # from -120 to 120: 270 would be beyond, and A+0 the long way from there
    ("L A-90 FMAX\nL X+0 FMAX M94 A M126", -90),
    ("L A+90 FMAX\nL X+0 FMAX M94", 90),
])  # fmt: skip
def test_an_axis_with_limits_stays_within_them(program: str, shown: float) -> None:
    run = mnc.run(f"TOOL CALL 1 Z S100\n{program}\nL A+0 FMAX\n", "tnc-620", mnc.Setup(kinematics="table-ac", tools=LONG.tools))
    assert run.ok, run.alarms
    a = [float(row[3]) for row in run.axes()]
    assert (min(a), max(a)) == pytest.approx((min(shown, 0), max(shown, 0))) and a[-1] == 0


def test_an_angle_a_hair_below_zero_shows_zero() -> None:
    """The plane leaves C where a half turn less a half turn is, 1e-16 below 0: no whole turn away from 0."""
    program = "TOOL CALL 1 Z S100\nPLANE SPATIAL SPA+30 SPB+0 SPC+180 TURN FMAX\nL X+0 FMAX M94\nL X+1 FMAX\n"
    run = mnc.run(program, "tnc-620", mnc.Setup(kinematics="table-ac", tools=LONG.tools))
    assert run.ok and np.abs(run.toolpath.rotary[:, 2]).max() < 1e-9


def test_own_words_of_m_functions_do_not_meet_those_of_the_block(inside) -> None:
    run = inside("2 L X+0 Y+38.5 F125 M118 X1 Y1 Z+0.5\n3 L X+1 F500 M103 F20")
    assert run.ok and [(a.span[:2], a.message) for a in run.alarms] == [
        ((3, 21), "M118 changes nothing here: there is no handwheel")
    ]
    assert run.toolpath.motion.feed.tolist() == [125, 500]


def test_a_tool_defined_without_a_table(tnc) -> None:
    """TOOL DEF 5 L+10 R+4: the tip of tool 5 is 10 mm below the spindle reference."""
    run = tnc("1 TOOL DEF 5 L+10 R+4\n2 TOOL CALL 5 Z S1 F100 DR-0.5\n3 L X+1", mnc.Setup(tools={}))
    assert run.ok and run.toolpath.motion.radius.tolist() == [3.5] and run.toolpath[0].end[2] == -10


def test_a_tool_by_the_name_in_a_text_parameter(tnc) -> None:
    run = tnc('1 QS5 = "end mill 6"\n2 TOOL CALL QS5 Z S1 F1\n3 L X+1\n')
    assert run.ok and run.toolpath.motion.tool.tolist() == [3]


def test_a_delta_of_the_corner_radius(tnc) -> None:
    tools = {1: mnc.Tool(radius=5, corner=1)}
    run = tnc("1 TOOL CALL 1 Z S1 F1 DR2-0.25\n2 TOOL CALL Z DR+0.1\n3 L X+1", mnc.Setup(tools=tools))
    tool = run.history["tool"][-1]
    assert run.ok and (tool.corner, tool.effective_radius) == (0.75, 5.1)


def test_a_stop_may_carry_an_m_function(inside) -> None:
    run = inside("2 L X+1 M3\n3 STOP M5\n4 L X+2")
    assert run.ok and run.toolpath.motion.spindle.tolist() == [1000, 0]
    assert [move.kind for move in run.toolpath].count(Kind.STOP) == 1


@pytest.mark.parametrize("axis", "XYZ")
def test_the_blank_of_the_program_is_the_stock_of_pictures(tnc, axis: str) -> None:
    """Corners of the box, in the coordinates of the path, wherever the preset lies."""
    from mnclab.show.solids import stock_of

    text = f"1 BLK FORM 0.1 {axis} X-5 Y+0 Z-20\n2 BLK FORM 0.2 X+100 IY+50 Z+0\n3 TOOL CALL 1 Z F1\n4 L X+1\n"
    body = stock_of(tnc(text, LONG))
    assert (body.points.min(0).tolist(), body.points.max(0).tolist()) == ([-5, 0, -20], [100, 50, 0])
