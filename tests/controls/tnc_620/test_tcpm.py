"""Rotary axes that move: M116, M126, M128, FUNCTION TCPM, and what the linear axes do beside them. The tip is worked out here
from the positions of the axes, between the rows too, and held against the line that the program says."""

from __future__ import annotations

import math
from functools import partial

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from tools import running

import mnclab as mnc
from mnclab import Kind

MACHINES = ("table-ac", "head-bc", "head-b-table-c")
TILTS = {"table-ac": "A", "head-bc": "B", "head-b-table-c": "B"}
TOOLS = {1: mnc.Tool(length=80, radius=5), 2: mnc.Tool(length=130, radius=5)}
LENGTH = 80
TCPM = "FUNCTION TCPM F TCP AXIS POS"
run = partial(running.run, control="tnc-620", before="TOOL CALL 1 Z S1000 F1000\n", tools=TOOLS, presets={0: (11, -13, 17)})


def turn(points: np.ndarray, axis: str, degrees: np.ndarray, centre: tuple[float, float, float]) -> np.ndarray:
    """Points (n, 3) turned right-handed about an axis of the machine through a centre."""
    x, y, z = (points - centre).T
    c, s = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
    turned = {
        "A": (x, c * y - s * z, s * y + c * z), "B": (c * x + s * z, y, -s * x + c * z), "C": (c * x - s * y, s * x + c * y, z),
    }  # fmt: skip
    return np.stack(turned[axis], axis=1) + centre


def tips(machine: str, axes: np.ndarray, length: float = LENGTH) -> np.ndarray:
    """Tips (n, 3) on the part for positions (n, 6) of the axes: a head swings the tool, a table turns the tip about the part."""
    place, (a, b, c) = axes[:, :3], axes[:, 3:].T
    hanging = np.zeros_like(place) - (0, 0, length)
    if machine == "table-ac":
        return turn(turn(place + hanging, "A", a, (0, 0, 50)), "C", c, (0, 0, 0))
    if machine == "head-bc":
        return place + turn(turn(hanging, "B", b, (0, 0, 150)), "C", c, (0, 0, 150))
    return turn(place + turn(hanging, "B", b, (0, 0, 180)), "C", c, (0, 0, 0))


def between(found: mnc.Run, line: int) -> np.ndarray:
    """Positions of the axes on the way of a block, 20 between two rows, which all axes run evenly."""
    axes, rows = np.array(found.axes()), np.flatnonzero((found.toolpath.line == line) & found.toolpath.is_motion)
    ends = np.concatenate([axes[rows[0] - 1][None], axes[rows]])
    share = np.linspace(0, 1, 21)[None, :, None]
    return (ends[:-1, None] + share * (ends[1:] - ends[:-1])[:, None]).reshape(-1, 6)


def off_the_line(places: np.ndarray, one: np.ndarray, other: np.ndarray) -> float:
    way = (other - one) / np.linalg.norm(other - one)
    return float(np.linalg.norm((places - one) - np.outer((places - one) @ way, way), axis=1).max())


DATUM = np.array([11, -13, 17])


@pytest.mark.parametrize("machine", MACHINES)
@pytest.mark.parametrize("leads", ["M128", f"{TCPM} PATHCTRL AXIS", f"{TCPM} PATHCTRL VECTOR"])
def test_the_tip_follows_its_line_while_the_axes_turn(machine: str, leads: str) -> None:
    """Twenty random lines and turns: never more than 0.01 mm off, and at their ends exactly there."""
    random, tilting = np.random.default_rng(128), TILTS[machine]
    program, points = f"{leads}\nL X+0 Y+0 Z+50 {tilting}+20 C+30 FMAX\n", [np.array([0.0, 0, 50])]
    for _ in range(20):
        x, y, z = random.uniform(-60, 60, 3).round(3)
        points.append(np.array([x, y, z]))
        program += f"L X{x:+} Y{y:+} Z{z:+} {tilting}{random.uniform(5, 60):+.3f} C{random.uniform(-90, 90):+.3f} F800\n"
    found = run(program, kinematics=machine)
    for k in range(20):
        places = tips(machine, between(found, 4 + k))
        one, other = DATUM + points[k], DATUM + points[k + 1]
        assert off_the_line(places, one, other) < 0.01 + 1e-9
        assert places[0] == pytest.approx(one, abs=1e-9) and places[-1] == pytest.approx(other, abs=1e-9)
    rows = found.toolpath[found.toolpath.line == 5]
    assert {rows.labels[k] for k in rows.label} == {"tip led within 0.01 mm"}
    assert rows.time.sum() == pytest.approx(60 * np.linalg.norm(points[2] - points[1]) / 800) and set(rows.feed) == {800}


