"""MNC programs against LinuxCNC's interpreter, where both languages mean the same; see tests/authorities/README.md."""

import json
from itertools import product
from pathlib import Path

import numpy as np
import pytest
from tools.together import together

import mnclab
from mnclab import Kind, Setup, Tool
from mnclab.running import bulk

pytestmark = pytest.mark.deep

AUTHORITIES = Path(__file__).parents[2] / "authorities"
KINDS = {"rapid": Kind.RAPID, "line": Kind.LINE, "arc": Kind.ARC}
EXACT = 1e-9  # mm


def records(name):
    return json.loads((AUTHORITIES / name).read_text(encoding="utf-8"))["records"]


def compare(path, motion, tolerance=EXACT):
    """Every motion row against the recorded one: line, kind, end, feed, centre, sweep."""
    origin, moves = path.origin, path.motion
    assert [(int(k), int(n)) for k, n in zip(moves.kind, moves.line)] == [(KINDS[m["kind"]], m["line"]) for m in motion]
    assert np.abs(moves.end + origin - np.array([m["to"] for m in motion])).max() <= tolerance
    assert moves.feed.tolist() == pytest.approx([m.get("feed", np.inf) for m in motion], rel=1e-12)
    arcs = [i for i, m in enumerate(motion) if m["kind"] == "arc"]
    for i in arcs:
        assert np.abs(moves.centre[i] + origin - motion[i]["centre"]).max() <= tolerance
        assert moves.sweep[i] == pytest.approx(motion[i]["sweep"], abs=1e-9)
        assert np.abs(moves.axis[i] - motion[i].get("axis", [0, 0, 1])).max() <= 1e-12


@together(
    "shortest record", product([bulk.SHORTEST, 2], records("motion.json") + records("motion_more.json")),
    lambda shortest, record: f"{record['name'].rpartition('_')[0]} from {shortest}", lambda shortest, record: record["name"],
)  # fmt: skip
def test_motion(record, shortest, monkeypatch):
    """Most programs are too short for the bulk tier; then it takes every two plain blocks."""
    monkeypatch.setattr(bulk, "SHORTEST", shortest)
    datums = {int(row): tuple(offset) for row, offset in record.get("datums", {}).items()}
    run = mnclab.run(record["mnc"], "mnc", Setup(datums=datums))
    assert run.ok, run.alarms
    compare(run.toolpath, record["motion"])


def of_compensation(refused):
    found = [record for record in records("compensation.json") if bool(record.get("refused")) == refused]
    return together("record", found, lambda record: record["name"].rpartition("_")[0], lambda record: record["name"])


@of_compensation(refused=False)
def test_compensation(record):
    run = mnclab.run(record["mnc"], "mnc", Setup(tools={1: Tool(radius=record["radius"])}))
    assert run.ok, run.alarms
    compare(run.toolpath, record["motion"])


@of_compensation(refused=True)
def test_gouging_is_refused_here_too(record):
    run = mnclab.run(record["mnc"], "mnc", Setup(tools={1: Tool(radius=record["radius"])}))
    assert not run.ok
