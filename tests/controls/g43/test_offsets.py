"""Where coordinates of the ISO mill count from: work offsets, G10, G52 and G92, G53, reference points."""

from functools import partial

import numpy as np
import pytest
from tools import running

from mnclab import Datum, Kind, Tool

run = partial(running.run, control="g43")
lines = running.lines


def places(found):
    """Machine coordinates of the tip after each row."""
    return (found.toolpath.end + found.toolpath.origin).round(9).tolist()


def last(text, **given):
    return places(run(lines(text), **given))[-1]


def test_further_work_offsets_are_rows_from_101_on():
    datums = {1: (1, 2, 3), 7: (5, 5, 5), 101: (10, 20, 30), 148: (100, 0, 0)}
    found = run(lines("X1 Y1 Z1|G54.1 P1 X1 Y1 Z1|G54.1 P48 X1|G59.1 X0 Y0 Z0"), datums=datums)
    assert places(found) == [[2, 3, 4], [11, 21, 31], [101, 21, 31], [5, 5, 5]]
    assert last("G154 P1 X1", datums=datums) == last("G110 X1", datums=datums) == [11, 0, 0]


def test_a_work_offset_may_be_turned():
    """(3, 0) turned by 90 degrees about the origin of the offset."""
    assert last("X3 Y0", datums={1: Datum(10, 20, 0, rotation=90)}) == [10, 23, 0]


@pytest.mark.parametrize(("text", "end"), [
    ("G10 L2 P1 X10 Y5|X1 Y1", [11, 6, 0]),
    ("G10 L2 P1 X10|G91 G10 L2 P1 X5|G90 X0", [15, 0, 0]),  # under G91 it adds
    ("G10 L2 P2 X7|X1|G55 X1", [8, 0, 0]),
    ("G10 L2 P1 R90|X5 Y0", [0, 5, 0]),
    ("G10 L2 P0 X3|X1|G55 X2", [5, 0, 0]),  # before all work offsets
    ("G10 L20 P3 Y9|G54.1 P3 Y1", [0, 10, 0]),
    ("G20|G10 L2 P1 X1|G21|X1", [26.4, 0, 0]),
])  # fmt: skip
def test_g10_writes_work_offsets(text, end):
    assert last(text) == end


def test_g10_is_in_the_tables_of_the_run():
    found = run("G10 L2 P2 X7 Y8 Z9 R15\n")
    assert found.tables.datums[2] == Datum(7, 8, 9, rotation=15)


@pytest.mark.parametrize(("dialect", "text", "end"), [
    ("linuxcnc", "G0 X5|G10 L20 P1 X2|X3", [6, 0, 0]),  # the present point 5 is X2 then
    ("linuxcnc", "G0|G10 L2 P0 X3|X1|G55 X1", [1, 0, 0]),  # P0 is the active one, G54
    ("linuxcnc", "G10 L2 P1 X10|G91 G10 L2 P1 X5|G90 G0 X0", [5, 0, 0]),
    ("fanuc", "G52 X10|G92 X0|X1|G52 X0|X1", [1, 0, 0]),  # from -10 on: G92 X0 ends the local shift
    ("fanuc", "G92 X5|G52 X3|X0|G52 X0|X0", [-5, 0, 0]),  # G92 stays
    ("linuxcnc", "G92 X5|G52 X0|G0 X1", [1, 0, 0]),  # one register
])  # fmt: skip
def test_makers_differ(dialect, text, end):
    assert last(text, dialect=dialect) == end


@pytest.mark.parametrize(("text", "end"), [
    ("X5|G92 X0|G55 X1", [6, 0, 0]),  # all work offsets are shifted
    ("X5|G92 X0 Y2|G92.1 X0|X1 Y1", [1, -1, 0]),  # the shift along Y stays
    ("X5|G92 X0|G92.2|X1|G92.3|X1", [6, 0, 0]),
    ("X5|G92 X0|G92.2|X1|G92.1|G92.3|X2", [2, 0, 0]),
])  # fmt: skip
def test_set_position(text, end):
    assert last(text) == end