def test_the_tolerance_of_cycle_32_counts_while_it_is_active() -> None:
    move = "M128\nL X+0 Y+0 Z+50 FMAX\nL X+60 A+60 C+80 F800\n"
    counts = []
    for before, most in (("", 0.01), ("CYCL DEF 32.0 T\nCYCL DEF 32.1 T0.2\n", 0.2), ("CYCL DEF 32.0 T\nCYCL DEF 32.1\n", 0.01)):
        found = run(before + move, kinematics="table-ac")
        line = 4 + before.count("\n")
        off = off_the_line(tips("table-ac", between(found, line)), DATUM + (0, 0, 50), DATUM + (60, 0, 50))
        assert most / 4 < off <= most
        counts.append(int((found.toolpath.line == line).sum()))
    assert counts[0] == counts[2] > 3 * counts[1]
    wide = run(move, kinematics="table-ac", tcpm_tolerance=0.2)
    assert int((wide.toolpath.line == 4).sum()) == counts[1]


@pytest.mark.parametrize("machine", MACHINES)
def test_the_tip_stays_while_the_axes_turn_alone(machine: str) -> None:
    found = run(f"L X+20 Y+30 Z+40 FMAX\nL {TILTS[machine]}+50 C+70 F900 M128\n", kinematics=machine)
    places = tips(machine, between(found, 3))
    assert np.abs(places - (DATUM + (20, 30, 40))).max() < 0.01
    assert found.toolpath.time[found.toolpath.line == 3].sum() == pytest.approx(60 * 70 / 900)  # degrees a minute


@pytest.mark.parametrize("machine", MACHINES)
def test_without_it_the_axes_go_to_datum_programmed_and_length(machine: str) -> None:
    """Wherever the rotary axes stand; and the rows say where that is on the part, on the way too."""
    found = run(f"L {TILTS[machine]}+25 C+40 FMAX\nL X+20 Y+30 Z+40 FMAX\nL X-5 C+10 F500", kinematics=machine)
    axes = np.array(found.axes())
    tilt = 3 + "ABC".index(TILTS[machine])
    assert axes[-1, :3] == pytest.approx(DATUM + (-5, 30, 40 + LENGTH)) and axes[-1, [tilt, 5]] == pytest.approx([25, 10])
    assert (found.toolpath.end + found.toolpath.origin)[1:] == pytest.approx(tips(machine, axes[1:]), abs=1e-9)
    way = np.linalg.norm(axes[-1, :3] - (DATUM + (20, 30, 40 + LENGTH)))
    assert found.toolpath.time[found.toolpath.line == 4].sum() == pytest.approx(60 * way / 500)
    straight = between(found, 4)
    assert off_the_line(straight[:, :3], straight[0, :3], straight[-1, :3]) < 1e-9


def test_the_shortest_way_counts_on() -> None:
    """M126 from 350 to 10 is 20 on, to 370; half a turn goes ahead; M127 goes back through all of it. Steps and limits count."""

    def ends(program: str, machine: str = "table-ac") -> list[float]:
        found = run(program, kinematics=machine)
        return [round(float(found.axes().C[found.toolpath.line == line][-1]), 9) for line in range(2, 2 + program.count("\n"))]

    assert ends("L C+350 FMAX\nL C+10 FMAX M126\nL C+0 F100\nL C+180 FMAX\nL C+10 FMAX M127\n") == [350, 370, 360, 540, 10]
    assert ends("L C+350 FMAX M126\nL IC-340 FMAX\n") == [-10, -350]  # a step is what it says
    assert ends("L C+500 FMAX\nL C+190 FMAX M126\n", "head-bc") == [500, 190]  # 550 is beyond its 540


