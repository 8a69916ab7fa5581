"""Every form of APPR and DEP for a tool of radius 5; places worked out by hand.

The contour is one line up the Y axis, from (0, 0) to (0, 40), with RL: the tool touches it at (-5, 0) and at (-5, 40).
"""

from __future__ import annotations

import math

import pytest

import mnclab as mnc
from mnclab import Kind

Rows = list[tuple[str, list[float], float]]


def shown(run: mnc.Run, label: str) -> Rows:
    """Kind, end and sweep in degrees of the rows with a label."""
    assert run.ok, run.alarms
    rows = [m for m in run.toolpath.motion if m.label == label]
    return [(m.kind.name, [round(v, 6) + 0.0 for v in m.end.tolist()], round(math.degrees(m.sweep), 6)) for m in rows]


APPROACHES = [
    # 10 mm before the contact along the contour, square to it, on an arc of radius 8 about (-13, 0) or (3, 0)
    ("LT X+0 Y+0 LEN10", [("LINE", [-5, -10, 0], 0), ("LINE", [-5, 0, 0], 0)]),
    ("LN X+0 Y+0 LEN10", [("LINE", [-15, 0, 0], 0), ("LINE", [-5, 0, 0], 0)]),
    ("CT X+0 Y+0 CCA90 R+8", [("LINE", [-13, -8, 0], 0), ("ARC", [-5, 0, 0], 90)]),
    ("CT X+0 Y+0 CCA90 R-8", [("LINE", [3, -8, 0], 0), ("ARC", [-5, 0, 0], -90)]),
    ("CT X+0 Y+0 CCA180 R+3", [("LINE", [-11, 0, 0], 0), ("ARC", [-5, 0, 0], 180)]),  # smaller than the tool
    ("CT X+0 Y+0 CCA360 R+8", [("LINE", [-5, 0, 0], 0), ("ARC", [-5, 0, 0], 360)]),
    # from (-45, -8) the line Y = -8 touches the arc at (-13, -8)
    ("LCT X+0 Y+0 R8", [("LINE", [-13, -8, 0], 0), ("ARC", [-5, 0, 0], 90)]),
    # the height is reached on the way to the auxiliary point
    ("LT X+0 Y+0 Z-6 LEN10", [("LINE", [-5, -10, -6], 0), ("LINE", [-5, 0, -6], 0)]),
    ("LCT X+0 Y+0 IZ-6 R8", [("LINE", [-13, -8, -6], 0), ("ARC", [-5, 0, -6], 90)]),
    # incremental from (-45, -8), and polar about (0, -20)
    ("LN IX+45 IY+8 LEN2.5", [("LINE", [-7.5, 0, 0], 0), ("LINE", [-5, 0, 0], 0)]),
    ("PLT PR+20 PA+90 LEN10", [("LINE", [-5, -10, 0], 0), ("LINE", [-5, 0, 0], 0)]),
    ("PLN PR+20 PA+90 LEN10", [("LINE", [-15, 0, 0], 0), ("LINE", [-5, 0, 0], 0)]),
    ("PCT PR+20 PA+90 CCA90 R+8", [("LINE", [-13, -8, 0], 0), ("ARC", [-5, 0, 0], 90)]),
    ("PLCT PR+20 PA+90 Z-1 R8", [("LINE", [-13, -8, -1], 0), ("ARC", [-5, 0, -1], 90)]),
]


@pytest.mark.parametrize(("form", "rows"), APPROACHES, ids=[form for form, _ in APPROACHES])
def test_approach(form: str, rows: Rows, inside) -> None:
    run = inside(f"2 CC X+0 Y-20\n3 L X-45 Y-8\n4 APPR {form} RL F200\n5 L X+0 Y+40\n6 L X-50 R0")
    assert shown(run, "approach") == rows
    body = run.toolpath.motion[3]
    assert body.start[:2].tolist() == pytest.approx([-5, 0]) and body.end[:2].tolist() == pytest.approx([-5, 40])
    for arc in run.toolpath[run.toolpath.kind == Kind.ARC]:
        assert math.dist(arc.centre, arc.start) == pytest.approx(math.dist(arc.centre, arc.end))
        assert arc.centre[2] == arc.start[2]


DEPARTURES = [
    ("LT LEN10", [("LINE", [-5, 50, 0], 0)]),
    ("LN LEN10", [("LINE", [-15, 40, 0], 0)]),  # LEN and the radius of the tool from the contour
    ("CT CCA90 R+8", [("ARC", [-13, 48, 0], 90)]),
    ("CT CCA90 R-8", [("ARC", [3, 48, 0], -90)]),
    ("LCT X-45 Y+48 R8", [("ARC", [-13, 48, 0], 90), ("LINE", [-45, 48, 0], 0)]),
    ("LT Z+7 LEN10", [("LINE", [-5, 50, 7], 0)]),
    ("CT CCA90 R+8 IZ+7", [("ARC", [-13, 48, 7], 90)]),
    ("LCT X-45 Y+48 Z+7 R8", [("ARC", [-13, 48, 0], 90), ("LINE", [-45, 48, 7], 0)]),
    ("LCT IX-45 IY+8 R8", [("ARC", [-13, 48, 0], 90), ("LINE", [-45, 48, 0], 0)]),
    ("PLCT PR+48 PA+90 R8", [("ARC", [-13, 48, 0], 90), ("LINE", [-45, 48, 0], 0)]),
]


