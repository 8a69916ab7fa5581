"""The examples of chapters 3 and 7 with the numbers that they must give (tests/authorities/catalogue)."""

from __future__ import annotations

import json
import re
from functools import partial
from pathlib import Path

import numpy as np
import pytest
from tools import running

import mnclab as mnc

CATALOGUE = Path(__file__).parents[2] / "authorities" / "catalogue"


def records(name: str) -> list[dict]:
    return json.loads((CATALOGUE / f"tnc620-{name}.json").read_text(encoding="utf-8"))


USING, PATTERNS = records("using-cycles"), records("patterns")
HEAD = "0 BEGIN PGM A MM\n1 TOOL CALL 1 Z S1000 F100\n"
CYCLE = "CYCL DEF 200 D\nQ200={Q200}\nQ201=-15\nQ206=250\nQ202=0\nQ210=0\nQ203={Q203}\nQ204={Q204}\nQ211=0\n"
SIMPLE = CYCLE.format(Q200=2, Q203=0, Q204=20)

run = partial(running.run, control="tnc-620", before=HEAD)


def bottoms(found: mnc.Run) -> np.ndarray:
    """Where the tool drills: the ends (n, 3) of the moves at feed that go down, one a hole."""
    path = found.toolpath
    down = (path.kind == mnc.Kind.LINE) & (path.end[:, 2] < path.start[:, 2])
    return path.end[down]


def of(*keys: str) -> list[pytest.param]:
    """The examples whose check has these keys."""
    chosen = [e for e in USING if e["check"] and set(e["check"]) == set(keys)]
    assert chosen
    return [pytest.param(e, id=e["code"] + " " + e["title"][:30]) for e in chosen]


@pytest.mark.parametrize("example", of("points"))
def test_the_points_of_a_pattern(example: dict) -> None:
    found = run(f"{example['program']}\n20 {SIMPLE}21 CYCL CALL PAT FMAX M3\n")
    assert bottoms(found)[:, :2] == pytest.approx(np.array(example["check"]["points"]), abs=1e-3)


@pytest.mark.parametrize("example", of("corners"))
def test_the_corners_of_a_grid(example: dict) -> None:
    """5 columns, 4 rows: (0, 0), (4, 0), (0, 3), (4, 3); row by row to and fro the last row ends at its first column."""
    points = bottoms(run(f"{example['program']}\n20 {SIMPLE}21 CYCL CALL PAT FMAX M3\n"))[:, :2]
    assert len(points) == 20
    assert points[[0, 4, 19, 15]] == pytest.approx(np.array(example["check"]["corners"]), abs=1e-3)


@pytest.mark.parametrize("example", of("points", "unit"))
def test_a_point_table(example: dict) -> None:
    assert example["check"]["unit"] == "MM"
    table = run(f'20 {SIMPLE}21 SEL PATTERN "TAB1"\n22 CYCL CALL PAT FMAX M3\n', files={"TAB1.PNT": example["program"]})
    assert bottoms(table)[:, :2] == pytest.approx(np.array(example["check"]["points"]))


@pytest.mark.parametrize("example", of("file"))
def test_a_table_by_its_whole_name(example: dict) -> None:
    """Selecting moves nothing; the file is found by its whole name, and by its last part."""
    for name in (example["check"]["file"], "nust35.pnt"):
        selected = run(example["program"], files={name: "N MM\nNR X Y\n0 1 2\n[END]"})
        assert not selected.toolpath.is_motion.any() and selected.history["pattern"][-1] == 1


@pytest.mark.parametrize("row", next(e for e in USING if e["check"] and "rows" in e["check"])["check"]["rows"])
def test_the_clearance_height(row: dict) -> None:
    """Q200=2, Q204=20, the tool at Z+5: surface S, reference of Q204 T, clearance height H."""
    assert row["H"] == max(5, row["T"] + 20, row["S"] + 2)
    cycle = CYCLE.format(Q200=2, Q203=row["Q203"], Q204=20)
    points = " ".join(f"POS{n} (X+{n} Y+0 Z+{row['pattern_z']})" for n in (1, 2))
    path = run(f"20 {cycle}21 PATTERN DEF {points}\n22 L Z+5 R0 FMAX M3\n23 CYCL CALL PAT FMAX\n").toolpath
    plane = (path.kind == mnc.Kind.RAPID) & (path.end[:, 0] != path.start[:, 0])
    assert path.end[plane][:, [0, 2]].tolist() == [[1, row["H"]], [2, row["H"]]] and path.end[-1, 2] == row["H"]
    before_drilling = path.start[(path.kind == mnc.Kind.LINE)][:, 2]
    assert before_drilling.tolist() == [row["S"] + 2] * 2