def test_the_feed_of_a_table_past_the_tip() -> None:
    """M116: 90 degrees of C with the tip 40 from its axis at 600 mm/min. A through (0, 0, 50): 50 above it, the same. A head
    and a tip on the axis have degrees a minute."""

    def takes(program: str, machine: str = "table-ac") -> float:
        path = run(program, kinematics=machine, presets={}).toolpath
        return float(path.time[path.line == 3].sum())

    quarter = math.pi / 2
    assert takes("L X+40 Y+0 Z+9 FMAX\nL C+90 F600 M116") == pytest.approx(60 * quarter * 40 / 600)
    assert takes("L X+0 Y+0 Z+100 FMAX\nL A+90 F600 M116") == pytest.approx(60 * quarter * 50 / 600)
    assert takes("L X+40 Y+0 Z+9 FMAX\nL C+90 F600") == pytest.approx(60 * 90 / 600)
    assert takes("L X+0 Y+0 Z+9 FMAX\nL C+90 F600 M116") == pytest.approx(60 * 90 / 600)
    assert takes("L X+40 Y+0 Z+9 FMAX\nL C+90 F600 M116", "head-bc") == pytest.approx(60 * 90 / 600)
    # behind A90 the axis of C lies along -Y of the machine, through (0, 0, 50): the tip 30 beside it and 40 above
    tilted = "L A+90 FMAX\nL X+30 Y+7 Z+90 FMAX M116\nL C+90 F600"
    path = run(tilted, kinematics="table-ac", presets={}).toolpath
    assert float(path.time[path.line == 4].sum()) == pytest.approx(60 * quarter * 50 / 600)


def test_the_feed_along_all_axes_of_the_block() -> None:
    """F CONT: 30 mm and 40 degrees are 50, at 600 a minute 5 s; F TCP: 30 mm, 3 s."""
    for form, wanted in (("CONT", 5), ("TCP", 3)):
        found = run(f"FUNCTION TCPM F {form} AXIS POS\nL X+0 Y+0 Z+50 FMAX\nL X+30 C+40 F600", kinematics="table-ac")
        assert found.toolpath.time[found.toolpath.line == 4].sum() == pytest.approx(wanted)


def test_the_compensating_moves_have_a_feed_of_their_own() -> None:
    """M128 F100: Z of a head swings 230 mm about the tip, a quarter circle, at 100 mm/min."""
    found = run("L X+0 Y+0 Z+50 FMAX M128 F100\nL B+90 F5000\nL X+5 F500", kinematics="head-bc")
    way = math.pi / 2 * (150 + LENGTH)
    assert found.toolpath.time[found.toolpath.line == 3].sum() == pytest.approx(60 * way / 100, rel=1e-3)
    rapid = run("L X+0 Y+0 Z+50 FMAX M128 F100\nL B+90 FMAX\nL C+9 FMAX", kinematics="head-bc").toolpath
    assert rapid.time[rapid.line == 3].sum() == pytest.approx(60 * way / 100, rel=1e-3)
    (last,) = found.toolpath[found.toolpath.line == 4]
    assert last.feed == 500 and math.dist(last.start, last.end) == pytest.approx(5)


def direction(axes: np.ndarray) -> np.ndarray:
    """Of the tool on the part of table-ac: Rz(C) Rx(A) ez."""
    a, c = np.radians(axes[:, 3]), np.radians(axes[:, 5])
    return np.stack([np.sin(a) * np.sin(c), -np.sin(a) * np.cos(c), np.cos(a)], axis=1)


def test_spatial_angles_of_the_tool() -> None:
    """AXIS SPAT: A+0 B+30 leans the tool to +X, whatever axes bring it there; B alone keeps A."""
    found = run("FUNCTION TCPM F TCP AXIS SPAT\nL A+10 B+30 C+0 FMAX\nL B-30 FMAX", kinematics="table-ac")
    axes = np.array(found.axes())
    for line, b in ((3, 30), (4, -30)):
        b, a = math.radians(b), math.radians(10)
        wanted = [math.sin(b) * math.cos(a), -math.sin(a), math.cos(b) * math.cos(a)]
        assert direction(axes[found.toolpath.line == line])[-1] == pytest.approx(wanted)


