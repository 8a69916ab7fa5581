"""What stops a datum cycle at a part, with its place; readings of chapter 12 that no example of the catalogue shows.

The ball has radius 3, PR_CLR is 2, the greatest way 20: a touch begins 5 before the nominal point.
"""

import math

import numpy as np
import pytest
from controls.mnc.probing_mnc import DATUM, PROBE, at, base_of, box, disc, measured, probes, rows_of, turn, working

from mnclab import Datum, Probe, Tool
from mnclab.workpiece import part as parts

BOX = box((50, 30), (100, 60))  # X 0 to 100, Y 0 to 60
BORE = disc((10, -5), 30, inside=False)
SIDE = "G419 X0 Y30 L1 K1 Z-8 H20 W0 U0 S1"
SLOT = "G408 X50 Y30 D20 L1 Z-8 H20"


def stopped(text, part, message, column=1, line=3, **more):
    found = measured(text, part, **more)
    alarm = found.alarms[-1]
    assert not found.ok and message in alarm.message, found.alarms
    assert alarm.span[:2] == (line, column)
    return found


def test_no_contact_within_the_greatest_way():
    """From X-5 the ball gets to X15: a side at X18.001 is out of reach, one at X17.9 is not; the probe stands at the limit."""
    found = stopped(SIDE, parts.box((18.001, 0, -80), (100, 60, 0)), "did not trigger within 20 mm")
    assert found.toolpath.end[-1] == pytest.approx((15, 30, -11), abs=1e-9)
    assert working(found) == pytest.approx(DATUM) and not found.measurements
    assert measured(SIDE, parts.box((17.9, 0, -80), (100, 60, 0))).measured["X"] == pytest.approx(17.9, abs=1e-9)


def test_in_contact_where_the_touch_begins():
    """The ball at X-5 touches what stands at X-2 or nearer: the way down is obstructed, or the touch begins in the material."""
    stopped(SIDE, parts.box((-2.1, 0, -80), (100, 60, 0)), "path obstructed: the stylus touches the part")
    centre = "G412 X10 Y-5 D8 Z-8 H20"
    stopped(centre, disc((10, -5), 5.9, inside=False), "path obstructed")
    stopped("G408 X50 Y30 D8 L1 Z-8 H20", box((50.6, 30), (7, 200), inside=False), "path obstructed")


@pytest.mark.parametrize(
    ("text", "part"),
    [
        ("G400 X20 Y0 U80 V0 L2 K1 Z-8 H20", BOX | parts.box((45, -20, -80), (55, 0, 0))),  # straight from start to start
        ("G411 X50 Y30 A100 B60 Z-8 H20", BOX | parts.box((100, 60, -80), (120, 80, 0))),  # round the corner
        ("G414 X20 Y0 A60 C0 D15 B30 Z-8 H20", BOX | parts.box((5, -20, -80), (15, 0, 0))),  # along X before the side
        ("G413 X50 Y30 D100 Z-8 H1", disc((50, 30), 100) | disc((50, 30), 20, 4.1)),  # not above the safe height
    ],
)
def test_an_obstructed_way(text, part):
    """What stands beside the figure is met while the probe positions."""
    if "G413" in text:
        text += " F1 I50 J30 K-10"
    stopped(text, part, "path obstructed: the stylus touches the part at X")


def test_the_stem_is_judged():
    """A stem of 2.5 that goes up 40 from the ball: under a ledge at Z-2 it would run into the edge."""
    ledge = BOX | parts.box((-1.5, 0, -2), (10, 60, 0))
    thick = Probe(**{**PROBE.__dict__, "stem": 2.5})
    stopped(SIDE, ledge, "the stem of the probe touches the part", probe=thick)
    thin = Probe(**{**PROBE.__dict__, "stem": 1.0})
    assert measured(SIDE, ledge, probe=thin).measured["X"] == pytest.approx(0, abs=1e-9)


def test_a_side_that_is_no_side_of_a_corner():
    """Both pairs on the same oblique plane: the lines are parallel, and nothing is set."""
    plane = parts.plane((10, 10, 0), (-1, -1, 0))  # x + y = 20
    text = "G414 X20 Y-4 A4 C-4 D20 B4 Z-8 H20 S1"
    found = stopped(text, plane, "G414: the lines do not cross")
    assert working(found) == pytest.approx(DATUM)


