"""Probing what a mill has left: a ball is led against walls, floors, rims and grooves whose places are known."""

import math

import numpy as np
import pytest

import mnclab
from mnclab import Setup, Tool
from mnclab.workpiece.part import contact

BLOCK = ((0, 0, -20), (60, 40, 0))
END_MILL = Tool(radius=5, kind="mill")
BALL = 2.0  # the radius of the probe's ball, mm


def part(blocks, tool=END_MILL, stock=BLOCK):
    """What is left after a program, whose first block is the tool's way to its first cut."""
    text = f"T1 M6\nS1000 M3\n{blocks}\nG0 Z50\n"
    run = mnclab.run(text, "g43", Setup(tools={1: tool}, stock=stock))
    assert run.ok, run.alarms
    return run.workpiece().part


def travel(body, start, direction, ball=BALL):
    return contact(body, start, direction, ball, 100)


SLOT = "G0 X-10 Y20 Z5\nG0 Z-4\nG1 X20 F200"


@pytest.mark.parametrize(
    "start, direction, expected",
    [
        ((10, 20, -1.5), (1, 0, 0), 20 + 5 - BALL - 10),  # the round end of the slot
        ((10, 20, -1.5), (0, 1, 0), 5 - BALL),  # its walls
        ((10, 20, -1.5), (0, -1, 0), 5 - BALL),
        ((10, 20, 5), (0, 0, -1), 5 + 4 - BALL),  # its floor
        ((10, 30, 5), (0, 0, -1), 5 - BALL),  # the top of the blank
        ((-20, 20, -8), (1, 0, 0), 20 - BALL),  # the face below the slot
        ((-20, 20, -1.5), (1, 0, 0), 45 - BALL),  # in from outside, through the open end
        ((20, 20, -1.5), (math.cos(0.7), math.sin(0.7), 0), 5 - BALL),  # along a spoke of the round end
    ],
)
def test_a_slot(start, direction, expected):
    assert travel(part(SLOT), start, direction) == pytest.approx(expected, abs=1e-9)


def test_the_rim_of_a_slot_is_an_edge():
    """The ball's middle 1 mm above the top: it meets the edge where its section there is √(2² − 1²) wide."""
    assert travel(part(SLOT), (10, 20, 1), (0, 1, 0)) == pytest.approx(5 - math.sqrt(BALL**2 - 1), abs=1e-9)


TWO_PASSES = "G0 X-10 Y10 Z5\nG0 Z-4\nG1 X80 F200\nG0 Y{0}\nG1 X-10"


def test_no_wall_stands_between_passes_that_overlap():
    """Passes of a 10 mm tool, 9.5 mm apart: the ball crosses from one to the other and stops at the second's wall."""
    body = part(TWO_PASSES.format(19.5))
    assert travel(body, (30, 10, -1), (0, 1, 0)) == pytest.approx(19.5 + 5 - BALL - 10, abs=1e-9)


@pytest.mark.parametrize("start, sign", [(10, 1), (20.5, -1)])
def test_a_rib_between_passes_is_touched_from_both_sides(start, sign):
    """Passes 10.5 mm apart leave half a millimetre, from Y15 to Y15.5."""
    body = part(TWO_PASSES.format(20.5))
    assert travel(body, (30, start, -1), (0, sign, 0)) == pytest.approx(5 - BALL, abs=1e-9)


def test_a_step_is_met_at_its_edge():
    """From a floor of −4 towards one of −2 beside it, whose wall the first tool made at Y15; the middle 0.5 above −2."""
    body = part(TWO_PASSES.replace("G0 Y{0}", "G0 Z-2\nG0 Y18").format())
    assert travel(body, (30, 10, -1.5), (0, 1, 0)) == pytest.approx(5 - math.sqrt(BALL**2 - 0.25), abs=1e-9)


def test_a_ball_groove():
    """A groove of radius 5 about a line 1 mm above the top: two balls touch where their middles are 5 − 2 apart."""
    body = part(SLOT, Tool(radius=5, corner=5, kind="mill"))
    assert travel(body, (10, 20, 3), (0, 0, -1)) == pytest.approx(3 + 4 - BALL, abs=1e-9)
    assert travel(body, (10, 20, -1), (0, 1, 0)) == pytest.approx(math.sqrt(3**2 - 2**2), abs=1e-9)


def test_the_corner_of_a_bull_nose():
    """Corner 3: its middle stands 2 mm from the axis and 3 above the floor; the ball's middle ends 1 mm from it."""
    body = part(SLOT, Tool(radius=5, corner=3, kind="mill"))
    assert travel(body, (10, 20, -1.5), (0, 1, 0)) == pytest.approx(2 + math.sqrt(1 - 0.5**2), abs=1e-9)