def test_the_tool_turns_in_the_plane_of_its_directions() -> None:
    """PATHCTRL VECTOR: every direction on the way is square to the normal of the first and the last; with AXIS it is not."""
    for form, flat in (("VECTOR", True), ("AXIS", False)):
        program = f"{TCPM} PATHCTRL {form}\nL X+0 Y+0 Z+50 A+40 C+0 FMAX\nL X+30 A+50 C+80 F600"
        found = run(program, kinematics="table-ac")
        ways = direction(np.array(found.axes())[found.toolpath.line == 4])
        first = direction(np.array([[0, 0, 0, 40, 0, 0.0]]))[0]
        normal = np.cross(first, ways[-1]) / np.linalg.norm(np.cross(first, ways[-1]))
        assert (np.abs(ways @ normal).max() < 1e-9) == flat


@pytest.mark.parametrize("machine", MACHINES)
def test_an_axis_that_is_free_at_the_start_turns_first(machine: str) -> None:
    """From A0 C0 to the direction Ry(20) Rx(10) Z: C turns to where the way begins, the tip stands; then the tip goes straight
    and the tool turns in the plane of Z and the last direction."""
    found = run("L X+12 Y-7 Z+9 F500\nFUNCTION TCPM F TCP AXIS SPAT PATHCTRL VECTOR\n"
                "L X+20 Y+5 Z+3 A+10 B+20 C+0 F500", kinematics=machine)  # fmt: skip
    axes = between(found, 4)
    begin, end = np.array([12, -7, 9]) + DATUM, np.array([20, 5, 3]) + DATUM
    places, upright = tips(machine, axes), np.abs(axes[:, 3:5]).max(axis=1) < 1e-9
    assert np.abs(places[upright] - begin).max() < 0.0101 and abs(axes[upright][-1, 5]) > 20
    assert off_the_line(places, begin, end) < 0.0101 and places[-1] == pytest.approx(end)
    a, b = math.radians(10), math.radians(20)
    last = np.array([math.sin(b) * math.cos(a), -math.sin(a), math.cos(b) * math.cos(a)])
    ways = found.toolpath.directions[found.toolpath.line == 4]
    assert ways[-1] == pytest.approx(last) and np.abs(ways @ np.cross([0, 0, 1], last)).max() < 1e-9


def test_a_tool_that_would_pass_upright_makes_an_axis_jump() -> None:
    """From A20 to A-20 in one plane the tool passes Z; to A20 C180, the same direction, C would turn by half a turn there."""
    begin = f"{TCPM} PATHCTRL VECTOR\nL X+40 Y+10 Z+50 A+20 C+0 FMAX\n"
    assert run(f"{begin}L A-20 F600", kinematics="table-ac").ok
    alarm = run(f"{begin}L A+20 C+180 F600", kinematics="table-ac", ok=False).alarms[0]
    assert alarm.message.startswith("the rotary axes would have to jump on the way") and alarm.span[:2] == (4, 3)
    assert alarm.hint.startswith("PATHCTRL AXIS")


def test_an_arc_is_one_of_the_part_with_a_tool_that_leans() -> None:
    found = run("L A+30 C+20 FMAX M128\nL X+20 Y+0 Z+10 FMAX\nCC X+0 Y+0\nC X+20 Y+0 DR+ F500 M3", kinematics="table-ac")
    assert found.toolpath[-1].kind == Kind.ARC and abs(found.toolpath[-1].sweep) == pytest.approx(math.tau)
    assert found.toolpath.end[-1] == pytest.approx([20, 0, 10])


@pytest.mark.parametrize("end", ["M129", "FUNCTION RESET TCPM"])
def test_the_end_counts_again_as_before(end: str) -> None:
    """No axis moves; X Y Z count from the datum along the machine, or in the tilted plane with its axes."""
    found = run(f"M128\nL X+20 Y+0 Z+10 A+30 FMAX\n{end}\nL X+1 Y+2 Z+90 FMAX", kinematics="table-ac")
    assert np.array(found.axes())[-1] == pytest.approx([12, -11, 107 + LENGTH, 30, 0, 0])
    tilted = "PLANE SPATIAL SPA+30 SPB+0 SPC+0 TURN FMAX\n"
    led = f"{tilted}{TCPM}\nL X+5 A+10 C+5 FMAX\n{end}\nL X+1 Y+2 Z+90 A+30 C+0 FMAX"
    one = run(led, kinematics="table-ac")
    other = run(f"{tilted}L X+1 Y+2 Z+90 FMAX", kinematics="table-ac")
    assert np.array(one.axes())[-1] == pytest.approx(np.array(other.axes())[-1])


