"""Cycles 1410, 1411 and 1420: every example and check of the catalogue (TNC 620, 14.2 to 14.5)."""

import json
import math
from pathlib import Path

import numpy as np
import pytest
from controls.tnc_620.alignment import PRESET, bored, cycle, ends, plate, points, run, studs

from mnclab import Datum
from mnclab.controls.tnc_620.probing.aimed import read
from mnclab.geometry import frames
from mnclab.workpiece.part import plane

FILE = Path(__file__).parents[2] / "authorities" / "catalogue" / "tnc620-probing-alignment.json"
EXAMPLES = json.loads(FILE.read_text(encoding="utf-8"))
CLOSE = 5e-4  # the checks are rounded to four or five places
TURN = math.radians(1.5)
HOLES = ((10.02, -4.97, 30.04), (10.02 + 80 * math.cos(TURN), -4.97 + 80 * math.sin(TURN), 29.98))
EDGE = {
    "Q1100": 10, "Q1101": 0, "Q1102": -5, "Q1103": 90, "Q1104": 0, "Q1105": -5, "Q372": 2, "Q320": 0, "Q260": 100, "Q1125": 2,
    "Q309": 0, "Q1126": 0, "Q1120": 1, "Q1121": 1,
}  # fmt: skip


def example(code, number):
    found = [e for e in EXAMPLES if e["code"] == code][number]
    return found["program"], found["check"]


def same_touches(found, expected):
    assert len(found.touches) == len(expected)
    for touch, one in zip(found.touches, expected, strict=True):
        assert touch.programmed == pytest.approx(one["ball_center"], abs=CLOSE)
        assert np.linalg.norm(np.subtract(touch.centre, touch.start)) == pytest.approx(one["travel"], abs=CLOSE)
        assert touch.direction == pytest.approx(one["direction"], abs=1e-12)


def same_results(found, results):
    assert {q: found.variables[q] for q in results} == pytest.approx(results, abs=CLOSE)


def columns(row):
    return dict(zip(("X", "Y", "Z", "SPC"), (row.x, row.y, row.z, row.rotation), strict=True))


def test_1410_an_edge():
    program, check = example("TCH PROBE 1410", 1)
    found = run(program, plate())
    assert found.ok, found.alarms
    same_touches(found, check["touches"])
    assert ends(found) == pytest.approx(points(check["moves"]), abs=CLOSE)
    same_results(found, check["results"])
    assert found.variables["Q994"] == pytest.approx(1.5, abs=1e-9)
    assert columns(found.tables.presets[1]) == pytest.approx(check["preset_after"], abs=1e-5)
    assert "point 1 X" in found.files["TCHPRAUTO.html"] and found.measured["rotation"] == pytest.approx(1.5, abs=1e-9)


def test_1410_what_is_taken_over():
    check = example("TCH PROBE 1410", 1)[1]
    found = run(cycle(1410, EDGE | {"Q1121": 0}), plate())
    assert columns(found.tables.presets[1]) == pytest.approx(check["preset_after_with_Q1121_0"], abs=1e-4)
    found = run(cycle(1410, EDGE | {"Q1120": 0, "Q1121": 2}), plate())
    assert found.tables.presets[1] == pytest.approx((*PRESET, 0, 0, 1.5, 0, 0, 0), abs=1e-9)
    assert not found.toolpath.rotary.any()  # Q1126 = 0: the axis stays
    found = run(cycle(1410, EDGE | {"Q1120": 0, "Q1121": 0}), plate())
    assert found.tables.presets[1] == (*PRESET, 0, 0, 0, 0, 0, 0)


def test_1410_the_measured_point_keeps_its_nominal_coordinates():
    """The block after it goes to the nominal point: the tip stands where the surface was found, whatever turns."""
    after = "\nL X+10 Y+0 Z+50 R0 FMAX"
    for changes in ({}, {"Q1121": 0}):
        found = run(cycle(1410, EDGE | changes) + after, plate())
        assert found.toolpath.end[-1] == pytest.approx((10, found.variables["Q951"], 50), abs=1e-9)
    found = run(cycle(1410, EDGE | {"Q1120": 3}) + after.replace("+10", "+50"), plate())
    middle = (found.variables["Q951"] + found.variables["Q954"]) / 2
    assert found.toolpath.end[-1] == pytest.approx((50, middle, 50), abs=1e-9)
    ahead = run(cycle(1410, EDGE) + "\nL X+60 Y+0 Z+50 R0 FMAX", plate())  # 50 along the edge, which lies under 1.5 degrees
    expected = (10 + 50 * math.cos(TURN), ahead.variables["Q951"] + 50 * math.sin(TURN), 50)
    assert ahead.toolpath.end[-1] == pytest.approx(expected, abs=1e-9)


