"""The examples of the catalogue about blocks, blank, tools and the forms of cycles, with the numbers that they must give."""

from __future__ import annotations

import json
import math
from pathlib import Path
from typing import Any

import pytest

import mnclab as mnc
from mnclab import Kind

FILE = Path(__file__).parents[2] / "authorities" / "catalogue" / "tnc620-klartext.json"
ENTRIES = json.loads(FILE.read_text(encoding="utf-8"))


def examples(code: str) -> list[Any]:
    """Program and check of each example of an entry."""
    found = [(entry["program"], entry["check"]) for entry in ENTRIES if entry["code"] == code]
    assert found
    return found


@pytest.mark.parametrize(("program", "check"), examples("BLK FORM"))
def test_blank(tnc, program: str, check: dict[str, Any]) -> None:
    run = tnc(program + "\n")
    blank = run.history["stock"][-1]
    assert run.ok and [list(blank.minimum), list(blank.maximum), blank.axis] == [
        check["min"], check["max"], check.get("tool_axis", "Z"),
    ]  # fmt: skip


def test_tool_call(tnc) -> None:
    """Tool 1 at 4500 rev/min; tool 69, a touch probe, and the tool of that name, both at the speed of before."""
    ((program, _),) = examples("TOOL CALL")
    tools = {1: mnc.Tool(radius=5), 69: mnc.Tool(radius=2, kind="probe"), 70: mnc.Tool(name="TCH PROBE")}
    run = tnc(program + "\n4 L X+1 FMAX M3\n", mnc.Setup(tools=tools))
    assert run.ok and [move.tool for move in run.toolpath if move.kind == Kind.TOOL] == [1, 69, 70]
    assert run.toolpath[-1].spindle == 4500


def corner_points(run: mnc.Run, label: str) -> list[list[list[float]]]:
    """Start and end of each rounding, within a thousandth."""
    path = run.toolpath
    return [[[round(float(v), 3) for v in p[:2]] for p in (m.start, m.end)] for m in path if m.label == label]


def test_straight_lines_and_roundings(inside) -> None:
    """The corners of PGM COTRANS and the tangent points of its roundings; the tool has no radius here."""
    ((program, check),) = examples("L")
    setup = mnc.Setup(tools={1: mnc.Tool()})
    run = inside("2 CALL LBL 1\n3 M2\n" + program, setup)
    assert run.ok, run.alarms
    ends = [[round(float(v), 6) for v in move.end[:2]] for move in run.programmed.motion]
    corners = [point for k, point in enumerate(ends) if k == 0 or point != ends[k - 1]]
    assert [[0, 0], *[c for c in corners if c != [0, 0]], [0, 0]] == check["corners"]
    assert corner_points(run, "rounding") == [check["rounding_1"], check["rounding_2"]]


@pytest.mark.parametrize(("program", "check"), examples("C"))
def test_full_circles(inside, program: str, check: dict[str, Any]) -> None:
    run = inside("2 CALL LBL 1\n3 M2\n".replace("LBL 1", "LBL " + program.split()[2]) + program)
    (circle,) = [move for move in run.programmed if move.kind == Kind.ARC]
    assert circle.start[:2].tolist() == circle.end[:2].tolist() == check["start"]
    assert circle.centre[:2].tolist() == check["center"] and math.dist(circle.start, circle.centre) == check["radius"]
    assert circle.sweep == pytest.approx(-math.tau) and check["direction"] == "clockwise"


def test_the_subprogram_runs_eight_times(tnc) -> None:
    """PGM COTRANS: turned by 45 degrees each time, about the datum (65, 65)."""
    ((main, check),) = examples("CALL LBL")
    ((contour, _),) = examples("L")
    run = tnc(f"{main}\n{contour}\n99 END PGM COTRANS MM\n", mnc.Setup(tools={1: mnc.Tool()}))
    assert run.ok, run.alarms
    firsts = [move for move in run.programmed if move.line == 25]
    assert run.program.line_text(25).split() == ["24", "L", "X+30", "RL"] and len(firsts) == check["runs"]
    points = [[move.end[0] - check["datum"][0], move.end[1] - check["datum"][1]] for move in firsts]
    assert [round(math.degrees(math.atan2(y, x))) % 360 for x, y in points] == check["angles"]
    assert firsts[1].end[:2].tolist() == pytest.approx(check["first_contour_point_run_2"], abs=5e-4)


def test_shift_and_rotation(tnc) -> None:
    ((program, check),) = examples("CYCL DEF (formats)")
    run = tnc(f"1 TOOL CALL 1 Z F100\n{program}\n19 M2\n20 LBL 1\n21 L X+10 Y+0\n22 LBL 0\n")
    assert run.ok and run.toolpath[-1].end[:2].tolist() == pytest.approx(check["local_10_0"], abs=5e-4)


def test_assignments(tnc) -> None:
    (program, check), (beams, results) = examples("FN")
    assert tnc(program + "\n").variables == check
    given = f"1 Q164 = {results['Q164']}\n2 Q165 = {results['Q165']}\n"
    assert tnc(given + beams + "\n").variables == pytest.approx(results)
