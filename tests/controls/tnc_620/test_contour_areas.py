"""The set rules of the labels of cycle 14 (8.3), where their faults stand, and to which block a contour cycle belongs."""

from __future__ import annotations

import math

import numpy as np
import pytest

import mnclab
from mnclab import Setup, Tool
from mnclab.controls.tnc_620.contours.area import area_of, labelled_shapes
from mnclab.controls.tnc_620.state import memory
from mnclab.running.cycles import perform
from mnclab.running.interpreter import Interpreter

ROUGH = """CYCL DEF 20 CONTOUR DATA
Q1=-5
Q2=+1
Q3=+0
Q4=+0
Q5=+0
Q6=+2
Q7=+50
Q8=+0
Q9=+1
CYCL DEF 22 ROUGH-OUT
Q10=+5
Q11=+100
Q12=+350
Q18=+0
Q19=+0
Q208=+9999
"""


def box(number: int, x: float, y: float, width: float, height: float, side: str = "RR", begin: int = 0) -> str:
    """A label with a rectangle, clockwise; `begin` is its first corner: 0 is (x, y), 1 above it, 2 opposite, 3 beside it."""
    corners = [(x, y), (x, y + height), (x + width, y + height), (x + width, y)]
    (x0, y0), *rest = [*corners[begin:], *corners[: begin + 1]]
    lines = [f"L X{a:+g} Y{b:+g}" for a, b in rest]
    return "\n".join((f"LBL {number}", f"L X{x0:+g} Y{y0:+g} {side}", *lines, "LBL 0", ""))


def region(*labels: str, head: str = ""):
    """The area of the labels 1, 2, … in their order, and the remarks."""
    numbers = "/".join(str(k + 1) for k in range(len(labels)))
    text = f"CYCL DEF 14.0 C\nCYCL DEF 14.1 CONTOUR LABEL {numbers}\n{head}M2\n{''.join(labels)}"
    interpreter = Interpreter(mnclab.controls["tnc-620"], Setup(), mnclab.read(text, "tnc-620"))
    interpreter.run()
    machine = interpreter.machine
    machine.ended = False
    found = area_of(machine, *perform(machine, "", labelled_shapes(machine, memory(machine).contour)))
    return found, list(machine.alarms)


# --- the set rules ------------------------------------------------------------------------------------------------------

def test_any_number_of_pockets_joined() -> None:
    """Three in a row, each 5 in common with the next, all begin outside: 3 * 100 - 2 * 50; a fourth stands alone."""
    found, said = region(*(box(k + 1, 5 * k, 0, 10, 10) for k in (0, 1, 2)), box(4, 100, 0, 10, 10))
    assert found.area == pytest.approx(300 - 100 + 100) and not said


def test_the_first_pocket_that_overlaps_decides() -> None:
    """The third overlaps the second alone, which begins inside it: what they have in common with the area so far stays.

    1: 0 to 10, 2: 8 to 30 from its right end, 3: 25 to 40. 1 and 2 are joined (1 begins outside of 2), 2 begins inside 3.
    """
    one, two, three = box(1, 0, 0, 10, 10), box(2, 8, 0, 22, 10, begin=3), box(3, 25, -5, 15, 20)
    found, said = region(one, two, three)
    assert found.bounds.tolist() == [[25, 0], [30, 10]] and not said
    # where it begins at its left end, outside of 3, all are joined: 0 to 30 by 10, and 300 less what is in common
    assert region(one, box(2, 8, 0, 22, 10), three)[0].area == pytest.approx(300 + 300 - 50)


def test_only_the_first_named_pocket_counts() -> None:
    """B begins inside A, A outside of B: joined, whatever B does."""
    found, _ = region(box(1, 0, 0, 20, 10), box(2, 10, 0, 20, 10, begin=0))
    assert found.area == pytest.approx(300)


def test_pockets_that_only_touch_are_joined() -> None:
    found, said = region(box(1, 0, 0, 10, 10, begin=2), box(2, 10, 0, 10, 10))
    assert found.area == pytest.approx(200) and not said


def test_islands_that_overlap_are_united() -> None:
    found, said = region(box(1, 0, 0, 50, 50), box(2, 10, 10, 10, 10, "RL"), box(3, 15, 10, 10, 10, "RL"))
    assert found.area == pytest.approx(2500 - 150) and not said


