"""Cycles 400 to 405 against parts with known misalignments: every example and check of the catalogue (TNC 620, chapter 14)."""

import json
import math
from pathlib import Path

import numpy as np
import pytest
from controls.tnc_620.alignment import PRESET, bored, cycle, ends, plate, points, run, studs

from mnclab import Kind

FILE = Path(__file__).parents[2] / "authorities" / "catalogue" / "tnc620-probing-alignment.json"
EXAMPLES = json.loads(FILE.read_text(encoding="utf-8"))
CLOSE = 5e-4  # the checks are rounded to four or five places
HOLES = ((10.02, -4.97, 30.04), (10.02 + 80 * math.cos(math.radians(1.5)), -4.97 + 80 * math.sin(math.radians(1.5)), 29.98))


def example(code, number):
    found = [e for e in EXAMPLES if e["code"] == f"TCH PROBE {code}"][number]
    return found["program"], found["check"]


def touches(check):
    return [one for name in ("touches", "touches_1", "touches_2") for one in check.get(name, [])]


def same_touches(found, check):
    expected = touches(check)
    assert len(found.touches) == len(expected)
    for touch, one in zip(found.touches, expected, strict=True):
        assert touch.programmed == pytest.approx(one["ball_center"], abs=CLOSE)
        assert np.linalg.norm(np.subtract(touch.centre, touch.start)) == pytest.approx(one["travel"], abs=CLOSE)
        assert touch.direction == pytest.approx(one["direction"], abs=1e-12)


def same_moves(found, moves, rows=None):
    assert ends(found)[:rows] == pytest.approx(points(moves), abs=CLOSE)
    arcs = [Kind(kind) for kind in found.toolpath.motion.kind[1:][:rows]]
    assert [kind == Kind.ARC for kind in arcs] == [move.startswith("arc") for move in moves]
    assert [kind == Kind.PROBE for kind in arcs] == [move.startswith("probe") for move in moves]


EDGE = {
    "Q263": 10, "Q264": 0, "Q265": 90, "Q266": 0, "Q272": 2, "Q267": 1, "Q261": -5, "Q320": 0, "Q260": 20, "Q301": 0, "Q307": 0,
    "Q305": 3,
}  # fmt: skip


def basic_rotation(part, before="L Z+100 R0 FMAX", after="", **changes):
    return run(cycle(400, EDGE | changes) + after, part, before)


def test_400_an_edge_turned_by_one_and_a_half_degrees():
    program, check = example(400, 1)
    found = run(program, plate())
    assert found.ok, found.alarms
    same_touches(found, check)
    same_moves(found, check["moves"])
    assert found.tables.presets[3].rotation == pytest.approx(1.5, abs=1e-9)
    assert found.measured["rotation"] == pytest.approx(1.5, abs=1e-9)
    again = basic_rotation(plate(), before="L Z+5 R0 FMAX", Q301=1)
    assert ends(again) == pytest.approx(points(check["moves_with_Q301_1_and_south_pole_at_Z5_before"]), abs=CLOSE)
    assert basic_rotation(plate(), Q307=1).tables.presets[3].rotation == pytest.approx(0.5, abs=1e-9)


def test_400_as_the_manual_prints_it():
    """An edge exactly through the two programmed points; the ball meets it square to the edge, the angle is exact."""
    program, check = example(400, 0)
    phi = math.degrees(math.atan2(2 - 3.5, 25 - 10))
    found = run(program, plate(10 - 40 * math.cos(math.radians(phi)), 3.5 - 40 * math.sin(math.radians(phi)), phi))
    assert phi == pytest.approx(check["rotation"], abs=1e-5)
    assert found.tables.presets[1] == pytest.approx((*PRESET, 0, 0, 0, phi, 0, 0), abs=1e-9)


def test_400_a_left_edge_against_the_minor_axis():
    check = example(400, 2)[1]
    found = basic_rotation(plate(), Q263=0, Q264=10, Q265=0, Q266=50, Q272=1, Q307=90)
    same_touches(found, check)
    assert found.tables.presets[3].rotation == pytest.approx(1.5, abs=1e-9)


def test_400_turns_the_blocks_that_follow_and_resets_what_was_active():
    """Row 1 with 7 degrees: reset before the touches, then 1.5; X80 Y0 of the turned system lies along the edge."""
    from mnclab import Datum

    after = "\nL X+80 Y+0 Z+50 R0 FMAX"
    found = run(cycle(400, EDGE | {"Q305": 0}) + after, plate(), presets={1: Datum(*PRESET, rotation=7)})
    assert found.tables.presets[1].rotation == pytest.approx(1.5, abs=1e-9)
    turned = math.radians(1.5)
    assert found.toolpath.end[-1] == pytest.approx((80 * math.cos(turned), 80 * math.sin(turned), 50), abs=1e-9)


