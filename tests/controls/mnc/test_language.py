"""Chapters 2 to 8 of the manual: polar programming, feed, dwell, exact stop, tool length, corrector, power-on state.

The manual's examples are in test_catalogue.py, what must be refused in tests/refused; the numbers here are worked out
beside the program that they belong to.
"""

import json
import math
import re
from pathlib import Path

import numpy as np
import pytest
from tools.running import run

import mnclab
from mnclab import Kind, Tool

CATALOGUE = Path(__file__).parents[2] / "authorities" / "catalogue"


def obeyed(program, notices=(), **setup):
    found = run(program, ok=None, **setup)
    assert [alarm.message for alarm in found.alarms] == list(notices)
    return found


def moves(program, **setup):
    """Rows that move, in machine coordinates."""
    found = obeyed(program, **setup).toolpath
    return found.end[found.is_motion] + found.origin


def test_the_mirrored_example_without_its_mirror_is_the_programmed_contour():
    """2.9.2: all numbers of contour 1; contour 2 is compared with the other examples in test_catalogue.py."""
    examples = json.loads((CATALOGUE / "mnc-language.json").read_text(encoding="utf-8"))
    example = next(e for e in examples if e["code"] == "G51")
    path = obeyed(example["program"].replace("G51 X25", "")).toolpath
    for row, move in zip(path, example["check"]["programmed"], strict=True):
        assert row.kind == {"rapid": Kind.RAPID, "line": Kind.LINE, "arc": Kind.ARC}[move["move"]]
        assert row.end[:2].tolist() == pytest.approx(move.get("to", [move.get("x"), move.get("y")]), abs=1e-9)
        assert row.feed == move.get("feed", math.inf)
        if row.kind == Kind.ARC:
            assert row.centre[:2].tolist() == pytest.approx(move["centre"], abs=1e-9)
            assert math.degrees(row.sweep) == pytest.approx(move["sweep_deg"], abs=1e-9)
            assert math.dist(row.end[:2], row.centre[:2]) == pytest.approx(move["radius"], abs=1e-9)


def test_the_polar_points_to_the_last_digit():
    """R15 about (20, 20): the hexagon of 2.8.5, absolute and in increments."""
    angles = np.radians(range(180, -181, -60))
    corners = 20 + 15 * np.stack([np.cos(angles), np.sin(angles)], axis=1)
    absolute = "G16 X20 Y20\nG10 R15 A180\nG11 A120 F400\nA60\nA0\nA-60\nA-120\nA-180\n"
    increments = "G16 X20 Y20\nG10 R15 A180\nG91\nG11 A-60 F400\n" + "A-60\n" * 5
    for program in (absolute, increments):
        assert moves(program)[:, :2] == pytest.approx(corners, abs=1e-12)


def test_the_datum_function_ends_g92():
    """G147 Q2 and G55 choose one row, other rows have other offsets."""
    datums = {1: (1, 2, 3), 2: (10.5, -20, 30), 9: (7, 8, 9)}
    for code, notices in (("G55", []), ("G147 Q2", []), ("G247 Q2", ["G247 is another name of G147"])):
        found = obeyed(f"G54\nG92 X5 Y5 Z5\n{code}\nG0 X0 Y0 Z0\n", notices, datums=datums)
        assert (found.toolpath.end[-1] + found.toolpath.origin).tolist() == [10.5, -20, 30]
    assert moves("G147 Q9\nG0 X0 Y0 Z0", datums=datums).tolist() == [[7, 8, 9]]


# --- feed, dwell, exact stop, spindle ------------------------------------------------------------------------------


def test_the_number_of_the_feed_is_kept_and_read_anew():
    """MNC-G95-SWITCH: F2 is 2 mm/min, then 2 mm/rev at 300 rev/min, then 2 mm/rev at 50 rev/min, then 2 mm/min."""
    program = "S300 M4\nG1 X1 F2\nG95 X2\nS50 X3\nG3 X4 R5\nG94 G1 X5\n"
    path = obeyed(program).toolpath
    assert path.feed[path.is_motion].tolist() == [2, 600, 100, 100, 2]
    assert path.per_rev[path.is_motion].tolist() == pytest.approx([math.nan, 2, 2, 2, math.nan], nan_ok=True)


@pytest.mark.parametrize(("written", "seconds"), [("0.01", 0.01), ("2.004", 2), ("99999.99", 99999.99)])
def test_dwell(written, seconds):
    """In steps of 0.01 s, between motions, and nothing moves."""
    path = obeyed(f"G1 X5 F100\nG4 P{written}\nX6\n").toolpath
    assert path.kind.tolist() == [Kind.LINE, Kind.DWELL, Kind.LINE]
    assert path.time[1] == seconds and path.end[1].tolist() == [5, 0, 0]