def test_1410_with_a_basic_rotation_that_is_active():
    """Of 1 degree: the edge under 1.5 on the machine is found at 0.5; SPC becomes 1.5, Q965 counts from the table."""
    found = run(cycle(1410, EDGE | {"Q1120": 0}), plate(), presets={1: Datum(*PRESET, rotation=1)})
    assert [found.variables[q] for q in ("Q964", "Q965", "Q994", "Q995")] == pytest.approx([0.5, 1.5, 0.5, 0.5], abs=1e-9)
    assert found.tables.presets[1].rotation == pytest.approx(1.5, abs=1e-9)


def test_1410_the_rotary_table():
    """C turns by the angle and shows what it showed; the point lands where the table takes it about its center (120, 230)."""
    settings = {"table_x": 120, "table_y": 230}
    values = EDGE | {"Q1121": 2, "Q1126": 2}
    found = run(cycle(1410, values) + "\nFN 18: SYSREAD Q5 = ID270 NR1 IDX6", plate(), settings=settings)
    assert math.degrees(found.toolpath.rotary[-1][2]) == pytest.approx(1.5, abs=1e-9)
    assert found.variables["Q5"] == pytest.approx(0, abs=1e-9)
    here = np.array([100 + 10, 200 + found.variables["Q951"]]) - (120, 230)
    back = np.array([[math.cos(TURN), math.sin(TURN)], [-math.sin(TURN), math.cos(TURN)]]) @ here + (120, 230)
    row = found.tables.presets[1]
    assert (row.x, row.y, row.c) == pytest.approx((back[0] - 10, back[1], 1.5), abs=1e-9)
    assert "turns C by 1.5000 degrees" in found.alarms[0].message


def test_1410_never_in_a_plane_and_downwards():
    """Q1125 = -1 stays low and starts from where it is; Q372 = -3 measures heights, and the rotation is 0."""
    found = run(cycle(1410, EDGE | {"Q1125": -1}), plate())
    ways = ["X10 Y-4", "Z-7", "Y-2.0493", "Y-4", "X90 Y-4", "Y0.0456", "Y-4"]
    assert ends(found) == pytest.approx(points(ways, (0, 0, 100)), abs=CLOSE)
    heights = {"Q1101": 20, "Q1104": 20, "Q1102": 0, "Q1105": 0, "Q372": -3}
    found = run(cycle(1410, EDGE | heights), plate())
    assert [found.variables[q] for q in ("Q952", "Q955", "Q994")] == pytest.approx([0, 0, 0], abs=1e-9)


@pytest.mark.parametrize("code", ["TCH PROBE 1410", "TCH PROBE 1411", "TCH PROBE 1420"])
def test_printed_with_noughts_they_are_refused(code):
    found = run(example(code, 0)[0], plate())
    said = {"1410": "two places make a line", "1411": "two places make a line", "1420": "makes no plane with the other points"}
    assert said[code[-4:]] in found.alarms[0].message
    assert found.alarms[0].span is not None and not found.touches


def test_1411_two_bores():
    program, check = example("TCH PROBE 1411", 1)
    found = run(program, bored(*HOLES))
    assert found.ok, found.alarms
    same_touches(found, check["touches_1"] + check["touches_2"])
    same_results(found, check["results"])
    assert columns(found.tables.presets[1]) == pytest.approx(check["preset_after"], abs=CLOSE)
    assert len(found.figures) == 2


