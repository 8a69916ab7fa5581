"""A probe driven into the part by plain blocks: the run ends at the block, as the machine would."""

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


def test_the_true_probe_counts():
    """A ball of 2 passes 2.5 over the top; one that is 0.6 longer than its table says does not."""
    moves = "L Z+0.5 FMAX\nL X+50 FMAX\n"
    assert run(moves).ok
    longer = run(moves, true_tools={7: mnc.Tool(radius=2, length=50.6, kind="probe")})
    assert not longer.ok and "near" in longer.alarms[-1].message
