"""Feeds at the cutting edge against their formula, and the ways of slots: ramps along a line, arcs to wall and floor."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from mnclab.geometry import contours
from mnclab.geometry.contours import Contour
from mnclab.machining.milling.entries import descend, onto_floor, swing
from mnclab.machining.milling.pocket_steps import along, centre_feeds, half_circles, quarter_circles
from mnclab.machining.steps import Turn


@given(path=st.floats(0.1, 50), radius=st.floats(0.5, 10), clockwise=st.booleans())
def test_the_edge_moves_at_the_feed(path, radius, clockwise):
    """The edge lies at r + R inside a wall and at |r - R| outside: both turn with the same angular speed."""
    circle = Contour.circle((3, 4), path, clockwise=clockwise)
    wall = -1 if clockwise else 1  # outside of the circle
    assert centre_feeds(circle, 500, radius, wall) / path * (path + radius) == pytest.approx(500)
    if path > radius + 1e-3:
        assert centre_feeds(circle, 500, radius, -wall) / path * (path - radius) == pytest.approx(500)
    elif path <= radius:
        with pytest.raises(ValueError, match="the wall has no radius"):
            centre_feeds(circle, 500, radius, -wall)


def test_each_piece_of_a_contour_has_its_own_feed():
    """Corners of 3 with a tool of 5: 500·3/8; one step for each run of one feed, the whole contour in all."""
    ring = contours.rectangle(40, 30, 3)
    steps = list(along("wall", ring, 500, 5, 1))
    assert [step.feed for step in steps] == pytest.approx([500, 187.5] * 4 + [500])
    assert sum(step.contour.length for step in steps) == pytest.approx(ring.length)
    ends = [step.contour.points[-1] for step in steps]
    assert np.allclose(ends[:-1], [step.contour.points[0] for step in steps[1:]]) and np.allclose(
        ends[-1], ring.points[0]
    )


def test_one_feed_is_one_step():
    ring = contours.rectangle(40, 30, 3)
    assert [step.contour for step in along("wall", ring, 500)] == [ring]
    (step,) = along("wall", Contour.circle((0, 0), 20), 500, 10)
    assert step.feed == pytest.approx(500 * 20 / 30) and step.contour.closed
    assert [step.feed for step in along("wall", ring, None, 5)] == [None]


LINES = st.one_of(
    st.builds(lambda x: Contour([(0, 0), (x, 0)], closed=False), st.floats(1, 80)),
    st.builds(contours.arc, st.floats(2, 40), st.floats(-4, 4), st.floats(0.1, 2 * math.pi)),
)


@given(line=LINES, drop=st.floats(0.1, 10), angle=st.floats(2, 80))
def test_a_swing_sinks_evenly_and_as_steeply_as_it_may(line, drop, angle):
    down = swing(line, 1, 1 - drop, angle)
    slope = -np.diff(down.heights) / down.contour.lengths
    assert slope == pytest.approx(slope[0]) and slope[0] <= math.tan(math.radians(angle)) + 1e-9
    strokes = down.contour.length / line.length
    assert strokes == pytest.approx(math.ceil(drop / line.length / math.tan(math.radians(angle)) - 1e-9))
    assert (down.heights[0], down.heights[-1]) == pytest.approx((1, 1 - drop))
    end = line.points[-1] if round(strokes) % 2 else line.points[0]
    assert down.contour.points[-1] == pytest.approx(end)
    turns = [step for step in descend(down, 90, 400) if isinstance(step, Turn)]
    if line.bulge.any():  # each stroke is one turn, there and back
        assert [turn.angle for turn in turns] == pytest.approx(
            [line.sweeps.sum() * (-1) ** k for k in range(len(turns))]
        )
        assert len(turns) == round(strokes)


def test_a_line_without_length_has_no_ramp():
    with pytest.raises(ValueError, match="a ramp needs a stroke"):
        swing(Contour([(1, 1), (1, 1)], closed=False), 0, -1, 3)
    assert swing(Contour([(1, 1), (5, 1)], closed=False), 0, -1, 90).heights.tolist() == [0, -1]


@given(direction=st.floats(-4, 4), height=st.floats(0.05, 5), up=st.booleans())
def test_the_floor_is_touched_on_a_quarter_circle(direction, height, up):
    top, bottom = (-height, 0) if up else (height, 0)
    down = onto_floor((3, 4), direction, top, bottom)
    ahead = (down.contour.points - (3, 4)) @ (math.cos(direction), math.sin(direction))
    aside = (down.contour.points - (3, 4)) @ (-math.sin(direction), math.cos(direction))
    assert aside == pytest.approx(0, abs=1e-9) and np.hypot(ahead, down.heights - top) == pytest.approx(height)
    assert down.heights[-1] == pytest.approx(bottom) and ahead[-1] == pytest.approx(0, abs=1e-9)
    assert ahead[0] == pytest.approx(-height)


@given(radius=st.floats(5, 40), size=st.floats(0.1, 4), start=st.floats(-3, 3), side=st.sampled_from([1, -1]))
def test_half_circles_touch_the_wall(radius, size, start, side):
    """They begin and end one diameter away from the wall, and go on in its direction."""
    wall = Contour.circle((3, 4), radius, start, clockwise=side < 0)
    to, off = half_circles(wall, size, side)
    for far in (to.points[0], off.points[-1]):
        assert np.hypot(*(far - (3, 4))) == pytest.approx(radius - size)
    assert to.points[-1].tolist() == off.points[0].tolist() == wall.points[0].tolist()
    assert to.tangents()[1][-1] == pytest.approx(wall.tangents()[0][0], abs=1e-9)
    assert off.tangents()[0][0] == pytest.approx(wall.tangents()[1][-1], abs=1e-9)


def test_no_way_needs_no_arcs():
    wall = Contour.circle((0, 0), 5)
    assert half_circles(wall, 0, 1) == quarter_circles(wall, 0, 1) == ()