def test_1411_a_tolerance_of_a_diameter():
    for actual, status, deviation in example("TCH PROBE 1411", 2)[1]["rows"]:
        values = {
            "Q1100": 10, "Q1101": 0, "Q1102": -5, "QS1116": '"+9-1-0.5"', "Q1103": 40, "Q1104": 0, "Q1105": -5, "Q1117": 9,
            "Q1115": 0, "Q423": 4, "Q325": 0, "Q1119": 360, "Q320": 0, "Q260": 20, "Q1125": 1, "Q309": 0, "Q1126": 0, "Q1120": 0,
            "Q1121": 0,
        }  # fmt: skip
        found = run(cycle(1411, values), bored((10, 0, actual), (40, 0, 9)))
        assert found.variables["Q183"] == status and found.variables["Q996"] == pytest.approx(deviation, abs=1e-9)
        for reaction in (1, 2):
            stopped = run(cycle(1411, values | {"Q309": reaction}), bored((10, 0, actual), (40, 0, 9)))
            assert any(a.severity == "alarm" for a in stopped.alarms) == (status >= reaction)
            assert stopped.variables["Q183"] == status  # results stand before the alarm


def test_1411_studs_with_five_touches_over_an_arc():
    values = {
        "Q1100": 10, "Q1101": -5, "Q1102": -5, "Q1116": 30.5, "Q1103": 90, "Q1104": -3, "Q1105": -6, "Q1117": 30.5, "Q1115": 1,
        "Q423": 5, "Q325": 20, "Q1119": 200, "Q320": 0, "Q260": 20, "Q1125": 1, "Q309": 0, "Q1126": 0, "Q1120": 0, "Q1121": 1,
    }  # fmt: skip
    found = run(cycle(1411, values), studs(*HOLES))
    assert found.ok, found.alarms
    same_results(found, example("TCH PROBE 1411", 1)[1]["results"] | {"Q955": -6, "Q996": -0.46, "Q997": -0.52})
    angles = [math.degrees(math.atan2(-t.direction[1], -t.direction[0])) for t in found.touches[:5]]
    assert angles == pytest.approx([20, 70, 120, 170, -140], abs=1e-9)


def test_1420_a_plane():
    program, check = example("TCH PROBE 1420", 1)
    wanted = check["plane"]
    a, b = math.radians(0.8), math.radians(-0.5)
    normal = (math.cos(a) * math.sin(b), -math.sin(a), math.cos(a) * math.cos(b))  # turns about the fixed axes X, then Y
    assert normal == pytest.approx(wanted["normal"], abs=1e-5)
    at = np.add(wanted["through"], PRESET)
    found = run(program, plane(at, normal))
    assert found.ok, found.alarms
    same_touches(found, check["touches"])
    assert ends(found) == pytest.approx(points(check["moves"]), abs=CLOSE)
    same_results(found, check["results"])
    assert [found.variables[q] for q in ("Q961", "Q962", "Q963")] == pytest.approx([0.8, -0.5, 0], abs=1e-9)
    row = found.tables.presets[1]
    assert (row.tilt_x, row.tilt_y, row.rotation) == pytest.approx((0.8, -0.5, 0), abs=1e-9)
    mean = run(program.replace("Q1120=+1 Q1121=+1", "Q1120=+4 Q1121=+0"), plane(at, normal)).tables.presets[1]
    expected = np.add(PRESET, np.subtract(check["mean_point"], (110 / 3, 70 / 3, 0)))
    assert mean[:3] == pytest.approx(expected, abs=1e-4)


def test_1420_the_blocks_that_follow_lie_on_the_plane_and_the_axes_align():
    """Z of the program is square to the plane; point 1 has its nominal coordinates; the tool lies along that Z."""
    program, _ = example("TCH PROBE 1420", 1)
    a, b = math.radians(0.8), math.radians(-0.5)
    up = np.array((math.cos(a) * math.sin(b), -math.sin(a), math.cos(a) * math.cos(b)))
    part = plane(np.add(PRESET, (0, 0, 0.1)), up)
    after = "\nL X+10 Y+10 Z+0 R0 FMAX\nL Z+60 FMAX"
    found = run(program.replace("Q1126=+0", "Q1126=+1") + after, part)
    first, second = found.toolpath.end[-2], found.toolpath.end[-1]
    assert first == pytest.approx((10, 10, found.variables["Q952"]), abs=1e-9)
    assert (second - first) / 60 == pytest.approx(up, abs=1e-9)
    turn_a, _, turn_c = found.toolpath.rotary[-1]
    tool = frames.turn(turn_c) @ frames.turn(turn_a, "x") @ (0, 0, 1, 0)
    assert tool[:3] == pytest.approx(up, abs=1e-9)