@pytest.mark.parametrize(
    ("program", "exact"),
    [
        ("G1 X1 F100\nG61 X2\nG0 X3\nG2 X4 R9\nG64 G1 X5\n", [0, 1, 1, 1, 0]),
        ("G1 X1 F100\nG9 X2\nX3\nG9 G3 X4 R9\nX5 R9\n", [0, 1, 0, 1, 0]),
        ("G61 G1 X1 F100\nG9 X2\nX3\nG64\nX4\n", [1, 1, 1, 0]),
        ("G9\nG1 X1 F100\nG9 F50\nX2\n", [0, 0]),
        ("G1 X1 F100\nG61\nG91\nX1\nG64 X1\nG9 X1\n", [0, 1, 0, 1]),
    ],
)
def test_exact_stop(program, exact):
    """G61 until G64, G9 in its own block only; the path is that of the program without them."""
    path = obeyed(program).toolpath
    assert path.exact.tolist() == [bool(k) for k in exact]
    plain = obeyed(re.sub("G(61|64|9)(?!\\d)", "", program)).toolpath
    assert np.array_equal(path.end, plain.end) and not plain.exact.any()


def test_spindle_supervision_is_a_state_and_moves_nothing():
    program = "S500 M3\nG25\nG1 X1 F100\nG26 X2\n"
    found = obeyed(program)
    codes = [found.at(line).state["supervision"] for line in (1, 2, 3, 4)]
    assert codes == ["G26", "G25", "G25", "G26"]
    plain = obeyed(program.replace("G25", "").replace("G26", "")).toolpath
    assert found.toolpath.end.tolist() == plain.end.tolist() and len(found.toolpath) == len(plain)


def test_at_power_on():
    """MNC-POWERON: the table of the power-on state; spindle, feed and tool are at rest."""
    found = obeyed("G0 X1\n")
    groups = {
        "datum": "G53", "supervision": "G26", "corners": "G160", "motion": "G0", "polar": "G15", "plane": "G17",
        "scaling": "G36", "rotation": "G38", "compensation": "G40", "mirror": "G50", "blending": "G64",
        "dimension": "G90", "feed mode": "G94", "spindle": "M5",
    }  # fmt: skip
    state = found.at(1).state
    assert {group: state[group] for group in groups} == groups
    assert "tool" not in state and "speed" not in state and found.toolpath.tool.tolist() == [0]


# --- tool length, corrector ----------------------------------------------------------------------------------------

TOOLS = {
    1: Tool(length=50, dl=0.2, radius=5),
    2: Tool(length=30, dl=-0.5, radius=4, dr=0.1),
    3: Tool(length=-12, radius=3, dr=-0.25),  # against a zero tool: shorter
    4: Tool(length=50, dl=0.2, radius=2),  # as long as T1
}


def references(program, **setup):
    """Height of the spindle reference after each row: the tip and length + correction above it (5.2)."""
    path = obeyed(program, tools=TOOLS, **setup).toolpath
    table = {0: Tool(), **TOOLS}
    lengths = [table[int(number)].length + table[int(number)].dl for number in path.tool]
    return (path.end[:, 2] + path.origin[2] + lengths).tolist()


@pytest.mark.parametrize("plane", ["G17", "G18", "G19"])
def test_the_reference_stands_above_the_tip(plane):
    """Calling a tool moves nothing; the next Z motion brings its tip to the height; T0 ends the compensation."""
    program = f"{plane} G54 G0 Z100\nT1\nZ10\nT3\nX5\nZ10\nT2 Z10\nT0\nZ10\n"
    expected = [107, 107, 67.2, 67.2, 67.2, 5, 5, 46.5, 46.5, 17]  # G54 lies at Z7, T2 is 29.5 long
    assert references(program, datums={1: (0, 0, 7)}) == pytest.approx(expected, abs=1e-12)


def test_a_tool_call_reads_the_tip_anew():
    """Z100 with T0; T1 is 50.2 longer, T3 12 shorter than nothing."""
    found = obeyed("G0 X1 Z100\nT1\nT3\nX2\n", tools=TOOLS)
    heights = [found.at(line).position[2] for line in (1, 2, 3, 4)]
    assert heights == pytest.approx([100, 49.8, 112, 112], abs=1e-12)
    assert found.toolpath.kind.tolist() == [Kind.RAPID, Kind.TOOL, Kind.TOOL, Kind.RAPID]