def test_401_two_bores():
    program, check = example(401, 2)
    found = run(program, bored(*HOLES), reach=check["DIST"])
    assert found.ok, found.alarms
    same_touches(found, check)
    same_moves(found, check["moves"])
    assert found.tables.presets[3].rotation == pytest.approx(1.5, abs=1e-7)
    for which, (x, y, _) in enumerate(HOLES, 1):
        assert (found.measured[f"center {which} X"], found.measured[f"center {which} Y"]) == pytest.approx((x, y), abs=1e-9)
    turned = program.replace("Q402=0 Q337=0", "Q402=1 Q337=1")
    found = run(turned + "\nCYCL DEF 247 PRESET\nQ339=+3\nFN 18: SYSREAD Q5 = ID270 NR1 IDX6", bored(*HOLES), reach=20)
    expected = check["with_Q402_1_Q337_1_Q305_3"]
    assert found.tables.presets[3] == pytest.approx((0, 0, 0, 0, 0, expected["C_OFFS"], 0, 0, 0), abs=1e-7)
    assert np.degrees(found.toolpath.rotary[-1]) == pytest.approx((0, 0, expected["C_turned_by"]), abs=1e-7)
    assert found.variables["Q5"] == pytest.approx(expected["C_display"], abs=1e-9)  # once row 3 is active


@pytest.mark.parametrize(("code", "number"), [(401, 0), (402, 0)])
def test_401_and_402_as_printed(code, number):
    """Row 0 is a copy of the active one, with the rotation, and active."""
    program, check = example(code, number)
    (x, y), (x2, y2) = check["centers"]
    part = bored((x, y, 10), (x2, y2, 12)) if code == 401 else studs((x, y, 59.9), (x2, y2, 59.8))
    found = run(program + "\nL X+10 Y+0 R0 FMAX", part)
    rotation = math.degrees(math.atan2(y2 - y, x2 - x))
    assert rotation == pytest.approx(check["rotation"], abs=1e-5)
    assert found.tables.presets[0] == pytest.approx((*PRESET, 0, 0, 0, rotation, 0, 0), abs=1e-7)
    assert found.tables.presets[1].rotation == 0
    turned = math.radians(rotation)
    assert found.toolpath.end[-1] == pytest.approx((10 * math.cos(turned), 10 * math.sin(turned), 20), abs=1e-7)


def test_the_program_of_the_manual_runs_and_calls_another():
    """14.13: row 0 with C_OFFS, C shows 0 where it stands; then the program 35K47 goes on."""
    from controls.tnc_620.alignment import setup

    import mnclab

    program, check = example(401, 1)
    (x, y), (x2, y2) = check["centers"]
    called = "BEGIN PGM 35K47 MM\nFN 18: SYSREAD Q5 = ID270 NR1 IDX6\nL X+0 Y+0 C+0 FMAX\nEND PGM 35K47 MM\n"
    part = bored((x, y, 14), (x2, y2, 14))
    found = mnclab.run(program, "tnc-620", setup(part, files={"35K47.H": called}))
    assert not [a for a in found.alarms if a.severity == "alarm"]
    delta = math.degrees(math.atan2(20, 55))
    assert delta == pytest.approx(check["delta"], abs=1e-5)
    assert found.tables.presets[0] == pytest.approx((*PRESET, 0, 0, delta, 0, 0, 0), abs=1e-7)
    assert found.variables["Q5"] == pytest.approx(check["C_display"], abs=1e-9)
    assert np.degrees(found.toolpath.rotary[-1][2]) == pytest.approx(delta, abs=1e-7)  # C+0 is where it stands


def test_402_two_studs():
    program, check = example(402, 1)
    found = run(program, studs(*HOLES))
    assert found.ok, found.alarms
    same_touches(found, check)
    same_moves(found, check["moves"])
    assert found.tables.presets[3].rotation == pytest.approx(1.5, abs=1e-7)


TABLE = {key: value for key, value in EDGE.items() if key not in ("Q307", "Q305")} | {
    "Q312": 0, "Q337": 1, "Q305": 3, "Q303": 1, "Q380": 0
}  # fmt: skip


def rotary_axis(part, after="", settings=None, **changes):
    return run(cycle(403, TABLE | changes) + after, part, settings=settings)


def angle_c(found):
    return math.degrees(found.toolpath.rotary[-1][2])


