"""O words and modes against LinuxCNC: the recorded motion of random programs, to 1e-9, and what it refuses."""

import gzip
import json
from pathlib import Path

import numpy as np
import pytest

import mnclab
from mnclab import Kind, Setup

FILE = Path(__file__).parents[2] / "authorities" / "iso_flow.json.gz"
RECORDS = json.loads(gzip.decompress(FILE.read_bytes()))["records"]
KINDS = {Kind.RAPID: "rapid", Kind.LINE: "line", Kind.ARC: "arc"}
DIALECT = Setup(settings={"dialect": "linuxcnc", "stopped_spindle": "accept"})


def rows_of(run):
    """Kind, line and end of each way; the way up to level R and on is one here, as LinuxCNC makes it."""
    found = []
    for row in run.toolpath.motion:
        if np.abs(row.end - row.start).max() <= 1e-9:
            continue
        if found and row.label.endswith("to the initial level") and found[-1][1] == row.line:
            found.pop()
        found.append((KINDS[row.kind], row.line, row.end))
    return found


@pytest.mark.parametrize("part", range(8))
def test_motion(part):
    for record in RECORDS[part::8]:
        run = mnclab.run(record["text"], "g43", DIALECT)
        assert run.ok == ("error" not in record), (record["name"], record.get("error"), run.alarms)
        if not run.ok:
            continue
        rows, expected = rows_of(run), record["motion"]
        assert [row[:2] for row in rows] == [(row["kind"], row["line"]) for row in expected], record["name"]
        if rows:
            assert np.abs(np.array([end for *_, end in rows]) - [row["to"] for row in expected]).max() <= 1e-9


def test_refusals_stand_where_linuxcnc_has_them():
    """Axis words without a motion, arcs whose end is too far off; LinuxCNC names the block or the one after it."""
    refused = [record for record in RECORDS if "error" in record]
    assert len(refused) >= 10 and len(RECORDS) >= 200
    for record in refused:
        alarm = mnclab.run(record["text"], "g43", DIALECT).alarms[-1]
        if "subroutine levels" in record["error"]:
            assert alarm.message.startswith("calls stand deeper")
        else:
            assert alarm.span.line in (record["line"] - 1, record["line"])


CALLS = json.loads((FILE.parent / "iso_calls.json").read_text("utf-8"))["records"]


@pytest.mark.parametrize("record", CALLS, ids=[record["name"] for record in CALLS])
def test_calls(record):
    """Nine calls stand inside each other at most, and a subprogram is passed once, before it is called."""
    run = mnclab.run(record["text"], "g43", DIALECT)
    assert run.ok == ("error" not in record), (record.get("error"), run.alarms)
    expected = record["motion"]
    assert [row[:2] for row in rows_of(run)] == [(row["kind"], row["line"]) for row in expected]
    assert np.abs(np.array([end for *_, end in rows_of(run)]) - [row["to"] for row in expected]).max() <= 1e-9
    if not run.ok:
        (alarm,) = run.alarms
        deep = "calls stand deeper inside each other than 9, the most on LinuxCNC"
        assert (alarm.message == deep) == ("subroutine levels" in record["error"])
        if alarm.message != deep:
            assert alarm.span.line == record["line"] and "called or passed before" in alarm.message