@pytest.mark.parametrize(
    ("island", "says", "line"),
    [
        ((15, 5, 2), "the island of label 2 begins outside the pocket that it overlaps", 12),
        ((-5, -5, 2), "the pocket of label 1 begins inside the island of label 2", 5),
        ((20, 5, 0), "the island of label 2 lies outside the pocket: it takes nothing away", 12),
        ((0, 5, 0), "the island of label 2 begins exactly on the contour of the pocket", 12),
    ],
)  # fmt: skip
def test_conditions_of_the_area_of_exclusion(island: tuple[int, int, int], says: str, line: int) -> None:
    """What an island 10 x 10 at x, y with its first corner violates is said at the label; it is taken away all the same."""
    x, y, begin = island
    found, said = region(box(1, 0, 0, 20, 20), box(2, x, y, 10, 10, "RL", begin))
    assert [(a.severity, a.message, a.span[0]) for a in said] == [("warning", says, line)]
    assert found.area < 400 or "outside the pocket: it takes" in says


def test_a_full_circle_is_one_element() -> None:
    found, _ = region("LBL 1\nL X+10 Y+50 RL\nCC X+35 Y+50\nC X+10 Y+50 DR+\nLBL 0\n")
    assert found.area == pytest.approx(625 * math.pi) and len(found.loops) == 1


def test_a_mirror_image_keeps_pockets_and_islands() -> None:
    found, _ = region(box(1, 0, 0, 50, 50), box(2, 10, 10, 10, 10, "RL"), head="CYCL DEF 8.0 M\nCYCL DEF 8.1 X\n")
    assert found.area == pytest.approx(2400) and found.bounds.tolist() == [[0, 0], [50, 50]]


# --- where faults stand ------------------------------------------------------------------------------------------------

def cleared(*labels: str, names: str = "", radius: float = 2.0, head: str = "", **options):
    numbers = names or "/".join(str(k + 1) for k in range(len(labels)))
    cycle = f"CYCL DEF 14.0 C\nCYCL DEF 14.1 CONTOUR LABEL {numbers}\n{ROUGH}"
    text = f"TOOL CALL 1 Z S2000\nL Z+100 R0 FMAX M3\n{head}{cycle}CYCL CALL\nL Z+100 R0 FMAX\nM2\n{''.join(labels)}"
    return text, mnclab.run(text, "tnc-620", Setup(tools={1: Tool(radius=radius)}, **options))


FAULTS = [
    ("L X+0 Y+0", ["L Y+20", "L X+20", "L Y+0"], "L X+0 Y+0", "has no RL or RR: pocket or island cannot be told apart"),
    ("L X+0 RR", ["L Y+20", "L X+20", "L Y+0"], "L X+0 RR", "must begin with both coordinates of the plane"),
    ("L X+0 Y+0 RR", ["L Y+20", "L X+20 Z-3", "L Y+0"], "L X+20 Z-3", "moves along the tool axis"),
    ("L Z-3", ["L X+0 Y+0 RR", "L Y+20", "L X+20"], "L X+0 Y+0 RR", "moves along the tool axis"),
    ("L X+0 Y+0 RR", ["L X+20 Y+20", "L X+20 Y+0", "L X+0 Y+15"], "L X+0 Y+15", "crosses or touches itself near (8.571, 8.571)"),
    ("L X+0 Y+0 RR", ["L X+20", "L X+0"], "L X+0 Y+0 RR", "encloses nothing"),
    ("L X+0 Y+0 RR", ["L X+0 Y+0"], "L X+0 Y+0 RR", "describes no contour"),
    ("L X+0 Y+0 RR", [], "L X+0 Y+0 RR", "describes no contour"),
    ("L X+0 Y+0 RR", ["L Y+20", "L X+20 RL", "L Y+0"], "L X+20 RL", "changes from RL to RR or back"),
    ("L X+0 Y+0 RR", ["CYCL CALL", "L X+20"], "CYCL CALL", "CYCL CALL cannot stand in a contour that a cycle reads"),
    ("Q5 = 1", ["Q6 = 2"], "LBL 1", "describes no contour"),
]


@pytest.mark.parametrize(("first", "rest", "at", "says"), FAULTS, ids=[f"{k} {fault[3][:30]}" for k, fault in enumerate(FAULTS)])
def test_a_fault_of_a_contour_stands_in_its_label(first: str, rest: list[str], at: str, says: str) -> None:
    text, run = cleared("\n".join(("LBL 1", first, *rest, "LBL 0", "")))
    (alarm,) = [alarm for alarm in run.alarms if alarm.severity == "alarm"]
    assert says in alarm.message
    lines = text.splitlines()
    assert lines[alarm.span.line - 1] == at and alarm.span.line >= lines.index("LBL 1") + 1 and alarm.span.column == 1


def test_a_beginning_exactly_on_the_other_contour_is_refused() -> None:
    """It lies on a side of the second pocket: joined or common area cannot be told."""
    text, run = cleared(box(1, 0, 0, 20, 20, begin=2), box(2, 10, 10, 10, 20))
    (alarm,) = run.alarms
    assert "begins exactly on that of label 2" in alarm.message and alarm.span.line == text.splitlines().index("LBL 1") + 2


