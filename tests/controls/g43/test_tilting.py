"""Tilted planes and the led tip of the ISO mill: every way to say a plane, where the axes go, and what is refused."""

import math

import numpy as np
import pytest

import mnclab
from mnclab import Datum, Kinematics, Setup, Tool

MACHINES = ("table-ac", "head-bc", "head-b-table-c")
LENGTH = 80.0
DATUM = np.array([100.0, 50.0, -20.0])
TOOLS = {1: Tool(radius=5, length=LENGTH, kind="mill", centre_cutting=True), 2: Tool(radius=3, length=60, kind="mill")}
RANDOM = np.random.default_rng(682)


def run(program: str, machine="table-ac", ok=True, **more):
    setup = Setup(kinematics=machine, tools=TOOLS, datums={1: Datum(*DATUM)}, start=(0, 0, 300), **more)
    found = mnclab.run(f"G21 G90 G54 T1 M6 S1000 M3\nG0 X0 Y0\nG43 H1 Z150\n{program}", "g43", setup=setup)
    assert found.ok is ok, found.alarms
    return found


def chain(name) -> Kinematics:
    return mnclab.machines()[name].kinematics if isinstance(name, str) else name


def turn(axis: int, degrees: float) -> np.ndarray:
    """The matrix of a right-handed turn about X, Y or Z."""
    c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    found = np.eye(3)
    i, j = (axis + 1) % 3, (axis + 2) % 3
    found[i, i], found[i, j], found[j, i], found[j, j] = c, -s, s, c
    return found


def random_plane() -> np.ndarray:
    """A turn (3, 3) whose Z looks up, so that every machine reaches it."""
    while True:
        a, b, c = RANDOM.uniform(-80, 80), RANDOM.uniform(-80, 80), RANDOM.uniform(-180, 180)
        found = turn(2, c) @ turn(1, b) @ turn(0, a)
        if 0.35 < found[2, 2] < 0.98:
            return found


def number(value: float) -> str:
    return f"{value:.12f}"


def euler(r):
    """P0: about Z, X', Z''."""
    j = math.degrees(math.acos(r[2, 2]))
    i, k = math.degrees(math.atan2(r[0, 2], -r[1, 2])), math.degrees(math.atan2(r[2, 0], r[2, 1]))
    return f"G68.2 X30 Y10 Z5 I{number(i)} J{number(j)} K{number(k)}"


def fixed(r):
    """P1 Q123: about the fixed axes X, Y, Z."""
    b = math.degrees(math.asin(-r[2, 0]))
    a, c = math.degrees(math.atan2(r[2, 1], r[2, 2])), math.degrees(math.atan2(r[1, 0], r[0, 0]))
    return f"G68.2 P1 Q123 X30 Y10 Z5 I{number(a)} J{number(b)} K{number(c)}"


def haas(r):
    return fixed(r).replace("G68.2 P1", "G268")


def point(values) -> str:
    return " ".join(f"{axis}{number(value)}" for axis, value in zip("XYZ", values))


def points(r):
    """P2: the origin, a point of X, a point of the plane ahead."""
    o = np.array([30.0, 10.0, 5.0])
    blocks = (o, o + 40 * r[:, 0], o + 7 * r[:, 0] + 25 * r[:, 1])
    return "\n".join(f"G68.2 P2 Q{k} {point(each)}" for k, each in enumerate(blocks, 1))


def vectors(r):
    """P3: the directions of X and of Z."""
    one, other = (" ".join(f"{axis}{number(value)}" for axis, value in zip("IJK", r[:, k])) for k in (0, 2))
    return f"G68.2 P3 Q1 X30 Y10 Z5 {one}\nG68.2 P3 Q2 {other}"


def projected(r):
    """P4: the slopes of the plane along X and Y, and K from the line over X to X'."""
    n = r[:, 2]
    i, j = math.degrees(math.atan2(n[0], n[2])), math.degrees(math.atan2(-n[1], n[2]))
    along = np.array([math.cos(math.radians(i)), 0, -math.sin(math.radians(i))])
    k = math.degrees(math.atan2(np.cross(along, r[:, 0]) @ n, along @ r[:, 0]))
    return f"G68.2 P4 X30 Y10 Z5 I{number(i)} J{number(j)} K{number(k)}"


