"""Steps as a tool path without a machine: rows of straight moves, turns and contours, wherever they are moved to."""

import math

import numpy as np
import pytest

from mnclab import Kind
from mnclab.geometry.contours import Contour
from mnclab.machining.milling import faces
from mnclab.machining.milling.entries import toolpath
from mnclab.machining.steps import Along, Go, Turn, Wait, moved, traced

HALF = Contour([(10, 0), (-10, 0)], [1.0, 0.0], closed=False)  # counter-clockwise about (0, 0)
STEPS = [
    Go("over", 5),
    Go("over", 5),  # leads nowhere
    Go("in", 0, 100, 10, 0),
    Wait("stand", 1.0),
    Along("down", HALF, 200, [0, -2]),
    Turn("on", math.pi, -4, 300),
]


def test_rows_are_those_of_the_steps_that_move():
    path = traced(STEPS, (0, 0, 20), 4)
    assert [row.label for row in path] == ["over", "in", "down", "on"]
    assert path.kind.tolist() == [Kind.RAPID, Kind.LINE, Kind.ARC, Kind.ARC]
    assert path.end == pytest.approx(np.array([(0, 0, 5), (10, 0, 0), (-10, 0, -2), (10, 0, -4)]))
    assert path.sweep == pytest.approx([0, 0, math.pi, math.pi])
    assert path.centre[2:] == pytest.approx(np.array([(0, 0, 0), (0, 0, -2)]))
    assert path.feed.tolist() == [math.inf, 100, 200, 300] and set(path.radius) == {4}


def test_moved_steps_make_the_same_path_elsewhere():
    path, other = traced(STEPS, (0, 0, 20), 4), traced(moved(STEPS, 30, -7), (30, -7, 20), 4)
    assert other.end == pytest.approx(path.end + [30, -7, 0])
    assert other.centre[2:] == pytest.approx(path.centre[2:] + [30, -7, 0])
    assert other.labels == path.labels


def test_layers_begin_where_the_one_before_has_cut():
    """On each of two levels: down at the middle from the level before, and the circles."""
    path = toolpath(faces.circle(40, 5, 5), (-3, -5))
    down = [row for row in path if row.label == "entry"]
    assert [(row.start[2], row.end[2]) for row in down] == [(2, 0), (0, -3), (2, -3), (-3, -5)]
    assert {row.end[2] for row in path if row.label.startswith("circle")} == {-3, -5}
