"""TCH PROBE 419 in what the program itself has cut: `Setup(part="cut")`."""

import math

import pytest

import mnclab
from mnclab import Probe, Setup, Tool

ORIGIN = (100, 200, -300)  # the preset, machine coordinates
TOOLS = {1: Tool(radius=5, length=60, kind="mill"), 7: Tool(radius=2, length=80, kind="probe")}
FORM = "BLK FORM 0.1 Z X+0 Y+0 Z-20\nBLK FORM 0.2 X+60 Y+40 Z+0\n"
SLOT = "TOOL CALL 1 Z S1000\nL X-10 Y+20 Z+5 R0 FMAX M3\nL Z-6 R0 FMAX\nL X+20 R0 F200\nL Z+50 R0 FMAX M5\n"


def probe(x=25, z=-2, row=0, axis=1, y=20):
    """Probe along an axis towards its plus side."""
    values = {"Q263": x, "Q264": y, "Q261": z, "Q320": 0, "Q260": 50, "Q272": axis, "Q267": 1, "Q305": row, "Q333": 0, "Q303": 1}
    lines = "\n".join(f"{name}={value:+g}" for name, value in values.items())
    return f"TOOL CALL 7 Z\nL Z+50 R0 FMAX\nTCH PROBE 419 PUNCT 0 INTR-O AXA\n{lines}\n"


def run(*blocks, **setup):
    text = f"BEGIN PGM P MM\n{''.join(blocks)}END PGM P MM\n"
    values = {"tools": TOOLS, "presets": {1: ORIGIN}, "settings": {"preset": 1}, "part": "cut"} | setup
    return mnclab.run(text, "tnc-620", Setup(probe=Probe(clearance=2, reach=20), **values))


def test_the_end_of_a_slot():
    """A 10 mm mill to X20 leaves a wall at X25: the preset is 100 + 25."""
    found = run(FORM, SLOT, probe())
    assert found.ok, found.alarms
    assert found.tables.presets[0][0] == pytest.approx(125, abs=1e-9)


def test_the_blank_of_the_setup_stands_in_machine_coordinates():
    found = run(SLOT, probe(), stock=((100, 200, -320), (160, 240, -300)))
    assert found.tables.presets[0][0] == pytest.approx(125, abs=1e-9)


def test_what_is_cut_between_two_touches_counts_at_the_second():
    """The same slot, then 4 mm farther: walls at X25 and X29; and its side, at Y25."""
    longer = SLOT.replace("X+20", "X+24")
    found = run(FORM, SLOT, probe(row=2), longer, probe(x=29, row=3), probe(x=10, y=25, row=4, axis=2))
    assert found.ok, found.alarms
    assert [found.tables.presets[row][0] for row in (2, 3)] == pytest.approx([125, 129], abs=1e-9)
    assert found.tables.presets[4][1] == pytest.approx(225, abs=1e-9)


def test_the_tool_cuts_as_its_table_says():
    """DL lifts the path and DR widens a contour; a mill that is only called so is as wide and as long as before."""
    shallower = SLOT.replace("S1000", "S1000 DL+1 DR+0.5")
    assert run(FORM, shallower, probe()).tables.presets[0][0] == pytest.approx(125, abs=1e-9)


def test_a_mill_that_is_not_as_its_table_says():
    """It cuts as it is: 4.98 mm wide to X24.98, whatever the table says; and 0.1 longer, 6.1 mm deep."""
    true = {1: Tool(radius=4.98, length=60.1, kind="mill")}
    found = run(FORM, SLOT, probe(), true_tools=true)
    assert found.tables.presets[0][0] == pytest.approx(124.98, abs=1e-9)
    assert found.workpiece().removed == pytest.approx(6.1 * (20 * 2 * 4.98 + math.pi * 4.98**2 / 2), rel=1e-3)


def test_what_is_cut_later_is_not_touched():
    """The probe finds the face of the blank: nothing has been cut yet."""
    found = run(FORM, probe(x=0), SLOT)
    assert found.tables.presets[0][0] == pytest.approx(100, abs=1e-9)


def test_a_wall_beyond_the_reach_is_an_alarm():
    found = run(FORM, SLOT.replace("X+20", "X+55"), probe())
    assert [alarm.message for alarm in found.alarms] == ["touch point inaccessible: the probe did not trigger within 20 mm"]


def test_without_a_blank():
    (alarm,) = run(SLOT, probe()).alarms
    assert alarm.message == "there is no blank of which the program could have cut the part to touch"
    assert alarm.span.line == 9


@pytest.mark.parametrize(("z", "free"), [(-3.9, True), (-4.1, False), (-5, False)])
def test_a_stylus_that_is_in_contact_already(z, free):
    """The floor of the slot is at Z-6, and the ball of 2 mm stands round Z: from Z-4 down it is in the floor."""
    found = run(FORM, SLOT, probe(z=z))
    assert found.ok is free
    if not free:
        assert "path obstructed: the stylus touches the part" in found.alarms[-1].message


@pytest.mark.parametrize("half_round", [lambda part: part.turned(180), lambda part: part.turned_over("y").turned_over("x")])
def test_the_wall_of_a_former_clamping(half_round):
    """Half a turn about Z puts the wall of the slot from X25 to X35, and its open end to X60: probed towards minus."""
    towards_minus = probe(x=35).replace("Q267=+1", "Q267=-1")
    found = run(towards_minus, stock=half_round(run(FORM, SLOT).workpiece()))
    assert found.ok, found.alarms
    assert found.tables.presets[0][0] == pytest.approx(135, abs=1e-9)
