"""Cycles 7 and 10 and their chain: the manual's example COTRANS (11.10) and worked examples."""

from __future__ import annotations

import math

import pytest

import mnclab as mnc

COTRANS = """\
0 BEGIN PGM COTRANS MM
1 BLK FORM 0.1 Z X+0 Y+0 Z-20
2 BLK FORM 0.2 X+130 Y+130 Z+0
3 TOOL CALL 1 Z S4500
4 L Z+250 R0 FMAX
5 CYCL DEF 7.0 DEPL. DECALARE OR.
6 CYCL DEF 7.1 X+65
7 CYCL DEF 7.2 Y+65
8 CALL LBL 1
9 LBL 10
10 CYCL DEF 10.0 ROTATIE
11 CYCL DEF 10.1 IROT+45
12 CALL LBL 1
13 CALL LBL 10 REP 6/6
14 CYCL DEF 10.0 ROTATIE
15 CYCL DEF 10.1 ROT+0
16 CYCL DEF 7.0 DEPL. DECALARE OR.
17 CYCL DEF 7.1 X+0
18 CYCL DEF 7.2 Y+0
19 L Z+250 R0 FMAX M2
20 LBL 1
21 L X+0 Y+0 R0 FMAX
22 L Z+2 R0 FMAX M3
23 L Z-5 R0 F200
24 L X+30 RL
25 L IY+10
26 RND R5
27 L IX+20
28 L IX+10 IY-10
29 RND R5
30 L IX-10 IY-10
31 L IX-20
32 L IY+10
33 L X+0 Y+0 R0 F5000
34 L Z+20 R0 FMAX
35 LBL 0
36 END PGM COTRANS MM
"""

# The contour in local coordinates. RND at (30, 10): a right angle, tangent points 5 mm from the corner. RND at (60, 0):
# the direction turns by 90 degrees between (1, -1) and (-1, -1), so 5 / sqrt(2) = 3.5355 in X and Y from the corner.
ROOT = 5 / math.sqrt(2)
CORNERS = [(30, 0), (30, 5), (35, 10), (50, 10), (60 - ROOT, ROOT), (60 - ROOT, -ROOT), (50, -10), (30, -10), (30, 0)]
CENTRES = [(35, 5), (60 - 2 * ROOT, 0)]


def turned(points: list[tuple[float, float]], angle: float, x: float = 65, y: float = 65) -> list[list[float]]:
    c, s = math.cos(math.radians(angle)), math.sin(math.radians(angle))
    return [[x + c * u - s * v, y + s * u + c * v] for u, v in points]


def close(found: object, expected: object) -> bool:
    flat = [v for p in expected for v in p]  # type: ignore[attr-defined]
    return [v for p in found for v in p] == pytest.approx(flat, abs=1e-9)  # type: ignore[attr-defined]


@pytest.fixture
def needle(tnc) -> mnc.Run:
    """COTRANS with a tool of radius 0: the tool centre runs on the contour itself, roundings included."""
    return tnc(COTRANS, mnc.Setup(tools={1: mnc.Tool(radius=0)}))


def test_cotrans_runs_eight_times_around_the_shifted_datum(needle) -> None:
    assert needle.ok
    path = needle.toolpath
    rows = path[(path.side != 0) & path.is_motion]
    assert len(rows) == 8 * 9 and set(rows.end[:, 2]) == {-5} and set(rows.feed) == {200}
    for k, angle in enumerate((0, 45, 90, 135, 180, 225, 270, 315)):
        run = rows[9 * k : 9 * k + 9]
        assert close(run.end[:, :2], turned(CORNERS, angle)), angle
        arcs = run[run.kind == mnc.Kind.ARC]
        assert close(arcs.centre[:, :2], turned(CENTRES, angle)), angle
        assert arcs.sweep.tolist() == pytest.approx([-math.pi / 2] * 2)  # clockwise, RL outside


def test_cotrans_printed_points(needle) -> None:
    """Figures of the catalogue, rounded to three digits there."""
    path = needle.toolpath
    rows = path[(path.side != 0) & path.is_motion]
    assert rows[9].end[:2].tolist() == pytest.approx([86.213, 86.213], abs=6e-4)  # first contour point of run 2
    assert rows[9 * 7].end[:2].tolist() == pytest.approx([86.213, 43.787], abs=6e-4)  # of run 8
    back = path[path.feed == 5000]
    assert len(back) == 8 and close(back.end[:, :2], [[65, 65]] * 8)
    bounds = rows.bounds
    assert bounds[:, :2].ravel().tolist() == pytest.approx(
        [7.071, 7.071, 122.929, 122.929], abs=0.011
    )  # arcs within 0.01


def test_cotrans_leaves_no_transformation(needle) -> None:
    assert [name for name, _ in needle.frames] == ["secondary axes", "preset"]
    assert needle.toolpath.motion[-1].end[2] == 250


def test_cotrans_with_a_tool_keeps_its_radius(tnc) -> None:
    """Radius 5: the straight parts of the first run lie 5 mm outside, seen at the two vertical ones."""
    run = tnc(COTRANS)
    path = run.toolpath
    lines = path[(path.side != 0) & (path.kind == mnc.Kind.LINE)][:7]
    assert run.ok
    # up the left flank at X = 65 + 30 - 5; along the top at Y = 65 + 10 + 5
    assert lines.end[1].tolist() == pytest.approx([90, 70, -5]) and lines.end[2].tolist()[1] == pytest.approx(80)


PROBE_POINTS = [(0, 0), (10, 0), (0, 10), (30, 10)]


