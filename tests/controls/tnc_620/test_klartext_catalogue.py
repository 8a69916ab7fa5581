"""The examples of the manual for parameters, calls and cycle 12, with the numbers that stand beside them."""

from __future__ import annotations

import json
import math
from pathlib import Path

import numpy as np
import pytest

import mnclab as mnc

CATALOGUE = Path(__file__).parents[2] / "authorities" / "catalogue"
EXAMPLES = {
    (entry["code"], number): entry
    for name in ("klartext", "special")
    for number, entry in enumerate(json.loads((CATALOGUE / f"tnc620-{name}.json").read_text(encoding="utf-8")))
}


def examples(code: str) -> list[dict]:
    return [entry for (each, _), entry in EXAMPLES.items() if each == code]


@pytest.mark.parametrize("example", examples("FN"), ids=lambda entry: entry["title"][:9])
def test_functions(example: dict, tnc) -> None:
    """What the program does not compute itself (the results of cycle 424) is there before it."""
    given = {name: value for name, value in example["check"].items() if f"{name} =" not in example["program"]}
    run = tnc(example["program"] + "\n", mnc.Setup(variables=given))
    assert run.ok and run.variables == pytest.approx(example["check"])


def test_a_subprogram_called_and_repeated(tnc) -> None:
    """PGM COTRANS: the contour begins at (30, 0) and is cut 8 times round the datum."""
    (example,) = examples("CALL LBL")
    check = example["check"]
    run = tnc(example["program"] + "\n20 LBL 1\n21 L X+30 Y+0 R0 FMAX\n22 LBL 0\n23 END PGM COTRANS MM\n")
    assert run.ok, run.alarms
    points = run.toolpath.end[run.toolpath.line == 22][:, :2]
    assert len(points) == check["runs"] == len(check["angles"])
    angles = np.radians(check["angles"])
    assert np.allclose(points, np.array(check["datum"]) + 30 * np.column_stack([np.cos(angles), np.sin(angles)]))
    assert points[1] == pytest.approx(check["first_contour_point_run_2"], abs=5e-4)
    assert math.dist(points[0], check["datum"]) == pytest.approx(30)


def test_a_program_as_a_cycle(inside) -> None:
    (example,) = examples("CYCL DEF 12")
    check = example["check"]
    sub = "0 BEGIN PGM 50 MM\n1 L IZ-5 R0 F50\n2 END PGM 50 MM\n"
    run = inside("3 M3\n" + example["program"], mnc.Setup(files={check["path"]: sub}))
    assert run.ok, run.alarms
    called = run.toolpath[run.toolpath.program == 1]
    assert len(called) == check["calls"] and called.end[:, :2].tolist() == [check["position"]]
    before = run.toolpath.motion[0]
    assert before.kind == mnc.Kind.RAPID and before.end[:2].tolist() == check["position"]
