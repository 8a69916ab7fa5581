"""PATTERN DEF and point tables: their points, heights, and what is refused, with line and column."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import mnclab as mnc

D = "2 CYCL DEF 200 D\nQ200=2\nQ201=-15\nQ206=250\nQ202=0\nQ210=0\nQ203=0\nQ204=20\nQ211=0\n"  # lines 3 to 11
HIGH = "3 L Z+50 R0 FMAX M3\n"  # line 12
POLAR = "4 CYCL DEF 220 P\nQ216=50\nQ217=40\nQ244=60\nQ245=0\nQ246=360\nQ247=0\nQ241=8\nQ200=2\nQ203=30\nQ204=50\n"
POLAR += "Q301=1\nQ365=0\n"


def drilled(run: mnc.Run) -> np.ndarray:
    """The bottoms (n, 3) of the holes."""
    assert run.ok, run.alarms
    path = run.toolpath
    return path.end[(path.kind == mnc.Kind.LINE) & (path.end[:, 2] < path.start[:, 2])]


# --- PATTERN DEF ------------------------------------------------------------------------------------------------------


@pytest.fixture
def points(inside):
    """The points that a pattern has."""

    def found(pattern: str, before: str = "") -> list[list[float]]:
        return (drilled(inside(f"{D}{HIGH}{before}4 {pattern}\n5 CYCL CALL PAT FMAX")) + [0, 0, 15]).round(6).tolist()

    return found


def test_positions_count_from_the_one_before(points) -> None:
    pattern = "PATTERN DEF POS1 (X+10 Y+20 Z+1) POS2 (IX+5 Y-3 IZ+2) POS3 (X+0 IY+4 IZ-1)"
    assert points(pattern) == [[10, 20, 1], [15, -3, 3], [0, 1, 2]]


@pytest.mark.parametrize(
    "pattern",
    ["PATTERN DEF ROW1 (X+1 Y+2 D+3 NUM2 ROT+90 Z+0)", "PATTERN DEF ROW1(X+1 Y+2 D+3 NUM2 ROT+90 Z+0)",
     "pattern def\nrow1 (x+1\ny+2 d3 Num2 rot+90\nz+0\n)", "PATTERN DEF ~\nROW1 ~\n(X+1 Y ~\n+2 D+3 NUM2 ROT+90 Z+0)",
     "PATTERN DEF ROW1 (Z+0 ROT+90 NUM2 D+3,0 Y+2 X+1) ;remark", "PATTERN DEF ROW1 (X+Q1 Y+2 D+Q3\nNUMQ2 ROT+90 Z\n+Q4)"],
)  # fmt: skip
def test_ways_to_write_a_row(pattern: str, points) -> None:
    assert points(pattern, "Q1 = 1\nQ2 = 2\nQ3 = 3\nQ4 = 0\n") == [[1, 2, 0], [1, 5, 0]]


def test_elements_follow_each_other(points) -> None:
    pattern = "PATTERN DEF POS1 (X+0 Y+0 Z+0) ROW1 (X+1 Y+1 D+1 NUM2 ROT+0 Z+2) CIRC1 (X+9 Y+9 D2 START+90 NUM1 Z+0)\n"
    assert points(pattern) == [[0, 0, 0], [1, 1, 2], [2, 1, 2], [9, 10, 0]]


def test_parts_of_a_circle(points) -> None:
    """From 90 by -90 three times, and from 0 to 180 in two: both ends count; one point lies at the start."""
    by_step = points("PATTERN DEF PITCHCIRC1 (X+0 Y+0 D2 START+90 STEP-90 NUM3 Z+0)")
    to_end = points("PATTERN DEF PITCHCIRC1 (X+0 Y+0 D2 START+0 END+180 NUM2 Z+0)")
    one = points("PATTERN DEF PITCHCIRC1 (X+0 Y+0 D2 START+0 END+180 NUM1 Z+0)")
    assert (by_step, to_end, one) == ([[0, 1, 0], [1, 0, 0], [0, -1, 0]], [[1, 0, 0], [-1, 0, 0]], [[1, 0, 0]])


def test_a_frame_of_one_row_is_the_row(points) -> None:
    words = "X+1 Y+2 DX+3 DY+9 NUMX3 NUMY1 ROT+0 ROTX+0 ROTY+0 Z+0"
    assert (
        points(f"PATTERN DEF FRAME1 ({words})")
        == points(f"PATTERN DEF PAT1 ({words})")
        == [[1, 2, 0], [4, 2, 0], [7, 2, 0]]
    )


def test_values_are_those_of_the_definition(inside) -> None:
    run = inside(f"{D}{HIGH}4 Q1 = 7\n5 PATTERN DEF POS1 (X+Q1 Y+0 Z+0)\n6 Q1 = 9\n7 CYCL CALL PAT FMAX")
    assert drilled(run)[:, 0].tolist() == [7]




# --- point tables -----------------------------------------------------------------------------------------------------

TABLE = "BEGIN T.PNT MM\nNR   X     Y     Z    FADE CLEARANCE\n"
CALL = f'{D}3 SEL PATTERN "T"\n4 L Z+5 R0 FMAX M3\n5 CYCL CALL PAT FMAX\n'
HEAD = "0 BEGIN PGM A MM\n1 TOOL CALL 1 Z S1000 F100\n"


def with_table(table: str, text: str = CALL) -> mnc.Run:
    return mnc.run(HEAD + text, "tnc-620", mnc.Setup(files={"T.PNT": table}))


def test_columns_of_a_table() -> None:
    """Surface from Z, hidden points are left out, empty fields are found by their column."""
    rows = [
        "0    +10   +20   +1",
        "1    +30   +20   +0   Y",
        "2    +40   +5.5  +3   N    +60",
        "3    +50   -5",
        "4 1,5 2 - - -",
    ]
    assert (drilled(with_table(TABLE + "\n".join(rows) + "\n[END]\n")) + [0, 0, 15]).tolist() == [
        [10, 20, 1], [40, 5.5, 3], [50, -5, 0], [1.5, 2, 0],
    ]  # fmt: skip


def test_a_table_in_inches() -> None:
    assert drilled(with_table("T INCH\nX Y\n1 2\n[END]")).round(6).tolist() == [[25.4, 50.8, -15]]


@pytest.mark.parametrize(("positioning", "heights"), [("", [60, 5, 7]), ("GLOBAL DEF 125 P\nQ345=1\n", [60, 20, 20])])
def test_clearance_heights_of_a_table(positioning: str, heights: list[float]) -> None:
    """One height given: Q204 counts for no point, the others are reached where the tool stood (5); with Q345=1 it is its own."""
    table = TABLE + "0    +10   +0    +0   N    +60\n1    +20   +0\n2    +30   +0    +0   N    +7\n[END]"
    path = with_table(table, CALL.replace("4 L", positioning + "4 L")).toolpath
    leaving = [k for k, label in enumerate(path.label) if path.labels[label] == "CYCL CALL PAT to the clearance height"]
    last = {float(path.end[k, 0]): float(path.end[k, 2]) for k in leaving}
    ends = {x: float(path.end[path.end[:, 0] == x][-1, 2]) for x in (10.0, 20.0, 30.0)}
    assert [last.get(x, ends[x]) for x in (10.0, 20.0, 30.0)] == heights


def test_what_is_selected_later_counts() -> None:
    table = "T MM\nNR X Y\n0 1 2\n[END]"
    before = with_table(table, CALL.replace("3 SEL", "3 PATTERN DEF POS1 (X+9 Y+9 Z+0)\n3 SEL"))
    after = with_table(table, CALL.replace("4 L", "3 PATTERN DEF POS1 (X+9 Y+9 Z+0)\n4 L"))
    assert (drilled(before)[:, 0].tolist(), drilled(after)[:, 0].tolist()) == ([1], [9])


def test_a_table_without_points_moves_nothing() -> None:
    run = with_table("T MM\nNR X Y\n[END]")
    assert run.ok and not len(drilled(run))


TABLES_REFUSED = [
    ('SEL PATTERN "U"', "", "SEL PATTERN U.PNT: there is no point table of this name"),
    ("SEL PATTERN 5.PNT", "", "SEL PATTERN 5.PNT: the name of a point table must begin with a letter"),
    ("SEL PATTERN", "", "the name of a file is missing"),
    (r'SEL PATTERN "TNC:\A\9T"', "", r"SEL PATTERN TNC:\A\9T: the name of a point table must begin with a letter"),
    ('SEL PATTERN "T.TXT"', "", "SEL PATTERN T.TXT: a point table has the type .PNT"),
    ('SEL PATTERN "T"', "T\nNR X Y\n[END]", "SEL PATTERN T.PNT, line 1: the first line must say MM or INCH"),
    ('SEL PATTERN "T"', "T MM\nNR X Z\n[END]", "SEL PATTERN T.PNT, line 2: the column Y is missing"),
    ('SEL PATTERN "T"', "T MM\nNR X Y\n0 1 2\n", "SEL PATTERN T.PNT, line 4: [END] is missing"),
    ('SEL PATTERN "T"', "T MM\nNR X Y\n0 1 2\n1 A 2\n[END]", "SEL PATTERN T.PNT, line 4: X must be a number, got A"),
    ('SEL PATTERN "T"', "T MM\nNR X Y\n0 1\n[END]", "SEL PATTERN T.PNT, line 3: 1 stands under no column of its own"),
    ('SEL PATTERN "T"', TABLE + "0    1\n[END]", "SEL PATTERN T.PNT, line 3: Y is empty"),
    ('SEL PATTERN "T"', TABLE + "0 1 2 3 X 4\n[END]", "SEL PATTERN T.PNT, line 3: FADE must be Y or N, got X"),
    ('SEL PATTERN "T"', "", "SEL PATTERN T.PNT, line 1: the first line must say MM or INCH"),
    ('SEL PATTERN "T"', "T MM\nNR X Y\n0 1e9 2\n[END]", "SEL PATTERN T.PNT, line 3: X must be a number, got 1e9"),
]  # fmt: skip


@pytest.mark.parametrize(("block", "table", "text"), TABLES_REFUSED)
def test_a_table_is_refused(block: str, table: str, text: str) -> None:
    (alarm,) = with_table(table, f"2 {block}").alarms
    assert (alarm.span.line, alarm.span.column, alarm.message) == (3, 15 if len(block) > 12 else 14, text)


def test_a_table_on_disk(tmp_path) -> None:
    path = tmp_path / "some.pnt"
    path.write_text("T MM\nNR X Y\n0 1 2\n[END]")
    assert drilled(mnc.run(HEAD + CALL, "tnc-620", mnc.Setup(files={"t.pnt": path})))[:, 0].tolist() == [1]
    run = mnc.run(HEAD + CALL, "tnc-620", mnc.Setup(files={"t.pnt": tmp_path / "none.pnt"}))
    assert "cannot be read: No such file" in run.alarms[0].message and run.alarms[0].span[:2] == (12, 15)


def test_a_table_beside_its_program(tmp_path) -> None:
    (tmp_path / "T.pnt").write_text("T MM\nNR X Y\n0 7 2\n[END]")
    (tmp_path / "part.h").write_text(HEAD + CALL)
    assert drilled(mnc.run(tmp_path / "part.h", "tnc-620"))[:, 0].tolist() == [7]


# --- any text ---------------------------------------------------------------------------------------------------------

WHOLE_PROGRAM = f"""{HEAD}{D}{HIGH}PATTERN DEF POS1 (X+25 Y+33.5 Z+0)
POS2 (X+15 IY+6.5 Z
+0) PAT1 (X+25 Y+33,5 ~
DX+8 DY+10 NUMX5 NUMY4 ROT+0
ROTX+0 ROTY+0 Z+0) PITCHCIRC1 (X+Q1 Y+33 D80 START+45 STEP30 NUM8 Z+0)
CYCL CALL PAT F5000 M8
SEL PATTERN "T"
CYCL CALL PAT
CYCL CALL POS X+1 Y+2 Z+3 FMAX
{POLAR}L X+5 R0 FMAX M89
L IY+5 M99
"""
SCRAPS = st.sampled_from([
    "X", "+", "-", ".", "9", "0", " ", "\n", ";", "~", '"', "=", "(", ")", "Q1", "NUM", "POS3 (", "FRAME1", "END", "IX", "M89",
    "99999999", "\u0661", "Q241=", "CIRC1 (X+1 Y+1 D", "GLOBAL DEF 125 Q345=", "PREDEF", "LBL 0", "PATTERN DEF ", "CYCL DEF 221 ",
])  # fmt: skip


@pytest.mark.deep
@settings(max_examples=150, deadline=None)
@given(st.integers(0, len(WHOLE_PROGRAM)), st.integers(0, 12), st.lists(SCRAPS, max_size=3))
def test_no_program_raises(at: int, gone: int, scraps: list[str]) -> None:
    text = WHOLE_PROGRAM[:at] + "".join(scraps) + WHOLE_PROGRAM[at + gone :]
    run = with_table("T MM\nNR X Y\n0 1 2\n1 4 5\n[END]", text[len(HEAD) :])
    assert np.isfinite(run.toolpath.end).all()
    assert all(alarm.message and alarm.span for alarm in run.alarms)


GOOD_TABLE = TABLE + "0    +10   +20   +1   Y    +60\n1    +30   -2\n[END]\n"


@given(
    st.integers(0, len(GOOD_TABLE)),
    st.integers(0, 9),
    st.text(alphabet="0123456789+-.,YNXZ \n[]EDMINCHq\t\u0661\0", max_size=6),
)
def test_no_table_raises(at: int, gone: int, scrap: str) -> None:
    run = with_table(GOOD_TABLE[:at] + scrap + GOOD_TABLE[at + gone :])
    assert np.isfinite(run.toolpath.end).all() and (
        run.ok or run.alarms[0].message.startswith("SEL PATTERN T.PNT, line ")
    )
