"""Volumes of a milled part, row by row and as a whole, against closed forms at the default step."""

import math

import numpy as np
import pytest
from tools.milled import BALL, BLOCK, BULL, DRILL, MILL, part
from tools.running import run

from mnclab import Alarm, Tool
from mnclab.workpiece.blank import Box, cylinder

CLOSE = 1e-3  # of what is removed
SMALL = Tool(radius=1.5, number=1)


def capsule(length, radius):
    """The area that a disc sweeps along a line, mm²."""
    return 2 * radius * length + math.pi * radius**2


@pytest.mark.parametrize("at", [0.0, 0.013, 0.04, 0.075, 0.1, 0.137])
@pytest.mark.parametrize("radius", [1.0, 1.5, 5.0])
def test_a_slot_wherever_it_lies_between_the_cells(radius, at):
    left = part(f"G0 X{15 + at} Y{20 + at}\nG1 Z-3\nG1 X{45 + at}\nG0 Z50", Tool(radius=radius, number=1))
    assert left.removed == pytest.approx(3 * capsule(30, radius), rel=CLOSE)
    assert left.volume == 60 * 40 * 20 - left.removed


@pytest.mark.parametrize("degrees", [1, 10, 30, 45, 77])
def test_a_slot_in_any_direction(degrees):
    x, y = (25 * math.cos(math.radians(degrees)) / 2, 25 * math.sin(math.radians(degrees)) / 2)
    left = part(f"G0 X{30 - x:.9f} Y{20 - y:.9f}\nG1 Z-3\nG1 X{30 + x:.9f} Y{20 + y:.9f}\nG0 Z50", SMALL)
    assert left.removed == pytest.approx(3 * capsule(25, 1.5), rel=CLOSE)


def test_rings_crossing_slots_and_steps():
    ring = part("G0 X40 Y20\nG1 Z-3\nG3 X40 Y20 I-10 J0\nG0 Z50", SMALL)
    assert ring.removed == pytest.approx(3 * math.pi * (11.5**2 - 8.5**2), rel=CLOSE)
    cross = part("G0 X-10 Y20\nG1 Z-3\nG1 X70\nG0 Z5\nG0 X30 Y-10\nG1 Z-5\nG1 Y50\nG0 Z50", SMALL)
    assert cross.removed == pytest.approx(3 * 3 * 60 + 3 * 5 * 40 - 3 * 3 * 3, rel=CLOSE)
    step = part("G0 X-10 Y-2\nG1 Z-3\nG1 X70\nG0 Z50")
    assert step.removed == pytest.approx(3 * 3 * 60, rel=CLOSE)


def test_a_wall_thinner_than_a_cell_is_not_overlooked():
    left = part("G0 X-10 Y17.47\nG1 Z-3\nG1 X70\nG0 Z5\nG0 X-10 Y22.53\nG1 Z-3\nG1 X70\nG0 Z50", Tool(radius=2.5, number=1))
    assert 60 * 40 * 20 - left.volume == pytest.approx(2 * 5 * 3 * 60, rel=CLOSE)  # the wall between is 0.06 mm thick


def test_holes_narrower_than_a_cell():
    left = part("".join(f"G0 X{x} Y{y} Z5\nG1 Z-4\nG0 Z5\n" for x in range(5, 60, 5) for y in range(5, 40, 5)),
                Tool(radius=0.05, number=1))  # fmt: skip
    assert left.removed == pytest.approx(77 * 4 * math.pi * 0.05**2, rel=0.1)