def where(tnc, definitions: str, points: list[tuple[float, ...]] = PROBE_POINTS) -> list[list[float]]:  # type: ignore[assignment]
    """Machine positions of local points under some definitions; a far point first, so that every point is a move."""
    moves = "".join(f"L X-999 Y-999 Z-999\nL X{p[0]} Y{p[1]} Z{p[2] if len(p) > 2 else 0}\n" for p in points)
    run = tnc(f"TOOL CALL 1 Z F1000\n{definitions}\n{moves}")
    assert run.ok, run.alarms
    return run.toolpath.motion.end[1::2].tolist()


SHIFT = "13 CYCL DEF 7.0 DEPL. DECALARE OR.\n14 CYCL DEF 7.1 X+60\n15 CYCL DEF 7.2 Y+40"
TURN = "16 CYCL DEF 10.0 ROTATIE\n17 CYCL DEF 10.1 ROT+35"


def plane(points: list[list[float]]) -> list[list[float]]:
    return [[round(v, 3) for v in p[:2]] for p in points]


def test_example_11_6(tnc) -> None:
    assert plane(where(tnc, "")) == [[0, 0], [10, 0], [0, 10], [30, 10]]
    assert plane(where(tnc, f"{SHIFT}\n{TURN}")) == [[60, 40], [68.192, 45.736], [54.264, 48.192], [78.839, 65.399]]


def test_rotation_first_turns_the_shift(tnc) -> None:
    assert plane(where(tnc, f"{TURN}\n{SHIFT}")) == [
        [26.206, 67.181],
        [34.398, 72.916],
        [20.47, 75.372],
        [45.045, 92.579],
    ]


def test_example_11_2(tnc) -> None:
    definitions = SHIFT + "\n16 CYCL DEF 7.3 Z-5"
    assert where(tnc, definitions, [(0, 0, 0), (10, 20, -3)]) == [[60, 40, -5], [70, 60, -8]]


def test_shift_incremental_absolute_and_kept(tnc) -> None:
    """After X+60 Y+40 Z-5: IX+10 adds, Y+0 replaces, Z stays."""
    definitions = SHIFT + "\n16 CYCL DEF 7.3 Z-5\nCYCL DEF 7.0 DATUM SHIFT\nCYCL DEF 7.1 IX+10\nCYCL DEF 7.2 Y+0"
    assert where(tnc, definitions, [(0, 0, 0)]) == [[70, 0, -5]]


def test_redefinition_keeps_its_place(tnc) -> None:
    """Shift, turn, shift again: the new shift is not turned. Datum (10, 20), local (10, 0) at 35 degrees."""
    definitions = f"{SHIFT}\n{TURN}\nCYCL DEF 7.0 S\nCYCL DEF 7.1 X+10\nCYCL DEF 7.2 Y+20"
    c, s = 10 * math.cos(math.radians(35)), 10 * math.sin(math.radians(35))
    assert plane(where(tnc, definitions, [(0, 0), (10, 0)])) == [[10, 20], [round(10 + c, 3), round(20 + s, 3)]]


def test_a_neutral_value_takes_the_frame_out(tnc) -> None:
    """Shift, turn, shift to zero, shift again: the last one is appended and so turned, as with the rotation first."""
    zero = "CYCL DEF 7.0 S\nCYCL DEF 7.1 X+0\nCYCL DEF 7.2 Y+0"
    assert plane(where(tnc, f"{SHIFT}\n{TURN}\n{zero}\n{SHIFT}")) == [
        [26.206, 67.181], [34.398, 72.916], [20.47, 75.372], [45.045, 92.579],
    ]  # fmt: skip


def test_increments_of_the_angle_have_no_limit(tnc) -> None:
    """300 + 300 degrees are 240: (10, 0) goes to 10 (cos 240, sin 240) = (-5, -8.660)."""
    twice = "CYCL DEF 10.0 R\nCYCL DEF 10.1 IROT+300\n" * 2
    assert plane(where(tnc, twice, [(10, 0)])) == [[-5, -8.66]]


def test_axis_not_moved_keeps_its_coordinate_in_the_turned_system(tnc) -> None:
    """At (10, 0) turned by 90 degrees the register is (0, -10); L X+5 goes to local (5, -10), machine (10, 5)."""
    run = tnc("TOOL CALL 1 Z F100\nL X+10 Y+0\nCYCL DEF 10.0 R\nCYCL DEF 10.1 ROT+90\nL X+5\n")
    assert run.toolpath[-1].end[:2].tolist() == pytest.approx([10, 5])


def test_rotation_cancels_radius_compensation(inside) -> None:
    """After RL along X the tool stands 5 mm left of (20, 0); the turned system goes on without compensation."""
    run = inside("2 L X+10 RL\n3 L X+20\n4 CYCL DEF 10.0 R\n5 CYCL DEF 10.1 ROT+90\n6 L X+30 Y+0")
    assert run.ok
    assert run.toolpath.side.tolist()[-1] == 0 and run.toolpath.end[-1].tolist() == pytest.approx([0, 30, 0])
    assert run.toolpath.end[-2].tolist() == pytest.approx([20, 5, 0])


@pytest.mark.parametrize("end", ["M2", "M30", "END PGM A MM"])
def test_the_end_of_the_program_cancels_transformations(end: str, tnc) -> None:
    run = tnc(f"0 BEGIN PGM A MM\n{SHIFT}\n{TURN}\n18 {end}\n")
    assert run.ok and [name for name, _ in run.frames] == ["secondary axes", "preset"]


def test_shift_in_inches(tnc) -> None:
    run = tnc("0 BEGIN PGM A INCH\nCYCL DEF 7.0 S\nCYCL DEF 7.1 X+2\nL X+1 F10\n")
    assert run.toolpath.end[-1].tolist() == pytest.approx([76.2, 0, 0])