@pytest.mark.parametrize(("form", "rows"), DEPARTURES, ids=[form for form, _ in DEPARTURES])
def test_departure(form: str, rows: Rows, inside) -> None:
    """The register is where the tool ends, and the compensation is off."""
    run = inside(f"2 CC X-45 Y+0\n3 L X-45 Y+0\n4 L X+0 Y+0 RL\n5 L X+0 Y+40\n6 DEP {form} F50\n7 L IX+1")
    assert shown(run, "departure") == rows
    leaving = run.toolpath[run.toolpath.line == 7]
    assert (leaving.feed == 50).all() and leaving.start[0].tolist() == pytest.approx([-5, 40, 0])
    x, y, z = rows[-1][1]
    assert run.toolpath.motion.end[-1].tolist() == pytest.approx([x + 1, y, z])
    assert run.toolpath.motion.side[-1] == 0 and run.toolpath.motion.feed[-1] == 50


@pytest.mark.parametrize(
    ("before", "form", "feeds"),
    [
        ("F80", "LT X+0 Y+0 LEN10 RL F200", [80, 200]),  # the auxiliary point at the feed of the block before
        ("FMAX", "LT X+0 Y+0 LEN10 RL F200", [math.inf, 200]),
        ("FMAX", "CT X+0 Y+0 CCA90 R8 RL", [math.inf, 100]),
        ("F80", "LCT X+0 Y+0 R8 RL F200", [200, 200]),  # LCT: the whole way at the feed of its block
        ("FMAX", "LCT X+0 Y+0 R8 RL F200", [200, 200]),
        ("F80", "LN X+0 Y+0 LEN10 RL FAUTO", [80, 100]),
    ],
)
def test_feeds_of_an_approach(before: str, form: str, feeds: list[float], inside) -> None:
    run = inside(f"2 L X-45 Y-8 {before}\n3 APPR {form}\n4 L X+0 Y+40\n5 L X-50 R0")
    assert run.ok, run.alarms
    lead = run.toolpath[run.toolpath.line == 4]
    assert lead.feed.tolist() == feeds and (lead.kind[0] == Kind.RAPID) == math.isinf(feeds[0])


def test_right_of_the_contour(inside) -> None:
    """RR: the mirror image in X; a positive radius turns clockwise."""
    run = inside("2 L X+45 Y-8\n3 APPR CT X+0 Y+0 CCA90 R+8 RR\n4 L X+0 Y+40\n5 DEP CT CCA90 R+8\n")
    assert shown(run, "approach") == [("LINE", [13, -8, 0], 0), ("ARC", [5, 0, 0], -90)]
    assert shown(run, "departure") == [("ARC", [13, 48, 0], -90)]


@pytest.mark.parametrize("word", ["RR", "RL"])
def test_an_approach_from_a_contour_that_is_still_compensated(word: str, inside) -> None:
    """From where the tool stands, (-5, 40), to the second contour down X = 30: RR is its side -X, RL its side +X."""
    run = inside(f"2 L X-45 Y+0\n3 L X+0 Y+0 RL\n4 L X+0 Y+40\n5 APPR LT X+30 Y+40 LEN10 {word}\n6 L Y+0\n7 L X+60 R0")
    x = 25 if word == "RR" else 35
    assert shown(run, "approach") == [("LINE", [x, 50, 0], 0), ("LINE", [x, 40, 0], 0)]
    assert run.toolpath[run.toolpath.line == 6][0].start.tolist() == pytest.approx([-5, 40, 0])


def test_a_side_that_is_not_written_holds(inside) -> None:
    blocks = "2 L X-45 Y+0\n3 L X+0 Y+0 RL\n4 L X+0 Y+40\n5 APPR LT X+30 Y+40 LEN10\n6 L Y+0\n7 L X+60 R0"
    assert shown(inside(blocks), "approach")[0] == ("LINE", [35, 50, 0], 0)


def test_leads_without_compensation(inside) -> None:
    """LT and LCT need no side: the tool centre itself touches the contour."""
    run = inside("2 L X-45 Y-8\n3 APPR LT X+0 Y+0 LEN10 R0\n4 L X+0 Y+40\n5 DEP LCT X-40 Y+48 R8")
    assert shown(run, "approach") == [("LINE", [0, -10, 0], 0), ("LINE", [0, 0, 0], 0)]
    assert shown(run, "departure") == [("ARC", [-8, 48, 0], 90), ("LINE", [-40, 48, 0], 0)]