def test_r_of_g400_is_p_with_a_notice():
    """MNC-G400-PR: R1 goes over the safe height, as P1 does."""
    words = "G400 X20 Y0 U80 V0 L2 K1 Z-8 H20"
    by_r, by_p, none = (measured(f"{words} {more}", BOX) for more in ("R1", "P1", ""))
    assert len(rows_of(by_r, 3)) == len(rows_of(by_p, 3)) == len(rows_of(none, 3)) + 2
    assert by_r.ok and "R means P" in by_r.alarms[0].message and by_r.alarms[0].span[:2] == (3, len(words) + 2)
    assert not by_p.alarms


def test_a_side_far_from_its_line_is_noticed():
    """MNC-G400-L1: a side along Y counts from X: 90 degrees with E0, and a notice; with E90 it is 0, without one."""
    words = "G400 X0 Y15 U0 V45 L1 K1 Z-8 H20"
    found = measured(words, BOX)
    assert found.ok and "turns the plane by 90 degrees" in found.alarms[0].message
    assert base_of(found) == pytest.approx(90, abs=1e-9)
    found = measured(words + " E90", BOX)
    assert not found.alarms and base_of(found) == pytest.approx(0, abs=1e-9)


def test_swapped_points_find_the_same_angle():
    """MNC-G400-UNDIRECTED."""
    turned = box((50, 30), (100, 60), 3)
    one = measured("G400 X20 Y-1.5 U80 V1.5 L2 K1 Z-8 H20", turned)
    other = measured("G400 X80 Y1.5 U20 V-1.5 L2 K1 Z-8 H20", turned)
    assert one.measured["angle"] == pytest.approx(3, abs=1e-9) and other.measured["angle"] == pytest.approx(3, abs=1e-9)


def test_coordinates_are_absolute_under_g91():
    """MNC-PROBE-G91."""
    absolute, incremental = measured(SIDE, BOX), measured(f"G91 {SIDE}", BOX)
    assert absolute.toolpath.end == pytest.approx(incremental.toolpath.end)


def test_the_active_row_is_written_and_the_working_datum_stays():
    """MNC-DATUM-WACTIVE: S0 W1 changes row 1 alone, until it is selected again."""
    part = parts.box((0.25, 0, -80), (100, 60, 0))
    found = measured(SIDE.replace("W0 U0 S1", "W1 U0 S0") + "\nG0 X0\nG54\nG0 X0\n", part)
    assert found.tables.datums[1] == pytest.approx(Datum(300.25, 200, -400))
    x = found.toolpath.end[:, 0] + found.toolpath.origin[0]
    assert (x[-2], x[-1]) == pytest.approx((300, 300.25))


def test_a_working_datum_without_a_row_is_lost_with_the_next_selection():
    """MNC-DATUM-W0S1."""
    part = parts.box((0.25, 0, -80), (100, 60, 0))
    found = measured(SIDE + "\nG0 X0\nG54\nG0 X0\n", part)
    x = found.toolpath.end[:, 0] + found.toolpath.origin[0]
    assert (x[-2], x[-1]) == pytest.approx((300.25, 300))
    assert found.tables.datums[1][:3] == DATUM


def test_neither_row_nor_apply_sets_nothing():
    """S0 and W0: the values stay in the record."""
    found = measured("G412 X10 Y-5 D30 Z-8 H20", BORE)
    assert [row.what for row in found.measurements] == ["diameter", "centre X", "centre Y"]
    assert working(found) == pytest.approx(DATUM) and set(found.tables.datums) == {1}
    assert not found.variables  # MNC-PROBE-EXTRA-RESULTS


def test_a_row_keeps_the_columns_that_are_not_measured():
    """MNC-DATUM-OTHERAXES: row 7 keeps Y, Z and its angle, the working datum too."""
    found = measured(SIDE.replace("W0", "W7"), BOX, datums={1: DATUM, 7: Datum(1, 2, 3, rotation=40)})
    assert found.tables.datums[7] == pytest.approx(Datum(300, 2, 3, rotation=40)) and base_of(found) == 0


def test_an_angle_of_zero_is_stored_too():
    """G414 E1 of a part that lies straight: row 8 holds the angle 0, which a later G147 takes; its Z was never written."""
    words = "G414 X20 Y0 A60 C0 D15 B30 Z-8 H20 E1 W8 S1"
    found = measured(f"{words}\nG404 E30\nG147 Q8\nG0 X10 Y0 Z30", BOX)
    assert found.toolpath.end[-1] + found.toolpath.origin == pytest.approx((310, 200, 30), abs=1e-9)


