"""Programs of the source and of the catalogue against expected moves; the files in `examples` name their origins.

An example is: remarks, the program, `---`, the moves. In the moves X is the diameter, in a path it is the radius.
"""

import re
from pathlib import Path

import numpy as np
import pytest

import mnclab
from mnclab import Kind, Setup

EXAMPLES = sorted((Path(__file__).parent / "examples").glob("*.txt"))
MOVE = re.compile(r"(start|rapid|feed) X(\S+) Z(\S+)(?:\s*#.*?)?(?:(cycle|modal) feed)?$")


def remark(text, name):
    """The value of `# name: value`, parts at commas."""
    found = re.search(rf"^# {name}: (.*)$", text, re.MULTILINE)
    return [part.strip() for part in found[1].split(",")] if found else []


@pytest.mark.parametrize("file", EXAMPLES, ids=lambda file: file.stem)
def test_example(file):
    text = file.read_text("utf-8")
    program, _, listed = text.partition("---\n")
    program = "".join(line for line in program.splitlines(keepends=True) if not line.startswith("#"))
    feeds = {name: float(value) for name, value in (part.split() for part in remark(text, "feeds"))}
    settings = {name: int(value) for name, value in (part.split() for part in remark(text, "settings"))}
    expected = [MOVE.match(line) for line in listed.splitlines()]
    assert all(expected) and expected[0][1] == "start"

    start = (float(expected[0][2]) / 2, 0, float(expected[0][3]))
    before = "".join(f"{frame}\n" for frame in remark(text, "before"))
    run = mnclab.run(before + program, "nc-31", Setup(start=start, settings=settings))
    assert not run.alarms
    path, moves = run.toolpath.motion, expected[1:]
    assert run.toolpath.lathe and len(path) == len(moves)
    assert [kind == Kind.RAPID for kind in path.kind] == [move[1] == "rapid" for move in moves]
    ends = [(float(move[2]) / 2, 0, float(move[3])) for move in moves]
    assert np.allclose(path.end, ends, rtol=0, atol=1e-9)
    for row, move in zip(path, moves):
        assert np.isinf(row.feed) and np.isnan(row.per_rev) if move[1] == "rapid" else row.kind == Kind.LINE
        if move[4]:
            assert row.per_rev == pytest.approx(feeds[move[4]], abs=1e-9)
        if move[1] == "feed":
            assert row.feed == pytest.approx(row.per_rev * row.spindle, abs=1e-9)
            assert row.per_rev in feeds.values()


def test_the_groove_in_figures():
    """25.25 turns at 2 mm/rev from diameter 105 to 4, 5.05 s at 300 rev/min (catalogue, fragment N90 to N111)."""
    program = (Path(__file__).parent / "examples" / "fragment_n90_n111.txt").read_text("utf-8").partition("---")[0]
    program = "".join(line for line in program.splitlines(keepends=True) if not line.startswith("#"))
    run = mnclab.run(program, "nc-31", Setup(start=(100, 0, 100)))
    path = run.toolpath.motion
    spirals = path[np.array([path.labels[k] == "G66 Stop key blocked, synchronised start" for k in path.label])]
    assert len(spirals) == 5 and not spirals.exact.any()
    assert np.allclose(spirals.lengths / 2, 25.25) and np.allclose(spirals.lengths / spirals.feed * 60, 5.05)
    lifts = path[np.array([path.labels[k] == "G63 Stop key blocked" for k in path.label])]
    assert len(lifts) == 5 and lifts.exact.all() and path.exact.sum() == 5
    assert not path.synchronous.any()  # the start waits for the spindle, the feed is not locked to it
    assert run.at(line=7, pass_=5).block.number == "N96"
    assert run.history["feed"][-1] == 2.0