def test_the_corrector_takes_corrections_and_radius_of_another_row():
    """D2 with T1: length 50 - 0.5, radius 4 + 0.1. D4: 50 + 0.2 again, radius 2. A tool call resets it."""
    found = obeyed("T1\nX1\nD2\nX2\nD4\nX3\nT1\nX4\nD3\nX5\nT2 X6\n", tools=TOOLS)
    path, moved = found.toolpath, found.toolpath.kind == Kind.RAPID
    assert path.radius[moved].tolist() == pytest.approx([5, 4.1, 2, 5, 2.75, 4.1], abs=1e-12)
    assert path.tool[moved].tolist() == [1, 1, 1, 1, 1, 2]
    heights = [found.at(line).position[2] for line in (2, 4, 6, 8, 10, 11)]
    lengths = [50.2, 49.5, 50.2, 50.2, 50, 29.5]  # the reference stays at Z0
    assert heights == pytest.approx([-length for length in lengths], abs=1e-12)
    assert moves("T1 D2\nZ0\n", tools=TOOLS)[-1].tolist() == [0, 0, 0]


def test_a_row_for_a_corrector_that_changes_the_length():
    """T1 and T4 are equally long: D4 makes no row, D2 makes one; nothing moves."""
    path = obeyed("T1\nD4\nD2\nD1\n", tools=TOOLS).toolpath
    assert path.kind.tolist() == [Kind.TOOL] * 3 and path.line.tolist() == [1, 3, 4]
    assert path.end[:, 2].tolist() == pytest.approx([-50.2, -49.5, -50.2], abs=1e-12)


@pytest.mark.parametrize("words", ["T1 D3", "D3 T1"])
def test_the_corrector_gives_the_radius_of_compensation(words):
    """T acts before D, whatever their order: T3 has the radius 3 - 0.25, to the left of a line along X."""
    path = obeyed(f"{words}\nG0 Y20\nG41 G1 X10 F100\nX30\nG40 X40\n", tools=TOOLS).toolpath
    feeding = path[path.kind == Kind.LINE]
    expected = np.array([[10, 22.75], [30, 22.75], [40, 20]])
    assert feeding.end[:, :2] == pytest.approx(expected, abs=1e-12)
    assert (path.tool == 1).all()


# --- polar programming between other blocks ------------------------------------------------------------------------


def test_increments_count_from_the_last_position_whoever_made_it():
    """2.8.3: (0, 20) is R20 A90; +10 and -30 degrees make R30 A60. Absolute words keep the R of before."""
    found = moves("G16\nG10 R10 A0\nG0 X0 Y20\nG91\nG10 R10 A-30\nG90\nG0 X1 Y2\nG10 A90\n")
    expected = [[10, 0], [0, 20], [30 * math.cos(math.pi / 3), 30 * math.sin(math.pi / 3)], [1, 2], [0, 30]]
    assert found[:, :2] == pytest.approx(np.array(expected), abs=1e-12)


def test_after_g15_polar_motion_is_cartesian():
    """MNC-POLAR-CART: G11 becomes G1, G13 becomes G3."""
    found = obeyed("G16\nG10 R10 A0\nG13 A90 K10 F100\nG15\nX-10 Y0 R10\nG16\nG11 R4 A0\nG15\nX7\n")
    assert found.toolpath.kind.tolist() == [Kind.RAPID, Kind.ARC, Kind.ARC, Kind.LINE, Kind.LINE]
    assert found.toolpath.end[-1].tolist() == pytest.approx([7, 0, 0])
    assert found.at(9).state["motion"] == "G1"


@pytest.mark.parametrize(
    ("program", "centre", "degrees"),
    [
        ("G10 R10 A0\nG13 K10 F100", (0, 0), 360),  # a whole circle about the pole
        ("G10 R10 A0\nG12 R10 A360 K-10 F100", (0, 0), -360),
        ("G10 R10 A0\nG12 A90 K10 F100", (0, 0), -270),  # the pole, however long the way
        ("G10 R10 A0\nG13 A180 K10 F100", (0, 0), 180),
        ("G10 R10 A0\nG13 R20 A180 K15 F100", (-5, 0), 180),
        ("G10 R0 A0\nG13 R10 A90 K-5 F100", (0, 5), 180),
        ("G10 R10 A0\nG12 A90 K-20 F100", (5 - 350**0.5 * 0.5**0.5,) * 2, -360 + 41.4096221),  # 41.4 = 2 asin(1/8**.5)
    ],
)
def test_polar_arcs(program, centre, degrees):
    arc = obeyed("G16\n" + program).toolpath[-1]
    assert arc.centre[:2].tolist() == pytest.approx(centre, abs=1e-9)
    assert math.degrees(arc.sweep) == pytest.approx(degrees, abs=1e-6)


def test_a_block_seen_before_the_pole_is_refused_after_it():
    """The handing out of words is planned once for each kind of block; the pole is part of the kind."""
    run = mnclab.run("F100\nG90 G1 X1\nG16\nG90 G1 X1\n", "mnc")
    assert [a.span[:2] for a in run.alarms if a.severity == "alarm"] == [(4, 5)]