def test_in_a_tilted_plane():
    """PLANE SPATIAL SPA+30: an edge that lies under 2 degrees in that plane is found there, and turned back in space."""
    tilt = frames.turn(math.radians(30), "x")
    from mnclab.workpiece.part import box

    part = box((0, 0, -40), (100, 60, 0)).placed(frames.shift(*PRESET) @ tilt @ frames.turn(math.radians(2)))
    before = "L Z+100 R0 FMAX\nPLANE SPATIAL SPA+30 SPB+0 SPC+0 STAY\nL X+50 Y-60 Z+60 FMAX"
    found = run(cycle(1410, EDGE) + "\nL X+50 Y+0 Z+0 FMAX", part, before)
    assert found.ok, found.alarms
    assert found.variables["Q964"] == pytest.approx(2, abs=1e-9)
    turned = tilt @ frames.turn(math.radians(2))
    first = (tilt @ (10, found.variables["Q951"], -5, 1))[:3]
    expected = first + (turned @ (40, 0, 5, 0))[:3]
    assert found.toolpath.end[-1] == pytest.approx(expected, abs=1e-9)
    row = found.tables.presets[1]
    now = frames.turn(math.radians(row.rotation)) @ frames.turn(math.radians(row.tilt_y), "y")
    assert now @ frames.turn(math.radians(row.tilt_x), "x") @ tilt == pytest.approx(turned, abs=1e-9)


# --- texts ----------------------------------------------------------------------------------------------------------------


def test_the_texts_of_the_manual():
    values = {"Q1900": -10.05}
    for program, check in (example("14xx text parameters", 1), example("14xx semi-automatic mode", 0)):
        for name, expected in check.items():
            text = next(line.split('"')[1] for line in program.splitlines() if line.startswith(name))
            found = read(text, values, 1.0)
            assert found.value == expected["nominal"] and found.asked == expected.get("semi_automatic", False)
            for key in ("lower", "upper"):
                assert key not in expected or getattr(found, key) == pytest.approx(expected[key], abs=1e-12)
            if "mean" in expected:
                assert found.mean == pytest.approx(expected["mean"], abs=1e-12)
                actual = values.get(expected["actual"], expected["actual"])
                assert found.actual == pytest.approx(actual, abs=1e-12)
                assert actual - found.mean == pytest.approx(expected.get("deviation", 0.04), abs=1e-12)


def test_a_tolerance_of_diameters_as_printed():
    """1411 with a number under QS1105, commas and points: limits 8 to 8.5, the nominal line under 18.43495 degrees."""
    program, check = example("14xx text parameters", 0)
    more = "Q1115=0\nQ423=4\nQ325=0\nQ1119=360\nQ320=0\nQ260=20\nQ1125=1\nQ1126=0\nQ1120=0\nQ1121=0\n"
    printed = program.replace("... ;\n", "").replace("... ;", "").replace("Q1105=-5", "QS1105=-5") + "\n" + more
    found = run(printed, bored((50, 50, 8.3), (80, 60, 8.25)))
    assert found.ok, found.alarms
    rows = {row.what: row for row in found.measurements}
    size = rows["diameter 1"]
    assert (size.lower, size.upper, size.nominal) == pytest.approx((check["lower"], check["upper"], check["mean"]))
    assert found.variables["Q996"] == pytest.approx(check["deviation_for_measured_8_3"], abs=1e-9)
    assert found.variables["Q964"] == pytest.approx(check["nominal_angle"], abs=1e-5) and found.variables["Q183"] == 0


def test_actual_positions_are_not_touched():
    """Two points by @, one from Q1900: nothing moves, the angle is that of the given points; outside a tolerance is scrap."""
    texts = {
        "QS1100": '"10+0.02@10.0123"', "QS1101": '"50@50.0321"', "QS1102": '"-10-0.2+0.02@Q1900"', "QS1103": '"90@90"',
        "QS1104": '"50@51"', "QS1105": '"-10@-10"',
    }  # fmt: skip
    values = texts | {key: value for key, value in EDGE.items() if not key.startswith("Q110")}
    found = run("Q1900 = -10.05\n" + cycle(1410, values), None)
    assert found.ok and not found.touches, found.alarms
    expected = {"Q980": 0.0023, "Q981": 0.0321, "Q982": 0.04, "Q984": 1, "Q183": 0}
    assert {q: found.variables[q] for q in expected} == pytest.approx(expected, abs=1e-9)
    angle = math.degrees(math.atan2(51 - 50.0321, 90 - 10.0123))
    assert found.variables["Q964"] == pytest.approx(angle, abs=1e-9)
    scrap = run("Q1900 = -10.3\n" + cycle(1410, values | {"Q309": 2}), None)
    assert scrap.variables["Q183"] == 2 and "scrap: point 1 Z is -10.3000, allowed -10.2000 to -9.9800" in scrap.alarms[0].message