def test_pockets_without_a_common_area() -> None:
    """2 begins inside 3, but what they have in common lies outside of what 1 and 2 left."""
    one, two, three = box(1, 5, 5, 10, 10), box(2, 0, 0, 30, 30, begin=2), box(3, 25, 25, 10, 10)
    _, run = cleared(one, two, three)
    assert "label 3 has no area in common with the pockets before it" in run.alarms[0].message


# --- to which block the rows belong ---------------------------------------------------------------------------------------

def test_rows_of_a_contour_cycle_belong_to_the_block_that_calls_it() -> None:
    """Stepping, explanation and a start at the block find the moves at CYCL CALL, none at the blocks of the label."""
    text, run = cleared(box(1, 0, 0, 50, 50).replace("LBL 1\n", "LBL 1\nQ50 = 7\n"))
    assert run.ok, run.alarms
    lines = text.splitlines()
    call, label = lines.index("CYCL CALL") + 1, lines.index("LBL 1") + 1
    moment = run.at(line=call)
    assert moment.rows.stop - moment.rows.start > 10
    assert {row.label.split()[0] for row in run.toolpath[moment.rows]} == {"CYCL"}
    assert (run.toolpath.line[moment.rows] == call).all()
    for line in range(label + 1, len(lines) + 1):
        here = run.at(line=line).rows
        assert here.start == here.stop
    assert (np.diff(run.toolpath.step) >= 0).all()
    assert any("CYCL DEF 22" in str(move) or "line" in str(move) for move in run.explain(line=call).moves)
    started = run.start_at(call)
    assert started.ok and len(started.toolpath) == len(run.toolpath) - moment.rows.start
    with pytest.raises(mnclab.Alarm, match="describes a contour for a cycle"):
        run.start_at(label + 2)
    after = run.start_at(call + 1)
    assert len(after.toolpath) == len(run.toolpath) - moment.rows.stop
    assert run.history["Q50"][-1] == 7 and run.variables["Q50"] == 7


def test_called_twice_and_at_a_pattern() -> None:
    """The label is read for each call; every time the moves belong to the block that calls."""
    pattern = "PATTERN DEF POS1 (X+0 Y+0 Z+0) POS2 (X+100 Y+0 Z+0)\n"
    text, run = cleared(box(1, 0, 0, 50, 50), head=pattern)
    text = text.replace("CYCL CALL\n", "CYCL CALL\nCYCL CALL PAT FMAX\n")
    run = mnclab.run(text, "tnc-620", Setup(tools={1: Tool(radius=2)}))
    assert run.ok, run.alarms
    line = text.splitlines().index("CYCL CALL PAT FMAX") + 1
    first, second = run.at(line=line - 1).rows, run.at(line=line).rows
    assert first.stop == second.start and second.stop - second.start > 2 * (first.stop - first.start) - 4
    assert run.toolpath[second].bounds[1, 0] == pytest.approx(148)


def test_local_parameters_of_two_labels_keep_their_order_in_the_history() -> None:
    labels = (box(k, 40 * k, 0, 60, 50).replace(f"LBL {k}\n", f"LBL {k}\nQL1 = {k}\nQ60 = QL1\n") for k in (1, 2))
    text, run = cleared(*labels, head="QL1 = 30\n")
    assert run.ok, run.alarms
    steps = [step for step, _ in run.history.changed("QL1")]
    assert steps == sorted(steps) and run.variables["QL1"] == 30 and run.variables["Q60"] == 2


def test_selected_contours_too() -> None:
    """The moves of a cycle after SEL CONTOUR belong to its call; no program starts in a description."""
    files = {
        "MODEL.H": 'BEGIN PGM MODEL MM\nDECLARE CONTOUR QC1 = "A"\nQC2 = QC1\nEND PGM MODEL MM\n',
        "A.H": "BEGIN PGM A MM\nL X+0 Y+0\nL X+50\nL Y+50\nL X+0\nEND PGM A MM\n",
    }
    text = f'TOOL CALL 1 Z S2000\nL Z+100 R0 FMAX M3\nSEL CONTOUR "MODEL"\n{ROUGH}CYCL CALL\nL X+5 R0 FMAX\n'
    run = mnclab.run(text, "tnc-620", Setup(tools={1: Tool(radius=2)}, files=files))
    assert run.ok, run.alarms
    call = text.splitlines().index("CYCL CALL") + 1
    assert (run.toolpath.program == 0).all() and (run.toolpath.line[run.at(line=call).rows] == call).all()
    assert run.start_at(call).ok and run.start_at(3).ok
    for program in (1, 2):
        with pytest.raises(mnclab.Alarm, match="describes a contour for a cycle"):
            run.start_at(2, program=program)
