"""RL and RR with tangential approach and departure; positions worked out by hand for a tool of radius 5."""

from __future__ import annotations

import math

import pytest

import mnclab as mnc

RECTANGLE = """\
2 L X-40 Y+10 Z+2 R0 FMAX M3
3 L Z-5 F100
4 APPR LT X+0 Y+20 LEN10 RL F200
5 L Y+40
6 L X+60
7 L Y+0
8 L X+0
9 L Y+20
10 DEP LT LEN15 F500
11 L IX-20
12 L Z+50 FMAX M2
"""


def rows(run: mnc.Run) -> list[tuple[str, list[float], float]]:
    return [(m.kind.name, [round(v, 6) for v in m.end[:2]], m.feed) for m in run.toolpath if m.side]


def test_rectangle_with_approach_and_departure(inside) -> None:
    """Outside, clockwise, RL: the tool runs 5 mm left of the travel.

    The first element goes up (direction +Y) from PA (0, 20), so left of it is -X: the tool reaches the auxiliary point
    10 mm before PA, (0, 10), at (-5, 10), at the feed of the block before. Then up to the corner (0, 40): an arc about
    it to (0, 45); along Y = 45, about (60, 40) to (65, 40), down X = 65, about (60, 0) to (60, -5), back along Y = -5,
    about (0, 0) to (-5, 0), up to (-5, 20), and 15 mm on to (-5, 35).
    """
    run = inside(RECTANGLE)
    assert run.ok, run.alarms
    assert rows(run) == [
        ("LINE", [-5, 10], 100),
        ("LINE", [-5, 20], 200),
        ("LINE", [-5, 40], 200),
        ("ARC", [0, 45], 200),
        ("LINE", [60, 45], 200),
        ("ARC", [65, 40], 200),
        ("LINE", [65, 0], 200),
        ("ARC", [60, -5], 200),
        ("LINE", [0, -5], 200),
        ("ARC", [-5, 0], 200),
        ("LINE", [-5, 20], 200),
    ]
    leave = run.toolpath[run.toolpath.line == 11][0]
    assert (leave.label, leave.end[:2].tolist(), leave.feed) == ("departure", [-5, 35], 500)
    arcs = run.toolpath[run.toolpath.kind == mnc.Kind.ARC]
    assert arcs.sweep.tolist() == pytest.approx([-math.pi / 2] * 4)
    assert arcs.centre[:, :2].tolist() == [[0, 40], [60, 40], [60, 0], [0, 0]]


def test_the_block_after_a_departure_counts_from_where_the_tool_stands(inside) -> None:
    """L IX-20 after (-5, 35): (-25, 35); the compensated point is the register."""
    run = inside(RECTANGLE)
    assert run.at(line=11).position == pytest.approx((-5, 35, -5))
    assert run.at(line=12).position == pytest.approx((-25, 35, -5))
    after = run.toolpath[(run.toolpath.line == 12)]
    assert after.end.tolist() == [pytest.approx([-25, 35, -5])] and after.side.tolist() == [0]


def test_departure_from_an_arc(inside) -> None:
    """RR inside a circle of radius 25 about (35, 50), clockwise from (10, 50): the tool runs on radius 20.

    The approach: the tangent at (10, 50), clockwise, is +Y; 8 mm before it (10, 42), 5 mm to the right (15, 42). After a
    full turn the same tangent: 10 mm on from (15, 50) to (15, 60); L IX+5 IY-10 ends at (20, 50).
    """
    run = inside(
        "2 L X+35 Y+50\n3 APPR LT X+10 Y+50 LEN8 RR\n4 CC X+35 Y+50\n5 C X+10 Y+50 DR-\n6 DEP LT LEN10\n7 L IX+5 IY-10"
    )
    assert run.ok, run.alarms
    assert [row[:2] for row in rows(run)] == [
        ("LINE", [15, 42]),
        ("LINE", [15, 50]),
        ("ARC", [15, 50]),
    ]
    assert run.toolpath[run.toolpath.line == 7].end[:, :2].tolist() == [pytest.approx([15, 60])]
    assert run.toolpath.end[-1].tolist() == pytest.approx([20, 50, 0])