def on_top(r):
    """G68.4: half of it by another plane before."""
    half = turn(0, 20)
    return f"G68.2 X30 Y10 Z5 J20\n{fixed(half.T @ r).replace('G68.2', 'G68.4').replace('X30 Y10 Z5', 'X0 Y0 Z0')}"


SPELLINGS = {"euler": euler, "fixed": fixed, "haas": haas, "points": points, "vectors": vectors, "slopes": projected,
             "on top": on_top}  # fmt: skip


@pytest.mark.parametrize("name", SPELLINGS)
def test_every_way_to_say_a_plane_is_the_plane(name):
    """A point of the plane is where the turn has it, the tool lies square to it, X Y Z A B C are those of the closed form."""
    planes = [random_plane() for _ in range(30)]
    turned = "G253" if name == "haas" else "G53.1"
    ended = "G269" if name == "haas" else "G69"
    for number_of, r in enumerate(planes):
        machine = MACHINES[number_of % 3]
        found = run(f"{SPELLINGS[name](r)}\n{turned}\nG0 X10 Y20 Z30\n{ended}\nM30\n", machine)
        path = found.toolpath
        row = len(path) - 1
        at = path.end[row] + path.origin
        expected = DATUM + [30, 10, 5] + r @ [10, 20, 30]
        np.testing.assert_allclose(at, expected, atol=1e-9)
        np.testing.assert_allclose(path.directions[row], r[:, 2], atol=1e-9)
        tip, direction = chain(machine).forward(np.asarray(found.axes())[row], LENGTH)
        np.testing.assert_allclose(tip[0], expected, atol=1e-9)
        np.testing.assert_allclose(direction[0], r[:, 2], atol=1e-9)


def test_forty_five_degrees_about_x_on_a_table():
    """A 45, C 0: the part has turned by -45 degrees about A, whose axis lies 50 mm above machine zero."""
    found = run("G68.2 X30 Y10 Z5 I0 J45 K0\nG53.1\nG0 X0 Y0 Z10\nM30\n")
    axes = found.axes()
    assert abs(axes.A[-1] - 45) < 1e-9 and abs(axes.C[-1]) < 1e-9
    part = DATUM + [30, 10, 5] + turn(0, 45) @ [0, 0, 10]
    expected = turn(0, -45) @ (part - [0, 0, 50]) + [0, 0, 50 + LENGTH]
    np.testing.assert_allclose([axes.X[-1], axes.Y[-1], axes.Z[-1]], expected, atol=1e-9)


def test_before_g53_1_the_axes_stand_and_the_coordinates_are_tilted():
    found = run("G68.2 X30 Y10 Z5 J45\nG0 X0 Y0 Z10\nM30\n")
    np.testing.assert_allclose(found.toolpath.end[-1], [30, 10, 5] + turn(0, 45) @ [0, 0, 10], atol=1e-9)
    assert found.axes().A[-1] == 0


@pytest.mark.parametrize("p, tilting, other", [("", 30, 90), (" P0", 30, 90), (" P1", 30, 90), (" P2", -30, -90)])
def test_which_of_two_ways(p, tilting, other):
    """A plane tilted about Y on a table A, C: both ways are as long, and the one ahead is taken."""
    axes = run(f"G68.2 P1 Q123 J30\nG53.1{p}\nM30\n").axes()
    np.testing.assert_allclose([axes.A[-1], axes.C[-1]], [tilting, other], atol=1e-9)


def test_a_plane_that_the_axes_were_turned_to_before():
    """G68.3 takes the tool as it stands: its Z is the tool, its X square to it and to Z."""
    found = run("G0 A30 C40\nG68.3 X0 Y0 Z0\nG0 X7 Y8 Z9\nM30\n")
    z = found.toolpath.directions[-1]
    x = np.cross([0, 0, 1], z) / np.linalg.norm(np.cross([0, 0, 1], z))
    np.testing.assert_allclose(found.toolpath.end[-1], 7 * x + 8 * np.cross(z, x) + 9 * z, atol=1e-9)