def test_another_tool_while_the_tip_is_led() -> None:
    """The head leans B30: a tool 50 longer has its tip 50 further along it, and goes to the same place."""
    found = run("L B+30 FMAX M128\nL X+0 Y+0 Z+50 FMAX\nTOOL CALL 2 Z S1000\nL X+0 Y+0 Z+50 FMAX", kinematics="head-bc")
    axes = np.array(found.axes())
    assert tips("head-bc", axes[-1:], 130)[0] == pytest.approx(DATUM + (0, 0, 50))
    jump = axes[found.toolpath.line == 4][-1] - axes[found.toolpath.line == 3][-1]
    assert jump == pytest.approx(np.zeros(6), abs=1e-9)


@pytest.mark.parametrize("machine", MACHINES)
def test_machine_coordinates_are_those_of_the_axes(machine: str) -> None:
    """M91 counts the spindle reference, without datum, tilt and length; FN 18 reads it, and M92 counts from its own place."""
    tilting = TILTS[machine]
    found = run(
        f"PLANE SPATIAL SPA+10 SPB+25 SPC+0 TURN FMAX\nL X+5 Y+6 Z+200 FMAX\nL Z+300 R0 FMAX M91\nL X-7 {tilting}+3 FMAX M91\n"
        "FN 18: SYSREAD Q1 = ID240 NR1 IDX1\nFN 18: SYSREAD Q2 = ID240 NR1 IDX3\nL IX+2 FMAX M92",
        kinematics=machine, m92_x=100,
    )  # fmt: skip
    axes = np.array(found.axes())
    before, lifted, turned = (axes[found.toolpath.line == line][-1] for line in (3, 4, 5))
    assert lifted == pytest.approx([before[0], before[1], 300, *before[3:]])
    assert turned[[0, 1, 2]] == pytest.approx([-7, before[1], 300]) and turned[3 + "ABC".index(tilting)] == pytest.approx(3)
    assert (found.variables["Q1"], found.variables["Q2"]) == pytest.approx((-7, 300))
    assert axes[-1, 0] == pytest.approx(-5)


def test_angles_where_the_axes_stand_turn_nothing() -> None:
    """Ten degrees are a number that rad round: said once more they are no turn, under compensation neither."""
    found = run("L C+10 FMAX\nL X+5 Y+0 C+10 RL F500 M3\nL X+30 C+10\nL Y+50 R0", kinematics="table-ac")
    assert [Kind(kind).name for kind in found.toolpath.kind[-3:]] == ["LINE"] * 3
    assert np.isnan(found.toolpath.time[-3:]).all()


def test_a_shift_and_a_mirror_image_of_rotary_axes() -> None:
    found = run("TRANS DATUM AXIS C+30\nL C+10 FMAX\nCYCL DEF 8.0 M\nCYCL DEF 8.1 C\nL C+10 FMAX", kinematics="table-ac")
    assert [float(found.axes().C[found.toolpath.line == line][-1]) for line in (3, 6)] == pytest.approx([40, 20])


def test_where_the_axes_stand_at_the_start() -> None:
    """Home of the axes, and the spindle at the start of the setup."""
    machine = mnc.Kinematics(table=(mnc.Axis("A", centre=(0, 0, 50), home=30), mnc.Axis("C", home=20)))
    found = run("L X+1 FMAX\n", kinematics=machine, start=(0, 0, 300), presets={})
    axes = np.array(found.axes())
    assert axes[0] == pytest.approx([0, 0, 300, 30, 0, 20]) and axes[-1] == pytest.approx([1, 0, 300, 30, 0, 20])


