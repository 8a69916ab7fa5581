"""Sections of a milled part: contours against closed forms."""

import math

import numpy as np
import pytest
from tools.milled import BALL, DRILL, part

from mnclab import Alarm, Tool
from mnclab.workpiece.blank import cylinder

SLOT = "G0 X15 Y20\nG1 Z-3\nG1 X45\nG0 Z50"


def corners(contour):
    return {tuple(point) for point in np.round(contour.points, 6).tolist()}


def test_an_upright_section_of_a_slot_has_eight_corners_at_their_places():
    (section,) = part(SLOT).cut("XZ", 20)
    assert corners(section) == {(0, -20), (60, -20), (60, 0), (50, 0), (50, -3), (10, -3), (10, 0), (0, 0)}
    assert len(section.points) == 8 and section.closed and section.area == pytest.approx(60 * 20 - 40 * 3, abs=1e-6)
    (across,) = part(SLOT).cut("YZ", 30)
    assert corners(across) == {(0, -20), (40, -20), (40, 0), (25, 0), (25, -3), (15, -3), (15, 0), (0, 0)}


def test_what_is_cut_through_is_in_pieces():
    pieces = part("G0 X30 Y-10\nG1 Z-25\nG1 Y50\nG0 Z50").cut("xz", 5)
    assert [corners(each) for each in pieces] == [
        {(0, -20), (25, -20), (25, 0), (0, 0)}, {(35, -20), (60, -20), (60, 0), (35, 0)},
    ]  # fmt: skip
    tube = part("G0 X0 Y0 Z50", stock=cylinder(20, -10, 0, bore=8)).cut("YZ", 0)
    assert [corners(each) for each in tube] == [
        {(-20, -10), (-8, -10), (-8, 0), (-20, 0)}, {(8, -10), (20, -10), (20, 0), (8, 0)},
    ]  # fmt: skip


def test_points_and_round_grooves():
    (drilled,) = part("G0 X30 Y20\nG1 Z-10\nG0 Z50", DRILL).cut("XZ", 20)
    shoulder = round(-10 + 3 / math.tan(math.radians(59)), 6)
    assert corners(drilled) >= {(27, 0), (27, shoulder), (30, -10), (33, shoulder), (33, 0)}
    (groove,) = part("G0 X-10 Y20\nG1 Z-2\nG1 X70\nG0 Z50", BALL).cut("YZ", 30)
    assert groove.area == pytest.approx(40 * 20 - (16 * math.acos(0.5) - 2 * math.sqrt(12)), abs=1e-3)


def test_level_sections_of_blanks_and_slots():
    left = part(SLOT)
    outline, slot = sorted(left.cut("XY", -1), key=lambda each: -each.area)
    assert outline.area == pytest.approx(60 * 40, abs=0.01)
    assert outline.bounds == pytest.approx(np.array([[0, 0], [60, 40]]), abs=1e-3)
    assert slot.area == pytest.approx(-(30 * 10 + math.pi * 25), abs=0.02)  # a hole: clockwise
    assert slot.bounds == pytest.approx(np.array([[10, 15], [50, 25]]), abs=1e-3)
    (below,) = left.cut("XY", -3.001)
    assert below.area == pytest.approx(60 * 40, abs=0.01)
    assert left.cut("XY", 0.001) == [] and left.cut("XY", -20.001) == []
    assert left.cut("XZ", 41) == [] and left.cut("YZ", -1) == []


def test_level_sections_of_round_bodies():
    outer, inner = part("G0 X0 Y0 Z50", stock=cylinder(20, -10, 0, bore=8)).cut("XY", -5)
    assert outer.area == pytest.approx(math.pi * 400, abs=0.02) and inner.area == pytest.approx(-math.pi * 64, abs=0.02)
    (lying,) = part("G0 X0 Y0 Z50", stock=cylinder(6, 0, 40, axis="X")).cut("XY", 3)
    assert lying.area == pytest.approx(40 * 2 * math.sqrt(27), abs=0.02)


def test_level_sections_of_corners_and_islands():
    frame = "G0 X10 Y10\nG1 Z-2\nG1 X50\nG1 Y30\nG1 X10\nG1 Y10\nG0 Z50"
    outline, groove, island = sorted(part(frame, Tool(radius=2, number=1)).cut("XY", -1), key=lambda each: -abs(each.area))
    assert island.area == pytest.approx(36 * 16, abs=0.01)
    assert groove.area == pytest.approx(-(44 * 24 - (4 - math.pi) * 4), abs=0.02)
    assert outline.area == pytest.approx(2400, abs=0.01)
    assert len(island.points) < 40  # straight runs are merged


@pytest.mark.parametrize("plane, at", [("ZX", 0), ("", 0), (None, 0), ("XY", math.nan), ("XY", "low"), ("XZ", None)])
def test_a_section_that_is_none_is_refused(plane, at):
    with pytest.raises(Alarm, match="the plane of a section|where the section"):
        part("G0 X0").cut(plane, at)
