"""Rotary axes in L: angles, times and exports worked out here."""

from __future__ import annotations

import math

import numpy as np
import pytest

from mnclab import Kind
from mnclab.show.export_gcode import lines


def degrees(run) -> list[list[float]]:
    assert run.ok, run.alarms
    return np.round(np.degrees(run.toolpath.motion.rotary), 9).tolist()


def test_angles_absolute_and_incremental(inside) -> None:
    run = inside("2 L X+10 C+90\n3 L IC-30 A-15\n4 L X+20\n5 L B+Q1 C+0 FMAX".replace("+Q1", "+7.5"))
    assert degrees(run) == [[0, 0, 90], [-15, 0, 60], [-15, 0, 60], [-15, 7.5, 0]]
    path = run.toolpath.motion
    assert path.end[:, 0].tolist() == [10, 10, 20, 20] and path.lengths.tolist() == [10, 0, 10, 0]
    assert [Kind(k).name for k in path.kind] == ["LINE", "LINE", "LINE", "RAPID"]


def test_a_turn_alone_takes_the_time_of_the_longest_way(inside) -> None:
    """90 degrees of C and 30 of A at F 180 degrees a minute: 30 s; the feed of the row is rad/min."""
    run = inside("2 L A+30 C-90 F180")
    assert run.toolpath.motion.feed.tolist() == [math.pi]
    assert run.profile().time == pytest.approx(30)
    assert "line    X0 Y0 Z0 A30 C-90 F180 degrees/min" in str(run.toolpath)


def test_linear_axes_decide_where_both_move(inside) -> None:
    alone, both = inside("2 L X+50 F600").profile().time, inside("2 L X+50 C+90 F600").profile().time
    assert alone == both


def test_a_block_that_turns_nothing_makes_no_row(inside) -> None:
    assert len(inside("2 L C+0 A+0").toolpath.motion) == 0


def test_turns_in_a_compensated_contour(inside) -> None:
    """A turn between two elements happens where the offset of the first one ends."""
    run = inside("2 L X+0 Y-20\n3 L Y+0 RL\n4 L X+20\n5 L C+45\n6 L X+40\n7 L Y-20 R0")
    turn = run.toolpath[run.toolpath.line == 6]
    assert run.ok and len(turn) == 1 and turn.end[0].tolist() == pytest.approx([20, 5, 0])


def test_export(inside) -> None:
    """Degrees, and degrees a minute where nothing else moves."""
    blocks = [b for b in lines(inside("2 L X+10 C+90 F200\n3 L C+0 F720\n4 L X+0 F300")) if b[0] in "GXF C"]
    assert [b for b in blocks if "X" in b or "C" in b][-3:] == ["G1 X10 C90 F200", "C0 F720", "X0 F300"]