@pytest.mark.parametrize("base", [0.0, 40.0])
def test_calibrated_offsets_change_no_result(base):
    """MNC-PROBE-OFFPOS: the axis stands at the ball less (0.4, -0.3) in machine axes, also under a base rotation."""
    off = np.array((0.4, -0.3))
    before = f"N10 T20\nN20 G54 G90 G00 X0 Y0 Z50\nG404 E{base}\n"
    frame = at(DATUM, base)
    probe = Probe(**{**PROBE.__dict__, "offset": tuple(off)})
    words = "G412 X10 Y-5 D30 Z-8 H20"
    plain, moved = (measured(words, BORE, 3, before, frame, probe=each) for each in (PROBE, probe))
    for what in ("centre X", "centre Y", "diameter"):
        assert moved.measured[what] == pytest.approx(plain.measured[what], abs=1e-9)
    one, other = probes(plain), probes(moved)
    assert other.end[:, :2] == pytest.approx(one.end[:, :2] - off, abs=1e-9)
    assert moved.touches[0].programmed == pytest.approx(plain.touches[0].programmed, abs=1e-9)


def test_an_offset_that_nobody_calibrated_moves_the_centre():
    """The ball is 0.1 beside the axis along X: the centre is found 0.1 the other way, the diameter is right."""
    beside = Probe(**{**PROBE.__dict__, "true_offset": (0.1, 0.0)})
    found = measured("G412 X10 Y-5 D30 Z-8 H20", BORE, probe=beside)
    assert found.measured["centre X"] == pytest.approx(9.9, abs=1e-9)
    assert found.measured["diameter"] == pytest.approx(30, abs=1e-9)


def test_a_ball_that_is_smaller_than_its_row():
    """A ball of 2.95 that the table has as 3: a bore of 30 seems 2 * 0.05 larger, a boss of 40 smaller by as much."""
    true = {20: Tool(radius=2.95, length=150, kind="probe")}
    found = measured("G412 X10 Y-5 D30 Z-8 H20", BORE, true_tools=true)
    assert found.measured["diameter"] == pytest.approx(30.1, abs=1e-9)
    found = measured("G413 X50 Y30 D40 Z-8 H20", disc((50, 30), 40), true_tools=true)
    assert found.measured["diameter"] == pytest.approx(39.9, abs=1e-9)


def test_points_away_from_the_corner():
    """corner_spacing: point 2 of an upper right corner lies at X30 - 20, point 4 at Y50 - 25; the corner is the same."""
    words = "G414 X30 Y60 A20 C100 D50 B25 Z-8 H20 P1"
    turned = box((50, 30), (100, 60), 1)
    found = measured(words, turned, settings={"corner_spacing": "away"})
    starts = [touch.programmed[:2] for touch in found.touches]
    assert [starts[1][0], starts[3][1]] == pytest.approx([10, 25])
    corner = np.array((50, 30)) + turn(1) @ (50, 30)
    assert (found.measured["corner X"], found.measured["corner Y"]) == pytest.approx(corner, abs=1e-9)
    refused = measured(words, turned)  # 50 + 25 is above the upper side
    assert "puts point 4 at Y75" in refused.alarms[0].message


def test_the_record_and_the_figures():
    """A table row for every number, with its touches; the figure as it should be and as it was found."""
    found = measured("G410 X50 Y30 A100 B60 Z-8 H20 W7 S1", box((50.1, 30), (100.2, 60), inside=False))
    rows = {row.what: row for row in found.measurements}
    assert (rows["length X"].nominal, rows["length X"].touches) == (100, (0, 1))
    assert rows["length X"].deviation == pytest.approx(0.2, abs=1e-9)
    assert rows["centre X"].deviation == pytest.approx(0.1, abs=1e-9)
    assert rows["datum X"].actual == pytest.approx(350.1, abs=1e-9) and math.isnan(rows["datum X"].nominal)
    (figure,) = found.figures
    assert figure.nominal.length == pytest.approx(320) and figure.actual.length == pytest.approx(320.4)
    assert figure.height == -8 and figure.touches == (0, 1, 2, 3)


@pytest.mark.parametrize(
    "text", ["G408 X50 Y20 D8 L1 Z-8 H20 P1", "G410 X50 Y20 A8 B60 Z-8 H20", "G412 X50.1 Y20.3 D7.7 Z-8 H20"]
)
def test_from_the_centre_without_moves_of_no_length(text):
    """MNC-PROBE-CENTRE: all touches begin in one place, and no row is shorter than a micrometre."""
    part = disc((50.1, 20.3), 8, inside=False) if "G412" in text else box((50, 20), (8.1, 60), inside=False)
    found = measured(text, part)
    assert found.ok, found.alarms
    assert len({tuple(each) for each in probes(found).start.tolist()}) == 1
    assert np.linalg.norm(rows_of(found, 3).end - rows_of(found, 3).start, axis=1).min() > 1e-3