@pytest.mark.parametrize("machine", MACHINES)
def test_a_led_tip_follows_its_line(machine):
    """Between the rows all axes run evenly: the tip leaves the line by no more than the tolerance."""
    swung = "A40" if machine == "table-ac" else "B40"
    found = run(f"G43.4 H1 Z60\nG1 X50 Y20 Z10 {swung} C60 F500\nG49\nM30\n", machine)
    axes, path = np.asarray(found.axes()), found.toolpath
    rows = np.flatnonzero((path.line == 5) & path.is_motion)
    start, end = path.start[rows[0]], path.end[rows[-1]]
    np.testing.assert_allclose(end, [50, 20, 10], atol=1e-9)
    along = (end - start) / np.linalg.norm(end - start)
    for share in np.linspace(0, 1, 9):
        between = axes[rows - 1] + share * (axes[rows] - axes[rows - 1])
        tips = chain(machine).forward(between, LENGTH)[0] - path.origin - start
        assert np.linalg.norm(tips - np.outer(tips @ along, along), axis=1).max() < 0.0101
    np.testing.assert_allclose(path.feed[rows], 500)


def test_rotary_words_alone_leave_the_linear_axes_still():
    axes = run("G0 A30 C45\nM30\n").axes()
    np.testing.assert_allclose([axes.X[-1], axes.Y[-1], axes.Z[-1]], [100, 50, -20 + 150 + LENGTH], atol=1e-9)
    assert (axes.A[-1], axes.C[-1]) == (30, 45)


def test_without_a_plane_linear_axes_go_to_datum_programmed_and_length():
    axes = run("G0 A30 C45\nG0 X10 Y20 Z30\nG1 X40 C50 F500\nM30\n").axes()
    np.testing.assert_allclose([axes.X[-1], axes.Y[-1], axes.Z[-1]], [140, 70, 10 + LENGTH], atol=1e-9)


def test_machine_coordinates_and_reference_points_are_those_of_the_axes():
    found = run("G68.2 X30 Y10 Z5 J45\nG53.1\nG0 Z10\nG53 G0 Z400\nG53 G0 X7 Y8\nM30\n")
    axes = found.axes()
    np.testing.assert_allclose([axes.X[-1], axes.Y[-1], axes.Z[-1], axes.A[-1]], [7, 8, 400, 45], atol=1e-9)
    for back in ("G28 Z100 A30\nG28 X10 Y20", "G28"):
        axes = run(f"G0 A30\nG0 X10 Y20\n{back}\nM30\n").axes()
        np.testing.assert_allclose([axes.X[-1], axes.Y[-1], axes.Z[-1], axes.A[-1]], [0, 0, 0, 0], atol=1e-9)
    axes = run("G68.2 X30 Y10 Z5 J45\nG53.1\nG0 Z10\nG28\nM30\n").axes()
    np.testing.assert_allclose([axes.X[-1], axes.Y[-1], axes.Z[-1], axes.A[-1]], [0, 0, 0, 0], atol=1e-9)


def test_without_a_length_the_nose_is_led():
    """Under G49 the programmed point is that of the spindle nose: the tip hangs a tool's length below it, along the tool."""
    found = run("G49\nG68.2 J45\nG53.1\nG0 X0 Y0 Z100\nM30\n")
    z = turn(0, 45)[:, 2]
    np.testing.assert_allclose(found.toolpath.end[-1], 100 * z - LENGTH * z, atol=1e-9)


def test_holes_on_a_tilted_plane_go_along_the_tool():
    found = run("G68.2 X30 Y10 Z5 J45\nG53.1\nG0 X0 Y0 Z10\nG81 X5 Y6 Z-8 R2 F100\nX15\nG80\nG69\nM30\n")
    path = found.toolpath
    deepest = path[path.line == 8][2]
    r = turn(0, 45)
    np.testing.assert_allclose(deepest.end, [30, 10, 5] + r @ [15, 6, -8], atol=1e-9)