def test_a_drilled_cone():
    """A point of 90° to Z−10: its sides fall by 1 for 1, and hold a ball √2 times its radius above the tip."""
    body = part("G0 X30 Y20 Z5\nG1 Z-10 F100", Tool(radius=5, angle=90, kind="drill"))
    assert travel(body, (30, 20, 10), (0, 0, -1)) == pytest.approx(20 - math.sqrt(2) * BALL, abs=1e-9)
    assert travel(body, (30, 20, -2), (0.6, 0.8, 0)) == pytest.approx(5 - BALL, abs=1e-9)


def test_a_ramp():
    """A flat tool down by 1 in 5 from X10: its front edge, 5 mm ahead, leaves z = −(x − 5)/5."""
    body = part("G0 X10 Y20 Z5\nG0 Z0\nG1 X40 Z-6 F200")
    assert travel(body, (25, 20, 3), (0, 0, -1)) == pytest.approx(3 + 4 - BALL * math.sqrt(1.04), abs=1e-9)


@pytest.mark.parametrize("angle", np.linspace(0.1, 6, 7))
def test_a_round_pocket(angle):
    body = part("G0 X30 Y20 Z5\nG1 Z-5 F100\nG1 X36\nG3 I-6 J0\nG1 X30")
    aside = (math.cos(angle), math.sin(angle), 0)
    assert travel(body, (30, 20, -2), aside) == pytest.approx(6 + 5 - BALL, abs=1e-9)


def test_a_stud_left_by_an_arc():
    """Round (30, 20) at radius 15 with a 10 mm tool: a stud of radius 10 is touched from the groove."""
    body = part("G0 X45 Y20 Z5\nG1 Z-6 F100\nG3 I-15 J0")
    assert travel(body, (45, 20, -3), (-1, 0, 0)) == pytest.approx(45 - 40 - BALL, abs=1e-9)


def test_a_round_blank():
    body = part("G0 X60 Y20 Z5\nG0 Z-3\nG1 X40 F100", stock=mnclab.blank.cylinder(25, -20, 0, at=(30, 20, 0)))
    assert travel(body, (-10, 24, -8), (1, 0, 0)) == pytest.approx(40 - math.sqrt(27**2 - 4**2), abs=1e-9)
    assert travel(body, (30, 20, 5), (0, 0, -1)) == pytest.approx(5 - BALL, abs=1e-9)


@pytest.mark.deep
def test_a_ball_is_never_led_into_the_material():
    """At random places of a pocket with all kinds of passes the ball ends where the nearest of all heights is its radius off."""
    passes = "G0 X10 Y10 Z5\nG1 Z-3 F100\nG1 X50 Z-6\nG1 Y30\nG3 X40 Y30 I-5 J0\nG1 X12 Y25 Z-2\nG1 X10 Y10"
    run = mnclab.run(f"T1 M6\nS1000 M3\n{passes}\nG0 Z50\n", "g43", Setup(tools={1: END_MILL}, stock=BLOCK))
    left, random = run.workpiece(), np.random.default_rng(7)
    wide = 1.01 * BALL
    y, x = (each.ravel() for each in np.meshgrid(*2 * [np.linspace(-wide, wide, 201)]))
    for _ in range(10):
        angle, start = random.uniform(0, 2 * np.pi), np.array([*random.uniform((5, 5), (55, 35)), 4.0])
        way = np.array([math.cos(angle), math.sin(angle), -random.uniform(0.3, 2)])
        end = start + way / np.linalg.norm(way) * travel(left.part, start, way)
        away = np.hypot(np.hypot(x, y), np.maximum(end[2] - left.at(end[0] + x, end[1] + y), 0.0))
        assert BALL - 1e-7 < away.min() < BALL + 0.04  # the points stand 0.02 mm apart


def test_a_bore_along_a_helix():
    """Two turns down at radius 6 with a 10 mm tool, one more at the bottom: the wall, and the floor's ring."""
    body = part("G0 X36 Y20 Z5\nG0 Z0\nG3 Z-4 I-6 J0 F200\nG3 Z-8 I-6 J0\nG3 I-6 J0")
    assert travel(body, (34, 20, -4), (-math.cos(1), -math.sin(1), 0)) > 0
    assert travel(body, (36, 20, -5), (1, 0, 0)) == pytest.approx(5 - BALL, abs=1e-9)
    assert travel(body, (30, 26, 5), (0, 0, -1)) == pytest.approx(5 + 8 - BALL, abs=1e-9)


def test_a_ramp_along_a_helix():
    """A quarter turn down by 3 mm: beside its end the floor is that of the tool's last place."""
    body = part("G0 X45 Y20 Z5\nG0 Z0\nG3 X30 Y35 Z-3 I-15 J0 F200")
    assert travel(body, (30, 35, 5), (0, 0, -1)) == pytest.approx(5 + 3 - BALL, abs=1e-9)
    assert travel(body, (30, 35, -0.5), (-1, 0, 0)) == pytest.approx(5 - BALL, abs=1e-9)
