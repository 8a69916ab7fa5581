"""Cycles 220 and 221: their points, levels, the cycle that they run, and what is refused, with line and column."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import mnclab as mnc
from mnclab.machine import trial

HEAD = "0 BEGIN PGM A MM\n1 TOOL CALL 1 Z S1000 F100\n"
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
        run = mnc.run(trial.program(mnc.controls["tnc-620"], cycle, values), "tnc-620")
        assert run.alarms == () and len({tuple(hole) for hole in drilled(run)[:, :2].round(6).tolist()}) == count




def test_more_points_on_a_pitch_circle_than_anybody_mills():
    """Each way along the circle is an arc of its own; on straight lines the visits are repeated as columns."""
    text = (
        "BEGIN PGM A MM\nTOOL CALL 2 Z S1000 F100\nL X+0 Y+0 Z+50 FMAX M3\nCYCL DEF 200 DRILLING ~\n Q200=2 ~\n Q201=-15 ~\n "
        "Q206=120 ~\n Q202=5 ~\n Q210=0 ~\n Q203=0 ~\n Q204=20 ~\n Q211=0\nCYCL DEF 220 POLAR PATTERN ~\n Q216=0 ~\n Q217=0 ~\n "
        "Q244=80 ~\n Q245=0 ~\n Q246=360 ~\n Q247=0 ~\n Q241=10001 ~\n Q200=2 ~\n Q203=0 ~\n Q204=20 ~\n Q301=1 ~\n Q365={}\n"
        "END PGM A MM\n"
    )
    found = [mnc.run(text.format(way), "tnc-620") for way in (0, 1)]
    assert found[0].ok and not found[1].ok
    assert "Q241 (number of operations) must be at most 10000 on the pitch circle" in found[1].alarms[-1].message