def test_the_operator_puts_the_probe_where_a_question_is():
    """The left edge, 10 by its drawing: only X has nominal values, so only X corrects the preset (contacts as with 400)."""
    texts = {"QS1100": '"?10"', "QS1101": '"?"', "QS1102": '"?"', "QS1103": '"?10"', "QS1104": '"?"', "QS1105": '"?"'}
    values = texts | {key: value for key, value in EDGE.items() if not key.startswith("Q110")} | {"Q372": 1, "Q1121": 0}
    hands = {1: (-5, 10, -6), 2: (-4.5, 50, -6)}
    found = run(cycle(1410, values), plate(), settings={"manual_points": hands})
    assert [t.start for t in found.touches] == [pytest.approx(np.add(PRESET, hands[k]), abs=1e-9) for k in (1, 2)]
    contacts = example("TCH PROBE 400", 2)[1]["touches"]
    first, second = (contact["measured"][0] for contact in contacts)
    results = {"Q950": first, "Q951": 10, "Q952": -6, "Q953": second, "Q980": first - 10, "Q981": 0, "Q982": 0, "Q984": 0}
    same_results(found, results | {"Q964": 91.5, "Q994": 1.5})
    assert found.tables.presets[1] == pytest.approx((100 + first - 10, 200, -300, 0, 0, 0, 0, 0, 0), abs=CLOSE)
    assert ends(found)[-1] == pytest.approx((-4.5, 50, -8))  # no way back to the clearance height: the program sees to that
    refused = run(cycle(1410, values), plate())
    assert "asks for a position (?): the setting manual_points says it, {1: (x, y, z)}" in refused.alarms[0].message


@pytest.mark.parametrize("sense", [1, -1])
def test_material_that_is_left_is_rework_and_what_is_missing_is_scrap(sense):
    """A wall along X, touched along +Y or -Y, 0.05 this side or that of a band of 0.02."""
    for shift, status in ((-0.05 * sense, 1), (0.005, 0), (0.05 * sense, 2)):
        part = plane(np.add(PRESET, (0, shift, 0)), (0, -sense, 0))
        texts = {"QS1101": '"0+0.02-0.02"', "QS1104": '"0+0.02-0.02"'}
        rest = {key: value for key, value in EDGE.items() if key not in ("Q1101", "Q1104")}
        start = (100, 200 - 30 * sense, -150)
        found = run(cycle(1410, rest | texts | {"Q372": 2 * sense}), part, start=start)
        assert found.variables["Q183"] == status, (shift, found.alarms)


def test_an_inch_program_has_its_texts_and_results_in_inches():
    """10 mm in X with a tolerance of 0.01 inch: nominal values, limits and results count in inches, angles in degrees."""
    from controls.tnc_620.alignment import setup

    import mnclab

    lengths = ("Q1103", "Q1105", "Q260", "Q320")
    values = {name: value / 25.4 if name in lengths else value for name, value in EDGE.items()} | {"Q1120": 0, "Q1121": 0}
    texts = {"Q1100": ("QS1100", f'"{10 / 25.4:.12f}+0.01"'), "Q1102": ("QS1102", f'"{-5 / 25.4:.12f}"')}
    named = dict(texts.get(name, (name, value)) for name, value in values.items())
    text = f"BEGIN PGM P INCH\nTOOL CALL 7 Z\nL Z+4 R0 FMAX\n{cycle(1410, named)}\nEND PGM P INCH\n"
    found = mnclab.run(text, "tnc-620", setup(plate()))
    check = example("TCH PROBE 1410", 1)[1]["results"]
    assert found.variables["Q951"] * 25.4 == pytest.approx(check["Q951"], abs=1e-4), found.alarms
    assert found.variables["Q980"] == pytest.approx(-0.005, abs=1e-9)  # the middle of the band is 0.005 inch farther
    assert found.variables["Q964"] == pytest.approx(1.5, abs=1e-9)


