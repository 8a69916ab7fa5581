"""Single blocks in situations: what LinuxCNC refuses is refused, and what it keeps in variables has its value."""

import json
from pathlib import Path

import numpy as np
from tools.together import together

import mnclab
from mnclab import Setup

RECORDS = json.loads((Path(__file__).parents[2] / "authorities" / "iso_blocks.json").read_text("utf-8"))["records"]


def apart(ends):
    """Ends of moves without those that lead to where the tool is; a chain of moves along one line is one."""
    found = [np.zeros(3)]
    for end in map(np.array, ends):
        if np.abs(end - found[-1]).max() < 1e-9:
            continue
        if len(found) > 1:
            before, after = found[-1] - found[-2], end - found[-1]
            if np.abs(np.cross(before, after)).max() < 1e-7 and before @ after > 0:
                found.pop()
        found.append(end)
    return np.array(found)


@together("record", RECORDS, lambda record: record["name"].rpartition(": ")[0] or "blocks", lambda record: record["name"])
def test_answers(record):
    run = mnclab.run(record["text"], "g43", Setup(settings={"dialect": "linuxcnc", "stopped_spindle": "accept"}))
    assert run.ok == ("error" not in record), (record["name"], record.get("error"), run.alarms)
    if run.ok:
        ours, theirs = apart(row.end for row in run.toolpath.motion), apart(record["ends"])
        assert ours.shape == theirs.shape and np.abs(ours - theirs).max() < 1e-7, (record["name"], ours, theirs)
