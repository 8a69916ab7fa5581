"""The example program of 5.11: eight holes of a point table, centred, drilled and tapped; and the chapter's sample."""

from __future__ import annotations

import json
import math
from pathlib import Path

import numpy as np
import pytest

import mnclab as mnc

HERE = Path(__file__)
EXAMPLES = json.loads((HERE.parents[2] / "authorities/catalogue/tnc620-threading.json").read_text(encoding="utf-8"))
PROGRAM, TABLE = (example["program"] for example in EXAMPLES if example["code"].startswith("PGM"))
HOLES = [(10, 10), (40, 30), (90, 10), (80, 30), (80, 65), (90, 90), (10, 90), (20, 55)]
#: A centring drill of 90 degrees, a drill and a tap, whose pitch is that of 150 mm/min at 200 rev/min.
TOOLS = {1: mnc.Tool(radius=4, angle=90), 2: mnc.Tool(radius=2.4, angle=118), 3: mnc.Tool(radius=3, pitch=0.75)}


def moves(path: mnc.Toolpath, number: int) -> list[mnc.Toolpath]:
    """Rows of a cycle at each hole."""
    rows = path[[path.labels[k].startswith(f"CYCL DEF {number} ") for k in path.label] & path.is_motion]
    here = rows.end[:, :2].round(6)
    return [rows[(here == hole).all(axis=1)] for hole in HOLES]


def taps(path: mnc.Toolpath) -> None:
    """Tapping: FMAX Z2, F150 to Z-25, reversed, F150 to Z2; 54 mm of feed, 21.6 s, 72 revolutions each."""
    for rows in moves(path, 206):
        assert rows.end[:, 2].tolist() == [2, -25, 2]
        cut = rows[rows.kind == mnc.Kind.LINE]
        assert cut.length == 54 and float((cut.lengths / cut.feed).sum() * 60) == pytest.approx(21.6)
        assert cut.feed.tolist() == [150, 150] and cut.spindle.tolist() == [200, -200]


def test_pgm_1() -> None:
    run = mnc.run(PROGRAM, "tnc-620", mnc.Setup(tools=TOOLS, files={"TAB1.PNT": TABLE}, start=(0, 0, 200)))
    assert run.ok, run.alarms
    path = run.toolpath
    for rows in moves(path, 240):
        assert rows.end[:, 2].tolist() == pytest.approx([2, -3.5, 2])
    for rows in moves(path, 200):
        levels = rows.end[:, 2].tolist()
        assert levels == [2, -5, 2, -3, -10, 2, -8, -15, 2, -13, -20, 2, -18, -25, 2]
    taps(path)
    across = path[(path.kind != mnc.Kind.RAPID) & (np.hypot(*(path.end - path.start)[:, :2].T) > 0)]
    assert set(across.feed.tolist()) == {5000}
    assert {10, 50} >= set(across.end[:, 2].tolist()) and len(across) >= 3 * 7  # clearance heights between the points
    assert path[path.is_motion].end[-1, 2] == 100


def test_the_tapping_of_pgm_1_hole_by_hole() -> None:
    """The same without the table: blocks 17 to 22, with a call at each point."""
    lines = PROGRAM.splitlines()
    first = next(k for k, line in enumerate(lines) if line.startswith("17 "))
    text = "\n".join(["0 BEGIN PGM 1 MM", *lines[first:]])
    calls = "\n".join(f"20 L X{x:+} Y{y:+} R0 FMAX M3 M99\n20 L Z+50 R0 FMAX" for x, y in HOLES)
    run = mnc.run(text.replace("20 CYCL CALL PAT F5000 M3", calls), "tnc-620", mnc.Setup(tools=TOOLS))
    assert run.alarms == ()
    taps(run.toolpath)
    assert run.toolpath[run.toolpath.is_motion].end[-1, 2] == 100


SAMPLE = HERE.parents[3] / "data/programs/tnc-620/threads.h"


def test_the_sample_cuts_four_threads() -> None:
    """A tapped hole, a milled nut, one from solid material, a stud: the pitch of each as it is written."""
    run = mnc.run(SAMPLE.read_text(encoding="utf-8"), "tnc-620")
    assert run.alarms == ()
    path = run.toolpath
    found = {}
    for number in (207, 262, 265, 267):
        rows = path[[path.labels[k].startswith(f"CYCL DEF {number} ") for k in path.label]]
        turning = rows[["helix" in rows.labels[k] for k in rows.label]]
        found[number] = [round(float((move.end[2] - move.start[2]) / (move.sweep / math.tau)), 6) for move in turning]
        if number == 207:
            cut = rows[rows.kind == mnc.Kind.LINE]
            found[number] = (cut.feed / abs(cut.spindle)).tolist()
    assert (
        set(found[207]) == {1.25} and set(found[262]) == {1.5} and set(found[265]) == {-1.5} and set(found[267]) == {2}
    )
