"""Calls of a cycle: at a position, in every block, at the points of a pattern; what is refused, with line and column."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import mnclab as mnc
from mnclab.path.toolpath import COLUMNS
from mnclab.running import repeating
from mnclab.running.interpreter import Interpreter

CYCLE = "CYCL DEF 200 D\nQ200=2\nQ201=-15\nQ206=250\nQ202=0\nQ210=0\nQ203={Q203}\nQ204={Q204}\nQ211=0\n"
D = "2 " + CYCLE.format(Q203=0, Q204=20)  # lines 3 to 11
HIGH = "3 L Z+50 R0 FMAX M3\n"
TWO = "4 PATTERN DEF POS1 (X+10 Y+10 Z+0) POS2 (X+30 Y+10 Z+0)\n"


def holes(run: mnc.Run) -> list[tuple[float, float, float]]:
    """Place and bottom of every hole."""
    assert run.ok, run.alarms
    path = run.toolpath
    down = (path.kind == mnc.Kind.LINE) & (path.end[:, 2] < path.start[:, 2]) & (path.end[:, 0] == path.start[:, 0])
    return [tuple(end) for end in path.end[down].tolist()]


def ends(run: mnc.Run) -> list[list[float]]:
    """The ends of all moves from HIGH on."""
    assert run.ok, run.alarms
    path = run.toolpath
    return path.end[path.is_motion][1:].tolist()


# --- M99 and M89 ------------------------------------------------------------------------------------------------------


def test_m89_until_m99(inside) -> None:
    """Each positioning block drills, whatever its statement; blocks that position nothing do not."""
    run = inside(
        f"{D}{HIGH}4 L X+10 Y+10 FMAX M89\n5 L X+20\n6 Q1 = 5\n7 L F500\n8 CC X+30 Y+10\n9 C X+30 Y+20 DR- F200\n"
        "10 CR X+40 Y+30 R+20 DR-\n11 L IX+1 FMAX M99\n12 L X+99"
    )
    assert [hole[:2] for hole in holes(run)] == [(10, 10), (20, 10), (30, 20), (40, 30), (41, 30)]


def test_m89_goes_with_polar_blocks(inside) -> None:
    run = inside(
        f"{D}{HIGH}4 CC X+0 Y+0\n5 L X+10 Y+0 FMAX M89\n6 LP PR+20 PA+90 FMAX\n7 CP PA+180 DR+ F200\n8 LP PR+5 M99"
    )
    assert np.array(holes(run))[:, :2] == pytest.approx(np.array([[10, 0], [0, 20], [-20, 0], [-5, 0]]))


def test_m89_drills_after_a_move_of_the_tool_axis_too(inside) -> None:
    """The text excepts no positioning block: M89 is to be cancelled before the tool is retracted."""
    run = inside(f"{D}{HIGH}4 L X+10 Y+10 FMAX M89\n5 L Z+90\n6 L X+20 M99")
    assert len(holes(run)) == 3


def test_m89_ends_with_a_new_cycle_but_not_with_a_transformation(inside) -> None:
    shift = "5 CYCL DEF 7.0 S\n6 CYCL DEF 7.1 X+100\n"
    run = inside(
        f"{D}{HIGH}4 L X+10 Y+10 FMAX M89\n{shift}7 L X+0\n8 {CYCLE.format(Q203=0, Q204=20)}9 L X+5\n10 L X+6 M99"
    )
    assert [hole[0] for hole in holes(run)] == [10, 100, 106]


def test_a_block_under_m89_is_explained(inside) -> None:
    run = inside(f"{D}{HIGH}4 L X+10 Y+10 FMAX M89\n5 L X+20 FMAX")
    title = "Cycle call in every positioning block"
    said = {line: [(m.word, m.says) for m in run.explain(line=line).meanings] for line in (13, 14)}
    assert said[13][0] == said[14][0] == ("L", "Straight line")
    assert said[13][-1] == ("M89", title) and said[14][-1] == ("(M89)", f"{title}, active from before")


def test_m89_drills_in_long_runs_of_plain_blocks(inside) -> None:
    """Fifty blocks that the bulk tier would take."""
    blocks = "\n".join(f"{k} L X{k} R0" for k in range(10, 60))
    run = inside(f"{D}{HIGH}4 L X+0 Y+0 FMAX M89\n{blocks}\n60 L X+60 M99")
    assert [hole[0] for hole in holes(run)] == [0, *range(10, 60), 60]


# --- CYCL CALL POS ----------------------------------------------------------------------------------------------------


def test_at_a_position_from_above(inside) -> None:
    """S = 0 + 5: in the plane at 50, to 7 at the feed of the block, the cycle to -10, and up to 25."""
    run = inside(f"{D}{HIGH}4 CYCL CALL POS X+20 Y+50 Z+5 F300\n5 L X+1")
    assert ends(run) == [[20, 50, 50], [20, 50, 7], [20, 50, -10], [20, 50, 25], [1, 50, 25]]
    feeds = run.toolpath.feed[run.toolpath.kind == mnc.Kind.LINE].tolist()
    assert feeds == [300, 300, 250, 100]  # F of the block is for its approach alone: F100 of TOOL CALL holds


def test_at_a_position_from_below(inside) -> None:
    """From Z-3 below S = 5: up to S + 20 first, then in the plane."""
    run = inside(f"{D}3 L Z-3 R0 FMAX M3\n4 CYCL CALL POS X+20 Y+50 Z+5 FMAX")
    assert ends(run) == [[0, 0, 25], [20, 50, 25], [20, 50, 7], [20, 50, -10], [20, 50, 25]]


def test_the_shift_of_a_position_is_gone_afterwards(inside) -> None:
    run = inside(f"{D}{HIGH}4 CYCL CALL POS X+20 Y+50 Z+5 FMAX\n5 L X+30 M99\n6 CYCL CALL POS IX+1 IY-1 IZ+10 FMAX")
    assert [hole[:3] for hole in holes(run)] == [(20, 50, -10), (30, 50, -15), (31, 49, 15)]


def test_at_a_position_in_turned_coordinates(inside) -> None:
    run = inside(f"{D}{HIGH}4 CYCL DEF 10.0 R\n5 CYCL DEF 10.1 ROT+90\n6 CYCL CALL POS X+20 Y+0 Z+5 FMAX")
    path = run.toolpath
    assert path.end[path.kind == mnc.Kind.LINE] == pytest.approx(np.array([[0, 20, -10]]))


# --- CYCL CALL PAT ----------------------------------------------------------------------------------------------------


def test_feed_and_m_of_the_call(inside) -> None:
    run = inside(f"{D}3 L Z+50 R0 FMAX\n{TWO}5 CYCL CALL PAT F5000 M13")
    path = run.toolpath
    assert run.alarms == () and [hole[:2] for hole in holes(run)] == [(10, 10), (30, 10)]
    assert path.feed[path.kind == mnc.Kind.LINE].tolist() == [5000, 250, 5000, 250]
    assert run.history["feed"][-1] == 5000


def test_without_a_feed_the_last_one_counts(inside) -> None:
    path = inside(f"{D}{HIGH}{TWO}5 CYCL CALL PAT").toolpath
    assert path.feed[path.kind == mnc.Kind.LINE].tolist() == [100, 250, 100, 250]


@pytest.mark.parametrize(
    ("definition", "at", "height"),
    [("", 50, 50), ("", 5, 20), ("3 GLOBAL DEF 125 P\nQ345=+1\n", 50, 20), ("3 GLOBAL DEF 125 P\nQ345=0\n", 50, 50),
     ("3 GLOBAL DEF 125 P\nQ345=0\n", 5, 5), ("3 GLOBAL DEF 125 P\nQ345=0\n", 1, 2)],
)  # fmt: skip
def test_the_height_between_the_points(definition: str, at: float, height: float, inside) -> None:
    """The greater of Q204 and where the tool stood; one of them with GLOBAL DEF 125, never below the set-up plane 2."""
    path = inside(f"{D}{definition}4 L Z+{at} R0 FMAX M3\n{TWO}5 CYCL CALL PAT FMAX").toolpath
    across = (path.kind == mnc.Kind.RAPID) & (path.start[:, 0] == 10) & (path.end[:, 0] == 30)
    assert path.end[across][:, 2].tolist() == [height] and path.end[-1, 2] == height


def test_points_on_different_surfaces(inside) -> None:
    """Z 0, 30, 10 with Q204 = 20: heights 20, 50, 30; from 20 up to 50 before the move, from 50 to 30 after it."""
    points = "4 PATTERN DEF POS1 (X+1 Y+0 Z+0) POS2 (X+2 Y+0 Z+30) POS3 (X+3 Y+0 IZ-20)\n"
    run = inside(f"{D}3 L Z+5 R0 FMAX M3\n{points}5 CYCL CALL PAT FMAX")
    assert ends(run) == [
        [0, 0, 20], [1, 0, 20], [1, 0, 2], [1, 0, -15], [1, 0, 20], [1, 0, 50], [2, 0, 50], [2, 0, 32], [2, 0, 15], [2, 0, 50],
        [3, 0, 50], [3, 0, 12], [3, 0, -5], [3, 0, 30],
    ]  # fmt: skip


def test_the_pattern_defined_last_counts(inside) -> None:
    run = inside(f"{D}{HIGH}{TWO}5 PATTERN DEF POS1 (X+7 Y+8 Z+0)\n6 CYCL CALL PAT FMAX\n7 CYCL CALL PAT FMAX")
    assert [hole[:2] for hole in holes(run)] == [(7, 8), (7, 8)]


def test_a_contour_cycle_has_its_datum_at_each_point(inside) -> None:
    """SL cycles: the points are an additional datum shift; the second pocket is the first one, 60 mm away and 5 higher."""
    contour = "LBL 1\nL X+0 Y+0 RR F100\nL Y+30\nL X+40\nL Y+0\nL X+0\nLBL 0\n"
    data = "CYCL DEF 20 C\nQ1=-5\nQ2=1\nQ3=0\nQ4=0\nQ5=0\nQ6=2\nQ7=30\nQ8=0\nQ9=1\n"
    rough = "CYCL DEF 22 R\nQ10=5\nQ11=100\nQ12=200\nQ18=0\nQ19=0\nQ208=FMAX\n"
    points = "PATTERN DEF POS1 (X+0 Y+0 Z+0) POS2 (X+60 Y+10 Z+5)\n"
    run = inside(
        f"2 CYCL DEF 14.0 C\n3 CYCL DEF 14.1 1\n4 {data}5 {rough}{HIGH}6 {points}7 CYCL CALL PAT FMAX\n8 M2\n{contour}"
    )
    assert run.ok, run.alarms
    cut = run.toolpath.end[run.toolpath.kind == mnc.Kind.LINE]
    half = len(cut) // 2
    assert half > 4 and cut[half:] - cut[:half] == pytest.approx(np.tile([60.0, 10, 5], (half, 1)))


@pytest.mark.parametrize(("unit", "scale"), [("MM", 1), ("INCH", 25.4)])
def test_the_height_of_a_contour_cycle(unit: str, scale: float, tnc) -> None:
    """Between the points at Q7 + Z, whatever Q5 is, in both units: to (0, 0) at 3 + 1, and to (60, 0) at 3 + 2."""
    contour = "LBL 1\nL X+0 Y+0 RR F100\nL Y+30\nL X+40\nL Y+0\nL X+0\nLBL 0\n"
    data = "CYCL DEF 20 C\nQ1=-2\nQ2=1\nQ3=0\nQ4=0\nQ5=1\nQ6=1\nQ7=3\nQ8=0\nQ9=1\n"
    rough = "CYCL DEF 22 R\nQ10=5\nQ11=100\nQ12=200\nQ18=0\nQ19=0\nQ208=FMAX\n"
    run = tnc(f"0 BEGIN PGM A {unit}\n1 TOOL CALL 1 Z S1000\n2 CYCL DEF 14.0 C\n3 CYCL DEF 14.1 1\n{data}{rough}"
              "4 L X+0 Y-9 Z+2 R0 FMAX M3\nPATTERN DEF POS1 (X+0 Y+0 Z+1) POS2 (X+60 Y+0 Z+2)\nCYCL CALL PAT FMAX\nM2\n"
              f"{contour}")  # fmt: skip
    assert run.ok, run.alarms
    path = run.toolpath
    to_points = [k for k, label in enumerate(path.label) if path.labels[label] == "CYCL CALL PAT to the point"]
    across = [k for k in to_points if path.start[k, :2].tolist() != path.end[k, :2].tolist()]
    assert path.end[across] / scale == pytest.approx(np.array([[0, 0, 4], [60, 0, 5]]))
    assert path.end[:, 2].min() / scale == pytest.approx(0) and path.end[-1, 2] / scale == pytest.approx(5)


def test_the_points_of_a_pattern_need_the_tool_axis_z() -> None:
    """PATTERN DEF works out X and Y; with another plane the call is refused."""
    control = mnc.controls["tnc-620"]
    program = control.read(f"0 BEGIN PGM A MM\n1 TOOL CALL 1 Z S1000 F100\n{D}{HIGH}{TWO}5 CYCL CALL PAT FMAX\n", "a.h")
    interpreter = Interpreter(control, mnc.Setup(), program)
    machine = interpreter.machine
    interpreter.flow.section(machine, 0, len(program) - 1)
    machine.change("plane", "YZ")
    with pytest.raises(mnc.Alarm, match="the tool axis must be Z"):
        interpreter.obey(len(program) - 1)


def test_in_inches(tnc) -> None:
    """Points in inches: 2 in is 50.8 mm."""
    cycle = "2 " + CYCLE.format(Q203=0, Q204=1).replace("-15", "-1")
    run = tnc(f"0 BEGIN PGM A INCH\n1 TOOL CALL 1 Z S1000 F20\n{cycle}{HIGH}4 PATTERN DEF ROW1 (X+1 Y+0 D+1 NUM2 ROT+0 Z+1)\n"
              "5 CYCL CALL PAT FMAX\n")  # fmt: skip
    assert [tuple(np.round(hole, 6)) for hole in holes(run)] == [(25.4, 0, 0), (50.8, 0, 0)]


TAP = "CYCL DEF 207 T\nQ200=2\nQ201=-15\nQ239=+1\nQ203=0\nQ204=20\n"
FRAMES = ["", "CYCL DEF 10.0 R\nCYCL DEF 10.1 ROT+33\n", "CYCL DEF 7.0 S\nCYCL DEF 7.1 X+12.5\nCYCL DEF 7.2 Z-3\n"]


@pytest.mark.deep
@given(
    st.sampled_from(FRAMES),
    st.integers(1, 40),
    st.sampled_from(["FMAX", "F900"]),
    st.sampled_from([D, D.replace("Q202=0", "Q202=4").replace("Q211=0", "Q211=0.5"), TAP]),
    st.booleans(),
)
def test_holes_repeated_as_columns_are_the_holes_one_by_one(
    frame: str, count: int, feed: str, cycle: str, high: bool
) -> None:
    """A row, and a row 5 mm higher, at once and one by one: the same path, alarms, history; tapping turns the spindle."""
    points = f"ROW1 (X+3 Y+4 D+2.5 NUM{count} ROT+20 Z+0) ROW2 (X+3 Y+40 D+2.5 NUM{count} ROT+20 Z+{5 * high})"
    head = "0 BEGIN PGM A MM\n1 TOOL CALL 1 Z S1000 F100\n"
    text = f"{head}{cycle}{frame}{HIGH}PATTERN DEF {points}\nCYCL CALL PAT {feed}\nL X+9\n"
    fast = mnc.run(text, "tnc-620")
    kept, repeating.FEWEST = repeating.FEWEST, 10**9
    try:
        slow = mnc.run(text, "tnc-620")
    finally:
        repeating.FEWEST = kept
    assert fast.ok and slow.ok and len(holes(fast)) == 2 * count * (4 if "Q202=4" in cycle else 1)
    for name in COLUMNS:
        one, other = getattr(fast.toolpath, name), getattr(slow.toolpath, name)
        if one.dtype.kind == "f":
            np.testing.assert_allclose(one, other, atol=1e-9, err_msg=name)
        else:
            np.testing.assert_array_equal(one, other, err_msg=name)
    assert {name: fast.history[name] for name in fast.history if name != "position"} == {
        name: slow.history[name] for name in slow.history if name != "position"
    }


@given(
    st.lists(st.tuples(st.integers(-20, 20), st.integers(-20, 20), st.integers(-30, 30)), min_size=1, max_size=9),
    st.integers(-30, 30), st.integers(0, 40), st.integers(-60, 60), st.sampled_from(["", "GLOBAL DEF 125 P\nQ345=1\n"]),
)  # fmt: skip
def test_no_rapid_through_material(places: list, surface: int, second: int, at: int, positioning: str) -> None:
    """Across at or above both set-up planes; down at rapid only to the set-up plane of the place, where S = Q203 + Z."""
    points = " ".join(f"POS{k} (X+{x} Y+{y} Z+{z})" for k, (x, y, z) in enumerate(places, 1)).replace("+-", "-")
    cycle = CYCLE.format(Q203=surface, Q204=second)
    run = mnc.run(
        f"0 BEGIN PGM A MM\n1 TOOL CALL 1 Z S1000 F100\n2 {cycle}{positioning}L X+99 Z+{at} R0 FMAX M3\n".replace("+-", "-")
        + f"PATTERN DEF {points}\nCYCL CALL PAT FMAX\n", "tnc-620",
    )  # fmt: skip
    assert run.ok and [hole[:2] for hole in holes(run)] == [place[:2] for place in places]
    path = run.toolpath
    planes = [-np.inf, *(surface + z + 2 for *_, z in places), -np.inf]
    drilled = 0
    for row in path[path.line == path.line.max()]:
        before, after = planes[drilled], planes[drilled + 1]
        (*across, start), (*_, end) = row.start, row.end
        if row.kind == mnc.Kind.LINE:
            assert start == after
            drilled += 1
        elif across != list(row.end[:2]):
            assert start == end >= max(before, after)
        elif end < start:
            leaving = row.label == "CYCL CALL PAT to the clearance height"
            assert end >= (before if leaving else after)


# --- refused ----------------------------------------------------------------------------------------------------------



def test_what_a_call_should_have_before_it(tnc) -> None:
    run = tnc(f"{D}L Z+50 FMAX\n{TWO}5 CYCL CALL PAT FMAX\n")
    assert run.ok and [a.message for a in run.alarms] == [
        "CYCL CALL PAT: no tool was called", "CYCL CALL PAT: the spindle does not turn",
    ]  # fmt: skip