@pytest.mark.parametrize("depth", [0.02, 0.1, 0.2, 0.5, 2.0])
@pytest.mark.parametrize("way", [(1.0, 0.0), (0.6, 0.8)], ids=str)
def test_scratches_between_the_middles_of_cells(depth, way):
    (dx, dy), (x, y) = way, (30, 21)  # where four cells of 0.15 mm meet
    text = f"G0 X{x - 12 * dx:g} Y{y - 12 * dy:g}\nG1 Z-{depth}\nG1 X{x + 12 * dx:g} Y{y + 12 * dy:g}\nG0 Z50"
    tan = math.tan(math.radians(30))
    left = part(text, Tool(radius=3, number=1, kind="chamfer", angle=60))
    assert left.removed == pytest.approx(24 * depth**2 * tan + math.pi * (depth * tan) ** 2 * depth / 3, rel=CLOSE)
    assert left.removed_by_row().sum() == pytest.approx(left.removed, rel=1e-12)
    segment = 16 * math.acos(1 - depth / 4) - (4 - depth) * math.sqrt(8 * depth - depth**2)
    left = part(text, BALL)
    assert left.removed == pytest.approx(24 * segment + math.pi * depth**2 * (4 - depth / 3), rel=CLOSE)


@pytest.mark.parametrize("width", [0.3, 1.0, 5.0])
def test_a_strip_narrower_than_its_cells_would_be(width):
    left = part("G0 X-10 Y0\nG1 Z-2\nG1 X70\nG0 Z50", stock=((0, 0, -10), (1000, width, 0)))
    end = (width * math.sqrt(25 - width**2) + 25 * math.asin(width / 5)) / 2  # of the slot, which is round
    assert left.removed == pytest.approx(2 * (70 * width + end), rel=CLOSE)
    assert np.array_equal(np.unique(left.heights[:, left.x < 1000]), [-2, 0])


def test_a_step_is_no_wider_than_the_blank():
    left = part("G0 X-10 Y20\nG1 Z-2\nG1 X70\nG0 Z50", step=1e300)
    assert left.step == 40 and left.removed == pytest.approx(60 * 10 * 2, rel=0.02)
    with pytest.raises(Alarm, match="at most 25,000,000 cells"):
        part("G0 X-10 Y20\nG1 Z-2", step=1e-300)


def test_grooves_points_and_round_floors():
    segment = 16 * math.acos((4 - 2) / 4) - 2 * math.sqrt(16 - 4)  # of the circle of radius 4, 2 mm high
    ball = part("G0 X-10 Y20\nG1 Z-2\nG1 X70\nG0 Z50", BALL)
    assert ball.removed == pytest.approx(60 * segment, rel=CLOSE)
    bull = part("G0 X-10 Y20\nG1 Z-3\nG1 X70\nG0 Z50", BULL)
    assert bull.removed == pytest.approx(60 * (10 * 3 - 2 * (1.5**2 - math.pi * 1.5**2 / 4)), rel=CLOSE)
    cone = 3 / math.tan(math.radians(59))
    drill = part("G0 X30.1 Y20.03\nG1 Z-10\nG0 Z50", DRILL)
    assert drill.removed == pytest.approx(math.pi * 9 * (10 - cone * 2 / 3), rel=CLOSE)
    sink = part("G0 X30.1 Y20.03\nG1 Z-2\nG0 Z50", Tool(radius=5, number=1, kind="countersink", angle=90))
    assert sink.removed == pytest.approx(math.pi * 2**3 / 3, rel=CLOSE)


def test_a_ramp_takes_a_wedge_and_a_half_cylinder():
    left = part("G0 X-20 Y20\nG0 Z0\nG1 X80 Z-10\nG0 Z50")
    y = (np.arange(4000) + 0.5) / 4000 * 10 - 5  # the leading rim is sqrt(25 - y²) ahead: its height falls 1 in 10
    ahead = np.sqrt(25 - y**2)
    assert left.removed == pytest.approx(float((60 * (50 + ahead) / 10).mean() * 10), rel=CLOSE)


