"""Variables, formulas and subprograms against LinuxCNC: the recorded positions of random programs, to 1e-9."""

import json
from pathlib import Path

import numpy as np
import pytest

import mnclab
from mnclab import Kind, Setup

FILE = Path(__file__).parents[2] / "authorities" / "iso_macros.json"
RECORDS = json.loads(FILE.read_text("utf-8"))["records"]
KINDS = {Kind.RAPID: "rapid", Kind.LINE: "line"}


@pytest.mark.parametrize("part", range(8))
def test_positions(part):
    """The same rows; a way shorter than a nanometre, which one of the two may make, counts for none."""
    for record in RECORDS[part::8]:
        run = mnclab.run(record["text"], "g43", Setup(settings={"dialect": "linuxcnc"}))
        assert run.ok, (record["name"], run.alarms)
        rows = [row for row in run.toolpath.motion if np.abs(row.end - row.start).max() > 1e-9]
        expected = record["motion"]
        assert [KINDS[row.kind] for row in rows] == [row["kind"] for row in expected], record["name"]
        assert [row.line for row in rows] == [row["line"] for row in expected], record["name"]
        scale = max(1.0, np.abs([row["to"] for row in expected]).max())
        assert np.abs(np.array([row.end for row in rows]) - [row["to"] for row in expected]).max() <= 1e-9 * scale


def test_there_are_enough():
    assert len(RECORDS) >= 200
