"""M97 and M98 (HEIDENHAIN, machining small contour steps and open contour corners), and M120: corners of the equidistant.

The step of the manual's example: along X, down by 0.5 and on, and up again, with a tool far greater than the step.
"""

from __future__ import annotations

import math

import numpy as np
import pytest

import mnclab as mnc

R = 5  # of the tool
STEP = "2 L X+0 Y-20 R0 FMAX M3\n3 L X+10 Y+0 RL\n4 L X+50{}\n5 L IY-0.5\n6 L X+90\n7 L IY+0.5{}\n8 L X+120\n9 L Y+30 R0"


def points(run: mnc.Run, side: int = 1) -> list[list[float]]:
    assert run.ok, run.alarms
    path = run.toolpath.motion
    return path.end[path.side == side][:, :2].round(9).tolist()


def test_a_small_step_is_crossed_over_the_point_where_the_offsets_meet(inside) -> None:
    """At an outside corner both coordinates of the centre are R away from the walls, as they are inside."""
    run = inside(STEP.format(" M97", " M97"))
    assert points(run) == [[10, R], [50 + R, R], [50 + R, R - 0.5], [90 - R, R - 0.5], [90 - R, R], [120, R]]
    assert not (run.toolpath.kind == mnc.Kind.ARC).any()


def test_without_it_the_tool_is_too_large(inside) -> None:
    (alarm,) = [found for found in inside(STEP.format("", "")).alarms if found.severity == "alarm"]
    assert alarm.span.line == 6 and "too short for the tool radius 5" in alarm.message


def test_it_counts_for_the_corner_of_its_block_alone(inside) -> None:
    """Outside corners of a square, left of the travel clockwise: the second is prolonged, the others are arcs."""
    run = inside("2 L X-20 Y+0 FMAX M3\n3 L X+0 RL\n4 L Y+40\n5 L X+40 M97\n6 L Y+0\n7 L X-20 R0")
    arcs = run.toolpath[run.toolpath.kind == mnc.Kind.ARC]
    assert [-R, 40] in points(run) and [40 + R, 40 + R] in points(run)
    assert arcs.centre[:, :2].tolist() == [[0, 40]] and np.allclose(arcs.sweep, -math.pi / 2)


def test_beside_an_arc_the_offset_circle_is_met(inside) -> None:
    """An arc about (0, 0) of radius 20 from (-20, 0) clockwise to (0, 20), then down: centre at x = R on the circle R + 20."""
    run = inside("2 L X-20 Y-30 FMAX M3\n3 L Y+0 RL\n4 CC X+0 Y+0\n5 C X+0 Y+20 DR- M97\n6 L Y+0\n7 L X-30 R0")
    assert [round(R, 9), round(math.sqrt((20 + R) ** 2 - R**2), 9)] in points(run)


def test_in_a_free_contour(inside) -> None:
    run = inside("2 L X-20 Y+0 FMAX M3\n3 L X+0 RL\n4 FL X+0 Y+40 M97\n5 FL X+40 Y+40\n6 L Y+0\n7 L X-20 R0")
    assert [-R, 40 + R] in points(run)


def test_an_open_end_is_square_to_the_element(inside) -> None:
    """The contour ends at (50, 0): the tool stands at (50, R), and goes on only where there is no corner."""
    run = inside("2 L X+0 Y-20 R0 FMAX M3\n3 L X+10 Y+0 RL\n4 L X+30 M98\n5 L X+50 M98\n6 L Y+30 R0")
    assert points(run) == [[10, R], [30, R], [50, R]]


@pytest.mark.parametrize("text", ["M120 LA5", "M120", "M120 LA0", "M120 LAQ1"])
def test_look_ahead_changes_nothing_where_the_tool_fits(text: str, inside) -> None:
    blocks = "2 Q1 = 9\n3 L X+0 Y-20 R0 FMAX M3\n4 L X+10 Y+0 RL {}\n5 L X+50\n6 L Y+40\n7 L X+80 R0"
    with_it, without = inside(blocks.format(text)), inside(blocks.format(""))
    assert points(with_it) == points(without) == [[10, R], [50 - R, R], [50 - R, 40]]
    assert len(with_it.alarms) == (text in ("M120 LA5", "M120 LAQ1"))


@pytest.mark.parametrize(("text", "fits"), [("", True), (" M120", True), (" M120 LA0", True), (" M120 LA9", False)])
def test_look_ahead_leaves_nothing_out(text: str, fits: bool, inside) -> None:
    """A neck 8 mm wide, whose walls are many blocks apart: a control that does not look ahead cuts into the other wall."""
    neck = "4 L Y+0\n5 L X-30\n6 L Y-40\n7 L X+30\n8 L Y+0\n9 L X+4\n10 L Y+30\n11 L Y+60 R0"
    run = inside(f"2 L X-4 Y+60 FMAX M3\n3 L Y+30 RL{text}\n{neck}")
    assert run.ok == fits
    if not fits:
        assert [gouge.kind for gouge in run.gouges] == ["bottleneck"]
        assert "they are 8 mm apart: 2 mm are missing" in run.alarms[-1].message
