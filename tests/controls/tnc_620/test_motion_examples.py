"""The manual's examples of path functions, number by number; see tests/authorities/README.md.

The contours are subprograms: they run behind a tool of radius 0, whose path is the contour itself, and once more with a
tool that fits, beside which the contour is as far away as its radius says.
"""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest
import shapely
from tools.running import run

import mnclab as mnc
from mnclab import Kind

FILE = Path(__file__).parents[2] / "authorities" / "catalogue" / "tnc620-klartext.json"
CODES = ("L", "C", "CT", "CP")
EXAMPLES = [example for example in json.loads(FILE.read_text("utf-8")) if example["code"] in CODES]
VARIABLES = {"PGM CIRCLE31XY": "Q1 = 35\nQ2 = 50\nQ3 = 25\n"}


def obeyed(example: dict, radius: float = 0.0) -> mnc.Run:
    text = example["program"].replace("LBL 0", "M2")
    given = next((v for name, v in VARIABLES.items() if example["title"].startswith(name)), "")
    first = text.startswith("0 BEGIN")
    head, rest = text.split("\n", 1) if first else ("", text)
    return run(f"{head}\nTOOL CALL 1 Z S1000 F250\n{given}{rest}", "tnc-620", tools={1: mnc.Tool(radius=radius)})


@pytest.mark.parametrize("example", EXAMPLES, ids=lambda example: example["title"][:30])
def test_example(example: dict) -> None:
    check, found = dict(example["check"]), obeyed(example)
    path, labels = found.toolpath.motion, found.toolpath.labels
    arcs = path[path.kind == Kind.ARC]
    plain = arcs[[labels[k] != "rounding" for k in arcs.label]]
    rounded = arcs[[labels[k] == "rounding" for k in arcs.label]]
    for key in [key for key in check if key.startswith("rounding_")]:
        row = rounded[int(key.removeprefix("rounding_")) - 1]
        assert [row.start[:2].tolist(), row.end[:2].tolist()] == [pytest.approx(p, abs=6e-4) for p in check.pop(key)]
    if "corners" in check:
        flat = found.programmed.motion.end[:, :2]
        moved = np.append(True, np.abs(np.diff(flat, axis=0)).max(axis=1) > 0)  # without the moves along Z
        assert flat[moved].tolist() == check.pop("corners")
    if "end" in check:
        assert path.end[-1, :2].tolist() == check.pop("end")
    names = {key.removeprefix("ct_"): value for key, value in check.items()}
    if names:
        (arc,) = plain
        radius = float(np.hypot(*(arc.start - arc.centre)[:2]))
        assert arc.centre[:2].tolist() == pytest.approx(names.pop("center"), abs=6e-4)
        assert radius == pytest.approx(names.pop("radius"), abs=6e-4)
        if "direction" in names:
            assert ("counterclockwise" if arc.sweep > 0 else "clockwise") == names.pop("direction")
        if "start" in names:
            assert arc.start[:2].tolist() == names.pop("start")
    assert not names


def test_all_examples_are_there() -> None:
    assert [example["code"] for example in EXAMPLES] == ["L", "C", "C", "CT", "CP", "CP"]


@pytest.mark.parametrize("example", [e for e in EXAMPLES if " RL" in e["program"]], ids=lambda e: e["title"][:30])
def test_beside_the_contour(example: dict) -> None:
    """RL: beside the contour from the end of the entry on, a tool of radius 3 keeps 3 mm from it, and touches it."""
    contour, tool = obeyed(example).toolpath, obeyed(example, 3.0).toolpath
    contour, tool = (path[np.flatnonzero((path.side != 0) & path.is_motion)[1:]] for path in (contour, tool))
    line = shapely.LineString(contour.points(1e-4)[0][:, :2])
    far = shapely.distance(line, shapely.points(tool.points(1e-4)[0][:, :2]))
    assert far.min() > 3 - 1e-3 and far.max() < 3 * np.sqrt(2) + 1e-3
