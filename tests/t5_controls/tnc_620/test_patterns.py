"""PATTERN DEF, point tables, cycles 220 and 221: their points, heights, and what is refused, with line and column."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import mnclab as mnc
from mnclab.show import trial

D = "2 CYCL DEF 200 D\nQ200=2\nQ201=-15\nQ206=250\nQ202=0\nQ210=0\nQ203=0\nQ204=20\nQ211=0\n"  # lines 3 to 11
HIGH = "3 L Z+50 R0 FMAX M3\n"  # line 12
POLAR = {"Q216": 50, "Q217": 40, "Q244": 60, "Q245": 0, "Q246": 360, "Q247": 0, "Q241": 8}
LINES = {"Q225": 15, "Q226": 25, "Q237": 10, "Q238": 8, "Q242": 6, "Q243": 4, "Q224": 15}
BOTH = {"Q200": 2, "Q203": 30, "Q204": 50, "Q301": 1}


def polar(**changed: object) -> str:
    """Cycle 220; a parameter of None is left out. The head is one line, each parameter one more."""
    values = POLAR | BOTH | {"Q365": 0} | changed
    return "4 CYCL DEF 220 P\n" + "".join(f"{q}={v}\n" for q, v in values.items() if v is not None)


def lines(**changed: object) -> str:
    values = LINES | BOTH | changed
    return "4 CYCL DEF 221 L\n" + "".join(f"{q}={v}\n" for q, v in values.items() if v is not None)


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


GRID = "X+0 Y+0 DX+1 DY+1 NUMX{} NUMY{} ROT+0 ROTX+0 ROTY+0 Z+0"
MISSING = "PATTERN DEF {} ({}) is missing"
WHOLE = "PATTERN DEF {} ({}) must be a whole number from 1 to 100000, got {}"
PATTERNS_REFUSED = [
    ("PATTERN DEF", 3, 1, "PATTERN DEF needs at least one of POS, ROW, PAT, FRAME, CIRC, PITCHCIRC"),
    ("PATTERN DEF POS1 (IX+5 Y+0 Z+0)", 3, 21,
     "PATTERN DEF POS1 X must be absolute (POS2 to POS9 may count from the one before)"),
    ("PATTERN DEF ROW1 (IX+5 Y+0 D+1 NUM2 ROT+0 Z+0)", 3, 21,
     "PATTERN DEF ROW1 X must be absolute (POS2 to POS9 may count from the one before)"),
    ("PATTERN DEF POS1 (X+5 Y+0)", 3, 15, MISSING.format("POS1 Z", "workpiece surface")),
    ("PATTERN DEF ROW1 (X+5 Y+0 D+3 ROT+0 Z+0)", 3, 15, MISSING.format("ROW1 NUM", "number of positions")),
    ("PATTERN DEF CIRC1 (X+5 Y+0 D+3 NUM2 Z+0)", 3, 15, MISSING.format("CIRC1 START", "starting angle")),
    ("PATTERN DEF PITCHCIRC1 (X+5 Y+0 D+3 START+0 NUM2 Z+0)", 3, 15, MISSING.format("PITCHCIRC1 STEP", "stepping angle")),
    ("PATTERN DEF PITCHCIRC1 (X+5 Y+0 D+3 START+0 STEP+5 END+9 NUM2 Z+0)", 3, 54,
     "PATTERN DEF PITCHCIRC1 has both STEP and END (keep one of them)"),
    ("PATTERN DEF ROW1 (X+5 Y+0 D+3 NUM0 ROT+0 Z+0)", 3, 33, WHOLE.format("ROW1 NUM", "number of positions", "0")),
    ("PATTERN DEF ROW1 (X+5 Y+0 D+3 NUM2.5 ROT+0 Z+0)", 3, 33, WHOLE.format("ROW1 NUM", "number of positions", "2.5")),
    (f"PATTERN DEF PAT1 ({GRID.format(0, 3)})", 3, 39, WHOLE.format("PAT1 NUMX", "number of columns", "0")),
    (f"PATTERN DEF FRAME1 ({GRID.format(3, -1)})", 3, 47, WHOLE.format("FRAME1 NUMY", "number of rows", "-1")),
    (f"PATTERN DEF PAT1 ({GRID.format(1000, 1000)})", 3, 15, "PATTERN DEF PAT1 has more than 100000 positions"),
    (f"PATTERN DEF PAT1 ({GRID.format(1000, 90)}) PAT2 ({GRID.format(1000, 90)})", 3, 80,
     "PATTERN DEF has more than 100000 points"),
    ("PATTERN DEF CIRC1 (X+5 Y+0 D-3 START+0 NUM2 Z+0)", 3, 30, "PATTERN DEF CIRC1 D (diameter) must be at least 0, got -3"),
    ("PATTERN DEF POS1 (X+5 Y+0 D+3 Z+0)", 3, 29, "PATTERN DEF POS1 does not take D (it takes X Y Z)"),
    ("PATTERN DEF POS1 (X+5 Y+0 X+3 Z+0)", 3, 29, "PATTERN DEF POS1 X is written twice (keep one of them)"),
    ("PATTERN DEF POS2 (X+5 Y+0 Z+0)", 3, 15, "PATTERN DEF POS2 stands where POS1 is expected"),
    ("PATTERN DEF POS1 (X+5 Y+0 Z+0)\nPOS1 (X+5 Y+0 Z+0)", 4, 1, "PATTERN DEF POS1 stands where POS2 is expected"),
    ("PATTERN DEF\n" + "\n".join(f"POS{k} (X+{k} Y+0 Z+0)" for k in range(1, 11)), 13, 1,
     "PATTERN DEF has more than 9 elements POS"),
    ("PATTERN DEF POS1 (X+5 Y+0 Z+0", 3, 15, "PATTERN DEF POS1: its bracket is not closed (write ))"),
    ("PATTERN DEF POS1 X+5 Y+0 Z+0", 3, 20, "POS needs its words in brackets (write POS1 (X+… Y+…))"),
    ("PATTERN DEF POS (X+5 Y+0 Z+0)", 3, 15, "POS needs its number (write POS1)"),
    ("PATTERN DEF STAR1 (X+5)", 3, 15,
     "a pattern must be one of POS, ROW, PAT, FRAME, CIRC, PITCHCIRC (for example POS1 (X+10 Y+20 Z+0))"),
    ("PATTERN DEF POS1 (X+5 Y Z+0)", 3, 25, "Y needs a number"),
    ("PATTERN DEF POS1 (X+5 Y+0 Z\n)", 4, 1, "Z needs a number"),
    ("PATTERN DEF POS1 (X+5 Y+0 Z", 3, 15, "PATTERN DEF POS1: its bracket is not closed (write ))"),
    ("PATTERN DEF POS1 (X+5 Y+0 W+1)", 3, 29, "W is no word of a pattern (X Y Z)"),
    ("PATTERN DEF ROW1 (X+5 Y+0 D+3 NUM200000 ROT+0 Z+0)", 3, 33, WHOLE.format("ROW1 NUM", "number of positions", "200000")),
]  # fmt: skip


@pytest.mark.parametrize(
    ("pattern", "line", "column", "text"), PATTERNS_REFUSED, ids=[f"{k}" for k in range(len(PATTERNS_REFUSED))]
)
def test_a_pattern_is_refused(pattern: str, line: int, column: int, text: str, inside) -> None:
    alarms = [a for a in inside(f"2 {pattern}").alarms if a.severity == "alarm"]
    found = [(a.span.line, a.span.column, a.message + (f" ({a.hint})" if a.hint else "")) for a in alarms]
    assert found == [(line, column, text)]


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
    ('SEL PATTERN "U"', "", "SEL PATTERN U.PNT: there is no such table"),
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


# --- cycles 220 and 221 -----------------------------------------------------------------------------------------------


@given(
    st.integers(-180, 180), st.integers(-360, 360), st.integers(-90, 90), st.integers(1, 12), st.sampled_from([0, 1])
)  # fmt: skip
def test_points_on_an_arc(start: int, stop: int, step: int, count: int, way: int) -> None:
    """Angles Q245 + i s; s = Q247, or the span over the gaps, one more on a whole circle; arcs turn by s about the centre."""
    run = mnc.run(f"{HEAD}{D}{HIGH}{polar(Q245=start, Q246=stop, Q247=step, Q241=count, Q365=way)}", "tnc-620")
    if step == 0 and stop == start:
        assert "must differ from the starting angle" in run.alarms[0].message
        return
    span = stop - start
    s = step or (span / count if abs(span) == 360 else span / max(count - 1, 1))
    angle = np.radians(start + s * np.arange(count))
    holes = drilled(run)
    assert holes == pytest.approx(
        np.column_stack([50 + 30 * np.cos(angle), 40 + 30 * np.sin(angle), np.full(count, 15)])
    )
    path = run.toolpath
    arcs = path[path.kind == mnc.Kind.ARC]
    if way == 0:
        assert not len(arcs)
    else:
        assert (
            arcs.sweep == pytest.approx(np.full(count - 1, math.radians(s))) and (arcs.feed == 10_000).all()
        )  # the rapid speed of the axes
        assert arcs.centre[:, :2] == pytest.approx(np.tile([50.0, 40], (count - 1, 1))) and (arcs.end[:, 2] == 80).all()


@pytest.mark.parametrize(
    ("clearance", "second", "move", "level"), [(2, 50, 0, 32), (2, 50, 1, 80), (9, 4, 0, 39), (9, 4, 1, 39)]
)
def test_levels_of_a_pattern(clearance: float, second: float, move: int, level: float, inside) -> None:
    """Between the points at 30 + Q200 or at 30 + Q204, which counts where it is the greater one; it ends as the cycle ends."""
    for pattern in (polar, lines):
        run = inside(f"{D}{HIGH}{pattern(Q200=clearance, Q204=second, Q301=move)}")
        path = run.toolpath
        across = (path.kind == mnc.Kind.RAPID) & (path.end[:, :2] != path.start[:, :2]).any(1)
        high = 30 + max(clearance, second)
        assert path.end[across][0, 2] == high and set(path.end[across][1:, 2]) == {level} and path.end[-1, 2] == high
        starts = path.start[path.kind == mnc.Kind.LINE]
        assert set(starts[:, 2]) == {30 + clearance}


@given(
    st.integers(0, 9), st.integers(-20, 20), st.integers(0, 30), st.integers(0, 1), st.integers(-50, 50), st.integers(0, 1),
    st.booleans(),
)  # fmt: skip
def test_no_rapid_through_material(
    clearance: int, surface: int, second: int, move: int, at: int, way: int, cartesian: bool
) -> None:
    """Over the plate nothing goes across below the set-up plane, and no rapid goes down below it, wherever it began."""
    levels = {"Q200": clearance, "Q203": surface, "Q204": second, "Q301": move}
    blocks = lines(**levels) if cartesian else polar(**levels, Q365=way, Q247=20)
    run = mnc.run(f"{HEAD}{D}3 L Z{at:+d} R0 FMAX M3\n{blocks}", "tnc-620")
    assert run.ok and len(drilled(run)) == (24 if cartesian else 8)
    path = run.toolpath[run.toolpath.line > 12]
    across = (path.start[:, :2] != path.end[:, :2]).any(1)
    down = (path.kind == mnc.Kind.RAPID) & (path.end[:, 2] < path.start[:, 2])
    assert (path.start[across][:, 2] >= surface + clearance).all() and (
        path.end[down][:, 2] >= surface + clearance
    ).all()


def test_the_overwritten_parameters_stay(inside) -> None:
    """Q203 = 30 of cycle 220 is that of the drilling from then on, until it is defined again."""
    run = inside(f"{D}{HIGH}{polar(Q241=1)}5 L X+0 Y+0 Z+90 FMAX M99\n6 {D[2:]}7 L X+1 FMAX M99")
    assert drilled(run)[:, 2].tolist() == [15, 15, -15]


def test_one_pattern_after_the_other(inside) -> None:
    run = inside(f"{D}{HIGH}{polar(Q241=3)}{lines(Q242=2, Q243=2)}")
    assert len(drilled(run)) == 7


def test_predef_in_a_pattern(inside) -> None:
    run = inside(f"2 GLOBAL DEF 100 G\nQ200=3\nQ204=70\nQ253=1\nQ208=1\n{D}{HIGH}{polar(Q200='PREDEF', Q204='PREDEF')}")
    path = run.toolpath
    assert set(path.start[path.kind == mnc.Kind.LINE][:, 2]) == {33} and path.end[-1, 2] == 100


def test_many_points_are_the_points_one_by_one(inside) -> None:
    """The rotated grid of the manual's formula, 12 x 9."""
    holes = drilled(inside(f"{D}{HIGH}{lines(Q242=12, Q243=9)}"))
    turn, expected = math.radians(15), []
    for j in range(9):
        for i in range(12) if j % 2 == 0 else reversed(range(12)):
            expected.append(
                (
                    15 + i * 10 * math.cos(turn) - j * 8 * math.sin(turn),
                    25 + i * 10 * math.sin(turn) + j * 8 * math.cos(turn),
                )
            )
    assert holes[:, :2] == pytest.approx(np.array(expected))