def test_g53_moves_at_rapid_or_as_the_motion_stands():
    text = lines("G1 X5 F100 S1 M3|G53 X9")
    for dialect, kind in (("fanuc", Kind.RAPID), ("haas", Kind.LINE), ("linuxcnc", Kind.LINE)):
        found = run(text, dialect=dialect, datums={1: (2, 0, 0)}).toolpath.motion
        assert found.kind[-1] == kind and found.end[-1, 0] + 2 == 9


def test_g53_under_g91():
    text = lines("G0 X5|G91 G53 X2|X1")
    fanuc = run(text, datums={1: (10, 0, 0)})
    assert places(fanuc)[-1] == [18, 0, 0] and "counts for nothing" in fanuc.alarms[0].message
    assert places(run(text, datums={1: (10, 0, 0)}, dialect="haas"))[-1] == [3, 0, 0]
    assert "cannot stand under G91" in run(text, ok=False, dialect="linuxcnc").alarms[0].message


def test_settings_of_the_start():
    datums = {1: (10, 0, 0), 2: (100, 0, 0)}
    assert last("X1", datums=datums, start_datum="none") == [1, 0, 0]
    assert last("X1|G55 X1", datums=datums, start_datum="none") == [101, 0, 0]
    assert last("X5|G92 X0|G55 X1", datums={2: (100, 0, 0)}, g92_lasts="ends") == [101, 0, 0]
    arc = run("F100\nG1 X10\nG2 X20 I15 J0\n", arc_centres="origin", stopped_spindle="accept")
    assert arc.toolpath.centre[-1].tolist() == [15, 0, 0]


# --- reference points -------------------------------------------------------------------------------------------------


def test_the_commonest_line_of_all():
    """G91 G28 Z0: straight up to the reference point, the spindle at machine zero."""
    found = run(lines("T1 M6|G90 G43 H1 G0 X5 Z-50|G91 G28 Z0|G90"), tools={1: Tool(length=80)}, start=(0, 0, -10))
    assert places(found)[-1] == [5, 0, -80]


def test_all_reference_points():
    positions = {"second_reference_x": -5.0, "third_reference_z": -9.0, "fourth_reference_y": 7.0}
    found = run(lines("X1 Y2 Z-3|G30 X2|G30 P3 Z-4|G30 P4 Y3|G28"), **positions)
    assert places(found)[1:] == [[2, 2, -3], [-5, 2, -3], [-5, 2, -4], [-5, 2, -9], [-5, 3, -9], [-5, 7, -9], [0, 0, 0]]


def test_back_from_the_reference_point_over_the_same_point():
    assert places(run(lines("X9 Y9|G28 X3 Y4|G29 X7 Y8")))[1:] == [[3, 4, 0], [0, 0, 0], [3, 4, 0], [7, 8, 0]]
    assert places(run(lines("X9|G28 X3|G91 G29 X7")))[-1] == [10, 0, 0]  # from the intermediate point


def test_g28_up_under_a_rotation_about_z():
    assert last("X5 Y5 Z-9|G68 X0 Y0 R30|G91 G28 Z0") == [5, 5, 0]


def test_a_reference_point_that_the_program_sets():
    assert last("G0 X3 Y4|G28.1|X0 Y0|G28", dialect="linuxcnc") == [3, 4, 0]


def test_a_check_that_holds():
    assert last("X1|G27 X0") == [0, 0, 0]


def test_the_reference_point_of_rotary_axes():
    found = run(lines("G0 A90 C45|G28 A0"))
    assert np.degrees(found.toolpath.rotary[-1]).tolist() == [0, 0, 45]
    for text, angles in (("G28", [0, 0, 0]), ("G28 X0 Y0 Z0", [90, 0, 45]), ("G30", [0, 0, 0]), ("G91 G28 Z0 C0", [90, 0, 0])):
        found = run(lines(f"G0 X5 Y6 Z7 A90 C45|{text}"))
        assert np.degrees(found.toolpath.rotary[-1]).tolist() == pytest.approx(angles)
        assert places(found)[-1] == ([5, 6, 0] if "C0" in text else [0, 0, 0])
    found = run(lines("G0 X3 A30 C10|G28.1|X9 A90 C45|G28"), dialect="linuxcnc")  # all of its parameters 5161 to 5166
    assert np.degrees(found.toolpath.rotary[-1]).tolist() == pytest.approx([30, 0, 10]) and places(found)[-1] == [3, 0, 0]