def test_departure_in_a_turned_system(inside) -> None:
    """The whole rectangle turned by 90 degrees: (x, y) goes to (-y, x); the register stays in program coordinates."""
    turn = "2 CYCL DEF 10.0 R\n2 CYCL DEF 10.1 ROT+90\n"
    straight, turned = inside(RECTANGLE), inside(turn + RECTANGLE)
    assert turned.ok, turned.alarms
    a, b = straight.toolpath.motion.end, turned.toolpath.motion.end
    assert b.ravel().tolist() == pytest.approx([v for x, y, z in a.tolist() for v in (-y, x, z)], abs=1e-9)
    assert turned.at(line=14).position == pytest.approx((-25, 35, -5))


def test_pocket_with_inside_corners(inside) -> None:
    """A 40 x 30 pocket from (0, 0), counter-clockwise with RL inside: corners where the parallels at 5 mm meet."""
    run = inside("2 L X+20 Y+15\n3 L Y+0 RL\n4 L X+40\n5 L Y+30\n6 L X+0\n7 L Y+0\n8 L X+20\n9 L Y+15 R0")
    assert run.ok, run.alarms
    assert [end for _, end, _ in rows(run)] == [[20, 5], [35, 5], [35, 25], [5, 25], [5, 5], [20, 5]]
    assert run.toolpath.end[-1].tolist() == [20, 15, 0]


def test_delta_radius_of_tool_call_counts(tnc) -> None:
    """Radius 5 + 0.5: the parallel to the X axis runs at Y = 5.5."""
    run = tnc("1 TOOL CALL 1 Z F100 DR+0.5\n2 L X+10 RL\n3 L X+20\n4 L X+30\n")
    assert run.toolpath.end[1:, 1].tolist() == [5.5, 5.5, 5.5]


def test_departure_after_plain_lines_in_bulk(inside) -> None:
    """Rows of long runs are columns; the departure still finds the tangent of the last one."""
    blocks = "2 L X-10 RL\n" + "\n".join(f"L X+{k}" for k in range(100)) + "\nDEP LT LEN5\nL IX+1\n"
    run = inside(blocks)
    assert run.ok and run.toolpath.end[-1].tolist() == pytest.approx([105, 5, 0])


def test_repeating_the_side_in_an_arc_is_no_beginning(inside) -> None:
    run = inside("2 L X+10 RL\n3 L X+20\n4 CR X+20 Y+40 R20 DR+ RL F50\n5 L X+10\n6 L X+0 R0")
    assert run.ok, run.alarms


def test_entry_and_exit_at_rapid(inside) -> None:
    """Square to the contour at both ends: in to (10, 5), along to (30, 5), out to (30, 40)."""
    run = inside("2 L X+10 RL FMAX\n3 L X+30\n4 L Y+40 R0 FMAX")
    assert run.ok, run.alarms
    assert [(m.kind.name, m.end[:2].tolist()) for m in run.toolpath.motion] == [
        ("RAPID", [10, 5]), ("LINE", [30, 5]), ("RAPID", [30, 40]),
    ]  # fmt: skip


def test_island_of_section_8_3(inside) -> None:
    """Clockwise about (65, 50) with radius 25 from (40, 50), RL outside: the tool runs on radius 30 from (35, 50)."""
    run = inside("2 L X+20 Y+50\n3 L X+40 Y+50 RL\n4 CC X+65 Y+50\n5 C X+40 Y+50 DR-\n6 L X+20 Y+50 R0")
    assert run.ok, run.alarms
    arc = run.toolpath[run.toolpath.kind == mnc.Kind.ARC][0]
    assert arc.start[:2].tolist() == pytest.approx([35, 50]) and arc.end[:2].tolist() == pytest.approx([35, 50])
    assert arc.centre[:2].tolist() == [65, 50] and arc.sweep == pytest.approx(-2 * math.pi)