@pytest.mark.parametrize("example", of("set_up_plane_z", "set_up_plane_z_if_Q200_assigned_directly"))
def test_a_parameter_assigned_indirectly(example: dict) -> None:
    check = example["check"]
    for block, level in (
        ("Q1 = +9", check["set_up_plane_z"]), ("Q200 = +9", check["set_up_plane_z_if_Q200_assigned_directly"])
    ):  # fmt: skip
        path = run(example["program"].replace("Q1 = +9", block)).toolpath
        assert path.start[path.kind == mnc.Kind.LINE][0, 2] == level


@pytest.mark.parametrize("example", of("moves", "parameters"))
def test_a_definition_moves_nothing(example: dict) -> None:
    found = run(example["program"])
    assert found.toolpath[found.toolpath.is_motion].length == len(example["check"]["moves"]) == 0
    assert found.variables == example["check"]["parameters"]


@pytest.mark.parametrize("example", of("hole", "set_up_plane_z", "bottom_z", "end_z"))
def test_a_call_at_a_position(example: dict) -> None:
    check, path = example["check"], run(example["program"]).toolpath
    (drilled,) = path[path.kind == mnc.Kind.LINE]
    assert drilled.start.tolist() == [*check["hole"], check["set_up_plane_z"]]
    assert drilled.end[2] == check["bottom_z"] and path.end[-1, 2] == check["end_z"]


@pytest.mark.parametrize("example", of("holes"))
def test_a_modal_call(example: dict) -> None:
    found = run(f"8 {SIMPLE}9 L Z+50 R0 FMAX\n{example['program']}\n14 L Y+99 R0\n")
    assert bottoms(found)[:, :2].tolist() == example["check"]["holes"]
    assert found.toolpath.end[-1].tolist() == [40, 99, 20]


@pytest.mark.parametrize("example", of("set_up_plane_z", "end_z"))
def test_predef(example: dict) -> None:
    path = run(f"{example['program']}\n9 CYCL CALL M3\n").toolpath
    assert path.start[path.kind == mnc.Kind.LINE][0, 2] == example["check"]["set_up_plane_z"]
    assert path.end[-1, 2] == example["check"]["end_z"]


# --- chapter 7: the points stand in the text -------------------------------------------------------------------------


def points_of(text: str) -> np.ndarray:
    return np.array([(float(x), float(y)) for x, y in re.findall(r"\((-?\d+\.\d{3}), (-?\d+\.\d{3})\)", text)])


@pytest.mark.parametrize("example", PATTERNS, ids=lambda e: e["title"][:30])
def test_a_pattern_of_chapter_7(example: dict) -> None:
    program = example["program"]
    if "BEGIN PGM" not in program:
        program = f"{HEAD}40 {SIMPLE}41 L Z+90 R0 FMAX M3\n{program}"
    found = mnc.run(program, "tnc-620")
    expected = points_of(example["expected"])
    assert found.ok, found.alarms
    path = found.toolpath
    down = (path.kind == mnc.Kind.LINE) & (path.end[:, 2] < path.start[:, 2])
    holes = path.end[down][:, :2]
    holes = holes[np.append(True, (np.diff(holes, axis=0) != 0).any(1))]  # one of the infeeds of each hole
    assert len(expected) in (8, 15, 24) and holes == pytest.approx(expected, abs=6e-4)
    level = {8: 80, 15: 100, 24: 80}[len(expected)]
    across = (path.kind == mnc.Kind.RAPID) & (path.end[:, :2] != path.start[:, :2]).any(1)
    assert set(path.end[across][:, 2]) == set(path.start[across][:, 2]) == {level}


def test_the_first_hole_of_the_example_program() -> None:
    """Z 250 to 100, to (55, 70), Z 2, pecks of 4 to -4, -8, -12 and -15, a dwell of 0.25 s after each, up to 100."""
    program = next(e for e in PATTERNS if "HOLEPAT" in e["program"])["program"]
    first_pattern = next(k for k, line in enumerate(program.splitlines(), 1) if line.startswith("6 CYCL DEF 220"))
    path = mnc.run(program, "tnc-620").toolpath
    rows = [row for row in path if row.line == first_pattern]
    seen = [f"{row.time:g} s" if row.kind == mnc.Kind.DWELL else f"Z{round(float(row.end[2]), 4):g}" for row in rows]
    peck = [
        "Z2",
        "Z-4",
        "0.25 s",
        "Z2",
        "Z-2",
        "Z-8",
        "0.25 s",
        "Z2",
        "Z-6",
        "Z-12",
        "0.25 s",
        "Z2",
        "Z-10",
        "Z-15",
        "0.25 s",
    ]
    assert seen[:18] == ["Z100", "Z100", *peck, "Z100"]
    assert [tuple(row.end[:2]) for row in rows[:19]] == [
        (0, 0),
        *[(55, 70)] * 17,
        pytest.approx((50.225, 84.695), abs=1e-3),
    ]
    assert path.end[path.is_motion][-1, 2] == 250
