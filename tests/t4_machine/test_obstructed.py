"""A probe driven into the part by plain blocks: the run ends at the block, as the machine would."""

import re

import pytest

import mnclab as mnc

PART = mnc.part.box((0, 0, -30), (100, 60, 0))
HEAD = "BEGIN PGM P MM\nTOOL CALL 7 Z\nL X-20 Y+20 Z+50 R0 FMAX\n"
TOUCH = "TCH PROBE 419 X\nQ263=0\nQ264=20\nQ261=-5\nQ320=0\nQ260=20\nQ272=1\nQ267=1\nQ305=0\nQ333=0\nQ303=1\n"


def run(moves, part=PART, **setup):
    tools = {7: mnc.Tool(radius=2, length=50, kind="probe"), 1: mnc.Tool(radius=2, length=50)}
    machine = mnc.Setup(tools=tools, part=part, start=(0, 0, 200), **setup)
    return mnc.run(f"{HEAD}{TOUCH}{moves}END PGM P MM\n", "tnc-620", machine)


@pytest.mark.parametrize(
    ("moves", "ok"),
    [
        ("L X-10 Y+20 FMAX\nL Z-5 FMAX\nL Y+50 FMAX\n", True),
        ("L Z-5 FMAX\nL X+20 FMAX\n", False),  # from X-2 into the wall at X0
        ("L X+20 FMAX\nL Z-0.5 F500\n", False),
        ("L X+20 FMAX\nL Z+0.5 F500\nL X+90 FMAX\n", True),
        ("L X-10 FMAX\nL Z-5 FMAX\nCC X-10 Y+40\nC X+10 Y+40 DR+ F500\n", False),  # half a circle into the wall
        ("TOOL CALL 1 Z\nL X+20 FMAX\nL Z-5 F500\n", True),  # a mill may
    ],
)
def test_plain_blocks(moves, ok):
    found = run(moves)
    assert found.ok == ok, found.alarms
    if not ok:
        last = moves.splitlines()[-1]
        alarm = found.alarms[-1]
        assert "path obstructed: the probe touches the part near" in alarm.message
        assert found.program.line_text(alarm.span.line) == last
        assert found.toolpath.step.max() < found.programs[0].text.count("\n")


@pytest.mark.parametrize(("unit", "factor"), [("INCH", 1.0), ("MM", 25.4)])
def test_the_place_is_told_in_the_unit_of_the_program(unit, factor):
    """A ball of 0.1 in meets the wall at X0 with its centre at X-0.1, on the way along Y0.4 and Z-0.4: as cycles tell theirs."""
    tools = {7: mnc.Tool(radius=2.54, length=50, kind="probe")}
    head = "TOOL CALL 7 Z\nL X-1 Y+0.4 Z+1 R0 FMAX\nL Z-0.4 FMAX\nL X+1 FMAX\n"
    moves = re.sub(r"([XYZ][-+])([\d.]+)", lambda found: f"{found[1]}{float(found[2]) * factor:.3f}", head)
    setup = mnc.Setup(tools=tools, part=PART, start=(-90, 0, 90))
    found = mnc.run(f"BEGIN PGM P {unit}\n{moves}END PGM P {unit}\n", "tnc-620", setup)
    x, y, z = map(float, re.search(r"near X(\S+) Y(\S+) Z(\S+) while positioning$", found.alarms[0].message).groups())
    assert (x, y, z) == pytest.approx((-0.1 * factor, 0.4 * factor, -0.4 * factor), abs=0.01)


def test_the_true_probe_counts():
    """A ball of 2 passes 2.5 over the top; one that is 0.6 longer than its table says does not."""
    moves = "L Z+0.5 FMAX\nL X+50 FMAX\n"
    assert run(moves).ok
    longer = run(moves, true_tools={7: mnc.Tool(radius=2, length=50.6, kind="probe")})
    assert not longer.ok and "near" in longer.alarms[-1].message
