"""Offsets, rotations and reference points against LinuxCNC (tests/authorities/generate_iso_offsets.py)."""

import json
from pathlib import Path

import numpy as np
import pytest
from tools.together import together

import mnclab
from mnclab import Kind, Setup
from mnclab.controls.g43.settings import DIALECTS

RECORDS = json.loads((Path(__file__).parents[2] / "authorities" / "iso_offsets.json").read_text("utf-8"))["records"]
KINDS = {"rapid": Kind.RAPID, "line": Kind.LINE, "arc": Kind.ARC}
SETUP = Setup(settings={"dialect": "linuxcnc", "stopped_spindle": "accept"})
#: LinuxCNC has no G68; it turns by G10 L2 with R, which the script wrote in its place.
WITH_G68 = Setup(settings=DIALECTS["linuxcnc"] | {"stopped_spindle": "accept"})
NEAR = 1e-9


@together("record", RECORDS, lambda record: record["name"].rpartition("-")[0], lambda record: record["name"])
def test_the_motion_of_linuxcnc(record):
    run = mnclab.run(record["text"] + "M2\n", "g43", WITH_G68 if "G68" in record["text"] else SETUP)
    assert run.ok and not run.alarms, run.alarms
    path, rows = run.toolpath.motion, record["motion"]
    origin = np.array(run.toolpath.origin)
    assert path.line.tolist() == [row["line"] for row in rows]
    assert path.kind.tolist() == [KINDS[row["kind"]] for row in rows]
    assert np.abs(path.end + origin - [row["to"] for row in rows]).max() < NEAR
    feeds = [row.get("feed", np.inf) for row in rows]
    per_minute = np.isnan(path.time)  # the others are given by their time (G93)
    assert path.feed[per_minute] == pytest.approx(np.array(feeds)[per_minute], rel=NEAR)
    for k, row in enumerate(rows):
        if row["kind"] == "arc":
            assert path.sweep[k] == pytest.approx(row["sweep"], abs=NEAR), row["line"]
            assert path.axis[k] == pytest.approx(row["axis"], abs=NEAR)
            assert path.centre[k] + origin == pytest.approx(row["centre"], abs=NEAR)