def test_403_an_edge():
    program, check = example(403, 1)
    found = run(program, plate())
    same_touches(found, check)
    assert angle_c(found) == pytest.approx(check["C_turned_by"], abs=1e-9)
    assert found.tables.presets[3].c == pytest.approx(1.5, abs=1e-9)
    assert [a.severity for a in found.alarms] == ["warning"] and "turns C by 1.5000 degrees" in found.alarms[0].message
    exchanged = {"Q263": 90, "Q265": 10}
    assert angle_c(rotary_axis(plate(), **exchanged)) == pytest.approx(check["points_exchanged"]["Q312_0"], abs=1e-9)
    assert angle_c(rotary_axis(plate(), Q312=6, **exchanged)) == pytest.approx(check["points_exchanged"]["Q312_6"], abs=1e-9)


def test_403_as_printed():
    """Touched along -X, material on the side of -X of the line through (0, 0) and (20, 30)."""
    from controls.tnc_620.alignment import placed

    from mnclab.workpiece.part import plane

    program, check = example(403, 0)
    part = placed(plane((0, 0, 0), (30 / math.hypot(20, 30), -20 / math.hypot(20, 30), 0)))
    beside = {"start": (160, 200, -150)}
    found = run(program, part, **beside)
    assert angle_c(found) == pytest.approx(check["delta"], abs=1e-5)
    assert angle_c(found) == pytest.approx(math.degrees(math.atan2(30, 20)) - 90, abs=1e-9)
    assert found.tables.presets == {1: (*PRESET, 0, 0, 0, 0, 0, 0)}
    swapped = program.replace("Q263=+0", "Q263=+20").replace("Q264=+0", "Q264=+30").replace("Q265=+20", "Q265=+0")
    found = run(swapped.replace("Q266=+30", "Q266=+0"), part, **beside)
    assert angle_c(found) == pytest.approx(check["delta_with_points_exchanged"], abs=1e-5)


def test_403_where_the_angle_is_written():
    """Q312=6 writes the active row; Q303=0 the column C of the datum table; Q337=0 nothing. C shows 0 in the active row."""
    show = "\nFN 18: SYSREAD Q5 = ID270 NR1 IDX6"
    found = rotary_axis(plate(), show, Q312=6)
    assert found.tables.presets[1].c == pytest.approx(1.5, abs=1e-9) and 3 not in found.tables.presets
    assert found.variables["Q5"] == pytest.approx(0, abs=1e-12) and angle_c(found) == pytest.approx(1.5, abs=1e-9)
    found = rotary_axis(plate(), show, Q303=0)
    assert found.tables.datums[3].c == pytest.approx(1.5, abs=1e-9) and found.variables["Q5"] == pytest.approx(1.5, abs=1e-9)
    found = rotary_axis(plate(), show, Q337=0)
    assert found.tables.presets == {1: (*PRESET, 0, 0, 0, 0, 0, 0)} and found.variables["Q5"] == pytest.approx(1.5, abs=1e-9)


@pytest.mark.parametrize(("axis", "number", "pair"), [("x", 4, "CA"), ("y", 5, "CB"), ("x", 0, "CA"), ("y", 0, "AB")])
def test_403_downwards_finds_a_and_b(axis, number, pair):
    """A plane turned by 2 degrees about X (or Y) through Z0: touches apart in Y (or X) show it."""
    from mnclab.geometry import frames
    from mnclab.workpiece.part import plane

    part = plane((0, 0, 0), (0, 0, 1)).placed(frames.shift(*PRESET) @ frames.turn(math.radians(2), axis))
    second = {"Q263": 5, "Q264": 5, "Q265": 5, "Q266": 45} if axis == "x" else {"Q263": 5, "Q264": 5, "Q265": 45, "Q266": 5}
    found = rotary_axis(part, settings={"rotary_axes": pair}, Q272=3, Q267=-1, Q261=0, Q312=number, Q337=1, **second)
    row = found.tables.presets[1 if number else 3]
    turned = np.degrees(found.toolpath.rotary[-1])
    assert turned == pytest.approx((2, 0, 0) if axis == "x" else (0, 2, 0), abs=1e-9)
    assert (row.a, row.b) == pytest.approx((2, 0) if axis == "x" else (0, 2), abs=1e-9)


