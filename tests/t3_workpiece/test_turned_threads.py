"""Threads in a half section: teeth a pitch apart, on a cone, of several starts, of a tap; volumes by Pappus."""

import math

import pytest
from t3_workpiece.lathe import BAR, cutting, turned

from mnclab.path.tool import Tool
from mnclab.workpiece.blank import cylinder
from mnclab.workpiece.turning.turned import Turned

V = Tool(number=4, kind="thread", main_angle=60, auxiliary_angle=60)


def tooth(radius, depth):
    """A V of 60 degrees from a radius down, turned about the axis: its middle lies a third below the radius."""
    return 2 * math.pi * depth**2 * math.tan(math.pi / 6) * (radius - depth / 3)


def test_a_thread_has_a_tooth_for_each_pitch():
    part = turned(V, (-3, 29), (-23, 29), threads=(0,), pitch=2)
    assert part.removed == pytest.approx(11 * tooth(30, 1), rel=1e-12)
    assert part.at([-3.0, -5.0, -4.0, -23.0]) == pytest.approx([29, 29, 30, 29])
    assert any("rings a pitch apart" in note for note in part.notes)
    rows = part.removed_by_row()
    assert rows[0] == pytest.approx(part.removed)


def test_passes_go_deeper_in_the_same_groove():
    """The second pass, 1.5 pitches farther back and 0.5 deeper, has its own groove; a whole pitch back it has the same."""
    one = turned(V, (-4, 29.5), (-20, 29.5), (-20, 32), threads=(0,), pitch=2)
    both = Turned(cutting([V, V], [[(-4, 29.5), (-20, 29.5)], [(-2, 29), (-20, 29)]], threads=(0, 1), pitch=2))
    two = Turned(cutting([V, V], [[(-4, 29.5), (-20, 29.5)], [(-3, 29.5), (-19, 29.5)]], threads=(0, 1), pitch=2))
    assert one.removed == pytest.approx(9 * tooth(30, 0.5), rel=1e-12)
    assert both.removed == pytest.approx(10 * tooth(30, 1), rel=1e-12)
    assert two.removed == pytest.approx(18 * tooth(30, 0.5), rel=1e-12)  # two starts


def test_rows_of_one_thread_follow_each_other():
    """Two rows of 7 and 14 mm are one of 21; the tool pulls out of it in the same turn."""
    whole = turned(V, (-3, 29), (-24, 29), threads=(0,), pitch=2)
    parts = turned(V, (-3, 29), (-10, 29), (-24, 29), threads=(0,), pitch=2)
    out = turned(V, (-3, 29), (-10, 29), (-10.5, 29.5), threads=(0,), pitch=2)
    assert whole.removed == pytest.approx(11 * tooth(30, 1), rel=1e-12) == parts.removed
    assert out.removed == pytest.approx(4 * tooth(30, 1), rel=1e-12)


def test_a_rapid_out_of_a_thread_cuts_nothing():
    """Straight across it leaves its groove half a turn on; along the axis it runs into the next one's crest."""
    out = turned(V, (-3, 29), (-24, 29), (-24, 35), threads=(0,), pitch=2, rapids=(1,))
    along = turned(V, (-3, 29), (-24, 29), (-30, 29), threads=(0,), pitch=2, rapids=(1,))
    assert out.removed == pytest.approx(11 * tooth(30, 1), rel=1e-12)
    assert along.removed > out.removed + 5 * 2 * math.pi * 29


def test_a_thread_on_a_cone():
    """Teeth of equal depth under a cone of 1 in 10 are those of the flanks, leaning: area by three corners."""
    cone = cylinder(30, -60, 0)._replace(profile=((36.0, -60.0), (30.0, 0.0)))
    pitch = math.hypot(2, 0.2)  # along the flank
    part = turned(V, (-4, 29.4), (-24, 31.4), threads=(0,), pitch=pitch, stock=cone)
    t, wanted = math.tan(math.pi / 6), 0.0
    for k in range(11):
        z, r = -4 - 2 * k, 29.4 + 0.2 * k
        high = 30 - 0.1 * z - r  # of the cone above the tip
        right, left = high * t / (1 + 0.1 * t), high * t / (1 - 0.1 * t)
        corners = [(z, r), (z + right, r + right / t), (z - left, r + left / t)]
        area = abs(
            (corners[1][0] - z) * (corners[2][1] - r) - (corners[2][0] - z) * (corners[1][1] - r)
        ) / 2
        wanted += 2 * math.pi * area * sum(corner[1] for corner in corners) / 3
    assert part.removed == pytest.approx(wanted, rel=1e-12)


def test_a_tap_cuts_its_profile_into_its_bore():
    """M10 × 1.5: from the core 10 - 1.0825·1.5 a trapezium of 3/4 and 1/8 of the pitch in each turn."""
    depth = 5 / 8 * 1.5 * math.sqrt(3) / 2
    tap = Tool(number=7, kind="tap", radius=5, pitch=1.5)
    tube = cylinder(30, -20, 0, bore=5 - depth)
    part = turned(tap, (-1.5, 0), (-9, 0), (-1.5, 0), threads=(0,), pitch=1.5, stock=tube)
    wide, narrow = 0.75 * 1.5, 0.125 * 1.5
    middle = 5 - depth + depth * (wide + 2 * narrow) / (wide + narrow) / 3
    assert part.removed == pytest.approx(6 * 2 * math.pi * depth * (wide + narrow) / 2 * middle, rel=1e-9)
    assert part.bore_at(-3.0) == pytest.approx(5) and part.bore_at(-3.75) == pytest.approx(5 - depth)


def test_without_a_pitch_a_row_is_swept():
    part = turned(V, (2, 29), (-23, 29), threads=(0,), stock=BAR)
    assert part.at(-10.0) == pytest.approx(29)