def test_the_same_without_a_kinematics_is_refused_as_before() -> None:
    for program, message in (
        ("L C+10 FMAX M126", "C under M126 (shortest way of rotary axes) is not built yet"),
        ("FUNCTION TCPM F TCP AXIS POS", "FUNCTION TCPM needs the kinematics of the machine"),
        ("M138 A", "M138 needs the kinematics of the machine"),
    ):
        alarm = run(program, ok=False).alarms[0]
        assert alarm.message == message and alarm.span.line == 2


BLOCKS = st.sampled_from([
    "L X+{x} Y-{y} FMAX", "L Z+{z} F500", "L A+{a} C-{b} FMAX", "L X+{x} A-{a} C+{b} F300", "L B+{a} C+{y} F900", "M128", "M129",
    "FUNCTION TCPM F CONT AXIS POS PATHCTRL VECTOR", "FUNCTION TCPM F TCP AXIS SPAT PATHCTRL AXIS", "FUNCTION RESET TCPM",
    "PLANE SPATIAL SPA+{a} SPB-{b} SPC+{y} TURN FMAX", "PLANE SPATIAL SPA+{a} SPB-{b} SPC+0 STAY SEQ-", "PLANE RESET TURN F900",
    "PLANE EULER EULPR+{a} EULNU+{b} EULROT+{y} MOVE DIST{x} F800", "PLANE RELATIV SPB+{a} TURN MB MAX FMAX", "PLANE RESET STAY",
    "PLANE AXIAL A+{a} C-{b} MOVE FMAX", "PLANE AXIAL B+{a} STAY", "PLANE PROJECTED PROPR+{a} PROMIN-{b} ROT+{y} TURN FMAX SYM-",
    "M126", "M127", "M116", "M117", "M138 C", "M138", "M140 MB{x}", "M140 MB MAX", "M94", "L IX+{x} FMAX M91", "L X+{x} RL F200",
    "L X+{y} R0 F200", "CC X+0 Y+0", "C X+{x} Y+{y} DR+ F200", "CYCL DEF 10.0 R\nCYCL DEF 10.1 ROT+{a}", "TOOL CALL 2 Z",
    "CYCL DEF 19.0 P\nCYCL DEF 19.1 A+{a} B+{b} F300 ABST{x}", "CYCL DEF 19.0 P\nCYCL DEF 19.1", "TRANS DATUM AXIS X+{x} A+{a}",
    "CYCL DEF 8.0 M\nCYCL DEF 8.1 Y", "CYCL DEF 247 Q339=+1", "CYCL CALL", "L X+1 Y+1 FMAX M99",
    "CYCL DEF 32.0 T\nCYCL DEF 32.1 T{y}",
    "CYCL DEF 200 Q200=2 Q201=-{y} Q206=150 Q202=7 Q210=0 Q203=0 Q204=50 Q211=0 Q395=0", "FN 18: SYSREAD Q1 = ID240 NR1 IDX2",
])  # fmt: skip
NUMBER = st.one_of(st.sampled_from([0, 90, 180, 360]), st.floats(0, 400).map(lambda value: round(value, 3)))


@settings(max_examples=150, deadline=None)
@given(
    blocks=st.lists(st.tuples(BLOCKS, NUMBER, NUMBER, NUMBER, NUMBER, NUMBER), min_size=1, max_size=12),
    machine=st.sampled_from([*MACHINES, None]),
)
def test_random_programs_end_or_are_refused(blocks: list, machine: str | None) -> None:
    """Nothing but alarms, with their places; rows go on where the last one ended, and forward leads from the axes to them."""
    program = "\n".join(block.format(x=x, y=y, z=z, a=a, b=b) for block, x, y, z, a, b in blocks)
    presets = {0: (1, 2, 3), 1: mnc.Datum(4, 5, 6, rotation=10)}
    found = run(program, kinematics=machine, ok=None, presets=presets, tcpm_tolerance=1.0)
    assert all(alarm.span is not None and alarm.span.line >= 1 for alarm in found.alarms)
    if machine is not None and len(found.toolpath):
        lengths = np.where(found.toolpath.tool == 2, 130.0, np.where(found.toolpath.tool == 1, 80.0, 0.0))
        rows = zip(np.array(found.axes()), lengths, strict=True)
        ends = np.concatenate([tips(machine, row[None], length) for row, length in rows])
        assert np.abs(ends - found.toolpath.origin - found.toolpath.end).max() < 1e-6
