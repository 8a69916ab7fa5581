"""A wall that the contour crosses somewhere still stands everywhere else, and a contour that crosses itself inside is refused."""

import numpy as np
import pytest
from tools.running import run

from mnclab import Tool

CALLS = {"mnc": "T1", "g43": "T1 M6\nD1"}


def passed(control, blocks, mirrored=False):
    """A program whose left side is the right one of its mirror image (X becomes -X)."""
    if mirrored:
        blocks = blocks.replace("X", "X-").replace("--", "").replace("G41", "G42")
    head = f"G17 G90\n{CALLS[control]}\n"
    return run(blocks.replace(" / ", "\n"), control, ok=None, before=head, tools={1: Tool(radius=2.0)})


#: Along a wall, down at its end, back below it, up through it at X10, and back above it to {0}, {1} beside it as far as {2}.
BACK = "G0 X-10 Y10 Z-1 / G41 G1 X0 Y0 F200 / X100 / Y-30 / X10 / Y20 / X80 / Y{0} / X{1} / G40 Y-10"


@pytest.mark.parametrize("control", CALLS)
@pytest.mark.parametrize("mirrored", [False, True])
@pytest.mark.parametrize("apart, until", [(3, 30), (1, 30), (3.9, 60), (3, 20)])
def test_a_wall_crossed_far_away_still_stands(control, mirrored, apart, until):
    found = passed(control, BACK.format(apart, until), mirrored)
    (alarm,) = [alarm for alarm in found.alarms if alarm.severity == "alarm"]
    assert f"{apart} mm apart" in alarm.message


@pytest.mark.parametrize("control", CALLS)
@pytest.mark.parametrize("mirrored", [False, True])
def test_beside_a_crossed_wall_a_tool_that_fits_is_accepted(control, mirrored):
    found = passed(control, BACK.format(4.1, 30).replace("G40 Y-10", "G40 X0"), mirrored)
    assert found.ok, found.alarms


#: Inside of a rectangle from (-before, 0) round to (0, -past): the last wall crosses the first at an inside corner.
INSIDE = "G0 X{0} Y10 Z-1 / G41 G1 X{0} Y0 F200 / X100 / Y50 / X0 / Y{1} / G40 X20"


@pytest.mark.parametrize("control", CALLS)
@pytest.mark.parametrize("mirrored", [False, True])
@pytest.mark.parametrize("before, past", [(-10, -10), (-10, -1), (-1, -10), (-0.5, -0.5), (-3, -30), (0, -10)])
def test_a_contour_run_past_its_start_inside_is_refused(control, mirrored, before, past):
    found = passed(control, INSIDE.format(before, past), mirrored)
    assert [alarm for alarm in found.alarms if alarm.severity == "alarm"]


@pytest.mark.parametrize("control", CALLS)
def test_a_narrow_slot_cut_twice_is_refused(control):
    """Both of its walls twice: the second time gives no wall up."""
    slot = "X40 Y0 / X50 Y1.5 / X40 Y3 / X0 Y3 / X-20 Y20 / X-40 Y0 / X0 Y0 / "
    found = passed(control, f"G0 X-20 Y0 Z-1 / G41 G1 X0 Y0 F200 / {slot}{slot}G40 X-20".replace("41", "42"))
    assert found.ok is False
    found = passed(control, f"G0 X-20 Y0 Z-1 / G41 G1 X0 Y0 F200 / {slot}{slot}G40 X-20")
    assert found.ok is False


@pytest.mark.parametrize("control", CALLS)
def test_a_long_way_of_short_lines_is_looked_at_at_once(control):
    angle = np.linspace(0, 1.5 * np.pi, 5000)
    points = np.stack([50 * np.cos(angle), 50 * np.sin(angle)], axis=1)
    body = " / ".join(f"X{x:.6f} Y{y:.6f}" for x, y in points[1:])
    found = passed(control, f"G0 X50 Y-20 Z-1 / G41 G1 X50 Y0 F200 / {body} / G40 X-40")
    assert found.ok, found.alarms