OTHERS = {"Q247": 30, "Q301": 0, "Q246": 300}  # where half of the value would do the same


@pytest.mark.parametrize("address", [*POLAR, *LINES, *BOTH, "Q365"])
def test_each_parameter_acts(address: str, inside) -> None:
    """Another value of it alone makes another path."""
    values = POLAR | LINES | BOTH | {"Q365": 0}
    make = lines if address in LINES else polar
    other = OTHERS.get(address, values[address] / 2 if values[address] > 1 else values[address] + 1)
    before, after = inside(f"{D}{HIGH}{make()}").toolpath, inside(f"{D}{HIGH}{make(**{address: other})}").toolpath
    assert before.end.tolist() != after.end.tolist() or before.kind.tolist() != after.kind.tolist()


def test_a_cycle_that_the_manual_does_not_name_runs_if_the_setting_says_so(inside) -> None:
    contour = "LBL 1\nL X+0 Y+0 RR F100\nL Y+30\nL X+40\nL Y+0\nL X+0\nLBL 0\n"
    data = "CYCL DEF 20 C\nQ1=-5\nQ2=1\nQ3=0\nQ4=0\nQ5=0\nQ6=2\nQ7=30\nQ8=0\nQ9=1\n"
    rough = "CYCL DEF 22 R\nQ10=5\nQ11=100\nQ12=200\nQ18=0\nQ19=0\nQ208=FMAX\n"
    blocks = f"2 CYCL DEF 14.0 C\n3 CYCL DEF 14.1 1\n{data}{rough}{HIGH}{polar(Q241=2)}M2\n{contour}"
    run = inside(blocks, pattern_cycles="warn")
    assert run.ok and [a.message for a in run.alarms] == [
        "CYCL DEF 220 cannot be combined with CYCL DEF 22 (Rough-out)"
    ]
    assert (run.toolpath.kind == mnc.Kind.LINE).sum() > 4


