"""Descents as steps, and the steps of a pocket and of a surface, without any control."""

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from mnclab.machining.depths import TooMany
from mnclab.machining.milling import faces
from mnclab.machining.milling.entries import Entry, descend, helix, pendulum, vertical
from mnclab.machining.milling.faces import Layer, face
from mnclab.machining.milling.pocket_steps import LevelFeeds, Room, approaching, leaving, rough, way_down
from mnclab.machining.steps import Along, Go, Turn


@given(
    radius=st.floats(0.5, 20), drop=st.floats(0.1, 20), angle=st.floats(1, 45), start=st.floats(-3, 3),
    clockwise=st.booleans(), feeds=st.sampled_from([(100, 400), (400, 400), (None, None)]),
)  # fmt: skip
def test_a_helix_is_one_turn_and_a_full_circle(radius, drop, angle, start, clockwise, feeds):
    """A lead of 2·π·r·tan(angle), whatever the feeds; the circle is level."""
    down = helix((3, 4), radius, 5, 5 - drop, angle, start=start, clockwise=clockwise)
    slope, circle = descend(down, *feeds)
    sense = -1 if clockwise else 1
    assert slope.angle == pytest.approx(sense * drop / (radius * math.tan(math.radians(angle))))
    assert (slope.z, slope.feed) == (pytest.approx(5 - drop), feeds[0])
    assert circle.angle == pytest.approx(sense * math.tau) and circle.feed == feeds[1]
    assert slope.centre == pytest.approx((3, 4)) and circle.centre == pytest.approx((3, 4))


def test_a_ramp_and_a_plunge_are_straight_moves():
    assert list(descend(vertical((1, 2), 5, 3), 90, 400)) == [Go("entry", 3, 90, 1, 2)]
    swing = list(descend(pendulum((0, 0), 0.0, 0, -5, 3, least=20, room=70), 90, 400))
    moves = [(step.x, step.z, step.feed) for step in swing]  # h / tan(3°) = 95.4 > 70: two strokes of 2.5
    assert moves == [(-35, 0, 400), (35, -2.5, 90), (-35, -5, 90), (35, -5, 400), (0, -5, 400)]


@given(
    kind=st.sampled_from(["vertical", "helix", "ramp"]), width=st.floats(0.5, 30), longer=st.floats(0, 30),
    climb=st.booleans(), size=st.sampled_from([None, 4.0]),
)  # fmt: skip
def test_every_way_down_ends_at_the_level_within_its_room(kind, width, longer, climb, size):
    entry, room = Entry(kind, 5.0, size), Room(width, width + longer, 0.0)
    least = 16 if size is None else size
    if kind == "ramp" and 2 * room.half_length < least:
        with pytest.raises(ValueError, match="no room for a ramp"):
            way_down(entry, room, 4.0, climb, 0, -3)
        return
    down = way_down(entry, room, 4.0, climb, 0, -3)
    assert down.heights[0] == 0 and down.heights[-1] == -3
    assert abs(down.contour.points[:, 0]).max() <= (room.half_length if kind == "ramp" else width) + 1e-9
    assert abs(down.contour.points[:, 1]).max() <= width + 1e-9


def test_a_layer_begins_where_the_one_before_has_cut():
    """Every descent starts at the level that is already there; the tool comes back to the middle after each."""
    asked = []

    def down(top, bottom):
        asked.append((top, bottom))
        return vertical((0, 0), top, bottom)

    clearing = faces.circle(40, 5, 5)
    steps = list(
        rough(clearing, (-4, -8, -10), surface=0, clearance=2, down=down, feeds=LevelFeeds(400, 90), departure=2, side=1)
    )
    assert asked == [(0, -4), (-4, -8), (-8, -10)]
    assert [step.z for step in steps if step.label.endswith("lift")] == [-2, -6, -8]
    assert sum(isinstance(step, Along) and "circle" in step.label for step in steps) == 3 * 3
    assert not any(isinstance(step, Turn) for step in steps)


def test_the_arcs_at_a_wall_are_quarter_circles():
    wall = faces.circle(40, 5, 5).passes[-1]
    to, away = approaching(wall, 3, 1), leaving(wall, 3, 1)
    assert to.points.tolist() == [[12, -3], [15, 0]] and to.length == pytest.approx(1.5 * math.pi)
    assert away.points.tolist() == [pytest.approx((15, 0)), pytest.approx((12, 3))]


def test_lines_that_do_not_lead_on_are_reached_above_the_surface():
    passes = faces.lines((0, 10), -5, 50, 5, one_way=True)
    layers = [
        Layer("layer 1 of 2", -1, passes, 400, 900, 90),
        Layer("layer 2 of 2", -2, passes.reversed(), 400, 900, 90),
    ]
    steps = [step for step in face(layers, 3, lift=2) if isinstance(step, Go)]
    assert [(step.z, step.x, step.y) for step in steps[:3]] == [(None, -5, 0), (3, None, None), (-1, None, None)]
    lifts = [step.z for step in steps if step.label.endswith("lift")]
    assert lifts == [1, 0]


def test_nobody_waits_for_millions_of_steps():
    with pytest.raises(TooMany, match="0.001 divides 11 into more than 2000 steps"):
        faces.steps(11, 0.001)
    assert faces.steps(2, 0.001) == 2_000
    assert faces.steps(1e-7, 0.001) == 0
    with pytest.raises(TooMany, match="a helix of radius 0.001 at 1 degrees has more than 10000 turns in 5"):
        helix((0, 0), 0.001, 0, -5, 1)
    with pytest.raises(TooMany, match="a ramp 2 long at 0.001 degrees has more than 10000 strokes in 5"):
        pendulum((0, 0), 0.0, 0, -5, 0.001, least=1, room=2)