@pytest.mark.parametrize("j", [0, 30, 60, 90])
def test_g98_comes_back_to_the_initial_level_of_the_plane(j):
    found = run(f"G68.2 X30 Y10 Z5 J{j}\nG53.1\nG0 X0 Y0 Z50\nG98 G81 X5 Y6 Z-10 R2 F100\nX15\nG80\nG69\nM30\n")
    path = found.toolpath
    rows = np.flatnonzero(path.line == 7)
    expected = np.array([30, 10, 5]) + turn(0, j) @ [5, 6, 50]
    np.testing.assert_allclose(path.end[rows[-1]], expected, atol=1e-9)


def test_g98_over_a_table_that_has_turned():
    """Without a plane coordinates are those of the linear axes: the tool goes back to Z50 of the datum."""
    found = run("G0 A90 X0 Y0 Z50\nG98 G81 X0 Y0 Z-10 R2 F100\nX20\nG80\nM30\n")
    axes, line = found.axes(), found.toolpath.line
    for block in (5, 6):
        assert axes.Z[np.flatnonzero(line == block)[-1]] == pytest.approx(-20 + 50 + LENGTH, abs=1e-9)


def test_a_plane_through_the_tip():
    """G68.3 without X Y Z: X0 Y0 Z0 is where the tool stands."""
    for machine, angle in (("table-ac", "A30 C40"), ("head-bc", "B30 C40")):
        found = run(f"G0 X10 Y20 Z5 {angle}\nG68.3\nG0 X0 Y0 Z0\nM30\n", machine)
        before = found.toolpath[found.toolpath.line == 4].end[-1]
        np.testing.assert_allclose(found.toolpath.end[-1], before, atol=1e-9)


def test_turning_about_the_tip_takes_its_time():
    """20 degrees at 1000 degrees a minute, while the tip stands: 1.2 s."""
    found = run("G43.4 H1\nG1 A20 F1000\nG49\nM30\n")
    rows = found.toolpath[found.toolpath.line == 5]
    assert rows.time.sum() == pytest.approx(1.2, abs=1e-9) and (rows.end == rows.start).all()
    assert "1.2 s at feed" in repr(found)