def test_a_form_of_each_pattern_begins_with_a_path() -> None:
    for code, count in (("CYCL DEF 220", 8), ("CYCL DEF 221", 24)):
        cycle = mnc.controls["tnc-620"].cycles[code]
        values = {p.name: trial.first_value(p) for p in cycle.parameters()}
        run = mnc.run(trial.program("tnc-620", cycle, values), "tnc-620")
        assert run.alarms == () and len({tuple(hole) for hole in drilled(run)[:, :2].round(6).tolist()}) == count


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
{polar()}L X+5 R0 FMAX M89
L IY+5 M99
"""
SCRAPS = st.sampled_from([
    "X", "+", "-", ".", "9", "0", " ", "\n", ";", "~", '"', "=", "(", ")", "Q1", "NUM", "POS3 (", "FRAME1", "END", "IX", "M89",
    "99999999", "\u0661", "Q241=", "CIRC1 (X+1 Y+1 D", "GLOBAL DEF 125 Q345=", "PREDEF", "LBL 0", "PATTERN DEF ", "CYCL DEF 221 ",
])  # fmt: skip


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


FIRST = "CYCL DEF 220"
NO_CYCLE = "{} has no machining cycle to run: define one before it, for example CYCL DEF 200"
CYCLES_REFUSED = [
    (polar(), 3, 1, NO_CYCLE.format(FIRST)),
    (lines(), 3, 1, NO_CYCLE.format("CYCL DEF 221")),
    (f"{D}{polar(Q241=None)}", 12, 1, f"{FIRST} Q241 (number of operations) is missing"),
    (f"{D}{polar(Q241=0)}", 19, 1,
     f"{FIRST} Q241 (number of operations) must be a whole number and at least 1 and at most 99999, got 0"),
    (f"{D}{polar(Q241=2.5)}", 19, 1,
     f"{FIRST} Q241 (number of operations) must be a whole number and at least 1 and at most 99999, got 2.5"),
    (f"{D}{polar(Q246=0)}", 17, 1, f"{FIRST} Q246 (stopping angle) must differ from the starting angle Q245, got 0"),
    (f"{D}{polar(Q245=400)}", 16, 1, f"{FIRST} Q245 (starting angle) must be at least -360 and at most 360, got 400"),
    (f"{D}{polar(Q244=-1)}", 15, 1,
     f"{FIRST} Q244 (diameter of the pitch circle) must be at least 0 and at most 99999.9999, got -1"),
    (f"{D}{polar(Q301=2)}", 23, 1, f"{FIRST} Q301 (level between the points) must be one of 0, 1, got 2"),
    (f"{D}{polar(Q365=2)}", 24, 1, f"{FIRST} Q365 (way between the points) must be one of 0, 1, got 2"),
    (f"{D}{lines(Q243=0)}", 18, 1,
     "CYCL DEF 221 Q243 (number of lines) must be a whole number and at least 1 and at most 99999, got 0"),
    (f"{D}{lines(Q242=1000, Q243=1000)}", 18, 1, "CYCL DEF 221 Q243 (number of lines) makes 1e+06 points, more than 100000"),
    (f"{D}{lines(Q365=0)}", 24, 1, "Q365=0 has no meaning in this block (CYCL DEF 221 does not take Q365)"),
    (f"{D}3 L X+5 RL F100\n{polar()}", 13, 1, f"{FIRST} cannot run under radius compensation: write R0 before it"),
    (f"{D}{polar(Q200='FMAX')}", 20, 1, f"{FIRST} Q200 (set-up clearance) must be a number, got FMAX"),
    ("2 CYCL DEF 22 R\nQ10=5\nQ11=100\nQ12=200\nQ18=0\nQ19=0\nQ208=FMAX\n" + polar(), 10, 1,
     f"{FIRST} cannot be combined with CYCL DEF 22 (Rough-out)"),
    ("2 CYCL DEF 224 P", 3, 1, "CYCL DEF 224 is not a function of this control"),
]  # fmt: skip


@pytest.mark.parametrize(
    ("blocks", "line", "column", "text"), CYCLES_REFUSED, ids=[f"{k}" for k in range(len(CYCLES_REFUSED))]
)
def test_a_point_pattern_is_refused(blocks: str, line: int, column: int, text: str, inside) -> None:
    alarms = [a for a in inside(blocks).alarms if a.severity == "alarm"]
    assert [(a.span.line, a.span.column, a.message) for a in alarms] == [(line, column, text)]