@pytest.mark.parametrize("bore", [0, 8])
def test_slots_across_a_standing_cylinder(bore):
    stock = cylinder(20, -10, 0, bore=bore)
    left = part("G0 X-30 Y0\nG1 Z-2\nG1 X30\nG0 Z50", stock=stock)
    y = (np.arange(200_000) + 0.5) / 200_000 * 10 - 5
    chord = 2 * np.sqrt(400 - y**2) - 2 * np.sqrt(np.maximum(bore**2 - y**2, 0))
    assert left.removed == pytest.approx(2 * float(chord.mean()) * 10, rel=CLOSE)
    assert left.volume + left.removed == pytest.approx(math.pi * (400 - bore**2) * 10, rel=1e-12)


def test_a_flat_on_a_lying_cylinder():
    lines = "".join(f"G0 X-10 Y{y} Z5\nG1 Z2\nG1 X50\nG0 Z5\n" for y in (-4, 0, 4))
    left = part(lines, stock=cylinder(6, 0, 40, axis="X"))
    segment = 36 * math.acos(2 / 6) - 2 * math.sqrt(32)
    assert left.removed == pytest.approx(40 * segment, rel=CLOSE)
    assert left.volume == pytest.approx(math.pi * 36 * 40 - left.removed, rel=1e-12)


@pytest.mark.parametrize(
    "body",
    [
        Box((3, 4, 0), (-1, 1, 5)),
        cylinder(5, -10, 0, at=(1, 2, 3)),
        cylinder(5, -10, 0, bore=2),
        cylinder(5, 0, 12, axis="X"),
        cylinder(5, 0, 12, axis="Y")._replace(profile=((5.0, 0.0), (3.0, 7.0), (4.0, 12.0))),
        cylinder(5, 0, 12)._replace(profile=((5.0, 0.0), (5.0, 7.0), (2.0, 12.0), (0.0, 12.0))),
        cylinder(5, 0, 12)._replace(profile=((5.0, 0.0), (3.0, 6.0), (4.0, 12.0))),
    ],
)
def test_the_volume_of_a_blank_is_what_lies_between_its_sides(body):
    low, high = body.bounds
    x, y = (np.linspace(low[k], high[k], 1501)[:-1] + (high[k] - low[k]) / 3000 for k in (0, 1))
    x, y = (each.ravel() for each in np.meshgrid(x, y))
    floor, top = body.faces(x, y)
    thick = np.nan_to_num(top - floor)
    assert body.volume == pytest.approx(thick.mean() * np.prod((high - low)[:2]), rel=3e-4)


def test_what_rows_tools_and_lines_took_away():
    text = "G17 G90 G54\nT1\nS1000 M3 F500\nG0 Z50\nG0 X15 Y20\nG1 Z-3\nG1 X45\nG0 Z50\nT2\nS1000 M3\nG0 X30 Y5\nG1 Z-4\nG0 Z50"
    done = run(text, tools={1: MILL, 2: Tool(radius=3, number=2, kind="mill")}, stock=BLOCK)
    left = done.workpiece()
    rows = left.removed_by_row()
    assert rows.sum() == pytest.approx(left.removed, rel=1e-12) and len(rows) == len(done.toolpath)
    by_line = left.removed_by("line")
    assert set(by_line) == {6, 7, 12}
    assert by_line[6] == pytest.approx(math.pi * 25 * 3, rel=3e-3)
    assert by_line[7] == pytest.approx(10 * 30 * 3, rel=3e-3)
    assert by_line[12] == pytest.approx(math.pi * 9 * 4, rel=3e-3)
    assert left.removed_by("tool") == pytest.approx({1: by_line[6] + by_line[7], 2: by_line[12]})


def test_what_is_milled_away_later_was_taken_by_who_took_it_first():
    text = "G0 X-10 Y20\nG1 Z-1\nG1 X70\nG1 Z-2\nG1 X-10\nG1 Y22.5\nG1 X70\nG0 Z50"
    by_line = part(text).removed_by("line")
    assert {line: round(volume, 0) for line, volume in by_line.items()} == {7: 600, 9: 600, 11: 300}
    assert by_line[11] == pytest.approx(60 * 2.5 * 2, rel=3e-3)