def test_the_status_of_places():
    """Toleranced centers: outside is scrap; a coordinate that a touch along Y does not measure is not judged."""
    values = {
        "QS1100": '"10+0.1-0.1"', "Q1101": 0, "Q1102": -5, "Q1116": 10, "Q1103": 40, "Q1104": 0, "Q1105": -5, "Q1117": 10,
        "Q1115": 0, "Q423": 4, "Q325": 0, "Q1119": 360, "Q320": 0, "Q260": 20, "Q1125": 1, "Q309": 1, "Q1126": 0, "Q1120": 0,
        "Q1121": 0,
    }  # fmt: skip
    for x, status in ((10.05, 0), (10.2, 2), (9.8, 2)):
        found = run(cycle(1411, values), bored((x, 0, 10), (40, 0, 10)))
        assert found.variables["Q183"] == status and found.ok == (status == 0), found.alarms
        assert {row.what: row.verdict for row in found.measurements}["point 1 X"] == ("ok", "", "scrap")[status]
    rest = {key: value for key, value in EDGE.items() if key != "Q1100"}
    found = run(cycle(1410, rest | {"QS1100": '"10+9+8"', "Q1120": 0, "Q1121": 0}), plate())
    assert found.variables["Q183"] == -1


def test_given_and_touched_places_in_one_cycle():
    """Point 1 by @ and point 2 touched: it goes there over the clearance height, and back up."""
    texts = {"QS1100": '"10@10"', "QS1101": '"0@0"', "QS1102": '"-5@-5"'}
    rest = {key: value for key, value in EDGE.items() if key not in ("Q1100", "Q1101", "Q1102")}
    found = run(cycle(1410, texts | rest | {"Q1125": 0}), plate())
    assert len(found.touches) == 1 and found.ok, found.alarms
    edge = example("TCH PROBE 1410", 1)[1]["results"]["Q954"]
    assert found.variables["Q964"] == pytest.approx(math.degrees(math.atan2(edge, 80)), abs=1e-4)
    ways = ["X90 Y-4", "Z-7", "Y0.0456", "Y-4", "Z100"]
    assert ends(found) == pytest.approx(points(ways), abs=CLOSE)


def test_a_hole_that_is_too_small_for_the_clearance():
    """Diameter 7, ball 4 and SET_UP 2: the touches begin in its center, 3.5 - 2 = 1.5 from the wall."""
    values = {
        "Q1100": 10, "Q1101": 0, "Q1102": -5, "Q1116": 7, "Q1103": 40, "Q1104": 0, "Q1105": -5, "Q1117": 20, "Q1115": 0,
        "Q423": 4, "Q325": 0, "Q1119": 360, "Q320": 0, "Q260": 20, "Q1125": 1, "Q309": 0, "Q1126": 0, "Q1120": 0, "Q1121": 0,
    }  # fmt: skip
    found = run(cycle(1411, values), bored((10.2, 0.1, 7.04), (40, 0, 20)))
    (warning,) = found.alarms
    assert "begins in the center of hole 1: a clearance of 1.5 is possible, not 2" in warning.message
    assert found.variables["Q966"] == pytest.approx(7.04, abs=1e-9)


def test_1411_where_the_operator_chooses_the_center_of_a_hole():
    """A question in X: the touches lie about the place by hand, and X as it is found becomes nominal."""
    values = {
        "QS1100": '"?"', "Q1101": 0, "Q1102": -5, "Q1116": 20, "Q1103": 60, "Q1104": 0, "Q1105": -5, "Q1117": 20, "Q1115": 0,
        "Q423": 3, "Q325": 0, "Q1119": 360, "Q320": 0, "Q260": 20, "Q1125": 1, "Q309": 0, "Q1126": 0, "Q1120": 1, "Q1121": 0,
    }  # fmt: skip
    found = run(cycle(1411, values), bored((13, 0.5, 20), (60, 0, 20)), settings={"manual_points": {"1": [12.8, 0.4, -6]}})
    assert found.ok, found.alarms
    results = {"Q950": 13, "Q951": 0.5, "Q952": -6, "Q980": 0, "Q981": 0.5, "Q982": -1}
    assert {q: found.variables[q] for q in results} == pytest.approx(results, abs=1e-9)
    assert found.tables.presets[1][:3] == pytest.approx((100, 200.5, -301), abs=1e-9)
    assert found.touches[0].start == pytest.approx((112.8 + 10 - 4, 200.4, -306), abs=1e-9)