REFUSED = [
    ("G68.2 J45\nG41 D1\n", "5:1", "needs the tool square to the working plane, and it leans by 45 degrees"),
    ("G68.2 J45\nG68.2 J30\n", "5:1", "cannot stand while a tilted plane is active"),
    ("G68.2 J45\nG55\n", "5:1", "G68.2 is active"),
    ("G68.2 J45\nG68 X0 Y0 R30\n", "5:1", "G68.2 is active"),
    ("G68.2 J45\nG92 X0\n", "5:1", "G68.2 is active"),
    ("G68.4 J45\n", "4:1", "none is active"),
    ("G53.1\n", "4:1", "needs a tilted plane"),
    ("G68.2 P5\n", "4:7", "whole number from 0 to 4"),
    ("G68.2 P1 I30\n", "4:1", "Q (order of the rotations) is missing"),
    ("G68.2 P1 Q121 I30\n", "4:10", "must be one of 123"),
    ("G68.2 Q123 I30\n", "4:7", "belongs to P1"),
    ("G68.2 R5 I30\n", "4:7", "belongs to P2"),
    ("G68.2 P4 I90\n", "4:1", "quarter turn"),
    ("G68.2 P2 Q1 X0 Y0 Z0\nG68.2 P2 Q2 X1 Y0 Z0\nG68.2 P2 Q3 X2 Y0 Z0\n", "6:1", "lie on one line"),
    ("G68.2 P2 Q1 X0 Y0\n", "4:1", "needs Z"),
    ("G68.2 P2 Q1 X0 Y0 Z0\nG0 X5\n", "5:1", "describes no plane yet"),
    ("G68.2 P2 Q1 X0 Y0 Z0\nG68.2 P3 Q2 I0 J0 K1\n", "5:7", "stands among the blocks of P2"),
    ("G68.2 P3 Q1 I1 J0 K0\nG68.2 P3 Q2 I1 J0 K1\n", "5:1", "square to each other"),
    ("G41 D1\nG68.2 J45\n", "5:1", "under radius compensation"),
    ("G68.2 P1 Q123 I170\nG53.1\n", "5:1", "no position of A and C within the limits"),
    ("G68.2 J45\nG53.1 P3\n", "5:7", "whole number from 0 to 2"),
    ("G43.4 H2\n", "4:1", "leads the tip of T1"),
    ("G43.4 H1\nG28 Z0\n", "5:1", "while the tip is led"),
    ("G0 A130\n", "4:4", "A (rotary axis) must be from -120 to 120 degrees"),
    ("  G1 X3 A130 F500\n", "4:9", "A (rotary axis) must be from -120 to 120 degrees"),
    ("G53 G0 A130\n", "4:8", "A (rotary axis) must be from -120 to 120 degrees"),
    ("G43.4 H1\nG1 X3 C5 A130 F500\n", "5:10", "A (rotary axis) must be from -120 to 120 degrees"),
    ("G28 X0 A130\n", "4:8", "A (rotary axis) must be from -120 to 120 degrees"),
    ("G1 X1 B5 F500\n", "4:7", "the machine has no rotary axis B"),
    ("G1 X1 F500\nG41 D1 X3\nX9\nX12 A3\n", "7:5", "cannot turn under radius compensation"),
    ("G0 X1 U3\n", "4:7", "U is refused"),
    ("G0 V3\n", "4:4", "V is refused"),
    ("G0 W3\n", "4:4", "W is refused"),
    ("G0 B5\n", "4:4", "the machine has no rotary axis B"),
    ("G43.5 H1\n", "4:1", "G43.4 and the angles"),
    ("G254\n", "4:1", "G268"),
    ("G68.2 J45\nG53.1\nG254\n", "6:1", "G268"),
]


@pytest.mark.parametrize("program, place, said", REFUSED, ids=str)
def test_what_is_refused(program, place, said):
    found = run(f"{program}M30\n", ok=False)
    alarm = next(each for each in found.alarms if each.severity == "alarm")
    assert said in f"{alarm.message} {alarm.hint}"
    assert f"{alarm.span.line}:{alarm.span.column}" == place


def test_without_rotary_axes_it_is_refused():
    for code in ("G68.2 J45", "G43.4 H1", "G53.1", "G268 I45"):
        found = mnclab.run(f"T1 M6\n{code}\nM30\n", "g43", tools=TOOLS)
        assert "needs a machine whose rotary axes are known" in str(found.alarms[0]) and found.alarms[0].span.line == 2
    linuxcnc = Setup(kinematics="table-ac", settings={"dialect": "linuxcnc"})
    assert "remap" in str(mnclab.run("G68.2 I45\nM30\n", "g43", setup=linuxcnc).alarms[0])


def test_leaving_the_travel_is_seen_where_the_axes_turn():
    """The tip stays within the part, X of the machine does not."""
    travel = mnclab.Limits(travel=((-50, 150), (-500, 500), (-500, 500)))
    assert run("G0 X40 Y0\nM30\n", limits=travel).ok
    found = run("G43.4 H1\nG0 X40 Y0\nG1 C180 F2000\nM30\n", limits=travel, ok=False)
    alarm = next(each for each in found.alarms if each.severity == "alarm")
    assert "X leaves the travel" in alarm.message and alarm.span.line == 6


def test_a_cut_before_the_tool_is_square_is_warned_of():
    for turned, many in (("", 1), ("G53.1\n", 0)):
        told = run(f"G68.2 X30 Y10 Z5 J45\n{turned}G0 X0 Y0 Z10\nG1 X20 F500\nX30\nM30\n").alarms
        assert len(told) == many and all("leans by 45 degrees" in each.message for each in told)
