"""Where the tool rolls onto a contour or off it: not through the contour, and where a cusp would lead it there it goes straight.

The expected points are R square to the contour at its ends, and distances are measured from points along the arcs.
"""

import warnings

import numpy as np
import pytest
from tools.running import run

import mnclab
from mnclab import Kind, Setup, Tool

R = 2.0
CALLS = {"mnc": "T1", "g43": "T1 M6\nD1"}


def led(control, blocks):
    head = f"G17 G90\n{CALLS[control]}\n"
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        return run(blocks.replace(" / ", "\n"), control, ok=None, before=head, tools={1: Tool(radius=R)})


def cutting(found):
    """The rows of the tool centre from the entry to the exit."""
    path = found.toolpath[found.toolpath.is_motion]
    first = int(np.argmax(path.side != 0))
    return path[first:]


@pytest.mark.parametrize("control", CALLS)
@pytest.mark.parametrize("away", ["Y-40", "X5 Y-40", "X-5 Y-40"])
def test_off_a_round_boss_straight_back_the_tool_goes_straight(control, away):
    """As LinuxCNC does: G0 X0 Y-40, G41 X0 Y0, the circle, and from (-2, 0) straight to the end of the exit."""
    found = led(control, f"G0 X0 Y-40 Z-1 / G41 G1 X0 Y0 F200 / G2 X0 Y0 I10 J0 / G40 G1 {away}")
    assert found.ok, found.alarms
    path = cutting(found)
    assert path.kind.tolist() == [Kind.LINE, Kind.ARC, Kind.LINE]
    assert np.allclose(path.end[:2, :2], [-R, 0]) and path.sweep[1] == pytest.approx(-2 * np.pi)


@pytest.mark.parametrize("control", CALLS)
@pytest.mark.parametrize("x", [0, 5, -5])
@pytest.mark.parametrize("turned", [False, True])
def test_onto_a_round_boss_against_its_direction_the_tool_goes_straight(control, x, turned):
    side, way = ("G42", "G3") if turned else ("G41", "G2")
    y = -40 if turned else 40
    found = led(control, f"G0 X{x} Y{y} Z-1 / {side} G1 X0 Y0 F200 / {way} X0 Y0 I10 J0 / G40 G1 Y{-2 * y}")
    assert found.ok, found.alarms
    path = cutting(found)
    assert path.kind[:2].tolist() == [Kind.LINE, Kind.ARC]
    assert np.allclose(path.end[:2, :2], [-R, 0])


BAD = {
    "a short last wall": "G0 X0 Y-10 Z-1 / G41 G1 X0 Y0 F200 / Y20 / X20 / Y19 / G40 X20 Y40",
    "a shorter one": "G0 X0 Y-10 Z-1 / G41 G1 X0 Y0 F200 / Y20 / X20 / Y19.5 / G40 X10 Y40",
    "two of them": "G0 X0 Y-10 Z-1 / G41 G1 X0 Y0 F200 / Y20 / X20 / Y19.5 / X19.9 Y19 / G40 X20 Y40",
    "a small disc": "G0 X0 Y-10 Z-1 / G41 G1 X0 Y0 F200 / G2 X0 Y0 I0.5 J0 / G40 G1 X40 Y-15",
    "a short first wall": "G0 X20 Y40 Z-1 / G42 G1 X20 Y19 F200 / Y20 / X0 / G40 X-10",
    "after a plunge": "G0 X20 Y40 Z5 / G42 G1 X20 Y19 F200 / Z-1 / Y20 / X0 / G40 X-10",
}


@pytest.mark.deep
@pytest.mark.parametrize("control", CALLS)
@pytest.mark.parametrize("lines", BAD.values(), ids=BAD)
def test_a_tool_that_rolls_through_the_part_is_refused(control, lines):
    found = led(control, lines)
    (alarm,) = [alarm for alarm in found.alarms if alarm.severity == "alarm"]
    kind = "onto" if "G42" in lines else "off"
    assert f"rolls {kind} the contour" in alarm.message
    marked = mnclab.run(
        f"G17 G90\n{CALLS[control]}\n" + lines.replace(" / ", "\n") + "\n",
        control,
        Setup(tools={1: Tool(radius=R)}, settings={"gouge": "mark"}),
    )
    assert marked.ok and {"onto": "entry", "off": "exit"}[kind] in [gouge.kind for gouge in marked.gouges]


@pytest.mark.parametrize("control", CALLS)
def test_the_tool_rolls_where_it_keeps_clear(control):
    """Round the end of a wall that is longer than the tool is wide, and at another height than the wall."""
    for lines in (
        "G0 X0 Y-10 Z-1 / G41 G1 X0 Y0 F200 / Y20 / X20 / Y17.9 / G40 X20 Y40",
        "G0 X0 Y-10 Z-1 / G41 G1 X0 Y0 F200 / Y20 / X20 / Z5 / Y19 / G40 X20 Y40",
    ):
        found = led(control, lines)
        assert found.ok, found.alarms
        path = cutting(found)
        assert path.kind[-2] == Kind.ARC and path.sweep[-2] == pytest.approx(-np.pi)


def test_the_tnc_never_rolls_onto_a_contour_or_off_it():
    text = "TOOL CALL 1 Z S1000\nL X+0 Y-10 R0 FMAX\nL X+0 Y+0 RL F200\nL Y+20\nL X+20\nL Y+19\nL X+20 Y+40 R0\n"
    found = mnclab.run(text, "tnc-620", Setup(tools={1: Tool(radius=R)}))
    assert found.ok, found.alarms
    path = cutting(found)
    assert path.kind[-1] == Kind.LINE and np.allclose(path.start[-1, :2], [22, 19])


@pytest.mark.parametrize("control", CALLS)
def test_two_arcs_that_nothing_is_left_of_make_no_noise(control):
    """A half circle inside and the circle beside it: the tool inside of the one would cut through the other."""
    found = led(
        control,
        "G0 X-20 Y-5 Z-1 / G42 G1 X0 Y-5 F200 / Y0 / G2 X10 Y0 I5 J0 / G2 X10 Y0 I5 J0 / G1 Y-5 / G40 X20",
    )
    assert not found.ok and any("cuts into" in alarm.message for alarm in found.alarms)
