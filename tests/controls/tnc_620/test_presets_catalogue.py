"""Presets (TNC 620, chapter 15): the examples of the manual against parts, with the numbers of the catalogue.

They are rounded there: touches to 5 decimals, moves to 4.
"""

import re

import numpy as np
import pytest
from controls.tnc_620.presetting import BALL, CASES, PRESET, example, part_of, probing
from tools.probed import gaps

from mnclab import Kind

ROUNDED, SHOWN = 1e-5, 1e-4  # of touches and results; of moves


def moves(run, first=1):
    """The rows after the positioning in front of the cycle: kind and end."""
    rows = run.toolpath.motion[first:]
    return [(Kind(kind).name, *end) for kind, end in zip(rows.kind, rows.end.tolist())]


def told(listed, place):
    """The moves of the catalogue in the same form; a coordinate that is not named stays."""
    found, place = [], list(place)
    for line in listed:
        for axis, value in re.findall(r"([XYZ])(-?[\d.]+)", line):
            place["XYZ".index(axis)] = float(value)
        found.append(("PROBE" if line.startswith("probe") else "ARC" if line.startswith("arc") else "RAPID", *place))
    return found


@pytest.mark.parametrize("case", CASES, ids=lambda case: f"{case['code']} {case['title'][:12]}")
def test_an_example(case):
    """Touches, moves, results and rows; the block after it, X0 Y0, stands at the datum that is active then."""
    check, part, program = case["check"], part_of(case), case["code"].startswith("example")
    text = example(case) if program else example(case) + "\n9 L X+0 Y+0 R0 FMAX\n"
    run = probing(text, part, 4 if case["code"] == "example 15.15" else 1)
    assert run.ok, run.alarms
    assert gaps(run, part.shifted(*PRESET), BALL)[1:].min() >= -1e-6  # the first row brings the probe there
    touches = [*([check["touch_417"]] if "touch_417" in check else []), *check.get("touches", check.get("touches_hole_1", []))]
    above = [check["touch_ts_axis"]] if "touch_ts_axis" in check else []
    for found, expected in [*zip(run.touches, touches), *zip(run.touches[len(run.touches) - len(above) :], above)]:
        assert np.subtract(found.start, PRESET) == pytest.approx(expected["start"], abs=ROUNDED)
        assert np.subtract(found.centre, PRESET) == pytest.approx(expected["ball_center"], abs=ROUNDED)
        assert found.direction == pytest.approx(expected["direction"], abs=ROUNDED)
        assert np.linalg.norm(np.subtract(found.centre, found.start)) == pytest.approx(expected["travel"], abs=ROUNDED)
    if "starts" in check:
        starts = np.subtract([each.start for each in run.touches[:2]], PRESET)
        assert starts == pytest.approx(np.array(check["starts"]), abs=ROUNDED)
    listed = [*check.get("moves_417", []), *check.get("moves_416_south_pole_at_Z50_before", []), *check.get("moves", [])]
    if listed:
        made = moves(run)
        for (kind, *end), (expected, *place) in zip(made, told(listed, (0, 0, 100))):
            assert kind == expected and end == pytest.approx(place, abs=SHOWN)
        assert len(made) == len(listed) + 1
    for name, value in check.get("results", {}).items():
        assert run.variables[name] == pytest.approx(value, abs=ROUNDED)
    rows = {int(key[11:]): row for key, row in check.items() if key.startswith("preset_row_")}
    for number, row in rows.items():
        found = run.tables.presets[number]
        before = PRESET if number == 0 else (0, 0, 0)  # a copy of the active one, or an empty one
        for k, axis in enumerate("XYZ"):
            assert getattr(found, axis.lower()) == pytest.approx(row.get(axis, before[k]), abs=ROUNDED)
    active = check.get("active_row", check.get("active_row_after_247", 1))
    origin = (rows[active]["X"], rows[active]["Y"]) if active in rows else PRESET[:2]
    assert run.toolpath.end[-1][:2] == pytest.approx(np.subtract(origin, PRESET[:2]), abs=ROUNDED)


DATUMS = [case for case in CASES if "datum_table_row_10_with_Q303_0" in case["check"]]


@pytest.mark.parametrize("case", DATUMS, ids=lambda case: case["code"])
def test_the_datum_table(case):
    """The shift from the active preset; it counts after cycle 7 alone."""
    text = example(case, Q303=0) + "\n9 L X+0 Y+0 R0 FMAX\n10 CYCL DEF 7.0 D\n11 CYCL DEF 7.1 #10\n12 L X+0 Y+0 R0 FMAX\n"
    run = probing(text, part_of(case))
    assert run.ok, run.alarms
    row = case["check"]["datum_table_row_10_with_Q303_0"]
    for k, axis in enumerate("XYZ"):
        assert run.tables.datums[10][k] == pytest.approx(row.get(axis, 0), abs=ROUNDED)
    assert run.toolpath.end[-2][:2] == pytest.approx((0, 0), abs=1e-9)
    assert run.toolpath.end[-1][:2] == pytest.approx((row["X"], 0), abs=ROUNDED)


@pytest.mark.parametrize("case", [case for case in CASES if "with_Q304_1" in case["check"]], ids=lambda case: case["code"])
def test_the_basic_rotation_of_a_corner(case):
    """Of an empty row: its angle is that of the first line; of the display: the axes lie along the edges of the part."""
    expected = case["check"]["with_Q304_1"]
    run = probing(example(case, Q304=1), part_of(case))
    assert run.ok, run.alarms
    row = run.tables.presets[7]
    assert row.rotation == pytest.approx(expected["SPC"], abs=1e-9)
    for axis in {"X", "Y"} & expected.keys():
        assert getattr(row, axis.lower()) == pytest.approx(expected[axis], abs=ROUNDED)
    run = probing(example(case, Q304=1, Q305=0) + "\n9 L X+0 Y+0 R0 FMAX\n10 L X+10 FMAX\n", part_of(case))
    assert run.ok, run.alarms
    corner = (case["check"]["results"]["Q151"], case["check"]["results"]["Q152"])
    along = 10 * np.cos(np.radians(1.5)), 10 * np.sin(np.radians(1.5))
    assert run.toolpath.end[-2][:2] == pytest.approx(corner, abs=ROUNDED)
    assert run.toolpath.end[-1][:2] - run.toolpath.end[-2][:2] == pytest.approx(along, abs=1e-9)


def test_the_touch_above_of_what_has_a_top_there():
    """Examples whose point (85, 50) lies on the part touch it first above: south pole at 0.03, Q333 = 1."""
    for case in CASES:
        if "touch_ts_axis" in case["check"] and not case["code"].startswith("example"):
            run = probing(example(case), part_of(case))
            new = 0 if case["code"] == "TCH PROBE 418" else 1
            number = next(int(key[11:]) for key in case["check"] if key.startswith("preset_row_"))
            assert run.tables.presets[number].z == pytest.approx(-300 + 0.03 - new, abs=1e-9)
            assert run.measured["Z"] == pytest.approx(0.03, abs=1e-9)
