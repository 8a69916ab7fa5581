"""Ways down against the checks of the catalogue (plunge strategies of G343) and against the steepest angle."""

import numpy as np
import pytest

from mnclab.geometry.contours import Contour
from mnclab.machining.milling import entries, faces
from mnclab.machining.milling.entries import Entry


def slopes(descent):
    """Drop over way of every element, degrees."""
    drop, way = -np.diff(descent.heights), descent.contour.lengths
    return np.degrees(np.arctan2(drop, way))


def test_helix():
    """3°, r 5, 5 deep: pitch 1.6464, 3.0369 turns, then a full circle at the bottom."""
    way = entries.helix((0, 0), 5, 0, -5, 3)
    sloping = way.heights[1:] > -5
    sloping[np.argmin(sloping)] = True
    assert np.degrees(way.contour.sweeps[sloping].sum()) / 360 == pytest.approx(3.0369, abs=1e-4)
    assert 2 * np.pi * 5 * np.tan(np.radians(3)) == pytest.approx(1.6464, abs=1e-4)
    assert slopes(way)[sloping] == pytest.approx(3)
    assert way.contour.sweeps[~sloping].sum() == pytest.approx(2 * np.pi)
    assert np.hypot(*way.contour.points.T) == pytest.approx(5)
    assert entries.helix((0, 0), 5, 0, -5, 3, clockwise=True).contour.sweeps[0] < 0


@pytest.mark.parametrize(("angle", "stroke", "count"), [(3, 70, 2), (10, 28.3564, 1)])
def test_pendulum(angle, stroke, count):
    """At least 20, room 70, 5 deep: as in the check of the reciprocating plunge."""
    way = entries.pendulum((0, 0), 0.0, 0, -5, angle, least=20, room=70)
    x = way.contour.points[:, 0]
    assert x[0] == x[-1] == 0
    assert np.abs(x[1:-1]) == pytest.approx(stroke / 2, abs=1e-4)
    assert x[1] < 0
    drops = -np.diff(way.heights)
    assert drops[drops > 0] == pytest.approx([5 / count] * count)
    assert way.heights[1] == 0 and way.heights[-3] == way.heights[-1] == -5
    assert slopes(way).max() <= angle + 1e-9


@pytest.mark.parametrize("closed", [True, False])
@pytest.mark.parametrize("angle", [1, 20])
def test_along_a_pass(closed, angle):
    contour = Contour([(0, 0), (30, 0), (30, 20)], [0, 0.3, 0], closed=closed)
    way = entries.along(contour, 2, -5, angle)
    assert way.contour.points[0] == pytest.approx(way.contour.points[-1])
    assert (way.heights[0], way.heights[-1]) == (2, pytest.approx(-5))
    assert slopes(way).max() <= angle + 1e-9
    assert slopes(way) == pytest.approx(slopes(way)[0])
    assert contour.distance(way.contour.points_within(0.1)).max() < 1e-9


def test_ninety_degrees_is_straight_down():
    for way in (
        entries.helix((0, 0), 5, 0, -5, 90),
        entries.pendulum((0, 0), 0, 0, -5, 90, least=1, room=5),
        entries.strokes((0, 0), (9, 0), 0, -5, 90),
    ):
        assert way.contour.length == 0 and way.heights.tolist() == [0, -5]


def test_a_piece_with_no_room_is_entered_along_its_pass():
    slot = Contour([(0, 0), (30, 0)], closed=False)
    (narrow,) = faces.slot(slot, 8, 4).pieces
    (wide,) = faces.rectangle(60, 40, 4, 4).pieces
    assert entries.descent(wide, Entry("helix", 3), 4, 0, -5).label == "entry helix"
    assert entries.descent(wide, Entry("ramp", 3), 4, 0, -5).label == "entry ramp"
    assert entries.descent(wide, Entry(), 4, 0, -5).label == "entry"
    for kind in ("helix", "ramp"):
        down = entries.descent(narrow, Entry(kind, 3), 4, 0, -5)
        assert down.label == "entry along the pass"
        assert slopes(down).max() <= 3 + 1e-9


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: entries.helix((0, 0), 0, 0, -5, 3), "no room for a helix"),
        (lambda: entries.helix((0, 0), 5, 0, -5, 0), "plunge angle"),
        (lambda: entries.pendulum((0, 0), 0, 0, -5, 3, least=20, room=15), "15 is less than 20"),
        (lambda: Entry("drill"), "drill"),
        (lambda: Entry("helix", 0), "plunge angle"),
    ],
)
def test_what_is_no_entry(make, message):
    with pytest.raises(ValueError, match=message):
        make()