def test_404_sets_and_resets():
    from mnclab import Datum

    found = run(example(404, 0)[0], presets={1: Datum(*PRESET, rotation=4)})
    assert found.ok and found.tables.presets[1] == (*PRESET, 0, 0, 0, 0, 0, 0)
    found = run(cycle(404, {"Q307": 1.5, "Q305": 0}) + "\nL X+10 Y+0 Z+0 R0 FMAX")
    assert found.tables.presets[0] == (*PRESET, 0, 0, 0, 1.5, 0, 0) and found.tables.presets[1].rotation == 0
    turned = math.radians(1.5)
    assert found.toolpath.end[-1] == pytest.approx((10 * math.cos(turned), 10 * math.sin(turned), 0), abs=1e-9)
    found = run(cycle(404, {"Q307": 1.5, "Q305": 4}) + "\nL X+10 Y+0 Z+0 R0 FMAX", presets={1: PRESET, 4: (1, 2, 3)})
    assert found.tables.presets[4] == (1, 2, 3, 0, 0, 0, 1.5, 0, 0) and found.toolpath.end[-1][0] == 10
    found = run(cycle(404, {"Q307": 1.5, "Q305": 1}) + "\nL X+10 Y+0 Z+0 R0 FMAX")
    assert found.toolpath.end[-1][0] == pytest.approx(10 * math.cos(turned), abs=1e-9)


def test_405_as_printed():
    program, check = example(405, 0)
    found = run(program + "\nFN 18: SYSREAD Q5 = ID270 NR1 IDX6", bored((49.5, 50.6, 10.02)))
    same_touches(found, check)
    same_moves(found, check["moves"], -1)  # the last row is the turn of the table
    turned = math.degrees(math.atan2(50.6, 49.5)) - 45
    assert found.variables["Q150"] == pytest.approx(turned, abs=1e-7) and turned == pytest.approx(check["Q150"], abs=1e-4)
    assert angle_c(found) == pytest.approx(turned, abs=1e-7)
    assert found.tables.presets[1].c == pytest.approx(turned, abs=1e-7)
    assert found.variables["Q5"] == pytest.approx(check["C_display"], abs=1e-9)


def test_405_a_hole_near_the_y_axis():
    check = example(405, 1)[1]
    values = {
        "Q321": 0, "Q322": 50, "Q262": 10, "Q325": 0, "Q247": 90, "Q261": -5, "Q320": 0, "Q260": 20, "Q301": 0, "Q337": 2,
    }  # fmt: skip
    found = run(cycle(405, values), bored((0.8, 50.1, 10.02)), datums={2: (0, 0, 0, 0, 0, 0.25)})
    same_touches(found, check)
    turned = math.degrees(math.atan2(50.1, 0.8)) - 90
    assert found.variables["Q150"] == pytest.approx(turned, abs=1e-7) and turned == pytest.approx(check["Q150"], abs=1e-5)
    assert found.tables.datums[2].c == pytest.approx(0.25 + turned, abs=1e-7) and found.tables.presets[1].c == 0


def test_a_row_that_was_measured_turns_the_program_once_it_is_active():
    """SPC of row 3 counts from the next cycle 247 on; the origin of that row is the machine's."""
    found = basic_rotation(plate(), after="\nCYCL DEF 247 PRESET\nQ339=+3\nL X+80 Y+0 Z+50 R0 FMAX")
    turned = math.radians(1.5)
    there = np.array((80 * math.cos(turned), 80 * math.sin(turned), 50)) - PRESET
    assert found.toolpath.end[-1] == pytest.approx(there, abs=1e-9)


def test_din_iso_and_inch():
    """G400 is cycle 400; an inch program says its places in inches."""
    from controls.tnc_620.alignment import setup

    import mnclab

    values = " ".join(f"Q{q}={v}" for q, v in zip(
        (263, 264, 265, 266, 272, 267, 261, 320, 260, 301, 307, 305), (10, 0, 90, 0, 2, 1, -5, 0, 20, 0, 0, 1), strict=True
    ))  # fmt: skip
    text = f"%P G71 *\nN10 T7 G17 *\nN20 G00 G90 G40 Z+100 *\nN30 G400 {values} *\nN99999999 %P G71 *\n"
    found = mnclab.run(text, "tnc-620", setup(plate()))
    assert found.ok and found.tables.presets[1].rotation == pytest.approx(1.5, abs=1e-9), found.alarms
    lengths = ("Q263", "Q264", "Q265", "Q266", "Q261", "Q320", "Q260")
    inches = EDGE | {q: EDGE[q] / 25.4 for q in lengths}
    text = f"BEGIN PGM P INCH\nTOOL CALL 7 Z\nL Z+4 R0 FMAX\n{cycle(400, inches)}\nEND PGM P INCH\n"
    found = mnclab.run(text, "tnc-620", setup(plate()))
    assert found.tables.presets[3].rotation == pytest.approx(1.5, abs=1e-9), found.alarms
