"""Every example of the catalogue (tests/authorities/catalogue/nc-31.json) against the moves that it lists.

In the lists X is the diameter, in a path it is the radius. The title of an example has its start, where the list has
none, and its machine parameters. Every program runs at 1000 rev/min and 0.2 mm/rev unless it says otherwise.
"""

import json
import re
from pathlib import Path

import numpy as np
import pytest

import mnclab
from mnclab import Kind, Setup

FILE = Path(__file__).parents[2] / "authorities" / "catalogue" / "nc-31.json"
EXAMPLES = [e for e in json.loads(FILE.read_text("utf-8")) if "start X" in e["expected"]]
LINE = re.compile(r"(start|rapid|feed|thread) X(\S+) Z(\S+)(?: pitch (\S+))?(?:\s+#\s*(.*))?$")
BEFORE = ["S1000", "F20"]
THREADS = ("G31", "G32", "G33")


def expected_of(example):
    """The moves of a list: kind, X, Z, pitch, remark."""
    lines = [line.strip() for line in example["expected"].splitlines()]
    found = [LINE.match(line) for line in lines if line and not line.startswith("#")]
    assert all(found), example["expected"]
    start, *moves = [match.groups() for match in found]
    assert start[0] == "start"
    return (float(start[1]), float(start[2])), moves


def parameters_of(title):
    """Machine parameters in a title: `parameter 8 = 100`, `parameters 6 and 7 = 0`."""
    found = re.findall(r"parameters? (\d+)(?: and (\d+))? = (\d+)", title)
    return {f"parameter_{n}": int(value) for *numbers, value in found for n in numbers if n}


@pytest.mark.parametrize("example", EXAMPLES, ids=lambda e: f"{e['code']} {e['title'][:30]}")
def test_example(example):
    (x, z), expected = expected_of(example)
    program = "\n".join([*BEFORE, example["program"]])
    setup = Setup(start=(x / 2, 0, z), settings=parameters_of(example["title"]))
    run = mnclab.run(program, "nc-31", setup)
    assert not run.alarms and run.toolpath.lathe
    path, tolerance = run.toolpath.motion, 5e-4 if "angle" in example["title"] else 1e-9  # that list is rounded
    assert [row.kind == Kind.RAPID for row in path] == [kind == "rapid" for kind, *_ in expected]
    for row, (kind, x, z, pitch, remark) in zip(path, expected, strict=True):
        assert (row.end * (2, 1, 1)).tolist() == pytest.approx([float(x), 0, float(z)], abs=tolerance)
        assert row.synchronous == (kind == "thread")
        if kind == "thread":
            travel = np.subtract(row.end, row.start)
            advance = row.per_rev * abs(travel[2]) / np.linalg.norm(travel)
            assert advance == pytest.approx(float(pitch), abs=1e-9)
        elif kind == "feed":
            modal = run.history.value("feed", int(row.step))
            words = {word.address: word.value for word in run.program[int(run.steps.block[row.step])].words}
            own = words["F"] / 10_000 if "G" in words and "F" in words else modal
            assert row.per_rev == pytest.approx(modal if "modal feed" in (remark or "") else own, abs=1e-12)
            assert row.feed == pytest.approx(row.per_rev * abs(row.spindle), abs=1e-9)
        else:
            assert np.isinf(row.feed) and np.isnan(row.per_rev)


def test_the_file_has_every_example():
    """23 lists of moves; the other two are about reading (test_reading.py)."""
    codes = {e["code"] for e in EXAMPLES}
    assert len(EXAMPLES) == 23 and codes >= {"G70", "G71", "G72", "G73", "G74", "G75", "G77", "G78", *THREADS, "G25"}


def test_the_angle_in_full():
    """29 degrees: 4.5 - 0.46 tan 29 degrees, not only its rounding."""
    example = next(e for e in EXAMPLES if "29 degrees" in e["title"])
    setup = Setup(start=(13.5, 0, 4.5), settings={"parameter_6": 29})
    run = mnclab.run("\n".join([*BEFORE, example["program"]]), "nc-31", setup)
    shifted = run.toolpath.end[run.toolpath.is_motion][[0, 5], 2]
    assert shifted == pytest.approx(4.5 - np.array([0.46, 0.92]) * np.tan(np.radians(29)), abs=1e-12)
