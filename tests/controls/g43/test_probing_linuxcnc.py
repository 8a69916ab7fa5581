"""G38.2 and G38.3 against LinuxCNC where nothing is touched: what is refused, where the probe goes, what #5061 to #5070 hold
(tests/authorities/generate_iso_probing.py)."""

import json
from pathlib import Path

import numpy as np
import pytest
from tools.together import together

import mnclab
from mnclab import Kind, Setup, part

RECORDS = json.loads((Path(__file__).parents[2] / "authorities" / "iso_probing.json").read_text("utf-8"))["records"]
KINDS = {"rapid": Kind.RAPID, "feed": Kind.LINE, "probe": Kind.PROBE}
FAR = part.box((1e5, 1e5, 1e5), (1e5 + 1, 1e5 + 1, 1e5 + 1))  # mm: no program comes there
SETUP = Setup(part=FAR, settings={"dialect": "linuxcnc", "stopped_spindle": "accept", "lint": "off"})


def moves(rows):
    """Line, kind and end of those that lead elsewhere."""
    found, here = [], np.zeros(3)
    for line, kind, end, feed in rows:
        if np.abs(end - here).max() > 1e-9:
            found.append((line, kind, end, feed))
            here = end
    return found


@together("record", RECORDS, lambda record: record["name"].partition(":")[0], lambda record: record["name"])
def test_answers(record):
    run = mnclab.run("T6 M6 " + record["text"], "g43", SETUP)
    assert run.ok == ("error" not in record), (record["name"], record.get("error"), run.alarms)
    if not run.ok:
        assert run.alarms[-1].span.line >= 3  # the head is not what is refused
        return
    path = run.toolpath.motion
    ends = path.end + np.array(run.toolpath.origin)
    ours = moves(zip(path.line.tolist(), path.kind.tolist(), ends, path.feed.tolist(), strict=True))
    theirs = moves((row["line"], KINDS[row["kind"]], np.array(row["to"]), row.get("feed", np.inf)) for row in record["motion"])
    assert [row[:2] for row in ours] == [row[:2] for row in theirs]
    assert np.abs(np.array([row[2] for row in ours]) - [row[2] for row in theirs]).max() < 1e-7
    assert [row[3] for row in ours] == pytest.approx([row[3] for row in theirs], rel=1e-7)