def test_a_tool_that_stands_at_the_auxiliary_point_makes_no_empty_row(inside) -> None:
    run = inside("2 L X-5 Y-10\n3 APPR LT X+0 Y+0 LEN10 RL\n4 L X+0 Y+40\n5 L X-50 R0")
    assert shown(run, "approach") == [("LINE", [-5, 0, 0], 0)]


def test_approach_to_an_arc(inside) -> None:
    """Circle of 25 about (35, 50), clockwise from (10, 50), RL outside: a quarter of radius 5 ends at (5, 50)."""
    run = inside("2 L X-40 Y+50\n3 APPR CT X+10 Y+50 CCA90 R+5 RL\n4 CC X+35 Y+50\n5 C X+10 DR-\n6 DEP CT CCA90 R+5")
    assert shown(run, "approach") == [("LINE", [0, 45, 0], 0), ("ARC", [5, 50, 0], 90)]
    assert shown(run, "departure") == [("ARC", [0, 55, 0], 90)]


def test_full_circle_with_a_tool_greater_than_the_approach(inside) -> None:
    """Arcs of radius 3 belong to the tool centre, whatever the radius of the tool: (-5 - 3, 47) to (-5, 50) and off."""
    run = inside("2 L X-40 Y+47\n3 APPR LCT X+0 Y+50 R3 RL F300\n4 CC X+50 Y+50\n5 C X+0 DR-\n6 DEP LCT X-40 Y+53 R3")
    assert shown(run, "approach") == [("LINE", [-8, 47, 0], 0), ("ARC", [-5, 50, 0], 90)]
    assert shown(run, "departure") == [("ARC", [-8, 53, 0], 90), ("LINE", [-40, 53, 0], 0)]


LEADS = "2 L X-45 Y-8\n3 APPR LCT X+0 Y+0 R8 RL\n4 L X+0 Y+40\n5 RND R6\n6 L X+30\n7 DEP CT CCA60 R+4\n8 L IX+5"


def test_in_a_turned_system(inside) -> None:
    """Turned by 90 degrees: (x, y) goes to (-y, x)."""
    straight, turned = inside(LEADS), inside("2 CYCL DEF 10.0 R\n2 CYCL DEF 10.1 ROT+90\n" + LEADS)
    assert turned.ok, turned.alarms
    wanted = [v for x, y, z in straight.toolpath.motion.end.tolist() for v in (-y, x, z)]
    assert turned.toolpath.motion.end.ravel().tolist() == pytest.approx(wanted, abs=1e-9)


def test_the_first_element_may_be_rounded(inside) -> None:
    """The contact belongs to the contour as written: a rounding after the first element does not move it."""
    run = inside(LEADS)
    assert shown(run, "approach") == [("LINE", [-13, -8, 0], 0), ("ARC", [-5, 0, 0], 90)]


def test_a_program_that_breaks_off_after_an_approach(inside) -> None:
    """The fault of line 6 leaves the approach, whose tangent is known, and not the element whose end is not."""
    run = inside("2 L X-45 Y-8\n3 APPR LCT X+0 Y+0 R8 RL\n4 L X+0 Y+40\n5 L X+5 X+6\n")
    assert [a.span.line for a in run.alarms] == [6]
    rows = [m for m in run.toolpath.motion if m.label == "approach"]
    assert [m.end[:2].tolist() for m in rows] == [pytest.approx([-13, -8]), pytest.approx([-5, 0])]
    assert run.toolpath.line.max() == 4


def test_a_program_that_breaks_off_in_the_middle_of_an_approach(inside) -> None:
    run = inside("2 L X-45 Y-8\n3 APPR LCT X+0 Y+0 R8 RL\n4 L X+5 X+6\n")
    assert [a.span.line for a in run.alarms] == [5] and run.toolpath.line.max() == 3


def test_a_recorded_contour_begins_at_its_first_point_and_ends_at_its_last(inside) -> None:
    """A label for the contour cycles may have leads: the same pocket as without them."""
    area = "CYCL DEF 20 CONTOUR\nQ1=-5\nQ2=1\nQ3=+0\nQ4=+0\nQ5=+0\nQ6=2\nQ7=+50\nQ8=0.5\nQ9=+1\n"
    rough = "CYCL DEF 22 ROUGH\nQ10=-5\nQ11=100\nQ12=500\nQ18=0\nQ19=0\nQ208=500\nQ401=100\nQ404=0\n"
    head = f"2 CYCL DEF 14.0 C\n2 CYCL DEF 14.1 LABEL 1\n{area}{rough}L Z+50 M3\nCYCL CALL\nM2\n3 LBL 1\n"
    body = "L X+60\nL Y+40\nL X+0\nL Y+0\n"
    plain = inside(head + "L X+0 Y+0 RL\n" + body + "LBL 0")
    leads = inside(head + "APPR LT X+0 Y+0 LEN5 RL\n" + body + "DEP LT LEN5\nLBL 0")
    assert plain.ok and leads.ok, (plain.alarms, leads.alarms)
    assert plain.toolpath.motion.end.tolist() == leads.toolpath.motion.end.tolist() and len(plain.toolpath) > 20
